//! New elements of `.xml`.

use glam::DVec3;

use super::Source;
use super::schema::{OBJ, class_of};
use super::tree::escaped;
use crate::schema::Category;
use crate::structure::NewNode;
use crate::view::line_ending;
use crate::{Addition, Node, Placement, SceneText, StructureEdits, StructureError};
use text::Edit;

/// The kinds of things that can be added.
pub(super) const ADDITIONS: &[Addition] = &[
    Addition::new("sphere", "round; scaled, an ellipsoid"),
    Addition::new("plane", "a square that ends at its edges"),
    Addition::of_file("mesh", "triangles from an .obj file"),
    Addition::new("group", "moves and turns the objects in it"),
    Addition::new("point light", "shines in all directions"),
    Addition::new("direct light", "shines from infinitely far away"),
    Addition::new("ambient light", "reaches every surface from everywhere"),
    Addition::new("blinn material", "a highlight around the normal"),
    Addition::new(
        "phong material",
        "a highlight around the reflected direction",
    ),
    Addition::new("microfacet material", "metal or plastic, by roughness"),
];

/// Returns the edits that add a thing.
pub(super) fn addition(
    source: &Source,
    name: &str,
    wish: &NewNode<'_>,
) -> Result<Placement, StructureError> {
    let vector = |name: &str, vector: DVec3| {
        let parts = ["x", "y", "z"].iter().zip(vector.to_array());
        let parts = parts.map(|(part, number)| format!(" {part}=\"{}\"", wish.literal(number)));
        format!("  <{name}{}/>", parts.collect::<String>())
    };
    let above = wish.centre + DVec3::new(0.0, 0.0, 4.0 * wish.half);
    let light = |kind: &str, parts: &[String]| {
        let mut lines = vec![format!("<light type=\"{kind}\" name=\"{kind}\">")];
        lines.extend_from_slice(parts);
        lines.push("</light>".to_owned());
        lines
    };
    let intensity = |value: &str| format!("  <intensity value=\"{value}\"/>");
    let lines = match name {
        "point light" => light("point", &[intensity("1"), vector("position", above)]),
        "direct light" => {
            let down = vector("direction", DVec3::new(1.0, 1.0, -2.0));
            light("direct", &[intensity("0.6"), down])
        }
        "ambient light" => light("ambient", &[intensity("0.2")]),
        "blinn material" => material("blinn", "blinn"),
        "phong material" => material("phong", "phong"),
        "microfacet material" => vec![
            "<material type=\"microfacet\" name=\"microfacet\">".to_owned(),
            "  <color r=\"0.8\" g=\"0.8\" b=\"0.8\"/>".to_owned(),
            "  <roughness value=\"0.4\"/>".to_owned(),
            "</material>".to_owned(),
        ],
        _ => source.object(name, wish, &vector),
    };
    let text = lines.join(line_ending(&source.text));
    let needs_material =
        matches!(name, "sphere" | "plane") && source.origins.of(Category::Material).is_empty();
    let placement = source.insertion(&text, wish.after)?;
    if !needs_material {
        return Ok(placement);
    }
    let material = material("blinn", "blinn").join(line_ending(&source.text));
    let mut both = source.insertion(&material, Node::View)?;
    let own = placement.edits;
    if both.edits[0].span == own[0].span {
        return source.insertion(
            &[material, text].join(line_ending(&source.text)),
            wish.after,
        );
    }
    both.edits.extend(own);
    Edit::sort(&mut both.edits);
    Ok(both)
}

/// A plain grey material.
pub(super) fn material(kind: &str, name: &str) -> Vec<String> {
    let name = escaped(name, '"');
    vec![
        format!("<material type=\"{kind}\" name=\"{name}\">"),
        "  <diffuse r=\"0.7\" g=\"0.7\" b=\"0.7\"/>".to_owned(),
        "  <specular value=\"0.3\"/>".to_owned(),
        "</material>".to_owned(),
    ]
}

/// The words for the kinds that a node can be changed to.
pub(super) fn kinds(node: Node) -> Vec<&'static str> {
    let class = node.category().and_then(|(category, _)| class_of(category));
    let kinds = class.map_or(&[][..], |class| class.kinds).iter();
    // A mesh is named by its file, which nothing else has.
    kinds
        .map(|kind| kind.word)
        .filter(|word| *word != OBJ.word)
        .collect()
}

/// Returns the edits that change a node's type; its elements stay.
pub(super) fn retyping(
    source: &Source,
    node: Node,
    kind: &str,
) -> Result<Vec<Edit>, StructureError> {
    let fields = source.fields(node);
    let field = fields.iter().find(|placed| placed.field.key == "type");
    let fixed = || StructureError::Inexpressible(format!("{} has no type", source.name(node)));
    let field = field.ok_or_else(fixed)?;
    Ok(field.edits(source, &[(0, kind.to_owned())]))
}

impl Source {
    /// The lines of a new object, in the space of the group that it comes to stand in.
    fn object(
        &self,
        name: &str,
        wish: &NewNode<'_>,
        vector: &dyn Fn(&str, DVec3) -> String,
    ) -> Vec<String> {
        let beside = match wish.after {
            Node::Object(_) => self.element(wish.after),
            _ => None,
        };
        let inside = beside.map(|element| self.outside(element).inverse());
        let (centre, size) = match inside {
            Some(inside) => {
                let size = libm::cbrt(inside.matrix3.determinant().abs());
                (inside.transform_point3(wish.centre), size * wish.half)
            }
            None => (wish.centre, wish.half),
        };
        let selected = match wish.after {
            Node::Material(index) => Some(index),
            Node::Object(index) => self.material(index),
            _ => None,
        };
        let material = self
            .origins
            .of(Category::Material)
            .get(selected.unwrap_or(0));
        let material = material.map_or(Some("blinn"), |place| place.name.as_deref());
        let material = material.filter(|_| matches!(name, "sphere" | "plane"));
        let material = material.map(|name| format!(" material=\"{}\"", escaped(name, '"')));
        let material = material.unwrap_or_default();
        let head = match name {
            "group" => "<object name=\"group\">".to_owned(),
            "mesh" => {
                let file = escaped(wish.file.unwrap_or("mesh.obj"), '"');
                format!("<object type=\"obj\" name=\"{file}\">")
            }
            kind => format!("<object type=\"{kind}\" name=\"{kind}\"{material}>"),
        };
        let scale =
            (name != "group").then(|| format!("  <scale value=\"{}\"/>", wish.literal(size)));
        let mut lines = vec![head];
        lines.extend(scale);
        lines.push(vector("translate", centre));
        lines.push("</object>".to_owned());
        lines
    }
}
