//! Esc, in the modes that bind it to nothing of their own.

use super::{Shared, compare, inspect, select};
use crate::keymap::{Context, Mode};

/// Goes back from what is open, or from the mode; never discards anything.
pub(crate) fn go_back(shared: &mut Shared) {
    match shared.context() {
        Context::Errors => shared.overlays.errors = None,
        Context::Rays => shared.inspection.explained = None,
        Context::In(Mode::Select | Mode::Edit) if shared.inspection.locates => {
            shared.inspection.locates = false;
        }
        Context::In(Mode::Trace) => {
            shared.mode = shared.pictures.before_trace.take().unwrap_or(Mode::Select);
        }
        Context::In(Mode::Compare) => compare::end(shared),
        Context::In(Mode::Inspect) => inspect::stop(shared),
        Context::In(Mode::Select) if select::end_filter(shared) => {}
        Context::In(Mode::Select) => shared.cursor.marks.clear(),
        Context::In(Mode::Edit | Mode::View | Mode::Fly) => {
            shared.document.end_step();
            shared.mode = Mode::Select;
        }
        // They have keys of their own for that.
        _ => {}
    }
}
