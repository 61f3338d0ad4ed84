//! The configuration: its errors as printed, and what it changes.

use std::path::Path;

use super::*;

/// Each faulty configuration of `tests/config` is answered by the text beside it, which is written
/// instead if `UPDATE_FRAMES` is set.
#[test]
fn each_error_is_printed_with_its_place_and_advice() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/config");
    let place = Place::new();
    for name in ["keys", "settings", "syntax", "twice"] {
        let file = folder.join(name).with_extension("toml");
        place.write("a.toml", fs::read(file).expect("it is there"));
        let printed = place.stderr("--config a.toml ball.ray", 2);
        let expected = folder.join(name).with_extension("txt");
        if std::env::var_os("UPDATE_FRAMES").is_some() {
            fs::write(&expected, &printed).expect("writable");
        }
        let expected = fs::read_to_string(expected).unwrap_or_default();
        assert_eq!(printed, expected, "{name}:\n{printed}");
    }
}

/// Reading it must not start the threads, which the interface does later.
#[test]
fn the_interface_starts_with_a_valid_configuration() {
    let place = Place::new();
    place.write("a.toml", "theme = \"mono\"\n");
    place.write("quit.keys", "q");
    place.write("ball.ray", BALL);
    let line = "--config a.toml ball.ray --keys quit.keys --dump-frame screen.txt";
    assert_eq!(place.stderr(line, 0), "");
}

#[test]
fn a_configuration_that_is_named_must_exist_and_the_usual_one_need_not() {
    let place = Place::new();
    let missing = place.stderr("--config none.toml --print-config", 66);
    assert!(missing.contains("none.toml"), "{missing}");
    let printed = |line: &str| {
        let ran = place
            .command(line)
            .env("XDG_CONFIG_HOME", place.at("config"))
            .output();
        String::from_utf8(ran.expect("it starts").stdout).expect("UTF-8")
    };
    assert!(printed("--print-config").contains("\n# spp = 16\n"));
    fs::create_dir_all(place.at("config/halflight")).expect("it is new");
    place.write(
        "config/halflight/config.toml",
        "spp = 5\ntheme = \"mono\"\n",
    );
    assert!(printed("--print-config").contains("\nspp = 5\n"));
    assert!(printed("--print-config --spp 6").contains("\nspp = 6\n"));
    assert!(printed("--print-config --spp 6").contains("\ntheme = \"mono\"\n"));
}

#[test]
fn a_home_that_can_hold_no_configuration_has_none() {
    let place = Place::new();
    let run = |line: &str, variable: &str, value: &str| {
        let mut command = place.command(line);
        for name in ["XDG_CONFIG_HOME", "HOME"] {
            command.env_remove(name);
        }
        let output = command.env(variable, value).output().expect("it starts");
        (
            output.status.code(),
            String::from_utf8(output.stdout).expect("UTF-8"),
        )
    };
    let file = place.at("ball.ray/x").display().to_string();
    let default = run("--print-config", "HOME", &file);
    assert_eq!(default.0, Some(0));
    for (line, variable, value) in [
        ("--print-config", "HOME", "/dev/null"),
        ("--print-config", "XDG_CONFIG_HOME", "/dev/null"),
        ("--print-config", "XDG_CONFIG_HOME", &file),
        ("--config /dev/null --print-config", "HOME", "/dev/null"),
    ] {
        let case = format!("{line} {variable}={value}");
        assert_eq!(run(line, variable, value), default, "{case}");
    }
    // What is there but is no file may have been meant as one.
    fs::create_dir_all(place.at("own/halflight/config.toml")).expect("it is new");
    let own = place.at("own").display().to_string();
    assert_eq!(run("--print-config", "XDG_CONFIG_HOME", &own).0, Some(66));
}
