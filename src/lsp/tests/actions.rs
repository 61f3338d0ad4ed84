//! Quick fixes: what is offered where, and that it mends what it says.

use serde_json::{Value, json};

use super::completion::marked;
use super::{asked, at, open, said};

const DAT: &str = "camera perspective 0 0 9 0 0 0 0 1 0 1 0 100\nresolution .1 .1\nviewport 8 6\n\
                   light ID 1 inf 0 0 1 0 0 -1 1 1 1 1 0 0 0 shadow_on\nmat ID 1 1 1 1 0 .5 0 1 0 0 1\n";

const RAY: &str = "0 0 0\n0\n1\nsphere 0 0 0 1\n0 0 0 .5 .5 .5 0 0 0 1 0 0 1\n";

fn actions((uri, text): (&str, &str), [start, end]: [&Value; 2], context: &Value) -> Vec<Value> {
    let range = json!({ "start": start, "end": end });
    let asking = json!({ "range": range, "context": context });
    let answer = asked((uri, text), "textDocument/codeAction", asking);
    answer["result"].as_array().expect("a list").clone()
}

/// A text of ASCII after an action.
fn after(text: &str, uri: &str, action: &Value) -> String {
    let offset = |place: &Value| {
        let line = place["line"].as_u64().expect("a number") as usize;
        let before: usize = text.split_inclusive('\n').take(line).map(str::len).sum();
        before + place["character"].as_u64().expect("a number") as usize
    };
    let edits = action["edit"]["changes"][uri].as_array().expect("edits");
    let mut text = text.to_owned();
    for edit in edits.iter().rev() {
        let [start, end] = ["start", "end"].map(|end| offset(&edit["range"][end]));
        text.replace_range(start..end, edit["newText"].as_str().expect("a text"));
    }
    text
}

fn messages(uri: &str, text: &str) -> Vec<Value> {
    let published = said(vec![open(uri, "", text)]);
    let found = published.last().expect("it is published")["params"]["diagnostics"].clone();
    let found = found.as_array().expect("a list").clone();
    found
        .into_iter()
        .map(|found| found["message"].clone())
        .collect()
}

#[test]
fn fixes_mend_what_they_are_offered_for() {
    let dat = |record: &str| format!("{DAT}{record}\n");
    #[rustfmt::skip]
    let rows = [
        ("test", "camera 0 0 9 0 0 0 0 1 0 45\nsph|re 0 0 0 1\n".to_owned(), "Change `sphre` to `sphere`", "\nsphere 0 0 0 1\n"),
        ("test", "camera 0 0 9 0 0 0 0 1 0 45\nsphere 0 0 0 |1,5\n".to_owned(), "Change `1,5` to `1.5`", "0 1.5\n"),
        ("test", "camera 0 0 9 0 0 0 0 1 0 45\n|SPHERE 0 0 0 1\n".to_owned(), "Change `SPHERE` to `sphere`", "\nsphere 0 0 0 1\n"),
        ("test", "# render: ssp| 4\ncamera 0 0 9 0 0 0 0 1 0 45\nsphere 0 0 0 1\n".to_owned(), "Change `ssp` to `spp`", "# render: spp 4\n"),
        ("test", "# render: ss|p=4\ncamera 0 0 9 0 0 0 0 1 0 45\nsphere 0 0 0 1\n".to_owned(), "Change `ssp=4` to `spp 4`", "# render: spp 4\n"),
        ("test", "# render: spp 4 integrator pth|\ncamera 0 0 9 0 0 0 0 1 0 45\nsphere 0 0 0 1\n".to_owned(), "Change `pth` to `path`", "integrator path\n"),
        ("test", "camera 0 0 9 0 0 0 0 1 0 45\nmaxverts |2\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\ntri 0 1 2\n".to_owned(), "Change `2` to `3`", "maxverts 3\n"),
        ("ray", RAY.replacen("sphere", "|spere", 1), "Change `spere` to `sphere`", "\nsphere"),
        ("ray", RAY.replacen("\n1\n", "\n|2\n", 1), "Change `2` to `1`", "\n1\n"),
        ("ray", RAY.replacen("0 0 0\n0\n", "0 0 0\n|3\n", 1), "Change `3` to `0`", "0 0 0\n0\n"),
        ("ray", RAY.replacen("0 0 0 1 0 0 1\n", "0 0 0 |-1 0 0 1\n", 1), "Change `-1` to `0`", "0 0 0 0 0 0 1\n"),
        ("ray", format!("// view: |Eye 0 0 9\n{RAY}"), "Change `Eye` to `eye`", "// view: eye 0 0 9"),
        ("dat", dat("obj sphre| ID 1 mat ID 1 0 0 0 1"), "Change `sphre` to `sphere`", "obj sphere ID"),
        ("dat", dat("obj sphere ID 1 MAT| ID 1 0 0 0 1"), "Change `MAT` to `mat`", "1 mat ID"),
        ("dat", dat("obj sphere ID 1 mat ID 1 0 0 0 1\nrender |2 ID 1"), "Change `2` to `1`", "render 1 ID 1"),
        ("dat", dat("obj quadric ID 1 mat ID 1 1 0 0 0 1 0 0 1 0 -1 |2 0 0 1 0"), "Change `2` to `1`", "-1 1 0 0 1 0"),
        ("dat", dat("obj box ID 1 mat ID 1 0 0 0 1 0 .5 0 1 0 0 |0 1 1 1 1"), "Make the directions of object 1 (box) orthonormal", "object"),
        ("xml", "<xml><scene><obj|ct type='sphere'></objct></scene><camera/></xml>".to_owned(), "Change `objct` to `object`", "<object type='sphere'></object>"),
        ("xml", "<xml><scene><object type='spere|'/></scene><camera/></xml>".to_owned(), "Change `spere` to `sphere`", "type='sphere'"),
        ("xml", "<xml><scene><object typ|='sphere'/></scene><camera/></xml>".to_owned(), "Change `typ` to `type`", "type='sphere'"),
        ("xml", "<xml><scene><material name='gold'/><object type='sphere' material='gld|'/></scene><camera/></xml>".to_owned(), "Change `gld` to `gold`", "material='gold'"),
        ("xml", "<xml><scene><object name='a |& b'/></scene><camera/></xml>".to_owned(), "Change `&` to `&amp;`", "'a &amp; b'"),
        ("xml", "<xml><scene><object name='a |< b'/></scene><camera/></xml>".to_owned(), "Change `<` to `&lt;`", "'a &lt; b'"),
        ("xml", "<xml><scene></scene><camera>|</xml>".to_owned(), "Insert `</camera>`", "<camera></camera></xml>"),
        ("xml", "<xml><scene></scene><camera>|</camra></xml>".to_owned(), "Change `</camra>` to `</camera>`", "<camera></camera></xml>"),
    ];
    for (extension, text, title, mended) in rows {
        let (uri, text, place) = marked(extension, &text);
        let offered = actions((&uri, &text), [&place, &place], &json!({}));
        let offered: Vec<_> = offered
            .iter()
            .filter(|action| action["title"] == title)
            .collect();
        let [action] = *offered else {
            panic!(
                "{text}: {title}: {:?}",
                actions((&uri, &text), [&place, &place], &json!({}))
            );
        };
        assert_eq!(action["kind"], "quickfix");
        assert_eq!(action["isPreferred"], true, "{text}");
        let fixed = after(&text, &uri, action);
        assert!(fixed.contains(mended) || mended == "object", "{fixed}");
        let left = messages(&uri, &fixed);
        let diagnostics = action["diagnostics"].as_array().expect("a list");
        assert!(!diagnostics.is_empty());
        for found in diagnostics {
            assert!(messages(&uri, &text).contains(&found["message"]));
            assert!(!left.contains(&found["message"]), "{fixed}: {left:?}");
        }
    }
}

/// Though the trial reads no files.
#[test]
fn a_missing_file_is_not_mended_by_another_fix() {
    let text = "<xml><scene><object type='obj' name='none.obj' typ='x'/></scene><camera/></xml>";
    let (start, end) = (at(0, 0), at(0, 99));
    let offered = actions(("file:///none/a.xml", text), [&start, &end], &json!({}));
    let mended = offered
        .iter()
        .filter_map(|action| action["diagnostics"].as_array());
    let mended: Vec<_> = mended
        .flatten()
        .map(|found| found["message"].as_str())
        .collect();
    assert!(!mended.is_empty());
    assert!(
        mended
            .iter()
            .flatten()
            .all(|message| message.starts_with("attribute `typ`"))
    );
}

#[test]
fn fixes_are_offered_where_and_as_asked() {
    let text = "camera 0 0 9 0 0 0 0 1 0 45\nspere 0 0 0 1\nspher 0 0 0 2\nsphere 0 0 0 3\n";
    for (start, end, context, count) in [
        (at(1, 0), at(1, 0), json!({}), 1),
        (at(0, 0), at(9, 0), json!({}), 2),
        (at(1, 6), at(1, 9), json!({}), 0),
        (at(1, 0), at(1, 0), json!({ "only": ["quickfix"] }), 1),
        (at(1, 0), at(1, 0), json!({ "only": ["refactor", ""] }), 1),
        (at(1, 0), at(1, 0), json!({ "only": ["source"] }), 0),
        (at(1, 0), at(1, 0), json!({ "only": ["quickfix.other"] }), 0),
    ] {
        let offered = actions((super::URI, text), [&start, &end], &context);
        assert_eq!(offered.len(), count, "{start} {context}");
    }
}
