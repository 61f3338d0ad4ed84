//! Traces a scene to be compared with a picture as that picture was made, if its file records how.

use std::path::Path;

use super::reading::Over;
use super::{Messages, Tracing};
use render::{Job, PictureMetadata, Provenance, Region, can_denoise};
use scene::{Rendering, Scene, Size};

/// A scene that is to be traced as a picture was.
pub(super) struct AsRecorded<'w> {
    /// The files of the scene and the picture.
    scene: &'w Path,
    picture: &'w Path,
    /// What the command line says, which comes first.
    said: &'w Tracing,
    /// What the picture's file says.
    record: Option<PictureMetadata>,
    size: Option<Size>,
    region: Option<Region>,
}

impl<'w> AsRecorded<'w> {
    /// To be traced as a picture of this size with this record.
    pub(super) fn new(
        [scene, picture]: [&'w Path; 2],
        (own, record): (Size, Option<&PictureMetadata>),
        said: &'w Tracing,
    ) -> Self {
        let mut record = record.cloned();
        let (size, region) = match (said.size, said.region, &mut record) {
            (None, None, Some(record)) => {
                let (size, region) = record.framing(own);
                (Some(size), region)
            }
            (None, None, None) => (Some(own), None),
            // The picture may be cut out of the one that its file tells of.
            (None, region, record) => (record.as_ref().and_then(|record| record.size), region),
            (size, region, _) => (size, region),
        };
        Self {
            scene,
            picture,
            said,
            record,
            size,
            region,
        }
    }

    /// What takes precedence over what the scene's text says.
    pub(super) fn over(&self) -> Over {
        let view = match &self.record {
            Some(record) => self.said.view.over(&record.view),
            None => self.said.view.clone(),
        };
        Over {
            rendering: self.rendering(),
            view,
            size: self.size,
        }
    }

    fn rendering(&self) -> Rendering {
        let recorded = self.record.as_ref().map(|record| record.rendering);
        self.said.over_text().or(recorded.unwrap_or_default())
    }

    /// How the scene is traced.
    pub(super) fn tracing(&mut self, scene: &Scene) -> Tracing {
        if let Some(record) = &mut self.record {
            record.fit(scene);
        }
        let record = self.record.clone().unwrap_or_default();
        let aov = self.said.aov.or(record.aov);
        Tracing {
            size: self.size,
            region: self.region,
            view: self.said.view.over(&record.view),
            rendering: self.rendering(),
            seed: self.said.seed.or(record.seed),
            aov,
            denoise: record.denoise && can_denoise(aov),
            ..self.said.clone()
        }
    }

    /// Says how the scene is traced, and why so.
    pub(super) fn tell(&self, job: &Job, own: Size) {
        let (scene, picture) = (self.scene.display(), self.picture.display());
        let recorded = self.record.as_ref().and_then(|record| record.size);
        if let (None, None, None, Some(size)) =
            (self.said.size, self.said.region, recorded, self.size)
            && size != own
        {
            let [own, size] = [own, size].map(|Size { width, height }| format!("{width}x{height}"));
            Messages::Text.note(&format!(
                "{scene} is traced at {size}, the size of the picture; its own is {own}"
            ));
        }
        let settings = settings(job);
        let told = match &self.record {
            Some(_) => format!(
                "{scene} is traced with the settings recorded in {picture}, except where options \
                 override them: {settings}"
            ),
            None => format!(
                "{picture} records no settings: {scene} is traced with {settings}; options such as \
                 --spp change them"
            ),
        };
        Messages::Text.note(&told);
        if let Some(unused) = self.record.as_ref().and_then(PictureMetadata::unused) {
            let told = format!("problems in the record of {picture} are ignored: {unused}");
            Messages::Text.note(&told);
        }
    }
}

/// The settings of a job with their names, but for those of a part or property that is not there.
fn settings(job: &Job) -> String {
    let spp = match job.limit {
        None => Some(("spp", job.settings.spp.to_string())),
        Some(_) => None,
    };
    let entries = Provenance::of(job, String::new()).written();
    let is_told = |(name, value): &(&str, String)| {
        let is_of_file = matches!(*name, "version" | "scene" | "layers");
        let is_none = matches!(
            (*name, value.as_str()),
            ("view", "own") | ("region" | "aov", "none")
        );
        !is_of_file && !is_none
    };
    let told = entries.into_iter().chain(spp).filter(is_told);
    let told: Vec<_> = told
        .map(|(name, value)| format!("{name} {value}"))
        .collect();
    told.join(", ")
}
