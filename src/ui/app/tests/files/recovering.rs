//! Keeping unsaved edits, and restoring those of earlier runs.

use super::scripts::{Stage, listed, ray, scripts};
use super::*;

const IS_FULL: &str = "unsaved edits cannot be kept for recovery: it is full";

/// The stage of [`SCENE`] with another radius, and the first sphere elsewhere. Kept edits are of
/// [`SCENE`].
fn changed<'s>(radius: &str, x: &str) -> Stage<'s> {
    let scene = SCENE.replace("1.5", radius);
    let scene = scene.replace("sphere\n0 0 0", &format!("sphere\n{x} 0 0"));
    listed(&scene).with("base", SCENE)
}

scripts! {
    unsaved_edits_are_kept_once_and_forgotten_when_none_are_left: ray().play(r"
        jjjel         | does wait keep 1000
        // A held key waits once.
        l             | not does wait keep
        @elapsed keep | does only keep edits of scene.ray | writes mine | over opened
        // The answer is awaited.
        @elapsed keep | not does
        @kept         | not does
        @elapsed keep | not does
        u             | does wait keep 1000
        @elapsed keep | does only forget edits
    ");

    keeping_edits_is_retried_after_a_failure: {
        let mut session = ray().with("full", IS_FULL).session();
        session.run("jjjel");
        for (seconds, says) in [
            (1, "says {full}"), (2, "not says"), (4, "not says"), (8, "not says"),
            (16, "not says"), (30, "not says"), (30, "not says"), (30, "not says"),
        ] {
            session.run(&format!("
                @elapsed keep       | does keep edits
                @unkept it is full  | does wait keep {seconds}000 | unkept | {says}
                @read-it
            "));
        }
        session.run(r"
            // New edits are not delayed that long.
            l                   | does wait keep 1000
            // A held key puts nothing off.
            l                   | not does wait keep
            @elapsed keep       | does keep edits
            @unkept it is full
            // Neither is the end.
            @hangup             | does keep edits
            @kept               | not unkept
        ");
    };

    edits_are_kept_once_more_at_the_end: ray().table(r"
        jjjel
        @elapsed keep | does keep edits
        @kept
        @elapsed keep | not does
        // The journal may have been removed by others.
        {1}           | does keep edits | writes mine
    ", r"
        @hangup
        @terminated
    ");

    messages_about_unkept_edits_disappear_once_they_are_kept: ray().with("full", IS_FULL).table(r"
        jjjel
        @elapsed keep
        @unkept it is full | says {full}
        {1}
        @elapsed keep      | does keep edits
        @kept              | {2} | not unkept
    ", r"
        @elapsed message  | not says
        @says another     | says another
    ");

    edits_count_as_kept_once_they_are: ray().play(r"
        jjjel
        @elapsed keep      | does keep edits
        l
        @elapsed keep      | does keep edits
        @kept 1
        // The second is on its way.
        @elapsed keep      | not does
        @unkept it is full
        @elapsed keep      | does keep edits | writes mine
    ");

    edits_made_while_the_scene_was_saved_are_kept_at_once: ray().play(r"
        jjjel
        @elapsed keep
        @kept
        w
        l
        @saved | does keep edits | writes mine
        w
        @saved | does forget edits
    ");

    kept_edits_can_be_restored_and_undone_or_discarded: ray().play(r"
        @offer 1.5 => 1.7
        j | says press r, d or Esc
        // The old journal is removed once the new one is written; others may be left.
        r | does adopt kept, keep edits, look for kept | text 1.5 => 1.7
        u | text opened

        @offer 1.5 => 1.7
        d | does drop kept, look for kept | text opened
    ");

    postponed_kept_edits_are_left_alone: ray().play(r"
        @offer 1.5 => 1.7
        <Esc>  | does only look for kept {offered}
        jjjelw | not does drop kept | not does adopt kept
        @saved | not does drop kept | not does adopt kept
        q      | not does drop kept | not does adopt kept
    ");

    a_file_that_has_changed_since_is_merged_with_kept_edits: changed("1.5", "9").play(r"
        @offer base & 1.5 => 1.7 | asks recover 1 0
        r | text 1.5 => 1.7 | says …merged…
        w | over opened
        // No undo takes the file's change back.
        u | text opened
    ");

    conflicts_between_kept_edits_and_the_file_are_asked_about: changed("1.9", "9").table(r"
        @offer base & 1.5 => 1.7 | asks recover … 1
        {1} | text {2} | saved opened | {3} | {4} drop kept
        u   | text opened
    ", r"
        r<Enter>  | opened     | asks     | not does
        rm<Enter> | 1.9 => 1.7 | not asks | not does
        rM<Enter> | 1.9 => 1.7 | not asks | not does
        rt<Enter> | opened     | not asks | does
        rT<Enter> | opened     | not asks | does
        r<Esc>    | opened     | not asks | not does
    ");

    an_offer_follows_the_file: changed("1.9", "9").table(r"
        @offer base & 1.5 => 1.7
        {1}
        @file 1.9 => 1.6 | does look for kept | not asks
        // The answer is outdated by now.
        @offer again     | does look for kept | not asks
    ", r"
        @elapsed message
        r
    ");

    one_question_is_asked_at_a_time: ray().play(r"
        jjjelq
        @offer 1.5 => 1.7 | asks quit
        n | asks recover…
        r | text 1.5 => 1.7 & \n0 0 0 => \n0.1 0 0
    ");

    complaints_about_kept_edits_are_shown: ray().play(r"
        @complains a is damaged                | shown a is damaged
        @read-it
        @complains a is damaged                | not shown
        @complains a is damaged; b is a pipe   | shown b is a pipe
        @read-it
        @complains c; d; e                     | shown e; and 2 more
    ");
}
