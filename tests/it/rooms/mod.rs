//! What the manifests of the rooms do not hold: that they name no more than is used, and the order of
//! files. Permitting a cycle of files is a decision about the design.

mod ceilings;
mod sources;

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use sources::{Name, Sources, in_name};

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

/// The rooms without any cycle of files. In the others, a file and those in its folder may use each
/// other, like a type and its parts; siblings may not.
const ACYCLIC: &[&str] = &["cli", "config", "text", "ui", "watch"];

#[test]
fn manifests_name_what_their_rooms_use() {
    let mut code: BTreeMap<String, String> = BTreeMap::new();
    for (name, module) in Sources::of("src").iter() {
        if let Some(room) = name.first() {
            code.entry(room.clone()).or_default().push_str(&module.code);
        }
    }
    for (room, code) in &code {
        let named = dependencies(&root().join(format!("src/{room}/Cargo.toml")));
        let unused = named.iter().filter(|name| !names_crate(code, name));
        assert_eq!(unused.count(), 0, "{room} uses all of {named:?}");
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

/// The crates that a manifest lets its sources use, apart from tests.
fn dependencies(manifest: &Path) -> Vec<String> {
    let text = fs::read_to_string(manifest).expect("each room has a manifest");
    let (_, section) = text.split_once("[dependencies]\n").expect("it has some");
    let section = section.split("\n[").next().unwrap_or_default();
    let names = section.lines().filter_map(|line| line.split_once('.'));
    names.map(|(name, _)| name.replace('-', "_")).collect()
}

/// The names that follow `prefix` in a line.
fn names_after(line: &str, prefix: &str) -> Vec<String> {
    let name = |rest: &str| rest.chars().take_while(|&c| in_name(c)).collect();
    line.match_indices(prefix)
        .map(|(at, _)| name(&line[at + prefix.len()..]))
        .collect()
}

/// Whether code contains a path that begins with this crate's name.
fn names_crate(code: &str, name: &str) -> bool {
    code.match_indices(&format!("{name}::")).any(|(at, _)| {
        let before = code[..at].chars().next_back();
        before.is_none_or(|c| !in_name(c) && c != ':')
    })
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}
