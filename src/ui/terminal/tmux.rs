//! What tmux knows about the terminal that it runs in.

use std::process::{Command, Stdio};

/// Whether tmux sends 24-bit colours to its terminal; `None` outside tmux or if it does not answer.
/// Runs a program, so never call it on the thread of the interface.
pub(crate) fn shows_true_colour() -> Option<bool> {
    std::env::var_os("TMUX").filter(|value| !value.is_empty())?;
    let output = Command::new("tmux")
        .args(["display-message", "-p", "#{client_termfeatures}"])
        .stdin(Stdio::null())
        .stderr(Stdio::null())
        .output()
        .ok()?;
    let features = String::from_utf8(output.stdout).ok()?;
    output.status.success().then(|| has_true_colour(&features))
}

fn has_true_colour(features: &str) -> bool {
    features.trim().split(',').any(|feature| feature == "RGB")
}

#[cfg(test)]
mod tests {
    use super::has_true_colour;

    #[test]
    fn true_colour_is_found_among_the_features() {
        assert!(has_true_colour("256,RGB,bpaste,title\n"));
        assert!(has_true_colour("RGB"));
        assert!(!has_true_colour("256,bpaste,xRGB"));
        assert!(!has_true_colour(""));
    }
}
