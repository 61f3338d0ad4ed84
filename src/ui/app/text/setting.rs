//! Render settings written into the text. What the command line or the interface chose instead is
//! dropped then, so that the text counts, and brought back by undo.

use super::edit::{judge_text, make_step, try_step};
use crate::app::Shared;
use crate::app::pictures::saved_setting::SavedSetting;
use document::StepName;
use language::Node;
use scene::{Camera, RenderKey, Rendering, Size};
use text::{Severity, Span};

/// What to set a render setting to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct SettingOrder {
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
    pub(crate) fn parse(said: &str) -> Result<Self, String> {
        let (word, value) = said.split_once(char::is_whitespace).unwrap_or((said, ""));
        let key = RenderKey::of_text().find(|key| key.name() == word);
        let key = key.ok_or_else(|| {
            let names: Vec<_> = RenderKey::of_text().map(RenderKey::name).collect();
            format!("no setting `{word}`; settings: {}", names.join(", "))
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

/// Writes the size of the picture into the text.
pub(crate) fn set_size(shared: &mut Shared, size: Size) {
    let Some(scene) = shared.sound_scene() else {
        let words = "cannot set the size while the scene has errors";
        shared.overlays.blame_errors(Severity::Error, words);
        return;
    };
    let camera = Camera {
        size,
        ..scene.camera
    };
    let edits = shared.source().view_edits(&scene.camera, &camera);
    let Size { width, height } = size;
    make_step(shared, &edits, format!("set the size to {width}x{height}"));
}

/// Carries out an order.
pub(crate) fn set_rendering(shared: &mut Shared, order: &SettingOrder) {
    let value = match &order.to {
        To::Value(value) => Some(value.clone()),
        To::InUse => Some(order.key.value(&shared.rendering())),
        To::Default => None,
    };
    write_setting(shared, order.key, value);
}

/// Writes a value of a render setting into the text, or removes the setting there, and drops what
/// took precedence over it.
pub(crate) fn write_setting(shared: &mut Shared, key: RenderKey, value: Option<String>) {
    let before = shared.document.state();
    let edits = match &value {
        Some(value) => {
            let fields = shared.source().fields(Node::Render);
            let placed = fields.iter().find(|placed| placed.field.key == key.name());
            let own = |values| placed.map(|placed| placed.edits(&**shared.source(), values));
            own(&[(0, value.clone())]).unwrap_or_default()
        }
        None => shared.source().render_removal(key.name()),
    };
    match try_step(shared, &edits) {
        Ok(()) => {
            let over = key.alone(&shared.pictures.rendering);
            shared.pictures.due |= over != Rendering::default();
            shared.pictures.rendering = key.cleared(&shared.pictures.rendering);
            let state = shared.document.state();
            if state != before {
                shared
                    .pictures
                    .written
                    .push(SavedSetting { state, key, over });
            }
            let name = key.name();
            let words = match value {
                Some(value) => format!("set {name} {value}"),
                None => format!("set {name} to its default"),
            };
            shared.say(words.clone());
            shared.document.name_step(StepName::done(words));
        }
        Err(refused) => shared.fail(refused.message_with_hint()),
    }
}

/// Undoes a step of the text; if it wrote a setting, what took precedence over that setting before
/// does again.
pub(crate) fn undo_text(shared: &mut Shared) -> Option<Span> {
    let left = shared.document.state();
    let changed = shared.document.undo();
    if changed.is_some() {
        shared.pictures.cross(left);
    }
    changed
}

/// Redoes a step of the text; if it wrote a setting, what took precedence over that setting when it
/// was undone does again.
pub(crate) fn redo_text(shared: &mut Shared) -> Option<Span> {
    let changed = shared.document.redo();
    if changed.is_some() {
        shared.pictures.cross(shared.document.state());
    }
    changed
}

/// Switches the integrator.
pub(crate) fn next_integrator(shared: &mut Shared) {
    let words = shared.pictures.next_integrator(shared.scene.as_deref());
    // It may lack other lights.
    judge_text(shared);
    shared.say(words);
}
