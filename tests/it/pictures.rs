//! The sample scenes and their pictures.

use std::path::{Path, PathBuf};
use std::sync::{Arc, mpsc};

use halflight::assets::{Assets, Loaded, Wanted};
use halflight::document::Document;
use halflight::image_file::{ImageFormat, Picture};
use halflight::language::schema::{Field, Kind, Range};
use halflight::language::{Language, Lowered, NamedFile, Node, Source};
use halflight::render::{Frame, Frames, Job, Renderer, Settings, Threads};
use halflight::scene::{Images, Integrator, Meshes, Rendering, Scene, Size};
use halflight::text::{Edit, parse_number};

/// Size of the pictures beside the scenes and their samples per pixel, as in `scenes/README.md`.
const SIZE: Size = Size {
    width: 320,
    height: 240,
};
const SPP: u32 = 8;

/// Samples per pixel of path-traced pictures of scenes that do not state them.
const PATH_SPP: u32 = 64;

#[test]
fn the_pictures_beside_the_scenes_match_the_renderer() {
    for own in scenes() {
        let (scene, images) = own.meaning();
        let rendering = scene.setting.rendering;
        let spp = match rendering.integrator() {
            Integrator::Whitted => SPP,
            Integrator::Path | Integrator::Photon => PATH_SPP,
        };
        let frame = trace(&scene, images, SIZE, rendering.spp.unwrap_or(spp));
        let mut bytes = Vec::new();
        ImageFormat::Bmp
            .write(Picture::of(&frame), &mut bytes)
            .expect("memory takes any picture");
        let expected =
            std::fs::read(own.path.with_extension("bmp")).expect("every scene has a picture");
        let name = own.path.display();
        assert!(bytes == expected, "{name}: the picture is another");
    }
}

/// The tracer has no absolute sizes: a scene scaled by 2ᵏ gives the same picture, bit for bit.
#[test]
fn scaled_scenes_give_the_same_picture() {
    let size = Size {
        width: 48,
        height: 36,
    };
    // The transforms of `.test` are no fields that could be scaled.
    let scenes = scenes()
        .into_iter()
        .filter(|own| own.language != Language::Cse167);
    for own in scenes {
        let (scene, images) = own.meaning();
        let plain = trace(&scene, images, size, 1);
        for exponent in [-40, -20, -7, -1, 1, 7, 20, 40] {
            let (scene, images) = own.scaled(exponent).meaning();
            let scaled = trace(&scene, images, size, 1);
            let name = own.path.display();
            assert!(plain.pixels == scaled.pixels, "{name} × 2^{exponent}");
        }
    }
}

/// The example as copied from the course's page, with no-break spaces, is the same scene.
#[test]
fn the_courses_own_copies_mean_the_same() {
    let Some(folder) = std::env::var_os("HALFLIGHT_EXTRA_SCENES").map(PathBuf::from) else {
        println!("HALFLIGHT_EXTRA_SCENES names no folder: the course's files are not tested");
        return;
    };
    let own = Own::read(root().join("scenes/example.ray")).meaning().0;
    for name in ["example.ray", "example-from-page.ray"] {
        let theirs = Own::read(folder.join("rice").join(name)).meaning().0;
        assert_eq!(theirs, own, "{name}");
    }
}

/// One of the sample scenes.
struct Own {
    path: PathBuf,
    language: Language,
    text: String,
}

impl Own {
    fn read(path: PathBuf) -> Self {
        Self {
            language: Language::of_path(&path).expect("a scene"),
            text: std::fs::read_to_string(&path).expect("scenes are readable"),
            path,
        }
    }

    /// The scene and the pictures of its textures.
    fn meaning(&self) -> (Arc<Scene>, Images) {
        let mut source = Source::new(self.language, Arc::new(self.text.clone()));
        let mut lower = |loaded: &Loaded| -> (Lowered, Vec<NamedFile>) {
            let lowered = source.lower(&loaded.meshes).expect("there is memory");
            (lowered, source.files())
        };
        let mut assets = Assets::new(&[]);
        // The files that meshes name are known once the meshes are read.
        let mut loaded = Loaded::default();
        let (mut lowered, mut files) = lower(&loaded);
        for _ in 0..2 {
            loaded = assets.read(&Wanted::new(&self.path, &files));
            assert!(
                loaded.picture_errors.is_empty(),
                "{:?}",
                loaded.picture_errors
            );
            (lowered, files) = lower(&loaded);
        }
        assert_eq!(*lowered.diagnostics, [], "{}", self.path.display());
        let scene = lowered.scene.expect("there are no errors");
        (Arc::new(scene), loaded.images)
    }

    /// The same scene, scaled by 2 to this power.
    fn scaled(&self, exponent: i32) -> Self {
        let mut document = Document::new(self.language, self.text.clone());
        let lowered = document.lower(&Meshes::default()).expect("there is memory");
        let source = document.source();
        let is_xml = self.language == Language::Xml;
        // Under path tracing, the intensity of a light scales with its surface area.
        let integrator = lowered
            .scene
            .map(|scene| scene.setting.rendering.integrator());
        let shines = integrator.is_some_and(Integrator::traces_paths);
        let mut edits = Vec::new();
        for node in source.nodes().iter() {
            if is_xml && matches!(node, Node::Object(_)) {
                continue;
            }
            // Texture transforms are in texture space.
            let is_map = |key| is_xml && matches!(node, Node::Material(_)) && key != "absorption";
            for placed in source.fields(node) {
                if is_map(placed.field.key) {
                    continue;
                }
                for (component, &span) in placed.spans.iter().enumerate() {
                    let power = match placed.field.key {
                        "intensity" if shines => 2 * i32::from(component < 3),
                        _ => length_power(placed.field, component),
                    };
                    if power != 0 && placed.default_of(component).is_none() {
                        let value = parse_number(span.of(&self.text)).expect("no errors");
                        let text = format!("{:e}", value * 2f64.powi(exponent * power));
                        edits.push(Edit { span, text });
                    }
                }
            }
        }
        edits.sort_by_key(|edit| edit.span);
        edits.dedup();
        document.edit(&edits);
        let text = document.text();
        Self {
            text: if is_xml {
                with_scaled_objects(text, 2f64.powi(exponent))
            } else {
                text.to_owned()
            },
            path: self.path.clone(),
            language: self.language,
        }
    }
}

/// Scales the outermost objects of a `.xml` scene, as their last transform.
fn with_scaled_objects(text: &str, factor: f64) -> String {
    let scale = format!("<scale value='{factor:e}'/>");
    let mut scaled = String::new();
    let mut depth = 0;
    for part in text.split_inclusive('>') {
        if part.contains("</object") {
            depth -= 1;
            if depth == 0 {
                scaled += &scale;
            }
        } else if part.contains("<object") {
            assert!(0 < depth || !part.ends_with("/>"), "{part}");
            depth += i32::from(!part.ends_with("/>"));
        }
        scaled += part;
    }
    scaled
}

/// The power of the scene's size by which a number scales; 0 for directions, angles and colours.
fn length_power(field: &Field, component: usize) -> i32 {
    match (field.kind, field.key) {
        (Kind::Point, _)
        | (Kind::Number, "near" | "far" | "height" | "D" | "G" | "I" | "size" | "dof") => 1,
        (Kind::Number, "J") => 2,
        (Kind::Number, "a1" | "attenuation") => -1,
        (_, "absorption") => -i32::from(component < 3),
        (Kind::Number, "a2") => -2,
        // Numbers in units of the axes.
        (Kind::Number, _) => i32::from(matches!(field.allowed, Range::Positive | Range::Size)),
        (Kind::Pair, key) => i32::from(key == "resolution"),
        (Kind::HalfSpace | Kind::ScaledVector, _) => i32::from(component == 3),
        _ => 0,
    }
}

fn trace(scene: &Arc<Scene>, images: Images, size: Size, spp: u32) -> Arc<Frame> {
    let (wake, woken) = mpsc::channel();
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let mut renderer = Renderer::new(Threads::Exactly(threads), move || {
        let _ = wake.send(());
    });
    let asked = Rendering {
        spp: Some(spp),
        ..scene.setting.rendering
    };
    let settings = Settings::new(size, &asked);
    let job = Job {
        scene: Arc::clone(scene),
        images,
        camera: scene.camera,
        settings,
        limit: None,
        frames: Frames::Last,
        denoise: false,
        numbers: None,
    };
    renderer.restart(job).expect("the worker runs");
    loop {
        woken.recv().expect("the worker runs");
        if let Some(frame) = renderer.latest().filter(|frame| frame.progress.complete) {
            return frame;
        }
    }
}

fn scenes() -> Vec<Own> {
    let entries = std::fs::read_dir(root().join("scenes")).expect("the scenes are there");
    let mut paths: Vec<_> = entries
        .map(|entry| entry.expect("a scene").path())
        .collect();
    paths.retain(|path| Language::of_path(path).is_ok());
    paths.sort();
    assert!(7 < paths.len());
    paths.into_iter().map(Own::read).collect()
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}
