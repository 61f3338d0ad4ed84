//! Progress toward a finished picture: grids, passes, threads, cancellation.

use std::cell::Cell;
use std::sync::atomic::{AtomicUsize, Ordering};

use super::*;
use crate::Refusal;
use crate::engine::{Film, Step, steps};
use crate::integrators::FrameContext;
use crate::picture::{Tone, tone};
use crate::world::Projection;

fn tone() -> Tone {
    Tone::Colour(tone::DisplayTransform::new(0.0, Transfer::Linear))
}

/// Glass, a mirror and a matte ball on a floor.
pub(super) fn still() -> Arc<Scene> {
    let matte = Coefficients {
        diffuse: Rgb::new(0.7, 0.3, 0.2),
        specular: Rgb::splat(0.4),
        exponent: 20.5,
        ..grey(0.1)
    };
    let objects = [
        (
            cuboid([-9.0, -2.0, -9.0], [18.0, 1.0, 18.0]),
            Coefficients {
                diffuse: Rgb::splat(0.6),
                ..grey(0.1)
            },
        ),
        (
            sphere([-1.1, 0.0, 0.0], 1.0),
            Coefficients {
                reflection: 0.8,
                ..grey(0.05)
            },
        ),
        (
            sphere([1.0, 0.0, 1.0], 0.9),
            Coefficients {
                transmission: 0.9,
                index: 1.5,
                ..matte
            },
        ),
        (sphere([0.3, 0.4, -2.0], 1.2), matte),
    ];
    let mut still = scene(
        &objects,
        &[white_light([3.0, 5.0, 4.0]), white_light([-4.0, 6.0, 2.0])],
    );
    still.ambient = Rgb::splat(0.4);
    Arc::new(still)
}

pub(super) fn trace(scene: &Arc<Scene>, settings: Settings, threads: usize) -> Arc<Frame> {
    let (mut renderer, woken) = renderer(threads);
    let generation = restart(&mut renderer, job(scene, settings));
    finish(&renderer, &woken, generation)
}

#[test]
fn passes_double() {
    let samples = |spp| {
        let passes = steps(spp, Frames::Live)
            .into_iter()
            .filter_map(|step| match step {
                Step::Samples(indices) => Some(indices),
                Step::Grid(_) => None,
            });
        passes.collect::<Vec<_>>()
    };
    assert_eq!(samples(1), []);
    assert_eq!(samples(8), [1..2, 2..4, 4..8]);
    assert_eq!(samples(11), [1..2, 2..4, 4..8, 8..11]);
    // Coarse grids are skipped if no intermediate frames are shown.
    let unseen = steps(3, Frames::Last);
    assert_eq!(unseen, [0..1, 1..2, 2..3].map(Step::Samples));
}

#[test]
fn pictures_do_not_depend_on_the_number_of_threads() {
    let scene = still();
    let alone = trace(&scene, settings(61, 37, 6), 1);
    for threads in [2, 8] {
        let together = trace(&scene, settings(61, 37, 6), threads);
        assert_eq!(together.pixels, alone.pixels);
        assert_eq!(together.objects, alone.objects);
        assert_eq!(together.progress.rays, alone.progress.rays);
    }
}

#[test]
fn cancelled_jobs_do_not_affect_later_ones() {
    let scene = still();
    let alone = trace(&scene, settings(40, 30, 4), 2);
    let (mut renderer, woken) = renderer(2);
    for spp in [512, 64, 300, 2, 1000] {
        restart(&mut renderer, job(&scene, settings(40, 30, spp)));
        // Each job has shown a frame before the next one starts.
        woken.recv().expect("a frame of every job");
        renderer.latest();
    }
    let generation = restart(&mut renderer, job(&scene, settings(40, 30, 4)));
    assert_eq!(finish(&renderer, &woken, generation).pixels, alone.pixels);
}

/// The sample at each pixel's centre is the first at any number of samples.
#[test]
fn one_sample_is_the_pixel_centre() {
    let scene = still();
    let frame = trace(&scene, settings(20, 15, 1), 1);
    let projection = Projection::new(
        &scene.camera,
        Size {
            width: 20,
            height: 15,
        },
    );
    let world = world(Scene::clone(&scene));
    let mut tracer = tracer(&world, 8);
    for (y, x) in (0..15).flat_map(|y| (0..20).map(move |x| (y, x))) {
        let (centre, reach) = projection.ray(f64::from(x) + 0.5, f64::from(y) + 0.5, || None);
        let expected = tone().bytes(tracer.radiance(&centred(centre, reach)).radiance);
        assert_eq!(frame.pixels[y as usize * 20 + x as usize], expected);
    }
}

#[test]
fn frames_contain_their_progress() {
    let scene = still();
    let frame = trace(&scene, settings(30, 20, 5), 2);
    assert_eq!(
        frame.size,
        Size {
            width: 30,
            height: 20
        }
    );
    let progress = frame.progress;
    assert_eq!((progress.pass, progress.passes, progress.spp), (4, 4, 5));
    assert_eq!(
        (progress.done, progress.complete, progress.over_budget),
        (1.0, true, 0)
    );
    // Two lights: at least the camera rays, and no more than the budget.
    assert!(30 * 20 * 5 <= progress.rays);
}

/// A matte ball that fills the picture, fully lit by two lights.
#[test]
fn rays_are_counted_by_kind() {
    let lights = [-1.0, 1.0].map(|x| Light::point(DVec3::new(x, 0.0, 40.0), Rgb::ONE));
    let matte = Coefficients {
        diffuse: Rgb::splat(0.5),
        ..BLACK
    };
    let mut scene = scene(&[(sphere([0.0, 0.0, -30.0], 30.0), matte)], &lights);
    scene.camera.eye = DVec3::new(0.0, 0.0, 10.0);
    scene.camera.target = DVec3::ZERO;
    for integrator in [Integrator::Whitted, Integrator::Path] {
        let settings = Settings {
            integrator,
            depth: 0,
            ..settings(20, 10, 3)
        };
        let progress = trace(&Arc::new(scene.clone()), settings, 2).progress;
        let samples = 20 * 10 * 3;
        assert_eq!(progress.rays, 3 * samples, "{integrator:?}");
        assert_eq!(progress.shadow_rays, 2 * samples, "{integrator:?}");
    }
}

/// Tiles adapt to the shape of the picture, but each pixel is the mean of its own samples.
#[test]
fn pictures_smaller_than_a_tile_are_complete() {
    let scene = still();
    for (width, height) in [
        (1, 1),
        (1, 40),
        (17, 3),
        (5, 600),
        (600, 9),
        (300, 1),
        (3, 2),
    ] {
        let frame = trace(&scene, settings(width, height, 2), 2);
        assert_eq!(frame.pixels.len(), (width * height) as usize);
        let projection = Projection::new(&scene.camera, frame.size);
        let world = world(Scene::clone(&scene));
        let mut tracer = tracer(&world, 8);
        for (at, pixel) in frame.pixels.iter().enumerate() {
            let (x, y) = (at as u32 % width, at as u32 / width);
            let samples = [0, 1].map(|index| {
                let [across, down] = Sampler::new(x, y, index, 0).place_in_pixel();
                let (ray, reach) =
                    projection.ray(f64::from(x) + across, f64::from(y) + down, || None);
                tracer.radiance(&centred(ray, reach)).radiance
            });
            assert_eq!(
                *pixel,
                tone().bytes((samples[0] + samples[1]) / 2.0),
                "({x}, {y})"
            );
        }
    }
}

/// Tiles waste little memory beyond the edges of pictures of any shape.
#[test]
fn tiles_waste_few_pixels() {
    for (width, height) in [
        (1, 1),
        (1 << 22, 1),
        (1, 1 << 22),
        (1 << 20, 3),
        (9, 1 << 18),
    ] {
        let size = Size { width, height };
        let film = Film::new(&job(&still(), settings(size.width, size.height, 1)))
            .expect("memory that is not touched is there");
        let held = 256 * film.tiles();
        assert!(held < 2 * size.pixels() + 256, "{width}x{height}: {held}");
    }
}

/// A picture too large for any machine is refused without being tried.
#[test]
fn a_picture_that_does_not_fit_into_memory_is_refused() {
    let (mut renderer, woken) = renderer(1);
    let huge = settings(u32::MAX, u32::MAX, 1);
    let refused = renderer.restart(job(&still(), huge));
    assert!(matches!(
        refused,
        Err(Refusal::Memory { size, bytes }) if size == huge.size && 1 << 60 < bytes
    ));
    let generation = restart(&mut renderer, job(&still(), settings(4, 3, 1)));
    finish(&renderer, &woken, generation);
}

/// Dropping a renderer ends a picture that would take hours.
#[test]
fn dropping_a_renderer_cancels_its_work() {
    let (mut renderer, woken) = renderer(1);
    restart(&mut renderer, job(&still(), settings(4000, 4000, 60_000)));
    woken.recv().expect("a first frame");
    drop(renderer);
}

/// A scene with other colours but equal shapes keeps its tree and shows the new colours.
#[test]
fn an_edited_colour_appears_in_the_next_picture() {
    let many = |level: f64| {
        let ball = |k: u32| {
            (
                sphere([f64::from(k % 10) - 4.5, f64::from(k / 10) - 4.5, 0.0], 0.4),
                grey(level),
            )
        };
        let objects: Vec<_> = (0..100).map(ball).collect();
        Arc::new(scene(&objects, &[]))
    };
    let (mut renderer, woken) = renderer(1);
    for level in [0.25, 0.75] {
        let generation = restart(&mut renderer, job(&many(level), settings(40, 30, 1)));
        let frame = finish(&renderer, &woken, generation);
        let brightest = frame.pixels.iter().map(|pixel| pixel[0]).max();
        assert_eq!(brightest, Some((level * 255.0 + 0.5) as u8));
    }
}

/// A panic during rendering ends the worker, and callers do not wait forever.
#[test]
fn a_panicked_worker_refuses_jobs() {
    let mut broken = Scene::clone(&still());
    broken.materials.edit(Vec::clear);
    let (mut renderer, woken) = renderer(1);
    restart(&mut renderer, job(&Arc::new(broken), settings(4, 3, 1)));
    assert_eq!(woken.recv(), Err(mpsc::RecvError));
    let refused = renderer.restart(job(&still(), settings(4, 3, 1)));
    assert_eq!(refused, Err(Refusal::Ended));
}

/// If a job shows only its last frame, earlier frames contain only the progress, and the last one
/// has no objects.
#[test]
fn unwatched_pixels_are_not_developed() {
    let scene = still();
    let (mut renderer, woken) = renderer(1);
    let last = Job {
        frames: Frames::Last,
        ..job(&scene, settings(400, 300, 8))
    };
    let size = last.settings.size;
    restart(&mut renderer, last);
    woken.recv().expect("a frame");
    let mut frame = renderer.latest().expect("a frame");
    while !frame.progress.complete {
        assert!(frame.pixels.is_empty() && frame.objects.is_empty());
        woken.recv().expect("a frame");
        frame = renderer.latest().unwrap_or(frame);
    }
    let live = trace(&scene, settings(400, 300, 8), 2);
    assert!(frame.pixels == live.pixels && frame.objects.is_empty());
    assert_eq!(live.objects.len(), size.pixels());
}

/// Memory is touched and pixels are developed in parts, with cancellation polled in between.
#[test]
fn a_film_touches_memory_while_tracing_and_developing_can_be_cancelled() {
    let size = Size {
        width: 2000,
        height: 1000,
    };
    let world = world(Scene::clone(&still()));
    let traced = settings(size.width, size.height, 1);
    let context = FrameContext::new(&world, &world.scene.camera, traced);
    let mut film =
        Film::new(&job(&still(), settings(size.width, size.height, 1))).expect("memory is there");
    assert_eq!((film.tiles(), film.begun()), (125 * 63, 0));
    film.advance(0..7, (&Step::Grid(8), 0..1), &context, &|| false);
    assert_eq!(film.begun(), 7);
    film.advance(7..film.tiles(), (&Step::Grid(8), 0..1), &context, &|| true);
    let asked = AtomicUsize::new(0);
    let stop_at_the_third = || asked.fetch_add(1, Ordering::Relaxed) == 2;
    assert!(film.develop(&stop_at_the_third).is_none());
    assert_eq!(asked.into_inner(), 3);
    let raster = film.develop(&|| false).expect("nothing cancels");
    assert_eq!(raster.pixels.len(), size.pixels());
}

/// Once tracing is cancelled, none of many samples traced together begins, with either integrator.
#[test]
fn cancellation_skips_remaining_samples() {
    let shiny = Coefficients {
        reflection: 1.0,
        ..BLACK
    };
    let inside = world(scene(&[(sphere([0.0; 3], 1.0), shiny)], &[]));
    let sample = centred(ray([0.0; 3], [0.0, 0.3, 1.0]), f64::INFINITY);
    for integrator in [Integrator::Whitted, Integrator::Path] {
        let asked = Cell::new(false);
        let is_cancelled = || asked.replace(true);
        let mut tracer = Tracer::new(&inside, integrator, 8, &is_cancelled);
        tracer.trace(&[sample; 100], &mut Vec::new());
        let rays = tracer.counts().rays;
        assert!((1..=200).contains(&rays), "{integrator:?}: {rays}");
    }
}

/// A sample that sums ten thousand lights stops early when cancelled.
#[test]
fn cancellation_skips_remaining_lights() {
    let lights: Vec<_> = (0..10_000).map(|_| white_light([0.0, 5.0, 5.0])).collect();
    let matte = Coefficients {
        diffuse: Rgb::ONE,
        ..BLACK
    };
    let world = world(scene(&[(sphere([0.0; 3], 1.0), matte)], &lights));
    for integrator in [Integrator::Whitted, Integrator::Path] {
        // Continues at the first poll only.
        let asked = Cell::new(false);
        let is_cancelled = || asked.replace(true);
        let mut tracer = Tracer::new(&world, integrator, 0, &is_cancelled);
        tracer.radiance(&centred(ray([0.0, 0.0, 5.0], [0.0; 3]), f64::INFINITY));
        assert!((2..300).contains(&tracer.counts().rays), "{integrator:?}");
    }
}
