//! `.xml` scenes from text to pixels, including the files they name and the course's own scenes.

use std::fs;
use std::path::PathBuf;
use std::process::Command;
use std::sync::{Arc, mpsc};

use halflight::assets::{Assets, Wanted};
use halflight::language::schema::Kind;
use halflight::language::{FieldSpans, Language, Lowered, Node, Source};
use halflight::render::{Frames, Job, Renderer, Settings, Threads};
use halflight::scene::{Images, Meshes, Rendering, Scene};
use halflight::text::apply;
use tempfile::TempDir;

const EXAMPLE: &str = include_str!("../../scenes/spheres.xml");

fn read(text: &str) -> (Source, Lowered) {
    let mut source = Source::new(Language::Xml, Arc::new(text.to_owned()));
    let lowered = source.lower(&Meshes::default()).expect("there is memory");
    (source, lowered)
}

/// Whether the ray through the centre of a pixel intersects a sphere of the example; `None` if it
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
    let mut renderer = Renderer::new(Threads::Exactly(2), move || {
        let _ = wake.send(());
    });
    let job = Job {
        images: Images::default(),
        camera: scene.camera,
        settings: Settings {
            spp: 1,
            ..Settings::new(scene.camera.size, &Rendering::default())
        },
        scene,
        limit: None,
        frames: Frames::Last,
        denoise: false,
        numbers: None,
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

/// The course's files are fully understood, and an edit of any field changes nothing else.
#[test]
fn the_courses_own_files_are_read_listed_and_edited() {
    let Some(folder) = std::env::var_os("HALFLIGHT_EXTRA_SCENES").map(PathBuf::from) else {
        println!("HALFLIGHT_EXTRA_SCENES names no folder: the course's files are not tested");
        return;
    };
    let entries = fs::read_dir(folder.join("utah")).expect("the folder holds the course's");
    let paths = entries.map(|entry| entry.expect("a file").path());
    let mut scenes = 0;
    for path in paths.filter(|path| path.extension().is_some_and(|extension| extension == "xml")) {
        let name = path.display().to_string();
        let text = fs::read_to_string(&path).expect("scenes are readable");
        let (mut source, _) = read(&text);
        let files = source.files();
        let loaded = Assets::new(&[]).read(&Wanted::new(&path, &files));
        assert!(
            loaded.picture_errors.is_empty(),
            "{name}: {:?}",
            loaded.picture_errors
        );
        let lowered = source.lower(&loaded.meshes).expect("there is memory");
        let said: Vec<_> = lowered
            .diagnostics
            .iter()
            .map(|found| &found.message)
            .collect();
        let scene: Scene = lowered.scene.unwrap_or_else(|| panic!("{name}: {said:?}"));
        assert!(said.is_empty(), "{name}: {said:?}");
        let objects = text.matches("<object").count();
        let nodes = source.nodes();
        let listed = nodes
            .iter()
            .filter(|node| matches!(node, Node::Object(_)))
            .count();
        assert_eq!(listed, objects, "{name}");
        let groups = text.matches("<object name").count();
        assert_eq!(scene.objects.len(), objects - groups, "{name}");
        for node in nodes.iter() {
            // Another type has other fields.
            let is_free = |placed: &FieldSpans| !matches!(placed.field.kind, Kind::Choice(_));
            for placed in source.fields(node).into_iter().filter(is_free) {
                for component in 0..placed.spans.len() {
                    let edits = placed.edits(&*source, &[(component, "7".to_owned())]);
                    let mut edited = text.clone();
                    let undo = apply(&mut edited, &edits);
                    let (after, _) = read(&edited);
                    let fields = after.fields(node);
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

/// A triangle from a file that fills the middle of the picture, lit only by ambient light.
const MESHED: &str = "<xml><scene><light type='ambient'><intensity value='1'/></light>
  <object type='obj' name='meshes/a.obj'/></scene>
  <camera><position z='5'/><target/><width value='40'/><height value='30'/></camera></xml>";

const MESH: &str = "mtllib ../skins/a.mtl\nv -3 -3 0\nv 3 -3 0\nv 0 3 0\nusemtl a\nf 1 2 3\n";

/// A directory with a scene in `a.xml`, and its mesh and the mesh's library in separate folders.
struct Place {
    directory: TempDir,
}

impl Place {
    fn new(library: &str) -> Self {
        let directory = tempfile::tempdir_in(env!("CARGO_TARGET_TMPDIR")).expect("a directory");
        let place = Self { directory };
        for folder in ["meshes", "skins"] {
            fs::create_dir(place.at(folder)).expect("a folder");
        }
        place.write("a.xml", MESHED);
        place.write("meshes/a.obj", MESH);
        place.write("skins/a.mtl", library);
        place
    }

    fn at(&self, name: &str) -> PathBuf {
        self.directory.path().join(name)
    }

    fn write(&self, name: &str, content: &str) {
        fs::write(self.at(name), content).expect("written");
    }

    /// Runs the program, asserts its exit code, and returns its standard error.
    fn stderr(&self, line: &str, code: i32) -> String {
        let output = Command::new(env!("CARGO_BIN_EXE_halflight"))
            .args(line.split_ascii_whitespace())
            .current_dir(self.directory.path())
            .output()
            .expect("it starts");
        let stderr = String::from_utf8(output.stderr).expect("UTF-8");
        assert_eq!(output.status.code(), Some(code), "{line}: {stderr}");
        stderr
    }

    /// The colour in the middle of `a.ppm`.
    fn middle(&self) -> [u8; 3] {
        let ppm = fs::read(self.at("a.ppm")).expect("a picture");
        let pixels = ppm.strip_prefix(b"P6\n40 30\n255\n").expect("a PPM");
        let middle = 3 * (15 * 40 + 20);
        [0, 1, 2].map(|channel| pixels[middle + channel])
    }
}

#[test]
fn a_mesh_is_drawn_in_the_colours_of_its_library() {
    let place = Place::new("newmtl a\nKd 0 .2 1\n");
    assert_eq!(place.stderr("render a.xml -o a.ppm --spp 1", 0), "");
    assert_eq!(place.middle(), [0, 51, 255]);
    let stderr = place.stderr("check a.xml", 0);
    assert_eq!(stderr, "1 scene checked: 0 errors, 0 warnings\n");

    place.write("skins/a.mtl", "newmtl b\n");
    let stderr = place.stderr("render a.xml -o a.ppm --spp 1", 0);
    let first = "warning: meshes/a.obj:5:8: no library defines `a`\n";
    assert!(stderr.starts_with(first), "{stderr}");
    assert_eq!(place.middle(), [255; 3]);
}

/// Files that a library names are read from its folder; a missing one is reported where the scene
/// names the mesh.
#[test]
fn the_pictures_of_a_library_are_read_from_its_folder() {
    let place = Place::new("newmtl a\nmap_Kd skin.ppm\n");
    let stderr = place.stderr("check a.xml", 0);
    let first = "warning: a.xml:2:28: meshes/a.obj (obj) map_Kd meshes/../skins/skin.ppm: \
                 no such file; shown in magenta\n";
    assert!(stderr.starts_with(first), "{stderr}");
    place.write("skins/skin.ppm", "P3\n1 1\n255\n91 120 150\n");
    let stderr = place.stderr("check a.xml", 0);
    assert_eq!(stderr, "1 scene checked: 0 errors, 0 warnings\n");
}

#[test]
fn an_unreadable_mesh_leaves_its_object_out() {
    let place = Place::new("newmtl a\n");
    let bad = MESH.replace("v 0 3 0", "v 0 3");
    for (content, first) in [
        (
            Some(bad),
            "meshes/a.obj:4:6: v: expected 3 numbers, found 2\n",
        ),
        (None, "a.xml:2:28: meshes/a.obj (obj): no such file\n"),
    ] {
        match content {
            Some(content) => place.write("meshes/a.obj", &content),
            None => fs::remove_file(place.at("meshes/a.obj")).expect("it is there"),
        }
        for line in ["render a.xml -o a.ppm --spp 1", "check a.xml"] {
            let stderr = place.stderr(line, 0);
            assert!(stderr.starts_with(&format!("warning: {first}")), "{stderr}");
        }
        assert!(place.at("a.ppm").exists());
        fs::remove_file(place.at("a.ppm")).expect("it is there");
        for line in [
            "render a.xml -o a.ppm --spp 1 --strict",
            "check a.xml --strict",
        ] {
            let stderr = place.stderr(line, 65);
            assert!(stderr.starts_with(&format!("error: {first}")), "{stderr}");
        }
        assert!(!place.at("a.ppm").exists());
    }
    // Also next to other errors.
    place.write("a.xml", &MESHED.replace("<target/>", "<target x='q'/>"));
    let stderr = place.stderr("check a.xml", 65);
    assert!(stderr.contains("no such file"), "{stderr}");
    assert!(stderr.contains("`q` is not a number"), "{stderr}");
}
