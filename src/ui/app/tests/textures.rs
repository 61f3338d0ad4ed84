//! The pictures of textures: asked for, awaited, taken.

use std::sync::Arc;

use super::*;
use crate::assets::{Assets, Loaded, Wanted};
use crate::scene::{Image, Size};

const TEXTURED: &str = "\
camera perspective 0 0 8  0 0 0  0 1 0  1 0 100
resolution .02 .02
viewport 40 30
light ID 0 amb 0 0 0  0 0 0  1 1 1  1 0 0  0 shadow_off
mat ID 0  1 1 1  1 0 0 1  0 0 1
texture ID 7 image 1 1 skin.ppm
use colour ID 7 mat ID 0
obj sphere ID 0 mat ID 0  0 0 0  2
";

fn open_textured(text: &str) -> (App, Vec<Effect>) {
    opened_as("none/scene.dat", text)
}

/// What is asked for, if anything is.
fn asked(effects: &[Effect]) -> Option<Wanted> {
    effects.iter().find_map(|effect| match effect {
        Effect::ReadTextures(wanted) => Some(wanted.clone()),
        _ => None,
    })
}

fn traces(effects: &[Effect]) -> bool {
    wants(effects, |effect| matches!(effect, Effect::Trace(..)))
}

fn wanted(names: &[&str]) -> Wanted {
    Wanted {
        scene: PathBuf::from("none/scene.dat"),
        names: names.iter().map(|name| (*name).to_owned()).collect(),
    }
}

/// What a reading of one picture in one colour gives.
fn loaded(name: &str, pixel: [u8; 3]) -> Loaded {
    let size = Size {
        width: 1,
        height: 1,
    };
    let image = Image::new(size, vec![pixel]).expect("as many pixels as it says");
    Loaded {
        images: [(name.to_owned(), Arc::new(image))].into_iter().collect(),
        ..Loaded::default()
    }
}

fn replaced(app: &mut App, text: &str) -> Vec<Effect> {
    let path = PathBuf::from("none/scene.dat");
    app.update(Msg::Read(path, Ok(text.to_owned())))
}

#[test]
fn a_picture_is_traced_once_its_textures_are_there() {
    let (mut app, effects) = open_textured(TEXTURED);
    let skin = wanted(&["skin.ppm"]);
    assert_eq!(asked(&effects), Some(skin.clone()));
    assert!(!traces(&effects) && app.awaits_textures());
    assert!(!traces(&press(&mut app, "b")));
    assert_eq!(words(&app), "the scene's textures are still being read");
    press(&mut app, "<F5>");
    assert_eq!(app.mode, Mode::Select);

    let effects = app.update(Msg::Textures(skin.clone(), loaded("skin.ppm", [9; 3])));
    let job = effects.iter().find_map(|effect| match effect {
        Effect::Trace(_, job) => Some(job),
        _ => None,
    });
    let images = &job.expect("a picture is traced").images;
    assert!(images.get("skin.ppm").is_some());
    assert!(!app.awaits_textures());
    assert!(traces(&press(&mut app, "b")));

    // The same again changes nothing; other pixels do.
    let same = app.update(Msg::Textures(skin.clone(), loaded("skin.ppm", [9; 3])));
    assert!(!traces(&same));
    let other = app.update(Msg::Textures(skin, loaded("skin.ppm", [8; 3])));
    assert!(traces(&other));
    assert_eq!(words(&app), "textures read again");
}

#[test]
fn a_scene_without_textures_waits_for_nothing() {
    let text = TEXTURED.replace("image 1 1 skin.ppm", "checker 1 1  0 0 0  1 1 1");
    let (app, effects) = open_textured(&text);
    assert_eq!(asked(&effects), None);
    assert!(traces(&effects) && !app.awaits_textures());
}

#[test]
fn only_other_files_are_asked_for() {
    let (mut app, _) = open_textured(TEXTURED);
    let skin = wanted(&["skin.ppm"]);
    app.update(Msg::Textures(skin.clone(), loaded("skin.ppm", [9; 3])));

    let moved = TEXTURED.replace("0 0 0  2", "0 1 0  2");
    let effects = replaced(&mut app, &moved);
    assert!(asked(&effects).is_none() && traces(&effects));

    // While the text has errors, what the picture shows is still wanted.
    let effects = replaced(
        &mut app,
        &moved.replace("skin.ppm", "fur.ppm").replace("obj", "obj x"),
    );
    assert_eq!(asked(&effects), None);
    assert_eq!(asked(&app.update(Msg::TexturesChanged)), Some(skin.clone()));

    let renamed = moved.replace("skin.ppm", "fur.ppm");
    let effects = replaced(&mut app, &renamed);
    let fur = wanted(&["fur.ppm"]);
    assert_eq!(asked(&effects), Some(fur.clone()));
    assert!(!traces(&effects) && app.awaits_textures());
    // An answer to an older question is none.
    assert!(!traces(
        &app.update(Msg::Textures(skin, loaded("skin.ppm", [7; 3])))
    ));
    assert!(app.awaits_textures());
    let effects = app.update(Msg::Textures(fur, loaded("fur.ppm", [7; 3])));
    assert!(traces(&effects) && !app.awaits_textures());

    let none = renamed.replace("image 1 1 fur.ppm", "checker 1 1  0 0 0  1 1 1");
    let effects = replaced(&mut app, &none);
    assert!(asked(&effects).is_none() && traces(&effects));
    assert!(app.update(Msg::TexturesChanged).is_empty());
}

#[test]
fn what_is_wrong_with_a_file_is_a_warning_at_its_name() {
    let (mut app, _) = open_textured(TEXTURED);
    let skin = wanted(&["skin.ppm"]);
    let missing = Assets::new(&[]).read(&skin);
    assert!(traces(&app.update(Msg::Textures(skin.clone(), missing))));
    assert_eq!(words(&app), "1 texture can't be read: ! says why");
    let said = |app: &App| {
        let (text, found) = app.wrong();
        let found = found.first()?;
        Some((found.message.clone(), found.span.of(text).to_owned()))
    };
    let message = "texture 7 file: no such file; magenta stands for it";
    let warning = Some((message.to_owned(), "skin.ppm".to_owned()));
    assert_eq!(said(&app), warning);
    // It moves with the text.
    replaced(&mut app, &format!("# first\n{TEXTURED}"));
    assert_eq!(said(&app), warning);

    app.update(Msg::Textures(skin, loaded("skin.ppm", [9; 3])));
    assert_eq!(said(&app), None);
    assert_eq!(words(&app), "all textures are there again");
}
