//! Objects of type `obj`: their meshes, and the materials that these define.

use std::sync::Arc;

use glam::{DAffine3, DMat3, DVec3};

use super::Lowering;
use super::surfaces::lit;
use crate::schema::SIZES;
use crate::xml::origins::What;
use geometry::{Instance, Shape};
use obj::{Edges, Finding, Map, Model};
use scene::{
    Dielectric, Faces, Gloss, Highlight, Maps, Material, Mirror, NoMesh, Pattern, Rgb, Texture,
    beside,
};
use text::{Cited, Diagnostic, Span};

/// The expected name of such an object, for messages.
const EXPECTED: &str = "a mesh file: .obj, .ply or .stl";

/// What it costs if a mesh cannot be read.
const LEFT_OUT: &str = "the object is left out";

/// The attribute that names a mesh.
#[derive(Clone, Copy)]
struct Named<'a> {
    element: usize,
    attribute: usize,
    span: Span,
    name: &'a str,
}

impl<'a> Lowering<'a> {
    /// The shape of an object whose mesh has been read, and the material of the parts without one.
    pub(super) fn mesh(
        &mut self,
        element: usize,
        frame: Option<DAffine3>,
        material: Option<usize>,
    ) -> Option<(Shape, usize)> {
        let named = self.named_mesh(element)?;
        let model = self.model(named)?;
        // An object's own material counts even if it is not defined.
        let tags = match self.word(element, "material") {
            Some(_) => Vec::new(),
            None => self.tags(named, model),
        };
        let frame = frame?;
        let affine = self.affine(element, frame)?;
        let mesh = Arc::clone(&model.mesh);
        let shape = Shape::Mesh(Box::new(Instance::new(mesh, &affine, tags)));
        if !shape.bounds().is_bounded() {
            self.no_volume(element);
            return None;
        }
        if SIZES[1] <= shape.bounds().size().max_element() {
            self.no_size(element, &frame);
            return None;
        }
        Some((shape, material.unwrap_or_else(|| self.white())))
    }

    fn named_mesh(&mut self, element: usize) -> Option<Named<'a>> {
        let attribute = self.tree.attribute_at(self.text, element, "name");
        let value = attribute.map(|at| &self.tree.attributes[at]);
        let name = value.map_or("", |value| value.unescaped(self.text));
        let span = value.map_or_else(|| self.place(element), |value| value.value);
        let Some(attribute) = attribute.filter(|_| !name.is_empty()) else {
            let message = format!("{}: the name is missing", self.display_name(element));
            self.error(span, || message, EXPECTED);
            return None;
        };
        self.origins.note_file(element, attribute, What::Mesh);
        Some(Named {
            element,
            attribute,
            span,
            name,
        })
    }

    /// The named mesh, if it has been read; reports its problems. An object without one is left out.
    fn model(&mut self, named: Named<'a>) -> Option<&'a Arc<Model>> {
        match self.meshes.get(named.name)? {
            Ok(model) => {
                if self.reported_meshes.insert(named.name) {
                    self.warn_of(named, &model.warnings);
                }
                Some(model)
            }
            Err(NoMesh::Unread { reason, hint }) => {
                let object = self.display_name(named.element);
                let hint = match hint {
                    Some(hint) => format!("{LEFT_OUT}; {hint}"),
                    None => LEFT_OUT.to_owned(),
                };
                let message = || format!("{object}: {reason}");
                self.warn(named.span, message, EXPECTED, &hint);
                None
            }
            Err(NoMesh::Malformed(findings)) => {
                let (reason, lines) = findings.split_last()?;
                if self.reported_meshes.insert(named.name) {
                    self.warn_of(named, lines);
                }
                let object = self.display_name(named.element);
                self.report.warning(|| Diagnostic {
                    message: format!("{object}: {}", reason.message),
                    ..cited(named.span, named.name, reason).with_hint(LEFT_OUT)
                });
                None
            }
        }
    }

    /// Warns of problems of a mesh and its libraries, at their own places.
    fn warn_of(&mut self, named: Named<'a>, findings: &[Finding]) {
        for finding in findings {
            self.report
                .warning(|| cited(named.span, named.name, finding));
        }
    }

    /// The material index of each slot of a mesh, shared by all its instances.
    fn tags(&mut self, named: Named<'a>, model: &Model) -> Vec<u32> {
        if let Some(tags) = self.slots.get(named.name) {
            return tags.clone();
        }
        self.warn_of(named, &model.library_warnings);
        let mut tags = Vec::with_capacity(model.materials.len());
        for material in &model.materials {
            let index = match material {
                Some(material) => {
                    let material = self.library_material(named, material);
                    self.materials.push(material);
                    self.materials.len() - 1
                }
                None => self.white(),
            };
            tags.push(index as u32);
        }
        self.slots.insert(named.name, tags.clone());
        tags
    }

    fn library_material(&mut self, named: Named<'a>, material: &obj::Material) -> Material {
        let library = beside(named.name, &material.library);
        let mut map = |keyword, map: &Option<Map>| {
            let map = map.as_ref();
            map.map(|map| self.map(named, keyword, beside(&library, &map.path), map))
        };
        let maps = Maps {
            diffuse: map("map_Kd", &material.diffuse_map),
            specular: map("map_Ks", &material.specular_map),
            ..Maps::default()
        };
        let specular = Rgb::from_array(material.specular);
        let model = material.illumination;
        let transmittance = match model {
            6 | 7 => Rgb::ONE - Rgb::from_array(material.filter),
            _ => Rgb::ZERO,
        };
        Material {
            diffuse: Rgb::from_array(material.diffuse),
            highlight: Highlight::Blinn(Gloss {
                specular,
                exponent: material.exponent.max(0.0),
            }),
            mirror: Mirror {
                tint: match model {
                    3..=7 => specular,
                    _ => Rgb::ZERO,
                },
                faces: Faces::Front,
                ..Mirror::default()
            },
            dielectric: Dielectric {
                tint: transmittance,
                index: material.index,
                ..Dielectric::OPAQUE
            },
            emission: Rgb::from_array(material.emission),
            lit: lit(transmittance),
            maps: maps.boxed(),
            ..Material::BLACK
        }
    }

    /// The texture of a picture named by a material of a mesh.
    fn map(&mut self, named: Named<'a>, keyword: &'static str, path: String, map: &Map) -> u32 {
        let what = What::Map(keyword, path.clone().into());
        self.origins.note_file(named.element, named.attribute, what);
        let [scale, offset] =
            [(map.scale, 1.0), (map.offset, 0.0)].map(|([u, v], w)| DVec3::new(u, v, w));
        self.textures.push(Texture {
            inverse: DAffine3 {
                matrix3: DMat3::from_diagonal(scale),
                translation: offset,
            },
            pattern: match map.edges {
                Edges::Repeat => Pattern::Image(path),
                Edges::Clamp => Pattern::Clamped(path),
            },
        });
        self.textures.len() as u32 - 1
    }
}

/// The warning of a problem of a mesh, or of one of its libraries, where the scene names the mesh.
fn cited(span: Span, mesh: &str, finding: &Finding) -> Diagnostic {
    let file = match &finding.library {
        Some(library) => beside(mesh, library),
        None => mesh.to_owned(),
    };
    let warning = Diagnostic::warning(span, &finding.message, &finding.expected);
    let warning = warning.citing(Cited {
        file,
        line: finding.line,
        column: finding.column,
        excerpt: finding.excerpt.clone(),
        marked: finding.marked,
    });
    match &finding.hint {
        Some(hint) => warning.with_hint(hint),
        None => warning,
    }
}
