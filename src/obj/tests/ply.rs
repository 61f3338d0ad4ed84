//! `.ply`: all three encodings, what is used of them, and what hostile ones say.

use super::*;
use crate::{Finding, Format, read_as};

/// How a test file writes its values.
#[derive(Clone, Copy, PartialEq)]
enum Written {
    Text,
    Little,
    Big,
}

const ALL: [Written; 3] = [Written::Text, Written::Little, Written::Big];

/// A file with this header, between `format` and `end_header`, and rows of values, each with a type.
fn file(written: Written, header: &str, rows: &str) -> Vec<u8> {
    let format = match written {
        Written::Text => "ascii",
        Written::Little => "binary_little_endian",
        Written::Big => "binary_big_endian",
    };
    let mut file = format!(
        "ply\nformat {format} 1.0\n{}\nend_header\n",
        header.trim_end()
    )
    .into_bytes();
    for row in rows.lines() {
        for value in row.split_whitespace() {
            let (value, kind) = value.split_once(':').unwrap_or((value, "f32"));
            macro_rules! bytes {
                ($($kind:ident)*) => {
                    match kind {
                        $(stringify!($kind) => {
                            let value: $kind = value.parse().expect("a value of its type");
                            if written == Written::Big {
                                value.to_be_bytes().to_vec()
                            } else {
                                value.to_le_bytes().to_vec()
                            }
                        })*
                        _ => panic!("{kind}"),
                    }
                };
            }
            if written == Written::Text {
                file.extend_from_slice(value.as_bytes());
                file.push(b' ');
            } else {
                file.extend(bytes!(i8 u8 i16 u16 i32 u32 f32 f64));
            }
        }
        if written == Written::Text {
            file.push(b'\n');
        }
    }
    file
}

fn read_file(bytes: &[u8]) -> Result<Model, Vec<Finding>> {
    read_as(Format::Ply, bytes, no_library)
}

const XYZ: &str = "property float x\nproperty float y\nproperty float z\n";
const INDICES: &str = "element face 1\nproperty list uchar int vertex_indices";
const SQUARE: &str = "-1 -1 0\n1 -1 0\n1 1 0\n-1 1 0\n";

/// A square of one face, its header preceded by `element vertex 4`.
fn square(written: Written) -> Vec<u8> {
    let header = format!("element vertex 4\n{XYZ}{INDICES}");
    let rows = format!("{SQUARE}4:u8 0:i32 1:i32 2:i32 3:i32");
    file(written, &header, &rows)
}

#[test]
fn every_encoding_and_type_is_read() {
    let kinds = [
        ("char", "i8"),
        ("int8", "i8"),
        ("uchar", "u8"),
        ("uint8", "u8"),
        ("short", "i16"),
        ("int16", "i16"),
        ("ushort", "u16"),
        ("uint16", "u16"),
        ("int", "i32"),
        ("int32", "i32"),
        ("uint", "u32"),
        ("uint32", "u32"),
    ];
    for written in ALL {
        for (name, kind) in kinds {
            for (real, real_kind) in [
                ("float", "f32"),
                ("float32", "f32"),
                ("double", "f64"),
                ("float64", "f64"),
            ] {
                let header = format!(
                    "comment a\nobj_info b\nelement vertex 4\nproperty {real} x\nproperty {real} z\n\
                     property {real} y\nelement face 1\nproperty list {name} {name} vertex_index"
                );
                let rows = ["-1 0 -1", "1 0 -1", "1 0 1", "-1 0 1"];
                let typed = |row: &str, kind: &str| {
                    let values = row.split(' ').map(|value| format!("{value}:{kind} "));
                    values.collect::<String>() + "\n"
                };
                let rows: String = rows.iter().map(|row| typed(row, real_kind)).collect();
                let rows = rows + &typed("4 0 1 2 3", kind);
                let model = read_file(&file(written, &header, &rows)).expect("a square");
                assert_eq!(
                    (model.mesh.len(), &model.warnings[..]),
                    (2, &[][..]),
                    "{name}"
                );
                assert_eq!(seen(&shape(model), 0.5, -0.5).map(|seen| seen.0), Some(0));
            }
        }
    }
}

#[test]
fn normals_and_texture_coordinates_belong_to_vertices_and_the_rest_is_skipped() {
    for (s, t) in [("s", "t"), ("u", "v"), ("texture_u", "texture_v")] {
        let header = format!(
            "element camera 1\nproperty float f\nproperty list uchar float k\nelement nothing 7\n\
             element vertex 3\nproperty uchar flags\n{XYZ}property list short int of\n\
             property float nx\nproperty float ny\nproperty float nz\nproperty float {s}\n\
             property float {t}\n\
             element face 1\nproperty uchar flags\nproperty list uchar float texcoord\n\
             property list uchar int vertex_indices\nelement edge 1\nproperty int vertex1"
        );
        let rows = "5 2:u8 6 7\n\
                    0:u8 0 0 0 1:i16 9:i32 .6 0 .8 0 0\n\
                    0:u8 1 0 0 0:i16 .6 0 .8 1 0\n\
                    0:u8 0 1 0 2:i16 9:i32 9:i32 .6 0 .8 0 1\n\
                    7:u8 2:u8 .5 .5 3:u8 0:i32 1:i32 2:i32\n\
                    4:i32";
        for written in ALL {
            let model = read_file(&file(written, &header, rows)).expect("a triangle");
            assert_eq!(model.warnings, []);
            let (_, _, uv, shading) = seen(&shape(model), 0.25, 0.5).expect("a hit");
            assert_eq!(uv, DVec2::new(0.25, 0.5));
            assert!(shading.distance(DVec3::new(0.6, 0.0, 0.8)) < 1e-6);
        }
    }
}

/// The vertices of a dart, whose fan from the first corner would leave it.
#[test]
fn polygons_are_cut_as_those_of_obj() {
    let header = format!("element vertex 4\n{XYZ}{INDICES}");
    let rows = "1 0 0\n0 2 0\n-1 0 0\n0 .5 0\n4:u8 0:i32 1:i32 2:i32 3:i32";
    for written in ALL {
        let shape = shape(read_file(&file(written, &header, rows)).expect("a dart"));
        assert!(seen(&shape, 0.0, 0.2).is_none());
        assert!(seen(&shape, 0.0, 0.7).is_some());
    }
}

#[test]
fn line_ends_of_all_kinds_are_read() {
    for end in ["\n", "\r\n", "\r"] {
        let text = String::from_utf8(square(Written::Text)).expect("text");
        let model = read_file(text.replace('\n', end).as_bytes()).expect("a square");
        assert_eq!(model.mesh.len(), 2, "{end:?}");
        for written in [Written::Little, Written::Big] {
            let bytes = square(written);
            let body = bytes.windows(11).position(|part| part == b"end_header\n");
            let (header, body) = bytes.split_at(body.expect("a header") + 11);
            let header = std::str::from_utf8(header)
                .expect("text")
                .replace('\n', end);
            let model = read_file(&[header.as_bytes(), body].concat()).expect("a square");
            assert_eq!(model.mesh.len(), 2, "{end:?}");
        }
    }
}

/// What is said of a file: its warnings, or its errors.
fn said(bytes: &[u8]) -> (bool, Vec<String>) {
    let shown = |findings: &[Finding]| {
        let shown = findings.iter().map(|finding| {
            let hint = finding.hint.as_deref().unwrap_or_default();
            format!(
                "{finding}: {:?}: {hint}",
                finding.marked.of(&finding.excerpt)
            )
        });
        shown.collect()
    };
    match read_file(bytes) {
        Ok(model) => (true, shown(&model.warnings)),
        Err(errors) => (false, shown(&errors)),
    }
}

/// One wrong vertex or face costs only what uses it, in text and in numbers.
#[test]
fn what_one_row_has_wrong_costs_only_that() {
    let header =
        format!("element vertex 5\n{XYZ}element face 2\nproperty list uchar int vertex_indices");
    let nan = "nan 9 9";
    for (row, faces, text, numbers) in [
        (
            nan,
            "3:u8 0:i32 1:i32 2:i32\n3:u8 0:i32 1:i32 4:i32",
            "line 14, column 1: vertex 4: `nan` is not a number: \"nan\": faces that use it are left out",
            "line 9, column 1: vertex 4: x is not a number (byte 217): \"00 00 c0 7f\": faces that use it are left out",
        ),
        (
            "9 inf 9",
            "3:u8 0:i32 1:i32 2:i32\n3:u8 0:i32 1:i32 4:i32",
            "line 14, column 3: vertex 4: `inf` is not a number: \"inf\": faces that use it are left out",
            "line 9, column 1: vertex 4: y is infinite (byte 221): \"00 00 80 7f\": faces that use it are left out",
        ),
        (
            "9 9 9",
            "3:u8 0:i32 1:i32 2:i32\n3:u8 0:i32 1:i32 5:i32",
            "line 16, column 7: face 1: 5 is not the number of a vertex: \"5\": the face is left out",
            "line 9, column 1: face 1: 5 is not the number of a vertex (byte 251): \"05 00 00 00\": the face is left out",
        ),
        (
            "9 9 9",
            "2:u8 0:i32 1:i32\n3:u8 0:i32 1:i32 2:i32",
            "line 15, column 1: face 0: expected at least three corners, found 2: \"2\": the face is left out",
            "line 9, column 1: face 0: expected at least three corners, found 2 (byte 229): \"02\": the face is left out",
        ),
        (
            "9 9 9",
            "3:u8 0:i32 -1:i32 1:i32\n3:u8 0:i32 1:i32 2:i32",
            "line 15, column 5: face 0: -1 is not the number of a vertex: \"-1\": the face is left out",
            "line 9, column 1: face 0: -1 is not the number of a vertex (byte 234): \"ff ff ff ff\": the face is left out",
        ),
    ] {
        let rows = format!("{SQUARE}{row}\n{faces}");
        assert_eq!(
            said(&file(Written::Text, &header, &rows)),
            (true, vec![text.to_owned()])
        );
        let bytes = file(Written::Little, &header, &rows);
        assert_eq!(said(&bytes), (true, vec![numbers.to_owned()]));
    }
}

#[test]
fn lines_of_text_are_checked_word_by_word() {
    let face = "3:u8 0:i32 1:i32 2:i32";
    for (rows, expected) in [
        (
            format!("{SQUARE}{face} 7"),
            "line 14, column 9: face 0: there are more values than properties: \"7\": the rest is ignored",
        ),
        (format!("{SQUARE}{face}\nrest"), ""),
        (format!("\n{SQUARE}\n  \n{face}"), ""),
        (
            SQUARE.replace("1 1 0", "1 1 1e999") + face,
            "line 12, column 5: vertex 2: `1e999` is too large: \"1e999\": faces that use it are left out",
        ),
        (
            SQUARE.replace("-1 1 0", "-1 1") + face,
            "line 13, column 5: vertex 3: a value is missing: \"\": faces that use it are left out",
        ),
        (
            SQUARE.replace("-1 1 0", "-0 x 0") + face,
            "line 13, column 4: vertex 3: `x` is not a number: \"x\": faces that use it are left out",
        ),
    ] {
        let header = format!("element vertex 4\n{XYZ}{INDICES}");
        let bytes = file(Written::Text, &header, &rows);
        let (is_read, said) = said(&bytes);
        let rest = said.first().map_or("", String::as_str);
        let is_cut = rows.contains("1 1 1e999");
        assert_eq!((is_read || is_cut, rest), (true, expected), "{rows}");
    }
}

/// Checks what is said of files that cannot be used as a whole.
fn check_refused(cases: Vec<(Vec<u8>, &str)>) {
    for (bytes, expected) in cases {
        let shown = String::from_utf8_lossy(&bytes[..bytes.len().min(200)]).into_owned();
        let errors = read_file(&bytes).expect_err(&shown);
        let last = errors.last().expect("an error");
        assert_eq!(last.to_string(), expected, "{shown}");
    }
}

#[test]
fn hostile_headers_are_refused_at_their_places() {
    check_refused(vec![
        (b"".to_vec(), "line 1, column 1: `` begins no .ply file"),
        (
            b"\0\xff\0".to_vec(),
            "line 1, column 1: `\\u{0}\u{fffd}\\u{0}` begins no .ply file",
        ),
        (b"ply\n".to_vec(), "line 1, column 4: the header has no end"),
        (
            b"ply\ncomment".to_vec(),
            "line 2, column 8: the header has no end",
        ),
        (
            b"ply\nformat ascii 1.0\nelement a 1\nproperty int b\nend_header".to_vec(),
            "line 5, column 11: the file ends in element 0 of 1",
        ),
        (
            b"ply\nend_header\n".to_vec(),
            "line 2, column 1: the header does not say its format",
        ),
        (
            b"ply\nformat latin 1.0\n".to_vec(),
            "line 2, column 8: format: `latin` is not a format",
        ),
        (
            b"ply\nformat\n".to_vec(),
            "line 2, column 7: format: `` is not a format",
        ),
        (
            b"ply\nelement vertex -1\n".to_vec(),
            "line 2, column 16: element: `-1` is not a count",
        ),
        (
            b"ply\nelement vertex 1e9\n".to_vec(),
            "line 2, column 16: element: `1e9` is not a count",
        ),
        (
            b"ply\nproperty float x\n".to_vec(),
            "line 2, column 1: property: there is no element yet",
        ),
        (
            b"ply\nelement a 1\nproperty real x\n".to_vec(),
            "line 3, column 10: property: `real` is not a type",
        ),
        (
            b"ply\nelement a 1\nproperty list float int x\n".to_vec(),
            "line 3, column 15: property: the length of a list is no whole number",
        ),
        (
            ["ply\n", &"element a 1\n".repeat(1001)]
                .concat()
                .into_bytes(),
            "line 1002, column 1: more than 1000 elements",
        ),
    ]);
}

#[test]
fn hostile_rows_are_refused_at_their_places() {
    let vertices = format!("element vertex 4\n{XYZ}");
    check_refused(vec![
        (
            file(
                Written::Little,
                "element vertex 100000000\nproperty float x",
                "",
            ),
            "line 5, column 1: vertices have no coordinates",
        ),
        (
            file(
                Written::Little,
                &format!("element vertex 100000000\n{XYZ}"),
                "",
            ),
            "line 7, column 1: more than 50331648 vertices",
        ),
        (
            file(
                Written::Little,
                &format!("element vertex 50000000\n{XYZ}"),
                "1 2 3 4",
            ),
            "line 7, column 1: the file ends in vertex 1 of 50000000 (byte 138)",
        ),
        (
            file(
                Written::Text,
                &format!("element vertex 50000000\n{XYZ}"),
                "1 2 3\n4 5 6\n",
            ),
            "line 9, column 6: the file ends in vertex 2 of 50000000",
        ),
        (
            file(
                Written::Little,
                &format!("{vertices}element face 1\nproperty int a"),
                &format!("{SQUARE}1:i32"),
            ),
            "line 9, column 1: faces have no corners",
        ),
        (
            file(Written::Text, INDICES, "3 0 1 2"),
            "line 5, column 1: the faces do not follow vertices",
        ),
        (
            file(
                Written::Little,
                &format!(
                    "{vertices}element face 4294967295\nproperty list uint int vertex_indices"
                ),
                &format!("{SQUARE}4294967295:u32 0:i32"),
            ),
            "line 9, column 1: the file ends in face 0 of 4294967295 (byte 233)",
        ),
        (
            file(
                Written::Big,
                "element a 18446744073709551615\nproperty list uint double b\n",
                "4294967295:u32",
            ),
            "line 5, column 1: the file ends in element 0 of 18446744073709551615 (byte 107)",
        ),
        (
            file(Written::Text, "element a 18446744073709551615\n", ""),
            "line 4, column 1: the file has no faces that can be used",
        ),
        (
            file(Written::Text, &vertices, SQUARE),
            "line 7, column 1: the file has no faces that can be used",
        ),
        (
            file(
                Written::Little,
                &format!("{vertices}{INDICES}"),
                &format!("{SQUARE}3:u8 0:i32 1:i32 7:i32"),
            ),
            "line 9, column 1: the file has no faces that can be used",
        ),
    ]);
}

#[test]
fn every_beginning_of_a_file_is_refused_and_most_changes_are_survived() {
    for written in ALL {
        let bytes = square(written);
        let end = bytes.trim_ascii_end().len();
        for length in 0..end {
            assert!(read_file(&bytes[..length]).is_err(), "{length}");
        }
        for at in 0..bytes.len() {
            for value in [0, b' ', b'\n', b'9', 0x7f, 0xff] {
                let mut changed = bytes.clone();
                changed[at] = value;
                // Whatever it means.
                drop(read_file(&changed));
            }
        }
    }
}

#[test]
fn colours_give_one_warning() {
    let header = format!(
        "element vertex 4\n{XYZ}property uchar red\nproperty uchar green\nproperty uchar blue\n{INDICES}\nproperty uchar red"
    );
    let rows = SQUARE.replace(" 0\n", " 0 9:u8 9:u8 9:u8\n") + "4:u8 0:i32 1:i32 2:i32 3:i32 1:u8";
    for written in ALL {
        let model = read_file(&file(written, &header, &rows)).expect("a square");
        let warnings = messages(&model.warnings);
        assert_eq!(
            warnings,
            ["line 7, column 16: the colours of the mesh are not drawn"]
        );
    }
}
