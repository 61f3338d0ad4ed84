//! Setting fields: of the selected and the marked nodes in the text, and of the working view.

use super::edit::try_edits;
use crate::app::Shared;
use crate::app::values::typed::Values;
use language::schema::Field;
use language::{FieldSpans, Node};
use scene::Camera;
use text::{Diagnostic, Edit, Span};

/// A field, its index among those of the selected node, and the components to set.
type Wanted<'a> = (usize, &'a FieldSpans, &'a Values);

/// Sets components of the current field and, with the further values, of those below it, in one
/// edit.
pub(crate) fn assign(shared: &mut Shared, values: &[Values]) -> Result<(), Diagnostic> {
    let fields = shared.cursor.fields().to_vec();
    let below = fields.iter().enumerate().skip(shared.cursor.field);
    let wanted: Vec<Wanted> = below
        .zip(values)
        .map(|((at, placed), values)| (at, placed, values))
        .collect();
    if shared.cursor.selected() == Node::View {
        return assign_view(shared, &wanted);
    }
    try_edits(shared, &edits_of(shared, &unnumbered(&wanted)))?;
    say_marked(shared);
    Ok(())
}

/// Says in how many of the marked nodes the current field was set, if there are several.
pub(crate) fn say_marked(shared: &mut Shared) {
    let marks = shared.cursor.marks.len();
    let Some(field) = shared.cursor.current().map(|placed| placed.field) else {
        return;
    };
    if !sets_marked(shared) || marks < 2 {
        return;
    }
    let source = shared.source();
    let has = |node: &&Node| placed_like(&source.fields(**node), field).is_some();
    let set = shared.cursor.marks.iter().filter(has).count();
    let key = field.key;
    shared.overlays.show_passing(if set == marks {
        format!("{key} set in all {marks} marked items")
    } else {
        format!("{key} set in {set} of {marks} marked items; the others have none")
    });
}

/// The field of a node that is like one of another node.
pub(crate) fn placed_like<'f>(fields: &'f [FieldSpans], field: &Field) -> Option<&'f FieldSpans> {
    let is_like =
        |placed: &&FieldSpans| placed.field.key == field.key && placed.field.kind == field.kind;
    fields.iter().find(is_like)
}

/// Whether a field is set in all marked nodes, as the selected one is one of them.
pub(crate) fn sets_marked(shared: &Shared) -> bool {
    shared.cursor.marks.contains(&shared.cursor.selected())
}

/// The edits that set components of fields of the selected node or, if it is marked, of all
/// marked nodes that have them.
pub(crate) fn edits_of(shared: &Shared, wanted: &[(&FieldSpans, Values)]) -> Vec<Edit> {
    let source = shared.source();
    if !sets_marked(shared) {
        return source.edits(wanted);
    }
    let marks = shared.cursor.marks.iter();
    let fields: Vec<_> = marks.flat_map(|&node| source.fields(node)).collect();
    let found = fields.iter().filter_map(|placed| {
        let is_meant = |(wanted, _): &&(&FieldSpans, _)| {
            wanted.field.key == placed.field.key && wanted.field.kind == placed.field.kind
        };
        let (_, values) = wanted.iter().find(is_meant)?;
        Some((placed, values.clone()))
    });
    source.edits(&found.collect::<Vec<_>>())
}

/// Sets components of fields of the view: of the working view, of parts that the text omits, and
/// in the text.
fn assign_view(shared: &mut Shared, wanted: &[Wanted]) -> Result<(), Diagnostic> {
    let own = shared.own_camera();
    let parts = own.map_or(0, |own| shared.source().view_literals(&own).len());
    let is_working = |&(at, placed, _): &Wanted| {
        // The picture's size exists only in the text.
        shared.pictures.view.is_some() && at < parts && !placed.field.kind.is_size()
    };
    let (working, written): (Vec<_>, Vec<_>) = wanted.iter().copied().partition(is_working);
    let moved = match shared.pictures.view {
        Some(view) if !working.is_empty() => Some(camera_with(shared, Some(view), &working)?),
        _ => None,
    };
    let edits = edits_of_view(shared, parts, &written)?;
    if !edits.is_empty() {
        try_edits(shared, &edits)?;
    }
    if let Some(moved) = moved {
        let own = shared.own_camera();
        let size = own.map_or(moved.size, |own| own.size);
        shared.pictures.set_view(Camera { size, ..moved }, own);
    }
    Ok(())
}

/// The edits that set fields of the view, of which the first `parts` are those of the camera.
fn edits_of_view(
    shared: &Shared,
    parts: usize,
    wanted: &[Wanted],
) -> Result<Vec<Edit>, Diagnostic> {
    let is_omitted = |(_, placed, _): &Wanted| placed.spans.is_empty();
    if !wanted.iter().any(is_omitted) {
        return Ok(edits_of(shared, &unnumbered(wanted)));
    }
    let is_camera = |wanted: &Wanted| wanted.0 < parts || is_omitted(wanted);
    let (camera, others): (Vec<_>, Vec<_>) = wanted.iter().copied().partition(is_camera);
    let own = shared.own_camera();
    let after = camera_with(shared, own, &camera)?;
    let mut edits = edits_of(shared, &unnumbered(&others));
    edits.extend(own.map_or_else(Vec::new, |own| shared.source().view_edits(&own, &after)));
    Edit::sort(&mut edits);
    Ok(edits)
}

/// A camera with components of fields changed.
fn camera_with(
    shared: &Shared,
    camera: Option<Camera>,
    wanted: &[Wanted],
) -> Result<Camera, Diagnostic> {
    let refuse = |placed: &FieldSpans, reason: &str| {
        let message = format!("view {}: {reason}", placed.field.key);
        Diagnostic::error(Span::at(0), message, placed.field.allowed.words())
    };
    let mut camera = camera.filter(|_| shared.error_count() == 0);
    for &(at, placed, values) in wanted {
        let Some(camera) = &mut camera else {
            return Err(refuse(placed, "cannot be set while the scene has errors"));
        };
        for (component, literal) in values {
            *camera = shared
                .source()
                .view_with(camera, (at, *component), literal)
                .map_err(|limits| refuse(placed, &format!("must be {limits}")))?;
        }
    }
    match (camera, wanted.last()) {
        (Some(camera), Some((_, placed, _))) if camera.eye == camera.target => {
            Err(refuse(placed, "eye and target must differ"))
        }
        (Some(camera), _) => Ok(camera),
        (None, _) => Err(Diagnostic::error(Span::at(0), shared.no_picture(), "")),
    }
}

/// The fields without their indices.
fn unnumbered<'a>(wanted: &[Wanted<'a>]) -> Vec<(&'a FieldSpans, Values)> {
    let own = |&(_, placed, values): &Wanted<'a>| (placed, values.clone());
    wanted.iter().map(own).collect()
}
