//! Moving through the list, over the picture and around the scene.

use std::sync::Arc;

use crossterm::event::{MouseButton, MouseEvent, MouseEventKind};

use super::pictures::frame;
use super::*;
use crate::language::Node;
use crate::render::NO_OBJECT;
use crate::scene::{Lens, Size};
use crate::ui::msg::{Target, Timer};

#[test]
fn keys_without_a_meaning_say_where_they_have_one() {
    for (said, answer) in [
        (
            "S",
            "`S` in VIEW (v): write the view into the scene; ? lists keys",
        ),
        (
            "jeo",
            "`o` in SELECT: toggle the outline of the selection; ? lists keys",
        ),
        ("vR", "`R` in SELECT (Enter): rename; ? lists keys"),
        ("vX", "`X` is free in VIEW; ? lists keys"),
        ("<Ctrl-y>", "`Ctrl-Y` is free in SELECT; ? lists keys"),
        ("?X", "`X` is free here"),
        ("je5", ""),
    ] {
        let mut app = open(SCENE);
        press(&mut app, said);
        assert_eq!(words(&app), answer, "{said}");
    }
}

#[test]
fn a_saved_view_is_the_view_on_screen() {
    let mut app = open(SCENE);
    press(&mut app, "vhhk+]");
    let view = app.pictures.view.expect("the camera was moved");
    assert!(!app.document.is_dirty());
    press(&mut app, "S");
    assert!(app.pictures.view.is_none() && app.document.is_dirty());
    assert_eq!(app.scene.as_ref().expect("a scene").camera, view);
    let first = app.document.text().lines().next().expect("a line");
    assert!(first.starts_with("// view: eye "), "{first}");
    press(&mut app, "u");
    assert_eq!(app.document.text(), SCENE);
}

#[test]
fn orbiting_back_nearly_restores_the_view_and_never_crosses_the_pole() {
    let mut app = open(SCENE);
    let own = app.camera().expect("a camera");
    press(&mut app, "vhhll");
    let back = app.camera().expect("a camera");
    assert!((back.eye - own.eye).length() < 1e-3 * own.eye.length());
    press(&mut app, &"k".repeat(60));
    let top = app.camera().expect("a camera");
    let offset = top.eye - top.target;
    assert!(0.9 < offset.normalize().y && offset.y < offset.length());
    press(&mut app, "0");
    assert_eq!(app.pictures.view, None);
}

#[test]
fn missing_parts_of_the_view_are_written_when_they_are_set() {
    let mut app = open(SCENE);
    press(&mut app, "ejjj40<Enter>");
    let scene = app.scene.as_ref().expect("a scene");
    assert_eq!(scene.camera.lens, Lens::Perspective(40.0));
    press(&mut app, "jll");
    assert_eq!(
        app.output(),
        Size {
            width: 820,
            height: 600
        }
    );
    press(&mut app, ":size 64x48<Enter>");
    assert_eq!(
        app.output(),
        Size {
            width: 64,
            height: 48
        }
    );
}

/// Shows a finished preview whose left half is object 1; the right half is empty.
fn show_half(app: &mut App) {
    let size = app.raster().expect("there is room").1;
    let objects = (0..size.pixels() as u32)
        .map(|at| {
            if at % size.width < size.width / 2 {
                1
            } else {
                NO_OBJECT
            }
        })
        .collect();
    app.update(Msg::Frame(Target::Preview, Arc::new(frame(size, objects))));
    app.picture_mut()
        .advance(&FrameWindow::whole(size), &[], usize::MAX);
}

#[test]
fn enter_selects_the_object_under_the_cross() {
    let mut app = open(SCENE);
    show_half(&mut app);
    press(&mut app, "iHH<Enter>");
    assert_eq!(
        (app.mode, app.cursor.selected()),
        (Mode::Select, Node::Object(1))
    );
    press(&mut app, "ggji");
    press(&mut app, &"L".repeat(9));
    press(&mut app, "<Enter>");
    assert_eq!(
        (app.mode, app.cursor.selected()),
        (Mode::Inspect, Node::View)
    );
}

#[test]
fn inspecting_starts_where_the_cross_was_last() {
    let mut app = open(SCENE);
    show_half(&mut app);
    for cross in [[0, 0], [1, 0]] {
        press(&mut app, "i");
        press(&mut app, &"HK".repeat(99));
        press(&mut app, &"l".repeat(cross[0] as usize));
        press(&mut app, "<Esc>i");
        assert_eq!(app.cross().map(|cross| cross.pixel), Some(cross));
        press(&mut app, "<Esc>");
    }
}

#[test]
fn the_first_object_is_selected_at_the_start() {
    assert_eq!(opened(SCENE).0.cursor.selected(), Node::Object(0));
    let mut app = opened(SCENE).0;
    press(&mut app, "el");
    assert_eq!(changed_lines(&app), ["0.1 0 0"]);
    assert_eq!(opened("").0.cursor.selected(), Node::View);
    assert_eq!(opened("1 1 1").0.cursor.selected(), Node::Ambient);
}

#[test]
fn a_search_finds_names_and_comments_and_counts_them() {
    let mut app = open(SCENE);
    press(&mut app, "/SPHERE<Enter>n");
    assert_eq!(words(&app), "2 of 2");
    press(&mut app, "/the light<Enter>");
    assert_eq!(
        (app.cursor.selected(), words(&app)),
        (Node::Light(0), "1 of 1; Esc shows all")
    );
}

#[test]
fn the_list_is_walked_searched_and_cycled() {
    for (said, selected) in [
        ("j", Node::Ambient),
        ("G", Node::Object(1)),
        ("Ggg", Node::Render),
        ("Gg", Node::Object(1)),
        ("<Tab>", Node::Light(0)),
        ("<Tab><Tab><Tab><Tab>", Node::Light(0)),
        ("/sphere<Enter>", Node::Object(0)),
        ("/sphere<Enter>n", Node::Object(1)),
        ("/SPHERE<Enter>N", Node::Object(1)),
        ("/amb<Enter>", Node::Ambient),
        ("/nothing<Enter>", Node::View),
        ("/amb<Esc>", Node::View),
    ] {
        let mut app = open(SCENE);
        press(&mut app, said);
        assert_eq!(app.cursor.selected(), selected, "{said}");
    }
}

#[test]
fn a_scene_that_opens_with_errors_has_no_picture_but_can_be_corrected() {
    let mut app = open("nonsense");
    assert!(app.scene.is_none() && 0 < app.error_count());
    assert!(press(&mut app, "v<F5>pb").is_empty());
    let effects = outside(&mut app, SCENE);
    assert!(wants(&effects, |effect| matches!(
        effect,
        Effect::Trace(..)
    )));
}

#[test]
fn no_key_or_size_panics() {
    let all = "jkgGnN/a\u{1b}evpohlHLJK,.i9+-[]f0S?!xwbruEzmq:y".chars();
    let all: Vec<_> = all.map(|key| KeyEvent::from(KeyCode::Char(key))).collect();
    for text in [SCENE, "", "nonsense", "0 0 0 0 0"] {
        for terminal in [(0, 0), (1, 1), (20, 6), (40, 16), (120, 40)] {
            let mut app = open(text);
            app.update(Msg::Resize(terminal.0, terminal.1));
            for first in &all {
                for second in ["<Esc>", "<Enter>", "<Tab>", "<Down>", "<Right>", "<Back>"] {
                    app.update(Msg::Key(*first));
                    press(&mut app, second);
                }
            }
        }
    }
}

/// The working view stays out of the text when only the picture's size is set.
#[test]
fn setting_the_size_does_not_write_the_working_view() {
    let mut app = open(&format!("// view: fov 40\n{SCENE}"));
    press(&mut app, "vhhh<Esc>ggjejjjjl");
    assert!(app.pictures.view.is_some());
    let first = app.document.text().lines().next();
    assert_eq!(first, Some("// view: fov 40 size 810 600"));
}

/// Presses the mouse button over a cell.
pub(super) fn click(app: &mut App, column: u16, row: u16) {
    app.update(Msg::Mouse(MouseEvent {
        kind: MouseEventKind::Down(MouseButton::Left),
        column,
        row,
        modifiers: KeyModifiers::NONE,
    }));
}

#[test]
fn picking_works_only_for_the_scene_on_screen() {
    let mut app = open(SCENE);
    show_half(&mut app);
    app.update(Msg::Started(Target::Preview, 1));
    let (cells, _) = app.raster().expect("there is room");
    // Without the first sphere the second is object 1, but the picture still shows both.
    let from = SCENE.find("sphere").expect("a sphere");
    let until = SCENE.rfind("sphere").expect("another one");
    let fewer = SCENE.replacen("\n2\n", "\n1\n", 1);
    outside(&mut app, &[&fewer[..from], &fewer[until..]].concat());
    assert_eq!(app.nodes().len(), 5);
    app.update(Msg::Started(Target::Preview, 2));
    let selected = app.cursor.selected();
    click(&mut app, cells.x, cells.y);
    assert_eq!(app.cursor.selected(), selected);
    assert!(words(&app).contains("does not show the changed scene yet"));
    press(&mut app, "i<Enter>");
    assert_eq!((app.mode, app.cursor.selected()), (Mode::Inspect, selected));
}

#[test]
fn a_click_on_an_error_selects_it_and_nothing_below() {
    let broken = SCENE.replacen("1.5 //", "-1.5 //", 1);
    let mut app = open(SCENE);
    show_half(&mut app);
    for _ in 0..2 {
        outside(&mut app, &broken);
        app.update(Msg::Elapsed(Timer::Settled));
    }
    assert_eq!(app.error_count(), 1);
    let (cells, _) = app.raster().expect("there is room");
    click(&mut app, cells.x, cells.y);
    assert!(words(&app).contains("the text has errors"));
    let panel = app.areas().errors;
    let bottom = panel.bottom() - 1;
    press(&mut app, "G");
    click(&mut app, cells.x, bottom);
    assert_eq!(
        (app.cursor.selected(), app.cursor.field),
        (Node::Object(0), 1)
    );
}
