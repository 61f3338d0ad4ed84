//! Nudging, typing, pasting, undoing.

use super::scripts::{ray, scripts};

scripts! {
    nudges_have_the_selected_size: ray().each(r"
        jjje<Right><Right>  | lines 0.2 0 0
        jjjell              | lines 0.2 0 0
        jjje<Left>          | lines -0.1 0 0
        jjje<Shift-Right>   | lines 1 0 0
        jjjeL               | lines 1 0 0
        jjje<Alt-Right>     | lines 0.01 0 0
        jjje,l              | lines 0.01 0 0
        jjje;l              | lines 1 0 0
        jjje,;l             | lines 0.1 0 0
        // A key with a step of its own keeps that.
        jjje,L              | lines 1 0 0
        jjje;<Alt-l>        | lines 0.01 0 0
        jjje<Tab>l          | lines 0 0.1 0
        jjjejl              | lines 1.6 // the radius
        // A nudge below the minimum is refused.
        jjjej<Shift-Left><Shift-Left> | lines 0.5 // the radius
        jel                 | lines 0.15 0.1 0.1
        // Nudging there and back restores the text exactly.
        jjjejhl             | text opened
    ");

    a_typed_literal_is_written_unchanged: ray().each(r"
        jjjej2<Enter>             | lines 2 // the radius
        jjjei<Back>.25e1<Enter>   | lines .25e1 0 0
        jjje-.5<Enter>            | lines -.5 0 0
        jjje1 2 3<Enter>          | lines 1 2 3
        jjje.5<Enter>             | lines .5 0 0
        jjje(1+2)/4<Enter>        | lines 0.75 0 0
        jjjej*=2<Enter>           | lines 3 // the radius
        jjjej/=3<Enter>           | lines 0.5 // the radius
        jjje1/3 0 sqrt(2)<Enter>  | lines 0.333333 0 1.41421
        jjje7<Esc>                | text opened
        jjje7<Tab>8<Enter>        | lines 7 8 0
        // A hash begins to type a colour.
        jjjejj#ff8000<Enter>      | lines 1 0.502 0 .45 .45 .45 .5 .5 .5
    ");

    a_refused_value_stays_in_the_field_with_the_reason: ray().table(r"
        {1}   | {3} | refused …{2}… | text opened | not errors
        <Esc> | not refused | mode EDIT | not inputs
    ", r"
        jjjej0<Enter>              | object 1 (sphere) radius: must be greater than 0 | typed
        jjjei<Ctrl-u>abc<Enter>    | column 1: `abc` is none of | typed
        jjjei<Ctrl-u>1 2<Enter>    | one number | typed
        jjjei<Ctrl-u>1//<Enter>    | column 3: expected a number | typed
        ejjj180<Enter>             | view fov: must be | typed
        jjjei<Ctrl-u><Enter>       | one number | not typed
    ");

    pastes_fill_all_components_in_one_step: ray().table(r"
        {1}
        @paste {2} | lines {3}
        u          | text opened
    ", r"
        jjje      | 0.1, 0.2 0.3 | 0.1 0.2 0.3
        jjje      | \s1e3\s      | 1e3 0 0
        je        | #ff8000      | 1 0.502 0
        jjjejjjjj | 1 2 3        | 1 2 3 1
    ");

    pastes_that_do_not_fit_change_nothing: ray().table(r"
        {1}
        @paste {2} | text opened | > u | text opened
    ", r"
        jjje      | #ff8000
        jjje      | 1 2
        jjjejjjjj | 1 2 3 4 5
        jjj       | 1 2 3
    ");

    nudges_of_one_number_are_one_step: ray().play(r"
        jjjelll<Tab>ll | lines 0.3 0.2 0
        u              | lines 0.3 0 0
        u              | text opened
        u              | says nothing to undo
        <Ctrl-r>       | lines 0.3 0 0
    ");

    undo_selects_the_changed_node: ray().play(r"
        jjjejl<Esc>ggju | at object 1 | field 1 | says undone: object 1 (sphere) radius: 1.5 → 1.6
        <Ctrl-r>        | says redone: object 1 (sphere) radius: 1.5 → 1.6
    ");

    /// The reflection of the first object is `0.50`, usually from 0 to 1.
    nudges_stop_at_the_ends_of_the_usual_range: {
        ray().after("ggjjjjejjjjjj").each(r"
            LLLLLLLLLLLLLLL   | lines 5 1.00 0 1
            HHHHHHHHHHHHHHHHl | lines 5 0.05 0 1
            1<Enter>l         | lines 5 1 0 1 | says end of the slider; type a value to go on
            1.2<Enter>l       | lines 5 1.25 0 1
            1.02<Enter>h      | lines 5 0.97 0 1
            -.2<Enter>L       | lines 5 .3 0 1
        ");
        ray().each(r"
            jjjejjHHHH        | lines .0 .1 .1 .45 .45 .45 .5 .5 .5
            jjjejLL           | lines 3.5 // the radius
        ");
    };
}
