//! Folders and files that others have placed where journals belong.

use std::os::unix::fs::{PermissionsExt, symlink};
use std::process::Command;

use super::*;

fn allow(path: &Path, mode: u32) {
    fs::set_permissions(path, fs::Permissions::from_mode(mode)).expect("it is ours");
}

fn pipe(path: &Path) {
    let made = Command::new("mkfifo").arg(path).status();
    assert!(made.expect("every system has it").success());
}

/// Moves a folder of journals away and puts something in its place.
fn replace(place: &Place, folder: &Path, put: fn(&Path, &Path)) {
    let away = place.state.join("away");
    fs::rename(folder, &away).expect("it is ours");
    put(&away, folder);
}

/// In these folders nothing is kept and nothing is read.
#[test]
fn unsafe_folders_are_refused() {
    fn link(away: &Path, at: &Path) {
        symlink(away, at).expect("it is free");
    }
    fn file(_: &Path, at: &Path) {
        fs::write(at, "").expect("it is free");
    }
    type Prepare = fn(&Place);
    for (name, prepare, words) in table! {
        "a group may write", (|p| allow(&p.recovery(), 0o770)) as Prepare => "chmod go-w";
        "others may write", |p| allow(&p.recovery(), 0o1777) => "chmod go-w";
        "others may write around it", |p| allow(&p.own(), 0o757) => "chmod go-w";
        "others may write in the state folder", |p| allow(&p.state, 0o777) => "chmod o-w";
        "a link", |p| replace(p, &p.recovery(), link) => "recovery is a symbolic link";
        "a link around it", |p| replace(p, &p.own(), link) => "halflight is a symbolic link";
        "a file", |p| replace(p, &p.recovery(), file) => "recovery is not a folder";
        "a pipe", |p| replace(p, &p.recovery(), |_, at| pipe(at)) => "recovery is not a folder";
        "a file around it", |p| replace(p, &p.own(), file) => "halflight is not a folder";
    } {
        let place = Place::new();
        place.keep(&mut place.run(), "1 2 4");
        prepare(&place);
        let found = place.look(BASE);
        assert!(found.offer.is_none(), "{name}");
        let is_said = !words.ends_with("is not a folder");
        assert_eq!(found.complaints.len(), usize::from(is_said), "{name}");
        let edits = place.edits(&Arc::new(BASE.to_owned()), "1 2 5");
        let mut journal = place.run();
        let error = journal.write(edits).expect_err(name).to_string();
        assert!(error.contains(words), "{name}: {error}");
        assert!(!journal.is_kept(), "{name}");
    }
}

#[test]
fn a_journal_open_to_all_is_rewritten() {
    check_kept_again("open to all", |p| allow(&p.journal(0), 0o666), 1);
}

/// Everybody may write there, but nobody can move files of others.
#[test]
fn a_state_folder_shared_like_tmp_is_accepted() {
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
        let error = place.run().write(edits).expect_err("it is not ours");
        assert!(error.to_string().contains("another user"), "{error}");
    }
}

/// Files that another user may have left in the folder before it became private: none is followed,
/// waited for or written to.
#[test]
fn planted_files_are_neither_followed_nor_written_to() {
    fn link(to: impl AsRef<Path>, at: &Path) {
        symlink(to, at).expect("it is free");
    }
    fn open_file(at: &Path) {
        fs::write(at, "9 9 9").expect("it is free");
        allow(at, 0o666);
    }
    type Plant = fn(&Place, &Path);
    let mode = |path: PathBuf| {
        let metadata = fs::metadata(path).expect("it is there");
        metadata.permissions().mode() & 0o777
    };
    for (name, plant, reason) in table! {
        "a link", (|p, at| link(&p.victim, at)) as Plant => "is not a regular file";
        "a link to nothing", |p, at| link(p.victim.with_extension("new"), at) =>
            "is not a regular file";
        "a link to a device", |_, at| link("/dev/zero", at) => "is not a regular file";
        "a pipe", |_, at| pipe(at) => "is not a regular file";
        "a folder", |_, at| fs::create_dir(at).expect("free") => "is not a regular file";
        "a file that others may write", |_, at| open_file(at) => "may be written by others";
    } {
        let is_refused = |found| complaint(found).ends_with(&format!("-0.ray {reason}"));
        let place = Place::new();
        place.make();
        plant(&place, &place.journal(0));
        let found = place.look(BASE);
        assert!(found.offer.is_none() && is_refused(&found), "{name}");
        let mut journal = place.run();
        place.keep(&mut journal, "1 2 4");
        assert_eq!(mode(place.journal(1)), 0o600, "{name}");
        assert_eq!(mode(place.recovery()), 0o700, "{name}");
        drop(journal);
        let found = place.look(BASE);
        assert!(is_refused(&found), "{name}");
        assert_eq!(taken(&found).as_deref(), Some("1 2 4"), "{name}");
        let others = fs::read_dir(place.victim.parent().expect("a folder")).expect(name);
        assert_eq!(others.count(), 1, "{name}");
        assert_eq!(fs::read_to_string(&place.victim).expect(name), "untouched");
    }
}

#[test]
fn a_journal_too_long_for_the_scene_is_not_read() {
    for (length, is_read) in [(1 << 20, true), (3 << 30, false), (1 << 40, false)] {
        let place = Place::new();
        place.make();
        let journal = place.journal(0);
        let sparse = File::create(&journal).and_then(|file| file.set_len(length));
        sparse.expect("a sparse file");
        let found = place.look(BASE);
        assert!(found.offer.is_none(), "{length}");
        let complaint = complaint(&found);
        // A file that was read holds only zeros, so it is set aside.
        assert_eq!(journal.exists(), !is_read, "{length}");
        let place_of = journal.display().to_string();
        assert!(complaint.contains(&place_of), "{length}: {complaint}");
        let limit = complaint.ends_with("a journal of this scene at most 68 MB");
        assert_eq!(limit, !is_read, "{length}: {complaint}");
        place.keep(&mut place.run(), "1 2 4");
        assert!(place.look(BASE).offer.is_some(), "{length}");
    }
}

/// As on network file systems without a lock daemon.
#[test]
fn without_file_locks_no_journal_counts_as_left_behind() {
    use file::faults::{Fault, during};
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
            // If the text already contains the edit, the journal would be removed.
            for text in [BASE, "1 2 4"] {
                let found = place.look(text);
                assert!(found.offer.is_none(), "{error}: {text}");
                let journal = place.journal(0).display().to_string();
                assert!(complaint(&found).contains(&journal), "{error}: {text}");
            }
        });
        assert!(journal.is_kept());
        drop(journal);
        assert_eq!(place.offered().as_deref(), Some("1 2 4"));
    }
}

#[test]
fn replacing_a_journal_follows_no_link() {
    let place = Place::new();
    let mut journal = place.run();
    place.keep(&mut journal, "1 2 4");
    let new = place.journal(0).with_extension("ray.new");
    symlink(&place.victim, new).expect("free");
    let edits = place.edits(&Arc::new("1".to_owned()), "1 2 5");
    journal.write(edits).expect("it can be written");
    let held = fs::read_to_string(&place.victim).expect("a text");
    assert_eq!(held, "untouched");
    assert_eq!(place.names().len(), 1);
}

#[test]
fn a_folder_that_replaces_the_held_one_is_not_written_to() {
    let place = Place::new();
    let mut journal = place.run();
    place.keep(&mut journal, "1 2 4");
    let away = place.state.join("away");
    fs::rename(place.recovery(), &away).expect("it is ours");
    symlink(place.victim.parent().expect("a folder"), place.recovery()).expect("free");
    for (base, text) in [(BASE, "1 2 5"), ("1", "1 2 6")] {
        let edits = place.edits(&Arc::new(base.to_owned()), text);
        let error = journal.write(edits).expect_err("nobody would find it");
        assert!(error.to_string().contains("symbolic link"), "{error}");
        assert!(!journal.is_kept());
    }
    assert_eq!(fs::read_dir(place.recovery()).expect("a folder").count(), 1);
    assert_eq!(fs::read_dir(away).expect("a folder").count(), 1);
}
