//! What the commands of a `.test` text mean: a state, which the primitives and lights catch.

mod objects;
pub(super) mod state;

use std::collections::HashMap;

use glam::DAffine3;

use super::schema::{
    CAMERA, INTEGRATOR, INTEGRATORS, MAXDEPTH, Method, PILES, READ_OVER, SIZE, SPP,
};
use super::{Cse167, view};
use crate::Lowered;
use crate::camera::{CameraSpans, check};
use crate::engine::lines::Lines;
use crate::engine::places::Places;
use crate::engine::reader::{Reader, Reading};
use crate::report::quoted;
use crate::schema::Category;
use objects::Meshes;

pub(super) use objects::Placed;
use scene::{Integrator, Light, MAX_DEPTH, Object, Rendering, Rgb, Scene, Setting};
use state::{Materials, State};
use text::{Diagnostic, Findings, Severity, Span, is_integer};

/// The depths of Whitted ray tracing and of paths where the text states none.
const DEPTHS: [u32; 2] = [5, ENDLESS];

/// The depth that −1 stands for.
const ENDLESS: u32 = 64;

/// Returns the errors of every text that begins with these commands.
pub(super) fn errors_of_beginning(text: &str, lines: &Lines<Cse167>) -> Findings {
    let mut lowering = Lowering::new(text, lines);
    // The last command may be incomplete, and a later camera replaces those before.
    for at in 0..lines.records.len().saturating_sub(1) {
        if !lowering.is_camera(at) {
            lowering.command(at);
        }
    }
    lowering.reader.report
}

/// What a text says besides its nodes.
#[derive(Clone, Debug, Default)]
pub(crate) struct Own {
    /// The render settings that its commands state, or its defaults.
    pub(super) rendering: Rendering,
    /// Where the transforms place each object.
    pub(super) objects: Vec<Placed>,
    /// The transforms of each light.
    pub(super) lights: Vec<DAffine3>,
    /// The transforms that each push keeps, by its index.
    pub(super) pushed: HashMap<usize, DAffine3>,
    /// The commands that state each material.
    pub(super) stated: Vec<[Option<usize>; 5]>,
    /// The number of objects that inherit what each command states, by its index.
    pub(super) inheritors: HashMap<usize, usize>,
    /// The first and the last object of each material. Those between have it too, or none.
    pub(super) ends: Vec<[usize; 2]>,
    /// The number of pushes that are open at the end of the text, and the transforms below them.
    pub(super) open: usize,
    pub(super) end: DAffine3,
}

/// Lowers a text.
pub(super) fn lower(text: &str, lines: &Lines<Cse167>) -> (Places<Own>, Lowered) {
    let mut lowering = Lowering::new(text, lines);
    let last = (0..lines.records.len())
        .rev()
        .find(|&at| lowering.is_camera(at));
    for at in 0..lines.records.len() {
        if lowering.is_camera(at) && Some(at) != last {
            lowering.superseded(at);
        } else {
            lowering.command(at);
        }
    }
    lowering.reader.settings();
    lowering.end();
    let camera = lowering.camera();
    let Lowering {
        reader: Reader {
            report, mut places, ..
        },
        lights,
        materials,
        rendering,
        ..
    } = lowering;
    let objects = lowering.objects;
    let asked = places
        .settings
        .map(|place| place.rendering)
        .unwrap_or_default();
    places.own.rendering = rendering;
    let scene = (report.errors() == 0).then(|| Scene {
        camera,
        ambient: Rgb::ONE,
        lights,
        materials: materials.all.into(),
        textures: Vec::new(),
        objects: objects.into_iter().collect(),
        setting: Setting {
            rendering: asked.or(rendering),
            ..Setting::default()
        },
    });
    let diagnostics = report.sorted();
    (places, Lowered { scene, diagnostics })
}

/// A lowering in progress.
struct Lowering<'a> {
    reader: Reader<'a, Cse167>,
    state: State,
    materials: Materials,
    meshes: Meshes,
    lights: Vec<Light>,
    objects: Vec<Object>,
    /// The objects that are area lights, with their radiance.
    area_lights: Vec<(usize, Rgb)>,
    /// The numbers of the view, and the places of the camera's.
    view: [f64; view::DEFAULT.len()],
    camera: Option<CameraSpans>,
    rendering: Rendering,
    /// The depth that the integrator cuts paths at.
    cut: Option<u32>,
    /// The first command that is ignored.
    read_over: Option<Span>,
}

impl<'a> Lowering<'a> {
    fn new(text: &'a str, lines: &'a Lines<Cse167>) -> Self {
        Self {
            reader: Reader::new(text, lines),
            state: State::default(),
            materials: Materials::default(),
            meshes: Meshes::default(),
            lights: Vec::new(),
            objects: Vec::new(),
            area_lights: Vec::new(),
            view: view::DEFAULT,
            camera: None,
            rendering: Rendering {
                default_depths: Some(DEPTHS),
                ..Rendering::default()
            },
            cut: None,
            read_over: None,
        }
    }

    /// The first word of a command.
    fn head(&self, at: usize) -> Span {
        let mut tokens = self.reader.lines.tokens(self.reader.text, at);
        tokens.next().unwrap_or_default()
    }

    fn is_camera(&self, at: usize) -> bool {
        let word = self.head(at).of(self.reader.text);
        word.eq_ignore_ascii_case(CAMERA.name)
    }

    /// Warns of a camera that a later one replaces, and of its errors.
    fn superseded(&mut self, at: usize) {
        let before = std::mem::take(&mut self.reader.report);
        if let Some(read) = self.reader.read(at)
            && let Some(numbers) = read.numbers()
        {
            let mut view = view::DEFAULT;
            view[..numbers.len()].copy_from_slice(numbers);
            let camera = view::VIEW.camera(&view);
            check(&camera, &camera_spans(&read.spans), &mut self.reader.report);
        }
        let found = std::mem::replace(&mut self.reader.report, before);
        for diagnostic in found.iter() {
            self.reader.report.warning(|| Diagnostic {
                severity: Severity::Warning,
                ..diagnostic.clone()
            });
        }
        self.reader.places.view[0] = None;
        let head = self.head(at);
        self.reader.report.warning(|| {
            let message = "camera: given again below";
            Diagnostic::warning(head, message, "one camera").with_hint("the last one counts")
        });
    }

    fn command(&mut self, at: usize) {
        let Some(read) = self.reader.read(at) else {
            return;
        };
        let head = self.head(at);
        if !PILES.contains(read.record) && read.record.category() != Some(Category::Object) {
            self.close_mesh();
        }
        match read.record.category() {
            Some(Category::Light) => self.light(&read),
            Some(_) => self.object(&read),
            None if *read.record == CAMERA || *read.record == SIZE => self.view(&read),
            None if READ_OVER.contains(&read.record.name) => {
                self.read_over.get_or_insert(head);
            }
            None => {
                if !self.asks(&read) && !self.changes_state(at, head, &read) {
                    self.piles(at, head, &read);
                }
            }
        }
    }

    fn view(&mut self, read: &Reading<'_>) {
        let Some(numbers) = read.numbers() else {
            return;
        };
        let spans = &read.spans;
        if *read.record == SIZE {
            let most = f64::from(u32::MAX);
            let over = numbers.iter().zip(spans).find(|(side, _)| most < **side);
            if let Some((_, span)) = over {
                self.reader.report.error(|| {
                    let message = format!("size: must be {most} at most");
                    Diagnostic::error(*span, message, "a whole number, 1 or more")
                });
                return;
            }
            self.view[CAMERA.numbers()..].copy_from_slice(numbers);
        } else {
            self.view[..CAMERA.numbers()].copy_from_slice(numbers);
            self.camera = Some(camera_spans(spans));
        }
    }

    /// The camera of the text, or the default one.
    fn camera(&mut self) -> scene::Camera {
        if self.reader.places.view[0].is_none() {
            self.reader.report.warning(|| {
                let message = "no `camera` command";
                Diagnostic::warning(Span::at(0), message, "a `camera` command")
                    .with_hint("the default camera is at the origin and looks along -z")
            });
        }
        let camera = view::VIEW.camera(&self.view);
        check(
            &camera,
            &self.camera.unwrap_or_default(),
            &mut self.reader.report,
        );
        camera
    }

    /// Reads a render setting; returns whether the command is one.
    fn asks(&mut self, read: &Reading<'_>) -> bool {
        let record = read.record;
        if ![MAXDEPTH, INTEGRATOR, SPP]
            .iter()
            .any(|asked| asked == record)
        {
            return false;
        }
        let Some(&[number]) = read.numbers() else {
            return true;
        };
        let span = read.spans[0];
        let word = span.of(self.reader.text);
        let range = |least: f64, most: u32| {
            let expected = format!("a whole number from {least} to {most}");
            let is_in = least <= number && number <= f64::from(most) && is_integer(word);
            let message = format!("{}: must be {expected}, not {}", record.name, quoted(word));
            (!is_in).then(|| Diagnostic::error(span, message, expected))
        };
        if *record == INTEGRATOR {
            let (integrator, depth) = match INTEGRATORS[number as usize].1 {
                Method::Whitted => (Integrator::Whitted, None),
                Method::Direct => (Integrator::Path, Some(1)),
                Method::Path => (Integrator::Path, None),
            };
            self.rendering.integrator = Some(integrator);
            self.cut = depth;
        } else if *record == SPP {
            match range(1.0, scene::MAX_SPP) {
                Some(bad) => self.reader.report.error(|| bad),
                None => self.rendering.spp = Some(number as u32),
            }
        } else {
            match range(-1.0, MAX_DEPTH) {
                Some(bad) => self.reader.report.error(|| bad),
                None if number < 0.0 => {
                    self.reader.report.note(|| {
                        let message = format!("maxdepth: -1 is read as {ENDLESS}");
                        Diagnostic::note(span, message, "a whole number, 0 or more")
                    });
                    self.rendering.depth = Some(ENDLESS);
                }
                None => self.rendering.depth = Some(number as u32),
            }
        }
        true
    }

    /// Closes what is open at the end of the text.
    fn end(&mut self) {
        self.close_mesh();
        self.report_piles();
        let below = self.state.pushed.first().map(|(_, below)| *below);
        self.reader.places.own.end = below.unwrap_or(self.state.transform);
        self.reader.places.own.open = self.state.pushed.len();
        if let Some(cut) = self.cut {
            // Only paths are cut, whatever `maxdepth` says.
            let whitted = self.rendering.depth.take().unwrap_or(DEPTHS[0]);
            self.rendering.default_depths = Some([whitted, cut]);
        }
        if let Some(&(open, _)) = self.state.pushed.first() {
            self.reader.report.note(|| {
                Diagnostic::note(
                    open,
                    "pushTransform: is never undone by popTransform",
                    "a matching popTransform",
                )
            });
        }
        if let Some(first) = self.read_over {
            self.reader.report.note(|| {
                let word = first.of(self.reader.text);
                let message = format!("{word}: ignored, like all commands for sampling");
                Diagnostic::note(first, message, "a command that affects the picture")
                    .with_hint("the renderer chooses its samples itself")
            });
        }
        if self.reader.places.objects().is_empty() && self.reader.report.errors() == 0 {
            self.reader.report.warning(|| {
                let expected = "a `sphere`, `tri` or `trinormal`";
                Diagnostic::warning(Span::at(0), "no object is defined", expected)
            });
        }
        self.name_materials();
        self.light_up();
    }
}

/// The places of a camera whose numbers are at these spans.
fn camera_spans(spans: &[Span]) -> CameraSpans {
    CameraSpans {
        eye: view::VIEW.eye.span(spans),
        target: view::VIEW.target.span(spans),
        up: view::VIEW.up.span(spans),
        whole: spans[0].to(spans[spans.len() - 1]),
        remedy: "",
    }
}

type Keys = HashMap<[Option<usize>; 5], usize>;
