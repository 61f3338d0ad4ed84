//! Recovery of unsaved edits after crashes, changes from outside, and problems with the recovery
//! folder.

use super::*;

const QUESTION: &str = "unsaved edits from an earlier run";

/// Changes the green ball's radius, like another editor while the program is not running.
fn change_green(place: &Place, radius: &str) {
    let text = place.read("balls.ray");
    place.replace("balls.ray", &text.replacen("0.8 ", radius, 1));
}

/// Waits until the text under edit is in a journal.
fn wait_until_kept(place: &Place, session: &mut Session, text: &str) {
    while !place.kept_texts().contains(&text.to_owned()) {
        session.drain(Duration::from_millis(1));
    }
}

/// Edits the red ball's radius and kills the process once the edit is stored.
fn crash_with_edits(place: &Place) {
    let mut session = place.open_edited();
    wait_until_kept(place, &mut session, &edited());
    kill(session.process_id(), Signal::KILL);
    session.end();
}

#[test]
fn edits_survive_a_crash_and_a_run_that_leaves_them_undecided() {
    let place = Place::new();
    crash_with_edits(&place);
    let is_kept = || place.kept_texts() == [edited()];
    assert!(is_kept());

    let mut session = place.start(&["balls.ray"], WIDE);
    session.wait_for(QUESTION);
    session.send(ESC);
    wait_until_gone(&mut session, QUESTION);
    session.send("G\rj2\rw");
    session.wait_for("wrote balls.ray");
    quit(session);
    assert!(is_kept());

    let mut session = place.start(&["balls.ray"], WIDE);
    session.wait_for(QUESTION);
    session.send("d");
    wait_until_gone(&mut session, QUESTION);
    quit(session);
    assert_eq!(place.kept_texts(), [] as [String; 0]);
}

/// The scene is identified regardless of the path it is opened by.
#[test]
fn changes_from_outside_are_merged_with_recovered_edits() {
    for name in ["balls.ray", "x/../balls.ray", "x/link.ray"] {
        let place = Place::new();
        fs::create_dir(place.at("x")).expect("the folder is new");
        std::os::unix::fs::symlink("../balls.ray", place.at("x/link.ray")).expect("no such file");
        crash_with_edits(&place);
        change_green(&place, "0.5 ");
        let theirs = place.read("balls.ray");

        let mut session = place.start(&[name], WIDE);
        session.wait_for(QUESTION);
        session.wait_for("has changed since");
        session.send("r");
        session.wait_for("restored and merged");
        session.send("w");
        session.wait_for("wrote ");
        let both = theirs.replacen(".80", "2", 1);
        assert_eq!(place.read("balls.ray"), both, "{name}");
        quit(session);
        assert_eq!(place.kept_texts(), [] as [String; 0], "{name}");
    }
}

#[test]
fn a_question_is_asked_if_others_changed_the_edited_places() {
    for (answer, radius) in [("m", "2"), ("t", ".90")] {
        let place = Place::new();
        crash_with_edits(&place);
        let theirs = BALLS.replacen(".80", ".90", 1).replacen("0.8 ", "0.5 ", 1);
        place.replace("balls.ray", &theirs);
        let mut session = place.start(&["balls.ray"], WIDE);
        session.wait_for(QUESTION);
        session.send("r");
        session.wait_for("The file and your unsaved edits both changed these");
        session.wait_for("mine 2");
        session.wait_for("file .90");
        session.send([answer, ENTER].concat());
        wait_until_gone(&mut session, "Both the file");
        session.send("w");
        session.wait("waiting for the answer to the save", |screen| {
            ["wrote balls.ray", "nothing to save"]
                .iter()
                .any(|said| screen.contents().contains(said))
        });
        assert_eq!(place.read("balls.ray"), theirs.replacen(".90", radius, 1));
        quit(session);
        assert_eq!(place.kept_texts(), [] as [String; 0], "after {answer}");
    }
}

#[test]
fn the_edits_of_two_windows_are_stored_separately_and_both_offered() {
    let place = Place::new();
    let mut first = place.open_edited();
    wait_until_kept(&place, &mut first, &edited());
    let mut second = place.start(&["balls.ray"], WIDE);
    wait_for_rest(&mut second);
    assert!(!second.text().contains(QUESTION), "the first one goes on");
    second.send("G\rj3\r");
    let other = BALLS.replacen("0.8 ", "3 ", 1);
    wait_until_kept(&place, &mut second, &other);
    assert_eq!(place.kept_texts().len(), 2);
    for mut session in [first, second] {
        kill(session.process_id(), Signal::KILL);
        session.end();
    }

    let mut session = place.start(&["balls.ray"], WIDE);
    session.wait_for(QUESTION);
    session.send("r");
    // The newer one first; then the other one, which is merged with it.
    session.wait_for("differs from the text");
    session.send("r");
    session.wait_for("restored and merged");
    session.send("w");
    session.wait_for("wrote balls.ray");
    assert_eq!(place.read("balls.ray"), other.replacen(".80", "2", 1));
    quit(session);
    assert_eq!(place.kept_texts(), [] as [String; 0]);
}

#[test]
fn edits_are_stored_once_their_folder_can_be_created() {
    let place = Place::new();
    fs::create_dir_all(place.at(".local/state")).expect("the folder is new");
    place.write(".local/state/halflight", "in the way");
    let mut session = place.start(&["balls.ray"], WIDE);
    // The reason names the folder, whose path may leave no room for how far the picture is.
    session.wait_for("cannot listen for editors: ");
    session.wait_for("recent scenes ");
    session.send(RADIUS_TO_2);
    session.wait_for("unsaved edits cannot be kept for recovery");
    session.wait_for("[no backup]");
    fs::remove_file(place.at(".local/state/halflight")).expect("it is there");
    wait_until_gone(&mut session, "no backup");
    kill(session.process_id(), Signal::KILL);
    session.end();
    assert_eq!(place.kept_texts(), [edited()]);
}

#[test]
fn a_deleted_journal_is_written_again_at_the_end() {
    for signal in [Signal::HUP, Signal::TERM] {
        let place = Place::new();
        let mut session = place.open_edited();
        wait_until_kept(&place, &mut session, &edited());
        fs::remove_dir_all(place.at(".local/state/halflight")).expect("it is there");
        kill(session.process_id(), signal);
        session.end();
        assert_eq!(place.kept_texts(), [edited()]);
    }
}

#[test]
fn a_truncated_journal_is_written_again_at_the_end() {
    let place = Place::new();
    let mut session = place.open_edited();
    wait_until_kept(&place, &mut session, &edited());
    for journal in place.recovery_files() {
        fs::write(journal, "").expect("it is ours");
    }
    kill(session.process_id(), Signal::HUP);
    session.end();
    assert_eq!(place.kept_texts(), [edited()]);
}

#[test]
fn the_last_intact_edits_of_a_damaged_journal_are_offered() {
    let place = Place::new();
    let mut session = place.open_edited();
    let text = |radius| BALLS.replacen(".80", radius, 1);
    wait_until_kept(&place, &mut session, &text("2"));
    for radius in ["3", "4"] {
        session.send([radius, ENTER].concat());
        wait_until_kept(&place, &mut session, &text(radius));
    }
    kill(session.process_id(), Signal::KILL);
    session.end();
    let [journal] = &place.recovery_files()[..] else {
        panic!("one journal");
    };
    let content = fs::read_to_string(journal).expect("a text");
    fs::write(journal, content.replacen("0 0 3 ", "0 0 7 ", 1)).expect("it is ours");

    let mut session = place.start(&["balls.ray"], WIDE);
    session.wait_for(QUESTION);
    session.wait_for("journal is damaged");
    session.send("r");
    session.wait_for("restored");
    session.send("w");
    session.wait_for("wrote balls.ray");
    quit(session);
    assert_eq!(place.read("balls.ray"), text("4"));
    let aside = format!("{}.damaged", journal.display());
    assert!(PathBuf::from(aside).exists());
}

#[test]
fn edits_of_a_deleted_file_are_offered() {
    let place = Place::new();
    crash_with_edits(&place);
    fs::remove_file(place.at("balls.ray")).expect("it is there");
    let mut session = place.start(&["balls.ray"], WIDE);
    session.wait_for(QUESTION);
    session.wait_for("no such file");
    session.send("r");
    session.wait_for("restored");
    session.send("w");
    session.wait_for("wrote balls.ray");
    quit(session);
    assert_eq!(place.read("balls.ray"), edited());
    assert_eq!(place.kept_texts(), [] as [String; 0]);
}

#[test]
fn an_obstacle_at_the_path_of_a_scene_hides_no_edits_of_it() {
    let place = Place::new();
    crash_with_edits(&place);
    fs::remove_file(place.at("balls.ray")).expect("it is there");
    fs::create_dir(place.at("balls.ray")).expect("the name is free");
    let mut session = place.start(&["balls.ray"], WIDE);
    assert_eq!(session.end().code(), Some(66));
    let text = session.text();
    assert!(
        text.contains("note: unsaved edits of it are kept in"),
        "{text}"
    );
    assert_eq!(place.kept_texts(), [edited()]);
}

#[test]
fn edits_that_can_t_be_stored_are_reported_as_lost_at_the_end() {
    let place = Place::new();
    place.write(".local", "in the way");
    let mut session = place.open_edited();
    session.wait_for("[no backup]");
    kill(session.process_id(), Signal::TERM);
    assert_eq!(session.end().code(), Some(143));
    session.assert_restored();
    let text = session.text();
    assert!(text.contains("not all unsaved edits are kept"), "{text}");
}

/// Simulates a temporarily full disk for a single process.
#[test]
#[cfg(target_os = "linux")]
fn edits_are_stored_once_there_is_space_again() {
    use rustix::process::{Resource, Rlimit, prlimit};
    for signal in [Signal::HUP, Signal::KILL] {
        let place = Place::new();
        let mut session = place.open_edited();
        wait_until_kept(&place, &mut session, &edited());
        let process = Pid::from_raw(session.process_id().cast_signed());
        let limit = |current| {
            let limit = Rlimit {
                current,
                maximum: None,
            };
            prlimit(process, Resource::Fsize, limit).expect("it is ours");
        };
        limit(Some(300));
        session.send("3\r");
        session.wait_for("[no backup]");
        assert_eq!(place.kept_texts(), [edited()], "the last text is kept");
        limit(None);
        if signal == Signal::KILL {
            wait_until_gone(&mut session, "[no backup]");
        }
        kill(session.process_id(), signal);
        session.end();
        assert_eq!(place.kept_texts(), [BALLS.replacen(".80", "3", 1)]);
    }
}

#[test]
fn edits_of_a_new_scene_without_a_file_are_offered_in_a_new_scene() {
    let place = Place::new();
    let mut session = place.start(&[], WIDE);
    session.wait_for("(no file)");
    session.send(":new\r");
    session.wait_for("a new scene: :w FILE writes it");
    session.send("\rj0.75\r");
    session.wait_for("[+]");
    // The file is there before what it holds.
    while place.kept_texts().is_empty() {
        session.drain(Duration::from_millis(1));
    }
    kill(session.process_id(), Signal::KILL);
    session.end();
    let mut session = place.start(&[], WIDE);
    session.wait_for("a new scene: :w FILE writes it");
    session.wait_for(QUESTION);
    session.wait_for("Restore them?");
    session.send("r");
    session.wait_for("restored");
    session.send(":q!\r");
    assert_end(session, 0);
}
