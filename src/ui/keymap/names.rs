//! The names of actions and of sections of keys, by which a configuration refers to them.

use super::action::{Action, Context, Fold, Mode, Playback, Stride, Tool};
use crate::language::Neighbour;
use crate::render::Aov;

use Action as A;

/// The section of the keys that are the same in all modes.
pub(super) const ANYWHERE: &str = "anywhere";

/// The name of an action; it never changes.
pub(super) const fn of_action(action: Action) -> &'static str {
    match action {
        A::Move(1..) => "down",
        A::Move(_) => "up",
        A::Page(1..) => "page-down",
        A::Page(_) => "page-up",
        A::First => "first",
        A::Last => "last",
        A::Cycle(1..) => "next-item",
        A::Cycle(_) => "previous-item",
        A::Go(mode) => of_mode(mode),
        A::Back => "back",
        A::Accept => "accept",
        A::Fold(fold) => of_fold(fold),
        A::Search => "search",
        A::SearchAgain(1..) => "next-match",
        A::SearchAgain(_) => "previous-match",
        A::Command => "command",
        A::Outline => "outline",
        A::Symbols => "symbols",
        A::Visibility => "visibility",
        A::Mark => "mark",
        A::Delete => "delete",
        A::Duplicate => "duplicate",
        A::Reorder(Neighbour::Previous) => "reorder-up",
        A::Reorder(Neighbour::Next) => "reorder-down",
        A::Copy => "copy",
        A::Insert => "paste",
        A::Rename => "rename",
        A::Solo => "solo",
        A::Add => "add",
        A::Retype => "change-type",
        A::Transform(tool) => of_tool(tool),
        A::Explain => "explain",
        A::Sample(1..) => "next-sample",
        A::Sample(_) => "previous-sample",
        A::Step(..) | A::Cross(..) | A::Nudge(..) => of_step(action),
        A::Lock(axis) => of_lock(axis),
        A::Snap => "snap",
        A::Choose => "choose",
        A::Type => "type",
        A::Colour => "pick-colour",
        A::Orthonormalise => "orthonormalise",
        A::Stride(1..) => "larger-steps",
        A::Stride(_) => "smaller-steps",
        A::Component(1..) => "next-number",
        A::Component(_) => "previous-number",
        A::Orbit(..)
        | A::Pan(..)
        | A::Dolly(_)
        | A::Turn(..)
        | A::Advance(_)
        | A::Roll(_)
        | A::Widen(_) => of_camera(action),
        A::ResetView => "reset-view",
        A::FrameSelected => "frame-selection",
        A::SaveView => "write-view",
        A::LightView => "view-from-light",
        A::SavedViews => "saved-views",
        A::DeleteView => "delete-view",
        A::Pin => "pin",
        A::Flip | A::Wipe | A::SlideWipe(_) | A::Difference | A::Worst(_) => of_comparison(action),
        A::OnTrack(action) => of_playback(action),
        A::Stop => "stop",
        A::Pause => "pause",
        A::Magnify(1..) => "zoom-in",
        A::Magnify(_) => "zoom-out",
        A::Scroll(..) | A::Corner(..) => of_window(action),
        A::OneToOne => "one-to-one",
        A::Region => "region",
        A::OtherCorner => "other-corner",
        A::Export => "export",
        A::Save => "save",
        A::Undo => "undo",
        A::Redo => "redo",
        A::Steps => "history",
        A::Editor => "editor",
        A::Errors => "errors",
        A::Messages => "messages",
        A::Help => "help",
        A::Zoom => "panels",
        A::Resize(_) | A::Divide(_) => of_panels(action),
        A::Show(aov) => of_view(aov),
        A::Share(1..) => "next-share",
        A::Share(_) => "previous-share",
        A::Expose(1..) => "brighter",
        A::Expose(_) => "darker",
        A::Denoise => "denoise",
        A::Wireframe => "wireframe",
        A::Integrator => "integrator",
        A::Cure => "cure",
        A::Repaint => "redraw",
        A::Suspend => "suspend",
        A::Quit => "quit",
        A::Interrupt => "interrupt",
        A::Mine => "mine",
        A::Theirs => "theirs",
        A::AllMine => "all-mine",
        A::AllTheirs => "all-theirs",
        A::No => "no",
    }
}

const fn of_fold(fold: Fold) -> &'static str {
    match fold {
        Fold::Selected => "fold",
        Fold::Unselected => "unfold",
        Fold::All => "fold-all",
        Fold::None => "unfold-all",
    }
}

const fn of_lock(axis: usize) -> &'static str {
    match axis {
        0 => "lock-x",
        1 => "lock-y",
        _ => "lock-z",
    }
}

const fn of_tool(tool: Tool) -> &'static str {
    match tool {
        Tool::Move => "move",
        Tool::Rotate => "rotate",
        Tool::Scale => "scale",
    }
}

const fn of_view(aov: Option<Aov>) -> &'static str {
    match aov {
        None => "show-light",
        Some(Aov::Depth) => "show-depth",
        Some(Aov::Normal) => "show-normals",
        Some(Aov::Object) => "show-objects",
        Some(Aov::Albedo) => "show-albedo",
        Some(Aov::Uv) => "show-uv",
        Some(Aov::Side) => "show-sides",
        Some(Aov::Cost) => "show-cost",
        Some(Aov::Samples) => "show-samples",
        Some(Aov::Noise) => "show-noise",
        Some(Aov::Direct(_)) => "show-direct",
        Some(Aov::Emission) => "show-emission",
        Some(Aov::Indirect) => "show-indirect",
    }
}

const fn of_mode(mode: Mode) -> &'static str {
    match mode {
        Mode::Select => "list",
        Mode::View => "camera",
        Mode::Fly => "fly",
        Mode::Edit => "edit",
        Mode::Trace => "trace",
        Mode::Inspect => "inspect",
        Mode::Compare => "compare",
        Mode::Move => "transform",
        Mode::Sequence => "track",
    }
}

const fn of_panels(action: Action) -> &'static str {
    match action {
        A::Resize(1..) => "larger-panels",
        A::Resize(_) => "smaller-panels",
        A::Divide(1..) => "larger-list",
        _ => "smaller-list",
    }
}

const fn of_playback(action: Playback) -> &'static str {
    match action {
        Playback::Play => "play",
        Playback::Frames(i32::MIN) => "first-frame",
        Playback::Frames(i32::MAX) => "last-frame",
        Playback::Frames(2..) => "frames-forward",
        Playback::Frames(0..) => "next-frame",
        Playback::Frames(-1) => "previous-frame",
        Playback::Frames(_) => "frames-back",
        Playback::NextKey => "next-key",
        Playback::PreviousKey => "previous-key",
        Playback::Key => "key",
        Playback::TakeBack => "undo-key",
        Playback::Edit => "edit-track",
    }
}

const fn of_comparison(action: Action) -> &'static str {
    match action {
        A::Flip => "flip",
        A::Wipe => "wipe",
        A::SlideWipe(2..) => "wipe-right-far",
        A::SlideWipe(1) => "wipe-right",
        A::SlideWipe(-1) => "wipe-left",
        A::SlideWipe(_) => "wipe-left-far",
        A::Worst(1..) => "next-worst",
        A::Worst(_) => "previous-worst",
        _ => "difference",
    }
}

const fn of_step(action: Action) -> &'static str {
    match action {
        A::Step(1.., _, Stride::Coarse) => "step-right-far",
        A::Step(1.., ..) => "step-right",
        A::Step(0, 1.., Stride::Coarse) => "step-up-far",
        A::Step(0, 1.., _) => "step-up",
        A::Step(0, _, Stride::Coarse) => "step-down-far",
        A::Step(0, ..) => "step-down",
        A::Step(_, _, Stride::Coarse) => "step-left-far",
        A::Step(..) => "step-left",
        A::Cross(2.., _) => "cross-right-far",
        A::Cross(1, _) => "cross-right",
        A::Cross(0, 2..) => "cross-down-far",
        A::Cross(0, 1) => "cross-down",
        A::Cross(0, -1) => "cross-up",
        A::Cross(0, _) => "cross-up-far",
        A::Cross(-1, _) => "cross-left",
        A::Cross(..) => "cross-left-far",
        A::Nudge(1.., Stride::Fine) => "nudge-up-fine",
        A::Nudge(1.., Stride::Plain) => "nudge-up",
        A::Nudge(1.., Stride::Coarse) => "nudge-up-coarse",
        A::Nudge(_, Stride::Fine) => "nudge-down-fine",
        A::Nudge(_, Stride::Plain) => "nudge-down",
        _ => "nudge-down-coarse",
    }
}

const fn of_window(action: Action) -> &'static str {
    match action {
        A::Scroll(1.., _) => "scroll-right",
        A::Scroll(0, 1..) => "scroll-down",
        A::Scroll(0, _) => "scroll-up",
        A::Scroll(..) => "scroll-left",
        A::Corner(2.., _) => "corner-right-far",
        A::Corner(1, _) => "corner-right",
        A::Corner(0, 2..) => "corner-down-far",
        A::Corner(0, 1) => "corner-down",
        A::Corner(0, -1) => "corner-up",
        A::Corner(0, _) => "corner-up-far",
        A::Corner(-1, _) => "corner-left",
        _ => "corner-left-far",
    }
}

const fn of_camera(action: Action) -> &'static str {
    match action {
        A::Orbit(1.., _) => "orbit-left",
        A::Orbit(0, 1..) => "orbit-up",
        A::Orbit(0, _) => "orbit-down",
        A::Orbit(..) => "orbit-right",
        A::Pan(1.., _) => "pan-left",
        A::Pan(0, 1..) => "pan-up",
        A::Pan(0, _) => "pan-down",
        A::Pan(..) => "pan-right",
        A::Dolly(1..) => "nearer",
        A::Dolly(_) => "farther",
        A::Turn(1.., _) => "turn-left",
        A::Turn(0, 1..) => "turn-up",
        A::Turn(0, _) => "turn-down",
        A::Turn(..) => "turn-right",
        A::Advance(1..) => "forward",
        A::Advance(_) => "backward",
        A::Roll(1..) => "roll-left",
        A::Roll(_) => "roll-right",
        A::Widen(1..) => "wider-view",
        _ => "narrower-view",
    }
}

/// The name of a context's section; `None` if its keys are those of [`ANYWHERE`].
pub(super) const fn of_context(context: Context) -> Option<&'static str> {
    Some(match context {
        Context::In(Mode::Select) => "select",
        Context::In(Mode::View) => "view",
        Context::In(Mode::Fly) => "fly",
        Context::In(Mode::Edit) => "edit",
        Context::In(Mode::Trace) => "trace",
        Context::In(Mode::Inspect) => "inspect",
        Context::In(Mode::Compare) => "compare",
        Context::In(Mode::Move) => "move",
        Context::In(Mode::Sequence) => "sequence",
        Context::Colour => "colour",
        Context::Rays => "rays",
        Context::Region => "region",
        Context::Opening => return None,
        Context::Help => "help",
        Context::Messages => "messages",
        Context::Errors => "errors",
        Context::Views => "views",
        Context::Recent => "recent",
        Context::Steps => "history",
        Context::Conflict => "conflict",
        Context::Quit => "quit",
        Context::Delete => "delete",
        Context::Leave => "leave",
        Context::MovedView => "moved-view",
        Context::Wait => "wait",
        Context::Overwrite => "overwrite",
        Context::Recover => "recover",
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ui::keymap::table::TABLE;

    #[test]
    fn different_actions_have_different_names() {
        for (at, row) in TABLE.iter().enumerate() {
            let name = of_action(row.action);
            let is_kebab = |c: char| c.is_ascii_lowercase() || c == '-';
            assert!(name.chars().all(is_kebab), "{name}");
            for other in &TABLE[..at] {
                let is_same = of_action(other.action) == name;
                assert_eq!(is_same, other.action == row.action, "{row:?} {other:?}");
            }
        }
    }
}
