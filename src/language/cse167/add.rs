//! New spheres and lights of `.test`.

use glam::DVec3;

use super::Source;
use super::motion::is_similar;
use super::schema::DIRECTIONAL;
use crate::structure::{NewNode, lines_after, number};
use crate::view::line_ending;
use crate::words::Words;
use crate::{Addition, Node, Placement, SceneText, StructureEdits, StructureError};
use text::{Edit, Span};

/// The kinds of things that can be added.
pub(super) const ADDITIONS: &[Addition] = &[
    Addition::new(
        "sphere",
        "round, in the material and the transforms that hold there",
    ),
    Addition::new("point light", "shines in all directions"),
    Addition::new("directional light", "shines from infinitely far away"),
];

/// Returns the edits that add a thing.
pub(super) fn addition(
    source: &Source,
    name: &str,
    wish: &NewNode<'_>,
) -> Result<Placement, StructureError> {
    let own = &source.origins.own;
    let numbers = |point: DVec3| {
        point
            .to_array()
            .map(|number| wish.literal(number))
            .join(" ")
    };
    if name == "directional light" {
        return source.insertion("directional 0.5 1 1  0.5 0.5 0.5", wish.after);
    }
    if name == "point light" {
        let selected = match wish.after {
            Node::Light(index) => own.lights.get(index),
            _ => own.lights.last(),
        };
        let transform = selected.copied().unwrap_or(own.end);
        let above = wish.centre + DVec3::new(0.0, 4.0 * wish.half, 0.0);
        let place = numbers(transform.inverse().transform_point3(above));
        return source.insertion(&format!("point {place}  1 1 1"), wish.after);
    }
    // A sphere stands behind the selected object if nothing stretches it there, otherwise at the end,
    // behind all pushes that are open.
    let selected = match wish.after {
        Node::Object(index) => own
            .objects
            .get(index)
            .filter(|at| is_similar(&at.transform)),
        _ => None,
    };
    let transform = selected.map_or(own.end, |selected| selected.transform);
    let centre = numbers(transform.inverse().transform_point3(wish.centre));
    let size = libm::cbrt(transform.matrix3.determinant().abs());
    let sphere = format!("sphere {centre}  {}", wish.literal(wish.half / size));
    let last = source.tree.records.len().checked_sub(1);
    match last.filter(|_| selected.is_none()) {
        Some(last) => {
            let block = source.block_span(last);
            let pops = format!("popTransform{}", line_ending(&source.text)).repeat(own.open);
            let edits = vec![lines_after(&source.text, block, &format!("{pops}{sphere}"))];
            Ok(Placement { edits, at: 0 })
        }
        None => source.insertion(&sphere, wish.after),
    }
}

impl Source {
    /// The edits that make a light one of another kind, which keeps its numbers: it shines from the side
    /// of the origin that it stood on, a light at the origin from above.
    pub(super) fn light_as(&self, light: Node, kind: &str) -> Vec<Edit> {
        let edit = |span, text: &str| Edit {
            span,
            text: text.to_owned(),
        };
        let start = self.span(light).start();
        let head = Words::new(&self.text, self.span(light)).next();
        let mut edits = vec![edit(head.unwrap_or_else(|| Span::at(start)), kind)];
        let fields = self.fields(light);
        let place = fields.first().map_or(&[][..], |placed| &placed.spans);
        let is_zero = place.iter().all(|span| number(&self.text, *span) == 0.0);
        if let Some(height) = place.get(1).filter(|_| kind == DIRECTIONAL.name && is_zero) {
            edits.push(edit(*height, "1"));
        }
        edits
    }
}
