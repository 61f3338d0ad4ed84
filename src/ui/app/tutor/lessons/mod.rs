//! The lessons: rows of steps, a file each, beside the scenes that they work on.

mod build;
mod edit;
mod step;
mod understand;

pub(crate) use step::Lesson;

/// All lessons, in the order in which they are learned.
pub(crate) const LESSONS: &[Lesson] = &[edit::EDIT, build::BUILD, understand::UNDERSTAND];

/// The lesson after one.
pub(crate) fn next_after(lesson: &Lesson) -> Option<&'static Lesson> {
    let at = LESSONS.iter().position(|other| other.name == lesson.name)?;
    LESSONS.get(at + 1)
}

/// The names of all lessons, as a list in a sentence.
pub(crate) fn names() -> String {
    let names: Vec<_> = LESSONS.iter().map(|lesson| lesson.name).collect();
    names.join(", ")
}
