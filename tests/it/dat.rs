//! A `.dat` scene that uses all features, from text to pixels.

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::sync::{Arc, mpsc};

use halflight::language::{Language, Source};
use halflight::render::{Frame, Frames, Job, Renderer, Settings, Threads};
use halflight::scene::{Image, Images, Meshes, Rendering, Scene, Size};

/// A scene with all lengths multiplied by `s`; squares of lengths and values in reciprocal units
/// are scaled accordingly.
fn everything(s: f64, camera: &str) -> String {
    let lengths = |numbers: &[f64]| -> String {
        let scaled: Vec<_> = numbers.iter().map(|x| format!("{:e}", s * x)).collect();
        scaled.join(" ")
    };
    let (inverse, inverse_square, square) = (1.0 / s, 1.0 / (s * s), s * s);
    [
        format!(
            "camera {camera} {}  {}  0 0 1  {}",
            lengths(&[1.0, -9.0, 5.0]),
            lengths(&[0.0, 0.0, 0.5]),
            lengths(&[3.0, 2.0, 40.0])
        ),
        format!(
            "resolution {}",
            lengths(&if camera == "perspective" {
                [0.06, 0.06]
            } else {
                [0.2, 0.2]
            })
        ),
        "viewport 48 36".to_owned(),
        "light ID 0 amb 0 0 0  0 0 0  .3 .3 .3  1 0 0  0 shadow_on".to_owned(),
        format!(
            "light ID 1 pnt {}  -4 3 -7  .9 .8 .7  .2 {:e} {:e}  2 shadow_on",
            lengths(&[4.0, -3.0, 7.0]),
            0.05 * inverse,
            0.01 * inverse_square
        ),
        format!(
            "light ID 2 inf {}  1 1 -2  .4 .4 .5  1 0 0  0 shadow_off",
            lengths(&[0.0, 0.0, 1.0])
        ),
        "mat ID 0  .9 .8 .6  .2 .7 .2 10  0 .2 0".to_owned(),
        "mat ID 1  .5 .8 .9  .1 .2 .6 60  .7 .1 1.5".to_owned(),
        "mat ID 2  1 1 1  .3 .6 0 1  0 0 0".to_owned(),
        "texture ID 0 checker 6 6  1 1 1  .3 .3 .4".to_owned(),
        "texture ID 1 image 3 2 waves.png".to_owned(),
        "use colour ID 0 mat ID 2".to_owned(),
        "use colour ID 1 mat ID 0".to_owned(),
        format!("use bump ID 1 mat ID 0 {}", lengths(&[0.125])),
        format!(
            "obj box ID 0 mat ID 2 {}  1 0 0 0 1 0 0 0 1 {}",
            lengths(&[0., 0., -1.5]),
            lengths(&[12., 12., 1.])
        ),
        format!("obj sphere ID 1 mat ID 1 {}", lengths(&[-2., -1., 0., 1.])),
        format!(
            "obj ellipsoid ID 2 mat ID 0 {}",
            lengths(&[2., 1., 0., 1., 1.5, 1.])
        ),
        format!(
            "obj cylinder ID 3 mat ID 0 {} 0.6 0 0.8 {}",
            lengths(&[0., 2., 1.]),
            lengths(&[0.5, 3.])
        ),
        format!(
            "obj quadric ID 4 mat ID 1  1 0 0 0 1 0 0 -1 0 {:e}  2  0 0 1 {}  0 0 -1 {}",
            -0.0625 * square,
            lengths(&[1.0]),
            lengths(&[1.0])
        ),
        format!(
            "obj box ID 5 mat ID 0 {}  1 0 0 0 1 0 0 0 1 {}",
            lengths(&[2., -2., 0.]),
            lengths(&[1.5, 1.5, 1.5])
        ),
        format!(
            "obj sphere ID 6 mat ID 2 {}",
            lengths(&[2., -2.5, 0.5, 0.75])
        ),
        "obj CSG ID 7 difference ID 5 ID 6".to_owned(),
    ]
    .join("\n")
}

fn meaning(text: &str) -> Arc<Scene> {
    let lowered = Source::new(Language::Dat, Arc::new(text.to_owned()))
        .lower(&Meshes::default())
        .expect("there is memory");
    let said = &lowered.diagnostics;
    assert!(
        said.iter()
            .all(|diagnostic| diagnostic.message.contains("has length")),
        "{said:?}"
    );
    Arc::new(lowered.scene.expect("there are no errors"))
}

fn trace(scene: &Arc<Scene>, threads: usize) -> Arc<Frame> {
    let pixels =
        (0..64_u32).map(|at| [4 * at, 255 - 3 * at, 37 * at % 251].map(|level| level as u8));
    let size = Size {
        width: 8,
        height: 8,
    };
    let image = Image::new(size, pixels.collect()).expect("there are as many pixels");
    let images: Images = [("waves.png".to_owned(), Arc::new(image))]
        .into_iter()
        .collect();
    let (wake, woken) = mpsc::channel();
    let mut renderer = Renderer::new(Threads::Exactly(threads), move || {
        let _ = wake.send(());
    });
    renderer
        .restart(Job {
            scene: Arc::clone(scene),
            images,
            camera: scene.camera,
            settings: Settings {
                spp: 2,
                ..Settings::new(scene.camera.size, &Rendering::default())
            },
            limit: None,
            frames: Frames::Last,
            denoise: false,
            numbers: None,
        })
        .expect("there is memory");
    loop {
        woken.recv().expect("the worker runs");
        if let Some(frame) = renderer.latest().filter(|frame| frame.progress.complete) {
            return frame;
        }
    }
}

/// Nothing has an absolute size: a scene scaled by 2ᵏ gives the same picture, bit for bit.
#[test]
fn scaled_scenes_give_the_same_picture() {
    for camera in ["perspective", "orthographic"] {
        let plain = trace(&meaning(&everything(1.0, camera)), 1);
        let colours: BTreeSet<_> = plain.pixels.iter().collect();
        assert!(200 < colours.len(), "{camera}: {} colours", colours.len());
        for exponent in [-40, -7, -1, 1, 7, 40] {
            let scene = meaning(&everything(2_f64.powi(exponent), camera));
            let scaled = trace(&scene, 2);
            assert!(
                plain.pixels == scaled.pixels,
                "{camera} × 2^{exponent}: {} pixels differ",
                plain
                    .pixels
                    .iter()
                    .zip(&scaled.pixels)
                    .filter(|(a, b)| a != b)
                    .count()
            );
        }
    }
}

/// The course's files, compared with an independent line reader.
#[test]
fn the_courses_own_files_are_read_completely() {
    let Some(folder) = std::env::var_os("HALFLIGHT_EXTRA_SCENES").map(PathBuf::from) else {
        println!("HALFLIGHT_EXTRA_SCENES names no folder: the course's files are not tested");
        return;
    };
    for name in ["model1", "model2", "model3", "simple", "sphereTest"] {
        let path = folder.join("bu").join(name).with_extension("dat");
        let text = std::fs::read_to_string(path).expect("the course's files are there");
        let lowered = Source::new(Language::Dat, Arc::new(text.clone()))
            .lower(&Meshes::default())
            .expect("there is memory");
        let said = &lowered.diagnostics;
        let scene = lowered.scene.unwrap_or_else(|| panic!("{name}: {said:?}"));
        let lines: Vec<Vec<&str>> = text
            .lines()
            .map(|line| line.split_whitespace().collect())
            .collect();
        let begin = |word: &str| {
            lines
                .iter()
                .filter(|line| line.first() == Some(&word))
                .count()
        };
        let operands: BTreeSet<_> = lines
            .iter()
            .filter(|line| line.get(1) == Some(&"CSG"))
            .flat_map(|line| [line[6], line[8]])
            .collect();
        assert_eq!(scene.lights.len(), begin("light"), "{name}");
        assert_eq!(scene.materials.len(), begin("mat"), "{name}");
        let render = lines.iter().find(|line| line.first() == Some(&"render"));
        let listed = render.map_or(0, |line| (line.len() - 2) / 2);
        let drawn = if 0 < listed {
            listed
        } else {
            begin("obj") - operands.len()
        };
        assert_eq!(scene.objects.len(), drawn, "{name}");
        let viewport = lines.iter().find(|line| line.first() == Some(&"viewport"));
        let size = [scene.camera.size.width, scene.camera.size.height].map(|n| n.to_string());
        assert_eq!(
            viewport.map(|line| &line[1..]),
            Some(&size.each_ref().map(|n| &n[..])[..])
        );
    }
}
