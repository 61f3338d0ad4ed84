//! The table of key bindings.

use crossterm::event::{KeyCode, KeyEvent};

use super::action::{Action, Context, Mode, Stride};
use super::chord::{ALT, Chord, SHIFT, alt, c, ctrl, key};
use crate::render::Aov;

use Action as A;
use KeyCode::{BackTab, Down, End, Enter, Esc, F, Home, Left, PageDown, PageUp, Right, Tab, Up};
use Mode::{Edit, Pick, Select, Trace, View};
use Stride::{Coarse, Fine, Plain};

/// A row of the table: within its scope, each of these keys has the same action.
#[derive(Clone, Copy, Debug)]
pub(super) struct Binding {
    pub(super) scope: Scope,
    pub(super) chords: &'static [Chord],
    pub(super) action: Action,
    /// Description of the action.
    pub(super) words: &'static str,
}

/// The contexts of a binding.
#[derive(Clone, Copy, Debug)]
pub(super) enum Scope {
    /// Active only in these contexts.
    These(&'static [Context]),
    /// All modes and the list of errors.
    Everywhere,
    /// [`Self::Everywhere`], and while a scene is being opened.
    Sceneless,
    /// All contexts, including pages and questions.
    Always,
}

impl Scope {
    /// Whether a binding of this scope is active in a context.
    pub(super) fn holds(self, context: Context) -> bool {
        match self {
            Self::These(contexts) => contexts.contains(&context),
            Self::Everywhere => matches!(context, Context::In(_) | Context::Errors),
            Self::Sceneless => Self::Everywhere.holds(context) || context == Context::Opening,
            Self::Always => true,
        }
    }
}

const fn bind(
    scope: Scope,
    chords: &'static [Chord],
    action: Action,
    words: &'static str,
) -> Binding {
    Binding {
        scope,
        chords,
        action,
        words,
    }
}

const SELECT: Scope = Scope::These(&[Context::In(Select)]);
const VIEW: Scope = Scope::These(&[Context::In(View)]);
const EDIT: Scope = Scope::These(&[Context::In(Edit)]);
const LIST_AND_FIELDS: Scope = Scope::These(&[Context::In(Select), Context::In(Edit)]);
const TRACE: Scope = Scope::These(&[Context::In(Trace)]);
/// Contexts in which digits are not part of a number.
const PICTURES: Scope = Scope::These(&[Context::In(Select), Context::In(View), Context::In(Trace)]);
const PICK: Scope = Scope::These(&[Context::In(Pick)]);
const HELP: Scope = Scope::These(&[Context::Help]);
const ERRORS: Scope = Scope::These(&[Context::Errors]);
const CONFLICT: Scope = Scope::These(&[Context::Conflict]);
const QUIT: Scope = Scope::These(&[Context::Quit]);
const RECOVER: Scope = Scope::These(&[Context::Recover]);
const LISTS: Scope = Scope::These(&[
    Context::In(Select),
    Context::In(Edit),
    Context::Help,
    Context::Errors,
    Context::Conflict,
]);
const LONG_LISTS: Scope = Scope::These(&[Context::In(Select), Context::Help, Context::Errors]);

/// All key bindings, the most useful first. Ctrl-H, Ctrl-I, Ctrl-M and Ctrl-[ send the same bytes
/// as Backspace, Tab, Enter and Esc, and are therefore never bound.
#[rustfmt::skip]
pub(super) const TABLE: &[Binding] = &[
    bind(LISTS, &[c('j'), key(Down)], A::Move(1), "down"),
    bind(LISTS, &[c('k'), key(Up)], A::Move(-1), "up"),
    bind(CONFLICT, &[c('m')], A::Mine, "keep mine"),
    bind(CONFLICT, &[c('t')], A::Theirs, "take the file's"),
    bind(CONFLICT, &[key(Enter)], A::Accept, "apply the merge"),
    bind(ERRORS, &[key(Enter)], A::Accept, "go to the item"),
    bind(SELECT, &[key(Enter), c('e')], A::Go(Edit), "edit its fields"),
    bind(SELECT, &[c('v')], A::Go(View), "move the camera"),
    bind(SELECT, &[c('p')], A::Go(Pick), "pick in the picture"),
    bind(SELECT, &[key(Tab)], A::Cycle(1), "next light or object"),
    bind(LIST_AND_FIELDS, &[c(' ')], A::Visibility, "show or hide the object"),
    bind(SELECT, &[c('/')], A::Search, "search for a name"),
    bind(LONG_LISTS, &[c('g')], A::G, "first"),
    bind(LONG_LISTS, &[c('G'), key(End)], A::Last, "last"),
    bind(LONG_LISTS, &[key(Home)], A::First, "first"),
    bind(LONG_LISTS, &[key(PageDown)], A::Page(1), "page down"),
    bind(LONG_LISTS, &[key(PageUp)], A::Page(-1), "page up"),
    bind(SELECT, &[c('o')], A::Outline, "toggle the outline of the selection"),
    bind(SELECT, &[c('n')], A::SearchAgain(1), "next match"),
    bind(SELECT, &[c('N')], A::SearchAgain(-1), "previous match"),
    bind(SELECT, &[key(BackTab)], A::Cycle(-1), "previous light or object"),

    bind(EDIT, &[c('l'), key(Right)], A::Nudge(1, Plain), "nudge up"),
    bind(EDIT, &[c('h'), key(Left)], A::Nudge(-1, Plain), "nudge down"),
    bind(EDIT, &[key(Enter), c('i')], A::Type, "type a value (or press a digit)"),
    bind(EDIT, &[key(Tab)], A::Component(1), "next number"),
    bind(EDIT, &[c('L'), Chord(Right, SHIFT)], A::Nudge(1, Coarse), "nudge up ten steps"),
    bind(EDIT, &[c('H'), Chord(Left, SHIFT)], A::Nudge(-1, Coarse), "nudge down ten steps"),
    bind(EDIT, &[alt('l'), Chord(Right, ALT)], A::Nudge(1, Fine), "nudge up a tenth"),
    bind(EDIT, &[alt('h'), Chord(Left, ALT)], A::Nudge(-1, Fine), "nudge down a tenth"),
    bind(EDIT, &[c(',')], A::Stride(-1), "smaller steps"),
    bind(EDIT, &[c(';')], A::Stride(1), "larger steps"),
    bind(EDIT, &[key(BackTab)], A::Component(-1), "previous number"),

    bind(VIEW, &[c('h'), key(Left)], A::Orbit(1, 0), "orbit left"),
    bind(VIEW, &[c('j'), key(Down)], A::Orbit(0, -1), "orbit down"),
    bind(VIEW, &[c('k'), key(Up)], A::Orbit(0, 1), "orbit up"),
    bind(VIEW, &[c('l'), key(Right)], A::Orbit(-1, 0), "orbit right"),
    bind(VIEW, &[c('+'), c('=')], A::Dolly(1), "nearer"),
    bind(VIEW, &[c('-')], A::Dolly(-1), "farther"),
    bind(VIEW, &[c('f')], A::FrameSelected, "frame the selected object"),
    bind(VIEW, &[c('0')], A::ResetView, "reset to the scene's view"),
    bind(VIEW, &[c('S')], A::SaveView, "write the view into the scene"),
    bind(VIEW, &[c('H'), Chord(Left, SHIFT)], A::Pan(1, 0), "pan left"),
    bind(VIEW, &[c('J'), Chord(Down, SHIFT)], A::Pan(0, -1), "pan down"),
    bind(VIEW, &[c('K'), Chord(Up, SHIFT)], A::Pan(0, 1), "pan up"),
    bind(VIEW, &[c('L'), Chord(Right, SHIFT)], A::Pan(-1, 0), "pan right"),
    bind(VIEW, &[c('[')], A::Widen(-1), "narrow the field of view"),
    bind(VIEW, &[c(']')], A::Widen(1), "widen the field of view"),

    bind(PICK, &[c('h'), key(Left)], A::Cross(-1, 0), "left"),
    bind(PICK, &[c('j'), key(Down)], A::Cross(0, 1), "down"),
    bind(PICK, &[c('k'), key(Up)], A::Cross(0, -1), "up"),
    bind(PICK, &[c('l'), key(Right)], A::Cross(1, 0), "right"),
    bind(PICK, &[c('H'), Chord(Left, SHIFT)], A::Cross(-8, 0), "left 8 cells"),
    bind(PICK, &[c('J'), Chord(Down, SHIFT)], A::Cross(0, 4), "down 4 cells"),
    bind(PICK, &[c('K'), Chord(Up, SHIFT)], A::Cross(0, -4), "up 4 cells"),
    bind(PICK, &[c('L'), Chord(Right, SHIFT)], A::Cross(8, 0), "right 8 cells"),
    bind(PICK, &[key(Enter)], A::Accept, "select the object there"),

    bind(CONFLICT, &[c('M')], A::AllMine, "keep mine everywhere"),
    bind(CONFLICT, &[c('T')], A::AllTheirs, "take the file's everywhere"),
    bind(CONFLICT, &[key(Esc)], A::Back, "decide later"),
    bind(QUIT, &[c('y')], A::Accept, "quit anyway"),
    bind(QUIT, &[c('w')], A::Save, "save and quit"),
    bind(QUIT, &[c('n'), key(Esc)], A::Back, "stay"),
    bind(RECOVER, &[c('r')], A::Accept, "restore them"),
    bind(RECOVER, &[c('d')], A::No, "discard them"),
    bind(RECOVER, &[key(Esc)], A::Back, "decide next time"),
    bind(HELP, &[c('/')], A::Search, "search"),
    bind(HELP, &[key(Esc), c('q'), c('?')], A::Back, "close"),

    bind(PICTURES, &[c('1')], A::Show(None), "show light"),
    bind(PICTURES, &[c('2')], A::Show(Some(Aov::Depth)), "show depth, nearest white"),
    bind(PICTURES, &[c('3')], A::Show(Some(Aov::Normal)), "show normals"),
    bind(PICTURES, &[c('4')], A::Show(Some(Aov::Object)), "show objects, one colour each"),
    bind(PICTURES, &[c('5')], A::Show(Some(Aov::Albedo)), "show unlit colours"),

    bind(TRACE, &[c('x')], A::Stop, "stop"),
    bind(SELECT, &[c('x')], A::Stop, "cancel the export"),
    bind(Scope::Everywhere, &[key(Esc)], A::Back, "back"),
    bind(Scope::Sceneless, &[c('?')], A::Help, "help"),
    bind(Scope::Sceneless, &[c(':')], A::Command, "command"),
    bind(Scope::Everywhere, &[c('w')], A::Save, "save the scene"),
    bind(Scope::Everywhere, &[c('b')], A::Export, "export what is shown"),
    bind(Scope::Everywhere, &[key(F(5)), c('r')], A::Go(Trace), "trace at full size"),
    bind(Scope::Everywhere, &[c('u')], A::Undo, "undo"),
    bind(Scope::Everywhere, &[ctrl('r')], A::Redo, "redo"),
    bind(Scope::Everywhere, &[c('!')], A::Errors, "errors and warnings"),
    bind(Scope::Sceneless, &[c('M')], A::Message, "show the last message again"),
    bind(Scope::Everywhere, &[c('E')], A::Editor, "open the editor at the selected item"),
    bind(Scope::Everywhere, &[c('z')], A::Zoom, "show or hide the panels"),
    bind(Scope::Everywhere, &[c('P')], A::Integrator, "toggle path tracing"),
    bind(Scope::Sceneless, &[c('m')], A::Mouse, "toggle mouse capture"),
    bind(Scope::Always, &[ctrl('l')], A::Repaint, "redraw the screen"),
    bind(Scope::Always, &[ctrl('z')], A::Suspend, "suspend"),
    bind(Scope::Sceneless, &[c('q')], A::Quit, "quit"),
    bind(Scope::Always, &[ctrl('c')], A::Interrupt, "quit; press twice to quit at once"),
    bind(VIEW, &[c('e')], A::Go(Edit), "edit fields"),
    bind(EDIT, &[c('v')], A::Go(View), "move the camera"),
    bind(VIEW, &[key(Enter)], A::Go(Select), "back to the list"),
];

/// The action of a key in a context.
pub fn action(context: Context, event: KeyEvent) -> Option<Action> {
    let pressed = Chord::of(event);
    let mut rows = TABLE.iter();
    let row = rows.find(|row| row.scope.holds(context) && row.chords.contains(&pressed));
    row.map(|row| row.action)
}

#[cfg(test)]
mod tests {
    use super::*;
    use Context::{Conflict, Errors, Help, Opening, Quit, Recover};
    use KeyCode::Char;

    #[test]
    fn no_key_has_two_meanings_in_one_context() {
        let modes = [Select, View, Edit, Trace, Pick].map(Context::In);
        let others = [Opening, Help, Errors, Conflict, Quit, Recover];
        for context in modes.into_iter().chain(others) {
            let rows = TABLE.iter().filter(|row| row.scope.holds(context));
            let mut bound: Vec<_> = rows.flat_map(|row| row.chords).collect();
            while let Some(chord) = bound.pop() {
                assert!(!bound.contains(&chord), "{context:?} {chord:?}");
            }
        }
    }

    #[test]
    fn keys_that_share_their_bytes_with_others_are_not_bound() {
        let bound = TABLE.iter().flat_map(|row| row.chords);
        for forbidden in ['h', 'i', 'm', '['] {
            assert!(bound.clone().all(|chord| *chord != ctrl(forbidden)));
        }
    }

    #[test]
    fn every_binding_is_explained() {
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
