//! The rows of the list: which nodes it shows, by a filter and by the groups that are folded.

use std::collections::{BTreeSet, HashMap};

use crate::listing::Listing;
use crate::matching::{self, Searched};
use language::{Node, Source};

/// The most rows among which misspelt words are looked for: so many take no time between two keys.
const GUESSED: usize = 5000;

/// Which groups are folded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fold {
    /// The selected one as well.
    Selected,
    /// Not the selected one.
    Unselected,
    /// All.
    All,
    /// None.
    None,
}

/// Which nodes the list shows: all, unless some are filtered out or folded away.
#[derive(Debug, Default)]
pub struct Rows {
    /// Only nodes called so, in lower case, are shown, with the groups that hold them; empty shows
    /// all. Groups are unfolded meanwhile.
    filter: String,
    /// The rows that match the filter, ascending.
    matches: Vec<usize>,
    /// The folded objects.
    folded: BTreeSet<usize>,
    /// Their names, by which they are found again in another text.
    names: BTreeSet<(String, usize)>,
    /// The rows shown, ascending; `None` if all are.
    shown: Option<Vec<usize>>,
}

impl Rows {
    /// What the list is filtered by, in lower case; empty if it is not.
    pub fn filter(&self) -> &str {
        &self.filter
    }

    /// The number of rows that match the filter.
    pub fn matches(&self) -> usize {
        self.matches.len()
    }

    /// Whether an object is folded and the list shows it so.
    pub fn is_folded(&self, object: usize) -> bool {
        self.filter.is_empty() && self.folded.contains(&object)
    }

    /// The lines of the list.
    pub fn listing(&self, source: &Source) -> Listing<'_> {
        Listing::new(source.nodes(), self.shown.as_deref())
    }

    /// Whether the list shows a row.
    pub(crate) fn shows(&self, row: usize) -> bool {
        let shown = self.shown.as_ref();
        shown.is_none_or(|shown| shown.binary_search(&row).is_ok())
    }

    /// The place of a row among those shown, or of the next one that is.
    pub fn place_of(&self, row: usize) -> usize {
        let shown = self.shown.as_ref();
        shown.map_or(row, |shown| shown.partition_point(|&other| other < row))
    }

    /// The row at a place.
    pub(crate) fn at(&self, place: usize, source: &Source) -> Option<usize> {
        match &self.shown {
            Some(shown) => shown.get(place).copied(),
            None => (place < source.nodes().len()).then_some(place),
        }
    }

    /// The number of rows shown.
    pub fn count(&self, source: &Source) -> usize {
        let shown = self.shown.as_ref();
        shown.map_or_else(|| source.nodes().len(), Vec::len)
    }

    /// The nearest row to one that is not shown, preferably below it; `None` if none is shown.
    pub(crate) fn nearest(&self, row: usize, source: &Source) -> Option<usize> {
        let place = self.place_of(row);
        let before = || self.at(place.checked_sub(1)?, source);
        self.at(place, source).or_else(before)
    }

    /// The first match from a row on, otherwise the first of all.
    pub(crate) fn match_from(&self, row: usize) -> Option<usize> {
        let at = self.matches.partition_point(|&other| other < row);
        self.matches
            .get(at)
            .or_else(|| self.matches.first())
            .copied()
    }

    /// The index of a row among the matches.
    pub(crate) fn match_at(&self, row: usize) -> Option<usize> {
        self.matches.binary_search(&row).ok()
    }

    /// The rows that are called so: those that match the filter if it is the same.
    pub(crate) fn called(&self, words: &str, source: &Source) -> Vec<usize> {
        if words == self.filter {
            return self.matches.clone();
        }
        rows_called(source, words, None)
    }

    /// Shows only nodes whose name or comment contains these words; if there is none, those that they may
    /// mean.
    pub(crate) fn filter_by(&mut self, words: &str, source: &Source) {
        let words = words.to_lowercase();
        let narrows = !self.filter.is_empty() && words.contains(&self.filter);
        self.matches = if words.is_empty() {
            Vec::new()
        } else {
            rows_called(source, &words, narrows.then_some(&self.matches))
        };
        self.filter = words;
        self.show(source);
    }

    /// Folds or unfolds objects.
    pub(crate) fn fold(&mut self, folded: BTreeSet<usize>, source: &Source) {
        let named = |(object, name)| folded.contains(&object).then_some(name);
        self.names = if folded.is_empty() {
            BTreeSet::new()
        } else {
            foldable(source).into_iter().filter_map(named).collect()
        };
        self.folded = folded;
        self.show(source);
    }

    /// The folded objects.
    pub(crate) fn folded(&self) -> &BTreeSet<usize> {
        &self.folded
    }

    /// Adapts to another text.
    pub(crate) fn renew(&mut self, source: &Source) {
        if !self.names.is_empty() {
            let found = |(object, name)| self.names.contains(&name).then_some(object);
            self.folded = foldable(source).into_iter().filter_map(found).collect();
        }
        if !self.filter.is_empty() {
            self.matches = rows_called(source, &self.filter, None);
        }
        self.show(source);
    }

    fn show(&mut self, source: &Source) {
        let nodes = source.nodes();
        self.shown = if !self.filter.is_empty() {
            Some(with_groups(&self.matches, source))
        } else if !self.folded.is_empty() {
            let first = nodes.before(Node::Object(0));
            let objects = source.unfolded(&self.folded).into_iter();
            let objects = objects.map(|object| first + object);
            Some((0..first).chain(objects).collect())
        } else {
            None
        };
    }
}

/// The rows whose name or comment contains these words, ascending; if there is none in a list that is not
/// huge, those that the words may mean.
fn rows_called(source: &Source, words: &str, among: Option<&[usize]>) -> Vec<usize> {
    let found = source.rows_called(words, among);
    let nodes = source.nodes();
    if !found.is_empty() || GUESSED < nodes.len() {
        return found;
    }
    let names = (0..nodes.len()).filter_map(|row| {
        let node = nodes.get(row)?;
        Some((row, source.name(node), source.comment(node).unwrap_or("")))
    });
    let names: Vec<_> = names.collect();
    let texts = names.iter().map(|(row, name, words)| {
        let text = Searched {
            name,
            words,
            ..Searched::default()
        };
        (text, *row)
    });
    let meant = matching::ranked(texts, words).into_iter();
    let mut meant: Vec<_> = meant.map(|(_, row)| row).collect();
    meant.sort_unstable();
    meant
}

/// The objects that can be folded, each with its name and a number that tells it from those of the
/// same name before it.
pub(crate) fn foldable(source: &Source) -> Vec<(usize, (String, usize))> {
    let mut names: HashMap<String, usize> = HashMap::new();
    let objects = (0..source.nodes().objects()).filter(|&object| source.is_foldable(object));
    let named = objects.map(|object| {
        let name = source.called(Node::Object(object)).unwrap_or_default();
        let number = names.entry(name.to_owned()).or_default();
        *number += 1;
        (object, (name.to_owned(), *number))
    });
    named.collect()
}

/// These rows and those of the groups that hold them, ascending.
fn with_groups(rows: &[usize], source: &Source) -> Vec<usize> {
    let nodes = source.nodes();
    let mut all: BTreeSet<usize> = BTreeSet::new();
    for &row in rows {
        let Some(node @ Node::Object(object)) = nodes.get(row) else {
            continue;
        };
        if 0 < source.depth(node) {
            let groups = source.groups_of(object);
            let mut groups = groups.map(|group| nodes.before(Node::Object(group)));
            // The groups of a group that is known are known as well.
            groups.find(|&group| !all.insert(group));
        }
    }
    if all.is_empty() {
        return rows.to_vec();
    }
    all.extend(rows);
    all.into_iter().collect()
}
