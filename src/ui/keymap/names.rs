//! The names of actions and of sections of keys, by which a configuration refers to them.

use super::action::{Action, Context, Fold, Mode, Stride, Tool};
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
        A::Fold(Fold::Selected) => "fold",
        A::Fold(Fold::Unselected) => "unfold",
        A::Fold(Fold::All) => "fold-all",
        A::Fold(Fold::None) => "unfold-all",
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
        A::Transform(Tool::Move) => "move",
        A::Transform(Tool::Rotate) => "rotate",
        A::Transform(Tool::Scale) => "scale",
        A::Explain => "explain",
        A::Sample(1..) => "next-sample",
        A::Sample(_) => "previous-sample",
        A::Step(..) | A::Cross(..) | A::Nudge(..) => of_step(action),
        A::Lock(0) => "lock-x",
        A::Lock(1) => "lock-y",
        A::Lock(_) => "lock-z",
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
        A::Resize(1..) => "larger-panels",
        A::Resize(_) => "smaller-panels",
        A::Divide(1..) => "larger-list",
        A::Divide(_) => "smaller-list",
        A::Show(None) => "show-light",
        A::Show(Some(Aov::Depth)) => "show-depth",
        A::Show(Some(Aov::Normal)) => "show-normals",
        A::Show(Some(Aov::Object)) => "show-objects",
        A::Show(Some(Aov::Albedo)) => "show-albedo",
        A::Show(Some(Aov::Uv)) => "show-uv",
        A::Show(Some(Aov::Side)) => "show-sides",
        A::Show(Some(Aov::Cost)) => "show-cost",
        A::Show(Some(Aov::Samples)) => "show-samples",
        A::Show(Some(Aov::Noise)) => "show-noise",
        A::Show(Some(Aov::Direct(_))) => "show-direct",
        A::Show(Some(Aov::Emission)) => "show-emission",
        A::Show(Some(Aov::Indirect)) => "show-indirect",
        A::Share(1..) => "next-share",
        A::Share(_) => "previous-share",
        A::Expose(1..) => "brighter",
        A::Expose(_) => "darker",
        A::Wireframe => "wireframe",
        A::Integrator => "integrator",
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
