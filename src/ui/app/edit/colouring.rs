//! Picking a colour: each change is tried out in the text at once, and the whole is one undo step.

use super::repeating::note_set;
use crate::app::shared::picker::{ColourPicker, PickerRow};
use crate::app::values::hsv::Hsv;
use crate::app::values::literals::plain;
use crate::app::values::{colours, literals};
use crate::app::{Shared, Stride, text};
use ::text::{parse_number, rounded, spell_like};
use language::FieldSpans;
use language::schema::Kind;
use scene::Rgb;

/// The number of the scene's colours offered.
const SWATCHES: usize = 30;

/// Opens the colour picker at the current field.
pub(super) fn open_picker(shared: &mut Shared) {
    let Some(row) = shared.field_row(shared.cursor.field) else {
        return;
    };
    let Some(before) = row.colour() else {
        shared.fail(format!("{} is not a colour", row.field.key));
        return;
    };
    shared.overlays.picker = Some(ColourPicker {
        key: row.field.key,
        row: PickerRow::Hue,
        colour: Hsv::of(before),
        before,
        swatches: colours::of_scene(shared.source(), SWATCHES),
        swatch: None,
        live_edit: text::begin_live_edit(shared),
    });
}

/// Moves the cursor of the colour picker by rows.
pub(crate) fn move_picker(shared: &mut Shared, rows: isize) {
    if let Some(picker) = &mut shared.overlays.picker {
        let last = PickerRow::ALL.len() - 1;
        let at = (picker.row as usize).saturating_add_signed(rows).min(last);
        picker.row = PickerRow::ALL[at];
    }
}

/// Changes what the colour picker's cursor is on by steps.
pub(super) fn step_colour(shared: &mut Shared, steps: i8, stride: Stride) {
    let steps = shared.cursor.stride_with(stride).of(f64::from(steps));
    change_colour(shared, |picker| picker.step(steps));
}

/// Moves a row's marker to a place on its bar.
pub(crate) fn place_colour(shared: &mut Shared, row: PickerRow, share: f64) {
    change_colour(shared, |picker| {
        picker.row = row;
        picker.colour = picker.at_share(row, share);
    });
}

/// Takes one of the scene's colours.
pub(crate) fn take_swatch(shared: &mut Shared, index: usize) {
    change_colour(shared, |picker| {
        if let Some(&colour) = picker.swatches.get(index) {
            picker.row = PickerRow::Swatches;
            picker.swatch = Some(index);
            picker.colour = Hsv::of(colour);
        }
    });
}

/// Takes a pasted colour: three numbers or `#rrggbb`.
pub(crate) fn paste_colour(shared: &mut Shared, text: &str) {
    let pasted = literals::all_of(Kind::Colour, text)
        .and_then(|literals| colours::of_literals(Kind::Colour, &literals));
    match pasted {
        Some(colour) => change_colour(shared, |picker| picker.colour = Hsv::of(colour)),
        None => shared.fail("cannot paste this: expected three numbers or #rrggbb"),
    }
}

/// Keeps the colour and closes the picker.
pub(crate) fn confirm_colour(shared: &mut Shared) {
    let picker = shared.overlays.picker.take();
    text::keep_live_edit(shared);
    if picker.is_some_and(|picker| picker.live_edit.is_applied) {
        note_set(shared);
        text::say_marked(shared);
    }
}

/// Puts the colour back and closes the picker.
pub(super) fn cancel_colour(shared: &mut Shared) {
    if let Some(picker) = shared.overlays.picker.take() {
        text::end_live_edit(shared, picker.live_edit);
    }
}

/// Changes the colour chosen, and the text with it.
fn change_colour(shared: &mut Shared, change: impl FnOnce(&mut ColourPicker)) {
    let Some(mut picker) = shared.overlays.picker.take() else {
        return;
    };
    if text::leaves_live_edit(shared, &picker.live_edit, "colour") {
        return;
    }
    change(&mut picker);
    let colour = picker.colour.rgb();
    text::try_or_fail(shared, &mut picker.live_edit, |shared| {
        let edits = shared.cursor.current().map(|placed| {
            let values = colour_values(shared, placed, colour);
            text::edits_of(shared, &[(placed, values)])
        });
        Ok(edits.unwrap_or_default())
    });
    shared.overlays.picker = Some(picker);
}

/// The literals that give a field a colour; none for channels that have their value already.
fn colour_values(shared: &Shared, placed: &FieldSpans, colour: Rgb) -> Vec<(usize, String)> {
    let present = colours::literals(shared.source(), placed);
    let number = |at: usize| {
        let literal = present.get(at).map(|literal| plain(literal));
        literal.and_then(|literal| parse_number(literal).ok())
    };
    let scale = number(3).filter(|_| placed.field.kind == Kind::ScaledColour);
    let is_black = scale == Some(0.0);
    let scale = scale.filter(|_| !is_black).unwrap_or(1.0);
    let mut values = Vec::new();
    let channels = colour.to_array();
    for (at, channel) in channels.into_iter().enumerate() {
        let old = number(at).unwrap_or_default();
        let is_near = (channel - scale * old).abs() <= 1e-9 * channel.abs().max(1e-6);
        let new = if is_near {
            old
        } else {
            rounded(channel / scale, decimals(channels))
        };
        if new == old && !text::sets_marked(shared) {
            continue;
        }
        let literal = match (placed.default_of(at), present.get(at)) {
            (_, Some(old)) if is_near => old.clone(),
            (None, Some(old)) => spell_like(old.trim(), new),
            _ => new.to_string(),
        };
        values.push((at, literal));
    }
    values.extend(is_black.then(|| (3, "1".to_owned())));
    values
}

/// The decimals of a colour's channels: finer than 1/255, and than a hundredth of dark ones.
fn decimals(channels: [f64; 3]) -> usize {
    let brightest = channels.into_iter().fold(0.0, f64::max);
    if brightest < 0.1 { 4 } else { 3 }
}
