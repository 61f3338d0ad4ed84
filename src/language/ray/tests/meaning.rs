//! The meaning of well-formed texts.

use glam::DVec3;

use super::{read, scene, spelled};
use crate::coefficients::Coefficients;
use crate::node::Node;
use crate::tests::shown;
use geometry::{Affine, Cone, Cuboid, Cylinder, Ellipsoid, Shape, Solid, Sphere};
use scene::{Light, Material, Materials, Object};
use text::Span;

const EXAMPLE: &str = include_str!("../../../../scenes/example.ray");

#[test]
fn the_example_of_the_format() {
    let (_, lowered) = read(EXAMPLE);
    assert_eq!(shown(EXAMPLE, &lowered), [""; 0]);
    let scene = lowered.scene.expect("no errors");
    assert_eq!(scene.ambient, DVec3::ONE);
    let light = Light::point(DVec3::new(0.0, 5.0, 5.0), DVec3::ONE);
    assert_eq!(scene.lights, [light]);
    let material = |index| Coefficients {
        ambient: DVec3::splat(0.1),
        diffuse: DVec3::splat(0.45),
        specular: DVec3::splat(0.5),
        exponent: 5.0,
        reflection: 0.5,
        transmission: 0.1,
        index,
    };
    let materials = [material(1.6), material(1.1)].map(Material::from);
    assert_eq!(scene.materials, Materials::from_iter(materials));
    let sphere = Shape::Solid(Solid::Sphere(Sphere {
        centre: DVec3::ZERO,
        radius: 1.5,
    }));
    let frame = Affine::new(
        DVec3::ZERO,
        [DVec3::X, DVec3::Y, DVec3::Z],
        DVec3::new(0.5, 0.5, 1.0),
    );
    let cuboid = Shape::Solid(Solid::Cuboid(Box::new(Cuboid(
        frame.expect("a right-angled frame"),
    ))));
    let objects = [(sphere, 0), (cuboid, 1)].map(|(shape, material)| Object { shape, material });
    assert!(scene.objects.iter().eq(&objects));
}

#[test]
fn the_example_as_web_pages_give_it() {
    let from_page = EXAMPLE.replace(' ', "\u{A0}").replace('\n', "\r\r\n");
    assert_eq!(scene(&format!("\u{FEFF}{from_page}")), scene(EXAMPLE));
}

#[test]
fn each_shape_has_its_fields_in_order() {
    let numbers = "1 2 3  0 1 0  0 0 1  1 0 0  4 5 6";
    let frame = Affine::new(
        DVec3::new(1.0, 2.0, 3.0),
        [DVec3::Y, DVec3::Z, DVec3::X],
        DVec3::new(4.0, 5.0, 6.0),
    )
    .expect("a right-angled frame");
    for (keyword, shape) in [
        (
            "ellipsoid",
            Shape::Solid(Solid::Ellipsoid(Box::new(Ellipsoid(frame)))),
        ),
        ("box", Shape::Solid(Solid::Cuboid(Box::new(Cuboid(frame))))),
        (
            "cylinder",
            Shape::Solid(Solid::Cylinder(Box::new(Cylinder(frame)))),
        ),
        ("cone", Shape::Solid(Solid::Cone(Box::new(Cone(frame))))),
    ] {
        let text = spelled(&format!("HEAD 1 {keyword} {numbers} MAT"));
        assert_eq!(scene(&text).objects[0].shape, shape, "{keyword}");
    }
}

#[test]
fn unusual_values_are_used_as_given() {
    let scene = scene(&spelled(
        "HEAD 1 sphere 0 0 0 1  2 0 0  0 -1 0  0 0 3  -4 -5 6 -7",
    ));
    let material = Coefficients {
        ambient: DVec3::new(2.0, 0.0, 0.0),
        diffuse: DVec3::new(0.0, -1.0, 0.0),
        specular: DVec3::new(0.0, 0.0, 3.0),
        exponent: -4.0,
        reflection: -5.0,
        transmission: 6.0,
        index: -7.0,
    };
    assert_eq!(scene.materials, Materials::from_iter([material.into()]));
}

#[test]
fn nearby_equal_materials_are_merged() {
    let plain = "sphere 0 0 0 1 MAT ";
    let other = "sphere 0 0 0 1  1 1 1  1 1 1  1 1 1  1 0 0 1 ";
    let scene = scene(&spelled(&format!("HEAD 4 {plain}{plain}{other}{plain}")));
    let indices: Vec<_> = scene.objects.iter().map(|object| object.material).collect();
    assert_eq!((indices, scene.materials.len()), (vec![0, 0, 1, 0], 2));
}

#[test]
fn directions_are_normalised() {
    let long = scene(&spelled(
        "HEAD 1 box 0 0 0  2 0 0  0 1e-200 0  0 0 1e200  1 1 1 MAT",
    ));
    let short = scene(&spelled("HEAD 1 box 0 0 0 AXES 1 1 1 MAT"));
    assert_eq!(long, short);
}

#[test]
fn nodes_and_their_names() {
    let text = spelled("HEAD 2 sphere 0 0 0 1 MAT box 0 0 0 AXES 1 1 1 MAT");
    let (source, _) = read(&text);
    let names: Vec<_> = source
        .nodes()
        .iter()
        .map(|node| source.name(node))
        .collect();
    assert_eq!(
        names,
        [
            "render",
            "view",
            "ambient",
            "light 1",
            "object 1 (sphere)",
            "object 2 (box)"
        ]
    );
}

#[test]
fn nodes_exist_as_far_as_the_text_is_understood() {
    let text = spelled("1 1 x 2 0 5 5 1 1 1 0 1 sphere 0 0 0 -1 MAT box 0 0 0  1 0 0  0 1");
    let (source, _) = read(&text);
    let fields: Vec<_> = source
        .nodes()
        .iter()
        .map(|node| {
            let fields = source.fields(node);
            let keys: Vec<_> = fields.iter().map(|placed| placed.field.key).collect();
            format!("{}: {}", source.name(node), keys.join(" "))
        })
        .collect();
    assert_eq!(
        fields,
        [
            "render: integrator depth spp filter transfer exposure falloff gloss noise",
            "view: eye target up fov size",
            "ambient: colour",
            "light 1: position colour",
            "object 1 (sphere): centre radius ka kd ks ns kr kt ior",
            "object 2 (box): corner vl",
        ]
    );
}

#[test]
fn every_field_has_the_place_of_its_numbers() {
    let text = "// view: fov 30 eye 7 8 9\n1 2 3 1 4 5 6 .7 .8 .9 1 sphere 10 11 12 13 // radius\n\
        0 0 0 0 0 0 0 0 0 14 .1 .2 1.5";
    let (source, _) = read(text);
    let said: Vec<_> = source
        .nodes()
        .iter()
        .filter(|node| *node != Node::Render)
        .flat_map(|node| source.fields(node))
        .map(|placed| {
            let words: Vec<_> = placed.spans.iter().map(|span| span.of(text)).collect();
            format!("{} {}", placed.field.key, words.join(" "))
        })
        .collect();
    assert_eq!(
        said,
        [
            "eye 7 8 9",
            "target ",
            "up ",
            "fov 30",
            "size ",
            "colour 1 2 3",
            "position 4 5 6",
            "colour .7 .8 .9",
            "centre 10 11 12",
            "radius 13",
            "ka 0 0 0",
            "kd 0 0 0",
            "ks 0 0 0",
            "ns 14",
            "kr .1",
            "kt .2",
            "ior 1.5",
        ]
    );
}

#[test]
fn a_place_belongs_to_the_node_whose_text_is_there() {
    // A `^` marks each place queried, in the order of the names.
    let head = "1 1 1 1 0 5 5 1 1 1 2 sphere 0 0 0 1 /*";
    let text = format!(
        "{}// centred\n// view: fov 30\n 0 0 0 0 0 0 0 0 0 5 0 0 1 box 0",
        head.trim_end_matches("/*")
    );
    let (source, _) = read(&text);
    let node_at = |part: &str| {
        let start = text.find(part).expect("the text holds it");
        source.node_at(Span::new(start, start + part.len()))
    };
    for (part, node) in [
        ("1 1 1 ", Some(Node::Ambient)),
        ("0 5 5", Some(Node::Light(0))),
        ("sphere", Some(Node::Object(0))),
        ("centred", Some(Node::Object(0))),
        ("fov", Some(Node::View)),
        ("5 0 0", Some(Node::Object(0))),
        ("box 0", Some(Node::Object(1))),
    ] {
        assert_eq!(node_at(part), node, "{part}");
    }
    let count = text.find("2 sphere").expect("the text holds it");
    assert_eq!(source.node_at(Span::new(count, count + 1)), None);
    assert_eq!(source.node_at(Span::at(text.len() + 9)), None);
    assert_eq!(source.span(Node::Light(0)).of(&text), "0 5 5 1 1 1");
    assert_eq!(source.span(Node::Object(1)).of(&text), "box 0");
    assert_eq!(source.span(Node::View).of(&text), "// view: fov 30");
}
