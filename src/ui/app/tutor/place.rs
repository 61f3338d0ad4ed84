//! Where a lesson is, kept for a later run.

use std::path::PathBuf;

use super::lessons::{LESSONS, Lesson, next_after};
use crate::app::{CarriedScene, Shared};

/// A lesson to begin, or to continue.
#[derive(Clone, Debug)]
pub(crate) struct Begun {
    /// The lesson.
    pub(crate) lesson: &'static Lesson,
    /// The index of its step.
    pub(crate) step: usize,
    /// The file of its scene, if that was saved.
    pub(crate) path: Option<PathBuf>,
}

impl Begun {
    /// The beginning of a lesson.
    pub(crate) fn at_start(lesson: &'static Lesson) -> Self {
        let (step, path) = (0, None);
        Self { lesson, step, path }
    }

    /// The scene of the step.
    pub(crate) fn scene(&self) -> CarriedScene {
        self.lesson.scene_at(self.step)
    }

    /// The place of a step of a lesson as text, a name and a value a line. A lesson that is done leads to
    /// the next one.
    pub(super) fn to_text(lesson: &'static Lesson, step: usize, shared: &Shared) -> String {
        if step == lesson.steps.len() {
            let next = next_after(lesson).unwrap_or(lesson);
            return format!("lesson {}\nstep 0\n", next.name);
        }
        let path = shared.disk.path.as_deref().map(file::absolute);
        let path = path.as_deref().and_then(std::path::Path::to_str);
        // Such a path cannot be a line of text.
        let path = path.filter(|path| !path.contains(['\n', '\r']));
        let path = path.map_or_else(String::new, |path| format!("scene {path}\n"));
        format!("lesson {}\nstep {step}\n{path}", lesson.name)
    }
}

/// Where a lesson was, from its text; `None` if that says nothing of the kind.
pub(crate) fn begun(text: &str) -> Option<Begun> {
    let value = |name: &str| {
        let mut values = text.lines().filter_map(|line| line.split_once(' '));
        values.find(|(known, _)| *known == name)
    };
    let (_, name) = value("lesson")?;
    let lesson = LESSONS.iter().find(|lesson| lesson.name == name)?;
    let step = value("step")?.1.parse().ok()?;
    let path = value("scene").map(|(_, path)| PathBuf::from(path));
    (step < lesson.steps.len()).then(|| Begun {
        lesson,
        step,
        path: path.filter(|path| path.is_absolute()),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_is_read_and_nothing_else() {
        for (text, expected) in [
            ("lesson build\nstep 3\n", Some(("build", 3, None))),
            (
                "lesson edit\nstep 9\nscene /a/b c.ray\n",
                Some(("edit", 9, Some("/a/b c.ray"))),
            ),
            ("lesson edit\nstep 9\nscene b.ray", Some(("edit", 9, None))),
            ("lesson edit\nstep 99\n", None),
            ("lesson edit\nstep -1\n", None),
            ("lesson edit\nst", None),
            ("lesson \u{1b}[2J\nstep 1", None),
            ("\0\0", None),
            ("", None),
        ] {
            let found = begun(text);
            let found = found.as_ref().map(|begun| {
                let path = begun.path.as_deref().and_then(std::path::Path::to_str);
                (begun.lesson.name, begun.step, path)
            });
            assert_eq!(found, expected, "{text:?}");
        }
    }
}
