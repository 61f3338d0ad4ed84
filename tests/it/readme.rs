//! What `README.md` says: its keys, its commands, its sample and its animation.

use std::fs;
use std::path::Path;
use std::process::Command;

const BINARY: &str = env!("CARGO_BIN_EXE_halflight");

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn readme() -> String {
    fs::read_to_string(root().join("README.md")).expect("a page")
}

/// Standard output of a command in the root of the source.
fn printed(arguments: &[&str]) -> String {
    let mut command = Command::new(BINARY);
    let ran = command.current_dir(root()).args(arguments).output();
    String::from_utf8(ran.expect("it starts").stdout).expect("text")
}

/// The texts between backquotes.
fn quoted(text: &str) -> Vec<&str> {
    text.split('`').skip(1).step_by(2).collect()
}

#[test]
fn it_is_read_in_three_minutes() {
    let page = readme();
    assert!(page.lines().count() <= 150);
    assert!(page.split_whitespace().count() <= 900);
}

#[test]
fn its_keys_do_something_in_their_modes() {
    let page = readme();
    let (_, table) = page.split_once("| key | in | does |").expect("a table");
    let rows: Vec<_> = table
        .lines()
        .skip(2)
        .take_while(|row| !row.is_empty())
        .collect();
    assert_eq!(rows.len(), 12);
    let bound = printed(&["--print-keys"]);
    let bound: Vec<Vec<_>> = bound
        .lines()
        .map(|row| {
            row.split("  ")
                .map(str::trim)
                .filter(|word| !word.is_empty())
                .collect()
        })
        .collect();
    let action = |mode: &str, key: &str| {
        let row = bound.iter().find(|row| row[0] == mode && row[1] == key);
        row.map(|row| row[2])
    };
    for row in rows {
        let cells: Vec<_> = row.split('|').map(str::trim).collect();
        for key in quoted(cells[1]) {
            let anywhere = action("anywhere", key);
            if cells[2] == "any mode" {
                assert!(anywhere.is_some(), "{row}");
                let modes = [
                    "select", "edit", "view", "move", "inspect", "trace", "compare", "sequence",
                ];
                for mode in modes {
                    assert_eq!(action(mode, key).or(anywhere), anywhere, "{mode}: {row}");
                }
                continue;
            }
            for mode in cells[2].split(", ") {
                let own = action(&mode.to_lowercase(), key);
                assert!(own.or(anywhere).is_some(), "{mode}: {row}");
            }
        }
    }
}

#[test]
fn its_commands_exist() {
    let page = readme();
    let help = printed(&["--help"]);
    let calls = quoted(&page).into_iter();
    let calls: Vec<_> = calls
        .filter_map(|call| call.strip_prefix("halflight "))
        .collect();
    assert!(4 < calls.len());
    for call in calls {
        let mut words = call.split(' ');
        let command = words.next().unwrap_or_default();
        if command == "COMMAND" || command.contains('.') {
            continue;
        }
        assert!(help.contains(&format!("\n  {command} ")), "{call}");
        let own = printed(&["help", command]);
        for option in words.filter(|word| word.starts_with("--")) {
            assert!(own.contains(option), "{call}");
        }
    }
}

#[test]
fn its_sample_is_what_the_program_prints() {
    let page = readme();
    let calls = quoted(&page).into_iter();
    let mut calls = calls.filter_map(|call| call.strip_prefix("halflight explain scenes/"));
    let call = calls.next_back().expect("a sample");
    let path = format!("scenes/{call}");
    let words = ["explain"].into_iter().chain(path.split(' '));
    let printed = printed(&words.collect::<Vec<_>>());
    let (_, below) = page.split_once(call).expect("the call is there");
    let sample = below.lines().skip_while(|line| !line.starts_with("    "));
    let sample: Vec<_> = sample.map_while(|line| line.strip_prefix("    ")).collect();
    assert!(4 < sample.len());
    let mut lines = printed.lines();
    for line in sample.into_iter().filter(|line| *line != "…") {
        let is_printed = lines.any(|printed| printed.starts_with(line.trim_end_matches(" …")));
        assert!(is_printed, "{line} in\n{printed}");
    }
}

#[test]
fn its_animation_can_be_made_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let scenes = root().join("scenes");
    for name in ["default.ray", "demo.keys"] {
        fs::copy(scenes.join(name), folder.path().join(name)).expect("a copy");
    }
    let ran = Command::new(BINARY)
        .current_dir(folder.path())
        .args(["default.ray", "--keys", "demo.keys", "--screen", "40x16"])
        .args(["--dump-frame", "last.txt"])
        .status();
    assert!(ran.expect("it starts").success());
    let read = |name: &str| fs::read(folder.path().join(name)).expect("a file");
    assert!(read("demo.gif").starts_with(b"GIF89a"));
    let text = |name: &str| String::from_utf8(read(name)).expect("text");
    assert!(text("last.txt").contains("INSPECT"), "{}", text("last.txt"));
    assert!(text("default.ray").contains("1.2 0.3 0.9"));
}
