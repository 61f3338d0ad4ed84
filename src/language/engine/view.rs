//! The records of the view, where a camera is written into a text.

use super::{Language, Source};
use crate::field_spans::FieldSpans;
use crate::schema::Record;
use crate::view::{beginning, line_ending, literals, respelled};
use scene::Camera;
use text::{Edit, Span};

impl<L: Language> Source<L> {
    /// The records of the view with their indices, if the text has them.
    fn view(&self) -> impl Iterator<Item = (&'static Record, Option<usize>)> {
        let known = self
            .origins
            .view
            .iter()
            .copied()
            .chain(std::iter::repeat(None));
        L::SCHEMA.view().zip(known)
    }

    /// The fields of the view's records, without places if their record is missing.
    pub(super) fn view_places(&self) -> Vec<FieldSpans> {
        let fields = self.view().flat_map(|(record, at)| {
            let missing = |field| FieldSpans::explicit(field, Vec::new());
            at.map_or_else(
                || record.fields().map(missing).collect(),
                |at| super::places::fields(&self.text, &self.tree, (at, record)),
            )
        });
        fields.collect()
    }

    /// Returns the edits that change the text's camera from `before` to `camera`.
    pub(super) fn camera_edits(&self, before: &Camera, camera: &Camera) -> Vec<Edit> {
        let text = &*self.text;
        let [old, new] = [before, camera].map(|camera| L::view_numbers(self, camera));
        let mut edits = respelled(text, &self.view_places(), [&old, &new]);
        let mut missing = String::new();
        let (mut old, mut new) = (&old[..], &new[..]);
        for (record, at) in self.view() {
            let (own, behind) = old.split_at(record.numbers());
            let (changed, rest) = new.split_at(record.numbers());
            (old, new) = (behind, rest);
            let follows = L::follows_lens(record) && before.lens != camera.lens;
            if at.is_none() && (own != changed || follows) {
                missing.push_str(&spelled(record, changed));
                missing.push_str(line_ending(text));
            }
        }
        if !missing.is_empty() {
            edits.push(Edit {
                span: Span::at(beginning(text)),
                text: missing,
            });
        }
        Edit::sort(&mut edits);
        edits
    }
}

/// A whole record in default style.
fn spelled(record: &'static Record, numbers: &[f64]) -> String {
    let fields: Vec<_> = record.fields().collect();
    let parts = literals(&fields, numbers).into_iter();
    let parts: Vec<_> = parts.map(|part| part.join(" ")).collect();
    format!("{} {}", record.heads.join(" "), parts.join("  "))
}
