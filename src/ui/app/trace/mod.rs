//! TRACE: the full-size trace, and the region that it traces alone.

mod keys;
mod regions;
mod tracing;

pub(crate) use keys::KEYS;
pub(crate) use regions::{confirm_region, drag_region, order_region, press_region};
pub(crate) use tracing::{recalled, start, trace_until};
