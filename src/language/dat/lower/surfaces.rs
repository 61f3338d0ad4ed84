//! Lights, materials, textures, and the uses of textures by materials.

use std::collections::hash_map::Entry;
use std::f64::consts::PI;

use glam::DVec2;

use super::Lowering;
use crate::coefficients::Coefficients;
use crate::dat::origins::{Place, UsePlace};
use crate::dat::table::{LightKind, RecordKind, SHADOWS, SOURCES, TextureKind, UseKind};
use crate::report::Name;
use crate::slot::At;
use crate::table::Category;
use crate::words::Words;
use geometry::normalise;
use scene::{Bump, Emitter, Falloff, Light, Pattern, Side, Texture, Tinted};
use text::Diagnostic;

const LIGHT: RecordKind = RecordKind::Light;
const POSITION: At<3> = LIGHT.at("position");
const DIRECTION: At<3> = LIGHT.at("direction");

const COLOUR: RecordKind = RecordKind::Use(UseKind::Colour);
const BUMP: RecordKind = RecordKind::Use(UseKind::Bump);

impl<'a> Lowering<'a> {
    pub(super) fn light(&mut self, record: usize, tokens: &Words<'a>) {
        let kind = RecordKind::Light;
        let line = self.line(kind, tokens, |id| Name::Known("light", id, ""));
        self.surplus(&line);
        let Some(id) = self.define(Category::Light, &line, self.lights.len()) else {
            return;
        };
        self.origins.lights.push(Place { record, kind, id });
        let numbers = &*line.numbers_or_zeros();
        // The errors of an invalid line were already reported.
        let emitter = line.numbers().map_or(Some(Emitter::Ambient), emitter);
        let emitter = emitter.unwrap_or_else(|| {
            let span = POSITION.span(&line.spans).to(DIRECTION.span(&line.spans));
            self.report.error(|| {
                let message = format!("{} direction: must not be zero", line.name);
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

    pub(super) fn material(&mut self, record: usize, tokens: &Words<'a>) {
        let kind = RecordKind::Material;
        let line = self.line(kind, tokens, |id| Name::Known("material", id, ""));
        self.surplus(&line);
        let Some(id) = self.define(Category::Material, &line, self.materials.len()) else {
            return;
        };
        self.origins.materials.push(Place { record, kind, id });
        let material = coefficients(&line.numbers_or_zeros());
        self.materials.push(material.into());
    }

    pub(super) fn texture(&mut self, record: usize, pattern: TextureKind, tokens: &Words<'a>) {
        let kind = RecordKind::Texture(pattern);
        let line = self.line(kind, tokens, |id| Name::Known("texture", id, ""));
        self.surplus(&line);
        let Some(id) = self.define(Category::Texture, &line, self.textures.len()) else {
            return;
        };
        self.origins.textures.push(Place { record, kind, id });
        let numbers = &*line.numbers_or_zeros();
        let (repeat, pattern) = match pattern {
            TextureKind::Checker => {
                const CHECKER: RecordKind = RecordKind::Texture(TextureKind::Checker);
                let colours = const { [CHECKER.at("first"), CHECKER.at("second")] };
                let squares = colours.map(|at| Tinted {
                    colour: at.vector(numbers),
                    texture: None,
                });
                let side = Side::One;
                let repeat = const { CHECKER.at("repeat") };
                (repeat, Pattern::Checker { squares, side })
            }
            TextureKind::Image => {
                let file = line.word.map_or("", |word| word.of(self.text));
                let repeat = const { RecordKind::Texture(TextureKind::Image).at("repeat") };
                (repeat, Pattern::Image(file.to_owned()))
            }
        };
        let repeat = DVec2::from_array(repeat.get(numbers));
        self.textures.push(Texture::repeated(repeat, pattern));
    }

    pub(super) fn texture_use(&mut self, record: usize, purpose: UseKind, tokens: &Words<'a>) {
        let kind = RecordKind::Use(purpose);
        let line = self.line(kind, tokens, |id| Name::Known("use", id, ""));
        self.surplus(&line);
        let (texture, material) = match purpose {
            UseKind::Colour => const { (COLOUR.at("texture"), COLOUR.at("mat")) },
            UseKind::Bump => const { (BUMP.at("bump"), BUMP.at("mat")) },
        };
        let texture = self.resolve(Category::Texture, line.reference(texture));
        let material = self.resolve(Category::Material, line.reference(material));
        let (Some(texture), Some(material)) = (texture, material) else {
            return;
        };
        let place = UsePlace {
            record,
            kind,
            material,
            texture,
        };
        match self.used.entry((material, purpose)) {
            Entry::Vacant(entry) => {
                entry.insert(self.origins.uses.len());
                self.origins.uses.push(place);
            }
            Entry::Occupied(entry) => {
                let before = std::mem::replace(&mut self.origins.uses[*entry.get()], place);
                self.warn_of_repetition(before.record, tokens.clone().nth(1));
            }
        }
        if let Some(material) = self.materials.get_mut(material) {
            let texture = texture as u32;
            let maps = material.maps.get_or_insert_default();
            match purpose {
                UseKind::Colour => {
                    maps.ambient = Some(texture);
                    maps.diffuse = Some(texture);
                    maps.specular = Some(texture);
                }
                UseKind::Bump => {
                    let height = const { BUMP.at("height") };
                    let height = height.number(&line.numbers_or_zeros());
                    maps.bump = Some(Bump { texture, height });
                }
            }
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
    const MATERIAL: RecordKind = RecordKind::Material;
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
