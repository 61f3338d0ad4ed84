//! The meshes that a scene refers to, as values.

use std::collections::HashMap;
use std::path::Path;
use std::sync::Arc;

use obj::{Finding, Model};

/// The meshes of a scene, or the reasons why they cannot be read, by their paths as written in the
/// text. Paths not read yet are missing.
///
/// Equality is by address, since meshes are too large to compare.
#[derive(Clone, Debug, Default)]
pub struct Meshes(Arc<HashMap<String, Result<Arc<Model>, NoMesh>>>);

/// Why a mesh cannot be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NoMesh {
    /// Its file cannot be read.
    Unread {
        /// The reason, completing a sentence.
        reason: String,
        /// A hint towards a fix.
        hint: Option<String>,
    },
    /// What is wrong with its text; at least one finding.
    Malformed(Vec<Finding>),
}

impl Meshes {
    /// Returns the mesh at a path, or why it cannot be read; `None` if it was not read yet.
    pub fn get(&self, path: &str) -> Option<Result<&Arc<Model>, &NoMesh>> {
        self.0.get(path).map(Result::as_ref)
    }

    /// The number of meshes that cannot be read.
    pub fn unreadable(&self) -> usize {
        self.0.values().filter(|read| read.is_err()).count()
    }
}

impl PartialEq for Meshes {
    fn eq(&self, other: &Self) -> bool {
        let is_same = |(path, read): (&String, &Result<Arc<Model>, NoMesh>)| match (
            read,
            other.0.get(path),
        ) {
            (Ok(model), Some(Ok(other))) => Arc::ptr_eq(model, other),
            (Err(fault), Some(Err(other))) => fault == other,
            _ => false,
        };
        Arc::ptr_eq(&self.0, &other.0)
            || self.0.len() == other.0.len() && self.0.iter().all(is_same)
    }
}

impl FromIterator<(String, Result<Arc<Model>, NoMesh>)> for Meshes {
    fn from_iter<I>(meshes: I) -> Self
    where
        I: IntoIterator<Item = (String, Result<Arc<Model>, NoMesh>)>,
    {
        Self(Arc::new(meshes.into_iter().collect()))
    }
}

/// Resolves a name in a mesh or material library against the folder of that file, as if the scene
/// itself had referred to it. `\` separates like `/`.
pub fn beside(file: &str, name: &str) -> String {
    let [file, name] = [file, name].map(|path| path.replace('\\', "/"));
    let path = Path::new(&file).with_file_name(name);
    path.to_string_lossy().into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_relative_to_the_file_that_contains_them() {
        for (file, name, path) in [
            ("a.obj", "b.mtl", "b.mtl"),
            ("meshes/a.obj", "b.mtl", "meshes/b.mtl"),
            ("meshes/a.obj", "../skins/b.mtl", "meshes/../skins/b.mtl"),
            ("meshes/a.obj", "/b.mtl", "/b.mtl"),
            ("../a.obj", "b c.mtl", "../b c.mtl"),
            ("meshes\\a.obj", "skins\\b.mtl", "meshes/skins/b.mtl"),
            ("", "b.mtl", "b.mtl"),
        ] {
            assert_eq!(beside(file, name), path, "{file} {name}");
        }
    }
}
