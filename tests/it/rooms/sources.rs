//! The sources as modules: the contents of each file, and the files that define the names it uses.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// The path of a module below the folder of the sources: `["ui", "view", "row"]`; empty at the top.
pub(crate) type Name = Vec<String>;

/// One file, without comments and tests.
pub(crate) struct Module {
    pub(crate) file: PathBuf,
    pub(crate) code: String,
    /// Imports: a path, and the local name of the path.
    imports: Vec<(Vec<String>, String)>,
}

/// All files of a folder.
pub(crate) struct Sources(BTreeMap<Name, Module>);

impl Sources {
    pub(crate) fn of(folder: &str) -> Self {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
        let mut modules = BTreeMap::new();
        collect(&root, &root, &mut modules);
        assert!(!modules.is_empty(), "{folder} has sources");
        Self(modules)
    }

    /// Makes a file of the folder the root of a crate.
    pub(crate) fn rooted_at(mut self, file: &str) -> Self {
        let root = self.0.remove(&[file.to_owned()][..]).expect("it is there");
        self.0.insert(Vec::new(), root);
        self
    }

    /// Every file with its name.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (&Name, &Module)> {
        self.0.iter()
    }

    /// Every pair of a file and another one that defines something it uses.
    pub(crate) fn arrows(&self) -> BTreeSet<(Name, Name)> {
        let mut arrows = BTreeSet::new();
        for (from, module) in &self.0 {
            let imported = module.imports.iter().map(|(path, _)| path.clone());
            for path in imported.chain(inline_paths(&module.code)) {
                let to = self.absolute(from, &path);
                let to = to.and_then(|path| self.definer(path));
                arrows.extend(to.filter(|to| to != from).map(|to| (from.clone(), to)));
            }
        }
        arrows
    }

    /// Resolves a path from the top; `None` if it is in another crate.
    fn absolute(&self, from: &Name, path: &[String]) -> Option<Name> {
        let supers = path.iter().take_while(|part| *part == "super").count();
        let (base, rest) = match path.first()?.as_str() {
            "crate" => (self.root_of(from), &path[1..]),
            "self" => (from.clone(), &path[1..]),
            "super" => (
                from[..from.len().checked_sub(supers)?].to_vec(),
                &path[supers..],
            ),
            child => {
                let is_child = self
                    .0
                    .contains_key(&[from, &[child.to_owned()][..]].concat());
                (is_child.then(|| from.clone())?, path)
            }
        };
        Some([&base, rest].concat())
    }

    /// The root of the crate that contains a file: the folder of a `lib.rs` or `main.rs`, or the top.
    fn root_of(&self, from: &Name) -> Name {
        let is_root = |name: &&[String]| {
            let file = self.0.get(*name).map(|module| &module.file);
            file.is_some_and(|file| file.ends_with("lib.rs") || file.ends_with("main.rs"))
        };
        let above = (1..=from.len()).map(|length| &from[..length]);
        above.rev().find(is_root).unwrap_or_default().to_vec()
    }

    /// The file that defines the item at a path, following re-exports. `None` if it is not in this
    /// folder.
    fn definer(&self, mut path: Name) -> Option<Name> {
        loop {
            let known = (0..=path.len())
                .rev()
                .find(|&at| self.0.contains_key(&path[..at]));
            let (name, rest) = path.split_at(known?);
            let Some(item) = rest.first() else {
                return Some(path);
            };
            let module = &self.0[name];
            if module.code.contains(&format!("mod {item};")) {
                return None;
            }
            // Imports by a nested module from its own file are not re-exports.
            let is_passed = |(path, called): &&(Name, String)| called == item && path[0] != "self";
            match module.imports.iter().find(is_passed) {
                Some((import, _)) => {
                    let from = name.to_vec();
                    path = [self.absolute(&from, import)?, rest[1..].to_vec()].concat();
                }
                None => return Some(name.to_vec()),
            }
        }
    }
}

fn collect(root: &Path, folder: &Path, modules: &mut BTreeMap<Name, Module>) {
    for entry in fs::read_dir(folder).expect("source folders are readable") {
        let path = entry.expect("source folders are readable").path();
        if path.file_stem().is_some_and(|stem| stem == "tests") {
            continue;
        }
        if path.is_dir() {
            collect(root, &path, modules);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            let module = path.with_extension("");
            let inside = module
                .strip_prefix(root)
                .expect("files are in their folder");
            let parts = inside
                .iter()
                .map(|part| part.to_string_lossy().into_owned());
            let mut name: Name = parts.collect();
            name.pop_if(|last| ["mod", "lib", "main"].contains(&last.as_str()));
            let text = fs::read_to_string(&path).expect("sources are readable");
            if !text.contains("#![cfg(test)]") {
                modules.insert(name, Module::new(path, &text));
            }
        }
    }
}

impl Module {
    fn new(file: PathBuf, text: &str) -> Self {
        // Tests extend from the attribute to the end of the file, unless they are in another file,
        // which is skipped completely.
        let is_code = |line: &&str| line.starts_with(' ') || !line.ends_with("mod tests {");
        let code = text.lines().take_while(is_code);
        let code = code.filter(|line| !line.trim_start().starts_with("//"));
        // In a nested module, `super` is the file itself.
        let mut is_inside = false;
        let code: String = code
            .flat_map(|line| {
                is_inside = match line {
                    "}" => false,
                    _ => is_inside || line.contains("mod ") && line.ends_with('{'),
                };
                let outer = if is_inside { "super::" } else { "" };
                [
                    line.replacen(outer, "self::", usize::from(is_inside)),
                    "\n".to_owned(),
                ]
            })
            .collect();
        let imports = uses(&code);
        Self {
            file,
            code,
            imports,
        }
    }
}

/// The imports of a file.
fn uses(code: &str) -> Vec<(Vec<String>, String)> {
    let mut found = Vec::new();
    for (at, _) in code.match_indices("use ") {
        let start = code[..at].rfind('\n').map_or(0, |end| end + 1);
        let before = code[start..at].trim_start();
        if let Some((tree, _)) = code[at + 4..].split_once(';')
            && (before.is_empty() || before.starts_with("pub"))
        {
            let tree: Vec<_> = tree.split_whitespace().collect();
            expand(&[], &tree.join(" "), &mut found);
        }
    }
    found
}

/// Expands a tree of imports to paths, each with its local name.
fn expand(prefix: &[String], tree: &str, found: &mut Vec<(Vec<String>, String)>) {
    let parts = |path: &str| -> Vec<String> {
        let parts = path.split("::").map(str::trim);
        parts
            .filter(|part| !part.is_empty())
            .map(str::to_owned)
            .collect()
    };
    let tree = tree.trim();
    if let Some((stem, branches)) = tree.split_once('{') {
        let stem = [prefix, &parts(stem)].concat();
        let branches = branches.strip_suffix('}').unwrap_or(branches);
        let (mut depth, mut start) = (0, 0);
        for (at, c) in branches.char_indices().chain([(branches.len(), ',')]) {
            match c {
                '{' => depth += 1,
                '}' => depth -= 1,
                ',' if depth == 0 => {
                    expand(&stem, &branches[start..at], found);
                    start = at + 1;
                }
                _ => {}
            }
        }
    } else if !tree.is_empty() {
        let (path, alias) = tree.split_once(" as ").unwrap_or((tree, ""));
        let mut path = [prefix, &parts(path)].concat();
        path.pop_if(|last| last == "self");
        let last = path.last().cloned().unwrap_or_default();
        found.push((
            path,
            if alias.is_empty() {
                last
            } else {
                alias.to_owned()
            },
        ));
    }
}

/// The paths in code outside of imports and of visibilities: `row::Row::new`.
fn inline_paths(code: &str) -> impl Iterator<Item = Vec<String>> + '_ {
    let lines = code.lines().filter(|line| !line.contains("use "));
    let lines = lines.map(|line| match line.split_once("pub(in ") {
        Some((_, rest)) => rest.split_once(')').map_or(rest, |(_, item)| item),
        None => line,
    });
    let words = lines.flat_map(|line| line.split(|c: char| !in_name(c) && c != ':'));
    let paths = words.filter(|word| word.contains("::") && word.ends_with(in_name));
    paths.map(|path| path.split("::").map(str::to_owned).collect())
}

pub(crate) fn in_name(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}
