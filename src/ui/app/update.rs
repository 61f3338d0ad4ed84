//! The step from one state to the next: dispatches messages.

use std::sync::Arc;

use super::shared::journal::KEPT_AFTER;
use super::{
    App, Grid, buffer, command, compare, display, exports, files, history, inspect, pasting,
    samples, sequence, suggesting, text, trace, tutor, whereabouts,
};
use crate::history_scene::NoPicture;
use crate::msg::{Effect, Msg, Target, Timer};
use render::Frame;

/// Why a renderer has ended that was not stopped.
const STOPPED: &str = "the renderer stopped early";

impl App {
    /// Processes a message and returns the resulting effects. Every step also updates the rooms, the
    /// pictures on screen, the journal of unsaved edits and the time to read a message, since any step may
    /// change what they depend on.
    pub fn update(&mut self, msg: Msg) -> Vec<Effect> {
        self.shared.overlays.begin_step();
        let had_errors = 0 < self.shared.error_count();
        let mut effects = self.take(msg);
        if had_errors && self.shared.error_count() == 0 {
            self.shared.overlays.forgive_errors();
        }
        self.shared.overlays.end_step();
        text::follow_input(&mut self.shared);
        self.settle();
        let shared = &mut self.shared;
        shared.scroll(&shared.areas());
        command::scroll_help(shared);
        effects.extend(display::follow_scene(shared));
        effects.extend(self.follow());
        effects.extend(display::follow(&mut self.shared));
        effects.extend(files::follow_edits(&mut self.shared));
        effects.extend(buffer::follow_edits(&mut self.shared));
        effects.extend(files::leave_once_pushed(&mut self.shared));
        let time = self.shared.overlays.time_to_read();
        effects.extend(time.map(|time| Effect::Later(time, Timer::Message)));
        effects
    }

    fn take(&mut self, msg: Msg) -> Vec<Effect> {
        let (shared, compare) = (&mut self.shared, &mut self.compare);
        let (sequence, thumbnails) = (&mut self.sequence, &mut self.thumbnails);
        match msg {
            Msg::Key(key) => return self.key(key),
            Msg::Mouse(event) => return self.pointer(event),
            Msg::Started(target, generation) => self.started(target, generation),
            Msg::Frame(target, frame) => return self.take_frame(target, frame),
            Msg::Refused(target, reason) => return self.ended(target, reason),
            Msg::Ended(target) => return self.ended(target, STOPPED.to_owned()),
            Msg::ReferenceRead(id, read) => {
                return compare::reference_read(compare, shared, id, read);
            }
            Msg::Compared(pair, found) => compare.measured(pair, found),
            Msg::Derived(ticket, derived) if samples::is_ticket(ticket) => {
                return samples::derived(&mut self.gallery, ticket, derived);
            }
            Msg::Derived(ticket, derived) => {
                return history::derived(thumbnails, shared, ticket, derived);
            }
            Msg::TrackRead(path, read) => {
                return sequence::track_read(sequence, shared, path, read);
            }
            Msg::TrackChanged => return sequence::reread(sequence).into_iter().collect(),
            Msg::TrackWritten(outcome) => return sequence::written(sequence, shared, outcome),
            Msg::Elapsed(Timer::Frame) => return sequence::play_on(sequence, shared),
            Msg::EditorClosed(outcome) => {
                let mut effects = files::editor_closed(shared, outcome);
                effects.extend(sequence::reread(sequence));
                return effects;
            }
            Msg::Paste(text) => return pasting::paste(shared, &text),
            Msg::Resize(columns, rows) => shared.terminal = (columns, rows),
            Msg::Grid { across, down } => {
                shared.pictures.grid = Grid { across, down };
                shared.pictures.preview.asked = None;
            }
            Msg::Recalled(recalled) => trace::recalled(shared, recalled),
            Msg::Explained(question, answer) => inspect::explained(shared, question, answer),
            Msg::Located(ticket, found) => {
                whereabouts::located(&mut self.whereabouts, ticket, found);
            }
            Msg::Buffer(news) => return buffer::heard(shared, news),
            Msg::FileChanged => return files::read_again(shared),
            Msg::Polled(what, reason) => files::polled(shared, what, reason),
            // The scene may have been given another name since the request.
            Msg::Read(path, read) if !shared.disk.is_own(&path) => drop(read),
            Msg::Opened(path, opened) => return files::other_scene_read(shared, path, opened),
            Msg::Read(_, read) if shared.disk.is_opening() => {
                return files::first_read(shared, read);
            }
            Msg::Read(_, read) => return files::was_read(shared, read),
            Msg::AssetsRead(wanted, loaded) => text::assets_read(shared, &wanted, loaded),
            Msg::AssetsChanged => return shared.assets.read(),
            Msg::Elapsed(Timer::Settled) => return files::settled(shared),
            Msg::Elapsed(Timer::Interrupt) => shared.jobs.interrupt = false,
            Msg::Elapsed(Timer::Click) => shared.cursor.forget_click(),
            Msg::Elapsed(Timer::Message) => shared.overlays.turn_message(),
            // The transient edit would be stored as well.
            Msg::Elapsed(timer @ Timer::Keep) if shared.transient.is_some() => {
                return vec![Effect::Later(KEPT_AFTER, timer)];
            }
            Msg::Elapsed(Timer::Keep) => return files::keep_edits(shared).into_iter().collect(),
            Msg::Elapsed(Timer::Push) => return buffer::push(shared),
            Msg::Elapsed(Timer::Lesson) => tutor::hint(&mut self.tutor),
            Msg::Elapsed(Timer::Writing) => return files::tick(shared),
            Msg::Saved(id, outcome) => return files::was_saved(shared, id, outcome),
            Msg::BackupsFound(copies) => files::backups_found(shared, &copies),
            Msg::Exported(id, outcome) => return exports::exported(shared, id, outcome),
            Msg::Filmed(id, progress) => sequence::filmed(shared, id, progress),
            Msg::FrameExported(exported) => shared.jobs.note_export(exported),
            Msg::Listed(folder, names) => command::folder_listed(shared, folder, names),
            Msg::Taken(id, reason) => return exports::is_taken(shared, id, reason),
            Msg::RecentListed(scenes) => files::show_recent(shared, scenes),
            Msg::Recovered(found) => files::found_kept(shared, found),
            Msg::Kept(revision, outcome) => {
                return files::kept(shared, revision, outcome).into_iter().collect();
            }
            Msg::Suspend => return vec![Effect::Suspend],
            Msg::Continued => return vec![Effect::TakeTerminal],
            Msg::Interrupt => return files::interrupt(shared),
            Msg::Terminate { .. } | Msg::HangUp => return files::quit_keeping_edits(shared),
            Msg::FewColours(depth) => shared.overlays.suggest(depth.cure()),
            Msg::Failed(reason) => shared.overlays.fail_too(&reason),
        }
        Vec::new()
    }

    /// Records the generation of a picture that was asked for.
    fn started(&mut self, target: Target, generation: u64) {
        let shared = &mut self.shared;
        match target {
            Target::Preview | Target::Trace => shared.pictures.want(target, Some(generation)),
            Target::Compared | Target::Reference => self.compare.want(target, Some(generation)),
            Target::Trial => shared.suggestions.started(generation),
            Target::Thumbnail => {
                self.thumbnails.started(generation);
                self.gallery.pictures.started(generation);
            }
            Target::Export => {}
        }
    }

    /// Takes a frame of a picture.
    fn take_frame(&mut self, target: Target, frame: Arc<Frame>) -> Vec<Effect> {
        let shared = &mut self.shared;
        match target {
            // Without a scene, it is of one that was left.
            Target::Preview | Target::Trace if shared.scene.is_some() => {
                let effects = suggesting::judge_picture(shared, target, &frame);
                let was_unseen = trace::in_background(shared).is_some();
                shared.pictures.take(target, frame);
                trace::end_unseen(shared, was_unseen);
                return effects;
            }
            Target::Preview | Target::Trace => {}
            Target::Compared | Target::Reference => {
                compare::take_frame(&mut self.compare, shared, target, frame);
            }
            Target::Trial => return suggesting::tried(shared, &frame),
            Target::Thumbnail => {
                self.thumbnails.take(&frame);
                self.gallery.pictures.take(&frame);
            }
            Target::Export => return exports::export_frame(shared, frame),
        }
        Vec::new()
    }

    /// Records that a picture will not be finished, and shows the reason.
    fn ended(&mut self, target: Target, reason: String) -> Vec<Effect> {
        let shared = &mut self.shared;
        match target {
            Target::Preview | Target::Trace => shared.pictures.want(target, None),
            Target::Compared | Target::Reference => self.compare.want(target, None),
            Target::Trial => return suggesting::end_trials(shared),
            Target::Thumbnail => {
                self.thumbnails.fail(NoPicture::Failed(reason.clone()));
                self.gallery.pictures.fail(NoPicture::Failed(reason));
                return Vec::new();
            }
            Target::Export => return exports::export_ended(shared, reason),
        }
        shared.fail(reason);
        Vec::new()
    }
}
