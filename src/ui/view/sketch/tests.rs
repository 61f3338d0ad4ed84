//! Pictures as rows of characters: which object is where, and how bright it is.

use super::*;
use crate::terminal::ColourDepth;
use crate::view::tests::cell_image;

/// The cells of a picture of greys and objects.
fn drawn(depth: ColourDepth, size: (u32, u32), pixel: impl Fn(u32, u32) -> (u8, u32)) -> Buffer {
    let (width, height) = size;
    let all = || (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    let pixels = all().map(|(x, y)| [pixel(x, y).0; 3]).collect();
    let mut image = cell_image(width, height, pixels);
    image.objects = all().map(|(x, y)| pixel(x, y).1).collect();
    let area = Rect::new(0, 0, width.div_ceil(2) as u16, height.div_ceil(4) as u16);
    let mut buffer = Buffer::empty(area);
    paint(&image, &mut Inks::for_depth(depth), area, &mut buffer);
    buffer
}

fn rows(buffer: &Buffer) -> Vec<String> {
    let Rect { width, height, .. } = buffer.area;
    let row = |y| (0..width).map(move |x| buffer[(x, y)].symbol());
    (0..height).map(|y| row(y).collect()).collect()
}

#[test]
fn the_ramp_goes_from_black_to_white_in_areas_without_a_pattern() {
    let mut last = 0;
    for grey in 0..=255 {
        let rows = rows(&drawn(ColourDepth::Mono, (8, 8), |x, y| {
            // Both ends of the range.
            let grey = [grey, 0, 255][if y < 4 { 0 } else { 1 + x as usize % 2 }];
            (grey, 0)
        }));
        let symbols: Vec<_> = rows[0].chars().collect();
        assert!(
            symbols.iter().all(|symbol| *symbol == symbols[0]),
            "{rows:?}"
        );
        let step = SHADES.iter().position(|shade| rows[0].starts_with(shade));
        let step = step.expect("a shade");
        assert!(last <= step, "{grey}");
        last = step;
    }
    assert_eq!(last, SHADES.len() - 1);
}

#[test]
fn edges_of_objects_of_one_brightness_are_lines() {
    for (is_in, expected) in [
        (
            (|x, _| x < 3) as fn(i32, i32) -> bool,
            [".|.", ".|.", ".|."],
        ),
        (|_, y| y < 8, ["...", "___", "..."]),
        (|_, y| y < 6, ["...", "---", "..."]),
        (|x, y| y < 2 * x, ["\\..", ".\\.", "..\\"]),
        (|x, y| y + 2 * x < 11, ["../", "./.", "/.."]),
    ] {
        let buffer = drawn(ColourDepth::Mono, (6, 12), |x, y| {
            (60, is_in(x as i32, y as i32).into())
        });
        let plain = rows(&drawn(ColourDepth::Mono, (2, 4), |_, _| (60, 0)));
        let expected = expected.map(|row| row.replace('.', &plain[0]));
        assert_eq!(rows(&buffer), expected);
    }
}

#[test]
fn sixteen_colours_show_both_sides_of_an_edge_if_they_differ() {
    for (greys, symbol, count) in [([0, 255], "▌", 1), ([120, 120], "|", 1), ([0, 255], "█", 0)]
    {
        let buffer = drawn(ColourDepth::Palette16, (6, 4), |x, _| {
            let side = usize::from(2 < x);
            (greys[side], side as u32)
        });
        let symbols = rows(&buffer).concat();
        assert_eq!(symbols.matches(symbol).count(), count, "{symbols:?}");
    }
}

#[test]
fn any_size_is_drawn() {
    for depth in [ColourDepth::Mono, ColourDepth::Palette16] {
        for size in [(1, 1), (1, 9), (3, 5), (7, 2)] {
            drawn(depth, size, |x, y| ((40 * x) as u8, x + y));
        }
    }
}

#[test]
fn areas_of_one_object_that_differ_much_are_quarters() {
    for depth in [ColourDepth::Mono, ColourDepth::Palette16] {
        for (is_bright, symbol) in [
            ((|x, _| x == 1) as fn(u32, u32) -> bool, "▐"),
            (|_, y| y < 2, "▀"),
            (|x, y| x == 0 && 2 <= y, "▖"),
        ] {
            let grey = |x, y| if is_bright(x, y) { 255 } else { 0 };
            let buffer = drawn(depth, (2, 4), |x, y| (grey(x, y), 0));
            assert_eq!(rows(&buffer), [symbol], "{depth:?}");
        }
    }
}
