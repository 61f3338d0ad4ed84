//! Swatches and pickers of colours.

use serde_json::json;

use super::{asked, at, places};

#[test]
fn a_grey_of_one_number_is_a_colour() {
    let scene = "<background value='0.5'/><material><diffuse value=\".25\"/><emission r='1' value='2'/>\
                 <reflection value='3'/><glossiness value='1'/></material>";
    let text = format!("<xml><scene>\n{scene}\n</scene><camera/></xml>");
    let xml = ("file:///none/a.xml", &*text);
    let colours = asked(xml, "textDocument/documentColor", json!({}));
    assert_eq!(places(&colours), ["1:19", "1:51"]);
    assert_eq!(colours["result"][1]["color"]["blue"], 0.25);
    for ((start, end), [red, green, blue], expected) in [
        ((19, 22), [1.0, 1.0, 1.0], "1:19 1.0"),
        ((51, 54), [0.75, 0.75, 0.75], "1:51 .75"),
        ((19, 22), [0.5, 0.1239, 1.0], "1:12 r='0.5' g='0.124' b='1'"),
        ((51, 54), [1.0, 0.0, 0.0], "1:44 r=\"1\" g=\"0\" b=\"0\""),
    ] {
        let range = json!({ "start": at(1, start), "end": at(1, end) });
        let colour = json!({ "red": red, "green": green, "blue": blue, "alpha": 1 });
        let asking = json!({ "range": range, "color": colour });
        let answer = asked(xml, "textDocument/colorPresentation", asking);
        let edit = &answer["result"][0]["textEdit"];
        let start = &edit["range"]["start"];
        let text = edit["newText"].as_str().unwrap_or_default();
        let found = format!("{}:{} {text}", start["line"], start["character"]);
        assert_eq!(found, expected);
    }
}
