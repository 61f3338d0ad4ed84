//! Arguments, help, and errors found before any work.

use super::*;

#[test]
fn help_and_version_go_to_standard_output() {
    let place = Place::new();
    for line in ["--help", "-h", "render --help", "check --help", "--version"] {
        let output = place.run(line);
        assert_eq!(output.status.code(), Some(0), "{line}");
        assert!(
            !output.stdout.is_empty() && output.stderr.is_empty(),
            "{line}"
        );
    }
}

#[test]
fn wrong_arguments_exit_with_2() {
    let place = Place::new();
    for line in [
        "--nonsense",
        "a b",
        "render",
        "render ball.ray",
        "check",
        "render ball.ray -o a.webp",
    ] {
        assert!(!place.stderr(line, 2).is_empty(), "{line}");
    }
    assert_eq!(place.names(), ["ball.ray"]);
}

#[test]
fn unknown_vector_instructions_are_refused_by_every_command() {
    let place = Place::new();
    for line in ["", "render ball.ray -o a.png", "bench", "doctor"] {
        let mut command = place.command(line);
        let output = command.env("HALFLIGHT_CPU", "SSE2").output();
        let output = output.expect("it starts");
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{line}: {said}");
        assert!(said.contains("expected sse2, avx2 or avx512"), "{said}");
    }
}

#[test]
fn the_interface_needs_a_terminal() {
    let place = Place::new();
    let stderr = place.stderr("ball.ray", 2);
    assert!(stderr.contains("halflight render"), "{stderr}");
}

#[test]
fn the_doctor_reports_without_a_terminal() {
    let place = Place::new();
    let mut command = place.command("doctor ball.ray");
    let output = command
        .env_remove("COLORTERM")
        .env("TERM", "xterm-256color");
    // These variables override the terminal's colours; CI services set the second one.
    let output = output.env_remove("NO_COLOR").env_remove("CI");
    let output = output.output().expect("it starts");
    assert_eq!(output.status.code(), Some(0));
    let report = String::from_utf8(output.stdout).expect("UTF-8");
    for words in [
        "TERM=xterm-256color",
        "256 colours from TERM alone",
        "--color 24",
        "threads",
        "unsaved edits are kept in",
    ] {
        assert!(report.contains(words), "{report}");
    }
    assert!(!report.contains('\x1b'));
}

#[test]
fn file_names_cannot_control_the_terminal() {
    let place = Place::new();
    for name in [
        "\u{1b}[31mnone.ray",
        "a\rb\u{9b}31m.txt",
        "\u{202e}yar.none",
    ] {
        for arguments in [vec!["check", name], vec!["render", name, "-o", name]] {
            let mut command = place.command("");
            let output = command.args(arguments).output().expect("it starts");
            let stderr = String::from_utf8(output.stderr).expect("UTF-8");
            let raw = |c: char| c != '\n' && (c.is_control() || c == '\u{202e}');
            assert!(!stderr.contains(raw), "{stderr:?}");
        }
    }
}

#[test]
fn impossible_sizes_are_refused_stating_the_limit() {
    let place = Place::new();
    for (size, limit) in [("65536x1", "65535"), ("4294967295x4294967295", "65535")] {
        let stderr = place.stderr(&format!("render ball.ray -o a.bmp --size {size}"), 2);
        assert!(
            stderr.contains(&format!("--size {size}: ")) && stderr.contains(limit),
            "{stderr}"
        );
    }
    place.write("huge.ray", BALL.replace("size 8 6", "size 60000 60000"));
    let stderr = place.stderr("render huge.ray -o a.ppm", 65);
    assert!(
        stderr.starts_with("error: huge.ray:4:54: view size 60000x60000: ")
            && stderr.contains("268435456"),
        "{stderr}"
    );
    place.write("wide.ray", BALL.replace("size 8 6", "size 65536 1"));
    let stderr = place.stderr("render wide.ray -o a.bmp", 65);
    assert!(
        stderr.starts_with("error: wide.ray:4:54: view size 65536x1: ")
            && stderr.contains("65535")
            && stderr.contains("--size WxH"),
        "{stderr}"
    );
    assert_eq!(place.stderr("render wide.ray -o a.bmp --size 8x6", 0), "");
}
