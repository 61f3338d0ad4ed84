//! Objects of type `obj`: their meshes, and the materials that those bring along.

use std::sync::Arc;

use glam::DAffine3;

use super::Reader;
use crate::geometry::{Instance, Shape};
use crate::language::node::Node;
use crate::language::xml::origins::{NamedPlace, What};
use crate::obj;
use crate::obj::{Finding, Model};
use crate::scene::beside;
use crate::scene::{
    Finish, Gloss, MappedPattern, MappedTexture, Material, Rgb, Textured, Tinted, Utah,
};
use crate::text::Diagnostic;

/// What the name of such an object is to be.
const EXPECTED: &str = "a mesh file: .obj";

/// Where a mesh is named.
#[derive(Clone, Copy)]
struct Named<'a> {
    /// The object, by index.
    object: usize,
    element: usize,
    attribute: usize,
    name: &'a str,
}

impl<'a> Reader<'a> {
    /// The shape of an object whose mesh is read, and the material of what it has none for.
    pub(super) fn mesh(
        &mut self,
        object: usize,
        frame: Option<DAffine3>,
        material: Option<usize>,
    ) -> Option<(Shape, usize)> {
        let element = self.origins.objects[object].element as usize;
        let named = self.named_mesh(object, element)?;
        let model = self.model(named)?;
        // What an object is to have counts even if there is no such material.
        let tags = match self.word(element, "material") {
            Some(_) => Vec::new(),
            None => self.tags(named, model),
        };
        let affine = self.affine(element, frame?)?;
        let mesh = Arc::clone(&model.mesh);
        let shape = Shape::Mesh(Box::new(Instance::new(mesh, &affine, tags)));
        if !shape.bounds().is_bounded() {
            self.no_volume(element);
            return None;
        }
        Some((shape, material.unwrap_or_else(|| self.white())))
    }

    fn named_mesh(&mut self, object: usize, element: usize) -> Option<Named<'a>> {
        let attribute = self.origins.attribute(self.tree, element, "name");
        let name = attribute.map_or("", |at| self.tree.attributes[at].said(self.text));
        if let Some(attribute) = attribute.filter(|_| !name.is_empty()) {
            self.origins.files.push(NamedPlace {
                element,
                attribute,
                what: What::Mesh,
            });
            return Some(Named {
                object,
                element,
                attribute,
                name,
            });
        }
        let message = format!("{}: there is no name", self.called(element));
        let said = attribute.map(|attribute| self.tree.attributes[attribute].value);
        let place = said.unwrap_or_else(|| self.place(element));
        self.error(place, || message, EXPECTED);
        None
    }

    /// The mesh that is named, if it is read; says what is wrong with it.
    fn model(&mut self, named: Named<'a>) -> Option<&'a Arc<Model>> {
        match self.meshes.get(named.name)? {
            Ok(model) => {
                if self.met.insert(named.name) {
                    self.doubt(named, &model.warnings, "");
                }
                Some(model)
            }
            Err(fault) => {
                let span = self.tree.attributes[named.attribute].value;
                let object = self.origins.name(Node::Object(named.object));
                for reason in &fault.reasons {
                    self.report.error(|| {
                        let error =
                            Diagnostic::error(span, format!("{object}: {reason}"), EXPECTED);
                        match &fault.hint {
                            Some(hint) => error.with_hint(hint),
                            None => error,
                        }
                    });
                }
                None
            }
        }
    }

    fn doubt(&mut self, named: Named<'a>, findings: &[Finding], hint: &str) {
        let span = self.tree.attributes[named.attribute].value;
        for finding in findings {
            let object = self.origins.name(Node::Object(named.object));
            let message = || format!("{object}: {finding}");
            self.warn(span, message, "a file without mistakes", hint);
        }
    }

    /// The material of each slot of a mesh, by index: the same ones for all its instances.
    fn tags(&mut self, named: Named<'a>, model: &Model) -> Vec<u32> {
        if let Some(tags) = self.slots.get(named.name) {
            return tags.clone();
        }
        let hint = "faces without a material are white, whatever light there is";
        self.doubt(named, &model.library_warnings, hint);
        let mut tags = Vec::with_capacity(model.materials.len());
        for material in &model.materials {
            let index = match material {
                Some(material) => {
                    let utah = self.library_material(named, material);
                    self.materials.push(Material::Utah(Box::new(utah)));
                    self.materials.len() - 1
                }
                None => self.white(),
            };
            tags.push(index as u32);
        }
        self.slots.insert(named.name, tags.clone());
        tags
    }

    fn library_material(&mut self, named: Named<'a>, material: &obj::Material) -> Utah {
        let plain = |colour| Tinted {
            colour,
            texture: None,
        };
        let library = beside(named.name, &material.library);
        let mut tinted = |colour: [f64; 3], keyword, map: &Option<String>| Tinted {
            colour: Rgb::from_array(colour),
            texture: map
                .as_ref()
                .map(|map| self.map(named, keyword, beside(&library, map))),
        };
        let gloss = Gloss {
            diffuse: tinted(material.diffuse, "map_Kd", &material.diffuse_map),
            specular: tinted(material.specular, "map_Ks", &material.specular_map),
            glossiness: Textured {
                value: material.exponent.max(0.0),
                texture: None,
            },
        };
        let model = material.illumination;
        Utah {
            finish: Finish::Blinn(gloss),
            reflection: plain(match model {
                3..=7 => Rgb::from_array(material.specular),
                _ => Rgb::ZERO,
            }),
            reflection_spread: 0.0,
            refraction: plain(match model {
                6 | 7 => Rgb::ONE - Rgb::from_array(material.filter),
                _ => Rgb::ZERO,
            }),
            refraction_spread: 0.0,
            index: material.index,
            absorption: Rgb::ZERO,
            emission: plain(Rgb::ZERO),
        }
    }

    /// The texture of a picture that a material of a mesh names.
    fn map(&mut self, named: Named<'a>, keyword: &'static str, path: String) -> u32 {
        self.origins.files.push(NamedPlace {
            element: named.element,
            attribute: named.attribute,
            what: What::Map(keyword, path.clone().into()),
        });
        self.setting.textures.push(MappedTexture {
            inverse: DAffine3::IDENTITY,
            pattern: MappedPattern::Image(path),
        });
        self.setting.textures.len() as u32 - 1
    }
}
