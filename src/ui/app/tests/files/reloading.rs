//! Numbers that another program changes in a long text.

use super::scripts::{Stage, listed, scripts};

/// Objects of a text that is long enough not to be parsed as a whole.
const OBJECTS: usize = 12_000;

fn long<'s>() -> Stage<'s> {
    let objects = (0..OBJECTS).map(|number| {
        let material = ".1 .1 .1  .45 .45 .45  .5 .5 .5  5 .5 0 1";
        format!("sphere {number} 0 0 0.75  {material} // a comment of some length\n")
    });
    let head = "// view: eye 0 0 9 target 0 0 0\n.1 .1 .1\n1\n5 5 5\n1 1 1\n";
    let objects: String = objects.collect();
    listed(&format!("{head}{OBJECTS} // objects\n{objects}"))
}

scripts! {
    numbers_of_one_object_are_taken_without_parsing_the_rest: long().play(r"
        @file mine & sphere 7 0 0 0.75 => sphere 7 0 0 0.5 | news numbers | not does read
        | says reloaded: object 8 (sphere) radius
        | text file | saved file | not dirty | not undoable | fresh
        @file mine & sphere 7 0 0 0.5 => sphere -1e1 0 0 0.25 | news numbers | not does read
        | says reloaded: object 8 (sphere)
        | text file | saved file | not dirty | not undoable | fresh
        @file mine & sphere 11999 0 => sphere 1199 0 | news numbers | not does read
        | says reloaded: object 12000 (sphere) centre x
        | text file | saved file | not dirty | not undoable | fresh
        @file mine | not news
    ");

    changes_of_more_than_numbers_of_one_object_are_taken: long().play(r"
        // Numbers of the header or a comment, for which no object is read again.
        @file mine & .1 .1 .1\n => .1 .1 .2\n  | news numbers | not does read | text file
        @file mine & eye 0 0 9 => eye 0 0 8    | news numbers | not does read | text file
        // White space behind numbers.
        @file mine & length\nsphere 5 0 0 0.75 => length\nsphere 5 0 0 0.75\s
        | news numbers | not does read | text file
        // Other text.
        @file mine & // objects => // 12000 objects | news other | not does read | text file
        @file mine & sphere 9 0 => Sphere 9 0  | news other | not does read | text file
        // A number with an error: the text is read as a whole, and waits for a correction.
        @note before text
        @file mine & sphere 7 0 0 0.75 => sphere 7 0 0 -1 | does read scene.ray
        @asked file | not does read
        | text before | saved before | not dirty | not undoable | fresh
    ");

    numbers_are_merged_with_unsaved_edits: long().play(r"
        jjjel
        @file opened & sphere 7 0 0 0.75 => sphere 7 0 0 0.5 | not does read
        | says merged… | text …sphere 7 0 0 0.5… | dirty
    ");
}
