//! The rows of keys against each other.

use super::*;
use crate::keymap::{Section, refusal};

#[test]
fn no_key_has_two_meanings_in_one_context() {
    for section in Section::all() {
        // A key of the context itself takes precedence over one that acts anywhere.
        for is_common in [false, true] {
            let here = all_keys().filter(|key| key.is_in(section));
            let here = here.filter(|key| key.is_common() == is_common);
            let mut bound: Vec<_> = here.flat_map(|key| key.keys()).collect();
            while let Some(keys) = bound.pop() {
                let is_free = bound.iter().all(|other| !other.collides(keys));
                assert!(is_free, "{section:?} {keys:?}");
            }
        }
    }
}

#[test]
fn keys_that_share_their_bytes_with_others_are_not_bound() {
    for key in all_keys() {
        for keys in key.keys() {
            let spelling = keys.spelling();
            let mut names = spelling.split(' ');
            let is_shared = |name| ["Ctrl-H", "Ctrl-I", "Ctrl-M", "Ctrl-["].contains(&name);
            assert!(!names.any(is_shared), "{key:?}");
        }
    }
}

#[test]
fn every_row_is_explained_and_rows_of_one_name_are_apart() {
    for (at, key) in all_keys().enumerate() {
        let is_kebab = |c: char| c.is_ascii_lowercase() || c == '-';
        assert!(key.name.chars().all(is_kebab), "{key:?}");
        assert!(!key.words.is_empty(), "{key:?}");
        let twins = all_keys().take(at).filter(|twin| twin.name == key.name);
        let here = |section: &Section| key.is_in(*section);
        for twin in twins {
            let shared = Section::all()
                .filter(here)
                .find(|section| twin.is_in(*section));
            // Other keys of what the row does: `gg`, `Home`.
            let is_same = twin.words == key.words;
            assert!(shared.is_none() || is_same, "{key:?} {shared:?}");
        }
    }
}

#[test]
fn no_row_is_refused() {
    for key in all_keys() {
        for section in Section::all().filter(|section| key.is_in(*section)) {
            for keys in key.keys() {
                assert_eq!(refusal(section, keys, Some(key.name)), None);
            }
        }
    }
    for section in Section::all() {
        assert_eq!(Keymap::default().unreachable_in(section), None);
    }
}
