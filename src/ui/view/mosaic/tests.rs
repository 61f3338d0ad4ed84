use std::collections::BTreeSet;

use unicode_width::UnicodeWidthChar;

use super::*;

/// The names of U+1CD00 and the following characters in Unicode 16, after `BLOCK OCTANT-`: the pixels
/// of each, numbered row by row.
const OCTANT_NAMES: &str = "\
    3 23 123 4 14 124 34 134 234 5 15 25 125 135 235 1235 45 145 245 1245 345 1345 2345 12345 6 \
    16 26 126 36 136 236 1236 146 246 1246 346 1346 2346 12346 56 156 256 1256 356 1356 2356 \
    12356 456 1456 2456 12456 3456 13456 23456 17 27 127 37 137 237 1237 47 147 247 1247 347 \
    1347 2347 12347 157 257 1257 357 2357 12357 457 1457 12457 3457 13457 23457 67 167 267 1267 \
    367 1367 2367 12367 467 1467 2467 12467 3467 13467 23467 123467 567 1567 2567 12567 3567 \
    13567 23567 123567 4567 14567 24567 124567 34567 134567 234567 1234567 18 28 128 38 138 238 \
    1238 48 148 248 1248 348 1348 2348 12348 58 158 258 1258 358 1358 2358 12358 458 1458 2458 \
    12458 3458 13458 23458 123458 168 268 1268 368 2368 12368 468 1468 12468 3468 13468 23468 \
    568 1568 2568 12568 3568 13568 23568 123568 4568 14568 24568 124568 34568 134568 234568 \
    1234568 178 278 1278 378 1378 2378 12378 478 1478 2478 12478 3478 13478 23478 123478 578 \
    1578 2578 12578 3578 13578 23578 123578 4578 14578 24578 124578 34578 134578 234578 1234578 \
    678 1678 2678 12678 3678 13678 23678 123678 4678 14678 24678 124678 34678 134678 234678 \
    1234678 15678 25678 125678 35678 235678 1235678 45678 145678 1245678 1345678 2345678";

/// The names of U+1FB00 and the following characters, after `BLOCK SEXTANT-`.
const SEXTANT_NAMES: &str = "\
    1 2 12 3 13 23 123 4 14 24 124 34 134 234 1234 5 15 25 125 35 235 1235 45 145 245 1245 345 \
    1345 2345 12345 6 16 26 126 36 136 236 1236 46 146 1246 346 1346 2346 12346 56 156 256 1256 \
    356 1356 2356 12356 456 1456 2456 12456 3456 13456 23456";

/// Older characters by the halves, quarters and quadrants in their names, as octants.
const OLDER: &[&str] = &[
    "█12345678 ▀1234 ▄5678 ▌1357 ▐2468 ▂78 ▆345678",
    "▘13 ▝24 ▖57 ▗68 ▚1368 ▞2457 ▛123457 ▜123468 ▙135678 ▟245678",
    // UPPER ONE QUARTER BLOCK and UPPER THREE QUARTERS BLOCK
    "\u{1fb82}12 \u{1fb85}123456",
    // LEFT and RIGHT HALF UPPER ONE QUARTER BLOCK, then LOWER
    "\u{1cea8}1 \u{1ceab}2 \u{1cea3}7 \u{1cea0}8",
    // MIDDLE LEFT and MIDDLE RIGHT ONE QUARTER BLOCK
    "\u{1fbe6}35 \u{1fbe7}46",
];

/// The pattern of the pixels with these numbers.
fn pattern(numbers: &str) -> usize {
    let bits = numbers.bytes().map(|number| 1 << (number - b'1'));
    bits.sum()
}

#[test]
fn block_characters_have_the_pixels_in_their_names() {
    for (mosaic, first, names) in [
        (Mosaic::Octant, '\u{1cd00}', OCTANT_NAMES),
        (Mosaic::Sextant, '\u{1fb00}', SEXTANT_NAMES),
    ] {
        for (character, name) in (first..).zip(names.split(' ')) {
            assert_eq!(mosaic.symbol(pattern(name)), character, "{name}");
        }
    }
    for older in OLDER.iter().flat_map(|older| older.split(' ')) {
        let octants = older.trim_start_matches(|c: char| !c.is_ascii());
        let symbol = Mosaic::Octant.symbol(pattern(octants));
        assert_eq!(format!("{symbol}{octants}"), older);
    }
    assert_eq!(Mosaic::Octant.symbol(pattern("")), ' ');
    // Quadrants are pairs of octants.
    for quadrants in 0..16 {
        let octants = (0..8).filter(|at| quadrants >> (at % 2 + at / 4 * 2) & 1 == 1);
        let octants: usize = octants.map(|at| 1 << at).sum();
        let symbol = Mosaic::Quadrant.symbol(quadrants);
        assert_eq!(symbol, Mosaic::Octant.symbol(octants));
    }
    for (character, sextants) in [(' ', ""), ('▌', "135"), ('▐', "246"), ('█', "123456")] {
        assert_eq!(Mosaic::Sextant.symbol(pattern(sextants)), character);
    }
}

#[test]
fn each_pattern_has_a_character_of_its_own_one_column_wide() {
    for (mosaic, patterns) in [
        (Mosaic::Quadrant, 16),
        (Mosaic::Sextant, 64),
        (Mosaic::Octant, 256),
    ] {
        let symbols: BTreeSet<_> = (0..patterns).map(|at| mosaic.symbol(at)).collect();
        assert_eq!(symbols.len(), patterns, "{mosaic:?}");
        let mut widths = symbols.iter().map(|symbol| symbol.width());
        assert!(widths.all(|width| width == Some(1)), "{mosaic:?}");
    }
}

/// A cell drawn as text: `#` and `.` are pixels of two colours.
fn drawn(rows: &str, [ink, paper]: [[u8; 3]; 2]) -> [[u8; 3]; MOST] {
    let mut pixels = [[0; 3]; MOST];
    let dots = rows.chars().filter(|dot| !dot.is_whitespace());
    for (pixel, dot) in pixels.iter_mut().zip(dots) {
        *pixel = if dot == '#' { ink } else { paper };
    }
    pixels
}

#[test]
fn two_colours_are_shown_exactly() {
    let colours = [[250, 10, 3], [0, 77, 255]];
    for (mosaic, rows, symbol) in [
        (Mosaic::Quadrant, "## ..", '▀'),
        (Mosaic::Quadrant, ".# #.", '▞'),
        (Mosaic::Sextant, "## .. ..", '\u{1fb02}'),
        (Mosaic::Sextant, "#. #. #.", '▌'),
        (Mosaic::Octant, "## ## .. ..", '▀'),
        (Mosaic::Octant, ".. #. #. ..", '\u{1fbe6}'),
    ] {
        for [ink, paper] in [colours, [colours[1], colours[0]]] {
            let tile = mosaic.tile(&drawn(rows, [ink, paper]));
            assert_eq!((tile.symbol, tile.ink, tile.paper), (symbol, ink, paper));
        }
    }
    // The last pixel is always paper.
    let tile = Mosaic::Octant.tile(&drawn(".. .. ## ##", colours));
    assert_eq!((tile.symbol, tile.ink), ('▀', colours[1]));
    let tile = Mosaic::Octant.tile(&[[7, 8, 9]; MOST]);
    assert_eq!((tile.symbol, tile.paper), (' ', [7, 8, 9]));
}

/// The least squared error of any division of the first `count` pixels in two colours, computed one
/// division after another.
fn least_error(pixels: &[[u8; 3]], count: usize) -> f64 {
    let errors = (0..1 << count).map(|pattern: usize| {
        let group = |is_in: usize| {
            let members: Vec<_> = (0..count)
                .filter(|at| pattern >> at & 1 == is_in)
                .map(|at| pixels[at].map(f64::from))
                .collect();
            let squares = (0..3).flat_map(|channel| {
                let sum: f64 = members.iter().map(|pixel| pixel[channel]).sum();
                let mean = sum / members.len() as f64;
                let offs = members.iter().map(move |pixel| pixel[channel] - mean);
                offs.map(|off| off.powi(2))
            });
            squares.sum::<f64>()
        };
        group(0) + group(1)
    });
    errors.fold(f64::MAX, f64::min)
}

#[test]
fn no_division_of_a_cell_comes_closer() {
    let mut state = 1_u32;
    let mut random = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 24) as u8
    };
    for _ in 0..300 {
        let pixels: [[u8; 3]; MOST] = std::array::from_fn(|_| [random(), random(), random()]);
        for mosaic in [Mosaic::Quadrant, Mosaic::Sextant, Mosaic::Octant] {
            let (across, down) = mosaic.grid();
            let count = usize::from(across * down);
            let tile = mosaic.tile(&pixels);
            let pattern = (0..1 << count).find(|&at| mosaic.symbol(at) == tile.symbol);
            let pattern = pattern.expect("a character of the mosaic");
            let error = |at: usize| -> f64 {
                let is_ink = pattern >> at & 1 == 1;
                let shown = if is_ink { tile.ink } else { tile.paper };
                let offs = (0..3).map(|channel| shown[channel].abs_diff(pixels[at][channel]));
                offs.map(|off| f64::from(off).powi(2)).sum()
            };
            let found: f64 = (0..count).map(error).sum();
            // Means are rounded to whole levels: up to half a level in three channels of each pixel.
            let rounding = f64::from(ROUNDING) + 0.75 * count as f64;
            let best = least_error(&pixels, count);
            assert!(found <= best + rounding, "{mosaic:?}: {found}, not {best}");
        }
    }
}
