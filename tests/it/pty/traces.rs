//! Full-size traces that continue in the next run.

use super::*;

const F5: &str = "\x1b[15~";

/// Opens the scene and starts a full-size trace without end.
fn trace(place: &Place) -> Session {
    let mut session = place.start(&["balls.ray", "--spp", "65536"], WIDE);
    wait_for_rest(&mut session);
    session.send(F5);
    session.wait_for("TRACE");
    session
}

/// The files of kept traces.
fn kept(place: &Place) -> Vec<PathBuf> {
    let folder = place.at(".local/state/halflight/traces");
    let entries = fs::read_dir(folder).into_iter().flatten();
    entries
        .map(|entry| entry.expect("an entry").path())
        .collect()
}

/// Takes as long as the shortest trace that is kept.
#[test]
fn a_full_size_trace_continues_in_the_next_run() {
    let place = Place::new();
    let mut session = trace(&place);
    // Not the estimate of what is left, nor samples; and seconds are rounded.
    session.wait("waiting for more than ten seconds", |screen| {
        let contents = screen.contents();
        (11..30).any(|seconds| contents.contains(&format!("· {seconds} s ·")))
    });
    session.send("q");
    session.end();
    session.assert_restored();
    let words = session.text();
    assert!(words.contains("the full-size trace is kept ("), "{words}");
    assert!(words.contains(" of 65536 spp); F5 continues it"), "{words}");
    assert_eq!(kept(&place).len(), 1);

    for signal in [Some(Signal::TERM), Some(Signal::HUP), None] {
        let mut session = trace(&place);
        session.wait_for("continuing the full-size trace that an earlier run left with");
        // Its first frame; the message hides the time.
        session.wait_for(" %");
        // It is read: another one is written.
        fs::remove_file(&kept(&place)[0]).expect("it is there");
        match signal {
            Some(signal) => kill(session.process_id(), signal),
            None => session.hang_up(),
        }
        session.end();
        let words = session.text();
        let are_said = words.contains("the full-size trace is kept (");
        assert_eq!(are_said, signal.is_some(), "{words}");
        assert_eq!(kept(&place).len(), 1);
    }

    fs::write(&kept(&place)[0], "halflight part 2\ndamaged").expect("it is ours");
    let mut session = trace(&place);
    session.wait_for("the full-size trace of an earlier run was damaged");
    quit(session);
    assert_eq!(kept(&place), [] as [PathBuf; 0]);
}
