//! Fault injection into the system calls of writes, for tests.

use std::cell::RefCell;
use std::io;

use rustix::io::Errno;

/// A kind of fault. The k-th call is counted from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// The k-th call fails.
    Once(Errno),
    /// The k-th and all later calls fail.
    Ever(Errno),
    /// Writes from the k-th call on accept half of their bytes.
    Short,
    /// The process is killed at the k-th call. All writes accept half of their bytes.
    Kill,
}

impl Fault {
    /// Whether a write must succeed in spite of the fault.
    pub fn is_harmless(self) -> bool {
        matches!(self, Self::Once(Errno::INTR) | Self::Short)
    }
}

/// The calls that were made, and the first that the fault affected.
#[derive(Clone, Debug, Default)]
pub struct Calls {
    /// The names of the calls, in order.
    pub names: Vec<&'static str>,
    /// The first call that the fault affected.
    pub hit: Option<&'static str>,
}

#[derive(Debug)]
struct Plan {
    fault: Fault,
    at: usize,
    calls: Calls,
}

thread_local! {
    static PLAN: RefCell<Option<Plan>> = const { RefCell::new(None) };
}

/// Runs `work` on this thread with a fault at call `at`, counted from 0.
pub fn during<T>(fault: Fault, at: usize, work: impl FnOnce() -> T) -> (T, Calls) {
    PLAN.set(Some(Plan {
        fault,
        at,
        calls: Calls::default(),
    }));
    let outcome = work();
    let plan = PLAN.take();
    (outcome, plan.map(|plan| plan.calls).unwrap_or_default())
}

/// Counts a call, and fails if the plan has a fault for it.
pub(super) fn injected(name: &'static str) -> io::Result<()> {
    let step = |plan: &mut Plan| {
        let number = plan.calls.names.len();
        plan.calls.names.push(name);
        let error = match plan.fault {
            Fault::Once(error) => (number == plan.at).then_some(error),
            Fault::Ever(error) => (plan.at <= number).then_some(error),
            Fault::Kill if number == plan.at => kill(),
            Fault::Kill | Fault::Short => None,
        };
        match error {
            Some(error) => {
                plan.calls.hit.get_or_insert(name);
                Err(error.into())
            }
            None => Ok(()),
        }
    };
    PLAN.with_borrow_mut(|plan| plan.as_mut().map_or(Ok(()), step))
}

/// Ends the process abruptly, like a power cut.
fn kill() -> ! {
    use rustix::process::{Signal, getpid, kill_process};
    let _ = kill_process(getpid(), Signal::KILL);
    std::process::abort()
}

/// The part of `bytes` that a write accepts.
pub(super) fn shortened(bytes: &[u8]) -> &[u8] {
    let step = |plan: &mut Plan| {
        // This write is counted already.
        let is_hit = match plan.fault {
            Fault::Short => plan.at < plan.calls.names.len(),
            Fault::Kill => true,
            Fault::Once(_) | Fault::Ever(_) => false,
        };
        if is_hit && 1 < bytes.len() {
            plan.calls.hit.get_or_insert("write");
            &bytes[..bytes.len() / 2]
        } else {
            bytes
        }
    };
    PLAN.with_borrow_mut(|plan| plan.as_mut().map_or(bytes, step))
}
