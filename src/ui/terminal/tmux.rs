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
    /// Columns to the left of the pane and rows above it.
    pub corner: (u16, u16),
}

/// What tmux is asked, by its formats, one a line.
const FORMAT: &str = "#{client_termfeatures}\n#{allow-passthrough}\n#{pane_left}\n#{pane_top}\n\
                      #{status}\n#{status-position}";

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
    Client {
        has_true_colour: features.contains(&"RGB"),
        has_sixel: features.contains(&"sixel"),
        passes_through,
        corner: (left.parse().unwrap_or(0), top.parse().unwrap_or(0) + above),
    }
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
}
