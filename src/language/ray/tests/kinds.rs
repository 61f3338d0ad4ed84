//! The kinds of objects.

use crate::ray::schema::{AMBIENT, LIGHT, ShapeKind, VIEW};

#[test]
fn objects_have_the_number_of_numbers_that_the_format_defines() {
    let counts = ShapeKind::ALL.map(|kind| (kind.keyword(), kind.numbers()));
    assert_eq!(
        counts,
        [
            ("sphere", 4 + 13),
            ("ellipsoid", 15 + 13),
            ("box", 15 + 13),
            ("cylinder", 15 + 13),
            ("cone", 15 + 13)
        ]
    );
    assert_eq!(
        [AMBIENT.numbers(), LIGHT.numbers(), VIEW.numbers()],
        [3, 6, 12]
    );
}

#[test]
fn keywords_are_case_insensitive() {
    for kind in ShapeKind::ALL {
        assert_eq!(ShapeKind::of_word(kind.keyword()), Some(kind));
        assert_eq!(
            ShapeKind::of_word(&kind.keyword().to_uppercase()),
            Some(kind)
        );
    }
    assert_eq!(ShapeKind::of_word("spere"), None);
}

#[test]
fn misspelt_keywords_are_recognised() {
    for (word, kind) in [
        ("spere", Some(ShapeKind::Sphere)),
        ("Shpere", Some(ShapeKind::Sphere)),
        ("elipsoid", Some(ShapeKind::Ellipsoid)),
        ("cilinder", Some(ShapeKind::Cylinder)),
        ("boxx", Some(ShapeKind::Box)),
        ("cones", Some(ShapeKind::Cone)),
        ("cube", None),
        ("torus", None),
        ("", None),
        ("sphère", Some(ShapeKind::Sphere)),
    ] {
        assert_eq!(
            ShapeKind::nearest(word),
            kind.map(ShapeKind::keyword),
            "{word}"
        );
    }
}
