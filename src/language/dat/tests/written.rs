//! Scenes written again.

use super::properties::records;
use super::read;
use crate::tests::{Random, rewritten};
use scene::{Material, Rgb, Scene};

/// A scene without what no picture shows: ambient reflectance where there is no ambient light.
fn shown(mut scene: Scene) -> Scene {
    if scene.ambient_light() == Rgb::ZERO {
        let dark = |material: &Material| Material {
            ambient: None,
            ..material.clone()
        };
        scene.materials = scene.materials.iter().map(dark).collect();
    }
    scene
}

#[test]
fn a_written_scene_is_the_same_where_nothing_is_lost() {
    let mut random = Random(12);
    let (mut checked, mut same) = (0, 0);
    while checked < 1_000 {
        let records = records(&mut random).into_iter().filter(|record| {
            let has = |word: &str| record.iter().any(|own| own == word);
            // What these were made of is not known; they are reported.
            !has("CSG") && !has("quadric") && !has("render")
        });
        let text: Vec<_> = records.map(|record| record.join(" ")).collect();
        let text = text.join("\n");
        let (source, lowered) = read(&text);
        let Some(scene) = lowered.scene else {
            continue;
        };
        let (written, again, losses) = rewritten(&source, &scene);
        // Each use has a texture of its own.
        if losses.is_empty() && scene.textures.is_empty() {
            assert_eq!(shown(again), shown(scene.clone()), "{text}\n\n{written}");
            same += 1;
        }
        checked += usize::from(scene.textures.is_empty());
    }
    assert!(900 < same, "{same} of {checked}");
}
