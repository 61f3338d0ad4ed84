//! When the panel is on screen, and where.

use crate::app::Shared;
use crate::keymap::{Context, Mode};

use Context::In;

/// Where there is a selected row.
pub(super) const HERE: &[Context] = &[In(Mode::Select), In(Mode::Edit)];
/// Where rows are selected.
pub(super) const LIST: &[Context] = &[In(Mode::Select)];

/// Opens the panel, or closes it.
pub(super) fn toggle(shared: &mut Shared) {
    shared.inspection.locates = !shared.inspection.locates;
}

/// Whether the panel is on screen, and if so, whether it takes the place of the list, as the fields are in
/// use.
pub(crate) fn locates(shared: &Shared) -> Option<bool> {
    let context = shared.context();
    let is_open = shared.inspection.locates && !shared.nodes().is_empty();
    (is_open && HERE.contains(&context)).then(|| !LIST.contains(&context))
}
