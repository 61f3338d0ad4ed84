//! Views, light components, the exposure of the display, and the histogram.

use super::scripts::{ray, scripts};
use super::*;

scripts! {
    exposure_changes_the_screen_and_traces_nothing: ray().play(r"
        >                     | exposed 1 | not does trace preview | says exposure +0.5 EV, on screen only
        >>                    | exposed 3 | not does trace preview | says exposure +1.5 EV, on screen only
        <Lt>                  | exposed 2 | not does trace preview | says exposure +1 EV, on screen only
        :exposure -2.5<Enter> | exposed -5 | not does trace preview | says exposure -2.5 EV, on screen only
        :exposure 0.25<Enter> | exposed -5 | not does trace preview
        | says :exposure needs EV from -20 to 20, in steps of 0.5
        :exposure 0<Enter>    | exposed 0 | not does trace preview | says exposure 0
        :exposure 20<Enter>>  | exposed 40 | not does trace preview | says exposure +20 EV, on screen only
        | exposure +20 EV
        2<Esc>> | not exposure | says only light and albedo can be exposed; press 1
    ");

    commands_choose_transfer_and_colours_of_the_display: ray().play(r"
        :transfer srgb<Enter>    | exposure sRGB
        :falsecolour<Enter>      | exposure sRGB false colours
        :transfer linear<Enter>> | exposure +0.5 EV linear false colours
        :transfer scene<Enter>   | exposure +0.5 EV false colours
        :falsecolor<Enter><Lt>   | not exposure
    ");

    noise_is_reduced_on_screen_and_in_no_file: ray().play(r"
        ~ | does trace preview | job denoise true | says denoise on, on screen only
        | exposure denoised | denoised
        // A complete picture without is too large for it.
        @started preview 1
        @frame preview  | exposure not denoised
        <F5>            | job denoise true
        <Esc>
        b               | does trace export | job denoise false
        // The others show no light.
        2               | does trace preview | not exposure
        ~               | says only light has noise to reduce; press 1
        1
        :denoise<Enter> | does trace preview | job denoise false
        | says denoise off | not exposure
    ");

    a_trace_continues_when_denoising_is_switched: ray().play(r"
        <F5>
        @started full 1
        ~ | does only trace full | job denoise true
    ");

    brackets_step_through_the_shares_of_the_light: ray().play(r"
        ) | does trace preview | job aov direct…0 | says only direct light of light 1
        ) | does trace preview | job aov emission | says emission, ambient light and background alone
        ) | does trace preview | job aov indirect | says indirect light alone: by way of other surfaces
        ) | does trace preview | job aov none     | says light
        ( | aov indirect
        ( | aov emission
        ( | aov direct | view-name only light 1
        ( | not aov
        ) | view-name only light 1
    ");

    the_share_of_a_light_goes_with_it: ray()
        .but(r"1\n5 5 5 // the light\n1 1 1\n => 2\n5 5 5 // the light\n1 1 1\n-5 5 5\n1 1 1\n")
        .with("one", SCENE)
        .play(r"
        ))        | view-name only light 2
        @file one | not errors | not aov | not view-name
    ");

    legends_say_what_colours_stand_for: ray().play(r"
        7 | > @light 0.5 | view-name cost     | legend 1 to 312 rays a sample
        8 | > @light 0.5 | view-name samples  | legend 1 to 312
        2 | > @light 0.5 | view-name depth    | legend 1 to 312
        3 | > @light 0.5 | view-name normal   | not legend
        :show uv<Enter>  | > @light 0.5 | view-name uv   | legend u red, v green
        :show side<Enter> | > @light 0.5 | view-name side | legend front blue, back orange
        1 | > @light 0.5 | not view-name      | not legend
        :falsecolour<Enter> | not view-name   | legend -8 to 0 EV, green below, white above
        | exposure false colours
    ");

    /// What is exported is what the scene and the view say, whatever the screen shows.
    the_display_never_reaches_a_file: {
        let settings = |keys: &str| {
            let mut session = ray().session();
            session.run(&format!("{keys}b | does trace export"));
            let traced = session.effects.iter().find_map(traced_by);
            traced.expect("the export is traced").1.settings
        };
        assert_eq!(settings(""), settings(">>>:transfer srgb<Enter>:falsecolour<Enter>"));
        // A complete trace on screen is written as traced.
        ray().play(r"
            >>:falsecolour<Enter><F5>
            @started full 1
            @frame full
            b | does write scene.bmp… | not does trace export | first 9
        ");
    };

    the_histogram_follows_picture_and_exposure: ray().play(r"
        @light 0.5
        :histogram<Enter> | histogram 14: 5655; clipped 0
        >>>               | histogram 17: 5655; clipped 1
        @light 0.25       | histogram 15: 5655; clipped 0
        :histogram<Enter> | not histogram
    ");
}
