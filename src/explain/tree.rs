//! The tree of rays as lines.

use glam::DVec3;

use super::lines::{RayLine, RayPart};
use super::names::{Names, colour, number, percent, side, vector};
use super::{Line, wording};
use language::Node;
use render::{
    Boundary, Chosen, Crossing, Densities, EmitterTerm, Explanation, LightTerm, RayEnd, RayKind,
    Shading, SurfaceHit, TracedRay,
};

/// Writes a record as lines, each ray below the surface it starts from.
pub(super) fn lines(explanation: &Explanation, names: &Names<'_>) -> Vec<Line> {
    let mut writer = Writer {
        explanation,
        names,
        lines: Vec::new(),
    };
    for line in super::lines::lines(explanation, |_| false) {
        writer.write(line);
    }
    writer.lines
}

struct Writer<'w> {
    explanation: &'w Explanation,
    names: &'w Names<'w>,
    lines: Vec<Line>,
}

impl Writer<'_> {
    fn line(&mut self, (ray, depth): (usize, usize), text: String) -> &mut Line {
        self.lines.push(Line {
            depth,
            text,
            adds: None,
            node: None,
            place: None,
            ray,
            segment: None,
        });
        let last = self.lines.len() - 1;
        &mut self.lines[last]
    }

    /// A line about a node.
    fn about(&mut self, at: (usize, usize), text: String, node: Node) -> &mut Line {
        let place = self.names.place(node);
        let line = self.line(at, text);
        line.node = Some(node);
        line.place = place;
        line
    }

    fn write(&mut self, line: RayLine) {
        let ray = line.ray(self.explanation);
        let at = (line.ray, line.depth);
        match ray.shading() {
            Some(shading) => self.surface(ray, shading, line.part, at),
            None => self.end(ray, at),
        }
    }

    /// A ray that hit no surface.
    fn end(&mut self, ray: &TracedRay, at: (usize, usize)) {
        let begin = beginning(ray);
        let added = ray.contribution;
        match &ray.end {
            RayEnd::Missed {
                radiance,
                densities,
                ..
            } => {
                let around = if ray.bounce == 0 {
                    "background"
                } else {
                    "environment"
                };
                let weight = densities.map_or(String::new(), |densities| {
                    weighed(&densities, "emitter sampling")
                });
                let shown = colour(*radiance);
                let text = format!("{begin} hits nothing: {around} {shown}{weight}");
                self.line(at, text).adds = Some(added);
            }
            RayEnd::OverBudget => {
                self.line(at, format!("{begin} is not traced: the budget is spent"));
            }
            RayEnd::Light(hit) => {
                let t = number(hit.t);
                let weight = hit
                    .densities
                    .map_or(String::new(), |densities| weighed(&densities, "the light"));
                let name = self.names.light(hit.light);
                let text = format!(
                    "{begin} hits {name} at t {t}: radiance {}{weight}",
                    colour(hit.radiance)
                );
                let line = self.about(at, text, Names::light_node(hit.light));
                line.adds = Some(added);
                line.segment = Some([ray.origin, ray.origin + hit.t * ray.direction]);
            }
            RayEnd::Surface(_) => {}
        }
    }

    /// A line about a surface that a ray hit.
    fn surface(&mut self, ray: &TracedRay, shading: &Shading, part: RayPart, at: (usize, usize)) {
        let hit = &shading.hit;
        let text = match part {
            RayPart::Whole => return self.hit(ray, hit, at),
            RayPart::Material => return self.material(hit, at),
            RayPart::Light(place) => return self.light(&shading.lights[place], hit.point, at),
            RayPart::Emitter(place) => {
                return self.emitter(&shading.emitters[place], hit.point, at);
            }
            RayPart::Geometry => geometry(hit),
            RayPart::Absorption => {
                let left = colour(shading.transmitted);
                format!("absorption on the way leaves {left}")
            }
            RayPart::MissingTexture => "a texture has no image: magenta".to_owned(),
            RayPart::Emission => {
                let weight = shading.densities.map_or(String::new(), |densities| {
                    weighed(&densities, "emitter sampling")
                });
                format!("emission {}{weight}", colour(shading.emission))
            }
            RayPart::Ambient => format!("ambient {}", colour(shading.ambient)),
            RayPart::Unlisted => {
                let sum = colour(shading.unlisted.radiance);
                let lights = shading.unlisted.lights;
                format!("{lights} more lights: {sum}")
            }
            RayPart::Caustics => format!("photons {}", colour(shading.caustics)),
            RayPart::Boundary => shading.boundary.map_or(String::new(), boundary),
            RayPart::Mirror => format!("mirror {}", colour(shading.mirror)),
            RayPart::Stop => {
                let depth = self.explanation.depth;
                let stop = shading.stop.map(|stop| wording::stop(stop, depth));
                stop.map_or(String::new(), |stop| stop.long)
            }
        };
        self.line(at, text);
    }

    fn hit(&mut self, ray: &TracedRay, hit: &SurfaceHit, at: (usize, usize)) {
        let name = self.names.object(hit.object);
        let text = format!(
            "{} hits the {} of {name} at t {}",
            beginning(ray),
            side(hit.side),
            number(hit.t)
        );
        let node = self.names.object_node(hit.object);
        let line = self.about(at, text, node);
        line.segment = Some([ray.origin, hit.point]);
        line.adds = Some(ray.contribution);
    }

    /// The material, if it has a name of its own.
    fn material(&mut self, hit: &SurfaceHit, at: (usize, usize)) {
        let node = self.names.material_node(hit.object);
        if let Node::Material(_) = node {
            let name = self.names.node(node);
            self.about(at, format!("material: {name}"), node);
        }
    }

    fn light(&mut self, term: &LightTerm, point: DVec3, at: (usize, usize)) {
        let name = self.names.light(term.light);
        let text = format!("{name}: {}", self.term(term));
        let line = self.about(at, text, Names::light_node(term.light));
        let distance = if term.distance.is_finite() {
            term.distance
        } else {
            1.0
        };
        line.segment = Some([point, point + distance * term.toward]);
    }

    /// An object that emits light, with its factors, and why it adds nothing.
    fn emitter(&mut self, term: &EmitterTerm, point: DVec3, at: (usize, usize)) {
        let name = match term.object {
            Some(object) => format!("emission of {}", self.names.object(object)),
            None => "environment".to_owned(),
        };
        let mut factors = vec![format!("N·L {}", number(term.cosine))];
        factors.push(chances(&term.densities));
        factors.push(format!("reflected {}", colour(term.reflected)));
        if let Some(emitted) = term.emitted {
            factors.push(format!("radiance {}", colour(emitted)));
        }
        let begin = match term.dark {
            Some(dark) => wording::unlit(dark).long,
            None => colour(term.radiance),
        };
        let text = format!("{name}: {begin}: {}", factors.join(", "));
        let line = match term.object {
            Some(object) => self.about(at, text, self.names.object_node(object)),
            None => self.line(at, text),
        };
        if term.distance.is_finite() {
            line.segment = Some([point, point + term.distance * term.toward]);
        }
    }

    /// The factors of a light, and why it adds nothing.
    fn term(&self, term: &LightTerm) -> String {
        let cosine = format!("N·L {}", number(term.cosine));
        let mut factors = vec![cosine];
        if term.chance != 1.0 {
            factors.insert(0, format!("chosen with {}", percent(term.chance)));
        }
        if term.radial != 1.0 {
            factors.push(format!("falloff {}", number(term.radial)));
        }
        if term.spot != 1.0 {
            factors.push(format!("cone {}", number(term.spot)));
        }
        if let Some(densities) = term.densities {
            factors.push(chances(&densities));
        }
        factors.push(format!("reflected {}", colour(term.reflected)));
        if let Some(transmittance) = term.transmittance {
            factors.push(match self.crossed(&term.crossed) {
                _ if transmittance == 1.0 => "visible".to_owned(),
                Some(crossed) if transmittance == 0.0 => format!("blocked by {crossed}"),
                Some(crossed) => format!("{} pass {crossed}", percent(transmittance)),
                None => "blocked".to_owned(),
            });
        }
        let factors = factors.join(", ");
        match term.dark {
            Some(dark) => format!("{}: {factors}", wording::unlit(dark).long),
            None => format!("{}: {factors}", colour(term.radiance)),
        }
    }

    /// The objects that matter on a shadow ray.
    fn crossed(&self, crossed: &[Crossing]) -> Option<String> {
        let blocking: Vec<_> = crossed
            .iter()
            .filter(|crossing| crossing.transmittance == 0.0)
            .map(|crossing| crossing.object)
            .collect();
        let all: Vec<_> = crossed.iter().map(|crossing| crossing.object).collect();
        let named = if blocking.is_empty() { all } else { blocking };
        (!named.is_empty()).then(|| self.names.objects(&named))
    }
}

/// The point that a ray hit, and the normals there.
fn geometry(hit: &SurfaceHit) -> String {
    let turned = hit.geometric.dot(hit.normal).signum() * hit.geometric;
    let bumped = if turned.distance(hit.normal) < 1e-9 {
        String::new()
    } else {
        format!(" (geometric {})", vector(hit.geometric))
    };
    format!(
        "point {}, normal {}{bumped}, uv {} {}",
        vector(hit.point),
        vector(hit.normal),
        number(hit.uv.x),
        number(hit.uv.y)
    )
}

/// What the boundary of a transparent solid does with light.
fn boundary(boundary: Boundary) -> String {
    let [from, to] = boundary.indices.map(number);
    let share = if boundary.total {
        "total internal reflection".to_owned()
    } else {
        format!("reflects {}", percent(boundary.reflectance))
    };
    let tint = colour(boundary.tint);
    format!("boundary {tint}, index {from} to {to}: {share}")
}

/// The weight of what a path hit.
fn weighed(densities: &Densities, other: &str) -> String {
    format!(
        ", MIS weight {} (density {} against {} by {other})",
        number(densities.weight),
        number(densities.by_path),
        number(densities.by_light)
    )
}

/// The weight of a sampled emitter.
fn chances(densities: &Densities) -> String {
    format!(
        "density {} against {} by the path, MIS weight {}",
        number(densities.by_light),
        number(densities.by_path),
        number(densities.weight)
    )
}

/// What a ray is and what it counts.
fn beginning(ray: &TracedRay) -> String {
    let kind = wording::kind(ray.kind).long;
    if ray.kind == RayKind::Camera {
        return kind;
    }
    let weight = colour(ray.weight);
    let chosen = ray.chosen.map_or(String::new(), |chosen| choice(&chosen));
    format!("{kind} (weight {weight}{chosen})")
}

fn choice(chosen: &Chosen) -> String {
    let density = chosen.density.map_or(String::new(), |density| {
        format!(", density {}", number(density))
    });
    let survival = if chosen.survival < 1.0 {
        format!(", survived {}", percent(chosen.survival))
    } else {
        String::new()
    };
    format!(", chance {}{density}{survival}", percent(chosen.chance))
}
