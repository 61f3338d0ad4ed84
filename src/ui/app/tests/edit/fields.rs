//! Entering words, choosing them from lists, sliders and frames.

use super::scripts::{ray, scene, scripts};
use super::*;

pub(super) const XML: &str = r#"<xml>
  <scene>
    <object type="sphere" name="ball" material="clay"/>
    <object type="sphere" name="bare"/>
    <material type="blinn" name="clay"/> <!-- warm -->
    <material type="blinn" name="glass"/>
  </scene>
  <camera>
    <position z="9"/>
  </camera>
</xml>
"#;

/// A choice from the list of a field: the node, keys and the change.
const CHOICE: &str = r"
    [{1}] e
    {2}       | text {3}
    <Enter>   | text {3} | not menu | mode EDIT
    u         | text opened
    <Ctrl-r>u
    {2}<Esc>  | text opened
    u         | says nothing to undo
";

scripts! {
    a_typed_word_replaces_the_old_one_unless_the_cursor_is_moved: {
        scene("scene.dat", dat::SCENE).each(r"
            [light 1] e<Enter>amb<Enter>       | text ID 1 inf => ID 1 amb
            [light 1] eip<Enter>               | text ID 1 inf => ID 1 pnt
            [light 1] e<Enter><Back>pnt<Enter> | text ID 1 inf => ID 1 pnt
            [light 1] e<Enter><Enter>          | text opened
            [light 1] e<Enter><Left><Right><Back><Enter> | text opened
        ");
        scene("scene.xml", XML).play(r"[object 1] ej<Enter>x<Enter> | text ball => x");
    };

    a_number_keeps_its_text_with_the_cursor_at_the_end: ray().play(r"
        jjjej<Enter>5<Enter> | lines 1.55 // the radius
    ");

    names_and_words_are_chosen_from_a_filtered_list_in_one_undo_step: {
        scene("a.dat", dat::SCENE).table(CHOICE, r"
            object 1 | <Enter><Down>                 | mat ID 1  0 0 0 => mat ID 7  0 0 0
            object 1 | <Enter><Ctrl-n><Ctrl-p><Up>   | mat ID 1  0 0 0 => mat ID 7  0 0 0
            object 1 | <Enter>7                      | mat ID 1  0 0 0 => mat ID 7  0 0 0
            light 1  | <Enter>pn                     | ID 1 inf => ID 1 pnt
            object 3 | <Enter>uni                    | difference => union
            object 3 | jj<Enter>1                    | ID 1 ID 2\n => ID 1 ID 1\n
        ");
        // The camera is not tried out.
        let chosen = CHOICE.replacen(" | text {3}", "", 1);
        scene("a.dat", dat::SCENE).table(&chosen, "view | <Enter>or | perspective => orthographic");
        scene("a.xml", XML).table(CHOICE, r#"
            object 1 | jj<Enter>gl                   | material="clay" => material="glass"
            object 1 | jj<Enter>warm<Ctrl-u><Down>   | material="clay" => material="glass"
            object 2 | jj<Enter>glass                | name="bare" => name="bare" material="glass"
            material 1 | <Enter>ph                   | "blinn" name="clay" => "phong" name="clay"
        "#);
    };

    a_new_name_creates_what_it_names_in_the_same_step: {
        scene("a.dat", dat::SCENE).with("last", "mat ID 7  0 0 1  .1 .5 .4 9  0 0 1\n").play(r"
            [object 1] e<Enter>422<Back> | offered new: create this material
            <Down><Enter>
            | text {last} => {last}mat ID 42  0.8 0.8 0.8  0.2 0.7 0.3 20  0 0 1\n & mat ID 1  0 0 0 => mat ID 42  0 0 0
            u                            | text opened
        ");
        scene("a.xml", XML).with("created", r#"name="glass"/>
    <material type="blinn" name="a &amp; b">
      <diffuse r="0.7" g="0.7" b="0.7"/>
      <specular value="0.3"/>
    </material>"#).play(r#"
            [object 1] ejj<Enter>a & b   | offered new: create this material
            <Down><Enter>                | text material="clay" => material="a &amp; b" & name="glass"/> => {created}
            u                            | text opened
        "#);
    };

    a_new_texture_stands_before_its_use_and_marked_things_follow: scene("a.dat", dat::SCENE).but(
        r"obj sphere ID 1 => texture ID 1 checker 8 8  1 1 1  0 0 0\nuse colour ID 1 mat ID 1\nobj sphere ID 1"
    ).play(r"
        [material 1] e
        @field texture
        <Enter>5<Enter>
        | text use colour ID 1 => texture ID 5 checker 8 8  0.8 0.8 0.8  0.2 0.2 0.2\nuse colour ID 5
        u<Esc>
        [object 1] <Space><Space>ke<Enter>42
        | text …ID 1 mat ID 42  0 0 0… | text …ID 2 mat ID 42  .5 0 0…
        <Back><Back>7<Enter> | text mat ID 1  0 0 0  1 => mat ID 7  0 0 0  1
    ");

    what_cannot_be_chosen_or_created_stays_in_the_list: scene("a.dat", dat::SCENE).play(r"
        // An ID is a number.
        [object 1] e<Enter>glass<Enter> | menu | not offers
        <Esc>
        // There is no plain object.
        [object 3] j<Enter>99<Enter>    | menu
        <Esc>                           | text opened
    ");

    a_choice_overtaken_by_the_file_is_kept: scene("scene.dat", dat::SCENE).play(r"
        [object 1] e<Enter><Down>
        @file 3 0 0 => 5 0 0
        <Up> | says …changed on disk… | not menu | text file & mat ID 1  0 0 0 => mat ID 7  0 0 0
    ");

    the_mouse_chooses_in_a_list_and_closes_it: scene("a.dat", dat::SCENE).play(r"
        [object 1] e<Enter>
        @down list 2,3   | text mat ID 1  0 0 0 => mat ID 7  0 0 0
        // The second click chooses.
        @down list 2,3   | not menu
        <Enter>1
        @down screen 1,1 | not menu | text mat ID 1  0 0 0 => mat ID 7  0 0 0
    ");

    a_second_click_on_a_number_types_if_it_comes_soon: scene("scene.ray", SCENE).play(r"
        @down fields 1,2 | mode EDIT | field 1 | not inputs
        @down fields 1,2 | inputs

        @down fields 1,2 | field 1 | not inputs
        @elapsed click
        @down fields 1,2 | not inputs
    ");

    a_frame_is_orthonormalised_in_one_undo_step: {
        let script = r"
            [object 1] eO | text {1}
            O             | says object 1 (box) is already orthonormal
            u             | text opened
        ";
        ray()
            .but(r"sphere\n0 0 0\n1.5 // the radius => box\n0 0 0\n2 0 0 // vl\n0.5 1 0 0 0 2 1 1 1")
            .table(script, r"2 0 0 // vl\n0.5 1 0 0 0 2 => 1 0 0 // vl\n0.0 1 0 0 0 1");
        scene("a.dat", dat::SCENE)
            .but(r"sphere ID 1 mat ID 1  0 0 0  1 => box ID 1 mat ID 1  0 0 0  2 0 0  3 3 0  0 0 -1  1 1 1")
            .table(script, r"3 3 0  0 0 -1 => 0 4.2426 0  0 0 -1");
    };

    what_has_no_frame_says_so: for (name, text, named) in [
        ("a.ray", SCENE, "object 1"),
        ("a.dat", dat::SCENE, "object 1"),
        ("a.xml", XML, "ball"),
    ] {
        scene(name, text).play(&format!(
            "[object 1] eO | says {named} (sphere) has no frame to orthonormalise | text opened"
        ));
    };

    a_longer_list_fills_the_fields_below_in_one_step: scene(
        "scene.ray",
        "0 0 0 0 1 cylinder 0 0 0  0 0 1  1 0 0  0 1 0  1 1 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1",
    ).each(r"
        [object 1] ej1 0 0 0 1 0 0 0 1<Enter> | text 0 0 1  1 0 0  0 1 0 => 1 0 0  0 1 0  0 0 1
        [object 1] ejjjj2 1/2 3<Enter>        | text 1 1 1 => 2 0.5 3
        [object 1] ejjjj2 1/2 3<Enter>u       | text opened
        [object 1] ejjjjj0.1 0.5 0.1<Enter>   | text opened | refused 3 numbers do not fit: expected 2 for l2 to height or 5 for l2 to ka
    ");

    blanks_before_a_comment_absorb_a_longer_number: {
        let ball = || ray().but(r"1.5 // the radius => 1.5     // the radius");
        ball().play(r"
            [object 1] ej2.125<Enter> | text 1.5     // the radius => 2.125   // the radius
            u                         | text opened
        ");
        // A run of nudges is one step, and none if it comes back.
        ball().play(r"
            [object 1] ejllllllllll | text 1.5     // the radius => 2.5     // the radius
            hhhhhhhhhh              | text opened | not dirty
        ");
    };

    an_arrow_keeps_the_value_and_goes_to_the_next_field: scene(
        "scene.ray",
        "0 0 0 0 1 sphere 0 0 0 1 0 0 0 .5 .5 .5 0 0 0 1 0 0 1",
    ).play(r"
        [object 1] ej2<Up><Tab><Tab>7<Down> | text sphere 0 0 0 1 0 0 0 => sphere 0 0 7 2 0 0 0
    ");

    a_slider_is_dragged_in_one_undo_step: {
        let script = r"
            [{1}]
            @down fields 20,{2}
            @drag fields 40,{2} | text {4}
            @drag fields 0,{2}  | text {3}
            @drag fields 30,{2}
            @up fields 30,{2}
            // It was let go.
            @drag fields 18,{2} | text {4} | mode EDIT | field {5}
            u                   | text opened
        ";
        ray().table(script, "object 1 | 7 | 5 0.50 0 1 => 5 0.00 0 1 | 5 0.50 0 1 => 5 1.00 0 1 | 6");
        scene("a.dat", dat::SCENE).table(script, "material 1 | 3 | .1 .5 .4 => .1 .0 .4 | .1 .5 .4 => .1 1.0 .4 | 2");
        let shiny = scene("a.xml", XML).but("blinn => microfacet");
        // A default is written beside its element's start.
        shiny.table(script, r#"
            material 1 | 5 | opened | name="clay"/> => name="clay">\n      <metallic value="1"/>\n    </material> | 4
        "#);
        shiny.but(r#"name="clay"/> => name="clay"><roughness value="1"/></material>"#).table(script, r#"
            material 1 | 4 | value="1" => value="0" | opened | 3
        "#);
    };
}
