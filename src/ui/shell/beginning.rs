//! Starts reading the scene before the terminal is taken.

use std::sync::mpsc::{Receiver, Sender};
use std::time::{Duration, Instant};

use super::ending::Error;
use crate::app::App;
use crate::event::{Event, Work};
use crate::msg::{Effect, Msg};
use crate::service::scene_loader::SceneLoader;

/// Time for which the terminal is left alone while the scene is read. Most files are read by then
/// and appear on the first screen; otherwise the first screen shows which file is being opened.
const PATIENCE: Duration = Duration::from_millis(40);

/// The interface before it has a terminal.
pub(super) struct Beginning {
    /// State of the interface.
    pub(super) app: App,
    /// The thread that reads the scene.
    pub(super) reader: SceneLoader,
    /// Effects to perform once there is a terminal.
    pub(super) effects: Vec<Effect>,
    /// The number of pieces of work under way.
    pub(super) at_work: usize,
    sender: Sender<Event>,
}

impl Beginning {
    /// Starts reading the scene and waits for [`PATIENCE`] at most. Fails if the scene cannot be
    /// read.
    pub(super) fn new(
        app: App,
        effects: Vec<Effect>,
        reader: SceneLoader,
        (sender, inbox): (Sender<Event>, &Receiver<Event>),
    ) -> Result<Self, Error> {
        let mut beginning = Self {
            app,
            reader,
            effects: Vec::new(),
            at_work: 0,
            sender,
        };
        beginning.perform(effects);
        let deadline = Instant::now() + PATIENCE;
        while beginning.app.shared.disk.is_opening() {
            let left = deadline.saturating_duration_since(Instant::now());
            match inbox.recv_timeout(left) {
                Ok(Event::Msg(msg)) => beginning.step(msg),
                Ok(Event::Begun) => beginning.at_work += 1,
                Ok(Event::Done) => beginning.at_work -= 1,
                _ => break,
            }
            if let Some(error) = beginning.app.shared.disk.take_failure() {
                return Err(error.into());
            }
        }
        Ok(beginning)
    }

    fn step(&mut self, msg: Msg) {
        let effects = self.app.update(msg);
        self.perform(effects);
    }

    fn perform(&mut self, effects: Vec<Effect>) {
        for effect in effects {
            let requested = match effect {
                Effect::Watch(path) => self.reader.watch(path),
                Effect::Read(path, known) => {
                    self.reader.read(path, known, Work::begin(&self.sender))
                }
                Effect::Open(path, language) => {
                    self.reader.open(path, language, Work::begin(&self.sender))
                }
                other => {
                    self.effects.push(other);
                    Ok(())
                }
            };
            if let Err(ended) = requested {
                self.step(Msg::Failed(ended.to_string()));
            }
        }
    }
}
