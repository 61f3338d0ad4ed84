//! Edits of fields change only those fields, and undoing them restores every byte.

use super::{EXAMPLE, around, read};
use crate::field_spans::FieldSpans;
use crate::node::Node;
use crate::schema::Kind;
use crate::tests::Random;
use scene::{Camera, Lens, Size};
use text::{Edit, apply, parse_number};

/// A scene with every kind of element.
pub(super) const RICH: &str = "<?xml version=\"1.0\"?>\r\n<xml>\r\n  <scene>\r\n    <!-- things -->\r\n    \
    <object type=\"sphere\" name=\"a &amp; b\" material='m'>\r\n      <scale value=\"2\"/>\r\n      \
    <rotate z='1' angle=\"30\"/>\r\n      <translate x=\".5\" z=\"-1e0\" />\r\n      <object />\r\n    \
    </object>\r\n    <object type='plane'></object>\r\n    <material name=\"m\" type=\"phong\">\r\n      \
    <diffuse r=\"0.25\" value=\"2\" texture=\"checkerboard\">\r\n        <color2 g=\"0\"/>\r\n        \
    <scale x=\".1\"/>\r\n      </diffuse>\r\n      <refraction index=\"1.5\"/>\r\n    </material>\r\n    \
    <material type=\"microfacet\"/>\r\n    <light type=\"direct\"><direction x=\"1\"/></light>\r\n    \
    <light type=\"point\">\r\n\t<intensity value=\"3\"/>\r\n    </light>\r\n    <light type='ambient'/>\r\n  \
    </scene>\r\n  <camera>\r\n    <position x=\"1\" y=\"2\" z=\"7\" value=\"2\"/>\r\n    <up z=\"1\"/>\r\n  \
    </camera>\r\n</xml>\r\n";

/// The value of each component of each field, stated or default.
fn values(text: &str) -> Vec<(Node, &'static str, Vec<String>)> {
    let (source, _) = read(text);
    let of = |node| {
        let placed = source.fields(node);
        let row = |placed: FieldSpans| {
            let value = |component: usize| match placed.default_of(component) {
                Some(default) => default.to_owned(),
                None => source.leaf_text(placed.spans[component]).to_owned(),
            };
            let values = (0..placed.spans.len()).map(value).collect();
            (node, placed.field.key, values)
        };
        placed.into_iter().map(row).collect::<Vec<_>>()
    };
    source.nodes().iter().flat_map(of).collect()
}

#[test]
fn missing_components_are_inserted_where_they_belong() {
    for (scene, node, key, component, literal, expected) in [
        (
            "<object><scale value='2'/></object>",
            Node::Object(0),
            "scale",
            1,
            "3",
            "<object><scale value='2' y=\"3\"/></object>",
        ),
        (
            "<object type='sphere' />",
            Node::Object(0),
            "material",
            0,
            "a\"&b",
            "<object type='sphere' material=\"a&quot;&amp;b\" />",
        ),
        (
            "<material/>",
            Node::Material(0),
            "diffuse",
            1,
            "1",
            "<material><diffuse r=\"0.5\" g=\"1\" b=\"0.5\"/></material>",
        ),
        (
            "\n  <material>\n  </material>",
            Node::Material(0),
            "glossiness",
            0,
            "9",
            "\n  <material>\n    <glossiness value=\"9\"/>\n  </material>",
        ),
        (
            "\n  <material/>",
            Node::Material(0),
            "specular",
            0,
            "0",
            "\n  <material>\n    <specular r=\"0\" g=\"0.7\" b=\"0.7\"/>\n  </material>",
        ),
        (
            "\r\n\t<light type='point'>\r\n\t\t<size value='1'/> <!-- large -->\r\n\t</light>",
            Node::Light(0),
            "position",
            2,
            "-4",
            "\r\n\t<light type='point'>\r\n\t\t<size value='1'/>\r\n\t\t<position z=\"-4\"/> <!-- large -->\r\n\t</light>",
        ),
        (
            "<light type='direct'></light>",
            Node::Light(0),
            "direction",
            0,
            "1",
            "<light type='direct'><direction x=\"1\" z=\"1\"/></light>",
        ),
        (
            "\n<light type='ambient'/>",
            Node::Background,
            "background",
            0,
            "1",
            "\n<light type='ambient'/>\n<background r=\"1\" g=\"0\" b=\"0\"/>",
        ),
    ] {
        let text = around(scene);
        let (source, _) = read(&text);
        let fields = source.fields(node);
        let placed = fields
            .iter()
            .find(|placed| placed.field.key == key)
            .expect("it has the field");
        let edits = placed.edits(&*source, &[(component, literal.to_owned())]);
        let mut edited = text.clone();
        let undo = apply(&mut edited, &edits);
        assert_eq!(edited, around(expected), "{scene}");
        apply(&mut edited, &undo);
        assert_eq!(edited, text, "{scene}");
    }
}

#[test]
fn ten_thousand_edits_each_change_one_component() {
    let mut random = Random(7);
    let mut edits = 0;
    while edits < 10_000 {
        let mut text = random.pick(&[RICH, EXAMPLE]).to_owned();
        let first = text.clone();
        let mut undo = Vec::new();
        for _ in 0..25 {
            let (source, _) = read(&text);
            let nodes: Vec<_> = source.nodes().iter().collect();
            let node = nodes[random.below(nodes.len())];
            let fields = source.fields(node);
            let at = random.below(fields.len());
            let placed = &fields[at];
            let component = random.below(placed.spans.len());
            let literal = match placed.field.kind {
                // A different type has other fields, and a different gamma other defaults.
                Kind::Choice(_) => continue,
                Kind::Word if placed.field.key == "texture" => continue,
                Kind::Word | Kind::Name(_) => random.pick(&["a", "<&>'\"", "é", "m"]).to_owned(),
                Kind::Side => (1 + random.below(900)).to_string(),
                // It changes the default of `spp`.
                _ if placed.field.key == "noise" => continue,
                _ if placed.field.key == "exposure" => random.below(100).to_string(),
                _ if node == Node::Render => (1 + random.below(900)).to_string(),
                _ => random.literal(placed.field),
            };
            let before = values(&text);
            let own = before
                .iter()
                .filter(|(of, ..)| *of == node)
                .nth(at)
                .expect("listed");
            let old = own.2[component].clone();
            let edit = placed.edits(&*source, &[(component, literal.clone())]);
            let [Edit { span, text: put }] = &edit[..] else {
                panic!("one component, one edit: {edit:?}");
            };
            if placed.default_of(component).is_none() {
                assert_eq!(*span, placed.spans[component]);
            } else {
                // Nothing stated is lost: at most an empty-element tag is opened.
                assert!(span.of(&text).trim() == "/>" || span.is_empty(), "{edit:?}");
                assert!(put.contains('='), "{edit:?}");
            }
            let mut expected = text.clone();
            expected.replace_range(span.range(), put);
            undo.push(apply(&mut text, &edit));
            assert_eq!(text, expected);
            let after = values(&text);
            let changed: Vec<_> = after.iter().filter(|row| !before.contains(row)).collect();
            if literal != old {
                let said =
                    |row: &&&(Node, &str, Vec<String>)| row.0 == node && row.1 == placed.field.key;
                let row = changed.iter().find(said);
                let row = row.unwrap_or_else(|| panic!("{old} → {literal}: {edit:?}\n{text}"));
                assert!(row.2.contains(&literal), "{row:?} {literal}");
            }
            // A parameter that was missing adds rows for its other attributes.
            let brought = after.len() - before.len();
            assert!(changed.len() <= 1 + brought, "{changed:?}\n{text}");
            edits += 1;
        }
        for step in undo.iter().rev() {
            apply(&mut text, step);
        }
        assert_eq!(text, first);
    }
}

#[test]
fn only_changed_parts_of_a_camera_are_written() {
    let mut random = Random(3);
    let texts = [
        RICH.to_owned(),
        EXAMPLE.to_owned(),
        "<xml/>".to_owned(),
        "<xml>\n\t<scene/>\n</xml>\n".to_owned(),
        "<xml>\n  <scene/>\n  <camera/>\n</xml>".to_owned(),
        "<xml><camera><position value='0'/></camera></xml>".to_owned(),
    ];
    for text in texts {
        for _ in 0..300 {
            let (source, lowered) = read(&text);
            let Some(before) = lowered.scene.map(|scene| scene.camera) else {
                panic!("{text}");
            };
            let mut number =
                || parse_number(random.pick(&["0.1", "3", "-7.25", "1e3"])).expect("a number");
            let mut camera = before;
            for vector in [&mut camera.eye, &mut camera.target, &mut camera.up] {
                if number() < 1.0 {
                    *vector = glam::DVec3::new(number(), number(), number());
                }
            }
            if number() < 0.0 {
                camera.lens = Lens::Perspective(33.5);
                camera.size = Size {
                    width: 1280,
                    height: 720,
                };
            }
            if camera.eye == camera.target {
                continue;
            }
            let edits = source.view_edits(&before, &camera);
            assert_eq!(edits.is_empty(), camera == before);
            let mut edited = text.clone();
            let undo = apply(&mut edited, &edits);
            let (source, lowered) = read(&edited);
            let now: Option<Camera> = lowered.scene.map(|scene| scene.camera);
            assert_eq!(now, Some(camera), "{edited}");
            let shown = source.view_literals(&camera);
            let placed = source.fields(Node::View);
            for (literals, placed) in shown.iter().zip(&placed) {
                assert_eq!(literals.len(), placed.spans.len());
            }
            apply(&mut edited, &undo);
            assert_eq!(edited, text);
        }
    }
}

#[test]
fn a_missing_camera_is_written_completely() {
    let text = "<xml>\n\t<scene/>\n</xml>\n";
    let (source, lowered) = read(text);
    let before = lowered.scene.expect("there are no errors").camera;
    let camera = Camera {
        eye: glam::DVec3::new(0.0, 0.0, 5.0),
        lens: Lens::Perspective(30.0),
        ..before
    };
    let mut edited = text.to_owned();
    apply(&mut edited, &source.view_edits(&before, &camera));
    let expected = "<xml>\n\t<scene/>\n\t<camera>\n\t  <position z=\"5\"/>\n\t  <fov value=\"30\"/>\n\t</camera>\n</xml>\n";
    assert_eq!(edited, expected);
}

/// A light at a place times 0 is at the origin, whatever the place.
#[test]
fn a_light_whose_place_is_times_0_moves() {
    let text =
        "<xml><scene><light type='point'><position x='1' y='2' value='0'/></light></scene></xml>";
    let (source, _) = read(text);
    let by = crate::Motion::Move(glam::DVec3::new(0.5, 0.0, 3.0));
    let edits = source.motion(&[Node::Light(0)], &by, 2).expect("it moves");
    let mut moved = text.to_owned();
    apply(&mut moved, &edits);
    let expected = text.replace("x='1' y='2' value='0'", "x='0.5' y='0' value='1' z=\"3\"");
    assert_eq!(moved, expected);
    let text =
        "<xml><scene><object type='sphere'><translate x='1' value='0'/></object></scene></xml>";
    let (source, _) = read(text);
    let edits = source.motion(&[Node::Object(0)], &by, 2).expect("it moves");
    let mut moved = text.to_owned();
    apply(&mut moved, &edits);
    let expected = text.replace("x='1' value='0'", "x='0.5' value='1' z=\"3\"");
    assert_eq!(moved, expected);
}
