//! Textures on solids: colours at known points, and bumps against finite differences.

use glam::DVec2;

use super::highlights::{assert_colour, brings};
use super::*;
use crate::material::Textures;
use geometry::{Cylinder, Hit};
use scene::{Bump, Dielectric, Emitter, Gloss, Highlight, Image, Materials, Mirror};

const RED: Rgb = Rgb::new(1.0, 0.0, 0.0);
const BLUE: Rgb = Rgb::new(0.0, 0.0, 1.0);

fn red_and_blue(repeat: [f64; 2]) -> Texture {
    checker(DVec2::from_array(repeat), [RED, BLUE])
}

fn picture(repeat: [f64; 2]) -> Texture {
    let pattern = Pattern::Image("a picture".to_owned());
    Texture::repeated(DVec2::from_array(repeat), pattern)
}

fn images(width: u32, height: u32, pixel: impl Fn(u32, u32) -> [u8; 3]) -> Images {
    let pixels = (0..width * height).map(|at| pixel(at % width, at / width));
    let image = Image::new(Size { width, height }, pixels.collect());
    let image = image.expect("there are as many pixels");
    [("a picture".to_owned(), Arc::new(image))]
        .into_iter()
        .collect()
}

/// The world of a solid that shows its texture unlit.
fn shown(shape: Shape, texture: Texture, images: &Images) -> World {
    let mut scene = scene(&[(shape, BLACK)], &[]);
    scene.materials = [painted(grey(1.0), Some(0))].into_iter().collect();
    scene.textures = vec![texture];
    World::build(Arc::new(scene), images, PATHS, None, &|| false)
        .expect("nothing cancels the building")
}

fn colour(world: &World, from: DVec3, toward: DVec3) -> Rgb {
    let ray = ray(from.to_array(), toward.to_array());
    let seen = tracer(world, 0).radiance(&centred(ray, f64::INFINITY));
    assert_ne!(seen.object, NO_OBJECT);
    seen.radiance
}

/// The face z = 1 of the unit cube has u = x and v = y.
#[test]
fn checkers_change_colour_at_their_seams() {
    let world = shown(
        cuboid([0.0; 3], [1.0; 3]),
        red_and_blue([4.0, 2.0]),
        &Images::default(),
    );
    let edge = 1e-9;
    for (x, y, expected) in [
        (0.1, 0.1, RED),
        (0.25 - edge, 0.1, RED),
        (0.25 + edge, 0.1, BLUE),
        (0.5 + edge, 0.1, RED),
        (0.1, 0.5 - edge, RED),
        (0.1, 0.5 + edge, BLUE),
        (0.3, 0.9, RED),
        (1.0 - edge, 1.0 - edge, RED),
    ] {
        let place = DVec3::new(x, y, 1.0);
        assert_eq!(colour(&world, place + DVec3::Z, place), expected, "{x} {y}");
    }
}

/// On a ball the seam of u is where y changes sign at x < 0; u jumps from 0 to 1.
#[test]
fn the_seam_of_a_ball_is_behind_it() {
    let world = shown(
        sphere([0.0; 3], 1.0),
        red_and_blue([3.0, 1.0]),
        &Images::default(),
    );
    for (degrees, expected) in [
        (-179.9, RED),
        (-61.0, RED),
        (-59.0, BLUE),
        (0.0, BLUE),
        (59.0, BLUE),
        (61.0, RED),
        (179.9, RED),
    ] {
        let (y, x) = f64::to_radians(degrees).sin_cos();
        let place = DVec3::new(x, y, 0.5);
        assert_eq!(
            colour(&world, 3.0 * place, DVec3::ZERO),
            expected,
            "{degrees}°"
        );
    }
}

#[test]
fn an_image_shows_its_pixels() {
    // 4×3 pixels whose colours encode column and row; a pixel's own colour is at its upper left.
    let own = |column: u32, row: u32| [60 * column as u8, 100 * row as u8, 51];
    let images = images(4, 3, own);
    let world = shown(cuboid([0.0; 3], [1.0; 3]), picture([1.0, 1.0]), &images);
    let twice = shown(cuboid([0.0; 3], [1.0; 3]), picture([2.0, 2.0]), &images);
    for column in 0..4 {
        for row in 0..3 {
            let (u, v) = (f64::from(column) / 4.0, f64::from(row) / 3.0);
            let expected = DVec3::from_array(own(column, row).map(f64::from)) / 255.0;
            let nudge = 1e-12;
            let place = DVec3::new(u + nudge, v + nudge, 1.0);
            let seen = colour(&world, place + DVec3::Z, place);
            assert!((seen - expected).length() < 1e-10, "{seen} {expected}");
            let half = DVec3::new(0.5 + 0.5 * place.x, 0.5 * place.y, 1.0);
            let again = colour(&twice, half + DVec3::Z, half);
            assert!((again - expected).length() < 1e-10, "{again} {expected}");
        }
    }
    // Halfway between columns 1 and 2, and between the last column and the first.
    for (u, red) in [(1.5 / 4.0, 90.0), (3.5 / 4.0, 90.0), (3.25 / 4.0, 135.0)] {
        let place = DVec3::new(u, 1e-12, 1.0);
        let seen = colour(&world, place + DVec3::Z, place).x;
        assert_near(seen, red / 255.0, 1e-10);
    }
}

#[test]
fn a_missing_image_is_magenta() {
    let shape = cuboid([0.0; 3], [1.0; 3]);
    let world = shown(shape, picture([1.0, 1.0]), &Images::default());
    let place = DVec3::new(0.5, 0.5, 1.0);
    let seen = colour(&world, place + DVec3::Z, place);
    assert_eq!(seen, Rgb::new(1.0, 0.0, 1.0));
}

/// All of a material's own colours are multiplied, but no other weights.
#[test]
fn a_texture_tints_all_own_colours_of_a_material() {
    let textures = Textures::new(&[red_and_blue([1.0, 1.0])], &Images::default());
    let plain = Coefficients {
        ambient: Rgb::splat(0.1),
        diffuse: Rgb::splat(0.5),
        specular: Rgb::splat(2.0),
        exponent: 7.0,
        reflection: 0.25,
        transmission: 0.5,
        index: 1.5,
    };
    let shape = cuboid([0.0; 3], [1.0; 3]);
    let down = ray([0.3, 0.3, 5.0], [0.3, 0.3, 0.0]);
    let hit = shape.hit(&down, f64::INFINITY).expect("the face is below");
    let material = painted(plain, Some(0));
    let maps = material.maps.as_ref().expect("it is painted");
    let expected = Coefficients {
        ambient: 0.1 * RED,
        diffuse: 0.5 * RED,
        specular: 2.0 * RED,
        ..plain
    };
    let found = textures.applied(maps, &material, shape.chart(&down, hit).uv);
    assert_eq!(found, expected.into());
}

/// Values without maps are unchanged, and each slot has its own map.
#[test]
fn each_slot_has_its_own_texture() {
    let grey = |level: f64| checker(DVec2::ONE, [Rgb::splat(level); 2]);
    let levels = [0.5, 0.25, 0.125, 2.0, 4.0];
    let textures = Textures::new(&levels.map(grey), &Images::default());
    let with = |level: [f64; 5]| Material {
        diffuse: Rgb::splat(level[0]),
        highlight: Highlight::Blinn(Gloss {
            specular: Rgb::splat(level[1]),
            exponent: level[2],
        }),
        mirror: Mirror {
            tint: Rgb::splat(level[3]),
            ..Mirror::default()
        },
        dielectric: Dielectric {
            tint: Rgb::splat(level[4]),
            ..Dielectric::OPAQUE
        },
        emission: Rgb::splat(3.0),
        ..Material::BLACK
    };
    let maps = Maps {
        diffuse: Some(0),
        specular: Some(1),
        exponent: Some(2),
        mirror: Some(3),
        dielectric: Some(4),
        ..Maps::default()
    };
    assert_eq!(
        textures.applied(&maps, &with([1.0; 5]), DVec2::ZERO),
        with(levels)
    );
}

/// g − ∇h, with the slope of h in the image from central differences of half a texel, and the
/// derivatives of uv from differences along the surface.
#[test]
fn bumps_tilt_normals_like_a_displaced_surface() {
    let images = images(16, 8, |column, row| {
        let wave = (column * 37 + row * 91 + column * row * 13) % 200;
        [wave as u8, (wave / 2) as u8, 255 - wave as u8]
    });
    let repeat = [2.0, 1.5];
    let textures = Textures::new(&[picture(repeat)], &images);
    let image = images.get("a picture").expect("it was just made");
    let bright = |u: f64, v: f64| image.at(u, v).dot(Rgb::new(0.2126, 0.7152, 0.0722));
    let half = 0.5 / DVec2::new(16.0, 8.0);
    let shapes = [
        sphere([0.0; 3], 1.3),
        cuboid([-1.0, -0.5, -1.5], [2.0, 1.0, 3.0]),
        Shape::Solid(Solid::Cylinder(Box::new(Cylinder(
            Affine::new(DVec3::NEG_Z, DVec3::AXES, DVec3::new(1.2, 1.2, 2.0))
                .expect("the axes span a volume"),
        )))),
    ];
    let mut checked = 0;
    for index in 0..3_000 {
        let mut random = Numbers::new(index);
        let shape = &shapes[index % 3];
        let incoming = ray(
            (5.0 * random.direction()).to_array(),
            (0.5 * random.in_cube()).to_array(),
        );
        let Some(hit) = shape.hit(&incoming, f64::INFINITY) else {
            continue;
        };
        let surface = shape.surface(&incoming, hit);
        let chart = shape.chart(&incoming, hit);
        let amount = random.between(-0.5, 0.5);
        let bump = Bump {
            texture: 0,
            height: amount,
        };
        let normal = textures.bumped(bump, &chart, surface.normal);
        let place = DVec2::from_array(repeat) * chart.uv;
        let grows = DVec2::new(
            bright(place.x + half.x, place.y) - bright(place.x - half.x, place.y),
            bright(place.x, place.y + half.y) - bright(place.x, place.y - half.y),
        ) / (2.0 * half);
        let step = 1e-6;
        let place_at = |point: DVec3| {
            let at = Ray {
                origin: point,
                direction: DVec3::X,
            };
            DVec2::from_array(repeat) * shape.chart(&at, Hit { t: 0.0, ..hit }).uv
        };
        let mut slope = DVec3::ZERO;
        let tangent = surface.normal.any_orthonormal_vector();
        for along in [tangent, surface.normal.cross(tangent)] {
            let [before, after] = [-step, step].map(|h| place_at(surface.point + h * along));
            slope += amount * grows.dot(after - before) / (2.0 * step) * along;
        }
        // Across the seam and near a pole differences are meaningless.
        if 10.0 < slope.length() {
            continue;
        }
        checked += 1;
        let expected = (surface.normal - slope).normalize();
        assert!(
            (normal - expected).length() < 1e-6,
            "{index}: {normal} is not {expected}"
        );
    }
    assert!(1_000 < checked, "{checked} checked");
}

/// An image with a constant slope tilts a face like a plane, as computed by hand.
#[test]
fn a_constant_gradient_is_a_constant_tilt() {
    // 255 columns from black to white: brightness grows by 1/255 per 1/256 of the width.
    let images = images(256, 1, |column, _| [column as u8; 3]);
    let textures = Textures::new(&[picture([1.0, 1.0])], &images);
    // A face of width 2: u grows by 1/2 per world unit.
    let shape = cuboid([0.0; 3], [2.0, 2.0, 1.0]);
    for amount in [0.5, -0.5] {
        let down = ray([0.7, 0.3, 5.0], [0.7, 0.3, 0.0]);
        let hit = shape.hit(&down, f64::INFINITY).expect("the face is below");
        let bump = Bump {
            texture: 0,
            height: amount,
        };
        let normal = textures.bumped(bump, &shape.chart(&down, hit), DVec3::Z);
        let slope = amount * 0.5 * 256.0 / 255.0;
        let expected = DVec3::new(-slope, 0.0, 1.0).normalize();
        assert!((normal - expected).length() < 1e-12, "{normal} {expected}");
    }
}

/// The same slope on materials of several kinds, lit from straight above by the cosine alone.
#[test]
fn bumps_tilt_normals_with_every_highlight() {
    let images = images(256, 1, |column, _| [column as u8; 3]);
    let light = Light {
        emitter: Emitter::Distant(DVec3::Z),
        ..white_light([0.0; 3])
    };
    let none = Gloss::default();
    for highlight in [
        Highlight::None,
        Highlight::Phong(none),
        Highlight::ModifiedPhong(none),
        Highlight::Blinn(none),
    ] {
        let mut scene = scene(&[(cuboid([0.0; 3], [2.0, 2.0, 1.0]), BLACK)], &[light]);
        let bump = Bump {
            texture: 0,
            height: 0.5,
        };
        let maps = Maps {
            bump: Some(bump),
            ..Maps::default()
        };
        scene.materials = Materials::from_iter([Material {
            diffuse: Rgb::ONE,
            highlight,
            maps: maps.boxed(),
            ..Material::BLACK
        }]);
        scene.textures = vec![picture([1.0, 1.0])];
        scene.ambient = Rgb::ZERO;
        let world = World::build(Arc::new(scene), &images, PATHS, None, &|| false);
        let world = world.expect("nothing cancels the building");
        let place = DVec3::new(0.7, 0.3, 1.0);
        let seen = colour(&world, place + DVec3::Z, place).x;
        let slope = 0.5 * 0.5 * 256.0 / 255.0;
        assert_near(seen, 1.0 / f64::hypot(1.0, slope), 1e-12);
    }
}

/// A checker has no slope, and bumps do not affect which side is seen.
#[test]
fn bumps_do_not_flip_a_surface() {
    let textures = Textures::new(&[red_and_blue([8.0, 8.0])], &Images::default());
    let shape = cuboid([0.0; 3], [1.0; 3]);
    let down = ray([0.125, 0.3, 5.0], [0.125, 0.3, 0.0]);
    let hit = shape.hit(&down, f64::INFINITY).expect("the face is below");
    let bump = Bump {
        texture: 0,
        height: 1e6,
    };
    let normal = textures.bumped(bump, &shape.chart(&down, hit), DVec3::Z);
    assert_eq!(normal, DVec3::Z);
}

/// Plane: ((x + 1) / 2, (y + 1) / 2); sphere: longitude and latitude. Squares of half the width.
#[test]
fn uv_on_planes_and_spheres() {
    let board = "<material name='m'><diffuse value='0'/><specular value='0'/>
        <emission texture='checkerboard'><color1 r='1' g='0' b='0'/><color2 r='0' g='0' b='1'/>
        </emission></material>";
    let (red, blue) = (Rgb::X, Rgb::Z);
    for (shape, from, to, expected) in [
        ("plane", [-0.5, -0.5, 1.0], [-0.5, -0.5, 0.0], red),
        ("plane", [0.5, -0.5, 1.0], [0.5, -0.5, 0.0], blue),
        ("plane", [0.5, 0.5, -1.0], [0.5, 0.5, 0.0], red),
        // −y is at longitude u < ½; below the equator v < ½.
        ("sphere", [3.0, -3.0, -1.0], [0.0; 3], red),
        ("sphere", [3.0, -3.0, 1.0], [0.0; 3], blue),
        ("sphere", [3.0, 3.0, 1.0], [0.0; 3], red),
    ] {
        let scene = format!("<object type='{shape}' material='m'/>{board}");
        let seen = brings(&scene, 0, ray(from, to));
        assert_colour(seen, expected, &format!("{shape} {to:?} from {from:?}"));
    }
}

/// A checker over the whole picture: quarters of it, looked up per pixel.
#[test]
fn the_background_is_looked_up_per_pixel() {
    let scene = xml_seen_by(
        "<camera><width value='4'/><height value='2'/></camera>",
        "<background texture='checkerboard'><color1 value='0'/><color2 value='1'/></background>",
    );
    let scene = Arc::new(scene);
    let (mut renderer, woken) = renderer(1);
    for spp in [1, 4] {
        let generation = restart(&mut renderer, job(&scene, settings(4, 2, spp)));
        let frame = finish(&renderer, &woken, generation);
        let row = frame
            .pixels
            .iter()
            .map(|pixel| pixel[0])
            .collect::<Vec<_>>();
        assert_eq!(row, [0, 0, 255, 255, 255, 255, 0, 0], "{spp}");
    }
}
