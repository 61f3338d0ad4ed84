//! Slow and failing saves.

use super::scripts::{ray, scene, scripts};
use super::*;

scripts! {
    an_abandoned_save_does_not_quit_later: ray().opened(|opening| opening.path = None).play(r"
        // The answer to the question prompts for a name, which is not given.
        jjjelqw<Esc> | not prompt | not leaving
    ");

    a_hanging_save_is_reported_and_delays_no_other_file: ray().play(&r"
        jjjel:w! stuck.ray<Enter> | does save stuck.ray, wait writing | not writing
        {twelve seconds}
        | writing stuck.ray 12
        :w free.ray<Enter> | does once save free.ray | over nothing
        @saved 2           | says wrote free.ray | path free.ray
        // The late outcome no longer changes anything.
        @saved 1 opened    | says wrote stuck.ray | path free.ray | not dirty
        @elapsed writing   | not does wait writing | not writing
    ".replace("{twelve seconds}", &["@elapsed writing | does wait writing"; 12].join("\n")));

    saves_of_one_file_wait_for_each_other: ray().play(r"
        jjjelw
        lw           | not does save
        l:wq<Enter>  | not does save
        @saved 1     | does once save scene.ray | over save 1 | dirty
        // The quit has waited for the last save.
        @saved 3     | not dirty | does quit
    ");

    /// The previous save determines what the file holds, regardless of saves elsewhere meanwhile.
    a_waiting_save_may_replace_what_the_previous_one_wrote: ray().table(r"
        jjjel{1}
        l{2}
        l:w other.ray<Enter>
        @saved 3
        {4}      | does once save {3} | over {5}
        @saved 2
    ", r"
        w                   | w                  | scene.ray | @saved 1       | save 1
        w                   | w                  | scene.ray | @failed 1 full | opened
        :w new.ray<Enter>   | :w new.ray<Enter>  | new.ray   | @saved 1       | save 1
        :w! new.ray<Enter>  | :w new.ray<Enter>  | new.ray   | @saved 1       | save 1
    ");

    a_leading_dot_does_not_make_it_another_file: ray().play(r"
        jjjel:w ./scene.ray<Enter> | does once save scene.ray | over opened
    ");

    /// The watcher may be faster than the outcome of the save.
    the_text_of_a_running_save_is_not_a_change: ray().play(r"
        jjjelw           | not says
        @file mine       | not says | dirty
        @saved
        @file mine       | not does | says wrote scene.ray
        // What others write meanwhile is a change, but only once the save has ended.
        lw
        @file mine & 1.5 => 1.7 | text save 2
        @saved 2
        @file file       | text file
    ");

    a_quit_waits_for_a_hanging_save_unless_forced: {
        // The text that was to be saved is not lost.
        ray().table(r"
            jjjel:wq<Enter>  | not does quit
            @elapsed writing
            @elapsed writing | says will quit once the save finishes…
            {1}              | {2} quit | {2} keep edits
        ", r"
            :q!<Enter>    | does
            <Ctrl-c>y     | does
            <Ctrl-c><Esc> | not does
        ");
        ray().play(r"
            jjjel:wq<Enter>
            @saved        | does quit

            // Whoever stays gives up what was to follow.
            jjjel:wq<Enter>
            <Ctrl-c><Esc>
            @saved        | not does quit
        ");
    };

    /// The file was changed by others, so the first `:wq` saves nothing; a later `w` only saves.
    a_conflict_cancels_the_quit_that_waits_for_the_save: ray().table(r"
        jjjel
        @file \n0 0 0 => \n9 0 0
        <Esc>
        {1}        | not does save
        @file file
        m<Enter>
        w          | does once save
        @saved     | not does quit
    ", r"
        :wq<Enter>
        qw
    ");

    save_and_quit_asks_for_a_missing_name_and_then_quits: ray().opened(|opening| opening.path = None).table(r"
        jjjel{1}       | not does quit
        new.ray<Enter> | does once save new.ray
        @saved         | does quit
    ", r"
        :wq<Enter>
        qw
    ");

    quitting_during_a_save_of_unchanged_text_asks: ray().play(r"
        :w copy.ray<Enter>q | asks quit | loses copy.ray is still being written
    ");

    conflicts_are_decided_one_after_the_other: ray().play(r"
        jjjeljl
        @file sphere\n0 0 0 => sphere\n9 0 0 & 1.5 => 1.9 | asks conflict …
        mt<Enter> | lines 0.1 0 0, 1.9 // the radius
    ");

    another_failure_does_not_hide_why_a_save_failed: ray().play(r"
        jjjelw
        @failed scene.ray: no space left | dirty
        @fails the unsaved edits cannot be kept
        | says scene.ray: no space left; the unsaved edits cannot be kept
    ");

    the_backup_of_an_interrupted_save_is_named: scene("scene.ray", SCENE).play(r"
        | does find backups
        @backup .halflight-backup-1-2-scene.ray
        | says a save of scene.ray was interrupted: the previous content is in .halflight-backup-1-2-scene.ray; delete that file if you do not need it
    ");

    a_save_outdates_what_was_said_of_the_missing_file: ray().play(r"
        @says an earlier message
        @missing twice
        w
        @saved | says wrote scene.ray
    ");

    /// What is read of a file that is being written may be half of that.
    nothing_that_is_read_during_a_save_is_taken: for outcome in
        ["@saved 1 as scene.ray", "@refused", "@homeless none", "@failed full"]
    {
        ray().with("half", SCENE.replace("1.5", "1.7")).table(&r"
            jjjel
            @reading half
            {1}
            @changed         | not does read
            @elapsed settled | not does read
            :e<Enter>        | not does read
            @file half       | not does read | text save 1
            {outcome}        | does once read
            // It is read anew.
            @arrives         | does once read | text save 1 | not asks
        ".replace("{outcome}", outcome), r"
            w
            :w! ./scene.ray<Enter>
            :w! /a/link/of/it.ray<Enter>
        ");
    };

    /// Two windows: the other one saves between this one's save and its report.
    a_late_report_of_a_save_is_older_than_what_is_read_after_it: ray().play(r"
        jjjelw
        @file mine & 4 0 0 => 5 0 0
        @saved
        @file file | text file | saved file
        // Again in the same place: nobody else has changed this one.
        l
        @file file & 5 0 0\n1\n => 6 0 0\n1\n | not asks | lines 0.2 0 0, 6 0 0
    ");

    /// A save that waits begins at once when the one before ends.
    the_file_is_read_after_the_last_of_several_saves: ray().play(r"
        jjjelw
        lw
        @saved 1 | not does read
        @saved 2 | does read
    ");
}
