//! Choosing from menus: what to add, what to change to, and the value of a field. A value is tried
//! out while the cursor is on it.

use crossterm::event::{KeyCode, KeyEvent};

use super::repeating::note_set;
use super::typing::{assign_whole, type_current};
use crate::app::shared::change::Change;
use crate::app::shared::menu::{Entry, Menu, Purpose};
use crate::app::values::colours;
use crate::app::{Shared, select, text};
use ::text::Edit;
use language::schema::{Category, Kind};
use language::{FieldSpans, Node, Source};

/// Opens the list of the values of the current field if it has one, otherwise starts typing a
/// value.
pub(crate) fn enter_value(shared: &mut Shared) {
    let Some(row) = shared.field_row(shared.cursor.field) else {
        return;
    };
    let node = shared.cursor.selected();
    let entries = match row.field.kind {
        Kind::Choice(words) => words.iter().map(|&word| Entry::new(word, "")).collect(),
        Kind::Reference(category) | Kind::Name(category) => {
            referred(shared.source(), node, category)
        }
        _ => {
            type_current(shared);
            return;
        }
    };
    let present = row.literals.get(shared.cursor.component);
    let present = present.map_or("", String::as_str);
    let present = row.field.chosen(present).map_or(present, |(_, word)| word);
    let at = entries.iter().position(|entry| entry.name == present);
    let purpose = Purpose::Value(row.field.key);
    let mut menu = Menu::new(purpose, entries, at);
    // A change of the view may concern the working view, which is not in the text.
    let is_text = node != Node::View;
    menu.live_edit = is_text.then(|| text::begin_live_edit(shared));
    shared.overlays.menu = Some(menu);
}

/// Handles a key while a menu is open.
pub(crate) fn menu_key(shared: &mut Shared, key: KeyEvent) {
    let Some(menu) = &mut shared.overlays.menu else {
        return;
    };
    match key.code {
        KeyCode::Esc => close_menu(shared),
        KeyCode::Enter => choose_entry(shared),
        _ => {
            let count = menu.shown().len();
            menu.filter.key(key, count);
            follow_menu(shared);
        }
    }
}

/// Moves the cursor of the menu to a row; a second time chooses the entry there.
pub(crate) fn click_menu(shared: &mut Shared, row: usize) {
    match &mut shared.overlays.menu {
        Some(menu) if menu.filter.at == row => choose_entry(shared),
        Some(menu) if row < menu.shown().len() => {
            menu.filter.at = row;
            follow_menu(shared);
        }
        _ => {}
    }
}

/// Closes the menu and puts back what it has changed.
pub(crate) fn close_menu(shared: &mut Shared) {
    if let Some(menu) = shared.overlays.menu.take()
        && let Some(live_edit) = menu.live_edit
    {
        text::end_live_edit(shared, live_edit);
    }
}

/// Tries out the entry under the cursor of a menu of values; returns whether nothing speaks
/// against it.
pub(crate) fn follow_menu(shared: &mut Shared) -> bool {
    let Some(mut menu) = shared.overlays.menu.take() else {
        return false;
    };
    let Some(mut live_edit) = menu.live_edit.take() else {
        shared.overlays.menu = Some(menu);
        return true;
    };
    if text::leaves_live_edit(shared, &live_edit, "choice") {
        return false;
    }
    let is_tried = text::try_or_fail(shared, &mut live_edit, |shared| {
        menu.offer = offered(shared, &menu);
        let name = menu.chosen().map(|entry| entry.name.as_str());
        name.map_or_else(|| Ok(Vec::new()), |name| edits_choosing(shared, name))
    });
    menu.live_edit = Some(live_edit);
    shared.overlays.menu = Some(menu);
    is_tried
}

/// Offers to create what the typed name would refer to.
fn offered(shared: &Shared, menu: &Menu) -> Option<Entry> {
    let name = menu.filter.input.value().trim();
    let category = shared.cursor.current().and_then(category)?;
    if name.is_empty() || menu.has(name) || 0 < shared.error_count() {
        return None;
    }
    let user = shared.cursor.selected();
    let created = shared.source().creation(category, name, user);
    let words = format!("new: create this {}", category.word());
    created.is_ok().then(|| Entry::new(name, words))
}

/// The edits that set the current component to a name, and those that create what it names.
fn edits_choosing(shared: &Shared, name: &str) -> Result<Vec<Edit>, String> {
    let Some(placed) = shared.cursor.current() else {
        return Ok(Vec::new());
    };
    let node = shared.cursor.selected();
    let component = shared.cursor.component;
    let present = colours::literals(shared.source(), placed);
    let is_present = present
        .get(component)
        .is_some_and(|literal| literal == name);
    if is_present && !text::sets_marked(shared) {
        return Ok(Vec::new());
    }
    let mut edits = text::edits_of(shared, &[(placed, vec![(component, name.to_owned())])]);
    if let Some(category) = category(placed)
        && let known = shared.source().references(node, category)
        && known.iter().all(|(literal, _)| literal != name)
    {
        let created = shared.source().creation(category, name, node);
        edits.extend(created.map_err(|refused| refused.to_string())?.edits);
        Edit::sort(&mut edits);
    }
    Ok(edits)
}

/// Chooses the entry under the cursor and closes the menu.
fn choose_entry(shared: &mut Shared) {
    let menu = shared.overlays.menu.as_ref();
    let Some((menu, entry)) = menu.and_then(|menu| Some((menu, menu.chosen()?))) else {
        return;
    };
    let name = entry.name.clone();
    let (purpose, node) = (menu.purpose, shared.cursor.selected());
    // A live edit knows what to leave; without one, another program may have changed the value since.
    let is_untouched = menu.live_edit.is_none() && menu.opened.as_ref() == Some(&name);
    match purpose {
        Purpose::Retype if is_untouched || select::own_kind(shared, node) == Some(&*name) => {
            let node = shared.source().name(node);
            shared.say(format!("{node} is unchanged: it is already of type {name}"));
        }
        Purpose::Value(_) if is_untouched => {}
        Purpose::Value(_) => {
            choose_value(shared, &name);
            return;
        }
        Purpose::Add => select::add(shared, &name),
        Purpose::Reference => {
            let menu = shared.overlays.menu.as_mut();
            menu.expect("it has been chosen from").is_answered = true;
            return;
        }
        Purpose::Retype => {
            let edits = shared.source().retyping(node, &name);
            if select::restructure(shared, edits, None, &format!("changed to {name}")) {
                text::merge_input(shared);
                shared.cursor.changed = Some(Change::Retyped(name));
            }
        }
    }
    shared.overlays.menu = None;
}

/// Keeps the value that is tried out, or sets one that could not be; the menu stays open if that
/// is refused.
fn choose_value(shared: &mut Shared, name: &str) {
    let menu = shared.overlays.menu.as_ref();
    let live_edit = menu.and_then(|menu| menu.live_edit.as_ref());
    let is_kept = if let Some(live_edit) = live_edit {
        live_edit.is_applied || follow_menu(shared)
    } else {
        let value = (shared.cursor.component, name.to_owned());
        let outcome = assign_whole(shared, &[vec![value]]);
        outcome
            .map_err(|refused| shared.fail(refused.message))
            .is_ok()
    };
    if is_kept {
        text::keep_live_edit(shared);
        note_set(shared);
        text::say_marked(shared);
        shared.overlays.menu = None;
    }
}

/// The material or texture that the current field refers to.
pub(crate) fn referred_to(shared: &Shared) -> Option<Node> {
    let category = category(shared.cursor.current()?)?;
    // Others may be very many.
    if !matches!(category, Category::Material | Category::Texture) {
        return None;
    }
    let row = shared.field_row(shared.cursor.field)?;
    let literal = row.literals.first()?;
    let known = shared
        .source()
        .references(shared.cursor.selected(), category);
    Some(known.into_iter().find(|(name, _)| name == literal)?.1)
}

/// The category of what a field refers to.
fn category(placed: &FieldSpans) -> Option<Category> {
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
