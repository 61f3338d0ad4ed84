//! Lights, materials, textures, and the uses of textures by materials.

use std::collections::hash_map::Entry;
use std::f64::consts::PI;

use glam::DVec2;

use super::Reader;
use crate::geometry::normalise;
use crate::language::coefficients::Coefficients;
use crate::language::dat::origins::{Place, UsePlace};
use crate::language::dat::table::{RecordKind, TextureKind, UseKind};
use crate::language::record::Gathered;
use crate::language::report::Name;
use crate::language::table::Category;
use crate::language::words::Words;
use crate::scene::{Bump, Emitter, Falloff, Light, Pattern, Shadows, Side, Texture, Tinted};
use crate::text::Diagnostic;

impl<'a> Reader<'a> {
    pub(super) fn light(&mut self, record: usize, tokens: &Words<'a>) {
        let kind = RecordKind::Light;
        let line = self.line(kind, tokens, |id| Name::Known("light", id, ""));
        self.surplus(&line);
        let Some(id) = self.know(Category::Light, &line, self.lights.len()) else {
            return;
        };
        self.origins.lights.push(Place { record, kind, id });
        let said = line.gather().unwrap_or_default();
        let emitter = emitter(&said).unwrap_or_else(|| {
            // The position and the direction, after the type.
            let span = line.spans[1].to(line.spans[6]);
            self.report.error(|| {
                let message = format!("{} direction: must not be zero", line.name);
                Diagnostic::error(span, message, "where the light goes")
                    .with_hint("without a direction the light comes from its position's side")
            });
            Emitter::Ambient
        });
        self.lights.push(Light {
            emitter,
            colour: said.colours[0],
            scale: PI,
            shadows: match said.choices[1] {
                0 => Shadows::Cast,
                _ => Shadows::Off,
            },
        });
    }

    pub(super) fn material(&mut self, record: usize, tokens: &Words<'a>) {
        let kind = RecordKind::Material;
        let line = self.line(kind, tokens, |id| Name::Known("material", id, ""));
        self.surplus(&line);
        let Some(id) = self.know(Category::Material, &line, self.materials.len()) else {
            return;
        };
        self.origins.materials.push(Place { record, kind, id });
        let said = line.gather().unwrap_or_default();
        let [
            ambient,
            diffuse,
            specular,
            exponent,
            transmission,
            reflection,
            index,
            ..,
        ] = said.numbers;
        let colour = said.colours[0];
        let material = Coefficients {
            ambient: ambient * colour,
            diffuse: diffuse * colour,
            specular: specular * colour,
            exponent,
            reflection,
            transmission,
            index,
        };
        self.materials.push(material.into());
    }

    pub(super) fn texture(&mut self, record: usize, pattern: TextureKind, tokens: &Words<'a>) {
        let kind = RecordKind::Texture(pattern);
        let line = self.line(kind, tokens, |id| Name::Known("texture", id, ""));
        self.surplus(&line);
        let Some(id) = self.know(Category::Texture, &line, self.textures.len()) else {
            return;
        };
        self.origins.textures.push(Place { record, kind, id });
        let said = line.gather().unwrap_or_default();
        let file = line.word.map_or("", |word| word.of(self.text));
        let plain = |colour| Tinted {
            colour,
            texture: None,
        };
        let pattern = match pattern {
            TextureKind::Checker => Pattern::Checker {
                squares: [said.colours[0], said.colours[1]].map(plain),
                side: Side::One,
            },
            TextureKind::Image => Pattern::Image(file.to_owned()),
        };
        let repeat = DVec2::from_array(said.pair);
        self.textures.push(Texture::repeated(repeat, pattern));
    }

    pub(super) fn texture_use(&mut self, record: usize, purpose: UseKind, tokens: &Words<'a>) {
        let kind = RecordKind::Use(purpose);
        let line = self.line(kind, tokens, |id| Name::Known("use", id, ""));
        self.surplus(&line);
        let texture = line.references.first().copied().flatten();
        let texture = self.known(Category::Texture, texture);
        let material = line.references.get(1).copied().flatten();
        let material = self.known(Category::Material, material);
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
        let said = line.gather().unwrap_or_default();
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
                    maps.bump = Some(Bump {
                        texture,
                        height: said.numbers[0],
                    });
                }
            }
        }
    }
}

/// The emitter of a light; `None` for a distant light without direction.
fn emitter(said: &Gathered) -> Option<Emitter> {
    let [position, direction, _] = said.points;
    let [a0, a1, a2, exponent, ..] = said.numbers;
    Some(match said.choices[0] {
        0 => Emitter::Point {
            position,
            radius: 0.0,
            falloff: Falloff {
                radial: [a0, a1, a2],
                spot: normalise(direction)
                    .filter(|_| 0.0 < exponent)
                    .map(|direction| (direction, exponent)),
            },
        },
        1 => {
            let toward = normalise(direction).map(|direction| -direction);
            Emitter::Distant(toward.or_else(|| normalise(position))?)
        }
        _ => Emitter::Ambient,
    })
}
