//! The record that lists the objects that are drawn.

use std::collections::HashSet;

use super::{Language, Source};
use crate::Visibility;
use crate::schema::{Makes, Record, Slot};
use crate::view::line_ending;
use text::{Edit, Span};

const LAST: &str = "the last visible object cannot be hidden";

/// A record that lists objects.
pub(super) struct Listing {
    count: Span,
    /// From the first to the last token of each, as many as the record states.
    entries: Vec<Span>,
}

impl<L: Language> Source<L> {
    /// Returns the edits that show or hide objects, by index, and leave all others as they are.
    ///
    /// # Errors
    ///
    /// Fails with the reason if no text can express that.
    pub(super) fn shown_or_hidden(
        &self,
        objects: &[usize],
        wanted: Visibility,
    ) -> Result<Vec<Edit>, &'static str> {
        if !L::SCHEMA
            .records
            .iter()
            .any(|record| record.makes == Makes::List)
        {
            return Err("this language cannot hide objects");
        }
        let (text, origins) = (&*self.text, &self.origins);
        let objects: HashSet<_> = objects.iter().copied().collect();
        let is_drawn = |object: &usize| origins.drawn.binary_search(object).is_ok();
        let is_wanted = |object: &usize| {
            if objects.contains(object) {
                wanted == Visibility::Shown
            } else {
                is_drawn(object)
            }
        };
        let drawn: Vec<_> = (0..origins.objects().len()).filter(is_wanted).collect();
        if drawn == origins.drawn {
            return Ok(Vec::new());
        }
        if drawn.is_empty() {
            return Err(LAST);
        }
        let id = |object: usize| origins.objects()[object].id;
        if let Some(listing) = self.listing() {
            let new = drawn.iter().filter(|object| !is_drawn(object));
            let new: Vec<_> = new.map(|&object| id(object)).collect();
            let gone = origins.drawn.iter().filter(|object| !is_wanted(object));
            let gone: HashSet<_> = gone.map(|&object| id(object)).collect();
            let edits = listing.exchanged::<L>(text, |id| gone.contains(&id), &new);
            return edits.ok_or(LAST);
        }
        let listed: String = drawn.iter().map(|&object| entry::<L>(id(object))).collect();
        let listed = format!("{}{listed}", drawn.len());
        let count = origins
            .list
            .and_then(|at| self.tree.tokens(text, at).nth(1));
        if let Some(span) = count {
            return Ok(vec![Edit { span, text: listed }]);
        }
        let (word, end) = (list::<L>().heads[0], line_ending(text));
        let line = if text.is_empty() || text.ends_with(['\n', '\r']) {
            format!("{word} {listed}{end}")
        } else {
            format!("{end}{word} {listed}")
        };
        let span = Span::at(text.len());
        Ok(vec![Edit { span, text: line }])
    }

    /// The list of the text; `None` if it lists no objects.
    pub(super) fn listing(&self) -> Option<Listing> {
        let text = &*self.text;
        let tokens: Vec<_> = self.tree.tokens(text, self.origins.list?).collect();
        let (&[_, count], entries) = tokens.split_first_chunk()?;
        let stated = count.of(text).parse().unwrap_or(0);
        let each = entry::<L>(0).split_whitespace().count();
        let entries = entries.chunks_exact(each).take(stated);
        let entries: Vec<_> = entries.map(|entry| entry[0].to(entry[each - 1])).collect();
        (!entries.is_empty()).then_some(Listing { count, entries })
    }
}

/// The record that lists objects, in a language that has one.
fn list<L: Language>() -> &'static Record {
    let mut records = L::SCHEMA.records.iter();
    records
        .find(|record| record.makes == Makes::List)
        .expect("only a language with lists can ask")
}

/// An entry of a list, after a blank.
fn entry<L: Language>(id: i64) -> String {
    let slots = list::<L>().repeat.map_or(&[][..], |repeat| repeat.slots);
    let words = slots.iter().map(|slot| match slot {
        Slot::Word(word) => (*word).to_owned(),
        Slot::Id | Slot::Field(_) => id.to_string(),
    });
    words.fold(String::new(), |entry, word| entry + " " + &word)
}

impl Listing {
    /// The edits that remove objects, each with the white space before it, and add others; `None`
    /// if none would be listed.
    pub(super) fn exchanged<L: Language>(
        &self,
        text: &str,
        goes: impl Fn(i64) -> bool,
        ids: &[i64],
    ) -> Option<Vec<Edit>> {
        let edit = |span, text| Edit { span, text };
        let id = |entry: Span| {
            let id = entry.of(text).split_whitespace().next_back();
            id.and_then(|id| id.parse().ok())
        };
        let before = std::iter::once(self.count).chain(self.entries.iter().copied());
        let gone = before
            .zip(&self.entries)
            .filter(|(_, entry)| id(**entry).is_some_and(&goes));
        let cut = |(before, entry): (Span, &Span)| Span::new(before.end(), entry.end());
        let mut edits: Vec<_> = gone.map(|pair| edit(cut(pair), String::new())).collect();
        let left = self.entries.len() - edits.len() + ids.len();
        if !ids.is_empty() {
            let end = self.entries.last().map_or(self.count, |entry| *entry);
            let listed = ids.iter().map(|&id| entry::<L>(id)).collect();
            edits.push(edit(Span::at(end.end()), listed));
        }
        if !edits.is_empty() {
            edits.insert(0, edit(self.count, left.to_string()));
        }
        (0 < left).then_some(edits)
    }
}
