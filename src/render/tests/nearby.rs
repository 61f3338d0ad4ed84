//! Rays among the objects near a point.

use super::*;
use crate::world::Nearby;

/// Short rays meet what they meet among all objects.
#[test]
fn objects_nearby_are_all_that_short_rays_meet() {
    let ball = "<object type='sphere' material='m'><scale value='.4'/>";
    let mut scene = "<object type='sphere' material='m'><scale value='3'/></object>
        <object type='plane' material='m'><scale value='2'/></object><material name='m'/>"
        .to_owned();
    let mut random = Random(5);
    for count in [3, 12, 60] {
        for _ in 0..count {
            let DVec3 { x, y, z } = random.point(2.0);
            let place = format!("<translate x='{x}' y='{y}' z='{z}'/></object>");
            scene.push_str(ball);
            scene.push_str(&place);
        }
        let world = world(xml(&scene));
        let mut met = 0;
        for _ in 0..800 {
            let (at, radius) = (random.point(3.0), random.next());
            let nearby = Nearby::new(&world, at, radius);
            let [from, to] = [0; 2].map(|_: i32| at + random.point(radius / 3f64.sqrt()));
            let ray = Ray {
                origin: from,
                direction: (to - from).normalize(),
            };
            let limit = (to - from).length();
            let expected = world.nearest(&ray, limit);
            assert_eq!(nearby.nearest(&ray, limit), expected, "{ray:?}");
            met += usize::from(expected.is_some());
        }
        assert!(50 < met, "{met}");
    }
}
