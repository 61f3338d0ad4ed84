//! Lines that are wrong: each costs only itself, with a warning at its place.

use super::*;
use crate::{Finding, MAX_FINDINGS};

/// The message of a finding, what it costs, and the marked part of its line in brackets.
fn report(finding: &Finding) -> String {
    let Finding {
        excerpt, marked, ..
    } = finding;
    let (before, after) = (&excerpt[..marked.start()], &excerpt[marked.end()..]);
    let hint = finding.hint.as_deref().unwrap_or("-");
    let line = format!("{before}[{}]{after}", marked.of(excerpt));
    format!("{finding} | {hint} | {}", line.trim_end())
}

/// Triangles, and what is seen of the middle of the square's lower right half: its texture
/// coordinates and its normal.
fn seen_of(model: Model) -> (usize, Option<(DVec2, DVec3)>) {
    let count = model.mesh.len();
    let seen = seen(&shape(model), 0.5, -0.5);
    (count, seen.map(|(_, _, uv, normal)| (uv, normal)))
}

/// Lines before a face of three corners, or a face beside it.
#[test]
fn a_line_that_is_wrong_costs_itself() {
    let none = "the face is left out";
    for (line, warning) in [
        (
            "v 1 2",
            "6: v: expected 3 numbers, found 2 | faces that use it are left out | v 1 2[]",
        ),
        (
            "v 1 x 2",
            "5: v: `x` is not a number | faces that use it are left out | v 1 [x] 2",
        ),
        (
            "v 1 2 1e999",
            "7: v: `1e999` is too large | faces that use it are left out | v 1 2 [1e999]",
        ),
        (
            "v 1 2 1e308",
            "7: v: `1e308` is too large | faces that use it are left out | v 1 2 [1e308]",
        ),
        (
            "v nan 0 0",
            "3: v: `nan` is not a number | faces that use it are left out | v [nan] 0 0",
        ),
        (
            "v 1 2 3 4 5 6 7 8",
            "17: v: expected at most 7 numbers | the rest is ignored | v 1 2 3 4 5 6 7 [8]",
        ),
        (
            "v 0 0 0 // é",
            "9: v: `//` is not a comment here | the rest of the line is ignored | v 0 0 0 [//] é",
        ),
        (
            "vt",
            "3: vt: expected 1 number, found 0 | it reads as 0 0 | vt[]",
        ),
        (
            "vt 0 q",
            "6: vt: `q` is not a number | it reads as 0 0 | vt 0 [q]",
        ),
        (
            "vn 0 1",
            "7: vn: expected 3 numbers, found 2 | faces that use it are flat | vn 0 1[]",
        ),
        (
            "f",
            &format!("2: f: expected at least three corners, found 0 | {none} | f[]"),
        ),
        (
            "f 1 2",
            &format!("6: f: expected at least three corners, found 2 | {none} | f 1 2[]"),
        ),
        (
            "f 1 2 9",
            &format!("7: f: refers to v 9, but there are only 4 | {none} | f 1 2 [9]"),
        ),
        (
            "f 1 -5 3",
            &format!("5: f: `-5` is out of range: only 4 v lines precede it | {none} | f 1 [-5] 3"),
        ),
        (
            "f 1 0 3",
            &format!("5: f: `0` is not an index: indices start at 1 | {none} | f 1 [0] 3"),
        ),
        (
            "f 1 9999999999 3",
            &format!(
                "5: f: `9999999999` is out of range: only 4 v lines precede it | {none} | f 1 [9999999999] 3"
            ),
        ),
        (
            "f 1 2.5 3",
            &format!(
                "5: f: `2.5` is not a corner: expected v, v/vt, v//vn or v/vt/vn | {none} | f 1 [2.5] 3"
            ),
        ),
        (
            "f 1 /2 3",
            &format!(
                "5: f: `/2` is not a corner: expected v, v/vt, v//vn or v/vt/vn | {none} | f 1 [/2] 3"
            ),
        ),
        (
            "usemtl",
            "7: usemtl: the name is missing | the faces that follow have none of its materials | usemtl[]",
        ),
        ("mtllib  ", "7: mtllib: the name is missing | - | mtllib[]"),
    ] {
        let text = format!("{SQUARE}{line}\nf 1 2 3");
        let model = model(&text);
        let reports: Vec<_> = model.warnings.iter().map(report).collect();
        assert_eq!(reports, [format!("line 5, column {warning}")], "{line}");
        assert_eq!(seen_of(model), (1, Some((DVec2::ZERO, DVec3::Z))), "{line}");
    }
}

#[test]
fn an_index_out_of_range_is_told_with_the_lines_before_it() {
    for (before, told) in [
        ("", "`-9` is out of range: no v line precedes it"),
        (
            "v 0 0 0\n",
            "`-9` is out of range: only 1 v line precedes it",
        ),
        (SQUARE, "`-9` is out of range: only 4 v lines precede it"),
    ] {
        let after = if before == SQUARE { "" } else { SQUARE };
        let model = model(&format!("{before}f -9 1 2\n{after}f 1 2 3"));
        let message = model.warnings[0].to_string();
        assert!(message.ends_with(told), "{message}");
    }
}

/// The place is that of the word, on whichever of its lines.
#[test]
fn a_continued_line_is_quoted_where_it_is_wrong() {
    for (lines, place, message, quoted) in [
        (
            "v 0 \\\r\n 1 \\\n é x",
            "line 7, column 2",
            "`é` is not a number",
            " [é] x",
        ),
        (
            "v é \\\n 1 \\\n 2",
            "line 5, column 3",
            "`é` is not a number",
            "v [é] \\",
        ),
        (
            "v 0 \\\r\\\r\\\né",
            "line 8, column 1",
            "`é` is not a number",
            "[é]",
        ),
        (
            "v 0 1\\\né 2",
            "line 5, column 5",
            "`1é` is not a number",
            "v 0 [1\\]",
        ),
        (
            "v 0 \\\n 1",
            "line 6, column 3",
            "expected 3 numbers, found 2",
            " 1[]",
        ),
        (
            "v 0 \\\n 1 \\\r\rg",
            "line 6, column 4",
            "expected 3 numbers, found 2",
            " 1 []\\",
        ),
    ] {
        let warnings = model(&format!("{SQUARE}{lines}\nf 1 2 3")).warnings;
        let cost = "faces that use it are left out";
        let expected = format!("{place}: v: {message} | {cost} | {quoted}");
        assert_eq!(
            warnings.iter().map(report).collect::<Vec<_>>(),
            [expected],
            "{lines}"
        );
    }
}

/// Indices of texture coordinates and normals are absent where they cannot be used; so are positions,
/// whose faces are left out.
#[test]
fn an_index_without_a_value_reads_as_absent() {
    let values = "vt 0 0\nvt 1 0\nvt 1 1\nvt x\nvn 0 0 -2\nvn 0 nan 1\n";
    let whole = DVec2::new(0.75, 0.25);
    let dent = DVec2::new(0.5, 0.0);
    for (face, uv, normal, warning) in [
        ("f 1/1/1 2/2/1 3/3/1", whole, -DVec3::Z, None),
        ("f 1/1/9 2/2/1 3/3/1", whole, DVec3::Z, Some("vn 9")),
        ("f 1/1/-9 2/2/1 3/3/1", whole, DVec3::Z, Some("`1/1/-9`")),
        ("f 1/1/1 2/2/1 3/9/1", dent, -DVec3::Z, Some("vt 9")),
        ("f 1/1/1 2/2/1 3/x/1", dent, -DVec3::Z, Some("`3/x/1`")),
        ("f 1/1/1 2/2/1 3/0/1", dent, -DVec3::Z, Some("`3/0/1`")),
        ("f 1/1/1 2/2/1 3/3/1/1", whole, -DVec3::Z, Some("`3/3/1/1`")),
        ("f 1/1/1 2/2/1 3/3/1 // it", whole, -DVec3::Z, Some("`//`")),
        // Said where the values are.
        ("f 1/1/2 2/2/2 3/3/2", whole, DVec3::Z, None),
        ("f 1/1/1 2/2/1 3/4/1", dent, -DVec3::Z, None),
    ] {
        let model = model(&format!("{SQUARE}{values}{face}\n"));
        let of_face = model.warnings.iter().filter(|found| found.line == 11);
        let of_face: Vec<_> = of_face.map(ToString::to_string).collect();
        assert_eq!(
            of_face.len(),
            usize::from(warning.is_some()),
            "{face} {of_face:?}"
        );
        assert!(
            of_face
                .iter()
                .all(|said| said.contains(warning.unwrap_or(""))),
            "{face} {of_face:?}"
        );
        assert_eq!(model.warnings.len() - of_face.len(), 2, "{face}");
        assert_eq!(seen_of(model), (1, Some((uv, normal))), "{face}");
    }
    // A corner without a position, before and behind the line that is wrong.
    let text = format!("f 1 2 5\n{SQUARE}v 0 0 q\nf 1 2 5\nf 5 2 3\nf 1 2 3");
    let model = model(&text);
    assert_eq!(
        messages(&model.warnings),
        ["line 6, column 7: v: `q` is not a number"]
    );
    assert_eq!(model.mesh.len(), 1);
}

#[test]
fn a_mesh_is_unreadable_only_if_no_face_is_left() {
    let errors = read_alone(&format!("{SQUARE}f 1 2\nusemtl\n\n")).expect_err("no faces");
    let shown: Vec<_> = errors.iter().map(report).collect();
    assert_eq!(
        shown,
        [
            "line 5, column 6: f: expected at least three corners, found 2 | the face is left out | f 1 2[]",
            "line 6, column 7: usemtl: the name is missing | the faces that follow have none of its materials | usemtl[]",
            "line 6, column 7: the file has no faces that can be used | - | usemtl[]",
        ]
    );
    assert_eq!(read_alone("").expect_err("nothing")[0].line, 1);
}

#[test]
fn materials_without_a_name_are_white() {
    let library = "newmtl\nKd 0 1 0\nnewmtl a\nKd 1 0 0\nnewmtl\nKd 0 0 1";
    let faces = "usemtl a\nf 1 2 3\nusemtl\nf 1 3 4";
    let text = format!("mtllib a.mtl\n{SQUARE}{faces}");
    let model = read(text.as_bytes(), |_| Ok::<_, String>(library)).expect("a mesh");
    assert_eq!(
        messages(&model.library_warnings),
        [
            "a.mtl: line 1, column 7: newmtl: the name is missing",
            "a.mtl: line 5, column 7: newmtl: the name is missing",
        ]
    );
    let colours: Vec<_> = model
        .materials
        .iter()
        .map(|one| one.as_ref().map(|one| one.diffuse))
        .collect();
    assert_eq!(colours, [None, Some([1.0, 0.0, 0.0])]);
    let shape = shape(model);
    assert_eq!(seen(&shape, 0.5, -0.5).map(|seen| seen.1), Some(1));
    assert_eq!(seen(&shape, -0.5, 0.5).map(|seen| seen.1), Some(0));
}

/// The other lines of a library count.
#[test]
fn a_line_of_a_library_that_is_wrong_costs_itself() {
    let ignored = "it has no effect here; reported once per library";
    for (line, warning) in [
        (
            "Kd 1 0",
            "7: Kd: expected one or three numbers | the line is ignored | Kd 1 0[]",
        ),
        (
            "Kd",
            "3: Kd: expected one or three numbers | the line is ignored | Kd[]",
        ),
        (
            "Ks 1 0 0 0",
            "10: Ks: expected one or three numbers | the line is ignored | Ks 1 0 0 [0]",
        ),
        (
            "Ke x",
            "4: Ke: `x` is not a number | the line is ignored | Ke [x]",
        ),
        (
            "Ns high",
            "4: Ns: `high` is not a number | the line is ignored | Ns [high]",
        ),
        (
            "Ni",
            "3: Ni: the number is missing | the line is ignored | Ni[]",
        ),
        (
            "illum 2.5",
            "7: illum: expected a whole number from 0 to 7 | the line is ignored | illum [2.5]",
        ),
        (
            "map_Kd ",
            "7: map_Kd: the path is missing | the line is ignored | map_Kd[]",
        ),
        (
            "map_Kd -s 1 1",
            "14: map_Kd: the path is missing | the line is ignored | map_Kd -s 1 1[]",
        ),
        (
            "map_Ks -clamp x",
            "8: map_Ks: -clamp: expected on or off | the option is ignored | map_Ks [-clamp] x",
        ),
        (
            "Kd 1 0 0 // red",
            "10: Kd: `//` is not a comment here | the rest of the line is ignored | Kd 1 0 0 [//] red",
        ),
        (
            "d .5",
            &format!("3: d: `.5` is ignored | {ignored} | d [.5]"),
        ),
        (
            "Tr .5\nTr .6",
            &format!("4: Tr: `.5` is ignored | {ignored} | Tr [.5]"),
        ),
        (
            "illum 9",
            "7: illum: `9` is ignored | illum 2 is used; reported once per library | illum [9]",
        ),
        (
            "map_Bump a.png",
            &format!("1: `map_Bump` is ignored | {ignored} | [map_Bump] a.png"),
        ),
        (
            "disp a.png",
            &format!("1: `disp` is ignored | {ignored} | [disp] a.png"),
        ),
        (
            "map_Ks a.png -bm 2",
            &format!("14: map_Ks: `-bm` is ignored | {ignored} | map_Ks a.png [-bm] 2"),
        ),
        (
            "map_Ks -imfchan r a.png",
            &format!("8: map_Ks: `-imfchan` is ignored | {ignored} | map_Ks [-imfchan] r a.png"),
        ),
    ] {
        let library = format!("newmtl a\n{line}\nNi 2\nnewmtl b\nKd 0 1 0");
        let mesh = format!("mtllib x.mtl\n{SQUARE}usemtl a\nf 1 2 3\nusemtl b\nf 1 3 4");
        let read = read(mesh.as_bytes(), |_| Ok::<_, String>(&library));
        let model = read.expect("a valid mesh");
        let reports: Vec<_> = model.library_warnings.iter().map(report).collect();
        assert_eq!(
            reports[0],
            format!("x.mtl: line 2, column {warning}"),
            "{line}"
        );
        let [None, Some(a), Some(b)] = &model.materials[..] else {
            panic!("{line}: {:?}", model.materials);
        };
        assert_eq!((a.index, b.diffuse), (2.0, [0.0, 1.0, 0.0]), "{line}");
        assert!(a.diffuse == [1.0; 3] || line.contains("//"), "{line}");
        assert!(a.exponent == 0.0 && a.illumination == 2, "{line}");
        assert_eq!(a.diffuse_map, None, "{line}");
    }
}

#[test]
fn what_would_not_change_the_picture_is_ignored_silently() {
    let others = "newmtl a\nKa x\nKe 0\nd 1\nd -halo 1.0\nTr 0\nbump\nKd spectral x.rfl 1\nKs xyz 1 1\n\
                  map_Kd -bm 1 -mm 0 1 -t 0 0 0 -blendu on -texres 9 a.png\nsharpness 3\n";
    let mesh = format!("mtllib x.mtl\n{SQUARE}f 1 2 3");
    let read = read(mesh.as_bytes(), |_| Ok::<_, String>(others));
    assert_eq!(
        messages(&read.expect("a valid mesh").library_warnings),
        [""; 0]
    );
}

#[test]
fn statements_before_the_first_material_are_ignored() {
    let mesh = format!("mtllib x.mtl\n{SQUARE}usemtl a\nf 1 2 3");
    let library = "Ka 1 1 1\nkd 1 0 0\nnewmtl a\nKs 1";
    let model = read(mesh.as_bytes(), |_| Ok::<_, String>(library)).expect("a valid mesh");
    assert_eq!(
        messages(&model.library_warnings),
        ["x.mtl: line 2, column 1: kd stands before the first newmtl"]
    );
    let material = model.materials[1].as_ref().expect("it is defined");
    assert_eq!((material.diffuse, material.specular), ([1.0; 3], [1.0; 3]));
}

#[test]
fn options_stand_before_and_after_the_path() {
    let path = "wood grain.png";
    for (said, scale, offset, edges) in [
        ("wood grain.png", [1.0; 2], [0.0; 2], Edges::Repeat),
        ("-s 4 4 1 wood grain.png", [4.0; 2], [0.0; 2], Edges::Repeat),
        (
            "-o .5 0 0 wood grain.png",
            [1.0; 2],
            [0.5, 0.0],
            Edges::Repeat,
        ),
        ("wood grain.png -bm 1", [1.0; 2], [0.0; 2], Edges::Repeat),
        ("wood grain.png -s 2", [2.0, 1.0], [0.0; 2], Edges::Repeat),
        (
            "-S 2 3 wood grain.png -CLAMP ON -o -1",
            [2.0, 3.0],
            [-1.0, 0.0],
            Edges::Clamp,
        ),
        (
            "-clamp on -clamp off wood grain.png",
            [1.0; 2],
            [0.0; 2],
            Edges::Repeat,
        ),
        (
            "-mm 0 1 -blendu on -cc off wood grain.png # c",
            [1.0; 2],
            [0.0; 2],
            Edges::Repeat,
        ),
    ] {
        let mesh = format!("mtllib x.mtl\n{SQUARE}usemtl a\nf 1 2 3");
        let library = format!("newmtl a\nmap_kD {said}\n");
        let model = read(mesh.as_bytes(), |_| Ok::<_, String>(&library)).expect("a valid mesh");
        assert_eq!(messages(&model.library_warnings), [""; 0], "{said}");
        let map = model.materials[1]
            .as_ref()
            .and_then(|one| one.diffuse_map.clone());
        let path = path.to_owned();
        assert_eq!(
            map,
            Some(Map {
                path,
                scale,
                offset,
                edges
            }),
            "{said}"
        );
    }
}

/// However many lines are wrong, ten are reported, and how many are not.
#[test]
fn warnings_are_limited() {
    let text = format!("{SQUARE}f 1 2 3\n{}", "f 1\nwhat\nvn x 0 0\n".repeat(1000));
    let library = "newmtl a\nKd\n".repeat(500);
    let mesh = format!("mtllib a.mtl\nmtllib b.mtl\n{text}");
    let model = read(mesh.as_bytes(), |_| Ok::<_, String>(&library)).expect("a valid mesh");
    for (found, more) in [(model.warnings, 2990), (model.library_warnings, 990)] {
        assert_eq!(found.len(), MAX_FINDINGS);
        let hints = found.iter().filter_map(|found| found.hint.as_deref());
        let counted: Vec<_> = hints.filter(|hint| hint.contains("not shown")).collect();
        assert_eq!(counted.len(), 1);
        assert!(
            counted[0].ends_with(&format!("{more} more problems not shown")),
            "{counted:?}"
        );
    }
    // A line is quoted only around the word.
    let long = format!(
        "{SQUARE}f 1 2 3\nf {} x {}\n",
        "é".repeat(9000),
        "1 ".repeat(9000)
    );
    let found = &self::model(&long).warnings[0];
    assert!(found.excerpt.len() < 800 && found.column == 3, "{found:?}");
}
