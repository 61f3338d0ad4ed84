//! Exports: pictures written in the background, one after the other.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::refusing::Refusable;
use super::shared::jobs::{Asking, ExportWork, Pending};
use super::{Dialog, Export, Question, Shared, Stage, display, files};
use crate::msg::{Destination, Effect, Existing, ExportId, Exported, Origin, Target};
use crate::reel::names_sequence;
use image_file::{ImageFormat, known_extensions};
use render::{Frame, Frames, Job};
use scene::{MAX_SPP, Size, Viewpoint};

/// The picture to export; fields that are `None` are taken from the scene.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct ExportOrder {
    pub(crate) path: Option<PathBuf>,
    pub(crate) size: Option<Size>,
    pub(crate) spp: Option<u32>,
}

impl ExportOrder {
    /// Parses `[FILE] [WxH] [SPP]`; the file name may contain blanks.
    pub(crate) fn parse(said: &str) -> Result<Self, String> {
        let mut words: Vec<_> = said.split_whitespace().collect();
        let mut spp = None;
        if let Some(count) = words.last().and_then(|word| word.parse().ok()) {
            if !(1..=MAX_SPP).contains(&count) {
                return Err(format!("{count}: samples per pixel must be 1 to {MAX_SPP}"));
            }
            spp = Some(count);
            words.pop();
        }
        let size = words.last().and_then(|word| Size::parse(word));
        if size.is_some() {
            words.pop();
        }
        if let Some(wrong) = wrong_word(&words) {
            return Err(wrong);
        }
        let path = (!words.is_empty()).then(|| PathBuf::from(words.join(" ")));
        Ok(Self { path, size, spp })
    }
}

/// Finds fault with a word left after the picture's name.
fn wrong_word(words: &[&str]) -> Option<String> {
    let is_picture = |word: &&str| ImageFormat::of_path(Path::new(word)).is_some();
    let word = match words.iter().rposition(is_picture) {
        Some(name) => words.get(name + 1)?,
        None => words.last()?,
    };
    let numbers = |extra: &str| {
        let known = |c: char| c.is_ascii_digit() || extra.contains(c);
        word.starts_with(|c: char| c.is_ascii_digit()) && word.chars().all(known)
    };
    if numbers("") {
        Some(format!("{word}: samples per pixel must be 1 to {MAX_SPP}"))
    } else if numbers("xX×*") {
        Some(format!("`{word}`: expected a size such as 800x600"))
    } else if words.last().is_some_and(is_picture) || !words.iter().any(is_picture) {
        None
    } else {
        Some(format!("`{word}` is neither a size nor a sample count"))
    }
}

/// Exports to the scene's folder under the scene's name. If another program has written that
/// file, the user is asked.
pub(crate) fn export_default(shared: &mut Shared) -> Vec<Effect> {
    export(shared, ExportOrder::default(), Asking::Yes)
}

/// Exports the scene as it is seen, after the exports that were started before.
pub(crate) fn export(shared: &mut Shared, order: ExportOrder, asking: Asking) -> Vec<Effect> {
    let path = order.path.unwrap_or_else(|| export_path(shared));
    let size = order.size.unwrap_or_else(|| shared.output());
    let spp = order.spp.unwrap_or_else(|| shared.rendering().spp());
    let spp = shared.pictures.samples(spp);
    let Some(mut job) = export_job(shared, &path, size, spp).or_refuse_picture(shared) else {
        return Vec::new();
    };
    // Frames the view for the size that is written.
    job.camera.size = size;
    let making = match traced(shared, size, spp).filter(|_| job.frames == Frames::Last) {
        Some(frame) => ExportWork::Write(frame),
        None => ExportWork::Trace(Box::new(job)),
    };
    let says_origin = ImageFormat::of_path(&path).is_some_and(ImageFormat::has_metadata);
    let destination = Destination {
        origin: says_origin.then(|| origin(shared)).flatten(),
        path,
        existing: asking.existing(),
        scene: shared.disk.path.clone(),
        named: shared.assets.files().to_vec(),
    };
    begin(shared, destination, (size, spp), making, asking)
}

/// Begins an export with this size and number of samples per pixel, or queues it behind the running one.
pub(crate) fn begin(
    shared: &mut Shared,
    destination: Destination,
    (size, spp): (Size, u32),
    making: ExportWork,
    asking: Asking,
) -> Vec<Effect> {
    let (frames, progress) = match &making {
        ExportWork::Trace(_) => (None, None),
        ExportWork::Write(frame) => (None, Some(frame.progress)),
        ExportWork::Film(reel) => (Some(reel.track.frames), None),
    };
    let export = Export {
        id: shared.jobs.next_export(),
        stage: Stage::Tracing,
        destination,
        size,
        spp,
        aov: shared.pictures.aov,
        frames,
        reel: None,
        progress,
        written_for: 0,
    };
    announce_export(shared, &export);
    begin_or_queue(
        shared,
        Pending {
            export,
            making,
            asking,
        },
    )
}

/// Says what is exported, and whether that has to wait.
fn announce_export(shared: &mut Shared, export: &Export) {
    let [begun, queued] = announcements(export);
    let words = match shared.jobs.export() {
        Some(_) => queued,
        None => begun,
    };
    if shared.error_count() == 0 {
        shared.say(words);
    } else {
        let why = "the text has errors: this is the last valid scene";
        shared.warn(format!("{words}; {why}"));
    }
}

/// Takes back that an export has begun or waits.
fn withdraw_announcement(shared: &mut Shared, export: &Export) {
    for stale in announcements(export) {
        shared.overlays.withdraw(&stale);
    }
}

/// Begins an export, or queues it behind the one under way.
fn begin_or_queue(shared: &mut Shared, pending: Pending) -> Vec<Effect> {
    if shared.jobs.export().is_some() {
        shared.jobs.queue(pending);
        return Vec::new();
    }
    shared.jobs.begin_export(pending)
}

/// Starts the next export that waits, or performs a pending quit if there is none.
fn next_export(shared: &mut Shared) -> Vec<Effect> {
    match shared.jobs.next_pending() {
        Some(pending) => shared.jobs.begin_export(pending),
        None => files::leave_when_done(shared),
    }
}

/// Takes a frame of the picture that is exported; the last one is written.
pub(crate) fn export_frame(shared: &mut Shared, frame: Arc<Frame>) -> Vec<Effect> {
    let Some(export) = shared.jobs.export_mut() else {
        return Vec::new();
    };
    export.progress = Some(frame.progress);
    if !frame.progress.complete {
        return Vec::new();
    }
    export.stage = Stage::Writing;
    let mut effects = vec![
        Effect::WriteImage(export.id, frame, export.destination.clone()),
        Effect::Stop(Target::Export),
    ];
    effects.extend(shared.jobs.count_seconds());
    effects
}

/// Records that the picture of an export will not be finished.
pub(crate) fn export_ended(shared: &mut Shared, reason: String) -> Vec<Effect> {
    let traced = |export: &Export| export.stage == Stage::Tracing;
    if shared.jobs.end_export(traced).is_none() {
        return Vec::new();
    }
    shared.jobs.next = None;
    shared.fail(reason);
    next_export(shared)
}

/// Takes the outcome of an export, and begins the next one.
pub(crate) fn exported(
    shared: &mut Shared,
    id: ExportId,
    outcome: Result<Exported, String>,
) -> Vec<Effect> {
    let Some(export) = shared.jobs.end_export(|export| export.id == id) else {
        // A cancelled export: nobody waits for it, but its file exists now.
        if let Ok(exported) = outcome {
            shared.say(format!("wrote {} anyway", exported.path.display()));
            shared.jobs.note_export(exported);
        }
        return Vec::new();
    };
    let mut effects = Vec::new();
    withdraw_announcement(shared, &export);
    match outcome {
        Ok(exported) => {
            let path = exported.path.display();
            shared.say(format!("wrote {path}{}", export.summary()));
            shared.jobs.note_export(exported);
        }
        Err(reason) => {
            shared.jobs.next = None;
            shared.fail(reason);
            effects = export.stop();
        }
    }
    effects.extend(next_export(shared));
    effects
}

/// Handles that another program has written the file of an export: asks whether to overwrite
/// it, or reports that it is kept.
pub(crate) fn is_taken(shared: &mut Shared, id: ExportId, reason: String) -> Vec<Effect> {
    let asks = shared.jobs.is_asking() && shared.overlays.dialog.is_none();
    if !asks || shared.jobs.export().map(|export| export.id) != Some(id) {
        return exported(shared, id, Err(reason));
    }
    let Some(pending) = shared.jobs.take_back() else {
        return Vec::new();
    };
    withdraw_announcement(shared, &pending.export);
    let mut effects = pending.export.stop();
    shared.overlays.dialog = Some(Dialog::Overwrite(Box::new(pending)));
    if let Some(next) = shared.jobs.next_pending() {
        effects.extend(shared.jobs.begin_export(next));
    }
    effects
}

/// The question whether an export may overwrite a file.
pub(crate) fn question_before_overwriting(pending: &Pending) -> Question {
    let path = pending.export.destination.path.display();
    Question {
        title: " Export ",
        text: format!("{path} exists, and this session did not write it. Overwrite it?"),
    }
}

/// Exports after all, to the file that another program has written or to a numbered one.
pub(crate) fn answer_taken(shared: &mut Shared, existing: Existing) -> Vec<Effect> {
    let Some(Dialog::Overwrite(pending)) = shared.overlays.dialog.take() else {
        return Vec::new();
    };
    let mut pending = *pending;
    if existing == Existing::Overwritten {
        announce_export(shared, &pending.export);
    }
    pending.export.id = shared.jobs.next_export();
    pending.export.destination.existing = existing;
    pending.asking = Asking::No;
    begin_or_queue(shared, pending)
}

/// The scene's path with a picture's extension, distinct for each AOV so that they don't
/// overwrite each other.
pub(crate) fn export_path(shared: &Shared) -> PathBuf {
    let aov = shared.pictures.aov;
    let extension = aov.map_or_else(|| "bmp".to_owned(), |aov| format!("{}.bmp", aov.name()));
    let scene = shared.disk.path.as_deref();
    let scene = scene.unwrap_or_else(|| Path::new("halflight"));
    scene.with_extension(extension)
}

/// What the present picture is made from. A text with errors has none: the picture is of an
/// earlier one.
pub(crate) fn origin(shared: &Shared) -> Option<Origin> {
    if 0 < shared.error_count() {
        return None;
    }
    let own = shared.scene.as_ref()?.camera;
    let camera = shared.camera()?;
    Some(Origin {
        text: shared.document.shared_text(),
        found: shared.assets.loaded.found.clone(),
        view: Viewpoint::between(&own, &camera),
    })
}

/// The job whose picture an export to `path` writes, or the reason why there is none.
fn export_job(shared: &Shared, path: &Path, size: Size, spp: u32) -> Result<Job, String> {
    let play = shared.key_for("track");
    if let Some(reason) = names_sequence(path, &play) {
        return Err(reason);
    }
    let format = ImageFormat::of_path(path).ok_or_else(|| {
        let (name, known) = (path.display(), known_extensions());
        format!("{name}: picture files end in {known}")
    })?;
    let job = display::final_job(shared, size, spp)?;
    let frames = format.frames();
    format.refuses(size).map_or(Ok(Job { frames, ..job }), Err)
}

/// The full-size trace, if it is complete and exactly what is to be exported.
fn traced(shared: &Shared, size: Size, spp: u32) -> Option<Arc<Frame>> {
    let trace = shared.pictures.trace.as_ref()?;
    let frame = trace.latest.as_ref().filter(|_| trace.is_complete())?;
    let same = frame.size == size
        && size == shared.output()
        && spp == shared.pictures.samples(shared.rendering().spp());
    same.then(|| Arc::clone(frame))
}

/// Cancels the running export; those that wait go on.
pub(crate) fn cancel_export(shared: &mut Shared) -> Vec<Effect> {
    let Some(export) = shared.jobs.end_export(|_| true) else {
        shared.say("no export is running");
        return Vec::new();
    };
    shared.jobs.next = None;
    match export.stage {
        Stage::Tracing => shared.say(if export.has_written_frames() {
            "export cancelled; the frames already written are kept"
        } else {
            "export cancelled"
        }),
        Stage::Writing => {
            let path = export.destination.path.display();
            shared.warn(format!("too late to cancel: {path} is being written"));
        }
    }
    let mut effects = export.stop();
    effects.extend(next_export(shared));
    effects
}

/// The messages that an export has begun, and that it waits for others.
fn announcements(export: &Export) -> [String; 2] {
    let what = export.aov.map(|aov| format!("{} ", aov.name()));
    let what = what.unwrap_or_default();
    let path = export.destination.path.display();
    [
        format!("exporting {what}to {path}"),
        format!("queued: {what}to {path}"),
    ]
}
