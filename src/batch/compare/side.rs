//! One side of a comparison: a picture that is read, or a scene that is traced.

use std::path::Path;

use super::Compare;
use crate::as_recorded::AsRecorded;
use crate::output::Output;
use crate::reading::Loaded;
use crate::tracing::Tracer;
use crate::{Error, Messages};
use image_file::{Recorded, in_8_bits};
use language::Language;
use render::{Frames, Job, PictureMetadata};
use scene::{Image, Size};

/// The picture that a scene is to be compared with.
#[derive(Clone, Copy)]
pub(super) struct Model<'m> {
    /// Its file.
    pub(super) path: &'m Path,
    pub(super) size: Size,
    /// How it was made, if that is known.
    pub(super) record: Option<&'m PictureMetadata>,
    /// Whether it holds light, to which no transfer curve was applied.
    pub(super) holds_light: bool,
}

impl<'m> Model<'m> {
    pub(super) fn of(path: &'m Path, read: &'m Recorded) -> Self {
        Self {
            path,
            size: read.image.size(),
            record: read.record.as_ref(),
            holds_light: read.holds_light,
        }
    }
}

/// Whether a file is read as a picture, whatever it holds.
pub(super) fn is_picture(path: &Path) -> bool {
    Language::of_path(path).is_err() && !assets::is_mesh(path)
}

/// Reads a picture.
pub(super) fn read(path: &Path) -> Result<Recorded, Error> {
    let mut file = file::open(path)?;
    Recorded::read(&mut file).map_err(|source| Error::Picture {
        path: path.to_owned(),
        source,
    })
}

/// Reads a scene and traces it, as its model was made if there is one. Its findings are told, and so is how
/// it is traced.
pub(super) fn trace(
    work: &Compare,
    path: &Path,
    model: Option<Model<'_>>,
) -> Result<Traced, Error> {
    let untraced = Untraced::read(work, path, model, Messages::Text)?;
    untraced.check_spared()?;
    untraced.trace()
}

/// A scene that was read and is to be traced.
pub(super) struct Untraced<'w> {
    work: &'w Compare,
    path: &'w Path,
    holds_light: bool,
    as_recorded: Option<AsRecorded<'w>>,
    messages: Messages,
    loaded: Loaded,
}

impl<'w> Untraced<'w> {
    /// Reads it, to be traced as its model was made if there is one.
    pub(super) fn read(
        work: &'w Compare,
        path: &'w Path,
        model: Option<Model<'w>>,
        messages: Messages,
    ) -> Result<Self, Error> {
        let as_recorded = model.map(|model| {
            AsRecorded::new(
                [path, model.path],
                (model.size, model.record),
                &work.tracing,
            )
        });
        let over = match &as_recorded {
            Some(as_recorded) => as_recorded.over(),
            None => work.tracing.over(),
        };
        Ok(Self {
            loaded: work.reading.load(messages, path, Some(&over))?,
            work,
            path,
            holds_light: model.is_some_and(|model| model.holds_light),
            as_recorded,
            messages,
        })
    }

    /// Refuses to overwrite a file that it uses.
    pub(super) fn check_spared(&self) -> Result<(), Error> {
        for output in self.work.outputs() {
            let reason = format!("{} uses it", self.path.display());
            let output = Output::File(output.to_owned());
            output.check_is_not(&self.loaded.read.files, &reason)?;
        }
        Ok(())
    }

    /// Traces it, if it has no errors.
    pub(super) fn trace(self) -> Result<Traced, Error> {
        let Self {
            mut loaded,
            mut as_recorded,
            ..
        } = self;
        let Some(scene) = loaded.scene.take() else {
            return Ok(Traced {
                loaded,
                picture: None,
            });
        };
        let own = scene.camera.size;
        let tracing = match &mut as_recorded {
            Some(as_recorded) => as_recorded.tracing(&scene),
            None => self.work.tracing.clone(),
        };
        let frames = if self.holds_light {
            Frames::LastWithValues
        } else {
            Frames::Last
        };
        let images = std::mem::take(&mut loaded.read.images);
        let job = tracing.job(scene, images, frames)?;
        if let (Some(as_recorded), Messages::Text) = (&as_recorded, self.messages) {
            as_recorded.tell(&job, own);
        }
        let frame = Tracer::new(tracing.execution).trace(job.clone(), None, || {})?;
        let pixels = if self.holds_light {
            in_8_bits(&frame)
        } else {
            Some(frame.pixels.clone())
        };
        let image = pixels.and_then(|pixels| Image::new(frame.size, pixels));
        let picture = Some((image.ok_or(Error::Stopped)?, job));
        Ok(Traced { loaded, picture })
    }
}

/// A scene that was read.
pub(super) struct Traced {
    pub(super) loaded: Loaded,
    /// The picture and how it was made; `None` if there are errors.
    pub(super) picture: Option<(Image, Job)>,
}

impl Traced {
    /// The picture alone; fails if the text has errors.
    pub(super) fn image(self) -> Result<Image, Error> {
        let errors = self.loaded.findings.errors();
        let (image, _) = self.picture.ok_or(Error::Invalid { errors })?;
        Ok(image)
    }
}
