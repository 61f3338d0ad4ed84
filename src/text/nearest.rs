//! The known word that a misspelt one was probably meant to be.

use super::Diagnostic;

/// The shortest beginning of a word that is taken for it.
const BEGINNING: usize = 4;

/// Returns the known word closest to a word, regardless of case: at most two typing slips apart,
/// and one if it is short; otherwise the only one that it begins.
pub fn nearest_word<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let known: Vec<_> = known.into_iter().collect();
    let close = known.iter().copied().filter_map(|known| {
        // More slips would make a short word unrecognisable.
        let allowed = match known.len() {
            0 | 1 => 0,
            2..=4 => 1,
            _ => 2,
        };
        // Spares the distance of words of a different length, which may be very long.
        if allowed < known.len().abs_diff(word.len()) {
            return None;
        }
        let slips = edit_distance(word, known);
        (slips <= allowed).then_some((slips, known))
    });
    let closest = close.min_by_key(|&(slips, _)| slips);
    let begins = |known: &&&str| {
        let start = known.get(..word.len()).filter(|_| BEGINNING <= word.len());
        start.is_some_and(|start| start.eq_ignore_ascii_case(word))
    };
    let only_begun = || {
        let mut begun = known.iter().filter(begins);
        begun.next().filter(|_| begun.next().is_none()).copied()
    };
    closest.map(|(_, known)| known).or_else(only_begun)
}

/// Adds a question after the word that was probably meant in its place; `otherwise` if none is known.
pub fn did_you_mean(
    diagnostic: Diagnostic,
    meant: Option<&str>,
    otherwise: Option<&str>,
) -> Diagnostic {
    let span = diagnostic.span;
    match meant {
        Some(word) => diagnostic
            .with_hint(format!("did you mean `{word}`?"))
            .with_fix(span, word),
        None => Diagnostic {
            hint: otherwise.map(str::to_owned),
            ..diagnostic
        },
    }
}

/// The Levenshtein distance in characters, regardless of case: the smallest number of insertions,
/// deletions and replacements (Wagner and Fischer, "The string-to-string correction problem", 1974).
fn edit_distance(from: &str, to: &str) -> usize {
    let mut row: Vec<usize> = (0..=to.chars().count()).collect();
    for (i, a) in from.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, b) in to.chars().enumerate() {
            let replaced = diagonal + usize::from(!a.eq_ignore_ascii_case(&b));
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(diagonal + 1).min(row[j] + 1);
        }
    }
    row.last().copied().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_word_is_few_slips_away() {
        let known = [
            "box",
            "Sphere",
            "spheres",
            "torus",
            "x",
            "y",
            "refraction",
            "reflected",
            "reflection",
        ];
        let long = "s".repeat(100_000);
        for (word, nearest) in [
            ("sphere", Some("Sphere")),
            ("SPHERES", Some("spheres")),
            ("spehre", Some("Sphere")),
            ("sphère", Some("Sphere")),
            ("shperse", None),
            ("tours", Some("torus")),
            ("bxo", None),
            // The only word that it begins.
            ("spher", Some("Sphere")),
            ("refract", Some("refraction")),
            ("refl", None),
            ("bx", Some("box")),
            ("X", Some("x")),
            ("z", None),
            ("", None),
            (&long, None),
        ] {
            assert_eq!(nearest_word(word, known), nearest, "{word:.20}");
        }
    }
}
