use proptest::prelude::*;

use super::*;

mod far;

fn merge(base: &str, mine: &str, theirs: &str) -> Merge {
    let [base, mine, theirs] = [base, mine, theirs].map(|text| Arc::new(text.to_owned()));
    Merge::new(Language::Ray, &base, &mine, &theirs)
}

/// The merged text with each conflict written out as `{base|mine|theirs}`.
fn marked(merge: &Merge) -> String {
    let mut marked = merge.clone();
    for conflict in &mut marked.conflicts {
        assert_eq!(conflict.span.of(&merge.mine), conflict.mine);
        conflict.theirs = format!(
            "{{{}|{}|{}}}",
            conflict.base, conflict.mine, conflict.theirs
        );
        conflict.decision = Some(Side::Theirs);
    }
    marked.text()
}

#[track_caller]
fn check(cases: &[(&str, &str, &str, &str)]) {
    for (base, mine, theirs, expected) in cases {
        assert_eq!(
            marked(&merge(base, mine, theirs)),
            *expected,
            "{base:?}, mine {mine:?}, theirs {theirs:?}"
        );
    }
}

#[test]
fn values_merge_leaf_by_leaf() {
    check(&[
        ("1 2 3", "9 2 3", "1 2 8", "9 2 8"),
        ("1 2 3", "9 2 3", "1 8 3", "9 8 3"),
        ("1 2", "3 4", "1 5", "3 {2|4|5}"),
        ("1 2", "3 4", "3 5", "3 {2|4|5}"),
        ("1 2", "3 2", "3 2", "3 2"),
        ("1 // one", "2 // one", "1 // uno", "2 // uno"),
        (
            "1 // one",
            "1 // eins",
            "1 // uno",
            "1 {// one|// eins|// uno}",
        ),
        // Three new values, not a deletion and an insertion.
        ("0 1 2 // v", "0 1 9 // v", "1 2 3 // v", "1 2 {2|9|3} // v"),
        ("0\n1\n2", "0\n1\n9", "1\n2\n3", "1\n2\n{2|9|3}"),
    ]);
}

#[test]
fn render_settings_in_one_comment_are_merged_one_by_one() {
    check(&[
        (
            "// render: spp 4 depth 8\n1",
            "// render: spp 16 depth 8\n1",
            "// render: spp 4 depth 2\n1",
            "// render: spp 16 depth 2\n1",
        ),
        (
            "// render: spp 4 depth 8",
            "// render: spp 16 depth 8",
            "// render: spp 9 depth 8",
            "// render: {spp 4|spp 16|spp 9} depth 8",
        ),
        // Any other comment is one thing.
        (
            "// renders: spp 4 depth 8",
            "// renders: spp 16 depth 8",
            "// renders: spp 4 depth 2",
            "{// renders: spp 4 depth 8|// renders: spp 16 depth 8|// renders: spp 4 depth 2}",
        ),
    ]);
}

#[test]
fn conflicts_in_one_field_are_one() {
    let join = |base: &str, mine: &str, theirs: &str, field: std::ops::Range<usize>| {
        let mut merge = merge(base, mine, theirs);
        let field = Span::new(field.start, field.end);
        merge.join(|span| {
            (field.start() <= span.start() && span.end() <= field.end()).then_some(field)
        });
        marked(&merge)
    };
    for (base, mine, theirs, field, expected) in [
        (
            "1 2 3 4",
            "5 6 7 8",
            "9 8 6 0",
            0..5,
            "{1 2 3|5 6 7|9 8 6} {4|8|0}",
        ),
        // What only one side changed between them belongs to it.
        (
            "1 2 3 4",
            "5 2 7 4",
            "9 8 6 4",
            0..5,
            "{1 2 3|5 2 7|9 8 6} 4",
        ),
        ("1 2 3 4", "5 2 3 8", "9 2 3 0", 0..5, "{1|5|9} 2 3 {4|8|0}"),
    ] {
        assert_eq!(join(base, mine, theirs, field), expected, "{mine} {theirs}");
    }
}

#[test]
fn white_space_merges_with_values() {
    check(&[
        ("1 2 3", "1 5 3", "1\t2  3\n", "1\t5  3\n"),
        ("1\r\n2\r\n", "7\r\n2\r\n", "1\n2\n", "7\n2\n"),
        (
            "\u{FEFF}1\u{A0}2",
            "\u{FEFF}1\u{A0}3",
            "1\u{A0}2",
            "1\u{A0}3",
        ),
        ("1 2", "1\n2", "1\t2", "1{ |\n|\t}2"),
        ("", "\n", " ", "{|\n| }"),
    ]);
}

#[test]
fn objects_can_be_added_and_removed_beside_edits() {
    let base = "2 // objects\nsphere 0 0 1 5\nbox 4 0 1 5\n";
    check(&[
        // An object appended, with its count; one value edited.
        (
            base,
            "2 // objects\nsphere 0 0 1 7\nbox 4 0 1 5\n",
            "3 // objects\nsphere 0 0 1 5\nbox 4 0 1 5\ncone 6 6 1 5\n",
            "3 // objects\nsphere 0 0 1 7\nbox 4 0 1 5\ncone 6 6 1 5\n",
        ),
        // The same, with the edited value directly before the appended object.
        (
            base,
            "2 // objects\nsphere 0 0 1 5\nbox 4 0 1 6\n",
            "3 // objects\nsphere 0 0 1 5\nbox 4 0 1 5\nbox 4 9 1 5\n",
            "3 // objects\nsphere 0 0 1 5\nbox 4 0 1 6\nbox 4 9 1 5\n",
        ),
        ("1 2", "1 5", "1 2\n3", "1 5\n3"),
        ("1 2\n", "5 2\n", "0\n1 2\n", "0\n5 2\n"),
        // The first object removed, the second edited.
        (
            base,
            "2 // objects\nsphere 0 0 1 5\nbox 4 0 1 6\n",
            "1 // objects\nbox 4 0 1 5\n",
            "1 // objects\nbox 4 0 1 6\n",
        ),
        // One removed and edited by the other side.
        (
            "a 1 2\nb 3 4\nc 5 6\n",
            "a 1 2\nb 3 7\nc 5 6\n",
            "a 1 2\nc 5 6\n",
            "a 1 2{\nb 3 4\n|\nb 3 7\n|\n}c 5 6\n",
        ),
        // Both append.
        ("1\n", "1\n2\n", "1\n3\n", "1\n{|2\n|3\n}"),
        ("1\n", "1\n2\n", "1\n2\n", "1\n2\n"),
        ("", "1", "2", "{|1|2}"),
    ]);
}

#[test]
fn an_ambiguous_insertion_covers_all_its_possible_places() {
    check(&[
        // Which of the zeros is new?
        ("7 0 0 8", "7 0 5 8", "7 0 0 0 8", "7{ 0 0 | 0 5 | 0 0 0 }8"),
        ("7 0 0 8", "7 0 5 8", "7 0 8", "7{ 0 0 | 0 5 | 0 }8"),
        ("7 0 0 8", "7 0 0 9", "7 0 0 0 8", "7 0 0 0 9"),
        ("7 0 0", "7 0 5", "7 0 0 0", "7 0 5 0"),
    ]);
}

#[test]
fn the_places_of_an_ambiguous_insertion_end_at_the_change_before_it() {
    check(&[(
        "0 1\n0 0 0\n1 1",
        "0 1\n0 0 5\n1 1",
        "0 0 0 0 0\n1 1",
        "0 {0 0 0|0 0 5|0 0 0 0}\n1 1",
    )]);
}

#[test]
fn of_equal_leaves_at_the_end_the_last_is_removed_whatever_was_inserted_before() {
    check(&[
        (
            "1 1 0 0 1 1 1 1",
            "1 1 0 0 1 1 5 1",
            "0 1 1 0 0 1 1 1",
            "0 1 1 0 0 1 1 5",
        ),
        (
            "1 1 1 1 1 0 0",
            "1 1 1 1 5 0 0",
            "1 1 0 1 1 1 0",
            "1 1 0 1 1 5 0",
        ),
    ]);
}

#[test]
fn leaves_never_run_together() {
    check(&[
        // Mine removes the line break, theirs opens a comment before it.
        ("1\n2", "1 2", "// x\n2", "{1\n|1 |// x\n}2"),
        // Mine replaces a comment by a number, theirs removes the space before it.
        ("1 // c", "1 5", "1// c", "1{ // c| 5|// c}"),
    ]);
}

#[test]
fn undecided_conflicts_keep_mine() {
    let mut merge = merge("1 2 3", "4 5 6", "7 2 9");
    assert_eq!(merge.text(), "4 5 6");
    merge.conflicts[1].decision = Some(Side::Theirs);
    assert_eq!(merge.text(), "4 5 9");
    merge.conflicts[0].decision = Some(Side::Mine);
    assert_eq!(merge.text(), "4 5 9");
    merge.conflicts[0].decision = Some(Side::Theirs);
    assert_eq!(merge.text(), "7 5 9");
}

#[test]
fn decisions_survive_further_edits() {
    let mut first = merge("1 2 3", "4 5 6", "7 8 9");
    for conflict in &mut first.conflicts {
        conflict.decision = Some(Side::Theirs);
    }
    let second = first.onto(Language::Ray, &Arc::new("4 0 6".to_owned()));
    let decisions: Vec<_> = second.conflicts.iter().map(|c| c.decision).collect();
    assert_eq!(decisions, [Some(Side::Theirs), None, Some(Side::Theirs)]);
}

#[test]
fn long_texts_without_a_common_leaf_merge() {
    let numbers = |from: usize| lines((from..from + 60_000).map(|n| n.to_string()));
    let (base, theirs) = (numbers(0), numbers(1_000_000));
    let mine = base.replacen("\n500\n", "\nx\n", 1);
    let conflicts = merge(&base, &mine, &theirs).conflicts;
    let values: Vec<_> = conflicts
        .iter()
        .map(|c| (&*c.base, &*c.mine, &*c.theirs))
        .collect();
    assert_eq!(values, [("500", "x", "1000500")]);
}

/// Only the lines around the changes are split into leaves, or more of them if those are too few.
#[test]
fn distant_changes_merge_as_in_a_short_text() {
    let rows = |first: &str, last: &str| {
        let between = (0..2000).map(|at| format!("{at} 0"));
        let first = std::iter::once(first.to_owned());
        lines(first.chain(between).chain([last.to_owned()]))
    };
    let base = rows("1 2", "3 4");
    for (mine, theirs, merged) in [
        // One change at each end.
        (["1 9", "3 4"], ["1 2", "8 4"], ["1 9", "8 4"]),
        (["1 2", "8 4"], ["1 9", "3 4"], ["1 9", "8 4"]),
        // Both sides at both ends.
        (["1 9", "8 4"], ["5 2", "3 6"], ["5 9", "8 6"]),
        (["1 2", "3 8"], ["1 9", "3 7"], ["1 9", "3 {4|8|7}"]),
    ] {
        let [mine, theirs, merged] = [mine, theirs, merged].map(|[first, last]| rows(first, last));
        assert_eq!(marked(&merge(&base, &mine, &theirs)), merged);
    }
    // Which of many equal lines is new? The conflict covers all of them.
    let equal = |count: usize, last: &str| format!("7\n{}{last}\n", "0\n".repeat(count));
    let merge = merge(&equal(5000, "8"), &equal(5001, "8"), &equal(4999, "8"));
    let [conflict] = &merge.conflicts[..] else {
        panic!("{} conflicts", merge.conflicts.len());
    };
    let whole = |count: usize| format!("\n{}", "0\n".repeat(count));
    assert_eq!(conflict.base, whole(5000));
    assert_eq!(conflict.mine, whole(5001));
    assert_eq!(conflict.theirs, whole(4999));
}

/// A line for each word.
fn lines(words: impl Iterator<Item = String>) -> String {
    words.flat_map(|word| [word, "\n".to_owned()]).collect()
}

/// Short texts of few different leaves, the hardest to align.
fn scene() -> impl Strategy<Value = String> {
    proptest::string::string_regex("((0|1|2|ab|// c\n)( |\n|\r\n|\t)){0,9}(7|// z)?")
        .expect("the pattern is regular")
}

/// Rows of few different words, so that the position of an insertion is often ambiguous.
fn rows(most: usize) -> impl Strategy<Value = Vec<&'static str>> {
    prop::collection::vec(
        prop::sample::select(vec!["0 0", "0", "1 0", "sphere", ""]),
        0..most,
    )
}

/// The lines around the changes give the same as all lines, or `None` where they do not suffice.
#[track_caller]
fn check_windows(language: Language, texts: [&str; 3], margin: usize) {
    let [base, mine, theirs] = texts;
    let changes = [mine, theirs].map(|other| changes(base, other, LIMITS));
    let whole = resolve(language, texts, &changes, usize::MAX);
    assert!(whole.is_some());
    let part = resolve(language, texts, &changes, margin);
    assert!(
        part.is_none() || part == whole,
        "{part:?}, not {whole:?}, of {texts:?}"
    );
}

#[test]
fn a_window_of_few_lines_is_wide_enough_or_not_used() {
    let base = "0 0\r\n0 0\r\n0 0\r\nsphere\r\nsphere\r\nsphere";
    let theirs = "0 0\r\n0 0\r\n0\r\nsphere\r\nsphere\r\nsphere\r\nsphere";
    check_windows(Language::Ray, [base, base, theirs], 2);
}

proptest! {
    #![proptest_config(repeatable::config())]

    // Merging the lines around the changes, if they suffice, gives the same as merging all lines.
    #[test]
    fn windows_merge_like_the_whole_text(
        language in prop::sample::select(vec![Language::Ray, Language::Dat]),
        end in prop::sample::select(vec!["\n", "\r\n"]),
        mark in prop::sample::select(vec!["", "\u{FEFF}"]),
        [head, middle, tail] in [rows(9), rows(30), rows(9)],
        (first, second) in ([rows(3), rows(3), rows(3)], [rows(3), rows(3)]),
        margin in 0_usize..16,
    ) {
        let text = |first: &[&str], second: &[&str]| {
            format!("{mark}{}", [&head[..], first, &middle, second, &tail].concat().join(end))
        };
        // Mine changes the first place, theirs both.
        let base = text(&first[0], &second[0]);
        let mine = text(&first[1], &second[0]);
        let theirs = text(&first[2], &second[1]);
        let texts = [&base[..], &mine, &theirs];
        let changes = [&mine, &theirs].map(|other| changes(&base, other, LIMITS));
        let whole = resolve(language, texts, &changes, usize::MAX);
        prop_assert!(whole.is_some());
        let part = resolve(language, texts, &changes, margin);
        prop_assert!(part.is_none() || part == whole, "{part:?}, not {whole:?}, of {texts:?}");
    }

    #[test]
    fn one_sided_changes_are_taken(base in scene(), changed in scene()) {
        prop_assert_eq!(marked(&merge(&base, &base, &changed)), changed.clone());
        prop_assert_eq!(marked(&merge(&base, &changed, &base)), changed.clone());
        prop_assert_eq!(marked(&merge(&base, &changed, &changed)), changed);
    }

    #[test]
    fn the_sides_are_equal(base in scene(), mine in scene(), theirs in scene()) {
        let (forth, back) = (merge(&base, &mine, &theirs), merge(&base, &theirs, &mine));
        prop_assert_eq!(forth.conflicts.len(), back.conflicts.len());
        let decided = |mut merge: Merge, side| {
            merge.conflicts.iter_mut().for_each(|conflict| conflict.decision = Some(side));
            merge.text()
        };
        prop_assert_eq!(decided(forth.clone(), Side::Mine), decided(back.clone(), Side::Theirs));
        prop_assert_eq!(decided(forth, Side::Theirs), decided(back, Side::Mine));
    }

    #[test]
    fn changes_of_different_leaves_always_merge(
        leaves in prop::collection::vec((0..3, 0..4), 1..40),
    ) {
        // Each leaf changes on at most one side, to a unique value.
        let text = |change: &dyn Fn(usize, i32, i32) -> i32| {
            let spelled = leaves.iter().enumerate();
            lines(spelled.map(|(at, &(value, owner))| change(at, value, owner).to_string()))
        };
        let new = |at: usize| 100 + at as i32;
        let base = text(&|_, value, _| value);
        let mine = text(&|at, value, owner| if owner == 1 { new(at) } else { value });
        let theirs = text(&|at, value, owner| if owner == 2 { new(at) } else { value });
        let both = text(&|at, value, owner| if owner == 1 || owner == 2 { new(at) } else { value });
        prop_assert_eq!(marked(&merge(&base, &mine, &theirs)), both);
    }
}
