//! Limits on threads and memory.

use super::*;

/// Runs the program with a thread stack size so large that no thread can start.
fn without_threads(place: &Place, line: &str) -> (Option<i32>, String) {
    let mut command = place.command(line);
    let output = command
        .env("RUST_MIN_STACK", (1_u64 << 60).to_string())
        .output();
    let output = output.expect("it starts");
    let stderr = String::from_utf8(output.stderr).expect("UTF-8");
    (output.status.code(), stderr)
}

#[test]
fn scenes_are_checked_even_if_no_thread_can_start() {
    let place = Place::new();
    let (head, ball) = BALL.split_once("1 sphere").expect("a ball");
    let (ball, _) = ball.split_once('\n').expect("a line");
    let balls = format!("sphere{ball}\n").repeat(50_000);
    place.write("balls.ray", format!("{head}50000\n{balls}"));
    place.write("a.dat", TEXTURED);
    let pixels = vec![b'x'; 3 * 1024 * 1024];
    place.write("skin.ppm", [b"P6\n1024 1024\n255\n", &pixels[..]].concat());
    for scene in ["ball.ray", "balls.ray", "a.dat"] {
        let (code, stderr) = without_threads(&place, &format!("check {scene}"));
        assert_eq!(code, Some(0), "{scene}: {stderr}");
    }
}

#[test]
fn threads_that_cannot_start_are_an_error() {
    let place = Place::new();
    let (code, stderr) = without_threads(&place, "render ball.ray -o a.ppm --threads 3");
    assert_eq!(code, Some(1), "{stderr}");
    let first = "error: cannot start the rendering threads (3): ";
    assert!(stderr.starts_with(first), "{stderr}");
    assert!(
        stderr.ends_with("; --threads N sets how many\n"),
        "{stderr}"
    );
    assert_eq!(place.names(), ["ball.ray"]);
    for count in ["0", "1025", "1000000"] {
        let stderr = place.stderr(&format!("render ball.ray -o a.ppm --threads {count}"), 2);
        assert!(stderr.contains("a whole number from 1 to 1024"), "{stderr}");
    }
}

/// A row of spheres, with the view of the ball.
#[cfg(target_os = "linux")]
fn spheres(count: usize) -> String {
    let sphere = |number| format!("sphere {number} 0 0 .1  1 1 1 0 0 0 0 0 0 1 0 0 1\n");
    let spheres: String = (0..count).map(sphere).collect();
    let view = "// view: eye 0 0 5 target 0 0 0 up 0 1 0 fov 40 size 8 6";
    format!("1 1 1 1 0 9 0 0 0 0 {count}\n{spheres}{view}")
}

#[test]
#[cfg(target_os = "linux")]
fn work_under_any_memory_limit_succeeds_or_is_refused() {
    let place = Place::new();
    place.write("many.ray", spheres(100_000));
    let mut refused = 0;
    let loads = |limit: &u32| {
        let output = in_shell(&place, &format!("ulimit -v {limit}"), "--version");
        output.status.success()
    };
    // In kilobytes, from what it takes to load the program to more than the scene needs.
    let mut limits = (1..100).map(|limit| limit * 1000);
    let least = limits.find(loads).expect("the program can be loaded");
    for limit in (least..=least + 88_000).step_by(8000) {
        for line in ["check many.ray", "render many.ray --threads 2 -o -"] {
            let output = in_shell(&place, &format!("ulimit -v {limit}"), line);
            let stderr = String::from_utf8_lossy(&output.stderr);
            match output.status.code() {
                Some(0) => {}
                Some(1) => {
                    refused += 1;
                    let has_reason = stderr.contains("out of memory: ")
                        || stderr.contains("cannot start threads");
                    assert!(
                        has_reason && stderr.contains("error: "),
                        "{line} in {limit} kB: {stderr}"
                    );
                }
                code => panic!("{line} in {limit} kB: {code:?}: {stderr}"),
            }
        }
    }
    assert!((2..20).contains(&refused), "{refused} of 24 are refused");
}

#[test]
#[cfg(target_os = "linux")]
fn a_picture_that_does_not_fit_in_memory_is_an_error() {
    let place = Place::new();
    let in_2_gb = |options: &str| {
        let line = format!("render ball.ray --threads 1 --spp 1 {options}");
        let output = in_shell(&place, "ulimit -v 2000000", &line);
        let stderr = String::from_utf8_lossy(&output.stderr).into_owned();
        (output.status.code(), stderr)
    };
    let layers = "--size 4000x3000 --layers depth,normal,albedo,uv,cost,emission,indirect";
    for (size, options) in [
        ("16384x16384", "-o a.ppm --size 16384x16384"),
        ("16384x16384", "-o a.ppm --size 16384x16384 --resume"),
        ("4000x3000", &format!("-o a.exr {layers}")),
        ("4000x3000", &format!("-o a%d.exr {layers} --turntable 2")),
    ] {
        let (code, stderr) = in_2_gb(options);
        assert_eq!(code, Some(1), "{stderr}");
        let expected = format!("error: cannot trace {size}: not enough memory for the ");
        assert!(stderr.starts_with(&expected), "{stderr}");
        assert_eq!(stderr.lines().count(), 1, "{stderr}");
        assert_eq!(place.names(), ["ball.ray"]);
    }
    // A shard needs the memory of its own blocks only.
    let (code, stderr) = in_2_gb("-o a.ppm --size 16384x16384 --shard 0/100000");
    assert_eq!(code, Some(0), "{stderr}");
}

/// A few bytes that claim to be 8192 by 8192 pixels.
#[test]
#[cfg(target_os = "linux")]
fn a_texture_that_does_not_fit_in_memory_is_left_out() {
    let place = Place::new();
    place.write("a.dat", TEXTURED.replace("skin.ppm", "skin.gif"));
    let frame = b"\x2c\0\0\0\0\0\x20\0\x20\0\x02\x01\x04\0";
    let gif = [&b"GIF89a\0\x20\0\x20\x80\0\0\0\0\0\0\0\0"[..], frame, b";"].concat();
    place.write("skin.gif", gif);
    for limit in [200_000, 500_000, 600_000] {
        let line = "render a.dat -o a.ppm --spp 1 --threads 1";
        let output = in_shell(&place, &format!("ulimit -v {limit}"), line);
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(0), "{limit} kB: {stderr}");
        assert!(stderr.contains("skin.gif"), "{limit} kB: {stderr}");
    }
}

/// More memory never makes a start fail that succeeded with less.
#[test]
#[cfg(target_os = "linux")]
fn the_interface_starts_under_any_memory_limit_or_says_why_not() {
    let place = Place::new();
    place.write("a.keys", "wait q");
    let mut has_started = false;
    // In kilobytes.
    for limit in (8..=60).step_by(4).map(|limit| limit * 10_000) {
        let line = "ball.ray --threads 2 --keys a.keys --screen 80x24 --dump-frame a.txt";
        let output = in_shell(&place, &format!("ulimit -v {limit}"), line);
        let stderr = String::from_utf8_lossy(&output.stderr);
        match output.status.code() {
            Some(0) => has_started = true,
            code => {
                let is_refused = code == Some(1) && stderr.starts_with("error: ");
                assert!(is_refused && !has_started, "{limit} kB: {code:?}: {stderr}");
            }
        }
    }
    assert!(has_started);
}

/// The most memory that a command has taken, in bytes.
#[cfg(target_os = "linux")]
fn peak(place: &Place, line: &str) -> f64 {
    let stats = place.run(&format!("{line} --stats -")).stdout;
    let stats = String::from_utf8(stats).expect("UTF-8");
    let (_, peak) = stats.split_once("\"peak\":").expect("a peak");
    let peak = peak.split([',', '}', '\n']).next().expect("a number");
    peak.trim().parse().expect("a number")
}

/// Of a line continued a million times, and of a library whose long name each of its materials has.
#[test]
#[cfg(target_os = "linux")]
fn a_mesh_takes_little_more_memory_than_its_files() {
    let place = Place::new();
    let scene = "<xml><scene><object type='obj' name='a.obj'/></scene><camera><width value='8'/>\
                 <height value='6'/></camera></xml>";
    place.write("a.xml", scene);
    let taken = |head: &str, tail: &str| {
        let triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3";
        place.write("a.obj", format!("{head}{triangle}{tail}"));
        peak(&place, "render a.xml -o a.ppm --spp 1 --threads 1")
    };
    let bare = taken("", "");
    let continued = taken("", &" \\\n".repeat(1 << 20));
    let materials = (0..1 << 14).map(|number| format!("newmtl {number}\n"));
    place.write("a.mtl", materials.collect::<String>());
    let named = taken(
        &format!("mtllib {}a.mtl\nusemtl 1\n", "./".repeat(1 << 10)),
        "",
    );
    let stderr = place.stderr("check a.xml", 0);
    assert!(!stderr.contains("cannot read"), "{stderr}");
    for peak in [continued, named] {
        assert!(peak - bare < 18e6, "{bare} {continued} {named}");
    }
}

/// At least what is used, and at most half as much again.
#[test]
#[cfg(target_os = "linux")]
fn the_estimate_of_photons_is_close() {
    let place = Place::new();
    for name in ["caustic.xml", "pool.dat"] {
        let scenes = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
        fs::copy(scenes.join(name), place.at(name)).expect("copied");
        for (size, spp) in [("80x60", 1), ("64x48", 12), ("160x120", 2)] {
            let line = format!(
                "render {name} -o a.ppm --integrator photon --falloff square --size {size} --spp {spp} --threads 2"
            );
            let estimate = place.run(&format!("{line} --estimate")).stdout;
            let estimate = String::from_utf8(estimate).expect("UTF-8");
            let estimate: u64 = estimate.trim().trim_end_matches('M').parse().expect("MB");
            let ratio = (estimate << 20) as f64 / peak(&place, &line);
            assert!((1.0..1.5).contains(&ratio), "{name} {size} {spp}: {ratio}");
        }
    }
}
