//! Colours and numbers with textures, which may be checkerboards of textured colours.

use glam::{DAffine3, DVec3};

use super::Reader;
use crate::language::xml::origins::{NamedPlace, What};
use crate::language::xml::table::{CHECKER, Parameter, Texturing};
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
        let inverse = transform.map_or(Some(DAffine3::IDENTITY), inverse);
        let inverse = inverse.unwrap_or_else(|| {
            self.report.error(|| {
                let message = "texture: its transforms leave it no area";
                Diagnostic::error(span, message, "transforms that can be undone")
            });
            DAffine3::IDENTITY
        });
        self.setting
            .textures
            .push(MappedTexture { inverse, pattern });
        Some(texture as u32)
    }
}

/// The inverse of a transform, however large or small; `None` if |determinant| < 1e-12 · the product
/// of the columns' lengths, or a number is not finite.
fn inverse(transform: DAffine3) -> Option<DAffine3> {
    // Powers of two change no bits, and leave no determinant too small for numbers.
    let columns = [transform.x_axis, transform.y_axis, transform.z_axis];
    let factors = columns.map(|column| {
        let (_, exponent) = libm::frexp(column.abs().max_element());
        libm::scalbn(1.0, -exponent)
    });
    let near = DAffine3::from_cols(
        factors[0] * columns[0],
        factors[1] * columns[1],
        factors[2] * columns[2],
        transform.translation,
    );
    let lengths = [near.x_axis, near.y_axis, near.z_axis].map(DVec3::length);
    let is_flat = near.matrix3.determinant().abs() < 1e-12 * lengths.iter().product::<f64>();
    let inverse = DAffine3::from_scale(DVec3::from_array(factors)) * near.inverse();
    (!is_flat && inverse.is_finite()).then_some(inverse)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn however_small_a_map_is_it_can_be_undone_unless_it_is_flat() {
        for size in [1e-110, 1.0, 1e110] {
            let undone = inverse(DAffine3::from_scale(DVec3::splat(size)));
            let undone = undone.expect("it is not flat").matrix3.x_axis.x * size;
            assert!((undone - 1.0).abs() < 1e-15, "{size}");
        }
        let flat =
            DAffine3::from_cols(DVec3::X, DVec3::new(1.0, 1e-13, 0.0), DVec3::Z, DVec3::ZERO);
        assert_eq!(inverse(flat), None);
        assert_eq!(
            inverse(DAffine3::from_scale(DVec3::new(1.0, 0.0, 1.0))),
            None
        );
    }
}
