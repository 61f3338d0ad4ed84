//! Records of samples against the samples themselves.

use std::fs;
use std::path::{Path, PathBuf};

use super::*;
use crate::assets::{Assets, Loaded, Wanted};
use crate::render::shot::Shot;
use crate::render::{Explanation, PreparedScene, Query, RayEnd};

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
    let own = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
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
            depth: crate::render::default_depth(integrator),
            ..settings(width, height, 16)
        },
        ..job(&Arc::new(scene), settings(1, 1, 1))
    }
}

/// The radiance of a sample, traced among others as in a picture.
fn traced(job: &Job, world: &World, pixel: [u32; 2], index: u32) -> Rgb {
    let shot = Shot {
        world,
        projection: super::super::camera::Projection::new(&job.camera, job.settings.size),
        eye: job.camera.eye,
        settings: job.settings,
        spread: super::super::filter::Spread::of(job.settings.filter),
    };
    let [x, y] = pixel;
    let beside = [x.saturating_sub(1), y];
    let mut samples = Vec::new();
    shot.samples(&[beside, pixel, beside], index, &mut samples);
    let mut seen = Vec::new();
    let Settings {
        integrator, depth, ..
    } = job.settings;
    Tracer::new(world, integrator, depth, || false).trace(&samples, &mut seen);
    seen[1].radiance
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
        let parts = shading.emission + shading.ambient + lights + shading.unlisted.radiance;
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
    let Some(read) = read(path) else { return };
    let job = job_of(read, integrator);
    let prepared = PreparedScene::new(&job, || false).expect("nothing cancels");
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
        let context = format!("{} {pixel:?} {index} {integrator:?}", path.display());
        let explanation = query
            .explain(pixel, index, || false)
            .expect("it is prepared");
        let expected = traced(&job, &world, pixel, index);
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
        for integrator in [Integrator::Whitted] {
            check_scene(&path, integrator);
        }
    }
}
