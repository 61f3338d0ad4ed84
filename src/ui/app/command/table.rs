//! Tables of help: keys and what they do, in columns that hold their place.

use unicode_width::UnicodeWidthStr;

use crate::keymap::{HelpEntry, Topic};

/// The gap between keys and words, and that between columns.
const GAP: usize = 2;
const BETWEEN: usize = 3;

/// The narrowest room for words beside keys.
const LEAST_WORDS: usize = 16;

/// The widest room for them beside other columns: longer ones take more lines.
const MOST_WORDS: usize = 44;

/// The most columns of a table.
const MOST_COLUMNS: usize = 4;

/// A line of the help page.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct HelpLine {
    /// What stands in it, from left to right.
    pub(crate) parts: Vec<Part>,
}

/// A text in a line of the help page.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Part {
    /// The column it begins at.
    pub(crate) at: usize,
    /// What it says.
    pub(crate) text: String,
    /// What it is.
    pub(crate) kind: PartKind,
}

/// What a text of the help page is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum PartKind {
    /// What the lines below are about.
    Heading,
    /// Keys, or something else to be typed.
    Keys,
    /// A description.
    Words,
    /// A note beside it.
    Note,
}

impl HelpLine {
    fn put(&mut self, at: usize, text: &str, kind: PartKind) {
        let text = text.to_owned();
        self.parts.push(Part { at, text, kind });
    }

    fn heading(text: &str) -> Self {
        let mut line = Self::default();
        line.put(0, text, PartKind::Heading);
        line
    }
}

/// The entries that are used most, as many as `rows` lines hold with their heading.
pub(super) fn card(
    heading: &str,
    entries: &[HelpEntry],
    width: usize,
    rows: usize,
) -> Vec<HelpLine> {
    let room = rows.saturating_sub(1);
    let counts = 1..=MOST_COLUMNS;
    let tables = counts.filter_map(|count| {
        let shown = entries.len().min(count * room);
        Table::new(&entries[..shown], width, count)
    });
    let tables: Vec<_> = tables.collect();
    let whole = tables
        .iter()
        .position(|table| table.holds(entries.len(), room));
    let best = whole.map_or_else(|| tables.last(), |at| tables.get(at));
    let mut lines = vec![HelpLine::heading(heading)];
    lines.extend(best.into_iter().flat_map(|table| table.filled(room)));
    lines
}

/// All entries of a topic under its heading, in as many columns as have room for whole lines.
pub(super) fn topic(topic: &Topic, width: usize) -> Vec<HelpLine> {
    let mut lines = vec![HelpLine::heading(topic.heading)];
    let natural = keys_width(&topic.entries) + GAP + words_width(&topic.entries);
    let count = ((width + BETWEEN) / (natural + BETWEEN)).clamp(1, MOST_COLUMNS);
    let rows = topic.entries.len().div_ceil(count);
    if let Some(table) = Table::new(&topic.entries, width, count) {
        lines.extend(table.filled(if count == 1 { usize::MAX } else { rows }));
    }
    lines
}

/// What answers a search, one below the other, each with its topic at the end of its line.
pub(super) fn results(found: &[(HelpEntry, &'static str)], width: usize) -> Vec<HelpLine> {
    let entries: Vec<_> = found.iter().map(|(entry, _)| entry.clone()).collect();
    let notes = found.iter().map(|(_, topic)| topic.width()).max();
    let room = width.saturating_sub(notes.unwrap_or(0) + GAP);
    // Where there is no room for both, the topics are left out.
    let has_notes = keys_width(&entries).min(room / 2) + 2 * LEAST_WORDS < room;
    let Some(table) = Table::new(&entries, if has_notes { room } else { width }, 1) else {
        return Vec::new();
    };
    let mut lines = Vec::new();
    for ((_, topic), mut entry) in found.iter().zip(table.each()) {
        if let Some(first) = entry.first_mut().filter(|_| has_notes) {
            first.put(room + GAP, topic, PartKind::Note);
        }
        lines.extend(entry);
    }
    lines
}

/// A sentence, in as many lines as it needs.
pub(super) fn paragraph(text: &str, width: usize) -> Vec<HelpLine> {
    let lines = wrapped(text, width).into_iter().map(|text| {
        let mut line = HelpLine::default();
        line.put(0, &text, PartKind::Words);
        line
    });
    lines.collect()
}

/// Entries in columns of equal width.
struct Table<'e> {
    entries: &'e [HelpEntry],
    count: usize,
    /// The widths of the keys and of the words of each column.
    keys: usize,
    words: usize,
}

impl<'e> Table<'e> {
    /// A table of so many columns; `None` if they have no room for words.
    fn new(entries: &'e [HelpEntry], width: usize, count: usize) -> Option<Self> {
        let room = ((width + BETWEEN) / count).saturating_sub(BETWEEN);
        let keys = keys_width(entries).min(room * 2 / 5);
        let words = room.saturating_sub(keys + GAP);
        let most = if count == 1 { width } else { MOST_WORDS };
        let words = words.min(words_width(entries)).min(most);
        (count == 1 || LEAST_WORDS <= words).then_some(Self {
            entries,
            count,
            keys,
            words: words.max(1),
        })
    }

    /// Whether columns of so many lines hold so many entries.
    fn holds(&self, entries: usize, rows: usize) -> bool {
        let taken: usize = self.columns(rows).iter().map(Vec::len).sum();
        entries == taken
    }

    /// The entries in each column of so many lines, from the first one on.
    fn columns(&self, rows: usize) -> Vec<Vec<Vec<HelpLine>>> {
        let mut left = self.each().peekable();
        let columns = (0..self.count).map(|_| {
            let mut used = 0;
            let mut column = Vec::new();
            while let Some(entry) = left.next_if(|entry| used + entry.len() <= rows) {
                used += entry.len();
                column.push(entry);
            }
            column
        });
        columns.collect()
    }

    /// The lines of columns of so many lines.
    fn filled(&self, rows: usize) -> Vec<HelpLine> {
        let mut lines: Vec<HelpLine> = Vec::new();
        let each = self.keys + GAP + self.words + BETWEEN;
        for (column, entries) in self.columns(rows).into_iter().enumerate() {
            for (index, line) in entries.into_iter().flatten().enumerate() {
                if lines.len() <= index {
                    lines.push(HelpLine::default());
                }
                let moved = line.parts.into_iter().map(|part| Part {
                    at: column * each + part.at,
                    ..part
                });
                lines[index].parts.extend(moved);
            }
        }
        lines
    }

    /// The lines of each entry, at the left.
    fn each(&self) -> impl Iterator<Item = Vec<HelpLine>> {
        self.entries.iter().map(|entry| {
            let keys = wrapped(&entry.keys, self.keys);
            let words = wrapped(&entry.words, self.words);
            let count = keys.len().max(words.len());
            let mut lines = vec![HelpLine::default(); count];
            for (line, text) in lines.iter_mut().zip(&keys) {
                line.put(0, text, PartKind::Keys);
            }
            for (line, text) in lines.iter_mut().zip(&words) {
                line.put(self.keys + GAP, text, PartKind::Words);
            }
            lines
        })
    }
}

fn keys_width(entries: &[HelpEntry]) -> usize {
    entries
        .iter()
        .map(|entry| entry.keys.width())
        .max()
        .unwrap_or(0)
}

fn words_width(entries: &[HelpEntry]) -> usize {
    entries
        .iter()
        .map(|entry| entry.words.width())
        .max()
        .unwrap_or(0)
}

/// A text in lines of a width, broken at blanks; what has none is cut.
fn wrapped(text: &str, width: usize) -> Vec<String> {
    let mut lines: Vec<String> = vec![String::new()];
    for word in text.split(' ') {
        let last = lines.last_mut().expect("there is a first line");
        if last.is_empty() {
            last.push_str(word);
        } else if last.width() + 1 + word.width() <= width {
            last.push(' ');
            last.push_str(word);
        } else {
            lines.push(word.to_owned());
        }
    }
    lines
}
