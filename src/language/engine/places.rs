//! The places of the nodes of a text: each in one record, and further records by which it uses others.

use super::Language;
use super::identities::slots;
use super::lines::Lines;
use crate::field_spans::FieldSpans;
use crate::node::Node;
use crate::rendering::RenderPlace;
use crate::schema::{Category, Makes, Record, Slot};

/// The places of everything lowered, as indices of records: valid only with the lines they were made
/// from.
#[derive(Clone, Debug, Default)]
pub(crate) struct Places<Own> {
    /// The records of the view, in the order of the table.
    pub(crate) view: Vec<Option<usize>>,
    /// The comment of the render settings.
    pub(crate) settings: Option<RenderPlace>,
    /// The nodes of each category.
    nodes: [Vec<Place>; 4],
    /// The uses of nodes by others, each place once.
    pub(crate) uses: Vec<Place>,
    /// The list of what is drawn.
    pub(crate) list: Option<usize>,
    /// The drawn objects, ascending: those of the scene.
    pub(crate) drawn: Vec<usize>,
    /// What the text says besides its nodes.
    pub(crate) own: Own,
}

/// The place of a node, or of its use of others.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    pub(crate) record: &'static Record,
    /// Index of the record, the first if it has several.
    pub(crate) at: usize,
    /// Index of the last record.
    pub(crate) end: usize,
    /// Its ID; 0 if it has none.
    pub(crate) id: i64,
    /// The nodes that it refers to, as far as it does.
    pub(crate) refers: [Option<Node>; 2],
}

/// The place of a node without a record of its own.
pub(crate) const NOWHERE: usize = usize::MAX;

impl Place {
    /// The nodes it refers to.
    pub(crate) fn references(&self) -> impl Iterator<Item = Node> + use<> {
        self.refers.into_iter().flatten()
    }

    /// The indices of the nodes of a category that it refers to.
    pub(crate) fn of(&self, category: Category) -> impl Iterator<Item = usize> + use<> {
        let known = self.references().filter_map(Node::category);
        known.filter_map(move |(of, index)| (of == category).then_some(index))
    }

    /// The node that it is a use by, or that it states a part of.
    pub(crate) fn user(&self) -> Option<Node> {
        match self.record.makes {
            Makes::Use(category) => self.of(category).next().map(|at| Node::of(category, at)),
            Makes::State => self.references().next(),
            _ => None,
        }
    }
}

impl<Own> Places<Own> {
    /// The places of the nodes of a category.
    pub(crate) fn of(&self, category: Category) -> &[Place] {
        &self.nodes[category as usize]
    }

    /// Adds a node.
    pub(crate) fn push(&mut self, category: Category, place: Place) {
        self.nodes[category as usize].push(place);
    }

    /// Notes the last record of a node of a category.
    pub(crate) fn end(&mut self, category: Category, index: usize, end: usize) {
        if let Some(place) = self.nodes[category as usize].get_mut(index) {
            place.end = end;
        }
    }

    /// Notes the node that one of a category refers to.
    pub(crate) fn refer(&mut self, category: Category, index: usize, to: Node) {
        if let Some(place) = self.nodes[category as usize].get_mut(index) {
            place.refers[0] = Some(to);
        }
    }

    /// The place of a node of a category.
    pub(crate) fn get(&self, node: Node) -> Option<&Place> {
        let (category, index) = node.category()?;
        self.of(category).get(index)
    }

    /// The objects.
    pub(crate) fn objects(&self) -> &[Place] {
        self.of(Category::Object)
    }

    /// The records of a node, with their indices.
    pub(crate) fn records<L: Language>(
        &self,
        node: Node,
    ) -> impl Iterator<Item = (usize, &'static Record)> {
        let view = self.view.iter().zip(L::SCHEMA.view());
        let view = view.filter_map(|(at, record)| Some(((*at)?, record)));
        let own = self.get(node).into_iter();
        let uses = self.uses.iter();
        let own = own.filter(|place| place.at != NOWHERE);
        let own = own.chain(uses.filter(move |place| place.user() == Some(node)));
        let view = view.filter(move |_| node == Node::View);
        view.chain(own.map(|place| (place.at, place.record)))
    }

    /// The node that a record belongs to.
    pub(crate) fn node_of(&self, record: usize) -> Option<Node> {
        if self.view.contains(&Some(record)) {
            return Some(Node::View);
        }
        let holds = |place: &Place| (place.at..=place.end).contains(&record);
        let own = Category::ALL.into_iter().find_map(|category| {
            let places = self.of(category);
            let after = places.partition_point(|place| place.at <= record);
            let last = after.checked_sub(1)?;
            holds(&places[last]).then(|| Node::of(category, last))
        });
        let used = || self.uses.iter().find(|place| holds(place))?.user();
        // Those that state lines belong to are in another order.
        let stated = || {
            let places = self.of(Category::Material);
            let stated = places.iter().position(holds)?;
            Some(Node::Material(stated))
        };
        own.or_else(used).or_else(stated)
    }
}

/// Distributes the tokens of a record to its fields, until one is incomplete.
pub(crate) fn fields<L: Language>(
    text: &str,
    lines: &Lines<L>,
    (at, record): (usize, &'static Record),
) -> Vec<FieldSpans> {
    let slots = slots(record, text, lines.tokens(text, at)).into_iter();
    let fields = slots.filter_map(|(slot, spans)| match slot {
        Slot::Field(field) => Some(FieldSpans::explicit(field, spans)),
        Slot::Word(_) | Slot::Id => None,
    });
    fields.collect()
}
