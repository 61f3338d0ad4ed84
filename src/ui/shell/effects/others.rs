//! Effects on others, which a script of keys does not have.

use crate::msg::{Effect, Msg};
use crate::reference::ReferenceSource;

/// The result of an effect on others in a script of keys, which performs none.
pub(super) fn without_others(effect: &Effect) -> Option<Msg> {
    match effect {
        Effect::WriteRecovery { revision, .. } => Some(Msg::Kept(*revision, Ok(()))),
        Effect::ListRecent => Some(Msg::RecentListed(Vec::new())),
        Effect::ReadReference(id, _) => {
            let reason = "a script of keys cannot run git".to_owned();
            Some(Msg::ReferenceRead(*id, Err(reason)))
        }
        _ => None,
    }
}

/// Whether an effect depends on earlier runs or other programs. With a page none is performed: it
/// keeps no edits and watches no files.
pub(super) fn reaches_others(effect: &Effect) -> bool {
    matches!(
        effect,
        Effect::WriteRecovery { .. }
            | Effect::DropRecovery
            | Effect::LookForKept(_)
            | Effect::AdoptKept(_)
            | Effect::DropKept(_)
            | Effect::Watch(_)
            | Effect::NoteRecent(_)
            | Effect::ListRecent
            | Effect::KeepPanels(_)
            | Effect::KeepLesson(_)
            | Effect::ReadReference(_, ReferenceSource::Revision(..))
    )
}
