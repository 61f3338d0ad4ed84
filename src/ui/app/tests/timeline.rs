//! The page of the undo history.

use std::collections::BTreeMap;
use std::collections::VecDeque;
use std::sync::Arc;

use super::pictures::frame;
use super::*;
use crate::document::StateId;
use crate::language::Source;
use crate::render::{Frame, Job};
use crate::scene::{Meshes, Size};
use crate::text::{Edit, Span};
use crate::ui::history_scene::{HistoryScene, HistoryText, NoPicture};
use crate::ui::msg::Target;

/// Opens the scene on a terminal with colours, and makes three steps.
fn changed() -> App {
    let mut app = opened(SCENE).0;
    app.thumbnails.has_colours = true;
    press(&mut app, "ggjjjjell<Esc>jDk");
    press(&mut app, "d");
    assert_eq!(app.document.present(), 3);
    app
}

/// What has been asked of the threads behind the page.
#[derive(Debug, Default)]
struct Asked {
    derived: Vec<usize>,
    traced: Vec<Job>,
    stops: usize,
}

/// Does what these effects and those that follow ask for, as the threads would.
fn perform(app: &mut App, effects: Vec<Effect>) -> Asked {
    let mut asked = Asked::default();
    let mut left = VecDeque::from(effects);
    let mut generation = 100;
    while let Some(effect) = left.pop_front() {
        let msgs = match effect {
            Effect::Derive(past) => {
                asked.derived.push(past.at);
                vec![Msg::Derived(past.ticket, scene_of(&past))]
            }
            Effect::Trace(Target::Thumbnail, job) => {
                generation += 1;
                let size = job.settings.size;
                asked.traced.push(job);
                let started = Msg::Started(Target::Thumbnail, generation);
                vec![started, traced(generation, size)]
            }
            Effect::Stop(Target::Thumbnail) => {
                asked.stops += 1;
                Vec::new()
            }
            _ => Vec::new(),
        };
        for msg in msgs {
            left.extend(app.update(msg));
        }
    }
    asked
}

fn traced(generation: u64, size: Size) -> Msg {
    let whole = Frame {
        generation,
        ..frame(size, vec![0; size.pixels()])
    };
    Msg::Frame(Target::Thumbnail, Arc::new(whole))
}

fn scene_of(past: &HistoryText) -> Result<HistoryScene, NoPicture> {
    let text = past.timeline.text(past.at);
    let mut source = Source::new(past.timeline.language, text);
    let lowered = source.lower(&Meshes::default()).expect("there is memory");
    let scene = lowered.scene.ok_or(NoPicture::Errors)?;
    Ok(HistoryScene {
        scene: Arc::new(scene),
        images: past.files.images.clone(),
    })
}

fn opens_page(app: &mut App) -> Asked {
    let effects = press(app, "U");
    assert_eq!(app.context(), keymap::Context::Steps);
    perform(app, effects)
}

#[test]
fn the_page_lists_every_step_and_asks_for_each_picture_once() {
    let mut app = changed();
    press(&mut app, "u");
    let asked = opens_page(&mut app);
    let (page, steps) = app.open_steps().expect("it is open");
    let rows: Vec<_> = page.rows().into_iter().map(|(_, name)| name).collect();
    assert_eq!(
        rows,
        [
            "as opened",
            "object 1 (sphere) centre x: 0 → 0.2, 2 nudges",
            "duplicated object 2 (sphere)",
            "deleted object 2 (sphere)",
        ]
    );
    let when: Vec<_> = (0..4).map(|at| steps.when(at)).collect();
    assert_eq!(when, ["2 steps back", "1 step back", "now", "1 step ahead"]);
    assert_eq!(page.filter.at, 2);
    // The present text first, then its neighbours, and at last the large picture.
    assert_eq!(asked.derived, [2, 1, 3, 0, 2]);
    let objects: Vec<_> = asked
        .traced
        .iter()
        .map(|job| job.scene.objects.len())
        .collect();
    assert_eq!(objects, [3, 2, 2, 2, 3]);
    // Another text is selected: it lacks only the large picture.
    let effects = press(&mut app, "j");
    assert_eq!(perform(&mut app, effects).derived, [3]);
    let effects = press(&mut app, "<Esc>");
    assert_eq!(perform(&mut app, effects).stops, 0, "nothing is under way");
    let again = opens_page(&mut app);
    assert_eq!((again.derived.len(), again.traced.len()), (0, 0));
}

#[test]
fn closing_the_page_stops_what_is_under_way_and_changes_nothing() {
    for close in ["<Esc>", "q", "U"] {
        let mut app = changed();
        let text = app.document.shared_text();
        let effects = press(&mut app, "U");
        let past = effects.iter().find_map(|effect| match effect {
            Effect::Derive(past) => Some(past.clone()),
            _ => None,
        });
        let past = past.expect("a scene is asked for");
        assert!(app.thumbnails.are_awaited());
        let effects = press(&mut app, close);
        assert_eq!(perform(&mut app, effects).stops, 1, "{close}");
        assert!(!app.thumbnails.are_awaited());
        let late = app.update(Msg::Derived(past.ticket, scene_of(&past)));
        assert!(
            matches!(late[..], [Effect::Free(_)]),
            "{close}: nothing is traced: {late:?}"
        );
        assert!(Arc::ptr_eq(&text, &app.document.shared_text()));
    }
    let mut app = changed();
    let effects = press(&mut app, "U");
    let begun = effects.into_iter().find_map(|effect| match effect {
        Effect::Derive(past) => Some(Msg::Derived(past.ticket, scene_of(&past))),
        _ => None,
    });
    let effects = app.update(begun.expect("a scene is asked for"));
    assert!(wants(&effects, |effect| matches!(
        effect,
        Effect::Trace(Target::Thumbnail, _)
    )));
    app.update(Msg::Started(Target::Thumbnail, 7));
    press(&mut app, "<Esc>");
    let size = Size {
        width: 4,
        height: 3,
    };
    app.update(traced(7, size));
    let effects = press(&mut app, "U");
    assert!(
        wants(&effects, |effect| matches!(effect, Effect::Derive(_))),
        "a frame after the end is not taken for the picture"
    );
}

#[test]
fn a_text_with_errors_and_a_refused_picture_are_not_asked_for_again() {
    let mut app = changed();
    app.document.edit(&[Edit {
        span: Span::at(0),
        text: "broken ".to_owned(),
    }]);
    app.relower();
    press(&mut app, "u");
    let asked = opens_page(&mut app);
    assert!(asked.derived.contains(&4));
    let (id, _) = app.open_steps().expect("it is open").1.rows[4];
    assert_eq!(
        app.thumbnails.get(id, Rank::Row),
        Some(&Err(NoPicture::Errors))
    );
    press(&mut app, "<Esc>");
    app.thumbnails.forget();
    let effects = press(&mut app, "U");
    assert!(wants(&effects, |effect| matches!(
        effect,
        Effect::Derive(_)
    )));
    let effects = app.update(Msg::Refused(Target::Thumbnail, "no memory".to_owned()));
    let next = effects.iter().find_map(|effect| match effect {
        Effect::Derive(past) => Some(past.at),
        _ => None,
    });
    assert_eq!(next, Some(2), "the next picture");
}

#[test]
fn pictures_show_the_working_view_and_are_made_again_for_another() {
    let mut app = changed();
    let first = opens_page(&mut app);
    let is_own = |job: &Job| job.camera == job.scene.camera;
    assert!(first.traced.iter().all(is_own));
    press(&mut app, "<Esc>vl<Esc>");
    let moved = opens_page(&mut app);
    assert_eq!(moved.traced.len(), first.traced.len());
    assert!(
        moved
            .traced
            .iter()
            .all(|job| Some(job.camera) == app.camera())
    );
    assert_ne!(app.camera(), app.own_camera());
}

#[test]
fn without_colours_and_in_little_room_nothing_is_traced() {
    let mut app = changed();
    app.thumbnails.has_colours = false;
    assert!(opens_page(&mut app).derived.is_empty());
    press(&mut app, "<Esc>");
    app.thumbnails.has_colours = true;
    app.update(Msg::Resize(80, 10));
    assert!(opens_page(&mut app).derived.is_empty());
}

#[test]
fn in_a_large_text_only_the_selected_step_has_a_picture() {
    let comment = "x".repeat(17 << 20);
    let mut app = opened(&format!("{SCENE}// {comment}\n")).0;
    app.thumbnails.has_colours = true;
    press(&mut app, "ggjjjjel<Esc>");
    assert_eq!(opens_page(&mut app).derived, [1]);
    let effects = press(&mut app, "k");
    assert_eq!(perform(&mut app, effects).derived, [0]);
}

#[test]
fn enter_goes_to_a_step_and_undo_and_redo_go_on_from_there() {
    let mut app = changed();
    let texts: Vec<_> = (0..4).map(|at| app.document.timeline().text(at)).collect();
    for (keys, at, said) in [
        ("Ugg<Enter>", 0, "3 steps undone, to: as opened"),
        (
            "<Ctrl-r>",
            1,
            "redone: object 1 (sphere) centre x: 0 → 0.2, 2 nudges",
        ),
        (
            "UG<Enter>",
            3,
            "2 steps redone, to: deleted object 2 (sphere)",
        ),
        ("Uk<Enter>", 2, "undone: deleted object 2 (sphere)"),
        ("U<Enter>", 2, "this is the present text"),
        ("u", 1, "undone: duplicated object 2 (sphere)"),
        ("U/dupl<Enter>", 2, "redone: duplicated object 2 (sphere)"),
        (
            "Uuu",
            0,
            "undone: object 1 (sphere) centre x: 0 → 0.2, 2 nudges",
        ),
    ] {
        press(&mut app, keys);
        assert_eq!(app.document.text(), texts[at].as_str(), "{keys}");
        assert_eq!((words(&app), app.document.present()), (said, at), "{keys}");
        assert_eq!(app.error_count(), 0);
        let drawn = app.scene.as_ref().map(|scene| scene.objects.len());
        assert_eq!(drawn, Some([2, 2, 3, 2][at]), "{keys}");
    }
    let mut app = open(SCENE);
    press(&mut app, ":history<Enter>");
    assert_eq!(words(&app), "nothing has been changed yet");
    assert!(app.open_steps().is_none());
}

#[test]
fn a_random_walk_finds_every_text_where_it_was() {
    let mut state = 5_u64;
    let mut below = |bound: usize| {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (state >> 33) as usize % bound
    };
    let keys = [
        "jd",
        "kD",
        "J",
        "yp",
        "mx1<Enter>",
        "s2<Enter>",
        "el<Esc>",
        "elL<Esc>",
        "ej3<Enter><Esc>",
        "abox<Enter>",
        "u",
        "<Ctrl-r>",
        "Ugg<Enter>",
        "UG<Enter>",
        "Ukk<Enter>",
        "Ujjj<Enter>",
    ];
    let mut app = changed();
    let mut known: BTreeMap<StateId, String> = BTreeMap::new();
    for _ in 0..300 {
        let keys = keys[below(keys.len())];
        press(&mut app, keys);
        let ids: Vec<_> = app.document.states().map(|state| state.id).collect();
        let present = app.document.present();
        let text = app.document.text().to_owned();
        let timeline = app.document.timeline();
        for (at, id) in ids.iter().enumerate() {
            let text = timeline.text(at);
            let before = known.entry(*id).or_insert_with(|| text.to_string());
            assert_eq!(*text, *before, "{keys}: text {at}");
        }
        assert_eq!(known[&ids[present]], text, "{keys}");
        let far = below(ids.len());
        app.go_to_state(far);
        assert_eq!(app.document.text(), known[&ids[far]], "{keys}: to {far}");
        app.go_to_state(present);
        assert_eq!(app.document.text(), text, "{keys}: back");
    }
}
