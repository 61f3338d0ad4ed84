//! Moving the camera, and where its views go.

use crossterm::event::{KeyModifiers, MouseButton, MouseEvent, MouseEventKind};
use glam::DVec3;

use super::*;

fn quits(effects: &[Effect]) -> bool {
    wants(effects, |effect| matches!(effect, Effect::Quit))
}

#[test]
fn a_moved_view_is_not_lost_in_silence() {
    for said in ["q", ":q<Enter>", "<Ctrl-c>", ":wq<Enter>", ":new<Enter>"] {
        let mut app = open(SCENE);
        assert!(
            !quits(&press(&mut app, &format!("vh<Esc>{said}"))),
            "{said}"
        );
        assert!(
            matches!(app.overlays.dialog, Some(Dialog::Leave(_))),
            "{said}"
        );
        let losses = "the moved view is not in the text";
        assert_eq!(app.losses().as_deref(), Some(losses), "{said}");
        assert_eq!(app.document.text(), SCENE);
    }
    for said in ["vhqy", "vh:q!<Enter>", "vh0q", "vhSuq", "vhqn0q"] {
        assert!(quits(&press(&mut open(SCENE), said)), "{said}");
    }
}

#[test]
fn a_view_saved_under_a_name_is_not_lost() {
    let mut app = open(SCENE);
    press(&mut app, "vh:view save a<Enter>q");
    assert_eq!(app.losses().as_deref(), Some("scene.ray has unsaved edits"));
    let text = app.document.shared_text();
    press(&mut app, "w");
    assert!(quits(&saving::saved(&mut app, 1, "scene.ray", &text)));

    let mut app = open(&text);
    press(&mut app, "vV<Enter>");
    assert!(app.pictures.view.is_some() && quits(&press(&mut app, "q")));
    assert!(!quits(&press(&mut open(&text), "vV<Enter>lq")));
}

/// The keys that answer the open question.
fn answers(app: &App) -> Vec<String> {
    app.hints().into_iter().map(|(key, _)| key).collect()
}

#[test]
fn the_view_is_written_and_saved_before_leaving_if_asked() {
    for (said, first) in [
        ("vhq", "Syn"),
        ("vh<Esc>jjjel<Esc>q", "ywSn"),
        ("vh:new<Enter>", "Syn"),
    ] {
        let mut app = open(SCENE);
        press(&mut app, said);
        assert_eq!(answers(&app).concat(), first, "{said}");
        let effects = press(&mut app, "S");
        assert!(app.overlays.dialog.is_none(), "{said}");
        assert!(wants(&effects, |effect| matches!(
            effect,
            Effect::Save { .. }
        )));
        let text = app.document.shared_text();
        assert!(text.starts_with("// view: eye "), "{said}");
        let effects = saving::saved(&mut app, 1, "scene.ray", &text);
        assert_eq!(quits(&effects), !said.contains("new"), "{said}");
        assert!(app.pictures.view.is_none(), "{said}");
    }
}

#[test]
fn saving_before_leaving_asks_only_about_the_view_then() {
    let mut app = open(SCENE);
    press(&mut app, "vh<Esc>jjjel<Esc>qw");
    let text = app.document.shared_text();
    assert!(!quits(&saving::saved(&mut app, 1, "scene.ray", &text)));
    let losses = "the moved view is not in the text";
    assert_eq!(app.losses().as_deref(), Some(losses));
    assert_eq!(words(&app), "wrote scene.ray");
    assert_eq!(answers(&app), ["S", "y", "n"]);
    assert!(press(&mut app, "w").is_empty());
    assert_eq!(words(&app), "answer the question first: S, y, n");
    assert!(quits(&press(&mut app, "y")));
}

#[test]
fn a_view_that_cannot_be_written_is_asked_about_again() {
    let mut app = open(SCENE);
    press(&mut app, "vh");
    let broken = opened("1 1").0;
    app.diagnostics = broken.diagnostics;
    assert!(0 < app.error_count());
    let effects = press(&mut app, "qS");
    assert!(!quits(&effects) && words(&app).starts_with("cannot save the view"));
    assert!(matches!(
        app.overlays.dialog,
        Some(Dialog::Leave(AfterLeaving::Quit))
    ));
}

#[test]
fn saving_mentions_a_moved_view() {
    let mut app = open(SCENE);
    press(&mut app, "vhw");
    let words_in_view = "; the moved view is not in the text: S writes it";
    assert_eq!(words(&app), format!("nothing to save{words_in_view}"));
    press(&mut app, "<Esc>jjjel<Esc>w");
    let text = app.document.shared_text();
    saving::saved(&mut app, 1, "scene.ray", &text);
    assert_eq!(
        words(&app),
        "wrote scene.ray; the moved view is not in the text: S in VIEW writes it"
    );
}

/// A scene whose camera looks along −z from 4 away.
fn ahead() -> App {
    open(&format!("// view: eye 0 0 4 target 0 0 0\n{SCENE}"))
}

#[test]
fn flying_turns_in_place_moves_along_and_rolls() {
    let (sin, cos) = 5.0_f64.to_radians().sin_cos();
    let (eye, up) = ([0., 0., 4.], [0., 1., 0.]);
    let cases: [(&str, [[f64; 3]; 3]); 9] = [
        ("h", [eye, [-4. * sin, 0., 4. - 4. * cos], up]),
        ("l", [eye, [4. * sin, 0., 4. - 4. * cos], up]),
        ("k", [eye, [0., 4. * sin, 4. - 4. * cos], up]),
        ("K", [[0., 0., 3.6], [0., 0., -0.4], up]),
        ("+", [[0., 0., 3.6], [0., 0., -0.4], up]),
        ("J-", [[0., 0., 4.8], [0., 0., 0.8], up]),
        ("H", [[-0.2, 0., 4.], [-0.2, 0., 0.], up]),
        (",", [eye, [0.; 3], [-sin, cos, 0.]]),
        (".", [eye, [0.; 3], [sin, cos, 0.]]),
    ];
    for (said, expected) in cases {
        let mut app = ahead();
        press(&mut app, &format!("vF{said}"));
        let camera = app.camera().expect("a camera");
        let found = [camera.eye, camera.target, camera.up];
        for (found, expected) in found.into_iter().zip(expected.map(DVec3::from)) {
            assert!(
                (found - expected).length() < 1e-4,
                "{said}: {found} {expected}"
            );
        }
    }
}

#[test]
fn flying_and_orbiting_alternate_and_turning_back_restores_the_view() {
    let mut app = ahead();
    press(&mut app, "v");
    assert_eq!(app.mode, Mode::View);
    press(&mut app, "F");
    assert_eq!(app.mode, Mode::Fly);
    let before = app.camera().expect("a camera");
    press(&mut app, "hhkljl,,..F");
    assert_eq!(app.mode, Mode::View);
    let after = app.camera().expect("a camera");
    assert_eq!(before.eye, after.eye);
    assert!((before.target - after.target).length() < 1e-4);
    assert!((before.up - after.up).length() < 1e-4);
    // Never over the pole.
    press(&mut app, &format!("F{}", "k".repeat(60)));
    let top = app.camera().expect("a camera");
    assert!(0.99 < (top.target - top.eye).normalize().y && top.target.z < 4.0);
}

#[test]
fn the_mouse_turns_and_advances_in_flight() {
    let mouse = |kind, column| {
        Msg::Mouse(MouseEvent {
            kind,
            column,
            row: 10,
            modifiers: KeyModifiers::NONE,
        })
    };
    let mut app = ahead();
    press(&mut app, "vF");
    app.update(mouse(MouseEventKind::Down(MouseButton::Left), 20));
    app.update(mouse(MouseEventKind::Drag(MouseButton::Left), 24));
    let camera = app.camera().expect("a camera");
    // The picture follows the pointer to the right.
    assert_eq!(camera.eye, DVec3::new(0.0, 0.0, 4.0));
    assert!(camera.target.x < -0.1 && camera.target.y.abs() < 1e-9);
    app.update(mouse(MouseEventKind::Up(MouseButton::Left), 24));
    app.update(mouse(MouseEventKind::ScrollUp, 20));
    assert!(app.camera().expect("a camera").eye.z < 3.7);
}

#[test]
fn a_rolled_view_is_written_as_it_is_on_screen() {
    for (name, text) in making::SCENES {
        let mut app = opened_as(name, text).0;
        press(&mut app, "v,,hF.kK");
        let view = app.pictures.view.expect("the camera was moved");
        press(&mut app, "S");
        assert_eq!(app.pictures.view, None, "{name}: {}", words(&app));
        let own = app.scene.as_ref().expect("a scene").camera;
        for (on_screen, written) in [
            (view.eye, own.eye),
            (view.target, own.target),
            (view.up, own.up),
        ] {
            assert!(
                (on_screen - written).length() < 1e-9,
                "{name}: {on_screen} {written}"
            );
        }
        press(&mut app, "u");
        assert_eq!(app.document.text(), text);
    }
}

/// The names of the saved views of the text.
fn saved_views(app: &App) -> Vec<String> {
    let views = app.source().saved_views();
    views.into_iter().map(|view| view.name).collect()
}

#[test]
fn views_are_saved_listed_visited_and_deleted() {
    for (name, text) in making::SCENES {
        let mut app = opened_as(name, text).0;
        let own = app.camera().expect("a camera");
        press(&mut app, "vV");
        assert_eq!(
            words(&app),
            "no saved views: :view save NAME saves this one"
        );
        press(&mut app, "h:view save front  door<Enter>");
        assert_eq!(words(&app), "view front door is now in the scene's text");
        let front = app.pictures.view.expect("the camera was moved");
        press(&mut app, "kk,:view save above<Enter>0");
        assert_eq!(app.camera(), Some(own), "{name}");
        assert_eq!(saved_views(&app), ["front door", "above"]);
        assert_eq!(app.error_count(), 0, "{name}");

        press(&mut app, "V<Enter>");
        assert_eq!(words(&app), "view front door");
        let visited = app.pictures.view.expect("a view");
        assert_eq!([visited.eye, visited.up], [front.eye, front.up]);
        assert!(app.overlays.page.is_none());
        press(&mut app, "0Vabo<Enter>");
        assert_eq!(words(&app), "view above");
        press(&mut app, "Vjk");
        press(&mut app, "d");
        assert_eq!(saved_views(&app), ["above"]);
        assert!(app.overlays.page.is_some());
        press(&mut app, "d");
        assert!(app.overlays.page.is_none(), "the last one closes it");
        assert_eq!(app.document.text(), text);
        press(&mut app, "uu");
        assert_eq!(saved_views(&app), ["front door", "above"]);
        press(&mut app, "uu");
        assert_eq!(app.document.text(), text, "{name}");
    }
}

#[test]
fn a_view_saved_again_is_replaced_and_a_bad_name_refused() {
    let mut app = open(SCENE);
    press(&mut app, "v:view save a<Enter>l:view save a<Enter>V");
    assert_eq!(saved_views(&app), ["a"]);
    let view = app.pictures.view;
    press(&mut app, "<Esc>v0V<Enter>");
    assert_eq!(app.pictures.view, view);
    assert!(app.document.text().starts_with(SCENE));
    press(&mut app, ":view save a:b<Enter>");
    assert_eq!(words(&app), "a view's name must not contain a colon");
}

#[test]
fn a_listed_view_that_vanishes_from_the_file_vanishes_from_the_list() {
    let text = format!("{SCENE}// view a: eye 0 0 9 target 0 0 0\n");
    let mut app = open(&text);
    press(&mut app, "vV");
    outside(&mut app, SCENE);
    assert!(app.overlays.page.is_none());
}

#[test]
fn a_light_is_looked_from_if_it_has_a_place_or_a_direction() {
    for said in ["jjvo", "jj:view light<Enter>"] {
        let mut app = open(SCENE);
        let before = app.camera().expect("a camera");
        press(&mut app, said);
        let after = app.camera().expect("a camera");
        assert_eq!(
            (after.eye, after.target),
            (DVec3::splat(5.0), before.target)
        );
        assert_eq!(words(&app), "the view from light 1");
    }
    let mut app = open(SCENE);
    press(&mut app, "vo");
    assert_eq!(words(&app), "select a light to look from");

    let text = Language::Dat
        .template()
        .replace("1 pnt  6 -5 8    0 0 0", "1 inf  0 0 0 0 0 -1");
    let mut app = opened_as("scene.dat", &text).0;
    app.cursor
        .select(crate::language::Node::Light(0), app.document.source());
    press(&mut app, "vo");
    let camera = app.camera().expect("a camera");
    let bounds = app.scene.as_ref().expect("a scene").bounds();
    assert!((camera.target - bounds.centre()).length() < 1e-3);
    let offset = camera.eye - camera.target;
    assert!(
        bounds.half_diagonal() < offset.z && offset.x.abs() < 1e-3,
        "{offset}"
    );
    app.cursor
        .select(crate::language::Node::Light(2), app.document.source());
    press(&mut app, "o");
    assert!(words(&app).starts_with("ambient light"), "{}", words(&app));
}

#[test]
fn dragging_with_another_button_or_ctrl_pans_so_that_the_scene_follows() {
    let ctrl = KeyModifiers::CONTROL;
    for (button, modifiers) in [
        (MouseButton::Right, KeyModifiers::NONE),
        (MouseButton::Middle, KeyModifiers::NONE),
        (MouseButton::Left, ctrl),
    ] {
        let mut app = open(SCENE);
        press(&mut app, "v");
        let before = app.camera().expect("there is a camera");
        let (cells, size) = app.raster().expect("there is room");
        let seen = |app: &App| {
            let camera = app.camera().expect("there is a camera");
            crate::render::pixel_of(before.target, &camera, size).expect("it is in front")
        };
        let [x, y] = seen(&app);
        let (column, row) = (cells.x + cells.width / 2, cells.y + cells.height / 2);
        for (kind, column, row) in [
            (MouseEventKind::Down(button), column, row),
            (MouseEventKind::Drag(button), column + 4, row + 1),
            (MouseEventKind::Drag(button), column + 6, row + 3),
            (MouseEventKind::Up(button), column + 6, row + 3),
        ] {
            app.update(Msg::Mouse(MouseEvent {
                kind,
                column,
                row,
                modifiers,
            }));
        }
        let [after_x, after_y] = seen(&app);
        // Two pixels in a row of cells.
        let off = (after_x - x - 6.0).abs().max((after_y - y - 6.0).abs());
        assert!(off < 0.05, "{button:?} {off}");
        let after = app.camera().expect("there is a camera");
        let turned = (after.eye - after.target) - (before.eye - before.target);
        assert!(turned.length() < 1e-3, "{button:?} {turned}");
    }
}

#[test]
fn a_list_sets_several_fields_of_the_view_in_one_step() {
    let kept = "// view: eye 0 0 4.0 target 0 0 0\n";
    for (comment, list, written) in [
        ("", "1 2 9 0 0 1", "// view: eye 1 2 9 target 0 0 1\n"),
        (kept, "1 2 9.0 0 0 1", "// view: eye 1 2 9.0 target 0 0 1\n"),
        (
            kept,
            "1 2 9 0 0 1 0 1 0.5",
            "// view: eye 1 2 9.0 target 0 0 1 up 0 1 0.5\n",
        ),
    ] {
        let before = format!("{comment}{SCENE}");
        let mut app = open(&before);
        press(&mut app, &format!("e{list}<Enter>"));
        assert_eq!(app.document.text(), format!("{written}{SCENE}"), "{list}");
        press(&mut app, "<Esc>u");
        assert_eq!(app.document.text(), before, "{list}");
    }
}

#[test]
fn a_list_sets_several_fields_of_the_moved_view() {
    let mut app = ahead();
    let before = app.document.text().to_owned();
    press(&mut app, "vh<Esc>ek<Esc>e1 2 9 0 0 1<Enter>");
    assert_eq!(app.document.text(), before);
    let camera = app.camera().expect("a scene");
    assert_eq!(camera.eye, DVec3::new(1.0, 2.0, 9.0));
    assert_eq!(camera.target, DVec3::new(0.0, 0.0, 1.0));
    press(&mut app, "1 2 9 1 2 9<Enter>");
    let refused = app
        .cursor
        .typing
        .as_ref()
        .and_then(|typing| typing.refused.as_ref());
    assert!(refused.is_some_and(|refused| refused.message.contains("must differ")));
    assert_eq!(app.camera(), Some(camera));
}
