//! Numbers that motions write, as a hand would.

use glam::DVec3;

use super::motion::changed;
use super::read_as;
use crate::{Along, Language, Motion, Node};
use scene::Meshes;

#[test]
fn what_is_turned_and_scaled_has_the_digits_of_a_hand() {
    const HEAD: &str = "1 1 1 1 0 5 5 1 1 1 1\n";
    const MATERIAL: &str = "0 0 0 .5 .5 .5 0 0 0 1 0 0 1";
    let about = DVec3::ZERO;
    let turn = |angle| Motion::Rotate {
        axis: DVec3::Z,
        angle,
        about,
    };
    let grow = |factor| Motion::Scale {
        factor,
        along: Along::All,
        about,
    };
    let cube = "box 0 0 0  1 0 0  0 1 0  0 0 1  1 1 1";
    for (solid, motion, expected) in [
        (
            cube,
            turn(30.0),
            "box 0 0 0  0.866 0.5 0  -0.5 0.866 0  0 0 1  1 1 1",
        ),
        (
            cube,
            turn(45.0),
            "box 0 0 0  0.707 0.707 0  -0.707 0.707 0  0 0 1  1 1 1",
        ),
        (
            cube,
            turn(15.0),
            "box 0 0 0  0.9659 0.2588 0  -0.2588 0.9659 0  0 0 1  1 1 1",
        ),
        // A small turn needs more.
        (
            cube,
            turn(0.01),
            "box 0 0 0  1 0.000175 0  -0.000175 1 0  0 0 1  1 1 1",
        ),
        // What does not turn keeps its digits.
        (
            "box 0 0 0.123456789  1 0 0  0 1 0  0 0 1.00001  1 1 1",
            turn(90.0),
            "box 0 0 0.123456789  0 1 0  -1 0 0  0 0 1.00001  1 1 1",
        ),
        ("sphere 0 0 0  0.7", grow(1.0 / 3.0), "sphere 0 0 0  0.2333"),
        ("sphere 0 0 0  0.0007", grow(1.5), "sphere 0 0 0  0.00105"),
        ("sphere 3 0 0  300", grow(1.5), "sphere 4.5 0 0  450"),
    ] {
        let text = format!("{HEAD}{solid} {MATERIAL}\n");
        let (source, _) = read_as(Language::Ray, &text, &Meshes::default());
        let edits = source.motion(&[Node::Object(0)], &motion, 4);
        let (source, _) = changed(Language::Ray, &text, &edits.expect("it can be moved"));
        let expected = format!("{HEAD}{expected} {MATERIAL}\n");
        assert_eq!(**source.text(), expected, "{motion:?}");
    }
}

#[test]
fn rotations_of_elements_have_the_digits_of_a_hand() {
    for (angle, axis, expected) in [
        (30.0, DVec3::Y, "<rotate y=\"1\" angle=\"30\"/>"),
        (
            40.0,
            DVec3::new(1.0, 2.0, 2.0) / 3.0,
            "<rotate x=\"0.3333\" y=\"0.6667\" z=\"0.6667\" angle=\"40\"/>",
        ),
    ] {
        let text = "<xml><scene><object type=\"sphere\"></object></scene></xml>";
        let (source, _) = read_as(Language::Xml, text, &Meshes::default());
        let about = DVec3::ZERO;
        let turn = Motion::Rotate { axis, angle, about };
        let edits = source.motion(&[Node::Object(0)], &turn, 4);
        let (source, _) = changed(Language::Xml, text, &edits.expect("it can be turned"));
        assert!(source.text().contains(expected), "{}", source.text());
    }
}
