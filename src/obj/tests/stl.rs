//! `.stl`: text and numbers, what is used of them, and what hostile ones say.

use super::*;
use crate::{Finding, Format, read_as};

type Facet = [[f32; 3]; 3];

const LEFT: Facet = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
const RIGHT: Facet = [[1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]];

/// A file of numbers that begins with `head` and announces so many facets.
fn numbers(head: &str, announced: u32, facets: &[Facet]) -> Vec<u8> {
    let mut bytes = head.as_bytes().to_vec();
    bytes.resize(80, b' ');
    bytes.extend(announced.to_le_bytes());
    for facet in facets {
        for corner in [[f32::NAN; 3]].iter().chain(facet) {
            bytes.extend(corner.iter().flat_map(|value| value.to_le_bytes()));
        }
        bytes.extend([7, 7]);
    }
    bytes
}

fn text(facets: &[Facet]) -> String {
    let corner = |[x, y, z]: &[f32; 3]| format!("   vertex {x} {y} {z}\n");
    let facet = |facet: &Facet| {
        let corners: String = facet.iter().map(corner).collect();
        format!(" facet normal 0 0 1\n  outer loop\n{corners}  endloop\n endfacet\n")
    };
    let facets: String = facets.iter().map(facet).collect();
    format!("solid a b c\n{facets}endsolid a b c\n")
}

fn read_file(bytes: &[u8]) -> Result<Model, Vec<Finding>> {
    read_as(Format::Stl, bytes, no_library)
}

#[test]
fn text_and_numbers_are_told_apart_by_the_size() {
    let both = [LEFT, RIGHT];
    let plain = text(&both);
    for (name, bytes) in [
        ("text", plain.clone().into_bytes()),
        (
            "capitals",
            plain
                .to_uppercase()
                .replacen("SOLID", "solid", 1)
                .into_bytes(),
        ),
        ("returns", plain.replace('\n', "\r\n").into_bytes()),
        (
            "two solids",
            [text(&[LEFT]), text(&[RIGHT])].concat().into_bytes(),
        ),
        ("no end", plain.replace("endsolid a b c\n", "").into_bytes()),
        ("numbers", numbers("", 2, &both)),
        (
            "numbers that begin like a text",
            numbers("solid cube", 2, &both),
        ),
    ] {
        let model = read_file(&bytes).unwrap_or_else(|errors| panic!("{name}: {}", errors[0]));
        assert_eq!(
            (model.mesh.len(), &model.warnings[..]),
            (2, &[][..]),
            "{name}"
        );
        assert_eq!(model.materials, [None]);
        let shape = shape(model);
        for (place, triangle) in [(0.2, Some(0)), (0.8, Some(1)), (1.2, None)] {
            assert_eq!(
                seen(&shape, place, place).map(|seen| seen.0),
                triangle,
                "{name}"
            );
        }
    }
}

/// Checks whether files can be read, and what is said of them last.
fn check_said<const N: usize>(cases: [(Vec<u8>, bool, &str); N]) {
    for (bytes, is_read, said) in cases {
        let shown = String::from_utf8_lossy(&bytes[..bytes.len().min(300)]).into_owned();
        let read = read_file(&bytes);
        let found = match &read {
            Ok(model) => messages(&model.warnings),
            Err(errors) => messages(errors),
        };
        assert_eq!(read.is_ok(), is_read, "{shown} {found:?}");
        let last = found.last().map_or("", String::as_str);
        assert!(
            last.ends_with(said) && said.is_empty() == last.is_empty(),
            "{shown}\n{last}\n{said}"
        );
    }
}

#[test]
fn what_one_facet_of_a_text_has_wrong_costs_only_that() {
    let changed = |from: &str, to: &str| text(&[LEFT, RIGHT]).replacen(from, to, 1).into_bytes();
    check_said([
        (
            changed("vertex 1 0 0", "vertex nan 0 0"),
            true,
            "line 5, column 11: facet 1, vertex 2: `nan` is not a number",
        ),
        (
            changed("vertex 1 0 0", "vertex 1 1e400 x"),
            true,
            "line 5, column 13: facet 1, vertex 2: `1e400` is too large",
        ),
        (
            changed("vertex 1 0 0", "vertex 1 0"),
            true,
            "line 5, column 14: facet 1, vertex 2: expected 3 coordinates, found 2",
        ),
        (
            changed("vertex 1 0 0", "vertex 1 0 0 0"),
            true,
            "line 5, column 17: expected 3 coordinates",
        ),
        (
            changed("   vertex 1 0 0\n", ""),
            true,
            "line 7, column 2: 1 facet has not three corners, the first of them here",
        ),
        (
            changed("endloop", "vertex 5 5 5"),
            true,
            "line 8, column 2: 1 facet has not three corners, the first of them here",
        ),
        (
            changed("outer", "inner"),
            true,
            "line 3, column 3: `inner` is ignored",
        ),
        (changed(" endfacet\n", ""), true, ""),
    ]);
}

#[test]
fn what_one_facet_of_numbers_has_wrong_costs_only_that() {
    let wrong = |value: f32, axis: usize| {
        let mut facet = LEFT;
        facet[1][axis] = value;
        numbers("", 2, &[RIGHT, facet])
    };
    let flat = [[1.0; 3], [1.0; 3], [0.0; 3]];
    check_said([
        (
            wrong(f32::NAN, 0),
            true,
            "line 1, column 1: facet 2, vertex 2: x is NaN (byte 158)",
        ),
        (
            wrong(f32::INFINITY, 1),
            true,
            "line 1, column 1: facet 2, vertex 2: y is inf (byte 162)",
        ),
        (
            wrong(f32::NEG_INFINITY, 2),
            true,
            "line 1, column 1: facet 2, vertex 2: z is -inf (byte 166)",
        ),
        (
            numbers("", 4, &[LEFT, flat, RIGHT, flat]),
            true,
            "line 1, column 1: 2 facets have two equal corners, the first of them here (byte 134)",
        ),
        (
            numbers("", 1, &[LEFT, RIGHT]),
            true,
            "line 1, column 1: 50 bytes follow the last of 1 facets (byte 134)",
        ),
        (
            numbers("", 1, &[flat]),
            false,
            "line 1, column 1: the file has no facets that can be used",
        ),
        (
            numbers("", 0, &[]),
            false,
            "line 1, column 1: the file has no facets that can be used",
        ),
        (
            numbers("", u32::MAX, &[LEFT]),
            false,
            "line 1, column 1: the file is cut short: it has 134 bytes and announces 4294967295 facets",
        ),
        (
            numbers("solid", u32::MAX, &[LEFT]),
            false,
            "the file has no facets that can be used",
        ),
        (
            b"".to_vec(),
            false,
            "line 1, column 1: this is no .stl file",
        ),
        (
            b"solid".to_vec(),
            false,
            "line 1, column 1: the file has no facets that can be used",
        ),
        (
            b"ply\n".to_vec(),
            false,
            "line 1, column 1: this is no .stl file",
        ),
    ]);
}

#[test]
fn every_beginning_and_every_changed_byte_is_survived() {
    for bytes in [
        text(&[LEFT, RIGHT]).into_bytes(),
        numbers("", 2, &[LEFT, RIGHT]),
    ] {
        for length in 0..bytes.len() {
            drop(read_file(&bytes[..length]));
        }
        for at in 0..bytes.len() {
            for value in [0, b' ', b'\n', b'9', 0x7f, 0xff] {
                let mut changed = bytes.clone();
                changed[at] = value;
                drop(read_file(&changed));
            }
        }
    }
}
