//! Changing the structure of scenes by keys: a text and keys in, a text out.

use super::scripts::{Stage, scene, scripts};
use super::*;

/// Three objects and two lights.
pub(super) const RAY: &str = "\
0.1 0.1 0.1
2
5 5 5  1 1 1 // the lamp
-5 5 5  1 1 1
3
// the moon
sphere 0 0 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1

sphere 4 0 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1
sphere 8 0 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1
";

pub(in crate::app::tests) const DAT: &str = "\
mat ID 1  1 1 1  .3 .5 .2 9  0 0 1
mat ID 2  1 0 0  .3 .5 .2 9  0 0 1
obj sphere ID 1 mat ID 1  0 0 0  1
obj sphere ID 2 mat ID 2  1 0 0  1
obj CSG ID 3 union ID 1 ID 2
obj sphere ID 4 mat ID 1  3 0 0  1
render 2 ID 3 ID 4
";

const GROUPED: &str = "\
<xml>
  <scene>
    <object name=\"group\">
      <object type=\"sphere\" name=\"a\"/>
    </object>
  </scene>
</xml>
";

const MOON: &str = "// the moon\nsphere 0 0 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1\n";
const SECOND: &str = "sphere 4 0 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1\n";
const THIRD: &str = "sphere 8 0 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1\n";

/// The stage of [`RAY`] with its objects by name.
fn ray<'s>() -> Stage<'s> {
    let stage = scene("scene.ray", RAY).with("moon", MOON);
    stage.with("second", SECOND).with("third", THIRD)
}

scripts! {
    ray_scenes_are_restructured_by_keys: ray().each(r"
        [object 2] d   | becomes {second} => & \n3\n => \n2\n
        [object 2] D   | becomes {second} => {second}\n{second} & \n3\n => \n4\n
        [object 3] D   | becomes {third} => {third}{third} & \n3\n => \n4\n
        [object 3] K   | becomes {second} => {third} & \n{third}{third} => \n{third}{second}
        [object 2] J   | becomes {second} => {third} & \n{third}{third} => \n{third}{second}
        [object 2] yjp | becomes {third} => {third}{second} & \n3\n => \n4\n
        [object 1] <Space><Space>d | becomes {moon} => & \n3\n => \n1\n & {second} =>
    ");

    a_field_is_set_in_all_marked_things: ray().play(r"
        [object 1] <Space><Space>kej2<Enter>
        | text sphere 0 0 0 1 => sphere 0 0 0 2 & 4 0 0 1 => 4 0 0 2 | undoes
    ");

    dat_scenes_are_restructured_by_keys: scene("scene.dat", DAT)
        .with("first", "obj sphere ID 1 mat ID 1  0 0 0  1\n")
        .with("second", "obj sphere ID 2 mat ID 2  1 0 0  1\n")
        .with("tree", "obj CSG ID 3 union ID 1 ID 2\n")
        .each(r"
        [object 1] dy   | becomes {first} => & {tree} => & 2 ID 3 ID 4 => 1 ID 4
        [material 2] dy | becomes mat ID 2  1 0 0  .3 .5 .2 9  0 0 1\n => & {second} => & {tree} => & 2 ID 3 ID 4 => 1 ID 4
        [object 1] R<Ctrl-u>9<Enter> | becomes sphere ID 1 => sphere ID 9 & union ID 1 => union ID 9
    ");

    the_written_thing_is_selected: {
        scene("scene.dat", DAT).each(r"
            [object 3] D   | at object 6
            [object 3] yGp | at object 7
        ");
        scene("scene.xml", GROUPED).each(r"
            [object 1] D   | at object 3
            [object 2] D   | at object 3
        ");
        ray().each(r"
            [object 2] D   | at object 3
            [object 2] K   | at object 1
            [object 2] J   | at object 3
            [object 2] d   | at object 2
            [object 3] d   | at object 2
            [light 1] D    | at light 2
            [object 1] yGp | at object 4
        ");
    };

    what_cannot_be_done_is_said_and_changes_nothing: {
        scene("a.ray", SCENE).each(r"
            [light 1] d | text opened | says the last light cannot be deleted: a .ray scene needs at least one
        ");
        ray().each(r"
            [view] y     | text opened | says view cannot be copied, moved or deleted
            [object 1] <Space><Space><Space>d
            | text opened | says the last object cannot be deleted: a .ray scene needs at least one
        ");
        scene("a.dat", DAT).each(r"
            [object 1] R<Ctrl-u>2<Enter> | text opened | says object 2 already exists
            [object 3] K | text opened | says object 3 (CSG) must stay after object 2 (sphere), which it uses
        ");
    };

    deleting_what_others_use_is_asked: scene("scene.dat", DAT).play(r"
        [material 2] d | asks delete: Delete material 2? 2 objects use it and will be deleted too.
        n              | text opened | not asks
    ");

    /// A key that is held deletes one thing; the next is asked about.
    a_key_struck_again_deletes_one_thing: ray().play(r"
        [object 1] dddd | nodes 7 | asks delete: Delete object 1 (…) as well?
        n               | nodes 7 | not asks
        dy              | nodes 6
        // What was chosen since is meant.
        kjd             | nodes 6 | asks
        n
        uu              | text opened
        [object 1] djd  | nodes 6 | not asks
    ");

    copied_text_goes_to_the_clipboard_and_pasted_text_becomes_things: ray()
        .with("copied", MOON.trim_end())
        .play(r"
        [object 1] y  | does copy … | writes copied
        [object 3]
        @paste {moon} | nodes 9 | text {third} => {third}{moon} & \n3\n => \n4\n
        @paste 1 2 3  | nodes 9
    ");

    messages_about_marked_things_count_and_name_them: {
        ray().each(r"
            [object 1] <Space>d        | says deleted: 1 marked item: object 1 (sphere); u brings it back
            [object 1] <Space><Space>d | says deleted: 2 marked items: object 1 (sphere), object 2 (sphere); u brings them back
            [object 1] <Space>jD       | says duplicated: 1 marked item: object 1 (sphere)
            [object 1] d               | says deleted: object 1 (sphere); u brings it back
        ");
        scene("scene.dat", DAT).play(r"
            [material 2] <Space>d      | asks delete: Delete 1 marked item: material 2…
        ");
    };

    marks_end_when_their_indices_belong_to_others: ray().with("other", SCENE).play(r"
        [object 2] <Space> | marks 1
        // The first Esc only shows all rows again.
        /sphere<Enter><Esc> | marks 1
        <Esc>              | not marks
        <Space>            | marks 1
        @file other        | not marks
    ");

    undo_and_redo_select_the_thing_that_they_change: ray().each(r"
        [object 2] du         | at object 2 | says undone: deleted object 2 (sphere)…
        [object 2] du<Ctrl-r> | at object 2 | says redone: deleted object 2 (sphere)…
        [object 2] Du         | at object 2 | says undone: duplicated object 2 (sphere)…
        [object 2] Du<Ctrl-r> | at object 3 | says redone: duplicated object 2 (sphere)…
    ");

    a_copied_combination_moves_as_a_whole: scene("scene.dat", DAT).play(r"
        [object 3] Dmx1<Enter>
        | text …\nobj sphere ID 5 mat ID 1  1 0 0  1\nobj sphere ID 6 mat ID 2  2 0 0  1\nobj CSG ID 7 union ID 5 ID 6\n…
    ");
}
