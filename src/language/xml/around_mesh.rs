//! A new scene that shows a mesh.

use glam::{BVec3, DVec3};

use super::view::camera_of;
use super::write::{camera, element, light, value, word, xyz};
use geometry::Aabb;
use scene::{Focus, Rgb};

/// The axis of a mesh that points up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Up {
    /// As in most modelling programs.
    Y,
    /// As on the bed of a printer.
    Z,
}

/// What a new scene shows.
#[derive(Clone, Copy, Debug)]
pub struct ShownMesh<'a> {
    /// The name of its file, relative to the scene.
    pub name: &'a str,
    /// The box around it; `None` if it cannot be read.
    pub bounds: Option<Aabb>,
    /// Whether it brings materials of its own.
    pub has_materials: bool,
    /// Its axis that points up.
    pub up: Up,
}

/// The size of the picture in pixels, and the vertical angle of view in degrees.
const SIZE: [u32; 2] = [800, 600];
const ANGLE: f64 = 34.0;

/// The directions from the mesh to the eye and the lamps where z is up, not normalised.
const EYE: DVec3 = DVec3::new(3.0, -7.0, 2.6);
const LAMP: DVec3 = DVec3::new(2.2, -2.0, 3.4);
const WINDOW: DVec3 = DVec3::new(-3.0, -2.4, 1.6);

/// How much of the picture the mesh may fill.
const FILLED: f64 = 0.92;

/// The side of the ground, in radii of the sphere around the mesh.
const GROUND: f64 = 40.0;

/// The sizes of meshes that a view can frame.
const SIZES: std::ops::Range<f64> = 1e-100..1e100;

/// Writes a scene that shows a mesh on a ground, with two lights, ambient light and a view that frames
/// it.
pub fn around_mesh(mesh: &ShownMesh<'_>) -> String {
    let unit = Aabb {
        min: -DVec3::ONE,
        max: DVec3::ONE,
    };
    let fits = |bounds: &Aabb| SIZES.contains(&bounds.half_diagonal());
    let bounds = mesh.bounds.filter(fits).unwrap_or(unit);
    let (centre, radius) = (0.5 * bounds.min + 0.5 * bounds.max, bounds.half_diagonal());
    let round = |place: DVec3| DVec3::from_array(place.to_array().map(|x| rounded(x, radius)));
    let target = round(centre);
    let least = round(bounds.min);
    let least = DVec3::select(least.cmpgt(bounds.min), round(least - step(radius)), least);
    let foot = match mesh.up {
        Up::Y => target.with_y(least.y),
        Up::Z => target.with_z(least.z),
    };
    let eye = round(target + mesh.up.of(EYE).normalize() * distance(mesh.up, &bounds, target));
    let lamp = round(centre + radius * mesh.up.of(LAMP));
    let window = round(centre + radius * mesh.up.of(WINDOW));

    let mut text = String::from(BEGINNING);
    element(&mut text, 4, "object", |text| {
        word(text, "type", "obj");
        word(text, "name", mesh.name);
        if !mesh.has_materials {
            word(text, "material", "clay");
        }
    });
    text.push_str(GROUND_BEGINNING);
    let half = rounded(0.5 * GROUND * radius, radius);
    element(&mut text, 6, "scale", |text| value(text, half));
    if mesh.up == Up::Y {
        text.push_str("      <rotate angle=\"-90\" x=\"1\"/>\n");
    }
    element(&mut text, 6, "translate", |text| xyz(text, foot));
    text.push_str("    </object>\n\n");
    text.push_str(STONE);
    if !mesh.has_materials {
        text.push_str(CLAY);
    }
    text.push_str(LIGHTS);
    for (name, colour, place) in [
        ("lamp", Rgb::new(0.8, 0.74, 0.64), lamp),
        ("window", Rgb::new(0.26, 0.31, 0.4), window),
    ] {
        light(&mut text, "point", Some(name), colour);
        element(&mut text, 6, "position", |text| xyz(text, place));
        text.push_str("    </light>\n");
    }
    text.push_str("  </scene>\n\n");
    let focus = Focus::PINHOLE;
    let [width, height] = SIZE.map(f64::from);
    let numbers = [ANGLE, focus.distance, focus.lens_radius, width, height];
    let view = camera_of([eye, target, mesh.up.axis()], numbers);
    camera(&mut text, &view, ANGLE);
    text.push_str("</xml>\n");
    text
}

const BEGINNING: &str = "\
<xml>
  <scene>
    <background r=\"0.08\" g=\"0.09\" b=\"0.12\"/>
    <environment r=\"0.35\" g=\"0.4\" b=\"0.5\"/>

    <!-- The mesh in its own coordinates. -->
";

const GROUND_BEGINNING: &str = "    <!-- A square of side 2, enlarged and laid under the mesh. -->
    <object type=\"plane\" name=\"ground\" material=\"stone\">
";

const STONE: &str = "    <material type=\"blinn\" name=\"stone\">
      <diffuse r=\"0.42\" g=\"0.44\" b=\"0.5\"/>
      <specular value=\"0.1\"/>
    </material>
";

const CLAY: &str = "    <material type=\"blinn\" name=\"clay\">
      <diffuse r=\"0.75\" g=\"0.28\" b=\"0.16\"/>
      <specular value=\"0.3\"/>
      <glossiness value=\"60\"/>
    </material>
";

const LIGHTS: &str = "
    <light type=\"ambient\" name=\"sky\">
      <intensity r=\"0.14\" g=\"0.16\" b=\"0.19\"/>
    </light>
    <!-- A warm light from the upper right, and a cool one that fills its shadows. -->
";

impl Up {
    /// The unit vector that points up.
    fn axis(self) -> DVec3 {
        self.of(DVec3::Z)
    }

    /// Turns a vector of a space where z is up.
    fn of(self, DVec3 { x, y, z }: DVec3) -> DVec3 {
        match self {
            Self::Y => DVec3::new(x, z, -y),
            Self::Z => DVec3::new(x, y, z),
        }
    }
}

/// The distance at which an eye that looks at a point sees the whole of a box.
fn distance(up: Up, bounds: &Aabb, target: DVec3) -> f64 {
    let back = up.of(EYE).normalize();
    let right = up.axis().cross(back).normalize();
    let above = back.cross(right);
    let [width, height] = SIZE.map(f64::from);
    let slope = FILLED * libm::tan(0.5 * ANGLE.to_radians());
    let corners = (0..8).map(|corner| {
        let is_max = BVec3::new(corner & 1 != 0, corner & 2 != 0, corner & 4 != 0);
        DVec3::select(is_max, bounds.max, bounds.min) - target
    });
    let needed = corners.map(|corner| {
        let aside = (corner.dot(right).abs() * height / width).max(corner.dot(above).abs());
        aside / slope + corner.dot(back)
    });
    needed.fold(0.0, f64::max)
}

/// The digits behind the point that matter at a size.
fn digits(size: f64) -> usize {
    (3.0 - libm::floor(libm::log10(size))).clamp(0.0, 110.0) as usize
}

/// One in the last of these digits.
fn step(size: f64) -> f64 {
    libm::pow(10.0, -(digits(size) as f64))
}

fn rounded(number: f64, size: f64) -> f64 {
    let digits = digits(size);
    format!("{number:.digits$}").parse().unwrap_or(number)
}
