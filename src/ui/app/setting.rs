//! Render settings written into the text. What the command line or the interface chose instead is
//! dropped then, so that the text counts, and brought back by undo.

use super::Shared;
use super::saved_setting::SavedSetting;
use crate::document::StepName;
use crate::language::Node;
use crate::scene::{Camera, RenderKey, Rendering, Size};
use crate::text::{Severity, Span};

/// What to set a render setting to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct SettingOrder {
    key: RenderKey,
    to: To,
}

/// The value of a setting in the text.
#[derive(Clone, Debug, PartialEq, Eq)]
enum To {
    /// The one in use.
    InUse,
    /// None: the text no longer states it.
    Default,
    /// This one.
    Value(String),
}

impl SettingOrder {
    /// Parses `KEY [VALUE|default]`; the error says what is expected.
    pub(super) fn parse(said: &str) -> Result<Self, String> {
        let (word, value) = said.split_once(char::is_whitespace).unwrap_or((said, ""));
        let key = RenderKey::of_text().find(|key| key.name() == word);
        let key = key.ok_or_else(|| {
            let names: Vec<_> = RenderKey::of_text().map(RenderKey::name).collect();
            format!(":set takes {}", names.join(", "))
        })?;
        let to = match value.trim() {
            "" => To::InUse,
            "default" => To::Default,
            value if value.contains(char::is_whitespace) => {
                return Err(format!(":set {word} takes one value"));
            }
            value => To::Value(value.to_owned()),
        };
        Ok(Self { key, to })
    }
}

impl Shared {
    /// Writes the size of the picture into the text.
    pub(super) fn set_size(&mut self, size: Size) {
        let Some(scene) = self.scene.clone().filter(|_| self.error_count() == 0) else {
            let words = "cannot set the size while the scene has errors";
            self.overlays.blame_errors(Severity::Error, words);
            return;
        };
        let camera = Camera {
            size,
            ..scene.camera
        };
        self.document.end_step();
        match self.write_camera(&camera, &scene.camera) {
            Ok(()) => {
                let Size { width, height } = size;
                let step = StepName::done(format!("set the size to {width}x{height}"));
                self.document.name_step(step);
            }
            Err(refused) => self.overlays.fail(refused.message),
        }
        self.document.end_step();
    }

    /// Carries out an order.
    pub(super) fn set_rendering(&mut self, order: &SettingOrder) {
        let value = match &order.to {
            To::Value(value) => Some(value.clone()),
            To::InUse => Some(order.key.value(&self.rendering())),
            To::Default => None,
        };
        self.write_setting(order.key, value);
    }

    /// Writes a value of a render setting into the text, or removes the setting there, and drops what
    /// took precedence over it.
    pub(super) fn write_setting(&mut self, key: RenderKey, value: Option<String>) {
        self.document.end_step();
        let before = self.document.state();
        let edits = match &value {
            Some(value) => {
                let fields = self.source().fields(Node::Render);
                let placed = fields.iter().find(|placed| placed.field.key == key.name());
                let own = |values| placed.map(|placed| placed.edits(&**self.source(), values));
                own(&[(0, value.clone())]).unwrap_or_default()
            }
            None => self.source().render_removal(key.name()),
        };
        match self.try_edits(&edits) {
            Ok(()) => {
                let over = key.alone(&self.pictures.rendering);
                self.pictures.due |= over != Rendering::default();
                self.pictures.rendering = key.cleared(&self.pictures.rendering);
                let state = self.document.state();
                if state != before {
                    self.pictures
                        .written
                        .push(SavedSetting { state, key, over });
                }
                let name = key.name();
                let words = match value {
                    Some(value) => format!("set {name} {value}"),
                    None => format!("set {name} to its default"),
                };
                self.overlays.say(words.clone());
                self.document.name_step(StepName::done(words));
            }
            Err(refused) => self.overlays.fail(refused.message_with_hint()),
        }
        self.document.end_step();
    }

    /// Undoes a step of the text; if it wrote a setting, what took precedence over that setting before
    /// does again.
    pub(super) fn undo_text(&mut self) -> Option<Span> {
        let left = self.document.state();
        let changed = self.document.undo();
        if changed.is_some() {
            self.pictures.cross(left);
        }
        changed
    }

    /// Redoes a step of the text; if it wrote a setting, what took precedence over that setting when it
    /// was undone does again.
    pub(super) fn redo_text(&mut self) -> Option<Span> {
        let changed = self.document.redo();
        if changed.is_some() {
            self.pictures.cross(self.document.state());
        }
        changed
    }
}
