//! Objects that the text has at a pixel but the picture does not.

use super::names::{Names, number};
use super::{Sentence, Subject};
use language::{Node, Visibility};
use render::{Explanation, surface_under};
use scene::Meshes;

/// Objects looked at: more than a person has left out of a list.
const MOST: usize = 1000;

/// The nearest object that is not drawn but would be seen at the pixel.
pub(super) fn undrawn(
    explanation: &Explanation,
    subject: &Subject<'_>,
    names: &Names<'_>,
) -> Option<Sentence> {
    let source = subject.source;
    let first = explanation.rays.first().and_then(|ray| ray.shading());
    // What a drawn object combines is drawn as a part of it; where nothing is seen, that part was
    // left out.
    let is_left_out = |&object: &usize| {
        source.drawn(object).is_none()
            && !source.is_group(object)
            && (source.group_of(object).is_none() || first.is_none())
    };
    let left_out: Vec<_> = (0..source.nodes().objects())
        .filter(is_left_out)
        .take(MOST)
        .collect();
    if left_out.is_empty() {
        return None;
    }
    let edits = source.visibility_edits(&left_out, Visibility::Shown).ok()?;
    let mut all = source.clone();
    all.change(&edits);
    // Only a language without meshes leaves objects out.
    let scene = all.lower(&Meshes::default()).ok()?.scene?;
    let eye = subject.camera.eye;
    let seen = left_out.into_iter().filter_map(|object| {
        let drawn = scene.objects.get(all.drawn(object)? as usize)?;
        let under = surface_under(drawn, subject.camera, subject.size, explanation.pixel)?;
        Some((under.point.distance(eye), object))
    });
    let (distance, object) = seen.min_by(|(a, _), (b, _)| a.total_cmp(b))?;
    let shown = first.map_or(f64::INFINITY, |shading| shading.hit.point.distance(eye));
    (distance < shown).then(|| {
        let node = Node::Object(object);
        let reason = match source.group_of(object) {
            Some(whole) => {
                let whole = names.node(Node::Object(whole));
                format!("{whole} does not include this part of it")
            }
            None => "it is not drawn".to_owned(),
        };
        Sentence {
            name: "not-drawn",
            text: format!(
                "{} is here, {} from the eye, but {reason}",
                names.node(node),
                number(distance)
            ),
            help: Some("add it to the `render` record".to_owned()),
            node: Some(node),
            place: names.place(node),
            ray: 0,
        }
    })
}
