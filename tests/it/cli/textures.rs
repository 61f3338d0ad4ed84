//! Picture files that scenes reference.

use super::*;

/// The colour of the middle pixel of a PPM of 40×30 pixels.
fn middle(ppm: &[u8]) -> &[u8] {
    let pixels = &ppm[b"P6\n40 30\n255\n".len()..];
    &pixels[3 * (15 * 40 + 20)..][..3]
}

#[test]
fn textures_are_read_from_the_folder_of_the_scene() {
    let place = Place::new();
    place.write("a.dat", TEXTURED);
    place.write("skin.ppm", SKIN);
    assert_eq!(place.stderr("render a.dat -o a.ppm --spp 1", 0), "");
    assert_eq!(middle(&place.read("a.ppm")), [91, 120, 150]);
    assert_eq!(
        place.stderr("check a.dat", 0),
        "1 scene checked: 0 errors, 0 warnings\n"
    );
}

#[test]
fn an_unreadable_texture_gives_a_warning_and_is_magenta() {
    let place = Place::new();
    place.write("a.dat", TEXTURED);
    let stderr = place.stderr("render a.dat -o a.ppm --spp 1", 0);
    let first = "warning: a.dat:6:24: texture 3 file: no such file; shown in magenta\n";
    assert!(stderr.starts_with(first), "{stderr}");
    for part in [
        "texture ID 3 image 1 1 skin.ppm",
        "a picture file: .bmp,",
        "skin.ppm",
    ] {
        assert!(stderr.contains(part), "{stderr}");
    }
    assert_eq!(middle(&place.read("a.ppm")), [255, 0, 255]);
    let stderr = place.stderr("check a.dat", 0);
    assert!(
        stderr.ends_with("1 scene checked: 0 errors, 1 warning\n"),
        "{stderr}"
    );
}

#[test]
fn textures_from_elsewhere_need_permission() {
    let place = Place::new();
    let elsewhere = Place::new();
    elsewhere.write("skin.ppm", SKIN);
    let path = elsewhere.at("skin.ppm");
    place.write(
        "a.dat",
        TEXTURED.replace("skin.ppm", path.to_str().expect("a plain path")),
    );
    let stderr = place.stderr("render a.dat -o a.ppm --spp 1", 0);
    assert!(
        stderr.contains("absolute paths are not allowed"),
        "{stderr}"
    );
    assert_eq!(middle(&place.read("a.ppm")), [255, 0, 255]);
    let folder = elsewhere.directory.path().display();
    assert!(stderr.contains(&format!("--assets {folder}")), "{stderr}");
    for (named, wrong) in [("nowhere", "no such folder"), ("a.dat", "not a folder")] {
        for command in ["check a.dat", "render a.dat -o a.ppm --spp 1"] {
            let stderr = place.stderr(&format!("{command} --assets {named} --assets {folder}"), 66);
            assert_eq!(stderr, format!("error: --assets {named}: {wrong}\n"));
        }
    }
    let allowed = format!("render a.dat -o a.ppm --spp 1 --assets {folder}");
    let path = path.display();
    let note = format!("note: {path} is read from {path}\n");
    assert_eq!(place.stderr(&allowed, 0), note);
    assert_eq!(middle(&place.read("a.ppm")), [91, 120, 150]);
    let stderr = place.stderr(&format!("check a.dat --assets {folder}"), 0);
    assert!(stderr.contains("0 warnings"), "{stderr}");
}
