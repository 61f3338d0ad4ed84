//! Long texts mean the same however they are read.

use proptest::prelude::*;

use super::read;
use crate::format::Tree;
use crate::scene::lower::objects::BLOCK;
use crate::scene::lower::ray::lower_in_order;

/// A text of so many objects, some unusual: a plain one of each kind and colour in turn.
fn text(objects: usize, declared: usize) -> String {
    let frame = "1 2 3  1 0 0  0 1 0  0 0 1  4 5 6";
    let mut text = format!("1 1 1  1  0 5 5  1 1 1  {declared}\n");
    for number in 0..objects {
        let shape = match number % 7 {
            0 => format!("box {frame}"),
            3 => format!("Cone {frame}"),
            _ => format!("sphere {number} 2 3 0.5"),
        };
        let red = f64::from(number as u32 * 7 % 40) / 30.0;
        let object = format!("{shape}  {red} 0 0  0 1 0  0 0 1  20 0 0 1 // {number}\n");
        text.push_str(&object);
    }
    text
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn blocks_mean_what_the_whole_does(
        more in 0usize..400,
        miscounted in prop_oneof![4 => Just(0), 1 => Just(1)],
        change in prop_oneof![
            Just(""), Just(" "), Just("sphere"), Just(" 1 "), Just("spere 1"), Just("nought"), Just("//"),
            Just("// view: eye 0 0 9 target 0 0 0\n"), Just("\u{A0}"), Just("-"),
        ],
        removed in 0usize..9,
        place: prop::sample::Index,
    ) {
        let mut text = text(2 * BLOCK + more, 2 * BLOCK + more + miscounted);
        let at = place.index(text.len() - 9);
        text.replace_range(at..at + removed, change);
        let (tree, lowered) = read(&text);
        let Tree::Ray(tree) = &tree else {
            unreachable!("the text was read as .ray");
        };
        let expected = lower_in_order(&text, tree);
        prop_assert_eq!(lowered.scene, expected.scene);
        prop_assert_eq!(&lowered.diagnostics, &expected.diagnostics);
        prop_assert_eq!(format!("{:?}", lowered.origins), format!("{:?}", expected.origins));
    }
}
