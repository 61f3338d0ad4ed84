//! Links to the file and on the path to it.

use super::*;
use Step::Link;

const LINKED: [Step; 5] = [
    Directory("d"),
    Directory("e"),
    Save("e/real.ray", "old"),
    Link("../e/real.ray", "d/middle"),
    Link("d/middle", "s.ray"),
];

#[test]
fn the_target_of_a_link_is_watched() {
    let cases: [(&[Step], &str); 5] = [
        (&[Save("e/real.ray", "at the target")], "at the target"),
        (&[Save("s.ray", "through the link")], "through the link"),
        (
            &[Save("x", "renamed over"), Rename("x", "e/real.ray")],
            "renamed over",
        ),
        (
            &[
                Save("e/b", "middle"),
                Remove("d/middle"),
                Link("../e/b", "d/middle"),
            ],
            "middle",
        ),
        (&[Save("x", "file now"), Rename("x", "s.ray")], "file now"),
    ];
    for (steps, content) in cases {
        for method in [Method::Native, POLL] {
            let mut watched = Watched::new("s.ray", method, &LINKED);
            watched.expect(steps, content);
        }
    }
}

#[test]
fn the_new_target_of_a_link_is_watched_even_before_it_exists() {
    let mut watched = Watched::new("s.ray", Method::Native, &[Save("s.ray", "old")]);
    watched.expect(
        &[
            Directory("d"),
            Link("d/real", "l"),
            Rename("l", "s.ray"),
            Save("d/real", "new"),
        ],
        "new",
    );
    watched.expect(&[Save("x", "newer"), Rename("x", "d/real")], "newer");
}

#[test]
fn links_to_folders_may_dangle_and_be_replaced() {
    let before = [Directory("scenes"), Link("m", "lnk")];
    let mut watched = Watched::new("scenes/../lnk/deep/s.ray", Method::Native, &before);
    watched.expect(
        &[
            Directory("m"),
            Directory("m/deep"),
            Save("m/deep/s.ray", "there"),
        ],
        "there",
    );
    watched.expect(
        &[
            Directory("x"),
            Directory("x/deep"),
            Save("x/deep/s.ray", "elsewhere"),
            Link("x", "l"),
            Rename("l", "lnk"),
        ],
        "elsewhere",
    );
    watched.expect(&[Save("x/deep/s.ray", "again")], "again");
    watched.expect(
        &[
            Rename("x", "y"),
            Directory("x"),
            Rename("y/deep", "x/deep"),
            Save("x/deep/s.ray", "moved"),
        ],
        "moved",
    );
}
