//! Going back from what is open, or from the mode.

use super::{PromptKind, Shared, compare, files, inspect, select};
use crate::ui::keymap::{Context, Mode};
use crate::ui::msg::Effect;

/// Goes back from what is open, or from the mode; never discards anything.
pub(crate) fn go_back(shared: &mut Shared) {
    match shared.context() {
        Context::Errors => shared.overlays.errors = None,
        Context::Rays => shared.inspection.explained = None,
        Context::In(Mode::Trace) => shared.mode = shared.pictures.mode_before(),
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

pub(crate) fn quit_key(shared: &mut Shared) -> Vec<Effect> {
    if shared.mode == Mode::Move {
        shared.warn_of_transform();
        return Vec::new();
    }
    files::quit(shared)
}

/// Closes a line without accepting it, and gives up leaving, which waited for a file name.
pub(crate) fn close_prompt(shared: &mut Shared) {
    let prompt = shared.overlays.prompt.take();
    if let Some(PromptKind::Filter(from)) = prompt.map(|prompt| prompt.kind) {
        select::drop_filter(shared, from);
    }
    shared.palette.reset();
    shared.jobs.next = None;
}
