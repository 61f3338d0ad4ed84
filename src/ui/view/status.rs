//! The two lines at the bottom: the key hints or a prompt, and the status line.

mod hints;
mod modes;
mod picture;
mod segments;
#[cfg(test)]
mod tests;

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;

use super::row::Row;
use crate::app::{App, Message, OnDisk, Shared, display, files, text, trace};
use crate::keymap::Mode;
use crate::msg::Target;
use crate::terminal::ColourDepth;
use crate::text_width::visible;
use crate::theme;
use ::text::counted;
pub(super) use hints::{render_hint, render_prompt};
use segments::{Rank, Segments};

/// The message, if the status line cannot show all of it.
pub(super) fn long_message(app: &App, depth: ColourDepth, width: u16) -> Option<&Message> {
    let message = app.shared.overlays.message.as_ref()?;
    let segments = segments(app, depth);
    segments.cuts_message(usize::from(width)).then_some(message)
}

/// Draws the status line. The least important parts are omitted if there is no room, and so is a
/// message that would be cut.
pub(super) fn render(app: &App, depth: ColourDepth, area: Rect, buffer: &mut Buffer) {
    segments(app, depth).render(&mut Row::new(buffer, area, 0));
}

/// What there is to say, from left to right.
fn segments(app: &App, depth: ColourDepth) -> Segments {
    let shared = &app.shared;
    let mut segments = Segments::default();
    text_segments(app, &mut segments);
    let still_writing = shared.jobs.still_writing();
    if let Some((path, seconds)) = still_writing {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let text = format!("still writing {name}, {seconds} s");
        segments.say(Rank::Notice, text, theme::WARNING);
    }
    if let Some(export) = shared.jobs.export() {
        let frame = export.reel.map(|reel| format!("frame {} ", reel.place()));
        let frame = frame.unwrap_or_default();
        let queued = match shared.jobs.queued() {
            0 => String::new(),
            queued => format!(", {queued} more queued"),
        };
        let text = format!("export {frame}{}{queued}", picture::percent(export.done()));
        segments.say(Rank::Work, text, theme::ACCENT);
    }
    if let Some(trace) = trace::in_background(shared) {
        segments.say(Rank::Work, picture::background(trace), theme::ACCENT);
    }
    if shared.assets.are_awaited() {
        segments.say(Rank::Departure, "reading files", theme::ACCENT);
    }
    if let Some(progress) = shared.picture().progress() {
        let asked = match shared.seen() {
            Target::Preview => shared.rendering().spp(),
            _ => u32::MAX,
        };
        picture::progress(progress, asked, &mut segments);
    }
    if shared.scene.is_some() {
        picture::making(shared, &mut segments);
    }
    if let Some(frame) = &shared.picture().latest {
        let size = format!("{}×{}", frame.size.width, frame.size.height);
        segments.say(Rank::Size, size, theme::DIM);
        segments.say(Rank::Colours, depth.name(), theme::DIM);
    }
    zoom_segment(shared, &mut segments);
    if let Some(bytes) = shared.pictures.net {
        segments.say(
            Rank::Link,
            format!("net {} KB/s", bytes.div_ceil(1000)),
            theme::DIM,
        );
    }
    if let Some(message) = &shared.overlays.message {
        let style = theme::severity(message.severity);
        let more = match shared.overlays.messages.waiting() {
            0 => String::new(),
            waiting => format!(" (+{waiting}, {})", shared.key_for("messages")),
        };
        let text = visible(&message.text);
        segments.say(Rank::Message, format!("{text}{more}"), style);
    }
    segments
}

/// Adds the mode and the state of the text.
fn text_segments(app: &App, segments: &mut Segments) {
    let shared = &app.shared;
    let (mode, style) = if shared.disk.is_opening() {
        ("OPENING", theme::ACCENT)
    } else {
        (shared.mode.name(), mode_style(shared.mode))
    };
    segments.say(Rank::Mode, format!(" {mode} "), theme::chip(style));
    if shared.mode == Mode::Compare {
        modes::compare(app, segments);
    }
    modes::sequence(app, segments);
    let errors = shared.error_count();
    let warnings = shared.diagnostics.warnings();
    if 0 < errors {
        let text = format!(" {} ", counted(errors, "error"));
        segments.say(Rank::State, text, theme::chip(theme::ERROR));
    }
    segments.say(Rank::FileName, shared.disk.name(), theme::BOLD);
    if text::has_edits(shared) {
        segments.say(Rank::Unsaved, "[+]", theme::BOLD);
    }
    if let Some(buffer) = &shared.buffer {
        let mark = if buffer.is_changed { "*" } else { "" };
        let chip = format!("⇄ {}{mark}", visible(&buffer.editor));
        segments.say(Rank::Unsaved, chip, theme::ACCENT);
    }
    let is_followed = shared
        .buffer
        .as_ref()
        .is_some_and(|buffer| buffer.followed().is_some());
    let disk = match &shared.disk.state {
        OnDisk::Known => None,
        OnDisk::Changed if is_followed => Some("[edits differ]"),
        OnDisk::Changed => Some("[disk changed]"),
        OnDisk::Faulty(_) => Some("[errors on disk]"),
        OnDisk::Unreadable => Some("[cannot read file]"),
        OnDisk::Missing => Some("[file missing]"),
        OnDisk::New => Some("[new]"),
    };
    if let Some(disk) = disk {
        segments.say(Rank::Notice, disk, theme::WARNING);
    }
    if files::polls(shared) {
        segments.say(Rank::Notice, "[polling]", theme::WARNING);
    }
    if files::fails_to_keep(shared) {
        segments.say(Rank::Notice, "[no backup]", theme::WARNING);
    }
    if shared.picture().paused {
        segments.say(Rank::Notice, " PAUSED ", theme::chip(theme::WARNING));
    }
    if shared.pictures.solo.is_some() {
        segments.say(Rank::Notice, " SOLO ", theme::chip(theme::WARNING));
    }
    if shared.pictures.view.is_some() {
        segments.say(Rank::Departure, "view*", theme::WARNING);
    }
    if 0 < warnings {
        segments.say(Rank::Caveat, counted(warnings, "warning"), theme::WARNING);
    }
}

/// Adds the region being drawn, or the scale of the picture and its place in the window.
fn zoom_segment(shared: &Shared, segments: &mut Segments) {
    if let Some(region) = shared.region_drawn() {
        segments.say(Rank::Work, format!("region {region}"), theme::ACCENT);
        return;
    }
    let viewport = display::viewport(shared);
    if shared.mode != Mode::Trace && viewport.is_fit() {
        return;
    }
    let name = viewport.name();
    let place = display::pixel_in_corner(shared).filter(|_| !viewport.is_fit());
    let place = place.map_or_else(String::new, |[x, y]| format!(" at {x},{y}"));
    segments.say(Rank::Scale, format!("{name}{place}"), theme::ACCENT);
}

fn mode_style(mode: Mode) -> Style {
    match mode {
        Mode::Select | Mode::Inspect => theme::ACCENT,
        Mode::View | Mode::Fly | Mode::Sequence => theme::GOOD,
        Mode::Edit | Mode::Move => theme::WARNING,
        Mode::Trace | Mode::Compare => Style::new(),
    }
}
