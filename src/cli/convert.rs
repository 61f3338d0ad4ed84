//! The arguments of `convert`.

use std::path::{Path, PathBuf};

use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};

use super::shared::{ReadingArguments, destination};
use batch::Convert;
use language::Language;

pub(super) const EXAMPLES: &str = "\
Examples:
  halflight convert scene.ray -o scene.xml
  halflight convert scene.xml -o scene.dat --strict       only if nothing is lost
  halflight convert scene.dat -o - --to ray

For everything that the other language cannot express, a warning names its place and the nearest that was \
written instead. With --strict these are errors, and nothing is written. Without any, both scenes \
give the same picture: halflight compare scene.ray scene.xml finds no differing pixel.

The view is written out, also where it was a default, and saved views are kept. Names, and comments \
on single objects, materials and lights, become comments or names; other comments are not carried \
over, nor are objects that are not drawn. A scene in the same language is copied as it is.

Exit codes: 0 written, 1 write or system error, 2 wrong arguments, 65 invalid scene, or with \
--strict one that loses something, 66 not found or unreadable, 73 file cannot be created.";

#[derive(Args, Debug)]
pub(super) struct ConvertArguments {
    /// Scene file: .ray, .dat, .xml or .test; or a mesh: .obj, .ply or .stl
    #[arg(value_name = "SCENE")]
    scene: PathBuf,
    /// New scene file, in the language of its extension: .ray, .dat, .xml or .test; - for standard output
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Language of the new scene, regardless of the file's extension; required for -o -
    #[arg(long, value_name = "LANGUAGE", value_parser = languages())]
    to: Option<Language>,
    #[command(flatten)]
    reading: ReadingArguments,
}

impl ConvertArguments {
    pub(super) fn into_convert(self) -> Result<Convert, String> {
        let to = match self.to {
            Some(language) => language,
            None if self.output == Path::new("-") => {
                return Err(
                    "standard output has no extension: name the language with --to".to_owned(),
                );
            }
            None => Language::of_path(&self.output)
                .map_err(|error| format!("{error}; --to names another language"))?,
        };
        Ok(Convert {
            scene: self.scene,
            to,
            // A text may go to a terminal.
            output: destination(self.output, true),
            reading: self.reading.into_reading(),
        })
    }
}

/// The names of the languages.
fn languages() -> impl TypedValueParser<Value = Language> {
    let names = Language::ALL.map(Language::extension);
    PossibleValuesParser::new(names)
        .try_map(|name| Language::of_extension(name).ok_or("unknown language"))
}
