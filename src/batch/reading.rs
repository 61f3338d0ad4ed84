//! Reads scenes with the files that they reference, and prints what is found in them.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::{Error, Messages};
use assets::{Assets, Up, is_mesh, is_own_mesh};
use file::ReadError;
use language::{Language, Node, Outlook, Prospect, Source, errors_of_beginning, outlook};
use scene::{Camera, Rendering, Scene, Size, Viewpoint};
use text::{Findings, Span, counted};

/// How scenes are read.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Reading {
    /// How their warnings are treated.
    pub warnings: Warnings,
    /// Additional folders that referenced files may be read from.
    pub assets: Vec<PathBuf>,
    /// The axis that points up in meshes read as scenes; by default that of their formats' custom.
    pub up: Option<Up>,
}

/// How warnings of a scene are treated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Warnings {
    /// Reported only.
    #[default]
    Allowed,
    /// Treated as errors.
    Refused,
}

impl Warnings {
    /// Turns warnings into errors if they are refused.
    pub(super) fn apply(self, findings: Findings) -> Findings {
        match self {
            Self::Allowed => findings,
            Self::Refused => findings.strict(),
        }
    }
}

/// A scene that was read.
pub(super) struct Loaded {
    /// The path of its text, which is new if it was made around a mesh.
    pub(super) path: PathBuf,
    /// `None` if there are errors.
    pub(super) scene: Option<Scene>,
    /// The files it references.
    pub(super) read: assets::Loaded,
    /// Slow to free for a large scene.
    pub(super) source: Source,
    /// The span that sets the size of the picture, if there is one.
    pub(super) size: Option<Span>,
    /// All of its findings, which were printed.
    pub(super) findings: Findings,
    /// What the text shows of its picture.
    pub(super) prospects: Vec<Prospect>,
}

impl Loaded {
    /// Takes the scene; fails if the text has errors.
    pub(super) fn take_scene(&mut self) -> Result<Scene, Error> {
        let errors = self.findings.errors();
        self.scene.take().ok_or(Error::Invalid { errors })
    }
}

/// What takes precedence over what a text says of its picture.
#[derive(Clone, Debug, Default)]
pub(super) struct Over {
    pub(super) rendering: Rendering,
    pub(super) view: Viewpoint,
    pub(super) size: Option<Size>,
}

impl Over {
    /// The camera in effect, given the scene's own; otherwise what is wrong with the view.
    pub(super) fn camera(&self, own: &Camera) -> Result<Camera, &'static str> {
        let size = self.size.unwrap_or(own.size);
        // The requested size sets the aspect ratio.
        self.view.of(own).map(|camera| Camera { size, ..camera })
    }
}

impl Reading {
    /// Begins work that reads scenes: checks the folders, and starts the threads that read.
    pub(super) fn begin(&self) -> Result<(), Error> {
        assets::check_folders(&self.assets)?;
        memory::start_threads_or_none();
        Ok(())
    }

    /// Reads a scene and the files it references, and prints all findings, including those about the
    /// resulting picture, where `over`, if given, takes precedence over the text's settings. A mesh is read
    /// as the new scene around it.
    pub(super) fn load(
        &self,
        messages: Messages,
        path: &Path,
        over: Option<&Over>,
    ) -> Result<Loaded, Error> {
        let mut assets = Assets::new(&self.assets);
        let written = if is_mesh(path) {
            self.around_mesh(messages, path, &mut assets)?
        } else {
            self.written(messages, path)?
        };
        let Written {
            path,
            language,
            text,
            ..
        } = &written;
        let no_memory = |reason| ReadError::NoMemory {
            path: path.clone(),
            reason,
        };
        language::fits(*language, text, 0).map_err(no_memory)?;
        let mut source = Source::new(*language, Arc::clone(text));
        let lowered = assets.lower(path, &mut source).map_err(no_memory)?;
        let (lowered, read) = lowered;
        print_elsewhere(messages, &read);
        if written.shows_mesh.is_none() {
            print_own_meshes(messages, &source);
        }
        let mut findings = lowered.diagnostics;
        let mut prospects = Vec::new();
        if let Some((scene, over)) = lowered.scene.as_ref().zip(over) {
            let asked = over.rendering.or(scene.setting.rendering);
            // A view that cannot be is refused later.
            let camera = over.camera(&scene.camera).unwrap_or(scene.camera);
            for Outlook { warning, prospect } in outlook(&source, scene, &camera, &asked) {
                findings.warning(|| warning);
                prospects.push(prospect);
            }
        }
        let warnings = match written.shows_mesh {
            // Without its mesh, the scene is nothing that was asked for.
            Some(false) => Warnings::Refused,
            _ => self.warnings,
        };
        let findings = warnings.apply(findings.sorted());
        messages.all_findings(path, source.text(), &findings);
        Ok(Loaded {
            path: path.clone(),
            size: size_span(&source),
            scene: lowered.scene.filter(|_| findings.errors() == 0),
            read,
            findings,
            prospects,
            source,
        })
    }

    /// Reads the text of a scene.
    fn written(&self, messages: Messages, path: &Path) -> Result<Written, Error> {
        let language = Language::of_path(path).map_err(|unknown| {
            // An error in opening the file comes before its extension.
            file::open(path).map_or_else(Error::from, |_| unknown.into())
        })?;
        if let Some(beginning) = file::read_beginning(path)? {
            self.check_beginning(messages, path, language, &beginning)?;
        }
        let text = file::read_text(path)?;
        for copy in file::backups(path) {
            messages.note(&file::interruption(path.display(), &copy));
        }
        Ok(Written {
            path: path.to_owned(),
            language,
            text: Arc::new(text),
            shows_mesh: None,
        })
    }

    /// Makes a scene around a mesh, and says so.
    fn around_mesh(
        &self,
        messages: Messages,
        path: &Path,
        assets: &mut Assets,
    ) -> Result<Written, Error> {
        // An error in opening the file is not one of the new scene.
        file::open(path)?;
        let made = assets.scene_of_mesh(path, self.up);
        if made.is_readable {
            let (mesh, scene) = (path.display(), made.path.display());
            let said = format!("{mesh} in a new scene, {scene}: {}", made.summary);
            messages.note(&said);
        }
        Ok(Written {
            path: made.path,
            language: Language::Xml,
            text: Arc::new(made.text),
            shows_mesh: Some(made.is_readable),
        })
    }

    /// Checks the beginning of a long scene, so that the rest is not read if nothing in it can correct
    /// the errors. Prints them.
    fn check_beginning(
        &self,
        messages: Messages,
        path: &Path,
        language: Language,
        beginning: &str,
    ) -> Result<(), Error> {
        let findings = errors_of_beginning(language, beginning);
        if findings.errors() == 0 {
            return Ok(());
        }
        let findings = self.warnings.apply(findings);
        messages.all_findings(path, beginning, &findings);
        let read = counted(beginning.len(), "byte");
        let note = format!("{}: only the first {read} were read", path.display());
        messages.note(&note);
        Err(Error::Invalid {
            errors: findings.errors(),
        })
    }
}

/// The text of a scene.
struct Written {
    path: PathBuf,
    language: Language,
    text: Arc<String>,
    /// If it was made around a mesh: whether this can be read.
    shows_mesh: Option<bool>,
}

/// Says where files were found elsewhere than at the path written.
fn print_elsewhere(messages: Messages, read: &assets::Loaded) {
    for (name, found) in &read.elsewhere {
        let found = match found.parent() {
            Some(parent) if parent.as_os_str().is_empty() => Path::new(".").join(found),
            _ => found.clone(),
        };
        messages.note(&format!("{name} is read from {}", found.display()));
    }
}

/// Says which meshes other programs that read the scene do not know.
fn print_own_meshes(messages: Messages, source: &Source) {
    let mut names: Vec<_> = source.files().into_iter().map(|file| file.path).collect();
    names.retain(|name| is_own_mesh(Path::new(name)));
    names.sort();
    names.dedup();
    for name in names {
        messages.note(&format!(
            "{name}: the course's own readers of .xml know only .obj meshes"
        ));
    }
}

/// The span that sets the size of the picture, if there is one.
fn size_span(source: &Source) -> Option<Span> {
    let view = source.fields(Node::View);
    let written = view.iter().filter(|placed| placed.is_explicit());
    let sizes = written.filter(|placed| placed.field.kind.is_size());
    sizes
        .flat_map(|size| size.spans.iter().copied())
        .reduce(Span::to)
}
