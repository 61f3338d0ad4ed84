use super::{around, read, shown};
use text::Span;

/// The errors and warnings of a text, without their places.
fn said(text: &str) -> Vec<String> {
    let (_, lowered) = read(text);
    assert_eq!(
        lowered.scene.is_some(),
        lowered.diagnostics.errors() == 0,
        "{text}"
    );
    let lines = shown(text, &lowered);
    let message = |line: &String| line.split_once(' ').map(|(_, said)| said.to_owned());
    lines.iter().filter_map(message).collect()
}

/// The diagnostics for this content of the scene.
fn wrong(scene: &str) -> Vec<String> {
    said(&around(scene))
}

#[test]
fn each_mistake_has_its_message() {
    for (scene, expected) in [
        (
            "<object type='sphere'><scale x='0.5f'/></object>",
            "warning: object 1 (sphere) scale x: the `f` at the end of `0.5f` is ignored",
        ),
        (
            "<object type='sphere'><scale x='wide'/></object>",
            "error: object 1 (sphere) scale x: `wide` is not a number",
        ),
        (
            "<object type='sphere' name='b'><scale y=''/></object>",
            "error: b (sphere) scale y: `` is not a number",
        ),
        (
            "<object type='sphere'><scale value='0'/></object>",
            "error: object 1 (sphere) scale: must not be 0 along any axis",
        ),
        (
            "<object><scale x='0'/><object type='sphere'/></object>",
            "error: object 1 (group) scale: must not be 0 along any axis",
        ),
        (
            "<object type='sphere'><scale x='1e200'/><scale x='1e200'/></object>",
            "error: object 1 (sphere): its transforms flatten it or are too large",
        ),
        (
            "<object><scale value='1e-99'/><object type='sphere'><scale x='1e-60'/></object></object>",
            "error: object 2 (sphere): its transforms make it too small or too large",
        ),
        (
            "<object type='plane'><scale value='1e150'/></object>",
            "error: object 1 (plane): its transforms make it too small or too large",
        ),
        (
            "<object type='sphere'><translate x='1e300' value='1e300'/></object>",
            "error: object 1 (sphere) translate: too large for any number",
        ),
        (
            "<object type='sphere'><rotate angle='9'/></object>",
            "warning: object 1 (sphere) rotate: the axis is zero",
        ),
        (
            "<object type='sphere'><rotate x='1' y='1,5'/></object>",
            "error: object 1 (sphere) rotate y: `1,5` is not a number",
        ),
        (
            "<object type='spere'/>",
            "warning: object: unknown type `spere`",
        ),
        (
            "<object type='sphere' material='m'/>",
            "warning: material: no material named `m`",
        ),
        (
            "<object type='obj'/>",
            "error: object 1 (obj): the name is missing",
        ),
        (
            "<object size='1'/>",
            "warning: attribute `size`: unknown in `object`",
        ),
        (
            "<object><scale r='1'/></object>",
            "warning: attribute `r`: unknown in `scale`",
        ),
        (
            "<object><sacle/></object>",
            "warning: `sacle`: unknown in `object`",
        ),
    ] {
        let wrong = wrong(scene);
        assert!(wrong.contains(&expected.to_owned()), "{scene}: {wrong:#?}");
    }
}

#[test]
fn lights_and_surroundings_are_checked() {
    for (scene, expected) in [
        (
            "<light type='spot'/>",
            "warning: light: unknown type `spot`",
        ),
        ("<light/>", "warning: light: no type"),
        (
            "<light type='direct'><direction x='0'/></light>",
            "error: light 1 (direct) direction: must not be zero",
        ),
        (
            "<light type='direct'><direction value='0' z='1'/></light>",
            "error: light 1 (direct) direction: must not be zero",
        ),
        (
            "<light type='point'><size value='-1'/></light>",
            "error: light 1 (point) size: must be 0 or more",
        ),
        (
            "<light type='ambient'><position/></light>",
            "warning: `position`: unknown in `light`",
        ),
        (
            "<light type='ambient'><intensity value='1'/><intensity/></light>",
            "warning: light 1 (ambient) intensity: given again below",
        ),
        (
            "<light type='ambient'><intensity>1</intensity></light>",
            "warning: `1`: text between tags has no meaning",
        ),
        (
            "<background texture=''/>",
            "warning: texture: the name is missing",
        ),
        (
            "<background value='0' texture='a.png'><scale x='0'/></background>",
            "error: background scale: must not be 0 along any axis",
        ),
        ("<camera/>", "warning: `camera`: unknown in `scene`"),
    ] {
        let wrong = wrong(scene);
        assert!(wrong.contains(&expected.to_owned()), "{scene}: {wrong:#?}");
    }
}

#[test]
fn unsuitable_properties_of_materials_give_warnings() {
    for (material, expected) in [
        (
            "<material type='glass'/>",
            "warning: material: unknown type `glass`",
        ),
        (
            "<material name='a'/><material name='a'/>",
            "warning: `a`: another material has this name",
        ),
        (
            "<material><roughness/></material>",
            "warning: `roughness`: unknown in `material`",
        ),
        (
            "<material name='a'><diffuse R='1'/></material>",
            "warning: attribute `R`: unknown in `diffuse`",
        ),
        (
            "<material><absorption texture='a.png'/></material>",
            "warning: attribute `texture`: unknown in `absorption`",
        ),
        (
            "<material><glossiness value='-1'/></material>",
            "warning: material 1 (blinn) glossiness: -1 is not 0 or more",
        ),
    ] {
        let wrong = wrong(material);
        assert!(
            wrong.contains(&expected.to_owned()),
            "{material}: {wrong:#?}"
        );
    }
}

#[test]
fn the_camera_and_the_root_are_checked() {
    let of = |camera: &str| format!("<xml><scene/>{camera}</xml>");
    for (text, expected) in [
        ("<scene/>".to_owned(), "error: the root element is `scene`"),
        (
            "<xml><camera/></xml>".to_owned(),
            "warning: no `scene` element",
        ),
        (
            "<xml><scene/></xml>".to_owned(),
            "warning: no `camera` element",
        ),
        (of("<camera/><camera/>"), "warning: `camera`: already given"),
        (of("<scene/>"), "warning: `scene`: already given"),
        (of("<lens/>"), "warning: `lens`: unknown in `xml`"),
        (
            of("<camera><fov value='180'/></camera>"),
            "error: view fov: must be greater than 0 and less than 180",
        ),
        (
            of("<camera><width value='1.0'/></camera>"),
            "error: view width: must be a whole number, 1 or more",
        ),
        (
            of("<camera><height value='5000000000'/></camera>"),
            "error: view height: must be 4294967295 at most",
        ),
        (
            of("<camera><target/></camera>"),
            "error: view target: coincides with the eye",
        ),
        (
            of("<camera><up z='1'/></camera>"),
            "warning: view up: is parallel to the direction of view",
        ),
        (
            of("<camera gamma='2.2'/>"),
            "warning: camera gamma: unknown value `2.2`",
        ),
        (
            "<xml><scene>".to_owned(),
            "error: `<scene>` is never closed",
        ),
    ] {
        let wrong = said(&text);
        assert!(wrong.contains(&expected.to_owned()), "{text}: {wrong:#?}");
    }
}

#[test]
fn all_errors_are_reported_at_once_at_their_places() {
    let text = "<xml>\n <scene>\n  <object type='sphere'>\n   <scale x='a'/>\n   <turn/>\n  </object>\n  \
        <light type='direct'>\n   <direction x='0'/>\n  </light>\n </scene>\n \
        <camera><fov value='0'/><position z='1'/></camera>\n</xml>\n";
    let (_, lowered) = read(text);
    let expected = [
        "4:14 error: object 1 (sphere) scale x: `a` is not a number",
        "5:5 warning: `turn`: unknown in `object`",
        "8:15 error: light 1 (direct) direction: must not be zero",
        "11:22 error: view fov: must be greater than 0 and less than 180",
    ];
    assert_eq!(shown(text, &lowered), expected);
    let hint = lowered.diagnostics[1].hint.as_deref();
    assert_eq!(hint, Some("it is ignored, with all that is in it"));
    assert_eq!(lowered.diagnostics[0].span, Span::new(53, 54));
}

#[test]
fn names_that_were_probably_meant_are_asked_about() {
    for (text, expected) in [
        (
            around("<material name='red'/><object type='sphere' material='Red'/>"),
            "the object is drawn flat white; did you mean `red`?",
        ),
        (
            around("<material name='a&amp;b'/><object type='sphere' material='A&amp;b'/>"),
            "the object is drawn flat white; did you mean `a&b`?",
        ),
    ] {
        let (_, lowered) = read(&text);
        let hints = lowered.diagnostics.iter();
        let hints: Vec<_> = hints.filter_map(|d| d.hint.as_deref()).collect();
        assert!(hints.contains(&expected), "{text}: {hints:?}");
    }
}

#[test]
fn misplaced_elements_are_told_where_they_belong() {
    for (text, expected) in [
        (
            around("<render spp='4'/>"),
            "it is skipped; it belongs in `xml`",
        ),
        (
            around("<material name='a'><light/></material>"),
            "it is skipped; it belongs in `scene`",
        ),
    ] {
        let (_, lowered) = read(&text);
        let mut hints = lowered
            .diagnostics
            .iter()
            .filter_map(|found| found.hint.as_deref());
        assert!(hints.any(|hint| hint == expected), "{text}");
    }
}

#[test]
fn misspelt_words_are_recognised() {
    let text = around("<obejct/>");
    let (_, lowered) = read(&text);
    let hint = lowered.diagnostics[0].hint.as_deref();
    assert_eq!(hint, Some("it is skipped; did you mean `object`?"));
}
