//! The table of key bindings, unless the user changes them.

use crossterm::event::KeyCode;

use super::action::{Action, Context, Fold, Mode, Playback, Stride, Tool};
use super::chord::{ALT, Chord, Keys, SHIFT, alt, c, ctrl, key};
use crate::language::Neighbour;
use crate::render::Aov;

use Action as A;
use KeyCode::{BackTab, Down, End, Enter, Esc, F, Home, Left, PageDown, PageUp, Right, Tab, Up};
use Mode::{Compare, Edit, Fly, Inspect, Move, Select, Sequence, Trace, View};
use Playback::{Frames, Key, NextKey, Play, PreviousKey, TakeBack};
use Stride::{Coarse, Fine, Plain};

/// A row of the table: within its scope, each of these keys has the same action.
#[derive(Clone, Copy, Debug)]
pub(super) struct Binding {
    pub(super) scope: Scope,
    pub(super) chords: &'static [Chord],
    /// Whether the keys are pressed one after the other instead.
    pub(super) pressed: Pressed,
    pub(super) action: Action,
    /// Description of the action.
    pub(super) words: &'static str,
}

/// How the keys of a row are pressed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Pressed {
    /// Any one of them.
    Each,
    /// These two, one after the other.
    InTurn,
}

/// The contexts of a binding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scope {
    /// Active only in these contexts.
    These(&'static [Context]),
    /// All modes but [`Mode::Move`] and [`Mode::Sequence`], the list of errors, and the rays behind a pixel.
    Everywhere,
    /// [`Self::Everywhere`], while something is being transformed, and while a scene is being opened.
    Sceneless,
    /// All contexts, including pages and questions.
    Always,
}

impl Scope {
    /// Whether a binding of this scope is active in a context.
    pub(super) fn holds(self, context: Context) -> bool {
        match self {
            Self::These(contexts) => contexts.contains(&context),
            // While something is being transformed or a frame is shown, nothing else may change the
            // text.
            Self::Everywhere => {
                matches!(context, Context::In(mode) if !matches!(mode, Move | Sequence))
                    || matches!(context, Context::Errors | Context::Rays)
            }
            Self::Sceneless => {
                let others = [Context::Opening, Context::Errors, Context::Rays];
                matches!(context, Context::In(_)) || others.contains(&context)
            }
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
        pressed: Pressed::Each,
        action,
        words,
    }
}

const fn in_turn(
    scope: Scope,
    chords: &'static [Chord; 2],
    action: Action,
    words: &'static str,
) -> Binding {
    Binding {
        pressed: Pressed::InTurn,
        ..bind(scope, chords, action, words)
    }
}

const SELECT: Scope = Scope::These(&[Context::In(Select)]);
const VIEW: Scope = Scope::These(&[Context::In(View)]);
const MOVE: Scope = Scope::These(&[Context::In(Move)]);
const SELECT_AND_FIELDS: Scope = Scope::These(&[Context::In(Select), Context::In(Edit)]);
const FLY: Scope = Scope::These(&[Context::In(Fly)]);
const VIEWS: Scope = Scope::These(&[Context::In(View), Context::In(Fly)]);
const EDIT: Scope = Scope::These(&[Context::In(Edit)]);
const COLOUR: Scope = Scope::These(&[Context::Colour]);
/// Where numbers are nudged.
const VALUES: Scope = Scope::These(&[Context::In(Edit), Context::Colour]);
/// Where panels are on screen or can be.
const PANELS: Scope = Scope::These(&[
    Context::In(Select),
    Context::In(Edit),
    Context::In(View),
    Context::In(Fly),
    Context::In(Inspect),
    Context::In(Compare),
    Context::Errors,
    Context::In(Sequence),
]);
const REGION: Scope = Scope::These(&[Context::Region]);
const TRACE: Scope = Scope::These(&[Context::In(Trace)]);
/// Contexts in which digits are not part of a number.
const PICTURES: Scope = Scope::These(&[
    Context::In(Select),
    Context::In(View),
    Context::In(Fly),
    Context::In(Trace),
    Context::In(Inspect),
    Context::In(Compare),
    Context::In(Sequence),
]);
/// Such contexts with the preview on screen.
const PREVIEWS: Scope = Scope::These(&[
    Context::In(Select),
    Context::In(View),
    Context::In(Fly),
    Context::In(Inspect),
    Context::In(Sequence),
]);
/// Where no letter is part of a value, and the cross has another key.
const INSPECTABLE: Scope = Scope::These(&[
    Context::In(Select),
    Context::In(View),
    Context::In(Fly),
    Context::In(Trace),
    Context::In(Compare),
]);
const INSPECT: Scope = Scope::These(&[Context::In(Inspect)]);
const RAYS: Scope = Scope::These(&[Context::Rays]);
const COMPARE: Scope = Scope::These(&[Context::In(Compare)]);
const SEQUENCE: Scope = Scope::These(&[Context::In(Sequence)]);
/// Where present values are keyed.
const KEYED: Scope = Scope::These(&[Context::In(Edit), Context::In(View), Context::In(Fly)]);
/// Where a track can be played.
const PLAYED: Scope = Scope::These(&[
    Context::In(Select),
    Context::In(Edit),
    Context::In(View),
    Context::In(Fly),
]);
const HELP: Scope = Scope::These(&[Context::Help]);
const MESSAGES: Scope = Scope::These(&[Context::Messages]);
const ERRORS: Scope = Scope::These(&[Context::Errors]);
const VIEWS_PAGE: Scope = Scope::These(&[Context::Views]);
const RECENT: Scope = Scope::These(&[Context::Recent]);
const STEPS: Scope = Scope::These(&[Context::Steps]);
const CONFLICT: Scope = Scope::These(&[Context::Conflict]);
const QUIT: Scope = Scope::These(&[Context::Quit]);
const DELETE: Scope = Scope::These(&[Context::Delete]);
const LEAVE: Scope = Scope::These(&[Context::Leave]);
const MOVED_VIEW: Scope = Scope::These(&[Context::MovedView]);
const WAIT: Scope = Scope::These(&[Context::Wait]);
const OVERWRITE: Scope = Scope::These(&[Context::Overwrite]);
const RECOVER: Scope = Scope::These(&[Context::Recover]);
const LISTS: Scope = Scope::These(&[
    Context::In(Select),
    Context::In(Edit),
    Context::Help,
    Context::Messages,
    Context::Errors,
    Context::Views,
    Context::Recent,
    Context::Steps,
    Context::Colour,
    Context::Conflict,
    Context::Rays,
]);
const LONG_LISTS: Scope = Scope::These(&[
    Context::In(Select),
    Context::Help,
    Context::Messages,
    Context::Errors,
    Context::Views,
    Context::Recent,
    Context::Rays,
    Context::Steps,
]);

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
    bind(SELECT, &[c('d')], A::Delete, "delete"),
    bind(SELECT, &[c('D')], A::Duplicate, "duplicate"),
    bind(SELECT, &[c('y')], A::Copy, "copy the text"),
    bind(SELECT, &[c('p')], A::Insert, "paste"),
    bind(SELECT, &[c(' ')], A::Mark, "mark or unmark"),
    bind(SELECT, &[c('R')], A::Rename, "rename"),
    bind(SELECT, &[c('K')], A::Reorder(Neighbour::Previous), "move up in the list"),
    bind(SELECT, &[c('J')], A::Reorder(Neighbour::Next), "move down in the list"),
    bind(SELECT, &[c('a')], A::Add, "add"),
    bind(SELECT, &[c('l')], A::Solo, "show only this in the preview"),
    bind(SELECT, &[c('c')], A::Retype, "change the type"),
    bind(SELECT_AND_FIELDS, &[c('m')], A::Transform(Tool::Move), "move"),
    bind(SELECT_AND_FIELDS, &[c('t')], A::Transform(Tool::Rotate), "rotate"),
    bind(SELECT_AND_FIELDS, &[c('s')], A::Transform(Tool::Scale), "scale"),
    bind(MOVE, &[c('h'), key(Left)], A::Step(-1, 0, Plain), "left; less"),
    bind(MOVE, &[c('j'), key(Down)], A::Step(0, -1, Plain), "down; less"),
    bind(MOVE, &[c('k'), key(Up)], A::Step(0, 1, Plain), "up; more"),
    bind(MOVE, &[c('l'), key(Right)], A::Step(1, 0, Plain), "right; more"),
    bind(MOVE, &[c('H'), Chord(Left, SHIFT)], A::Step(-1, 0, Coarse), "left ten steps"),
    bind(MOVE, &[c('J'), Chord(Down, SHIFT)], A::Step(0, -1, Coarse), "down ten steps"),
    bind(MOVE, &[c('K'), Chord(Up, SHIFT)], A::Step(0, 1, Coarse), "up ten steps"),
    bind(MOVE, &[c('L'), Chord(Right, SHIFT)], A::Step(1, 0, Coarse), "right ten steps"),
    bind(MOVE, &[c('x')], A::Lock(0), "lock to x; again: its own x"),
    bind(MOVE, &[c('y')], A::Lock(1), "lock to y; again: its own y"),
    bind(MOVE, &[c('z')], A::Lock(2), "lock to z; again: its own z"),
    bind(MOVE, &[c('g')], A::Snap, "snap to a grid"),
    bind(MOVE, &[key(Enter)], A::Accept, "confirm"),
    bind(MOVE, &[key(Esc)], A::Back, "cancel"),
    bind(SEQUENCE, &[c(' ')], A::OnTrack(Play), "play or stop"),
    bind(SEQUENCE, &[c('l'), key(Right)], A::OnTrack(Frames(1)), "next frame"),
    bind(SEQUENCE, &[c('h'), key(Left)], A::OnTrack(Frames(-1)), "previous frame"),
    bind(SEQUENCE, &[c(']')], A::OnTrack(NextKey), "next key"),
    bind(SEQUENCE, &[c('[')], A::OnTrack(PreviousKey), "previous key"),
    bind(SEQUENCE, &[c('e')], A::Go(Edit), "keep the frame and edit fields"),
    bind(SEQUENCE, &[c('v')], A::Go(View), "keep the frame and go to VIEW"),
    bind(SEQUENCE, &[key(Enter)], A::Accept, "keep the frame in the text"),
    bind(SEQUENCE, &[key(Esc)], A::Back, "back to the scene"),
    bind(SEQUENCE, &[c('L'), Chord(Right, SHIFT)], A::OnTrack(Frames(10)), "ten frames forward"),
    bind(SEQUENCE, &[c('H'), Chord(Left, SHIFT)], A::OnTrack(Frames(-10)), "ten frames back"),
    in_turn(SEQUENCE, &[c('g'), c('g')], A::OnTrack(Frames(i32::MIN)), "first frame"),
    bind(SEQUENCE, &[key(Home)], A::OnTrack(Frames(i32::MIN)), "first frame"),
    bind(SEQUENCE, &[c('G'), key(End)], A::OnTrack(Frames(i32::MAX)), "last frame"),
    bind(SEQUENCE, &[c('b')], A::Export, "export all frames"),
    bind(SEQUENCE, &[c('x')], A::Stop, "cancel the export"),
    bind(SEQUENCE, &[c('u')], A::OnTrack(TakeBack), "undo the last key"),
    bind(SEQUENCE, &[c('E')], A::OnTrack(Playback::Edit), "open the editor on the track"),
    bind(INSPECTABLE, &[c('i')], A::Go(Inspect), "inspect a pixel of the picture"),
    bind(SELECT, &[key(Tab)], A::Cycle(1), "next light or object"),
    bind(SELECT, &[c('h')], A::Visibility, "show or hide the object"),
    bind(SELECT, &[c('/')], A::Search, "filter the list"),
    bind(SELECT, &[key(Left)], A::Fold(Fold::Selected), "fold the group, or go to it"),
    bind(SELECT, &[key(Right)], A::Fold(Fold::Unselected), "unfold the group, or go into it"),
    bind(SELECT, &[Chord(Left, SHIFT)], A::Fold(Fold::All), "fold all groups"),
    bind(SELECT, &[Chord(Right, SHIFT)], A::Fold(Fold::None), "unfold all groups"),
    in_turn(LONG_LISTS, &[c('g'), c('g')], A::First, "first"),
    bind(LONG_LISTS, &[c('G'), key(End)], A::Last, "last"),
    bind(LONG_LISTS, &[key(Home)], A::First, "first"),
    bind(LONG_LISTS, &[key(PageDown)], A::Page(1), "page down"),
    bind(LONG_LISTS, &[key(PageUp)], A::Page(-1), "page up"),
    bind(SELECT, &[c('o')], A::Outline, "toggle the outline of the selection"),
    bind(SELECT, &[c('O')], A::Symbols, "show symbols of all lights, cameras and groups, or of the selected kind"),
    bind(SELECT, &[c('n')], A::SearchAgain(1), "next match"),
    bind(SELECT, &[c('N')], A::SearchAgain(-1), "previous match"),
    bind(SELECT, &[key(BackTab)], A::Cycle(-1), "previous light or object"),

    bind(VALUES, &[c('l'), key(Right)], A::Nudge(1, Plain), "nudge up"),
    bind(VALUES, &[c('h'), key(Left)], A::Nudge(-1, Plain), "nudge down"),
    bind(EDIT, &[key(Enter)], A::Choose, "choose from a list, or type a number"),
    bind(EDIT, &[c('i')], A::Type, "type a value (or press a digit or #)"),
    bind(EDIT, &[c('c')], A::Colour, "pick a colour"),
    bind(EDIT, &[key(Tab)], A::Component(1), "next number"),
    bind(VALUES, &[c('L'), Chord(Right, SHIFT)], A::Nudge(1, Coarse), "nudge up ten steps"),
    bind(VALUES, &[c('H'), Chord(Left, SHIFT)], A::Nudge(-1, Coarse), "nudge down ten steps"),
    bind(VALUES, &[alt('l'), Chord(Right, ALT)], A::Nudge(1, Fine), "nudge up a tenth"),
    bind(VALUES, &[alt('h'), Chord(Left, ALT)], A::Nudge(-1, Fine), "nudge down a tenth"),
    bind(VALUES, &[c(',')], A::Stride(-1), "smaller steps"),
    bind(VALUES, &[c(';')], A::Stride(1), "larger steps"),
    bind(EDIT, &[key(BackTab)], A::Component(-1), "previous number"),
    bind(EDIT, &[c('O')], A::Orthonormalise, "orthonormalise the frame"),
    bind(COLOUR, &[key(Enter)], A::Accept, "confirm"),
    bind(COLOUR, &[key(Esc)], A::Back, "cancel"),

    bind(VIEW, &[c('h'), key(Left)], A::Orbit(1, 0), "orbit left"),
    bind(VIEW, &[c('j'), key(Down)], A::Orbit(0, -1), "orbit down"),
    bind(VIEW, &[c('k'), key(Up)], A::Orbit(0, 1), "orbit up"),
    bind(VIEW, &[c('l'), key(Right)], A::Orbit(-1, 0), "orbit right"),
    bind(VIEW, &[c('+'), c('=')], A::Dolly(1), "nearer"),
    bind(VIEW, &[c('-')], A::Dolly(-1), "farther"),
    bind(VIEW, &[c('H'), Chord(Left, SHIFT)], A::Pan(1, 0), "pan left"),
    bind(VIEW, &[c('J'), Chord(Down, SHIFT)], A::Pan(0, -1), "pan down"),
    bind(VIEW, &[c('K'), Chord(Up, SHIFT)], A::Pan(0, 1), "pan up"),
    bind(VIEW, &[c('L'), Chord(Right, SHIFT)], A::Pan(-1, 0), "pan right"),
    bind(VIEW, &[c('F')], A::Go(Fly), "fly: turn in place and move"),
    bind(FLY, &[c('h'), key(Left)], A::Turn(1, 0), "turn left"),
    bind(FLY, &[c('j'), key(Down)], A::Turn(0, -1), "turn down"),
    bind(FLY, &[c('k'), key(Up)], A::Turn(0, 1), "turn up"),
    bind(FLY, &[c('l'), key(Right)], A::Turn(-1, 0), "turn right"),
    bind(FLY, &[c('K'), Chord(Up, SHIFT), c('+'), c('=')], A::Advance(1), "forward"),
    bind(FLY, &[c('J'), Chord(Down, SHIFT), c('-')], A::Advance(-1), "back"),
    bind(FLY, &[c('H'), Chord(Left, SHIFT)], A::Pan(1, 0), "left"),
    bind(FLY, &[c('L'), Chord(Right, SHIFT)], A::Pan(-1, 0), "right"),
    bind(FLY, &[c('F')], A::Go(View), "move around the target again"),
    bind(VIEWS, &[c('f')], A::FrameSelected, "frame the selected object"),
    bind(VIEWS, &[c('0')], A::ResetView, "reset to the scene's view"),
    bind(VIEWS, &[c('S')], A::SaveView, "write the view into the scene"),
    bind(VIEWS, &[c('o')], A::LightView, "look from the selected light"),
    bind(VIEWS, &[c('V')], A::SavedViews, "saved views"),
    bind(VIEWS, &[c('[')], A::Widen(-1), "narrow the field of view"),
    bind(VIEWS, &[c(']')], A::Widen(1), "widen the field of view"),
    bind(VIEWS, &[c(',')], A::Roll(1), "roll left"),
    bind(VIEWS, &[c('.')], A::Roll(-1), "roll right"),

    bind(INSPECT, &[c('h'), key(Left)], A::Cross(-1, 0), "left"),
    bind(INSPECT, &[c('j'), key(Down)], A::Cross(0, 1), "down"),
    bind(INSPECT, &[c('k'), key(Up)], A::Cross(0, -1), "up"),
    bind(INSPECT, &[c('l'), key(Right)], A::Cross(1, 0), "right"),
    bind(INSPECT, &[c('H'), Chord(Left, SHIFT)], A::Cross(-8, 0), "left 8 pixels"),
    bind(INSPECT, &[c('J'), Chord(Down, SHIFT)], A::Cross(0, 8), "down 8 pixels"),
    bind(INSPECT, &[c('K'), Chord(Up, SHIFT)], A::Cross(0, -8), "up 8 pixels"),
    bind(INSPECT, &[c('L'), Chord(Right, SHIFT)], A::Cross(8, 0), "right 8 pixels"),
    bind(INSPECT, &[key(Enter)], A::Accept, "select what is there"),
    bind(INSPECT, &[c('e')], A::Explain, "explain the pixel"),
    bind(RAYS, &[key(Enter)], A::Accept, "select its object or light"),
    bind(RAYS, &[c('l')], A::Solo, "show only its light in the preview"),
    bind(RAYS, &[key(Left)], A::Fold(Fold::Selected), "fold it, or go to what it is in"),
    bind(RAYS, &[key(Right)], A::Fold(Fold::Unselected), "unfold it, or go into it"),
    bind(RAYS, &[c(',')], A::Sample(-1), "previous sample"),
    bind(RAYS, &[c('.')], A::Sample(1), "next sample"),

    bind(COMPARE, &[c('f')], A::Flip, "flip: the picture or the reference"),
    bind(COMPARE, &[c('w')], A::Wipe, "wipe: the picture beside the reference (:w saves)"),
    bind(COMPARE, &[c('h'), key(Left)], A::SlideWipe(-1), "wipe further left"),
    bind(COMPARE, &[c('l'), key(Right)], A::SlideWipe(1), "wipe further right"),
    bind(COMPARE, &[c('H'), Chord(Left, SHIFT)], A::SlideWipe(-8), "wipe 8 cells further left"),
    bind(COMPARE, &[c('L'), Chord(Right, SHIFT)], A::SlideWipe(8), "wipe 8 cells further right"),
    bind(COMPARE, &[c('d')], A::Difference, "difference, times 4, times 16, heat map"),
    bind(COMPARE, &[c('+')], A::Magnify(1), "zoom in"),
    bind(COMPARE, &[c('-')], A::Magnify(-1), "zoom out"),
    bind(COMPARE, &[c('e')], A::Explain, "explain the pixel that is pointed at, or the worst"),
    bind(COMPARE, &[c('n')], A::Worst(1), "next of the worst pixels"),
    bind(COMPARE, &[c('N')], A::Worst(-1), "previous of the worst pixels"),

    bind(CONFLICT, &[c('M')], A::AllMine, "keep mine everywhere"),
    bind(CONFLICT, &[c('T')], A::AllTheirs, "take the file's everywhere"),
    bind(CONFLICT, &[key(Esc)], A::Back, "decide later"),
    bind(QUIT, &[c('y')], A::Accept, "quit anyway"),
    bind(QUIT, &[c('w')], A::Save, "save and quit"),
    bind(QUIT, &[c('S')], A::SaveView, "write the moved view, save and quit"),
    bind(QUIT, &[c('n'), key(Esc)], A::Back, "stay"),
    bind(DELETE, &[c('y'), c('d')], A::Accept, "delete"),
    bind(DELETE, &[c('n'), key(Esc)], A::Back, "keep"),
    bind(LEAVE, &[c('y')], A::Accept, "discard unsaved changes"),
    bind(LEAVE, &[c('w')], A::Save, "save first"),
    bind(LEAVE, &[c('S')], A::SaveView, "write the moved view and save first"),
    bind(LEAVE, &[c('n'), key(Esc)], A::Back, "stay"),
    bind(MOVED_VIEW, &[c('S')], A::SaveView, "write the moved view and save first"),
    bind(MOVED_VIEW, &[c('y')], A::Accept, "leave without it"),
    bind(MOVED_VIEW, &[c('n'), key(Esc)], A::Back, "stay"),
    bind(WAIT, &[c('w')], A::Save, "wait, then quit"),
    bind(WAIT, &[c('y')], A::Accept, "quit now and cancel it"),
    bind(WAIT, &[c('n'), key(Esc)], A::Back, "stay"),
    bind(OVERWRITE, &[c('y')], A::Accept, "overwrite it"),
    bind(OVERWRITE, &[c('n')], A::No, "write a numbered file instead"),
    bind(OVERWRITE, &[key(Esc)], A::Back, "cancel the export"),
    bind(RECOVER, &[c('r')], A::Accept, "restore them"),
    bind(RECOVER, &[c('d')], A::No, "discard them"),
    bind(RECOVER, &[key(Esc)], A::Back, "decide next time"),
    bind(VIEWS_PAGE, &[key(Enter)], A::Accept, "go there"),
    bind(VIEWS_PAGE, &[c('d')], A::DeleteView, "delete it"),
    bind(VIEWS_PAGE, &[c('/')], A::Search, "filter"),
    bind(VIEWS_PAGE, &[key(Esc), c('q'), c('V')], A::Back, "close"),
    bind(RECENT, &[key(Enter)], A::Accept, "open it"),
    bind(RECENT, &[c('/')], A::Search, "filter"),
    bind(RECENT, &[key(Esc), c('q')], A::Back, "close"),
    bind(STEPS, &[key(Enter)], A::Accept, "go there"),
    bind(STEPS, &[c('u')], A::Undo, "undo"),
    bind(STEPS, &[ctrl('r')], A::Redo, "redo"),
    bind(STEPS, &[c('/')], A::Search, "filter"),
    bind(STEPS, &[key(Esc), c('q'), c('U')], A::Back, "close"),
    bind(HELP, &[c('/')], A::Search, "search"),
    bind(MESSAGES, &[key(Esc), c('q'), c('M')], A::Back, "close"),
    bind(HELP, &[key(Esc), c('q'), c('?')], A::Back, "close"),

    bind(PICTURES, &[c('1')], A::Show(None), "show light"),
    bind(PICTURES, &[c('2')], A::Show(Some(Aov::Depth)), "show depth, nearest white"),
    bind(PICTURES, &[c('3')], A::Show(Some(Aov::Normal)), "show normals"),
    bind(PICTURES, &[c('4')], A::Show(Some(Aov::Object)), "show objects, one colour each"),
    bind(PICTURES, &[c('5')], A::Show(Some(Aov::Albedo)), "show unlit colours"),
    bind(PICTURES, &[c('7')], A::Show(Some(Aov::Cost)), "show cost: rays traced"),
    bind(PICTURES, &[c('8')], A::Show(Some(Aov::Samples)), "show samples taken"),
    bind(PICTURES, &[c('9')], A::Show(Some(Aov::Noise)), "show noise: estimated error"),
    bind(PICTURES, &[c(')')], A::Share(1), "next share of the light"),
    bind(PICTURES, &[c('(')], A::Share(-1), "previous share of the light"),

    bind(PREVIEWS, &[c('6')], A::Wireframe, "show a wireframe, for slow links"),

    bind(TRACE, &[c('h'), key(Left)], A::Scroll(-1, 0), "pan left"),
    bind(TRACE, &[c('j'), key(Down)], A::Scroll(0, 1), "pan down"),
    bind(TRACE, &[c('k'), key(Up)], A::Scroll(0, -1), "pan up"),
    bind(TRACE, &[c('l'), key(Right)], A::Scroll(1, 0), "pan right"),
    bind(TRACE, &[c('+')], A::Magnify(1), "zoom in"),
    bind(TRACE, &[c('-')], A::Magnify(-1), "zoom out"),
    bind(TRACE, &[c('z')], A::OneToOne, "zoom to 1:1, or fit the picture"),
    bind(TRACE, &[c(' ')], A::Pause, "pause or continue"),
    bind(TRACE, &[c('R')], A::Region, "draw a region to trace alone"),
    bind(TRACE, &[c('x')], A::Stop, "stop"),
    bind(REGION, &[c('h'), key(Left)], A::Corner(-1, 0), "corner left"),
    bind(REGION, &[c('j'), key(Down)], A::Corner(0, 1), "corner down"),
    bind(REGION, &[c('k'), key(Up)], A::Corner(0, -1), "corner up"),
    bind(REGION, &[c('l'), key(Right)], A::Corner(1, 0), "corner right"),
    bind(REGION, &[c('H'), Chord(Left, SHIFT)], A::Corner(-8, 0), "corner left 8 pixels"),
    bind(REGION, &[c('J'), Chord(Down, SHIFT)], A::Corner(0, 8), "corner down 8 pixels"),
    bind(REGION, &[c('K'), Chord(Up, SHIFT)], A::Corner(0, -8), "corner up 8 pixels"),
    bind(REGION, &[c('L'), Chord(Right, SHIFT)], A::Corner(8, 0), "corner right 8 pixels"),
    bind(REGION, &[key(Tab)], A::OtherCorner, "other corner"),
    bind(REGION, &[key(Enter)], A::Accept, "trace the region"),
    bind(REGION, &[key(Esc)], A::Back, "cancel"),
    bind(SELECT, &[c('x')], A::Stop, "cancel the export"),
    bind(Scope::Everywhere, &[key(Esc)], A::Back, "back"),
    bind(Scope::Sceneless, &[c('?')], A::Help, "help"),
    bind(Scope::Sceneless, &[c(':')], A::Command, "command"),
    bind(Scope::Everywhere, &[c('w')], A::Save, "save the scene"),
    bind(Scope::Everywhere, &[c('b')], A::Export, "export what is shown"),
    bind(Scope::Everywhere, &[key(F(5)), c('r')], A::Go(Trace), "trace at full size"),
    bind(Scope::Everywhere, &[c('A')], A::Pin, "pin the picture, to compare with it"),
    bind(Scope::Everywhere, &[c('=')], A::Go(Compare), "compare with the reference"),
    bind(Scope::Everywhere, &[c('u')], A::Undo, "undo"),
    bind(Scope::Everywhere, &[ctrl('r')], A::Redo, "redo"),
    bind(Scope::Everywhere, &[c('U')], A::Steps, "undo history as pictures"),
    bind(Scope::Everywhere, &[c('!')], A::Errors, "errors and warnings"),
    bind(Scope::Sceneless, &[c('M')], A::Messages, "messages so far"),
    bind(Scope::Everywhere, &[c('E')], A::Editor, "open the editor at the selected item"),
    bind(PLAYED, &[c('T')], A::Go(Sequence), "play the track"),
    bind(KEYED, &[c('I')], A::OnTrack(Key), "key the value, or in VIEW the camera, in the track"),
    bind(PANELS, &[c('z')], A::Zoom, "show or hide the panels"),
    bind(Scope::Everywhere, &[c('{')], A::Resize(2), "larger panels"),
    bind(Scope::Everywhere, &[c('}')], A::Resize(-2), "smaller panels"),
    bind(Scope::Everywhere, &[alt('{')], A::Divide(-1), "smaller list, larger fields"),
    bind(Scope::Everywhere, &[alt('}')], A::Divide(1), "larger list, smaller fields"),
    bind(Scope::Everywhere, &[c('<')], A::Expose(-1), "darker display, by half a stop"),
    bind(Scope::Everywhere, &[c('>')], A::Expose(1), "brighter display"),
    bind(Scope::Everywhere, &[c('~')], A::Denoise, "reduce noise on screen, or no longer"),
    bind(Scope::Everywhere, &[c('P')], A::Integrator, "next integrator: Whitted, paths, photons"),
    bind(Scope::Everywhere, &[c('C')], A::Cure, "apply the suggested render setting"),
    bind(Scope::Always, &[ctrl('l')], A::Repaint, "redraw the screen"),
    bind(Scope::Always, &[ctrl('z')], A::Suspend, "suspend"),
    bind(Scope::Sceneless, &[c('q')], A::Quit, "quit"),
    bind(Scope::Always, &[ctrl('c')], A::Interrupt, "quit; press twice to quit at once"),
    bind(VIEWS, &[c('e')], A::Go(Edit), "edit fields"),
    bind(EDIT, &[c('v')], A::Go(View), "move the camera"),
    bind(VIEWS, &[key(Enter)], A::Go(Select), "back to the list"),
];

impl Binding {
    /// The keys of the row.
    pub(super) fn keys(&self) -> Vec<Keys> {
        match (self.pressed, self.chords) {
            (Pressed::InTurn, &[first, second]) => vec![Keys::in_turn(first, second)],
            (_, chords) => chords.iter().copied().map(Keys::one).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use Context::{
        Conflict, Errors, Help, Leave, Messages, MovedView, Opening, Overwrite, Quit, Recent,
        Recover, Views, Wait,
    };

    #[test]
    fn no_key_has_two_meanings_in_one_context() {
        let modes = Mode::ALL.map(Context::In);
        let others = [
            Opening,
            Help,
            Messages,
            Errors,
            Views,
            Recent,
            Context::Steps,
            Context::Colour,
            Context::Rays,
            Context::Region,
            Conflict,
            Quit,
            Leave,
            MovedView,
            Context::Delete,
            Wait,
            Overwrite,
            Recover,
        ];
        for context in modes.into_iter().chain(others) {
            // A key of the context itself takes precedence over one that acts anywhere.
            for is_own in [true, false] {
                let rows = TABLE.iter().filter(|row| row.scope.holds(context));
                let rows = rows.filter(|row| matches!(row.scope, Scope::These(_)) == is_own);
                let mut bound: Vec<_> = rows.flat_map(Binding::keys).collect();
                while let Some(keys) = bound.pop() {
                    let is_free = bound.iter().all(|other| !other.collides(keys));
                    assert!(is_free, "{context:?} {keys:?}");
                }
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
}
