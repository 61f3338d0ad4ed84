//! Playing a track: frames in the text, and values keyed in the track.

use std::sync::Arc;

use super::moving::click;
use super::pictures::frame;
use super::*;
use crate::file::ReadError;
use crate::scene::Size;
use crate::ui::msg::{Guard, SaveOutcome, Target, Timer};

/// The lamp of [`SCENE`] rises from 5 to 13 in eight frames.
const TRACK: &str = "\
frames = 9
fps = 10

[[track]]
thing = 'the light'
field = 'position y'
keys = [{ frame = 0, value = 5 }, { frame = 8, value = 13 }] # up
";

/// Delivers the text of the track beside the scene, or its absence.
fn track(app: &mut App, text: Option<&str>) -> Vec<Effect> {
    let path = PathBuf::from("scene.toml");
    app.update(Msg::TrackRead(path, Ok(text.map(str::to_owned))))
}

/// Opens the scene with the track, at its first frame.
pub(super) fn playing() -> App {
    let mut app = open(SCENE);
    let effects = press(&mut app, ":track<Enter>");
    let path = PathBuf::from("scene.toml");
    assert!(matches!(&effects[..], [Effect::ReadTrack(asked)] if *asked == path));
    track(&mut app, Some(TRACK));
    assert_eq!((app.mode, words(&app)), (Mode::Sequence, ""));
    app
}

/// The line of the lamp's position.
fn lamp(app: &App) -> &str {
    app.document.text().lines().nth(2).expect("a line")
}

fn number(app: &App) -> u32 {
    app.sequence.open.as_ref().expect("a track").frame
}

#[test]
fn frames_are_in_the_text_while_they_are_looked_at() {
    for (said, frame, position) in [
        ("l", 1, "5 6 5 // the light"),
        ("llh", 1, "5 6 5 // the light"),
        ("h", 0, "5 5 5 // the light"),
        ("L", 8, "5 13 5 // the light"),
        ("GH", 0, "5 5 5 // the light"),
        ("]", 8, "5 13 5 // the light"),
        ("G[", 0, "5 5 5 // the light"),
        ("<Right>Ggg", 0, "5 5 5 // the light"),
    ] {
        let mut app = playing();
        press(&mut app, said);
        assert_eq!((number(&app), lamp(&app)), (frame, position), "{said}");
        press(&mut app, "<Esc>");
        assert_eq!(
            (app.mode, app.document.text()),
            (Mode::Select, SCENE),
            "{said}"
        );
        assert!(app.document.undoable().is_none(), "{said}");
    }
}

#[test]
fn a_frame_is_kept_as_one_step() {
    for (end, mode) in [
        ("<Enter>", Mode::Select),
        ("e", Mode::Edit),
        ("v", Mode::View),
    ] {
        let mut app = playing();
        press(&mut app, &format!("lll{end}"));
        assert_eq!(
            (app.mode, changed_lines(&app).join("|")),
            (mode, "5 8 5 // the light".to_owned())
        );
        let step = app.document.undoable().map(ToString::to_string);
        assert_eq!(step.as_deref(), Some("frame 3 of scene.toml"));
        press(&mut app, "u");
        assert_eq!(app.document.text(), SCENE);
    }
}

/// Elapses a frame's time; returns whether the next is awaited.
fn tick(app: &mut App) -> bool {
    let effects = app.update(Msg::Elapsed(Timer::Frame));
    wants(&effects, |effect| {
        matches!(effect, Effect::Later(_, Timer::Frame))
    })
}

/// Shows something of the preview requested last.
fn show(app: &mut App, generation: u64) {
    app.update(Msg::Started(Target::Preview, generation));
    let size = Size {
        width: 4,
        height: 3,
    };
    let mut shown = frame(size, vec![0; 12]);
    shown.generation = generation;
    app.update(Msg::Frame(Target::Preview, Arc::new(shown)));
}

#[test]
fn frames_follow_each_other_as_they_are_seen_and_start_over() {
    let mut app = playing();
    press(&mut app, "GH");
    show(&mut app, 1);
    press(&mut app, " ");
    for generation in 2..11 {
        assert!(tick(&mut app));
        assert_eq!(number(&app), (generation - 1) as u32 % 9);
        app.update(Msg::Started(Target::Preview, generation));
        // Nothing is seen of it yet.
        assert!(tick(&mut app));
        assert_eq!(number(&app), (generation - 1) as u32 % 9);
        show(&mut app, generation);
    }
    press(&mut app, " ");
    assert!(!tick(&mut app));
    assert_eq!(number(&app), 0);
}

#[test]
fn present_values_are_keyed_at_the_frame_looked_at_last() {
    let mut app = playing();
    press(&mut app, "llll<Esc>ggj");
    // The lamp, its position, y.
    press(&mut app, "jj<Enter><Tab>");
    press(&mut app, "20<Enter>");
    let effects = press(&mut app, "I");
    let [Effect::WriteTrack { path, text, guard }] = &effects[..] else {
        panic!("{effects:?}: {}", words(&app));
    };
    let expected = TRACK.replace(", {", ", { frame = 4, value = 20 }, {");
    assert_eq!(
        (path, text.as_str()),
        (&PathBuf::from("scene.toml"), expected.as_str())
    );
    assert_eq!(*guard, Guard::Holding(Arc::new(TRACK.to_owned())));
    let (path, text) = (path.clone(), Arc::clone(text));
    app.update(Msg::TrackWritten(SaveOutcome::Saved { path, text }));
    assert_eq!(
        words(&app),
        "the light position y keyed at frame 4 in scene.toml"
    );
    // The watcher notices the file just written.
    assert!(track(&mut app, Some(&expected)).is_empty());
    press(&mut app, "T");
    track(&mut app, Some(&expected));
    assert_eq!((number(&app), lamp(&app)), (4, "5 20 5 // the light"));
    press(&mut app, "h");
    assert_eq!(lamp(&app), "5 16.25 5 // the light");
    let effects = press(&mut app, "u");
    let taken_back =
        |effect: &Effect| matches!(effect, Effect::WriteTrack { text, .. } if **text == TRACK);
    assert!(effects.iter().any(taken_back), "{effects:?}");
}

#[test]
fn a_key_written_late_does_not_change_another_track() {
    let mut app = playing();
    press(&mut app, "<Esc>ggjjj<Enter>I");
    press(&mut app, ":track other.toml<Enter>");
    let other = TRACK.replace("13", "21");
    app.update(Msg::TrackRead(PathBuf::from("other.toml"), Ok(Some(other))));
    app.update(Msg::TrackWritten(SaveOutcome::Saved {
        path: PathBuf::from("scene.toml"),
        text: Arc::default(),
    }));
    press(&mut app, "G");
    assert_eq!(
        (app.mode, lamp(&app)),
        (Mode::Sequence, "5 21 5 // the light")
    );
}

#[test]
fn the_first_key_creates_a_new_track() {
    let mut app = open(SCENE);
    press(&mut app, ":track swing.toml<Enter>");
    app.update(Msg::TrackRead(PathBuf::from("swing.toml"), Ok(None)));
    assert_eq!(
        words(&app),
        "swing.toml is new: e edits at this frame, then I keys the value"
    );
    press(&mut app, "<Esc>");
    let mut effects = press(&mut app, "ggjv+I");
    effects.retain(|effect| !matches!(effect, Effect::Trace(..)));
    let [Effect::WriteTrack { text, guard, .. }] = &effects[..] else {
        panic!("{effects:?}: {}", words(&app));
    };
    assert_eq!(*guard, Guard::Holding(Arc::default()));
    let lines: Vec<_> = text.lines().collect();
    assert_eq!(lines[..4], ["frames = 48", "fps = 24", "", "[camera]"]);
    assert!(
        lines[4].starts_with("keys = [{ frame = 0, eye = ["),
        "{text}"
    );
}

#[test]
fn nothing_is_lost_when_files_change_meanwhile() {
    // The scene is merged without the frame, which is then shown in the new text.
    let mut app = playing();
    press(&mut app, "ll");
    app.update(Msg::FileChanged);
    assert_eq!(app.document.text(), SCENE);
    let changed = SCENE.replace("1.5 // the radius", "2.5 // the radius");
    outside(&mut app, &changed);
    assert_eq!(app.mode, Mode::Sequence);
    assert_eq!(lamp(&app), "5 7 5 // the light");
    press(&mut app, "<Esc>");
    assert_eq!(app.document.text(), changed);
    assert!(!app.document.is_dirty());

    // The track is read again; one with errors is not taken, nor its absence.
    let mut app = playing();
    press(&mut app, "l");
    track(&mut app, None);
    assert_eq!(lamp(&app), "5 6 5 // the light");
    track(&mut app, Some(&TRACK.replace("13", "21")));
    assert_eq!(lamp(&app), "5 7 5 // the light");
    track(&mut app, Some(&TRACK.replace("13", "'x'")));
    assert_eq!(
        words(&app),
        "scene.toml:7:56: light 1 position: is a word: expected a number"
    );
    assert_eq!(
        (app.mode, lamp(&app)),
        (Mode::Sequence, "5 7 5 // the light")
    );

    // A key is not written over changes.
    press(&mut app, "<Esc>ggjjj<Enter>I");
    let effects = app.update(Msg::TrackWritten(SaveOutcome::ChangedOnDisk));
    assert!(wants(&effects, |effect| matches!(
        effect,
        Effect::ReadTrack(_)
    )));
}

#[test]
fn frames_are_never_saved_or_kept_unasked() {
    for (said, quits) in [
        ("q", true),
        (":q<Enter>", true),
        (":w<Enter>", false),
        (":size 8x6<Enter>", false),
        ("<Ctrl-c>", true),
    ] {
        let mut app = playing();
        let effects = press(&mut app, &format!("lll{said}"));
        let writes = |effect: &Effect| matches!(effect, Effect::WriteRecovery { .. });
        assert!(!wants(&effects, writes), "{said}");
        assert_eq!(
            wants(&effects, |effect| matches!(effect, Effect::Quit)),
            quits,
            "{said}"
        );
        assert!(app.document.text().contains("5 5 5 // the light"), "{said}");
    }
    let mut app = playing();
    press(&mut app, "lll");
    assert!(wants(&app.update(Msg::HangUp), |effect| matches!(
        effect,
        Effect::Quit
    )));
    assert_eq!(app.document.text(), SCENE);
}

#[test]
fn the_mouse_goes_to_the_frame_under_the_pointer() {
    let mut app = playing();
    let area = app.areas().fields;
    let sheet = DopeSheet::new(area, 8);
    for frame in [8, 4, 0] {
        let at = (sheet.frames.x + sheet.column(frame), sheet.frames.y);
        click(&mut app, at.0, at.1);
        assert_eq!((number(&app), app.mode), (frame, Mode::Sequence));
    }
    let list = app.areas().list;
    click(&mut app, list.x + 1, list.y + 2);
    assert_eq!((app.mode, app.document.text()), (Mode::Select, SCENE));
}

#[test]
fn what_cannot_be_played_says_why() {
    for (scene, said, expected) in [
        (
            SCENE,
            ":track a.txt<Enter>",
            "a.txt: the name of a track ends in .toml",
        ),
        (
            SCENE,
            "jj<Enter>I",
            "no track is open: T opens or starts one",
        ),
        (
            "1 1",
            ":track<Enter>",
            "no picture: the scene has errors; press ! to list them",
        ),
    ] {
        let mut app = open(scene);
        press(&mut app, said);
        assert_eq!(words(&app), expected, "{said}");
    }
    let mut app = open(SCENE);
    press(&mut app, "T");
    track(&mut app, Some(&TRACK.replace("the light", "the lihgt")));
    assert_eq!(
        words(&app),
        "scene.toml:5:9: nothing in the scene is called `the lihgt`: expected render, view, ambient, light 1, \
         object 1 or object 2"
    );
    assert_eq!((app.mode, app.document.text()), (Mode::Select, SCENE));
}

#[test]
fn what_was_said_of_a_track_goes_once_it_can_be_read() {
    let path = || PathBuf::from("scene.toml");
    let folder = |app: &mut App| {
        let kind = "a folder";
        let error = ReadError::NotRegular { path: path(), kind };
        app.update(Msg::TrackRead(path(), Err(error)));
    };
    let wrong = |app: &mut App| {
        track(app, Some(&TRACK.replace("13", "'x'")));
    };
    let foreign = |app: &mut App| {
        track(app, Some(&TRACK.replace("the light", "the lihgt")));
    };
    for break_it in [&folder as &dyn Fn(&mut App), &wrong, &foreign] {
        for held in [Some(TRACK), None] {
            let mut app = playing();
            break_it(&mut app);
            assert!(shown(&app).starts_with("scene.toml:"), "{}", shown(&app));
            track(&mut app, held);
            assert!(!shown(&app).starts_with("scene.toml:"), "{}", shown(&app));
        }
    }
}

/// What is read of a track that is being written may be half of that.
#[test]
fn nothing_that_is_read_of_a_track_during_a_save_is_taken() {
    let mut app = playing();
    press(&mut app, "<Esc>ggjjj<Enter>I");
    let written = app.sequence.writing.clone().expect("a key").0;
    assert!(app.update(Msg::TrackChanged).is_empty());
    track(&mut app, Some(&TRACK.replace("13", "21")));
    let path = PathBuf::from("scene.toml");
    let text = Arc::clone(&written);
    let effects = app.update(Msg::TrackWritten(SaveOutcome::Saved { path, text }));
    assert!(wants(&effects, |effect| matches!(
        effect,
        Effect::ReadTrack(_)
    )));
    let held = app
        .sequence
        .open
        .as_ref()
        .and_then(|open| open.held.clone());
    assert_eq!(held, Some(written));
}
