//! The list of the nodes of a scene, from the render settings to the objects, under headings. Only visible
//! lines are computed.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Modifier, Style};
use unicode_width::UnicodeWidthStr;

use super::row::{Focus, Row, title};
use crate::app::Shared;
use crate::keymap::Mode;
use crate::layout;
use crate::listing::ListLine;
use crate::text_width::{shorten, visible};
use crate::theme;
use language::Node;
use scene::Rgb;

/// The heading of the list.
const TITLE: &str = "scene";

/// Minimum width of the words before what stands at the right edge, in columns.
const LEAST: usize = 12;

/// Draws the list with names and comments.
pub(crate) fn render(shared: &Shared, area: Rect, buffer: &mut Buffer) {
    let selected = shared.selected_row();
    let rows = &shared.cursor.rows;
    let count = rows.count(shared.source());
    let focus = match shared.mode {
        Mode::Select | Mode::Move => Focus::Here,
        _ => Focus::Elsewhere,
    };
    let place = format!("{}/{count}", (rows.place_of(selected) + 1).min(count));
    let place = match shared.cursor.marks.len() {
        0 => place,
        marks => format!("{marks} marked  {place}"),
    };
    title(TITLE, &place, focus, area, buffer);
    if !rows.filter().is_empty() {
        let chip = format!(" /{} {} ", rows.filter(), rows.matches());
        let mut row = Row::new(buffer, area, 0);
        row.skip(TITLE.len() as u16 + 1);
        let room = row.room().saturating_sub(place.len() + 1);
        row.put_in(&chip, room, theme::chip(theme::ACCENT));
    }

    let lines = layout::contents(area);
    let rows = usize::from(lines.height);
    let listing = shared.listing();
    let top = shared.cursor.list_top;
    let top = top.min(listing.len().saturating_sub(rows));
    let marked = marked(shared);
    let shown = (top..listing.len()).take(rows);
    for (line, shown) in shown.filter_map(|line| listing.get(line)).enumerate() {
        let (index, node) = match shown {
            ListLine::Node(index, node) => (index, node),
            ListLine::Heading(words) => {
                Row::new(buffer, lines, line as u16).put(&words, theme::DIM);
                continue;
            }
        };
        let is_selected = index == selected;
        let is_drawn = match node {
            // A group is drawn if its parts are.
            Node::Object(index) => {
                shared.source().drawn(index).is_some() || shared.source().is_group(index)
            }
            _ => true,
        };
        let style = match (is_selected, focus) {
            (true, Focus::Here) => theme::CURSOR.add_modifier(Modifier::BOLD),
            (true, Focus::Elsewhere) => theme::BOLD,
            (false, _) if is_drawn => Style::new(),
            (false, _) => theme::DIM,
        };
        let mut row = Row::new(buffer, lines, line as u16);
        let sign = match (is_selected, shared.cursor.marks.contains(&node)) {
            (true, true) => "▸✓",
            (true, false) => "▸ ",
            (false, true) => " ✓",
            (false, false) => "  ",
        };
        row.put(sign, style);
        let fold = fold_sign(shared, node);
        let swatch = swatch(shared, node);
        let (dot, ink) = match swatch {
            Some(colour) => {
                let dot = if is_drawn { "●" } else { "○" };
                (dot, shared.theme.behind(style).swatch(colour))
            }
            None if let Some(sign) = fold => (sign, Style::new()),
            None => (if is_drawn { " " } else { "○" }, Style::new()),
        };
        row.put(dot, theme::within(style, ink));
        // The gap behind the dot has room for the mark.
        match marked.iter().find(|(at, _)| *at == node) {
            Some((_, mark)) => row.put("!", theme::within(style, *mark)),
            None => row.put(" ", style),
        };
        let fold = fold.filter(|_| swatch.is_some());
        put_name(
            shared,
            node,
            fold,
            usize::from(lines.width),
            style,
            &mut row,
        );
    }
}

/// Writes what a node is called: first the author's words, at the right edge the type and the number that
/// messages call it by.
fn put_name(
    shared: &Shared,
    node: Node,
    fold: Option<&str>,
    width: usize,
    style: Style,
    row: &mut Row,
) {
    let named = Named::of(shared, node);
    let indent = (2 * shared.source().depth(node)).min(width / 3);
    let fold = fold.map_or_else(String::new, |sign| format!("{sign} "));
    let words = format!("{:indent$}{fold}{}", "", named.words);
    let beside = named.beside.map(|beside| format!("  {}", visible(&beside)));
    let beside = beside.unwrap_or_default();
    let room = row.room();
    let left = room.saturating_sub(words.width() + beside.width() + 2);
    let tags = [named.tag.as_str(), named.number.as_str()].into_iter();
    // The number is short enough to take the place of the last words.
    let tag = tags
        .clone()
        .find(|tag| tag.width() <= left)
        .or_else(|| tags.last());
    let tag = tag.filter(|tag| !tag.is_empty() && tag.width() + LEAST <= room);
    let end = tag.map_or(0, |tag| tag.width() + 1);
    let before = room.saturating_sub(end);
    row.put_in(&words, before, style);
    let room = before.saturating_sub(words.width());
    let beside = format!("{:room$}", shorten(&beside, room));
    row.put_in(&beside, room, theme::within(style, theme::DIM));
    if let Some(tag) = tag {
        row.put(&format!(" {tag}"), theme::within(style, theme::DIM));
    }
}

/// What a node is called in the list.
struct Named {
    /// The author's words if there are any, otherwise the program's.
    words: String,
    /// More of the author's words.
    beside: Option<String>,
    /// The program's words, if they are not the first.
    tag: String,
    /// The same in short.
    number: String,
}

impl Named {
    fn of(shared: &Shared, node: Node) -> Self {
        let name = shared.source().name(node);
        let comment = shared.source().comment(node);
        let comment = comment.map(|comment| visible(comment).into_owned());
        let program = node.to_string();
        let number = program.split_once(' ').map(|(_, number)| number.to_owned());
        let (own, kind) = match name
            .strip_suffix(')')
            .and_then(|name| name.rsplit_once(" ("))
        {
            Some((own, kind)) => (own, Some(kind)),
            None => (name.as_str(), None),
        };
        let number = number.filter(|_| own == program);
        match (number, comment) {
            (Some(number), Some(comment)) => Self {
                words: comment,
                beside: None,
                tag: kind.map_or(program, |kind| format!("{kind} {number}")),
                number,
            },
            (None, comment) if let Some(kind) = kind => Self {
                words: own.to_owned(),
                beside: comment,
                tag: kind.to_owned(),
                number: String::new(),
            },
            (_, beside) => Self {
                words: name,
                beside,
                tag: String::new(),
                number: String::new(),
            },
        }
    }
}

/// The sign of an object that holds others: whether they are listed.
fn fold_sign(shared: &Shared, node: Node) -> Option<&'static str> {
    match node {
        Node::Object(object) if shared.cursor.rows.is_folded(object) => Some("▸"),
        Node::Object(object) if shared.source().is_foldable(object) => Some("▾"),
        _ => None,
    }
}

/// Nodes with diagnostics, styled by severity, the most severe first.
fn marked(shared: &Shared) -> Vec<(Node, Style)> {
    let mut found: Vec<_> = shared.diagnostics.iter().collect();
    found.sort_by_key(|found| std::cmp::Reverse(found.severity));
    let marked = found.into_iter().filter_map(|found| {
        let node = shared.source().node_at(found.span)?;
        Some((node, theme::severity(Some(found.severity))))
    });
    marked.collect()
}

/// The colour that identifies a node: the colour of a light, the diffuse colour of an object.
pub(super) fn swatch(shared: &Shared, node: Node) -> Option<Rgb> {
    let scene = shared.scene.as_ref()?;
    match node {
        Node::View | Node::Render | Node::Texture(_) => None,
        Node::Ambient => Some(scene.ambient),
        Node::Background => Some(scene.setting.background.colour),
        Node::Environment => Some(scene.setting.environment.colour),
        Node::Light(index) => Some(scene.lights.get(index)?.colour),
        Node::Material(index) => Some(scene.materials.get(index)?.colour()),
        Node::Object(index) => {
            let material = shared.source().material(index).or_else(|| {
                let drawn = shared.source().drawn(index)?;
                Some(scene.objects.get(drawn as usize)?.material as usize)
            });
            Some(scene.materials.get(material?)?.colour())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::App;
    use crate::theme::Theme;
    use crate::view::tests::{app, app_of, drawn, retype, select};
    use language::Language;
    use ratatui::style::Color;

    fn lines(app: &App, width: u16) -> Vec<String> {
        drawn(&app.shared, render, width, 9)
    }

    #[test]
    fn nested_nodes_are_indented() {
        let app = app_of(
            Language::Xml,
            "<xml><scene><object name='all'><object type='sphere' name='ball'/></object>
            </scene><camera><position z='9'/></camera></xml>",
        );
        let listed = [
            "    render",
            "▸   view",
            "  ● background",
            "  ● environment",
            "2 objects",
            "  ▾ all                  group",
            "  ●   ball              sphere",
        ];
        assert_eq!(lines(&app, 30)[1..8], listed);
    }

    #[test]
    fn nodes_are_listed_and_the_selected_and_marked_ones_stand_out() {
        let mut app = app();
        let listed = [
            "scene ──────────────── 2/6",
            "    render",
            "▸   view",
            "  ● ambient",
            "1 light",
            "  ● light 1",
            "2 objects",
        ];
        assert_eq!(lines(&app, 26)[..7], listed);
        assert_eq!(lines(&app, 26)[8], "  ● object 2 (box)");
        app.shared.cursor.marks = [Node::Light(0), Node::Object(1)].into();
        assert_eq!(lines(&app, 26)[0], "scene ────── 2 marked  2/6");
        assert_eq!(lines(&app, 26)[5], " ✓● light 1");
    }

    #[test]
    fn the_words_of_the_author_come_first() {
        let mut app = app();
        assert_eq!(
            lines(&app, 40)[7],
            "  ● the first                   sphere 1"
        );
        assert_eq!(lines(&app, 24)[7], "  ● the first   sphere 1");
        assert_eq!(lines(&app, 20)[7], "  ● the first      1");
        assert_eq!(lines(&app, 12)[7], "  ● the fir…");
        retype(&mut app, "0 5 5   1 1 .5\n", "0 5 5 // sun\n1 1 .5\n");
        retype(&mut app, "box", "box // the\u{1b} large one\n");
        assert_eq!(lines(&app, 32)[5], "  ● sun                  light 1");
        assert_eq!(lines(&app, 32)[8], "  ● the␛ large one         box 2");
    }

    #[test]
    fn a_node_with_an_error_is_marked() {
        let mut app = app();
        retype(&mut app, " 0.25 //", " -0.25 //");
        assert_eq!(lines(&app, 26)[7], "  ●!the first     sphere 1");
    }

    /// The dot, the mark, the comment and the type keep the background of the row.
    #[test]
    fn the_selected_row_has_one_background() {
        let mut app = app();
        retype(&mut app, " 0.25 //", " -0.25 //");
        retype(&mut app, "0 5 5   1 1 .5\n", "0 5 5   1 1 .5 // sun\n");
        for (mode, node) in [
            (Mode::Select, Node::Object(0)),
            (Mode::Select, Node::Light(0)),
            (Mode::Edit, Node::Object(0)),
        ] {
            select(&mut app, node);
            app.shared.mode = mode;
            for theme in Theme::ALL {
                let mut buffer = Buffer::empty(Rect::new(0, 0, 40, 9));
                render(&app.shared, buffer.area, &mut buffer);
                theme.apply(&mut buffer);
                let row = (1..9).find(|&y| buffer[(0, y)].symbol() == "▸");
                let row = row.expect("the selected row is shown");
                let background = |x: u16| {
                    let cell = &buffer[(x, row)];
                    let is_reversed = cell.modifier.contains(Modifier::REVERSED);
                    if is_reversed { cell.fg } else { cell.bg }
                };
                assert!((0..40).all(|x| background(x) == Color::Reset), "{theme:?}");
                let is_reversed = |x: u16| buffer[(x, row)].modifier.contains(Modifier::REVERSED);
                assert!(
                    (1..40).all(|x| is_reversed(x) == is_reversed(0)),
                    "{theme:?}"
                );
            }
        }
    }
}
