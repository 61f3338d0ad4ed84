//! How a text is split into records, and their tokens into slots.

use proptest::prelude::*;

use crate::dat::Dat;
use crate::dat::schema::SCHEMA;
use crate::engine::lines::{self, Lines};
use crate::written::Parse;
use text::Span;

fn records(text: &str) -> Vec<Vec<&str>> {
    let tree = Lines::<Dat>::parse(text);
    let words = |at| {
        let tokens = tree.tokens(text, at);
        tokens.map(|span| span.of(text)).collect()
    };
    (0..tree.records.len()).map(words).collect()
}

fn leaves(text: &str) -> Vec<Span> {
    lines::leaves::<Dat>(text)
}

#[test]
fn records_have_the_number_of_tokens_that_the_format_defines() {
    for (name, line) in [
        ("camera", "camera perspective 0 0 0  0 0 1  0 1 0  1 0 9"),
        ("resolution", "resolution 1 1"),
        ("viewport", "viewport 4 3"),
        (
            "light",
            "light ID 0 pnt 0 0 8  0 0 -1  1 1 1  1 0 0  10 shadow_on",
        ),
        ("mat", "mat ID 0  1 1 1  0.1 0.8 0.1 5  0 0 0"),
        ("sphere", "obj sphere ID 0 mat ID 1  0 0 2  1"),
        ("ellipsoid", "obj ellipsoid ID 0 mat ID 1  0 0 2  1 1 1"),
        ("cylinder", "obj cylinder ID 0 mat ID 1  0 0 2  0 0 1  1 2"),
        (
            "box",
            "obj box ID 0 mat ID 1  0 0 2  1 0 0  0 1 0  0 0 1  1 2 3",
        ),
        ("CSG", "obj CSG ID 6 difference ID 5 ID 2"),
        ("quadric", "obj quadric ID 0 mat ID 1  1 0 0 0 1 0 0 1 0 -1"),
        ("checker", "texture ID 0 checker 4 4  1 1 1  0 0 0"),
        ("image", "texture ID 0 image 1 1 wood.png"),
        ("use colour", "use colour ID 0 mat ID 1"),
        ("use bump", "use bump ID 0 mat ID 1 0.1"),
        ("render", "render"),
    ] {
        let record = SCHEMA.records.iter().find(|record| record.name == name);
        let record = record.expect("the table has it");
        let tokens = record.heads.len() + record.tokens();
        assert_eq!(tokens, line.split_whitespace().count(), "{line}");
    }
}

#[test]
fn a_record_is_a_line() {
    let cases: [(&str, &[&[&str]]); 6] = [
        ("a 1\tb\n\n  c", &[&["a", "1", "b"], &["c"]]),
        ("a\r\r\nb 1\r\r\n", &[&["a"], &["b", "1"]]),
        ("\u{FEFF}a\u{A0}b", &[&["a", "b"]]),
        ("# a\n  // b\na # b\n", &[&["a", "#", "b"]]),
        ("a\rb 1\r\rc", &[&["a"], &["b", "1"], &["c"]]),
        (" \n\t\n", &[]),
    ];
    for (text, expected) in cases {
        assert_eq!(records(text), expected, "{text:?}");
    }
}

#[test]
fn comments_end_before_white_space() {
    let text = " # one \r\r\na\r//two\rb";
    let said: Vec<_> = leaves(text).iter().map(|span| span.of(text)).collect();
    assert_eq!(said, ["# one", "a", "//two", "b"]);
}

#[test]
fn records_are_found_by_position() {
    let text = "ab 1\n\n# c\n  d 2\ne";
    let tree = Lines::<Dat>::parse(text);
    let at = |start, end| tree.at(Span::new(start, end));
    assert_eq!(at(0, 0), 0..1);
    assert_eq!(at(4, 4), 0..1);
    assert_eq!(at(5, 6), 1..1);
    assert_eq!(at(3, 13), 0..2);
    assert_eq!(at(15, 17), 1..3);
    assert_eq!(tree.span(1).of(text), "d 2");
    assert_eq!(tree.span(7), Span::at(0));
}

proptest! {
    #![proptest_config(repeatable::config())]

    #[test]
    fn every_character_is_in_a_token_a_comment_or_white_space(text in "[ab/#\n\r \t\u{A0}\u{FEFF}é]{0,40}") {
        let mut covered = vec![false; text.len()];
        for span in leaves(&text) {
            prop_assert!(!span.is_empty());
            for at in span.range() {
                prop_assert!(!covered[at], "two leaves share a byte");
                covered[at] = true;
            }
        }
        let rest: String = text.char_indices().filter(|&(at, _)| !covered[at]).map(|(_, c)| c).collect();
        let blank = |c: char| c.is_ascii_whitespace() || "\u{A0}\u{FEFF}".contains(c);
        prop_assert!(rest.chars().all(blank));
    }
}
