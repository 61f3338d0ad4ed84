//! Keys: values at frames, and the values between them.

use super::Easing;
use text::Span;

/// A value of a field or of a parameter of the camera.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// Numbers, one per component.
    Numbers(Vec<f64>),
    /// A word, such as the name of a material.
    Word(String),
}

impl Value {
    /// The number of its numbers; 1 of a word.
    pub(super) fn count(&self) -> usize {
        match self {
            Self::Numbers(numbers) => numbers.len(),
            Self::Word(_) => 1,
        }
    }

    /// The value a fraction of the way to another one, from 0 to below 1. Words stay.
    #[must_use]
    pub fn towards(&self, other: &Self, way: f64) -> Self {
        match (self, other) {
            (Self::Numbers(from), Self::Numbers(to)) => Self::Numbers(
                from.iter()
                    .zip(to)
                    .map(|(&from, &to)| between(from, to, way))
                    .collect(),
            ),
            _ => self.clone(),
        }
    }
}

/// A number a fraction of the way from one to another: exactly the first at 0, and never beyond
/// either.
fn between(from: f64, to: f64, way: f64) -> f64 {
    // Halved, because the difference of two large numbers may overflow.
    let half_way = way * (0.5 * to - 0.5 * from);
    if half_way == 0.0 {
        return from;
    }
    (from + half_way + half_way).clamp(from.min(to), from.max(to))
}

/// A value at a frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Key {
    /// The number of the frame.
    pub frame: u32,
    /// The value.
    pub value: Value,
    /// How it passes to the value of the next key.
    pub easing: Easing,
    /// The place of the value in the track file.
    pub span: Span,
}

/// Keys in ascending order of their frames; none if the file has errors in them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Keys(Vec<Key>);

impl Keys {
    /// Keys in ascending order; `None` if there are none, or their frames do not ascend.
    pub fn new(keys: Vec<Key>) -> Option<Self> {
        let ascend = keys.windows(2).all(|pair| pair[0].frame < pair[1].frame);
        (ascend && !keys.is_empty()).then_some(Self(keys))
    }

    /// The keys.
    pub fn iter(&self) -> impl Iterator<Item = &Key> {
        self.0.iter()
    }

    /// The easing that a new key at a frame takes over: that of the key before, or of the first.
    pub(super) fn easing_for(&self, frame: u32) -> Easing {
        let after = self.0.partition_point(|key| key.frame < frame);
        let neighbour = self.0.get(after.saturating_sub(1));
        neighbour.map(|key| key.easing).unwrap_or_default()
    }

    /// The value at a frame: that of a key at its frame, in between as the easing of the key before
    /// says; the first before all keys, and the last after them.
    pub fn at(&self, frame: u32) -> Value {
        let after = self.0.partition_point(|key| key.frame <= frame);
        let (before, after) = self.0.split_at(after);
        match (before.last(), after.first()) {
            (Some(from), Some(to)) => {
                let time = f64::from(frame - from.frame) / f64::from(to.frame - from.frame);
                from.value.towards(&to.value, from.easing.at(time))
            }
            (Some(key), None) | (None, Some(key)) => key.value.clone(),
            (None, None) => Value::Numbers(Vec::new()),
        }
    }

    /// The same keys with single numbers as words, which are not interpolated.
    #[must_use]
    pub(super) fn into_words(self) -> Self {
        let word = |key: Key| match &key.value {
            Value::Numbers(numbers) => {
                let value = Value::Word(numbers.iter().map(f64::to_string).collect());
                Key { value, ..key }
            }
            Value::Word(_) => key,
        };
        Self(self.0.into_iter().map(word).collect())
    }

    /// The numbers at a frame; none of words.
    pub fn numbers_at(&self, frame: u32) -> Vec<f64> {
        match self.at(frame) {
            Value::Numbers(numbers) => numbers,
            Value::Word(_) => Vec::new(),
        }
    }
}
