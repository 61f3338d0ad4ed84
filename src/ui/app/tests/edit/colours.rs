//! The colour picker.

use super::fields::XML;
use super::scripts::{Stage, ray, scene, scripts};
use super::*;

/// The stage of a diffuse colour with a factor, and of a background.
fn xml<'s>() -> Stage<'s> {
    scene("a.xml", XML)
        .but(r#"name="clay"/> => name="clay"><diffuse r="0.5" g="0.25" b="0" value="0.5"/></material>"#)
        .but(r#"</scene> => <background r="0.2" g="0.4" b="0.4"/></scene>"#)
}

scripts! {
    a_colour_is_picked_in_one_undo_step_and_put_back_by_esc: {
        let script = r"
            [{1}] e
            @field {2}
            c        | context Colour
            {3}      | text {4}
            <Enter>  | context In(Edit)
            u        | text opened
            <Ctrl-r> | text {4}

            [{1}] e
            @field {2}
            c{3}
            <Esc>u   | text opened | says nothing to undo
        ";
        // A grey takes a saturation, and keeps the hue chosen before.
        scene("a.ray", SCENE).table(script, r"
            object 1 | kd | jL        | .45 .45 .45 => .45 .36 .36
            object 1 | kd | LLLLLLjL  | .45 .45 .45 => .36 .45 .36
            object 1 | kd | jjLLL     | .45 .45 .45 => 1.05 1.05 1.05
            object 1 | kd | jj<Alt-l> | .45 .45 .45 => .452 .452 .452
            object 1 | kd | jj;l      | .45 .45 .45 => .65 .65 .65
            object 1 | kd | jjHHHH    | .45 .45 .45 => .00 .00 .00
            // The first colour of the scene is that of its ambient light.
            object 1 | kd | jjjl      | .45 .45 .45 => .10 .10 .10
            object 1 | kd | jjjlh     | .45 .45 .45 => .50 .50 .50
        ");
        scene("a.dat", dat::SCENE).table(script, r"
            material 1 | RGB | LLLLLL  | mat ID 1  1 0 0 => mat ID 1  0 1 0
            material 1 | RGB | kHHHHHH | mat ID 1  1 0 0 => mat ID 1  0 0 1
        ");
        // The factor stays.
        xml().table(script, r#"
            material 1 | diffuse    | jH | g="0.25" b="0" value => g="0.30" b="0.1" value
            background | background | jH | r="0.2" g="0.4" => r="0.28" g="0.4"
        "#);
    };

    there_and_back_changes_nothing: ray().but(".45 .45 .45 => 0.123456 0.7 .33").table(r"
        [object 1] e
        @field kd
        {1} | text opened
    ", r"
        clh
        cjlh
        cjjlh
        cjkjk<Enter>
    ");

    a_default_is_written_when_its_colour_is_picked: xml()
        .but(r#"<diffuse r="0.5" g="0.25" b="0" value="0.5"/> =>"#)
        .play(r#"
        [material 1] e
        @field diffuse
        cjL | text …<diffuse r="0.5" g="0.4" b="0.4"/>…
    "#);

    a_pasted_colour_is_taken_and_marked_things_follow: ray().play(r"
        [object 1] <Space><Space>ke
        @field kd
        c
        @paste #ff8000
        | text .45 .45 .45 => 1.00 .502 .00 & .45 .45 .45 => 1.00 .502 .00
        @paste red | says …#rrggbb…
        <Esc>      | text opened
    ");

    marked_things_get_the_channels_that_the_selected_one_has_already: ray()
        .but(".45 .45 .45 => .45 .36 .36")
        .play(r"
        [object 1] <Space><Space>ke
        @field kd
        cjjL<Enter> | text .45 .36 .36 => .65 .52 .52 & .45 .45 .45 => .65 .52 .52
        u           | text opened
    ");

    fields_without_a_colour_say_so_and_the_palette_opens_the_picker: ray().play(r"
        [object 1] e
        @field radius
        c                      | says radius is not a colour
        @field kd
        <Esc>:pick a col<Enter> | context Colour
    ");

    a_colour_overtaken_by_the_file_is_kept: ray().play(r"
        [object 1] e
        @field kd
        cjL
        @file 4 0 0 => 5 0 0
        l | says …changed on disk… | context In(Edit) | text ….45 .36 .36…
    ");

    the_mouse_drags_bars_takes_swatches_and_confirms_beside_them: scene("a.ray", SCENE).play(r"
        [object 1] e
        @field kd
        c
        @down list 23,2  | text .45 .45 .45 => .45 .00 .00
        // A drag stays on its bar.
        @drag list 12,1  | text opened
        @drag list 29,2
        @up list 29,2    | text .45 .45 .45 => .45 .00 .00
        @down list 4,9   | text .45 .45 .45 => 1.00 1.00 1.00
        @down screen 1,1 | text .45 .45 .45 => 1.00 1.00 1.00 | context In(Edit)
        u                | text opened
    ");
}
