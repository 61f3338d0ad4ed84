//! What sessions remember for later ones, in the state folder: the sizes of panels, in
//! `halflight/panels`, where a lesson is, in `halflight/lesson`, and recently used scenes, in `halflight/recent`: absolute paths, one a line and
//! the newest first. Sessions that end up there at the same moment may lose one of their entries.

use std::path::{Component, Path, PathBuf};
use std::{fs, io};

use crate::arrange::PanelSizes;
use crate::msg::Msg;
use crate::queue::Service;
use file::state_folder::{self, Folder, Store};

/// Names of the files.
const SCENES: &str = "recent";
const PANELS: &str = "panels";
const LESSON: &str = "lesson";

/// The maximum number of scenes remembered.
const MOST: usize = 20;

/// The maximum length of the file, in bytes.
const LONGEST: u64 = 1 << 20;

/// A request to the thread.
pub(crate) enum Request {
    /// Put this scene first.
    Note(PathBuf),
    /// Report the scenes, the newest first, by [`Msg::RecentListed`].
    List,
    /// Keep the sizes of the panels.
    Panels(PanelSizes),
    /// Keep where a lesson is.
    Lesson(String),
}

/// Starts the thread. Failures to remember a scene are reported by [`Msg::Failed`], each reason once.
pub(crate) fn start(send: impl Fn(Msg) + Send + 'static) -> io::Result<Service<Request>> {
    Service::start("recent", "remembers scenes", move |inbox| {
        let mut last = None;
        for request in inbox {
            match request {
                Request::List => send(Msg::RecentListed(list())),
                Request::Panels(sizes) => {
                    // The loss is too small to interrupt anyone.
                    let _ = state_folder::path().and_then(|state| keep_in(&state, sizes));
                }
                Request::Lesson(place) => {
                    // As small a loss.
                    let keep = |state: PathBuf| write(&state, LESSON, &place);
                    let _ = state_folder::path().and_then(keep);
                }
                Request::Note(scene) => {
                    let noted = state_folder::path().and_then(|state| note_in(&state, &scene));
                    let reason = noted.err().map(|error| error.to_string());
                    if let Some(reason) = reason.filter(|reason| last.as_ref() != Some(reason)) {
                        let words = format!("recent scenes cannot be remembered: {reason}");
                        send(Msg::Failed(words));
                        last = Some(reason);
                    }
                }
            }
        }
    })
}

/// The recently used scenes that still exist, the newest first; empty if that is unknown.
pub(crate) fn list() -> Vec<PathBuf> {
    state_folder::path().map_or_else(|_| Vec::new(), |state| list_in(&state))
}

/// The sizes of the panels that were kept last; the default ones if that is unknown.
pub(crate) fn panels() -> PanelSizes {
    state_folder::path().map_or_else(|_| PanelSizes::default(), |state| panels_in(&state))
}

/// Where a lesson was, as text; empty if that is unknown.
pub(crate) fn lesson() -> String {
    state_folder::path().map_or_else(|_| String::new(), |state| text_of(&state, LESSON))
}

fn panels_in(state: &Path) -> PanelSizes {
    PanelSizes::of_text(&text_of(state, PANELS))
}

fn keep_in(state: &Path, sizes: PanelSizes) -> io::Result<()> {
    write(state, PANELS, &sizes.to_text())
}

fn list_in(state: &Path) -> Vec<PathBuf> {
    let mut scenes: Vec<PathBuf> = Vec::new();
    for scene in read(state).iter().map(|scene| normal(scene)) {
        if scene.is_file() && !scenes.contains(&scene) {
            scenes.push(scene);
        }
    }
    scenes
}

/// An absolute path without `.` and `..`. Links of folders before a `..` are followed, as it is
/// relative to what they point to; others stay as the user knows them.
fn normal(scene: &Path) -> PathBuf {
    let plain: PathBuf = scene.components().collect();
    if !plain.components().any(|part| part == Component::ParentDir) {
        return plain;
    }
    let folder = fs::canonicalize(file::directory_of(&plain));
    match (folder, plain.file_name()) {
        (Ok(folder), Some(name)) => folder.join(name),
        _ => plain,
    }
}

fn note_in(state: &Path, scene: &Path) -> io::Result<()> {
    let scene = normal(&file::absolute(scene));
    // Such a path cannot be a line of text.
    let is_line = |path: &str| !path.contains(['\n', '\r']);
    if !scene.to_str().is_some_and(is_line) {
        return Ok(());
    }
    let mut scenes = read(state);
    if scenes.first() == Some(&scene) {
        return Ok(());
    }
    scenes.retain(|other| normal(other) != scene);
    scenes.insert(0, scene);
    scenes.truncate(MOST);
    let lines: Vec<_> = scenes.iter().filter_map(|scene| scene.to_str()).collect();
    write(state, SCENES, &format!("{}\n", lines.join("\n")))
}

fn write(state: &Path, name: &str, text: &str) -> io::Result<()> {
    let folder = Folder::make(state, Store::Sessions)?;
    folder.replace(name, |out| out.write_all(text.as_bytes()))
}

/// The scenes in the file; none if it cannot be read.
fn read(state: &Path) -> Vec<PathBuf> {
    let text = text_of(state, SCENES);
    let scenes = text.lines().map(PathBuf::from);
    let mut scenes: Vec<_> = scenes.filter(|scene| scene.is_absolute()).collect();
    scenes.truncate(MOST);
    scenes
}

/// The text of a file; empty if it cannot be read.
fn text_of(state: &Path, name: &str) -> String {
    let read = || {
        let folder = Folder::find(state, Store::Sessions).ok()??;
        let file = folder.open(name).ok()??;
        let bytes = file::read_opened(&file, &folder.place(name), LONGEST).ok()?;
        String::from_utf8(bytes).ok()
    };
    read().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn place(state: &Path, name: &str) -> PathBuf {
        state.join("halflight").join(name)
    }

    #[test]
    fn the_newest_scenes_that_still_exist_are_listed_once() {
        let folder = tempfile::tempdir().expect("a folder");
        let at = |name: &str| folder.path().join(name);
        let state = at("state");
        assert_eq!(list_in(&state), [] as [PathBuf; 0]);
        for name in ["a.ray", "b.ray", "c.dat"] {
            fs::write(at(name), "").expect("the folder is new");
        }
        let opened = "a.ray b.ray gone.ray c.dat state/.././a.ray new\nline.ray";
        for name in opened.split(' ') {
            note_in(&state, &at(name)).expect("it can be written");
        }
        assert_eq!(list_in(&state), ["a.ray", "c.dat", "b.ray"].map(at));
        for number in 0..MOST {
            note_in(&state, &at(&format!("{number}.ray"))).expect("it can be written");
        }
        assert_eq!(read(&state).len(), MOST);
        assert_eq!(list_in(&state), [] as [PathBuf; 0]);
    }

    #[test]
    fn sizes_of_panels_are_kept() {
        let folder = tempfile::tempdir().expect("a folder");
        let state = folder.path().join("state");
        assert_eq!(panels_in(&state), PanelSizes::default());
        let sizes = PanelSizes {
            beside: Some(40),
            list_height: Some(9),
            ..PanelSizes::default()
        };
        keep_in(&state, sizes).expect("it can be written");
        assert_eq!(panels_in(&state), sizes);
        let damaged = "beside\nbelow -3\nlist-width 99999999\n\u{7}";
        fs::write(place(&state, PANELS), damaged).expect("written");
        assert_eq!(panels_in(&state), PanelSizes::default());
    }

    #[test]
    fn a_file_of_another_kind_lists_nothing_and_is_replaced() {
        let folder = tempfile::tempdir().expect("a folder");
        let scene = folder.path().join("a.ray");
        fs::write(&scene, "").expect("the folder is new");
        fs::create_dir(folder.path().join("halflight")).expect("the folder is new");
        let long = "a".repeat(2 << 20);
        for content in [b"\xff\xfe", b"relative.ray\n\n" as &[u8], long.as_bytes()] {
            fs::write(place(folder.path(), SCENES), content).expect("written");
            assert_eq!(list_in(folder.path()), [] as [PathBuf; 0]);
        }
        note_in(folder.path(), &scene).expect("it can be written");
        assert_eq!(list_in(folder.path()), [scene]);
    }

    #[test]
    fn nothing_outside_the_folder_is_read_or_written() {
        use std::os::unix::fs::symlink;
        type Plant = fn(&Path, &Path) -> io::Result<()>;
        let links: [Plant; 2] = [|to, at| symlink(to, at), |to, at| fs::hard_link(to, at)];
        for (number, plant) in links.into_iter().enumerate() {
            let folder = tempfile::tempdir().expect("a folder");
            let (state, victim) = (folder.path().join("state"), folder.path().join("a.ray"));
            let held = format!("{}\n", victim.display());
            fs::write(&victim, &held).expect("the folder is new");
            fs::create_dir_all(state.join("halflight")).expect("the folder is new");
            for name in [SCENES, PANELS] {
                plant(&victim, &place(&state, name)).expect("the folder is new");
            }
            if number == 0 {
                assert_eq!(list_in(&state), [] as [PathBuf; 0]);
            }
            note_in(&state, &folder.path().join("b.ray")).expect("it is replaced");
            keep_in(&state, PanelSizes::default()).expect("it is replaced");
            assert_eq!(fs::read_to_string(&victim).expect("a text"), held);
        }
        // A folder that leads elsewhere is refused.
        let folder = tempfile::tempdir().expect("a folder");
        symlink(folder.path(), folder.path().join("halflight")).expect("the folder is new");
        let scene = folder.path().join("a.ray");
        let refused = note_in(folder.path(), &scene).expect_err("it is a link");
        assert!(refused.to_string().contains("symbolic link"), "{refused}");
        keep_in(folder.path(), PanelSizes::default()).expect_err("it is a link");
        assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 1);
    }
}
