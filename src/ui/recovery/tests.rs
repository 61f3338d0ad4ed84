//! Journals on a real file system: what is kept, found, refused and left alone.

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, SystemTime};

use tempfile::TempDir;

use super::claim::Claim;
use super::folder::Folder;
use super::identity::Identity;
use super::journal::{Edits, Journal};
use super::offer::look_in;
use super::{Found, Offer, Sought};
use crate::document::{Document, Snapshot};
use crate::format::Format;

/// Edits offered for a text, of a journal that is gone.
pub(crate) fn offer(format: Format, text: &Arc<String>, base: Option<&str>, kept: &str) -> Offer {
    let place = Place::new();
    let folder = Arc::new(Folder::make(&place.state).expect("a folder"));
    let claim = Claim::new(&folder, &Identity::of(None, format)).expect("it is empty");
    let sought = Sought {
        scene: None,
        format,
        text: Arc::clone(text),
        put_off: Vec::new(),
    };
    let base = base.map(str::to_owned);
    Offer::new(&Arc::new(claim), &sought, base, kept.to_owned()).expect("the text lacks them")
}

/// A state folder, and beside it a file that nobody may touch.
struct Place {
    directory: TempDir,
    state: PathBuf,
    victim: PathBuf,
}

const BASE: &str = "1 2 3";

impl Place {
    fn new() -> Self {
        let directory = tempfile::tempdir().expect("a folder");
        let at = |name: &str| directory.path().join(name);
        fs::write(at("a.ray"), BASE).expect("the folder is new");
        fs::create_dir(at("other")).expect("the folder is new");
        fs::write(at("other/victim"), "untouched").expect("the folder is new");
        Self {
            state: at("state"),
            victim: at("other/victim"),
            directory,
        }
    }

    fn recovery(&self) -> PathBuf {
        self.state.join("halflight/recovery")
    }

    fn make(&self) {
        Folder::make(&self.state).expect("a folder");
    }

    fn scene(&self) -> PathBuf {
        self.directory.path().join("a.ray")
    }

    /// The path of the scene's first journal, or of another one.
    fn journal(&self, number: usize) -> PathBuf {
        let scene = Identity::of(Some(&self.scene()), Format::Ray);
        let name = scene.names().nth(number).expect("a few");
        self.recovery().join(name)
    }

    fn run(&self) -> Journal {
        Journal::new(self.state.clone())
    }

    fn edits(&self, base: &Arc<String>, text: &str) -> Edits {
        Edits {
            scene: Some(self.scene()),
            known: known(base, text),
        }
    }

    fn keep(&self, journal: &mut Journal, text: &str) {
        let edits = self.edits(&Arc::new(BASE.to_owned()), text);
        journal.write(&edits).expect("it can be written");
    }

    fn look(&self, text: &str) -> Found {
        let sought = Sought {
            scene: Some(self.scene()),
            format: Format::Ray,
            text: Arc::new(text.to_owned()),
            put_off: Vec::new(),
        };
        look_in(&self.state, &sought)
    }

    /// What the file would hold with the edits that are offered.
    fn offered(&self) -> Option<String> {
        let found = self.look(BASE);
        assert_eq!(found.complaints, [] as [String; 0]);
        let mut document = Document::new(Format::Ray, BASE.to_owned());
        found.offer.map(|offer| {
            match offer.way {
                super::Way::Edit(edit) => document.edit(&[edit]),
                super::Way::Merge(merge) => drop(document.restore(&merge)),
            }
            document.text().to_owned()
        })
    }

    fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(self.recovery()).into_iter().flatten();
        let name = |entry: fs::DirEntry| entry.file_name().to_string_lossy().into_owned();
        let mut names: Vec<_> = entries
            .map(|entry| name(entry.expect("an entry")))
            .collect();
        names.sort();
        names
    }
}

fn known(base: &Arc<String>, text: &str) -> Snapshot {
    Snapshot {
        format: Format::Ray,
        saved: Arc::clone(base),
        edited: Some(Arc::new(text.to_owned())),
    }
}

#[test]
#[cfg(unix)]
fn edits_of_a_run_that_goes_on_are_not_offered() {
    let place = Place::new();
    let (mut first, mut second) = (place.run(), place.run());
    place.keep(&mut first, "1 2 4");
    place.keep(&mut second, "9 2 3");
    assert_eq!(place.offered(), None);
    let other = Arc::new("1 2 4".to_owned());
    let edits = place.edits(&other, "1 2 5");
    first.write(&edits).expect("it can be written");
    assert_eq!(place.offered(), None, "the lock is on what replaced it too");
    drop(second);
    assert_eq!(place.offered().as_deref(), Some("9 2 3"));
    first.forget().expect("it can be removed");
    assert_eq!(
        place.offered().as_deref(),
        Some("9 2 3"),
        "the other's stays"
    );
    assert_eq!(place.names().len(), 1);
}

#[test]
fn the_last_text_that_was_kept_is_offered() {
    let place = Place::new();
    let mut journal = place.run();
    for text in ["1 2 4", "1 2 5", BASE, "7"] {
        place.keep(&mut journal, text);
    }
    drop(journal);
    assert_eq!(place.offered().as_deref(), Some("7"));
    // What the text has already is forgotten.
    assert!(place.look("7").offer.is_none());
    assert_eq!(place.names(), [] as [String; 0]);
}

#[test]
fn several_journals_are_offered_newest_first() {
    let place = Place::new();
    let mut runs: Vec<_> = (0..3).map(|_| place.run()).collect();
    let texts = ["4 2 3", "1 5 3", "1 2 6"];
    for (journal, text) in runs.iter_mut().zip(texts) {
        place.keep(journal, text);
    }
    drop(runs);
    for (number, age) in [(0, 2), (1, 0), (2, 1)] {
        let file = File::options().write(true).open(place.journal(number));
        let at = SystemTime::now() - Duration::from_secs(60 * age);
        file.and_then(|file| file.set_modified(at)).expect("ours");
    }
    let mut text = BASE.to_owned();
    let mut document = Document::new(Format::Ray, text.clone());
    let mut taken = Vec::new();
    while let Some(offer) = place.look(&text).offer {
        match offer.way {
            super::Way::Edit(edit) => document.edit(&[edit]),
            super::Way::Merge(merge) => drop(document.restore(&merge)),
        }
        document.text().clone_into(&mut text);
        offer.claim.remove().expect("it is ours");
        taken.push(text.clone());
    }
    assert_eq!(taken, ["1 5 3", "1 5 6", "4 5 6"]);
}

#[test]
fn edits_are_appended_until_they_take_more_than_the_text() {
    let place = Place::new();
    let base = Arc::new("1 ".repeat(1 << 18));
    let mut journal = place.run();
    let mut lengths = Vec::new();
    for number in 2..42 {
        let text = base.replacen('1', &number.to_string(), 1 + number % 2 * 150_000);
        let edits = place.edits(&base, &text);
        journal.write(&edits).expect("it can be written");
        lengths.push(fs::metadata(place.journal(0)).expect("it is there").len());
    }
    let most = 2 * base.len() + (3 << 20);
    assert!(
        lengths.iter().all(|&length| length < most as u64),
        "{lengths:?}"
    );
    assert!(
        lengths[2] - lengths[1] < 100_000,
        "a small edit: {lengths:?}"
    );
    assert_eq!(place.names().len(), 1);
}

#[test]
fn a_journal_that_was_removed_is_created_again() {
    type Remove = fn(&Place);
    let removals: [(&str, Remove); 5] = [
        ("all", |p| fs::remove_dir_all(&p.state).expect("there")),
        ("file", |p| fs::remove_file(p.journal(0)).expect("there")),
        ("name", |p| {
            fs::rename(p.journal(0), p.recovery().join("moved")).expect("there");
        }),
        ("file moved", |p| {
            fs::rename(p.journal(0), p.state.join("moved")).expect("there");
        }),
        ("folder moved", |p| {
            fs::rename(p.recovery(), p.state.join("moved")).expect("there");
        }),
    ];
    for (name, remove) in removals {
        let place = Place::new();
        let mut journal = place.run();
        place.keep(&mut journal, "1 2 4");
        assert!(journal.is_kept(), "{name}");
        remove(&place);
        assert!(!journal.is_kept(), "{name}");
        // The same text, as at the end, or another one.
        for text in ["1 2 4", "1 2 5"] {
            place.keep(&mut journal, text);
            assert!(journal.is_kept(), "{name}");
        }
        drop(journal);
        assert_eq!(place.offered().as_deref(), Some("1 2 5"), "{name}");
    }
}

/// Under its new name the scene has a journal of its own.
#[test]
fn a_scene_saved_under_another_name_leaves_no_journal_behind() {
    let place = Place::new();
    let mut journal = place.run();
    place.keep(&mut journal, "1 2 4");
    let known = known(&Arc::default(), "1 2 5");
    let scene = Some(place.directory.path().join("b.ray"));
    let other = Edits { scene, known };
    journal.write(&other).expect("it can be written");
    assert_eq!(place.offered(), None);
    let names = place.names();
    assert!(names.len() == 1 && names[0].starts_with("b-"), "{names:?}");
}

/// Makes a file's content of a scene, a base and a text.
type Write = fn(&Identity, &str, &str) -> Vec<u8>;

/// What may stand in the place of a journal that earlier runs left behind.
#[test]
fn files_in_place_of_journals() {
    let whole: Write = |scene, base, text| {
        [
            super::record::head(scene, base),
            super::record::edit(base, text),
        ]
        .concat()
    };
    let cases: &[(&str, Write, Option<&str>, &str)] = &[
        ("whole", whole, Some("1 2 4"), ".ray"),
        (
            "of an earlier version",
            |_, _, text| text.into(),
            Some("1 2 4"),
            ".ray",
        ),
        (
            "with a torn end",
            |scene, base, text| {
                let whole = [
                    super::record::head(scene, base),
                    super::record::edit(base, text),
                ];
                [whole.concat(), b"edit 0 5".to_vec()].concat()
            },
            Some("1 2 4"),
            ".ray",
        ),
        (
            "torn before its first edit",
            |scene, base, _| super::record::head(scene, base),
            None,
            ".damaged",
        ),
        ("zeros", |_, _, _| vec![0; 4096], None, ".damaged"),
        ("not text", |_, _, _| vec![0xFF; 10], None, ".damaged"),
        ("empty", |_, _, _| Vec::new(), None, ""),
        (
            "of another scene",
            |_, base, text| {
                let other = Identity::of(Some(Path::new("/other.ray")), Format::Ray);
                [
                    super::record::head(&other, base),
                    super::record::edit(base, text),
                ]
                .concat()
            },
            None,
            ".ray",
        ),
        (
            "of a later version",
            |_, _, _| b"halflight journal 9\nx".to_vec(),
            None,
            ".ray",
        ),
    ];
    for (name, write, offered, left) in cases {
        let place = Place::new();
        let scene = Identity::of(Some(&place.scene()), Format::Ray);
        place.make();
        fs::write(place.journal(0), write(&scene, BASE, "1 2 4")).expect("the folder is ours");
        let found = place.look(BASE);
        let is_damaged = *left == ".damaged";
        assert_eq!(found.complaints.len(), usize::from(is_damaged), "{name}");
        drop(found);
        if !is_damaged {
            assert_eq!(place.offered().as_deref(), *offered, "{name}");
        }
        let names = place.names();
        let expected = usize::from(!left.is_empty());
        assert_eq!(names.len(), expected, "{name}: {names:?}");
        assert!(
            names.iter().all(|name| name.ends_with(left)),
            "{name}: {names:?}"
        );
        assert_eq!(
            place.look(BASE).complaints,
            [] as [String; 0],
            "{name}: reported once"
        );
    }
}

#[cfg(unix)]
mod hostile {
    use super::*;
    use std::os::unix::fs::{PermissionsExt, symlink};
    use std::process::Command;

    fn allow(path: &Path, mode: u32) {
        fs::set_permissions(path, fs::Permissions::from_mode(mode)).expect("it is ours");
    }

    fn pipe(path: &Path) {
        let made = Command::new("mkfifo").arg(path).status();
        assert!(made.expect("every system has it").success());
    }

    /// Folders in which nothing is kept, and nothing is read.
    #[test]
    fn folders_that_are_refused() {
        type Prepare = fn(&Place);
        let cases: &[(&str, Prepare, &str)] = &[
            (
                "a group may write",
                |p| allow(&p.recovery(), 0o770),
                "chmod go-w",
            ),
            (
                "others may write",
                |p| allow(&p.recovery(), 0o1777),
                "chmod go-w",
            ),
            (
                "others may write around it",
                |p| {
                    allow(&p.state.join("halflight"), 0o757);
                },
                "chmod go-w",
            ),
            (
                "others may write in the state folder",
                |p| allow(&p.state, 0o777),
                "chmod o-w",
            ),
            (
                "a link",
                |p| {
                    fs::rename(p.recovery(), p.state.join("away")).expect("it is ours");
                    symlink(p.state.join("away"), p.recovery()).expect("it is ours");
                },
                "recovery is a symbolic link",
            ),
            (
                "a link around it",
                |p| {
                    let own = p.state.join("halflight");
                    fs::rename(&own, p.state.join("away")).expect("it is ours");
                    symlink(p.state.join("away"), own).expect("it is ours");
                },
                "halflight is a symbolic link",
            ),
            (
                "a file",
                |p| {
                    fs::rename(p.recovery(), p.state.join("away")).expect("it is ours");
                    fs::write(p.recovery(), "").expect("it is ours");
                },
                "recovery is not a folder",
            ),
            (
                "a pipe",
                |p| {
                    fs::rename(p.recovery(), p.state.join("away")).expect("it is ours");
                    pipe(&p.recovery());
                },
                "recovery is not a folder",
            ),
            (
                "a file around it",
                |p| {
                    fs::rename(p.state.join("halflight"), p.state.join("away"))
                        .expect("it is ours");
                    fs::write(p.state.join("halflight"), "").expect("it is ours");
                },
                "halflight is not a folder",
            ),
        ];
        for (name, prepare, words) in cases {
            let place = Place::new();
            let mut journal = place.run();
            place.keep(&mut journal, "1 2 4");
            drop(journal);
            prepare(&place);
            let found = place.look(BASE);
            assert!(found.offer.is_none(), "{name}");
            let is_said = !words.ends_with("is not a folder");
            assert_eq!(found.complaints.len(), usize::from(is_said), "{name}");
            let edits = place.edits(&Arc::new(BASE.to_owned()), "1 2 5");
            let mut journal = place.run();
            let error = journal.write(&edits).expect_err(name).to_string();
            assert!(error.contains(words), "{name}: {error}");
            assert!(!journal.is_kept(), "{name}");
        }
    }

    /// Where everybody may write, but nobody can move what is another's away.
    #[test]
    fn a_shared_state_folder_like_that_for_temporary_files_will_do() {
        let place = Place::new();
        place.make();
        allow(&place.state, 0o1777);
        place.keep(&mut place.run(), "1 2 4");
        assert_eq!(place.offered().as_deref(), Some("1 2 4"));
    }

    #[test]
    fn a_folder_of_another_user_is_refused() {
        use rustix::fs::{Uid, chown};
        let place = Place::new();
        place.make();
        // Only root can give a folder away.
        if chown(place.recovery(), Some(Uid::from_raw(1)), None).is_ok() {
            let edits = place.edits(&Arc::default(), "1");
            let error = place.run().write(&edits).expect_err("it is not ours");
            assert!(error.to_string().contains("another user"), "{error}");
        }
    }

    /// What another user may have left in the folder before it was ours alone: none of it is followed,
    /// waited for or written to.
    #[test]
    fn files_that_are_not_followed() {
        type Plant = fn(&Place, &Path);
        let cases: &[(&str, Plant)] = &[
            ("a link", |place, at| {
                symlink(&place.victim, at).expect("free");
            }),
            ("a link to nothing", |place, at| {
                symlink(place.victim.with_extension("new"), at).expect("free");
            }),
            ("a link to a device", |_, at| {
                symlink("/dev/zero", at).expect("free");
            }),
            ("a pipe", |_, at| pipe(at)),
            ("a folder", |_, at| fs::create_dir(at).expect("free")),
            ("a file that others may write", |_, at| {
                fs::write(at, "9 9 9").expect("free");
                allow(at, 0o666);
            }),
        ];
        for (name, plant) in cases {
            let place = Place::new();
            place.make();
            plant(&place, &place.journal(0));
            assert_eq!(place.offered(), None, "{name}");
            let mut journal = place.run();
            place.keep(&mut journal, "1 2 4");
            let mode = fs::metadata(place.journal(1))
                .expect(name)
                .permissions()
                .mode();
            assert_eq!(mode & 0o777, 0o600, "{name}");
            let folder = fs::metadata(place.recovery())
                .expect(name)
                .permissions()
                .mode();
            assert_eq!(folder & 0o777, 0o700, "{name}");
            drop(journal);
            assert_eq!(place.offered().as_deref(), Some("1 2 4"), "{name}");
            let others = fs::read_dir(place.victim.parent().expect("a folder")).expect(name);
            assert_eq!(others.count(), 1, "{name}");
            assert_eq!(fs::read_to_string(&place.victim).expect(name), "untouched");
        }
    }

    #[test]
    fn a_journal_longer_than_the_scene_can_have_is_left_unread() {
        for (length, is_read) in [(1 << 20, true), (3 << 30, false), (1 << 40, false)] {
            let place = Place::new();
            place.make();
            let journal = place.journal(0);
            let file = File::create(&journal).expect("free");
            file.set_len(length).expect("a sparse file");
            let found = place.look(BASE);
            assert!(found.offer.is_none(), "{length}");
            let [complaint] = &found.complaints[..] else {
                panic!("{length}: {:?}", found.complaints);
            };
            // What is read is not whole, and is set aside.
            assert_eq!(journal.exists(), !is_read, "{length}");
            let place_of = journal.display().to_string();
            assert!(complaint.contains(&place_of), "{length}: {complaint}");
            let limit = complaint.ends_with("a journal of this scene at most 68 MB");
            assert_eq!(limit, !is_read, "{length}: {complaint}");
            let mut journal = place.run();
            place.keep(&mut journal, "1 2 4");
            drop(journal);
            assert!(place.look(BASE).offer.is_some(), "{length}");
        }
    }

    /// As on network file systems without a lock daemon.
    #[test]
    fn where_files_cannot_be_locked_no_journal_counts_as_left_behind() {
        use crate::file::faults::{Fault, during};
        use rustix::io::Errno;
        for error in [Errno::NOLCK, Errno::NOSYS] {
            let place = Place::new();
            let without_locks = |work: &mut dyn FnMut()| {
                let ((), calls) = during(Fault::Ever(error), 0, work);
                assert_eq!(calls.hit, Some("flock"), "{error}");
            };
            let mut journal = place.run();
            without_locks(&mut || place.keep(&mut journal, "1 2 4"));
            assert!(journal.is_kept());
            without_locks(&mut || {
                // An edit that the text has already would have the journal removed.
                for text in [BASE, "1 2 4"] {
                    let found = place.look(text);
                    assert!(found.offer.is_none(), "{error}: {text}");
                    let [complaint] = &found.complaints[..] else {
                        panic!("{error}: {:?}", found.complaints);
                    };
                    let place_of = place.journal(0).display().to_string();
                    assert!(complaint.contains(&place_of), "{complaint}");
                }
            });
            assert!(journal.is_kept());
            drop(journal);
            assert_eq!(place.offered().as_deref(), Some("1 2 4"));
        }
    }

    #[test]
    fn what_replaces_a_journal_follows_no_link() {
        let place = Place::new();
        let mut journal = place.run();
        place.keep(&mut journal, "1 2 4");
        let new = place.journal(0).with_extension("ray.new");
        symlink(&place.victim, new).expect("free");
        let edits = place.edits(&Arc::new("1".to_owned()), "1 2 5");
        journal.write(&edits).expect("it can be written");
        assert_eq!(
            fs::read_to_string(&place.victim).expect("a text"),
            "untouched"
        );
        assert_eq!(place.names().len(), 1);
    }

    #[test]
    fn a_folder_put_in_place_of_the_one_held_is_not_written_to() {
        let place = Place::new();
        let mut journal = place.run();
        place.keep(&mut journal, "1 2 4");
        let away = place.state.join("away");
        fs::rename(place.recovery(), &away).expect("it is ours");
        symlink(place.victim.parent().expect("a folder"), place.recovery()).expect("free");
        for (base, text) in [(BASE, "1 2 5"), ("1", "1 2 6")] {
            let edits = place.edits(&Arc::new(base.to_owned()), text);
            let error = journal.write(&edits).expect_err("nobody would find it");
            assert!(error.to_string().contains("symbolic link"), "{error}");
            assert!(!journal.is_kept());
        }
        assert_eq!(fs::read_dir(place.recovery()).expect("a folder").count(), 1);
        assert_eq!(fs::read_dir(away).expect("a folder").count(), 1);
    }
}
