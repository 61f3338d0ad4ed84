//! Scenes in other languages: the text to the letter, and what is lost with its place.

use std::f64::consts::PI;
use std::fmt::Write;
use std::sync::Arc;

use super::read_as;
use crate::{Converted, Language, convert};
use scene::{Emitter, FalloffRule, Meshes, Object, Rgb};
use text::Position;

const RAY: &str = r#"// view: eye 0 0 9 target 0 0 0 up 0 1 0 fov 40 size 8 6
1 1 1
1 0 5 5 1 1 1 // a lamp
2
sphere // "a" --> <b>
0 0 0 1  0.1 0.1 0.1 0.5 0.5 0.5 0 0 0 1 0 0 1
cone 3 0 0  1 0 0 0 1 0 0 0 1  1 1 2  0.1 0.1 0.1 0.2 0.1 0.1 0.5 0.5 0.5 9 0.5 0 1
// view top: eye 0 9 0 target 0 0 0 fov 40
"#;

const DAT: &str = r#"camera orthographic 0 -9 0  0 0 0  0 0 1  1 1 100
resolution 0.5 0.5
viewport 8 6
# a "spot"
light ID 7 pnt 0 -5 5  0 1 -1  1 1 1  1 0 0.25  4 shadow_off
mat ID 3  1 0.5 0.25  0.1 0.5 0.4 9  0 0 0
obj sphere ID 4 mat ID 3  0 0 0  1
obj box ID 5 mat ID 3  0 0 0  1 0 0  0 1 0  0 0 1  1 1 1
obj CSG ID 6 difference ID 5 ID 4
texture ID 1 checker 2 2  1 1 1  0 0 0
use colour ID 1 mat ID 3
"#;

const XML: &str = r#"<xml>
  <scene>
    <background value="0.5"/>
    <object type="plane" name="a &quot;b&quot; &#10; --&gt;" material="m"><rotate x="1" angle="90"/></object>
    <object type="sphere"><scale x="1" y="2" z="3"/><rotate z="1" angle="30"/></object>
    <material name="m" type="blinn"><reflection r="0.5" g="0.25" b="0"/></material>
    <light type="point" name="lamp"><intensity value="0.5"/><attenuation value="2"/><position z="3"/></light>
  </scene>
  <camera><position z="9"/><target/><dof value="0.1"/><width value="8"/><height value="6"/></camera>
</xml>
"#;

/// Converts a text; returns the new one and the losses as lines: `2:7 light 1: a spot light`.
fn converted(from: Language, text: &str, to: Language) -> (Arc<String>, Vec<String>) {
    let (source, lowered) = read_as(from, text, &Meshes::default());
    let scene = lowered.scene.expect("it has no errors");
    let Converted {
        text: written,
        losses,
    } = convert(&source, &scene, to).expect("there is memory");
    let lines = losses.iter().map(|loss| {
        let Position { line, column } = Position::of(text, loss.span.start());
        assert!(!loss.is_error() && loss.hint.is_some(), "{loss:?}");
        format!("{line}:{column} {}", loss.message)
    });
    (written, lines.collect())
}

/// Checks a conversion. An expected text that is empty stands for any.
fn check((from, text): (Language, &str), to: Language, expected: &str, losses: &[&str]) {
    let (written, lost) = converted(from, text, to);
    assert_eq!(lost, losses, "{written}");
    if !expected.is_empty() {
        assert_eq!(*written, expected);
    }
    let (_, lowered) = read_as(to, &written, &Meshes::default());
    assert_eq!(*lowered.diagnostics, [], "{written}");
}

#[test]
fn ray_becomes_dat() {
    check(
        (Language::Ray, RAY),
        Language::Dat,
        r#"camera perspective  0 0 9  0 0 0  0 1 0  1 0 1e30
resolution 0.12132341142206744 0.12132341142206744
viewport 8 6

light ID 1 amb  0 0 0  0 0 0  1 1 1  1 0 0  0 shadow_off
# a lamp
light ID 2 pnt  0 5 5  0 0 0  1 1 1  1 0 0  0 shadow_on

# "a" --> <b>
mat ID 1  1 1 1  0.1 0.5 0 1  0 0 1
mat ID 2  0.2 0.1 0.1  0.6666666666666666 1 3.333333333333333 9  0 0.5 1

# "a" --> <b>
obj sphere ID 1 mat ID 1  0 0 0  1
obj quadric ID 2 mat ID 2  1 0 0 -3 1 0 0 -0.25 0.5 8  2  0 0 -0.5 0  0 0 0.5 1
# view top: eye 0 9 0 target 0 0 0 up 0 1 0 fov 40
"#,
        &[
            "7:1 object 2 (cone): a cone",
            "7:39 object 2 (cone): ambient, diffuse and specular colours that are not multiples of one another",
        ],
    );
}

#[test]
fn ray_becomes_xml() {
    check(
        (Language::Ray, RAY),
        Language::Xml,
        r#"<xml>
  <scene>
    <object type="sphere" name="&quot;a&quot; --> &lt;b>" material="&quot;a&quot; --> &lt;b>"/>
    <object type="sphere" material="material 2">
      <translate x="3" y="0" z="1"/>
    </object>
    <material type="phong" name="&quot;a&quot; --> &lt;b>">
      <diffuse value="0.5"/>
      <specular value="0"/>
      <glossiness value="1"/>
      <emission value="0.1"/>
    </material>
    <material type="phong" name="material 2">
      <diffuse r="0.2" g="0.1" b="0.1"/>
      <specular value="0.5"/>
      <glossiness value="9"/>
      <reflection value="0.5"/>
      <emission value="0.1"/>
    </material>
    <light type="point" name="a lamp">
      <intensity value="1"/>
      <position x="0" y="5" z="5"/>
    </light>
  </scene>

  <camera>
    <position x="0" y="0" z="9"/>
    <target x="0" y="0" z="0"/>
    <up x="0" y="1" z="0"/>
    <fov value="40"/>
    <width value="8"/>
    <height value="6"/>
  </camera>
</xml>
<!-- view top: eye 0 9 0 target 0 0 0 up 0 1 0 fov 40 -->
"#,
        &[
            "6:10 object 1 (sphere): an ambient colour other than the diffuse one",
            "7:1 object 2 (cone): a cone",
            "7:39 object 2 (cone): an ambient colour other than the diffuse one",
            "7:63 object 2 (cone): a highlight that is as strong at grazing angles",
            "7:77 object 2 (cone): a mirror on both faces",
        ],
    );
}

#[test]
fn dat_becomes_ray() {
    check(
        (Language::Dat, DAT),
        Language::Ray,
        r#"// view: eye 0 -9 0 target 0 0 0 up 0 0 1 fov 18.924644416051233 size 8 6

0 0 0  // ambient light

1  // lights: position, colour
0 -5 5  0.07407407407407407 0.07407407407407407 0.07407407407407407  // a "spot"

1  // objects

box
-0.5 -0.5 -0.5  1 0 0  0 1 0  0 0 1  1 1 1
0.1 0.05 0.025  0.5 0.25 0.125  0.4 0.2 0.1  9  0 0 1
"#,
        &[
            "1:8 view: an orthographic camera",
            "1:45 view: a near limit",
            "5:39 light 7: light that fades with distance",
            "5:49 light 7: a spot light",
            "5:51 light 7: light without shadows",
            "6:1 material 3: textures",
            "9:14 object 6 (CSG): a combination of solids",
        ],
    );
}

#[test]
fn dat_becomes_xml() {
    check(
        (Language::Dat, DAT),
        Language::Xml,
        "",
        &[
            "1:8 view: an orthographic camera",
            "1:45 view: a near limit",
            "5:39 light 7: light that fades with distance",
            "5:49 light 7: a spot light",
            "5:51 light 7: light without shadows",
            "6:1 material 3: the squares that the lines of a checkerboard belong to",
            "6:31 material 3: a highlight that is as strong at grazing angles",
            "9:1 object 6 (CSG): a box",
            "9:14 object 6 (CSG): a combination of solids",
        ],
    );
}

#[test]
fn xml_becomes_ray() {
    check(
        (Language::Xml, XML),
        Language::Ray,
        r#"// view: eye 0 0 9 target 0 0 0 up 0 1 0 fov 40 size 8 6

1 1 1  // ambient light

1  // lights: position, colour
0 0 3  0.013888888888888888 0.013888888888888888 0.013888888888888888  // lamp

2  // objects

box  // a "b" \n -->
-1 0 -1  0 0 1  1 0 0  0 1 0  2 2 0.0002
0 0 0  0.5 0.5 0.5  0.7 0.7 0.7  5  0.25 0 1

ellipsoid
0 0 0  0.8660254037844387 0.49999999999999994 0  -0.49999999999999994 0.8660254037844387 0  0 0 1  1 2 3
1 1 1  0 0 0  0 0 0  0  0 0 1
"#,
        &[
            "3:24 background: a background that is not black",
            r#"4:19 a "b" \n --> (plane): a square without thickness"#,
            "5:5 object 2 (sphere): emitted light",
            "6:5 m (blinn): a blinn highlight",
            "6:52 m (blinn): a mirror on front faces only",
            "6:52 m (blinn): a coloured mirror",
            "7:81 lamp (point): light that fades with distance",
            "9:49 view: depth of field",
        ],
    );
}

#[test]
fn xml_becomes_dat() {
    check(
        (Language::Xml, XML),
        Language::Dat,
        r#"camera perspective  0 0 9  0 0 0  0 1 0  1 0 1e30
resolution 0.12132341142206744 0.12132341142206744
viewport 8 6

light ID 1 amb  0 0 0  0 0 0  1 1 1  1 0 0  0 shadow_off
# lamp
light ID 2 pnt  0 0 3  0 0 0  0.5 0.5 0.5  0 0 4  0 shadow_on

# m
mat ID 1  1 1 1  0 0.5 0.7 5  0 0.25 1
mat ID 2  1 1 1  1 0 0 0  0 0 1

# a "b" \n -->
obj box ID 1 mat ID 1  0 0.0001 0  0 0 1  1 0 0  0 1 0  2 2 0.0002
obj quadric ID 2 mat ID 2  0.8125000000000001 0.3247595264191645 0 0 0.4375 0 0 0.1111111111111111 0 -1  0
"#,
        &[
            "3:24 background: a background that is not black",
            r#"4:19 a "b" \n --> (plane): a square without thickness"#,
            "5:5 object 2 (sphere): emitted light",
            "5:5 object 2 (sphere): an ellipsoid that is turned",
            "6:5 m (blinn): a blinn highlight",
            "6:52 m (blinn): a mirror on front faces only",
            "6:52 m (blinn): a coloured mirror",
            "9:49 view: depth of field",
        ],
    );
}

#[test]
fn the_same_language_is_copied() {
    for (language, text) in [
        (Language::Ray, RAY),
        (Language::Dat, DAT),
        (Language::Xml, XML),
    ] {
        let (written, losses) = converted(language, text, language);
        assert_eq!((&**written, losses), (text, Vec::new()));
    }
}

#[test]
fn a_scene_without_objects_and_lights_can_be_written() {
    let empty = "<xml><scene/><camera><position z='5'/></camera></xml>";
    for (to, losses) in [
        (Language::Ray, vec!["1:14 view: a scene without objects"]),
        (Language::Dat, Vec::new()),
    ] {
        let (written, lost) = converted(Language::Xml, empty, to);
        assert_eq!(lost, losses, "{written}");
        let (_, lowered) = read_as(to, &written, &Meshes::default());
        assert_eq!(lowered.diagnostics.errors(), 0, "{written}");
    }
}

/// What a text calls things can be anything, and stays a name or a comment.
#[test]
fn names_cannot_break_the_text() {
    for name in [
        "--&gt; <!--".replace('<', "&lt;"),
        "a&#10;sphere 0 0 0 1".to_owned(),
        "a&#13;obj sphere".to_owned(),
        "view: eye 1 2 3".to_owned(),
        "view a: eye 1 2 3 target 0 0 0".to_owned(),
        "Render: depth 1".to_owned(),
        "é &quot; &apos; &amp; // # \\\\".to_owned(),
        "  ".to_owned(),
    ] {
        let text = format!(
            "<xml><scene><object type='sphere' name='{name}' material='{name}'/>\
             <material name='{name}'><specular value='0'/></material>\
             <light type='point' name='{name}'><intensity value='1'/><position z='9'/></light>\
             </scene><camera><position z='5'/><target/></camera></xml>"
        );
        for to in [Language::Ray, Language::Dat] {
            let (written, lost) = converted(Language::Xml, &text, to);
            assert_eq!(lost, Vec::<String>::new(), "{written}");
            let (back, lost) = converted(to, &written, Language::Xml);
            assert_eq!(lost, Vec::<String>::new(), "{written}\n{back}");
        }
    }
}

/// Damaged scenes, if they are scenes still, become scenes in every language.
#[test]
fn whatever_has_no_errors_can_be_written() {
    let mut random = super::Random(14);
    let mut written = 0;
    for round in 0..2_000 {
        let (from, text) = [
            (Language::Ray, RAY),
            (Language::Dat, DAT),
            (Language::Xml, XML),
        ][round % 3];
        let (source, _) = read_as(from, text, &Meshes::default());
        let mut text = text.to_owned();
        let words = ["0", "-1", "1e300", "-1e-300", "4e9", "1e22"];
        super::damage(&mut text, &source.leaves(), &words, &mut random);
        let (source, lowered) = read_as(from, &text, &Meshes::default());
        let Some(scene) = lowered.scene else {
            continue;
        };
        for to in Language::ALL {
            let found = convert(&source, &scene, to).expect("there is memory");
            written += usize::from(found.losses.errors() == 0);
        }
    }
    assert!(1_000 < written, "{written}");
}

/// The text grows with the scene, and so does the time.
#[test]
fn thousands_of_objects_are_written() {
    let mut text = "1 1 1 1 0 5 5 1 1 1 5000\n".to_owned();
    for index in 0..5000 {
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "sphere {index} 0 0 0.5 0.1 0.2 0.{index} 0.1 0.2 0.{index} 0 0 0 1 0 0 1"
        );
    }
    for to in [Language::Dat, Language::Xml] {
        let (written, lost) = converted(Language::Ray, &text, to);
        assert_eq!(lost, Vec::<String>::new());
        let (_, lowered) = read_as(to, &written, &Meshes::default());
        let scene = lowered.scene.expect("it has no errors");
        assert_eq!(scene.objects.len(), 5000);
    }
}

#[test]
fn each_of_many_objects_keeps_its_own_material() {
    const COUNT: usize = 2100;
    let mut text = format!("1 1 1  1  0 5 5  1 1 1  {COUNT}\n");
    for number in 0..COUNT {
        // Many objects of one colour, then each its own.
        let red = if number < 1100 {
            number / 500
        } else {
            number % 250
        };
        let colours = format!("0 0 0  0.{red:03} 0 0  0 0 0  1 0 0 1");
        writeln!(text, "sphere {number} 0 0 1  {colours}").expect("a string");
    }
    let colours = |language, text: &str| {
        let (_, lowered) = read_as(language, text, &Meshes::default());
        let scene = lowered.scene.expect("it has no errors");
        let objects = scene.objects.iter();
        let colour = |object: &Object| scene.materials[object.material as usize].diffuse;
        objects.map(colour).collect::<Vec<_>>()
    };
    let own = colours(Language::Ray, &text);
    assert_eq!(own.len(), COUNT);
    for to in [Language::Dat, Language::Xml] {
        let (written, _) = converted(Language::Ray, &text, to);
        assert_eq!(colours(to, &written), own, "{to:?}");
    }
}

/// Where a setting gives lights without terms of their own that falloff.
#[test]
fn a_falloff_by_the_square_is_kept_by_the_setting_for_it() {
    let light = "<light type='point' name='lamp'><intensity value='3'/><position z='9'/>\
                 <attenuation value='1'/></light>";
    let scene = |setting: &str| {
        format!("<xml>{setting}<scene>{light}</scene><camera><width value='8'/></camera></xml>")
    };
    let fading = |text: &str| {
        let (_, lost) = converted(Language::Xml, text, Language::Ray);
        lost.iter()
            .any(|loss| loss.ends_with("light that fades with distance"))
    };
    assert!(fading(&scene("")));
    assert!(!fading(&scene("<render falloff='square'/>")));
    let (written, _) = converted(
        Language::Xml,
        &scene("<render falloff='square'/>"),
        Language::Ray,
    );
    let (_, lowered) = read_as(Language::Ray, &written, &Meshes::default());
    let scene = lowered.scene.expect("it has no errors");
    assert_eq!(scene.lights[0].colour, Rgb::splat(3.0));
    assert_eq!(scene.setting.rendering.falloff, Some(FalloffRule::Square));
}

/// Without it, path tracing multiplies the intensities of lights by π.
#[test]
fn what_gamma_says_of_lights_is_lost_at_its_place() {
    let path =
        "written divided by π: by path tracing it is the same, by Whitted ray tracing darker";
    let whitted = "written as it is: by Whitted ray tracing it is the same, by path tracing brighter by a factor of π";
    for (settings, light, kept, colour) in [
        ("", "point", Some(path), 3.0 / PI),
        (
            "<render integrator='photon'/>",
            "direct",
            Some(path),
            3.0 / PI,
        ),
        (
            "<render integrator='whitted'/>",
            "point",
            Some(whitted),
            3.0,
        ),
        ("", "ambient", None, 3.0),
    ] {
        let text = format!(
            "<xml>\n<camera gamma='sRGB'/>{settings}<scene><light type='{light}'>\
             <intensity value='3'/></light></scene></xml>"
        );
        let (source, lowered) = read_as(Language::Xml, &text, &Meshes::default());
        let scene = lowered.scene.expect("it has no errors");
        let found = convert(&source, &scene, Language::Dat).expect("there is memory");
        let lost = ": light that path tracing does not multiply by π";
        let loss = found
            .losses
            .iter()
            .find(|loss| loss.message.ends_with(lost));
        assert_eq!(loss.and_then(|loss| loss.hint.as_deref()), kept, "{text}");
        let place = loss.map(|loss| loss.span.of(&text));
        assert_eq!(place, kept.map(|_| "sRGB"));
        let (_, lowered) = read_as(Language::Dat, &found.text, &Meshes::default());
        let written = lowered.scene.expect("it has no errors");
        assert_eq!(written.lights[0].colour, Rgb::splat(colour), "{text}");
    }
}

/// Such a light has a radiance that follows from its intensity, so it falls off with the squared distance.
#[test]
fn a_light_with_a_size_under_gamma_is_written_with_a_falloff() {
    for (settings, radial) in [
        ("", [0.0, 0.0, 1.0]),
        ("<render integrator='whitted'/>", [1.0, 0.0, 0.0]),
    ] {
        let text = format!(
            "<xml>\n<camera gamma='sRGB'/>{settings}<scene><light type='point'>\
             <intensity value='30'/><size value='.2'/></light></scene></xml>"
        );
        let (written, _) = converted(Language::Xml, &text, Language::Dat);
        let (_, lowered) = read_as(Language::Dat, &written, &Meshes::default());
        let scene = lowered.scene.expect("it has no errors");
        let Emitter::Point { falloff, .. } = scene.lights[0].emitter else {
            panic!("it is a point light");
        };
        assert_eq!(falloff.radial, radial, "{settings}");
    }
}
