//! Messages: none is lost before it could be read, and none outlives its cause.

use super::rows::{ray, scripts};
use super::*;
use crate::file::ReadError;
use crate::ui::msg::{Polled, Timer};

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
}

#[test]
fn a_message_that_files_are_polled_lasts_until_they_are_watched() {
    let reason = || Some("the limit is reached (os error 24)".to_owned());
    let mut session = ray().session();
    let mut polled = |files, reason, checks: &str| {
        session.app.update(Msg::Polled(files, reason));
        session.run(checks);
    };
    polled(
        Polled::Scene,
        reason(),
        "| shown the limit is reached: polling scene.ray instead",
    );
    polled(Polled::Track, reason(), "jk | polls");
    polled(Polled::Scene, None, "| polls");
    polled(Polled::Track, None, "| not polls");
    // A message that nobody has dismissed goes with its cause.
    polled(Polled::Assets, reason(), "| shown …the scene's files…");
    polled(Polled::Assets, None, "| not shown");
}

#[test]
fn a_missing_folder_is_not_told_to_be_written_to() {
    let mut session = ray().session();
    for _ in 0..2 {
        let folder = PathBuf::from("/scenes");
        let error = ReadError::NoFolder { folder };
        session
            .app
            .update(Msg::Read(PathBuf::from("scene.ray"), Err(error)));
        session.app.update(Msg::Elapsed(Timer::Settled));
    }
    session.run(
        r"
        | disk missing
        | shown /scenes: no such folder; save the scene elsewhere with :w FILE
        // The folder is there again, but not the file.
        @missing twice | shown scene.ray: no such file; press w to write it again
    ",
    );
}
