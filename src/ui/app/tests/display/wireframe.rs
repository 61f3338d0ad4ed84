//! The wireframe: when it is shown, what is traced meanwhile, and that it follows.

use super::rows::scene;
use super::*;
use crate::render::WireLine;
use crate::ui::app::display;

const SCENES: [(&str, &str); 3] = [
    (
        "a.ray",
        "// view: eye 0 0 10 target 0 0 0 up 0 1 0 fov 60 size 400 300\n0 0 0\n1\n5 5 5  1 1 1\n1\n\
         box 0 0 0  1 0 0  0 1 0  0 0 1  1 1 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1\n",
    ),
    (
        "a.dat",
        "camera perspective 0 0 10  0 0 0  0 1 0  1 0 100\nmat ID 1  1 1 1  .3 .5 .2 9  0 0 1\n\
         obj box ID 1 mat ID 1  .5 .5 .5  1 0 0  0 1 0  0 0 1  1 1 1\n",
    ),
    (
        "a.xml",
        "<xml><scene><object type=\"sphere\"/></scene><camera><position z=\"10\"/><target value=\"0\"/></camera></xml>",
    ),
];

/// The lines on screen.
fn lines(app: &mut App) -> Vec<WireLine> {
    display::follow_wires(&mut app.shared);
    let (_, size) = app.shared.raster().expect("there is room");
    let wireframe = app
        .shared
        .wireframe()
        .and_then(|wireframe| wireframe.lines(size));
    wireframe.map_or_else(Vec::new, |wireframe| wireframe.lines.clone())
}

#[test]
fn the_wireframe_replaces_the_preview_until_another_view_is_chosen() {
    for (name, text) in SCENES {
        let mut session = scene(name, text).session();
        for (said, has_lines) in [
            ("| not errors", false),
            ("6 | does trace preview | job aov object spp 1", true),
            // It is shown already.
            ("6 | not does", true),
            // What is traced at full size, or exported, is light.
            ("<F5> | does recall | job aov none", false),
            ("<Esc>", true),
            ("2 | does trace preview | job aov depth", false),
        ] {
            session.run(said);
            assert_eq!(
                !lines(&mut session.app).is_empty(),
                has_lines,
                "{name} {said}"
            );
        }
        session.run("| text opened");
    }
}

#[test]
fn the_wireframe_follows_the_camera_and_the_text_at_once() {
    for (name, text) in SCENES {
        let (mut app, _) = opened_as(name, text);
        app.shared.select(crate::language::Node::Object(0));
        press(&mut app, "6");
        let mut before = lines(&mut app);
        for said in ["v", "l", "<Esc>mx1", "<Esc>", "v0"] {
            press(&mut app, said);
            let after = lines(&mut app);
            assert_eq!(
                after == before,
                said == "v" || said == "<Esc>",
                "{name} {said}"
            );
            before = if said == "<Esc>mx1" { before } else { after };
        }
    }
}

#[test]
fn the_edges_of_a_unit_cube_are_at_known_pixels() {
    let (mut app, _) = opened_as(SCENES[0].0, SCENES[0].1);
    press(&mut app, "6");
    let (_, size) = app.shared.raster().expect("there is room");
    // At the origin the picture is 2 · 10 · tan 30° high.
    let unit = f64::from(size.height) / (20.0 * (30.0_f64).to_radians().tan());
    let middle = [f64::from(size.width), f64::from(size.height)].map(|side| side / 2.0);
    let lines = lines(&mut app);
    assert_eq!(lines.len(), 12);
    let expected = [middle, [middle[0], middle[1] - unit]];
    let is_near = |line: &WireLine| {
        let pairs = line.ends.as_flattened().iter().zip(expected.as_flattened());
        pairs.into_iter().all(|(is, want)| (is - want).abs() < 0.05)
    };
    assert!(lines.iter().any(is_near), "{expected:?} in {lines:?}");
}
