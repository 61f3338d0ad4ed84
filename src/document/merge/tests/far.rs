//! Merges of changes far apart, where what lies between them is not compared.

use std::ops::Range;

use proptest::prelude::*;

use super::super::*;
use super::{marked, merge};

/// A scene of many different spheres, their rows changed by `change`.
fn spheres(change: impl Fn(&mut Vec<String>)) -> String {
    let row = |number: usize| {
        format!("sphere\n{number} 0 1 .5\n.8 .5 .{number}\n.2 .2 .2\n0 0 0\n20 0 0 1\n")
    };
    let mut rows: Vec<_> = (0..800).map(row).collect();
    change(&mut rows);
    rows.concat()
}

fn grow(rows: &mut [String], number: usize) {
    rows[number] = rows[number].replace(" .5\n.8", " .75\n.8");
}

#[test]
fn changes_far_apart_merge_as_if_they_were_near() {
    let base = spheres(|_| {});
    let mine = spheres(|rows| {
        grow(rows, 1);
        grow(rows, 400);
    });
    let theirs = spheres(|rows| {
        grow(rows, 0);
        rows[400] = rows[400].replace("20 0 0 1", "20 1 0 1");
        rows.remove(600);
        grow(rows, 798);
    });
    let both = spheres(|rows| {
        grow(rows, 0);
        grow(rows, 1);
        grow(rows, 400);
        rows[400] = rows[400].replace("20 0 0 1", "20 1 0 1");
        rows.remove(600);
        grow(rows, 798);
    });
    assert_eq!(marked(&merge(&base, &mine, &theirs)), both);
    let changes = [&mine, &theirs].map(|other| changes(&base, other, LIMITS));
    assert_eq!([2, 4], [changes[0].len(), changes[1].len()]);
    let near = resolve(Language::Ray, [&base, &mine, &theirs], &changes, 1024);
    assert!(near.is_some());
}

#[test]
fn what_was_moved_far_away_and_edited_is_asked_about() {
    let base = spheres(|_| {});
    let edited = spheres(|rows| grow(rows, 0));
    let moved = spheres(|rows| {
        let first = rows.remove(0);
        rows.push(first);
    });
    for [mine, theirs] in [[&edited, &moved], [&moved, &edited]] {
        assert_eq!(merge(&base, mine, theirs).conflicts.len(), 1);
    }
    // Half of a move is no change that both made alike: all is left to one decision.
    let removed = spheres(|rows| {
        rows.remove(0);
        grow(rows, 400);
    });
    for [mine, theirs] in [[&removed, &moved], [&moved, &removed]] {
        let merge = merge(&base, mine, theirs);
        let [conflict] = &merge.conflicts[..] else {
            panic!("{} conflicts", merge.conflicts.len());
        };
        assert!(conflict.mine.contains("\n401 0 1 .75") == (mine == &removed));
    }
}

/// Of the shortest edit scripts, the one chosen at a place must not depend on changes far away.
#[test]
fn a_change_is_aligned_as_if_it_were_the_only_one() {
    let base = spheres(|_| {});
    let mine = spheres(|rows| rows[398] = rows[398].replace(".398", ".3"));
    let near = |rows: &mut Vec<String>| {
        grow(rows, 398);
        rows.insert(399, rows[399].clone());
    };
    let alone = spheres(near);
    let theirs = spheres(|rows| {
        near(rows);
        rows.remove(0);
    });
    for (theirs, margin) in [(&alone, 1024), (&theirs, 1024), (&theirs, usize::MAX)] {
        let texts = [&base[..], &mine, theirs];
        let changes = [&mine, theirs].map(|other| changes(&base, other, LIMITS));
        let (_, conflicts) = resolve(Language::Ray, texts, &changes, margin).expect("it is wide");
        let sides = conflicts.iter().map(|c| [&c.base[..], &c.mine, &c.theirs]);
        assert_eq!(sides.collect::<Vec<_>>(), [[".398", ".3", ".399"]]);
    }
}

/// What both sides changed alike is compared with the changes far away, and nothing between them.
#[test]
fn equal_changes_far_apart_merge_without_a_question() {
    let counted = |count: usize, change: &dyn Fn(&mut Vec<String>)| {
        format!("0 0 0\n{count}\n{}", spheres(change))
    };
    let base = counted(800, &|_| {});
    let both = |rows: &mut Vec<String>| rows[400] = rows[400].replace(".400", ".4");
    let added = "sphere\n9 8 7 6\n5 4 3\n2 1 0\n9 8 7\n6 5 4 3\n".to_owned();
    let mine = counted(801, &|rows| {
        both(rows);
        grow(rows, 1);
        rows.push(added.clone());
    });
    let theirs = counted(801, &|rows| {
        both(rows);
        rows.insert(798, added.replace('9', "7"));
    });
    let merged = counted(801, &|rows| {
        both(rows);
        grow(rows, 1);
        rows.insert(798, added.replace('9', "7"));
        rows.push(added.clone());
    });
    let texts = [&base[..], &mine, &theirs];
    let changes = [&mine, &theirs].map(|other| changes(&base, other, LIMITS));
    assert!(resolve(Language::Ray, texts, &changes, 1024).is_some());
    assert_eq!(marked(&merge(&base, &mine, &theirs)), merged);
}

/// Changes of rows near the start, in the middle and near the end of [`spheres`].
fn row_edits(number: Range<usize>) -> impl Strategy<Value = Vec<(usize, u8)>> {
    let row = prop_oneof![0..4_usize, 398..402_usize, 794..798_usize];
    prop::collection::vec((row, 0..5_u8), number)
}

fn change_row(rows: &mut Vec<String>, (number, what): (usize, u8)) {
    let number = number.min(rows.len() - 1);
    match what {
        0 => grow(rows, number),
        1 => rows[number] = rows[number].replace("20 0", "20 1"),
        2 => drop(rows.remove(number)),
        3 => rows.insert(number, rows[number].clone()),
        _ => {
            let row = rows.remove(number);
            rows.insert((number + 297) % rows.len(), row);
        }
    }
}

proptest! {
    #![proptest_config(proptest::test_runner::Config { cases: 64, ..repeatable::config() })]

    // Changes of far rows, by one side or both, with the lines between them or without.
    #[test]
    fn windows_far_apart_merge_like_the_whole_text(
        both in row_edits(0..2), [mine, theirs] in [row_edits(0..4), row_edits(0..4)],
    ) {
        let text = |edits: &[&[(usize, u8)]]| {
            spheres(|rows| edits.concat().into_iter().for_each(|edit| change_row(rows, edit)))
        };
        let (base, mine) = (text(&[]), text(&[&both, &mine]));
        let theirs = text(&[&both, &theirs]);
        let texts = [&base[..], &mine, &theirs];
        let changes = [&mine, &theirs].map(|other| changes(&base, other, LIMITS));
        let whole = resolve(Language::Ray, texts, &changes, usize::MAX);
        prop_assert!(whole.is_some());
        let part = resolve(Language::Ray, texts, &changes, 1024);
        prop_assert!(part.is_none() || part == whole, "{part:?}, not {whole:?}");
    }
}
