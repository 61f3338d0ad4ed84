//! What is wrong with pictures as a whole, the trials, and the setting suggested.

use super::scripts::{Stage, scene, scripts};
use super::*;

/// The stage of a text, which checks can call too bright.
fn judged<'s>(name: &str, text: &str) -> Stage<'s> {
    let above = "more than half of the picture is above 1:";
    scene(name, text).with("above", above).after("<Esc>")
}

/// The stage of a scene of which nothing is tried that would darken it.
fn faded<'s>() -> Stage<'s> {
    judged("scene.ray", &format!("// render: falloff square\n{SCENE}"))
}

/// The stage of a scene with these settings, whose mirror and diffuse part add up to more than 1.
fn glaring<'s>(settings: &str) -> Stage<'s> {
    let scene = SCENE.replace(".45 .45 .45", ".9 .9 .9");
    judged("scene.ray", &format!("// render: {settings}\n{scene}"))
}

scripts! {
    a_picture_that_is_too_bright_says_so_once: faded()
        .with("bright", "C sets exposure -1; < darkens only the screen")
        .play(r"
        @judged 0.9 | not shown
        @judged 1.5 | shown {above} {bright}
        // What is offered is what `C` does.
        @judged 3   | shown {above} C sets exposure -2; < darkens only the screen
        @judged 1.5 | shown {above} {bright}
        // The next key dismisses it, and it only comes back on request.
        j
        @judged 1.5 | not shown
        !
        @judged 1.5 | shown no errors or warnings in the text, but {above} {bright}
        j
        @judged 0.9 | not shown
        @judged 1.5 | shown {above} {bright}
        // Darkened by a stop, it is not too bright.
        <Lt><Lt><Esc>
        @judged 0.9 | not shown
        <Esc>
        @judged 1.5 | not shown
    ");

    what_is_wrong_with_a_picture_is_said_after_other_messages_while_it_is_so: faded().play(r"
        @says something else
        @judged 1.5
        @judged 1.5 | shown something else
        <Esc>       | shown {above}…
        <Esc>
        @judged 0.9
        @says something else
        @judged 1.5
        @judged 0.9 | shown something else
        <Esc>       | not shown
    ");

    the_setting_whose_trial_is_best_is_offered: {
        let stage = glaring("integrator path depth 64");
        // Too bright at depth 4, so that no more bounces are tried.
        stage.table(r"
            @judged 3: falloff square {1}; depth 2 {2}; depth 4 {3} | shown {above} C sets {4};…
        ", r"
            0.5  | 2   | 2    | falloff square
            0.01 | 2   | 2    | exposure -2
            0.2  | 0.4 | 0.9  | depth 2
            0.2  | 0.8 | 0.45 | depth 4
        ");
        stage.play(r"
            @light 3   | job frames Live spp 16 depth 64 | not job falloff square
            @trial 3   | job frames Live spp 16 depth 64 falloff square
            @trial 0.5 | job frames Live spp 16 depth 2 | not job falloff square
            @trial 2   | does stop trial | not does trace trial
            C          | line 1 // render: integrator path depth 64 falloff square
            u          | text opened
        ");
    };

    where_no_trial_helps_that_is_said: glaring("falloff square").play(r"
        // Above 1 in three quarters, whatever the exposure: infinitely bright.
        @judged 3: all inf | shown {above} no single render setting fixes that;…
        <Esc>C             | shown no suggestion for this scene
    ");

    trials_that_end_early_or_are_outdated_suggest_nothing: judged("scene.ray", SCENE).play(r"
        // Nothing is said before it is known what helps.
        @light 3                | does trace trial | not shown
        @cannot trial no memory | does only stop trial | not shown
        // What is found out of a picture that was left is not said.
        @light 3                | does trace trial
        P<Esc>
        @trial 3                | does only stop trial | not shown
    ");

    a_picture_too_dark_to_be_exported_says_which_exposure_helps: judged("scene.ray", SCENE).play(r"
        @judged 0.0001 | shown the picture is black: C sets exposure 13
        @judged 0.5    | > <Esc>
        @judged 0.01
        | shown the picture is almost black (brightest value 3 of 255): C sets exposure 6.5
        @judged 0.5    | > <Esc>
        @judged 0.07   | not shown
    ");

    a_black_picture_says_what_helps: {
        let sky = judged(
            "scene.xml",
            "<xml><scene><object type='sphere' material='m'/><material name='m'/>\
             <environment value='1'/></scene><camera><position z='9'/></camera></xml>",
        );
        sky.play(r#"
            | wrong
            @judged 0: integrator path 1 | shown the picture is black: C sets integrator path
            // By path it is lit.
            P      | not wrong
            PP
            @judged 0: integrator path 1
            C      | text …<render integrator="path"/>… | not wrong
            <Esc>C | shown no suggestion for this scene
        "#);
        // What glows is seen, but lights nothing.
        sky.but(
            "</scene> => <object type='sphere' material='l'><translate x='3'/></object>\
             <material name='l'><emission value='1'/></material></scene>",
        ).play("@judged 0.2: integrator path 0.5 | shown no surface is lit: C sets integrator path");
    };
}
