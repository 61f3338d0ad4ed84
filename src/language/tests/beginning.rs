//! Errors in the beginning of a text that hold for the whole.

use std::fs;
use std::path::Path;

use super::read_as;
use crate::{Language, errors_of_beginning};
use scene::Meshes;

/// The texts of the sample scenes.
fn scenes() -> Vec<(Language, String)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let paths = fs::read_dir(folder)
        .expect("a folder")
        .map(|entry| entry.expect("an entry").path());
    let scenes: Vec<_> = paths
        .filter_map(|path| {
            Some((
                Language::of_path(&path).ok()?,
                fs::read_to_string(path).expect("a text"),
            ))
        })
        .collect();
    assert!(
        Language::ALL
            .iter()
            .all(|language| scenes.iter().any(|(of, _)| of == language))
    );
    scenes
}

#[test]
fn valid_scenes_have_no_error_wherever_they_are_cut() {
    for (language, text) in scenes() {
        let cuts = (0..text.len()).step_by(1 + text.len() / 250);
        for cut in cuts.filter(|&cut| text.is_char_boundary(cut)) {
            let beginning = &text[..cut];
            let found = errors_of_beginning(language, beginning);
            assert_eq!(found.first_error(), None, "{beginning}");
        }
    }
}

#[test]
fn errors_of_a_beginning_are_errors_of_the_whole() {
    let mut found = 0;
    for (language, text) in scenes() {
        let boundary = |at: &usize| text.is_char_boundary(*at) && text.is_char_boundary(at + 1);
        for at in (0..text.len() - 1)
            .step_by(1 + text.len() / 40)
            .filter(boundary)
        {
            for by in ["", "x", " 9 ", "<", "\n"] {
                let bent = [&text[..at], by, &text[at + 1..]].concat();
                for cut in [at + 70, usize::midpoint(at, bent.len())] {
                    let Some(beginning) = bent.get(..cut) else {
                        continue;
                    };
                    let wrong = errors_of_beginning(language, beginning);
                    let Some(wrong) = wrong.first_error() else {
                        continue;
                    };
                    found += 1;
                    let (_, whole) = read_as(language, &bent, &Meshes::default());
                    assert!(
                        0 < whole.diagnostics.errors(),
                        "{}: {beginning}",
                        wrong.message
                    );
                }
            }
        }
    }
    assert!(100 < found, "{found}");
}

#[test]
fn hopeless_beginnings_are_errors() {
    use Language::{Dat, Ray, Xml};
    let nested = "<a>".repeat(200_000);
    let blank = " \n".repeat(5000);
    let comments = "// \n".repeat(5000);
    let cut = format!("{comments}/");
    let long = "a".repeat(70_000);
    let digits = "1".repeat(70_000);
    let numbers = "0.25 1 -3.5 12.125 7 0.5\n".repeat(5000);
    let lights = format!("0 0 0 2 {}", "1 ".repeat(5000));
    let spheres = format!(
        "0 0 0 1 0 0 0 1 1 1 1 {}",
        "sphere 0 0 0 1 0 0 0 .5 .5 .5 0 0 0 1 0 0 1\n".repeat(50)
    );
    let cases: &[(Language, &str, Option<&str>)] = &[
        // Comments, white space and unknown records may precede any scene.
        (Ray, &blank, None),
        (Xml, &blank, None),
        (Ray, &cut, None),
        (Dat, &comments, None),
        (Dat, &numbers, None),
        (Dat, &long, None),
        (Ray, &long, Some("a word of more than 1024 bytes")),
        (Ray, &digits, None),
        (Xml, &long, Some("this is not part of XML")),
        (
            Ray,
            &numbers,
            Some("nLights: must be a whole number, 1 or more, not `12.125`"),
        ),
        (
            Ray,
            &lights,
            Some("nObjects: at least 4986 numbers too many after it"),
        ),
        (
            Ray,
            &spheres,
            Some("nObjects is `1`, but more objects follow"),
        ),
        (Ray, "0 0 0 1 0 0 0 1 1 1 3 sphere 0 0 0 1 0 0 0 1", None),
        (Ray, "0 0 0 100 0 0 0 1 1 1 0 0", None),
        (
            Ray,
            "0 0 0 spere 0 0 0 1 0 0 0 1 1 1 1 1 1 1 1 1 1 1 1 1",
            Some("nLights: missing before `spere`"),
        ),
        (
            Dat,
            "obj spere ID 1\nobj",
            Some("obj: unknown kind `spere`"),
        ),
        (Dat, "render 2 ID 5 ID 6\nobj", None),
        (
            Xml,
            "<xml><a b='1' b='2'/> and a good deal more than is cut, and more than is cut, and more, and more",
            Some("attribute `b`: given twice"),
        ),
        (
            Xml,
            &nested,
            Some("more than 131072 levels of elements are not supported"),
        ),
        (
            Xml,
            "<xml><!-- -- and more than is cut, and more than is cut, and more, and more, and more",
            None,
        ),
    ];
    for (language, text, expected) in cases {
        let found = errors_of_beginning(*language, text);
        let message = found.first_error().map(|error| error.message.as_str());
        assert_eq!(message, *expected, "{language:?} {text:.60}");
    }
}
