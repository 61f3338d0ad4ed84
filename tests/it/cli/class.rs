//! `compare` of many: a class handed in, and what the table and the four kinds of reports say of it.

use std::ffi::OsStr;
use std::os::unix::ffi::OsStrExt;
use std::os::unix::fs::symlink;

use super::*;
use serde_json::Value;

/// A ball on a floor under a lamp and a second light, in whose shadow something may be put.
fn scene(lights: &str, objects: &str, eye: &str) -> String {
    let count = 2 + objects.lines().count();
    format!(
        "{lights}\n{count}\nsphere 0 0 0 1 .2 .2 .2 .7 .3 .3 0 0 0 1 0 0 1\n\
         sphere 0 -101 0 100 .2 .2 .2 .6 .6 .6 0 0 0 1 0 0 1\n{objects}\
         // view: eye {eye} target 0 0 0 up 0 1 0 fov 40 size 40 30\n"
    )
}

const LIGHTS: &str = ".2 .2 .2\n2 -4 6 4 .8 .8 .8\n3 5 5 .4 .4 .5";
const EYE: &str = "0 1 6";

/// A class: what each hands in, the verdict, and words of the reason.
fn class(place: &Place) -> Vec<(&'static [u8], &'static str, &'static str)> {
    let reference = scene(LIGHTS, "", EYE);
    place.write("ref.ray", &reference);
    place.stderr("render ref.ray -o ref.ppm --spp 1", 0);
    let picture = place.read("ref.ppm");
    let head = b"P6\n40 30\n255\n";
    let pixels = picture.strip_prefix(head).expect("a picture").to_vec();
    let ppm = |pixels: &[u8]| [head, pixels].concat();
    let shifted = [&pixels[3..], &pixels[..3]].concat();
    let gamma: Vec<u8> = pixels
        .iter()
        .map(|&level| level.saturating_add(level / 2))
        .collect();
    let noise = pixels.iter().zip((0..7).cycle());
    let noise: Vec<u8> = noise
        .map(|(level, add)| level.saturating_add(add))
        .collect();
    fs::create_dir_all(place.at("class/ann")).expect("folders");
    let shade = "sphere -1 2.2 1.5 .6 .2 .2 .2 .2 .6 .2 0 0 0 1 0 0 1\n";
    let one_light = ".2 .2 .2\n1 -4 6 4 .8 .8 .8";
    let huge = reference.replace("40 30", "16000 16000 spp 65536");
    let files: &[(&[u8], Vec<u8>, &str, &str)] = &[
        (b"\"q\",'x.ppm", picture.clone(), "alike", ""),
        (
            b"&amp;]]><script>alert(1)<script>.ppm",
            picture.clone(),
            "alike",
            "",
        ),
        (b"=1+1.ppm", picture.clone(), "alike", ""),
        (b"a\nb\x1b[31m.ppm", picture.clone(), "alike", ""),
        (
            b"ann/gamma.ppm",
            ppm(&gamma),
            "different",
            "in the reference: ",
        ),
        (b"ann/noise.ppm", ppm(&noise), "different", ""),
        (b"ann/shifted.ppm", ppm(&shifted), "different", ""),
        (b"bad\xff.ppm", picture.clone(), "alike", ""),
        (b"broken.ray", b"1 1 1 1".to_vec(), "failed", "line 1:7"),
        (b"cut.ppm", picture[..900].to_vec(), "failed", "truncated"),
        (
            b"dark.ray",
            scene(one_light, "", EYE).into(),
            "different",
            "a light is missing",
        ),
        (
            b"empty.png",
            Vec::new(),
            "failed",
            "not in a supported picture format",
        ),
        (
            b"eye.ray",
            scene(LIGHTS, "", "0 2 6").into(),
            "different",
            "seen from (0, 2, 6)",
        ),
        (
            b"huge.ppm",
            b"P6\n4294967295 4294967295\n255\n".to_vec(),
            "failed",
            "is ",
        ),
        (b"huge.ray", huge.into(), "different", ""),
        (b"right.ray", reference.clone().into(), "alike", ""),
        (
            b"shade.ray",
            scene(LIGHTS, shade, EYE).into(),
            "different",
            "the reference is lit by light 1 (line 2)",
        ),
        (
            b"small.ppm",
            b"P6\n1 1\n255\n123".to_vec(),
            "different",
            "is 1x1, the reference 40x30",
        ),
    ];
    let folder = place.at("class");
    for (name, content, ..) in files {
        fs::write(folder.join(OsStr::from_bytes(name)), content).expect("written");
    }
    // What is not looked at.
    place.write("class/notes.txt", "-");
    place.write("class/.hidden.ppm", "-");
    symlink(place.at("ref.ppm"), folder.join("link.ppm")).expect("a link");
    symlink("/", folder.join("root")).expect("a link");
    files
        .iter()
        .map(|(name, _, verdict, reason)| (*name, *verdict, *reason))
        .collect()
}

const REPORTS: &str = "--report a.html --report a.csv --report a.json --report a.xml";

#[test]
fn a_class_is_reported_in_all_forms() {
    let place = Place::new();
    let expected = class(&place);
    let ran = place.run(&format!(
        "compare ref.ray class --spp 1 --tolerance 1 {REPORTS}"
    ));
    let [table, notes] = [&ran.stdout, &ran.stderr].map(|text| String::from_utf8_lossy(text));
    assert_eq!(ran.status.code(), Some(65), "{notes}");
    assert!(
        notes.contains("note: 2 links in the folders not followed\n"),
        "{notes}"
    );
    let [html, csv, json, xml] = ["html", "csv", "json", "xml"]
        .map(|extension| String::from_utf8(place.read(&format!("a.{extension}"))).expect("text"));
    let json: Value = serde_json::from_str(&json).expect("JSON");
    let rows = json["submissions"].as_array().expect("rows");
    assert_eq!(rows.len(), expected.len(), "{table}");
    let count = |verdict: &str| expected.iter().filter(|(_, of, _)| *of == verdict).count();
    for ((name, verdict, reason), row) in expected.iter().zip(rows) {
        let name = format!("class/{}", String::from_utf8_lossy(name));
        assert_eq!(row["submission"], name.as_str());
        assert_eq!(row["verdict"], *verdict, "{name}");
        let said = row["reason"].as_str().unwrap_or_default();
        assert!(said.contains(reason), "{name}: {said}");
    }
    for verdict in ["alike", "different", "failed"] {
        assert_eq!(json[verdict], count(verdict), "{verdict}");
        let lines = table
            .lines()
            .filter(|line| line.starts_with(&format!("{verdict} ")));
        assert_eq!(lines.count(), count(verdict), "{table}");
        let rows = html.matches(&format!("<tr class=\"{verdict}\">")).count();
        assert_eq!(rows, count(verdict));
        let cells = csv.matches(&format!(",{verdict},")).count();
        assert_eq!(cells, count(verdict), "{csv}");
    }
    // No name is anything but text.
    assert!(!table.contains('\u{1b}') && !csv.contains('\u{1b}'));
    assert!(
        csv.contains("\r\n\"class/\"\"q\"\",'x.ppm\",ref.ray,alike,40,30,0,0,0,,"),
        "{csv}"
    );
    assert_eq!(html.matches("<script>").count(), 1);
    assert!(html.contains("&amp;amp;]]&gt;&lt;script&gt;alert(1)&lt;script&gt;.ppm"));
    assert!(html.contains("content=\"default-src 'none'; img-src data:;"));
    assert!(!html.contains("http:") && !html.contains("https:"));
    check_junit(&xml, expected.len(), count("different"), count("failed"));
}

/// Checks what the schema of `JUnit` reports demands.
#[track_caller]
fn check_junit(xml: &str, tests: usize, failures: usize, errors: usize) {
    let document = roxmltree::Document::parse(xml).expect("well-formed");
    let suites = document.root_element();
    assert_eq!(suites.tag_name().name(), "testsuites");
    let suite = suites.first_element_child().expect("a suite");
    for element in [suites, suite] {
        for (name, count) in [("tests", tests), ("failures", failures), ("errors", errors)] {
            assert_eq!(element.attribute(name), Some(&*count.to_string()), "{name}");
        }
    }
    assert!(suite.attribute("name").is_some());
    let cases: Vec<_> = suite
        .children()
        .filter(roxmltree::Node::is_element)
        .collect();
    assert_eq!(cases.len(), tests);
    let mut found = [0, 0];
    for case in cases {
        assert_eq!(case.tag_name().name(), "testcase");
        assert!(case.attribute("name").is_some() && case.attribute("classname").is_some());
        let inside = case.first_element_child().expect("an outcome");
        let kind = inside.tag_name().name();
        match kind {
            "failure" => found[0] += 1,
            "error" => found[1] += 1,
            _ => assert_eq!(kind, "system-out"),
        }
        if kind != "system-out" {
            assert!(inside.attribute("message").is_some() && inside.attribute("type").is_some());
        }
    }
    assert_eq!(found, [failures, errors]);
}

#[test]
fn a_folder_of_references_is_matched_by_name() {
    let place = Place::new();
    for folder in ["ref", "class/ann", "class/bob"] {
        fs::create_dir_all(place.at(folder)).expect("folders");
    }
    let [dark, light] = [b"P6\n1 1\n255\n\0\0\0", b"P6\n1 1\n255\n~~~"];
    place.write("ref/a.ppm", dark);
    place.write("ref/b.ppm", light);
    place.write("class/ann/a.ppm", dark);
    place.write("class/ann/b.ppm", dark);
    place.write("class/bob/b.tif", light);
    place.write("class/bob/c.ppm", light);
    let ran = place.run("compare ref class --json");
    assert_eq!(ran.status.code(), Some(2));
    let json: Value = serde_json::from_slice(&ran.stdout).expect("JSON");
    let rows = json["submissions"].as_array().expect("rows");
    let rows = rows.iter().map(|row| {
        let text = |key: &str| row[key].as_str().unwrap_or("-").to_owned();
        [text("submission"), text("reference"), text("verdict")].join(" ")
    });
    let rows: Vec<_> = rows.collect();
    let expected = [
        "class/ann/a.ppm ref/a.ppm alike",
        "class/ann/b.ppm ref/b.ppm different",
        "class/bob/b.tif ref/b.ppm alike",
        "class/bob/c.ppm - failed",
    ];
    assert_eq!(rows, expected);
}

#[test]
fn reports_and_codes_of_many() {
    let place = Place::new();
    fs::create_dir(place.at("empty")).expect("a folder");
    let dark = b"P6\n1 1\n255\n\0\0\0";
    for name in ["a.ppm", "b.ppm", "c.ppm"] {
        place.write(name, dark);
    }
    place.write("d.ppm", b"P6\n1 1\n255\n~~~");
    place.write("t.dat", TEXTURED);
    place.write("skin.csv", SKIN);
    place.write("t.dat", TEXTURED.replace("skin.ppm", "skin.csv"));
    for (words, code, reason) in [
        ("a.ppm b.ppm c.ppm", 0, ""),
        ("a.ppm b.ppm d.ppm", 1, ""),
        ("a.ppm d.ppm none.ppm", 66, ""),
        ("a.ppm b.ppm --report r.csv", 0, "wrote r.csv"),
        ("none.ppm b.ppm c.ppm", 66, "none.ppm: no such file"),
        ("a.ppm empty", 2, "empty holds no picture and no scene"),
        (
            "a.ppm b.ppm --report b.ppm",
            2,
            "use the extension .html, .csv, .json or .xml",
        ),
        ("a.ppm b.ppm c.ppm -o d.png", 2, "--report"),
        ("a.ppm b.ppm --report none/r.csv", 73, "no such folder"),
        (
            "t.dat t.dat --spp 1 --report skin.csv",
            2,
            "cannot overwrite skin.csv: t.dat uses it",
        ),
    ] {
        let said = place.stderr(&format!("compare {words}"), code);
        assert!(said.contains(reason), "{words}: {said}");
    }
    assert_eq!(place.read("skin.csv"), SKIN.as_bytes());
}
