//! The two lines at the bottom: the key hints or a prompt, and the status line.

use std::time::Duration;

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use unicode_width::UnicodeWidthStr;

use super::row::Row;
use super::{comparison, sequence};
use crate::render::Progress;
use crate::text::{counted, percentage};
use crate::ui::app::{App, Message, OnDisk, Prompt, PromptKind, Shared, display, files, text};
use crate::ui::keymap::Mode;
use crate::ui::terminal::ColourDepth;
use crate::ui::text_width::visible;
use crate::ui::{keymap, theme};

/// Draws the prompt, or as many of the current key hints as fit.
pub(crate) fn render_hint(app: &App, area: Rect, buffer: &mut Buffer) {
    let shared = &app.shared;
    if let Some(prompt) = &shared.overlays.prompt {
        render_prompt(prompt, area, buffer);
        return;
    }
    let (hints, lasting) = match shared.typed_line() {
        Some(line) => {
            let hints = keymap::line_hints(line).iter();
            (
                hints.map(|&(key, words)| (key.to_owned(), words)).collect(),
                Vec::new(),
            )
        }
        None => (app.hints(), shared.keymap.lasting_hints(shared.context())),
    };
    let mut row = Row::new(buffer, area, 0);
    row.skip(1);
    let last = room_for(&lasting);
    for hint in &hints {
        if row.room() + 1 < room_for(std::slice::from_ref(hint)) + last {
            break;
        }
        put_hint(&mut row, hint);
    }
    // Their descriptions are the last to go.
    if row.room() + 2 < last {
        for (key, _) in &lasting {
            row.put(key, theme::ACCENT).skip(1);
        }
        return;
    }
    row.skip((row.room() + 2).saturating_sub(last + 1) as u16);
    for hint in &lasting {
        put_hint(&mut row, hint);
    }
}

/// A key and its description in a word or two.
type Hint = (String, &'static str);

/// The cells that hints take, with a gap after each.
fn room_for(hints: &[Hint]) -> usize {
    let widths = hints
        .iter()
        .map(|(key, words)| key.width() + words.width() + 3);
    widths.sum()
}

fn put_hint(row: &mut Row, (key, words): &Hint) {
    row.put(key, theme::ACCENT).put(" ", Style::new());
    row.put(words, theme::DIM).skip(2);
}

/// Draws a line being typed, with its cursor.
pub(crate) fn render_prompt(prompt: &Prompt, area: Rect, buffer: &mut Buffer) {
    let sign = match prompt.kind {
        PromptKind::Command => ":",
        PromptKind::Filter(_) => "/",
        PromptKind::Name => "name: ",
    };
    let blank = " ".repeat(usize::from(area.width));
    Row::new(buffer, area, 0).put(&blank, Style::reset());
    let mut row = Row::new(buffer, area, 0);
    row.put(sign, theme::ACCENT);
    let room = row.room();
    let style = if prompt.is_selected {
        theme::CURSOR
    } else {
        Style::new()
    };
    row.put_input(&prompt.input, room, style, theme::CURSOR);
}

/// A part of the status line, omitted if more important ones need its room.
struct Segment {
    /// Rank of importance; 0 is the highest.
    rank: u8,
    text: String,
    style: Style,
}

/// The message, if the status line cannot show all of it.
pub(crate) fn long_message(app: &App, depth: ColourDepth, width: u16) -> Option<&Message> {
    let shared = &app.shared;
    let message = shared.overlays.message.as_ref()?;
    is_message_long(&segments(app, depth), usize::from(width)).then_some(message)
}

/// Draws the status line. The least important parts are omitted if there is no room, and so is a
/// message that would be cut.
pub(crate) fn render(app: &App, depth: ColourDepth, area: Rect, buffer: &mut Buffer) {
    let mut segments = segments(app, depth);
    let mut row = Row::new(buffer, area, 0);
    if is_message_long(&segments, row.room()) {
        segments.retain(|segment| segment.rank != MESSAGE);
    }
    let fitting = fitting(&segments, row.room());
    for (index, segment) in fitting.iter().enumerate() {
        if 0 < index {
            row.put(" ", Style::new());
            let is_progress = |segment: &Segment| PROGRESS.contains(&segment.rank);
            if is_progress(segment) && is_progress(fitting[index - 1]) {
                row.put("· ", theme::DIM);
            } else if 1 < index && segment.rank != DIRTY {
                row.put(" ", Style::new());
            }
        }
        row.put(&segment.text, segment.style);
    }
}

/// Whether the message would be cut after the more important parts.
fn is_message_long(segments: &[Segment], room: usize) -> bool {
    let ranked = segments.iter().filter(|segment| segment.rank <= MESSAGE);
    let widths = ranked.map(|segment| segment.text.width() + GAP);
    segments.iter().any(|segment| segment.rank == MESSAGE) && room + GAP < widths.sum()
}

/// The segments that fit, in order; the most important ones may be shortened.
fn fitting(segments: &[Segment], room: usize) -> Vec<&Segment> {
    let mut ranked: Vec<usize> = (0..segments.len()).collect();
    ranked.sort_by_key(|&at| segments[at].rank);
    let mut left = room + GAP;
    let mut kept: Vec<usize> = ranked
        .into_iter()
        .filter(|&at| {
            let width = segments[at].text.width() + GAP;
            // A part of an important segment is better than nothing.
            let fits = width <= left || segments[at].rank <= MESSAGE && 2 * GAP < left;
            left -= if fits { width.min(left) } else { 0 };
            fits
        })
        .collect();
    kept.sort_unstable();
    kept.into_iter().map(|at| &segments[at]).collect()
}

/// Maximum number of cells between two segments.
const GAP: usize = 3;

/// Ranks of the segments on the progress of the picture.
const PROGRESS: std::ops::RangeInclusive<u8> = 20..=29;

/// Rank of the mark of unsaved edits, which is placed next to the file name.
const DIRTY: u8 = 2;

/// Rank of messages; segments of a lower rank are always shown.
const MESSAGE: u8 = 4;

fn segments(app: &App, depth: ColourDepth) -> Vec<Segment> {
    let shared = &app.shared;
    let mut all = Vec::new();
    let mut say = |rank, text: String, style| all.push(Segment { rank, text, style });
    text_segments(app, &mut say);
    let still_writing = shared.jobs.still_writing();
    if let Some((path, seconds)) = still_writing {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let text = format!("still writing {name}, {seconds} s");
        say(3, text, theme::WARNING);
    }
    if let Some(export) = shared.jobs.export() {
        let frame = export.reel.map(|reel| format!("frame {} ", reel.place()));
        let frame = frame.unwrap_or_default();
        let queued = match shared.jobs.queued() {
            0 => String::new(),
            queued => format!(", {queued} more queued"),
        };
        let text = format!("export {frame}{}{queued}", percent(export.done()));
        say(6, text, theme::ACCENT);
    }
    if shared.assets.are_awaited() {
        say(7, "reading files".to_owned(), theme::ACCENT);
    }
    if let Some(progress) = shared.picture().progress() {
        progress_segments(progress, &mut say);
    }
    if shared.scene.is_some() {
        making_segment(shared, &mut say);
    }
    if let Some(frame) = &shared.picture().latest {
        let size = format!("{}×{}", frame.size.width, frame.size.height);
        say(30, size, theme::DIM);
        say(31, depth.name().to_owned(), theme::DIM);
    }
    zoom_segment(shared, &mut say);
    if let Some(bytes) = shared.pictures.net {
        say(8, format!("net {} KB/s", bytes.div_ceil(1000)), theme::DIM);
    }
    if let Some(message) = &shared.overlays.message {
        let style = theme::severity(message.severity);
        let more = match shared.overlays.messages.waiting() {
            0 => String::new(),
            waiting => format!(" (+{waiting}, M)"),
        };
        let text = visible(&message.text);
        say(MESSAGE, format!("{text}{more}"), style);
    }
    all
}

/// Adds the mode and the state of the text.
fn text_segments(app: &App, say: &mut impl FnMut(u8, String, Style)) {
    let shared = &app.shared;
    let (mode, style) = if shared.disk.is_opening() {
        ("OPENING", theme::ACCENT)
    } else {
        (shared.mode.name(), mode_style(shared.mode))
    };
    say(0, format!(" {mode} "), theme::chip(style));
    if shared.mode == Mode::Compare {
        comparison::chips(app, say);
    }
    sequence::chips(app, say);
    let errors = shared.error_count();
    let warnings = shared.diagnostics.warnings();
    if 0 < errors {
        let text = format!(" {} ", counted(errors, "error"));
        say(1, text, theme::chip(theme::ERROR));
    }
    say(5, shared.disk.name(), theme::BOLD);
    if text::has_edits(shared) {
        say(DIRTY, "[+]".to_owned(), theme::BOLD);
    }
    let disk = match &shared.disk.state {
        OnDisk::Known => None,
        OnDisk::Changed => Some("[disk changed]"),
        OnDisk::Faulty(_) => Some("[errors on disk]"),
        OnDisk::Unreadable => Some("[cannot read file]"),
        OnDisk::Missing => Some("[file missing]"),
        OnDisk::New => Some("[new]"),
    };
    if let Some(disk) = disk {
        say(3, disk.to_owned(), theme::WARNING);
    }
    if files::polls(shared) {
        say(3, "[polling]".to_owned(), theme::WARNING);
    }
    if files::fails_to_keep(shared) {
        say(3, "[no backup]".to_owned(), theme::WARNING);
    }
    if shared.picture().paused {
        say(3, " PAUSED ".to_owned(), theme::chip(theme::WARNING));
    }
    if shared.pictures.solo.is_some() {
        say(3, " SOLO ".to_owned(), theme::chip(theme::WARNING));
    }
    if shared.pictures.view.is_some() {
        say(7, "view*".to_owned(), theme::WARNING);
    }
    if 0 < warnings {
        say(9, counted(warnings, "warning"), theme::WARNING);
    }
}

/// Adds the auxiliary image shown, or the integrator, with a star if it differs from the scene's.
fn making_segment(shared: &Shared, say: &mut impl FnMut(u8, String, Style)) {
    if shared.wireframe().is_some() {
        say(7, "wireframe".to_owned(), theme::WARNING);
        return;
    }
    if let Some(display) = display::display_name(shared) {
        say(3, format!(" {display} "), theme::chip(theme::WARNING));
    }
    let view = display::view_name(shared);
    if let Some(view) = &view {
        say(7, view.clone(), theme::WARNING);
    }
    if let Some(legend) = display::legend(shared) {
        say(10, legend, theme::DIM);
    }
    if view.is_some() {
        return;
    }
    let name = shared.rendering().integrator().name();
    if shared.is_integrator_changed() {
        say(7, format!("{name}*"), theme::WARNING);
    } else {
        say(28, name.to_owned(), theme::DIM);
    }
    if 0.0 < shared.rendering().noise() {
        say(9, "adaptive, slightly biased".to_owned(), theme::DIM);
    }
    if 0.0 < shared.rendering().clamp() {
        say(9, "clamped, biased".to_owned(), theme::DIM);
    }
}

/// Adds the region being drawn, or the scale of the picture and its place in the window.
fn zoom_segment(shared: &Shared, say: &mut impl FnMut(u8, String, Style)) {
    if let Some(region) = shared.region_drawn() {
        say(6, format!("region {region}"), theme::ACCENT);
        return;
    }
    let viewport = display::viewport(shared);
    if shared.mode != Mode::Trace && viewport.is_fit() {
        return;
    }
    let name = viewport.name();
    let place = display::pixel_in_corner(shared).filter(|_| !viewport.is_fit());
    let place = place.map_or_else(String::new, |[x, y]| format!(" at {x},{y}"));
    say(10, format!("{name}{place}"), theme::ACCENT);
}

fn progress_segments(progress: &Progress, say: &mut impl FnMut(u8, String, Style)) {
    let seconds = progress.elapsed.as_secs_f64();
    if !progress.complete {
        let pass = format!("pass {}/{}", progress.pass, progress.passes);
        say(25, pass, theme::DIM);
    }
    say(21, progress.samples(), Style::new());
    if !progress.complete {
        say(20, percent(progress.done), theme::ACCENT);
    }
    if let Some(noise) = progress.noise {
        say(22, format!("noise {}", percentage(noise)), Style::new());
    }
    if !progress.elapsed.is_zero() {
        say(24, duration(progress.elapsed), Style::new());
    }
    if let Some(left) = time_left(progress) {
        say(23, format!("ETA {}", duration(left)), theme::DIM);
    }
    if 0.0 < seconds && 0 < progress.rays {
        let rate = progress.rays as f64 / seconds / 1e6;
        let digits = usize::from(rate < 10.0);
        say(26, format!("{rate:.digits$} Mray/s"), theme::DIM);
    }
    if 0 < progress.over_budget {
        let text = format!("{} over ray budget", progress.over_budget);
        say(27, text, theme::WARNING);
    }
}

/// Estimates the remaining time at the pace so far. `None` during the first pass, whose coarse
/// samples say little about the others.
fn time_left(progress: &Progress) -> Option<Duration> {
    let known = !progress.elapsed.is_zero()
        && 1 <= progress.spp
        && 0.0 < progress.done
        && !progress.complete;
    let seconds = progress.elapsed.as_secs_f64() * (1.0 - progress.done) / progress.done;
    known.then(|| Duration::try_from_secs_f64(seconds).ok())?
}

fn mode_style(mode: Mode) -> Style {
    match mode {
        Mode::Select | Mode::Inspect => theme::ACCENT,
        Mode::View | Mode::Fly | Mode::Sequence => theme::GOOD,
        Mode::Edit | Mode::Move => theme::WARNING,
        Mode::Trace | Mode::Compare => Style::new(),
    }
}

fn percent(share: f64) -> String {
    // Rounded down: only a complete picture shows 100 %.
    format!("{} %", (100.0 * share).floor())
}

fn duration(time: Duration) -> String {
    let seconds = time.as_secs();
    match seconds {
        0..10 => format!("{:.1} s", time.as_secs_f64()),
        10..60 => format!("{seconds} s"),
        60..3600 => format!("{}:{:02} min", seconds / 60, seconds % 60),
        _ => format!("{}:{:02} h", seconds / 3600, seconds / 60 % 60),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::Language;
    use crate::render::{Aov, Frame};
    use crate::scene::{Integrator, Rendering};
    use crate::ui::app::{Picture, ShownWireframe, Typing};
    use crate::ui::layout::tests::size;
    use crate::ui::view::tests::{app, app_of, drawn, retype, say};
    use tui_input::Input;

    #[test]
    fn the_least_important_segments_are_omitted() {
        let mut app = app();
        retype(&mut app, " 0.25 //", " 0.5 //");
        say(&mut app, None, "took the file's changes");
        let bar = |app: &App, area: Rect, buffer: &mut Buffer| {
            render(app, ColourDepth::TrueColour, area, buffer);
        };
        for (width, line) in [
            (60, " SELECT  test.ray [+]  took the file's changes"),
            (40, " SELECT  [+]  took the file's changes"),
            (25, " SELECT  test.ray [+]"),
            (5, " SEL…"),
        ] {
            assert_eq!(drawn(&app, bar, width, 1), [line]);
        }
        app.shared.disk.state = OnDisk::Unreadable;
        let line = " SELECT  [+]  [cannot read file]";
        assert_eq!(drawn(&app, bar, 40, 1), [line]);
    }

    /// How the picture is made.
    fn making(app: &App) -> String {
        let mut words = Vec::new();
        making_segment(&app.shared, &mut |_, text, _| words.push(text));
        words.join(" · ")
    }

    #[test]
    fn an_integrator_that_differs_from_the_scenes_has_a_star() {
        let mut app = app();
        assert_eq!(making(&app), "whitted");
        app.shared.pictures.rendering.integrator = Some(Integrator::Path);
        assert_eq!(making(&app), "path*");
        app.shared.pictures.aov = Some(Aov::Depth);
        assert_eq!(making(&app), "depth");
        app.shared.pictures.wireframe = Some(ShownWireframe::default());
        assert_eq!(making(&app), "wireframe");
        let paths = "<xml><scene/><camera gamma='sRGB'/></xml>";
        assert_eq!(making(&app_of(Language::Xml, paths)), "path");
    }

    #[test]
    fn settings_that_bias_the_picture_are_named() {
        let mut app = app();
        for (noise, clamp, words) in [
            (Some(0.01), None, "whitted · adaptive, slightly biased"),
            (None, Some(2.0), "whitted · clamped, biased"),
            // 0 turns it off.
            (None, Some(0.0), "whitted"),
        ] {
            app.shared.pictures.rendering = Rendering {
                noise,
                clamp,
                ..Rendering::default()
            };
            assert_eq!(making(&app), words);
        }
    }

    fn progress(progress: &Progress) -> String {
        let mut words = Vec::new();
        progress_segments(progress, &mut |_, text, _| words.push(text));
        words.join(" · ")
    }

    #[test]
    fn progress_is_shown_until_the_picture_is_complete() {
        let mut shown = Progress {
            pass: 3,
            passes: 6,
            spp: 2,
            mean_spp: 2.0,
            done: 0.25,
            elapsed: Duration::from_millis(1500),
            rays: 21_000_000,
            noise: Some(0.0134),
            complete: false,
            ..Frame::drawn(size(1, 1), Vec::new()).progress
        };
        // A quarter took 1.5 s, so three more take 4.5 s; 21 million in 1.5 s are 14 million per
        // second.
        assert_eq!(
            progress(&shown),
            "pass 3/6 · 2 spp · 25 % · noise 1.3 % · 1.5 s · ETA 4.5 s · 14 Mray/s"
        );
        shown.complete = true;
        let expected = "2 spp · noise 1.3 % · 1.5 s · 14 Mray/s";
        assert_eq!(progress(&shown), expected);
    }

    #[test]
    fn adaptive_sampling_tells_the_mean() {
        let mut shown = Frame::drawn(size(1, 1), Vec::new()).progress;
        (shown.spp, shown.mean_spp) = (256, 41.3);
        assert_eq!(progress(&shown), "41 of 256 spp");
    }

    #[test]
    fn the_scale_and_a_pause_are_told() {
        let mut app = app();
        app.shared.terminal = (80, 24);
        let said = |app: &App| {
            let mut words = Vec::new();
            zoom_segment(&app.shared, &mut |_, text, _| words.push(text));
            text_segments(app, &mut |_, text, _| words.push(text.trim().to_owned()));
            words.join(" · ")
        };
        assert!(!said(&app).contains("fit"));
        app.shared.mode = Mode::Trace;
        app.shared.pictures.trace = Some(Picture::default());
        assert!(said(&app).starts_with("fit · TRACE"), "{}", said(&app));
        app.shared.picture_mut().paused = true;
        assert!(said(&app).contains("PAUSED"), "{}", said(&app));
    }

    #[test]
    fn times_are_short() {
        let times = [9, 59, 61, 7260].map(|seconds| duration(Duration::from_secs(seconds)));
        assert_eq!(times, ["9.0 s", "59 s", "1:01 min", "2:01 h"]);
    }

    #[test]
    fn hints_for_help_commands_and_quitting_outlast_all_others() {
        let mut app = app();
        let hint = |app: &App, width| drawn(app, render_hint, width, 1).concat();
        for (width, shown) in [
            (49, " j/k move  Enter edit  ? help  : command  q quit"),
            (40, " j/k move     ? help  : command  q quit"),
            (20, " ? : q"),
        ] {
            assert_eq!(hint(&app, width), shown);
        }
        let wide = hint(&app, 80);
        assert!(wide.starts_with(" j/k move  Enter edit"), "{wide}");
        assert!(wide.ends_with("? help  : command  q quit"), "{wide}");
        app.shared.cursor.typing = Some(Typing::default());
        assert!(hint(&app, 80).starts_with(" Enter keep  Esc cancel  Tab keep, next number"));
        assert_eq!(hint(&app, 30), " Enter keep  Esc cancel");
        app.shared.overlays.prompt = Some(Prompt {
            kind: PromptKind::Command,
            is_selected: false,
            input: Input::new("export a.bmp".to_owned()),
            opened: String::new(),
        });
        // A prompt replaces the keys.
        assert_eq!(hint(&app, 80), ":export a.bmp");
    }
}
