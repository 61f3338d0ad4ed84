//! Render settings in a text against the options of the command line, and what is said of pictures.

use super::Place;

/// Two balls and a lamp.
const SCENE: &str = "\
.1 .1 .1
1 2 4 3 9 8 7
2 sphere 0 0 0 1  .2 .2 .2 .5 .4 .3 .5 .5 .5 9 .3 0 1
sphere 1.5 0 0 .5  .2 .2 .2 .2 .4 .6 0 0 0 1 .1 .6 1.3
// view: eye 0 1 5 target 0 0 0 up 0 1 0 fov 40 size 24 18
";

#[test]
fn settings_in_the_text_give_the_picture_of_the_same_options() {
    let place = Place::new();
    place.write("plain.ray", SCENE);
    let cases = [
        ("integrator path spp 2", "--integrator path --spp 2"),
        ("depth 1 spp 1", "--depth 1 --spp 1"),
        ("spp 4 filter gaussian", "--spp 4 --filter gaussian"),
        (
            "spp 1 transfer srgb exposure -1.5",
            "--spp 1 --transfer srgb --exposure -1.5",
        ),
        ("spp 1 falloff square", "--spp 1 --falloff square"),
    ];
    let mut pictures = Vec::new();
    for (settings, options) in cases {
        place.write("said.ray", format!("// render: {settings}\n{SCENE}"));
        place.stderr("render said.ray -o said.bmp", 0);
        place.stderr(&format!("render plain.ray -o plain.bmp {options}"), 0);
        assert!(
            place.read("said.bmp") == place.read("plain.bmp"),
            "{settings}"
        );
        // The command line takes precedence.
        place.write(
            "other.ray",
            format!("// render: spp 3 depth 0 exposure 2\n{SCENE}"),
        );
        let all = format!("--spp 1 --depth 8 --exposure 0 {options}");
        let all = match options.split_once("--spp") {
            Some(_) => all.replacen("--spp 1 ", "", 1),
            None => all,
        };
        let all = match (options.contains("--depth"), options.contains("--exposure")) {
            (true, _) => all.replacen("--depth 8 ", "", 1),
            (_, true) => all.replacen("--exposure 0 ", "", 1),
            _ => all,
        };
        if !options.contains("path") {
            place.stderr(&format!("render other.ray -o other.bmp {all}"), 0);
            assert!(place.read("other.bmp") == place.read("plain.bmp"), "{all}");
        }
        pictures.push(place.read("said.bmp"));
    }
    pictures.sort();
    pictures.dedup();
    assert_eq!(
        pictures.len(),
        cases.len(),
        "all settings make a difference"
    );
}

#[test]
fn a_picture_that_can_only_be_black_is_a_warning() {
    let place = Place::new();
    let sky = "<xml>\n<scene><object type=\"sphere\" material=\"m\"/><material name=\"m\"/>\
               <environment value=\"1\"/></scene>\n<camera><position z=\"9\"/></camera>\n</xml>\n";
    place.write("sky.xml", sky);
    let warning = "sky.xml:3:1: the only light is emission or the environment, which only path tracing carries to other surfaces";
    let said = place.stderr("check sky.xml", 0);
    assert!(said.contains(warning), "{said}");
    assert!(
        said.contains("note: sky.xml: the picture is black; try `--integrator path`"),
        "{said}"
    );
    place.stderr("check --strict sky.xml", 65);
    let by_path = place.stderr(
        "render sky.xml --strict --integrator path --spp 1 -o sky.bmp",
        0,
    );
    assert!(!by_path.contains("warning"), "{by_path}");
    place.write(
        "sky.xml",
        sky.replace("</xml>", "<render integrator=\"path\"/>\n</xml>"),
    );
    place.stderr("check --strict sky.xml", 0);
    // Nothing is said where nothing is judged.
    place.write("sky.xml", sky);
    let converted = place.stderr("convert sky.xml -o sky.dat", 0);
    assert!(!converted.contains("no light"), "{converted}");
}

#[test]
fn conversion_keeps_the_settings() {
    let place = Place::new();
    let settings =
        "integrator path depth 3 spp 2 filter gaussian transfer srgb exposure -0.5 falloff square";
    place.write("a.ray", format!("// render: {settings}\n{SCENE}"));
    place.stderr("convert a.ray -o a.dat", 0);
    let text = String::from_utf8(place.read("a.dat")).expect("text");
    assert!(
        text.starts_with(&format!("# render: {settings}\n")),
        "{text}"
    );
    place.stderr("convert a.dat -o a.xml", 0);
    let text = String::from_utf8(place.read("a.xml")).expect("text");
    let element = "<render integrator=\"path\" depth=\"3\" spp=\"2\" filter=\"gaussian\" transfer=\"srgb\" \
                   exposure=\"-0.5\" falloff=\"square\"/>";
    assert!(text.contains(element), "{text}");
}

#[test]
fn black_and_clipped_pictures_are_remarked_on_with_what_helps() {
    let place = Place::new();
    let ball = |light: &str| {
        format!(
            "// view: eye 0 0 2\n0 0 0 1 0 0 9 {light} 1 sphere 0 0 0 1 0 0 0 1 1 1 0 0 0 1 0 0 1\n"
        )
    };
    for (light, options, expected) in [
        ("1 1 1", "", ""),
        (
            "0 0 0",
            "",
            "note: the picture is black; the warnings above say why",
        ),
        (
            ".001 .001 .001",
            "",
            "note: the picture is black; try `--exposure 9.5`",
        ),
        (".001 .001 .001", "--exposure 9.5", ""),
        (
            "9 9 9",
            "",
            "note: more than half of the picture is above 1; try `--exposure -3.5`",
        ),
        ("9 9 9", "--exposure -3.5", ""),
        (
            "9 9 9",
            "--exposure -0.5",
            "note: more than half of the picture is above 1; try `--exposure -3.5`",
        ),
        // At a distance of 8, that is a light of 1 that falls off.
        (
            "64 64 64",
            "",
            "note: more than half of the picture is above 1; try `--falloff square`",
        ),
        ("64 64 64", "--falloff square", ""),
        ("64 64 64", "--exposure -6", ""),
        (
            "640 640 640",
            "--falloff square",
            "note: more than half of the picture is above 1; try `--exposure -3.5`",
        ),
        ("0 0 0", "--aov albedo", ""),
        (
            "1 1 1",
            "--noise 0.1 --spp 16",
            "note: `--noise` has no effect: it cannot stop a pixel before 16 samples, and `--spp` is 16",
        ),
        ("1 1 1", "--noise 0.1 --spp 17", ""),
    ] {
        place.write("a.ray", ball(light).as_bytes());
        let said = place.stderr(&format!("render a.ray -o a.bmp --size 9x9 {options}"), 0);
        let found = said.lines().find(|line| line.starts_with("note: "));
        assert_eq!(found.unwrap_or_default(), expected, "{light}: {said}");
    }
}

/// Inside a white ball each bounce adds as much light as arrives directly, and all is alike.
#[test]
fn a_picture_that_is_alike_all_over_is_mended_by_no_setting() {
    let place = Place::new();
    let room = "// view: eye 0 0 0.5\n// render: integrator path spp 4\n\
                0 0 0 1 0 0 0 .3 .3 .3 1 sphere 0 0 0 1 0 0 0 1 1 1 0 0 0 1 0 0 1\n";
    place.write("a.ray", room);
    let said = |options: &str| {
        let said = place.stderr(&format!("render a.ray -o a.bmp --size 9x9 {options}"), 0);
        let found = said.lines().find(|line| line.starts_with("note: "));
        found.unwrap_or_default().to_owned()
    };
    let none =
        "note: more than half of the picture is above 1; no single render setting fixes that";
    assert_eq!(said(""), none);
    assert_eq!(said("--depth 2"), "");
    assert_eq!(said("--integrator whitted --exposure 3"), none);
    assert_eq!(said("--resume"), said(""));
}
