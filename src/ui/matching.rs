//! How well rows answer what was typed: the one matcher of the palette, the help and the filters of lists.

use text::nearest_word;

/// The most characters and words that are compared otherwise than as a whole: more are no question.
const LONGEST: (usize, usize) = (80, 12);

/// Words that say nothing of what is wanted.
const FILLERS: &[&str] = &[
    "a", "an", "the", "to", "of", "in", "on", "my", "is", "it", "i", "do", "how", "can", "for",
    "and", "with", "this", "me", "please", "take", "make", "get", "want", "what", "where", "go",
];

/// Endings that do not change what a word means.
const ENDINGS: &[&str] = &[
    "ings", "ing", "ions", "ion", "ness", "ers", "er", "ed", "es", "s", "e",
];

/// Spellings, and those in their place: both find each other.
const SPELLINGS: [(&str, &str); 4] = [
    ("colour", "color"),
    ("grey", "gray"),
    ("centre", "center"),
    ("lise", "lize"),
];

/// What a row says of itself to those who search it.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Searched<'t> {
    /// Its name, or what it does if that is what it is called by.
    pub(crate) name: &'t str,
    /// Its other names.
    pub(crate) others: &'t [&'t str],
    /// Its description.
    pub(crate) words: &'t str,
    /// Everyday words for it, separated by blanks.
    pub(crate) synonyms: &'t str,
    /// What it is part of.
    pub(crate) topic: &'t str,
}

/// How a row answers what was typed, the best first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Likeness {
    /// It is its name.
    Exact,
    /// Its name begins with this word.
    BeginsWhole,
    /// Its name begins with it.
    Begins,
    /// It is a word of its name.
    HasWord,
    /// A word of its name begins with it.
    BeginsWord,
    /// It is one of its everyday words.
    Synonym,
    /// One of them begins with it.
    BeginsSynonym,
    /// Its name contains it.
    Inside,
    /// A word of its description begins with it.
    Described,
    /// Its description contains it.
    InDescription,
    /// Words are found, but not all: so many letters of others are not.
    Partly(usize),
    /// Letters of its name in this order, from the beginnings of words on.
    Letters,
    /// One of its words is spelled like it.
    Misspelt,
    /// The same, but for the first letter.
    MisspeltStart,
}

impl Likeness {
    /// Whether only a guess relates it to what was typed.
    pub(crate) fn is_guess(self) -> bool {
        Self::Partly(0) <= self
    }
}

/// The rows that answer what was typed, the best first and equal ones in their order. Guesses are among
/// them only if nothing else is.
pub(crate) fn ranked<'t, T>(
    rows: impl IntoIterator<Item = (Searched<'t>, T)>,
    typed: &str,
) -> Vec<(Likeness, T)> {
    let typed = typed.trim().to_lowercase();
    let rows = rows.into_iter();
    let found = rows.filter_map(|(row, value)| Some((likeness(&row, &typed)?, value)));
    let mut found: Vec<_> = found.collect();
    found.sort_by_key(|&(likeness, _)| likeness);
    if found.first().is_some_and(|(best, _)| !best.is_guess()) {
        found.retain(|(likeness, _)| !likeness.is_guess());
    }
    found
}

/// The rows, at most `count`, with words that have the most letters in common with what was typed.
pub(crate) fn nearest<'t, T>(
    rows: impl IntoIterator<Item = (Searched<'t>, T)>,
    typed: &str,
    count: usize,
) -> Vec<T> {
    let typed = cut(&typed.trim().to_lowercase()).to_owned();
    let rows = rows.into_iter();
    let alike = rows.map(|(row, value)| {
        let words = row.all_words();
        let alike = words.map(|word| resemblance(&word.to_lowercase(), &typed));
        (alike.max().unwrap_or(0), value)
    });
    let mut alike: Vec<_> = alike.filter(|&(alike, _)| 0 < alike).collect();
    alike.sort_by_key(|&(alike, _)| std::cmp::Reverse(alike));
    alike.into_iter().take(count).map(|(_, row)| row).collect()
}

impl<'t> Searched<'t> {
    fn names(&self) -> impl Iterator<Item = &'t str> {
        [self.name].into_iter().chain(self.others.iter().copied())
    }

    fn all_words(&self) -> impl Iterator<Item = &'t str> {
        let texts = self.names().chain([self.words, self.synonyms]);
        texts.flat_map(words_of)
    }
}

fn words_of(text: &str) -> impl Iterator<Item = &str> {
    let words = text.split(|c: char| !c.is_alphanumeric());
    words.filter(|word| !word.is_empty())
}

/// How well a row answers what was typed, in lower case.
fn likeness(row: &Searched, typed: &str) -> Option<Likeness> {
    if typed.is_empty() {
        return Some(Likeness::Exact);
    }
    // `full screen` is one word to others.
    let whole = strong(row, typed).or_else(|| {
        let one = typed.split_whitespace().collect::<String>();
        strong(row, &one).filter(|_| one != typed)
    });
    let (characters, most) = LONGEST;
    if whole.is_some() || characters < typed.len() {
        return whole;
    }
    let mut words: Vec<_> = typed.split_whitespace().collect();
    if most < words.len() {
        return None;
    }
    if words.iter().any(|word| !FILLERS.contains(word)) {
        words.retain(|word| !FILLERS.contains(word));
    }
    let (mut missing, mut worst) = (0, None);
    for word in &words {
        match strong(row, word).or_else(|| inflected(row, word)) {
            None => missing += word.len(),
            found => worst = worst.max(found),
        }
    }
    match (missing, worst) {
        (0, worst) => return worst,
        (missing, Some(_)) => return Some(Likeness::Partly(missing)),
        _ => {}
    }
    let [word] = words.as_slice() else {
        return None;
    };
    guess(row, word)
}

/// How well it answers words that are not misspelt.
fn strong(row: &Searched, typed: &str) -> Option<Likeness> {
    let spelled = as_spelled(row, typed);
    let other = respelled(typed).and_then(|typed| as_spelled(row, &typed));
    spelled.into_iter().chain(other).min()
}

/// What was typed in another spelling of the same language.
fn respelled(typed: &str) -> Option<String> {
    SPELLINGS.iter().find_map(|(one, other)| {
        if typed.contains(one) {
            Some(typed.replace(one, other))
        } else if typed.contains(other) {
            Some(typed.replace(other, one))
        } else {
            None
        }
    })
}

fn as_spelled(row: &Searched, typed: &str) -> Option<Likeness> {
    let names = row.names().filter_map(|name| of_text(name, typed));
    let synonyms = words_beginning(row.synonyms, typed);
    let texts = [row.words, row.topic].into_iter();
    let words = texts.filter_map(|words| match of_text(words, typed)? {
        Likeness::Inside => Some(Likeness::InDescription),
        _ => Some(Likeness::Described),
    });
    names.chain(synonyms).chain(words).min()
}

/// How well one of some everyday words answers what was typed.
fn words_beginning(synonyms: &str, typed: &str) -> Option<Likeness> {
    let begins = |word: &str| {
        let rest = word.strip_prefix(typed)?;
        Some(if rest.is_empty() {
            Likeness::Synonym
        } else {
            Likeness::BeginsSynonym
        })
    };
    synonyms.split(' ').filter_map(begins).min()
}

fn of_text(text: &str, typed: &str) -> Option<Likeness> {
    let text = text.to_lowercase();
    if text == typed {
        return Some(Likeness::Exact);
    }
    let is_end = |c: Option<char>| c.is_none_or(|c| !c.is_alphanumeric());
    let places = text.match_indices(typed).map(|(at, _)| {
        let (before, from) = text.split_at(at);
        let begins = is_end(before.chars().next_back());
        let ends = is_end(from[typed.len()..].chars().next());
        match (at, begins, ends) {
            (0, _, true) => Likeness::BeginsWhole,
            (0, _, false) => Likeness::Begins,
            (_, true, true) => Likeness::HasWord,
            (_, true, false) => Likeness::BeginsWord,
            (_, false, _) => Likeness::Inside,
        }
    });
    places.min()
}

/// How well it answers a word by what that has in common with its other forms.
fn inflected(row: &Searched, word: &str) -> Option<Likeness> {
    let mut stems = ENDINGS
        .iter()
        .filter_map(|ending| word.strip_suffix(ending));
    let stem = stems.find(|stem| 3 <= stem.chars().count())?;
    let found = strong(row, undoubled(stem))?;
    match found {
        found if found <= Likeness::BeginsWord => Some(Likeness::BeginsWord),
        Likeness::Synonym | Likeness::BeginsSynonym => Some(Likeness::BeginsSynonym),
        Likeness::Described => Some(Likeness::Described),
        _ => None,
    }
}

/// A stem without the letter that its ending has doubled: `pan` of panning.
fn undoubled(stem: &str) -> &str {
    let mut ends = stem.char_indices().rev();
    match (ends.next(), ends.next()) {
        (Some((at, last)), Some((_, before))) if last == before && 3 <= at => &stem[..at],
        _ => stem,
    }
}

/// What a row has to do with a word that none of its own begins with or contains.
fn guess(row: &Searched, word: &str) -> Option<Likeness> {
    let count = word.chars().count();
    if 3 <= count && row.names().any(|name| has_letters(name, word)) {
        return Some(Likeness::Letters);
    }
    if count < 4 {
        return None;
    }
    let near = nearest_word(word, row.all_words())?;
    let begins_alike = near.to_lowercase().chars().next() == word.chars().next();
    Some(if begins_alike {
        Likeness::Misspelt
    } else {
        Likeness::MisspeltStart
    })
}

/// Whether the letters of a word are the beginnings of words of a name, in this order: `ffov` in
/// `frame field of view`.
fn has_letters(name: &str, word: &str) -> bool {
    let mut left = word;
    for part in words_of(&name.to_lowercase()) {
        let same = part.chars().zip(left.chars()).take_while(|(a, b)| a == b);
        let taken: usize = same.map(|(c, _)| c.len_utf8()).sum();
        left = &left[taken..];
    }
    left.is_empty()
}

fn cut(typed: &str) -> &str {
    let end = typed.char_indices().nth(LONGEST.0);
    end.map_or(typed, |(at, _)| &typed[..at])
}

/// The share of the pairs of letters that two words have in common, in percent (Dice, "Measures of the
/// amount of ecologic association between species", 1945).
fn resemblance(one: &str, other: &str) -> usize {
    let pairs =
        |word: &str| -> Vec<(char, char)> { word.chars().zip(word.chars().skip(1)).collect() };
    let (one, mut other) = (pairs(one), pairs(other));
    let all = one.len() + other.len();
    let mut common = 0;
    for pair in one {
        if let Some(at) = other.iter().position(|&found| found == pair) {
            other.swap_remove(at);
            common += 1;
        }
    }
    200 * common / all.max(1)
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROWS: [Searched; 5] = [
        Searched {
            name: "export",
            others: &["save picture"],
            words: "write the picture",
            synonyms: "screenshot gif",
            topic: "",
        },
        Searched {
            name: "exposure",
            others: &[],
            words: "set the exposure of the display",
            synonyms: "brightness",
            topic: "",
        },
        Searched {
            name: "pan left",
            others: &[],
            words: "",
            synonyms: "scroll",
            topic: "",
        },
        Searched {
            name: "pick a colour",
            others: &[],
            words: "",
            synonyms: "paint",
            topic: "",
        },
        Searched {
            name: "re-export",
            others: &[],
            words: "",
            synonyms: "",
            topic: "",
        },
    ];

    fn found(typed: &str) -> Vec<(Likeness, &'static str)> {
        ranked(ROWS.map(|row| (row, row.name)), typed)
    }

    #[test]
    fn rows_are_ranked_by_how_they_answer() {
        use Likeness::*;
        for (typed, first, count) in [
            ("export", Some((Exact, "export")), 2),
            ("exp", Some((Begins, "export")), 3),
            ("picture", Some((HasWord, "export")), 1),
            ("SCREENSHOT", Some((Synonym, "export")), 1),
            ("bright", Some((BeginsSynonym, "exposure")), 1),
            ("set the", Some((Described, "exposure")), 1),
            ("play", Some((InDescription, "exposure")), 1),
            ("color", Some((HasWord, "pick a colour")), 1),
            ("colou", Some((BeginsWord, "pick a colour")), 1),
            ("how do I take a screenshot", Some((Synonym, "export")), 1),
            ("panning", Some((BeginsWord, "pan left")), 1),
            ("exporting", Some((BeginsWord, "export")), 2),
            ("change brightness", Some((Partly(6), "exposure")), 1),
            ("pac", Some((Letters, "pick a colour")), 1),
            ("exprot", Some((Misspelt, "export")), 2),
            ("dxport", Some((MisspeltStart, "export")), 2),
            ("screenshto", Some((Misspelt, "export")), 1),
            ("", Some((Exact, "export")), 5),
            ("zebra", None, 0),
            ("é", None, 0),
        ] {
            let found = found(typed);
            assert_eq!(found.first().copied(), first, "{typed}");
            assert_eq!(found.len(), count, "{typed} {found:?}");
        }
    }

    #[test]
    fn what_is_near_is_named_where_nothing_is_found() {
        let near = |typed: &str| nearest(ROWS.map(|row| (row, row.name)), typed, 2);
        assert_eq!(near("exports!"), ["export", "re-export"]);
        assert!(near("").is_empty());
        assert!(near("zzz").is_empty());
    }

    #[test]
    fn long_and_strange_texts_are_no_question() {
        for typed in [
            "a".repeat(4096),
            "a ".repeat(2048),
            "\u{0301}é\u{200f}".repeat(999),
        ] {
            assert!(found(&typed).is_empty(), "{typed:.20}");
            nearest(ROWS.map(|row| (row, row.name)), &typed, 3);
        }
    }
}
