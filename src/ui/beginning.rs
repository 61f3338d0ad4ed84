//! What comes before the terminal is taken: reading the scene, for a moment.

use std::sync::mpsc::Receiver;
use std::time::{Duration, Instant};

use super::Error;
use super::app::App;
use super::effects::Event;
use super::msg::{Effect, Msg};
use super::reading::Reader;

/// How long the terminal is left alone while the scene is read. Most files are read within it, and
/// the first screen shows them; after it the first screen shows what is being opened.
const PATIENCE: Duration = Duration::from_millis(40);

/// The interface before it has a terminal.
pub(super) struct Beginning {
    /// What it knows.
    pub(super) app: App,
    /// The thread that reads the scene.
    pub(super) reader: Reader,
    /// What is left to be done once there is a terminal.
    pub(super) effects: Vec<Effect>,
}

impl Beginning {
    /// Has the scene read, and waits for it until it is known to take long. The error is that the
    /// scene can't be read.
    pub(super) fn new(
        app: App,
        effects: Vec<Effect>,
        reader: Reader,
        inbox: &Receiver<Event>,
    ) -> Result<Self, Error> {
        let mut beginning = Self {
            app,
            reader,
            effects: Vec::new(),
        };
        beginning.perform(effects);
        let deadline = Instant::now() + PATIENCE;
        while beginning.app.is_opening() {
            let left = deadline.saturating_duration_since(Instant::now());
            let Ok(Event::Msg(msg)) = inbox.recv_timeout(left) else {
                break;
            };
            beginning.step(msg);
            if let Some(error) = beginning.app.unreadable.take() {
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
            let ordered = match effect {
                Effect::Watch(path) => self.reader.watch(path),
                Effect::Read(path, known) => self.reader.read(path, known),
                other => {
                    self.effects.push(other);
                    Ok(())
                }
            };
            if let Err(reason) = ordered {
                self.step(Msg::Failed(reason));
            }
        }
    }
}
