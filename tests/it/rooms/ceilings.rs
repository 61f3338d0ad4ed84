//! Ceilings of what grows unnoticed: files of a folder, lines of a file and of a room, and files that
//! know a mode. A ceiling over the common one may only be lowered, one of a room or a mode raised with a
//! reason beside it.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use super::sources::Sources;
use super::{names_after, root};

/// The most files of a folder.
const FILES: usize = 25;

/// The folders with more, and how many they have.
const CROWDED: &[(&str, usize)] = &[
    ("src/language", 26),
    ("src/render/tests", 36),
    ("src/ui/view", 33),
];

/// The most lines of a file.
const LINES: usize = 500;

/// The files with more, and how many they have.
const LONG: &[(&str, usize)] = &[
    ("benches/interface.rs", 502),
    ("src/geometry/tests/quadrics.rs", 530),
    ("src/language/ray/tests/properties.rs", 507),
    ("src/language/tests/structure.rs", 563),
    ("src/render/tests/edits.rs", 502),
    ("src/render/tests/paths.rs", 503),
    ("src/render/tests/photons.rs", 506),
];

/// The lines of code of each room over a thousand, without comments and tests, rounded up to hundreds.
const ROOMS: &[(&str, usize)] = &[
    ("accel", 1900),
    // Also makes scenes around meshes.
    ("assets", 1100),
    // A class is compared with its reference, and reported in four forms.
    ("batch", 5600),
    // Every command that reads scenes also says how meshes stand in them.
    ("cli", 1700),
    // Undo steps are carried over what others change meanwhile.
    ("document", 2000),
    // The words and values of the interface's lines are here beside those of texts.
    ("explain", 2100),
    // It holds the state folder, which the interface and renders share.
    ("file", 1800),
    // Parts of intersection are functions of their own, which compile faster.
    ("geometry", 5800),
    ("image_file", 1200),
    // Four languages, three of which share an engine, and scenes around meshes. Findings carry the edits
    // that mend them, and a tag is understood before it is whole.
    ("language", 19100),
    // What may stand at a place is a question of its own in records, tags and folders.
    ("lsp", 2700),
    // Three formats, two of them as text and as numbers.
    ("obj", 3400),
    // Each of its rooms lists what others may use, and films give and take blocks. Longer names wrap more
    // lines.
    ("render", 16600),
    ("scene", 1300),
    // It also holds the traces of the interface.
    ("shards", 1300),
    // Base64 is here, and what keeps comments in their columns.
    ("text", 1100),
    ("track", 1700),
    // Each room lists what others may call, and each function the state it changes. Frames, base64 and
    // the nearest of few colours take a hundred lines, for ten dependencies. An editor's buffer in place of the
    // file takes eight hundred, and pictures that tmux moves two hundred.
    ("ui", 35500),
];

/// The most methods on the interface's state; everything else is a function in the room that does it.
const METHODS: usize = 90;

/// The rooms of modes whose names are others.
const OWN: &[(&str, &str)] = &[("Fly", "camera"), ("Move", "transform"), ("View", "camera")];

/// The files of the interface that name each mode, outside of its own room. What knows a mode has to be
/// read before it is changed.
const MODES: &[(&str, usize)] = &[
    ("Compare", 11),
    // The keys that start another mode list the modes in which they work.
    // What is located is also outlined while its fields are edited.
    ("Edit", 19),
    // SEQUENCE's own rows of keys list the modes that they act in.
    ("Fly", 7),
    ("Inspect", 11),
    ("Move", 13),
    // The key that locates the selected thing works here and in EDIT.
    ("Select", 27),
    // Leaving it means taking back its transient edit, so both are in one file.
    ("Sequence", 10),
    ("Trace", 9),
    ("View", 9),
];

/// All files with sources, from the top.
fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("source folders are readable");
    let paths = entries.map(|entry| entry.expect("source folders are readable").path());
    let mut found = Vec::new();
    for path in paths {
        if path.is_dir() {
            found.extend(files(&path));
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
    found
}

/// All files of the package, by their paths in it.
fn all_files() -> impl Iterator<Item = (String, PathBuf)> {
    let folders = ["src", "tests", "benches"].map(|folder| root().join(folder));
    folders.into_iter().flat_map(|folder| {
        files(&folder).into_iter().map(|file| {
            let inside = file.strip_prefix(root()).expect("it is in the package");
            (inside.to_string_lossy().into_owned(), file)
        })
    })
}

/// Compares what is over a common ceiling with the list of what is.
#[track_caller]
fn check(what: &str, most: usize, found: &BTreeMap<String, usize>, listed: &[(&str, usize)]) {
    let over = found.iter().filter(|(_, count)| most < **count);
    let over: Vec<_> = over.map(|(name, &count)| (name.as_str(), count)).collect();
    assert_eq!(over, listed, "{what}: over {most}, found and listed");
}

#[test]
fn no_folder_is_crowded() {
    let mut folders = BTreeMap::new();
    for (name, _) in all_files() {
        let folder = Path::new(&name).parent().expect("it is in a folder");
        *folders
            .entry(folder.to_string_lossy().into_owned())
            .or_default() += 1;
    }
    check("files of a folder", FILES, &folders, CROWDED);
}

#[test]
fn no_file_is_long() {
    let lines = |file: &Path| {
        let text = fs::read_to_string(file).expect("sources are readable");
        text.lines().count()
    };
    let files = all_files().map(|(name, file)| (name, lines(&file)));
    check("lines of a file", LINES, &files.collect(), LONG);
}

#[test]
fn no_room_grows_unseen() {
    let mut rooms: BTreeMap<String, usize> = BTreeMap::new();
    for (name, module) in Sources::of("src").iter() {
        if let Some(room) = name.first() {
            let lines = module.code.lines().filter(|line| !line.trim().is_empty());
            *rooms.entry(room.clone()).or_default() += lines.count();
        }
    }
    for lines in rooms.values_mut() {
        *lines = lines.div_ceil(100) * 100;
    }
    check("lines of a room", 1000, &rooms, ROOMS);
}

#[test]
fn modes_are_known_where_they_were() {
    let mut modes: BTreeMap<String, usize> = BTreeMap::new();
    for (name, module) in Sources::of("src").iter() {
        let mut named = names_after(&module.code, "Mode::");
        // `ui/app/ROOM/FILE`.
        let room = name.get(2).filter(|_| 3 < name.len());
        named.retain(|mode| room != Some(&own_room(mode)));
        named.sort();
        named.dedup();
        for mode in named
            .into_iter()
            .filter(|name| MODES.iter().any(|(mode, _)| mode == name))
        {
            *modes.entry(mode).or_default() += 1;
        }
    }
    check("files that name a mode", 0, &modes, MODES);
}

/// The room of a mode.
fn own_room(mode: &str) -> String {
    let own = OWN.iter().find(|(named, _)| *named == mode);
    own.map_or_else(|| mode.to_lowercase(), |(_, room)| (*room).to_owned())
}

#[test]
fn the_state_of_the_interface_has_few_methods() {
    let mut methods = 0;
    for (_, module) in Sources::of("src/ui").iter() {
        let mut is_inside = false;
        for line in module.code.lines() {
            is_inside = match line {
                "}" => false,
                _ => is_inside || ["impl App {", "impl Shared {"].contains(&line.trim()),
            };
            let is_method = line.trim_start().starts_with("fn ") || line.contains(" fn ");
            methods += usize::from(is_inside && is_method);
        }
    }
    assert!((50..=METHODS).contains(&methods), "{methods} methods");
}
