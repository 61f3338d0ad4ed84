//! INSPECT as a room: the rays behind the pixel under the cross follow the picture.

use super::explaining::{follow, scroll_rays};
use crate::ui::app::Shared;
use crate::ui::app::room::Room;
use crate::ui::msg::Effect;

/// INSPECT. What it looks at is shared: the editor opens there, and the status line names it.
#[derive(Debug, Default)]
pub struct Inspect;

impl Room for Inspect {
    fn follow(&mut self, shared: &mut Shared) -> Vec<Effect> {
        scroll_rays(shared);
        follow(shared).into_iter().collect()
    }
}
