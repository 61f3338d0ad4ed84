//! AOVs of the first surface.

use super::*;
use crate::Aov;

const SIZE: Size = Size {
    width: 41,
    height: 31,
};

/// A frame of two balls with the values of an AOV.
fn values(aov: Aov, spp: u32) -> Arc<Frame> {
    let tinted = |red| Coefficients {
        diffuse: Rgb::new(red, 0.5, 2.0),
        ..grey(1.0)
    };
    let mut scene = scene(
        &[
            (sphere([0.0, 0.0, 0.0], 1.0), tinted(0.25)),
            (sphere([2.0, 0.0, -2.0], 1.0), tinted(0.75)),
        ],
        &[],
    );
    scene.camera.size = SIZE;
    // The part before the near limit counts toward the distance.
    scene.camera.depths = [1.5, 100.0];
    let (mut renderer, woken) = renderer(2);
    let job = Job {
        camera: scene.camera,
        scene: Arc::new(scene),
        images: Images::default(),
        settings: Settings {
            aov: Some(aov),
            ..settings(SIZE.width, SIZE.height, spp)
        },
        limit: None,
        frames: Frames::LastWithValues,
        denoise: false,
        numbers: None,
    };
    let generation = restart(&mut renderer, job);
    finish(&renderer, &woken, generation)
}

fn at(x: usize, y: usize) -> usize {
    y * SIZE.width as usize + x
}

const CENTRE: usize = 15 * 41 + 20;

/// From (0, 0, 5), hits on the unit ball are at the roots of |o + t d| = 1.
#[test]
fn depth_is_the_distance_from_the_eye() {
    let frame = values(Aov::Depth, 1);
    assert_eq!(frame.values[CENTRE], [4.0; 3]);
    assert_eq!(frame.pixels[CENTRE], [255; 3]);
    assert_eq!(frame.values[at(0, 0)], [f32::INFINITY; 3]);
    assert_eq!(frame.pixels[at(0, 0)], [0; 3]);
    let half_height = 0.5_f64.mul_add(45.0, 0.0).to_radians().tan();
    let mut hits = 0;
    for x in 0..SIZE.width {
        let across = f64::from(2 * x + 1) / 41.0 - 1.0;
        let direction = DVec3::new(across * half_height * 41.0 / 31.0, 0.0, -1.0).normalize();
        let b = 5.0 * direction.z;
        if b * b < 24.0 {
            continue;
        }
        let expected = -b - (b * b - 24.0).sqrt();
        let found = f64::from(frame.values[at(x as usize, 15)][0]);
        assert!((found - expected).abs() < 1e-6, "{x}: {found}, {expected}");
        hits += 1;
    }
    assert!(5 < hits);
}

#[test]
fn normals_objects_and_albedos_belong_to_the_first_surface() {
    for spp in [1, 4] {
        let normals = values(Aov::Normal, spp);
        if spp == 1 {
            assert_eq!(normals.values[CENTRE], [0.0, 0.0, 1.0]);
            assert_eq!(normals.pixels[CENTRE], [128, 128, 255]);
        }
        assert_eq!(normals.values[0], [0.0; 3]);
        assert_eq!(normals.pixels[0], [0; 3]);
        let albedos = values(Aov::Albedo, spp);
        assert_eq!(albedos.values[CENTRE], [0.25, 0.5, 2.0]);
        assert_eq!(albedos.pixels[CENTRE], [64, 128, 255]);
    }
    let objects = values(Aov::Object, 1);
    let numbers: std::collections::BTreeSet<_> =
        objects.values.iter().map(|value| value[0] as u32).collect();
    assert_eq!(numbers, [0, 1, 2].into());
    for (value, object) in objects.values.iter().zip(&objects.objects) {
        assert_eq!(value[0] as u32, object.wrapping_add(1));
    }
}

#[test]
fn radiance_is_returned_unclamped_on_request() {
    let bright = scene(&[(sphere([0.0; 3], 1.0), grey(3.5))], &[]);
    let (mut renderer, woken) = renderer(1);
    for (frames, told) in [(Frames::LastWithValues, true), (Frames::Last, false)] {
        let job = Job {
            camera: bright.camera,
            scene: Arc::new(bright.clone()),
            images: Images::default(),
            settings: settings(41, 31, 1),
            frames,
            limit: None,
            denoise: false,
            numbers: None,
        };
        let generation = restart(&mut renderer, job);
        let frame = finish(&renderer, &woken, generation);
        assert_eq!(frame.pixels[CENTRE], [255; 3]);
        assert_eq!(frame.values.get(CENTRE), told.then_some(&[3.5; 3]));
    }
}

#[test]
fn objects_are_called_by_the_numbers_of_the_job() {
    let objects = [-1.5, 1.5].map(|x| (sphere([x, 0.0, 0.0], 1.0), grey(0.5)));
    let scene = Arc::new(scene(&objects, &[]));
    let (mut renderer, woken) = renderer(1);
    let own = job(&scene, settings(41, 31, 1));
    let mut seen = |numbers: Option<Arc<[u32]>>| {
        let job = Job {
            numbers,
            ..own.clone()
        };
        let generation = restart(&mut renderer, job);
        let frame = finish(&renderer, &woken, generation);
        frame.objects.clone()
    };
    let plain = seen(None);
    let named = seen(Some([7, 3].into()));
    let name = |&object: &u32| match object {
        0 => 7,
        1 => 3,
        other => other,
    };
    assert!(plain.contains(&0) && plain.contains(&1) && plain.contains(&NO_OBJECT));
    assert_eq!(named, plain.iter().map(name).collect::<Vec<_>>());
}
