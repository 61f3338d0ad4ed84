//! What texts mean, as data.

mod beginning;
mod blocks;
mod dat;
mod errors;
mod line_ends;
mod meaning;
mod properties;
mod views;
mod xml;

use super::{Lowered, lower};
use crate::format::{Format, Tree, parse};
use crate::scene::{Meshes, Scene};
use crate::text::Position;

/// Ambient light and one light.
const HEAD: &str = "1 1 1  1  0 5 5  1 1 1";

/// The material's numbers.
const MAT: &str = "0.1 0.1 0.1  0.5 0.5 0.5  0.2 0.2 0.2  5 0 0 1";

/// The directions of a right-handed frame.
const AXES: &str = "1 0 0  0 1 0  0 0 1";

/// A text in which `HEAD`, `MAT` and `AXES` stand for the numbers above.
fn spelled(text: &str) -> String {
    text.replace("HEAD", HEAD)
        .replace("MAT", MAT)
        .replace("AXES", AXES)
}

fn read(text: &str) -> (Tree, Lowered) {
    let tree = parse(Format::Ray, text);
    let lowered = lower(text, &tree, &Meshes::default());
    (tree, lowered)
}

/// The meaning of a text that must be free of errors.
fn scene(text: &str) -> Scene {
    let (_, lowered) = read(text);
    let said = shown(text, &lowered);
    lowered.scene.unwrap_or_else(|| panic!("{text}\n{said:#?}"))
}

/// The diagnostics as lines: `2:7 error: object 1 (sphere) radius: must be greater than 0`.
fn shown(text: &str, lowered: &Lowered) -> Vec<String> {
    let line = |diagnostic: &crate::text::Diagnostic| {
        let Position { line, column } = Position::of(text, diagnostic.span.start());
        let severity = if diagnostic.is_error() {
            "error"
        } else {
            "warning"
        };
        format!("{line}:{column} {severity}: {}", diagnostic.message)
    };
    lowered.diagnostics.iter().map(line).collect()
}
