//! Copied records, whose IDs must not be those of others.

use std::collections::{HashMap, HashSet};

use super::Language;
use super::identities::{self, Identity, identities, kind};
use super::lines::Lines;
use crate::StructureError;
use crate::schema::{Category, Makes, Record};
use crate::written::Parse;
use text::{Edit, apply, visible};

/// Records to insert, with IDs of their own.
#[derive(Debug)]
pub(super) struct Copies {
    /// The text with its new IDs.
    pub(super) text: String,
    /// The identities in all records, with those IDs.
    identities: Vec<Identity>,
    /// What each record makes, if it makes something.
    made: Vec<Category>,
}

impl Copies {
    /// Reads copied records and replaces the IDs that are taken, and references to them.
    ///
    /// # Errors
    ///
    /// Fails if there is no record, or one of a kind of which a scene has only one.
    pub(super) fn of<L: Language>(
        text: &str,
        taken: HashSet<(Category, i64)>,
    ) -> Result<Self, StructureError> {
        let lines = Lines::<L>::parse(text);
        let foreign = |reason: String| {
            let noun = L::SCHEMA.noun;
            let reason =
                format!("expected {noun}s of lights, materials, textures or objects{reason}");
            Err(StructureError::Foreign { reason })
        };
        if lines.records.is_empty() {
            return foreign(String::new());
        }
        let (mut records, mut made) = (Vec::new(), Vec::new());
        for record in 0..lines.records.len() {
            let tokens = lines.tokens(text, record);
            let kind = kind(L::SCHEMA, text, &tokens);
            made.extend(kind.ok().and_then(Record::category));
            let is_thing = kind.is_ok_and(|record| {
                record.category().is_some() || matches!(record.makes, Makes::Use(_) | Makes::State)
            });
            if !is_thing {
                let word = tokens.clone().next().unwrap_or_default();
                return foreign(format!(", not `{}`", visible(word.of(text))));
            }
            records.push(identities(L::SCHEMA, text, tokens));
        }
        let mut edits = renumber(&mut records, taken);
        Edit::sort(&mut edits);
        let mut text = text.to_owned();
        apply(&mut text, &edits);
        let identities = records.concat();
        Ok(Self {
            text,
            identities,
            made,
        })
    }

    fn defined(&self) -> impl Iterator<Item = &Identity> + Clone {
        self.identities.iter().filter(|own| own.is_definition)
    }

    /// What they all make; `None` if that differs.
    pub(super) fn category(&self) -> Option<Category> {
        if self.made.is_empty() && self.identities.is_empty() {
            // Commands that make an object together.
            return Some(Category::Object);
        }
        let (first, others) = self.made.split_first()?;
        others.iter().all(|other| other == first).then_some(*first)
    }

    /// The IDs that they refer to, and do not define.
    pub(super) fn used(&self) -> impl Iterator<Item = (Category, i64)> + '_ {
        let used = self
            .identities
            .iter()
            .filter(|own| !own.is_definition)
            .map(Identity::key);
        used.filter(|used| self.defined().all(|own| own.key() != *used))
    }

    /// The IDs of objects that no other of the copies combines.
    pub(super) fn results(&self) -> Vec<i64> {
        let used = self.identities.iter().filter(|own| !own.is_definition);
        let used: HashSet<_> = used.map(Identity::key).collect();
        let objects = self
            .defined()
            .filter(|own| own.category == Category::Object);
        objects
            .filter(|own| !used.contains(&own.key()))
            .map(|own| own.id)
            .collect()
    }
}

/// Gives the records new IDs where theirs are taken, by a record before or elsewhere.
fn renumber(records: &mut [Vec<Identity>], mut taken: HashSet<(Category, i64)>) -> Vec<Edit> {
    let all = records.iter().flatten().map(Identity::key);
    let mut greatest = Greatest::of(all.chain(taken.iter().copied()));
    let mut renamed = HashMap::new();
    let mut edits = Vec::new();
    for record in records {
        // A record refers to those before it.
        let (used, defined): (Vec<_>, Vec<_>) =
            record.iter_mut().partition(|own| !own.is_definition);
        for own in used.into_iter().chain(defined) {
            let is_new = !own.is_definition || taken.insert(own.key());
            if !is_new {
                renamed.insert(own.key(), greatest.next(own.category));
            }
            if let Some(&id) = renamed
                .get(&own.key())
                .filter(|_| !own.is_definition || !is_new)
            {
                edits.push(own.renamed(id));
                own.id = id;
            }
        }
    }
    edits
}

/// The greatest ID of each category.
struct Greatest([i64; 4]);

impl Greatest {
    fn of(all: impl Iterator<Item = (Category, i64)>) -> Self {
        let mut greatest = Self([0; 4]);
        for (category, id) in all {
            let known = &mut greatest.0[category as usize];
            *known = id.max(*known);
        }
        greatest
    }

    /// A new ID of a category, which becomes the greatest.
    fn next(&mut self, category: Category) -> i64 {
        let known = &mut self.0[category as usize];
        *known = known.saturating_add(1);
        *known
    }
}

/// Returns the edits that renumber what `text` defines in addition to `base`, where `theirs` defines
/// something else under the same ID in addition to it.
pub(super) fn set_apart<L: Language>(
    [text, base, theirs]: [&str; 3],
    lines: &Lines<L>,
) -> Vec<Edit> {
    let own = identities::all(text, lines);
    let defined = |all: &[(usize, Identity)]| -> HashSet<_> {
        let defined = all.iter().filter(|(_, own)| own.is_definition);
        defined.map(|(_, own)| own.key()).collect()
    };
    let other = |other: &str| defined(&identities::all(other, &Lines::<L>::parse(other)));
    let (mine, base, theirs) = (defined(&own), other(base), other(theirs));
    let both = mine.intersection(&theirs).filter(|key| !base.contains(key));
    let mut both: Vec<_> = both.copied().collect();
    both.sort_unstable_by_key(|&(category, id)| (category as usize, id));
    let mut greatest = Greatest::of(mine.iter().chain(&base).chain(&theirs).copied());
    let renamed = both.into_iter().map(|key| (key, greatest.next(key.0)));
    let renamed: HashMap<_, _> = renamed.collect();
    let edit = |(_, own): &(usize, Identity)| Some(own.renamed(*renamed.get(&own.key())?));
    own.iter().filter_map(edit).collect()
}
