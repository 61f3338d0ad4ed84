//! The roles of elements and attributes, by their names and parents.

use std::collections::HashMap;

use super::Lowering;
use crate::report::quoted;
use crate::xml::origins::{NO_WORD, Place, Role, WORDS};
use crate::xml::table::{
    Attributes, BACKGROUND, CHECKER, ENVIRONMENT, LightKind, MaterialKind, ObjectKind, Parameter,
    TRANSFORMS, Texturing, camera,
};
use text::{Diagnostic, Span, nearest_word, visible};

/// The elements known in `xml` and in `scene`.
const IN_ROOT: [&str; 3] = ["scene", "camera", "render"];
const IN_SCENE: [&str; 5] = ["object", "material", "light", "background", "environment"];

impl<'a> Lowering<'a> {
    /// Gives every element its role and every attribute its word. Unknown elements are skipped with
    /// a warning, and their content without.
    pub(super) fn find_roles(&mut self) {
        let tree = self.tree;
        self.origins.words = tree
            .attributes
            .iter()
            .map(|attribute| {
                let name = attribute.name.of(self.text);
                WORDS
                    .iter()
                    .position(|word| *word == name)
                    .map_or(NO_WORD, |at| at as u8)
            })
            .collect();
        let mut parameters: HashMap<(u32, &'static str), usize> = HashMap::new();
        for element in 0..tree.elements.len() {
            let parent = tree.elements[element].parent;
            let role = match parent {
                None => self.root(element),
                Some(parent) => self.child(element, parent as usize),
            };
            let owner = match (role, parent) {
                (Role::Parameter(_) | Role::Transform(_) | Role::Skipped, Some(parent)) => {
                    match self.origins.roles[parent as usize] {
                        Role::Scene | Role::Root => element as u32,
                        _ => self.origins.owners[parent as usize],
                    }
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
        let found = match self.origins.roles[parent] {
            Role::Skipped => return Role::Skipped,
            Role::Root if is("scene") => {
                return self.once(element, Role::Scene);
            }
            Role::Root if is("camera") => return self.once(element, Role::Camera),
            Role::Root if is("render") => return self.once(element, Role::Render),
            Role::Scene | Role::Object(_) if is("object") => Some(self.object(element)),
            Role::Scene if is("material") => Some(self.material_place(element)),
            Role::Scene if is("light") => self.light_place(element).or(Some(Role::Skipped)),
            Role::Scene if is("background") => Some(Role::Parameter(&BACKGROUND)),
            Role::Scene if is("environment") => Some(Role::Parameter(&ENVIRONMENT)),
            outer => among(self.parameters_in(outer))
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
            Role::Render => &mut self.origins.render,
            _ => &mut self.origins.camera,
        };
        if place.is_none() {
            *place = Some(element);
            return role;
        }
        let name = quoted(self.name(element));
        let message = || format!("{name}: already given");
        self.warn(
            self.place(element),
            message,
            "only one",
            "this one is skipped",
        );
        Role::Skipped
    }

    fn object(&mut self, element: usize) -> Role {
        let kind = self.kind(
            element,
            ObjectKind::of,
            ObjectKind::TYPES,
            "it is treated as a group",
        );
        let depth = match self.tree.elements[element].parent {
            Some(parent) => match self.origins.roles[parent as usize] {
                Role::Object(outer) => self.origins.objects[outer as usize].depth + 1,
                _ => 0,
            },
            None => 0,
        };
        let index = self.origins.objects.len() as u32;
        let place = self.place_of(element, kind.unwrap_or(ObjectKind::Group), depth);
        self.origins.objects.push(place);
        Role::Object(index)
    }

    fn material_place(&mut self, element: usize) -> Role {
        let kind = self.kind(
            element,
            MaterialKind::of,
            MaterialKind::TYPES,
            "it is treated as blinn",
        );
        let kind = kind.unwrap_or(MaterialKind::Blinn);
        let index = self.origins.materials.len();
        let name = self.word(element, "name");
        let place = self.place_of(element, kind, 0);
        self.origins.materials.push(place);
        if let Some(name) = name
            && let Some(before) = self.named.insert(name, index)
        {
            let first = self.origins.materials[before].element as usize;
            let span = self
                .origins
                .value(self.tree, first, "name")
                .map(|at| at.value);
            let message = || format!("{}: another material has this name", quoted(name));
            let hint = "the last one counts";
            self.warn(span.unwrap_or_default(), message, "a unique name", hint);
        }
        Role::Material(index as u32)
    }

    fn light_place(&mut self, element: usize) -> Option<Role> {
        let kind = self.kind(
            element,
            LightKind::of,
            LightKind::TYPES,
            "the light is skipped",
        );
        if self.origins.value(self.tree, element, "type").is_none() {
            let expected = "type=\"ambient\", \"direct\" or \"point\"";
            let message = || "light: no type".to_owned();
            self.warn(
                self.place(element),
                message,
                expected,
                "the light is skipped",
            );
        }
        let index = self.origins.lights.len() as u32;
        let place = self.place_of(element, kind?, 0);
        self.origins.lights.push(place);
        Some(Role::Light(index))
    }

    fn place_of<Kind>(&self, element: usize, kind: Kind, depth: u32) -> Place<Kind> {
        Place {
            element: element as u32,
            kind,
            name: self.word(element, "name").map(shown),
            depth,
        }
    }

    /// The kind given by an element's `type`; `None` if missing or unknown.
    fn kind<Kind>(
        &mut self,
        element: usize,
        of: impl Fn(&str) -> Option<Kind>,
        types: &'static [&'static str],
        otherwise: &str,
    ) -> Option<Kind> {
        let attribute = self.origins.value(self.tree, element, "type")?;
        let word = attribute.unescaped(self.text);
        let kind = of(word);
        if kind.is_none() {
            let name = self.name(element);
            let nearest = nearest_word(word, types.iter().copied());
            let hint = match nearest {
                Some(nearest) => format!("{otherwise}; did you mean `{nearest}`?"),
                None => otherwise.to_owned(),
            };
            let message = || format!("{name}: unknown type {}", quoted(word));
            self.warn(attribute.value, message, &types.join(" or "), &hint);
        }
        kind
    }

    fn unknown(&mut self, element: usize, parent: usize) {
        let (name, outer) = (quoted(self.name(element)), quoted(self.name(parent)));
        let known = self.known_in(parent);
        let nearest = nearest_word(self.name(element), known.iter().copied());
        let mut places = [("xml", &IN_ROOT[..]), ("scene", &IN_SCENE)].into_iter();
        let place = places.find(|(_, words)| words.contains(&self.name(element)));
        let hint = match (place, nearest) {
            (Some((place, _)), _) => format!("it is skipped; it belongs in `{place}`"),
            (None, Some(nearest)) => format!("it is skipped; did you mean `{nearest}`?"),
            (None, None) => "it is skipped with all its content".to_owned(),
        };
        let expected = if known.is_empty() {
            "nothing".to_owned()
        } else {
            known.join(", ")
        };
        let message = || format!("{name}: unknown in {outer}");
        self.warn(self.place(element), message, &expected, &hint);
    }

    /// The parameters of an element.
    fn parameters_in(&self, role: Role) -> &'static [&'static Parameter] {
        match role {
            Role::Camera => camera::PARAMETERS,
            Role::Light(index) => self.origins.lights[index as usize].kind.parameters(),
            Role::Material(index) => self.origins.materials[index as usize].kind.parameters(),
            Role::Parameter(of) if of.texture == Texturing::Yes => CHECKER,
            _ => &[],
        }
    }

    /// The known children of an element, for messages.
    fn known_in(&self, parent: usize) -> Vec<&'static str> {
        let parent = self.origins.roles[parent];
        let parameters = self.parameters_in(parent).iter();
        let parameters = parameters.chain(transforms_in(parent));
        let others: &[_] = match parent {
            Role::Root => &IN_ROOT,
            Role::Scene => &IN_SCENE,
            Role::Object(_) => &["object"],
            _ => &[],
        };
        parameters
            .map(|known| known.element)
            .chain(others.iter().copied())
            .collect()
    }

    /// Warns of a parameter overridden by a later one.
    fn repeated(&mut self, element: usize) {
        let name = self.display_name(element);
        let message = || format!("{name}: given again below");
        self.warn(
            self.place(element),
            message,
            "each parameter once",
            "the last one counts",
        );
    }

    /// Warns of attributes that are not known here.
    fn check_attributes(&mut self, element: usize, role: Role) {
        // Render settings are checked where they are read.
        if matches!(role, Role::Skipped | Role::Render) {
            return;
        }
        let known = known_attributes(role);
        for at in self.tree.elements[element].attributes() {
            let word = self.origins.words[at];
            let is_known = WORDS
                .get(usize::from(word))
                .is_some_and(|word| known.contains(word));
            if is_known {
                continue;
            }
            // From here on it counts as unknown.
            self.origins.words[at] = NO_WORD;
            let place = self.tree.attributes[at].name;
            let word = place.of(self.text);
            let name = quoted(self.name(element));
            let nearest = nearest_word(word, known.iter().copied());
            let hint = match nearest {
                Some(nearest) => format!("it is skipped; did you mean `{nearest}`?"),
                None => "it is skipped".to_owned(),
            };
            let expected = if known.is_empty() {
                "no attribute".to_owned()
            } else {
                known.join(", ")
            };
            let message = || format!("attribute {}: unknown in {name}", quoted(word));
            self.warn(place, message, &expected, &hint);
        }
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
                _ => "it is skipped".to_owned(),
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

/// The transforms of an element.
fn transforms_in(role: Role) -> &'static [&'static Parameter] {
    match role {
        Role::Object(_) => TRANSFORMS,
        Role::Parameter(of) if of.texture == Texturing::Yes => TRANSFORMS,
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

/// The known attributes of an element.
fn known_attributes(role: Role) -> Vec<&'static str> {
    match role {
        Role::Skipped | Role::Root | Role::Scene | Role::Render => Vec::new(),
        Role::Camera => vec!["gamma"],
        Role::Light(_) | Role::Material(_) => vec!["type", "name"],
        Role::Object(_) => vec!["type", "name", "material"],
        Role::Transform(parameter) | Role::Parameter(parameter) => {
            let mut known = parameter.reading.attributes().to_vec();
            if parameter.reading == Attributes::Rotation {
                known.push("value");
            }
            known.extend(parameter.extras.iter().map(|extra| extra.attribute));
            if parameter.texture == Texturing::Yes {
                known.push("texture");
            }
            known
        }
    }
}
