//! Copied records of `.dat`, whose IDs must not be those of others.

use std::collections::{HashMap, HashSet};

use super::table::{Heads, Part, RECORDS, RecordKind, TextureKind};
use super::tree::{self, Tree};
use crate::StructureError;
use crate::table::{Category, Kind};
use crate::words::Words;
use text::{Edit, Span, apply, visible};

/// An ID in a record.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Identity {
    /// Its token.
    pub(super) span: Span,
    pub(super) category: Category,
    pub(super) id: i64,
    /// Whether the record defines it, rather than referring to it.
    pub(super) is_definition: bool,
}

impl Identity {
    /// The IDs in a record, in text order.
    pub(super) fn all(text: &str, tokens: Words<'_>) -> Vec<Self> {
        let mut all = Vec::new();
        let Some(kind) = kind(text, tokens.clone()) else {
            return all;
        };
        let mut add = |span: Span, category, is_definition| {
            all.extend(span.of(text).parse().ok().map(|id| Self {
                span,
                category,
                id,
                is_definition,
            }));
        };
        let mut tokens = tokens.skip(kind.heads());
        for part in kind.parts() {
            let spans: Vec<_> = tokens.by_ref().take(part.tokens()).collect();
            match (part, spans.as_slice()) {
                (Part::Id, &[span]) => {
                    if let Some(category) = defined(kind) {
                        add(span, category, true);
                    }
                }
                (Part::Field(field), &[span]) => {
                    if let Kind::Reference(category) = field.kind {
                        add(span, category, false);
                    }
                }
                _ => {}
            }
        }
        if kind == RecordKind::Render {
            for (at, span) in tokens.skip(1).enumerate() {
                if at % 2 == 1 {
                    add(span, Category::Object, false);
                }
            }
        }
        all
    }

    /// The edit that replaces it.
    fn renamed(&self, id: i64) -> Edit {
        Edit {
            span: self.span,
            text: id.to_string(),
        }
    }
}

/// Records to insert.
#[derive(Debug)]
pub(super) struct Copies {
    text: String,
    /// The identities of each record.
    identities: Vec<Vec<Identity>>,
    edits: Vec<Edit>,
}

impl Copies {
    /// Reads copied records.
    ///
    /// # Errors
    ///
    /// Fails if there is no record, or one of a kind of which a scene has only one.
    pub(super) fn of(text: &str) -> Result<Self, StructureError> {
        let foreign = |reason: String| Err(StructureError::Foreign { reason });
        let tree: Tree = tree::parse(text);
        if tree.records.is_empty() {
            return foreign("expected records of lights, materials, textures or objects".into());
        }
        let mut identities = Vec::new();
        for record in 0..tree.records.len() {
            let tokens = tree.tokens_of(text, record);
            let is_thing = kind(text, tokens.clone())
                .is_some_and(|kind| defined(kind).is_some() || matches!(kind, RecordKind::Use(_)));
            if !is_thing {
                let word = tree.tokens_of(text, record).next().unwrap_or_default();
                let word = visible(word.of(text));
                return foreign(format!(
                    "expected records of lights, materials, textures or objects, not `{word}`"
                ));
            }
            identities.push(Identity::all(text, tokens));
        }
        Ok(Self {
            text: text.to_owned(),
            identities,
            edits: Vec::new(),
        })
    }

    /// Replaces the IDs of a category that are in use, and references to them.
    pub(super) fn renumber(&mut self, category: Category, taken: &HashSet<i64>) {
        let greatest = taken.iter().copied().max().unwrap_or(0).max(0);
        let of_category = |identity: &&Identity| identity.category == category;
        let own = self.identities.iter().flatten().filter(of_category);
        let greatest = own.map(|own| own.id).fold(greatest, i64::max);
        let mut next = greatest.saturating_add(1);
        let mut renamed: HashMap<i64, i64> = HashMap::new();
        let mut defined = taken.clone();
        for record in &self.identities {
            let own = || record.iter().filter(of_category);
            // A record refers to those before it.
            for used in own().filter(|identity| !identity.is_definition) {
                self.edits
                    .extend(renamed.get(&used.id).map(|new| used.renamed(*new)));
            }
            for own in own().filter(|identity| identity.is_definition) {
                if !defined.insert(own.id) {
                    renamed.insert(own.id, next);
                    self.edits.push(own.renamed(next));
                    next = next.saturating_add(1);
                }
            }
        }
    }

    /// The text with its new IDs.
    pub(super) fn text(&self) -> String {
        let mut text = self.text.clone();
        let mut edits = self.edits.clone();
        Edit::sort(&mut edits);
        apply(&mut text, &edits);
        text
    }

    /// What they all define; `None` if that differs.
    pub(super) fn category(&self) -> Option<Category> {
        let all = self.identities.iter().flatten();
        let mut defined = all.filter(|id| id.is_definition);
        let first = defined.next()?.category;
        defined
            .all(|other| other.category == first)
            .then_some(first)
    }

    /// The IDs that they refer to, and do not define.
    pub(super) fn used(&self) -> impl Iterator<Item = (Category, i64)> + '_ {
        let is_defined = |used: &Identity| {
            let mut all = self.identities.iter().flatten();
            all.any(|own| own.is_definition && (own.category, own.id) == (used.category, used.id))
        };
        let used = self
            .identities
            .iter()
            .flatten()
            .filter(move |id| !id.is_definition && !is_defined(id));
        used.map(|used| (used.category, used.id))
    }

    /// The new IDs of objects that no other of the copies combines.
    pub(super) fn results(&self) -> Vec<String> {
        let new = |identity: &Identity| {
            let edit = self.edits.iter().find(|edit| edit.span == identity.span);
            edit.map_or_else(|| identity.id.to_string(), |edit| edit.text.clone())
        };
        let objects = self
            .identities
            .iter()
            .flatten()
            .filter(|id| id.category == Category::Object);
        let (defined, used): (Vec<_>, Vec<_>) = objects.partition(|id| id.is_definition);
        let used: HashSet<_> = used.into_iter().map(new).collect();
        let defined = defined.into_iter().map(new);
        defined.filter(|id| !used.contains(id)).collect()
    }
}

/// The kind of a record; `None` for an unknown word.
fn kind(text: &str, mut tokens: Words<'_>) -> Option<RecordKind> {
    let word = tokens.next()?.of(text);
    let (_, heads) = RECORDS.iter().find(|(known, _)| *known == word)?;
    let kind = match heads {
        Heads::One(kind) => *kind,
        Heads::Two(seconds) => {
            let second = tokens.next()?.of(text);
            seconds.iter().find(|(known, _)| *known == second)?.1
        }
    };
    let is_image = kind == RecordKind::Texture(TextureKind::Checker)
        && tokens.nth(2).is_some_and(|word| word.of(text) == "image");
    Some(if is_image {
        RecordKind::Texture(TextureKind::Image)
    } else {
        kind
    })
}

/// What a record defines.
fn defined(kind: RecordKind) -> Option<Category> {
    match kind {
        RecordKind::Light => Some(Category::Light),
        RecordKind::Material => Some(Category::Material),
        RecordKind::Object(_) => Some(Category::Object),
        RecordKind::Texture(_) => Some(Category::Texture),
        RecordKind::Camera
        | RecordKind::Resolution
        | RecordKind::Viewport
        | RecordKind::Use(_)
        | RecordKind::Render => None,
    }
}
