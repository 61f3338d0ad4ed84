//! Colours and numbers with textures, which may be checkerboards of textured colours.

use glam::{DAffine3, DVec3};

use super::Lowering;
use crate::xml::origins::What;
use crate::xml::parameter::Parameter;
use crate::xml::schema::CHECKER;
use scene::{Pattern, Side, Texture, Tinted};

/// The name of the checkerboard texture.
const CHECKERBOARD: &str = "checkerboard";

/// A square of a checkerboard still to be read.
struct Square {
    texture: usize,
    /// Index of its colour.
    place: usize,
    element: usize,
}

impl Lowering<'_> {
    /// The colour of an element's parameter, with its texture, or the default.
    pub(super) fn tinted(&mut self, holder: usize, parameter: &'static Parameter) -> Tinted {
        let element = self.element_of(Some(holder), parameter);
        Tinted {
            colour: self.vector_in(element, parameter),
            texture: element.and_then(|element| self.texture_in(element, parameter)),
        }
    }

    /// The number of an element's parameter, with its texture, or the default.
    pub(super) fn textured(
        &mut self,
        holder: usize,
        parameter: &'static Parameter,
    ) -> (f64, Option<u32>) {
        let element = self.element_of(Some(holder), parameter);
        let value = self.number(Some(holder), parameter);
        let texture = element.and_then(|element| self.texture_in(element, parameter));
        (value, texture)
    }

    /// The texture of an element, with all textures nested in it.
    fn texture_in(&mut self, element: usize, parameter: &'static Parameter) -> Option<u32> {
        let mut pending = Vec::new();
        let first = self.one_texture(element, parameter, &mut pending);
        while let Some(next) = pending.pop() {
            let colour = CHECKER[next.place];
            let tinted = Tinted {
                colour: self.vector_in(Some(next.element), colour),
                texture: self.one_texture(next.element, colour, &mut pending),
            };
            let pattern = &mut self.textures[next.texture].pattern;
            if let Pattern::Checker { squares, .. } = pattern {
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
        let attribute = self.tree.attribute_at(self.text, element, "texture");
        let attribute = attribute.filter(|_| parameter.may_have_texture)?;
        let value = &self.tree.attributes[attribute];
        let (word, span) = (value.unescaped(self.text), value.value);
        if word.is_empty() {
            let message = || "texture: the name is missing".to_owned();
            let (expected, hint) = ("checkerboard, or a picture file", "the texture is ignored");
            self.warn(span, message, expected, hint);
            return None;
        }
        let texture = self.textures.len();
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
            Pattern::Checker {
                squares: colours,
                side: Side::Half,
            }
        } else {
            self.origins.note_file(element, attribute, What::Texture);
            Pattern::Image(word.to_owned())
        };
        let transform = self.transform_of(element);
        let inverse = transform.map_or(Some(DAffine3::IDENTITY), inverse);
        let inverse = inverse.unwrap_or_else(|| {
            let message = || "texture: its transforms are not invertible".to_owned();
            self.error(span, message, "invertible transforms");
            DAffine3::IDENTITY
        });
        self.textures.push(Texture { inverse, pattern });
        Some(texture as u32)
    }
}

/// The inverse of a transform at any scale; `None` if |determinant| < 1e-12 · the product of the
/// columns' lengths, or a number is not finite.
fn inverse(transform: DAffine3) -> Option<DAffine3> {
    // Powers of two scale exactly, and keep the determinant from underflowing.
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
    fn maps_of_any_scale_are_invertible_unless_flat() {
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
