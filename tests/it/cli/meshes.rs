//! Meshes and material libraries that scenes name.

use std::os::unix::fs::symlink;

use super::*;

/// A mesh that fills the picture, in a scene lit by ambient light.
const SCENE: &str = "<xml><scene>
  <object type='obj' name='meshes/square'/>
  <light type='ambient' name='a'><intensity value='1'/></light>
</scene>
<camera><position z='2'/><target/><width value='40'/><height value='30'/></camera></xml>
";

const SQUARE: &str = "mtllib a.mtl\rv -2 -2 0\rv 2 -2 0\rv 2 2 0\rv -2 2 0\rusemtl a\r";

/// Every command says what one line has wrong at its own place, and uses the rest.
#[test]
fn a_line_that_is_wrong_is_shown_at_its_place_and_costs_only_itself() {
    let place = Place::new();
    fs::create_dir(place.at("meshes")).expect("a folder");
    place.write("a.xml", SCENE);
    place.write("meshes/square.obj", format!("{SQUARE}f 1 2\rf 1 2 3 4\r"));
    place.write("meshes/a.mtl", "newmtl a\nKs x\nKd 1 0 0\n");
    let note = "note: meshes/square is read from ./meshes/square.obj\n";
    let face = "\
warning: meshes/square.obj:7:6: f: expected at least three corners, found 2
  |
7 | f 1 2
  |      ^ at least three corners
  |
  = help: the face is left out
";
    let library = "\
warning: meshes/a.mtl:2:4: Ks: `x` is not a number
  |
2 | Ks x
  |    ^ a number
  |
  = help: the line is ignored
";
    let said = format!("{note}{face}{library}");
    assert_eq!(place.stderr("render a.xml -o a.ppm --spp 1", 0), said);
    let pixels = &place.read("a.ppm")[b"P6\n40 30\n255\n".len()..];
    assert!(pixels.chunks(3).all(|pixel| pixel == [255, 0, 0]));
    let checked = "1 scene checked: 0 errors, 2 warnings\n";
    assert_eq!(place.stderr("check a.xml", 0), format!("{said}{checked}"));
    let strict = said.replace("warning: ", "error: ");
    let stderr = place.stderr("render a.xml -o b.ppm --strict", 65);
    assert!(stderr.starts_with(&strict), "{stderr}");
}

/// A tetrahedron in each format: its corners, and the corners of its faces.
const CORNERS: [[f32; 3]; 4] = [
    [0.0, 0.0, 0.0],
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
];
const FACES: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];

fn as_obj() -> Vec<u8> {
    let corners = CORNERS.map(|[x, y, z]| format!("v {x} {y} {z}\n"));
    let faces = FACES.map(|[a, b, c]| format!("f {} {} {}\n", a + 1, b + 1, c + 1));
    [corners.concat(), faces.concat()].concat().into_bytes()
}

/// A `.ply` of numbers in big endian, or of text.
fn as_ply(is_text: bool) -> Vec<u8> {
    let format = if is_text {
        "ascii"
    } else {
        "binary_big_endian"
    };
    let mut bytes = format!(
        "ply\nformat {format} 1.0\nelement vertex 4\nproperty float x\nproperty float y\n\
         property float z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n"
    )
    .into_bytes();
    if is_text {
        bytes.extend(
            CORNERS
                .map(|[x, y, z]| format!("{x} {y} {z}\n"))
                .concat()
                .bytes(),
        );
        bytes.extend(
            FACES
                .map(|[a, b, c]| format!("3 {a} {b} {c}\n"))
                .concat()
                .bytes(),
        );
        return bytes;
    }
    bytes.extend(
        CORNERS
            .as_flattened()
            .iter()
            .flat_map(|value| value.to_be_bytes()),
    );
    for face in FACES {
        bytes.push(3);
        bytes.extend(face.iter().flat_map(|corner| corner.to_be_bytes()));
    }
    bytes
}

/// An `.stl` of numbers.
fn as_stl() -> Vec<u8> {
    let mut bytes = b"solid".to_vec();
    bytes.resize(80, 0);
    bytes.extend((FACES.len() as u32).to_le_bytes());
    for face in FACES {
        let corners = face.map(|corner| CORNERS[corner as usize]);
        let values = [[0.0; 3]].into_iter().chain(corners).flatten();
        bytes.extend(values.flat_map(f32::to_le_bytes));
        bytes.extend([0; 2]);
    }
    bytes
}

/// The same tetrahedron gives the same picture, whatever its format.
#[test]
fn meshes_of_all_formats_are_rendered_in_a_new_scene() {
    let place = Place::new();
    place.write("a.obj", as_obj());
    place.write("b.ply", as_ply(false));
    place.write("c.PLY", as_ply(true));
    place.write("d.stl", as_stl());
    let mut pictures = Vec::new();
    for (mesh, scene) in [
        ("a.obj", "a.xml"),
        ("b.ply", "b.xml"),
        ("c.PLY", "c.xml"),
        ("d.stl", "d.xml"),
    ] {
        let note = format!(
            "note: {mesh} in a new scene, {scene}: 4 triangles, z up, on a ground with two lights\n"
        );
        let said = place.stderr(
            &format!("render {mesh} -o {mesh}.ppm --up z --size 32x24"),
            0,
        );
        assert_eq!(said, note);
        pictures.push(place.read(&format!("{mesh}.ppm")));
        let checked = format!("{note}1 scene checked: 0 errors, 0 warnings\n");
        assert_eq!(place.stderr(&format!("check --up z {mesh}"), 0), checked);
        assert!(!place.at(scene).exists());
    }
    assert!(pictures.windows(2).all(|pair| pair[0] == pair[1]));
    // The other axis, which is the custom of all but .stl.
    for (mesh, is_same) in [("a.obj", false), ("b.ply", false), ("d.stl", true)] {
        place.stderr(&format!("render {mesh} -o x.ppm --size 32x24"), 0);
        assert_eq!(place.read("x.ppm") == pictures[0], is_same, "{mesh}");
    }
}

/// The text of the new scene is that of an ordinary one.
#[test]
fn a_new_scene_is_written_beside_its_mesh() {
    let place = Place::new();
    place.write("b.ply", as_ply(false));
    place.stderr("convert b.ply -o b.xml", 0);
    place.stderr("render b.ply -o b.png --size 32x24", 0);
    let note = "note: b.ply: the course's own readers of .xml know only .obj meshes\n";
    assert_eq!(place.stderr("render b.xml -o c.png --size 32x24", 0), note);
    assert_eq!(place.read("b.png"), place.read("c.png"));
    // Its name is taken now.
    let said = place.stderr("check b.ply", 0);
    assert!(said.contains("in a new scene, b-2.xml: "), "{said}");
}

/// A mesh, what it holds, the exit code, and the first line of what is said of it.
#[test]
fn a_mesh_that_cannot_be_read_is_an_error_at_its_place() {
    let place = Place::new();
    let cut = &as_ply(false)[..254];
    let long = {
        let mut bytes = as_stl();
        bytes[0] = b'x';
        bytes[80..84].copy_from_slice(&u32::MAX.to_le_bytes());
        bytes
    };
    place.write("a.ply", cut);
    place.write("b.ply", "ply\nformat ascii 1.0\nelement vertex 100000000\n");
    place.write("c.stl", long);
    place.write("d.stl", "");
    place.write("e.obj", "v 0 0 0\n");
    symlink("/dev/zero", place.at("f.ply")).expect("a link");
    for (mesh, code, expected) in [
        (
            "a.ply",
            65,
            "error: a.ply:9:1: a.ply (obj): the file ends in face 3 of 4 (byte 254)",
        ),
        (
            "b.ply",
            65,
            "error: b.ply:3:25: b.ply (obj): the header has no end",
        ),
        (
            "c.stl",
            65,
            "error: c.stl:1:1: c.stl (obj): the file is cut short: it has 284 bytes and announces 4294967295 facets",
        ),
        (
            "d.stl",
            65,
            "error: d.stl:1:1: d.stl (obj): this is no .stl file",
        ),
        (
            "e.obj",
            65,
            "error: e.obj:1:8: e.obj (obj): the file has no faces that can be used",
        ),
        ("f.ply", 66, "error: f.ply: is a device, not a file"),
        ("none.ply", 66, "error: none.ply: no such file"),
    ] {
        let said = place.stderr(&format!("render {mesh} -o a.ppm"), code);
        let first = said.lines().next().unwrap_or_default();
        assert_eq!(first, expected, "{said}");
        assert!(!place.at("a.ppm").exists());
    }
}
