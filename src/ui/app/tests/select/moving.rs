//! Moving through the list, over the picture and around the scene.

use super::scripts::{listed, ray, scene, scripts};
use super::*;

scripts! {
    keys_without_a_meaning_say_where_they_have_one: ray().each(r"
        S        | says S in VIEW (v): write the view into the scene (? for keys)
        jeo      | says o in SELECT: toggle the outline of the selection (? for keys)
        vR       | says R in SELECT (Enter): rename (? for keys)
        vX       | says X is not bound here (? for keys)
        <Ctrl-y> | says Ctrl-Y is not bound here (? for keys)
        ?X       | says X is not bound here
        je5      | not says
    ");

    a_saved_view_is_the_view_on_screen: ray().play(r"
        vhhk+]       | moved | not dirty
        @note seen camera
        S            | not moved | dirty | camera {seen} | line 1 // view: eye …
        u            | text opened
    ");

    orbiting_back_nearly_restores_the_view_and_never_crosses_the_pole: {
        let mut session = ray().session();
        let own = session.app.shared.camera().expect("a camera");
        session.run("vhhll");
        let back = session.app.shared.camera().expect("a camera");
        assert!((back.eye - own.eye).length() < 1e-3 * own.eye.length());
        session.run(&"k".repeat(60));
        let top = session.app.shared.camera().expect("a camera");
        let offset = top.eye - top.target;
        assert!(0.9 < offset.normalize().y && offset.y < offset.length());
        session.run("0 | not moved");
    };

    missing_parts_of_the_view_are_written_when_they_are_set: ray().play(r"
        ejjj40<Enter>      | camera …Perspective(40.0)…
        jll                | size 820x600
        :size 64x48<Enter> | size 64x48
    ");

    enter_selects_the_object_under_the_cross: ray().play(r"
        @shows half
        iHH<Enter> | mode SELECT | at object 2
        ggjiLLLLLLLLL
        <Enter>    | mode INSPECT | at view
    ");

    inspecting_starts_where_the_cross_was_last: {
        let mut session = ray().session();
        let corner = "HK".repeat(99);
        session.run(&format!("
            @shows half
            i
            {corner}
            <Esc>i | cross 0,0
            <Esc>i
            {corner}l
            <Esc>i | cross 1,0
        "));
    };

    the_first_object_is_selected_at_the_start: {
        scene("scene.ray", SCENE).play("| at object 1 | > el | lines 0.1 0 0");
        scene("scene.ray", "").play("| at view");
        scene("scene.ray", "1 1 1").play("| at ambient");
    };

    a_search_finds_names_and_comments_and_counts_them: ray().play(r"
        /SPHERE<Enter>n    | says 2 of 2
        /the light<Enter>  | at light 1 | says 1 of 1; Esc shows all
    ");

    the_list_is_walked_searched_and_cycled: ray().each(r"
        j                    | at ambient
        G                    | at object 2
        Ggg                  | at render
        Gg                   | at object 2
        <Tab>                | at light 1
        <Tab><Tab><Tab><Tab> | at light 1
        /sphere<Enter>       | at object 1
        /sphere<Enter>n      | at object 2
        /SPHERE<Enter>N      | at object 2
        /amb<Enter>          | at ambient
        /nothing<Enter>      | at view
        /amb<Esc>            | at view
    ");

    a_scene_that_opens_with_errors_has_no_picture_but_can_be_corrected: listed("nonsense")
        .with("ray", SCENE)
        .play(r"
        | not objects | errors
        v<F5>pb   | not does
        @file ray | does trace preview
    ");

    /// The working view stays out of the text when only the picture's size is set.
    setting_the_size_does_not_write_the_working_view: listed(&format!("// view: fov 40\n{SCENE}")).play(r"
        vhhh<Esc>ggjejjjjl | moved | line 1 // view: fov 40 size 810 600
    ");

    /// Without the first sphere the second is object 1, but the picture still shows both.
    picking_works_only_for_the_scene_on_screen: {
        let from = SCENE.find("sphere").expect("a sphere");
        let until = SCENE.rfind("sphere").expect("another one");
        let fewer = SCENE.replacen("\n2\n", "\n1\n", 1);
        ray().with("fewer", [&fewer[..from], &fewer[until..]].concat()).play(r"
            @shows half
            @started preview 1
            @file fewer       | nodes 5
            @started preview 2
            @note selected at
            @down picture 0,0 | at {selected} | says …does not show the changed scene yet…
            i<Enter>          | at {selected} | mode INSPECT
        ");
    };

    a_click_on_an_error_selects_it_and_nothing_below: {
        let mut session = ray().session();
        session.run(r"
            @shows half
            @file twice 1.5 // => -1.5 // | errors 1
            @down picture 0,0             | says …the text has errors…
            G
        ");
        let bottom = session.app.shared.areas().errors.height - 1;
        session.run(&format!("@down errors 0,{bottom} | at object 1 | field 1"));
    };
}

#[test]
fn no_key_or_size_panics() {
    let all = "jkgGnN/a\u{1b}evpohlHLJK,.i9+-[]f0S?!xwbruEzmq:y".chars();
    let all: Vec<_> = all.map(|key| KeyEvent::from(KeyCode::Char(key))).collect();
    for text in [SCENE, "", "nonsense", "0 0 0 0 0"] {
        for terminal in [(0, 0), (1, 1), (20, 6), (40, 16), (120, 40)] {
            let mut app = open(text);
            app.update(Msg::Resize(terminal.0, terminal.1));
            for first in &all {
                for second in ["<Esc>", "<Enter>", "<Tab>", "<Down>", "<Right>", "<Back>"] {
                    app.update(Msg::Key(*first));
                    press(&mut app, second);
                }
            }
        }
    }
}
