//! Objects of type `obj`.

use std::sync::Arc;

use glam::{DAffine3, DVec3};

use super::{around, read_with, shown};
use crate::FileKind;
use crate::node::Node;
use geometry::{Instance, Ray, Shape};
use scene::{
    Dielectric, Faces, Gloss, Highlight, Maps, Material, Materials, Meshes, Mirror, NoMesh, Object,
    Pattern, Rgb, Scene, Texture,
};

const CORNERS: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

/// A mesh with this name, whose libraries all have the same content.
pub(super) fn meshes(name: &str, mesh: &str, library: &str) -> Meshes {
    let read = obj::read(mesh.as_bytes(), |_| Ok::<_, String>(library));
    let model = read.unwrap_or_else(|errors| panic!("{mesh}: {errors:?}"));
    [(name.to_owned(), Ok(Arc::new(model)))]
        .into_iter()
        .collect()
}

/// A triangle of material `a` and one without.
fn two_faces(library: &str) -> Meshes {
    let mesh = format!("mtllib a.mtl\n{CORNERS}f 1 2 3\nusemtl a\nf 1 3 2\n");
    meshes("a.obj", &mesh, library)
}

fn scene(text: &str, meshes: &Meshes) -> Scene {
    let (_, lowered) = read_with(text, meshes);
    let said = shown(text, &lowered);
    lowered.scene.unwrap_or_else(|| panic!("{text}\n{said:#?}"))
}

fn instance(object: &Object) -> &Instance {
    match &object.shape {
        Shape::Mesh(instance) => instance,
        other => panic!("{other:?}"),
    }
}

fn tags(object: &Object) -> Vec<Option<u32>> {
    instance(object).tags().collect()
}

/// The material that a library with these statements defines.
fn shiny(diffuse: [f64; 3], specular: [f64; 3], exponent: f64) -> Material {
    Material {
        diffuse: diffuse.into(),
        highlight: Highlight::Blinn(Gloss {
            specular: specular.into(),
            exponent,
        }),
        mirror: Mirror {
            faces: Faces::Front,
            ..Mirror::default()
        },
        ..Material::BLACK
    }
}

/// The material that a library without statements defines.
fn silent() -> Material {
    shiny([1.0; 3], [0.0; 3], 0.0)
}

/// A dielectric with this tint.
fn clear(tint: [f64; 3], index: f64, material: Material) -> Material {
    Material {
        dielectric: Dielectric {
            tint: tint.into(),
            index,
            ..Dielectric::OPAQUE
        },
        lit: Faces::Front,
        ..material
    }
}

#[test]
fn materials_come_from_the_library() {
    let specular = [0.2, 0.4, 0.6];
    let mirror = |material: Material| Material {
        mirror: Mirror {
            tint: specular.into(),
            ..material.mirror
        },
        ..material
    };
    let of_specular = || shiny([1.0; 3], specular, 0.0);
    for (said, expected) in [
        ("", silent()),
        ("Kd .1 .2 .3", shiny([0.1, 0.2, 0.3], [0.0; 3], 0.0)),
        ("Ks .5\nNs 7", shiny([1.0; 3], [0.5; 3], 7.0)),
        ("Ns -7", silent()),
        (
            "Ke 3 2 .5",
            Material {
                emission: Rgb::new(3.0, 2.0, 0.5),
                ..silent()
            },
        ),
        (
            "Ni 1.5",
            Material {
                lit: Faces::Both,
                ..clear([0.0; 3], 1.5, silent())
            },
        ),
        ("illum 0\nKs .2 .4 .6\nTf 0.5", of_specular()),
        ("illum 1\nKs .2 .4 .6", of_specular()),
        ("illum 2\nKs .2 .4 .6", of_specular()),
        ("illum 3\nKs .2 .4 .6", mirror(of_specular())),
        ("illum 4\nKs .2 .4 .6\nTf 0.5", mirror(of_specular())),
        ("illum 5\nKs .2 .4 .6\nTf 0.5", mirror(of_specular())),
        (
            "illum 6\nKs .2 .4 .6",
            clear([1.0; 3], 1.0, mirror(of_specular())),
        ),
        (
            "illum 7\nKs .2 .4 .6\nTf 0 .5 1\nNi 1.3",
            clear([1.0, 0.5, 0.0], 1.3, mirror(of_specular())),
        ),
        ("illum 8\nKs .2 .4 .6", of_specular()),
        ("illum 10\nKs .2 .4 .6", of_specular()),
    ] {
        let meshes = two_faces(&format!("newmtl a\n{said}\n"));
        let scene = scene(&around("<object type='obj' name='a.obj'/>"), &meshes);
        let expected = Materials::from_iter([Material::unlit(Rgb::ONE), expected]);
        assert_eq!(scene.materials, expected, "{said}");
        assert_eq!(tags(&scene.objects[0]), [Some(0), Some(1)]);
    }
}

/// A picture's name is relative to the library, whose name is relative to the mesh.
#[test]
fn picture_names_are_relative_to_the_library() {
    let mesh = format!("mtllib ../skins/a.mtl\n{CORNERS}usemtl a\nf 1 2 3\n");
    let library = "newmtl a\nmap_Kd wood/oak.png\nmap_Ks ../shine.png\n";
    let meshes = meshes("meshes/a.obj", &mesh, library);
    let text = around("<object type='obj' name='meshes/a.obj'/>");
    let meaning = scene(&text, &meshes);
    let keys = [
        "meshes/../skins/wood/oak.png",
        "meshes/../skins/../shine.png",
    ];
    let textures = keys.map(|key| Texture {
        inverse: DAffine3::IDENTITY,
        pattern: Pattern::Image(key.to_owned()),
    });
    assert_eq!(meaning.textures, textures);
    let maps = Maps {
        diffuse: Some(0),
        specular: Some(1),
        ..Maps::default()
    };
    let expected = Material {
        maps: maps.boxed(),
        ..silent()
    };
    assert_eq!(meaning.materials[1], expected);

    let (source, _) = read_with(&text, &meshes);
    let files = source.files();
    let files = files.iter().map(|file| {
        let said = file.span.of(&text);
        (file.kind, file.path.as_str(), file.what.as_str(), said)
    });
    let object = "meshes/a.obj (obj)";
    let maps = [
        format!("{object} map_Kd {}", keys[0]),
        format!("{object} map_Ks {}", keys[1]),
    ];
    let name = "meshes/a.obj";
    let expected = [
        (FileKind::Mesh, name, object, name),
        (FileKind::Picture, keys[0], maps[0].as_str(), name),
        (FileKind::Picture, keys[1], maps[1].as_str(), name),
    ];
    assert_eq!(files.collect::<Vec<_>>(), expected);
}

#[test]
fn an_objects_own_material_covers_all_faces() {
    let library = "newmtl a\nmap_Kd none.png\n";
    let own = "<material name='m'/>";
    for (object, materials, material, warnings) in [
        ("material='m'", 1, 0, 0),
        // A material that is named but not defined is white.
        ("material='n'", 2, 1, 1),
    ] {
        let text = around(&format!("<object type='obj' name='a.obj' {object}/>{own}"));
        let meshes = two_faces(library);
        let scene = scene(&text, &meshes);
        assert_eq!(scene.materials.len(), materials, "{object}");
        assert_eq!(scene.objects[0].material, material, "{object}");
        assert_eq!(tags(&scene.objects[0]), [None, None], "{object}");
        assert!(scene.textures.is_empty());
        let (_, lowered) = read_with(&text, &meshes);
        let is_about_names = |found: &&text::Diagnostic| found.message.contains("`n`");
        let found = lowered.diagnostics.iter().filter(is_about_names).count();
        assert_eq!(found, warnings);
    }
}

#[test]
fn instances_share_the_mesh_and_its_materials() {
    let text = around(
        "<object type='obj' name='a.obj'/>
         <object name='group'><translate x='2'/><object type='obj' name='a.obj'/></object>
         <object type='obj' name='a.obj' material='m'/><object type='sphere'/>
         <material name='m'/>",
    );
    let meshes = two_faces("newmtl a\nKd 1 0 0\n");
    let model = meshes
        .get("a.obj")
        .and_then(Result::ok)
        .expect("it is read");
    let (source, lowered) = read_with(&text, &meshes);
    let scene = lowered.scene.expect("there are no errors");
    for object in scene.objects.iter().take(3) {
        assert!(Arc::ptr_eq(instance(object).mesh(), &model.mesh));
    }
    // The text's own, white, the library's.
    assert_eq!(scene.materials.len(), 3);
    assert_eq!(tags(&scene.objects[1]), [Some(1), Some(2)]);
    assert_eq!(tags(&scene.objects[0]), tags(&scene.objects[1]));
    assert_eq!(scene.objects[1].shape.bounds().min, 2.0 * DVec3::X);
    // Only the text's own are listed.
    let materials = source.nodes().iter();
    let materials = materials.filter(|node| matches!(node, Node::Material(_)));
    assert_eq!(materials.collect::<Vec<_>>(), [Node::Material(0)]);
    assert_eq!(source.material(0), None);
}

#[test]
fn unread_meshes_are_not_drawn() {
    let text = around("<object type='sphere'/><object type='obj' name='a.obj'/>");
    let (source, lowered) = read_with(&text, &Meshes::default());
    assert_eq!(*lowered.diagnostics, []);
    assert_eq!(source.drawn(1), None);
    assert_eq!(lowered.scene.expect("no errors").objects.len(), 1);
}

#[test]
fn unreadable_meshes_are_warnings_at_every_name_and_leave_their_objects_out() {
    let fault = NoMesh::Unread {
        reason: "one thing".to_owned(),
        hint: Some("do this".to_owned()),
    };
    let meshes = [("a.obj".to_owned(), Err(fault))].into_iter().collect();
    let text = "<xml>\n<scene>\n<object type='obj' name='a.obj'/>\n\
                <object type='obj' name='a.obj' material='m'/>\n<material name='m'/>\n</scene>\n</xml>";
    let (_, lowered) = read_with(text, &meshes);
    let hint = Some("the object is left out; do this");
    let mut named = lowered.diagnostics.iter();
    assert!(named.all(|found| found.span.of(text) != "a.obj" || found.hint.as_deref() == hint));
    let shown = shown(text, &lowered);
    let shown: Vec<_> = shown.iter().filter(|line| line.contains("a.obj")).collect();
    assert_eq!(
        shown,
        [
            "3:26 warning: a.obj (obj): one thing",
            "4:26 warning: a.obj (obj): one thing",
        ]
    );
    assert!(lowered.scene.is_some_and(|scene| scene.objects.is_empty()));
}

#[test]
fn warnings_about_a_file_are_reported_at_its_first_name() {
    let mesh = format!("curv 0 1\nmtllib a.mtl\n{CORNERS}usemtl a\nf 1 2 3\n");
    let meshes = meshes("a.obj", &mesh, "newmtl a\nKd red\n");
    let object = "<object type='obj' name='a.obj'/>";
    let dressed = "<object type='obj' name='a.obj' material='m'/><material name='m'/>";
    let said = |text: &str| {
        let (_, lowered) = read_with(&around(text), &meshes);
        assert!(lowered.scene.is_some(), "{text}");
        let found = lowered.diagnostics.iter();
        let found = found.map(text::Diagnostic::message_with_file);
        found.collect::<Vec<_>>()
    };
    let line = "a.obj:1:1: `curv` is ignored";
    let library = "a.mtl:2:4: Kd: `red` is not a number";
    assert_eq!(said(&format!("{object}{object}")), [line, library]);
    // An unused library is not checked.
    assert_eq!(said(dressed), [line]);
    let (_, lowered) = read_with(&around(object), &meshes);
    let excerpts = lowered.diagnostics.iter().map(|found| {
        let shown = found.shown("");
        (shown.text.to_owned(), shown.span.of(shown.text).to_owned())
    });
    let quoted = |line: &str, word: &str| (line.to_owned(), word.to_owned());
    assert_eq!(
        excerpts.collect::<Vec<_>>(),
        [quoted("curv 0 1", "curv"), quoted("Kd red", "red")]
    );
    // What the line would have set keeps its default.
    let scene = scene(&around(object), &meshes);
    let expected = Materials::from_iter([Material::unlit(Rgb::ONE), silent()]);
    assert_eq!(scene.materials, expected);
}

#[test]
fn a_mesh_without_faces_is_reported_with_its_lines_and_leaves_its_objects_out() {
    let read = obj::read(b"v 0 0 0\nf 1 1\n", |_| Ok::<_, String>(""));
    let fault = NoMesh::Malformed(read.expect_err("no face is left"));
    let meshes = [("a.obj".to_owned(), Err(fault))].into_iter().collect();
    let text = around("<object type='obj' name='a.obj'/><object type='obj' name='a.obj'/>");
    let (_, lowered) = read_with(&text, &meshes);
    let found = lowered.diagnostics.iter();
    let found: Vec<_> = found.map(text::Diagnostic::message_with_hint).collect();
    let none = "a.obj:2:6: a.obj (obj): the file has no faces that can be used; \
                the object is left out";
    let line = "a.obj:2:6: f: expected at least three corners, found 2; the face is left out";
    assert_eq!(found, [line, none, none]);
    assert!(lowered.scene.is_some_and(|scene| scene.objects.is_empty()));
}

#[test]
fn options_of_maps_place_the_picture() {
    let library = "newmtl a\nmap_Kd a.png -s 4 2 1 -o .5 .25\nmap_Ks -clamp on b.png\n";
    let scene = scene(
        &around("<object type='obj' name='a.obj'/>"),
        &two_faces(library),
    );
    let [repeated, clamped] = &scene.textures[..] else {
        panic!("{:?}", scene.textures);
    };
    assert_eq!(repeated.pattern, Pattern::Image("a.png".to_owned()));
    let uv = DVec3::new(0.5, 0.5, 0.0);
    let place = repeated.inverse.transform_point3(uv);
    assert_eq!(place, DVec3::new(2.5, 1.25, 0.0));
    assert_eq!(clamped.inverse, DAffine3::IDENTITY);
    assert_eq!(clamped.pattern, Pattern::Clamped("b.png".to_owned()));
}

/// The triangle lies in the plane x + z = 0, which scaled by 2 along x becomes x + 2z = 0; its
/// corners' normals (.6, 0, .8) become (.3, 0, .8), divided by their length √.73.
#[test]
fn normals_transform_by_the_inverse_transpose() {
    let mesh = "v 0 0 0\nv 1 0 -1\nv 0 1 0\nvn .6 0 .8\nf 1//1 2//1 3//1\n";
    let meshes = meshes("a.obj", mesh, "");
    let object = "<object type='obj' name='a.obj'><scale x='2'/></object>";
    let scene = scene(&around(object), &meshes);
    let shape = &scene.objects[0].shape;
    let ray = Ray {
        origin: DVec3::new(0.4, 0.2, 5.0),
        direction: DVec3::NEG_Z,
    };
    let hit = shape.hit(&ray, f64::INFINITY).expect("it is there");
    let surface = shape.surface(&ray, hit);
    assert!((hit.t - 5.2).abs() < 1e-12);
    let normal = DVec3::new(1.0, 0.0, 2.0) / 5.0_f64.sqrt();
    assert!(surface.normal.distance(normal) < 1e-12, "{surface:?}");
    let shading = DVec3::new(0.3, 0.0, 0.8) / 0.73_f64.sqrt();
    assert!(surface.shading.distance(shading) < 1e-12, "{surface:?}");
}

#[test]
fn an_overflowing_mesh_is_an_error() {
    let meshes = meshes("a.obj", "v 0 0 0\nv 1e200 0 0\nv 0 1e200 0\nf 1 2 3\n", "");
    for (transforms, error) in [
        (
            "<scale value='1e200'/>",
            "its transforms make it too small or too large",
        ),
        ("<rotate z='1' angle='30'/>", "it is too large"),
        ("", "it is too large"),
    ] {
        let text = around(&format!(
            "<object type='obj' name='a.obj'>{transforms}</object>"
        ));
        let (_, lowered) = read_with(&text, &meshes);
        let message = format!("a.obj (obj): {error}");
        assert_eq!(lowered.diagnostics[0].message, message);
        assert!(lowered.scene.is_none());
    }
}
