//! What is wrong with a picture as a whole, and the render settings suggested for it.

use super::App;
use super::cures::Cure;
use super::looking::is_light;
use crate::language::{Outlook, RenderKey, outlook};
use crate::render::{Frame, Histogram};
use crate::scene::{EXPOSURES, Emitter, FalloffRule, Rgb, Scene};
use crate::text::concise;
use crate::ui::keymap::{Action, Mode};
use crate::ui::msg::Target;

/// How many stops a picture may miss white by with a cure that is suggested first.
const NEAR: f64 = 2.5;

impl App {
    /// Adds what the text shows of its picture to what was found in reading it.
    pub(super) fn judge_text(&mut self) {
        let mut found = self.reported.clone();
        self.cures.of_text.clear();
        let scene = self.scene.clone().filter(|_| found.errors() == 0);
        let Some(scene) = scene else {
            self.diagnostics = found;
            return;
        };
        for Outlook { warning, cure } in outlook(self.source(), &scene, &self.rendering()) {
            let hint = cure.as_ref().map(|cure| self.cure_in_words(cure));
            found.warning(|| match hint {
                Some(hint) => warning.with_hint(hint),
                None => warning,
            });
            self.cures.of_text.extend(cure);
        }
        self.diagnostics = found.sorted();
    }

    /// Says what is wrong with a complete preview that is black, or of which more than half is above 1,
    /// and what helps; once, until one is not.
    pub(super) fn judge_picture(&mut self, target: Target, frame: &Frame) {
        if target != Target::Preview || !frame.progress.complete || !is_light(frame) {
            return;
        }
        let is_of_light = frame
            .settings()
            .is_some_and(|settings| settings.aov.is_none());
        let is_black = is_of_light && frame.values.iter().all(|value| *value == [0.0; 3]);
        let clipped = Histogram::of(&frame.values, self.pictures.display.stops()).clipped;
        self.cures.of_picture.clear();
        if clipped <= 0.5 && !is_black {
            self.cures.is_said = false;
            return;
        }
        if !is_black && is_of_light {
            self.cures.of_picture = self.darkening(frame);
        }
        if std::mem::replace(&mut self.cures.is_said, true) || self.overlays.message.is_some() {
            return;
        }
        let cure = self.suggested_cure().map(|cure| self.cure_in_words(cure));
        let words = if is_black {
            let errors = self.key_for(Action::Errors);
            match (
                cure,
                self.cures.of_text.is_empty() && self.diagnostics.is_empty(),
            ) {
                (Some(cure), _) => format!("the picture is black: {cure}"),
                (None, false) => format!("the picture is black: {errors} may say why"),
                (None, true) => {
                    let inspect = self.key_for(Action::Go(Mode::Inspect));
                    format!("the picture is black: {inspect} explains a pixel")
                }
            }
        } else {
            let darker = self.key_for(Action::Expose(-1));
            let darker = format!("{darker} darkens the screen only");
            let helps = cure.map_or_else(|| darker.clone(), |cure| format!("{cure}, {darker}"));
            format!("more than half of the picture is above 1: {helps}")
        };
        self.overlays.say(words);
    }

    /// Writes the suggested setting into the text.
    fn cure(&mut self) {
        match self.suggested_cure().cloned() {
            Some((key, value)) => {
                self.write_setting(key, Some(value));
                // What is still wrong is said again.
                self.cures.is_said = false;
            }
            None => self.overlays.say("there is no render setting to suggest"),
        }
    }

    /// Switches the integrator, or writes the suggested setting.
    pub(super) fn change_rendering(&mut self, action: Action) {
        if action == Action::Cure {
            self.cure();
            return;
        }
        let words = self.pictures.next_integrator(self.scene.as_deref());
        // It may lack other lights.
        self.judge_text();
        self.overlays.say(words);
    }

    /// The first cure that is not in use yet.
    fn suggested_cure(&self) -> Option<&Cure> {
        let asked = self.rendering();
        let cures = self.cures.of_text.iter().chain(&self.cures.of_picture);
        let mut new = cures.filter(|(key, value)| key.value(&asked) != *value);
        new.next()
    }

    fn cure_in_words(&self, (key, value): &Cure) -> String {
        format!("{} sets {} {value}", self.key_for(Action::Cure), key.name())
    }

    /// What would bring the 99th percentile of a picture that is too bright to 1: the most likely first.
    fn darkening(&self, frame: &Frame) -> Vec<Cure> {
        let asked = self.rendering();
        let mut values: Vec<_> = frame.values.iter().map(|value| largest(*value)).collect();
        let at = values.len() * 99 / 100;
        let Some((_, brightest, _)) =
            (at < values.len()).then(|| values.select_nth_unstable_by(at, f32::total_cmp))
        else {
            return Vec::new();
        };
        let over = libm::log2(f64::from(*brightest));
        let own = asked.exposure.unwrap_or_default();
        let stops = (2.0 * (own - over)).floor() / 2.0;
        let stops = stops.clamp(*EXPOSURES.start(), *EXPOSURES.end());
        let cure = |key: &str, value: &str| Some((RenderKey::named(key)?, value.to_owned()));
        let exposure = cure("exposure", &concise(stops));
        let fading = self.scene.as_deref().and_then(fading);
        let falloff = fading.filter(|_| asked.falloff != Some(FalloffRule::Square));
        let falloff = falloff.filter(|stops| (over + stops).abs() < NEAR);
        let falloff = falloff.and_then(|_| cure("falloff", FalloffRule::Square.name()));
        falloff.into_iter().chain(exposure).collect()
    }
}

fn largest(value: [f32; 3]) -> f32 {
    value.into_iter().fold(0.0, f32::max)
}

/// By about how many stops the middle of a scene darkens if its point lights fade by the square of the
/// distance; `None` without any that do not fade yet.
fn fading(scene: &Scene) -> Option<f64> {
    let bounds = scene.bounds();
    let middle = (!bounds.is_empty()).then(|| bounds.centre())?;
    let steady = scene
        .lights
        .iter()
        .filter_map(|light| match &light.emitter {
            Emitter::Point {
                position, falloff, ..
            } if falloff.radial[1..] == [0.0; 2] && light.colour != Rgb::ZERO => {
                Some(position.distance(middle))
            }
            _ => None,
        });
    let distance = steady.reduce(f64::min)?;
    Some(-2.0 * libm::log2(distance))
}
