//! Colours of `.test` scenes that are known on paper.

use std::f64::consts::FRAC_1_SQRT_2;

use super::pixels;

/// One pixel that looks along −z at the origin: a unit sphere there is hit at z = 1, where its normal
/// points at the eye.
const HEAD: &str = "size 1 1\ncamera 0 0 5 0 0 0 0 1 0 90\nambient 0 0 0";

/// Texts, a pixel, and its colour to four digits.
#[rustfmt::skip]
const ROWS: &[(&str, [usize; 2], [f64; 3])] = &[
    // ambient is .2 by default: no lights; the others are 0
    ("size 1 1\ncamera 0 0 5 0 0 0 0 1 0 90\nsphere 0 0 0 1", [0, 0], [0.2, 0.2, 0.2]),
    // ambient and emission are added as they are: .1 + .4, … ; not times diffuse
    ("HEAD\nambient .1 .2 .3\nemission .4 .4 .4\ndiffuse .5 .5 .5\nsphere 0 0 0 1", [0, 0], [0.5, 0.6, 0.7]),
    // a miss is black: nothing at x = 0
    ("HEAD\nambient 1 1 1\nsphere 9 0 0 1", [0, 0], [0.0, 0.0, 0.0]),
    // direction of any length: N·L = 1
    ("HEAD\ndiffuse .8 .8 .8\ndirectional 0 0 9 1 .5 .25\nsphere 0 0 0 1", [0, 0], [0.8, 0.4, 0.2]),
    // cosine, per channel: N·L = 4/5
    ("HEAD\ndiffuse 1 .5 0\ndirectional 3 0 4 1 1 1\nsphere 0 0 0 1", [0, 0], [0.8, 0.4, 0.0]),
    // highlight, not times N·L: H ∝ (0, .6, 1.8): (N·H)² = 3.24/3.6 = .9; the mirror shows black
    ("HEAD\nspecular .5 .5 .5\nshininess 2\ndirectional 0 3 4 1 1 1\nsphere 0 0 0 1", [0, 0], [0.45, 0.45, 0.45]),
    // shininess is an exponent: .5 · .9²
    ("HEAD\nspecular .5 .5 .5\nshininess 4\ndirectional 0 3 4 1 1 1\nsphere 0 0 0 1", [0, 0], [0.405, 0.405, 0.405]),
    // shininess is 1 by default: .5 · √.9
    ("HEAD\nspecular .5 .5 .5\ndirectional 0 3 4 1 1 1\nsphere 0 0 0 1", [0, 0], [0.4743, 0.4743, 0.4743]),
    // shininess 0: x⁰ = 1
    ("HEAD\nspecular .5 .5 .5\nshininess 0\ndirectional 0 3 4 1 1 1\nsphere 0 0 0 1", [0, 0], [0.5, 0.5, 0.5]),
    // shininess below 0 reads as 0: as C9
    ("HEAD\nspecular .5 .5 .5\nshininess -3\ndirectional 0 3 4 1 1 1\nsphere 0 0 0 1", [0, 0], [0.5, 0.5, 0.5]),
    // diffuse and highlight add up: .5 · .8 + .5 · .9
    ("HEAD\ndiffuse .5 .5 .5\nspecular .5 .5 .5\nshininess 2\ndirectional 0 3 4 1 1 1\nsphere 0 0 0 1", [0, 0], [0.85, 0.85, 0.85]),
    // a light behind the surface gives no highlight: N·L < 0
    ("HEAD\ndiffuse 1 1 1\nspecular 1 1 1\nshininess 0\ndirectional 0 3 -1 1 1 1\nsphere 0 0 0 1", [0, 0], [0.0, 0.0, 0.0]),
    // nor does one along it: N·L = 0, though N·H = √½
    ("HEAD\nspecular 1 1 1\nshininess 0\ndirectional 1 0 0 1 1 1\nsphere 0 0 0 1", [0, 0], [0.0, 0.0, 0.0]),
    // points do not fade by default: c = 1, l = q = 0
    ("HEAD\ndiffuse 1 1 1\npoint 0 0 3 1 1 1\nsphere 0 0 0 1", [0, 0], [1.0, 1.0, 1.0]),
    // c + l·d + q·d²: d = 2: 1/(1 + 4 + 12)
    ("HEAD\ndiffuse 1 1 1\nattenuation 1 2 3\npoint 0 0 3 1 1 1\nsphere 0 0 0 1", [0, 0], [0.0588, 0.0588, 0.0588]),
    // attenuation 0 0 0: the sum is ≤ 0: 1 stands in
    ("HEAD\ndiffuse 1 1 1\nattenuation 0 0 0\npoint 0 0 3 1 1 1\nsphere 0 0 0 1", [0, 0], [1.0, 1.0, 1.0]),
    // attenuation below 0 where it is used: 1 − 2 < 0
    ("HEAD\ndiffuse 1 1 1\nattenuation 1 -1 0\npoint 0 0 3 1 1 1\nsphere 0 0 0 1", [0, 0], [1.0, 1.0, 1.0]),
    // the last attenuation before a light counts for it: d = 2: 1/d and 1/d²
    ("HEAD\ndiffuse 1 1 1\nattenuation 0 1 0\npoint 0 0 3 1 0 0\nattenuation 0 0 1\npoint 0 0 3 0 1 0\nattenuation 9 9 9\nsphere 0 0 0 1", [0, 0], [0.5, 0.25, 0.0]),
    // directional lights do not fade: N·L = 1
    ("HEAD\ndiffuse 1 1 1\nattenuation 0 0 9\ndirectional 0 0 1 .5 .5 .5\nsphere 0 0 0 1", [0, 0], [0.5, 0.5, 0.5]),
    // d is in world units: light at z = 3, surface at 1: d = 2
    ("HEAD\ndiffuse 1 1 1\nscale 2 2 2\nattenuation 0 0 1\npoint 0 0 1.5 1 1 1\nsphere 0 0 0 .5", [0, 0], [0.25, 0.25, 0.25]),
    // points pass through the top at their line: light at z = 3: d = 2
    ("HEAD\ndiffuse 1 1 1\ntranslate 0 0 1\nattenuation 0 0 1\npoint 0 0 2 1 1 1\ntranslate 0 0 -1\nsphere 0 0 0 1", [0, 0], [0.25, 0.25, 0.25]),
    // directions without its translation: L = +z still
    ("HEAD\ndiffuse .6 .6 .6\ntranslate 0 0 -100\ndirectional 0 0 1 1 1 1\ntranslate 0 0 100\nsphere 0 0 0 1", [0, 0], [0.6, 0.6, 0.6]),
    // rotations are right-handed: about x, y goes to z
    ("HEAD\ndiffuse .6 .6 .6\nrotate 1 0 0 90\ndirectional 0 1 0 1 1 1\nsphere 0 0 0 1", [0, 0], [0.6, 0.6, 0.6]),
    // an axis of any length: x goes to −z, z to x, y stays: (4, 12, 3)/13
    ("HEAD\ndiffuse 1 1 1\nrotate 0 2 0 90\ndirectional -3 12 4 1 1 1\nsphere 0 0 0 1", [0, 0], [0.2308, 0.2308, 0.2308]),
    // a scale below 0 mirrors lights: L = +z
    ("HEAD\ndiffuse .7 .7 .7\nscale 1 1 -1\ndirectional 0 0 -1 1 1 1\nsphere 0 0 0 1", [0, 0], [0.7, 0.7, 0.7]),
    // the last transform acts first: centre z = 1, radius 2: top at 3, d = 2
    ("HEAD\ndiffuse 1 1 1\nattenuation 0 0 1\npoint 0 0 5 1 1 1\ntranslate 0 0 1\nscale 2 2 2\nsphere 0 0 0 1", [0, 0], [0.25, 0.25, 0.25]),
    // the other way round: centre z = 2, radius 2: top at 4, d = 4
    ("HEAD\ndiffuse 1 1 1\nattenuation 0 1 0\npoint 0 0 8 1 1 1\nscale 2 2 2\ntranslate 0 0 1\nsphere 0 0 0 1", [0, 0], [0.25, 0.25, 0.25]),
    // a pop restores: the sphere stands at 0
    ("HEAD\nemission .5 .5 .5\npushTransform\ntranslate 9 0 0\npopTransform\nsphere 0 0 0 1", [0, 0], [0.5, 0.5, 0.5]),
    // a push keeps the top: top at z = 2: 1/3²
    ("HEAD\ndiffuse 1 1 1\nattenuation 0 0 1\npoint 0 0 5 1 1 1\ntranslate 0 0 1\npushTransform\nsphere 0 0 0 1\npopTransform", [0, 0], [0.1111, 0.1111, 0.1111]),
    // a push left open changes nothing: emission
    ("HEAD\nemission .5 .5 .5\npushTransform\nsphere 0 0 0 1", [0, 0], [0.5, 0.5, 0.5]),
    // push and pop do not keep materials: the state line still holds
    ("HEAD\npushTransform\nemission .5 .25 .125\npopTransform\nsphere 0 0 0 1", [0, 0], [0.5, 0.25, 0.125]),
    // nor the attenuation: d = 2
    ("HEAD\ndiffuse 1 1 1\npushTransform\nattenuation 0 0 1\npopTransform\npoint 0 0 3 1 1 1\nsphere 0 0 0 1", [0, 0], [0.25, 0.25, 0.25]),
    // normals by the inverse transpose: N ∝ (1/4, 0, √3/2): N·L = √(12/13)
    ("size 1 1\ncamera 1 0 5 1 0 0 0 1 0 90\nambient 0 0 0\ndiffuse 1 1 1\ndirectional 0 0 1 1 1 1\nscale 2 1 1\nsphere 0 0 0 1", [0, 0], [0.9608, 0.9608, 0.9608]),
    // a triangle: N = +z
    ("HEAD\ndiffuse 1 1 1\ndirectional 0 3 4 1 1 1\nvertex -1 -1 0\nvertex 1 -1 0\nvertex 0 1 0\ntri 0 1 2", [0, 0], [0.8, 0.8, 0.8]),
    // both faces are shaded alike: N is turned against the ray
    ("HEAD\ndiffuse 1 1 1\ndirectional 0 3 4 1 1 1\nvertex -1 -1 0\nvertex 1 -1 0\nvertex 0 1 0\ntri 0 2 1", [0, 0], [0.8, 0.8, 0.8]),
    // a light on the other side gives nothing: N·L = −.8
    ("HEAD\ndiffuse 1 1 1\ndirectional 0 3 -4 1 1 1\nvertex -1 -1 0\nvertex 1 -1 0\nvertex 0 1 0\ntri 0 2 1", [0, 0], [0.0, 0.0, 0.0]),
    // the transform at a `vertex` does not count: the top is the identity again at `tri`
    ("HEAD\nemission 1 1 1\ntranslate 9 0 0\nvertex -1 -1 0\nvertex 1 -1 0\nvertex 0 1 0\ntranslate -9 0 0\ntri 0 1 2", [0, 0], [1.0, 1.0, 1.0]),
    // that at the `tri` does: the triangle is at x = 9
    ("HEAD\nemission 1 1 1\nvertex -1 -1 0\nvertex 1 -1 0\nvertex 0 1 0\ntranslate 9 0 0\ntri 0 1 2", [0, 0], [0.0, 0.0, 0.0]),
    // two piles, numbered from 0 each: `vertex` lines do not count
    ("HEAD\nemission 1 1 1\nvertex 9 9 0\nvertexnormal -1 -1 0 0 0 1\nvertexnormal 1 -1 0 0 0 1\nvertex 8 8 0\nvertexnormal 0 1 0 0 0 1\ntrinormal 0 1 2", [0, 0], [1.0, 1.0, 1.0]),
    // normals interpolated as written: weights ¼ ¼ ½: (0, 1.5, 2) ∝ (0, .6, .8)
    ("HEAD\ndiffuse 1 1 1\ndirectional 0 0 1 1 1 1\nvertexnormal -1 -1 0 0 0 4\nvertexnormal 1 -1 0 0 0 4\nvertexnormal 0 1 0 0 3 0\ntrinormal 0 1 2", [0, 0], [0.8, 0.8, 0.8]),
    // the front follows the normals' sum, whatever the winding: as C40
    ("HEAD\ndiffuse 1 1 1\ndirectional 0 0 1 1 1 1\nvertexnormal -1 -1 0 0 0 4\nvertexnormal 1 -1 0 0 0 4\nvertexnormal 0 1 0 0 3 0\ntrinormal 0 2 1", [0, 0], [0.8, 0.8, 0.8]),
    // the interpolated normal is negated on back hits: −(0, −1.5, −2)
    ("HEAD\ndiffuse 1 1 1\ndirectional 0 0 1 1 1 1\nvertexnormal -1 -1 0 0 0 -4\nvertexnormal 1 -1 0 0 0 -4\nvertexnormal 0 1 0 0 -3 0\ntrinormal 0 1 2", [0, 0], [0.8, 0.8, 0.8]),
    // interpolated first, then by the inverse transpose: (0, 1.5, 2/.5): 4/√18.25; the light's line stands before the scale
    ("HEAD\ndiffuse 1 1 1\ndirectional 0 0 1 1 1 1\nscale 1 1 .5\nvertexnormal -1 -1 0 0 0 4\nvertexnormal 1 -1 0 0 0 4\nvertexnormal 0 1 0 0 3 0\ntrinormal 0 1 2", [0, 0], [0.9363, 0.9363, 0.9363]),
    // where they sum to 0, the face's normal: ¼ + ¼ − ½ = 0; N = +z
    ("HEAD\ndiffuse 1 1 1\ndirectional 0 3 4 1 1 1\nvertexnormal -1 -1 0 0 0 1\nvertexnormal 1 -1 0 0 0 1\nvertexnormal 0 1 0 0 0 -1\ntrinormal 0 1 2", [0, 0], [0.8, 0.8, 0.8]),
    // an interpolated normal that looks away is used as it is: sum (0, 3, 2): a front hit; n = (0, 1.5, −1.5), N·L = √½
    ("HEAD\ndiffuse 1 1 1\ndirectional 0 1 0 1 1 1\nvertexnormal -1 -1 0 0 0 5\nvertexnormal 1 -1 0 0 0 5\nvertexnormal 0 1 0 0 3 -8\ntrinormal 0 1 2", [0, 0], [FRAC_1_SQRT_2, FRAC_1_SQRT_2, FRAC_1_SQRT_2]),
    // mirroring turns no triangle inside out: (0, 1.5, −2) becomes (0, 1.5, 2), a front hit
    ("HEAD\ndiffuse 1 1 1\ndirectional 0 0 1 1 1 1\nscale 1 1 -1\nvertexnormal -1 -1 0 0 0 -4\nvertexnormal 1 -1 0 0 0 -4\nvertexnormal 0 1 0 0 3 0\ntrinormal 0 1 2", [0, 0], [0.8, 0.8, 0.8]),
    // nor a sphere: N = +z
    ("HEAD\ndiffuse 1 1 1\ndirectional 0 3 4 1 1 1\nscale -1 -1 -1\nsphere 0 0 0 1", [0, 0], [0.8, 0.8, 0.8]),
    // objects block: (0, 0, 1) + 5 (0, .6, .8) is the other's centre
    ("HEAD\ndiffuse 1 1 1\ndirectional 0 3 4 1 1 1\nsphere 0 0 0 1\nsphere 0 3 5 1", [0, 0], [0.0, 0.0, 0.0]),
    // what is beyond a point light does not: N·L = .8, d = 5; the other is at 9 … 11
    ("HEAD\ndiffuse 1 1 1\npoint 0 3 5 1 1 1\nsphere 0 0 0 1\nsphere 0 6 9 1", [0, 0], [0.8, 0.8, 0.8]),
    // nor what the light lies on: the light is on the other's surface: the segment is open
    ("HEAD\ndiffuse 1 1 1\npoint 0 3 5 1 1 1\nsphere 0 0 0 1\nsphere 0 3.6 5.8 1", [0, 0], [0.8, 0.8, 0.8]),
    // a mirror: .5 ⊙ emission of what is behind the eye
    ("HEAD\nspecular .5 .5 .5\nvertex -9 -9 0\nvertex 9 -9 0\nvertex 0 9 0\ntri 0 1 2\nspecular 0 0 0\nemission .8 .4 .2\nsphere 0 0 9 1", [0, 0], [0.4, 0.2, 0.1]),
    // a mirror of one colour: specular ≠ 0 in one channel
    ("HEAD\nspecular .5 0 0\nvertex -9 -9 0\nvertex 9 -9 0\nvertex 0 9 0\ntri 0 1 2\nspecular 0 0 0\nemission .8 .4 .2\nsphere 0 0 9 1", [0, 0], [0.4, 0.0, 0.0]),
    // maxdepth 0: no mirrors: a ray of bounce 1 is black
    ("HEAD\nmaxdepth 0\nspecular .5 .5 .5\nvertex -9 -9 0\nvertex 9 -9 0\nvertex 0 9 0\ntri 0 1 2\nspecular 0 0 0\nemission .8 .4 .2\nsphere 0 0 9 1", [0, 0], [0.0, 0.0, 0.0]),
    // maxdepth counts bounces: .2 (1 + ½ + ¼)
    ("HEAD\nmaxdepth 2\nambient .2 .2 .2\nspecular .5 .5 .5\nvertex -9 -9 0\nvertex 9 -9 0\nvertex 0 9 0\ntri 0 1 2\ntranslate 0 0 9\ntri 0 1 2", [0, 0], [0.35, 0.35, 0.35]),
    // it is 5 by default: .2 (1 − 2⁻⁶)/(1 − ½)
    ("HEAD\nambient .2 .2 .2\nspecular .5 .5 .5\nvertex -9 -9 0\nvertex 9 -9 0\nvertex 0 9 0\ntri 0 1 2\ntranslate 0 0 9\ntri 0 1 2", [0, 0], [0.3937, 0.3937, 0.3937]),
    // −1 is 64: .4 (1 − 2⁻⁶⁵)
    ("HEAD\nmaxdepth -1\nambient .2 .2 .2\nspecular .5 .5 .5\nvertex -9 -9 0\nvertex 9 -9 0\nvertex 0 9 0\ntri 0 1 2\ntranslate 0 0 9\ntri 0 1 2", [0, 0], [0.4, 0.4, 0.4]),
    // highlights of secondary rays have their own V: the mirror at 45° sends the ray along +x; N = V = −x, L = (−.8, 0, .6): .5 · .9
    ("HEAD\ndirectional -4 0 3 1 1 1\nspecular 1 1 1\nvertex -4 -4 4\nvertex 4 -4 -4\nvertex 0 4 0\ntri 0 1 2\nspecular .5 .5 .5\nshininess 2\nsphere 5 0 0 1", [0, 0], [0.45, 0.45, 0.45]),
    // columns to the right, fov vertical, W/H: x = 1 · 3 · (5/3 − 1) = 2: below the light, d = 3
    ("size 3 1\ncamera 0 0 1 0 0 0 0 1 0 90\nambient 0 0 0\ndiffuse 1 1 1\nattenuation 0 1 0\npoint 2 0 3 1 1 1\nvertex -99 -99 0\nvertex 99 -99 0\nvertex 0 99 0\ntri 0 1 2", [2, 0], [0.3333, 0.3333, 0.3333]),
    // rows downwards: y = 3 (1 − 1/3) = 2, d = 4
    ("size 1 3\ncamera 0 0 3 0 0 0 0 1 0 90\nambient 0 0 0\ndiffuse 1 1 1\nattenuation 0 1 0\npoint 0 2 4 1 1 1\nvertex -99 -99 0\nvertex 99 -99 0\nvertex 0 99 0\ntri 0 1 2", [0, 0], [0.25, 0.25, 0.25]),
    // a later size replaces an earlier one: as C58
    ("size 9 9\ncamera 0 0 1 0 0 0 0 1 0 90\nsize 3 1\nambient 0 0 0\ndiffuse 1 1 1\nattenuation 0 1 0\npoint 2 0 3 1 1 1\nvertex -99 -99 0\nvertex 99 -99 0\nvertex 0 99 0\ntri 0 1 2", [2, 0], [0.3333, 0.3333, 0.3333]),
    // the last camera counts: HEAD's camera sees the sphere
    ("camera 0 0 5 0 9 0 0 1 0 30\nHEAD\nemission .5 .5 .5\nsphere 0 0 0 1", [0, 0], [0.5, 0.5, 0.5]),
    // defaults of size, eye, target, up and fov: d² = 1 + tan²22.5° ((4/3 · 639/640)² + (479/480)²); N·L / d² = d⁻³
    ("ambient 0 0 0\ndiffuse 1 1 1\nattenuation 0 0 1\npoint 0 0 0 1 1 1\nvertex -9 -9 -1\nvertex 9 -9 -1\nvertex 0 9 -1\ntri 0 1 2", [639, 0], [0.5583, 0.5583, 0.5583]),
    // up along the view: x stands in: n = −z; x and y tie, x comes first: up in the picture is +x
    ("size 1 3\ncamera 0 0 3 0 0 0 0 0 1 90\nambient 0 0 0\ndiffuse 1 1 1\nattenuation 0 1 0\npoint 2 0 4 1 1 1\nvertex -99 -99 0\nvertex 99 -99 0\nvertex 0 99 0\ntri 0 1 2", [0, 0], [0.25, 0.25, 0.25]),
    // up need not be unit or at a right angle: as C59
    ("size 1 3\ncamera 0 0 3 0 0 0 0 5 5 90\nambient 0 0 0\ndiffuse 1 1 1\nattenuation 0 1 0\npoint 0 2 4 1 1 1\nvertex -99 -99 0\nvertex 99 -99 0\nvertex 0 99 0\ntri 0 1 2", [0, 0], [0.25, 0.25, 0.25]),
    // comments, blank lines and tabs: a word that begins with # ends the arguments
    ("HEAD\n\t# emission 1 1 1 \n\n\t \nemission\t.5\t.25\t0 # 1 1\nsphere 0 0 0 1 #x y", [0, 0], [0.5, 0.25, 0.0]),
    // CR LF, CR CR LF and CR end lines: emission
    ("HEAD\remission .5 .5 .5\r\r\nsphere 0 0 0 1\r\n# the end\r", [0, 0], [0.5, 0.5, 0.5]),
    // numbers without all their digits: emission
    ("HEAD\nemission 1. .5 +1e-1\nsphere -0 0. 0e5 1", [0, 0], [1.0, 0.5, 0.1]),
    // a trailing f is read over: emission
    ("HEAD\nemission .5f .25F 0\nsphere 0 0 0 1f", [0, 0], [0.5, 0.25, 0.0]),
    // commands in other case are read: emission
    ("HEAD\nEMISSION .5 .5 .5\nSphere 0 0 0 1", [0, 0], [0.5, 0.5, 0.5]),
    // unknown commands are skipped: emission
    ("HEAD\nemission .5 .5 .5\nemision 1 1 1\nsphere 0 0 0 1", [0, 0], [0.5, 0.5, 0.5]),
    // a state line after a primitive does not reach it: emission
    ("HEAD\nemission .5 .5 .5\nsphere 0 0 0 1\nemission 1 1 1", [0, 0], [0.5, 0.5, 0.5]),
    // a light after a primitive does: N·L = 1
    ("HEAD\ndiffuse 1 1 1\nsphere 0 0 0 1\ndirectional 0 0 1 .5 .5 .5", [0, 0], [0.5, 0.5, 0.5]),
    // of equal hits the first of the text wins: both at t = 4
    ("HEAD\nemission 1 0 0\nsphere 0 0 0 1\nemission 0 1 0\nsphere 0 0 0 1", [0, 0], [1.0, 0.0, 0.0]),
    // equal up to 64 units in the last place: 1e-14 nearer; 64 ulp(5) = 5.7e-14
    ("HEAD\nemission 1 0 0\nsphere 0 0 0 1\nemission 0 1 0\nsphere 0 0 0 1.00000000000001", [0, 0], [1.0, 0.0, 0.0]),
    // the nearest wins beyond that: 1e-13 nearer
    ("HEAD\nemission 1 0 0\nsphere 0 0 0 1\nemission 0 1 0\nsphere 0 0 0 1.0000000000001", [0, 0], [0.0, 1.0, 0.0]),
    // inside a sphere: N is turned inwards; d = 2
    ("size 1 1\ncamera 0 0 0 0 0 -1 0 1 0 90\nambient 0 0 0\ndiffuse 1 1 1\nattenuation 0 0 1\npoint 0 0 0 1 1 1\nsphere 0 0 0 2", [0, 0], [0.25, 0.25, 0.25]),
    // a light within, seen from outside: N·L = −1
    ("HEAD\ndiffuse 1 1 1\npoint 0 0 0 1 1 1\nsphere 0 0 0 1", [0, 0], [0.0, 0.0, 0.0]),
    // colours are not clamped: emission + 2
    ("HEAD\nemission 3 2 1.5\ndiffuse 1 1 1\ndirectional 0 0 1 2 2 2\nsphere 0 0 0 1", [0, 0], [5.0, 4.0, 3.5]),
    // a triangle without area is left out: the corners are on a line through (0, 0, 0)
    ("HEAD\nemission 1 1 1\nvertex -1 0 0\nvertex 1 0 0\nvertex 0 0 0\ntri 0 1 2", [0, 0], [0.0, 0.0, 0.0]),
    // a quadLight's front: e2 × e1 = (2,0,0) × (0,2,0) = 4z, towards the eye
    ("HEAD\nquadLight -1 -1 0 0 2 0 2 0 0 .9 .5 .2", [0, 0], [0.9, 0.5, 0.2]),
    // its back is black: e2 × e1 = −4z
    ("HEAD\nquadLight -1 -1 0 2 0 0 0 2 0 .9 .5 .2", [0, 0], [0.0, 0.0, 0.0]),
    // and opaque: it stands before the sphere
    ("HEAD\nemission 1 1 1\nsphere 0 0 0 1\nquadLight -1 -1 2 2 0 0 0 2 0 .9 .5 .2", [0, 0], [0.0, 0.0, 0.0]),
    // its front is decided in the world: M e2 × M e1 = (−2,0,0) × (0,2,0) = −4z
    ("HEAD\nscale -1 1 1\nquadLight -1 -1 0 0 2 0 2 0 0 .9 .5 .2", [0, 0], [0.0, 0.0, 0.0]),
    // it has no other material: only its radiance
    ("HEAD\nambient .3 .3 .3\ndiffuse 1 1 1\ndirectional 0 0 1 1 1 1\nquadLight -1 -1 0 0 2 0 2 0 0 .9 .5 .2", [0, 0], [0.9, 0.5, 0.2]),
    // by Whitted rays it lights nothing: no light in the sum
    ("HEAD\ndiffuse 1 1 1\nsphere 0 0 0 1\nquadLight -1 3 -1 0 0 2 2 0 0 9 9 9", [0, 0], [0.0, 0.0, 0.0]),
    // it blocks light from one side: the segment crosses z = 5 at (0, 3)
    ("HEAD\ndiffuse 1 1 1\ndirectional 0 3 4 1 1 1\nsphere 0 0 0 1\nquadLight -1 2 5 2 0 0 0 2 0 1 1 1", [0, 0], [0.0, 0.0, 0.0]),
    // and from the other: as C86
    ("HEAD\ndiffuse 1 1 1\ndirectional 0 3 4 1 1 1\nsphere 0 0 0 1\nquadLight -1 2 5 0 2 0 2 0 0 1 1 1", [0, 0], [0.0, 0.0, 0.0]),
    // mirrors show it: e2 × e1 = −4z, towards the mirror
    ("HEAD\nspecular .5 .5 .5\nsphere 0 0 0 1\nquadLight -1 -1 8 2 0 0 0 2 0 .8 .4 .2", [0, 0], [0.4, 0.2, 0.1]),
];

#[test]
fn colours_are_those_known_on_paper() {
    let mut wrong = Vec::new();
    for (text, [x, y], expected) in ROWS {
        let text = text.replace("HEAD", HEAD);
        let (width, pixels) = pixels(&text, &text);
        let found = pixels[y * width + x];
        let level = expected.map(|part| 255.0 * part.clamp(0.0, 1.0));
        // Half a level, and what the digits left out may add.
        let is_near = found
            .iter()
            .zip(level)
            .all(|(&a, b)| (f64::from(a) - b).abs() <= 0.52);
        if !is_near {
            wrong.push(format!("{text:?}\n  {found:?} instead of {level:?}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
