//! Libraries: what is kept of them, and the options of their maps.

use super::*;

/// What a mesh has of a library whose material a is used.
fn read_library(library: &str) -> Model {
    let mesh = format!("mtllib x.mtl\n{SQUARE}usemtl a\nf 1 2 3");
    let read = read(mesh.as_bytes(), |_| Ok::<_, String>(library));
    read.expect("a valid mesh")
}

/// A word that is no value of the option before it may be the path.
#[test]
fn an_option_takes_no_word_but_its_value() {
    let ignored = |place: &str| Some(format!("{place}: map_Kd: `-imfchan` is ignored"));
    let no_switch = |place: &str| Some(format!("{place}: map_Kd: -clamp: expected on or off"));
    for (said, warning) in [
        ("-clamp t.png", no_switch("line 2, column 8")),
        ("t.png -clamp", no_switch("line 2, column 14")),
        ("-clamp -s 1 t.png", no_switch("line 2, column 8")),
        ("-clamp OFF t.png", None),
        ("-imfchan t.png", ignored("line 2, column 8")),
        ("-imfchan L t.png", ignored("line 2, column 8")),
        ("t.png -imfchan z", ignored("line 2, column 14")),
        ("-blendu t.png", None),
        ("-blendv t.png", None),
        ("-cc t.png", None),
        ("-boost t.png", None),
        ("-cc on -boost 2 -blendu off t.png", None),
    ] {
        let model = read_library(&format!("newmtl a\nmap_Kd {said}\n"));
        let warning = warning.map(|warning| format!("x.mtl: {warning}"));
        let expected: Vec<_> = warning.into_iter().collect();
        assert_eq!(messages(&model.library_warnings), expected, "{said}");
        let material = model.materials[1].as_ref().expect("it is defined");
        let path = material.diffuse_map.as_ref().map(|map| &*map.path);
        assert_eq!(path, Some("t.png"), "{said}");
    }
}

#[test]
fn a_comment_of_other_languages_ends_a_map() {
    for (said, path, column) in [
        ("t.png // wood", "t.png", Some(14)),
        ("wood grain.png //wood", "wood grain.png", Some(23)),
        ("t.png -s 1 // -clamp off", "t.png", Some(19)),
        ("-s 1 t.png -clamp off // -x", "t.png", Some(30)),
        // A path of a network.
        ("//server/t.png", "//server/t.png", None),
        ("a//t.png", "a//t.png", None),
    ] {
        let model = read_library(&format!("newmtl a\nmap_Kd {said}\n"));
        let said_first = said.split(' ').find(|word| word.starts_with("//"));
        let warning = column.zip(said_first).map(|(column, word)| {
            format!("x.mtl: line 2, column {column}: map_Kd: `{word}` is not a comment here")
        });
        let expected: Vec<_> = warning.into_iter().collect();
        assert_eq!(messages(&model.library_warnings), expected, "{said}");
        let material = model.materials[1].as_ref().expect("it is defined");
        let map = material.diffuse_map.as_ref().expect("it is read");
        assert_eq!((&*map.path, map.scale), (path, [1.0; 2]), "{said}");
    }
}

/// Its name may be long, and its materials many.
#[test]
fn materials_share_the_name_of_their_library() {
    let text = format!("mtllib x.mtl\n{SQUARE}usemtl a\nf 1 2 3\nusemtl b\nf 1 3 4");
    let library = "newmtl b\nNi 2\nnewmtl c\nNi 4\nnewmtl a\nNi 3\nnewmtl b\nNi 5";
    let read = read(text.as_bytes(), |_| Ok::<_, String>(library));
    let materials = read.expect("a valid mesh").materials;
    let [None, Some(a), Some(b)] = &materials[..] else {
        panic!("{materials:?}");
    };
    assert_eq!((a.index, b.index), (3.0, 5.0));
    assert!(Arc::ptr_eq(&a.library, &b.library));
}

/// A library that cannot be read costs more than a line that cannot.
#[test]
fn unreadable_libraries_are_said_first() {
    let wrong = "newmtl a\nKd x\n".repeat(8);
    for (unreadable, more) in [(1, None), (3, Some(1)), (12, Some(10))] {
        let names = (0..unreadable).map(|number| format!("mtllib no{number}.mtl\n"));
        let names: String = names.collect();
        let text = format!("mtllib a.mtl\n{names}{SQUARE}f 1 2 3");
        let read = read(text.as_bytes(), |name| match name {
            "a.mtl" => Ok(&wrong),
            _ => Err("no such file".to_owned()),
        });
        let found = read.expect("a valid mesh").library_warnings;
        let shown = messages(&found);
        assert_eq!(shown.len(), (unreadable + 8).min(10));
        for (number, shown) in shown.iter().enumerate() {
            let line = number + 2;
            let expected = if number < unreadable {
                format!("line {line}, column 8: cannot read `no{number}.mtl`: no such file")
            } else {
                let line = 2 * (number - unreadable + 1);
                format!("a.mtl: line {line}, column 4: Kd: `x` is not a number")
            };
            assert_eq!(*shown, expected);
        }
        let hint = found.last().and_then(|last| last.hint.clone());
        let hint = hint.unwrap_or_default();
        let counted = more.map_or(String::new(), |more: usize| {
            format!(
                "{more} more problem{} not shown",
                if more == 1 { "" } else { "s" }
            )
        });
        assert!(
            hint.ends_with(&counted) && hint.contains("not shown") == more.is_some(),
            "{hint}"
        );
    }
}
