//! Instructions that the main kernels execute, compared with those kept in `instructions.json`.
//!
//! `cargo bench --bench instructions` counts them with callgrind, of valgrind, and fails if a kernel
//! executes more than 3 % more than kept; `-- --keep` replaces what is kept for this compiler. Counts
//! hardly vary from run to run, on any machine and under any load, unlike times; but they do not show
//! what the caches and the branches of a machine cost.
//!
//! A kernel is the difference between two runs of the program, one of which does it once more, so that
//! starting the program does not count. Valgrind has no AVX-512.

#[allow(dead_code, reason = "shared with the other benches")]
mod meshes;
#[allow(dead_code, reason = "shared with the other benches")]
mod scenes;

use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Stdio};

use serde_json::{Map, Value, json};

/// The vector instructions for which kernels are counted.
const LEVELS: [&str; 2] = ["avx2", "sse2"];

/// The factor by which a count may exceed what is kept.
const BOUND: f64 = 1.03;

/// What is kept, by compiler, level and kernel.
const KEPT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/benches/instructions.json");

/// A folder for scenes and counts.
const SCRATCH: &str = concat!(env!("CARGO_TARGET_TMPDIR"), "/instructions");

/// Two runs of the program that differ by the kernel: first without it, then with it.
struct Kernel {
    name: &'static str,
    runs: [Vec<String>; 2],
}

impl Kernel {
    /// Samples of a picture: one more of each pixel.
    fn samples(name: &'static str, scene: &Path) -> Self {
        let run = |spp: &str| {
            let picture = Path::new(SCRATCH).join("picture.bmp");
            let mut run = words("render --size 96x72 --threads 1 --progress none --spp");
            run.extend([spp.into(), "-o".into(), show(&picture), show(scene)]);
            run
        };
        Self {
            name,
            runs: [run("1"), run("2")],
        }
    }

    /// Reading a scene, instead of one of half the size.
    fn reading(name: &'static str, [half, whole]: [PathBuf; 2]) -> Self {
        let run = |scene: &Path| [words("check"), vec![show(scene)]].concat();
        Self {
            name,
            runs: [run(&half), run(&whole)],
        }
    }

    /// The number of instructions, in thousands.
    fn count(&self, level: &str) -> u64 {
        let [without, with] = [0, 1].map(|run| instructions(&self.runs[run], level));
        let kernel = with.checked_sub(without);
        kernel.expect("the second run does more") / 1000
    }
}

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let keeps = arguments.iter().any(|argument| argument == "--keep");
    std::fs::create_dir_all(SCRATCH).expect("the target folder is writable");
    let compiler = compiler();
    let mut kept: Value = std::fs::read_to_string(KEPT).map_or_else(
        |_| json!({}),
        |text| serde_json::from_str(&text).expect("what is kept is JSON"),
    );
    println!("thousands of instructions by {compiler}; kept, and the ratio");
    let mut exceeds = false;
    let mut counts = Map::new();
    for level in LEVELS {
        let mut of_level = Map::new();
        for kernel in kernels() {
            let count = kernel.count(level);
            let before = kept[&compiler][level][kernel.name].as_u64();
            let ratio = before.map(|before| count as f64 / before as f64);
            println!(
                "{level:<6} {:<16} {count:>9} {:>9} {:>6}",
                kernel.name,
                before.map_or_else(|| "-".into(), |before| before.to_string()),
                ratio.map_or_else(|| "-".into(), |ratio| format!("{ratio:.3}")),
            );
            exceeds |= ratio.is_some_and(|ratio| BOUND < ratio);
            of_level.insert(kernel.name.into(), count.into());
        }
        counts.insert(level.into(), of_level.into());
    }
    if keeps {
        kept[&compiler] = counts.into();
        let text = serde_json::to_string_pretty(&kept).expect("a table is JSON");
        std::fs::write(KEPT, text + "\n").expect("the benches are writable");
    } else if exceeds {
        println!("a kernel executes more than {BOUND} times what is kept");
        return ExitCode::FAILURE;
    }
    ExitCode::SUCCESS
}

fn kernels() -> [Kernel; 8] {
    let own = |name: &str| {
        Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("scenes")
            .join(name)
    };
    let mesh = |triangles| {
        let obj = format!("ball-{triangles}.obj");
        written(&obj, &meshes::bumpy_ball(triangles));
        written(
            &format!("ball-{triangles}.xml"),
            &format!(
                "<xml><scene><object type=\"obj\" name=\"{obj}\"/>\
                <light type=\"direct\" name=\"sun\"><intensity value=\"1\"/><direction x=\"-1\" z=\"-1\"/></light>\
                </scene><camera><position y=\"-3\"/></camera></xml>"
            ),
        )
    };
    let spheres = |count| {
        let text = scenes::random_spheres(count, 1);
        written(&format!("spheres-{count}.ray"), &text)
    };
    let flake = written("flake.ray", &scenes::sphereflake(4));
    let csg = written("csg.dat", &scenes::set_operations(200));
    [
        Kernel::samples("solids", &own("default.ray")),
        Kernel::samples("sphereflake", &flake),
        Kernel::samples("mesh", &mesh(40_000)),
        Kernel::samples("csg", &csg),
        Kernel::samples("path, lamp", &own("lamp.xml")),
        Kernel::samples("path, sky", &own("sundial.xml")),
        Kernel::reading("reading .ray", [spheres(5_000), spheres(10_000)]),
        Kernel::reading("reading .obj", [mesh(20_000), mesh(40_000)]),
    ]
}

/// Writes a scene and returns its path.
fn written(name: &str, text: &str) -> PathBuf {
    let path = Path::new(SCRATCH).join(name);
    std::fs::write(&path, text).expect("the target folder is writable");
    path
}

fn words(line: &str) -> Vec<String> {
    line.split(' ').map(str::to_owned).collect()
}

fn show(path: &Path) -> String {
    path.to_str().expect("the path is UTF-8").to_owned()
}

/// The instructions that all threads of a run of the program execute.
fn instructions(arguments: &[String], level: &str) -> u64 {
    let counts = Path::new(SCRATCH).join("counts");
    let status = Command::new("valgrind")
        .args(["--tool=callgrind", "--quiet"])
        .arg(format!("--callgrind-out-file={}", counts.display()))
        .arg(env!("CARGO_BIN_EXE_halflight"))
        .args(arguments)
        .env("HALFLIGHT_CPU", level)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status()
        .expect("valgrind is installed");
    assert!(status.success(), "{arguments:?} fails");
    let text = std::fs::read_to_string(&counts).expect("callgrind writes counts");
    let total = text.lines().find_map(|line| line.strip_prefix("totals: "));
    total
        .expect("the counts have a total")
        .trim()
        .parse()
        .expect("an integer")
}

/// The version of the compiler.
fn compiler() -> String {
    let output = Command::new(std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into()))
        .arg("--version")
        .output()
        .expect("there is a compiler");
    String::from_utf8_lossy(&output.stdout).trim().to_owned()
}
