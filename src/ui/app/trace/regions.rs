//! The region of the full-size trace: drawing it, and tracing it alone.

use super::tracing::{enter, start};
use crate::app::pictures::frame_window::Extent;
use crate::app::pictures::region::{Drawing, Held, RegionOrder};
use crate::app::refusing::Refusable;
use crate::app::{Shared, display};
use crate::msg::Effect;
use render::Region;

/// Traces the region that `:region` asks for, or says which it is.
pub(crate) fn order_region(shared: &mut Shared, order: RegionOrder) -> Vec<Effect> {
    match order {
        RegionOrder::Tell => {
            shared.say(match shared.region() {
                Some(region) => format!("the full-size trace is of the region {region}"),
                None => "the full-size trace has no region".to_owned(),
            });
            Vec::new()
        }
        RegionOrder::Off => {
            shared.pictures.region = None;
            shared.say("the full-size trace covers the whole picture");
            display::retrace(shared)
        }
        RegionOrder::Trace(region) => trace_region(shared, region),
    }
}

/// Begins to draw a region: the middle of what is on screen.
pub(super) fn start_region(shared: &mut Shared) {
    let whole = shared.output();
    let Some(frame_window) = display::frame_window(shared) else {
        return;
    };
    let extents = frame_window.window_of(whole).extents();
    let corner = |quarters: u64| {
        extents.map(|Extent { start, length, .. }| {
            let length = u64::from(length);
            start + (length * quarters / 4).min(length - 1) as u32
        })
    };
    shared.pictures.drawing = Some(Drawing {
        fixed: corner(1),
        moving: corner(3),
        held: Held::ByKeys,
    });
}

/// Moves the corner by pixels on screen.
pub(super) fn move_corner(shared: &mut Shared, right: i32, down: i32) {
    let output = shared.output();
    let Some(frame_window) = display::frame_window(shared) else {
        return;
    };
    let extents = frame_window.window_of(output).extents();
    let (steps, limits) = ([right, down], [output.width, output.height]);
    if let Some(drawing) = &mut shared.pictures.drawing {
        drawing.moving = [0, 1].map(|axis| {
            let Extent { length, fills, .. } = extents[axis];
            let pixels = i64::from((length / fills.max(1)).max(1));
            let to = i64::from(drawing.moving[axis]) + i64::from(steps[axis]) * pixels;
            to.clamp(0, i64::from(limits[axis]) - 1) as u32
        });
    }
}

/// Moves the other corner from now on.
pub(super) fn swap_corners(shared: &mut Shared) {
    if let Some(drawing) = &mut shared.pictures.drawing {
        std::mem::swap(&mut drawing.fixed, &mut drawing.moving);
    }
}

/// Draws the region from this cell of the picture on.
pub(super) fn press_region(shared: &mut Shared, cell: (u16, u16)) {
    if let Some(pixel) = display::output_pixel_at(shared, cell) {
        shared.pictures.drawing = Some(Drawing {
            fixed: pixel,
            moving: pixel,
            held: Held::ByPointer,
        });
    }
}

/// Draws the region to this cell of the picture.
pub(super) fn drag_region(shared: &mut Shared, cell: (u16, u16)) {
    let pixel = display::output_pixel_at(shared, cell);
    if let (Some(drawing), Some(pixel)) = (&mut shared.pictures.drawing, pixel) {
        drawing.moving = pixel;
    }
}

/// Traces the region that was drawn.
pub(crate) fn confirm_region(shared: &mut Shared) -> Vec<Effect> {
    let drawn = shared.pictures.drawing.take();
    drawn.map_or_else(Vec::new, |drawing| trace_region(shared, drawing.region()))
}

fn trace_region(shared: &mut Shared, region: Region) -> Vec<Effect> {
    let Some(region) = region.within(shared.output()).or_fail(shared) else {
        return Vec::new();
    };
    let before = shared.pictures.region.replace(region);
    let job = display::trace_job(shared);
    if job.or_refuse_picture(shared).is_none() {
        shared.pictures.region = before;
        return Vec::new();
    }
    shared.say(format!(
        "tracing only the region {region}; :region off traces the whole picture"
    ));
    if shared.pictures.is_tracing() {
        let effects = display::retrace(shared);
        enter(shared);
        effects
    } else {
        start(shared)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn regions_lie_between_corners_in_any_order() {
        for (fixed, moving, region) in [
            ([3, 4], [3, 4], "3,4,1,1"),
            ([3, 4], [5, 9], "3,4,3,6"),
            ([5, 4], [3, 9], "3,4,3,6"),
        ] {
            let drawing = Drawing {
                fixed,
                moving,
                held: Held::ByKeys,
            };
            assert_eq!(drawing.region().to_string(), region);
        }
        assert_eq!(RegionOrder::parse(" off "), Ok(RegionOrder::Off));
        assert_eq!(RegionOrder::parse(""), Ok(RegionOrder::Tell));
        assert!(RegionOrder::parse("1,2").is_err());
    }
}
