//! Finished values: frames, how they are displayed, what can be told from them, and what a file says of
//! its picture.

mod appearance;
pub(crate) mod denoise;
mod display;
mod frame;
mod heat_map;
mod histogram;
mod metadata;
mod overexposure;
mod provenance;
mod query;
mod setting_search;
pub(crate) mod tone;
mod wireframe;

pub(crate) use denoise::{Guides, Noisy, UNKNOWN};
pub(crate) use display::luminance;
pub use display::{Colours, Display, MOST_HALF_STOPS};
pub use frame::{Frame, Progress};
pub use histogram::{HISTOGRAM_STOPS, Histogram};
pub use metadata::PictureMetadata;
pub(crate) use overexposure::Excess;
pub use overexposure::Overexposure;
pub use provenance::Provenance;
pub use query::Query;
pub use setting_search::{Advice, Fault, SettingSearch};
pub(crate) use tone::{DisplayTransform, Tone};
pub use wireframe::{WireLine, Wireframe, wireframe};
