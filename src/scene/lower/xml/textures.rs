//! Colours and numbers with textures, which may be checkerboards of textured colours.

use glam::{DAffine3, DVec3};

use super::Reader;
use crate::scene::fields::xml::{CHECKER, Parameter, Texturing};
use crate::scene::origins::xml::{NamedPlace, What};
use crate::scene::{MappedPattern, MappedTexture, Textured, Tinted};
use crate::text::Diagnostic;

/// The texture that is made of squares.
const CHECKERBOARD: &str = "checkerboard";

/// A square of a checkerboard that is yet to be read.
struct Square {
    texture: usize,
    /// Its place among the two.
    place: usize,
    element: usize,
}

impl Reader<'_> {
    /// A colour in an element, with its texture, or what stands for it.
    pub(super) fn tinted(&mut self, holder: usize, parameter: &'static Parameter) -> Tinted {
        match self.element_of(Some(holder), parameter) {
            Some(element) => self.tinted_in(element, parameter),
            None => Tinted {
                colour: self.vector(None, parameter),
                texture: None,
            },
        }
    }

    /// The colour that an element says, with its texture.
    pub(super) fn tinted_in(&mut self, element: usize, parameter: &'static Parameter) -> Tinted {
        Tinted {
            colour: self.vector_in(element, parameter),
            texture: self.texture_in(element, parameter),
        }
    }

    /// A number in an element, with its texture, or what stands for it.
    pub(super) fn textured(&mut self, holder: usize, parameter: &'static Parameter) -> Textured {
        let element = self.element_of(Some(holder), parameter);
        Textured {
            value: self.number(Some(holder), parameter),
            texture: element.and_then(|element| self.texture_in(element, parameter)),
        }
    }

    /// The texture that an element says, with all those in it.
    fn texture_in(&mut self, element: usize, parameter: &'static Parameter) -> Option<u32> {
        let mut pending = Vec::new();
        let first = self.one_texture(element, parameter, &mut pending);
        while let Some(next) = pending.pop() {
            let colour = &CHECKER[next.place];
            let tinted = Tinted {
                colour: self.vector_in(next.element, colour),
                texture: self.one_texture(next.element, colour, &mut pending),
            };
            let pattern = &mut self.setting.textures[next.texture].pattern;
            if let MappedPattern::Checkerboard(squares) = pattern {
                squares[next.place] = tinted;
            }
        }
        first
    }

    fn one_texture(
        &mut self,
        element: usize,
        parameter: &'static Parameter,
        pending: &mut Vec<Square>,
    ) -> Option<u32> {
        let attribute = self.origins.attribute(self.tree, element, "texture");
        let attribute = attribute.filter(|_| parameter.texture == Texturing::Yes)?;
        let said = &self.tree.attributes[attribute];
        let (word, span) = (said.said(self.text), said.value);
        if word.is_empty() {
            let message = || "texture: there is no name".to_owned();
            self.warn(
                span,
                message,
                "checkerboard, or a picture file",
                "there is no texture",
            );
            return None;
        }
        let texture = self.setting.textures.len();
        let pattern = if word == CHECKERBOARD {
            let mut colours = [Tinted::default(); 2];
            for (square, colour) in CHECKER.iter().enumerate() {
                match self.element_of(Some(element), colour) {
                    Some(element) => pending.push(Square {
                        texture,
                        place: square,
                        element,
                    }),
                    None => colours[square].colour = self.vector(None, colour),
                }
            }
            MappedPattern::Checkerboard(colours)
        } else {
            self.origins.files.push(NamedPlace {
                element,
                attribute,
                what: What::Texture,
            });
            MappedPattern::Image(word.to_owned())
        };
        let transform = self.transform_of(element);
        let inverse = transform.map_or(DAffine3::IDENTITY, |transform| {
            let inverse = transform.inverse();
            let columns = [inverse.x_axis, inverse.y_axis, inverse.z_axis];
            let is_finite = columns.into_iter().all(DVec3::is_finite);
            if is_finite && inverse.translation.is_finite() {
                return inverse;
            }
            self.report.error(|| {
                let message = "texture: its transforms leave it no area";
                Diagnostic::error(span, message, "scales other than 0")
            });
            DAffine3::IDENTITY
        });
        self.setting
            .textures
            .push(MappedTexture { inverse, pattern });
        Some(texture as u32)
    }
}
