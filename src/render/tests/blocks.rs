//! Blocks: the picture put together of them is that of a renderer, however they were traced.

use std::sync::Mutex;
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::Duration;

use super::progress::still;
use super::*;
use crate::job::AOVS;
use crate::{Aov, Assembly, Block, BlockTracer, Blocks, Region};
use scene::Filter;

const SIZE: (u32, u32) = (75, 40);

/// All blocks of a job, continued from none.
fn traced(job: &Job, spp: u32, polls: Option<u32>) -> Vec<Block> {
    let tracer = BlockTracer::new(job.clone(), 2, &|| false);
    let tracer = tracer.expect("it is traced").expect("it is not stopped");
    let blocks = tracer.blocks();
    let none = (0..blocks.count()).map(|number| Block::new(number, blocks));
    continued(&tracer, none.collect(), spp, polls)
}

/// Blocks continued to this many samples, traced with this much at a time before they are stopped, the
/// last blocks first.
pub(super) fn continued(
    tracer: &BlockTracer,
    left: Vec<Block>,
    spp: u32,
    polls: Option<u32>,
) -> Vec<Block> {
    let (mut done, mut left): (Vec<_>, Vec<_>) =
        left.into_iter().partition(|block| spp <= block.samples);
    while !left.is_empty() {
        let polled = AtomicU32::new(0);
        let stopped = || polls.is_some_and(|most| most < polled.fetch_add(1, Ordering::Relaxed));
        let handed_over = Mutex::new(Vec::new());
        let hand_over = |block| handed_over.lock().expect("no panics").push(block);
        let hour = Duration::from_secs(3600);
        let unbegun: Vec<_> = left.iter().map(|block| block.number).collect();
        tracer.trace(
            left.clone().into_iter().rev(),
            spp,
            hour,
            &stopped,
            hand_over,
        );
        let handed_over = handed_over.into_inner().expect("no panics");
        left.retain(|block| {
            handed_over
                .iter()
                .all(|handed| handed.number != block.number)
        });
        assert_eq!(left.len() + handed_over.len(), unbegun.len());
        let (whole, begun): (Vec<_>, _) = handed_over
            .into_iter()
            .partition(|block| block.samples == spp);
        left.extend::<Vec<Block>>(begun);
        done.extend(whole);
    }
    done
}

/// The picture of blocks.
pub(super) fn assembled(settings: &Settings, blocks: &[Block]) -> Frame {
    let assembly = Assembly::new(*settings, Frames::LastWithValues);
    let mut assembly = assembly.expect("it fits into memory");
    for block in blocks {
        assembly.place(block);
    }
    assembly.finish(settings.spp)
}

#[track_caller]
pub(super) fn assert_same(scene: &Arc<Scene>, settings: Settings, polls: Option<u32>) {
    let job = Job {
        frames: Frames::LastWithValues,
        ..job(scene, settings)
    };
    let ours = assembled(&settings, &traced(&job, settings.spp, polls));
    let (mut renderer, woken) = renderer(2);
    let generation = restart(&mut renderer, job);
    let theirs = finish(&renderer, &woken, generation);
    assert!(ours.pixels == theirs.pixels, "{settings:?}");
    let bits = |values: &[[f32; 3]]| -> Vec<_> {
        values.iter().map(|value| value.map(f32::to_bits)).collect()
    };
    assert!(bits(&ours.values) == bits(&theirs.values), "{settings:?}");
    assert_eq!(
        (ours.size, ours.corner, ours.range, ours.overexposure),
        (
            theirs.size,
            theirs.corner,
            theirs.range,
            theirs.overexposure
        )
    );
    let (ours, theirs) = (ours.progress, theirs.progress);
    assert_eq!((ours.spp, ours.passes), (theirs.spp, theirs.passes));
    if polls.is_none() {
        assert_eq!(
            (ours.rays, ours.shadow_rays),
            (theirs.rays, theirs.shadow_rays)
        );
    }
    let near = |ours: f64, theirs: f64| (ours - theirs).abs() <= 1e-6 * theirs;
    match (ours.noise, theirs.noise) {
        (Some(ours), Some(theirs)) => assert!(near(ours, theirs), "{ours} {theirs}"),
        (None, Some(_)) if settings.aov == Some(Aov::Cost) => {}
        (ours, theirs) => assert_eq!(ours, theirs),
    }
}

#[test]
fn a_picture_of_blocks_is_that_of_a_renderer() {
    let scene = still();
    let (width, height) = SIZE;
    for spp in [1, 2, 3, 8, 11] {
        for integrator in Integrator::ALL {
            let settings = Settings {
                integrator,
                exposure: 0.5,
                filter: Filter::Gaussian,
                ..settings(width, height, spp)
            };
            assert_same(&scene, settings, None);
        }
    }
    for size in [(1, 1), (5, 33), (300, 3), (32, 64)] {
        assert_same(&scene, settings(size.0, size.1, 2), None);
    }
    let region = Region {
        x: 7,
        y: 3,
        width: 40,
        height: 35,
    };
    let part = Settings {
        region: Some(region),
        ..settings(width, height, 4)
    };
    assert_same(&scene, part, None);
}

#[test]
fn aovs_of_blocks_are_those_of_a_renderer() {
    let scene = still();
    for &aov in AOVS.iter().chain(&[Aov::Direct(0)]) {
        let settings = Settings {
            aov: Some(aov),
            ..settings(SIZE.0, SIZE.1, aov.samples(6))
        };
        assert_same(&scene, settings, None);
    }
}

/// Stopped after a few polls, and continued, until all is traced.
#[test]
fn blocks_that_were_stopped_continue_to_the_same_picture() {
    let scene = still();
    for aov in [None, Some(Aov::Cost), Some(Aov::Noise)] {
        let settings = Settings {
            aov,
            ..settings(SIZE.0, SIZE.1, 13)
        };
        assert_same(&scene, settings, Some(60));
    }
    let by_photons = Settings {
        integrator: Integrator::Photon,
        falloff: FalloffRule::Square,
        ..settings(SIZE.0, SIZE.1, 32)
    };
    assert_same(&scene, by_photons, Some(50_000));
}

#[test]
fn a_block_has_its_place_and_its_cut_edges() {
    let blocks = Blocks::of(Size {
        width: 70,
        height: 33,
    });
    assert_eq!((blocks.across(), blocks.count()), (3, 6));
    for (number, region) in [
        (0, "0,0,32,32"),
        (2, "64,0,6,32"),
        (3, "0,32,32,1"),
        (5, "64,32,6,1"),
    ] {
        assert_eq!(blocks.region(number).to_string(), region);
    }
}
