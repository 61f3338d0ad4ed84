//! The messages, and their form as JSON. Offsets are bytes of UTF-8 text.

use serde_json::{Value, json};
use text::{Edit, Span};

/// When the interface follows a buffer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Follow {
    /// While text is typed.
    #[default]
    Typing,
    /// When the file is saved.
    Saving,
}

impl Follow {
    /// All of them, by name.
    pub const NAMED: [(&str, Self); 2] = [("typing", Self::Typing), ("saving", Self::Saving)];

    /// The one of this name.
    pub fn named(name: &str) -> Option<Self> {
        let found = Self::NAMED.iter().find(|(known, _)| *known == name);
        found.map(|&(_, follow)| follow)
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        let found = Self::NAMED.iter().find(|(_, known)| *known == self);
        found.map_or("", |(name, _)| name)
    }
}

/// What an editor can be asked for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Abilities {
    /// It applies edits to its buffer.
    pub edits: bool,
    /// It moves its cursor to a place.
    pub shows: bool,
}

/// A buffer that the editor has opened, as a whole.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Opening {
    /// The short name of the editor, such as `nvim`.
    pub editor: String,
    /// The version of the text: one more for each change.
    pub version: u64,
    /// The text.
    pub text: String,
    /// What the editor can be asked for.
    pub can: Abilities,
    /// When the user wants the interface to follow.
    pub follow: Follow,
}

/// A message from the editor's server to the interface.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ToInterface {
    /// A buffer was opened; also the answer to [`ToEditor::Whole`].
    Open(Opening),
    /// The text was changed: the version after that, and the sorted, disjoint edits of the text before.
    Change(u64, Vec<Edit>),
    /// The buffer was written to the file.
    Saved,
    /// The buffer was closed.
    Close,
    /// The cursor was moved to this offset.
    Cursor(usize),
    /// The answer to [`ToEditor::Edit`] of this version: whether the editor says that it made the edits.
    Answer(u64, bool),
    /// Asks what is shown, and whose buffer; from whoever connects.
    Who,
}

/// A message from the interface to the editor's server.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ToEditor {
    /// Change the text of this version, by sorted, disjoint edits.
    Edit(u64, Vec<Edit>),
    /// Move the cursor to a span of the text, and the focus if asked for.
    Show {
        /// The place.
        span: Span,
        /// Whether the editor's window is to take the focus.
        takes_focus: bool,
    },
    /// Send the whole text.
    Whole,
    /// The interface shows the buffer of another editor, of this name.
    Busy(String),
    /// The answer to [`ToInterface::Who`].
    Shown(Shown),
}

/// What an interface shows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Shown {
    /// The path of the scene.
    pub scene: String,
    /// The short name of the editor that has it open.
    pub editor: Option<String>,
}

impl ToInterface {
    /// The message as JSON.
    pub fn to_json(&self) -> Value {
        match self {
            Self::Open(opening) => json!({ "open": {
                "editor": opening.editor,
                "version": opening.version,
                "text": opening.text,
                "edits": opening.can.edits,
                "shows": opening.can.shows,
                "follow": opening.follow.name(),
            }}),
            Self::Change(version, edits) => {
                json!({ "change": { "version": version, "edits": edits_to_json(edits) } })
            }
            Self::Saved => json!({ "saved": {} }),
            Self::Close => json!({ "close": {} }),
            Self::Cursor(at) => json!({ "cursor": { "at": at } }),
            Self::Answer(base, is_made) => json!({ "answer": { "base": base, "made": is_made } }),
            Self::Who => json!({ "who": {} }),
        }
    }

    /// Reads a message; `None` if it is none.
    pub fn of_json(value: &Value) -> Option<Self> {
        let (name, body) = named(value)?;
        Some(match name {
            "open" => Self::Open(Opening {
                editor: body["editor"].as_str()?.to_owned(),
                version: body["version"].as_u64()?,
                text: body["text"].as_str()?.to_owned(),
                can: Abilities {
                    edits: body["edits"].as_bool()?,
                    shows: body["shows"].as_bool()?,
                },
                follow: Follow::named(body["follow"].as_str()?)?,
            }),
            "change" => Self::Change(body["version"].as_u64()?, edits_of_json(&body["edits"])?),
            "saved" => Self::Saved,
            "close" => Self::Close,
            "cursor" => Self::Cursor(offset(&body["at"])?),
            "answer" => Self::Answer(body["base"].as_u64()?, body["made"].as_bool()?),
            "who" => Self::Who,
            _ => return None,
        })
    }
}

impl ToEditor {
    /// The message as JSON.
    pub fn to_json(&self) -> Value {
        match self {
            Self::Edit(base, edits) => {
                json!({ "edit": { "base": base, "edits": edits_to_json(edits) } })
            }
            Self::Show { span, takes_focus } => {
                json!({ "show": { "span": [span.start(), span.end()], "focus": takes_focus } })
            }
            Self::Whole => json!({ "whole": {} }),
            Self::Busy(editor) => json!({ "busy": { "editor": editor } }),
            Self::Shown(Shown { scene, editor }) => {
                json!({ "shown": { "scene": scene, "editor": editor } })
            }
        }
    }

    /// Reads a message; `None` if it is none.
    pub fn of_json(value: &Value) -> Option<Self> {
        let (name, body) = named(value)?;
        Some(match name {
            "edit" => Self::Edit(body["base"].as_u64()?, edits_of_json(&body["edits"])?),
            "show" => Self::Show {
                span: span(body["span"].as_array()?)?,
                takes_focus: body["focus"].as_bool()?,
            },
            "whole" => Self::Whole,
            "busy" => Self::Busy(body["editor"].as_str()?.to_owned()),
            "shown" => Self::Shown(Shown {
                scene: body["scene"].as_str()?.to_owned(),
                editor: body["editor"].as_str().map(str::to_owned),
            }),
            _ => return None,
        })
    }
}

/// The name and the body of a message: the only member of an object.
fn named(value: &Value) -> Option<(&str, &Value)> {
    let object = value.as_object().filter(|object| object.len() == 1)?;
    let (name, body) = object.iter().next()?;
    Some((name, body))
}

/// Each edit as `[start, end, text]`.
fn edits_to_json(edits: &[Edit]) -> Value {
    let edit = |edit: &Edit| json!([edit.span.start(), edit.span.end(), edit.text]);
    edits.iter().map(edit).collect()
}

/// Edits that are sorted and disjoint; whether a text has their places is for the receiver to check.
fn edits_of_json(value: &Value) -> Option<Vec<Edit>> {
    let edit = |value: &Value| {
        let [start, end, text] = value.as_array()?.as_slice() else {
            return None;
        };
        let text = text.as_str()?.to_owned();
        let span = span(&[start.clone(), end.clone()])?;
        Some(Edit { span, text })
    };
    let edits: Vec<_> = value.as_array()?.iter().map(edit).collect::<Option<_>>()?;
    let are_apart = |pair: &[Edit]| pair[0].span.end() <= pair[1].span.start();
    edits.windows(2).all(are_apart).then_some(edits)
}

fn span(ends: &[Value]) -> Option<Span> {
    let [start, end] = ends else {
        return None;
    };
    let (start, end) = (offset(start)?, offset(end)?);
    (start <= end).then(|| Span::new(start, end))
}

/// An offset in a text, which is shorter than 4 GiB.
fn offset(value: &Value) -> Option<usize> {
    let offset = u32::try_from(value.as_u64()?).ok()?;
    Some(offset as usize)
}
