mod libraries;
mod odd_lines;
mod ply;
mod polygons;
mod stl;

use std::path::PathBuf;
use std::sync::Arc;

use glam::{DVec2, DVec3};
use proptest::prelude::*;

use super::{Edges, Map, Material, Model, mesh, plain, read};
use geometry::{Affine, Instance, Mesh, Ray, Shape};

const SQUARE: &str = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\n";

/// Finds no library.
fn no_library(_: &str) -> Result<Vec<u8>, String> {
    Err("no such file".to_owned())
}

fn read_alone(text: &str) -> Result<Model, Vec<super::Finding>> {
    read(text.as_bytes(), no_library)
}

fn model(text: &str) -> Model {
    read_alone(text).unwrap_or_else(|errors| panic!("{text}: {}", errors[0]))
}

fn messages(findings: &[super::Finding]) -> Vec<String> {
    findings.iter().map(ToString::to_string).collect()
}

/// The mesh placed without a transformation; the tag of each slot is its number.
fn shape(model: Model) -> Shape {
    let frame = Affine::of_matrix(DVec3::AXES, DVec3::ZERO).expect("the axes span a volume");
    let tags = (0..model.materials.len() as u32).collect();
    Shape::Mesh(Box::new(Instance::new(model.mesh, &frame, tags)))
}

/// Triangle, slot, texture coordinates and shading normal where a ray down at x, y hits a mesh.
fn seen(shape: &Shape, x: f64, y: f64) -> Option<(u32, u32, DVec2, DVec3)> {
    let ray = Ray {
        origin: DVec3::new(x, y, 9.0),
        direction: DVec3::NEG_Z,
    };
    let hit = shape.hit(&ray, f64::INFINITY)?;
    let slot = shape.tag(hit).expect("each slot has a tag");
    let shading = shape.surface(&ray, hit).shading;
    Some((hit.part, slot, shape.chart(&ray, hit).uv, shading))
}

#[test]
fn polygons_become_fans_in_order() {
    // A pentagon and a square beside it.
    let text = "v 0 0 0\nv 4 0 0\nv 5 3 0\nv 2 5 0\nv -1 3 0\nf 1 2 3 4 5\n\
                v 10 0 0\nv 12 0 0\nv 12 2 0\nv 10 2 0\nf -4 -3 -2 -1\n";
    let model = model(text);
    assert_eq!(model.mesh.len(), 5);
    assert_eq!(model.materials, [None]);
    let shape = shape(model);
    for (x, y, triangle) in [
        (4.0, 1.0, Some(0)),
        (2.0, 3.0, Some(1)),
        (0.0, 2.0, Some(2)),
        (11.5, 0.5, Some(3)),
        (10.5, 1.5, Some(4)),
        (7.0, 1.0, None),
    ] {
        assert_eq!(seen(&shape, x, y).map(|seen| seen.0), triangle, "{x} {y}");
    }
}

#[test]
fn corners_refer_to_texture_coordinates_and_normals() {
    let values = "vt 0 0\nvt 1 0 7\nvt 1 1\nvt 0.5\nvn 0 0 1\nvn .6 0 .8\nvn 0 0 -3\n";
    let (up, leans) = (DVec3::Z, DVec3::new(0.6, 0.0, 0.8));
    for (face, uv, normal) in [
        ("f 1 2 3", [0.0, 0.0], up),
        ("f 1/1 2/2 3/3", [0.75, 0.25], up),
        ("f 1/1/1 2/2/1 3/3/1", [0.75, 0.25], up),
        ("f 1//2 2//2 3//2", [0.0, 0.0], leans),
        ("f -4/-4/-2 -3/-3/-2 -2/-2/-2", [0.75, 0.25], leans),
        ("f 1/1/2 2/2/2 3/3", [0.75, 0.25], up),
        ("f 1/4 2/4 3", [0.375, 0.0], up),
        ("f 1//3 2//3 3//3", [0.0, 0.0], -up),
    ] {
        let shape = shape(model(&format!("{SQUARE}{values}{face}")));
        let (_, _, found, shading) = seen(&shape, 0.5, -0.5).expect("the face is there");
        assert_eq!(found, DVec2::from(uv), "{face}");
        assert!(shading.distance(normal) < 1e-15, "{face}");
    }
}

/// Even if there are as many as positions.
#[test]
fn values_without_references_are_dropped() {
    let values = "vt 1 1\nvt 1 1\nvt 1 1\nvn 1 0 0\nvn 1 0 0\nvn 1 0 0\n";
    let shape = shape(model(&format!("{SQUARE}{values}f 1 2 3")));
    let expected = Some((0, 0, DVec2::ZERO, DVec3::Z));
    assert_eq!(seen(&shape, 0.5, -0.5), expected);
}

#[test]
fn any_layout_of_the_text_is_accepted() {
    for text in [
        "v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 3\r\n",
        "\u{feff}# a\n\tv  0 0 0 # b\nv 1 0 0 1\nv 0 1 0 .5 .5 .5\n\n  f 1 2 3",
        "f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0",
        "v 0 \\\n 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 \\\n3 \\",
        "v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r",
        "v 0 0 0\rv 1 0 0\n\r\rv 0 1 0\r\r\nf 1 2 \\\r3\r\n",
        "# C:\\models\\\nv 0 0 0\nv 1 0 0 # \\\nv 0 1 \\\n 0 #\\\nf 1 2 3",
        "o x\ng y z\ns off\nv 0 0 0\nv 1 0 0\nv 0 1 0\np 1\nl 1 2\nf 1 2 3",
    ] {
        let model = model(text);
        assert_eq!((model.mesh.len(), model.warnings.len()), (1, 0), "{text}");
        assert!(seen(&shape(model), 0.2, 0.2).is_some(), "{text}");
    }
    let latin: &[u8] = b"# caf\xe9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3";
    assert!(read(latin, no_library).is_ok());
}

#[test]
fn materials_come_from_libraries() {
    let library = "# two\nnewmtl red one\nKd 1 0 0\nKs .5\nNs 20\nNi 1.5\nillum 6\nTf .1 .2 .3\n\
                   map_Kd -s 2 2 -clamp on wood grain.png\nd 1\nNEWMTL blue\nkd 0 0 1 # blue\n";
    let text = "mtllib my colours.mtl # two\nusemtl blue\nusemtl red one # shiny\nf 1 2 3\nusemtl blue\nf 1 3 4\n";
    let mut asked = Vec::new();
    let model = read(format!("{SQUARE}f 1 2 2\n{text}").as_bytes(), |name| {
        asked.push(name.to_owned());
        Ok::<_, String>(library)
    });
    let model = model.expect("a valid mesh");
    assert_eq!(asked, ["my colours.mtl"]);
    assert_eq!(model.warnings, []);
    let plain = Material {
        library: "my colours.mtl".into(),
        diffuse: [0.0, 0.0, 1.0],
        specular: [0.0; 3],
        emission: [0.0; 3],
        exponent: 0.0,
        index: 1.0,
        illumination: 2,
        filter: [0.0; 3],
        diffuse_map: None,
        specular_map: None,
    };
    let red = Material {
        diffuse: [1.0, 0.0, 0.0],
        specular: [0.5; 3],
        exponent: 20.0,
        index: 1.5,
        illumination: 6,
        filter: [0.1, 0.2, 0.3],
        diffuse_map: Some(Map {
            path: "wood grain.png".into(),
            scale: [2.0; 2],
            offset: [0.0; 2],
            edges: Edges::Clamp,
        }),
        ..plain.clone()
    };
    assert_eq!(model.materials, [None, Some(plain), Some(red)]);
    let shape = shape(model);
    assert_eq!(
        seen(&shape, 0.5, -0.5).map(|seen| (seen.0, seen.1)),
        Some((1, 2))
    );
    assert_eq!(
        seen(&shape, -0.5, 0.5).map(|seen| (seen.0, seen.1)),
        Some((2, 1))
    );
}

#[test]
fn several_libraries_on_a_line_are_read_one_by_one() {
    let text = format!("mtllib a.mtl b.mtl\nmtllib a.mtl b.mtl\n{SQUARE}usemtl b\nf 1 2 3\n");
    let mut asked = Vec::new();
    let model = read(text.as_bytes(), |name| {
        asked.push(name.to_owned());
        if name == "b.mtl" {
            Ok(b"newmtl b")
        } else {
            Err("no such file".to_owned())
        }
    });
    let model = model.expect("a valid mesh");
    assert_eq!(asked, ["a.mtl b.mtl", "a.mtl", "b.mtl"]);
    assert_eq!(
        messages(&model.library_warnings),
        ["line 1, column 8: cannot read `a.mtl`: no such file"]
    );
    assert_eq!(
        model.materials[1].as_ref().map(|m| &*m.library),
        Some("b.mtl")
    );
}

#[test]
fn doubtful_lines_get_warnings() {
    let text = format!("{SQUARE}curv 0 1 1 2\nusemtl \u{1b}gold\nf 1 2 3\n");
    let model = model(&text);
    assert_eq!(
        messages(&model.warnings),
        ["line 5, column 1: `curv` is ignored"]
    );
    assert_eq!(
        messages(&model.library_warnings),
        ["line 6, column 8: no library defines `\\u{1b}gold`"]
    );
    assert_eq!(model.materials, [None, None]);
}

#[test]
fn triangles_and_libraries_are_limited() {
    let text = format!("{SQUARE}f 1 2 3 4\nf 1 2 3");
    assert!(mesh::read(text.as_bytes(), 3, no_library).is_ok());
    let errors = mesh::read(text.as_bytes(), 2, no_library).expect_err("three triangles");
    let shown = errors[0].to_string();
    assert_eq!(shown, "line 6, column 1: f: more than 2 triangles");
    let libraries = |count: usize| {
        let text = format!("{}{SQUARE}f 1 2 3", "mtllib a.mtl\n".repeat(count));
        messages(&model(&text).warnings)
    };
    assert_eq!(libraries(64), [""; 0]);
    let warning = "line 65, column 1: more than 64 mtllib statements";
    assert_eq!(libraries(65), [warning]);
}

/// The course's teapot has 80 triangles and 3120 quadrilaterals, as counted with `awk`.
#[test]
fn the_teapot_is_read_completely() {
    let Some(folder) = std::env::var_os("HALFLIGHT_EXTRA_SCENES").map(PathBuf::from) else {
        return;
    };
    for (name, triangles) in [
        ("teapot.obj", 80 + 2 * 3120),
        ("teapot-low.obj", 16 + 2 * 112),
    ] {
        let bytes = std::fs::read(folder.join("utah").join(name)).expect("the course's mesh");
        let model = read(&bytes, no_library).expect("a valid mesh");
        assert_eq!(model.mesh.len(), triangles);
        assert_eq!(model.warnings, []);
        let bounds = shape(model).bounds();
        let size = bounds.size();
        assert!(20.0 < size.x && size.x < 40.0 && size.z < size.x, "{size}");
    }
}

const WHOLE: &str = "mtllib a.mtl\no x\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 1\n\
                     vn 0 0 1\nusemtl a\nf 1/1/1 2/2/1 3/2/1 4/1/1\nusemtl b\nf -1 -2 \\\n -3\n";
const LIBRARY: &str =
    "newmtl a\nKd 1 .5 0\nKs .5\nNs 3\nillum 2\nmap_Kd -o 1 2 a b.png\nnewmtl b\n";

const CORNERS: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 1 1\n\
                       vn 0 0 1\nvn 0 1 0\n";

/// What is read of a text.
type Content = (
    Arc<Mesh>,
    Vec<Option<Material>>,
    Vec<super::Finding>,
    Vec<super::Finding>,
);

/// Reads a text cut into parts of about this many bytes, with at most so many triangles.
fn read_in(text: &str, size: usize, most: usize) -> Result<Content, Vec<super::Finding>> {
    content(text, || plain::parts(text.as_bytes(), size), most)
}

/// Reads a text statement by statement.
fn read_in_order(text: &str, most: usize) -> Result<Content, Vec<super::Finding>> {
    let parts = || {
        let mut parts = plain::parts(text.as_bytes(), usize::MAX / 2);
        for part in &mut parts {
            part.plain = None;
        }
        parts
    };
    content(text, parts, most)
}

fn content(
    text: &str,
    parts: impl Fn() -> Vec<plain::Chunk>,
    most: usize,
) -> Result<Content, Vec<super::Finding>> {
    let model = mesh::read_parts(text.as_bytes(), parts, most, no_library)?;
    Ok((
        model.mesh,
        model.materials,
        model.warnings,
        model.library_warnings,
    ))
}

proptest! {
    #![proptest_config(repeatable::config())]

    #[test]
    fn no_bytes_make_the_reader_panic(
        text in proptest::collection::vec(any::<u8>(), 0..300),
        library in proptest::collection::vec(any::<u8>(), 0..300),
    ) {
        let _ = read(&text, |_| Ok::<_, String>(&library));
    }

    #[test]
    fn parts_are_read_like_the_whole(
        mixed in prop_oneof![Just(""), Just("mtllib l\n"), Just("v 1 2\n"), Just("\n \n")],
        lines in prop::collection::vec("(v -?[0-9.]{1,4} 1 [0-9]|v \\+1e-1 \\.0{16}[1-9] 5\\.|v 1#x 2 3|\x0c v 1 2 3|v 1 2 3 4|vt [0-9]( 1)?|vn 0 0 1|usemtl [ab]|usemtl|g a|# f|# f \\\\|v 1 2 3 \\\\|v 1 2 x|v 1e308 0 0|vt x|vn 0 nan 0|v 1 2 3 // f|f 1 [1-3] 3( 4)?|f [1-5]/[1-3]/[1-2] 2/1/[1-4] 1//2|f -1 2 3|f 0 1 2|f 1234567890 1 2|f 1/ 2 3/|f 1 2 7//9|f 1/9 2 3|f 1 2 3 // f|f 2 5|f 1 2 3 5 4|fo 1 2 3|x| |)( #c| {0,2}\r{0,2})(\n|\n|\n|\r)", 0..40),
        size in 1usize..80,
        most in 3usize..60,
        ends in any::<bool>(),
    ) {
        let text = format!("{mixed}{CORNERS}{}", lines.concat());
        let text = if ends { &text[..] } else { text.trim_end_matches('\n') };
        prop_assert_eq!(read_in(text, size, most), read_in_order(text, most));
    }

    #[test]
    fn plain_parts_are_appended_in_order(
        lines in prop::collection::vec("f [1-5] [1-5] [1-5]( [1-5])?|f ([1-5]/[1-3] ){3}|f ([1-5]//[12] ){3}|f ([1-5]/[1-3]/[12] ){3}|v [0-9] 1 2|vt 1 [0-9]|vn 0 [0-9] 1|usemtl [ab]", 1..40),
        size in 1usize..120,
        room in 0usize..3,
    ) {
        let text = format!("{CORNERS}{}\n", lines.join("\n"));
        let triangles = read_in(&text, usize::MAX / 2, usize::MAX).map_or(0, |(mesh, ..)| mesh.len());
        let most = (triangles + room).saturating_sub(1);
        prop_assert_eq!(read_in(&text, size, most), read_in_order(&text, most));
    }

    #[test]
    fn no_words_make_the_reader_panic(
        text in "((v|vt|vn|f|usemtl|mtllib|g|newmtl|Kd|Ke|d|bump|Ns|map_Kd|-s|-clamp|illum|/|\\\\|#|-?[0-9]{1,4}|1/2/3|-1//-1|a)( |\n| {0,1}\n)){0,60}",
    ) {
        let _ = read(text.as_bytes(), |_| Ok::<_, String>(&text));
    }

    #[test]
    fn no_mutation_makes_the_reader_panic(
        changes in proptest::collection::vec((any::<prop::sample::Index>(), any::<u8>(), 0..3), 1..8),
    ) {
        let mut texts = [WHOLE.as_bytes().to_vec(), LIBRARY.as_bytes().to_vec()];
        for (place, byte, kind) in changes {
            let text = &mut texts[usize::from(byte % 3 == 0)];
            if text.is_empty() {
                continue;
            }
            let at = place.index(text.len());
            match kind {
                0 => text[at] = byte,
                1 => text.insert(at, byte),
                _ => {
                    text.remove(at);
                }
            }
        }
        let _ = read(&texts[0], |_| Ok::<_, String>(&texts[1]));
    }
}

#[test]
fn the_text_that_is_mutated_is_valid() {
    let model = read(WHOLE.as_bytes(), |_| Ok::<_, String>(LIBRARY)).expect("a valid mesh");
    assert_eq!((model.mesh.len(), model.warnings.len()), (3, 0));
    assert_eq!(model.materials.iter().flatten().count(), 2);
}
