//! Inspecting pixels, and walking through the rays behind them.

use std::sync::Arc;

use crossterm::event::{MouseButton, MouseEvent, MouseEventKind};

use super::*;
use crate::language::Node;
use crate::render::{Frame, NO_OBJECT, PreparedScene};
use crate::scene::Size;
use crate::ui::app::{display, inspect};
use crate::ui::keymap::Context;
use crate::ui::msg::{Question, Target};

/// A mirror in front of the camera; a second sphere is seen in it and stands in the way of a light.
const MIRROR: &str = "\
// view: eye 0 0 8 target 0 0 0 up 0 1 0 fov 60
0.1 0.1 0.1
2
0 9 9  1 1 1
9 0 0  1 1 1
2
sphere 0 0 0 2  .1 .1 .1 .4 .4 .4 .5 .5 .5 9 0.5 0 1
sphere 3 0 2 1  .1 .1 .1 .4 0 0 0 0 0 9 0 0 1
";

/// The interface with a finished preview, and the scene that answers questions about it.
struct Inspected {
    app: App,
    _prepared: PreparedScene,
    asked: Vec<(Question, Arc<Frame>)>,
}

impl Inspected {
    fn of(name: &str, text: &str) -> Self {
        let (mut app, effects) = opened_as(name, text);
        let job = effects.into_iter().find_map(|effect| match effect {
            Effect::Trace(Target::Preview, job) => Some(job),
            _ => None,
        });
        let job = job.expect("the preview is traced");
        let prepared = PreparedScene::new(&job, || false).expect("it is not cancelled");
        let size = job.settings.size;
        let object = |at: usize| {
            let pixel = [at as u32 % size.width, at as u32 / size.width];
            let first = prepared.query().first_hit(pixel)?;
            Some(first.surface?.object)
        };
        let objects = (0..size.pixels()).map(|at| object(at).unwrap_or(NO_OBJECT));
        let mut frame = frame_of(size, objects.collect());
        frame.query = Some(prepared.query().clone());
        frame.values = vec![[0.5, 0.25, 2.0]; size.pixels()];
        app.update(Msg::Started(Target::Preview, frame.generation));
        app.update(Msg::Frame(Target::Preview, Arc::new(frame)));
        Self {
            app,
            _prepared: prepared,
            asked: Vec::new(),
        }
    }

    /// Presses keys and keeps the questions.
    fn press(&mut self, said: &str) -> &mut Self {
        for effect in press(&mut self.app, said) {
            if let Effect::Explain(question, frame) = effect {
                self.asked.push((question, frame));
            }
        }
        self
    }

    /// Answers the newest question.
    fn answer(&mut self) -> &mut Self {
        let (question, frame) = self.asked.pop().expect("a question");
        self.answer_to(question, &frame);
        self
    }

    fn answer_to(&mut self, question: Question, frame: &Frame) {
        let query = frame.query.as_ref().expect("a traced frame");
        let answer = query.explain(question.pixel, question.sample, || false);
        self.app
            .update(Msg::Explained(question, answer.map(Box::new)));
    }

    /// Moves the cursor to the first line that is about a node.
    fn go_to(&mut self, node: Node) -> &mut Self {
        let lines = inspect::ray_lines(&self.app.shared);
        let is = |line: &RayLine| inspect::ray_node(&self.app.shared, *line) == Some(node);
        let at = lines.iter().position(is).expect("a line about it");
        self.press(&"j".repeat(at))
    }
}

#[test]
fn inspecting_begins_and_ends_where_it_was_called() {
    for (before, mode) in [
        ("", Mode::Select),
        ("v", Mode::View),
        ("vF", Mode::Fly),
        ("<F5>", Mode::Trace),
    ] {
        let mut app = Inspected::of("a.ray", MIRROR).app;
        press(&mut app, before);
        let seen = app.shared.seen();
        press(&mut app, "i");
        assert_eq!(
            (app.shared.mode, app.shared.seen()),
            (Mode::Inspect, seen),
            "{before}"
        );
        press(&mut app, "<Esc>");
        assert_eq!(
            (app.shared.mode, app.shared.seen()),
            (mode, seen),
            "{before}"
        );
    }
    let mut app = Inspected::of("a.ray", MIRROR).app;
    press(&mut app, "ei");
    assert_eq!(app.shared.mode, Mode::Edit);
}

#[test]
fn the_pixel_under_the_cross_is_described() {
    let mut inspected = Inspected::of("a.ray", MIRROR);
    let app = &mut inspected.app;
    press(app, "i");
    let pixel = inspect::pixel(&app.shared).expect("there is a picture");
    let Size { width, height } = pixel.size;
    assert_eq!(pixel.at, [width / 2, height / 2]);
    assert_eq!(pixel.node, Ok(Some(Node::Object(0))));
    assert_eq!((pixel.line, pixel.samples), (Some(7), 1));
    assert_eq!(
        (pixel.value, pixel.colour),
        (Some([0.5, 0.25, 2.0]), Some([9; 3]))
    );
    let first = pixel.first.and_then(|first| first.surface);
    assert_eq!(first.map(|surface| surface.object), Some(0));
    let output = app.shared.output();
    assert_eq!(pixel.output.map(|(_, size)| size), Some(output));
    press(app, &"L".repeat(99));
    let pixel = inspect::pixel(&app.shared).expect("there is a picture");
    assert_eq!((pixel.at[0], pixel.node), (width - 1, Ok(None)));
}

#[test]
fn the_cross_follows_keys_and_the_mouse() {
    let mut inspected = Inspected::of("a.ray", MIRROR);
    let app = &mut inspected.app;
    press(app, "i");
    let [x, y] = inspect::cross(&app.shared).expect("a picture").pixel;
    for (said, expected) in [
        ("l", [x + 1, y]),
        ("j", [x + 1, y + 1]),
        ("L", [x + 9, y + 1]),
        ("K", [x + 9, y - 7]),
        ("HhJk", [x, y]),
    ] {
        press(app, said);
        assert_eq!(
            inspect::cross(&app.shared).map(|cross| cross.pixel),
            Some(expected),
            "{said}"
        );
    }
    let (cells, _) = app.shared.raster().expect("a picture");
    let left = MouseButton::Left;
    for (kind, cell) in [
        (MouseEventKind::Down(left), (3, 2)),
        (MouseEventKind::Drag(left), (5, 4)),
    ] {
        let (column, row) = (cells.x + cell.0, cells.y + cell.1);
        app.update(Msg::Mouse(MouseEvent {
            kind,
            column,
            row,
            modifiers: KeyModifiers::NONE,
        }));
        assert_eq!(inspect::cross_cell(&app.shared), Some(cell));
        assert_eq!(app.shared.mode, Mode::Inspect);
    }
}

#[test]
fn a_zoomed_picture_follows_the_cross() {
    let mut inspected = Inspected::of("a.ray", MIRROR);
    let app = &mut inspected.app;
    press(app, ":zoom 4<Enter>i");
    let edge = display::pixel_in_corner(&app.shared);
    for said in ["h", "L"] {
        for _ in 0..99 {
            press(app, said);
            assert!(inspect::cross_cell(&app.shared).is_some());
        }
        assert_ne!(display::pixel_in_corner(&app.shared), edge, "{said}");
    }
}

#[test]
fn an_explanation_is_asked_for_once_and_only_the_newest_is_shown() {
    let mut inspected = Inspected::of("a.ray", MIRROR);
    inspected.press("ie");
    assert_eq!(inspected.app.shared.context(), Context::Rays);
    assert_eq!(inspected.asked.len(), 1);
    let (old, frame) = inspected.asked.pop().expect("a question");
    inspected.press("jk");
    assert!(inspected.asked.is_empty());
    inspected.press("<Esc>lle");
    inspected.answer_to(old, &frame);
    assert!(inspect::explanation(&inspected.app.shared).is_none());
    inspected.answer();
    let cross = inspect::cross(&inspected.app.shared).map(|cross| cross.pixel);
    let explanation = inspect::explanation(&inspected.app.shared);
    assert_eq!(explanation.map(|explanation| explanation.pixel), cross);
    inspected.press("<Esc>");
    assert_eq!(inspected.app.shared.context(), Context::In(Mode::Inspect));
}

#[test]
fn a_line_selects_its_object_or_light_or_opens_its_place() {
    for node in [
        Node::Object(0),
        Node::Object(1),
        Node::Light(0),
        Node::Light(1),
    ] {
        let mut inspected = Inspected::of("a.ray", MIRROR);
        // Right of the middle, the mirror shows the second sphere.
        inspected.press("iLe").answer().go_to(node);
        let line = inspect::line_of(&inspected.app.shared, node);
        let effects = press(&mut inspected.app, "E");
        assert!(matches!(
            effects[..],
            [Effect::OpenEditor { line: at, .. }] if at == line
        ));
        inspected.press("<Enter>");
        let app = &inspected.app;
        assert_eq!(
            (app.shared.mode, app.shared.cursor.selected()),
            (Mode::Select, node)
        );
    }
}

#[test]
fn the_light_of_a_line_is_soloed_and_explained_again() {
    let mut inspected = Inspected::of("a.ray", MIRROR);
    inspected.press("iLe").answer().press("l");
    assert!(inspected.app.shared.pictures.solo.is_none());
    assert!(words(&inspected.app).contains("works on the line of a light"));
    inspected.go_to(Node::Light(1)).press("l");
    let solo = inspected
        .app
        .shared
        .pictures
        .solo
        .as_ref()
        .expect("a light alone");
    assert!(solo.lights.contains(&1) && solo.objects.is_empty());
}

#[test]
fn rays_are_folded_and_walked_through() {
    let mut inspected = Inspected::of("a.ray", MIRROR);
    inspected.press("iLe").answer();
    let all = inspect::ray_lines(&inspected.app.shared).len();
    assert!(5 < all);
    inspected.press("<Left>");
    assert_eq!(inspect::ray_lines(&inspected.app.shared).len(), 1);
    inspected.press("<Right><Right>");
    assert_eq!(inspect::ray_lines(&inspected.app.shared).len(), all);
    let at = |inspected: &Inspected| {
        inspected
            .app
            .shared
            .inspection
            .explained
            .as_ref()
            .map(|of| of.at)
    };
    assert_eq!(at(&inspected), Some(1));
    inspected.press("<Left>");
    assert_eq!(at(&inspected), Some(0));
    inspected.press("G");
    assert_eq!(at(&inspected), Some(all - 1));
}

#[test]
fn every_language_has_a_verdict_and_its_sum() {
    for (name, text) in [
        ("a.ray", MIRROR),
        ("a.dat", Language::Dat.template()),
        ("a.xml", Language::Xml.template()),
    ] {
        let mut inspected = Inspected::of(name, text);
        inspected.press("ie").answer();
        let app = &inspected.app;
        let explained = app
            .shared
            .inspection
            .explained
            .as_ref()
            .expect("it is wanted");
        assert!(explained.verdict.is_some(), "{name}");
        let explanation = inspect::explanation(&app.shared).expect("an answer");
        let root = inspect::ray_lines(&app.shared)[0];
        let sum = root.adds(explanation);
        assert!((sum - explanation.radiance).length() < 1e-12, "{name}");
        assert!(!inspect::ray_path(&app.shared).is_empty(), "{name}");
    }
}

#[test]
fn samples_are_walked_through_as_far_as_there_are_some() {
    let mut inspected = Inspected::of("a.ray", MIRROR);
    inspected.press("ie");
    let mut frame = (*inspected.asked[0].1).clone();
    frame.progress.spp = 3;
    inspected
        .app
        .update(Msg::Frame(Target::Preview, Arc::new(frame)));
    for (said, sample) in [(".", 1), ("..", 2), (",", 1), (",,,", 0)] {
        inspected.press(said).answer();
        let explanation = inspect::explanation(&inspected.app.shared).expect("an answer");
        assert_eq!(explanation.sample, sample, "{said}");
    }
}
