//! Kills a process at each system call of a write in turn.

use std::os::unix::process::ExitStatusExt;
use std::process::Command;

use super::faults::{Case, MOST};
use super::*;
use crate::faults::{Fault, during};

/// Environment variable with an order: lines with the call to be killed at, the file, the content.
const ORDER: &str = "HALFLIGHT_TEST_KILL";

/// The path of the test below, which the other process runs with an order.
const TEST: &str = "tests::kills::a_killed_process_leaves_the_old_or_the_new_content";

/// Carries out an order, in the process to be killed.
fn obey(order: &str) {
    let lines: Vec<_> = order.splitn(3, '\n').collect();
    let [at, path, new] = lines[..] else {
        panic!("{order}");
    };
    let at = at.parse().expect("a number");
    let (outcome, _) = during(Fault::Kill, at, || replace_with(Path::new(path), new));
    outcome.expect("no fault but the kill");
}

/// Writes a file in another process that is killed at call `at`. Returns whether it was killed.
fn write_until(at: usize, case: &Case) -> bool {
    let (path, new) = (case.path.display(), case.new);
    let program = std::env::current_exe().expect("a program");
    let output = Command::new(program)
        .args(["--exact", TEST])
        .env(ORDER, format!("{at}\n{path}\n{new}"))
        .output()
        .expect("it starts");
    let report = String::from_utf8_lossy(&output.stdout);
    match output.status.signal() {
        Some(signal) => assert_eq!(signal, 9, "{report}"),
        None => assert!(
            output.status.success() && report.contains("1 passed"),
            "{report}"
        ),
    }
    output.status.signal().is_some()
}

#[test]
fn a_killed_process_leaves_the_old_or_the_new_content() {
    if let Ok(order) = std::env::var(ORDER) {
        return obey(&order);
    }
    for number in 0..Case::all().len() {
        let mut found_in_copies = 0;
        let last = (0..MOST).find(|&at| {
            let case = Case::all().swap_remove(number);
            let was_killed = write_until(at, &case);
            let found = fs::read_to_string(&case.path).ok();
            let shown = format!("{} at {at}: {found:?}", case.name);
            let is_whole = [case.old, Some(case.new)].contains(&found.as_deref());
            let copies = backups(&case.path);
            if !was_killed {
                assert_eq!(found.as_deref(), Some(case.new), "{shown}");
                assert_eq!(copies, [] as [PathBuf; 0], "{shown}");
            }
            for copy in &copies {
                assert_eq!(Some(content(copy).as_str()), case.old, "{shown}");
                found_in_copies += 1;
            }
            assert!(is_whole || copies.len() == 1, "{shown}: {copies:?}");
            assert_eq!(case.left_behind(), [""; 0], "{shown}");
            // Later writes in the folder keep the copies.
            assert_eq!(backups(&case.path), copies, "{shown}");
            !was_killed
        });
        assert!(last.is_some_and(|last| 0 < last), "each call was hit");
        let is_in_place = Case::all()[number].names.contains(&"t".to_owned());
        assert_eq!(
            0 < found_in_copies,
            is_in_place,
            "only files written in place are torn"
        );
    }
}
