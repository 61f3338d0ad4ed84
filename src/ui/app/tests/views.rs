//! Moving the camera, and where its views go.

use glam::DVec3;

use super::scripts::{Session, Stage, listed, ray, scene, scripts};
use super::*;

/// The stage of a scene whose camera looks along −z from 4 away.
fn ahead<'s>() -> Stage<'s> {
    listed(&format!("// view: eye 0 0 4 target 0 0 0\n{SCENE}"))
}

scripts! {
    a_moved_view_is_not_lost_in_silence: {
        ray().table(r"
            vh<Esc>{1} | not does quit | asks {2} | loses the moved view is not saved | text opened
        ", r"
            q           | quit
            :q<Enter>   | quit
            <Ctrl-c>    | quit
            :wq<Enter>  | quit
            :new<Enter> | new
        ");
        ray().each(r"
            vhqy        | does quit
            vh:q!<Enter> | does quit
            vh0q        | does quit
            vhSuq       | does quit
            vhqn0q      | does quit
        ");
    };

    a_view_saved_under_a_name_is_not_lost: {
        let mut session = ray().session();
        session.run(r"
            vh:view save a<Enter>q | loses scene.ray has unsaved edits
            w
            @saved                 | does quit
        ");
        listed(session.app.shared.document.text()).play(r"
            vV<Enter> | moved
            q         | does quit

            vV<Enter>lq | not does quit
        ");
    };

    the_view_is_written_and_saved_before_leaving_if_asked: ray().table(r"
        {1}    | answers {2}
        S      | not asks | does save scene.ray | text // view: eye … | writes mine
        @saved | {3} quit | not moved
    ", r"
        vhq                 | Syn  | does
        vh<Esc>jjjel<Esc>q  | ywSn | does
        vh:new<Enter>       | Syn  | not does
    ");

    saving_before_leaving_asks_only_about_the_view_then: ray().play(r"
        vh<Esc>jjjel<Esc>qw
        @saved | not does quit | loses the moved view is not saved | says wrote scene.ray | answers Syn
        w      | not does | says press S, y or n
        y      | does quit
    ");

    a_view_that_cannot_be_written_is_asked_about_again: ray().play(r#"
        vh
        @file twice "1 1" | errors
        qS                | not does quit | says cannot save the view… | asks quit
    "#);

    saving_mentions_a_moved_view: ray().play(r"
        vhw    | says nothing to save; the moved view is not saved: S writes it
        <Esc>jjjel<Esc>w
        @saved | says wrote scene.ray; the moved view is not saved: S in VIEW writes it
    ");

    a_camera_that_would_see_nothing_stays_and_says_so: listed(&format!(
        "// view: eye 0 0 9 target 5 5 5\n{SCENE}"
    ))
    .play("jjvo | says the camera cannot move any further | not view-name");

    flying_turns_in_place_moves_along_and_rolls: ahead().each(r"
        // By 5°: 4 · sin 5° is 0.3486, and 4 − 4 · cos 5° is 0.0152.
        vFh  | view eye 0 0 4 target -0.3486 0 0.0152 up 0 1 0
        vFl  | view eye 0 0 4 target 0.3486 0 0.0152 up 0 1 0
        vFk  | view eye 0 0 4 target 0 0.3486 0.0152 up 0 1 0
        vFK  | view eye 0 0 3.6 target 0 0 -0.4 up 0 1 0
        vF+  | view eye 0 0 3.6 target 0 0 -0.4 up 0 1 0
        vFJ- | view eye 0 0 4.8 target 0 0 0.8 up 0 1 0
        vFH  | view eye -0.2 0 4 target -0.2 0 0 up 0 1 0
        vF,  | view eye 0 0 4 target 0 0 0 up -0.0872 0.9962 0
        vF.  | view eye 0 0 4 target 0 0 0 up 0.0872 0.9962 0
    ");

    flying_and_orbiting_alternate_and_turning_back_restores_the_view: {
        let mut session = ahead().session();
        session.run(r"
            v           | mode VIEW
            F           | mode VIEW FLY
            hhkljl,,..F | mode VIEW | view eye 0 0 4 target 0 0 0 up 0 1 0
        ");
        // Never over the pole.
        session.run(&format!("F{}", "k".repeat(60)));
        let top = session.app.shared.camera().expect("a camera");
        assert!(0.99 < (top.target - top.eye).normalize().y && top.target.z < 4.0);
    };

    the_mouse_turns_and_advances_in_flight: {
        let mut session = ahead().session();
        session.run("vF\n@down screen 20,10\n@drag screen 24,10");
        let camera = session.app.shared.camera().expect("a camera");
        // The picture follows the pointer to the right.
        assert_eq!(camera.eye, DVec3::new(0.0, 0.0, 4.0));
        assert!(camera.target.x < -0.1 && camera.target.y.abs() < 1e-9);
        session.run("@up screen 24,10\n@wheel screen 20,10");
        assert!(session.app.shared.camera().expect("a camera").eye.z < 3.7);
    };

    a_rolled_view_is_written_as_it_is_on_screen: for (name, text) in SCENES {
        let mut session = scene(name, text).session();
        session.run("v,,hF.kK | moved");
        let view = session.app.shared.camera().expect("it was moved");
        session.run("S | not moved");
        let own = session.app.shared.camera().expect("a scene");
        for (on_screen, written) in
            [(view.eye, own.eye), (view.target, own.target), (view.up, own.up)]
        {
            assert!((on_screen - written).length() < 1e-9, "{name}: {on_screen} {written}");
        }
        session.run("u | text opened");
    };

    views_are_saved_listed_visited_and_deleted: for (name, text) in SCENES {
        scene(name, text).play(r"
            @note own camera
            vV            | says no saved views: :view save NAME saves this one
            h:view save front  door<Enter> | says saved view front door to the scene
            @note front stands
            kk,:view save above<Enter>0 | camera {own} | views front door, above | not errors
            V<Enter>      | says view front door | stands {front} | not page
            0Vabo<Enter>  | says view above
            Vjk
            d             | views above | page
            // The last one closes it.
            d             | not page | text opened
            uu            | views front door, above
            uu            | text opened
        ");
    };

    a_view_saved_again_is_replaced_and_a_bad_name_refused: ray().play(r"
        v:view save a<Enter>l:view save a<Enter>V | views a
        @note saved camera
        <Esc>v0V<Enter>        | camera {saved} | text {opened}…
        :view save a:b<Enter>  | says a view's name must not contain a colon
    ");

    a_listed_view_that_vanishes_from_the_file_vanishes_from_the_list: listed(&format!(
        "{SCENE}// view a: eye 0 0 9 target 0 0 0\n"
    )).with("without", SCENE).play(r"
        vV            | page
        @file without | not page
    ");

    a_light_is_looked_from_if_it_has_a_place_or_a_direction: {
        ray().after("ggj\n@note before target").each(r"
            jjvo                 | says the view from light 1 | view eye 5 5 5 … | target {before}
            jj:view light<Enter> | says the view from light 1 | view eye 5 5 5 … | target {before}
            vo                   | says select a light to look from
        ");
        let text = Language::Dat.template();
        let text = text.replace("1 pnt  6 -5 8    0 0 0", "1 inf  0 0 0 0 0 -1");
        let mut session = scene("scene.dat", &text).session();
        session.run("[light 1] vo");
        let camera = session.app.shared.camera().expect("a camera");
        let bounds = session.app.shared.scene.as_ref().expect("a scene").bounds();
        assert!((camera.target - bounds.centre()).length() < 1e-3);
        let offset = camera.eye - camera.target;
        assert!(bounds.half_diagonal() < offset.z && offset.x.abs() < 1e-3, "{offset}");
        session.run("[light 3] o | says ambient light…");
    };

    a_list_sets_several_fields_of_the_view_in_one_step: {
        ray().play(r#"
            e1 2 9 0 0 1<Enter>           | text "// view: eye 1 2 9 target 0 0 1\n{opened}"
            <Esc>u                        | text opened
        "#);
        listed(&format!("// view: eye 0 0 4.0 target 0 0 0\n{SCENE}")).play(r"
            e1 2 9.0 0 0 1<Enter>         | text eye 0 0 4.0 target 0 0 0 => eye 1 2 9.0 target 0 0 1
            <Esc>u                        | text opened

            e1 2 9 0 0 1 0 1 0.5<Enter>
            | text eye 0 0 4.0 target 0 0 0 => eye 1 2 9.0 target 0 0 1 up 0 1 0.5
            <Esc>u                        | text opened
        ");
    };

    a_list_sets_several_fields_of_the_moved_view: ahead().play(r"
        vh<Esc>ek<Esc>e1 2 9 0 0 1<Enter> | text opened | view eye 1 2 9 target 0 0 1 …
        @note set camera
        1 2 9 1 2 9<Enter>                | refused …must differ… | camera {set}
    ");
}

#[test]
fn dragging_with_another_button_or_ctrl_pans_so_that_the_scene_follows() {
    for button in ["right", "middle", "ctrl"] {
        let mut session = ray().session();
        session.run("v");
        let before = session.app.shared.camera().expect("there is a camera");
        let (cells, size) = session.app.shared.raster().expect("there is room");
        let seen = |session: &Session| {
            let camera = session.app.shared.camera().expect("there is a camera");
            render::project_point(before.target, &camera, size).expect("it is in front")
        };
        let [x, y] = seen(&session);
        let (column, row) = (cells.width / 2, cells.height / 2);
        for (event, right, down) in [("down", 0, 0), ("drag", 4, 1), ("drag", 6, 3), ("up", 6, 3)] {
            let (column, row) = (column + right, row + down);
            session.run(&format!("@{event} picture {column},{row} {button}"));
        }
        let [after_x, after_y] = seen(&session);
        // Two pixels in a row of cells.
        let off = (after_x - x - 6.0).abs().max((after_y - y - 6.0).abs());
        assert!(off < 0.05, "{button} {off}");
        let after = session.app.shared.camera().expect("there is a camera");
        let turned = (after.eye - after.target) - (before.eye - before.target);
        assert!(turned.length() < 1e-3, "{button} {turned}");
    }
}
