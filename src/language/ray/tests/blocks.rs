//! Long texts mean the same whether they are read by blocks or in order.

use std::sync::Arc;

use proptest::prelude::*;

use crate::ray;
use crate::ray::lower::lower_in_order;
use crate::{
    Before, Editable, Lowered, Neighbour, Node, SceneText, StructureEdits, StructureError,
};
use scene::blocks::BLOCK;
use scene::{Meshes, Scene};
use text::{Edit, Span};

/// For a text without warnings.
const NONE: usize = 1;

/// A text of `objects` objects in repeating colours, with a warning for every `warned`th.
fn text(objects: usize, declared: usize, warned: usize) -> String {
    let frame = "1 2 3  1 0 0  0 1 0  0 0 1  4 5 6";
    let mut text = format!("1 1 1  1  0 5 5  1 1 1  {declared}\n");
    for number in 0..objects {
        let shape = match number % 7 {
            0 => format!("box {frame}"),
            _ if number % warned == 3 => format!("Cone {frame}"),
            _ => format!("sphere {number} 2 3 0.5"),
        };
        let red = f64::from(number as u32 / 3 * 7 % 40) / 39.0;
        let object = format!("{shape}  {red} 0 0  0 1 0  0 0 1  20 0 0 1 // {number}\n");
        text.push_str(&object);
    }
    text
}

/// Parses and lowers a text.
pub(super) fn read(text: &str) -> (ray::Source, Lowered) {
    let mut source = ray::Source::new(Arc::new(text.to_owned()));
    let lowered = source.lower(&Meshes::default()).expect("there is memory");
    (source, lowered)
}

/// Replaces the bytes `old`.
fn put(source: &mut ray::Source, old: Span, literal: &str) {
    source.change(&[Edit {
        span: old,
        text: literal.to_owned(),
    }]);
}

/// A text without what follows `//` on its lines.
fn without_comments(text: &str) -> String {
    let lines = text
        .lines()
        .map(|line| line.split("//").next().unwrap_or_default());
    lines.collect::<Vec<_>>().join("\n")
}

fn before(lowered: &Lowered) -> Option<Before<'_>> {
    Some(Before {
        scene: lowered.scene.as_ref()?,
        diagnostics: &lowered.diagnostics,
    })
}

fn parts<'l>(source: &ray::Source, lowered: &'l Lowered) -> (&'l Option<Scene>, String) {
    let rest = format!("{:?} {:?}", lowered.diagnostics, source.origins);
    (&lowered.scene, rest)
}

#[test]
fn a_changed_number_reads_only_its_block_again() {
    let text = text(2 * BLOCK + 9, 2 * BLOCK + 9, 400);
    let (mut source, mut lowered) = read(&format!("// view: eye 0 0 9 target 0 0 0\n{text}"));
    for (number, literal) in [(900, "0.25"), (30_000, "1e-1"), (500, "+7")] {
        let is_number = |token: &Span| token.of(&source.text).starts_with('0');
        let spans = source.tree.range(number..number + 40);
        let old = spans.into_iter().find(is_number).expect("a number");
        put(&mut source, old, literal);
        let known = before(&lowered).expect("a scene without errors");
        let again = source
            .lower_change(known)
            .expect("nothing else has changed");
        let (fresh, expected) = read(&source.text);
        assert_eq!(parts(&source, &again), parts(&fresh, &expected));
        lowered = again;
    }
}

#[test]
fn a_changed_header_or_comment_reads_no_object_again() {
    let edits = [
        ("1 1 1  1  0 5 5", "1 1 1", "0.5 0.25 0"),
        ("0 5 5", "5 5", "5 6.125"),
        ("  1 1 1  ", "1 1 1", "0.75 1 2"),
        ("target 0 0 0", "0 0 0", "1 2 3"),
        ("spp 4", "4", "9 depth 3"),
        ("spp 9", "9", "x"),
        // Of another view comment, which is ignored.
        ("fov 5", "5", "7"),
        // Now the first view comment is malformed, and the other one counts.
        ("target 1 2 3", "3", "3 "),
        ("target", "target", "target 4"),
        ("target 4", " 4", ""),
    ];
    let comments = "// view: eye 0 0 9 target 0 0 0\n// render: spp 4\n// view: fov 5\n";
    for (count, eye) in [
        (BLOCK + 9, "eye 0 0 9"),
        (40, "eye 0 0 9"),
        (40, "up 0 0 1"),
    ] {
        let text = text(count, count, count / 5);
        let said = format!("{comments}{text}").replacen("eye 0 0 9", eye, 1);
        let (mut source, mut lowered) = read(&said);
        for (context, old, new) in edits {
            let at = source.text.find(context).expect("it is there");
            let at = at + context.find(old).expect("it is part of it");
            let known = before(&lowered).expect("a scene without errors");
            put(&mut source, Span::new(at, at + old.len()), new);
            let again = source.lower_change(known);
            let again = again.expect("no object is read again");
            let (fresh, expected) = read(&source.text);
            assert_eq!(
                parts(&source, &again),
                parts(&fresh, &expected),
                "{old} to {new}"
            );
            lowered = again;
        }
    }
}

/// The replaced text ends with the marker of a comment, so that an object in it counts now.
#[test]
fn numbers_in_place_of_a_comment_are_read_again_with_all_objects() {
    let text = "// view: eye 0 0 9 target 0 0 0
        1 1 1  1  0 5 5  1 1 1 1 sphere 0 0 9 // 1 sphere 4 0 9
        1  1 0 0  0 1 0  0 0 1  20 0 0 1\n";
    let (mut source, lowered) = read(text);
    let old = "1 1 sphere 0 0 9 //";
    let at = text.find(old).expect("it is there");
    put(&mut source, Span::new(at, at + old.len()), "2");
    let known = before(&lowered).expect("a scene");
    let again = source.lower_again(&Meshes::default(), known);
    let (fresh, expected) = read(&source.text);
    assert_eq!(
        parts(&source, &again.expect("there is memory")),
        parts(&fresh, &expected)
    );
    assert_ne!(lowered.scene, expected.scene);
}

#[test]
fn an_edit_of_a_shape_copies_only_its_block() {
    let text = text(3 * BLOCK, 3 * BLOCK, 400);
    let (mut source, lowered) = read(&format!("// view: eye 0 0 9 target 0 0 0\n{text}"));
    let sphere = format!("sphere {} 2 3 0.5", BLOCK + 6);
    let at = source.text.find(&sphere).expect("it is there") + sphere.len();
    put(&mut source, Span::new(at - 7, at), "4 -1 0.75");
    let known = before(&lowered).expect("a scene without errors");
    let again = source.lower_again(&Meshes::default(), known);
    let before = known.scene.objects.clone();
    let after = again
        .expect("there is memory")
        .scene
        .expect("no errors")
        .objects;
    let blocks = before.blocks().iter().zip(after.blocks());
    let shared: Vec<_> = blocks.map(|(one, other)| Arc::ptr_eq(one, other)).collect();
    assert_eq!(shared, [true, false, true]);
    let other = before.differences(&after, |one, other| one != other);
    assert_eq!(other.collect::<Vec<_>>(), [BLOCK + 6]);
}

#[test]
fn an_edit_of_a_colour_copies_only_the_block_of_its_material() {
    let count = 3 * BLOCK;
    let mut text = format!("// view: eye 0 0 9 target 0 0 0\n1 1 1  1  0 5 5  1 1 1  {count}\n");
    for number in 0..count {
        let object =
            format!("sphere {number} 2 3 0.5  0.{number:04} 0 0  0 1 0  0 0 1  20 0 0 1\n");
        text.push_str(&object);
    }
    let (mut source, lowered) = read(&text);
    let colour = format!("0.{:04} 0 0", BLOCK + 6);
    let at = source.text.find(&colour).expect("it is there");
    put(&mut source, Span::new(at, at + colour.len()), "0.5 0.25 1");
    let known = before(&lowered).expect("a scene without errors");
    let again = source.lower_again(&Meshes::default(), known);
    let scene = again.expect("there is memory").scene.expect("no errors");
    let before = &known.scene.materials;
    let blocks = before.blocks().iter().zip(scene.materials.blocks());
    let shared: Vec<_> = blocks.map(|(one, other)| Arc::ptr_eq(one, other)).collect();
    assert_eq!(shared, [true, false, true]);
    let other = before.differences(&scene.materials, |one, other| one != other);
    assert_eq!(other.collect::<Vec<_>>(), [BLOCK + 6]);
}

/// Makes edits and reads the text again; fails if that reads the objects that are as before.
fn restructured(
    source: &mut ray::Source,
    before_edits: &Lowered,
    edits: Result<Vec<Edit>, StructureError>,
) -> Lowered {
    source.change(&edits.expect("it can be done"));
    let known = before(before_edits).expect("a scene without errors");
    let again = source.lower_change(known).expect("the rest is as before");
    let (fresh, expected) = read(&source.text);
    assert_eq!(parts(source, &again), parts(&fresh, &expected));
    again
}

#[test]
fn a_changed_list_reads_only_the_changed_objects_again() {
    let count = 2 * BLOCK;
    for view in ["eye 0 0 9 target 0 0 0", "up 0 0 1"] {
        let text = format!("// view: {view}\n{}", text(count, count, NONE));
        let (mut source, mut lowered) = read(&text);
        let mut make = |edits: &dyn Fn(&ray::Source) -> Result<Vec<Edit>, StructureError>| {
            let edits = edits(&source);
            lowered = restructured(&mut source, &lowered, edits);
            lowered.scene.as_ref().map(|scene| scene.objects.len())
        };
        let sphere = "sphere 0 0 0 1  .5 0 0  0 0 0  0 0 0  1 0 0 1 // new\n";
        for object in [0, 1, BLOCK - 1, BLOCK, count - 1].map(Node::Object) {
            assert_eq!(make(&|source| source.removal(&[object])), Some(count - 1));
            let after = Node::Object(BLOCK);
            let inserted = |source: &ray::Source| Ok(source.insertion(sphere, after)?.edits);
            assert_eq!(make(&inserted), Some(count));
        }
        for (object, neighbour) in [
            (0, Neighbour::Next),
            (BLOCK, Neighbour::Previous),
            (count - 1, Neighbour::Previous),
        ] {
            let exchanged =
                |source: &ray::Source| Ok(source.exchange(Node::Object(object), neighbour)?.edits);
            assert_eq!(make(&exchanged), Some(count));
        }
        let light = "0 9 0  1 1 1\n";
        let lit = |source: &ray::Source| Ok(source.insertion(light, Node::Light(0))?.edits);
        assert_eq!(make(&lit), Some(count));
        assert_eq!(
            make(&|source| source.removal(&[Node::Light(0)])),
            Some(count)
        );
    }
}

#[test]
fn a_word_that_a_keyword_becomes_is_read_again() {
    for (old, new) in [
        ("here 1 ", " sphere 1 "),
        ("//x", "/ax"),
        ("ere 2 ", "erex 2 "),
    ] {
        let material = "0 0 0  0 0 0  0 0 0  1 0 0 1";
        let text = format!(
            "1 1 1  1  0 5 5  1 1 1  3\nsphere 1 0 0 1 {material}\n//x\nsphere 2 0 0 1 {material}\nsphere 3 0 0 1 {material}\n"
        );
        let (mut source, lowered) = read(&text);
        let at = source.text.find(old).expect("it is there");
        put(&mut source, Span::new(at, at + old.len()), new);
        let known = before(&lowered).expect("a scene without errors");
        let again = source
            .lower_again(&Meshes::default(), known)
            .expect("there is memory");
        let (fresh, expected) = read(&source.text);
        assert_eq!(parts(&source, &again), parts(&fresh, &expected));
        assert!(again.scene.is_none(), "{new}");
    }
}

#[test]
fn a_setting_removed_with_its_warning_leaves_none() {
    let text = format!("// render: spp 4 depth x\n{}", text(3, 3, NONE));
    let (mut source, lowered) = read(&text);
    let at = source.text.find(" depth x").expect("it is there");
    put(&mut source, Span::new(at, at + " depth x".len()), "");
    let known = before(&lowered).expect("a scene without errors");
    let again = source.lower_change(known).expect("no object has changed");
    let found = [&lowered, &again].map(|lowered| lowered.diagnostics.len());
    assert_eq!(found, [1, 0]);
}

#[test]
fn a_change_without_edits_keeps_the_places_when_it_is_reverted() {
    let (mut source, lowered) = read(&text(3, 3, NONE));
    let (fresh, _) = read(&source.text);
    let inverse = source.change(&[]);
    source.revert(&inverse);
    assert_eq!(parts(&source, &lowered), parts(&fresh, &lowered));
}

#[test]
fn an_object_behind_a_deleted_one_is_renamed_in_its_warning() {
    let count = BLOCK + 9;
    let (mut source, lowered) = read(&text(count, count, 400));
    let removed = source
        .removal(&[Node::Object(9)])
        .expect("there are others");
    source.change(&removed);
    let known = before(&lowered).expect("a scene without errors");
    let again = source.lower_again(&Meshes::default(), known);
    let (_, expected) = read(&source.text);
    assert_eq!(
        again.expect("there is memory").diagnostics,
        expected.diagnostics
    );
    assert_ne!(lowered.diagnostics, expected.diagnostics);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..repeatable::config() })]

    #[test]
    fn edited_texts_mean_the_same_as_new_ones(
        view in prop_oneof![
            4 => Just("// view: eye 0 0 9 target 0 0 0 fov 40\n"),
            1 => Just("// view: eye 0 0 9\n"),
        ],
        behind in prop_oneof![Just(""), Just("// view: up 0 0 1\n"), Just("left over")],
        edits in prop::collection::vec(
            (
                any::<prop::sample::Index>(),
                prop_oneof![3 => Just(0), 1 => 1..4_usize],
                prop_oneof![
                    8 => "[0-9]{0,2}\\.[0-9]", 2 => "-[0-9]", 1 => "[ /x]{0,2}1", 1 => "sphere|1 2|",
                ],
            ),
            1..12,
        ),
    ) {
        let (mut source, mut lowered) =
            read(&format!("{view}{}{behind}", text(BLOCK + 70, BLOCK + 70, 400)));
        for (place, more, literal) in edits {
            let tokens = &source.tree;
            let token = place.index(tokens.len());
            let last = tokens.get(tokens.len().min(token + more + 1) - 1);
            let old = tokens.get(token).expect("a token").to(last.expect("a token"));
            let literal = vec![literal; more + 1].join("\n");
            put(&mut source, old, &literal);
            let (fresh, expected) = read(&source.text);
            lowered = match before(&lowered) {
                Some(known) => source.lower_again(&Meshes::default(), known),
                None => source.lower(&Meshes::default()),
            }
            .expect("there is memory");
            prop_assert_eq!(parts(&source, &lowered), parts(&fresh, &expected));
        }
    }

    #[test]
    fn texts_edited_in_several_places_mean_the_same_as_new_ones(
        count in prop_oneof![3 => 2..9_usize, 1 => Just(BLOCK + 5)],
        warned in prop_oneof![Just(NONE), Just(4)],
        behind in prop_oneof![3 => Just(""), 1 => Just("left over 1 2")],
        changes in prop::collection::vec(
            prop::collection::vec(
                (
                    any::<prop::sample::Index>(),
                    0..4_usize,
                    prop_oneof![
                        "[0-9]", "[ 1/x\\\\\n\r]{0,4}", " sp", "\nsphere",
                        "// view: eye 0 0 9 target 0 0 1f\n", "//",
                    ],
                ),
                1..4,
            ),
            1..6,
        ),
    ) {
        let comments = "// render: spp 4 depth x\n// view: up 0 0 1\n";
        let (mut source, mut lowered) =
            read(&format!("{comments}{}{behind}", text(count, count, warned)));
        for change in changes {
            // Most edits near the beginning, where few objects follow.
            let len = source.text.len().min(700);
            let mut places: Vec<_> = change.iter().map(|(at, ..)| at.index(len + 1)).collect();
            places.sort_unstable();
            let mut edits = Vec::new();
            for (at, (_, more, put)) in places.into_iter().zip(change) {
                let end = (at + more).min(source.text.len());
                let is_free = edits.last().is_none_or(|edit: &Edit| edit.span.end() <= at);
                let is_whole = source.text.is_char_boundary(at) && source.text.is_char_boundary(end);
                if is_free && is_whole {
                    edits.push(Edit { span: Span::new(at, end), text: put });
                }
            }
            source.change(&edits);
            let (fresh, expected) = read(&source.text);
            lowered = match before(&lowered) {
                Some(known) => source.lower_again(&Meshes::default(), known),
                None => source.lower(&Meshes::default()),
            }
            .expect("there is memory");
            prop_assert_eq!(parts(&source, &lowered), parts(&fresh, &expected), "{:?}", source.text);
        }
    }

    #[test]
    fn changed_lists_mean_the_same_as_new_ones(
        count in prop_oneof![2..30_usize, BLOCK - 2..BLOCK + 3, 2 * BLOCK - 3..2 * BLOCK + 3],
        warned in prop_oneof![3 => Just(NONE), 1 => Just(400)],
        separator in prop_oneof![3 => Just("\n"), 1 => Just(" "), 1 => Just("\r")],
        changes in prop::collection::vec(
            (0..6, any::<prop::sample::Index>(), any::<prop::sample::Index>()), 1..9,
        ),
    ) {
        let text = match separator {
            "\n" => text(count, count, warned),
            _ => without_comments(&text(count, count, warned)).replace('\n', separator),
        };
        let (mut source, mut lowered) = read(&format!("// view: up 0 0 1\n{text}"));
        for (what, one, other) in changes {
            let objects = source.nodes().objects;
            let [one, other] = [one, other].map(|at| Node::Object(at.index(objects)));
            let edits = match what {
                0 => source.removal(&[one]),
                1 => source.removal(&[one.min(other), one.max(other)]),
                2 => source.exchange(one, Neighbour::Next).map(|placed| placed.edits),
                3 => source.insertion("0 9 0 1 1 1", Node::Light(0)).map(|placed| placed.edits),
                4 => source.removal(&[Node::Light(0)]),
                _ => {
                    let copied = source.copied(&[one]);
                    copied.and_then(|copied| Ok(source.insertion(&copied, other)?.edits))
                }
            };
            let Ok(edits) = edits else {
                continue;
            };
            source.change(&edits);
            let known = before(&lowered).expect("a list without errors stays so");
            let again = source.lower_again(&Meshes::default(), known);
            let (fresh, expected) = read(&source.text);
            lowered = again.expect("there is memory");
            prop_assert_eq!(parts(&source, &lowered), parts(&fresh, &expected));
        }
    }

    #[test]
    fn blocks_mean_the_same_as_the_whole(
        more in 0usize..400,
        miscounted in prop_oneof![4 => Just(0), 1 => Just(1)],
        change in prop_oneof![
            Just(""), Just(" "), Just("sphere"), Just(" 1 "), Just("spere 1"), Just("nought"), Just("//"),
            Just("// view: eye 0 0 9 target 0 0 0\n"), Just("\u{A0}"), Just("-"),
        ],
        removed in 0usize..9,
        place: prop::sample::Index,
    ) {
        let mut text = text(2 * BLOCK + more, 2 * BLOCK + more + miscounted, 7);
        let at = place.index(text.len() - 9);
        text.replace_range(at..at + removed, change);
        let (source, lowered) = read(&text);
        let (origins, expected) = lower_in_order(&text, &source.tree);
        prop_assert_eq!(lowered.scene, expected.scene);
        prop_assert_eq!(&lowered.diagnostics, &expected.diagnostics);
        prop_assert_eq!(format!("{:?}", source.origins), format!("{origins:?}"));
    }
}
