//! What the picture shows at a pixel.

use super::inspecting::{cross, line_of, node_at};
use crate::app::Shared;
use crate::msg::Target;
use language::Node;
use render::{Aov, FirstHit};
use scene::Size;

/// What is known of a pixel of the picture on screen.
#[derive(Clone, Debug, PartialEq)]
pub struct Pixel {
    /// Its column and row.
    pub at: [u32; 2],
    /// The size of the picture.
    pub size: Size,
    /// The pixel of the output at its place, and the size of that, if the picture has another size.
    pub output: Option<([u32; 2], Size)>,
    /// The object there, or why it is not known.
    pub node: Result<Option<Node>, &'static str>,
    /// The material of the object, if it has a name.
    pub material: Option<Node>,
    /// The line of the text on which the object begins.
    pub line: Option<usize>,
    /// What the picture shows instead of light.
    pub aov: Option<Aov>,
    /// The linear radiance, or the value of the AOV.
    pub value: Option<[f32; 3]>,
    /// The colour as exported.
    pub colour: Option<[u8; 3]>,
    /// Samples so far.
    pub samples: u32,
    /// The estimated error of the colour, 0 to 1.
    pub error: Option<f32>,
    /// The first surface under the centre of the pixel; `None` while the scene is being prepared.
    pub first: Option<FirstHit>,
}

/// What is known of the pixel under the cross.
pub(crate) fn pixel(shared: &Shared) -> Option<Pixel> {
    let cross = cross(shared)?;
    let output = shared.output();
    let node = node_at(shared, cross.pixel);
    let object = match node {
        Ok(Some(Node::Object(object))) => Some(object),
        _ => None,
    };
    let frame = shared.picture().latest.as_deref();
    let index = frame.and_then(|frame| frame.index_of(cross.pixel));
    let query = frame.and_then(|frame| frame.query.as_ref());
    let of = |list: &[[f32; 3]]| list.get(index?).copied();
    Some(Pixel {
        at: cross.pixel,
        size: cross.size,
        output: (cross.size != output).then(|| (cross.in_size(output).pixel, output)),
        node,
        material: object
            .and_then(|object| shared.source().material(object))
            .map(Node::Material),
        line: object.map(|object| line_of(shared, Node::Object(object))),
        aov: match shared.seen() {
            Target::Preview => shared.pictures.preview_aov(),
            _ => shared.pictures.aov,
        },
        value: frame.and_then(|frame| of(&frame.values)),
        colour: frame.and_then(|frame| frame.pixels.get(index?).copied()),
        samples: frame.map_or(0, |frame| frame.progress.spp),
        error: frame.and_then(|frame| frame.errors.get(index?).copied()),
        first: query.and_then(|query| query.first_hit(cross.pixel)),
    })
}
