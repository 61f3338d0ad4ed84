//! A scene file to a picture file.

use std::io;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::{self, Receiver};

use super::progress::ProgressLine;
use super::{Error, Warnings, load, print_findings, stdout, tell, tell_error};
use crate::assets;
use crate::file;
use crate::image_file::ImageFormat;
use crate::render::{Aov, Filter, Frame, Job, Renderer, Settings, Threads, default_depth};
use crate::scene::{Camera, Images, Integrator, Scene, Size, Transfer};
use crate::text::{Diagnostic, counted};

/// A picture to make.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Render {
    /// The scene file.
    pub scene: PathBuf,
    /// How its warnings are treated.
    pub warnings: Warnings,
    /// Where the picture goes.
    pub output: Output,
    /// How it is encoded.
    pub format: ImageFormat,
    /// Its size; the scene's own if `None`.
    pub size: Option<Size>,
    /// Samples a pixel.
    pub spp: u32,
    /// Bounces; the integrator's [`default_depth`] if `None`.
    pub depth: Option<u32>,
    /// How light is gathered; the scene says so if `None`.
    pub integrator: Option<Integrator>,
    /// What of its surroundings a pixel is the mean of.
    pub filter: Filter,
    /// Chooses among equally good sample patterns.
    pub seed: u32,
    /// What the picture shows instead of light.
    pub aov: Option<Aov>,
    /// How colours become 8-bit values; the scene says so if `None`.
    pub transfer: Option<Transfer>,
    /// Threads that trace.
    pub threads: usize,
    /// Folders that pictures and meshes may be read from besides the scene's surroundings.
    pub assets: Vec<PathBuf>,
}

/// Where a picture goes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Output {
    /// A file, replaced when the picture is whole.
    File(PathBuf),
    /// The output stream, unless it is a terminal.
    Stdout,
    /// The output stream, even if it is a terminal.
    StdoutTerminal,
}

/// Traces a scene and writes the picture. Warnings, notes and progress go to the error stream. A
/// reader that closes the pipe early has what it wanted: no error. Interrupted at any moment, it
/// leaves the old file or the new one, see [`file::deliver`].
pub fn render(work: &Render) -> Result<(), Error> {
    make(work).inspect_err(tell_error)
}

fn make(work: &Render) -> Result<(), Error> {
    check_output(work)?;
    assets::check_folders(&work.assets)?;
    let loaded = load(&work.scene, &work.assets, work.warnings)?;
    let scene = loaded.scene.ok_or(Error::Invalid {
        errors: loaded.errors,
    })?;
    check_named(work, &loaded.files)?;
    let size = work.size.unwrap_or(scene.camera.size);
    if let Some(reason) = work.format.refuses(size) {
        let Some(place) = loaded.size.filter(|_| work.size.is_none()) else {
            return Err(Error::Refused(format!("--size {reason}")));
        };
        let message = format!("view size {reason}");
        let wrong = Diagnostic::error(place, message, "a smaller size")
            .with_hint("or say another one: --size WxH");
        print_findings(&work.scene, loaded.source.text(), &[wrong]);
        return Err(Error::Invalid { errors: 1 });
    }
    let (wake, woken) = mpsc::channel();
    // Kept to the end: its threads give memory back while the picture is written. Started before the
    // scene is read they have been no quicker.
    let renderer = Renderer::new(Threads::Exactly(work.threads), move || {
        // The receiver is gone only while the renderer is being dropped.
        let _ = wake.send(());
    });
    renderer.restart(job(work, scene, loaded.images, size))?;
    // Giving back a text of 85 MB takes 10 ms, its syntax nearly as much; the worker has begun.
    drop(loaded.source);
    let frame = last(&renderer, &woken)?;
    if 0 < frame.progress.over_budget {
        let samples = counted(frame.progress.over_budget as usize, "sample");
        tell(
            "note",
            &format!("{samples} ran out of rays and may be too dark; a smaller --depth avoids it"),
        );
    }
    write(work, &frame)
}

/// Finds out before the work whether its outcome has a place.
fn check_output(work: &Render) -> Result<(), Error> {
    match &work.output {
        Output::File(path) if file::is_same(path, &work.scene) => Err(Error::Refused(format!(
            "{}: is the scene itself; name another file for the picture",
            path.display()
        ))),
        Output::File(path) => file::check_target(path).map_err(|source| Error::Create {
            path: path.clone(),
            source,
        }),
        Output::Stdout if stdout::is_terminal() => Err(Error::Refused(
            "a terminal can't show a picture file; use -o FILE, a pipe, or --force".to_owned(),
        )),
        Output::Stdout | Output::StdoutTerminal => stdout::check().map_err(stdout_error),
    }
}

/// Refuses to replace a file that the scene itself is made of.
fn check_named(work: &Render, files: &[PathBuf]) -> Result<(), Error> {
    match &work.output {
        Output::File(path) if files.iter().any(|named| file::is_same(path, named)) => {
            Err(Error::Refused(format!(
                "{}: is a file that the scene uses; name another file for the picture",
                path.display()
            )))
        }
        Output::File(_) | Output::Stdout | Output::StdoutTerminal => Ok(()),
    }
}

/// The picture that is asked for.
fn job(work: &Render, scene: Scene, images: Images, size: Size) -> Job {
    let transfer = work.transfer.unwrap_or(scene.setting.transfer);
    let integrator = work.integrator.unwrap_or(scene.setting.integrator);
    Job {
        images,
        // The picture's ratio is the one asked for.
        camera: Camera {
            size,
            ..scene.camera
        },
        scene: Arc::new(scene),
        settings: Settings {
            size,
            spp: work.aov.map_or(work.spp, |aov| aov.samples(work.spp)),
            depth: work.depth.unwrap_or_else(|| default_depth(integrator)),
            seed: work.seed,
            aov: work.aov,
            integrator,
            filter: work.filter,
            transfer,
        },
        frames: work.format.frames(),
    }
}

/// Waits for the finished picture, and shows how far it is.
fn last(renderer: &Renderer, woken: &Receiver<()>) -> Result<Arc<Frame>, Error> {
    let mut line = ProgressLine::new();
    while woken.recv().is_ok() {
        let Some(frame) = renderer.latest() else {
            continue;
        };
        if frame.progress.complete {
            return Ok(frame);
        }
        line.show(&frame.progress);
    }
    Err(Error::Stopped)
}

fn write(work: &Render, frame: &Frame) -> Result<(), Error> {
    let written = match &work.output {
        Output::File(path) => {
            file::deliver(path, |out| work.format.write(frame, out), || Ok(())).map(drop)
        }
        Output::Stdout | Output::StdoutTerminal => stdout::write(work.format, frame),
    };
    written.or_else(|source| match (source.kind(), &work.output) {
        (io::ErrorKind::BrokenPipe, _) => Ok(()),
        (_, Output::Stdout | Output::StdoutTerminal) => Err(stdout_error(source)),
        (
            io::ErrorKind::NotFound
            | io::ErrorKind::PermissionDenied
            | io::ErrorKind::ReadOnlyFilesystem,
            Output::File(path),
        ) => Err(Error::Create {
            path: path.clone(),
            source,
        }),
        (_, Output::File(path)) => Err(Error::Write {
            to: path.display().to_string(),
            source,
        }),
    })
}

fn stdout_error(source: io::Error) -> Error {
    Error::Write {
        to: "standard output".to_owned(),
        source,
    }
}
