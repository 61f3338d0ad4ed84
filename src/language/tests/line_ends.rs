//! Line endings of any kind: scenes and the places of messages are the same.

use super::{read_as, shown};
use crate::Language;
use crate::tests::{Random, damage};
use scene::{Meshes, Scene};

const RAY: &str = "\
// \u{e9}
1 1 1 // ambient
1  0 5 5  1 1 1
\\\\ two
2
sphere 0 0 0 1  .1 .1 .1 .5 .5 .5 .2 .2 .2 5 0 0 1
Sphere 1 0 0 1  .1 .1 .1 .5 2 .5 .2 .2 .2 5 0 0 1
// view: eye 0 0 5 target 0 0 0
// view: eye 1
";

const DAT: &str = "\
# \u{e9}
camera perspective 0 0 5  0 0 0  0 1 0  1 0 100
resolution 0.01 0.01
viewport 80 60
light ID 1 amb 0 0 0  0 0 0  1 1 1  1 0 0 0 shadow_off

mat ID 0  1 1 1  0.1 0.8 0.1 5  0 0 1
// balls
obj sphere ID 1 mat ID 0  0 0 0  1
obj sphere ID 2 mat ID 0  1 0 0  1 surplus
  unknown 1
viewport 80 60
obj CSG ID 3 intersect ID 1 ID 2
render 0
";

const XML: &str = "\
<?xml version='1.0'?>
<xml>
  <!-- one
       two -->
  <scene>
    <object type='sphere' name='a'><scale
      value='2'/>
    </object>
    <object type='blob'/>
    <material name='m' type='blinn'><diffuse r='1' g='2'
      b='0'/></material>
  </scene>
  <camera><position z='5'/>
  <unknown/>
  </camera>
</xml>
";

/// The meaning and the diagnostics of a text.
fn read(language: Language, text: &str) -> (Option<Scene>, Vec<String>) {
    let (_, lowered) = read_as(language, text, &Meshes::default());
    let said = shown(text, &lowered);
    (lowered.scene, said)
}

fn check(language: Language, text: &str) -> Option<Scene> {
    let (scene, said) = read(language, text);
    for end in ["\r", "\r\n", "\r\r\n"] {
        let text = text.replace('\n', end);
        let (same, told) = read(language, &text);
        assert_eq!(said, told, "{text:?}");
        assert!(scene == same, "{text:?}");
    }
    scene
}

#[test]
fn line_ends_of_any_kind_mean_the_same() {
    let mut random = Random(17);
    let words = [
        "1", "x", "//", "\\\\", "#", "sphere", "<", "-->", "\n", "\n\nobj",
    ];
    for (language, text) in [
        (Language::Ray, RAY),
        (Language::Dat, DAT),
        (Language::Xml, XML),
    ] {
        assert!(check(language, text).is_some(), "{language:?}");
        for _ in 0..300 {
            let mut text = text.to_owned();
            for _ in 0..=random.below(3) {
                let lines = text.matches('\n').count();
                let leaves = read_as(language, &text, &Meshes::default()).0.leaves();
                damage(&mut text, &leaves, &words, &mut random);
                text = text.replace('\r', " ");
                // In an attribute of `.xml` each line end is a blank.
                if language == Language::Xml && lines < text.matches('\n').count() {
                    break;
                }
                check(language, &text);
            }
        }
    }
}
