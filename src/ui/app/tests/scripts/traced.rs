//! Pictures that are traced, judged and listed in scripts.

use std::collections::VecDeque;
use std::sync::mpsc;

use super::steps::number;
use super::*;
use crate::history_scene::{HistoryScene, HistoryText, NoPicture};
use render::{Aov, Frame, NO_OBJECT, PreparedScene, Query, Renderer, Threads};

impl Session {
    /// A complete frame of what is traced, of this many samples, with the objects that are seen in it.
    pub(super) fn traced(&mut self, target: Target, spp: &str) -> Result<Msg, String> {
        let prepared = PreparedScene::new(self.job(target)?, &|| false).ok_or("cancelled")?;
        let (query, size) = (prepared.query().clone(), self.job(target)?.settings.size);
        let object = |at: u32| {
            let first = query.first_hit([at % size.width, at / size.width])?;
            Some(first.surface?.object)
        };
        let objects = (0..size.pixels() as u32).map(|at| object(at).unwrap_or(NO_OBJECT));
        let mut frame = frame_of(size, objects.collect());
        if !spp.is_empty() {
            frame.progress.spp = number(spp)?;
        }
        frame.values = vec![[0.5, 0.25, 2.0]; size.pixels()];
        frame.query = Some(query);
        self.under_way.prepared.push(prepared);
        self.update(Msg::Started(target, frame.generation));
        Ok(Msg::Frame(target, Arc::new(frame)))
    }

    /// A complete frame of what is traced, as a renderer makes it.
    pub(super) fn rendered(&mut self, target: Target) -> Result<Msg, String> {
        let (wake, woken) = mpsc::channel();
        let mut renderer = Renderer::new(Threads::Exactly(1), move || {
            // This fails only once the frame is there.
            let _ = wake.send(());
        });
        let begun = renderer.restart(self.job(target)?.clone());
        begun.map_err(|refused| refused.to_string())?;
        let generation = self.under_way.jobs.len() as u64 + 100;
        self.update(Msg::Started(target, generation));
        loop {
            woken.recv().map_err(|ended| ended.to_string())?;
            if let Some(mut frame) = renderer.latest().filter(|frame| frame.progress.complete) {
                Arc::make_mut(&mut frame).generation = generation;
                return Ok(Msg::Frame(target, frame));
            }
        }
    }

    /// The preview, of a single grey.
    pub(super) fn light(&mut self, grey: &str) -> Result<Msg, String> {
        let job = self.job(Target::Preview)?;
        let settings = job.settings;
        let has_range = matches!(settings.aov, Some(Aov::Cost | Aov::Samples | Aov::Depth));
        let pixels = settings.size.pixels();
        let frame = Frame {
            values: vec![[number(grey)?; 3]; pixels],
            range: has_range.then_some([1.0, 311.6]),
            query: Some(Query::unanswered(job.camera, settings)),
            ..frame_of(settings.size, vec![0; pixels])
        };
        self.update(Msg::Started(Target::Preview, 1));
        Ok(Msg::Frame(Target::Preview, Arc::new(frame)))
    }

    /// The trial that is traced: three quarters of it have this grey, and the rest an eighth of it.
    pub(super) fn trial(&mut self, grey: &str) -> Result<Msg, String> {
        let (size, grey) = (self.job(Target::Trial)?.settings.size, number::<f32>(grey)?);
        let columns = (0..size.pixels() as u32).map(|at| at % size.width);
        let is_dark = |column: u32| column * 4 < size.width;
        let values = columns.map(|column| [if is_dark(column) { 0.125 * grey } else { grey }; 3]);
        let frame = Frame {
            generation: 7,
            values: values.collect(),
            objects: vec![0; size.pixels()],
            ..Frame::drawn(size, Vec::new())
        };
        self.update(Msg::Started(Target::Trial, 7));
        Ok(Msg::Frame(Target::Trial, Arc::new(frame)))
    }

    /// Shows a preview of this grey, and answers all trials of what would help with the same, except
    /// those that have a setting named after a colon: these with the grey behind it.
    pub(super) fn judged(&mut self, rest: &str) -> Result<(), String> {
        let (grey, others) = rest.split_once(": ").unwrap_or((rest, ""));
        let mut msg = self.light(grey)?;
        let mut has_tried = false;
        loop {
            self.update(msg);
            let mut traced = self.effects.iter().filter_map(traced_by);
            let trial = traced.find(|(target, _)| *target == Target::Trial);
            let Some((_, trial)) = trial else { break };
            let written = trial.settings.written();
            let has = |setting: &str| {
                let mut written = written.iter();
                setting == "all"
                    || written.any(|(name, value)| format!("{name} {value}") == setting)
            };
            let mut others = others
                .split("; ")
                .filter_map(|other| other.rsplit_once(' '));
            let other = others.find(|(setting, _)| has(setting));
            msg = self.trial(other.map_or(grey, |(_, grey)| grey))?;
            has_tried = true;
        }
        match self.does("stop trial") {
            (ends, _) if ends == has_tried => Ok(()),
            (_, effects) => Err(format!("the trials have no end: {effects}")),
        }
    }

    /// Does what the page of the history asks for until it has its pictures. Then `derived` are the
    /// texts in this order, each with the objects of its picture and how it is seen, unless as itself.
    pub(super) fn thumbnails(&mut self) {
        let mut derived: Vec<String> = Vec::new();
        let mut left = VecDeque::from(std::mem::take(&mut self.effects));
        while let Some(effect) = left.pop_front() {
            let msgs = match effect {
                Effect::Derive(past) => {
                    derived.push(past.at.to_string());
                    vec![derived_scene(&past)]
                }
                Effect::Trace(Target::Thumbnail, job) => {
                    let seen = match Some(job.camera) {
                        Some(camera) if camera == job.scene.camera => "",
                        camera if camera == self.app.shared.camera() => " as seen",
                        _ => " from elsewhere",
                    };
                    if let Some(last) = derived.last_mut() {
                        *last = format!("{last}: {}{seen}", job.scene.objects.len());
                    }
                    let size = job.settings.size;
                    let mut frame = frame_of(size, vec![0; size.pixels()]);
                    frame.generation = 100 + derived.len() as u64;
                    vec![
                        Msg::Started(Target::Thumbnail, frame.generation),
                        Msg::Frame(Target::Thumbnail, Arc::new(frame)),
                    ]
                }
                _ => Vec::new(),
            };
            left.extend(msgs.into_iter().flat_map(|msg| self.app.update(msg)));
        }
        self.call("derived", &derived.join(", "));
    }
}

/// The scene of an earlier text, as it is reported.
pub(super) fn derived_scene(past: &HistoryText) -> Msg {
    let text = past.timeline.text(past.at);
    let scene = opened_as("scene.ray", &text).0.shared.scene;
    let scene = scene.ok_or(NoPicture::Errors).map(|scene| HistoryScene {
        scene,
        images: past.files.images.clone(),
    });
    Msg::Derived(past.ticket, scene)
}
