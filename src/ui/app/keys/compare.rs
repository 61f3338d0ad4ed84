//! Keys of COMPARE.

use crossterm::event::KeyCode;

use super::row::Row;
use crate::ui::app::{Contrast, Shared};
use crate::ui::keymap::{Context, Key, Mode, Scope, c, key, shift};

use Context::In;
use KeyCode::{Left, Right};
use Scope::These;

const COMPARE: Scope = These(&[In(Mode::Compare)]);

/// The most useful first.
#[rustfmt::skip]
pub(in crate::ui::app) const KEYS: &[Row] = &[
    Key::new(COMPARE, "flip", &[c('f')], "flip: the picture or the reference").hint(0, "flip").does(|shared| shared.contrast(shared.compared.view.flipped())),
    Key::new(COMPARE, "wipe", &[c('w')], "wipe: the picture beside the reference (:w saves)").hint(10, "wipe (:w saves)").does(|shared| shared.contrast(Contrast::Wipe)),
    Key::new(COMPARE, "wipe-left", &[c('h'), key(Left)], "wipe further left").does(|shared| shared.slide_wipe(-1)),
    Key::new(COMPARE, "wipe-right", &[c('l'), key(Right)], "wipe further right").does(|shared| shared.slide_wipe(1)),
    Key::new(COMPARE, "wipe-left-far", &[c('H'), shift(Left)], "wipe 8 cells further left").does(|shared| shared.slide_wipe(-8)),
    Key::new(COMPARE, "wipe-right-far", &[c('L'), shift(Right)], "wipe 8 cells further right").does(|shared| shared.slide_wipe(8)),
    Key::new(COMPARE, "difference", &[c('d')], "difference, times 4, times 16, heat map").hint(20, "difference").does(|shared| shared.contrast(shared.compared.view.next_difference())),
    Key::new(COMPARE, "zoom-in", &[c('+')], "zoom in").hint(50, "zoom").does(|shared| shared.magnify(1)),
    Key::new(COMPARE, "zoom-out", &[c('-')], "zoom out").hint(50, "zoom").does(|shared| shared.magnify(-1)),
    Key::new(COMPARE, "explain", &[c('e')], "explain the pixel that is pointed at, or the worst").hint(40, "explain").does(Shared::explain_compared),
    Key::new(COMPARE, "next-worst", &[c('n')], "next of the worst pixels").hint(30, "worst").does(|shared| shared.go_to_worst(1)),
    Key::new(COMPARE, "previous-worst", &[c('N')], "previous of the worst pixels").hint(30, "worst").does(|shared| shared.go_to_worst(-1)),
];
