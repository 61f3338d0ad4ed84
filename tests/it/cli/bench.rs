//! `halflight bench`: what its figures are named and belong to, not what they are.

use super::*;

fn measured(place: &Place, line: &str) -> String {
    let output = place.run(line);
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    String::from_utf8(output.stdout).expect("UTF-8")
}

#[test]
fn built_in_scenes_are_measured() {
    let place = Place::new();
    let table = measured(&place, "bench --size 8x6 --spp 1 --runs 1 --threads 1");
    let rows: Vec<_> = table
        .lines()
        .map(|line| line.split("  ").next().expect("a word"))
        .collect();
    assert!(rows[0].starts_with(concat!("halflight ", env!("CARGO_PKG_VERSION"), ", 1 of ")));
    assert!(rows[1].starts_with("size 8x6, depth 8, ") && rows[1].ends_with("medians of 1"));
    assert_eq!(
        rows[2..],
        ["", "scene", "default", "1000 spheres", "64000 spheres"]
    );
}

#[test]
fn figures_are_objects_of_json_with_their_settings() {
    let place = Place::new();
    let json = measured(
        &place,
        "bench ball.ray --runs 2 --size 40x30 --integrator path --json",
    );
    for key in [
        "version",
        "machine",
        "processor",
        "cores",
        "vectors",
        "memory",
        "threads",
        "runs",
        "rows",
        "scene",
        "objects",
        "load",
        "build",
        "first",
        "trace",
        "trace_spread",
        "rays_per_second",
        "samples_per_second",
        "settings",
    ] {
        assert!(json.contains(&format!("\"{key}\": ")), "{key}: {json}");
    }
    for figure in [
        "\"scene\": \"ball.ray\"",
        "\"samples\": 4800",
        "\"integrator\": \"path\"",
        "\"spp\": 4",
    ] {
        assert!(json.contains(figure), "{figure}: {json}");
    }
    assert!(place.stderr("bench none.ray", 66).contains("no such file"));
    assert!(
        place
            .stderr("bench ball.ray --time 1s", 2)
            .contains("use --spp")
    );
}
