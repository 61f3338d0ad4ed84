//! What corresponds to a picture file that the scene is compared with: traced as that was, if its file
//! says how.

use crate::app::{Shared, display};
use crate::reference::Made;
use image_file::ImageFormat;
use render::{Aov, Frames, Job, PictureMetadata, Region, Settings, can_denoise};
use scene::{Camera, Rendering, Size};

/// The job that corresponds to a picture of this size. What the user has set comes before what the
/// picture's file says, and that before the scene. The view is that of the picture.
pub(super) fn graded_job(shared: &Shared, made: &Made, picture: Size) -> Result<Job, String> {
    let (record, (size, region)) = graded(shared, made, picture);
    if let Some(reason) = ImageFormat::Ppm.refuses(size) {
        return Err(reason);
    }
    let recorded = record.as_ref().map(|record| record.rendering);
    let own = shared.scene.as_ref().map(|scene| scene.setting.rendering);
    let under = recorded.unwrap_or_default().or(own.unwrap_or_default());
    let rendering = shared.pictures.rendering.or(under);
    let mut job = display::final_job(shared, size, rendering.spp())?;
    let Some(record) = record else {
        job.camera.size = size;
        return Ok(job);
    };
    let aov = shared.pictures.aov.or(record.aov);
    let denoise = record.denoise && can_denoise(aov);
    let camera = record.view.of(&job.scene.camera)?;
    let settings = Settings::new(size, &rendering);
    Ok(Job {
        camera: Camera { size, ..camera },
        settings: Settings {
            region,
            spp: aov.map_or(settings.spp, |aov| aov.samples(settings.spp)),
            seed: record.seed.unwrap_or_default(),
            aov,
            ..settings
        },
        // Live frames have denoised values beside their pixels.
        frames: if denoise {
            Frames::LastWithValues
        } else {
            Frames::Live
        },
        denoise,
        ..job
    })
}

/// What is to be said of how a picture of this name and size is compared; nothing if it cannot be.
pub(super) fn grading(shared: &Shared, name: &str, made: &Made, picture: Size) -> String {
    let Ok(job) = graded_job(shared, made, picture) else {
        return String::new();
    };
    let size = job.settings.size;
    let mut settings = words(&job);
    let Size { width, height } = shared.output();
    if size != shared.output() {
        settings = format!("{settings}; the scene's own size is {width}×{height}");
    }
    let (Some(record), _) = graded(shared, made, picture) else {
        return format!("{name} records no settings: traced at {settings}");
    };
    let view = if record.view.is_empty() {
        ""
    } else {
        "its view, "
    };
    let aov = shared.pictures.aov;
    let here = aov.is_some_and(|aov| record.aov != Some(aov))
        || shared.pictures.rendering.or(record.rendering) != record.rendering;
    let except = if here {
        ", except for what is set here"
    } else {
        ""
    };
    let unused = record.unused();
    let unused = unused.map_or_else(String::new, |unused| format!("; ignored: {unused}"));
    format!("traced as recorded in {name}{except}: {view}{settings}{unused}")
}

/// What a picture of this file shows instead of light.
pub(super) fn graded_aov(shared: &Shared, made: &Made) -> Option<Aov> {
    let recorded = made.record.as_ref().and_then(|record| record.aov);
    shared.pictures.aov.or(recorded)
}

/// The record of a picture's file as far as it is of use for the present scene, and the size of the whole
/// picture with the only part of it that was traced.
fn graded(
    shared: &Shared,
    made: &Made,
    picture: Size,
) -> (Option<PictureMetadata>, (Size, Option<Region>)) {
    let mut record = made.record.as_deref().cloned();
    let framing = match &mut record {
        Some(record) => record.framing(picture),
        None => (picture, None),
    };
    if let (Some(record), Some(scene)) = (&mut record, &shared.scene) {
        record.fit(scene);
    }
    (record, framing)
}

/// The settings of a job in a few words; of some only what differs from the default.
fn words(job: &Job) -> String {
    let settings = &job.settings;
    let Size { width, height } = settings.size;
    let mut words = vec![format!("{width}×{height}"), format!("{} spp", settings.spp)];
    if settings.aov.is_none() {
        words.push(settings.integrator.name().to_owned());
        words.push(format!("depth {}", settings.depth));
    }
    let usual = Settings::new(settings.size, &Rendering::default()).written();
    let others = settings.written().into_iter().filter(|setting| {
        let is_said = ["integrator", "depth"].contains(&setting.0);
        !is_said && !usual.contains(setting)
    });
    words.extend(others.map(|(name, value)| format!("{name} {value}")));
    words.extend(job.denoise.then(|| "denoised".to_owned()));
    words.join(", ")
}
