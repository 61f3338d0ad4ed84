//! The arguments that take precedence over the render settings of a scene's text.

use clap::Args;

use super::choices::{FalloffChoice, FilterChoice, GlossChoice, IntegratorChoice, TransferChoice};
use super::shared::depth_range;
use crate::scene::{EXPOSURES, Rendering};

#[derive(Args, Debug)]
pub(super) struct RenderingArguments {
    /// Maximum number of bounces, 0 to 4096 [default: the scene's, otherwise 8, or 64 with path
    /// tracing]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = depth_range())]
    depth: Option<u32>,
    /// Integrator [default: the scene's, otherwise whitted]
    #[arg(long, value_name = "INTEGRATOR", value_enum)]
    integrator: Option<IntegratorChoice>,
    /// Pixel filter; previews always use box [default: the scene's, otherwise box]
    #[arg(long, value_name = "FILTER", value_enum)]
    filter: Option<FilterChoice>,
    /// Transfer curve from colours to 8-bit values [default: the scene's, otherwise linear]
    #[arg(long, value_name = "CURVE", value_enum)]
    transfer: Option<TransferChoice>,
    /// Exposure in stops, -100 to 100: light and albedo times 2 to this power before the transfer,
    /// in EXR and HDR too [default: the scene's, otherwise 0]
    #[arg(long, value_name = "STOPS", allow_negative_numbers = true, value_parser = parse_stops)]
    exposure: Option<f64>,
    /// Falloff of point lights that have none of their own [default: the scene's, otherwise none]
    #[arg(long, value_name = "FALLOFF", value_enum)]
    falloff: Option<FalloffChoice>,
    /// What spreads the reflection and refraction of blinn materials [default: the scene's, otherwise none]
    #[arg(long, value_name = "GLOSS", value_enum)]
    gloss: Option<GlossChoice>,
    /// Adaptive sampling: pixels below this error, in displayed values from 0 to 1, take no more
    /// samples after 16, and others up to the samples per pixel asked for, or 4096; 0 turns it off
    /// [default: the scene's, otherwise 0]
    #[arg(long, value_name = "ERROR", allow_negative_numbers = true, value_parser = parse_noise)]
    noise: Option<f64>,
    /// Scale samples down whose largest channel exceeds this, which removes fireflies at the cost of
    /// light (biased); 0 turns it off [default: 0]
    #[arg(long, value_name = "MAX", allow_negative_numbers = true, value_parser = parse_clamp)]
    clamp: Option<f64>,
}

impl RenderingArguments {
    /// The settings asked for, with this number of samples.
    pub(super) fn rendering(&self, spp: Option<u32>) -> Rendering {
        Rendering {
            integrator: self.integrator.map(IntegratorChoice::value),
            depth: self.depth,
            spp,
            filter: self.filter.map(FilterChoice::value),
            transfer: self.transfer.map(TransferChoice::value),
            exposure: self.exposure,
            falloff: self.falloff.map(FalloffChoice::value),
            gloss: self.gloss.map(GlossChoice::value),
            noise: self.noise,
            clamp: self.clamp,
        }
    }
}

fn parse_stops(text: &str) -> Result<f64, String> {
    let stops = text.parse().ok();
    stops
        .filter(|stops| EXPOSURES.contains(stops))
        .ok_or_else(|| {
            let (least, most) = (EXPOSURES.start(), EXPOSURES.end());
            format!("expected a number from {least} to {most}")
        })
}

fn parse_noise(text: &str) -> Result<f64, String> {
    let noise = text.parse().ok();
    noise
        .filter(|noise| (0.0..1.0).contains(noise))
        .ok_or_else(|| "expected a number of at least 0 and less than 1".to_owned())
}

fn parse_clamp(text: &str) -> Result<f64, String> {
    let most = text.parse().ok();
    most.filter(|most: &f64| most.is_finite() && 0.0 <= *most)
        .ok_or_else(|| "expected a number, 0 or more".to_owned())
}
