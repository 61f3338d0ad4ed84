//! What corresponds to a picture file that the scene is compared with: traced as that was, if its file
//! says how.

use super::App;
use crate::image_file::ImageFormat;
use crate::render::{Aov, Frames, Job, Record, Region, Settings, denoises};
use crate::scene::{Camera, Rendering, Size};
use crate::ui::reference::Made;

impl App {
    /// The job that corresponds to a picture of this size. What the user has set comes before what the
    /// picture's file says, and that before the scene. The view is that of the picture.
    pub(super) fn graded_job(&self, made: &Made, picture: Size) -> Result<Job, String> {
        let Graded {
            record,
            size,
            region,
        } = self.graded(made, picture);
        if let Some(reason) = ImageFormat::Ppm.refuses(size) {
            return Err(reason);
        }
        let rendering = self.graded_rendering(record.as_ref());
        let job = self.final_job(size, rendering.spp())?;
        let Some(record) = record else {
            let camera = Camera { size, ..job.camera };
            return Ok(Job { camera, ..job });
        };
        let aov = self.pictures.aov.or(record.aov);
        let denoise = record.denoise && denoises(aov);
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

    /// What is to be said of how a picture of this name and size is compared.
    pub(super) fn grading(&self, name: &str, made: &Made, picture: Size) -> String {
        let Graded { record, size, .. } = self.graded(made, picture);
        let rendering = self.graded_rendering(record.as_ref());
        let settings = words(size, &rendering);
        let Size { width, height } = self.output();
        let other = if size == self.output() {
            String::new()
        } else {
            format!("; the scene's own size is {width}×{height}")
        };
        let Some(record) = record else {
            return format!("{name} does not say how it was made: compared at {settings}{other}");
        };
        let unused = record.unused();
        let unused = unused.map_or_else(String::new, |unused| format!("; not used: {unused}"));
        format!("compared as {name} says that it was made: {settings}{other}{unused}")
    }

    /// What a picture of this file shows instead of light.
    pub(super) fn graded_aov(&self, made: &Made) -> Option<Aov> {
        let recorded = made.record.as_ref().and_then(|record| record.aov);
        self.pictures.aov.or(recorded)
    }

    fn graded(&self, made: &Made, picture: Size) -> Graded {
        let mut record = made.record.as_deref().cloned();
        let mut framing = (picture, None);
        if let Some(record) = &mut record {
            framing = record.framing(picture);
            if let Some(scene) = &self.scene {
                record.fit(scene);
            }
        }
        let (size, region) = framing;
        Graded {
            record,
            size,
            region,
        }
    }

    fn graded_rendering(&self, record: Option<&Record>) -> Rendering {
        let recorded = record.map(|record| record.rendering);
        let own = self.scene.as_ref().map(|scene| scene.setting.rendering);
        let under = recorded.unwrap_or_default().or(own.unwrap_or_default());
        self.pictures.rendering.or(under)
    }
}

/// A picture file's record, as far as it is of use for the present scene.
struct Graded {
    record: Option<Record>,
    /// The size of the whole picture.
    size: Size,
    /// The only part of it that was traced.
    region: Option<Region>,
}

/// A size and settings in a few words; of some settings only what differs from the default.
fn words(size: Size, rendering: &Rendering) -> String {
    let settings = Settings::new(size, rendering);
    let Settings {
        spp,
        depth,
        integrator,
        ..
    } = settings;
    let Size { width, height } = size;
    let main = format!(
        "{width}×{height}, {spp} spp, {}, depth {depth}",
        integrator.name()
    );
    let usual = Settings::new(size, &Rendering::default()).written();
    let others = settings.written().into_iter().filter(|setting| {
        let is_in_main = ["integrator", "depth"].contains(&setting.0);
        !is_in_main && !usual.contains(setting)
    });
    let others = others.map(|(name, value)| format!("{name} {value}"));
    [main]
        .into_iter()
        .chain(others)
        .collect::<Vec<_>>()
        .join(", ")
}
