//! Hostile files: each gives the expected message and takes little memory besides its text.

use std::fs;
use std::path::Path;

use crate::run_in;

const MB: usize = 1 << 20;

/// The length in bytes from which the beginning of a text is checked first.
const LONG: usize = 16 * MB + 1;

/// Bytes that every run takes: arguments, tables, messages.
const BASE: usize = MB;

/// Repeats a text up to at least `bytes` bytes.
fn many(text: &str, bytes: usize) -> String {
    text.repeat(bytes.div_ceil(text.len()))
}

struct Case {
    name: &'static str,
    content: String,
    /// The expected exit code.
    code: i32,
    message: &'static str,
    /// Maximum number of bytes allocated besides the text and [`BASE`].
    most: usize,
}

#[allow(clippy::too_many_lines, reason = "it is a table")]
fn cases() -> Vec<Case> {
    const HEAD: &str = "0 0 0 1 0 0 0 1 1 1 ";
    const SPHERE: &str = "sphere 0 0 0 1 0 0 0 .5 .5 .5 0 0 0 1 0 0 1\n";
    let case = |name, content: String, message, most| Case {
        name,
        content,
        code: 65,
        message,
        most,
    };
    let read_whole = |case: Case| Case { code: 0, ..case };
    let numbers = "0.25 1 -3.5 12.125 7 0.5\n";
    vec![
        case(
            "objects.ray",
            format!("{HEAD}100000000"),
            "nObjects is `100000000`, but the text ends before any object",
            0,
        ),
        case(
            "lights.ray",
            "0 0 0 100000000".to_owned(),
            "nLights is `100000000`, but the text has 0 lights",
            0,
        ),
        case(
            "cuts.dat",
            format!(
                "mat ID 1 1 1 1 1 1 0 1 0 0 1\nobj quadric ID 1 mat ID 1 {} 100000000",
                "1 ".repeat(10)
            ),
            "declares `100000000`, but 0 cuts follow",
            0,
        ),
        case(
            "shown.dat",
            "render 100000000 ID 1".to_owned(),
            "render: declares `100000000`, but 1 object follows",
            0,
        ),
        case(
            "digits.ray",
            format!("0 0 {} 1", "9".repeat(MB)),
            "is too large for any number",
            0,
        ),
        case(
            "nan.ray",
            "nan inf 1e999 1".to_owned(),
            "`nan` is not a number",
            0,
        ),
        case(
            "nul.ray",
            many("\0", MB),
            "is a binary file, not text: NUL bytes from line 1 on",
            0,
        ),
        case(
            "bad.ray",
            format!("{HEAD}9 {}", many("spher 0 0 0 1\n", MB / 2)),
            "object 1: unknown type `spher`",
            3 * MB,
        ),
        case(
            "bad.dat",
            many("obj spere 1 2 3\n", MB / 2),
            "obj: unknown kind `spere`",
            3 * MB,
        ),
        case(
            "unknown.dat",
            many("obj sphere ID 1 mat ID 7 0 0 0 1\n", MB / 2),
            "material 7 is not defined above",
            3 * MB,
        ),
        case(
            "dark.ray",
            format!("0 0 0 87382 {}", many("1 2 3 1 1 1 ", MB)),
            "nObjects: missing, the text ends here",
            8 * MB,
        ),
        case(
            "surplus.ray",
            format!("{HEAD}1 {}", many("1 ", MB)),
            "numbers too many after it",
            8 * MB,
        ),
        case(
            "words.ray",
            format!("{HEAD}1 {}", many("a ", MB)),
            "object 1: unknown type `a`",
            16 * MB,
        ),
        read_whole(case(
            "comments.dat",
            many("//\n", MB),
            "no object is defined",
            9 * MB,
        )),
        case(
            "twice.xml",
            "<xml a='1' a='2'/>".to_owned(),
            "attribute `a`: given twice",
            0,
        ),
        case(
            "laughs.xml",
            "<!DOCTYPE x [<!ENTITY a 'ha'>]><xml>&a;</xml>".to_owned(),
            "document type declarations are not supported",
            0,
        ),
        case(
            "deep.xml",
            many("<a>", MB / 2),
            "more than 131072 levels of elements are not supported",
            3 * MB,
        ),
        case(
            "attributes.xml",
            format!("<xml {}/>", many("a='1' ", MB / 2)),
            "more than 1000 attributes are not supported",
            MB,
        ),
        case(
            "cycle.dat",
            "obj CSG ID 1 union ID 2 ID 2\nobj CSG ID 2 union ID 1 ID 1\n".to_owned(),
            "object 2 is defined below",
            0,
        ),
        case("ends.ray", many("\n", MB), "the text contains no scene", MB),
        read_whole(case(
            "ends.dat",
            many("\n", MB),
            "no object is defined",
            12 * MB,
        )),
        read_whole(case(
            "numbers.dat",
            many(numbers, MB),
            "unknown record `0.25`: the line is skipped",
            12 * MB,
        )),
        // For longer texts only the beginning is read.
        case(
            "numbers.ray",
            many(numbers, LONG),
            "nLights: must be a whole number, 1 or more, not `12.125`",
            6 * MB,
        ),
        case(
            "letters.ray",
            many("a", LONG),
            "a word of more than 1024 bytes",
            2 * MB,
        ),
        case(
            "less.xml",
            many("<", LONG),
            "a name cannot begin here",
            96 * MB,
        ),
        case(
            "spheres.ray",
            format!("{HEAD}1 {}", many(SPHERE, LONG)),
            "nObjects is `1`, but more objects follow",
            16 * MB,
        ),
    ]
}

/// Checks each file in a separate process that counts what it allocates.
pub(crate) fn check() {
    let folder = tempfile::tempdir().expect("a folder");
    let failures: Vec<_> = cases()
        .iter()
        .filter_map(|case| failure(folder.path(), case))
        .collect();
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// Checks one file; returns a description if the result is wrong.
fn failure(folder: &Path, case: &Case) -> Option<String> {
    let Case { name, content, .. } = case;
    fs::write(folder.join(name), content).expect("written");
    let ended = run_in(folder, &format!("check {name}"), u64::MAX, u64::MAX);
    let stderr = String::from_utf8_lossy(&ended.stderr);
    let bytes = stderr
        .trim_end()
        .strip_suffix(" bytes")
        .and_then(|before| before.rsplit(' ').next());
    let bytes: usize = bytes
        .and_then(|bytes| bytes.parse().ok())
        .expect("a number");
    let text = if content.len() < LONG {
        content.len()
    } else {
        0
    };
    let excess = bytes.saturating_sub(text + BASE);
    let is_right = ended.status.code() == Some(case.code)
        && stderr.contains(case.message)
        && stderr.lines().count() < 3000
        && excess <= case.most;
    (!is_right).then(|| {
        let start: String = stderr.chars().take(200).collect();
        format!(
            "{name}: {excess} bytes besides {text}, {:?}: {start}",
            ended.status
        )
    })
}
