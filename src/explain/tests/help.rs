//! What would change a pixel, as its verdict says.

use super::*;

/// What would change a pixel, in words that fit the kind of light and the language.
#[test]
fn help_speaks_of_the_fields_that_a_light_has() {
    let help = |language, text: &str| {
        let words = explain(language, text, [20, 15], PLAIN);
        let first = words.verdicts.into_iter().next().expect("there is one");
        let place = first.place.and_then(|place| place.field);
        (first.help.unwrap_or_default(), place.unwrap_or_default())
    };
    let ball = format!("sphere 0 0 0 1 {GREY}");
    let square = "// render: falloff square\n";
    let ray = |light: &str, render| ray("0 0 0", light, &[&ball]) + render;
    let dat = |light: &str| dat(".1 99", &format!("light ID 1 {light} shadow_on"));
    let xml = |light: &str| {
        let matte = "<material type=\"blinn\" name=\"m\"/>";
        xml(
            "material=\"m\"",
            &format!("{matte}<light name=\"l\" {light}</light>"),
        )
    };
    for (language, text, expected) in [
        (
            Language::Ray,
            ray("0 0 -9 1 1 1", ""),
            (
                "move light 1 (line 2) to this side, or add a light",
                "position",
            ),
        ),
        (
            Language::Ray,
            ray("90 90 90 1 1 1", square),
            (
                "use `falloff none`, or raise colour of light 1 (line 2)",
                "falloff",
            ),
        ),
        (
            Language::Dat,
            dat("inf  0 0 9  0 0 1  1 1 1  1 0 0  0"),
            (
                "turn the direction of light 1 (line 6), or add a light",
                "direction",
            ),
        ),
        (
            Language::Dat,
            dat("pnt  3 3 6  0 0 0  1 1 1  1 0 900  0"),
            (
                "lower a0, a1 or a2 of light 1 (line 6), or raise its colour",
                "a2",
            ),
        ),
        (
            Language::Xml,
            xml("type=\"direct\"><intensity/><direction z=\"1\"/>"),
            (
                "turn the direction of l (direct, line 3), or add a light",
                "direction",
            ),
        ),
        (
            Language::Xml,
            xml("type=\"point\"><intensity/><position z=\"-5\"/>"),
            (
                "move l (point, line 3) to this side, or add a light",
                "position",
            ),
        ),
        (
            Language::Xml,
            xml("type=\"point\"><intensity/><position z=\"5\"/><attenuation value=\"90\"/>"),
            (
                "lower attenuation of l (point, line 3), or raise its intensity",
                "attenuation",
            ),
        ),
    ] {
        let (help, field) = help(language, &text);
        assert_eq!((&*help, field), expected, "{text}");
    }
}

/// Settings that darken or brighten the whole picture are named before the surface.
#[test]
fn verdicts_of_render_settings() {
    let grey = format!("sphere 0 0 0 1 {GREY}");
    let check = |text: String, verdict, contains| {
        check(Language::Ray, &text, PLAIN, verdict, contains);
    };
    let lit = ray(".1 .1 .1", LAMP, &[&grey]);
    let words = "the exposure of -6 stops leaves 0.5521 at 2 of 255";
    check(
        format!("{lit}// render: exposure -6\n"),
        "underexposed",
        words,
    );
    let dark = ray("0 0 0", LAMP, &[&grey]) + "// render: exposure -12\n";
    let words = explain(Language::Ray, &dark, [20, 15], PLAIN);
    assert_eq!(words.verdicts.len(), 1, "no surface is to blame");
    check(
        format!("{lit}// render: exposure 6\n"),
        "too-bright",
        "above 1",
    );
    let far = ray("0 0 0", "30 30 60 1 1 1", &[&grey]);
    check(far.clone(), "ordinary", "lit by light 1");
    let words = "by `falloff square`";
    check(
        format!("{far}// render: falloff square\n"),
        "attenuated",
        words,
    );
}
