//! Verdicts as sentences.

mod lights;

use super::Sentence;
use super::names::{Names, colour, number};
use language::Node;
use render::{DepthLimit, Explanation, Finding, RayKind, Shading, Term, TermSource, Verdict};
use scene::Rgb;

/// Keys of fields, by what they mean, in the order of the languages.
pub(super) const LIGHT_COLOUR: &[&str] = &["colour", "intensity"];
const LIGHT_PLACE: &[&str] = &["position", "direction"];
const LIGHT_DIRECTION: &[&str] = &["direction", "position"];
const CONE: &[&str] = &["direction", "aa"];
const ATTENUATION: &[&str] = &["attenuation", "a2", "a1", "a0"];
const DIFFUSE: &[&str] = &["kd", "Kd", "diffuse", "color"];
const AMBIENT: &[&str] = &["ka", "Ka", "diffuse", "color"];
const MIRROR: &[&str] = &["kr", "Kr", "reflection"];
const TRANSPARENCY: &[&str] = &["kt", "Kt", "refraction", "transmittance"];
const EYE: &[&str] = &["eye", "position"];
const MATERIAL: &[&str] = &["material", "mat"];
const FILE: &[&str] = &["file", "texture"];

/// Puts the verdicts of an explanation into words.
pub(super) fn sentences(explanation: &Explanation, names: &Names<'_>) -> Vec<Sentence> {
    let findings = explanation.verdicts.iter();
    findings
        .map(|finding| sentence(explanation, finding, names))
        .collect()
}

fn sentence(explanation: &Explanation, finding: &Finding, names: &Names<'_>) -> Sentence {
    let case = Case {
        explanation,
        names,
        ray: finding.ray,
    };
    let mut sentence = case.of(&finding.verdict);
    if let Some(where_seen) = case.where_seen(&finding.verdict) {
        sentence.text = format!("{where_seen}: {}", sentence.text);
    }
    sentence
}

struct Case<'c> {
    explanation: &'c Explanation,
    names: &'c Names<'c>,
    ray: usize,
}

impl Case<'_> {
    fn of(&self, verdict: &Verdict) -> Sentence {
        match verdict {
            Verdict::NoObjects
            | Verdict::Missed { .. }
            | Verdict::Clipped { .. }
            | Verdict::Inside { .. } => self.of_camera(verdict),
            Verdict::Depth { .. }
            | Verdict::Budget { .. }
            | Verdict::TotalReflection { .. }
            | Verdict::NotFinite
            | Verdict::TooBright { .. }
            | Verdict::Underexposed { .. } => self.of_rays(verdict),
            Verdict::Black { .. }
            | Verdict::MissingTexture { .. }
            | Verdict::NotReflected { .. }
            | Verdict::UnlitSide { .. }
            | Verdict::NoAmbient { .. } => self.of_material(verdict),
            Verdict::Ordinary(term) => self.of_term(term),
            _ => self.of_light(verdict),
        }
    }

    fn sentence(&self, name: &'static str, text: impl Into<String>) -> Sentence {
        Sentence {
            name,
            text: text.into(),
            help: None,
            node: None,
            place: None,
            ray: self.ray,
        }
    }

    /// A sentence about a node, whose place is that of the first field with one of these keys.
    fn about(&self, node: Node, keys: &[&'static str], sentence: Sentence) -> Sentence {
        Sentence {
            node: Some(node),
            place: self.names.field(node, keys),
            ..sentence
        }
    }

    fn of_camera(&self, verdict: &Verdict) -> Sentence {
        let names = self.names;
        match verdict {
            Verdict::Missed { radiance, behind } => {
                let shown = if *radiance == Rgb::ZERO {
                    "black".to_owned()
                } else {
                    colour(*radiance)
                };
                let around = if self.ray == 0 {
                    "background"
                } else {
                    "environment"
                };
                let text = format!("the ray hits nothing; the {around} is {shown}");
                let mut sentence = self.sentence("missed", text);
                if self.ray == 0 {
                    sentence = self.about(Node::View, EYE, sentence);
                }
                sentence.help = behind.map(|object| {
                    let object = names.object(object);
                    format!("{object} is behind the camera: turn the view toward it")
                });
                self.seen_by_nothing(sentence)
            }
            Verdict::Clipped {
                object,
                depth,
                limit,
                at,
            } => {
                let object_name = names.object(*object);
                let (name, key, word) = match limit {
                    DepthLimit::Near => ("clipped-near", "near", "nearer than the near limit"),
                    DepthLimit::Far => ("clipped-far", "far", "beyond the far limit"),
                };
                let (depth, at) = (number(*depth), number(*at));
                let text = format!("{object_name} is clipped: at depth {depth} it is {word}, {at}");
                let mut sentence = self.sentence(name, text);
                sentence.help = Some(match limit {
                    DepthLimit::Near => format!("set near below {depth}"),
                    DepthLimit::Far => format!("set far above {depth}"),
                });
                self.about(Node::View, &[key], sentence)
            }
            Verdict::Inside { object } => {
                let object_name = names.object(*object);
                let text = format!("the camera is inside {object_name} and sees its inner side");
                let mut sentence = self.sentence("inside", text);
                sentence.help = Some("move the eye out of it, or make it smaller".to_owned());
                self.about(names.object_node(*object), &[], sentence)
            }
            _ => self.sentence("no-objects", "the scene has no object"),
        }
    }

    /// Adds why a ray that hits nothing was traced, unless it is the camera's.
    fn seen_by_nothing(&self, sentence: Sentence) -> Sentence {
        let names = self.names;
        let ray = &self.explanation.rays[self.ray];
        let parent = ray.parent.map(|parent| &self.explanation.rays[parent]);
        let Some(shading) = parent.and_then(|parent| parent.shading()) else {
            return sentence;
        };
        let node = names.material_node(shading.hit.object);
        let (keys, does, other) = match ray.kind {
            RayKind::Refraction => (TRANSPARENCY, "transmits", "reflects as a mirror"),
            RayKind::Mirror => (MIRROR, "reflects as a mirror", "transmits"),
            _ => return sentence,
        };
        let key = names.key(node, keys).unwrap_or(keys[0]);
        let others = if keys == MIRROR { TRANSPARENCY } else { MIRROR };
        let other_key = names.key(node, others).unwrap_or(others[0]);
        let help = format!("{key} is what {does}; {other_key} is what {other}");
        let mut sentence = self.about(node, keys, sentence);
        sentence.help = Some(help);
        sentence
    }

    fn of_rays(&self, verdict: &Verdict) -> Sentence {
        let names = self.names;
        match verdict {
            Verdict::Depth { object, depth } => {
                let object_name = names.object(*object);
                let text = format!(
                    "cut by depth {depth}: {object_name} reflects or transmits light that is not \
                     traced"
                );
                let mut sentence = self.sentence("depth", text);
                sentence.help = Some(format!("raise the depth above {depth}"));
                self.about(names.object_node(*object), &[], sentence)
            }
            Verdict::Budget { untraced } => {
                let text = format!(
                    "the budget of 4096 rays per sample is spent: {untraced} rays were not traced"
                );
                let mut sentence = self.sentence("budget", text);
                sentence.help = Some("lower the depth, or the mirrors and transparency".to_owned());
                sentence
            }
            Verdict::TotalReflection { object } => {
                let object_name = names.object(*object);
                let text = format!(
                    "total internal reflection: no light passes the boundary of {object_name} at \
                     this angle"
                );
                let node = names.material_node(*object);
                let mut sentence = self.sentence("total-reflection", text);
                sentence.help = Some("an index of refraction nearer to 1 lets more out".to_owned());
                self.about(node, &["ior", "refraction"], sentence)
            }
            Verdict::TooBright { exposed } => {
                let text = format!("clipped at 255: the sum {} is above 1", colour(*exposed));
                let mut sentence = self.sentence("too-bright", text);
                let main = self.main_term();
                let exposure = "lower the exposure";
                sentence.help = Some(match &main {
                    Some(main) => format!("it is mostly {main}: dim that, or {exposure}"),
                    None => exposure.to_owned(),
                });
                sentence
            }
            Verdict::Underexposed { stops, radiance } => {
                let [red, green, blue] = self.explanation.displayed;
                let text = format!(
                    "the exposure of {} stops leaves {} at {} of 255",
                    number(*stops),
                    colour(*radiance),
                    red.max(green).max(blue)
                );
                let mut sentence = self.sentence("underexposed", text);
                sentence.help = Some("raise the exposure".to_owned());
                self.about(Node::Render, &["exposure"], sentence)
            }
            _ => self.sentence(
                "not-finite",
                "the sum is infinite or undefined: some number in the scene is too large",
            ),
        }
    }

    fn of_material(&self, verdict: &Verdict) -> Sentence {
        let names = self.names;
        match verdict {
            Verdict::Black { object, .. } => {
                let node = names.material_node(*object);
                let text = format!(
                    "the material of {} is black: it reflects, transmits and emits nothing",
                    names.object(*object)
                );
                let mut sentence = self.sentence("black", text);
                sentence.help = raise(names, node, DIFFUSE);
                self.about(node, DIFFUSE, sentence)
            }
            Verdict::MissingTexture { texture, object } => {
                let user = match object {
                    Some(object) => format!(" of {}", names.object(*object)),
                    None => " of the background or environment".to_owned(),
                };
                let node = Node::Texture(*texture as usize);
                let has_node = (*texture as usize) < self.names.textures();
                let node = match object {
                    _ if has_node => Some(node),
                    Some(object) => Some(names.material_node(*object)),
                    None => None,
                };
                let text = format!("a texture{user} has no image and shows magenta");
                let mut sentence = self.sentence("missing-texture", text);
                sentence.help = Some("check the file name and the folder".to_owned());
                match node {
                    Some(node) => self.about(node, FILE, sentence),
                    None => sentence,
                }
            }
            Verdict::NotReflected { light, object } => {
                let node = names.material_node(*object);
                let text = format!(
                    "{} reflects too little of {}",
                    names.object(*object),
                    names.light(*light)
                );
                let mut sentence = self.sentence("not-reflected", text);
                sentence.help = raise(names, node, DIFFUSE);
                self.about(node, DIFFUSE, sentence)
            }
            Verdict::UnlitSide { object } => {
                let text = format!(
                    "the inner side of {} shows no light of lights: its material is transparent",
                    names.object(*object)
                );
                self.about(
                    names.object_node(*object),
                    &[],
                    self.sentence("unlit-side", text),
                )
            }
            Verdict::NoAmbient { object, none } => {
                let name = names.object(*object);
                let (text, node, keys) = if *none {
                    (
                        "there is no ambient light".to_owned(),
                        Node::Ambient,
                        LIGHT_COLOUR,
                    )
                } else {
                    let text = format!("{name} reflects no ambient light");
                    (text, names.material_node(*object), AMBIENT)
                };
                self.about(node, keys, self.sentence("no-ambient", text))
            }
            _ => self.sentence("ordinary", "nothing is wrong"),
        }
    }

    fn of_term(&self, term: &Term) -> Sentence {
        let names = self.names;
        let node = match term.source {
            TermSource::Light { light, .. } | TermSource::LightItself { light } => {
                Some(Names::light_node(light))
            }
            TermSource::Caustics { object }
            | TermSource::Ambient { object }
            | TermSource::Emission { object } => Some(names.object_node(object)),
            TermSource::Emitter { emitter, .. } => emitter.map(|of| names.object_node(of)),
            TermSource::Ray { object, seen, .. } => Some(names.object_node(seen.unwrap_or(object))),
            TermSource::Surroundings => None,
        };
        if let TermSource::Emission { object } = term.source
            && self.has_no_material(object)
        {
            return self.no_material(object);
        }
        let text = format!(
            "{} ({})",
            self.source(&term.source),
            colour(term.contribution)
        );
        let sentence = self.sentence("ordinary", text);
        match node {
            Some(node) => self.about(node, &[], sentence),
            None => sentence,
        }
    }

    /// What a part of the colour is.
    fn source(&self, source: &TermSource) -> String {
        let names = self.names;
        match source {
            TermSource::Surroundings => "the surroundings of the scene".to_owned(),
            TermSource::Light { light, object } => {
                format!("{} lit by {}", names.object(*object), names.light(*light))
            }
            TermSource::Emitter { emitter, object } => {
                let object = names.object(*object);
                match emitter {
                    Some(emitter) => {
                        let emitter = names.object(*emitter);
                        format!("{object} lit by the emission of {emitter}")
                    }
                    None => format!("{object} lit by the environment"),
                }
            }
            TermSource::Caustics { object } => {
                let object = names.object(*object);
                format!("{object} lit via mirrors or glass, by photons")
            }
            TermSource::Ambient { object } => {
                format!("{} lit by ambient light", names.object(*object))
            }
            TermSource::Emission { object } => format!("the emission of {}", names.object(*object)),
            TermSource::LightItself { light } => {
                format!("{} itself, seen directly", names.light(*light))
            }
            TermSource::Ray { kind, object, seen } => {
                let object = names.object(*object);
                let seen = seen.map_or_else(
                    || "what surrounds the scene".to_owned(),
                    |seen| names.object(seen),
                );
                match kind {
                    RayKind::Refraction => format!("{object} transmits {seen}"),
                    RayKind::Diffuse | RayKind::Glossy => {
                        format!("{object} lit by light from {seen}")
                    }
                    _ => format!("{object} reflects {seen}"),
                }
            }
        }
    }

    /// Whether an object shows its own flat colour because the text gives it no material.
    fn has_no_material(&self, object: u32) -> bool {
        let names = self.names;
        let Node::Object(number) = names.object_node(object) else {
            return false;
        };
        let is_given = names.subject.source.material(number).is_some();
        let shadings = self.explanation.rays.iter().filter_map(|ray| ray.shading());
        let mut of_object = shadings.filter(|shading: &&Shading| shading.hit.object == object);
        let is_flat = |shading: &Shading| shading.material.emission == Rgb::ONE;
        let has_field = names.key(Node::Object(number), MATERIAL).is_some();
        !is_given && has_field && of_object.any(is_flat)
    }

    fn no_material(&self, object: u32) -> Sentence {
        let names = self.names;
        let text = format!(
            "{} has no material and is flat white, whatever the light",
            names.object(object)
        );
        let mut sentence = self.sentence("no-material", text);
        sentence.help = Some("name one of the scene's materials".to_owned());
        self.about(names.object_node(object), MATERIAL, sentence)
    }

    /// The largest part of the colour.
    fn main_term(&self) -> Option<String> {
        let terms = self.explanation.verdicts.iter();
        terms
            .filter_map(|finding| match &finding.verdict {
                Verdict::Ordinary(term) => Some(term),
                _ => None,
            })
            .max_by(|a, b| {
                let size = |term: &Term| term.contribution.max_element();
                size(a).total_cmp(&size(b))
            })
            .map(|term| self.source(&term.source))
    }

    /// Where a verdict was found, if not at what the camera sees directly.
    fn where_seen(&self, verdict: &Verdict) -> Option<String> {
        let ray = &self.explanation.rays[self.ray];
        if matches!(verdict, Verdict::Ordinary(term) if matches!(term.source, TermSource::Ray { .. }))
        {
            return None;
        }
        let parent = &self.explanation.rays[ray.parent?];
        let object = self.names.object(parent.shading()?.hit.object);
        Some(match ray.kind {
            RayKind::Camera => return None,
            RayKind::Mirror | RayKind::Boundary | RayKind::TotalReflection => {
                format!("reflected in {object}")
            }
            RayKind::Refraction => format!("through {object}"),
            RayKind::Diffuse | RayKind::Glossy => format!("scattered by {object}"),
        })
    }
}

/// The advice to raise the first of these fields that a node has.
fn raise(names: &Names<'_>, node: Node, keys: &[&'static str]) -> Option<String> {
    let key = names.key(node, keys)?;
    Some(format!("raise {key} of {}", names.node(node)))
}
