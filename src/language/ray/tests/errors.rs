//! One case per rule. Expected diagnostics are in the text that causes them, after `//~`: column,
//! severity, and the start of the message.

use super::{read, shown, spelled};
use crate::ray::schema::ShapeKind;
use text::alternatives;

/// Checks that a text has exactly the diagnostics of its `//~` notes, in order, and a scene if and
/// only if none is an error.
fn check(case: &str) {
    let text = spelled(case);
    let (_, lowered) = read(&text);
    let said = shown(&text, &lowered);
    let mut expected = Vec::new();
    for (line, content) in text.split('\n').enumerate() {
        for note in content.split("//~ ").skip(1) {
            expected.push(format!("{}:{}", line + 1, note.trim_end()));
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
    assert!(
        lowered
            .diagnostics
            .iter()
            .all(|diagnostic| !diagnostic.message.is_empty())
    );
}

#[test]
fn sizes_are_within_the_limits() {
    for case in [
        "HEAD 1 sphere 0 0 0 1e-150 MAT",
        "HEAD 1 sphere 0 0 0 9e149 MAT",
        "HEAD 1 sphere 0 0 0\n1e150 //~ 1 error: object 1 (sphere) radius: must be at least 1e-150 and less than 1e150\nMAT",
        "HEAD 1 sphere 0 0 0\n9e-151 //~ 1 error: object 1 (sphere) radius: must be at least 1e-150\nMAT",
    ] {
        check(case);
    }
}

#[test]
fn numbers_are_decimal_and_finite() {
    for case in [
        "HEAD 1 sphere 0 0 0\n1,5 //~ 1 error: object 1 (sphere) radius: `1,5` is not a number\nMAT",
        "HEAD 1 sphere 0\nabc //~ 1 error: object 1 (sphere) centre y: `abc` is not a number\n0 1 MAT",
        "HEAD 1 sphere 0 0 0\n0x10 //~ 1 error: object 1 (sphere) radius: `0x10` is not a number\nMAT",
        "HEAD 1 sphere 0 0 0\n1e999 //~ 1 error: object 1 (sphere) radius: `1e999` is too large\nMAT",
        "HEAD 1 sphere 0 0 0\n inf //~ 2 error: object 1 (sphere) radius: `inf` is not a number\nMAT",
        "HEAD 1 sphere 0 0 0\n nan //~ 2 error: object 1 (sphere) radius: `nan` is not a number\nMAT",
        "1 é 1 //~ 3 error: ambient colour green: `é` is not a number\n1 0 5 5 1 1 1 1 sphere 0 0 0 1 MAT",
        "1 1 1 1 0\n5,0 //~ 1 error: light 1 position y: `5,0` is not a number\n5 1 1 1 1 sphere 0 0 0 1 MAT",
        "1 1 1 1 0 5 5 1\nx //~ 1 error: light 1 colour green: `x` is not a number\n1 1 sphere 0 0 0 1 MAT",
        "HEAD 1 sphere 0 0 0 +.5e-3 MAT",
        "HEAD 1 sphere 0 0 0\n0.01f //~ 1 warning: object 1 (sphere) radius: the `f` at the end of `0.01f` is\nMAT",
        "HEAD 1 sphere 0 0 0\n-1F //~ 1 warning: object 1 (sphere) radius: the `f` at //~ 1 error: object 1 (sphere) radius: must\nMAT",
        "HEAD\n1f //~ 1 error: nObjects: `1f` is not a number\nsphere 0 0 0 1 MAT",
    ] {
        check(case);
    }
}

#[test]
fn independent_errors_are_reported_at_once() {
    check(
        "1 1 x //~ 5 error: ambient colour blue: `x` is not a number
1  0 5 5  1 1 1
2
sphere 0 0 0
-1 //~ 1 error: object 1 (sphere) radius: must be greater than 0
MAT
box 0 0 0
0 0 0 //~ 1 error: object 2 (box) vl: must not be zero
0 1 0  0 0 1  1 1
0 //~ 1 error: object 2 (box) height: must be greater than 0
0.1 0.1 0.1  0.5 0.5
y //~ 1 error: object 2 (box) kd blue: `y` is not a number
0.2 0.2 0.2  5 0 0 1",
    );
}

#[test]
fn sizes_must_be_greater_than_0() {
    for case in [
        "HEAD 1 sphere 0 0 0\n0 //~ 1 error: object 1 (sphere) radius: must be greater than 0\nMAT",
        "HEAD 1 ellipsoid 0 0 0 AXES 1\n-1 //~ 1 error: object 1 (ellipsoid) l2: must be greater than 0\n1 MAT",
        "HEAD 1 box 0 0 0 AXES\n-0 //~ 1 error: object 1 (box) length: must be greater than 0\n1 1 MAT",
        "HEAD 1 cylinder 0 0 0 AXES 1 1\n-2 //~ 1 error: object 1 (cylinder) height: must be greater\nMAT",
        "HEAD 1 cone 0 0 0 AXES\n0 0 //~ 1 error: object 1 (cone) l1: must be //~ 3 error: object 1 (cone) l2: must be\n1 MAT",
    ] {
        check(case);
    }
}

#[test]
fn unusual_coefficients_give_warnings() {
    for case in [
        "HEAD 1 sphere 0 0 0 1\n2 0 0 //~ 1 warning: object 1 (sphere) ka red: 2 is not from 0 to 1\n1 1 1 1 1 1 5 0 0 1",
        "HEAD 1 sphere 0 0 0 1 0 0 0\n0 -1 0 //~ 3 warning: object 1 (sphere) kd green: -1 is not\n1 1 1 5 0 0 1",
        "HEAD 1 sphere 0 0 0 1 0 0 0 0 1 0\n1 1 1.5 //~ 5 warning: object 1 (sphere) ks blue: 1.5 is not\n5 0 0 1",
        "HEAD 1 sphere 0 0 0 1 0 0 0 0 1 0 1 1 1\n-5 //~ 1 warning: object 1 (sphere) ns: -5 is not 0 or more\n0 0 1",
        "HEAD 1 sphere 0 0 0 1 0 0 0 0 1 0 1 1 1 5\n-1 2 //~ 1 warning: object 1 (sphere) kr: -1 is //~ 4 warning: object 1 (sphere) kt: 2 is\n1",
        "HEAD 1 sphere 0 0 0 1 0 0 0 0 1 0 1 1 1 5 0 0\n0 //~ 1 warning: object 1 (sphere) ior: 0 is not greater than 0",
        "HEAD 1 sphere 0 0 0 1 0 0 0 1 1 1 1 1 1 0 1 1 1e-300",
    ] {
        check(case);
    }
}

#[test]
fn directions_have_unit_length_and_right_angles() {
    for case in [
        "HEAD 1 box 0 0 0 1 0 0 0 1 0\n0 0 0 //~ 1 error: object 1 (box) vh: must not be zero\n1 1 1 MAT",
        "HEAD 1 box 0 0 0\n2 0 0 //~ 1 warning: object 1 (box) vl: has length 2, not 1\n0 1 0 0 0 1 1 1 1 MAT",
        "HEAD 1 box 0 0 0\n1.0009 0 0\n0 0.9991 0  0 0 1 1 1 1 MAT",
        "HEAD 1 box 0 0 0\n1e200 0 0 //~ 1 warning: object 1 (box) vl: has length 1e200, not 1\n0 1 0  0 0 1 1 1 1 MAT",
        "HEAD 1 cone 0 0 0 1 0 0\n.6 .8 0 //~ 1 warning: object 1 (cone) a2: not at a right angle to a1 (dot product 0.6)\n0 0 1 1 1 1 MAT",
        "HEAD 1 ellipsoid 0 0 0 1 0 0 0 1 0\n0 .6 .8 //~ 1 warning: object 1 (ellipsoid) v3: not at a right angle to v2\n1 1 1 MAT",
        "HEAD 1 ellipsoid 0 0 0 1 0 0 0 1 0\n.6 0 .8 //~ 1 warning: object 1 (ellipsoid) v3: not at a right angle to v1\n1 1 1 MAT",
        "HEAD 1 box 0 0 0 1 0 0 0 1 0\n0 0.0009 1\n1 1 1 MAT",
        "HEAD 1 cylinder 0 0 0 1 0 0 0 1 0\n0 0 -1 //~ 1 warning: object 1 (cylinder) axis: points opposite to a1 × a2\n1 1 1 MAT",
        "HEAD 1 box 0 0 0 1 0 0\n-1 0 0 //~ 1 error: object 1 (box) vw: is parallel to vl\n0 0 1 1 1 1 MAT",
        "HEAD 1 box 0 0 0 1 0 0 0 1 0\n0 1 0 //~ 1 error: object 1 (box) vh: is parallel to vw\n1 1 1 MAT",
        "HEAD 1 box 0 0 0 1 0 0 0 1 0\n.6 .8 0 //~ 1 error: object 1 (box) vh: lies in the plane of the other two\n1 1 1 MAT",
        // The other two directions of a frame are compared even if one cannot be read.
        "HEAD 1 box 0 0 0\n1 x 0 //~ 3 error: object 1 (box) vl y: `x` is not a number\n0 1 0\n0 .6 .8 //~ 1 warning: object 1 (box) vh: not at a right angle to vw\n1 1 1 MAT",
    ] {
        check(case);
    }
}

#[test]
fn capital_keywords_give_warnings() {
    check("HEAD 1\nSphere //~ 1 warning: `Sphere` should be in lower case\n0 0 0 1 MAT");
    check("HEAD 1\nBOX //~ 1 warning: `BOX` should be in lower case\n0 0 0 AXES 1 1 1 MAT");
}

#[test]
fn missing_numbers_are_reported_where_the_next_object_begins() {
    for case in [
        "HEAD 2 box 0 0 0 AXES 1 1\nsphere //~ 1 error: object 1 (box) height: missing; 14 more numbers expected before `sphere`\n0 0 0 1 MAT",
        "HEAD 2 sphere 0 0\nbox //~ 1 error: object 1 (sphere) centre z: missing; 15 more numbers expected before `box`\n0 0 0 AXES 1 1 1 MAT",
        "HEAD 2 sphere\nsphere //~ 1 error: object 1 (sphere) centre x: missing; 17 more\n0 0 0\n0 //~ 1 error: object 2 (sphere) radius: must be\nMAT",
        // A misspelt keyword of the next object is recognised.
        "HEAD 2 sphere 0 0 0 1 0 0 0 0 0 0 0 0 0 5 0 0\nspere //~ 1 error: object 1 (sphere) ior: missing; 1 more number expected before `spere` //~ 1 error: object 2: unknown type `spere`\n0 0 0 1 MAT",
    ] {
        check(case);
    }
}

#[test]
fn surplus_numbers_are_reported_at_their_place() {
    for case in [
        "HEAD 2 sphere 0 0 0 1 MAT\n7 8 9 //~ 1 error: object 1 (sphere): 3 numbers too many\nsphere 0 0 0 1 MAT",
        "HEAD 2 sphere 0 0 0 1 MAT\n-7 //~ 1 error: object 1 (sphere): 1 number too many\nsphere 0 0 0 1 MAT",
        "HEAD 2\n7 //~ 1 error: nObjects: 1 number too many after it\nsphere 0 0 0 1 MAT sphere 0 0 0 1 MAT",
        // Without its keyword, an object's numbers are surplus, and no other error follows.
        "HEAD 2 sphere 0 0 0 1 MAT\n0 0 0 1 MAT //~ 1 error: object 1 (sphere): 17 numbers too many",
        "HEAD 3 sphere 0 0 0 1 MAT\n0 0 0 1 MAT //~ 1 error: object 1 (sphere): 17 numbers too many\nbox 0 0 0 AXES 1 1 1 MAT",
    ] {
        check(case);
    }
}

#[test]
fn unknown_types_are_skipped() {
    for case in [
        "HEAD 1\nspere //~ 1 error: object 1: unknown type `spere`\n0 0 0 1 MAT",
        "HEAD 2\ntorus //~ 1 error: object 1: unknown type `torus`\n0 0 0 1 MAT\nsphere 0 0 0\n0 //~ 1 error: object 1 (sphere) radius: must be\nMAT",
        "HEAD 3\ntorus //~ 1 error: object 1: unknown type `torus`\n0 0 0 1 MAT\ntorus //~ 1 error: object 1: unknown type `torus`\n0 0 0 1 MAT sphere 0 0 0 1 MAT",
        "HEAD 2 sphere 0 0 0 1 MAT\nfoo //~ 1 error: object 2: unknown type `foo`\nsphere 0 0 0 1 MAT",
    ] {
        check(case);
    }
}

#[test]
fn the_declared_number_of_objects_must_match() {
    for case in [
        "HEAD\n1 //~ 1 error: nObjects is `1`, but 1 more object follows\nsphere 0 0 0 1 MAT sphere 0 0 0 1 MAT",
        "HEAD\n1 //~ 1 error: nObjects is `1`, but 2 more objects follow\nsphere 0 0 0 1 MAT sphere 0 0 0 1 MAT cone 0 0 0 AXES 1 1 1 MAT",
        "HEAD 1 sphere 0 0 0 1 MAT\n7 8 //~ 1 warning: ignored 2 tokens after the last object",
        "HEAD 1 sphere 0 0 0 1 MAT\nthe end //~ 1 warning: ignored 2 tokens after the last object",
        "HEAD\n3 //~ 1 error: nObjects is `3`, but the text ends after object 1 (sphere)\nsphere 0 0 0 1 MAT",
        "HEAD\n2 //~ 1 error: nObjects is `2`, but the text ends in object 2 (box), where length is expected\nsphere 0 0 0 1 MAT box 0 0 0 AXES",
        "HEAD\n1 //~ 1 error: nObjects is `1`, but the text ends in object 1 (sphere), where centre y is expected\nsphere 0",
        "HEAD\n1 //~ 1 error: nObjects is `1`, but the text ends before any object",
        "HEAD\n0 //~ 1 error: nObjects: must be a whole number, 1 or more, not `0`\nsphere 0 0 0 1 MAT",
        "HEAD\n1.5 //~ 1 error: nObjects: must be a whole number, 1 or more, not `1.5`\nsphere 0 0 0 1 MAT",
        "HEAD\n1.0 //~ 1 error: nObjects: must be a whole number, 1 or more, not `1.0`\nsphere 0 0 0 1 MAT",
        "HEAD\n1e0 //~ 1 error: nObjects: must be a whole number, 1 or more, not `1e0`\nsphere 0 0 0 1 MAT",
        "1 1 1\n1. //~ 1 error: nLights: must be a whole number, 1 or more, not `1.`\n0 5 5 1 1 1 1 sphere 0 0 0 1 MAT",
        "// view: size 80 6e1 //~ 18 warning: view size height: must be a whole number, 1 or more\nHEAD 1 sphere 0 0 0 1 MAT",
        "HEAD\n-1 //~ 1 error: nObjects: must be\nsphere 0 0 0\n0 //~ 1 error: object 1 (sphere) radius: must be\nMAT",
        "HEAD\nmany //~ 1 error: nObjects: `many` is not a number\nsphere 0 0 0 1 MAT",
        "HEAD\n99999999999999999999999 //~ 1 error: nObjects is `99999999999999999999999`, but the text ends after\nsphere 0 0 0 1 MAT",
        "HEAD\nsphere //~ 1 error: nObjects: missing before `sphere`\n0 0 0 1 MAT",
        "HEAD //~ 23 error: nObjects: missing, the text ends here",
        // With an unreadable number of objects, an incomplete last object is still reported.
        "HEAD\n0 //~ 1 error: nObjects: must be\nsphere 0 0\n0 //~ 2 error: object 1 (sphere) radius: missing; 14 more numbers expected before the text ends",
    ] {
        check(case);
    }
}

#[test]
fn the_declared_number_of_lights_must_match() {
    for case in [
        // Too many lights declared: an object begins where a light's number is expected.
        "1 1 1\n2 //~ 1 error: nLights is `2`, but the text has 1 light before `sphere`\n0 5 5 1 1 1 1 sphere 0 0 0 1 MAT",
        "1 1 1\n2 //~ 1 error: nLights is `2`, but the text has 1 light and 3 numbers before `sphere`\n0 5 5 1 1 1 0 0 1 sphere 0 0 0 1 MAT",
        "1 1 1\n1 //~ 1 error: nLights is `1`, but the text has 0 lights before `sphere`\n1 sphere 0 0 0 1 MAT",
        "1 1 1\n1 //~ 1 error: nLights is `1`, but the text has 0 lights and 5 numbers before `Ϭsphere`\n5 5 1 1 1\nϬsphere //~ 1 error: object 1: unknown type `Ϭsphere`\n0 0 0 1 MAT",
        // Too few lights declared.
        "1 1 1\n1 //~ 1 error: nLights is `1`, but the text has 2 lights before `sphere`\n0 5 5 1 1 1  3 5 5 1 1 1  1 sphere 0 0 0\n0 //~ 1 error: object 1 (sphere) radius\nMAT",
        "1 1 1\n2 //~ 1 error: nLights is `2`, but the text has 1 light and 2 numbers before the text ends\n0 5 5 1 1 1 1 2",
        "1 1 1\n0 //~ 1 error: nLights: must be a whole number, 1 or more, not `0`\n0 5 5 1 1 1 1 sphere 0 0 0\n0 //~ 1 error: object 1 (sphere) radius\nMAT",
        "1 1 1\nabc //~ 1 error: nLights: `abc` is not a number\n0 5 5 1 1 1 1 sphere 0 0 0 1 MAT",
        "1 1 1\n2.5 //~ 1 error: nLights: must be\n0 5 5 1 1 1 0 5 sphere 0 0 0 1 MAT",
        "1 1 1\nsphere //~ 1 error: nLights: missing before `sphere`\n0 0 0 1 MAT",
        "1 1 1 //~ 6 error: nLights: missing, the text ends here",
        "1 1 1\n99999999999999999999 //~ 1 error: nLights is `99999999999999999999`, but the text has 1 light before `sphere`\n0 5 5 1 1 1 1 sphere 0 0 0 1 MAT",
    ] {
        check(case);
    }
}

#[test]
fn a_scene_without_its_beginning_is_a_single_error() {
    for case in [
        " //~ 1 error: the text contains no scene",
        "// nothing but words //~ 1 error: the text contains no scene",
        "\u{FEFF}\r\n",
        "1 1 //~ 4 error: ambient colour blue: missing; 1 more number expected before the text ends",
        "1\nsphere //~ 1 error: ambient colour green: missing; 2 more numbers expected before `sphere`\n0 0 0 1 MAT",
    ] {
        if case.contains("//~") {
            check(case);
        } else {
            let (_, lowered) = read(case);
            assert_eq!(
                shown(case, &lowered),
                ["1:1 error: the text contains no scene"]
            );
        }
    }
}

#[test]
fn messages_contain_expectation_and_hint() {
    let text = spelled("HEAD 2 sphere 0 0 0 1,5 MAT spere 0 0 0 1 MAT");
    let (_, lowered) = read(&text);
    let keywords = alternatives(ShapeKind::ALL.map(ShapeKind::keyword));
    let said: Vec<_> = lowered
        .diagnostics
        .iter()
        .map(|d| (d.expected.as_str(), d.hint.as_deref().unwrap_or_default()))
        .collect();
    assert_eq!(
        said,
        [
            (
                "a number greater than 0",
                "the decimal separator is a point: write 1.5"
            ),
            (&*keywords, "did you mean `sphere`?"),
        ]
    );
}

/// Numbers too long to be read are shortened, but the message still shows how large they are.
#[test]
fn numbers_in_messages_are_short() {
    for (text, part) in [
        (
            format!("HEAD 1 sphere 0 0 0 1{} MAT", "0".repeat(400)),
            "`100000000000000000000000…`",
        ),
        (
            "HEAD 1 sphere 0 0 0 1 1e300 .1 .1  0 0 0  0 0 0  5 0 0 1".into(),
            "red: 1e300 is not",
        ),
        (
            "HEAD 1 box 0 0 0 1e-9 0 0 0 1 0 0 0 1 1 1 1 MAT".into(),
            "has length 1e-9, not 1",
        ),
        (
            "HEAD 1 box 0 0 0 1 0 0 0 1.002 0 0 0 1 1 1 1 MAT".into(),
            "has length 1.002, not 1",
        ),
        (
            "HEAD 1 box 0 0 0 1e308 1e308 1e308 0 1 0 0 0 1 1 1 1 MAT".into(),
            "has length 1.732e308",
        ),
        (
            "HEAD 1 box 0 0 0 1.7e308 1.7e308 0 0 1 0 0 0 1 1 1 1 MAT".into(),
            "has length above 1.8e308",
        ),
    ] {
        let text = spelled(&text);
        let (_, lowered) = read(&text);
        let said = shown(&text, &lowered).join("\n");
        assert!(said.contains(part), "{part}: {said}");
    }
}

#[test]
fn at_most_a_hundred_errors_are_reported() {
    let objects = "sphere x 0 0 1 MAT\n".repeat(1000);
    let text = spelled(&format!("HEAD 1000\n{objects}"));
    let (_, lowered) = read(&text);
    assert_eq!(lowered.diagnostics.len(), 100);
    assert_eq!(lowered.diagnostics.errors(), 1000);
}

#[test]
fn a_declared_count_allocates_nothing() {
    // Memory or time proportional to the count would fail this test.
    for count in ["100000000", "18446744073709551616", "1e300"] {
        for text in [format!("{} {count}", super::HEAD), format!("1 1 1 {count}")] {
            let (_, lowered) = read(&text);
            assert_eq!(lowered.diagnostics.len(), 1, "{text}");
            assert!(lowered.scene.is_none());
        }
    }
}
