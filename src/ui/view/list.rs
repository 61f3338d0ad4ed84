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

/// Minimum width of a comment, in columns.
const COMMENT: usize = 6;

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
        match swatch {
            // Not reversed with the selected line, so that the dot shows its own colour.
            Some(colour) if is_drawn => row.put("● ", shared.theme.swatch(colour)),
            Some(colour) => row.put("○ ", shared.theme.swatch(colour)),
            None if let Some(sign) = fold => row.put(sign, style),
            None if !is_drawn => row.put("○ ", style),
            None => row.put("  ", style),
        };
        let fold = fold.filter(|_| swatch.is_some()).unwrap_or_default();
        let name = indented(shared, node, fold, usize::from(lines.width));
        let mark = marked.iter().find(|(at, _)| *at == node);
        let end = if mark.is_some() { "! " } else { "" };
        let room = row.room().saturating_sub(end.len());
        let comment = shared.source().comment(node);
        let comment = comment.filter(|_| name.width() + 2 + COMMENT <= room);
        row.put_in(&name, room, style);
        let room = room.saturating_sub(name.width());
        let beside = comment.map_or_else(String::new, |comment| format!("  {}", visible(comment)));
        let beside = format!("{:room$}", shorten(&beside, room));
        row.put_in(&beside, room, style.patch(theme::DIM));
        row.put(end, mark.map_or(style, |(_, mark)| style.patch(*mark)));
    }
}

/// The sign of an object that holds others: whether they are listed.
fn fold_sign(shared: &Shared, node: Node) -> Option<&'static str> {
    match node {
        Node::Object(object) if shared.cursor.rows.is_folded(object) => Some("▸ "),
        Node::Object(object) if shared.source().is_foldable(object) => Some("▾ "),
        _ => None,
    }
}

/// The name of a node after a sign, indented by two columns per level of nesting, up to a third of
/// the width.
fn indented(shared: &Shared, node: Node, sign: &str, width: usize) -> String {
    let indent = (2 * shared.source().depth(node)).min(width / 3);
    format!("{:indent$}{sign}{}", "", shared.source().name(node))
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
    use crate::app::App;
    use crate::view::tests::{app, app_of, drawn, retype};
    use language::{Language, Node};

    fn lines(app: &App, width: u16) -> Vec<String> {
        drawn(&app.shared, super::render, width, 9)
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
            "  ▾ all (group)",
            "  ●   ball (sphere)",
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
    fn a_comment_follows_the_name_if_there_is_room() {
        let mut app = app();
        assert_eq!(lines(&app, 40)[7], "  ● object 1 (sphere)  the first");
        retype(&mut app, "0 5 5   1 1 .5\n", "0 5 5 // sun\n1 1 .5\n");
        retype(&mut app, "box", "box // the\u{1b} large one\n");
        assert_eq!(lines(&app, 32)[5], "  ● light 1  sun");
        assert_eq!(lines(&app, 32)[8], "  ● object 2 (box)  the␛ large …");
    }

    #[test]
    fn a_node_with_an_error_is_marked() {
        let mut app = app();
        retype(&mut app, " 0.25 //", " -0.25 //");
        assert_eq!(lines(&app, 26)[7], "  ● object 1 (sphere)   !");
    }
}
