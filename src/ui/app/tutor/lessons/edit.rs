//! The lesson in changing a scene and finding out why a pixel has its colour.

use super::super::goals;
use super::step::{Lesson, Step};
use crate::app::CarriedScene;
use language::Language;

pub(super) const EDIT: Lesson = Lesson {
    name: "edit",
    scene: CarriedScene {
        name: "the lesson edit",
        language: Language::Ray,
        text: include_str!("edit.ray"),
    },
    steps: STEPS,
    after: "You can change any scene now. Next: :tutor build makes one from nothing; halflight samples \
            DIR writes more scenes to change.",
};

const STEPS: &[Step] = &[
    Step::new(
        "This scene is a copy: nothing of yours is changed. The list names what is in it. Select the blue \
         block: {down} goes down, {up} goes up.",
        "Press {down} until the picture outlines the blue block.",
        goals::has_selected::<2>,
        "[object 1]jj",
    ),
    Step::new(
        "Press {edit} to edit the block: the keys now go to its fields below the list.",
        "The mode at the left of the last line must say EDIT.",
        goals::edits,
        "e",
    ),
    Step::new(
        "{nudge-up} and {nudge-down} nudge the number under the cursor, and the picture follows. {down} and \
         {up} go to other fields. Nudge one.",
        "Press {nudge-up}. With Shift a nudge is ten steps, with Alt a tenth of one.",
        goals::has_changed,
        "l",
    ),
    Step::new(
        "Type a number in place of the one under the cursor, such as 1.5, and press Enter. Expressions \
         such as 1/3 work too.",
        "Just type 1.5 and press Enter; Esc gives up what is typed.",
        goals::has_changed,
        "1.5<Enter>",
    ),
    Step::new(
        "Go to kd, its diffuse colour, with {down}, and press {pick-colour} for the colour picker.",
        "kd is between ka (ambient) and ks (highlights), near the end.",
        goals::picks_a_colour,
        "@field kd | > c",
    ),
    Step::new(
        "{nudge-up} and {nudge-down} change the row, {down} goes to the next; Enter keeps the colour.",
        "Press {nudge-up} a few times, then Enter.",
        goals::has_changed,
        "lll<Enter>",
    ),
    Step::new(
        "Every change can be taken back: {undo} undoes, {redo} does it again. Undo the colour.",
        "Press {undo} once. {history} shows all steps as pictures.",
        goals::has_undone,
        "u",
    ),
    Step::new(
        "{save} saves. This scene has no file yet: type a name such as lesson.ray, in any folder, and press \
         Enter. A file that exists is not replaced.",
        "Press {save}, type lesson.ray after :w, and press Enter.",
        goals::has_saved,
        "wlesson.ray<Enter> | > @saved",
    ),
    Step::new(
        "A scene is text. {editor} opens it in your editor, at what is selected. Change a number there, save, \
         and leave the editor: the picture follows.",
        "Any editor in another window will do. :tutor skip leaves it out.",
        goals::has_read,
        "@file the ground => the floor",
    ),
    Step::new(
        "Now, why does a pixel have its colour? {inspect} puts a cross into the picture; the arrows move it.",
        "Press {back} until the mode says SELECT, then {inspect}.",
        goals::inspects,
        "<Esc><Esc> | > @traced preview | > i",
    ),
    Step::new(
        "{explain} explains the pixel: what its rays met, which lights reach it, what each adds.",
        "Move the cross onto the ball, and press {explain}.",
        goals::explains,
        "e | > @explained",
    ),
    Step::new(
        "Each row is a ray; Enter goes to its object. {back} leads back, from anywhere: go back to the list.",
        "Press {back} until the mode says SELECT.",
        goals::is_in_the_list,
        "<Esc><Esc>",
    ),
    Step::new(
        "{export} writes the picture to a file: PNG, and by the name's ending JPEG, GIF, EXR and more.",
        "Press {export}, and Enter if it asks for a name.",
        goals::exports,
        "b",
    ),
];
