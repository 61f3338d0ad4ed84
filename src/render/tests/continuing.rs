//! Pauses, stops and limits, and continuing after them.

use std::time::Duration;

use super::progress::{still, trace};
use super::*;
use crate::Limit;

/// A pause that would let several frames through if it did not pause.
const LONG: Duration = Duration::from_millis(150);

/// A picture that takes a second or more.
fn slow() -> Settings {
    settings(100, 75, 16)
}

#[test]
fn a_paused_job_publishes_nothing_and_continues_to_the_same_picture() {
    let scene = still();
    let (mut renderer, woken) = renderer(2);
    let generation = restart(&mut renderer, job(&scene, slow()));
    woken.recv().expect("a first frame");
    renderer.latest();
    renderer.pause();
    // What was on its way when the pause began still arrives.
    while woken.recv_timeout(LONG).is_ok() {
        let frame = renderer.latest().expect("a frame");
        assert!(!frame.progress.complete);
    }
    renderer.resume();
    let frame = finish(&renderer, &woken, generation);
    let alone = trace(&scene, slow(), 2);
    assert!(frame.pixels == alone.pixels && frame.objects == alone.objects);
    assert_eq!(frame.progress.rays, alone.progress.rays);
}

/// Otherwise these would wait forever.
#[test]
fn newer_jobs_and_the_end_do_not_wait_for_a_pause() {
    let scene = still();
    let (mut renderer, woken) = renderer(2);
    restart(&mut renderer, job(&scene, slow()));
    renderer.pause();
    let generation = restart(&mut renderer, job(&scene, settings(8, 6, 2)));
    finish(&renderer, &woken, generation);
    restart(&mut renderer, job(&scene, slow()));
    renderer.pause();
    drop(renderer);
}

#[test]
fn a_stopped_job_continues_from_its_pixels() {
    let scene = still();
    let alone = trace(&scene, slow(), 2);
    let (mut renderer, woken) = renderer(2);
    for _ in 0..3 {
        restart(&mut renderer, job(&scene, slow()));
        woken.recv().expect("a frame");
        renderer.latest();
        renderer.stop();
    }
    let generation = restart(&mut renderer, job(&scene, slow()));
    let frame = finish(&renderer, &woken, generation);
    assert!(frame.pixels == alone.pixels && frame.objects == alone.objects);
    // Cancelled tiles are traced again, but not the picture.
    let rays = alone.progress.rays;
    assert!((rays..2 * rays).contains(&frame.progress.rays));
}

/// The number of samples is raised and lowered, also to and from those that end in half a pass.
#[test]
fn more_samples_are_added_to_those_there_are() {
    let scene = still();
    let (mut renderer, woken) = renderer(2);
    let mut before = 0;
    for spp in [2, 4, 16, 11, 13, 16, 64, 8, 8, 1] {
        let generation = restart(&mut renderer, job(&scene, settings(40, 30, spp)));
        let frame = finish(&renderer, &woken, generation);
        let alone = trace(&scene, settings(40, 30, spp), 2);
        assert!(frame.pixels == alone.pixels, "{before} to {spp}");
        assert_eq!(frame.progress.spp, spp);
        assert_eq!(frame.progress.noise, alone.progress.noise);
        if before <= spp && u32::is_power_of_two(before) {
            // It counts the rays of what it continues, none of which were traced twice.
            assert_eq!(
                frame.progress.rays, alone.progress.rays,
                "{before} to {spp}"
            );
        }
        before = spp;
    }
}

/// Traces without end but a limit, then as many samples without a limit.
fn limited(limit: Limit) -> [Arc<Frame>; 2] {
    let scene = still();
    let (mut renderer, woken) = renderer(2);
    let endless = Job {
        limit: Some(limit),
        ..job(&scene, settings(40, 30, 65_536))
    };
    let generation = restart(&mut renderer, endless);
    let frame = finish(&renderer, &woken, generation);
    let alone = trace(&scene, settings(40, 30, frame.progress.spp), 2);
    [frame, alone]
}

#[test]
fn a_picture_that_ran_out_of_time_has_the_samples_of_a_whole_pass() {
    for milliseconds in [0, 40] {
        let [frame, alone] = limited(Limit::Time(Duration::from_millis(milliseconds)));
        let progress = frame.progress;
        assert!(progress.complete && progress.spp.is_power_of_two());
        assert_eq!(progress.done, 1.0);
        assert!(milliseconds != 0 || progress.spp == 1);
        assert!(frame.pixels == alone.pixels, "{}", progress.spp);
    }
}

#[test]
fn a_picture_is_complete_as_soon_as_its_noise_is_below_the_limit() {
    let noise = |frame: &Frame| frame.progress.noise.expect("samples were doubled");
    let [frame, alone] = limited(Limit::Noise(0.004));
    assert!(frame.pixels == alone.pixels);
    assert!(noise(&frame) < 0.004 && 4 <= frame.progress.spp);
    let before = trace(&still(), settings(40, 30, frame.progress.spp / 2), 2);
    assert!(0.004 <= noise(&before));
}

/// A limit is not met by a pass of a film in which some pixels have more samples.
#[test]
fn limits_apply_to_continued_pictures() {
    let scene = still();
    let (mut renderer, woken) = renderer(2);
    let generation = restart(&mut renderer, job(&scene, settings(40, 30, 16)));
    finish(&renderer, &woken, generation);
    let limited = Job {
        limit: Some(Limit::Time(Duration::ZERO)),
        ..job(&scene, settings(40, 30, 65_536))
    };
    let generation = restart(&mut renderer, limited);
    let frame = finish(&renderer, &woken, generation);
    assert_eq!(frame.progress.spp, 16);
    assert!(frame.pixels == trace(&scene, settings(40, 30, 16), 2).pixels);
}
