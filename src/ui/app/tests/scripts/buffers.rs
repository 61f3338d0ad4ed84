//! An editor's buffer in scripts.

use super::steps::number;
use super::*;
use crate::app::files;
use crate::msg::BufferNews;
use crate::scene_reading::ReadBuffer;
use link::Abilities;

impl Session {
    /// What is heard of a buffer: `buffer opened [edits] [shows] [unfollowed]`, `buffer saved`, `buffer
    /// closed`, `buffer left`; `typed VERSION TEXT`; `kept-by VERSION TEXT`, of an editor that is gone;
    /// `answered BASE made|refused VERSION`; `cursor OFFSET VERSION`.
    pub(super) fn buffer_event(&mut self, name: &str, rest: &str) -> Result<Msg, String> {
        let (first, others) = rest.split_once(' ').unwrap_or((rest, ""));
        Ok(match (name, first) {
            ("typed" | "kept-by", version) => {
                let version = number(version)?;
                let in_file = Arc::new(self.texts["opened"].clone());
                let buffer = ReadBuffer {
                    version,
                    in_file: (name == "kept-by").then_some(in_file),
                };
                let text = self.text_of(others)?;
                self.texts.insert("file".to_owned(), text.clone());
                let baseline = files::baseline(&self.app.shared);
                let reading = Reading::of(text, Some(buffer), baseline);
                Msg::Read(self.own_path(), Ok(reading.expect("it fits into memory")))
            }
            ("answered", base) => {
                let (word, version) = others.split_once(' ').ok_or("which version?")?;
                Msg::Buffer(BufferNews::Answered {
                    base: number(base)?,
                    is_made: word == "made",
                    version: number(version)?,
                })
            }
            ("cursor", at) => Msg::Buffer(BufferNews::Cursor {
                at: number(at)?,
                version: number(others)?,
            }),
            ("buffer", "opened") => {
                let has = |word: &str| others.split(' ').any(|said| said == word);
                Msg::Buffer(BufferNews::Opened {
                    editor: "nvim".to_owned(),
                    can: Abilities {
                        edits: has("edits"),
                        shows: has("shows"),
                    },
                    is_followed: !has("unfollowed"),
                    is_changed: has("changed"),
                })
            }
            ("buffer", "saved") => Msg::Buffer(BufferNews::Saved),
            ("buffer", "closed") => Msg::Buffer(BufferNews::Closed),
            ("buffer", "left") => Msg::Buffer(BufferNews::Left),
            _ => return Err(format!("{name} {rest} is no news of a buffer")),
        })
    }
}
