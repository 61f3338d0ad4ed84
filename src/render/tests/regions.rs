//! Regions: their pixels are those of the whole picture.

use super::progress::{still, trace};
use super::*;
use crate::{Aov, Refusal, Region};

const SIZE: Size = Size {
    width: 45,
    height: 37,
};

/// Regions smaller than a tile and larger, whose edges lie on those of tiles and between.
const REGIONS: [&str; 6] = [
    "0,0,45,37",
    "16,16,16,16",
    "7,3,21,30",
    "44,36,1,1",
    "5,20,40,2",
    "30,0,3,37",
];

/// Everything that frames show of the pixels in a region of the whole picture.
fn cropped(whole: &Frame, region: Region) -> (Vec<[u8; 3]>, Vec<u32>, Vec<[f32; 3]>) {
    let rows = region.y..region.y + region.height;
    let places = rows.flat_map(|y| (region.x..region.x + region.width).map(move |x| [x, y]));
    let places: Vec<_> = places.map(|[x, y]| (y * SIZE.width + x) as usize).collect();
    (
        of(&whole.pixels, &places),
        of(&whole.objects, &places),
        of(&whole.values, &places),
    )
}

fn of<T: Copy>(all: &[T], places: &[usize]) -> Vec<T> {
    let taken = places.iter().filter_map(|&at| all.get(at).copied());
    taken.collect()
}

fn traced(scene: &Arc<Scene>, settings: Settings, frames: Frames) -> Arc<Frame> {
    let (mut renderer, woken) = renderer(2);
    let job = Job {
        frames,
        ..job(scene, settings)
    };
    let generation = restart(&mut renderer, job);
    finish(&renderer, &woken, generation)
}

#[track_caller]
fn assert_crops(scene: &Arc<Scene>, settings: Settings) {
    for frames in [Frames::Live, Frames::LastWithValues] {
        let whole = traced(scene, settings, frames);
        for said in REGIONS {
            let region = Region::parse(said).expect("a region");
            let settings = Settings {
                region: Some(region),
                ..settings
            };
            let part = traced(scene, settings, frames);
            assert_eq!((part.size, part.corner), (region.size(), region.corner()));
            let (pixels, objects, values) = cropped(&whole, region);
            assert!(part.pixels == pixels, "{said}");
            assert!(part.objects == objects, "{said}");
            let bits = |values: &[[f32; 3]]| -> Vec<_> {
                values.iter().map(|value| value.map(f32::to_bits)).collect()
            };
            assert!(bits(&part.values) == bits(&values), "{said}");
        }
    }
}

fn of_size(spp: u32) -> Settings {
    settings(SIZE.width, SIZE.height, spp)
}

#[test]
fn pixels_of_a_region_are_those_of_the_whole_picture() {
    let scene = still();
    for integrator in [Integrator::Whitted, Integrator::Path] {
        assert_crops(
            &scene,
            Settings {
                integrator,
                filter: Filter::Gaussian,
                seed: 5,
                ..of_size(3)
            },
        );
    }
}

#[test]
fn regions_are_seen_through_the_lens_and_against_the_background_of_the_whole_picture() {
    let camera = r#"<camera><position z="5"/><target/><up y="1"/><focaldist value="4"/>
        <dof value="0.3"/></camera>"#;
    let scene = xml_seen_by(
        camera,
        r#"<object type="sphere" material="m"/>
        <material type="blinn" name="m"><reflection r="0.5" g="0.5" b="0.5"/></material>
        <light type="point"><intensity value="1"/><position x="3" y="4" z="5"/></light>
        <background texture="checkerboard"><scale x="0.3" y="0.2"/></background>"#,
    );
    let scene = Arc::new(scene);
    for integrator in [Integrator::Whitted, Integrator::Path] {
        assert_crops(
            &scene,
            Settings {
                integrator,
                ..of_size(4)
            },
        );
    }
}

#[test]
fn regions_of_parallel_views_are_cropped_too() {
    let mut scene = Scene::clone(&still());
    scene.camera.lens = Lens::Orthographic(4.0);
    scene.camera.depths = [1.0, 9.0];
    assert_crops(&Arc::new(scene), of_size(2));
}

#[test]
fn aovs_of_a_region_are_those_of_the_whole_picture() {
    let scene = still();
    for aov in [Aov::Normal, Aov::Object, Aov::Albedo] {
        assert_crops(
            &scene,
            Settings {
                aov: Some(aov),
                ..of_size(aov.samples(2))
            },
        );
    }
}

/// The distances are the same; their nearest and farthest are the white and the black of 8 bits.
#[test]
fn depth_is_shown_from_the_nearest_to_the_farthest_in_the_region() {
    let scene = still();
    let region = Region::parse("7,3,21,30");
    let depth = Settings {
        aov: Some(Aov::Depth),
        ..of_size(1)
    };
    let whole = traced(&scene, depth, Frames::LastWithValues);
    let part = traced(&scene, Settings { region, ..depth }, Frames::LastWithValues);
    assert_eq!(part.values, cropped(&whole, region.expect("a region")).2);
    let finite = part.pixels.iter().zip(&part.values);
    let finite = finite.filter(|(_, value)| value[0].is_finite());
    let brightest = finite.clone().map(|(pixel, _)| pixel[0]).max();
    let darkest = finite.map(|(pixel, _)| pixel[0]).min();
    assert_eq!((darkest, brightest), (Some(0), Some(255)));
}

/// Of a picture too large for any machine, a region is traced.
#[test]
fn only_the_region_takes_time_and_memory() {
    let scene = still();
    let region = Region::parse("3000000000,2000000000,8,6");
    let huge = Settings {
        region,
        ..settings(u32::MAX, u32::MAX, 2)
    };
    let frame = trace(&scene, huge, 1);
    assert_eq!(frame.pixels.len(), 48);
    assert!(frame.progress.rays < 10_000, "{}", frame.progress.rays);
}

#[test]
fn regions_outside_the_picture_are_refused() {
    let (mut renderer, _woken) = renderer(1);
    for said in ["40,0,6,1", "0,37,1,1", "3,3,0,3"] {
        let region = Region::parse(said).expect("a region");
        let settings = Settings {
            region: Some(region),
            ..of_size(1)
        };
        let refused = renderer.restart(job(&still(), settings));
        let reason = region.within(SIZE).expect_err("it is outside");
        assert_eq!(refused, Err(Refusal::Region(reason)));
    }
}
