//! The colour depth of the terminal, and the nearest colour at that depth.
//!
//! The depth is initially derived from the environment; a terminal that is queried may report more
//! (see [`query`](super::query)).

use std::{env, io};

use ratatui::style::Color;
use termprofile::{DetectorSettings, EnvVarSource, TermProfile, TermVars};

use super::nearest::{light, nearest_fixed, nearest_of_theme};

/// The colours that a terminal can show, from fewest to most.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum ColourDepth {
    /// No colours, only attributes such as bold and underlined.
    Mono,
    /// The sixteen colours of the terminal's theme.
    Palette16,
    /// The sixteen colours and 240 fixed ones: a 6×6×6 cube and a grey ramp.
    Palette256,
    /// 24-bit colour, with eight bits per channel.
    TrueColour,
}

/// The user's choice of colours.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Choice {
    /// Derived from the environment.
    #[default]
    Auto,
    /// This depth, whatever the environment says.
    Fixed(ColourDepth),
}

impl ColourDepth {
    /// Returns the depth for the standard output of this process.
    pub fn detect(choice: Choice) -> Self {
        Self::detect_from(choice, |name| env::var(name).ok())
    }

    /// Returns the depth for a terminal described by these environment variables.
    ///
    /// Any nonempty value of `NO_COLOR` turns colours off unless the user chose a depth. Inside
    /// tmux, only 256 colours are certain unless `COLORTERM` promises all: tmux accepts all and
    /// reduces them for a client that has fewer.
    pub fn detect_from(choice: Choice, variable: impl Fn(&str) -> Option<String>) -> Self {
        if let Choice::Fixed(depth) = choice {
            return depth;
        }
        let set = |name: &str| variable(name).is_some_and(|value| !value.is_empty());
        if set("NO_COLOR") {
            return Self::Mono;
        }
        let promised = variable("COLORTERM");
        if set("TMUX") && matches!(promised.as_deref(), Some("truecolor" | "24bit")) {
            return Self::TrueColour;
        }
        // tmux would be queried through a child process.
        let settings = DetectorSettings::new().enable_tmux_info(false);
        let mut vars = TermVars::from_source(&Environment(variable), &io::stdout(), settings);
        // The interface runs on nothing else.
        vars.meta.is_terminal = true;
        match TermProfile::detect_with_vars(vars) {
            TermProfile::NoTty | TermProfile::NoColor => Self::Mono,
            TermProfile::Ansi16 => Self::Palette16,
            TermProfile::Ansi256 => Self::Palette256,
            TermProfile::TrueColor => Self::TrueColour,
        }
    }

    /// The name of the depth.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Mono => "no colours",
            Self::Palette16 => "16 colours",
            Self::Palette256 => "256 colours",
            Self::TrueColour => "24-bit",
        }
    }

    /// The name of the depth, with the option for a terminal that shows more.
    pub fn cure(self) -> String {
        format!(
            "{}; if the terminal has 24-bit colour, use --color 24 or COLORTERM=truecolor",
            self.name()
        )
    }

    /// Returns the colour that a terminal of this depth shows for another.
    pub(crate) fn shown(self, colour: Color) -> Color {
        match self.ink(colour) {
            Ink::Default => Color::Reset,
            Ink::Index(index) => Color::Indexed(index),
            Ink::Rgb(red, green, blue) => Color::Rgb(red, green, blue),
        }
    }

    /// Returns the nearest colour at this depth.
    pub(super) fn ink(self, colour: Color) -> Ink {
        let ink = match colour {
            Color::Reset => return Ink::Default,
            Color::Rgb(red, green, blue) => Ink::Rgb(red, green, blue),
            Color::Indexed(index) => Ink::Index(index),
            basic => Ink::Index(basic_index(basic)),
        };
        match (self, ink) {
            (Self::Mono, _) => Ink::Default,
            (Self::Palette256, Ink::Rgb(red, green, blue)) => {
                Ink::Index(nearest_fixed([red, green, blue]))
            }
            (Self::Palette16, Ink::Rgb(red, green, blue)) => {
                Ink::Index(nearest_of_16(nearest_fixed([red, green, blue])))
            }
            (Self::Palette16, Ink::Index(index)) => Ink::Index(nearest_of_16(index)),
            _ => ink,
        }
    }
}

/// The sixteen colours: the mean light of xterm's, the Linux console's, the Tango palette's and
/// Windows' original ones. Pictures made for the mean are closer than chafa's in each of these
/// themes; those made for xterm's alone are not.
pub(crate) const THEME: [[u8; 3]; 16] = [
    [0, 0, 0],
    [180, 0, 0],
    [38, 167, 2],
    [178, 153, 0],
    [23, 51, 181],
    [160, 39, 161],
    [2, 167, 167],
    [202, 202, 202],
    [109, 109, 109],
    [251, 47, 47],
    [83, 248, 49],
    [254, 250, 58],
    [85, 103, 244],
    [238, 78, 237],
    [49, 248, 248],
    [251, 251, 251],
];

/// A colour as sent to the terminal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Ink {
    /// The terminal's default foreground or background, depending on which is set.
    Default,
    /// A palette index; the first sixteen depend on the theme.
    Index(u8),
    /// Red, green and blue, 0 to 255.
    Rgb(u8, u8, u8),
}

/// The light of a colour on a screen that shows [`THEME`]; `None` for the terminal's default.
pub(crate) fn colour_on_screen(colour: Color) -> Option<[u8; 3]> {
    match ColourDepth::TrueColour.ink(colour) {
        Ink::Default => None,
        Ink::Index(index) => Some(light(index, &THEME)),
        Ink::Rgb(red, green, blue) => Some([red, green, blue]),
    }
}

fn nearest_of_16(index: u8) -> u8 {
    match index {
        0..16 => index,
        _ => nearest_of_theme(light(index, &THEME), &THEME),
    }
}

fn basic_index(colour: Color) -> u8 {
    const BASIC: [Color; 16] = [
        Color::Black,
        Color::Red,
        Color::Green,
        Color::Yellow,
        Color::Blue,
        Color::Magenta,
        Color::Cyan,
        Color::Gray,
        Color::DarkGray,
        Color::LightRed,
        Color::LightGreen,
        Color::LightYellow,
        Color::LightBlue,
        Color::LightMagenta,
        Color::LightCyan,
        Color::White,
    ];
    BASIC.iter().position(|&basic| basic == colour).unwrap_or(7) as u8
}

struct Environment<F>(F);

impl<F: Fn(&str) -> Option<String>> EnvVarSource for Environment<F> {
    fn var(&self, key: &str) -> Option<String> {
        (self.0)(key)
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// The values of variables in a text such as `TERM=xterm COLORTERM=`.
    pub(crate) fn environment(variables: &str) -> impl Fn(&str) -> Option<String> {
        move |asked| {
            let mut pairs = variables.split(' ').filter_map(|pair| pair.split_once('='));
            let (_, value) = pairs.find(|&(name, _)| name == asked)?;
            Some(value.to_owned())
        }
    }

    #[test]
    fn the_depth_follows_the_environment() {
        use ColourDepth::{Mono, Palette16, Palette256, TrueColour};
        for (choice, variables, depth) in table! {
            Choice::Auto, "TERM=xterm-256color COLORTERM=truecolor" => TrueColour;
            Choice::Auto, "TERM=xterm-256color" => Palette256;
            Choice::Auto, "TERM=xterm-kitty" => TrueColour;
            Choice::Auto, "TERM=linux" => Palette16;
            Choice::Auto, "TERM=dumb" => Mono;
            Choice::Auto, "TERM=tmux-256color TMUX=/x,1,0" => Palette256;
            Choice::Auto, "TERM=screen-256color TMUX=/x,1,0 COLORTERM=truecolor" => TrueColour;
            Choice::Auto, "TERM=tmux-256color TMUX=/x,1,0 COLORTERM=24bit" => TrueColour;
            Choice::Auto, "TERM=tmux-256color TMUX=/x,1,0 COLORTERM=yes" => Palette256;
            Choice::Auto, "TERM=xterm-256color TERM_PROGRAM=Apple_Terminal" => Palette256;
            Choice::Auto, "TERM=xterm-256color COLORTERM=truecolor NO_COLOR=0" => Mono;
            Choice::Auto, "TERM=xterm-256color COLORTERM=truecolor NO_COLOR=" => TrueColour;
            // The user's choice overrides the environment.
            Choice::Fixed(Palette256), "TERM=dumb NO_COLOR=1" => Palette256;
        } {
            let found = ColourDepth::detect_from(choice, environment(variables));
            assert_eq!(found, depth, "{variables}");
        }
    }

    #[test]
    fn colours_map_to_the_nearest_of_the_depth() {
        use ColourDepth::{Mono, Palette16, Palette256, TrueColour};
        let [red, grey] = [Color::Rgb(255, 0, 0), Color::Rgb(128, 128, 128)];
        for (depth, colour, ink) in [
            (TrueColour, red, Ink::Rgb(255, 0, 0)),
            (Palette256, red, Ink::Index(196)),
            (Palette256, grey, Ink::Index(244)),
            (Palette256, Color::LightBlue, Ink::Index(12)),
            (Palette16, red, Ink::Index(9)),
            (Palette16, Color::Indexed(196), Ink::Index(9)),
            (Palette16, Color::Gray, Ink::Index(7)),
            (Mono, red, Ink::Default),
            (TrueColour, Color::Reset, Ink::Default),
        ] {
            assert_eq!(depth.ink(colour), ink, "{depth:?} {colour:?}");
        }
    }
}
