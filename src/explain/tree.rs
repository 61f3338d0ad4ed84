//! The tree of rays as lines.

use glam::DVec3;

use super::Line;
use super::names::{Names, colour, number, percent, side, vector};
use language::Node;
use render::{
    Chosen, Crossing, Densities, EmitterTerm, Explanation, LightTerm, RayEnd, RayKind, Shading,
    Stop, TracedRay, UnlitReason,
};
use scene::Rgb;

/// Writes a record as lines, each ray below the surface it starts from.
pub(super) fn lines(explanation: &Explanation, names: &Names<'_>) -> Vec<Line> {
    let children = explanation.children();
    let mut writer = Writer {
        explanation,
        names,
        lines: Vec::new(),
    };
    // Depth first without recursion: a path may have thousands of vertices.
    let mut waiting = vec![(0, 0)];
    while let Some((ray, depth)) = waiting.pop() {
        writer.ray(ray, depth);
        waiting.extend(children[ray].iter().rev().map(|&child| (child, depth + 1)));
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

    fn ray(&mut self, number: usize, depth: usize) {
        let explanation = self.explanation;
        let ray = &explanation.rays[number];
        let at = (number, depth);
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
                let t = super::number(hit.t);
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
            RayEnd::Surface(shading) => self.surface(ray, shading, at, &begin),
        }
    }

    fn surface(
        &mut self,
        ray: &TracedRay,
        shading: &Shading,
        (number, depth): (usize, usize),
        begin: &str,
    ) {
        let hit = &shading.hit;
        let name = self.names.object(hit.object);
        let text = format!(
            "{begin} hits the {} of {name} at t {}",
            side(hit.side),
            super::number(hit.t)
        );
        let node = self.names.object_node(hit.object);
        let line = self.about((number, depth), text, node);
        line.segment = Some([ray.origin, hit.point]);
        line.adds = Some(ray.contribution);
        let at = (number, depth + 1);
        self.geometry(shading, at);
        if shading.emission != Rgb::ZERO {
            let weight = shading.densities.map_or(String::new(), |densities| {
                weighed(&densities, "emitter sampling")
            });
            self.line(at, format!("emission {}{weight}", colour(shading.emission)));
        }
        if shading.ambient != Rgb::ZERO {
            self.line(at, format!("ambient {}", colour(shading.ambient)));
        }
        for term in &shading.lights {
            self.light(term, hit.point, at);
        }
        if 0 < shading.unlisted.lights {
            let sum = colour(shading.unlisted.radiance);
            let lights = shading.unlisted.lights;
            self.line(at, format!("{lights} more lights: {sum}"));
        }
        for term in &shading.emitters {
            self.emitter(term, hit.point, at);
        }
        if shading.caustics != Rgb::ZERO {
            self.line(at, format!("photons {}", colour(shading.caustics)));
        }
        self.specular(shading, at);
    }

    fn geometry(&mut self, shading: &Shading, at: (usize, usize)) {
        let hit = &shading.hit;
        let turned = hit.geometric.dot(hit.normal).signum() * hit.geometric;
        let bumped = if turned.distance(hit.normal) < 1e-9 {
            String::new()
        } else {
            format!(" (geometric {})", vector(hit.geometric))
        };
        let text = format!(
            "point {}, normal {}{bumped}, uv {} {}",
            vector(hit.point),
            vector(hit.normal),
            number(hit.uv.x),
            number(hit.uv.y)
        );
        self.line(at, text);
        if shading.transmitted != Rgb::ONE {
            let left = colour(shading.transmitted);
            self.line(at, format!("absorption on the way leaves {left}"));
        }
        if shading.missing.is_some() {
            self.line(at, "a texture has no image: magenta".to_owned());
        }
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
            Some(dark) => reason(dark).to_owned(),
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
            Some(dark) => format!("{}: {factors}", reason(dark)),
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

    fn specular(&mut self, shading: &Shading, at: (usize, usize)) {
        if let Some(boundary) = shading.boundary {
            let [from, to] = boundary.indices.map(number);
            let share = if boundary.total {
                "total internal reflection".to_owned()
            } else {
                format!("reflects {}", percent(boundary.reflectance))
            };
            let tint = colour(boundary.tint);
            let text = format!("boundary {tint}, index {from} to {to}: {share}");
            self.line(at, text);
        }
        if shading.mirror != Rgb::ZERO {
            self.line(at, format!("mirror {}", colour(shading.mirror)));
        }
        let depth = self.explanation.depth;
        let end = match shading.stop {
            Some(Stop::Depth) => format!("cut by the depth of {depth}"),
            Some(Stop::Budget) => "the path ends: the budget is spent".to_owned(),
            Some(Stop::Nowhere) => "the path ends: its direction leads nowhere".to_owned(),
            Some(Stop::Overflow) => "the path ends: its weight overflowed".to_owned(),
            Some(Stop::Roulette { survival }) => {
                let chance = percent(survival);
                format!("the path ends by Russian roulette, which it had survived with {chance}")
            }
            None => return,
        };
        self.line(at, end);
    }
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
    let kind = match ray.kind {
        RayKind::Camera => return "camera ray".to_owned(),
        RayKind::Mirror => "mirrored ray",
        RayKind::Boundary => "ray reflected at the boundary",
        RayKind::Refraction => "refracted ray",
        RayKind::TotalReflection => "totally reflected ray",
        RayKind::Diffuse => "diffusely scattered ray",
        RayKind::Glossy => "glossily scattered ray",
    };
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

/// Why a light adds nothing.
pub(super) fn reason(dark: UnlitReason) -> &'static str {
    match dark {
        UnlitReason::SwitchedOff => "switched off",
        UnlitReason::UnlitSide => "not shown on this side",
        UnlitReason::FacesAway => "faces away",
        UnlitReason::AtThePoint => "at the point itself",
        UnlitReason::OutsideCone => "outside its cone",
        UnlitReason::Attenuated => "attenuated to nothing",
        UnlitReason::NotReflected => "not reflected",
        UnlitReason::Blocked => "in shadow",
        UnlitReason::Hidden => "hidden by another light",
    }
}
