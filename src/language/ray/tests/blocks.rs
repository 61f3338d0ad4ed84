//! Long texts mean the same whether they are read by blocks or in order.

use std::sync::Arc;

use proptest::prelude::*;

use crate::language::ray::lower::lower_in_order;
use crate::language::ray::{self, again};
use crate::language::{Answers, Before, Editable, Lowered};
use crate::scene::blocks::BLOCK;
use crate::scene::{Meshes, Scene};
use crate::text::{Edit, Span};

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

/// Replaces the bytes `old`; returns their span and the new one.
fn put(source: &mut ray::Source, old: Span, literal: &str) -> [Span; 2] {
    let edit = Edit {
        span: old,
        text: literal.to_owned(),
    };
    let changed = edit.placed();
    source.change(&[edit]);
    [old, changed]
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
        let spans = source.tree.tokens.range(number..number + 40);
        let old = spans.into_iter().find(is_number).expect("a number");
        let spans = put(&mut source, old, literal);
        let known = before(&lowered).expect("a scene without errors");
        let again = again::lower(&source.text, &source.tree, &source.origins, &known, spans);
        let (origins, again) = again.expect("nothing else has changed");
        source.place(origins);
        let (fresh, expected) = read(&source.text);
        assert_eq!(parts(&source, &again), parts(&fresh, &expected));
        lowered = again;
    }
}

#[test]
fn a_changed_header_or_comment_reads_no_object_again() {
    let edits = [
        ("1 1 1  1  0 5 5", "1 1 1", "0.5 0.25 0", true),
        ("0 5 5", "5 5", "5 6.125", true),
        ("  1 1 1  ", "1 1 1", "0.75 1 2", true),
        ("target 0 0 0", "0 0 0", "1 2 3", true),
        ("spp 4", "4", "9 depth 3", true),
        ("spp 9", "9", "x", true),
        // Of another view comment, which is ignored.
        ("fov 5", "5", "7", false),
        // Now the first view comment is malformed, and the other one counts.
        ("target 1 2 3", "3", "3 ", true),
        ("target", "target", "target 4", true),
        ("target 4", " 4", "", false),
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
        for (context, old, new, is_incremental) in edits {
            let at = source.text.find(context).expect("it is there");
            let at = at + context.find(old).expect("it is part of it");
            let known = before(&lowered).expect("a scene without errors");
            let spans = put(&mut source, Span::new(at, at + old.len()), new);
            let again = again::lower(&source.text, &source.tree, &source.origins, &known, spans);
            assert_eq!(again.is_some(), is_incremental, "{old} to {new}");
            let (fresh, expected) = read(&source.text);
            let (origins, again) = again.unwrap_or_else(|| (fresh.origins.clone(), expected));
            source.place(origins);
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
    let spans = put(&mut source, Span::new(at, at + old.len()), "2");
    let again = source.lower_again(
        &Meshes::default(),
        before(&lowered).expect("a scene"),
        spans,
    );
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
    let spans = put(&mut source, Span::new(at - 7, at), "4 -1 0.75");
    let known = before(&lowered).expect("a scene without errors");
    let again = source.lower_again(&Meshes::default(), known, spans);
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
    let spans = put(&mut source, Span::new(at, at + colour.len()), "0.5 0.25 1");
    let known = before(&lowered).expect("a scene without errors");
    let again = source.lower_again(&Meshes::default(), known, spans);
    let scene = again.expect("there is memory").scene.expect("no errors");
    let before = &known.scene.materials;
    let blocks = before.blocks().iter().zip(scene.materials.blocks());
    let shared: Vec<_> = blocks.map(|(one, other)| Arc::ptr_eq(one, other)).collect();
    assert_eq!(shared, [true, false, true]);
    let other = before.differences(&scene.materials, |one, other| one != other);
    assert_eq!(other.collect::<Vec<_>>(), [BLOCK + 6]);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..crate::repeatable() })]

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
            let tokens = &source.tree.tokens;
            let token = place.index(tokens.len());
            let last = tokens.get(tokens.len().min(token + more + 1) - 1);
            let old = tokens.get(token).expect("a token").to(last.expect("a token"));
            let literal = vec![literal; more + 1].join("\n");
            let spans = put(&mut source, old, &literal);
            let (fresh, expected) = read(&source.text);
            lowered = match before(&lowered) {
                Some(known) => source.lower_again(&Meshes::default(), known, spans),
                None => source.lower(&Meshes::default()),
            }
            .expect("there is memory");
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
