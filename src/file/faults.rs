//! Faults that tests inject into the system calls of writes.

use std::cell::RefCell;
use std::io;

use rustix::io::Errno;

/// What goes wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Fault {
    /// The k-th call fails, counted from 0.
    Once(Errno),
    /// The k-th call and all after it fail.
    Ever(Errno),
    /// Writes from the k-th call on take half of what they are given.
    Short,
    /// The process is killed at the k-th call. All writes take half of what they are given.
    Kill,
}

impl Fault {
    /// Whether a write has to succeed all the same.
    pub(crate) fn is_harmless(self) -> bool {
        matches!(self, Self::Once(Errno::INTR) | Self::Short)
    }
}

/// The calls that were made, and whether one of them was hit.
#[derive(Clone, Debug, Default)]
pub(crate) struct Calls {
    /// Their names.
    pub(crate) names: Vec<&'static str>,
    /// The first that was hit.
    pub(crate) hit: Option<&'static str>,
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

/// Does some work on this thread while the call of number `at`, from 0, goes wrong.
pub(crate) fn during<T>(fault: Fault, at: usize, work: impl FnOnce() -> T) -> (T, Calls) {
    PLAN.set(Some(Plan {
        fault,
        at,
        calls: Calls::default(),
    }));
    let outcome = work();
    let plan = PLAN.take();
    (outcome, plan.map(|plan| plan.calls).unwrap_or_default())
}

/// Fails if the plan says so.
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

/// Ends the process as a power cut would: without another word.
fn kill() -> ! {
    #[cfg(unix)]
    {
        use rustix::process::{Signal, getpid, kill_process};
        let _ = kill_process(getpid(), Signal::KILL);
    }
    std::process::abort()
}

/// What of `bytes` a write takes.
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
