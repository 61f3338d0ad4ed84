//! New records of `.dat`, and objects of another kind.

use glam::DVec3;

use super::schema::{CSG, QUADRIC, SCHEMA, USE_COLOUR};
use super::{Source, quadric};
use crate::engine::motion::{Moves, numbers_of};
use crate::form::Form;
use crate::schema::Category;
use crate::spelling::rounded_off;
use crate::structure::{NewNode, number};
use crate::view::spelled;
use crate::{Addition, Node, Placement, SceneText, StructureEdits, StructureError};
use text::{Edit, Span};

/// The kinds of things that can be added.
pub(super) const ADDITIONS: &[Addition] = &[
    Addition::new("sphere", "round, by centre and radius"),
    Addition::new("ellipsoid", "a sphere stretched along the axes"),
    Addition::new("cylinder", "round and closed, about any axis"),
    Addition::new("box", "six faces, in any directions"),
    Addition::new("quadric", "any surface of second degree, cut by planes"),
    Addition::new("union", "two marked objects together"),
    Addition::new("intersection", "what two marked objects share"),
    Addition::new("difference", "the first marked object without the second"),
    Addition::new("point light", "shines in all directions"),
    Addition::new("spot light", "shines in a cone, downwards"),
    Addition::new("distant light", "shines from infinitely far away"),
    Addition::new("ambient light", "reaches every surface from everywhere"),
    Addition::new("material", "colour, gloss, reflection and transparency"),
    Addition::new(
        "checker texture",
        "two colours, used by the selected material",
    ),
    Addition::new(
        "image texture",
        "a picture file, used by the selected material",
    ),
];

/// A plain grey.
const MATERIAL: &str = "mat ID 1  0.8 0.8 0.8  0.2 0.7 0.3 20  0 0 1";
/// Grey squares.
const CHECKER: &str = "texture ID 1 checker 8 8  0.8 0.8 0.8  0.2 0.2 0.2";

/// Returns the edits that add a thing.
pub(super) fn addition(
    source: &Source,
    name: &str,
    wish: &NewNode<'_>,
) -> Result<Placement, StructureError> {
    let above = wish.centre + DVec3::new(0.0, 0.0, 4.0 * wish.half);
    let above = above
        .to_array()
        .map(|number| wish.literal(number))
        .join(" ");
    let text = match name {
        "union" | "intersection" | "difference" => return combination(source, name, wish),
        "point light" => format!("light ID 1 pnt  {above}  0 0 0  1 1 1  1 0 0  0 shadow_on"),
        "spot light" => format!("light ID 1 pnt  {above}  0 0 -1  1 1 1  1 0 0  10 shadow_on"),
        "distant light" => {
            "light ID 1 inf  0 0 0  0.5 1 -1  0.5 0.5 0.5  1 0 0  0 shadow_on".to_owned()
        }
        "ambient light" => {
            "light ID 1 amb  0 0 0  0 0 0  0.5 0.5 0.5  1 0 0  0 shadow_off".to_owned()
        }
        "checker texture" => used(source, CHECKER, wish),
        "image texture" => used(source, "texture ID 1 image 1 1 picture.png", wish),
        "material" => MATERIAL.to_owned(),
        _ => solid(source, name, wish)?,
    };
    source.insertion(&text, wish.after)
}

/// The record of a plain node with an ID; `None` if a category has none.
pub(super) fn plain(category: Category, id: i64) -> Option<String> {
    let record = match category {
        Category::Material => MATERIAL,
        Category::Texture => CHECKER,
        Category::Light | Category::Object => return None,
    };
    Some(record.replacen("ID 1", &format!("ID {id}"), 1))
}

/// Returns the edits that make an object one of another kind, of this form.
pub(super) fn respelled(
    source: &Source,
    index: usize,
    kind: &str,
    form: &Form,
) -> Result<Vec<Edit>, StructureError> {
    let shapeless =
        || StructureError::Inexpressible("it has no size that another type could use".to_owned());
    let numbers = source.object_numbers(index).ok_or_else(shapeless)?;
    let literals = literals(kind, form, &|number| spelled(rounded_off(number)))?;
    let record = source.span(Node::Object(index));
    let mut tokens = source
        .tree
        .tokens(&source.text, source.origins.objects()[index].at);
    let keyword = tokens.nth(1).unwrap_or_else(|| Span::at(record.start()));
    let shape = numbers.spans[1].to(Span::at(record.end()));
    let edit = |span, text| Edit { span, text };
    Ok(vec![edit(keyword, kind.to_owned()), edit(shape, literals)])
}

/// The numbers of an object of a kind after its material, as text.
fn literals(
    kind: &str,
    form: &Form,
    literal: &dyn Fn(f64) -> String,
) -> Result<String, StructureError> {
    let solid = SCHEMA.solids().find(|record| record.name == kind);
    let record = solid.unwrap_or(&QUADRIC);
    let mut numbers = numbers_of(&SCHEMA, record, form)?;
    if record.layout.is_none() {
        quadric::put(form, &mut numbers);
    }
    let mut rest = &numbers[1..];
    let groups = record.fields().skip(1).map(|field| {
        let own = crate::view::take(&mut rest, field);
        let own: Vec<_> = own.iter().map(|&number| literal(number)).collect();
        own.join(" ")
    });
    let groups: Vec<_> = groups.collect();
    Ok(match record.layout {
        Some(_) => groups.join("  "),
        None => format!("{}  0", groups.join(" ")),
    })
}

/// The edits that make a light one of another kind, which keeps its numbers. A distant light
/// that has neither a direction nor a position shines down.
pub(super) fn light_as(source: &Source, light: Node, kind: &str) -> Vec<Edit> {
    let fields = source.fields(light);
    let spans = |key: &str| {
        let field = fields.iter().find(|placed| placed.field.key == key);
        field.map_or(&[][..], |placed| &placed.spans)
    };
    let is_zero = |key| {
        spans(key)
            .iter()
            .all(|span| number(&source.text, *span) == 0.0)
    };
    let mut wanted = vec![(spans("source").first(), kind)];
    if kind == "inf" && is_zero("direction") && is_zero("position") {
        wanted.push((spans("direction").get(2), "-1"));
    }
    let edit = |(span, text): (Option<&Span>, &str)| {
        Some(Edit {
            span: *span?,
            text: text.to_owned(),
        })
    };
    wanted.into_iter().filter_map(edit).collect()
}

/// The records of a new solid, with a material if there is none.
fn solid(source: &Source, kind: &str, wish: &NewNode<'_>) -> Result<String, StructureError> {
    let form = Form::upright(wish.centre, wish.half, wish.up);
    // Coefficients cancel each other far from the origin; only what rounding added is left out.
    let precise = |number: f64| {
        let rounded = format!("{number:.12e}").parse().unwrap_or(number);
        (rounded + 0.0).to_string()
    };
    let rounded = |number: f64| wish.literal(number);
    let is_quadric = kind == QUADRIC.name;
    let literal: &dyn Fn(f64) -> String = if is_quadric { &precise } else { &rounded };
    let literals = literals(kind, &form, literal)?;
    let selected = match wish.after {
        Node::Material(index) => Some(index),
        Node::Object(index) => material_in(source, index),
        _ => None,
    };
    let materials = source.origins.of(Category::Material);
    let (before, id) = match materials.get(selected.unwrap_or(0)) {
        Some(place) => (String::new(), place.id),
        None => (format!("{MATERIAL}\n"), 1),
    };
    Ok(format!("{before}obj {kind} ID 1 mat ID {id}  {literals}"))
}

/// The material of an object, or that of the first part of a combination that has one.
fn material_in(source: &Source, index: usize) -> Option<usize> {
    let parts = source.parts(index, usize::MAX).into_iter();
    let parts = parts.filter_map(|(_, part)| part.category());
    let mut all = std::iter::once(index).chain(parts.map(|(_, part)| part));
    all.find_map(|object| source.material(object))
}

/// The edits that combine the two marked objects.
fn combination(
    source: &Source,
    operation: &str,
    wish: &NewNode<'_>,
) -> Result<Placement, StructureError> {
    let objects = wish
        .marked
        .iter()
        .filter(|node| matches!(node, Node::Object(_)));
    let ids = objects.filter_map(|&node| Some(source.origins.get(node)?.id));
    let ids: Vec<_> = ids.collect();
    let [first, second] = ids[..] else {
        let reason = format!("a {operation} combines two objects: mark them first");
        return Err(StructureError::Inexpressible(reason));
    };
    let record = format!("obj {} ID 1 {operation} ID {first} ID {second}", CSG.name);
    source.inserted(&record, wish.after, &ids)
}

/// The record of a texture, and its use by the selected material if that has none.
fn used(source: &Source, texture: &str, wish: &NewNode<'_>) -> String {
    let mut uses = source.origins.uses.iter();
    let is_used = uses.any(|at| *at.record == USE_COLOUR && at.user() == Some(wish.after));
    match source.origins.get(wish.after) {
        Some(material) if !is_used && matches!(wish.after, Node::Material(_)) => {
            format!("{texture}\nuse colour ID 1 mat ID {}", material.id)
        }
        _ => texture.to_owned(),
    }
}
