//! Meshes and material libraries that scenes name.

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
