//! Changes of several marked things, and changes repeated.

use super::scripts::{ray, scripts};

scripts! {
    marked_things_are_edited_also_from_another_row: ray().play(r"
        [object 1] <Space><Space>ej2<Enter> | at object 2 | says radius set in all 2 marked items
        u | text opened
    ");

    marked_numbers_are_nudged_by_the_same_amount: ray().play(r"
        [object 1] <Space><Space>kejl
        | text 1.5 // => 1.6 // & 4 0 0\n1 => 4 0 0\n1.1 | says radius set in all 2 marked items
        u | text opened
    ");

    the_last_change_is_repeated_elsewhere: ray().each(r"
        [object 1] ej2<Enter><Esc>j. | says repeated: radius 2 on object 2 (sphere) | > u | > u | text opened
        [object 1] ejl<Esc>j.        | says repeated: radius +0.1 on object 2 (sphere)
        [object 1] cbox<Enter>j.     | says repeated: changed to box
        [object 1] mx1<Enter>j.      | says repeated: move along x: 1 on object 2 (sphere)
        [object 1] ej2<Enter><Esc>jek<Alt-.> | says repeated: radius 2 on object 2 (sphere)
        [object 1] .                 | says nothing to repeat yet: change a field, a type or a place first
        [object 1] ej2<Enter><Esc> | > [light 1] . | says light 1 has no radius
    ");
}
