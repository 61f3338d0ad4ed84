//! Arguments and ranges that several commands have in common.

use std::path::PathBuf;

use clap::builder::TypedValueParser;
use clap::{Args, value_parser};

use crate::render::MAX_SPP;

#[derive(Args, Debug)]
pub(super) struct AssetArguments {
    /// Also allow pictures and meshes to be read from this folder, not only from the scene's folder
    /// and, unless it is /, your home or writable by everyone, the folder above it; repeatable
    #[arg(long = "assets", value_name = "DIR")]
    pub(super) folders: Vec<PathBuf>,
}

pub(super) fn spp_range() -> impl TypedValueParser<Value = u32> {
    value_parser!(u32).range(1..=i64::from(MAX_SPP))
}

pub(super) fn depth_range() -> impl TypedValueParser<Value = u32> {
    // No sample can have more bounces; see the renderer's ray budget.
    value_parser!(u32).range(..=4096)
}

pub(super) fn threads_range() -> impl TypedValueParser<Value = u16> {
    // More cores than any machine has; far more threads could not be started.
    value_parser!(u16).range(1..=1024)
}
