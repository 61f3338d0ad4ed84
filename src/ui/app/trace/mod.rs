//! TRACE: the full-size trace, and the region that it traces alone.

mod keys;
mod regions;
mod room;
mod tracing;

pub(crate) use keys::KEYS;
pub(crate) use regions::order_region;
pub use room::Trace;
pub(crate) use tracing::{end_unseen, in_background, recalled, start, trace_until};
