//! Inspecting pixels, and walking through the rays behind them.

use super::scripts::{Stage, scene, scripts};
use super::*;
use crate::app::inspect;
use language::Node;

/// A mirror in front of the camera; a second sphere is seen in it and stands in the way of a light.
const MIRROR: &str = "\
// view: eye 0 0 8 target 0 0 0 up 0 1 0 fov 60
0.1 0.1 0.1
2
0 9 9  1 1 1
9 0 0  1 1 1
2
sphere 0 0 0 2  .1 .1 .1 .4 .4 .4 .5 .5 .5 9 0.5 0 1
sphere 3 0 2 1  .1 .1 .1 .4 0 0 0 0 0 9 0 0 1
";

/// The stage of a text with a finished preview.
fn finished<'s>(name: &str, text: &str) -> Stage<'s> {
    scene(name, text).after("@traced preview")
}

fn mirror<'s>() -> Stage<'s> {
    finished("a.ray", MIRROR)
}

/// The stage of an explanation of the pixel right of the middle, where the mirror shows the second sphere.
fn explained<'s>() -> Stage<'s> {
    mirror().after("@traced preview\niLe\n@explained")
}

scripts! {
    inspecting_begins_and_ends_where_it_was_called: {
        mirror().table(r"
            {1}   | mode {2} | seen {3}
            i     | mode INSPECT | seen {3}
            <Esc> | mode {2} | seen {3}
        ", r"
            k    | SELECT   | preview
            v    | VIEW     | preview
            vF   | VIEW FLY | preview
            <F5> | TRACE    | full
        ");
        mirror().play("ei | mode EDIT");
    };

    the_pixel_under_the_cross_is_described: {
        let mut session = mirror().session();
        session.run("i");
        let shared = &session.app.shared;
        let pixel = inspect::pixel(shared).expect("there is a picture");
        assert_eq!(pixel.at, [pixel.size.width / 2, pixel.size.height / 2]);
        assert_eq!((pixel.node, pixel.line), (Ok(Some(Node::Object(0))), Some(7)));
        assert_eq!((pixel.value, pixel.colour), (Some([0.5, 0.25, 2.0]), Some([9; 3])));
        assert_eq!(pixel.samples, 1);
        let first = pixel.first.and_then(|first| first.surface);
        assert_eq!(first.map(|surface| surface.object), Some(0));
        assert_eq!(pixel.output.map(|(_, size)| size), Some(shared.output()));
        session.run(&"L".repeat(99));
        let pixel = inspect::pixel(&session.app.shared).expect("there is a picture");
        assert_eq!((pixel.at[0], pixel.node), (pixel.size.width - 1, Ok(None)));
    };

    the_cross_follows_keys_and_the_mouse: mirror().play(r"
        i    | cross 43,32
        l    | cross 44,32
        j    | cross 44,33
        L    | cross 52,33
        K    | cross 52,25
        HhJk | cross 43,32
        @down picture 3,2 | cross-cell 3,2 | mode INSPECT
        @drag picture 5,4 | cross-cell 5,4 | mode INSPECT
    ");

    a_zoomed_picture_follows_the_cross: {
        let mut session = mirror().session();
        session.run(":zoom 4<Enter>i\n@note edge top-left");
        for said in ["h", "L"] {
            let steps = format!("{said} | cross-cell\n").repeat(99);
            session.run(&steps).run("| not top-left {edge}");
        }
    };

    an_explanation_is_asked_for_once_and_only_the_newest_is_shown: mirror().play(r"
        ie           | context Rays | does explain preview 43,32
        jk           | not does explain
        <Esc>lle     | does explain preview 45,32
        @explained 1 | not explained
        @explained 2 | explained 45,32 sample 0
        <Esc>        | context In(Inspect)
    ");

    a_line_selects_its_object_or_light_or_opens_its_place: explained().table(r"
        {1}     | ray-of {2}
        E       | does only edit a.ray at {3}
        <Enter> | mode SELECT | at {2}
    ", r"
        k    | object 1 | 7
        jjjj | object 2 | 8
        jj   | light 1  | 4
        jjj  | light 2  | 5
    ");

    the_editor_opens_at_what_is_under_the_cross_otherwise_at_the_selected_item: mirror().table(r"
        {1}
        E | does only edit a.ray at {2}
    ", r"
        ggi       | 7
        ggiHHHHHH | 1
    ");

    the_light_of_a_line_is_soloed_and_explained_again: explained().play(r"
        l    | not solo | says …works on the line of a light…
        jjjl | ray-of light 2 | solo | reds 0 0 1 | not alone
    ");

    rays_are_folded_and_walked_through: explained().play(r"
        | rays 8
        <Left>         | rays 1
        <Right><Right> | rays 8 | ray 1
        <Left>         | ray 0
        G              | ray 7
    ");

    every_language_has_a_verdict_and_its_sum: for (name, text) in [
        ("a.ray", MIRROR),
        ("a.dat", Language::Dat.template()),
        ("a.xml", Language::Xml.template()),
    ] {
        let mut session = finished(name, text).session();
        session.run("ie\n@explained | verdict");
        let shared = &session.app.shared;
        let explanation = inspect::explanation(shared).expect("an answer");
        let sum = inspect::ray_lines(shared)[0].adds(explanation);
        assert!((sum - explanation.radiance).length() < 1e-12, "{name}");
        assert!(!inspect::ray_path(shared).is_empty(), "{name}");
    };

    samples_are_walked_through_as_far_as_there_are_some: mirror().table(r"
        ie
        @traced preview 3
        {1}
        @explained | explained … sample {2}
    ", r"
        .     | 1
        ...   | 2
        ...,  | 1
        .,,,, | 0
    ");
}
