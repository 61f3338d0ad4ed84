//! The menu of what to compare with, as long as there is nothing yet.

use crate::app::{Entry, Menu, OnDisk, Purpose, Shared};

/// What can be compared with: what the menu calls it, and says of it.
const WAYS: [(&str, &str); 4] = [
    (PIN, "this picture, with later ones"),
    (SAVED, "the scene as last saved"),
    (COMMITTED, "the scene in the last commit"),
    (OTHER, "a picture or another scene"),
];
/// Pins the picture on screen.
pub(super) const PIN: &str = "pin";
/// As the command has it.
const SAVED: &str = "saved";
/// As the command has it.
const COMMITTED: &str = "git";
/// Begins to type the name of a file.
pub(super) const OTHER: &str = "file …";

/// Opens the menu of what to compare with.
pub(super) fn ask_for_reference(shared: &mut Shared) {
    let has_file = shared.disk.path.is_some() && !matches!(shared.disk.state, OnDisk::New);
    let ways = WAYS.iter();
    let ways = ways.filter(|(name, _)| has_file || ![SAVED, COMMITTED].contains(name));
    let entries = ways.map(|&(name, words)| Entry::new(name, words));
    shared.overlays.menu = Some(Menu::new(Purpose::Reference, entries.collect(), None));
}
