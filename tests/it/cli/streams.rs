//! Output streams and devices that are closed, full or a terminal.

use std::io::Read;
use std::path::Path;

use super::*;

#[test]
fn a_reader_that_closes_the_pipe_early_is_not_an_error() {
    let place = Place::new();
    let mut child = place
        .command("render ball.ray -o - --size 400x300 --spp 1")
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("it starts");
    // Far less than the picture, which does not fit into the pipe.
    let mut stdout = child.stdout.take().expect("a pipe");
    stdout.read_exact(&mut [0]).expect("a byte");
    drop(stdout);
    let output = child.wait_with_output().expect("it ends");
    assert_eq!(output.status.code(), Some(0));
    assert_eq!(String::from_utf8_lossy(&output.stderr), "");
}

#[test]
#[cfg(target_os = "linux")]
fn a_full_device_is_an_error() {
    let place = Place::new();
    let full = || {
        fs::File::options()
            .write(true)
            .open("/dev/full")
            .expect("a device")
    };
    for (line, stdout) in [
        ("render ball.ray -o -", Stdio::from(full())),
        ("render ball.ray -o /dev/full --format bmp", Stdio::null()),
        (
            "render ball.ray -o - --format gif --turntable 2 --size 8x6",
            Stdio::from(full()),
        ),
        (
            "render ball.ray -o /dev/full --format gif --turntable 2 --size 8x6",
            Stdio::null(),
        ),
        ("--help", Stdio::from(full())),
    ] {
        let mut command = place.command(line);
        let output = command.stdout(stdout).output().expect("it starts");
        assert_eq!(output.status.code(), Some(1), "{line}");
        assert!(output.stderr.starts_with(b"error: "), "{line}");
    }
    assert!(!Path::new("/dev/full").is_file());
}

#[test]
fn closed_standard_output_is_an_error() {
    let place = Place::new();
    let output = in_shell(&place, "exec >&-", "render ball.ray -o -");
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{stderr}");
    assert!(
        stderr.starts_with("error: standard output: closed"),
        "{stderr}"
    );
    let output = in_shell(&place, "exec >/dev/null", "render ball.ray -o -");
    assert_eq!(output.status.code(), Some(0), "discarding the picture");
    let output = in_shell(&place, "exec >&- 2>&-", "check ball.ray");
    assert_eq!(output.status.code(), Some(0), "the exit code suffices");
}

#[test]
fn closed_standard_error_causes_no_panic() {
    let place = Place::new();
    let (reader, writer) = std::io::pipe().expect("a pipe");
    drop(reader);
    let mut command = place.command("check none.ray");
    let status = command.stderr(writer).status().expect("it starts");
    assert_eq!(status.code(), Some(66));
}

/// Runs the program with files limited to 1 KiB, so that writing more fails as on a full disk.
fn on_a_full_disk(place: &Place, line: &str) -> Output {
    in_shell(place, "ulimit -f 1", line)
}

#[test]
fn a_full_disk_keeps_the_old_picture() {
    let place = Place::new();
    for linked in [false, true] {
        place.write("a.bmp", "the old picture");
        if linked {
            fs::hard_link(place.at("a.bmp"), place.at("b.bmp")).expect("linked");
        }
        let output = on_a_full_disk(&place, "render ball.ray -o a.bmp --size 100x100 --spp 1");
        assert_eq!(output.status.code(), Some(1), "{output:?}");
        assert_eq!(place.read("a.bmp"), b"the old picture");
    }
    assert_eq!(place.names(), ["a.bmp", "b.bmp", "ball.ray"]);
}

#[test]
fn a_terminal_is_refused_unless_forced() {
    use crate::harness::terminal::{Terminal, start};

    let place = Place::new();
    for (force, code, mark) in [("", 2, "--force"), ("--force", 0, "BM")] {
        let (terminal, line) = Terminal::open(80, 24).expect("a terminal");
        let mut command = Command::new(BINARY);
        command.args(["render", "ball.ray", "-o", "-"]);
        command.args(force.split_ascii_whitespace());
        command.current_dir(place.directory.path());
        let mut child = start(command, line).expect("it starts");
        let mut shown = Vec::new();
        let mut output = terminal.handle().expect("a handle");
        // On some systems, the end of a terminal is an error.
        let _ = output.read_to_end(&mut shown);
        let status = child.wait().expect("it ends");
        assert_eq!(status.code(), Some(code));
        assert!(String::from_utf8_lossy(&shown).contains(mark), "{shown:?}");
    }
}

/// The words of a JSON text that stand after a key.
fn after<'t>(text: &'t str, key: &str) -> &'t str {
    let (_, rest) = text.split_once(&format!("\"{key}\":")).expect("the key");
    rest.split([',', '}', '\n']).next().expect("a value").trim()
}

#[test]
fn progress_is_told_to_programs() {
    let place = Place::new();
    let said = place.stderr("render ball.ray -o a.bmp --spp 4 --progress json", 0);
    let last = said.lines().last().expect("at least one line");
    for (key, value) in [
        ("event", "\"done\""),
        ("done", "1.0"),
        ("spp", "4"),
        ("left", "0.0"),
    ] {
        assert_eq!(after(last, key), value, "{said}");
    }
    assert_eq!(
        place.stderr("render ball.ray -o a.bmp --progress none", 0),
        ""
    );
}

/// The values of the events in lines of JSON, which all of these are.
fn events(said: &str) -> Vec<String> {
    let lines = said.lines().map(|line| {
        assert!(line.starts_with('{') && line.ends_with('}'), "{line}");
        after(line, "event").trim_matches('"').to_owned()
    });
    lines.collect()
}

#[test]
fn progress_of_a_sequence_covers_all_of_it() {
    let place = Place::new();
    for output in ["f%d.ppm", "f.gif"] {
        let line = format!("render ball.ray -o {output} --turntable 4 --progress json");
        let said = place.stderr(&line, 0);
        events(&said);
        let frames = said.lines().filter(|line| line.contains("\"frame\":"));
        let of_frames = frames.filter(|line| after(line, "event") == "\"frame\"");
        let done: Vec<_> = of_frames.map(|line| after(line, "done")).collect();
        assert_eq!(done, ["0.25", "0.5", "0.75", "1.0"], "{said}");
        let elapsed = said
            .lines()
            .map(|line| after(line, "elapsed").parse::<f64>());
        let elapsed: Result<Vec<_>, _> = elapsed.collect();
        assert!(elapsed.expect("numbers").is_sorted(), "{said}");
    }
}

/// Warnings, errors and notes are objects among those of the progress.
#[test]
fn messages_beside_progress_are_objects() {
    let place = Place::new();
    place.write(
        "odd.ray",
        BALL.replace("sphere 0 0 0 1 ", "sphere 0 0 0 1f "),
    );
    let bad = BALL.replace("sphere 0 0 0 1 ", "sphere 0 0 0 -1 ");
    place.write("bad.ray", &bad);
    place.write("bytes.ray", b"1 1 1\n\xff");
    place.write("t.toml", "frames = 2\nfps = 0\n");
    fs::create_dir(place.at("shots")).expect("it is new");
    place.write("shots/a.ray", &bad);
    for (line, code, expected) in [
        ("odd.ray -o a.ppm", 0, &["warning", "done"][..]),
        ("bad.ray -o a.ppm", 65, &["error", "error"]),
        ("bytes.ray -o a.ppm", 65, &["error"]),
        ("none.ray -o a.ppm", 66, &["error"]),
        ("ball.ray -o none/a.ppm", 73, &["error"]),
        ("ball.ray -o a.ppm --noise .1", 0, &["note", "done"]),
        ("ball.ray -o a.ppm --shard 0/2", 0, &["done", "note"]),
        ("ball.ray -o b.ppm --exposure -20", 0, &["done", "note"]),
        ("ball.ray -o f%d.ppm --turntable 1", 0, &["frame", "done"]),
        ("ball.ray -o f%d.ppm --turntable 1", 0, &["note", "done"]),
        (
            "ball.ray -o g%d.ppm --track t.toml",
            65,
            &["error", "error"],
        ),
        ("shots -o s%d.ppm", 65, &["error", "error"]),
    ] {
        let said = place.stderr(&format!("render {line} --spp 4 --progress json"), code);
        let found = events(&said);
        let found: Vec<_> = found.iter().filter(|event| *event != "progress").collect();
        assert_eq!(found, expected, "{line}: {said}");
    }
    place.write("odd.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 9 3\n");
    place.write(
        "odd.xml",
        "<xml><scene><object type=\"obj\" name=\"odd.obj\"/></scene></xml>\n",
    );
    for (scene, place_of_it) in [
        ("odd.ray", ["\"odd.ray\"", "3", "16", "\"1f\""]),
        ("odd.xml", ["\"odd.obj\"", "5", "5", "\"9\""]),
    ] {
        let said = place.stderr(&format!("render {scene} -o a.ppm --progress json"), 0);
        let mut lines = said.lines();
        let is_of_it = |line: &&str| after(line, "file") == place_of_it[0];
        let first = lines.find(is_of_it).expect("a line");
        for (key, value) in ["file", "line", "column", "excerpt"]
            .into_iter()
            .zip(place_of_it)
        {
            assert_eq!(after(first, key), value, "{first}");
        }
    }
}

#[test]
fn figures_of_a_render_are_written() {
    let place = Place::new();
    let line = "render ball.ray -o a.bmp --size 40x30 --spp 4 --seed 5 --stats";
    place.stderr(&format!("{line} stats.json"), 0);
    let whole = String::from_utf8(place.read("stats.json")).expect("UTF-8");
    // A part that was continued has the figures of all of it.
    place.stderr(
        "render ball.ray -o a.bmp --size 40x30 --spp 2 --seed 5 --resume",
        0,
    );
    place.stderr(&format!("{line} resumed.json --resume"), 0);
    let resumed = String::from_utf8(place.read("resumed.json")).expect("UTF-8");
    for key in ["all", "shadow", "samples", "noise", "spp", "digest"] {
        assert_eq!(after(&resumed, key), after(&whole, key), "{key}");
    }
    let output = place.run(&format!("{line} - --shard 0/2"));
    let shard = String::from_utf8(output.stdout).expect("UTF-8");
    for (key, of_whole, of_shard) in [
        ("scene", "\"ball.ray\"", "\"ball.ray\""),
        ("pixels", "1200", "960"),
        ("samples", "4800", "3840"),
        ("size", "\"40x30\"", "\"40x30\""),
        ("seed", "5", "5"),
        ("view", "\"own\"", "\"own\""),
        ("layers", "\"none\"", "\"none\""),
        ("spp", "4", "4"),
        ("shadow", "0", "0"),
    ] {
        assert_eq!(
            [after(&whole, key), after(&shard, key)],
            [of_whole, of_shard],
            "{key}"
        );
    }
    // A camera ray each; those that hit nothing count too.
    assert_eq!(after(&whole, "all"), "4800");
    assert_eq!(after(&whole, "digest"), after(&shard, "digest"));
    place.stderr("render ball.ray -o - --stats -", 2);
}

#[test]
fn memory_is_estimated_without_rendering() {
    let place = Place::new();
    let estimate = |size: &str| -> u32 {
        let output = place.run(&format!(
            "render ball.ray -o a.exr --size {size} --estimate"
        ));
        let said = String::from_utf8(output.stdout).expect("UTF-8");
        let number = said.trim_end().strip_suffix('M').expect("megabytes");
        number.parse().expect("a number")
    };
    let (small, large) = (estimate("8x6"), estimate("4000x3000"));
    // Layers add at least their values, and a shard takes hardly any of the picture.
    let with = |options: &str| estimate(&format!("4000x3000 {options}"));
    let (one, two) = (with("--layers depth"), with("--layers depth,normal"));
    assert!(
        12 * 12 < one - large && 12 * 12 < two - one,
        "{large} {one} {two}"
    );
    let shard = with("--shard 0/100");
    assert!(shard < small + 12 * 4, "{small} {shard}");
    assert!(with("--resume") >= large);
    // At least 24 bytes of sums and 12 of values a pixel.
    assert!(
        12 * 36 < large - small && large - small < 12 * 100,
        "{small} {large}"
    );
    assert_eq!(place.names(), ["ball.ray"]);
}
