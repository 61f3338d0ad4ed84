//! Pictures with photons, and what is explained of them.

use super::super::integrators::PhotonRules;
use super::photons::{PHOTONS, WHITE, world_by};
use super::*;
use crate::integrators::path::radiance_alone;
use crate::integrators::{FrameContext, Photons, Probe};
use crate::{PreparedScene, TracedRay};

/// A glass ball and a mirror over a ground, lit by a point and a light with a size, as a job.
fn caustics() -> Job {
    let scene = Arc::new(xml(&format!(
        "{WHITE}<object type='sphere' material='glass'><translate z='1.2'/></object>
         <object type='sphere' material='mirror'><translate x='2' z='1'/></object>
         <material name='glass'><diffuse value='.1'/><specular value='0'/>
         <refraction value='.8' index='1.5'/></material>
         <material name='mirror'><diffuse value='.1'/><specular value='0'/>
         <reflection value='.8'/></material>
         <light type='point'><intensity value='9'/><position z='6.2'/><attenuation value='1'/></light>
         <light type='point'><intensity value='9'/><position x='-3' z='5'/><size value='.5'/>
         <attenuation value='1'/></light>"
    )));
    let camera = Camera {
        eye: DVec3::new(0.0, -6.0, 4.0),
        target: DVec3::Z,
        up: DVec3::Z,
        ..scene.camera
    };
    let settings = Settings {
        integrator: Integrator::Photon,
        ..settings(40, 30, 40)
    };
    Job {
        camera,
        frames: Frames::LastWithValues,
        ..job(&scene, settings)
    }
}

fn frame_by(threads: usize, job: &Job) -> Arc<Frame> {
    let (mut renderer, woken) = renderer(threads);
    let generation = restart(&mut renderer, job.clone());
    finish(&renderer, &woken, generation)
}

#[test]
fn pictures_with_photons_are_the_same_for_any_number_of_threads() {
    let job = caustics();
    let bits = |threads| {
        let frame = frame_by(threads, &job);
        let values = frame.values.iter().flatten();
        values.map(|value| value.to_bits()).collect::<Vec<_>>()
    };
    let one = bits(1);
    assert!(one == bits(2));
    assert!(one == bits(8));
}

/// After edits of the view and of materials, as if nothing had been traced before.
#[test]
fn photons_that_are_kept_are_those_of_the_scene() {
    let first = Job {
        frames: Frames::Live,
        ..caustics()
    };
    let first = Job {
        settings: Settings {
            spp: 2,
            ..first.settings
        },
        ..first
    };
    let mut moved = first.clone();
    moved.camera.eye.x += 1.0;
    let mut darker = (*first.scene).clone();
    darker.materials.edit(|materials| {
        for material in materials {
            material.dielectric.tint *= 0.5;
        }
    });
    let mut recoloured = moved.clone();
    recoloured.scene = Arc::new(darker);
    let mut shallow = recoloured.clone();
    shallow.settings.depth = 2;
    let (mut renderer, woken) = renderer(2);
    for job in [first, moved, recoloured, shallow] {
        let generation = restart(&mut renderer, job.clone());
        let kept = finish(&renderer, &woken, generation);
        assert!(kept.values == frame_by(1, &job).values);
    }
}

/// What photons carry is a part of the explanation, and all parts are the sample, bit for bit.
#[test]
fn photons_are_explained() {
    let job = caustics();
    let prepared = PreparedScene::new(&job, &|| false).expect("nothing cancels");
    let world = world_by(&job.scene, PHOTONS);
    let rules = PhotonRules::of(&job.settings).expect("it has photons");
    let photons = Photons::build(&world, rules, None, &|| false).expect("nothing cancels");
    let maps = photons
        .maps(&world, 0..4, &|| false)
        .expect("nothing cancels");
    let context = FrameContext::new(&world, &job.camera, job.settings);
    let mut brought = 0;
    for (x, y, index) in
        (0..40).flat_map(|x| (0..30).map(move |y| (x, y, if x == 7 { y / 9 } else { 0 })))
    {
        let explanation = prepared.query().explain([x, y], index, &|| false);
        let explanation = explanation.expect("it is prepared");
        let mut samples = Vec::new();
        context.samples(&[[x, y]], index, &mut samples);
        let tracer = Tracer::new(&world, Integrator::Photon, job.settings.depth, &|| false);
        let seen = tracer.with_photons(Some(&maps)).radiance(&samples[0]);
        assert_eq!(explanation.radiance, seen.radiance, "{x} {y} {index}");
        let probe = Probe::new(&world, job.settings.depth, &|| false);
        let alone = radiance_alone(&mut probe.with_photons(maps.get(index)), &samples[0]);
        assert_eq!(alone, seen.radiance, "{x} {y} {index}");
        let sum = |sum, ray: &TracedRay| sum + ray.contribution;
        assert_eq!(explanation.rays.iter().fold(Rgb::ZERO, sum), seen.radiance);
        let shadings = explanation.rays.iter().filter_map(|ray| ray.shading());
        brought += shadings
            .filter(|shading| shading.caustics != Rgb::ZERO)
            .count();
    }
    assert!(20 < brought, "{brought}");
}
