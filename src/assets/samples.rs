//! The sample scenes that the program carries, each with the files that it names.

/// A file that the program carries: its name and its bytes.
pub type Carried = (&'static str, &'static [u8]);

/// A sample scene.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// The name of its file.
    pub name: &'static str,
    /// What it shows, in a line.
    pub words: &'static str,
    /// Its text.
    pub text: &'static str,
    /// The files that it names.
    pub files: &'static [Carried],
}

/// Declares the samples, one a line, from files of the folder of scenes.
macro_rules! samples {
    ($($name:literal $words:literal [$($file:literal)*];)+) => {
        /// All samples, the simplest first.
        pub const SAMPLES: &[Sample] = &[$(Sample {
            name: $name,
            words: $words,
            text: include_str!(concat!("../../scenes/", $name)),
            files: &[$(($file, include_bytes!(concat!("../../scenes/", $file)))),*],
        }),+];
    };
}

samples! {
    "default.ray" "every solid, a mirror, glass, coloured lights" [];
    "example.ray" "the example of the .ray language" [];
    "spheres.xml" "three white spheres: the first project of a course" [];
    "lights.ray" "coloured lights and their shadows, and a pane that lets half the light through" [];
    "highlights.ray" "highlights: how their exponent and coefficient look" [];
    "glass.ray" "refraction and total internal reflection" [];
    "mirrors.ray" "mirrors in mirrors, down to the depth limit" [];
    "frames.ray" "every solid, upright and turned" [];
    "still-life.dat" "a die, a cup and a vase: solids cut from solids, textures, bumps" ["bricks.png" "peel.png"];
    "pool.dat" "a court at night: a spotlight, fires, ripples on water" ["bricks.png" "ripples.png"];
    "lanterns.test" "a pond at night, with lights that fade" [];
    "carousel.xml" "one mesh in nine places" ["knot.obj" "knot.mtl"];
    "courtyard.xml" "textures, and a sky seen in mirrors and glass" ["sky.png" "bricks.png" "peel.png"];
    "lamp.xml" "path tracing: an area light, depth of field, rough metal" [];
    "neon.xml" "path tracing: a room lit by a glowing knot" ["knot.obj" "knot.mtl"];
    "sundial.xml" "path tracing: a sky with a sun" ["sky.png"];
    "caustic.xml" "photons: a lamp focused by a glass ball and a gold ring" ["ring.obj"];
}
