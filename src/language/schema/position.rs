//! Positions among the numbers of a record, by the names of the fields in its table.
//!
//! They are computed at compile time: the rows of a table may be in any order, and an unknown name
//! does not compile.

use glam::DVec3;

use super::Field;
use text::Span;

/// The position of a field's `N` numbers in its record.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct At<const N: usize> {
    first: usize,
}

impl<const N: usize> At<N> {
    /// The position after `first` other numbers.
    pub(super) const fn first(first: usize) -> Self {
        Self { first }
    }

    /// The position of a field after `first` other numbers.
    pub(crate) const fn after(first: usize, field: &Field) -> Self {
        assert!(
            field.kind.components() == N,
            "the field has so many numbers"
        );
        Self { first }
    }

    /// The same position in a record with `numbers` more numbers before.
    pub(crate) const fn later(self, numbers: usize) -> Self {
        Self {
            first: self.first + numbers,
        }
    }

    /// Reads the numbers.
    pub(crate) fn get(self, numbers: &[f64]) -> [f64; N] {
        std::array::from_fn(|component| numbers[self.first + component])
    }

    /// Writes the numbers.
    pub(crate) fn put(self, numbers: &mut [f64], values: [f64; N]) {
        numbers[self.first..self.first + N].copy_from_slice(&values);
    }

    /// The span from the first to the last token of the numbers.
    pub(crate) fn span(self, spans: &[Span]) -> Span {
        spans[self.first].to(spans[self.first + N - 1])
    }
}

impl At<1> {
    /// Reads the number.
    pub(crate) fn number(self, numbers: &[f64]) -> f64 {
        numbers[self.first]
    }

    /// The index of the number in its record.
    pub(crate) const fn index(self) -> usize {
        self.first
    }

    /// Reads the meaning of the chosen word.
    pub(crate) fn choice<T: Copy>(self, numbers: &[f64], choices: &[(&str, T)]) -> T {
        choices[numbers[self.first] as usize].1
    }

    /// Writes the word with this meaning.
    pub(crate) fn choose<T: Copy + PartialEq>(
        self,
        numbers: &mut [f64],
        choices: &[(&str, T)],
        meaning: T,
    ) {
        let index = choices.iter().position(|choice| choice.1 == meaning);
        numbers[self.first] = index.expect("every meaning has a word") as f64;
    }
}

impl At<3> {
    /// Reads the vector.
    pub(crate) fn vector(self, numbers: &[f64]) -> DVec3 {
        DVec3::from_array(self.get(numbers))
    }
}

/// The words of a choice, without their meanings.
pub(crate) const fn words<T, const N: usize>(
    choices: &[(&'static str, T); N],
) -> [&'static str; N] {
    let mut words = [""; N];
    let mut at = 0;
    while at < N {
        words[at] = choices[at].0;
        at += 1;
    }
    words
}

/// Whether two keys are equal.
pub(crate) const fn is_same(one: &str, other: &str) -> bool {
    let (one, other) = (one.as_bytes(), other.as_bytes());
    let mut at = 0;
    while at < one.len() && at < other.len() && one[at] == other[at] {
        at += 1;
    }
    at == one.len() && at == other.len()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::schema::slots::{colour, point, share};
    use crate::schema::{Makes, Record};

    #[test]
    fn fields_are_found_by_their_keys() {
        const RECORD: Record = Record::new(
            "thing",
            &[],
            Makes::View,
            &[point("eye", ""), share("e", ""), colour("colour", "")],
        );
        let mut numbers = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0];
        let (size, colour) = const { (RECORD.at("e"), RECORD.at::<3>("colour")) };
        assert_eq!(size.number(&numbers), 4.0);
        assert_eq!(colour.vector(&numbers), DVec3::new(5.0, 6.0, 7.0));
        const { RECORD.at::<3>("eye") }.put(&mut numbers, [0.0; 3]);
        assert_eq!(numbers, [0.0, 0.0, 0.0, 4.0, 5.0, 6.0, 7.0]);
        let spans: Vec<_> = (0..7).map(|at| Span::new(at, at + 1)).collect();
        assert_eq!(colour.span(&spans), Span::new(4, 7));
    }
}
