//! Rereading, saving, conflicts, quitting.

use std::fs;

use super::scripts::{ray, scene, scripts};
use super::*;
use crate::app::files;
use crate::scene_reading::SceneFolder;

scripts! {
    a_save_may_only_replace_what_was_last_seen: ray().play(r"
        jjjelw | does save scene.ray | writes mine | over opened
        @saved | not dirty
    ");

    a_save_over_a_changed_file_asks: ray().play(r"
        jjjelw
        @refused                     | does only read scene.ray | says …nothing was written…
        @file \n0 0 0 => \n9 0 0     | asks conflict 0 0.1 9 | disk changed
        <Enter>                      | asks
        t<Enter>                     | text file | disk known
    ");

    a_postponed_conflict_returns_with_the_next_save_and_ends_when_the_edits_are_undone: ray().after(r"
        ggjjjjel
        @file \n0 0 0 => \n9 0 0
        <Esc> | not asks | lines 0.1 0 0
    ").play(r"
        w | does read scene.ray

        u | does read scene.ray
        @file file | text file | disk known
    ");

    all_conflicts_can_be_decided_at_once: ray().after(r"
        ggjjjjeljl
        @file \n0 0 0 => \n9 0 0 & 1.5 => 1.9
    ").play(r"
        M       | asks conflict 0 0.1 9: Mine, 1.5 1.6 1.9: Mine
        <Enter> | text \n0 0 0\n1.5 => \n0.1 0 0\n1.6

        T       | asks conflict 0 0.1 9: Theirs, 1.5 1.6 1.9: Theirs
        <Enter> | text file
    ");

    a_changed_file_is_reloaded_when_nothing_is_unsaved: ray().play(r"
        @changed         | does read scene.ray
        @file 1.5 => 1.7 | does trace preview | text file | not dirty
        @file file       | not does
    ");

    /// Keys arrive while a large file is being parsed and lowered.
    a_reading_compared_with_an_outdated_text_is_repeated: ray().play(r"
        @reading mine & 1.5 => 1.7
        jjjelw
        @saved
        @arrives                | does only read scene.ray, free | lines 0.1 0 0
        // An edit would have to be merged with the file's change.
        @reading mine & 1.5 => 1.7
        l
        @arrives                | does first read scene.ray, free | lines 0.2 0 0
        @file mine & 1.5 => 1.7 | lines 0.2 0 0, 1.7 // the radius
    ");

    a_reading_of_another_file_is_ignored: ray().play(r"
        @reads before.ray 1.5 => 1.7 | text opened
    ");

    a_file_is_read_again_once_it_is_watched: scene("scene.ray", SCENE).play(r"
        | does first watch scene.ray, read scene.ray
        @file opened | not does | not says
    ");

    changes_in_different_places_are_merged_as_one_step: ray().play(r"
        jjjel
        @file 1.5 => 1.7 | lines 0.1 0 0, 1.7 // the radius | not asks | dirty | fresh
        u                | lines 0.1 0 0
    ");

    /// A file is read after each save; the result, that nothing has changed, may arrive late.
    an_unchanged_file_is_not_read_again_because_of_an_edit: ray().play(r"
        @reading opened
        jjjel
        @arrives | not does read scene.ray | lines 0.1 0 0
    ");

    a_text_with_errors_is_kept_apart_from_unsaved_edits: ray().play(r#"
        jjjel
        @file twice "nonsense" | disk faulty | not errors | lines 0.1 0 0 | wrong … at nonsense, …
        | says line 1 of the file… | says …:w!…
        !                      | listed-error 0
        E                      | does only edit scene.ray at 1
        @file opened           | disk known | not listed-error | not wrong
    "#);

    an_unreadable_file_replaces_its_earlier_errors: ray().play(r#"
        jjjel
        @file twice "nonsense" | disk faulty | not errors
        @folder twice          | disk unreadable | not wrong | says scene.ray: is a folder, not a file
        w                      | does only read scene.ray
    "#);

    a_missing_file_is_reported_after_a_while_until_it_is_back: ray().play(r"
        // Another name may be on its way.
        @missing         | disk known
        @elapsed settled
        @missing         | disk missing
        @file opened     | disk known | says the file matches the saved text again
    ");

    quitting_asks_only_about_unsaved_edits: ray().each(r"
        q                | does quit
        <Ctrl-c>         | does quit
        :q<Enter>        | does quit
        jjjelq           | not does quit
        jjjelqy          | does quit
        jjjel:q!<Enter>  | does quit
        jjjelqn          | not does quit
        jjjelq<Esc>      | not does quit
    ");

    a_second_interrupt_quits_and_keeps_the_edits: ray().play(r"
        jjjel<Ctrl-c>
        <Ctrl-c> | does only keep edits of scene.ray, quit | writes mine

        jjjel<Ctrl-c><Esc>
        @elapsed interrupt
        <Ctrl-c> | not does quit
    ");

    a_scene_without_a_file_asks_for_one: ray().opened(|opening| opening.path = None).play(r"
        w              | prompt | says …no file yet…
        new.ray<Enter> | does save new.ray | over nothing

        // A reading is not answered once there is one.
        :e<Enter>      | says …has no file yet…
        <Esc>:w new.ray<Enter>
        @saved
        @reads scene.ray opened | says wrote new.ray
        @file opened            | says wrote new.ray
    ");

    a_file_equal_to_the_edits_counts_as_saved: ray().play(r"
        jjjel
        @file mine | not dirty | says the file now has the same changes…
        u          | text opened

        // But not if the file has only one of them.
        jjjeljl
        @file \n0 0 0 => \n0.1 0 0  | dirty
        | says merged the file's changes with your edits: the picture is unchanged; press u to undo the merge
        @file file & 4 0 0 => 5 0 0
        | says merged the file's changes with your edits: object 2 (sphere) centre x; press u to undo the merge
    ");

    a_text_with_errors_is_written_only_by_force: ray().but(r"\n4 0 0\n1\n => \n4 0 0\n-1\n").each(r"
        jelw                | not does save | says line 13 has an error: use :w! to save anyway
        jel:wq<Enter>       | not does save | says line 13 has an error: use :w! to save anyway
        jel:w b.ray<Enter>  | not does save | says line 13 has an error: use :w! b.ray to save anyway
        jel:w!<Enter>       | does save scene.ray
        jel:w! b.ray<Enter> | does save b.ray
    ");

    a_value_being_typed_is_discarded_with_its_field: {
        let objects = SCENE.find("2\nsphere").expect("a count of objects");
        ray().with("fewer", format!("{}0\n", &SCENE[..objects])).play(r"
            Gejjj7            | typed 7
            @file twice fewer | not typed
            j                 | says …discarded…
        ");
    };

    the_list_of_errors_follows_the_text: ray().but(r"1.5 => -1 & \n4 0 0\n1\n => \n4 0 0\n-1\n").play(r"
        | errors 2 | > !j                                | listed-error 1
        @file twice \n4 0 0\n-1 => \n4 0 0\n1            | listed-error 0

        !j
        @file twice \n4 0 0\n-1 => \n4 0 0\n1 & -1 => 1.5 | not listed-error
    ");

    a_reload_without_unsaved_edits_cannot_be_undone: ray().play(r"
        jjjelu
        @file 1.5 => 1.7
        u        | text file | says nothing to …
        <Ctrl-r> | text file | says nothing to …
    ");

    a_reload_names_what_differs_from_the_last_good_text: ray().play(r#"
        @file twice "x"
        @file twice "x y"
        @file opened     | says reloaded: the scene is unchanged
        @file twice "x"
        @file 1.5 => 1.7 | says reloaded: object 1 (sphere) radius
    "#);

    saving_without_changes_writes_nothing: ray().play(r"
        w              | not does save | says nothing to save
        :w!<Enter>     | does save scene.ray
        @saved
        @missing twice
        w              | does save scene.ray

        :wq<Enter>     | does only quit
    ");

    commands_and_pastes_without_effect_say_why: ray().play(r"
        :e<Enter>
        @file opened | says scene.ray has not changed
        @paste 1 2 3 | says …to paste values into fields…

        // Text is pasted into the line that keys go to.
        ?/
        @paste undo  | search undo
    ");

    /// The reason for the question is gone: the file holds the base of the edits again.
    a_conflict_ends_when_its_change_is_reverted: ray().play(r"
        jjjel
        @file \n0 0 0 => \n9 0 0 | asks conflict…
        @file opened             | not asks | disk known | dirty
    ");

    errors_must_persist_before_they_are_shown: ray().table(r"
        @file {1}        | does only wait settled, free | text opened
        @elapsed settled | does only read scene.ray
        // The last good scene is kept.
        @file {1}        | text {1} | errors | objects 2
        @file opened     | not errors
    ", r#"
        ""
        "1 1 1 2"
        "nonsense"
    "#);

    a_value_being_typed_survives_a_reload: {
        let objects = SCENE.find("sphere").expect("an object")..SCENE.rfind("sphere").expect("two");
        let stage = ray().with("first", &SCENE[objects]);
        for theirs in [
            "1.5 => 1.7",
            r"1\n5 5 5 // the light\n1 1 1\n2 => 2\n5 5 5\n1 1 1\n9 9 9\n1 1 1\n2",
            r"\n2\n{first} => \n3\n{first}{first}",
        ] {
            for edits in ["", "jjj<Enter>jl<Esc>ggj"] {
                let mut session = stage.session();
                session.run(edits).run("Ge<Tab>42").run(&format!("@file {theirs}"));
                if session.app.shared.overlays.dialog.is_some() {
                    session.run("T<Enter>");
                }
                session.run(r"| mode EDIT | > <Enter> | text …sphere\n4 42 0\n…");
            }
        }
    };
}

#[test]
fn a_moved_or_replaced_folder_is_reported() {
    let directory = tempfile::tempdir().expect("a folder");
    let at = |name: &str| directory.path().join(name);
    fs::create_dir(at("one")).expect("the folder is new");
    fs::create_dir(at("two")).expect("the folder is new");
    let file = |folder: &str| at(folder).join("scene.ray");
    let place = |folder: &str| SceneFolder::of(&file(folder));
    // A place with the path of one folder and the identity of another.
    let of_other = |path: &str, folder: &str| {
        let [path, other] = [place(path), place(folder)].map(|place| place.expect("there"));
        Some(SceneFolder {
            id: other.id,
            ..path
        })
    };
    let (one, two) = (at("one"), at("two"));
    let moved = format!("the scene's folder was moved to {}", two.display());
    let replaced = format!("{} is now a different folder", one.display());
    let theirs = SCENE.replace("1.5", "1.7");
    let news = "; reloaded: object 1 (sphere) radius";
    for (then, text, expected) in [
        (place("one"), SCENE, String::new()),
        (None, SCENE, String::new()),
        (of_other("two", "one"), SCENE, moved.clone()),
        (of_other("two", "one"), &theirs, format!("{moved}{news}")),
        (of_other("one", "two"), SCENE, replaced.clone()),
        (of_other("one", "two"), &theirs, format!("{replaced}{news}")),
    ] {
        let mut app = open(SCENE);
        let mut read = |text: &str, place| {
            app.shared.overlays.message = None;
            let reading =
                Reading::new(text.to_owned(), files::baseline(&app.shared)).expect("it fits");
            let reading = Reading { place, ..reading };
            app.update(Msg::Read(PathBuf::from("scene.ray"), Ok(reading)));
            words(&app).to_owned()
        };
        assert_eq!(read(SCENE, place("one")), "");
        assert_eq!(read(text, then.clone()), expected);
        assert_eq!(read(text, then), "", "said once");
    }
}
