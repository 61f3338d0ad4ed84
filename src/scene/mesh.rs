//! The meshes of a scene's objects, as values.

use std::collections::HashMap;
use std::path::Path;
use std::sync::Arc;

use crate::obj::Model;

/// What became of the meshes that a scene names, by the paths that its text says. One that is
/// missing here was not read yet.
///
/// Values are equal where they are the same in memory: meshes are too large to be compared.
#[derive(Clone, Debug, Default)]
pub struct Meshes(Arc<HashMap<String, Result<Arc<Model>, NoMesh>>>);

/// Why a mesh can't be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NoMesh {
    /// All that is wrong, each as the end of a sentence; at least one.
    pub reasons: Vec<String>,
    /// What helps.
    pub hint: Option<String>,
}

impl Meshes {
    /// The mesh of a path, or why there is none; `None` if it was not read yet.
    pub fn get(&self, path: &str) -> Option<Result<&Arc<Model>, &NoMesh>> {
        self.0.get(path).map(Result::as_ref)
    }

    /// How many of them can't be read.
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

/// The path of a file whose name is relative to the folder of another one: of what a mesh or a
/// library of materials names, as if the scene's text did. `\` separates as `/` does.
pub fn beside(file: &str, name: &str) -> String {
    let [file, name] = [file, name].map(|path| path.replace('\\', "/"));
    let path = Path::new(&file).with_file_name(name);
    path.to_string_lossy().into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_relative_to_the_file_that_says_them() {
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
