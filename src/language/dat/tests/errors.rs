//! One case per rule. Expected diagnostics are in comments under the line that causes them, after
//! `#~`: column, severity, and the start of the message.

use super::{read, spelled};
use crate::tests::shown;
use geometry::{Shape, Solid};

/// Checks that a text has exactly the diagnostics of its `#~` comments, in order, and a scene if
/// and only if none is an error.
fn check(case: &str) {
    let text = spelled(case);
    let (_, lowered) = read(&text);
    let said = shown(&text, &lowered);
    let mut expected = Vec::new();
    let mut line = 0;
    for (at, content) in text.split('\n').enumerate() {
        match content.trim_start().strip_prefix("#~ ") {
            Some(note) => expected.push(format!("{line}:{}", note.trim_end())),
            None => line = at + 1,
        }
    }
    let matches = said.len() == expected.len()
        && said
            .iter()
            .zip(&expected)
            .all(|(said, start)| said.starts_with(start));
    assert!(matches, "{text}\nsaid {said:#?}\nexpected {expected:#?}");
    let errors = expected.iter().any(|line| line.contains(" error: "));
    assert_eq!(lowered.scene.is_none(), errors, "{text}");
    for diagnostic in &*lowered.diagnostics {
        assert!(!diagnostic.message.is_empty() && !diagnostic.expected.is_empty());
    }
}

/// Checks records after a view, a material 0 and a sphere 0.
fn check_under(records: &[&str]) {
    for record in records {
        check(&format!(
            "VIEW\nmat ID 0 MAT\nobj sphere ID 0 BALL 1\n{record}"
        ));
    }
}

#[test]
fn numbers_are_decimal_and_finite() {
    check_under(&[
        "obj sphere ID 1 mat ID 0  0 0 0  1,5\n#~ 34 error: object 1 (sphere) radius: `1,5` is not a number",
        "obj sphere ID 1 mat ID 0  0 x 0  1\n#~ 29 error: object 1 (sphere) centre y: `x` is not a number",
        "obj sphere ID 1 mat ID 0  0 0 0  0x10\n#~ 34 error: object 1 (sphere) radius: `0x10` is not a number",
        "obj sphere ID 1 mat ID 0  0 0 0  1e999\n#~ 34 error: object 1 (sphere) radius: `1e999` is too large",
        "obj sphere ID 1 mat ID 0  0 0 0  inf\n#~ 34 error: object 1 (sphere) radius: `inf` is not a number",
        "obj sphere ID 1 mat ID 0  0 nan 0  1\n#~ 29 error: object 1 (sphere) centre y: `nan` is not a number",
        "mat ID 1 é 1 1  0.1 0.8 0.1 5  0 0 1\n#~ 10 error: material 1 RGB red: `é` is not a number",
        "light ID 1 inf 0 0 0 0 0 -1 1 b 1 1 0 0 0 shadow_on\n#~ 31 error: light 1 colour green: `b` is not a number",
        "texture ID 1 checker 1 a 1 1 1 0 0 0\n#~ 24 error: texture 1 repeat up: `a` is not a number",
        "obj sphere ID 1 mat ID 0  +.5 -5. 1e-3  2.5E+1",
        "obj sphere ID 1 mat ID 0  0 0 0  0.01f\n#~ 34 warning: object 1 (sphere) radius: the `f` at the end of `0.01f` is ignored",
        "obj sphere ID 1 mat ID 0  0 0 0  1ff\n#~ 34 error: object 1 (sphere) radius: `1ff` is not a number",
        "obj quadric ID 1 mat ID 0  1 0 0 0 1 0 0 1 0 -1F  1 0 0 1f 2\n#~ 46 warning: object 1 (quadric) J: the `f` at the end of `-1F` is\n#~ 57 warning: object 1 (quadric) cut z: the `f` at the end of `1f` is ignored",
        "obj quadric ID 1 mat ID 0  1 0 0 0 1 0 0 1 0 -1  0f\n#~ 50 error: object 1 (quadric) number of cuts: must be a whole number, not `0f`",
        "obj sphere ID 1f mat ID 0  0 0 0  1\n#~ 15 error: obj ID: must be a whole number, not `1f`",
        "render 0f\n#~ 8 error: render number of objects: must be a whole number, not `0f`",
        "viewport 8f 6\n#~ 1 warning: viewport: already given in line 3\n#~ 10 error: viewport width: `8f` is not a number",
    ]);
}

#[test]
fn independent_errors_are_reported_at_once() {
    check(
        "camera perspective 0 0 5  0 0 0  0 1 0  0 3 2
        #~ 41 error: camera focal: must be greater than 0
resolution -1 0
        #~ 12 error: resolution across: must be greater than 0
        #~ 15 error: resolution up: must be greater than 0
viewport 80 6.5
        #~ 13 error: viewport height: must be a whole number, 1 or more
mat ID 0 1 1 x  0.1 0.8 0.1 5  0 0 y
        #~ 14 error: material 0 RGB blue: `x` is not a number
        #~ 36 error: material 0 ior: `y` is not a number
obj sphere ID 1 mat ID 0  0 0 0  -1
        #~ 34 error: object 1 (sphere) radius: must be greater than 0
obj ball ID 2 mat ID 0  0 0 0  1
        #~ 5 error: obj: unknown kind `ball`
obj sphere ID 3 mat ID 8  0 0 0
        #~ 24 error: material 8 is not defined above
        #~ 32 error: object 3 (sphere): the line ends where radius is expected; 1 more token
obj quadric ID 4 mat ID 0  1 0 0 0 1 0 0 1 0 z  2  0 0 0 1  a 1 b 2
        #~ 46 error: object 4 (quadric) J: `z` is not a number
        #~ 52 error: object 4 (quadric) cut: its normal must not be zero
        #~ 61 error: object 4 (quadric) cut x: `a` is not a number
        #~ 65 error: object 4 (quadric) cut z: `b` is not a number
render 1 ID 9
        #~ 13 error: object 9 is not defined above",
    );
}

#[test]
fn sizes_beyond_the_limits_are_reported_at_their_numbers() {
    check_under(&[
        "obj sphere ID 1 BALL 1e-150\nobj sphere ID 2 BALL 9e149",
        "obj sphere ID 1 BALL 1e150\n#~ 33 error: object 1 (sphere) radius: must be at least 1e-150 and less than 1e150",
        "obj ellipsoid ID 1 BALL 1 1 9e-151\n#~ 40 error: object 1 (ellipsoid) rz: must be at least 1e-150",
        "obj cylinder ID 1 mat ID 0  1e308 0 0  -1 0 0  1 1.7e308\n#~ 50 error: object 1 (cylinder) length: must be at least 1e-150 and less",
        "obj box ID 1 mat ID 0  0 0 0  1e100 0 0  0 1 0  0 0 1  1e60 1 1\n#~ 24 error: object 1 (box): its size or position is out of range\n#~ 31 warning: object 1 (box) u: has length 1e100",
        "obj box ID 1 mat ID 0  0 0 0  1e-99 0 0  0 1 0  0 0 1  1e-60 1 1\n#~ 24 error: object 1 (box): its size or position is out of range\n#~ 31 warning: object 1 (box) u: has length 1e-99",
        "obj quadric ID 1 mat ID 0  1 0 0 0 1 0 0 1 0 -1e302  0\n#~ 28 error: object 1 (quadric): its size or position is out of range",
        "obj quadric ID 1 mat ID 0  1 0 0 0 1 0 0 1 0 -1e-302  0\n#~ 28 error: object 1 (quadric): its size or position is out of range",
        "obj quadric ID 1 mat ID 0  1 0 0 0 1 0 0 0 0 -1  1  0 0 1 1e200\n#~ 28 error: object 1 (quadric): its size or position is out of range",
    ]);
}

#[test]
fn sizes_must_be_greater_than_0() {
    check_under(&[
        "obj sphere ID 1 BALL 0\n#~ 33 error: object 1 (sphere) radius: must be greater than 0",
        "obj ellipsoid ID 1 BALL 1 -1 1\n#~ 38 error: object 1 (ellipsoid) ry: must be greater than 0",
        "obj cylinder ID 1 BALL 0 0 1 0 -0\n#~ 41 error: object 1 (cylinder) radius: must be\n#~ 43 error: object 1 (cylinder) length: must be",
        "obj box ID 1 BALL AXES 1 0 1\n#~ 52 error: object 1 (box) vw: must be greater than 0",
    ]);
}

#[test]
fn unusual_numbers_give_warnings_with_the_value_used() {
    for (record, place, what, hint) in [
        (
            "mat ID 1 2 1 1  .1 .8 .1 5 0 0 1",
            10,
            "material 1 RGB red: 2",
            "it is used as given",
        ),
        (
            "mat ID 1 1 1 1  -1 .8 .1 5 0 0 1",
            17,
            "material 1 Ka: -1",
            "it is used as given",
        ),
        (
            "mat ID 1 1 1 1  .1 .8 -1 5 0 0 1",
            23,
            "material 1 Ks: -1",
            "it is used as given",
        ),
        (
            "mat ID 1 1 1 1  .1 .8 .1 -5 0 0 1",
            26,
            "material 1 ns: -5",
            "it is read as 0",
        ),
        (
            "mat ID 1 1 1 1  .1 .8 .1 5 2 0 1",
            28,
            "material 1 Kt: 2",
            "it is used as given",
        ),
        (
            "mat ID 1 1 1 1  .1 .8 .1 5 0 0 -2",
            32,
            "material 1 ior: -2",
            "it is read as 1",
        ),
        (
            "light ID 1 pnt 0 0 0 0 0 1 1 1 1 -1 0 0 0 shadow_on",
            34,
            "light 1 a0: -1",
            "it is used as given",
        ),
        (
            "light ID 1 pnt 0 0 0 0 0 1 1 1 1 1 0 0 -1 shadow_on",
            40,
            "light 1 aa: -1",
            "it is read as 0",
        ),
    ] {
        check_under(&[&format!("{record}\n#~ {place} warning: {what} is not ")]);
        let text = spelled(&format!(
            "VIEW\nmat ID 0 MAT\nobj sphere ID 0 BALL 1\n{record}"
        ));
        let (_, lowered) = read(&text);
        assert_eq!(
            lowered.diagnostics[0].hint.as_deref(),
            Some(hint),
            "{record}"
        );
    }
    // Opaque objects of the course have an index of 0 and strong highlights.
    check_under(&["mat ID 1 1 1 1  0 0 40 0  0 0 0"]);
}

#[test]
fn directions_must_span_a_volume() {
    check_under(&[
        "obj cylinder ID 1 BALL 0 0 0 1 1\n#~ 35 error: object 1 (cylinder) axis: must not be zero",
        "obj cylinder ID 1 BALL 0 0 9 1 1\n#~ 35 warning: object 1 (cylinder) axis: has length 9, not 1",
        "obj box ID 1 BALL 2 0 0 0 1 0 0 0 1 1 1 1\n#~ 30 warning: object 1 (box) u: has length 2, not 1",
        "obj box ID 1 BALL 1 0 0 0 0 0 0 0 1 1 1 1\n#~ 36 error: object 1 (box) v: must not be zero",
        "obj box ID 1 BALL 1 0 0 -1 0 0 0 0 1 1 1 1\n#~ 36 error: object 1 (box) v: is parallel to u",
        "obj box ID 1 BALL 1 0 0 0 1 0 .6 .8 0 1 1 1\n#~ 42 error: object 1 (box) w: lies in the plane of the other two",
        "obj box ID 1 BALL 1 0 0 .6 .8 0 0 0 1 1 1 1\n#~ 36 warning: object 1 (box) v: not at a right angle to u",
        "obj box ID 1 BALL 1 0 0 0 1 0 0 0 -1 1 1 1\n#~ 42 warning: object 1 (box) w: points opposite to u × v",
        "light ID 1 inf 0 0 0  0 0 0  1 1 1  1 0 0  0 shadow_on\n#~ 16 error: light 1 direction: must not be zero",
    ]);
}

#[test]
fn unknown_words_are_reported() {
    check_under(&[
        "light ID 1 spot 0 0 0 0 0 0 1 1 1 1 0 0 0 shadow_on\n#~ 12 error: light 1 source: unknown word `spot`",
        "light ID 1 PNT 0 0 0 0 0 0 1 1 1 1 0 0 0 shadow_on\n#~ 12 error: light 1 source: unknown word `PNT`",
        "light ID 1 pnt 0 0 0 0 0 0 1 1 1 1 0 0 0 on\n#~ 42 error: light 1 shadow: unknown word `on`",
        "light id 1 pnt 0 0 0 0 0 0 1 1 1 1 0 0 0 shadow_on\n#~ 7 error: light: expected `ID`, not `id`",
        "obj\n#~ 4 error: obj: the line ends before its kind",
        "obj csg ID 1 union ID 0 ID 0\n#~ 5 error: obj: unknown kind `csg`",
        "obj sphere ID 1 material ID 0 0 0 0 1\n#~ 17 error: object 1 (sphere): expected `mat`, not `material`",
        "obj CSG ID 1 minus ID 0 ID 0\n#~ 14 error: object 1 (CSG) operator: unknown word `minus`",
        "texture ID 1 Image 1 1 a.png\n#~ 14 error: texture 1: expected `checker` or `image`, not `Image`",
        "texture ID 1 stripes 1 1\n#~ 14 error: texture 1: expected `checker` or `image`, not `stripes`",
        "use color ID 1 mat ID 0\n#~ 5 error: use: unknown kind `color`",
        // Records for other readers are skipped; keywords are case-sensitive.
        "fog 1 2 3\n#~ 1 warning: unknown record `fog`: the line is skipped",
        "Light ID 1 pnt\n#~ 1 warning: unknown record `Light`: the line is skipped",
        "1 2 3\n#~ 1 warning: unknown record `1`: the line is skipped",
    ]);
    let hints = |record: &str| {
        let (_, lowered) = read(&spelled(&format!(
            "VIEW\nmat ID 0 MAT\nobj sphere ID 0 BALL 1\n{record}"
        )));
        lowered.diagnostics[0].hint.clone().unwrap_or_default()
    };
    for (record, hint) in [
        ("obj Sphere ID 1", "did you mean `sphere`?"),
        ("obj csg ID 1", "did you mean `CSG`?"),
        ("use color ID 1 mat ID 0", "did you mean `colour`?"),
        ("lihgt ID 1", "did you mean `light`?"),
        ("light ID 1 PNT", "did you mean `pnt`?"),
        ("light Id 1 pnt", "words are case-sensitive"),
        (
            "obj CSG ID 1 union ID 0 ID 2\nobj sphere ID 2 BALL 1",
            "object 2 is defined below: it must come first",
        ),
        (
            "obj CSG ID 1 union ID 0 ID 1\nmat ID 1 MAT",
            "defined so far: 0",
        ),
    ] {
        assert_eq!(hints(record), hint, "{record}");
    }
}

#[test]
fn incomplete_records_are_reported_at_their_end() {
    check(
        "viewport 80
#~ 12 error: viewport: the line ends where viewport height is expected; 1 more token
camera perspective 0 0
#~ 23 error: camera: the line ends where eye z is expected; 10 more tokens
resolution
#~ 11 error: resolution: the line ends where resolution across is expected; 2 more tokens
light ID
#~ 9 error: light: the line ends where a number for ID is expected; 16 more tokens
mat ID 0 1 1 1
#~ 15 error: material 0: the line ends where Ka is expected; 7 more tokens
obj sphere ID 0
#~ 16 error: object 0 (sphere): the line ends where `mat` is expected; 7 more tokens
obj quadric ID 1 mat ID 0 1 0 0 0 1 0 0 1 0 -1
#~ 47 error: object 1 (quadric): the line ends before the number of cuts
texture ID 0 image 1 1
#~ 23 error: texture 0: the line ends where file is expected; 1 more token
use bump ID 0 mat ID 0
#~ 23 error: use: the line ends where height is expected; 1 more token
render
#~ 7 error: render: the line ends before the number of objects
light 
#~ 6 error: light: the line ends where `ID` is expected; 17 more tokens",
    );
}

#[test]
fn surplus_tokens_are_ignored() {
    check_under(&[
        "obj sphere ID 1 BALL 1 7 8\n#~ 35 warning: object 1 (sphere): 2 tokens too many",
        "mat ID 1 MAT more\n#~ 38 warning: material 1: 1 token too many",
        "obj sphere ID 1 BALL 1 # no comment\n#~ 35 warning: object 1 (sphere): 3 tokens too many",
        "render 1 ID 0 ID 9\n#~ 15 warning: render: 2 tokens too many",
        "render 0 ID 9\n#~ 10 warning: render: 2 tokens too many",
        "obj quadric ID 1 BALL 0 0 1 0 0 1 -1 0 9\n#~ 51 warning: object 1 (quadric): 1 token too many",
    ]);
}

#[test]
fn ids_are_unique_and_defined_before_use() {
    check_under(&[
        "mat ID 0 1 1 1 0 0 0 0 0 0 0\n#~ 8 warning: material 0: already defined above",
        "obj sphere ID 0 BALL 2\n#~ 15 warning: object 0: already defined above",
        "obj sphere ID 1.0 BALL 2\n#~ 15 error: obj ID: must be a whole number, not `1.0`",
        "obj sphere ID 99999999999999999999 BALL 2\n#~ 15 error: obj ID: must be a whole number, not",
        "obj sphere ID 1 mat ID x 0 0 0 1\n#~ 24 error: object 1 (sphere) mat: must be a whole number, not `x`",
        "obj sphere ID 1 mat ID 7 0 0 0 1\n#~ 24 error: material 7 is not defined above",
        // Materials and operands must come first.
        "obj sphere ID 1 mat ID 7 0 0 0 1\n#~ 24 error: material 7 is not defined above\nmat ID 7 MAT",
        "obj CSG ID 1 union ID 0 ID 2\n#~ 28 error: object 2 is not defined above\nobj sphere ID 2 BALL 1",
        "obj CSG ID 1 union ID 1 ID 1\n#~ 23 error: object 1 is not defined above\n#~ 28 error: object 1 is not defined above",
        "use colour ID 1 mat ID 0\n#~ 15 error: texture 1 is not defined above\ntexture ID 1 checker 1 1 1 1 1 0 0 0",
        "light ID 1 inf 0 0 1 0 0 0 1 1 1 1 0 0 0 shadow_on\nlight ID 1 inf 0 0 1 0 0 0 1 1 1 1 0 0 0 shadow_on\n#~ 10 warning: light 1: already defined above",
        // Records with errors still define their ID: no error follows from another.
        "obj sphere ID 1 BALL x\n#~ 33 error: object 1 (sphere) radius: `x` is not a number\nobj CSG ID 2 union ID 0 ID 1\nrender 2 ID 1 ID 2",
    ]);
}

/// A second definition has no effect; references mean the first.
#[test]
fn a_second_definition_is_dropped() {
    let records = |second: &str| {
        let text = format!(
            "VIEW\nmat ID 0 MAT\nmat ID 1 MAT\nobj sphere ID 0 BALL 1\n{second}obj sphere ID 1 BALL 2\nobj sphere ID 2 mat ID 1 0 0 0 3\n"
        );
        read(&spelled(&text)).1.scene.expect("there are no errors")
    };
    let plain = records("");
    assert_eq!(records("mat ID 0 0 0 0 0 0 0 0 0 0 0\n"), plain);
    assert_eq!(records("obj box ID 0 BALL AXES 1 1 1\n"), plain);
    // Operands of a dropped record are drawn.
    assert_eq!(records("obj CSG ID 0 union ID 0 ID 0\n"), plain);
}

#[test]
fn the_last_of_repeated_records_counts() {
    let text = spelled(
        "VIEW
camera orthographic 9 9 9  0 0 0  0 1 0  1 0 100
#~ 1 warning: camera: already given in line 1
resolution 1 1
#~ 1 warning: resolution: already given in line 2
viewport 8 6
#~ 1 warning: viewport: already given in line 3
render 1 ID 1
mat ID 0 MAT
texture ID 0 checker 1 1 1 1 1 0 0 0
texture ID 1 checker 2 2 1 1 1 0 0 0
use colour ID 0 mat ID 0
use colour ID 1 mat ID 0
#~ 5 warning: colour: already given in line 14
obj sphere ID 0 BALL 1
obj sphere ID 1 BALL 2
render 1 ID 0
#~ 1 warning: render: already given in line 10",
    );
    check(&text);
    let scene = read(&text).1.scene.expect("there are no errors");
    assert_eq!(scene.camera.eye, glam::DVec3::splat(9.0));
    assert_eq!(scene.camera.lens, scene::Lens::Orthographic(6.0));
    assert_eq!(scene.camera.size.width, 8);
    let maps = scene.materials[0].maps.as_ref();
    assert_eq!(maps.and_then(|maps| maps.diffuse), Some(1));
    let Shape::Solid(Solid::Sphere(sphere)) = &scene.objects[0].shape else {
        panic!("{:?}", scene.objects);
    };
    assert_eq!((scene.objects.len(), sphere.radius), (1, 1.0));
}

#[test]
fn declared_counts_must_match() {
    check_under(&[
        "render 2 ID 0\n#~ 8 error: render: declares `2`, but 1 object follows",
        "render 2 ID 0 ID\n#~ 8 error: render: declares `2`, but 1 object follows",
        "render 1 0\n#~ 8 error: render: declares `1`, but 0 objects follow",
        "render 1 id 0\n#~ 10 error: render: expected `ID`, not `id`",
        "render 1 ID x\n#~ 13 error: render ID: must be a whole number, not `x`",
        "render -1\n#~ 8 error: render: the number of objects must be 0 or more",
        "render all\n#~ 8 error: render number of objects: must be a whole number, not `all`",
        "render 9000000000000000000 ID 0\n#~ 8 error: render: declares `9000000000000000000`, but 1 object follows",
        "obj quadric ID 1 BALL 0 0 1 0 0 1 -1 2 1 0 0 1\n#~ 49 error: object 1 (quadric): declares `2`, but 1 cut follows",
        "obj quadric ID 1 BALL 0 0 1 0 0 1 -1 1 1 0 0\n#~ 49 error: object 1 (quadric): declares `1`, but 0 cuts follow",
        "obj quadric ID 1 BALL 0 0 1 0 0 1 -1 -1 1 0 0 1\n#~ 49 error: object 1 (quadric): the number of cuts must be 0 or more",
        "obj quadric ID 1 BALL 0 0 1 0 0 1 -1 9000000000000000000\n#~ 49 error: object 1 (quadric): declares `9000000000000000000`, but 0 cuts follow",
        "obj quadric ID 1 BALL 0 0 1 0 0 1 -1 some 1 0 0 1\n#~ 49 error: object 1 (quadric) number of cuts: must be a whole number, not `some`",
    ]);
}

#[test]
fn empty_regions_give_warnings() {
    check_under(&[
        "obj quadric ID 1 mat ID 0 1 0 0 0 1 0 0 1 0 1 0\n#~ 27 warning: object 1 (quadric): the solid is empty",
        "obj quadric ID 1 mat ID 0 1 0 0 0 1 0 0 1 0 -1 1 0 0 1 -2\n#~ 27 warning: object 1 (quadric): the solid is empty",
        // A sphere of radius 1 around (10⁶, 0, 0).
        "obj quadric ID 1 mat ID 0 1 0 0 -1e6 1 0 0 1 0 999999999999 0\n#~ 27 warning: object 1 (quadric): too far from the origin for its size",
    ]);
}

#[test]
fn far_must_be_beyond_near() {
    let said = |near: &str, far: &str, note: &str| {
        check(&format!(
            "camera orthographic 0 0 5  0 0 0  0 1 0  1 {near} {far}\n{note}resolution 1 1\nviewport 8 6\nmat ID 0 MAT\nobj sphere ID 0 BALL 1"
        ));
    };
    said("0", "1", "");
    said("-1", "1e-300", "");
    said(
        "2",
        "2",
        "#~ 46 error: camera far: must be greater than near\n",
    );
    said(
        "2",
        "-3",
        "#~ 46 error: camera far: must be greater than near\n",
    );
    // A negative near counts as 0.
    said(
        "-5",
        "-1",
        "#~ 47 error: camera far: must be greater than near\n",
    );
    said(
        "-5",
        "0",
        "#~ 47 error: camera far: must be greater than near\n",
    );
}
