//! What is said of malformed texts, and of what is ignored.

use super::read;
use crate::tests::shown;

/// A sound beginning: a camera, a light, a sphere and three vertices of each pile.
const HEAD: &str = "size 8 6\ncamera 0 0 5 0 0 0 0 1 0 45\npoint 0 0 5 1 1 1\nsphere 0 0 0 1\n\
                    vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nvertexnormal 0 0 0 0 0 1\n\
                    vertexnormal 1 0 0 0 0 1\nvertexnormal 0 1 0 0 0 1\n";

/// Texts behind a beginning, with the findings of these texts: line, column, severity and how the
/// message begins.
#[rustfmt::skip]
const ROWS: &[(&str, &str, &[&str])] = &[
    ("sphere 0 0 0", HEAD, &["1:1 error: sphere: the line ends where radius is expected; 1 more token"]),
    ("  translate", HEAD, &["1:3 error: translate: the line ends where by x is expected; 3 more tokens"]),
    ("sphere 0 0 # 0 1", HEAD, &["1:1 error: sphere: the line ends where centre z is expected; 2 more tokens"]),
    ("point 0 0 5 1 1", HEAD, &["1:1 error: point: the line ends where colour blue is expected; 1 more token"]),
    ("output", HEAD, &["1:1 error: output: the line ends where file is expected; 1 more token"]),
    ("sphere 0 0 0 1 2 3", HEAD, &["1:16 warning: sphere: 2 tokens too many"]),
    ("popTransform now", HEAD, &["1:1 error: popTransform: there is no pushTransform left to undo", "1:14 warning: popTransform: 1 token too many"]),
    ("sphere 0 x 0 1", HEAD, &["1:10 error: sphere centre y: `x` is not a number"]),
    ("sphere 0 0 0 1,5", HEAD, &["1:14 error: sphere radius: `1,5` is not a number"]),
    ("ambient .1 0x10 .1", HEAD, &["1:12 error: ambient green: `0x10` is not a number"]),
    ("translate 0 nan 0", HEAD, &["1:13 error: translate by y: `nan` is not a number"]),
    ("diffuse 1 1 1e999", HEAD, &["1:13 error: diffuse blue: `1e999` is too large for any number"]),
    ("sphere 0 a b 1", HEAD, &["1:10 error: sphere centre y: `a` is not a number", "1:12 error: sphere centre z: `b` is not a number"]),
    ("sphere 0 0 0 .5f", HEAD, &["1:14 warning: sphere radius: the `f` at the end of `.5f` is ignored"]),
    ("sphere 0 0 0 1ff", HEAD, &["1:14 error: sphere radius: `1ff` is not a number"]),
    ("spehre 0 0 0 1", HEAD, &["1:1 warning: unknown command `spehre`: the line is skipped"]),
    ("// a note", HEAD, &["1:1 warning: unknown command `//`: the line is skipped"]),
    ("SPHERE 0 0 0 1", HEAD, &["1:1 warning: `SPHERE` should be `sphere`"]),
    ("pushtransform\npopTransform", HEAD, &["1:1 warning: `pushtransform` should be `pushTransform`"]),
    ("sphere 0 0 0 0", HEAD, &["1:14 error: sphere radius: must be greater than 0"]),
    ("sphere 0 0 0 -1", HEAD, &["1:14 error: sphere radius: must be greater than 0"]),
    ("popTransform", HEAD, &["1:1 error: popTransform: there is no pushTransform left to undo"]),
    ("pushTransform\npopTransform\npopTransform", HEAD, &["3:1 error: popTransform: there is no pushTransform left to undo"]),
    ("pushTransform", HEAD, &["1:1 note: pushTransform: is never undone by popTransform"]),
    ("pushTransform\npushTransform\npopTransform", HEAD, &["1:1 note: pushTransform: is never undone by popTransform"]),
    ("scale 1 0 1", HEAD, &["1:9 error: scale y: must not be 0"]),
    ("scale -1 1 1", HEAD, &[]),
    ("rotate 0 0 0 30", HEAD, &["1:8 error: rotate axis: must not be zero"]),
    ("rotate 0 0 9 370", HEAD, &[]),
    ("directional 0 0 0 1 1 1", HEAD, &["1:13 error: directional direction: must not be zero"]),
    ("shininess -5", HEAD, &["1:11 warning: shininess: -5 is not 0 or more"]),
    ("maxdepth -1", HEAD, &["1:10 note: maxdepth: -1 is read as 64"]),
    ("maxdepth -2", HEAD, &["1:10 error: maxdepth: must be a whole number from -1 to 4096"]),
    ("maxdepth 4097", HEAD, &["1:10 error: maxdepth: must be a whole number from -1 to 4096"]),
    ("maxdepth 4096", HEAD, &[]),
    ("maxdepth 2.0", HEAD, &["1:10 error: maxdepth: must be a whole number from -1 to 4096, not `2.0`"]),
    ("maxdepth 5f", HEAD, &["1:10 error: maxdepth: `5f` is not a number"]),
    ("size 0 10", HEAD, &["1:6 error: size width: must be a whole number, 1 or more"]),
    ("size 10 7.5", HEAD, &["1:9 error: size height: must be a whole number, 1 or more"]),
    ("size 4 4", HEAD, &[]),
    ("attenuation -1 0 0", HEAD, &[]),
    ("attenuation 1 0", HEAD, &["1:1 error: attenuation: the line ends where quadratic is expected; 1 more token"]),
    ("maxverts 2.5", HEAD, &["1:10 error: maxverts: must be a whole number"]),
    ("maxverts 999999999999", HEAD, &[]),
    ("tri 0 1 3", HEAD, &["1:9 error: tri: vertex 3 is not defined above"]),
    ("tri 0 1 3\nvertex 1 1 1", HEAD, &["1:9 error: tri: vertex 3 is not defined above"]),
    ("tri 3 1 4", HEAD, &["1:5 error: tri: vertex 3 is not defined above", "1:9 error: tri: vertex 4 is not defined above"]),
    ("tri 0 1 -1", HEAD, &["1:9 error: tri: must be a whole number, 0 or more, not `-1`"]),
    ("tri 0 1 2.0", HEAD, &["1:9 error: tri: must be a whole number, 0 or more, not `2.0`"]),
    ("vertex 1 1 0\ntrinormal 0 1 3", HEAD, &["2:15 error: trinormal: vertexnormal 3 is not defined above"]),
    ("tri 0 1 1", HEAD, &["1:1 warning: 1 triangle without area"]),
    ("tri 0 1 1\ntri 0 1 2\ntrinormal 2 2 0", HEAD, &["1:1 warning: 2 triangles without area"]),
    ("scale 1 1 1e-13\nrotate 1 0 0 45\nsphere 0 0 0 1", HEAD, &["3:8 error: sphere: its transforms flatten it or are too large or too small"]),
    ("scale 1 1 1e-13\nrotate 1 0 0 45", HEAD, &[]),
    ("integrator fast", HEAD, &["1:12 error: integrator: unknown word `fast`"]),
    ("spp 0", HEAD, &["1:5 error: spp: must be a whole number from 1 to 65536, not `0`"]),
    ("lightsamples 4\nlightstratify on\nbrdf ggx", HEAD, &["1:1 note: lightsamples: ignored, like all commands for sampling"]),
    ("quadLight 0 0 9 1 0 0 -2 0 0 1 1 1", HEAD, &["1:17 error: quadLight: its edges are parallel or zero"]),
    ("quadLight 0 0 9 0 0 0 1 0 0 1 1 1", HEAD, &["1:17 error: quadLight: its edges are parallel or zero"]),
    ("# render: depth x", HEAD, &["1:17 warning: render depth: `x` is not a number"]),
    ("# render: DEPTH 3", HEAD, &["1:11 warning: render: `DEPTH` is no key: the comment is ignored"]),
    ("# a comment with `x` and nan", HEAD, &[]),
    ("\t # sphere", HEAD, &[]),
    ("\tsphere\t0 0\tx 1", HEAD, &["1:13 error: sphere centre z: `x` is not a number"]),
    ("translate 0 0 0\rsphere 0 0 0 0", HEAD, &["2:14 error: sphere radius: must be greater than 0"]),
    ("sphere 0 0 0 0 # é", HEAD, &["1:14 error: sphere radius: must be greater than 0"]),
    ("é 1\nsphere 0 0 0 é", HEAD, &["1:1 warning: unknown command `é`: the line is skipped", "2:14 error: sphere radius: `é` is not a number"]),
    ("directional 0 0 1 1 1 1\nsphere 0 0 -5 1", "", &["1:1 warning: no `camera` command"]),
    ("camera 0 0 5 0 0 0 0 1 0 45\ncamera 0 0 9 0 0 0 0 1 0 30\ndirectional 0 0 1 1 1 1\nsphere 0 0 0 1", "", &["1:1 warning: camera: given again below"]),
    ("camera 0 0 5 0 0 5 0 1 0 45\ncamera 0 0 5 0 0 0 0 1 0 45\ndirectional 0 0 1 1 1 1\nsphere 0 0 0 1", "", &["1:1 warning: camera: given again below", "1:8 warning: view target: coincides with the eye"]),
    ("camera 0 0 5 0 0 0 0 1 0 45\ncamera 0 0 5 0 0 0 0 1 0\ndirectional 0 0 1 1 1 1\nsphere 0 0 0 1", "", &["1:1 warning: camera: given again below", "2:1 error: camera: the line ends where fov is expected; 1 more token"]),
    ("camera 0 0 5 0 0 5 0 1 0 45\ndirectional 0 0 1 1 1 1\nsphere 0 0 0 1", "", &["1:8 error: view target: coincides with the eye"]),
    ("camera 0 0 5 0 0 0 0 1 0 0\ndirectional 0 0 1 1 1 1\nsphere 0 0 0 1", "", &["1:26 error: camera fov: must be greater than 0 and less than 180"]),
    ("camera 0 0 5 0 0 0 0 1 0 180\ndirectional 0 0 1 1 1 1\nsphere 0 0 0 1", "", &["1:26 error: camera fov: must be greater than 0 and less than 180"]),
    ("camera 0 0 5 0 0 0 0 0 3 45\ndirectional 0 0 1 1 1 1\nsphere 0 0 0 1", "", &["1:20 warning: view up: is parallel to the direction of view"]),
    ("camera 0 0 5 0 0 0 0 1 0 45\nmaxverts 1\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\ndirectional 0 0 1 1 1 1\nsphere 0 0 0 1", "", &["2:10 warning: maxverts: declares 1, but there are 3"]),
    ("camera 0 0 5 0 0 0 0 1 0 45\nmaxvertnorms 0\nvertexnormal 0 0 0 0 0 1\nvertex 0 0 0\ndirectional 0 0 1 1 1 1\nsphere 0 0 0 1", "", &["2:14 warning: maxvertnorms: declares 0, but there are 1"]),
    ("", "", &["1:1 warning: no object is defined", "1:1 warning: no `camera` command"]),
];

#[test]
fn every_fault_is_said_at_its_word() {
    let mut wrong = Vec::new();
    for (own, head, expected) in ROWS {
        let text = format!("{head}{own}");
        let (_, lowered) = read(&text);
        let before = head.lines().count();
        let said = shown(&text, &lowered).into_iter().map(|said| {
            let (line, rest) = said.split_once(':').expect("a line and a column");
            let line: usize = line.parse().expect("a line");
            format!("{}:{rest}", line.saturating_sub(before))
        });
        let said: Vec<_> = said.collect();
        let is_said = said.len() == expected.len()
            && said
                .iter()
                .zip(*expected)
                .all(|(said, start)| said.starts_with(start));
        if !is_said {
            wrong.push(format!(
                "{own:?}\n  said     {said:?}\n  expected {expected:?}"
            ));
        }
        let errors = expected.iter().any(|line| line.contains(" error: "));
        if lowered.scene.is_none() != errors {
            wrong.push(format!(
                "{own:?}\n  has a scene: {}",
                lowered.scene.is_some()
            ));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
