//! Every sample scene in every other language: where nothing is reported lost, the pictures are
//! the same.

mod random;

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Arc, mpsc};

use halflight::assets::Assets;
use halflight::language::{self, Converted, Language, Source};
use halflight::render::{Frame, Frames, Job, Renderer, Settings, Threads};
use halflight::scene::{Images, Rendering, Scene, Size};
use halflight::text::Findings;

/// The largest side of a picture.
const MOST: u32 = 64;

#[test]
fn what_loses_nothing_looks_the_same() {
    for path in scenes() {
        let text = fs::read_to_string(&path).expect("scenes are readable");
        convert(&path, &text);
    }
}

#[test]
fn matte_scenes_lose_nothing() {
    for (name, text) in [
        ("solids.ray", SOLIDS_RAY),
        ("balls.ray", BALLS_RAY),
        ("solids.dat", SOLIDS_DAT),
        ("matte.xml", MATTE_XML),
    ] {
        for (to, losses) in convert(Path::new(name), text) {
            let has_few_solids = [Language::Xml, Language::Cse167].contains(&to);
            let is_lossy = name.starts_with("solids") && has_few_solids;
            assert_eq!(
                losses.is_empty(),
                !is_lossy,
                "{name} to {to:?}: {losses:#?}"
            );
        }
    }
}

/// Solids that `.dat` has, with highlights, mirrors and glass.
const SOLIDS_RAY: &str = "\
// view: eye 3 2.5 7.3 target 0.1 0 0 up 0 1 0.1 fov 41.7 size 61 47
0.2 0.25 0.3
2 6 8 5 0.9 0.8 0.7 -5 3 4 0.3 0.3 0.4
5
box -3 -2 -3  1 0 0 0 1 0 0 0 1  6 1 6  0.1 0.1 0.1 0.5 0.5 0.5 0.2 0.2 0.2 12 0.1 0 1
sphere 0 0.1 0 1.1  0.03 0.02 0.01 0.6 0.4 0.2 0 0 0 1 0.2 0 1
ellipsoid -1.5 0 1  1 0 0 0 1 0 0 0 1  0.4 0.7 0.3  0.02 0.12 0.06 0.1 0.6 0.3 0 0 0 1 0 0 1
cylinder 1.5 -1 1  1 0 0 0 1 0 0 0 1  0.5 0.5 0.75  0.1 0.2 0.3 0.2 0.4 0.6 0.25 0.5 0.75 30 0 0 1
sphere 0.5 0 2 0.5  0.1 0.1 0.1 0.1 0.1 0.1 0.9 0.9 0.9 80 0.1 0.8 1.4
";

/// Matte balls, which every language has.
const BALLS_RAY: &str = "\
// view: eye 3 2.5 7.3 target 0.1 0 0 fov 41.7 size 61 47
0.2 0.25 0.3
2 6 8 5 0.9 0.8 0.7 -5 3 4 0.3 0.3 0.4
3
sphere 0 -101 0 100  0.5 0.5 0.6 0.5 0.5 0.6 0 0 0 1 0 0 1
sphere 0 0.1 0 1.1  0.6 0.4 0.2 0.6 0.4 0.2 0 0 0 1 0 0 1
ellipsoid -1.5 0 1  1 0 0 0 1 0 0 0 1  0.4 0.7 0.3  0.1 0.6 0.3 0.1 0.6 0.3 0 0 0 1 0 0 1
";

/// Solids in any direction, with lights that `.ray` has.
const SOLIDS_DAT: &str = "\
camera perspective 3 -7 3  -3 7 -2.2  0 0 1  1 0 100
resolution 0.015 0.015
viewport 61 47
light ID 1 pnt 6 -5 8  0 0 0  0.85 0.75 0.6  1 0 0  0 shadow_on
light ID 2 amb 0 0 0  0 0 0  0.5 0.55 0.65  1 0 0  0 shadow_off
mat ID 1  0.6 0.63 0.7  0.3 0.7 0.2 20  0 0.12 1
mat ID 2  0.95 0.36 0.2  0.2 0.8 0.6 60  0.4 0.1 1.3
obj box ID 1 mat ID 1  0 0 -0.6  1 0 0  0 1 0  0 0 1  6 6 1
obj sphere ID 2 mat ID 2  0 0 1  1
obj ellipsoid ID 3 mat ID 2  -2 0 0.5  0.7 0.5 0.6
obj cylinder ID 4 mat ID 1  1.5 -1 0.3  1 2 3  0.3 0.8
obj box ID 5 mat ID 2  -1 -1.5 0.3  0.6 0.8 0  -0.8 0.6 0  0 0 1  0.3 0.4 0.7
";

/// Matte balls, and one that only glows.
const MATTE_XML: &str = "\
<xml><scene>
  <object type='sphere' name='a' material='m'><scale value='1.3'/><translate x='0.1' y='0.2'/></object>
  <object type='sphere' material='n'><scale x='0.5' y='0.7' z='0.3'/><translate x='-1.5' z='1'/></object>
  <material name='m' type='blinn'><diffuse r='0.5' g='0.4' b='0.3'/><specular value='0'/></material>
  <material name='n' type='phong'><diffuse r='0.1' g='0.4' b='0.3'/><specular value='0'/></material>
  <light type='ambient'><intensity value='0.2'/></light>
  <light type='point'><intensity value='0.7'/><position x='3' y='5' z='4'/></light>
</scene><camera><position x='1' y='2' z='7'/><target/><fov value='33.3'/>
<width value='61'/><height value='47'/></camera></xml>
";

/// Converts a scene to the other languages and compares small pictures where nothing is lost.
/// Returns the losses of each.
fn convert(path: &Path, text: &str) -> Vec<(Language, Findings)> {
    let name = path.display();
    let language = Language::of_path(path).expect("a scene");
    let (source, scene, images) = read(path, language, text.to_owned());
    let others = Language::ALL.into_iter().filter(|to| *to != language);
    let converted = others.map(|to| {
        let Converted { text, losses } =
            language::convert(&source, &scene, to).expect("there is memory");
        assert_eq!(losses.errors(), 0, "{name} to {to:?}: {losses:?}");
        for loss in losses.iter() {
            assert!(loss.hint.is_some(), "{name} to {to:?}: {loss:?}");
            assert!(loss.span.end() <= source.text().len());
        }
        let path = path.with_extension(to.extension());
        let (_, other, others) = read(&path, to, text.to_string());
        if losses.is_empty() {
            let [a, b] = [trace(&scene, images.clone()), trace(&other, others)];
            assert!(a.pixels == b.pixels, "{name} to {to:?}:\n{text}");
        }
        (to, losses)
    });
    converted.collect()
}

fn read(path: &Path, language: Language, text: String) -> (Source, Arc<Scene>, Images) {
    let mut source = Source::new(language, Arc::new(text));
    let read = Assets::new(&[]).lower(path, &mut source);
    let (lowered, loaded) = read.expect("there is memory");
    let scene = lowered.scene.unwrap_or_else(|| {
        let said = &lowered.diagnostics;
        panic!("{}: {said:#?}\n{}", path.display(), source.text())
    });
    (source, Arc::new(scene), loaded.images)
}

/// A small picture by the scene's own settings.
fn trace(scene: &Arc<Scene>, images: Images) -> Arc<Frame> {
    let Size { width, height } = scene.camera.size;
    let step = width.max(height).div_ceil(MOST);
    let settings = Settings {
        spp: 1,
        depth: scene.setting.rendering.integrator().default_depth(),
        integrator: scene.setting.rendering.integrator(),
        transfer: scene.setting.rendering.transfer(),
        ..Settings::new(
            Size {
                width: width.div_ceil(step),
                height: height.div_ceil(step),
            },
            &Rendering::default(),
        )
    };
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
    let (wake, woken) = mpsc::channel();
    let mut renderer = Renderer::new(Threads::Exactly(2), move || {
        let _ = wake.send(());
    });
    renderer.restart(job).expect("the worker runs");
    loop {
        woken.recv().expect("the worker runs");
        if let Some(frame) = renderer.latest().filter(|frame| frame.progress.complete) {
            return frame;
        }
    }
}

/// Our scenes, and the course's if their folder is given.
fn scenes() -> Vec<PathBuf> {
    let mut folders = vec![Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes")];
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
