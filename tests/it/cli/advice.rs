//! What is said of a picture that is black or overexposed, by every command that looks at one.

use super::*;

/// A box open in front, whose walls send back more than they receive.
const GROWING: &str = r#"<xml><scene><object>
<object type="plane" material="w"><scale value="4"/><translate z="-4"/></object>
<object type="plane" material="w"><scale value="4"/><rotate y="1" angle="90"/><translate x="-4"/></object>
<object type="plane" material="w"><scale value="4"/><rotate y="1" angle="-90"/><translate x="4"/></object>
<object type="plane" material="w"><scale value="4"/><rotate x="1" angle="-90"/><translate y="-4"/></object>
<object type="plane" material="w"><scale value="4"/><rotate x="1" angle="90"/><translate y="4"/></object>
</object><material type="blinn" name="w"><diffuse value=".9"/><specular value=".7"/></material>
<light type="point"><intensity value="5"/><position y="3.4"/></light></scene>
<render integrator="path" falloff="square"/>
<camera><position z="12"/><target/><fov value="42"/><width value="80"/><height value="60"/></camera></xml>"#;

/// A white ball on white ground under a white sky.
const WHITE: &str = r#"<xml><scene><object type="plane" material="w"><scale value="60"/></object>
<object type="sphere" material="w"><translate z="1"/></object>
<material type="blinn" name="w"><diffuse value="1"/><specular value=".05"/></material>
<background value="1"/><environment value="1"/></scene><render integrator="path"/>
<camera><position y="-9" z="4"/><target z=".7"/><up z="1"/><fov value="30"/>
<width value="80"/><height value="60"/></camera></xml>"#;

/// A ball in front of a black background, lit by a light; settings come before.
fn ball(settings: &str, light: &str) -> String {
    format!(
        "// render: {settings}\n// view: eye 0 0 9 size 80 60 fov 30\n0 0 0 1 {light}\n\
         1 sphere 0 0 0 1  0 0 0 .7 .7 .7  .2 .2 .2 20 0 0 1\n"
    )
}

/// The notes of a command, which succeeds.
fn notes(place: &Place, line: &str) -> Vec<String> {
    let said = place.stderr(line, 0);
    let notes = said.lines().filter_map(|line| line.strip_prefix("note: "));
    notes.map(str::to_owned).collect()
}

/// The same advice of every command, for any number of samples, at half the size and by any seed.
#[test]
fn a_picture_is_judged_alike_by_every_command() {
    let overexposed = "more than half of the picture is above 1; try";
    let place = Place::new();
    for (name, text, expected) in [
        ("growing.xml", GROWING, format!("{overexposed} `--depth 2`")),
        ("white.xml", WHITE, format!("{overexposed} `--depth 1`")),
        (
            "dim.ray",
            &ball("exposure -6", "5 5 9 1 1 1"),
            "the picture is almost black (brightest value 3 of 255); try `--exposure 0`".to_owned(),
        ),
        (
            "far.ray",
            &ball("falloff square", "50 50 90 1 1 1"),
            "the picture is black; try `--falloff none`".to_owned(),
        ),
        (
            "bright.ray",
            &ball("exposure 0", "5 5 9 90 90 90").replace("fov 30", "fov 9"),
            format!("{overexposed} `--exposure -6.5`"),
        ),
    ] {
        place.write(name, text);
        assert_eq!(
            notes(&place, &format!("check {name}")),
            [format!("{name}: {expected}")]
        );
        for more in [
            "",
            "--spp 1",
            "--spp 64 --seed 7",
            "--size 40x30",
            "--strict",
        ] {
            // Sums above 1 are warnings.
            if (name, more) != ("growing.xml", "--strict")
                && (name, more) != ("white.xml", "--strict")
            {
                let line = format!("render {name} -o a.png {more}");
                assert_eq!(notes(&place, &line), [&*expected], "{line}");
            }
        }
        if !text.starts_with("<xml>") {
            let line = format!("explain {name} 40 30");
            assert_eq!(notes(&place, &line), [&*expected], "{line}");
        }
        // What helps leaves nothing to be said.
        let cure = expected.rsplit('`').nth(1).expect("a setting");
        let line = format!("render {name} -o a.png {cure}");
        assert_eq!(notes(&place, &line), [""; 0], "{line}");
    }
}

/// Why a picture is black that no render setting mends.
#[test]
fn the_cause_of_a_black_picture_is_named() {
    let place = Place::new();
    let away = "<xml><scene>\n<object type='sphere' material='m'/><material name='m'/>\n\
                <light type='direct' name='d'><intensity/><direction z='1'/></light>\n\
                </scene><camera><position z='9'/></camera></xml>";
    place.write("away.xml", away);
    let cause = "the picture is black: everything in view faces away from d (direct, line 3); turn \
                 the direction of d (direct, line 3), or add a light  [away.xml:3:";
    for line in [
        "check away.xml",
        "render away.xml -o a.png",
        "explain away.xml 100 75",
    ] {
        let notes = notes(&place, line);
        assert!(notes.len() == 1 && notes[0].contains(cause), "{notes:?}");
    }
    place.write("behind.ray", ball("spp 1", "0 0 -9 1 1 1"));
    let cause = "the picture is black: everything in view faces away from light 1 (line 3); move \
                 light 1 (line 3) to the camera's side, or add a light  [";
    let found = notes(&place, "render behind.ray -o a.png");
    assert!(found.len() == 1 && found[0].contains(cause), "{found:?}");
    place.write("in.ray", ball("spp 1", "0 .5 0 1 1 1"));
    let warning =
        "in.ray:3:9: light 1 is inside object 1 (sphere), which is opaque: the picture is black";
    for line in ["check in.ray", "render in.ray -o a.png"] {
        let said = place.stderr(line, 0);
        assert!(said.contains(warning), "{said}");
        let says_why = "the picture is black; the warnings above say why\n";
        assert_eq!(said.matches(says_why).count(), 1, "{said}");
    }
}

/// The view in effect is judged, not that of the text.
#[test]
fn the_view_of_an_option_is_judged() {
    let place = Place::new();
    place.write(
        "far.dat",
        "camera perspective 0 -9 0  0 0 0  0 0 1  1 0 4\nresolution .01 .01\nviewport 80 60\n\
         light ID 0 amb 0 0 0  0 0 0  1 1 1  0 0 0  0 shadow_off\n\
         mat ID 0  1 1 1  .9 0 0 1  0 0 1\nobj sphere ID 0 mat ID 0  0 0 0 1\n",
    );
    let far = "every object is beyond the far limit: the picture is black";
    for (command, is_said) in [
        (&["render", "far.dat", "-o", "a.png"][..], true),
        (
            &[
                "render", "far.dat", "-o", "a.png", "--strict", "--view", "far 99",
            ],
            false,
        ),
        (
            &[
                "explain", "far.dat", "40", "30", "--strict", "--view", "far 99",
            ],
            false,
        ),
        (
            &[
                "compare", "far.dat", "far.dat", "--strict", "--view", "far 99",
            ],
            false,
        ),
        (&["check", "far.dat"], true),
    ] {
        let mut ran = place.command("");
        let ran = ran.args(command).output().expect("it starts");
        let said = String::from_utf8_lossy(&ran.stderr);
        assert_eq!(ran.status.code(), Some(0), "{said}");
        assert_eq!(said.contains(far), is_said, "{command:?}: {said}");
    }
}

#[test]
fn nothing_is_named_that_does_not_help() {
    let place = Place::new();
    // Darkened until it is not too bright, all of it would be alike.
    let wall = "// view: eye 0 0 9 size 80 60 fov 3\n0 0 0 1 0 0 9 9 9 9\n\
                1 box -9 -9 -1  1 0 0  0 1 0  0 0 1  18 18 1  0 0 0 .7 .7 .7  0 0 0 1  0 0 1\n";
    place.write("wall.ray", wall);
    let expected = "more than half of the picture is above 1; no single render setting fixes that";
    assert_eq!(notes(&place, "render wall.ray -o a.png"), [expected]);
    assert_eq!(
        notes(&place, "check wall.ray"),
        [format!("wall.ray: {expected}")]
    );
}
