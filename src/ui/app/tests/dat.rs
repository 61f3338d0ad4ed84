//! Features of `.dat` that `.ray` lacks: words and references in fields, hidden objects.

use super::scripts::{Stage, scene, scripts};

/// Two materials and three objects, one of which combines the others.
pub(super) const SCENE: &str = "\
camera perspective 0 -9 0  0 0 0  0 0 1  1 0.1 100
resolution .01 .01
viewport 40 30
light ID 1 inf 0 0 0  0 1 -1  1 1 1  1 0 0 0 shadow_on
mat ID 1  1 0 0  .1 .5 .4 9  0 0 1
mat ID 7  0 0 1  .1 .5 .4 9  0 0 1
obj sphere ID 1 mat ID 1  0 0 0  1
obj sphere ID 2 mat ID 7  .5 0 0  1
obj CSG ID 3 difference ID 1 ID 2
obj sphere ID 4 mat ID 7  3 0 0  1
";

fn dat<'s>() -> Stage<'s> {
    scene("scene.dat", SCENE)
}

scripts! {
    a_choice_is_nudged_and_typed: {
        dat().table(r"
            [light 1] e{1} | text {2}
            <Esc>uuu       | text opened
        ", r"
            l            | ID 1 inf => ID 1 amb
            h            | ID 1 inf => ID 1 pnt
            ii<Back><Back><Back><Back>am<Enter> | ID 1 inf => ID 1 amb
            kkjjjjjjjjl  | shadow_on => shadow_off
        ");
        dat().play(r"
            [light 1] ei<Back><Back><Back>sun<Enter> | expected …pnt or inf or amb…
            <Esc>uuu | text opened
        ");
    };

    the_courses_word_for_an_intersection_is_known_and_kept: dat().but("difference => intersect").table(r"
        | not wrong
        [object 3] {1} | text …CSG ID 3 {2} ID 1 ID 2…
    ", r"
        e          | intersect
        el         | difference
        eh         | union
        elh        | intersection
        elu        | intersect
        eiu<Enter> | union
        elii<Back><Back><Back><Back><Back><Back><Back><Back><Back><Back><Back>intersect<Enter> | intersect
    ");

    an_f_suffix_is_dropped_by_the_next_edit: dat().but(r"3 0 0  1\n => 3 0 0  0.50f\n").table(r"
        [object 4] e{1} | text …3 0 0  {2}\n
    ", r"
        jj         | 0.50f
        jjl        | 0.60
        jji<Enter> | 0.50f
        jj2F<Enter> | 2
        jjlu       | 0.50f
    ");

    nudging_a_reference_cycles_through_existing_ids: dat().table(r"
        [{1}] {2} | text {3}
        <Esc>uuu  | text opened
    ", r"
        object 1 | el         | ID 1 mat ID 1 => ID 1 mat ID 7
        object 1 | eh         | ID 1 mat ID 1 => ID 1 mat ID 7
        object 1 | e7<Enter>  | ID 1 mat ID 1 => ID 1 mat ID 7
        object 1 | e5<Enter>  | opened
        object 3 | ejl        | difference ID 1 => difference ID 2
    ");

    objects_are_hidden_and_shown_by_the_render_record: dat().play(r"
        [object 4] h | lines render 1 ID 3 | says hidden: object 4 (sphere) | objects 1
        h            | lines render 2 ID 3 ID 4 | objects 2
        h
        [object 3] h | says the last visible object cannot be hidden
        [light 1] h  | says only objects can be shown or hidden

        [object 1] h | text opened
        | says object 1 (sphere) is part of object 3 (CSG): h there shows or hides it

        [object 4] h<Esc>uuu | text opened
    ");

    a_combination_shows_its_parts: dat().each(r"
        [object 3] | parts 1 object 1, 1 object 2
        [object 1] | not parts
    ");

    saving_a_view_keeps_the_numbers_that_did_not_change: {
        dat().play(r"
            vlS | line 1 …\s 0 0 0  0 0 1  1 0.1 100 | lines camera…
        ");
        dat().but("-9 0  0 0 0 => -9 0  0.123456789 0 0").play(r"
            vlS | line 1 …\s 0.123456789 0 0  0 0 1  1 …
        ");
        dat().but("0 -9 0 => 0.123456789 -9 0").play(r"
            v]S | line 1 …\s0.123456789 -9 0  0 0 0 …
        ");
    };

    a_scene_keeps_its_language: dat().play(r"
        :w other.ray<Enter>  | does only check place | says other.ray: the name must end in .dat
        // The prompt suggests a valid name.
        <Esc>:w mine<Enter>  | prompt :w mine.dat
        // What is typed replaces it.
        :w other.DAT<Enter>  | does save
    ");

    a_hidden_object_is_not_framed_in_silence: dat().play(r"
        [object 4] vf | not says
        @note framed camera
        <Esc>hvf      | says …is not drawn: this is the whole scene | not camera {framed}
    ");

    square_pixels_stay_square: dat().but(r"resolution .01 .01\nviewport 40 30 => viewport 400 300").play(r"
        v]S | lines resolution 0.002761423749153967 0.002761423749153967, camera…
    ");
}
