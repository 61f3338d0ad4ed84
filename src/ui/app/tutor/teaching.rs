//! The lesson that is taught: begun, noticed, hinted at, left.

use std::time::Duration;

use super::goals::Before;
use super::lessons::{LESSONS, Lesson, names};
use super::place::Begun;
use crate::app::room::Room;
use crate::app::{CarriedScene, Shared, files, text};
use crate::arrange::Above;
use crate::msg::{Effect, Target, Timer};
use ::text::{Edit, Span};
use document::StepName;

/// The time after which a step that is not done yet shows its hint.
const PATIENCE: Duration = Duration::from_secs(25);

/// The lesson beside the picture.
#[derive(Debug, Default)]
pub struct Tutor {
    taught: Option<Taught>,
    /// The lesson that begins once its scene is open.
    awaited: Option<&'static Lesson>,
    /// Whether another scene was opened in this step.
    is_replaced: bool,
    /// The lesson that was left, and the index of its step.
    left: Option<(&'static Lesson, usize)>,
}

#[derive(Debug)]
struct Taught {
    lesson: &'static Lesson,
    /// The index of the step; their number once all are done.
    at: usize,
    /// How things were when the step began; `None` until its scene is there.
    before: Option<Before>,
    is_hinted: bool,
    /// Whether the step began in this step of the interface.
    is_new: bool,
    /// Whether the step before was done, not skipped.
    has_done: bool,
}

/// What `:tutor` is told.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Order {
    /// Continues a lesson that was left, otherwise begins the first.
    Continue,
    /// Begins a lesson.
    Begin(&'static Lesson),
    /// Goes to the next step.
    Skip,
    /// Leaves the lesson.
    Leave,
}

/// What of a lesson is on screen.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Shown {
    /// The lesson and how far it is.
    pub(crate) title: String,
    /// What to do.
    pub(crate) words: String,
    /// More of that, after a while.
    pub(crate) hint: Option<String>,
}

impl Room for Tutor {
    /// A lesson goes on in another scene: it may have asked for that.
    fn renew(&mut self) {
        self.is_replaced = true;
    }

    fn settle(&mut self, shared: &mut Shared) {
        let is_replaced = std::mem::take(&mut self.is_replaced);
        if let Some(lesson) = self.awaited.take_if(|_| is_replaced)
            && shared.document.text() == lesson.scene.text
        {
            self.taught = Some(Taught::at(lesson, 0));
        }
        if let Some(taught) = &mut self.taught {
            notice(taught, shared);
        }
        shared.above = match self.taught {
            Some(_) => Above::Lesson,
            None => Above::Nothing,
        };
    }

    fn follow(&mut self, shared: &mut Shared) -> Vec<Effect> {
        let Some(taught) = &mut self.taught else {
            return Vec::new();
        };
        if !std::mem::take(&mut taught.is_new) {
            return Vec::new();
        }
        let place = Begun::to_text(taught.lesson, taught.at, shared);
        vec![
            Effect::Later(PATIENCE, Timer::Lesson),
            Effect::KeepLesson(place),
        ]
    }
}

impl Taught {
    fn at(lesson: &'static Lesson, at: usize) -> Self {
        Self {
            lesson,
            at,
            before: None,
            is_hinted: false,
            is_new: true,
            has_done: false,
        }
    }
}

impl Order {
    /// Reads what `:tutor` is told; the error says what is expected.
    pub(crate) fn parse(said: &str) -> Result<Self, String> {
        let lesson = LESSONS.iter().find(|lesson| lesson.name == said);
        match (said, lesson) {
            ("", _) => Ok(Self::Continue),
            ("skip", _) => Ok(Self::Skip),
            ("off", _) => Ok(Self::Leave),
            (_, Some(lesson)) => Ok(Self::Begin(lesson)),
            _ => Err(format!("No lesson `{said}`. Lessons: {}", names())),
        }
    }
}

/// Begins or continues a lesson in the scene that was opened for it.
pub(crate) fn begin(tutor: &mut Tutor, shared: &mut Shared, begun: &Begun) -> Vec<Effect> {
    tutor.taught = Some(Taught::at(begun.lesson, begun.step));
    tutor.settle(shared);
    tutor.follow(shared)
}

/// Does what `:tutor` is told.
pub(crate) fn obey(tutor: &mut Tutor, shared: &mut Shared, order: Order) -> Vec<Effect> {
    match (order, &mut tutor.taught) {
        (Order::Begin(lesson), _) => return open(tutor, shared, lesson),
        (Order::Continue, Some(taught)) => taught.is_hinted = true,
        (Order::Continue, None) => match tutor.left.take() {
            Some((lesson, at)) => tutor.taught = Some(Taught::at(lesson, at)),
            None => return open(tutor, shared, &LESSONS[0]),
        },
        (Order::Skip, Some(taught)) if taught.at < taught.lesson.steps.len() => {
            advance(taught, shared);
        }
        (Order::Leave, Some(taught)) => {
            tutor.left = Some((taught.lesson, taught.at));
            tutor.taught = None;
            shared.say("Lesson closed (:tutor goes on with it)");
        }
        (Order::Skip | Order::Leave, _) => {
            shared.warn(format!("No lesson is open. :tutor begins one: {}", names()));
        }
    }
    Vec::new()
}

/// Opens the scene of a lesson, which then begins. That may ask about unsaved edits first.
fn open(tutor: &mut Tutor, shared: &mut Shared, lesson: &'static Lesson) -> Vec<Effect> {
    tutor.awaited = Some(lesson);
    files::open_carried(shared, lesson.scene)
}

/// Shows the hint of the step.
pub(crate) fn hint(tutor: &mut Tutor) {
    if let Some(taught) = &mut tutor.taught {
        taught.is_hinted = true;
    }
}

/// Goes to the next step if this one is done.
fn notice(taught: &mut Taught, shared: &mut Shared) {
    if shared.disk.is_opening() {
        return;
    }
    let before = taught.before.get_or_insert_with(|| Before::of(shared));
    let step = taught.lesson.steps.get(taught.at);
    if step.is_some_and(|step| (step.is_done)(shared, before)) {
        advance(taught, shared);
        taught.has_done = true;
    }
}

/// Goes to the next step, and shows its scene if it has one of its own.
fn advance(taught: &mut Taught, shared: &mut Shared) {
    *taught = Taught::at(taught.lesson, taught.at + 1);
    let step = taught.lesson.steps.get(taught.at);
    if let Some(scene) = step.and_then(|step| step.scene) {
        show_scene(shared, scene);
    }
    taught.before = Some(Before::of(shared));
}

/// Replaces the text by that of another scene of the same language, which can be undone.
fn show_scene(shared: &mut Shared, scene: CarriedScene) {
    let edit = Edit {
        span: Span::new(0, shared.document.text().len()),
        text: scene.text.to_owned(),
    };
    shared.document.end_step();
    shared.document.edit(&[edit]);
    shared.document.end_step();
    shared.document.name_step(StepName::done(scene.name));
    shared.pictures.reset_view();
    // The picture on screen is of the scene before.
    shared.pictures.want(Target::Preview, None);
    text::relower(shared);
}

/// What of the lesson is on screen; `None` without one.
pub(crate) fn shown(tutor: &Tutor, shared: &Shared) -> Option<Shown> {
    let taught = tutor.taught.as_ref()?;
    let (lesson, count) = (taught.lesson, taught.lesson.steps.len());
    let Some(step) = lesson.steps.get(taught.at) else {
        return Some(Shown {
            title: format!("Lesson {}: done", lesson.name),
            words: filled(lesson.after, shared),
            hint: None,
        });
    };
    let done = if taught.has_done { "✓ " } else { "" };
    Some(Shown {
        title: format!(
            "{done}Lesson {}, step {} of {count}",
            lesson.name,
            taught.at + 1
        ),
        words: filled(step.words, shared),
        hint: taught.is_hinted.then(|| filled(step.hint, shared)),
    })
}

/// Words with keys in place of the names of actions in braces.
fn filled(words: &str, shared: &Shared) -> String {
    let mut parts = words.split('{');
    let mut filled = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let (name, rest) = part.split_once('}').unwrap_or(("", part));
        filled.push_str(&shared.key_for(name));
        filled.push_str(rest);
    }
    filled
}
