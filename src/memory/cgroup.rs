//! The memory available within control groups: the limits of the process's group and its ancestors,
//! in either version, minus the usage. Cached files don't count as used, since they can be evicted.

use std::path::{Path, PathBuf};

use super::Limit;
use super::proc::{number, read};

/// Where control groups are mounted.
const MOUNT: &str = "/sys/fs/cgroup";

/// Version 1 expresses "no limit" as a number near 2⁶³.
const UNLIMITED: u64 = 1 << 60;

/// The memory available within each limit, in bytes.
pub(super) fn available() -> Vec<(Limit, u64)> {
    let read = |path: &Path| read(path);
    let groups = read(Path::new("/proc/self/cgroup"));
    left(&groups, Path::new(MOUNT), &read)
}

/// File names of one cgroup version.
struct Names {
    limits: &'static [(&'static str, Limit)],
    usage: &'static str,
    /// Keys of the cached files in `memory.stat`.
    cached: [&'static str; 2],
}

const SECOND: Names = Names {
    limits: &[
        ("memory.max", Limit::Group),
        ("memory.high", Limit::GroupHigh),
    ],
    usage: "memory.current",
    cached: ["inactive_file", "active_file"],
};

const FIRST: Names = Names {
    limits: &[("memory.limit_in_bytes", Limit::Group)],
    usage: "memory.usage_in_bytes",
    cached: ["total_inactive_file", "total_active_file"],
};

/// Implements [`available`] for a list of groups, with `read` to read files.
fn left(groups: &str, mount: &Path, read: &impl Fn(&Path) -> String) -> Vec<(Limit, u64)> {
    let mut found = Vec::new();
    for line in groups.lines() {
        let mut parts = line.splitn(3, ':').skip(1);
        let (Some(controllers), Some(group)) = (parts.next(), parts.next()) else {
            continue;
        };
        let (names, root) = if controllers.is_empty() {
            (&SECOND, mount.to_owned())
        } else if controllers.split(',').any(|name| name == "memory") {
            (&FIRST, mount.join("memory"))
        } else {
            continue;
        };
        for folder in folders(&root, group) {
            of_folder(&folder, names, read, &mut found);
        }
    }
    found
}

/// The folders of a group and its ancestors. In a container, its own group may be mounted as the
/// root, so that the folder with the full name does not exist.
fn folders(root: &Path, group: &str) -> Vec<PathBuf> {
    let group = root.join(group.trim_start_matches('/'));
    let within = group.ancestors().take_while(|path| path.starts_with(root));
    within.map(Path::to_owned).collect()
}

fn of_folder(
    folder: &Path,
    names: &Names,
    read: &impl Fn(&Path) -> String,
    found: &mut Vec<(Limit, u64)>,
) {
    for &(name, limit) in names.limits {
        let value = read(&folder.join(name)).trim().parse();
        let Some(most) = value.ok().filter(|&most: &u64| most < UNLIMITED) else {
            continue;
        };
        let used: u64 = read(&folder.join(names.usage)).trim().parse().unwrap_or(0);
        let statistics = read(&folder.join("memory.stat"));
        let cached = names
            .cached
            .iter()
            .filter_map(|key| number(&statistics, key));
        let used = used.saturating_sub(cached.sum());
        found.push((limit, most.saturating_sub(used)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MB: u64 = 1 << 20;

    /// The available memory if these files exist below the mount.
    fn left_with(groups: &str, files: &[(&str, &str)]) -> Vec<(Limit, u64)> {
        let read = |path: &Path| {
            let found = files
                .iter()
                .find(|(name, _)| Path::new("/m").join(name) == path);
            found.map_or_else(String::new, |(_, text)| (*text).to_owned())
        };
        left(groups, Path::new("/m"), &read)
    }

    #[test]
    fn every_group_of_version_2_limits_memory() {
        let files = [
            ("a/b/memory.max", "104857600\n"),
            ("a/b/memory.high", "max\n"),
            ("a/b/memory.current", "62914560\n"),
            (
                "a/b/memory.stat",
                "anon 1\nfile 5\ninactive_file 10485760\nactive_file 10485760\n",
            ),
            ("a/memory.max", "max\n"),
            ("a/memory.high", "209715200\n"),
            ("a/memory.current", "209715201\n"),
        ];
        assert_eq!(
            left_with("0::/a/b\n", &files),
            [(Limit::Group, 60 * MB), (Limit::GroupHigh, 0)]
        );
    }

    #[test]
    fn a_group_of_version_1_limits_memory_unless_unlimited() {
        let groups = "5:cpu,cpuacct:/x\n4:memory:/docker/1\n1:name=systemd:/x\n0::/\n";
        let files = [
            ("memory/memory.limit_in_bytes", "104857600\n"),
            ("memory/memory.usage_in_bytes", "52428800\n"),
            ("memory/memory.stat", "total_inactive_file 1048576\n"),
        ];
        assert_eq!(left_with(groups, &files), [(Limit::Group, 51 * MB)]);
        let none = [("memory/memory.limit_in_bytes", "9223372036854771712\n")];
        assert_eq!(left_with(groups, &none), []);
    }

    #[test]
    fn malformed_lists_of_groups_give_no_limits() {
        for groups in ["", "0\n", "::", "x:y\n", "0::/../../etc\n"] {
            assert_eq!(left_with(groups, &[]), [], "{groups:?}");
        }
    }
}
