//! Explaining pixels: how long the record of a sample and its words take, as a table.
//!
//! `cargo bench --bench explain` measures a sphereflake of 66,430 spheres; arguments are other
//! scenes' paths, whose files are not read.

#[allow(dead_code, reason = "shared with the other benches")]
mod scenes;

use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

use halflight::explain::{Subject, words};
use halflight::language::{Language, Source};
use halflight::render::{Frames, Job, PreparedScene, Settings};
use halflight::scene::{Images, Integrator, Meshes, Rendering, Scene};

/// Pixels explained of each scene, on a grid.
const PIXELS: u32 = 20 * 15;

fn main() {
    let given: Vec<_> = std::env::args()
        .skip(1)
        .filter(|argument| !argument.starts_with("--"))
        .collect();
    println!(
        "{:<20} {:<8} {:>8} {:>10} {:>8} {:>10} {:>8}",
        "scene", "by", "objects", "record ms", "most", "words ms", "most"
    );
    if given.is_empty() {
        rows("flake of 66,430", Language::Ray, scenes::sphereflake(5));
    }
    for path in &given {
        let language = Language::of_path(Path::new(path)).expect("the name of a scene");
        let text = std::fs::read_to_string(path).expect("a scene");
        let name = Path::new(path).file_name().unwrap_or_default();
        rows(&name.to_string_lossy(), language, text);
    }
}

fn rows(name: &str, language: Language, text: String) {
    let mut source = Source::new(language, Arc::new(text));
    let lowered = source.lower(&Meshes::default()).expect("there is memory");
    let scene = Arc::new(lowered.scene.expect("a scene without errors"));
    for integrator in Integrator::ALL {
        let (record, said) = times(&source, &scene, integrator);
        println!(
            "{name:<20} {:<8} {:>8} {:>10} {:>8} {:>10} {:>8}",
            integrator.name(),
            scene.objects.len(),
            milliseconds(record[record.len() / 2]),
            milliseconds(record[record.len() - 1]),
            milliseconds(said[said.len() / 2]),
            milliseconds(said[said.len() - 1]),
        );
    }
}

/// The times of recording samples and of putting the records into words, ascending.
fn times(
    source: &Source,
    scene: &Arc<Scene>,
    integrator: Integrator,
) -> (Vec<Duration>, Vec<Duration>) {
    let size = scene.camera.size;
    let job = Job {
        scene: Arc::clone(scene),
        images: Images::default(),
        camera: scene.camera,
        settings: Settings {
            spp: 1,
            depth: integrator.default_depth(),
            integrator,
            transfer: scene.setting.rendering.transfer(),
            ..Settings::new(size, &Rendering::default())
        },
        limit: None,
        frames: Frames::Last,
        denoise: false,
        numbers: None,
    };
    let prepared = PreparedScene::new(&job, &|| false).expect("nothing cancels");
    let subject = Subject {
        source,
        scene,
        camera: &job.camera,
        size,
    };
    let (mut record, mut said) = (Vec::new(), Vec::new());
    for number in 0..PIXELS {
        let pixel = [
            (number % 20) * size.width / 20,
            (number / 20) * size.height / 15,
        ];
        let begun = Instant::now();
        let explained = prepared.query().explain(pixel, 0, &|| false);
        let explained = explained.expect("the pixel is in the picture");
        record.push(begun.elapsed());
        let begun = Instant::now();
        std::hint::black_box(words(&explained, &subject));
        said.push(begun.elapsed());
    }
    record.sort_unstable();
    said.sort_unstable();
    (record, said)
}

fn milliseconds(time: Duration) -> String {
    format!("{:.2}", time.as_secs_f64() * 1e3)
}
