//! Actions of keys, and the contexts in which keys have a meaning.

use crate::language::Neighbour;
use crate::render::Aov;

/// Meaning of the keys, always shown in the status line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Mode {
    /// Selects a node in the list or in the picture.
    Select,
    /// Moves the camera around its target; the text changes only when the view is saved.
    View,
    /// Flies the camera: turns it in place and moves it with its target.
    Fly,
    /// Edits the fields of the selected node.
    Edit,
    /// Shows the full-size trace.
    Trace,
    /// Moves a cross over the picture to see what is under it, and why.
    Inspect,
    /// Moves, rotates or scales things in the picture.
    Move,
    /// Compares the picture with a reference.
    Compare,
    /// Plays a track and goes to its frames.
    Sequence,
}

impl Mode {
    /// Whether keys, the wheel and dragging move the camera.
    pub const fn moves_camera(self) -> bool {
        matches!(self, Self::View | Self::Fly)
    }
}

impl Mode {
    /// All modes, in the order of the help.
    pub const ALL: [Self; 9] = [
        Self::Select,
        Self::Edit,
        Self::Move,
        Self::View,
        Self::Fly,
        Self::Inspect,
        Self::Trace,
        Self::Compare,
        Self::Sequence,
    ];

    /// The name of the mode, as in the status line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Select => "SELECT",
            Self::View => "VIEW",
            Self::Fly => "VIEW FLY",
            Self::Move => "MOVE",
            Self::Edit => "EDIT",
            Self::Trace => "TRACE",
            Self::Inspect => "INSPECT",
            Self::Compare => "COMPARE",
            Self::Sequence => "SEQUENCE",
        }
    }
}

/// A context with its own key bindings.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Context {
    /// One of the modes.
    In(Mode),
    /// The first reading of a scene.
    Opening,
    /// The help page is open.
    Help,
    /// The history of messages is open.
    Messages,
    /// The list of errors.
    Errors,
    /// The page of saved views.
    Views,
    /// The page of recently used scenes.
    Recent,
    /// The page of the undo history.
    Steps,
    /// The colour picker.
    Colour,
    /// The rays behind the pixel under the cross.
    Rays,
    /// The drawing of a region in the full-size trace.
    Region,
    /// The question how to resolve a merge.
    Conflict,
    /// The question whether to quit although edits are unsaved.
    Quit,
    /// The question whether to delete what others use.
    Delete,
    /// The question whether to leave the scene for another one.
    Leave,
    /// The question whether to leave although the saved text lacks the moved view.
    MovedView,
    /// The question whether to quit although a file is being written.
    Wait,
    /// The question whether an export may overwrite a file.
    Overwrite,
    /// The question whether to recover the edits of an earlier run.
    Recover,
}

/// Action of a key.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// Moves the cursor by this many lines; positive is down.
    Move(isize),
    /// Moves the cursor by this many pages; positive is down.
    Page(isize),
    /// Moves the cursor to the first line.
    First,
    /// Moves the cursor to the last line.
    Last,
    /// Selects the next or previous object or light.
    Cycle(isize),
    /// Switches to a mode.
    Go(Mode),
    /// Goes back or closes the open page; never discards anything.
    Back,
    /// Accepts the item under the cursor.
    Accept,
    /// Folds or unfolds groups in the list.
    Fold(Fold),
    /// Starts filtering the list, or searching the open page.
    Search,
    /// Goes to the next or previous match.
    SearchAgain(isize),
    /// Opens the command prompt.
    Command,
    /// Shows or hides the outline of the selected object.
    Outline,
    /// Shows symbols of all lights, cameras and groups in the picture, or only of the selected kind.
    Symbols,
    /// Shows or hides the selected object itself.
    Visibility,
    /// Marks the selected node for the commands that follow.
    Mark,
    /// Deletes the selected or marked nodes.
    Delete,
    /// Inserts copies of them after them.
    Duplicate,
    /// Exchanges the selected node and its neighbour.
    Reorder(Neighbour),
    /// Copies their text.
    Copy,
    /// Inserts the text copied last.
    Insert,
    /// Types a new name of the selected node.
    Rename,
    /// Shows the selected light alone in the preview, or all again.
    Solo,
    /// Opens the menu of what can be added.
    Add,
    /// Opens the menu of kinds to change to.
    Retype,
    /// Starts to move, rotate or scale.
    Transform(Tool),
    /// Moves, rotates or scales by steps to the right and up.
    Step(i8, i8, Stride),
    /// Locks an axis of the world, then of the thing itself: 0 is x.
    Lock(usize),
    /// Rounds to a grid, or no longer.
    Snap,
    /// Opens the list of the values of a field, or starts typing one.
    Choose,
    /// Starts typing a value.
    Type,
    /// Opens the colour picker.
    Colour,
    /// Makes the directions of a frame orthonormal.
    Orthonormalise,
    /// Adds the step of the field times the stride; positive is up.
    Nudge(i8, Stride),
    /// Makes the stride smaller or larger.
    Stride(isize),
    /// Goes to the next or previous component.
    Component(isize),
    /// Orbits the camera around its target, in steps to the left and up.
    Orbit(i8, i8),
    /// Moves camera and target, in steps to the left and up.
    Pan(i8, i8),
    /// Moves the camera towards its target, in steps.
    Dolly(i8),
    /// Turns the camera in place, in steps to the left and up.
    Turn(i8, i8),
    /// Moves the camera with its target, in steps forward.
    Advance(i8),
    /// Rolls the camera, in steps to the left.
    Roll(i8),
    /// Widens the field of view, in steps.
    Widen(i8),
    /// Resets the view to that of the text.
    ResetView,
    /// Frames the selected object, or the whole scene.
    FrameSelected,
    /// Writes the working view into the text.
    SaveView,
    /// Looks from the selected light.
    LightView,
    /// Lists the saved views.
    SavedViews,
    /// Deletes the saved view under the cursor.
    DeleteView,
    /// Moves the cross, in pixels to the right and down.
    Cross(i32, i32),
    /// Makes the picture on screen the reference that pictures are compared with.
    Pin,
    /// Shows the picture or the reference, in turn.
    Flip,
    /// Shows the picture to the left of a line and the reference to its right.
    Wipe,
    /// Moves that line by this many cells to the right.
    SlideWipe(i16),
    /// Shows the difference, in turn amplified and as a heat map.
    Difference,
    /// Goes to the next or previous of the pixels that differ most.
    Worst(isize),
    /// Plays a track, goes to its frames, or changes it.
    OnTrack(Playback),
    /// Explains the pixel under the cross.
    Explain,
    /// Explains the next or previous sample of the pixel.
    Sample(i32),
    /// Stops the work in progress.
    Stop,
    /// Pauses the full-size trace, or goes on.
    Pause,
    /// Zooms the picture by doublings.
    Magnify(i8),
    /// Moves the window over the picture, in steps to the right and down.
    Scroll(i8, i8),
    /// Shows each pixel as one of the screen, or all of the picture.
    OneToOne,
    /// Begins to draw a region to trace alone.
    Region,
    /// Moves a corner of the region, in pixels of the screen to the right and down.
    Corner(i32, i32),
    /// Moves the opposite corner from now on.
    OtherCorner,
    /// Exports what is shown, under the scene's name.
    Export,
    /// Saves the scene to its file; in the question whether to leave it, then leaves.
    Save,
    /// Undoes the last step and selects what it changed.
    Undo,
    /// Redoes the step undone last and selects what it changed.
    Redo,
    /// Opens the page of the undo history.
    Steps,
    /// Opens the user's editor.
    Editor,
    /// Opens or closes the list of errors.
    Errors,
    /// Opens the history of messages.
    Messages,
    /// Opens or closes the help page.
    Help,
    /// Toggles the size of the picture on the screen.
    Zoom,
    /// Moves the border of the panels by this many cells, towards the picture if positive.
    Resize(i32),
    /// Moves the border of list and fields by this many cells, towards the fields if positive.
    Divide(i32),
    /// Shows one of the auxiliary images, or the lit picture.
    Show(Option<Aov>),
    /// Shows the next share of the light: that of a light, emission, indirect light, all.
    Share(isize),
    /// Changes the exposure of the display, in half stops.
    Expose(i8),
    /// Reduces the noise of pictures on screen, or no longer.
    Denoise,
    /// Shows the preview as a wireframe.
    Wireframe,
    /// Switches between Whitted ray tracing and path tracing.
    Integrator,
    /// Writes the render setting that is suggested for the picture.
    Cure,
    /// Redraws every cell, in case another program has written over them.
    Repaint,
    /// Stops the program until it is continued.
    Suspend,
    /// Quits; asks first if something would be lost.
    Quit,
    /// Ends the program; immediately if repeated.
    Interrupt,
    /// Resolves a conflict with the text of the interface.
    Mine,
    /// Resolves a conflict with the text of the file.
    Theirs,
    /// Resolves all conflicts with the text of the interface.
    AllMine,
    /// Resolves all conflicts with the text of the file.
    AllTheirs,
    /// Declines an offer: discards the edits of an earlier run, or exports to another file.
    No,
}

/// Which groups are folded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fold {
    /// The selected one as well.
    Selected,
    /// Not the selected one.
    Unselected,
    /// All.
    All,
    /// None.
    None,
}

/// How things are transformed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tool {
    /// Moves.
    Move,
    /// Rotates.
    Rotate,
    /// Scales.
    Scale,
}

/// What is done with a track.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Playback {
    /// Plays it, or stops.
    Play,
    /// Goes this many frames on; the extreme values are the first and the last frame.
    Frames(i32),
    /// Goes to the next frame with a key.
    NextKey,
    /// Goes to the previous frame with a key.
    PreviousKey,
    /// Keys the present value.
    Key,
    /// Takes back the key that was written last.
    TakeBack,
    /// Opens the user's editor on it.
    Edit,
}

/// Size of a nudge.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Stride {
    /// A tenth of the field's step.
    Fine,
    /// The step of the field's table entry.
    #[default]
    Plain,
    /// Ten times the field's step.
    Coarse,
}

impl Stride {
    /// The size of one nudge of a field with this step.
    pub fn of(self, step: f64) -> f64 {
        match self {
            Self::Fine => step / 10.0,
            Self::Plain => step,
            Self::Coarse => step * 10.0,
        }
    }
}
