//! Path tracing against closed forms and independent numerical integration.

use std::f64::consts::{PI, TAU};

use super::highlights::GROUND;
use super::*;
use crate::material::{Lobes, Point};
use crate::sampling::Purpose;
use scene::Emitter;

/// The means of a ray's radiance over `samples`, one for each of `seeds` seeds.
fn means(scene: Scene, depth: u32, ray: Ray, samples: u32, seeds: u32) -> Vec<Rgb> {
    let world = world(scene);
    let mut tracer = Tracer::new(&world, Integrator::Path, depth, &|| false);
    let mut mean = |seed| {
        let each = (0..samples).map(|index| {
            let sample = Sample {
                sampler: Sampler::new(0, 0, index, seed),
                ..centred(ray, f64::INFINITY)
            };
            tracer.radiance(&sample).radiance
        });
        each.sum::<Rgb>() / f64::from(samples)
    };
    (0..seeds).map(&mut mean).collect()
}

pub(super) fn mean(scene: Scene, depth: u32, ray: Ray, samples: u32) -> f64 {
    means(scene, depth, ray, samples, 1)[0].x
}

/// Asserts that the mean over 64 seeds is within three standard errors of the expected value.
pub(super) fn assert_unbiased(scene: &Scene, depth: u32, ray: Ray, expected: f64, case: &str) {
    let means = means(scene.clone(), depth, ray, 64, 64);
    let mean = means.iter().map(|mean| mean.x).sum::<f64>() / 64.0;
    let square = means
        .iter()
        .map(|each| (each.x - mean).powi(2))
        .sum::<f64>();
    let error = (square / 63.0 / 64.0).sqrt();
    assert!(
        (mean - expected).abs() <= 3.0 * error + 1e-9,
        "{case}: {mean} ± {error} is not {expected}"
    );
    // Too much noise would let any value pass.
    assert!(error < 0.01 * expected, "{case}: {error}");
}

#[test]
fn occluded_light_adds_nothing_even_if_infinite() {
    let scene = |objects: &str| {
        let mut scene = xml(&format!(
            "{objects}<object type='plane' material='m'><scale value='9'/></object>
             <material name='m'><diffuse value='1'/></material>
             <light type='point' name='l'><intensity value='1'/><position z='9'/></light>"
        ));
        scene.lights[0].colour = Rgb::splat(f64::INFINITY);
        scene
    };
    let ray = Ray {
        origin: DVec3::new(0.0, -3.0, 1.0),
        direction: DVec3::new(0.0, 3.0, -1.0).normalize(),
    };
    let ball = "<object type='sphere' material='m'><translate z='3'/></object>";
    assert_eq!(mean(scene(""), 0, ray, 4), f64::INFINITY);
    assert_eq!(mean(scene(ball), 0, ray, 4), 0.0);
}

/// SPEC §9: e (1 − ρ^(D+1)) / (1 − ρ).
#[test]
fn white_furnace() {
    for (albedo, emission) in [(0.5, 1.0), (0.8, 0.25), (0.2, 3.0)] {
        let scene = xml(&format!(
            "<object type='sphere' material='m'/><material name='m'><diffuse value='{albedo}'/>
             <specular value='0'/><emission value='{emission}'/></material>"
        ));
        for depth in [0, 1, 2, 5, 16, 64] {
            let bounces = f64::from(depth + 1);
            let expected = emission * (1.0 - f64::powf(albedo, bounces)) / (1.0 - albedo);
            let inside = ray([0.1, 0.2, 0.3], [0.4, -0.5, 0.6]);
            let seen = mean(scene.clone(), depth, inside, 4096);
            assert_near(seen, expected, 1e-3 * expected);
        }
    }
}

/// The same for Phong's model without emission: a light at the centre of a ball lights all of it at
/// normal incidence by kd, and the reflected light is equal.
#[test]
fn furnace_around_a_light() {
    for (diffuse, reflection, transmission) in [(0.5, 0.0, 0.0), (0.3, 0.4, 0.0), (0.3, 0.1, 0.3)] {
        let material = Coefficients {
            ambient: Rgb::ONE,
            diffuse: Rgb::splat(diffuse),
            reflection,
            transmission,
            ..BLACK
        };
        let scene = scene(
            &[(sphere([0.0; 3], 1.0), material)],
            &[white_light([0.0; 3])],
        );
        // Transmitted light is lost.
        let kept = diffuse + reflection;
        for depth in [0, 1, 3, 64] {
            let expected = diffuse * (1.0 - f64::powf(kept, f64::from(depth + 1))) / (1.0 - kept);
            let inside = ray([0.1, 0.2, 0.3], [0.4, -0.5, 0.6]);
            let seen = mean(scene.clone(), depth, inside, 4096);
            assert_near(seen, expected, 2e-3 * expected);
        }
    }
}

/// The radiance that a point of the ground sends toward `view` when lit by `radiance` from all
/// directions, integrated over a fine grid: ∫ BRDF cos L dω.
fn gathered(brdf: impl Fn(DVec3) -> f64, radiance: impl Fn(DVec3) -> f64) -> f64 {
    const FINE: usize = 700;
    let middle = |i: usize| (i as f64 + 0.5) / FINE as f64;
    let mut sum = 0.0;
    for i in 0..FINE {
        // Uniform in cos², and thus in cos θ dω.
        let cosine = middle(i).sqrt();
        let sine = (1.0 - cosine * cosine).sqrt();
        for j in 0..FINE {
            let (y, x) = (TAU * middle(j)).sin_cos();
            let direction = DVec3::new(sine * x, sine * y, cosine);
            sum += brdf(direction) * radiance(direction);
        }
    }
    PI * sum / (FINE * FINE) as f64
}

/// BRDFs as written in SPEC §6: normal +z, the eye at 45°.
fn brdf(kind: &str, toward: DVec3) -> f64 {
    let view = DVec3::new(0.5f64.sqrt(), 0.0, 0.5f64.sqrt());
    let halfway = (toward + view).normalize();
    let mirrored = DVec3::new(-view.x, -view.y, view.z);
    match kind {
        "blinn" => 0.25 / PI + 0.5 * 12.0 / (8.0 * PI) * halfway.z.powi(10),
        "phong" => 0.25 / PI + 0.5 * 11.0 / TAU * mirrored.dot(toward).max(0.0).powi(10),
        // Roughness ½: α = ¼; half metallic with colour ½, index 1.5: F0 = .27, kd = .25.
        _ => {
            let square = 0.0625;
            let spread = square / (PI * (halfway.z * halfway.z * (square - 1.0) + 1.0).powi(2));
            // Smith's G₂, height-correlated, over 4 N·L N·V.
            let root = |z: f64| (z * z * (1.0 - square) + square).sqrt();
            let shadowed = 0.5 / (toward.z * root(view.z) + view.z * root(toward.z));
            let fresnel = 0.27 + 0.73 * (1.0 - view.dot(halfway)).powi(5);
            0.25 / PI + spread * shadowed * fresnel
        }
    }
}

fn material(kind: &str) -> &'static str {
    match kind {
        "blinn" => {
            "<material type='blinn' name='m'><diffuse value='.25'/><specular value='.5'/>
             <glossiness value='10'/></material>"
        }
        "phong" => {
            "<material type='phong' name='m'><diffuse value='.25'/><specular value='.5'/>
             <glossiness value='10'/></material>"
        }
        _ => {
            "<material type='microfacet' name='m'><color value='.5'/><roughness value='.5'/>
             <metallic value='.5'/><ior value='1.5'/></material>"
        }
    }
}

/// A glowing ball of radius 2 at (−1, 2, 4), a uniform environment of ½, and a light with a size:
/// each is hit by different rays.
#[test]
fn every_brdf_matches_numerical_integration() {
    let from = ray([1.0, 0.0, 1.0], [0.0; 3]);
    let meets = |centre: DVec3, radius: f64, direction: DVec3| {
        let along = centre.dot(direction);
        0.0 < along && centre.length_squared() - along * along < radius * radius
    };
    let glow = DVec3::new(-1.0, 2.0, 4.0);
    let lamp = DVec3::new(2.0, -2.0, 3.0);
    for kind in ["blinn", "phong", "microfacet"] {
        let material = material(kind);
        let cases = [
            (
                "a glowing ball before an even environment",
                "<object type='sphere' material='glow'><scale value='2'/>
                 <translate x='-1' y='2' z='4'/></object><environment value='.5'/>
                 <material name='glow'><diffuse value='0'/><specular value='0'/>
                 <emission value='3'/></material>",
                gathered(
                    |direction| brdf(kind, direction),
                    |direction| {
                        if meets(glow, 2.0, direction) {
                            3.0
                        } else {
                            0.5
                        }
                    },
                ),
            ),
            (
                "a ball of light half behind a plane",
                "<light type='point'><intensity value='4'/><position x='2' y='-2' z='3'/>
                 <size value='1'/><attenuation value='1'/></light>
                 <object type='plane' material='black'><scale value='50'/>
                 <translate x='51' z='1.5'/></object>
                 <material name='black'><diffuse value='0'/><specular value='0'/></material>",
                gathered(
                    |direction| brdf(kind, direction),
                    |direction| {
                        let hidden = 1.0 < direction.x / direction.z * 1.5;
                        if meets(lamp, 1.0, direction) && !hidden {
                            4.0
                        } else {
                            0.0
                        }
                    },
                ),
            ),
        ];
        for (case, others, expected) in cases {
            let scene = xml(&format!("{GROUND}{material}{others}"));
            assert_unbiased(&scene, 1, from, expected, &format!("{kind}, {case}"));
        }
    }
}

/// A matte floor and a matte ball lit by a lamp: direct light on the floor, plus that reflected by
/// the ball, integrated over the directions that hit it.
#[test]
fn light_is_reflected_between_surfaces() {
    let lamp = DVec3::new(4.0, 0.0, 1.0);
    let ball = DVec3::new(0.0, 0.0, 2.0);
    let at = DVec3::new(1.2, 0.0, 0.0);
    let scene = xml(&format!(
        "{GROUND}<material name='m'><diffuse value='.8'/><specular value='0'/></material>
         <object type='sphere' material='ball'><translate z='2'/></object>
         <material name='ball'><diffuse value='1'/><specular value='0'/></material>
         <light type='point'><intensity value='10'/><position x='4' z='1'/></light>"
    ));
    let sent = |direction: DVec3| {
        let way = ball - at;
        let along = way.dot(direction);
        let square = 1.0 - (way.length_squared() - along * along);
        if square < 0.0 || along < 0.0 {
            return 0.0;
        }
        let point = at + (along - square.sqrt()) * direction;
        let normal = point - ball;
        // A convex body does not occlude its own lit side.
        10.0 * normal.dot((lamp - point).normalize()).max(0.0)
    };
    let indirect = gathered(|_| 0.8 / PI, sent);
    let direct = 0.8 * 10.0 * (lamp - at).normalize().z;
    let from = ray([1.2, 0.0, 0.3], at.to_array());
    assert_unbiased(&scene, 0, from, direct, "straight");
    assert_unbiased(&scene, 1, from, direct + indirect, "one bounce");
    assert!(0.02 * direct < indirect, "{indirect} tells nothing");
}

/// Where every bounce is specular or goes straight to a light, both integrators agree except for
/// ambient light; a matte surface must not see itself again.
#[test]
fn paths_match_whitted_rays_without_scattering() {
    let glassy = |glass: &str| {
        xml(&format!(
            "<object type='sphere' material='glass'/>
             <object type='plane' material='matt'><scale value='40'/><translate z='-3'/></object>
             <material name='matt'><diffuse r='.8' g='.4' b='.2'/><specular value='0'/></material>
             <material name='glass'><diffuse value='0'/><specular value='0'/>{glass}</material>
             <environment r='.1' g='.2' b='.3'/>
             <light type='direct'><intensity value='.5'/><direction x='1' z='-1'/></light>
             <light type='point'><intensity value='9'/><position x='3' y='2' z='6'/>
             <attenuation value='.5'/></light>"
        ))
    };
    let mirror = Coefficients {
        reflection: 0.8,
        transmission: 0.3,
        index: 1.3,
        ..BLACK
    };
    let shiny = Coefficients {
        ambient: Rgb::ZERO,
        specular: Rgb::new(0.5, 0.6, 0.7),
        exponent: 12.0,
        ..BLACK
    };
    let mut lamp = Light::point(DVec3::new(2.0, 3.0, 6.0), Rgb::new(1.0, 0.9, 0.8));
    lamp.emitter = Emitter::Point {
        position: DVec3::new(2.0, 3.0, 6.0),
        radius: 0.0,
        falloff: scene::Falloff {
            radial: [1.0, 0.1, 0.01],
            spot: None,
        },
    };
    let phong = scene(
        &[
            (sphere([0.0; 3], 1.0), mirror),
            (cuboid([-9.0, -9.0, -4.0], [18.0, 18.0, 1.0]), shiny),
        ],
        &[white_light([-4.0, 4.0, 4.0]), lamp],
    );
    let from = [0.3, 0.2, 5.0];
    let [middle, rim, beside] = [[0.3, 0.2, 0.0], [0.95, 0.0, 0.0], [2.5, 0.0, -3.0]];
    let mirrors = glassy("<reflection r='.9' g='.8' b='.7'/>");
    let absorbs = "<refraction value='.9' index='1.5'/><absorption r='.2' g='.5' b='0'/>";
    // With more bounces than a path needs, the matte floor would receive indirect light.
    for (case, scene, depth, ways) in [
        ("beside", mirrors.clone(), 0, vec![beside]),
        ("mirror", mirrors, 1, vec![middle, rim]),
        (
            "clear glass",
            glassy("<refraction value='.9' index='1'/>"),
            2,
            vec![middle, rim],
        ),
        ("absorbing glass", glassy(absorbs), 2, vec![middle]),
        ("constant reflectance", phong, 6, vec![middle, rim, beside]),
    ] {
        for toward in ways {
            let way = ray(from, toward);
            let whitted = look(scene.clone(), depth, way).0.radiance;
            let means = means(scene.clone(), depth, way, 1024, 64);
            let mean = means.iter().sum::<Rgb>() / 64.0;
            let square = means
                .iter()
                .map(|each| (each - mean) * (each - mean))
                .sum::<Rgb>();
            let error = (square / (63.0 * 64.0)).map(f64::sqrt);
            let off = (mean - whitted).abs() - 3.0 * error;
            assert!(
                off.max_element() < 1e-9,
                "{case} toward {toward:?}: {mean} ± {error} is not {whitted}"
            );
        }
    }
}

fn point_seen_from(view: DVec3) -> Point {
    let scene = xml("<object type='plane' material='m'/><material name='m'/>");
    let world = world(scene);
    let seen = Ray {
        origin: view,
        direction: -view,
    };
    let nearest = world
        .nearest(&seen, f64::INFINITY)
        .expect("the plane is met");
    world.shading_point(&seen, nearest, &mut None).0
}

/// The lobes of a material at a point.
fn lobes_of(material: &str, point: &Point) -> Lobes {
    let scene = xml(&format!("<object type='plane' material='m'/>{material}"));
    let world = world(scene);
    let down = ray([0.0, 0.0, 1.0], [0.0; 3]);
    let nearest = world
        .nearest(&down, f64::INFINITY)
        .expect("the plane is met");
    Lobes::of(point, world.shading_point(&down, nearest, &mut None).1).0
}

/// Points with normal +z, except one whose interpolated normal leans away from the eye.
fn points() -> Vec<Point> {
    let seen_at = |tilt: f64| point_seen_from(DVec3::new(tilt.sin(), 0.0, tilt.cos()));
    let mut points: Vec<_> = [0.0, 0.7, 1.3].map(seen_at).to_vec();
    let mut leaning = seen_at(1.3);
    leaning.view = DVec3::new(0.99, 0.0, -0.141_067_4).normalize();
    points.push(leaning);
    points
}

/// The mean reflectance of a point over many samples of its lobes, and the fraction of samples
/// above the surface.
fn sampled(lobes: &Lobes, point: &Point, count: u32) -> (f64, f64) {
    let (mut sent, mut above) = (0.0, 0.0);
    for index in 0..count {
        let sampler = Sampler::new(1, 2, index, 3);
        let [u, v, lobe, _] = sampler.four(0, Purpose::Bounce);
        let direction = lobes.choose(point, lobe, [u, v]);
        let scattered = lobes.scatter(point, direction);
        if 0.0 < scattered.density {
            sent += scattered.value.x / scattered.density;
            above += 1.0;
        }
    }
    (sent / f64::from(count), above / f64::from(count))
}

/// Samples match their density: the mean of value over density is the integral of the value, and
/// the fraction above the surface is the integral of the density there.
#[test]
fn directions_match_their_density() {
    let mirrors = "<material type='microfacet' name='m'><color value='1'/>
        <roughness value='.6'/><metallic value='1'/></material>";
    for kind in [material("blinn"), material("phong"), material(""), mirrors] {
        for point in points() {
            let lobes = lobes_of(kind, &point);
            // The grid is uniform in cos θ dω.
            let integral = gathered(
                |direction| lobes.scatter(&point, direction).value.x / direction.z,
                |_| 1.0,
            );
            let chances = gathered(
                |direction| lobes.scatter(&point, direction).density / direction.z,
                |_| 1.0,
            );
            let (sent, above) = sampled(&lobes, &point, 1 << 14);
            assert_near(sent, integral, 0.01 * integral + 1e-12);
            assert_near(above, chances, 0.01);
        }
    }
}

/// Perfectly reflecting microfacets lose only interreflections; nearly smooth ones lose nothing.
#[test]
fn microfacets_reflect_no_more_than_they_receive() {
    for (roughness, least) in [(0.1, 0.99), (0.5, 0.85), (1.0, 0.3)] {
        let kind = format!(
            "<material type='microfacet' name='m'><color value='1'/>
             <roughness value='{roughness}'/><metallic value='1'/></material>"
        );
        for tilt in [0.0, 0.8, 1.4] {
            let point = point_seen_from(DVec3::new(f64::sin(tilt), 0.0, f64::cos(tilt)));
            let (sent, _) = sampled(&lobes_of(&kind, &point), &point, 1 << 12);
            assert!(
                (least..1.0 + 1e-3).contains(&sent),
                "{roughness} {tilt}: {sent}"
            );
        }
    }
}

/// Absorption applies on the way to a light: in a ball that absorbs half per unit, to a light of
/// radius ½ at its centre, 1½ from its surface.
#[test]
fn light_is_absorbed_on_the_way_from_lights() {
    let absorption = 2.0f64.ln();
    let scene = xml(&format!(
        "<object type='sphere' material='m'><scale value='2'/></object>
         <material name='m'><diffuse value='0'/><specular value='0'/>
         <refraction value='1' index='1'/><absorption value='{absorption}'/></material>
         <light type='point'><intensity value='1'/><size value='.5'/><attenuation value='1'/></light>"
    ));
    let seen = mean(scene, 4, ray([5.0, 0.0, 0.0], [0.0; 3]), 16);
    assert_near(seen, 4.0 * 0.5f64.powf(1.5), 1e-12);
}

/// Extreme numbers still give finite pixels.
#[test]
fn extreme_numbers_give_finite_radiance() {
    for material in [
        "<material type='microfacet' name='m'><roughness value='1e100'/></material>",
        "<material type='microfacet' name='m'><roughness value='0'/><metallic value='1'/></material>",
        "<material name='m'><glossiness value='1e300'/></material>",
        "<material name='m'><diffuse value='1e200'/></material>",
        "<material name='m'><refraction value='1' index='1e300' glossiness='1e300'/></material>",
        "<material name='m'><absorption value='1e300'/><refraction value='1' index='1e-300'/></material>",
    ] {
        let scene = xml(&format!(
            "{material}<object type='sphere' material='m'><scale value='2'/></object>
             <light type='point'><intensity value='1'/><position z='1'/><size value='.1'/><attenuation value='1'/></light>
             <light type='direct'><intensity value='1'/></light><environment value='1'/>"
        ));
        for origin in [[0.1, 0.2, 0.3], [0.0, 0.0, 5.0]] {
            let seen = mean(scene.clone(), 64, ray(origin, [0.2, 0.1, 0.0]), 256);
            assert!(!seen.is_nan(), "{material}");
        }
    }
}

/// Path traced pictures have the same bits for any number of threads.
#[test]
fn paths_do_not_depend_on_the_number_of_threads() {
    let scene = Arc::new(xml_seen_by(
        "<camera gamma='sRGB'><position y='-6' z='3'/><target z='1'/><up z='1'/><dof value='.1'/>
         <focaldist value='6'/></camera>",
        &format!(
            "{GROUND}{}<object type='sphere' material='g'><translate z='1'/></object>
             <material name='g'><reflection value='.5' glossiness='.2'/>
             <refraction value='.4' index='1.5' glossiness='.1'/></material>
             <light type='point'><intensity value='20'/><position x='2' z='4'/><size value='1'/><attenuation value='1'/></light>
             <environment value='.2'/>",
            material("microfacet")
        ),
    ));
    let traced = |threads| {
        let (mut renderer, woken) = renderer(threads);
        let settings = Settings {
            integrator: Integrator::Path,
            ..settings(33, 17, 8)
        };
        let generation = restart(&mut renderer, job(&scene, settings));
        finish(&renderer, &woken, generation).pixels.clone()
    };
    let alone = traced(1);
    assert!(alone.iter().any(|pixel| pixel != &alone[0]));
    assert_eq!(traced(2), alone);
    assert_eq!(traced(5), alone);
}
