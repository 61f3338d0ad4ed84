//! What a conversion to another language cannot keep, each at its place in the text.

use std::borrow::Cow;
use std::collections::{HashMap, HashSet};

use super::{Language, Node, Source};
use geometry::Shape;
use scene::Scene;
use text::{Diagnostic, Findings, Span};

/// Something that the target cannot hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Loss {
    /// The keys of the fields that state it, in any language; the first that the node has counts.
    pub(super) keys: &'static [&'static str],
    /// What is lost, as a noun phrase.
    pub(super) lost: &'static str,
    /// What is written instead: the nearest that the target can hold.
    pub(super) instead: &'static str,
}

/// What of the scene loses something.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Of {
    /// The camera.
    View,
    /// How brightly lights shine by path tracing.
    Gamma,
    /// The background of camera rays.
    Background,
    /// The surroundings of other rays.
    Environment,
    /// Ambient light.
    Ambient,
    /// A light, by index in the scene.
    Light(usize),
    /// A material, by index in the scene.
    Material(u32),
    /// An object, by index in the scene.
    Object(usize),
}

/// The losses of a conversion.
#[derive(Debug)]
pub(super) struct Losses<'a> {
    source: &'a Source,
    to: Language,
    findings: Findings,
    lossy: HashSet<Of>,
    /// The first object with each material; `None` if no object has it.
    users: Vec<Option<u32>>,
    /// The number of objects written for an object, where it is not one.
    pieces: HashMap<usize, usize>,
}

impl<'a> Losses<'a> {
    /// No losses yet.
    pub(super) fn new(source: &'a Source, scene: &Scene, to: Language) -> Self {
        let mut users = vec![None; scene.materials.len()];
        for (number, object) in (0..).zip(scene.objects.iter()) {
            let mut uses = |material: u32| {
                if let Some(user) = users.get_mut(material as usize) {
                    user.get_or_insert(number);
                }
            };
            uses(object.material);
            if let Shape::Csg(csg) = &object.shape {
                csg.tags().for_each(uses);
            }
        }
        Self {
            source,
            to,
            findings: Findings::default(),
            lossy: HashSet::new(),
            users,
            pieces: HashMap::new(),
        }
    }

    /// Whether an object has the material. What no object has is no loss.
    pub(super) fn is_used(&self, material: usize) -> bool {
        self.users.get(material).is_some_and(Option::is_some)
    }

    /// Reports a loss, unless it is that of an unused material.
    pub(super) fn add(&mut self, of: Of, loss: &Loss) {
        if let Of::Material(material) = of
            && !self.is_used(material as usize)
        {
            return;
        }
        self.lossy.insert(of);
        let (source, to) = (self.source, self.to.extension());
        let node = self.node(of);
        self.findings.warning(|| {
            let message = format!("{}: {}", source.name(node), loss.lost);
            let span = place(source, node, loss.keys);
            Diagnostic::warning(span, message, format!("not in .{to}")).with_hint(loss.instead)
        });
    }

    /// Whether something of it is lost.
    pub(super) fn has(&self, of: Of) -> bool {
        self.lossy.contains(&of)
    }

    /// Notes how many objects stand for an object.
    pub(super) fn stand_in(&mut self, object: usize, pieces: usize) {
        if pieces != 1 {
            self.pieces.insert(object, pieces);
        }
    }

    /// The number of objects that stand for an object.
    pub(super) fn pieces(&self, object: usize) -> usize {
        self.pieces.get(&object).copied().unwrap_or(1)
    }

    /// The losses, in the order of the text.
    pub(super) fn into_findings(self) -> Findings {
        self.findings.sorted()
    }

    /// The name or comment that the text gives it, in one line.
    pub(super) fn label(&self, of: Of) -> Option<Cow<'a, str>> {
        let node = self.node(of);
        let source = self.source;
        let named = match source.language() {
            Language::Xml => own_name(source, node).map(Cow::Owned),
            Language::Ray | Language::Dat | Language::Cse167 => None,
        };
        let label = named.or_else(|| source.comment(node).map(Cow::Borrowed))?;
        let is_plain = !label.contains(char::is_control);
        let label = if is_plain {
            label
        } else {
            Cow::Owned(label.replace(char::is_control, " "))
        };
        // These words begin comments with a meaning.
        let has_meaning = ["view", "render"].iter().any(|word| {
            let start = label.get(..word.len());
            start.is_some_and(|start| start.eq_ignore_ascii_case(word))
        });
        (!has_meaning && !label.trim().is_empty()).then_some(label)
    }

    /// The node that states it. A material that is no node of its own belongs to its first object.
    fn node(&self, of: Of) -> Node {
        let object = |object: u32| Node::Object(self.source.object(object));
        match of {
            Of::View | Of::Gamma => Node::View,
            Of::Background => Node::Background,
            Of::Environment => Node::Environment,
            Of::Ambient => Node::Ambient,
            Of::Light(light) => Node::Light(light),
            Of::Object(index) => object(index as u32),
            Of::Material(material) => {
                let index = material as usize;
                let is_listed = index < self.source.nodes().materials;
                let user = self.users.get(index).copied().flatten();
                match user {
                    Some(user) if !is_listed => object(user),
                    _ => Node::Material(index),
                }
            }
        }
    }
}

/// The first field with one of these keys that the text states, otherwise the whole node.
fn place(source: &Source, node: Node, keys: &[&str]) -> Span {
    let fields = source.fields(node);
    let field = keys.iter().find_map(|key| {
        let stated = |placed: &&super::FieldSpans| placed.field.key == *key && placed.is_explicit();
        let placed = fields.iter().find(stated)?;
        let whole = |at: &usize| placed.default_of(*at).is_none();
        let spans = (0..placed.spans.len()).filter(whole);
        spans.map(|at| placed.spans[at]).reduce(Span::to)
    });
    field.unwrap_or_else(|| source.span(node))
}

/// The name of a node, if the text gives it one: `ball` of `ball (sphere)`.
fn own_name(source: &Source, node: Node) -> Option<String> {
    let shown = source.name(node);
    let (name, _) = shown.rsplit_once(" (")?;
    (name != node.to_string()).then(|| name.to_owned())
}
