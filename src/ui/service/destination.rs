//! Whether a picture may be written to a file.

use std::io;
use std::path::{Path, PathBuf};

use crate::msg::{Destination, Existing, ExportId, Msg};
use file::Version;

/// Why a picture is not written.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Refused {
    /// The only obstacle is a file that others wrote.
    Taken(String),
    /// It could not be written even over that file.
    Impossible(String),
}

impl Refused {
    /// What to report of an export.
    pub(super) fn report(self, id: ExportId) -> Msg {
        match self {
            Self::Taken(reason) => Msg::Taken(id, reason),
            Self::Impossible(reason) => Msg::Exported(id, Err(reason)),
        }
    }

    /// The reason in words.
    pub(super) fn reason(&self) -> &str {
        let (Self::Taken(reason) | Self::Impossible(reason)) = self;
        reason
    }
}

impl From<String> for Refused {
    fn from(reason: String) -> Self {
        Self::Impossible(reason)
    }
}

/// Why a file is not written: something stands against it, or the system fails.
pub(super) enum NotWritten<R> {
    Refused(R),
    Failed(io::Error),
}

impl<R> From<io::Error> for NotWritten<R> {
    fn from(error: io::Error) -> Self {
        Self::Failed(error)
    }
}

/// Resolves [`Existing::Numbered`]: adds the first free number, from 2, to the name.
pub(super) fn numbered(to: Destination) -> Destination {
    if to.existing != Existing::Numbered {
        return to;
    }
    let [stem, extension] = [to.path.file_stem(), to.path.extension()]
        .map(|part| part.unwrap_or_default().to_string_lossy());
    let free = (2..10_000)
        .map(|number| {
            to.path
                .with_file_name(format!("{stem}-{number}.{extension}"))
        })
        .find(|path| path.symlink_metadata().is_err());
    Destination {
        path: free.unwrap_or_else(|| to.path.clone()),
        existing: Existing::Kept,
        ..to
    }
}

/// Checks whether a picture may be written there; the error is the reason why not.
pub(super) fn check_target(to: &Destination) -> Result<(), Refused> {
    check_target_of(&to.path, to)
}

/// Refuses to replace one of these files, which the scene names.
pub(super) fn check_spared(to: &Destination, files: &[PathBuf]) -> Result<(), Refused> {
    if files.iter().any(|file| file::is_same(&to.path, file)) {
        let path = to.path.display();
        return Err(
            format!("cannot overwrite {path}: the scene uses it; name another file").into(),
        );
    }
    Ok(())
}

/// As [`check_target`], for one frame of an export whose pattern is `named`.
pub(super) fn check_target_of(named: &Path, to: &Destination) -> Result<(), Refused> {
    let (path, shown) = (&to.path, to.path.display());
    let scene = to.scene.as_deref();
    if scene.is_some_and(|scene| file::is_same(path, scene)) {
        return Err(
            format!("cannot overwrite {shown}: it is the scene itself; name another file").into(),
        );
    }
    check_spared(to, &to.named)?;
    let reason = match to.existing {
        Existing::Kept | Existing::Numbered => Some("exists"),
        Existing::Own(version) if Version::of(path).ok() != Some(version) => {
            Some("has changed since it was exported")
        }
        Existing::Own(_) | Existing::Overwritten => None,
    };
    if let Some(reason) = reason.filter(|_| path.symlink_metadata().is_ok()) {
        let named = named.display();
        return Err(Refused::Taken(format!(
            "{shown} {reason}: use :export! {named} to overwrite it"
        )));
    }
    file::check_target(path).map_err(|error| format!("{shown}: {error}").into())
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// A destination unrelated to any scene.
    pub(in crate::service) fn destination(path: &Path, existing: Existing) -> Destination {
        Destination {
            path: path.to_owned(),
            existing,
            scene: None,
            named: Vec::new(),
            origin: None,
        }
    }

    #[test]
    fn a_picture_written_by_another_program_is_kept() {
        let place = tempfile::tempdir().expect("a folder");
        let path = place.path().join("a.bmp");
        let to = |existing| destination(&path, existing);
        assert_eq!(check_target(&to(Existing::Kept)), Ok(()));
        std::fs::write(&path, "").expect("the folder is new");
        let refused = check_target(&to(Existing::Kept)).expect_err("it exists");
        assert!(refused.reason().contains(":export! "), "{refused:?}");
        assert_eq!(check_target(&to(Existing::Overwritten)), Ok(()));
        let exported = Version::of(&path).expect("a file");
        assert_eq!(check_target(&to(Existing::Own(exported))), Ok(()));
        std::fs::write(&path, "theirs").expect("it is ours");
        let refused = check_target(&to(Existing::Own(exported))).expect_err("it was changed");
        let reason = "has changed since it was exported: use :export! ";
        assert!(refused.reason().contains(reason), "{refused:?}");
        std::fs::remove_file(&path).expect("it is there");
        assert_eq!(check_target(&to(Existing::Own(exported))), Ok(()));
    }

    #[test]
    fn a_picture_does_not_replace_its_scene_or_a_file_of_it() {
        let place = tempfile::tempdir().expect("a folder");
        let at = |name: &str| place.path().join(name);
        for name in ["a.ray", "bricks.png"] {
            std::fs::write(at(name), "").expect("the folder is new");
        }
        std::fs::hard_link(at("a.ray"), at("a.bmp")).expect("on one file system");
        for (name, reason) in [
            ("a.bmp", "is the scene itself"),
            ("bricks.png", "the scene uses it"),
        ] {
            for existing in [Existing::Kept, Existing::Overwritten] {
                let to = Destination {
                    scene: Some(at("a.ray")),
                    named: vec![at("x/../bricks.png"), at("bricks.png")],
                    ..destination(&at(name), existing)
                };
                let refused = check_target(&to).expect_err("one file");
                assert!(refused.reason().contains(reason), "{refused:?}");
            }
        }
    }
}
