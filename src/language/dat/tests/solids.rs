//! The surfaces of solids, along rays with crossings computed by hand.

use glam::DVec3;

use super::{scene, spelled};
use geometry::{Ray, Spans};
use scene::Object;

const X: [f64; 3] = [1., 0., 0.];
const Y: [f64; 3] = [0., 1., 0.];
const Z: [f64; 3] = [0., 0., 1.];

/// The only drawn object of a text with materials 0 and 1.
fn solid(records: &str) -> Object {
    let text = spelled(&format!("VIEW\nmat ID 0 MAT\nmat ID 1 MAT\n{records}"));
    let objects = scene(&text).objects;
    assert_eq!(objects.len(), 1, "{records}");
    objects[0].clone()
}

/// The crossings of a line with an object, each with its material.
fn crossings(object: &Object, origin: [f64; 3], direction: [f64; 3]) -> Vec<(f64, u32)> {
    let ray = Ray {
        origin: origin.into(),
        direction: DVec3::from(direction).normalize(),
    };
    let mut spans = Spans::new();
    object.shape.spans(&ray, &mut spans);
    let ends = spans.iter().flat_map(|span| [span.enter, span.exit]);
    ends.map(|hit| (hit.t, object.material_at(hit))).collect()
}

/// A record, and lines as origin, direction and crossings.
type Case<'a> = (&'a str, &'a [([f64; 3], [f64; 3], &'a [f64])]);

#[test]
#[allow(clippy::too_many_lines, reason = "a table")]
fn shapes_are_where_their_records_place_them() {
    const HALF: f64 = std::f64::consts::FRAC_1_SQRT_2;
    let cases: &[Case] = &[
        (
            "obj sphere ID 0 mat ID 1  1 2 3  2",
            &[
                ([-9., 2., 3.], X, &[8., 12.]),
                ([1., -8., 3.], Y, &[8., 12.]),
                ([1., 2., -7.], Z, &[8., 12.]),
            ],
        ),
        (
            "obj ellipsoid ID 0 mat ID 1  1 2 3  1 2 4",
            &[
                ([-9., 2., 3.], X, &[9., 11.]),
                ([1., -8., 3.], Y, &[8., 12.]),
                ([1., 2., -7.], Z, &[6., 14.]),
                // At half the radius along z, the width along x is √¾ of the full one.
                (
                    [-9., 2., 5.],
                    X,
                    &[
                        10. - 1.5 * 0.577_350_269_189_625_8,
                        10. + 1.5 * 0.577_350_269_189_625_8,
                    ],
                ),
            ],
        ),
        // The axis extends from the middle both ways; the direction's length does not matter.
        (
            "obj cylinder ID 0 mat ID 1  1 2 3  0 0 1  2 6",
            &[
                ([1., 2., -7.], Z, &[7., 13.]),
                ([-9., 2., 5.9], X, &[8., 12.]),
                ([-9., 2., 6.1], X, &[]),
                ([-9., 2., 0.1], X, &[8., 12.]),
                ([-9., 2., -0.1], X, &[]),
            ],
        ),
        (
            "obj cylinder ID 0 mat ID 1  0 0 0  0 -1 0  1 4",
            &[
                ([0., -9., 0.], Y, &[7., 11.]),
                ([0.5, -9., 0.], Y, &[7., 11.]),
                ([0., 1.9, -9.], Z, &[8., 10.]),
                ([0., 2.1, -9.], Z, &[]),
            ],
        ),
        (
            "obj cylinder ID 0 mat ID 1  0 0 0  0.70710678118654752 0.70710678118654752 0  1 2",
            &[
                (
                    [-5., -5., 0.],
                    [1., 1., 0.],
                    &[10. * HALF - 1., 10. * HALF + 1.],
                ),
                (
                    [-5., 5., 0.],
                    [1., -1., 0.],
                    &[10. * HALF - 1., 10. * HALF + 1.],
                ),
            ],
        ),
        // Whole widths, centred.
        (
            "obj box ID 0 mat ID 1  1 2 3 AXES 2 4 6",
            &[
                ([-9., 2., 3.], X, &[9., 11.]),
                ([1., -8., 3.], Y, &[8., 12.]),
                ([1., 2., -7.], Z, &[7., 13.]),
            ],
        ),
        (
            "obj box ID 0 mat ID 1  0 0 0  0.6 0.8 0  -0.8 0.6 0  0 0 1  2 4 6",
            &[
                ([-6., -8., 0.], [0.6, 0.8, 0.], &[9., 11.]),
                ([8., -6., 0.], [-0.8, 0.6, 0.], &[8., 12.]),
                // Through the corners of the lower edge: x from −1/0.6 to 1/0.6.
                ([-9., 0., 0.], X, &[9. - 1. / 0.6, 9. + 1. / 0.6]),
            ],
        ),
        // x² + y² − z² ≤ 1, clipped at z = −1 and z = 2; a normal's length scales its distance.
        (
            "obj quadric ID 0 mat ID 1  1 0 0 0 1 0 0 -1 0 -1  2 0 0 2 4  0 0 -1 1",
            &[
                ([-9., 0., 0.], X, &[8., 10.]),
                ([0., 0., -9.], Z, &[8., 11.]),
                ([-9., 0., 2.1], X, &[]),
                ([-9., 0., -1.1], X, &[]),
            ],
        ),
        // Each coefficient once: B, C, F multiply 2xy, 2xz, 2yz; D, G, I multiply 2x, 2y, 2z.
        (
            "obj quadric ID 0 mat ID 1  1 0 0 -2 0 0 0 0 0 3  0",
            &[([0.; 3], X, &[1., 3.])],
        ),
        (
            "obj quadric ID 0 mat ID 1  0 0 0 0 1 0 -2 0 0 3  0",
            &[([0.; 3], Y, &[1., 3.])],
        ),
        (
            "obj quadric ID 0 mat ID 1  0 0 0 0 0 0 0 1 -2 3  0",
            &[([0.; 3], Z, &[1., 3.])],
        ),
        (
            "obj quadric ID 0 mat ID 1  1 1 0 0 0 0 0 0 0 -3  0",
            &[([0., 1., 0.], X, &[-3., 1.])],
        ),
        (
            "obj quadric ID 0 mat ID 1  1 0 1 0 0 0 0 0 0 -3  0",
            &[([0., 0., 1.], X, &[-3., 1.])],
        ),
        (
            "obj quadric ID 0 mat ID 1  0 0 0 0 1 1 0 0 0 -3  0",
            &[([0., 0., 1.], Y, &[-3., 1.])],
        ),
    ];
    for (record, lines) in cases {
        let object = solid(record);
        for (origin, direction, expected) in *lines {
            let found = crossings(&object, *origin, *direction);
            let near = |(found, expected): (&(f64, u32), &f64)| {
                (found.0 - expected).abs() < 1e-13 && found.1 == 1
            };
            assert!(
                found.len() == expected.len() && found.iter().zip(*expected).all(near),
                "{record} from {origin:?} to {direction:?}: {found:?} is not {expected:?}"
            );
        }
    }
}

/// A box of material 0 from x = −2 to 2 and a sphere of material 1 around x = 2.
#[test]
fn combined_solids_carry_the_material_of_the_surface() {
    for (operation, expected) in [
        ("union ID 0 ID 1", &[(8., 0), (13., 1)][..]),
        ("intersection ID 0 ID 1", &[(11., 1), (12., 0)]),
        ("difference ID 0 ID 1", &[(8., 0), (11., 1)]),
        ("difference ID 1 ID 0", &[(12., 0), (13., 1)]),
        ("difference ID 0 ID 0", &[]),
        ("union ID 1 ID 1", &[(11., 1), (13., 1)]),
    ] {
        let object = solid(&format!(
            "obj box ID 0 mat ID 0  0 0 0 AXES 4 4 4
            obj sphere ID 1 mat ID 1  2 0 0  1
            obj CSG ID 2 {operation}
            render 1 ID 2"
        ));
        let found = crossings(&object, [-10., 0., 0.], X);
        assert_eq!(found, expected, "{operation}");
    }
}

/// Operands may be combinations, and may be used more than once.
#[test]
fn combinations_nest() {
    // Spheres of radius 3 around 0, 4 and 8; the crossings of (A ∪ B) − (B ∩ C) along x.
    let object = solid(
        "obj sphere ID 0 mat ID 0  0 0 0  3
        obj sphere ID 1 mat ID 1  4 0 0  3
        obj sphere ID 2 mat ID 0  8 0 0  3
        obj CSG ID 3 union ID 0 ID 1
        obj CSG ID 4 intersection ID 1 ID 2
        obj CSG ID 5 difference ID 3 ID 4",
    );
    let found = crossings(&object, [-10., 0., 0.], X);
    assert_eq!(found, [(7., 0), (15., 0)]);
}
