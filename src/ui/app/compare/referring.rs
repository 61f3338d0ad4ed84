//! What pictures are compared with: pins the picture on screen, or reads a picture or a scene.

use std::path::PathBuf;
use std::sync::Arc;

use super::asking::{OTHER, PIN};
use super::comparing::{comparison_jobs, start};
use super::grading::grading;
use super::state::{Compare, Origin, Reference, shown};
use crate::app::refusing::Refusable;
use crate::app::{Purpose, Shared, display, text};
use crate::keymap::{Context, Mode};
use crate::msg::Effect;
use crate::reference::{ReferenceId, ReferenceRead, ReferenceSource};
use ::text::Severity;
use render::Frame;

/// Does what was chosen from the menu of what to compare with.
pub(super) fn take_answer(compare: &mut Compare, shared: &mut Shared) -> Vec<Effect> {
    let menu = &mut shared.overlays.menu;
    let answered = menu.take_if(|menu| menu.purpose == Purpose::Reference && menu.is_answered);
    let chosen = answered.and_then(|menu| Some(menu.chosen()?.name.clone()));
    match chosen.as_deref() {
        Some(PIN) => pin(compare, shared),
        Some(OTHER) => {
            shared.open_palette_with("compare ");
            Vec::new()
        }
        Some(way) => read_reference(compare, shared, way.into()),
        None => Vec::new(),
    }
}

/// Makes the picture on screen the reference.
pub(super) fn pin(compare: &mut Compare, shared: &mut Shared) -> Vec<Effect> {
    let pinned = match pinned(compare, shared) {
        Ok(pinned) => pinned,
        Err(reason) => {
            shared.warn(reason);
            return Vec::new();
        }
    };
    let size = pinned.frame.as_ref().map_or_else(String::new, |frame| {
        format!(", {}×{}", frame.size.width, frame.size.height)
    });
    let how = shared.keymap.key(shared.context(), "compare");
    let how = how.unwrap_or_else(|| ":compare".to_owned());
    let name = &pinned.name;
    shared.say(format!("pinned the {name}{size}; {how} compares with it"));
    refer(compare, pinned)
}

/// The picture on screen as a reference, or the reason why it cannot be one.
fn pinned(compare: &Compare, shared: &Shared) -> Result<Reference, String> {
    if shared.wireframe().is_some() {
        let light = shared.key_for("show-light");
        let words = format!("a wireframe cannot be pinned: {light} shows a picture");
        return Err(words);
    }
    let picture = shared.picture();
    let frame = match shared.mode {
        Mode::Compare => compare.live(),
        _ => picture.latest.as_ref(),
    };
    let is_whole =
        |frame: &&Arc<Frame>| 1 <= frame.progress.spp && picture.wanted == Some(frame.generation);
    let untraced = || "cannot pin the picture: it is still being traced".to_owned();
    let frame = frame.filter(is_whole).ok_or_else(untraced)?;
    if frame.whole() != frame.size {
        return Err("only a whole picture can be pinned, not a part of it".to_owned());
    }
    let spp = frame.progress.spp;
    let grid = shared.pictures.grid;
    let compared = compare
        .reference
        .as_ref()
        .map(|reference| &reference.origin);
    let (kind, origin) = match (shared.mode, compared) {
        (Mode::Compare, Some(&Origin::Preview(halves, grid, _, output))) => {
            ("preview", Origin::Preview(halves, grid, spp, output))
        }
        (Mode::Trace | Mode::Compare, _) => ("trace", Origin::Traced(spp)),
        _ => {
            let screen = display::preview_screen(shared);
            let screen = screen.filter(|screen| grid.size(screen.halves) == frame.size);
            let halves = screen.ok_or_else(untraced)?.halves;
            let origin = Origin::Preview(halves, grid, spp, shared.output());
            ("preview", origin)
        }
    };
    let shows = shown(shared.pictures.aov);
    Ok(Reference {
        name: format!("{kind}, {shows}, {spp} spp"),
        shows: Some(shows),
        origin,
        frame: Some(Arc::clone(frame)),
    })
}

fn refer(compare: &mut Compare, reference: Reference) -> Vec<Effect> {
    let former = compare.refer(reference);
    let free = former.map(|former| Effect::Free(Arc::new(former)));
    free.into_iter().collect()
}

/// Requests a reference, to compare with once it is read.
pub(crate) fn read_reference(
    compare: &mut Compare,
    shared: &mut Shared,
    path: PathBuf,
) -> Vec<Effect> {
    let Some((name, source)) = source_of(shared, path).or_fail(shared) else {
        return Vec::new();
    };
    let id = compare.ask(name);
    vec![Effect::ReadReference(id, source)]
}

/// The reference that a user means, a file, `saved`, or a revision of the scene, and what to call it.
fn source_of(shared: &Shared, path: PathBuf) -> Result<(String, ReferenceSource), String> {
    let line = path.to_string_lossy().into_owned();
    let (first, rest) = line.split_once(' ').unwrap_or((&line, ""));
    let revision = match (first, rest.trim()) {
        ("git", "") => Some("HEAD"),
        ("git", revision) => Some(revision),
        (revision, "") if is_head(revision) => Some(revision),
        _ => None,
    };
    if revision.is_none() && line != "saved" {
        return Ok((line, ReferenceSource::File(path)));
    }
    let own = shared.disk.path.clone();
    let own = own.ok_or("this scene has no file yet: use :w FILE to create one")?;
    let name = shared.disk.name();
    match revision {
        None => Ok((format!("{name} as saved"), ReferenceSource::File(own))),
        // Git would take it for an option.
        Some(revision) if revision.starts_with('-') => Err(format!("{revision} is not a revision")),
        Some(revision) => Ok((
            format!("{name} in {revision}"),
            ReferenceSource::Revision(revision.to_owned(), own),
        )),
    }
}

/// Takes a reference that was read, and compares with it unless the user does something else. One
/// that cannot be compared leaves the one before.
pub(crate) fn reference_read(
    compare: &mut Compare,
    shared: &mut Shared,
    id: ReferenceId,
    read: Result<ReferenceRead, String>,
) -> Vec<Effect> {
    let Some(name) = compare.answered(id) else {
        return vec![Effect::Free(Arc::new(read))];
    };
    let Some(read) = read.or_fail(shared) else {
        return Vec::new();
    };
    let reference = Reference::read(name, read);
    let is_early = shared.assets.are_awaited();
    if let Err(reason) = comparison_jobs(shared, &reference)
        && !is_early
    {
        shared.refuse_picture(Severity::Error, &reason);
        return vec![Effect::Free(Arc::new(reference))];
    }
    let is_free = matches!(shared.context(), Context::In(mode) if mode != Mode::Move)
        && shared.typed_line().is_none();
    let name = reference.name.clone();
    let how = match (&reference.origin, &reference.frame) {
        (Origin::File(made), Some(frame)) => grading(shared, &name, made, frame.size),
        _ => String::new(),
    };
    let mut effects = refer(compare, reference);
    if is_early {
        shared.say(format!(
            ":compare compares with {name} once the scene's files are read"
        ));
    } else if !is_free {
        shared.say(format!(":compare compares with {name}"));
    } else if shared.mode != Mode::Compare {
        text::leave_sequence(shared);
        effects.extend(start(compare, shared));
    }
    if !how.is_empty() {
        shared.say(how);
    }
    effects
}

/// Whether these are words of git for the newest commit or one before it.
fn is_head(word: &str) -> bool {
    let rest = word.strip_prefix("HEAD");
    rest.is_some_and(|rest| rest.is_empty() || rest.starts_with(['~', '^', '@']))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn revisions_before_the_newest_are_recognised() {
        for (word, is) in [
            ("HEAD", true),
            ("HEAD~3", true),
            ("HEAD^", true),
            ("HEAD@{1}", true),
            ("HEADS.ppm", false),
            ("a.ray", false),
        ] {
            assert_eq!(is_head(word), is, "{word}");
        }
    }
}
