//! The lesson in making a scene.

use super::super::goals;
use super::step::{Lesson, Step};
use crate::app::CarriedScene;
use language::Language;

pub(super) const BUILD: Lesson = Lesson {
    name: "build",
    scene: CarriedScene {
        name: "the lesson build",
        language: Language::Ray,
        text: include_str!("edit.ray"),
    },
    steps: STEPS,
    after: "You have built a scene. Next: :tutor understand mends broken ones; {track} plays a track, and \
            {trace} traces at full size.",
};

const STEPS: &[Step] = &[
    Step::new(
        "{command} opens the command line. Start a new scene: type new after the colon and press Enter. The \
         scene is in memory until you save it.",
        "Press {command}, type new, press Enter.",
        goals::has_started_anew,
        ":new<Enter>",
    ),
    Step::new(
        "{add} adds something. Choose a cone: type its first letters, or go there with the arrows, and press \
         Enter.",
        "Press {add}, type cone, press Enter.",
        goals::has_added,
        "acone<Enter>",
    ),
    Step::new(
        "It is selected. Press {move} to move it.",
        "The mode at the left of the last line must say MOVE.",
        goals::moves,
        "m",
    ),
    Step::new(
        "Move it with the arrows, or type how far: x 1.5 moves it along x. Enter keeps the place, Esc does not.",
        "Press an arrow a few times, then Enter.",
        goals::has_changed,
        "l<Enter>",
    ),
    Step::new(
        "{scale} scales: type a factor such as 1.5, or use the arrows, and press Enter. {rotate} rotates in the \
         same way.",
        "Press {scale}, type 1.5, press Enter.",
        goals::has_changed,
        "s1.5<Enter>",
    ),
    Step::new(
        "{duplicate} duplicates what is selected; then it can be moved away.",
        "Press {duplicate}.",
        goals::has_added,
        "D",
    ),
    Step::new(
        "Lights are in the list, too, above the objects. Go to one with {up} and duplicate it, for a third light.",
        "Select light 1 or light 2, then press {duplicate}.",
        goals::has_added_a_light,
        "[light 1]D",
    ),
    Step::new(
        "Now the view. {camera} takes the camera into your hands.",
        "The mode at the left of the last line must say VIEW.",
        goals::looks,
        "v",
    ),
    Step::new(
        "The arrows orbit, {nearer} and {farther} go nearer and farther. Only {write-view} writes the view into \
         the scene: find one that you like and write it.",
        "Press the right arrow a few times, then {write-view}.",
        goals::has_changed,
        "l | > S",
    ),
    Step::new(
        "Save your scene: {back} leads back to the list, {save} saves. Type a name that ends in .ray, and press \
         Enter.",
        "Press {save}, type mine.ray after :w, and press Enter.",
        goals::has_saved,
        "<Esc>wmine.ray<Enter> | > @saved",
    ),
];
