//! The steps of scripts: keys, and events after `@`.
//!
//! `@file TEXT` is a reading of the scene's file, and `@file twice TEXT` two, with the time
//! between them that makes errors count; `@missing` and `@unreadable` are readings that fail, also
//! `twice`. `@reading TEXT` begins one and `@arrives` ends it. Answers of effects name the one
//! they answer by its number, unless it is the newest: `@saved`, `@refused`, `@exported`,
//! `@taken`, `@kept`. `@field` goes to a field by its name, and `@note a name` remembers what is
//! seen as a text. `@frame` delivers a complete picture, and `@shows` a preview of one object,
//! which is on screen.

use super::*;
use crate::document::Document;
use crate::file::ReadError;
use crate::render::{Job, Progress};
use crate::scene::{Meshes, Size};
use crate::ui::app::files;
use crate::ui::msg::{Recalled, SaveId, SaveOutcome, Timer};
use crate::ui::recovery::tests::offer;
use crate::ui::recovery::{Found, Offer};
use crate::ui::reel::ReelProgress;
use crate::ui::scene_reading::{Baseline, Opened};

/// What was begun and not answered yet.
#[derive(Default)]
pub(super) struct UnderWay {
    saves: BTreeMap<u32, (PathBuf, Arc<String>)>,
    exports: BTreeMap<u32, PathBuf>,
    pub(super) jobs: Vec<(Target, Job)>,
    kept: Vec<u64>,
    offer: Option<Offer>,
    track: Option<(PathBuf, Arc<String>)>,
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
            let found = self
                .app
                .shared
                .nodes()
                .iter()
                .find(|found| found.to_string() == node);
            self.app.shared.select(found.ok_or("no such node")?);
            said = rest.trim_start();
        }
        self.effects = press(&mut self.app, said);
        self.note();
        Ok(())
    }

    /// Takes a step by a message.
    pub(super) fn update(&mut self, msg: Msg) {
        self.effects = self.app.update(msg);
        self.note();
    }

    fn event(&mut self, name: &str, rest: &str) -> Result<(), String> {
        let (first, others) = rest.split_once(' ').unwrap_or((rest, ""));
        let msg = match name {
            "file" | "missing" | "unreadable" if first == "twice" => {
                self.event(name, others)?;
                self.update(Msg::Elapsed(Timer::Settled));
                return self.event(name, others);
            }
            "file" => {
                let text = self.text_of(rest)?;
                self.texts.insert("file".to_owned(), text.clone());
                self.reading(self.own_path(), text)
            }
            "reads" => self.reading(first.into(), self.text_of(others)?),
            "reading" => {
                let text = self.text_of(rest)?;
                self.under_way.reading = Some(self.reading(self.own_path(), text));
                return Ok(());
            }
            "arrives" => self.under_way.reading.take().ok_or("nothing is read")?,
            "missing" => {
                let path = self.own_path();
                Msg::Read(path.clone(), Err(ReadError::NotFound { path }))
            }
            "unreadable" => {
                let (path, kind) = (self.own_path(), "a folder");
                Msg::Read(path.clone(), Err(ReadError::NotRegular { path, kind }))
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
            "unopened" => {
                let path = PathBuf::from(rest);
                Msg::Opened(path.clone(), Err(ReadError::NotFound { path }))
            }
            "paste" => Msg::Paste(unescaped(&self.named(rest))),
            "fails" => Msg::Failed(rest.to_owned()),
            "says" => {
                self.app.shared.say(rest);
                return Ok(());
            }
            "read-it" => {
                self.app.shared.overlays.clear_message();
                return Ok(());
            }
            "hangup" => Msg::HangUp,
            "terminated" => Msg::Terminate { signal: 15 },
            "resize" => Msg::Resize(number(first)?, number(others)?),
            "recalled" => Msg::Recalled(match first {
                "more" => Recalled::More(number(others)?),
                "unreadable" => Recalled::Unreadable(others.to_owned()),
                spp => Recalled::Continued(number(spp)?),
            }),
            "note" => {
                let seen = self.seen(others, "")?;
                self.texts.insert(first.to_owned(), seen);
                return Ok(());
            }
            "field" => {
                let field = self
                    .app
                    .shared
                    .fields()
                    .iter()
                    .position(|row| row.field.key == rest);
                self.app.shared.cursor.field = field.ok_or("no such field")?;
                return Ok(());
            }
            "shows" => return self.shows(rest),
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
            "down" | "drag" | "up" | "wheel" => self.mouse(name, first, rest)?,
            _ => return Err(format!("no event is called {name}")),
        };
        self.update(msg);
        Ok(())
    }

    fn own_path(&self) -> PathBuf {
        let path = self.app.shared.disk.path.clone();
        path.unwrap_or_else(|| PathBuf::from("scene.ray"))
    }

    fn reading(&self, path: PathBuf, text: String) -> Msg {
        let reading =
            Reading::new(text, files::baseline(&self.app.shared)).expect("it fits into memory");
        Msg::Read(path, Ok(reading))
    }

    /// The outcome of a save: of the newest, unless its number is said. What was saved may be said to
    /// be another text, and after `as` another file.
    fn outcome(&self, name: &str, rest: &str) -> Result<Msg, String> {
        let saves = &self.under_way.saves;
        let (first, others) = rest.split_once(' ').unwrap_or((rest, ""));
        let (id, rest) = match first.parse() {
            Ok(id) => (Some(id), others),
            Err(_) => (saves.keys().last().copied(), rest),
        };
        let id = id.ok_or("nothing is saved")?;
        let outcome = match name {
            "refused" => SaveOutcome::ChangedOnDisk,
            "failed" => SaveOutcome::Failed(rest.to_owned()),
            "homeless" => SaveOutcome::NoFolder(rest.to_owned()),
            _ => {
                let (path, text) = saves.get(&id).cloned().ok_or("no such save")?;
                match rest.strip_prefix("as ") {
                    Some(path) => SaveOutcome::Saved {
                        path: path.into(),
                        text,
                    },
                    None if rest.is_empty() => SaveOutcome::Saved { path, text },
                    None => SaveOutcome::Saved {
                        path,
                        text: Arc::new(self.text_of(rest)?),
                    },
                }
            }
        };
        Ok(Msg::Saved(SaveId(id), outcome))
    }

    /// The revision that was to be kept last, or as the first, the second and so on.
    fn kept(&self, number: &str) -> Result<u64, String> {
        let kept = &self.under_way.kept;
        let kept = match number.parse::<usize>() {
            Ok(number) => kept.get(number - 1),
            Err(_) => kept.last(),
        };
        kept.copied().ok_or_else(|| "nothing is kept".to_owned())
    }

    /// An offer to restore a text, edited from the text called `base` or as it was opened; or the
    /// same offer `again`.
    fn offer(&mut self, rest: &str) -> Result<Msg, String> {
        if rest != "again" {
            let base = self
                .texts
                .get("base")
                .unwrap_or_else(|| &self.texts["opened"]);
            let kept = self.text_of(rest)?;
            let document = &self.app.shared.document;
            let offer = offer(document.language(), &document.shared_text(), base, &kept);
            let name = offer.claim.name().to_owned();
            self.under_way.offer = Some(offer);
            self.texts.insert("offered".to_owned(), name);
        }
        let offer = self.under_way.offer.clone().ok_or("nothing was offered")?;
        Ok(recovered(Some(offer), Vec::new()))
    }

    /// What is found in place of the scene: nothing for `new`, kept edits, or a text.
    fn other(&self, name: &str, rest: &str) -> Result<Opened, String> {
        if rest == "new" {
            return Ok(Opened::New);
        }
        if let Some(kept) = rest.strip_prefix("kept ") {
            return Ok(Opened::Kept(self.text_of(kept)?));
        }
        let language = Language::of_path(Path::new(name)).map_err(|_| "no scene's name")?;
        let nothing = Baseline {
            scene: Document::new(language, String::new()).snapshot(),
            saves: 0,
            meshes: Meshes::default(),
            is_sound: false,
        };
        let reading = Reading::new(self.text_of(rest)?, nothing);
        Ok(Opened::Read(reading.expect("it fits into memory")))
    }

    /// The newest export.
    fn export(&self) -> Result<ExportId, String> {
        let newest = self.under_way.exports.keys().last().copied();
        newest
            .map(ExportId)
            .ok_or_else(|| "nothing is exported".to_owned())
    }

    /// The outcome of an export: of the newest, unless its number is said.
    fn export_outcome(&self, name: &str, rest: &str) -> Result<Msg, String> {
        let (first, others) = rest.split_once(' ').unwrap_or((rest, ""));
        let (id, rest) = match first.parse() {
            Ok(id) => (ExportId(id), others),
            Err(_) => (self.export()?, rest),
        };
        let path = self.under_way.exports.get(&id.0).ok_or("no such export")?;
        Ok(match name {
            "taken" => Msg::Taken(id, format!("{} exists", path.display())),
            "unwritten" => Msg::Exported(id, Err(rest.to_owned())),
            _ => exported(id, path, None),
        })
    }

    /// The reading of the track beside the scene, or of the one named before a colon: a text, or why
    /// there is none.
    fn track(&self, rest: &str) -> Result<Msg, String> {
        let (path, text) = rest.split_once(": ").unwrap_or(("scene.toml", rest));
        let path = PathBuf::from(path);
        let known = path.clone();
        let read = match text {
            "none" => Ok(None),
            "missing" => Err(ReadError::NotFound { path }),
            "folder" => Err(ReadError::NotRegular {
                path,
                kind: "a folder",
            }),
            "broken" => {
                let source = std::io::Error::other("broken");
                Err(ReadError::Io { path, source })
            }
            text => Ok(Some(self.text_of(text)?)),
        };
        Ok(Msg::TrackRead(known, read))
    }

    fn track_outcome(&self, rest: &str) -> Result<Msg, String> {
        if rest == "refused" {
            return Ok(Msg::TrackWritten(SaveOutcome::ChangedOnDisk));
        }
        let (path, text) = self.under_way.track.clone().ok_or("no key is written")?;
        Ok(Msg::TrackWritten(SaveOutcome::Saved { path, text }))
    }

    /// Remembers what the effects of the last step begin.
    pub(super) fn note(&mut self) {
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
pub(in crate::ui::app::tests) fn half_way(frame: u32) -> ReelProgress {
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

fn recovered(offer: Option<Offer>, complaints: Vec<String>) -> Msg {
    let offer = offer.map(Box::new);
    Msg::Recovered(Found { offer, complaints })
}

/// The number that is said.
pub(super) fn number<N: std::str::FromStr>(said: &str) -> Result<N, String> {
    let number = said.parse().ok();
    number.ok_or_else(|| format!("not a number: {said:?}"))
}
