//! Tracing and exporting.

use super::scripts::{ray, scripts};
use super::*;
use crate::msg::{Existing, Target};

scripts! {
    an_edit_restarts_the_preview_and_a_refused_one_does_not: ray().after("ggjjjj").each(r"
        el   | does once trace preview
        ejHH | does once trace preview
        vh   | does once trace preview
        z    | does once trace preview
        ?    | not does trace preview
    ");

    impossible_commands_are_refused_with_a_reason: ray().table(r"
        :{1}<Enter> | not does | says …{2}…
    ", r"
        export a.webp             | .bmp
        export a.bmp 99999x99999  | 99999x99999
        export a.bmp 70000        | samples
        export a.bmp 10x          | `10x`: expected a size such as 800x600
        export a.bmp 10x 4        | `10x`: expected a size
        export 10x                | `10x`: expected a size
        export a.bmp 99999999999  | 99999999999: samples
        export a.bmp fine         | `fine` is neither
        export cancel             | no export is running
        expoort                   | did you mean export?
        put 8x8                   | Nothing for `put`; nearest:
        size 0x5                  | :size needs WIDTHxHEIGHT, such as 800x600
        size 99999x99999          | 99999x99999: a picture has at most
    ");

    an_export_is_traced_written_and_reported: ray().play(r"
        :export b c.png 32x8 2<Enter> | does only check b c.png kept sparing scene.ray, trace export
        | job size 32x8 camera 32x8 spp 2
        @frame export | does only write b c.png kept sparing scene.ray, stop export, wait
        @exported 1   | not exporting | says wrote b c.png: 32×8, 2 spp
    ");

    the_full_size_trace_continues_in_the_background_until_the_scene_changes: ray().play(r"
        <F5>             | does only recall | job size 800x600 spp 4
        @started full 1
        <Esc>            | not does | mode SELECT
        // It is still under way.
        r                | not does
        @file 1.5 => 1.7 | does only free, trace full
        <Esc>            | does only trace preview
        @file opened     | does stop full
    ");

    /// The picture on screen still has the old object numbers.
    no_object_is_outlined_by_an_outdated_number: {
        let (head, second) = SCENE.split_at(SCENE.rfind("sphere").expect("two of them"));
        let more = format!("{}{second}{second}", head.replace("\n2\n", "\n3\n"));
        ray().with("more", more).play(r"
            @shows 1         | corner 1
            @file 1.5 => 1.7 | corner 1
            @file more       | not errors | not corner
        ");
    };

    exports_of_a_text_with_errors_announce_the_last_valid_scene: ray().table(r#"
        @file twice "x" | errors
        {1}             | says …the last valid scene…
    "#, r"
        b
        <F5>
    ");

    a_file_written_after_its_export_was_cancelled_is_reported_and_stops_no_other: ray().table(r"
        :export a.bmp 32x8<Enter>
        @frame export
        // No picture is traced.
        x   | not does | says …a.bmp is being written…
        :export b.bmp<Enter>
        @read-it
        {1} | not does | exporting b.bmp | {2}
    ", r"
        @exported 1       | says wrote a.bmp anyway
        @unwritten 1 full | not says
    ");

    an_export_ends_with_its_worker: ray().play(r"
        bqw
        @ended export  | not exporting | not leaving | says …stopped early…
        b              | exporting
        @ended preview | not does
    ");

    a_refused_picture_is_no_longer_awaited: ray().play(r"
        bqw
        @cannot export too large | not exporting | not leaving | says too large
        <Esc><F5>
        // Nothing is on its way.
        @cannot full too large   | says too large | not awaited
        <Esc><F5>                | does trace full
    ");

    quitting_asks_about_an_export_and_can_wait_for_it: {
        ray().table(r"
            b
            {1} | not does quit | asks quit
            y   | does quit
        ", r"
            q
            <Ctrl-c>
            :q<Enter>
        ");
        ray().play(r"
            bqn
            @exported       | not does quit

            bqw
            @unwritten full | not does quit | not leaving | says full
        ");
    };

    a_stopped_trace_continues_but_not_a_running_one: ray().table(r"
        <F5>  | does recall
        @started full 1
        {1}   | not does trace full | not does recall
        x     | does halt full | says stopped; press F5 to continue
        {1}   | does trace full
        <Esc> | mode SELECT
    ", r"
        <F5>
        <Esc><F5>
    ");

    a_trace_continues_what_an_earlier_run_left_of_its_text: ray().play(r#"
        <F5>          | does recall | not does recall from | writes opened
        @recalled 37  | says continuing the full-size trace that an earlier run left with 37 spp
        // In this run it continues from its own samples.
        @started full 1
        x<F5>         | does trace full | not does recall
        @recalled unreadable the disk is broken | says the disk is broken

        vl
        <F5>          | does recall from eye

        // The scene is not that of the text.
        @file twice "x" | errors
        <F5>          | does trace full | not does recall
    "#);

    more_samples_of_an_earlier_run_are_continued_once_that_many_are_wanted: ray().play(r"
        <F5>
        @started full 1
        @recalled more 512    | says …:until 512 spp…
        :until 512 spp<Enter> | does only stop full, recall | job spp 512
        :until 600 spp<Enter> | does only trace full
    ");
}

/// Cells may be divided into pixels that are not square.
#[test]
fn every_division_of_cells_frames_the_picture_alike() {
    let mut app = open(SCENE);
    let mut traced = |across, down| {
        let effects = app.update(Msg::Grid { across, down });
        let job = effects.into_iter().find_map(|effect| match effect {
            Effect::Trace(Target::Preview, job) => Some(job),
            _ => None,
        });
        let job = job.expect("the preview is traced");
        (job.settings.size, job.camera)
    };
    let (quadrants, camera) = traced(2, 2);
    for (across, down) in [(2, 3), (2, 4), (1, 2)] {
        let (size, same) = traced(across, down);
        assert_eq!(same, camera, "{across}x{down}");
        assert_eq!(2 * size.width, u32::from(across) * quadrants.width);
    }
}

#[test]
fn only_pictures_of_this_session_are_overwritten_unasked() {
    let place = tempfile::tempdir().expect("a folder");
    let written = Version::of(place.path()).expect("it is there");
    let existing = |app: &mut App, said: &str| {
        let effects = press(app, said);
        let Some(Effect::CheckTarget(id, destination)) = effects.first() else {
            panic!("{effects:?}");
        };
        let (id, destination) = (*id, destination.clone());
        app.update(exported(id, destination.path, Some(written)));
        destination.existing
    };
    let mut app = open(SCENE);
    assert_eq!(existing(&mut app, "b"), Existing::Kept);
    assert_eq!(existing(&mut app, "b"), Existing::Own(written));
    let to_another = ":export a.bmp<Enter>";
    assert_eq!(existing(&mut app, to_another), Existing::Kept);
    assert_eq!(existing(&mut app, to_another), Existing::Own(written));
    let by_force = ":export! c.bmp<Enter>";
    assert_eq!(existing(&mut app, by_force), Existing::Overwritten);
}
