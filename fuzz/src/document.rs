//! Edits of documents: setting fields, undo and redo, and merges of two versions.

use halflight::document::{Document, Merge, Side};
use halflight::language::{Before, Language, Lowered, Node, Source, Visibility};
use halflight::scene::Meshes;
use halflight::text::{Edit, smallest_edit};

use super::scene::{check, read};

/// The values that fields are set to.
const LITERALS: [&str; 14] = [
    "0",
    "1",
    "-2.5",
    "1e3",
    "0.01f",
    "1e999",
    "x",
    "",
    "1 2",
    "//",
    "<&'\">",
    "\u{e9}",
    "\r",
    "intersect",
];

/// Edits a text. The first byte selects the language; the text follows and, after a zero byte,
/// steps of three bytes each.
pub fn edits(input: &[u8]) {
    let [text, steps] = super::parts(input);
    let Some((&first, text)) = text.split_first() else {
        return;
    };
    let language = Language::ALL[usize::from(first) % 3];
    let original = String::from_utf8_lossy(text).into_owned();
    let mut document = Document::new(language, original.clone());
    let mut lowered = document.lower(&Meshes::default()).expect("there is memory");
    for step in steps.chunks_exact(3).take(64) {
        perform(&mut document, &lowered, [step[0], step[1], step[2]]);
        lowered = if step[0] % 8 == 2 {
            // The old positions are back, but `lowered` belongs to the rejected text.
            document.lower(&Meshes::default()).expect("there is memory")
        } else {
            followed(&mut document, &lowered)
        };
    }
    while document.redo().is_some() {}
    let edited = document.text().to_owned();
    while document.undo().is_some() {}
    assert_eq!(document.text(), original, "everything is undone");
    while document.redo().is_some() {}
    assert_eq!(document.text(), edited, "everything is redone");
}

/// Performs one step: the action, the number of the node, and the value.
fn perform(document: &mut Document, lowered: &Lowered, [what, which, value]: [u8; 3]) {
    let source = document.source();
    let nodes = source.nodes();
    let node = nodes.get(usize::from(which) % nodes.len().max(1));
    match (what % 8, node, &lowered.scene) {
        (0, ..) => drop(document.undo()),
        (1, ..) => drop(document.redo()),
        (2, ..) => document.reject(),
        (3, ..) => document.end_step(),
        (4, Some(Node::Object(object)), _) => {
            let wanted = [Visibility::Shown, Visibility::Hidden][usize::from(value % 2)];
            if let Ok(edits) = source.visibility_edits(&[object], wanted) {
                document.edit(&edits);
            }
        }
        (5, _, Some(scene)) => {
            let mut camera = scene.camera;
            camera.eye.x += f64::from(value) - 100.0;
            camera.size.width = camera.size.width.saturating_add(u32::from(which));
            let edits = source.view_edits(&scene.camera, &camera);
            document.edit(&edits);
        }
        (_, Some(node), _) => {
            let placed = source.fields(node);
            let fields = placed.iter().flat_map(|placed| {
                let components = 0..placed.spans.len();
                components.map(move |component| (placed, component))
            });
            let fields: Vec<_> = fields.collect();
            let Some((placed, component)) = fields.get(usize::from(value) % fields.len().max(1))
            else {
                return;
            };
            let literal = LITERALS[usize::from(what / 8) % LITERALS.len()];
            let edits = placed.edits(&**source, &[(*component, literal.to_owned())]);
            if let (6, [Edit { span, text }]) = (what % 8, &edits[..]) {
                document.set(*span, text);
            } else {
                document.edit(&edits);
            }
        }
        _ => {}
    }
}

/// Lowers a document after a step, from scratch and incrementally, and compares the results.
fn followed(document: &mut Document, was: &Lowered) -> Lowered {
    let meshes = Meshes::default();
    let fresh = Source::new(document.language(), document.shared_text());
    let (source, text) = (document.source(), document.text());
    assert!(
        source.leaves() == fresh.leaves(),
        "the tree follows the text"
    );
    let (_, lowered) = read(document.language(), text);
    let again = match &was.scene {
        Some(scene) => {
            let known = Before {
                scene,
                diagnostics: &was.diagnostics,
            };
            document.lower_again(&meshes, known)
        }
        None => document.lower(&meshes),
    };
    let again = again.expect("there is memory");
    check(document.source(), &again);
    assert!(again.scene == lowered.scene && again.diagnostics == lowered.diagnostics);
    again
}

/// Merges two texts with their ancestor. The first byte selects the language; zero bytes separate
/// the ancestor, the own text and the external one.
pub fn merge(input: &[u8]) {
    let Some((&first, rest)) = input.split_first() else {
        return;
    };
    let language = Language::ALL[usize::from(first) % 3];
    let [base, mine, theirs] = super::parts(rest).map(|part| String::from_utf8_lossy(part));
    let one_sided = if base == mine || mine == theirs {
        Some(&theirs)
    } else if base == theirs {
        Some(&mine)
    } else {
        None
    };
    let mut document = Document::new(language, base.clone().into_owned());
    let edits: Vec<_> = smallest_edit(&base, &mine).into_iter().collect();
    document.edit(&edits);
    document.end_step();
    assert_eq!(document.text(), mine);
    let theirs_read = Document::new(language, theirs.clone().into_owned());
    let merged = document.snapshot().merge(theirs_read, &Meshes::default());
    match merged.expect("there is memory") {
        Ok((merged, _)) => {
            drop(document.take(merged));
            assert!(one_sided.is_none_or(|text| document.text() == text));
            let fresh = Source::new(language, document.shared_text());
            assert!(
                document.source().leaves() == fresh.leaves(),
                "the tree matches the text"
            );
            if base == mine || document.text() == mine {
                return;
            }
            document.undo();
            assert_eq!(document.text(), mine, "a merge is undone");
        }
        Err(merge) => {
            assert!(
                one_sided.is_none(),
                "changes of one side only cannot conflict"
            );
            decide(merge, &mine);
        }
    }
}

/// Decides all conflicts for one side, then for the other.
fn decide(mut merge: Merge, mine: &str) {
    for side in [Side::Mine, Side::Theirs] {
        for conflict in &mut merge.conflicts {
            assert!(mine.get(conflict.span.range()) == Some(&conflict.mine[..]));
            conflict.decision = Some(side);
        }
        drop(merge.text());
    }
}
