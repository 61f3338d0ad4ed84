//! The undo history as a page: its steps with pictures of the texts after them, and jumping to any.

use ratatui::layout::Rect;

use super::Shared;
use super::page::{List, Page};
use super::steps::Steps;
use super::thumbnails::{Look, Rank, Slot};
use crate::render::{Frames, Job, Settings};
use crate::scene::{Camera, Filter, Integrator, Rendering};
use crate::ui::history_layout::HistoryLayout;
use crate::ui::history_scene::{HistoryScene, HistoryText, NoPicture};
use crate::ui::layout::{raster, split_bottom};
use crate::ui::msg::{Effect, Target};

/// Objects and bytes of text beyond which only the selected step has a picture: each one takes a
/// second or more to derive.
const MOST_OBJECTS: usize = 200_000;
const MOST_BYTES: usize = 16 << 20;

/// Samples per pixel of the pictures in rows and of the large one.
const WHITTED_SAMPLES: [u32; 2] = [4, 16];
const PATH_SAMPLES: [u32; 2] = [64, 128];

impl Shared {
    /// Opens the page of the undo history at the present text.
    pub(super) fn list_steps(&mut self) {
        self.document.end_step();
        let steps = Steps::of(&self.document);
        if steps.rows.len() < 2 {
            self.overlays.say("nothing has been changed yet");
            return;
        }
        let present = steps.present;
        let mut page = Page::new(List::Steps(steps));
        page.filter.at = present;
        self.overlays.page = Some(page);
    }

    /// Goes to a text of the history by undo or redo; every step in between can be redone or undone
    /// as ever.
    pub(super) fn go_to_state(&mut self, at: usize) {
        let present = self.document.present();
        let steps = present.abs_diff(at);
        if steps == 0 {
            self.overlays.say("this is the present text");
            return;
        }
        let is_back = at < present;
        for _ in 1..steps {
            if is_back {
                self.undo_text();
            } else {
                self.redo_text();
            }
        }
        if 1 < steps {
            self.relower();
        }
        let done = if is_back {
            self.step_back()
        } else {
            self.step_forward()
        };
        let done = if steps == 1 {
            done
        } else {
            let verb = if is_back { "undone" } else { "redone" };
            let name = Steps::of(&self.document).rows.into_iter().nth(at);
            name.map(|(_, name)| format!("{steps} steps {verb}, to: {name}"))
        };
        self.overlays.say(done.unwrap_or_default());
    }

    /// The places on the page of the history in an area above the status line.
    pub fn history_layout(&self, body: Rect) -> HistoryLayout {
        if self.thumbnails.has_colours {
            HistoryLayout::with_pictures(body)
        } else {
            HistoryLayout::with_names(body)
        }
    }

    /// Brings the page of the history up to date, and requests the next picture on it. Stops tracing
    /// if the page is closed.
    pub(super) fn follow_steps(&mut self) -> Vec<Effect> {
        let Some((page, steps)) = self.open_steps() else {
            let is_under_way = self.thumbnails.cancel();
            let stop = is_under_way.then_some(Effect::Stop(Target::Thumbnail));
            return stop.into_iter().collect();
        };
        if steps.revision != self.document.revision() {
            let was_here = page.chosen() == Some(steps.present);
            let steps = Steps::of(&self.document);
            let present = steps.present;
            if let Some(page) = &mut self.overlays.page {
                page.list = List::Steps(steps);
                if was_here {
                    page.choose(present);
                }
                page.go(0);
            }
        }
        if self.assets.are_awaited() {
            return Vec::new();
        }
        self.thumbnails.look(Look {
            view: self.pictures.view,
            integrator: self.pictures.rendering.integrator,
        });
        let wanted = self.wanted_slots();
        match self.thumbnails.next(&wanted) {
            Some((slot, ticket)) => self.derive(slot, ticket).into_iter().collect(),
            None => Vec::new(),
        }
    }

    /// The pictures on the page, the most urgent first: those in rows from the selected one outwards,
    /// which take less time, then the large one.
    fn wanted_slots(&self) -> Vec<Slot> {
        let Some((page, steps)) = self.open_steps() else {
            return Vec::new();
        };
        let strip = self.history_layout(self.body());
        let shown = page.rows();
        let id = |row: usize| {
            let (index, _) = shown.get(row)?;
            steps.rows.get(*index).map(|(id, _)| *id)
        };
        let at = page.filter.at;
        let large = strip.large.and_then(|large| {
            Some(Slot {
                id: id(at)?,
                rank: Rank::Large,
                room: (large.width, large.height),
            })
        });
        let thumbnail = strip.thumbnail.filter(|_| !self.is_large());
        let mut rows: Vec<_> = strip.rows(at, shown.len()).map(|(row, _)| row).collect();
        rows.sort_by_key(|row| row.abs_diff(at));
        let rows = rows.into_iter().filter_map(|row| {
            Some(Slot {
                id: id(row)?,
                rank: Rank::Row,
                room: thumbnail?,
            })
        });
        rows.chain(large).collect()
    }

    /// The rows that Page Down moves on the page of the history.
    pub(super) fn step_rows(&self) -> isize {
        let strip = self.history_layout(self.body());
        (strip.list.height / strip.height) as isize
    }

    /// The area above the status line.
    fn body(&self) -> Rect {
        let (columns, lines) = self.terminal;
        let areas = self.areas();
        let bars = areas.hint.height + areas.status.height;
        split_bottom(Rect::new(0, 0, columns, lines), bars).0
    }

    /// The page of the history, if it is open.
    pub fn open_steps(&self) -> Option<(&Page, &Steps)> {
        let page = self.overlays.page.as_ref()?;
        match &page.list {
            List::Steps(steps) => Some((page, steps)),
            List::Views(..) | List::Recent(_) => None,
        }
    }

    /// Whether the scene is too large for many pictures.
    pub fn is_large(&self) -> bool {
        let objects = self.scene.as_ref().map_or(0, |scene| scene.objects.len());
        MOST_OBJECTS < objects || MOST_BYTES < self.document.text().len()
    }

    /// Requests the scene of a text, which takes too long to be derived here.
    fn derive(&self, slot: Slot, ticket: u64) -> Option<Effect> {
        let mut states = self.document.states();
        let at = states.position(|state| state.id == slot.id)?;
        Some(Effect::Derive(Box::new(HistoryText {
            ticket,
            timeline: self.document.timeline(),
            at,
            scene: self.disk.path.clone(),
            files: self.assets.known(),
        })))
    }

    /// Traces a scene that was derived for a picture of the history.
    pub(super) fn derived(
        &mut self,
        ticket: u64,
        derived: Result<HistoryScene, NoPicture>,
    ) -> Vec<Effect> {
        let slot = self.thumbnails.asked(ticket);
        let job = match (slot, derived) {
            (Some(slot), Ok(past)) => self.thumbnail_job(slot, past),
            (Some(_), Err(reason)) => {
                self.thumbnails.fail(reason);
                return Vec::new();
            }
            (None, Ok(past)) => return vec![Effect::Free(past.scene)],
            (None, Err(_)) => return Vec::new(),
        };
        job.map(|job| Effect::Trace(Target::Thumbnail, job))
            .into_iter()
            .collect()
    }

    /// The job of a picture: as the preview would show the text, from the working view if there is
    /// one, so that pictures differ only by their texts; but always light, as files hold it.
    fn thumbnail_job(&mut self, slot: Slot, past: HistoryScene) -> Option<Job> {
        let own = past.scene.camera;
        let view = self.pictures.view.map(|view| Camera {
            size: own.size,
            ..view
        });
        let camera = view.unwrap_or(own);
        let room = Rect::new(0, 0, slot.room.0, slot.room.1);
        let Some((_, size)) = raster(room, camera.size) else {
            self.thumbnails
                .fail(NoPicture::Failed("there is no room".to_owned()));
            return None;
        };
        let rendering = self.pictures.rendering(Some(&past.scene));
        let rendering = Rendering {
            spp: Some(samples(rendering.integrator(), slot.rank)),
            filter: Some(Filter::Box),
            ..rendering
        };
        Some(Job {
            settings: Settings::new(size, &rendering),
            scene: past.scene,
            images: past.images,
            camera,
            limit: None,
            frames: Frames::Live,
            denoise: false,
            numbers: None,
        })
    }
}

fn samples(integrator: Integrator, rank: Rank) -> u32 {
    let [row, large] = match integrator {
        Integrator::Whitted => WHITTED_SAMPLES,
        Integrator::Path | Integrator::Photon => PATH_SAMPLES,
    };
    match rank {
        Rank::Row => row,
        Rank::Large => large,
    }
}
