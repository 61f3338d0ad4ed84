//! The key bindings as text: the help page and the line of hints.

use super::bindings::{Keymap, Row, RowId, names};
use super::context::{Context, Mode};
use super::key::Hint;
use super::section::Section;
use super::typed_line::{Line, line_hints};

/// The rank of keys without a hint, where all are shown.
const UNHINTED: u8 = 50;

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
    ("drag it in TRACE", "pan, or draw the region"),
    ("drag a border", "resize the panels"),
    ("wheel", "scroll; in VIEW, dolly; in TRACE, zoom"),
    ("Ctrl and wheel", "zoom the preview"),
    ("drag with another button", "pan the zoomed preview"),
];

/// An input and its description.
pub type Entry = (String, &'static str);

/// The same, and everyday words that find it too.
pub(super) type SearchedEntry = (String, &'static str, &'static str);

impl Keymap {
    /// Returns the help for someone in `mode`, whose keys come first: sections of lines whose keys,
    /// description, synonyms or heading contain `search`, ignoring case.
    pub fn help(&self, search: &str, mode: Mode, commands: Vec<SearchedEntry>) -> Vec<HelpLine> {
        let search = search.to_lowercase();
        let mut lines = Vec::new();
        let mut add = |heading: &'static str, entries: Vec<SearchedEntry>| {
            let all = holds(heading, &search);
            let is_found = |(keys, words, synonyms): &SearchedEntry| {
                all || [keys, *words, *synonyms]
                    .iter()
                    .any(|text| holds(text, &search))
            };
            let found = entries.into_iter().filter(is_found);
            let start = lines.len();
            lines.extend(found.map(|(keys, words, _)| HelpLine::Entry { keys, words }));
            if start < lines.len() {
                lines.insert(start, HelpLine::Heading(heading));
            }
        };
        let here = Context::In(mode);
        add(here.heading(), self.entries(Section::In(here)));
        add("anywhere", self.entries(Section::Anywhere));
        for other in Context::all().filter(|context| *context != here) {
            add(other.heading(), self.entries(Section::In(other)));
        }
        let owned = |(keys, words): &(&str, &'static str)| ((*keys).to_owned(), *words, "");
        for (heading, line) in [
            ("while a value is typed", Line::Value),
            ("in a menu, where typing filters", Line::Menu),
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
        let hints = self.rows.iter().filter_map(|row| {
            let words = row.key.lasting?;
            Some((self.key(context, row.key.name)?, words))
        });
        hints.collect()
    }

    /// Returns the hints for a context, the most useful first, of keys that would do something. Without
    /// hints of their own, questions and pages show all of their keys.
    pub fn hints(&self, context: Context, acts: impl Fn(RowId) -> bool) -> Vec<Entry> {
        let here = self.rows.iter().filter(|row| row.key.scope.holds(context));
        let mut own = here.clone().filter(|row| row.key.is_alone());
        let is_terse = own.any(|row| row.key.hint_of(context).is_some());
        let hints = here.filter(|row| acts(row.id)).filter_map(|row| {
            let all =
                || (!is_terse && row.key.is_alone()).then(|| Hint::new(UNHINTED, row.key.words));
            let hint = row.key.hint_of(context).or_else(all)?;
            Some((hint, self.key(context, row.key.name)?))
        });
        let mut hints: Vec<_> = hints.collect();
        hints.sort_by_key(|(hint, _)| hint.rank);
        let mut entries: Vec<Entry> = Vec::new();
        for (Hint { words, .. }, key) in hints {
            match entries.last_mut() {
                Some((keys, last)) if *last == words => *keys = format!("{keys}/{key}"),
                _ => entries.push((key, words)),
            }
        }
        entries
    }

    /// The rows of a section that have keys.
    fn entries(&self, section: Section) -> Vec<SearchedEntry> {
        let rows = self.rows.iter().filter(|row| section.lists(row));
        let bound = rows.filter(|row| !row.keys_of(section).is_empty());
        let entry = |row: &Row| {
            let keys = names(row.keys_of(section));
            (keys, row.key.words, row.key.synonyms)
        };
        bound.map(entry).collect()
    }
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

fn holds(text: &str, lower_case: &str) -> bool {
    text.to_lowercase().contains(lower_case)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(search: &str, mode: Mode) -> Vec<HelpLine> {
        let commands = vec![(":export [WxH]".to_owned(), "write", "screenshot")];
        Keymap::default().help(search, mode, commands)
    }

    fn headings(lines: &[HelpLine]) -> Vec<&'static str> {
        let heading = |line: &HelpLine| match line {
            HelpLine::Heading(heading) => Some(*heading),
            HelpLine::Entry { .. } => None,
        };
        lines.iter().filter_map(heading).collect()
    }

    fn entry(keys: &str, words: &'static str) -> HelpLine {
        let keys = keys.to_owned();
        HelpLine::Entry { keys, words }
    }

    #[test]
    fn the_keys_of_the_mode_come_first_and_no_key_is_missing() {
        let lines = lines("", Mode::View);
        assert_eq!(headings(&lines)[..3], ["VIEW", "anywhere", "SELECT"]);
        for context in Context::all() {
            let mut found = headings(&lines);
            found.retain(|heading| *heading == context.heading());
            assert_eq!(found.len(), 1, "{context:?}");
        }
        assert!(lines.contains(&entry("gg", "first")));
        for row in Keymap::default().rows {
            let entry = entry(&names(&row.keys), row.key.words);
            assert!(lines.contains(&entry), "{row:?}");
        }
    }

    #[test]
    fn columns_hold_whole_sections_and_all_of_them() {
        let all = lines("", Mode::Edit);
        for count in [0, 1, 2, 3, 40] {
            let columns = in_columns(all.clone(), count);
            assert_eq!(columns.len(), count.max(1));
            assert_eq!(columns[0][0], HelpLine::Heading("EDIT"));
            assert_eq!(columns.concat().len(), all.len());
            for start in columns.iter().filter_map(|column| column.first()) {
                assert!(matches!(start, HelpLine::Heading(_)), "{start:?}");
            }
        }
        assert_eq!(in_columns(all.clone(), 1), [all]);
    }

    #[test]
    fn search_matches_any_part_of_a_line() {
        let redraw = lines("REDRAW", Mode::Select);
        let expected = entry("Ctrl-L", "redraw the screen");
        assert_eq!(redraw, [HelpLine::Heading("anywhere"), expected]);
        assert!(lines("ctrl-r", Mode::Select).contains(&entry("Ctrl-R", "redo")));
        assert_eq!(headings(&lines("mouse", Mode::Edit)), ["mouse"]);
        assert_eq!(headings(&lines("[wxh]", Mode::Edit)), ["commands"]);
        let export = entry(":export [WxH]", "write");
        assert!(lines("screenshot", Mode::Select).contains(&export));
        assert!(lines("no such words", Mode::Select).is_empty());
    }

    #[test]
    fn every_hint_has_a_key() {
        for context in Context::all() {
            for (keys, words) in Keymap::default().hints(context, |_| true) {
                let whole = keys.split('/').all(|key| !key.is_empty());
                assert!(keys == "/" || whole, "{context:?} {words}");
            }
        }
        let hints = Keymap::default().hints(Context::In(Mode::View), |_| true);
        assert_eq!(hints[0], ("h/j/k/l".to_owned(), "orbit"));
    }

    #[test]
    fn a_question_shows_only_its_answers() {
        let keymap = Keymap::default();
        let is_answer = |id: RowId| keymap.rows[id.0].key.name != "write-view";
        let hints = keymap.hints(Context::Quit, is_answer);
        let keys: Vec<_> = hints.into_iter().map(|(keys, _)| keys).collect();
        assert_eq!(keys, ["y", "w", "n"]);
    }
}
