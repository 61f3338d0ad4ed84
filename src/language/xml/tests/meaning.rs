use std::f64::consts::PI;

use glam::{DAffine3, DMat3, DVec2, DVec3};

use super::{EXAMPLE, around, read, scene};
use crate::node::Node;
use geometry::{Aabb, Ray, Shape, Solid, Sphere};
use scene::{
    Camera, Dielectric, Emitter, Faces, Falloff, Focus, Gloss, Highlight, Integrator, Lens, Light,
    Material, Materials, Mirror, Pattern, Rgb, Scene, Shadows, Side, Size, Tinted, Transfer,
};

fn sphere(centre: [f64; 3], radius: f64) -> Shape {
    Shape::Solid(Solid::Sphere(Sphere {
        centre: centre.into(),
        radius,
    }))
}

/// The bounding box of a single object.
fn bounds(object: &str) -> Aabb {
    scene(&around(object)).bounds()
}

fn close(a: DVec3, b: [f64; 3]) -> bool {
    (a - DVec3::from_array(b)).abs().max_element() < 1e-12
}

#[test]
fn the_example_is_three_white_spheres() {
    let scene = scene(EXAMPLE);
    let shapes: Vec<_> = scene
        .objects
        .iter()
        .map(|object| object.shape.clone())
        .collect();
    let expected = [
        sphere([0.0, 50.0, -25.0], 25.0),
        sphere([0.0, 50.0, 5.1], 5.0),
        sphere([0.0, 50.0, 11.1], 1.0),
    ];
    assert_eq!(shapes, expected);
    assert_eq!(
        scene.materials,
        Materials::from_iter([Material::unlit(Rgb::ONE)])
    );
    let camera = Camera {
        eye: DVec3::ZERO,
        target: DVec3::new(0.0, 20.0, 0.0),
        up: DVec3::Z,
        lens: Lens::Perspective(40.0),
        pixel_aspect: 1.0,
        depths: Camera::ALL_DEPTHS,
        focus: Focus::PINHOLE,
        size: Size {
            width: 800,
            height: 600,
        },
    };
    assert_eq!(scene.camera, camera);
    let (source, lowered) = read(EXAMPLE);
    assert!(lowered.diagnostics.is_empty(), "{:?}", lowered.diagnostics);
    let nodes = source.nodes();
    let listed: Vec<_> = nodes
        .iter()
        .map(|node| (source.depth(node), source.name(node)))
        .collect();
    let expected = [
        (0, "render"),
        (0, "view"),
        (0, "background"),
        (0, "environment"),
        (0, "sphere1 (sphere)"),
        (0, "sphere2 (sphere)"),
        (1, "sphere3 (sphere)"),
    ];
    assert_eq!(
        listed,
        expected.map(|(depth, name)| (depth, name.to_owned()))
    );
}

#[test]
fn a_missing_camera_is_at_the_origin() {
    let camera = scene("<xml><scene/></xml>").camera;
    let size = Size {
        width: 200,
        height: 150,
    };
    assert_eq!(
        (camera.eye, camera.target, camera.up),
        (DVec3::ZERO, -DVec3::Z, DVec3::Y)
    );
    assert_eq!((camera.lens, camera.size), (Lens::Perspective(40.0), size));
    let camera = scene("<xml><scene/><camera><target x='1' value='2'/><up z='1'/><focaldist value='7'/></camera></xml>").camera;
    assert_eq!((camera.target, camera.up), (2.0 * DVec3::X, DVec3::Z));
    assert_eq!(camera.focus.distance, 7.0);
}

#[test]
fn transforms_apply_in_the_order_of_the_text() {
    for (transforms, centre, half) in [
        (
            "<scale value='2'/><translate x='3'/>",
            [3.0, 0.0, 0.0],
            [2.0; 3],
        ),
        (
            "<translate x='3'/><scale value='2'/>",
            [6.0, 0.0, 0.0],
            [2.0; 3],
        ),
        ("<scale x='2' value='3'/>", [0.0; 3], [6.0, 3.0, 3.0]),
        ("<scale y='-2'/>", [0.0; 3], [1.0, 2.0, 1.0]),
        (
            "<translate x='1'/><rotate z='1' angle='90'/>",
            [0.0, 1.0, 0.0],
            [1.0; 3],
        ),
        (
            "<translate x='1'/><rotate z='5' value='-90'/>",
            [0.0, -1.0, 0.0],
            [1.0; 3],
        ),
        (
            "<translate y='1'/><rotate x='1' angle='180' value='9'/>",
            [0.0, -1.0, 0.0],
            [1.0; 3],
        ),
        (
            "<translate z='1'/><rotate y='1' angle='30'/>",
            [0.5, 0.0, 3f64.sqrt() / 2.0],
            [1.0; 3],
        ),
        (
            "<translate x='1' y='1' z='1'/><rotate x='1' y='1' z='1' angle='77'/>",
            [1.0; 3],
            [1.0; 3],
        ),
        (
            "<translate x='1'/><rotate angle='90'/>",
            [1.0, 0.0, 0.0],
            [1.0; 3],
        ),
        ("<TRANSLATE x='1'/><Scale/>", [1.0, 0.0, 0.0], [1.0; 3]),
    ] {
        let bounds = bounds(&format!("<object type='Sphere'>{transforms}</object>"));
        assert!(close(bounds.centre(), centre), "{transforms}: {bounds:?}");
        assert!(close(0.5 * bounds.size(), half), "{transforms}: {bounds:?}");
    }
}

#[test]
fn nested_objects_move_with_their_parents() {
    let inner = "<object type='sphere'><translate x='1'/></object>";
    for object in [
        format!("<object><scale value='2'/><translate y='3'/>{inner}</object>"),
        format!("<object>{inner}<scale value='2'/><translate y='3'/></object>"),
        format!("<object type='nonsense'><scale value='2'/>{inner}<translate y='3'/></object>"),
        format!("<object><translate y='3'/><object><scale value='2'/>{inner}</object></object>"),
    ] {
        let scene = scene(&around(&object));
        assert_eq!(scene.objects.len(), 1);
        assert_eq!(
            scene.objects[0].shape,
            sphere([2.0, 3.0, 0.0], 2.0),
            "{object}"
        );
    }
}

#[test]
fn a_plane_is_a_square_with_a_front() {
    let scene = scene(&around(
        "<object type='plane'><scale value='2'/><rotate x='1' angle='90'/><translate y='3'/></object>",
    ));
    let shape = &scene.objects[0].shape;
    assert_eq!(shape.bounds().size(), DVec3::new(4.0, 0.0, 4.0));
    let ray = Ray {
        origin: DVec3::new(1.0, 0.0, 0.5),
        direction: DVec3::Y,
    };
    let hit = shape.hit(&ray, 9.0).expect("the ray meets the square");
    assert_eq!(hit.t, 3.0);
    assert_eq!(shape.surface(&ray, hit).normal, -DVec3::Y);
}

#[test]
fn materials_are_read_completely() {
    let scene = scene(&around(
        "<object type='sphere' material='b'/>
         <object><object type='plane' material='a'/></object>
         <material name='a'/>
         <material type='PHONG' name='b'><Diffuse r='.1' g='.2' value='2'/><specular value='0'/>
           <glossiness/><reflection g='0' glossiness='.25'/><refraction value='.5' index='1.52'/>
           <absorption r='.01' g='0' b='0'/><emission value='3'/></material>
         <material type='microfacet' name='c'><color b='0'/><roughness value='.3'/><metallic value='1'/>
           <ior value='2'/><transmittance value='.5'/></material>",
    ));
    assert_eq!(
        scene
            .objects
            .iter()
            .map(|object| object.material)
            .collect::<Vec<_>>(),
        [1, 0]
    );
    assert_eq!(scene.materials.len(), 3);
    let [a, b, c] = [0, 1, 2].map(|index| &scene.materials[index]);
    let front = Mirror {
        faces: Faces::Front,
        ..Mirror::default()
    };
    let expected = Material {
        diffuse: Rgb::splat(0.5),
        highlight: Highlight::Blinn(Gloss {
            specular: Rgb::splat(0.7),
            exponent: 20.0,
        }),
        mirror: front,
        ..Material::BLACK
    };
    assert_eq!(a, &expected);
    let expected = Material {
        diffuse: Rgb::new(0.2, 0.4, 2.0),
        highlight: Highlight::ModifiedPhong(Gloss {
            specular: Rgb::ZERO,
            exponent: 1.0,
        }),
        mirror: Mirror {
            tint: Rgb::new(1.0, 0.0, 1.0),
            spread: 0.25,
            ..front
        },
        dielectric: Dielectric {
            tint: Rgb::splat(0.5),
            index: 1.52,
            absorption: Rgb::new(0.01, 0.0, 0.0),
            ..Dielectric::OPAQUE
        },
        emission: Rgb::splat(3.0),
        lit: Faces::Front,
        ..Material::BLACK
    };
    assert_eq!(b, &expected);
    let expected = Material {
        diffuse: Rgb::new(1.0, 1.0, 0.0),
        highlight: Highlight::Microfacet {
            roughness: 0.3,
            metallic: 1.0,
        },
        dielectric: Dielectric {
            tint: Rgb::splat(0.5),
            index: 2.0,
            ..Dielectric::OPAQUE
        },
        lit: Faces::Front,
        ..Material::BLACK
    };
    assert_eq!(c, &expected);
}

#[test]
fn gamma_selects_path_tracing_and_another_default_index() {
    let text = "<xml><scene><material><refraction/></material></scene><camera gamma='srgb'/></xml>";
    let scene = scene(text);
    assert_eq!(
        (
            scene.setting.rendering.integrator(),
            scene.setting.rendering.transfer.unwrap_or_default()
        ),
        (Integrator::Path, Transfer::Srgb)
    );
    let glass = scene.materials[0].dielectric;
    assert_eq!((glass.index, glass.tint), (1.5, Rgb::ONE));
}

#[test]
fn lights_are_read_completely() {
    let scene = scene(&around(
        "<light type='ambient' name='a'><intensity value='.25'/></light>
         <light type='AMBIENT'><intensity r='.5' g='0' b='0'/></light>
         <light type='direct'><intensity/><direction x='2'/></light>
         <light type='direct'/>
         <light type='point'><intensity value='3'/><position y='4'/><size value='.5'/><attenuation value='2'/></light>
         <light type='spot'/><light/>",
    ));
    assert_eq!(scene.ambient_light(), Rgb::new(0.75, 0.25, 0.25));
    let light = |emitter, colour| Light {
        emitter,
        colour,
        scale: PI,
        shadows: Shadows::Cast,
    };
    let point = Emitter::Point {
        position: DVec3::new(0.0, 4.0, 0.0),
        radius: 0.5,
        falloff: Falloff {
            radial: [0.0, 0.0, 4.0],
            spot: None,
        },
    };
    let expected = [
        light(Emitter::Ambient, Rgb::splat(0.25)),
        light(Emitter::Ambient, Rgb::new(0.5, 0.0, 0.0)),
        light(Emitter::Distant(-DVec3::X), Rgb::ONE),
        light(Emitter::Distant(-DVec3::Z), Rgb::ZERO),
        light(point, Rgb::splat(3.0)),
    ];
    assert_eq!(scene.lights, expected);
}

#[test]
fn checkerboards_may_contain_textures() {
    let text = around(
        "<background texture='clouds.ppm'><scale y='.5'/><translate y='-1'/></background>
         <environment value='.5' texture='checkerboard'>
           <color1 r='.25' texture='checkerboard'><color2 texture='maps/a&amp;b.png'/><scale value='2'/></color1>
         </environment>",
    );
    let (source, lowered) = read(&text);
    let Scene {
        setting, textures, ..
    } = lowered.scene.expect("there are no errors");
    assert_eq!(
        setting.background,
        Tinted {
            colour: Rgb::ONE,
            texture: Some(0)
        }
    );
    assert_eq!(
        setting.environment,
        Tinted {
            colour: Rgb::splat(0.5),
            texture: Some(1)
        }
    );
    let patterns: Vec<_> = textures
        .iter()
        .map(|texture| texture.pattern.clone())
        .collect();
    let tinted = |colour, texture| Tinted { colour, texture };
    let outer = [
        tinted(Rgb::new(0.25, 1.0, 1.0), Some(2)),
        tinted(Rgb::ONE, None),
    ];
    let inner = [tinted(Rgb::ZERO, None), tinted(Rgb::ONE, Some(3))];
    let checker = |squares| Pattern::Checker {
        squares,
        side: Side::Half,
    };
    let expected = [
        Pattern::Image("clouds.ppm".to_owned()),
        checker(outer),
        checker(inner),
        Pattern::Image("maps/a&b.png".to_owned()),
    ];
    assert_eq!(patterns, expected);
    let forward = DAffine3::from_mat3_translation(
        DMat3::from_diagonal(DVec3::new(1.0, 0.5, 1.0)),
        DVec3::new(0.0, -1.0, 0.0),
    );
    assert_eq!(textures[0].inverse, forward.inverse());
    let place = textures[2]
        .inverse
        .transform_point3(DVec2::new(0.5, 1.0).extend(0.0));
    assert_eq!(place, DVec3::new(0.25, 0.5, 0.0));
    let files = source.files();
    let files: Vec<_> = files
        .iter()
        .map(|file| (file.path.as_str(), file.what.as_str()))
        .collect();
    assert_eq!(
        files,
        [
            ("clouds.ppm", "background texture"),
            ("maps/a&b.png", "environment color2 texture")
        ]
    );
}

#[test]
fn nodes_are_found_by_position_and_have_comments() {
    let text = around(
        "\n<!-- one -->\n<object name='a'><object type='sphere'><!-- two --> <scale value='2'/></object></object>\n\
         <material name='m'><diffuse r='.5'/></material>",
    );
    let (source, _) = read(&text);
    for (part, node) in [
        ("'5'", Node::View),
        ("'a'", Node::Object(0)),
        ("'2'", Node::Object(1)),
        ("'.5'", Node::Material(0)),
    ] {
        let at = text.find(part).expect("a part of the text");
        let span = text::Span::new(at, at + part.len());
        assert_eq!(source.node_at(span), Some(node), "{part}");
        assert_eq!(source.nodes_in(span), [node], "{part}");
    }
    assert_eq!(source.comment(Node::Object(0)), Some("one"));
    assert_eq!(source.comment(Node::Object(1)), Some("two"));
    assert_eq!(source.comment(Node::Material(0)), None);
}

#[test]
fn a_hundred_thousand_nested_elements_are_lowered() {
    let levels = 100_000;
    let nested = |open: &str, close: &str| around(&(open.repeat(levels) + &close.repeat(levels)));
    let deep = scene(&nested(
        "<object type='sphere'><translate x='1'/>",
        "</object>",
    ));
    assert_eq!(deep.objects[levels - 1].shape, sphere([1e5, 0.0, 0.0], 1.0));
    let text = nested("<color1 texture='checkerboard'>", "</color1>");
    let text = text.replacen("<color1", "<background", 1);
    let last = text.rfind("</color1>").expect("it is closed");
    let text = format!("{}</background>{}", &text[..last], &text[last + 9..]);
    let (source, lowered) = read(&text);
    let rows = source.fields(Node::Background);
    assert!((200..300).contains(&rows.len()), "{}", rows.len());
    assert_eq!(
        lowered.scene.map(|scene| scene.textures.len()),
        Some(levels)
    );
    let (source, lowered) = read(&nested("<nonsense>", "</nonsense>"));
    let whole = text::Span::new(0, 10_000_000);
    assert_eq!(lowered.diagnostics.warnings(), 1);
    assert_eq!(source.nodes_in(whole), [Node::View]);
}

#[test]
fn names_in_messages_are_short_and_printable() {
    let long = "n".repeat(60);
    let text = around(&format!(
        "<object name='a&#10;b&#x202e;'/><object name='{long}'/>"
    ));
    let (source, _) = read(&text);
    let name = |at| source.name(Node::Object(at));
    assert_eq!(name(0), "a\\nb\\u{202e} (group)");
    assert_eq!(name(1), format!("{}… (group)", "n".repeat(48)));
}

#[test]
fn lines_may_end_in_cr_alone() {
    let (_, lowered) = read(&EXAMPLE.replace('\n', "\r"));
    assert!(lowered.diagnostics.is_empty() && lowered.scene.is_some());
}
