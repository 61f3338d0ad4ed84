//! Noise reduction from tracing to the frame.

use super::progress::still;
use super::*;
use crate::engine::{Film, Remembers};
use crate::{Aov, Display};
use scene::Emitter;

/// The complete frame of a job, traced with this many threads.
fn complete(job: Job, threads: usize) -> Arc<Frame> {
    let (mut renderer, woken) = renderer(threads);
    let generation = restart(&mut renderer, job);
    finish(&renderer, &woken, generation)
}

/// A job of paths, which have noise.
fn noisy(frames: Frames, spp: u32) -> Job {
    let settings = Settings {
        integrator: Integrator::Path,
        transfer: Transfer::Srgb,
        exposure: 0.5,
        ..settings(40, 30, spp)
    };
    Job {
        frames,
        denoise: true,
        ..job(&still(), settings)
    }
}

#[test]
fn live_frames_hold_denoised_values_beside_their_own() {
    for spp in [1, 4, 6] {
        let with = complete(noisy(Frames::Live, spp), 2);
        let without = Job {
            denoise: false,
            ..noisy(Frames::Live, spp)
        };
        let without = complete(without, 2);
        assert!(with.pixels == without.pixels && with.values == without.values);
        assert!(without.denoised.is_empty());
        assert_eq!(with.denoised.len(), with.values.len());
        assert!(with.denoised != with.values);
    }
}

/// What is rendered to a file is what the display shows.
#[test]
fn last_frames_are_denoised_themselves() {
    for spp in [1, 4] {
        let live = complete(noisy(Frames::Live, spp), 2);
        let display = Display {
            denoised: true,
            ..Display::default()
        };
        let shown = display.apply(&live).expect("it is denoised");
        let last = complete(noisy(Frames::Last, spp), 1);
        assert!(last.pixels == shown);
        assert!(last.values.is_empty() && last.denoised.is_empty());
        let with_values = complete(noisy(Frames::LastWithValues, spp), 1);
        assert!(with_values.pixels == shown && with_values.values == live.denoised);
    }
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let [one, two, eight] = [1, 2, 8].map(|threads| complete(noisy(Frames::Live, 4), threads));
    assert!(one.denoised == two.denoised && one.denoised == eight.denoised);
}

/// The film of a picture is continued, whether it was denoised or is to be.
#[test]
fn switching_traces_no_ray() {
    let (mut renderer, woken) = renderer(2);
    let mut switch = |denoise| {
        let job = Job {
            denoise,
            ..noisy(Frames::Live, 4)
        };
        let generation = restart(&mut renderer, job);
        finish(&renderer, &woken, generation)
    };
    let frames = [switch(false), switch(true), switch(false)];
    let rays = frames.each_ref().map(|frame| frame.progress.rays);
    assert!(0 < rays[0] && rays[1] == rays[0] && rays[2] == rays[0]);
    let denoised = frames.map(|frame| frame.denoised.len());
    assert_eq!(denoised, [0, 1200, 0]);
}

/// A large trace is not traced again for noise reduction, which it has no memory for.
#[test]
fn large_live_pictures_are_continued_as_they_are() {
    let of_size = |width, height, frames, denoise| Job {
        frames,
        denoise,
        ..job(&still(), settings(width, height, 1))
    };
    let remembers = |frames, denoise| Remembers::of(&of_size(4096, 2048, frames, denoise));
    assert_eq!(remembers(Frames::Live, true), Remembers::Pixels);
    assert_eq!(remembers(Frames::Last, false), Remembers::Pixels);
    assert_eq!(remembers(Frames::Last, true), Remembers::Histories);
    let bytes =
        |width, height, denoise| Film::bytes(&of_size(width, height, Frames::Last, denoise));
    assert!(bytes(800, 600, true) < bytes(800, 600, false) + 800 * 600 * 200);
    // Rows have room around them.
    let tall = bytes(1, 1 << 20, false) + (1 << 20) * 1500;
    assert!(tall < bytes(1, 1 << 20, true));
}

/// By Whitted a single sample is at the centre of every distribution: it has no noise. Nor have more
/// where only the place in the pixel differs, nor AOVs.
#[test]
fn what_has_no_noise_keeps_every_bit() {
    let whitted = Job {
        denoise: true,
        ..job(&still(), settings(40, 30, 1))
    };
    let many = |scene: &Arc<Scene>| Job {
        denoise: true,
        ..job(scene, settings(40, 30, 16))
    };
    for job in [whitted.clone(), many(&still())] {
        let frame = complete(job, 2);
        assert!(frame.denoised == frame.values);
    }
    let mut soft = (*still()).clone();
    for light in &mut soft.lights {
        if let Emitter::Point { radius, .. } = &mut light.emitter {
            *radius = 0.5;
        }
    }
    let frame = complete(many(&Arc::new(soft)), 2);
    assert!(frame.denoised != frame.values);
    let of_albedo = |frames| Job {
        settings: Settings {
            aov: Some(Aov::Albedo),
            ..settings(40, 30, 4)
        },
        frames,
        ..whitted.clone()
    };
    let live = complete(of_albedo(Frames::Live), 2);
    assert!(live.denoised.is_empty());
    let last = complete(of_albedo(Frames::LastWithValues), 2);
    assert!(last.values == live.values);
}

/// A ball that glows, in a dark room: its edge is known to the guides, whether it is a light or an
/// object.
#[test]
fn lights_are_told_apart_from_what_is_behind_them() {
    let scene = Arc::new(xml_seen_by(
        "<camera><position y='-5'/><target/><up z='1'/><fov value='40'/></camera>",
        "<light type='point' name='lamp'><intensity value='9'/><position z='0'/><size value='1'/></light>
         <object type='plane' material='m'><scale value='9'/><rotate x='1' angle='90'/>
         <translate y='4'/></object>
         <material name='m'><diffuse value='0.5'/><specular value='0'/></material>",
    ));
    let with = |denoise, spp| {
        let settings = Settings {
            integrator: Integrator::Path,
            ..settings(40, 30, spp)
        };
        complete(
            Job {
                denoise,
                frames: Frames::LastWithValues,
                ..job(&scene, settings)
            },
            2,
        )
    };
    let (noisy, denoised) = (with(false, 4), with(true, 4));
    let lamp = noisy.values[15 * 40 + 20][0];
    assert!(1.0 < lamp);
    for (before, after) in noisy.values.iter().zip(&denoised.values) {
        // Neither side leaks: what shows half of the light still does.
        assert!(
            (before[0] - after[0]).abs() < 0.1 * lamp,
            "{before:?} {after:?}"
        );
    }
}
