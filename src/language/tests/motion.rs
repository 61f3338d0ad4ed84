//! Adding, changing the kind of, moving, turning and scaling things in all languages.

use glam::DVec3;

use super::read_as;
use crate::{Along, Language, Motion, NewNode, Node, Source, StructureError};
use geometry::Aabb;
use scene::{Meshes, Scene};
use text::Edit;

const RAY: &str = include_str!("../../../scenes/default.ray");
const DAT: &str = include_str!("../../../scenes/still-life.dat");
const XML: &str = include_str!("../../../scenes/courtyard.xml");
const TEST: &str = include_str!("../../../tests/it/cse167/tower.test");
const SCENES: [(Language, &str); 4] = [
    (Language::Ray, RAY),
    (Language::Dat, DAT),
    (Language::Xml, XML),
    (Language::Cse167, TEST),
];

/// Makes edits and returns the new source and its scene, which must be without errors and without
/// more warnings.
#[track_caller]
pub(super) fn changed(language: Language, text: &str, edits: &[Edit]) -> (Source, Scene) {
    let (mut source, lowered) = read_as(language, text, &Meshes::default());
    let before = lowered.diagnostics.len();
    source.change(edits);
    let lowered = source.lower(&Meshes::default()).expect("there is memory");
    let diagnostics = &lowered.diagnostics;
    assert!(
        diagnostics.len() <= before,
        "{}\n{diagnostics:?}",
        source.text()
    );
    let scene = lowered.scene.expect("there are no errors");
    (source, scene)
}

fn wish(after: Node, marked: &[Node]) -> NewNode<'_> {
    NewNode {
        centre: DVec3::new(0.25, 0.5, 1.0),
        half: 0.5,
        up: DVec3::Z,
        decimals: 2,
        after,
        marked,
        file: None,
    }
}

#[test]
fn everything_can_be_added_anywhere() {
    for (language, text) in SCENES {
        let (source, _) = read_as(language, text, &Meshes::default());
        let additions = source.additions();
        assert!(2 < additions.len());
        for after in source.nodes().iter() {
            for addition in additions {
                let marked = [Node::Object(0), Node::Object(1)];
                let placed = source.addition(addition.name, &wish(after, &marked));
                let placed = placed.expect("it can be added");
                // A missing picture or mesh is a warning of the files, not of the text.
                let (changed, _) = changed(language, text, &placed.edits);
                let (old, new) = (source.nodes().len(), changed.nodes().len());
                assert!(old < new, "{} after {after:?}", addition.name);
            }
        }
    }
}

#[test]
fn added_solids_have_the_place_and_the_size_that_were_wished_for() {
    for (language, text) in SCENES {
        let (source, lowered) = read_as(language, text, &Meshes::default());
        let old = lowered.scene.expect("it has no errors").objects.len();
        for addition in source.additions() {
            let wish = wish(Node::View, &[]);
            let Ok(placed) = source.addition(addition.name, &wish) else {
                continue;
            };
            let (_, scene) = changed(language, text, &placed.edits);
            let added = scene.objects.get(old).filter(|_| addition.name != "mesh");
            let Some(added) = added else { continue };
            let bounds = added.shape.bounds();
            let centre = bounds.centre();
            assert!(
                (centre - wish.centre).length() < 1e-9,
                "{} {bounds:?}",
                addition.name
            );
            let half = 0.5 * (bounds.max - bounds.min);
            assert!(
                (half.max_element() - wish.half).abs() < 1e-6,
                "{} {bounds:?}",
                addition.name
            );
        }
    }
}

#[test]
fn a_combination_needs_two_marked_objects() {
    let (source, _) = read_as(Language::Dat, DAT, &Meshes::default());
    let refused = source.addition("union", &wish(Node::View, &[Node::Object(0)]));
    let reason = "a union combines two objects: mark them first";
    assert_eq!(
        refused,
        Err(StructureError::Inexpressible(reason.to_owned()))
    );
}

#[test]
fn new_text_is_laid_out_like_its_neighbours() {
    let material = "0 0 0  .5 .5 .5  0 0 0  1  0  0  1";
    let old = "0 0 0  1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1";
    let line = format!("1 1 1\n1\n0 5 5 1 1 1\n1\n  sphere {old}\n");
    let (source, _) = read_as(Language::Ray, &line, &Meshes::default());
    let placed = source
        .addition("sphere", &wish(Node::Object(0), &[]))
        .expect("it can be added");
    let (source, _) = changed(Language::Ray, &line, &placed.edits);
    let expected = format!(
        "1 1 1\n1\n0 5 5 1 1 1\n2\n  sphere {old}\n  sphere  0.25 0.5 1  0.5  {material}\n"
    );
    assert_eq!(**source.text(), expected);

    let lines = format!("1 1 1\r\n1\r\n0 5 5 1 1 1\r\n1\r\n\r\nsphere // a\r\n{old}\r\n");
    let (source, _) = read_as(Language::Ray, &lines, &Meshes::default());
    let placed = source
        .addition("sphere", &wish(Node::Object(0), &[]))
        .expect("it can be added");
    let (source, _) = changed(Language::Ray, &lines, &placed.edits);
    // All numbers share the line after the keyword.
    let material = "0 0 0  .5 .5 .5  0 0 0  1 0 0 1";
    assert!(
        source.text().ends_with(&format!(
            "{old}\r\n\r\nsphere\r\n0.25 0.5 1  0.5  {material}\r\n"
        )),
        "{:?}",
        source.text()
    );
}

#[test]
fn a_solid_keeps_its_place_and_size_when_its_kind_changes() {
    for (language, text) in [(Language::Ray, RAY), (Language::Dat, DAT)] {
        let (source, lowered) = read_as(language, text, &Meshes::default());
        let scene = lowered.scene.expect("it has no errors");
        let mut count = 0;
        for node in source.nodes().iter() {
            let Node::Object(index) = node else { continue };
            let Some(drawn) = source.drawn(index) else {
                continue;
            };
            let before = scene.objects.get(drawn as usize).expect("it is drawn");
            for kind in source.kinds(node) {
                let Ok(edits) = source.retyping(node, kind) else {
                    continue;
                };
                let (source, scene) = changed(language, text, &edits);
                assert!(source.name(node).contains(kind), "{}", source.name(node));
                let after = scene.objects.get(drawn as usize).expect("it is drawn");
                let (old, new) = (before.shape.bounds(), after.shape.bounds());
                let size = (old.max - old.min).length();
                assert!(
                    (old.centre() - new.centre()).length() < 0.5 * size,
                    "{node:?} {kind} {old:?} {new:?}"
                );
                count += 1;
            }
        }
        assert!(20 < count, "{count}");
    }
}

#[test]
fn sizes_of_one_form_survive_a_change_of_kind_exactly() {
    let boxed = "1 1 1 1 0 5 5 1 1 1 1\nbox -1 -2 -3  1 0 0  0 1 0  0 0 1  2 4 6 0 0 0 .5 .5 .5 0 0 0 1 0 0 1\n";
    let (source, _) = read_as(Language::Ray, boxed, &Meshes::default());
    for (kind, expected) in [
        (
            "ellipsoid",
            "ellipsoid  0 0 0  1 0 0  0 1 0  0 0 1  1  2  3 0 0 0 .5 .5 .5 0 0 0 1 0 0 1\n",
        ),
        (
            "cylinder",
            "cylinder  0 0 -3  1 0 0  0 1 0  0 0 1  1  2  6 0 0 0 .5 .5 .5 0 0 0 1 0 0 1\n",
        ),
    ] {
        let edits = source
            .retyping(Node::Object(0), kind)
            .expect("it can be changed");
        let (source, _) = changed(Language::Ray, boxed, &edits);
        let lines: Vec<_> = source.text().lines().collect();
        assert_eq!(format!("{}\n", lines[1]), expected);
    }
}

#[test]
fn a_change_of_kind_writes_no_rounding_errors() {
    // -1.08 - 0.7 is -1.7799999999999998 in binary fractions.
    let ball = "1 1 1 1 0 5 5 1 1 1 1\nsphere -3.6 2.9 -1.08 0.7 0 0 0 .5 .5 .5 0 0 0 1 0 0 1\n";
    let (source, _) = read_as(Language::Ray, ball, &Meshes::default());
    let edits = source
        .retyping(Node::Object(0), "box")
        .expect("it can be changed");
    let (source, _) = changed(Language::Ray, ball, &edits);
    let line = source.text().lines().nth(1).expect("an object");
    assert!(line.starts_with("box  -4.3 2.2 -1.78  "), "{line}");
}

/// The bounds of what a node draws, by its number in the scene.
fn bounds(scene: &Scene, source: &Source, node: Node) -> Option<Aabb> {
    let Node::Object(index) = node else {
        return None;
    };
    let drawn = source.drawn(index)?;
    Some(scene.objects.get(drawn as usize)?.shape.bounds())
}

#[test]
fn things_move_as_far_as_they_are_told_and_back() {
    let by = DVec3::new(0.5, -0.25, 1.0);
    for (language, text) in SCENES {
        let (source, lowered) = read_as(language, text, &Meshes::default());
        let scene = lowered.scene.expect("it has no errors");
        for node in source.nodes().iter() {
            let Ok(edits) = source.motion(&[node], &Motion::Move(by), 6) else {
                continue;
            };
            let (moved, after) = changed(language, text, &edits);
            if let (Some(old), Some(new)) = (source.pose(node), moved.pose(node)) {
                assert!((new.centre - old.centre - by).length() < 2e-6, "{node:?}");
            }
            if let Some(old) = bounds(&scene, &source, node).filter(|old| old.is_bounded()) {
                let new = bounds(&after, &moved, node).expect("it is still drawn");
                let off = (new.centre() - old.centre() - by).length();
                assert!(off < 2e-6, "{language:?} {node:?} {off}");
            }
            let back = moved
                .motion(&[node], &Motion::Move(-by), 6)
                .expect("it moves back");
            let (_, again) = changed(language, moved.text(), &back);
            if let Some(old) = bounds(&scene, &source, node).filter(|old| old.is_bounded()) {
                let new = bounds(&again, &moved, node).expect("it is still drawn");
                assert!((new.centre() - old.centre()).length() < 4e-6);
            }
        }
    }
}

#[test]
fn four_quarter_turns_about_its_centre_put_a_thing_back() {
    for (language, text) in SCENES {
        let (source, lowered) = read_as(language, text, &Meshes::default());
        let scene = lowered.scene.expect("it has no errors");
        let mut turned = 0;
        for node in source.nodes().iter() {
            let Some(pose) = source.pose(node) else {
                continue;
            };
            let axis = DVec3::new(1.0, 2.0, 2.0) / 3.0;
            let turn = Motion::Rotate {
                axis,
                angle: 90.0,
                about: pose.centre,
            };
            let mut current = read_as(language, text, &Meshes::default()).0;
            let mut last = None;
            for _ in 0..4 {
                let Ok(edits) = current.motion(&[node], &turn, 9) else {
                    break;
                };
                let (next, scene) = changed(language, current.text(), &edits);
                current = next;
                last = Some(scene);
            }
            let Some(last) = last else { continue };
            turned += 1;
            if let Some(old) = bounds(&scene, &source, node).filter(|old| old.is_bounded()) {
                let new = bounds(&last, &current, node).expect("it is still drawn");
                let off = (new.min - old.min).length() + (new.max - old.max).length();
                // Each turn may leave out digits worth 5e-5 of the thing's size, at both corners.
                assert!(
                    off < 4e-4 * (1.0 + old.max.length()),
                    "{language:?} {node:?} {old:?} {new:?}"
                );
            }
        }
        assert!(3 < turned, "{language:?} {turned}");
    }
}

#[test]
fn ten_thousand_turns_in_the_text_skew_nothing() {
    let boxed = "1 1 1 1 0 5 5 1 1 1 1\nbox -1 -2 -3  1 0 0  0 1 0  0 0 1  2 4 6 0 0 0 .5 .5 .5 0 0 0 1 0 0 1\n";
    let group =
        "<xml><scene><object type=\"sphere\"><rotate z=\"1\" angle=\"0\"/></object></scene></xml>";
    for (language, text) in [(Language::Ray, boxed), (Language::Xml, group)] {
        let (mut source, _) = read_as(language, text, &Meshes::default());
        let axis = DVec3::new(2.0, 3.0, 6.0) / 7.0;
        let node = Node::Object(0);
        for _ in 0..1000 {
            let about = source.pose(node).expect("it has a place").centre;
            let turn = Motion::Rotate {
                axis,
                angle: 36.0,
                about,
            };
            let edits = source.motion(&[node], &turn, 12).expect("it can be turned");
            source.change(&edits);
            source.lower(&Meshes::default()).expect("there is memory");
        }
        let pose = source.pose(node).expect("it has a place");
        let [a, b, c] = pose.axes;
        let drift = [
            a.dot(b),
            a.dot(c),
            b.dot(c),
            a.length() - 1.0,
            b.length() - 1.0,
            c.length() - 1.0,
        ];
        assert!(
            drift.iter().all(|drift| drift.abs() < 1e-4),
            "{language:?} {drift:?}"
        );
        // A thousand turns of 36° are a hundred whole ones; the digits left out do not add up.
        assert!((a - DVec3::X).length() < 2e-4, "{language:?} {a}");
    }
}

#[test]
fn scaling_about_the_centre_multiplies_the_size() {
    for (language, text) in SCENES {
        let (source, lowered) = read_as(language, text, &Meshes::default());
        let scene = lowered.scene.expect("it has no errors");
        for node in source.nodes().iter() {
            let (Some(pose), Some(old)) = (source.pose(node), bounds(&scene, &source, node)) else {
                continue;
            };
            let about = pose.centre;
            for along in [Along::All, Along::Own(0), Along::World(2)] {
                let scale = Motion::Scale {
                    factor: 1.5,
                    along,
                    about,
                };
                let Ok(edits) = source.motion(&[node], &scale, 9) else {
                    continue;
                };
                let (moved, after) = changed(language, text, &edits);
                let new = bounds(&after, &moved, node).expect("it is still drawn");
                let (old, new) = (old.max - old.min, new.max - new.min);
                let expected = match along {
                    Along::All => 1.5 * old,
                    Along::World(_) => old * DVec3::new(1.0, 1.0, 1.5),
                    Along::Own(_) => continue,
                };
                assert!(
                    (new - expected).length() < 1e-6 * old.length(),
                    "{language:?} {node:?} {along:?} {old} {new}"
                );
            }
        }
    }
}

#[test]
fn what_a_language_cannot_express_is_refused() {
    let about = DVec3::ZERO;
    let stretch = |along| Motion::Scale {
        factor: 2.0,
        along,
        about,
    };
    let turn = Motion::Rotate {
        axis: DVec3::Z,
        angle: 30.0,
        about,
    };
    let sphere = "1 1 1 1 0 5 5 1 1 1 1 sphere 0 0 0 1 0 0 0 .5 .5 .5 0 0 0 1 0 0 1";
    let skewed =
        "<xml><scene><object><scale x=\"2\"/><object type=\"sphere\"/></object></scene></xml>";
    for (language, text, node, motion, reason) in [
        (
            Language::Ray,
            sphere,
            Node::Object(0),
            stretch(Along::Own(0)),
            "a sphere has a single radius: change its type to ellipsoid first",
        ),
        (
            Language::Ray,
            sphere,
            Node::Ambient,
            stretch(Along::All),
            "ambient has no position",
        ),
        (
            Language::Xml,
            skewed,
            Node::Object(1),
            turn,
            "its group is scaled non-uniformly: rotate the group instead",
        ),
    ] {
        let (source, _) = read_as(language, text, &Meshes::default());
        let refused = source.motion(&[node], &motion, 3);
        assert_eq!(
            refused,
            Err(StructureError::Inexpressible(reason.to_owned()))
        );
    }
}

/// A `.dat` with one object.
fn dat(object: &str) -> String {
    format!("mat ID 1 1 1 1 .1 .5 .4 9 0 0 1\nobj {object}\n")
}

#[test]
fn a_dat_ellipsoid_rotates_exactly_as_a_quadric() {
    let text = dat("ellipsoid ID 1 mat ID 1 1 0 0 1 2 3");
    let (source, _) = read_as(Language::Dat, &text, &Meshes::default());
    let node = Node::Object(0);
    let turn = Motion::Rotate {
        axis: DVec3::Z,
        angle: 30.0,
        about: DVec3::X,
    };
    let edits = source.motion(&[node], &turn, 3).expect("it turns");
    let (turned, scene) = changed(Language::Dat, &text, &edits);
    assert_eq!(turned.name(node), "object 1 (quadric)");
    let bounds = scene.objects[0].shape.bounds();
    let (sin, cos) = 30.0_f64.to_radians().sin_cos();
    let half = DVec3::new(cos.hypot(2.0 * sin), sin.hypot(2.0 * cos), 3.0);
    assert!((bounds.max - DVec3::X - half).length() < 1e-8, "{bounds:?}");
    let pose = turned.pose(node).expect("it has a place");
    assert!((pose.centre - DVec3::X).length() < 1e-12);
    let own = DVec3::new(cos, sin, 0.0);
    assert!((pose.axes[0] - own).length() < 1e-12, "{pose:?}");
    // Twice as long along its own x, which then ends there.
    let stretch = Motion::Scale {
        factor: 2.0,
        along: Along::Own(0),
        about: pose.centre,
    };
    let edits = turned.motion(&[node], &stretch, 3).expect("it stretches");
    let (_, scene) = changed(Language::Dat, turned.text(), &edits);
    let bounds = scene.objects[0].shape.bounds();
    let half = DVec3::new(
        (2.0 * cos).hypot(2.0 * sin),
        (2.0 * sin).hypot(2.0 * cos),
        3.0,
    );
    assert!((bounds.max - DVec3::X - half).length() < 1e-8, "{bounds:?}");
}

#[test]
fn a_quadric_has_principal_axes_and_a_place() {
    let x = DVec3::new(0.8, 0.6, 0.0);
    for (numbers, centre, axes) in [
        // An ellipsoid, a cylinder along z with cuts at 1 and 3, and one without.
        ("1 0 0 -1 4 0 0 9 0 0  0", DVec3::X, DVec3::AXES),
        (
            "1 0 0 -2 1 0 0 0 0 0  2 0 0 1 3 0 0 -1 -1",
            DVec3::new(2.0, 0.0, 2.0),
            DVec3::AXES,
        ),
        ("1 0 0 0 1 0 0 0 0 -1  0", DVec3::ZERO, DVec3::AXES),
        // (x/2)² + y² in a frame turned by the angle of 3, 4 and 5.
        (
            "0.52 -0.36 0 0 0.73 0 0 1 0 -1  0",
            DVec3::ZERO,
            [x, DVec3::new(-0.6, 0.8, 0.0), DVec3::Z],
        ),
    ] {
        let text = dat(&format!("quadric ID 1 mat ID 1 {numbers}"));
        let (source, lowered) = read_as(Language::Dat, &text, &Meshes::default());
        assert_eq!(lowered.diagnostics.errors(), 0, "{numbers}");
        let pose = source.pose(Node::Object(0)).expect("it has a place");
        assert!(
            (pose.centre - centre).length() < 1e-12,
            "{numbers}: {pose:?}"
        );
        for (own, expected) in pose.axes.into_iter().zip(axes) {
            assert!((own - expected).length() < 1e-12, "{numbers}: {pose:?}");
        }
    }
}
