//! Pictures kept beyond their renderer, as bytes.

use std::io::ErrorKind;
use std::sync::mpsc::Receiver;

use super::edits::Easel;
use super::progress::{still, trace};
use super::*;
use crate::engine::{Effort, Kept};
use crate::{Aov, Region};

fn bytes_of(kept: &Kept) -> Vec<u8> {
    let mut bytes = Vec::new();
    kept.write(&mut bytes).expect("memory is there");
    bytes
}

fn read(mut bytes: &[u8], job: &Job) -> std::io::Result<Kept> {
    let kept = Kept::read(&mut bytes, job)?;
    assert!(bytes.is_empty(), "{} bytes are left", bytes.len());
    Ok(kept)
}

/// As bytes and back.
fn recalled(kept: &Kept, job: &Job) -> Receiver<Kept> {
    let (send, recalled) = mpsc::channel();
    let kept = read(&bytes_of(kept), job).expect("it is as it was written");
    send.send(kept).expect("it is there");
    recalled
}

/// Jobs for pictures of several shapes: wide, narrow, low and smaller than a tile; and for a region.
fn jobs(spp: u32) -> Vec<Job> {
    let scene = still();
    let region = Region {
        x: 3,
        y: 5,
        width: 21,
        height: 18,
    };
    let mut jobs = Vec::new();
    for integrator in [Integrator::Whitted, Integrator::Path] {
        for (width, height) in [(37, 21), (5, 70), (140, 3), (3, 2)] {
            let settings = Settings {
                integrator,
                ..settings(width, height, spp)
            };
            jobs.push(job(&scene, settings));
        }
        let settings = Settings {
            integrator,
            region: Some(region),
            ..settings(40, 30, spp)
        };
        jobs.push(job(&scene, settings));
    }
    jobs
}

#[test]
fn a_picture_cancelled_in_a_pass_continues_to_the_same_picture() {
    let (mut cancelled, mut with_leftovers) = (0, 0);
    for job in jobs(7) {
        let settings = job.settings;
        let mut anew = Easel::new(job.clone());
        anew.trace(u64::MAX);
        for patience in [0, 3, 30, 100, 300, 1000, 3000] {
            let mut easel = Easel::new(job.clone());
            if easel.trace(patience) {
                break;
            }
            cancelled += 1;
            let kept = easel.film.keep(Effort::default());
            let bytes = bytes_of(&kept);
            let kept = read(&bytes, &job).expect("it is as it was written");
            assert!(bytes_of(&kept) == bytes);
            with_leftovers += kept
                .tiles
                .iter()
                .filter(|tile| tile.has_leftovers())
                .count();
            let mut easel = Easel::new(job.clone());
            easel.film.take_over(kept, Dependencies::NOTHING);
            easel.trace(u64::MAX);
            assert!(easel.shows() == anew.shows(), "{settings:?}, {patience}");
        }
    }
    assert!(20 < cancelled && 10 < with_leftovers);
}

/// What is seen of a finished picture.
fn assert_same(frame: &Frame, alone: &Frame) {
    assert!(frame.pixels == alone.pixels && frame.objects == alone.objects);
    assert!(frame.values == alone.values && frame.errors == alone.errors);
    let (found, expected) = (frame.progress, alone.progress);
    assert_eq!(
        (found.spp, found.noise, found.over_budget),
        (expected.spp, expected.noise, expected.over_budget)
    );
}

/// Starts a picture and waits for a frame of it.
fn begun(job: &Job) -> Renderer {
    let (mut renderer, woken) = renderer(2);
    restart(&mut renderer, job.clone());
    woken.recv().expect("a first frame");
    renderer
}

#[test]
fn another_renderer_continues_a_picture_that_was_running_or_paused() {
    let job = job(&still(), settings(160, 120, 16));
    let alone = trace(&job.scene, job.settings, 2);
    let mut rays = 0;
    let mut kept: Option<Kept> = None;
    for is_paused in [false, true] {
        let mut first = match kept.take() {
            None => begun(&job),
            Some(kept) => {
                let (mut renderer, woken) = renderer(1);
                let restarted = renderer.restart_from(job.clone(), recalled(&kept, &job));
                restarted.expect("the worker runs");
                woken.recv().expect("a frame");
                renderer
            }
        };
        if is_paused {
            first.pause();
        }
        let left = first.keep().expect("it is begun");
        // All of it only if this thread had to wait long.
        assert!(0 < left.samples() && left.samples() <= 160 * 120 * 16);
        assert!(rays <= left.effort.counts.rays);
        rays = left.effort.counts.rays;
        kept = Some(left);
    }
    let kept = kept.expect("it was kept twice");
    let (mut renderer, woken) = renderer(3);
    let generation = renderer.restart_from(job.clone(), recalled(&kept, &job));
    let frame = finish(&renderer, &woken, generation.expect("the worker runs"));
    assert_same(&frame, &alone);
    assert!(kept.time() < frame.progress.elapsed);
    // Cancelled tiles are traced again, but not the picture.
    let all = alone.progress.rays;
    assert!(rays <= frame.progress.rays && (all..2 * all).contains(&frame.progress.rays));
}

/// Also to fewer samples, of which those there are are none.
#[test]
fn a_complete_picture_is_shown_at_once_and_gets_more_samples() {
    let scene = still();
    let first = job(&scene, settings(40, 30, 4));
    let (mut one, woken) = renderer(2);
    let generation = restart(&mut one, first);
    finish(&one, &woken, generation);
    let kept = one.keep().expect("it is complete");
    assert_eq!((kept.samples(), kept.spp()), (40 * 30 * 4, 4));
    for spp in [4, 16, 11, 2, 3] {
        let job = job(&scene, settings(40, 30, spp));
        let alone = trace(&scene, job.settings, 2);
        let (mut renderer, woken) = renderer(2);
        let generation = renderer.restart_from(job.clone(), recalled(&kept, &job));
        let frame = finish(&renderer, &woken, generation.expect("the worker runs"));
        assert_same(&frame, &alone);
        // None is traced twice.
        let (rays, shadow_rays) = (frame.progress.rays, frame.progress.shadow_rays);
        if 4 <= spp {
            assert_eq!(rays, alone.progress.rays, "{spp}");
            assert_eq!(shadow_rays, alone.progress.shadow_rays, "{spp}");
            assert!(kept.time() <= frame.progress.elapsed);
        }
    }
}

#[test]
fn a_recalled_picture_is_retraced_where_an_edit_shows() {
    let scene = still();
    let first = job(&scene, settings(40, 30, 4));
    let (mut one, woken) = renderer(2);
    let generation = restart(&mut one, first.clone());
    finish(&one, &woken, generation);
    let kept = one.keep().expect("it is complete");
    let mut other = Scene::clone(&scene);
    other.materials[1] = Material::from(grey(0.7));
    let other = Arc::new(other);
    let (mut renderer, woken) = renderer(2);
    // The edit comes before anything is recalled.
    let (send, recalled) = mpsc::channel();
    renderer
        .restart_from(first.clone(), recalled)
        .expect("the worker runs");
    let generation = restart(&mut renderer, job(&other, first.settings));
    let kept = read(&bytes_of(&kept), &first).expect("it is as it was written");
    send.send(kept).expect("the worker waits");
    let frame = finish(&renderer, &woken, generation);
    let alone = trace(&other, first.settings, 2);
    assert_same(&frame, &alone);
    assert!(frame.progress.rays < alone.progress.rays);
}

#[test]
fn a_renderer_that_waits_for_a_picture_ends_at_once() {
    let job = job(&still(), settings(40, 30, 4));
    let (_send, recalled) = mpsc::channel();
    let (mut renderer, _woken) = renderer(1);
    let restarted = renderer.restart_from(job, recalled);
    restarted.expect("the worker runs");
    assert!(renderer.keep().is_none_or(|kept| kept.samples() == 0));
}

#[test]
fn pictures_that_cannot_be_continued_are_not_kept() {
    let last = Job {
        frames: Frames::Last,
        ..job(&still(), settings(40, 30, 4))
    };
    assert!(begun(&last).keep().is_none());
    let (renderer, _woken) = renderer(1);
    assert!(renderer.keep().is_none(), "nothing was traced");
}

/// The bytes of the complete picture of a job.
fn small(job: &Job) -> Vec<u8> {
    let mut easel = Easel::new(job.clone());
    easel.trace(u64::MAX);
    bytes_of(&easel.film.keep(Effort::default()))
}

#[test]
fn bytes_of_no_such_picture_are_refused() {
    let live = job(&still(), settings(20, 17, 4));
    let bytes = small(&live);
    for length in (0..bytes.len()).step_by(97).chain([44, bytes.len() - 1]) {
        let error = read(&bytes[..length], &live).expect_err("bytes are missing");
        assert_eq!(error.kind(), ErrorKind::UnexpectedEof, "{length}");
    }
    let with = |at: usize, new: &[u8]| {
        let mut bytes = bytes.clone();
        bytes[at..at + new.len()].copy_from_slice(new);
        bytes
    };
    let tile = bytes.len() / 4;
    let (objects, levels) = (45 + 24 * 256, 45 + 28 * 256);
    let hostile = [
        with(0, &[0; 4]),
        with(0, &65_537u32.to_le_bytes()),
        with(4, &[0]),
        with(4, &[2]),
        with(5, &5u32.to_le_bytes()),
        with(5, &u32::MAX.to_le_bytes()),
        with(17, &1_000_000_000u32.to_le_bytes()),
        with(objects, &4u32.to_le_bytes()),
        with(levels, &[4]),
        with(levels, &[255]),
        // Beyond the edge of the second tile.
        with(levels + tile + 15, &[0]),
    ];
    for (number, bytes) in hostile.iter().enumerate() {
        let error = Kept::read(&mut &bytes[..], &live).expect_err("it is no such picture");
        assert_eq!(error.kind(), ErrorKind::InvalidData, "{number}");
    }
    // More is stored than a job that shows no causes needs, but not less.
    let last = Job {
        frames: Frames::Last,
        ..live.clone()
    };
    assert!(read(&bytes, &last).is_ok());
    let cost = Job {
        settings: Settings {
            aov: Some(Aov::Cost),
            ..live.settings
        },
        ..last.clone()
    };
    let less = small(&last);
    assert!(read(&less, &last).is_ok());
    for job in [live, cost] {
        let error = Kept::read(&mut &less[..], &job).expect_err("it stores too little");
        assert_eq!(error.kind(), ErrorKind::InvalidData);
    }
}

/// Whatever they are, a picture is traced to the end.
#[test]
fn no_bytes_make_tracing_fail() {
    let job = job(&still(), settings(3, 2, 3));
    let bytes = small(&job);
    for at in 0..bytes.len() {
        let mut bytes = bytes.clone();
        bytes[at] ^= 0xFF;
        let Ok(kept) = Kept::read(&mut &bytes[..], &job) else {
            continue;
        };
        if at % 61 == 0 || at < 45 {
            let mut easel = Easel::new(job.clone());
            easel.film.take_over(kept, Dependencies::NOTHING);
            easel.trace(u64::MAX);
        }
    }
}
