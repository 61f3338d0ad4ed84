//! A track related to the text of a scene.

use std::collections::BTreeMap;

use super::field::{self, Place};
use super::{CameraTrack, FieldTrack, Keys, Parameter, Track, Value, thing};
use language::schema::Range;
use language::{FieldSpans, Node, Source};
use scene::{Camera, Lens};
use text::{Diagnostic, Edit, Findings, spell_like};

/// A track whose names are resolved in the text of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Bound {
    fields: Vec<BoundField>,
    /// How the camera moves, and the camera of the text.
    camera: Option<(CameraTrack, Camera)>,
}

/// A field of the text and its values.
#[derive(Clone, Debug, PartialEq)]
struct BoundField {
    node: Node,
    place: Place,
    keys: Keys,
}

/// Relates a track to a text that was lowered, with its camera, and reports all errors and warnings
/// that are in the track file. If there are errors, what is wrong is left out.
pub fn bind(track: &Track, source: &Source, camera: &Camera) -> (Bound, Findings) {
    let mut findings = Findings::default();
    if let Some(track) = &track.camera {
        check_lens(track, camera, &mut findings);
    }
    let names: Vec<_> = track.fields.iter().map(|field| &field.thing).collect();
    let mut fields: Vec<BoundField> = Vec::new();
    for (field, node) in track.fields.iter().zip(thing::find(source, &names)) {
        let bound = node.and_then(|node| {
            let bound = bound(source, field, node, &mut findings)?;
            let mut others = fields.iter().filter(|other| other.node == node);
            if others.any(|other| other.place.overlaps(bound.place)) {
                let message = "this field is already set by another track";
                let expected = "one track for each field";
                return Err(Diagnostic::error(field.field.span, message, expected));
            }
            if let Some(course) = track.camera.as_ref().filter(|_| node == Node::View) {
                check_view(source, (course, camera), field, bound.place)?;
            }
            Ok(bound)
        });
        match bound {
            Ok(bound) => fields.push(bound),
            Err(error) => findings.error(|| error),
        }
    }
    let bound = Bound {
        fields,
        camera: track.camera.clone().map(|track| (track, *camera)),
    };
    (bound, findings.sorted())
}

/// Relates the track of one field to its thing.
fn bound(
    source: &Source,
    track: &FieldTrack,
    node: Node,
    findings: &mut Findings,
) -> Result<BoundField, Diagnostic> {
    let fields = source.fields(node);
    let name = source.name(node);
    let place = field::find(&name, &fields, &track.field)?;
    let placed = &fields[place.field];
    let refused = |message: String, expected: &str, hint: &str| {
        Diagnostic::error(track.field.span, message, expected).with_hint(hint)
    };
    if placed.field.kind.is_size() {
        let message = "the size of the picture cannot change between frames".to_owned();
        return Err(refused(
            message,
            "another field",
            "set it for all frames by --size",
        ));
    }
    if placed.spans.is_empty() {
        let key = placed.field.key;
        return Err(refused(
            format!("the scene does not state its {key}"),
            "a field that is in the text of the scene",
            "move the view by [camera] or [orbit] instead",
        ));
    }
    field::check(
        source,
        node,
        (placed, place.component),
        &track.keys,
        findings,
    );
    Ok(BoundField {
        node,
        place,
        keys: if placed.field.kind.is_numeric() {
            track.keys.clone()
        } else {
            track.keys.clone().into_words()
        },
    })
}

/// Checks that the camera has the kind of lens that the track sets.
fn check_lens(track: &CameraTrack, camera: &Camera, findings: &mut Findings) {
    let (wrong, right, view) = match camera.lens {
        Lens::Perspective(_) => (Parameter::Height, Parameter::Fov, "perspective"),
        Lens::Orthographic(_) => (Parameter::Fov, Parameter::Height, "orthographic"),
    };
    let set = track.parameters.iter().find(|(set, _)| *set == wrong);
    if let Some(key) = set.and_then(|(_, keys)| keys.iter().next()) {
        findings.error(|| {
            let message = format!("{}: the view is {view}", wrong.name());
            Diagnostic::error(key.span, message, format!("{} instead", right.name()))
        });
    }
}

/// Checks that a track of a field of the view and one of the camera do not write the same place.
fn check_view(
    source: &Source,
    (course, camera): (&CameraTrack, &Camera),
    track: &FieldTrack,
    place: Place,
) -> Result<(), Diagnostic> {
    let fields = source.fields(Node::View);
    let message = if !fields[place.field].is_explicit() {
        "the text does not state this field, and the camera moves"
    } else if is_moved(source, (course, camera), place.field) {
        "the camera moves this field already"
    } else {
        return Ok(());
    };
    let expected = "a field of the view that the text states, and the camera does not move";
    Err(Diagnostic::error(track.field.span, message, expected))
}

/// Whether a moving camera sets a field of the view.
fn is_moved(source: &Source, (course, camera): (&CameraTrack, &Camera), field: usize) -> bool {
    let fields = source.view_fields();
    let before = fields.iter().take(field);
    let first: usize = before.map(|field| field.kind.components()).sum();
    let Some(field) = fields.get(field) else {
        return false;
    };
    let own = first..first + field.kind.components();
    let [still, moving] =
        [*camera, course.unset(camera)].map(|camera| source.view_numbers(&camera));
    own.into_iter().any(|at| still[at] != moving[at])
}

impl Bound {
    /// The tracks that set a field of the text or a component of it: their indices in
    /// [`Track::fields`], and the component if only that is set.
    pub(super) fn tracks_of(
        &self,
        node: Node,
        field: usize,
    ) -> impl Iterator<Item = (usize, Option<usize>)> {
        let fields = self.fields.iter().enumerate();
        let own = fields.filter(move |(_, bound)| (bound.node, bound.place.field) == (node, field));
        own.map(|(index, bound)| (index, bound.place.component))
    }

    /// Whether it moves the camera.
    pub fn moves_camera(&self) -> bool {
        self.camera.is_some()
    }

    /// The edits that make the text show a frame, sorted and disjoint. The text must be as it was
    /// bound, and lowered.
    pub fn edits(&self, source: &Source, frame: u32) -> Vec<Edit> {
        let mut edits = self.field_edits(source, frame);
        if let Some((track, base)) = &self.camera {
            // Written even where it equals the text's, which may be a default that moves.
            let before = track.unset(base);
            edits.extend(source.view_edits(&before, &track.at(frame, base)));
        }
        let text = source.text();
        edits.retain(|edit| edit.span.of(text) != edit.text);
        Edit::sort(&mut edits);
        edits
    }

    fn field_edits(&self, source: &Source, frame: u32) -> Vec<Edit> {
        let mut wanted: BTreeMap<(Node, usize), Vec<(usize, String)>> = BTreeMap::new();
        let mut fields: BTreeMap<Node, Vec<FieldSpans>> = BTreeMap::new();
        for bound in &self.fields {
            let own = fields
                .entry(bound.node)
                .or_insert_with(|| source.fields(bound.node));
            if let Some(placed) = own.get(bound.place.field) {
                let field = (bound.node, bound.place.field);
                let literals = literals(source, placed, bound, frame);
                wanted.entry(field).or_default().extend(literals);
            }
        }
        let wanted = wanted.into_iter().filter_map(|((node, field), literals)| {
            Some((fields.get(&node)?.get(field)?, literals))
        });
        source.edits(&wanted.collect::<Vec<_>>())
    }
}

/// The literals of the components that a track sets at a frame.
fn literals(
    source: &Source,
    placed: &FieldSpans,
    bound: &BoundField,
    frame: u32,
) -> Vec<(usize, String)> {
    let first = bound.place.component.unwrap_or_default();
    match bound.keys.at(frame) {
        Value::Word(word) => vec![(first, word)],
        Value::Numbers(numbers) => {
            let numbers = numbers.into_iter().enumerate();
            let spelled = numbers.map(|(at, number)| {
                let component = first + at;
                (component, spelled(source, placed, component, number))
            });
            spelled.collect()
        }
    }
}

/// A number in the style of what it replaces.
fn spelled(source: &Source, placed: &FieldSpans, component: usize, number: f64) -> String {
    let whole = matches!(
        placed.field.allowed,
        Range::Count | Range::Whole(..) | Range::Identity
    );
    let number = if whole { number.round() } else { number };
    // Adding 0 turns −0 into 0.
    let number = number + 0.0;
    match placed.spans.get(component) {
        Some(span) if placed.default_of(component).is_none() => {
            spell_like(span.of(source.text()).trim(), number)
        }
        _ => number.to_string(),
    }
}
