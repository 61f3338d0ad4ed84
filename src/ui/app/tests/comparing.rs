//! Pinning and loading references, and comparing with them.

use super::scripts::{Stage, ray, scripts};
use super::*;
use crate::reference::ReferenceId;
use ::compare::Comparison;
use render::{Frame, Frames};
use scene::{Image, Viewpoint};

/// The stage of a complete preview, whose first pixel has the grey 9.
fn previewed<'s>() -> Stage<'s> {
    ray().after("ggj\n@started preview 1\n@frame preview 1 first 9")
}

/// The stage where no option asks for a render setting.
fn unasked<'s>() -> Stage<'s> {
    ray().opened(|opening| opening.rendering = Rendering::default())
}

const RECORD: &str = "version 1\nscene 0\nview fov 30\nlayers none\ndenoise yes\nsize 8x6\n\
                      region 1,2,3,4\ndepth 2\nseed 7\naov none\nintegrator path\nfilter gaussian\n\
                      transfer srgb\nexposure -1\nfalloff square\nnoise 0.05\nclamp 8\n\
                      gloss exponent\nspp 64\n";

scripts! {
    the_present_picture_is_traced_as_the_pinned_one_was_and_looked_at: {
        let mut session = previewed().session();
        session.run(r"
            A | says pinned the preview, light, 16 spp…
            = | does trace compared | job size {preview} spp 16 | mode COMPARE
            @started compared 7
            @frame compared 7 first 29 | does compare
        ");
        let pair = session.effects.iter().find_map(|effect| match effect {
            Effect::Compare(pair) => Some(pair.clone()),
            _ => None,
        });
        let pair = pair.expect("they are measured");
        let image = |frame: &Frame| Image::new(frame.size, frame.pixels.clone());
        let [live, reference] = [&pair.live, &pair.reference].map(|it| image(it).expect("pixels"));
        let expected = Comparison::of(&live, &reference, 0);
        session.run("@measured | figures");
        assert_eq!(session.app.compare.figures(), expected.as_ref().ok());
        session.run(r"
            | contrast live | first 29
            f | contrast reference | first 9
            f | contrast live | first 29
            w | contrast wipe | first 29
            // The factor that fills the range comes first.
            c | contrast difference ×4 | first 80
            c | contrast difference ×16 | first 255
            c | contrast difference ×64 | first 255
            c | contrast heat map | first 251
            c | contrast difference | first 20
            h | contrast wipe | first 29
        ");
        let width = session.app.shared.raster().expect("there is room").0.width;
        session.run(&"h".repeat(width.into())).run("| first 9");
        assert_eq!(session.app.compare.wipe.0, 0.0);
        session.run("n");
        assert_eq!(session.app.compare.cross, Some((0, 0)));
        session.run("<Esc> | mode SELECT | does stop compared, stop reference");
    };

    /// In two tiles, of which each lists one pixel.
    the_worst_pixels_are_walked_through_from_the_worst_on: previewed().play(r"
        A=
        @started compared 7
        @frame compared 7 first 19 40 99
        @measured
        n | compared-at 40,0
        n | compared-at 0,0
        n | compared-at 40,0
        N | compared-at 0,0
    ");

    a_pixel_is_explained_in_the_present_picture_and_the_comparison_goes_on: {
        let mut session = previewed().session();
        session.run(r"
            A=
            @started compared 7
            @frame compared 7 first 29
            @measured
            fe | mode INSPECT | does explain compared 0,0
        ");
        let explained = session.effects.iter().find_map(|effect| match effect {
            Effect::Explain(_, frame) => Some(frame.pixels[0]),
            _ => None,
        });
        assert_eq!(explained, Some([29; 3]));
        assert_eq!(session.app.shared.seen(), Target::Compared);
        session.run("<Esc><Esc> | mode COMPARE | first 9");
    };

    an_undone_edit_is_traced_again_and_its_old_figures_are_not_final: previewed().play(r"
        A
        jjjel<Esc>=
        @started compared 7
        @frame compared 7 first 29
        @measured
        u                         | does trace compared
        @started compared 8       | not figures
        @frame compared 8 first 9
        @measured                 | figures
        n                         | says no pixel differs
    ");

    what_cannot_be_compared_is_refused_with_a_reason: {
        ray().table(r"
            {1} | not does refer to | says {2} | mode SELECT
        ", r"
            A                            | cannot pin the picture: it is still being traced
            6A                           | a wireframe cannot be pinned: 1 shows a picture
            :compare git --help<Enter>   | --help is not a revision
        ");
        ray().opened(|opening| opening.path = None).play(r"
            :compare saved<Enter> | says this scene has no file yet: use :w FILE to create one
            :compare HEAD<Enter>  | says this scene has no file yet: use :w FILE to create one
        ");
    };

    without_a_reference_the_ways_to_one_are_offered: {
        ray().table(r"
            {1} | offers pin, saved, git, file … | not says | mode SELECT
            {2} | {3} | text opened
        ", r"
            =               | dddd      | menu
            :compare<Enter> | <Esc>     | not menu
            =               | <Enter>   | says cannot pin the picture: it is still being traced
            =               | sa<Enter> | does refer to scene.ray
            =               | gi<Enter> | does refer to scene.ray at HEAD
            =               | fi<Enter> | prompt :compare…
        ");
        previewed().play("=<Enter> | says pinned the preview… | not menu | > = | mode COMPARE");
        ray().opened(|opening| opening.path = None).play("= | offers pin, file …");
    };

    /// What deletes where one came from does nothing here.
    the_key_that_deletes_is_free_while_pictures_are_compared: previewed().play(r"
        A=dddd | mode COMPARE | text opened
        <Esc>  | mode SELECT  | text opened
    ");

    the_command_names_files_the_saved_scene_and_revisions: ray().table(r"
        :compare {1}<Enter> | does once refer to | does refer to {2}
    ", r"
        theirs x.ppm | theirs x.ppm
        ./saved      | ./saved
        saved        | scene.ray
        git          | scene.ray at HEAD
        HEAD         | scene.ray at HEAD
        HEAD~3       | scene.ray at HEAD~3
        git v1.0     | scene.ray at v1.0
    ");

    a_comparison_that_can_no_longer_be_traced_gives_way_to_the_preview_at_once: ray().play(r"
        :compare saved<Enter>
        @reference scene opened | does trace compared, trace reference
        :size 70000x8<Enter>    | does stop compared, stop reference | does trace preview | mode SELECT
    ");

    the_scene_is_traced_at_the_size_of_a_picture: {
        // In half cells, which are square, it is as wide to its height.
        unasked().table(r"
            :compare theirs.png<Enter>
            @reference picture {1} | does trace compared | job size {1} camera {1} | mode COMPARE | raster {3}
            | says theirs.png records no settings: traced at {2}, 16 spp, whitted, depth 8; the scene's own size is 800×600
        ", r"
            400x300 | 400×300 | 87x33
            64x64   | 64×64   | 76x38
        ");
        // A pinned one as well, once the scene's size is another.
        unasked().play(r"
            <F5>
            @started full 1
            @frame full 1 first 9
            A<Esc>:size 64x64<Enter>
            = | does trace compared | job size 800x600
            | past …traced at 800×600, the size of the pinned picture; the scene's own is 64×64…
        ");
    };

    of_a_record_that_cannot_be_believed_the_rest_is_used: unasked().table(r"
        :compare theirs.png<Enter>
        @reference picture 800x600 {1} | says traced as recorded in theirs.png: 800×600, {2}
    ", r"
        spp 0\ndepth 3\nnew 1\n | 16 spp, whitted, depth 3; ignored: spp 0, new 1, version is missing and 13 more
        nonsense                | 16 spp, whitted, depth 8; ignored: nonsense
    ");

    /// A pinned picture stays whatever becomes of another one.
    a_reference_that_cannot_be_compared_leaves_the_one_before: {
        // Its whole picture would have too many pixels to trace.
        let huge = RECORD.replace("size 8x6", "size 4294967295x6");
        previewed().with("huge", huge).play(r"
            A
            @note pinned reference
            :compare theirs.png<Enter>
            @reference picture 3x4 {huge}             | does free | reference {pinned}
            :compare none.png<Enter>
            @reference none none.png: no such file    | reference {pinned} | mode SELECT
            =                                         | mode COMPARE
        ");
    };

    different_channels_are_named: previewed().play(r"
        A=2
        @started compared 7
        @frame compared 7 first 29
        @measured | aov depth | unlike depth against light
        1         | not unlike
    ");

    the_comparison_leads_back_to_the_mode_before_it: previewed().table("A\n{1} | mode {2}", r"
        =<Esc>                | SELECT
        ==                    | SELECT
        v:compare<Enter><Esc> | VIEW
        e=<Esc>               | EDIT
        <F5>=                 | COMPARE
        <F5>=<Esc>            | TRACE
        <F5>=<Esc><Esc>       | SELECT
        =<F5><Esc>            | SELECT
        <F5>=<F5><Esc>        | SELECT
    ");
}

#[test]
fn a_picture_is_compared_as_its_file_says_that_it_was_made() {
    let mut session = unasked().with("record", RECORD).session();
    session.run(r"
        // Neither the text's settings nor the moved view count.
        vl<Esc>
        :compare theirs.png<Enter>
        @reference picture 3x4 {record} | does trace compared
        | says traced as recorded in theirs.png: its view, 8×6, 64 spp, path, depth 2, region 1,2,3,4, seed 7, filter gaussian, transfer srgb, exposure -1, falloff square, noise 0.05, clamp 8, gloss exponent, denoised; the scene's own size is …
    ");
    let live = session.effects.iter().find_map(traced_by);
    let (_, live) = live.expect("it is traced");
    let mut written = live.settings.written();
    written.push(("spp", live.settings.spp.to_string()));
    for (name, value) in written {
        let line = format!("{name} {value}\n");
        assert!(RECORD.contains(&line), "{line}");
    }
    let own = session.app.shared.scene.as_ref().expect("a scene").camera;
    let view = Viewpoint::between(&own, &live.camera).to_string();
    assert_eq!(view, "fov 30");
    assert!(live.denoise && live.frames == Frames::LastWithValues);
    // What the user chooses comes first, and an AOV is named as unlike.
    session.run(
        "PP\n2 | does trace compared | job integrator photon spp 1 | unlike depth against light",
    );
}

#[test]
fn a_scene_is_traced_with_the_same_settings_and_edits_of_the_present_one_are_not_in_it() {
    let mut session = ray().session();
    session.run(
        r"
        :compare saved<Enter>
        jjjel<Esc>
        @reference scene opened | does trace compared, trace reference
    ",
    );
    let jobs: Vec<_> = session.effects.iter().filter_map(traced_by).collect();
    let job = |wanted| {
        jobs.iter()
            .find(|(target, _)| *target == wanted)
            .expect("it is traced")
            .1
    };
    let (live, reference) = (job(Target::Compared), job(Target::Reference));
    assert_eq!(reference.scene, open(SCENE).shared.scene.expect("a scene"));
    assert_ne!(live.scene, reference.scene);
    assert_eq!(live.settings, reference.settings);
    session.run(
        r"
        @started compared 3
        @started reference 4
        @frame compared 3 first 29 | comparing
        @frame reference 4 first 9 | does compare | not comparing
        f                          | first 9
    ",
    );
}

#[test]
fn a_late_or_failed_reference_changes_nothing() {
    let mut session = ray().session();
    session.run(":compare a.ppm<Enter>:compare b.ppm<Enter>");
    let late = Err("cannot be read".to_owned());
    session.update(Msg::ReferenceRead(ReferenceId(1), late));
    session.run("| does free | not says");
    session.run("@reference none cannot be read | says cannot be read | not reference");
}
