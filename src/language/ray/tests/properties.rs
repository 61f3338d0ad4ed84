//! Property tests of lowering, with random texts and edits.

use glam::DVec3;
use proptest::prelude::*;

use super::{read, scene};
use crate::coefficients::Coefficients;
use crate::node::Node;
use crate::ray::schema::{AMBIENT, LIGHT, ShapeKind, VIEW};
use crate::schema::{Field, Kind, Range};
use crate::tests::{Random, damage};
use geometry::{Affine, Cone, Cuboid, Cylinder, Ellipsoid, Shape, Solid, Sphere};
use scene::{Camera, Lens, Light, Material, Materials, Object, Objects, Scene, Setting, Size};
use text::{Edit, Span, apply};

impl Random {
    /// An allowed literal for the field, in a random style.
    pub(crate) fn literal(&mut self, field: &Field) -> String {
        let whole = 1 + self.below(9);
        if field.kind == Kind::Pixels {
            return format!("{whole}{}", self.pick(&["", "0", "00"]));
        }
        let sign = match field.allowed {
            Range::Any => self.pick(&["", "-", "+"]),
            _ => self.pick(&["", "+"]),
        };
        let tail = self.pick(&["", ".", ".5", ".0625", "e-1", "E1", "e+0", ".25e1"]);
        format!("{sign}{whole}{tail}")
    }
}

/// The fields of a node with the literals of their numbers.
type Said = Vec<(&'static Field, Vec<String>)>;

/// A random scene as fields, and its text.
pub(super) struct Model {
    nodes: Vec<(Node, Option<ShapeKind>, Said)>,
}

impl Model {
    pub(super) fn random(random: &mut Random) -> Self {
        let say = |random: &mut Random, fields: &mut dyn Iterator<Item = &'static Field>| -> Said {
            let mut axis = 0;
            fields
                .map(|field| {
                    let literals = (0..field.kind.components())
                        .map(|at| match field.kind {
                            Kind::Direction if field.key != "up" => {
                                u8::from(at == axis).to_string()
                            }
                            _ => random.literal(field),
                        })
                        .collect();
                    axis += usize::from(field.kind == Kind::Direction);
                    (field, literals)
                })
                .collect()
        };
        let mut view = say(random, &mut VIEW.fields());
        view.retain(|_| random.below(2) == 0);
        let mut nodes = vec![
            (Node::View, None, view),
            (Node::Ambient, None, say(random, &mut AMBIENT.fields())),
        ];
        for index in 0..=random.below(3) {
            nodes.push((Node::Light(index), None, say(random, &mut LIGHT.fields())));
        }
        for index in 0..=random.below(4) {
            let kind = ShapeKind::ALL[random.below(ShapeKind::ALL.len())];
            nodes.push((
                Node::Object(index),
                Some(kind),
                say(random, &mut kind.fields()),
            ));
        }
        Self { nodes }
    }

    pub(super) fn text(&self, random: &mut Random) -> String {
        const GAPS: [&str; 9] = [
            " ",
            "  ",
            "\t",
            "\n",
            "\r\n",
            "\u{A0}",
            " // remark\n",
            "\\\\ é 1 2\r\n",
            "\r\r\n",
        ];
        let count = |wanted: fn(&Node) -> bool| self.nodes.iter().filter(|n| wanted(&n.0)).count();
        let mut text = random.pick(&["", "\u{FEFF}", "\n", "// \r\n"]).to_owned();
        let mut say = |word: &str| {
            text.push_str(word);
            text.push_str(random.pick(&GAPS));
        };
        for (node, kind, said) in &self.nodes {
            match node {
                Node::Light(0) => say(&count(|n| matches!(n, Node::Light(_))).to_string()),
                Node::Object(0) => say(&count(|n| matches!(n, Node::Object(_))).to_string()),
                _ => {}
            }
            if let Some(kind) = kind {
                say(kind.keyword());
            }
            if *node == Node::View {
                let parts = said
                    .iter()
                    .map(|(f, numbers)| format!("{} {}", f.key, numbers.join(" ")));
                let parts: Vec<_> = parts.collect();
                if !parts.is_empty() {
                    say(&format!("// view:\u{A0}{}\n", parts.join("\t")));
                }
            } else {
                said.iter()
                    .flat_map(|(_, numbers)| numbers)
                    .for_each(|number| say(number));
            }
        }
        match random.below(2) {
            0 => text.trim_end().to_owned(),
            _ => text,
        }
    }

    /// The scene, except its camera, assembled by field names.
    fn scene(&self, camera: Camera) -> Scene {
        let mut scene = Scene {
            camera,
            ambient: DVec3::ZERO,
            lights: vec![],
            materials: Materials::default(),
            textures: vec![],
            objects: Objects::default(),
            setting: Setting::default(),
        };
        let mut objects = vec![];
        for (node, kind, said) in &self.nodes {
            match node {
                Node::View
                | Node::Render
                | Node::Background
                | Node::Environment
                | Node::Material(_)
                | Node::Texture(_) => {}
                Node::Ambient => scene.ambient = vector(said, "colour"),
                Node::Light(_) => scene.lights.push(Light::point(
                    vector(said, "position"),
                    vector(said, "colour"),
                )),
                Node::Object(_) => {
                    let material = material(said);
                    let known = scene.materials.iter().position(|known| *known == material);
                    let index = known.unwrap_or(scene.materials.len());
                    if known.is_none() {
                        scene.materials.edit(|materials| materials.push(material));
                    }
                    objects.push(Object {
                        shape: shape(said, kind.expect("objects have a kind")),
                        material: index as u32,
                    });
                }
            }
        }
        scene.objects = objects.into_iter().collect();
        scene
    }

    /// Checks the stated parts of the camera.
    fn check_camera(&self, camera: &Camera) {
        for (field, _) in &self.nodes[0].2 {
            let said = &self.nodes[0].2;
            match field.key {
                "eye" => assert_eq!(camera.eye, vector(said, "eye")),
                "target" => assert_eq!(camera.target, vector(said, "target")),
                "up" => assert_eq!(camera.up, vector(said, "up")),
                "fov" => assert_eq!(camera.lens, Lens::Perspective(numbers(said, "fov")[0])),
                _ => assert_eq!(
                    numbers(said, "size"),
                    [f64::from(camera.size.width), f64::from(camera.size.height)]
                ),
            }
        }
    }
}

fn numbers(said: &Said, key: &str) -> Vec<f64> {
    let (_, literals) = said
        .iter()
        .find(|(field, _)| field.key == key)
        .expect("the field is there");
    literals
        .iter()
        .map(|literal| literal.parse().expect("a number"))
        .collect()
}

fn vector(said: &Said, key: &str) -> DVec3 {
    DVec3::from_slice(&numbers(said, key))
}

fn shape(said: &Said, kind: ShapeKind) -> Shape {
    let frame = |origin, directions: [&str; 3], lengths: [&str; 3]| {
        let directions = directions.map(|key| vector(said, key));
        let lengths = DVec3::from_array(lengths.map(|key| numbers(said, key)[0]));
        Affine::new(vector(said, origin), directions, lengths).expect("they span a volume")
    };
    match kind {
        ShapeKind::Sphere => Shape::Solid(Solid::Sphere(Sphere {
            centre: vector(said, "centre"),
            radius: numbers(said, "radius")[0],
        })),
        ShapeKind::Ellipsoid => {
            let frame = frame("centre", ["v1", "v2", "v3"], ["l1", "l2", "l3"]);
            Shape::Solid(Solid::Ellipsoid(Box::new(Ellipsoid(frame))))
        }
        ShapeKind::Box => {
            let frame = frame("corner", ["vl", "vw", "vh"], ["length", "width", "height"]);
            Shape::Solid(Solid::Cuboid(Box::new(Cuboid(frame))))
        }
        ShapeKind::Cylinder => {
            let frame = frame("base", ["a1", "a2", "axis"], ["l1", "l2", "height"]);
            Shape::Solid(Solid::Cylinder(Box::new(Cylinder(frame))))
        }
        ShapeKind::Cone => {
            let frame = frame("base", ["a1", "a2", "axis"], ["l1", "l2", "height"]);
            Shape::Solid(Solid::Cone(Box::new(Cone(frame))))
        }
    }
}

fn material(said: &Said) -> Material {
    let coefficients = Coefficients {
        ambient: vector(said, "ka"),
        diffuse: vector(said, "kd"),
        specular: vector(said, "ks"),
        exponent: numbers(said, "ns")[0],
        reflection: numbers(said, "kr")[0],
        transmission: numbers(said, "kt")[0],
        index: numbers(said, "ior")[0],
    };
    coefficients.into()
}

/// Whether an edit of this component keeps the text error-free: directions of a frame may only grow
/// along their own axis, and the eye must not coincide with the target.
fn is_safe(field: &Field, old: &str) -> bool {
    field.key == "up" || field.kind != Kind::Direction || old != "0"
}

#[test]
fn an_edit_at_a_place_changes_only_that_field() {
    let mut random = Random(1);
    let mut edits = 0;
    while edits < 10_000 {
        let mut model = Model::random(&mut random);
        let mut text = model.text(&mut random);
        for _ in 0..25 {
            let (source, lowered) = read(&text);
            let Some(before) = lowered.scene else {
                // The random eye is at the random target.
                break;
            };
            model.check_camera(&before.camera);
            assert_eq!(before, model.scene(before.camera), "{text}");
            let nodes: Vec<_> = source.nodes().iter().collect();
            let node = nodes[random.below(nodes.len())];
            let placed = source.fields(node);
            let placed = &placed[random.below(placed.len())];
            if !placed.is_explicit() {
                continue;
            }
            let component = random.below(placed.spans.len());
            let (_, _, said) = model
                .nodes
                .iter_mut()
                .find(|(of, ..)| *of == node)
                .expect("listed");
            let (_, literals) = said
                .iter_mut()
                .find(|(field, _)| field.key == placed.field.key)
                .expect("what is placed was said");
            let span = placed.spans[component];
            assert_eq!(span.of(&text), literals[component]);
            if !is_safe(placed.field, &literals[component]) {
                continue;
            }
            let literal = random.literal(placed.field);
            let (head, tail) = (
                text[..span.start()].to_owned(),
                text[span.end()..].to_owned(),
            );
            apply(
                &mut text,
                &[Edit {
                    span,
                    text: literal.clone(),
                }],
            );
            assert_eq!(text, format!("{head}{literal}{tail}"));
            literals[component] = literal;
            edits += 1;
        }
    }
}

#[test]
fn view_edits_make_the_text_describe_the_camera() {
    let mut random = Random(2);
    let mut checked = 0;
    while checked < 2_000 {
        let model = Model::random(&mut random);
        let mut text = model.text(&mut random);
        let (source, lowered) = read(&text);
        let Some(before) = lowered.scene else {
            continue;
        };
        let mut camera = before.camera;
        let mut number = || random.next() as f64 / 1e18 - 9.0;
        let new = Camera {
            eye: DVec3::new(number(), number(), number()),
            target: DVec3::new(camera.target.x, number(), camera.target.z),
            up: DVec3::new(number(), camera.up.y, number()),
            lens: Lens::Perspective(number().abs() + 1.0),
            size: Size {
                width: number().abs() as u32 + 1,
                height: camera.size.height,
            },
            ..camera
        };
        let changed = random.next();
        let choose = |bit: u32| changed & (1 << bit) != 0;
        if choose(0) {
            camera.eye = new.eye;
        }
        if choose(1) {
            camera.target = new.target;
        }
        if choose(2) {
            camera.up = new.up;
        }
        if choose(3) {
            camera.lens = new.lens;
        }
        if choose(4) {
            camera.size = new.size;
        }
        let edits = source.view_edits(&before.camera, &camera);
        assert_eq!(edits.is_empty(), camera == before.camera, "{text}");
        let untouched = |text: &str| read(text).0.leaves().len();
        let leaves = untouched(&text);
        let added = usize::from(source.span(Node::View).is_empty() && !edits.is_empty());
        apply(&mut text, &edits);
        assert_eq!(untouched(&text), leaves + added, "{text}");
        assert_eq!(scene(&text), Scene { camera, ..before }, "{text}");
        checked += 1;
    }
}

/// Damages a text at a random place.
fn mutate(text: &mut String, random: &mut Random) {
    const WORDS: [&str; 14] = [
        "sphere",
        "box",
        "spere",
        "torus",
        "-1",
        "0",
        "1e999",
        "1,5",
        "é",
        "//",
        "// view: eye 1",
        "// view: fov 30 size 8 6\n",
        "100000000",
        "\u{A0}\u{1b}",
    ];
    damage(text, &read(text).0.leaves(), &WORDS, random);
}

/// Lowers an arbitrary text and checks that the results are consistent with it.
fn check_any(text: &str) {
    let (source, lowered) = read(text);
    let within = |span: Span| text.get(span.range()).is_some();
    assert!(
        lowered
            .diagnostics
            .iter()
            .all(|diagnostic| within(diagnostic.span)),
        "{text:?}"
    );
    assert!(
        lowered
            .diagnostics
            .is_sorted_by_key(|diagnostic| diagnostic.span.start())
    );
    let errors = lowered.diagnostics.iter().any(text::Diagnostic::is_error);
    assert_eq!(lowered.scene.is_none(), errors, "{text:?}");
    for node in source.nodes().iter() {
        assert!(!source.name(node).is_empty());
        let whole = source.span(node);
        assert!(within(whole));
        for placed in source.fields(node) {
            let complete = placed.spans.len() == placed.field.kind.components();
            assert!(complete || (node == Node::View && placed.spans.is_empty()));
            let is_explicit = placed.is_explicit();
            for span in placed.spans {
                assert!(within(span), "{text:?}");
                if is_explicit {
                    assert!(whole.touches(span), "{text:?}");
                    assert_eq!(source.node_at(span), Some(node), "{text:?}");
                }
            }
        }
    }
    if let Some(scene) = lowered.scene {
        let Node::Object(last) = source.nodes().iter().last().expect("there are nodes") else {
            panic!("a scene has objects: {text:?}");
        };
        assert_eq!(last + 1, scene.objects.len());
        assert!(!scene.lights.is_empty());
    }
}

#[test]
fn damaged_texts_are_read_to_the_end() {
    let mut random = Random(3);
    for _ in 0..2_000 {
        let mut text = Model::random(&mut random).text(&mut random);
        for _ in 0..=random.below(6) {
            mutate(&mut text, &mut random);
            check_any(&text);
        }
    }
}

proptest! {
    #![proptest_config(repeatable::config())]

    #[test]
    fn any_text_can_be_read(text in ".{0,60}") {
        check_any(&text);
    }

    #[test]
    fn any_words_can_be_read(text in "((1|-2.5|0|sphere|box|Cone|spere|x|// view: |eye|fov|size|\n) ?){0,80}") {
        check_any(&text);
    }
}

/// Objects with a recurring material text, some of them with errors or warnings.
fn objects_alike(shapes: &[(usize, usize)], tokens: usize, each_apart: bool) -> String {
    let shapes_and_slips = [
        "sphere 1 2 3 4",
        "Sphere 1 2 3 4",
        "sphere 1 2 3 x",
        "sphere 1 2 3 -4",
        "sphere 1 2 3",
        "box 1 2 3  1 0 0  0 1 0  0 0 1  4 5 6",
        "cone 1 2 3  2 0 0  0 1 0  0 .6 .8  4 5 6",
        "cone 1 2 3  1 0 0  1 0 0  0 0 1  4 5 6",
    ];
    let materials = [
        "1 0 0 0 1 0 0 0 1 20 0 0 1",
        "1 0 0 0 1 0 0 0 1 20 0 0 1.5",
        "1 0 0 0 2 0 0 0 1 20 0 0 1",
        "1 0 0 0 1 z 0 0 1 20 0 0 1",
        "1 0 0 // red\n0 1 0 0 0 1 20 0 0 1",
        "1 0 0 0 1 0 0 0 1 20 0 0",
        "1 0 0 0 1 0 0 0 1 sphere 0 0 1",
    ];
    let mut text = format!("1 1 1 1 0 5 5 1 1 1 {}", shapes.len());
    for (number, &(shape, material)) in shapes.iter().enumerate() {
        let (shape, material) = (shapes_and_slips[shape], materials[material]);
        let apart = "\t".repeat(number * usize::from(each_apart)) + " ";
        text = format!("{text} {shape} {}", material.replacen(' ', &apart, 1));
    }
    let kept: Vec<_> = text.split_inclusive(' ').collect();
    kept[..tokens.min(kept.len())].concat()
}

proptest! {
    #![proptest_config(repeatable::config())]

    /// Whether a material's text occurred before or not, it has the same meaning and diagnostics.
    #[test]
    fn materials_with_equal_text_are_equal(
        shapes in prop::collection::vec(
            (
                prop_oneof![3 => 0..1_usize, 1 => 0..8_usize],
                prop_oneof![3 => 0..2_usize, 1 => 0..7_usize],
            ),
            1..20,
        ),
        cut in prop_oneof![1 => Just(usize::MAX), 1 => 0..500_usize],
    ) {
        let meaning = |each_apart| {
            let (source, lowered) = super::blocks::read(&objects_alike(&shapes, cut, each_apart));
            let mut told: Vec<_> = lowered.diagnostics.iter().cloned().collect();
            for found in &mut told {
                (found.span, found.fix) = (Span::at(0), Vec::new());
            }
            (lowered.scene, format!("{told:?} {:?}", source.origins))
        };
        prop_assert_eq!(meaning(false), meaning(true));
    }
}
