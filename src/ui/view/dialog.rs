//! Questions that must be answered first.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use unicode_width::UnicodeWidthStr;

use super::row::Row;
use crate::app::{App, Dialog, MergeSource, Question, Whose, exports, files, select, text};
use crate::text_width::wrap;
use crate::{framing, layout, theme};
use ::text::Position;
use document::Merge;

/// Minimum width of one side of a conflict, in columns.
const SIDE: usize = 12;

/// Width of a picture from which questions stay inside of it.
const INSIDE: u16 = 40;

/// Draws the open question, if any: inside the picture, if that is wide enough, so that the panels stay
/// whole.
pub(crate) fn render(app: &App, picture: Rect, area: Rect, buffer: &mut Buffer) {
    let shared = &app.shared;
    let question = match &shared.overlays.dialog {
        None => return,
        Some(Dialog::Conflict { merge, at, from }) => {
            conflict(app, merge, *at, from, area, buffer);
            return;
        }
        Some(Dialog::Leave(next)) => files::question_before(shared, next),
        Some(Dialog::Delete(nodes)) => select::question_before_deleting(shared, nodes),
        Some(Dialog::Overwrite(pending)) => exports::question_before_overwriting(pending),
        Some(Dialog::Recover(offer)) => files::question_about_kept(shared, offer),
    };
    let is_wide = INSIDE <= picture.width;
    let area = if is_wide { picture } else { area };
    ask(app, &question, area, buffer);
}

/// Draws a question and the keys that answer it.
fn ask(app: &App, question: &Question, area: Rect, buffer: &mut Buffer) {
    let width = area.width.saturating_sub(4).min(60);
    let lines = wrap(&question.text, usize::from(width.saturating_sub(4)));
    let keys = answers(app, width.saturating_sub(4));
    let height = lines.len() + keys.len() + 3;
    let inner = frame(question.title, (width, height), area, buffer);
    for (index, line) in lines.iter().enumerate() {
        let mut row = Row::new(buffer, inner, index as u16);
        row.skip(1).put(line, Style::new());
    }
    draw_answers(&keys, inner, buffer);
}

/// Draws the conflicts with their decisions, and both texts of the selected one.
fn conflict(
    app: &App,
    merge: &Merge,
    at: usize,
    from: &MergeSource,
    area: Rect,
    buffer: &mut Buffer,
) {
    let width = area.width.saturating_sub(4).min(90);
    let keys = answers(app, width.saturating_sub(4));
    let conflicts = &merge.conflicts;
    let height = conflicts.len() + keys.len() + 4;
    let open = app.shared.buffer.as_ref();
    let editor = open.and_then(|buffer| buffer.followed());
    let (title, theirs) = match from {
        MergeSource::File => match editor {
            None => (" The file changed too ", "file"),
            Some(editor) => (" Changed in the editor too ", editor),
        },
        MergeSource::Kept(..) => (" Recover ", files::text_name(&app.shared)),
    };
    let inner = frame(title, (width, height), area, buffer);
    let (list, _) = layout::split_bottom(inner, keys.len() as u16);
    let who = match editor {
        Some(editor) => format!("You changed these both in {editor} and here."),
        None => format!("The {theirs} and your unsaved edits both changed these."),
    };
    let head = format!("{who} Which do you want to keep?");
    let head = &head;
    Row::new(buffer, list, 0).skip(1).put(head, Style::new());

    let list = layout::contents(list);
    let rows = usize::from(list.height);
    let top = layout::first_shown(0, at, conflicts.len(), rows);
    for (index, conflict) in conflicts.iter().enumerate().skip(top).take(rows) {
        let line = Position::of(app.shared.document.text(), conflict.span.start()).line;
        let mut row = Row::new(buffer, list, (index - top) as u16);
        let here = if index == at {
            theme::BOLD
        } else {
            Style::new()
        };
        row.put(if index == at { "▸ " } else { "  " }, here);
        // What is now at the place of a deletion is not what was deleted.
        let is_deleted = conflict.mine.trim().is_empty();
        let place = text::place_name(&app.shared, conflict.span).filter(|_| !is_deleted);
        let place = place.map_or_else(
            || format!("line {line}"),
            |name| format!("{name} (line {line})"),
        );
        row.put(&format!("{place}: "), here);
        let was = format!("was {}", one_line(&conflict.base));
        let was = Some(was).filter(|_| !conflict.base.trim().is_empty());
        let was = was.filter(|was| was.width() + 2 * SIDE <= row.room());
        let each = (row.room() - was.as_ref().map_or(0, |was| was.width())) / 2;
        for (whose, name) in [(Whose::Mine, "mine"), (Whose::Theirs, theirs)] {
            let side = from.side(whose);
            let text = conflict.text(side);
            let chosen = conflict.decision == Some(side);
            let mark = if chosen { "● " } else { "○ " };
            let style = if chosen { theme::GOOD } else { theme::DIM };
            let room = each.saturating_sub(mark.width() + name.len() + 2);
            row.put(mark, style).put(name, style).skip(1);
            row.put_in(&one_line(text), room, here).skip(1);
        }
        if let Some(was) = was {
            row.put(&was, theme::DIM);
        }
    }
    draw_answers(&keys, inner, buffer);
}

/// Clears and frames the area of a question; returns the area inside the frame.
fn frame(title: &str, size: (u16, usize), area: Rect, buffer: &mut Buffer) -> Rect {
    let height = u16::try_from(size.1).unwrap_or(u16::MAX);
    let area = layout::centred(area, Rect::new(0, 0, size.0, height)).intersection(buffer.area);
    framing::frame(title, "", theme::WARNING, area, buffer)
}

/// A line of keys with their answers.
type Answers = Vec<(String, &'static str)>;

/// The keys that answer, broken into lines of at most `width` cells.
fn answers(app: &App, width: u16) -> Vec<Answers> {
    let mut lines: Vec<Answers> = Vec::new();
    let mut left = 0;
    for (key, words) in app.hints() {
        let room = key.width() + words.width() + 3;
        if lines.is_empty() || left < room {
            left = usize::from(width);
            lines.push(Vec::new());
        }
        if let Some(line) = lines.last_mut() {
            line.push((key, words));
        }
        left = left.saturating_sub(room);
    }
    lines
}

fn draw_answers(lines: &[Answers], area: Rect, buffer: &mut Buffer) {
    let (_, area) = layout::split_bottom(area, lines.len() as u16);
    for (index, line) in lines.iter().enumerate() {
        let mut row = Row::new(buffer, area, index as u16);
        row.skip(1);
        for (key, words) in line {
            row.put(key, theme::ACCENT).put(" ", Style::new());
            row.put(words, Style::new()).skip(2);
        }
    }
}

/// A text on one line, with white space collapsed. An empty side of a conflict is shown as deleted.
fn one_line(text: &str) -> String {
    let words: Vec<_> = text.split_whitespace().take(50).collect();
    if words.is_empty() {
        "(deleted)".to_owned()
    } else {
        words.join(" ")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::AfterLeaving;
    use crate::view::tests::{SCENE, app, ask, check_shown, drawn, retype};
    use document::Side;

    /// Draws the question over a screen without panels.
    fn question(app: &App, area: Rect, buffer: &mut Buffer) {
        render(app, area, area, buffer);
    }

    #[test]
    fn quitting_shows_what_would_be_lost_and_how_to_answer() {
        let mut app = app();
        retype(&mut app, " 0.25 //", " 0.5 //");
        app.shared.overlays.dialog = Some(Dialog::Leave(AfterLeaving::Quit));
        let lines = drawn(&app, question, 80, 24);
        let answers = ["y quit", "w save and quit", "n stay"];
        check_shown(&lines, &["test.ray has unsaved edits"]);
        check_shown(&lines, &answers);
    }

    #[test]
    fn conflicts_show_both_texts_and_the_decision() {
        let but = |old, new| SCENE.replacen(old, new, 1);
        let from = SCENE.find("box").expect("a box");
        let without_box = SCENE[..from].replacen("\n2\n", "\n1\n", 1);
        let moved_box = but("box 0 0 0", "box 0 0 7");
        let (smaller, larger) = (but(" 0.25 //", " 0.5 //"), but(" 0.25 //", " 0.75 //"));
        for (mine, theirs, decision, parts) in table! {
            &smaller, &larger, Some(Side::Theirs) =>
                ["object 1 (sphere) radius (line 6):", "○ mine 0.5", "● file 0.75"];
            &moved_box, &without_box, None =>
                ["object 2 (box)", "○ mine box", "○ file (deleted)"];
            // What was deleted here is not named after what precedes it.
            &without_box, &moved_box, None => ["▸ line ", "○ mine (deleted)", "○ file box"];
        } {
            let mut app = app();
            retype(&mut app, SCENE, mine);
            ask(&mut app, theirs, decision);
            let mut lines = drawn(&app, question, 100, 24);
            lines.retain(|line| line.contains('▸'));
            check_shown(&lines[..1], &parts);
        }
    }
}
