//! The programs: ours and the installed peers.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use halflight::scene::Size;

use crate::cases::{Case, Picture};
use crate::setting::{SCRATCH, THREADS, WHOLE};

/// A program that renders pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Program {
    Halflight,
    Povray,
    Tachyon,
    /// A small tracer over Embree, compiled from the source beside the scenes.
    Embree,
}

impl Program {
    /// The installed programs, ours first; without a folder of their scenes no peers.
    pub(crate) fn installed(folder: Option<&Path>) -> Vec<Self> {
        let mut programs = vec![Self::Halflight];
        let Some(folder) = folder else {
            return programs;
        };
        for (program, name) in [(Self::Povray, "povray"), (Self::Tachyon, "tachyon")] {
            if is_command(name) {
                programs.push(program);
            } else {
                println!("{name} skipped: not installed");
            }
        }
        match compile_reference(&folder.join("whitted.cpp")) {
            Ok(()) => programs.push(Self::Embree),
            Err(reason) => println!("Embree reference skipped: {reason}"),
        }
        programs
    }

    /// The name in the table.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Halflight => "ours",
            Self::Povray => "povray",
            Self::Tachyon => "tachyon",
            Self::Embree => "embree",
        }
    }

    /// The command that renders a picture of a scene; `None` if the program cannot.
    pub(crate) fn command(self, case: &Case, picture: &Picture) -> Option<Command> {
        let Size { width, height } = picture.size;
        let [width, height] = [width, height].map(|pixels| pixels.to_string());
        let spp = picture.spp;
        let file = |extension: &str| {
            let mut path = case.stem.clone()?.into_os_string();
            path.push(extension);
            Some(PathBuf::from(path)).filter(|path| path.exists())
        };
        let mut command;
        match self {
            Self::Halflight => {
                command = Command::new(env!("CARGO_BIN_EXE_halflight"));
                command.arg("render").arg(&case.scene);
                command.args([
                    "-o",
                    &out("ours.bmp"),
                    "--size",
                    &format!("{width}x{height}"),
                ]);
                command.args(["--spp", &spp.to_string(), "--threads", &THREADS.to_string()]);
                if let Some(depth) = case.depth {
                    command.args(["--depth", &depth.to_string()]);
                }
            }
            Self::Povray => {
                command = Command::new("povray");
                command.arg(format!("+I{}", file(".pov")?.display()));
                command.arg(format!("+O{}", out("povray.bmp")));
                command.args(["+FB", &format!("+W{width}"), &format!("+H{height}"), "-D"]);
                command.args([&format!("+WT{THREADS}"), "-GA", "-V", "-J"]);
                if spp == 1 {
                    command.arg("-A");
                } else {
                    // The number of samples is the square of this.
                    let edge = f64::from(spp).sqrt().round();
                    command.args(["+A0.0", "+AM1", &format!("+R{edge}")]);
                }
            }
            Self::Tachyon => {
                command = Command::new("tachyon");
                command.arg(file(".tac")?).args(["-res", &width, &height]);
                command.args(["-numthreads", &THREADS.to_string()]);
                command.args(["-aasamples", &(spp - 1).to_string(), "-format", "BMP"]);
                command.args(["-o", &out("tachyon.bmp")]);
            }
            Self::Embree => {
                let camera = std::fs::read_to_string(file(".camera.json")?).ok()?;
                let scene = file(".raw").or_else(|| file(".ray"))?;
                command = Command::new(out("whitted"));
                command.arg(scene);
                for key in ["eye", "target", "vfov", "max_depth"] {
                    command.args(numbers(&camera, key));
                }
                command.args([&width, &height, &spp.to_string(), &THREADS.to_string()]);
                command.arg(out("embree.bmp"));
            }
        }
        command.current_dir(case.scene.parent()?);
        command
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::null());
        Some(command)
    }
}

/// A program and the times of its runs.
#[derive(Clone, Debug)]
pub(crate) struct Timed {
    pub(crate) program: Program,
    /// The median of the runs so far, from before the start to after the end.
    pub(crate) wall: Duration,
    walls: Vec<Duration>,
    /// The times of the tracing alone, if the program reports them.
    frames: Vec<Duration>,
}

impl Timed {
    pub(crate) fn of(program: Program) -> Self {
        Self {
            program,
            wall: Duration::ZERO,
            walls: Vec::new(),
            frames: Vec::new(),
        }
    }

    /// Runs the program once more.
    pub(crate) fn run(&mut self, case: &Case, picture: &Picture) {
        let command = self.program.command(case, picture);
        let mut command = command.expect("only programs that can render the picture are run");
        let begun = Instant::now();
        let ended = command
            .spawn()
            .and_then(std::process::Child::wait_with_output);
        let wall = begun.elapsed();
        let name = self.program.name();
        let ended = ended.unwrap_or_else(|error| panic!("{name} does not run: {error}"));
        assert!(ended.status.success(), "{name} fails on {}", case.name);
        self.walls.push(wall);
        self.wall = median(&self.walls);
        let output = String::from_utf8_lossy(&ended.stdout);
        let mut words = output
            .split_whitespace()
            .skip_while(|&word| word != "render");
        if let Some(seconds) = words.nth(1).and_then(|word| word.parse().ok()) {
            self.frames.push(Duration::from_secs_f64(seconds));
        }
    }

    /// The same with the time of the tracing alone, if the program reports it.
    pub(crate) fn frame_alone(&self) -> Option<Self> {
        (!self.frames.is_empty()).then(|| Self {
            wall: median(&self.frames),
            ..self.clone()
        })
    }
}

/// The median; zero if there are no times.
pub(crate) fn median(times: &[Duration]) -> Duration {
    let mut times = times.to_vec();
    times.sort_unstable();
    times.get(times.len() / 2).copied().unwrap_or_default()
}

/// The peak memory of our program during a render, in bytes; 0 if unknown.
pub(crate) fn peak_of(case: &Case) -> usize {
    let command = Program::Halflight.command(case, &case.picture(WHOLE));
    let mut command = command.expect("ours can render any picture");
    let mut child = command
        .stdout(Stdio::null())
        .spawn()
        .expect("the program starts");
    let status = format!("/proc/{}/status", child.id());
    let mut peak = 0;
    // The system reports the peak so far until the program ends: only the last millisecond may be
    // missed.
    while child.try_wait().expect("it is our child").is_none() {
        let status = std::fs::read_to_string(&status).unwrap_or_default();
        peak = peak.max(kilobytes(&status, "VmHWM:") * 1024);
        std::thread::sleep(Duration::from_millis(1));
    }
    peak
}

/// A number of kilobytes from a process's `/proc` status; 0 if missing.
pub(crate) fn kilobytes(status: &str, key: &str) -> usize {
    let line = status.lines().find_map(|line| line.strip_prefix(key));
    line.and_then(|rest| rest.trim().trim_end_matches(" kB").parse().ok())
        .unwrap_or(0)
}

/// The number or list of numbers of a key in a flat JSON object.
fn numbers(json: &str, key: &str) -> Vec<String> {
    let quoted = format!("\"{key}\":");
    let rest = json.split_once(&quoted).map_or("", |(_, rest)| rest);
    let rest = rest.trim_start();
    let list = match rest.strip_prefix('[') {
        Some(list) => list.split(']').next(),
        None => rest.split([',', '}']).next(),
    };
    let list = list.unwrap_or_default().split(',');
    list.map(|number| number.trim().to_owned()).collect()
}

fn is_command(name: &str) -> bool {
    let path = std::env::var_os("PATH").unwrap_or_default();
    std::env::split_paths(&path).any(|folder| folder.join(name).is_file())
}

fn compile_reference(source: &Path) -> Result<(), String> {
    if !source.exists() {
        return Err("no whitted.cpp beside the scenes".to_owned());
    }
    let mut compiler = Command::new("g++");
    compiler.args([
        "-O3",
        "-march=native",
        "-ffast-math",
        "-fno-finite-math-only",
    ]);
    compiler
        .arg("-std=c++17")
        .arg(source)
        .args(["-o", &out("whitted")]);
    compiler.args(["-lembree3", "-lpthread"]);
    match compiler.stderr(Stdio::null()).status() {
        Ok(status) if status.success() => Ok(()),
        Ok(_) => Err("whitted.cpp does not compile".to_owned()),
        Err(error) => Err(format!("g++: {error}")),
    }
}

/// The path of a temporary file.
fn out(name: &str) -> String {
    format!("{SCRATCH}/{name}")
}
