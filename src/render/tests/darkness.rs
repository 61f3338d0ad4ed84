//! Pictures of which their texts say that they can only be black.

use super::*;
use language::{Prospect, outlook};
use scene::{Rendering, Viewpoint};

/// Solids by a light: material 0 lets light through, material 1 blocks it.
fn dat(near: &str, shadow: &str, rest: &str) -> String {
    format!(
        "camera perspective 0 -9 0  0 0 0  0 0 1  1 {near} 100\nresolution .1 .1\nviewport 8 6\n\
         light ID 0 pnt {shadow}\nmat ID 0  1 1 1  .1 .5 0 1  .9 0 1\n\
         mat ID 1  1 1 1  .1 .9 0 1  0 0 1\n{rest}"
    )
}

/// A light in the middle that casts shadows, and one that does not.
const CAST: &str = "0 0 0  0 0 0  1 1 1  1 0 0  0 shadow_on";
const OFF: &str = "0 0 0  0 0 0  1 1 1  1 0 0  0 shadow_off";

const OPAQUE: &str = "obj sphere ID 0 mat ID 1  0 0 0  2\n";

/// Solids of two materials whose first is the opaque one.
const CORE: &str = "obj sphere ID 1 mat ID 0  0 0 0  2\nobj sphere ID 0 mat ID 1  0 0 1  .5\n\
                    obj sphere ID 3 mat ID 1  2.5 -2 0  1\n\
                    obj CSG ID 2 union ID 0 ID 1\nrender 2 ID 2 ID 3\n";

/// The same of one material.
const OPAQUE_CORE: &str = "obj sphere ID 1 mat ID 1  0 0 0  2\nobj sphere ID 0 mat ID 1  0 0 1  .5\n\
                           obj CSG ID 2 union ID 0 ID 1\nrender 1 ID 2\n";

/// Matt objects seen from (0, 0, 5) along −z.
fn seen(scene: &str) -> String {
    format!(
        "<xml><scene>{scene}<material name='matt'><specular value='0'/></material>\
         <material name='lamp'><emission value='2'/></material></scene>\
         <camera><position z='5'/><target/><width value='8'/><height value='6'/></camera></xml>"
    )
}

const LIGHT: &str = "<light type='point'><intensity/><position z='99'/></light>";
const ROOM: &str =
    "<object type='sphere' material='matt'><scale value='8'/><translate z='5'/></object>";
const BEHIND: &str = "<object type='sphere' material='matt'><translate z='9'/></object>";
const BLUE: &str = "<background b='1'/>";

fn asked(scene: &Scene, integrator: Integrator) -> Rendering {
    let over = Rendering {
        integrator: Some(integrator),
        ..Rendering::default()
    };
    over.or(scene.setting.rendering)
}

/// Checks whether a picture is said to be black, by both integrators, and that it is black if so.
#[track_caller]
fn check(language: Language, text: &str, view: &str, is_said: bool) {
    let mut source = Source::new(language, Arc::new(text.to_owned()));
    let lowered = source.lower(&Meshes::default()).expect("there is memory");
    let scene = lowered.scene.expect(text);
    let view = Viewpoint::parse(view).expect("a view");
    let camera = view.of(&scene.camera).expect("a camera");
    for integrator in [Integrator::Whitted, Integrator::Path] {
        let found = outlook(&source, &scene, &camera, &asked(&scene, integrator));
        let said = found.iter().any(|found| found.prospect == Prospect::Black);
        assert_eq!(said, is_said, "{integrator:?} of {view} {text}");
        let settings = Settings {
            integrator,
            ..settings(8, 6, 1)
        };
        let job = Job {
            camera,
            frames: Frames::LastWithValues,
            ..job(&Arc::new(scene.clone()), settings)
        };
        let (mut renderer, woken) = renderer(1);
        let generation = restart(&mut renderer, job);
        let frame = finish(&renderer, &woken, generation);
        let is_black = frame.values.iter().flatten().all(|&value| value == 0.0);
        assert!(is_black || !said, "{integrator:?} of {view} {text}");
    }
}

#[test]
fn lights_are_sealed_by_what_lets_nothing_out() {
    for (near, light, solids, is_said) in [
        ("0", CAST, OPAQUE, true),
        ("0", OFF, OPAQUE, false),
        ("1", CAST, OPAQUE, true),
        // Rays start within.
        ("10", CAST, OPAQUE, false),
        ("0", CAST, CORE, false),
        ("0", CAST, OPAQUE_CORE, true),
    ] {
        check(Language::Dat, &dat(near, light, solids), "", is_said);
    }
    // The surface of the glass is lit within, and seen.
    let glass =
        "<object type='sphere' material='glass'/><material name='glass'><specular value='0'/>
        <refraction value='.9' index='1.5'/></material><light type='point'><intensity/></light>";
    check(Language::Xml, &seen(glass), "", false);
}

#[test]
fn cameras_are_enclosed_by_what_lets_nothing_in() {
    let outside = |light: &str| light.replacen("0 0 0", "0 -40 0", 1);
    for (light, solids, view, is_said) in [
        (CAST, OPAQUE, "eye 0 -1 0", true),
        (OFF, OPAQUE, "eye 0 -1 0", false),
        (CAST, OPAQUE_CORE, "eye 0 -1 0", true),
        (CAST, CORE, "eye 0 -1 0", false),
        // All of the solid is before the near limit.
        (CAST, OPAQUE, "eye 0 -1 0 near 4", true),
        // Starts beyond the solid.
        (CAST, OPAQUE, "eye 0 -1 0 lens 4", false),
        (CAST, OPAQUE, "eye 0 -1 0 lens .1", true),
    ] {
        let text = dat("0", &outside(light), solids);
        check(Language::Dat, &text, view, is_said);
    }
    let lit = |more: &str| seen(&format!("{ROOM}{LIGHT}{more}"));
    let glow = "<object type='sphere' material='lamp'/>";
    let ball = "<light type='point'><intensity/><position z='-4'/><size value='2'/></light>";
    for (more, view, is_said) in [
        ("", "", true),
        // Parallel rays start beyond the room.
        ("", "height 20", false),
        ("", "height 2", true),
        (BLUE, "", true),
        (BLUE, "far 2", false),
        ("", "far 2", true),
        (glow, "", false),
        (
            &glow.replace("/>", "><translate z='40'/></object>"),
            "",
            true,
        ),
        (ball, "", false),
        (&ball.replace("-4", "-40"), "", true),
    ] {
        check(Language::Xml, &lit(more), view, is_said);
    }
}

#[test]
fn views_without_an_object_are_black_before_black() {
    let ball = "<light type='point'><intensity/><size value='1'/></light>";
    for (scene, is_said) in [
        (format!("{BEHIND}{LIGHT}"), true),
        (format!("{BEHIND}{LIGHT}{BLUE}"), false),
        (format!("{BEHIND}{LIGHT}<environment b='1'/>"), true),
        (format!("{BEHIND}{LIGHT}{ball}"), false),
        (LIGHT.to_owned(), true),
        (format!("{LIGHT}{BLUE}"), false),
        (ball.to_owned(), false),
    ] {
        check(Language::Xml, &seen(&scene), "", is_said);
    }
}

#[test]
fn scenes_without_light_are_black() {
    for (scene, is_said) in [
        (ROOM.to_owned(), true),
        (format!("{BEHIND}{BLUE}"), false),
        (ROOM.replace("matt", "lamp"), false),
    ] {
        check(Language::Xml, &seen(&scene), "", is_said);
    }
}
