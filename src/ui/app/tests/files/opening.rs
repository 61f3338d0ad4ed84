//! The interface before its scene is read.

use super::scripts::{Stage, scene, scripts};
use super::*;
use file::ReadError;

/// The stage of a file that is being read.
fn unread<'s>() -> Stage<'s> {
    scene("scene.ray", "").opened(|opening| opening.text = OpeningText::Unread(2_000_000_000))
}

scripts! {
    a_scene_is_read_after_its_watch_began_and_shown_as_if_known: {
        unread().with("ray", SCENE).play(r"
            | does only watch scene.ray, read scene.ray, find backups scene.ray
            @file ray | fresh | text ray | at object 1 | not opening | does trace preview | not dirty
            // Kept edits are looked for once it is read.
            | does look for kept | writes ray
        ");
        unread().play(r#"
            @file "no scene" | fresh | text "no scene" | at view | not opening | not does trace | not dirty

            @file ""         | fresh | text "" | at view | not opening | not does trace | not dirty
        "#);
    };

    actions_that_need_a_scene_are_refused_until_it_is_read: {
        unread().table("{1} | not does | shown still opening scene.ray", r"
            w
            b
            <F5>
            e
            E
            u
            5
            :w<Enter>
            :export a.bmp<Enter>
        ");
        unread().play("@paste 1 2 3 | shown | not dirty");
    };

    help_and_quitting_need_no_scene: unread().each(r"
        ?           | help | > q | not help
        q           | does only quit
        :q<Enter>   | does only quit
        <Ctrl-c>    | does only quit
        @terminated | does only quit
        @hangup     | does only quit
    ");

    a_scene_whose_file_is_missing_is_written_again: scene("scene.ray", "")
        .opened(|opening| opening.text = OpeningText::Kept(SCENE.to_owned()))
        .with("ray", SCENE)
        .play(r"
        | does look for kept | disk missing | text ray
        q | not does quit | loses scene.ray no longer exists
        w | does save scene.ray | writes ray
    ");
}

#[test]
fn an_unreadable_scene_ends_the_interface() {
    let mut session = unread().session();
    session.run("@missing | does only quit");
    let failure = session.app.shared.disk.take_failure();
    assert!(matches!(failure, Some(ReadError::NotFound { .. })));
}
