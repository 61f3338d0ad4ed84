//! What the panel says, a label and some words a line.

use super::asking::{Whereabouts, objects_of};
use super::places::{Spot, place, spot, words as towards};
use crate::app::Shared;
use crate::located::{Lit, Located};
use language::Node;
use render::NO_OBJECT;
use scene::Emitter;
use text::counted;

/// Most names in a line.
const MOST_NAMES: usize = 4;

/// What is said of the selected thing: labels and words.
pub(crate) fn lines(whereabouts: &Whereabouts, shared: &Shared) -> Vec<(&'static str, String)> {
    let node = shared.cursor.selected();
    if 0 < shared.error_count() {
        return vec![("", "The text has errors: correct them first.".to_owned())];
    }
    let mut lines = Vec::new();
    match node {
        Node::Object(_) | Node::Material(_) => {
            let count = objects_of(shared, node).len();
            match (node, count) {
                (Node::Material(_), 0) => lines.push(("seen", "no object uses it".to_owned())),
                (_, 0) => lines.push(("seen", "not drawn: it is hidden or empty".to_owned())),
                (Node::Material(_), _) => lines.push(("used by", counted(count, "object"))),
                _ => {}
            }
            if 0 < count {
                answered(whereabouts, &mut lines, |found| {
                    of_objects(shared, node, found)
                });
            }
        }
        Node::Light(light) => {
            lines.push(("stands", of_light(shared, light)));
            answered(whereabouts, &mut lines, |found| lit(shared, found));
        }
        Node::View if shared.pictures.view.is_none() => {
            lines.push(("stands", "where the picture is seen from".to_owned()));
        }
        Node::View => lines.push(("stands", standing(shared, node))),
        _ => lines.push((
            "",
            "It belongs to the whole picture, not to a place.".to_owned(),
        )),
    }
    lines
}

/// Adds the lines of the answer, once there is one.
fn answered(
    whereabouts: &Whereabouts,
    lines: &mut Vec<(&'static str, String)>,
    of: impl Fn(&Located) -> Vec<(&'static str, String)>,
) {
    match &whereabouts.answer {
        Some(found) => lines.extend(of(found)),
        None if whereabouts.is_awaited => {
            lines.push(("", "tracing with and without it…".to_owned()));
        }
        None => lines.push(("", "could not be traced: too little memory".to_owned())),
    }
}

/// What is said of objects.
fn of_objects(shared: &Shared, node: Node, found: &Located) -> Vec<(&'static str, String)> {
    let mut lines = vec![("seen", seen(shared, node, found))];
    let hidden: usize = found.hiders.iter().map(|(_, count)| count).sum();
    if let Some(&(most, count)) = found.hiders.first() {
        let share = percent(hidden, found.covered);
        let by = name(shared, most);
        let words = match found.hiders.len() {
            1 => format!("{share} of it, by {by}"),
            _ => format!(
                "{share} of it, most by {by} ({})",
                percent(count, found.covered)
            ),
        };
        lines.push(("hidden", words));
    }
    if 0 < found.seen {
        let (reaching, dark): (Vec<_>, Vec<_>) =
            found.lights.iter().partition(|lit| 0 < lit.reached);
        let shares = reaching.iter().map(|lit| {
            let light = shared.source().name(Node::Light(lit.light as usize));
            format!("{light} ({})", percent(lit.reached, lit.asked))
        });
        let none = "no light reaches what is seen of it".to_owned();
        lines.push(("lit by", listed(shares, reaching.len()).unwrap_or(none)));
        let reasons = dark.iter().map(|lit| unlit(shared, lit));
        lines.extend(listed(reasons, dark.len()).map(|words| ("not by", words)));
    }
    lines.push(("changes", amount(shared, found.changed, found.pixels)));
    lines
}

/// Whether objects are seen, and how much of them.
fn seen(shared: &Shared, node: Node, found: &Located) -> String {
    if 0 < found.seen {
        return amount(shared, found.seen, found.pixels);
    }
    if 0 < found.covered {
        return "nowhere: all of it is hidden".to_owned();
    }
    match place(shared, node).and_then(|place| spot(shared, place)) {
        Some(Spot::Outside(direction)) => format!("outside the picture, {}", towards(direction)),
        Some(Spot::Behind(_)) => "behind the camera".to_owned(),
        _ => "nowhere: too small, or cut off by near or far".to_owned(),
    }
}

/// Where a light stands.
fn of_light(shared: &Shared, light: usize) -> String {
    let scene = shared.scene.as_ref();
    match scene
        .and_then(|scene| scene.lights.get(light))
        .map(|light| light.emitter)
    {
        Some(Emitter::Distant(_)) => "infinitely far away".to_owned(),
        Some(Emitter::Ambient) => "everywhere: it has no place".to_owned(),
        _ => standing(shared, Node::Light(light)),
    }
}

/// Where something without a surface stands.
fn standing(shared: &Shared, node: Node) -> String {
    match place(shared, node).and_then(|place| spot(shared, place)) {
        Some(Spot::Inside) => "within the picture's frame".to_owned(),
        Some(Spot::Outside(direction)) => format!("outside the picture, {}", towards(direction)),
        Some(Spot::Behind(_)) => "behind the camera".to_owned(),
        None => "nowhere".to_owned(),
    }
}

/// What is said of a light.
fn lit(shared: &Shared, found: &Located) -> Vec<(&'static str, String)> {
    let shares = found.lit.iter().map(|&(object, count)| {
        format!(
            "{} ({})",
            name(shared, object),
            percent(count, found.pixels)
        )
    });
    let none = "nothing that is seen directly".to_owned();
    let lights = listed(shares, found.lit.len()).unwrap_or(none);
    vec![
        ("lights", lights),
        ("changes", amount(shared, found.changed, found.pixels)),
    ]
}

/// Why a light lights nothing.
fn unlit(shared: &Shared, lit: &Lit) -> String {
    let light = shared.source().name(Node::Light(lit.light as usize));
    match lit.dark {
        Some((reason, Some(by))) => {
            format!(
                "{light}: {} of {}",
                explain::unlit(reason).short,
                name(shared, by)
            )
        }
        Some((reason, None)) => format!("{light}: {}", explain::unlit(reason).short),
        None => light,
    }
}

/// The first few of some words.
fn listed(words: impl Iterator<Item = String>, count: usize) -> Option<String> {
    let first: Vec<_> = words.take(MOST_NAMES).collect();
    let rest = count.saturating_sub(MOST_NAMES);
    let more = (0 < rest).then(|| format!("{rest} more"));
    (!first.is_empty()).then(|| {
        let all: Vec<_> = first.into_iter().chain(more).collect();
        all.join(", ")
    })
}

/// The name of an object, as the list has it.
fn name(shared: &Shared, object: u32) -> String {
    let is_known = object != NO_OBJECT
        && shared
            .scene
            .as_ref()
            .is_some_and(|scene| (object as usize) < scene.objects.len());
    if is_known {
        let node = Node::Object(shared.source().object(object));
        shared.source().name(node)
    } else {
        "a light".to_owned()
    }
}

/// A part of the picture, and about how many pixels of the output that is.
fn amount(shared: &Shared, count: usize, of: usize) -> String {
    let output = shared.output();
    let share = count as f64 / of.max(1) as f64;
    let pixels = (share * output.pixels() as f64).round() as usize;
    match count {
        0 => "nothing of the picture".to_owned(),
        _ if count == of => "all of the picture".to_owned(),
        _ => format!(
            "{} of the picture, about {} pixels of {}×{}",
            percent(count, of),
            grouped(pixels),
            output.width,
            output.height
        ),
    }
}

fn percent(part: usize, whole: usize) -> String {
    let percent = 100.0 * part as f64 / whole.max(1) as f64;
    match percent {
        ..0.1 => "under 0.1 %".to_owned(),
        ..10.0 => format!("{percent:.1} %"),
        _ if part < whole => format!("{:.0} %", percent.min(99.0)),
        _ => "100 %".to_owned(),
    }
}

/// A number of three digits and zeros, in groups of three.
fn grouped(number: usize) -> String {
    let unit = 10_usize.pow(number.max(1).ilog10().saturating_sub(2));
    let digits = (number.saturating_add(unit / 2) / unit * unit).to_string();
    let start = digits.len() % 3;
    let groups = digits.as_bytes()[start..].chunks(3);
    let groups = groups.map(|group| String::from_utf8_lossy(group).into_owned());
    let first = (0 < start).then(|| digits[..start].to_owned());
    first
        .into_iter()
        .chain(groups)
        .collect::<Vec<_>>()
        .join(",")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_rounded_and_grouped() {
        for (number, expected) in [
            (0, "0"),
            (7, "7"),
            (999, "999"),
            (1234, "1,230"),
            (26_398, "26,400"),
            (999_999, "1,000,000"),
        ] {
            assert_eq!(grouped(number), expected);
        }
        let shares = [(0, 9), (1, 9999), (1, 30), (299, 300), (3, 3)];
        let shares = shares.map(|(part, whole)| percent(part, whole));
        assert_eq!(
            shares,
            ["under 0.1 %", "under 0.1 %", "3.3 %", "99 %", "100 %"]
        );
    }
}
