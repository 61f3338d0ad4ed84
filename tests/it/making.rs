//! Rendering options, for every language.

use std::fs;
use std::process::{Command, Stdio};

/// A ball in every language.
const BALLS: [(&str, &str); 3] = [
    (
        "ball.ray",
        "\
1 1 1
1 0 9 0 0 0 0
1 sphere 0 0 0 1  1 1 1 0 0 0 0 0 0 1 0 0 1
// view: eye 0 0 5 target 0 0 0 up 0 1 0 fov 40 size 8 6
",
    ),
    (
        "ball.dat",
        "\
camera perspective 0 0 5  0 0 0  0 1 0  1 .1 100
resolution .12 .12
viewport 8 6
light ID 1 amb 0 0 0  0 0 0  1 1 1  1 0 0 0 shadow_off
mat ID 1  1 1 1  1 0 0 1  0 0 1
obj sphere ID 1 mat ID 1  0 0 0  1
render 0
",
    ),
    (
        "ball.xml",
        "\
<xml><scene><object type='sphere'/></scene>
<camera><position z='5'/><fov value='40'/><width value='8'/><height value='6'/></camera></xml>
",
    ),
];

#[test]
fn rendering_options_apply_to_every_language() {
    let place = tempfile::tempdir_in(env!("CARGO_TARGET_TMPDIR")).expect("a directory");
    for (name, text) in BALLS {
        fs::write(place.path().join(name), text).expect("written");
        let made = |options: &str| {
            let line = format!("render {name} -o - --format ppm --size 40x30 --spp 4 {options}");
            let output = Command::new(env!("CARGO_BIN_EXE_halflight"))
                .args(line.split_ascii_whitespace())
                .current_dir(place.path())
                .stdin(Stdio::null())
                .output()
                .expect("it starts");
            let stderr = String::from_utf8(output.stderr).expect("UTF-8");
            // The only light is off, which matters where ambient light is dropped.
            let is_dark = options == "--integrator path" && name != "ball.xml";
            assert!(output.status.success(), "{line}: {stderr}");
            assert_eq!(stderr.contains("light"), is_dark, "{line}: {stderr}");
            assert_eq!(stderr.is_empty(), !is_dark, "{line}: {stderr}");
            output.stdout
        };
        let plain = made("");
        assert!(
            made("--integrator whitted --depth 8 --filter box") == plain,
            "{name}"
        );
        // The ball shows only ambient light, which path tracing drops and which is not part of its
        // albedo; or it is white regardless of light.
        let header = plain.len() - 3 * 40 * 30;
        let mut unlit = plain.clone();
        if name != "ball.xml" {
            unlit[header..].fill(0);
        }
        assert!(made("--integrator path") == unlit, "{name}");
        assert!(made("--aov albedo") == unlit, "{name}");
        let others = ["filter gaussian", "filter blackman-harris", "aov depth"]
            .into_iter()
            .chain(["aov normal", "aov object"]);
        let mut seen = vec![plain];
        for other in others {
            let picture = made(&format!("--{other}"));
            assert!(!seen.contains(&picture), "{name} {other}");
            seen.push(picture);
        }
    }
}
