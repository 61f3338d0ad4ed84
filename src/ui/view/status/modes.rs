//! What COMPARE and SEQUENCE say of themselves in the status line.

use super::segments::{Rank, Segments};
use crate::app::{self, App};
use crate::keymap::Mode;
use crate::theme;
use crate::view::comparison;
use text::counted;

/// Adds what is seen of the pictures that are compared and, without a panel, how they differ.
pub(super) fn compare(app: &App, segments: &mut Segments) {
    let view = app.compare.view.name().to_uppercase();
    segments.say(Rank::State, format!(" {view} "), theme::chip(theme::ACCENT));
    if let Some(unlike) = app::compare::unlike(&app.compare, &app.shared) {
        segments.say(Rank::Notice, unlike, theme::WARNING);
    }
    if let Some(found) = app.compare.figures()
        && app.shared.areas().list.is_empty()
    {
        let (psnr, flip) = (found.psnr(), found.flip);
        let differing = counted(found.differing, "pixel");
        let text = format!("{differing} differ, {psnr:.2} dB, FLIP {flip:.5}");
        segments.say(Rank::Work, text, comparison::figures_style(&app.compare));
    }
}

/// Adds the frame that is shown, or that values are keyed at.
pub(super) fn sequence(app: &App, segments: &mut Segments) {
    let Some(open) = &app.sequence.open else {
        return;
    };
    if app.shared.mode == Mode::Sequence {
        let playing = if open.is_playing { "▶ " } else { "" };
        // Tracks number their frames from 0.
        let (frame, place, count) = (open.frame, open.frame + 1, open.last() + 1);
        let text = format!(" {playing}frame {frame} ({place}/{count}) ");
        segments.say(Rank::State, text, theme::chip(theme::ACCENT));
    } else if let Some(key) = app.shared.keymap.key(app.shared.context(), "key") {
        let text = format!("{key} keys frame {}", open.frame);
        segments.say(Rank::Frame, text, theme::DIM);
    }
    if open.is_refused {
        segments.say(Rank::Notice, "[track refused]", theme::WARNING);
    }
}
