//! The arguments of `show`.

use std::path::PathBuf;

use clap::Args;

use super::shared::{AssetArguments, UpArgument};
use batch::{Reading, Show};

pub(super) const EXAMPLES: &str = "\
Examples:
  halflight show out.png                  settings, digest of the scene, and the command to render it again
  halflight show out.png scene.ray        also whether the picture is of this scene, as it is now

PNG and EXR say what they are made from; other formats cannot. The digest is the SHA-256 of the scene's \
text and of all files that it names.

A frame of --track is made from a text of its own, which is never that of the scene.

Exit code 1 means that the picture is not of this scene as it is now.";

#[derive(Args, Debug)]
pub(super) struct ShowArguments {
    /// PNG or EXR written by halflight
    #[arg(value_name = "PICTURE")]
    picture: PathBuf,
    /// Scene to compare with the one that the picture is made from
    #[arg(value_name = "SCENE")]
    scene: Option<PathBuf>,
    #[command(flatten)]
    up: UpArgument,
    #[command(flatten)]
    assets: AssetArguments,
}

impl ShowArguments {
    pub(super) fn into_show(self) -> Show {
        Show {
            picture: self.picture,
            scene: self.scene,
            reading: Reading {
                assets: self.assets.folders,
                up: self.up.up(),
                ..Reading::default()
            },
        }
    }
}
