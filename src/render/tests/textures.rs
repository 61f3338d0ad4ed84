//! Textures on solids: colours at known places, bumps against finite differences.

use glam::DVec2;

use super::*;
use crate::geometry::{Cylinder, Hit};
use crate::render::texture::Textures;
use crate::scene::{Image, Pattern, Texture};

const RED: Rgb = Rgb::new(1.0, 0.0, 0.0);
const BLUE: Rgb = Rgb::new(0.0, 0.0, 1.0);

fn checker(repeat: [f64; 2]) -> Texture {
    Texture {
        repeat: DVec2::from_array(repeat),
        pattern: Pattern::Checker([RED, BLUE]),
    }
}

fn picture(repeat: [f64; 2]) -> Texture {
    Texture {
        repeat: DVec2::from_array(repeat),
        pattern: Pattern::Image("a picture".to_owned()),
    }
}

fn images(width: u32, height: u32, pixel: impl Fn(u32, u32) -> [u8; 3]) -> Images {
    let pixels = (0..width * height).map(|at| pixel(at % width, at / width));
    let image = Image::new(Size { width, height }, pixels.collect());
    let image = image.expect("there are as many pixels");
    [("a picture".to_owned(), Arc::new(image))]
        .into_iter()
        .collect()
}

/// The world of a solid that shows its texture as it is.
fn painted(shape: Shape, texture: Texture, images: &Images) -> World {
    let material = Phong {
        colour_texture: Some(0),
        ..grey(1.0)
    };
    let mut scene = scene(&[(shape, material)], &[]);
    scene.textures = vec![texture];
    World::build(Arc::new(scene), images, None, || false).expect("nothing cancels the building")
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
    let world = painted(
        cuboid([0.0; 3], [1.0; 3]),
        checker([4.0, 2.0]),
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

/// On a ball the seam of u is where y changes its sign at x < 0: there u goes from 0 to 1.
#[test]
fn a_ball_has_its_seam_behind() {
    let world = painted(
        sphere([0.0; 3], 1.0),
        checker([3.0, 1.0]),
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
fn a_picture_is_seen_by_its_pixels() {
    // 4 by 3, with colours that name their column and row; a pixel's own is at its upper left.
    let own = |column: u32, row: u32| [60 * column as u8, 100 * row as u8, 51];
    let images = images(4, 3, own);
    let world = painted(cuboid([0.0; 3], [1.0; 3]), picture([1.0, 1.0]), &images);
    let twice = painted(cuboid([0.0; 3], [1.0; 3]), picture([2.0, 2.0]), &images);
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
    // Half way between columns 1 and 2; and from the last column back to the first.
    for (u, red) in [(1.5 / 4.0, 90.0), (3.5 / 4.0, 90.0), (3.25 / 4.0, 135.0)] {
        let place = DVec3::new(u, 1e-12, 1.0);
        let seen = colour(&world, place + DVec3::Z, place).x;
        assert_near(seen, red / 255.0, 1e-10);
    }
}

#[test]
fn a_picture_that_is_not_there_is_magenta() {
    let shape = cuboid([0.0; 3], [1.0; 3]);
    let world = painted(shape, picture([1.0, 1.0]), &Images::default());
    let place = DVec3::new(0.5, 0.5, 1.0);
    let seen = colour(&world, place + DVec3::Z, place);
    assert_eq!(seen, Rgb::new(1.0, 0.0, 1.0));
}

/// All of a material's colours are multiplied, and no other share.
#[test]
fn a_texture_tints_all_that_is_the_materials_own() {
    let textures = Textures::new(&[checker([1.0, 1.0])], &Images::default());
    let plain = Phong {
        ambient: Rgb::splat(0.1),
        diffuse: Rgb::splat(0.5),
        specular: Rgb::splat(2.0),
        exponent: 7.0,
        reflection: 0.25,
        transmission: 0.5,
        index: 1.5,
        colour_texture: Some(0),
        bump: None,
    };
    let shape = cuboid([0.0; 3], [1.0; 3]);
    let down = ray([0.3, 0.3, 5.0], [0.3, 0.3, 0.0]);
    let hit = shape.hit(&down, f64::INFINITY).expect("the face is below");
    let (mut material, mut normal) = (plain, DVec3::Z);
    textures.apply(&shape.chart(&down, hit), &mut material, &mut normal);
    let expected = Phong {
        ambient: 0.1 * RED,
        diffuse: 0.5 * RED,
        specular: 2.0 * RED,
        ..plain
    };
    assert_eq!((material, normal), (expected, DVec3::Z));
}

/// g − ∇h, with the slope of h in the picture by central differences of half a texel, and how fast
/// its coordinates change by differences along the surface.
#[test]
fn bumps_tilt_the_normal_as_raised_surfaces_do() {
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
        Shape::Cylinder(Box::new(Cylinder(
            Affine::new(DVec3::NEG_Z, DVec3::AXES, DVec3::new(1.2, 1.2, 2.0))
                .expect("the axes span a volume"),
        ))),
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
        let mut material = Phong {
            bump: Some((0, amount)),
            ..BLACK
        };
        let mut normal = surface.normal;
        textures.apply(&chart, &mut material, &mut normal);
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
        // Across the seam and close to a pole differences mean nothing.
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

/// A picture that is a plane slope raises a face as a plane does: known on paper.
#[test]
fn a_slope_of_grey_is_a_slope() {
    // 255 columns from black to white: brightness grows by 1/255 in 1/256 of the width.
    let images = images(256, 1, |column, _| [column as u8; 3]);
    let textures = Textures::new(&[picture([1.0, 1.0])], &images);
    // A face 2 wide: u grows by 1/2 in a unit of the world.
    let shape = cuboid([0.0; 3], [2.0, 2.0, 1.0]);
    for amount in [0.5, -0.5] {
        let down = ray([0.7, 0.3, 5.0], [0.7, 0.3, 0.0]);
        let hit = shape.hit(&down, f64::INFINITY).expect("the face is below");
        let mut material = Phong {
            bump: Some((0, amount)),
            ..BLACK
        };
        let mut normal = DVec3::Z;
        textures.apply(&shape.chart(&down, hit), &mut material, &mut normal);
        let slope = amount * 0.5 * 256.0 / 255.0;
        let expected = DVec3::new(-slope, 0.0, 1.0).normalize();
        assert!((normal - expected).length() < 1e-12, "{normal} {expected}");
    }
}

/// A checker bumps nothing, and which side is seen is not for bumps to say.
#[test]
fn bumps_do_not_turn_a_surface() {
    let textures = Textures::new(&[checker([8.0, 8.0])], &Images::default());
    let shape = cuboid([0.0; 3], [1.0; 3]);
    let down = ray([0.125, 0.3, 5.0], [0.125, 0.3, 0.0]);
    let hit = shape.hit(&down, f64::INFINITY).expect("the face is below");
    let mut material = Phong {
        bump: Some((0, 1e6)),
        ..BLACK
    };
    let mut normal = DVec3::Z;
    textures.apply(&shape.chart(&down, hit), &mut material, &mut normal);
    assert_eq!(normal, DVec3::Z);
}
