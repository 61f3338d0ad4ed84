use std::fs;
use std::os::unix::fs::symlink;

use tempfile::TempDir;

use super::*;
use crate::obj::Model;
use crate::text::{Diagnostic, Findings, Span};

/// A folder `scenes` with a scene `x.dat`, in a folder of its own.
struct Place {
    directory: TempDir,
}

impl Place {
    fn new() -> Self {
        let directory = tempfile::tempdir().expect("a directory");
        fs::create_dir(directory.path().join("scenes")).expect("a folder");
        Self { directory }
    }

    /// A path below the scene's folder.
    fn at(&self, name: &str) -> PathBuf {
        self.directory.path().join("scenes").join(name)
    }

    fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        fs::write(self.at(name), content).expect("written");
    }

    fn wanted(&self, names: &[&str]) -> Wanted {
        Wanted {
            scene: self.at("x.dat"),
            pictures: names.iter().map(|name| (*name).to_owned()).collect(),
            meshes: BTreeSet::new(),
        }
    }

    /// What a first reading of one name says is wrong.
    fn refusal(&self, name: &str, folders: &[PathBuf]) -> Option<String> {
        let loaded = Assets::new(folders).read(&self.wanted(&[name]));
        assert_eq!(
            loaded.images.get(name).is_some(),
            loaded.troubles.is_empty()
        );
        loaded.troubles.get(name).map(told)
    }
}

fn told(trouble: &Trouble) -> String {
    let file = NamedFile {
        path: String::new(),
        kind: FileKind::Picture,
        span: Span::at(0),
        what: "texture 1 file".to_owned(),
    };
    let Diagnostic { message, hint, .. } = trouble.at(&file);
    format!("{message} ({})", hint.unwrap_or_default())
}

/// One pixel in a PPM.
fn ppm(pixel: [u8; 3]) -> Vec<u8> {
    [&b"P6\n1 1\n255\n"[..], &pixel].concat()
}

fn pixel(loaded: &Loaded, name: &str) -> Option<[u8; 3]> {
    Some(loaded.images.get(name)?.pixels()[0])
}

const RED: [u8; 3] = [255, 0, 0];
const BLUE: [u8; 3] = [0, 0, 255];

#[test]
fn files_near_the_scene_are_read() {
    let place = Place::new();
    fs::create_dir_all(place.at("pics")).expect("a folder");
    fs::create_dir_all(place.at("../textures")).expect("a folder");
    symlink("pics/b.ppm", place.at("link")).expect("a link");
    for name in ["a.ppm", "pics/b.ppm", "../textures/c.ppm"] {
        place.write(name, ppm(RED));
    }
    for name in ["a.ppm", "./pics/../a.ppm", "../textures/c.ppm", "link"] {
        assert_eq!(place.refusal(name, &[]), None, "{name}");
    }
}

#[test]
fn other_places_are_refused_unless_their_folder_is_named() {
    let place = Place::new();
    let elsewhere = tempfile::tempdir().expect("a directory");
    let outside = elsewhere.path().join("a.ppm");
    fs::write(&outside, ppm(RED)).expect("written");
    symlink(&outside, place.at("link")).expect("a link");
    place.write("b.ppm", ppm(RED));
    let absolute = outside.to_str().expect("a plain path");
    let own = place.at("b.ppm");
    let climbing = format!("../../../../../../../../../..{absolute}");
    for (name, reason) in [
        (
            absolute,
            "an absolute path is not read; magenta stands for it (--assets ",
        ),
        ("/dev/zero", "an absolute path"),
        ("/none/at/all", "an absolute path"),
        (own.to_str().expect("a plain path"), "an absolute path"),
        ("link", "is outside of the folder above the scene's"),
        (climbing.as_str(), "is outside of the folder above"),
    ] {
        let told = place.refusal(name, &[]).expect(name);
        assert!(told.starts_with("texture 1 file: "), "{told}");
        assert!(told.contains(reason), "{told}");
    }
    let folders = [PathBuf::from("/nowhere"), elsewhere.path().to_owned()];
    for name in [absolute, "link", climbing.as_str()] {
        assert_eq!(place.refusal(name, &folders), None, "{name}");
    }
    assert!(place.refusal("/dev/zero", &folders).is_some());
}

/// A name may lead elsewhere by a link: the folder to name is the file's, not the link's.
#[test]
fn the_folder_that_helps_is_told() {
    let place = Place::new();
    let elsewhere = tempfile::tempdir().expect("a directory");
    let folder = fs::canonicalize(elsewhere.path()).expect("a place");
    fs::write(folder.join("a.ppm"), ppm(RED)).expect("written");
    symlink(folder.join("a.ppm"), place.at("link")).expect("a link");
    let absolute = place.at("link");
    for name in ["link", absolute.to_str().expect("a plain path")] {
        let told = place.refusal(name, &[]).expect(name);
        let hint = format!("(--assets {} lets it be read)", folder.display());
        assert!(told.ends_with(&hint), "{told}");
    }
}

#[test]
fn what_is_no_picture_is_told_as_what_it_is() {
    let place = Place::new();
    fs::create_dir(place.at("folder.png")).expect("a folder");
    let made = std::process::Command::new("mkfifo")
        .arg(place.at("pipe.png"))
        .status();
    assert!(made.is_ok_and(|status| status.success()), "a pipe");
    symlink("loop.png", place.at("loop.png")).expect("a link");
    place.write("empty.png", "");
    place.write("text.png", "a text");
    place.write("half.ppm", b"P6\n2 2\n255\nabc");
    place.write("huge.ppm", b"P6\n8193 8192\n255\n");
    let long = fs::File::create(place.at("long.ppm")).expect("made");
    long.set_len(LIMITS.bytes + 1).expect("a hole");
    for (name, reason) in [
        (
            "none.png",
            "no such file; magenta stands for it (it is looked for as ",
        ),
        ("a.ppm/none.png", "no such file"),
        ("folder.png", "is a folder, not a file"),
        ("pipe.png", "is a pipe, not a file"),
        ("loop.png", "symbolic links"),
        ("empty.png", "is no picture of a known format"),
        ("text.png", "is no picture of a known format"),
        ("half.ppm", "is no whole picture: "),
        (
            "huge.ppm",
            "is 8193x8192: a texture has at most 67108864 pixels",
        ),
        ("long.ppm", "more than 512 MiB"),
    ] {
        let told = place.refusal(name, &[]).expect(name);
        assert!(told.contains(reason), "{told}");
    }
}

#[test]
fn bytes_that_are_known_are_not_decoded_again() {
    let place = Place::new();
    place.write("a.ppm", ppm(RED));
    place.write("b.ppm", ppm(RED));
    let wanted = place.wanted(&["a.ppm", "b.ppm"]);
    let mut assets = Assets::new(&[]);
    let first = assets.read(&wanted).images;
    let image = |images: &Images, name| Arc::clone(images.get(name).expect("read"));
    assert!(Arc::ptr_eq(
        &image(&first, "a.ppm"),
        &image(&first, "b.ppm")
    ));
    place.write("b.ppm", ppm(BLUE));
    let second = assets.read(&wanted).images;
    assert!(Arc::ptr_eq(
        &image(&first, "a.ppm"),
        &image(&second, "a.ppm")
    ));
    assert_eq!(image(&second, "b.ppm").pixels(), [BLUE]);
}

#[test]
fn a_file_that_is_being_written_keeps_its_last_picture() {
    let place = Place::new();
    place.write("a.ppm", ppm(RED));
    let wanted = place.wanted(&["a.ppm"]);
    let mut assets = Assets::new(&[]);
    assert_eq!(pixel(&assets.read(&wanted), "a.ppm"), Some(RED));
    for content in [&b""[..], b"P6\n", b"P6\n1 1\n255\n\x01"] {
        place.write("a.ppm", content);
        let loaded = assets.read(&wanted);
        assert_eq!(pixel(&loaded, "a.ppm"), Some(RED));
        let told = told(&loaded.troubles["a.ppm"]);
        assert!(told.contains("; its last picture is kept"), "{told}");
    }
    fs::remove_file(place.at("a.ppm")).expect("it is there");
    assert_eq!(pixel(&assets.read(&wanted), "a.ppm"), Some(RED));
    place.write("a.ppm", ppm(BLUE));
    let loaded = assets.read(&wanted);
    assert_eq!(pixel(&loaded, "a.ppm"), Some(BLUE));
    assert!(loaded.troubles.is_empty());
    // What it is now is no picture that is being written.
    fs::remove_file(place.at("a.ppm")).expect("it is there");
    fs::create_dir(place.at("a.ppm")).expect("a folder");
    assert_eq!(pixel(&assets.read(&wanted), "a.ppm"), None);
}

#[test]
fn pictures_that_are_too_much_together_are_left_out() {
    let place = Place::new();
    for (name, pixel) in [("a", RED), ("b", BLUE), ("c", [1; 3]), ("d", RED)] {
        place.write(name, ppm(pixel));
    }
    let wanted = place.wanted(&["a", "b", "c", "d"]);
    let refused = |limits: Room| {
        let mut assets = Assets::new(&[]);
        assets.limits = limits;
        let loaded = assets.read(&wanted);
        let told = |(name, trouble)| format!("{name}: {}", told(trouble));
        loaded.troubles.iter().map(told).collect::<Vec<_>>()
    };
    // The fourth is the first's twin.
    let found = refused(Room {
        pixels: 2,
        ..LIMITS
    });
    assert_eq!(
        found,
        [
            "c: texture 1 file: the scene's textures have too many pixels together; magenta stands for it ()"
        ]
    );
    let bytes = 3 * ppm(RED).len() as u64;
    let found = refused(Room { bytes, ..LIMITS });
    assert_eq!(
        found,
        [
            "d: texture 1 file: the scene's files have more than 512 MiB together; magenta stands for it ()"
        ]
    );
    assert!(refused(LIMITS).is_empty());
}

#[test]
fn places_to_watch_are_those_that_may_be_read() {
    let place = Place::new();
    place.write("a.ppm", ppm(RED));
    symlink("/dev/null", place.at("link.ppm")).expect("a link");
    let wanted = place.wanted(&[
        "a.ppm",
        "link.ppm",
        "none.ppm",
        "/dev/zero",
        "../../../../../../dev/null",
    ]);
    let places = Assets::new(&[]).places(&wanted);
    let own = ["a.ppm", "link.ppm", "none.ppm"].map(|name| place.at(name));
    assert_eq!(places, own);
}

#[test]
fn warnings_stand_at_every_place_that_names_a_file() {
    let place = Place::new();
    let loaded = Assets::new(&[]).read(&place.wanted(&["none"]));
    let file = |start, path: &str| NamedFile {
        path: path.to_owned(),
        kind: FileKind::Picture,
        span: Span::at(start),
        what: "texture 1 file".to_owned(),
    };
    let files = [file(9, "none"), file(5, "other"), file(3, "none")];
    let found = report(&loaded.troubles, &files, Findings::default());
    assert_eq!(found.warnings(), 2);
    let starts: Vec<_> = found.iter().map(|found| found.span.start()).collect();
    assert_eq!(starts, [3, 9]);
}

/// A triangle with a library beside it.
const TRIANGLE: &str = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n";

impl Place {
    fn wanted_meshes(&self, names: &[&str]) -> Wanted {
        Wanted {
            meshes: names.iter().map(|name| (*name).to_owned()).collect(),
            ..self.wanted(&[])
        }
    }
}

fn model(loaded: &Loaded, name: &str) -> Arc<Model> {
    match loaded.meshes.get(name) {
        Some(Ok(model)) => Arc::clone(model),
        other => panic!("{name}: {other:?}"),
    }
}

fn doubts(loaded: &Loaded, name: &str) -> Vec<String> {
    let model = model(loaded, name);
    let doubts = model.warnings.iter().chain(&model.library_warnings);
    doubts.map(ToString::to_string).collect()
}

#[test]
fn meshes_are_read_with_their_libraries() {
    let place = Place::new();
    fs::create_dir_all(place.at("meshes/skins")).expect("a folder");
    let mesh = TRIANGLE.replace("a.mtl", "skins/a.mtl");
    place.write("meshes/a.obj", mesh);
    place.write("meshes/skins/a.mtl", "newmtl a\nKd 0 1 0\n");
    let name = "meshes/a.obj";
    let wanted = place.wanted_meshes(&[name]);
    let mut assets = Assets::new(&[]);
    assert_eq!(assets.places(&wanted), [place.at(name)]);
    let loaded = assets.read(&wanted);
    assert_eq!(doubts(&loaded, name), [""; 0]);
    let model = model(&loaded, name);
    let colours: Vec<_> = model
        .materials
        .iter()
        .flatten()
        .map(|m| m.diffuse)
        .collect();
    assert_eq!(colours, [[0.0, 1.0, 0.0]]);
    // Now it is known what else is to be watched.
    let library = place.at("meshes/skins/a.mtl");
    assert_eq!(assets.places(&wanted), [place.at(name), library]);
}

#[test]
fn a_mesh_that_cannot_be_read_is_told_with_its_reason() {
    let place = Place::new();
    let elsewhere = tempfile::tempdir().expect("a directory");
    let folder = fs::canonicalize(elsewhere.path()).expect("a place");
    let outside = folder.join("a.obj");
    fs::write(&outside, TRIANGLE).expect("written");
    symlink(&outside, place.at("link.obj")).expect("a link");
    fs::create_dir(place.at("folder.obj")).expect("a folder");
    place.write("bad.obj", "v 0 0 0\nv 1 0 x\nv 0 1 0\nf 1 2\nf 1 2 3\n");
    place.write("empty.obj", "");
    let long = fs::File::create(place.at("long.obj")).expect("made");
    long.set_len(LIMITS.bytes + 1).expect("a hole");
    let looked_for = format!("it is looked for as {}", place.at("none.obj").display());
    let leave = format!("--assets {} lets it be read", folder.display());
    let absolute = outside.to_str().expect("a plain path");
    let refused = |name: &str| match Assets::new(&[])
        .read(&place.wanted_meshes(&[name]))
        .meshes
        .get(name)
    {
        Some(Err(fault)) => (fault.reasons.clone(), fault.hint.clone()),
        other => panic!("{name}: {other:?}"),
    };
    for (name, reasons, hint) in [
        ("none.obj", &["no such file"][..], Some(looked_for)),
        ("folder.obj", &["is a folder, not a file"], None),
        (
            absolute,
            &["an absolute path is not read"],
            Some(leave.clone()),
        ),
        (
            "link.obj",
            &["is outside of the folder above the scene's"],
            Some(leave),
        ),
        (
            "bad.obj",
            &[
                "line 2, column 7: v: `x` is no number",
                "line 4, column 6: f: expected three corners or more, found 2 corners",
            ],
            None,
        ),
        (
            "empty.obj",
            &["line 1, column 1: the file has no faces"],
            None,
        ),
        (
            "long.obj",
            &["the scene's files have more than 512 MiB together"],
            None,
        ),
    ] {
        let reasons: Vec<_> = reasons.iter().map(|&reason| reason.to_owned()).collect();
        assert_eq!(refused(name), (reasons, hint), "{name}");
    }
    let loaded = Assets::new(&[folder]).read(&place.wanted_meshes(&[absolute]));
    assert_eq!(model(&loaded, absolute).mesh.len(), 1);
}

#[test]
fn a_library_that_cannot_be_read_is_a_doubt() {
    let place = Place::new();
    let elsewhere = tempfile::tempdir().expect("a directory");
    let folder = fs::canonicalize(elsewhere.path()).expect("a place");
    fs::write(folder.join("a.mtl"), "newmtl a\n").expect("written");
    let absolute = folder.join("a.mtl").display().to_string();
    place.write("bad.mtl", "newmtl a\nKd x\n");
    for (library, doubt) in [
        (
            "none.mtl",
            "line 1, column 8: `none.mtl` can't be read: no such file".to_owned(),
        ),
        (
            absolute.as_str(),
            format!(
                "line 1, column 8: `{absolute}` can't be read: an absolute path is not read \
                 (--assets {} lets it be read)",
                folder.display()
            ),
        ),
        (
            "bad.mtl",
            "bad.mtl: line 2, column 4: Kd: `x` is no number".to_owned(),
        ),
    ] {
        place.write("a.obj", TRIANGLE.replace("a.mtl", library));
        let loaded = Assets::new(&[]).read(&place.wanted_meshes(&["a.obj"]));
        assert_eq!(doubts(&loaded, "a.obj"), [doubt]);
        assert_eq!(model(&loaded, "a.obj").materials, [None, None]);
    }
}

#[test]
fn meshes_that_are_known_are_not_read_anew() {
    let place = Place::new();
    place.write("a.obj", TRIANGLE);
    place.write("b.obj", TRIANGLE);
    place.write("a.mtl", "newmtl a\nKd 0 1 0\n");
    let wanted = place.wanted_meshes(&["a.obj", "b.obj"]);
    let mut assets = Assets::new(&[]);
    let first = assets.read(&wanted);
    assert!(Arc::ptr_eq(
        &model(&first, "a.obj"),
        &model(&first, "b.obj")
    ));
    let again = assets.read(&wanted);
    assert_eq!(first.meshes, again.meshes);

    // Other materials, the same triangles.
    place.write("a.mtl", "newmtl a\nKd 0 0 1\n");
    let second = assets.read(&wanted);
    assert_ne!(first.meshes, second.meshes);
    let (old, new) = (model(&first, "a.obj"), model(&second, "a.obj"));
    assert!(Arc::ptr_eq(&old.mesh, &new.mesh));
    let blue = new.materials[1].as_ref().map(|material| material.diffuse);
    assert_eq!(blue, Some([0.0, 0.0, 1.0]));
    fs::remove_file(place.at("a.mtl")).expect("it is there");
    assert_eq!(doubts(&assets.read(&wanted), "a.obj").len(), 1);
    place.write("a.mtl", "newmtl a\nKd 0 0 1\n");
    assert_eq!(doubts(&assets.read(&wanted), "a.obj"), [""; 0]);

    place.write("a.obj", TRIANGLE.replace("1 2 3", "1 3 2"));
    let third = assets.read(&wanted);
    assert!(!Arc::ptr_eq(&model(&third, "a.obj").mesh, &new.mesh));
    assert!(Arc::ptr_eq(&model(&third, "b.obj").mesh, &new.mesh));
}

#[test]
fn meshes_that_are_too_much_together_are_refused() {
    let place = Place::new();
    for (name, scale) in [
        ("a.obj", "1"),
        ("b.obj", "2"),
        ("c.obj", "3"),
        ("d.obj", "1"),
    ] {
        place.write(name, TRIANGLE.replace("v 1", &format!("v {scale}")));
    }
    place.write("a.mtl", "newmtl a\n");
    let mut assets = Assets::new(&[]);
    assets.limits.triangles = 2;
    let loaded = assets.read(&place.wanted_meshes(&["a.obj", "b.obj", "c.obj", "d.obj"]));
    // The fourth is the first's twin.
    assert_eq!(loaded.meshes.unreadable(), 1);
    assert!(matches!(loaded.meshes.get("c.obj"), Some(Err(_))));
}
