//! Queries about the terminal's colours, and the meaning of the answers.
//!
//! A login over SSH has `TERM=xterm-256color` whatever the terminal can do. Most terminals with
//! 24-bit colours report them when asked for the current colour (DECRQSS) or for terminfo entries
//! (XTGETTCAP); others stay silent. The sequences are xterm's (`ctlseqs`, "Device Control
//! functions").

use std::time::Duration;

use super::Reply;

/// Sets a colour that no palette contains, queries the current colour, resets it, and queries
/// terminfo's two names of 24-bit colour, RGB and Tc.
pub(super) const COLOURS: &[u8] =
    b"\x1b[38:2::49:73:87m\x1bP$qm\x1b\\\x1b[m\x1bP+q524742\x1b\\\x1bP+q5463\x1b\\";

/// Queries the state of synchronized output (DECRQM).
#[cfg(unix)]
pub(super) const MODES: &[u8] = b"\x1b[?2026$p";

/// The channels of the colour set by the query.
const COLOUR: [u16; 3] = [49, 73, 87];

/// The names RGB and Tc in hexadecimal.
const NAMES: [&[u8]; 2] = [b"524742", b"5463"];

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
    cfg!(unix) && !is_screen && !is_known && !is_apple
}

/// Decodes the contents of a device control string.
pub(super) fn answer(string: &[u8]) -> Option<Reply> {
    if let Some(setting) = string.strip_prefix(b"1$r") {
        return shows_colour(setting).then_some(Reply::TrueColour);
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

/// Whether the reported colour is exactly the one set, rather than the nearest of a palette.
fn shows_colour(setting: &[u8]) -> bool {
    let Ok(text) = std::str::from_utf8(setting) else {
        return false;
    };
    let numbers: Vec<u16> = text
        .trim_end_matches('m')
        .split([';', ':'])
        .filter_map(|number| number.parse().ok())
        .collect();
    numbers.windows(COLOUR.len()).any(|part| part == COLOUR)
}

#[cfg(test)]
mod tests {
    use super::*;

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
            let shown = String::from_utf8_lossy(string);
            assert_eq!(
                answer(string),
                expected.then_some(Reply::TrueColour),
                "{shown}"
            );
        }
    }

    #[test]
    fn terminals_that_would_display_the_query_are_not_asked() {
        let asked = |variables: &str| {
            may_ask(|name| {
                let mut pairs = variables
                    .split_whitespace()
                    .filter_map(|p| p.split_once('='));
                let value = pairs.find(|&(known, _)| known == name)?.1;
                Some(value.to_owned())
            })
        };
        for (variables, expected) in [
            ("TERM=xterm-256color", cfg!(unix)),
            ("TERM=xterm", cfg!(unix)),
            ("TERM=screen-256color TMUX=/x,1,0", cfg!(unix)),
            ("TERM=tmux-256color TMUX=/x,1,0", cfg!(unix)),
            ("TERM=screen-256color", false),
            ("TERM=xterm-256color STY=1.pts", false),
            ("TERM=linux", false),
            ("TERM=dumb", false),
            ("TERM=vt100", false),
            ("TERM=xterm-256color TERM_PROGRAM=Apple_Terminal", false),
            ("TERM=", false),
            ("", false),
        ] {
            assert_eq!(asked(variables), expected, "{variables}");
        }
    }
}
