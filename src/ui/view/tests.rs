//! The whole screen at every size, and helpers for the tests of the panels.

use std::path::PathBuf;
use std::sync::Arc;

use crossterm::event::KeyCode;
use ratatui::backend::TestBackend;
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::terminal::Terminal;
use tui_input::Input;

use super::{Inks, draw};
use crate::app::{
    AfterLeaving, App, CellImage, Cross, Dialog, FrameWindow, MergeSource, Message, Names, OnDisk,
    Opening, OpeningText, Page, PageFocus, Preferences, Prompt, PromptKind, ShownWireframe, Typing,
    display,
};
use crate::arrange::Zoom;
use crate::keymap::{Context, Mode};
use crate::layout::tests::size;
use crate::msg::{ExportId, Msg};
use crate::recovery::Offer;
use crate::recovery::tests::{damaged, offer};
use crate::terminal::{ColourDepth, Mouse};
use document::{Document, Side};
use language::{Language, Node};
use render::{Frame, NO_OBJECT, Progress};
use scene::Rendering;
use text::{Edit, Severity, Span};

pub(super) const SCENE: &str = "\
// view: eye 0 0 5 size 8 6
.1 .1 .1
1
0 5 5   1 1 .5
2
sphere 0 .5 -1e0 0.25 // the first
0.1 0.1 0.1  0.5 0 0  0 0 0  1 0 0 1
box 0 0 0  1 0 0  0 1 0  0 0 1  1 1 1
0.1 0.1 0.1  0.5 0 0  0 0 0  1 0 0 1
";

/// The interface with [`SCENE`] opened and its view selected.
pub(super) fn app() -> App {
    app_of(Language::Ray, SCENE)
}

/// The interface with a scene opened and its view selected.
pub(super) fn app_of(language: Language, text: &str) -> App {
    let (mut app, _) = App::open(Opening {
        language,
        path: Some(PathBuf::from("somewhere/test").with_extension(language.extension())),
        text: OpeningText::Known(text.to_owned()),
        rendering: Rendering::default(),
        mouse: Mouse::Off,
        preferences: Preferences::default(),
        recent: Vec::new(),
        terminal: (80, 24),
    });
    select(&mut app, Node::View);
    app
}

/// Replaces the first `old` in the text by `new`, as an edit.
pub(super) fn retype(app: &mut App, old: &str, new: &str) {
    let shared = &mut app.shared;
    let at = shared.document.text().find(old).expect("the text has it");
    shared.document.edit(&[Edit {
        span: Span::new(at, at + old.len()),
        text: new.to_owned(),
    }]);
    let lowered = shared.document.lower(&shared.assets.loaded.meshes);
    shared.diagnostics = lowered.expect("there is memory").diagnostics;
    let source = shared.document.source();
    shared.cursor.renew(source, Names::Changed);
}

/// Asks about the conflict between the text and one of the file, which is decided so far as said.
pub(super) fn ask(app: &mut App, theirs: &str, decision: Option<Side>) {
    let document = &app.shared.document;
    let theirs = Document::new(document.language(), theirs.to_owned());
    let merged = document
        .snapshot()
        .merge(theirs, &app.shared.assets.loaded.meshes);
    let merged = merged.expect("there is memory");
    let mut merge = merged.expect_err("both changed the same place");
    merge.conflicts[0].decision = decision;
    app.shared.overlays.dialog = Some(Dialog::Conflict {
        merge,
        at: 0,
        from: MergeSource::File,
    });
}

/// Selects a row of the list.
pub(super) fn select(app: &mut App, node: Node) {
    let source = app.shared.document.source();
    app.shared.cursor.select(node, source);
}

/// Presses the keys of these characters.
pub(super) fn press(app: &mut App, keys: &str) {
    for key in keys.chars() {
        app.update(Msg::Key(KeyCode::Char(key).into()));
    }
}

/// A value that is being typed.
pub(super) fn typing(text: &str) -> Typing {
    Typing {
        input: Input::new(text.to_owned()),
        ..Typing::default()
    }
}

/// Shows a message.
pub(super) fn say(app: &mut App, severity: Option<Severity>, text: &str) {
    app.shared.overlays.message = Some(Message {
        severity,
        text: text.to_owned(),
    });
}

/// Shows a picture with all its pixels at once.
pub(super) fn show(app: &mut App, picture: Arc<Frame>, window: &FrameWindow) {
    let preview = &mut app.shared.pictures.preview;
    preview.take(picture);
    preview.advance(window, &[], usize::MAX);
}

/// Asserts that each part is somewhere in the lines.
#[track_caller]
pub(super) fn check_shown(lines: &[String], parts: &[&str]) {
    let text = lines.join("\n");
    for part in parts {
        assert!(text.contains(part), "{part:?} in\n{text}");
    }
}

/// A panel that draws with inks, which are half blocks.
pub(super) fn inked<S, R>(
    panel: impl Fn(&S, &mut Inks, Rect, &mut Buffer) -> R,
) -> impl Fn(&S, Rect, &mut Buffer) {
    move |state: &S, area, buffer: &mut Buffer| {
        let inks = &mut Inks::for_depth(ColourDepth::TrueColour);
        panel(state, inks, area, buffer);
    }
}

/// The lines of a panel without trailing spaces.
pub(super) fn drawn<S>(
    state: &S,
    panel: impl Fn(&S, Rect, &mut Buffer),
    width: u16,
    height: u16,
) -> Vec<String> {
    let mut buffer = Buffer::empty(Rect::new(0, 0, width, height));
    panel(state, buffer.area, &mut buffer);
    lines(&buffer)
}

pub(super) fn lines(buffer: &Buffer) -> Vec<String> {
    let line = |y| {
        let cells = (0..buffer.area.width).map(|x| buffer[(x, y)].symbol());
        cells.collect::<String>().trim_end().to_owned()
    };
    (0..buffer.area.height).map(line).collect()
}

/// The lines of the whole screen.
fn screen(app: &mut App, width: u16, height: u16) -> Vec<String> {
    app.shared.terminal = (width, height);
    display::follow_wires(&mut app.shared);
    let mut terminal = Terminal::new(TestBackend::new(width, height)).expect("cannot fail");
    let mut inks = Inks::for_depth(ColourDepth::TrueColour);
    let drawn = terminal.draw(|frame| {
        draw(app, &mut inks, frame);
    });
    lines(drawn.expect("cannot fail").buffer)
}

/// A picture without objects, as it is shown.
pub(super) fn cell_image(width: u32, height: u32, pixels: Vec<[u8; 3]>) -> CellImage {
    CellImage {
        size: size(width, height),
        objects: vec![NO_OBJECT; pixels.len()],
        pixels,
        outline: Vec::new(),
    }
}

/// A grey frame with object 1 in its right half.
pub(super) fn frame(width: u32, height: u32) -> Arc<Frame> {
    let object = |at| match at % width {
        column if width / 2 <= column => 1,
        _ => NO_OBJECT,
    };
    let pixels = vec![[100; 3]; size(width, height).pixels()];
    let drawn = Frame::drawn(size(width, height), pixels);
    Arc::new(Frame {
        generation: 1,
        objects: (0..width * height).map(object).collect(),
        progress: Progress {
            passes: 7,
            done: 0.5,
            elapsed: std::time::Duration::from_millis(300),
            rays: 1_000_000,
            over_budget: 3,
            complete: false,
            ..drawn.progress
        },
        ..drawn
    })
}

pub(super) type Change = fn(&mut App);

/// All states of the interface, by name.
const STATES: &[(&str, Change)] = &[
    ("nothing", |_| {}),
    ("picture", |app| {
        show(app, frame(8, 6), &FrameWindow::whole(size(8, 6)));
        select(app, Node::Object(1));
    }),
    ("picture alone", |app| app.shared.zoom = Zoom::Picture),
    ("errors", |app| {
        retype(app, "sphere", "\u{1b}[2Jsphäre 界\t");
        retype(app, "0.5 0 0", "0.5 x -");
        app.shared.disk.state = OnDisk::Unreadable;
    }),
    ("list of errors", |app| {
        retype(app, " 0.25 ", " -1 ");
        app.shared.overlays.errors = Some(7);
    }),
    ("no errors", |app| app.shared.overlays.errors = Some(0)),
    ("nothing at all", |app| {
        retype(app, SCENE, "");
        app.shared.scene = None;
        select(app, Node::Object(9));
        let cursor = &mut app.shared.cursor;
        (cursor.field, cursor.component) = (99, 99);
        (cursor.list_top, cursor.field_top) = (99, 99);
    }),
    ("help", |app| {
        app.shared.overlays.open_page(Page::reading(Context::Help));
    }),
    ("help, far down", |app| {
        let mut page = Page::reading(Context::Help);
        page.filter.at = usize::MAX;
        page.filter.input = Input::new("界 nowhere".to_owned());
        page.focus = PageFocus::Search;
        app.shared.overlays.open_page(page);
    }),
    ("recent scenes", |app| {
        let paths = (0..99).map(|at| format!("/界/{at}.ray"));
        let mut page = Page::of(Context::Recent, "Recent scenes", paths.collect());
        page.filter.at = 98;
        app.shared.overlays.open_page(page);
    }),
    ("quit", |app| {
        app.shared.overlays.dialog = Some(Dialog::Leave(AfterLeaving::Quit));
    }),
    ("wires", |app| {
        app.shared.pictures.wireframe = Some(ShownWireframe::default());
        press(app, "O");
    }),
    ("history", |app| {
        let mut page = Page::reading(Context::Messages);
        page.filter.at = usize::MAX;
        app.shared.overlays.open_page(page);
        app.update(Msg::Failed("界\u{1b}]52;c;界\u{7}".repeat(20)));
    }),
    ("undo history", |app| {
        app.shared.mode = Mode::Select;
        app.shared.has_colours = true;
        select(app, Node::Object(0));
        press(app, "DDduUk");
        assert!(app.shared.overlays.page(Context::History).is_some());
    }),
    ("overwrite", |app| {
        press(app, "b");
        app.update(Msg::Taken(ExportId(1), "it exists".to_owned()));
        assert!(app.shared.overlays.dialog.is_some());
    }),
    ("recover", |app| {
        let text = app.shared.document.shared_text();
        let kept = SCENE.replace(" 0.25 ", " 0.75 ");
        let offer = offer(app.shared.document.language(), &text, SCENE, &kept);
        app.shared.overlays.dialog = Some(Dialog::Recover(Box::new(offer)));
    }),
    ("conflict", |app| {
        retype(app, " 0.25 ", " 0.5 ");
        ask(app, &SCENE.replace(" 0.25 ", " 0.75 "), Some(Side::Mine));
    }),
    ("typing", |app| {
        select(app, Node::Object(0));
        app.shared.cursor.typing = Some(typing(&"1234567890".repeat(4)));
    }),
    ("menu", |app| {
        app.shared.mode = Mode::Select;
        press(app, "as");
        assert!(app.shared.overlays.menu.is_some());
    }),
    ("colour picker", |app| {
        app.shared.mode = Mode::Select;
        select(app, Node::Object(0));
        press(app, "ejjcl");
        assert!(app.shared.overlays.picker.is_some());
    }),
    ("palette", |app| {
        press(app, ":e");
        app.update(Msg::Key(KeyCode::Tab.into()));
    }),
    ("prompt", |app| {
        app.shared.overlays.prompt = Some(Prompt {
            kind: PromptKind::Filter(Node::View),
            is_selected: false,
            input: Input::new("界".repeat(16)).with_cursor(3),
            opened: String::new(),
        });
    }),
    ("message", |app| {
        press(app, "b");
        assert!(app.shared.jobs.export().is_some());
        let text = "界\u{1b}]52;c;界\u{7}".repeat(20);
        say(app, Some(Severity::Warning), &text);
        app.shared.pictures.net = Some(86_000);
        app.shared.pictures.view = app.shared.camera();
        app.shared.disk.state = OnDisk::Changed;
    }),
];

#[test]
fn every_screen_can_be_drawn_at_every_size() {
    use Mode::{Compare, Edit, Inspect, Select, Trace, View};
    let small = (0..=30).flat_map(|width| (0..=12).map(move |height| (width, height)));
    let narrow = [(19, 6), (20, 6), (39, 16), (40, 15), (40, 16)];
    let wide = [(79, 24), (80, 23), (80, 24), (200, 50)];
    let sizes: Vec<_> = small.chain(narrow).chain(wide).collect();
    for (name, change) in STATES {
        for mode in [Select, View, Edit, Trace, Inspect, Compare] {
            let mut app = app();
            app.shared.mode = mode;
            app.shared.inspection.cross = Some(Cross {
                pixel: [3, 300],
                size: size(4, 3),
            });
            change(&mut app);
            for &(width, height) in &sizes {
                let lines = screen(&mut app, width, height);
                let has_control = lines.concat().contains(char::is_control);
                assert!(!has_control, "{name} {mode:?}");
            }
        }
    }
}

/// The words of lines, with one space between them.
fn words(lines: &[String]) -> String {
    let words = lines.iter().flat_map(|line| line.split_whitespace());
    words.collect::<Vec<_>>().join(" ")
}

/// The words of the last line while a field of the first object is edited.
fn last_line((width, height): (u16, u16), field: usize, change: Change) -> String {
    let mut app = app();
    app.shared.mode = Mode::Edit;
    select(&mut app, Node::Object(0));
    (app.shared.cursor.field, app.shared.cursor.component) = (field, usize::from(field != 1));
    change(&mut app);
    let lines = screen(&mut app, width, height);
    words(&lines[lines.len() - 1..])
}

#[test]
fn the_current_field_and_what_is_typed_are_shown_where_there_are_no_panels() {
    let nothing: Change = |_| {};
    let zoom: Change = |app| app.shared.zoom = Zoom::Picture;
    let short: Change = |app| app.shared.cursor.typing = Some(typing("2.75"));
    let long: Change = |app| app.shared.cursor.typing = Some(typing("123456789012345678"));
    for (size, field, change, shown) in [
        ((30, 10), 0, nothing, "EDIT centre 0 .5 -1e0"),
        ((50, 14), 1, nothing, "EDIT test.ray whitted radius 0.25"),
        ((20, 6), 0, nothing, "EDIT centre y .5"),
        ((100, 30), 2, zoom, "…ka 0.1 0.1 0.1"),
        ((40, 12), 0, short, "EDIT centre y 2.75"),
        ((20, 6), 0, long, "…8"),
    ] {
        let line = last_line(size, field, change);
        let end = shown.strip_prefix('…');
        let is_shown = end.map_or(line == shown, |end| line.ends_with(end));
        assert!(is_shown, "{shown}, but {line}");
    }
    let panels = last_line((80, 24), 0, nothing);
    assert!(!panels.contains("centre"), "{panels}");
}

#[test]
fn why_a_value_is_refused_is_shown_where_there_are_no_panels() {
    let mut app = app();
    app.shared.mode = Mode::Edit;
    select(&mut app, Node::Object(0));
    press(&mut app, "j-3");
    app.update(Msg::Key(KeyCode::Enter.into()));
    let lines = screen(&mut app, 40, 12);
    let shown = words(&lines);
    assert!(shown.contains("must be greater than 0"), "{shown}");
    assert!(lines[11].ends_with("radius -3"), "{}", lines[11]);
}

#[test]
fn a_screen_that_is_too_small_shows_a_notice() {
    let mut app = app();
    assert_eq!(screen(&mut app, 19, 3)[1].trim(), "needs 20×6");
    assert_eq!(screen(&mut app, 4, 1), ["nee…"]);
}

#[test]
fn a_message_longer_than_the_status_line_is_shown_in_full() {
    let name = "n".repeat(255);
    for text in [
        "merged the file's changes with your edits: sphere 1 radius; press u to undo the merge",
        "unsaved edits cannot be kept for recovery: /home/somebody/.local/state/halflight/recovery: \
         others may write there; chmod go-w /home/somebody/.local/state/halflight/recovery",
        &format!("{name}.ray: File name too long"),
    ] {
        for width in [20, 40, 80, 150] {
            let mut app = app();
            say(&mut app, Some(Severity::Error), text);
            let lines = screen(&mut app, width, 24);
            let shown: String = lines.concat().split_whitespace().collect();
            let words: String = text.split_whitespace().collect();
            assert!(shown.contains(&words), "{}", lines.join("\n"));
        }
    }
}

#[test]
fn the_changes_in_recovered_edits_are_counted() {
    let shown = |kept: &str, follow: fn(Offer) -> Offer| {
        let mut app = app();
        app.shared.zoom = Zoom::Picture;
        let text = app.shared.document.shared_text();
        let offer = follow(offer(Language::Ray, &text, SCENE, kept));
        app.shared.overlays.dialog = Some(Dialog::Recover(Box::new(offer)));
        words(&[screen(&mut app, 100, 30).join(" ").replace('│', " ")])
    };
    let one = SCENE.replacen(" 0.25 ", " 0.5 ", 1);
    let two = shown(&one.replacen('1', "2", 1), damaged);
    let one = shown(&one, |offer| offer);
    assert!(one.contains("1 place differs from the file"), "{one}");
    assert!(!one.contains("damaged"), "{one}");
    let expected = "2 places differ from the file. Part of their journal is damaged";
    assert!(two.contains(expected), "{two}");
}

#[test]
fn a_picture_that_is_not_being_traced_is_not_announced() {
    let mut app = app();
    for (wanted, words) in [(Some(1), "tracing…"), (None, " no picture ")] {
        app.shared.pictures.preview.wanted = wanted;
        check_shown(&screen(&mut app, 80, 24), &[words]);
    }
}

#[test]
fn errors_mark_the_picture_as_stale_and_are_explained() {
    let mut app = app();
    let size = app.shared.raster().expect("there is room").1;
    show(&mut app, frame(8, 6), &FrameWindow::whole(size));
    retype(&mut app, " 0.25 ", " -1 ");
    let parts = ["STALE", "1 error", "test.ray:6:18", "^^", "SELECT", "[+]"];
    check_shown(&screen(&mut app, 100, 30), &parts);
}

#[test]
fn a_picture_of_another_size_is_scaled_to_its_place() {
    let mut app = app();
    show(&mut app, frame(4, 3), &FrameWindow::whole(size(4, 3)));
    let lines = screen(&mut app, 20, 7);
    // 8:6 in 20×12 pixels is 16×12.
    assert_eq!(lines[0], format!("  {}", "▀".repeat(16)));
    assert_eq!(lines[5], lines[0]);
}

#[test]
fn malformed_xml_is_drawn() {
    for text in ["", "<xml>", "<scene/>"] {
        let mut app = app_of(Language::Xml, text);
        for (width, height) in [(80, 24), (40, 12), (9, 3), (1, 1)] {
            let lines = screen(&mut app, width, height);
            assert_eq!(lines.len(), usize::from(height));
        }
        check_shown(&screen(&mut app, 80, 24), &["error"]);
    }
}
