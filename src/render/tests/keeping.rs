//! Pictures kept beyond their renderer, in blocks.

use std::io::ErrorKind;
use std::sync::mpsc::Receiver;
use std::time::Duration;

use super::blocks::{assembled, continued};
use super::edits::Easel;
use super::noise::wall;
use super::progress::{still, trace};
use super::*;
use crate::engine::Checkpoint;
use crate::{Aov, Block, BlockTracer, Counts, PixelHistory, Region};

fn blocks_of(kept: &Checkpoint) -> Vec<Block> {
    kept.blocks().collect()
}

fn read(blocks: &[Block], job: &Job) -> std::io::Result<Checkpoint> {
    let blocks = blocks.iter().cloned().map(Ok);
    Checkpoint::of(blocks, Duration::from_secs(1), job)
}

/// In blocks and back.
fn recalled(kept: &Checkpoint, job: &Job) -> Receiver<Checkpoint> {
    from_blocks(&blocks_of(kept), job)
}

fn from_blocks(blocks: &[Block], job: &Job) -> Receiver<Checkpoint> {
    let (send, recalled) = mpsc::channel();
    let kept = read(blocks, job).expect("they are of the picture");
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
            let kept = easel.film.into_checkpoint(Duration::ZERO);
            with_leftovers += kept
                .tiles
                .iter()
                .filter(|tile| tile.has_leftovers())
                .count();
            let blocks = blocks_of(&kept);
            let kept = read(&blocks, &job).expect("they are of the picture");
            assert!(blocks_of(&kept) == blocks);
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
    let mut kept: Option<Checkpoint> = None;
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
        let left = first.into_checkpoint().expect("it is begun");
        // All of it only if this thread had to wait long.
        assert!(0 < left.samples() && left.samples() <= 160 * 120 * 16);
        let counts = left.tiles.iter().map(|tile| tile.counts.rays);
        let all_rays = counts.sum();
        assert!(rays <= all_rays);
        rays = all_rays;
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
    let kept = one.into_checkpoint().expect("it is complete");
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
    let kept = one.into_checkpoint().expect("it is complete");
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
    let kept = read(&blocks_of(&kept), &first).expect("they are of the picture");
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
    assert!(
        renderer
            .into_checkpoint()
            .is_none_or(|kept| kept.samples() == 0)
    );
}

#[test]
fn pictures_that_cannot_be_continued_are_not_kept() {
    let last = Job {
        frames: Frames::Last,
        ..job(&still(), settings(40, 30, 4))
    };
    assert!(begun(&last).into_checkpoint().is_none());
    let (renderer, _woken) = renderer(1);
    assert!(renderer.into_checkpoint().is_none(), "nothing was traced");
}

/// Jobs whose blocks are continued by a renderer and by a tracer of blocks: besides several shapes, by
/// photons, adaptively, and to samples that are no power of two.
fn exchanged() -> Vec<Job> {
    let scene = still();
    let by_photons = Settings {
        integrator: Integrator::Photon,
        falloff: FalloffRule::Square,
        ..settings(40, 35, 20)
    };
    let adaptive = Settings {
        noise: 0.055,
        ..settings(40, 35, 64)
    };
    let surface = Settings {
        aov: Some(Aov::Depth),
        ..settings(40, 35, 16)
    };
    // Wide, low and a region, by Whitted and by paths.
    let shapes = jobs(11).into_iter().enumerate();
    let shapes = shapes.filter(|(shape, _)| [0, 2, 5, 9].contains(shape));
    let mut jobs: Vec<_> = shapes.map(|(_, job)| job).collect();
    jobs.extend([by_photons, surface].map(|settings| job(&scene, settings)));
    jobs.push(job(&wall(), adaptive));
    jobs
}

/// What is left of a picture after the frames that come first.
fn left_after(job: &Job, frames: u32) -> Checkpoint {
    let (mut renderer, woken) = renderer(2);
    restart(&mut renderer, job.clone());
    for _ in 0..frames {
        woken.recv().expect("the worker runs");
        if renderer
            .latest()
            .is_some_and(|frame| frame.progress.complete)
        {
            break;
        }
    }
    renderer.into_checkpoint().expect("it is begun")
}

#[test]
fn a_tracer_of_blocks_continues_what_a_renderer_left() {
    let mut begun = 0;
    for job in exchanged() {
        let Settings {
            spp, integrator, ..
        } = job.settings;
        // Several blocks, or photons and some of them.
        let polls = if integrator == Integrator::Photon {
            50_000
        } else {
            2_000
        };
        let last = Job {
            frames: Frames::LastWithValues,
            ..job.clone()
        };
        let (mut whole, woken) = renderer(2);
        let generation = restart(&mut whole, last.clone());
        let alone = finish(&whole, &woken, generation);
        let tracer = BlockTracer::new(last, 2, &|| false);
        let tracer = tracer.expect("it is traced").expect("it is not stopped");
        let blocks = tracer.blocks();
        let mut easel = Easel::new(job.clone());
        easel.trace(300);
        let by_easel = easel.film.into_checkpoint(Duration::ZERO);
        let mut left = vec![
            left_after(&job, 1),
            left_after(&job, 3),
            left_after(&job, u32::MAX),
        ];
        // It takes no photons.
        left.extend((integrator != Integrator::Photon).then_some(by_easel));
        for kept in left {
            let mut all: Vec<_> = (0..blocks.count())
                .map(|number| Block::new(number, blocks))
                .collect();
            for block in kept.blocks() {
                begun += u32::from(block.samples < spp && 0 < block.most_samples());
                let number = block.number as usize;
                all[number] = block.continued_to(spp, blocks);
            }
            let done = continued(&tracer, all, spp, Some(polls));
            let frame = assembled(&job.settings, &done);
            assert!(frame.pixels == alone.pixels, "{:?}", job.settings);
            assert!(frame.values == alone.values, "{:?}", job.settings);
        }
    }
    assert!(5 < begun, "{begun}");
}

#[test]
fn a_renderer_continues_what_a_tracer_of_blocks_left() {
    for job in exchanged() {
        let alone = trace(&job.scene, job.settings, 2);
        let tracer = BlockTracer::new(job.clone(), 2, &|| false);
        let tracer = tracer.expect("it is traced").expect("it is not stopped");
        let blocks = tracer.blocks();
        let none = || (0..blocks.count()).map(|number| Block::new(number, blocks));
        for samples in [6, job.settings.spp] {
            let some = none().filter(|block| block.number != 1).collect();
            let mut left = continued(&tracer, some, samples, None);
            // The first has all its samples.
            let whole = none().take(1).collect();
            let whole = continued(&tracer, whole, job.settings.spp, None);
            left.retain(|block| block.number != 0);
            left.extend(whole);
            let (mut renderer, woken) = renderer(2);
            let generation = renderer.restart_from(job.clone(), from_blocks(&left, &job));
            let frame = finish(&renderer, &woken, generation.expect("the worker runs"));
            assert_same(&frame, &alone);
        }
    }
}

/// The rays of blocks are not known pixel by pixel, but the picture of light is.
#[test]
fn the_cost_of_pixels_is_traced_where_it_is_not_known() {
    let light = job(&still(), settings(40, 30, 4));
    let cost = Settings {
        aov: Some(Aov::Cost),
        ..light.settings
    };
    let tracer = BlockTracer::new(light.clone(), 2, &|| false);
    let tracer = tracer.expect("it is traced").expect("it is not stopped");
    let blocks = tracer.blocks();
    let all = (0..blocks.count()).map(|number| Block::new(number, blocks));
    let left = continued(&tracer, all.collect(), 4, None);
    let alone = trace(&light.scene, cost, 2);
    let kept = read(&left, &job(&light.scene, cost)).expect("they are of the picture");
    assert_eq!(kept.samples(), 0);
    let (mut renderer, woken) = renderer(2);
    let generation = renderer.restart_from(light.clone(), from_blocks(&left, &light));
    finish(&renderer, &woken, generation.expect("the worker runs"));
    let generation = restart(&mut renderer, job(&light.scene, cost));
    assert_same(&finish(&renderer, &woken, generation), &alone);
}

/// The blocks of the complete picture of a job.
fn small(job: &Job) -> Vec<Block> {
    let mut easel = Easel::new(job.clone());
    easel.trace(u64::MAX);
    blocks_of(&easel.film.into_checkpoint(Duration::ZERO))
}

/// A way to spoil a block.
type Spoil = fn(&mut Block);

#[test]
fn blocks_of_no_such_picture_are_refused() {
    let live = job(&still(), settings(20, 17, 4));
    let refused: [Spoil; 2] = [|block| block.number = 1, |block| block.objects[0] = 4];
    for spoil in refused {
        let mut blocks = small(&live);
        spoil(&mut blocks[0]);
        let error = read(&blocks, &live).expect_err("it is no such picture");
        assert_eq!(error.kind(), ErrorKind::InvalidData);
    }
    // What is no step on the way to the samples of the job is left out.
    let left_out: [Spoil; 3] = [
        |block| block.samples = 3,
        |block| block.samples = 8,
        |block| block.samples = u32::MAX,
    ];
    for spoil in left_out {
        let mut blocks = small(&live);
        spoil(&mut blocks[0]);
        assert_eq!(read(&blocks, &live).expect("it is one").samples(), 0);
    }
    // More is stored than a job that shows no histories needs, but not less.
    let last = Job {
        frames: Frames::Last,
        ..live.clone()
    };
    let all = 20 * 17 * 4;
    let samples = |blocks: &[Block], job: &Job| read(blocks, job).expect("it is one").samples();
    assert_eq!(samples(&small(&live), &last), all);
    let cost = Job {
        settings: Settings {
            aov: Some(Aov::Cost),
            ..live.settings
        },
        ..last.clone()
    };
    let less = small(&last);
    assert_eq!(samples(&less, &last), all);
    for job in [live, cost] {
        assert_eq!(samples(&less, &job), 0);
    }
}

/// Whatever they are, a picture is traced to the end.
#[test]
fn no_blocks_make_tracing_fail() {
    let adaptive = Settings {
        noise: 0.1,
        ..settings(37, 21, 32)
    };
    for job in [
        job(&still(), settings(3, 2, 3)),
        job(&still(), settings(37, 21, 6)),
        job(&still(), adaptive),
    ] {
        let good = small(&job);
        let spoils: [Spoil; 9] = [
            |block| block.samples = 0,
            |block| block.samples = 1,
            |block| block.apart = (0..64).collect(),
            |block| block.apart = vec![u32::MAX; 64],
            |block| block.sums.fill(Rgb::splat(f64::NAN)),
            |block| block.squared_errors.fill(f32::NAN),
            |block| block.variances.fill(f32::NEG_INFINITY),
            |block| {
                block.histories.fill(PixelHistory {
                    touched: 0,
                    rays: u32::MAX,
                });
            },
            |block| {
                block.counts = Counts {
                    rays: 1,
                    shadow_rays: 2,
                    over_budget: 3,
                };
            },
        ];
        for spoil in spoils {
            let mut blocks = good.clone();
            spoil(&mut blocks[0]);
            let kept = read(&blocks, &job).expect("it is one");
            let mut easel = Easel::new(job.clone());
            easel.film.take_over(kept, Dependencies::NOTHING);
            easel.trace(u64::MAX);
        }
    }
}
