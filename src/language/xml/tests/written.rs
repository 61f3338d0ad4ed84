//! Scenes written again.

use std::fmt::Write;

use super::read;
use crate::convert::without_gamma;
use crate::tests::{Random, rewritten};

/// A random scene of spheres and squares with all kinds of materials and lights.
fn text(random: &mut Random) -> String {
    let mut text = "<xml><scene>".to_owned();
    let number = |random: &mut Random| format!("{}.{:02}", random.below(9), 1 + random.below(99));
    // Writing to a string cannot fail.
    let mut add = |part: String| text.push_str(&part);
    for around in ["background", "environment"] {
        add(format!(
            "<{around} r='{}' texture='a&amp;b.png'/>",
            number(random)
        ));
    }
    for index in 0..=random.below(4) {
        let kind = random.pick(&["sphere", "plane"]);
        add(format!(
            "<object type='{kind}' name='{index}' material='m{}'>",
            random.below(4)
        ));
        match random.below(3) {
            0 => add(format!("<scale value='{}'/>", number(random))),
            1 => add(format!(
                "<scale x='{}' z='-{}'/>",
                number(random),
                number(random)
            )),
            _ => {}
        }
        add(format!(
            "<translate x='{}' z='-{}'/></object>",
            number(random),
            number(random)
        ));
    }
    for (index, kind) in ["blinn", "phong", "microfacet"].iter().enumerate() {
        add(format!("<material type='{kind}' name='m{index}'>"));
        let mut texture = String::new();
        if random.below(2) == 0 {
            let _ = write!(
                texture,
                "texture='checkerboard'><color1 r='{}'/",
                number(random)
            );
        }
        for word in [
            "diffuse",
            "color",
            "specular",
            "reflection",
            "refraction",
            "emission",
        ] {
            let is_known = (*kind == "microfacet") == (word == "color") || word == "emission";
            if is_known && random.below(2) == 0 {
                let end = if texture.is_empty() { "/" } else { "" };
                add(format!("<{word} g='{}' {texture}{end}>", number(random)));
                if !texture.is_empty() {
                    add(format!("</{word}>"));
                }
            }
        }
        add("</material>".to_owned());
    }
    add(format!(
        "<light type='ambient'><intensity b='{}'/></light>",
        number(random)
    ));
    add(format!(
        "<light type='direct'><intensity value='1'/><direction x='{}' y='-{}'/></light>",
        number(random),
        number(random)
    ));
    add(format!(
        "<light type='point'><intensity value='2'/><position z='{}'/><size value='{}'/>\
         <attenuation value='{}'/></light></scene>",
        number(random),
        number(random),
        number(random)
    ));
    let gamma = random.pick(&["", " gamma='sRGB'"]);
    add(format!(
        "<camera{gamma}><position z='{}'/><target y='-{}'/><dof value='{}'/></camera></xml>",
        number(random),
        number(random),
        number(random)
    ));
    text
}

#[test]
fn a_written_scene_gives_the_same_picture() {
    let mut random = Random(13);
    for _ in 0..500 {
        let text = text(&mut random);
        let (source, lowered) = read(&text);
        let scene = lowered.scene.expect("it has no errors");
        let (written, again, losses) = rewritten(&source, &scene);
        assert_eq!(*losses, [], "{text}\n\n{written}");
        assert!(again.objects == scene.objects, "{text}\n\n{written}");
        assert_eq!(again.lights, without_gamma(&scene).lights);
        assert_eq!(again.camera, scene.camera);
        assert_eq!(again.setting.rendering, scene.setting.rendering);
    }
}
