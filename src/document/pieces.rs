//! The places at which texts differ from their common ancestor, resolved: changes that apply
//! cleanly, and conflicts.

use text::{Edit, Span};

/// One of the two changed texts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The text being edited.
    Mine,
    /// The text from outside.
    Theirs,
}

/// A place that both texts changed differently.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Conflict {
    /// The span in the text being edited.
    pub span: Span,
    /// The text of the common ancestor.
    pub base: String,
    /// The text being edited, in `span`.
    pub mine: String,
    /// The text from outside.
    pub theirs: String,
    /// The decision; undecided conflicts keep `Mine`.
    pub decision: Option<Side>,
    /// The span in the common ancestor, which identifies the conflict after further edits.
    pub(super) ancestor: Span,
    /// The span in the text from outside.
    pub(super) outside: Span,
}

/// Corresponding spans of three texts, which differ there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    /// In the common ancestor.
    pub(super) base: Span,
    /// In the text being edited.
    pub(super) mine: Span,
    /// In the text from outside.
    pub(super) theirs: Span,
}

/// A place where the result may differ from the text being edited.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Piece {
    /// A change made only in the text from outside.
    Theirs(Edit),
    /// The index of a conflict.
    Conflict(usize),
}

impl Side {
    /// `Theirs` for `Mine` and the reverse.
    #[must_use]
    pub fn other(self) -> Self {
        match self {
            Self::Mine => Self::Theirs,
            Self::Theirs => Self::Mine,
        }
    }
}

impl Conflict {
    /// The text of one side.
    pub fn text(&self, side: Side) -> &str {
        match side {
            Side::Mine => &self.mine,
            Side::Theirs => &self.theirs,
        }
    }

    /// The undecided conflict from this one to a later one, of the ancestor, mine and theirs.
    fn to(&self, later: &Self, [base, mine, theirs]: [&str; 3]) -> Self {
        let ancestor = self.ancestor.to(later.ancestor);
        let span = self.span.to(later.span);
        let outside = self.outside.to(later.outside);
        Self {
            span,
            base: ancestor.of(base).to_owned(),
            mine: span.of(mine).to_owned(),
            theirs: outside.of(theirs).to_owned(),
            decision: None,
            ancestor,
            outside,
        }
    }
}

impl Place {
    /// The place from this one to a later one.
    pub(super) fn to(self, later: Self) -> Self {
        Self {
            base: self.base.to(later.base),
            mine: self.mine.to(later.mine),
            theirs: self.theirs.to(later.theirs),
        }
    }
}

/// Resolves each place: a change by one side is taken, and so is one that both sides made alike;
/// different changes conflict.
pub(super) fn pieces(
    [base, mine, theirs]: [&str; 3],
    places: &[Place],
) -> (Vec<Piece>, Vec<Conflict>) {
    let (mut pieces, mut conflicts) = (Vec::new(), Vec::new());
    for place in places {
        let (span, ancestor) = (place.mine, place.base);
        let [base, mine] = [ancestor.of(base), span.of(mine)];
        let theirs = place.theirs.of(theirs);
        if mine == theirs || theirs == base {
            continue;
        }
        if mine == base {
            pieces.push(Piece::Theirs(Edit {
                span,
                text: theirs.to_owned(),
            }));
            continue;
        }
        pieces.push(Piece::Conflict(conflicts.len()));
        conflicts.push(Conflict {
            span,
            base: base.to_owned(),
            mine: mine.to_owned(),
            theirs: theirs.to_owned(),
            decision: None,
            ancestor,
            outside: place.theirs,
        });
    }
    (pieces, conflicts)
}

/// Joins conflicts in the same span of the text being edited, as `of` gives it, with what is between them.
pub(super) fn joined(
    texts: [&str; 3],
    pieces: &[Piece],
    conflicts: &[Conflict],
    of: impl Fn(Span) -> Option<Span>,
) -> (Vec<Piece>, Vec<Conflict>) {
    let (mut new_pieces, mut new): (Vec<Piece>, Vec<Conflict>) = (Vec::new(), Vec::new());
    // Where the pieces behind the last conflict begin, and the span that it is in.
    let mut last: Option<(usize, Span)> = None;
    for piece in pieces {
        let Piece::Conflict(index) = piece else {
            new_pieces.push(piece.clone());
            continue;
        };
        let next = &conflicts[*index];
        let own = of(next.span);
        if let (Some((behind, span)), Some(own)) = (last, own)
            && span == own
            && let Some(joined) = new.last_mut()
        {
            new_pieces.truncate(behind);
            *joined = joined.to(next, texts);
            continue;
        }
        new_pieces.push(Piece::Conflict(new.len()));
        new.push(next.clone());
        last = own.map(|own| (new_pieces.len(), own));
    }
    (new_pieces, new)
}

/// The edits of the pieces, with each conflict decided by `decide`.
pub(super) fn edits(
    pieces: &[Piece],
    conflicts: &[Conflict],
    decide: impl Fn(&Conflict) -> Side,
) -> Vec<Edit> {
    pieces
        .iter()
        .filter_map(|piece| match piece {
            Piece::Theirs(edit) => Some(edit.clone()),
            Piece::Conflict(index) => {
                let conflict = &conflicts[*index];
                (decide(conflict) == Side::Theirs).then(|| Edit {
                    span: conflict.span,
                    text: conflict.theirs.clone(),
                })
            }
        })
        .collect()
}
