//! `compare` of scenes with pictures that say how they were made.

use super::metadata::forged;
use super::*;

/// A mirror and a floor under a lamp without falloff, in each language.
const SCENES: &[(&str, &str)] = &[
    (
        "lamp.ray",
        "// render: spp 2 depth 1\n.2 .2 .2\n1 2 3 4 .9 .8 .7\n2\n\
         sphere 0 0 0 1  1 0 0 .7 .2 .2 .5 .5 .5 20 .4 0 1\n\
         box -3 -2 -3 1 0 0 0 1 0 0 0 1 6 1 6  1 1 1 .4 .6 .4 0 0 0 1 0 0 1\n\
         // view: eye 0 1 6 target 0 0 0 up 0 1 0 fov 40 size 16 12\n",
    ),
    (
        "lamp.dat",
        "camera perspective 0 1 6  0 0 0  0 1 0  1 0 100\nresolution .05 .05\nviewport 16 12\n\
         light ID 0 pnt 2 3 4  0 0 0  .9 .8 .7  1 0 0  0 shadow_on\n\
         light ID 1 amb 0 0 0  0 0 0  .2 .2 .2  1 0 0  0 shadow_off\n\
         mat ID 0  .9 .3 .2  1 .8 .5 20  0 .4 1\nobj sphere ID 0 mat ID 0  0 0 0  1\n",
    ),
    (
        "lamp.xml",
        "<xml><scene><object type=\"sphere\" material=\"m\"/>\
         <material type=\"blinn\" name=\"m\"><diffuse r=\".8\" g=\".2\" b=\".2\"/>\
         <reflection value=\".5\" glossiness=\".1\"/></material>\
         <light type=\"point\" name=\"l\"><intensity value=\".8\"/>\
         <position x=\"2\" y=\"3\" z=\"4\"/><size value=\".5\"/></light></scene>\
         <camera><position y=\"1\" z=\"6\"/><target y=\"0\" z=\"0\"/><width value=\"16\"/>\
         <height value=\"12\"/></camera></xml>",
    ),
];

/// What `render` accepts, and values of it.
const OPTIONS: &[(&str, &[&str])] = &[
    ("--spp", &["1", "4", "17"]),
    ("--depth", &["0", "3"]),
    ("--integrator", &["whitted", "path", "photon"]),
    ("--filter", &["gaussian", "blackman-harris"]),
    ("--transfer", &["linear", "srgb"]),
    ("--exposure", &["-0.5", "2"]),
    ("--falloff", &["square"]),
    ("--gloss", &["exponent"]),
    ("--noise", &["0.05", "0"]),
    ("--clamp", &["0.25"]),
    ("--seed", &["7"]),
    ("--size", &["13x9"]),
    ("--region", &["2,1,7,5"]),
    ("--view", &["fov 30 eye 3 1 5", "up 1 1 0"]),
    (
        "--aov",
        &[
            "depth", "normal", "object", "albedo", "uv", "side", "cost", "samples", "noise",
            "emission", "indirect",
        ],
    ),
];

/// Compares and asserts that no pixel differs; returns the notes.
#[track_caller]
fn assert_alike(place: &Place, scene: &str, picture: &str, made: &str) -> String {
    let ran = place.run(&format!("compare {scene} {picture}"));
    let [printed, notes] =
        [ran.stdout, ran.stderr].map(|text| String::from_utf8(text).expect("text"));
    let said = format!("{scene} {picture} {made}: {printed}{notes}");
    assert_eq!(ran.status.code(), Some(0), "{said}");
    assert!(printed.contains("differing pixels  0 of "), "{said}");
    notes
}

/// Renders with these arguments.
#[track_caller]
fn render(place: &Place, arguments: &[String]) {
    let ran = place.command("render").args(arguments).output();
    let ran = ran.expect("it starts");
    let said = String::from_utf8_lossy(&ran.stderr);
    assert_eq!(ran.status.code(), Some(0), "{arguments:?}: {said}");
}

fn scenes() -> Place {
    let place = Place::new();
    for (name, text) in SCENES {
        place.write(name, text);
    }
    place
}

#[test]
fn a_picture_is_compared_with_its_scene_as_it_was_made() {
    let place = scenes();
    let mut state = 11_u64;
    let mut below = |bound: usize| {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (state >> 33) as usize % bound
    };
    for round in 0..20 {
        for (scene, _) in SCENES {
            let picture = ["a.png", "a.exr"][below(2)];
            let mut arguments = vec![(*scene).to_owned(), "-o".to_owned(), picture.to_owned()];
            let mut has_aov = false;
            for (option, values) in OPTIONS {
                // Each option is sometimes there, an AOV rarely.
                let bound = if *option == "--aov" { 4 } else { 3 };
                if below(bound) == 0 {
                    has_aov |= *option == "--aov";
                    let value = values[below(values.len())];
                    arguments.extend([(*option).to_owned(), value.to_owned()]);
                }
            }
            if !has_aov && below(3) == 0 {
                arguments.push("--denoise".to_owned());
            }
            if !has_aov && picture == "a.exr" && below(2) == 0 {
                arguments.extend(["--layers".to_owned(), "depth,albedo".to_owned()]);
            }
            render(&place, &arguments);
            let made = format!("round {round}: {}", arguments.join(" "));
            let notes = assert_alike(&place, scene, picture, &made);
            assert!(!notes.contains("not used"), "{made}: {notes}");
        }
    }
}

#[test]
fn each_aov_and_option_is_recorded() {
    let place = scenes();
    for (option, values) in OPTIONS {
        for value in *values {
            let words = ["lamp.xml", "-o", "a.png", option, value];
            render(&place, &words.map(str::to_owned));
            assert_alike(&place, "lamp.xml", "a.png", &format!("{option} {value}"));
        }
    }
    place.stderr("render lamp.ray -o t%d.png --turntable 3 --spp 1", 0);
    assert_alike(&place, "lamp.ray", "t1.png", "a turntable");
    for shard in 0..2 {
        let line = format!("render lamp.ray -o m.png --spp 3 --shard {shard}/2");
        place.stderr(&line, 0);
    }
    place.stderr("merge m.0-2.part m.1-2.part -o m.png", 0);
    assert_alike(&place, "lamp.ray", "m.png", "shards");
}

#[test]
fn the_settings_used_are_said() {
    let place = Place::new();
    place.stderr("render ball.ray -o a.png --spp 4 --depth 2 --seed 7", 0);
    place.stderr("render ball.ray -o a.bmp --spp 4", 0);
    place.write("dim.ray", BALL.replace("1 1 1\n1 0 9", ".5 .5 .5\n1 0 9"));
    let rest =
        "integrator whitted, filter box, transfer linear, exposure 0, falloff none, gloss none";
    let recorded =
        "is traced with the settings recorded in a.png, except where options override them";
    for (words, code, expected) in [
        (
            "ball.ray a.png",
            0,
            format!("note: ball.ray {recorded}: size 8x6, depth 2, seed 7, {rest}, spp 4\n"),
        ),
        (
            "a.png dim.ray --spp 1 --depth 0",
            1,
            format!("note: dim.ray {recorded}: size 8x6, depth 0, seed 7, {rest}, spp 1\n"),
        ),
        (
            "a.bmp ball.ray",
            1,
            format!(
                "note: a.bmp records no settings: ball.ray is traced with size 8x6, depth 8, seed 0, \
                 {rest}, spp 16; options such as --spp change them\n"
            ),
        ),
    ] {
        assert_eq!(place.stderr(&format!("compare {words}"), code), expected);
    }
}

#[test]
fn a_picture_cut_out_of_another_is_compared_with_that_part() {
    let place = scenes();
    place.stderr("render lamp.ray -o whole.ppm --spp 1", 0);
    place.stderr("render lamp.ray -o part.png --region 2,1,7,5 --spp 1", 0);
    assert_alike(&place, "lamp.ray", "part.png", "a region");
    let words = "compare lamp.ray part.png --size 16x12";
    let ran = place.run(words);
    assert_eq!(ran.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&ran.stdout).starts_with("size              16x12 and 7x5\n"));
}

/// Records come from anywhere.
#[test]
fn what_cannot_be_used_of_a_record_is_said() {
    const WHOLE: &str = "version 1\nscene 0\nview own\nlayers none\nsize 1x1\nregion none\ndepth 2\n\
                         seed 7\naov none\nintegrator whitted\nfilter box\ntransfer linear\n\
                         exposure 0\nfalloff none\ngloss none\nspp 4\n";
    let place = Place::new();
    let huge = "x".repeat(100_000);
    for (from, to, unused) in [
        ("", "", None),
        ("spp 4", "spp 4000000000", Some("spp 4000000000")),
        ("depth 2", "depth -1", Some("depth -1")),
        (
            "size 1x1",
            "size 40x30",
            Some("size 40x30 (the picture is 1x1)"),
        ),
        (
            "size 1x1",
            "size 4294967295x4294967295",
            Some("size 4294967295x4294967295"),
        ),
        (
            "region none",
            "region 1,2,3,4",
            Some("size 1x1 region 1,2,3,4 (the picture is 1x1)"),
        ),
        (
            "aov none",
            "aov direct 4294967295",
            Some("aov direct 4294967295"),
        ),
        ("view own", "view target 0 0 5", Some("view target 0 0 5")),
        ("scene 0", "scene \x1b]0;x\x07\nnew 1", Some("new 1")),
        ("seed 7\n", "", Some("seed is missing")),
        (
            "falloff none\ngloss none\nspp 4\n",
            "",
            Some("falloff is missing, gloss is missing, spp is missing"),
        ),
        ("version 1", &huge, Some("x…, version is missing")),
    ] {
        place.write("a.png", forged(&WHOLE.replacen(from, to, 1)));
        let ran = place.run("compare --tolerance 255 ball.ray a.png");
        let notes = String::from_utf8(ran.stderr).expect("text");
        assert_eq!(ran.status.code(), Some(0), "{to:.60}: {notes}");
        let told = "note: problems in the record of a.png are ignored: ";
        let found = notes.lines().find_map(|line| line.strip_prefix(told));
        let found = found.map(|found| found.replace(&"x".repeat(40), "x"));
        assert_eq!(found.as_deref(), unused, "{notes}");
    }
    // A text that is no record at all says nothing.
    place.write("a.png", forged("\u{e9}\n\n\n"));
    let notes = place.stderr("compare --tolerance 255 ball.ray a.png", 0);
    assert!(notes.contains("note: a.png records no settings"), "{notes}");
}

/// In the interface a picture is compared in the same way.
#[test]
fn the_interface_shows_no_difference_either() {
    let place = scenes();
    for (scene, picture, options) in [
        ("lamp.ray", "a.png", "--spp 4 --depth 2 --seed 7"),
        (
            "lamp.ray",
            "a.png",
            "--integrator path --spp 3 --denoise --transfer srgb",
        ),
        ("lamp.ray", "a.png", "--size 40x20 --filter gaussian"),
        ("lamp.xml", "a.png", "--region 2,1,13,11 --gloss exponent"),
        (
            "lamp.xml",
            "a.exr",
            "--transfer srgb --exposure -1 --layers depth --spp 4",
        ),
        (
            "lamp.xml",
            "a.exr",
            "--integrator photon --falloff square --denoise --clamp 0.5",
        ),
        ("lamp.dat", "a.png", "--aov depth"),
        ("lamp.dat", "a.exr", "--aov normal --spp 4"),
        ("lamp.ray", "a.png", "--integrator path --noise 0.05"),
    ] {
        place.stderr(&format!("render {scene} -o {picture} {options}"), 0);
        let keys = format!("wait : \"compare {picture}\" Enter wait");
        place.write("compare.keys", keys);
        let line = format!("{scene} --screen 120x30 --keys compare.keys --dump-frame screen.txt");
        place.stderr(&line, 0);
        let screen = String::from_utf8(place.read("screen.txt")).expect("text");
        assert!(screen.contains("no pixel differs"), "{options}: {screen}");
    }
}
