//! Tests of the meaning of texts in all languages.

mod beginning;
mod convert;
mod digits;
mod line_ends;
mod motion;
mod picture_lint;
mod rendering;
mod saved;
mod structure;
mod template;

use std::sync::Arc;

use super::convert::without_gamma;
use super::losses::Losses;
use super::{Language, Lowered, Source, verify_conversion};
use scene::{Meshes, Scene};
use text::{Diagnostic, Findings, Position, Severity, Span};

/// Parses and lowers a text.
pub(super) fn read_as(language: Language, text: &str, meshes: &Meshes) -> (Source, Lowered) {
    let mut source = Source::new(language, Arc::new(text.to_owned()));
    let lowered = source.lower(meshes).expect("there is memory for it");
    // Of what is not XML, only the first error is known.
    if !source.nodes().is_empty() {
        for found in lowered.diagnostics.iter() {
            check_fix(&source, found, &lowered.diagnostics);
        }
    }
    (source, lowered)
}

/// Checks that a fix mends its finding in whatever text a test reads.
#[track_caller]
fn check_fix(source: &Source, found: &Diagnostic, all: &Findings) {
    if found.fix.is_empty() {
        return;
    }
    let mut fixed = source.clone();
    fixed.change(&found.fix);
    let lowered = fixed.lower(&Meshes::default());
    let after = lowered.expect("there is memory for it").diagnostics;
    let is_mended = all.is_mended(found, &found.fix, &after);
    assert!(is_mended, "{found:?}\n{}\n{}", source.text(), fixed.text());
}

/// The diagnostics as lines: `2:7 error: object 1 (sphere) radius: must be greater than 0`.
pub(super) fn shown(text: &str, lowered: &Lowered) -> Vec<String> {
    let line = |diagnostic: &Diagnostic| {
        let Position { line, column } = Position::of(text, diagnostic.span.start());
        let severity = match diagnostic.severity {
            Severity::Error => "error",
            Severity::Warning => "warning",
            Severity::Note => "note",
        };
        format!("{line}:{column} {severity}: {}", diagnostic.message)
    };
    lowered.diagnostics.iter().map(line).collect()
}

/// The scene of a text written again in its own language, as though that were another one, and the
/// losses.
pub(super) fn rewritten(source: &Source, scene: &Scene) -> (String, Scene, Findings) {
    let language = source.language();
    let scene = &without_gamma(scene);
    let mut losses = Losses::new(source, scene, language);
    let text = language.write(scene, &mut losses);
    let (_, lowered) = read_as(language, &text, &Meshes::default());
    let said = shown(&text, &lowered);
    let again = lowered.scene.unwrap_or_else(|| panic!("{text}\n{said:#?}"));
    verify_conversion::report(scene, &again, &mut losses);
    (text, again, losses.into_findings())
}

/// Steele, Lea and Flood's `SplitMix64`: random enough for tests, and reproducible.
pub(super) struct Random(pub(super) u64);

impl Random {
    pub(super) fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    pub(super) fn below(&mut self, bound: usize) -> usize {
        (self.next() % bound as u64) as usize
    }

    pub(super) fn pick<'a, T: ?Sized>(&mut self, from: &[&'a T]) -> &'a T {
        from[self.below(from.len())]
    }
}

/// Removes, doubles or replaces (by one of `words`) a leaf of a text, or cuts the text there.
pub(super) fn damage(text: &mut String, leaves: &[Span], words: &[&str], random: &mut Random) {
    if leaves.is_empty() {
        text.push_str(random.pick(words));
        return;
    }
    let span = leaves[random.below(leaves.len())];
    let replacement = match random.below(5) {
        0 => String::new(),
        1 => format!("{0} {0}", span.of(text)),
        2 => leaves[random.below(leaves.len())].of(text).to_owned(),
        3 => random.pick(words).to_owned(),
        _ => {
            let bytes: Vec<u8> = (0..6).map(|_| random.next() as u8).collect();
            String::from_utf8_lossy(&bytes).into_owned()
        }
    };
    let end = if random.below(20) == 0 {
        text.len()
    } else {
        span.end()
    };
    text.replace_range(span.start()..end, &replacement);
}
