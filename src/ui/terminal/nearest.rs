//! The 256 colours of terminals, and the nearest of them to another colour.

/// The levels of a channel in the cube.
const LEVELS: [u8; 6] = [0, 95, 135, 175, 215, 255];

/// The number of colours that depend on the theme, which come first.
const OF_THEME: u8 = 16;

/// The colours that do not: a cube of 6×6×6, and 24 greys.
const FIXED: [[u8; 3]; 240] = {
    let mut all = [[0; 3]; 240];
    let mut at = 0;
    while at < 216 {
        all[at] = [LEVELS[at / 36], LEVELS[at / 6 % 6], LEVELS[at % 6]];
        at += 1;
    }
    while at < all.len() {
        all[at] = [8 + 10 * (at as u8 - 216); 3];
        at += 1;
    }
    all
};

/// The light of a colour on a screen with a theme.
pub(super) fn light(index: u8, theme: &[[u8; 3]; 16]) -> [u8; 3] {
    match index.checked_sub(OF_THEME) {
        Some(at) => FIXED[usize::from(at)],
        None => theme[usize::from(index)],
    }
}

/// The nearest colour that does not depend on the theme, the first of several.
pub(super) fn nearest_fixed(colour: [u8; 3]) -> u8 {
    OF_THEME + nearest(colour, &FIXED)
}

/// The nearest colour of a theme, the first of several.
pub(super) fn nearest_of_theme(colour: [u8; 3], theme: &[[u8; 3]; 16]) -> u8 {
    nearest(colour, theme)
}

/// The place of the nearest colour in a list of fewer than 256.
fn nearest(colour: [u8; 3], among: &[[u8; 3]]) -> u8 {
    let indexed = (0_u8..).zip(among);
    let nearest = indexed.min_by_key(|(_, other)| distance(colour, **other));
    nearest.map_or(0, |(at, _)| at)
}

/// A square distance, in which red counts the more and blue the less, the redder the colours are:
/// Riemersma, "Colour metric" (<https://www.compuphase.com/cmetric.htm>), but with half the weight of
/// green.
fn distance(one: [u8; 3], other: [u8; 3]) -> i32 {
    let [one, other] = [one, other].map(|colour| colour.map(i32::from));
    let redness = one[0] + other[0];
    let weights = [1024 + redness, 1024, 1534 - redness];
    let squares = (0..3).map(|channel| {
        let difference = one[channel] - other[channel];
        weights[channel] * difference * difference
    });
    squares.sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_fixed_colour_is_nearest_to_itself() {
        for index in OF_THEME..=255 {
            let light = light(index, &[[0; 3]; 16]);
            assert_eq!(nearest_fixed(light), index, "{light:?}");
        }
    }

    #[test]
    fn the_light_of_a_colour_is_that_of_xterm() {
        let mut theme = [[0; 3]; 16];
        theme[3] = [1, 2, 3];
        for (index, expected) in [
            (3, [1, 2, 3]),
            (16, [0, 0, 0]),
            (17, [0, 0, 95]),
            (67, [95, 135, 175]),
            (196, [255, 0, 0]),
            (231, [255, 255, 255]),
            (232, [8, 8, 8]),
            (255, [238, 238, 238]),
        ] {
            assert_eq!(light(index, &theme), expected, "{index}");
        }
    }

    #[test]
    fn differences_weigh_by_channel_and_by_redness() {
        for (colour, fixed) in [
            ([0, 0, 47], 233),
            ([0, 0, 80], 17),
            ([250, 3, 3], 196),
            ([3, 3, 3], 16),
            ([5, 5, 5], 232),
            ([97, 97, 97], 241),
            ([118, 118, 118], 243),
            ([200, 100, 50], 167),
        ] {
            assert_eq!(nearest_fixed(colour), fixed, "{colour:?}");
        }
        let theme = super::super::colour::THEME;
        for (colour, at) in [
            ([255, 0, 0], 9),
            ([128, 128, 128], 8),
            ([95, 135, 175], 8),
            ([255, 255, 255], 15),
            ([0, 255, 0], 2),
        ] {
            assert_eq!(nearest_of_theme(colour, &theme), at, "{colour:?}");
        }
    }
}
