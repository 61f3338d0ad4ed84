//! Requesting, awaiting and taking the files that scenes name.

use super::scripts::{Stage, scene, scripts};

const TEXTURED: &str = "\
camera perspective 0 0 8  0 0 0  0 1 0  1 0 100
resolution .02 .02
viewport 40 30
light ID 0 amb 0 0 0  0 0 0  1 1 1  1 0 0  0 shadow_off
mat ID 0  1 1 1  1 0 0 1  0 0 1
texture ID 7 image 1 1 skin.ppm
use colour ID 7 mat ID 0
obj sphere ID 0 mat ID 0  0 0 0  2
";

const MESHED: &str = "<xml><scene>
  <object type='sphere'/>
  <object type='obj' name='a.obj'/>
</scene><camera><position z='9'/><target/></camera></xml>
";

fn textured<'s>() -> Stage<'s> {
    scene("none/scene.dat", TEXTURED)
}

fn meshed<'s>() -> Stage<'s> {
    scene("none/scene.xml", MESHED)
}

scripts! {
    a_picture_is_traced_once_its_textures_are_read: textured().play(r"
        | does load [skin.ppm] | not does trace | awaits
        b                | not does trace | says still reading the scene's files
        <F5>             | mode SELECT
        @load skin.ppm: 9 | does trace preview | job image skin.ppm | not awaits
        b                | does trace export
        // The same pixels change nothing; others do.
        @load skin.ppm: 9 | not does trace
        @load skin.ppm: 8 | does trace | says files reloaded
    ");

    files_that_are_used_no_longer_or_again_are_not_reloaded: textured()
        .but(r"obj sphere => texture ID 8 image 1 1 fur.ppm\nuse colour ID 8 mat ID 0\nobj sphere")
        .with("textured", TEXTURED)
        .play(r"
        @load skin.ppm: 9; fur.ppm: 8 | not says
        @file textured    | says
        @note after says
        @load skin.ppm: 9 | says {after}
    ");

    a_scene_without_textures_does_not_wait: textured()
        .but("image 1 1 skin.ppm => checker 1 1  0 0 0  1 1 1")
        .play("| not does load | does trace preview | not awaits");

    files_are_requested_only_if_they_differ: textured().play(r"
        @load skin.ppm: 9
        @file 0 0 0  2 => 0 1 0  2 | not does load | does trace
        // While the text has errors, the files that the picture shows are still wanted.
        @file 0 0 0  2 => 0 1 0  2 & skin.ppm => fur.ppm & obj => obj x | not does load
        @assets-changed   | does load [skin.ppm]
        @file 0 0 0  2 => 0 1 0  2 & skin.ppm => fur.ppm
        | does load [fur.ppm] | not does trace | awaits
        // The answer to an outdated request is ignored.
        @load skin.ppm: 7 | not does trace | awaits
        @load fur.ppm: 7  | does trace | not awaits
        @file file & image 1 1 fur.ppm => checker 1 1  0 0 0  1 1 1 | not does load | does trace
        @assets-changed   | not does
    ");

    a_missing_texture_is_a_warning_at_its_name: textured().play(r##"
        @load skin.ppm: missing | does trace | says cannot read 1 file: press ! to see why
        | wrong texture 7 file: no such file; shown in magenta at skin.ppm
        // The warning moves with the text.
        @file "# first\n{opened}"
        | wrong texture 7 file: no such file; shown in magenta at skin.ppm
        @load skin.ppm: 9       | not wrong | says all files can be read now
    "##);

    a_mesh_arrives_later_and_the_picture_follows_its_file: meshed().with("more", MESHED.replace(
        "'/>\n</scene>",
        "'/>\n  <object type='obj' name='b.obj'/>\n</scene>",
    )).play(r"
        | does load [a.obj] | not does trace | awaits | not errors
        @load a.obj: 1 newmtl a\n | job objects 2
        // The mesh was read again unchanged.
        @load a.obj: 1 newmtl a\n | not does trace
        @reading more
        @assets-changed           | does load [a.obj]
        @load a.obj: 2 newmtl a\n | job objects 2 | says files reloaded
        @load a.obj: 2 newmtl a\nKd 1 0 0\n | job objects 2 | says files reloaded
        // A scene that was lowered with outdated meshes is read again.
        @arrives                  | does only read none/scene.xml, free | text opened
        // With another mesh the picture waits for it, but the text has already changed.
        @file more                | not does trace | awaits | says reloaded: b.obj (obj)
    ");

    a_broken_mesh_is_a_warning_and_its_object_is_left_out: meshed().play(r#"
        @load a.obj: 1 newmtl a\n
        @load a.obj: broken       | job objects 1 | says cannot read 1 file: press ! to see why
        | wrong …a.obj:2:3: v: `x` is not a number at a.obj…
        | wrong …a.obj:2:8: a.obj (obj): the file has no faces that can be used at a.obj…
        // The mesh's file is still watched; other edits are accepted meanwhile.
        @assets-changed           | does load [a.obj]
        [object 1] <Enter>jj7<Enter> | text …material="7"… | not errors
        @load a.obj: 3 newmtl a\n | job objects 2 | says all files can be read now | not errors
    "#);

    a_scene_whose_mesh_was_never_read_shows_the_rest: meshed().play(r"
        // What was lowered before the file was read must not be shown as the scene.
        | not does trace
        @load a.obj: broken | job objects 1 | not errors
    ");

    pictures_named_by_a_mesh_are_requested_once_it_is_read: meshed().play(r"
        @load a.obj: 1 newmtl a\nmap_Kd skin.ppm\n | does load [skin.ppm a.obj] | not does trace | awaits
        @load a.obj: 1 newmtl a\nmap_Kd skin.ppm\n; skin.ppm: 9 | job objects 2 | not awaits
        // A missing picture is a warning where the mesh is named.
        @load a.obj: 1 newmtl a\nmap_Kd skin.ppm\n; skin.ppm: missing | does trace
        | wrong a.obj (obj) map_Kd skin.ppm: no such file; shown in magenta at a.obj, …
    ");

    a_file_found_elsewhere_is_reported_once: textured().play(r"
        @load skin.ppm: 1 at /a/skin.ppm | says skin.ppm is read from /a/skin.ppm
        @load skin.ppm: 2 at /a/skin.ppm | says files reloaded
        @load skin.ppm: 3 at /b/skin.ppm | says skin.ppm is read from /b/skin.ppm
    ");
}
