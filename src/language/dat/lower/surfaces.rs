//! Lights, materials, textures, and what textures do to materials.

use std::collections::hash_map::Entry;

use glam::DVec2;

use super::Reader;
use crate::geometry::normalise;
use crate::language::dat::origins::{Place, UsePlace};
use crate::language::dat::table::{RecordKind, TextureKind, UseKind};
use crate::language::record::Gathered;
use crate::language::report::Name;
use crate::language::table::Category;
use crate::scene::{Falloff, Light, Pattern, Phong, Shadows, Source, Texture};
use crate::text::{Diagnostic, Span};

impl<'a> Reader<'a> {
    pub(super) fn light(&mut self, record: usize, tokens: &'a [Span]) {
        let kind = RecordKind::Light;
        let line = self.line(kind, tokens, |id| Name::Known("light", id, ""));
        self.surplus(&line);
        let Some(id) = self.know(Category::Light, &line, self.lights.len()) else {
            return;
        };
        self.origins.lights.push(Place { record, kind, id });
        let said = line.gather().unwrap_or_default();
        let source = source(&said).unwrap_or_else(|| {
            // Its position and its direction, after its source.
            let span = line.spans[1].to(line.spans[6]);
            self.report.error(|| {
                let message = format!("{} direction: must not be zero", line.name);
                Diagnostic::error(span, message, "where the light goes")
                    .with_hint("without a direction the light comes from its position's side")
            });
            Source::Everywhere
        });
        self.lights.push(Light {
            source,
            colour: said.colours[0],
            shadows: match said.choices[1] {
                0 => Shadows::Cast,
                _ => Shadows::Off,
            },
            radius: 0.0,
        });
    }

    pub(super) fn material(&mut self, record: usize, tokens: &'a [Span]) {
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
        self.materials.push(Phong {
            ambient: ambient * colour,
            diffuse: diffuse * colour,
            specular: specular * colour,
            exponent,
            reflection,
            transmission,
            index,
            ..Phong::default()
        });
    }

    pub(super) fn texture(&mut self, record: usize, pattern: TextureKind, tokens: &'a [Span]) {
        let kind = RecordKind::Texture(pattern);
        let line = self.line(kind, tokens, |id| Name::Known("texture", id, ""));
        self.surplus(&line);
        let Some(id) = self.know(Category::Texture, &line, self.textures.len()) else {
            return;
        };
        self.origins.textures.push(Place { record, kind, id });
        let said = line.gather().unwrap_or_default();
        let file = line.word.map_or("", |word| word.of(self.text));
        self.textures.push(Texture {
            repeat: DVec2::from_array(said.pair),
            pattern: match pattern {
                TextureKind::Checker => Pattern::Checker([said.colours[0], said.colours[1]]),
                TextureKind::Image => Pattern::Image(file.to_owned()),
            },
        });
    }

    pub(super) fn texture_use(&mut self, record: usize, purpose: UseKind, tokens: &'a [Span]) {
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
                self.warn_of_repetition(Some(before.record), tokens[1]);
            }
        }
        let said = line.gather().unwrap_or_default();
        if let Some(material) = self.materials.get_mut(material) {
            match purpose {
                UseKind::Colour => material.colour_texture = Some(texture as u32),
                UseKind::Bump => material.bump = Some((texture as u32, said.numbers[0])),
            }
        }
    }
}

/// Where a light's light comes from; `None` if a distant one comes from nowhere.
fn source(said: &Gathered) -> Option<Source> {
    let [position, direction, _] = said.points;
    let [a0, a1, a2, exponent, ..] = said.numbers;
    Some(match said.choices[0] {
        0 => Source::Point {
            position,
            falloff: Falloff {
                radial: [a0, a1, a2],
                spot: normalise(direction)
                    .filter(|_| 0.0 < exponent)
                    .map(|direction| (direction, exponent)),
            },
        },
        1 => {
            let toward = normalise(direction).map(|direction| -direction);
            Source::Distant(toward.or_else(|| normalise(position))?)
        }
        _ => Source::Everywhere,
    })
}
