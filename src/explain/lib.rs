//! Puts into words why a pixel has its colour: the verdicts as sentences, the tree of rays as lines,
//! with the names and places of the text.
//!
//! [`render`] records and judges a sample in numbers; here objects and lights get
//! their names back, and what the text holds but the picture does not is looked for. Words and
//! structure are kept apart from printing: the lines of the tree are the same everywhere; texts write
//! [all](words) of them out, the interface those of light in [few words](label), with their values.

mod cause;
mod labels;
mod lines;
mod names;
mod parting;
mod sentences;
#[cfg(test)]
mod tests;
mod tree;
mod undrawn;
pub mod wording;

use glam::DVec3;

use language::{Node, Source};
use render::Explanation;
use scene::{Camera, Rgb, Scene, Size};

use names::Names;

pub use cause::{cause, fault};
pub use labels::{Value, label, values};
pub use lines::{RayLine, RayPart, is_foldable, lines};
pub use names::{number, numbers};
pub use parting::parting;
pub use wording::{Wording, unlit};

/// What an explanation is about.
#[derive(Clone, Copy, Debug)]
pub struct Subject<'s> {
    /// The text of the scene, lowered.
    pub source: &'s Source,
    /// The scene that the text means.
    pub scene: &'s Scene,
    /// The camera by which the sample was traced.
    pub camera: &'s Camera,
    /// The size of the whole picture.
    pub size: Size,
}

/// An explanation in words.
#[derive(Clone, Debug, PartialEq)]
pub struct Words {
    /// The verdicts, the best first; never empty.
    pub verdicts: Vec<Sentence>,
    /// The tree of rays.
    pub lines: Vec<Line>,
}

/// A verdict in words.
#[derive(Clone, Debug, PartialEq)]
pub struct Sentence {
    /// The name of the kind of verdict, one of [`VERDICTS`].
    pub name: &'static str,
    /// What is the case, without a full stop.
    pub text: String,
    /// What would change it.
    pub help: Option<String>,
    /// What it is about, to be selected.
    pub node: Option<Node>,
    /// The place of that, or of the field that would help.
    pub place: Option<Place>,
    /// Index of the ray at whose end it was found.
    pub ray: usize,
}

/// A line of the tree of rays.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// How far it is indented; the camera ray is 0.
    pub depth: usize,
    /// Its words.
    pub text: String,
    /// What it adds to the sample, if it adds anything of its own.
    pub adds: Option<Rgb>,
    /// The object, light or material it is about.
    pub node: Option<Node>,
    /// The place of that in the text.
    pub place: Option<Place>,
    /// Index of the ray it belongs to.
    pub ray: usize,
    /// The way of the light, to be drawn: the ray, or from a surface to a light.
    pub segment: Option<[DVec3; 2]>,
}

/// A place in the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    /// The line, from 1.
    pub line: usize,
    /// The column, from 1.
    pub column: usize,
    /// The field there.
    pub field: Option<&'static str>,
}

/// The names of all kinds of verdicts.
pub const VERDICTS: [&str; 29] = [
    "not-drawn",
    "no-objects",
    "missed",
    "clipped-near",
    "clipped-far",
    "inside",
    "missing-texture",
    "not-finite",
    "too-bright",
    "underexposed",
    "black",
    "depth",
    "budget",
    "total-reflection",
    "no-lights",
    "switched-off",
    "enclosed",
    "shadow",
    "outside-cone",
    "faces-away",
    "facet",
    "at-the-light",
    "attenuated",
    "dim",
    "not-reflected",
    "unlit-side",
    "no-ambient",
    "no-material",
    "ordinary",
];

/// Puts an explanation into words.
pub fn words(explanation: &Explanation, subject: &Subject<'_>) -> Words {
    Words {
        verdicts: verdicts(explanation, subject),
        lines: tree::lines(explanation, &Names::new(subject)),
    }
}

/// The verdicts in words, the best first; never empty. Looking for objects that are not drawn lowers
/// the text again, if it has any.
pub fn verdicts(explanation: &Explanation, subject: &Subject<'_>) -> Vec<Sentence> {
    let names = Names::new(subject);
    let mut verdicts = sentences::sentences(explanation, &names);
    if let Some(undrawn) = undrawn::undrawn(explanation, subject, &names) {
        verdicts.insert(0, undrawn);
    }
    verdicts
}
