//! Texts that are pasted.

use super::shared::line;
use super::values::typed::Values;
use super::{PageFocus, PromptKind, Shared, command, edit, select};
use crate::keymap::Mode;
use crate::msg::Effect;

/// Pastes a text where one is typed, otherwise as items or as values.
pub(crate) fn paste(shared: &mut Shared, text: &str) -> Vec<Effect> {
    if shared.overlays.dialog.is_some() {
        return Vec::new();
    }
    if shared.overlays.line().is_some() && !edit::has_room(shared, text.trim_end().chars().count())
    {
        return Vec::new();
    }
    if let Some(prompt) = &mut shared.overlays.prompt {
        line::insert_over(&mut prompt.input, &mut prompt.is_selected, text);
        if let PromptKind::Filter(from) = prompt.kind {
            select::filter_list(shared, from);
        }
        shared.palette.reset();
        return command::list_folder(shared);
    }
    paste_value(shared, text);
    Vec::new()
}

fn paste_value(shared: &mut Shared, text: &str) {
    let pasted = text.trim();
    if let Some(page) = &mut shared.overlays.page {
        if !page.is_read() || page.focus == PageFocus::Search {
            page.filter.insert(text);
        }
        return;
    }
    if let Some(menu) = &mut shared.overlays.menu {
        menu.filter.insert(text);
        edit::follow_menu(shared);
        return;
    }
    if shared.disk.is_opening() {
        shared.warn_of_opening();
        return;
    }
    if shared.overlays.picker.is_some() {
        edit::paste_colour(shared, pasted);
        return;
    }
    if shared.mode == Mode::Select {
        select::insert(shared, text);
        return;
    }
    if shared.mode != Mode::Edit {
        shared.say("items are pasted in SELECT, values in EDIT");
        return;
    }
    let values = edit::literals_of(shared, pasted);
    let count = |values: &Vec<Values>| values.iter().map(Vec::len).sum::<usize>();
    let is_whole = values.as_ref().is_ok_and(|values| 1 < count(values));
    let is_typed = shared.cursor.typing.is_some() && !is_whole;
    if is_typed && !edit::has_room(shared, text.trim_end().chars().count()) {
        return;
    }
    if let (Some(typing), false) = (&mut shared.cursor.typing, is_whole) {
        typing.refused = None;
        line::insert_over(&mut typing.input, &mut typing.is_selected, text);
        return;
    }
    let pasted = values.map_err(|reason| format!("cannot paste this: {reason}"));
    let pasted = pasted.and_then(|values| {
        shared.cursor.typing = None;
        edit::assign_whole(shared, &values).map_err(|refused| refused.message)
    });
    if let Err(reason) = pasted {
        shared.fail(reason);
    }
}
