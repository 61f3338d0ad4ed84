//! Undo steps carried over a change from outside. Both sides' edits are stated for the same text; each is
//! moved over the other, as in operational transformation (Ellis, Gibbs, "Concurrency Control in Groupware
//! Systems", 1989). A step whose place was changed, and those behind it, are forgotten: undo must not
//! return to what somebody else has replaced.

use text::{Edit, Span};

/// The steps, each given by its edits of the text that the one before leads to, the next one first, after
/// `outside` was applied to the present text. Ends before the first that touches what was changed.
pub(super) fn rebased<'s>(
    steps: impl Iterator<Item = &'s [Edit]>,
    outside: &[Edit],
) -> Vec<Vec<Edit>> {
    let mut outside = outside.to_vec();
    let mut moved = Vec::new();
    for step in steps {
        let touches = |edit: &Edit| outside.iter().any(|other| edit.span.touches(other.span));
        if step.iter().any(touches) {
            break;
        }
        moved.push(over(step, &outside));
        outside = over(&outside, step);
    }
    moved
}

/// Edits as of the text after others, which touch none of them; both are sorted.
fn over(edits: &[Edit], others: &[Edit]) -> Vec<Edit> {
    let mut others = others.iter().peekable();
    let (mut removed, mut inserted) = (0, 0);
    let moved = edits.iter().map(|edit| {
        while let Some(other) = others.next_if(|other| other.span.end() < edit.span.start()) {
            removed += other.span.len();
            inserted += other.text.len();
        }
        let by = |at: usize| at + inserted - removed;
        Edit {
            span: Span::new(by(edit.span.start()), by(edit.span.end())),
            text: edit.text.clone(),
        }
    });
    moved.collect()
}
