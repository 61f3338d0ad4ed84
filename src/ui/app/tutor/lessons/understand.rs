//! The lesson in mending scenes: each is broken, and is judged by its picture.

use super::super::goals;
use super::step::{Lesson, Step};
use crate::app::CarriedScene;
use language::Language;

/// A broken scene.
const fn broken(name: &'static str, text: &'static str) -> CarriedScene {
    let language = Language::Dat;
    CarriedScene {
        name,
        language,
        text,
    }
}

const BULB: CarriedScene = broken("the dark room", include_str!("bulb.dat"));

pub(super) const UNDERSTAND: Lesson = Lesson {
    name: "understand",
    scene: BULB,
    steps: STEPS,
    after: "All four are mended. On your own scenes, {inspect} {explain} says why a pixel is as it is, and \
            halflight check FILE finds such faults without a picture.",
};

const STEPS: &[Step] = &[
    Step::new(
        "1: a lamp hangs over a ball, yet the room is dark. Ask a dark pixel: {inspect}, the cross onto the \
         floor, then {explain}. Mend the scene until the picture is bright.",
        "Light 1 is inside object 3, its bulb: move one of them.",
        goals::is_lit,
        "<Esc><Esc> | > [light 1]e | > @field position | > 3<Enter> | > @rendered preview",
    ),
    Step::new(
        "2: a spotlight over the ball, and all is dark again. Where does it point? Mend it.",
        "The direction of light 1 is 0 0 1, straight up. Down is 0 0 -1.",
        goals::is_lit,
        "<Esc><Esc> | > [light 1]e | > @field direction | > <Tab><Tab>HH | > @rendered preview",
    )
    .on(broken("the lamp that looks away", include_str!("spot.dat"))),
    Step::new(
        "3: this text has an error. {errors} lists it: read it, go there with Enter, and mend it.",
        "Material 5 is not defined. Give the ball one that is: 1 or 2.",
        goals::has_no_errors,
        "<Esc><Esc> | > [object 2]e2<Enter> | > @rendered preview",
    )
    .on(broken("the ball of nothing", include_str!("missing.dat"))),
    Step::new(
        "4: the ball should be clear glass, with the red wall seen through it. It is a mirror. Explain one of \
         its pixels, and mend its material.",
        "Kt is let through, Kr is reflected: material 1 has them swapped.",
        goals::is_seen_through,
        "<Esc><Esc> | > [material 1]e | > @field Kt | > 0.9<Enter> | > @field Kr | > 0.05<Enter> \
         | > @rendered preview",
    )
    .on(broken("the glass that is a mirror", include_str!("glass.dat"))),
];
