//! The fields of each node, with their places or places for insertion.

use super::insert;
use super::{Origins, Role};
use crate::field_spans::{FieldSpans, Implicit, ImplicitAttribute, Insertion};
use crate::node::Node;
use crate::rendering;
use crate::schema::Field;
use crate::xml::table::{
    Attributes, BACKGROUND, CHECKER, ENVIRONMENT, LIGHT_WORDS, MATERIAL_WORDS, OBJECT, Parameter,
    TEXTURE, Texturing, Word, camera,
};
use crate::xml::tree::Tree;
use scene::{Integrator, Rendering, Transfer};
use text::Span;

/// Maximum number of rows of a node; nobody reads more.
const MOST_ROWS: usize = 256;

/// The fields of a node.
pub(in crate::xml) fn of(origins: &Origins, tree: &Tree, node: Node) -> Vec<FieldSpans> {
    let mut rows = Rows {
        origins,
        tree,
        placed: Vec::new(),
    };
    match node {
        Node::View => {
            for parameter in camera::PARAMETERS {
                rows.parameter(Holder::camera(origins), parameter);
            }
            if let Some(element) = origins.camera {
                rows.word(element, &camera::GAMMA);
            }
        }
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
        Node::Background => rows.parameter(origins.scene.map(Holder::There), &BACKGROUND),
        Node::Environment => rows.parameter(origins.scene.map(Holder::There), &ENVIRONMENT),
        Node::Light(index) => {
            if let Some(light) = origins.lights.get(index) {
                rows.thing(
                    light.element as usize,
                    &LIGHT_WORDS,
                    light.kind.parameters(),
                );
            }
        }
        Node::Material(index) => {
            if let Some(material) = origins.materials.get(index) {
                let parameters = material.kind.parameters();
                rows.thing(material.element as usize, &MATERIAL_WORDS, parameters);
            }
        }
        Node::Object(index) => {
            if let Some(object) = origins.objects.get(index) {
                rows.thing(object.element as usize, &OBJECT, &[]);
                rows.transforms(object.element as usize);
            }
        }
        Node::Ambient | Node::Texture(_) => {}
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

/// The parent of a parameter.
#[derive(Clone, Copy)]
enum Holder {
    There(usize),
    /// A missing child of this element, by its tags.
    Missing(usize, &'static str, &'static str),
}

impl Holder {
    fn camera(origins: &Origins) -> Option<Self> {
        match (origins.camera, origins.root) {
            (Some(camera), _) => Some(Self::There(camera)),
            (None, Some(root)) => Some(Self::Missing(root, "<camera>", "</camera>")),
            (None, None) => None,
        }
    }
}

struct Rows<'a> {
    origins: &'a Origins,
    tree: &'a Tree,
    placed: Vec<FieldSpans>,
}

impl Rows<'_> {
    fn thing(&mut self, element: usize, words: &'static [Word], parameters: &[&'static Parameter]) {
        for word in words {
            self.word(element, word);
        }
        for parameter in parameters {
            self.parameter(Some(Holder::There(element)), parameter);
        }
    }

    /// Adds an attribute whose value is a word.
    fn word(&mut self, element: usize, word: &'static Word) {
        let field = &word.field;
        if let Some(attribute) = self.origins.value(self.tree, element, field.key) {
            self.placed
                .push(FieldSpans::explicit(field, vec![attribute.value]));
            return;
        }
        let insertion = insert::attribute(self.tree, element);
        self.placed.push(FieldSpans {
            field,
            spans: vec![insertion.span],
            implicit: Some(Box::new(Implicit {
                defaults: vec![Some(word.missing.into())],
                attributes: vec![ImplicitAttribute {
                    component: 0,
                    name: field.key,
                    default: word.missing.into(),
                    is_required: false,
                }],
                element: None,
                insertion,
                limit: None,
            })),
        });
    }

    fn parameter(&mut self, holder: Option<Holder>, parameter: &'static Parameter) {
        let Some(holder) = holder else { return };
        let element = match holder {
            Holder::There(holder) => self.origins.parameter(self.tree, holder, parameter),
            Holder::Missing(..) => None,
        };
        match element {
            Some(element) => self.explicit(element, parameter),
            None => self.missing(holder, parameter),
        }
    }

    /// Adds a parameter whose element exists, with its textures.
    fn explicit(&mut self, element: usize, parameter: &'static Parameter) {
        let mut pending = vec![(element, parameter)];
        while let Some((element, parameter)) = pending.pop() {
            if MOST_ROWS < self.placed.len() {
                return;
            }
            self.numbers(element, parameter);
            for extra in parameter.extras {
                let insertion = insert::attribute(self.tree, element);
                let place = self.origins.attribute(self.tree, element, extra.attribute);
                let missing = extra.missing(self.origins.transfer);
                let attribute = (extra.attribute, place, missing);
                self.attributes(&extra.field, &[attribute], &insertion);
            }
            let Some(texture) = self.texture(element, parameter) else {
                continue;
            };
            self.placed
                .push(FieldSpans::explicit(&TEXTURE, vec![texture]));
            self.transforms(element);
            let colours = CHECKER.iter().copied().rev();
            pending.extend(colours.filter_map(|colour| {
                let element = self.origins.parameter(self.tree, element, colour)?;
                Some((element, colour))
            }));
        }
    }

    /// The place of a parameter's texture.
    fn texture(&self, element: usize, parameter: &Parameter) -> Option<Span> {
        let may = parameter.texture == Texturing::Yes;
        let attribute = self
            .origins
            .value(self.tree, element, "texture")
            .filter(|_| may);
        attribute.map(|attribute| attribute.value)
    }

    fn transforms(&mut self, holder: usize) {
        for child in self.tree.children(holder) {
            if MOST_ROWS < self.placed.len() {
                return;
            }
            if let Some(Role::Transform(parameter)) = self.origins.roles.get(child) {
                self.numbers(child, parameter);
            }
        }
    }

    /// Adds the numbers of an existing element.
    fn numbers(&mut self, element: usize, parameter: &'static Parameter) {
        let find = |name: &str| self.origins.attribute(self.tree, element, name);
        let names = parameter.reading.attributes();
        let mut attributes: Vec<_> = names
            .iter()
            .map(|&name| (name, find(name), parameter.inside(name)))
            .collect();
        let mut field = &parameter.field;
        match parameter.reading {
            // It stands in for a missing `angle`.
            Attributes::Rotation if attributes[3].1.is_none() => attributes[3].1 = find("value"),
            Attributes::Vector | Attributes::Colour if attributes[3].1.is_none() => {
                attributes.truncate(3);
            }
            Attributes::Vector | Attributes::Colour => field = &parameter.scaled,
            Attributes::Number | Attributes::Rotation => {}
        }
        self.attributes(field, &attributes, &insert::attribute(self.tree, element));
    }

    /// Adds a field whose components are attributes of one element, given their names, places and
    /// defaults.
    fn attributes(
        &mut self,
        field: &'static Field,
        attributes: &[(&'static str, Option<usize>, &'static str)],
        insertion: &Insertion,
    ) {
        let place = |&(_, explicit, _): &(_, Option<usize>, _)| {
            explicit.map_or(insertion.span, |at| self.tree.attributes[at].value)
        };
        let spans = attributes.iter().map(place).collect();
        let is_explicit = attributes.iter().all(|(_, explicit, _)| explicit.is_some());
        let implicit = || {
            let missing = attributes.iter().enumerate();
            let missing = missing.filter(|(_, (_, explicit, _))| explicit.is_none());
            Box::new(Implicit {
                defaults: attributes
                    .iter()
                    .map(|&(_, explicit, default)| explicit.is_none().then(|| default.into()))
                    .collect(),
                attributes: missing
                    .map(|(component, &(name, _, default))| ImplicitAttribute {
                        component,
                        name,
                        default: default.into(),
                        is_required: false,
                    })
                    .collect(),
                element: None,
                insertion: insertion.clone(),
                limit: None,
            })
        };
        self.placed.push(FieldSpans {
            field,
            spans,
            implicit: (!is_explicit).then(implicit),
        });
    }

    /// Adds a parameter whose element is missing.
    fn missing(&mut self, holder: Holder, parameter: &'static Parameter) {
        let insertion = match holder {
            Holder::There(holder) => insert::child(self.tree, holder),
            Holder::Missing(outer, open, close) => {
                insert::grandchild(self.tree, outer, open, close)
            }
        };
        let names = parameter.reading.attributes();
        let attributes = names.iter().zip(parameter.missing).enumerate();
        self.placed.push(FieldSpans {
            field: &parameter.field,
            spans: vec![Span::at(insertion.span.start()); parameter.missing.len()],
            implicit: Some(Box::new(Implicit {
                defaults: parameter
                    .missing
                    .iter()
                    .map(|&missing| Some(missing.into()))
                    .collect(),
                attributes: attributes
                    .map(|(component, (&name, &default))| ImplicitAttribute {
                        component,
                        name,
                        default: default.into(),
                        is_required: default != parameter.inside,
                    })
                    .collect(),
                element: Some(parameter.element),
                insertion,
                limit: None,
            })),
        });
    }
}
