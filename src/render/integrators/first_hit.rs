//! AOVs: properties of the first surface along a ray, apart from light.

use glam::DVec3;

use super::probe::{Sample, SampleResult};
use crate::job::{Aov, NO_OBJECT};
use crate::world::{Dependencies, World};
use geometry::{Ray, Side};
use scene::{Integrator, Rgb};

/// Computes an AOV at the first surface that a camera ray hits within `reach`; the ray starts
/// `skipped` away from the eye.
pub(crate) fn first_hit(
    world: &World,
    ray: &Ray,
    reach: f64,
    skipped: f64,
    aov: Aov,
) -> SampleResult {
    let Some(nearest) = world.nearest(ray, reach) else {
        let radiance = match aov {
            Aov::Depth => Rgb::INFINITY,
            _ => Rgb::ZERO,
        };
        return SampleResult {
            radiance,
            object: NO_OBJECT,
            touched: Dependencies::default(),
            rays: 1,
        };
    };
    let mut mapped = None;
    let (point, material) = world.shading_point(ray, nearest, &mut mapped);
    let value = match aov {
        Aov::Depth => DVec3::splat(skipped + nearest.hit.t),
        Aov::Normal => point.normal,
        Aov::Object => DVec3::splat(f64::from(nearest.object) + 1.0),
        Aov::Albedo => material.albedo(),
        Aov::Uv => {
            let shape = &world.scene.objects[nearest.object as usize].shape;
            shape.chart(ray, nearest.hit).uv.extend(0.0)
        }
        Aov::Side => DVec3::splat(match point.side {
            Side::Front => 1.0,
            Side::Back => -1.0,
        }),
        // The others belong to light, see [`Settings::surface`](crate::Settings).
        _ => DVec3::ZERO,
    };
    SampleResult {
        radiance: value,
        object: nearest.object,
        touched: Dependencies::object(nearest.object),
        rays: 1,
    }
}

/// What tells the surface under a pixel from others: the properties of first surfaces, summed over
/// samples.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Guide {
    /// Shading normals, as for [`Aov::Normal`].
    pub(crate) normal: [f32; 3],
    /// Albedos, as for [`Aov::Albedo`].
    pub(crate) albedo: [f32; 3],
    /// Reciprocals of distances from the eye, which are nearly linear across the picture of a plane;
    /// 0 without a surface.
    pub(crate) nearness: f32,
}

impl Guide {
    /// Adds another sample.
    pub(crate) fn add(&mut self, other: Self) {
        for (sum, more) in self.normal.iter_mut().zip(other.normal) {
            *sum += more;
        }
        for (sum, more) in self.albedo.iter_mut().zip(other.albedo) {
            *sum += more;
        }
        self.nearness += other.nearness;
    }
}

/// Computes all that guides at the first surface of a camera sample, whose ray starts `skipped` away
/// from the eye. By path tracing, lights with a size are surfaces that glow.
pub(crate) fn guide(world: &World, sample: &Sample, skipped: f64, integrator: Integrator) -> Guide {
    let nearest = world.nearest(&sample.ray, sample.reach);
    let distance = nearest.map_or(sample.reach, |nearest| nearest.hit.t);
    if integrator.traces_paths()
        && let Some((_, light, distance)) = world.sphere_lights.nearest(&sample.ray, distance)
    {
        return Guide {
            normal: [0.0; 3],
            albedo: light.radiance().as_vec3().to_array(),
            nearness: (1.0 / (skipped + distance)) as f32,
        };
    }
    let Some(nearest) = nearest else {
        return Guide::default();
    };
    let mut mapped = None;
    let (point, material) = world.shading_point(&sample.ray, nearest, &mut mapped);
    Guide {
        normal: point.normal.as_vec3().to_array(),
        albedo: material.albedo().as_vec3().to_array(),
        nearness: (1.0 / (skipped + nearest.hit.t)) as f32,
    }
}
