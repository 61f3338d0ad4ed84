//! Small trial pictures that show what is wrong with a picture as a whole, and which render setting
//! mends it.
//!
//! They have the same samples whatever the picture has, so that the advice does not depend on those, nor
//! on whether the picture was traced: that shows at most whether trials are worth their while. They take a
//! limited number of rays.

mod candidates;
mod effort;
mod fault;

use std::ops::ControlFlow;

use super::appearance::{Appearance, Shown};
use super::frame::{Frame, Settings};
use super::overexposure::Overexposure;
use crate::scene::{EXPOSURES, FalloffRule, Filter, Integrator, Rendering, Scene, Size, Transfer};
use candidates::{candidates, changed, may_mend};
use effort::{Effort, is_small};
pub use fault::Fault;
use fault::{DIM, Suspicion, black, brightest, level};

/// The longer side of a small picture, in pixels.
const SIDE: u32 = 64;

/// The longer sides of pictures that show how much work a small one is, where that may be too much.
const GLIMPSES: [u32; 2] = [16, 4];

/// The part of the work left that pictures may take which show how much others take.
const THIRD: f64 = 1.0 / 3.0;

/// The samples per pixel of a small picture, if that is not too much work.
const SAMPLES: u32 = 16;

/// The longer sides, in pixels, of the picture that tells whether one is black: small ones may miss what
/// is bright in it.
const WHOLE_SIDES: [u32; 4] = [1024, 512, 256, 128];

/// The same by paths, where the means of squares are judged.
const WHOLE_SIDE_BY_PATHS: u32 = 256;

/// Bounces of trials by photons, of which nothing limits the number otherwise.
const MOST_BOUNCES: u32 = 64;

/// What is wrong with a picture, and what mends it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Advice {
    /// What is wrong.
    pub fault: Fault,
    /// The one render setting with which a trial was best and better than without; `None` if there is none.
    pub cure: Option<Rendering>,
    /// Whether everything that may help was tried. It may be too much work.
    pub is_tried: bool,
}

/// Trials to go on with, or the advice, if anything is wrong.
pub type Tried = ControlFlow<Option<Advice>, Trials>;

/// The small picture to trace next.
#[derive(Clone, Copy, Debug)]
enum Trial {
    /// The picture itself at this size, with a sample per pixel.
    Glance(u32),
    /// The picture itself at this size with a sample per pixel, to tell whether it is black.
    Whole(u32),
    /// The picture itself.
    Base,
    /// At this size with a setting that may help, to tell how much work it is.
    Glimpse(u32, Rendering),
    /// With a setting that may help.
    With(Rendering),
}

/// Trials of what mends a picture.
#[derive(Clone, Debug)]
pub struct Trials {
    /// The settings of the picture.
    settings: Settings,
    next: Trial,
    effort: Effort,
    /// The rays that a sample of the picture takes.
    rate: f64,
    /// The samples of small pictures.
    spp: u32,
    /// Whether the picture was traced and looks too bright at most.
    is_only_bright: bool,
    /// What its own samples show.
    apparent: Option<Fault>,
    /// What is wrong if nothing else is, as the text shows.
    of_text: Option<Fault>,
    /// What is known to be wrong.
    fault: Option<Fault>,
    /// Settings to try, the next one last.
    left: Vec<Rendering>,
    /// Whether one was too much work to try.
    is_cut_short: bool,
    /// The small picture itself, and the pixels of it that a setting can change.
    base: Option<(Vec<[f32; 3]>, Shown)>,
    /// The brightest channel of the picture that tells whether it is black.
    brightest: f64,
    /// The distance of the best picture so far from a good one, if it is not too far, and the setting with
    /// which it was traced, if any.
    best: (f64, Option<Rendering>),
}

impl Trials {
    /// Starts the trials for a complete picture of light of these settings, of whose scene the text shows a
    /// fault, or none. Ends at once if it does not look as if anything were wrong with it.
    pub fn of_picture(
        frame: &Frame,
        scene: &Scene,
        settings: &Settings,
        of_text: Option<Fault>,
    ) -> Tried {
        let suspicion = Suspicion::of(frame, (settings.integrator, settings.transfer));
        let Suspicion { is_dark, is_bright } = suspicion;
        if !is_dark && !is_bright && of_text.is_none() {
            return ControlFlow::Break(None);
        }
        Self {
            is_only_bright: !is_dark && of_text.is_none(),
            apparent: frame.fault(),
            ..Self::new(scene, settings, of_text)
        }
        .glance(None)
    }

    /// Starts the trials for a picture that was not traced. Ends at once if there is no object, or the scene
    /// is so large that any picture takes long.
    pub fn of_scene(scene: &Scene, settings: &Settings, of_text: Option<Fault>) -> Tried {
        if scene.objects.is_empty() || !is_small(scene) {
            return ControlFlow::Break(None);
        }
        Self::new(scene, settings, of_text).glance(None)
    }

    fn new(scene: &Scene, settings: &Settings, of_text: Option<Fault>) -> Self {
        let effort = Effort::of(scene);
        let is_fewer = of_text == Some(Fault::WithoutPhotons) && effort.emits(settings.falloff);
        Self {
            settings: *settings,
            next: Trial::Base,
            effort,
            rate: 0.0,
            spp: SAMPLES,
            is_only_bright: false,
            apparent: None,
            of_text: if is_fewer {
                Some(Fault::FewerPhotons)
            } else {
                of_text
            },
            fault: None,
            left: candidates(scene, settings),
            is_cut_short: false,
            base: None,
            brightest: 0.0,
            best: (f64::INFINITY, None),
        }
    }

    /// What the samples of the picture itself show to be wrong with it.
    pub fn apparent(&self) -> Option<Fault> {
        self.apparent
    }

    /// Whether all that may be wrong with the picture is that it is too bright.
    pub fn is_only_bright(&self) -> bool {
        self.is_only_bright
    }

    /// The settings of the picture to trace next, in [live](super::Frames::Live) frames.
    pub fn settings(&self) -> Settings {
        self.settings_of(self.next)
    }

    fn settings_of(&self, trial: Trial) -> Settings {
        let (side, spp) = match trial {
            Trial::Glance(side) | Trial::Whole(side) | Trial::Glimpse(side, _) => (side, 1),
            Trial::Base | Trial::With(_) => (SIDE, self.spp),
        };
        let size = match trial {
            // However small the picture is, what is small in it is to fill squares.
            Trial::Whole(side) if self.settings.integrator.traces_paths() => {
                scaled(self.settings.size, side)
            }
            _ => within(self.settings.size, side),
        };
        let plain = Settings {
            size,
            region: None,
            spp,
            seed: 0,
            aov: None,
            filter: Filter::Box,
            noise: None,
            ..self.settings
        };
        let settings = match trial {
            Trial::Glimpse(_, change) | Trial::With(change) => changed(plain, &change),
            Trial::Glance(_) | Trial::Whole(_) | Trial::Base => plain,
        };
        let most = match settings.integrator {
            Integrator::Photon => MOST_BOUNCES,
            Integrator::Whitted | Integrator::Path => u32::MAX,
        };
        Settings {
            depth: settings.depth.min(most),
            ..settings
        }
    }

    /// Goes on after that picture, or ends with what is wrong and what helps, if anything is wrong.
    pub fn after(mut self, picture: &Frame) -> Tried {
        let rate = self.effort.spend(picture, &self.settings());
        match self.next {
            Trial::Glance(side) => {
                self.rate = rate;
                if side < SIDE {
                    return self.glance(Some(rate));
                }
                let Suspicion { is_dark, is_bright } = Suspicion::of(picture, self.shown_by());
                if !is_dark && !is_bright && self.of_text.is_none() {
                    return ControlFlow::Break(None);
                }
                self.look()
            }
            Trial::Base => self.judge(picture),
            Trial::Whole(_) => {
                let found = brightest(picture, self.settings.integrator);
                self.brightest = found.max_element();
                self.fault = black(level(found, self.settings.transfer)).or(self.of_text);
                if self.fault.is_none() {
                    return ControlFlow::Break(None);
                }
                self.weigh()
            }
            Trial::Glimpse(_, change) => self.try_out(change, rate),
            Trial::With(change) => {
                let is_burnt = self.consider(change, &picture.values, 0.0);
                if is_burnt && change.depth.is_some() {
                    // More bounces are brighter still.
                    self.left.retain(|other| other.depth.is_none());
                }
                self.go_on()
            }
        }
    }

    /// By what the levels of the picture are made.
    fn shown_by(&self) -> (Integrator, Transfer) {
        (self.settings.integrator, self.settings.transfer)
    }

    /// Glances at the picture, of which a sample takes so many rays if that is known: at a size that cannot
    /// be too much work.
    fn glance(mut self, rate: Option<f64>) -> Tried {
        let found = [SIDE].into_iter().chain(GLIMPSES).find(|&side| {
            let settings = self.settings_of(Trial::Glance(side));
            let rate = rate.unwrap_or_else(|| self.effort.most_rays(&settings));
            self.effort.permits(&settings, rate, THIRD)
        });
        let is_on = |side: u32| match self.next {
            Trial::Glance(before) => before < side,
            _ => true,
        };
        match found.filter(|side| is_on(*side)) {
            Some(side) => {
                self.next = Trial::Glance(side);
                ControlFlow::Continue(self)
            }
            None => self.untried(),
        }
    }

    /// Traces the small picture itself, with as many samples as leave work for others like it.
    fn look(mut self) -> Tried {
        let others = self.left.len().min(3) as f64;
        let permits = |spp: u32, part: f64| {
            let settings = Settings {
                spp,
                // What may help may emit photons.
                falloff: FalloffRule::Square,
                ..self.settings_of(Trial::Base)
            };
            self.effort.permits(&settings, self.rate, part)
        };
        let mut counts = [SAMPLES, 8, 4, 2, 1].into_iter();
        let found = counts.find(|&spp| permits(spp, 1.0 / (1.0 + others)));
        let Some(spp) = found.or_else(|| permits(1, 1.0).then_some(1)) else {
            return self.untried();
        };
        self.spp = spp;
        self.next = Trial::Base;
        ControlFlow::Continue(self)
    }

    /// Judges the small picture itself.
    fn judge(mut self, picture: &Frame) -> Tried {
        let (integrator, transfer) = self.shown_by();
        let shown = Shown::of(picture);
        let now = Appearance::of(&picture.values, &shown, (0.0, transfer));
        if let Some(distance) = now.distance() {
            self.best.0 = distance;
        }
        self.base = Some((picture.values.clone(), shown));
        if now.is_burnt() {
            self.fault = Some(Fault::Burnt);
        } else if level(brightest(picture, integrator), transfer) <= DIM {
            let sides = if integrator.traces_paths() {
                &[WHOLE_SIDE_BY_PATHS][..]
            } else {
                &WHOLE_SIDES
            };
            let found = sides.iter().copied().find(|&side| {
                let settings = self.settings_of(Trial::Whole(side));
                self.effort.permits(&settings, self.rate, 0.5)
            });
            let Some(side) = found else {
                return self.untried();
            };
            self.next = Trial::Whole(side);
            return ControlFlow::Continue(self);
        } else if self.of_text.is_some() {
            self.fault = self.of_text;
        } else {
            return ControlFlow::Break(None);
        }
        self.weigh()
    }

    /// Tries what may mend the fault.
    fn weigh(mut self) -> Tried {
        let fault = self.fault;
        self.left.retain(|change| may_mend(change, fault));
        self.try_exposure();
        self.go_on()
    }

    /// Tries the next setting, or ends with the best.
    fn go_on(mut self) -> Tried {
        let Some(change) = self.left.pop() else {
            let (cure, is_tried) = (self.best.1, !self.is_cut_short);
            return ControlFlow::Break(self.fault.map(|fault| Advice {
                fault,
                cure,
                is_tried,
            }));
        };
        if change.integrator.is_none() {
            let rate = self.rate;
            return self.try_out(change, rate);
        }
        // Another integrator takes another number of rays.
        let affordable = GLIMPSES.into_iter().find(|&side| {
            let settings = self.settings_of(Trial::Glimpse(side, change));
            let most = self.effort.most_rays(&settings);
            self.effort.permits(&settings, most, THIRD)
        });
        match affordable {
            Some(side) => {
                self.next = Trial::Glimpse(side, change);
                ControlFlow::Continue(self)
            }
            None => self.leave_out(),
        }
    }

    /// Tries a setting with which a sample takes so many rays, unless that is too much work.
    fn try_out(mut self, change: Rendering, rate: f64) -> Tried {
        let trial = Trial::With(change);
        if self.effort.permits(&self.settings_of(trial), rate, 1.0) {
            self.next = trial;
            ControlFlow::Continue(self)
        } else {
            self.leave_out()
        }
    }

    fn leave_out(mut self) -> Tried {
        self.is_cut_short = true;
        self.go_on()
    }

    /// Ends with what shows without trials, which are too much work.
    fn untried(self) -> Tried {
        let fault = self.apparent.or(self.of_text);
        ControlFlow::Break(fault.map(|fault| Advice {
            fault,
            cure: None,
            is_tried: false,
        }))
    }

    /// Considers the exposure that brings the 99th percentile of a picture to 1, or the brightest channel
    /// of a black one: a trial of it is the same picture times a factor.
    fn try_exposure(&mut self) {
        let Some((values, shown)) = self.base.take() else {
            return;
        };
        let found = Overexposure::of(&values);
        let brightest = if self.settings.integrator.traces_paths() {
            self.brightest
        } else {
            found.brightest
        };
        let over = match self.fault {
            Some(Fault::Black(_)) if 0.0 < brightest => Some(libm::log2(brightest)),
            Some(Fault::Burnt) => Some(found.stops),
            _ => None,
        };
        self.base = Some((Vec::new(), shown));
        let Some(over) = over else {
            return;
        };
        let own = self.settings.exposure;
        let stops = (2.0 * (own - over)).floor() / 2.0;
        let stops = stops.clamp(*EXPOSURES.start(), *EXPOSURES.end());
        let change = Rendering {
            exposure: Some(stops),
            ..Rendering::default()
        };
        if stops != own {
            self.consider(change, &values, stops - own);
        }
    }

    /// Keeps a change if the picture with it, brightened by these stops, is the best so far; returns
    /// whether it is too bright.
    fn consider(&mut self, change: Rendering, values: &[[f32; 3]], stops: f64) -> bool {
        let Some((_, shown)) = &self.base else {
            return false;
        };
        let appearance = Appearance::of(values, shown, (stops, self.settings.transfer));
        let (least, best) = self.best;
        // What makes a picture black is undone rather than made up for by an exposure.
        let undoes = matches!(self.fault, Some(Fault::Black(_))) && change.exposure.is_none();
        let is_made_up_for = best.is_some_and(|best| best.exposure.is_some());
        if let Some(distance) = appearance.distance()
            && (distance < least || undoes && is_made_up_for)
        {
            self.best = (distance, Some(change));
        }
        appearance.is_burnt()
    }
}

/// A size with the same proportions whose longer side is at most this.
fn within(size: Size, most: u32) -> Size {
    if size.width.max(size.height) <= most {
        size
    } else {
        scaled(size, most)
    }
}

/// A size with the same proportions whose longer side is this.
fn scaled(Size { width, height }: Size, longer: u32) -> Size {
    let now = u64::from(width.max(height).max(1));
    let side = |side: u32| (u64::from(side) * u64::from(longer) / now).max(1) as u32;
    Size {
        width: side(width),
        height: side(height),
    }
}
