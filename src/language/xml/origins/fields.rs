//! The fields of each node, with their places or places for insertion.

use super::insert;
use super::{Origins, Role};
use crate::field_spans::{Component, FieldSpans, Insertion};
use crate::node::Node;
use crate::rendering;
use crate::xml::parameter::{Attributes, Parameter, Single};
use crate::xml::schema::{BACKGROUND, CAMERA, CHECKER, ENVIRONMENT, GAMMA, TEXTURE, class_of};
use crate::xml::tree::Tree;
use scene::{Integrator, Rendering, Transfer};

/// Maximum number of rows of a node; nobody reads more.
const MOST_ROWS: usize = 256;

/// The fields of a node.
pub(in crate::xml) fn of(
    text: &str,
    tree: &Tree,
    origins: &Origins,
    node: Node,
) -> Vec<FieldSpans> {
    let mut rows = Rows {
        text,
        origins,
        tree,
        placed: Vec::new(),
    };
    match node {
        Node::View => match (origins.camera, origins.root) {
            (Some(camera), _) => {
                for parameter in CAMERA {
                    rows.parameter(camera, parameter);
                }
                rows.single(camera, &GAMMA);
            }
            (None, Some(root)) => {
                let insertion = insert::in_camera(tree, root);
                for parameter in CAMERA {
                    rows.missing(parameter, insertion.clone());
                }
            }
            (None, None) => {}
        },
        Node::Render => {
            let place = origins.render.map(|_| &origins.settings);
            let insertion = match (origins.render, origins.root) {
                (Some(render), _) => insert::attribute(tree, render),
                (None, Some(root)) => insert::child(tree, root),
                (None, None) => return rows.placed,
            };
            let element = place.is_none().then_some("render");
            let defaults = of_gamma(origins.transfer);
            rows.placed = rendering::fields(place, &defaults, &insertion, element);
        }
        Node::Background => rows.of_scene(&BACKGROUND),
        Node::Environment => rows.of_scene(&ENVIRONMENT),
        _ => rows.thing(node),
    }
    rows.placed
}

/// The render settings that the camera's `gamma` asks for.
pub(in crate::xml) fn of_gamma(gamma: Transfer) -> Rendering {
    match gamma {
        Transfer::Linear => Rendering::default(),
        Transfer::Srgb => Rendering {
            integrator: Some(Integrator::Path),
            transfer: Some(Transfer::Srgb),
            ..Rendering::default()
        },
    }
}

struct Rows<'a> {
    text: &'a str,
    origins: &'a Origins,
    tree: &'a Tree,
    placed: Vec<FieldSpans>,
}

impl Rows<'_> {
    /// Adds the fields of a light, a material or an object.
    fn thing(&mut self, node: Node) {
        let (Some(place), Some((category, _))) = (self.origins.get(node), node.category()) else {
            return;
        };
        let element = place.element as usize;
        for word in class_of(category).map_or(&[][..], |class| class.words) {
            self.single(element, word);
        }
        for parameter in place.kind.parameters {
            self.parameter(element, parameter);
        }
        self.transforms(element);
    }

    fn of_scene(&mut self, parameter: &'static Parameter) {
        if let Some(scene) = self.origins.scene {
            self.parameter(scene, parameter);
        }
    }

    /// Adds an attribute that is a field of its own.
    fn single(&mut self, element: usize, single: &'static Single) {
        let default = single.missing(self.origins.transfer);
        let own = component((self.text, self.tree), element, single.attribute, default);
        let insertion = insert::attribute(self.tree, element);
        let placed = FieldSpans::with_defaults(&single.field, vec![own], None, insertion);
        self.placed.push(placed);
    }

    fn parameter(&mut self, holder: usize, parameter: &'static Parameter) {
        match self.origins.parameter(self.tree, holder, parameter) {
            Some(element) => self.explicit(element, parameter),
            None => self.missing(parameter, insert::child(self.tree, holder)),
        }
    }

    /// Adds a parameter whose element exists, with its textures.
    fn explicit(&mut self, element: usize, parameter: &'static Parameter) {
        let mut pending = vec![(element, parameter)];
        while let Some((element, parameter)) = pending.pop() {
            if MOST_ROWS < self.placed.len() {
                return;
            }
            self.placed
                .push(numbers(self.text, self.tree, element, parameter));
            for extra in parameter.extras {
                self.single(element, extra);
            }
            let texture = self.tree.attribute(self.text, element, "texture");
            let Some(texture) = texture.filter(|_| parameter.may_have_texture) else {
                continue;
            };
            self.placed
                .push(FieldSpans::explicit(&TEXTURE, vec![texture.value]));
            self.transforms(element);
            let colours = CHECKER.iter().copied().rev();
            pending.extend(colours.filter_map(|colour| {
                let element = self.origins.parameter(self.tree, element, colour)?;
                Some((element, colour))
            }));
        }
    }

    fn transforms(&mut self, holder: usize) {
        for child in self.tree.children(holder) {
            if MOST_ROWS < self.placed.len() {
                return;
            }
            if let Some(Role::Transform(parameter)) = self.origins.roles.get(child) {
                self.placed
                    .push(numbers(self.text, self.tree, child, parameter));
            }
        }
    }

    /// Adds a parameter whose element is missing.
    fn missing(&mut self, parameter: &'static Parameter, insertion: Insertion) {
        let names = parameter.reading.attributes().iter();
        let components = names.zip(parameter.missing);
        let components = components.map(|(&name, &default)| Component {
            name,
            place: None,
            default: default.into(),
            is_required: default != parameter.inside,
        });
        let (components, element) = (components.collect(), Some(parameter.element));
        let field = &parameter.field;
        let placed = FieldSpans::with_defaults(field, components, element, insertion);
        self.placed.push(placed);
    }
}

/// The attribute of an element with this name.
fn component(
    (text, tree): (&str, &Tree),
    element: usize,
    name: &'static str,
    default: &'static str,
) -> Component {
    let attribute = tree.attribute(text, element, name);
    Component {
        name,
        place: attribute.map(|attribute| attribute.value),
        default: default.into(),
        is_required: false,
    }
}

/// The numbers of an existing element.
pub(in crate::xml) fn numbers(
    text: &str,
    tree: &Tree,
    element: usize,
    parameter: &'static Parameter,
) -> FieldSpans {
    let read = |name| component((text, tree), element, name, parameter.inside(name));
    let names = parameter.reading.attributes().iter();
    let mut components: Vec<_> = names.map(|&name| read(name)).collect();
    let mut own = &parameter.field;
    match parameter.reading {
        // It stands in for a missing `angle`.
        Attributes::Rotation if components[3].place.is_none() => {
            components[3].place = read("value").place;
        }
        Attributes::Vector | Attributes::Colour if components[3].place.is_none() => {
            components.truncate(3);
        }
        Attributes::Vector | Attributes::Colour => own = &parameter.scaled,
        Attributes::Number | Attributes::Rotation => {}
    }
    FieldSpans::with_defaults(own, components, None, insert::attribute(tree, element))
}
