//! The few styles everything is drawn in.
//!
//! Colours are the terminal's own sixteen where it can be, so that they fit the user's theme. Each
//! meaning also has a sign or a modifier: nothing is shown by colour alone.

use ratatui::style::{Color, Modifier, Style};

use crate::scene::Rgb;
use crate::text::Severity;

/// What the eye should find first: keys, the cursor, titles of the panel in use.
pub(crate) const ACCENT: Style = Style::new().fg(Color::Cyan);

/// What may be overlooked: explanations, units, defaults. A grey that is legible on black and on
/// white.
pub(crate) const DIM: Style = Style::new().fg(Color::Indexed(245));

/// Titles.
pub(crate) const BOLD: Style = Style::new().add_modifier(Modifier::BOLD);

/// Success.
pub(crate) const GOOD: Style = Style::new().fg(Color::Green);

/// Warnings, and what is not saved.
pub(crate) const WARNING: Style = Style::new().fg(Color::Yellow);

/// Errors.
pub(crate) const ERROR: Style = Style::new().fg(Color::Red);

/// The character under a cursor.
pub(crate) const CURSOR: Style = Style::new().add_modifier(Modifier::REVERSED);

/// Where the selected object meets others in the picture; far from most scenes' colours.
pub(crate) const OUTLINE: [u8; 3] = [255, 140, 0];

/// The style of a chip: a style's colour behind the text, or plain reverse video without colours.
/// It hides the colours of what it is drawn over.
pub(crate) const fn chip(style: Style) -> Style {
    style
        .bg(Color::Reset)
        .add_modifier(Modifier::REVERSED)
        .add_modifier(Modifier::BOLD)
}

/// The style of a message; `None` is success.
pub(crate) const fn severity(severity: Option<Severity>) -> Style {
    match severity {
        None => GOOD,
        Some(Severity::Warning) => WARNING,
        Some(Severity::Error) => ERROR,
    }
}

/// The least that the brightest channel of a swatch has: below, a dot is lost on a dark screen.
const LEAST_BRIGHT: f64 = 0.4;

/// The style of a sign that shows a colour of the scene: clamped to what can be shown, and a dark
/// one brightened without a change of hue.
pub(crate) fn swatch(colour: Rgb) -> Style {
    let shown = colour.to_array().map(|channel| channel.clamp(0.0, 1.0));
    let brightest = shown.into_iter().fold(0.0, f64::max);
    let [red, green, blue] = shown.map(|channel| {
        let lifted = match brightest {
            0.0 => LEAST_BRIGHT,
            _ => channel * (LEAST_BRIGHT / brightest).max(1.0),
        };
        (255.0 * lifted).round() as u8
    });
    Style::new().fg(Color::Rgb(red, green, blue))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dark_swatches_are_lifted_and_keep_their_hue() {
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
