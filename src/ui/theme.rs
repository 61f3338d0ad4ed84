//! The few styles of the interface, and the themes that give them colours.
//!
//! Views draw meanings in named colours, which pictures never use; [`Theme::apply`] then replaces
//! them by those of the theme. The dark theme uses the terminal's own sixteen colours where possible,
//! so that they match the user's. Each meaning also has a sign or a modifier: nothing depends on
//! colour alone.

use glam::DVec3;
use ratatui::buffer::Buffer;
use ratatui::style::{Color, Modifier, Style};

use scene::Rgb;
use text::Severity;

/// The colours of everything but pictures.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Theme {
    /// For dark screens.
    #[default]
    Dark,
    /// For light screens.
    Light,
    /// Without colours: bold, dim, underlined and reverse video.
    Mono,
}

/// The most prominent style: keys, the cursor, the title of the focused panel.
pub(crate) const ACCENT: Style = Style::new().fg(Color::Cyan);

/// Secondary text: explanations, units, defaults.
pub(crate) const DIM: Style = Style::new().fg(Color::DarkGray);

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

/// The cross over the picture.
pub(crate) const CROSS: Style = chip(Style::reset());

/// The outline of the selected object in the picture; unlike the colours of most scenes.
pub(crate) const OUTLINE: [u8; 3] = [255, 140, 0];

/// The path of light that is explained, and its part that no light comes along.
pub(crate) const PATH: [u8; 3] = [255, 230, 0];
pub(crate) const BLOCKED: [u8; 3] = [255, 60, 60];

/// The lines of the selected object in a wireframe.
pub(crate) const OUTLINED: Style = Style::new().fg(Color::Yellow).add_modifier(Modifier::BOLD);

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

/// A style for a part of a row: in a row under the cursor only the ink of the part, so that all of the row
/// keeps one background.
pub(crate) fn within(row: Style, part: Style) -> Style {
    if !row.add_modifier.contains(Modifier::REVERSED) {
        return row.patch(part);
    }
    match part.fg {
        // In reverse video the background is the ink; secondary text would be hard to read there.
        Some(ink) if ink != Color::DarkGray => row.bg(ink),
        _ => row,
    }
}

/// The style of a message; `None` means success.
pub(crate) const fn severity(severity: Option<Severity>) -> Style {
    match severity {
        None => GOOD,
        Some(Severity::Note) => ACCENT,
        Some(Severity::Warning) => WARNING,
        Some(Severity::Error) => ERROR,
    }
}

impl Theme {
    /// All themes.
    pub const ALL: [Self; 3] = [Self::Dark, Self::Light, Self::Mono];

    /// The name of the theme.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Dark => "dark",
            Self::Light => "light",
            Self::Mono => "mono",
        }
    }

    /// The theme with this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|theme| theme.name() == name)
    }

    /// Gives the cells of a drawn screen the colours of the theme.
    pub(crate) fn apply(self, buffer: &mut Buffer) {
        for cell in &mut buffer.content {
            let (fg, modifier) = self.ink(cell.fg);
            let (bg, _) = self.ink(cell.bg);
            // Reverse video is enough.
            if !cell.modifier.contains(Modifier::REVERSED) {
                cell.modifier |= modifier;
            }
            (cell.fg, cell.bg) = (fg, bg);
        }
    }

    /// The colour for a named one, and attributes that replace it.
    fn ink(self, named: Color) -> (Color, Modifier) {
        let none = Modifier::empty();
        let index = |index| (Color::Indexed(index), none);
        match (self, named) {
            // A grey that is legible on black.
            (Self::Dark, Color::DarkGray) => index(245),
            // The red of many terminals is too dark for text.
            (Self::Dark, Color::Red) => index(203),
            (Self::Light, Color::Cyan) => index(25),
            (Self::Light, Color::DarkGray) => index(242),
            (Self::Light, Color::Green) => index(28),
            (Self::Light, Color::Yellow) => index(94),
            (Self::Light, Color::Red) => index(160),
            (Self::Mono, Color::Cyan | Color::Yellow) => (Color::Reset, Modifier::BOLD),
            (Self::Mono, Color::DarkGray) => (Color::Reset, Modifier::DIM),
            (Self::Mono, Color::Green) => (Color::Reset, none),
            (Self::Mono, Color::Red) => (Color::Reset, Modifier::BOLD.union(Modifier::UNDERLINED)),
            (_, other) => (other, none),
        }
    }

    /// The theme whose dots stand out in a row with this style.
    pub(crate) fn behind(self, row: Style) -> Self {
        match self {
            Self::Dark if row.add_modifier.contains(Modifier::REVERSED) => Self::Light,
            Self::Light if row.add_modifier.contains(Modifier::REVERSED) => Self::Dark,
            theme => theme,
        }
    }

    /// The style of a dot in a colour of the scene, clamped to the displayable range. Colours that
    /// would be lost on the screen are brightened or darkened without changing their hue.
    pub(crate) fn swatch(self, colour: Rgb) -> Style {
        let shown = colour.to_array().map(|channel| channel.clamp(0.0, 1.0));
        let brightest = shown.into_iter().fold(0.0, f64::max);
        let darkest = shown.into_iter().fold(1.0, f64::min);
        let adjusted = match self {
            Self::Dark if brightest == 0.0 => [MIN_BRIGHT; 3],
            Self::Dark => shown.map(|channel| channel * (MIN_BRIGHT / brightest).max(1.0)),
            Self::Light if MAX_PALE < darkest => shown.map(|channel| channel * MAX_PALE / darkest),
            Self::Light => shown,
            Self::Mono => return Style::new(),
        };
        let shown = adjusted.map(|channel| (255.0 * channel).round() as u8);
        Style::new().fg(shown.into())
    }
}

/// Minimum value of the brightest channel of a swatch on a dark screen.
const MIN_BRIGHT: f64 = 0.4;
/// Maximum value of the darkest channel of a swatch on a light screen.
const MAX_PALE: f64 = 0.7;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn swatches_stand_out_and_keep_their_hue() {
        let check = |theme: Theme, [r, g, b]: [f64; 3], [red, green, blue]: [u8; 3]| {
            let style = theme.swatch(Rgb::new(r, g, b));
            assert_eq!(style.fg, Some(Color::Rgb(red, green, blue)));
        };
        check(Theme::Dark, [1.0, 0.5, 0.0], [255, 128, 0]);
        check(Theme::Dark, [0.1, 0.05, 0.0], [102, 51, 0]);
        check(Theme::Dark, [0.0, 0.0, 0.0], [102, 102, 102]);
        check(Theme::Dark, [7.0, 0.0, 0.0], [255, 0, 0]);
        check(Theme::Light, [0.0, 0.0, 0.0], [0, 0, 0]);
        check(Theme::Light, [1.0, 1.0, 1.0], [179, 179, 179]);
        check(Theme::Light, [1.0, 1.0, 0.0], [255, 255, 0]);
        assert_eq!(Theme::Mono.swatch(Rgb::new(1.0, 0.0, 0.0)), Style::new());
    }

    /// The relative luminance of an sRGB colour (Web Content Accessibility Guidelines 2.2).
    fn luminance(colour: [u8; 3]) -> f64 {
        let linear = colour.map(|channel| match f64::from(channel) / 255.0 {
            channel @ ..=0.04045 => channel / 12.92,
            channel => ((channel + 0.055) / 1.055).powf(2.4),
        });
        0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]
    }

    /// The contrast ratio of two colours (Web Content Accessibility Guidelines 2.2).
    fn contrast(one: [u8; 3], other: [u8; 3]) -> f64 {
        let (one, other) = (luminance(one) + 0.05, luminance(other) + 0.05);
        one.max(other) / one.min(other)
    }

    const STYLES: [Style; 5] = [ACCENT, DIM, GOOD, WARNING, ERROR];

    /// A cell with this style in a theme.
    fn shown(theme: Theme, style: Style) -> ratatui::buffer::Cell {
        let mut buffer = Buffer::empty(ratatui::layout::Rect::new(0, 0, 1, 1));
        buffer.set_string(0, 0, "x", style);
        theme.apply(&mut buffer);
        buffer[(0, 0)].clone()
    }

    #[test]
    fn text_is_legible_on_the_screens_that_themes_are_for() {
        for (theme, screen) in [(Theme::Light, [255; 3]), (Theme::Dark, [0; 3])] {
            for style in STYLES {
                let cell = shown(theme, style);
                let ink = crate::terminal::colour_on_screen(cell.fg).expect("a colour");
                let ratio = contrast(ink, screen);
                assert!(4.5 <= ratio, "{theme:?} {style:?}: {ratio}");
                assert_eq!(cell.modifier, style.add_modifier);
            }
        }
    }

    #[test]
    fn parts_of_a_row_under_the_cursor_share_its_background() {
        let background = |style: Style| {
            let cell = shown(Theme::Dark, style);
            let is_reversed = cell.modifier.contains(Modifier::REVERSED);
            if is_reversed { cell.fg } else { cell.bg }
        };
        for row in [CURSOR, Style::new()] {
            for part in STYLES
                .into_iter()
                .chain([Style::new().fg(Color::Rgb(1, 2, 3))])
            {
                let part = within(row, part);
                assert_eq!(background(part), background(row), "{part:?}");
            }
        }
    }

    #[test]
    fn the_monochrome_theme_has_attributes_only() {
        for style in STYLES.into_iter().chain(STYLES.map(chip)) {
            let cell = shown(Theme::Mono, style);
            assert_eq!((cell.fg, cell.bg), (Color::Reset, Color::Reset));
        }
        assert_eq!(shown(Theme::Mono, DIM).modifier, Modifier::DIM);
        let chip = chip(ERROR);
        assert_eq!(shown(Theme::Mono, chip).modifier, chip.add_modifier);
    }

    #[test]
    fn colours_of_pictures_are_left_as_they_are() {
        let (red, grey) = (Color::Rgb(9, 0, 0), Color::Indexed(245));
        for theme in Theme::ALL {
            let cell = shown(theme, Style::new().fg(red).bg(grey));
            assert_eq!((cell.fg, cell.bg), (red, grey));
        }
    }
}
