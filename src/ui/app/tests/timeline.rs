//! The page of the undo history.

use std::collections::BTreeMap;

use super::scripts::{Session, ray, scene, scripts};
use super::*;
use crate::app::{history, text};
use crate::history_scene::NoPicture;
use ::text::{Edit, Span};
use document::StateId;

/// A text on a terminal with colours.
fn coloured(text: &str) -> Session {
    let mut session = scene("scene.ray", text).session();
    session.app.shared.has_colours = true;
    session
}

/// The scene on a terminal with colours after three steps.
fn changed() -> Session {
    let mut session = coloured(SCENE);
    session.run("ggjjjjell<Esc>jDk\nd | step 3");
    session
}

scripts! {
    the_page_lists_every_step_and_asks_for_each_picture_once: changed().run(r"
        u
        U | context History
        | page-steps 2 steps back: as opened; 1 step back: object 1 (sphere) centre x: 0 → 0.2, 2 nudges; >now: duplicated object 2 (sphere); 1 step ahead: deleted object 2 (sphere)
        // The present text first, then its neighbours, and at last the large picture.
        @thumbnails | derived 2: 3, 1: 2, 3: 2, 0: 2, 2: 3
        // Another text is selected: it lacks only the large picture.
        j
        @thumbnails | derived 3: 2
        <Esc>       | not does stop thumbnail
        U
        @thumbnails | not derived
    ");

    closing_the_page_stops_what_is_under_way_and_changes_nothing: {
        for close in ["<Esc>", "q", "U"] {
            changed().run(&format!(r"
                @note before text
                U        | thumbnails
                {close}  | does once stop thumbnail | not thumbnails
                // Nothing is traced.
                @derived | does only free | text before
            "));
        }
        changed().run(r"
            U
            @derived | does trace thumbnail
            @started thumbnail 7
            <Esc>
            // A frame after the end is not taken for the picture.
            @frame thumbnail 7
            U        | does derive
        ");
    };

    a_text_with_errors_and_a_refused_picture_are_not_asked_for_again: {
        let mut session = changed();
        session.app.shared.document.edit(&[Edit {
            span: Span::at(0),
            text: "broken ".to_owned(),
        }]);
        text::relower(&mut session.app.shared);
        session.run("u\nU\n@thumbnails | derived …, 4, …");
        let last = session.app.shared.document.states().nth(4).expect("a step");
        let thumbnail = session.app.thumbnails.get(last.id, Rank::Row);
        assert_eq!(thumbnail, Some(&Err(NoPicture::Errors)));
        session.run("<Esc>");
        session.app.thumbnails.forget();
        session.run("U | does derive | > @cannot thumbnail no memory | does once derive | does derive 2");
    };

    pictures_show_the_working_view_and_are_made_again_for_another: changed().run(r"
        U
        @thumbnails | derived 3: 2, 2: 3, 1: 2, 0: 2, 3: 2
        <Esc>vl<Esc>U
        @thumbnails | derived 3: 2 as seen, 2: 3 as seen, 1: 2 as seen, 0: 2 as seen, 3: 2 as seen
        // Another integrator traces others, too.
        <Esc>PU
        @thumbnails | derived 3: 2 as seen, 2: 3 as seen, 1: 2 as seen, 0: 2 as seen, 3: 2 as seen
    ");

    without_colours_and_in_little_room_nothing_is_traced: {
        let mut session = changed();
        session.app.shared.has_colours = false;
        session.run("U | context History | > @thumbnails | not derived | > <Esc>");
        session.app.shared.has_colours = true;
        session.run("@resize 80 10\nU | context History | > @thumbnails | not derived");
    };

    in_a_large_text_only_the_selected_step_has_a_picture: {
        let comment = "x".repeat(17 << 20);
        coloured(&format!("{SCENE}// {comment}\n")).run(r"
            ggjjjjel<Esc>U
            @thumbnails | derived 1: 2
            k
            @thumbnails | derived 0: 2
        ");
    };

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
    let mut below = random(5);
    let keys = "jd kD J yp mx1<Enter> s2<Enter> el<Esc> elL<Esc> ej3<Enter><Esc> abox<Enter> u <Ctrl-r> \
                Ugg<Enter> UG<Enter> Ukk<Enter> Ujjj<Enter>";
    let keys: Vec<_> = keys.split(' ').collect();
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
