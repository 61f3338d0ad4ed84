//! The whole screen at every size, and helpers for the tests of the panels.

use std::path::PathBuf;
use std::sync::Arc;

use crossterm::event::KeyCode;
use ratatui::Terminal;
use ratatui::backend::TestBackend;
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use tui_input::Input;

use super::{Inks, draw};
use crate::document::{Document, Merge, Side};
use crate::language::{Language, Node};
use crate::render::{Frame, NO_OBJECT, Overexposure, Progress};
use crate::scene::{Rendering, Size};
use crate::text::{Edit, Severity, Span};
use crate::ui::app::{
    AfterLeaving, App, Cross, Dialog, Export, FrameWindow, Help, List, MergeSource, Message, Names,
    OnDisk, Opening, OpeningText, Page, PageFocus, Preferences, Prompt, PromptKind, ShownWireframe,
    Stage, Typing, display, history,
};
use crate::ui::arrange::Zoom;
use crate::ui::keymap::Mode;
use crate::ui::msg::{Destination, Existing, ExportId, Msg};
use crate::ui::recovery::Offer;
use crate::ui::recovery::tests::{damaged, offer};
use crate::ui::terminal::{ColourDepth, Mouse};

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
    let at = app
        .shared
        .document
        .text()
        .find(old)
        .expect("the text has it");
    app.shared.document.edit(&[Edit {
        span: Span::new(at, at + old.len()),
        text: new.to_owned(),
    }]);
    let lowered = app
        .shared
        .document
        .lower(&app.shared.assets.meshes)
        .expect("there is memory");
    app.shared.diagnostics = lowered.diagnostics;
    app.shared
        .cursor
        .renew(app.shared.document.source(), Names::Changed);
}

/// The conflict between the text and a text from outside.
pub(super) fn conflict(app: &App, theirs: &str) -> Merge {
    let theirs = Document::new(app.shared.document.language(), theirs.to_owned());
    let merged = app
        .shared
        .document
        .snapshot()
        .merge(theirs, &app.shared.assets.meshes);
    let merged = merged.expect("there is memory");
    merged.expect_err("both changed the same place")
}

/// Selects a row of the list.
pub(super) fn select(app: &mut App, node: Node) {
    let source = app.shared.document.source();
    app.shared.cursor.select(node, source);
}

/// The lines of a panel without trailing spaces.
pub(super) fn drawn<S>(
    state: &S,
    panel: impl Fn(&S, Rect, &mut Buffer),
    width: u16,
    height: u16,
) -> Vec<String> {
    let area = Rect::new(0, 0, width, height);
    let mut buffer = Buffer::empty(area);
    panel(state, area, &mut buffer);
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
    terminal
        .draw(|frame| {
            draw(app, &mut Inks::for_depth(ColourDepth::TrueColour), frame);
        })
        .expect("cannot fail");
    lines(terminal.backend().buffer())
}

/// A grey frame with object 1 in its right half.
pub(super) fn frame(width: u32, height: u32) -> Arc<Frame> {
    let size = Size { width, height };
    let under = |at: u32| u32::from(width / 2 <= at % width);
    Arc::new(Frame {
        generation: 1,
        size,
        corner: [0; 2],
        pixels: vec![[100; 3]; size.pixels()],
        values: Vec::new(),
        denoised: Vec::new(),
        errors: Vec::new(),
        range: None,
        overexposure: Overexposure::default(),
        objects: (0..width * height)
            .map(|at| if under(at) == 1 { 1 } else { NO_OBJECT })
            .collect(),
        progress: Progress {
            pass: 1,
            passes: 7,
            spp: 1,
            mean_spp: 1.0,
            done: 0.5,
            elapsed: std::time::Duration::from_millis(300),
            rays: 1_000_000,
            shadow_rays: 0,
            over_budget: 3,
            noise: None,
            complete: false,
        },
        query: None,
    })
}

type Change = fn(&mut App);

/// All states of the interface, by name.
const STATES: &[(&str, Change)] = &[
    ("nothing", |_| {}),
    ("picture", |app| {
        app.shared.pictures.preview.take(frame(8, 6));
        app.shared.pictures.preview.advance(
            &FrameWindow::whole(Size {
                width: 8,
                height: 6,
            }),
            &[],
            usize::MAX,
        );
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
        app.shared.cursor.field = 99;
        app.shared.cursor.component = 99;
        app.shared.cursor.list_top = 99;
        app.shared.cursor.field_top = 99;
    }),
    ("help", |App { shared, .. }| {
        shared.overlays.help = Some(Help::default());
    }),
    ("help, far down", |app| {
        app.shared.overlays.help = Some(Help {
            top: usize::MAX,
            search: Input::new("界 nowhere".to_owned()),
            focus: PageFocus::Search,
        });
    }),
    ("recent scenes", |app| {
        let paths = (0..99).map(|at| PathBuf::from(format!("/界/{at}.ray")));
        let mut page = Page::new(List::Recent(paths.collect()));
        page.filter.at = 98;
        app.shared.overlays.page = Some(page);
    }),
    ("quit", |app| {
        app.shared.overlays.dialog = Some(Dialog::Leave(AfterLeaving::Quit));
    }),
    ("wires", |app| {
        app.shared.pictures.wireframe = Some(ShownWireframe::default());
        app.update(Msg::Key(KeyCode::Char('O').into()));
    }),
    ("history", |app| {
        app.shared.overlays.past = Some(usize::MAX);
        app.update(Msg::Failed("界\u{1b}]52;c;界\u{7}".repeat(20)));
    }),
    ("undo history", |app| {
        app.shared.mode = Mode::Select;
        app.shared.has_colours = true;
        select(app, Node::Object(0));
        for key in ['D', 'D', 'd', 'u', 'U', 'k'] {
            app.update(Msg::Key(KeyCode::Char(key).into()));
        }
        assert!(history::open_steps(&app.shared).is_some());
    }),
    ("overwrite", |app| {
        app.update(Msg::Key(KeyCode::Char('b').into()));
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
        let mut merge = conflict(app, &SCENE.replace(" 0.25 ", " 0.75 "));
        merge.conflicts[0].decision = Some(Side::Mine);
        app.shared.overlays.dialog = Some(Dialog::Conflict {
            merge,
            at: 0,
            from: MergeSource::File,
        });
    }),
    ("typing", |app| {
        select(app, Node::Object(0));
        app.shared.cursor.typing = Some(Typing {
            input: Input::new("1234567890123456789012345678901234567890".to_owned()),
            ..Typing::default()
        });
    }),
    ("menu", |app| {
        app.shared.mode = Mode::Select;
        for key in ['a', 's'] {
            app.update(Msg::Key(KeyCode::Char(key).into()));
        }
        assert!(app.shared.overlays.menu.is_some());
    }),
    ("colour picker", |app| {
        app.shared.mode = Mode::Select;
        select(app, Node::Object(0));
        for key in ['e', 'j', 'j', 'c', 'l'] {
            app.update(Msg::Key(KeyCode::Char(key).into()));
        }
        assert!(app.shared.overlays.picker.is_some());
    }),
    ("palette", |app| {
        for key in [':', 'e'] {
            app.update(Msg::Key(KeyCode::Char(key).into()));
        }
        app.update(Msg::Key(KeyCode::Tab.into()));
    }),
    ("prompt", |app| {
        app.shared.overlays.prompt = Some(Prompt {
            kind: PromptKind::Filter(Node::View),
            is_selected: false,
            input: Input::new("界界界界界界界界界界界界界界界界".to_owned()).with_cursor(3),
            opened: String::new(),
        });
    }),
    ("message", |app| {
        app.shared.overlays.message = Some(Message {
            severity: Some(Severity::Warning),
            text: "界\u{1b}]52;c;界\u{7}".repeat(20),
        });
        app.shared.pictures.net = Some(86_000);
        app.shared.pictures.view = app.shared.camera();
        app.shared.disk.state = OnDisk::Changed;
        app.shared.jobs.export = Some(Export {
            id: ExportId::default(),
            stage: Stage::Tracing,
            destination: Destination {
                path: PathBuf::from("out.bmp"),
                existing: Existing::Kept,
                scene: None,
                named: Vec::new(),
                origin: None,
            },
            frames: None,
            reel: None,
            size: Size {
                width: 4,
                height: 3,
            },
            spp: 16,
            aov: None,
            progress: None,
            written_for: 0,
        });
    }),
];

const MODES: [Mode; 6] = [
    Mode::Select,
    Mode::View,
    Mode::Edit,
    Mode::Trace,
    Mode::Inspect,
    Mode::Compare,
];

#[test]
fn every_screen_can_be_drawn_at_every_size() {
    let small = (0..=30).flat_map(|width| (0..=12).map(move |height| (width, height)));
    let thresholds = [
        (19, 6),
        (20, 6),
        (39, 16),
        (40, 15),
        (40, 16),
        (79, 24),
        (80, 23),
        (80, 24),
        (200, 50),
    ];
    let sizes: Vec<_> = small.chain(thresholds).collect();
    for (name, change) in STATES {
        for mode in MODES {
            let mut app = app();
            app.shared.mode = mode;
            app.shared.inspection.cross = Some(Cross {
                pixel: [3, 300],
                size: Size {
                    width: 4,
                    height: 3,
                },
            });
            change(&mut app);
            for &(width, height) in &sizes {
                let lines = screen(&mut app, width, height);
                let is_control = |c: char| c.is_control();
                assert!(!lines.concat().contains(is_control), "{name} {mode:?}");
            }
        }
    }
}

/// The last line while a field of the first object is edited on a screen without panels.
fn last_line(size: (u16, u16), field: usize, change: fn(&mut App)) -> String {
    let mut app = app();
    app.shared.mode = Mode::Edit;
    select(&mut app, Node::Object(0));
    (app.shared.cursor.field, app.shared.cursor.component) = (field, usize::from(field != 1));
    change(&mut app);
    let lines = screen(&mut app, size.0, size.1);
    let words = lines.last().map(|line| line.split_whitespace());
    words.map_or_else(String::new, |words| words.collect::<Vec<_>>().join(" "))
}

#[test]
fn the_current_field_is_shown_where_there_are_no_panels() {
    let shown = |size, field| last_line(size, field, |_| {});
    assert_eq!(shown((30, 10), 0), "EDIT centre 0 .5 -1e0");
    assert_eq!(shown((50, 14), 1), "EDIT test.ray whitted radius 0.25");
    assert_eq!(shown((20, 6), 0), "EDIT centre y .5");
    let zoomed = last_line((100, 30), 2, |app| app.shared.zoom = Zoom::Picture);
    assert!(zoomed.ends_with("ka 0.1 0.1 0.1"), "{zoomed}");
    let panels = shown((80, 24), 0);
    assert!(!panels.contains("centre"), "{panels}");
}

#[test]
fn what_is_typed_is_shown_where_there_are_no_panels() {
    let typing: fn(&mut App) = |app| {
        app.shared.cursor.typing = Some(Typing {
            input: Input::new("2.75".to_owned()),
            ..Typing::default()
        });
    };
    let line = last_line((40, 12), 0, typing);
    assert_eq!(line, "EDIT centre y 2.75");
    let long: fn(&mut App) = |app| {
        app.shared.cursor.typing = Some(Typing {
            input: Input::new("123456789012345678".to_owned()),
            ..Typing::default()
        });
    };
    assert!(last_line((20, 6), 0, long).ends_with('8'));

    let mut app = app();
    app.shared.mode = Mode::Edit;
    select(&mut app, Node::Object(0));
    for key in ["j", "-", "3"] {
        let key = key.chars().next().map(KeyCode::Char);
        app.update(Msg::Key(key.expect("a key").into()));
    }
    app.update(Msg::Key(KeyCode::Enter.into()));
    let lines = screen(&mut app, 40, 12);
    assert!(
        lines.concat().contains("must be greater than 0"),
        "{lines:?}"
    );
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
            app.shared.overlays.message = Some(Message {
                severity: Some(Severity::Error),
                text: text.to_owned(),
            });
            let lines = screen(&mut app, width, 24);
            let shown: String = lines.concat().split_whitespace().collect();
            let words: String = text.split_whitespace().collect();
            assert!(shown.contains(&words), "{}", lines.join("\n"));
        }
    }
}

#[test]
fn the_changes_in_recovered_edits_are_counted() {
    let shown = |change: fn(&str) -> String, follow: fn(Offer) -> Offer| {
        let mut app = app();
        let text = app.shared.document.shared_text();
        let offer = follow(offer(Language::Ray, &text, SCENE, &change(SCENE)));
        app.shared.overlays.dialog = Some(Dialog::Recover(Box::new(offer)));
        let lines = screen(&mut app, 100, 30);
        let words: Vec<_> = lines.iter().flat_map(|line| line.split('│')).collect();
        words
            .join(" ")
            .split_whitespace()
            .collect::<Vec<_>>()
            .join(" ")
    };
    let one = shown(|text| text.replacen(" 0.25 ", " 0.5 ", 1), |offer| offer);
    assert!(one.contains("1 place differs from the file"), "{one}");
    assert!(!one.contains("damaged"), "{one}");
    let two = |text: &str| text.replacen(" 0.25 ", " 0.5 ", 1).replacen('1', "2", 1);
    let two = shown(two, damaged);
    assert!(
        two.contains("2 places differ from the file. Part of their journal is damaged"),
        "{two}"
    );
}

#[test]
fn a_picture_that_is_not_being_traced_is_not_announced() {
    let mut app = app();
    let mut says = |wanted, words| {
        app.shared.pictures.preview.wanted = wanted;
        let text = screen(&mut app, 80, 24).join("\n");
        assert!(text.contains(words), "{words:?} in\n{text}");
    };
    says(Some(1), "tracing…");
    says(None, " no picture ");
}

#[test]
fn errors_mark_the_picture_as_stale_and_are_explained() {
    let mut app = app();
    app.shared.pictures.preview.take(frame(8, 6));
    let size = app.shared.raster().expect("there is room").1;
    app.shared
        .pictures
        .preview
        .advance(&FrameWindow::whole(size), &[], usize::MAX);
    retype(&mut app, " 0.25 ", " -1 ");
    let text = screen(&mut app, 100, 30).join("\n");
    for part in ["STALE", "1 error", "test.ray:6:18", "^^", "SELECT", "[+]"] {
        assert!(text.contains(part), "{part:?} in\n{text}");
    }
}

#[test]
fn a_picture_of_another_size_is_scaled_to_its_place() {
    let mut app = app();
    app.shared.pictures.preview.take(frame(4, 3));
    app.shared.pictures.preview.advance(
        &FrameWindow::whole(Size {
            width: 4,
            height: 3,
        }),
        &[],
        usize::MAX,
    );
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
        let lines = screen(&mut app, 80, 24).join("\n");
        assert!(lines.contains("error"), "{lines}");
    }
}
