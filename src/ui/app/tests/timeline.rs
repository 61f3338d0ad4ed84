//! The page of the undo history.

use std::collections::{BTreeMap, VecDeque};
use std::sync::Arc;

use super::rows::{Session, ray, scene, scripts};
use super::*;
use crate::document::StateId;
use crate::language::Source;
use crate::render::{Frame, Job};
use crate::scene::{Meshes, Size};
use crate::text::{Edit, Span};
use crate::ui::app::{history, text};
use crate::ui::history_scene::{HistoryScene, HistoryText, NoPicture};
use crate::ui::keymap::Context;
use crate::ui::msg::Target;

/// The scene on a terminal with colours after three steps.
fn changed() -> Session {
    let mut session = scene("scene.ray", SCENE).session();
    session.app.shared.has_colours = true;
    session.run("ggjjjjell<Esc>jDk\nd | step 3");
    session
}

/// What has been asked of the threads behind the page.
#[derive(Debug, Default)]
struct Asked {
    derived: Vec<usize>,
    traced: Vec<Job>,
    stops: usize,
}

/// Does what the effects of the last step and those that follow ask for, as the threads would.
fn perform(session: &mut Session) -> Asked {
    let mut asked = Asked::default();
    let mut left = VecDeque::from(std::mem::take(&mut session.effects));
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
            left.extend(session.app.update(msg));
        }
    }
    asked
}

fn traced(generation: u64, size: Size) -> Msg {
    let whole = Frame {
        generation,
        ..frame_of(size, vec![0; size.pixels()])
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

/// Opens the page after other keys.
fn opens_page(session: &mut Session) -> Asked {
    session.run("U | context Steps");
    perform(session)
}

/// The text that is to be derived.
fn past(session: &Session) -> Box<HistoryText> {
    let past = session.effects.iter().find_map(|effect| match effect {
        Effect::Derive(past) => Some(past.clone()),
        _ => None,
    });
    past.expect("a scene is asked for")
}

#[test]
fn the_page_lists_every_step_and_asks_for_each_picture_once() {
    let mut session = changed();
    session.run("u");
    let asked = opens_page(&mut session);
    let shared = &session.app.shared;
    let page = shared.overlays.page(Context::Steps).expect("it is open");
    let rows: Vec<_> = page.shown().into_iter().map(|(_, name)| name).collect();
    let expected = "as opened|object 1 (sphere) centre x: 0 → 0.2, 2 nudges|\
                    duplicated object 2 (sphere)|deleted object 2 (sphere)";
    assert_eq!(rows.join("|"), expected);
    let when: Vec<_> = (0..4)
        .map(|at| history::when(&shared.document, at))
        .collect();
    assert_eq!(when, ["2 steps back", "1 step back", "now", "1 step ahead"]);
    assert_eq!(page.filter.at, 2);
    // The present text first, then its neighbours, and at last the large picture.
    assert_eq!(asked.derived, [2, 1, 3, 0, 2]);
    let objects = asked.traced.iter().map(|job| job.scene.objects.len());
    assert_eq!(objects.collect::<Vec<_>>(), [3, 2, 2, 2, 3]);
    // Another text is selected: it lacks only the large picture.
    assert_eq!(perform(session.run("j")).derived, [3]);
    assert_eq!(
        perform(session.run("<Esc>")).stops,
        0,
        "nothing is under way"
    );
    let again = opens_page(&mut session);
    assert_eq!((again.derived.len(), again.traced.len()), (0, 0));
}

#[test]
fn closing_the_page_stops_what_is_under_way_and_changes_nothing() {
    for close in ["<Esc>", "q", "U"] {
        let mut session = changed();
        session.run("@note before text\nU | thumbnails");
        let past = past(&session);
        assert_eq!(perform(session.run(close)).stops, 1, "{close}");
        session.run("| not thumbnails");
        let late = session
            .app
            .update(Msg::Derived(past.ticket, scene_of(&past)));
        assert!(
            matches!(late[..], [Effect::Free(_)]),
            "{close}: nothing is traced: {late:?}"
        );
        session.run("| text before");
    }
    let mut session = changed();
    session.run("U");
    let past = past(&session);
    session.effects = session
        .app
        .update(Msg::Derived(past.ticket, scene_of(&past)));
    session.run("| does trace thumbnail | > @started thumbnail 7 | > <Esc>");
    let size = Size {
        width: 4,
        height: 3,
    };
    session.app.update(traced(7, size));
    // A frame after the end is not taken for the picture.
    session.run("U | does derive");
}

#[test]
fn a_text_with_errors_and_a_refused_picture_are_not_asked_for_again() {
    let mut session = changed();
    session.app.shared.document.edit(&[Edit {
        span: Span::at(0),
        text: "broken ".to_owned(),
    }]);
    text::relower(&mut session.app.shared);
    session.run("u");
    assert!(opens_page(&mut session).derived.contains(&4));
    let last = session.app.shared.document.states().nth(4);
    let id = last.expect("it has steps").id;
    let thumbnail = session.app.thumbnails.get(id, Rank::Row);
    assert_eq!(thumbnail, Some(&Err(NoPicture::Errors)));
    session.run("<Esc>");
    session.app.thumbnails.forget();
    session
        .run("U | does derive | > @cannot thumbnail no memory | does once derive | does derive 2");
}

#[test]
fn pictures_show_the_working_view_and_are_made_again_for_another() {
    let mut session = changed();
    let first = opens_page(&mut session);
    let is_own = |job: &Job| job.camera == job.scene.camera;
    assert!(first.traced.iter().all(is_own));
    session.run("<Esc>vl<Esc>");
    let moved = opens_page(&mut session);
    assert_eq!(moved.traced.len(), first.traced.len());
    let camera = session.app.shared.camera();
    assert!(moved.traced.iter().all(|job| Some(job.camera) == camera));
    assert_ne!(camera, session.app.shared.own_camera());
}

#[test]
fn without_colours_and_in_little_room_nothing_is_traced() {
    let mut session = changed();
    session.app.shared.has_colours = false;
    assert!(opens_page(&mut session).derived.is_empty());
    session.run("<Esc>");
    session.app.shared.has_colours = true;
    session.run("@resize 80 10");
    assert!(opens_page(&mut session).derived.is_empty());
}

#[test]
fn in_a_large_text_only_the_selected_step_has_a_picture() {
    let comment = "x".repeat(17 << 20);
    let mut session = scene("scene.ray", &format!("{SCENE}// {comment}\n")).session();
    session.app.shared.has_colours = true;
    session.run("ggjjjjel<Esc>");
    assert_eq!(opens_page(&mut session).derived, [1]);
    assert_eq!(perform(session.run("k")).derived, [0]);
}

scripts! {
    enter_goes_to_a_step_and_undo_and_redo_go_on_from_there: {
        let mut session = changed();
        for at in 0..4 {
            let text = session.app.shared.document.timeline().text(at).to_string();
            session.call(&at.to_string(), &text);
        }
        session.run(r"
            Ugg<Enter> | step 0 | text 0 | not errors | objects 2 | says 3 steps undone, to: as opened
            <Ctrl-r>   | step 1 | text 1 | not errors | objects 2
            | says redone: object 1 (sphere) centre x: 0 → 0.2, 2 nudges
            UG<Enter>  | step 3 | text 3 | not errors | objects 2
            | says 2 steps redone, to: deleted object 2 (sphere)
            Uk<Enter>  | step 2 | text 2 | not errors | objects 3 | says undone: deleted object 2 (sphere)
            U<Enter>   | step 2 | text 2 | not errors | objects 3 | says this is the present text
            u          | step 1 | text 1 | not errors | objects 2 | says undone: duplicated object 2 (sphere)
            U/dupl<Enter> | step 2 | text 2 | not errors | objects 3
            | says redone: duplicated object 2 (sphere)
            Uuu        | step 0 | text 0 | not errors | objects 2
            | says undone: object 1 (sphere) centre x: 0 → 0.2, 2 nudges
            // The cursor of the page has gone along.
            <Ctrl-r><Enter> | step 1 | text 1 | says this is the present text
        ");
    };

    there_is_no_history_before_the_first_change: ray().play(r"
        :history<Enter> | says nothing has been changed yet | not page
    ");
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
    let app = &mut changed().app;
    let mut known: BTreeMap<StateId, String> = BTreeMap::new();
    for _ in 0..300 {
        let keys = keys[below(keys.len())];
        press(app, keys);
        let ids: Vec<_> = app.shared.document.states().map(|state| state.id).collect();
        let present = app.shared.document.present();
        let text = app.shared.document.text().to_owned();
        let timeline = app.shared.document.timeline();
        for (at, id) in ids.iter().enumerate() {
            let text = timeline.text(at);
            let before = known.entry(*id).or_insert_with(|| text.to_string());
            assert_eq!(*text, *before, "{keys}: text {at}");
        }
        assert_eq!(known[&ids[present]], text, "{keys}");
        let far = below(ids.len());
        history::go_to_state(&mut app.shared, far);
        assert_eq!(
            app.shared.document.text(),
            known[&ids[far]],
            "{keys}: to {far}"
        );
        history::go_to_state(&mut app.shared, present);
        assert_eq!(app.shared.document.text(), text, "{keys}: back");
    }
}
