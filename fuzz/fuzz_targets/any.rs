//! One program for all targets: the environment variable `TARGET` selects one.

#![no_main]

use std::sync::OnceLock;

use halflight_fuzz::{TARGETS, Target};
use libfuzzer_sys::fuzz_target;

static CHOSEN: OnceLock<Target> = OnceLock::new();

fuzz_target!(
    init: {
        let name = std::env::var("TARGET").unwrap_or_default();
        let known = TARGETS.into_iter().find(|(known, _)| *known == name);
        let Some((_, target)) = known else {
            let names = TARGETS.map(|(name, _)| name).join(", ");
            panic!("TARGET must be one of {names}");
        };
        CHOSEN.get_or_init(|| target);
        if name == "picture" {
            // Panics of third-party decoders are caught and must not end the process.
            std::panic::set_hook(Box::new(|_| {}));
        }
    },
    |input: &[u8]| {
        if let Some(target) = CHOSEN.get() {
            target(input);
        }
    }
);
