//! What texts show of their pictures: the warnings, with their places, and what comes of them.

use glam::DVec3;

use super::read_as;
use crate::{Language, Node, Prospect, outlook};
use scene::{Camera, Integrator, Meshes, Rendering};
use text::Position;

const LIT: &str = "0 0 0 1 0 5 5 1 1 1\n";
const BALL: &str = "1 sphere 0 0 0 1  .1 .1 .1 .5 .5 .5 0 0 0 1 0 0 1\n";

/// The warnings as `LINE:COLUMN message`, each with what comes of it if that is neither a black picture
/// nor something else.
fn shown(language: Language, text: &str, integrator: Option<Integrator>) -> Vec<String> {
    let (source, lowered) = read_as(language, text, &Meshes::default());
    let scene = lowered.scene.expect("it has no errors");
    let over = Rendering {
        integrator,
        ..Rendering::default()
    };
    let asked = over.or(scene.setting.rendering);
    let found = outlook(&source, &scene, &scene.camera, &asked).into_iter();
    let found = found.map(|found| {
        let Position { line, column } = Position::of(text, found.warning.span.start());
        let prospect = match found.prospect {
            Prospect::Black | Prospect::Other => String::new(),
            prospect => format!(" | {prospect:?}"),
        };
        format!("{line}:{column} {}{prospect}", found.warning.message)
    });
    found.collect()
}

const PATH: Option<Integrator> = Some(Integrator::Path);

#[track_caller]
fn check(language: Language, text: &str, integrator: Option<Integrator>, expected: &[&str]) {
    assert_eq!(shown(language, text, integrator), expected, "{text}");
}

#[test]
fn scenes_with_light_on_something_are_not_warned_of() {
    for integrator in [None, PATH] {
        check(Language::Ray, &format!("{LIT}{BALL}"), integrator, &[]);
        for language in Language::ALL {
            check(language, language.template(), integrator, &[]);
        }
    }
}

#[test]
fn adaptive_sampling_needs_more_samples_than_all_pixels_take() {
    let with = |settings: &str| format!("// render: {settings}\n{LIT}{BALL}");
    let expected = "1:18 `noise 0.01` has no effect: it cannot stop a pixel before 16 samples, and `spp` is 16";
    check(Language::Ray, &with("noise 0.01 spp 16"), None, &[expected]);
    for settings in ["noise 0.01", "noise 0.01 spp 17", "noise 0 spp 16", "spp 1"] {
        check(Language::Ray, &with(settings), None, &[]);
    }
    // Other samples are asked for over the text.
    let text = with("noise 0.01 spp 16");
    let (source, lowered) = read_as(Language::Ray, &text, &Meshes::default());
    let scene = lowered.scene.expect("it has no errors");
    let over = Rendering {
        spp: Some(17),
        ..Rendering::default()
    };
    let asked = over.or(scene.setting.rendering);
    assert_eq!(outlook(&source, &scene, &scene.camera, &asked), []);
}

#[test]
fn what_glows_by_itself_needs_no_light() {
    let text =
        "<xml><scene><object type='sphere'/></scene><camera><position z='9'/></camera></xml>";
    check(Language::Xml, text, None, &[]);
}

#[test]
fn only_what_lights_something_counts_as_light() {
    let xml = |scene: &str| {
        format!(
            "<xml><scene><object type='sphere' material='m'/>{scene}</scene>\n\
                 <camera><position z='9'/></camera></xml>"
        )
    };
    let black = "2:1 the scene has no light: the picture is black";
    let matt = "<material name='m'/>";
    // What no object has does not glow.
    let unused = format!("{matt}<material name='n'><emission value='1'/></material>");
    check(Language::Xml, &xml(&unused), None, &[black]);
    check(Language::Xml, &xml(&unused), PATH, &[black]);
    // The background is seen behind it.
    check(
        Language::Xml,
        &xml(&format!("{matt}<background value='1'/>")),
        None,
        &[],
    );
    // Mirrors and glass show the environment by either integrator.
    for part in [
        "<reflection value='1'/>",
        "<refraction value='1' index='1.5'/>",
    ] {
        let clear = format!(
            "<material name='m'><diffuse value='0'/><specular value='0'/>{part}</material>\
             <environment value='1'/>"
        );
        check(Language::Xml, &xml(&clear), None, &[]);
    }
}

/// How much a texture darkens a surface is not known.
#[test]
fn textured_slots_are_not_part_of_the_sum() {
    let text = "<xml><scene><object type='plane' material='m'/><material name='m'>
        <diffuse texture='checkerboard'><color2 value='.4'/></diffuse><specular value='.2'/></material>
        <light type='direct'><intensity/></light></scene><camera><position z='9'/></camera></xml>";
    check(Language::Xml, text, PATH, &[]);
    let plain = text.replace(" texture='checkerboard'", "");
    assert_eq!(shown(Language::Xml, &plain, PATH).len(), 1);
}

#[test]
fn a_scene_without_light_is_black() {
    let dark = format!("// view: up 0 1 0\n0 0 0 1 0 5 5 0 0 0\n{BALL}");
    let off = "2:9 all lights are off: they emit nothing";
    check(Language::Ray, &dark, None, &[off]);
    check(Language::Ray, &dark, PATH, &[off]);
    let ambient = dark.replacen("0 0 0 1 0", "1 1 1 1 0", 1);
    check(Language::Ray, &ambient, None, &[]);
    check(Language::Ray, &ambient, PATH, &[off]);
    let ball = "<object type='sphere' material='m'/><material name='m'/>";
    let camera = "<camera><position z='9'/></camera>";
    let xml = |more: &str| format!("<xml><scene>{ball}{more}</scene>\n{camera}</xml>");
    check(
        Language::Xml,
        &xml(""),
        None,
        &["2:1 the scene has no light: the picture is black"],
    );
    check(
        Language::Xml,
        &xml("<light type='ambient'><intensity/></light>"),
        PATH,
        &["2:1 the only light is ambient, which path tracing leaves out: the picture is black"],
    );
}

#[test]
fn a_scene_without_objects_is_black() {
    let lit = "<light type='direct'><intensity/></light>";
    let xml = |scene: &str| {
        format!("<xml><scene>{scene}{lit}</scene>\n<camera><position z='9'/></camera></xml>")
    };
    check(
        Language::Xml,
        &xml(""),
        None,
        &["2:1 the scene has no object"],
    );
    // Its mesh is not read here.
    let left_out = "2:1 no object of the scene can be shown";
    check(
        Language::Xml,
        &xml("<object type='obj' name='a.obj'/>"),
        None,
        &[left_out],
    );
}

#[test]
fn what_only_paths_see_is_offered_to_them() {
    let glows = "2:1 the only light is emission or the environment, which only path tracing carries to other surfaces \
                 | Unlit";
    for more in [
        "<environment value='.5'/>",
        "<object type='sphere' material='lamp'/><material name='lamp'><emission value='3'/></material>",
    ] {
        let text = format!(
            "<xml><scene><object type='sphere' material='m'/><material name='m'/>{more}</scene>\n\
             <camera><position z='9'/></camera></xml>"
        );
        check(Language::Xml, &text, None, &[glows]);
        check(Language::Xml, &text, PATH, &[]);
        let settled = text.replace("</camera>", "</camera><render integrator='path'/>");
        check(Language::Xml, &settled, None, &[]);
    }
}

#[test]
fn a_view_away_from_all_objects_is_named() {
    let text = |target: &str| {
        format!(
            "// view: eye 0 0 6 target 0 0 {target} fov 40 size 8 6\n{LIT}1 sphere 0 0 0 1  0 0 0 \
             .5 .5 .5  0 0 0 9  0 0 1\n"
        )
    };
    check(Language::Ray, &text("0"), None, &[]);
    let behind = "1:27 every object is behind the camera: the picture is black";
    check(Language::Ray, &text("12"), None, &[behind]);
    // The view asked for is not the text's, whose target is not to blame.
    let text = text("0");
    let (source, lowered) = read_as(Language::Ray, &text, &Meshes::default());
    let scene = lowered.scene.expect("it has no errors");
    let away = Camera {
        target: DVec3::new(0.0, 0.0, 12.0),
        ..scene.camera
    };
    let found = outlook(&source, &scene, &away, &scene.setting.rendering);
    let spans: Vec<_> = found.iter().map(|found| found.warning.span).collect();
    assert_eq!(spans, [source.span(Node::View)]);
}

#[test]
fn a_scene_whose_objects_are_all_clipped_is_black() {
    let text = |near: &str, far: &str| {
        format!(
            "light ID 1 inf 0 0 1  0 1 -1  1 1 1  1 0 0  0 shadow_on\n\
             mat ID 1  1 1 1  0 .5 0 1  0 0 1\nobj sphere ID 1 mat ID 1  0 0 0  1\n\
             camera perspective 0 -5 0  0 0 0  0 0 1  1 {near} {far}\nresolution .1 .1\nviewport 8 6\n"
        )
    };
    let dat = |near, far, expected: &[&str]| check(Language::Dat, &text(near, far), None, expected);
    dat("1", "100", &[]);
    dat("5.9", "100", &[]);
    dat(
        "6.1",
        "100",
        &["4:44 every object is nearer than the near limit: the picture is black"],
    );
    dat("1", "4.1", &[]);
    dat(
        "1",
        "3.9",
        &["4:46 every object is beyond the far limit: the picture is black"],
    );
}

#[test]
fn a_camera_in_an_opaque_solid_sees_only_its_dark_inside() {
    let text = |light: &str, transmission: &str| {
        format!(
            "// view: eye 0 .5 0 target 0 0 0\n0 0 0 1 {light} 1 1 1\n\
             1 sphere 0 0 0 1  .1 .1 .1 .5 .5 .5 0 0 0 1 0 {transmission} 1\n"
        )
    };
    let inside = "1:1 the camera is inside object 1 (sphere), which is opaque and holds no light";
    let ray = |light, transmission, expected: &[&str]| {
        check(Language::Ray, &text(light, transmission), None, expected);
    };
    ray("0 5 5", "0", &[inside]);
    ray("0 5 5", ".5", &[]);
    // A room.
    ray("0 .9 0", "0", &[]);
    let ambient = text("0 5 5", "0").replacen("0 0 0 1", ".3 .3 .3 1", 1);
    check(Language::Ray, &ambient, None, &[]);
    check(Language::Ray, &ambient, PATH, &[inside]);
    // What reflects no ambient light.
    let unlit = ambient.replacen(".1 .1 .1", "0 0 0", 1);
    check(Language::Ray, &unlit, None, &[inside]);
    // A dark solid around the eye in a lit room.
    let both = text("0 .9 0", "0").replacen(
        "\n1 sphere",
        "\n2 sphere 0 0 0 20  0 0 0 .5 .5 .5 0 0 0 1 0 0 1 sphere",
        1,
    );
    let both = both.replacen("0 .9 0 1 1 1", "0 9 0 1 1 1", 1);
    check(
        Language::Ray,
        &both,
        None,
        &[&inside.replace("object 1", "object 2")],
    );
}

#[test]
fn rays_that_start_at_near_may_start_inside_too() {
    let text = |near: &str| {
        format!(
            "light ID 1 inf 0 0 1  0 1 -1  1 1 1  1 0 0  0 shadow_on\n\
             mat ID 1  1 1 1  0 .5 0 1  0 0 1\nobj sphere ID 1 mat ID 1  0 0 0  1\n\
             camera perspective 0 -.5 0  0 0 0  0 0 1  1 {near} 100\nresolution .1 .1\nviewport 8 6\n"
        )
    };
    let inside = "4:1 the camera is inside object 1 (sphere), which is opaque and holds no light";
    for (near, expected) in [
        ("0", &[inside][..]),
        (".1", &[inside]),
        // At y = 0.4.
        (".9", &[inside]),
        // At y = 0.95, where the corners are outside.
        ("1.45", &[]),
    ] {
        check(Language::Dat, &text(near), None, expected);
    }
}

#[test]
fn materials_that_send_back_more_than_comes_are_named_with_the_sum() {
    let text = |material: &str| format!("{LIT}1 sphere 0 0 0 1  0 0 0 {material}\n");
    for (material, expected) in [
        (".5 .6 .7  1 1 1 9  .3 0 1", None),
        (
            ".5 .6 .75  0 0 0 9  .5 0 1",
            Some(
                "2:3 object 1 (sphere): diffuse, specular and mirror reflectance add up to 1.25: \
                  the picture grows brighter with every bounce",
            ),
        ),
        (
            "0 0 0  0 0 0 9  .12 .9 1.5",
            Some(
                "2:3 object 1 (sphere): mirror reflectance and transmittance add up to 1.02: \
                  the picture grows brighter with every bounce",
            ),
        ),
        (
            ".5 .5 .5  0 0 0 9  .5 .5 1.5",
            Some(
                "2:3 object 1 (sphere): diffuse, specular and mirror reflectance and transmittance \
                  add up to 1.5: the picture grows brighter with every bounce",
            ),
        ),
    ] {
        check(Language::Ray, &text(material), None, &[]);
        check(Language::Ray, &text(material), PATH, expected.as_slice());
    }
    let blinn = "<xml><scene><object type='sphere' material='m'/>\n\
        <material name='m'><diffuse value='.7'/><specular value='.8'/><glossiness value='8'/></material>\
        <light type='direct'><intensity/></light></scene><camera><position z='9'/></camera></xml>";
    check(
        Language::Xml,
        blinn,
        PATH,
        &[
            "2:1 m (blinn): diffuse, specular and mirror reflectance add up to 1.033: \
           the picture grows brighter with every bounce",
        ],
    );
}

/// Each light that emits no photons, with the falloff that lets a point emit them.
#[test]
fn lights_without_photons_are_named() {
    const PHOTON: Option<Integrator> = Some(Integrator::Photon);
    let steady = "it does not fall off with the squared distance";
    let ray = format!("{LIT}{BALL}");
    let expected = format!("1:9 light 1 emits no photons: {steady} | WithoutPhotons");
    check(Language::Ray, &ray, PHOTON, &[&expected]);
    check(Language::Ray, &ray, PATH, &[]);
    let fading = format!("// render: integrator photon falloff square\n{ray}");
    check(Language::Ray, &fading, None, &[]);
    let dat = "light ID 1 inf 0 0 1  0 1 -1  1 1 1  1 0 0  0 shadow_on\n\
               light ID 2 pnt 0 0 9  0 0 0  1 1 1  0 0 1  0 shadow_on\n\
               light ID 3 pnt 0 0 9  0 0 0  1 1 1  0 0 1  0 shadow_off\n\
               light ID 4 pnt 0 0 9  0 0 0  1 1 1  1 0 1  0 shadow_on\n\
               light ID 5 amb 0 0 9  0 0 0  1 1 1  1 0 0  0 shadow_on\n\
               mat ID 1  1 1 1  0 .5 0 1  0 0 1\nobj sphere ID 1 mat ID 1  0 0 0  1\n\
               camera perspective 0 -5 0  0 0 0  0 0 1  1 0 100\nresolution .1 .1\nviewport 8 6\n";
    let of_dat = [
        format!("1:1 light 1 emits no photons: {steady}"),
        "3:1 light 3 emits no photons: it casts no shadows".to_owned(),
        format!("4:1 light 4 emits no photons: {steady}"),
    ];
    check(
        Language::Dat,
        dat,
        PHOTON,
        &of_dat.each_ref().map(String::as_str),
    );
    let xml = |terms: &str| {
        format!(
            "<xml><scene><object type='sphere' material='m'/><material name='m'/>
             <light type='point'><intensity/><position z='9'/>{terms}</light></scene>
             <camera><position z='9'/></camera></xml>"
        )
    };
    let expected = format!("2:14 light 1 (point) emits no photons: {steady} | WithoutPhotons");
    for terms in ["", "<size value='2'/>"] {
        check(Language::Xml, &xml(terms), PHOTON, &[&expected]);
    }
    check(Language::Xml, &xml("<attenuation value='2'/>"), PHOTON, &[]);
    let radiant = xml("<size value='2'/>").replace("<camera>", "<camera gamma='sRGB'>");
    check(Language::Xml, &radiant, PHOTON, &[]);
    let test = "camera 0 0 9 0 0 0 0 1 0 45\nattenuation 0 0 1\npoint 0 0 9 1 1 1\nsphere 0 0 0 1\n\
                quadLight 0 3 0  1 0 0  0 0 1  5 5 5\nemission .1 0 0\nsphere 2 0 0 1\n";
    let glows = "it glows, but only lights emit them";
    let of_test = [
        format!("6:1 material 2 emits no photons: {glows}"),
        format!("5:1 object 2 (quadLight) emits no photons: {glows}"),
    ];
    check(
        Language::Cse167,
        test,
        PHOTON,
        &of_test.each_ref().map(String::as_str),
    );
    check(Language::Cse167, test, PATH, &[]);
    let plain = xml("<attenuation value='2'/>").replace(" material='m'", "");
    check(Language::Xml, &plain, PHOTON, &[]);
}

#[test]
fn lights_inside_opaque_solids_are_named_if_there_are_no_others() {
    let grey = ".1 .1 .1 .5 .5 .5 0 0 0 1 0";
    let text = |ambient: &str, lights: &str, transmission: &str| {
        format!(
            "// view: eye 0 0 9 target 0 0 0\n{ambient} {lights}\n2 sphere 0 0 0 1  {grey} {transmission} 1\n\
             sphere 4 0 0 1  {grey} 0 1\n"
        )
    };
    let ray = |text: String, expected: &[&str]| check(Language::Ray, &text, None, expected);
    let inside = "2:9 light 1 is inside object 1 (sphere), which is opaque: the picture is black";
    let (dark, one) = ("0 0 0", "1 0 .5 0 1 1 1");
    ray(text(dark, one, "0"), &[inside]);
    check(
        Language::Ray,
        &text(".3 .3 .3", one, "0"),
        PATH,
        &[&inside.replace("2:9", "2:12")],
    );
    for others in [
        text(dark, one, ".5"),
        text(".3 .3 .3", one, "0"),
        text(dark, "2 0 .5 0 1 1 1  0 9 9 1 1 1", "0"),
        // A room.
        text(dark, one, "0").replace("eye 0 0 9", "eye 0 .9 0"),
    ] {
        ray(others, &[]);
    }
    let both = "2:9 all lights are inside opaque solids (light 1 in object 1 (sphere)): the picture \
                is black";
    ray(text(dark, "2 0 .5 0 1 1 1  4 0 0 1 1 1", "0"), &[both]);
    // A light that is off lights nothing either.
    ray(text(dark, "2 0 .5 0 1 1 1  0 9 9 0 0 0", "0"), &[inside]);
    let dat = |shadow: &str| {
        format!(
            "light ID 1 pnt 0 0 0  0 0 0  1 1 1  1 0 0  0 {shadow}\n\
             mat ID 1  1 1 1  0 .5 0 1  0 0 1\nobj sphere ID 1 mat ID 1  0 0 0  1\n\
             camera perspective 0 -5 0  0 0 0  0 0 1  1 0 100\nresolution .1 .1\nviewport 8 6\n"
        )
    };
    let inside = "1:1 light 1 is inside object 1 (sphere), which is opaque: the picture is black";
    check(Language::Dat, &dat("shadow_on"), None, &[inside]);
    check(Language::Dat, &dat("shadow_off"), None, &[]);
}
