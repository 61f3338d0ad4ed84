//! Small scenes with something wrong, and what is to be said about a pixel of each.

mod help;
mod parting;

use std::fs;
use std::path::Path;
use std::sync::Arc;

use super::*;
use language::{Language, Source};
use render::{Frames, Job, PreparedScene, Settings};
use scene::{Images, Integrator, Meshes, Rendering};

/// How a scene is traced unless its text says otherwise.
#[derive(Clone, Copy, Default)]
struct How {
    depth: Option<u32>,
    integrator: Option<Integrator>,
    sample: u32,
}

const PLAIN: How = How {
    depth: None,
    integrator: None,
    sample: 0,
};
const DEPTH_0: How = How {
    depth: Some(0),
    ..PLAIN
};
const PATH: How = How {
    integrator: Some(Integrator::Path),
    ..PLAIN
};

/// Explains a pixel of a text without its files.
fn explain(language: Language, text: &str, pixel: [u32; 2], how: How) -> Words {
    let (explanation, source, job) = explained(language, text, pixel, how);
    words(&explanation, &subject(&source, &job))
}

fn subject<'s>(source: &'s Source, job: &'s Job) -> Subject<'s> {
    Subject {
        source,
        scene: &job.scene,
        camera: &job.camera,
        size: job.settings.size,
    }
}

/// The explanation of a pixel of a text, the text lowered, and how it is traced.
fn explained(
    language: Language,
    text: &str,
    pixel: [u32; 2],
    how: How,
) -> (Explanation, Source, Job) {
    let mut source = Source::new(language, Arc::new(text.to_owned()));
    let lowered = source.lower(&Meshes::default()).expect("there is memory");
    let findings = lowered.diagnostics;
    let scene = lowered
        .scene
        .unwrap_or_else(|| panic!("{text}: {findings:?}"));
    let lights = source.nodes().iter();
    let lights = lights.filter(|node| matches!(node, Node::Light(_))).count();
    assert_eq!(lights, scene.lights.len(), "lights of text and scene agree");
    let size = scene.camera.size;
    let asked = Rendering {
        integrator: how.integrator,
        depth: how.depth,
        ..Rendering::default()
    };
    let asked = asked.or(scene.setting.rendering);
    let job = Job {
        camera: scene.camera,
        scene: Arc::new(scene),
        images: Images::default(),
        settings: Settings {
            spp: 1,
            ..Settings::new(size, &asked)
        },
        limit: None,
        frames: Frames::Last,
        denoise: false,
        numbers: None,
    };
    let prepared = PreparedScene::new(&job, &|| false).expect("nothing cancels");
    let explained = prepared.query().explain(pixel, how.sample, &|| false);
    let explanation = explained.expect("the pixel is in the picture");
    (explanation, source, job)
}

/// Checks the first verdict about the middle of a picture of 40 by 30 pixels, which must contain
/// some words.
#[track_caller]
fn check(language: Language, text: &str, how: How, verdict: &str, contains: &str) {
    let words = explain(language, text, [20, 15], how);
    let first = &words.verdicts[0];
    let said: Vec<_> = words
        .verdicts
        .iter()
        .map(|sentence| &sentence.text)
        .collect();
    let is_right = first.name == verdict && first.text.contains(contains);
    assert!(
        is_right,
        "{verdict}, {contains}\n{text}{}: {said:#?}",
        first.name
    );
}

const GREY: &str = ".2 .2 .2 .7 .7 .7 0 0 0 1 0 0 1";
const LAMP: &str = "3 3 6 1 1 1";

/// A `.ray` scene with an ambient light, a light and objects, seen from (0, 0, 5).
fn ray(ambient: &str, light: &str, objects: &[&str]) -> String {
    let count = objects.len();
    let objects = objects.join("\n");
    format!(
        "{ambient}\n1 {light}\n{count}\n{objects}\n\
         // view: eye 0 0 5 target 0 0 0 up 0 1 0 fov 40 size 40 30\n"
    )
}

#[test]
fn verdicts_of_ray_scenes() {
    let ball = |material: &str| format!("sphere 0 0 0 1 {material}");
    let grey = ball(GREY);
    let check = |text: String, how, verdict, contains| {
        check(Language::Ray, &text, how, verdict, contains);
    };
    check(
        ray(".1 .1 .1", LAMP, &[&grey]),
        PLAIN,
        "ordinary",
        "lit by light 1",
    );
    let aside = format!("sphere 9 0 0 1 {GREY}");
    check(
        ray("0 0 0", LAMP, &[&aside]),
        PLAIN,
        "missed",
        "the background is black",
    );
    let behind = "0 0 -9 1 1 1";
    let words = "object 1 (sphere, line 4) faces away from light 1 (line 2)";
    check(ray("0 0 0", behind, &[&grey]), PLAIN, "faces-away", words);
    check(
        ray(".5 .5 .5", behind, &[&grey]),
        PLAIN,
        "faces-away",
        words,
    );
    let words = "light 1 (line 2) is inside object 1 (sphere, line 4)";
    check(
        ray("0 0 0", "0 0 0 1 1 1", &[&grey]),
        PLAIN,
        "enclosed",
        words,
    );
    // Whether the surface faces it or not.
    for z in [3, -3] {
        let shade = format!("sphere 1.5 3 {z} .5 {GREY}");
        let words = "light 1 (line 2) is inside object 2 (sphere, line 5)";
        let text = ray("0 0 0", &format!("1.5 3 {z} 1 1 1"), &[&grey, &shade]);
        check(text, PLAIN, "enclosed", words);
    }
    let screen = format!("sphere 0 5 2 1 {GREY}");
    let text = ray(".1 .1 .1", "0 10 3 1 1 1", &[&grey, &screen]);
    let words = "in the shadow of object 2 (sphere, line 5) from light 1 (line 2)";
    check(text, PLAIN, "shadow", words);
    let off = ray("0 0 0", "3 3 6 0 0 0", &[&grey]);
    check(
        off,
        PLAIN,
        "switched-off",
        "light 1 (line 2) is switched off",
    );
    let black = ball("0 0 0 0 0 0 0 0 0 1 0 0 1");
    check(
        ray(".1 .1 .1", LAMP, &[&black]),
        PLAIN,
        "black",
        "reflects, transmits and emits",
    );
    let glass = ball("0 0 0 0 0 0 0 0 0 1 0 .9 1.5");
    check(
        ray(".1 .1 .1", LAMP, &[&glass]),
        DEPTH_0,
        "depth",
        "cut by depth 0",
    );
    let words = "through object 1 (sphere, line 4): the ray hits nothing";
    check(ray(".1 .1 .1", LAMP, &[&glass]), PLAIN, "missed", words);
    let mirror = ball("0 0 0 0 0 0 0 0 0 1 .9 0 1");
    let words = "reflected in object 1 (sphere, line 4): the ray hits nothing";
    check(ray(".1 .1 .1", LAMP, &[&mirror]), PLAIN, "missed", words);
    let pane = "box -1 -1 2 1 0 0 0 1 0 0 0 1 2 2 .1 0 0 0 0 0 0 0 0 0 1 0 .8 1";
    let words = "object 1 (box, line 4) transmits object 2 (sphere, line 5)";
    check(ray("0 0 0", LAMP, &[pane, &grey]), PLAIN, "ordinary", words);
    let around = format!("sphere 0 0 0 20 {GREY}");
    let text = ray("0 0 0", "0 50 0 1 1 1", &[&around]);
    check(text, PLAIN, "inside", "the camera is inside object 1");
    let bright = ray("0 0 0", "0 0 6 3 3 3", &[&grey]);
    check(bright, PLAIN, "too-bright", "above 1");
    let blue = ball("0 0 0 0 0 1 0 0 0 1 0 0 1");
    let text = ray("0 0 0", "3 3 6 1 0 0", &[&blue]);
    check(
        text,
        PLAIN,
        "not-reflected",
        "reflects too little of light 1",
    );
    let only_ambient = ball("1 1 1 0 0 0 0 0 0 1 0 0 1");
    let text = ray("0 0 0", LAMP, &[&only_ambient]);
    check(text, PLAIN, "no-ambient", "there is no ambient light");
    let cube = "box -10 -10 -10 1 0 0 0 1 0 0 0 1 20 20 20 0 0 0 0 0 0 0 0 0 1 0 1 1.5";
    let text = format!(
        "0 0 0 1 {LAMP} 1 {cube}\n\
         // view: eye 0 0 0 target 1 1 .9 up 0 0 1 fov 1 size 40 30\n"
    );
    check(text, PLAIN, "total-reflection", "total internal reflection");
}

#[test]
fn cut_rays_too_faint_to_see_are_no_finding() {
    let faint = "sphere 0 0 0 1 .2 .2 .2 .7 .7 .7 0 0 0 1 .001 0 1";
    let text = ray("0 0 0", LAMP, &[faint]);
    let words = explain(Language::Ray, &text, [20, 15], DEPTH_0);
    let mut names = words.verdicts.iter().map(|verdict| verdict.name);
    assert!(names.all(|name| name != "depth"));
}

/// A `.dat` scene with a camera at (0, 0, 5), which looks at a grey ball of radius 1.
fn dat(depths: &str, records: &str) -> String {
    format!(
        "camera perspective 0 0 5  0 0 0  0 1 0  1 {depths}\n\
         resolution .02 .02\nviewport 40 30\n\
         mat ID 1  1 1 1  .2 .7 0 1 0 0 1\nobj sphere ID 1 mat ID 1  0 0 0 1\n{records}\n"
    )
}

#[test]
fn verdicts_of_dat_scenes() {
    let check = |text: String, how, verdict, contains| {
        check(Language::Dat, &text, how, verdict, contains);
    };
    let lamp = "light ID 1 pnt  3 3 6  0 0 0  1 1 1  1 0 0  0 shadow_on";
    check(
        dat(".1 99", lamp),
        PLAIN,
        "ordinary",
        "lit by light 1 (line 6)",
    );
    check(
        dat(".1 3", lamp),
        PLAIN,
        "clipped-far",
        "beyond the far limit, 3",
    );
    check(
        dat("20 99", lamp),
        PLAIN,
        "clipped-near",
        "nearer than the near limit, 20",
    );
    let text = dat("5 99", lamp);
    check(text, PLAIN, "clipped-near", "nearer than the near limit, 5");
    let away = "light ID 1 pnt  0 0 6  0 0 1  1 1 1  1 0 0  10 shadow_on";
    let words = "outside the cone of light 1 (line 6): 1";
    check(dat(".1 99", away), PLAIN, "outside-cone", words);
    let edge = "light ID 1 pnt  0 0 6  .98 0 -.2  1 1 1  1 0 0  AA shadow_on";
    for (exponent, words) in [
        ("3", "° off its direction, which leaves 0.9 %"),
        ("5", "° off its direction, which leaves less than 0.1 %"),
    ] {
        let text = dat(".1 99", &edge.replace("AA", exponent));
        check(text, PLAIN, "outside-cone", words);
    }
    let strong = "light ID 1 pnt  3 3 6  0 0 0  1 1 1  1 0 900  0 shadow_on";
    check(dat(".1 99", strong), PLAIN, "attenuated", "at distance 6.5");
    let dim = "light ID 1 pnt  3 3 6  0 0 0  .001 .001 .001  1 0 0  0 shadow_on";
    check(dat(".1 99", dim), PLAIN, "dim", "its colour is 0.001");
    let ambient = "light ID 1 amb  0 0 0  0 0 0  1 1 1  1 0 0  0 shadow_off";
    check(
        dat(".1 99", ambient),
        PATH,
        "no-lights",
        "only ambient light",
    );
    check(
        dat(".1 99", ""),
        PLAIN,
        "no-lights",
        "the scene has no light",
    );
    let hidden = format!("{lamp}\nobj sphere ID 2 mat ID 1  0 0 2 .5\nrender 1 ID 1");
    check(
        dat(".1 99", &hidden),
        PLAIN,
        "not-drawn",
        "object 2 (sphere, line 7) is here",
    );
    let cut =
        format!("{lamp}\nobj sphere ID 2 mat ID 1  0 0 1 .5\nobj CSG ID 3 difference ID 1 ID 2");
    check(dat(".1 99", &cut), PLAIN, "ordinary", "object 3");
    let missing =
        format!("{lamp}\nobj sphere ID 2 mat ID 1  2 0 0 1.5\nobj CSG ID 3 difference ID 2 ID 1");
    let words = "but object 3 (CSG, line 8) does not include this part of it";
    check(dat(".1 99", &missing), PLAIN, "not-drawn", words);
    let off = format!(
        "{}\n{lamp}",
        lamp.replace("1 1 1", "0 0 0").replace("ID 1", "ID 2")
    );
    check(dat(".1 99", &off), PLAIN, "ordinary", "lit by light 1");
}

/// Between two mirrors, on a stack that has no room for a call per bounce.
#[test]
fn thousands_of_bounces_are_explained() {
    let mirror = |z: &str| {
        format!("box -999 -999 {z} 1 0 0 0 1 0 0 0 1 1998 1998 1 0 0 0 0 0 0 0 0 0 1 1 0 1")
    };
    let text = ray("0 0 0", "0 0 2 1 1 1", &[&mirror("-1"), &mirror("10")]);
    let how = How {
        depth: Some(4096),
        ..PLAIN
    };
    let explained = move || explain(Language::Ray, &text, [20, 15], how);
    let thread = std::thread::Builder::new().stack_size(1 << 20);
    let words = thread.spawn(explained).expect("it starts").join();
    let words = words.expect("the stack suffices");
    assert!(4000 < words.lines.len(), "{}", words.lines.len());
}

#[test]
fn verdicts_of_sums_that_overflow() {
    let text = "0 0 0 2 0 0 9 1e308 1e308 1e308 0 0 9 1e308 1e308 1e308\n1\n\
                sphere 0 0 0 1  0 0 0 .99 .99 .99 0 0 0 1 0 0 1\n\
                // view: eye 0 0 5 target 0 0 0 up 0 1 0 fov 40 size 40 30\n";
    check(Language::Ray, text, PLAIN, "not-finite", "");
    let words = explain(Language::Ray, text, [20, 15], PLAIN);
    assert!(words.verdicts.iter().all(|said| said.name != "too-bright"));
}

/// Pixel (20, 15) sees the point where the light is.
#[test]
fn verdicts_of_a_light_on_a_surface() {
    let text = "camera orthographic 0 0 5 0 0 0 0 1 0 1 0 100\nresolution 1 1\nviewport 40 30\n\
                light ID 1 pnt .5 -.5 0 0 0 0 1 1 1 1 0 0 0 shadow_on\n\
                mat ID 1 1 1 1 0 1 0 1 0 0 1\n\
                obj box ID 1 mat ID 1 0 0 -1 1 0 0 0 1 0 0 0 1 50 50 2\n";
    let words = "this point of object 1 (box, line 6) lies inside light 1";
    check(Language::Dat, text, PLAIN, "at-the-light", words);
}

/// An `.xml` scene with a plane of scale 9 of a material, seen from (0, 0, 5).
fn xml(material: &str, others: &str) -> String {
    format!(
        "<xml><scene>\n<object type=\"plane\" {material}><scale value=\"9\"/></object>\n{others}\n\
         </scene><camera><position z=\"5\"/><target z=\"0\"/><width value=\"40\"/>\
         <height value=\"30\"/></camera></xml>"
    )
}

/// A light with a size, at this place.
fn globe(place: [i32; 3], size: f64, intensity: f64) -> String {
    let [x, y, z] = place;
    format!(
        "<light type=\"point\" name=\"globe {x}\"><intensity value=\"{intensity}\"/>\
         <position x=\"{x}\" y=\"{y}\" z=\"{z}\"/><size value=\"{size}\"/></light>"
    )
}

#[test]
fn verdicts_of_lights_with_a_size() {
    let painted = "material=\"m\"";
    let white = "<material type=\"blinn\" name=\"m\"><diffuse/><specular value=\"0\"/></material>";
    let scene = |lights: &[String]| {
        let text = xml(painted, &[white, &lights.concat()].concat());
        text.replace("<camera>", "<camera gamma=\"sRGB\">")
    };
    let (near, far) = (globe([4, 0, 3], 0.5, 1e-9), globe([8, 0, 6], 0.2, 1000.0));
    check(
        Language::Xml,
        &scene(&[near, far]),
        PLAIN,
        "shadow",
        "another light hides",
    );
}

#[test]
fn verdicts_of_xml_scenes() {
    let check = |text: String, how, verdict, contains| {
        check(Language::Xml, &text, how, verdict, contains);
    };
    let of = "material=\"m\"";
    let matte = "<material type=\"blinn\" name=\"m\"/>";
    let lamp = "<light type=\"point\"><intensity value=\".5\"/><position z=\"5\"/></light>";
    let lit = format!("{matte}{lamp}");
    check(xml(of, &lit), PLAIN, "ordinary", "lit by");
    check(
        xml("", &lit),
        PLAIN,
        "no-material",
        "has no material and is flat white",
    );
    let off = lit.replace("<intensity value=\".5\"/>", "<intensity value=\"0\"/>");
    check(xml(of, &off), PLAIN, "switched-off", "switched off");
    let lost = "<material type=\"blinn\" name=\"m\"><diffuse texture=\"nowhere.png\"/></material>";
    let text = xml(of, &format!("{lost}{lamp}"));
    check(
        text,
        PLAIN,
        "missing-texture",
        "has no image and shows magenta",
    );
    let glass = "<material type=\"blinn\" name=\"m\"><diffuse value=\"0\"/><specular value=\"0\"/>\
                 <refraction value=\"1\" index=\"1.5\"/></material>";
    let text = xml(of, &format!("{glass}{lamp}"));
    check(text, DEPTH_0, "depth", "cut by depth 0");
    let glow = "<material type=\"blinn\" name=\"g\"><emission value=\"1\"/></material>\
                <object type=\"sphere\" material=\"g\"><translate x=\"30\"/></object>";
    let text = xml(of, &format!("{matte}{glow}"));
    check(
        text,
        PLAIN,
        "no-lights",
        "only path tracing is lit by emission",
    );
    let sun = "<light type=\"direct\"><intensity value=\"1\"/><direction z=\"1\"/></light>";
    let text = xml(of, &format!("{matte}{sun}"));
    check(text.clone(), PLAIN, "faces-away", "faces away from");
    check(text, PATH, "faces-away", "faces away from");
    let background = "<background value=\".5\"/>";
    let text = xml("", background).replace("value=\"9\"", "value=\".001\"");
    check(text, PLAIN, "missed", "the background is 0.5");
}

/// Every verdict has a name of the list, and every ray and light a line.
#[test]
fn every_pixel_of_our_scenes_can_be_put_into_words() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let mut explained = 0;
    for entry in fs::read_dir(folder).expect("our scenes are there") {
        let path = entry.expect("our scenes are there").path();
        let Ok(language) = Language::of_path(&path) else {
            continue;
        };
        let text = fs::read_to_string(&path).expect("scenes are readable");
        for (pixel, how) in [([3, 40], PLAIN), ([77, 99], PLAIN), ([150, 140], PATH)] {
            let words = explain(language, &text, pixel, How { sample: 1, ..how });
            assert!(!words.verdicts.is_empty() && !words.lines.is_empty());
            for sentence in &words.verdicts {
                assert!(VERDICTS.contains(&sentence.name), "{}", sentence.name);
                assert!(!sentence.text.is_empty());
            }
            explained += 1;
        }
    }
    assert!(30 <= explained, "{explained}");
}

#[test]
fn lines_name_what_a_ray_meets_and_where_that_stands() {
    let screen = format!("sphere 0 5 2 1 {GREY}");
    let text = ray(
        ".1 .1 .1",
        "0 10 3 1 1 1",
        &[&format!("sphere 0 0 0 1 {GREY}"), &screen],
    );
    let words = explain(Language::Ray, &text, [20, 15], PLAIN);
    let lines: Vec<_> = words.lines.iter().map(|line| &*line.text).collect();
    assert!(lines[0].starts_with("camera ray hits the front of object 1 (sphere, line 4) at t 4"));
    let light = words
        .lines
        .iter()
        .find(|line| line.node == Some(Node::Light(0)));
    let light = light.expect("the light has a line");
    assert!(
        light.text.contains("in shadow: N·L 0.147"),
        "{}",
        light.text
    );
    assert!(
        light.text.ends_with("blocked by object 2 (sphere, line 5)"),
        "{}",
        light.text
    );
    assert_eq!(light.place.map(|place| place.line), Some(2));
    let [from, to] = light.segment.expect("the way of its light");
    assert!((from.z - 1.0).abs() < 0.01 && (to - DVec3::new(0.0, 10.0, 3.0)).length() < 1e-9);
}
