//! Keys for what of a picture is shown.

use super::row::Row;
use crate::render::Aov;
use crate::ui::keymap::{Context, Key, Mode, Scope, c};

use Context::In;
use Scope::These;

/// Where digits are not part of a number.
const PICTURES: Scope = These(&[
    In(Mode::Select),
    In(Mode::View),
    In(Mode::Fly),
    In(Mode::Trace),
    In(Mode::Inspect),
    In(Mode::Compare),
    In(Mode::Sequence),
]);
/// Such modes with the preview on screen.
const PREVIEWS: Scope = These(&[
    In(Mode::Select),
    In(Mode::View),
    In(Mode::Fly),
    In(Mode::Inspect),
    In(Mode::Sequence),
]);
const TRACE: &[Context] = &[In(Mode::Trace)];

/// The most useful first.
#[rustfmt::skip]
pub(in crate::ui::app) const KEYS: &[Row] = &[
    Key::new(PICTURES, "show-light", &[c('1')], "show light").hint_in(TRACE, 91, "channel").does(|shared| shared.show(None)),
    Key::new(PICTURES, "show-depth", &[c('2')], "show depth, nearest white").hint_in(TRACE, 91, "channel").does(|shared| shared.show(Some(Aov::Depth))),
    Key::new(PICTURES, "show-normals", &[c('3')], "show normals").hint_in(TRACE, 91, "channel").does(|shared| shared.show(Some(Aov::Normal))),
    Key::new(PICTURES, "show-objects", &[c('4')], "show objects, one colour each").hint_in(TRACE, 91, "channel").does(|shared| shared.show(Some(Aov::Object))),
    Key::new(PICTURES, "show-albedo", &[c('5')], "show unlit colours").hint_in(TRACE, 91, "channel").does(|shared| shared.show(Some(Aov::Albedo))),
    Key::new(PICTURES, "show-cost", &[c('7')], "show cost: rays traced").does(|shared| shared.show(Some(Aov::Cost))),
    Key::new(PICTURES, "show-samples", &[c('8')], "show samples taken").does(|shared| shared.show(Some(Aov::Samples))),
    Key::new(PICTURES, "show-noise", &[c('9')], "show noise: estimated error").does(|shared| shared.show(Some(Aov::Noise))),
    Key::new(PICTURES, "next-share", &[c(')')], "next light component").does(|shared| shared.step_share(1)),
    Key::new(PICTURES, "previous-share", &[c('(')], "previous light component").does(|shared| shared.step_share(-1)),
    Key::new(PREVIEWS, "wireframe", &[c('6')], "show a wireframe, for slow links").does(|shared| shared.overlays.say(shared.pictures.show_wireframe())),
];
