//! Keys of VIEW and of its flying.

use crossterm::event::KeyCode;

use super::moves::{advanced, dollied, faced, panned, rolled, stepped, widened};
use super::saved_views::{delete_view, go_to_view, list_views};
use super::state::View;
use super::working_view::{frame_selected, look_from_light, move_camera, save_view};
use crate::app::room::Row;
use crate::keymap::{Context, Key, Mode, Scope, c, key, shift};

use Context::In;
use KeyCode::{Down, Enter, Esc, Left, Right, Up};
use Scope::These;

const VIEW: Scope = These(&[In(Mode::View)]);
const FLY: Scope = These(&[In(Mode::Fly)]);
const BOTH: Scope = These(&[In(Mode::View), In(Mode::Fly)]);
const PAGE: Scope = These(&[Context::Views]);
const ORBITING: &[Context] = &[In(Mode::View)];
const FLYING: &[Context] = &[In(Mode::Fly)];

/// The most useful first.
#[rustfmt::skip]
pub(crate) const KEYS: &[Row] = &[
    Key::new(VIEW, "orbit-left", &[c('h'), key(Left)], "orbit left").also("rotate turn camera").hint(0, "orbit").does(|shared| move_camera(shared, |now| stepped(now, 1, 0))),
    Key::new(VIEW, "orbit-down", &[c('j'), key(Down)], "orbit down").also("rotate turn camera").hint(0, "orbit").does(|shared| move_camera(shared, |now| stepped(now, 0, -1))),
    Key::new(VIEW, "orbit-up", &[c('k'), key(Up)], "orbit up").also("rotate turn camera").hint(0, "orbit").does(|shared| move_camera(shared, |now| stepped(now, 0, 1))),
    Key::new(VIEW, "orbit-right", &[c('l'), key(Right)], "orbit right").also("rotate turn camera").hint(0, "orbit").does(|shared| move_camera(shared, |now| stepped(now, -1, 0))),
    Key::new(VIEW, "nearer", &[c('+'), c('=')], "nearer").also("zoom in dolly closer").hint(10, "near/far").does(|shared| move_camera(shared, |now| dollied(now, 1))),
    Key::new(VIEW, "farther", &[c('-')], "farther").also("zoom out dolly away").hint(10, "near/far").does(|shared| move_camera(shared, |now| dollied(now, -1))),
    Key::new(VIEW, "pan-left", &[c('H'), shift(Left)], "pan left").does(|shared| move_camera(shared, |now| panned(now, 1, 0))),
    Key::new(VIEW, "pan-down", &[c('J'), shift(Down)], "pan down").does(|shared| move_camera(shared, |now| panned(now, 0, -1))),
    Key::new(VIEW, "pan-up", &[c('K'), shift(Up)], "pan up").does(|shared| move_camera(shared, |now| panned(now, 0, 1))),
    Key::new(VIEW, "pan-right", &[c('L'), shift(Right)], "pan right").does(|shared| move_camera(shared, |now| panned(now, -1, 0))),
    Key::new(VIEW, "fly", &[c('F')], "fly: turn in place and move").also("walk first person wasd freely look around move").hint(60, "fly").does(|shared| shared.enter(Mode::Fly)),
    Key::new(FLY, "turn-left", &[c('h'), key(Left)], "turn left").hint(0, "turn").does(|shared| move_camera(shared, |now| faced(now, 1, 0))),
    Key::new(FLY, "turn-down", &[c('j'), key(Down)], "turn down").hint(0, "turn").does(|shared| move_camera(shared, |now| faced(now, 0, -1))),
    Key::new(FLY, "turn-up", &[c('k'), key(Up)], "turn up").hint(0, "turn").does(|shared| move_camera(shared, |now| faced(now, 0, 1))),
    Key::new(FLY, "turn-right", &[c('l'), key(Right)], "turn right").hint(0, "turn").does(|shared| move_camera(shared, |now| faced(now, -1, 0))),
    Key::new(FLY, "forward", &[c('K'), shift(Up), c('+'), c('=')], "forward").hint(12, "move").does(|shared| move_camera(shared, |now| advanced(now, 1))),
    Key::new(FLY, "backward", &[c('J'), shift(Down), c('-')], "back").hint(11, "move").does(|shared| move_camera(shared, |now| advanced(now, -1))),
    Key::new(FLY, "pan-left", &[c('H'), shift(Left)], "left").hint(10, "move").does(|shared| move_camera(shared, |now| panned(now, 1, 0))),
    Key::new(FLY, "pan-right", &[c('L'), shift(Right)], "right").hint(13, "move").does(|shared| move_camera(shared, |now| panned(now, -1, 0))),
    Key::new(FLY, "camera", &[c('F')], "move around the target again").hint(60, "orbit").does(|shared| shared.enter(Mode::View)),
    Key::new(BOTH, "frame-selection", &[c('f')], "frame the selected object").also("focus center zoom look at fit find recenter zoom where").hint_in(ORBITING, 20, "frame").does(frame_selected),
    Key::new(BOTH, "reset-view", &[c('0')], "reset to the scene's view").also("original default home camera undo").hint(30, "reset").does(|shared| shared.pictures.reset_view()).when(|shared| shared.pictures.view.is_some()),
    Key::new(BOTH, "write-view", &[c('S')], "write the view into the scene").also("save camera store keep").hint(40, "save view").does(save_view).when(|shared| shared.pictures.view.is_some()),
    Key::new(BOTH, "view-from-light", &[c('o')], "look from the selected light").also("lamp perspective").does(look_from_light),
    Key::new(BOTH, "saved-views", &[c('V')], "saved views").also("bookmarks cameras viewpoints presets list favorite snapshot").does(list_views),
    Key::new(BOTH, "narrower-view", &[c('[')], "narrow the field of view").also("fov zoom lens telephoto angle perspective focal").does(|shared| move_camera(shared, |now| widened(now, -1))),
    Key::new(BOTH, "wider-view", &[c(']')], "widen the field of view").also("fov zoom lens wide angle perspective focal").does(|shared| move_camera(shared, |now| widened(now, 1))),
    Key::new(BOTH, "roll-left", &[c(',')], "roll left").also("tilt horizon bank").hint_in(FLYING, 20, "roll").does(|shared| move_camera(shared, |now| rolled(now, 1))),
    Key::new(BOTH, "roll-right", &[c('.')], "roll right").also("tilt horizon bank").hint_in(FLYING, 20, "roll").does(|shared| move_camera(shared, |now| rolled(now, -1))),
    Key::new(BOTH, "edit", &[c('e')], "edit fields").does(|shared| shared.enter(Mode::Edit)),
    Key::new(BOTH, "list", &[key(Enter)], "back to the list").also("outline tree select").does(|shared| shared.enter(Mode::Select)),
];

/// The keys of the page of saved views.
#[rustfmt::skip]
pub(crate) const OF_PAGE: &[Row<View>] = &[
    Key::new(PAGE, "accept", &[key(Enter)], "go there").does_in(go_to_view),
    Key::new(PAGE, "delete-view", &[c('d')], "delete it").also("remove bookmark").does_in(delete_view),
    Key::new(PAGE, "search", &[c('/')], "filter").does(|shared| shared.overlays.open_search()),
    Key::new(PAGE, "back", &[key(Esc), c('q'), c('V')], "close").does(|shared| shared.overlays.page = None),
];
