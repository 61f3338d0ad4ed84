//! What pictures show (light, one of its components, an AOV or wires) and how light is displayed (exposure,
//! transfer, false colours, the histogram).

use std::sync::Arc;

use super::jobs::retrace;
use crate::app::Shared;
use crate::app::pictures::histogram::ShownHistogram;
use crate::msg::Effect;
use language::Node;
use render::{Aov, Colours, Display, Frame, Histogram, MOST_HALF_STOPS, can_denoise};
use scene::{Emitter, Transfer};
use text::{concise, percentage, rounded};

/// Shows light or an AOV.
pub(crate) fn show(shared: &mut Shared, aov: Option<Aov>) {
    let words = shared.pictures.show(aov);
    shared.say(words);
}

/// Whether the pictures show something that the display changes.
fn is_exposed(shared: &Shared) -> bool {
    shared.pictures.wireframe.is_none() && Display::affects(shared.pictures.aov)
}

/// Says why the display changes nothing here; returns whether that is so.
fn refuses_display(shared: &mut Shared) -> bool {
    let refuses = !is_exposed(shared);
    if refuses {
        let light = shared.key_for("show-light");
        let words = format!("only light and albedo can be exposed; press {light}");
        shared.say(words);
    }
    refuses
}

/// Shows a wireframe instead of a picture.
pub(super) fn show_wireframe(shared: &mut Shared) {
    let words = shared.pictures.show_wireframe();
    shared.say(words);
}

/// Makes the display brighter, or darker.
pub(crate) fn expose(shared: &mut Shared, half_stops: i8) {
    let now = shared.pictures.display.half_stops;
    set_exposure(shared, now.saturating_add(half_stops));
}

/// Sets the exposure of the display, in half stops.
pub(crate) fn set_exposure(shared: &mut Shared, half_stops: i8) {
    if refuses_display(shared) {
        return;
    }
    let display = &mut shared.pictures.display;
    display.half_stops = half_stops.clamp(-MOST_HALF_STOPS, MOST_HALF_STOPS);
    let words = match display.stops() {
        0.0 => "exposure 0".to_owned(),
        stops => format!("exposure {stops:+} EV, on screen only"),
    };
    shared.say(words);
}

/// Displays light by a transfer function, or by the scene's own.
pub(crate) fn set_transfer(shared: &mut Shared, transfer: Option<Transfer>) {
    if refuses_display(shared) {
        return;
    }
    shared.pictures.display.transfer = transfer;
    shared.say(match transfer {
        None => "the scene's own transfer",
        Some(Transfer::Linear) => "linear transfer, on screen only",
        Some(Transfer::Srgb) => "sRGB transfer, on screen only",
    });
}

/// Displays luminances as false colours, or true colours again.
pub(crate) fn toggle_false_colours(shared: &mut Shared) {
    if refuses_display(shared) {
        return;
    }
    let (colours, words) = match shared.pictures.display.colours {
        Colours::True => (
            Colours::False,
            "false colours: luminance, green below 1/256, white above 1",
        ),
        Colours::False => (Colours::True, "true colours"),
    };
    shared.pictures.display.colours = colours;
    shared.say(words);
}

/// Reduces the noise of the preview and of the full-size trace on screen, or no longer. Both
/// continue from the samples they have.
pub(crate) fn toggle_denoising(shared: &mut Shared) -> Vec<Effect> {
    if shared.pictures.wireframe.is_some() || !can_denoise(shared.pictures.aov) {
        let light = shared.key_for("show-light");
        let words = format!("only light has noise to reduce; press {light}");
        shared.say(words);
        return Vec::new();
    }
    let denoised = !shared.pictures.display.denoised;
    shared.pictures.display.denoised = denoised;
    shared.say(if denoised {
        "denoise on, on screen only"
    } else {
        "denoise off"
    });
    shared.pictures.preview.asked = None;
    retrace(shared)
}

/// Whether the noise of the picture on screen is reduced, in a word; `None` if it is not to be.
fn denoising_name(shared: &Shared) -> Option<&'static str> {
    let is_on = shared.pictures.display.denoised && can_denoise(shared.pictures.aov);
    let latest = shared.picture().latest.as_ref();
    let is_without = latest.is_some_and(|frame| frame.denoised.is_empty());
    let is_unable = shared.picture().is_complete() && is_without;
    is_on.then_some(if is_unable {
        "not denoised"
    } else {
        "denoised"
    })
}

/// Shows the next or previous light component: all, that of each light, emission, indirect
/// light.
pub(super) fn step_share(shared: &mut Shared, step: isize) {
    let Some(scene) = &shared.scene else {
        let reason = shared.no_picture();
        shared.fail(reason);
        return;
    };
    let lights = (0..).zip(&scene.lights);
    let lights = lights.filter(|(_, light)| light.emitter != Emitter::Ambient);
    let lights = lights.map(|(number, _)| Some(Aov::Direct(number)));
    let ends = [Some(Aov::Emission), Some(Aov::Indirect)];
    let shares: Vec<_> = [None].into_iter().chain(lights).chain(ends).collect();
    let mut places = shares.iter();
    let shown = places.position(|share| *share == shared.pictures.aov);
    let next = shown.unwrap_or(0).checked_add_signed(step);
    let next = next.map_or(shares.len() - 1, |next| next % shares.len());
    let words = shared.pictures.show(shares[next]);
    shared.say(match shares[next] {
        Some(Aov::Direct(light)) => format!("only direct light of {}", light_name(shared, light)),
        _ => words.to_owned(),
    });
}

fn light_name(shared: &Shared, light: u32) -> String {
    shared.source().name(Node::Light(light as usize))
}

/// What the pictures show instead of light, for the status line.
pub(crate) fn view_name(shared: &Shared) -> Option<String> {
    Some(match shared.pictures.aov? {
        Aov::Direct(light) => format!("only {}", light_name(shared, light)),
        share if share.is_share() => format!("only {}", share.name()),
        aov => aov.name().to_owned(),
    })
}

/// What the colours on screen stand for, where the name of the view does not say it.
pub(crate) fn legend(shared: &Shared) -> Option<String> {
    if shared.pictures.wireframe.is_some() {
        return None;
    }
    let display = shared.pictures.display;
    let Some(aov) = shared
        .pictures
        .aov
        .filter(|aov| !Display::affects(Some(*aov)))
    else {
        let is_false = display.colours == Colours::False;
        return is_false.then(|| "-8 to 0 EV, green below, white above".to_owned());
    };
    match aov {
        Aov::Uv => return Some("u red, v green".to_owned()),
        Aov::Side => return Some("front blue, back orange".to_owned()),
        _ => {}
    }
    let frame = shared.picture().latest.as_ref()?;
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
pub(crate) fn display_name(shared: &Shared) -> Option<String> {
    let display = shared.pictures.display;
    let mut parts = Vec::new();
    parts.extend(denoising_name(shared).map(str::to_owned));
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
    (!parts.is_empty() && is_exposed(shared)).then(|| parts.join(" "))
}

/// Shows the histogram, or hides it.
pub(crate) fn toggle_histogram(shared: &mut Shared) {
    let is_hidden = shared.pictures.histogram.is_none();
    shared.pictures.histogram = is_hidden.then(ShownHistogram::default);
}

/// Brings the histogram up to date, if it is on screen.
pub(super) fn follow_histogram(shared: &mut Shared) {
    let half_stops = shared.pictures.display.half_stops;
    let stops = shared.pictures.display.stops();
    let frame = shared.picture().latest.clone();
    let Some(histogram) = &mut shared.pictures.histogram else {
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

/// Whether a frame shows light or albedo, with its values.
pub(crate) fn is_light(frame: &Frame) -> bool {
    let settings = frame.settings();
    settings.is_some_and(|settings| Display::affects(settings.aov)) && !frame.values.is_empty()
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
