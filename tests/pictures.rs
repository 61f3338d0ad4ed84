//! The project's scenes and their pictures.

use std::path::{Path, PathBuf};
use std::sync::{Arc, mpsc};

use halflight::document::Document;
use halflight::format::{self, Format};
use halflight::image_file::ImageFormat;
use halflight::render::{DEFAULT_DEPTH, Frame, Frames, Job, Renderer, Settings, Threads};
use halflight::scene::fields::{Kind, Range};
use halflight::scene::{Images, Scene, Size, lower};
use halflight::text::{Edit, parse_number};

/// Size of the pictures beside the scenes, and their samples a pixel: the README's command.
const SIZE: Size = Size {
    width: 320,
    height: 240,
};
const SPP: u32 = 8;

#[test]
fn the_pictures_beside_the_scenes_are_what_the_renderer_gives() {
    for path in scenes() {
        let scene = meaning(&read(&path));
        let frame = trace(&scene, SIZE, SPP);
        let mut bytes = Vec::new();
        ImageFormat::Bmp
            .write(&frame, &mut bytes)
            .expect("memory takes any picture");
        let expected =
            std::fs::read(path.with_extension("bmp")).expect("every scene has a picture");
        assert!(
            bytes == expected,
            "{}: the picture is another",
            path.display()
        );
    }
}

#[test]
fn the_scenes_have_nothing_to_complain_of() {
    for path in scenes() {
        let text = read(&path);
        let lowered = lower(&text, &format::parse(Format::Ray, &text));
        assert_eq!(*lowered.diagnostics, [], "{}", path.display());
    }
}

/// Nothing in the tracer has a size of its own: a scene that is 2ᵏ times as large is the same
/// picture, to the bit.
#[test]
fn scaled_scenes_give_the_same_picture() {
    let size = Size {
        width: 48,
        height: 36,
    };
    for path in scenes() {
        let text = read(&path);
        let plain = trace(&meaning(&text), size, 1);
        for exponent in [-40, -20, -7, -1, 1, 7, 20, 40] {
            let scaled = trace(&meaning(&scale(&text, 2f64.powi(exponent))), size, 1);
            assert!(
                plain.pixels == scaled.pixels,
                "{} × 2^{exponent}",
                path.display()
            );
        }
    }
}

/// The example as it comes from the course's page, with no-break spaces, is the same scene.
#[test]
fn the_course_s_own_copies_mean_the_same() {
    let Some(folder) = std::env::var_os("HALFLIGHT_EXTRA_SCENES").map(PathBuf::from) else {
        println!("HALFLIGHT_EXTRA_SCENES names no folder: the course's files are not tested");
        return;
    };
    let own = meaning(&read(&root().join("scenes/example.ray")));
    for name in ["example.ray", "example-from-page.ray"] {
        assert_eq!(
            meaning(&read(&folder.join("rice").join(name))),
            own,
            "{name}"
        );
    }
}

/// The scene's text with every place and size multiplied; directions, angles and colours stay.
fn scale(text: &str, factor: f64) -> String {
    let mut document = Document::new(Format::Ray, text.to_owned());
    let origins = lower(text, document.tree()).origins;
    let mut edits = Vec::new();
    for placed in origins
        .nodes()
        .into_iter()
        .flat_map(|node| origins.fields(document.tree(), node))
    {
        let is_size = placed.field.kind == Kind::Number && placed.field.allowed == Range::Positive;
        if placed.field.kind == Kind::Point || is_size {
            for span in placed.spans {
                let value = parse_number(span.of(text)).expect("the scene has no errors");
                edits.push(Edit {
                    span,
                    text: format!("{:e}", factor * value),
                });
            }
        }
    }
    edits.sort_by_key(|edit| edit.span);
    document.edit(&edits);
    document.text().to_owned()
}

fn trace(scene: &Arc<Scene>, size: Size, spp: u32) -> Arc<Frame> {
    let (wake, woken) = mpsc::channel();
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let renderer = Renderer::new(Threads::Exactly(threads), move || {
        let _ = wake.send(());
    });
    let settings = Settings {
        size,
        spp,
        depth: DEFAULT_DEPTH,
        seed: 0,
    };
    let job = Job {
        scene: Arc::clone(scene),
        images: Images::default(),
        camera: scene.camera,
        settings,
        frames: Frames::Last,
    };
    renderer.restart(job).expect("the worker runs");
    loop {
        woken.recv().expect("the worker runs");
        if let Some(frame) = renderer.latest().filter(|frame| frame.progress.complete) {
            return frame;
        }
    }
}

fn meaning(text: &str) -> Arc<Scene> {
    let lowered = lower(text, &format::parse(Format::Ray, text));
    Arc::new(
        lowered
            .scene
            .unwrap_or_else(|| panic!("{:?}", lowered.diagnostics)),
    )
}

fn scenes() -> Vec<PathBuf> {
    let entries = std::fs::read_dir(root().join("scenes")).expect("the scenes are there");
    let mut paths: Vec<_> = entries
        .map(|entry| entry.expect("a scene").path())
        .collect();
    paths.retain(|path| Format::of_path(path).is_ok());
    paths.sort();
    assert!(5 < paths.len());
    paths
}

fn read(path: &Path) -> String {
    std::fs::read_to_string(path).expect("scenes are readable")
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}
