//! The error panel below the picture.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use super::row::{Focus, Row, title};
use crate::app::Shared;
use crate::error_panel::StyledLine;
use crate::framing::clear;
use text::counted;

/// Draws the diagnostics below the picture, if there are any to show.
pub(crate) fn render(shared: &Shared, area: Rect, buffer: &mut Buffer) {
    let Some(panel) = shared.errors_panel(area) else {
        return;
    };
    clear(panel.area.intersection(buffer.area), buffer);
    let count = shared.wrong().findings.len();
    let focus = match shared.overlays.errors {
        Some(_) => Focus::Here,
        None => Focus::Elsewhere,
    };
    title(
        &heading(shared),
        &format!("{}/{count}", (panel.first + 1).min(count)),
        focus,
        panel.area,
        buffer,
    );
    let rows = usize::from(panel.area.height.saturating_sub(1));
    for (index, (_, StyledLine(parts))) in panel.lines.iter().enumerate().take(rows) {
        let mut row = Row::new(buffer, panel.area, index as u16 + 1);
        row.skip(1);
        for (text, style) in parts {
            row.put(text, *style);
        }
    }
}

fn heading(shared: &Shared) -> String {
    let diagnostics = shared.wrong().findings;
    let (errors, warnings, notes) = (
        diagnostics.errors(),
        diagnostics.warnings(),
        diagnostics.notes(),
    );
    if shared.is_disk_wrong() {
        return format!("{} in the file on disk", counted(errors, "error"));
    }
    let kinds = [(errors, "error"), (warnings, "warning"), (notes, "note")];
    let mut parts: Vec<_> = kinds
        .into_iter()
        .filter(|&(count, _)| 0 < count)
        .map(|(count, noun)| counted(count, noun))
        .collect();
    if parts.is_empty() {
        parts.push("no errors or warnings".to_owned());
    }
    if diagnostics.len() < diagnostics.count() {
        parts.push(format!("{} listed", diagnostics.len()));
    }
    parts.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::App;
    use crate::terminal::ColourDepth;
    use crate::view::tests::{app, check_shown, drawn, retype};
    use text::Findings;

    #[test]
    fn an_error_shows_its_position_message_and_hint() {
        let mut app = app();
        retype(&mut app, " 0.25 //", " -0.25 //");
        let radius = app.shared.diagnostics[0].clone();
        app.shared.diagnostics = Findings::default();
        let error = || radius.with_hint("sizes count outward");
        app.shared.diagnostics.error(error);
        let parts = [
            "1 error ─",
            " test.ray:6:18 object 1 (sphere) radius",
            " 6 │ sphere 0 .5 -1e0 -0.25 // the first",
            "   │                  ^^^^^ a number greater than 0",
            "   = hint: sizes count outward",
        ];
        check_shown(&drawn(&app.shared, render, 70, 10), &parts);
    }

    #[test]
    fn errors_that_do_not_fit_are_counted() {
        let mut app = app();
        let wrong = "sphere 0 0 0 -1  0 0 0  0 0 0  0 0 0  1 0 0 1\n".repeat(250);
        retype(&mut app, "box", &format!("{wrong}box"));
        let title = drawn(&app.shared, render, 70, 10).swap_remove(0);
        assert!(title.starts_with("251 errors, 100 listed ─"), "{title}");
        let status = |app: &App, area: Rect, buffer: &mut Buffer| {
            super::super::status::render(app, ColourDepth::TrueColour, area, buffer);
        };
        check_shown(&drawn(&app, status, 70, 1), &[" 251 errors "]);
    }
}
