//! A large scene of the `.test` language as a text, instead of a file.

use std::fmt::Write;

/// A rolling ground of `cells` × `cells` squares, two `tri` each, under one material.
pub(super) fn grid(cells: usize) -> String {
    let mut text = String::from(
        "# A rolling ground of many triangles in one mesh, seen from its edge.
size 120 90
camera 0.03 -9.07 5.51  0.01 0.02 -0.3  0 0 1  50
directional 2 -3 4  0.7 0.7 0.6
point -3.1 2.3 3.7  0.5 0.4 0.3
ambient 0.05 0.06 0.08
diffuse 0.4 0.6 0.35
specular 0.1 0.1 0.1
shininess 12
",
    );
    let side = cells + 1;
    // Writing to a string cannot fail.
    let _ = writeln!(text, "maxverts {}", side * side);
    let at = |step: usize| 10.0 * step as f64 / cells as f64 - 5.0;
    for (row, column) in places(side) {
        let (x, y) = (at(column), at(row));
        let height = 0.6 * (1.3 * x).sin() * (0.9 * y + 0.4).cos();
        let _ = writeln!(text, "vertex {x} {y} {height}");
    }
    for (row, column) in places(cells) {
        let corner = row * side + column;
        let across = corner + side;
        let _ = writeln!(text, "tri {corner} {} {}", corner + 1, across + 1);
        let _ = writeln!(text, "tri {corner} {} {across}", across + 1);
    }
    text
}

/// The rows and columns of a square array, row by row.
fn places(side: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..side * side).map(move |at| (at / side, at % side))
}
