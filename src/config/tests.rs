use std::time::Duration;

use super::*;
use scene::{Filter, Integrator, Rendering};
use ui::Theme;
use ui::keymap::{Context, Mode};
use ui::terminal::{Choice, ColourDepth, Mouse};

const CHANGED: &str = r#"
theme = "light"
color = "256"
mouse = false
editor = "hx \"quoted\" \\"
bandwidth = 0
poll = 1_000
spp = 0x10
depth = 12
integrator = "path"
filter = "gaussian"
threads = 3
assets = ["/a", "/b c"]

[keys.anywhere]
"Ctrl-S" = "save"
w = "none"
"Shift-F3" = "undo"

[keys.select]
S = "save"
s = "none"
"d d" = "delete"
"ctrl-r" = false
e = "edit"

[keys.quit]
y = "accept"
x = "accept"
"#;

fn options(text: &str) -> Options {
    read(text).unwrap_or_else(|errors| panic!("{text}: {errors:?}"))
}

#[test]
fn every_setting_is_read() {
    let options = options(CHANGED);
    let rest = Options {
        keymap: options.keymap.clone(),
        ..Options::default()
    };
    let expected = Options {
        theme: Some(Theme::Light),
        colour: Some(Choice::Fixed(ColourDepth::Palette256)),
        mouse: Some(Mouse::Off),
        editor: Some("hx \"quoted\" \\".to_owned()),
        bandwidth: Some(0),
        poll: Some(Duration::from_secs(1)),
        rendering: Rendering {
            spp: Some(16),
            depth: Some(12),
            integrator: Some(Integrator::Path),
            filter: Some(Filter::Gaussian),
            ..Rendering::default()
        },
        threads: Some(3),
        assets: vec!["/a".into(), "/b c".into()],
        ..rest
    };
    assert_eq!(options, expected);
    let key = |mode, action| options.keymap.key(Context::In(mode), action);
    assert_eq!(key(Mode::Select, "save").as_deref(), Some("S"));
    assert_eq!(key(Mode::View, "save").as_deref(), Some("Ctrl-S"));
    assert_eq!(key(Mode::Select, "delete").as_deref(), Some("dd"));
    assert_eq!(key(Mode::Select, "redo"), None);
    assert_eq!(key(Mode::Edit, "redo").as_deref(), Some("Ctrl-R"));
    assert_eq!(key(Mode::Select, "edit").as_deref(), Some("e"));
}

#[test]
fn a_printed_configuration_changes_nothing() {
    for text in ["", CHANGED] {
        let wanted = options(text);
        let printed = print_config(&wanted);
        assert_eq!(options(&printed), wanted, "{printed}");
    }
}

#[test]
fn the_defaults_in_a_printed_configuration_are_those_in_use() {
    let printed = print_config(&Options::default());
    let lines = printed.lines().map(|line| match line.strip_prefix("# ") {
        Some(rest) if rest.contains(" = ") => rest,
        _ => line,
    });
    let text: Vec<_> = lines.filter(|line| !line.starts_with("assets")).collect();
    let set = options(&text.join("\n"));
    assert_eq!(set.keymap, Options::default().keymap);
    assert_eq!(set.rendering.spp, Some(scene::DEFAULT_SPP));
}

#[test]
fn what_is_given_on_the_command_line_takes_precedence() {
    let given = Options {
        rendering: Rendering {
            spp: Some(4),
            ..Rendering::default()
        },
        mouse: Some(Mouse::Off),
        ..Options::default()
    };
    let both = given.or(options("spp = 9\nmouse = true\ndepth = 1"));
    assert_eq!(
        (both.rendering.spp, both.rendering.depth),
        (Some(4), Some(1))
    );
    assert_eq!(both.mouse, Some(Mouse::Off));
}

#[test]
fn keys_are_printed_with_the_names_of_their_actions() {
    let keymap = options("[keys.anywhere]\n\"Ctrl-S\" = \"save\"").keymap;
    let text = print_keys(&keymap);
    let has = |row: &[&str]| {
        let rows = text.lines();
        let words = row.join(" ");
        rows.map(|line| line.split_whitespace().collect::<Vec<_>>().join(" "))
            .any(|line| line == words)
    };
    for row in [
        ["mode", "key", "action", "description"],
        ["anywhere", "Ctrl-S", "save", "save the scene"],
        ["anywhere", "w", "save", "save the scene"],
        ["select", "g g", "first", "first"],
        ["quit", "y", "accept", "quit anyway"],
    ] {
        assert!(has(&row), "{row:?} in\n{text}");
    }
}

#[test]
fn a_long_text_of_mistakes_has_a_hundred_errors() {
    let numbered = |head: &str, line: fn(u32) -> String| {
        let lines = std::iter::once(head.to_owned()).chain((0..9999).map(line));
        lines.collect::<Vec<_>>().join("\n")
    };
    for mistakes in [
        numbered("", |at| format!("k{at} = 1")),
        "'\n".repeat(9999),
        numbered("[keys]", |at| format!("[keys.k{at}]")),
        numbered("[keys.select]", |at| format!("'k{at}' = 'x'")),
    ] {
        assert_eq!(read(&mistakes).expect_err("mistakes").len(), 100);
    }
}
