//! Integrator, depth, AOV and filter of pictures.

use super::scripts::{listed, ray, scene, scripts};
use super::*;
use scene::Filter;

/// Keys, what they show, and the samples taken when four are requested.
const SHOWN: [(&str, &str, u32); 8] = [
    ("2", "depth", 1),
    ("3", "normal", 4),
    ("4", "object", 1),
    ("5", "albedo", 4),
    ("7", "cost", 4),
    ("8", "samples", 4),
    ("9", "noise", 4),
    ("1", "none", 4),
];

scripts! {
    switching_the_integrator_affects_every_picture_at_once: for (name, text) in SCENES {
        scene(name, text).play(r"
            P    | does trace preview | job integrator path depth 64
            <F5> | does recall | job integrator path depth 64
            @started full 1
            P    | does trace full | job integrator photon depth 64
            @started full 1
            P    | does trace full | job integrator whitted depth 8
            @started full 1
            P    | does trace full | job integrator path depth 64
            @started full 1
            b    | does trace export | job integrator path depth 64
            <Esc> | does trace preview | job integrator path depth 64 | text opened
        ");
    };

    the_scenes_integrator_applies_until_the_user_chooses: scene("scene.xml", SCENES[2].1)
        .but(r#"<camera> => <camera gamma="sRGB">"#)
        .with("plain", SCENES[2].1)
        .play(r"
        | does trace preview | job integrator path depth 64
        P           | integrator photon
        P           | integrator whitted | overridden
        P           | not overridden
        @file plain | not errors | integrator whitted
    ");

    a_depth_set_by_the_user_applies_to_all_integrators: ray()
        .opened(|opening| opening.rendering.depth = Some(3))
        .play(r"
        P | job integrator path depth 3
        P | job integrator photon depth 3
        P | job integrator whitted depth 3
    ");

    settings_of_the_text_lie_under_the_users: {
        let stage = listed(&format!("// render: integrator path depth 2 spp 8 exposure 1\n{SCENE}"));
        // As if given on the command line.
        stage.play("<F5> | job integrator path depth 2 exposure 1 spp 4");
        stage.opened(|opening| opening.rendering.spp = None).play(r"
            <F5>PP | overridden
            b      | job integrator whitted depth 2 spp 8
        ");
    };

    a_setting_in_use_is_written_and_no_longer_lies_over_the_text: ray()
        .opened(|opening| opening.rendering.depth = Some(3))
        .play(r"
        P:set integrator<Enter> | line 1 // render: integrator path | not overridden
        :set depth 5<Enter>
        | job integrator path depth 5 | line 1 // render: integrator path depth 5
        :set integrator default<Enter>:set depth default<Enter> | text opened
        u | line 1 // render: depth 5
        :set depth x<Enter> | says …render depth: `x` is not a number… | not says …skipped…
        | line 1 // render: depth 5
        <Esc>:set integrator pth<Enter> | says …did you mean `path`?… | not says …skipped…
        | line 1 // render: depth 5
        <Esc>:set depth 9999<Enter> | says …render depth: must be a whole number from 0 to 4096…
        | not says …skipped… | line 1 // render: depth 5
        <Esc>:set gamma 2<Enter> | not says …skipped… | line 1 // render: depth 5
        | says …settings: integrator, depth, spp, filter, transfer, exposure, falloff, gloss…
    ");

    /// The text and what takes precedence over it are as they were, also over several steps.
    undo_of_a_written_setting_brings_back_what_it_replaced: ray().play(r#"
        P:set integrator<Enter> | text "// render: integrator path\n{opened}"
        @note written text
        u           | integrator path | overridden | not text written
        <Ctrl-r>    | integrator path | not overridden | text written
        // What is chosen since belongs to the text then.
        P           | integrator photon | overridden | text written
        u           | integrator path | overridden | not text written
        PP          | integrator whitted | not overridden | not text written
        <Ctrl-r>    | integrator photon | overridden | text written
        uPP<Ctrl-r> | integrator photon | overridden | text written
        // Another setting, and several steps at once.
        :set depth 3<Enter>u | integrator photon | overridden | text written
        :set integrator<Enter>P:set depth 2<Enter>
        @note last rendering
        Ukk<Enter>  | integrator photon | overridden | text written
        UG<Enter>   | rendering {last}
    "#);

    /// What is wrong already stays a warning.
    a_setting_replaces_one_that_is_skipped: listed(&format!("// render: depth x\n{SCENE}")).play(r"
        :set spp 8<Enter>            | line 1 // render: depth x spp 8
        :set depth 2<Enter>          | line 1 // render: depth 2 spp 8
        :set exposure 1 spp 3<Enter> | says :set exposure takes one value
    ");

    settings_are_fields_of_a_thing_of_their_own: ray().play(r"
        ggel               | line 1 // render: integrator path
        jl                 | line 1 // render: integrator path depth 65
        0<Enter>i4097<Enter> | line 1 // render: integrator path depth 0
    ");

    digits_select_what_every_picture_shows: for (name, text) in SCENES {
        let mut session = scene(name, text).session();
        session.run("<F5>\n@started full 1");
        for (said, aov, spp) in SHOWN {
            session.run(&format!(
                "{said} | does trace full | job aov {aov} spp {spp} | > @started full 1"
            ));
        }
        for mode in ["<Esc>", "v"] {
            session.run(mode);
            for (said, aov, spp) in SHOWN {
                let is_one = if spp == 1 { "" } else { "not " };
                // It is shown already then.
                session.run(&format!(
                    "{said} | does trace preview | job aov {aov} | {is_one}job spp 1 | > {said} | not does"
                ));
            }
        }
        session.run("| text opened");
    };

    digits_are_typed_while_fields_are_edited: ray().play("2jjje3 | aov depth | typed 3");

    an_export_writes_what_is_shown_and_reports_it: ray().play(r"
        2
        b | does only check scene.depth.bmp, trace export | job aov depth spp 1
        | says exporting depth to scene.depth.bmp
        // The AOV shown meanwhile does not matter.
        1
        @frame export
        @exported | says wrote scene.depth.bmp: depth, 800×600, 1 spp
        b         | says exporting to scene.bmp
    ");

    a_finished_trace_is_exported_as_it_is_if_it_shows_what_is_requested: ray().play(r"
        2<F5>
        @started full 1
        @frame full
        b | does only write scene.depth.bmp, wait
        x
        3 | does trace full | job aov normal
        @started full 2
        b | does trace export | job aov normal
    ");

    the_pixel_filter_applies_to_full_size_pictures_only: ray()
        .opened(|opening| opening.rendering.filter = Some(Filter::Gaussian))
        .play(r"
        P    | does trace preview | job filter box
        <F5> | does recall | job filter gaussian
        b    | does trace export | job filter gaussian
    ");
}
