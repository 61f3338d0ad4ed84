//! Exporting the track that is played.

use super::pictures::frame;
use super::playing::playing;
use super::*;
use crate::file::ReadError;
use crate::image_file::{ImageFormat, MovieFormat};
use crate::render::Progress;
use crate::scene::Size;
use crate::text::Severity;
use crate::ui::msg::{Destination, Existing};
use crate::ui::reel::{Reel, ReelForm, ReelProgress};

/// The export of a sequence that effects start.
fn film(effects: &[Effect]) -> Option<(ExportId, &Reel, &Destination)> {
    effects.iter().find_map(|effect| match effect {
        Effect::Film(id, reel, to) => Some((*id, &**reel, to)),
        _ => None,
    })
}

/// How far the export is at a frame that is half traced.
fn at(number: u32) -> ReelProgress {
    let traced = Progress {
        done: 0.5,
        ..frame(SIZE, vec![0; SIZE.pixels()]).progress
    };
    ReelProgress {
        frame: number,
        count: 9,
        traced,
    }
}

const SIZE: Size = Size {
    width: 32,
    height: 8,
};

#[test]
fn all_frames_of_the_text_without_a_frame_are_exported() {
    for (keys, path, is_each, size, spp) in [
        ("lllb", "scene.gif", false, None, None),
        (":export<Enter>", "scene.gif", false, None, None),
        ("G:export a b.y4m<Enter>", "a b.y4m", false, None, None),
        (
            ":export a.%03d.png 32x8 2<Enter>",
            "a.%03d.png",
            true,
            Some(SIZE),
            Some(2),
        ),
    ] {
        let mut app = playing();
        let effects = press(&mut app, keys);
        let (id, reel, to) = film(&effects).expect("it is exported");
        assert_eq!((id, &*to.path), (ExportId(1), Path::new(path)), "{keys}");
        assert_eq!((&**reel.text, reel.track.frames), (SCENE, 9), "{keys}");
        assert_eq!((reel.shot.size, reel.shot.spp), (size, spp), "{keys}");
        let is_pictures =
            matches!(&reel.form, ReelForm::Pictures(_, format) if *format == ImageFormat::Png);
        let is_movie = matches!(
            reel.form,
            ReelForm::Movie(MovieFormat::Gif | MovieFormat::Y4m)
        );
        assert_eq!((is_pictures, is_movie), (is_each, !is_each), "{keys}");
        // Neither the scene nor its track is ever replaced.
        assert_eq!(to.scene.as_deref(), Some(Path::new("scene.ray")));
        assert!(to.named.contains(&PathBuf::from("scene.toml")), "{keys}");
        assert_eq!(to.existing, Existing::Kept);
        assert_eq!(app.mode, Mode::Sequence, "{keys}");
    }
    let mut app = playing();
    press(&mut app, "lll:export! a.gif<Enter>");
    let open = app.sequence.open.as_ref().expect("a track");
    assert_eq!((open.frame, app.document.text() == SCENE), (3, false));
}

#[test]
fn what_no_sequence_can_be_written_to_is_refused_with_the_way_out() {
    let keep = "; to export this frame alone, press Enter first";
    for (typed, reason) in [
        (
            "a.png",
            "a.png has no placeholder for the frame number: use a name such as out.%05d.png, or .y4m or \
             .gif",
        ),
        (
            "a%s.png",
            "a%s.png has a % that does not begin %d or, with a least number of digits, %01d to %09d",
        ),
        (
            "%d/a.png",
            "%d/a.png has %d in the name of a folder: only the file name can have it, such as \
             out.%05d.png",
        ),
    ] {
        let mut app = playing();
        let effects = press(&mut app, &format!("ll:export {typed}<Enter>"));
        assert!(film(&effects).is_none() && app.jobs.export.is_none());
        assert_eq!(words(&app), format!("{reason}{keep}"));
        let open = app.sequence.open.as_ref().expect("a track");
        assert_eq!((app.mode, open.frame), (Mode::Sequence, 2));
    }
    for typed in ["a.%03d.png", "a%d.bmp", "a.y4m"] {
        let mut app = open(SCENE);
        press(&mut app, &format!(":export {typed}<Enter>"));
        assert!(app.jobs.export.is_none());
        let expected = format!("{typed} names a sequence: press T, then :export");
        assert_eq!(words(&app), expected);
    }
}

#[test]
fn progress_covers_all_frames_and_the_end_is_said() {
    let mut app = playing();
    press(&mut app, ":export a.gif 32x8 2<Enter>");
    assert_eq!(words(&app), "exporting to a.gif");
    app.update(Msg::Filmed(ExportId(1), at(4)));
    let export = app.jobs.export.as_ref().expect("it goes on");
    assert!((export.done() - 0.5).abs() < 1e-9);
    let place = |number| at(number).place();
    assert_eq!([0, 4, 8].map(place), ["1/9", "5/9", "9/9"]);
    app.update(exported(ExportId(1), "a.gif", None));
    assert_eq!(words(&app), "wrote a.gif: 9 frames, 32×8, 2 spp");
    assert!(app.jobs.export.is_none());
}

#[test]
fn a_sequence_is_cancelled_where_it_is_played() {
    for (path, keys, said) in [
        ("a.gif", "x", "export cancelled"),
        ("a.gif", ":export cancel<Enter>", "export cancelled"),
        (
            "a%d.png",
            "x",
            "export cancelled; the frames already written are kept",
        ),
    ] {
        let mut app = playing();
        press(&mut app, &format!("l:export {path}<Enter>"));
        app.update(Msg::Filmed(ExportId(1), at(4)));
        let effects = press(&mut app, keys);
        let stops = |effect: &Effect| matches!(effect, Effect::Stop(Target::Export));
        assert!(wants(&effects, stops), "{keys}");
        assert_eq!((words(&app), app.mode), (said, Mode::Sequence));
        assert!(app.jobs.export.is_none());
    }
}

#[test]
fn files_that_others_wrote_are_asked_about_and_those_of_the_session_are_known() {
    let taken = |id| Msg::Taken(ExportId(id), "scene.gif exists".into());
    let mut app = playing();
    press(&mut app, "b");
    app.update(taken(1));
    let effects = press(&mut app, "y");
    let (id, _, to) = film(&effects).expect("it is exported after all");
    assert_eq!((id, to.existing), (ExportId(2), Existing::Overwritten));
    let mut app = playing();
    press(&mut app, ":export scene.gif<Enter>");
    app.update(taken(1));
    assert_eq!(words(&app), "scene.gif exists");
    assert!(app.overlays.dialog.is_none());

    let place = tempfile::tempdir().expect("a folder");
    let path = place.path().join("a0.png");
    std::fs::write(&path, "").expect("the folder is new");
    let version = Version::of(&path).expect("a file");
    press(&mut app, ":export a%d.png<Enter>");
    app.update(Msg::FrameExported(Exported {
        path: path.clone(),
        version: Some(version),
    }));
    app.update(exported(ExportId(2), "a%d.png", None));
    let effects = press(&mut app, ":export a%d.png<Enter>");
    let (_, reel, _) = film(&effects).expect("it is exported again");
    assert_eq!(reel.written.get(&path), Some(&version));
}

/// A command that fails leaves the mode, the frame, and whatever it would have changed.
#[test]
fn a_failed_command_leaves_the_frame_that_is_looked_at() {
    for command in [
        "compare",
        "size 0x0",
        "set depth many",
        "mesh",
        "mesh a.obj",
        "view light",
        "region 9999,0,1,1",
        "export a.txt",
        "nonsense",
        "e a.txt",
    ] {
        let mut app = playing();
        press(&mut app, "lll ");
        let before = app.document.shared_text();
        press(&mut app, &format!(":{command}<Enter>"));
        let severity = app
            .overlays
            .message
            .as_ref()
            .and_then(|message| message.severity);
        assert_eq!(
            severity,
            Some(Severity::Error),
            "{command}: {}",
            words(&app)
        );
        let open = app.sequence.open.as_ref().expect("a track");
        let now = (app.mode, open.frame, open.is_playing);
        assert_eq!(now, (Mode::Sequence, 3, true), "{command}");
        assert_eq!(app.document.text(), &**before, "{command}");
        assert_eq!(app.pictures.region, None, "{command}");
    }
    // Elsewhere too.
    let mut app = open(SCENE);
    press(&mut app, "e:mesh a.obj<Enter>");
    assert_eq!(app.mode, Mode::Edit, "{}", words(&app));
}

#[test]
fn a_track_that_cannot_be_played_leaves_the_open_one_watched() {
    let other = || PathBuf::from("other.toml");
    for read in [
        Ok(Some("frames = = 2".to_owned())),
        Ok(Some(
            "frames = 2\n[[track]]\nthing = 'x'\nfield = 'y'\nkeys = []\n".to_owned(),
        )),
        Err(ReadError::Io {
            path: other(),
            source: std::io::Error::other("broken"),
        }),
    ] {
        let mut app = playing();
        press(&mut app, "ll:track other.toml<Enter>");
        let effects = app.update(Msg::TrackRead(other(), read));
        let again = |effect: &Effect| matches!(effect, Effect::ReadTrack(path) if path == Path::new("scene.toml"));
        assert!(wants(&effects, again), "{effects:?}");
        let open = app.sequence.open.as_ref().expect("a track");
        assert_eq!((app.mode, open.frame), (Mode::Sequence, 2));
        // The open one says no more than that it cannot be read either.
        let failed = Err(ReadError::NotFound {
            path: PathBuf::from("scene.toml"),
        });
        let effects = app.update(Msg::TrackRead(PathBuf::from("scene.toml"), failed));
        assert!(!wants(&effects, |effect| matches!(
            effect,
            Effect::ReadTrack(_)
        )));
    }
}
