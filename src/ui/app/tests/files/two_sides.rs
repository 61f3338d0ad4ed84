//! Random sessions of two sides: an editor and the interface change the same scene, their messages and the
//! readings of the text arrive late, and the editor saves, closes, dies and returns. At rest both have the
//! same text, and no change of either side is lost without a question.

use std::collections::{BTreeSet, VecDeque};
use std::path::PathBuf;

use super::*;
use crate::app::OnDisk;
use crate::msg::{SaveOutcome, Timer};
use crate::scene_reading::{Baseline, ReadBuffer};
use crate::service::buffers::Buffers;
use ::text::{Edit, Span, apply, smallest_edit};
use link::{Abilities, Follow, Opening, ToEditor, ToInterface};

/// An editor with the scene open.
struct Editor {
    connection: u64,
    text: String,
    version: u64,
}

struct Sides {
    app: App,
    buffers: Buffers,
    disk: String,
    editor: Option<Editor>,
    connections: u64,
    to_editor: VecDeque<ToEditor>,
    to_interface: VecDeque<ToInterface>,
    inbox: VecDeque<Msg>,
    reading: Option<Baseline>,
    timers: BTreeSet<&'static str>,
    /// The comments that must still be there.
    comments: BTreeSet<String>,
    /// The first coordinate of object 1, which only the interface changes.
    x: f64,
    numbers: u32,
    random: u64,
}

impl Sides {
    fn new(seed: u64) -> Self {
        let (mut app, _) = opened(SCENE);
        press(&mut app, "ggjjjje");
        Self {
            app,
            buffers: Buffers::new(Follow::Typing),
            disk: SCENE.to_owned(),
            editor: None,
            connections: 0,
            to_editor: VecDeque::new(),
            to_interface: VecDeque::new(),
            inbox: VecDeque::new(),
            reading: None,
            timers: BTreeSet::new(),
            comments: BTreeSet::new(),
            x: 0.0,
            numbers: 0,
            random: seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1,
        }
    }

    fn below(&mut self, count: usize) -> usize {
        self.random ^= self.random << 13;
        self.random ^= self.random >> 7;
        self.random ^= self.random << 17;
        (self.random >> 11) as usize % count
    }

    fn text(&self) -> &str {
        self.app.shared.document.text()
    }

    fn present_x(&self) -> f64 {
        let number = |text: &str| text.split_whitespace().next()?.parse().ok();
        let after = self.text().split("sphere\n").nth(1);
        let line = after.and_then(|rest| rest.lines().find(|line| !line.starts_with("//")));
        line.and_then(number).unwrap_or(f64::NAN)
    }

    /// Performs what the interface requests.
    fn perform(&mut self, effects: Vec<Effect>) {
        for effect in effects {
            match effect {
                Effect::Read(_, baseline) => self.reading = Some(baseline),
                Effect::Tell(message) if self.editor.is_some() => self.to_editor.push_back(message),
                Effect::ForgetBuffer => self.inbox.extend(self.buffers.forget()),
                Effect::Later(_, Timer::Push) => drop(self.timers.insert("push")),
                Effect::Later(_, Timer::Settled) => drop(self.timers.insert("settled")),
                Effect::Save { id, path, text, .. } => {
                    text.as_str().clone_into(&mut self.disk);
                    let saved = SaveOutcome::Saved { path, text };
                    self.inbox.push_back(Msg::Saved(id, saved));
                }
                _ => {}
            }
        }
    }

    fn update(&mut self, msg: Msg) {
        let effects = self.app.update(msg);
        self.perform(effects);
    }

    /// Changes the text in the editor.
    fn change(&mut self, edits: Vec<Edit>) {
        if let Some(editor) = &mut self.editor {
            apply(&mut editor.text, &edits);
            editor.version += 1;
            let change = ToInterface::Change(editor.version, edits);
            self.to_interface.push_back(change);
        }
    }

    fn type_comment(&mut self) {
        self.numbers += 1;
        let comment = format!("// e{}\n", self.numbers);
        let Some(editor) = &self.editor else {
            return;
        };
        let starts: Vec<_> = editor
            .text
            .match_indices('\n')
            .map(|(at, _)| at + 1)
            .collect();
        let at = starts[self.below(starts.len())];
        self.comments.insert(comment.clone());
        self.change(vec![Edit {
            span: Span::at(at),
            text: comment,
        }]);
    }

    /// Types another number or half a word for the place of object 2.
    fn type_number(&mut self) {
        let words = ["4", "5.5", "-3", "x", "6."];
        let word = words[self.below(words.len())];
        let Some(editor) = &self.editor else {
            return;
        };
        let Some(second) = editor
            .text
            .rfind("sphere\n")
            .map(|at| at + "sphere\n".len())
        else {
            return;
        };
        if let Some(end) = editor.text[second..].find(' ') {
            let span = Span::new(second, second + end);
            if !span.of(&editor.text).starts_with('/') {
                let text = word.to_owned();
                self.change(vec![Edit { span, text }]);
            }
        }
    }

    fn open_editor(&mut self) {
        self.connections += 1;
        let editor = Editor {
            connection: self.connections,
            text: self.disk.clone(),
            version: 0,
        };
        self.to_interface.push_back(ToInterface::Open(Opening {
            editor: "nvim".to_owned(),
            version: 0,
            text: editor.text.clone(),
            can: Abilities {
                edits: true,
                shows: true,
            },
            follow: Follow::Typing,
        }));
        self.editor = Some(editor);
    }

    /// Ends the editor, which has sent everything before.
    fn end_editor(&mut self, is_killed: bool) {
        while !self.to_interface.is_empty() {
            self.arrive();
        }
        let Some(editor) = self.editor.take() else {
            return;
        };
        self.to_editor.clear();
        if !is_killed {
            let news = self
                .buffers
                .said(editor.connection, ToInterface::Close, String::new);
            self.inbox.extend(news);
            // What was not saved is discarded, the interface's edits among it.
            let kept = |comment: &String| self.disk.contains(comment.as_str());
            self.comments.retain(kept);
            self.x = f64::NAN;
        }
        self.inbox.extend(self.buffers.left(editor.connection));
        // Otherwise another editor would open before this is heard of.
        self.rest();
    }

    fn arrive(&mut self) {
        if let (Some(message), Some(editor)) = (self.to_interface.pop_front(), &self.editor) {
            let in_file = || self.disk.clone();
            let news = self.buffers.said(editor.connection, message, in_file);
            self.inbox.extend(news);
        }
    }

    /// The editor takes a message of the interface.
    fn obey(&mut self) {
        let (manner, order) = (self.below(12), self.below(2));
        let Some(message) = self.to_editor.pop_front() else {
            return;
        };
        let Some(editor) = &self.editor else {
            return;
        };
        match message {
            ToEditor::Edit(base, edits) if base == editor.version && manner != 0 => {
                let answer = ToInterface::Answer(base, true);
                if order == 0 {
                    self.to_interface.push_back(answer.clone());
                }
                // Some editors say so and do nothing.
                if manner != 1 {
                    self.change(edits);
                }
                // Others format what they get.
                if let (2, Some(editor)) = (manner, &self.editor) {
                    let formatted = editor.text.replace("sphere\n0.1 ", "sphere\n0.10 ");
                    let edit = smallest_edit(&editor.text, &formatted);
                    self.change(edit.into_iter().collect());
                }
                if order == 1 {
                    self.to_interface.push_back(answer);
                }
            }
            ToEditor::Edit(base, _) => self
                .to_interface
                .push_back(ToInterface::Answer(base, false)),
            ToEditor::Whole => unreachable!("no version is left out"),
            ToEditor::Show { .. } | ToEditor::Shown(_) | ToEditor::Busy(_) => {}
        }
    }

    fn read(&mut self) {
        let Some(baseline) = self.reading.take() else {
            return;
        };
        let outside = self.buffers.outside();
        let (text, buffer) = match outside {
            None => (self.disk.clone(), None),
            Some(outside) => {
                let (version, in_file) = (outside.version, outside.in_file);
                (outside.text, Some(ReadBuffer { version, in_file }))
            }
        };
        let reading = Reading::of(text, buffer, baseline).expect("it fits");
        self.update(Msg::Read(PathBuf::from("scene.ray"), Ok(reading)));
    }

    fn elapse(&mut self, timer: Timer, name: &str) {
        // Patience lasts longer than messages take.
        let buffer = self.app.shared.buffer.as_ref();
        let awaits = buffer.is_some_and(|buffer| buffer.sent.is_some());
        let is_quiet = [
            self.to_editor.len(),
            self.to_interface.len(),
            self.inbox.len(),
        ] == [0; 3];
        if (is_quiet || !awaits) && self.timers.remove(name) {
            self.update(Msg::Elapsed(timer));
        }
    }

    fn press(&mut self, keys: &str) {
        let effects = press_all(&mut self.app, keys);
        self.perform(effects);
        self.x = self.present_x();
    }

    /// Whatever may happen next.
    fn step(&mut self) {
        let step = self.below(40);
        match step {
            0..=3 => self.type_comment(),
            4..=5 => self.type_number(),
            6..=10 => self.arrive(),
            11..=14 => self.obey(),
            15..=19 => {
                if let Some(msg) = self.inbox.pop_front() {
                    self.update(msg);
                }
            }
            21..=24 => self.read(),
            25..=27 => self.elapse(Timer::Push, "push"),
            28..=29 => self.elapse(Timer::Settled, "settled"),
            30..=33 if self.app.shared.overlays.dialog.is_none() => self.press("l"),
            34 if self.app.shared.overlays.dialog.is_none() => {
                // What may be undone is also a merge with the file.
                self.press("u");
                self.keep_what_is_left();
            }
            35 => {
                if let Some(editor) = &self.editor {
                    self.disk.clone_from(&editor.text);
                    self.to_interface.push_back(ToInterface::Saved);
                    self.inbox.push_back(Msg::FileChanged);
                }
            }
            20 => {
                // Another program changes the file; what it does is lost if the editor saves later.
                self.numbers += 1;
                let comment = format!("// d{}\n", self.numbers);
                self.disk.push_str(&comment);
                self.inbox.push_back(Msg::FileChanged);
                self.comments
                    .extend(self.editor.is_none().then_some(comment));
            }
            36 => self.end_editor(false),
            37 => self.end_editor(true),
            38..=39 if self.editor.is_none() => self.open_editor(),
            _ => {}
        }
        self.check();
    }

    /// Decides what is asked.
    fn decide(&mut self) {
        if self.app.shared.overlays.dialog.is_some() {
            let keys = ["T<Enter>", "M<Enter>"][self.below(2)];
            self.press(keys);
            self.x = f64::NAN;
            self.keep_what_is_left();
        }
    }

    /// What was decided against, or taken back, need not be there.
    fn keep_what_is_left(&mut self) {
        let text = self.app.shared.document.text();
        self.comments
            .retain(|comment| text.contains(comment.as_str()));
    }

    fn check(&mut self) {
        let x = self.present_x();
        let is_taken_back = words(&self.app).contains("did not take the change");
        // After what may replace it, whatever is there counts.
        if self.x.is_nan() || is_taken_back {
            self.x = x;
        }
        if is_taken_back {
            self.keep_what_is_left();
        }
        assert!((x - self.x).abs() < 1e-9, "{x} {}\n{}", self.x, self.text());
    }

    /// Lets everything happen that is under way.
    fn rest(&mut self) {
        for _ in 0..200 {
            self.arrive();
            self.obey();
            while let Some(msg) = self.inbox.pop_front() {
                self.update(msg);
            }
            self.read();
            self.elapse(Timer::Settled, "settled");
            self.elapse(Timer::Push, "push");
            self.decide();
            self.check();
        }
        let is_quiet = self.to_editor.is_empty() && self.to_interface.is_empty();
        assert!(is_quiet && self.inbox.is_empty() && self.reading.is_none());
        // A file with errors beside unsaved edits is kept apart.
        if matches!(self.app.shared.disk.state, OnDisk::Faulty(_)) {
            return;
        }
        let text = self.text();
        if let Some(editor) = &self.editor {
            assert_eq!(text, editor.text);
        } else if !self.app.shared.document.is_dirty() {
            assert_eq!(text, self.disk);
        }
        for comment in &self.comments {
            assert!(text.contains(comment.as_str()), "{comment} in\n{text}");
        }
    }
}

#[test]
fn both_sides_have_the_same_text_at_rest() {
    for seed in 0..1_000 {
        let mut sides = Sides::new(seed);
        for _ in 0..60 {
            sides.step();
        }
        sides.rest();
    }
}
