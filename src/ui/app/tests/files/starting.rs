//! Starting scenes: new ones, and others in place of the present one.

use super::scripts::{Stage, ray, scene, scripts};
use super::*;

/// The stage of a file that does not exist yet.
fn new(name: &str) -> Stage<'_> {
    let language = Language::of_path(Path::new(name)).expect("a scene's name");
    let stage = scene(name, "")
        .with("name", name)
        .with("template", language.template());
    stage.opened(|opening| opening.text = OpeningText::New)
}

/// The stage of a mesh that is still to be read.
fn mesh(name: &str) -> Stage<'_> {
    scene("a.xml", "").opened(|opening| {
        opening.path = Some(name.into());
        opening.text = OpeningText::AroundMesh(84);
    })
}

scripts! {
    a_file_that_does_not_exist_is_a_new_scene_of_its_language: for name in
        ["new.ray", "new.dat", "new.xml"]
    {
        new(name).play(r"
            | says {name} is new: w writes it | does watch {name}, trace preview
            | text template | not wrong
            // It is still not there.
            @missing | not does | disk new
            // Nothing was changed yet.
            q        | does quit | not loses
            jjjDq    | not does quit | loses {name} is new and not saved
            y        | does quit

            w        | does save {name} | writes template | over nothing
            @saved
            q        | does quit
        ");
    };

    a_new_scene_takes_or_merges_a_file_that_appears: new("scene.ray").play(r"
        @file 0.5 0.55 0.65 => 0.1 0.1 0.1 | text file | disk known
        q                                  | does quit

        jjjel
        @file 0.5 0.55 0.65 => 0.1 0.1 0.1 | says merged the file's changes… | dirty
    ");

    a_new_scene_without_a_file_asks_for_a_name: {
        let stage = ray().with("ray", Language::Ray.template()).with("dat", Language::Dat.template());
        stage.with("xml", Language::Xml.template()).table(r"
            {1}    | does look for kept | says a new scene: :w FILE writes it
            | text {2} | language {2} | not path
            q      | does quit
            jjjDq  | not does quit | loses the new scene is not saved
            w      | not does quit | prompt
            x.{2}<Enter> | writes mine | over nothing
            // The saves of the former scene are counted too.
            @saved 2 | does quit
        ", r"
            :new<Enter>      | ray
            :new ray<Enter>  | ray
            :new .DAT<Enter> | dat
            :new xml<Enter>  | xml
        ");
        ray().play(":new obj<Enter> | says new takes .ray, .dat, .xml or .test");
    };

    a_mesh_is_opened_in_a_new_scene: mesh("a.stl").with("xml", Language::Xml.template())
        .play(r"
            | does open a.stl | not does watch
            w                    | says still opening a.stl…
            @opened a.stl around xml | does watch a.xml | does look for kept | text xml | path a.xml
            | disk new | says a.stl: 2 triangles; w writes a.xml | language xml | not dirty
            w                    | does save a.xml | writes xml | over nothing
        ");

    a_mesh_that_is_not_there_ends_the_program: mesh("a.ply")
        .play(r"
            @unopened a.ply | does quit
        ");

    a_mesh_takes_the_place_of_the_scene: ray().with("xml", Language::Xml.template()).play(r"
        :e b.PLY<Enter>          | does open b.PLY
        @opened b.PLY around xml | text xml | path b.xml | disk new
        | says b.PLY: 2 triangles; w writes b.xml
    ");

    another_scene_replaces_everything_that_belongs_to_this_one: ray().with("dat", dat::SCENE).play(r"
        jjjel<Esc>u<F5>
        @started full 1
        <Esc>
        :e b.dat<Enter>   | does open b.dat
        @opened b.dat dat | does first stop full, free, watch b.dat | does look for kept, trace preview
        | text dat | path b.dat | language dat | not dirty | not traced
        u                 | says nothing to undo
        <Ctrl-r>          | says nothing to redo
        // A reading of the former scene's file comes too late.
        @reads scene.ray opened | text dat
    ");

    another_scene_may_be_new_kept_broken_or_empty: ray().with("template", Language::Ray.template()).table(r"
        :e b.ray<Enter>    | does open b.ray
        // The picture of the former scene does not stay.
        @opened b.ray {1}  | text {2} | disk {3} | {4} | {5}
        @started preview 3
        @frame preview     | not picture
    ", r#"
        new                | template      | new     | not errors | objects
        kept opened        | opened        | missing | not errors | objects
        "no scene"         | "no scene"    | known   | errors     | not objects
        ""                 | ""            | known   | errors     | not objects
    "#);

    a_scene_that_cannot_be_read_leaves_this_one: ray().play(r"
        :e none/b.ray<Enter>
        // Changes are not read meanwhile: that would supersede the request.
        @changed             | not does
        @unopened none/b.ray | says none/b.ray: no such file | does read scene.ray | path scene.ray | text opened
        :e notes.txt<Enter>  | says …notes.txt: not a scene…
    ");

    the_scenes_own_file_is_read_again: ray().each(r"
        :e<Enter>             | does read scene.ray
        :e scene.ray<Enter>   | does read scene.ray
        :e ./scene.ray<Enter> | does read scene.ray
    ");

    leaving_unsaved_edits_for_another_scene_asks: {
        ray().each(r"
            jjjel<Esc>:e b.ray<Enter> | asks open b.ray | dirty | > n | not asks | dirty
            jjjel<Esc>:new<Enter>     | asks new | dirty | > n | not asks | dirty
        ");
        ray().with("template", Language::Ray.template()).play(r"
            // Discarding gives up the journal, too.
            jjjel<Esc>
            @elapsed keep
            :new<Enter>y               | does first forget edits | text template

            jjjel<Esc>:e b.ray<Enter>w | does save scene.ray | not does open
            @saved                     | does open b.ray
        ");
    };

    an_edit_made_while_another_scene_is_read_is_asked_about: ray().play(r#"
        :e b.ray<Enter>jjjel
        @opened b.ray "" | asks open b.ray | path scene.ray
        y                | does open b.ray
        @opened b.ray "" | text ""
    "#);

    the_late_outcome_of_a_save_does_not_touch_another_scene: ray().play(r"
        :w copy.ray<Enter>
        :new<Enter>
        @saved 1 | says wrote copy.ray | not path | disk new
    ");

    an_editor_is_not_opened_on_a_file_that_does_not_exist: new("new.ray").play(r"
        E | not does | asks editor: new.ray is not written yet. Save and open the editor?
        y | does save new.ray | not does edit
        @saved | does edit new.ray…
    ");

    scenes_are_remembered_when_they_are_opened_and_saved_elsewhere: {
        scene("scene.ray", SCENE).play(r"
            | does once note | does note scene.ray
            :w copy.ray<Enter>
            @saved               | does once note | does note copy.ray
            jjjelw
            @saved               | not does note
            :e b.ray<Enter>      | does open b.ray
            @opened b.ray opened | does once note | does note b.ray
        ");
        new("new.ray").play(r"
            | not does note
            w
            @saved      | does once note | does note new.ray
            :new<Enter> | not does note
        ");
    };

    recent_scenes_are_listed_filtered_and_opened: {
        ray().table(r"
            :recent<Enter> | does only list recent
            @recent /a/one.ray /a/two.dat /b/three.xml | page
            {1}            | {2} | not page
        ", r"
            <Enter>          | does open /a/one.ray
            j<Enter>         | does open /a/two.dat
            jjjk<Enter>      | does open /a/two.dat
            G<Enter>         | does open /b/three.xml
            /A/<Esc>j<Enter> | does open /a/two.dat
            /A/<Down><Enter> | does open /a/two.dat
            three<Enter>     | does open /b/three.xml
            none<Enter>      | not does
            j<Esc>           | not does
        ");
        ray().play(r"
            @recent /a/one.ray /a/two.dat /b/three.xml
            @paste two\n
            <Enter>  | does open /a/two.dat

            jjjel
            @recent /a/one.ray /a/two.dat /b/three.xml
            <Enter>  | asks open /a/one.ray
            @recent
            | says no recently used scenes
        ");
    };

    recent_scenes_are_offered_over_the_embedded_one: scene("scene.ray", SCENE).opened(|opening| {
        opening.path = None;
        opening.recent = vec![PathBuf::from("/a/one.ray")];
    }).play(r"
        | does trace preview | page
        <Esc> | not page | text opened
    ");
}
