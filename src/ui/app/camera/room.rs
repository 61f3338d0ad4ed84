//! How VIEW and FLY react to steps, presses and drags.

use super::moves::{advanced, dollied, orbited, shifted, turned};
use super::saved_views::relist;
use super::state::View;
use super::working_view::move_camera;
use crate::app::room::Room;
use crate::app::{Shared, display};
use crate::keymap::Mode;
use crate::msg::Effect;
use render::{camera_axes, pixel_width};

/// Angles of orbit, in degrees, for dragging across a cell, which is twice as high as wide.
const DRAG: (f64, f64) = (2.0, 4.0);

impl Room for View {
    fn settle(&mut self, shared: &mut Shared) {
        relist(self, shared);
    }

    fn press(&mut self, shared: &mut Shared, at: (u16, u16)) -> Option<Vec<Effect>> {
        let is_over = shared.areas().picture.contains(at.into());
        (is_over && shared.mode.moves_camera()).then(|| {
            shared.pictures.drag = Some(at);
            Vec::new()
        })
    }

    /// The scene follows the pointer, so the camera moves the opposite way.
    fn drag(&mut self, shared: &mut Shared, at: (u16, u16)) -> Option<Vec<Effect>> {
        let from = shared.pictures.drag;
        let from = from.filter(|_| shared.mode.moves_camera())?;
        let (left, up) = (DRAG.0 * moved(from.0, at.0), DRAG.1 * moved(from.1, at.1));
        match shared.mode {
            // About the angle of a cell, so that the picture follows the pointer.
            Mode::Fly => move_camera(shared, |now| turned(now, left / 4.0, up / 4.0)),
            _ => move_camera(shared, |now| orbited(now, left, up)),
        }
        shared.pictures.drag = Some(at);
        Some(Vec::new())
    }
}

fn moved(from: u16, to: u16) -> f64 {
    f64::from(to) - f64::from(from)
}

/// Pans the camera so that what is at the distance of the target follows the pointer.
pub(crate) fn drag_to_pan(shared: &mut Shared, from: (u16, u16), at: (u16, u16)) {
    let Some((camera, (_, size))) = shared.camera().zip(shared.raster()) else {
        return;
    };
    let unit = pixel_width(camera.target, &camera, size) / display::magnification(shared, size);
    let [right, up, _] = camera_axes(&camera);
    // A cell shows two pixels, one above the other.
    let by = 2.0 * moved(from.1, at.1) * up - moved(from.0, at.0) * right;
    move_camera(shared, |now| shifted(now, unit * by));
}

/// Moves the camera by some notches of the wheel, forward if positive.
pub(crate) fn wheel(shared: &mut Shared, steps: i8) {
    match shared.mode {
        Mode::Fly => move_camera(shared, |now| advanced(now, steps)),
        _ => move_camera(shared, |now| dollied(now, steps)),
    }
}
