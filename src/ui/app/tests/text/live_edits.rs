//! Cancelling what is tried out while the file changes.

use super::scripts::{ray, scene, scripts};
use super::*;
use crate::app::text;
use ::text::{Edit, Span};

scripts! {
    /// Only the change of the file is there then.
    what_is_tried_out_can_be_cancelled_after_a_merge: {
        let script = r"
            [object 1] {1} | not text opened
            @file {2}      | not text file
            <Esc>          | text file | says …cancelled… | not errors
        ";
        scene("a.ray", SCENE).table(script, r"
            mx3           | 4 0 0 => 5 0 0
            ejjjcjL       | 4 0 0 => 5 0 0
        ");
        scene("a.dat", dat::SCENE).table(script, "e<Enter><Down> | 3 0 0 => 5 0 0");
    };

    what_cannot_be_cancelled_after_a_merge_says_so: ray().play(r"
        [object 1] mx3
        @file 4 0 0 => 5 0 0
        @file 4 0 0 => 6 0 0
        @note now text
        <Esc> | text now | says …is kept…
    ");
}

/// Every attempt begins with the meaning of the text before the first one.
#[test]
fn an_attempt_keeps_nothing_of_the_one_before() {
    let text = "// view: eye 0 0 9 target 0 0 0\n.1 .1 .1  1  0 5 5  1 1 1  2\n\
        sphere 1 0 0 1  1 0 0  0 1 0  0 0 1  20 0 0 1\n\
        sphere 4 0 0 1  1 0 0  0 1 0  0 0 1  20 0 0 1\n";
    let put = |old: &str, new: &str| {
        let at = text.find(old).expect("it is there");
        Edit {
            span: Span::new(at, at + old.len()),
            text: new.to_owned(),
        }
    };
    let eye = || put("0 0 9", "0 0 8.5");
    let light = || put("0 5 5", "0 5.25 5");
    let [first, second] = [put("1 0 0 1", "2 0 0 1"), put("4 0 0 1", "5 0 0 1")];
    let mut app = open(text);
    let mut live_edit = text::begin_live_edit(&mut app.shared);
    for edits in [
        vec![eye(), first.clone()],
        vec![eye()],
        vec![light(), second.clone()],
        vec![light()],
        vec![first],
        vec![second],
        vec![eye()],
    ] {
        let tried = text::try_instead(&mut app.shared, &mut live_edit, |_| Ok(edits.clone()));
        assert_eq!(tried, Ok(()));
        let fresh = open(app.shared.document.text());
        assert_eq!(app.shared.scene, fresh.shared.scene, "{edits:?}");
    }
    text::end_live_edit(&mut app.shared, live_edit);
    assert_eq!(app.shared.scene, open(text).shared.scene);
}
