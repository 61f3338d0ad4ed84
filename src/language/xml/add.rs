//! New elements of `.xml`.

use glam::{DAffine3, DVec3};

use super::Source;
use super::tree::escaped;
use crate::schema::Category;
use crate::structure::NewNode;
use crate::view::line_ending;
use crate::{Addition, Node, Placement, SceneText, StructureEdits, StructureError};
use text::Edit;

/// The kinds of things that can be added.
pub(super) const ADDITIONS: &[Addition] = &[
    Addition::new("sphere", "round; scaled, an ellipsoid"),
    Addition::flat("plane", "a square that ends at its edges"),
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
        format!("{name}{}", parts.collect::<String>())
    };
    let above = wish.centre + DVec3::new(0.0, 0.0, 4.0 * wish.half);
    let light = |kind, parts: &[&str]| element("light", &named(kind, kind), parts);
    let text = match name {
        "point light" => {
            let position = vector("position", above);
            light("point", &["intensity value=\"1\"", &position])
        }
        "direct light" => {
            let down = vector("direction", DVec3::new(1.0, 1.0, -2.0));
            light("direct", &["intensity value=\"0.6\"", &down])
        }
        "ambient light" => light("ambient", &["intensity value=\"0.2\""]),
        "blinn material" => material("blinn", "blinn"),
        "phong material" => material("phong", "phong"),
        "microfacet material" => element(
            "material",
            &named("microfacet", "microfacet"),
            &[
                "color r=\"0.8\" g=\"0.8\" b=\"0.8\"",
                "roughness value=\"0.4\"",
            ],
        ),
        _ => source.object(name, wish, &vector),
    };
    let ending = line_ending(&source.text);
    let text = text.replace('\n', ending);
    let needs_material =
        matches!(name, "sphere" | "plane") && source.origins.of(Category::Material).is_empty();
    let placement = source.insertion(&text, wish.after)?;
    if !needs_material {
        return Ok(placement);
    }
    let material = material("blinn", "blinn").replace('\n', ending);
    let mut both = source.insertion(&material, Node::View)?;
    let own = placement.edits;
    if both.edits[0].span == own[0].span {
        return source.insertion(&[material, text].join(ending), wish.after);
    }
    both.edits.extend(own);
    Edit::sort(&mut both.edits);
    Ok(both)
}

/// A plain grey material.
pub(super) fn material(kind: &str, name: &str) -> String {
    let parts = [
        "diffuse r=\"0.7\" g=\"0.7\" b=\"0.7\"",
        "specular value=\"0.3\"",
    ];
    element("material", &named(kind, name), &parts)
}

/// An element with these attributes and empty elements in it.
fn element(name: &str, attributes: &str, parts: &[&str]) -> String {
    let lines = parts.iter().flat_map(|part| ["  <", part, "/>\n"]);
    let parts: String = lines.collect();
    format!("<{name}{attributes}>\n{parts}</{name}>")
}

/// The attributes of a thing of a kind with a name.
fn named(kind: &str, name: &str) -> String {
    format!(" type=\"{kind}\" name=\"{}\"", escaped(name, '"'))
}

impl Source {
    /// A new object, in the space of the group that it comes to stand in.
    fn object(
        &self,
        name: &str,
        wish: &NewNode<'_>,
        vector: &dyn Fn(&str, DVec3) -> String,
    ) -> String {
        let beside = match wish.after {
            Node::Object(_) => self.element(wish.after),
            _ => None,
        };
        let inside = beside.map_or(DAffine3::IDENTITY, |element| {
            self.outside(element).inverse()
        });
        let size = libm::cbrt(inside.matrix3.determinant().abs()) * wish.half;
        let scale = format!("scale value=\"{}\"", wish.literal(size));
        let translate = vector("translate", inside.transform_point3(wish.centre));
        let selected = match wish.after {
            Node::Material(index) => Some(index),
            Node::Object(index) => self.material(index),
            _ => None,
        };
        let materials = self.origins.of(Category::Material);
        let material = materials.get(selected.unwrap_or(0));
        let material = material.map_or(Some("blinn"), |place| place.name.as_deref());
        let material = material.map(|name| format!(" material=\"{}\"", escaped(name, '"')));
        let attributes = match name {
            "group" => return element("object", " name=\"group\"", &[&translate]),
            "mesh" => named("obj", wish.file.unwrap_or("mesh.obj")),
            kind => named(kind, kind) + &material.unwrap_or_default(),
        };
        element("object", &attributes, &[&scale, &translate])
    }
}
