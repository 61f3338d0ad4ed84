//! What sends light: lights, objects that emit, and the environment. Each is sampled from a point
//! without knowing what is in between.

mod emitters;
pub(crate) mod lights;
mod sky;

pub(crate) use emitters::{Choices, Emitters, ManyLights, PreviousEmitters};
pub(crate) use lights::{
    Incoming, SphereLight, SphereLights, Spheres, faded, falloff_shares, incoming, incoming_each,
    light_sphere, luminous_sphere, radiant_intensity,
};
pub(crate) use sky::Sky;
