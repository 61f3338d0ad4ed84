//! Readings, saves, exports and tracks in scripts.

use super::*;
use crate::app::files;
use crate::msg::{SaveId, SaveOutcome};
use crate::recovery::tests::offer;
use crate::recovery::{Found, Offer};
use crate::scene_reading::{Baseline, News, Opened};
use ::assets::MeshScene;
use document::Document;
use file::ReadError;
use scene::Meshes;

impl Session {
    pub(super) fn own_path(&self) -> PathBuf {
        let path = self.app.shared.disk.path.clone();
        path.unwrap_or_else(|| PathBuf::from("scene.ray"))
    }

    pub(super) fn reading(&self, path: PathBuf, text: String) -> Msg {
        let reading =
            Reading::new(text, files::baseline(&self.app.shared)).expect("it fits into memory");
        Msg::Read(path, Ok(reading))
    }

    /// The outcome of a save: of the newest, unless its number is said. What was saved may be said to
    /// be another text, and after `as` another file.
    pub(super) fn outcome(&self, name: &str, rest: &str) -> Result<Msg, String> {
        let saves = &self.under_way.saves;
        let (first, others) = rest.split_once(' ').unwrap_or((rest, ""));
        let (id, rest) = match first.parse() {
            Ok(id) => (Some(id), others),
            Err(_) => (saves.keys().last().copied(), rest),
        };
        let id = id.ok_or("nothing is saved")?;
        let outcome = match name {
            "refused" => SaveOutcome::ChangedOnDisk,
            "failed" => SaveOutcome::Failed(rest.to_owned()),
            "homeless" => SaveOutcome::NoFolder(rest.to_owned()),
            _ => {
                let (mut path, mut text) = saves.get(&id).cloned().ok_or("no such save")?;
                if let Some(other) = rest.strip_prefix("as ") {
                    path = other.into();
                } else if !rest.is_empty() {
                    text = Arc::new(self.text_of(rest)?);
                }
                SaveOutcome::Saved { path, text }
            }
        };
        Ok(Msg::Saved(SaveId(id), outcome))
    }

    /// The revision that was to be kept last, or as the first, the second and so on.
    pub(super) fn kept(&self, number: &str) -> Result<u64, String> {
        let kept = numbered(&self.under_way.kept, number);
        Ok(*kept.ok_or("nothing is kept")?)
    }

    /// An offer to restore a text, edited from the text called `base` or as it was opened; or the
    /// same offer `again`.
    pub(super) fn offer(&mut self, rest: &str) -> Result<Msg, String> {
        if rest != "again" {
            let base = self
                .texts
                .get("base")
                .unwrap_or_else(|| &self.texts["opened"]);
            let kept = self.text_of(rest)?;
            let document = &self.app.shared.document;
            let offer = offer(document.language(), &document.shared_text(), base, &kept);
            let name = offer.claim.name().to_owned();
            self.under_way.offer = Some(offer);
            self.texts.insert("offered".to_owned(), name);
        }
        let offer = self.under_way.offer.clone().ok_or("nothing was offered")?;
        Ok(recovered(Some(offer), Vec::new()))
    }

    /// What is found in place of the scene: nothing for `new`, kept edits, a text, or one made `around` a
    /// mesh.
    pub(super) fn other(&self, name: &str, rest: &str) -> Result<Opened, String> {
        if rest == "new" {
            return Ok(Opened::New);
        }
        if let Some(text) = rest.strip_prefix("around ") {
            return Ok(Opened::AroundMesh(MeshScene {
                path: Path::new(name).with_extension("xml"),
                text: self.text_of(text)?,
                summary: "2 triangles".to_owned(),
                is_readable: true,
            }));
        }
        if let Some(kept) = rest.strip_prefix("kept ") {
            return Ok(Opened::Kept(self.text_of(kept)?));
        }
        let language = Language::of_path(Path::new(name)).map_err(|_| "no scene's name")?;
        let nothing = Baseline {
            scene: Document::new(language, String::new()).snapshot(),
            saves: 0,
            meshes: Meshes::default(),
            is_sound: false,
            sent: None,
        };
        let reading = Reading::new(self.text_of(rest)?, nothing);
        Ok(Opened::Read(reading.expect("it fits into memory")))
    }

    /// The newest export.
    pub(super) fn export(&self) -> Result<ExportId, String> {
        let newest = self.under_way.exports.keys().last();
        Ok(ExportId(*newest.ok_or("nothing is exported")?))
    }

    /// The outcome of an export: of the newest, unless its number is said.
    pub(super) fn export_outcome(&self, name: &str, rest: &str) -> Result<Msg, String> {
        let (first, others) = rest.split_once(' ').unwrap_or((rest, ""));
        let (id, rest) = match first.parse() {
            Ok(id) => (ExportId(id), others),
            Err(_) => (self.export()?, rest),
        };
        let path = self.under_way.exports.get(&id.0).ok_or("no such export")?;
        Ok(match name {
            "taken" => Msg::Taken(id, format!("{} exists", path.display())),
            "unwritten" => Msg::Exported(id, Err(rest.to_owned())),
            _ => exported(id, path, None),
        })
    }

    /// The reading of the track beside the scene, or of the one named before a colon: a text, or why
    /// there is none.
    pub(super) fn track(&self, rest: &str) -> Result<Msg, String> {
        let (path, text) = rest.split_once(": ").unwrap_or(("scene.toml", rest));
        let path = PathBuf::from(path);
        let read = match text {
            "none" => Ok(None),
            "missing" | "folder" | "broken" => Err(unread(text, path.clone())?),
            text => Ok(Some(self.text_of(text)?)),
        };
        Ok(Msg::TrackRead(path, read))
    }

    pub(super) fn track_outcome(&self, rest: &str) -> Result<Msg, String> {
        if rest == "refused" {
            return Ok(Msg::TrackWritten(SaveOutcome::ChangedOnDisk));
        }
        let (path, text) = self.under_way.track.clone().ok_or("no key is written")?;
        Ok(Msg::TrackWritten(SaveOutcome::Saved { path, text }))
    }
}

/// Whether only numbers differ from the text under edit.
pub(super) fn kind(news: Option<&News>) -> &'static str {
    match news {
        None => "",
        Some(News::Numbers(_)) => "numbers",
        Some(_) => "other",
    }
}

/// Why a file cannot be read.
pub(super) fn unread(why: &str, path: PathBuf) -> Result<ReadError, String> {
    Ok(match why {
        "missing" => ReadError::NotFound { path },
        "folder" => ReadError::NotRegular {
            path,
            kind: "a folder",
        },
        "no-folder" => ReadError::NoFolder {
            folder: "/scenes".into(),
        },
        "broken" => ReadError::Io {
            path,
            source: std::io::Error::other("broken"),
        },
        _ => return Err(format!("no error is called {why}")),
    })
}

pub(super) fn recovered(offer: Option<Offer>, complaints: Vec<String>) -> Msg {
    let offer = offer.map(Box::new);
    Msg::Recovered(Found { offer, complaints })
}

/// The last, or the one of this number.
pub(super) fn numbered<'a, T>(all: &'a [T], number: &str) -> Option<&'a T> {
    match number.parse::<usize>() {
        Ok(number) => all.get(number - 1),
        Err(_) => all.last(),
    }
}
