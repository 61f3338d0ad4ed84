//! The sizes of the panels and of the picture.

use crossterm::event::{KeyModifiers, MouseButton, MouseEvent, MouseEventKind};

use super::*;
use crate::language::Node;

fn mouse(app: &mut App, kind: MouseEventKind, (column, row): (u16, u16)) {
    app.update(Msg::Mouse(MouseEvent {
        kind,
        column,
        row,
        modifiers: KeyModifiers::NONE,
    }));
}

#[test]
fn keys_and_mouse_resize_the_panels() {
    let mut app = open(SCENE);
    let before = app.areas();
    press(&mut app, "{");
    assert_eq!(app.areas().list.width, before.list.width + 2);
    press(&mut app, "}}");
    assert_eq!(app.areas().list.width, before.list.width - 2);
    let border = app.areas().border;
    mouse(
        &mut app,
        MouseEventKind::Down(MouseButton::Left),
        (border.x, 9),
    );
    mouse(&mut app, MouseEventKind::Drag(MouseButton::Left), (60, 3));
    assert_eq!(app.areas().border.x, 60);
    mouse(&mut app, MouseEventKind::Up(MouseButton::Left), (60, 3));
    mouse(&mut app, MouseEventKind::Drag(MouseButton::Left), (50, 3));
    assert_eq!(app.areas().border.x, 60, "it was let go");
    press(&mut app, "z{");
    assert_eq!(words(&app), "there are no panels to resize here");
    press(&mut app, "z");
    assert_eq!(app.areas().border.x, 60);
}

#[test]
fn keys_and_mouse_divide_list_and_fields_and_the_sizes_are_kept() {
    let mut app = open(SCENE);
    let before = app.areas();
    let kept =
        |effects: &[Effect]| wants(effects, |effect| matches!(effect, Effect::KeepPanels(_)));
    assert!(kept(&press(&mut app, "<Alt-}>")));
    assert_eq!(app.areas().list.height, before.list.height + 1);
    press(&mut app, "<Alt-{><Alt-{>");
    assert_eq!(app.areas().list.height, before.list.height - 1);
    let divider = app.areas().divider();
    let left = MouseButton::Left;
    mouse(
        &mut app,
        MouseEventKind::Down(left),
        (divider.x + 2, divider.y),
    );
    mouse(&mut app, MouseEventKind::Drag(left), (divider.x + 2, 15));
    mouse(&mut app, MouseEventKind::Up(left), (divider.x + 2, 15));
    assert_eq!(app.areas().fields.y, 15);
    assert!(!kept(&press(&mut app, "j")));
}

#[test]
fn a_click_selects_the_node_on_its_line_and_headings_take_none() {
    let mut app = open(SCENE);
    let list = app.areas().list;
    // Below the title: render, view, ambient, a heading, light 1, a heading, object 1.
    for (line, node) in [
        (7, Node::Object(0)),
        (6, Node::Object(0)),
        (5, Node::Light(0)),
        (4, Node::Light(0)),
        (3, Node::Ambient),
        (40, Node::Ambient),
    ] {
        let at = (list.x + 3, list.y + line);
        mouse(&mut app, MouseEventKind::Down(MouseButton::Left), at);
        assert_eq!(app.cursor.selected(), node, "{line}");
    }
}

#[test]
fn errors_take_lines_from_the_picture_and_return_them() {
    let mut app = open(SCENE);
    app.update(Msg::Resize(80, 24));
    let (cells, size) = app.raster().expect("there is room");
    outside(&mut app, &SCENE.replace("1.5", "-1.5"));
    app.update(Msg::Elapsed(crate::ui::msg::Timer::Settled));
    outside(&mut app, &SCENE.replace("1.5", "-1.5"));
    assert_eq!(app.error_count(), 1);
    let areas = app.areas();
    let (smaller, less) = app.raster().expect("there is room");
    assert!(less.pixels() < size.pixels());
    assert!(smaller.bottom() <= areas.errors.y);
    let panel = app.errors_panel(areas.errors).expect("an error");
    assert_eq!(panel.area, areas.errors);
    assert_eq!(app.pictures.preview.asked, Some((less, None)));
    outside(&mut app, SCENE);
    assert_eq!(app.raster(), Some((cells, size)));
}
