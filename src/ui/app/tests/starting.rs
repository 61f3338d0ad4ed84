//! Starting scenes: new ones, and others in place of the present one.

use std::sync::Arc;

use super::saving::saved;
use super::*;
use crate::document::Document;
use crate::file::ReadError;
use crate::scene::Meshes;
use crate::ui::msg::{Guard, Target};
use crate::ui::scene_reading::{Baseline, Opened};

/// The interface with a file that does not exist yet.
fn opened_new(name: &str) -> (App, Vec<Effect>) {
    let mut opening = opening_as(name, String::new());
    opening.text = OpeningText::New;
    App::open(opening)
}

/// A scene that another file holds.
fn found(name: &str, text: &str) -> Opened {
    let language = Language::of_path(Path::new(name)).expect("a scene's name");
    let nothing = Baseline {
        scene: Document::new(language, String::new()).snapshot(),
        saves: 0,
        meshes: Meshes::default(),
        is_sound: false,
    };
    Opened::Read(Reading::new(text.to_owned(), nothing).expect("it fits"))
}

/// Presses keys that open another file, which is there as `found`.
fn go_to(app: &mut App, said: &str, name: &str, found: Opened) -> Vec<Effect> {
    let effects = press(app, said);
    assert!(opens(&effects, name), "{said}: {effects:?}");
    app.update(Msg::Opened(PathBuf::from(name), Ok(found)))
}

fn opens(effects: &[Effect], name: &str) -> bool {
    let is_it =
        |effect: &Effect| matches!(effect, Effect::Open(path, _) if path == Path::new(name));
    effects.iter().any(is_it)
}

fn quits(effects: &[Effect]) -> bool {
    wants(effects, |effect| matches!(effect, Effect::Quit))
}

/// The text and the guard of the only save among the effects.
fn save_of(effects: &[Effect]) -> (&str, &Guard) {
    let mut saves = effects.iter().filter_map(|effect| match effect {
        Effect::Save { text, guard, .. } => Some((text.as_str(), guard)),
        _ => None,
    });
    saves.next().expect("a save")
}

fn asks(app: &App) -> bool {
    matches!(app.overlays.dialog, Some(Dialog::Leave(_)))
}

#[test]
fn a_file_that_does_not_exist_is_a_new_scene_of_its_language() {
    for language in Language::ALL {
        let name = format!("new.{}", language.extension());
        let (mut app, effects) = opened_new(&name);
        assert_eq!(words(&app), format!("{name} is new: w writes it"));
        assert!(wants(&effects, |e| matches!(e, Effect::Watch(_))));
        assert!(wants(&effects, |e| matches!(
            e,
            Effect::Trace(Target::Preview, _)
        )));
        assert_eq!(app.document.text(), language.template());
        assert_eq!(app.diagnostics.len(), 0, "{name}");
        // It is still not there.
        let error = ReadError::NotFound {
            path: PathBuf::from(&name),
        };
        assert!(
            app.update(Msg::Read(PathBuf::from(&name), Err(error)))
                .is_empty()
        );
        assert_eq!(app.disk.state, OnDisk::New);

        // Nothing was changed yet.
        assert!(quits(&press(&mut app, "q")) && app.losses().is_none());
        assert!(!quits(&press(&mut app, "jjjDq")));
        let question = format!("{name} is new and not saved");
        assert_eq!(app.losses(), Some(question));
        assert!(quits(&press(&mut app, "y")));

        let (mut app, _) = opened_new(&name);
        let effects = press(&mut app, "w");
        assert_eq!(save_of(&effects), (language.template(), &Guard::Absent));
        let text = app.document.shared_text();
        saved(&mut app, 1, &name, &text);
        assert!(quits(&press(&mut app, "q")));
    }
}

#[test]
fn a_new_scene_takes_or_merges_a_file_that_appears() {
    let text = Language::Ray.template();
    let theirs = text.replace("0.5 0.55 0.65", "0.1 0.1 0.1");
    let (mut app, _) = opened_new("scene.ray");
    outside(&mut app, &theirs);
    assert_eq!(
        (app.document.text(), &app.disk.state),
        (&*theirs, &OnDisk::Known)
    );
    assert!(quits(&press(&mut app, "q")));

    let (mut app, _) = opened_new("scene.ray");
    press(&mut app, "jjjel");
    outside(&mut app, &theirs);
    assert!(
        words(&app).starts_with("merged the file's changes"),
        "{}",
        words(&app)
    );
    assert!(app.document.is_dirty());
}

#[test]
fn a_new_scene_without_a_file_asks_for_a_name() {
    for (said, language) in [
        (":new<Enter>", Language::Ray),
        (":new ray<Enter>", Language::Ray),
        (":new .DAT<Enter>", Language::Dat),
        (":new xml<Enter>", Language::Xml),
    ] {
        let mut app = open(SCENE);
        let effects = press(&mut app, said);
        assert!(wants(&effects, |e| matches!(e, Effect::LookForKept(_))));
        assert_eq!(words(&app), "a new scene: :w FILE writes it");
        assert_eq!(app.document.text(), language.template());
        assert_eq!((app.document.language(), &app.disk.path), (language, &None));
        assert!(quits(&press(&mut app, "q")));
        assert!(!quits(&press(&mut app, "jjjDq")));
        assert_eq!(app.losses().as_deref(), Some("the new scene is not saved"));
        assert!(!quits(&press(&mut app, "w")));
        assert!(app.overlays.prompt.is_some());
        let name = format!("x.{}", language.extension());
        let effects = press(&mut app, &format!("{name}<Enter>"));
        let text = app.document.shared_text();
        assert_eq!(save_of(&effects), (text.as_str(), &Guard::Absent));
        // The saves of the former scene are counted too.
        assert!(quits(&saved(&mut app, 2, &name, &text)), "{said}");
    }
    let mut app = open(SCENE);
    press(&mut app, ":new obj<Enter>");
    assert_eq!(words(&app), "new takes .ray, .dat or .xml");
}

#[test]
fn another_scene_replaces_everything_that_belongs_to_this_one() {
    let mut app = open(SCENE);
    press(&mut app, "jjjel<Esc>u<F5>");
    app.update(Msg::Started(Target::Trace, 1));
    press(&mut app, "<Esc>");
    let effects = go_to(
        &mut app,
        ":e b.dat<Enter>",
        "b.dat",
        found("b.dat", dat::SCENE),
    );
    assert!(
        matches!(&effects[..], [Effect::Stop(Target::Trace), Effect::Free(_), Effect::Watch(path), ..] if path == Path::new("b.dat"))
    );
    for wanted in [
        |e: &Effect| matches!(e, Effect::LookForKept(_)),
        |e: &Effect| matches!(e, Effect::Trace(Target::Preview, _)),
    ] {
        assert!(wants(&effects, wanted), "{effects:?}");
    }
    assert_eq!(app.document.text(), dat::SCENE);
    assert_eq!(app.disk.name(), "b.dat");
    assert_eq!(app.document.language(), Language::Dat);
    assert!(!app.document.is_dirty() && app.pictures.trace.is_none());
    press(&mut app, "u");
    assert_eq!(words(&app), "nothing to undo");
    press(&mut app, "<Ctrl-r>");
    assert_eq!(words(&app), "nothing to redo");
    // A reading of the former scene's file comes too late.
    read(&mut app, "scene.ray", SCENE);
    assert_eq!(app.document.text(), dat::SCENE);
}

#[test]
fn another_scene_may_be_new_kept_broken_or_empty() {
    for (opened, state, text) in [
        (Opened::New, OnDisk::New, Language::Ray.template()),
        (Opened::Kept(SCENE.to_owned()), OnDisk::Missing, SCENE),
        (found("b.ray", "no scene"), OnDisk::Known, "no scene"),
        (found("b.ray", ""), OnDisk::Known, ""),
    ] {
        let mut app = open(SCENE);
        go_to(&mut app, ":e b.ray<Enter>", "b.ray", opened);
        assert_eq!((app.document.text(), &app.disk.state), (text, &state));
        // The picture of the former scene does not stay.
        assert_eq!(app.scene.is_some(), app.error_count() == 0);
        app.update(Msg::Started(Target::Preview, 3));
        let size = app.raster().expect("there is room").1;
        let former = pictures::frame(size, vec![0; size.pixels()]);
        app.update(Msg::Frame(Target::Preview, Arc::new(former)));
        assert!(app.picture().latest.is_none(), "{text}");
    }
}

#[test]
fn a_scene_that_cannot_be_read_leaves_this_one() {
    let mut app = open(SCENE);
    press(&mut app, ":e none/b.ray<Enter>");
    let path = PathBuf::from("none/b.ray");
    let error = ReadError::NotFound { path: path.clone() };
    // Changes are not read meanwhile: that would supersede the request.
    assert!(app.update(Msg::FileChanged).is_empty());
    let effects = app.update(Msg::Opened(path, Err(error)));
    assert_eq!(words(&app), "none/b.ray: no such file");
    assert!(wants(&effects, |e| matches!(e, Effect::Read(..))));
    assert_eq!(
        (app.disk.name().as_str(), app.document.text()),
        ("scene.ray", SCENE)
    );
    press(&mut app, ":e notes.txt<Enter>");
    assert!(
        words(&app).contains("notes.txt: not a scene"),
        "{}",
        words(&app)
    );
}

#[test]
fn the_scenes_own_file_is_read_again() {
    for said in [":e<Enter>", ":e scene.ray<Enter>", ":e ./scene.ray<Enter>"] {
        let mut app = open(SCENE);
        let effects = press(&mut app, said);
        assert!(wants(&effects, |e| matches!(e, Effect::Read(..))), "{said}");
    }
}

#[test]
fn leaving_unsaved_edits_for_another_scene_asks() {
    for said in [":e b.ray<Enter>", ":new<Enter>"] {
        let mut app = open(SCENE);
        press(&mut app, &format!("jjjel<Esc>{said}"));
        assert!(asks(&app) && app.document.is_dirty(), "{said}");
        press(&mut app, "n");
        assert!(!asks(&app) && app.document.is_dirty(), "{said}");
    }
    // Discarding gives up the journal, too.
    let mut app = open(SCENE);
    press(&mut app, "jjjel<Esc>");
    app.update(Msg::Elapsed(crate::ui::msg::Timer::Keep));
    let effects = press(&mut app, ":new<Enter>y");
    assert!(
        matches!(effects[..], [Effect::DropRecovery, ..]),
        "{effects:?}"
    );
    assert_eq!(app.document.text(), Language::Ray.template());

    let mut app = open(SCENE);
    let effects = press(&mut app, "jjjel<Esc>:e b.ray<Enter>w");
    let mine = Arc::new(save_of(&effects).0.to_owned());
    assert!(!opens(&effects, "b.ray"));
    assert!(opens(&saved(&mut app, 1, "scene.ray", &mine), "b.ray"));
}

#[test]
fn an_edit_made_while_another_scene_is_read_is_asked_about() {
    let mut app = open(SCENE);
    press(&mut app, ":e b.ray<Enter>jjjel");
    app.update(Msg::Opened(PathBuf::from("b.ray"), Ok(found("b.ray", ""))));
    assert!(asks(&app) && app.disk.name() == "scene.ray");
    assert!(opens(&press(&mut app, "y"), "b.ray"));
    app.update(Msg::Opened(PathBuf::from("b.ray"), Ok(found("b.ray", ""))));
    assert_eq!(app.document.text(), "");
}

#[test]
fn the_late_outcome_of_a_save_does_not_touch_another_scene() {
    let mut app = open(SCENE);
    press(&mut app, ":w copy.ray<Enter>");
    let written = app.document.shared_text();
    press(&mut app, ":new<Enter>");
    saved(&mut app, 1, "copy.ray", &written);
    assert_eq!(words(&app), "wrote copy.ray");
    assert_eq!((&app.disk.path, &app.disk.state), (&None, &OnDisk::New));
}

#[test]
fn an_editor_is_not_opened_on_a_file_that_does_not_exist() {
    let (mut app, _) = opened_new("new.ray");
    assert!(press(&mut app, "E").is_empty());
    assert_eq!(words(&app), "new.ray is new: press w to write it, then E");
}

#[test]
fn scenes_are_remembered_when_they_are_opened_and_saved_elsewhere() {
    let noted = |effects: &[Effect]| -> Vec<String> {
        let noted = effects.iter().filter_map(|effect| match effect {
            Effect::NoteRecent(path) => Some(path.display().to_string()),
            _ => None,
        });
        noted.collect()
    };
    let (mut app, effects) = opened(SCENE);
    assert_eq!(noted(&effects), ["scene.ray"]);
    press(&mut app, ":w copy.ray<Enter>");
    let text = app.document.shared_text();
    assert_eq!(noted(&saved(&mut app, 1, "copy.ray", &text)), ["copy.ray"]);
    press(&mut app, "jjjelw");
    let text = app.document.shared_text();
    assert_eq!(noted(&saved(&mut app, 2, "copy.ray", &text)), [""; 0]);
    let effects = go_to(&mut app, ":e b.ray<Enter>", "b.ray", found("b.ray", SCENE));
    assert_eq!(noted(&effects), ["b.ray"]);
    let (mut app, effects) = opened_new("new.ray");
    assert_eq!(noted(&effects), [""; 0]);
    press(&mut app, "w");
    let text = app.document.shared_text();
    assert_eq!(noted(&saved(&mut app, 1, "new.ray", &text)), ["new.ray"]);
    assert_eq!(noted(&press(&mut app, ":new<Enter>")), [""; 0]);
}

#[test]
fn recent_scenes_are_listed_filtered_and_opened() {
    let paths = || ["/a/one.ray", "/a/two.dat", "/b/three.xml"].map(PathBuf::from);
    for (said, opened) in [
        ("<Enter>", Some("/a/one.ray")),
        ("j<Enter>", Some("/a/two.dat")),
        ("jjjk<Enter>", Some("/a/two.dat")),
        ("G<Enter>", Some("/b/three.xml")),
        ("/A/<Esc>j<Enter>", Some("/a/two.dat")),
        ("/A/<Down><Enter>", Some("/a/two.dat")),
        ("three<Enter>", Some("/b/three.xml")),
        ("none<Enter>", None),
        ("j<Esc>", None),
    ] {
        let mut app = open(SCENE);
        let effects = press(&mut app, ":recent<Enter>");
        assert!(matches!(effects[..], [Effect::ListRecent]));
        app.update(Msg::RecentListed(paths().into()));
        let effects = press(&mut app, said);
        match opened {
            Some(path) => assert!(opens(&effects, path), "{said}: {effects:?}"),
            None => assert!(effects.is_empty(), "{said}: {effects:?}"),
        }
        assert!(app.overlays.page.is_none(), "{said}");
    }
    let mut app = open(SCENE);
    app.update(Msg::RecentListed(paths().into()));
    app.update(Msg::Paste("two\n".to_owned()));
    assert!(opens(&press(&mut app, "<Enter>"), "/a/two.dat"));
    let mut app = open(SCENE);
    press(&mut app, "jjjel");
    app.update(Msg::RecentListed(paths().into()));
    press(&mut app, "<Enter>");
    assert!(asks(&app));
    app.update(Msg::RecentListed(Vec::new()));
    assert_eq!(words(&app), "no recently used scenes");
}

#[test]
fn recent_scenes_are_offered_over_the_embedded_one() {
    let mut opening = opening_as("scene.ray", SCENE.to_owned());
    opening.path = None;
    opening.recent = vec![PathBuf::from("/a/one.ray")];
    let (mut app, effects) = App::open(opening);
    let traces = |e: &Effect| matches!(e, Effect::Trace(Target::Preview, _));
    assert!(wants(&effects, traces) && app.overlays.page.is_some());
    press(&mut app, "<Esc>");
    assert!(app.overlays.page.is_none() && app.document.text() == SCENE);
}
