//! Keys of COMPARE.

use crossterm::event::KeyCode;

use super::comparing::{
    explain, go_to_worst, magnify, slide_wipe, start, view_as, view_difference,
};
use super::referring::pin;
use super::state::Compare;
use crate::app::Contrast;
use crate::app::room::Row;
use crate::keymap::{Context, Key, Mode, Scope, c, key, shift};

use Context::In;
use KeyCode::{Left, Right};
use Scope::{Everywhere, These};

const IN_COMPARE: &[Context] = &[In(Mode::Compare)];
const COMPARE: Scope = These(IN_COMPARE);

/// The most useful first.
#[rustfmt::skip]
pub(crate) const KEYS: &[Row<Compare>] = &[
    Key::new(COMPARE, "flip", &[c('f')], "flip: the picture or the reference").also("switch toggle swap blink ab").hint(0, "flip").does_in(|compare, shared| view_as(compare, shared, compare.view.flipped())),
    Key::new(COMPARE, "wipe", &[c('w')], "wipe: the picture beside the reference (:w saves)").also("split slider side by before after curtain splitscreen").hint(10, "wipe (:w saves)").does_in(|compare, shared| view_as(compare, shared, Contrast::Wipe)),
    Key::new(COMPARE, "wipe-left", &[c('h'), key(Left)], "wipe further left").does_in(|compare, shared| slide_wipe(compare, shared, -1)),
    Key::new(COMPARE, "wipe-right", &[c('l'), key(Right)], "wipe further right").does_in(|compare, shared| slide_wipe(compare, shared, 1)),
    Key::new(COMPARE, "wipe-left-far", &[c('H'), shift(Left)], "wipe 8 cells further left").does_in(|compare, shared| slide_wipe(compare, shared, -8)),
    Key::new(COMPARE, "wipe-right-far", &[c('L'), shift(Right)], "wipe 8 cells further right").does_in(|compare, shared| slide_wipe(compare, shared, 8)),
    Key::new(COMPARE, "difference", &[c('c')], "difference, by the factor that fills the range; again: the next factor, heat map").also("diff subtract delta heatmap error").hint(20, "difference").does_in(view_difference),
    Key::new(COMPARE, "zoom-in", &[c('+')], "zoom in").also("magnify").hint(50, "zoom").does_in(|compare, shared| magnify(compare, shared, 1)),
    Key::new(COMPARE, "zoom-out", &[c('-')], "zoom out").also("shrink").hint(50, "zoom").does_in(|compare, shared| magnify(compare, shared, -1)),
    Key::new(COMPARE, "explain", &[c('e')], "explain the pixel that is pointed at, or the worst").also("why reason cause").hint(40, "explain").does_in(explain),
    Key::new(COMPARE, "next-worst", &[c('n')], "next of the worst pixels").also("biggest error jump").hint(30, "worst").does_in(|compare, shared| go_to_worst(compare, shared, 1)),
    Key::new(COMPARE, "previous-worst", &[c('N')], "previous of the worst pixels").hint(30, "worst").does_in(|compare, shared| go_to_worst(compare, shared, -1)),
];

/// Keys in other modes that start this one.
#[rustfmt::skip]
pub(crate) const ENTRIES: &[Row<Compare>] = &[
    Key::new(Everywhere, "pin", &[c('A')], "pin the picture, to compare with it").also("reference snapshot baseline remember store before").hint_in(IN_COMPARE, 90, "pin").requests_in(pin),
    Key::new(Everywhere, "compare", &[c('=')], "compare with the reference").also("diff difference reference before after ab versus baseline regression").requests_in(start),
];
