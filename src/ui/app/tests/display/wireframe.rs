//! The wireframe: when it is shown, what is traced meanwhile, and that it follows.

use super::scripts::{scene, scripts};
use super::symbols::{DAT, RAY, XML};
use render::WireLine;

const SCENES: [(&str, &str); 3] = [("a.ray", RAY), ("a.dat", DAT), ("a.xml", XML)];

scripts! {
    the_wireframe_replaces_the_preview_until_another_view_is_chosen: for (name, text) in SCENES {
        scene(name, text).play(r"
            | not errors | not wires
            6     | does trace preview | job aov object spp 1 | wires
            // It is shown already.
            6     | not does | wires
            // What is traced at full size, or exported, is light.
            <F5>  | does recall | job aov none | not wires
            <Esc> | wires
            2     | does trace preview | job aov depth | not wires
            | text opened
        ");
    };

    the_wireframe_follows_the_camera_and_the_text_at_once: for (name, text) in SCENES {
        scene(name, text).play(r"
            [object 1] 6
            @note before wires
            v        | wires {before}
            l        | not wires {before}
            @note turned wires
            <Esc>mx1 | not wires {turned}
            <Esc>    | wires {turned}
            v0       | not wires {turned}
        ");
    };

    the_edges_of_a_unit_cube_are_at_known_pixels: {
        let cube = "sphere -2 0 0 1  0 => box 0 0 0  1 0 0  0 1 0  0 0 1  1 1 1  0";
        let mut session = scene("a.ray", RAY).but(cube).session();
        session.run("6");
        let shared = &session.app.shared;
        let (_, size) = shared.raster().expect("there is room");
        let lines = shared.wireframe().and_then(|wireframe| wireframe.lines(size));
        let lines = &lines.expect("it is shown").lines;
        assert_eq!(lines.len(), 12);
        // At the origin the picture is 2 · 10 · tan 30° high.
        let unit = f64::from(size.height) / (20.0 * (30.0_f64).to_radians().tan());
        let middle = [f64::from(size.width), f64::from(size.height)].map(|side| side / 2.0);
        let expected = [middle, [middle[0], middle[1] - unit]];
        let is_near = |line: &WireLine| {
            let pairs = line.ends.as_flattened().iter().zip(expected.as_flattened());
            pairs.into_iter().all(|(is, want)| (is - want).abs() < 0.05)
        };
        assert!(lines.iter().any(is_near), "{expected:?} in {lines:?}");
    };
}
