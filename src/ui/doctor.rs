//! Reports what was detected about the terminal and the machine, and why.

use std::fmt::Write;
use std::io::{self, IsTerminal};
use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::sync::mpsc;
use std::thread;
use std::time::Duration;

use super::terminal::interview::{self, Answers};
use super::terminal::{self, Budget, Choice, ColourDepth, Protocol, Reply, query, tmux};
use assets::Assets;
use file::state_folder::{self, Store};
use memory::Available;
use render::{CPU_LEVEL_VARIABLE, CPU_LEVELS, simd_level_name};
use text::{alternatives, counted, visible};

/// The DEC private mode of synchronized output.
const SYNCHRONIZED: u16 = 2026;

/// Maximum time to wait for tmux.
const TMUX_PATIENCE: Duration = Duration::from_secs(1);

/// Examines the environment in which the interface would open a scene. The lines of the report end
/// in `\n` and are safe to print. Queries the terminal if standard input and output are connected
/// to it.
pub fn examine(scene: Option<&Path>) -> String {
    let variable = |name: &str| std::env::var(name).ok().filter(|value| !value.is_empty());
    let may_ask = has_terminal() && query::may_ask(variable);
    let answers = may_ask.then(|| interview::ask().unwrap_or_default());
    let answers = answers.as_ref();
    let folder = match scene.and_then(Path::parent) {
        Some(folder) if !folder.as_os_str().is_empty() => folder.to_owned(),
        _ => PathBuf::from("."),
    };
    let client = ask_tmux();
    let behind_tmux = client.map(|client| client.has_true_colour);
    let plain = |words: &str| vec![words.to_owned()];
    // The label and the lines of each section.
    let findings = [
        ("terminal", terminal(variable)),
        ("colours", colours(answers, behind_tmux, variable)),
        ("pictures", pictures(answers, client, terminal::cell_size())),
        ("synchronized", synchronized(answers)),
        ("mouse", plain("captured; --no-mouse disables this")),
        (
            "clipboard",
            plain("copies are offered with OSC 52, which the terminal may ignore"),
        ),
        ("link", link(variable)),
        ("changes", changes(&folder)),
        ("editors", editors()),
        ("threads", threads()),
        ("processor", vec![processor()]),
        ("memory", memory_limits()),
        ("folders", folders(scene, &folder)),
    ];
    let mut text = String::new();
    for (label, lines) in findings {
        for (at, line) in lines.iter().enumerate() {
            let label = if at == 0 { label } else { "" };
            // Writing to a string cannot fail.
            let _ = writeln!(text, "{label:<14}{}", visible(line));
        }
    }
    text
}

/// Whether standard input and output are connected to a terminal.
fn has_terminal() -> bool {
    io::stdin().is_terminal() && io::stdout().is_terminal()
}

fn terminal(variable: impl Fn(&str) -> Option<String>) -> Vec<String> {
    let names = [
        "TERM",
        "TERM_PROGRAM",
        "COLORTERM",
        "TMUX",
        "SSH_CONNECTION",
    ];
    let setting = |name| match variable(name) {
        Some(value) => format!("{name}={value}"),
        None => format!("{name} not set"),
    };
    let mut lines = vec![names.map(setting).join(", ")];
    if !has_terminal() {
        lines.push("input or output is not a terminal: no queries sent".to_owned());
    }
    lines
}

/// The answer of tmux, if it arrives in time.
fn ask_tmux() -> Option<tmux::Client> {
    let (sender, answer) = mpsc::channel();
    thread::spawn(move || sender.send(tmux::client()));
    answer.recv_timeout(TMUX_PATIENCE).ok().flatten()
}

fn colours(
    answers: Option<&Answers>,
    behind_tmux: Option<bool>,
    variable: impl Fn(&str) -> Option<String>,
) -> Vec<String> {
    let depth = ColourDepth::detect_from(Choice::Auto, &variable);
    let name = depth.name();
    if variable("NO_COLOR").is_some() {
        return vec![format!("{name}: NO_COLOR is set; --color overrides it")];
    }
    let mut lines = vec![match variable("COLORTERM") {
        Some(_) => format!("{name} from COLORTERM and TERM"),
        None => format!("{name} from TERM alone"),
    }];
    if depth == ColourDepth::TrueColour {
        return lines;
    }
    let (shows_more, finding) = match (answers, behind_tmux) {
        (Some(answers), _) if answers.replies.contains(&Reply::TrueColour) => {
            (true, "the terminal reports 24-bit colour, so it is used")
        }
        (_, Some(true)) => (true, "tmux passes on 24-bit colour, so it is used"),
        (_, Some(false)) => (
            false,
            "tmux assumes that its terminal lacks 24-bit colour; if it has it: \
             set -as terminal-features ',*:RGB'",
        ),
        (None, None) => (false, "the terminal was not queried"),
        (Some(answers), None) if answers.replies.is_empty() => {
            (false, "the terminal did not answer within 200 ms")
        }
        (Some(_), None) => (false, "the terminal does not report 24-bit colour"),
    };
    lines.push(finding.to_owned());
    if !shows_more {
        lines.push(depth.cure());
    }
    lines
}

/// The protocols for pictures that the terminal reports, and the size of its cells.
fn pictures(
    answers: Option<&Answers>,
    client: Option<tmux::Client>,
    cell: Option<(u16, u16)>,
) -> Vec<String> {
    let protocols = [
        ("kitty", Protocol::Kitty),
        ("iTerm2", Protocol::Iterm),
        ("sixel", Protocol::Sixel),
    ];
    let shows = |protocol| answers.is_some_and(|answers| answers.shows(protocol));
    let shown = protocols.iter().filter(|(_, protocol)| shows(*protocol));
    let shown: Vec<_> = shown.map(|(name, _)| *name).collect();
    let words = shown.join(", ");
    let named = client.filter(|client| client.placeholders.is_some());
    let mut lines = vec![match (answers, shown.first(), client) {
        (None, ..) => "half blocks: the terminal was not queried".to_owned(),
        _ if named.is_some_and(|client| client.passes_through) => {
            "real pixels by kitty's Unicode placeholders, text that tmux moves".to_owned()
        }
        (_, None, _) => "half blocks: the terminal reports no picture protocol".to_owned(),
        (_, _, Some(client)) if !client.has_sixel => {
            format!("half blocks: tmux knows {words}, but not of its terminal")
        }
        (_, Some(best), _) => format!("real pixels by {best}; the terminal reports {words}"),
    }];
    match cell.or_else(|| answers.and_then(Answers::cell_size)) {
        Some((width, height)) => lines.push(format!("cells of {width}x{height} pixels")),
        None => lines.push(
            "the size of cells is unknown, which sixels and Unicode placeholders need".to_owned(),
        ),
    }
    if let Some(client) = client {
        let words = match (client.passes_through, named.is_some()) {
            (true, _) => "tmux passes wrapped sequences on (allow-passthrough)",
            (false, false) => "tmux does not pass wrapped sequences on (allow-passthrough)",
            (false, true) => {
                "tmux does not pass on real pixels, which its terminal shows: \
                 set -g allow-passthrough on"
            }
        };
        lines.push(words.to_owned());
    }
    lines.push(
        "--pixels chooses half, quadrant, sextant or octant blocks, or a protocol".to_owned(),
    );
    lines
}

fn synchronized(answers: Option<&Answers>) -> Vec<String> {
    vec![
        match answers {
            None => "sent; support unknown: the terminal was not queried",
            Some(answers) if answers.mode(SYNCHRONIZED).is_some() => "supported by the terminal",
            Some(_) => "sent; the terminal does not report support and may show partial frames",
        }
        .to_owned(),
    ]
}

fn link(variable: impl Fn(&str) -> Option<String>) -> Vec<String> {
    let words = match Budget::of_environment(variable) {
        Budget::Measured => {
            "the terminal is connected over SSH: pictures are paced to the measured speed"
                .to_owned()
        }
        Budget::Fixed(rate @ 1..) => format!(
            "a multiplexer over SSH: pictures are limited to {} KB/s",
            rate / 1000
        ),
        Budget::Fixed(0) | Budget::Local => "local: no limit".to_owned(),
    };
    vec![format!("{words}; --bandwidth sets a limit")]
}

/// The interfaces that listen for editors, and which editors have connected.
fn editors() -> Vec<String> {
    let sockets = match link::sockets() {
        Ok(sockets) => sockets,
        Err(error) => return vec![format!("none can connect: {error}")],
    };
    let line = |socket: &link::Place| match link::shown(socket) {
        Some(shown) => {
            let editor = shown.editor.map_or_else(
                || "no editor is connected".to_owned(),
                |editor| format!("open in {editor}"),
            );
            visible(&format!("{}: {editor}", shown.scene)).into_owned()
        }
        None => format!("{}: no interface answers", socket.path().display()),
    };
    let mut lines: Vec<_> = sockets.iter().map(line).collect();
    if lines.is_empty() {
        lines.push("no interface listens".to_owned());
    }
    lines.push("`halflight lsp --print-config` sets an editor up".to_owned());
    lines
}

fn changes(folder: &Path) -> Vec<String> {
    vec![match network_file_system(folder) {
        Some(name) => {
            format!("the folder is on {name}, which may not send change notifications: use --poll")
        }
        None => "from system notifications; --poll checks periodically instead".to_owned(),
    }]
}

/// The name of the folder's file system if others may change files in it without a notification.
#[cfg(target_os = "linux")]
fn network_file_system(folder: &Path) -> Option<&'static str> {
    // Magic numbers of `statfs(2)`.
    match rustix::fs::statfs(folder).ok()?.f_type as u32 {
        0x6969 => Some("NFS"),
        0x517b | 0xfe53_4d42 | 0xff53_4d42 => Some("SMB"),
        0x0102_1997 => Some("9p"),
        0x6573_5546 => Some("FUSE"),
        _ => None,
    }
}

#[cfg(not(target_os = "linux"))]
fn network_file_system(_folder: &Path) -> Option<&'static str> {
    None
}

fn threads() -> Vec<String> {
    let cores = thread::available_parallelism().map_or(1, NonZero::get);
    let preview = cores.saturating_sub(1).max(1);
    let mut lines = vec![format!(
        "{preview} for the preview, {cores} for full-size traces and exports; --threads sets both"
    )];
    #[cfg(target_os = "linux")]
    if let Ok(allowed) = rustix::thread::sched_getaffinity(None) {
        let count = allowed.count() as usize;
        let quota = if cores < count {
            format!(", of which a cgroup grants {cores}")
        } else {
            String::new()
        };
        let allowed = counted(count, "core");
        lines.push(format!("{allowed} allowed by affinity{quota}"));
    }
    lines
}

/// The vector instructions available to the renderer.
fn processor() -> String {
    #[cfg(target_arch = "x86_64")]
    {
        let known = [
            ("avx2", std::arch::is_x86_feature_detected!("avx2")),
            ("fma", std::arch::is_x86_feature_detected!("fma")),
            ("avx512f", std::arch::is_x86_feature_detected!("avx512f")),
        ];
        let features =
            known.map(|(name, has)| format!("{name} {}", if has { "yes" } else { "no" }));
        let cap = match std::env::var(CPU_LEVEL_VARIABLE) {
            Ok(cap) if CPU_LEVELS.contains(&cap.as_str()) => {
                format!(", capped by {CPU_LEVEL_VARIABLE}")
            }
            Ok(cap) => format!(
                "; {CPU_LEVEL_VARIABLE}={cap} is ignored: expected {}",
                alternatives(CPU_LEVELS)
            ),
            Err(_) => String::new(),
        };
        let (features, used) = (features.join(", "), simd_level_name());
        format!("x86_64: {features}; tracing uses {used}{cap}")
    }
    #[cfg(not(target_arch = "x86_64"))]
    {
        std::env::consts::ARCH.to_owned()
    }
}

/// The memory left by each limit, the effective one first.
fn memory_limits() -> Vec<String> {
    let mut limits = memory::limits();
    limits.sort_by_key(|available| available.bytes);
    if limits.is_empty() {
        return vec!["no known limit".to_owned()];
    }
    let line = |available: &Available| {
        let free = memory::megabytes(available.bytes);
        format!("{free} left by {}", available.limit)
    };
    limits.iter().map(line).collect()
}

fn folders(scene: Option<&Path>, folder: &Path) -> Vec<String> {
    let current = std::env::current_dir();
    let current = current.map_or_else(|error| error.to_string(), |path| path.display().to_string());
    let kept = match state_folder::place(Store::Edits) {
        Ok(folder) => folder.display().to_string(),
        Err(error) => format!("nowhere: {error}"),
    };
    let scene = scene.map_or_else(|| folder.join("scene"), Path::to_owned);
    let readable = Assets::new(&[]).allowed(&scene);
    vec![
        format!("current: {current}"),
        format!("unsaved edits are kept in {kept}"),
        format!("pictures and meshes are read below {readable}; --assets adds folders"),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::terminal::{Reply, environment};

    fn answers(replies: &[Reply]) -> Answers {
        Answers {
            replies: replies.to_vec(),
        }
    }

    #[test]
    fn colours_are_reported_with_reason_and_remedy() {
        const FAR: &str = "TERM=xterm-256color";
        let cure = "--color 24";
        for (replies, tmux, variables, words, has_cure) in table! {
            None, None, "TERM=xterm-256color COLORTERM=truecolor" => "24-bit from COLORTERM", false;
            None, None, "TERM=xterm NO_COLOR=1" => "NO_COLOR is set", false;
            None, None, FAR => "was not queried", true;
            Some(&[][..]), None, FAR => "did not answer within", true;
            Some(&[Reply::Attributes]), None, FAR => "does not report 24-bit colour", true;
            Some(&[Reply::TrueColour]), None, FAR => "is used", false;
            Some(&[]), Some(true), FAR => "tmux passes on", false;
            Some(&[]), Some(false), FAR => "terminal-features", true;
        } {
            let answers = replies.map(answers);
            let said = colours(answers.as_ref(), tmux, environment(variables)).join("\n");
            assert!(said.contains(words), "{said}");
            assert_eq!(said.contains(cure), has_cure, "{said}");
        }
    }

    #[test]
    fn pictures_are_reported_by_protocol() {
        let kitty = Reply::Shows(Protocol::Kitty);
        let sixel = Reply::AttributesWithSixel;
        let tmux = |has_sixel| {
            Some(tmux::Client {
                has_sixel,
                ..tmux::Client::default()
            })
        };
        let named = |passes_through| {
            Some(tmux::Client {
                placeholders: Some(0),
                passes_through,
                ..tmux::Client::default()
            })
        };
        for (replies, client, words) in table! {
            None, None => "was not queried";
            Some(&[][..]), None => "reports no picture protocol";
            Some(&[kitty, sixel]), None => "by kitty; the terminal reports kitty, sixel";
            Some(&[sixel]), None => "by sixel;";
            Some(&[sixel]), tmux(true) => "by sixel;";
            Some(&[sixel]), tmux(false) => "half blocks: tmux";
            Some(&[]), named(true) => "by kitty's Unicode placeholders";
            Some(&[]), named(false) => "set -g allow-passthrough on";
        } {
            let answers = replies.map(answers);
            let said = pictures(answers.as_ref(), client, Some((9, 18))).join("\n");
            assert!(said.contains(words), "{words} in {said}");
            assert!(said.contains("9x18"), "{said}");
        }
    }

    #[test]
    fn only_modes_that_the_terminal_knows_are_reported() {
        let number = SYNCHRONIZED;
        for (state, words) in table! {
            2 => "supported by the terminal";
            0 => "sent; the terminal does not report support and may show partial frames";
        } {
            let said = synchronized(Some(&answers(&[Reply::Mode { number, state }])));
            assert_eq!(said, [words]);
        }
    }
}
