//! Messages: none is lost before it could be read, and none outlives its cause.

use super::scripts::{ray, scripts};

scripts! {
    a_message_that_comes_while_another_is_shown_waits_for_a_key: ray().play(r"
        @says one
        @says two
        @says one | shown one
        j         | shown two
        j         | not shown
        // The answer to a key is shown first.
        @says three
        @says four
        X         | shown …is not bound… | past four; …
        j         | shown four
    ");

    a_message_makes_way_once_it_could_be_read_and_errors_go_first: ray().play(r"
        // Nothing waits.
        @fails a disk is full | not does wait message
        @read-it
        @says 0123456789
        @says saved
        @fails failed         | does wait message 2500
        @fails failed twice   | not does wait message | shown 0123456789
        @elapsed message      | shown failed | does wait message 2300
        @elapsed message      | shown failed twice | does wait message 2600
        @elapsed message      | shown saved | not does wait message
        @elapsed message      | shown saved | not does wait message
    ");

    of_an_amount_that_is_typed_the_last_is_remembered: ray().play(r"
        [object 1] s1.25 | shown scale: ×1.25 | past scale: ×1.25
        <Enter>          | shown scale: ×1.25 | past scale: ×1.25
        s1.5<Enter>      | past scale: ×1.5; scale: ×1.25
    ");

    a_trace_that_ends_out_of_sight_says_so: ray().play(r"
        <F5>
        @started full 1
        <Esc>
        @frame full 1    | says the full-size trace is finished; F5 shows it

        <F5>
        @started full 1
        @frame full 1    | not says
    ");

    a_long_message_is_not_shown_forever: {
        let mut session = ray().session();
        session.run(&format!("@says {}", "x".repeat(5000)));
        session.run("@says next\n@resize 120 40 | does wait message 8000");
    };

    a_timer_set_for_another_message_does_not_turn_this_one: ray().play(r"
        @says one
        @says two
        @resize 120 40
        j                | shown two
        @elapsed message | shown two
    ");

    messages_are_remembered_the_newest_first: {
        let mut session = ray().session();
        for number in 0..60 {
            session.run(&format!("@fails message {number}\nj"));
        }
        assert_eq!(session.app.shared.overlays.messages.past().count(), 50);
        session.run(r"
            | past message 59; message 58; …
            @fails a: Permission denied (os error 13) | past a: Permission denied; …
            Mjj   | history 2
            <Esc> | not history
        ");
    };

    a_message_about_errors_goes_when_they_are_corrected: ray().table(r"
        vh<Esc>
        @file twice sphere\n0 => sphär\n0 | errors
        {1}                               | says …error…
        @file opened                      | not errors | not says …error…
    ", r"
        vS
        <F5>
        :size 8x8<Enter>
    ");

    a_message_about_the_file_goes_when_the_file_can_be_read_again: ray().play(r#"
        @says one
        @missing twice         | past …no such file…
        @file opened
        j                      | shown the file matches the saved text again
        jjel<Esc>
        @file twice "nonsense" | shown …has an error…
        @file "{opened}\n"     | not shown …has an error…
    "#);

    a_message_that_files_are_polled_lasts_until_they_are_watched: ray().play(r"
        @polled scene the limit is reached (os error 24)
        | shown the limit is reached: polling scene.ray instead
        @polled track the limit is reached
        jk             | polls
        @polled scene  | polls
        @polled track  | not polls
        // A message that nobody has dismissed goes with its cause.
        @polled assets the limit is reached | shown …the scene's files…
        @polled assets | not shown
    ");

    a_missing_folder_is_not_told_to_be_written_to: ray().play(r"
        @no-folder twice | disk missing
        | shown /scenes: no such folder; save the scene elsewhere with :w FILE
        // The folder is there again, but not the file.
        @missing twice   | shown scene.ray: no such file; press w to write it again
    ");
}
