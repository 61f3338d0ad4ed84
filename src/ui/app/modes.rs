//! The modes and pages that are rooms, one line each, and what the list generates: the state of the
//! interface, and who handles a step, a press or a key. Then the table of all keys.

use super::room::{Room, Row};
use super::{
    Compare, Gallery, Inspect, Moving, Opening, Sequence, Shared, Thumbnails, Tool, Trace, Tutor,
    View, Whereabouts, camera, compare, display, edit, files, history, inspect, keys, samples,
    select, sequence, text, trace, transform, whereabouts,
};
use crate::keymap::{Entry, Key, Keymap, Mode, RankedHint, RowId};
use crate::msg::Effect;

/// Declares the modes and pages that are rooms: the name of the state in [`App`], its type, and that of
/// its rows of keys, if it has its own.
macro_rules! modes {
    ($($(#[$doc:meta])* $field:ident: $state:ident $(, $rows:ident)?;)+) => {
        /// The whole state of the interface: what all modes share, and each mode's own.
        #[derive(Debug)]
        pub struct App {
            /// What all modes share.
            pub shared: Shared,
            $($(#[$doc])* pub $field: $state,)+
        }

        impl App {
            /// Creates the interface, and the effects to start with.
            pub fn open(opening: Opening) -> (Self, Vec<Effect>) {
                let (shared, effects) = files::open(opening);
                let app = Self {
                    shared,
                    $($field: $state::default(),)+
                };
                (app, effects)
            }

            /// Lets each room react to a step; once another scene is open, each starts afresh.
            pub(crate) fn settle(&mut self) {
                let is_replaced = std::mem::take(&mut self.shared.is_replaced);
                $(
                    if is_replaced {
                        self.$field.renew();
                    }
                    self.$field.settle(&mut self.shared);
                )+
            }

            /// Lets each room request what it shows.
            pub(crate) fn follow(&mut self) -> Vec<Effect> {
                let mut effects = Vec::new();
                $(effects.extend(self.$field.follow(&mut self.shared));)+
                effects
            }

            /// Offers a press of the left button to each room; `None` if none handles it.
            pub(crate) fn press(&mut self, at: (u16, u16)) -> Option<Vec<Effect>> {
                None$(.or_else(|| self.$field.press(&mut self.shared, at)))+
            }

            /// Offers a drag with the left button in the same way.
            pub(crate) fn drag(&mut self, at: (u16, u16)) -> Option<Vec<Effect>> {
                None$(.or_else(|| self.$field.drag(&mut self.shared, at)))+
            }

            /// Offers the release of a button in the same way.
            pub(crate) fn release(&mut self) -> Option<Vec<Effect>> {
                None$(.or_else(|| self.$field.release(&mut self.shared)))+
            }
        }

        /// Rows of keys, by the state that their steps see.
        enum Rows {
            /// Only what all modes share.
            Shared(&'static [Row]),
            $($($rows(&'static [Row<$state>]),)?)+
        }

        impl Rows {
            /// What the rows say of themselves.
            fn keys(&self) -> Vec<Key> {
                match self {
                    Self::Shared(rows) => rows.iter().map(|row| row.key).collect(),
                    $($(Self::$rows(rows) => rows.iter().map(|row| row.key).collect(),)?)+
                }
            }

            const fn count(&self) -> usize {
                match self {
                    Self::Shared(rows) => rows.len(),
                    $($(Self::$rows(rows) => rows.len(),)?)+
                }
            }

            /// Does what the keys of a row do.
            fn act(&self, at: usize, app: &mut App) -> Vec<Effect> {
                match self {
                    Self::Shared(rows) => rows[at].act(&mut (), &mut app.shared),
                    $($(Self::$rows(rows) => rows[at].act(&mut app.$field, &mut app.shared),)?)+
                }
            }

            /// Whether the keys of a row would do something now, and the present words of their hint if
            /// those depend on what is true.
            fn now(&self, at: usize, app: &App) -> (bool, Option<&'static str>) {
                match self {
                    Self::Shared(rows) => rows[at].now(&(), &app.shared),
                    $($(Self::$rows(rows) => rows[at].now(&app.$field, &app.shared),)?)+
                }
            }
        }
    };
}

modes! {
    /// The track that SEQUENCE plays.
    sequence: Sequence, Sequence;
    /// What pictures are compared with, and the comparison.
    compare: Compare, Compare;
    /// What MOVE moves.
    moving: Moving, Move;
    /// INSPECT; its cross and its rays are shared.
    inspect: Inspect;
    /// TRACE; its picture and its region are shared.
    trace: Trace;
    /// VIEW and FLY, and the page of saved views; the camera is shared.
    view: View, View;
    /// The pictures on the page of the undo history.
    thumbnails: Thumbnails;
    /// The pictures on the page of the sample scenes.
    gallery: Gallery;
    /// The lesson that is taught.
    tutor: Tutor;
    /// The panel that tells where the selected thing is.
    whereabouts: Whereabouts;
}

/// All rows of keys, in slices. Their order matters: a key that is not bound where it is pressed is
/// answered with the first row that has it elsewhere. Ctrl-H, Ctrl-I, Ctrl-M and Ctrl-[ send the same bytes as Backspace, Tab, Enter and Esc, and are therefore never bound.
const ROWS: &[Rows] = &[
    Rows::Shared(keys::lists::KEYS),
    Rows::Shared(keys::questions::KEYS),
    Rows::Shared(keys::lists::ERRORS),
    Rows::View(camera::OF_PAGE),
    Rows::Shared(files::KEYS),
    Rows::Shared(history::KEYS),
    Rows::Shared(samples::KEYS),
    Rows::Shared(keys::pages::KEYS),
    Rows::Shared(select::KEYS),
    Rows::Move(transform::ENTRIES),
    Rows::Shared(select::OTHERS),
    Rows::Shared(whereabouts::KEYS),
    Rows::Move(transform::KEYS),
    Rows::Sequence(sequence::KEYS),
    Rows::Shared(inspect::KEYS),
    Rows::Shared(edit::KEYS),
    Rows::Shared(keys::lists::REPEAT),
    Rows::Shared(camera::KEYS),
    Rows::Compare(compare::KEYS),
    Rows::Shared(display::KEYS),
    Rows::Shared(trace::KEYS),
    Rows::Sequence(sequence::ENTRIES),
    Rows::Shared(keys::anywhere::KEYS),
    Rows::Compare(compare::ENTRIES),
    Rows::Shared(keys::anywhere::OTHERS),
];

/// What all rows say of themselves.
fn all_keys() -> impl Iterator<Item = Key> {
    ROWS.iter().flat_map(Rows::keys)
}

/// The slice of a row, and its place there.
fn row(RowId(mut at): RowId) -> Option<(&'static Rows, usize)> {
    for rows in ROWS {
        match at.checked_sub(rows.count()) {
            None => return Some((rows, at)),
            Some(rest) => at = rest,
        }
    }
    None
}

impl Default for Keymap {
    fn default() -> Self {
        Self::new(all_keys())
    }
}

impl App {
    /// Goes to a mode, if it can be entered now.
    pub(crate) fn go(&mut self, mode: Mode) -> Vec<Effect> {
        let shared = &mut self.shared;
        match mode {
            Mode::Sequence => return sequence::open_track(&mut self.sequence, shared, None),
            Mode::Trace => return trace::start(shared),
            Mode::Compare => return compare::start(&mut self.compare, shared),
            Mode::Inspect => inspect::start(shared),
            Mode::Move => transform::start(&mut self.moving, shared, Tool::Move),
            Mode::Select | Mode::View | Mode::Fly | Mode::Edit => shared.enter(mode),
        }
        Vec::new()
    }

    /// Does something outside of SEQUENCE, and returns there if it fails.
    pub(crate) fn outside(&mut self, act: impl FnOnce(&mut Self) -> Vec<Effect>) -> Vec<Effect> {
        let mode = text::step_outside(&mut self.shared);
        let effects = act(self);
        text::return_if_failed(&mut self.shared, mode);
        effects
    }

    /// Does what the keys of a row do.
    pub(crate) fn act(&mut self, id: RowId) -> Vec<Effect> {
        row(id).map_or_else(Vec::new, |(rows, at)| rows.act(at, self))
    }

    /// The hints for the keys that do something now, the most useful first.
    pub fn hints(&self) -> Vec<Entry> {
        let hints = ranked_hints(self).into_iter();
        hints.map(|hint| hint.entry).collect()
    }
}

/// The same hints, with what stays where there is no room for all.
pub(crate) fn ranked_hints(app: &App) -> Vec<RankedHint> {
    let now = |id: RowId| row(id).map(|(rows, at)| rows.now(at, app));
    let acts = |id: RowId| now(id).is_some_and(|(acts, _)| acts);
    let words = |id: RowId| now(id).and_then(|(_, words)| words);
    let shared = &app.shared;
    shared.keymap.worded_hints(shared.context(), acts, words)
}

#[cfg(test)]
mod tests;
