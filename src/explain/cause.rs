//! What is wrong with a picture as a whole.

use super::names::Names;
use super::{Sentence, Subject, sentences};
use language::Prospect;
use render::{Fault, Query, Verdict};
use scene::Size;

/// Pixels asked, across and down.
const GRID: [u32; 2] = [16, 12];

/// The fault of a picture whose text shows these prospects, unless it is black or too bright.
pub fn fault(prospects: &[Prospect]) -> Option<Fault> {
    if prospects.contains(&Prospect::Unlit) {
        Some(Fault::Unlit)
    } else if prospects.contains(&Prospect::WithoutPhotons) {
        Some(Fault::WithoutPhotons)
    } else {
        None
    }
}

impl Sentence {
    /// Whether what it says of a pixel may be so of the whole picture.
    pub fn may_be_of_picture(&self) -> bool {
        const NAMES: [&str; 10] = [
            "too-bright",
            "underexposed",
            "no-lights",
            "switched-off",
            "enclosed",
            "outside-cone",
            "faces-away",
            "attenuated",
            "dim",
            "not-reflected",
        ];
        NAMES.contains(&self.name)
    }
}

/// Why a picture is black: the verdict on most of its pixels that show an object, or else on most of all;
/// `None` if the query is no longer answered.
pub fn cause(query: &Query, subject: &Subject<'_>) -> Option<Sentence> {
    let names = Names::new(subject);
    let mut kinds: Vec<Kind> = Vec::new();
    for pixel in pixels(subject.size) {
        let explanation = query.explain(pixel, 0, &|| false)?;
        let sees = explanation.rays[0].shading().is_some();
        let verdict = &explanation.verdicts[0].verdict;
        let is_away = matches!(verdict, Verdict::FacesAway { cosine: 0.0, .. });
        let sentence = sentences::sentences(&explanation, &names).swap_remove(0);
        let is_it = |kind: &&mut Kind| {
            let other = &kind.sentence;
            kind.sees == sees && (other.name, other.node) == (sentence.name, sentence.node)
        };
        match kinds.iter_mut().find(is_it) {
            Some(kind) => kind.pixels += 1,
            None => kinds.push(Kind {
                sees,
                is_away,
                pixels: 1,
                sentence,
            }),
        }
    }
    let is_only = kinds.iter().filter(|kind| kind.sees).count() == 1;
    // Of equal ones the first.
    kinds.reverse();
    let most = kinds
        .into_iter()
        .max_by_key(|kind| (kind.sees, kind.pixels))?;
    let mut sentence = most.sentence;
    if let Some(light) = sentence.node.filter(|_| most.is_away && is_only) {
        sentence.text = format!("everything in view faces away from {}", names.node(light));
        let help = sentence.help.take();
        sentence.help = help.map(|help| help.replace("to this side", "to the camera's side"));
    }
    Some(sentence)
}

/// Pixels with the same verdict on the same thing.
struct Kind {
    /// Whether they show an object.
    sees: bool,
    /// Whether it faces away from lights.
    is_away: bool,
    pixels: usize,
    /// The verdict on the first of them.
    sentence: Sentence,
}

/// The pixels asked.
fn pixels(Size { width, height }: Size) -> impl Iterator<Item = [u32; 2]> {
    let [across, down] = GRID;
    let centre = |at: u32, count: u32, side: u32| {
        (u64::from(2 * at + 1) * u64::from(side) / u64::from(2 * count)) as u32
    };
    (0..down).flat_map(move |y| {
        (0..across).map(move |x| [centre(x, across, width), centre(y, down, height)])
    })
}
