//! The keys: one table that is asked what a key does and printed as help.

mod help;

use crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

use super::app::{App, Dialog, Mode, Stride};
use crate::render::Aov;

pub use help::{HelpLine, help, hints};

/// Where keys mean something of their own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Context {
    /// In this mode.
    In(Mode),
    /// While the scene is read for the first time.
    Opening,
    /// On the help page.
    Help,
    /// In the list of errors.
    Errors,
    /// Deciding a conflict.
    Conflict,
    /// Asked whether to quit.
    Quit,
    /// Asked whether to take the edits of an earlier run.
    Recover,
}

/// What a key does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// Moves the cursor: down if positive.
    Move(isize),
    /// Moves the cursor a screenful: down if positive.
    Page(isize),
    /// Moves the cursor to the first place.
    First,
    /// The first half of `gg`.
    G,
    /// Moves the cursor to the last place.
    Last,
    /// Selects the next object or light, or the one before.
    Cycle(isize),
    /// Goes to a mode.
    Go(Mode),
    /// Goes back, or closes what is open; never loses anything.
    Back,
    /// Takes what the cursor is on.
    Accept,
    /// Opens the line for a search.
    Search,
    /// Goes on to the next place found, or the one before.
    SearchAgain(isize),
    /// Opens the line for a command.
    Command,
    /// Shows or hides the outline of the selected object.
    Outline,
    /// Shows or hides the selected object itself.
    Visibility,
    /// Types a value.
    Type,
    /// Adds the field's step to a value, times the stride: up if positive.
    Nudge(i8, Stride),
    /// Makes the step smaller or larger.
    Stride(isize),
    /// Goes to the next component, or the one before.
    Component(isize),
    /// Moves the camera around its target: this many steps to the left and up.
    Orbit(i8, i8),
    /// Moves camera and target: this many steps to the left and up.
    Pan(i8, i8),
    /// Moves the camera nearer: this many steps.
    Dolly(i8),
    /// Widens the angle of view: this many steps.
    Widen(i8),
    /// Goes back to the text's view.
    ResetView,
    /// Brings the selected object, or everything, into view.
    FrameSelected,
    /// Writes the working view into the text.
    SaveView,
    /// Moves the cross by cells: to the right and down.
    Cross(i32, i32),
    /// Stops what is under way.
    Stop,
    /// Writes a picture file.
    Export,
    /// Writes the scene.
    Save,
    /// Undoes a step.
    Undo,
    /// Redoes a step.
    Redo,
    /// Opens the user's editor.
    Editor,
    /// Opens or closes the list of errors.
    Errors,
    /// Shows the last message again.
    Message,
    /// Opens or closes the help page.
    Help,
    /// Gives the picture more of the screen, or less.
    Zoom,
    /// Shows this of the first surfaces, or light.
    Show(Option<Aov>),
    /// Gathers light in the other way.
    Integrator,
    /// Takes the mouse or leaves it to the terminal.
    Mouse,
    /// Redraws everything.
    Repaint,
    /// Stops the program until it is continued.
    Suspend,
    /// Ends the program.
    Quit,
    /// Ends the program; at once if repeated.
    Interrupt,
    /// Keeps what stands in the interface.
    Mine,
    /// Takes what stands in the file.
    Theirs,
    /// Keeps all that stands in the interface.
    AllMine,
    /// Takes all that stands in the file.
    AllTheirs,
    /// Says no.
    No,
}

/// One row: in these contexts each of these keys does this.
#[derive(Clone, Copy, Debug)]
pub struct Binding {
    /// Where.
    pub contexts: &'static [Context],
    /// Which keys.
    pub chords: &'static [Chord],
    /// What they do.
    pub action: Action,
    /// What they do, in words.
    pub words: &'static str,
}

/// A key with what is held down beside it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Chord(pub KeyCode, pub KeyModifiers);

const NONE: KeyModifiers = KeyModifiers::NONE;
const SHIFT: KeyModifiers = KeyModifiers::SHIFT;
const ALT: KeyModifiers = KeyModifiers::ALT;
const CTRL: KeyModifiers = KeyModifiers::CONTROL;

/// A character key. Shift is part of the character.
const fn c(character: char) -> Chord {
    Chord(Char(character), NONE)
}

const fn ctrl(character: char) -> Chord {
    Chord(Char(character), CTRL)
}

const fn alt(character: char) -> Chord {
    Chord(Char(character), ALT)
}

const fn key(code: KeyCode) -> Chord {
    Chord(code, NONE)
}

const fn bind(
    contexts: &'static [Context],
    chords: &'static [Chord],
    action: Action,
    words: &'static str,
) -> Binding {
    Binding {
        contexts,
        chords,
        action,
        words,
    }
}

const SELECT: &[Context] = &[Context::In(Select)];
const VIEW: &[Context] = &[Context::In(View)];
const EDIT: &[Context] = &[Context::In(Edit)];
const LIST_AND_FIELDS: &[Context] = &[Context::In(Select), Context::In(Edit)];
const TRACE: &[Context] = &[Context::In(Trace)];
/// Where digits are not part of a number.
const PICTURES: &[Context] = &[Context::In(Select), Context::In(View), Context::In(Trace)];
const PICK: &[Context] = &[Context::In(Pick)];
const LISTS: &[Context] = &[
    Context::In(Select),
    Context::In(Edit),
    Context::Help,
    Context::Errors,
    Context::Conflict,
];
const LONG_LISTS: &[Context] = &[Context::In(Select), Context::Help, Context::Errors];
const EVERYWHERE: &[Context] = &[
    Context::In(Select),
    Context::In(View),
    Context::In(Edit),
    Context::In(Trace),
    Context::In(Pick),
    Context::Errors,
];
/// Where a scene is not needed.
const SCENELESS: &[Context] = &[
    Context::Opening,
    Context::In(Select),
    Context::In(View),
    Context::In(Edit),
    Context::In(Trace),
    Context::In(Pick),
    Context::Errors,
];
const ALL: &[Context] = &[
    Context::Opening,
    Context::In(Select),
    Context::In(View),
    Context::In(Edit),
    Context::In(Trace),
    Context::In(Pick),
    Context::Errors,
    Context::Help,
    Context::Conflict,
    Context::Quit,
    Context::Recover,
];

use Action as A;
use KeyCode::{
    BackTab, Char, Down, End, Enter, Esc, F, Home, Left, PageDown, PageUp, Right, Tab, Up,
};
use Mode::{Edit, Pick, Select, Trace, View};
use Stride::{Coarse, Fine, Plain};

/// Every key, the most useful first. The bytes of Ctrl-H, Ctrl-I, Ctrl-M and Ctrl-[ are those of
/// Backspace, Tab, Enter and Esc, so that they are never bound.
#[rustfmt::skip]
pub const TABLE: &[Binding] = &[
    bind(LISTS, &[c('j'), key(Down)], A::Move(1), "down"),
    bind(LISTS, &[c('k'), key(Up)], A::Move(-1), "up"),
    bind(&[Context::Conflict], &[c('m')], A::Mine, "keep mine"),
    bind(&[Context::Conflict], &[c('t')], A::Theirs, "take the file's"),
    bind(&[Context::Conflict], &[key(Enter)], A::Accept, "merge as decided"),
    bind(&[Context::Errors], &[key(Enter)], A::Accept, "go to the thing"),
    bind(SELECT, &[key(Enter), c('e')], A::Go(Edit), "edit its fields"),
    bind(SELECT, &[c('v')], A::Go(View), "move the camera"),
    bind(SELECT, &[c('p')], A::Go(Pick), "pick in the picture"),
    bind(SELECT, &[key(Tab)], A::Cycle(1), "next light or object"),
    bind(LIST_AND_FIELDS, &[c(' ')], A::Visibility, "show or hide the object (.dat)"),
    bind(SELECT, &[c('/')], A::Search, "search for a name"),
    bind(LONG_LISTS, &[c('g')], A::G, "first"),
    bind(LONG_LISTS, &[c('G'), key(End)], A::Last, "last"),
    bind(LONG_LISTS, &[key(Home)], A::First, "first"),
    bind(LONG_LISTS, &[key(PageDown)], A::Page(1), "a screenful down"),
    bind(LONG_LISTS, &[key(PageUp)], A::Page(-1), "a screenful up"),
    bind(SELECT, &[c('o')], A::Outline, "mark the selected object, or not"),
    bind(SELECT, &[c('n')], A::SearchAgain(1), "next match"),
    bind(SELECT, &[c('N')], A::SearchAgain(-1), "previous match"),
    bind(SELECT, &[key(BackTab)], A::Cycle(-1), "previous light or object"),

    bind(EDIT, &[c('l'), key(Right)], A::Nudge(1, Plain), "nudge up"),
    bind(EDIT, &[c('h'), key(Left)], A::Nudge(-1, Plain), "nudge down"),
    bind(EDIT, &[key(Enter), c('i')], A::Type, "type a value; digits do too"),
    bind(EDIT, &[key(Tab)], A::Component(1), "next number"),
    bind(EDIT, &[c('L'), Chord(Right, SHIFT)], A::Nudge(1, Coarse), "nudge up ten steps"),
    bind(EDIT, &[c('H'), Chord(Left, SHIFT)], A::Nudge(-1, Coarse), "nudge down ten steps"),
    bind(EDIT, &[alt('l'), Chord(Right, ALT)], A::Nudge(1, Fine), "nudge up a tenth"),
    bind(EDIT, &[alt('h'), Chord(Left, ALT)], A::Nudge(-1, Fine), "nudge down a tenth"),
    bind(EDIT, &[c(',')], A::Stride(-1), "smaller steps"),
    bind(EDIT, &[c('.')], A::Stride(1), "larger steps"),
    bind(EDIT, &[key(BackTab)], A::Component(-1), "previous number"),

    bind(VIEW, &[c('h'), key(Left)], A::Orbit(1, 0), "orbit left"),
    bind(VIEW, &[c('j'), key(Down)], A::Orbit(0, -1), "orbit down"),
    bind(VIEW, &[c('k'), key(Up)], A::Orbit(0, 1), "orbit up"),
    bind(VIEW, &[c('l'), key(Right)], A::Orbit(-1, 0), "orbit right"),
    bind(VIEW, &[c('+'), c('=')], A::Dolly(1), "nearer"),
    bind(VIEW, &[c('-')], A::Dolly(-1), "farther"),
    bind(VIEW, &[c('f')], A::FrameSelected, "frame the selected object"),
    bind(VIEW, &[c('0')], A::ResetView, "back to the scene's view"),
    bind(VIEW, &[c('S')], A::SaveView, "write the view into the scene"),
    bind(VIEW, &[c('H'), Chord(Left, SHIFT)], A::Pan(1, 0), "pan left"),
    bind(VIEW, &[c('J'), Chord(Down, SHIFT)], A::Pan(0, -1), "pan down"),
    bind(VIEW, &[c('K'), Chord(Up, SHIFT)], A::Pan(0, 1), "pan up"),
    bind(VIEW, &[c('L'), Chord(Right, SHIFT)], A::Pan(-1, 0), "pan right"),
    bind(VIEW, &[c('[')], A::Widen(-1), "narrower angle"),
    bind(VIEW, &[c(']')], A::Widen(1), "wider angle"),

    bind(PICK, &[c('h'), key(Left)], A::Cross(-1, 0), "left"),
    bind(PICK, &[c('j'), key(Down)], A::Cross(0, 1), "down"),
    bind(PICK, &[c('k'), key(Up)], A::Cross(0, -1), "up"),
    bind(PICK, &[c('l'), key(Right)], A::Cross(1, 0), "right"),
    bind(PICK, &[c('H'), Chord(Left, SHIFT)], A::Cross(-8, 0), "far left"),
    bind(PICK, &[c('J'), Chord(Down, SHIFT)], A::Cross(0, 4), "far down"),
    bind(PICK, &[c('K'), Chord(Up, SHIFT)], A::Cross(0, -4), "far up"),
    bind(PICK, &[c('L'), Chord(Right, SHIFT)], A::Cross(8, 0), "far right"),
    bind(PICK, &[key(Enter)], A::Accept, "select what is there"),

    bind(&[Context::Conflict], &[c('M')], A::AllMine, "keep mine everywhere"),
    bind(&[Context::Conflict], &[c('T')], A::AllTheirs, "take the file's everywhere"),
    bind(&[Context::Conflict], &[key(Esc)], A::Back, "decide later"),
    bind(&[Context::Quit], &[c('y')], A::Accept, "quit anyway"),
    bind(&[Context::Quit], &[c('w')], A::Save, "save and quit"),
    bind(&[Context::Quit], &[c('n'), key(Esc)], A::Back, "stay"),
    bind(&[Context::Recover], &[c('r')], A::Accept, "take them"),
    bind(&[Context::Recover], &[c('d')], A::No, "throw them away"),
    bind(&[Context::Recover], &[key(Esc)], A::Back, "decide next time"),
    bind(&[Context::Help], &[c('/')], A::Search, "search"),
    bind(&[Context::Help], &[key(Esc), c('q'), c('?')], A::Back, "close"),

    bind(PICTURES, &[c('1')], A::Show(None), "show light"),
    bind(PICTURES, &[c('2')], A::Show(Some(Aov::Depth)), "show depth: the nearest white"),
    bind(PICTURES, &[c('3')], A::Show(Some(Aov::Normal)), "show normals"),
    bind(PICTURES, &[c('4')], A::Show(Some(Aov::Object)), "show objects, a colour each"),
    bind(PICTURES, &[c('5')], A::Show(Some(Aov::Albedo)), "show colours without light"),

    bind(TRACE, &[c('x')], A::Stop, "stop"),
    bind(SELECT, &[c('x')], A::Stop, "cancel the export"),
    bind(EVERYWHERE, &[key(Esc)], A::Back, "back"),
    bind(SCENELESS, &[c('?')], A::Help, "help"),
    bind(SCENELESS, &[c(':')], A::Command, "command"),
    bind(EVERYWHERE, &[c('w')], A::Save, "save the scene"),
    bind(EVERYWHERE, &[c('b')], A::Export, "export what is shown"),
    bind(EVERYWHERE, &[key(F(5)), c('r')], A::Go(Trace), "trace at full size"),
    bind(EVERYWHERE, &[c('u')], A::Undo, "undo"),
    bind(EVERYWHERE, &[ctrl('r')], A::Redo, "redo"),
    bind(EVERYWHERE, &[c('!')], A::Errors, "errors and warnings"),
    bind(SCENELESS, &[c('M')], A::Message, "last message again"),
    bind(EVERYWHERE, &[c('E')], A::Editor, "open the editor at the selected thing"),
    bind(EVERYWHERE, &[c('z')], A::Zoom, "picture alone, or with panels"),
    bind(EVERYWHERE, &[c('P')], A::Integrator, "path tracing, or Whitted's rays"),
    bind(SCENELESS, &[c('m')], A::Mouse, "mouse on or off"),
    bind(ALL, &[ctrl('l')], A::Repaint, "redraw the screen"),
    bind(ALL, &[ctrl('z')], A::Suspend, "stop until continued"),
    bind(SCENELESS, &[c('q')], A::Quit, "quit"),
    bind(ALL, &[ctrl('c')], A::Interrupt, "quit; twice: at once"),
    bind(VIEW, &[c('e')], A::Go(Edit), "edit fields"),
    bind(EDIT, &[c('v')], A::Go(View), "move the camera"),
    bind(VIEW, &[key(Enter)], A::Go(Select), "back to the list"),
];

/// What a key does in a context.
pub fn action(context: Context, event: KeyEvent) -> Option<Action> {
    let pressed = Chord::of(event);
    TABLE
        .iter()
        .find(|row| row.contexts.contains(&context) && row.chords.contains(&pressed))
        .map(|row| row.action)
}

/// The context whose keys are in force; keys typed into a line come before it.
pub fn context(app: &App) -> Context {
    match &app.dialog {
        Some(Dialog::Quit) => return Context::Quit,
        Some(Dialog::Conflict { .. }) => return Context::Conflict,
        Some(Dialog::Recover(_)) => return Context::Recover,
        None => {}
    }
    if app.help.is_some() {
        Context::Help
    } else if app.errors.is_some() {
        Context::Errors
    } else if app.is_opening() {
        Context::Opening
    } else {
        Context::In(app.mode)
    }
}

impl Chord {
    /// The chord of a key event; Shift is part of a character.
    fn of(event: KeyEvent) -> Self {
        let held = event.modifiers & (SHIFT | ALT | CTRL);
        match event.code {
            Char(_) => Self(event.code, held - SHIFT),
            BackTab => Self(BackTab, held - SHIFT),
            code => Self(code, held),
        }
    }

    /// What the key is called.
    pub fn name(&self) -> String {
        let Self(code, held) = *self;
        let mut name = String::new();
        for (modifier, prefix) in [(CTRL, "Ctrl-"), (ALT, "Alt-"), (SHIFT, "Shift-")] {
            if held.contains(modifier) {
                name.push_str(prefix);
            }
        }
        match code {
            Char(' ') => name.push_str("Space"),
            Char(character) if held.contains(CTRL) => name.extend(character.to_uppercase()),
            Char(character) => name.push(character),
            Up => name.push('↑'),
            Down => name.push('↓'),
            Left => name.push('←'),
            Right => name.push('→'),
            BackTab => name.push_str("Shift-Tab"),
            other => name.push_str(&other.to_string()),
        }
        name
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_key_means_two_things_at_once() {
        let mut meanings = Vec::new();
        for row in TABLE {
            for context in row.contexts {
                for chord in row.chords {
                    assert!(
                        !meanings.contains(&(*context, *chord)),
                        "{context:?} {chord:?}"
                    );
                    meanings.push((*context, *chord));
                }
            }
        }
    }

    #[test]
    fn keys_that_are_the_same_bytes_as_others_are_never_bound() {
        let bound = TABLE.iter().flat_map(|row| row.chords);
        for forbidden in ['h', 'i', 'm', '['] {
            assert!(bound.clone().all(|chord| *chord != ctrl(forbidden)));
        }
    }

    #[test]
    fn every_key_is_explained() {
        assert!(TABLE.iter().all(|row| !row.words.is_empty()));
    }

    #[test]
    fn shift_is_part_of_a_character() {
        let event = KeyEvent::new(Char('G'), SHIFT);
        assert_eq!(action(Context::In(Select), event), Some(A::Last));
        let event = KeyEvent::new(BackTab, SHIFT);
        assert_eq!(action(Context::In(Select), event), Some(A::Cycle(-1)));
    }
}
