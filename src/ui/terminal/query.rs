//! Queries about the terminal's colours, pictures and keys, and the meaning of the answers.
//!
//! A login over SSH has `TERM=xterm-256color` whatever the terminal can do. Most terminals with
//! 24-bit colours report them when asked for the current colour (DECRQSS) or for terminfo entries
//! (XTGETTCAP); others stay silent. The sequences are xterm's (`ctlseqs`, "Device Control
//! functions").

use std::time::Duration;

use super::graphics::{self, Protocol};
use super::{Reply, tmux};

/// Sets a colour that no palette contains, queries the current colour, resets it, and queries
/// terminfo's two names of 24-bit colour, RGB and Tc.
pub(super) const COLOURS: &[u8] =
    b"\x1b[38:2::49:73:87m\x1bP$qm\x1b\\\x1b[m\x1bP+q524742\x1b\\\x1bP+q5463\x1b\\";

/// Queries the state of synchronized output (DECRQM).
pub(super) const MODES: &[u8] = b"\x1b[?2026$p";

/// The channels of the colour set by the query.
const COLOUR: [u16; 3] = [49, 73, 87];

/// The names RGB and Tc in hexadecimal.
const NAMES: [&[u8]; 2] = [b"524742", b"5463"];

/// Queries the name of the terminal (XTVERSION) and the size of a cell (XTWINOPS). tmux would take
/// kitty's query for the title of a window.
const NAME_AND_CELL: &[u8] = b"\x1b[>q\x1b[16t";

/// The same and whether the terminal knows kitty's protocol.
const PICTURES: &[u8] = b"\x1b_Gi=31,s=1,v=1,a=q,t=d,f=24;AAAA\x1b\\\x1b[>q\x1b[16t";

/// Names of terminals that show pictures in iTerm2's way and do not say so otherwise.
const ITERM: [&[u8]; 3] = [b"iTerm2", b"WezTerm", b"mintty"];

/// The longest side of a cell that is believed, in pixels.
const LARGEST_CELL: u16 = 256;

/// What is asked of the terminal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Question {
    /// Whether it shows 24-bit colours.
    Colours,
    /// How it shows pictures.
    Pictures,
    /// Whether it can keep the Esc key apart from the beginnings of sequences.
    Keys,
}

impl Question {
    pub(super) fn query(self) -> &'static [u8] {
        match self {
            Self::Colours => COLOURS,
            Self::Pictures => pictures(),
            Self::Keys => KEYS,
        }
    }
}

/// Queries how the terminal shows pictures.
pub(super) fn pictures() -> &'static [u8] {
    if tmux::is_around() {
        NAME_AND_CELL
    } else {
        PICTURES
    }
}

/// Queries the flags of kitty's keyboard protocol.
const KEYS: &[u8] = b"\x1b[?u";

/// Queries the device attributes (DA1), which every terminal answers.
pub(super) const ATTRIBUTES: &[u8] = b"\x1b[c";

/// Time limit for answers. Later ones are read and ignored.
pub(crate) const PATIENCE: Duration = Duration::from_millis(200);

/// Terminals, by the first part of `TERM`, that would display a query as text or are known to have
/// few colours. GNU screen forwards device control strings without their introducer.
const NOT_ASKED: [&str; 10] = [
    "ansi", "cons25", "dumb", "eterm", "linux", "screen", "sun", "wsvt25", "vt100", "vt220",
];

/// Whether a terminal described by these environment variables may be queried.
pub(crate) fn may_ask(variable: impl Fn(&str) -> Option<String>) -> bool {
    let set = |name: &str| variable(name).filter(|value| !value.is_empty());
    let Some(term) = set("TERM") else {
        return false;
    };
    let name = term.split(['-', '.', '+']).next().unwrap_or_default();
    let in_tmux = set("TMUX").is_some();
    let is_screen = !in_tmux && set("STY").is_some();
    let is_known = NOT_ASKED.contains(&name) && !(in_tmux && name == "screen");
    let is_apple = !in_tmux && set("TERM_PROGRAM").as_deref() == Some("Apple_Terminal");
    !is_screen && !is_known && !is_apple
}

/// Decodes the contents of a device control string.
pub(super) fn answer(string: &[u8]) -> Option<Reply> {
    if let Some(setting) = string.strip_prefix(b"1$r") {
        return shows_colour(setting).then_some(Reply::TrueColour);
    }
    if let Some(name) = string.strip_prefix(b">|") {
        let is_known = ITERM.iter().any(|known| name.starts_with(known));
        return is_known.then_some(Reply::Shows(Protocol::Iterm));
    }
    let capability = string.strip_prefix(b"1+r")?;
    let mut parts = capability.splitn(2, |&byte| byte == b'=');
    let name = parts.next()?;
    let value = parts.next().unwrap_or_default();
    // The value of RGB, if any, is the number of bits per channel as hexadecimal character codes:
    // `8` is 38.
    let is_wide = value.is_empty() || value.starts_with(b"38");
    let is_asked = NAMES.contains(&name);
    (is_asked && is_wide).then_some(Reply::TrueColour)
}

/// Decodes the contents of an application program command.
pub(super) fn command(string: &[u8]) -> Option<Reply> {
    graphics::answers(string).then_some(Reply::Shows(Protocol::Kitty))
}

/// Decodes device attributes: 4 stands for sixel pictures.
pub(super) fn attributes(numbers: &[u16]) -> Reply {
    match numbers {
        // The first one is the class of the terminal.
        [_, extensions @ ..] if extensions.contains(&4) => Reply::AttributesWithSixel,
        _ => Reply::Attributes,
    }
}

/// Decodes a report of the window: 6 introduces the size of a cell, height before width.
pub(super) fn window(numbers: &[u16]) -> Option<Reply> {
    let &[6, height, width] = numbers else {
        return None;
    };
    let is_plausible = |side: u16| (1..=LARGEST_CELL).contains(&side);
    (is_plausible(width) && is_plausible(height)).then_some(Reply::CellSize { width, height })
}

/// Whether the reported colour is exactly the one set, rather than the nearest of a palette.
fn shows_colour(setting: &[u8]) -> bool {
    let text = std::str::from_utf8(setting).unwrap_or_default();
    let numbers = text.trim_end_matches('m').split([';', ':']);
    let numbers: Vec<u16> = numbers.filter_map(|number| number.parse().ok()).collect();
    numbers.windows(COLOUR.len()).any(|part| part == COLOUR)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::terminal::environment;

    #[test]
    fn only_the_exact_colour_means_24_bit() {
        for (string, expected) in [
            (&b"1$r0;38:2::49:73:87m"[..], true),
            (b"1$r0;38;2;49;73;87m", true),
            (b"1$r38:2:0:49:73:87m", true),
            (b"1$r0;38:5:239m", false),
            (b"1$r0m", false),
            (b"0$r", false),
            (b"1+r524742=38", true),
            (b"1+r524742=382F382F38", true),
            (b"1+r524742", true),
            (b"1+r5463", true),
            (b"1+r524742=35", false),
            (b"1+r436F=323536", false),
            (b"0+r524742", false),
            (b"", false),
        ] {
            let expected = expected.then_some(Reply::TrueColour);
            assert_eq!(answer(string), expected, "{}", string.escape_ascii());
        }
    }

    #[test]
    fn answers_about_pictures_are_understood() {
        let iterm = Some(Reply::Shows(Protocol::Iterm));
        assert_eq!(answer(b">|iTerm2 3.5.10"), iterm);
        assert_eq!(answer(b">|WezTerm 20240203-110809"), iterm);
        assert_eq!(answer(b">|XTerm(390)"), None);
        assert_eq!(command(b"Gi=31;OK"), Some(Reply::Shows(Protocol::Kitty)));
        assert_eq!(command(b"Gi=31;EINVAL"), None);
        assert_eq!(attributes(&[62, 4, 22]), Reply::AttributesWithSixel);
        for numbers in [&[62, 22][..], &[4], &[]] {
            assert_eq!(attributes(numbers), Reply::Attributes);
        }
        let (width, height) = (9, 20);
        assert_eq!(window(&[6, 20, 9]), Some(Reply::CellSize { width, height }));
        for numbers in [&[6, 0, 9][..], &[6, 20, 9999], &[4, 600, 800], &[6, 20]] {
            assert_eq!(window(numbers), None);
        }
    }

    #[test]
    fn terminals_that_would_display_the_query_are_not_asked() {
        for (variables, expected) in [
            ("TERM=xterm-256color", true),
            ("TERM=xterm", true),
            ("TERM=screen-256color TMUX=/x,1,0", true),
            ("TERM=tmux-256color TMUX=/x,1,0", true),
            ("TERM=screen-256color", false),
            ("TERM=xterm-256color STY=1.pts", false),
            ("TERM=linux", false),
            ("TERM=dumb", false),
            ("TERM=vt100", false),
            ("TERM=xterm-256color TERM_PROGRAM=Apple_Terminal", false),
            ("TERM=", false),
            ("", false),
        ] {
            let is_asked = may_ask(environment(variables));
            assert_eq!(is_asked, expected, "{variables}");
        }
    }
}
