//! What tmux knows about the terminal that it runs in.

use std::process::{Command, Stdio};

/// tmux, and the terminal that it runs in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Client {
    /// Whether 24-bit colours are sent to the terminal.
    pub has_true_colour: bool,
    /// Whether sixel pictures are sent to the terminal.
    pub has_sixel: bool,
    /// Whether wrapped sequences are passed on to the terminal.
    pub passes_through: bool,
    /// The number of the pane, if the terminal shows pictures in place of text that names them.
    pub placeholders: Option<u32>,
    /// Columns to the left of the pane and rows above it.
    pub corner: (u16, u16),
}

/// What tmux is asked, by its formats, one a line.
const FORMAT: &str = "#{client_termfeatures}\n#{allow-passthrough}\n#{pane_left}\n#{pane_top}\n\
                      #{status}\n#{status-position}\n#{pane_id}\n#{client_utf8}\n#{client_termtype}";

/// The first version of kitty that shows pictures in place of text.
const KITTY: (u32, u32) = (0, 28);

/// Whether the process runs in tmux.
pub(crate) fn is_around() -> bool {
    std::env::var_os("TMUX").is_some_and(|value| !value.is_empty())
}

/// Asks tmux; `None` outside tmux or if it does not answer. Runs a program, so never call it on the
/// thread of the interface.
pub(crate) fn client() -> Option<Client> {
    if !is_around() {
        return None;
    }
    let output = Command::new("tmux")
        .args(["display-message", "-p", FORMAT])
        .stdin(Stdio::null())
        .stderr(Stdio::null())
        .output()
        .ok()?;
    let answer = String::from_utf8(output.stdout).ok()?;
    output.status.success().then(|| read(&answer))
}

/// Reads an answer to [`FORMAT`]; an old tmux leaves empty what it does not know.
fn read(answer: &str) -> Client {
    let mut lines = answer.lines().map(str::trim);
    let mut next = || lines.next().unwrap_or_default();
    let features: Vec<_> = next().split(',').collect();
    let passes_through = !matches!(next(), "" | "0" | "off");
    let (left, top) = (next(), next());
    let status = match next() {
        "" | "0" | "off" => 0,
        lines => lines.parse().unwrap_or(1),
    };
    let above = if next() == "top" { status } else { 0 };
    let pane = next().trim_start_matches('%').parse().ok();
    let is_utf8 = next() == "1";
    let has_placeholders = has_placeholders(next());
    Client {
        has_true_colour: features.contains(&"RGB"),
        has_sixel: features.contains(&"sixel"),
        passes_through,
        placeholders: pane.filter(|_| is_utf8 && has_placeholders),
        corner: (left.parse().unwrap_or(0), top.parse().unwrap_or(0) + above),
    }
}

/// Whether a terminal of this name and version shows pictures in place of text. `WezTerm` and Konsole
/// know kitty's protocol without that.
fn has_placeholders(terminal: &str) -> bool {
    let Some(version) = terminal.strip_prefix("kitty(") else {
        return terminal.starts_with("ghostty");
    };
    let mut numbers = version.split('.').map_while(|number| number.parse().ok());
    let version = numbers.next().zip(numbers.next());
    version.is_some_and(|version| KITTY <= version)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn answers_are_read_line_by_line() {
        let client = |true_colour, sixel, through, corner| Client {
            has_true_colour: true_colour,
            has_sixel: sixel,
            passes_through: through,
            corner,
            ..Client::default()
        };
        for (answer, expected) in table! {
            "256,RGB,bpaste,title\n\n0\n0\non\nbottom\n" => client(true, false, false, (0, 0));
            "RGB,sixel\non\n40\n12\non\ntop\n" => client(true, true, true, (40, 13));
            "256,xRGB\noff\n0\n0\n2\ntop\n" => client(false, false, false, (0, 2));
            "sixel\nall\n0\n3\noff\ntop\n" => client(false, true, true, (0, 3));
            "" => Client::default();
        } {
            assert_eq!(read(answer), expected, "{answer}");
        }
    }

    #[test]
    fn only_some_terminals_show_pictures_in_place_of_text() {
        for (terminal, is_utf8, expected) in table! {
            "kitty(0.28.1)", 1 => true;
            "kitty(0.27.1)", 1 => false;
            "kitty(1.0.0)", 1 => true;
            "kitty(0.46.2)", 0 => false;
            "ghostty 1.2.0", 1 => true;
            "WezTerm 20240203-110809", 1 => false;
            "Konsole 23.08.1", 1 => false;
            "tmux 3.5a", 1 => false;
            "", 1 => false;
        } {
            let client = read(&format!(
                "\non\n0\n0\non\nbottom\n%7\n{is_utf8}\n{terminal}\n"
            ));
            assert_eq!(client.placeholders, expected.then_some(7), "{terminal}");
        }
    }
}
