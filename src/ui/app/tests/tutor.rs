//! Lessons: every step is done by its script, and no earlier; its words fit.

use super::scripts::{ray, scripts};
use crate::app::tutor::{LESSONS, shown};
use crate::text_width::wrap;

/// The names of actions that words have in braces.
fn actions(words: &str) -> impl Iterator<Item = &str> {
    let parts = words.split('{').skip(1);
    parts.map(|part| part.split_once('}').expect("a brace is closed").0)
}

#[test]
fn every_step_is_done_by_its_script_and_its_words_fit() {
    for lesson in LESSONS {
        let mut session = ray().session();
        session.run(&format!(
            ":tutor {}<Enter>\n@note opened text\n@rendered preview",
            lesson.name
        ));
        for (at, step) in lesson.steps.iter().enumerate() {
            session.run(&format!(
                "| lesson …step {} of {}",
                at + 1,
                lesson.steps.len()
            ));
            session.run("| not hint\n@elapsed lesson | hint");
            let shown = shown(&session.app.tutor, &session.app.shared).expect("it is taught");
            let lines = wrap(&shown.words, 80);
            assert!(lines.len() <= 2, "{lines:#?}");
            let hint = shown.hint.expect("it is due");
            assert!(hint.chars().count() <= 74, "{hint}");
            for action in actions(step.words).chain(actions(step.hint)) {
                let key = session.app.shared.key_for(action);
                assert!(
                    key.chars().count() == 1 || key.chars().any(char::is_uppercase),
                    "{action}: {key}"
                );
            }
            session.run(step.script);
        }
        session.run("| lesson …done");
    }
}

scripts! {
    a_step_names_the_bound_keys: ray().play(r"
        @bind select Q: edit
        :tutor edit<Enter> | lesson …step 1… | task …blue block: j goes down…
        [object 1]jj       | task …Press Q to edit…
    ");

    a_lesson_is_kept_skipped_left_and_continued: ray().play(r"
        :tutor off<Enter>        | says No lesson is open…
        :tutor build<Enter>      | lesson …step 1… | does keep lesson build; step 0 | does wait lesson
        :tutor skip<Enter>       | lesson Lesson build, step 2… | does keep lesson build; step 1
        :tutor off<Enter>        | not lesson
        :tutor<Enter>            | lesson Lesson build, step 2…
        :tutor nothing<Enter>    | says No lesson `nothing`. Lessons: edit, build, understand
    ");

    a_lesson_asks_before_it_replaces_edits_and_begins_only_then: ray().play(r"
        [object 1]d:tutor<Enter> | asks open the lesson edit | not lesson
        n                        | not lesson | dirty
        :tutor edit<Enter>y      | lesson …step 1… | not path | not dirty
    ");

    another_riddle_can_be_undone: ray().play(r"
        :tutor understand<Enter>
        @note riddle text
        :tutor skip<Enter> | text …A spotlight over a ball…
        u                  | text riddle
    ");
}
