//! Render settings, as a text or a user asks for them: what is asked for, and what of it was left to
//! defaults. A setting is a row of the table.

mod choices;
mod key;
mod rows;

use crate::render_settings;
pub use choices::{FalloffRule, Filter, GlossRule, Integrator, Transfer};
pub use key::{CommandOption, RenderKey, RenderSetting, Values};

use std::ops::RangeInclusive;

/// Default samples per pixel of full-size pictures.
pub const DEFAULT_SPP: u32 = 16;

/// Default maximum of samples per pixel with adaptive sampling.
const DEFAULT_ADAPTIVE_SPP: u32 = 4096;

/// The number of samples after which adaptive sampling may first stop a pixel.
pub const LEAST_ADAPTIVE_SPP: u32 = 16;

/// Maximum samples per pixel: the length of the sample sequence.
pub const MAX_SPP: u32 = 65_536;

/// Default depth of Whitted ray tracing.
pub const DEFAULT_DEPTH: u32 = 8;

/// Default depth of path tracing; most paths end earlier.
const DEFAULT_PATH_DEPTH: u32 = 64;

/// The highest number of bounces; see the renderer's ray budget.
pub const MAX_DEPTH: u32 = 4096;

/// The exposures that can be asked for, in stops: beyond, single precision overflows soon.
pub const EXPOSURES: RangeInclusive<f64> = -100.0..=100.0;

/// A type of setting values, each of which a number stands for.
trait Value: Copy {
    fn number(self) -> f64;

    /// The value that a number stands for; `None` if there is none.
    fn of(number: f64) -> Option<Self>;
}

impl Value for u32 {
    fn number(self) -> f64 {
        self.into()
    }

    fn of(number: f64) -> Option<Self> {
        Some(number as Self)
    }
}

impl Value for f64 {
    fn number(self) -> f64 {
        self
    }

    fn of(number: f64) -> Option<Self> {
        Some(number)
    }
}

/// A row of the table, and where its value is.
struct Row {
    name: &'static str,
    setting: RenderSetting,
    get: fn(&Rendering) -> Option<f64>,
    set: fn(&mut Rendering, Option<f64>),
    /// What is in use: the value asked for, or the default.
    in_use: fn(&Rendering) -> f64,
}

macro_rules! rendering {
    ($($(#[$doc:meta])* $key:ident: $type:ty = $default:expr, $setting:expr;)+) => {
        /// Render settings that are asked for; `None` leaves the choice to whoever asks with less
        /// precedence, in the end to the defaults.
        #[derive(Clone, Copy, Debug, Default, PartialEq)]
        pub struct Rendering {
            $($(#[$doc])* pub $key: Option<$type>,)+
            /// The depths of Whitted ray tracing and of tracing paths where none is asked for, in a
            /// language with defaults of its own.
            pub default_depths: Option<[u32; 2]>,
        }

        impl Rendering {
            /// These settings, completed by others.
            #[must_use]
            pub fn or(self, others: Self) -> Self {
                Self {
                    $($key: self.$key.or(others.$key),)+
                    default_depths: self.default_depths.or(others.default_depths),
                }
            }

            $(
                #[doc = concat!("The ", stringify!($key), " asked for, or the default.")]
                pub fn $key(&self) -> $type {
                    let default: fn(&Self) -> $type = $default;
                    self.$key.unwrap_or_else(|| default(self))
                }
            )+
        }

        /// All settings, in the order in which texts state them.
        const ROWS: &[Row] = &[$(Row {
            name: stringify!($key),
            setting: $setting,
            get: |asked| asked.$key.map(Value::number),
            set: |asked, value| asked.$key = value.and_then(Value::of),
            in_use: |asked| asked.$key().number(),
        }),+];
    };
}

render_settings!(rendering);
