//! Several exports, and files that others wrote.

use super::scripts::{ray, scripts};

scripts! {
    exports_run_one_after_the_other_and_each_is_reported: ray().play(r"
        :export a.bmp 32x8 1<Enter>:export b.bmp 32x8 1<Enter>:export c.bmp 32x8 1<Enter>
        | says queued: to c.bmp
        // Another picture in the same file replaces the one that waits.
        :export b.bmp 16x8 1<Enter> | queued 2
        @frame export
        @exported 1    | does check c.bmp
        @frame export
        @exported 3    | does check b.bmp
        @frame export
        @exported 4    | not exporting
        | shown wrote a.bmp…
        j | shown wrote c.bmp…
        j | shown wrote b.bmp…
    ");

    a_cancelled_or_failed_export_lets_the_next_one_start: ray().table(r"
        :export a.bmp<Enter>:export b.bmp<Enter>
        {1} | does once check | does check b.bmp
        @exported 2
    ", r"
        x
        @ended export
        @cannot export too large
        @unwritten 1 full
    ");

    quitting_waits_for_all_exports: ray().play(r"
        :export a.bmp<Enter>:export b.bmp<Enter>qw | says will quit once 2 exports finish
        @frame export
        @exported 1 | not does quit
        @frame export
        @exported 2 | does quit

        bq<Esc>     | not asks | exporting
        qy          | does quit
    ");

    a_file_that_others_wrote_is_overwritten_or_numbered_as_the_user_decides: ray().table(r"
        b
        @taken 1 | not says | does stop export | not exporting
        {1}      | {2} | {3}
    ", r"
        y     | does check scene.bmp overwritten | says exporting to scene.bmp
        n     | does check scene.bmp numbered    | not says
        y     | exporting                        | says exporting to scene.bmp
        n     | exporting                        | not says
        <Esc> | not does check                   | not exporting
        <Esc> | not says                         | not asks
    ");

    a_command_names_the_file_and_how_to_overwrite_it: ray().play(r"
        :export scene.bmp<Enter>
        @taken 1 | says scene.bmp exists | not asks
    ");
}
