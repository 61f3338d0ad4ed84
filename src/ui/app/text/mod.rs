//! Changes of the text: every one is an edit, tried out or kept, named, and undone as one step.

mod assigning;
mod conflicts;
mod edit;
mod inputs;
mod live_editing;
mod naming;
mod setting;
mod transient;

pub(crate) use assigning::{assign, edits_of, placed_like, say_marked, sets_marked};
pub(crate) use conflicts::ask_conflict;
pub(crate) use edit::{
    assets_read, install, lowered, lowered_after, make_step, relower, spans_after, try_edits,
    try_step,
};
pub(crate) use inputs::{follow_input, merge_input, note_before_input};
pub(crate) use live_editing::{
    begin_live_edit, end_live_edit, keep_live_edit, leaves_live_edit, take_merged, try_instead,
    try_or_fail,
};
pub(crate) use naming::{done, error_place, first_node_in, name_of_places, place_name};
pub(crate) use setting::{
    SettingOrder, next_integrator, redo_text, set_rendering, set_size, undo_text, write_setting,
};
pub(crate) use transient::{
    begin_transient, has_edits, leave_sequence, return_if_failed, revert_transient, step_outside,
};
