//! The rooms and their dependencies, as described in `src/lib.rs`. Listing another import, or
//! permitting a cycle of files, is a decision about the design.

mod ceilings;
mod sources;

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use sources::{Name, Sources, in_name};

/// Each room and the rooms it may use.
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
    ("explain", &["language", "render", "scene", "text"]),
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
    ("compare", &["scene"]),
    ("part", &["file", "render"]),
    ("track", &["language", "scene", "text"]),
    ("watch", &["file"]),
    (
        "batch",
        &[
            "assets",
            "compare",
            "explain",
            "file",
            "image_file",
            "language",
            "memory",
            "part",
            "render",
            "scene",
            "text",
            "track",
        ],
    ),
    (
        "ui",
        &[
            "assets",
            "compare",
            "document",
            "explain",
            "file",
            "image_file",
            "language",
            "memory",
            "render",
            "scene",
            "text",
            "track",
            "watch",
        ],
    ),
    ("config", &["file", "render", "scene", "text", "ui"]),
    (
        "cli",
        &[
            "batch",
            "config",
            "file",
            "image_file",
            "language",
            "part",
            "render",
            "scene",
            "text",
            "ui",
        ],
    ),
];

/// The rooms of the renderer, from the bottom up: each uses those before it.
const RENDER: &[&str] = &[
    "simd_level",
    "sampling",
    "material",
    "light",
    "job",
    "world",
    "integrators",
    "picture",
    "engine",
    "explain",
];

/// Each dependency and the rooms that use it; `*` means all.
const DEPENDENCIES: &[(&str, &str)] = &[
    ("annotate_snippets", "batch"),
    ("anstyle_lossy", "ui"),
    ("arrayvec", "accel"),
    ("base64", "ui"),
    ("clap", "cli"),
    ("clap_complete", "cli"),
    ("clap_mangen", "cli"),
    ("crc32fast", "part"),
    ("crossterm", "ui"),
    ("exr", "image_file"),
    ("fearless_simd", "geometry"),
    ("glam", "*"),
    ("image", "image_file"),
    ("libm", "geometry language render scene track ui"),
    ("notify", "watch"),
    ("png", "image_file"),
    ("ratatui", "ui"),
    (
        "rayon",
        "accel assets file geometry language memory obj render scene ui",
    ),
    ("roxmltree", "language"),
    ("rustix", "assets batch file memory render ui"),
    ("serde_json", "batch"),
    ("sha2", "file"),
    ("shlex", "text"),
    ("signal_hook", "batch ui"),
    ("signal_hook_registry", "ui"),
    ("similar", "document"),
    ("smallvec", "geometry"),
    ("sobol_burley", "render"),
    ("termprofile", "ui"),
    (
        "thiserror",
        "assets batch config file geometry image_file language memory part render track ui",
    ),
    ("toml", "config track"),
    ("tui_input", "ui"),
    ("unicode_width", "text ui"),
];

/// The rooms without any cycle of files. In the others, a file and those in its folder may use each
/// other, like a type and its parts; siblings may not.
const ACYCLIC: &[&str] = &["cli", "config", "text", "ui", "watch"];

#[test]
fn rooms_use_only_permitted_rooms() {
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
fn the_rooms_of_the_renderer_use_those_below() {
    let place = |name: &Name| {
        let (renderer, room) = (name.first()?, name.get(1)?);
        let place = || RENDER.iter().position(|known| known == room);
        (renderer == "render").then(|| place().unwrap_or_else(|| panic!("{room} is in RENDER")))
    };
    for (from, to) in Sources::of("src").arrows() {
        if let (Some(user), Some(used)) = (place(&from), place(&to)) {
            assert!(used <= user, "{} → {}", from.join("/"), to.join("/"));
        }
    }
}

#[test]
fn each_dependency_is_used_by_its_rooms() {
    let mut users: BTreeMap<&str, BTreeSet<String>> = BTreeMap::new();
    for (_, room, line) in lines() {
        for (dependency, _) in DEPENDENCIES {
            if names_crate(&line, dependency) {
                users.entry(dependency).or_default().insert(room.clone());
            }
        }
    }
    for (dependency, rooms) in DEPENDENCIES.iter().filter(|(_, rooms)| *rooms != "*") {
        let users: Vec<_> = users[dependency].iter().map(String::as_str).collect();
        assert_eq!(users.join(" "), *rooms, "{dependency}");
    }
}

#[test]
fn sibling_files_have_no_cyclic_dependencies() {
    let mut folders: BTreeMap<Name, Graph> = BTreeMap::new();
    for (from, to) in Sources::of("src").arrows() {
        let common = from.iter().zip(&to).take_while(|(a, b)| a == b).count();
        // Otherwise one is in the folder of the other.
        if common < from.len().min(to.len()) {
            let graph = folders.entry(from[..common].to_vec()).or_default();
            let side = |name: &Name| name[..=common].join("/");
            graph.entry(side(&from)).or_default().insert(side(&to));
        }
    }
    let found: BTreeSet<_> = folders.values().flat_map(circles).collect();
    assert_eq!(found, BTreeSet::new());
}

#[test]
fn files_have_no_cyclic_dependencies() {
    let is_strict = |name: &Name| name.first().is_some_and(|room| ACYCLIC.contains(&&**room));
    let mut arrows = Sources::of("src").arrows();
    arrows.retain(|(from, to)| is_strict(from) && is_strict(to));
    let benches = ["colours", "interface", "trace"];
    let benches = benches.map(|root| Sources::of("benches").rooted_at(root).arrows());
    for arrows in [arrows].iter().chain(&benches) {
        let mut graph = Graph::new();
        for (from, to) in arrows {
            let to = to.join("/");
            graph.entry(from.join("/")).or_default().insert(to);
        }
        assert_eq!(circles(&graph), BTreeSet::new());
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

/// Edges from each name to the names it uses.
type Graph = BTreeMap<String, BTreeSet<String>>;

/// The strongly connected components with more than one name.
fn circles(graph: &Graph) -> BTreeSet<String> {
    let reach = |from: &String| {
        let mut found = BTreeSet::new();
        let mut left = vec![from];
        while let Some(name) = left.pop() {
            let next = graph.get(name).into_iter().flatten();
            left.extend(next.filter(|name| found.insert((*name).clone())));
        }
        found
    };
    let reached: BTreeMap<_, _> = graph.keys().map(|name| (name, reach(name))).collect();
    let leads = |from: &String, to: &String| {
        reached
            .get(from)
            .is_some_and(|reached| reached.contains(to))
    };
    let circle = |name: &&String| {
        let members = graph
            .keys()
            .filter(|other| leads(name, other) && leads(other, name));
        members.cloned().collect::<Vec<_>>().join(" ")
    };
    let circular = graph.keys().filter(|name| leads(name, name));
    circular.map(|name| circle(&name)).collect()
}

/// Every line of code outside comments and tests: file, room, line.
fn lines() -> Vec<(PathBuf, String, String)> {
    let mut lines = Vec::new();
    for (name, module) in Sources::of("src").iter() {
        // The two files at the top are in no room.
        if let Some(room) = name.first() {
            let code = module.code.lines();
            lines.extend(code.map(|line| (module.file.clone(), room.clone(), line.to_owned())));
        }
    }
    assert!(1000 < lines.len(), "the sources were found");
    lines
}

/// The names that follow `prefix` in a line.
fn names_after(line: &str, prefix: &str) -> Vec<String> {
    let name = |rest: &str| rest.chars().take_while(|&c| in_name(c)).collect();
    line.match_indices(prefix)
        .map(|(at, _)| name(&line[at + prefix.len()..]))
        .collect()
}

/// Whether a line contains a path that begins with this crate's name.
fn names_crate(line: &str, name: &str) -> bool {
    line.match_indices(&format!("{name}::")).any(|(at, _)| {
        let before = line[..at].chars().next_back();
        before.is_none_or(|c| !in_name(c) && c != ':')
    })
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}
