//! Requesting, awaiting and taking the files that scenes name.

use std::collections::BTreeSet;
use std::sync::Arc;

use super::*;
use crate::assets::{Assets, Loaded, Wanted};
use crate::language::Node;
use crate::obj;
use crate::scene::{Image, NoMesh, Size};

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

/// The files requested, if any.
fn asked(effects: &[Effect]) -> Option<Wanted> {
    effects.iter().find_map(|effect| match effect {
        Effect::ReadAssets(wanted) => Some(wanted.clone()),
        _ => None,
    })
}

fn traces(effects: &[Effect]) -> bool {
    wants(effects, |effect| matches!(effect, Effect::Trace(..)))
}

fn wanted(names: &[&str]) -> Wanted {
    Wanted {
        scene: PathBuf::from("none/scene.dat"),
        pictures: names.iter().map(|name| (*name).to_owned()).collect(),
        meshes: BTreeSet::new(),
    }
}

/// The result of reading one picture of a single colour.
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
    read(app, "none/scene.dat", text)
}

#[test]
fn a_picture_is_traced_once_its_textures_are_read() {
    let (mut app, effects) = open_textured(TEXTURED);
    let skin = wanted(&["skin.ppm"]);
    assert_eq!(asked(&effects), Some(skin.clone()));
    assert!(!traces(&effects) && app.assets.are_awaited());
    assert!(!traces(&press(&mut app, "b")));
    assert_eq!(words(&app), "still reading the scene's files");
    press(&mut app, "<F5>");
    assert_eq!(app.mode, Mode::Select);

    let effects = app.update(Msg::AssetsRead(skin.clone(), loaded("skin.ppm", [9; 3])));
    let job = effects.iter().find_map(|effect| match effect {
        Effect::Trace(_, job) => Some(job),
        _ => None,
    });
    let images = &job.expect("a picture is traced").images;
    assert!(images.get("skin.ppm").is_some());
    assert!(!app.assets.are_awaited());
    assert!(traces(&press(&mut app, "b")));

    // The same pixels change nothing; others do.
    let same = app.update(Msg::AssetsRead(skin.clone(), loaded("skin.ppm", [9; 3])));
    assert!(!traces(&same));
    let other = app.update(Msg::AssetsRead(skin, loaded("skin.ppm", [8; 3])));
    assert!(traces(&other));
    assert_eq!(words(&app), "files reloaded");
}

#[test]
fn files_that_are_used_no_longer_or_again_are_not_reloaded() {
    let second = "texture ID 8 image 1 1 fur.ppm\nuse colour ID 8 mat ID 0\n";
    let (mut app, _) = open_textured(&format!("{TEXTURED}{second}"));
    let (skin, fur) = (loaded("skin.ppm", [9; 3]), loaded("fur.ppm", [8; 3]));
    let images = ["skin.ppm", "fur.ppm"].map(|name| {
        let read = skin.images.get(name).or_else(|| fur.images.get(name));
        (name.to_owned(), Arc::clone(read.expect("it was read")))
    });
    let both = || Loaded {
        images: images.clone().into_iter().collect(),
        ..Loaded::default()
    };
    app.update(Msg::AssetsRead(wanted(&["skin.ppm", "fur.ppm"]), both()));
    let said = words(&app).to_owned();
    replaced(&mut app, TEXTURED);
    let after = words(&app).to_owned();
    app.update(Msg::AssetsRead(wanted(&["skin.ppm"]), skin));
    assert_ne!(said, after);
    assert_eq!(words(&app), after);
}

#[test]
fn a_scene_without_textures_does_not_wait() {
    let text = TEXTURED.replace("image 1 1 skin.ppm", "checker 1 1  0 0 0  1 1 1");
    let (app, effects) = open_textured(&text);
    assert_eq!(asked(&effects), None);
    assert!(traces(&effects) && !app.assets.are_awaited());
}

#[test]
fn files_are_requested_only_if_they_differ() {
    let (mut app, _) = open_textured(TEXTURED);
    let skin = wanted(&["skin.ppm"]);
    app.update(Msg::AssetsRead(skin.clone(), loaded("skin.ppm", [9; 3])));

    let moved = TEXTURED.replace("0 0 0  2", "0 1 0  2");
    let effects = replaced(&mut app, &moved);
    assert!(asked(&effects).is_none() && traces(&effects));

    // While the text has errors, the files that the picture shows are still wanted.
    let effects = replaced(
        &mut app,
        &moved.replace("skin.ppm", "fur.ppm").replace("obj", "obj x"),
    );
    assert_eq!(asked(&effects), None);
    assert_eq!(asked(&app.update(Msg::AssetsChanged)), Some(skin.clone()));

    let renamed = moved.replace("skin.ppm", "fur.ppm");
    let effects = replaced(&mut app, &renamed);
    let fur = wanted(&["fur.ppm"]);
    assert_eq!(asked(&effects), Some(fur.clone()));
    assert!(!traces(&effects) && app.assets.are_awaited());
    // The answer to an outdated request is ignored.
    assert!(!traces(
        &app.update(Msg::AssetsRead(skin, loaded("skin.ppm", [7; 3])))
    ));
    assert!(app.assets.are_awaited());
    let effects = app.update(Msg::AssetsRead(fur, loaded("fur.ppm", [7; 3])));
    assert!(traces(&effects) && !app.assets.are_awaited());

    let none = renamed.replace("image 1 1 fur.ppm", "checker 1 1  0 0 0  1 1 1");
    let effects = replaced(&mut app, &none);
    assert!(asked(&effects).is_none() && traces(&effects));
    assert!(app.update(Msg::AssetsChanged).is_empty());
}

#[test]
fn a_missing_texture_is_a_warning_at_its_name() {
    let (mut app, _) = open_textured(TEXTURED);
    let skin = wanted(&["skin.ppm"]);
    let missing = Assets::new(&[]).read(&skin);
    assert!(traces(&app.update(Msg::AssetsRead(skin.clone(), missing))));
    assert_eq!(words(&app), "cannot read 1 file: press ! to see why");
    let said = |app: &App| {
        let (text, found) = (app.wrong().text, app.wrong().findings);
        let found = found.first()?;
        Some((found.message.clone(), found.span.of(text).to_owned()))
    };
    let message = "texture 7 file: no such file; shown in magenta";
    let warning = Some((message.to_owned(), "skin.ppm".to_owned()));
    assert_eq!(said(&app), warning);
    // The warning moves with the text.
    replaced(&mut app, &format!("# first\n{TEXTURED}"));
    assert_eq!(said(&app), warning);

    app.update(Msg::AssetsRead(skin, loaded("skin.ppm", [9; 3])));
    assert_eq!(said(&app), None);
    assert_eq!(words(&app), "all files can be read now");
}

const MESHED: &str = "<xml><scene>
  <object type='sphere'/>
  <object type='obj' name='a.obj'/>
</scene><camera><position z='9'/><target/></camera></xml>
";

fn wanted_mesh(pictures: &[&str]) -> Wanted {
    Wanted {
        scene: PathBuf::from("none/scene.xml"),
        meshes: BTreeSet::from(["a.obj".to_owned()]),
        ..wanted(pictures)
    }
}

/// The result of reading a triangle of this size, with a material library.
fn triangle(size: &str, library: &str) -> Loaded {
    let text = format!("mtllib a.mtl\nv 0 0 0\nv {size} 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n");
    let read = obj::read(text.as_bytes(), |_| Ok::<_, String>(library));
    let model = read.expect("the mesh is sound");
    Loaded {
        meshes: [("a.obj".to_owned(), Ok(Arc::new(model)))]
            .into_iter()
            .collect(),
        ..Loaded::default()
    }
}

fn broken() -> Loaded {
    let read = obj::read(b"v 0 0 0\nv x 0 0\n", |_| Ok::<_, String>(""));
    let fault = NoMesh::Malformed(read.expect_err("there are no faces"));
    Loaded {
        meshes: [("a.obj".to_owned(), Err(fault))].into_iter().collect(),
        ..Loaded::default()
    }
}

/// The number of objects in the traced scene, if one is traced.
fn traced_objects(effects: &[Effect]) -> Option<usize> {
    effects.iter().find_map(|effect| match effect {
        Effect::Trace(_, job) => Some(job.scene.objects.len()),
        _ => None,
    })
}

#[test]
fn a_mesh_arrives_later_and_the_picture_follows_its_file() {
    let (mut app, effects) = opened_as("none/scene.xml", MESHED);
    assert_eq!(asked(&effects), Some(wanted_mesh(&[])));
    assert!(!traces(&effects) && app.assets.are_awaited());
    assert_eq!(app.error_count(), 0);

    let small = triangle("1", "newmtl a\n");
    let effects = app.update(Msg::AssetsRead(wanted_mesh(&[]), small.clone()));
    assert_eq!(traced_objects(&effects), Some(2));
    // The mesh was read again unchanged.
    let effects = app.update(Msg::AssetsRead(wanted_mesh(&[]), small));
    assert_eq!(traced_objects(&effects), None);

    let more = MESHED.replace(
        "'/>\n</scene>",
        "'/>\n  <object type='obj' name='b.obj'/>\n</scene>",
    );
    let late = Reading::new(more.clone(), app.baseline()).expect("it fits into memory");
    let asks = app.update(Msg::AssetsChanged);
    assert_eq!(asked(&asks), Some(wanted_mesh(&[])));
    for other in [
        triangle("2", "newmtl a\n"),
        triangle("2", "newmtl a\nKd 1 0 0\n"),
    ] {
        let effects = app.update(Msg::AssetsRead(wanted_mesh(&[]), other));
        assert_eq!(traced_objects(&effects), Some(2));
        assert_eq!(words(&app), "files reloaded");
    }

    // A scene that was lowered with outdated meshes is read again.
    let effects = app.update(Msg::Read(PathBuf::from("none/scene.xml"), Ok(late)));
    assert!(matches!(effects[..], [Effect::Read(..), Effect::Free(_)]));
    assert_eq!(app.document.text(), MESHED);

    // With another mesh the picture waits for it, but the text has already changed.
    let effects = read(&mut app, "none/scene.xml", &more);
    assert!(!traces(&effects) && app.assets.are_awaited());
    assert_eq!(words(&app), "reloaded: b.obj (obj)");
}

#[test]
fn a_broken_mesh_is_a_warning_and_its_object_is_left_out() {
    let (mut app, _) = opened_as("none/scene.xml", MESHED);
    app.update(Msg::AssetsRead(
        wanted_mesh(&[]),
        triangle("1", "newmtl a\n"),
    ));
    let effects = app.update(Msg::AssetsRead(wanted_mesh(&[]), broken()));
    assert_eq!(traced_objects(&effects), Some(1));
    assert_eq!(words(&app), "cannot read 1 file: press ! to see why");
    let (text, found) = (app.wrong().text, app.wrong().findings);
    for message in [
        "a.obj:2:3: v: `x` is not a number",
        "a.obj:2:8: a.obj (obj): the file has no faces that can be used",
    ] {
        let mut found = found.iter();
        let warning = found.find(|found| found.message_with_file() == message);
        let warning = warning.expect("it is reported");
        assert_eq!(warning.span.of(text), "a.obj");
    }
    // The mesh's file is still watched; other edits are accepted meanwhile.
    assert_eq!(
        asked(&app.update(Msg::AssetsChanged)),
        Some(wanted_mesh(&[]))
    );
    app.select(Node::Object(0));
    press(&mut app, "<Enter>jj7<Enter>");
    assert!(app.document.text().contains("material=\"7\""));
    assert_eq!(app.error_count(), 0);

    let effects = app.update(Msg::AssetsRead(
        wanted_mesh(&[]),
        triangle("3", "newmtl a\n"),
    ));
    assert_eq!(traced_objects(&effects), Some(2));
    assert_eq!(words(&app), "all files can be read now");
    assert_eq!(app.error_count(), 0);
}

#[test]
fn a_scene_whose_mesh_was_never_read_shows_the_rest() {
    let (mut app, effects) = opened_as("none/scene.xml", MESHED);
    // What was lowered before the file was read must not be shown as the scene.
    assert!(!traces(&effects));
    let effects = app.update(Msg::AssetsRead(wanted_mesh(&[]), broken()));
    assert_eq!(traced_objects(&effects), Some(1));
    assert_eq!(app.error_count(), 0);
}

#[test]
fn pictures_named_by_a_mesh_are_requested_once_it_is_read() {
    let (mut app, _) = opened_as("none/scene.xml", MESHED);
    let skinned = triangle("1", "newmtl a\nmap_Kd skin.ppm\n");
    let effects = app.update(Msg::AssetsRead(wanted_mesh(&[]), skinned.clone()));
    let both = wanted_mesh(&["skin.ppm"]);
    assert_eq!(asked(&effects), Some(both.clone()));
    assert!(!traces(&effects) && app.assets.are_awaited());
    let whole = Loaded {
        images: loaded("skin.ppm", [9; 3]).images,
        ..skinned.clone()
    };
    let effects = app.update(Msg::AssetsRead(both.clone(), whole));
    assert_eq!(traced_objects(&effects), Some(2));
    assert!(!app.assets.are_awaited());

    // A missing picture is a warning where the mesh is named.
    let missing = Loaded {
        meshes: skinned.meshes,
        ..Assets::new(&[]).read(&wanted(&["skin.ppm"]))
    };
    assert!(traces(&app.update(Msg::AssetsRead(both, missing))));
    let (text, found) = (app.wrong().text, app.wrong().findings);
    let found = found.iter().find(|found| found.span.of(text) == "a.obj");
    let message = "a.obj (obj) map_Kd skin.ppm: no such file; shown in magenta";
    assert_eq!(found.map(|found| found.message.as_str()), Some(message));
}

#[test]
fn a_file_found_elsewhere_is_reported_once() {
    let (mut app, _) = open_textured(TEXTURED);
    let found = |colour, place: &str| Loaded {
        elsewhere: [("skin.ppm".to_owned(), PathBuf::from(place))].into(),
        ..loaded("skin.ppm", [colour; 3])
    };
    for (colour, place, said) in [
        (1, "/a/skin.ppm", "skin.ppm is read from /a/skin.ppm"),
        (2, "/a/skin.ppm", "files reloaded"),
        (3, "/b/skin.ppm", "skin.ppm is read from /b/skin.ppm"),
    ] {
        app.update(Msg::AssetsRead(wanted(&["skin.ppm"]), found(colour, place)));
        assert_eq!(words(&app), said);
    }
}
