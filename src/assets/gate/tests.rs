use std::fs::Permissions;
use std::os::unix::fs::{PermissionsExt, symlink};

use tempfile::TempDir;

use super::*;

/// `own/scenes/x.dat` with files around it, a folder that may be named, and one that never is. Each
/// file contains its own name.
struct Layout {
    directory: TempDir,
}

const FILES: [&str; 8] = [
    "own/scenes/a.png",
    "own/scenes/sub/b.png",
    "own/textures/c.png",
    "named/d.png",
    "named/c.png",
    "named/deep/e.png",
    "other/secret.png",
    "other/a.png",
];

impl Layout {
    fn new() -> Self {
        let layout = Self {
            directory: tempfile::tempdir().expect("a directory"),
        };
        for file in FILES {
            let path = layout.at(file);
            fs::create_dir_all(directory_of(&path)).expect("a folder");
            fs::write(path, file).expect("written");
        }
        let link = |target: &str, name: &str| {
            symlink(target, layout.at(name)).expect("a link");
        };
        let absolute = |name: &str| layout.at(name).display().to_string();
        link("../textures/c.png", "own/scenes/in.png");
        link(
            &absolute("own/textures/c.png"),
            "own/scenes/absolute-in.png",
        );
        link("../textures", "own/scenes/in");
        link(&absolute("named/d.png"), "own/scenes/named.png");
        link("../../other/secret.png", "own/scenes/out.png");
        link("../../other", "own/scenes/out");
        link("/dev/zero", "own/scenes/zero.png");
        link("loop.png", "own/scenes/loop.png");
        layout
    }

    fn at(&self, name: &str) -> PathBuf {
        fs::canonicalize(self.directory.path())
            .expect("a place")
            .join(name)
    }

    fn gate(&self, folders: &[&str], home: Option<&str>) -> Gate {
        let folders: Vec<_> = folders.iter().map(|folder| self.at(folder)).collect();
        let home = home.map(|home| self.at(home));
        Gate::new(&self.at("own/scenes/x.dat"), &folders, home.as_deref())
    }

    /// The content or the error for a name, with the layout's folder as `.`.
    fn read(&self, gate: &Gate, name: &str) -> Result<String, String> {
        let own = self.at("").display().to_string();
        let read = gate.read(&name.replace("HERE", own.trim_end_matches('/')), &mut 1000);
        match read {
            Ok(content) => {
                let text = String::from_utf8(content.bytes).expect("a text");
                let place = content.elsewhere.map(|place| place.display().to_string());
                let place = place.map_or_else(String::new, |place| format!(" as {place}"));
                Ok(format!("{text}{}", place.replace(&own, "./")))
            }
            Err(failure) => Err(failure.to_string().replace(&own, "./")),
        }
    }
}

#[test]
fn only_permitted_files_are_read() {
    const ABSOLUTE: Result<&str, &str> = Err("absolute paths are not allowed");
    const OUTSIDE: Result<&str, &str> = Err("is outside ./own");
    const MISSING: Result<&str, &str> = Err("no such file");
    const BESIDE: Result<&str, &str> = Err("is outside ./own and ./named");
    let layout = Layout::new();
    let gates = [layout.gate(&[], None), layout.gate(&["named"], None)];
    let same = |expected| [expected, expected];
    for (name, expected) in [
        ("a.png", same(Ok("own/scenes/a.png"))),
        ("./sub/../a.png", same(Ok("own/scenes/a.png"))),
        ("sub\\b.png", same(Ok("own/scenes/sub/b.png"))),
        ("../textures/c.png", same(Ok("own/textures/c.png"))),
        ("..\\textures\\c.png", same(Ok("own/textures/c.png"))),
        ("in.png", same(Ok("own/textures/c.png"))),
        ("absolute-in.png", same(Ok("own/textures/c.png"))),
        ("in/c.png", same(Ok("own/textures/c.png"))),
        ("sub", same(Err("is a folder, not a file"))),
        ("..", same(Err("is a folder, not a file"))),
        ("out.png", [OUTSIDE, BESIDE]),
        ("out/secret.png", [OUTSIDE, BESIDE]),
        ("../../other/secret.png", [OUTSIDE, BESIDE]),
        ("../../../../../../../../../../dev/zero", [OUTSIDE, BESIDE]),
        ("zero.png", [OUTSIDE, BESIDE]),
        ("/dev/zero", same(ABSOLUTE)),
        ("HERE/own/scenes/a.png", same(ABSOLUTE)),
        ("HERE/other/secret.png", same(ABSOLUTE)),
        ("\\dev\\zero", same(ABSOLUTE)),
        ("none.png", same(MISSING)),
        ("a.png/none.png", same(MISSING)),
        ("", same(Err("is a folder, not a file"))),
        // Links and names that lead into a named folder.
        ("named.png", [OUTSIDE, Ok("named/d.png")]),
        ("../../named/d.png", [OUTSIDE, Ok("named/d.png")]),
        // Files found by a further path: by the whole name, or its last component.
        ("d.png", [MISSING, Ok("named/d.png as ./named/d.png")]),
        (
            "deep\\e.png",
            [MISSING, Ok("named/deep/e.png as ./named/deep/e.png")],
        ),
        ("gone/d.png", [MISSING, Ok("named/d.png as ./named/d.png")]),
        (
            "C:\\art\\d.png",
            [MISSING, Ok("named/d.png as ./named/d.png")],
        ),
        (
            "/home/x/d.png",
            [ABSOLUTE, Ok("named/d.png as ./named/d.png")],
        ),
        ("HERE/named/deep/e.png", same(ABSOLUTE)),
        (
            "out/../c.png",
            [MISSING, Ok("named/c.png as ./named/c.png")],
        ),
        (
            "../../other/c.png",
            [MISSING, Ok("named/c.png as ./named/c.png")],
        ),
        ("../other/secret.png", same(MISSING)),
    ] {
        for (gate, expected) in gates.iter().zip(expected) {
            let read = layout.read(gate, name);
            let read = read.as_ref().map(String::as_str);
            assert_eq!(read.map_err(String::as_str), expected, "{name}");
        }
    }
    let message = layout
        .read(&gates[0], "loop.png")
        .expect_err("it has no end");
    assert!(message.contains("symbolic links"), "{message}");
}

#[test]
fn the_root_and_homes_hold_more_than_scenes() {
    for (folder, home, expected) in [
        ("/", None, false),
        ("/home/u", Some("/home/u"), false),
        ("/home/u", Some("/home/v"), true),
        ("/home/u/scenes", Some("/home/u"), true),
        ("/x", None, true),
    ] {
        let holds = holds_scenes(Path::new(folder), home.map(Path::new));
        assert_eq!(holds, expected, "{folder}");
    }
}

#[test]
fn a_home_or_a_public_folder_above_a_scene_is_not_read() {
    let layout = Layout::new();
    let refused = |home| {
        layout
            .read(&layout.gate(&[], home), "../textures/c.png")
            .err()
    };
    let reason = Some("is outside ./own/scenes".to_owned());
    assert_eq!(refused(None), None);
    assert_eq!(refused(Some("own")), reason);
    assert_eq!(refused(Some("own/scenes")), None);
    for (mode, expected) in [
        (0o777, &reason),
        (0o1777, &reason),
        (0o702, &reason),
        (0o775, &None),
        (0o700, &None),
    ] {
        let own = layout.at("own");
        fs::set_permissions(own, Permissions::from_mode(mode)).expect("its owner");
        assert_eq!(refused(None), *expected, "{mode:o}");
    }
    // A scene's own folder is always read.
    let scenes = layout.at("own/scenes");
    fs::set_permissions(scenes, Permissions::from_mode(0o777)).expect("its owner");
    let gate = layout.gate(&[], Some("own/scenes"));
    assert!(layout.read(&gate, "a.png").is_ok());
}

/// Tests run in the folder of the manifest, the parent of the one named here.
#[test]
fn the_current_folder_is_searched_if_it_may_be_read() {
    let here = env::current_dir().expect("a current folder");
    let near = Gate::new(&here.join("gate/x.dat"), &[], None);
    let content = near.read("lib.rs", &mut (1 << 20)).expect("it is there");
    assert_eq!(content.elsewhere, Some(PathBuf::from("lib.rs")));
    let layout = Layout::new();
    let far = layout.gate(&[], None);
    assert!(far.read("lib.rs", &mut (1 << 20)).is_err());
}

/// A folder is exchanged with a link again and again.
#[test]
#[cfg(target_os = "linux")]
fn swapping_a_folder_for_a_link_gives_no_access() {
    use rustix::fs::{CWD, RenameFlags, renameat_with};
    use std::sync::atomic::{AtomicBool, Ordering};

    let layout = Layout::new();
    let (folder, link) = (layout.at("own/scenes/sub"), layout.at("own/scenes/link"));
    symlink("../../other", &link).expect("a link");
    fs::write(folder.join("a.png"), "inside").expect("written");
    let gate = layout.gate(&[], None);
    let is_over = AtomicBool::new(false);
    let mut inside = 0;
    std::thread::scope(|scope| {
        scope.spawn(|| {
            while !is_over.load(Ordering::Relaxed) {
                renameat_with(CWD, &folder, CWD, &link, RenameFlags::EXCHANGE).expect("swapped");
            }
        });
        for _ in 0..10_000 {
            if let Ok(content) = gate.read("sub/a.png", &mut 1000) {
                is_over.fetch_or(content.bytes != b"inside", Ordering::Relaxed);
                assert_eq!(content.bytes, b"inside");
                inside += 1;
            }
        }
        is_over.store(true, Ordering::Relaxed);
    });
    assert!(0 < inside);
}
