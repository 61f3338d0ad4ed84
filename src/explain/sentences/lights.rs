//! Verdicts on lights as sentences.

use super::{ATTENUATION, CONE, Case, LIGHT_COLOUR, LIGHT_DIRECTION, LIGHT_PLACE, raise};
use crate::Sentence;
use crate::names::{Names, colour, number, percent};
use language::Node;
use render::Verdict;
use scene::{Emitter, FalloffRule, Integrator};

impl Case<'_> {
    pub(super) fn of_light(&self, verdict: &Verdict) -> Sentence {
        let names = self.names;
        let light_node = |light: &u32| Names::light_node(*light);
        match verdict {
            Verdict::NoLights { others: false } => {
                self.no_lights("the scene has no light", "add a light")
            }
            Verdict::NoLights { others: true } => self.only_other_lights(),
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
                        "at the edge of the cone of {light_name}: {angle}° off its direction, \
                         which leaves {share}"
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
            Verdict::Facet { light, object } => {
                let (light_name, object_name) = (names.light(*light), names.object(*object));
                let text = format!(
                    "this facet of {object_name} faces away from {light_name}, although its smooth \
                     normal faces the light"
                );
                let mut sentence = self.sentence("facet", text);
                sentence.help = Some("a finer mesh narrows the band of such facets".to_owned());
                self.about(names.object_node(*object), &[], sentence)
            }
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
                rule,
            } => self.attenuated(*light, (*distance, *radial), *rule),
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

    fn attenuated(
        &self,
        light: u32,
        (distance, radial): (f64, f64),
        rule: FalloffRule,
    ) -> Sentence {
        let names = self.names;
        let node = Names::light_node(light);
        let name = names.light(light);
        let text = format!(
            "{name} is attenuated to {} at distance {}",
            number(radial),
            number(distance)
        );
        let colour = names.key(node, LIGHT_COLOUR).unwrap_or(LIGHT_COLOUR[0]);
        if rule == FalloffRule::Square {
            let text = format!("{text} by `falloff square`");
            let mut sentence = self.sentence("attenuated", text);
            sentence.help = Some(format!("use `falloff none`, or raise {colour} of {name}"));
            return self.about(Node::Render, &["falloff"], sentence);
        }
        let mut sentence = self.sentence("attenuated", text);
        let key = names.key(node, ATTENUATION);
        sentence.help = Some(match key {
            Some("a2") => format!("lower a0, a1 or a2 of {name}, or raise its {colour}"),
            Some(key) => format!("lower {key} of {name}, or raise its {colour}"),
            None => format!("raise {colour} of {name}"),
        });
        self.about(node, ATTENUATION, sentence)
    }

    /// The fields that place a light, the one that matters first.
    fn places(&self, light: u32) -> (&'static [&'static str], &'static str) {
        let light = self.names.subject.scene.lights.get(light as usize);
        match light.map(|light| light.emitter) {
            Some(Emitter::Distant(_)) => (LIGHT_DIRECTION, "turn"),
            _ => (LIGHT_PLACE, "move"),
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
        let node = Names::light_node(lights[0]);
        let (keys, verb) = self.places(lights[0]);
        sentence.help = Some(match (verb, names.key(node, keys)) {
            ("turn", Some(key)) => {
                format!("turn the {key} of {}, or add a light", names.node(node))
            }
            _ => format!("move {} to this side, or add a light", names.node(node)),
        });
        self.about(node, keys, sentence)
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
        let (_, verb) = self.places(light);
        sentence.help = Some(format!("{verb} the light, or what is in between"));
        self.about(node, &[], sentence)
    }

    /// Nothing in the scene is light to this integrator, but something is to the others.
    fn only_other_lights(&self) -> Sentence {
        let (text, help) = match self.explanation.integrator {
            Integrator::Whitted => (
                "the scene has no light, and only path tracing is lit by emission and environment",
                "trace paths, or add a light",
            ),
            Integrator::Path | Integrator::Photon => (
                "the scene has only ambient light, which path tracing leaves out",
                "use `integrator whitted`, or add a light",
            ),
        };
        self.no_lights(text, help)
    }

    fn no_lights(&self, text: &str, help: &str) -> Sentence {
        let mut sentence = self.sentence("no-lights", text);
        sentence.help = Some(help.to_owned());
        sentence
    }
}
