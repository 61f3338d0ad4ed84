//! Inputs that are open while another program saves the file.

use super::scripts::{Stage, ray, scene, scripts};

/// A ball, its material and a view without a name.
const XML: &str = "\
<xml><scene>
<object type=\"sphere\" name=\"ball\" material=\"red\"/>
<material type=\"blinn\" name=\"red\"><diffuse r=\"1\" g=\"0.5\" b=\"0\"/></material>
<light type=\"point\" name=\"lamp\"><intensity value=\"0.5\"/><position x=\"1\" y=\"2\" z=\"3\"/></light>
</scene>
<camera><position x=\"0\" y=\"-9\" z=\"2\"/><width value=\"8\"/><height value=\"6\"/></camera>
</xml>
";

fn xml<'s>() -> Stage<'s> {
    scene("a.xml", XML).after("ggj")
}

scripts! {
    /// What opens it, what the file becomes, and what accepts it.
    an_input_accepted_as_it_was_opened_changes_nothing: {
        let script = r"
            {1}       | inputs
            @file {2}
            {3}       | text file | not dirty | not asks | not inputs
        ";
        ray().table(script, r"
            jjjej<Enter>    | 1.5 // => 1.7 // | <Enter>
            jjjej<Enter>    | 1.5 // => 1.7 // | <Tab>
            jjjej<Enter>    | 1.5 // => 1.7 // | <Down>
            jjjej<Enter>    | 1.5 // => 1.7 // | <Up>
            jjjej<Enter>    | 1.5 // => 1.7 // | <Back>5<Enter>
            jjj<Space><Space>ej<Enter> | 1.5 // => 1.7 // | <Enter>
        ");
        xml().table(script, r#"
            GR  | "ball" => "globe"                  | <Enter>
            GR  | "ball" => "globe"                  | <Space><Back>ball<Enter>
            GkR | "red"/> => "crimson"/> & "red"> => "crimson"> | <Enter>
            Gkc | "blinn" => "phong"                 | <Enter>
        "#);
    };

    an_input_that_was_changed_asks_about_what_the_file_has_changed_too: {
        let script = r"
            {1}          | inputs
            @file {2}
            {3}          | asks conflict …
            M<Enter>     | text {4} | saved file | disk known

            {1}
            @file {2}
            {3}          | asks conflict …
            T<Enter>     | text file | saved file | disk known
        ";
        ray().table(script, r"
            jjjej<Enter> | 1.5 // => 1.7 // | <Ctrl-u>2<Enter> | 1.5 // => 2 //
            jjjej<Enter> | 1.5 // => 1.7 // | <Ctrl-u>2<Tab>   | 1.5 // => 2 //
            jjjej2       | 1.5 // => 1.7 // | <Enter>          | 1.5 // => 2 //
        ");
        xml().table(script, r#"
            GR  | "ball" => "globe"         | moon<Enter> | "ball" => "moon"
            GkR | "red"/> => "crimson"/> & "red"> => "crimson"> | blue<Enter> | "red"/> => "blue"/> & "red"> => "blue">
        "#);
    };

    /// A question that was put off returns with the next save, compared with what was seen in the
    /// input.
    a_conflict_of_an_input_can_be_put_off: ray().play(r"
        jjjej<Enter>          | inputs
        @file 1.5 // => 1.7 //
        <Ctrl-u>2<Enter><Esc> | disk changed
        w                     | does read scene.ray
        @file file            | asks conflict 1.5 2 1.7
    ");

    an_input_is_merged_with_changes_of_the_file_elsewhere: {
        ray().table(r"
            {1}        | inputs
            @file {2}
            {3}        | not asks | lines {4}
        ", r"
            jjjej<Enter> | 4 0 0 => 5 0 0   | <Ctrl-u>2<Enter> | 2 // the radius, 5 0 0
            jjjej2       | 4 0 0 => 5 0 0   | <Enter>          | 2 // the radius, 5 0 0
            // What is typed back to what it was is no change.
            jjjej1       | 1.5 // => 1.7 // | .5<Enter>        | 1.7 // the radius
        ");
        // What an input that was given up has seen says nothing of the next one.
        ray().play(r"
            jjjej<Enter> | inputs
            @file 1.5 // => 1.7 //
            <Esc><Enter><Ctrl-u>2<Enter> | not asks | lines 2 // the radius
        ");
        // Nor is what a save wrote meanwhile a change of another program.
        ray().play(r"
            jjjejlw<Enter>
            @saved
            <Ctrl-u>2<Enter> | not asks | lines 2 // the radius
        ");
    };

    choosing_the_type_that_something_has_is_no_edit: {
        ray().play("jjjc<Enter> | text opened | not undoable");
        // Neither is choosing the one that the file has given it since, nor the one before.
        xml().table(r#"
            Gc         | inputs
            @file "sphere" => "plane"
            {1}<Enter> | text file | not menu
        "#, r"
            sphere
            plane
        ");
    };
}
