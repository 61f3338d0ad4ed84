//! The steps of scripts: keys, and events after `@`.
//!
//! `@file TEXT` is a reading of the scene's file, and `@file twice TEXT` two, with the time
//! between them that makes errors count; `@missing`, `@folder` and `@no-folder` are readings that
//! fail, also `twice`. `@reading TEXT` begins one and `@arrives` ends it;
//! `@asked TEXT` is the one that the last step asks for. Answers of effects name the one
//! they answer by its number, unless it is the newest: `@saved`, `@refused`, `@exported`,
//! `@taken`, `@kept`, `@explained`. `@field` goes to a field by its name, and `@note a name`
//! remembers what is seen as a text. `@frame` delivers a complete picture, `@rendered` one as it is, `@traced` one that can
//! be asked about its pixels, `@light` a preview of a single grey, `@judged` one with the trials of
//! what would help, and `@shows` one of one object, which is on screen. `@thumbnails` delivers all
//! that the page of the history asks for, and `@derived` the scene that it asked for last.

use super::files::{kind, numbered, recovered, unread};
use super::*;
use crate::app::display;
use crate::history_scene::HistoryText;
use crate::keymap::{Keys, Section};
use crate::msg::{Polled, Question, Recalled, Timer};
use crate::recovery::Offer;
use crate::reel::ReelProgress;
use render::{Frame, Job, PreparedScene, Progress};
use scene::Size;

/// What was begun and not answered yet.
#[derive(Default)]
pub(super) struct UnderWay {
    pub(super) saves: BTreeMap<u32, (PathBuf, Arc<String>)>,
    pub(super) exports: BTreeMap<u32, PathBuf>,
    pub(super) jobs: Vec<(Target, Job)>,
    /// The scenes that questions about traced pictures are about.
    pub(super) prepared: Vec<PreparedScene>,
    questions: Vec<(Question, Arc<Frame>)>,
    /// The requests of the last step for names to complete.
    pub(super) listings: Vec<Effect>,
    past: Option<Box<HistoryText>>,
    pub(super) kept: Vec<u64>,
    pub(super) offer: Option<Offer>,
    pub(super) track: Option<(PathBuf, Arc<String>)>,
    reading: Option<Msg>,
}

impl Session {
    /// Takes a step.
    pub(super) fn step(&mut self, said: &str) -> Result<(), String> {
        if let Some(event) = said.strip_prefix('@') {
            let (name, rest) = event.split_once(' ').unwrap_or((event, ""));
            return self.event(name, rest.trim());
        }
        if said.contains('|') {
            return Err("a space is missing before a bar".to_owned());
        }
        let mut said = said;
        if let Some((node, rest)) = said.strip_prefix('[').and_then(|s| s.split_once(']')) {
            let shared = &mut self.app.shared;
            let found = shared.nodes().iter().find(|at| at.to_string() == node);
            shared.select(found.ok_or("no such node")?);
            said = rest.trim_start();
        }
        let is_listing = |effect: &Effect| matches!(effect, Effect::ListFolder(_));
        let effects = press_all(&mut self.app, said).into_iter();
        (self.under_way.listings, self.effects) = effects.partition(is_listing);
        self.note();
        Ok(())
    }

    /// Takes a step by a message.
    pub(in crate::app::tests) fn update(&mut self, msg: Msg) {
        self.effects = self.app.update(msg);
        self.note();
    }

    fn event(&mut self, name: &str, rest: &str) -> Result<(), String> {
        let (first, others) = rest.split_once(' ').unwrap_or((rest, ""));
        let msg = match name {
            "file" | "missing" | "folder" | "no-folder" if first == "twice" => {
                self.event(name, others)?;
                self.update(Msg::Elapsed(Timer::Settled));
                return self.event(name, others);
            }
            "file" => {
                let text = self.text_of(rest)?;
                self.call("file", &text);
                let msg = self.reading(self.own_path(), text);
                if let Msg::Read(_, Ok(reading)) = &msg {
                    self.call("news", kind(reading.news.as_deref()));
                }
                msg
            }
            "asked" => {
                let text = self.text_of(rest)?;
                let effects = std::mem::take(&mut self.effects).into_iter();
                let mut readings = effects.filter_map(|effect| match effect {
                    Effect::Read(path, baseline) => Some((path, baseline)),
                    _ => None,
                });
                let (path, baseline) = readings.next().ok_or("nothing is to be read")?;
                Msg::Read(
                    path,
                    Ok(Reading::new(text, baseline).expect("it fits into memory")),
                )
            }
            "buffer" | "typed" | "kept-by" | "answered" | "cursor" => {
                self.buffer_event(name, rest)?
            }
            "reads" => self.reading(first.into(), self.text_of(others)?),
            "arrives" => self.under_way.reading.take().ok_or("nothing is read")?,
            "missing" | "folder" | "no-folder" => {
                let path = self.own_path();
                Msg::Read(path.clone(), Err(unread(name, path)?))
            }
            "polled" => {
                let files = match first {
                    "scene" => Polled::Scene,
                    "track" => Polled::Track,
                    _ => Polled::Assets,
                };
                Msg::Polled(files, (!others.is_empty()).then(|| others.to_owned()))
            }
            "listed" => {
                let names = others.split(' ').map(str::to_owned);
                Msg::Listed(first.into(), names.collect())
            }
            "changed" => Msg::FileChanged,
            "elapsed" => Msg::Elapsed(effects::timer(rest)?),
            "saved" | "refused" | "failed" | "homeless" => self.outcome(name, rest)?,
            "kept" => Msg::Kept(self.kept(first)?, Ok(())),
            "unkept" => Msg::Kept(self.kept(first)?, Err(rest.to_owned())),
            "offer" => self.offer(rest)?,
            "complains" => recovered(None, rest.split("; ").map(str::to_owned).collect()),
            "backup" => Msg::BackupsFound(vec![rest.into()]),
            "recent" => Msg::RecentListed(rest.split_whitespace().map(PathBuf::from).collect()),
            "opened" => Msg::Opened(first.into(), Ok(self.other(first, others)?)),
            "unopened" => Msg::Opened(rest.into(), Err(unread("missing", rest.into())?)),
            "paste" => Msg::Paste(unescaped(&self.named(rest))),
            "fails" => Msg::Failed(rest.to_owned()),
            "hangup" => Msg::HangUp,
            "terminated" => Msg::Terminate { signal: 15 },
            "resize" => Msg::Resize(number(first)?, number(others)?),
            "recalled" => Msg::Recalled(match first {
                "more" => Recalled::More(number(others)?),
                "unreadable" => Recalled::Unreadable(others.to_owned()),
                spp => Recalled::Continued(number(spp)?),
            }),
            "derived" => traced::derived_scene(self.under_way.past.as_ref().ok_or("not asked")?),
            "explained" => self.explained(rest)?,
            "exported" | "taken" | "unwritten" => self.export_outcome(name, rest)?,
            "track" => self.track(rest)?,
            "load" => self.load(rest)?,
            "assets-changed" => Msg::AssetsChanged,
            "track-changed" => Msg::TrackChanged,
            "key" => self.track_outcome(rest)?,
            "filmed" => Msg::Filmed(self.export()?, half_way(number(first)?)),
            _ => return self.picture_event(name, first, others),
        };
        self.update(msg);
        Ok(())
    }

    /// What the renderers and the mouse report.
    fn picture_event(&mut self, name: &str, first: &str, rest: &str) -> Result<(), String> {
        let target = || effects::target(first);
        let msg = match name {
            "started" => Msg::Started(target()?, number(rest)?),
            "ended" => Msg::Ended(target()?),
            "cannot" => Msg::Refused(target()?, rest.to_owned()),
            "measured" => self.measured()?,
            "reference" => self.reference(&format!("{first} {rest}"))?,
            "frame" => self.frame(target()?, rest)?,
            "traced" => self.traced(target()?, rest)?,
            "rendered" => self.rendered(target()?)?,
            "light" => self.light(first)?,
            "trial" => self.trial(first)?,
            "down" | "drag" | "up" | "wheel" => self.mouse(name, first, rest)?,
            _ => return self.act(name, first, rest),
        };
        self.update(msg);
        Ok(())
    }

    /// Does what no single message says.
    fn act(&mut self, name: &str, first: &str, others: &str) -> Result<(), String> {
        let rest = format!("{first} {others}");
        let rest = rest.trim_end();
        match name {
            "reading" => {
                let text = self.text_of(rest)?;
                self.under_way.reading = Some(self.reading(self.own_path(), text));
            }
            "says" => self.app.shared.say(rest),
            "read-it" => self.app.shared.overlays.clear_message(),
            "bind" => {
                let (keys, name) = others.split_once(": ").unzip();
                let section = Section::named(first).ok_or("no such section")?;
                let keys = Keys::parse(keys.unwrap_or(others)).ok_or("no keys")?;
                self.app.shared.keymap.bind(section, keys, name);
            }
            "note" => self.call(first, &self.seen(others, "")?),
            "field" => {
                let shared = &mut self.app.shared;
                let is_it = |row: &FieldRow| row.field.key == rest;
                let field = shared.fields().iter().position(is_it);
                shared.cursor.field = field.ok_or("no such field")?;
            }
            "shows" => self.shows(rest)?,
            "judged" => self.judged(rest)?,
            "thumbnails" => self.thumbnails(),
            _ => return Err(format!("no event is called {name}")),
        }
        Ok(())
    }

    /// The answer to the newest question about a pixel, or to the first, the second and so on.
    fn explained(&self, number: &str) -> Result<Msg, String> {
        let asked = numbered(&self.under_way.questions, number);
        let (question, frame) = asked.ok_or("nothing is asked")?;
        let query = frame.query.as_ref().ok_or("the picture was not traced")?;
        let answer = query.explain(question.pixel, question.sample, &|| false);
        Ok(Msg::Explained(*question, answer.map(Box::new)))
    }

    /// Follows the last step with the wireframe, and remembers what its effects begin.
    pub(super) fn note(&mut self) {
        display::follow_wires(&mut self.app.shared);
        let under_way = &mut self.under_way;
        for effect in &self.effects {
            match effect {
                Effect::Save { id, path, text, .. } => {
                    let saved = (path.clone(), Arc::clone(text));
                    let name = format!("save {}", id.0);
                    self.texts.insert(name, text.to_string());
                    under_way.saves.insert(id.0, saved);
                }
                Effect::CheckTarget(id, to) | Effect::Film(id, _, to) => {
                    under_way.exports.insert(id.0, to.path.clone());
                }
                Effect::WriteRecovery { revision, .. } => under_way.kept.push(*revision),
                Effect::Derive(past) => under_way.past = Some(past.clone()),
                Effect::Explain(question, frame) => {
                    under_way.questions.push((*question, Arc::clone(frame)));
                }
                Effect::WriteTrack { path, text, .. } => {
                    under_way.track = Some((path.clone(), Arc::clone(text)));
                    self.texts.insert("key".to_owned(), text.to_string());
                }
                _ => {}
            }
            if let Some((target, job)) = traced_by(effect) {
                let Size { width, height } = job.settings.size;
                let name = effects::name(target).to_owned();
                self.texts.insert(name, format!("{width}x{height}"));
                under_way.jobs.push((target, job.clone()));
            }
        }
    }
}

/// How far the export of a sequence of nine frames is while this one is half traced.
pub(in crate::app::tests) fn half_way(frame: u32) -> ReelProgress {
    let size = Size {
        width: 32,
        height: 8,
    };
    let traced = Progress {
        done: 0.5,
        ..frame_of(size, vec![0; size.pixels()]).progress
    };
    ReelProgress {
        frame,
        count: 9,
        traced,
    }
}

/// The number that is said.
pub(super) fn number<N: std::str::FromStr>(said: &str) -> Result<N, String> {
    said.parse().map_err(|_| format!("not a number: {said:?}"))
}
