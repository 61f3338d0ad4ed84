//! The thread that reads, parses and lowers the scene file: for a text with millions of objects
//! this takes longer than a key may wait.

use std::cell::LazyCell;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::mpsc::Receiver;
use std::thread;
use std::time::Instant;

use super::buffers::Buffers;
use super::watching::Watching;
use crate::event::Work;
use crate::msg::{Msg, Polled};
use crate::options::Options;
use crate::queue::{Ended, Service};
use crate::recovery;
use crate::scene_reading::{Baseline, Opened, ReadBuffer, Reading, SceneFolder};
use assets::{Assets, MeshScene, Up, is_mesh};
use document::Document;
use file::ReadError;
use language::Language;
use link::{Follow, Heard, ToEditor};
use scene::Meshes;

/// Length in bytes from which a text is lowered on several threads.
const LARGE: usize = 1 << 20;

/// A request to the thread.
enum Request {
    /// Watch this file instead of the previous one.
    Watch(PathBuf),
    /// Read this file and compare it with the baseline.
    Read(PathBuf, Baseline, Work),
    /// Read the scene of this file, in place of another.
    Open(PathBuf, Language, Work),
    /// Take what an editor said, on the socket of the scene of this number.
    Hear(u64, Heard),
    /// Send this to the editor that has the scene open.
    Tell(ToEditor),
    /// Forget the buffer of an editor that is gone.
    Forget,
    /// Follow buffers at this time.
    Follow(Follow),
    /// End the thread.
    End,
}

/// Handle of the thread that watches, reads and lowers the scene file, and hears editors. Nothing else waits
/// for it, neither a save nor the end of the program; only its socket is given a moment to be removed.
pub(crate) struct SceneLoader(Service<Request>);

impl SceneLoader {
    /// Starts the thread. `send` is called on it and on the watcher's thread.
    pub(crate) fn start(
        options: &Options,
        send: impl Fn(Msg) + Clone + Send + 'static,
    ) -> io::Result<Self> {
        let (method, up) = (options.watching(), options.up);
        let buffers = Buffers::new(options.follow.unwrap_or_default());
        let service = Service::start_shared("reading", "reads scenes", move |inbox, requests| {
            let mut watching = Watching::new(Polled::Scene, method, send.clone());
            let watch = |path: Option<PathBuf>, buffers: &mut Buffers| {
                let requests = requests.clone();
                let scene = buffers.scenes + u64::from(path.is_some());
                // The thread ends only with the program.
                let hear = move |heard| drop(requests.send(Request::Hear(scene, heard)));
                let Some(path) = path else {
                    buffers.listen_again(hear);
                    return Vec::new();
                };
                let news = buffers.listen(&path, hear);
                watching.watch(vec![path]);
                news
            };
            let read = |path: &Path| {
                if is_mesh(path) {
                    return around_mesh(path, up);
                }
                file::read_text(path).map(Content::Text)
            };
            follow(inbox, buffers, watch, read, &send);
        });
        service.map(Self)
    }

    /// Watches a file from now on, reported by [`Msg::FileChanged`].
    pub(crate) fn watch(&self, path: PathBuf) -> Result<(), Ended> {
        self.0.request(Request::Watch(path))
    }

    /// Reads a file, reported by [`Msg::Read`]. Of several pending requests only the last is
    /// carried out.
    pub(crate) fn read(&self, path: PathBuf, baseline: Baseline, work: Work) -> Result<(), Ended> {
        self.0.request(Request::Read(path, baseline, work))
    }

    /// Reads another scene, reported by [`Msg::Opened`]; takes the place of a pending request.
    pub(crate) fn open(&self, path: PathBuf, language: Language, work: Work) -> Result<(), Ended> {
        self.0.request(Request::Open(path, language, work))
    }

    /// Sends a message to the editor that has the scene open, if there is one.
    pub(crate) fn tell(&self, message: ToEditor) -> Result<(), Ended> {
        self.0.request(Request::Tell(message))
    }

    /// Ends the thread, and waits for that until `deadline`.
    pub(crate) fn finish(self, deadline: Instant) {
        // If it has ended already, it left nothing behind.
        let _ = self.0.request(Request::End);
        self.0.finish(deadline);
    }

    /// Forgets the buffer of an editor that is gone: from now on the file is read.
    pub(crate) fn forget_buffer(&self) -> Result<(), Ended> {
        self.0.request(Request::Forget)
    }

    /// Follows editors' buffers at another time.
    pub(crate) fn follow_buffers(&self, follow: Follow) -> Result<(), Ended> {
        self.0.request(Request::Follow(follow))
    }
}

/// Carries out requests until the sender is gone. A file that changes while being read is not
/// lowered but read again.
fn follow(
    inbox: &Receiver<Request>,
    mut buffers: Buffers,
    mut watch: impl FnMut(Option<PathBuf>, &mut Buffers) -> Vec<Msg>,
    read: impl Fn(&Path) -> Result<Content, ReadError>,
    send: impl Fn(Msg),
) {
    // An edit may lower a large scene on the shared thread pool, which would delay the work here.
    let pool = LazyCell::new(|| {
        let cores = thread::available_parallelism().map_or(1, usize::from);
        let pool = rayon::ThreadPoolBuilder::new().num_threads(memory::threads(cores));
        pool.build()
    });
    while let Ok(first) = inbox.recv() {
        let mut requests = vec![first];
        requests.extend(inbox.try_iter());
        if ends(&requests) {
            return;
        }
        while let Some(wanted) = last(requests, &mut buffers, &mut watch, &send) {
            let path = wanted.path;
            file::regain_folder();
            let outside = buffers.outside().filter(|_| wanted.language.is_none());
            let (read, outside) = match outside {
                None => (read(&path), None),
                Some(outside) => {
                    let buffer = ReadBuffer {
                        version: outside.version,
                        in_file: outside.in_file,
                    };
                    (Ok(Content::Text(outside.text)), Some(buffer))
                }
            };
            requests = inbox.try_iter().collect();
            if ends(&requests) {
                return;
            }
            if requests.iter().any(Request::wants_text) {
                continue;
            }
            let (baseline, language, work) = (wanted.baseline, wanted.language, wanted.work);
            let understand = |text: String| {
                if text.len() < LARGE {
                    return Reading::of(text, outside, baseline);
                }
                memory::malloc::keep_large();
                match &*pool {
                    Ok(pool) => pool.install(|| Reading::of(text, outside, baseline)),
                    Err(_) => Reading::of(text, outside, baseline),
                }
            };
            let text = match read {
                Ok(Content::Text(text)) => Ok(text),
                Ok(Content::AroundMesh(made)) => {
                    send(Msg::Opened(path, Ok(Opened::AroundMesh(made))));
                    continue;
                }
                Err(error) if is_mesh(&path) => {
                    send(Msg::Opened(path, Err(error)));
                    continue;
                }
                Err(error) => Err(error),
            };
            let reading = text.and_then(|text| {
                let place = SceneFolder::of(&path);
                let understood = understand(text).map_err(|reason| ReadError::NoMemory {
                    path: path.clone(),
                    reason,
                });
                understood.map(|reading| Reading { place, ..reading })
            });
            send(match language {
                None => {
                    let reading = reading.map_err(|error| without_folder(error, &path));
                    Msg::Read(path, reading)
                }
                Some(language) => {
                    let opened = opened(reading, &path, language);
                    Msg::Opened(path, opened)
                }
            });
            drop(work);
        }
    }
}

/// What a file holds.
enum Content {
    Text(String),
    /// A mesh, with the scene made around it.
    AroundMesh(MeshScene),
}

/// Makes a scene around a mesh, which may name files of its own folder only.
fn around_mesh(path: &Path, up: Option<Up>) -> Result<Content, ReadError> {
    // An error in opening the file is not one of the new scene.
    file::open(path)?;
    let made = Assets::new(&[]).scene_of_mesh(path, up);
    Ok(Content::AroundMesh(made))
}

fn ends(requests: &[Request]) -> bool {
    requests
        .iter()
        .any(|request| matches!(request, Request::End))
}

/// A text to read, and what for.
struct Wanted {
    path: PathBuf,
    baseline: Baseline,
    /// The language of another scene; `None` for the present one.
    language: Option<Language>,
    work: Work,
}

impl Request {
    fn wants_text(&self) -> bool {
        matches!(self, Self::Read(..) | Self::Open(..))
    }
}

/// Carries out requests, and returns the last one to read a file.
fn last(
    requests: Vec<Request>,
    buffers: &mut Buffers,
    mut watch: impl FnMut(Option<PathBuf>, &mut Buffers) -> Vec<Msg>,
    send: impl Fn(Msg),
) -> Option<Wanted> {
    let mut last = None;
    for request in requests {
        match request {
            // Before the file is read, so that no later change is missed.
            Request::Watch(path) => watch(Some(path), buffers).into_iter().for_each(&send),
            // What was said on the socket of a former scene is not about this one.
            Request::Hear(scene, _) if scene != buffers.scenes => {}
            Request::Hear(_, heard) => buffers.heard(heard).into_iter().for_each(&send),
            Request::Tell(message) => buffers.tell(&message),
            Request::Forget => buffers.forget().into_iter().for_each(&send),
            Request::End => {}
            Request::Follow(follow) => buffers.follow(follow).into_iter().for_each(&send),
            Request::Read(path, baseline, work) => {
                watch(None, buffers).into_iter().for_each(&send);
                last = Some(Wanted {
                    path,
                    baseline,
                    language: None,
                    work,
                });
            }
            Request::Open(path, language, work) => {
                last = Some(Wanted {
                    path,
                    baseline: nothing(language),
                    language: Some(language),
                    work,
                });
            }
        }
    }
    last
}

/// The baseline of a scene that is read for the first time.
fn nothing(language: Language) -> Baseline {
    Baseline {
        scene: Document::new(language, String::new()).snapshot(),
        saves: 0,
        meshes: Meshes::default(),
        is_sound: false,
        sent: None,
    }
}

/// Tells a scene that does not exist yet from one that cannot be read.
fn opened(
    reading: Result<Reading, ReadError>,
    path: &Path,
    language: Language,
) -> Result<Opened, ReadError> {
    match reading {
        Ok(reading) => Ok(Opened::Read(reading)),
        Err(ReadError::NotFound { .. }) => {
            let missing = missing(path, language);
            missing.ok_or_else(|| ReadError::NotFound {
                path: path.to_owned(),
            })
        }
        Err(error) => Err(error),
    }
}

/// Tells a missing file from a missing folder.
fn without_folder(error: ReadError, path: &Path) -> ReadError {
    if matches!(error, ReadError::NotFound { .. }) && !file::has_folder(path) {
        let folder = file::absolute(file::directory_of(path));
        return ReadError::NoFolder {
            folder: folder.components().collect(),
        };
    }
    error
}

/// How to open a scene whose file is missing: from edits that were kept of it, or as a new one.
/// `None` if its folder is missing too.
pub(crate) fn missing(path: &Path, language: Language) -> Option<Opened> {
    let fits = |text: &String| language::fits(language, text, text.len()).is_ok();
    match recovery::base_of(Some(path), language).filter(fits) {
        // Edits of a template that was never written.
        Some(text) if text != language.template() => Some(Opened::Kept(text)),
        _ => file::directory_of(path).is_dir().then_some(Opened::New),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::{Cell, RefCell};
    use std::sync::mpsc;

    fn request(name: &str) -> Request {
        let (sender, _) = mpsc::channel();
        let work = Work::begin(&sender);
        Request::Read(name.into(), nothing(Language::Ray), work)
    }

    /// The files read and the files reported, if `during` is requested while the first one is being
    /// read.
    fn followed(before: &[&str], during: Option<&str>) -> (Vec<PathBuf>, Vec<PathBuf>) {
        let (requests, inbox) = mpsc::channel();
        for name in before {
            requests.send(request(name)).expect("it is there");
        }
        let requests = Cell::new(Some(requests));
        let (read, sent) = (RefCell::new(Vec::new()), RefCell::new(Vec::new()));
        let reads = |path: &Path| {
            if let (Some(requests), Some(name)) = (requests.take(), during) {
                requests.send(request(name)).expect("it is there");
            }
            read.borrow_mut().push(path.to_owned());
            Ok(Content::Text(String::new()))
        };
        let report = |msg| match msg {
            Msg::Read(path, Ok(_)) => sent.borrow_mut().push(path),
            msg => panic!("{msg:?}"),
        };
        let buffers = Buffers::new(Follow::Typing);
        follow(&inbox, buffers, |_, _| Vec::new(), reads, report);
        (read.into_inner(), sent.into_inner())
    }

    #[test]
    fn only_the_last_of_several_pending_files_is_read() {
        let one = vec![PathBuf::from("a")];
        let expected = (one.clone(), one);
        assert_eq!(followed(&["a", "b", "a"], None), expected);
    }

    #[test]
    fn a_file_that_changed_while_being_read_is_not_lowered() {
        let (read, sent) = followed(&["a"], Some("a"));
        assert_eq!((read.len(), sent.len()), (2, 1));
    }
}
