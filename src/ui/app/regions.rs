//! The region of the full-size trace: drawing it, and tracing it alone.

use super::Shared;
use super::drawing::{Drawing, Held, RegionOrder};
use super::frame_window::{Marked, Reason};
use crate::render::Region;
use crate::text::Severity;
use crate::ui::keymap::Mode;
use crate::ui::msg::Effect;

impl Shared {
    /// The region to mark in the full-size trace.
    pub(super) fn marked(&self) -> Option<Marked> {
        if self.mode != Mode::Trace {
            return None;
        }
        let whole = self.output();
        let drawn = self
            .pictures
            .drawing
            .map(|drawing| (drawing.region(), Reason::Drawn));
        let traced = self.region().map(|region| (region, Reason::Traced));
        let (region, reason) = drawn.or(traced)?;
        Some(Marked {
            whole,
            region,
            reason,
        })
    }

    /// The region of the full-size trace, if it has one that lies in the picture.
    pub(super) fn region(&self) -> Option<Region> {
        let region = self.pictures.region?;
        region.within(self.output()).ok()
    }

    /// The region being drawn, as told in the status line.
    pub fn region_drawn(&self) -> Option<Region> {
        self.pictures.drawing.map(Drawing::region)
    }

    pub(super) fn order_region(&mut self, order: RegionOrder) -> Vec<Effect> {
        match order {
            RegionOrder::Tell => {
                let words = self.region().map_or_else(
                    || "the full-size trace has no region".to_owned(),
                    |region| format!("the full-size trace is of the region {region}"),
                );
                self.overlays.say(words);
                Vec::new()
            }
            RegionOrder::Off => {
                self.pictures.region = None;
                self.overlays
                    .say("the full-size trace covers the whole picture");
                self.retrace()
            }
            RegionOrder::Trace(region) => self.trace_region(region),
        }
    }

    /// Begins to draw a region: the middle of what is on screen.
    pub(super) fn start_region(&mut self) {
        let whole = self.output();
        let Some(frame_window) = self.frame_window() else {
            return;
        };
        let part = frame_window.window_of(whole).part;
        let at = |from: u32, length: u32, quarters: u32| {
            from + (u64::from(length) * u64::from(quarters) / 4).min(u64::from(length) - 1) as u32
        };
        let corner = |quarters| {
            [
                at(part.x, part.width, quarters),
                at(part.y, part.height, quarters),
            ]
        };
        self.pictures.drawing = Some(Drawing {
            fixed: corner(1),
            moving: corner(3),
            held: Held::ByKeys,
        });
    }

    /// Moves the corner by pixels on screen.
    pub(super) fn move_corner(&mut self, right: i32, down: i32) {
        let output = self.output();
        let Some(frame_window) = self.frame_window() else {
            return;
        };
        let window = frame_window.window_of(output);
        let step = |length: u32, fills: u32| i64::from((length / fills.max(1)).max(1));
        let steps = [
            i64::from(right) * step(window.part.width, window.fills.width),
            i64::from(down) * step(window.part.height, window.fills.height),
        ];
        let limits = [output.width, output.height];
        if let Some(drawing) = &mut self.pictures.drawing {
            drawing.moving = [0, 1].map(|axis| {
                let to = i64::from(drawing.moving[axis]) + steps[axis];
                to.clamp(0, i64::from(limits[axis]) - 1) as u32
            });
        }
    }

    /// Moves the other corner from now on.
    pub(super) fn swap_corners(&mut self) {
        if let Some(drawing) = &mut self.pictures.drawing {
            std::mem::swap(&mut drawing.fixed, &mut drawing.moving);
        }
    }

    /// Draws the region from this cell of the picture on.
    pub(super) fn press_region(&mut self, cell: (u16, u16)) {
        if let Some(pixel) = self.output_pixel_at(cell) {
            self.pictures.drawing = Some(Drawing {
                fixed: pixel,
                moving: pixel,
                held: Held::ByPointer,
            });
        }
    }

    /// Draws the region to this cell of the picture.
    pub(super) fn drag_region(&mut self, cell: (u16, u16)) {
        let pixel = self.output_pixel_at(cell);
        if let (Some(drawing), Some(pixel)) = (&mut self.pictures.drawing, pixel) {
            drawing.moving = pixel;
        }
    }

    /// Traces the region that was drawn.
    pub(super) fn confirm_region(&mut self) -> Vec<Effect> {
        let drawn = self.pictures.drawing.take();
        drawn.map_or_else(Vec::new, |drawing| self.trace_region(drawing.region()))
    }

    fn trace_region(&mut self, region: Region) -> Vec<Effect> {
        if let Err(reason) = region.within(self.output()) {
            self.overlays.fail(reason.to_string());
            return Vec::new();
        }
        let before = self.pictures.region.replace(region);
        if let Err(reason) = self.trace_job() {
            self.pictures.region = before;
            self.refuse_picture(Severity::Error, &reason);
            return Vec::new();
        }
        self.overlays.say(format!(
            "tracing only the region {region}; :region off traces the whole picture"
        ));
        if self.pictures.is_tracing() {
            let effects = self.retrace();
            self.enter_trace();
            effects
        } else {
            self.start_trace()
        }
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
