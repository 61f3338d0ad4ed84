//! The few styles of the interface.
//!
//! They use the terminal's own sixteen colours where possible, so that they match the user's theme.
//! Each meaning also has a sign or a modifier: nothing depends on colour alone.

use glam::DVec3;
use ratatui::style::{Color, Modifier, Style};

use crate::scene::Rgb;
use crate::text::Severity;

/// The most prominent style: keys, the cursor, the title of the focused panel.
pub(crate) const ACCENT: Style = Style::new().fg(Color::Cyan);

/// Secondary text: explanations, units, defaults. A grey that is legible on black and on white.
pub(crate) const DIM: Style = Style::new().fg(Color::Indexed(245));

/// Titles, file names and the item under the cursor.
pub(crate) const BOLD: Style = Style::new().add_modifier(Modifier::BOLD);

/// Messages of success, and chosen sides of conflicts.
pub(crate) const GOOD: Style = Style::new().fg(Color::Green);

/// Warnings and unsaved changes.
pub(crate) const WARNING: Style = Style::new().fg(Color::Yellow);

/// Errors in texts, and failures.
pub(crate) const ERROR: Style = Style::new().fg(Color::Red);

/// The character under a cursor.
pub(crate) const CURSOR: Style = Style::new().add_modifier(Modifier::REVERSED);

/// The outline of the selected object in the picture; unlike the colours of most scenes.
pub(crate) const OUTLINE: [u8; 3] = [255, 140, 0];

/// The lines of the selected object in a wireframe.
pub(crate) const MARKED: Style = Style::new().fg(Color::Yellow).add_modifier(Modifier::BOLD);

/// The colour of an axis: red, green and blue for x, y and z, as in other programs.
pub(crate) fn axis(axis: DVec3) -> Color {
    let [x, y, z] = axis.abs().to_array();
    if y <= x && z <= x {
        Color::Rgb(255, 80, 80)
    } else if z <= y {
        Color::Rgb(90, 220, 90)
    } else {
        Color::Rgb(90, 140, 255)
    }
}

/// The style of a chip: the colour of a style as background, or plain reverse video without
/// colours. Replaces the colours of the cells below it.
pub(crate) const fn chip(style: Style) -> Style {
    style
        .bg(Color::Reset)
        .add_modifier(Modifier::REVERSED)
        .add_modifier(Modifier::BOLD)
}

/// The style of a message; `None` means success.
pub(crate) const fn severity(severity: Option<Severity>) -> Style {
    match severity {
        None => GOOD,
        Some(Severity::Warning) => WARNING,
        Some(Severity::Error) => ERROR,
    }
}

/// Minimum value of the brightest channel of a swatch; a darker dot is lost on a dark screen.
const MIN_BRIGHT: f64 = 0.4;

/// The style of a dot in a colour of the scene, clamped to the displayable range. Dark colours are
/// brightened without changing their hue.
pub(crate) fn swatch(colour: Rgb) -> Style {
    let shown = colour.to_array().map(|channel| channel.clamp(0.0, 1.0));
    let brightest = shown.into_iter().fold(0.0, f64::max);
    let [red, green, blue] = shown.map(|channel| {
        let lifted = match brightest {
            0.0 => MIN_BRIGHT,
            _ => channel * (MIN_BRIGHT / brightest).max(1.0),
        };
        (255.0 * lifted).round() as u8
    });
    Style::new().fg(Color::Rgb(red, green, blue))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dark_swatches_are_brightened_and_keep_their_hue() {
        let check = |colour: [f64; 3], shown: [u8; 3]| {
            let [red, green, blue] = shown;
            let style = swatch(Rgb::new(colour[0], colour[1], colour[2]));
            assert_eq!(style.fg, Some(Color::Rgb(red, green, blue)));
        };
        check([1.0, 0.5, 0.0], [255, 128, 0]);
        check([0.1, 0.05, 0.0], [102, 51, 0]);
        check([0.0, 0.0, 0.0], [102, 102, 102]);
        check([7.0, 0.0, 0.0], [255, 0, 0]);
    }
}
