//! The key bindings as text: the help page and the line of hints.

use super::action::{Action, Context, Mode, Playback, Stride, Tool};
use super::bindings::{Keymap, Row, names};
use super::line::{Line, line_hints};
use super::section::DIALOGS;
use super::table::Scope;
use crate::render::Aov;

use Action as A;
use Mode::{Compare, Edit, Fly, Inspect, Move, Select, Sequence, Trace, View};
use Playback::{Frames, Key, NextKey, Play, PreviousKey};
use Stride::Plain;

/// One line of help.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum HelpLine {
    /// Context of the lines below: `SELECT`, `anywhere`.
    Heading(&'static str),
    /// An input and its effect.
    Entry {
        /// The keys or other input: `j ↓`.
        keys: String,
        /// Description of the effect.
        words: &'static str,
    },
}

/// Command line arguments.
const START: [(&str, &str); 2] = [
    ("--color 24", "use 24-bit colour even if not detected"),
    ("halflight doctor", "what was detected, and why"),
];

const MOUSE: [(&str, &str); 15] = [
    ("click the list", "select"),
    ("click a field", "move the cursor there"),
    ("click it again", "choose or type a value"),
    ("drag a slider", "set a number from 0 to 1"),
    ("click a menu", "move there; again: choose"),
    ("click the picture", "select the object or symbol there"),
    ("drag it in VIEW", "orbit"),
    ("drag it with Ctrl or right", "in VIEW, pan"),
    ("drag it in MOVE", "move, rotate or scale"),
    ("drag it in COMPARE", "move the wipe line"),
    ("drag it in TRACE", "pan; after R, draw the region"),
    ("drag a border", "resize the panels"),
    ("wheel", "scroll; in VIEW, dolly; in TRACE, zoom"),
    ("Ctrl and wheel", "zoom the preview"),
    ("drag with another button", "pan the zoomed preview"),
];

/// An input and its description.
pub type Entry = (String, &'static str);

impl Keymap {
    /// Returns the help for someone in `mode`, whose keys come first: sections of lines whose keys,
    /// description or heading contain `search`, ignoring case.
    pub fn help(&self, search: &str, mode: Mode, commands: Vec<Entry>) -> Vec<HelpLine> {
        let search = search.to_lowercase();
        let mut lines = Vec::new();
        let mut add = |heading: &'static str, entries: Vec<Entry>| {
            let all = holds(heading, &search);
            let found = entries
                .into_iter()
                .filter(|(keys, words)| all || holds(keys, &search) || holds(words, &search))
                .map(|(keys, words)| HelpLine::Entry { keys, words });
            let start = lines.len();
            lines.extend(found);
            if start < lines.len() {
                lines.insert(start, HelpLine::Heading(heading));
            }
        };
        add(mode.name(), self.entries(Context::In(mode)));
        add("anywhere", self.common_entries());
        for other in Mode::ALL.into_iter().filter(|other| *other != mode) {
            add(other.name(), self.entries(Context::In(other)));
        }
        for (heading, context) in DIALOGS {
            add(heading, self.entries(context));
        }
        let owned = |(keys, words): &(&str, &'static str)| ((*keys).to_owned(), *words);
        for (heading, line) in [
            ("while a value is typed", Line::Value),
            ("in a menu, where typing filters", Line::Filter),
            ("after :", Line::Command),
            ("while the list is filtered", Line::List),
            ("after /", Line::Search),
        ] {
            add(heading, line_hints(line).iter().map(owned).collect());
        }
        add("commands", commands);
        add("mouse", MOUSE.iter().map(owned).collect());
        add("command line", START.iter().map(owned).collect());
        lines
    }

    /// Returns the hints that are never omitted in a context: how to get help, to give a command,
    /// and to quit.
    pub fn lasting_hints(&self, context: Context) -> Vec<Entry> {
        self.described(context, LASTING_HINTS.iter(), |_| true)
    }

    /// Returns the hints for a context, the most useful first, of actions that would do something. A
    /// dialog shows only its own keys.
    pub fn hints(&self, context: Context, acts: impl Fn(Action) -> bool) -> Vec<Entry> {
        let own: &[Hint] = match context {
            Context::In(Select) => SELECT_HINTS,
            Context::In(Edit) => EDIT_HINTS,
            Context::In(View) => VIEW_HINTS,
            Context::In(Fly) => FLY_HINTS,
            Context::In(Inspect) => INSPECT_HINTS,
            Context::In(Move) => MOVE_HINTS,
            Context::In(Trace) => TRACE_HINTS,
            Context::In(Compare) => COMPARE_HINTS,
            Context::In(Sequence) => SEQUENCE_HINTS,
            Context::Errors => ERROR_HINTS,
            Context::Colour => COLOUR_HINTS,
            Context::Rays => RAY_HINTS,
            Context::Region => REGION_HINTS,
            Context::Opening => &[],
            Context::Help
            | Context::Messages
            | Context::Views
            | Context::Recent
            | Context::Steps
            | Context::Conflict
            | Context::Quit
            | Context::Leave
            | Context::MovedView
            | Context::Delete
            | Context::Wait
            | Context::Overwrite
            | Context::Recover => {
                let rows = self.rows.iter();
                return rows
                    .filter(|row| row.scope.holds(context) && !row.is_common())
                    .filter(|row| is_alone(row) || matches!(row.action, A::Move(_)))
                    .filter(|row| acts(row.action))
                    .filter_map(|row| Some((row.keys_in(context).first()?.name(), row.words)))
                    .collect();
            }
        };
        let is_here =
            |hint: &&Hint| matches!(context, Context::In(mode) if hint.0 == [A::Go(mode)]);
        let hints = own
            .iter()
            .chain(COMMON_HINTS.iter().filter(|hint| !is_here(hint)));
        self.described(context, hints, acts)
    }

    /// The keys of hints in a context, without those that have none there.
    fn described(
        &self,
        context: Context,
        hints: impl Iterator<Item = &'static Hint>,
        acts: impl Fn(Action) -> bool,
    ) -> Vec<Entry> {
        hints
            .map(|(actions, words)| {
                let keys: Vec<_> = actions
                    .iter()
                    .filter(|action| acts(**action))
                    .filter_map(|action| self.key(context, *action))
                    .collect();
                (keys.join("/"), *words)
            })
            .filter(|(keys, _)| !keys.is_empty())
            .collect()
    }

    /// The keys of a context that are not the same everywhere.
    fn entries(&self, context: Context) -> Vec<Entry> {
        let differs = |row: &Row| row.own.iter().any(|(of, _)| *of == context);
        let rows = self.rows.iter();
        let rows = rows.filter(|row| row.scope.holds(context));
        let rows = rows.filter(|row| !row.is_common() || differs(row));
        with_keys(rows.map(|row| (names(row.keys_in(context)), row.words)))
    }

    fn common_entries(&self) -> Vec<Entry> {
        let rows = self.rows.iter().filter(|row| row.is_common());
        with_keys(rows.map(|row| (names(&row.keys), row.words)))
    }
}

fn with_keys(entries: impl Iterator<Item = Entry>) -> Vec<Entry> {
    entries.filter(|(keys, _)| !keys.is_empty()).collect()
}

/// Distributes sections of help over columns of about the same height, each section in one column
/// and the first at the top of the first column.
pub fn in_columns(lines: Vec<HelpLine>, count: usize) -> Vec<Vec<HelpLine>> {
    let mut columns = vec![Vec::new(); count.max(1)];
    let mut sections: Vec<Vec<HelpLine>> = Vec::new();
    for line in lines {
        match (&line, sections.last_mut()) {
            (HelpLine::Entry { .. }, Some(section)) => section.push(line),
            _ => sections.push(vec![line]),
        }
    }
    for section in sections {
        if let Some(shortest) = columns.iter_mut().min_by_key(|column| column.len()) {
            shortest.extend(section);
        }
    }
    columns
}

/// Actions whose keys are shown together, and their description in a word or two.
type Hint = (&'static [Action], &'static str);

const SELECT_HINTS: &[Hint] = &[
    (&[A::Move(1), A::Move(-1)], "move"),
    (&[A::Go(Edit)], "edit"),
    (&[A::Add], "add"),
    (&[A::Transform(Tool::Move)], "move it"),
    (&[A::Go(View)], "camera"),
    (&[A::Go(Inspect)], "inspect"),
    (&[A::Search], "filter"),
];
const EDIT_HINTS: &[Hint] = &[
    (&[A::Move(1), A::Move(-1)], "field"),
    (&[A::Nudge(-1, Plain), A::Nudge(1, Plain)], "nudge"),
    (&[A::Stride(-1), A::Stride(1)], "step"),
    (&[A::Choose], "type"),
    (&[A::OnTrack(Key)], "key it"),
    (&[A::Colour], "colour"),
    (&[A::Orthonormalise], "orthonormalise"),
    (&[A::Component(1)], "next number"),
    (&[A::Back], "back"),
];
const COLOUR_HINTS: &[Hint] = &[
    (&[A::Nudge(-1, Plain), A::Nudge(1, Plain)], "change"),
    (&[A::Move(1), A::Move(-1)], "row"),
    (&[A::Stride(-1), A::Stride(1)], "step"),
    (&[A::Accept], "confirm"),
    (&[A::Back], "cancel"),
];
const VIEW_HINTS: &[Hint] = &[
    (
        &[
            A::Orbit(1, 0),
            A::Orbit(0, -1),
            A::Orbit(0, 1),
            A::Orbit(-1, 0),
        ],
        "orbit",
    ),
    (&[A::Dolly(1), A::Dolly(-1)], "near/far"),
    (&[A::FrameSelected], "frame"),
    (&[A::ResetView], "reset"),
    (&[A::SaveView], "save view"),
    (&[A::OnTrack(Key)], "key it"),
    (&[A::Go(Fly)], "fly"),
    (&[A::Back], "back"),
];
const FLY_HINTS: &[Hint] = &[
    (
        &[A::Turn(1, 0), A::Turn(0, -1), A::Turn(0, 1), A::Turn(-1, 0)],
        "turn",
    ),
    (
        &[A::Pan(1, 0), A::Advance(-1), A::Advance(1), A::Pan(-1, 0)],
        "move",
    ),
    (&[A::Roll(1), A::Roll(-1)], "roll"),
    (&[A::ResetView], "reset"),
    (&[A::SaveView], "save view"),
    (&[A::OnTrack(Key)], "key it"),
    (&[A::Go(View)], "orbit"),
    (&[A::Back], "back"),
];
const MOVE_HINTS: &[Hint] = &[
    (
        &[
            A::Step(-1, 0, Plain),
            A::Step(0, -1, Plain),
            A::Step(0, 1, Plain),
            A::Step(1, 0, Plain),
        ],
        "step",
    ),
    (&[A::Lock(0), A::Lock(1), A::Lock(2)], "axis"),
    (&[A::Accept], "confirm"),
    (&[A::Back], "cancel"),
    (&[A::Snap], "grid"),
];
const SEQUENCE_HINTS: &[Hint] = &[
    (&[A::OnTrack(Play)], "play"),
    (&[A::OnTrack(Frames(-1)), A::OnTrack(Frames(1))], "frame"),
    (&[A::OnTrack(PreviousKey), A::OnTrack(NextKey)], "key"),
    (&[A::Go(Edit)], "edit"),
    (&[A::Accept], "keep"),
    (&[A::Back], "back"),
];
const INSPECT_HINTS: &[Hint] = &[
    (
        &[
            A::Cross(-1, 0),
            A::Cross(0, 1),
            A::Cross(0, -1),
            A::Cross(1, 0),
        ],
        "move",
    ),
    (&[A::Explain], "explain"),
    (&[A::Accept], "select"),
    (&[A::Editor], "editor"),
    (&[A::Back], "back"),
];
const RAY_HINTS: &[Hint] = &[
    (&[A::Move(1), A::Move(-1)], "move"),
    (&[A::Accept], "select"),
    (&[A::Editor], "editor"),
    (&[A::Solo], "solo light"),
    (&[A::Sample(-1), A::Sample(1)], "sample"),
    (&[A::Back], "back"),
];
const REGION_HINTS: &[Hint] = &[
    (
        &[
            A::Corner(-1, 0),
            A::Corner(0, 1),
            A::Corner(0, -1),
            A::Corner(1, 0),
        ],
        "move the corner",
    ),
    (&[A::OtherCorner], "other corner"),
    (&[A::Accept], "trace it"),
    (&[A::Back], "cancel"),
];
const TRACE_HINTS: &[Hint] = &[
    (&[A::Magnify(1), A::Magnify(-1)], "zoom"),
    (
        &[
            A::Scroll(-1, 0),
            A::Scroll(0, 1),
            A::Scroll(0, -1),
            A::Scroll(1, 0),
        ],
        "pan",
    ),
    (&[A::OneToOne], "1:1"),
    (&[A::Pause], "pause"),
    (&[A::Region], "region"),
    (&[A::Stop], "stop"),
    (&[A::Go(Inspect)], "inspect"),
    (&[A::Back], "back"),
    (&[A::Integrator], "integrator"),
    (
        &[
            A::Show(None),
            A::Show(Some(Aov::Depth)),
            A::Show(Some(Aov::Normal)),
            A::Show(Some(Aov::Object)),
            A::Show(Some(Aov::Albedo)),
        ],
        "channel",
    ),
];
const COMPARE_HINTS: &[Hint] = &[
    (&[A::Flip], "flip"),
    (&[A::Wipe], "wipe (:w saves)"),
    (&[A::Difference], "difference"),
    (&[A::Worst(1), A::Worst(-1)], "worst"),
    (&[A::Explain], "explain"),
    (&[A::Magnify(1), A::Magnify(-1)], "zoom"),
    (&[A::Back], "back"),
    (&[A::Pin], "pin"),
];
const ERROR_HINTS: &[Hint] = &[
    (&[A::Move(1), A::Move(-1)], "move"),
    (&[A::Accept], "go there"),
    (&[A::Editor], "editor"),
    (&[A::Back], "close"),
];
const COMMON_HINTS: &[Hint] = &[
    (&[A::Save], "save"),
    (&[A::Undo], "undo"),
    (&[A::Export], "export"),
    (&[A::Go(Trace)], "trace"),
];
/// Hints that are shown even where there is no room for others.
const LASTING_HINTS: &[Hint] = &[
    (&[A::Help], "help"),
    (&[A::Command], "command"),
    (&[A::Quit], "quit"),
];

fn holds(text: &str, lower_case: &str) -> bool {
    text.to_lowercase().contains(lower_case)
}

/// Whether a binding is active in only one context.
fn is_alone(row: &Row) -> bool {
    matches!(row.scope, Scope::These([_]))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(search: &str, mode: Mode) -> Vec<HelpLine> {
        let keymap = Keymap::default();
        keymap.help(search, mode, vec![(":export [WxH]".to_owned(), "write")])
    }

    fn headings(lines: &[HelpLine]) -> Vec<&'static str> {
        let heading = |line: &HelpLine| match line {
            HelpLine::Heading(heading) => Some(*heading),
            HelpLine::Entry { .. } => None,
        };
        lines.iter().filter_map(heading).collect()
    }

    fn entry(keys: &str, words: &'static str) -> HelpLine {
        HelpLine::Entry {
            keys: keys.to_owned(),
            words,
        }
    }

    #[test]
    fn the_keys_of_the_mode_come_first_and_no_key_is_missing() {
        let lines = lines("", View);
        assert_eq!(headings(&lines)[..3], ["VIEW", "anywhere", "SELECT"]);
        assert_eq!(headings(&lines).len(), 35);
        assert!(lines.contains(&entry("gg", "first")));
        for row in Keymap::default().rows {
            let entry = entry(&names(&row.keys), row.words);
            assert!(lines.contains(&entry), "{row:?}");
        }
    }

    #[test]
    fn columns_hold_whole_sections_and_all_of_them() {
        let all = lines("", Edit);
        for count in [0, 1, 2, 3, 40] {
            let columns = in_columns(all.clone(), count);
            assert_eq!(columns.len(), count.max(1));
            assert_eq!(columns[0][0], HelpLine::Heading("EDIT"));
            let shown: Vec<_> = columns.concat();
            assert_eq!(shown.len(), all.len());
            let starts = columns.iter().filter_map(|column| column.first());
            assert!(
                starts
                    .into_iter()
                    .all(|line| matches!(line, HelpLine::Heading(_)))
            );
        }
        assert_eq!(in_columns(all.clone(), 1), [all]);
    }

    #[test]
    fn search_matches_any_part_of_a_line() {
        let redraw = lines("REDRAW", Select);
        let expected = entry("Ctrl-L", "redraw the screen");
        assert_eq!(redraw, [HelpLine::Heading("anywhere"), expected]);
        assert!(lines("ctrl-r", Select).contains(&entry("Ctrl-R", "redo")));
        assert_eq!(headings(&lines("mouse", Edit)), ["mouse"]);
        assert_eq!(headings(&lines("[wxh]", Edit)), ["commands"]);
        assert!(lines("no such words", Select).is_empty());
    }

    #[test]
    fn every_hint_has_a_key() {
        let modes = Mode::ALL.map(Context::In).into_iter();
        for context in modes.chain(DIALOGS.map(|(_, context)| context)) {
            for (keys, words) in Keymap::default().hints(context, |_| true) {
                let whole = keys.split('/').all(|key| !key.is_empty());
                assert!(keys == "/" || whole, "{context:?} {words}");
            }
        }
        let hints = Keymap::default().hints(Context::In(View), |_| true);
        assert_eq!(hints[0], ("h/j/k/l".to_owned(), "orbit"));
    }

    #[test]
    fn a_question_shows_only_its_answers() {
        let keys: Vec<_> = Keymap::default()
            .hints(Context::Quit, |action| action != A::SaveView)
            .into_iter()
            .map(|hint| hint.0)
            .collect();
        assert_eq!(keys, ["y", "w", "n"]);
    }
}
