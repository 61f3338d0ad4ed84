//! Views saved under a name: comments, which other readers skip, in every language alike:
//! `view NAME: eye x y z target x y z up x y z fov degrees`. Orthographic views have `height h`
//! instead of `fov`; `up` and either of these may be missing.

use std::fmt::Write;

use glam::DVec3;

use super::SceneText;
use super::view::{line_ending, spelled, whole_lines};
use super::words::Words;
use scene::{Camera, Lens};
use text::{Edit, Span, is_line_end, parse_number, rounded};

/// What begins a saved view. Without the blank it is `view:`, the view itself.
const KEYWORD: &str = "view ";

/// A view saved under a name.
#[derive(Clone, Debug, PartialEq)]
pub struct SavedView {
    /// Its name: words separated by single blanks.
    pub name: String,
    eye: DVec3,
    target: DVec3,
    up: Option<DVec3>,
    lens: Option<Lens>,
    /// Its comment.
    span: Span,
}

impl SavedView {
    /// The camera with this view; what the view lacks is taken from `base`.
    pub fn camera(&self, base: &Camera) -> Camera {
        Camera {
            eye: self.eye,
            target: self.target,
            up: self.up.unwrap_or(base.up),
            lens: self.lens.unwrap_or(base.lens),
            ..*base
        }
    }
}

/// Returns a name as it stands in a text.
///
/// # Errors
///
/// Fails with the reason if a view cannot have the name.
pub fn view_name(typed: &str) -> Result<String, &'static str> {
    let words: Vec<_> = typed.split_whitespace().collect();
    let name = words.join(" ");
    if name.is_empty() {
        Err("a view's name must not be empty")
    } else if name.contains(':') {
        Err("a view's name must not contain a colon")
    } else if name.contains("--") {
        Err("a view's name must not contain --, which may end a comment")
    } else if name.chars().any(char::is_control) {
        Err("a view's name must not contain control characters")
    } else {
        Ok(name)
    }
}

/// The saved views of a text, in its order; of several with one name, the first.
pub(super) fn views<Source: SceneText + ?Sized>(source: &Source) -> Vec<SavedView> {
    let text = source.text();
    let mut found: Vec<SavedView> = Vec::new();
    // Most texts have none, and this is faster than looking for their comments.
    if !text.contains(KEYWORD) {
        return found;
    }
    for leaf in source.leaves() {
        if let Some(view) = read(text, leaf, source.comment_marks())
            && found.iter().all(|before| before.name != view.name)
        {
            found.push(view);
        }
    }
    found
}

/// The edits that save a camera under a name, replacing any view of that name, or that delete the
/// view.
pub(super) fn edits<Source: SceneText + ?Sized>(
    source: &Source,
    name: &str,
    camera: Option<&Camera>,
) -> Vec<Edit> {
    let text = source.text();
    let [open, close] = source.comment_marks();
    let before = views(source).into_iter().find(|view| view.name == name);
    let comment = camera.map(|camera| {
        let end = if close.is_empty() { "" } else { " " };
        format!("{open} view {name}:{}{end}{close}", body(camera))
    });
    match (before, comment) {
        (None, None) => Vec::new(),
        (Some(view), Some(text)) => vec![Edit {
            span: view.span,
            text,
        }],
        (Some(view), None) => vec![Edit {
            span: whole_lines(text, view.span).unwrap_or(view.span),
            text: String::new(),
        }],
        (None, Some(comment)) => {
            let end = line_ending(text);
            let is_open = text
                .bytes()
                .next_back()
                .is_some_and(|last| !is_line_end(last));
            let before = if is_open { end } else { "" };
            vec![Edit {
                span: Span::at(text.len()),
                text: format!("{before}{comment}{end}"),
            }]
        }
    }
}

fn body(camera: &Camera) -> String {
    let mut text = String::new();
    let mut put = |key: &str, numbers: &[f64]| {
        // Writing to a string cannot fail.
        let _ = write!(text, " {key}");
        for &number in numbers {
            let _ = write!(text, " {}", spelled(number));
        }
    };
    put("eye", &camera.eye.to_array());
    put("target", &camera.target.to_array());
    put("up", &camera.up.to_array());
    match camera.lens {
        Lens::Perspective(angle) => put("fov", &[shortened(angle)]),
        Lens::Orthographic(height) => put("height", &[shortened(height)]),
    }
    text
}

/// Rounds a computed number above 0 to four decimals, or to four digits if it has fewer then.
fn shortened(number: f64) -> f64 {
    const DIGITS: i32 = 4;
    let power = libm::floor(libm::log10(number)) as i32;
    let decimals = DIGITS.max(DIGITS - 1 - power) as usize;
    rounded(number, decimals)
}

/// Reads a comment; `None` unless it is a well-formed view with a name.
fn read(text: &str, comment: Span, [open, close]: [&str; 2]) -> Option<SavedView> {
    let content = comment.of(text).trim_end();
    let content = content.strip_prefix(open)?.strip_suffix(close)?;
    let content = content.trim_start().strip_prefix(KEYWORD)?;
    let (name, body) = content.split_once(':')?;
    let name = view_name(name).ok()?;
    let mut words = Words::new(body, Span::new(0, body.len())).map(|word| word.of(body));
    let (mut eye, mut target, mut up, mut lens) = (None, None, None, None);
    while let Some(key) = words.next() {
        let mut number = || parse_number(words.next()?).ok();
        let is_new = match key {
            "eye" => eye.replace(vector(&mut number)?).is_none(),
            "target" => target.replace(vector(&mut number)?).is_none(),
            "up" => up.replace(vector(&mut number)?).is_none(),
            "fov" => {
                let angle = number().filter(|angle| 0.0 < *angle && *angle < 180.0)?;
                lens.replace(Lens::Perspective(angle)).is_none()
            }
            "height" => {
                let height = number().filter(|height| 0.0 < *height)?;
                lens.replace(Lens::Orthographic(height)).is_none()
            }
            _ => false,
        };
        if !is_new {
            return None;
        }
    }
    let (eye, target) = (eye?, target?);
    (eye != target).then_some(SavedView {
        name,
        eye,
        target,
        up,
        lens,
        span: comment,
    })
}

fn vector(number: &mut impl FnMut() -> Option<f64>) -> Option<DVec3> {
    Some(DVec3::new(number()?, number()?, number()?))
}
