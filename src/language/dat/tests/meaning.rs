//! The meaning of well-formed records.

use std::f64::consts::PI;

use glam::{DVec2, DVec3};

use super::{read, scene, shown, spelled};
use crate::coefficients::Coefficients;
use crate::node::Node;
use geometry::{Shape, Solid};
use scene::{
    Bump, Camera, Emitter, Falloff, Focus, Lens, Light, Maps, Materials, Pattern, Rgb, Scene,
    Shadows, Side, Size, Texture, Tinted,
};

/// The scene of records after a view, a material 0 and a sphere of radius 1.
fn with(records: &str) -> Scene {
    scene(&spelled(&format!(
        "VIEW\nmat ID 0 MAT\nobj sphere ID 0 BALL 1\n{records}"
    )))
}

#[test]
fn cameras() {
    let seen = |lines: &str| {
        let body = "mat ID 0 MAT\nobj sphere ID 0 BALL 1\n";
        scene(&spelled(&format!("{lines}\n{body}"))).camera
    };
    let perspective = seen(
        "camera perspective 1 2 3  4 5 6  7 8 9  2.5 0.5 40\nresolution 0.02 0.01\nviewport 30 500",
    );
    // The image plane is 500 · 0.01 = 5 high, 2.5 in front of the eye.
    let Lens::Perspective(angle) = perspective.lens else {
        panic!("{perspective:?}");
    };
    assert!((angle - 90.0).abs() < 1e-13, "{angle}");
    let expected = Camera {
        eye: DVec3::new(1.0, 2.0, 3.0),
        target: DVec3::new(4.0, 5.0, 6.0),
        up: DVec3::new(7.0, 8.0, 9.0),
        lens: perspective.lens,
        pixel_aspect: 2.0,
        depths: [0.5, 40.0],
        focus: Focus::PINHOLE,
        size: Size {
            width: 30,
            height: 500,
        },
    };
    assert_eq!(perspective, expected);
    // The order of the records does not matter, and a negative near counts as 0.
    let orthographic =
        seen("viewport 30 500\nresolution 0.5 0.25\ncamera orthographic 1 2 3 4 5 6 7 8 9 1 -2 40");
    let expected = Camera {
        lens: Lens::Orthographic(125.0),
        depths: [0.0, 40.0],
        ..expected
    };
    assert_eq!(orthographic, expected);
}

#[test]
fn lights() {
    let from = |position: [f64; 3], radial: [f64; 3], spot| Emitter::Point {
        position: position.into(),
        radius: 0.0,
        falloff: Falloff { radial, spot },
    };
    let root = 0.5_f64.sqrt();
    for (record, emitter, shadows) in [
        (
            "pnt 1 2 3  0 0 0  4 5 6  1 0 0  0 shadow_on",
            from([1., 2., 3.], [1., 0., 0.], None),
            Shadows::Cast,
        ),
        (
            "pnt 1 2 3  0 0 0  4 5 6  .5 .25 2  7 shadow_off",
            from([1., 2., 3.], [0.5, 0.25, 2.], None),
            Shadows::Off,
        ),
        (
            "pnt 0 0 8  0 -3 0  4 5 6  0 1 0  7 shadow_on",
            from([0., 0., 8.], [0., 1., 0.], Some((DVec3::NEG_Y, 7.0))),
            Shadows::Cast,
        ),
        // With an exponent of 0 it is not a spot light.
        (
            "pnt 0 0 8  0 -3 0  4 5 6  0 1 0  0 shadow_on",
            from([0., 0., 8.], [0., 1., 0.], None),
            Shadows::Cast,
        ),
        // The direction is the one in which the light travels.
        (
            "inf 1 2 3  0 -2 2  4 5 6  1 0 0  0 shadow_on",
            Emitter::Distant(DVec3::new(0.0, root, -root)),
            Shadows::Cast,
        ),
        (
            "inf 0 5 0  0 0 0  4 5 6  1 0 0  0 shadow_off",
            Emitter::Distant(DVec3::Y),
            Shadows::Off,
        ),
        (
            "amb 0 0 0  0 0 0  4 5 6  0 0 0  0 shadow_on",
            Emitter::Ambient,
            Shadows::Cast,
        ),
    ] {
        let scene = with(&format!("light ID 3 {record}"));
        let colour = DVec3::new(4.0, 5.0, 6.0);
        let [light] = scene.lights[..] else {
            panic!("{record}: {:?}", scene.lights);
        };
        match (light.emitter, emitter) {
            (Emitter::Distant(found), Emitter::Distant(expected)) => {
                assert!((found - expected).length() < 1e-15, "{record}");
            }
            (found, expected) => assert_eq!(found, expected, "{record}"),
        }
        let rest = Light {
            emitter: light.emitter,
            colour,
            scale: PI,
            shadows,
        };
        assert_eq!(light, rest, "{record}");
        let ambient = match emitter {
            Emitter::Ambient => colour,
            _ => Rgb::ZERO,
        };
        assert_eq!(scene.ambient_light(), ambient, "{record}");
    }
}

#[test]
fn ambient_lights_are_added_up() {
    let scene = with(
        "light ID 0 amb 0 0 0 0 0 0  .1 .2 .4  1 0 0 0 shadow_on
        light ID 1 pnt 0 0 0 0 0 0  1 1 1  1 0 0 0 shadow_on
        light ID 2 amb 0 0 0 0 0 0  .25 .5 1  1 0 0 0 shadow_off",
    );
    assert_eq!(
        scene.ambient_light(),
        DVec3::new(0.1 + 0.25, 0.2 + 0.5, 0.4 + 1.0)
    );
    assert_eq!(scene.lights.len(), 3);
}

/// A negative exponent is read as 0: no spot, and light behind as in front.
#[test]
fn a_negative_exponent_is_not_a_spot_light() {
    let text = spelled(
        "VIEW\nmat ID 0 MAT\nobj sphere ID 0 BALL 1\nlight ID 0 pnt 0 0 8  0 -3 0  1 1 1  1 0 0  -2 shadow_on",
    );
    let scene = read(&text).1.scene.expect("there are no errors");
    let Emitter::Point { falloff, .. } = scene.lights[0].emitter else {
        panic!("{:?}", scene.lights);
    };
    assert_eq!(falloff, Falloff::NONE);
}

/// The material's colour tints everything, and Kt precedes Kr.
#[test]
fn materials() {
    let scene = scene(&spelled(
        "VIEW\nmat ID 7  1 .5 .25  .5 1 4 10  .75 .125 1.5\nobj sphere ID 0 mat ID 7 0 0 0 1",
    ));
    let colour = DVec3::new(1.0, 0.5, 0.25);
    let expected = Coefficients {
        ambient: 0.5 * colour,
        diffuse: colour,
        specular: 4.0 * colour,
        exponent: 10.0,
        reflection: 0.125,
        transmission: 0.75,
        index: 1.5,
    };
    assert_eq!(scene.materials, Materials::from_iter([expected.into()]));
}

#[test]
fn textures_and_their_uses() {
    let scene = with(
        "texture ID 4 checker 2 3  1 .5 0  0 .25 1
        texture ID 9 image .5 8 maps/wood.png
        mat ID 1 1 1 1  .1 .8 .1 5  0 0 1
        use bump ID 9 mat ID 0  -0.25
        use colour ID 4 mat ID 0
        use colour ID 9 mat ID 1",
    );
    let plain = |colour| Tinted {
        colour,
        texture: None,
    };
    let squares = [DVec3::new(1.0, 0.5, 0.0), DVec3::new(0.0, 0.25, 1.0)].map(plain);
    let checker = Pattern::Checker {
        squares,
        side: Side::One,
    };
    let image = Pattern::Image("maps/wood.png".to_owned());
    let textures = [
        Texture::repeated(DVec2::new(2.0, 3.0), checker),
        Texture::repeated(DVec2::new(0.5, 8.0), image),
    ];
    assert_eq!(scene.textures, textures);
    let bump = Bump {
        texture: 1,
        height: -0.25,
    };
    for (index, texture, bump) in [(0, Some(0), Some(bump)), (1, Some(1), None)] {
        let expected = Maps {
            ambient: texture,
            diffuse: texture,
            specular: texture,
            bump,
            ..Maps::default()
        };
        assert_eq!(scene.materials[index].maps, expected.boxed());
    }
}

/// The radii of the drawn spheres, and the number of other objects.
fn drawn(scene: &Scene) -> (Vec<f64>, usize) {
    let radius = |shape: &Shape| match shape {
        Shape::Solid(Solid::Sphere(sphere)) => Some(sphere.radius),
        _ => None,
    };
    let radii: Vec<_> = scene
        .objects
        .iter()
        .filter_map(|object| radius(&object.shape))
        .collect();
    let others = scene.objects.len() - radii.len();
    (radii, others)
}

#[test]
fn render_lists_the_drawn_objects() {
    let objects = "mat ID 0 MAT
        obj sphere ID 5 BALL 5
        obj sphere ID -2 BALL 2
        obj sphere ID 1 BALL 1
        obj CSG ID 8 union ID 5 ID 1\n";
    for (render, radii, others) in [
        // All except operands.
        ("", &[2.0][..], 1),
        ("render 1 ID 5\n", &[5.0], 0),
        // In file order, each once.
        ("render 4 ID 1 ID 5 ID -2 ID 5\n", &[5.0, 2.0, 1.0], 0),
        ("render 2  ID 8  ID 1\n", &[1.0], 1),
    ] {
        for text in [
            format!("VIEW\n{render}{objects}"),
            format!("VIEW\n{objects}{render}"),
        ] {
            let scene = scene(&spelled(&text));
            assert_eq!(drawn(&scene), (radii.to_vec(), others), "{text}");
        }
    }
}

#[test]
fn render_0_draws_operands_with_a_warning() {
    let objects = "mat ID 0 MAT
        obj sphere ID 5 BALL 5
        obj sphere ID -2 BALL 2
        obj sphere ID 1 BALL 1\n";
    let text = spelled(&format!("VIEW\n{objects}render 0\n"));
    assert_eq!(drawn(&scene(&text)), (vec![5.0, 2.0, 1.0], 0));
    let text = spelled(&format!(
        "VIEW\nrender 0\n{objects}obj CSG ID 8 union ID 5 ID 1\nobj CSG ID 9 union ID 5 ID 8\n"
    ));
    let (_, lowered) = read(&text);
    let scene = lowered.scene.as_ref().expect("no errors");
    assert_eq!(drawn(scene), (vec![5.0, 2.0, 1.0], 2));
    let said = shown(&text, &lowered);
    let message = "render: 0 also draws the operands of CSG: ID 5 ID 1 ID 8";
    assert_eq!(said, [format!("4:8 warning: {message}")]);
    let hint = lowered.diagnostics[0].hint.as_deref();
    assert_eq!(hint, Some("only the results: render 2 ID -2 ID 9"));
}

#[test]
fn long_lists_of_operands_are_truncated() {
    let pairs = 70;
    let balls = (0..2 * pairs).map(|id| format!("obj sphere ID {id} BALL 1\n"));
    let both = (0..pairs).map(|at| {
        let [first, second] = [2 * at, 2 * at + 1];
        format!("obj CSG ID {} union ID {first} ID {second}\n", 1000 + at)
    });
    let objects: String = balls.chain(both).collect();
    let text = spelled(&format!("VIEW\nmat ID 0 MAT\n{objects}render 0\n"));
    let (_, lowered) = read(&text);
    let [warning] = &lowered.diagnostics[..] else {
        panic!("one warning: {:?}", lowered.diagnostics);
    };
    assert!(
        warning.message.ends_with("ID 6 ID 7 and 132 more"),
        "{warning:?}"
    );
    let hint = "without a `render` record only the results are drawn";
    assert_eq!(warning.hint.as_deref(), Some(hint));
}

#[test]
fn intersect_is_accepted_without_a_warning() {
    let with = |word: &str| {
        let objects = "mat ID 0 MAT\nobj sphere ID 1 BALL 1\nobj sphere ID 2 BALL 2\n";
        scene(&spelled(&format!(
            "VIEW\n{objects}obj CSG ID 3 {word} ID 1 ID 2\n"
        )))
    };
    assert_eq!(with("intersect"), with("intersection"));
}

/// The same ID may be used once in each category.
#[test]
fn each_category_has_its_own_ids() {
    let scene = scene(&spelled(
        "VIEW
light ID 3 inf 0 0 0  0 0 -1  1 1 1  1 0 0 0 shadow_on
mat ID 3 MAT
texture ID 3 checker 1 1 1 1 1 0 0 0
use colour ID 3 mat ID 3
obj sphere ID 3 mat ID 3  0 0 0 1
obj sphere ID -9223372036854775808 mat ID 3  0 0 0 2
obj sphere ID +4 mat ID 3  0 0 0 4
render 2 ID 3 ID 4",
    ));
    assert_eq!(drawn(&scene), (vec![1.0, 4.0], 0));
    let maps = scene.materials[0].maps.as_ref();
    assert_eq!(maps.and_then(|maps| maps.diffuse), Some(0));
}

const LAID_OUT: &str = "# a comment
camera perspective 0 0 5  0 0 0  0 1 0  1 0 100
resolution 0.01 0.01
viewport 80 60

light ID 0 pnt 0 5 5  0 0 0  1 1 1  1 0 0  0 shadow_on
  // another one, which says: obj sphere
mat ID 0  1 1 1  0.1 0.8 0.1 5  0 0 1
obj sphere ID 0 mat ID 0  0 0 0  1
//obj sphere ID 0 mat ID 0  0 0 0  1
#obj sphere
render 1 ID 0
";

#[test]
fn layout_does_not_matter() {
    let plain = scene(LAID_OUT);
    for text in [
        LAID_OUT.replace('\n', "\r\n"),
        LAID_OUT.replace('\n', "\r\r\n"),
        LAID_OUT.replace('\n', "\r"),
        LAID_OUT.replace(' ', "\t"),
        LAID_OUT.replace(' ', "\u{A0}"),
        LAID_OUT.replace("  ", " \u{B}\u{C}"),
        LAID_OUT.replace('\n', " \t\n\n"),
        LAID_OUT.trim_end().to_owned(),
        format!("\u{FEFF}{LAID_OUT}"),
        format!("\u{FEFF}{}", LAID_OUT.trim_start_matches("# a comment\n")),
        format!("\n\n{LAID_OUT}\n\n"),
    ] {
        assert_eq!(scene(&text), plain, "{text:?}");
    }
}

#[test]
fn nodes_are_found_by_position_and_have_names() {
    let text = spelled(
        "VIEW
mat ID 12 MAT
texture ID 4 checker 1 1 1 1 1 0 0 0
use colour ID 4 mat ID 12
// the eye
obj sphere ID 7 mat ID 12  0 0 0 1
obj box ID 8 mat ID 12  0 0 0 AXES 1 1 1
obj CSG ID 9 difference ID 7 ID 8
light ID 2 pnt 0 5 5  0 0 0  1 1 1  1 0 0  0 shadow_on
render 1 ID 9",
    );
    let (source, _) = read(&text);
    let names: Vec<_> = source
        .nodes()
        .iter()
        .map(|node| source.name(node))
        .collect();
    let expected = [
        "render",
        "view",
        "light 2",
        "material 12",
        "texture 4",
        "object 7 (sphere)",
        "object 8 (box)",
        "object 9 (CSG)",
    ];
    assert_eq!(names, expected);
    for (at, node) in [
        ("0 0 5", Node::View),
        ("resolution", Node::View),
        ("80 60", Node::View),
        ("mat ID 12 1", Node::Material(0)),
        ("use colour", Node::Material(0)),
        ("checker", Node::Texture(0)),
        ("sphere", Node::Object(0)),
        ("CSG", Node::Object(2)),
        ("pnt", Node::Light(0)),
    ] {
        let start = text
            .find(at)
            .unwrap_or_else(|| panic!("{at} is in the text"));
        let span = text::Span::new(start, start + at.len());
        assert_eq!(source.node_at(span), Some(node), "{at}");
    }
    let object = Node::Object;
    assert_eq!(source.comment(object(0)), Some("the eye"));
    assert_eq!(source.comment(object(1)), None);
    let parts = [(1, object(0)), (1, object(1))];
    assert_eq!(source.parts(2, 10), parts);
    assert_eq!(source.parts(2, 1), parts[..1]);
    assert_eq!(source.users(Node::Material(0)), 2);
    assert_eq!(source.users(Node::Texture(0)), 2);
    let drawn = [0, 1, 2].map(|index| source.drawn(index));
    assert_eq!((drawn, source.object(0)), ([None, None, Some(0)], 2));
}

/// Tokens after the declared number of half-spaces are not fields.
#[test]
fn a_quadric_has_only_its_declared_half_spaces() {
    let record = "obj quadric ID 1 mat ID 0  1 0 0 0 1 0 0 1 0 -1";
    for (cuts, fields) in [("0", 11), ("1 1 0 0 5", 12), ("1 1 0 0 5  0 1 0 5", 12)] {
        let text = spelled(&format!("VIEW\nmat ID 0 MAT\n{record}  {cuts}"));
        let (source, _) = read(&text);
        let placed = source.fields(Node::Object(0));
        assert_eq!(placed.len(), fields, "{cuts}");
    }
}
