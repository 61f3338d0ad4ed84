//! What edits write.

use glam::DVec3;

use super::read;
use crate::{Along, Motion, Neighbour, NewNode, Node};
use text::{Edit, apply};

/// A camera and a light, before what is edited.
const HEAD: &str = "camera 0 0 9 0 0 0 0 1 0 45\nsize 8 6\npoint 0 0 5 1 1 1\n";

/// Checks what edits make of a text behind [`HEAD`]; the result must be without errors.
#[track_caller]
fn check(own: &str, edits: impl FnOnce(&crate::Source) -> Vec<Edit>, expected: &str) {
    let mut text = format!("{HEAD}{own}");
    let (source, _) = read(&text);
    let edits = edits(&source);
    apply(&mut text, &edits);
    assert_eq!(text, format!("{HEAD}{expected}"));
    assert_eq!(read(&text).1.diagnostics.errors(), 0, "{text}");
}

const BALL: Node = Node::Object(0);

#[test]
fn names_are_comments_behind() {
    for (own, name, expected) in [
        ("sphere 0 0 0 1", "sun", "sphere 0 0 0 1  # sun"),
        ("sphere 0 0 0 1 # moon\n", "sun", "sphere 0 0 0 1 # sun\n"),
        ("sphere 0 0 0 1  # moon\r\n", "", "sphere 0 0 0 1\r\n"),
        ("sphere 0 0 0 1 #\n", "sun", "sphere 0 0 0 1 #  # sun\n"),
    ] {
        check(
            own,
            |source| source.renaming(BALL, name).expect("it has"),
            expected,
        );
    }
}

#[test]
fn deleting_a_mesh_keeps_its_vertices() {
    let own = "vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\ntri 0 1 2\nvertex 1 1 0\ntri 1 3 2\nsphere 0 0 0 1\n";
    let without = "vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nvertex 1 1 0\nsphere 0 0 0 1\n";
    check(
        own,
        |source| source.removal(&[BALL]).expect("it goes"),
        without,
    );
    let (source, _) = read(&format!("{HEAD}{own}"));
    assert!(source.removal(&[Node::Material(0)]).is_err());
}

#[test]
fn neighbours_exchange_places_unless_the_state_changes_between_them() {
    let swap = |own: &str| {
        let (source, _) = read(&format!("{HEAD}{own}"));
        source
            .exchange(BALL, Neighbour::Next)
            .map(|placed| placed.edits)
    };
    let own = "sphere 0 0 0 1 # a\nsphere 1 0 0 1 # b\n";
    check(
        own,
        |_| swap(own).expect("they do"),
        "sphere 1 0 0 1 # b\nsphere 0 0 0 1 # a\n",
    );
    assert!(swap("sphere 0 0 0 1\ndiffuse 1 0 0\nsphere 1 0 0 1\n").is_err());
}

#[test]
fn what_is_added_stands_where_nothing_stretches_it() {
    let wish = |after| NewNode {
        centre: DVec3::new(1.0, 2.0, 3.0),
        half: 0.5,
        up: DVec3::Z,
        decimals: 2,
        after,
        marked: &[],
        file: None,
    };
    for (own, after, expected) in [
        (
            "sphere 0 0 0 1\n",
            BALL,
            "sphere 0 0 0 1\nsphere 1 2 3  0.5\n",
        ),
        (
            "translate 1 0 0\nscale 2 2 2\nsphere 0 0 0 1",
            BALL,
            "translate 1 0 0\nscale 2 2 2\nsphere 0 0 0 1\nsphere 0 1 1.5  0.25",
        ),
        (
            "pushTransform\nscale 1 2 1\nsphere 0 0 0 1",
            BALL,
            "pushTransform\nscale 1 2 1\nsphere 0 0 0 1\npopTransform\nsphere 1 2 3  0.5",
        ),
    ] {
        check(
            own,
            |source| {
                source
                    .addition("sphere", &wish(after))
                    .expect("it can")
                    .edits
            },
            expected,
        );
    }
}

#[test]
fn copies_stand_behind_what_is_selected() {
    let own = "diffuse 1 0 0\nsphere 0 0 0 1\ndiffuse 0 0 1\nsphere 1 0 0 2\n";
    let copied = |source: &crate::Source| {
        let copy = source.copied(&[BALL]).expect("it can be");
        source.insertion(&copy, BALL).expect("it fits").edits
    };
    let expected = own.replace("sphere 0 0 0 1\n", "sphere 0 0 0 1\nsphere 0 0 0 1\n");
    check(own, copied, &expected);
}

const PILE: &str = "vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nvertex 1 1 0\n";

#[test]
fn a_mesh_ends_where_other_commands_stand_between_its_triangles() {
    for between in ["point 0 0 9 1 1 1\n", "pushTransform\npopTransform\n"] {
        let own = format!("{PILE}tri 0 1 2\n{between}tri 1 3 2\n");
        let by = Motion::Move(DVec3::X);
        let moved = |source: &crate::Source| source.motion(&[BALL], &by, 2).expect("it moves");
        let wrapped = "pushTransform\ntranslate 1 0 0\ntri 0 1 2\npopTransform\n";
        check(&own, moved, &own.replace("tri 0 1 2\n", wrapped));
    }
}

#[test]
fn a_copy_of_a_mesh_is_another_object() {
    let own = format!("{PILE}tri 0 1 2\n");
    let copied = |source: &crate::Source| {
        let copy = source.copied(&[BALL]).expect("it can be");
        source.insertion(&copy, BALL).expect("it fits").edits
    };
    let expected = format!("{own}pushTransform\ntri 0 1 2\npopTransform\n");
    check(&own, copied, &expected);
    let (source, _) = read(&format!("{HEAD}{expected}"));
    assert_eq!(source.nodes().objects(), 2);
    assert_eq!(source.name(BALL), "object 1 (mesh)");
}

#[test]
fn an_object_goes_with_a_push_and_pop_of_its_own() {
    let own = "sphere 1 0 0 1\npushTransform\nscale 1 2 1\nsphere 0 0 0 1\npopTransform\n";
    let removed = |source: &crate::Source| source.removal(&[Node::Object(1)]).expect("it goes");
    check(own, removed, "sphere 1 0 0 1\n");
}

#[test]
fn motions_change_numbers_or_wrap_the_object() {
    let mesh = "vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n  tri 0 1 2\n";
    let turn = Motion::Rotate {
        axis: DVec3::Z,
        angle: 90.0,
        about: DVec3::ZERO,
    };
    let wide = |along| Motion::Scale {
        factor: 2.0,
        along,
        about: DVec3::ZERO,
    };
    let by = Motion::Move(DVec3::new(2.0, 0.0, 0.0));
    for (own, motion, expected) in [
        (
            "sphere 0 0 0 1\n".to_owned(),
            by,
            "sphere 2 0 0 1\n".to_owned(),
        ),
        (
            "scale 2 1 1\nsphere 0 0 0 1\n".to_owned(),
            by,
            "scale 2 1 1\nsphere 1 0 0 1\n".to_owned(),
        ),
        (
            "sphere 3 0 0 1\n".to_owned(),
            turn,
            "sphere 0 3 0 1\n".to_owned(),
        ),
        (
            "sphere 0 0 0 1\n".to_owned(),
            wide(Along::All),
            "sphere 0 0 0 2\n".to_owned(),
        ),
        (
            "sphere 0 0 0 1\n".to_owned(),
            wide(Along::World(1)),
            "pushTransform\nscale 1 2 1\nsphere 0 0 0 1\npopTransform\n".to_owned(),
        ),
        (
            mesh.to_owned(),
            by,
            mesh.replace(
                "  tri 0 1 2",
                "  pushTransform\n  translate 2 0 0\n  tri 0 1 2\n  popTransform",
            ),
        ),
        (
            "pushTransform\n  scale 1 2 1\n  sphere 0 0 0 1\npopTransform\n".to_owned(),
            turn,
            "pushTransform\n  rotate 0 0 1 90\n  scale 1 2 1\n  sphere 0 0 0 1\npopTransform\n"
                .to_owned(),
        ),
    ] {
        let moved = |source: &crate::Source| source.motion(&[BALL], &motion, 2).expect("it moves");
        check(&own, moved, &expected);
    }
}

/// Transforms of one kind about one point become one command, whatever stands behind them.
#[test]
fn repeated_motions_of_a_mesh_change_one_transform() {
    let by = |x: f64, y: f64| Motion::Move(DVec3::new(x, y, 0.0));
    let about = DVec3::new(0.5, 0.5, 0.0);
    let turn = |angle| Motion::Rotate {
        axis: DVec3::Z,
        angle,
        about,
    };
    let scale = |factor, along| Motion::Scale {
        factor,
        along,
        about,
    };
    let (all, own) = (Along::All, Along::Own(0));
    let (there, back) = ("  translate 0.5 0.5 0\n", "  translate -0.5 -0.5 0\n");
    for (motions, expected) in [
        (
            vec![by(1.0, 0.0), by(0.5, 2.0), by(0.1, 0.0)],
            "  translate 1.6 2 0\n".to_owned(),
        ),
        (
            vec![turn(30.0), turn(15.0)],
            format!("{there}  rotate 0 0 1 45\n{back}"),
        ),
        (
            vec![scale(2.0, all), scale(1.5, all)],
            format!("{there}  scale 3 3 3\n{back}"),
        ),
        (
            vec![scale(2.0, own), scale(2.0, own)],
            format!("{there}  scale 4 1 1\n{back}"),
        ),
        (
            vec![by(1.0, 0.0), scale(2.0, own), scale(1.5, own), by(1.0, 0.0)],
            format!("  translate 2 0 0\n{there}  scale 3 1 1\n{back}"),
        ),
        (
            vec![turn(30.0), by(1.0, 0.0)],
            format!("  translate 1.5 0.5 0\n  rotate 0 0 1 30\n{back}"),
        ),
    ] {
        let mesh = |before: &str, behind: &str| {
            format!("{HEAD}vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n{before}  tri 0 1 2\n{behind}")
        };
        let mut text = mesh("", "");
        for motion in &motions {
            let (source, _) = read(&text);
            let edits = source.motion(&[BALL], motion, 2).expect("it moves");
            apply(&mut text, &edits);
        }
        let (push, pop) = ("  pushTransform\n", "  popTransform\n");
        assert_eq!(text, mesh(&format!("{push}{expected}"), pop));
    }
}

/// A value of its own for one object stands in front of it, and what was in force behind it.
#[test]
fn one_object_gets_a_value_of_its_own() {
    let set = |node: Node, key: &'static str, values: &'static [(usize, &'static str)]| {
        move |source: &crate::Source| {
            let fields = source.fields(node);
            let placed = fields.iter().find(|placed| placed.field.key == key);
            let values = values.iter().map(|(at, value)| (*at, (*value).to_owned()));
            placed
                .expect("it has one")
                .edits(&**source, &values.collect::<Vec<_>>())
        }
    };
    let two = "diffuse .5 .5 .5\n  sphere 0 0 0 1\nsphere 2 0 0 1\n";
    for (own, node, key, values, expected) in [
        // Several objects catch the colour.
        (
            two,
            BALL,
            "diffuse",
            &[(0, "1")][..],
            "diffuse .5 .5 .5\n  diffuse 1 .5 .5\n  sphere 0 0 0 1\n  diffuse .5 .5 .5\nsphere 2 0 0 1\n",
        ),
        // No command states it.
        (
            two,
            Node::Object(1),
            "shininess",
            &[(0, "9")],
            "diffuse .5 .5 .5\n  sphere 0 0 0 1\nshininess 9\nsphere 2 0 0 1\nshininess 1\n",
        ),
        // No other object catches it.
        (
            "diffuse .5 .5 .5\nsphere 0 0 0 1",
            BALL,
            "diffuse",
            &[(2, "1")],
            "diffuse .5 .5 1\nsphere 0 0 0 1",
        ),
        // Nothing states a material.
        (
            "sphere 0 0 0 1\nsphere 2 0 0 1",
            Node::Material(0),
            "ambient",
            &[(1, "0")],
            "ambient 0.2 0 0.2\nsphere 0 0 0 1\nsphere 2 0 0 1\nambient 0.2 0.2 0.2",
        ),
        // A mesh of several lines.
        (
            "vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\ntri 0 1 2\nvertex 1 1 0\ntri 1 3 2\nsphere 0 0 0 1\n",
            BALL,
            "emission",
            &[(0, ".1"), (1, ".2")],
            "vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nemission .1 .2 0\ntri 0 1 2\nvertex 1 1 0\n\
             tri 1 3 2\nemission 0 0 0\nsphere 0 0 0 1\n",
        ),
        // A name above, and a push and pop of its own.
        (
            "diffuse 1 1 1\n# sun\nsphere 0 0 0 1\n# moon\nsphere 2 0 0 1\n",
            BALL,
            "diffuse",
            &[(2, "0")],
            "diffuse 1 1 1\ndiffuse 1 1 0\n# sun\nsphere 0 0 0 1\ndiffuse 1 1 1\n# moon\nsphere 2 0 0 1\n",
        ),
        (
            "pushTransform\n\tscale 1 2 1\n\tsphere 0 0 0 1\npopTransform\nsphere 2 0 0 1\n",
            BALL,
            "diffuse",
            &[(2, "1")],
            "diffuse 0 0 1\npushTransform\n\tscale 1 2 1\n\tsphere 0 0 0 1\npopTransform\n\
             diffuse 0 0 0\nsphere 2 0 0 1\n",
        ),
        // The same value.
        (two, BALL, "diffuse", &[(0, ".5")], two),
    ] {
        check(own, set(node, key, values), expected);
    }
}

#[test]
fn values_of_its_own_go_with_an_object() {
    let own = "diffuse 1 1 1\nsphere 2 0 0 1\ndiffuse 0 0 1\nsphere 0 0 0 1\ndiffuse 1 1 1\nsphere 4 0 0 1\n";
    let removed = |source: &crate::Source| source.removal(&[Node::Object(1)]).expect("it goes");
    check(
        own,
        removed,
        "diffuse 1 1 1\nsphere 2 0 0 1\nsphere 4 0 0 1\n",
    );
    // Another value is in force behind it.
    let other = own.replace("diffuse 1 1 1\nsphere 4", "diffuse 1 0 1\nsphere 4");
    check(&other, removed, &other.replace("sphere 0 0 0 1\n", ""));
}

/// Nodes that are set together: a material and its objects, and materials with a command in common.
#[test]
fn a_command_in_common_is_changed_once() {
    let red = "diffuse 1 0 0\nsphere 0 0 0 1\nsphere 2 0 0 1\n";
    let shared = "specular 1 0 0\ndiffuse 1 0 0\nsphere 0 0 0 1\ndiffuse 0 1 0\nsphere 2 0 0 1\n";
    let [material, other] = [0, 1].map(Node::Material);
    for (own, nodes, key, expected) in [
        (
            red,
            [material, BALL],
            "diffuse",
            red.replace("1 0 0\nsphere 0", "0 0 0\nsphere 0"),
        ),
        (
            red,
            [material, BALL],
            "emission",
            format!(
                "{}emission 1 0 0\nsphere 0 0 0 1\nsphere 2 0 0 1\nemission 0 0 0\n",
                "diffuse 1 0 0\n"
            ),
        ),
        (
            "diffuse 1 0 0\nsphere 0 0 0 1\n",
            [material, BALL],
            "diffuse",
            "diffuse 0 0 0\nsphere 0 0 0 1\n".to_owned(),
        ),
        (
            shared,
            [material, other],
            "specular",
            shared.replace("specular 1", "specular 0"),
        ),
    ] {
        let set = |source: &crate::Source| {
            let fields: Vec<_> = nodes.iter().flat_map(|node| source.fields(*node)).collect();
            let fields = fields.iter().filter(|placed| placed.field.key == key);
            let literal = if key == "emission" { "1" } else { "0" };
            let wanted: Vec<_> = fields
                .map(|placed| (placed, vec![(0, literal.to_owned())]))
                .collect();
            source.edits(&wanted)
        };
        check(own, set, &expected);
    }
}

#[test]
fn values_of_a_material_have_an_order_of_their_own() {
    let (source, _) = read(&format!(
        "{HEAD}shininess 3\ndiffuse 1 0 0\nsphere 0 0 0 1\n"
    ));
    for node in [Node::Material(0), BALL] {
        let keys: Vec<_> = source
            .fields(node)
            .iter()
            .map(|placed| placed.field.key)
            .collect();
        assert!(
            keys.ends_with(&["ambient", "diffuse", "specular", "shininess", "emission"]),
            "{keys:?}"
        );
    }
}

#[test]
fn lights_change_their_kind() {
    let light = Node::Light(1);
    for (own, kind, expected) in [
        (
            "point 1 2 3 1 1 1\n",
            "directional",
            "directional 1 2 3 1 1 1\n",
        ),
        (
            "point 0 0 0 1 1 1\n",
            "directional",
            "directional 0 1 0 1 1 1\n",
        ),
        (
            "Directional 0 0 1  1 1 1 # sun\n",
            "point",
            "point 0 0 1  1 1 1 # sun\n",
        ),
    ] {
        let text = format!("{HEAD}{own}");
        assert_eq!(read(&text).0.kinds(light), ["point", "directional"]);
        check(
            own,
            |source| source.retyping(light, kind).expect("it can"),
            expected,
        );
    }
}
