//! Writes scenes and pictures, each on its own thread: a disk that does not answer blocks nothing
//! else.

use std::convert::Infallible;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{self, Receiver, Sender};

use std::time::Instant;

use super::destination::{NotWritten, Refused, check_target, numbered};
use super::filming::{self, Cancelled};
use crate::event::{Event, Work, sending};
use crate::msg::{Destination, ExportId, Exported, Guard, Msg, SaveId, SaveOutcome};
use crate::queue::spawn;
use crate::reel::Reel;
use assets::fingerprint;
use file::ReadError;
use image_file::Picture;
use render::{Frame, Provenance};

/// Starts a thread for each file to write, and waits for all of them at the end.
pub(crate) struct Writers {
    sender: Sender<Event>,
    /// Cloned into each thread and dropped when it ends.
    at_work: Sender<Infallible>,
    all_ended: Receiver<Infallible>,
}

impl Writers {
    /// Threads send their results to `sender`.
    pub(crate) fn new(sender: Sender<Event>) -> Self {
        let (at_work, all_ended) = mpsc::channel();
        Self {
            sender,
            at_work,
            all_ended,
        }
    }

    /// Writes a scene, reported by [`Msg::Saved`].
    pub(crate) fn save(
        &self,
        id: SaveId,
        path: PathBuf,
        text: Arc<String>,
        guard: Guard,
    ) -> io::Result<()> {
        let reason = format!("{}: cannot write the scene", path.display());
        let panicked = Msg::Saved(id, SaveOutcome::Failed(reason));
        self.start("save", AtEnd::Awaited, panicked, move || {
            Some(Msg::Saved(id, save(path, &text, &guard)))
        })
    }

    /// Writes a track file, reported by [`Msg::TrackWritten`].
    pub(crate) fn write_track(
        &self,
        path: PathBuf,
        text: Arc<String>,
        guard: Guard,
    ) -> io::Result<()> {
        let reason = format!("{}: cannot write the track", path.display());
        let panicked = Msg::TrackWritten(SaveOutcome::Failed(reason));
        self.start("track", AtEnd::Awaited, panicked, move || {
            Some(Msg::TrackWritten(save(path, &text, &guard)))
        })
    }

    /// Writes a frame to a picture file, reported by [`Msg::Exported`].
    pub(crate) fn export(
        &self,
        id: ExportId,
        frame: Arc<Frame>,
        to: Destination,
    ) -> io::Result<()> {
        let panicked = cannot(id, &to, "write the picture");
        self.start("export", AtEnd::Awaited, panicked, move || {
            Some(match export(&frame, to) {
                Ok(exported) => Msg::Exported(id, Ok(exported)),
                Err(refused) => refused.report(id),
            })
        })
    }

    /// Traces and writes a sequence, reported by [`Msg::Exported`].
    pub(crate) fn film(
        &self,
        (id, reel): (ExportId, Reel),
        to: Destination,
        (folders, threads): (Vec<PathBuf>, usize),
        cancelled: Cancelled,
    ) -> io::Result<()> {
        let panicked = cannot(id, &to, "export the sequence");
        let send = sending(&self.sender);
        self.start("sequence", AtEnd::Awaited, panicked, move || {
            filming::film((id, reel), to, (&folders, threads), &cancelled, send)
        })
    }

    /// Checks whether a picture can be written there; a failure is reported by [`Msg::Exported`].
    pub(crate) fn check(&self, id: ExportId, to: Destination) -> io::Result<()> {
        let panicked = cannot(id, &to, "write the picture");
        self.start("check", AtEnd::Left, panicked, move || {
            let to = numbered(to);
            check_target(&to).err().map(|refused| refused.report(id))
        })
    }

    /// Checks whether a scene can be written there; a failure is reported by [`Msg::Failed`].
    pub(crate) fn check_place(&self, path: PathBuf) -> io::Result<()> {
        let panicked = Msg::Failed(format!("{}: cannot check the path", path.display()));
        self.start("check", AtEnd::Left, panicked, move || {
            let refused = file::check_replaceable(&path).err()?;
            Some(Msg::Failed(format!("{}: {refused}", path.display())))
        })
    }

    /// Looks for backups left by an interrupted save of a scene, reported by [`Msg::BackupsFound`].
    pub(crate) fn find_backups(&self, scene: PathBuf) -> io::Result<()> {
        let found = Msg::BackupsFound(Vec::new());
        self.start("backups", AtEnd::Left, found, move || {
            Some(Msg::BackupsFound(file::backups(&scene)))
        })
    }

    /// Lists a folder, reported by [`Msg::Listed`].
    pub(crate) fn list_folder(&self, folder: PathBuf) -> io::Result<()> {
        let nothing = Msg::Listed(folder.clone(), Vec::new());
        self.start("list", AtEnd::Left, nothing, move || {
            let names = names_in(&folder);
            Some(Msg::Listed(folder, names))
        })
    }

    /// Runs work on its own thread.
    fn start(
        &self,
        name: &str,
        at_end: AtEnd,
        panicked: Msg,
        work: impl FnOnce() -> Option<Msg> + Send + 'static,
    ) -> io::Result<()> {
        let mut report = Report {
            sender: self.sender.clone(),
            msg: Some(panicked),
        };
        let at_work = match at_end {
            AtEnd::Awaited => Some(self.at_work.clone()),
            AtEnd::Left => None,
        };
        let begun = Work::begin(&self.sender);
        let started = spawn(name, move || {
            file::regain_folder();
            report.msg = work();
            drop(report);
            drop(begun);
            drop(at_work);
        });
        started.map(drop)
    }

    /// Waits until everything is written, or until `deadline`.
    pub(crate) fn finish(self, deadline: Instant) {
        drop(self.at_work);
        let patience = deadline.saturating_duration_since(Instant::now());
        // Nothing is ever sent: the end of the last thread ends the wait.
        let _ = self.all_ended.recv_timeout(patience);
    }
}

/// What becomes of work that is not done when the program ends.
#[derive(Clone, Copy, Debug)]
enum AtEnd {
    /// [`Writers::finish`] waits for it.
    Awaited,
    /// It ends with the process.
    Left,
}

/// Sends the result of writing a file when dropped; initially the result of a panic.
struct Report {
    sender: Sender<Event>,
    msg: Option<Msg>,
}

impl Drop for Report {
    fn drop(&mut self) {
        if let Some(msg) = self.msg.take() {
            // The inbox is gone only when the program ends.
            let _ = self.sender.send(Event::Msg(msg));
        }
    }
}

/// The result of an export that has failed without a reason.
fn cannot(id: ExportId, to: &Destination, act: &str) -> Msg {
    Msg::Exported(id, Err(format!("{}: cannot {act}", to.path.display())))
}

/// The maximum number of names to list.
const NAMES: usize = 2000;

/// The names in a folder, sorted, without hidden ones and those that are not UTF-8; the names of
/// folders end in `/`. Empty if the folder cannot be read.
fn names_in(folder: &Path) -> Vec<String> {
    let Ok(entries) = folder.read_dir() else {
        return Vec::new();
    };
    let name = |entry: io::Result<std::fs::DirEntry>| {
        let entry = entry.ok()?;
        let name = entry.file_name().into_string().ok()?;
        let end = if entry.path().is_dir() { "/" } else { "" };
        (!name.starts_with('.')).then(|| format!("{name}{end}"))
    };
    let mut names: Vec<_> = entries.filter_map(name).take(NAMES).collect();
    names.sort_unstable();
    names
}

/// Writes a scene unless that would overwrite another program's changes.
fn save(path: PathBuf, text: &str, guard: &Guard) -> SaveOutcome {
    if !file::has_folder(&path) {
        return SaveOutcome::NoFolder(without_folder(&path));
    }
    let may = || may_replace(&path, text, guard).map_err(NotWritten::Refused);
    match file::replace(&path, &mut |out| out.write_all(text.as_bytes()), &may) {
        Ok(()) => SaveOutcome::Saved {
            path,
            // If the text being edited were also the saved one, the next edit would have to copy it.
            text: Arc::new(text.to_owned()),
        },
        Err(NotWritten::Refused(outcome)) => outcome,
        Err(NotWritten::Failed(error)) => {
            SaveOutcome::Failed(format!("{}: {error}", path.display()))
        }
    }
}

/// Says that the folder of a file does not exist: the current one by where it was, others as named.
fn without_folder(path: &Path) -> String {
    let folder = file::directory_of(path);
    let reason = file::no_such_folder(folder);
    if folder == Path::new(".") {
        let lost: PathBuf = file::absolute(folder).components().collect();
        return format!("{}: {reason}", lost.display());
    }
    format!("{}: {reason}", folder.display())
}

/// Whether the contents of the file may be overwritten; otherwise what becomes of the save.
fn may_replace(path: &Path, text: &str, guard: &Guard) -> Result<(), SaveOutcome> {
    let held = match guard {
        Guard::Anything => return Ok(()),
        Guard::Holding(held) => Some(held),
        Guard::Absent => None,
    };
    match (held, file::read_text(path)) {
        (_, Err(ReadError::NotFound { .. })) => Ok(()),
        (Some(held), Ok(found)) if found == **held || found == text => Ok(()),
        (Some(_), Ok(_)) => Err(SaveOutcome::ChangedOnDisk),
        (Some(_), Err(error)) => Err(SaveOutcome::Failed(error.to_string())),
        (None, _) => {
            let path = path.display();
            let reason = format!("{path} exists: use :w! {path} to overwrite it");
            Err(SaveOutcome::Failed(reason))
        }
    }
}

/// Writes a picture unless that would replace a file that others wrote.
fn export(frame: &Frame, to: Destination) -> Result<Exported, Refused> {
    let to = numbered(to);
    check_target(&to)?;
    let may = || check_target(&to).map_err(NotWritten::Refused);
    let provenance = provenance(frame, &to).map_err(|error| error.to_string())?;
    let picture = Picture {
        provenance: provenance.as_ref(),
        ..Picture::of(frame)
    };
    let written = image_file::save(picture, &to.path, &may);
    match written {
        Ok(version) => Ok(Exported {
            path: to.path,
            version,
        }),
        Err(NotWritten::Failed(error)) => Err(format!("{}: {error}", to.path.display()).into()),
        Err(NotWritten::Refused(refused)) => Err(refused.reason().to_owned().into()),
    }
}

/// What a picture is made from, if that is known.
fn provenance(frame: &Frame, to: &Destination) -> Result<Option<Provenance>, ReadError> {
    let (Some(origin), Some(settings)) = (&to.origin, frame.settings()) else {
        return Ok(None);
    };
    let provenance = Provenance {
        version: env!("CARGO_PKG_VERSION").to_owned(),
        scene: fingerprint(&origin.text, &origin.found)?,
        view: origin.view.clone(),
        layers: Vec::new(),
        denoise: false,
        settings: *settings,
    };
    Ok(Some(provenance.in_frame(frame)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::tests::frame_of;
    use crate::layout::tests::size;
    use crate::msg::Existing;
    use crate::service::destination::tests::destination;

    #[test]
    fn a_panic_while_writing_a_file_is_reported() {
        let (sender, inbox) = mpsc::channel();
        let writers = Writers::new(sender);
        let failed = Msg::Saved(SaveId(3), SaveOutcome::Failed("a.ray: broken".to_owned()));
        let started = writers.start("test", AtEnd::Left, failed, || panic!("on purpose"));
        started.expect("a thread");
        let far = Instant::now() + std::time::Duration::from_secs(30);
        writers.finish(far);
        let events: Vec<_> = inbox.iter().collect();
        let [
            Event::Begun,
            Event::Msg(Msg::Saved(SaveId(3), SaveOutcome::Failed(reason))),
            Event::Done,
        ] = &events[..]
        else {
            panic!("{events:?}");
        };
        assert_eq!(reason, "a.ray: broken");
    }

    #[test]
    fn a_scene_is_not_saved_in_a_missing_folder() {
        let place = tempfile::tempdir().expect("a folder");
        for (path, reason) in table! {
            place.path().join("none/x.ray") => "none: no such folder";
            "~none/x.ray".into() => "~none: no such folder; only shells expand ~";
        } {
            let outcome = save(path, "", &Guard::Absent);
            assert!(matches!(outcome, SaveOutcome::NoFolder(said) if said.ends_with(reason)));
        }
    }

    #[test]
    fn a_scene_stays_complete_whichever_call_fails() {
        use file::faults::{Fault, during};
        use rustix::io::Errno;
        let place = tempfile::tempdir().expect("a folder");
        let path = place.path().join("x.ray");
        let text = Arc::new("new".to_owned());
        let last = (0..100).find(|&at| {
            std::fs::write(&path, "old").expect("the folder is new");
            let guard = Guard::Holding(Arc::new("old".to_owned()));
            let fault = Fault::Once(Errno::NOSPC);
            let (outcome, calls) = during(fault, at, || save(path.clone(), &text, &guard));
            let held = std::fs::read_to_string(&path).expect("a file");
            match outcome {
                SaveOutcome::Saved { .. } => assert_eq!(held, "new", "{calls:?}"),
                SaveOutcome::Failed(reason) => {
                    let cause = io::Error::from(Errno::NOSPC);
                    assert_eq!(reason, format!("{}: {cause}", path.display()));
                    assert_eq!(held, "old", "{calls:?}");
                }
                outcome => panic!("{outcome:?}: {calls:?}"),
            }
            assert_eq!(place.path().read_dir().expect("a folder").count(), 1);
            calls.hit.is_none()
        });
        assert!(last.is_some_and(|last| 0 < last), "each was hit");
    }

    #[test]
    fn a_numbered_picture_takes_the_first_free_number() {
        let place = tempfile::tempdir().expect("a folder");
        let path = place.path().join("a.depth.bmp");
        std::fs::write(&path, "").expect("the folder is new");
        std::fs::write(place.path().join("a.depth-2.bmp"), "").expect("the folder is new");
        let to = destination(&path, Existing::Numbered);
        let exported = export(&frame_of(size(1, 1), Vec::new()), to);
        let exported = exported.expect("there is a name");
        assert_eq!(exported.path, place.path().join("a.depth-3.bmp"));
        let to = destination(&path, Existing::Kept);
        assert!(matches!(check_target(&to), Err(Refused::Taken(_))));
    }

    #[test]
    fn an_export_changed_by_another_program_is_kept() {
        let place = tempfile::tempdir().expect("a folder");
        let path = place.path().join("a.bmp");
        let to = |existing| destination(&path, existing);
        let frame = frame_of(size(1, 1), Vec::new());
        let first = export(&frame, to(Existing::Kept)).expect("it is new");
        let own = Existing::Own(first.version.expect("a file"));
        let second = export(&frame, to(own)).expect("it is ours");
        let own = Existing::Own(second.version.expect("a file"));
        std::fs::write(&path, "theirs").expect("it is ours");
        export(&frame, to(own)).expect_err("it is theirs");
        let held = std::fs::read_to_string(&path).expect("a text");
        assert_eq!(held, "theirs");
    }
}
