//! Showing lights and objects alone in the preview.

use super::listing::XML;
use super::scripts::{Stage, scene, scripts};
use super::structure::{DAT, RAY};

/// The stage of three objects and two lights, the second of which is red.
fn ray<'s>() -> Stage<'s> {
    scene("a.ray", RAY).but("-5 5 5  1 1 1 => -5 5 5  1 0 0")
}

scripts! {
    objects_are_shown_alone_by_their_numbers_in_the_scene: {
        let script = "[{1}] {2} | alone {3} | job objects {4} | solo | text opened";
        ray().table(script, r"
            object 2 | l | 1 | 1
            object 1 | <Space><Space>l | 0 1 | 2
        ");
        scene("a.dat", DAT).table(script, r"
            object 3 | l | 0 | 1
            object 4 | l | 1 | 1
        ");
        let another = r"<scene>\n => <scene>\n<object type='sphere' name='first'/>\n";
        scene("a.xml", XML).but(another).table(script, r"
            object 2 | l | 1 2 | 2
            object 3 | l | 1 | 1
        ");
    };

    l_again_shows_everything: for (name, text, node) in [
        ("a.ray", RAY, "object 2"),
        ("a.dat", DAT, "object 3"),
        ("a.xml", XML, "object 2"),
    ] {
        scene(name, text).play(&format!(r"
            [{node}] l
            l | does trace preview | not alone | says everything is shown again
        "));
    };

    what_is_shown_alone_follows_the_selection_and_ends_with_its_indices: ray().play(r"
        [object 1] l
        jl   | alone 1
        d    | does trace preview | not alone | not solo
        // The view ends it as well.
        lggl | not solo
    ");

    what_cannot_be_shown_alone_is_said: {
        ray().play(r"
            [view] l     | says only lights, objects and groups can be shown alone | not solo
        ");
        scene("a.dat", DAT).play(r"
            [object 1] l | says object 1 (sphere) is not drawn: h shows it | not solo
        ");
    };

    /// The renderer calls the only object by its number.
    picking_in_a_picture_of_one_object_selects_it: ray().play(r"
        [object 3] l
        @shows 2    | under object 3
        @shows none | not under
    ");

    a_light_is_shown_alone_in_the_preview_and_nowhere_else: ray().play(r"
        [light 2] l | reds 0 0 1 | text opened
        <F5>        | reds 0.1 1 1
        <Esc>
        l           | reds 0.1 1 1
        // The light is gone.
        ld          | not solo
    ");
}
