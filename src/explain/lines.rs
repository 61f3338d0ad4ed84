//! The lines of an explanation: rays, and below each what its end consists of and the rays that start
//! there. Texts write all of them; the interface lists those that tell of light.

use language::Node;
use render::{EmitterTerm, Explanation, LightTerm, RayEnd, TracedRay};
use scene::Rgb;

/// A line of an explanation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RayLine {
    /// The number of the ray.
    pub ray: usize,
    /// What of it the line shows.
    pub part: RayPart,
    /// The number of lines that it is inside of.
    pub depth: usize,
}

/// What a line shows of a ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RayPart {
    /// The ray itself, with everything that comes back along it.
    Whole,
    /// The point and the normals of the surface.
    Geometry,
    /// What absorption leaves on the way.
    Absorption,
    /// That a texture has no image.
    MissingTexture,
    /// The material, if it has a name of its own.
    Material,
    /// What the surface emits.
    Emission,
    /// Reflected ambient light.
    Ambient,
    /// The reflected light of one light, by its place in the list.
    Light(usize),
    /// Lights too many to list.
    Unlisted,
    /// The reflected light of an object that emits light, by its place in the list.
    Emitter(usize),
    /// Reflected light of photons.
    Caustics,
    /// The boundary of a transparent solid.
    Boundary,
    /// The weight of the mirror.
    Mirror,
    /// Why no rays go on.
    Stop,
}

impl RayPart {
    /// Whether it is light, or why none goes on, and not a property of the surface.
    pub fn is_light(self) -> bool {
        match self {
            Self::Whole
            | Self::Emission
            | Self::Ambient
            | Self::Light(_)
            | Self::Unlisted
            | Self::Emitter(_)
            | Self::Caustics
            | Self::Stop => true,
            Self::Geometry
            | Self::Absorption
            | Self::MissingTexture
            | Self::Material
            | Self::Boundary
            | Self::Mirror => false,
        }
    }
}

/// The lines of an explanation, without those inside of folded rays.
pub fn lines(explanation: &Explanation, is_folded: impl Fn(usize) -> bool) -> Vec<RayLine> {
    let mut lines = Vec::new();
    let children = explanation.children();
    // Depth first without recursion: a path may have thousands of vertices.
    let mut left: Vec<_> = (!explanation.rays.is_empty())
        .then_some((0, 0))
        .into_iter()
        .collect();
    while let Some((ray, depth)) = left.pop() {
        let line = |part, depth| RayLine { ray, part, depth };
        lines.push(line(RayPart::Whole, depth));
        if is_folded(ray) {
            continue;
        }
        let parts = parts(&explanation.rays[ray]);
        lines.extend(parts.into_iter().map(|part| line(part, depth + 1)));
        left.extend(children[ray].iter().rev().map(|&child| (child, depth + 1)));
    }
    lines
}

/// What the end of a ray consists of, apart from the rays that start there.
fn parts(ray: &TracedRay) -> Vec<RayPart> {
    let Some(shading) = ray.shading() else {
        return Vec::new();
    };
    let mut parts = vec![RayPart::Geometry];
    let mut add = |is_there: bool, part| parts.extend(is_there.then_some(part));
    add(shading.transmitted != Rgb::ONE, RayPart::Absorption);
    add(shading.missing.is_some(), RayPart::MissingTexture);
    add(true, RayPart::Material);
    add(shading.emission != Rgb::ZERO, RayPart::Emission);
    add(shading.ambient != Rgb::ZERO, RayPart::Ambient);
    for place in 0..shading.lights.len() {
        add(true, RayPart::Light(place));
    }
    add(0 < shading.unlisted.lights, RayPart::Unlisted);
    for place in 0..shading.emitters.len() {
        add(true, RayPart::Emitter(place));
    }
    add(shading.caustics != Rgb::ZERO, RayPart::Caustics);
    add(shading.boundary.is_some(), RayPart::Boundary);
    add(shading.mirror != Rgb::ZERO, RayPart::Mirror);
    add(shading.stop.is_some(), RayPart::Stop);
    parts
}

/// Whether a ray has lines inside of it that are light.
pub fn is_foldable(explanation: &Explanation, ray: usize) -> bool {
    let mut rays = explanation.rays.iter();
    let mut parts = parts(&explanation.rays[ray]).into_iter();
    parts.any(RayPart::is_light) || rays.any(|child| child.parent == Some(ray))
}

impl RayLine {
    /// The ray.
    pub fn ray<'e>(&self, explanation: &'e Explanation) -> &'e TracedRay {
        &explanation.rays[self.ray]
    }

    /// The light of a line that shows one.
    pub fn light<'e>(&self, explanation: &'e Explanation) -> Option<&'e LightTerm> {
        match self.part {
            RayPart::Light(at) => self.ray(explanation).shading()?.lights.get(at),
            _ => None,
        }
    }

    /// The emitter of a line that shows one.
    pub fn emitter<'e>(&self, explanation: &'e Explanation) -> Option<&'e EmitterTerm> {
        match self.part {
            RayPart::Emitter(at) => self.ray(explanation).shading()?.emitters.get(at),
            _ => None,
        }
    }

    /// The object or light that it tells of; `object` is the node of an object.
    pub fn node(
        &self,
        explanation: &Explanation,
        object: impl FnOnce(u32) -> Option<Node>,
    ) -> Option<Node> {
        if let Some(light) = self.light(explanation) {
            return Some(Node::Light(light.light as usize));
        }
        if let Some(emitter) = self.emitter(explanation) {
            return object(emitter.object?);
        }
        match &self.ray(explanation).end {
            RayEnd::Surface(shading) => object(shading.hit.object),
            RayEnd::Light(hit) => Some(Node::Light(hit.light as usize)),
            RayEnd::Missed { .. } | RayEnd::OverBudget => None,
        }
    }

    /// What it adds to the sample; for a whole ray, with the rays behind it.
    pub fn adds(&self, explanation: &Explanation) -> Rgb {
        let ray = self.ray(explanation);
        let Some(shading) = ray.shading().filter(|_| self.part != RayPart::Whole) else {
            return total(explanation, self.ray);
        };
        let radiance = match self.part {
            RayPart::Emission => shading.emission,
            RayPart::Ambient => shading.ambient,
            RayPart::Caustics => shading.caustics,
            RayPart::Unlisted => shading.unlisted.radiance,
            RayPart::Light(_) => {
                let light = self.light(explanation);
                light.map_or(Rgb::ZERO, |light| light.radiance)
            }
            RayPart::Emitter(_) => {
                let emitter = self.emitter(explanation);
                emitter.map_or(Rgb::ZERO, |emitter| emitter.radiance)
            }
            _ => Rgb::ZERO,
        };
        ray.weight * shading.transmitted * radiance
    }
}

/// What a ray and the rays behind it add to the sample.
fn total(explanation: &Explanation, ray: usize) -> Rgb {
    let rays = &explanation.rays;
    let mut is_inside = vec![false; rays.len()];
    let mut sum = Rgb::ZERO;
    for (number, of) in rays.iter().enumerate().skip(ray) {
        is_inside[number] = number == ray || of.parent.is_some_and(|parent| is_inside[parent]);
        if is_inside[number] {
            sum += of.contribution;
        }
    }
    sum
}
