//! Which objects a text draws.

use crate::tests::read_as;
use crate::{Language, Visibility};
use scene::Meshes;
use text::apply;

/// Three spheres and the intersection of the first two, followed by `render`.
fn scene(render: &str) -> String {
    format!(
        "mat ID 1 1 1 1 .1 .5 .4 9 0 0 1\n\
         obj sphere ID 4 mat ID 1 0 0 0 1\n\
         obj sphere ID 5 mat ID 1 1 0 0 1\n\
         obj sphere ID 6 mat ID 1 5 0 0 1\n\
         obj CSG ID 9 intersection ID 4 ID 5\n{render}"
    )
}

fn changed(text: &str, id: i64, wanted: Visibility) -> Result<String, &'static str> {
    let (source, _) = read_as(Language::Dat, text, &Meshes::default());
    let object = [4, 5, 6, 9].iter().position(|&known| known == id);
    let object = object.expect("one of the objects");
    let edits = source.visibility_edits(&[object], wanted)?;
    let mut changed = text.to_owned();
    apply(&mut changed, &edits);
    Ok(changed)
}

#[test]
fn the_render_record_lists_what_is_drawn() {
    use Visibility::{Hidden, Shown};
    for (before, id, wanted, after) in [
        ("", 6, Hidden, "render 1 ID 9\n"),
        ("", 4, Shown, "render 3 ID 4 ID 6 ID 9\n"),
        ("", 6, Shown, ""),
        ("# end", 6, Hidden, "# end\nrender 1 ID 9"),
        ("# end\r", 6, Hidden, "# end\rrender 1 ID 9\n"),
        ("render 0 \t\n", 6, Hidden, "render 3 ID 4 ID 5 ID 9 \t\n"),
        ("render 0\n", 4, Shown, "render 0\n"),
        ("render 2  ID 9\tID 6\r\n", 9, Hidden, "render 1\tID 6\r\n"),
        ("render 2  ID 9\tID 6\n", 6, Hidden, "render 1  ID 9\n"),
        (
            "render 2  ID 9\tID 6\n",
            5,
            Shown,
            "render 3  ID 9\tID 6 ID 5\n",
        ),
        ("render 3 ID 6 ID 9 ID 6\n", 6, Hidden, "render 1 ID 9\n"),
    ] {
        let changed = changed(&scene(before), id, wanted);
        assert_eq!(changed, Ok(scene(after)), "{before:?} {id} {wanted:?}");
    }
}

#[test]
fn the_last_object_cannot_be_hidden() {
    let one = scene("render 1 ID 6\n");
    assert!(changed(&one, 6, Visibility::Hidden).is_err());
}
