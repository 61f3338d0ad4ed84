//! Questions about what two texts changed in the same place.

use super::naming::whole_field;
use crate::app::{MergeSource, Shared};
use document::Merge;

/// Asks how to resolve a merge: once for each field, such as all channels of a colour.
pub(crate) fn ask_conflict(shared: &mut Shared, mut merge: Merge, from: MergeSource) {
    if merge.is_of(&shared.document) {
        let source = shared.source();
        merge.join(|span| whole_field(source, span));
    }
    shared.overlays.ask_conflict(merge, from);
}
