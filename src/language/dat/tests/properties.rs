//! Property tests of lowering, with random texts and edits.

use proptest::prelude::*;

use super::read;
use crate::dat::Dat;
use crate::dat::schema::SCHEMA;
use crate::engine::lines::Lines;
use crate::node::Node;
use crate::schema::{Category, Field, Kind, Slot};
use crate::tests::{Random, damage};
use crate::written::Parse;
use text::{Edit, Span, apply};

/// The records of a random scene, each as its tokens. IDs are the indices in their category.
pub(super) fn records(random: &mut Random) -> Vec<Vec<String>> {
    let mut records = Vec::new();
    let (materials, textures) = (1 + random.below(3), random.below(3));
    let objects = 1 + random.below(6);
    let mut say = |name: &str, id: usize, limits: [usize; 3]| {
        let kind = SCHEMA.records.iter().find(|record| record.name == name);
        let kind = kind.expect("the table has it");
        let mut record: Vec<String> = kind.heads.iter().map(|&head| head.to_owned()).collect();
        let mut axis = 0;
        let mut fill = |record: &mut Vec<String>, slots: &[Slot]| {
            for slot in slots {
                match slot {
                    Slot::Word(word) => record.push((*word).to_owned()),
                    Slot::Id => record.push(id.to_string()),
                    Slot::Field(field) => record.extend(literals(random, field, &mut axis, limits)),
                }
            }
        };
        fill(&mut record, kind.slots);
        if let Some(repeat) = &kind.repeat {
            let count = records.len() % 3;
            record.push(count.to_string());
            for _ in 0..count {
                fill(&mut record, repeat.slots);
            }
        }
        records.push(record);
    };
    let limits = [materials, textures, 0];
    for name in ["camera", "resolution", "viewport"] {
        say(name, 0, limits);
    }
    for id in 0..2 {
        say("light", id, limits);
    }
    for id in 0..materials {
        say("mat", id, limits);
    }
    for id in 0..textures {
        say(["checker", "image"][id % 2], id, limits);
    }
    if 0 < textures {
        say("use colour", 0, limits);
        say("use bump", 0, limits);
    }
    for id in 0..objects {
        let kinds = ["sphere", "ellipsoid", "cylinder", "box", "quadric", "CSG"];
        let kind = kinds[(3 * id + materials) % if id == 0 { 5 } else { 6 }];
        say(kind, id, [materials, textures, id]);
    }
    let place = random.below(records.len() + 1);
    let list = [
        "render".to_owned(),
        "1".to_owned(),
        "ID".to_owned(),
        "0".to_owned(),
    ];
    records.insert(place, list.to_vec());
    records
}

/// Literals of a field: axes are orthogonal, references refer to earlier records.
fn literals(
    random: &mut Random,
    field: &Field,
    axis: &mut usize,
    [materials, textures, objects]: [usize; 3],
) -> Vec<String> {
    let own = *axis;
    *axis += usize::from(matches!(field.kind, Kind::Direction | Kind::Axis));
    (0..field.kind.components())
        .map(|at| match field.kind {
            Kind::Direction | Kind::Axis => u8::from(at == own).to_string(),
            Kind::Choice(words) => random.pick(words).to_owned(),
            Kind::Reference(category) => {
                let known = match category {
                    Category::Material => materials,
                    Category::Texture => textures,
                    Category::Light | Category::Object => objects,
                };
                random.below(known.max(1)).to_string()
            }
            Kind::Word => random.pick(&["a.png", "é/b.ppm"]).to_owned(),
            Kind::HalfSpace if at == 3 => random.literal(field).replace('-', ""),
            // The eye is far from the target, and far is beyond near.
            _ if field.key == "eye" => format!("{}", 100 + random.below(9)),
            _ if field.key == "far" => "1e9".to_owned(),
            _ => random.literal(field),
        })
        .collect()
}

/// The records with random white space between tokens, and comments between lines.
fn laid_out(records: &[Vec<String>], random: &mut Random) -> String {
    const GAPS: [&str; 5] = [" ", "  ", "\t", "\u{A0}", "\u{B}"];
    const ENDS: [&str; 9] = [
        "\n",
        "\r",
        " \r# é\r",
        "\r\n",
        "\r\r\n",
        " \t\n",
        "\n\n",
        "\n# é obj\n",
        "\r\n //\r\n",
    ];
    let mut text = random.pick(&["", "\u{FEFF}", "\n", "// \r\n"]).to_owned();
    for record in records {
        for (at, token) in record.iter().enumerate() {
            if 0 < at {
                text.push_str(random.pick(&GAPS));
            }
            text.push_str(token);
        }
        text.push_str(random.pick(&ENDS));
    }
    match random.below(2) {
        0 => text.trim_end().to_owned(),
        _ => text,
    }
}

#[test]
fn layout_does_not_matter() {
    let mut random = Random(11);
    let mut sound = 0;
    for _ in 0..1_000 {
        let records = records(&mut random);
        let text = laid_out(&records, &mut random);
        let tree = Lines::<Dat>::parse(&text);
        let (_, lowered) = read(&text);
        let found = (0..tree.records.len()).map(|at| {
            let tokens = tree.tokens(&text, at);
            tokens
                .map(|token| token.of(&text).to_owned())
                .collect::<Vec<_>>()
        });
        assert!(found.eq(records.iter().cloned()), "{text:?}");
        let plain: Vec<_> = records.iter().map(|record| record.join(" ")).collect();
        let (_, plain) = read(&plain.join("\n"));
        sound += u32::from(lowered.scene.is_some());
        assert_eq!(lowered.scene, plain.scene, "{text:?}");
    }
    assert!(800 < sound, "{sound} without errors");
}

/// The text of each field.
fn said(text: &str) -> Vec<(Node, &'static str, Vec<String>)> {
    let (source, _) = read(text);
    let nodes = source.nodes();
    let of = |node| {
        let placed = source.fields(node).into_iter();
        placed.map(move |placed| {
            let words = placed.spans.iter().map(|span| span.of(text).to_owned());
            (node, placed.field.key, words.collect())
        })
    };
    nodes.iter().flat_map(of).collect()
}

/// Edits of fields change only the bytes of their tokens, and undoing them restores every byte.
#[test]
fn an_edit_at_a_place_changes_only_that_field() {
    let mut random = Random(12);
    let mut edits = 0;
    while edits < 10_000 {
        let mut text = laid_out(&records(&mut random), &mut random);
        let first = text.clone();
        let mut undo = Vec::new();
        for _ in 0..25 {
            let (source, _) = read(&text);
            let nodes: Vec<_> = source.nodes().iter().collect();
            let node = nodes[random.below(nodes.len())];
            let placed = source.fields(node);
            let at = random.below(placed.len());
            if !placed[at].is_explicit() {
                continue;
            }
            let component = random.below(placed[at].spans.len());
            let (field, span) = (placed[at].field, placed[at].spans[component]);
            let literal = match field.kind {
                Kind::Choice(words) => random.pick(words).to_owned(),
                Kind::Reference(_) | Kind::Word => continue,
                _ => random.literal(field),
            };
            let mut expected = said(&text);
            let own = expected.iter_mut().filter(|(of, ..)| *of == node).nth(at);
            let (_, key, words) = own.expect("the field is among what is said");
            assert_eq!((*key, &words[component][..]), (field.key, span.of(&text)));
            words[component].clone_from(&literal);
            let (head, tail) = (&text[..span.start()], &text[span.end()..]);
            let edited = format!("{head}{literal}{tail}");
            let edit = Edit {
                span,
                text: literal,
            };
            undo.push(apply(&mut text, &[edit]));
            assert_eq!(text, edited);
            assert_eq!(said(&text), expected, "{text:?}");
            edits += 1;
        }
        while let Some(inverse) = undo.pop() {
            apply(&mut text, &inverse);
        }
        assert_eq!(text, first);
    }
}

/// Damages a text at a random place.
fn mutate(text: &mut String, random: &mut Random) {
    const WORDS: [&str; 20] = [
        "obj",
        "sphere",
        "CSG",
        "quadric",
        "ID",
        "mat",
        "render",
        "light",
        "use",
        "texture",
        "image",
        "-1",
        "0",
        "1e999",
        "1,5",
        "é",
        "//",
        "\n",
        "9223372036854775807",
        "\u{A0}\u{1b}",
    ];
    damage(text, &read(text).0.leaves(), &WORDS, random);
}

/// Lowers an arbitrary text and checks that the results are consistent with it.
fn check_any(text: &str) {
    let (source, lowered) = read(text);
    let within = |span: Span| text.get(span.range()).is_some();
    for diagnostic in &*lowered.diagnostics {
        assert!(within(diagnostic.span), "{text:?}");
        assert!(!diagnostic.message.is_empty() && !diagnostic.expected.is_empty());
    }
    assert!(
        lowered
            .diagnostics
            .is_sorted_by_key(|diagnostic| diagnostic.span.start())
    );
    let errors = 0 < lowered.diagnostics.errors();
    assert_eq!(lowered.scene.is_none(), errors, "{text:?}");
    for node in source.nodes().iter() {
        assert!(!source.name(node).is_empty());
        assert!(within(source.span(node)));
        let _ = source.comment(node);
        for placed in source.fields(node) {
            let complete = placed.spans.len() == placed.field.kind.components();
            assert!(complete || (node == Node::View && placed.spans.is_empty()));
            let is_explicit = placed.is_explicit();
            for span in placed.spans {
                assert!(within(span), "{text:?}");
                if is_explicit {
                    assert_eq!(source.node_at(span), Some(node), "{text:?}");
                }
            }
        }
    }
    let Some(scene) = lowered.scene else {
        return;
    };
    for (index, object) in scene.objects.iter().enumerate() {
        let own = source.object(index as u32);
        assert!(
            source.nodes().iter().any(|node| node == Node::Object(own)),
            "{text:?}"
        );
        assert_eq!(source.drawn(own), Some(index as u32));
        assert!((object.material as usize) < scene.materials.len());
    }
    for material in scene.materials.iter() {
        let Some(maps) = &material.maps else {
            continue;
        };
        let bump = maps.bump.map(|bump| bump.texture);
        let used = [maps.ambient, maps.diffuse, maps.specular, bump];
        assert!(
            used.into_iter()
                .flatten()
                .all(|texture| (texture as usize) < scene.textures.len())
        );
    }
}

#[test]
fn damaged_texts_are_read_to_the_end() {
    let mut random = Random(13);
    for _ in 0..2_000 {
        let mut text = laid_out(&records(&mut random), &mut random);
        for _ in 0..=random.below(6) {
            mutate(&mut text, &mut random);
            check_any(&text);
        }
    }
}

#[test]
fn any_bytes_can_be_read() {
    let mut random = Random(14);
    for _ in 0..2_000 {
        let bytes: Vec<u8> = (0..random.below(200))
            .map(|_| random.next() as u8)
            .collect();
        check_any(&String::from_utf8_lossy(&bytes));
    }
}

proptest! {
    #![proptest_config(repeatable::config())]

    #[test]
    fn any_words_can_be_read(text in "((1|-2.5|0|obj|sphere|CSG|quadric|mat|ID|light|pnt|use|bump|texture|image|render|camera|viewport|#|//|\n) ?){0,80}") {
        check_any(&text);
    }
}
