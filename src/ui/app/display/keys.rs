//! Keys for what of a picture is shown.

use super::light::{show, show_wireframe, step_share};
use crate::app::room::Row;
use crate::keymap::{Context, Key, Mode, Scope, c};
use render::Aov;

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
pub(crate) const KEYS: &[Row] = &[
    Key::new(PICTURES, "show-light", &[c('1')], "show light").also("beauty color colour normal picture default image").hint_in(TRACE, 91, "channel").does(|shared| show(shared, None)),
    Key::new(PICTURES, "show-depth", &[c('2')], "show depth, nearest white").also("distance z zbuffer pass far").hint_in(TRACE, 91, "channel").does(|shared| show(shared, Some(Aov::Depth))),
    Key::new(PICTURES, "show-normals", &[c('3')], "show normals").also("orientation surface direction pass").hint_in(TRACE, 91, "channel").does(|shared| show(shared, Some(Aov::Normal))),
    Key::new(PICTURES, "show-objects", &[c('4')], "show objects, one colour each").also("ids mask segmentation cryptomatte pass").hint_in(TRACE, 91, "channel").does(|shared| show(shared, Some(Aov::Object))),
    Key::new(PICTURES, "show-albedo", &[c('5')], "show unlit colours").also("texture base diffuse flat unlit pass").hint_in(TRACE, 91, "channel").does(|shared| show(shared, Some(Aov::Albedo))),
    Key::new(PICTURES, "show-cost", &[c('7')], "show cost: rays traced").also("heatmap slow performance time speed").does(|shared| show(shared, Some(Aov::Cost))),
    Key::new(PICTURES, "show-samples", &[c('8')], "show samples taken").also("spp adaptive").does(|shared| show(shared, Some(Aov::Samples))),
    Key::new(PICTURES, "show-noise", &[c('9')], "show noise: estimated error").also("grain variance error convergence").does(|shared| show(shared, Some(Aov::Noise))),
    Key::new(PICTURES, "next-share", &[c(')')], "next light component").also("reflections shadows diffuse specular direct indirect pass layer lights").does(|shared| step_share(shared, 1)),
    Key::new(PICTURES, "previous-share", &[c('(')], "previous light component").also("reflections diffuse specular direct indirect pass layer").does(|shared| step_share(shared, -1)),
    Key::new(PREVIEWS, "wireframe", &[c('6')], "show a wireframe, for slow links").also("mesh lines edges fast slow ssh outline").does(show_wireframe),
];
