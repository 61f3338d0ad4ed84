//! The rows of keys against each other.

use super::*;
use crate::ui::keymap::{Keys, Section, ctrl, refusal};

/// The keys of a row.
fn keys_of(row: &Row) -> Vec<Keys> {
    row.key.keys()
}

#[test]
fn no_key_has_two_meanings_in_one_context() {
    for section in Section::all() {
        // A key of the context itself takes precedence over one that acts anywhere.
        for is_common in [false, true] {
            let here = rows().filter(|row| row.key.is_in(section));
            let here = here.filter(|row| row.key.is_common() == is_common);
            let mut bound: Vec<_> = here.flat_map(keys_of).collect();
            while let Some(keys) = bound.pop() {
                let is_free = bound.iter().all(|other| !other.collides(keys));
                assert!(is_free, "{section:?} {keys:?}");
            }
        }
    }
}

#[test]
fn keys_that_share_their_bytes_with_others_are_not_bound() {
    for row in rows() {
        for shared in ['h', 'i', 'm', '['].map(ctrl) {
            assert!(!row.key.chords().contains(&shared), "{:?}", row.key);
        }
    }
}

#[test]
fn every_row_is_explained_and_rows_of_one_name_are_apart() {
    for (at, row) in rows().enumerate() {
        let is_kebab = |c: char| c.is_ascii_lowercase() || c == '-';
        assert!(row.key.name.chars().all(is_kebab), "{:?}", row.key);
        assert!(!row.key.words.is_empty(), "{:?}", row.key);
        let twins = rows().take(at).filter(|twin| twin.key.name == row.key.name);
        let here = |section: &Section| row.key.is_in(*section);
        for twin in twins {
            let shared = Section::all()
                .filter(here)
                .find(|section| twin.key.is_in(*section));
            // Other keys of what the row does: `gg`, `Home`.
            let is_same = twin.key.words == row.key.words;
            assert!(shared.is_none() || is_same, "{:?} {shared:?}", row.key);
        }
    }
}

#[test]
fn no_row_is_refused() {
    for row in rows() {
        for section in Section::all().filter(|section| row.key.is_in(*section)) {
            for keys in keys_of(row) {
                assert_eq!(refusal(section, keys, Some(row.key.name)), None);
            }
        }
    }
    for section in Section::all() {
        assert_eq!(Keymap::default().unreachable_in(section), None);
    }
}
