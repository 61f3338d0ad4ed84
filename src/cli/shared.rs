//! Arguments and ranges that several commands have in common.

use std::path::PathBuf;

use clap::builder::TypedValueParser;
use clap::{Args, value_parser};

use crate::config::{MAX_DEPTH, MAX_THREADS};
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
    value_parser!(u32).range(..=i64::from(MAX_DEPTH))
}

pub(super) fn threads_range() -> impl TypedValueParser<Value = u16> {
    value_parser!(u16).range(1..=i64::from(MAX_THREADS))
}
