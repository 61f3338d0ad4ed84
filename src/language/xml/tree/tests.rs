use proptest::prelude::*;

use super::*;
use text::{Edit, Position, apply};

const EXAMPLE: &str = include_str!("../../../../scenes/spheres.xml");

fn names<'t>(text: &'t str, tree: &Tree) -> Vec<&'t str> {
    tree.elements
        .iter()
        .map(|element| element.name.of(text))
        .collect()
}

/// Checks that leaves are not empty and cover the text, except white space between them.
fn check_leaves(text: &str) {
    let mut at = 0;
    for leaf in Tree::parse(text).leaves(text) {
        assert!(!leaf.is_empty() && at <= leaf.start(), "{text:?}");
        assert!(is_blank(&text[at..leaf.start()]), "{text:?}");
        at = leaf.end();
    }
    assert!(is_blank(&text[at..]), "{text:?}");
}

fn is_blank(text: &str) -> bool {
    text.chars()
        .all(|c| c.is_ascii_whitespace() || "\x0B\u{A0}\u{FEFF}".contains(c))
}

/// Checks that spans are correct and that elements nest.
fn check_tree(text: &str) {
    let tree = Tree::parse(text);
    assert!(tree.fault.is_none() || tree.elements.is_empty(), "{text:?}");
    for (index, element) in tree.elements.iter().enumerate() {
        let name = element.name.of(text);
        assert!(
            element.tag.of(text).starts_with(&format!("<{name}")),
            "{text:?}"
        );
        assert!(element.tag.of(text).ends_with('>'), "{text:?}");
        let last = if element.is_empty_tag() { "/>" } else { ">" };
        assert!(element.whole.of(text).ends_with(last), "{text:?}");
        let after = &text[element.attributes_end as usize..element.tag.end()];
        assert!(
            matches!(after.trim_start(), ">" | "/>"),
            "{text:?}: {after:?}"
        );
        if !element.is_empty_tag() {
            let close = &text[element.close as usize..element.whole.end()];
            assert!(close.starts_with(&format!("</{name}")), "{text:?}");
        }
        assert!(is_blank(element.lead.of(text)), "{text:?}");
        assert!(index < element.end as usize && element.end as usize <= tree.elements.len());
        for child in tree.children(index) {
            let inner = &tree.elements[child];
            assert_eq!(
                (inner.parent, inner.depth),
                (Some(index as u32), element.depth + 1)
            );
            assert!(element.tag.end() <= inner.tag.start(), "{text:?}");
            assert!(inner.whole.end() <= element.close as usize, "{text:?}");
        }
        for attribute in &tree.attributes[element.attributes()] {
            let (start, end) = (attribute.value.start(), attribute.value.end());
            let quotes = [&text[start - 1..start], &text[end..=end]];
            assert!(matches!(quotes, ["\"", "\""] | ["'", "'"]), "{text:?}");
        }
    }
}

#[test]
fn elements_are_in_document_order() {
    let tree = Tree::parse(EXAMPLE);
    assert_eq!(tree.fault, None);
    let names = names(EXAMPLE, &tree);
    assert_eq!(names[..5], ["xml", "scene", "object", "scale", "translate"]);
    let spheres = names
        .iter()
        .zip(&tree.elements)
        .filter(|(name, _)| **name == "object");
    let depths: Vec<_> = spheres.map(|(_, element)| element.depth).collect();
    assert_eq!(depths, [2, 2, 3]);
    let children: Vec<_> = tree.children(0).map(|at| names[at]).collect();
    assert_eq!(children, ["scene", "camera"]);
    let named = tree
        .attribute(EXAMPLE, 2, "name")
        .expect("the first object has a name");
    assert_eq!(named.unescaped(EXAMPLE), "sphere1");
    assert_eq!(tree.elements[2].lead.of(EXAMPLE), "\n    ");
    check_tree(EXAMPLE);
    check_leaves(EXAMPLE);
}

#[test]
fn references_in_values_are_resolved() {
    let text = "\u{FEFF}<?xml version=\"1.0\"?>\r\n<A b = '&lt;&#65;&quot;' c=\"é\nf\" d=''\t/>\r\n<!-- e -->";
    let tree = Tree::parse(text);
    let said: Vec<_> = tree
        .attributes
        .iter()
        .map(|a| (a.name.of(text), a.unescaped(text)))
        .collect();
    assert_eq!(said, [("b", "<A\""), ("c", "é f"), ("d", "")]);
    assert_eq!(tree.comments[0].of(text), "<!-- e -->");
    let leaves: Vec<_> = tree.leaves(text).iter().map(|leaf| leaf.of(text)).collect();
    let expected = [
        "<?xml",
        "version=\"1.0\"?>",
        "<A",
        "b",
        "=",
        "'",
        "&lt;&#65;&quot;",
        "'",
        "c=\"",
        "é\nf",
        "\"",
        "d=''",
        "/>",
        "<!-- e -->",
    ];
    assert_eq!(leaves, expected);
    check_tree(text);
}

#[test]
fn text_between_tags_is_kept_separately() {
    let text = "<a> 40\n<b>x</b></a>";
    let tree = Tree::parse(text);
    let words: Vec<_> = tree
        .words
        .iter()
        .map(|(span, at)| (span.of(text), *at))
        .collect();
    assert_eq!(words, [("40", 0), ("x", 1)]);
}

#[test]
fn elements_are_found_by_position() {
    let text = "<a><b/> <c><d/></c></a>";
    let tree = Tree::parse(text);
    for (part, expected) in [
        ("b", 1),
        (" ", 0),
        ("c>", 2),
        ("d", 3),
        ("</c", 2),
        ("</a", 0),
    ] {
        let at = text.find(part).expect("a part of the text");
        let span = Span::new(at, at + 1);
        assert_eq!(tree.element_at(span), Some(expected), "{part}");
    }
    assert_eq!(tree.element_at(Span::at(0)), Some(0));
}

#[test]
fn malformed_xml_is_reported_at_its_place() {
    for (text, line, column, excerpt, message) in [
        ("", 1, 1, "", "there is no element"),
        ("\u{FEFF}\r\n <é", 2, 2, "<é", "the text ends inside `<é>`"),
        (
            "<a>\n  <b>\n</a>",
            3,
            1,
            "</a>",
            "`</a>` does not close `<b>`, which is open",
        ),
        ("<a>\n  <b>\n", 2, 3, "<b", "`<b>` is never closed"),
        ("<a>\n<b>", 2, 1, "<b", "`<b>` is never closed"),
        ("<a x='1' x='2'/>", 1, 10, "x", "attribute `x`: given twice"),
        ("<a x='&foo;'/>", 1, 7, "&foo;", "`&foo;` is not known"),
        ("<a>é&foo;</a>", 1, 5, "&foo;", "`&foo;` is not known"),
        ("<a x='<'/>", 1, 7, "<", "`<` in an attribute value"),
        ("<a x=1/>", 1, 6, "1", "a quote is missing"),
        (
            "<!DOCTYPE a><a/>",
            1,
            1,
            "<!DOCTYPE",
            "document type declarations are not supported",
        ),
        (
            "<!-- <!DOCTYPE --><a b:c=''/>",
            1,
            22,
            "b:c",
            "the prefix `b` is not declared",
        ),
        ("<a/>\n<b/>", 2, 1, "<", "this is not part of XML"),
        ("<a/>\nb", 2, 1, "b", "this is not part of XML"),
    ] {
        let tree = Tree::parse(text);
        let fault = tree.fault.as_ref().expect("the text is not XML");
        let at = Position::of(text, fault.span.start());
        let found = (
            at.line,
            at.column,
            fault.span.of(text),
            fault.message.as_str(),
        );
        assert_eq!(found, (line, column, excerpt, message), "{text:?}");
        check_tree(text);
        check_leaves(text);
    }
}

#[test]
fn a_hundred_thousand_nested_elements_are_parsed() {
    let levels = 100_000;
    let text = "<a>\n".repeat(levels) + &"</a>\n".repeat(levels);
    let tree = Tree::parse(&text);
    assert_eq!(tree.elements.len(), levels);
    assert_eq!(tree.elements[levels - 1].depth as usize, levels - 1);
    assert_eq!(tree.leaves(&text).len(), 2 * levels);
    let middle = Span::at(4 * levels);
    assert_eq!(tree.element_at(middle), Some(levels - 1));
    let open = Tree::parse(&"<a>".repeat(levels));
    assert_eq!(
        open.fault.map(|fault| fault.span),
        Some(Span::new(3 * levels - 3, 3 * levels - 1))
    );
}

#[test]
fn excessive_attributes_and_namespaces_are_refused() {
    let attributes: Vec<_> = (0..2000).map(|at| format!("a{at}='1'")).collect();
    let spaces: Vec<_> = (0..2000).map(|at| format!("<a xmlns:b{at}='c'>")).collect();
    for text in [format!("<a {}/>", attributes.join(" ")), spaces.concat()] {
        let fault = Tree::parse(&text).fault.expect("the text is refused");
        assert!(
            fault.message.contains("are not supported"),
            "{}",
            fault.message
        );
    }
}

/// Valid and invalid fragments of XML.
fn pieces() -> impl Strategy<Value = String> {
    let piece = prop::sample::select(vec![
        "<a>",
        "</a>",
        "<b c='1'>",
        "</b>",
        "<d e=\"x\" f='&amp;'/>",
        "<!-- g -->",
        "<![CDATA[<h>]]>",
        "<?i j?>",
        "\r\n",
        "\t",
        " ",
        "é",
        "&#65;",
        "&",
        "<",
        ">",
        "\"",
        "'",
        "=",
        "/",
        "\u{FEFF}",
        "\u{0}",
        "<!DOCTYPE k>",
        "--",
        "]]>",
        "1.5",
    ]);
    prop::collection::vec(piece, 0..24).prop_map(|pieces| pieces.concat())
}

proptest! {
    #![proptest_config(repeatable::config())]

    #[test]
    fn no_text_makes_the_parser_panic(text in pieces()) {
        check_tree(&text);
        check_leaves(&text);
        let whole = format!("<a>{text}</a>");
        check_tree(&whole);
        check_leaves(&whole);
    }

    #[test]
    fn mutated_files_are_read(at in 0..EXAMPLE.len(), len in 0..40usize, put in pieces()) {
        let mut text = EXAMPLE.to_owned();
        let end = (at + len).min(text.len());
        text.replace_range(at..end, &put);
        check_tree(&text);
        check_leaves(&text);
    }

    #[test]
    fn bytes_of_all_kinds_are_read(bytes in prop::collection::vec(any::<u8>(), 0..80)) {
        let text = String::from_utf8_lossy(&bytes);
        check_tree(&text);
        check_leaves(&text);
    }

    #[test]
    fn values_are_read_back(value in "[ -~é\t\n\r]{0,12}", quote in prop::sample::select(vec!['"', '\''])) {
        let mut text = format!("<a b={quote}{quote}/>");
        let place = Span::at(6);
        let inverse = apply(&mut text, &[Edit { span: place, text: escaped(&value, quote).into() }]);
        let tree = Tree::parse(&text);
        prop_assert_eq!(tree.fault, None);
        prop_assert_eq!(tree.attributes[0].unescaped(&text), &value);
        apply(&mut text, &inverse);
        prop_assert_eq!(text.len(), 9);
    }
}
