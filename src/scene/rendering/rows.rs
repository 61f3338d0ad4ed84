//! The table of render settings. Texts, the command line, configurations, records of pictures and the
//! renderer's settings follow from a row; the place where a setting has its effect does not.

/// Passes the table to a macro: for each setting its documentation, key, type and default, which may
/// depend on what is asked for otherwise, and its [`RenderSetting`](super::RenderSetting).
#[macro_export]
macro_rules! render_settings {
    ($use:ident) => {
        $use! {
            /// The integrator.
            integrator: $crate::Integrator = |_| $crate::Integrator::default(), RenderSetting {
                option: Some(CommandOption::new("INTEGRATOR", "Integrator")),
                config: Some(
                    "Integrator to start with, \"whitted\", \"path\" or \"photon\"; otherwise the scene decides",
                ),
                ..RenderSetting::new(
                    $crate::Integrator::VALUES,
                    "How light is traced: Whitted ray tracing, path tracing, or paths with photons for caustics.",
                )
            };
            /// Maximum number of bounces, 0 to 4096; primary rays are bounce 0.
            depth: u32 = |asked| match (asked.integrator(), asked.default_depths) {
                (Integrator::Whitted, Some([whitted, _])) => whitted,
                (Integrator::Path | Integrator::Photon, Some([_, paths])) => paths,
                (integrator, None) => integrator.default_depth(),
            }, RenderSetting {
                option: Some(CommandOption::new("N", "Maximum number of bounces, 0 to 4096")),
                config: Some("Maximum number of bounces; otherwise 8, or 64 with path tracing"),
                else_default: ", or 64 with path tracing",
                ..RenderSetting::new(
                    Values::Whole(0, MAX_DEPTH),
                    "The maximum number of bounces; otherwise 8, or 64 with path tracing.",
                )
            };
            /// Samples per pixel, 1 to 65536; at most, where noise is limited.
            spp: u32 = |asked| {
                if 0.0 < asked.noise() { DEFAULT_ADAPTIVE_SPP } else { DEFAULT_SPP }
            }, RenderSetting {
                config: Some("Samples per pixel of full-size traces and exports"),
                ..RenderSetting::new(
                    Values::Whole(1, MAX_SPP),
                    "Samples per pixel of full-size pictures, at most where noise is set.",
                )
            };
            /// The pixel reconstruction filter.
            filter: $crate::Filter = |_| $crate::Filter::default(), RenderSetting {
                option: Some(CommandOption::new("FILTER", "Pixel filter; previews always use box")),
                config: Some("Pixel filter: \"box\", \"gaussian\" or \"blackman-harris\""),
                ..RenderSetting::new(
                    $crate::Filter::VALUES,
                    "The pixel filter of full-size pictures.",
                )
            };
            /// The transfer function from linear colours to 8 bits.
            transfer: $crate::Transfer = |_| $crate::Transfer::default(), RenderSetting {
                option: Some(CommandOption::new("CURVE", "Transfer curve from colours to 8-bit values")),
                ..RenderSetting::new(
                    $crate::Transfer::VALUES,
                    "The curve from colours to 8-bit values.",
                )
            };
            /// What light and albedo are multiplied by before the transfer, in stops from −100 to 100:
            /// 2 to this power.
            exposure: f64 = |_| 0.0, RenderSetting {
                option: Some(CommandOption::new(
                    "STOPS",
                    "Exposure in stops, -100 to 100: light and albedo times 2 to this power before the transfer, in EXR and HDR too",
                )),
                step: 0.5,
                unit: "stops",
                ..RenderSetting::new(
                    Values::Within(*EXPOSURES.start(), *EXPOSURES.end()),
                    "Colours are multiplied by 2 to this power before the transfer curve.",
                )
            };
            /// How point lights fade whose own falloff does not say so.
            falloff: $crate::FalloffRule = |_| $crate::FalloffRule::default(), RenderSetting {
                option: Some(CommandOption::new(
                    "FALLOFF",
                    "Falloff of point lights that have none of their own",
                )),
                ..RenderSetting::new(
                    $crate::FalloffRule::VALUES,
                    "square: point lights without a falloff of their own fall off with the squared distance.",
                )
            };
            /// What spreads mirrors and glass.
            gloss: $crate::GlossRule = |_| $crate::GlossRule::default(), RenderSetting {
                option: Some(CommandOption::new(
                    "GLOSS",
                    "What spreads the reflection and refraction of blinn materials",
                )),
                ..RenderSetting::new(
                    $crate::GlossRule::VALUES,
                    "exponent: the glossiness of blinn materials spreads their reflection and refraction.",
                )
            };
            /// The noise below which pixels take no more samples, in displayed values, 0 to less than 1;
            /// 0 if all take as many.
            noise: f64 = |_| 0.0, RenderSetting {
                option: Some(CommandOption::new(
                    "ERROR",
                    "Adaptive sampling: pixels below this error, in displayed values from 0 to 1, take no more samples after 16, and others up to the samples per pixel asked for, or 4096; 0 turns it off",
                )),
                step: 0.005,
                ..RenderSetting::new(
                    Values::Below(1.0),
                    "Adaptive sampling: pixels below this displayed error take no more samples. 0: off.",
                )
            };
            /// What the largest channel of each sample of light is limited to, 0 or more, against
            /// fireflies: brighter samples are scaled down. 0 leaves them unbiased.
            clamp: f64 = |_| 0.0, RenderSetting {
                option: Some(CommandOption::new(
                    "MAX",
                    "Scale samples down whose largest channel exceeds this, which removes fireflies at the cost of light (biased); 0 turns it off",
                )),
                is_of_text: false,
                ..RenderSetting::new(
                    Values::NotNegative,
                    "Samples whose largest channel exceeds this are scaled down. 0: off.",
                )
            };
        }
    };
}
