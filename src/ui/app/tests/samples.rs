//! The page of the sample scenes.

use super::scripts::{Session, ray, scripts};

/// A session in colours, without which the page has no pictures.
fn coloured() -> Session {
    let mut session = ray().session();
    session.app.shared.has_colours = true;
    session
}

scripts! {
    samples_are_traced_one_after_the_other_and_a_copy_is_opened: coloured().run(r"
        :samples<Enter> | does derive 0
        @derived        | does trace thumbnail
        j<Enter>        | not path | not dirty | text …// Lighting… | does stop thumbnail
    ");

    a_page_that_is_closed_asks_for_nothing: coloured().run(r"
        :samples<Enter> | > <Esc> | does stop thumbnail
        @derived        | not does trace thumbnail
    ");

    unsaved_edits_are_asked_about_first: ray().play(r"
        [object 1]d
        :samples<Enter><Enter> | asks open default.ray | > n | dirty
        :samples<Enter><Enter>y | not dirty | not path
    ");
}
