//! Deleting, copying, inserting, exchanging and renaming nodes in all languages.

use super::{Random, read_as};
use crate::schema::Category;
use crate::{Language, Neighbour, Node, Source, StructureError};
use scene::Meshes;
use text::{Edit, apply};

/// A change of structure.
#[derive(Clone, Copy, Debug)]
enum Change {
    Delete(&'static [Node]),
    /// Copies nodes and inserts the copies after the last.
    Duplicate(&'static [Node]),
    Up(Node),
    Down(Node),
    Rename(Node, &'static str),
    Insert(&'static str, Node),
}

use Change::{Delete, Down, Duplicate, Insert, Rename, Up};
use Node::{Light, Material, Object, Texture};

fn edits(source: &Source, change: Change) -> Result<Vec<Edit>, StructureError> {
    match change {
        Delete(nodes) => source.removal(nodes),
        Duplicate(nodes) => {
            let copied = source.copied(nodes)?;
            let last = nodes.last().expect("there are some");
            Ok(source.insertion(&copied, *last)?.edits)
        }
        Up(node) => Ok(source.exchange(node, Neighbour::Previous)?.edits),
        Down(node) => Ok(source.exchange(node, Neighbour::Next)?.edits),
        Rename(node, name) => source.renaming(node, name),
        Insert(text, after) => Ok(source.insertion(text, after)?.edits),
    }
}

/// Makes a change and expects the text after it, without errors, or the words of the refusal; and
/// the same behind a byte order mark, which stays in front.
#[track_caller]
fn check(language: Language, before: &str, change: Change, expected: Result<&str, &str>) {
    check_exactly(language, before, change, expected);
    let marked = |text: &str| format!("\u{FEFF}{text}");
    let expected = expected.map(marked);
    let expected = expected.as_deref().map_err(|reason| *reason);
    check_exactly(language, &marked(before), change, expected);
}

#[track_caller]
fn check_exactly(language: Language, before: &str, change: Change, expected: Result<&str, &str>) {
    let (source, lowered) = read_as(language, before, &Meshes::default());
    assert!(
        lowered.scene.is_some(),
        "{before}\n{:?}",
        lowered.diagnostics
    );
    let edits = edits(&source, change).map_err(|error| error.to_string());
    let after = edits.map(|edits| {
        let mut after = before.to_owned();
        apply(&mut after, &edits);
        let (_, lowered) = read_as(language, &after, &Meshes::default());
        assert!(lowered.scene.is_some(), "{change:?}\n{after}");
        after
    });
    let after = after.as_deref().map_err(String::as_str);
    assert_eq!(after, expected, "{change:?} of\n{before}");
}

const MATERIAL: &str = "0 0 0  .5 .5 .5  0 0 0 1 0 0 1";

/// A `.ray` text whose `%` stand for materials.
fn ray(text: &str) -> String {
    text.replace('%', MATERIAL)
}

#[test]
fn counts_of_ray_follow_what_is_deleted_copied_and_moved() {
    let two = "1 1 1\n1\n0 5 5  1 1 1 // lamp\n\n2\n\n// the moon\nsphere 0 0 0 1 %\n\nsphere 1 0 0 1 % // b\n";
    for (change, after) in [
        (
            Delete(&[Object(0)]),
            Ok("1 1 1\n1\n0 5 5  1 1 1 // lamp\n\n1\n\nsphere 1 0 0 1 % // b\n"),
        ),
        (
            Delete(&[Object(1)]),
            Ok("1 1 1\n1\n0 5 5  1 1 1 // lamp\n\n1\n\n// the moon\nsphere 0 0 0 1 %\n"),
        ),
        (
            Delete(&[Object(0), Object(1)]),
            Err("the last object cannot be deleted: a .ray scene needs at least one"),
        ),
        (
            Delete(&[Light(0)]),
            Err("the last light cannot be deleted: a .ray scene needs at least one"),
        ),
        (
            Delete(&[Node::Ambient]),
            Err("ambient cannot be copied, moved or deleted"),
        ),
        (
            Duplicate(&[Object(0)]),
            Ok(
                "1 1 1\n1\n0 5 5  1 1 1 // lamp\n\n3\n\n// the moon\nsphere 0 0 0 1 %\n\n// the moon\nsphere 0 0 0 1 %\n\nsphere 1 0 0 1 % // b\n",
            ),
        ),
        (
            Duplicate(&[Light(0)]),
            Ok(
                "1 1 1\n2\n0 5 5  1 1 1 // lamp\n0 5 5  1 1 1 // lamp\n\n2\n\n// the moon\nsphere 0 0 0 1 %\n\nsphere 1 0 0 1 % // b\n",
            ),
        ),
        (
            Down(Object(0)),
            Ok(
                "1 1 1\n1\n0 5 5  1 1 1 // lamp\n\n2\n\nsphere 1 0 0 1 % // b\n\n// the moon\nsphere 0 0 0 1 %\n",
            ),
        ),
        (Up(Object(0)), Err("object 1 (sphere) is already the first")),
        (Down(Light(0)), Err("light 1 is already the last")),
        (
            Rename(Object(0), "Io"),
            Ok(
                "1 1 1\n1\n0 5 5  1 1 1 // lamp\n\n2\n\n// the moon\nsphere 0 0 0 1 % // Io\n\nsphere 1 0 0 1 % // b\n",
            ),
        ),
        (
            Insert("1 2 3\n", Object(0)),
            Err(
                "cannot paste this: expected objects, or lights of 6 numbers, but it begins with 3 words",
            ),
        ),
    ] {
        let after = after.map(ray);
        let after = after.as_deref().map_err(|reason| *reason);
        check(Language::Ray, &ray(two), change, after);
    }
}

#[test]
fn objects_of_ray_on_one_line_keep_to_it() {
    let line = "0 0 0 1 0 0 0 1 1 1 2 sphere 0 0 0 1 % sphere 1 0 0 1 % // end";
    for (change, after) in [
        (
            Delete(&[Object(0)]),
            "0 0 0 1 0 0 0 1 1 1 1 sphere 1 0 0 1 % // end",
        ),
        (
            Insert("// red\nsphere 2 0 0 1 % // x", Object(0)),
            "0 0 0 1 0 0 0 1 1 1 3 sphere 0 0 0 1 % sphere 2 0 0 1 % sphere 1 0 0 1 % // end",
        ),
        (
            Up(Object(1)),
            "0 0 0 1 0 0 0 1 1 1 2 sphere 1 0 0 1 % sphere 0 0 0 1 % // end",
        ),
    ] {
        let change = match change {
            Insert(text, after) => Insert(ray(text).leak(), after),
            other => other,
        };
        let (line, after) = (ray(line), ray(after));
        let (line, after) = (line.replace("  ", " "), after.replace("  ", " "));
        let change = match change {
            Insert(text, after) => Insert(text.replace("  ", " ").leak(), after),
            other => other,
        };
        check(Language::Ray, &line, change, Ok(&after));
    }
}

#[test]
fn the_view_comment_stays_when_its_object_goes() {
    let view = "// view: eye 0 0 9";
    let text = ray(&format!(
        "0 0 0 1 0 0 0 1 1 1\n2\nsphere 0 0 0 1 {view}\n%\nsphere 1 0 0 1 %\n"
    ));
    let after = ray(&format!(
        "0 0 0 1 0 0 0 1 1 1\n1\n{view}\nsphere 1 0 0 1 %\n"
    ));
    check(Language::Ray, &text, Delete(&[Object(0)]), Ok(&after));
}

/// Materials, a texture, spheres and a difference, followed by `render`.
fn dat(render: &str) -> String {
    format!(
        "light ID 1 amb 0 0 0 0 0 0 1 1 1 1 0 0 0 shadow_off\n\
         # red\nmat ID 1 1 0 0 .1 .5 .4 9 0 0 1\nmat ID 7 1 1 0 .1 .5 .4 9 0 0 1\n\
         texture ID 3 checker 4 4 1 1 1 0 0 0\nuse colour ID 3 mat ID 7\n\
         obj sphere ID 4 mat ID 1 0 0 0 1\n\
         obj sphere ID 5 mat ID 7 1 0 0 1\n\
         obj CSG ID 9 difference ID 4 ID 5\n{render}"
    )
}

#[test]
fn references_of_dat_follow_what_is_deleted_copied_and_renamed() {
    let lines = |text: &str, changes: &[(&str, &str)]| {
        changes.iter().fold(text.to_owned(), |text, (old, new)| {
            assert!(text.contains(old), "{old} in {text}");
            text.replacen(old, new, 1)
        })
    };
    let sphere = "obj sphere ID 4 mat ID 1 0 0 0 1\n";
    let other = "obj sphere ID 5 mat ID 7 1 0 0 1\n";
    let tree = "obj CSG ID 9 difference ID 4 ID 5\n";
    let copies = "obj sphere ID 10 mat ID 1 0 0 0 1\nobj sphere ID 11 mat ID 7 1 0 0 1\nobj CSG ID 12 difference ID 10 ID 11\n";
    let whole = dat("render 2 ID 9 ID 4\n");
    let all = format!("{tree}{copies}");
    let case = |change, changes: &[(&str, &str)]| {
        check(Language::Dat, &whole, change, Ok(&lines(&whole, changes)));
    };
    case(
        Delete(&[Object(2)]),
        &[(tree, ""), ("render 2 ID 9", "render 1")],
    );
    case(
        Delete(&[Texture(0)]),
        &[(
            "texture ID 3 checker 4 4 1 1 1 0 0 0\nuse colour ID 3 mat ID 7\n",
            "",
        )],
    );
    case(
        Delete(&[Material(1)]),
        &[
            ("mat ID 7 1 1 0 .1 .5 .4 9 0 0 1\n", ""),
            ("use colour ID 3 mat ID 7\n", ""),
            (other, ""),
            (tree, ""),
            ("render 2 ID 9", "render 1"),
        ],
    );
    case(
        Duplicate(&[Object(0)]),
        &[
            (
                sphere,
                "obj sphere ID 4 mat ID 1 0 0 0 1\nobj sphere ID 10 mat ID 1 0 0 0 1\n",
            ),
            ("render 2 ID 9 ID 4", "render 3 ID 9 ID 4 ID 10"),
        ],
    );
    case(
        Duplicate(&[Object(2)]),
        &[
            (tree, &all),
            ("render 2 ID 9 ID 4", "render 3 ID 9 ID 4 ID 12"),
        ],
    );
    case(
        Duplicate(&[Material(1)]),
        &[(
            "use colour ID 3 mat ID 7\n",
            "use colour ID 3 mat ID 7\nmat ID 8 1 1 0 .1 .5 .4 9 0 0 1\nuse colour ID 3 mat ID 8\n",
        )],
    );
    case(
        Rename(Object(0), "40"),
        &[
            ("obj sphere ID 4", "obj sphere ID 40"),
            ("difference ID 4", "difference ID 40"),
            ("ID 9 ID 4\n", "ID 9 ID 40\n"),
        ],
    );
    case(
        Rename(Material(1), "2"),
        &[
            ("mat ID 7 1 1", "mat ID 2 1 1"),
            ("use colour ID 3 mat ID 7", "use colour ID 3 mat ID 2"),
            ("obj sphere ID 5 mat ID 7", "obj sphere ID 5 mat ID 2"),
        ],
    );
    for (change, reason) in [
        (Rename(Object(0), "5"), "object 5 already exists"),
        (Rename(Object(0), "moon"), "an ID is a whole number"),
        (
            Up(Object(2)),
            "object 9 (CSG) must stay after object 5 (sphere), which it uses",
        ),
        (
            Insert("viewport 4 3", Object(0)),
            "cannot paste this: expected records of lights, materials, textures or objects, not `viewport`",
        ),
        (
            Delete(&[Node::View]),
            "view cannot be copied, moved or deleted",
        ),
    ] {
        check(Language::Dat, &whole, change, Err(reason));
    }
    let one = dat("render 1 ID 9\n");
    let reason =
        "the last drawn object cannot be deleted: `render` would list none, which draws all";
    check(Language::Dat, &one, Delete(&[Object(2)]), Err(reason));
}

/// A texture that two materials use, one of them twice.
const TEXTURED: &str = "\
mat ID 1  1 1 1  .3 .5 .2 9  0 0 1
mat ID 2  1 0 0  .3 .5 .2 9  0 0 1
texture ID 1 checker 4 4 1 1 1 0 0 0
use colour ID 1 mat ID 1
use colour ID 1 mat ID 2
obj sphere ID 1 mat ID 1  0 0 0  1
";

/// Deleting and copying the first of several below a heading.
#[test]
fn a_heading_of_several_stays_and_is_not_copied() {
    let before = "# balls\nobj sphere ID 1 mat ID 1  0 0 0  1\nobj sphere ID 2 mat ID 1  3 0 0  2\n\n# one\nobj sphere ID 3 mat ID 1  0 0 0  1\n\n# two\nobj sphere ID 4 mat ID 1  0 0 0  1\n# three\nobj sphere ID 5 mat ID 1  0 0 0  1\n";
    let first = "obj sphere ID 1 mat ID 1  0 0 0  1\n";
    let one = "# one\nobj sphere ID 3 mat ID 1  0 0 0  1\n\n";
    let two = "# two\nobj sphere ID 4 mat ID 1  0 0 0  1\n";
    let scene = |objects: &str| format!("mat ID 1  1 1 1  .3 .5 .2 9  0 0 1\n\n{objects}");
    for (change, old, new) in [
        (Delete(&[Object(0)]), first, ""),
        (
            Duplicate(&[Object(0)]),
            first,
            "obj sphere ID 1 mat ID 1  0 0 0  1\nobj sphere ID 6 mat ID 1  0 0 0  1\n",
        ),
        (Delete(&[Object(2)]), one, ""),
        (Delete(&[Object(3)]), two, ""),
    ] {
        let after = before.replacen(old, new, 1);
        check(Language::Dat, &scene(before), change, Ok(&scene(&after)));
    }
}

#[test]
fn what_goes_with_a_deleted_node_is_said() {
    for (language, text, nodes, words) in [
        (
            Language::Dat,
            dat(""),
            &[Material(1)][..],
            Some("2 objects use it and will be deleted too"),
        ),
        (
            Language::Dat,
            dat(""),
            &[Object(0)],
            Some("object 9 (CSG) uses it and will be deleted too"),
        ),
        (Language::Dat, dat(""), &[Object(2)], None),
        (
            Language::Xml,
            xml().to_owned(),
            &[Material(0)],
            Some("1 object uses it and will be plain white"),
        ),
        (Language::Xml, xml().to_owned(), &[Object(0)], None),
        (
            Language::Dat,
            TEXTURED.to_owned(),
            &[Texture(0)],
            Some("2 materials use it and will lose it"),
        ),
        (
            Language::Dat,
            TEXTURED.to_owned(),
            &[Texture(0), Material(0)],
            Some(
                "object 1 (sphere) uses it and will be deleted too; material 2 uses it and will lose it",
            ),
        ),
    ] {
        let (source, _) = read_as(language, &text, &Meshes::default());
        assert_eq!(source.consequence(nodes).as_deref(), words, "{nodes:?}");
    }
}

/// A group, two spheres, a material and a light.
fn xml() -> &'static str {
    "<xml>\n  <scene>\n    <object name=\"g\">\n      <!-- a -->\n      <object type=\"sphere\" name=\"a\" material=\"m\"/>\n      <object type='sphere' name='b'/>\n    </object>\n    <material name=\"m\"/> <!-- matte -->\n    <light type=\"ambient\" name=\"l\"/>\n  </scene>\n</xml>\n"
}

#[test]
fn elements_go_with_what_is_in_them_and_copies_get_names_of_their_own() {
    let change = |change, changes: &[(&str, &str)]| {
        let after = changes.iter().fold(xml().to_owned(), |text, (old, new)| {
            assert!(text.contains(old), "{old}");
            text.replacen(old, new, 1)
        });
        check(Language::Xml, xml(), change, Ok(&after));
    };
    let group = "    <object name=\"g\">\n      <!-- a -->\n      <object type=\"sphere\" name=\"a\" material=\"m\"/>\n      <object type='sphere' name='b'/>\n    </object>\n";
    let copy = group
        .replace("\"g\"", "\"g 2\"")
        .replace("\"a\"", "\"a 2\"")
        .replace("'b'", "'b 2'");
    let both = format!("{group}{copy}");
    change(Delete(&[Object(0)]), &[(group, "")]);
    change(Delete(&[Object(0), Object(1)]), &[(group, "")]);
    change(
        Delete(&[Object(2)]),
        &[("      <object type='sphere' name='b'/>\n", "")],
    );
    change(
        Delete(&[Material(0)]),
        &[
            (" material=\"m\"", ""),
            ("    <material name=\"m\"/> <!-- matte -->\n", ""),
        ],
    );
    change(Duplicate(&[Object(0)]), &[(group, &both)]);
    change(
        Duplicate(&[Material(0)]),
        &[(
            "<!-- matte -->\n",
            "<!-- matte -->\n    <material name=\"m 2\"/> <!-- matte -->\n",
        )],
    );
    // A comment above several is their heading, and stays.
    let (a, b) = (
        "      <object type=\"sphere\" name=\"a\" material=\"m\"/>\n",
        "      <object type='sphere' name='b'/>\n",
    );
    change(Down(Object(1)), &[(&format!("{a}{b}"), &format!("{b}{a}"))]);
    change(Delete(&[Object(1)]), &[(a, "")]);
    change(
        Rename(Material(0), "a & b"),
        &[
            ("material=\"m\"", "material=\"a &amp; b\""),
            ("material name=\"m\"", "material name=\"a &amp; b\""),
        ],
    );
    change(Rename(Object(2), "it's"), &[("'b'", "'it&apos;s'")]);
    change(
        Insert("<object type=\"plane\"\n  name=\"p\"/>", Object(1)),
        &[(
            "material=\"m\"/>\n",
            "material=\"m\"/>\n      <object type=\"plane\"\n        name=\"p\"/>\n",
        )],
    );
    for (change, reason) in [
        (
            Down(Object(2)),
            "b (sphere) is already the last in its group",
        ),
        (Rename(Object(0), " "), "a name must not be empty"),
        (
            Insert("<camera/>", Object(0)),
            "cannot paste this: expected lights, materials or objects, not <camera>",
        ),
        (
            Insert("</xml><xml>", Object(0)),
            "cannot paste this: this is not part of XML",
        ),
        (
            Delete(&[Node::Background]),
            "background cannot be copied, moved or deleted",
        ),
    ] {
        check(Language::Xml, xml(), change, Err(reason));
    }
}

#[test]
fn copies_go_into_an_empty_scene() {
    for (before, after) in [
        (
            "<xml>\n  <scene/>\n</xml>",
            "<xml>\n  <scene>\n    <light type=\"ambient\"/>\n  </scene>\n</xml>",
        ),
        (
            "<xml><scene></scene></xml>",
            "<xml><scene>\n  <light type=\"ambient\"/>\n</scene></xml>",
        ),
    ] {
        let insert = Insert("\n  <light type=\"ambient\"/>\n", Node::View);
        check(Language::Xml, before, insert, Ok(after));
    }
}

/// Random changes of structure of the sample scenes.
#[test]
fn random_changes_of_structure_leave_no_error_and_are_undone_to_the_byte() {
    let mut random = Random(19);
    let mut changed = 0;
    for (language, original) in [
        (Language::Ray, include_str!("../../../scenes/default.ray")),
        (Language::Ray, include_str!("../../../scenes/example.ray")),
        (
            Language::Dat,
            include_str!("../../../scenes/still-life.dat"),
        ),
        (Language::Dat, include_str!("../../../scenes/pool.dat")),
        (Language::Xml, include_str!("../../../scenes/courtyard.xml")),
        (Language::Xml, include_str!("../../../scenes/carousel.xml")),
    ] {
        for _ in 0..12 {
            let (mut source, _) = read_as(language, original, &Meshes::default());
            let mut undo = Vec::new();
            for _ in 0..12 {
                let Some(edits) = random_change(&source, &mut random) else {
                    continue;
                };
                let inverse = source.change(&edits);
                let lowered = source.lower(&Meshes::default()).expect("there is memory");
                // A texture or a material may have moved before what it uses: the interface refuses.
                if lowered.diagnostics.errors() == 0 {
                    undo.push(inverse);
                    continue;
                }
                assert_eq!(
                    language,
                    Language::Dat,
                    "{}\n{:?}",
                    source.text(),
                    lowered.diagnostics
                );
                source.change(&inverse);
                source.lower(&Meshes::default()).expect("there is memory");
            }
            changed += undo.len();
            for inverse in undo.iter().rev() {
                source.change(inverse);
            }
            assert_eq!(**source.text(), *original);
        }
    }
    assert!(400 < changed, "{changed}");
}

fn random_change(source: &Source, random: &mut Random) -> Option<Vec<Edit>> {
    let nodes = source.nodes();
    let node = nodes.get(random.below(nodes.len()))?;
    let edits = match random.below(7) {
        0 => source.removal(&[node]),
        1 => {
            let other = nodes.get(random.below(nodes.len()))?;
            let copied = source.copied(&[node, other]);
            copied.and_then(|copied| Ok(source.insertion(&copied, other)?.edits))
        }
        2 => source
            .exchange(node, Neighbour::Next)
            .map(|placed| placed.edits),
        3 => source
            .exchange(node, Neighbour::Previous)
            .map(|placed| placed.edits),
        4 => source.orthonormalised(node),
        5 => {
            let name = random.below(1000).to_string();
            let created = source.creation(Category::Material, &name, node);
            created.map(|placed| placed.edits)
        }
        _ => source.renaming(node, &random.below(1000).to_string()),
    };
    edits.ok().filter(|edits| !edits.is_empty())
}

#[test]
fn a_byte_order_mark_stays_in_front_of_the_first_line() {
    let [first, second] = [
        "# a\nmat ID 1 1 0 0 .1 .5 .4 9 0 0 1\n",
        "# b\nmat ID 2 1 0 0 .1 .5 .4 9 0 0 1\n",
    ];
    let text = format!("{first}{second}");
    let moved = format!("{second}{first}");
    check(Language::Dat, &text, Down(Material(0)), Ok(&moved));
    check(Language::Dat, &text, Delete(&[Material(0)]), Ok(second));
}
