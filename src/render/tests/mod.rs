//! Tests of pixels whose values are known analytically.

mod adaptive;
mod blocks;
mod cameras;
mod continuing;
mod cut_discs;
mod darkness;
mod denoising;
mod edits;
mod emitters;
mod explain;
mod falloff;
mod filters;
mod first_hits;
mod glass;
mod highlights;
mod invariance;
mod keeping;
mod lamps;
mod looks;
mod many_lights;
mod meshes;
mod nearby;
mod noise;
mod optics;
mod paths;
mod photon_pictures;
mod photons;
mod progress;
mod regions;
mod setting_search;
mod shading;
mod solids;
mod spread;
mod textures;
mod visibility;

use std::sync::{Arc, mpsc};

use glam::{DVec2, DVec3};

use super::integrators::{Sample, SampleResult, Tracer};
use super::sampling::Sampler;
use super::world::{Dependencies, World, WorldSettings};
use super::{Frame, Frames, Job, NO_OBJECT, Renderer, Settings, Threads};
use geometry::{Affine, Cone, Cuboid, Ellipsoid, Node, Ray, Shape, Solid, Sphere};
use language::coefficients::Coefficients;
use language::{Language, Source};
use scene::{
    Camera, FalloffRule, Filter, Focus, GlossRule, Images, Integrator, Lens, Light, Maps, Material,
    Meshes, Object, Pattern, Rendering, Rgb, Scene, Setting, Side, Size, Texture, Tinted, Transfer,
};

impl Tracer<'_> {
    /// Radiance along one camera ray.
    fn radiance(&mut self, sample: &Sample) -> SampleResult {
        let mut seen = Vec::new();
        self.trace(&[*sample], &mut seen);
        seen[0]
    }
}

/// Deterministic numbers in 0..1 (Vigna's splitmix64).
pub(super) struct Random(pub(super) u64);

impl Random {
    pub(super) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut bits = self.0;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((bits ^ (bits >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    pub(super) fn point(&mut self, size: f64) -> DVec3 {
        size * (2.0 * DVec3::new(self.next(), self.next(), self.next()) - 1.0)
    }
}

const BLACK: Coefficients = Coefficients {
    ambient: Rgb::ZERO,
    diffuse: Rgb::ZERO,
    specular: Rgb::ZERO,
    exponent: 1.0,
    reflection: 0.0,
    transmission: 0.0,
    index: 1.0,
};

/// A material that only reflects this fraction of ambient light, which is 1 in [`scene`]: its grey
/// is the same wherever it is visible.
fn grey(level: f64) -> Coefficients {
    Coefficients {
        ambient: Rgb::splat(level),
        ..BLACK
    }
}

/// Six nested balls of grey 1 with r = t = 1: rays double at each surface.
fn splitting_glass() -> Scene {
    let glass = Coefficients {
        reflection: 1.0,
        transmission: 1.0,
        index: 1.0,
        ..grey(1.0)
    };
    let ball = |radius| (sphere([0.0; 3], f64::from(radius)), glass);
    scene(&(1..=6).map(ball).collect::<Vec<_>>(), &[])
}

/// A material with one texture in all slots of its own colours.
fn painted(material: impl Into<Material>, texture: Option<u32>) -> Material {
    let maps = Maps {
        ambient: texture,
        diffuse: texture,
        specular: texture,
        ..Maps::default()
    };
    Material {
        maps: maps.boxed(),
        ..material.into()
    }
}

/// A checker in two colours, repeated over the unit square.
fn checker(repeat: DVec2, colours: [Rgb; 2]) -> Texture {
    let plain = |colour| Tinted {
        colour,
        texture: None,
    };
    let pattern = Pattern::Checker {
        squares: colours.map(plain),
        side: Side::One,
    };
    Texture::repeated(repeat, pattern)
}

fn sphere(centre: [f64; 3], radius: f64) -> Shape {
    Shape::Solid(Solid::Sphere(Sphere {
        centre: centre.into(),
        radius,
    }))
}

/// An operand of a set operation.
#[track_caller]
fn operand(shape: Shape, tag: u32) -> Node {
    let Shape::Solid(solid) = shape else {
        panic!("{shape:?} is not a solid");
    };
    Node::Leaf { solid, tag }
}

/// An axis-aligned box.
fn cuboid(corner: [f64; 3], size: [f64; 3]) -> Shape {
    let frame = Affine::new(corner.into(), [DVec3::X, DVec3::Y, DVec3::Z], size.into());
    Shape::Solid(Solid::Cuboid(Box::new(Cuboid(
        frame.expect("the axes span a volume"),
    ))))
}

/// A scene in white ambient light, seen from (0, 0, 5) toward the origin.
fn scene(objects: &[(Shape, Coefficients)], lights: &[Light]) -> Scene {
    let material = |(index, (shape, _)): (usize, &(Shape, Coefficients))| Object {
        shape: shape.clone(),
        material: index as u32,
    };
    Scene {
        camera: Camera {
            eye: DVec3::new(0.0, 0.0, 5.0),
            target: DVec3::ZERO,
            up: DVec3::Y,
            lens: Lens::Perspective(45.0),
            pixel_aspect: 1.0,
            depths: Camera::ALL_DEPTHS,
            focus: Focus::PINHOLE,
            size: Size {
                width: 40,
                height: 30,
            },
        },
        ambient: Rgb::ONE,
        lights: lights.to_vec(),
        materials: objects
            .iter()
            .map(|(_, coefficients)| Material::from(*coefficients))
            .collect(),
        textures: Vec::new(),
        objects: objects.iter().enumerate().map(material).collect(),
        setting: Setting::default(),
    }
}

/// Parses a scene of XML elements, without its own camera.
fn xml(scene: &str) -> Scene {
    xml_seen_by("<camera/>", scene)
}

/// Parses a scene of XML elements, with this camera.
fn xml_seen_by(camera: &str, scene: &str) -> Scene {
    let text = format!("<xml><scene>{scene}</scene>{camera}</xml>");
    let mut source = Source::new(Language::Xml, Arc::new(text.clone()));
    let lowered = source.lower(&Meshes::default()).expect("there is memory");
    let findings = lowered.diagnostics;
    lowered
        .scene
        .unwrap_or_else(|| panic!("{text}: {findings:?}"))
}

fn white_light(position: [f64; 3]) -> Light {
    Light::point(position.into(), Rgb::ONE)
}

/// The world settings of path tracing, without any that a scene would have to ask for.
const PATHS: WorldSettings = WorldSettings {
    integrator: Integrator::Path,
    falloff: FalloffRule::None,
    gloss: GlossRule::None,
};

fn world(scene: Scene) -> World {
    World::build(Arc::new(scene), &Images::default(), PATHS, None, &|| false)
        .expect("nothing cancels the building")
}

fn ray(origin: [f64; 3], toward: [f64; 3]) -> Ray {
    let origin = DVec3::from(origin);
    Ray {
        origin,
        direction: (DVec3::from(toward) - origin).normalize(),
    }
}

/// Creates a Whitted tracer.
fn tracer(world: &World, depth: u32) -> Tracer<'_> {
    Tracer::new(world, Integrator::Whitted, depth, &|| false)
}

/// The sample of a ray at the centre of all distributions.
fn centred(ray: Ray, reach: f64) -> Sample {
    Sample {
        ray,
        reach,
        screen: DVec2::splat(0.5),
        sampler: Sampler::new(0, 0, 0, 0),
    }
}

/// The result of one ray, and the number of samples over budget.
fn look(scene: Scene, depth: u32, ray: Ray) -> (SampleResult, u64) {
    let world = world(scene);
    let mut tracer = tracer(&world, depth);
    let seen = tracer.radiance(&centred(ray, f64::INFINITY));
    (seen, tracer.counts().over_budget)
}

/// The grey level along a ray.
fn level(scene: Scene, depth: u32, ray: Ray) -> f64 {
    let radiance = look(scene, depth, ray).0.radiance;
    assert!(
        radiance.x == radiance.y && radiance.y == radiance.z,
        "{radiance} is not grey"
    );
    radiance.x
}

/// A low-discrepancy sequence in any number of dimensions: multiples of roots of primes.
struct Numbers {
    index: f64,
    taken: usize,
}

impl Numbers {
    fn new(index: usize) -> Self {
        Self {
            index: index as f64 + 1.0,
            taken: 0,
        }
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        const PRIMES: [f64; 24] = [
            2., 3., 5., 7., 11., 13., 17., 19., 23., 29., 31., 37., 41., 43., 47., 53., 59., 61.,
            67., 71., 73., 79., 83., 89.,
        ];
        self.taken += 1;
        let root = PRIMES[(self.taken - 1) % PRIMES.len()].sqrt();
        low + (self.index * root).fract() * (high - low)
    }

    fn below(&mut self, bound: usize) -> usize {
        self.between(0.0, bound as f64) as usize
    }

    fn in_cube(&mut self) -> DVec3 {
        DVec3::from_array([(); 3].map(|()| self.between(-1.0, 1.0)))
    }

    fn direction(&mut self) -> DVec3 {
        let z = self.between(-1.0, 1.0);
        let (y, x) = self.between(0.0, std::f64::consts::TAU).sin_cos();
        let radius = (1.0 - z * z).sqrt();
        DVec3::new(radius * x, radius * y, z).normalize()
    }
}

fn assert_near(value: f64, expected: f64, tolerance: f64) {
    assert!(
        (value - expected).abs() <= tolerance,
        "{value} is not {expected} ± {tolerance}"
    );
}

fn settings(width: u32, height: u32, spp: u32) -> Settings {
    Settings {
        spp,
        ..Settings::new(Size { width, height }, &Rendering::default())
    }
}

fn job(scene: &Arc<Scene>, settings: Settings) -> Job {
    Job {
        scene: Arc::clone(scene),
        images: Images::default(),
        camera: scene.camera,
        settings,
        limit: None,
        frames: Frames::Live,
        denoise: false,
        numbers: None,
    }
}

/// A renderer, and the receiver of its wake-ups.
fn renderer(threads: usize) -> (Renderer, mpsc::Receiver<()>) {
    let (wake, woken) = mpsc::channel();
    let renderer = Renderer::new(Threads::Exactly(threads), move || {
        let _ = wake.send(());
    });
    (renderer, woken)
}

/// Gives the renderer a job and returns its generation.
fn restart(renderer: &mut Renderer, job: Job) -> u64 {
    renderer.restart(job).expect("the worker runs")
}

/// Waits for the complete frame of a generation.
fn finish(renderer: &Renderer, woken: &mpsc::Receiver<()>, generation: u64) -> Arc<Frame> {
    loop {
        woken.recv().expect("the worker runs until it is dropped");
        if let Some(frame) = renderer.latest()
            && frame.generation == generation
            && frame.progress.complete
        {
            return frame;
        }
    }
}
