//! Small trial pictures that show what is wrong with a picture as a whole, and which render setting
//! fixes it.
//!
//! Trials take the same samples whatever the picture's settings, so that the advice does not depend on
//! those.

use std::fmt;
use std::ops::ControlFlow;

use super::appearance::{Appearance, Shown};
use super::frame::Frame;
use super::overexposure::Overexposure;
use crate::job::Settings;
use crate::light::faded;
use geometry::Shape;
use scene::{EXPOSURES, FalloffRule, Filter, Integrator, Material, Rendering, Rgb, Scene, Size};

/// The longer side of a small picture, in pixels.
const TRIAL_SIDE: u32 = 64;

/// Its samples per pixel.
const TRIAL_SAMPLES: u32 = 16;

/// The longer side, in pixels, of the picture that tells whether one is black, the first that is not too
/// much work: small ones may miss what is bright in it.
const WHOLE_SIDES: [u32; 3] = [1024, 512, 256];

/// The most rays of a picture that is traced unasked: about a second of one core.
const MOST_RAYS: f64 = 4e6;

/// A picture without a brighter level, of 255, is told as a black one is.
const BLACK: u8 = 15;

/// A glance with levels up to this, of 255, is no proof of a picture that is not black.
const DIM: u8 = 63;

/// Pictures of which this share is above 1 may be too bright: the noise of few samples hides how much is.
const BRIGHT: f64 = 0.25;

/// Scenes with more objects and triangles, or more lights, are not traced unasked.
const MOST_TRIANGLES: usize = 200_000;
const MOST_LIGHTS: usize = 100;

/// How much less than it receives a surface that sends all of it back may send back by rounding.
const ROUNDING: f64 = 1e-6;

/// What is wrong with a picture of light as a whole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// Nothing in it is brighter than this level, 0 to 15 of 255.
    Black(u8),
    /// More than half of it is above 1 after the exposure.
    Overexposed,
    /// Nothing lights surfaces by this integrator but would by paths, as the text shows.
    Unlit,
    /// Lights emit no photons because they do not fade, as the text shows.
    WithoutPhotons,
}

/// What is wrong with a picture, and what fixes it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Advice {
    /// What is wrong.
    pub fault: Fault,
    /// The one render setting with which a trial was best; `None` if no single setting helps.
    pub cure: Option<Rendering>,
}

/// The small picture to trace next.
#[derive(Clone, Copy, Debug)]
enum Trial {
    /// The picture itself, with a sample per pixel.
    Glance,
    /// The picture itself with this longer side, but with a sample per pixel, to tell whether it is black.
    Whole(u32),
    /// The picture itself.
    Base,
    /// With a setting that may help.
    With(Rendering),
}

/// The search for the render setting that fixes a picture, a trial picture after the other.
#[derive(Clone, Debug)]
pub struct SettingSearch {
    /// The settings of the picture.
    settings: Settings,
    next: Trial,
    /// What is known to be wrong.
    fault: Option<Fault>,
    /// Whether the picture itself was traced, so that it is known to be black or not.
    is_traced: bool,
    /// The rays that a sample takes, as the first small picture shows.
    rate: f64,
    /// What is wrong if nothing else is.
    of_text: Option<Fault>,
    /// Settings to try, the next one last.
    left: Vec<Rendering>,
    /// The pixels that a setting can change, once they are known.
    shown: Option<Shown>,
    /// The distance of the picture itself from a good one, if it must be less to be better.
    most: Option<f64>,
    /// The best setting so far, with the distance of its picture from a good one.
    best: Option<(f64, Rendering)>,
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Black(0) => f.write_str("the picture is black"),
            Self::Black(most) => {
                let black = "the picture is almost black";
                write!(f, "{black} (brightest value {most} of 255)")
            }
            Self::Overexposed => f.write_str("more than half of the picture is above 1"),
            Self::Unlit => f.write_str("no surface is lit"),
            Self::WithoutPhotons => f.write_str("lights emit no photons"),
        }
    }
}

impl SettingSearch {
    /// Starts the trials for a complete picture of light of these settings, of whose scene the text shows a
    /// fault, or none; `None` if nothing is wrong with it. Whether one that is bright is too bright, the
    /// trials decide.
    pub fn of_picture(
        frame: &Frame,
        scene: &Scene,
        settings: &Settings,
        of_text: Option<Fault>,
    ) -> Option<Self> {
        let black = frame.black().map(Fault::Black);
        let share = || match &frame.values[..] {
            [] => frame.overexposure.share,
            values => Overexposure::of(values).share,
        };
        let is_suspect = black.is_some() || of_text.is_some() || BRIGHT < share();
        is_suspect.then(|| Self {
            fault: black,
            is_traced: true,
            next: Trial::Base,
            ..Self::new(scene, settings, of_text)
        })
    }

    /// Starts the trials for a picture that was not traced; `None` if there is no object, or a small
    /// picture may take long, because the scene is large or its paths have too many bounces.
    pub fn of_scene(scene: &Scene, settings: &Settings, of_text: Option<Fault>) -> Option<Self> {
        let trials = Self::new(scene, settings, of_text);
        let longest = f64::from(settings.depth) * trials.settings().size.pixels() as f64;
        let is_tried = !scene.objects.is_empty() && is_small(scene) && longest <= MOST_RAYS;
        is_tried.then_some(trials)
    }

    fn new(scene: &Scene, settings: &Settings, of_text: Option<Fault>) -> Self {
        Self {
            settings: *settings,
            next: Trial::Glance,
            fault: None,
            is_traced: false,
            rate: 0.0,
            of_text,
            left: candidates(scene, settings),
            shown: None,
            most: None,
            best: None,
        }
    }

    /// What is known to be wrong before any trial.
    pub fn fault(&self) -> Option<Fault> {
        self.fault
    }

    /// The settings of the picture to trace next, in [live](crate::Frames::Live) frames.
    pub fn settings(&self) -> Settings {
        let (side, spp) = match self.next {
            Trial::Glance => (TRIAL_SIDE, 1),
            Trial::Whole(side) => (side, 1),
            Trial::Base | Trial::With(_) => (TRIAL_SIDE, TRIAL_SAMPLES),
        };
        let plain = Settings {
            size: within(self.settings.size, side),
            region: None,
            spp,
            seed: 0,
            aov: None,
            filter: Filter::Box,
            noise: 0.0,
            ..self.settings
        };
        match self.next {
            Trial::With(change) => changed(plain, &change),
            Trial::Glance | Trial::Whole(_) | Trial::Base => plain,
        }
    }

    /// Goes on after that picture, or ends with what is wrong and what helps, if anything is wrong.
    pub fn after(mut self, picture: &Frame) -> ControlFlow<Option<Advice>, Self> {
        let values = &picture.values;
        match self.next {
            Trial::Glance => {
                let above = Overexposure::of(values).share;
                let is_good = DIM < picture.brightest() && above <= BRIGHT;
                if is_good && self.of_text.is_none() {
                    return ControlFlow::Break(None);
                }
                self.rate = picture.progress.rays as f64 / values.len() as f64;
                self.next = Trial::Base;
                return self.unless_too_long();
            }
            Trial::Whole(_) => {
                self.fault = picture.black().map(Fault::Black).or(self.of_text);
                if self.fault.is_none() {
                    return ControlFlow::Break(None);
                }
                self.next = Trial::Base;
                return ControlFlow::Continue(self);
            }
            Trial::Base => {
                let shown = Shown::of(picture);
                let now = Appearance::of(values, &shown, (0.0, self.settings.transfer));
                if self.fault.is_none() {
                    if now.is_overexposed() {
                        self.fault = Some(Fault::Overexposed);
                    } else if !self.is_traced && picture.brightest() <= DIM {
                        let side = self.whole_side();
                        return side.map_or(ControlFlow::Break(None), |side| {
                            self.next = Trial::Whole(side);
                            ControlFlow::Continue(self)
                        });
                    } else if self.of_text.is_some() {
                        self.fault = self.of_text;
                    } else {
                        return ControlFlow::Break(None);
                    }
                }
                if matches!(self.fault, Some(Fault::Unlit | Fault::WithoutPhotons)) {
                    self.most = now.distance();
                }
                self.shown = Some(shown);
                self.keep_what_may_help();
                self.try_exposure(values);
            }
            Trial::With(change) => {
                let is_overexposed = self.consider(change, values, 0.0);
                if is_overexposed && change.depth.is_some() {
                    // More bounces are brighter still.
                    self.left.retain(|other| other.depth.is_none());
                }
            }
        }
        match (self.left.pop(), self.fault) {
            (Some(change), _) => {
                self.next = Trial::With(change);
                ControlFlow::Continue(self)
            }
            (None, Some(fault)) => ControlFlow::Break(Some(Advice {
                fault,
                cure: self.best.map(|(_, change)| change),
            })),
            (None, None) => ControlFlow::Break(None),
        }
    }

    /// Goes on with the next picture; ends without a cure if that would take too many rays.
    fn unless_too_long(self) -> ControlFlow<Option<Advice>, Self> {
        if self.permits() {
            return ControlFlow::Continue(self);
        }
        let without_cure = |fault| Advice { fault, cure: None };
        ControlFlow::Break(self.of_text.map(without_cure))
    }

    /// Whether the next picture is not too much work.
    fn permits(&self) -> bool {
        let Settings { size, spp, .. } = self.settings();
        self.rate * size.pixels() as f64 * f64::from(spp) <= MOST_RAYS
    }

    /// The longer side of the picture that tells whether this one is black; `None` if all are too much
    /// work.
    fn whole_side(&self) -> Option<u32> {
        // The emission of photons is not among the rays of a sample.
        let sides = match self.settings.integrator {
            Integrator::Photon => &WHOLE_SIDES[2..],
            Integrator::Whitted | Integrator::Path => &WHOLE_SIDES,
        };
        let trial = |side| Self {
            next: Trial::Whole(side),
            ..self.clone()
        };
        sides.iter().copied().find(|&side| trial(side).permits())
    }

    /// Leaves out the candidates that cannot fix what is wrong.
    fn keep_what_may_help(&mut self) {
        let fault = self.fault;
        self.left.retain(|change| {
            let fades = change.falloff == Some(FalloffRule::Square);
            match fault {
                Some(Fault::Black(_)) => {
                    change.integrator.is_some() || change.falloff.is_some() && !fades
                }
                Some(Fault::Overexposed) => change.depth.is_some() || fades,
                Some(Fault::Unlit) => change.integrator.is_some(),
                Some(Fault::WithoutPhotons) | None => fades,
            }
        });
    }

    /// Considers the exposure that brings the 99th percentile of a picture to 1, or the brightest channel
    /// of a black one: a trial of it is the same picture times a factor.
    fn try_exposure(&mut self, values: &[[f32; 3]]) {
        let found = Overexposure::of(values);
        let over = match self.fault {
            Some(Fault::Black(_)) if 0.0 < found.brightest => libm::log2(found.brightest),
            Some(Fault::Overexposed) => found.stops,
            _ => return,
        };
        let own = self.settings.exposure;
        let stops = (2.0 * (own - over)).floor() / 2.0;
        let stops = stops.clamp(*EXPOSURES.start(), *EXPOSURES.end());
        let change = Rendering {
            exposure: Some(stops),
            ..Rendering::default()
        };
        if stops != own {
            self.consider(change, values, stops - own);
        }
    }

    /// Keeps a change if the picture with it, brightened by these stops, is the best so far; returns
    /// whether it is too bright.
    fn consider(&mut self, change: Rendering, values: &[[f32; 3]], stops: f64) -> bool {
        let Some(shown) = &self.shown else {
            return false;
        };
        let appearance = Appearance::of(values, shown, (stops, self.settings.transfer));
        // What makes a picture black is undone rather than made up for by an exposure.
        let undoes = matches!(self.fault, Some(Fault::Black(_))) && change.exposure.is_none();
        let is_better = |(least, best): (f64, Rendering), distance: f64| {
            distance < least || undoes && best.exposure.is_some()
        };
        if let Some(distance) = appearance.distance()
            && self.most.is_none_or(|most| distance < most)
            && self.best.is_none_or(|best| is_better(best, distance))
        {
            self.best = Some((distance, change));
        }
        appearance.is_overexposed()
    }
}

impl Frame {
    /// The brightest level of a picture of light as exported, 0 to 15 of 255, if it is so dark that it
    /// counts as black.
    pub fn black(&self) -> Option<u8> {
        Some(self.brightest()).filter(|most| *most <= BLACK)
    }
}

/// Whether a small picture of a scene takes about as long as reading the scene, or is quick.
fn is_small(scene: &Scene) -> bool {
    let triangles = scene.objects.iter().map(|object| match &object.shape {
        Shape::Mesh(instance) => instance.mesh().len(),
        _ => 1,
    });
    let all = triangles.fold(0, usize::saturating_add);
    all <= MOST_TRIANGLES && scene.lights.len() <= MOST_LIGHTS
}

/// The settings to try, the last one first: whatever may fix one fault or another.
fn candidates(scene: &Scene, settings: &Settings) -> Vec<Rendering> {
    let traces_paths = settings.integrator.traces_paths();
    let mut left: Vec<Rendering> = Vec::new();
    if traces_paths {
        let depths = depths(scene).take_while(|depth| *depth < settings.depth);
        left.extend(depths.map(|depth| Rendering {
            depth: Some(depth),
            ..Rendering::default()
        }));
        left.reverse();
    }
    let other = match settings.integrator {
        Integrator::Whitted => is_lit_by_paths(scene).then_some(Integrator::Path),
        Integrator::Path | Integrator::Photon => {
            (scene.ambient_light() != Rgb::ZERO).then_some(Integrator::Whitted)
        }
    };
    left.extend(other.map(|integrator| Rendering {
        integrator: Some(integrator),
        ..Rendering::default()
    }));
    let fades = faded(&scene.lights, FalloffRule::Square).is_some();
    let rule = match settings.falloff {
        FalloffRule::None => FalloffRule::Square,
        FalloffRule::Square => FalloffRule::None,
    };
    left.extend(fades.then(|| Rendering {
        falloff: Some(rule),
        ..Rendering::default()
    }));
    left
}

/// The depths that may help, the smallest first: where surfaces send back all that they receive, or more.
/// What comes from all around them may be too much after a single bounce.
fn depths(scene: &Scene) -> impl Iterator<Item = u32> {
    let albedo = scene.materials.iter().map(Material::sent_on);
    let albedo = albedo.map(Rgb::max_element).fold(0.0, f64::max);
    let is_around = scene.setting.environment.colour != Rgb::ZERO;
    let first = (1.0 - ROUNDING <= albedo).then_some(if is_around { 1 } else { 2 });
    std::iter::successors(first, |depth: &u32| depth.checked_mul(2))
}

/// Whether there is light that only paths carry to other surfaces.
fn is_lit_by_paths(scene: &Scene) -> bool {
    let glows = |material: &Material| material.emission != Rgb::ZERO;
    scene.setting.environment.colour != Rgb::ZERO || scene.materials.iter().any(glows)
}

/// These settings with a candidate.
fn changed(settings: Settings, change: &Rendering) -> Settings {
    let integrator = change.integrator.unwrap_or(settings.integrator);
    // Another depth than the default was asked for, by whichever integrator.
    let own = if settings.depth == settings.integrator.default_depth() {
        integrator.default_depth()
    } else {
        settings.depth
    };
    Settings {
        integrator,
        depth: change.depth.unwrap_or(own),
        falloff: change.falloff.unwrap_or(settings.falloff),
        ..settings
    }
}

/// A size with the same proportions whose longer side is at most this.
fn within(Size { width, height }: Size, most: u32) -> Size {
    let longer = width.max(height).max(most);
    let side = |side: u32| (u64::from(side) * u64::from(most) / u64::from(longer)).max(1) as u32;
    Size {
        width: side(width),
        height: side(height),
    }
}
