//! The roles of elements, by their names and parents, and what is unknown.

use std::collections::HashMap;

use super::Lowering;
use crate::node::Node;
use crate::rendering::settings;
use crate::report::quoted;
use crate::schema::{Category, Named};
use crate::xml::origins::{Place, Role};
use crate::xml::parameter::{Attributes, Class, Parameter, Single, Type};
use crate::xml::schema::{
    BACKGROUND, CAMERA, CHECKER, CLASSES, ENVIRONMENT, GAMMA, TEXTURE, TRANSFORMS, class_of,
};
use text::{Diagnostic, Span, nearest_word, visible};

/// The elements known in `xml` and in `scene`.
const IN_ROOT: [&str; 3] = ["scene", "camera", "render"];
const IN_SCENE: [&str; 5] = ["object", "material", "light", "background", "environment"];

/// What becomes of an element or attribute that is not known.
const SKIPPED: &str = "it is skipped";

impl<'a> Lowering<'a> {
    /// Gives every element its role. Unknown elements are skipped with a warning, and their content
    /// without.
    pub(super) fn find_roles(&mut self) {
        let tree = self.tree;
        let mut parameters: HashMap<(u32, &'static str), usize> = HashMap::new();
        for element in 0..tree.elements.len() {
            let parent = tree.elements[element].parent;
            let role = match parent {
                None => self.root(element),
                Some(parent) => self.child(element, parent as usize),
            };
            let roles = &self.origins.roles;
            let is_node =
                |&parent: &u32| !matches!(roles[parent as usize], Role::Scene | Role::Root);
            let owner = match (role, parent.filter(is_node)) {
                (Role::Parameter(_) | Role::Transform(_) | Role::Skipped, Some(parent)) => {
                    self.origins.owners[parent as usize]
                }
                _ => element as u32,
            };
            self.origins.roles.push(role);
            self.origins.owners.push(owner);
            if let (Role::Parameter(parameter), Some(parent)) = (role, parent)
                && let Some(before) = parameters.insert((parent, parameter.element), element)
            {
                self.origins.roles[before] = Role::Skipped;
                self.repeated(before);
            }
            self.check_attributes(element, role);
        }
        self.check_words();
    }

    /// The name of an element.
    pub(super) fn name(&self, element: usize) -> &'a str {
        self.tree.elements[element].name.of(self.text)
    }

    /// The place of messages about an element.
    pub(super) fn place(&self, element: usize) -> Span {
        self.tree.elements[element].name
    }

    fn root(&mut self, element: usize) -> Role {
        let (name, place) = (self.name(element), self.place(element));
        if name.eq_ignore_ascii_case("xml") {
            self.origins.root = Some(element);
            return Role::Root;
        }
        let message = || format!("the root element is {}", quoted(name));
        self.error(place, message, "`<xml>` around `<scene>` and `<camera>`");
        Role::Skipped
    }

    fn child(&mut self, element: usize, parent: usize) -> Role {
        let name = self.name(element);
        let is = |known: &str| name.eq_ignore_ascii_case(known);
        let among =
            |all: &[&'static Parameter]| all.iter().copied().find(|known| is(known.element));
        let outer = self.origins.roles[parent];
        let class = CLASSES.into_iter().find(|class| match outer {
            Role::Scene => is(class.category.word()),
            Role::Node(Node::Object(_)) => class.category == Category::Object && is("object"),
            _ => false,
        });
        let found = match (outer, class) {
            (Role::Skipped, _) => return Role::Skipped,
            (_, Some(class)) => Some(self.thing(element, class, outer)),
            (Role::Root, _) if is("scene") => Some(self.once(element, Role::Scene)),
            (Role::Root, _) if is("camera") => Some(self.once(element, Role::Node(Node::View))),
            (Role::Root, _) if is("render") => Some(self.once(element, Role::Node(Node::Render))),
            (Role::Scene, _) => among(&[&BACKGROUND, &ENVIRONMENT]).map(Role::Parameter),
            _ => among(self.parameters_in(outer))
                .map(Role::Parameter)
                .or_else(|| among(transforms_in(outer)).map(Role::Transform)),
        };
        found.unwrap_or_else(|| {
            self.unknown(element, parent);
            Role::Skipped
        })
    }

    /// The scene, the camera or the render settings: the first one counts.
    fn once(&mut self, element: usize, role: Role) -> Role {
        let place = match role {
            Role::Scene => &mut self.origins.scene,
            Role::Node(Node::Render) => &mut self.origins.render,
            _ => &mut self.origins.camera,
        };
        if place.is_none() {
            *place = Some(element);
            return role;
        }
        let name = quoted(self.name(element));
        let message = || format!("{name}: already given");
        let hint = "this one is skipped";
        self.warn(self.place(element), message, "only one", hint);
        Role::Skipped
    }

    /// A light, a material or an object.
    fn thing(&mut self, element: usize, class: &Class, outer: Role) -> Role {
        let Some(kind) = self.kind(element, class) else {
            return Role::Skipped;
        };
        let depth = match outer {
            Role::Node(group) => self.origins.get(group).map_or(0, |group| group.depth + 1),
            _ => 0,
        };
        let name = self.word(element, "name");
        let place = Place {
            element: element as u32,
            depth,
            kind,
            name: name.map(shown),
            material: None,
        };
        let node = self.origins.push(class.category, place);
        if let (Node::Material(index), Some(name)) = (node, name)
            && let Some(before) = self.named.insert(name, index)
        {
            let first = self.origins.of(Category::Material)[before].element as usize;
            let span = self.value(first, "name").map(|at| at.value);
            let message = || format!("{}: another material has this name", quoted(name));
            let hint = "the last one counts";
            self.warn(span.unwrap_or_default(), message, "a unique name", hint);
        }
        Role::Node(node)
    }

    /// The kind given by an element's `type`, or the usual one if that is missing or unknown.
    fn kind(&mut self, element: usize, class: &Class) -> Option<&'static Type> {
        let Some(attribute) = self.value(element, "type") else {
            if class.otherwise.is_none() {
                let expected = "type=\"ambient\", \"direct\" or \"point\"";
                let message = || format!("{}: no type", class.category.word());
                self.warn(self.place(element), message, expected, class.hint);
            }
            return class.otherwise;
        };
        let word = attribute.unescaped(self.text);
        let mut kinds = class.kinds.iter().copied();
        let found = kinds.find(|kind| kind.word.eq_ignore_ascii_case(word));
        if found.is_none() {
            let name = self.name(element);
            let types: Vec<_> = class.kinds.iter().map(|kind| kind.word).collect();
            let nearest = nearest_word(word, types.iter().copied());
            let message = || format!("{name}: unknown type {}", quoted(word));
            let expected = types.join(" or ");
            self.mistaken(&[attribute.value], message, &expected, class.hint, nearest);
        }
        found.or(class.otherwise)
    }

    fn unknown(&mut self, element: usize, parent: usize) {
        let (name, outer) = (quoted(self.name(element)), quoted(self.name(parent)));
        let known = self.known_in(parent);
        let known: Vec<_> = known.into_iter().map(|(name, _)| name).collect();
        let nearest = nearest_word(self.name(element), known.iter().copied());
        let mut places = [("xml", &IN_ROOT[..]), ("scene", &IN_SCENE)].into_iter();
        let place = places.find(|(_, words)| words.contains(&self.name(element)));
        let hint = match (place, nearest) {
            (Some((place, _)), _) => format!("it is skipped; it belongs in `{place}`"),
            (None, None) => "it is ignored, with all that is in it".to_owned(),
            (None, Some(_)) => SKIPPED.to_owned(),
        };
        let expected = listed(&known, "no elements");
        let message = || format!("{name}: unknown in {outer}");
        let nearest = nearest.filter(|_| place.is_none());
        let names = self.tree.elements[element].names();
        self.mistaken(&names, message, &expected, &hint, nearest);
    }

    /// The parameters of an element.
    fn parameters_in(&self, role: Role) -> &'static [&'static Parameter] {
        match role {
            Role::Node(Node::View) => CAMERA,
            Role::Node(node) => self.origins.get(node).map_or(&[], |at| at.kind.parameters),
            Role::Parameter(of) if of.may_have_texture => CHECKER,
            _ => &[],
        }
    }

    /// The known children of an element, and what they are.
    pub(super) fn known_in(&self, parent: usize) -> Vec<(&'static str, &'static str)> {
        let parent = self.origins.roles[parent];
        let parameters = self.parameters_in(parent).iter();
        let parameters = parameters.chain(transforms_in(parent));
        let others: &[_] = match parent {
            Role::Root => &IN_ROOT,
            Role::Scene => &IN_SCENE,
            Role::Node(Node::Object(_)) => &["object"],
            _ => &[],
        };
        parameters
            .map(|known| (known.element, known.field.doc))
            .chain(others.iter().map(|&name| (name, "")))
            .collect()
    }

    /// The known attributes of an element.
    pub(super) fn known_attributes(&self, element: usize) -> Vec<Named> {
        let single = |single: &'static Single| Named {
            name: single.attribute,
            field: &single.field,
            component: 0,
            default: single.missing(self.origins.transfer).to_owned(),
        };
        match self.origins.roles[element] {
            Role::Skipped | Role::Root | Role::Scene => Vec::new(),
            Role::Node(Node::Render) => settings(),
            Role::Node(Node::View) => vec![single(&GAMMA)],
            Role::Node(node) => {
                let class = node.category().and_then(|(category, _)| class_of(category));
                class
                    .map_or(&[][..], |class| class.words)
                    .iter()
                    .map(single)
                    .collect()
            }
            Role::Transform(parameter) | Role::Parameter(parameter) => {
                let is_turn = parameter.reading == Attributes::Rotation;
                let names = parameter.reading.attributes().iter().copied().enumerate();
                let numbers = names
                    .chain(is_turn.then_some((3, "value")))
                    .map(|(at, name)| {
                        let own = &parameter.field;
                        let is_own = at < own.kind.components();
                        Named {
                            name,
                            field: if is_own { own } else { &parameter.scaled },
                            component: at,
                            default: parameter.inside(name).to_owned(),
                        }
                    });
                let texture = parameter.may_have_texture.then(|| Named {
                    name: TEXTURE.key,
                    field: &TEXTURE,
                    component: 0,
                    default: String::new(),
                });
                let extras = parameter.extras.iter().copied().map(single);
                numbers.chain(extras).chain(texture).collect()
            }
        }
    }

    /// Warns of a parameter overridden by a later one.
    fn repeated(&mut self, element: usize) {
        let name = self.display_name(element);
        let message = || format!("{name}: given again below");
        let hint = "the last one counts";
        self.warn(self.place(element), message, "each parameter once", hint);
    }

    /// Warns of attributes that are not known here.
    fn check_attributes(&mut self, element: usize, role: Role) {
        // Render settings are checked where they are read.
        if matches!(role, Role::Skipped | Role::Node(Node::Render)) {
            return;
        }
        let known = self.known_attributes(element).into_iter();
        let known: Vec<_> = known.map(|known| known.name).collect();
        for at in self.tree.elements[element].attributes() {
            let place = self.tree.attributes[at].name;
            let word = place.of(self.text);
            if known.contains(&word) {
                continue;
            }
            let name = quoted(self.name(element));
            let nearest = nearest_word(word, known.iter().copied());
            let expected = listed(&known, "no attribute");
            let message = || format!("attribute {}: unknown in {name}", quoted(word));
            self.mistaken(&[place], message, &expected, SKIPPED, nearest);
        }
    }

    /// Warns of a word at these places, the first of which is shown. `hint` says what becomes of it, and
    /// `nearest` is the word that was probably meant.
    fn mistaken(
        &mut self,
        places: &[Span],
        message: impl FnOnce() -> String,
        expected: &str,
        hint: &str,
        nearest: Option<&str>,
    ) {
        self.report.warning(|| {
            let question = nearest.map(|word| format!("; did you mean `{word}`?"));
            let hint = format!("{hint}{}", question.unwrap_or_default());
            let warning = Diagnostic::warning(places[0], message(), expected).with_hint(hint);
            let fixes = places.iter().zip(nearest.iter().cycle());
            fixes.fold(warning, |all, (place, word)| all.with_fix(*place, *word))
        });
    }

    /// Warns of text between tags.
    fn check_words(&mut self) {
        for &(span, element) in &self.tree.words {
            let role = self.origins.roles[element as usize];
            let hint = match role {
                Role::Skipped => continue,
                Role::Parameter(Parameter {
                    reading: Attributes::Number,
                    element,
                    ..
                }) => format!("values are attributes: <{element} value=\"1\"/>"),
                _ => SKIPPED.to_owned(),
            };
            self.report.warning(|| {
                let message = format!(
                    "{}: text between tags has no meaning",
                    quoted(span.of(self.text))
                );
                Diagnostic::warning(span, message, "elements").with_hint(hint)
            });
        }
    }
}

/// Known words, for a message.
fn listed(known: &[&str], none: &str) -> String {
    if known.is_empty() {
        none.to_owned()
    } else {
        known.join(", ")
    }
}

/// The transforms of an element.
fn transforms_in(role: Role) -> &'static [&'static Parameter] {
    match role {
        Role::Node(Node::Object(_)) => TRANSFORMS,
        Role::Parameter(of) if of.may_have_texture => TRANSFORMS,
        _ => &[],
    }
}

/// A name for display in messages and lists, truncated if long.
fn shown(name: &str) -> Box<str> {
    const LONGEST: usize = 48;
    let mut shown: String = name.chars().take(LONGEST).collect();
    if name.chars().nth(LONGEST).is_some() {
        shown.push('…');
    }
    visible(&shown).into()
}
