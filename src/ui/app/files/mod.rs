//! The files of the scene: opened, watched, merged, saved, recovered, left.

mod editor;
mod first_scene;
mod first_selected;
mod keys;
mod leaving;
mod merging;
mod other_scene;
mod outside;
mod polling;
mod reading;
mod recent;
mod recover;
mod replacing;
mod saving;

pub(crate) use editor::{editor_closed, open_editor};
pub(crate) use first_scene::{first_read, open};
pub(crate) use keys::KEYS;
pub(crate) use leaving::{
    interrupt, leave_anyway, leave_once_pushed, leave_when_done, question_before, quit,
    quit_anyway, quit_keeping_edits, quit_key, save_and_quit, save_key, save_view_key, was_saved,
};
pub(crate) use merging::{adopt, decide, decide_all};
pub(crate) use other_scene::{edit_file, open_carried, other_scene_read, start_new};
pub(crate) use outside::show_in_editor;
pub(crate) use polling::{polled, polls};
pub(crate) use reading::{backups_found, catch_up, read_again, read_finally, settled, was_read};
pub(crate) use recent::show_recent;
pub(crate) use recover::{
    decline, fails_to_keep, follow_edits, found_kept, has_kept_edits, keep_edits, kept, put_off,
    question_about_kept, restore, text_name,
};
pub(crate) use saving::{Force, tick, write};

pub use first_scene::{Opening, OpeningText, Preferences};
#[cfg(test)]
pub(crate) use leaving::losses;
#[cfg(test)]
pub(crate) use reading::baseline;
