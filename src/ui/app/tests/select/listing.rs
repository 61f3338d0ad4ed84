//! Showing a part of the list: filtering it and folding groups.

use super::super::SCENE;
use super::scripts::{scene, scripts};

const RAY: &str = "\
0.1 0.1 0.1
2
5 5 5  1 1 1 // sun
-5 5 5  1 1 1
3
sphere 0 0 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1 // moon
box 4 0 0  1 0 0  0 1 0  0 0 1  1 1 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1
sphere 8 0 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1
";

/// A drawn union, its parts, one of which is drawn, too, and another sphere.
const DAT: &str = "\
mat ID 1  1 1 1  .3 .5 .2 9  0 0 1
obj sphere ID 1 mat ID 1  0 0 0  1
obj sphere ID 2 mat ID 1  1 0 0  1
obj sphere ID 4 mat ID 1  3 0 0  1
obj CSG ID 3 union ID 1 ID 2
obj CSG ID 5 union ID 3 ID 4
render 2 ID 5 ID 2
";

pub(super) const XML: &str = "\
<xml><scene>
  <object name='pair'>
    <object name='inner'><object type='sphere' name='a'/></object>
    <object type='sphere' name='b'/>
  </object>
  <object type='sphere' name='c'/>
</scene></xml>
";

const REST: &str = "render, view, ambient, light 1, light 2";

scripts! {
    the_object_in_the_middle_is_selected_at_first_rather_than_what_is_around_the_camera: {
        scene("a.ray", SCENE).play("| at object 1");
        let xml = "<xml><scene><object type='sphere' name='sky'><scale x='90' y='90' z='90'/></object>
            <object type='sphere' name='ball'/></scene>
            <camera><position z='9'/><target z='0'/></camera></xml>";
        scene("a.xml", xml).play("| at object 2");
        // Nothing is in the middle.
        scene("a.ray", "0 0 0 0 0").play("| at ambient");
    };

    the_list_is_filtered_while_typing: scene("a.ray", RAY).after("ggjjjjj")
        .with("first", format!("{REST}, >object 1 (sphere), object 2 (box), object 3 (sphere)"))
        .with("second", format!("{REST}, object 1 (sphere), >object 2 (box), object 3 (sphere)"))
        .with("third", format!("{REST}, object 1 (sphere), object 2 (box), >object 3 (sphere)"))
        .play(r"
        | list {first}
        /             | list {first}
        b             | list ambient, >object 1 (sphere), object 2 (box), object 3 (sphere)
        ox            | list >object 2 (box)
        <Back>        | list >object 2 (box)
        <Back>        | list ambient, >object 1 (sphere), object 2 (box), object 3 (sphere)
        <Back><Back>  | list {first}
        // The empty line closes on Backspace; comments count, too.
        /MOON<Enter>  | list >object 1 (sphere)
        /sphere       | list >object 1 (sphere), object 3 (sphere)
        <Down>        | list object 1 (sphere), >object 3 (sphere)
        <Enter>n      | list >object 1 (sphere), object 3 (sphere)
        N             | list object 1 (sphere), >object 3 (sphere)
        kk            | list >object 1 (sphere), object 3 (sphere)
        <Esc>         | list {first}
        n             | list {third}
        /xyz          | not list
        <Enter>       | list {third}
        k             | list {second}
        /light<Esc>   | list {second}
        :q           | text opened
    ");

    groups_of_matches_are_listed: scene("a.xml", XML).play(r"
        /a (     | list pair (group), inner (group), >a (sphere)
        <Enter>j | list pair (group), inner (group), >a (sphere)
        k<Left>  | list pair (group), >inner (group), a (sphere)
    ");

    a_filter_follows_the_text: scene("a.ray", RAY).after("ggjjjjj").with("rest", REST).play(r"
        /sphere<Enter>D | list object 1 (sphere), >object 2 (sphere), object 4 (sphere)
        d               | list object 1 (sphere), >object 3 (sphere)
        // Another type no longer matches; the next match is selected.
        ggj
        @reads a.ray sphere 0 0 0 1 => box 4 0 0  1 0 0  0 1 0  0 0 1  1 1 1 | list >object 3 (sphere)
        // Nothing is left of it: all are listed.
        d               | list {rest}, …
    ");

    selecting_what_the_filter_hides_ends_it: scene("a.ray", RAY).after("ggjjjjj").with("rest", REST).play(r"
        /box<Enter> | list …object 2 (box)…
        [object 1]  | list {rest}, …
    ");

    groups_are_folded_and_unfolded: scene("a.xml", XML)
        .with("rest", "render, view, background, environment, ")
        .play(r"
        | list {rest}>pair (group), inner (group), a (sphere), b (sphere), c (sphere)
        <Left>                | list {rest}>+pair (group), c (sphere)
        j                     | list {rest}+pair (group), >c (sphere)
        k<Right>j<Left>       | list {rest}pair (group), >+inner (group), b (sphere), c (sphere)
        // A folded group leads to the one that holds it.
        <Left><Left>          | list {rest}>+pair (group), c (sphere)
        <Right><Right>        | list {rest}pair (group), >+inner (group), b (sphere), c (sphere)
        <Right><Right>        | list {rest}pair (group), inner (group), >a (sphere), b (sphere), c (sphere)
        <Shift-Left>          | list {rest}>+pair (group), c (sphere)
        <Shift-Right>         | list {rest}>pair (group), inner (group), a (sphere), b (sphere), c (sphere)
        :q                    | text opened
    ");

    combined_objects_are_folded_unless_they_are_drawn_by_themselves: scene("a.dat", DAT)
        .with("rest", "render, view, material 1, ")
        .play(r"
        G<Left>       | list {rest}object 2 (sphere), >+object 5 (CSG)
        <Right>
        | list {rest}object 1 (sphere), object 2 (sphere), object 4 (sphere), object 3 (CSG), >object 5 (CSG)
        <Right><Left> | list {rest}object 2 (sphere), object 4 (sphere), >+object 3 (CSG), object 5 (CSG)
        :q            | text opened
    ");

    selecting_what_is_folded_unfolds_it_and_folds_outlive_edits: scene("a.xml", XML).play(r"
        <Left>jD   | list …, +pair (group), c (sphere), >c 2 (sphere)…
        u          | list …, +pair (group), >c (sphere)…
        [object 3] | list …, pair (group), inner (group), >a (sphere), …
    ");

    a_new_name_replaces_the_old_one_unless_that_is_edited: scene("a.xml", XML).each(r"
        Rball<Enter>     | text 'pair' => 'ball'
        R<Left>x<Enter>  | text 'pair' => 'paixr'
        R<Back>n<Enter>  | text 'pair' => 'pain'
        R<Enter>         | text opened
    ");
}
