//! Adding things, changing their kind, and moving, turning and scaling them.

use super::scripts::{Stage, scene, scripts};
use super::*;

const RAY: &str = "\
// view: eye 0 0 10 target 0 0 0 up 0 1 0 fov 90 size 400 300
0.1 0.1 0.1
1
5 5 5  1 1 1
1
box 0 0 0  1 0 0  0 1 0  0 0 1  1 2 3  0 0 0 .5 .5 .5 0 0 0 1 0 0 1
";

const DAT: &str = "\
camera perspective 0 0 10  0 0 0  0 1 0  1 0 100
mat ID 1  1 1 1  .3 .5 .2 9  0 0 1
obj sphere ID 1 mat ID 1  0 0 0  1
";

const LIGHTS: &str = "\
light ID 1 pnt  5 5 5  0 0 0  1 1 1  1 0 0  0 shadow_on
light ID 2 inf  0 0 0  1 0 0  1 1 1  1 0 0  0 shadow_on
light ID 3 inf  1 0 0  0 0 0  1 1 1  1 0 0  0 shadow_on
light ID 4 amb  0 0 0  1 0 0  1 1 1  1 0 0  0 shadow_off
mat ID 1  1 1 1  .3 .5 .2 9  0 0 1
obj sphere ID 1 mat ID 1  0 0 0  1
";

const XML: &str = "\
<xml>
  <scene>
    <object type=\"sphere\" name=\"a\">
      <translate x=\"1\"/>
    </object>
    <light type=\"point\" name=\"l\">
      <position y=\"5\"/>
    </light>
  </scene>
  <camera>
    <position z=\"10\"/>
    <target value=\"0\"/>
  </camera>
</xml>
";

scripts! {
    things_are_moved_rotated_and_scaled_by_typed_amounts_along_axes: {
        scene("a.ray", RAY).each(r"
            [object 1] mx2<Enter>                | becomes box 0 0 0 => box 2 0 0
            [object 1] mx2<Back>-1.5<Enter>      | becomes box 0 0 0 => box -1.5 0 0
            [object 1] mxx1<Enter>               | becomes box 0 0 0 => box 1 0 0
            [object 1] s2<Enter>                 | becomes box 0 0 0 => box -0.5 -1 -1.5 & 1 2 3 => 2 4 6
            [object 1] my1/4<Enter>              | becomes box 0 0 0 => box 0 0.25 0
            [object 1] m1 -2 (1+2)*.5<Enter>     | becomes box 0 0 0 => box 1 -2 1.5
            [object 1] my1/<Enter>2<Enter>       | becomes box 0 0 0 => box 0 0.5 0
            [object 1] mx1 2<Enter><Back><Back><Enter> | becomes box 0 0 0 => box 1 0 0
            // Nothing of a typed amount is lost, however coarse the cells are.
            [object 1] my3.285<Enter>            | becomes box 0 0 0 => box 0 3.285 0
            [object 1] sxx1.125<Enter>           | becomes box 0 0 0 => box -0.0625 0 0 & 1 2 3 => 1.125 2 3
            // cos 60° is written without the rounding errors of binary fractions.
            [object 1] tz60<Enter>
            | becomes box 0 0 0  1 0 0  0 1 0 => box 1.116 0.067 0  0.5 0.866 0  -0.866 0.5 0
        ");
        scene("a.xml", XML).each(r#"
            [object 1] my2<Enter>  | becomes <translate x="1"/> => <translate x="1" y="2"/>
            [light 1] my-1<Enter>  | becomes <position y="5"/> => <position y="4"/>
            [object 1] tz90<Enter> | becomes <translate => <rotate z="1" angle="90"/>\n      <translate
            [object 1] s2<Enter>   | becomes <translate => <scale value="2"/>\n      <translate
        "#);
    };

    // The picture is about 20 units wide at the box, in some eighty cells.
    steps_are_as_long_as_a_cell_can_show_and_snap_to_a_grid: scene("a.ray", RAY).each(r"
        [object 1] ml<Enter>       | becomes box 0 0 0 => box 0.5 0 0
        [object 1] mLk<Enter>      | becomes box 0 0 0 => box 5 0.5 0
        [object 1] mllllllg<Enter> | becomes box 0 0 0 => box 5 0 0
        [object 1] mllhh<Enter>    | text opened | not errors | mode SELECT
    ");

    escape_puts_back_every_byte_and_leaves_no_step: for (name, text, turn) in
        [("a.ray", RAY, "tz45"), ("a.dat", DAT, "s2"), ("a.xml", XML, "tz45")]
    {
        for said in ["mx2", "ml", turn, "s3", "mll"] {
            scene(name, text).each(&format!(
                "[object 1] {said}<Esc> | text opened | not errors | mode SELECT | > u | says nothing to undo"
            ));
        }
    };

    a_motion_says_how_far_it_went: scene("a.ray", RAY).each(r"
        [object 1] mx1.5        | says move along x: 1.5
        [object 1] mx1.5<Enter> | says move along x: 1.5
        [object 1] mll          | says move: 1.0 right, 0.0 up
        [object 1] mllg         | says move: 0.0 right, 0.0 up on the grid
        [object 1] mxxxll       | says move: 1.0 right, 0.0 up
        [object 1] tzzl         | says rotate about own z: 1.00°
        [object 1] tl           | says rotate in the picture: 1.00°
        [object 1] sk           | says scale: ×1.05
        [object 1] sxx2         | says scale along own x: ×2
    ");

    every_step_of_a_motion_starts_from_the_text_before_it: scene("a.xml", XML).but(
        r#"<object type => <object name="g"><translate z="1"/><object name="h"/></object>\n    <object type"#
    ).each(r#"
        [object 1] tz30<Enter>   | becomes <translate z="1"/> => <rotate z="1" angle="30"/><translate z="1"/>
        [object 2] mx12.5<Enter> | becomes <object name="h"/> => <object name="h"><translate x="12.5"/></object>
        [object 1] tz3<Back><Enter> | text opened | not errors | mode SELECT
        [object 1] t<Enter>      | text opened | not errors | mode SELECT
    "#);

    every_step_of_a_motion_shows_the_scene_of_its_text: {
        let two = scene("a.ray", RAY)
            .but(r"\n1\nbox => \n2\nsphere 1 2 3 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1\nbox");
        // An ambient reflection above 1 is a warning.
        let warned = two.clone().but("sphere 1 2 3 1  0 => sphere 1 2 3 1  2");
        for (stage, begins) in [
            (&two, "[object 1] | not wrong"),
            (&two, "[object 2] | not wrong"),
            (&warned, "[object 2] | wrong"),
        ] {
            for said in ["mllkL", "mx12.5", "tz305", "s2", "sl", "mlhhl", "ml<Esc>"] {
                let mut session = stage.session();
                session.run(begins);
                for key in keys(said) {
                    session.app.update(Msg::Key(key));
                    session.run("| fresh");
                }
            }
        }
    };

    lights_without_a_position_rotate_their_direction: {
        scene("a.xml", XML)
            .but(r#"point => direct & <position y="5"/> => <direction x="1" y="0" z="0"/>"#)
            .each(r#"[light 1] tz90<Enter> | becomes x="1" y="0" z="0" => x="0" y="1" z="0""#);
        scene("a.dat", LIGHTS).each(r"
            [light 2] tz90<Enter> | becomes 0 0 0  1 0 0  1 1 1 => 0 0 0  0 1 0  1 1 1
            [light 3] tz90<Enter> | becomes 1 0 0  0 0 0  1 1 1 => 0 1 0  0 0 0  1 1 1
        ");
    };

    what_cannot_be_moved_is_said: {
        scene("a.ray", RAY).each(r"
            [ambient] m  | says ambient has no position | text opened
            [light 1] s  | says light 1 cannot be scaled | text opened
            [light 1] t  | says light 1 has no direction | text opened
        ");
        scene("a.xml", XML).each(r"
            [light 1] s  | says l (point) cannot be scaled | text opened
            [light 1] t  | says l (point) has no direction | text opened
        ");
        scene("a.dat", DAT).each(r"
            [object 1] t | says object 1 (sphere) has no direction | text opened
            [view] s     | says a camera has no size: [ and ] in VIEW change what it sees | text opened
        ");
        scene("a.dat", LIGHTS).each(r"
            [light 1] s  | says light 1 cannot be scaled | text opened
            [light 1] t  | says light 1 has no direction | text opened
            [light 2] s  | says light 2 cannot be scaled | text opened
            [light 2] m  | says light 2 has no position | text opened
            [light 4] t  | says light 4 has no direction | text opened
        ");
    };

    all_marked_things_move_together: two().play(r"
        [object 1] <Space><Space>mx2<Enter>
        | text ID 1  0 0 0 => ID 1  2 0 0 & ID 1  1 0 0  1\n => ID 1  3 0 0  1\n
    ");

    a_change_on_disk_ends_a_motion_and_loses_nothing: scene("scene.ray", RAY).play(r"
        [object 1] mx2
        @file 5 5 5 => 6 6 6
        l | says …the transformation so far is kept… | text file & box 0 0 0 => box 2 0 0 | mode SELECT
    ");

    menus_add_things_and_change_their_kind: {
        for (name, text) in [("a.ray", RAY), ("a.dat", DAT), ("a.xml", XML)] {
            scene(name, text).play(r"
                @note before nodes
                asphere<Enter> | named …sphere… | not nodes {before}
                u              | text opened
                a<Esc>         | not menu
                // Nothing is chosen.
                azzz<Enter>    | menu
            ");
        }
        scene("a.ray", RAY).play(r"
            [object 1] ccyl<Enter> | named object 1 (cylinder)
            u                      | text opened
        ");
    };

    nothing_is_outlined_until_something_is_selected: {
        scene("a.dat", DAT).play(r"
            | not outlined
            G | at object 1 | outlined 0
        ");
        // The users of a material.
        two().play(r"
            [material 1] | outlined 0 1
            o            | not outlined
        ");
    };

    a_click_beside_the_picture_confirms_a_motion: scene("a.ray", RAY).play(r"
        [object 1] mx2
        @down list 3,2 | not transforms | becomes box 0 0 0 => box 2 0 0
    ");

    the_camera_is_moved_and_rotated_in_its_own_record: {
        let stage = scene("a.dat", DAT);
        stage.each(r"
            [view] mx2<Enter>    | becomes 0 0 10  0 0 0 => 2 0 10  2 0 0
            [view] mzz-1<Enter>  | becomes 0 0 10  0 0 0 => 0 0 9  0 0 -1
            // A quarter turn about y looks along −x; about its own z it rolls.
            [view] ty90<Enter>   | becomes 0 0 10  0 0 0 => 0 0 10  -10 0 10
            [view] tzz90<Enter>  | becomes 0 0 0  0 1 0 => 0 0 0  -1 0 0
            [view] m<Esc>mx1<Enter> | becomes 0 0 10  0 0 0 => 1 0 10  1 0 0
        ");
        scene("a.xml", XML).each(r#"
            [view] mz-2<Enter>
            | becomes <position z="10"/> => <position z="8"/> & <target value="0"/> => <target value="1" x="0" y="0" z="-2"/>
        "#);
        // Steps are as long as a cell shows at the target, and each starts from the camera before.
        let mut session = stage.session();
        session.run("[view] mll");
        let moved = session.app.shared.camera().expect("there is a camera").eye.x;
        assert!(0.01 < moved && moved < 1.0, "{moved}");
        session.run("hh | text opened");
    };

    only_the_mark_moves_where_the_picture_is_seen_from_elsewhere: scene("a.dat", DAT).play(r"
        [view] v-<Esc> | symbol-cells view 43,16
        @note seen camera
        mx0.1<Enter>   | text 0 0 10  0 0 0 => 0.1 0 10  0.1 0 0 | camera {seen} | symbol-cells view 50,16
    ");

    a_rotated_ellipsoid_becomes_a_quadric_in_the_same_step: scene("a.dat", DAT)
        .but("obj sphere ID 1 mat ID 1  0 0 0  1 => obj ellipsoid ID 1 mat ID 1  0 0 0  1 2 3")
        .play(r"
        [object 1] tz90<Enter> | becomes 1 2 3\n => 2 1 3\n

        [object 1] tz3 | named object 1 (quadric)
        0<Enter>       | not errors | says rotate about z: 30°
        // Scaled along its own axis it is an ellipsoid still.
        sxx2<Enter>    | not errors
        uu             | text opened
    ");

    what_has_to_wait_for_the_end_of_a_motion_says_so: {
        let stage = scene("a.ray", RAY).after("[object 1] mx2");
        for said in ["q", "w", "u", "<F5>", "a", "E", "P", ":w<Enter>", ":q<Enter>", ":wq<Enter>"] {
            let end = "Enter confirms the change first; Esc cancels it";
            stage.each(&format!(
                "{said} | not does | says {end} | mode MOVE | > <Esc> | text opened"
            ));
        }
        stage.each(r"
            ?            | help | > <Esc><Enter> | text box 0 0 0 => box 2 0 0
            :            | prompt | > <Esc><Enter> | text box 0 0 0 => box 2 0 0
            M            | history | > <Esc><Enter> | text box 0 0 0 => box 2 0 0
            :help<Enter> | help | > <Esc><Enter> | text box 0 0 0 => box 2 0 0
            :q!<Enter>   | does quit
        ");
    };

    // The camera looks along the vertical: what is in the middle of the picture carries what is added,
    // and what is below it is hidden.
    added_things_stand_on_what_is_below_or_in_the_middle_of_the_picture: {
        let table = "obj box ID 2 mat ID 1  0 -1.5 0  1 0 0  0 1 0  0 0 1  90 2 90";
        scene("a.dat", DAT).but(&format!(r"0 0 0  1\n +> {table}\n")).play(r"
            @shows 0
            asphere<Enter> | lines obj sphere ID 3 mat ID 1  0 0 2  1
        ");
        scene("a.dat", DAT).but("0 0 10  0 0 0 => 0 0 10  0 0 -50").play(r"
            @shows 0
            asphere<Enter> | lines obj sphere ID 2 mat ID 1  0 0 2  1
        ");
    };
}

/// [`DAT`] with another sphere.
fn two<'s>() -> Stage<'s> {
    scene("a.dat", DAT).but(r"0 0 0  1\n +> obj sphere ID 2 mat ID 1  1 0 0  1\n")
}
