//! Kinds of rays.

/// Why a ray was traced.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RayKind {
    /// From the camera.
    Camera,
    /// Reflected by a mirror.
    Mirror,
    /// The part that the boundary of a transparent solid reflects.
    Boundary,
    /// Into or out of a transparent solid.
    Refraction,
    /// Reflected at the boundary of a transparent solid, because none of the light can leave.
    TotalReflection,
    /// Scattered by a path in a direction of the diffuse lobe.
    Diffuse,
    /// Scattered by a path in a direction of the glossy lobe.
    Glossy,
}
