//! Writes any scene as a `.test` text.

use std::fmt::Write;

use glam::{DMat3, DVec3};

use crate::approximations::solids;
use crate::frame::aligned;
use crate::losses::{Loss, Losses, Of};
use crate::rendering::words;
use crate::spelling::{number, numbers, vector};
use crate::surroundings::{SHADOWLESS, SIZE, SPOT, angle, report_plain};
use geometry::{FrameNumbers, Instance, Shape, Solid};
use scene::{Emitter, Falloff, Gloss, Highlight, Light, Material, Rendering, Rgb, Scene, Shadows};

const LOBE: Loss = Loss {
    keys: &["specular", "Ks", "ks", "ns", "glossiness", "roughness"],
    lost: "a highlight of another kind",
    instead: "written as one around the half vector",
};

const MIRROR: Loss = Loss {
    keys: &["reflection", "Kr", "kr", "specular", "Ks", "ks"],
    lost: "a mirror of another strength than the highlight",
    instead: "written as a mirror as strong as the highlight",
};

const GLASS: Loss = Loss {
    keys: &["refraction", "transmittance", "Kt", "kt"],
    lost: "transparency",
    instead: "written as opaque",
};

const TEXTURED: Loss = Loss {
    keys: &["diffuse", "color"],
    lost: "textures",
    instead: "written in its plain colour",
};

const BOX: Loss = Loss {
    keys: &[],
    lost: "a box",
    instead: "written as triangles, which enclose no solid: the same except for rounding and glass",
};

const ROUND: Loss = Loss {
    keys: &[],
    lost: "a cylinder or a cone",
    instead: "written as triangles",
};

/// The number of flat sides that stand for a round one.
const SIDES: usize = 64;

/// Writes a scene and reports what it loses.
pub(crate) fn write(scene: &Scene, losses: &mut Losses<'_>) -> String {
    report_plain(scene, losses);
    let mut text = String::new();
    let camera = &scene.camera;
    // The depth has a command of its own.
    let settings = words(&Rendering {
        depth: None,
        ..scene.setting.rendering
    });
    // Writing to a string cannot fail.
    if !settings.is_empty() {
        let _ = writeln!(text, "# render:{settings}");
    }
    let _ = write!(
        text,
        "size {} {}\ncamera",
        camera.size.width, camera.size.height
    );
    for point in [camera.eye, camera.target, camera.up] {
        vector(&mut text, point);
    }
    text.push(' ');
    numbers(&mut text, [angle(scene, losses)]);
    let depth = scene.setting.rendering.depth();
    let _ = writeln!(text, "\nmaxdepth {depth}\n");
    lights(&mut text, scene, losses);
    let mut writer = Writer {
        text,
        scene,
        ambient: scene.ambient_light(),
        material: None,
        vertices: 0,
        smooth_vertices: 0,
        label: None,
    };
    for (index, object) in scene.objects.iter().enumerate() {
        writer.label = losses
            .label(Of::Object(index))
            .map(|label| label.trim().to_owned());
        if let Shape::Mesh(mesh) = &object.shape {
            writer.mesh(mesh, object.material, losses);
            continue;
        }
        if let Shape::Plane(plane) = &object.shape {
            writer.material(object.material, losses);
            writer.square(&plane.0.numbers());
            continue;
        }
        solids(index, object, losses, |solid, material, losses| {
            writer.material(material, losses);
            writer.solid(index, solid, losses);
        });
    }
    writer.text
}

fn lights(text: &mut String, scene: &Scene, losses: &mut Losses<'_>) {
    let mut attenuation = Falloff::NONE.radial;
    for (index, light) in scene.lights.iter().enumerate() {
        let Light {
            emitter,
            colour,
            shadows,
            ..
        } = *light;
        if shadows == Shadows::Off && emitter != Emitter::Ambient {
            losses.add(Of::Light(index), &SHADOWLESS);
        }
        let (name, place) = match emitter {
            Emitter::Ambient => continue,
            Emitter::Distant(toward) => ("directional", toward),
            Emitter::Point {
                position,
                radius,
                falloff,
            } => {
                if radius != 0.0 {
                    losses.add(Of::Light(index), &SIZE);
                }
                if falloff.spot.is_some() {
                    losses.add(Of::Light(index), &SPOT);
                }
                if falloff.radial != attenuation {
                    attenuation = falloff.radial;
                    text.push_str("attenuation");
                    numbers(text, attenuation);
                    text.push('\n');
                }
                ("point", position)
            }
        };
        text.push_str(name);
        numbers(text, place.to_array());
        vector(text, colour);
        text.push('\n');
    }
}

/// A text in progress, and its state.
struct Writer<'s> {
    text: String,
    scene: &'s Scene,
    ambient: Rgb,
    material: Option<u32>,
    vertices: usize,
    smooth_vertices: usize,
    /// What the next object is called, until it is written.
    label: Option<String>,
}

impl Writer<'_> {
    /// Writes what of a material differs from the one in force, and behind it what is called so.
    fn material(&mut self, index: u32, losses: &mut Losses<'_>) {
        if self.material != Some(index) {
            self.state(index, losses);
        }
        if let Some(label) = self.label.take() {
            // Writing to a string cannot fail.
            let _ = writeln!(self.text, "# {label}");
        }
    }

    fn state(&mut self, index: u32, losses: &mut Losses<'_>) {
        let state = |index: Option<u32>| {
            let material = index.and_then(|index| self.scene.materials.get(index as usize));
            material.map(|material| state_of(material, self.ambient))
        };
        let (old, new) = (state(self.material), state(Some(index)));
        self.material = Some(index);
        let Some((colours, shininess)) = new else {
            return;
        };
        report(
            Of::Material(index),
            &self.scene.materials[index as usize],
            losses,
        );
        self.text.push('\n');
        let names = ["ambient", "diffuse", "specular", "emission"];
        for (at, (name, colour)) in names.into_iter().zip(colours).enumerate() {
            if old.is_none_or(|(old, _)| old[at] != colour) {
                self.text.push_str(name);
                numbers(&mut self.text, colour.to_array());
                self.text.push('\n');
            }
        }
        if old.is_none_or(|(_, old)| old != shininess) {
            self.text.push_str("shininess ");
            number(&mut self.text, shininess);
            self.text.push('\n');
        }
    }

    fn solid(&mut self, index: usize, solid: &Solid, losses: &mut Losses<'_>) {
        match solid {
            Solid::Sphere(sphere) => {
                self.text.push_str("sphere");
                numbers(&mut self.text, sphere.centre.to_array());
                self.text.push(' ');
                numbers(&mut self.text, [sphere.radius]);
                self.text.push('\n');
            }
            Solid::Ellipsoid(ellipsoid) => self.ellipsoid(&ellipsoid.0.numbers()),
            Solid::Cuboid(cuboid) => {
                losses.add(Of::Object(index), &BOX);
                self.cuboid(&cuboid.0.numbers());
            }
            Solid::Cylinder(cylinder) => {
                losses.add(Of::Object(index), &ROUND);
                self.round(&cylinder.0.numbers(), 1.0);
            }
            Solid::Cone(cone) => {
                losses.add(Of::Object(index), &ROUND);
                self.round(&cone.0.numbers(), 0.0);
            }
            // It has a stand-in.
            Solid::Quadric(_) => {}
        }
    }

    /// The image of the unit sphere: of a rotation, a scaling and another rotation.
    fn ellipsoid(&mut self, frame: &FrameNumbers) {
        self.text.push_str("pushTransform\n  translate");
        numbers(&mut self.text, frame.origin.to_array());
        let scale = aligned(frame).unwrap_or_else(|| self.turn(frame));
        self.text.push_str("\n  scale");
        numbers(&mut self.text, scale.to_array());
        self.text.push_str("\n  sphere 0 0 0  1\npopTransform\n");
    }

    /// Writes the rotation to the principal axes of an ellipsoid; returns its semi-axes.
    fn turn(&mut self, frame: &FrameNumbers) -> DVec3 {
        let [x, y, z] = frame.columns();
        let matrix = DMat3::from_cols(x, y, z);
        let square = matrix * matrix.transpose();
        let rows = [square.x_axis, square.y_axis, square.z_axis].map(|row| row.to_array());
        // The sphere looks the same however it was turned before.
        let (values, axes) = geometry::principal_axes(rows);
        let [a, b, c] = axes;
        let c = if a.cross(b).dot(c) < 0.0 { -c } else { c };
        let (axis, angle) = glam::DQuat::from_mat3(&DMat3::from_cols(a, b, c)).to_axis_angle();
        if angle != 0.0 {
            self.text.push_str("\n  rotate");
            numbers(&mut self.text, axis.to_array());
            numbers(&mut self.text, [angle.to_degrees()]);
        }
        DVec3::from_array(values.map(f64::sqrt))
    }

    /// The square from −1 to 1 along the first two axes, whose front is where the third points.
    fn square(&mut self, frame: &FrameNumbers) {
        let [x, y, z] = frame.columns();
        let y = if x.cross(y).dot(z) < 0.0 { -y } else { y };
        let centre = frame.origin;
        let corners = [
            centre - x - y,
            centre + x - y,
            centre + x + y,
            centre - x + y,
        ];
        self.triangles(&corners, [[0, 1, 2], [0, 2, 3]].into_iter());
    }

    fn cuboid(&mut self, frame: &FrameNumbers) {
        let [x, y, z] = frame.columns();
        let corner = |at: usize| {
            let part = |bit: usize, edge: DVec3| {
                if at >> bit & 1 == 1 {
                    edge
                } else {
                    DVec3::ZERO
                }
            };
            frame.origin + part(0, x) + part(1, y) + part(2, z)
        };
        let corners: Vec<_> = (0..8).map(corner).collect();
        let faces = [
            [0, 2, 3],
            [0, 3, 1],
            [4, 5, 7],
            [4, 7, 6],
            [0, 1, 5],
            [0, 5, 4],
            [2, 6, 7],
            [2, 7, 3],
            [0, 4, 6],
            [0, 6, 2],
            [1, 3, 7],
            [1, 7, 5],
        ];
        self.triangles(&corners, faces.into_iter());
    }

    /// A cylinder, or a cone whose top has no size.
    fn round(&mut self, frame: &FrameNumbers, top: f64) {
        let [x, y, z] = frame.columns();
        let ring = |size: f64, height: f64| {
            (0..SIDES).map(move |side| {
                let (sin, cos) = libm::sincos(side as f64 / SIDES as f64 * std::f64::consts::TAU);
                frame.origin + size * (cos * x + sin * y) + height * z
            })
        };
        let mut vertices: Vec<_> = ring(1.0, 0.0).chain(ring(top, 1.0)).collect();
        vertices.extend([frame.origin, frame.origin + z]);
        let sides = (0..SIDES).flat_map(|side| {
            let next = (side + 1) % SIDES;
            let (up, up_next) = (SIDES + side, SIDES + next);
            let (base, peak) = (2 * SIDES, 2 * SIDES + 1);
            let own = [
                [side, next, up_next],
                [side, up_next, up],
                [base, next, side],
                [peak, up, up_next],
            ];
            let count = if top == 0.0 { 3 } else { 4 };
            // The second triangle of a cone's side has no area.
            let keeps = move |at: &usize| top != 0.0 || *at != 1;
            (0..count).filter(keeps).map(move |at| own[at])
        });
        let sides: Vec<_> = sides.collect();
        self.triangles(&vertices, sides.into_iter());
    }

    fn mesh(&mut self, mesh: &Instance, material: u32, losses: &mut Losses<'_>) {
        for triangle in mesh.placed_triangles() {
            self.material(triangle.tag.unwrap_or(material), losses);
            match triangle.normals {
                None => self.triangles(&triangle.corners, std::iter::once([0, 1, 2])),
                Some(normals) => self.smooth(triangle.corners, normals),
            }
        }
    }

    fn smooth(&mut self, corners: [DVec3; 3], normals: [DVec3; 3]) {
        for (corner, normal) in corners.into_iter().zip(normals) {
            self.text.push_str("vertexnormal");
            numbers(&mut self.text, corner.to_array());
            vector(&mut self.text, normal);
            self.text.push('\n');
        }
        let first = self.smooth_vertices;
        // Writing to a string cannot fail.
        let _ = writeln!(self.text, "trinormal {first} {} {}", first + 1, first + 2);
        self.smooth_vertices += 3;
    }

    fn triangles(&mut self, vertices: &[DVec3], triangles: impl Iterator<Item = [usize; 3]>) {
        for vertex in vertices {
            self.text.push_str("vertex");
            numbers(&mut self.text, vertex.to_array());
            self.text.push('\n');
        }
        for [a, b, c] in triangles {
            let first = self.vertices;
            // Writing to a string cannot fail.
            let _ = writeln!(self.text, "tri {} {} {}", first + a, first + b, first + c);
        }
        self.vertices += vertices.len();
    }
}

/// The colours and the shininess that stand for a material.
fn state_of(material: &Material, ambient: Rgb) -> ([Rgb; 4], f64) {
    let gloss = gloss(material);
    let reflected = ambient * material.ambient.unwrap_or(material.diffuse);
    // A mirror alone has a highlight too small to be seen.
    let is_mirror = gloss.specular == Rgb::ZERO && material.mirror.tint != Rgb::ZERO;
    let shininess = if is_mirror {
        1e6
    } else {
        gloss.exponent.max(0.0)
    };
    let specular = if gloss.specular == Rgb::ZERO {
        material.mirror.tint
    } else {
        gloss.specular
    };
    (
        [reflected, material.diffuse, specular, material.emission],
        shininess,
    )
}

fn gloss(material: &Material) -> Gloss {
    match material.highlight {
        Highlight::Phong(gloss)
        | Highlight::ModifiedPhong(gloss)
        | Highlight::Blinn(gloss)
        | Highlight::PlainBlinn(gloss) => gloss,
        Highlight::None | Highlight::Microfacet { .. } => Gloss::default(),
    }
}

fn report(of: Of, material: &Material, losses: &mut Losses<'_>) {
    let is_plain = matches!(
        material.highlight,
        Highlight::None | Highlight::PlainBlinn(_)
    );
    let gloss = gloss(material);
    if !is_plain
        && (gloss.specular != Rgb::ZERO
            || matches!(material.highlight, Highlight::Microfacet { .. }))
    {
        losses.add(of, &LOBE);
    }
    if material.mirror.tint != gloss.specular {
        losses.add(of, &MIRROR);
    }
    if material.dielectric.tint != Rgb::ZERO {
        losses.add(of, &GLASS);
    }
    if material.maps.is_some() {
        losses.add(of, &TEXTURED);
    }
}
