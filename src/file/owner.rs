//! The owners of temporary files: a file's name identifies the process and the machine that created
//! it, so that the files of killed processes can be found and removed.

use std::fs;
use std::hash::{BuildHasher, DefaultHasher, Hash, Hasher, RandomState};
use std::path::Path;

use super::lock::{Lock, lock};

/// The prefix of the names of temporary files.
pub(super) const PREFIX: &str = ".halflight-";

/// The number of names examined in one folder.
const MOST: usize = 1 << 16;

/// A process, as encoded in the name of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Owner {
    /// A hash that identifies the machine.
    host: u32,
    /// A hash that identifies its last boot.
    boot: u32,
    process: u32,
    /// The start time of the process in the system's units: process IDs are reused.
    began: u64,
}

impl Owner {
    /// The current process.
    fn own() -> Self {
        let process = std::process::id();
        Self {
            host: host(),
            boot: boot(),
            process,
            began: began(process).unwrap_or(0),
        }
    }

    /// Parses the name of a temporary file. Returns `None` for any other name.
    fn of_name(name: &str) -> Option<Self> {
        let mut parts = name.strip_prefix(PREFIX)?.split('-');
        let owner = Self {
            host: u32::from_str_radix(parts.next()?, 16).ok()?,
            boot: u32::from_str_radix(parts.next()?, 16).ok()?,
            process: parts.next()?.parse().ok()?,
            began: parts.next()?.parse().ok()?,
        };
        u32::from_str_radix(parts.next()?, 16).ok()?;
        parts.next().is_none().then_some(owner)
    }

    /// Whether the process, which must be one of this machine, may still be running.
    fn may_run(&self) -> bool {
        self.boot == boot() && began(self.process).is_some_and(|began| began == self.began)
    }
}

/// Returns a new name for a temporary file of this process.
pub(super) fn temporary_name() -> String {
    let Owner {
        host,
        boot,
        process,
        began,
    } = Owner::own();
    let random = random();
    format!("{PREFIX}{host:08x}-{boot:08x}-{process}-{began}-{random:08x}")
}

/// A random number.
pub(super) fn random() -> u32 {
    RandomState::new().hash_one(()) as u32
}

/// Removes the temporary files that dead processes of this machine left in a folder.
pub(super) fn sweep(folder: &Path) {
    let Ok(entries) = fs::read_dir(folder) else {
        return;
    };
    let host = host();
    for entry in entries.take(MOST).flatten() {
        let name = entry.file_name();
        let owner = name.to_str().and_then(Owner::of_name);
        if let Some(owner) = owner.filter(|owner| owner.host == host) {
            remove_if_orphaned(&entry.path(), &owner);
        }
    }
}

/// Removes a temporary file unless it is still in use.
fn remove_if_orphaned(path: &Path, owner: &Owner) {
    // The lock, if it could be taken, is held until the file is removed.
    let file = super::open(path).ok();
    let is_orphaned = match file.as_ref().map(lock) {
        Some(Lock::Taken) => true,
        Some(Lock::Busy) => false,
        Some(Lock::Unknown) | None => !owner.may_run(),
    };
    if is_orphaned {
        let _ = fs::remove_file(path);
    }
}

fn hash(value: impl Hash) -> u32 {
    let mut hasher = DefaultHasher::new();
    value.hash(&mut hasher);
    hasher.finish() as u32
}

/// Identifies this machine: a hash of its name, and of its machine ID if it has one.
fn host() -> u32 {
    let number = fs::read("/etc/machine-id").unwrap_or_default();
    let name = rustix::system::uname().nodename().to_owned();
    hash((name, number))
}

/// Identifies the current boot of the machine; constant where systems have no boot ID.
fn boot() -> u32 {
    hash(fs::read("/proc/sys/kernel/random/boot_id").unwrap_or_default())
}

/// The start time of a running process, 0 if the system does not report it. `None` if none runs.
#[cfg(target_os = "linux")]
fn began(process: u32) -> Option<u64> {
    let stat = fs::read_to_string(format!("/proc/{process}/stat")).ok()?;
    // The second field, a name in parentheses, may contain anything; the 22nd is the start time.
    let (_, rest) = stat.rsplit_once(')')?;
    rest.split_ascii_whitespace().nth(19)?.parse().ok()
}

#[cfg(not(target_os = "linux"))]
fn began(process: u32) -> Option<u64> {
    use rustix::io::Errno;
    use rustix::process::{Pid, test_kill_process};
    let known = test_kill_process(Pid::from_raw(process.cast_signed())?);
    (known != Err(Errno::SRCH)).then_some(0)
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use std::fs::File;

    use super::*;

    /// The name of a temporary file of the given process.
    fn name_of(owner: &Owner) -> String {
        let Owner {
            host,
            boot,
            process,
            began,
        } = owner;
        format!("{PREFIX}{host:08x}-{boot:08x}-{process}-{began}-00c0ffee")
    }

    #[test]
    fn names_identify_their_process() {
        assert_eq!(Owner::of_name(&temporary_name()), Some(Owner::own()));
        assert!(Owner::own().may_run());
        for name in [
            ".halflight-backup-1f-00c0ffee-a.ray",
            ".halflight-0-0-1-2",
            ".halflight-0-0-1-2-3-4",
            "halflight-0-0-1-2-3",
        ] {
            assert_eq!(Owner::of_name(name), None, "{name}");
        }
    }

    #[test]
    fn only_orphaned_files_of_this_machine_are_swept() {
        let own = Owner::own();
        let (other_host, other_boot) = (own.host ^ 1, own.boot ^ 1);
        let ended = Owner {
            began: own.began + 1,
            ..own.clone()
        };
        let from_before = Owner {
            boot: other_boot,
            ..own.clone()
        };
        let elsewhere = Owner {
            host: other_host,
            ..ended.clone()
        };
        assert!(!ended.may_run() && !from_before.may_run());
        let folder = tempfile::tempdir().expect("a folder");
        let place = |name: &str| folder.path().join(name);
        let kept = [
            name_of(&elsewhere),
            ".halflight-Xs72ab".to_owned(),
            "a.ray".to_owned(),
        ];
        for name in kept
            .iter()
            .chain(&[name_of(&ended), name_of(&from_before), name_of(&own)])
        {
            fs::write(place(name), "half").expect("written");
        }
        let busy = temporary_name();
        let at_work = File::create(place(&busy)).expect("created");
        assert_eq!(lock(&at_work), Lock::Taken);

        sweep(folder.path());
        let left = |name: &String| place(name).exists();
        assert!(kept.iter().all(left) && left(&busy));
        // If the lock of a file can be taken, it does not matter whether its process still runs.
        for owner in [&ended, &from_before, &own] {
            assert!(!left(&name_of(owner)), "{owner:?}");
        }
        drop(at_work);
        sweep(folder.path());
        assert!(!left(&busy));
    }
}
