//! The state that primitives and lights catch: the material, the attenuation, the transforms.

use std::collections::HashMap;

use glam::{DAffine3, DVec3};

use super::{Keys, Lowering};
use crate::cse167::schema::{
    AMBIENT, ATTENUATION, DIFFUSE, EMISSION, POP, PUSH, ROTATE, SCALE, SHININESS, SPECULAR,
    TRANSLATE,
};
use crate::engine::places::{NOWHERE, Place};
use crate::engine::reader::Reading;
use crate::form::rotation;
use crate::node::Node;
use crate::schema::{Category, Record};
use geometry::normalise;
use scene::{Gloss, Highlight, Material, Mirror, Rgb};
use text::{Diagnostic, Span};

/// The commands of a material, in the order of its fields.
pub(in crate::cse167) const MATERIAL: [&Record; 5] =
    [&AMBIENT, &DIFFUSE, &SPECULAR, &SHININESS, &EMISSION];

/// The values in force where no command states one; of the shininess only the first number counts.
pub(in crate::cse167) const DEFAULTS: [[f64; 3]; 5] =
    [[0.2; 3], [0.0; 3], [0.0; 3], [1.0; 3], [0.0; 3]];

/// The state at a place in the text.
#[derive(Clone, Debug)]
pub(super) struct State {
    /// The values of the material's commands; of the shininess only the first number counts.
    values: [Rgb; 5],
    /// The commands that state them.
    pub(super) stated: [Option<usize>; 5],
    /// The coefficients of the attenuation.
    pub(super) attenuation: [f64; 3],
    /// From the objects' space to the world.
    pub(super) transform: DAffine3,
    /// The transforms below, and where they were pushed.
    pub(super) pushed: Vec<(Span, DAffine3)>,
}

impl Default for State {
    fn default() -> Self {
        Self {
            values: DEFAULTS.map(Rgb::from_array),
            stated: [None; 5],
            attenuation: [1.0, 0.0, 0.0],
            transform: DAffine3::IDENTITY,
            pushed: Vec::new(),
        }
    }
}

/// The materials of the scene: one for each combination of commands in force.
#[derive(Debug, Default)]
pub(super) struct Materials {
    pub(super) all: Vec<Material>,
    pub(super) keys: Keys,
    /// The commands that state each.
    stated: Vec<[Option<usize>; 5]>,
}

impl Lowering<'_> {
    /// Reads a command of the state; returns whether it is one.
    pub(super) fn changes_state(&mut self, at: usize, head: Span, read: &Reading<'_>) -> bool {
        let record = read.record;
        if let Some(slot) = MATERIAL.iter().position(|known| *known == record) {
            if let Some(numbers) = read.numbers() {
                self.state.values[slot] = match *numbers {
                    [red, green, blue] => Rgb::new(red, green, blue),
                    _ => Rgb::splat(numbers[0].max(0.0)),
                };
                self.state.stated[slot] = Some(at);
            }
            return true;
        }
        let has_vector = [ATTENUATION, TRANSLATE, SCALE, ROTATE].contains(record);
        let vector = read.numbers().filter(|_| has_vector).map(DVec3::from_slice);
        if *record == ATTENUATION {
            self.state.attenuation = vector.map_or(self.state.attenuation, DVec3::into);
        } else if *record == PUSH {
            let transform = self.state.transform;
            self.reader.places.own.pushed.insert(at, transform);
            self.state.pushed.push((head, transform));
        } else if *record == POP {
            match self.state.pushed.pop() {
                Some((_, below)) => self.state.transform = below,
                None => self.reader.report.error(|| {
                    let message = "popTransform: there is no pushTransform left to undo";
                    Diagnostic::error(head, message, "as many as there are pushTransform above")
                }),
            }
        } else if *record == TRANSLATE {
            self.transform(vector.map(DAffine3::from_translation));
        } else if *record == SCALE {
            let zero = vector.and_then(|by| (0..3).find(|&axis| by[axis] == 0.0));
            if let Some(axis) = zero {
                self.reader.report.error(|| {
                    let message = format!("scale {}: must not be 0", ["x", "y", "z"][axis]);
                    Diagnostic::error(read.spans[axis], message, "a number other than 0")
                });
            } else {
                self.transform(vector.map(DAffine3::from_scale));
            }
        } else if *record == ROTATE {
            let Some((axis, numbers)) = vector.zip(read.numbers()) else {
                return true;
            };
            match normalise(axis) {
                Some(axis) => {
                    self.transform(Some(DAffine3::from_mat3(rotation(axis, numbers[3]))));
                }
                None => self.reader.report.error(|| {
                    let span = read.spans[0].to(read.spans[2]);
                    Diagnostic::error(span, "rotate axis: must not be zero", "an axis: x, y, z")
                }),
            }
        } else {
            return false;
        }
        true
    }

    fn transform(&mut self, by: Option<DAffine3>) {
        if let Some(by) = by {
            self.state.transform *= by;
        }
    }

    /// The index of the material in force.
    pub(super) fn material(&mut self) -> usize {
        let stated = self.state.stated;
        if let Some(&known) = self.materials.keys.get(&stated) {
            return known;
        }
        let [ambient, diffuse, specular, shininess, emission] = self.state.values;
        let index = self.materials.all.len();
        let gloss = Gloss {
            specular,
            exponent: shininess.x,
        };
        self.materials.all.push(Material {
            ambient: Some(ambient),
            diffuse,
            highlight: match specular {
                Rgb::ZERO => Highlight::None,
                _ => Highlight::PlainBlinn(gloss),
            },
            mirror: Mirror {
                tint: specular,
                ..Mirror::default()
            },
            emission,
            ..Material::BLACK
        });
        self.materials.stated.push(stated);
        self.materials.keys.insert(stated, index);
        index
    }

    /// Lists the materials, each with the commands that state it.
    pub(super) fn name_materials(&mut self) {
        for (index, stated) in self.materials.stated.iter().enumerate() {
            let of = |(record, at): (&&'static Record, &Option<usize>)| {
                Some(Place {
                    record,
                    at: (*at)?,
                    end: (*at)?,
                    id: 0,
                    refers: [Some(Node::Material(index)), None],
                })
            };
            let stated = MATERIAL.iter().zip(stated);
            let mut places: Vec<_> = stated.filter_map(of).collect();
            places.sort_unstable_by_key(|place| place.at);
            let mut places = places.into_iter();
            let first = places.next().unwrap_or(Place {
                record: &AMBIENT,
                at: NOWHERE,
                end: NOWHERE,
                id: 0,
                refers: [None; 2],
            });
            self.reader.places.push(Category::Material, first);
            self.reader.places.uses.extend(places);
        }
        let places = &mut self.reader.places;
        let mut inheritors = HashMap::new();
        let mut ends = vec![[usize::MAX, 0]; self.materials.stated.len()];
        for (object, place) in places.objects().iter().enumerate() {
            let Some(material) = place.of(Category::Material).next() else {
                continue;
            };
            let [first, last] = &mut ends[material];
            (*first, *last) = (object.min(*first), object);
            for command in self.materials.stated[material].into_iter().flatten() {
                *inheritors.entry(command).or_default() += 1;
            }
        }
        places.own.inheritors = inheritors;
        places.own.ends = ends;
        places.own.stated = std::mem::take(&mut self.materials.stated);
    }
}
