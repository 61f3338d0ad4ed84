//! Random texts and edits.

use super::read;
use crate::schema::Kind;
use crate::tests::{Random, damage};
use crate::{FieldSpans, Node, Source};
use text::{Edit, Span, apply};

const SCENES: [&str; 3] = [
    include_str!("../../../../scenes/lanterns.test"),
    include_str!("../../../../tests/it/cse167/tower.test"),
    include_str!("../../../../tests/it/cse167/layout.test"),
];

/// The fields of all nodes, with their words. A command may state a part of several materials.
fn said(source: &Source) -> Vec<(Node, &'static str, Span, String)> {
    let text = source.text();
    let of = |node| {
        let placed = source
            .fields(node)
            .into_iter()
            .filter(FieldSpans::is_explicit);
        placed.flat_map(move |placed| {
            let key = placed.field.key;
            let words = placed.spans.into_iter();
            words.map(move |span| (node, key, span, span.of(text).to_owned()))
        })
    };
    source.nodes().iter().flat_map(of).collect()
}

#[test]
fn an_edit_at_a_place_changes_only_that_word() {
    let mut random = Random(41);
    for edits in 0..10_000 {
        let text = SCENES[edits % SCENES.len()];
        let (source, _) = read(text);
        let nodes: Vec<_> = source.nodes().iter().collect();
        let node = nodes[random.below(nodes.len())];
        let fields = source.fields(node);
        if fields.is_empty() {
            continue;
        }
        let placed = &fields[random.below(fields.len())];
        if !placed.is_explicit() || matches!(placed.field.kind, Kind::Choice(_) | Kind::Word) {
            continue;
        }
        let component = random.below(placed.spans.len());
        let literal = random.literal(placed.field);
        let span = placed.spans[component];
        let changed = placed.edits(&*source, &[(component, literal.clone())]);
        let expected = [&text[..span.start()], &literal, &text[span.end()..]].concat();
        let mut edited = text.to_owned();
        let undo = apply(&mut edited, &changed);
        assert_eq!(edited, expected, "{node:?} {}", placed.field.key);
        let (after, _) = read(&edited);
        let words = |source: &Source| said(source).into_iter().map(|(.., word)| word);
        let different = words(&source)
            .zip(words(&after))
            .filter(|(old, new)| old != new);
        let different: Vec<_> = different.collect();
        let is_own = different.iter().all(|(_, new)| *new == literal);
        assert!(
            is_own,
            "{node:?} {} {literal} {different:?}",
            placed.field.key
        );
        apply(&mut edited, &undo);
        assert_eq!(edited, text);
    }
}

#[test]
fn a_value_of_its_own_changes_no_other_object() {
    let mut random = Random(53);
    let mut changed = 0;
    for round in 0..1_000 {
        let text = SCENES[round % SCENES.len()];
        let (source, before) = read(text);
        let objects = source.nodes().objects;
        let object = random.below(objects);
        let node = Node::Object(object);
        let fields = source.fields(node).into_iter();
        let fields: Vec<_> = fields.filter(|placed| !placed.is_explicit()).collect();
        if fields.is_empty() {
            continue;
        }
        let placed = &fields[random.below(fields.len())];
        let component = random.below(placed.spans.len());
        let literal = random.literal(placed.field);
        let mut edited = text.to_owned();
        let edits = placed.edits(&*source, &[(component, literal.clone())]);
        let undo = apply(&mut edited, &edits);
        let (again, after) = read(&edited);
        let Some((before, after)) = before.scene.zip(after.scene) else {
            panic!("{edited}");
        };
        let stated = again.fields(node).into_iter();
        let mut stated = stated.filter(|now| now.field == placed.field);
        let now = stated.next().expect("it is still there");
        assert_eq!(now.spans[component].of(&edited), literal, "{edited}");
        let drawn = source.drawn(object);
        for (index, (old, new)) in (0..).zip(before.objects.iter().zip(after.objects.iter())) {
            let [old, new] = [(&before, old), (&after, new)]
                .map(|(scene, object)| &scene.materials[object.material as usize]);
            assert!(Some(index) == drawn || old == new, "{edited}");
        }
        changed += 1;
        apply(&mut edited, &undo);
        assert_eq!(edited, text);
    }
    assert!(500 < changed, "{changed}");
}

/// Lowers an arbitrary text and checks that the results are consistent with it.
fn check_any(text: &str) {
    let (source, lowered) = read(text);
    let within = |span: Span| text.get(span.range()).is_some();
    for diagnostic in &*lowered.diagnostics {
        assert!(within(diagnostic.span), "{text:?}");
        assert!(!diagnostic.message.is_empty() && !diagnostic.expected.is_empty());
    }
    let errors = 0 < lowered.diagnostics.errors();
    assert_eq!(lowered.scene.is_none(), errors, "{text:?}");
    for node in source.nodes().iter() {
        assert!(!source.name(node).is_empty());
        assert!(within(source.span(node)));
        let _ = (
            source.comment(node),
            source.pose(node),
            source.copied(&[node]),
        );
        let _ = (source.removal(&[node]), source.consequence(&[node]));
        for placed in source.fields(node) {
            assert!(placed.spans.iter().all(|span| within(*span)), "{text:?}");
        }
    }
    let Some(scene) = lowered.scene else {
        return;
    };
    for (index, object) in scene.objects.iter().enumerate() {
        let own = source.object(index as u32);
        assert_eq!(source.drawn(own), Some(index as u32), "{text:?}");
        let listed = source
            .nodes()
            .iter()
            .filter(|node| matches!(node, Node::Material(_)));
        let material = Some(object.material as usize).filter(|&material| material < listed.count());
        assert_eq!(source.material(own), material, "{text:?}");
        assert!((object.material as usize) < scene.materials.len());
    }
}

#[test]
fn damaged_texts_are_read_to_the_end() {
    const WORDS: [&str; 22] = [
        "sphere",
        "tri",
        "trinormal",
        "vertex",
        "vertexnormal",
        "pushTransform",
        "popTransform",
        "scale",
        "rotate",
        "camera",
        "quadLight",
        "ambient",
        "-1",
        "0",
        "1e999",
        "1,5",
        "é",
        "#",
        "\n",
        "9223372036854775807",
        "\u{A0}\u{1b}",
        "maxdepth",
    ];
    let mut random = Random(43);
    for round in 0..2_000 {
        let mut text = SCENES[round % SCENES.len()].to_owned();
        for _ in 0..=random.below(6) {
            let leaves = read(&text).0.leaves();
            damage(&mut text, &leaves, &WORDS, &mut random);
            check_any(&text);
        }
    }
}

/// Structural edits leave a text without errors, and undoing them restores every byte.
#[test]
fn random_changes_of_structure_are_undone_to_the_byte() {
    let mut random = Random(47);
    let mut changed = 0;
    for round in 0..600 {
        let mut text = SCENES[round % SCENES.len()].to_owned();
        let first = text.clone();
        let mut undo = Vec::new();
        for _ in 0..4 {
            let (source, lowered) = read(&text);
            assert!(lowered.scene.is_some(), "{text}");
            let nodes: Vec<_> = source.nodes().iter().collect();
            let node = nodes[random.below(nodes.len())];
            let edits: Option<Vec<Edit>> = match random.below(3) {
                0 => source.removal(&[node]).ok(),
                1 => {
                    let copied = source.copied(&[node]).ok();
                    let after = nodes[random.below(nodes.len())];
                    copied.and_then(|copy| Some(source.insertion(&copy, after).ok()?.edits))
                }
                _ => {
                    let towards = [crate::Neighbour::Previous, crate::Neighbour::Next];
                    let neighbour = towards[random.below(2)];
                    source
                        .exchange(node, neighbour)
                        .ok()
                        .map(|placed| placed.edits)
                }
            };
            if let Some(edits) = edits {
                changed += 1;
                undo.push(apply(&mut text, &edits));
            }
        }
        let (_, lowered) = read(&text);
        assert_eq!(lowered.diagnostics.errors(), 0, "{text}");
        while let Some(inverse) = undo.pop() {
            apply(&mut text, &inverse);
        }
        assert_eq!(text, first);
    }
    assert!(400 < changed, "{changed}");
}
