//! The names of the lists of finished frames beside the pictures of a sequence.

use std::fs;
use std::path::PathBuf;

use file::directory_of;
use image_file::Pattern;
use shards::Shard;

/// The path of the list of a process, such as `turn.frames` beside `turn.%05d.png`, one for each shard:
/// processes on several machines do not append to the same file.
pub(super) fn list(pattern: &Pattern, shard: Shard) -> PathBuf {
    let stem = pattern.stem();
    let Shard { index, count } = shard;
    pattern.beside(match count {
        1 => format!("{stem}.frames"),
        _ => format!("{stem}.{index}-{count}.frames"),
    })
}

/// The paths of the lists that there are, of all shards.
pub(super) fn lists(pattern: &Pattern) -> Vec<PathBuf> {
    let Ok(entries) = fs::read_dir(directory_of(&pattern.path(0))) else {
        return Vec::new();
    };
    let names = entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok());
    let lists = names.filter(|name| {
        let rest = name.strip_prefix(pattern.stem());
        let shard = rest.and_then(|rest| rest.strip_suffix(".frames"));
        shard.is_some_and(|shard| {
            let shard = shard
                .strip_prefix('.')
                .map(|shard| shard.replacen('-', "/", 1));
            shard.is_none_or(|shard| Shard::parse(&shard).is_some())
        })
    });
    lists.map(|name| pattern.beside(name)).collect()
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    #[test]
    fn lists_are_named_after_the_pictures() {
        let shard = Shard { index: 1, count: 4 };
        for (pattern, whole, of_shard) in [
            ("a/turn.%05d.png", "a/turn.frames", "a/turn.1-4.frames"),
            ("%03d.bmp", "frames.frames", "frames.1-4.frames"),
        ] {
            let pattern = Pattern::of(Path::new(pattern)).expect("a pattern");
            assert_eq!(list(&pattern, Shard::WHOLE), Path::new(whole));
            assert_eq!(list(&pattern, shard), Path::new(of_shard));
        }
    }
}
