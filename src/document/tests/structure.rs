//! Merges of random changes of structure on both sides: nothing of either is lost, or it is asked.

use glam::DVec3;

use super::losses::{MINE, THEIRS, findings, share_a_node, wrong_leaves, wrong_values};
use super::*;
use language::{Neighbour, NewNode, Node, Visibility};
use text::smallest_edit;

/// A scene in which most numbers are the same as its counts.
const ONE: &str = "\
0.1 0.1 0.1
1
5 5 5
1 1 1
1
sphere // one
0 0 0
1
0.1 0.1 0.1
0.5 0.5 0.5
0.2 0.2 0.2
10
0 0 1
";

/// The number of merges of a language.
const MERGES: usize = 1000;

/// A linear congruential generator, the same in every run.
struct Random(u64);

impl Random {
    fn below(&mut self, bound: usize) -> usize {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (self.0 >> 33) as usize % bound.max(1)
    }
}

fn scenes(language: Language) -> Vec<&'static str> {
    match language {
        Language::Ray => vec![
            include_str!("../../../scenes/default.ray"),
            include_str!("../../../scenes/example.ray"),
            include_str!("../../../scenes/glass.ray"),
            ONE,
        ],
        Language::Dat => vec![
            include_str!("../../../scenes/still-life.dat"),
            include_str!("../../../scenes/pool.dat"),
        ],
        Language::Cse167 => vec![
            include_str!("../../../scenes/lanterns.test"),
            include_str!("../../../tests/it/cse167/spheres.test"),
            include_str!("../../../tests/it/cse167/states.test"),
            include_str!("../../../tests/it/cse167/mirrors.test"),
        ],
        Language::Xml => vec![
            include_str!("../../../scenes/spheres.xml"),
            include_str!("../../../scenes/courtyard.xml"),
            include_str!("../../../scenes/lamp.xml"),
        ],
    }
}

/// A comment that tells the side of a copy.
fn comment(language: Language, side: &str) -> String {
    match language {
        Language::Ray => format!("// {side}\n"),
        Language::Dat | Language::Cse167 => format!("# {side}\n"),
        Language::Xml => format!("<!-- {side} -->\n"),
    }
}

/// The edits of a random change of structure; `None` if it is not possible.
fn change(source: &Source, random: &mut Random, side: &str) -> Option<Vec<Edit>> {
    // Render settings have no structure.
    let nodes: Vec<_> = source
        .nodes()
        .iter()
        .filter(|node| *node != Node::Render)
        .collect();
    let node = *nodes.get(random.below(nodes.len()))?;
    let edits = match random.below(8) {
        0 => source.removal(&[node]),
        1 | 2 => {
            let copied = source.copied(&[node]).ok()?;
            let copied = format!("{}{copied}", comment(source.language(), side));
            let after = *nodes.get(random.below(nodes.len()))?;
            source.insertion(&copied, after).map(|placed| placed.edits)
        }
        3 => source
            .exchange(node, Neighbour::Next)
            .map(|placed| placed.edits),
        4 => source.renaming(node, &random.below(1000).to_string()),
        5 => {
            let kinds = source.kinds(node);
            source.retyping(node, kinds.get(random.below(kinds.len()))?)
        }
        6 => {
            let additions = source.additions();
            let wish = NewNode {
                centre: DVec3::splat(random.below(9) as f64 + 0.25),
                half: 0.5,
                up: DVec3::Z,
                decimals: 2,
                after: node,
                marked: &[],
                file: None,
            };
            let addition = additions.get(random.below(additions.len()))?;
            source
                .addition(addition.name, &wish)
                .map(|placed| placed.edits)
        }
        _ => {
            let Node::Object(object) = node else {
                return None;
            };
            let wanted = [Visibility::Hidden, Visibility::Shown][random.below(2)];
            return source.visibility_edits(&[object], wanted).ok();
        }
    };
    edits.ok().filter(|edits| !edits.is_empty())
}

/// A document with one to three random changes of a text.
fn changed(language: Language, base: &str, random: &mut Random, side: &str) -> Document {
    let mut document = Document::new(language, base.to_owned());
    document.lower(&Meshes::default()).expect("there is memory");
    let mut changes = 1 + random.below(3);
    while 0 < changes {
        let Some(edits) = change(document.source(), random, side) else {
            continue;
        };
        document.edit(&edits);
        let lowered = document.lower(&Meshes::default());
        // As the interface does.
        if lowered.expect("there is memory").diagnostics.errors() != 0 {
            document.reject();
            continue;
        }
        changes -= 1;
    }
    document
}

#[test]
fn merges_of_ray_lose_nothing_or_ask() {
    check_merges(Language::Ray);
}

#[test]
fn merges_of_dat_lose_nothing_or_ask() {
    check_merges(Language::Dat);
}

#[test]
fn merges_of_test_lose_nothing_or_ask() {
    check_merges(Language::Cse167);
}

#[test]
fn merges_of_xml_lose_nothing_or_ask() {
    check_merges(Language::Xml);
}

#[track_caller]
fn check_merges(language: Language) {
    let mut random = Random(19);
    let mut clean = 0;
    let scenes = scenes(language);
    for round in 0..MERGES {
        let base = scenes[round % scenes.len()];
        let mut mine = changed(language, base, &mut random, MINE);
        let theirs = changed(language, base, &mut random, THEIRS);
        let before = mine.text().to_owned();
        if let Err(merge) = replace(&mut mine, theirs.text()) {
            check_decisions(&mine, &merge);
        } else {
            clean += 1;
            check_merged(&mut mine, [base, &before, theirs.text()]);
        }
    }
    // In `.test` most of what is added is added at the end, where both sides meet.
    let most = if language == Language::Cse167 { 5 } else { 3 };
    assert!(MERGES < most * clean, "{clean} without a question");
}

/// Checks the merge of two changed texts.
#[track_caller]
fn check_merged(document: &mut Document, [base, mine, theirs]: [&str; 3]) {
    let (language, text) = (document.language(), document.text().to_owned());
    let mut wrong = Vec::new();
    if !share_a_node(language, base, [mine, theirs]) {
        wrong.extend(wrong_leaves(language, base, [mine, theirs], &text));
        wrong.extend(wrong_values(language, base, [mine, theirs], &text));
    }
    let [found, of_mine, of_theirs] = [&text, mine, theirs].map(|text| findings(language, text));
    assert!(
        wrong.is_empty() && found[0] == 0 && found[1] <= of_mine[1] + of_theirs[1],
        "{wrong:?} {found:?}\n{base}\n=== mine\n{mine}\n=== theirs\n{theirs}\n=== merged\n{text}"
    );
    if text != mine && document.undo().is_some() {
        assert_eq!(document.text(), mine, "undone");
    }
}

/// Decides all conflicts for one side, then for the other: one step, which undo takes back.
#[track_caller]
fn check_decisions(document: &Document, merge: &Merge) {
    for side in [Side::Mine, Side::Theirs] {
        let (mut decided, mut merge) = (document.clone(), merge.clone());
        for conflict in &mut merge.conflicts {
            conflict.decision = Some(side);
        }
        assert!(matches!(decided.adopt(merge), Adopted::Taken));
        if decided.text() != document.text() {
            decided.undo();
            assert_eq!(decided.text(), document.text());
        }
    }
}

/// Merges two texts made from `base` by replacements of `old` by `new`.
fn merged(
    language: Language,
    base: &str,
    [mine, theirs]: [(&str, &str); 2],
) -> Result<String, Vec<Conflict>> {
    let changed = |(old, new)| {
        assert!(base.contains(old), "{old}");
        base.replacen(old, new, 1)
    };
    let mut document = Document::new(language, base.to_owned());
    let edit = smallest_edit(base, &changed(mine)).expect("it differs");
    document.edit(&[edit]);
    match replace(&mut document, &changed(theirs)) {
        Ok(()) => Ok(document.text().to_owned()),
        Err(merge) => Err(merge.conflicts),
    }
}

const DAT: &str = "\
light ID 1 amb 0 0 0 0 0 0 1 1 1 1 0 0 0 shadow_off
mat ID 1 1 0 0 .1 .5 .4 9 0 0 1

# last material
obj sphere ID 1 mat ID 1 0 0 0 1
obj sphere ID 2 mat ID 1 1 0 0 1
obj sphere ID 3 mat ID 1 2 0 0 1
# last object
render 3 ID 1 ID 2 ID 3
";

#[test]
fn what_both_sides_add_under_one_id_is_renumbered_with_its_references() {
    let mine =
        "mat ID 2 0 1 0 .1 .5 .4 9 0 0 1\n\n# last material\nobj sphere ID 4 mat ID 2 9 0 0 1\n";
    let theirs = "obj sphere ID 4 mat ID 1 7 0 0 1\n# last object\n";
    let added = [("\n# last material\n", mine), ("# last object\n", theirs)];
    let renumbered = mine.replace("sphere ID 4", "sphere ID 5");
    let expected = DAT
        .replace("\n# last material\n", &renumbered)
        .replace("# last object\n", theirs);
    assert_eq!(merged(Language::Dat, DAT, added), Ok(expected));
}

#[test]
fn a_count_is_not_taken_for_another_number() {
    let (_, sphere) = ONE.split_once("1\nsphere").expect("there is one");
    let copied = format!("2\nsphere{sphere}sphere{sphere}");
    let mine = (&ONE[ONE.find("1\nsphere").unwrap_or(0)..], &*copied);
    let other = "sphere 2 2 2 1 0 0 0 1 1 1 0 0 0 1 0 0 1\n";
    let appended = format!("2\nsphere{sphere}{other}");
    let expected = format!("3\nsphere{sphere}sphere{sphere}{other}");
    for sides in [[mine, (mine.0, &appended)], [(mine.0, &appended), mine]] {
        match merged(Language::Ray, ONE, sides) {
            Ok(merged) => {
                let swapped = expected.replace(
                    &format!("sphere{sphere}{other}"),
                    &format!("{other}sphere{sphere}"),
                );
                let all = [expected.clone(), swapped].map(|objects| ONE.replace(mine.0, &objects));
                assert!(all.contains(&merged), "{merged}");
            }
            Err(conflicts) => assert!(conflicts.iter().all(|c| !c.base.contains("0 0 1"))),
        }
    }
}

#[test]
fn counts_of_a_merged_list_agree_with_it() {
    let ids = 1..=12;
    let sphere = |id| format!("obj sphere ID {id} mat ID 1 {id} 0 0 1");
    let spheres: Vec<_> = ids.clone().map(sphere).collect();
    let (material, _) = DAT.split_once("obj").expect("there are objects");
    let without = |gone: &[i32]| {
        let listed = ids.clone().filter(|id| !gone.contains(id));
        let listed: Vec<_> = listed.map(|id| format!("ID {id}")).collect();
        format!("render {} {}\n", listed.len(), listed.join(" "))
    };
    let list = without(&[]);
    let base = format!("{material}{}\n{list}", spheres.join("\n"));
    let (mine, theirs) = (without(&[3]), without(&[9]));
    let merged = merged(Language::Dat, &base, [(&list, &mine), (&list, &theirs)]);
    assert_eq!(merged, Ok(base.replace(&list, &without(&[3, 9]))));
}

const XML: &str = "\
<xml>
  <scene>
    <object type=\"sphere\" name=\"a\" material=\"m\"/>
    <!-- objects end -->
    <material name=\"m\"/>
    <light type=\"ambient\" name=\"l\"/>
    <!-- materials end -->
  </scene>
</xml>
";

#[test]
fn materials_that_both_sides_add_under_one_name_are_given_two() {
    let mine = "    <material name=\"m 2\"/>\n    <material name=\"m\"/>\n";
    let used = mine.replace(
        "    <material",
        "    <object material=\"m 2\" name=\"b\"/>\n    <material",
    );
    let theirs = "    <material name=\"m 2\"><diffuse value=\"0.1\"/></material>\n    <!-- materials end -->\n";
    let added = [
        ("    <material name=\"m\"/>\n", &*used),
        ("    <!-- materials end -->\n", theirs),
    ];
    let expected = XML
        .replace(added[0].0, &used.replace("\"m 2\"", "\"m 3\""))
        .replace(added[1].0, theirs);
    assert_eq!(merged(Language::Xml, XML, added), Ok(expected));
}

#[test]
fn a_change_stays_with_what_the_other_side_swapped_with_its_neighbour() {
    let material = |name: &str, kind: &str, value: &str| {
        let diffuse = format!("<diffuse value=\"{value}\"/>");
        format!("    <material type=\"{kind}\" name=\"{name}\">{diffuse}</material>\n")
    };
    let [a, b] = [("a", ".1"), ("b", ".2")].map(|(name, value)| material(name, "blinn", value));
    let both = format!("{a}{b}");
    let base = XML.replace("    <light", &format!("{both}    <light"));
    let swap = (&*both, &*format!("{b}{a}"));
    let change_a = (&*a, &*material("a", "phong", ".1"));
    let change_b = (&*b, &*material("b", "phong", ".2"));
    let mut asked = 0;
    for (change, expected) in [
        (change_a, format!("{b}{}", change_a.1)),
        (change_b, format!("{}{a}", change_b.1)),
    ] {
        for sides in [[swap, change], [change, swap]] {
            match merged(Language::Xml, &base, sides) {
                Ok(merged) => assert_eq!(merged, base.replace(&both, &expected)),
                Err(conflicts) => asked += conflicts.len(),
            }
        }
    }
    // One of the two is the one that was moved.
    assert_eq!(asked, 2);
}

#[test]
fn sides_that_are_sound_only_alone_are_asked_about() {
    let mat = "mat ID 2 1 0 0 .1 .5 .4 9 0 0 1\n";
    let base = DAT.replace("\n# last material", &format!("{mat}\n# last material"));
    let deleted = (mat, "");
    let used = ("ID 3 mat ID 1", "ID 3 mat ID 2");
    for sides in [[deleted, used], [used, deleted]] {
        let asked =
            merged(Language::Dat, &base, sides).expect_err("one deletes what the other uses");
        assert_eq!(asked.len(), 1);
        assert!(asked[0].base.starts_with(mat), "{}", asked[0].base);
    }
    let asked = merged(
        Language::Xml,
        XML,
        [
            (
                " material=\"m\"/>\n    <!-- objects end -->\n    <material name=\"m\"",
                "/>\n    <!-- objects end -->\n    <material name=\"n\"",
            ),
            (
                "<!-- materials end -->",
                "<object name=\"b\" material=\"m\"/>",
            ),
        ],
    );
    assert!(asked.is_err());
}

#[test]
fn a_thing_that_one_side_moves_and_the_other_deletes_is_asked_about() {
    let sphere = "obj sphere ID 1 mat ID 1 0 0 0 1\n";
    let base = DAT.replace("render 3 ID 1 ID 2 ID 3\n", "");
    let (rest, _) = base.split_once("# last object").expect("it is there");
    let (_, rest) = rest.split_once(sphere).expect("it is there");
    let moved = format!("{rest}{sphere}");
    let all = format!("{sphere}{rest}");
    for sides in [
        [(&*all, &*moved), (sphere, "")],
        [(sphere, ""), (&*all, &*moved)],
    ] {
        assert!(merged(Language::Dat, &base, sides).is_err());
    }
}
