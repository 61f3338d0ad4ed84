//! Lights, materials, textures, and the uses of textures by materials.

use std::f64::consts::PI;

use glam::DVec2;

use super::Lowering;
use crate::coefficients::Coefficients;
use crate::dat::schema::{
    CHECKER, IMAGE, LIGHT, LightKind, MATERIAL, SHADOWS, SOURCES, USE_BUMP, USE_COLOUR,
};
use crate::engine::reader::Reading;
use crate::schema::position::At;
use geometry::normalise;
use scene::{Bump, Emitter, Falloff, Light, Pattern, Side, Texture, Tinted};
use text::Diagnostic;

const POSITION: At<3> = LIGHT.at("position");
const DIRECTION: At<3> = LIGHT.at("direction");

impl Lowering<'_> {
    pub(super) fn light(&mut self, read: &Reading<'_>) {
        let numbers = &*read.numbers_or_zeros();
        // The errors of an invalid record were already reported.
        let emitter = read.numbers().map_or(Some(Emitter::Ambient), emitter);
        let emitter = emitter.unwrap_or_else(|| {
            let span = POSITION.span(&read.spans).to(DIRECTION.span(&read.spans));
            self.reader.report.error(|| {
                let message = format!("{} direction: must not be zero", read.name);
                Diagnostic::error(span, message, "the direction in which the light travels")
                    .with_hint("a position other than 0 0 0 would give the direction too")
            });
            Emitter::Ambient
        });
        self.lights.push(Light {
            emitter,
            colour: const { LIGHT.at("colour") }.vector(numbers),
            scale: PI,
            shadows: const { LIGHT.at("shadow") }.choice(numbers, &SHADOWS),
        });
    }

    pub(super) fn material(&mut self, read: &Reading<'_>) {
        let material = coefficients(&read.numbers_or_zeros());
        self.materials.push(material.into());
    }

    pub(super) fn texture(&mut self, read: &Reading<'_>) {
        let numbers = &*read.numbers_or_zeros();
        let (repeat, pattern) = if *read.record == CHECKER {
            let colours = const { [CHECKER.at("first"), CHECKER.at("second")] };
            let squares = colours.map(|at| Tinted {
                colour: at.vector(numbers),
                texture: None,
            });
            let side = Side::One;
            (
                const { CHECKER.at("repeat") },
                Pattern::Checker { squares, side },
            )
        } else {
            let file = const { IMAGE.at::<1>("file") };
            let file = read.spans.get(file.index()).copied().unwrap_or_default();
            let file = file.of(self.reader.text).to_owned();
            (const { IMAGE.at("repeat") }, Pattern::Image(file))
        };
        let repeat = DVec2::from_array(repeat.get(numbers));
        self.textures.push(Texture::repeated(repeat, pattern));
    }

    pub(super) fn texture_use(&mut self, read: &Reading<'_>) {
        let [Some(texture), Some(material)] = read.refers else {
            return;
        };
        let Some(material) = self.materials.get_mut(material) else {
            return;
        };
        let texture = texture as u32;
        let maps = material.maps.get_or_insert_default();
        if *read.record == USE_COLOUR {
            maps.ambient = Some(texture);
            maps.diffuse = Some(texture);
            maps.specular = Some(texture);
        } else {
            let height = const { USE_BUMP.at("height") };
            let height = height.number(&read.numbers_or_zeros());
            maps.bump = Some(Bump { texture, height });
        }
    }
}

/// The emitter of a light; `None` for a distant light without direction.
fn emitter(numbers: &[f64]) -> Option<Emitter> {
    let position = POSITION.vector(numbers);
    let direction = DIRECTION.vector(numbers);
    Some(
        match const { LIGHT.at("source") }.choice(numbers, &SOURCES) {
            LightKind::Point => {
                let radial = const { [LIGHT.at("a0"), LIGHT.at("a1"), LIGHT.at("a2")] };
                let exponent = const { LIGHT.at("aa") }.number(numbers);
                let direction = normalise(direction).filter(|_| 0.0 < exponent);
                Emitter::Point {
                    position,
                    radius: 0.0,
                    falloff: Falloff {
                        radial: radial.map(|at| at.number(numbers)),
                        spot: direction.map(|direction| (direction, exponent)),
                    },
                }
            }
            LightKind::Distant => {
                let toward = normalise(direction).map(|direction| -direction);
                Emitter::Distant(toward.or_else(|| normalise(position))?)
            }
            LightKind::Ambient => Emitter::Ambient,
        },
    )
}

/// The material described by these numbers.
fn coefficients(numbers: &[f64]) -> Coefficients {
    let colour = const { MATERIAL.at("RGB") }.vector(numbers);
    Coefficients {
        ambient: const { MATERIAL.at("Ka") }.number(numbers) * colour,
        diffuse: const { MATERIAL.at("Kd") }.number(numbers) * colour,
        specular: const { MATERIAL.at("Ks") }.number(numbers) * colour,
        exponent: const { MATERIAL.at("ns") }.number(numbers),
        reflection: const { MATERIAL.at("Kr") }.number(numbers),
        transmission: const { MATERIAL.at("Kt") }.number(numbers),
        index: const { MATERIAL.at("ior") }.number(numbers),
    }
}
