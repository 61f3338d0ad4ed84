//! What is offered while a text is written.

use std::fs;

use serde_json::{Value, json};

use super::{asked, at};

/// A text of this language, with the place asked for marked by `|`.
pub(super) fn marked(extension: &str, text: &str) -> (String, String, Value) {
    let before = text.split('|').next().expect("there is one");
    let line = before.matches('\n').count();
    let column = before.len() - before.rfind('\n').map_or(0, |end| end + 1);
    let uri = format!("file:///none/a.{extension}");
    (
        uri,
        text.replacen('|', "", 1),
        at(line as u32, column as u32),
    )
}

/// What is offered at the `|`, and the text that one of it replaces.
fn offered(extension: &str, text: &str) -> (Vec<Value>, String) {
    let (uri, text, place) = marked(extension, text);
    offered_in(&uri, &text, &place)
}

fn offered_in(uri: &str, text: &str, place: &Value) -> (Vec<Value>, String) {
    let asking = json!({ "position": place });
    let answer = asked((uri, text), "textDocument/completion", asking);
    let items = match &answer["result"] {
        Value::Array(items) => items.clone(),
        cut => cut["items"].as_array().expect(text).clone(),
    };
    let replaced = items.first().map_or_else(String::new, |item| {
        let range = &item["textEdit"]["range"];
        assert_eq!(range["start"]["line"], place["line"]);
        let column = |end: &str| range[end]["character"].as_u64().expect("a number") as usize;
        let line = place["line"].as_u64().expect("a number") as usize;
        let line = text.split('\n').nth(line).expect("it is there");
        line[column("start")..column("end")].to_owned()
    });
    (items, replaced)
}

fn label(item: &Value) -> &str {
    item["label"].as_str().expect("a label")
}

const DAT: &str = "light ID 4 inf 0 0 1 0 0 -1 1 1 1 1 0 0 0 shadow_on\n\
                   mat ID 7 1 1 1 0 .5 0 1 0 0 1\n# gold\nmat ID 8 1 1 0 0 .5 0 1 0 0 1\n\
                   obj sphere ID 3 mat ID 7 0 0 0 1\n";

/// The words offered first, what they replace, and what is said of the first.
#[test]
fn what_may_stand_at_a_place_is_offered() {
    let dat = |line: &str| format!("{DAT}{line}\nviewport 8 6\n");
    let xml = |scene: &str| format!("<xml>\n<scene>\n{scene}\n</scene>\n<camera/></xml>\n");
    #[rustfmt::skip]
    let rows = [
        ("test", "size 8 6\nmaxdepth 5\nspp 4\nsph|".to_owned(), "camera size maxdepth", "sph", "from at up fov"),
        ("test", "size 8 6\n  sph|re 0 0 0 1\n".to_owned(), "camera size maxdepth", "sphre", "from at up fov"),
        ("test", "size 8 6\nmaxdepth 5\nspp 4\nintegrator |\n".to_owned(), "raytracer analyticdirect direct pathtracer", "", "integrator: raytracer or"),
        ("test", "size 8 6\nmaxdepth 5\nspp 4\nINTEGRATOR pa|\n".to_owned(), "raytracer analyticdirect", "pa", "integrator: raytracer or"),
        ("test", "size 8 6\nmaxdepth 5\nspp 4\nsphere 0 |".to_owned(), "", "", ""),
        ("test", "size 8 6\nmaxdepth 5\nspp 4\noutput |".to_owned(), "", "", ""),
        ("test", "size 8 6\nmaxdepth 5\nspp 4\nsphere 0 0 0 1 # sp|".to_owned(), "", "", ""),
        ("test", "# sp|".to_owned(), "render:", "sp", "render settings"),
        ("test", "# a sp|".to_owned(), "", "", ""),
        ("test", "#sp|".to_owned(), "", "", ""),
        ("test", "# render: ex|\nsize 8 6\nspp 4\n".to_owned(), "*exposure", "ex", ""),
        ("test", "# render: spp 4 | exposure 1\nsize 8 6\nspp 4\n".to_owned(), "-spp", "", ""),
        ("test", "# render: integrator |\nsize 8 6\nspp 4\n".to_owned(), "*path", "", "integrator: "),
        ("test", "# render: spp |\nsize 8 6\nspp 4\n".to_owned(), "16", "", "spp: a whole number"),
        ("ray", "0 0 0 0 1\nsph|\n".to_owned(), "sphere ellipsoid box cylinder cone", "sph", "centre radius"),
        ("ray", "0 0 0 0 1\n|\n".to_owned(), "sphere ellipsoid", "", "centre radius"),
        ("ray", "0 0 0 0 1 sphere |0".to_owned(), "", "", ""),
        ("ray", "// vie|".to_owned(), "render: view:", "vie", "render settings"),
        ("ray", "// view: |".to_owned(), "eye target up fov size", "", "eye x: a number"),
        ("ray", "// view: eye 0 0 |".to_owned(), "", "", ""),
        ("ray", "0 0 0 // view: eye 0 0 9 fo|".to_owned(), "target up fov size", "fo", "target x: a number"),
        ("ray", "// render: |".to_owned(), "*spp", "", ""),
        ("dat", dat("|"), "camera resolution viewport light mat obj", "", "projection eye"),
        ("dat", dat("obj |"), "sphere ellipsoid cylinder box CSG quadric", "", "mat centre radius"),
        ("dat", dat("obj sphere |"), "ID", "", ""),
        ("dat", dat("obj sphere ID |"), "4", "", "an unused ID"),
        ("dat", dat("obj sphere ID 9 mat ID |"), "7 8", "", "material 7"),
        ("dat", dat("obj sphere ID 9 mat ID 7|7 0 0 0 1"), "7 8", "77", "material 7"),
        ("dat", dat("obj CSG ID 9 |"), "union intersection difference", "", "operator: union or"),
        ("dat", dat("obj CSG ID 9 union ID |"), "3", "", "object 3 (sphere)"),
        ("dat", dat("texture ID 1 |"), "checker image", "", "repeat first second"),
        ("dat", dat("texture ID 1 checker |"), "", "", ""),
        ("dat", dat("use colour ID |"), "", "", ""),
        ("dat", dat("render 1 |"), "ID", "", ""),
        ("dat", dat("render 2 ID 3 ID |"), "3", "", "object 3 (sphere)"),
        ("dat", dat("light ID 5 pnt 0 0 0 0 0 0 1 1 1 1 0 0 0 shadow_|on"), "shadow_on shadow_off", "shadow_on", "shadow: "),
        ("dat", dat("# render: dep|"), "*depth", "dep", ""),
        ("dat", dat("// render: dep|"), "", "", ""),
        ("xml", xml("<|"), "object material light background environment", "", ""),
        ("xml", xml("<obj| type='sphere'/>"), "object material light", "obj", ""),
        ("xml", xml("<object type='sphere'><sc|"), "scale rotate translate object", "sc", "The scale factor"),
        ("xml", xml("<light type='point'><|/></light>"), "intensity position size attenuation", "", "Its brightness"),
        ("xml", xml("<light |"), "type name", "", "type: ambient or direct or point"),
        ("xml", xml("<object type='sphere' |/>"), "name material", "", "name: one word"),
        ("xml", xml("<object mat|erial='gold' type='sphere'/>"), "name material", "material", "name: one word"),
        ("xml", xml("<object type='|"), "sphere plane obj", "", "type: sphere or"),
        ("xml", xml("<object type=\"sp|here\"/>"), "sphere plane obj", "sphere", "type: sphere or"),
        ("xml", xml("<material name='a &amp; b'/><object material='|'/>"), "a & b", "", "a & b (blinn)"),
        ("xml", xml("<material><diffuse |"), "r g b value texture", "", "diffuse red: a number"),
        ("xml", xml("<material><refraction index='|'/></material>"), "1", "", "index: a number"),
        ("xml", xml("<object type='\n|"), "", "", ""),
        ("xml", xml("<object></object>|"), "", "", ""),
        ("xml", xml("<!-- <obj| -->"), "", "", ""),
        ("xml", "<xml><scene/><camera><fo|</camera></xml>".to_owned(), "position target up fov", "fo", "The position"),
        ("xml", "<xml><scene/><render |/><camera/></xml>".to_owned(), "*integrator", "", ""),
        ("xml", "<xml><scene/><render spp='4' integrator='|'/><camera/></xml>".to_owned(), "*path", "", "integrator: "),
    ];
    for (extension, text, words, replaced, detail) in rows {
        let (items, found) = offered(extension, &text);
        let labels: Vec<_> = items.iter().map(label).collect();
        match (words.strip_prefix('*'), words.strip_prefix('-')) {
            (Some(word), _) => assert!(labels.contains(&word), "{text}: {labels:?}"),
            (_, Some(word)) => assert!(!labels.contains(&word) && 3 < labels.len(), "{text}"),
            _ if words == "a & b" => assert_eq!(labels, [words]),
            _ => {
                let expected: Vec<_> = words.split_whitespace().collect();
                let count = expected.len().min(labels.len());
                assert_eq!(labels[..count], expected, "{text}: {labels:?}");
                assert_eq!(labels.is_empty(), words.is_empty(), "{text}: {labels:?}");
            }
        }
        assert_eq!(found, replaced, "{text}");
        if let Some(first) = items.first() {
            let said = first["detail"].as_str().unwrap_or_default();
            assert!(said.starts_with(detail), "{text}: {said}");
            assert!(first["kind"].is_number());
        }
    }
}

#[test]
fn names_are_spelled_for_their_place() {
    let text =
        "<xml><scene><material name=\"it's &amp;\"/><object material='|'/></scene><camera/></xml>";
    let (items, _) = offered("xml", text);
    assert_eq!(items[0]["textEdit"]["newText"], "it&apos;s &amp;");
}

/// A list of all would take seconds.
#[test]
fn many_names_are_narrowed_down_by_what_is_typed() {
    let record = |id: usize| format!("mat ID {id} 1 1 1 0 .5 0 1 0 0 1\n");
    let materials: String = (0..3_000).map(record).collect();
    for (typed, first, count) in [("", "0", 1_000), ("29", "29", 111), ("2999", "2999", 1)] {
        let line = format!("viewport 8 6\n{materials}obj sphere ID 1 mat ID {typed}|\n");
        let (uri, text, place) = marked("dat", &line);
        let asking = json!({ "position": place });
        let result = asked((&uri, &text), "textDocument/completion", asking)["result"].clone();
        assert_eq!(result["isIncomplete"] == true, count == 1_000);
        let (items, _) = offered("dat", &line);
        assert_eq!((label(&items[0]), items.len()), (first, count));
    }
}

#[test]
fn files_beside_the_scene_are_offered() {
    let folder = std::env::temp_dir().join(format!("halflight-lsp-{}", std::process::id()));
    fs::create_dir_all(folder.join("deep")).expect("there is room");
    for name in [
        "b.png",
        "a.JPG",
        "c.obj",
        ".d.png",
        "e f.png",
        "g.txt",
        "deep/h.hdr",
    ] {
        fs::write(folder.join(name), "").expect("there is room");
    }
    let record = "viewport 8 6\ntexture ID 1 image 1 1 ";
    let element = "<xml><scene><material><diffuse texture='|'/></material></scene><camera/></xml>";
    let mesh = "<xml><scene><object type='obj' name='|'/></scene><camera/></xml>";
    for (extension, text, expected) in [
        (
            "dat",
            format!("{record}|\n"),
            &["a.JPG", "b.png", "deep/"][..],
        ),
        ("dat", format!("{record}deep/|x\n"), &["deep/h.hdr"]),
        ("dat", format!("{record}../|\n"), &[]),
        ("dat", format!("{record}/|\n"), &[]),
        ("dat", format!("{record}none/|\n"), &[]),
        (
            "xml",
            element.to_owned(),
            &["a.JPG", "b.png", "deep/", "e f.png"],
        ),
        ("xml", mesh.to_owned(), &["c.obj", "deep/"]),
    ] {
        let (_, text, place) = marked(extension, &text);
        let uri = format!("file://{}/a.{extension}", folder.display());
        let (items, _) = offered_in(&uri, &text, &place);
        let labels: Vec<_> = items.iter().map(label).collect();
        assert_eq!(labels, expected, "{text}");
    }
    for number in 0..300 {
        fs::write(folder.join(format!("{number}.png")), "").expect("there is room");
    }
    let asking = json!({ "position": at(1, 23) });
    let uri = format!("file://{}/a.dat", folder.display());
    let answer = asked((&uri, record), "textDocument/completion", asking);
    fs::remove_dir_all(&folder).expect("it is there");
    assert_eq!(answer["result"]["isIncomplete"], true);
    assert_eq!(
        answer["result"]["items"].as_array().map(Vec::len),
        Some(200)
    );
}
