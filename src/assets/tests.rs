mod meshes;

use std::fs;
use std::os::unix::fs::symlink;

use tempfile::TempDir;

use super::*;
use text::{Diagnostic, Findings, Span};

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

    /// The parent of the scene's folder.
    fn root(&self) -> PathBuf {
        fs::canonicalize(self.directory.path()).expect("a place")
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

    /// The error of one name in a first reading, if any.
    fn refusal(&self, name: &str, folders: &[PathBuf]) -> Option<String> {
        let loaded = Assets::new(folders).read(&self.wanted(&[name]));
        assert_eq!(
            loaded.images.get(name).is_some(),
            loaded.picture_errors.is_empty()
        );
        loaded.picture_errors.get(name).map(message_of)
    }
}

/// The message with its hint in parentheses.
fn message_of(error: &PictureError) -> String {
    let file = NamedFile {
        path: String::new(),
        kind: FileKind::Picture,
        span: Span::at(0),
        what: "texture 1 file".to_owned(),
    };
    let Diagnostic { message, hint, .. } = error.at(&file);
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
    let outside_of = format!("is outside {}; shown", place.root().display());
    for (name, reason) in [
        (
            absolute,
            "absolute paths are not allowed; shown in magenta (allow it with --assets ",
        ),
        ("/dev/zero", "absolute paths"),
        ("/none/at/all", "absolute paths"),
        (own.to_str().expect("a plain path"), "absolute paths"),
        ("link", outside_of.as_str()),
        (climbing.as_str(), outside_of.as_str()),
    ] {
        let message = place.refusal(name, &[]).expect(name);
        assert!(message.starts_with("texture 1 file: "), "{message}");
        assert!(message.contains(reason), "{message}");
    }
    let folders = [PathBuf::from("/nowhere"), elsewhere.path().to_owned()];
    for name in [absolute, "link", climbing.as_str()] {
        assert_eq!(place.refusal(name, &folders), None, "{name}");
    }
    assert!(place.refusal("/dev/zero", &folders).is_some());
}

/// If a name leads elsewhere by a link, the folder to allow is the file's, not the link's.
#[test]
fn the_hint_names_the_folder_to_allow() {
    let place = Place::new();
    let elsewhere = tempfile::tempdir().expect("a directory");
    let folder = fs::canonicalize(elsewhere.path()).expect("a place");
    fs::write(folder.join("a.ppm"), ppm(RED)).expect("written");
    symlink(folder.join("a.ppm"), place.at("link")).expect("a link");
    let absolute = place.at("link");
    for name in ["link", absolute.to_str().expect("a plain path")] {
        let message = place.refusal(name, &[]).expect(name);
        let hint = format!("(allow it with --assets {})", folder.display());
        assert!(message.ends_with(&hint), "{message}");
    }
}

#[test]
fn the_reason_why_a_picture_cannot_be_read_is_precise() {
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
        ("none.png", "no such file; shown in magenta (looked for "),
        ("a.ppm/none.png", "no such file"),
        ("folder.png", "is a folder, not a file"),
        ("pipe.png", "is a pipe, not a file"),
        ("loop.png", "symbolic links"),
        ("empty.png", "is not in a supported picture format"),
        ("text.png", "is not in a supported picture format"),
        ("half.ppm", "is not a valid picture: "),
        (
            "huge.ppm",
            "is 8193x8192: an image has at most 67108864 pixels",
        ),
        ("long.ppm", "more than 512 MiB"),
    ] {
        let message = place.refusal(name, &[]).expect(name);
        assert!(message.contains(reason), "{message}");
    }
}

#[test]
fn known_bytes_are_not_decoded_again() {
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
fn a_partly_written_file_keeps_its_last_picture() {
    let place = Place::new();
    place.write("a.ppm", ppm(RED));
    let wanted = place.wanted(&["a.ppm"]);
    let mut assets = Assets::new(&[]);
    assert_eq!(pixel(&assets.read(&wanted), "a.ppm"), Some(RED));
    for content in [&b""[..], b"P6\n", b"P6\n1 1\n255\n\x01"] {
        place.write("a.ppm", content);
        let loaded = assets.read(&wanted);
        assert_eq!(pixel(&loaded, "a.ppm"), Some(RED));
        let message = message_of(&loaded.picture_errors["a.ppm"]);
        assert!(message.contains("; its last picture is kept"), "{message}");
    }
    fs::remove_file(place.at("a.ppm")).expect("it is there");
    assert_eq!(pixel(&assets.read(&wanted), "a.ppm"), Some(RED));
    place.write("a.ppm", ppm(BLUE));
    let loaded = assets.read(&wanted);
    assert_eq!(pixel(&loaded, "a.ppm"), Some(BLUE));
    assert!(loaded.picture_errors.is_empty());
}

#[test]
fn a_picture_replaced_by_something_unreadable_is_kept() {
    let place = Place::new();
    place.write("a.ppm", ppm(RED));
    let wanted = place.wanted(&["a.ppm"]);
    let mut assets = Assets::new(&[]);
    assert_eq!(pixel(&assets.read(&wanted), "a.ppm"), Some(RED));
    fs::remove_file(place.at("a.ppm")).expect("it is there");
    let mut keeps = |reason: &str| {
        let loaded = assets.read(&wanted);
        assert_eq!(pixel(&loaded, "a.ppm"), Some(RED), "{reason}");
        let message = message_of(&loaded.picture_errors["a.ppm"]);
        assert!(message.contains(reason), "{message}");
    };
    keeps("no such file; its last picture is kept");
    fs::create_dir(place.at("a.ppm")).expect("a folder");
    keeps("is a folder, not a file; its last picture is kept");
    fs::remove_dir(place.at("a.ppm")).expect("it is there");
    symlink("/dev/null", place.at("a.ppm")).expect("a link");
    keeps("; its last picture is kept (allow it with --assets /dev)");
    fs::remove_file(place.at("a.ppm")).expect("it is there");
    place.write("a.ppm", b"P6\n8193 8192\n255\n");
    keeps("is 8193x8192");
}

#[test]
fn pictures_beyond_the_limits_are_left_out() {
    let place = Place::new();
    for (name, pixel) in [("a", RED), ("b", BLUE), ("c", [1; 3]), ("d", RED)] {
        place.write(name, ppm(pixel));
    }
    let wanted = place.wanted(&["a", "b", "c", "d"]);
    let refused = |limits: Room| {
        let mut assets = Assets::new(&[]);
        assets.limits = limits;
        let loaded = assets.read(&wanted);
        let message = |(name, error)| format!("{name}: {}", message_of(error));
        loaded
            .picture_errors
            .iter()
            .map(message)
            .collect::<Vec<_>>()
    };
    // The fourth equals the first.
    let found = refused(Room {
        pixels: 2,
        ..LIMITS
    });
    assert_eq!(
        found,
        [
            "c: texture 1 file: the scene's textures have too many pixels in total; shown in magenta ()"
        ]
    );
    let bytes = 3 * ppm(RED).len() as u64;
    let found = refused(Room { bytes, ..LIMITS });
    assert_eq!(
        found,
        [
            "d: texture 1 file: the scene's files have more than 512 MiB in total; shown in magenta ()"
        ]
    );
    assert!(refused(LIMITS).is_empty());
}

#[test]
fn only_places_that_may_be_read_are_watched() {
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
fn a_missing_file_is_watched_for_wherever_it_is_looked_for() {
    let place = Place::new();
    let elsewhere = tempfile::tempdir().expect("a directory");
    let name = "m/deep/a.ppm";
    let folders = [elsewhere.path().to_owned()];
    let looked_for = [
        place.at(name),
        elsewhere.path().join(name),
        elsewhere.path().join("a.ppm"),
    ];
    let message = place.refusal(name, &folders).expect(name);
    let places = looked_for
        .each_ref()
        .map(|place| place.display().to_string());
    let expected = format!("(looked for {})", places.join(", "));
    assert!(message.ends_with(&expected), "{message}");
    let wanted = place.wanted(&[name]);
    let mut places = Assets::new(&folders).places(&wanted);
    places.sort();
    let mut expected = looked_for.to_vec();
    expected.sort();
    assert_eq!(places, expected);
    // Once found at the first path, only that is watched.
    place.write("a.ppm", ppm(RED));
    let wanted = place.wanted(&["a.ppm"]);
    assert_eq!(Assets::new(&folders).places(&wanted), [place.at("a.ppm")]);
}

#[test]
fn every_place_that_names_a_file_gets_a_warning() {
    let place = Place::new();
    let loaded = Assets::new(&[]).read(&place.wanted(&["none"]));
    let file = |start, path: &str| NamedFile {
        path: path.to_owned(),
        kind: FileKind::Picture,
        span: Span::at(start),
        what: "texture 1 file".to_owned(),
    };
    let files = [file(9, "none"), file(5, "other"), file(3, "none")];
    let (errors, none) = (&loaded.picture_errors, Findings::default());
    let found = report(errors, &files, &loaded.found, none);
    assert_eq!(found.warnings(), 2);
    let starts: Vec<_> = found.iter().map(|found| found.span.start()).collect();
    assert_eq!(starts, [3, 9]);
}
