//! Choosing from menus: what to add, what to change to, and the value of a field. A value is tried
//! out while the cursor is on it.

use crossterm::event::{KeyCode, KeyEvent};

use super::menu::{Entry, Menu, Purpose};
use super::{Shared, colours};
use crate::language::table::{Category, Kind};
use crate::language::{Node, Placed, Source};
use crate::text::Edit;

impl Shared {
    /// Opens the list of the values of the current field if it has one, otherwise starts typing a
    /// value.
    pub(super) fn enter_value(&mut self) {
        let Some(row) = self.field_row(self.cursor.field) else {
            return;
        };
        let node = self.cursor.selected();
        let entries = match row.field.kind {
            Kind::Choice(words) => words.iter().map(|&word| Entry::new(word, "")).collect(),
            Kind::Reference(category) | Kind::Name(category) => {
                referred(self.source(), node, category)
            }
            _ => {
                self.type_current();
                return;
            }
        };
        let present = row.literals.get(self.cursor.component);
        let present = present.map_or("", String::as_str);
        let present = row.field.chosen(present).map_or(present, |(_, word)| word);
        let at = entries.iter().position(|entry| entry.name == present);
        let purpose = Purpose::Value(row.field.key);
        let mut menu = Menu::new(purpose, entries, at);
        // A change of the view may concern the working view, which is not in the text.
        let is_text = node != Node::View;
        menu.live_edit = is_text.then(|| self.begin_live_edit());
        self.overlays.menu = Some(menu);
    }

    /// Handles a key while a menu is open.
    pub(super) fn menu_key(&mut self, key: KeyEvent) {
        let Some(menu) = &mut self.overlays.menu else {
            return;
        };
        match key.code {
            KeyCode::Esc => self.close_menu(),
            KeyCode::Enter => self.choose_entry(),
            _ => {
                let count = menu.shown().len();
                menu.filter.key(key, count);
                self.follow_menu();
            }
        }
    }

    /// Moves the cursor of the menu to a row; a second time chooses the entry there.
    pub(super) fn click_menu(&mut self, row: usize) {
        let Some(menu) = &mut self.overlays.menu else {
            return;
        };
        if menu.shown().len() <= row {
            return;
        }
        if menu.filter.at == row {
            self.choose_entry();
        } else {
            menu.filter.at = row;
            self.follow_menu();
        }
    }

    /// Closes the menu and puts back what it has changed.
    pub(super) fn close_menu(&mut self) {
        if let Some(menu) = self.overlays.menu.take()
            && let Some(live_edit) = menu.live_edit
        {
            self.end_live_edit(live_edit);
        }
    }

    /// Tries out the entry under the cursor of a menu of values; returns whether nothing speaks
    /// against it.
    pub(super) fn follow_menu(&mut self) -> bool {
        let Some(mut menu) = self.overlays.menu.take() else {
            return false;
        };
        let Some(mut live_edit) = menu.live_edit.take() else {
            self.overlays.menu = Some(menu);
            return true;
        };
        if self.leaves_live_edit(&live_edit, "choice") {
            return false;
        }
        let outcome = self.try_instead(&mut live_edit, |shared| {
            menu.offer = shared.offered(&menu);
            let name = menu.chosen().map(|entry| entry.name.as_str());
            name.map_or_else(|| Ok(Vec::new()), |name| shared.edits_choosing(name))
        });
        menu.live_edit = Some(live_edit);
        self.overlays.menu = Some(menu);
        if let Err(reason) = &outcome {
            self.overlays.fail(reason.as_str());
        }
        outcome.is_ok()
    }

    /// Offers to create what the typed name would refer to.
    fn offered(&self, menu: &Menu) -> Option<Entry> {
        let name = menu.filter.input.value().trim();
        let category = self.cursor.current().and_then(category)?;
        if name.is_empty() || menu.has(name) || 0 < self.error_count() {
            return None;
        }
        let user = self.cursor.selected();
        let created = self.source().creation(category, name, user);
        let words = format!("new: create this {}", category.word());
        created.is_ok().then(|| Entry::new(name, words))
    }

    /// The edits that set the current component to a name, and those that create what it names.
    fn edits_choosing(&self, name: &str) -> Result<Vec<Edit>, String> {
        let Some(placed) = self.cursor.current() else {
            return Ok(Vec::new());
        };
        let node = self.cursor.selected();
        let component = self.cursor.component;
        let present = colours::literals(self.source(), placed);
        let is_present = present
            .get(component)
            .is_some_and(|present| present == name);
        if is_present && !self.sets_marked() {
            return Ok(Vec::new());
        }
        let mut edits = self.edits_of(&[(placed, &[(component, name.to_owned())])]);
        let category = category(placed);
        let known = category.map(|category| self.source().references(node, category));
        if let (Some(category), Some(known)) = (category, known)
            && known.iter().all(|(literal, _)| literal != name)
        {
            let created = self.source().creation(category, name, node);
            edits.extend(created.map_err(|refused| refused.to_string())?.edits);
            Edit::sort(&mut edits);
        }
        Ok(edits)
    }

    /// Chooses the entry under the cursor and closes the menu.
    fn choose_entry(&mut self) {
        let Some(menu) = &self.overlays.menu else {
            return;
        };
        let Some(name) = menu.chosen().map(|entry| entry.name.clone()) else {
            return;
        };
        let (purpose, node) = (menu.purpose, self.cursor.selected());
        // A live edit knows what to leave; without one, another program may have changed the value since.
        let is_untouched = menu.live_edit.is_none() && menu.opened.as_ref() == Some(&name);
        match purpose {
            Purpose::Value(_) | Purpose::Retype if is_untouched => {}
            Purpose::Retype if self.own_kind(node) == Some(&*name) => {}
            Purpose::Value(_) => {
                self.choose_value(&name);
                return;
            }
            Purpose::Add => self.add(&name),
            Purpose::Retype => {
                let edits = self.source().retyping(node, &name);
                if self.restructure(edits, None, &format!("changed to {name}")) {
                    self.merge_input();
                }
            }
        }
        self.overlays.menu = None;
    }

    /// Keeps the value that is tried out, or sets one that could not be; the menu stays open if that
    /// is refused.
    fn choose_value(&mut self, name: &str) {
        let menu = self.overlays.menu.as_ref();
        let live_edit = menu.and_then(|menu| menu.live_edit.as_ref());
        let is_kept = if let Some(live_edit) = live_edit {
            live_edit.is_applied || self.follow_menu()
        } else {
            let value = (self.cursor.component, name.to_owned());
            let outcome = self.assign_whole(&[vec![value]]);
            if let Err(refused) = &outcome {
                self.overlays.fail(refused.message.as_str());
            }
            outcome.is_ok()
        };
        if is_kept {
            self.keep_live_edit();
            self.overlays.menu = None;
        }
    }

    /// The material or texture that the current field refers to.
    pub fn referred_to(&self) -> Option<Node> {
        let category = category(self.cursor.current()?)?;
        // Others may be very many.
        let is_shared = matches!(category, Category::Material | Category::Texture);
        let row = self.field_row(self.cursor.field)?;
        let literal = row.literals.first()?;
        let node = self.cursor.selected();
        let known = is_shared.then(|| self.source().references(node, category));
        let mut known = known.into_iter().flatten();
        Some(known.find(|(name, _)| name == literal)?.1)
    }
}

/// The category of what a field refers to.
fn category(placed: &Placed) -> Option<Category> {
    match placed.field.kind {
        Kind::Reference(category) | Kind::Name(category) => Some(category),
        _ => None,
    }
}

/// The nodes that a field of a node can refer to, with the comments on them, or their names where
/// these say more than their values.
fn referred(source: &Source, node: Node, category: Category) -> Vec<Entry> {
    let references = source.references(node, category).into_iter();
    let entry = |(literal, node): (String, Node)| {
        let words = match (source.comment(node), node) {
            (Some(comment), _) => comment.to_owned(),
            (None, Node::Object(_)) => source.name(node),
            (None, _) => String::new(),
        };
        Entry {
            name: literal,
            words,
            node: Some(node),
        }
    };
    references.map(entry).collect()
}
