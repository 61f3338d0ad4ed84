//! Verdicts on lights as sentences.

use super::{ATTENUATION, CONE, Case, LIGHT_COLOUR, LIGHT_PLACE, raise};
use crate::explain::Sentence;
use crate::explain::names::{Names, colour, number, percent};
use crate::render::Verdict;
use crate::scene::Integrator;

impl Case<'_> {
    pub(super) fn of_light(&self, verdict: &Verdict) -> Sentence {
        let names = self.names;
        let light_node = |light: &u32| Names::light_node(*light);
        match verdict {
            Verdict::NoLights { others } => self.no_lights(*others),
            Verdict::SwitchedOff { lights, all } => {
                let which = if *all && 1 < lights.len() {
                    "all lights are".to_owned()
                } else if 1 < lights.len() {
                    format!("{} are", names.lights(lights))
                } else {
                    format!("{} is", names.lights(lights))
                };
                let text = format!("{which} switched off by a colour of 0");
                let node = light_node(&lights[0]);
                let mut sentence = self.sentence("switched-off", text);
                sentence.help = raise(names, node, LIGHT_COLOUR);
                self.about(node, LIGHT_COLOUR, sentence)
            }
            Verdict::Enclosed { light, object } => {
                let (light_name, object_name) = (names.light(*light), names.object(*object));
                let text =
                    format!("{light_name} is inside {object_name}, which lets none of it out");
                let mut sentence = self.sentence("enclosed", text);
                sentence.help = Some(format!("move the light out of {object_name}"));
                self.about(light_node(light), LIGHT_PLACE, sentence)
            }
            Verdict::Shadow {
                light,
                blockers,
                transmittance,
                object,
            } => self.shadow((*light, *object), blockers, *transmittance),
            Verdict::OutsideCone { light, angle, spot } => {
                let light_name = names.light(*light);
                let angle = number(*angle);
                let text = if *spot == 0.0 {
                    format!("outside the cone of {light_name}: {angle}° off its direction")
                } else {
                    let share = percent(*spot);
                    format!(
                        "at the edge of the cone of {light_name}: {angle}° off its direction leave \
                         {share}"
                    )
                };
                let mut sentence = self.sentence("outside-cone", text);
                sentence.help = Some("turn its direction toward the point, or lower aa".to_owned());
                self.about(light_node(light), CONE, sentence)
            }
            Verdict::FacesAway {
                lights,
                all,
                cosine,
                object,
            } => self.faces_away((lights, *all), *cosine, *object),
            Verdict::AtTheLight { light, object } => {
                let (light_name, object_name) = (names.light(*light), names.object(*object));
                let text = format!("this point of {object_name} lies inside {light_name}");
                let mut sentence = self.sentence("at-the-light", text);
                sentence.help = Some(format!("move the light away from {object_name}"));
                self.about(light_node(light), LIGHT_PLACE, sentence)
            }
            Verdict::Attenuated {
                light,
                distance,
                radial,
            } => {
                let text = format!(
                    "{} is attenuated to {} at distance {}",
                    names.light(*light),
                    number(*radial),
                    number(*distance)
                );
                let mut sentence = self.sentence("attenuated", text);
                sentence.help = Some("lower its attenuation, or raise its colour".to_owned());
                self.about(light_node(light), ATTENUATION, sentence)
            }
            Verdict::Dim {
                light,
                colour: dark,
            } => {
                let text = format!(
                    "{} is dim: its colour is {}",
                    names.light(*light),
                    colour(*dark)
                );
                let node = light_node(light);
                let mut sentence = self.sentence("dim", text);
                sentence.help = raise(names, node, LIGHT_COLOUR);
                self.about(node, LIGHT_COLOUR, sentence)
            }
            _ => self.sentence("ordinary", "nothing is wrong"),
        }
    }

    fn faces_away(&self, (lights, all): (&[u32], bool), cosine: f64, object: u32) -> Sentence {
        let names = self.names;
        let which = if all && 1 < lights.len() {
            "every light".to_owned()
        } else {
            names.lights(lights)
        };
        let object = names.object(object);
        let text = if 0.0 < cosine {
            format!(
                "{which} only grazes {object} here: N·L is {}",
                number(cosine)
            )
        } else {
            format!("{object} faces away from {which} here")
        };
        let mut sentence = self.sentence("faces-away", text);
        sentence.help = Some("move the light to this side, or add one".to_owned());
        self.about(Names::light_node(lights[0]), LIGHT_PLACE, sentence)
    }

    fn shadow(&self, (light, object): (u32, u32), blockers: &[u32], passes: f64) -> Sentence {
        let names = self.names;
        let light_name = names.light(light);
        let (text, node) = match blockers {
            [] => (
                format!("another light hides {light_name}"),
                Names::light_node(light),
            ),
            [first, ..] if *first == object => (
                format!(
                    "{} is in its own shadow from {light_name}",
                    names.object(object)
                ),
                names.object_node(object),
            ),
            [first, ..] => {
                let share = if passes == 0.0 {
                    String::new()
                } else {
                    format!(", of which {} passes", percent(passes))
                };
                let blockers = names.objects(blockers);
                (
                    format!("in the shadow of {blockers} from {light_name}{share}"),
                    names.object_node(*first),
                )
            }
        };
        let mut sentence = self.sentence("shadow", text);
        sentence.help = Some("move the light or what is in between".to_owned());
        self.about(node, &[], sentence)
    }

    fn no_lights(&self, others: bool) -> Sentence {
        let (text, help) = match (self.explanation.integrator, others) {
            (_, false) => ("the scene has no light", "add a light"),
            (Integrator::Whitted, true) => (
                "the scene has no light, and only path tracing is lit by emission and environment",
                "trace paths, or add a light",
            ),
            (Integrator::Path | Integrator::Photon, true) => (
                "the scene has only ambient light, which path tracing leaves out",
                "use `integrator whitted`, or add a light",
            ),
        };
        let mut sentence = self.sentence("no-lights", text);
        sentence.help = Some(help.to_owned());
        sentence
    }
}
