//! A plain Whitted tracer for `.test` scenes, to hold a renderer's pictures against.
//!
//! It takes the rules of the language one by one and tries every primitive for every ray. Texts are
//! taken to be well-formed; settings in comments, `integrator` and `spp` mean nothing here.

use glam::{DAffine3, DMat3, DVec3};

/// A picture in linear, unclamped colour: `[red, green, blue]` row by row from the top left.
pub(super) struct Picture {
    pub(super) width: usize,
    pub(super) pixels: Vec<[f64; 3]>,
}

/// Traces the scene of a well-formed text.
pub(super) fn trace(text: &str) -> Picture {
    let scene = Scene::read(text);
    let [width, height] = scene.size;
    let pixels = (0..width * height).map(|at| scene.pixel(at % width, at / width));
    Picture {
        width,
        pixels: pixels.collect(),
    }
}

/// What a text describes.
#[derive(Default)]
struct Scene {
    size: [usize; 2],
    depth: u32,
    /// Eye, target, up and the vertical angle of view in degrees.
    camera: (DVec3, DVec3, DVec3, f64),
    /// Homogeneous coordinates x, y, z and w, which is 1 for a position and 0 for the direction
    /// towards a light; colour; what the light is divided by: the factors of 1, d and d².
    lights: Vec<(DVec3, f64, DVec3, DVec3)>,
    primitives: Vec<Primitive>,
}

#[derive(Clone, Copy, Default)]
struct Material {
    ambient: DVec3,
    diffuse: DVec3,
    specular: DVec3,
    emission: DVec3,
    shininess: f64,
}

enum Shape {
    /// Centre and radius.
    Sphere(DVec3, f64),
    /// Corners, and the normals at them if they are interpolated.
    Triangle([DVec3; 3], Option<[DVec3; 3]>),
    /// A corner and the edges e1 and e2 of a parallelogram that shines along e2 × e1.
    QuadLight([DVec3; 3]),
}

/// A shape in a frame of its own, with the way from that to the world.
struct Primitive(Shape, DAffine3, Material);

impl Scene {
    /// Reads a well-formed text.
    fn read(text: &str) -> Self {
        let mut scene = Self::default();
        (scene.size, scene.depth) = ([640, 480], 5);
        scene.camera = (DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 45.0);
        let (mut state, mut attenuation) = (Material::default(), DVec3::X);
        (state.ambient, state.shininess) = (DVec3::splat(0.2), 1.0);
        let (mut top, mut below) = (DAffine3::IDENTITY, Vec::new());
        let (mut vertices, mut with_normals) = (Vec::new(), Vec::new());
        for line in text.split(['\n', '\r']) {
            let words = line.split([' ', '\t']).filter(|word| !word.is_empty());
            let mut words = words.take_while(|word| !word.starts_with('#'));
            let command = words.next().unwrap_or_default().to_ascii_lowercase();
            let number = |word: &str| word.trim_end_matches(['f', 'F']).parse().ok();
            let n: Vec<f64> = words.map_while(number).collect();
            let v = |at: usize| DVec3::from_slice(&n[at..]);
            let corners = || [0, 1, 2].map(|i| n[i] as usize);
            let (lights, primitives) = (&mut scene.lights, &mut scene.primitives);
            let (mut shape, mut material) = (None, state);
            match command.as_str() {
                "size" => scene.size = [n[0] as usize, n[1] as usize],
                "maxdepth" => scene.depth = if n[0] < 0.0 { 64 } else { n[0] as u32 },
                "camera" => scene.camera = (v(0), v(3), v(6), n[9]),
                "ambient" => state.ambient = v(0),
                "diffuse" => state.diffuse = v(0),
                "specular" => state.specular = v(0),
                "emission" => state.emission = v(0),
                "shininess" => state.shininess = n[0].max(0.0),
                "attenuation" => attenuation = v(0),
                "directional" => lights.push((top.transform_vector3(v(0)), 0.0, v(3), DVec3::X)),
                "point" => lights.push((top.transform_point3(v(0)), 1.0, v(3), attenuation)),
                "pushtransform" => below.push(top),
                "poptransform" => top = below.pop().expect("a push came before"),
                "translate" => top *= DAffine3::from_translation(v(0)),
                "scale" => top *= DAffine3::from_scale(v(0)),
                "rotate" => top *= DAffine3::from_axis_angle(v(0).normalize(), n[3].to_radians()),
                "vertex" => vertices.push(v(0)),
                "vertexnormal" => with_normals.push((v(0), v(3))),
                "sphere" => shape = Some(Shape::Sphere(v(0), n[3])),
                "tri" => shape = Some(Shape::Triangle(corners().map(|i| vertices[i]), None)),
                "trinormal" => {
                    let [a, b, c] = corners().map(|i| with_normals[i]);
                    shape = Some(Shape::Triangle([a.0, b.0, c.0], Some([a.1, b.1, c.1])));
                }
                "quadlight" => {
                    shape = Some(Shape::QuadLight([v(0), v(3), v(6)]));
                    (material, material.emission) = (Material::default(), v(9));
                }
                _ => {}
            }
            primitives.extend(shape.map(|shape| Primitive(shape, top, material)));
        }
        scene
    }

    /// The colour that the ray through the centre of a pixel brings.
    fn pixel(&self, i: usize, j: usize) -> [f64; 3] {
        let (eye, target, up, fov) = self.camera;
        let [width, height] = self.size.map(|pixels| pixels as f64);
        let forward = (target - eye).normalize();
        let mut right = forward.cross(up.normalize_or_zero());
        if right.length() < 1e-9 {
            let mut axes = DVec3::AXES;
            axes.sort_by(|a, b| forward.dot(*a).abs().total_cmp(&forward.dot(*b).abs()));
            right = forward.cross(axes[0]);
        }
        let right = right.normalize();
        let extent = (0.5 * fov).to_radians().tan();
        let x = extent * width / height * (2.0 * (i as f64 + 0.5) / width - 1.0);
        let y = extent * (1.0 - 2.0 * (j as f64 + 0.5) / height);
        let direction = forward + right * x + right.cross(forward) * y;
        self.radiance(eye, direction.normalize(), 0).to_array()
    }

    /// The light that comes back along a ray after so many bounces.
    fn radiance(&self, origin: DVec3, direction: DVec3, bounce: u32) -> DVec3 {
        let Some((primitive, (t, normal, is_front))) = self.nearest(origin, direction) else {
            return DVec3::ZERO;
        };
        let Primitive(shape, frame, material) = primitive;
        if matches!(shape, Shape::QuadLight(_)) && !is_front {
            return DVec3::ZERO;
        }
        let point = origin + direction * t;
        let normal = (frame.matrix3.inverse().transpose() * normal).normalize();
        let mut sum = material.ambient + material.emission;
        for &(place, w, colour, attenuation) in &self.lights {
            let offset = place - point * w;
            let (towards, d) = (offset.normalize(), offset.length());
            let divisor = attenuation.dot(DVec3::new(1.0, d, d * d));
            let intensity = colour / if divisor > 0.0 { divisor } else { 1.0 };
            // Infinite for a direction; a light on a surface is not blocked by that.
            let reach = d / w * (1.0 - 1e-9);
            let blocks = |it: &Primitive| it.hit(point, towards).is_some_and(|hit| hit.0 < reach);
            let cosine = normal.dot(towards);
            if cosine > 0.0 && !self.primitives.iter().any(blocks) {
                let half = (towards - direction).normalize();
                let (c, s) = (normal.dot(half), material.shininess);
                let highlight = if c < 0.0 { 0.0 } else { c.powf(s) };
                sum += intensity * (material.diffuse * cosine + material.specular * highlight);
            }
        }
        if material.specular != DVec3::ZERO && bounce < self.depth {
            sum += material.specular * self.radiance(point, direction.reflect(normal), bounce + 1);
        }
        sum
    }

    /// The first of the text among the hits that are nearest up to rounding.
    fn nearest(&self, origin: DVec3, direction: DVec3) -> Option<(&Primitive, (f64, DVec3, bool))> {
        let hit = |primitive| Some((primitive, Primitive::hit(primitive, origin, direction)?));
        let hits: Vec<_> = self.primitives.iter().filter_map(hit).collect();
        let least = hits.iter().map(|(_, (t, ..))| *t).reduce(f64::min)?;
        let size = least.max(origin.length());
        let most = least + 64.0 * (size.next_up() - size);
        hits.into_iter().find(|(_, (t, ..))| *t <= most)
    }
}

impl Primitive {
    /// The first hit of a ray of the world, beyond the surface that it starts on: its distance, the
    /// normal of the side seen, in the shape's frame, and whether that is the front.
    fn hit(&self, origin: DVec3, direction: DVec3) -> Option<(f64, DVec3, bool)> {
        let Self(shape, frame, _) = self;
        let to_own = frame.matrix3.inverse();
        let (o, d) = (to_own * (origin - frame.translation), to_own * direction);
        // Solves o + t·d = corner + v·e + w·f for t, v and w; all are 0 if that is singular.
        let crossing = |corner, e, f| DMat3::from_cols(-d, e, f).inverse_or_zero() * (o - corner);
        let beyond = |t: &f64| *t > 1e-9 * origin.length().max(1.0);
        let (t, normal, outward) = match *shape {
            Shape::Sphere(centre, radius) => {
                let from = o - centre;
                let (a, b, c) = (d.dot(d), from.dot(d), from.dot(from) - radius * radius);
                let root = (b * b - a * c).sqrt();
                let both = [-b - root, -b + root].map(|numerator| numerator / a);
                let t = both.into_iter().find(beyond)?;
                (t, from + d * t, from + d * t)
            }
            Shape::Triangle([a, b, c], normals) => {
                let [t, v, w] = crossing(a, b - a, c - a).to_array();
                let face = (b - a).cross(c - a);
                let [k, m, n] = normals.unwrap_or([face; 3]);
                let side = if face.dot(k + m + n) < 0.0 { -1.0 } else { 1.0 };
                let (outward, smooth) = (face * side, k * (1.0 - v - w) + m * v + n * w);
                let is_missing = smooth == DVec3::ZERO;
                let normal = if is_missing { outward } else { smooth };
                (v.min(w) >= 0.0 && v + w <= 1.0).then_some((t, normal, outward))?
            }
            Shape::QuadLight([corner, e1, e2]) => {
                let [t, v, w] = crossing(corner, e1, e2).to_array();
                // Along e2 × e1 in the world: a mirroring map turns it in the shape's frame.
                let outward = e2.cross(e1) * to_own.determinant().signum();
                (v.min(w) >= 0.0 && v.max(w) <= 1.0).then_some((t, outward, outward))?
            }
        };
        let is_front = d.dot(outward) < 0.0;
        beyond(&t).then_some((t, if is_front { normal } else { -normal }, is_front))
    }
}
