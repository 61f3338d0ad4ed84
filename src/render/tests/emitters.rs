//! Sampled emission against closed forms, and against paths that only hit it by
//! chance.

use std::f64::consts::PI;

use super::highlights::GROUND;
use super::*;
use crate::light::{Emitters, Sky};
use geometry::{Attribute, Instance, Mesh, MeshParts};
use scene::{Faces, Highlight, Image};

/// The means of a ray's radiance over `samples`, one for each of 64 seeds.
pub(super) fn means(world: &World, depth: u32, ray: Ray, samples: u32) -> Vec<f64> {
    let mut tracer = Tracer::new(world, Integrator::Path, depth, &|| false);
    let mut mean = |seed| {
        let each = (0..samples).map(|index| {
            let sample = Sample {
                sampler: Sampler::new(0, 0, index, seed),
                ..centred(ray, f64::INFINITY)
            };
            tracer.radiance(&sample).radiance.element_sum() / 3.0
        });
        each.sum::<f64>() / f64::from(samples)
    };
    (0..64).map(&mut mean).collect()
}

/// Their mean and its standard error.
pub(super) fn estimate(means: &[f64]) -> [f64; 2] {
    let count = means.len() as f64;
    let mean = means.iter().sum::<f64>() / count;
    let square: f64 = means.iter().map(|each| (each - mean).powi(2)).sum();
    [mean, (square / (count - 1.0) / count).sqrt()]
}

fn assert_is(world: &World, depth: u32, ray: Ray, expected: f64, case: &str) {
    let [mean, error] = estimate(&means(world, depth, ray, 64));
    assert!(
        (mean - expected).abs() <= 3.0 * error + 1e-9,
        "{case}: {mean} ± {error} is not {expected}"
    );
    assert!(error < 0.01 * expected, "{case}: {error}");
}

/// The same world without emitters to sample: all are hit by chance.
fn by_chance(world: &World) -> World {
    World {
        emitters: Arc::new(Emitters::default()),
        ..world.clone()
    }
}

/// Asserts that sampling emitters leaves the mean as it is, and that the error falls below `share`
/// of what it was.
fn assert_same_mean(world: &World, depth: u32, ray: Ray, share: f64, case: &str) {
    assert!(!world.emitters.is_empty(), "{case}");
    let [asked, error] = estimate(&means(world, depth, ray, 32));
    let [met, spread] = estimate(&means(&by_chance(world), depth, ray, 128));
    assert!(
        (asked - met).abs() <= 3.0 * error.hypot(spread),
        "{case}: {asked} ± {error}, by chance {met} ± {spread}"
    );
    assert!(0.0 < met, "{case}");
    // Errors fall with the root of the number of samples.
    let spread = 2.0 * spread;
    assert!(error <= share * spread, "{case}: {error} against {spread}");
}

const MATT: &str = "<material name='m'><diffuse value='.8'/><specular value='0'/></material>
    <material name='glow'><diffuse value='0'/><specular value='0'/><emission value='3'/></material>";

/// A glowing square of edge 2 at height 1 above a point of the floor, facing it. Its form factor:
/// four times that of a quarter, 1/2π (2 a/√(1+a²) atan(a/√(1+a²))) with a = 1.
#[test]
fn light_of_a_square_matches_its_form_factor() {
    let quarter = 2.0 * 0.5f64.sqrt() * (0.5f64.sqrt()).atan() / (2.0 * PI);
    let expected = 0.8 * 3.0 * 4.0 * quarter;
    let down = ray([0.1, 0.0, 0.3], [0.0; 3]);
    for turned in ["", "<rotate angle='180' x='1'/>"] {
        let scene = xml(&format!(
            "{GROUND}{MATT}<object type='plane' material='glow'>{turned}<translate z='1'/></object>"
        ));
        assert_is(&world(scene), 1, down, expected, turned);
    }
}

/// A glowing ball of radius r at distance h: E = π L (r/h)² above the horizon; the same for an
/// ellipsoid that is a ball, and halves that differ by material.
#[test]
fn light_of_a_ball_matches_its_solid_angle() {
    for (scale, height) in [(0.5, 4.0), (1.0, 1.5), (0.01, 3.0), (1e-6, 2.0)] {
        let scene = xml(&format!(
            "{GROUND}{MATT}<object type='sphere' material='glow'><scale value='{scale}'/>
             <translate z='{height}'/></object>"
        ));
        let down = ray([0.1, 0.0, 0.01], [0.0; 3]);
        let expected = 0.8 * 3.0 * f64::powi(scale / height, 2);
        assert_is(
            &world(scene),
            1,
            down,
            expected,
            &format!("{scale} {height}"),
        );
    }
}

/// SPEC §9 with a ball that is lit and lights itself from inside and around another: e (1 − ρ^(D+1)) /
/// (1 − ρ), whatever finds the light.
#[test]
fn white_furnace_with_a_ball_inside() {
    for albedo in [0.5, 0.8] {
        let scene = xml(&format!(
            "<object type='sphere' material='m'><scale value='4'/></object>
             <object type='sphere' material='m'><translate x='1' z='.5'/></object>
             <object type='plane' material='m'><translate x='-1' z='-1'/></object>
             <material name='m'><diffuse value='{albedo}'/><specular value='0'/>
             <emission value='.5'/></material>"
        ));
        let world = world(scene);
        for depth in [1, 2, 8] {
            let expected = 0.5 * (1.0 - f64::powf(albedo, f64::from(depth + 1))) / (1.0 - albedo);
            let [mean, error] = estimate(&means(
                &world,
                depth,
                ray([-1.0, 0.0, 2.0], [-0.4, 0.3, -1.0]),
                64,
            ));
            assert!(
                (mean - expected).abs() <= 3.0 * error + 1e-9,
                "{albedo} {depth}: {mean} ± {error} is not {expected}"
            );
            assert!(error < 0.02 * expected, "{error}");
        }
    }
}

/// A curved sheet of triangles with uv.
fn sheet(side: u32) -> Mesh {
    let mut parts = MeshParts::default();
    let mut uvs = Attribute::default();
    for row in 0..=side {
        for column in 0..=side {
            let [x, y] = [column, row].map(|at| f64::from(at) / f64::from(side));
            parts.positions.push(DVec3::new(
                2.0 * x - 1.0,
                2.0 * y - 1.0,
                0.3 * (3.0 * x).sin(),
            ));
            uvs.values.push(DVec2::new(x, y));
        }
    }
    for row in 0..side {
        for column in 0..side {
            let at = row * (side + 1) + column;
            parts.triangles.push([at, at + 1, at + side + 1]);
            parts.triangles.push([at + 1, at + side + 2, at + side + 1]);
        }
    }
    parts.uvs = uvs;
    Mesh::new(parts).expect("the sheet is a mesh")
}

/// A floor of this material below a glowing sheet, two blocks in between, a mirror beside.
fn room(floor: Material, glow: Material, textures: Vec<Texture>, flip: bool) -> Scene {
    let mut scene = xml(&format!(
        "{GROUND}{MATT}<object type='sphere' material='m'><scale value='.3'/>
         <translate x='.3' z='.6'/></object>
         <object type='plane' material='mirror'><rotate angle='90' y='1'/><scale value='3'/>
         <translate x='-2'/></object>
         <material name='mirror'><diffuse value='.1'/><specular value='0'/><reflection value='.8'/>
         </material>"
    ));
    scene
        .materials
        .edit(|materials| materials.extend([floor, glow]));
    let floor = scene.materials.len() as u32 - 2;
    let mut objects: Vec<_> = scene.objects.iter().cloned().collect();
    objects[0].material = floor;
    let z = if flip { -1.0 } else { 1.0 };
    let frame = Affine::of_matrix(
        [
            0.7 * DVec3::X,
            DVec3::new(0.1, 0.5, 0.0),
            DVec3::new(0.0, 0.2, z),
        ],
        DVec3::new(0.2, 0.1, 1.5),
    );
    let mesh = Arc::new(sheet(6));
    let instance = Instance::new(mesh, &frame.expect("it has a volume"), vec![]);
    objects.push(Object {
        shape: Shape::Mesh(Box::new(instance)),
        material: floor + 1,
    });
    scene.objects = objects.into_iter().collect();
    scene.textures = textures;
    scene
}

fn glowing(colour: Rgb, lit: Faces) -> Material {
    Material {
        emission: colour,
        diffuse: Rgb::splat(0.2),
        lit,
        ..Material::BLACK
    }
}

fn matt() -> Material {
    Material {
        diffuse: Rgb::splat(0.7),
        ..Material::BLACK
    }
}

/// Meshes in skewed and mirrored frames, lit on both sides or the front, with and without a texture:
/// the mean is that of paths that hit the light by chance.
#[test]
fn meshes_give_the_light_that_paths_find_by_chance() {
    let down = ray([-0.5, 0.2, 0.4], [-0.3, 0.0, 0.0]);
    let bright = Rgb::new(4.0, 2.0, 1.0);
    let board = checker(DVec2::splat(3.0), [Rgb::ONE, Rgb::new(0.0, 0.1, 0.0)]);
    for (case, lit, textures, flip) in [
        ("both sides", Faces::Both, vec![], false),
        ("mirrored", Faces::Both, vec![], true),
        ("front, away or toward", Faces::Front, vec![], false),
        ("front, mirrored", Faces::Front, vec![], true),
        ("textured", Faces::Both, vec![board], false),
    ] {
        let mut glow = glowing(bright, lit);
        glow.maps = Maps {
            emission: (!textures.is_empty()).then_some(0),
            ..Maps::default()
        }
        .boxed();
        let world = world(room(matt(), glow, textures, flip));
        // Light that comes by way of the mirror only is not sampled.
        let share = if lit == Faces::Both { 0.6 } else { 3.0 };
        assert_same_mean(&world, 2, down, share, case);
    }
}

/// Glossy floors: what the floor mirrors is found by the path, what it scatters by asking.
#[test]
fn glossy_surfaces_show_the_light_that_paths_find_by_chance() {
    let down = ray([-1.5, 0.2, 0.8], [-0.3, 0.0, 0.0]);
    for roughness in [0.3, 0.6] {
        let floor = Material {
            diffuse: Rgb::splat(0.3),
            highlight: Highlight::Microfacet {
                roughness,
                metallic: 0.7,
            },
            ..Material::BLACK
        };
        let glow = glowing(Rgb::splat(5.0), Faces::Both);
        let world = world(room(floor, glow, vec![], false));
        assert_same_mean(&world, 2, down, 0.9, "glossy");
    }
}

/// A light with a size, which paths see, hides an emitter, and glass in between is passed by paths
/// only.
#[test]
fn what_hides_an_emitter_hides_it_from_sampling_and_from_hits() {
    let down = ray([0.4, 0.0, 0.3], [0.0; 3]);
    for between in [
        "<light type='point'><intensity value='.01'/><position z='1'/><size value='.3'/><attenuation value='1'/></light>",
        "<object type='sphere' material='glass'><scale value='.3'/><translate z='1'/></object>
         <material name='glass'><diffuse value='0'/><specular value='0'/>
         <refraction value='.9' index='1.3'/></material>",
    ] {
        let scene = xml(&format!(
            "{GROUND}{MATT}{between}<object type='plane' material='glow'><translate z='2'/></object>"
        ));
        assert_same_mean(&world(scene), 4, down, 1.0, between);
    }
}

/// Of a surface that coincides with an emitter the first in the file is seen, and only that gives
/// light.
#[test]
fn covered_emitters_give_no_light() {
    let down = ray([0.1, 0.0, 0.3], [0.0; 3]);
    let cover = "<object type='plane' material='m'><scale value='2'/><translate z='1'/></object>";
    let glow = "<object type='plane' material='glow'><translate z='1'/></object>";
    for (objects, is_dark) in [
        (format!("{cover}{glow}"), true),
        (format!("{glow}{cover}"), false),
    ] {
        let world = world(xml(&format!("{GROUND}{MATT}{objects}")));
        let [mean, _] = estimate(&means(&world, 2, down, 16));
        assert_eq!(mean == 0.0, is_dark, "{objects}");
    }
}

/// Edits of anything but what emits light keep the emitters; others do not.
#[test]
fn emitters_are_kept_as_long_as_they_are_the_same() {
    let glow = glowing(Rgb::ONE, Faces::Both);
    let scene = room(matt(), glow, vec![], false);
    let before = world(scene.clone());
    let built = |scene: Scene| {
        let images = Images::default();
        let scene = Arc::new(scene);
        let built = World::build(scene, &images, PATHS, Some(&before), &|| false);
        built.expect("nothing cancels").emitters
    };
    let changed = |change: &dyn Fn(&mut Scene)| {
        let mut scene = scene.clone();
        change(&mut scene);
        !Arc::ptr_eq(&built(scene), &before.emitters)
    };
    assert!(!changed(&|_| {}));
    assert!(!changed(&|scene| scene.materials[0].diffuse = Rgb::ONE));
    assert!(!changed(
        &|scene| scene.objects[1].shape = sphere([0.0, 0.0, 1.0], 0.1)
    ));
    let last = scene.materials.len() - 1;
    assert!(changed(
        &|scene| scene.materials[last].emission = 2.0 * Rgb::ONE
    ));
    assert!(changed(&|scene| scene.materials[last].lit = Faces::Front));
    assert!(changed(&|scene| scene.materials[0].emission = Rgb::ONE));
    let object = scene.objects.len() - 1;
    assert!(changed(
        &|scene| scene.objects[object].shape = sphere([0.0, 0.0, 1.0], 0.1)
    ));
    assert!(World::build(Arc::new(scene), &Images::default(), PATHS, None, &|| true).is_none());
}

/// A sky of one bright pixel, in 16 × 16.
fn sunny(even: u8) -> (Scene, Images) {
    let size = Size {
        width: 16,
        height: 16,
    };
    let mut pixels = vec![[even, even, even]; 256];
    // Elevation 45°: a quarter of the way down is at row and column 6, toward +x 10.
    pixels[16 * 9 + 10] = [255, 240, 200];
    let image = Image::new(size, pixels).expect("256 pixels");
    let images = Images::from_iter([("sky.png".to_owned(), Arc::new(image))]);
    let mut scene = xml(&format!(
        "{GROUND}{MATT}<environment value='90'/>
         <object type='sphere' material='m'><scale value='.4'/><translate x='.9' z='.6'/></object>"
    ));
    scene.textures = vec![Texture {
        inverse: glam::DAffine3::IDENTITY,
        pattern: Pattern::Image("sky.png".to_owned()),
    }];
    scene.setting.environment = Tinted {
        colour: Rgb::splat(90.0),
        texture: Some(0),
    };
    (scene, images)
}

/// A sun in the sky is sampled, and gives the light that paths hit by chance; an even sky is left to
/// BSDF sampling.
#[test]
fn a_sun_in_the_sky_gives_the_light_that_paths_find_by_chance() {
    let built = |even| {
        let (scene, images) = sunny(even);
        let built = World::build(Arc::new(scene), &images, PATHS, None, &|| false);
        built.expect("nothing cancels")
    };
    assert!(built(230).sky.is_unsampled());
    let world = built(2);
    let chance = World {
        sky: Arc::new(Sky::unsampled()),
        ..world.clone()
    };
    let mut dark = 0;
    for x in [-1.0, 0.0, 0.4, 2.0] {
        let down = ray([x + 0.01, 0.0, 0.2], [x, 0.0, 0.0]);
        let [asked, error] = estimate(&means(&world, 2, down, 32));
        let [met, spread] = estimate(&means(&chance, 2, down, 256));
        assert!(
            (asked - met).abs() <= 3.0 * error.hypot(spread),
            "{x}: {asked} ± {error}, by chance {met} ± {spread}"
        );
        // In the shadow of the ball nothing is gained.
        dark += u32::from(met < 1.0);
        assert!(
            met < 1.0 || error < 2.0 * spread,
            "{x}: {error} against {spread}"
        );
    }
    assert!((1..4).contains(&dark), "{dark}");
}
