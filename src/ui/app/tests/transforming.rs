//! Adding things, changing their kind, and moving, turning and scaling them by transform.

use std::sync::Arc;

use super::moving::click;
use super::*;
use crate::language::Node;
use crate::ui::msg::Target;
use Node::{Light, Object};

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

/// Selects a node of a text, types keys, and checks the text; then that `u` undoes it in one step.
#[track_caller]
fn check(name: &str, text: &str, node: Node, said: &str, changes: &[(&str, &str)]) {
    let (mut app, _) = opened_as(name, text);
    assert_eq!(app.error_count(), 0, "{name}");
    app.select(node);
    press(&mut app, said);
    let expected = changes.iter().fold(text.to_owned(), |text, (old, new)| {
        assert!(text.contains(old), "{old}");
        text.replacen(old, new, 1)
    });
    assert_eq!(app.document.text(), expected, "{said}: {}", words(&app));
    assert_eq!((app.error_count(), app.mode), (0, Mode::Select), "{said}");
    if !changes.is_empty() {
        press(&mut app, "u");
    }
    assert_eq!(app.document.text(), text, "{said}: undone");
}

#[test]
fn things_are_moved_rotated_and_scaled_by_typed_amounts_along_axes() {
    let ray = |node, said, old, new| check("a.ray", RAY, node, said, &[(old, new)]);
    ray(Object(0), "mx2<Enter>", "box 0 0 0", "box 2 0 0");
    ray(
        Object(0),
        "mx2<Back>-1.5<Enter>",
        "box 0 0 0",
        "box -1.5 0 0",
    );
    ray(Object(0), "mxx1<Enter>", "box 0 0 0", "box 1 0 0");
    ray(Light(0), "mz-5<Enter>", "5 5 5  1 1 1", "5 5 0  1 1 1");
    ray(
        Object(0),
        "s2<Enter>",
        "box 0 0 0  1 0 0  0 1 0  0 0 1  1 2 3",
        "box -0.5 -1 -1.5  1 0 0  0 1 0  0 0 1  2 4 6",
    );
    ray(
        Object(0),
        "syy2<Enter>",
        "box 0 0 0  1 0 0  0 1 0  0 0 1  1 2 3",
        "box 0 -1 0  1 0 0  0 1 0  0 0 1  1 4 3",
    );
    ray(
        Object(0),
        "tz90<Enter>",
        "box 0 0 0  1 0 0  0 1 0  0 0 1",
        "box 1.5 0.5 0  0 1 0  -1 0 0  0 0 1",
    );
    ray(Object(0), "my1/4<Enter>", "box 0 0 0", "box 0 0.25 0");
    ray(
        Object(0),
        "m1 -2 (1+2)*.5<Enter>",
        "box 0 0 0",
        "box 1 -2 1.5",
    );
    ray(Object(0), "my1/<Enter>2<Enter>", "box 0 0 0", "box 0 0.5 0");
    ray(
        Object(0),
        "mx1 2<Enter><Back><Back><Enter>",
        "box 0 0 0",
        "box 1 0 0",
    );
    // Nothing of a typed amount is lost, however coarse the cells are.
    ray(Object(0), "my3.285<Enter>", "box 0 0 0", "box 0 3.285 0");
    ray(
        Object(0),
        "sxx1.125<Enter>",
        "box 0 0 0  1 0 0  0 1 0  0 0 1  1 2 3",
        "box -0.0625 0 0  1 0 0  0 1 0  0 0 1  1.125 2 3",
    );
    // cos 60° is written without the rounding errors of binary fractions.
    ray(
        Object(0),
        "tz60<Enter>",
        "box 0 0 0  1 0 0  0 1 0  0 0 1",
        "box 1.11603 0.06699 0  0.5 0.866025403784439 0  -0.866025403784439 0.5 0  0 0 1",
    );
    check(
        "a.dat",
        DAT,
        Object(0),
        "my3<Enter>",
        &[("0 0 0  1\n", "0 3 0  1\n")],
    );
    check(
        "a.xml",
        XML,
        Object(0),
        "mx2<Enter>",
        &[("<translate x=\"1\"/>", "<translate x=\"3\"/>")],
    );
    check(
        "a.xml",
        XML,
        Object(0),
        "my2<Enter>",
        &[("<translate x=\"1\"/>", "<translate x=\"1\" y=\"2\"/>")],
    );
    check(
        "a.xml",
        XML,
        Light(0),
        "my-1<Enter>",
        &[("<position y=\"5\"/>", "<position y=\"4\"/>")],
    );
    check(
        "a.xml",
        XML,
        Object(0),
        "tz90<Enter>",
        &[(
            "<translate",
            "<rotate z=\"1\" angle=\"90\"/>\n      <translate",
        )],
    );
    check(
        "a.xml",
        XML,
        Object(0),
        "s2<Enter>",
        &[("<translate", "<scale value=\"2\"/>\n      <translate")],
    );
}

#[test]
fn steps_are_as_long_as_a_cell_can_show_and_snap_to_a_grid() {
    // The picture is about 20 units wide at the box, in some eighty cells.
    check(
        "a.ray",
        RAY,
        Object(0),
        "ml<Enter>",
        &[("box 0 0 0", "box 0.5 0 0")],
    );
    check(
        "a.ray",
        RAY,
        Object(0),
        "mLk<Enter>",
        &[("box 0 0 0", "box 5 0.5 0")],
    );
    check(
        "a.ray",
        RAY,
        Object(0),
        "mllllllg<Enter>",
        &[("box 0 0 0", "box 5 0 0")],
    );
    check("a.ray", RAY, Object(0), "mllhh<Enter>", &[]);
}

#[test]
fn escape_puts_back_every_byte_and_leaves_no_step() {
    for said in ["mx2<Esc>", "ml<Esc>", "tz45<Esc>", "s3<Esc>", "mll<Esc>"] {
        check("a.ray", RAY, Object(0), said, &[]);
        check("a.dat", DAT, Object(0), &said.replace("tz45", "s2"), &[]);
        check("a.xml", XML, Object(0), said, &[]);
    }
    let (mut app, _) = opened_as("a.ray", RAY);
    app.select(Object(0));
    press(&mut app, "mx2<Esc>u");
    assert_eq!(words(&app), "nothing to undo");
}

#[test]
fn a_motion_says_how_far_it_went() {
    for (said, done) in [
        ("mx1.5", "move along x: 1.5"),
        ("mx1.5<Enter>", "move along x: 1.5"),
        ("mll", "move: 1.0 right, 0.0 up"),
        ("mllg", "move: 0.0 right, 0.0 up on the grid"),
        ("tzzl", "rotate about own z: 1.00°"),
        ("tl", "rotate in the picture: 1.00°"),
        ("sk", "scale: ×1.05"),
        ("sxx2", "scale along own x: ×2"),
    ] {
        let (mut app, _) = opened_as("a.ray", RAY);
        app.select(Object(0));
        press(&mut app, said);
        assert_eq!(words(&app), done, "{said}");
    }
}

#[test]
fn every_step_of_a_motion_starts_from_the_text_before_it() {
    let group = XML.replace(
        "    <object type=\"sphere\" name=\"a\">",
        "    <object name=\"g\"><translate z=\"1\"/><object name=\"h\"/></object>\n    <object type=\"sphere\" name=\"a\">",
    );
    let turned = [(
        "<translate z=\"1\"/>",
        "<rotate z=\"1\" angle=\"30\"/><translate z=\"1\"/>",
    )];
    check("a.xml", &group, Object(0), "tz30<Enter>", &turned);
    let moved = [(
        "<object name=\"h\"/>",
        "<object name=\"h\"><translate x=\"12.5\"/></object>",
    )];
    check("a.xml", &group, Object(1), "mx12.5<Enter>", &moved);
    check("a.xml", &group, Object(0), "tz3<Back><Enter>", &[]);
    check("a.xml", &group, Object(0), "t<Enter>", &[]);
}

#[test]
fn every_step_of_a_motion_shows_the_scene_of_its_text() {
    let two = RAY.replace(
        "\n1\nbox",
        "\n2\nsphere 1 2 3 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1\nbox",
    );
    // An ambient reflection above 1 is a warning.
    let warned = two.replace("sphere 1 2 3 1  0 0 0", "sphere 1 2 3 1  2 0 0");
    for (text, node) in [(&two, Object(0)), (&two, Object(1)), (&warned, Object(1))] {
        for said in ["mllkL", "mx12.5", "tz305", "s2", "sl", "mlhhl", "ml<Esc>"] {
            let (mut app, _) = opened_as("a.ray", text);
            assert_eq!(app.diagnostics.is_empty(), *text != warned);
            app.select(node);
            for key in keys(said) {
                app.update(Msg::Key(key));
                let fresh = opened_as("a.ray", app.document.text()).0;
                assert_eq!(app.scene, fresh.scene, "{said}");
                assert_eq!(app.diagnostics, fresh.diagnostics, "{said}");
            }
        }
    }
}

#[test]
fn lights_without_a_position_rotate_their_direction() {
    let direct = XML.replace("point", "direct");
    let direct = direct.replace(
        "<position y=\"5\"/>",
        "<direction x=\"1\" y=\"0\" z=\"0\"/>",
    );
    let turned = [("x=\"1\" y=\"0\" z=\"0\"", "x=\"0\" y=\"1\" z=\"0\"")];
    check("a.xml", &direct, Light(0), "tz90<Enter>", &turned);
    let turned = [("0 0 0  1 0 0  1 1 1", "0 0 0  0 1 0  1 1 1")];
    check("a.dat", LIGHTS, Light(1), "tz90<Enter>", &turned);
    let turned = [("1 0 0  0 0 0  1 1 1", "0 1 0  0 0 0  1 1 1")];
    check("a.dat", LIGHTS, Light(2), "tz90<Enter>", &turned);
}

#[test]
fn what_cannot_be_moved_is_said() {
    for (name, text, node, said, reason) in [
        ("a.ray", RAY, Node::View, "m", "v moves the camera"),
        ("a.ray", RAY, Node::Ambient, "m", "ambient has no position"),
        ("a.ray", RAY, Light(0), "s", "light 1 cannot be scaled"),
        ("a.ray", RAY, Light(0), "t", "light 1 has no direction"),
        ("a.xml", XML, Light(0), "s", "l (point) cannot be scaled"),
        ("a.xml", XML, Light(0), "t", "l (point) has no direction"),
        (
            "a.dat",
            DAT,
            Object(0),
            "t",
            "object 1 (sphere) has no direction",
        ),
        ("a.dat", LIGHTS, Light(0), "s", "light 1 cannot be scaled"),
        ("a.dat", LIGHTS, Light(0), "t", "light 1 has no direction"),
        ("a.dat", LIGHTS, Light(1), "s", "light 2 cannot be scaled"),
        ("a.dat", LIGHTS, Light(1), "m", "light 2 has no position"),
        ("a.dat", LIGHTS, Light(3), "t", "light 4 has no direction"),
        (
            "a.dat",
            DAT,
            Node::View,
            "s",
            "a camera has no size: [ and ] in VIEW change what it sees",
        ),
        (
            "a.dat",
            DAT,
            Object(0),
            "syy2",
            "a sphere has a single radius: change its type to ellipsoid first",
        ),
    ] {
        let (mut app, _) = opened_as(name, text);
        app.select(node);
        press(&mut app, said);
        assert_eq!((words(&app), app.document.text()), (reason, text));
    }
}

#[test]
fn all_marked_things_move_together() {
    let two = DAT.replace(
        "0 0 0  1\n",
        "0 0 0  1\nobj sphere ID 2 mat ID 1  1 0 0  1\n",
    );
    let (mut app, _) = opened_as("a.dat", &two);
    app.select(Object(0));
    press(&mut app, "  mx2<Enter>");
    let moved = two
        .replace("ID 1  0 0 0", "ID 1  2 0 0")
        .replace("ID 1  1 0 0  1\n", "ID 1  3 0 0  1\n");
    assert_eq!(app.document.text(), moved);
}

#[test]
fn a_change_on_disk_ends_a_motion_and_loses_nothing() {
    let (mut app, _) = opened_as("scene.ray", RAY);
    app.select(Object(0));
    press(&mut app, "mx2");
    outside(&mut app, &RAY.replace("5 5 5", "6 6 6"));
    press(&mut app, "l");
    assert!(
        words(&app).contains("the transformation so far is kept"),
        "{}",
        words(&app)
    );
    assert_eq!(
        app.document.text(),
        RAY.replace("5 5 5", "6 6 6")
            .replace("box 0 0 0", "box 2 0 0")
    );
    assert_eq!(app.mode, Mode::Select);
}

#[test]
fn menus_add_things_and_change_their_kind() {
    for (name, text) in [("a.ray", RAY), ("a.dat", DAT), ("a.xml", XML)] {
        let (mut app, _) = opened_as(name, text);
        let before = app.nodes().len();
        press(&mut app, "asphere<Enter>");
        assert!(before < app.nodes().len(), "{name}: {}", words(&app));
        assert!(
            app.source().name(app.cursor.selected()).contains("sphere"),
            "{name}"
        );
        press(&mut app, "u");
        assert_eq!(app.document.text(), text, "{name}");
        press(&mut app, "a<Esc>");
        assert!(app.overlays.menu.is_none());
        press(&mut app, "azzz<Enter>");
        assert!(app.overlays.menu.is_some(), "nothing is chosen");
    }
    let (mut app, _) = opened_as("a.ray", RAY);
    app.select(Object(0));
    press(&mut app, "ccyl<Enter>");
    assert_eq!(app.source().name(Object(0)), "object 1 (cylinder)");
    press(&mut app, "u");
    assert_eq!(app.document.text(), RAY);
    app.select(Light(0));
    press(&mut app, "c");
    assert_eq!(words(&app), "light 1 has only one type");
}

#[test]
fn nothing_is_outlined_until_something_is_selected() {
    let (mut app, _) = opened_as("a.dat", DAT);
    assert!(app.outlined_objects().is_empty());
    press(&mut app, "G");
    assert_eq!(
        (app.cursor.selected(), app.outlined_objects()),
        (Object(0), vec![0])
    );
    let two = DAT.replace(
        "0 0 0  1\n",
        "0 0 0  1\nobj sphere ID 2 mat ID 1  1 0 0  1\n",
    );
    let (mut app, _) = opened_as("a.dat", &two);
    app.select(Node::Material(0));
    assert_eq!(app.outlined_objects(), [0, 1], "the users of a material");
    press(&mut app, "o");
    assert!(app.outlined_objects().is_empty());
}

#[test]
fn added_things_do_not_sink_into_what_is_below() {
    let table = DAT.replace(
        "0 0 0  1\n",
        "0 0 0  1\nobj box ID 2 mat ID 1  0 -1.5 0  1 0 0  0 1 0  0 0 1  90 2 90\n",
    );
    let (mut app, _) = opened_as("a.dat", &table);
    let (_, size) = app.raster().expect("there is room");
    let sphere = pictures::frame(size, vec![0; size.pixels()]);
    app.update(Msg::Frame(Target::Preview, Arc::new(sphere)));
    app.picture_mut()
        .advance(&FrameWindow::whole(size), &[], usize::MAX);
    press(&mut app, "asphere<Enter>");
    let mut lines = app.document.text().lines();
    let last = lines.find(|line| line.starts_with("obj sphere ID 3"));
    let numbers = last.and_then(|line| line.split_once("mat ID 1  "));
    let numbers = numbers.expect("a sphere").1.split_whitespace();
    let numbers: Vec<f64> = numbers.filter_map(|word| word.parse().ok()).collect();
    let [_, y, z, radius] = numbers[..] else {
        panic!("{last:?}");
    };
    // The top of the table is at -0.5.
    assert!(0.5 < radius && 1.0 < z, "{last:?}");
    assert!((y - radius + 0.5).abs() < 0.11, "{last:?}");
}

#[test]
fn added_things_stand_on_the_surface_in_the_middle_of_the_picture() {
    let behind = DAT.replace("0 0 10  0 0 0", "0 0 10  0 0 -50");
    let (mut app, _) = opened_as("a.dat", &behind);
    let (_, size) = app.raster().expect("there is room");
    let sphere = pictures::frame(size, vec![0; size.pixels()]);
    app.update(Msg::Frame(Target::Preview, Arc::new(sphere)));
    app.picture_mut()
        .advance(&FrameWindow::whole(size), &[], usize::MAX);
    press(&mut app, "asphere<Enter>");
    let pose = app.source().pose(app.cursor.selected());
    let centre = pose.expect("it is a sphere").centre;
    // The sphere there has the radius 1.
    assert!(1.0 < centre.z && centre.z < 4.0, "{centre}");
    assert!(centre.x.abs() < 0.5 && centre.y.abs() < 0.5, "{centre}");
}

#[test]
fn a_click_beside_the_picture_confirms_a_motion() {
    let (mut app, _) = opened_as("a.ray", RAY);
    app.select(Object(0));
    press(&mut app, "mx2");
    let list = app.areas().list;
    click(&mut app, list.x + 3, list.y + 2);
    assert!(app.pictures.transform.is_none() && app.mode == Mode::Select);
    assert_eq!(app.document.text(), RAY.replace("box 0 0 0", "box 2 0 0"));
    press(&mut app, "u");
    assert_eq!(app.document.text(), RAY);
}

#[test]
fn the_camera_is_moved_and_rotated_in_its_own_record() {
    let dat = |said, old, new| check("a.dat", DAT, Node::View, said, &[(old, new)]);
    dat("mx2<Enter>", "0 0 10  0 0 0", "2 0 10  2 0 0");
    dat("mzz-1<Enter>", "0 0 10  0 0 0", "0 0 9  0 0 -1");
    // A quarter turn about y looks along −x; about its own z it rolls.
    dat("ty90<Enter>", "0 0 10  0 0 0", "0 0 10  -10 0 10");
    dat("tzz90<Enter>", "0 0 0  0 1 0", "0 0 0  -1 0 0");
    dat("m<Esc>mx1<Enter>", "0 0 10  0 0 0", "1 0 10  1 0 0");
    let xml = |said, changes: &[_]| check("a.xml", XML, Node::View, said, changes);
    xml(
        "mz-2<Enter>",
        &[
            ("<position z=\"10\"/>", "<position z=\"8\"/>"),
            (
                "<target value=\"0\"/>",
                "<target value=\"1\" x=\"0\" y=\"0\" z=\"-2\"/>",
            ),
        ],
    );
    // Steps are as long as a cell shows at the target, and each starts from the camera before.
    let (mut app, _) = opened_as("a.dat", DAT);
    app.select(Node::View);
    press(&mut app, "mll");
    let moved = app.camera().expect("there is a camera").eye.x;
    assert!(0.01 < moved && moved < 1.0, "{moved}");
    press(&mut app, "hh");
    assert_eq!(app.document.text(), DAT);
}

#[test]
fn only_the_mark_moves_where_the_picture_is_seen_from_elsewhere() {
    let (mut app, _) = opened_as("a.dat", DAT);
    app.select(Node::View);
    press(&mut app, "v-<Esc>");
    let (seen, mark) = (app.camera(), app.symbols()[0]);
    press(&mut app, "mx0.1<Enter>");
    assert_eq!(app.camera(), seen);
    assert!(mark.cell.0 < app.symbols()[0].cell.0, "{mark:?}");
    assert_eq!(
        app.document.text(),
        DAT.replace("0 0 10  0 0 0", "0.1 0 10  0.1 0 0")
    );
}

#[test]
fn a_rotated_ellipsoid_becomes_a_quadric_in_the_same_step() {
    let text = DAT.replace(
        "obj sphere ID 1 mat ID 1  0 0 0  1",
        "obj ellipsoid ID 1 mat ID 1  0 0 0  1 2 3",
    );
    check(
        "a.dat",
        &text,
        Object(0),
        "tz90<Enter>",
        &[("1 2 3\n", "2 1 3\n")],
    );
    let (mut app, _) = opened_as("a.dat", &text);
    app.select(Object(0));
    press(&mut app, "tz3");
    assert_eq!(app.source().name(Object(0)), "object 1 (quadric)");
    press(&mut app, "0<Enter>");
    assert_eq!((app.error_count(), words(&app)), (0, "rotate about z: 30°"));
    // Scaled along its own axis it is an ellipsoid still.
    press(&mut app, "sxx2<Enter>");
    assert_eq!(app.error_count(), 0, "{}", app.document.text());
    press(&mut app, "uu");
    assert_eq!(app.document.text(), text);
}

#[test]
fn what_has_to_wait_for_the_end_of_a_motion_says_so() {
    let end = "Enter confirms the change first; Esc cancels it";
    for said in [
        "q",
        "w",
        "u",
        "<F5>",
        "a",
        "E",
        "P",
        ":w<Enter>",
        ":q<Enter>",
        ":wq<Enter>",
    ] {
        let (mut app, _) = opened_as("a.ray", RAY);
        app.select(Object(0));
        press(&mut app, "mx2");
        let effects = press(&mut app, said);
        assert!(effects.is_empty(), "{said} {effects:?}");
        assert_eq!((words(&app), app.mode), (end, Mode::Move), "{said}");
        press(&mut app, "<Esc>");
        assert_eq!(app.document.text(), RAY, "{said}");
    }
    for (said, is_open) in [
        ("?", (|app| app.overlays.help.is_some()) as fn(&App) -> bool),
        (":", |app| app.overlays.prompt.is_some()),
        ("M", |app| app.overlays.history.is_some()),
        (":help<Enter>", |app| app.overlays.help.is_some()),
    ] {
        let (mut app, _) = opened_as("a.ray", RAY);
        app.select(Object(0));
        press(&mut app, "mx2");
        press(&mut app, said);
        assert!(is_open(&app), "{said}");
        press(&mut app, "<Esc><Enter>");
        assert_eq!(
            app.document.text(),
            RAY.replace("box 0 0 0", "box 2 0 0"),
            "{said}"
        );
    }
    let (mut app, _) = opened_as("a.ray", RAY);
    app.select(Object(0));
    assert!(wants(&press(&mut app, "mx2:q!<Enter>"), |effect| matches!(
        effect,
        Effect::Quit
    )));
}
