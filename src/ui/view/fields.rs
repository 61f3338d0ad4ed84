//! The fields of the selected node, with the value being typed and an explanation of the selected
//! field.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Modifier, Style};
use unicode_width::UnicodeWidthStr;

use super::list::swatch;
use super::row::{self, Focus, Row};
use crate::app::{FieldRow, Provenance, Shared, Stride, Typing, edit, text as changes};
use crate::framing::clear;
use crate::keymap::Mode;
use crate::layout::marker_at;
use crate::text_width::wrap;
use crate::{layout, theme};
use language::Node;
use language::schema::{Category, Kind};
use scene::Rgb;
use text::{counted, parse_number, without_suffix};

/// Draws the fields of the selected node and a description of the current one.
pub(crate) fn render(shared: &Shared, area: Rect, buffer: &mut Buffer) {
    let focus = match shared.mode {
        Mode::Edit => Focus::Here,
        _ => Focus::Elsewhere,
    };
    let stride = match shared.cursor.stride {
        Stride::Fine => Some("step × 0.1".to_owned()),
        Stride::Plain => None,
        Stride::Coarse => Some("step × 10".to_owned()),
    };
    let selected = shared.cursor.selected();
    let mut name = shared.source().name(selected);
    let others = shared.cursor.marks.len().saturating_sub(1);
    if 0 < others && changes::sets_marked(shared) {
        name = format!("{name} + {others} marked");
    }
    let right = stride
        .or_else(|| users(shared, selected))
        .unwrap_or_default();
    row::title(&name, &right, focus, area, buffer);

    let fields = shared.fields();
    let (lines, notes) = layout::split_fields(area, focus == Focus::Here);
    let rows = usize::from(lines.height);
    let last = fields.len().saturating_sub(rows);
    let top = shared.cursor.field_top.min(last);
    for (index, field) in fields.iter().enumerate().skip(top).take(rows) {
        let line = layout::nth_line(lines, (index - top) as u16);
        let is_current = focus == Focus::Here && index == shared.cursor.field;
        let cursor = is_current.then_some(shared.cursor.component);
        field_line(shared, field, cursor, line, buffer);
        if let Some(bar) = edit::slider(shared, index, line)
            && (cursor.is_none() || shared.cursor.typing.is_none())
        {
            let style = match cursor {
                _ if !field.is_all(Provenance::Text) => theme::DIM,
                Some(_) => theme::ACCENT,
                None => Style::new(),
            };
            slider(field, style, bar, buffer);
        }
        if let Some(found) = shared.field_finding(index) {
            // The last cell of the name is otherwise a gap.
            let (name, _) = layout::field_columns(line, field.literals.len());
            let mut row = Row::new(buffer, name, 0);
            row.skip_to(name.right().saturating_sub(1));
            row.put("!", theme::severity(Some(found.severity)));
        }
    }
    let below = fields.len().saturating_sub(top);
    for (line, (depth, part)) in (below..rows).zip(shared.cursor.parts().iter().copied()) {
        let mut row = Row::new(buffer, lines, line as u16);
        row.skip(1 + 2 * depth.min(usize::from(lines.width)) as u16);
        row.put(&part_name(shared, part), theme::DIM);
    }
    if focus == Focus::Here
        && let Some(field) = fields.get(shared.cursor.field)
    {
        // Below the last field rather than far from it.
        let shown = fields.len().saturating_sub(top) + shared.cursor.parts().len();
        let y = lines.y
            + u16::try_from(shown + 1)
                .unwrap_or(u16::MAX)
                .min(lines.height);
        let height = notes.bottom().saturating_sub(y);
        explain(shared, field, Rect { y, height, ..notes }, buffer);
    }
}

/// What else uses the material or texture that the current field names.
fn users_of(shared: &Shared) -> Option<String> {
    let node = edit::referred_to(shared)?;
    let name = shared.source().name(node);
    Some(format!("{name} {}", users(shared, node)?))
}

/// The number of objects that use a node, if it is a material or texture.
pub(super) fn users(shared: &Shared, node: Node) -> Option<String> {
    let objects = || counted(shared.source().users(node), "object");
    match node {
        Node::Material(_) => Some(format!("colours {}", objects())),
        Node::Texture(_) => Some(format!("on {}", objects())),
        _ => None,
    }
}

/// The name of a part of a combined object, with its operation if it is a combination itself.
fn part_name(shared: &Shared, part: Node) -> String {
    let name = shared.source().name(part);
    let operation = match part {
        Node::Object(object) => shared.source().operation(object),
        _ => None,
    };
    format!("{name} {}", operation.unwrap_or_default())
}

/// Draws a field: its name and its literals in columns, with the one under the cursor marked.
fn field_line(
    shared: &Shared,
    field: &FieldRow,
    cursor: Option<usize>,
    line: Rect,
    buffer: &mut Buffer,
) {
    let (name, columns) = layout::field_columns(line, field.literals.len());
    let mut row = Row::new(buffer, name, 0);
    let selected = cursor.map_or(Style::new(), |_| theme::BOLD);
    row.put(if cursor.is_some() { "▸" } else { " " }, selected);
    row.put_in(field.field.key, row.room().saturating_sub(2), selected);
    row.skip_to(name.right().saturating_sub(2));
    match dot(shared, field) {
        _ if field.is_all(Provenance::WorkingView) => row.put("*", theme::WARNING),
        Some(colour) => row.put("●", shared.theme.swatch(colour)),
        None => row.put(" ", Style::new()),
    };
    let literals = field.literals.iter().zip(&field.sources);
    for (component, ((literal, source), column)) in literals.zip(&columns).enumerate() {
        let style = match source {
            Provenance::Text => Style::new(),
            Provenance::Default | Provenance::Inherited => theme::DIM,
            Provenance::WorkingView => theme::WARNING,
        };
        let mut row = Row::new(buffer, *column, 0);
        // The last cell keeps a gap to the next number.
        let room = row.room().saturating_sub(1);
        let mark = (cursor == Some(component)).then_some(theme::CURSOR);
        row.put_in(literal, room, style.patch(mark.unwrap_or_default()));
        let note = match source {
            Provenance::Default => "  (default)",
            Provenance::Inherited => "  (inherited)",
            Provenance::Text | Provenance::WorkingView => "",
        };
        if note.len() < row.room() {
            row.put(note, style);
        }
    }
    let current = cursor.and_then(|at| Some((at, columns.get(at)?)));
    let Some((component, column)) = current else {
        return;
    };
    if let Some(typing) = &shared.cursor.typing {
        // The last cell keeps a gap to the next number. A long text covers the numbers after it.
        let fits = typing.input.value().width() + 1 < usize::from(column.width);
        let end = if fits { column.right() } else { line.right() };
        let width = end.saturating_sub(column.x + 1);
        typed(typing, Rect { width, ..*column }, buffer);
    } else if let Some(literal) = field.literals.get(component)
        && let Some(area) = layout::widened(&columns, component, literal.width(), line)
    {
        clear(area, buffer);
        let end = area.right().saturating_sub(literal.width() as u16 + 1);
        let mut row = Row::new(buffer, area, 0);
        row.skip_to(column.x.min(end.max(area.x)));
        row.put_in(literal, literal.width(), theme::CURSOR);
    }
}

/// The colour of a field, or of the material that it names.
fn dot(shared: &Shared, field: &FieldRow) -> Option<Rgb> {
    let named = || match (field.field.kind, shared.cursor.selected()) {
        (
            Kind::Reference(Category::Material) | Kind::Name(Category::Material),
            Node::Object(object),
        ) => swatch(shared, Node::Material(shared.source().material(object)?)),
        _ => None,
    };
    field.colour().or_else(named)
}

/// Draws a number from 0 to 1 as a bar.
fn slider(field: &FieldRow, style: Style, bar: Rect, buffer: &mut Buffer) {
    let literal = field.literals.first().map_or("", String::as_str);
    let number = parse_number(without_suffix(literal).unwrap_or(literal));
    let filled = marker_at(bar, number.unwrap_or(0.0)) - bar.x;
    clear(bar, buffer);
    let mut row = Row::new(buffer, bar, 0);
    row.put(&"─".repeat(usize::from(filled)), style);
    row.put("●", style);
    let rest = row.room();
    row.put(&"─".repeat(rest), theme::DIM);
}

/// Draws the value being typed in place of the current one.
pub(super) fn typed(typing: &Typing, area: Rect, buffer: &mut Buffer) {
    clear(area, buffer);
    let style = theme::ACCENT.add_modifier(Modifier::UNDERLINED);
    let mark = typing.is_selected.then_some(theme::CURSOR);
    let style = style.patch(mark.unwrap_or_default());
    let mut row = Row::new(buffer, area, 0);
    let room = row.room();
    row.put_input(&typing.input, room, style, theme::CURSOR);
}

/// Draws below the fields why a value was refused, its valid range, and its effect.
fn explain(shared: &Shared, field: &FieldRow, area: Rect, buffer: &mut Buffer) {
    let width = usize::from(area.width.saturating_sub(1));
    let mut lines: Vec<(String, Style)> = Vec::new();
    let mut say = |text: &str, style| {
        lines.extend(wrap(text, width).into_iter().map(|line| (line, style)));
    };
    let typing = shared.cursor.typing.as_ref();
    if let Some(refused) = typing.and_then(|typing| typing.refused.as_ref()) {
        say(&refused.message, theme::ERROR);
    }
    if let Some(found) = shared.field_finding(shared.cursor.field) {
        let style = theme::severity(Some(found.severity));
        say(&found.message_with_file(), style);
    }
    let names = field.field.kind.component_names();
    let component = names.get(shared.cursor.component).copied();
    let expected = field.field.advice();
    let what = match component.unwrap_or_default() {
        "" => expected,
        component => format!("{component}: {expected}"),
    };
    let unit = match field.field.unit {
        "" => String::new(),
        unit => format!(" {unit}"),
    };
    let nudge = match field.field.kind {
        Kind::Choice(_) | Kind::Reference(_) | Kind::Name(_) => {
            let [list, less, more] =
                ["choose", "nudge-down", "nudge-up"].map(|name| shared.key_for(name));
            format!(" · {list}: list · {less} {more}: next")
        }
        Kind::Word => String::new(),
        _ => format!(" · step {}{unit}", shared.step(field.field)),
    };
    say(&format!("{what}{nudge}"), Style::new());
    if let Some(users) = users_of(shared) {
        say(&users, theme::DIM);
    }
    say(field.field.doc, theme::DIM);
    match field.sources.get(shared.cursor.component) {
        Some(Provenance::Default) => say("Not in the text: this is the default.", theme::DIM),
        Some(Provenance::Inherited) => {
            say("Inherited: a change affects only this object.", theme::DIM);
        }
        Some(Provenance::WorkingView) => {
            say("The working view differs from the text.", theme::WARNING);
        }
        Some(Provenance::Text) | None => {}
    }
    for (index, (line, style)) in (0..area.height).zip(lines) {
        Row::new(buffer, area, index).skip(1).put(&line, style);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::App;
    use crate::view::tests::{app, drawn, retype, select, typing};
    use text::{Diagnostic, Span};

    fn editing(selected: Node) -> App {
        let mut app = app();
        app.shared.mode = Mode::Edit;
        select(&mut app, selected);
        app
    }

    fn lines(app: &App, width: u16) -> Vec<String> {
        drawn(&app.shared, render, width, 20)
    }

    #[test]
    fn literals_are_shown_as_in_the_text_and_missing_ones_as_defaults() {
        let object = lines(&editing(Node::Object(0)), 34);
        assert!(object[0].starts_with("object 1 (sphere) ─"));
        let literals = [
            "▸centre    0      .5     -1e0",
            " radius    0.25",
            " ka      ● 0.1    0.1    0.1",
        ];
        assert_eq!(object[1..4], literals);
        let view = lines(&editing(Node::View), 34);
        assert_eq!(view[4], " fov       45  (default)");
    }

    #[test]
    fn a_refused_value_stays_and_is_explained() {
        let mut app = editing(Node::Object(0));
        app.shared.cursor.field = 1;
        let error = "radius: must be greater than 0";
        let refused = Diagnostic::error(Span::at(0), error, "a number greater than 0");
        app.shared.cursor.typing = Some(Typing {
            refused: Some(refused),
            ..typing("-3")
        });
        let lines = lines(&app, 34);
        assert_eq!(lines[2], "▸radius    -3");
        assert_eq!(lines[11], format!(" {error}"));
        assert!(lines[12].starts_with(" a number greater than 0 · step"));
    }

    #[test]
    fn the_usual_range_is_shown_before_it_is_left() {
        let mut app = editing(Node::Object(0));
        for (field, shown) in [
            (0, " x: a number · step"),
            (2, " red: a number, usually from 0 to 1 · step"),
        ] {
            app.shared.cursor.field = field;
            let line = &lines(&app, 50)[11];
            assert!(line.starts_with(shown), "{line}");
        }
    }

    #[test]
    fn a_warning_is_marked_at_its_field_and_explained_there() {
        let mut app = editing(Node::Object(0));
        let rest = "0.5 0 0  0 0 0  1 0 0 1\nbox";
        retype(&mut app, rest, &rest.replacen("0.5", "1.5", 1));
        app.shared.cursor.field = 3;
        let lines = lines(&app, 50);
        assert!(!lines[3].contains('!'), "{lines:#?}");
        assert!(lines[4].starts_with("▸kd"), "{lines:#?}");
        assert!(lines[4].contains("●!"), "{lines:#?}");
        assert!(lines[11].contains("object 1 (sphere) kd red"), "{lines:#?}");
    }

    /// Other components stay, but a long value covers those after it.
    #[test]
    fn a_component_that_is_typed_takes_the_room_that_it_needs() {
        let mut app = editing(Node::Object(0));
        for (component, text, shown) in [
            (1, "0.123", "▸centre    0      0.123  -1e0"),
            (0, "0.123456789", "▸centre    0.123456789"),
            (1, "0.123456789", "▸centre    0      0.123456789"),
            (2, "0.123456789", "▸centre    0      .5     3456789"),
        ] {
            app.shared.cursor.component = component;
            app.shared.cursor.typing = Some(typing(text));
            assert_eq!(lines(&app, 34)[1], shown);
        }
    }

    #[test]
    fn the_current_value_covers_others_where_it_has_no_room() {
        let mut app = editing(Node::Object(0));
        retype(&mut app, "0 .5 -1e0", "0.2 -0.12345 -3.25e-2");
        for (component, shown) in [
            (0, "▸centre  0.2  -0.… -3.…"),
            (1, "▸centre  0.2  -0.12345"),
            (2, "▸centre  0.2   -3.25e-2"),
        ] {
            app.shared.cursor.component = component;
            assert_eq!(drawn(&app.shared, render, 24, 8)[1], shown, "{component}");
        }
    }

    #[test]
    fn the_cursor_is_on_one_component() {
        let mut app = editing(Node::Object(0));
        app.shared.cursor.component = 1;
        let mut buffer = Buffer::empty(Rect::new(0, 0, 34, 20));
        render(&app.shared, buffer.area, &mut buffer);
        let is_reversed = |&x: &u16| buffer[(x, 1)].modifier.contains(Modifier::REVERSED);
        let reversed: Vec<_> = (0..34).filter(is_reversed).collect();
        assert_eq!(reversed, [18, 19], "the cells of .5");
    }
}
