//! Saved views, which are the same in all languages.

use glam::DVec3;

use super::{Language, read_as, shown};
use crate::{Source, view_name};
use scene::{Camera, Lens, Meshes};
use text::{Edit, apply};

/// A text with comments around these words.
fn commented(language: Language, words: &str) -> String {
    match language {
        Language::Ray => format!("// {words}"),
        Language::Dat | Language::Cse167 => format!("# {words}"),
        Language::Xml => format!("<!-- {words} -->"),
    }
}

fn read(language: Language, text: &str) -> (Source, Camera) {
    let (source, lowered) = read_as(language, text, &Meshes::default());
    assert_eq!(shown(text, &lowered), [""; 0], "{text}");
    (source, lowered.scene.expect("it is valid").camera)
}

/// A camera as a saved view states it: with four decimals of its angle.
fn stated(camera: &Camera) -> Camera {
    let Lens::Perspective(angle) = camera.lens else {
        return *camera;
    };
    let angle = format!("{angle:.4}").parse().expect("a number");
    Camera {
        lens: Lens::Perspective(angle),
        ..*camera
    }
}

fn edited(text: &str, edits: &[Edit]) -> String {
    let mut text = text.to_owned();
    apply(&mut text, edits);
    text
}

/// The names of the saved views among these comments.
fn names(language: Language, comments: &[&str]) -> Vec<String> {
    let mut text = language.template().to_owned();
    for words in comments {
        text += &commented(language, words);
        text.push('\n');
    }
    let (source, _) = read_as(language, &text, &Meshes::default());
    source
        .saved_views()
        .into_iter()
        .map(|view| view.name)
        .collect()
}

#[test]
fn a_camera_is_saved_replaced_and_deleted_in_a_comment() {
    for language in Language::ALL {
        for template in [language.template(), language.template().trim_end()] {
            let (source, camera) = read(language, template);
            assert!(source.saved_views().is_empty());
            let text = edited(
                template,
                &source.saved_view_edits("front door", Some(&camera)),
            );
            let (source, own) = read(language, &text);
            assert_eq!(own, camera, "{language:?}");
            let views = source.saved_views();
            assert_eq!(views[0].camera(&camera), stated(&camera), "{language:?}");
            let moved = Camera {
                eye: DVec3::new(-0.0, 2.5, 1e20),
                up: DVec3::X,
                lens: Lens::Orthographic(2.0),
                ..camera
            };
            let line = commented(language, "view b: eye 0 2.5 1e20 target ");
            let line = line.split(" -->").next().expect("a line").trim_end();
            let text = edited(&text, &source.saved_view_edits("b", Some(&moved)));
            assert!(text.contains(line), "{line} in\n{text}");
            let (source, _) = read(language, &text);
            assert_eq!(source.saved_views().len(), 2);
            assert_eq!(source.saved_views()[1].camera(&camera), moved);
            let text = edited(&text, &source.saved_view_edits("b", Some(&camera)));
            let (source, _) = read(language, &text);
            assert_eq!(source.saved_views()[1].camera(&moved), stated(&camera));
            let text = edited(&text, &source.saved_view_edits("b", None));
            let (source, _) = read(language, &text);
            assert_eq!(source.saved_view_edits("b", None), []);
            let text = edited(&text, &source.saved_view_edits("front door", None));
            assert_eq!(text.trim_end(), template.trim_end());
        }
    }
}

#[test]
fn only_well_formed_comments_with_a_name_are_saved_views() {
    let whole = "eye 0 0 9 target 0 0 0";
    for language in Language::ALL {
        let good = [
            format!("view a: {whole}"),
            format!("view  from  above :fov 30 {whole} up 0 1 0"),
            format!("view a: {whole} fov 20"),
        ];
        let good: Vec<_> = good.iter().map(String::as_str).collect();
        assert_eq!(names(language, &good), ["a", "from above"], "{language:?}");
        for bad in [
            format!("view: {whole}"),
            format!("views a: {whole}"),
            format!("the view a: {whole}"),
            format!("view a {whole}"),
            "view a: eye 0 0 9".to_owned(),
            "view a: eye 0 0 target 0 0 0".to_owned(),
            "view a: eye 1 2 3 target 1 2 3".to_owned(),
            format!("view a: {whole} size 8 6"),
            format!("view a: {whole} eye 1 1 1"),
            format!("view a: {whole} fov 180"),
            format!("view a: {whole} height 0"),
        ] {
            assert_eq!(names(language, &[&bad]), [""; 0], "{bad}");
        }
    }
}

#[test]
fn a_comment_among_others_is_deleted_without_its_line() {
    let text = "1 1 1 // view a: eye 0 0 1 target 0 0 0\n1 0 9 0 1 1 1\n";
    let (source, _) = read_as(Language::Ray, text, &Meshes::default());
    let text = edited(text, &source.saved_view_edits("a", None));
    assert_eq!(text, "1 1 1 \n1 0 9 0 1 1 1\n");
}

#[test]
fn names_are_words_without_marks() {
    assert_eq!(view_name("  from \t above "), Ok("from above".to_owned()));
    for bad in ["", "  ", "a:b", "a -- b", "a\u{7}b"] {
        assert!(view_name(bad).is_err(), "{bad:?}");
    }
}
