//! Records of samples against the samples themselves.

use std::fs;
use std::path::{Path, PathBuf};

use super::many_lights::lamps;
use super::*;
use crate::integrators::path::radiance_alone;
use crate::integrators::{FrameContext, Probe};
use crate::{Explanation, PreparedScene, Query, RayEnd, RayKind, Stop, TracedRay};
use assets::{Assets, Loaded, Wanted};
use geometry::lanes::Level;
use scene::Emitter;

/// Samples explained per scene and integrator.
const PER_SCENE: usize = 40;

/// Reads a scene with its meshes and pictures; `None` if it is no scene.
fn read(path: &Path) -> Option<(Scene, Images)> {
    let language = Language::of_path(path).ok()?;
    let text = fs::read_to_string(path).ok()?;
    let mut source = Source::new(language, Arc::new(text));
    let mut assets = Assets::new(&[]);
    let mut loaded = Loaded::default();
    let mut scene = None;
    // The files that meshes name are known once the meshes are read.
    for _ in 0..3 {
        let lowered = source.lower(&loaded.meshes).expect("there is memory");
        loaded = assets.read(&Wanted::new(path, &source.files()));
        scene = lowered.scene;
    }
    Some((scene?, loaded.images))
}

/// Our scenes, and the course's if their folder is given.
fn scenes() -> Vec<PathBuf> {
    let own = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let mut folders = vec![own];
    folders.extend(std::env::var_os("HALFLIGHT_EXTRA_SCENES").map(PathBuf::from));
    let mut scenes = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).expect("folders of scenes are readable") {
            let path = entry.expect("folders of scenes are readable").path();
            if path.is_dir() {
                folders.push(path);
            } else if Language::of_path(&path).is_ok() {
                scenes.push(path);
            }
        }
    }
    scenes.sort();
    scenes
}

fn job_of((scene, images): (Scene, Images), integrator: Integrator) -> Job {
    let Size { width, height } = scene.camera.size;
    Job {
        images,
        settings: Settings {
            integrator,
            depth: integrator.default_depth(),
            ..settings(width, height, 16)
        },
        ..job(&Arc::new(scene), settings(1, 1, 1))
    }
}

/// The radiance of a sample, traced among others as in a picture, in the second of several packets;
/// by the vectors of this machine and by those that every machine has; a path also alone.
fn traced(job: &Job, world: &World, pixel: [u32; 2], index: u32) -> Rgb {
    let context = FrameContext::new(world, &job.camera, job.settings);
    let [x, y] = pixel;
    let row: Vec<_> = (0..21)
        .map(|place| [(x + place).saturating_sub(13), y])
        .collect();
    let place = row.iter().rposition(|other| *other == pixel);
    let mut samples = Vec::new();
    context.samples(&row, index, &mut samples);
    let Settings {
        integrator, depth, ..
    } = job.settings;
    let trace = |world: &World| {
        let mut seen = Vec::new();
        Tracer::new(world, integrator, depth, &|| false).trace(&samples, &mut seen);
        seen
    };
    let seen = trace(world);
    let level = Level::baseline();
    let plain = trace(&World {
        level,
        ..world.clone()
    });
    for (seen, plain) in seen.iter().zip(&plain) {
        assert_eq!(bits(seen.radiance), bits(plain.radiance));
    }
    let place = place.expect("the pixel is in its row");
    let radiance = seen[place].radiance;
    if integrator == Integrator::Path {
        let alone = radiance_alone(&mut Probe::new(world, depth, &|| false), &samples[place]);
        assert_eq!(bits(alone), bits(radiance));
    }
    radiance
}

fn bits(colour: Rgb) -> [u64; 3] {
    colour.to_array().map(f64::to_bits)
}

/// The sum of the contributions of all rays, in order.
fn sum(explanation: &Explanation) -> Rgb {
    let rays = explanation.rays.iter();
    rays.fold(Rgb::ZERO, |sum, ray| sum + ray.contribution)
}

fn check_parts(explanation: &Explanation, context: &str) {
    for (number, ray) in explanation.rays.iter().enumerate() {
        assert!(ray.parent.is_none_or(|parent| parent < number), "{context}");
        let RayEnd::Surface(shading) = &ray.end else {
            continue;
        };
        let lights: Rgb = shading.lights.iter().map(|term| term.radiance).sum();
        let emitters: Rgb = shading.emitters.iter().map(|term| term.radiance).sum();
        let shown = shading.emission + shading.ambient;
        let parts = shown + lights + shading.unlisted.radiance + emitters + shading.caustics;
        let off = (parts - shading.radiance).abs().max_element();
        let scale = shading.radiance.abs().max_element().max(1e-300);
        assert!(
            off <= 1e-12 * scale || !scale.is_finite(),
            "{context}: {shading:?}"
        );
        for term in &shading.lights {
            assert_eq!(term.dark.is_some(), term.radiance == Rgb::ZERO, "{context}");
        }
    }
}

fn check_scene(path: &Path, integrator: Integrator) {
    if let Some(read) = read(path) {
        let name = path.display().to_string();
        check_samples(&job_of(read, integrator), &name);
    }
}

fn check_samples(job: &Job, name: &str) {
    let integrator = job.settings.integrator;
    let prepared = PreparedScene::new(job, &|| false).expect("nothing cancels");
    let query: &Query = prepared.query();
    let world = query.world.upgrade().expect("it is prepared");
    let Size { width, height } = job.settings.size;
    for number in 0..PER_SCENE {
        let mut numbers = Numbers::new(number);
        let pixel = [
            numbers.below(width as usize),
            numbers.below(height as usize),
        ];
        let pixel = pixel.map(|at| at as u32);
        let index = [0, 1, 2, 7, 15][number % 5];
        let context = format!("{name} {pixel:?} {index} {integrator:?}");
        let explanation = query
            .explain(pixel, index, &|| false)
            .expect("it is prepared");
        let expected = traced(job, &world, pixel, index);
        assert_eq!(bits(explanation.radiance), bits(expected), "{context}");
        assert_eq!(bits(sum(&explanation)), bits(expected), "{context}");
        check_parts(&explanation, &context);
    }
}

#[test]
fn the_root_of_every_explanation_is_its_sample() {
    let scenes = scenes();
    assert!(10 < scenes.len(), "our own scenes are there");
    for path in scenes {
        for integrator in [Integrator::Whitted, Integrator::Path] {
            check_scene(&path, integrator);
        }
    }
}

#[test]
fn explanations_choose_the_light_that_the_picture_chose() {
    let mut mixed = lamps(40, 0.3);
    for light in mixed.lights.iter_mut().step_by(3) {
        if let Emitter::Point { radius, .. } = &mut light.emitter {
            *radius = 0.0;
        }
    }
    for mut scene in [lamps(40, 0.0), lamps(40, 0.3), mixed] {
        scene.camera.size = Size {
            width: 40,
            height: 30,
        };
        let job = job_of((scene, Images::default()), Integrator::Path);
        check_samples(&job, "lamps");
        let prepared = PreparedScene::new(&job, &|| false).expect("nothing cancels");
        let mut chosen = 0;
        for index in 0..16 {
            let explained = prepared.query().explain([20, 15], index, &|| false);
            let rays = explained.expect("it is prepared").rays;
            let lights = &rays[0].shading().expect("it hits the ball").lights;
            let chances: Vec<_> = lights.iter().map(|term| term.chance).collect();
            // Two lights do not fade. Of the others, none may be chosen: some are behind the surface.
            assert_eq!(chances[..2], [1.0; 2]);
            assert!(
                chances[2..]
                    .iter()
                    .all(|chance| (0.0..1.0).contains(chance))
            );
            chosen += chances.len() - 2;
        }
        assert!(0 < chosen);
    }
}

/// A grey ball on a table in one light.
fn ball() -> Scene {
    let matte = Coefficients {
        diffuse: Rgb::splat(0.5),
        ..BLACK
    };
    let table = cuboid([-9.0, -9.0, -2.0], [18.0, 18.0, 1.0]);
    scene(
        &[(sphere([0.0; 3], 1.0), matte), (table, matte)],
        &[white_light([3.0, 4.0, 5.0])],
    )
}

/// A diffuse surface is sampled with density N·L/π alone, so that each bounce weighs its albedo.
#[test]
fn densities_of_a_path_are_those_of_its_lobes() {
    let job = job_of((ball(), Images::default()), Integrator::Path);
    let prepared = PreparedScene::new(&job, &|| false).expect("nothing cancels");
    let mut scattered = 0;
    for index in 0..40 {
        let explained = prepared.query().explain([20, 15], index, &|| false);
        let rays = explained.expect("it is prepared").rays;
        for pair in rays.windows(2) {
            let [from, to] = pair else { continue };
            let hit = from.shading().expect("the path goes on from a surface").hit;
            let chosen = to.chosen.expect("it is scattered");
            assert_eq!((to.kind, chosen.chance), (RayKind::Diffuse, 1.0));
            let cosine = hit.normal.dot(to.direction);
            let density = chosen.density.expect("a lobe has one");
            assert_near(density, cosine / std::f64::consts::PI, 1e-12);
            assert_near(chosen.factor.x, 0.5, 1e-12);
            let weight = from.weight.x * chosen.factor.x / chosen.survival;
            assert_near(to.weight.x, weight, 1e-12);
            scattered += 1;
        }
        let last = &rays[rays.len() - 1];
        let stop = last.shading().and_then(|shading| shading.stop);
        let missed = matches!(last.end, RayEnd::Missed { .. });
        assert!(
            missed || matches!(stop, Some(Stop::Roulette { .. })),
            "{last:?}"
        );
    }
    assert!(40 <= scattered, "{scattered}");
}

/// Roulette begins at a throughput of 1/16, where light is sampled at random at 1/4.
#[test]
fn roulette_begins_earlier_where_light_is_sampled_at_random() {
    let dark = Coefficients {
        diffuse: Rgb::splat(0.1),
        ..BLACK
    };
    let room = cuboid([-9.0; 3], [18.0; 3]);
    for (size, faint) in [(0.0, 1.0 / 16.0), (0.5, 1.0 / 4.0)] {
        let mut scene = scene(&[(room.clone(), dark)], &[white_light([3.0, 4.0, 5.0])]);
        let Emitter::Point { radius, .. } = &mut scene.lights[0].emitter else {
            panic!("a point light");
        };
        *radius = size;
        let job = job_of((scene, Images::default()), Integrator::Path);
        let prepared = PreparedScene::new(&job, &|| false).expect("nothing cancels");
        let mut survivals = Vec::new();
        for index in 0..400 {
            let explained = prepared.query().explain([20, 15], index, &|| false);
            for pair in explained.expect("it is prepared").rays.windows(2) {
                let survival = pair[1].chosen.expect("it is scattered").survival;
                let throughput = 0.1 * pair[0].weight.x;
                assert_near(survival, (throughput / faint).min(1.0), 1e-12);
                survivals.push(survival);
            }
        }
        assert!(survivals.iter().any(|survival| *survival < 1.0));
    }
}

/// Nested reflective glass, whose rays double until they exceed the budget of 4096: all that were traced
/// are recorded with what they hit, the others as over budget, each one bounce after its parent.
#[test]
fn rays_over_the_budget_are_recorded() {
    let mut job = job_of((splitting_glass(), Images::default()), Integrator::Whitted);
    job.settings.depth = 30;
    let prepared = PreparedScene::new(&job, &|| false).expect("nothing cancels");
    let world = prepared.query().world.upgrade().expect("it is prepared");
    let Size { width, height } = job.settings.size;
    let pixel = [width / 2 + 1, height / 2 + 1];
    let explained = prepared.query().explain(pixel, 0, &|| false);
    let explained = explained.expect("it is prepared");
    assert_eq!(bits(sum(&explained)), bits(traced(&job, &world, pixel, 0)));
    let is_over = |ray: &&TracedRay| matches!(ray.end, RayEnd::OverBudget);
    let over = explained.rays.iter().filter(is_over).count();
    assert_eq!(explained.rays.len() - over, 4096);
    assert!(0 < over);
    for ray in &explained.rays[1..] {
        let parent = &explained.rays[ray.parent.expect("only the camera's ray has none")];
        assert_eq!(ray.bounce, parent.bounce + 1);
        let RayEnd::Surface(shading) = &parent.end else {
            panic!("{:?} has a child", parent.end);
        };
        let at = ray.origin.distance(shading.hit.point);
        assert!(at < 1e-9, "it starts where its parent ends");
    }
}

/// A light with a size is found by sampling it and by chance; the weights of both are those of the
/// power heuristic, and the densities of the light are one over its solid angle.
#[test]
fn lights_with_a_size_are_weighted_by_both_densities() {
    let scene = xml("<object type=\"plane\" material=\"m\"><scale value=\"9\"/></object>
        <material type=\"blinn\" name=\"m\"><specular value=\"0\"/></material>
        <light type=\"point\"><intensity value=\"9\"/><position z=\"4\"/><size value=\"2\"/><attenuation value=\"1\"/></light>");
    let mut job = job_of((scene, Images::default()), Integrator::Path);
    job.camera.eye = DVec3::new(0.0, 0.0, 1.0);
    job.camera.target = DVec3::ZERO;
    let prepared = PreparedScene::new(&job, &|| false).expect("nothing cancels");
    let explained = prepared.query().explain([100, 75], 1, &|| false);
    let rays = explained.expect("it is prepared").rays;
    let shading = rays[0].shading().expect("the plane");
    let densities = shading.lights[0].densities.expect("it has a size");
    let distance = (shading.hit.point - DVec3::new(0.0, 0.0, 4.0)).length();
    let versine = 1.0 - (1.0 - 4.0 / (distance * distance)).sqrt();
    assert_near(
        densities.by_light,
        1.0 / (std::f64::consts::TAU * versine),
        1e-12,
    );
    let by_path = shading.lights[0].cosine / std::f64::consts::PI;
    assert_near(densities.by_path, by_path, 1e-12);
    let [own, other] = [densities.by_light.powi(2), densities.by_path.powi(2)];
    assert_near(densities.weight, own / (own + other), 1e-12);
}

/// The handle of a frame answers what the frame shows, until another scene is prepared.
#[test]
fn frames_can_be_asked_about_their_pixels() {
    let scene = Arc::new(ball());
    let (mut renderer, woken) = renderer(2);
    let job = Job {
        frames: Frames::LastWithValues,
        numbers: Some(Arc::from([7, 3])),
        ..job(&scene, settings(40, 30, 1))
    };
    let generation = restart(&mut renderer, job);
    let frame = finish(&renderer, &woken, generation);
    let query = frame.query.as_ref().expect("it was traced");
    let explained = query
        .explain([20, 15], 0, &|| false)
        .expect("it is prepared");
    let value = frame.values[15 * 40 + 20];
    assert_eq!(explained.radiance.as_vec3().to_array(), value);
    let hit = query.first_hit([20, 15]).expect("it is prepared");
    let surface = hit.surface.expect("the ball");
    assert_eq!((surface.object, surface.material), (7, 0));
    assert_eq!(explained.rays[0].shading().expect("the ball").hit, surface);
    assert_near(
        hit.depth,
        (surface.point - scene.camera.eye).length(),
        1e-12,
    );
    assert_eq!(query.first_hit([40, 0]), None);
    for _ in 0..2 {
        let later = Arc::new(ball());
        let generation = restart(&mut renderer, self::job(&later, settings(40, 30, 1)));
        finish(&renderer, &woken, generation);
    }
    assert_eq!(query.first_hit([20, 15]), None);
}
