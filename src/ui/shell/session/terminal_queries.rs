//! Asks the terminal what it can show, and draws accordingly.

use std::io;
use std::time::Instant;

use super::Session;
use super::pixels::{Known, Manner, most_pixels};
use crate::msg::Msg;
use crate::pixels::Pixels;
use crate::terminal::query::{self, Question};
use crate::terminal::{self, Choice, ColourDepth};

impl Session {
    /// Queries what neither the user nor the environment has decided, and how keys are reported.
    pub(super) fn ask_at_start(&mut self) -> io::Result<()> {
        let is_open = self.choice == Choice::Auto
            && self.depth < ColourDepth::TrueColour
            && is_coloured(variable);
        let colours = is_open.then_some(Question::Colours);
        let pictures = self.wants_answers().then_some(Question::Pictures);
        let keys = [Question::Keys];
        let questions: Vec<_> = colours.into_iter().chain(pictures).chain(keys).collect();
        self.put(&questions)
    }

    /// Whether the terminal is still to be asked how it shows pictures.
    fn wants_answers(&self) -> bool {
        let is_open = match self.app.shared.pixels {
            Pixels::Auto => self.shows_pictures(),
            Pixels::Kitty | Pixels::Sixel | Pixels::Iterm => true,
            Pixels::Half | Pixels::Quadrant | Pixels::Sextant | Pixels::Octant => false,
        };
        is_open && !self.known.was_asked
    }

    /// Whether pictures may be shown without being chosen: a user who wants few colours does not
    /// want more in pictures.
    fn shows_pictures(&self) -> bool {
        match self.choice {
            Choice::Auto => is_coloured(variable),
            Choice::Fixed(depth) => depth == ColourDepth::TrueColour,
        }
    }

    /// Asks the terminal, if there is one that may be asked.
    fn put(&mut self, questions: &[Question]) -> io::Result<()> {
        self.known.was_asked |= questions.contains(&Question::Pictures);
        let tty = self.runtime.screen().tty();
        let Some(tty) = tty.filter(|tty| query::may_ask(variable) && tty.terminal.is_ours()) else {
            return Ok(());
        };
        tty.ask(questions)?;
        let until = Instant::now() + query::PATIENCE;
        if questions.contains(&Question::Colours) {
            self.asked_until = Some(until);
        }
        self.known.until = Some(until);
        Ok(())
    }

    /// What pixels are to be drawn with.
    pub(super) fn wanted_manner(&mut self) -> Manner {
        let is_page = !self.runtime.screen().is_terminal();
        let cell = terminal::cell_size().filter(|_| !is_page);
        let choice = match self.app.shared.pixels {
            // A page has cells only.
            Pixels::Kitty | Pixels::Sixel | Pixels::Iterm if is_page => Pixels::Auto,
            choice => choice,
        };
        let screen = self.app.shared.terminal;
        let is_plain = choice == Pixels::Auto && (is_page || !self.shows_pictures());
        let nothing = Known::default();
        let known = if is_plain { &nothing } else { &self.known };
        Manner::of(choice, self.depth, known, screen, cell)
    }

    /// Draws pixels with what the user wants and the terminal can show.
    pub(super) fn fit_pixels(&mut self) -> io::Result<()> {
        if self.wants_answers() {
            self.put(&[Question::Pictures])?;
        }
        let manner = self.wanted_manner();
        if manner != self.manner {
            let (before, after) = (self.manner.means(), manner.means());
            self.manner = manner;
            self.inks.drawing = manner.drawing();
            if before != after
                && let Some(tty) = self.runtime.screen().tty()
            {
                tty.terminal.set_means(after);
            }
        }
        let choice = self.app.shared.pixels;
        if self.known.refused != Some(choice)
            && let Some(reason) = self.known.refusal(choice, manner)
            && self.runtime.screen().is_terminal()
        {
            self.known.refused = Some(choice);
            self.step(Msg::Failed(reason.to_owned()));
        }
        let most = most_pixels(&self.link);
        let (across, down) = manner.grid(self.app.shared.terminal, most);
        let grid = self.app.shared.pictures.grid;
        if (grid.across, grid.down) != (across, down) {
            self.step(Msg::Grid { across, down });
        }
        Ok(())
    }
}

/// Whether the environment does not forbid colours.
fn is_coloured(variable: impl Fn(&str) -> Option<String>) -> bool {
    variable("NO_COLOR").is_none_or(|value| value.is_empty())
}

fn variable(name: &str) -> Option<String> {
    std::env::var(name).ok()
}
