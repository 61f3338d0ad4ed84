//! What pictures say about themselves, and layers.

use exr::prelude::{FlatSamples, read_all_data_from_file};

use super::*;

impl Place {
    /// Runs `show`; returns its exit code and what it printed.
    fn shown(&self, arguments: &str) -> (Option<i32>, String) {
        let output = self.run(&format!("show {arguments}"));
        let said = String::from_utf8(output.stdout).expect("UTF-8");
        (output.status.code(), said)
    }
}

#[test]
fn a_picture_says_how_to_render_it_again() {
    let place = Place::new();
    for (picture, options) in [
        ("a.png", "--size 40x30 --spp 3 --depth 2 --seed 7"),
        (
            "a.exr",
            "--size 40x30 --spp 2 --integrator path --transfer srgb --exposure -0.5 \
             --filter blackman-harris --layers depth,normal",
        ),
        ("b.exr", "--aov normal --region 3,1,4,5 --spp 2"),
        ("c.png", "--size 40x30 --spp 4 --integrator path --denoise"),
    ] {
        place.stderr(&format!("render ball.ray -o {picture} {options}"), 0);
        let first = place.read(picture);
        let (code, said) = place.shown(&format!("{picture} ball.ray"));
        assert_eq!(code, Some(0));
        assert!(
            said.ends_with("ball.ray is the scene of this picture\n"),
            "{said}"
        );
        let again = said
            .lines()
            .find_map(|line| line.strip_prefix("again       halflight "));
        let again = again
            .expect("the command")
            .replace(picture, &format!("2{picture}"));
        place.stderr(&again, 0);
        assert!(place.read(&format!("2{picture}")) == first, "{again}");
    }
    // The comment is not in the picture, but in the text.
    place.write("ball.ray", format!("{BALL}// a comment\n"));
    let (code, said) = place.shown("a.png ball.ray");
    assert_eq!(code, Some(1));
    assert!(
        said.contains("ball.ray is not the scene of this picture: "),
        "{said}"
    );
    assert!(!said.contains("again"), "{said}");
}

/// Names that came from elsewhere may be pasted into a shell.
#[test]
fn the_command_is_safe_in_a_shell() {
    let place = Place::new();
    place.stderr("render ball.ray -o a.png --size 8x6 --spp 1", 0);
    let again = |arguments: &[&str]| {
        let mut command = place.command("show");
        let output = command.args(arguments).output().expect("it runs");
        assert_eq!(output.status.code(), Some(0), "{output:?}");
        let said = String::from_utf8(output.stdout).expect("UTF-8");
        let line = said
            .lines()
            .find_map(|line| line.strip_prefix("again       halflight "));
        let (command, _) = line
            .expect("the command")
            .split_once(" --size")
            .expect("a size");
        command.to_owned()
    };
    for (picture, expected) in [
        ("a;touch x;#.png", "render SCENE -o 'a;touch x;#.png'"),
        ("$(touch x).png", "render SCENE -o '$(touch x).png'"),
        ("a\ntouch x\n.png", "render SCENE -o PICTURE"),
        ("\x1b[31m.png", "render SCENE -o PICTURE"),
        ("a.other", "render SCENE -o PICTURE"),
    ] {
        place.write(picture, place.read("a.png"));
        assert_eq!(again(&[picture]), expected);
    }
    place.write("-a.png", place.read("a.png"));
    place.write("my `ball`.ray", BALL);
    assert_eq!(
        again(&["--assets", ".", "--", "-a.png", "my `ball`.ray"]),
        "render 'my `ball`.ray' -o ./-a.png --assets ."
    );
}

/// A PNG of one pixel with this text in it.
pub(super) fn forged(text: &str) -> Vec<u8> {
    with_text("halflight", text)
}

fn with_text(keyword: &str, text: &str) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 1, 1);
    encoder
        .add_text_chunk(keyword.to_owned(), text.to_owned())
        .expect("a text");
    let mut writer = encoder.write_header().expect("a header");
    writer.write_image_data(&[0]).expect("a pixel");
    writer.finish().expect("an end");
    bytes
}

/// Programs that rewrite a PNG put texts where they like.
#[test]
fn the_origin_is_found_after_the_pixels_too() {
    let place = Place::new();
    place.stderr("render ball.ray -o a.png --spp 1", 0);
    let png = place.read("a.png");
    let (mut rest, mut chunks) = (&png[8..], Vec::new());
    while let Some(length) = rest.first_chunk() {
        let (chunk, others) = rest.split_at(12 + u32::from_be_bytes(*length) as usize);
        chunks.push(chunk);
        rest = others;
    }
    chunks.sort_by_key(|chunk| match &chunk[4..8] {
        b"tEXt" => 1,
        b"IEND" => 2,
        _ => 0,
    });
    let moved = [&png[..8], &chunks.concat()].concat();
    assert_ne!(moved, png);
    place.write("b.png", moved);
    let (code, said) = place.shown("b.png");
    let (_, before) = place.shown("a.png");
    assert_eq!((code, said), (Some(0), before.replace("a.png", "b.png")));
}

#[test]
fn forged_origins_control_no_terminal() {
    let place = Place::new();
    let origin = "view own\nlayers none\nsize 8x6\nregion none\ndepth 8\nseed 0\naov none\n\
                  integrator whitted\nfilter box\ntransfer linear\nexposure 0\n\
                  falloff none\ngloss none\nspp 1\n";
    place.write(
        "a.png",
        forged(&format!("version 9\x1b[31m\nscene \x1b]0;x\x07\n{origin}")),
    );
    let (code, said) = place.shown("a.png");
    assert_eq!(code, Some(0), "{said}");
    assert!(
        said.starts_with("version     9\\u{1b}[31m\nscene       \\u{1b}]0;x\\u{7}\n"),
        "{said}"
    );
    place.write(
        "b.png",
        forged(&format!("version 1\nscene 0\nnew 1\n{origin}")),
    );
    let said = place.stderr("show b.png", 0);
    assert_eq!(said, "note: b.png: problems in its record: new 1\n");
    let (_, shown) = place.shown("b.png");
    assert!(shown.ends_with("spp         1\n"), "{shown}");
}

#[test]
fn another_view_is_said_and_rendered_again() {
    let place = Place::new();
    let line = "render ball.ray --size 40x30 --spp 2";
    let view = "--view";
    let with_view = |picture: &str, parts: &str| {
        let mut command = place.command(&format!("{line} -o {picture}"));
        let output = command.args([view, parts]).output().expect("it runs");
        assert_eq!(output.status.code(), Some(0), "{output:?}");
        place.read(picture)
    };
    let turned = with_view("a.png", "fov 30 eye 5 0.1 0");
    place.stderr(&format!("{line} -o own.png"), 0);
    assert!(turned != place.read("own.png"));
    let (_, said) = place.shown("a.png");
    assert!(said.contains("view        eye 5 0.1 0 fov 30\n"), "{said}");
    assert!(said.contains(" --view 'eye 5 0.1 0 fov 30'"), "{said}");
    assert!(with_view("b.png", "eye 5 0.1 0 fov 30") == turned);
    // Frames of a turntable say theirs.
    place.stderr(&format!("{line} -o t%d.png --turntable 4"), 0);
    let (_, said) = place.shown("t1.png");
    let view = said
        .lines()
        .find_map(|line| line.strip_prefix("view        "));
    assert!(with_view("c.png", view.expect("a view")) == place.read("t1.png"));
    let mut command = place.command(line);
    let refused = command.args(["-o", "d.png", "--view", "fov 200"]).output();
    let said = String::from_utf8(refused.expect("it runs").stderr).expect("UTF-8");
    assert!(
        said.contains("`fov` must be above 0 and below 180"),
        "{said}"
    );
}

#[test]
fn merged_and_resumed_pictures_say_the_same() {
    let place = Place::new();
    let line = "render ball.ray --size 70x40 --spp 2";
    place.stderr(&format!("{line} -o whole.png"), 0);
    for shard in 0..2 {
        place.stderr(&format!("{line} -o a.png --shard {shard}/2"), 0);
    }
    place.stderr("merge a.0-2.part a.1-2.part -o a.png", 0);
    place.stderr(&format!("{line} -o b.png --resume"), 0);
    for picture in ["a.png", "b.png"] {
        assert!(place.read(picture) == place.read("whole.png"), "{picture}");
    }
}

/// Where a file is found does not matter, but what is in it.
#[test]
fn the_digest_is_of_the_files_that_were_read() {
    let place = Place::new();
    place.write("a.dat", TEXTURED);
    let scene = |options: &str| {
        place.stderr(&format!("render a.dat -o a.png --size 8x6 {options}"), 0);
        let (_, said) = place.shown("a.png");
        let line = said.lines().find(|line| line.starts_with("scene"));
        line.expect("the digest").to_owned()
    };
    let missing = scene("");
    place.write("skin.ppm", SKIN);
    let beside = scene("");
    fs::create_dir(place.at("there")).expect("it is new");
    fs::rename(place.at("skin.ppm"), place.at("there/skin.ppm")).expect("it is moved");
    assert_eq!(scene("--assets there"), beside);
    assert_ne!(missing, beside);
    // Other machines might find it.
    for (options, needed_by) in [
        ("-o b.png --shard 0/2", "--shard needs"),
        ("-o b.png --resume", "--resume needs"),
        ("-o b%d.png --turntable 2", "a sequence needs"),
    ] {
        let said = place.stderr(&format!("render a.dat {options}"), 65);
        let expected = format!("nothing was rendered: {needed_by} every file of the scene\n");
        assert!(said.ends_with(&expected), "{said}");
    }
}

/// The interface and the command line write the same file.
#[test]
fn an_export_is_the_file_of_a_render() {
    let place = Place::new();
    place.write("a.dat", TEXTURED);
    place.write("skin.ppm", SKIN);
    for picture in ["a.png", "a.exr"] {
        place.write(
            "export.keys",
            format!(": \"export ui-{picture} 40x30 4\" Enter wait"),
        );
        place.stderr(
            "a.dat --screen 80x24 --keys export.keys --dump-frame s.txt",
            0,
        );
        place.stderr(
            &format!("render a.dat -o {picture} --size 40x30 --spp 4"),
            0,
        );
        assert!(
            place.read(&format!("ui-{picture}")) == place.read(picture),
            "{picture}"
        );
    }
    // From another side, the file says the view.
    let view = "eye 1 2 3 fov 20";
    let mut command = place.command("render a.dat -o v.png --size 40x30 --spp 4 --view");
    let output = command.arg(view).output().expect("it runs");
    assert_eq!(output.status.code(), Some(0));
    let (_, said) = place.shown("v.png a.dat");
    assert!(
        said.contains(view) && said.contains("is the scene"),
        "{said}"
    );
}

#[test]
fn pictures_that_say_nothing_are_refused() {
    let place = Place::new();
    place.stderr("render ball.ray -o a.bmp --spp 1", 0);
    place.write("text.png", "a text");
    place.write("silent.png", with_text("Comment", "size 1x1"));
    place.write("empty.png", with_text("halflight", "\n\n"));
    place.write("bad.png", b"\x89PNG\r\n\x1a\nnothing");
    for (picture, code, expected) in [
        ("a.bmp", 65, "a.bmp is not a PNG or EXR file"),
        ("text.png", 65, "text.png is not a PNG or EXR file"),
        ("silent.png", 65, "silent.png has no Halflight metadata\n"),
        ("empty.png", 65, "empty.png has no Halflight metadata\n"),
        ("bad.png", 65, "bad.png is not a valid picture: "),
        ("none.png", 66, "none.png: no such file"),
    ] {
        let said = place.stderr(&format!("show {picture}"), code);
        assert!(said.contains(expected), "{said}");
    }
}

#[test]
fn layers_are_the_aovs_that_are_rendered_alone() {
    let place = Place::new();
    let options = "--size 20x15 --spp 4";
    let layers = "depth,normal,object,albedo,samples,uv";
    place.stderr(
        &format!("render ball.ray -o a.exr {options} --layers {layers}"),
        0,
    );
    place.stderr(
        &format!("render ball.ray -o f%d.exr {options} --layers {layers} --turntable 2"),
        0,
    );
    place.stderr(
        &format!("render ball.ray -o r.exr {options} --layers {layers} --resume"),
        0,
    );
    assert!(
        place.read("f0.exr") == place.read("a.exr") && place.read("r.exr") == place.read("a.exr")
    );
    // The values of each channel, by its name.
    let channels = |picture: &str| {
        let image = read_all_data_from_file(place.at(picture)).expect("an EXR");
        let channels = image
            .layer_data
            .into_iter()
            .flat_map(|layer| layer.channel_data.list);
        let values = channels.map(|channel| {
            let values: Vec<_> = match channel.sample_data {
                exr::prelude::Levels::Singular(FlatSamples::F32(values)) => values,
                other => panic!("{other:?}"),
            };
            (channel.name.to_string(), values)
        });
        values.collect::<std::collections::BTreeMap<_, _>>()
    };
    let layered = channels("a.exr");
    let names: Vec<_> = layered.keys().map(String::as_str).collect();
    let expected = "B G R albedo.B albedo.G albedo.R depth.Z normal.X normal.Y normal.Z object.V \
                    samples.V uv.U uv.V";
    assert_eq!(names.join(" "), expected);
    place.stderr(&format!("render ball.ray -o light.exr {options}"), 0);
    assert_eq!(channels("light.exr")["R"], layered["R"]);
    for aov in layers.split(',') {
        place.stderr(
            &format!("render ball.ray -o {aov}.exr {options} --aov {aov}"),
            0,
        );
        let alone = channels(&format!("{aov}.exr"));
        for (name, values) in layered.iter().filter(|(name, _)| name.starts_with(aov)) {
            let of_alone = match name.rsplit_once('.').expect("a layer").1 {
                "Z" if aov == "depth" => "R",
                "X" | "U" | "V" if name != "uv.V" => "R",
                "Y" | "V" => "G",
                "Z" => "B",
                rgb => rgb,
            };
            assert_eq!(&alone[of_alone], values, "{name}");
        }
    }
    for (line, expected) in [
        (
            "render ball.ray -o a.png --layers depth",
            "--layers needs a .exr",
        ),
        (
            "render ball.ray -o a.exr --layers depth,depth",
            "names depth twice",
        ),
        (
            "render ball.ray -o a.exr --layers depth --shard 0/2",
            "cannot be sharded",
        ),
        (
            "render ball.ray -o a.exr --layers depth --aov uv",
            "cannot be used with",
        ),
    ] {
        let said = place.stderr(line, 2);
        assert!(said.contains(expected), "{said}");
    }
}
