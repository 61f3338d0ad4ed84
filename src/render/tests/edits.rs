//! Edits of materials and of lights' colours: retracing only dependent pixels gives the same
//! picture as tracing all of it.

use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

use super::meshes::{mesh, square};
use super::*;
use crate::engine::{Film, edit_difference, steps};
use crate::integrators::{Counts, FrameContext};
use crate::{Aov, Progress};
use geometry::{Csg, Instance, Node, Operation};
use scene::{Dielectric, Emitter, Faces, Falloff, Gloss, Highlight, Image, Mirror, Shadows};

fn built(job: &Job, known: Option<&World>) -> Option<World> {
    let scene = Arc::clone(&job.scene);
    let settings = WorldSettings::of(&job.settings);
    World::build(scene, &job.images, settings, known, &|| false)
}

/// A job in progress, taken step by step.
pub(super) struct Easel {
    pub(super) job: Job,
    world: World,
    pub(super) film: Film,
    counts: Counts,
}

impl Easel {
    pub(super) fn new(job: Job) -> Self {
        let world = built(&job, None);
        let film = Film::new(&job);
        Self {
            job,
            world: world.expect("nothing cancels"),
            film: film.expect("memory is there"),
            counts: Counts::default(),
        }
    }

    /// Continues with another job, reusing what it can.
    fn turn_to(&mut self, job: Job) {
        let world = built(&job, Some(&self.world)).expect("nothing cancels");
        let changed = edit_difference((&self.job, &self.world), (&job, &world));
        let film = Film::new(&job).expect("memory is there");
        let old = std::mem::replace(&mut self.film, film).into_checkpoint(Duration::ZERO);
        if Arc::ptr_eq(&self.world.emitters, &world.emitters) || !self.is_by_path() {
            self.film
                .take_over(old, changed.expect("materials and colours of lights"));
        } else {
            assert_eq!(changed, None, "all paths depend on what emits light");
        }
        (self.job, self.world) = (job, world);
        self.counts = Counts::default();
    }

    fn is_by_path(&self) -> bool {
        self.job.settings.integrator == Integrator::Path
    }

    /// Traces until cancellation has been polled `patience` times; returns whether it completed.
    pub(super) fn trace(&mut self, patience: u64) -> bool {
        let asked = AtomicU64::new(0);
        let cancelled = || patience <= asked.fetch_add(1, Ordering::Relaxed);
        let context = FrameContext::new(&self.world, &self.job.camera, self.job.settings);
        for step in steps(self.job.settings.spp, self.job.frames) {
            if self.film.select(&step) == 0.0 {
                break;
            }
            let (tiles, part) = (0..self.film.tiles(), (&step, step.indices()));
            let counts = self.film.advance(tiles, part, &context, &cancelled);
            self.counts = self.counts.and(counts);
            if cancelled() {
                return false;
            }
        }
        true
    }

    /// Everything displayed.
    pub(super) fn shows(&self) -> impl PartialEq + std::fmt::Debug + use<> {
        let spp = self.job.settings.spp;
        let mut pixels = Vec::new();
        self.film
            .develop_rows(0..self.film.rows(), &mut pixels, |tile, at| {
                let bits = tile.value(at, spp, None).to_array().map(f64::to_bits);
                let cost = tile.value(at, spp, Some(Aov::Cost)).x;
                let error = tile.error(at).to_bits();
                (bits, tile.object(at), cost.to_bits(), error)
            });
        let noise = self.film.noise().map(f64::to_bits);
        (pixels, noise, self.film.over_budget())
    }
}

fn one_of<T: Copy>(choices: &[T], random: &mut Random) -> T {
    choices[(random.next() * choices.len() as f64) as usize]
}

fn colour(random: &mut Random) -> Rgb {
    0.5 * (random.point(1.0) + 1.0)
}

/// A random material.
fn material(random: &mut Random) -> Material {
    let glass = one_of(&[0.0, 0.0, 0.7], random);
    let mirror = one_of(&[0.0, 0.0, 0.5], random);
    match one_of(&[0, 1, 1, 1, 1, 2, 2, 3], random) {
        0 => Material::unlit(colour(random)),
        1 => {
            let material = Coefficients {
                ambient: Rgb::splat(0.1),
                diffuse: colour(random),
                specular: Rgb::splat(0.3),
                exponent: 10.0,
                reflection: mirror,
                transmission: glass,
                index: 1.3,
            };
            let texture = one_of(&[None, None, Some(0)], random);
            painted(material, texture)
        }
        kind => {
            let diffuse = colour(random);
            let highlight = if kind == 2 {
                Highlight::Blinn(Gloss {
                    specular: Rgb::splat(0.5),
                    exponent: 20.0,
                })
            } else {
                Highlight::Microfacet {
                    roughness: random.next(),
                    metallic: random.next(),
                }
            };
            let spread = one_of(&[0.0, 0.2], random);
            Material {
                diffuse,
                highlight,
                mirror: Mirror {
                    tint: Rgb::splat(mirror),
                    spread,
                    faces: Faces::Front,
                },
                dielectric: Dielectric {
                    tint: Rgb::splat(glass),
                    index: 1.3,
                    absorption: colour(random),
                    ..Dielectric::OPAQUE
                },
                emission: one_of(&[Rgb::ZERO, Rgb::splat(0.2)], random),
                lit: if glass == 0.0 {
                    Faces::Both
                } else {
                    Faces::Front
                },
                ..Material::BLACK
            }
        }
    }
}

/// A slanted square of two triangles with different tags.
fn leaf(centre: DVec3, size: f64, tags: [u32; 2]) -> Shape {
    let columns = [DVec3::new(1.0, 0.0, 1.0), DVec3::Y, DVec3::Z];
    let frame = Affine::of_matrix(columns.map(|column| size * column), centre);
    Shape::Mesh(Box::new(Instance::new(
        mesh(square()),
        &frame.expect("it has a volume"),
        tags.to_vec(),
    )))
}

/// A ball minus another, each with its own tag.
fn bitten(centre: DVec3, size: f64, tags: [u32; 2]) -> Shape {
    let ball = |off: f64, tag| operand(sphere((centre + off * size).to_array(), size), tag);
    Shape::Csg(Arc::new(Csg::new(vec![
        ball(0.0, tags[0]),
        ball(0.4, tags[1]),
        Node::Operation {
            operation: Operation::Difference,
            first: 0,
            second: 1,
        },
    ])))
}

/// A floor with solids of all kinds above it, each with one or two materials of its own.
fn still(count: usize, random: &mut Random) -> Scene {
    let materials: Vec<_> = (0..count + 2).map(|_| material(random)).collect();
    let mut objects = vec![Object {
        shape: cuboid([-9.0, -2.0, -9.0], [18.0, 0.5, 18.0]),
        material: 0,
    }];
    for number in 1..count as u32 {
        let (centre, size) = (random.point(1.5), 0.2 + 0.5 * random.next());
        let tags = [number, number + 1];
        let shape = match one_of(&[0, 0, 1, 2, 3], random) {
            0 => sphere(centre.to_array(), size),
            1 => cuboid(centre.to_array(), [size; 3]),
            2 => bitten(centre, size, tags),
            _ => leaf(centre, size, tags),
        };
        objects.push(Object {
            shape,
            material: number,
        });
    }
    let light = |random: &mut Random| {
        let from = DVec3::new(0.0, 4.0, 3.0) + random.point(3.0);
        let falloff = Falloff {
            radial: [1.0, 0.0, 0.01],
            spot: Some((-from.normalize(), 40.0)),
        };
        let lamp = Light::point(from, colour(random));
        match one_of(&[0, 1, 2, 3, 4], random) {
            0 => Light {
                emitter: Emitter::Distant(from.normalize()),
                ..lamp
            },
            1 => Light {
                emitter: Emitter::Point {
                    position: from,
                    radius: 0.0,
                    falloff,
                },
                ..lamp
            },
            2 => Light {
                shadows: Shadows::Off,
                ..lamp
            },
            3 => Light {
                emitter: Emitter::Point {
                    position: from,
                    radius: 0.5,
                    falloff: Falloff::NONE,
                },
                ..lamp
            },
            _ => lamp,
        }
    };
    let lights: Vec<_> = (0..3).map(|_| light(random)).collect();
    Scene {
        materials: materials.into(),
        objects: objects.into_iter().collect(),
        textures: vec![checker(DVec2::splat(8.0), [Rgb::ZERO, Rgb::ONE])],
        ambient: Rgb::splat(0.5),
        ..scene(&[], &lights)
    }
}

/// The scene with one or two materials, or the colour of a light, changed.
fn edited(scene: &Scene, random: &mut Random) -> Scene {
    let mut scene = scene.clone();
    if random.next() < 0.15 {
        let light = (random.next() * scene.lights.len() as f64) as usize;
        scene.lights[light].colour = one_of(&[Rgb::ZERO, colour(random)], random);
        return scene;
    }
    for _ in 0..one_of(&[1, 1, 1, 2], random) {
        let number = (random.next() * scene.materials.len() as f64) as usize;
        scene.materials[number] = material(random);
    }
    scene
}

#[test]
fn a_thousand_edits_match_complete_renders() {
    let mut random = Random(51);
    let (mut edits, mut traced, mut all) = (0, 0, 0);
    while edits < 1000 {
        let count = one_of(&[4, 8, 8, 12, 90], &mut random);
        let mut scene = Arc::new(still(count, &mut random));
        let settings = Settings {
            depth: 4,
            integrator: one_of(
                &[Integrator::Whitted, Integrator::Whitted, Integrator::Path],
                &mut random,
            ),
            ..settings(19, 17, one_of(&[1, 2, 3, 5], &mut random))
        };
        let mut easel = Easel::new(job(&scene, settings));
        easel.trace(u64::MAX);
        for _ in 0..20 {
            let before = Arc::clone(&scene);
            scene = Arc::new(edited(&scene, &mut random));
            let is_light = scene.lights != before.lights;
            if is_light && settings.integrator == Integrator::Path {
                scene = before;
                continue;
            }
            easel.turn_to(job(&scene, settings));
            edits += 1;
            let patience = (200.0 * random.next()) as u64;
            if random.next() < 0.4 && !easel.trace(patience) {
                // The next edit comes before this picture.
                continue;
            }
            easel.trace(u64::MAX);
            let mut anew = Easel::new(job(&scene, settings));
            anew.trace(u64::MAX);
            assert_eq!(easel.shows(), anew.shows(), "edit {edits}");
            traced += easel.counts.rays;
            all += anew.counts.rays;
        }
    }
    assert!(2 * traced < all, "{traced} rays of {all}");
}

/// Nested reflective glass, whose rays double until they exceed the budget, beside a matte ball.
#[test]
fn samples_over_their_budget_are_counted_once() {
    let splitting = Coefficients {
        reflection: 1.0,
        transmission: 1.0,
        index: 1.0,
        ..BLACK
    };
    let nested = (1..=6).map(|k| (sphere([-0.8, 0.0, 0.0], 0.1 * f64::from(k)), splitting));
    let mut balls: Vec<_> = nested.collect();
    balls.push((sphere([0.8, 0.0, 0.0], 0.7), grey(0.5)));
    let settings = Settings {
        depth: 30,
        ..settings(5, 4, 2)
    };
    let job_with = |levels: [f64; 2]| {
        let mut scene = scene(&balls, &[]);
        scene.materials[0] = Material::from(Coefficients {
            ambient: Rgb::splat(levels[0]),
            ..splitting
        });
        scene.materials[6] = Material::from(grey(levels[1]));
        job(&Arc::new(scene), settings)
    };
    let mut easel = Easel::new(job_with([0.0, 0.5]));
    easel.trace(u64::MAX);
    for levels in [[0.0, 0.9], [0.1, 0.9], [0.2, 0.4]] {
        easel.turn_to(job_with(levels));
        easel.trace(u64::MAX);
        let mut anew = Easel::new(job_with(levels));
        anew.trace(u64::MAX);
        assert!(0 < anew.film.over_budget());
        assert_eq!(easel.shows(), anew.shows(), "{levels:?}");
    }
}

#[test]
fn a_renderer_keeps_pixels_that_an_edit_does_not_affect() {
    let mut random = Random(52);
    let (mut renderer, woken) = renderer(2);
    let settings = settings(61, 37, 5);
    let mut scene = Arc::new(still(8, &mut random));
    let first = restart(&mut renderer, job(&scene, settings));
    finish(&renderer, &woken, first);
    let (mut traced, mut all) = (0, 0);
    for _ in 0..12 {
        // Each is cancelled by the next as soon as it has shown a frame.
        scene = Arc::new(edited(&scene, &mut random));
        restart(&mut renderer, job(&scene, settings));
        woken.recv().expect("a first frame");
        renderer.latest();
        scene = Arc::new(edited(&scene, &mut random));
        let generation = restart(&mut renderer, job(&scene, settings));
        let kept = finish(&renderer, &woken, generation);
        let (mut other, other_woken) = super::renderer(2);
        let generation = restart(&mut other, job(&scene, settings));
        let anew = finish(&other, &other_woken, generation);
        assert!(kept.pixels == anew.pixels && kept.objects == anew.objects);
        let told = |frame: &Frame| Progress {
            elapsed: Duration::ZERO,
            rays: 0,
            shadow_rays: 0,
            ..frame.progress
        };
        assert_eq!(told(&kept), told(&anew));
        traced += kept.progress.rays;
        all += anew.progress.rays;
    }
    assert!(traced < all, "{traced} rays of {all}");
}

#[test]
fn other_edits_trace_everything_again() {
    let mut random = Random(53);
    let scene = still(8, &mut random);
    let before = Easel::new(job(&Arc::new(scene.clone()), settings(8, 6, 1)));
    let changed = |job: Job| {
        let known = Some(&before.world);
        let world = built(&job, known);
        let world = world.expect("nothing cancels");
        edit_difference((&before.job, &before.world), (&job, &world))
    };
    let of_scene = |change: &dyn Fn(&mut Scene)| {
        let mut scene = scene.clone();
        change(&mut scene);
        changed(Job {
            camera: before.job.camera,
            ..job(&Arc::new(scene), before.job.settings)
        })
    };
    let of_job = |change: &dyn Fn(&mut Job)| {
        let mut job = before.job.clone();
        change(&mut job);
        changed(job)
    };
    assert_eq!(of_job(&|_| {}), Some(Dependencies::default()));
    assert_eq!(of_job(&|job| job.camera.eye.x += 1.0), None);
    assert_eq!(
        of_job(&|job| job.settings.spp += 1),
        Some(Dependencies::default())
    );
    assert_eq!(of_job(&|job| job.settings.size.width += 1), None);
    assert_eq!(of_job(&|job| job.settings.aov = Some(Aov::Albedo)), None);
    assert_eq!(of_job(&|job| job.frames = Frames::Last), None);
    let red = Image::new(
        Size {
            width: 1,
            height: 1,
        },
        vec![[255, 0, 0]],
    );
    let red = Arc::new(red.expect("a pixel"));
    let images =
        |job: &mut Job| job.images = [("red".to_owned(), Arc::clone(&red))].into_iter().collect();
    assert_eq!(of_job(&images), None);
    assert_eq!(of_scene(&|scene| scene.ambient.x += 0.1), None);
    assert_eq!(of_scene(&|scene| scene.lights[0].scale += 1.0), None);
    let elsewhere = |scene: &mut Scene| scene.lights[0].emitter = Emitter::Ambient;
    assert_eq!(of_scene(&elsewhere), None);
    assert_eq!(of_scene(&|scene| scene.lights.truncate(1)), None);
    assert_eq!(
        of_scene(&|scene| scene.textures[0].inverse.matrix3.x_axis.x = 3.0),
        None
    );
    let fewer = |scene: &mut Scene| {
        scene.objects = scene.objects.iter().take(3).cloned().collect();
    };
    assert_eq!(of_scene(&fewer), None);
    let sky = |scene: &mut Scene| scene.setting.background.colour.x = 1.0;
    assert_eq!(of_scene(&sky), None);
    let moved = |scene: &mut Scene| scene.objects[1].shape = sphere([0.0; 3], 0.1);
    assert_eq!(of_scene(&moved), None);
    let dimmed = |scene: &mut Scene| scene.lights[1].colour *= 0.5;
    assert_eq!(of_scene(&dimmed), Some(Dependencies::light(1)));
    // Renumbering the floor's material changes nothing.
    let renumbered = |scene: &mut Scene| {
        scene.objects[0].material = scene.materials.len() as u32;
        scene
            .materials
            .edit(|materials| materials.extend_from_within(..1));
    };
    assert_eq!(of_scene(&renumbered), Some(Dependencies::default()));
    let other = |scene: &mut Scene| scene.materials[0] = Material::unlit(Rgb::new(0.1, 0.2, 0.3));
    assert_eq!(of_scene(&other), Some(Dependencies::object(0)));
}

#[test]
fn rays_hit_the_same_after_objects_come_and_go() {
    let mut random = Random(52);
    let ball = |random: &mut Random| Object {
        shape: sphere(random.point(5.0).to_array(), 0.2),
        material: 0,
    };
    let objects: Vec<_> = (0..9000).map(|_| ball(&mut random)).collect();
    let mut scene = still(1, &mut random);
    scene.objects = objects.into_iter().collect();
    let world = |scene: &Scene, known: Option<&World>| {
        let job = job(&Arc::new(scene.clone()), settings(19, 17, 1));
        built(&job, known).expect("nothing cancels")
    };
    let mut adapted = world(&scene, None);
    let mut differ = 0;
    for (at, removed, inserted) in [
        (17, 1, 0),
        (0, 0, 1),
        (8999, 1, 0),
        (5000, 0, 2),
        (40, 2, 0),
    ] {
        let new: Vec<_> = (0..inserted).map(|_| ball(&mut random)).collect();
        scene.objects.edit(|objects| {
            objects.splice(at..at + removed, new);
        });
        adapted = world(&scene, Some(&adapted));
        let fresh = world(&scene, None);
        differ += u32::from(adapted.order() != fresh.order());
        let mut hits = 0;
        for _ in 0..500 {
            let ray = Ray {
                origin: random.point(6.0),
                direction: random.point(1.0).normalize(),
            };
            let nearest = adapted.nearest(&ray, f64::INFINITY);
            assert_eq!(nearest, fresh.nearest(&ray, f64::INFINITY));
            hits += u32::from(nearest.is_some());
        }
        assert!(100 < hits, "{hits}");
    }
    assert!(0 < differ, "the tree is adapted");
}
