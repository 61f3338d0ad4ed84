//! The parts of the status line: if not all fit, the least important ones are omitted.

use ratatui::style::Style;
use unicode_width::UnicodeWidthStr;

use crate::theme;
use crate::view::row::Row;

/// Maximum number of cells between two segments.
const GAP: usize = 3;

/// What a segment tells, in order of importance.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Rank {
    /// The mode.
    Mode,
    /// What the mode shows, and the number of errors.
    State,
    /// The mark of unsaved edits, which is placed next to the file name.
    Unsaved,
    /// What the user must not overlook.
    Notice,
    /// The message. What is more important is always shown.
    Message,
    /// The name of the scene's file.
    FileName,
    /// What is being exported, drawn or compared.
    Work,
    /// How the picture differs from what the text says, or that files are still missing from it.
    Departure,
    /// The speed of the link.
    Link,
    /// Warnings, and settings that bias the picture.
    Caveat,
    /// The scale of the picture, and that of its colours.
    Scale,
    /// The frame of a track that values are keyed at.
    Frame,
    /// The share of the picture that is traced, which begins its progress.
    Share,
    /// The samples per pixel.
    Samples,
    /// The noise of the picture.
    Noise,
    /// The time left.
    TimeLeft,
    /// The time that tracing has taken.
    Elapsed,
    /// The pass, and how many there are.
    Pass,
    /// The rays per second.
    Rate,
    /// The samples that exceeded their ray budget.
    OverBudget,
    /// The scene's own integrator, which ends the progress of the picture.
    Integrator,
    /// The size of the picture.
    Size,
    /// The colours of the terminal.
    Colours,
}

impl Rank {
    /// Whether it belongs to the progress of the picture.
    fn is_progress(self) -> bool {
        (Self::Share..=Self::Integrator).contains(&self)
    }
}

/// A part of the status line, omitted if more important ones need its room.
#[derive(Debug)]
struct Segment {
    rank: Rank,
    text: String,
    style: Style,
}

/// The parts of the status line, from left to right.
#[derive(Debug, Default)]
pub(super) struct Segments(Vec<Segment>);

impl Segments {
    /// Adds a segment on the right.
    pub(super) fn say(&mut self, rank: Rank, text: impl Into<String>, style: Style) {
        let text = text.into();
        self.0.push(Segment { rank, text, style });
    }

    /// Draws the segments that fit. A message that would be cut is omitted.
    pub(super) fn render(mut self, row: &mut Row) {
        if self.cuts_message(row.room()) {
            self.0.retain(|segment| segment.rank != Rank::Message);
        }
        let fitting = self.fitting(row.room());
        for (index, segment) in fitting.iter().enumerate() {
            if 0 < index {
                row.put(" ", Style::new());
                if segment.rank.is_progress() && fitting[index - 1].rank.is_progress() {
                    row.put("· ", theme::DIM);
                } else if 1 < index && segment.rank != Rank::Unsaved {
                    row.put(" ", Style::new());
                }
            }
            row.put(&segment.text, segment.style);
        }
    }

    /// Whether the message would be cut after the more important parts.
    pub(super) fn cuts_message(&self, room: usize) -> bool {
        let ranked = self
            .0
            .iter()
            .filter(|segment| segment.rank <= Rank::Message);
        let widths = ranked.map(|segment| segment.text.width() + GAP);
        let mut all = self.0.iter();
        all.any(|segment| segment.rank == Rank::Message) && room + GAP < widths.sum()
    }

    /// The segments that fit, in order; the most important ones may be shortened.
    fn fitting(&self, room: usize) -> Vec<&Segment> {
        let segments = &self.0;
        let mut ranked: Vec<usize> = (0..segments.len()).collect();
        ranked.sort_by_key(|&at| segments[at].rank);
        let mut left = room + GAP;
        let mut kept: Vec<usize> = ranked
            .into_iter()
            .filter(|&at| {
                let width = segments[at].text.width() + GAP;
                // A part of an important segment is better than nothing.
                let may_be_cut = segments[at].rank <= Rank::Message && 2 * GAP < left;
                let fits = width <= left || may_be_cut;
                left -= if fits { width.min(left) } else { 0 };
                fits
            })
            .collect();
        kept.sort_unstable();
        kept.into_iter().map(|at| &segments[at]).collect()
    }
}
