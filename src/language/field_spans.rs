//! The places of fields in the text, and the edits that change them.

use std::borrow::Cow;

use super::SceneText;
use super::schema::Field;
use text::{Edit, Span};

/// A field with the places of its components.
#[derive(Clone, Debug, PartialEq)]
pub struct FieldSpans {
    /// The field in the table.
    pub field: &'static Field,
    /// One span per component; empty, at the place for insertion, if the text does not state the
    /// component. No spans at all for a part of the view that only [`SceneText::view_edits`] can add.
    pub spans: Vec<Span>,
    /// Defaults and insertion of components that the text omits, if it could state them.
    pub(super) implicit: Option<Box<Implicit>>,
}

/// The implicit part of a field, and how to insert it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Implicit {
    /// All components.
    pub(super) components: Vec<Component>,
    /// The element to write them in, if that is missing too, or the command.
    pub(super) element: Option<&'static str>,
    /// The place and the surroundings of the insertion.
    pub(super) insertion: Insertion,
    /// What limits the effect to the node, if that needs more.
    pub(super) limit: Option<Limit>,
}

/// What limits the effect of an insertion to the node.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Limit {
    /// A further insertion, behind the node.
    pub(super) edit: Edit,
    /// The first number of what is in force around the node, if the text states that.
    pub(super) inherited: Option<Span>,
}

/// A component that a text may omit.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Component {
    /// What is written before its value.
    pub(super) name: &'static str,
    /// The place of its value; `None` if the text omits it.
    pub(super) place: Option<Span>,
    /// Its value if the text omits it.
    pub(super) default: Cow<'static, str>,
    /// Whether it must be written with the others, whose presence would change its default.
    pub(super) is_required: bool,
}

/// A place for an insertion.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Insertion {
    /// The text replaced, usually empty.
    pub(super) span: Span,
    pub(super) before: Vec<Piece>,
    /// The text between several insertions at this place.
    pub(super) between: Vec<Piece>,
    pub(super) after: Vec<Piece>,
}

/// A piece of inserted text.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Piece {
    /// Fixed text.
    Literal(&'static str),
    /// A copy of this part of the text.
    Copy(Span),
}

/// A field and the new values of its components, by index.
pub type Wanted<'p> = (&'p FieldSpans, Vec<(usize, String)>);

impl FieldSpans {
    /// A field stated in the text, or a part of the view that is not.
    pub(super) fn explicit(field: &'static Field, spans: Vec<Span>) -> Self {
        Self {
            field,
            spans,
            implicit: None,
        }
    }

    /// A field whose components the text may omit: they are inserted there, in this element if that is
    /// missing, too.
    pub(super) fn with_defaults(
        field: &'static Field,
        components: Vec<Component>,
        element: Option<&'static str>,
        insertion: Insertion,
    ) -> Self {
        let missing = Span::at(insertion.span.start());
        let places = components.iter().map(|own| own.place);
        let is_explicit = places.clone().all(|place| place.is_some());
        let spans = places.map(|place| place.unwrap_or(missing)).collect();
        let implicit = Implicit {
            components,
            element,
            insertion,
            limit: None,
        };
        Self {
            field,
            spans,
            implicit: (!is_explicit).then(|| Box::new(implicit)),
        }
    }

    /// The same with an effect that is limited to the node.
    pub(super) fn limited(mut self, limit: Limit) -> Self {
        if let Some(implicit) = &mut self.implicit {
            implicit.limit = Some(limit);
        }
        self
    }

    /// The default of a component that the text omits.
    pub fn default_of(&self, component: usize) -> Option<&str> {
        let own = self.implicit.as_ref()?.components.get(component)?;
        own.place.is_none().then_some(&*own.default)
    }

    /// Whether the components that the text omits have the values that it states for other nodes, too.
    pub fn is_inherited(&self) -> bool {
        self.inherited().is_some()
    }

    /// The first number of what the text states for other nodes, too.
    pub(super) fn inherited(&self) -> Option<Span> {
        self.implicit.as_ref()?.limit.as_ref()?.inherited
    }

    /// Whether the text states any of the components.
    pub fn is_explicit(&self) -> bool {
        (0..self.spans.len()).any(|component| self.default_of(component).is_none())
    }

    /// Returns the edits that set these components.
    pub fn edits(&self, source: &dyn SceneText, values: &[(usize, String)]) -> Vec<Edit> {
        source.edits(&[(self, values.to_vec())])
    }
}

/// Returns the edits that insert these values where the text omits them, as `markup` spells them.
/// Insertions at one place are combined.
pub(super) fn insertions(
    text: &str,
    wanted: &[Wanted<'_>],
    markup: impl Fn(&Implicit, &[(usize, String)]) -> String,
) -> Vec<Edit> {
    let mut insertions: Vec<(&Insertion, Vec<String>)> = Vec::new();
    let mut limits = Vec::new();
    for (placed, values) in wanted {
        let mut missing = values.clone();
        missing.retain(|(component, _)| placed.default_of(*component).is_some());
        let Some(implicit) = placed.implicit.as_ref().filter(|_| !missing.is_empty()) else {
            continue;
        };
        let inserted = markup(implicit, &missing);
        limits.extend(implicit.limit.as_ref().map(|limit| limit.edit.clone()));
        match insertions
            .iter_mut()
            .find(|(place, _)| **place == implicit.insertion)
        {
            Some((_, all)) => all.push(inserted),
            None => insertions.push((&implicit.insertion, vec![inserted])),
        }
    }
    let edits = insertions.into_iter();
    let edits = edits.map(|(place, all)| place.edit(text, &all));
    edits.chain(limits).collect()
}

impl Insertion {
    /// An insertion without anything around it.
    pub(super) fn at(offset: usize) -> Self {
        Self {
            span: Span::at(offset),
            before: Vec::new(),
            between: Vec::new(),
            after: Vec::new(),
        }
    }

    /// The edit that inserts all of these here.
    pub(super) fn edit(&self, text: &str, all: &[String]) -> Edit {
        let copied = |pieces: &[Piece]| -> String {
            let pieces = pieces.iter().map(|piece| match piece {
                Piece::Literal(literal) => literal,
                Piece::Copy(span) => span.of(text),
            });
            pieces.collect()
        };
        let [before, between, after] =
            [&self.before, &self.between, &self.after].map(|pieces| copied(pieces));
        Edit {
            span: self.span,
            text: [before, all.join(&between), after].concat(),
        }
    }
}

/// Returns the edits that set these components where the text states them.
pub(super) fn edits<Source: SceneText + ?Sized>(
    source: &Source,
    wanted: &[Wanted<'_>],
) -> Vec<Edit> {
    let edits = wanted.iter().flat_map(|(placed, values)| {
        let explicit = values
            .iter()
            .filter(|(component, _)| placed.default_of(*component).is_none());
        explicit.filter_map(|(component, literal)| {
            let span = *placed.spans.get(*component)?;
            let text = source.spelled(span, literal).into_owned();
            Some(Edit { span, text })
        })
    });
    let mut edits: Vec<_> = edits.collect();
    Edit::sort(&mut edits);
    // Two nodes may have a place in common.
    edits.dedup_by_key(|edit| edit.span);
    edits
}
