//! Telling apart what two texts made from the same one each add under the same ID, and counts after
//! they are merged.

use std::collections::{HashMap, HashSet};

use super::copies::Identity;
use super::tree::{self, Tree};
use crate::table::Category;
use text::{Edit, Span};

/// Returns the edits that renumber what `text` defines in addition to `base`, where `theirs` defines
/// something else under the same ID in addition to it.
pub(super) fn set_apart(text: &str, tree: &Tree, base: &str, theirs: &str) -> Vec<Edit> {
    let own = identities(text, tree);
    let [base, theirs] =
        [base, theirs].map(|other| defined(&identities(other, &tree::parse(other))));
    let mine = defined(&own);
    let both = mine.intersection(&theirs).filter(|key| !base.contains(key));
    let mut both: Vec<_> = both.copied().collect();
    both.sort_unstable_by_key(|&(category, id)| (category as usize, id));
    let greatest = |category| {
        let all = mine.iter().chain(&base).chain(&theirs);
        let ids = all.filter(|(of, _)| *of == category).map(|&(_, id)| id);
        ids.max().unwrap_or(0).max(0)
    };
    let mut next: HashMap<Category, i64> = HashMap::new();
    let renamed = both.into_iter().map(|(category, id)| {
        let next = next.entry(category).or_insert_with(|| greatest(category));
        *next = next.saturating_add(1);
        ((category, id), *next)
    });
    let renamed: HashMap<_, _> = renamed.collect();
    let edit = |identity: &Identity| {
        let id = renamed.get(&(identity.category, identity.id))?;
        Some(Edit {
            span: identity.span,
            text: id.to_string(),
        })
    };
    own.iter().filter_map(edit).collect()
}

/// Returns the edits that make the counts of `render` records agree with what they list.
pub(super) fn recount(text: &str, tree: &Tree) -> Vec<Edit> {
    let records = 0..tree.records.len();
    let counts = records.filter_map(|record| {
        let mut tokens = tree.tokens_of(text, record);
        if tokens.next()?.of(text) != "render" {
            return None;
        }
        let count = tokens.next()?;
        let stated: usize = count.of(text).parse().ok()?;
        let listed: Vec<Span> = tokens.collect();
        let is_list = listed.chunks(2).all(|entry| match entry {
            [word, id] => word.of(text) == "ID" && id.of(text).parse::<i64>().is_ok(),
            _ => false,
        });
        let listed = listed.len() / 2;
        // 0 stands for all objects.
        (is_list && 0 < listed && stated != listed).then(|| Edit {
            span: count,
            text: listed.to_string(),
        })
    });
    counts.collect()
}

fn identities(text: &str, tree: &Tree) -> Vec<Identity> {
    let records = 0..tree.records.len();
    records
        .flat_map(|record| Identity::all(text, tree.tokens_of(text, record)))
        .collect()
}

fn defined(identities: &[Identity]) -> HashSet<(Category, i64)> {
    let defined = identities.iter().filter(|own| own.is_definition);
    defined.map(|own| (own.category, own.id)).collect()
}
