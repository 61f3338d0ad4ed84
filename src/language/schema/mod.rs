//! What a language of records is made of: its kinds of records, their slots, and the fields in them.
//!
//! Each language has one table of its records. Reading takes its grammar from it, the editor its
//! names, ranges and steps, and motions what its numbers are in space: no second list of the fields
//! of a node exists. A table knows neither text nor values.

mod field;
pub(crate) mod layout;
pub(crate) mod position;
pub(crate) mod slots;

use layout::Layout;
use position::{At, is_same};

pub use field::{Category, Field, Kind, Named, Part, Range, SIZES};
pub use layout::Unit;

/// A kind of record. Two of one name are the same.
#[derive(Debug)]
pub struct Record {
    /// The word for it, unique in its language: `sphere`.
    pub name: &'static str,
    /// The words that begin it. Records that begin alike are told apart by the words in their slots.
    pub heads: &'static [&'static str],
    /// What such a record makes.
    pub makes: Makes,
    /// What follows the words, in order.
    pub slots: &'static [Slot],
    /// What follows that, as often as the record says.
    pub repeat: Option<Repeat>,
    /// Whether a later one replaces it without a warning.
    pub is_replaced: bool,
    /// Where its numbers place a unit solid; `None` for other records.
    pub(crate) layout: Option<Layout>,
}

/// What a record makes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Makes {
    /// A part of the view, which a scene has once.
    View,
    /// A node.
    Node(Category),
    /// An object that is a unit solid, placed.
    Solid(Unit),
    /// The use of other nodes by the node of this category that it refers to.
    Use(Category),
    /// The list of the objects that are drawn, which a scene has once.
    List,
    /// What holds for the records behind it, or anything else that is no node.
    State,
}

/// A part of a record.
#[derive(Clone, Copy, Debug)]
pub enum Slot {
    /// A fixed word.
    Word(&'static str),
    /// The ID by which other records refer to this one.
    Id,
    /// A field.
    Field(Field),
}

/// Slots that follow their count.
#[derive(Clone, Copy, Debug)]
pub struct Repeat {
    /// The noun for one.
    pub noun: &'static str,
    /// The slots of each.
    pub slots: &'static [Slot],
    /// The maximum of their number.
    pub most: usize,
    /// What none stands for.
    pub none: &'static str,
    /// What each takes, in a sentence.
    pub hint: &'static str,
}

/// The records of a language.
#[derive(Debug)]
pub struct Schema {
    /// The extension of its files, without the dot.
    pub extension: &'static str,
    /// The noun for a record.
    pub noun: &'static str,
    /// Whether a record that breaks off is reported at its first word rather than at its end.
    pub is_short_at_head: bool,
    /// Whether words may be in another case, with a warning.
    pub any_case: bool,
    /// Its records, in the order of messages and of the view.
    pub records: &'static [&'static Record],
}

impl Slot {
    /// The number of tokens.
    pub const fn tokens(&self) -> usize {
        match self {
            Self::Word(_) | Self::Id => 1,
            Self::Field(field) => field.kind.components(),
        }
    }

    const fn numbers(&self) -> usize {
        match self {
            Self::Word(_) | Self::Id => 0,
            Self::Field(field) => field.kind.components(),
        }
    }
}

/// The fields of slots, in order.
pub(crate) fn fields(slots: &'static [Slot]) -> impl Iterator<Item = &'static Field> + Clone {
    slots.iter().filter_map(|slot| match slot {
        Slot::Field(field) => Some(field),
        Slot::Word(_) | Slot::Id => None,
    })
}

impl PartialEq for Record {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl Record {
    /// A record without repeated slots.
    pub(crate) const fn new(
        name: &'static str,
        heads: &'static [&'static str],
        makes: Makes,
        slots: &'static [Slot],
    ) -> Self {
        let layout = match makes {
            Makes::Solid(unit) => Some(Layout::of(unit, slots)),
            _ => None,
        };
        Self {
            name,
            heads,
            makes,
            slots,
            repeat: None,
            is_replaced: false,
            layout,
        }
    }

    /// The record with these repeated slots at its end.
    pub(crate) const fn repeating(self, repeat: Repeat) -> Self {
        Self {
            repeat: Some(repeat),
            ..self
        }
    }

    /// The record, which a later one replaces without a warning.
    pub(crate) const fn replaced(self) -> Self {
        Self {
            is_replaced: true,
            ..self
        }
    }

    /// The category of the nodes that it makes.
    pub const fn category(&self) -> Option<Category> {
        match self.makes {
            Makes::Node(category) => Some(category),
            Makes::Solid(_) => Some(Category::Object),
            Makes::View | Makes::Use(_) | Makes::List | Makes::State => None,
        }
    }

    /// Its fields, in text order, without repeated ones.
    pub fn fields(&self) -> impl Iterator<Item = &'static Field> + Clone + use<> {
        fields(self.slots)
    }

    /// The categories of the nodes that it refers to, in text order, without repeated ones.
    pub(crate) fn references(&self) -> impl Iterator<Item = Category> + use<> {
        self.fields().filter_map(|field| match field.kind {
            Kind::Reference(category) => Some(category),
            _ => None,
        })
    }

    /// Whether it combines objects.
    pub(crate) fn combines(&self) -> bool {
        self.references().any(|of| of == Category::Object)
    }

    /// The number of numbers in its fields.
    pub(crate) const fn numbers(&self) -> usize {
        let (mut at, mut numbers) = (0, 0);
        while at < self.slots.len() {
            numbers += self.slots[at].numbers();
            at += 1;
        }
        numbers
    }

    /// The number of tokens behind its first words.
    pub(crate) fn tokens(&self) -> usize {
        self.slots.iter().map(Slot::tokens).sum()
    }

    /// The field in a slot.
    pub(crate) const fn field(&self, slot: usize) -> &Field {
        match &self.slots[slot] {
            Slot::Field(field) => field,
            Slot::Word(_) | Slot::Id => panic!("the slot holds a field"),
        }
    }

    /// The slot of the field with this key.
    pub(crate) const fn slot(&self, key: &str) -> usize {
        let mut at = 0;
        while !matches!(&self.slots[at], Slot::Field(field) if is_same(field.key, key)) {
            at += 1;
        }
        at
    }

    /// The position of the numbers of the field with this key.
    pub(crate) const fn at<const N: usize>(&self, key: &str) -> At<N> {
        let slot = self.slot(key);
        let (mut at, mut before) = (0, 0);
        while at < slot {
            before += self.slots[at].numbers();
            at += 1;
        }
        At::after(before, self.field(slot))
    }
}

impl Schema {
    /// The records of the view, in order.
    pub(crate) fn view(&self) -> impl Iterator<Item = &'static Record> + use<> {
        let records = self.records.iter().copied();
        records.filter(|record| record.makes == Makes::View)
    }

    /// The solids, in order.
    pub(crate) fn solids(&self) -> impl Iterator<Item = &'static Record> + use<> {
        let records = self.records.iter().copied();
        records.filter(|record| matches!(record.makes, Makes::Solid(_)))
    }

    /// The words that begin records, each once, in order.
    pub(crate) fn first_words(&self) -> Vec<&'static str> {
        let mut words: Vec<_> = self.records.iter().map(|record| record.heads[0]).collect();
        words.dedup();
        words
    }
}
