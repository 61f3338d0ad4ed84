//! Symbols below each other, their names, and how long they take; words of the text in hovers.

use std::time::{Duration, Instant};

use serde_json::{Value, json};

use super::completion::marked;
use super::{URI, asked};

const DAT: &str = "mat ID 7 1 1 1 0 .5 0 1 0 0 1\n\
                   obj sphere ID 1 mat ID 7 0 0 0 1\nobj sphere ID 2 mat ID 7 0 0 0 1\n\
                   obj CSG ID 3 union ID 1 ID 2\nobj sphere ID 4 mat ID 7 0 0 0 1\n\
                   obj CSG ID 5 difference ID 3 ID 4\nobj CSG ID 6 difference ID 4 ID 1\nviewport 8 6\n";

/// Each symbol as its indented name, and the text of its selection.
fn shown(text: &str, symbols: &Value, depth: usize) -> Vec<String> {
    let symbols = symbols.as_array().into_iter().flatten();
    let lines: Vec<_> = text.split('\n').collect();
    let lines_of = |symbol: &Value| {
        let place = &symbol["selectionRange"];
        let number = |end: &str, key: &str| place[end][key].as_u64().expect("a number") as usize;
        let line = lines[number("start", "line")];
        let selected = &line[number("start", "character")..number("end", "character")];
        let name = symbol["name"].as_str().expect("a name");
        let own = format!("{}{name}: {selected}", "  ".repeat(depth));
        let below = shown(text, &symbol["children"], depth + 1);
        [own].into_iter().chain(below).collect::<Vec<_>>()
    };
    symbols.flat_map(lines_of).collect()
}

#[test]
fn objects_are_below_those_that_hold_or_combine_them() {
    let xml = "<xml><scene>\n<object name=\"all\">\n<object type='sphere' name='sphere'/>\n<object type='plane'/></object>\n\
               <material name='gold'/></scene>\n<camera/></xml>";
    for (uri, text, expected) in [
        (
            "file:///none/a.dat",
            DAT,
            &[
                "material 7: 7",
                "object 5 (CSG): 5",
                "  object 3 (CSG): 3",
                "    object 1 (sphere): 1",
                "    object 2 (sphere): 2",
                "  object 4 (sphere): 4",
                "object 6 (CSG): 6",
                "view: viewport",
            ][..],
        ),
        (
            "file:///none/a.xml",
            xml,
            &[
                "all (group): all",
                "  sphere (sphere): sphere",
                "  object 3 (plane): object",
                "gold (blinn): gold",
                "view: camera",
            ],
        ),
        (
            URI,
            "camera 0 0 9 0 0 0 0 1 0 45\n  sphere 0 0 0 1 # ball\n",
            &["view: camera", "object 1 (sphere): sphere"],
        ),
        (
            "file:///none/a.ray",
            "0 0 0 0 1\nsphere 0 0 0 1\n0 0 0 1 1 1 0 0 0 1 0 0 1 // ball\n",
            &["ambient: 0", "object 1 (sphere): sphere"],
        ),
    ] {
        let answer = asked((uri, text), "textDocument/documentSymbol", json!({}));
        assert_eq!(shown(text, &answer["result"], 0), expected, "{text}");
    }
}

#[test]
fn symbols_take_time_linear_in_the_text() {
    let object = "sphere 0 0 0 1 0 0 0 .5 .5 .5 0 0 0 1 0 0 1 ";
    let head = "// é: a line with a character of two bytes\n0 0 0 0";
    for count in [8_000, 1] {
        let text = format!("{head} {count} {}", object.repeat(count));
        let began = Instant::now();
        let answer = asked(
            ("file:///none/a.ray", &text),
            "textDocument/documentSymbol",
            json!({}),
        );
        assert!(
            answer["result"]
                .as_array()
                .is_some_and(|all| count <= all.len())
        );
        // It took minutes.
        assert!(began.elapsed() < Duration::from_secs(10));
    }
}

#[test]
fn words_of_the_text_are_no_markdown() {
    let comment = "# *a* <b> [c](d) `e` _f_ ![g] & \\";
    let text = format!("camera 0 0 9 0 0 0 0 1 0 45\n{comment}\nsph|ere 0 0 0 1\n");
    let (uri, text, place) = marked("test", &text);
    let answer = asked(
        (&uri, &text),
        "textDocument/hover",
        json!({ "position": place }),
    );
    let said = answer["result"]["contents"]["value"]
        .as_str()
        .expect("words");
    let expected = r"\*a\* \<b\> \[c\](d) \`e\` \_f\_ \!\[g\] \& \\";
    assert!(said.contains(expected), "{said}");
}
