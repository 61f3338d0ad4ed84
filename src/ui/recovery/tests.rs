//! Journals on a real file system: keeping, finding, refusing and leaving them alone.

mod hostile;

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, SystemTime};
use std::{iter, slice};

use tempfile::TempDir;

use super::claim::Claim;
use super::identity::Identity;
use super::journal::{Edits, Journal};
use super::offer::look_in;
use super::{Found, Offer, Sought, Way, missing, note_for_missing, record};
use document::{Document, Snapshot};
use file::state_folder::{Folder, Store};
use language::Language;

/// An offer of edits for a text, whose journal is gone.
pub(crate) fn offer(language: Language, text: &Arc<String>, base: &str, kept: &str) -> Offer {
    let place = Place::new();
    let folder = Arc::new(Folder::make(&place.state, Store::Edits).expect("a folder"));
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
        self.own().join("recovery")
    }

    /// The folder around that of the journals.
    fn own(&self) -> PathBuf {
        self.state.join("halflight")
    }

    fn make(&self) {
        Folder::make(&self.state, Store::Edits).expect("a folder");
    }

    fn scene(&self) -> PathBuf {
        self.directory.path().join("a.ray")
    }

    /// The path of the scene's journal with this number, from 0.
    fn journal(&self, number: usize) -> PathBuf {
        let name = scene(self.scene()).names().nth(number).expect("a few");
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

/// Restores offered edits.
fn restore(document: &mut Document, offer: &Offer) {
    match &offer.way {
        Way::Edit(edit) => document.edit(slice::from_ref(edit)),
        Way::Merge(merge) => drop(document.restore(merge)),
    }
}

/// [`BASE`] with the offered edits restored.
fn taken(found: &Found) -> Option<String> {
    let mut document = Document::new(Language::Ray, BASE.to_owned());
    restore(&mut document, found.offer.as_ref()?);
    Some(document.text().to_owned())
}

/// The only complaint.
#[track_caller]
fn complaint(found: &Found) -> &str {
    let [said] = &found.complaints[..] else {
        panic!("{:?}", found.complaints);
    };
    said
}

fn known(base: &Arc<String>, text: &str) -> Snapshot {
    Snapshot {
        language: Language::Ray,
        saved: Arc::clone(base),
        edited: Some(Arc::new(text.to_owned())),
    }
}

#[test]
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
    // That of the other stays.
    assert_eq!(place.offered().as_deref(), Some("9 2 3"));
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
    let mut document = Document::new(Language::Ray, BASE.to_owned());
    let mut taken = Vec::new();
    while let Some(offer) = place.look(document.text()).offer {
        restore(&mut document, &offer);
        offer.claim.remove().expect("it is ours");
        taken.push(document.text().to_owned());
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
    let is_short = |&length: &u64| length < most as u64;
    assert!(lengths.iter().all(is_short), "{lengths:?}");
    // A small edit.
    assert!(lengths[2] - lengths[1] < 100_000, "{lengths:?}");
    assert_eq!(place.names().len(), 1);
}

/// Asserts that a journal is kept again after what others do to it, with so many files in the folder
/// then.
fn check_kept_again(name: &str, change: fn(&Place), files: usize) {
    // The same text, as at the end, or another one after it.
    for texts in [&["1 2 4"][..], &["1 2 4", "1 2 5"]] {
        let place = Place::new();
        let mut journal = place.run();
        place.keep(&mut journal, "1 2 4");
        assert!(journal.is_kept(), "{name}");
        change(&place);
        assert!(!journal.is_kept(), "{name}");
        for text in texts {
            place.keep(&mut journal, text);
            assert!(journal.is_kept(), "{name}");
        }
        drop(journal);
        assert_eq!(place.offered().as_deref(), texts.last().copied(), "{name}");
        assert_eq!(place.names().len(), files, "{name}");
    }
}

#[test]
fn a_journal_removed_or_changed_by_others_is_rewritten() {
    fn rename(from: PathBuf, to: PathBuf) {
        fs::rename(from, to).expect("it is there");
    }
    fn cut(place: &Place, length: u64) {
        let file = File::options().write(true).open(place.journal(0));
        let cut = file.and_then(|file| file.set_len(length));
        cut.expect("it is ours");
    }
    type Change = fn(&Place);
    for (name, change, files) in table! {
        "all", (|p| fs::remove_dir_all(&p.state).expect("there")) as Change => 1;
        "file", |p| fs::remove_file(p.journal(0)).expect("there") => 1;
        "name", |p| rename(p.journal(0), p.recovery().join("moved")) => 2;
        "file moved", |p| rename(p.journal(0), p.state.join("moved")) => 1;
        "folder moved", |p| rename(p.recovery(), p.state.join("moved")) => 1;
        "emptied", |p| cut(p, 0) => 1;
        "cut", |p| cut(p, 100) => 1;
        "longer", |p| cut(p, 4096) => 1;
    } {
        check_kept_again(name, change, files);
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

/// The scene at a path.
pub(super) fn scene(path: impl AsRef<Path>) -> Identity {
    Identity::of(Some(path.as_ref()), Language::Ray)
}

/// What is offered, the end of the complaint, and the end of the file's name once its edits are
/// declined, which is empty if the file is gone, for files made from the parts of a journal with two
/// edits.
#[test]
fn files_in_place_of_journals() {
    type Change = fn(&mut Vec<Vec<u8>>);
    let damaged = Some(".damaged is damaged");
    let other_version = Some("-0.ray is of another version of halflight");
    for (name, change, offered, said, name_ends) in table! {
        "whole", (|_| ()) as Change => Some("1 2 5"), None, "";
        "with a torn end", |all| all.push(b"edit 0 5".to_vec()) => Some("1 2 5"), None, "";
        "with a damaged edit", |all| all[1].fill(0) => Some("1 2 5"), None, ".damaged";
        "with a damaged end", |all| all[2][0] = b'E' => Some("1 2 4"), None, ".damaged";
        "with a damaged head", |all| all[0][b"halflight journal ".len()] ^= 1 =>
            Some("1 2 5"), None, ".damaged";
        "torn before its first edit", |all| all.truncate(1) => None, damaged, ".damaged";
        "zeros", |all| *all = vec![vec![0; 4096]] => None, damaged, ".damaged";
        "a scene", |all| *all = vec![b"1 2 4".to_vec()] => None, damaged, ".damaged";
        "empty", |all| all.clear() => None, None, "";
        "of another scene", |all| *all = parts(&scene("/other.ray"), BASE, &["1 2 4"]) =>
            None, Some("-0.ray belongs to another scene"), "-0.ray";
        "of another version", |all| *all = vec![b"halflight journal 9\nx".to_vec()] =>
            None, other_version, "-0.ray";
    } {
        let place = Place::new();
        place.make();
        let mut parts = parts(&scene(place.scene()), BASE, &["1 2 4", "1 2 5"]);
        change(&mut parts);
        fs::write(place.journal(0), parts.concat()).expect("the folder is ours");
        let found = place.look(BASE);
        let complaint = found.complaints.first();
        assert_eq!(complaint.is_some(), said.is_some(), "{name}: {complaint:?}");
        if let Some((complaint, said)) = complaint.zip(said) {
            assert!(complaint.ends_with(said), "{name}: {complaint}");
        }
        assert_eq!(taken(&found).as_deref(), offered, "{name}");
        if let Some(offer) = found.offer {
            assert_eq!(offer.is_damaged(), name_ends == ".damaged", "{name}");
            offer.claim.remove().expect("it is ours");
        }
        let names = place.names();
        let is_expected = |name: &String| name.ends_with(name_ends);
        assert_eq!(names.len(), usize::from(!name_ends.is_empty()), "{name}");
        assert!(names.iter().all(is_expected), "{name}: {names:?}");
    }
}

/// A loss from a journal must be reported even if the file has the rest.
#[test]
fn a_damaged_journal_is_reported_and_outlives_the_next_one() {
    let place = Place::new();
    place.make();
    let mut parts = parts(&scene(place.scene()), BASE, &["1 2 4", "1 2 5"]);
    parts[2][0] = b'E';
    for names in 1..4 {
        fs::write(place.journal(0), parts.concat()).expect("the folder is ours");
        let found = place.look("1 2 4");
        assert!(found.offer.is_none());
        assert!(complaint(&found).ends_with("is damaged"));
        assert_eq!(place.names().len(), names);
        assert_eq!(place.look("1 2 4").complaints, [] as [String; 0]);
    }
}
