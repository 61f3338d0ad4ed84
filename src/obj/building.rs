//! What is common to meshes without libraries.

use std::sync::Arc;

use super::findings::{File, Findings};
use super::lines::{Fault, Word};
use super::polygons::Polygons;
use super::{Finding, Model};
use geometry::{Mesh, MeshParts};

/// A mesh being read that names no materials.
pub(super) struct Building<'t> {
    pub(super) file: File<'t>,
    /// The maximum number of triangles.
    pub(super) most: usize,
    pub(super) parts: MeshParts,
    pub(super) polygons: Polygons,
    pub(super) findings: Findings,
}

impl<'t> Building<'t> {
    pub(super) fn new(file: File<'t>, most: usize) -> Self {
        Self {
            file,
            most,
            parts: MeshParts::default(),
            polygons: Polygons::default(),
            findings: Findings::default(),
        }
    }

    pub(super) fn warn(&mut self, fault: Fault) {
        self.findings.warn(self.file, fault);
    }

    /// Fails, at a place, if so many triangles are too many.
    pub(super) fn check_room(&self, triangles: usize, place: Word<'_>) -> Result<(), Fault> {
        let most = self.most;
        if triangles <= most {
            return Ok(());
        }
        let message = format!("more than {most} triangles");
        Err(Fault::new(place, message, format!("at most {most}")))
    }

    /// Adds the triangles around the first corner of a polygon of three or more.
    pub(super) fn add_fan(&mut self, corners: &[u32]) {
        let triangles = &mut self.parts.triangles;
        if 3 < corners.len() {
            self.polygons.push(triangles.len(), corners.len());
        }
        let pairs = corners[1..].windows(2);
        triangles.extend(pairs.map(|pair| [corners[0], pair[0], pair[1]]));
    }

    /// The mesh, unless reading it failed. `nothing` is what is wrong if there are no triangles.
    pub(super) fn finish(
        mut self,
        read: Result<(), Fault>,
        nothing: Fault,
    ) -> Result<Model, Vec<Finding>> {
        let fault = match read {
            Err(fault) => fault,
            Ok(()) if self.parts.triangles.is_empty() => nothing,
            Ok(()) => {
                self.polygons.reshape(&mut self.parts);
                match Mesh::new(self.parts) {
                    Ok(mesh) => {
                        return Ok(Model {
                            mesh: Arc::new(mesh),
                            materials: vec![None],
                            warnings: self.findings.finish(),
                            library_warnings: Vec::new(),
                        });
                    }
                    Err(error) => Fault {
                        message: error.to_string(),
                        ..nothing
                    },
                }
            }
        };
        Err(self.findings.fail(self.file, fault))
    }
}
