//! `compare`: pictures and scenes, figures and exit codes.

use super::*;

/// Two pictures of 3 × 1 pixels, which differ in the second by 5 levels of green.
const MINE: &[u8] = b"P6\n3 1\n255\n\x01\x02\x03\x10\x20\x30\xff\xff\xff";
const THEIRS: &[u8] = b"P6\n3 1\n255\n\x01\x02\x03\x10\x25\x30\xff\xff\xff";

fn pictures() -> Place {
    let place = Place::new();
    place.write("mine.ppm", MINE);
    place.write("theirs.ppm", THEIRS);
    place
}

/// What a comparison prints without notes, and its exit code.
fn compared(place: &Place, words: &str) -> (String, Option<i32>) {
    let (printed, notes, code) = noted(place, words);
    assert_eq!(notes, "", "{words}");
    (printed, code)
}

/// What a comparison prints, its notes, and its exit code.
fn noted(place: &Place, words: &str) -> (String, String, Option<i32>) {
    let ran = place.run(&format!("compare {words}"));
    let [printed, notes] =
        [ran.stdout, ran.stderr].map(|text| String::from_utf8(text).expect("text"));
    (printed, notes, ran.status.code())
}

#[test]
fn differences_are_counted_and_listed() {
    // MSE = 5² / 9; PSNR = 10 log₁₀(255² / MSE).
    let table = "\
size              3x1
differing pixels  1 of 3 (33.33 %)
largest           5 of 255
MSE               2.7778
PSNR              43.69 dB
SSIM              none: below 11 pixels wide or high
";
    let (printed, code) = compared(&pictures(), "mine.ppm theirs.ppm");
    assert_eq!(code, Some(1));
    assert!(printed.starts_with(table), "{printed}");
    let worst = "worst pixels      1,0          16  32  48    16  37  48\n\
                 mine.ppm and theirs.ppm are different\n";
    assert!(printed.ends_with(worst), "{printed}");
}

#[test]
fn the_exit_code_is_1_for_a_difference_and_nothing_else() {
    let place = pictures();
    for (words, expected) in [
        ("mine.ppm mine.ppm", 0),
        ("mine.ppm theirs.ppm", 1),
        ("mine.ppm theirs.ppm --tolerance 4", 1),
        ("mine.ppm theirs.ppm --tolerance 5", 0),
        ("mine.ppm theirs.ppm --max-differing 1", 0),
    ] {
        assert_eq!(compared(&place, words).1, Some(expected), "{words}");
    }
    place.write("broken.ray", "1 1 1 1");
    place.write("broken.ppm", "P6 3 1 255 x");
    for (words, code, reason) in [
        ("mine.ppm none.ppm", 66, "none.ppm: no such file"),
        (
            "mine.ppm broken.ppm",
            65,
            "broken.ppm is not a valid picture",
        ),
        ("mine.ppm broken.ray", 65, "broken.ray:1:7"),
        ("mine.ppm theirs.ppm -o none/d.png", 73, "no such folder"),
        (
            "mine.ppm theirs.ppm -o mine.ppm",
            2,
            "cannot overwrite mine.ppm",
        ),
        ("mine.ppm theirs.ppm -o d.exr", 2, "8 bits per channel"),
        ("mine.ppm theirs.ppm --tolerance 256", 2, "--tolerance"),
    ] {
        let errors = place.stderr(&format!("compare {words}"), code);
        assert!(errors.contains(reason), "{words}: {errors}");
    }
}

#[test]
fn a_scene_is_traced_at_the_size_of_the_picture() {
    let place = Place::new();
    place.run("render ball.ray -o ball.bmp --size 16x12 --spp 2");
    place.write(
        "dimmer.ray",
        BALL.replace("1 1 1\n1 0 9", ".5 .5 .5\n1 0 9"),
    );
    let assumed = |picture: &str, size: &str, spp: u32| {
        format!(
            "note: {picture} records no settings: ball.ray is traced with size {size}, depth 8, seed \
             0, integrator whitted, filter box, transfer linear, exposure 0, falloff none, gloss \
             none, spp {spp}; options such as --spp change them\n"
        )
    };
    let its_size = "note: ball.ray is traced at 16x12, the size of the picture; its own is 8x6\n";
    let undrawn = "note: c.png is not written: pictures of different sizes have no differences to \
                   draw\n";
    for (words, code, size, told) in [
        (
            "ball.bmp ball.ray --spp 2",
            0,
            "16x12",
            format!("{its_size}{}", assumed("ball.bmp", "16x12", 2)),
        ),
        (
            "ball.ray ball.bmp --spp 2",
            0,
            "16x12",
            format!("{its_size}{}", assumed("ball.bmp", "16x12", 2)),
        ),
        ("ball.ray dimmer.ray", 1, "8x6", String::new()),
        ("ball.ray ball.ray --size 20x10", 0, "20x10", String::new()),
        (
            "ball.bmp ball.ray --size 4x3",
            1,
            "16x12 and 4x3",
            assumed("ball.bmp", "4x3", 16),
        ),
        (
            "ball.bmp ball.ray --size 4x3 -o c.png",
            1,
            "16x12 and 4x3",
            format!("{}{undrawn}", assumed("ball.bmp", "4x3", 16)),
        ),
    ] {
        let (printed, notes, found) = noted(&place, words);
        assert_eq!((found, notes), (Some(code), told), "{words}: {printed}");
        let first = format!("size              {size}\n");
        assert!(printed.starts_with(&first), "{words}: {printed}");
    }
}

#[test]
fn a_file_that_a_scene_uses_is_never_overwritten() {
    let place = Place::new();
    place.write("a.dat", TEXTURED);
    place.write("skin.ppm", SKIN);
    let refused = "cannot overwrite skin.ppm: a.dat uses it";
    let errors = place.stderr("compare a.dat a.dat --spp 1 -o skin.ppm", 2);
    assert!(errors.contains(refused), "{errors}");
    assert_eq!(place.read("skin.ppm"), SKIN.as_bytes());
}

#[test]
fn figures_are_printed_as_json() {
    let (printed, _) = compared(&pictures(), "mine.ppm theirs.ppm --json --tolerance 5");
    let found: serde_json::Value = serde_json::from_str(&printed).expect("JSON");
    let worst = serde_json::json!([{ "x": 1, "y": 0, "a": [16, 32, 48], "b": [16, 37, 48] }]);
    for (key, value) in [
        ("a", "mine.ppm".into()),
        ("b", "theirs.ppm".into()),
        ("alike", true.into()),
        ("size", vec![3, 1].into()),
        ("tolerance", 5.into()),
        ("max_differing", 0.into()),
        ("differing", 0.into()),
        ("largest", 5.into()),
        ("mse", (25.0 / 9.0).into()),
        ("ssim", serde_json::Value::Null),
        ("worst", worst),
    ] {
        assert_eq!(found[key], value, "{key}");
    }
    assert!(
        found["psnr"].is_f64() && found["flip"].is_f64(),
        "{printed}"
    );
}

#[test]
fn differences_are_drawn() {
    let place = pictures();
    compared(&place, "mine.ppm theirs.ppm -o drawn.ppm");
    let drawn = place.read("drawn.ppm");
    let pixels = drawn.strip_prefix(b"P6\n3 1\n255\n").expect("a picture");
    let is_black = [0, 3, 6].map(|at| pixels[at..at + 3] == [0; 3]);
    assert_eq!(is_black, [true, false, true], "{pixels:?}");
    let (_, notes, code) = noted(&place, "mine.ppm mine.ppm -o same.ppm");
    let expected = "note: no differences: same.ppm is black\n";
    assert_eq!((&*notes, code), (expected, Some(0)));
}
