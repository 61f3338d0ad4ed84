//! New records of `.dat`, and objects of another kind.

use glam::DVec3;

use super::Source;
use super::form::{form, put};
use super::table::{ObjectKind, RecordKind, UseKind};
use crate::form::Form;
use crate::spelling::rounded_off;
use crate::structure::{NewNode, number};
use crate::table::Category;
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

/// The kinds of solids that a record can change to.
pub(super) const SOLIDS: [ObjectKind; 5] = [
    ObjectKind::Sphere,
    ObjectKind::Ellipsoid,
    ObjectKind::Cylinder,
    ObjectKind::Box,
    ObjectKind::Quadric,
];

/// Returns the edits that add a thing.
pub(super) fn addition(
    source: &Source,
    name: &str,
    wish: &NewNode<'_>,
) -> Result<Placement, StructureError> {
    let place = |point: DVec3| {
        let numbers = point.to_array().map(|number| wish.literal(number));
        numbers.join(" ")
    };
    let above = place(wish.centre + DVec3::new(0.0, 0.0, 4.0 * wish.half));
    let solid = SOLIDS.into_iter().find(|kind| kind.keyword() == name);
    let text = match (name, solid) {
        (_, Some(kind)) => source.solid(kind, wish)?,
        ("union" | "intersection" | "difference", _) => return source.combination(name, wish),
        ("point light", _) => {
            format!("light ID 1 pnt  {above}  0 0 0  1 1 1  1 0 0  0 shadow_on")
        }
        ("spot light", _) => {
            format!("light ID 1 pnt  {above}  0 0 -1  1 1 1  1 0 0  10 shadow_on")
        }
        ("distant light", _) => {
            "light ID 1 inf  0 0 0  0.5 1 -1  0.5 0.5 0.5  1 0 0  0 shadow_on".to_owned()
        }
        ("ambient light", _) => {
            "light ID 1 amb  0 0 0  0 0 0  0.5 0.5 0.5  1 0 0  0 shadow_off".to_owned()
        }
        ("checker texture", _) => source.used(CHECKER, wish),
        ("image texture", _) => source.used("texture ID 1 image 1 1 picture.png", wish),
        _ => MATERIAL.to_owned(),
    };
    source.insertion(&text, wish.after)
}

/// A plain grey.
const MATERIAL: &str = "mat ID 1  0.8 0.8 0.8  0.2 0.7 0.3 20  0 0 1";
/// Grey squares.
const CHECKER: &str = "texture ID 1 checker 8 8  0.8 0.8 0.8  0.2 0.2 0.2";

/// The record of a plain node with an ID; `None` if a category has none.
pub(super) fn plain(category: Category, id: i64) -> Option<String> {
    let record = match category {
        Category::Material => MATERIAL,
        Category::Texture => CHECKER,
        Category::Light | Category::Object => return None,
    };
    Some(record.replacen("ID 1", &format!("ID {id}"), 1))
}

/// Returns the edits that change an object to another kind.
pub(super) fn retyping(
    source: &Source,
    node: Node,
    kind: &str,
) -> Result<Vec<Edit>, StructureError> {
    let refused = |reason: &str| StructureError::Inexpressible(reason.to_owned());
    if let Node::Light(_) = node {
        return Ok(source.light_as(node, kind));
    }
    let Node::Object(index) = node else {
        return Err(refused("only solids and lights can change their type"));
    };
    let new = SOLIDS.into_iter().find(|solid| solid.keyword() == kind);
    let new = new.ok_or_else(|| refused("only solids and lights can change their type"))?;
    let shapeless = || refused("it has no size that another type could use");
    let (old, _, numbers) = source.object_numbers(index).ok_or_else(shapeless)?;
    let form = form(old, &numbers).ok_or_else(shapeless)?;
    respelled(source, index, new, &nearest(new, &form))
}

/// Returns the edits that make an object one of another kind, of this form.
pub(super) fn respelled(
    source: &Source,
    index: usize,
    new: ObjectKind,
    form: &Form,
) -> Result<Vec<Edit>, StructureError> {
    let shapeless =
        || StructureError::Inexpressible("it has no size that another type could use".to_owned());
    let (_, spans, _) = source.object_numbers(index).ok_or_else(shapeless)?;
    let literals = literals(new, form, &|number| spelled(rounded_off(number)))?;
    let record = source.span(Node::Object(index));
    let mut tokens = source
        .tree
        .tokens_of(&source.text, source.origins.objects[index].record);
    let keyword = tokens.nth(1).unwrap_or_else(|| Span::at(record.start()));
    let shape = spans[1].to(Span::at(record.end()));
    Ok(vec![
        Edit {
            span: keyword,
            text: new.keyword().to_owned(),
        },
        Edit {
            span: shape,
            text: literals,
        },
    ])
}

/// The form that a kind takes instead of one that it cannot take.
fn nearest(kind: ObjectKind, form: &Form) -> Form {
    let [a, b, c] = form.half;
    match kind {
        ObjectKind::Sphere => Form {
            half: [libm::cbrt(a * b * c); 3],
            ..*form
        },
        ObjectKind::Ellipsoid => Form {
            axes: DVec3::AXES,
            half: form.aligned(),
            ..*form
        },
        ObjectKind::Cylinder => Form {
            half: [0.5 * (a + b), 0.5 * (a + b), c],
            ..*form
        },
        ObjectKind::Box | ObjectKind::Quadric | ObjectKind::Csg => *form,
    }
}

/// The numbers of a solid after its material, as text.
fn literals(
    kind: ObjectKind,
    form: &Form,
    literal: &dyn Fn(f64) -> String,
) -> Result<String, StructureError> {
    let mut numbers = vec![0.0; RecordKind::Object(kind).numbers()];
    let refused = |reason: &str| StructureError::Inexpressible(reason.to_owned());
    put(kind, form, &mut numbers).map_err(refused)?;
    let mut rest = &numbers[1..];
    let fields = RecordKind::Object(kind).fields().skip(1);
    let groups = fields.map(|field| {
        let (own, behind) = rest.split_at(field.kind.components());
        rest = behind;
        let own: Vec<_> = own.iter().map(|&number| literal(number)).collect();
        own.join(" ")
    });
    let groups: Vec<_> = groups.collect();
    let cuts = if kind == ObjectKind::Quadric {
        "  0"
    } else {
        ""
    };
    let between = if kind == ObjectKind::Quadric {
        " "
    } else {
        "  "
    };
    Ok(format!("{}{cuts}", groups.join(between)))
}

impl Source {
    /// The edits that make a light one of another kind, which keeps its numbers. A distant light
    /// that has neither a direction nor a position shines down.
    fn light_as(&self, node: Node, kind: &str) -> Vec<Edit> {
        let fields = self.fields(node);
        let spans = |key: &str| {
            let field = fields.iter().find(|placed| placed.field.key == key);
            field.map_or(&[][..], |placed| &placed.spans)
        };
        let is_zero = |key| {
            spans(key)
                .iter()
                .all(|span| number(&self.text, *span) == 0.0)
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
    fn solid(&self, kind: ObjectKind, wish: &NewNode<'_>) -> Result<String, StructureError> {
        let form = Form::upright(wish.centre, wish.half, DVec3::Z);
        // Coefficients cancel each other far from the origin; only what rounding added is left out.
        let precise = |number: f64| {
            let rounded = format!("{number:.12e}").parse();
            rounded
                .map_or(number, |rounded: f64| rounded + 0.0)
                .to_string()
        };
        let literals = match kind {
            ObjectKind::Quadric => literals(kind, &form, &precise)?,
            _ => literals(kind, &form, &|number| wish.literal(number))?,
        };
        let selected = match wish.after {
            Node::Material(index) => Some(index),
            Node::Object(index) => self.material_in(index),
            _ => None,
        };
        let material = self.origins.materials.get(selected.unwrap_or(0));
        let (before, id) = match material {
            Some(place) => (String::new(), place.id),
            None => (format!("{MATERIAL}\n"), 1),
        };
        let keyword = kind.keyword();
        Ok(format!(
            "{before}obj {keyword} ID 1 mat ID {id}  {literals}"
        ))
    }

    /// The material of an object, or that of the first part of a combination that has one.
    fn material_in(&self, index: usize) -> Option<usize> {
        let parts = self.parts(index, usize::MAX).into_iter();
        let of_part = |(_, part)| match part {
            Node::Object(part) => self.material(part),
            _ => None,
        };
        let mut parts = parts.filter_map(of_part);
        self.material(index).or_else(|| parts.next())
    }

    /// The edits that combine the two marked objects.
    fn combination(
        &self,
        operation: &str,
        wish: &NewNode<'_>,
    ) -> Result<Placement, StructureError> {
        let objects = wish.marked.iter().filter_map(|&node| match node {
            Node::Object(index) => Some(self.origins.objects.get(index)?.id),
            _ => None,
        });
        if let parts @ [first, second] = objects.collect::<Vec<_>>().as_slice() {
            let record = format!("obj CSG ID 1 {operation} ID {first} ID {second}");
            self.inserted(&record, wish.after, parts)
        } else {
            let reason = format!("a {operation} combines two objects: mark them first");
            Err(StructureError::Inexpressible(reason))
        }
    }

    /// The record of a texture, and its use by the selected material if that has none.
    fn used(&self, texture: &str, wish: &NewNode<'_>) -> String {
        let Node::Material(index) = wish.after else {
            return texture.to_owned();
        };
        let colour = RecordKind::Use(UseKind::Colour);
        let mut uses = self.origins.uses.iter();
        if uses.any(|at| at.material == index && at.kind == colour) {
            return texture.to_owned();
        }
        let material = self
            .origins
            .materials
            .get(index)
            .map_or(1, |place| place.id);
        format!("{texture}\nuse colour ID 1 mat ID {material}")
    }
}
