//! Shards and checkpoints: however a picture is divided and interrupted, its bytes are the same.

use std::path::Path;

use halflight::file::Digest;

use super::*;

/// A scene with mirrors, shadows and glass, which the repository has a picture of.
const SCENE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/default.ray");

impl Place {
    /// Renders the scene; returns the bytes of the picture.
    fn rendered(&self, picture: &str, options: &str) -> Vec<u8> {
        self.stderr(&format!("render {SCENE} -o {picture} {options}"), 0);
        self.read(picture)
    }

    /// Merges part files of a picture; asserts the exit code, and returns standard error.
    fn merged(&self, parts: &[String], picture: &str, code: i32) -> String {
        self.stderr(&format!("merge {} -o {picture}", parts.join(" ")), code)
    }
}

#[test]
fn shards_make_the_picture_of_a_single_render() {
    let place = Place::new();
    for options in [
        "--size 100x70 --spp 3",
        "--size 70x40 --integrator path --spp 2 --transfer srgb",
        "--size 64x70 --aov depth --region 3,5,40,60",
        "--size 70x40 --spp 64 --noise 0.02",
    ] {
        let whole = place.rendered("whole.png", options);
        for count in [1, 2, 3, 7, 64] {
            let name = format!("{count}.png");
            let parts = (0..count).map(|at| match count {
                1 => format!("{count}.part"),
                _ => format!("{count}.{at}-{count}.part"),
            });
            let parts: Vec<_> = parts.collect();
            for shard in 0..count {
                let threads = 1 + shard % 3;
                let options = format!("{options} --shard {shard}/{count} --threads {threads}");
                let line = format!("render {SCENE} -o {name} {options}");
                place.stderr(&line, 0);
            }
            place.merged(&parts, &name, 0);
            assert!(place.read(&name) == whole, "{options} in {count}");
            for part in parts {
                fs::remove_file(place.at(&part)).expect("it is there");
            }
        }
    }
}

#[test]
fn parts_that_make_no_picture_are_named() {
    let place = Place::new();
    let options = "--size 100x80 --spp 1";
    for shard in 0..4 {
        place.stderr(
            &format!("render {SCENE} -o a.bmp {options} --shard {shard}/4"),
            0,
        );
    }
    let parts: Vec<_> = (0..4).map(|shard| format!("a.{shard}-4.part")).collect();
    let missing = |parts: &[String]| {
        let output = place.run(&format!("merge --missing {}", parts.join(" ")));
        assert_eq!(output.status.code(), Some(0));
        let said =
            [output.stdout, output.stderr].map(|said| String::from_utf8(said).expect("UTF-8"));
        said.concat()
    };
    assert_eq!(missing(&parts), "");
    assert_eq!(missing(&parts[1..2]), "0,2-3\n");
    let said = place.merged(&parts[1..], "a.bmp", 3);
    assert_eq!(
        said,
        "error: incomplete: 3 of 12 blocks are missing; rerun shard 0 (of 4) with --resume\n"
    );
    assert!(!place.at("a.bmp").exists());
    // A damaged shard is missing too, and is continued.
    let good = place.read("a.2-4.part");
    let mut bad = good.clone();
    bad[good.len() / 2] ^= 1;
    place.write("a.2-4.part", &bad);
    let said = place.merged(&parts, "a.bmp", 3);
    assert!(
        said.starts_with("error: a.2-4.part is damaged from byte "),
        "{said}"
    );
    assert!(missing(&parts).starts_with("2\nnote: a.2-4.part is damaged "));
    let line = format!("render {SCENE} -o a.bmp {options} --shard 2/4");
    let said = place.stderr(&line, 73);
    assert!(
        said.contains("it exists; continue it with --resume"),
        "{said}"
    );
    let said = place.stderr(&format!("{line} --resume"), 0);
    assert!(
        said.contains("note: a.2-4.part: discarded ") && said.contains(" damaged bytes at the end"),
        "{said}"
    );
    place.merged(&parts, "a.bmp", 0);
    assert!(place.read("a.bmp") == place.rendered("b.bmp", options));
    // Another scene, other settings.
    place.stderr(
        &format!("render ball.ray -o c.bmp {options} --shard 0/4"),
        0,
    );
    place.stderr(
        &format!("render {SCENE} -o d.bmp {options} --seed 2 --shard 0/4"),
        0,
    );
    for (part, difference) in [("c.0-4.part", "scene "), ("d.0-4.part", "seed 2 and 0")] {
        let parts = [parts[1].clone(), part.to_owned()];
        let said = place.merged(&parts, "e.bmp", 3);
        let expected =
            format!("error: {part} and a.1-4.part belong to different pictures: {difference}");
        assert!(said.starts_with(&expected), "{said}");
    }
    place.merged(&["none.part".to_owned()], "e.bmp", 66);
    let made = Command::new("mkfifo").arg(place.at("pipe.part")).status();
    assert!(made.expect("it starts").success());
    let said = place.merged(&["pipe.part".to_owned()], "e.bmp", 66);
    assert_eq!(said, "error: pipe.part is a pipe: parts must be files\n");
    let said = place.stderr("render ball.ray -o pipe.bmp --resume", 73);
    assert!(said.contains("it is not a part file"), "{said}");
}

#[test]
fn a_picture_is_continued_with_more_samples() {
    let place = Place::new();
    let options = "--size 60x40 --resume";
    for spp in [1, 3, 4, 16] {
        let continued = place.rendered("a.png", &format!("{options} --spp {spp}"));
        let whole = place.rendered("b.png", &format!("--size 60x40 --spp {spp}"));
        assert!(continued == whole, "{spp}");
    }
    // The part has the samples, for any format.
    place.stderr("merge a.part -o a.ppm", 0);
    assert!(place.read("a.ppm") == place.rendered("b.ppm", "--size 60x40 --spp 16"));
    let said = place.stderr(&format!("render {SCENE} -o a.png {options} --spp 8"), 2);
    assert!(said.contains("has 16 samples per pixel already"), "{said}");
    let said = place.stderr(
        &format!("render {SCENE} -o a.png {options} --spp 16 --depth 3"),
        73,
    );
    assert!(
        said.contains("belongs to another picture: depth 8, not 3"),
        "{said}"
    );
    // With a limit of time, the samples are those of a whole pass.
    let said = place.stderr(
        &format!("render {SCENE} -o a.png {options} --time 1ms --spp 64"),
        0,
    );
    assert!(said.starts_with("note: 32 samples per pixel "), "{said}");
    assert!(place.read("a.png") == place.rendered("b.png", "--size 60x40 --spp 32"));
}

#[test]
fn parts_need_files_and_fixed_samples() {
    let place = Place::new();
    for (line, expected) in [
        ("render ball.ray -o - --resume", "use -o FILE"),
        ("render ball.ray -o - --shard 0/2", "use -o FILE"),
        ("render ball.ray -o a.bmp --shard 2/2", "expected K/N"),
        (
            "render ball.ray -o a.bmp --shard 0/2 --time 1s",
            "use --spp",
        ),
        (
            "render ball.ray -o a.bmp --shard 0/2 --denoise",
            "leave out --shard",
        ),
        (
            "render ball.ray -o a.bmp --resume --denoise",
            "leave out --resume",
        ),
        (
            "render ball.ray -o a.bmp --shard 0/2 --aov cost --noise 0.1",
            "use --noise 0",
        ),
        ("merge", "required"),
        ("merge a.part", "--output"),
        ("merge a.part -o a.bmp --missing", "cannot be used with"),
        ("merge a.part -o a", "cannot tell the format"),
    ] {
        let said = place.stderr(line, 2);
        assert!(said.contains(expected), "{line}: {said}");
    }
    assert_eq!(place.names(), ["ball.ray"]);
}

/// Statistics and parts that have the place of the picture, or of one another.
#[test]
fn outputs_do_not_overwrite_one_another() {
    use std::os::unix::fs::symlink;
    let place = Place::new();
    place.write("s.png", "old");
    fs::hard_link(place.at("s.png"), place.at("hard.json")).expect("it is new");
    symlink("s.png", place.at("link.json")).expect("it is new");
    symlink("none.png", place.at("dangling.json")).expect("it is new");
    let before = place.names();
    for (line, reason) in [
        (
            "-o s.png --stats s.png",
            "cannot write s.png: it is the picture",
        ),
        ("-o s.png --stats ./s.png", "it is the picture"),
        ("-o s.png --stats hard.json", "it is the picture"),
        ("-o s.png --stats link.json", "it is the picture"),
        ("-o none.png --stats ./none.png", "it is the picture"),
        ("-o none.png --stats dangling.json", "it is the picture"),
        ("-o s.png --resume --stats s.part", "it is the part file"),
        (
            "-o s.png --shard 1/2 --stats s.1-2.part",
            "it is the part file",
        ),
        (
            "-o none.part --format png --resume",
            "cannot write none.part: it is the part file",
        ),
        (
            "-o /dev/null --format png --resume",
            "keep a part file beside the picture: use -o FILE",
        ),
    ] {
        let said = place.stderr(&format!("render ball.ray {line}"), 2);
        assert!(said.contains(reason), "{line}: {said}");
    }
    assert_eq!(place.names(), before);
    assert_eq!(place.read("s.png"), b"old");
    place.stderr("render ball.ray -o s.png --stats s.json --resume", 0);
}

/// Begins to render, and waits until the part file is longer than `length`, or all is done.
pub(super) fn begun(place: &Place, line: &str, part: &Path, length: u64) -> std::process::Child {
    let mut child = place.command(line);
    let mut child = child.stderr(Stdio::piped()).spawn().expect("it starts");
    grown(&mut child, part, length);
    child
}

/// Waits until the part file of a render is longer than `length`, or all is done.
fn grown(child: &mut std::process::Child, part: &Path, length: u64) {
    let is_longer = || fs::metadata(part).is_ok_and(|file| length < file.len());
    while !is_longer() && child.try_wait().expect("it is a child").is_none() {
        std::thread::yield_now();
    }
}

pub(super) fn send(signal: &str, child: &std::process::Child) {
    let mut kill = Command::new("kill");
    kill.args([&format!("-{signal}"), &child.id().to_string()]);
    // It may have ended.
    let _ = kill.stderr(Stdio::null()).status().expect("it is sent");
}

/// Whether the programs that are run are told if the terminal hangs up; under nohup they are not.
fn ends_by_hang_up() -> bool {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let ignored = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let ignored = ignored.and_then(|signals| u64::from_str_radix(signals.trim(), 16).ok());
    ignored.is_some_and(|signals| signals & 1 == 0)
}

#[test]
fn signals_keep_what_was_traced() {
    let place = Place::new();
    let part = place.at("a.part");
    let line = format!("render {SCENE} -o a.bmp --size 64x64 --spp 65536 --resume");
    let signals = [("TERM", 75), ("USR1", 75), ("INT", 130)];
    let hangs_up = ends_by_hang_up().then_some(("HUP", 75));
    for (signal, code) in signals.into_iter().chain(hangs_up) {
        let child = begun(&place, &line, &part, 0);
        send(signal, &child);
        let output = child.wait_with_output().expect("it ends");
        assert_eq!(output.status.code(), Some(code));
        let said = String::from_utf8_lossy(&output.stderr);
        let kept = format!("error: stopped by SIG{signal}; ");
        assert!(said.starts_with(&kept), "{said}");
        assert_eq!(place.names(), ["a.part", "ball.ray"]);
        fs::remove_file(&part).expect("it is there");
    }
    // Without a part file, a signal ends the process.
    let line = format!("render {SCENE} -o b.bmp --size 64x64 --spp 65536");
    let mut child = place.command(&line).spawn().expect("it starts");
    send("TERM", &child);
    assert_eq!(child.wait().expect("it ends").code(), None);
}

/// As under nohup.
#[test]
fn a_signal_that_is_ignored_stays_so() {
    let place = Place::new();
    let part = place.at("a.part");
    let line = format!("render {SCENE} -o a.bmp --size 64x64 --spp 65536 --resume");
    let script = format!("trap '' HUP; exec {BINARY} {line}");
    let mut shell = Command::new("bash");
    let shell = shell.args(["-c", &script]).current_dir(place.at("."));
    let mut child = shell.stderr(Stdio::piped()).spawn().expect("it starts");
    grown(&mut child, &part, 0);
    send("HUP", &child);
    let length = fs::metadata(&part).expect("it is there").len();
    grown(&mut child, &part, length);
    send("TERM", &child);
    let output = child.wait_with_output().expect("it ends");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(said.starts_with("error: stopped by SIGTERM; "), "{said}");
}

/// Killed after each block, and stopped within blocks.
#[test]
fn an_interrupted_picture_is_continued_to_the_same_bytes() {
    let place = Place::new();
    let options = "--size 64x96 --spp 50";
    let whole = place.rendered("whole.bmp", options);
    let part = place.at("a.part");
    let line = format!("render {SCENE} -o a.bmp {options} --threads 1 --resume");
    for signal in ["KILL", "TERM"].into_iter().cycle() {
        let length = fs::metadata(&part).map_or(0, |file| file.len());
        let child = begun(&place, &line, &part, length);
        send(signal, &child);
        child.wait_with_output().expect("it ends");
        if place.at("a.bmp").exists() {
            break;
        }
    }
    assert!(place.read("a.bmp") == whole);
}

/// What the interface keeps of the same film, wherever it is further.
#[test]
fn a_render_continues_a_trace() {
    let place = Place::new();
    let options = "--size 60x40 --resume --spp";
    place.rendered("a.png", &format!("{options} 4"));
    let part = place.read("a.part");
    let header = String::from_utf8_lossy(&part);
    let (_, lines) = header.split_once('\n').expect("a header");
    let (lines, _) = lines.split_once("shard ").expect("a header");
    let digest = Digest::of([lines.as_bytes()]);
    let traces = place.at("state/halflight/traces");
    fs::create_dir_all(&traces).expect("the folder is new");
    fs::rename(
        place.at("a.part"),
        traces.join(format!("{}.part", &digest[..32])),
    )
    .expect("it is there");
    let said = place.stderr(&format!("render {SCENE} -o a.png {options} 16"), 0);
    let continues = "a.part: continues 4 blocks of the interface's full-size trace\n";
    assert_eq!(said, format!("note: {continues}"));
    assert!(place.read("a.png") == place.rendered("b.png", "--size 60x40 --spp 16"));
    // Neither one that is behind nor one that has more samples than are asked for.
    for (picture, spp) in [("a.png", 16), ("c.png", 2)] {
        let said = place.stderr(&format!("render {SCENE} -o {picture} {options} {spp}"), 0);
        assert_eq!(said, "");
    }
    // Another film, and a picture of what is known from tracing this one.
    for (picture, other) in [("d.png", "--seed 1"), ("e.png", "--aov noise")] {
        let line = format!("render {SCENE} -o {picture} {options} 4 {other}");
        assert_eq!(place.stderr(&line, 0), "");
    }
    // What is wrong with it is said, and the picture is traced.
    let trace = traces.join(format!("{}.part", &digest[..32]));
    fs::write(trace, "halflight part 2\ndamaged").expect("it is ours");
    let said = place.stderr(&format!("render {SCENE} -o f.png {options} 4"), 0);
    assert!(said.starts_with("note: f.part: the full-size trace of an earlier run was damaged"));
}

/// All blocks stop long before the most samples there are.
#[test]
fn a_part_that_stopped_early_is_continued_with_fewer_samples_than_were_allowed() {
    let place = Place::new();
    let render = |options: &str| {
        let options = format!("--size 40x30 --noise 0.3 --resume {options}");
        place.rendered("a.png", &options)
    };
    let limited = render("--time 60s");
    assert!(limited == render("--spp 4096"));
    assert!(limited == place.rendered("b.png", "--size 40x30 --noise 0.3"));
}

/// A part without blocks of a picture of this size.
fn declared(size: &str) -> String {
    let digest = "0".repeat(64);
    let header = format!(
        "halflight part 2\nversion 0.1.0\nscene {digest}\nview own\nlayers none\nsize {size}\n\
         region none\ndepth 8\nseed 0\naov none\nintegrator whitted\nfilter box\n\
         transfer linear\nexposure 0\nfalloff none\ngloss none\nshard 0/1\n"
    );
    let crc = crc32fast::hash(header.as_bytes());
    format!("{header}crc {crc:08x}\n")
}

/// Memory is taken for the blocks that there are, not for those that a header announces.
#[test]
#[cfg(target_os = "linux")]
fn a_part_takes_no_memory_for_what_it_declares() {
    let place = Place::new();
    for (size, said) in [
        (
            "16384x16384",
            "incomplete: 262144 of 262144 blocks are missing",
        ),
        (
            "8388608x32",
            "incomplete: 262144 of 262144 blocks are missing",
        ),
        ("16384x16385", "big.part is not a part file"),
        ("4294967295x4294967295", "big.part is not a part file"),
    ] {
        place.write("big.part", declared(size));
        for line in ["merge big.part -o a.png", "merge big.part --missing"] {
            let output = in_shell(&place, "ulimit -v 400000", line);
            let stderr = String::from_utf8_lossy(&output.stderr);
            let is_listed = line.ends_with("--missing") && said.starts_with("incomplete");
            if is_listed {
                assert_eq!(output.stdout, b"0\n", "{stderr}");
            } else {
                assert_eq!(output.status.code(), Some(3), "{stderr}");
                assert!(stderr.contains(said), "{size}: {stderr}");
            }
        }
    }
}

/// A link that leads nowhere cannot be continued, whatever the option.
#[test]
fn a_dangling_link_is_no_part_to_continue() {
    let place = Place::new();
    std::os::unix::fs::symlink("none/a.part", place.at("a.part")).expect("a link");
    let said = "error: a.part: it is a dangling symbolic link; delete it\n";
    for options in ["--resume", "--shard 0/1"] {
        let line = format!("render ball.ray -o a.png --spp 1 {options}");
        assert_eq!(place.stderr(&line, 73), said);
    }
}
