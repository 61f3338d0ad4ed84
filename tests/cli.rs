//! The program as a shell sees it: arguments, streams, files and exit codes.

use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use tempfile::TempDir;

const BINARY: &str = env!("CARGO_BIN_EXE_halflight");

/// A white ball that fills the middle of the picture, lit by ambient light alone.
const BALL: &str = "\
1 1 1
1 0 9 0 0 0 0
1 sphere 0 0 0 1  1 1 1 0 0 0 0 0 0 1 0 0 1
// view: eye 0 0 5 target 0 0 0 up 0 1 0 fov 40 size 8 6
";

/// A directory with the ball in `ball.ray`.
struct Place {
    directory: TempDir,
}

impl Place {
    fn new() -> Self {
        let directory = tempfile::tempdir_in(env!("CARGO_TARGET_TMPDIR")).expect("a directory");
        let place = Self { directory };
        place.write("ball.ray", BALL);
        place
    }

    fn at(&self, name: &str) -> PathBuf {
        self.directory.path().join(name)
    }

    fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        fs::write(self.at(name), content).expect("written");
    }

    fn read(&self, name: &str) -> Vec<u8> {
        fs::read(self.at(name)).expect("a file")
    }

    fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(self.directory.path()).expect("a directory");
        let mut names: Vec<_> = entries
            .map(|entry| {
                entry
                    .expect("an entry")
                    .file_name()
                    .to_string_lossy()
                    .into_owned()
            })
            .collect();
        names.sort();
        names
    }

    fn command(&self, line: &str) -> Command {
        let mut command = Command::new(BINARY);
        command
            .args(line.split_ascii_whitespace())
            .current_dir(self.directory.path())
            .stdin(Stdio::null());
        command
    }

    /// Runs the program with the words of `line` as arguments, its streams being pipes.
    fn run(&self, line: &str) -> Output {
        self.command(line).output().expect("it starts")
    }

    /// Runs it, expects an exit code, and returns what it told on the error stream.
    fn told(&self, line: &str, code: i32) -> String {
        let output = self.run(line);
        let told = String::from_utf8(output.stderr).expect("UTF-8");
        assert_eq!(output.status.code(), Some(code), "{line}: {told}");
        told
    }
}

#[test]
fn help_and_version_go_to_the_output_stream() {
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
fn wrong_arguments_end_with_2() {
    let place = Place::new();
    for line in [
        "--nonsense",
        "a b",
        "render",
        "render ball.ray",
        "check",
        "render ball.ray -o a.webp",
    ] {
        assert!(!place.told(line, 2).is_empty(), "{line}");
    }
    assert_eq!(place.names(), ["ball.ray"]);
}

#[test]
fn the_doctor_reports_without_a_terminal() {
    let place = Place::new();
    let mut command = place.command("doctor ball.ray");
    let output = command
        .env_remove("COLORTERM")
        .env("TERM", "xterm-256color");
    // The colours of a service that runs tests are others than its terminal's.
    let output = output.env_remove("NO_COLOR").env_remove("CI");
    let output = output.output().expect("it starts");
    assert_eq!(output.status.code(), Some(0));
    let report = String::from_utf8(output.stdout).expect("UTF-8");
    for words in [
        "TERM=xterm-256color",
        "256 colours by TERM alone",
        "--color 24",
        "threads",
        "unsaved edits are kept in",
    ] {
        assert!(report.contains(words), "{report}");
    }
    assert!(!report.contains('\x1b'));
}

/// Runs the program where no thread can start: no machine has such a stack for one.
fn without_threads(place: &Place, line: &str) -> (Option<i32>, String) {
    let mut command = place.command(line);
    let output = command
        .env("RUST_MIN_STACK", (1_u64 << 60).to_string())
        .output();
    let output = output.expect("it starts");
    let told = String::from_utf8(output.stderr).expect("UTF-8");
    (output.status.code(), told)
}

#[test]
fn scenes_are_checked_where_no_thread_can_start() {
    let place = Place::new();
    let (head, ball) = BALL.split_once("1 sphere").expect("a ball");
    let (ball, _) = ball.split_once('\n').expect("a line");
    let balls = format!("sphere{ball}\n").repeat(50_000);
    place.write("balls.ray", format!("{head}50000\n{balls}"));
    place.write("a.dat", TEXTURED);
    let pixels = vec![b'x'; 3 * 1024 * 1024];
    place.write("skin.ppm", [b"P6\n1024 1024\n255\n", &pixels[..]].concat());
    for scene in ["ball.ray", "balls.ray", "a.dat"] {
        let (code, told) = without_threads(&place, &format!("check {scene}"));
        assert_eq!(code, Some(0), "{scene}: {told}");
    }
}

#[test]
fn threads_that_cannot_start_are_an_error() {
    let place = Place::new();
    let (code, told) = without_threads(&place, "render ball.ray -o a.ppm --threads 3");
    assert_eq!(code, Some(1), "{told}");
    let first = "error: can't start the threads to trace with (3): ";
    assert!(told.starts_with(first), "{told}");
    assert!(told.ends_with("; --threads N sets how many\n"), "{told}");
    assert_eq!(place.names(), ["ball.ray"]);
    for many in ["0", "1025", "1000000"] {
        let told = place.told(&format!("render ball.ray -o a.ppm --threads {many}"), 2);
        assert!(told.contains("1..=1024"), "{told}");
    }
}

#[test]
fn the_interface_needs_a_terminal() {
    let place = Place::new();
    let told = place.told("ball.ray", 2);
    assert!(told.contains("halflight render"), "{told}");
}

#[test]
fn a_scene_that_cannot_be_read_ends_with_66() {
    let place = Place::new();
    fs::create_dir(place.at("dir.ray")).expect("created");
    #[cfg(unix)]
    std::os::unix::fs::symlink("loop.ray", place.at("loop.ray")).expect("linked");
    let long = fs::File::create(place.at("long.ray")).expect("created");
    long.set_len(1 << 32).expect("it takes no room");
    let cases = [
        ("none.ray", "none.ray: no such file"),
        #[cfg(unix)]
        ("dir.ray", "dir.ray: is a folder"),
        #[cfg(unix)]
        (".", ".: is a folder"),
        #[cfg(unix)]
        ("loop.ray", "loop.ray: "),
        ("long.ray", "long.ray: is 4 GiB or longer"),
        ("none.txt", "none.txt: no such file"),
        ("-", "-: no such file"),
    ];
    for (name, message) in cases {
        for line in [format!("check {name}"), format!("render {name} -o a.bmp")] {
            let told = place.told(&line, 66);
            assert!(told.contains(message), "{told}");
        }
    }
}

#[test]
fn what_is_no_scene_ends_with_65() {
    let place = Place::new();
    place.write("latin.ray", b"1 1 1\n// \xE9\n");
    place.write("notes.txt", "");
    let told = place.told("check latin.ray", 65);
    for part in [
        "latin.ray:2:4: the byte 0xE9",
        "iconv",
        "\n2 | // \u{fffd}\n  |    ^ UTF-8 text",
    ] {
        assert!(told.contains(part), "{part}: {told}");
    }
    let told = place.told("check notes.txt", 65);
    assert!(told.contains("notes.txt: not a scene"), "{told}");
}

#[test]
fn strict_takes_warnings_for_errors_and_notes_for_notes() {
    let place = Place::new();
    let odd = BALL.replace("sphere", "Sphere");
    place.write("odd.ray", &odd);
    for (line, code, said) in [
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
            "no picture was made: the scene has 1 error",
        ),
    ] {
        let told = place.told(line, code);
        assert!(told.contains(said), "{line}: {told}");
        assert_eq!(code == 65, told.contains("error: odd.ray:"), "{told}");
    }
    assert_eq!(place.names(), ["ball.ray", "odd.ppm", "odd.ray"]);
    // Rays that outgrow their budget are noted of the picture.
    let shells = (1..9).map(|radius| format!("sphere 0 0 0 {radius} 0 0 0 0 0 0 0 0 0 1 1 1 1\n"));
    let shells: String = shells.collect();
    let view = "// view: eye 0 0 20 target 0 0 0 size 4 3";
    place.write(
        "deep.ray",
        format!("1 1 1 1 0 50 5 1 1 1 8\n{shells}{view}\n"),
    );
    let told = place.told("render --strict deep.ray -o deep.ppm --depth 40", 0);
    assert!(told.starts_with("note: "), "{told}");
}

#[test]
fn a_picture_that_has_no_place_ends_with_73_untraced() {
    let place = Place::new();
    fs::create_dir(place.at("dir.bmp")).expect("created");
    for output in ["none/a.bmp", "dir.bmp", "ball.ray/a.bmp"] {
        let told = place.told(&format!("render ball.ray -o {output}"), 73);
        assert!(told.contains(output), "{told}");
    }
    let told = place.told("render ball.ray -o none/a.bmp", 73);
    assert_eq!(told, "error: none/a.bmp: no such folder\n");
    assert_eq!(place.names(), ["ball.ray", "dir.bmp"]);
}

#[test]
fn a_picture_never_replaces_its_scene() {
    let place = Place::new();
    let mut outputs = vec!["ball.ray", "./ball.ray", "hard.bmp"];
    fs::hard_link(place.at("ball.ray"), place.at("hard.bmp")).expect("linked");
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("ball.ray", place.at("soft.bmp")).expect("linked");
        outputs.push("soft.bmp");
    }
    for output in outputs {
        let told = place.told(&format!("render ball.ray -o {output} --format bmp"), 2);
        assert!(
            told.contains(output) && told.contains("is the scene itself"),
            "{told}"
        );
        assert_eq!(place.read("ball.ray"), BALL.as_bytes());
    }
}

#[test]
fn a_picture_never_replaces_a_file_that_its_scene_uses() {
    let place = Place::new();
    place.write("a.dat", TEXTURED);
    place.write("skin.ppm", SKIN);
    fs::hard_link(place.at("skin.ppm"), place.at("hard.bmp")).expect("linked");
    for output in ["skin.ppm", "./skin.ppm", "hard.bmp"] {
        let told = place.told(&format!("render a.dat --spp 1 -o {output}"), 2);
        let reason = "is a file that the scene uses; name another file for the picture";
        assert_eq!(told, format!("error: {output}: {reason}\n"));
        assert_eq!(place.read("skin.ppm"), SKIN.as_bytes());
    }
}

#[test]
#[cfg(unix)]
fn a_picture_goes_into_a_pipe_that_somebody_reads() {
    use rustix::fs::{CWD, FileType, Mode, mknodat};
    let place = Place::new();
    mknodat(CWD, place.at("pipe"), FileType::Fifo, Mode::RWXU, 0).expect("a pipe");
    let told = place.told("render ball.ray -o pipe --format ppm", 1);
    assert_eq!(told, "error: pipe: nobody reads this pipe\n");
    let pipe = place.at("pipe");
    let reader = std::thread::spawn(move || fs::read(pipe));
    assert_eq!(place.told("render ball.ray -o pipe --format ppm", 0), "");
    let read = reader.join().expect("no panic").expect("read");
    assert!(read.starts_with(b"P6\n8 6\n255\n"));
    place.told("render ball.ray -o /dev/null --format ppm", 0);
    assert_eq!(place.names(), ["ball.ray", "pipe"]);
}

#[test]
fn what_is_left_of_a_save_that_was_cut_off_is_named() {
    let place = Place::new();
    place.write(".halflight-backup-0-00c0ffee-ball.ray", "old");
    for line in ["check ball.ray", "render ball.ray -o a.bmp"] {
        let told = place.told(line, 0);
        let words = "note: a save of ball.ray was interrupted: ";
        assert!(told.starts_with(words), "{told}");
        assert!(
            told.contains(".halflight-backup-0-00c0ffee-ball.ray holds the previous content"),
            "{told}"
        );
    }
}

#[test]
#[cfg(unix)]
fn names_cannot_drive_the_terminal() {
    let place = Place::new();
    for name in [
        "\u{1b}[31mnone.ray",
        "a\rb\u{9b}31m.txt",
        "\u{202e}yar.none",
    ] {
        for arguments in [vec!["check", name], vec!["render", name, "-o", name]] {
            let mut command = place.command("");
            let output = command.args(arguments).output().expect("it starts");
            let told = String::from_utf8(output.stderr).expect("UTF-8");
            let raw = |c: char| c != '\n' && (c.is_control() || c == '\u{202e}');
            assert!(!told.contains(raw), "{told:?}");
        }
    }
}

#[test]
fn check_says_what_is_wrong_and_where() {
    let place = Place::new();
    place.write("bad.ray", BALL.replace("0 0 0 1  1", "0 0 0 -1  1"));
    assert_eq!(
        place.told("check ball.ray", 0),
        "1 scene checked: 0 errors, 0 warnings\n"
    );
    let told = place.told("check bad.ray ball.ray", 65);
    let first = told.lines().next().expect("a line");
    assert!(first.starts_with("error: bad.ray:3:16: "), "{told}");
    assert!(told.contains("^^"), "{told}");
    assert!(
        told.ends_with("2 scenes checked: 1 error, 0 warnings\n"),
        "{told}"
    );
    let told = place.told("check none.ray bad.ray", 66);
    assert!(told.contains("bad.ray:3:16"), "{told}");
    let objects = "sphere 0 0 0 -1  0 0 0  0 0 0  0 0 0  1 0 0 1\n".repeat(250);
    place.write(
        "worse.ray",
        format!("1 1 1  1  0 5 5 1 1 1  250\n{objects}"),
    );
    let told = place.told("check worse.ray", 65);
    assert!(
        told.ends_with(
            "note: 150 more findings not shown\n1 scene checked: 250 errors, 0 warnings\n"
        ),
        "{told}"
    );
}

#[test]
fn a_wrong_scene_is_not_rendered() {
    let place = Place::new();
    place.write("bad.ray", BALL.replace("sphere", "sphera"));
    let told = place.told("render bad.ray -o a.bmp", 65);
    assert!(told.contains("bad.ray:3:3"), "{told}");
    assert_eq!(place.names(), ["bad.ray", "ball.ray"]);
}

#[test]
fn a_ppm_on_the_output_stream_is_the_picture() {
    let place = Place::new();
    let output = place.run("render ball.ray -o - --format ppm --spp 1");
    assert_eq!(output.status.code(), Some(0));
    let header = b"P6\n8 6\n255\n";
    let (head, pixels) = output.stdout.split_at(header.len());
    assert_eq!(head, header);
    // The ball's outline subtends tan(asin(1/5)) = 0.2041 of the eye's distance, the picture's
    // half height tan(20°) = 0.3640: a circle of radius 1.68 pixels about its centre.
    let white: String = pixels
        .chunks(3)
        .map(|pixel| match pixel {
            [255, 255, 255] => '#',
            [0, 0, 0] => '.',
            other => panic!("{other:?}"),
        })
        .collect();
    let rows: Vec<_> = (0..6).map(|row| &white[row * 8..][..8]).collect();
    let expected = [
        "........", "...##...", "..####..", "..####..", "...##...", "........",
    ];
    assert_eq!(rows, expected);
}

#[test]
fn every_way_to_the_same_picture_gives_the_same_bytes() {
    let place = Place::new();
    let picture = "render ball.ray --spp 4 --size 16x9";
    assert_eq!(
        place.told(&format!("{picture} -o a.bmp --threads 1"), 0),
        ""
    );
    let expected = place.read("a.bmp");
    assert_eq!(expected.len(), 54 + 16 * 9 * 3);
    for threads in ["2", "8"] {
        place.told(&format!("{picture} -o b.bmp --threads {threads}"), 0);
        assert_eq!(place.read("b.bmp"), expected, "{threads} threads");
    }
    assert_eq!(place.run(&format!("{picture} -o -")).stdout, expected);
    place.told(&format!("{picture} -o named.wrongly --format bmp"), 0);
    assert_eq!(place.read("named.wrongly"), expected);
    assert_eq!(
        place.names(),
        ["a.bmp", "b.bmp", "ball.ray", "named.wrongly"]
    );
}

#[test]
fn impossible_sizes_are_refused_with_the_limit() {
    let place = Place::new();
    for (size, limit) in [("65536x1", "65535"), ("4294967295x4294967295", "65535")] {
        let told = place.told(&format!("render ball.ray -o a.bmp --size {size}"), 2);
        assert!(
            told.contains(&format!("--size {size}: ")) && told.contains(limit),
            "{told}"
        );
    }
    place.write("huge.ray", BALL.replace("size 8 6", "size 60000 60000"));
    let told = place.told("render huge.ray -o a.ppm", 65);
    assert!(
        told.starts_with("error: huge.ray:4:54: view size 60000x60000: ")
            && told.contains("268435456"),
        "{told}"
    );
    place.write("wide.ray", BALL.replace("size 8 6", "size 65536 1"));
    let told = place.told("render wide.ray -o a.bmp", 65);
    assert!(
        told.starts_with("error: wide.ray:4:54: view size 65536x1: ")
            && told.contains("65535")
            && told.contains("--size WxH"),
        "{told}"
    );
    assert_eq!(place.told("render wide.ray -o a.bmp --size 8x6", 0), "");
}

#[test]
fn a_reader_that_leaves_early_is_no_error() {
    let place = Place::new();
    let mut child = place
        .command("render ball.ray -o - --size 400x300 --spp 1")
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("it starts");
    // Far less than the picture, of which the pipe can't hold all.
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
        ("--help", Stdio::from(full())),
    ] {
        let mut command = place.command(line);
        let output = command.stdout(stdout).output().expect("it starts");
        assert_eq!(output.status.code(), Some(1), "{line}");
        assert!(output.stderr.starts_with(b"error: "), "{line}");
    }
    assert!(!Path::new("/dev/full").is_file());
}

/// Runs the program from a shell that was told something before.
#[cfg(unix)]
fn in_shell(place: &Place, before: &str, line: &str) -> Output {
    let script = format!("{before}; exec {BINARY} {line}");
    let mut shell = Command::new("bash");
    let shell = shell
        .args(["-c", &script])
        .current_dir(place.directory.path());
    shell.output().expect("it starts")
}

/// Runs the program with files limited to 1 KiB: writing more fails, as on a full disk.
#[cfg(unix)]
fn on_a_full_disk(place: &Place, line: &str) -> Output {
    in_shell(place, "ulimit -f 1", line)
}

/// Many spheres side by side, before the view of the ball.
#[cfg(target_os = "linux")]
fn spheres(count: usize) -> String {
    let sphere = |number| format!("sphere {number} 0 0 .1  1 1 1 0 0 0 0 0 0 1 0 0 1\n");
    let spheres: String = (0..count).map(sphere).collect();
    let view = "// view: eye 0 0 5 target 0 0 0 up 0 1 0 fov 40 size 8 6";
    format!("1 1 1 1 0 9 0 0 0 0 {count}\n{spheres}{view}")
}

#[test]
#[cfg(target_os = "linux")]
fn whatever_the_limit_on_memory_it_is_done_or_refused() {
    let place = Place::new();
    place.write("many.ray", spheres(100_000));
    let mut refused = 0;
    // From too little for the program's threads to more than enough, in kilobytes.
    for limit in (8..=52).step_by(4).map(|limit| limit * 10_000) {
        for line in ["check many.ray", "render many.ray -o -"] {
            let output = in_shell(&place, &format!("ulimit -v {limit}"), line);
            let told = String::from_utf8_lossy(&output.stderr);
            match output.status.code() {
                Some(0) => {}
                Some(1) => {
                    refused += 1;
                    let says = told.contains("out of memory: ") || told.contains("no threads");
                    assert!(
                        says && told.contains("error: "),
                        "{line} in {limit} kB: {told}"
                    );
                }
                code => panic!("{line} in {limit} kB: {code:?}: {told}"),
            }
        }
    }
    assert!((2..20).contains(&refused), "{refused} of 24 are refused");
}

#[test]
fn bytes_that_are_no_text_end_with_65() {
    let place = Place::new();
    place.write("start.ray", [0; 5000]);
    place.write(
        "late.ray",
        format!("{BALL}{}{}", "// \n".repeat(5000), "\0".repeat(200)),
    );
    for (name, line) in [("start.ray", 1), ("late.ray", 5005)] {
        let binary = "is a binary file, not text: NUL bytes from line";
        let told = place.told(&format!("check {name}"), 65);
        let said = format!("error: {name}: {binary} {line} on\n");
        assert!(told.starts_with(&said), "{told}");
    }
}

#[test]
#[cfg(target_os = "linux")]
fn a_picture_that_memory_does_not_hold_is_an_error() {
    let place = Place::new();
    let line = "render ball.ray -o a.ppm --size 16384x16384 --threads 1";
    let output = in_shell(&place, "ulimit -v 2000000", line);
    let told = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{told}");
    let expected = "error: 16384x16384: tracing it takes ";
    assert!(told.starts_with(expected), "{told}");
    assert_eq!(told.lines().count(), 1, "{told}");
    assert_eq!(place.names(), ["ball.ray"]);
}

#[test]
#[cfg(unix)]
fn a_closed_output_stream_is_an_error() {
    let place = Place::new();
    let output = in_shell(&place, "exec >&-", "render ball.ray -o -");
    let told = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{told}");
    assert!(told.starts_with("error: standard output: closed"), "{told}");
    let output = in_shell(&place, "exec >/dev/null", "render ball.ray -o -");
    assert_eq!(output.status.code(), Some(0), "nobody wants the picture");
    let output = in_shell(&place, "exec >&- 2>&-", "check ball.ray");
    assert_eq!(output.status.code(), Some(0), "its answer is the code");
}

#[test]
#[cfg(unix)]
fn a_full_disk_leaves_the_old_picture() {
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
#[cfg(unix)]
fn a_closed_error_stream_is_no_panic() {
    let place = Place::new();
    let (reader, writer) = std::io::pipe().expect("a pipe");
    drop(reader);
    let mut command = place.command("check none.ray");
    let status = command.stderr(writer).status().expect("it starts");
    assert_eq!(status.code(), Some(66));
}

#[test]
#[cfg(unix)]
fn a_terminal_is_refused_unless_forced() {
    use portable_pty::{CommandBuilder, PtySize, native_pty_system};

    let place = Place::new();
    for (force, code, mark) in [("", 2, "--force"), ("--force", 0, "BM")] {
        let pair = native_pty_system()
            .openpty(PtySize::default())
            .expect("a terminal");
        let mut command = CommandBuilder::new(BINARY);
        command.args(["render", "ball.ray", "-o", "-"]);
        command.args(force.split_ascii_whitespace());
        command.cwd(place.directory.path());
        let mut child = pair.slave.spawn_command(command).expect("it starts");
        drop(pair.slave);
        let mut shown = Vec::new();
        // The terminal's end is an error on some systems.
        let _ = pair
            .master
            .try_clone_reader()
            .expect("a reader")
            .read_to_end(&mut shown);
        let status = child.wait().expect("it ends");
        assert_eq!(status.exit_code(), code);
        assert!(String::from_utf8_lossy(&shown).contains(mark), "{shown:?}");
    }
}

/// A ball in the colours of a picture file.
const TEXTURED: &str = "\
camera perspective 0 0 8  0 0 0  0 1 0  1 0 100
resolution .02 .02
viewport 40 30
light ID 0 amb 0 0 0  0 0 0  1 1 1  1 0 0  0 shadow_off
mat ID 0  1 1 1  1 0 0 1  0 0 1
texture ID 3 image 1 1 skin.ppm
use colour ID 3 mat ID 0
obj sphere ID 0 mat ID 0  0 0 0  2
";

const SKIN: &str = "P3\n1 1\n255\n1 2 3\n";

/// The colour in the middle of a PPM.
fn middle(ppm: &[u8]) -> &[u8] {
    let pixels = &ppm[b"P6\n40 30\n255\n".len()..];
    &pixels[3 * (15 * 40 + 20)..][..3]
}

#[test]
fn textures_are_read_from_beside_the_scene() {
    let place = Place::new();
    place.write("a.dat", TEXTURED);
    place.write("skin.ppm", SKIN);
    assert_eq!(place.told("render a.dat -o a.ppm --spp 1", 0), "");
    assert_eq!(middle(&place.read("a.ppm")), [1, 2, 3]);
    assert_eq!(
        place.told("check a.dat", 0),
        "1 scene checked: 0 errors, 0 warnings\n"
    );
}

#[test]
fn a_texture_that_cannot_be_read_is_a_warning_and_magenta() {
    let place = Place::new();
    place.write("a.dat", TEXTURED);
    let told = place.told("render a.dat -o a.ppm --spp 1", 0);
    let first = "warning: a.dat:6:24: texture 3 file: no such file; magenta stands for it\n";
    assert!(told.starts_with(first), "{told}");
    for part in [
        "texture ID 3 image 1 1 skin.ppm",
        "a picture file: .bmp,",
        "skin.ppm",
    ] {
        assert!(told.contains(part), "{told}");
    }
    assert_eq!(middle(&place.read("a.ppm")), [255, 0, 255]);
    let told = place.told("check a.dat", 0);
    assert!(
        told.ends_with("1 scene checked: 0 errors, 1 warning\n"),
        "{told}"
    );
}

#[test]
fn textures_from_elsewhere_need_leave() {
    let place = Place::new();
    let elsewhere = Place::new();
    elsewhere.write("skin.ppm", SKIN);
    let path = elsewhere.at("skin.ppm");
    place.write(
        "a.dat",
        TEXTURED.replace("skin.ppm", path.to_str().expect("a plain path")),
    );
    let told = place.told("render a.dat -o a.ppm --spp 1", 0);
    assert!(told.contains("an absolute path is not read"), "{told}");
    assert_eq!(middle(&place.read("a.ppm")), [255, 0, 255]);
    let folder = elsewhere.directory.path().display();
    assert!(told.contains(&format!("--assets {folder} ")), "{told}");
    for (named, wrong) in [("nowhere", "no such folder"), ("a.dat", "not a folder")] {
        for command in ["check a.dat", "render a.dat -o a.ppm --spp 1"] {
            let told = place.told(&format!("{command} --assets {named} --assets {folder}"), 66);
            assert_eq!(told, format!("error: --assets {named}: {wrong}\n"));
        }
    }
    let allowed = format!("render a.dat -o a.ppm --spp 1 --assets {folder}");
    let path = path.display();
    let note = format!("note: {path} is read from {path}\n");
    assert_eq!(place.told(&allowed, 0), note);
    assert_eq!(middle(&place.read("a.ppm")), [1, 2, 3]);
    let told = place.told(&format!("check a.dat --assets {folder}"), 0);
    assert!(told.contains("0 warnings"), "{told}");
}

#[test]
fn a_picture_has_the_format_that_is_asked_for() {
    let place = Place::new();
    for (name, magic) in [
        ("a.tif", &b"II*\0"[..]),
        ("a.exr", b"\x76\x2f\x31\x01"),
        ("a.hdr", b"#?RADIANCE\n"),
        ("a.gif", b"GIF89a"),
        ("a.jpg", b"\xFF\xD8\xFF"),
        ("a.png", b"\x89PNG"),
    ] {
        place.told(&format!("render ball.ray -o {name} --spp 1"), 0);
        assert!(place.read(name).starts_with(magic), "{name}");
        let format = name.trim_start_matches("a.");
        let streamed = place.run(&format!("render ball.ray -o - --spp 1 --format {format}"));
        assert_eq!(streamed.stdout, place.read(name), "{name}");
    }
}
