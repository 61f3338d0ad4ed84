//! The rooms of the house and the arrows between them, as `src/lib.rs` draws them: an import that
//! is not listed here is a design decision, to be made on purpose.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// Each room and the rooms it may name.
const ARROWS: &[(&str, &[&str])] = &[
    ("memory", &[]),
    ("text", &[]),
    ("geometry", &[]),
    ("obj", &["geometry", "text"]),
    ("scene", &["geometry", "obj"]),
    ("language", &["geometry", "memory", "obj", "scene", "text"]),
    ("document", &["language", "memory", "scene", "text"]),
    ("accel", &["geometry"]),
    ("render", &["accel", "geometry", "memory", "scene"]),
    ("file", &["memory", "text"]),
    ("image_file", &["file", "render", "scene"]),
    (
        "assets",
        &[
            "file",
            "image_file",
            "language",
            "memory",
            "obj",
            "scene",
            "text",
        ],
    ),
    ("watch", &["file"]),
    (
        "batch",
        &[
            "assets",
            "file",
            "image_file",
            "language",
            "memory",
            "render",
            "scene",
            "text",
        ],
    ),
    (
        "ui",
        &[
            "assets",
            "document",
            "file",
            "image_file",
            "language",
            "memory",
            "render",
            "scene",
            "text",
            "watch",
        ],
    ),
    (
        "cli",
        &[
            "batch",
            "file",
            "image_file",
            "render",
            "scene",
            "text",
            "ui",
        ],
    ),
];

/// Each dependency and the one room that may name it; `*` for the vocabulary of all.
const DEPENDENCIES: &[(&str, &str)] = &[
    ("annotate_snippets", "batch"),
    ("arrayvec", "accel"),
    ("clap", "cli"),
    ("crossterm", "ui"),
    ("fearless_simd", "geometry"),
    ("glam", "*"),
    ("image", "image_file"),
    ("libm", "*"),
    ("notify", "watch"),
    ("ratatui", "ui"),
    ("rayon", "*"),
    ("roxmltree", "language"),
    ("rustix", "*"),
    ("shlex", "ui"),
    ("signal_hook", "ui"),
    ("signal_hook_registry", "ui"),
    ("similar", "document"),
    ("smallvec", "geometry"),
    ("sobol_burley", "render"),
    ("termprofile", "ui"),
    ("thiserror", "*"),
    ("tui_input", "ui"),
    ("unicode_width", "*"),
];

#[test]
fn rooms_name_only_the_rooms_they_may() {
    for (file, room, line) in lines() {
        assert!(
            !line.contains("crate::{"),
            "{}: one import a room: {line}",
            file.display()
        );
        for named in names_after(&line, "crate::") {
            let allowed = ARROWS
                .iter()
                .find(|(from, _)| *from == room)
                .map(|(_, to)| *to);
            let allowed = allowed.unwrap_or_else(|| panic!("{room} is not listed in ARROWS"));
            let is_room = ARROWS.iter().any(|(name, _)| *name == named);
            assert!(
                !is_room || named == room || allowed.contains(&named.as_str()),
                "{}: {room} → {named}: {line}",
                file.display()
            );
        }
    }
}

#[test]
fn each_dependency_is_used_by_one_room() {
    for (file, room, line) in lines() {
        for (dependency, owner) in DEPENDENCIES {
            assert!(
                !names_crate(&line, dependency) || *owner == "*" || *owner == room,
                "{}: {dependency} belongs to {owner}: {line}",
                file.display()
            );
        }
    }
}

#[test]
fn the_manifest_and_the_list_of_dependencies_agree() {
    let manifest = fs::read_to_string(root().join("Cargo.toml")).expect("the manifest is there");
    let wanted: BTreeSet<_> = manifest
        .split("\n[")
        .filter(|section| {
            section
                .split(']')
                .next()
                .is_some_and(|name| name == "dependencies" || name.ends_with(".dependencies"))
        })
        .flat_map(|section| section.lines().skip(1))
        .filter_map(|line| Some(line.split_once('=')?.0.trim().replace('-', "_")))
        .collect();
    let listed: BTreeSet<_> = DEPENDENCIES
        .iter()
        .map(|(name, _)| (*name).to_owned())
        .collect();
    assert_eq!(listed, wanted);
}

/// Every line of code outside comments and tests: file, room, line.
fn lines() -> Vec<(PathBuf, String, String)> {
    let mut files = Vec::new();
    collect(&root().join("src"), &mut files);
    let mut lines = Vec::new();
    for file in files {
        let Some(room) = room(&file) else { continue };
        let text = fs::read_to_string(&file).expect("sources are readable");
        // What follows the attribute is tests to the end of the file, unless it is the name of
        // another file, which is passed over as a whole.
        let inline_tests = text.find("#[cfg(test)]\nmod tests {").unwrap_or(text.len());
        let code = text[..inline_tests]
            .lines()
            .filter(|line| !line.trim_start().starts_with("//"));
        lines.extend(code.map(|line| (file.clone(), room.clone(), line.to_owned())));
    }
    assert!(1000 < lines.len(), "the sources were found");
    lines
}

/// The room a source file belongs to; none for the two at the top.
fn room(file: &Path) -> Option<String> {
    let inside = file
        .strip_prefix(root().join("src"))
        .expect("sources are below src");
    let first = inside.iter().next()?.to_str()?.trim_end_matches(".rs");
    (first != "lib" && first != "main").then(|| first.to_owned())
}

fn collect(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("source folders are readable") {
        let path = entry.expect("source folders are readable").path();
        if path.file_stem().is_some_and(|stem| stem == "tests") {
            continue;
        }
        if path.is_dir() {
            collect(&path, files);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
}

/// The names that follow `prefix` in a line.
fn names_after(line: &str, prefix: &str) -> Vec<String> {
    let name = |rest: &str| rest.chars().take_while(|&c| in_name(c)).collect();
    line.match_indices(prefix)
        .map(|(at, _)| name(&line[at + prefix.len()..]))
        .collect()
}

/// Whether a line has a path that begins with this crate's name.
fn names_crate(line: &str, name: &str) -> bool {
    line.match_indices(&format!("{name}::")).any(|(at, _)| {
        let before = line[..at].chars().next_back();
        before.is_none_or(|c| !in_name(c) && c != ':')
    })
}

fn in_name(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}
