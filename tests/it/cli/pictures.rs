//! Rendered pictures: bytes, formats and output files.

use super::*;

#[test]
fn a_picture_file_that_cannot_be_created_exits_with_73_before_tracing() {
    let place = Place::new();
    fs::create_dir(place.at("dir.bmp")).expect("created");
    for output in ["none/a.bmp", "dir.bmp", "ball.ray/a.bmp"] {
        let stderr = place.stderr(&format!("render ball.ray -o {output}"), 73);
        assert!(stderr.contains(output), "{stderr}");
    }
    let stderr = place.stderr("render ball.ray -o none/a.bmp", 73);
    assert_eq!(stderr, "error: none/a.bmp: no such folder\n");
    assert_eq!(place.names(), ["ball.ray", "dir.bmp"]);
}

#[test]
fn a_picture_never_replaces_its_scene() {
    let place = Place::new();
    fs::hard_link(place.at("ball.ray"), place.at("hard.bmp")).expect("linked");
    std::os::unix::fs::symlink("ball.ray", place.at("soft.bmp")).expect("linked");
    for output in ["ball.ray", "./ball.ray", "hard.bmp", "soft.bmp"] {
        let stderr = place.stderr(&format!("render ball.ray -o {output} --format bmp"), 2);
        assert!(
            stderr.contains(output) && stderr.contains("is the scene itself"),
            "{stderr}"
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
        let stderr = place.stderr(&format!("render a.dat --spp 1 -o {output}"), 2);
        let reason = "the scene uses it; name another file";
        assert_eq!(
            stderr,
            format!("error: cannot overwrite {output}: {reason}\n")
        );
        assert_eq!(place.read("skin.ppm"), SKIN.as_bytes());
    }
    for line in [
        "render a.dat -o a.bmp --stats skin.ppm",
        "render a.dat -o a.bmp --stats a.dat",
        "render a.dat -o skin.ppm --format gif --turntable 2",
        "render a.dat -o sk%d.ppm --turntable 2",
        "merge a.part -o a.part --format bmp",
    ] {
        place.write("sk0.ppm", SKIN);
        place.write("a.part", "a part");
        let textured = TEXTURED.replace("skin.ppm", "sk0.ppm");
        place.write(
            "a.dat",
            if line.contains("sk%d") {
                &textured
            } else {
                TEXTURED
            },
        );
        let stderr = place.stderr(line, 2);
        assert!(stderr.contains("cannot overwrite "), "{line}: {stderr}");
        assert_eq!(place.read("skin.ppm"), SKIN.as_bytes());
    }
}

#[test]
fn a_picture_is_written_to_a_named_pipe_with_a_reader() {
    use rustix::fs::{CWD, FileType, Mode, mknodat};
    let place = Place::new();
    mknodat(CWD, place.at("pipe"), FileType::Fifo, Mode::RWXU, 0).expect("a pipe");
    let stderr = place.stderr("render ball.ray -o pipe --format ppm", 1);
    assert_eq!(stderr, "error: pipe: no process is reading this pipe\n");
    let pipe = place.at("pipe");
    let reader = std::thread::spawn(move || fs::read(pipe));
    assert_eq!(place.stderr("render ball.ray -o pipe --format ppm", 0), "");
    let read = reader.join().expect("no panic").expect("read");
    assert!(read.starts_with(b"P6\n8 6\n255\n"));
    place.stderr("render ball.ray -o /dev/null --format ppm", 0);
    assert_eq!(place.names(), ["ball.ray", "pipe"]);
}

#[test]
fn standard_output_receives_the_ppm() {
    let place = Place::new();
    let output = place.run("render ball.ray -o - --format ppm --spp 1");
    assert_eq!(output.status.code(), Some(0));
    let header = b"P6\n8 6\n255\n";
    let (head, pixels) = output.stdout.split_at(header.len());
    assert_eq!(head, header);
    // At unit distance, the ball's outline has radius tan(asin(1/5)) = 0.2041 and half the
    // picture's height is tan(20°) = 0.3640: a circle of radius 1.68 pixels at the centre.
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
fn threads_and_destination_do_not_change_the_bytes() {
    let place = Place::new();
    let picture = "render ball.ray --spp 4 --size 16x9";
    assert_eq!(
        place.stderr(&format!("{picture} -o a.bmp --threads 1"), 0),
        ""
    );
    let expected = place.read("a.bmp");
    assert_eq!(expected.len(), 54 + 16 * 9 * 3);
    for threads in ["2", "8"] {
        place.stderr(&format!("{picture} -o b.bmp --threads {threads}"), 0);
        assert_eq!(place.read("b.bmp"), expected, "{threads} threads");
    }
    assert_eq!(place.run(&format!("{picture} -o -")).stdout, expected);
    place.stderr(&format!("{picture} -o named.wrongly --format bmp"), 0);
    assert_eq!(place.read("named.wrongly"), expected);
    assert_eq!(
        place.names(),
        ["a.bmp", "b.bmp", "ball.ray", "named.wrongly"]
    );
}

#[test]
fn vector_instructions_do_not_change_the_bytes() {
    const SCENES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes");
    let place = Place::new();
    for scene in ["default.ray", "courtyard.xml", "lamp.xml", "pool.dat"] {
        let line = format!("render {SCENES}/{scene} --size 40x30 --spp 2");
        let with = |cap: &str, options: &str| {
            let mut command = place.command(&format!("{line} {options}"));
            let output = command.env("HALFLIGHT_CPU", cap).output().expect("it runs");
            assert_eq!(output.status.code(), Some(0), "{output:?}");
        };
        with("", "-o best.png");
        for cap in ["sse2", "avx2", "avx512"] {
            with(cap, "-o capped.png");
            assert!(
                place.read("capped.png") == place.read("best.png"),
                "{scene} {cap}"
            );
            // Shards of one picture may be traced on machines of all levels.
            with(cap, "-o a.png --shard 1/2");
            with("", "-o a.png --shard 0/2");
            place.stderr("merge a.0-2.part a.1-2.part -o a.png", 0);
            assert!(
                place.read("a.png") == place.read("best.png"),
                "{scene} {cap}"
            );
            for part in ["a.0-2.part", "a.1-2.part"] {
                fs::remove_file(place.at(part)).expect("it is there");
            }
        }
    }
}

#[test]
fn a_picture_has_the_requested_format() {
    let place = Place::new();
    for (name, magic) in [
        ("a.tif", &b"II*\0"[..]),
        ("a.exr", b"\x76\x2f\x31\x01"),
        ("a.hdr", b"#?RADIANCE\n"),
        ("a.gif", b"GIF89a"),
        ("a.jpg", b"\xFF\xD8\xFF"),
        ("a.png", b"\x89PNG"),
    ] {
        place.stderr(&format!("render ball.ray -o {name} --spp 1"), 0);
        assert!(place.read(name).starts_with(magic), "{name}");
        let format = name.trim_start_matches("a.");
        let streamed = place.run(&format!("render ball.ray -o - --spp 1 --format {format}"));
        assert_eq!(streamed.stdout, place.read(name), "{name}");
    }
}

/// The rows of a PPM of this size, after its header.
fn rows(ppm: &[u8], (width, height): (usize, usize)) -> Vec<&[u8]> {
    let header = format!("P6\n{width} {height}\n255\n");
    let pixels = ppm.strip_prefix(header.as_bytes()).expect("the size");
    pixels.chunks(3 * width).collect()
}

#[test]
fn a_region_is_a_part_of_the_picture() {
    let place = Place::new();
    let whole = place.run("render ball.ray -o - --format ppm --size 24x18");
    let part = place.run("render ball.ray -o - --format ppm --size 24x18 --region 7,5,9,10");
    let expected: Vec<_> = rows(&whole.stdout, (24, 18))[5..15]
        .iter()
        .map(|row| &row[3 * 7..3 * 16])
        .collect();
    assert_eq!(rows(&part.stdout, (9, 10)), expected);
    for (region, reason) in [
        ("5,5,9,0", "region 5,5,9,0 is empty"),
        (
            "0,0,9,6",
            "region 0,0,9,6 reaches outside the picture, which is 8x6",
        ),
    ] {
        let stderr = place.stderr(&format!("render ball.ray -o a.bmp --region {region}"), 2);
        let message = format!("error: --region: {reason}");
        assert!(stderr.starts_with(&message), "{stderr}");
    }
    let stderr = place.stderr("render ball.ray -o a.bmp --region 1,2,3", 2);
    assert!(stderr.contains("such as 100,50,64,48"), "{stderr}");
    place.stderr("render ball.ray -o a.ppm --size 24x18 --region 7,5,9,10", 0);
    let compared = place.run("compare ball.ray a.ppm --size 24x18 --region 7,5,9,10");
    assert_eq!(compared.status.code(), Some(0));
}

/// The picture is the one with the samples that the time permitted.
#[test]
fn a_time_ends_with_a_whole_pass() {
    let place = Place::new();
    let stderr = place.stderr("render ball.ray -o a.ppm --time 20ms", 0);
    let samples = stderr.strip_prefix("note: ").expect("a note");
    let spp = samples.split(' ').next().expect("a number");
    let count: u32 = spp.parse().expect("a number");
    assert!(count.is_power_of_two(), "{stderr}");
    place.stderr(&format!("render ball.ray -o b.ppm --spp {spp}"), 0);
    assert_eq!(place.read("a.ppm"), place.read("b.ppm"));
    let stderr = place.stderr("render ball.ray -o a.ppm --time 1h --spp 2", 0);
    assert!(stderr.starts_with("note: 2 samples per pixel"), "{stderr}");
}

#[test]
fn noise_is_reduced_where_there_is_any() {
    let place = Place::new();
    let lamp = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/lamp.xml");
    let rendered = |options: &str| {
        let line = format!("render {lamp} --size 24x16 -o a.ppm {options}");
        place.stderr(&line, 0);
        place.read("a.ppm")
    };
    for noiseless in ["--spp 1", "--spp 1 --exposure 1.3"] {
        let noiseless = format!("{noiseless} --integrator whitted");
        assert!(rendered(&noiseless) == rendered(&format!("{noiseless} --denoise")));
    }
    let noisy = rendered("--spp 4 --integrator path");
    let denoised = rendered("--spp 4 --integrator path --denoise --threads 1");
    assert!(noisy != denoised);
    assert!(denoised == rendered("--spp 4 --integrator path --denoise --threads 2"));
    let frames = format!(
        "render {lamp} --size 24x16 -o b%d.ppm --turntable 2 --spp 4 --integrator path --denoise \
         --shard 0/2"
    );
    place.stderr(&frames, 0);
    assert!(denoised == place.read("b0.ppm"));
    let said = place.stderr("render ball.ray -o a.ppm --aov depth --denoise", 2);
    assert!(said.contains("not with --aov depth"), "{said}");
}

#[test]
fn an_exposure_of_0_changes_no_byte_and_one_stop_doubles() {
    let place = Place::new();
    let rendered = |options: &str, output: &str| {
        place.run(&format!(
            "render ball.ray --size 24x16 --spp 2 {options} -o {output}"
        ));
        place.read(output)
    };
    for output in ["a.ppm", "a.hdr"] {
        let plain = rendered("", output);
        assert_eq!(plain, rendered("--exposure 0", output), "{output}");
        assert_ne!(plain, rendered("--exposure -1", output), "{output}");
        // Sides have no brightness.
        let sides = rendered("--aov side", output);
        assert_eq!(sides, rendered("--aov side --exposure 1", output));
    }
    let size = (24, 16);
    let (plain, doubled) = (rendered("", "a.ppm"), rendered("--exposure 1", "b.ppm"));
    let pairs = rows(&plain, size).concat().into_iter();
    let pairs = pairs.zip(rows(&doubled, size).concat());
    for (level, double) in pairs {
        let exact = (2 * i32::from(level)).min(255);
        assert!((i32::from(double) - exact).abs() <= 1, "{level} {double}");
    }
    for stops in ["101", "nan", "bright"] {
        let reason = place.stderr(&format!("render ball.ray --exposure {stops} -o a.ppm"), 2);
        assert!(reason.contains("a number from -100 to 100"), "{reason}");
    }
}

#[test]
fn every_aov_is_rendered_to_every_kind_of_picture() {
    let place = Place::new();
    let mirrors = "1 0 1\n1 0 9 9 1 1 1\n2\n\
                   sphere 0 0 0 1  .2 .2 .2 .4 .5 .6 0 0 0 1 .5 0 1\n\
                   sphere 2 0 0 1  .2 .2 .2 .6 .5 .4 0 0 0 1 .5 0 1\n";
    place.write("mirrors.ray", mirrors);
    let mut pictures = std::collections::BTreeSet::new();
    for aov in [
        "depth", "normal", "object", "albedo", "uv", "side", "cost", "samples", "noise",
        "emission", "indirect",
    ] {
        for output in ["a.png", "a.exr"] {
            let ran = place.run(&format!(
                "render mirrors.ray --size 24x16 --spp 4 --aov {aov} -o {output}"
            ));
            assert!(ran.status.success(), "{aov} {output}");
        }
        pictures.insert(place.read("a.png"));
    }
    assert_eq!(pictures.len(), 11, "all are distinct");
}
