//! Showing lights and objects alone in the preview.

use std::sync::Arc;

use super::*;
use crate::language::Node::{self, Light, Object};
use crate::render::{Job, NO_OBJECT};
use crate::ui::msg::Target;

const RAY: &str = "\
0.1 0.1 0.1
2
5 5 5  1 1 1
-5 5 5  1 0 0
3
sphere 0 0 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1
sphere 4 0 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1
sphere 8 0 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1
";

const DAT: &str = "\
mat ID 1  1 1 1  .3 .5 .2 9  0 0 1
obj sphere ID 1 mat ID 1  0 0 0  1
obj sphere ID 2 mat ID 1  1 0 0  1
obj CSG ID 3 union ID 1 ID 2
obj sphere ID 4 mat ID 1  3 0 0  1
render 2 ID 3 ID 4
";

const XML: &str = "\
<xml><scene>
  <object type='sphere' name='c'/>
  <object name='pair'>
    <object name='inner'><object type='sphere' name='a'/></object>
    <object type='sphere' name='b'/>
  </object>
</scene><camera><position z='9'/></camera></xml>
";

fn traced(effects: &[Effect]) -> &Job {
    let job = effects.iter().find_map(|effect| match effect {
        Effect::Trace(_, job) => Some(job),
        _ => None,
    });
    job.expect("a picture is traced")
}

/// Presses keys with a node selected; the objects that the last picture shows alone.
fn solo(name: &str, text: &str, node: Node, said: &str) -> Option<Vec<u32>> {
    let mut app = opened_as(name, text).0;
    app.select(node);
    let effects = press(&mut app, said);
    let job = traced(&effects);
    assert_eq!(app.document.text(), text);
    let numbers = job.numbers.as_ref().map(|numbers| numbers.to_vec());
    if let Some(numbers) = &numbers {
        assert_eq!(job.scene.objects.len(), numbers.len());
    }
    assert_eq!(app.pictures.solo.is_some(), numbers.is_some());
    numbers
}

#[test]
fn objects_are_shown_alone_by_their_numbers_in_the_scene() {
    for (name, text, node, said, shown) in [
        ("a.ray", RAY, Object(1), "l", Some(vec![1])),
        ("a.ray", RAY, Object(0), "  l", Some(vec![0, 1])),
        ("a.dat", DAT, Object(2), "l", Some(vec![0])),
        ("a.dat", DAT, Object(3), "l", Some(vec![1])),
        ("a.xml", XML, Object(1), "l", Some(vec![1, 2])),
        ("a.xml", XML, Object(2), "l", Some(vec![1])),
    ] {
        assert_eq!(
            solo(name, text, node, said),
            shown,
            "{name} {node:?} {said}"
        );
    }
}

#[test]
fn l_again_shows_everything() {
    for (name, text, node) in [
        ("a.ray", RAY, Object(1)),
        ("a.dat", DAT, Object(2)),
        ("a.xml", XML, Object(1)),
    ] {
        let mut app = opened_as(name, text).0;
        app.select(node);
        press(&mut app, "l");
        let effects = press(&mut app, "l");
        assert_eq!(traced(&effects).numbers, None, "{name}");
        assert_eq!(words(&app), "everything is shown again");
    }
}

#[test]
fn what_is_shown_alone_follows_the_selection_and_ends_with_its_indices() {
    let mut app = opened_as("a.ray", RAY).0;
    press(&mut app, "l");
    let effects = press(&mut app, "jl");
    assert_eq!(traced(&effects).numbers.as_deref(), Some(&[1][..]));
    let effects = press(&mut app, "d");
    assert_eq!(traced(&effects).numbers, None);
    assert_eq!(app.pictures.solo, None);
    // The view ends it as well.
    press(&mut app, "lggl");
    assert_eq!(app.pictures.solo, None);
}

#[test]
fn what_cannot_be_shown_alone_is_said() {
    for (name, text, node, reason) in [
        (
            "a.ray",
            RAY,
            Node::View,
            "only lights, objects and groups can be shown alone",
        ),
        (
            "a.dat",
            DAT,
            Object(0),
            "object 1 (sphere) is not drawn: h shows it",
        ),
    ] {
        let mut app = opened_as(name, text).0;
        app.select(node);
        press(&mut app, "l");
        assert_eq!(words(&app), reason, "{name}");
        assert_eq!(app.pictures.solo, None);
    }
}

#[test]
fn picking_in_a_picture_of_one_object_selects_it() {
    let mut app = opened_as("a.ray", RAY).0;
    app.select(Object(2));
    press(&mut app, "l");
    let (_, size) = app.raster().expect("there is room");
    // The renderer calls the only object by its number.
    let frame = pictures::frame(size, vec![2; size.pixels()]);
    app.update(Msg::Frame(Target::Preview, Arc::new(frame)));
    app.picture_mut()
        .advance(&FrameWindow::whole(size), &[], usize::MAX);
    assert_eq!(app.node_at([0, 0]), Ok(Some(Object(2))));
    let nothing = pictures::frame(size, vec![NO_OBJECT; size.pixels()]);
    app.update(Msg::Frame(Target::Preview, Arc::new(nothing)));
    app.picture_mut()
        .advance(&FrameWindow::whole(size), &[], usize::MAX);
    assert_eq!(app.node_at([0, 0]), Ok(None));
}

#[test]
fn a_light_is_shown_alone_in_the_preview_and_nowhere_else() {
    let (mut app, _) = opened_as("a.ray", RAY);
    app.select(Light(1));
    let colours = |effects: &[Effect]| {
        let (_, job) = effects
            .iter()
            .find_map(traced_by)
            .expect("a picture is traced");
        let reds: Vec<_> = job
            .scene
            .lights
            .iter()
            .map(|light| light.colour.x)
            .collect();
        (job.scene.ambient.x, reds)
    };
    assert_eq!(colours(&press(&mut app, "l")), (0.0, vec![0.0, 1.0]));
    assert_eq!(app.document.text(), RAY);
    assert_eq!(colours(&press(&mut app, "<F5>")).1, [1.0, 1.0]);
    press(&mut app, "<Esc>");
    assert_eq!(colours(&press(&mut app, "l")), (0.1, vec![1.0, 1.0]));
    press(&mut app, "ld");
    assert_eq!(app.pictures.solo, None, "the light is gone");
}
