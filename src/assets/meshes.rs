//! Reads meshes and the material libraries that they name.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::sync::Arc;

use super::Load;
use super::failure::Failure;
use super::gate::FileContent;
use obj::{Finding, Format, Model};
use scene::{Meshes, NoMesh, beside};

/// A mesh and the files it was read from.
#[derive(Clone, Debug)]
pub(super) struct KnownMesh {
    /// What the bytes were read as.
    format: Format,
    /// A hash of the file's bytes.
    digest: u64,
    /// The libraries by their names in the mesh, each with a hash of its bytes or an error.
    asked: Vec<(String, Result<u64, String>)>,
    model: Arc<Model>,
}

/// The libraries read so far by name: their bytes and a hash of these, or an error.
type Libraries = BTreeMap<String, Result<(Arc<[u8]>, u64), String>>;

/// The name of a mesh with the extension that it lacks; `None` if it has one.
pub(super) fn with_extension(name: &str) -> Option<String> {
    let lacks = Path::new(name).extension().is_none() && !name.ends_with(['/', '\\']);
    lacks.then(|| format!("{name}.obj"))
}

/// The format of a mesh by its name: `.obj` unless it has the extension of another one.
fn format(name: &str) -> Format {
    Format::of_path(Path::new(name)).unwrap_or(Format::Obj)
}

impl Load<'_> {
    /// Reads meshes. The result contains the meshes or the reasons why they cannot be read.
    pub(super) fn meshes(&mut self, names: &BTreeSet<String>) -> Meshes {
        let mut libraries = Libraries::new();
        let read = names
            .iter()
            .map(|name| (name.clone(), self.mesh(name, &mut libraries)))
            .collect();
        self.now.libraries = libraries.into_keys().collect();
        read
    }

    fn mesh(&mut self, name: &str, libraries: &mut Libraries) -> Result<Arc<Model>, NoMesh> {
        let format = format(name);
        let failed = |failure: Failure| NoMesh::Unread {
            reason: failure.to_string(),
            hint: failure.hint(),
        };
        let content = self.mesh_content(name).map_err(failed)?;
        let known = match self.known(name, (format, content.digest), libraries) {
            Some(known) => known,
            None => self
                .parsed((name, format), &content, libraries)
                .map_err(NoMesh::Malformed)?,
        };
        let model = Arc::clone(&known.model);
        let is_counted = |other: &KnownMesh| Arc::ptr_eq(&other.model.mesh, &model.mesh);
        if !self.now.meshes.iter().any(is_counted) {
            let room = self.room.triangles.checked_sub(model.mesh.len());
            self.room.triangles = room.ok_or_else(|| failed(Failure::TooManyTriangles))?;
        }
        self.now.meshes.push(known);
        Ok(model)
    }

    /// Reads the file of a mesh, also if its name lacks the extension.
    fn mesh_content(&mut self, name: &str) -> Result<FileContent, Failure> {
        let refusal = match self.content(name) {
            Err(refusal @ (Failure::Missing(_) | Failure::NotRegular(_))) => refusal,
            read => return read,
        };
        let Some(longer) = with_extension(name) else {
            return Err(refusal);
        };
        match (self.gate.read(&longer, &mut self.room.bytes), refusal) {
            (Ok(mut content), _) => {
                let place = content.elsewhere.take();
                let place = place.unwrap_or_else(|| self.gate.place(&longer));
                self.note(name, Some(place));
                Ok(content)
            }
            (Err(Failure::Missing(others)), Failure::Missing(mut places)) => {
                places.extend(others);
                Err(Failure::Missing(places))
            }
            (Err(Failure::Missing(_)), refusal) => Err(refusal),
            (Err(failure), _) => Err(failure),
        }
    }

    /// The known mesh of this format and hash whose libraries have not changed.
    fn known(
        &mut self,
        name: &str,
        read: (Format, u64),
        libraries: &mut Libraries,
    ) -> Option<KnownMesh> {
        let known = self.now.meshes.iter().chain(&self.before.meshes);
        let same: Vec<_> = known
            .filter(|known| (known.format, known.digest) == read)
            .cloned()
            .collect();
        same.into_iter().find(|known| {
            known.asked.iter().all(|(library, before)| {
                let now = self.library(name, library, libraries);
                now.map(|(_, digest)| digest) == *before
            })
        })
    }

    /// Parses a mesh. Fails with what is wrong with it.
    fn parsed(
        &mut self,
        (name, format): (&str, Format),
        content: &FileContent,
        libraries: &mut Libraries,
    ) -> Result<KnownMesh, Vec<Finding>> {
        let mut asked = Vec::new();
        let read = obj::read_as(format, &content.bytes, |library| {
            let answer = self.library(name, library, libraries);
            let (bytes, digest) = match answer {
                Ok((bytes, digest)) => (Ok(bytes), Ok(digest)),
                Err(reason) => (Err(reason.clone()), Err(reason)),
            };
            asked.push((library.to_owned(), digest));
            bytes
        });
        let mut model = read?;
        let mut known = self.now.meshes.iter().chain(&self.before.meshes);
        if let Some(twin) =
            known.find(|known| (known.format, known.digest) == (format, content.digest))
        {
            // Only the materials differ: the triangles and their tree can be shared.
            model.mesh = Arc::clone(&twin.model.mesh);
        }
        Ok(KnownMesh {
            format,
            digest: content.digest,
            asked,
            model: Arc::new(model),
        })
    }

    /// Reads a library of a mesh, each only once.
    fn library(
        &mut self,
        mesh: &str,
        library: &str,
        libraries: &mut Libraries,
    ) -> Result<(Arc<[u8]>, u64), String> {
        let name = beside(mesh, library);
        if let Some(known) = libraries.get(&name) {
            return known.clone();
        }
        let read = match self.content(&name) {
            Ok(content) => Ok((content.bytes.into(), content.digest)),
            Err(failure) => Err(match failure.remedy() {
                Some(remedy) => format!("{failure} ({remedy})"),
                None => failure.to_string(),
            }),
        };
        libraries.insert(name, read.clone());
        read
    }
}
