//! Keys that the user has bound.

use super::scripts::{Stage, ray, scripts};
use crate::app::command;

/// The stage with other keys for undoing, and none for what `u` did.
fn rebound<'s>() -> Stage<'s> {
    ray().after("ggj\n@bind anywhere u\n@bind anywhere Ctrl-X u: undo")
}

scripts! {
    a_bound_key_acts_and_the_one_it_replaces_does_not: rebound().play(r"
        jjjjd
        @note deleted text
        u         | text deleted | says u in SEQUENCE (T): undo the last key (? for keys)
        <Ctrl-x>u | text opened
    ");

    messages_name_the_bound_keys: {
        let mut session = ray().session();
        session.run("@bind select x\n@bind select F5\n@bind select r\n@bind select T: trace");
        let key_for = |name| session.app.shared.key_for(name);
        assert_eq!(["trace", "redo", "stop"].map(key_for), ["T", "Ctrl-R", ":cancel the export"]);
    };

    what_is_said_after_keys_names_the_bound_ones: ray().table(r"
        @bind {1}
        {2} | says {3}
    ", r"
        select Q: back   | <Space>       | 1 item marked; Q clears the marks
        select Q: back   | /light<Enter> | 1 of 1; Q shows all
        select Q: search | n             | nothing to search for: Q filters the list
        select Q: copy   | p             | nothing to paste: Q copies the selected item
        select Q: paste  | jjjy          | copied: object 1 (sphere); Q pastes it
        select Q: camera | m             | Q moves the camera
        select Q: solo   | jjjQ          | solo: object 1 (sphere) (Q to show all)
        move Q: accept   | jjjmw         | Q confirms the change first; Esc cancels it
    ");

    help_hints_and_palette_show_the_bound_keys: {
        let mut session = rebound().session();
        let found = command::found_in_help(&session.app.shared, "undo");
        assert_eq!(found[0].0.keys, "Ctrl-X u");
        session.run("jjjD | hints …Ctrl-X u undo, …\n:undo | completed undo [Ctrl-X u]; …");
    };
}
