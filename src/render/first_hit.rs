//! AOVs: properties of the first surface along a ray, apart from light.

use glam::DVec3;

use super::frame::{Aov, NO_OBJECT};
use super::probe::Seen;
use super::shading::Side;
use super::touched::Touched;
use super::world::World;
use crate::geometry::Ray;
use crate::scene::Rgb;

/// Computes an AOV at the first surface that a camera ray hits within `reach`; the ray starts
/// `skipped` away from the eye.
pub(crate) fn first_hit(world: &World, ray: &Ray, reach: f64, skipped: f64, aov: Aov) -> Seen {
    let Some(nearest) = world.nearest(ray, reach) else {
        let radiance = match aov {
            Aov::Depth => Rgb::INFINITY,
            _ => Rgb::ZERO,
        };
        return Seen {
            radiance,
            object: NO_OBJECT,
            touched: Touched::default(),
            rays: 1,
        };
    };
    let mut mapped = None;
    let (point, material) = world.arrive(ray, nearest, &mut mapped);
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
        // The others belong to light, see [`Settings::surface`](super::Settings).
        _ => DVec3::ZERO,
    };
    Seen {
        radiance: value,
        object: nearest.object,
        touched: Touched::object(nearest.object),
        rays: 1,
    }
}
