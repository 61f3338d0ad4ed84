//! What pictures show, and how light is displayed: views, light components, exposure.

use std::sync::Arc;

use super::Shared;
use super::histogram::ShownHistogram;
use crate::language::Node;
use crate::render::{Aov, Colours, Frame, Histogram, MOST_HALF_STOPS, denoises, exposes};
use crate::scene::{Emitter, Transfer};
use crate::text::{concise, percentage, rounded};
use crate::ui::msg::Effect;

impl Shared {
    /// Shows light or an AOV.
    pub(super) fn show(&mut self, aov: Option<Aov>) {
        let words = self.pictures.show(aov);
        self.overlays.say(words);
    }

    /// Whether the pictures show something that the display changes.
    fn is_exposed(&self) -> bool {
        self.pictures.wireframe.is_none() && exposes(self.pictures.aov)
    }

    /// Says why the display changes nothing here; returns whether that is so.
    fn refuses_display(&mut self) -> bool {
        let refuses = !self.is_exposed();
        if refuses {
            let light = self.key_for("show-light");
            self.overlays.say(format!(
                "only light and albedo can be exposed; press {light}"
            ));
        }
        refuses
    }

    /// Makes the display brighter, or darker.
    pub(super) fn expose(&mut self, half_stops: i8) {
        let now = self.pictures.display.half_stops;
        self.set_exposure(now.saturating_add(half_stops));
    }

    /// Sets the exposure of the display, in half stops.
    pub(super) fn set_exposure(&mut self, half_stops: i8) {
        if self.refuses_display() {
            return;
        }
        let display = &mut self.pictures.display;
        display.half_stops = half_stops.clamp(-MOST_HALF_STOPS, MOST_HALF_STOPS);
        let words = match display.stops() {
            0.0 => "exposure 0".to_owned(),
            stops => format!("exposure {stops:+} EV, on screen only"),
        };
        self.overlays.say(words);
    }

    /// Displays light by a transfer function, or by the scene's own.
    pub(super) fn set_transfer(&mut self, transfer: Option<Transfer>) {
        if self.refuses_display() {
            return;
        }
        self.pictures.display.transfer = transfer;
        self.overlays.say(match transfer {
            None => "the scene's own transfer",
            Some(Transfer::Linear) => "linear transfer, on screen only",
            Some(Transfer::Srgb) => "sRGB transfer, on screen only",
        });
    }

    /// Displays luminances as false colours, or true colours again.
    pub(super) fn toggle_false_colours(&mut self) {
        if self.refuses_display() {
            return;
        }
        let (colours, words) = match self.pictures.display.colours {
            Colours::True => (
                Colours::False,
                "false colours: luminance, green below 1/256, white above 1",
            ),
            Colours::False => (Colours::True, "true colours"),
        };
        self.pictures.display.colours = colours;
        self.overlays.say(words);
    }

    /// Reduces the noise of the preview and of the full-size trace on screen, or no longer. Both
    /// continue from the samples they have.
    pub(super) fn toggle_denoising(&mut self) -> Vec<Effect> {
        if self.pictures.wireframe.is_some() || !denoises(self.pictures.aov) {
            let light = self.key_for("show-light");
            let words = format!("only light has noise to reduce; press {light}");
            self.overlays.say(words);
            return Vec::new();
        }
        let denoised = &mut self.pictures.display.denoised;
        *denoised = !*denoised;
        self.overlays.say(if *denoised {
            "noise is reduced, on screen only"
        } else {
            "noise is no longer reduced"
        });
        self.pictures.preview.asked = None;
        self.retrace()
    }

    /// Whether the noise of the picture on screen is reduced, in a word; `None` if it is not to be.
    fn denoising_name(&self) -> Option<&'static str> {
        let is_on = self.pictures.display.denoised && denoises(self.pictures.aov);
        let latest = self.picture().latest.as_ref();
        let is_without = latest.is_some_and(|frame| frame.denoised.is_empty());
        let is_unable = self.picture().is_complete() && is_without;
        is_on.then_some(if is_unable {
            "not denoised"
        } else {
            "denoised"
        })
    }

    /// Shows the next or previous light component: all, that of each light, emission, indirect
    /// light.
    pub(super) fn step_share(&mut self, step: isize) {
        let Some(scene) = &self.scene else {
            let reason = self.no_picture();
            self.overlays.fail(reason);
            return;
        };
        let lights = (0..).zip(&scene.lights);
        let lights = lights.filter(|(_, light)| light.emitter != Emitter::Ambient);
        let lights = lights.map(|(number, _)| Some(Aov::Direct(number)));
        let ends = [Some(Aov::Emission), Some(Aov::Indirect)];
        let shares: Vec<_> = [None].into_iter().chain(lights).chain(ends).collect();
        let shown = shares.iter().position(|share| *share == self.pictures.aov);
        let next = shown.unwrap_or(0).checked_add_signed(step);
        let next = next.map_or(shares.len() - 1, |next| next % shares.len());
        let words = self.pictures.show(shares[next]);
        let said = match shares[next] {
            Some(Aov::Direct(light)) => format!("only direct light of {}", self.light_name(light)),
            _ => words.to_owned(),
        };
        self.overlays.say(said);
    }

    fn light_name(&self, light: u32) -> String {
        self.source().name(Node::Light(light as usize))
    }

    /// What the pictures show instead of light, for the status line.
    pub fn view_name(&self) -> Option<String> {
        Some(match self.pictures.aov? {
            Aov::Direct(light) => format!("only {}", self.light_name(light)),
            share if share.is_share() => format!("only {}", share.name()),
            aov => aov.name().to_owned(),
        })
    }

    /// What the colours on screen stand for, where the name of the view does not say it.
    pub fn legend(&self) -> Option<String> {
        if self.pictures.wireframe.is_some() {
            return None;
        }
        let display = self.pictures.display;
        let Some(aov) = self.pictures.aov.filter(|aov| !exposes(Some(*aov))) else {
            let is_false = display.colours == Colours::False;
            return is_false.then(|| "-8 to 0 EV, green below, white above".to_owned());
        };
        match aov {
            Aov::Uv => return Some("u red, v green".to_owned()),
            Aov::Side => return Some("front blue, back orange".to_owned()),
            _ => {}
        }
        let frame = self.picture().latest.as_ref()?;
        let is_shown = frame.settings().is_some_and(|of| of.aov == Some(aov));
        let [least, most] = frame
            .range
            .filter(|[least, most]| is_shown && least <= most)?;
        Some(match aov {
            Aov::Noise => format!("0 to {}", percentage(most)),
            Aov::Cost => format!("{} to {} rays a sample", brief(least), brief(most)),
            _ => format!("{} to {}", brief(least), brief(most)),
        })
    }

    /// How the display differs from the picture, such as `+1.5 EV`; `None` if it does not.
    pub fn display_name(&self) -> Option<String> {
        let display = self.pictures.display;
        let mut parts = Vec::new();
        parts.extend(self.denoising_name().map(str::to_owned));
        if display.half_stops != 0 {
            parts.push(format!("{:+} EV", display.stops()));
        }
        parts.extend(display.transfer.map(|transfer| match transfer {
            Transfer::Linear => "linear".to_owned(),
            Transfer::Srgb => "sRGB".to_owned(),
        }));
        if display.colours == Colours::False {
            parts.push("false colours".to_owned());
        }
        (!parts.is_empty() && self.is_exposed()).then(|| parts.join(" "))
    }

    /// Shows the histogram, or hides it.
    pub(super) fn toggle_histogram(&mut self) {
        self.pictures.histogram = match self.pictures.histogram.take() {
            Some(_) => None,
            None => Some(ShownHistogram::default()),
        };
    }

    /// Brings the histogram up to date, if it is on screen.
    pub(super) fn follow_histogram(&mut self) {
        let half_stops = self.pictures.display.half_stops;
        let stops = self.pictures.display.stops();
        let frame = self.picture().latest.clone();
        let Some(histogram) = &mut self.pictures.histogram else {
            return;
        };
        let (counted, exposure) = &histogram.of;
        let newest = frame.as_ref().map(Arc::as_ptr);
        if newest.is_some_and(|newest| newest == counted.as_ptr()) && *exposure == half_stops {
            return;
        }
        let light = frame.as_ref().filter(|frame| is_light(frame));
        histogram.histogram = light.map(|frame| Histogram::of(&frame.values, stops));
        histogram.of = (
            frame.as_ref().map(Arc::downgrade).unwrap_or_default(),
            half_stops,
        );
    }
}

/// Whether a frame shows light or albedo, with its values.
pub(super) fn is_light(frame: &Frame) -> bool {
    let settings = frame.settings();
    settings.is_some_and(|settings| exposes(settings.aov)) && !frame.values.is_empty()
}

/// A number with about three digits.
fn brief(value: f64) -> String {
    let decimals = match value.abs() {
        100.0.. => 0,
        10.0.. => 1,
        _ => 2,
    };
    concise(rounded(value, decimals))
}
