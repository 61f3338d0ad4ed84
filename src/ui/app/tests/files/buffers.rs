//! The buffer of an editor as the outside text.

use super::scripts::{Stage, ray, scripts};

/// A scene that an editor has open, which takes edits and shows places.
fn edited<'s>() -> Stage<'s> {
    ray().after(
        r"
        ggj
        @buffer opened edits shows
        @typed 0 opened
    ",
    )
}

scripts! {
    an_open_buffer_is_named_on_screen: ray().play(r"
        @buffer opened edits | buffer nvim
        @typed 0 opened      | not dirty | buffer nvim
        @typed 1 1.5 => 1.7  | text file | not dirty | not says | buffer nvim*
        @buffer saved        | buffer nvim
        @buffer closed       | not says | not buffer
    ");

    /// Unfinished words are not errors at once, and corrected ones vanish at once.
    errors_appear_once_the_text_rests: edited().play(r"
        @typed 1 1.5 => x  | does wait settled 200 | not errors | text opened
        @typed 2 1.5 => x0 | does wait settled 200 | not errors
        @elapsed settled   | does read scene.ray
        @typed 2 1.5 => x0 | errors 1 | text file
        @typed 3 1.5 => 1.8 | not errors | text file
        // What is known already is shown at once, and here again.
        @typed 4 1.5 => x
        @elapsed settled
        @typed 4 1.5 => x                | errors 1
        @typed 5 1.5 => x & 0.50 => 0.5  | errors 1 | text file
    ");

    edits_go_to_the_editor_once_they_rest: edited().play(r"
        jjjel             | does wait push 100 | dirty | text 0 0 0 => 0.1 0 0
        l                | does wait push 100
        @elapsed push    | does first edit version 0: 49..49→.2, wait push 3000
        @answered 0 made 0
        @typed 1 mine    | not dirty | not does edit…

        // What is done meanwhile follows in the next message.
        jjjel
        @elapsed push
        l                   | not does wait push 100
        @answered 0 made 0
        @typed 1 0 0 0 => 0.1 0 0 | dirty | does wait push 100 | text 0 0 0 => 0.2 0 0
        @elapsed push       | does first edit version 1: 50..51→2, wait push 3000
    ");

    /// What the editor makes of an edit is the text.
    an_edit_that_is_formatted_is_no_conflict: edited().play(r"
        jjjel
        @elapsed push
        @answered 0 made 0
        @typed 1 0 0 0 => 0.10 0 0 | text file | not dirty | not asks

        // The answer may come later than the text.
        jjjel
        @elapsed push
        @typed 1 0 0 0 => 0.10 0 0 | not asks | dirty
        @answered 0 made 1         | does read scene.ray
        @typed 1 0 0 0 => 0.10 0 0 | text file | not dirty | not asks

        // What was undone meanwhile is undone there too.
        jjjel
        @elapsed push
        u                         | not dirty
        @typed 1 0 0 0 => 0.1 0 0 | text opened
        @answered 0 made 1
        @typed 1 0 0 0 => 0.1 0 0 | text opened | dirty | does wait push 100
    ");

    /// What was typed meanwhile is no reason to take edits back.
    refused_edits_are_sent_again_and_then_taken_back: edited().play(r"
        jjjel
        @elapsed push
        @answered 0 refused 1 | does read scene.ray, wait push 100
        @typed 1 1.5 => 1.7   | text 0 0 0 => 0.1 0 0 & 1.5 => 1.7 | dirty
        @elapsed push         | does first edit version 1: 49..49→.1, wait push 3000
        @answered 1 refused 1 | dirty | does read scene.ray, wait push 100
        @elapsed push         | does first edit version 1: 49..49→.1, wait push 3000
        @answered 1 refused 1 | text 1.5 => 1.7 | not dirty | says nvim did not take the change…
        u                     | text 0 0 0 => 0.1 0 0 & 1.5 => 1.7 | dirty

        // An editor that does not answer.
        jjjel
        @elapsed push | > @elapsed push | does wait push 100
        @elapsed push | does first edit version 0: 49..49→.1, wait push 3000
        @elapsed push | not dirty | says nvim did not take the change…
    ");

    conflicts_are_asked_about_as_those_of_the_file: edited().play(r"
        jjjel
        @typed 1 0 0 0 => 9 0 0 | asks conflict 0 0.1 9 | not does wait push 100
        t<Enter>                | text file | not dirty

        jjjel
        @typed 1 0 0 0 => 9 0 0 | asks conflict 0 0.1 9
        // A postponed question returns.
        <Esc> | not asks | > w  | not says save in nvim | does read scene.ray
        @typed 1 0 0 0 => 9 0 0 | asks conflict 0 0.1 9
        m<Enter>                | text 0 0 0 => 0.1 0 0 | dirty | does wait push 100
        @elapsed push           | does first edit version 1: 48..49→0.1, wait push 3000
    ");

    /// Undo belongs to whoever made the change.
    own_steps_are_undone_until_something_newer_touches_their_place: edited().play(r"
        jjjeljl
        @elapsed push
        @answered 0 made 0
        @typed 1 mine
        @typed 2 mine & 4 0 0 => 5 0 0 | not dirty
        u | says undone: object 1 (sphere) radius: 1.5 → 1.6 | lines 0.1 0 0, 5 0 0
        u | lines 5 0 0
        u | says undo in nvim
        <Ctrl-r>          | lines 0.1 0 0, 5 0 0
        @typed 3 0 0 0 => 7 0 0 & 4 0 0 => 5 0 0 | not asks | lines 7 0 0, 5 0 0

        jjjel
        @elapsed push
        @answered 0 made 0
        @typed 1 mine
        @typed 2 0 0 0 => 0.15 0 0 | text file
        u                          | says undo in nvim | text file
        <Ctrl-r>                   | says redo in nvim
    ");

    /// A word being typed keeps neither edits from the editor nor the picture from these.
    edits_reach_a_text_with_errors: edited().play(r"
        @typed 1 4 0 0 => 4 0 x
        @elapsed settled
        @typed 1 4 0 0 => 4 0 x | errors 1
        [object 1] el
        @elapsed push           | does first edit version 1: 49..49→.1, wait push 3000
        @answered 1 made 1
        @typed 2 mine           | not dirty | errors 1
    ");

    saving_and_opening_are_the_editors: edited().play(r"
        w    | says save in nvim | not does save…
        :w<Enter>  | says save in nvim
        :w!<Enter> | says save in nvim
        :w other.ray<Enter> | does save other.ray

        jjjE | does show 41..112 with focus

        @buffer opened edits
        @typed 0 opened
        jjjE | says line 6 in nvim
    ");

    leaving_waits_for_the_editor_to_have_the_last_change: edited().play(r"
        jjjel
        q              | says will leave once nvim has the last change… | not does quit
        @elapsed push
        @answered 0 made 0
        @typed 1 mine  | does quit

        // Edits that are taken back are not to be lost.
        jjjel
        q
        @elapsed push
        @answered 0 refused 0
        @elapsed push
        @answered 0 refused 0 | says nvim did not take the change… | not does quit
    ");

    another_file_is_not_the_editors: edited().play(r"
        :w other.ray<Enter>
        @saved | not buffer
        [object 1] el
        w      | does save other.ray
    ");

    /// The editor keeps the focus where it is.
    a_click_in_the_picture_shows_the_line: edited().play(r"
        @shows half
        @down picture 2,2 | at object 2 | does show 113..165

        // Of an editor that cannot be asked.
        @buffer opened edits
        @typed 0 opened
        @shows half
        @down picture 2,2 | at object 2 | not does show 113..165
    ");

    an_editor_without_edits_is_only_followed: ray().play(r"
        @buffer opened
        @typed 1 1.5 => 1.7 | text file
        jjjel               | dirty | not does wait push 100
        w                   | does save scene.ray
    ");

    the_editors_cursor_selects: edited().play(r"
        @cursor 122 0  | at object 2
        @cursor 49 0  | at object 1
        // In a text that is not here yet.
        @cursor 122 1  | at object 1
        :
        @cursor 122 0  | at object 1
    ");

    a_text_whose_editor_is_gone_is_kept_as_unsaved_edits: edited().play(r"
        @typed 1 1.5 => 1.7
        @buffer left | does read scene.ray
        @kept-by 1 1.5 => 1.7 | dirty | text file | does forget buffer… | says nvim ended without closing the scene…
        w | does save scene.ray

        @buffer left
        @kept-by 0 opened | not dirty | says nvim ended

        // A closed one is discarded.
        @typed 1 1.5 => 1.7
        @buffer closed
        @file opened | text opened | not dirty
    ");

    following_is_chosen: ray().play(r"
        :follow saving<Enter>  | does follow buffers saving
        :follow typing<Enter>  | does follow buffers typing
        :follow<Enter>         | says :follow needs typing or saving
        @buffer opened edits unfollowed
        @file 1.5 => 1.7       | text file | says reloaded…
        jjjel                  | dirty | not does wait push 100
        w                      | does save scene.ray
    ");
}
