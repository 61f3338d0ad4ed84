//! The state of the colour picker: hue, saturation and value of a field, and the colours of the scene.

use super::live_edit::LiveEdit;
use crate::app::values::hsv::Hsv;
use scene::Rgb;
use text::rounded;

/// Degrees of one step of the hue.
const HUE: f64 = 2.0;
/// One step of the saturation or the value.
const SHARE: f64 = 0.02;

/// The colour picker of a field.
#[derive(Debug)]
pub struct ColourPicker {
    /// The name of the field.
    pub key: &'static str,
    /// The row under the cursor.
    pub row: PickerRow,
    /// The colour chosen.
    pub colour: Hsv,
    /// The colour before.
    pub before: Rgb,
    /// The colours of the scene.
    pub swatches: Vec<Rgb>,
    /// The index of the one under the cursor.
    pub swatch: Option<usize>,
    pub(crate) live_edit: LiveEdit,
}

/// A row of the colour picker.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PickerRow {
    /// The hue.
    Hue,
    /// The saturation.
    Saturation,
    /// The value.
    Value,
    /// The colours of the scene.
    Swatches,
}

impl PickerRow {
    /// All rows, from top to bottom.
    pub const ALL: [Self; 4] = [Self::Hue, Self::Saturation, Self::Value, Self::Swatches];
    /// The rows with a bar.
    pub const BARS: [Self; 3] = [Self::Hue, Self::Saturation, Self::Value];
}

impl ColourPicker {
    /// The place of a row's marker on its bar, from 0 to 1.
    pub fn share(&self, row: PickerRow) -> f64 {
        let Hsv {
            hue,
            saturation,
            value,
        } = self.colour;
        match row {
            PickerRow::Hue => hue / 360.0,
            PickerRow::Saturation => saturation.min(1.0),
            PickerRow::Value => value.min(1.0),
            PickerRow::Swatches => 0.0,
        }
    }

    /// The colour with a row's marker at another place on its bar.
    pub fn at_share(&self, row: PickerRow, share: f64) -> Hsv {
        let mut colour = self.colour;
        match row {
            PickerRow::Hue => colour.hue = rounded(360.0 * share, 0).rem_euclid(360.0),
            PickerRow::Saturation => colour.saturation = rounded(share, 2),
            PickerRow::Value => colour.value = rounded(share, 2),
            PickerRow::Swatches => {}
        }
        colour
    }

    /// Changes the row under the cursor by steps.
    pub(crate) fn step(&mut self, steps: f64) {
        let colour = &mut self.colour;
        match self.row {
            PickerRow::Hue => {
                colour.hue = (colour.hue + HUE * steps).rem_euclid(360.0);
            }
            PickerRow::Saturation => {
                colour.saturation = (colour.saturation + SHARE * steps).clamp(0.0, 1.0);
            }
            PickerRow::Value => {
                colour.value = (colour.value + SHARE * steps).max(0.0);
            }
            PickerRow::Swatches if self.swatches.is_empty() => {}
            PickerRow::Swatches => {
                let count = self.swatches.len();
                let next = match self.swatch {
                    Some(at) if 0.0 < steps => (at + 1) % count,
                    Some(at) => (at + count - 1) % count,
                    None if 0.0 < steps => 0,
                    None => count - 1,
                };
                self.swatch = Some(next);
                self.colour = Hsv::of(self.swatches[next]);
            }
        }
    }
}
