//! Photons against closed forms, independent numerical integration and path tracing.

use std::f64::consts::PI;

use super::*;
use crate::integrators::{PhotonMaps, PhotonRules, Photons};
use scene::Emitter;

/// The light along rays, each the mean over `maps` samples, by photons of which each map has `count`.
#[derive(Clone, Copy)]
pub(super) struct Traced {
    pub(super) depth: u32,
    pub(super) count: u32,
    pub(super) maps: u32,
}

/// The world settings of path tracing with photons.
pub(super) const PHOTONS: WorldSettings = PATHS;

pub(super) fn world_by(scene: &Scene, rules: WorldSettings) -> World {
    World::build(
        Arc::new(scene.clone()),
        &Images::default(),
        rules,
        None,
        &|| false,
    )
    .expect("nothing cancels the building")
}

/// The mean radiance along rays, over `samples` of each.
fn mean_of(
    world: &World,
    depth: u32,
    maps: Option<&PhotonMaps>,
    rays: &[Ray],
    (samples, seed): (u32, u32),
) -> Rgb {
    let integrator = maps.map_or(Integrator::Path, |_| Integrator::Photon);
    let tracer = Tracer::new(world, integrator, depth, &|| false);
    let mut tracer = tracer.with_photons(maps);
    let mut sum = Rgb::ZERO;
    for (number, &ray) in (0..).zip(rays) {
        for index in 0..samples {
            let sample = Sample {
                sampler: Sampler::new(number, 0, index, seed),
                ..centred(ray, f64::INFINITY)
            };
            sum += tracer.radiance(&sample).radiance;
        }
    }
    sum / f64::from(samples) / rays.len() as f64
}

impl Traced {
    pub(super) fn mean(&self, world: &World, rays: &[Ray], seed: u32) -> Rgb {
        let Self { depth, count, maps } = *self;
        let rules = PhotonRules {
            count,
            depth,
            seed,
            falloff: FalloffRule::None,
            gloss: world.gloss,
        };
        let photons = Photons::build(world, rules, None, &|| false);
        let photons = photons.expect("nothing cancels");
        let traced = photons.maps(world, 0..maps, &|| false);
        let traced = traced.expect("nothing cancels");
        mean_of(world, depth, Some(&traced), rays, (maps, seed))
    }
}

/// Rays in one direction down to points of the ground near one.
fn around([x, y]: [f64; 2]) -> Vec<Ray> {
    let ray = |index| {
        let mut numbers = Numbers::new(index);
        let (x, y) = (
            x + numbers.between(-0.4, 0.4),
            y + numbers.between(-0.4, 0.4),
        );
        ray([x + 0.01, y, 0.02], [x, y, 0.0])
    };
    (0..64).map(ray).collect()
}

/// The mean over the points where rays meet the ground.
fn mean(rays: &[Ray], of: impl Fn(DVec3) -> f64) -> f64 {
    let at = |ray: &Ray| ray.at(-ray.origin.z / ray.direction.z);
    rays.iter().map(|ray| of(at(ray))).sum::<f64>() / rays.len() as f64
}

/// What the ground gets of a light of intensity 1: cos θ / d².
pub(super) fn cosine_over_square(at: DVec3, light: [f64; 3]) -> f64 {
    let offset = DVec3::from(light) - at;
    offset.z / offset.length().powi(3)
}

/// Rays down to points of the ground within a distance of the origin along both axes, from close
/// above.
pub(super) fn onto_ground(half: f64, count: usize) -> Vec<Ray> {
    let ray = |index| {
        let mut numbers = Numbers::new(index);
        let (x, y) = (numbers.between(-half, half), numbers.between(-half, half));
        ray([x + 0.01, y, 0.02], [x, y, 0.0])
    };
    (0..count).map(ray).collect()
}

/// A matte ground at height 0 that reflects everything.
pub(super) const WHITE: &str = "<object type='plane' material='white'><scale value='30'/></object>
    <material name='white'><diffuse value='1'/><specular value='0'/></material>";

/// A light at (2, 0, 3) before a mirror x = 0: the ground is lit by it and by its image at (−2, 0, 3):
/// by I cos θ / d² with θ and d of either.
#[test]
fn a_plane_mirror_lights_as_the_mirrored_light() {
    let mirror = "<object type='plane' material='mirror'><scale value='30'/>
        <rotate angle='90' y='1'/></object>
        <material name='mirror'><diffuse value='0'/><specular value='0'/>
        <reflection r='.8' g='.5' b='.2'/></material>";
    let scene = |camera: &str, light: &str| {
        xml_seen_by(
            camera,
            &format!("{WHITE}{mirror}<light type='point'><position x='2' z='3'/>{light}</light>"),
        )
    };
    let ground = around([1.0, 0.5]);
    let by = |x: f64| mean(&ground, |at| cosine_over_square(at, [x, 0.0, 3.0]));
    let square = WorldSettings {
        falloff: FalloffRule::Square,
        ..PHOTONS
    };
    let cases = [
        (
            "",
            "<intensity value='8'/><attenuation value='1'/>",
            PHOTONS,
            8.0,
        ),
        (
            "",
            "<intensity value='8'/><attenuation value='2'/>",
            PHOTONS,
            2.0,
        ),
        ("", "<intensity value='8'/>", square, 8.0),
        (
            " gamma='sRGB'",
            "<intensity value='8'/><attenuation value='1'/>",
            PHOTONS,
            8.0 / PI,
        ),
    ];
    for (gamma, light, rules, intensity) in cases {
        let world = world_by(&scene(&format!("<camera{gamma}/>"), light), rules);
        let traced = Traced {
            depth: 1,
            count: 1 << 14,
            maps: 8,
        };
        let seen = traced.mean(&world, &ground, 0);
        let tint = Rgb::new(0.8, 0.5, 0.2);
        let expected = intensity * (by(2.0) + tint * by(-2.0));
        let error = (seen - expected).abs().max_element();
        assert!(
            error < 0.02 * expected.x,
            "{light}: {seen} is not {expected}"
        );
        // Without a bounce there is no mirror.
        let direct = Traced { depth: 0, ..traced }.mean(&world, &ground, 0);
        assert_near(direct.x, intensity * by(2.0), 1e-12);
    }
}

/// Flux of a light of intensity 1 that a ball of radius 1 refracts to the ground, as pairs of the
/// distance from the axis and the flux: by Snell and Schlick, with the light `light` above the
/// centre, and the ground `ground` below it.
fn refracted(light: f64, ground: f64, index: f64) -> Vec<(f64, f64)> {
    const FINE: usize = 200_000;
    let edge = (1.0 / light).asin();
    let ring = |step: usize| {
        let angle = edge * (step as f64 + 0.5) / FINE as f64;
        let incidence = (light * angle.sin()).asin();
        let within = (incidence.sin() / index).asin();
        let exit = incidence - angle + PI - 2.0 * within;
        let leaves = angle - 2.0 * (incidence - within);
        let aside = exit.sin() + leaves.tan() * (ground + exit.cos());
        let reflected = 0.04 + 0.96 * (1.0 - incidence.cos()).powi(5);
        let flux = 2.0 * PI * angle.sin() * (edge / FINE as f64) * (1.0 - reflected).powi(2);
        (aside.abs(), flux)
    };
    (0..FINE).map(ring).collect()
}

/// Below a glass ball the ground gets what crosses both its surfaces: all of it within the ball's
/// shadow, and as much within smaller circles as rays traced on paper bring there.
#[test]
fn a_glass_ball_focuses_as_ray_optics_says() {
    let glass = format!(
        "{WHITE}<object type='sphere' material='glass'><translate z='1.2'/></object>
         <material name='glass'><diffuse value='0'/><specular value='0'/>
         <refraction value='1' index='1.5'/></material>
         <light type='point'><intensity value='1'/><position z='6.2'/><attenuation value='1'/></light>"
    );
    let world = world_by(&xml(&glass), PHOTONS);
    let rings = refracted(5.0, 1.2, 1.5);
    // The ball's shadow ends at 1.26.
    for radius in [0.1, 0.3, 0.9] {
        let within = rings.iter().filter(|(aside, _)| *aside < radius);
        let flux: f64 = within.map(|(_, flux)| flux).sum();
        let expected = flux / (PI * radius * radius);
        let rays: Vec<_> = (0..1024)
            .map(|index| {
                let mut numbers = Numbers::new(index);
                let aside = radius * numbers.between(0.0, 1.0).sqrt();
                let (y, x) = numbers.between(0.0, 2.0 * PI).sin_cos();
                ray([aside * x, aside * y, 0.1], [aside * x, aside * y, 0.0])
            })
            .collect();
        // Deeper, light comes by reflection within the ball too.
        let traced = Traced {
            depth: 2,
            count: 1 << 14,
            maps: 8,
        };
        let seen = traced.mean(&world, &rays, 0).x;
        assert!(
            (seen - expected).abs() < 0.02 * expected,
            "{radius}: {seen} is not {expected}"
        );
    }
}

/// The mean light of the ground by photons and by paths, over seeds, within three standard errors.
fn assert_alike(scene: &Scene, rules: WorldSettings, depth: u32, case: &str) {
    assert_alike_along(&onto_ground(6.0, 256), scene, rules, depth, case);
}

/// The same along some rays.
pub(super) fn assert_alike_along(
    rays: &[Ray],
    scene: &Scene,
    rules: WorldSettings,
    depth: u32,
    case: &str,
) {
    const SEEDS: u32 = 64;
    let world = world_by(scene, rules);
    let deviation = |values: &[f64]| {
        let mean = values.iter().sum::<f64>() / f64::from(SEEDS);
        let square = values.iter().map(|each| (each - mean).powi(2)).sum::<f64>();
        (
            mean,
            (square / f64::from(SEEDS - 1) / f64::from(SEEDS)).sqrt(),
        )
    };
    let photons = Traced {
        depth,
        count: 1 << 12,
        maps: 2,
    };
    let by = |mean: &dyn Fn(u32) -> Rgb| {
        let means: Vec<_> = (0..SEEDS).map(|seed| mean(seed).x).collect();
        deviation(&means)
    };
    let (first, error) = by(&|seed| photons.mean(&world, rays, seed));
    let (second, other) = by(&|seed| mean_of(&world, depth, None, rays, (16, seed)));
    let sum = (error * error + other * other).sqrt();
    assert!(
        (first - second).abs() <= 3.0 * sum,
        "{case}: {first} ± {error} is not {second} ± {other}"
    );
    assert!(
        sum < 0.01 * second,
        "{case}: {sum} is too much noise to tell"
    );
}

/// Glass, mirrors and their spreads between a light with a size and the ground: the whole ground
/// gets as much light by photons as by BSDF samples that hit the light.
#[test]
fn photons_bring_what_paths_find_of_lights_with_a_size() {
    let cases = [
        ("glass", "<refraction value='1' index='1.5'/>"),
        (
            "absorbing glass",
            "<refraction value='1' index='1.5'/><absorption value='.7'/>",
        ),
        ("a mirror", "<reflection value='.9'/>"),
        (
            "both",
            "<reflection value='.4'/><refraction value='.5' index='1.3'/>",
        ),
        (
            "a spread mirror",
            "<reflection value='.9' glossiness='.3'/>",
        ),
        (
            "spread glass",
            "<refraction value='.9' index='1.5' glossiness='.2'/>",
        ),
    ];
    for (case, material) in cases {
        let scene = xml(&format!(
            "{WHITE}<object type='sphere' material='m'><translate x='.3' z='1.5'/></object>
             <material name='m'><diffuse value='0'/><specular value='0'/>{material}</material>
             <light type='point'><intensity value='8'/><position x='-1' z='5'/><size value='1'/>
             <attenuation value='1'/></light>"
        ));
        assert_alike(&scene, PHOTONS, 5, case);
    }
}

/// With `gloss exponent` photons are spread about the same half vectors as paths.
#[test]
fn photons_spread_by_exponents_as_paths_do() {
    let rules = WorldSettings {
        gloss: GlossRule::Exponent,
        ..PHOTONS
    };
    for (case, material) in [
        ("mirror", "<reflection value='.9'/>"),
        ("glass", "<refraction value='.9' index='1.5'/>"),
    ] {
        let scene = xml(&format!(
            "{WHITE}<object type='sphere' material='m'><translate x='.3' z='1.5'/></object>
             <material name='m'><diffuse value='0'/><specular value='0'/><glossiness value='60'/>
             {material}</material>
             <light type='point'><intensity value='8'/><position x='-1' z='5'/><size value='1'/>
             <attenuation value='1'/></light>"
        ));
        assert_alike(&scene, rules, 5, case);
    }
}

/// A coarse mesh whose normals are those of a sphere turns photons as it turns paths: by the normals
/// of its vertices, with the flux of its faces.
#[test]
fn photons_follow_shading_normals_as_paths_do() {
    for (case, material) in [
        ("mirror", "<reflection value='.9'/>"),
        ("glass", "<refraction value='.9' index='1.5'/>"),
    ] {
        let mut scene = xml(&format!(
            "{WHITE}<object type='sphere' material='m'/>
             <material name='m'><diffuse value='0'/><specular value='0'/>{material}</material>
             <light type='point'><intensity value='8'/><position x='-1' z='5'/><size value='1'/>
             <attenuation value='1'/></light>"
        ));
        let material = scene.objects[1].material;
        scene.objects = [
            scene.objects[0].clone(),
            Object {
                shape: meshes::smooth_ball(6, DVec3::new(0.3, 0.0, 1.5)),
                material,
            },
        ]
        .into_iter()
        .collect();
        assert_alike(&scene, PHOTONS, 5, case);
    }
}

/// Rice and BU: a clear ball of index 1 passes all light on a straight way, so that photons bring
/// behind it what a light reaches without it; and a mirror that of the mirrored light.
#[test]
fn lights_of_rice_and_bu_reach_the_ground_by_photons() {
    let white = Coefficients {
        diffuse: Rgb::splat(0.5),
        ..BLACK
    };
    let clear = Coefficients {
        transmission: 1.0,
        ..BLACK
    };
    let ground = cuboid([-20.0, -20.0, -1.0], [40.0, 40.0, 1.0]);
    let ball = (sphere([0.0, 0.0, 2.0], 1.0), clear);
    let square = WorldSettings {
        falloff: FalloffRule::Square,
        ..PHOTONS
    };
    let faded = |spot| {
        let mut light = white_light([0.0, 0.0, 6.0]);
        if let Emitter::Point { falloff, .. } = &mut light.emitter {
            falloff.radial = [0.0, 0.0, 2.0];
            falloff.spot = spot;
        }
        light
    };
    let rays = around([0.2, 0.3]);
    let lamp = [0.0, 0.0, 6.0];
    let cosine = |at: DVec3| 6.0 / (at - DVec3::from(lamp)).length();
    let spot = Some((DVec3::NEG_Z, 8.0));
    for (light, rules, share, exponent) in [
        (white_light(lamp), square, 1.0, 0),
        (faded(None), PHOTONS, 0.5, 0),
        (faded(spot), PHOTONS, 0.5, 8),
    ] {
        let scene = scene(&[(ground.clone(), white), ball.clone()], &[light]);
        let world = world_by(&scene, rules);
        let traced = |depth| {
            Traced {
                depth,
                count: 1 << 14,
                maps: 8,
            }
            .mean(&world, &rays, 0)
            .x
        };
        let expected = mean(&rays, |at| {
            0.5 * share * cosine(at).powi(exponent) * cosine_over_square(at, lamp)
        });
        // Only where the ball may be crossed twice: it blocks direct light.
        assert_near(traced(0), 0.0, 0.0);
        assert_near(traced(1), 0.0, 0.0);
        let seen = traced(2);
        assert_near(seen, expected, 0.02 * expected);
    }
    // A light that does not fade shines through it as by path.
    let scene = scene(&[(ground, white), ball], &[white_light(lamp)]);
    let world = world_by(&scene, PHOTONS);
    let seen = Traced {
        depth: 2,
        count: 1 << 10,
        maps: 1,
    }
    .mean(&world, &rays, 0)
    .x;
    assert_near(seen, mean(&rays, |at| 0.5 * cosine(at)), 1e-12);
}

/// A highlight of Phong's model, which is no BRDF, is that of the light's place: a mirror beside the
/// ground adds kd cos θ + ks (R·V)^n of the mirrored light.
#[test]
fn highlights_show_the_mirrored_light() {
    let shiny = Coefficients {
        diffuse: Rgb::splat(0.2),
        specular: Rgb::splat(0.7),
        exponent: 5.0,
        ..BLACK
    };
    let mirror = Coefficients {
        reflection: 1.0,
        ..BLACK
    };
    let objects = [
        (cuboid([-20.0, -20.0, -1.0], [40.0, 40.0, 1.0]), shiny),
        (cuboid([-1.0, -20.0, 0.0], [1.0, 40.0, 40.0]), mirror),
    ];
    let mut light = white_light([2.0, 0.0, 3.0]);
    if let Emitter::Point { falloff, .. } = &mut light.emitter {
        falloff.radial = [0.0, 0.0, 1.0];
    }
    let world = world_by(&scene(&objects, &[light]), PHOTONS);
    let rays = around([1.0, 0.0]);
    let view = -rays[0].direction;
    let lit = |from: [f64; 3]| {
        mean(&rays, |at| {
            let offset = DVec3::from(from) - at;
            let toward = offset.normalize();
            let mirrored = DVec3::new(-toward.x, -toward.y, toward.z);
            let highlight = mirrored.dot(view).max(0.0).powi(5);
            (0.2 * toward.z + 0.7 * highlight) / offset.length_squared()
        })
    };
    let expected = lit([2.0, 0.0, 3.0]) + lit([-2.0, 0.0, 3.0]);
    let seen = Traced {
        depth: 1,
        count: 1 << 14,
        maps: 8,
    }
    .mean(&world, &rays, 0)
    .x;
    assert_near(seen, expected, 0.02 * expected);
}

/// A light with a size is met one bounce later than its photons arrive, and counts no deeper.
#[test]
fn photons_count_up_to_the_depth_of_paths() {
    let scene = |size: &str| {
        xml(&format!(
            "{WHITE}<object type='sphere' material='glass'><translate z='1.2'/></object>
             <material name='glass'><diffuse value='0'/><specular value='0'/>
             <refraction value='1' index='1.5'/></material>
             <light type='point'><intensity value='1'/><position z='6.2'/>{size}
             <attenuation value='1'/></light>"
        ))
    };
    let below = ray([0.0, 0.01, 0.1], [0.0; 3]);
    for (size, enough) in [("", 2), ("<size value='.2'/>", 3)] {
        let world = world_by(&scene(size), PHOTONS);
        let lit = |depth| {
            Traced {
                depth,
                count: 1 << 12,
                maps: 2,
            }
            .mean(&world, &[below], 0)
            .x
        };
        let [before, after, deeper] = [enough - 1, enough, enough + 1].map(lit);
        // Some light comes over the ground and the outside of the ball.
        assert!(before < 0.05 * after, "{size}: {before}, {after}");
        assert!(0.1 < after && after <= deeper, "{size}: {after}, {deeper}");
    }
}
