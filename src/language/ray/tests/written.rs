//! Scenes written again.

use super::properties::Model;
use super::read;
use crate::tests::{Random, rewritten};

#[test]
fn a_written_scene_is_the_same() {
    let mut random = Random(11);
    let mut checked = 0;
    while checked < 1_000 {
        let text = Model::random(&mut random).text(&mut random);
        let (source, lowered) = read(&text);
        let Some(scene) = lowered.scene else {
            // The random eye is at the random target.
            continue;
        };
        let (written, again, losses) = rewritten(&source, &scene);
        assert_eq!(*losses, [], "{text}\n\n{written}");
        assert_eq!(again, scene, "{text}\n\n{written}");
        checked += 1;
    }
}
