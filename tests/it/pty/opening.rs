//! Files that take long to read, and files that cannot be read.

use std::io::Write;

use super::*;

/// Opens a scene so long that the screen appears before it is read.
fn open_long(place: &Place) -> Session {
    let mut file = fs::File::create(place.at("long.ray")).expect("a file");
    // Begins like a text; the rest is a hole, which takes no space on the disk.
    file.write_all(&[b'\n'; 1 << 14]).expect("written");
    file.set_len(1 << 31).expect("a sparse file");
    let mut session = place.start(&["long.ray"], WIDE);
    session.wait_for("opening long.ray, 2.1 GB");
    session
}

#[test]
fn keys_are_answered_while_a_scene_is_read() {
    let place = Place::new();
    let mut session = open_long(&place);
    session.send("w");
    session.wait_for("still opening long.ray");
    session.send("?");
    session.wait_for(" Keys ");
    session.send(ESC);
    wait_until_gone(&mut session, " Keys ");
    quit(session);
}

#[test]
fn signals_end_the_program_while_a_scene_is_read() {
    for (signal, code) in [(Signal::INT, 130), (Signal::TERM, 143), (Signal::HUP, 129)] {
        let place = Place::new();
        let session = open_long(&place);
        kill(session.process_id(), signal);
        assert_end(session, code);
    }
}

#[test]
fn an_unreadable_scene_ends_the_program_with_its_exit_code() {
    let place = Place::new();
    fs::write(place.at("latin.ray"), b"// caf\xe9\n").expect("written");
    for (name, code, words) in [
        (
            "latin.ray",
            65,
            "latin.ray:1:7: the byte 0xE9 is not UTF-8 text",
        ),
        ("none/a.ray", 66, "no such file"),
        (".", 66, "it is a folder"),
    ] {
        let mut session = place.start(&[name], WIDE);
        let status = session.end();
        assert!(
            session.text().contains(words),
            "{name}:\n{}",
            session.text()
        );
        assert_eq!(status.code(), Some(code), "{name}");
        // Reading may have taken so long that the screen was entered.
        let is_entered = last(ENTER_SCREEN, &session.written).is_some();
        assert!(!is_entered || name == "latin.ray", "{name}");
        session.assert_restored();
    }
}

#[test]
fn a_new_scene_is_written_left_for_another_and_remembered() {
    let place = Place::new();
    let mut session = place.start(&["new.dat"], WIDE);
    session.wait_for("new.dat is new: w writes it");
    assert!(!place.at("new.dat").exists());
    session.send("w");
    session.wait_for("wrote new.dat");
    let template = place.read("new.dat");
    assert!(template.starts_with("# A new scene."), "{template}");
    session.send(":e balls.ray\r");
    session.wait_for("sphere");
    session.wait_for("balls.ray");
    session.send(":e none/a.ray\r");
    session.wait_for("none/a.ray: no such file");
    place.replace(
        "balls.ray",
        &BALLS.replace("8.0", "7.0").replace("0.8 ", "0.9 "),
    );
    session.wait_for("reloaded: object 2 (sphere) radius");
    quit(session);

    let mut session = place.start(&[], WIDE);
    session.wait_for("Recent scenes");
    session.wait_for("new.dat");
    session.send("\r");
    session.wait_for("the red one");
    quit(session);
}
