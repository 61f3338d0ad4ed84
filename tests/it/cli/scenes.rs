//! Reading and checking scenes.

use super::*;

#[test]
fn an_unreadable_scene_exits_with_66() {
    let place = Place::new();
    fs::create_dir(place.at("dir.ray")).expect("created");
    std::os::unix::fs::symlink("loop.ray", place.at("loop.ray")).expect("linked");
    let long = fs::File::create(place.at("long.ray")).expect("created");
    long.set_len(1 << 32).expect("a sparse file");
    let cases = [
        ("none.ray", "none.ray: no such file"),
        ("dir.ray", "dir.ray: is a folder"),
        (".", ".: is a folder"),
        ("loop.ray", "loop.ray: "),
        ("long.ray", "long.ray: is 4 GiB or longer"),
        ("none.txt", "none.txt: no such file"),
        ("-", "-: no such file"),
    ];
    for (name, message) in cases {
        let check = place.stderr(&format!("check {name}"), 66);
        assert!(check.contains(message), "{check}");
        // A folder is a sequence, which needs more than one picture.
        let (code, message) = if message.ends_with("is a folder") {
            (2, "has no placeholder for the frame number")
        } else {
            (66, message)
        };
        let render = place.stderr(&format!("render {name} -o a.bmp"), code);
        assert!(render.contains(message), "{render}");
    }
}

#[test]
fn the_interface_reports_an_unreadable_scene_before_a_missing_terminal() {
    let place = Place::new();
    place.write("a.ray", "");
    for (name, code, message) in [
        ("none/a.ray", 66, "none/a.ray: no such file"),
        ("new.ray", 2, "the interface needs a terminal"),
        ("a.ray", 2, "the interface needs a terminal"),
    ] {
        let stderr = place.stderr(name, code);
        assert!(stderr.contains(message), "{stderr}");
    }
}

#[test]
fn a_file_that_is_not_a_scene_exits_with_65() {
    let place = Place::new();
    place.write("latin.ray", b"1 1 1\n// \xE9\n");
    place.write("notes.txt", "");
    let stderr = place.stderr("check latin.ray", 65);
    for part in [
        "latin.ray:2:4: the byte 0xE9",
        "iconv",
        "\n2 | // \u{fffd}\n  |    ^ UTF-8 text",
    ] {
        assert!(stderr.contains(part), "{part}: {stderr}");
    }
    let stderr = place.stderr("check notes.txt", 65);
    assert!(stderr.contains("notes.txt: not a scene"), "{stderr}");
}

#[test]
fn a_binary_file_exits_with_65() {
    let place = Place::new();
    place.write("start.ray", [0; 5000]);
    place.write(
        "late.ray",
        format!("{BALL}{}{}", "// \n".repeat(5000), "\0".repeat(200)),
    );
    for (name, line) in [("start.ray", 1), ("late.ray", 5005)] {
        let binary = "is a binary file, not text: NUL bytes from line";
        let stderr = place.stderr(&format!("check {name}"), 65);
        let expected = format!("error: {name}: {binary} {line} on\n");
        assert!(stderr.starts_with(&expected), "{stderr}");
    }
}

#[test]
fn strict_turns_warnings_into_errors_but_not_notes() {
    let place = Place::new();
    let odd = BALL.replace("sphere", "Sphere");
    place.write("odd.ray", &odd);
    for (line, code, expected) in [
        ("check odd.ray", 0, "0 errors, 1 warning"),
        ("check --strict odd.ray", 65, "1 error, 0 warnings"),
        ("check --strict ball.ray", 0, "0 errors, 0 warnings"),
        (
            "render odd.ray -o odd.ppm --size 4x3",
            0,
            "warning: odd.ray:",
        ),
        (
            "render --strict odd.ray -o strict.ppm",
            65,
            "error: the scene has 1 error",
        ),
    ] {
        let stderr = place.stderr(line, code);
        assert!(stderr.contains(expected), "{line}: {stderr}");
        assert_eq!(code == 65, stderr.contains("error: odd.ray:"), "{stderr}");
    }
    assert_eq!(place.names(), ["ball.ray", "odd.ppm", "odd.ray"]);
    // Samples that exceed their ray budget give a note.
    let shells = (1..9).map(|radius| format!("sphere 0 0 0 {radius} 0 0 0 0 0 0 0 0 0 1 1 1 1\n"));
    let shells: String = shells.collect();
    let view = "// view: eye 0 0 20 target 0 0 0 size 4 3";
    place.write(
        "deep.ray",
        format!("1 1 1 1 0 50 5 1 1 1 8\n{shells}{view}\n"),
    );
    let stderr = place.stderr("render --strict deep.ray -o deep.ppm --depth 40", 0);
    assert!(stderr.starts_with("note: "), "{stderr}");
}

#[test]
fn check_reports_errors_with_their_positions() {
    let place = Place::new();
    place.write("bad.ray", BALL.replace("0 0 0 1  1", "0 0 0 -1  1"));
    assert_eq!(
        place.stderr("check ball.ray", 0),
        "1 scene checked: 0 errors, 0 warnings\n"
    );
    let stderr = place.stderr("check bad.ray ball.ray", 65);
    let first = stderr.lines().next().expect("a line");
    assert!(first.starts_with("error: bad.ray:3:16: "), "{stderr}");
    assert!(stderr.contains("^^"), "{stderr}");
    assert!(
        stderr.ends_with("2 scenes checked: 1 error, 0 warnings\n"),
        "{stderr}"
    );
    let stderr = place.stderr("check none.ray bad.ray", 66);
    assert!(stderr.contains("bad.ray:3:16"), "{stderr}");
    let objects = "sphere 0 0 0 -1  0 0 0  0 0 0  0 0 0  1 0 0 1\n".repeat(250);
    place.write(
        "worse.ray",
        format!("1 1 1  1  0 5 5 1 1 1  250\n{objects}"),
    );
    let stderr = place.stderr("check worse.ray", 65);
    assert!(
        stderr.ends_with(
            "note: 150 more findings not shown\n1 scene checked: 250 errors, 0 warnings\n"
        ),
        "{stderr}"
    );
}

#[test]
fn the_backup_of_an_interrupted_save_is_reported() {
    let place = Place::new();
    place.write(".halflight-backup-0-00c0ffee-ball.ray", "old");
    for line in ["check ball.ray", "render ball.ray -o a.bmp"] {
        let stderr = place.stderr(line, 0);
        let words = "note: a save of ball.ray was interrupted: the previous content is in ";
        assert!(stderr.starts_with(words), "{stderr}");
        assert!(
            stderr.contains(".halflight-backup-0-00c0ffee-ball.ray; delete that file if"),
            "{stderr}"
        );
    }
}

#[test]
fn an_invalid_scene_is_not_rendered() {
    let place = Place::new();
    place.write("bad.ray", BALL.replace("sphere", "sphera"));
    let stderr = place.stderr("render bad.ray -o a.bmp", 65);
    assert!(stderr.contains("bad.ray:3:3"), "{stderr}");
    assert_eq!(place.names(), ["bad.ray", "ball.ray"]);
}
