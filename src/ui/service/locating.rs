//! Locates things in pictures on a thread of its own: every pixel is traced with and without them.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::io;
use std::sync::Arc;

use super::answering::Answering;
use crate::event::Work;
use crate::located::{Lit, Located, Search, Sought};
use crate::msg::Msg;
use render::{
    Explanation, Job, LightTerm, NO_OBJECT, PreparedScene, UnlitReason, check_memory, memory_for,
};
use scene::{Rgb, Scene};

/// Starts the thread; `send` takes its answers. A search takes the place of those not answered yet, also of
/// one that is under way.
pub(crate) fn whereabouts(
    send: impl Fn(Msg) + Send + 'static,
) -> io::Result<Answering<Box<Search>>> {
    Answering::start("locating", "locates things in the picture", move |inbox| {
        let newer = RefCell::new(None);
        let is_outdated = || {
            let newest: Option<(Box<Search>, Work)> = inbox.try_iter().last();
            let mut newer = newer.borrow_mut();
            if newest.is_some() {
                *newer = newest;
            }
            newer.is_some()
        };
        while let Some((search, work)) = newer.take().or_else(|| inbox.recv().ok()) {
            let found = locate(&search, &is_outdated);
            if !is_outdated() {
                send(Msg::Located(search.ticket, found.map(Box::new)));
            }
            drop(work);
        }
    })
}

/// Locates something; `None` if there is not enough memory and once `cancelled` returns true.
pub(crate) fn locate(search: &Search, cancelled: &dyn Fn() -> bool) -> Option<Located> {
    let Search { job, sought, .. } = search;
    let mut found = Located {
        pixels: job.settings.size.pixels(),
        ..Located::default()
    };
    let covered = match sought {
        Sought::Objects(objects) => {
            let alone = prepared(&part(job, |object| is_among(objects, object)))?;
            let covers = |pixel| alone.query().first_hit(pixel)?.surface;
            pixels(job).map(|pixel| covers(pixel).is_some()).collect()
        }
        Sought::Light(_) => Vec::new(),
    };
    found.covered = covered.iter().filter(|covers| **covers).count();
    let mut tally = Tally::default();
    let mut colours = Vec::with_capacity(found.pixels);
    let whole = prepared(job)?;
    for (at, pixel) in pixels(job).enumerate() {
        let explanation = whole.query().explain(pixel, 0, cancelled)?;
        colours.push(explanation.displayed);
        tally.add(&explanation, sought, covered.get(at) == Some(&true));
    }
    drop(whole);
    let without = prepared(&match sought {
        Sought::Objects(objects) => part(job, |object| !is_among(objects, object)),
        Sought::Light(light) => dark(job, *light),
    })?;
    for (pixel, colour) in pixels(job).zip(colours) {
        let explanation = without.query().explain(pixel, 0, cancelled)?;
        found.changed += usize::from(explanation.displayed != colour);
    }
    tally.finish(&mut found);
    Some(found)
}

/// The scene of a job, unless it takes too much memory.
fn prepared(job: &Job) -> Option<PreparedScene> {
    check_memory(job, memory_for(job, Some(0))).ok()?;
    PreparedScene::new(job, &|| false)
}

/// The pixels of a picture, row by row.
fn pixels(job: &Job) -> impl Iterator<Item = [u32; 2]> + use<> {
    let size = job.settings.size;
    (0..size.height).flat_map(move |y| (0..size.width).map(move |x| [x, y]))
}

fn is_among(objects: &[u32], object: u32) -> bool {
    objects.binary_search(&object).is_ok()
}

/// The job with only those objects that `is_in` accepts by what frames call them.
fn part(job: &Job, is_in: impl Fn(u32) -> bool) -> Job {
    let called = |index: usize| match &job.numbers {
        Some(numbers) => numbers.get(index).copied().unwrap_or(NO_OBJECT),
        None => index as u32,
    };
    let kept: Vec<_> = (0..job.scene.objects.len())
        .filter(|&index| is_in(called(index)))
        .collect();
    let objects = kept
        .iter()
        .filter_map(|&index| job.scene.objects.get(index));
    let scene = Scene {
        objects: objects.cloned().collect(),
        ..(*job.scene).clone()
    };
    Job {
        scene: Arc::new(scene),
        numbers: Some(kept.into_iter().map(called).collect()),
        ..job.clone()
    }
}

/// The job with a light switched off.
fn dark(job: &Job, light: u32) -> Job {
    let mut scene = (*job.scene).clone();
    if let Some(light) = scene.lights.get_mut(light as usize) {
        light.colour = Rgb::ZERO;
    }
    Job {
        scene: Arc::new(scene),
        ..job.clone()
    }
}

/// What is counted over the pixels.
#[derive(Default)]
struct Tally {
    seen: usize,
    hiders: BTreeMap<u32, usize>,
    lit: BTreeMap<u32, usize>,
    lights: BTreeMap<u32, Terms>,
}

/// What a light is to the pixels so far.
#[derive(Default)]
struct Terms {
    reached: usize,
    asked: usize,
    dark: BTreeMap<(u8, Option<u32>), (UnlitReason, usize)>,
}

impl Tally {
    /// Adds a pixel, which the objects sought may cover.
    fn add(&mut self, explanation: &Explanation, sought: &Sought, is_covered: bool) {
        let first = explanation.rays.first().and_then(|ray| ray.shading());
        let object = first.map(|shading| shading.hit.object);
        match (sought, first) {
            (Sought::Objects(objects), Some(shading)) if is_among(objects, shading.hit.object) => {
                self.seen += 1;
                for term in &shading.lights {
                    self.lights.entry(term.light).or_default().add(term);
                }
            }
            (Sought::Objects(_), _) if is_covered => {
                *self.hiders.entry(object.unwrap_or(NO_OBJECT)).or_default() += 1;
            }
            (Sought::Light(light), Some(shading)) => {
                let mut terms = shading.lights.iter();
                if terms.any(|term| term.light == *light && term.radiance != Rgb::ZERO) {
                    *self.lit.entry(shading.hit.object).or_default() += 1;
                }
            }
            _ => {}
        }
    }

    /// Puts what was counted into what was found.
    fn finish(self, found: &mut Located) {
        let most_first = |counts: BTreeMap<u32, usize>| {
            let mut counts: Vec<_> = counts.into_iter().collect();
            counts.sort_by_key(|&(_, count)| std::cmp::Reverse(count));
            counts
        };
        found.seen = self.seen;
        found.hiders = most_first(self.hiders);
        found.lit = most_first(self.lit);
        let lights = self.lights.into_iter();
        found.lights = lights.map(|(light, terms)| terms.into_lit(light)).collect();
    }
}

impl Terms {
    fn add(&mut self, term: &LightTerm) {
        self.asked += 1;
        if term.radiance != Rgb::ZERO {
            self.reached += 1;
        } else if let Some(reason) = term.dark {
            let mut crossed = term.crossed.iter();
            let blocked = crossed.find(|crossing| crossing.transmittance == 0.0);
            let by = blocked.map(|crossing| crossing.object);
            let by = by.filter(|_| reason == UnlitReason::Blocked);
            let counted = self.dark.entry((reason as u8, by)).or_insert((reason, 0));
            counted.1 += 1;
        }
    }

    fn into_lit(self, light: u32) -> Lit {
        // That the far side faces away says less than why the near one is dark.
        let says = |reason: UnlitReason| reason != UnlitReason::FacesAway;
        let dark = self.dark.into_iter();
        let most = dark.max_by_key(|&(_, (reason, count))| (says(reason), count));
        let dark = most.map(|((_, by), (reason, _))| (reason, by));
        Lit {
            light,
            reached: self.reached,
            asked: self.asked,
            dark: dark.filter(|_| self.reached == 0),
        }
    }
}
