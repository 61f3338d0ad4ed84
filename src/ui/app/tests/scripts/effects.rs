//! How effects are called in scripts.

use super::*;
use crate::msg::{Destination, Existing, Target, Timer};
use crate::reel::{Reel, ReelForm};
use crate::reference::ReferenceSource;
use ::text::Edit;
use link::ToEditor;

/// The effect in a few words; those that scripts do not name have none.
pub(super) fn called(effect: &Effect) -> String {
    let of = |words: &str, path: &Path| format!("{words} {}", path.display());
    match effect {
        Effect::Trace(target, _) => format!("trace {}", name(*target)),
        Effect::Recall(_, origin, _) => {
            let view = origin.view.to_string();
            let from = if view.is_empty() { "" } else { " from " };
            format!("recall{from}{view}")
        }
        Effect::Stop(target) => format!("stop {}", name(*target)),
        Effect::Halt(target) => format!("halt {}", name(*target)),
        Effect::Pause(target) => format!("pause {}", name(*target)),
        Effect::Resume(target) => format!("resume {}", name(*target)),
        Effect::Explain(question, _) => {
            let [x, y] = question.pixel;
            format!("explain {} {x},{y}", name(question.target))
        }
        Effect::Locate(_) => "locate".to_owned(),
        Effect::Derive(past) => format!("derive {}", past.at),
        Effect::WriteImage(_, _, to) => format!("write {}", place(to)),
        Effect::Film(_, reel, to) => format!("film {}: {}", place(to), filmed(reel)),
        Effect::CheckTarget(_, to) => format!("check {}", place(to)),
        Effect::Read(path, _) => of("read", path),
        Effect::Open(path, _) => of("open", path),
        Effect::Free(_) => "free".to_owned(),
        Effect::Save { path, .. } => of("save", path),
        Effect::CheckPlace(path) => of("check place", path),
        Effect::FindBackups(path) => of("find backups", path),
        Effect::NoteRecent(path) => of("note", path),
        Effect::ListRecent => "list recent".to_owned(),
        Effect::KeepPanels(_) => "keep panels".to_owned(),
        Effect::KeepLesson(place) => format!("keep {}", place.trim_end().replace('\n', "; ")),
        Effect::ListFolder(path) => of("list", path),
        Effect::Watch(path) => of("watch", path),
        Effect::ReadAssets(wanted) => {
            let names = wanted.pictures.iter().chain(&wanted.meshes);
            format!("load [{}]", values::joined(names, " "))
        }
        Effect::ReadReference(_, ReferenceSource::File(path)) => of("refer to", path),
        Effect::ReadReference(_, ReferenceSource::Revision(name, path)) => {
            format!("{} at {name}", of("refer to", path))
        }
        Effect::Compare(_) => "compare".to_owned(),
        Effect::ReadTrack(path) => of("track", path),
        Effect::WriteTrack { path, .. } => of("write track", path),
        Effect::Later(time, timer) => format!("wait {} {}", timed(*timer), time.as_millis()),
        Effect::WriteRecovery { scene, .. } => of(
            "keep edits of",
            scene.as_deref().unwrap_or_else(|| Path::new("no file")),
        ),
        Effect::DropRecovery => "forget edits".to_owned(),
        Effect::LookForKept(sought) if sought.put_off.is_empty() => "look for kept".to_owned(),
        Effect::LookForKept(sought) => format!("look for kept {}", sought.put_off.join(" ")),
        Effect::AdoptKept(_) => "adopt kept".to_owned(),
        Effect::DropKept(_) => "drop kept".to_owned(),
        Effect::OpenEditor { path, line } => format!("{} at {line}", of("edit", path)),
        Effect::Tell(ToEditor::Edit(base, edits)) => {
            let edit = |edit: &Edit| format!("{:?}→{}", edit.span.range(), edit.text);
            let edits: Vec<_> = edits.iter().map(edit).collect();
            format!("edit version {base}: {}", edits.join(", "))
        }
        Effect::Tell(ToEditor::Show { span, takes_focus }) => {
            let focus = if *takes_focus { " with focus" } else { "" };
            format!("show {:?}{focus}", span.range())
        }
        Effect::Tell(message) => format!("tell {message:?}"),
        Effect::ForgetBuffer => "forget buffer".to_owned(),
        Effect::FollowBuffers(follow) => format!("follow buffers {}", follow.name()),
        Effect::CopyText(text) => format!("copy {text}"),
        Effect::SetMouse(_) => "set mouse".to_owned(),
        Effect::Repaint => "repaint".to_owned(),
        Effect::TakeTerminal => "take terminal".to_owned(),
        Effect::Suspend => "suspend".to_owned(),
        Effect::Quit => "quit".to_owned(),
    }
}

/// A destination, how a file there is treated, and which are never replaced.
fn place(to: &Destination) -> String {
    let spared = to.scene.iter().chain(&to.named);
    let spared = values::joined(spared.map(|path| path.display()), " ");
    let (path, existing) = (to.path.display(), treated(to.existing));
    format!("{path} {existing} sparing {spared}")
}

fn filmed(reel: &Reel) -> String {
    let form = match &reel.form {
        ReelForm::Pictures(_, format) => format!("{format:?} pictures"),
        ReelForm::Movie(format) => format!("{format:?}"),
    };
    let size = reel
        .shot
        .size
        .map(|size| format!(" of {}x{}", size.width, size.height));
    let spp = reel.shot.spp.map(|spp| format!(" with {spp} spp"));
    let [size, spp] = [size, spp].map(Option::unwrap_or_default);
    format!("{} frames{size}{spp} as {form}", reel.track.frames)
}

fn treated(existing: Existing) -> &'static str {
    match existing {
        Existing::Kept => "kept",
        Existing::Own(_) => "own",
        Existing::Overwritten => "overwritten",
        Existing::Numbered => "numbered",
    }
}

const TARGETS: [(&str, Target); 7] = [
    ("preview", Target::Preview),
    ("full", Target::Trace),
    ("export", Target::Export),
    ("compared", Target::Compared),
    ("reference", Target::Reference),
    ("thumbnail", Target::Thumbnail),
    ("trial", Target::Trial),
];

const TIMERS: [Timer; 9] = [
    Timer::Settled,
    Timer::Interrupt,
    Timer::Click,
    Timer::Keep,
    Timer::Writing,
    Timer::Frame,
    Timer::Message,
    Timer::Push,
    Timer::Lesson,
];

/// The name of a picture.
pub(super) fn name(target: Target) -> &'static str {
    let known = TARGETS.into_iter().find(|(_, known)| *known == target);
    known.map_or("", |(name, _)| name)
}

fn timed(timer: Timer) -> String {
    format!("{timer:?}").to_lowercase()
}

/// The picture of this name.
pub(super) fn target(name: &str) -> Result<Target, String> {
    let known = TARGETS.into_iter().find(|(known, _)| *known == name);
    Ok(known
        .ok_or_else(|| format!("no picture is called {name}"))?
        .1)
}

/// The timer of this name.
pub(super) fn timer(name: &str) -> Result<Timer, String> {
    let known = TIMERS.into_iter().find(|known| timed(*known) == name);
    known.ok_or_else(|| format!("no timer is called {name}"))
}
