//! Random scenes of every language.

use std::fmt::Write;
use std::path::Path;

use halflight::language::Language;

use super::convert;

/// The number of random scenes of each language.
const SCENES: u64 = 25;

/// The number of them that every other language can hold, at least: half of them are plain.
const LEAST_LOSSLESS: u64 = 8;

#[test]
fn random_scenes_that_lose_nothing_look_the_same() {
    for language in Language::ALL {
        let mut lossless = [0; Language::ALL.len()];
        for number in 0..SCENES {
            let mut random = Random((1 + number).wrapping_mul(0x9E37_79B9_7F4A_7C15));
            let text = match language {
                Language::Ray => random.ray(),
                Language::Dat => random.dat(),
                Language::Xml => random.xml(),
                Language::Cse167 => random.cse167(),
            };
            let name = format!("random{number}.{}", language.extension());
            for (to, losses) in convert(Path::new(&name), &text) {
                lossless[to as usize] += u64::from(losses.is_empty());
            }
        }
        for to in Language::ALL.into_iter().filter(|to| *to != language) {
            let count = lossless[to as usize];
            assert!(
                LEAST_LOSSLESS <= count,
                "{language:?} to {to:?}: {count} of {SCENES}"
            );
        }
    }
}

/// Numbers that depend only on the seed, by xorshift (Marsaglia 2003).
struct Random(u64);

impl Random {
    fn below(&mut self, count: u64) -> u64 {
        for _ in 0..2 {
            self.0 ^= self.0 << 13;
            self.0 ^= self.0 >> 7;
            self.0 ^= self.0 << 17;
        }
        (self.0 >> 11) % count
    }

    /// A number of up to three decimals.
    fn number(&mut self, least: i32, most: i32) -> f64 {
        let steps = self.below(1000 * (most - least) as u64 + 1);
        f64::from(1000 * least + steps as i32) / 1000.0
    }

    fn point(&mut self, half: i32) -> [f64; 3] {
        [(); 3].map(|()| self.number(-half, half))
    }

    fn colour(&mut self) -> [f64; 3] {
        [(); 3].map(|()| self.number(0, 1))
    }

    /// Whether the scene keeps to what all languages have: matte balls, and lights that do not fade.
    fn is_plain(&mut self) -> bool {
        self.below(2) == 0
    }

    /// Radii of a sphere, or semi-axes along x, y and z.
    fn radii(&mut self) -> [f64; 3] {
        let mut radius = || (100.0 + self.below(2000) as f64) / 1000.0;
        let radii = [radius(), radius(), radius()];
        match self.below(2) {
            0 => [radii[0]; 3],
            _ => radii,
        }
    }

    fn ray(&mut self) -> String {
        let is_plain = self.is_plain();
        let mut text = vec![format!(
            "// view: eye {} target {} up 0 1 0 fov {} size {} {}\n",
            words(self.eye()),
            words(self.point(1)),
            self.number(20, 80),
            16 + self.below(40),
            16 + self.below(30),
        )];
        let lights = 1 + self.below(3);
        text.push(format!("{}\n{lights}\n", words(self.colour())));
        for _ in 0..lights {
            text.push(format!(
                "{} {}\n",
                words(self.point(9)),
                words(self.colour())
            ));
        }
        let objects = 1 + self.below(5);
        text.push(format!("{objects}\n"));
        for _ in 0..objects {
            let (point, radii) = (words(self.point(2)), self.radii());
            let axes = "1 0 0 0 1 0 0 0 1";
            let kinds = ["ellipsoid", "box", "cylinder", "cone"];
            let kind = kinds[if is_plain { 0 } else { self.below(4) as usize }];
            text.push(match radii {
                [a, b, _] if a == b && is_plain => format!("sphere {point} {a} "),
                _ => format!("{kind} {point} {axes} {} ", words(radii)),
            });
            let (own, exponent) = (words(self.colour()), self.number(1, 60));
            text.push(if is_plain {
                format!("{own} {own} 0 0 0 1 0 0 1\n")
            } else {
                let [ambient, diffuse, specular] = [(); 3].map(|()| words(self.colour()));
                let [kr, kt] = [self.number(0, 1), self.number(0, 1)].map(|k| k / 2.0);
                format!("{own} {diffuse} {specular} {exponent} {kr} {kt} 1.5 // {ambient}\n")
            });
        }
        text.concat()
    }

    fn dat(&mut self) -> String {
        let is_plain = self.is_plain();
        let mut text = vec![format!(
            "camera perspective {} {} 0 0 1  1 0 100\nresolution 0.02 0.02\nviewport {} {}\n",
            words(self.eye()),
            words(self.point(1)),
            16 + self.below(40),
            16 + self.below(30),
        )];
        let ambient = words(self.colour());
        text.push(format!(
            "light ID 0 amb 0 0 0 0 0 0 {ambient} 1 0 0 0 shadow_off\n"
        ));
        for id in 1..=1 + self.below(3) {
            let (point, colour) = (words(self.point(9)), words(self.colour()));
            let fades = if is_plain { "1 0 0" } else { "1 0 0.01" };
            text.push(format!(
                "light ID {id} pnt {point} 0 0 0 {colour} {fades} 0 shadow_on\n"
            ));
        }
        for id in 1..=1 + self.below(5) {
            let (colour, share) = (words(self.colour()), self.number(0, 1));
            let shine = if is_plain {
                "0 1 0 0 1"
            } else {
                "0.3 20 0.2 0.1 1.4"
            };
            text.push(format!("mat ID {id} {colour} {share} {share} {shine}\n"));
            let (point, [a, b, c]) = (words(self.point(2)), self.radii());
            text.push(match self.below(4) {
                0 if !is_plain => {
                    format!("obj box ID {id} mat ID {id} {point} 1 0 0 0 1 0 0 0 1 {a} {b} {c}\n")
                }
                1 if !is_plain => {
                    format!("obj cylinder ID {id} mat ID {id} {point} 0 0.6 0.8 {a} {b}\n")
                }
                _ => {
                    if a == b {
                        format!("obj sphere ID {id} mat ID {id} {point} {a}\n")
                    } else {
                        format!("obj ellipsoid ID {id} mat ID {id} {point} {a} {b} {c}\n")
                    }
                }
            });
        }
        text.concat()
    }

    fn xml(&mut self) -> String {
        let is_plain = self.is_plain();
        let mut text = "<xml><scene>\n".to_owned();
        let count = 1 + self.below(5);
        for number in 0..count {
            let kind = if is_plain || self.below(2) == 0 {
                "sphere"
            } else {
                "plane"
            };
            let ([a, b, c], point) = (self.radii(), attributes(["x", "y", "z"], self.point(2)));
            let turn = if is_plain {
                ""
            } else {
                "<rotate angle='30' x='1'/>"
            };
            let _ = writeln!(
                text,
                "<object type='{kind}' name='o{number}' material='m{number}'>\
                 <scale x='{a}' y='{b}' z='{c}'/>{turn}<translate {point}/></object>"
            );
            let colour = attributes(["r", "g", "b"], self.colour());
            let shine = if is_plain {
                "<specular value='0'/>"
            } else {
                "<specular value='0.4'/><glossiness value='20'/><reflection value='0.3'/>"
            };
            let _ = writeln!(
                text,
                "<material name='m{number}' type='blinn'><diffuse {colour}/>{shine}</material>"
            );
        }
        let ambient = self.number(0, 1);
        let _ = writeln!(
            text,
            "<light type='ambient'><intensity value='{ambient}'/></light>"
        );
        for _ in 0..=self.below(3) {
            let (strength, place) = (
                self.number(0, 1),
                attributes(["x", "y", "z"], self.point(9)),
            );
            let _ = writeln!(
                text,
                "<light type='point'><intensity value='{strength}'/><position {place}/></light>"
            );
        }
        let [eye, target] = [self.eye(), self.point(1)];
        let [eye, target] = [eye, target].map(|at| attributes(["x", "y", "z"], at));
        let (fov, width, height) = (
            self.number(20, 80),
            16 + self.below(40),
            16 + self.below(30),
        );
        let _ = writeln!(
            text,
            "</scene><camera><position {eye}/><target {target}/><fov value='{fov}'/>\
             <width value='{width}'/><height value='{height}'/></camera></xml>"
        );
        text
    }

    fn cse167(&mut self) -> String {
        let is_plain = self.is_plain();
        let mut text = vec![format!(
            "size {} {}\ncamera {} {} 0 1 0 {}\n",
            16 + self.below(40),
            16 + self.below(30),
            words(self.eye()),
            words(self.point(1)),
            self.number(20, 80)
        )];
        if !is_plain && self.below(2) == 0 {
            text.push("attenuation 0.5 0.1 0.01\n".to_owned());
        }
        for _ in 0..=self.below(3) {
            let (kind, point) = match self.below(2) {
                0 if !is_plain => ("directional", self.point(2)),
                _ => ("point", self.point(9)),
            };
            text.push(format!(
                "{kind} {} {}\n",
                words(point),
                words(self.colour())
            ));
        }
        text.push("vertex -2 -1 -2\nvertex 2 -1 -2\nvertex 0 -1 2\n".to_owned());
        for _ in 0..=self.below(5) {
            text.push(format!("diffuse {}\n", words(self.colour())));
            text.push(if is_plain {
                "ambient 0 0 0\n".to_owned()
            } else {
                format!(
                    "ambient {}\nspecular .2 .2 .2\nshininess 9\n",
                    words(self.colour())
                )
            });
            let (point, radii) = (words(self.point(2)), self.radii());
            let triangle = if !is_plain && self.below(3) == 0 {
                "tri 0 1 2\n"
            } else {
                ""
            };
            text.push(format!(
                "pushTransform\ntranslate {point}\nscale {}\nsphere 0 0 0 1\n{triangle}popTransform\n",
                words(radii)
            ));
        }
        text.concat()
    }

    /// A point away from the objects.
    fn eye(&mut self) -> [f64; 3] {
        let [x, y, _] = self.point(4);
        [x, y, self.number(7, 12)]
    }
}

fn words(numbers: [f64; 3]) -> String {
    numbers.map(|number| number.to_string()).join(" ")
}

fn attributes(names: [&str; 3], numbers: [f64; 3]) -> String {
    let pairs = names.iter().zip(numbers);
    let pairs: Vec<_> = pairs
        .map(|(name, number)| format!("{name}='{number}'"))
        .collect();
    pairs.join(" ")
}
