//! `.test` scenes against a plain tracer of the language, pixel by pixel.

mod checks;
mod grid;
mod plain;

use std::sync::{Arc, mpsc};

use halflight::language::{Language, Source};
use halflight::render::{Frames, Job, Renderer, Settings, Threads};
use halflight::scene::{Images, Integrator, Meshes, Rendering};

/// Scenes like those of the courses, written from the rules.
const SCENES: [(&str, &str); 7] = [
    ("layout", include_str!("layout.test")),
    ("mirrors", include_str!("mirrors.test")),
    ("quad-light", include_str!("quad-light.test")),
    ("smooth", include_str!("smooth.test")),
    ("spheres", include_str!("spheres.test")),
    ("states", include_str!("states.test")),
    ("tower", include_str!("tower.test")),
];

/// The width and the 8-bit pixels of a scene by Whitted ray tracing, one sample each.
fn pixels(name: &str, text: &str) -> (usize, Vec<[u8; 3]>) {
    let mut source = Source::new(Language::Cse167, Arc::new(text.to_owned()));
    let lowered = source.lower(&Meshes::default()).expect("there is memory");
    let found = lowered.diagnostics;
    let scene = lowered.scene.unwrap_or_else(|| panic!("{name}: {found:?}"));
    let asked = Rendering {
        integrator: Some(Integrator::Whitted),
        spp: Some(1),
        ..scene.setting.rendering
    };
    let (wake, woken) = mpsc::channel();
    let mut renderer = Renderer::new(Threads::Exactly(2), move || {
        let _ = wake.send(());
    });
    let camera = scene.camera;
    renderer
        .restart(Job {
            settings: Settings::new(camera.size, &asked),
            scene: Arc::new(scene),
            images: Images::default(),
            camera,
            limit: None,
            frames: Frames::Last,
            denoise: false,
            numbers: None,
        })
        .expect("there is memory");
    loop {
        woken.recv().expect("the worker runs");
        if let Some(frame) = renderer.latest().filter(|frame| frame.progress.complete) {
            return (camera.size.width as usize, frame.pixels.clone());
        }
    }
}

#[test]
fn pictures_are_those_of_a_plain_tracer() {
    let grid = grid::grid(8);
    let scenes = SCENES.into_iter().chain([("grid", &*grid)]);
    let mut wrong = Vec::new();
    for (name, text) in scenes {
        let picture = plain::trace(text);
        let (_, found) = pixels(name, text);
        assert_eq!(found.len(), picture.pixels.len(), "{name}");
        for (at, (found, expected)) in found.iter().zip(&picture.pixels).enumerate() {
            let level = expected.map(|part| (part.clamp(0.0, 1.0) * 255.0).round());
            let off = found
                .iter()
                .zip(level)
                .map(|(&a, b)| (f64::from(a) - b).abs());
            // Mirrors whose share changes no level by more than one are left out.
            if off.fold(0.0, f64::max) > 1.0 {
                let (x, y) = (at % picture.width, at / picture.width);
                wrong.push(format!("{name} {x},{y}: {found:?} instead of {level:?}"));
            }
        }
    }
    assert!(
        wrong.is_empty(),
        "{}\n{}",
        wrong.len(),
        wrong[..wrong.len().min(40)].join("\n")
    );
}
