//! The lines of the help page: the keys of the mode on one screen, then everything by topic; or what
//! answers a search, the best first.

use super::rows::ROWS;
use super::table::{self, HelpLine};
use crate::app::{Shared, list};
use crate::keymap::{Context, HelpEntry, Topic};
use crate::matching::{self, Searched};
use crate::text_width::shorten;

/// Terms that the screen shows without room to explain them.
const TERMS: [(&str, &str); 15] = [
    (
        "spp",
        "samples per pixel traced so far; more means less noise",
    ),
    (
        "noise 1 %",
        "estimated error of the picture, of its mean brightness",
    ),
    ("Mray/s", "millions of rays traced per second"),
    ("ETA", "time left until the picture is complete"),
    ("EV, stops", "exposure: one more doubles the brightness"),
    (
        "whitted",
        "integrator: sharp shadows, mirrors and glass, direct light only",
    ),
    (
        "path",
        "integrator: all light, also what surfaces send to each other",
    ),
    (
        "photon",
        "integrator: light sent from the lights, for caustics",
    ),
    ("depth", "most bounces of a ray"),
    (
        "channel, AOV",
        "what else is known of each pixel, such as depth or normals",
    ),
    (
        "light component",
        "one light or kind of light alone, such as reflections",
    ),
    (
        "solo",
        "only this is drawn in the preview; the scene stays as it is",
    ),
    (
        "PSNR, SSIM",
        "how alike two pictures are: more is closer; 1 is the most SSIM",
    ),
    (
        "FLIP",
        "how different two pictures look to the eye: 0 is the same",
    ),
    (
        "ka kd ks kr kt",
        "ambient, diffuse, highlight, mirror and glass shares of a surface",
    ),
];

/// The heading of the terms.
const TERMINOLOGY: &str = "words and abbreviations";

/// The most columns of what was typed that are repeated where nothing is found.
const LONGEST_QUESTION: usize = 40;

/// The lines of the help page on a screen of this width, of which `rows` are seen at once.
pub(crate) fn help_lines(shared: &Shared, width: u16, rows: usize) -> Vec<HelpLine> {
    let help = shared.overlays.page(Context::Help);
    let search = help.map_or("", |help| help.filter.input.value());
    let width = usize::from(width.saturating_sub(4));
    if !search.trim().is_empty() {
        return match found(shared, search).as_slice() {
            [] => table::paragraph(&nothing(shared, search), width),
            found => table::results(found, width),
        };
    }
    let card = shared.keymap.card(shared.mode);
    let mut lines = table::card(shared.mode.name(), &card, width, rows);
    for topic in topics(shared) {
        lines.push(HelpLine::default());
        lines.extend(table::topic(&topic, width));
    }
    lines
}

/// The lines that answer a search, the best first, each with its topic.
pub(crate) fn found(shared: &Shared, search: &str) -> Vec<(HelpEntry, &'static str)> {
    let topics = topics(shared);
    let found = matching::ranked(searched(&topics), search).into_iter();
    found.map(|(_, found)| found).collect()
}

fn nothing(shared: &Shared, search: &str) -> String {
    let topics = topics(shared);
    let near = matching::nearest(searched(&topics), search, 3).into_iter();
    nothing_for(search.trim(), near.map(|(entry, _)| entry.words))
}

/// What to say where nothing was found, and what is nearest.
pub(super) fn nothing_for(typed: &str, near: impl IntoIterator<Item = impl AsRef<str>>) -> String {
    let near: Vec<_> = near
        .into_iter()
        .map(|near| near.as_ref().to_owned())
        .collect();
    let typed = shorten(typed, LONGEST_QUESTION);
    match near.as_slice() {
        [] => format!("Nothing for `{typed}`"),
        near => format!("Nothing for `{typed}`; nearest: {}", near.join(", ")),
    }
}

/// The entries of topics as they are searched: by what they do, their keys, everyday words, and their
/// topic.
fn searched(topics: &[Topic]) -> impl Iterator<Item = (Searched<'_>, (HelpEntry, &'static str))> {
    topics.iter().flat_map(|topic| {
        topic.entries.iter().map(|entry| {
            // A term is called by itself, a key by what it does.
            let (name, words) = if topic.heading == TERMINOLOGY {
                (&entry.keys, &entry.words)
            } else {
                (&entry.words, &entry.keys)
            };
            let searched = Searched {
                name,
                words,
                synonyms: &entry.synonyms,
                topic: topic.heading,
                others: &[],
            };
            (searched, (entry.clone(), topic.heading))
        })
    })
}

/// All topics: the present mode and what is the same anywhere, commands, terms, then the rest.
fn topics(shared: &Shared) -> Vec<Topic> {
    let commands = ROWS.iter().map(|row| HelpEntry {
        synonyms: format!("{} {}", row.names.join(" "), row.synonyms),
        ..HelpEntry::new(&row.usage(), row.words)
    });
    let terms = TERMS
        .iter()
        .map(|(term, words)| HelpEntry::new(term, words));
    let others = [
        Topic {
            heading: "commands",
            entries: commands.collect(),
        },
        Topic {
            heading: TERMINOLOGY,
            entries: terms.collect(),
        },
    ];
    let mut topics = shared.keymap.topics(shared.mode);
    let at = topics.len().min(2);
    topics.splice(at..at, others);
    topics
}

/// Scrolls the help page no further than to its end.
pub(crate) fn scroll_help(shared: &mut Shared) {
    if shared.overlays.page(Context::Help).is_none() {
        return;
    }
    let rows = list::help_rows(shared);
    let last = help_lines(shared, shared.terminal.0, rows).len();
    let last = last.saturating_sub(rows);
    if let Some(help) = shared.overlays.page_mut(Context::Help) {
        help.filter.at = help.filter.at.min(last);
    }
}
