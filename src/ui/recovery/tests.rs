//! Journals on a real file system: keeping, finding, refusing and leaving them alone.

#[cfg(unix)]
mod hostile;

use std::fs::{self, File};
use std::iter;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, SystemTime};

use tempfile::TempDir;

use super::claim::Claim;
use super::identity::Identity;
use super::journal::{Edits, Journal};
use super::offer::look_in;
use super::{Found, Offer, Sought, missing, note_for_missing, record};
use crate::document::{Document, Snapshot};
use crate::language::Language;
use crate::ui::state::{Folder, Part};

/// An offer of edits for a text, whose journal is gone.
pub(crate) fn offer(language: Language, text: &Arc<String>, base: &str, kept: &str) -> Offer {
    let place = Place::new();
    let folder = Arc::new(Folder::make(&place.state, Part::Edits).expect("a folder"));
    let claim = Claim::new(&folder, &Identity::of(None, language)).expect("it is empty");
    let sought = Sought {
        scene: None,
        language,
        text: Arc::clone(text),
        put_off: Vec::new(),
    };
    let (base, kept) = (base.to_owned(), kept.to_owned());
    Offer::new(Arc::new(claim), &sought, base, kept).expect("the text lacks them")
}

/// The same offer, from a journal that is damaged elsewhere.
pub(crate) fn damaged(offer: Offer) -> Offer {
    let claim = Arc::into_inner(offer.claim).expect("nobody else has it");
    Offer {
        claim: Arc::new(claim.damaged()),
        ..offer
    }
}

/// A state folder, and beside it a file that must not be touched.
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
        Folder::make(&self.state, Part::Edits).expect("a folder");
    }

    fn scene(&self) -> PathBuf {
        self.directory.path().join("a.ray")
    }

    /// The path of the scene's journal with this number, from 0.
    fn journal(&self, number: usize) -> PathBuf {
        let scene = Identity::of(Some(&self.scene()), Language::Ray);
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
        journal.write(edits).expect("it can be written");
    }

    fn look(&self, text: &str) -> Found {
        let sought = Sought {
            scene: Some(self.scene()),
            language: Language::Ray,
            text: Arc::new(text.to_owned()),
            put_off: Vec::new(),
        };
        look_in(&self.state, &sought)
    }

    /// The content of the file with the offered edits restored.
    fn offered(&self) -> Option<String> {
        let found = self.look(BASE);
        assert_eq!(found.complaints, [] as [String; 0]);
        taken(&found)
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

/// [`BASE`] with the offered edits restored.
fn taken(found: &Found) -> Option<String> {
    let mut document = Document::new(Language::Ray, BASE.to_owned());
    found.offer.as_ref().map(|offer| {
        match &offer.way {
            super::Way::Edit(edit) => document.edit(std::slice::from_ref(edit)),
            super::Way::Merge(merge) => drop(document.restore(merge)),
        }
        document.text().to_owned()
    })
}

fn known(base: &Arc<String>, text: &str) -> Snapshot {
    Snapshot {
        language: Language::Ray,
        saved: Arc::clone(base),
        edited: Some(Arc::new(text.to_owned())),
    }
}

#[test]
#[cfg(unix)]
fn edits_of_a_running_process_are_not_offered() {
    let place = Place::new();
    let (mut first, mut second) = (place.run(), place.run());
    place.keep(&mut first, "1 2 4");
    place.keep(&mut second, "9 2 3");
    assert_eq!(place.offered(), None);
    let other = Arc::new("1 2 4".to_owned());
    let edits = place.edits(&other, "1 2 5");
    first.write(edits).expect("it can be written");
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
fn the_last_kept_text_is_offered() {
    let place = Place::new();
    let mut journal = place.run();
    for text in ["1 2 4", "1 2 5", BASE, "7"] {
        place.keep(&mut journal, text);
    }
    drop(journal);
    assert_eq!(place.offered().as_deref(), Some("7"));
    // Edits that the text already contains are forgotten.
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
    let mut document = Document::new(Language::Ray, text.clone());
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
fn edits_are_appended_until_they_outgrow_the_text() {
    let place = Place::new();
    let base = Arc::new("1 ".repeat(1 << 18));
    let mut journal = place.run();
    let mut lengths = Vec::new();
    for number in 2..42 {
        let text = base.replacen('1', &number.to_string(), 1 + number % 2 * 150_000);
        let edits = place.edits(&base, &text);
        journal.write(edits).expect("it can be written");
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
fn a_removed_journal_is_recreated() {
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

/// Under its new name the scene has its own journal.
#[test]
fn a_scene_saved_under_another_name_leaves_no_journal_behind() {
    let place = Place::new();
    let mut journal = place.run();
    place.keep(&mut journal, "1 2 4");
    let known = known(&Arc::default(), "1 2 5");
    let scene = Some(place.directory.path().join("b.ray"));
    let other = Edits { scene, known };
    journal.write(other).expect("it can be written");
    assert_eq!(place.offered(), None);
    let names = place.names();
    assert!(names.len() == 1 && names[0].starts_with("b-"), "{names:?}");
}

#[test]
fn a_journal_changed_by_others_is_rewritten() {
    type Change = fn(&File);
    let changes: &[(&str, Change)] = &[
        ("emptied", |file| file.set_len(0).expect("it is ours")),
        ("cut", |file| file.set_len(100).expect("it is ours")),
        ("longer", |file| file.set_len(4096).expect("it is ours")),
        #[cfg(unix)]
        ("open to all", |file| {
            let mode = std::os::unix::fs::PermissionsExt::from_mode(0o666);
            file.set_permissions(mode).expect("it is ours");
        }),
    ];
    for (name, change) in changes {
        let place = Place::new();
        let mut journal = place.run();
        place.keep(&mut journal, "1 2 4");
        let file = File::options().write(true).open(place.journal(0));
        change(&file.expect("it is ours"));
        assert!(!journal.is_kept(), "{name}");
        place.keep(&mut journal, "1 2 4");
        assert!(journal.is_kept(), "{name}");
        drop(journal);
        assert_eq!(place.offered().as_deref(), Some("1 2 4"), "{name}");
        assert_eq!(place.names().len(), 1, "{name}");
    }
}

#[test]
fn edits_of_a_missing_file_are_found() {
    let place = Place::new();
    let base = || missing::base_in(&place.state, Some(&place.scene()), Language::Ray);
    let note = || missing::note_for_unreadable(&place.state, &place.scene());
    assert_eq!((base(), note()), (None, None));
    let mut journal = place.run();
    place.keep(&mut journal, "1 2 4");
    fs::remove_file(place.scene()).expect("it is there");
    assert_eq!((base(), note()), (None, None), "their run goes on");
    drop(journal);
    assert_eq!(base().as_deref(), Some(BASE));
    let named = |said: &Option<String>| {
        let journal = place.journal(0).display().to_string();
        said.as_ref().is_some_and(|said| said.contains(&journal))
    };
    assert!(named(&note()));
    fs::write(place.journal(0), "damaged").expect("it is ours");
    assert_eq!(base(), None);
    assert!(named(&note_for_missing(&place.state, &place.scene())));
}

/// A journal in parts: the head with the base, and edits.
pub(super) fn parts(scene: &Identity, base: &str, texts: &[&str]) -> Vec<Vec<u8>> {
    let (head, seal) = record::head(scene, base);
    let edits = (texts.iter()).map(|text| record::edit(seal, &record::difference(base, text)));
    iter::once(head).chain(edits).collect()
}

/// Builds a file's content from the parts of a journal with two edits.
type Write = fn(Vec<Vec<u8>>) -> Vec<u8>;

/// A file in place of a journal.
struct Left {
    name: &'static str,
    write: Write,
    offered: Option<&'static str>,
    /// The end of the complaint.
    said: Option<&'static str>,
    /// The end of the file's name once its edits are declined; empty if the file is gone.
    name_ends: &'static str,
}

const LEFT: &[Left] = &[
    Left {
        name: "whole",
        write: |parts| parts.concat(),
        offered: Some("1 2 5"),
        said: None,
        name_ends: "",
    },
    Left {
        name: "with a torn end",
        write: |parts| [parts.concat(), b"edit 0 5".to_vec()].concat(),
        offered: Some("1 2 5"),
        said: None,
        name_ends: "",
    },
    Left {
        name: "with a damaged edit",
        write: |mut parts| {
            parts[1].fill(0);
            parts.concat()
        },
        offered: Some("1 2 5"),
        said: None,
        name_ends: ".damaged",
    },
    Left {
        name: "with a damaged end",
        write: |mut parts| {
            parts[2][0] = b'E';
            parts.concat()
        },
        offered: Some("1 2 4"),
        said: None,
        name_ends: ".damaged",
    },
    Left {
        name: "with a damaged head",
        write: |mut parts| {
            parts[0][b"halflight journal ".len()] ^= 1;
            parts.concat()
        },
        offered: Some("1 2 5"),
        said: None,
        name_ends: ".damaged",
    },
    Left {
        name: "torn before its first edit",
        write: |parts| parts[0].clone(),
        offered: None,
        said: Some(".damaged is damaged"),
        name_ends: ".damaged",
    },
    Left {
        name: "zeros",
        write: |_| vec![0; 4096],
        offered: None,
        said: Some(".damaged is damaged"),
        name_ends: ".damaged",
    },
    Left {
        name: "a scene",
        write: |_| b"1 2 4".to_vec(),
        offered: None,
        said: Some(".damaged is damaged"),
        name_ends: ".damaged",
    },
    Left {
        name: "empty",
        write: |_| Vec::new(),
        offered: None,
        said: None,
        name_ends: "",
    },
    Left {
        name: "of another scene",
        write: |_| {
            let other = Identity::of(Some(Path::new("/other.ray")), Language::Ray);
            parts(&other, BASE, &["1 2 4"]).concat()
        },
        offered: None,
        said: Some("-0.ray belongs to another scene"),
        name_ends: "-0.ray",
    },
    Left {
        name: "of another version",
        write: |_| b"halflight journal 9\nx".to_vec(),
        offered: None,
        said: Some("-0.ray is of another version of halflight"),
        name_ends: "-0.ray",
    },
];

#[test]
fn files_in_place_of_journals() {
    for left in LEFT {
        let place = Place::new();
        let name = left.name;
        place.make();
        let scene = Identity::of(Some(&place.scene()), Language::Ray);
        let parts = parts(&scene, BASE, &["1 2 4", "1 2 5"]);
        fs::write(place.journal(0), (left.write)(parts)).expect("the folder is ours");
        let found = place.look(BASE);
        let said = found.complaints.first();
        assert_eq!(said.is_some(), left.said.is_some(), "{name}: {said:?}");
        if let Some((said, expected)) = said.zip(left.said) {
            assert!(said.ends_with(expected), "{name}: {said}");
        }
        assert_eq!(taken(&found).as_deref(), left.offered, "{name}");
        if let Some(offer) = found.offer {
            let is_damaged = left.name_ends == ".damaged";
            assert_eq!(offer.is_damaged(), is_damaged, "{name}");
            offer.claim.remove().expect("it is ours");
        }
        let names = place.names();
        let expected = usize::from(!left.name_ends.is_empty());
        assert_eq!(names.len(), expected, "{name}: {names:?}");
        let is_expected = |name: &String| name.ends_with(left.name_ends);
        assert!(names.iter().all(is_expected), "{name}: {names:?}");
    }
}

/// A loss from a journal must be reported even if the file has the rest.
#[test]
fn a_damaged_journal_is_reported_and_outlives_the_next_one() {
    let place = Place::new();
    place.make();
    let scene = Identity::of(Some(&place.scene()), Language::Ray);
    let mut parts = parts(&scene, BASE, &["1 2 4", "1 2 5"]);
    parts[2][0] = b'E';
    for names in 1..4 {
        fs::write(place.journal(0), parts.concat()).expect("the folder is ours");
        let found = place.look("1 2 4");
        assert!(found.offer.is_none());
        let [said] = &found.complaints[..] else {
            panic!("{:?}", found.complaints);
        };
        assert!(said.ends_with("is damaged"), "{said}");
        assert_eq!(place.names().len(), names);
        assert_eq!(place.look("1 2 4").complaints, [] as [String; 0]);
    }
}
