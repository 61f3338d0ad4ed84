//! Exporting the track that is played.

use super::playing::playing;
use super::scripts::{half_way, ray, scripts};
use super::*;

scripts! {
    /// Neither the scene nor its track is ever replaced.
    all_frames_of_the_text_without_a_frame_are_exported: {
        playing().table(r"
            {1} | does film {2} kept sparing scene.ray scene.toml: 9 frames {3} | writes opened | mode SEQUENCE
            @exported 1
        ", r"
            lllb                                   | scene.gif  | as Gif
            :export<Enter>                         | scene.gif  | as Gif
            G:export a b.y4m<Enter>                | a b.y4m    | as Y4m
            :export a.%03d.png 32x8 2<Enter>       | a.%03d.png | of 32x8 with 2 spp as Png pictures
        ");
        playing().play("lll:export! a.gif<Enter> | frame 3 | not text opened");
    };

    what_no_sequence_can_be_written_to_is_refused_with_the_way_out: {
        playing().table(r"
            ll:export {1}<Enter> | not does film | not exporting | mode SEQUENCE | frame 2
            | says {1} has {2}; to export this frame alone, press Enter first
        ", r"
            a.png   | no placeholder for the frame number: use a name such as out.%05d.png, or .y4m or .gif
            a%s.png | a % that does not begin %d or, with a least number of digits, %01d to %09d
            %d/a.png | %d in the name of a folder: only the file name can have it, such as out.%05d.png
        ");
        ray().table(r"
            :export {1}<Enter> | not exporting | says {1} names a sequence: press T, then :export
        ", r"
            a.%03d.png
            a%d.bmp
            a.y4m
        ");
    };

    progress_covers_all_frames_and_the_end_is_said: {
        playing().play(r"
            :export a.gif 32x8 2<Enter> | says exporting to a.gif
            @filmed 4                   | done 0.5
            @exported 1                 | says wrote a.gif: 9 frames, 32×8, 2 spp | not exporting
        ");
        assert_eq!([0, 4, 8].map(|frame| half_way(frame).place()), ["1/9", "5/9", "9/9"]);
    };

    a_sequence_is_cancelled_where_it_is_played: playing().table(r"
        l:export {1}<Enter>
        @filmed 4
        {2} | does stop export | says export cancelled{3} | mode SEQUENCE | not exporting
    ", r"
        a.gif   | x                     |
        a.gif   | :export cancel<Enter> |
        a%d.png | x                     | ; the frames already written are kept
    ");

    files_that_others_wrote_are_asked_about: playing().play(r"
        b
        @taken 1
        y           | does film scene.gif overwritten
        @exported 2

        :export scene.gif<Enter>
        @taken 1    | says scene.gif exists | not asks
    ");

    /// A command that fails leaves the mode, the frame, and whatever it would have changed.
    a_failed_command_leaves_the_frame_that_is_looked_at: {
        playing().table(r"
            lll<Space>
            @note before text
            :{1}<Enter> | fault | mode SEQUENCE | frame 3 | plays | text before | not region
        ", r"
            size 0x0
            set depth many
            mesh
            mesh a.obj
            view light
            region 9999,0,1,1
            export a.txt
            nonsense
            e a.txt
        ");
        // Elsewhere too.
        ray().play("e:mesh a.obj<Enter> | mode EDIT");
    };

    /// The open one says no more than that it cannot be read either.
    a_track_that_cannot_be_played_leaves_the_open_one_watched: playing().table(r"
        ll:track other.toml<Enter>
        @track other.toml: {1} | does track scene.toml | mode SEQUENCE | frame 2
        @track missing         | not does track
    ", r#"
        "frames = = 2"
        "frames = 2\n[[track]]\nthing = 'x'\nfield = 'y'\nkeys = []\n"
        broken
    "#);
}

#[test]
fn pictures_of_the_session_are_known() {
    let place = tempfile::tempdir().expect("a folder");
    let path = place.path().join("a0.png");
    std::fs::write(&path, "").expect("the folder is new");
    let version = Version::of(&path).expect("a file");
    let mut session = playing().session();
    session.run(":export a%d.png<Enter>");
    session.app.update(Msg::FrameExported(Exported {
        path: path.clone(),
        version: Some(version),
    }));
    session.run("@exported\n:export a%d.png<Enter> | does film");
    let again = session.effects.iter().find_map(|effect| match effect {
        Effect::Film(_, reel, _) => Some(reel),
        _ => None,
    });
    let again = again.expect("it is exported again");
    assert_eq!(again.written.get(&path), Some(&version));
}
