//! Render settings in texts of every language: what they mean, where they are, and edits of them.

use super::{read_as, shown};
use crate::{Language, Node};
use scene::{FalloffRule, Filter, GlossRule, Integrator, Meshes, RenderKey, Rendering, Transfer};
use text::apply;

/// A scene in each language that states nothing, with the place of settings marked by `@`.
const SCENES: [(Language, &str); 4] = [
    (
        Language::Ray,
        "@0 0 0 1 0 5 5 1 1 1 1 sphere 0 0 0 1 0 0 0 .5 .5 .5 0 0 0 1 0 0 1\n",
    ),
    (
        Language::Dat,
        "@light ID 1 inf 0 0 1  0 0 -1  1 1 1  1 0 0  0 shadow_on\n\
         mat ID 1  1 1 1  0 .5 0 1  0 0 1\n\
         obj sphere ID 1 mat ID 1  0 0 0  1\n\
         camera perspective 0 -5 0  0 0 0  0 0 1  1 1 100\nresolution .1 .1\nviewport 8 6\n",
    ),
    (
        Language::Xml,
        "<xml>\n  <scene><object type=\"sphere\"/></scene>\n  <camera><position z=\"9\"/></camera>\n@</xml>\n",
    ),
    (
        Language::Cse167,
        "@camera 0 0 9  0 0 0  0 1 0  40\nsize 8 6\nsphere 0 0 0 1\n",
    ),
];

/// The settings as the language holds them, a line of its own.
fn line(language: Language, settings: &[(&str, &str)]) -> String {
    let (open, close) = match language {
        Language::Ray => ("// render:", "\n"),
        Language::Dat | Language::Cse167 => ("# render:", "\n"),
        Language::Xml => ("  <render", "/>\n"),
    };
    let spelled = settings.iter().map(|(key, value)| match language {
        Language::Xml => format!(" {key}=\"{value}\""),
        Language::Ray | Language::Dat | Language::Cse167 => format!(" {key} {value}"),
    });
    [open, &spelled.collect::<String>(), close].concat()
}

/// The settings of a scene with these lines, and its findings.
fn read(language: Language, scene: &str, lines: &str) -> (Rendering, Vec<String>) {
    let text = scene.replace('@', lines);
    let (_, lowered) = read_as(language, &text, &Meshes::default());
    let found = shown(&text, &lowered);
    let scene = lowered.scene.unwrap_or_else(|| panic!("{found:?}"));
    // The default of a language is not what its text states.
    let stated = Rendering {
        default_depths: None,
        ..scene.setting.rendering
    };
    (stated, found)
}

#[test]
fn every_key_is_read_in_every_language() {
    let settings = [
        ("integrator", "path"),
        ("depth", "0"),
        ("spp", "65536"),
        ("filter", "blackman-harris"),
        ("transfer", "srgb"),
        ("exposure", "-1.5"),
        ("falloff", "square"),
        ("gloss", "exponent"),
        ("noise", "0.02"),
    ];
    assert!(
        RenderKey::of_text()
            .map(RenderKey::name)
            .take(settings.len())
            .eq(settings.map(|(key, _)| key))
    );
    let expected = Rendering {
        integrator: Some(Integrator::Path),
        depth: Some(0),
        spp: Some(65_536),
        filter: Some(Filter::BlackmanHarris),
        transfer: Some(Transfer::Srgb),
        exposure: Some(-1.5),
        falloff: Some(FalloffRule::Square),
        gloss: Some(GlossRule::Exponent),
        noise: Some(0.02),
        ..Rendering::default()
    };
    for (language, scene) in SCENES {
        let none = read(language, scene, "");
        assert_eq!(none, (Rendering::default(), vec![]), "{language:?}");
        let found = read(language, scene, &line(language, &settings));
        assert_eq!(found, (expected, vec![]), "{language:?}");
    }
}

#[test]
fn a_comment_that_looks_like_a_misspelt_setting_is_ignored_with_a_warning() {
    for (start, (language, scene)) in [("// ", SCENES[0]), ("# ", SCENES[1])] {
        for (words, is_close) in [
            ("integrater path spp 4", true),
            ("spp=4", true),
            ("Spp 4", true),
            ("integrater", false),
            ("a quick one", false),
            ("seed 3", false),
        ] {
            let (settings, found) = read(language, scene, &format!("{start}render: {words}\n"));
            assert_eq!(settings, Rendering::default(), "{words}");
            let first = words.split(' ').next().unwrap_or_default();
            let message = format!("warning: render: `{first}` is no key: the comment is ignored");
            let is_said = matches!(&found[..], [one] if one.ends_with(&message));
            assert_eq!(is_said, is_close, "{words}: {found:?}");
            assert!(is_said || found.is_empty(), "{words}: {found:?}");
        }
    }
}

#[test]
fn what_is_wrong_with_a_setting_skips_only_that() {
    let cases = [
        (
            ("depth", "4097"),
            "render depth: must be a whole number from 0 to 4096",
        ),
        (
            ("noise", "1"),
            "render noise: must be at least 0 and less than 1",
        ),
        (("depth", "3f"), "render depth: `3f` is not a number"),
        (
            ("spp", "0"),
            "render spp: must be a whole number from 1 to 65536",
        ),
        (
            ("spp", "2.0"),
            "render spp: must be a whole number from 1 to 65536",
        ),
        (
            ("exposure", "101"),
            "render exposure: must be from -100 to 100",
        ),
        (
            ("integrator", "paths"),
            "render integrator: unknown word `paths`",
        ),
        (("filter", "Box"), "render filter: unknown word `Box`"),
        (("sp", "4"), "render: unknown key `sp`"),
    ];
    for (language, scene) in SCENES {
        for (wrong, message) in cases {
            let lines = line(language, &[("transfer", "srgb"), wrong]);
            let (settings, found) = read(language, scene, &lines);
            let expected = Rendering {
                transfer: Some(Transfer::Srgb),
                ..Rendering::default()
            };
            assert_eq!(settings, expected, "{lines}");
            assert!(
                matches!(&found[..], [one] if one.ends_with(&format!("warning: {message}"))),
                "{lines}: {found:?}"
            );
        }
    }
}

#[test]
fn a_trailing_f_of_an_exposure_is_read_over() {
    for (language, scene) in SCENES {
        let (settings, found) = read(language, scene, &line(language, &[("exposure", "1.5f")]));
        assert_eq!(settings.exposure, Some(1.5), "{language:?}");
        assert!(found[0].contains("the `f` at the end"), "{found:?}");
    }
}

#[test]
fn the_first_settings_count_and_comments_without_a_key_are_only_comments() {
    for (language, scene) in SCENES {
        let [first, second] = ["3", "4"].map(|depth| line(language, &[("depth", depth)]));
        let (settings, found) = read(language, scene, &format!("{first}{second}"));
        assert_eq!(settings.depth, Some(3), "{language:?}");
        assert_eq!(found.len(), 1, "{found:?}");
        assert!(found[0].contains("already given"), "{found:?}");
        let prose = match language {
            Language::Ray => "// render: with care, depth 9\n// render\n//render depth 7\n",
            Language::Dat => "# render: with care, depth 9\n// render: depth 7\n",
            Language::Cse167 => "# render: with care, depth 9\n# render\n",
            Language::Xml => "  <!-- render: depth 9 -->\n",
        };
        assert_eq!(read(language, scene, prose), read(language, scene, ""));
        let (settings, _) = read(language, scene, &format!("{prose}{first}"));
        assert_eq!(settings.depth, Some(3), "{language:?}");
    }
}

#[test]
fn words_after_an_unknown_key_and_keys_without_a_value_are_skipped() {
    let scene = SCENES[0].1;
    let (settings, found) = read(
        Language::Ray,
        scene,
        "// render: depth 3 light 1 2 3 spp filter box spp 4 depth 9\n",
    );
    assert_eq!((settings.depth, settings.spp), (Some(3), Some(4)));
    assert_eq!(settings.filter, Some(Filter::Box));
    let messages = [
        "1:20 warning: render: unknown key `light`",
        "1:32 warning: render spp: no value",
        "1:53 warning: render depth: given twice",
    ];
    assert_eq!(found, messages);
}

#[test]
fn settings_lie_over_what_gamma_asks_for_whose_other_meanings_stay() {
    let text = |settings: &str| {
        format!(
            "<xml><scene><light type=\"point\"><intensity/></light></scene>\
             <camera gamma=\"sRGB\"><position z=\"9\"/></camera>{settings}</xml>"
        )
    };
    let of = |settings: &str| {
        let (_, lowered) = read_as(Language::Xml, &text(settings), &Meshes::default());
        lowered.scene.expect("it has no errors")
    };
    let plain = of("");
    let both = (Integrator::Path, Some(Transfer::Srgb));
    let asked = plain.setting.rendering;
    assert_eq!((asked.integrator(), asked.transfer), both);
    let settled = of("<render integrator=\"whitted\" depth=\"2\"/>");
    let asked = settled.setting.rendering;
    assert_eq!(asked.integrator(), Integrator::Whitted);
    assert_eq!((asked.depth, asked.transfer), (Some(2), both.1));
    assert_eq!(settled.lights, plain.lights);
}

/// Fields that the text omits are written into the place of the settings, in their order of writing,
/// and taken out again with nothing left.
#[test]
fn settings_are_written_changed_and_removed() {
    for (language, scene) in SCENES {
        let first = scene.replace('@', "");
        let mut text = first.clone();
        let mut lines = Vec::new();
        for (key, value) in [("spp", "4"), ("exposure", "0.5"), ("spp", "8")] {
            let (source, _) = read_as(language, &text, &Meshes::default());
            let fields = source.fields(Node::Render);
            let placed = fields.iter().find(|placed| placed.field.key == key);
            let edits = placed
                .expect("it is a key")
                .edits(&*source, &[(0, value.to_owned())]);
            apply(&mut text, &edits);
            lines.push(text.clone());
        }
        let expected = [
            line(language, &[("spp", "4")]),
            line(language, &[("spp", "4"), ("exposure", "0.5")]),
            line(language, &[("spp", "8"), ("exposure", "0.5")]),
        ];
        assert_eq!(lines, expected.map(|line| scene.replace('@', &line)));
        for key in ["exposure", "depth", "spp"] {
            let (source, _) = read_as(language, &text, &Meshes::default());
            apply(&mut text, &source.render_removal(key));
        }
        assert_eq!(text, first);
    }
}

/// The comments move with nothing and label nothing.
#[test]
fn structural_edits_leave_the_settings_where_they_are() {
    for (language, comment) in [
        (Language::Ray, "// render: spp 4"),
        (Language::Dat, "# render: spp 4"),
    ] {
        let scene = match language {
            Language::Ray => {
                let ball = "sphere 0 0 0 1 0 0 0 .5 .5 .5 0 0 0 1 0 0 1";
                format!("0 0 0 1 0 5 5 1 1 1\n2\n{ball}\n{comment}\n{ball}\n")
            }
            _ => SCENES[1].1.replace('@', "").replace(
                "camera",
                &format!("{comment}\nobj sphere ID 2 mat ID 1  3 0 0  1\ncamera"),
            ),
        };
        let (source, lowered) = read_as(language, &scene, &Meshes::default());
        assert_eq!(shown(&scene, &lowered), [""; 0]);
        let last = Node::Object(1);
        assert_eq!(source.comment(last), None, "{language:?}");
        let mut without = scene.clone();
        apply(
            &mut without,
            &source.removal(&[last]).expect("another is left"),
        );
        assert!(without.contains(comment), "{without}");
        assert!(!source.copied(&[last]).expect("it can").contains("render"));
        let at = scene.find("spp").expect("it is stated");
        assert_eq!(source.node_at(text::Span::at(at)), Some(Node::Render));
    }
}

#[test]
fn removing_a_setting_keeps_what_else_the_comment_holds() {
    let scene = SCENES[0].1;
    for (said, left) in [
        ("depth 3 spp x", " spp x"),
        ("depth 3 light 1 2", " light 1 2"),
        ("depth 3 depth 4", " depth 4"),
    ] {
        let mut text = scene.replace('@', &format!("// render: {said}\n"));
        let (source, _) = read_as(Language::Ray, &text, &Meshes::default());
        apply(&mut text, &source.render_removal("depth"));
        assert_eq!(text, scene.replace('@', &format!("// render:{left}\n")));
    }
    let element = "  <render depth=\"3\"><!-- why --></render>\n";
    let mut text = SCENES[2].1.replace('@', element);
    let (source, _) = read_as(Language::Xml, &text, &Meshes::default());
    apply(&mut text, &source.render_removal("depth"));
    assert_eq!(
        text,
        SCENES[2]
            .1
            .replace('@', "  <render><!-- why --></render>\n")
    );
}

#[test]
fn a_bad_value_is_replaced_in_place() {
    for (language, scene) in SCENES {
        let mut text = scene.replace('@', &line(language, &[("spp", "4"), ("depth", "many")]));
        for value in ["7", "9"] {
            let (source, _) = read_as(language, &text, &Meshes::default());
            let fields = source.fields(Node::Render);
            let depth = fields.iter().find(|placed| placed.field.key == "depth");
            let depth = depth.expect("it is listed");
            apply(&mut text, &depth.edits(&*source, &[(0, value.to_owned())]));
            let expected = line(language, &[("spp", "4"), ("depth", value)]);
            assert_eq!(text, scene.replace('@', &expected));
        }
    }
    let twice = read(SCENES[0].0, SCENES[0].1, "// render: depth many depth 5\n");
    assert_eq!(twice.0.depth, Some(5));
}
