//! How INSPECT reacts to steps, presses and drags.

use super::explaining::{click_ray, follow, ray_panels, scroll_rays};
use super::inspecting::place_cross;
use crate::app::room::Room;
use crate::app::{Shared, display};
use crate::keymap::{Context, Mode};
use crate::msg::Effect;

/// INSPECT. It has no state of its own: the editor opens at what it looks at, and the status line names that.
#[derive(Debug, Default)]
pub struct Inspect;

impl Room for Inspect {
    fn follow(&mut self, shared: &mut Shared) -> Vec<Effect> {
        scroll_rays(shared);
        follow(shared).into_iter().collect()
    }

    fn press(&mut self, shared: &mut Shared, at: (u16, u16)) -> Option<Vec<Effect>> {
        if shared.context() == Context::Rays
            && let Some(panels) = ray_panels(shared)
            && (panels.tree.contains(at.into()) || panels.values.contains(at.into()))
        {
            click_ray(shared, &panels, at);
            return Some(Vec::new());
        }
        let cell = display::picture_cell(shared, at);
        let cell = cell.filter(|_| shared.mode == Mode::Inspect)?;
        place_cross(shared, cell);
        Some(Vec::new())
    }

    fn drag(&mut self, shared: &mut Shared, at: (u16, u16)) -> Option<Vec<Effect>> {
        if shared.mode != Mode::Inspect {
            return None;
        }
        if let Some(cell) = display::picture_cell(shared, at) {
            place_cross(shared, cell);
        }
        Some(Vec::new())
    }
}
