//! Small pictures of the texts in the history: which are known, and which one is under way.

use std::collections::VecDeque;
use std::sync::Arc;

use crate::app::pictures::cell_image::CellImage;
use crate::history_scene::NoPicture;
use document::StateId;
use render::Frame;
use scene::{Camera, Integrator};

/// The number of pictures kept in rows and at the side: less than 4 MB on a screen of 250×80 cells.
const KEPT: [usize; 2] = [256, 16];

/// What a picture is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rank {
    /// A row of the list.
    Row,
    /// The large picture of the selected step.
    Large,
}

/// A picture that the page shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Slot<I = StateId> {
    /// The text.
    pub(crate) id: I,
    /// What it is for.
    pub(crate) rank: Rank,
    /// Columns and lines that it must fit into.
    pub(crate) room: (u16, u16),
}

/// What is known of a picture.
pub type Thumbnail = Result<CellImage, NoPicture>;

/// The pictures of a page's texts, which are told apart by an `I`: the last that were needed.
#[derive(Debug)]
pub struct Thumbnails<I = StateId> {
    /// What they depend on besides the texts.
    look: Look,
    /// For each slot its picture; those of newer requests last.
    kept: VecDeque<(Slot<I>, Thumbnail)>,
    /// The picture under way.
    pending: Option<Pending<I>>,
    /// The number of requests so far.
    tickets: u64,
    /// The revision of the text whose history the page lists, and the index of the present text there.
    pub(super) listed: Option<(u64, usize)>,
}

/// What all pictures depend on besides their texts: the working view, from which all are seen as the
/// preview would be, the user's integrator, and the files that the scene names.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Look {
    pub(crate) view: Option<Camera>,
    pub(crate) integrator: Option<Integrator>,
    /// How many readings of files have changed what pictures show.
    pub(crate) files: u64,
}

#[derive(Clone, Copy, Debug)]
struct Pending<I> {
    slot: Slot<I>,
    ticket: u64,
    /// The renderer's number of the picture, once it is traced.
    generation: Option<u64>,
}

impl<I> Default for Thumbnails<I> {
    fn default() -> Self {
        Self::numbered_from(0)
    }
}

impl<I> Thumbnails<I> {
    /// No pictures yet; requests have tickets after this one.
    pub(crate) fn numbered_from(tickets: u64) -> Self {
        Self {
            look: Look::default(),
            kept: VecDeque::new(),
            pending: None,
            tickets,
            listed: None,
        }
    }
}

impl<I: Copy + PartialEq> Thumbnails<I> {
    /// What is known of a picture; `None` if nothing yet. One of another size will do until it is
    /// traced in its own.
    pub fn get(&self, id: I, rank: Rank) -> Option<&Thumbnail> {
        let is_it = |(slot, _): &&(Slot<I>, Thumbnail)| (slot.id, slot.rank) == (id, rank);
        self.kept.iter().rev().find(is_it).map(|(_, known)| known)
    }

    /// Whether a picture is under way.
    pub fn are_awaited(&self) -> bool {
        self.pending.is_some()
    }

    /// Forgets all pictures.
    pub(crate) fn forget(&mut self) {
        self.kept.clear();
    }

    /// Forgets all pictures if they look otherwise now.
    pub(crate) fn look(&mut self, look: Look) {
        if self.look != look {
            self.look = look;
            self.kept.clear();
            // What is under way shows the former look.
            self.pending = None;
        }
    }

    /// The slot to request next, of those wanted, the most urgent first; `None` while one of them is
    /// under way, or if all are known.
    pub(crate) fn next(&mut self, wanted: &[Slot<I>]) -> Option<(Slot<I>, u64)> {
        let is_wanted = |pending: &Pending<I>| wanted.contains(&pending.slot);
        if self.pending.as_ref().is_some_and(is_wanted) {
            return None;
        }
        self.pending = None;
        let is_known = |slot: &Slot<I>| self.kept.iter().any(|(known, _)| known == slot);
        let slot = *wanted.iter().find(|slot| !is_known(slot))?;
        self.tickets += 1;
        self.pending = Some(Pending {
            slot,
            ticket: self.tickets,
            generation: None,
        });
        Some((slot, self.tickets))
    }

    /// Gives up what is under way; returns whether anything was.
    pub(crate) fn cancel(&mut self) -> bool {
        self.pending.take().is_some()
    }

    /// The slot that a scene was derived for, unless that is no longer wanted.
    pub(crate) fn asked(&self, ticket: u64) -> Option<Slot<I>> {
        let pending = self.pending.filter(|pending| pending.ticket == ticket);
        pending.map(|pending| pending.slot)
    }

    /// Notes the generation of the picture that is being traced.
    pub(crate) fn started(&mut self, generation: u64) {
        if let Some(pending) = &mut self.pending {
            pending.generation = Some(generation);
        }
    }

    /// Takes a frame of the picture under way.
    pub(crate) fn take(&mut self, frame: &Arc<Frame>) {
        let is_it = |pending: &Pending<I>| pending.generation == Some(frame.generation);
        let Some(pending) = self.pending.filter(is_it) else {
            return;
        };
        let shown = CellImage {
            size: frame.size,
            pixels: frame.pixels.clone(),
            objects: frame.objects.clone(),
            outline: Vec::new(),
        };
        if frame.progress.complete {
            self.pending = None;
        }
        self.keep(pending.slot, Ok(shown));
    }

    /// Records why the picture under way does not exist.
    pub(crate) fn fail(&mut self, reason: NoPicture) {
        if let Some(pending) = self.pending.take() {
            self.keep(pending.slot, Err(reason));
        }
    }

    fn keep(&mut self, slot: Slot<I>, picture: Thumbnail) {
        self.kept
            .retain(|(known, _)| (known.id, known.rank) != (slot.id, slot.rank));
        self.kept.push_back((slot, picture));
        let [rows, large] = KEPT;
        let most = match slot.rank {
            Rank::Row => rows,
            Rank::Large => large,
        };
        let alike = |(known, _): &(Slot<I>, Thumbnail)| known.rank == slot.rank;
        if most < self.kept.iter().filter(|known| alike(known)).count()
            && let Some(oldest) = self.kept.iter().position(alike)
        {
            self.kept.remove(oldest);
        }
    }
}
