//! `.xml` scenes from their text to their pixels, and the course's own files.

use std::path::PathBuf;
use std::sync::{Arc, mpsc};

use halflight::format::{self, Format};
use halflight::render::{DEFAULT_DEPTH, Filter, Frames, Job, Renderer, Settings, Threads};
use halflight::scene::fields::Kind;
use halflight::scene::{Images, Integrator, Lowered, Node, Placed, Scene, Transfer, lower};
use halflight::text::{Diagnostic, apply};

const EXAMPLE: &str = include_str!("../scenes/spheres.xml");

fn read(text: &str) -> (format::Tree, Lowered) {
    let tree = format::parse(Format::Xml, text);
    let lowered = lower(text, &tree);
    (tree, lowered)
}

/// Whether the ray through the centre of a pixel meets a sphere of the example; `None` where that
/// is too close to call.
fn covers(i: f64, j: f64, size: [f64; 2]) -> Option<bool> {
    let half = (20.0_f64).to_radians().tan();
    let x = half * (size[0] / size[1]) * (2.0 * (i + 0.5) / size[0] - 1.0);
    let z = half * (1.0 - 2.0 * (j + 0.5) / size[1]);
    let spheres = [
        ([0.0, 50.0, -25.0], 25.0),
        ([0.0, 50.0, 5.1], 5.0),
        ([0.0, 50.0, 11.1], 1.0),
    ];
    let mut meets = false;
    for (centre, radius) in spheres {
        let [cx, cy, cz]: [f64; 3] = centre;
        let along = (cy + x * cx + z * cz) / (1.0 + x * x + z * z).sqrt();
        let off = cx * cx + cy * cy + cz * cz - along * along - radius * radius;
        if off.abs() < 1e-9 {
            return None;
        }
        meets |= off < 0.0;
    }
    Some(meets)
}

/// The first project of the course: every pixel of a sphere is white, every other black.
#[test]
fn the_example_is_white_on_black() {
    let scene = Arc::new(read(EXAMPLE).1.scene.expect("there are no errors"));
    let (wake, woken) = mpsc::channel();
    let renderer = Renderer::new(Threads::Exactly(2), move || {
        let _ = wake.send(());
    });
    let job = Job {
        images: Images::default(),
        camera: scene.camera,
        settings: Settings {
            size: scene.camera.size,
            spp: 1,
            depth: DEFAULT_DEPTH,
            seed: 0,
            aov: None,
            integrator: Integrator::Whitted,
            filter: Filter::Box,
            transfer: Transfer::default(),
        },
        scene,
        frames: Frames::Last,
    };
    renderer.restart(job).expect("the worker runs");
    let frame = loop {
        woken.recv().expect("the worker runs");
        if let Some(frame) = renderer.latest().filter(|frame| frame.progress.complete) {
            break frame;
        }
    };
    let mut white = 0;
    for (at, pixel) in frame.pixels.iter().enumerate() {
        let (i, j) = (at % 800, at / 800);
        let Some(meets) = covers(i as f64, j as f64, [800.0, 600.0]) else {
            continue;
        };
        let expected = if meets { [255; 3] } else { [0; 3] };
        assert_eq!(*pixel, expected, "{i} {j}");
        white += u32::from(meets);
    }
    assert!(50_000 < white, "{white} pixels");
}

/// What the files of the course say is understood, and edits of every field leave all else alone.
#[test]
fn the_course_s_own_files_are_read_listed_and_edited() {
    let Some(folder) = std::env::var_os("HALFLIGHT_EXTRA_SCENES").map(PathBuf::from) else {
        println!("HALFLIGHT_EXTRA_SCENES names no folder: the course's files are not tested");
        return;
    };
    let entries = std::fs::read_dir(folder.join("utah")).expect("the folder holds the course's");
    let paths = entries.map(|entry| entry.expect("a file").path());
    let mut scenes = 0;
    for path in paths.filter(|path| path.extension().is_some_and(|extension| extension == "xml")) {
        let name = path.display().to_string();
        let text = std::fs::read_to_string(&path).expect("scenes are readable");
        let (tree, lowered) = read(&text);
        let said: Vec<_> = lowered
            .diagnostics
            .iter()
            .map(|found| &found.message)
            .collect();
        let scene: Scene = lowered.scene.unwrap_or_else(|| panic!("{name}: {said:?}"));
        let known = |found: &Diagnostic| found.message.ends_with("not traced yet");
        assert!(lowered.diagnostics.iter().all(known), "{name}: {said:?}");
        let objects = text.matches("<object").count();
        let nodes = lowered.origins.nodes();
        let listed = nodes
            .iter()
            .filter(|node| matches!(node, Node::Object(_)))
            .count();
        assert_eq!(listed, objects, "{name}");
        let meshes = text.matches("type=\"obj\"").count();
        let groups = text.matches("<object name").count();
        assert_eq!(scene.objects.len(), objects - meshes - groups, "{name}");
        for node in nodes {
            // Another type has other fields.
            let is_free = |placed: &Placed| !matches!(placed.field.kind, Kind::Choice(_));
            for placed in lowered
                .origins
                .fields(&tree, node)
                .into_iter()
                .filter(is_free)
            {
                for component in 0..placed.spans.len() {
                    let edits = placed.edits(&text, &tree, &[(component, "7".to_owned())]);
                    let mut edited = text.clone();
                    let undo = apply(&mut edited, &edits);
                    let (tree, after) = read(&edited);
                    let fields = after.origins.fields(&tree, node);
                    let says = |at: usize| {
                        let field = fields
                            .iter()
                            .filter(|other| other.field.key == placed.field.key);
                        field.clone().any(|field| {
                            field
                                .spans
                                .get(at)
                                .is_some_and(|span| span.of(&edited) == "7")
                        })
                    };
                    assert!(
                        says(component),
                        "{name} {node:?} {} {component}",
                        placed.field.key
                    );
                    apply(&mut edited, &undo);
                    assert_eq!(edited, text, "{name}");
                }
            }
        }
        scenes += 1;
    }
    assert!(10 < scenes, "{scenes} files");
}
