use std::time::Duration;

use super::*;
use ::render::Region;
use batch::{Output, Report, Target, Up, Warnings, Work};
use image_file::{ImageFormat, MAX_PIXELS};
use scene::{FalloffRule, Filter, GlossRule, Integrator, MAX_SPP, Rendering, Size, Transfer};
use ui::Theme;
use ui::keymap::Keymap;
use ui::terminal::{Choice, ColourDepth, Mouse};

/// Parses a command line whose words are separated by spaces.
fn parsed(line: &str) -> Result<Command, Stop> {
    parse(line.split(' ').map(OsString::from))
}

fn interface(line: &str) -> ui::Options {
    match parsed(line) {
        Ok(Command::Interface(options, ..)) => options,
        other => panic!("{line}: {other:?}"),
    }
}

fn render(line: &str) -> Render {
    match parsed(line) {
        Ok(Command::Render(render)) => render,
        other => panic!("{line}: {other:?}"),
    }
}

/// Where a picture goes, and in which format.
fn target(render: &Render) -> &Target {
    match &render.work {
        Work::Picture(picture) => &picture.target,
        Work::Sequence(sequence) => panic!("{sequence:?}"),
    }
}

#[test]
fn the_command_line_declaration_is_valid() {
    Cli::command().debug_assert();
}

#[test]
fn omitted_options_have_the_defaults_of_the_interface() {
    assert_eq!(interface("halflight"), ui::Options::default());
    assert_eq!(
        interface("halflight a.ray --poll").poll,
        Some(Duration::from_millis(500))
    );
}

#[test]
fn options_reach_the_interface() {
    let line = "halflight --poll=20 --bandwidth 128 --color 256 --theme light --pixels octant --no-mouse --spp 4 --depth 0 --integrator path --filter gaussian --threads 3 --up z --assets b --assets c a";
    assert_eq!(
        interface(line),
        ui::Options {
            scene: Some("a".into()),
            up: Some(Up::Z),
            poll: Some(Duration::from_millis(20)),
            bandwidth: Some(128_000),
            colour: Some(Choice::Fixed(ColourDepth::Palette256)),
            theme: Some(Theme::Light),
            pixels: Some(ui::Pixels::Octant),
            mouse: Some(Mouse::Off),
            editor: None,
            follow: None,
            rendering: Rendering {
                spp: Some(4),
                depth: Some(0),
                integrator: Some(Integrator::Path),
                filter: Some(Filter::Gaussian),
                ..Rendering::default()
            },
            threads: Some(3),
            assets: vec!["b".into(), "c".into()],
            keymap: Keymap::default(),
            lesson: None,
            rehearsal: None,
        }
    );
    let line = "halflight a --keys k --screen 60x20 --dump-frame b.txt --dump-frame c.png";
    assert_eq!(
        interface(line).rehearsal,
        Some(ui::Rehearsal {
            keys: Some("k".into()),
            screen: (60, 20),
            frames: vec!["b.txt".into(), "c.png".into()],
        })
    );
    assert_eq!(interface("halflight --bandwidth 0 a").bandwidth, Some(0));
    assert_eq!(
        interface("halflight --colour mono a").colour,
        Some(Choice::Fixed(ColourDepth::Mono))
    );
    assert_eq!(interface("halflight ./check").scene, Some("./check".into()));
}

#[test]
fn the_extension_sets_the_format_unless_one_is_given() {
    let cases = [
        ("halflight render a -o b.PNG", ImageFormat::Png),
        ("halflight render a -o b.png --format ppm", ImageFormat::Ppm),
        ("halflight render a -o -", ImageFormat::Bmp),
        ("halflight render a -o - --format png", ImageFormat::Png),
        ("halflight render a -o b.jpg", ImageFormat::Jpeg),
        ("halflight render a -o b --format tif", ImageFormat::Tiff),
        ("halflight render a -o b --format gif", ImageFormat::Gif),
    ];
    for (line, format) in cases {
        assert_eq!(target(&render(line)).format, format, "{line}");
    }
}

#[test]
fn render_options_have_defaults() {
    let default = render("halflight render a.ray -o a.bmp");
    assert_eq!(default.tracing.rendering, Rendering::default());
    assert_eq!(default.tracing.seed, None);
    assert_eq!(default.tracing.size, None);
    assert_eq!((default.tracing.region, default.tracing.time), (None, None));
    assert_eq!(target(&default).output, Output::File("a.bmp".into()));
    let given = render(
        "halflight render a -o - --force --size 3X2 --spp 65536 --seed 7 --integrator whitted --depth 9 --filter blackman-harris --transfer srgb --exposure -1.5 --falloff square --gloss exponent",
    );
    let size = Size {
        width: 3,
        height: 2,
    };
    assert_eq!(
        (given.tracing.size, given.tracing.seed),
        (Some(size), Some(7))
    );
    let asked = Rendering {
        integrator: Some(Integrator::Whitted),
        depth: Some(9),
        spp: Some(65_536),
        filter: Some(Filter::BlackmanHarris),
        transfer: Some(Transfer::Srgb),
        exposure: Some(-1.5),
        falloff: Some(FalloffRule::Square),
        gloss: Some(GlossRule::Exponent),
        ..Rendering::default()
    };
    assert_eq!(given.tracing.rendering, asked);
    assert_eq!(target(&given).output, Output::StdoutTerminal);
    let part = render("halflight render a -o - --region 1,2,3,4 --time 2min");
    assert_eq!(part.tracing.region, Region::parse("1,2,3,4"));
    assert_eq!(part.tracing.time, Some(Duration::from_secs(120)));
}

#[test]
fn what_may_differ_reaches_the_comparison() {
    let compare = |line: &str| match parsed(line) {
        Ok(Command::Compare(compare)) => compare,
        other => panic!("{line}: {other:?}"),
    };
    let default = compare("halflight compare a.bmp b.ray");
    assert_eq!(default.reference, PathBuf::from("a.bmp"));
    assert_eq!(default.submissions, [PathBuf::from("b.ray")]);
    assert_eq!((default.tolerance, default.max_differing), (0, 0));
    assert_eq!((default.report, default.output), (Report::Text, None));
    let given =
        compare("halflight compare a b --tolerance 255 --max-differing 9 --json -o c.png --spp 1");
    assert_eq!((given.tolerance, given.max_differing), (255, 9));
    assert_eq!(given.report, Report::Json);
    assert_eq!(given.output, Some(("c.png".into(), ImageFormat::Png)));
    assert_eq!(given.tracing.rendering.spp, Some(1));
}

#[test]
fn the_pixel_and_the_sample_reach_the_explanation() {
    let explain = |line: &str| match parsed(line) {
        Ok(Command::Explain(explain)) => explain,
        other => panic!("{line}: {other:?}"),
    };
    let default = explain("halflight explain a.ray 7 0");
    assert_eq!((default.pixel, default.sample), ([7, 0], 0));
    assert_eq!(default.report, Report::Text);
    let given = explain("halflight explain a.ray 7 0 --sample 65535 --json --depth 3 --strict");
    assert_eq!((given.sample, given.report), (65_535, Report::Json));
    assert_eq!(given.tracing.rendering.depth, Some(3));
    assert_eq!(given.reading.warnings, Warnings::Refused);
}

#[test]
fn asset_folders_reach_every_command() {
    let folders: Vec<PathBuf> = vec!["b".into(), "c".into()];
    let line = "halflight render a.dat -o a.bmp --up y --assets b --assets c";
    assert_eq!(render(line).reading.assets, folders);
    assert_eq!(render(line).reading.up, Some(Up::Y));
    match parsed("halflight check a.dat --assets b --assets c d.dat") {
        Ok(Command::Check(check)) => {
            assert_eq!(check.reading.assets, folders);
            assert_eq!(check.scenes, [PathBuf::from("a.dat"), "d.dat".into()]);
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn wrong_arguments_are_rejected_with_a_reason() {
    let cases = [
        (
            "halflight a b",
            "unexpected second scene b: only one can be opened; the commands are render, merge, show, \
             compare, explain, convert, bench, check, tutor, completions, man, lsp, samples and doctor",
        ),
        (
            "halflight --color blue a",
            "[possible values: auto, 24, 256, 16, mono]",
        ),
        ("halflight --poll=1 a", "from 10 to 3600000"),
        ("halflight render a", "--output"),
        ("halflight render a -o b.webp", ".bmp, .ppm, .png"),
        ("halflight render a -o b", ".exr or .hdr"),
        ("halflight render a -o b", "Usage: halflight render"),
        (
            "halflight render a -o b.bmp --aov light",
            "depth, normal, object, albedo",
        ),
        (
            "halflight render a -o b.bmp --integrator rays",
            "whitted, path, photon",
        ),
        (
            "halflight --filter tent a",
            "box, gaussian, blackman-harris",
        ),
        ("halflight --integrator rays a", "whitted, path, photon"),
        ("halflight chekc a.ray", "did you mean check?"),
        ("halflight rendr", "did you mean render?"),
        (
            "halflight render a -o - --format webp",
            "[possible values: bmp, ppm, ",
        ),
        ("halflight render a -o b.bmp --size 0x1", "such as 800x600"),
        ("halflight render a -o b.bmp --size 1x", "such as 800x600"),
        ("halflight render a -o b.bmp --size +1x1", "such as 800x600"),
        (
            "halflight render a -o b.bmp --size 1x4294967296",
            "such as 800x600",
        ),
        ("halflight compare a", "<SUBMISSION>..."),
        ("halflight explain a 1", "<Y>"),
        (
            "halflight explain a 1 2 --sample 65536",
            "a whole number from 0 to 65535",
        ),
        (
            "halflight explain a -1 2",
            "a whole number from 0 to 4294967295",
        ),
        ("halflight explain a 1 2 --aov depth", "--aov"),
        ("halflight explain a 1 2 --region 0,0,1,1", "--region"),
        (
            "halflight render a -o b.bmp --region -1,-1,5,5",
            "left column",
        ),
        ("halflight render a -o b.bmp --view -1", "eye"),
        (
            "halflight compare a b --tolerance 256",
            "a whole number from 0 to 255",
        ),
        ("halflight compare a b -o c", ".exr or .hdr"),
        ("halflight bench --runs 0", "from 1 to 1000"),
        ("halflight --bandwidth -1", "from 0 to 4000000"),
        (
            "halflight render a -o b_#.bmp --turntable 0",
            "from 1 to 1000000",
        ),
        (
            "halflight render a -o b_#.bmp --turntable 4294967295",
            "from 1 to 1000000",
        ),
        (
            "halflight render a -o b.bmp --spp 0",
            "a whole number from 1 to 65536",
        ),
        ("halflight render a -o b.bmp --spp 65537", "from 1 to 65536"),
        ("halflight render a -o b.bmp --threads 0", "from 1 to 1024"),
        ("halflight check", "<SCENE>..."),
        ("halflight --dump-frame a.gif", ".txt, .ansi or .png"),
        ("halflight --keys a --screen 0x9", "such as 100x30"),
        ("halflight --screen 80x24", "--keys"),
        ("halflight b \u{1b}[31m", "\\u{1b}[31m"),
    ];
    for (line, reason) in cases {
        let stop = parsed(line).expect_err(line);
        assert_eq!(stop.code, USAGE, "{line}");
        let shown = &stop.text;
        assert!(
            shown.contains(reason) && !shown.contains('\u{1b}'),
            "{line}: {shown}"
        );
    }
}

#[test]
fn help_is_not_an_error() {
    for line in ["halflight --help", "halflight render -h", "halflight -V"] {
        let stop = parsed(line).expect_err("help");
        assert_eq!(stop.code, DONE);
        assert!(stop.text.contains("halflight"));
    }
}

#[test]
fn the_paragraphs_of_help_fill_80_columns() {
    let mut cli = Cli::command();
    cli.build();
    let render = cli.find_subcommand("render").cloned();
    for command in [Some(cli), render] {
        let mut command = command.expect("a command").term_width(80);
        let help = command.render_long_help().to_string();
        let (_, below) = help.split_once("Examples:\n").expect("examples");
        let lines: Vec<_> = below.lines().collect();
        for lines in lines.windows(2) {
            let (line, next) = (lines[0], lines[1]);
            assert!(line.len() <= 80, "{line:?}");
            let is_paragraph = |line: &str| !line.is_empty() && !line.starts_with(' ');
            if is_paragraph(line) && is_paragraph(next) {
                let word = next.split(' ').next().unwrap_or_default();
                assert!(
                    80 <= line.len() + word.len(),
                    "{word:?} fits after {line:?}"
                );
            }
        }
    }
}

#[test]
fn the_help_lists_every_exit_code() {
    let (_, codes) = EXAMPLES.split_once("\n\nExit codes: ").expect("codes");
    let (codes, _) = codes.split_once(" Ctrl-C ").expect("a sentence after them");
    let listed = |code: u8| {
        let mut entries = codes.split(", ");
        entries.any(|entry| entry.starts_with(&format!("{code} ")))
    };
    let all = [
        DONE,
        FAILED,
        USAGE,
        INCOMPLETE,
        INVALID,
        NO_INPUT,
        NO_OUTPUT,
        NO_IO,
        TRY_AGAIN,
        HUNG_UP,
        INTERRUPTED,
    ];
    for code in all {
        assert!(listed(code), "{code}");
    }
}

#[test]
fn the_manual_lists_keys_commands_and_exit_codes() {
    let page = String::from_utf8(manual::page(Cli::command())).expect("it is text");
    let page = page.replace("\\-", "-");
    let words: Vec<_> = page.split_whitespace().collect();
    let page = words.join(" ");
    for listed in [
        "NAME halflight - ",
        "select K reorder-up move up in the list",
        ":size WxH set the picture size in the scene",
        "Exit codes: 0 ",
    ] {
        assert!(page.contains(listed), "{listed} in\n{page}");
    }
}

#[test]
fn unknown_vector_instructions_are_refused() {
    for known in ["", "sse2", "avx2", "avx512"] {
        assert_eq!(check_cap(Some(known.as_ref())), None);
    }
    assert_eq!(check_cap(None), None);
    for unknown in ["foo", "SSE2", "sse4.2"] {
        assert_eq!(
            check_cap(Some(unknown.as_ref())),
            Some(format!(
                "HALFLIGHT_CPU={unknown}: expected sse2, avx2 or avx512"
            ))
        );
    }
}

#[test]
fn help_states_the_limits() {
    for (line, limits) in [
        ("halflight -h", vec![MAX_SPP.into()]),
        ("halflight render -h", vec![MAX_SPP.into(), MAX_PIXELS]),
    ] {
        let stop = parsed(line).expect_err("help");
        for limit in limits {
            assert!(stop.text.contains(&limit.to_string()), "{limit}: {line}");
        }
    }
}

#[test]
fn completions_and_the_manual_mention_every_option() {
    let mut cli = Cli::command();
    cli.build();
    let commands = cli
        .get_subcommands()
        .filter(|command| command.get_name() != "help");
    let arguments = [&cli]
        .into_iter()
        .chain(commands)
        .flat_map(clap::Command::get_arguments);
    let options: Vec<_> = arguments.filter_map(clap::Arg::get_long).collect();
    assert!(options.contains(&"dump-frame"), "{options:?}");
    for line in [
        "completions bash",
        "completions zsh",
        "completions fish",
        "man",
    ] {
        let stop = parsed(&format!("halflight {line}")).expect_err("a text");
        assert_eq!(stop.code, DONE);
        let text = stop.text.replace("\\-", "-");
        for option in &options {
            assert!(text.contains(option), "{line}: {option}");
        }
    }
}
