//! Demanding texts: extreme numbers, long chains, many errors. Memory or time that grows faster
//! than the text would fail these tests.

use glam::DVec3;

use super::{read, spelled};
use crate::tests::shown;
use geometry::Spans;
use scene::Lens;

#[test]
fn at_most_a_hundred_errors_are_reported() {
    let objects = "obj sphere ID 1 mat ID 0 0 0 0 x\n".repeat(1000);
    let text = spelled(&format!("VIEW\nmat ID 0 MAT\n{objects}"));
    let (_, lowered) = read(&text);
    assert_eq!(lowered.diagnostics.errors(), 1000);
    assert!(lowered.diagnostics.len() <= 200);
}

#[test]
fn many_unknown_references_are_fast() {
    let mut text = vec![spelled("VIEW\n")];
    for id in 0..60_000 {
        text.push(spelled(&format!(
            "mat ID {id} MAT\nobj sphere ID {id} mat ID -1 0 0 0 1\n"
        )));
    }
    let (_, lowered) = read(&text.concat());
    assert_eq!(lowered.diagnostics.errors(), 60_000);
}

#[test]
fn many_repetitions_are_fast() {
    let mut text = vec![spelled("VIEW\ntexture ID 0 checker 1 1 1 1 1 0 0 0\n")];
    for id in 0..40_000 {
        text.push(spelled(&format!(
            "mat ID {id} MAT\nuse colour ID 0 mat ID {id}\n"
        )));
    }
    for id in 0..40_000 {
        text.push(format!("viewport 80 60\nuse colour ID 0 mat ID {id}\n"));
    }
    let (_, lowered) = read(&text.concat());
    assert_eq!(lowered.diagnostics.errors(), 0);
    // No object is defined.
    assert_eq!(lowered.diagnostics.warnings(), 80_001);
}

#[test]
fn declared_counts_allocate_nothing() {
    for record in [
        "render 9223372036854775807 ID 0",
        "obj quadric ID 1 mat ID 0 1 0 0 0 1 0 0 1 0 -1 9223372036854775807",
    ] {
        let text = spelled(&format!(
            "VIEW\nmat ID 0 MAT\nobj sphere ID 0 BALL 1\n{record}"
        ));
        let (_, lowered) = read(&text);
        assert_eq!(lowered.diagnostics.errors(), 1, "{record}");
    }
}

/// A chain of unions, each with one more sphere, far deeper than the stack.
#[test]
fn a_long_chain_is_a_single_solid() {
    let mut text = vec![spelled("VIEW\nmat ID 0 MAT\nobj sphere ID 0 BALL 1\n")];
    for link in 1..=50_000 {
        let (ball, made, before) = (2 * link - 1, 2 * link, 2 * link - 2);
        text.push(format!(
            "obj sphere ID {ball} mat ID 0 0 {} 0 1\nobj CSG ID {made} union ID {before} ID {ball}\n",
            3 * link
        ));
    }
    let scene = super::scene(&text.concat());
    assert_eq!(scene.objects.len(), 1);
    let ray = geometry::Ray {
        origin: DVec3::new(-9.0, 0.0, 0.0),
        direction: DVec3::X,
    };
    let mut spans = Spans::new();
    scene.objects[0].shape.spans(&ray, &mut spans);
    let ends: Vec<_> = spans
        .iter()
        .map(|span| (span.enter.t, span.exit.t))
        .collect();
    assert_eq!(ends, [(8.0, 10.0)]);
}

/// An object combined with itself forty times has 2⁴⁰ leaves if expanded, one if shared.
#[test]
fn a_solid_used_twice_is_stored_once() {
    let mut text = vec![spelled("VIEW\nmat ID 0 MAT\nobj sphere ID 0 BALL 1\n")];
    for link in 0..40 {
        text.push(format!(
            "obj CSG ID {} union ID {link} ID {link}\n",
            link + 1
        ));
    }
    assert_eq!(super::scene(&text.concat()).objects.len(), 1);
}

/// Each drawn link of a chain copies all links before it: their sum is limited.
#[test]
fn the_parts_of_all_drawn_objects_are_limited() {
    const LINKS: usize = 2_000;
    let mut text = vec![spelled("VIEW\nmat ID 0 MAT\nobj sphere ID 0 BALL 1\n")];
    let mut render = vec![format!("render {LINKS}")];
    for link in 1..=LINKS {
        text.push(format!("obj CSG ID {link} union ID {} ID 0\n", link - 1));
        render.push(format!("ID {link}"));
    }
    text.push(render.join(" "));
    let (_, lowered) = read(&text.concat());
    let said = shown(&text.concat(), &lowered);
    assert!(
        said.len() == 1 && said[0].contains("too many parts"),
        "{said:?}"
    );
    assert!(lowered.scene.is_none());
}

/// Any numbers in a view give a usable view or an error.
#[test]
fn extreme_views_are_usable_or_errors() {
    let numbers = ["5e-324", "1e-300", "1e-12", "1", "1e12", "1e300", "1.7e308"];
    let mut errors = 0;
    for kind in ["perspective", "orthographic"] {
        for focal in numbers {
            for across in numbers {
                for up in numbers {
                    let text = format!(
                        "camera {kind} 0 0 5 0 0 0 0 1 0 {focal} 0 1e30\nresolution {across} {up}\nviewport 80 60\n"
                    );
                    let (_, lowered) = read(&text);
                    let Some(scene) = lowered.scene else {
                        errors += 1;
                        continue;
                    };
                    let camera = scene.camera;
                    let lens_is_one = match camera.lens {
                        Lens::Perspective(angle) => 0.0 < angle && angle < 180.0,
                        Lens::Orthographic(height) => 0.0 < height && height.is_finite(),
                    };
                    let aspect = camera.pixel_aspect;
                    assert!(
                        lens_is_one && 0.0 < aspect && aspect.is_finite(),
                        "{text}: {camera:?}"
                    );
                }
            }
        }
    }
    assert!(0 < errors && errors < 500, "{errors} errors");
}

#[test]
fn extreme_solids_are_usable_or_errors() {
    for number in ["5e-324", "1e-300", "1e-160", "1e160", "1e300", "1.7e308"] {
        for record in [
            "obj sphere ID 0 mat ID 0 N N N N",
            "obj ellipsoid ID 0 mat ID 0 N N N N N N",
            "obj cylinder ID 0 mat ID 0 N N N N N N N N",
            "obj box ID 0 mat ID 0 N N N  N 0 0  0 N 0  0 0 N  N N N",
            "obj quadric ID 0 mat ID 0 N 0 0 N N N 0 N 0 -N 1 N N N N",
        ] {
            let text = spelled(&format!("VIEW\nmat ID 0 MAT\n{record}")).replace('N', number);
            let (_, lowered) = read(&text);
            if let Some(scene) = lowered.scene {
                let bounds = scene.objects[0].shape.bounds();
                assert!(!bounds.min.is_nan() && !bounds.max.is_nan(), "{text}");
            }
        }
    }
}
