//! Playing a track: frames in the text, and values keyed in the track.

use super::scripts::{Stage, listed, ray, scripts};
use super::*;

/// The lamp of [`SCENE`] rises from 5 to 13 in eight frames.
const TRACK: &str = "\
frames = 9
fps = 10

[[track]]
thing = 'the light'
field = 'position y'
keys = [{ frame = 0, value = 5 }, { frame = 8, value = 13 }] # up
";

/// The stage of the scene with the track, at its first frame.
pub(crate) fn playing<'s>() -> Stage<'s> {
    ray().with("track", TRACK).after(
        "ggj
        :track<Enter> | does only track scene.toml
        @track track  | mode SEQUENCE | not says",
    )
}

scripts! {
    frames_are_in_the_text_while_they_are_looked_at: playing().table(r"
        {1}   | frame {2} | line 3 {3}
        <Esc> | mode SELECT | text opened | not undoable
    ", r"
        l          | 1 | 5 6 5 // the light
        llh        | 1 | 5 6 5 // the light
        h          | 0 | 5 5 5 // the light
        L          | 8 | 5 13 5 // the light
        Gl         | 8 | 5 13 5 // the light
        GH         | 0 | 5 5 5 // the light
        ]          | 8 | 5 13 5 // the light
        G[         | 0 | 5 5 5 // the light
        <Right>Ggg | 0 | 5 5 5 // the light
    ");

    a_frame_is_kept_as_one_step: playing().table(r"
        lll{1} | mode {2} | lines 5 8 5 // the light | undoable frame 3 of scene.toml
        u      | text opened
    ", r"
        <Enter> | SELECT
        e       | EDIT
        v       | VIEW
    ");

    frames_follow_each_other_as_they_are_seen_and_start_over: {
        let mut session = playing().session();
        session.run("GH\n@started preview 1\n@frame preview 1\n<Space>");
        for generation in 2..11 {
            let frame = (generation - 1) % 9;
            session.run(&format!(r"
                @elapsed frame                | does wait frame | frame {frame}
                @started preview {generation}
                // Nothing is seen of it yet.
                @elapsed frame                | does wait frame | frame {frame}
                @frame preview {generation}
            "));
        }
        session.run(r"
            <Space>
            @elapsed frame | not does wait frame | frame 0
        ");
    };

    present_values_are_keyed_at_the_frame_looked_at_last: playing().play(r"
        llll<Esc>ggj
        // The lamp, its position, y.
        jj<Enter><Tab>20<Enter>
        I | does only write track scene.toml | over track
        | writes track & , { => , { frame = 4, value = 20 }, {
        @key       | says the light position y keyed at frame 4 in scene.toml
        // The watcher notices the file just written.
        @track key | not does
        T
        @track key | frame 4 | line 3 5 20 5 // the light
        h          | line 3 5 16.25 5 // the light
        u          | does write track | writes track
    ");

    a_key_written_late_does_not_change_another_track: playing().play(r"
        <Esc>ggjjj<Enter>I
        :track other.toml<Enter>
        @track other.toml: track & 13 => 21
        @key
        G | mode SEQUENCE | line 3 5 21 5 // the light
    ");

    the_first_key_creates_a_new_track: ray().play(r#"
        :track swing.toml<Enter>
        @track swing.toml: none | says swing.toml is new: e edits at this frame, then I keys the value
        <Esc>
        ggjv+I | does once write track | over ""
        | writes frames = 48\nfps = 24\n\n[camera]\nkeys = [{ frame = 0, eye = […
    "#);

    nothing_is_lost_when_files_change_meanwhile: playing().play(r"
        // The scene is merged without the frame, which is then shown in the new text.
        ll
        @changed    | text opened
        @file 1.5 // => 2.5 //   | mode SEQUENCE | line 3 5 7 5 // the light
        <Esc>       | text file | not dirty

        // The track is read again; one with errors is not taken, nor its absence.
        l
        @track none | line 3 5 6 5 // the light
        @track track & 13 => 21  | line 3 5 7 5 // the light
        @track track & 13 => 'x' | says scene.toml:7:56: light 1 position: is a word: expected a number
        | mode SEQUENCE | line 3 5 7 5 // the light
        // A key is not written over changes.
        <Esc>ggjjj<Enter>I
        @key refused | does track scene.toml
    ");

    a_file_that_settles_is_compared_with_the_text_without_the_frame: playing().with("broken", "1 1").play(r"
        ll
        @changed         | text opened
        @file broken     | mode SEQUENCE | line 3 5 7 5 // the light
        @elapsed settled | does read      | text opened
        @file opened
        // So is a reading that arrives while another frame is shown.
        @changed         | text opened
        @reading 1.5 // => 2.5 //
        l                | line 3 5 8 5 // the light
        @arrives         | does read      | text opened
    ");

    frames_are_never_saved_or_kept_unasked: {
        playing().table(r"
            lll{1} | {2} quit | not does keep edits | text …5 5 5 // the light…
        ", r"
            q               | does
            :q<Enter>       | does
            :w<Enter>       | not does
            :size 8x6<Enter> | not does
            <Ctrl-c>        | does
        ");
        playing().play(r"
            lll
            @elapsed keep | does only wait keep
            @hangup | does quit | text opened
        ");
        // Edits before the frames are kept without them.
        playing().play(r"
            <Esc>ggjelT
            @note edited text
            @track track | mode SEQUENCE | does keep edits of scene.ray | writes edited
            l            | not does wait keep
        ");
    };

    the_mouse_goes_to_the_frame_under_the_pointer: {
        let mut session = playing().session();
        let sheet = DopeSheet::new(session.app.shared.areas().fields, 8);
        for frame in [8, 4, 0] {
            let (x, y) = (sheet.frames.x + sheet.column(frame), sheet.frames.y);
            session.run(&format!("@down screen {x},{y} | frame {frame} | mode SEQUENCE"));
        }
        let first = (sheet.frames.x, sheet.frames.y);
        session.run(&format!(
            "<Space>\n@elapsed frame | does wait frame\n@down screen {},{}\n@elapsed frame | not does wait frame",
            first.0, first.1
        ));
        session.run("@down list 1,2 | mode SELECT | text opened");
    };

    what_cannot_be_played_says_why: {
        ray().each(r"
            :track a.txt<Enter> | says a.txt: the name of a track ends in .toml
            jj<Enter>I          | says no track is open: T opens or starts one
        ");
        listed("1 1").play(":track<Enter> | says no picture: the scene has errors; press ! to list them");
        ray().with("track", TRACK).play(r"
            T
            @track track & the light => the lihgt | mode SELECT | text opened
            | says scene.toml:5:9: nothing in the scene is called `the lihgt`: expected render, view, ambient, light 1, object 1 or object 2
        ");
    };

    what_was_said_of_a_track_goes_once_it_can_be_read: playing().table(r"
        @track {1} | shown scene.toml:…
        @track {2} | not shown scene.toml:…
    ", r"
        folder                         | track
        folder                         | none
        track & 13 => 'x'              | track
        track & 13 => 'x'              | none
        track & the light => the lihgt | track
        track & the light => the lihgt | none
    ");

    /// Also of one that was never open, by its own change, by one of the scene, or when that is left.
    what_was_said_of_a_track_that_is_not_open_goes_with_its_cause: {
        ray().with("track", TRACK).table(r"
            T
            @track track & 13 => 'x'  | shown scene.toml:…
            @track-changed            | does track scene.toml
            @track {1}                | not shown scene.toml:…
        ", r"
            track
            none
        ");
        ray().with("track", TRACK).play(r"
            T
            @track track & the light => the lihgt | shown scene.toml:…
            @file 1.5 => 1.7          | does track scene.toml
        ");
    };

    /// What is read of a track that is being written may be half of that.
    nothing_that_is_read_of_a_track_during_a_save_is_taken: playing().play(r"
        <Esc>ggjjj<Enter>I
        @track-changed          | not does
        @track track & 13 => 21
        @key                    | does track scene.toml | held {key}
    ");
}
