//! Finished values: frames, how they are displayed, what can be told from them, and what a file says of
//! its picture.

mod appearance;
pub(crate) mod denoise;
mod display;
mod exposure_search;
mod frame;
mod histogram;
mod overexposure;
mod provenance;
mod ramp;
mod record;
pub(crate) mod tone;
mod wireframe;

pub(crate) use denoise::{Guides, Noisy, UNKNOWN};
pub(crate) use display::luminance;
pub use display::{Colours, Display, MOST_HALF_STOPS, exposes};
pub use exposure_search::{Advice, Fault, Trials};
pub use frame::{Frame, Progress, Query};
pub use histogram::{HISTOGRAM_STOPS, Histogram};
pub(crate) use overexposure::Excess;
pub use overexposure::Overexposure;
pub use provenance::Provenance;
pub use record::Record;
pub(crate) use tone::{Light, Tone};
pub use wireframe::{WireLine, Wireframe, wireframe};
