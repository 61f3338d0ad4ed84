//! Part files: what is written is read, and nothing else is taken for it.

use std::fs;
use std::path::PathBuf;

use glam::DVec3;
use tempfile::TempDir;

use super::*;
use render::{Block, Blocks, Counts, Frames, PixelHistory, Provenance, Settings};
use scene::{Rendering, Size, Viewpoint};

const SIZE: Size = Size {
    width: 40,
    height: 6,
};

fn header(shard: &str) -> Header {
    Header {
        picture: picture(),
        shard: Shard::parse(shard).expect("a shard"),
    }
}

fn picture() -> Provenance {
    Provenance {
        version: "1.2.3".to_owned(),
        scene: "ab12".to_owned(),
        view: Viewpoint::default(),
        layers: Vec::new(),
        denoise: false,
        settings: Settings {
            spp: 1,
            ..Settings::new(SIZE, &Rendering::default())
        },
    }
}

/// A block whose pixels are told apart by their sums.
fn block(number: u32, samples: u32) -> Block {
    let blocks = Blocks::of(SIZE);
    let area = blocks.area(number);
    let sum =
        |at: usize| DVec3::new(number.into(), at as f64 / area as f64, 0.25) * f64::from(samples);
    let sums: Vec<_> = (0..area).map(sum).collect();
    Block {
        samples,
        apart: if number == 1 {
            (0..64).collect()
        } else {
            Vec::new()
        },
        histories: if number == 1 {
            let touched = |at: usize| 1 << (at % 64);
            let history = |at| PixelHistory {
                touched: touched(at),
                rays: at as u32,
            };
            (0..area).map(history).collect()
        } else {
            Vec::new()
        },
        variances: vec![0.25; area],
        objects: (0..area as u32).collect(),
        half: if samples.is_power_of_two() {
            Vec::new()
        } else {
            sums.clone()
        },
        squared_errors: vec![0.5; area],
        counts: Counts {
            rays: 10,
            shadow_rays: 4,
            over_budget: 1,
        },
        sums,
        number,
    }
}

/// Writes a whole part; returns its file.
fn part(folder: &TempDir, shard: &str, samples: u32) -> PathBuf {
    let header = header(shard);
    let path = path_beside(&folder.path().join("out.png"), header.shard);
    let mut part = Part::create(&path, &header).expect("it is new");
    part.aim(samples).expect("it is written");
    for number in header.shard.blocks(Blocks::of(SIZE)) {
        part.put(block(number, samples)).expect("it is written");
    }
    part.sync().expect("it is written");
    path
}

fn folder() -> TempDir {
    tempfile::tempdir().expect("a folder")
}

fn error(parts: &[PathBuf]) -> String {
    let merged = merge(parts, Frames::Last);
    merged.expect_err("they cannot be merged").to_string()
}

#[test]
fn parts_are_named_after_the_picture() {
    for (shard, name) in [("0/1", "a/out.part"), ("3/8", "a/out.3-8.part")] {
        let shard = Shard::parse(shard).expect("a shard");
        assert_eq!(
            path_beside("a/out.png".as_ref(), shard),
            PathBuf::from(name)
        );
    }
}

#[test]
fn parts_make_a_picture_in_any_order() {
    let folder = folder();
    let mut parts = [part(&folder, "0/2", 4), part(&folder, "1/2", 4)];
    for _ in 0..2 {
        let merged = merge(&parts, Frames::LastWithValues).expect("they are complete");
        assert_eq!(merged.picture.settings.spp, 4);
        assert_eq!(merged.frame.values[0], [0.0, 0.0, 0.25]);
        assert_eq!(merged.frame.values[33], [1.0, 1.0 / 48.0, 0.25]);
        assert_eq!(merged.frame.progress.rays, 20);
        assert!(missing(&parts).expect("they are parts").0.is_empty());
        parts.reverse();
    }
}

/// What was written can be continued, from its last record on.
#[test]
fn a_part_is_continued_where_it_ended() {
    let folder = folder();
    let path = part(&folder, "0/1", 3);
    let complete = fs::read(&path).expect("it is there");
    let header = header("0/1");
    let lengths = (0..=complete.len()).rev().step_by(97);
    for length in lengths.chain([0, 5, header.text().0.len() - 1]) {
        fs::write(&path, &complete[..length]).expect("it is written");
        let mut part = Part::open(&path, &header).expect("it is continued");
        let kept = fs::metadata(&path).expect("it is there").len();
        let cut_in_header = length < header.text().0.len();
        assert!(cut_in_header || kept + part.cut() == length as u64);
        part.aim(3).expect("it is written");
        for number in 0..2 {
            if part.samples(number) == 0 {
                part.put(block(number, 3)).expect("it is written");
            }
            assert_eq!(part.block(number).expect("it is there"), block(number, 3));
        }
        drop(part);
        assert!(
            fs::read(&path).expect("it is there") == complete,
            "{length}"
        );
    }
}

#[test]
fn later_records_replace_earlier_ones() {
    let folder = folder();
    let path = part(&folder, "0/1", 1);
    let mut part = Part::open(&path, &header("0/1")).expect("it is continued");
    part.aim(8).expect("it is written");
    part.put(block(1, 8)).expect("it is written");
    assert_eq!(
        error(std::slice::from_ref(&path)),
        "incomplete: 1 of 2 blocks is missing; rerun the render with --resume"
    );
    part.put(block(0, 5)).expect("it is written");
    assert_eq!(part.block(0).expect("it is there"), block(0, 5));
    part.put(block(0, 8)).expect("it is written");
    let merged = merge(&[path], Frames::Last).expect("it is complete");
    assert_eq!(merged.frame.progress.spp, 8);
}

/// Every byte is protected: those of the header, of every record, and of every checksum.
#[test]
fn a_flipped_byte_is_found_wherever_it_is() {
    let folder = folder();
    let paths = [part(&folder, "0/2", 1), part(&folder, "1/2", 3)];
    for (at, path) in paths.iter().enumerate() {
        let good = fs::read(path).expect("it is there");
        for byte in 0..good.len() {
            let mut bad = good.clone();
            bad[byte] ^= 1 << (byte % 8);
            fs::write(path, &bad).expect("it is written");
            let said = error(&paths[at..=at]);
            let named = ["is not a part", "is damaged", "ends early"]
                .iter()
                .any(|what| said.starts_with(&format!("{} {what}", path.display())));
            assert!(named, "byte {byte}: {said}");
        }
        fs::write(path, &good).expect("it is written");
    }
}

#[test]
fn parts_of_different_samples_name_who_has_fewer() {
    let folder = folder();
    let parts =
        ["0/2", "1/2"].map(|shard| part(&folder, shard, if shard == "0/2" { 4 } else { 8 }));
    let [fewer, more] = [0, 1].map(|at: usize| parts[at].display());
    assert_eq!(
        error(&parts),
        format!(
            "{fewer} has 4 spp and {more} has 8 spp; rerun shard 0 (of 2) with --spp 8 --resume"
        )
    );
    let (shards, _) = missing(&parts).expect("they are parts");
    assert_eq!(ranges(&shards), "0");
}

#[test]
fn what_lacks_is_named() {
    let folder = folder();
    let parts: Vec<_> = ["0/3", "1/3"].map(|shard| part(&folder, shard, 2)).into();
    let (shards, damaged) = missing(&parts[1..]).expect("it is a part");
    assert_eq!((ranges(&shards), damaged.len()), ("0".to_owned(), 0));
    // A shard without blocks lacks none, and its part need not be there.
    assert!(merge(&parts, Frames::Last).is_ok());
    let good = fs::read(&parts[0]).expect("it is there");
    for (length, expected) in [
        (good.len() - 1, "ends early, in the record at byte"),
        (90, "is not a part file"),
    ] {
        fs::write(&parts[0], &good[..length]).expect("it is written");
        assert!(error(&parts).contains(expected), "{}", error(&parts));
        let (shards, damaged) = missing(&parts).expect("they are parts");
        assert_eq!((ranges(&shards), damaged.len()), ("0".to_owned(), 1));
    }
    for (numbers, said) in [
        (&[][..], ""),
        (&[3], "3"),
        (&[0, 1, 2, 7, 9, 10], "0-2,7,9-10"),
    ] {
        assert_eq!(ranges(numbers), said);
    }
}

#[test]
fn parts_of_different_pictures_are_refused() {
    let folder = folder();
    let first = part(&folder, "0/2", 1);
    let other = |header: Header| {
        let path = folder.path().join("other.part");
        let _ = fs::remove_file(&path);
        Part::create(&path, &header).expect("it is new");
        path
    };
    let same = header("1/2");
    let with = |picture| Header {
        picture,
        ..same.clone()
    };
    let cases = [
        (
            with(Provenance {
                version: "1.2.4".to_owned(),
                ..picture()
            }),
            "version 1.2.4 and 1.2.3",
        ),
        (
            with(Provenance {
                scene: "ab13".to_owned(),
                ..picture()
            }),
            "scene ab13 and ab12",
        ),
        (
            with(Provenance {
                view: Viewpoint::parse("eye 1 2 3").expect("a view"),
                ..picture()
            }),
            "view eye 1 2 3 and own",
        ),
        (header("1/3"), "number of shards 3 and 2"),
        (
            with(Provenance {
                settings: Settings {
                    seed: 1,
                    ..picture().settings
                },
                ..picture()
            }),
            "seed 1 and 0",
        ),
        (header("0/2"), "are both shard 0/2"),
    ];
    for (header, expected) in cases {
        let path = other(header.clone());
        let said = error(&[first.clone(), path.clone()]);
        assert!(said.contains(expected), "{said}");
        let refused = Part::open(&path, &same).expect_err("it belongs to another");
        assert!(matches!(refused, Refused::Other(_)), "{refused}");
    }
}

#[test]
fn a_part_has_one_writer_and_is_not_replaced() {
    let folder = folder();
    let path = part(&folder, "0/1", 1);
    let header = header("0/1");
    assert!(matches!(Part::create(&path, &header), Err(Refused::Exists)));
    let writer = Part::open(&path, &header).expect("it is continued");
    assert!(matches!(Part::open(&path, &header), Err(Refused::Busy)));
    drop(writer);
    // Another text, and the beginning of another shard's header.
    let (other, _) = self::header("0/2").text();
    for text in ["no part\n", "halflight part 3", &other[..other.len() - 14]] {
        fs::write(&path, text).expect("it is written");
        assert!(matches!(Part::open(&path, &header), Err(Refused::NoPart)));
        assert_eq!(fs::read(&path).expect("it is there"), text.as_bytes());
    }
}

/// A part of the first form, and a trace of the interface.
#[test]
fn earlier_forms_are_refused_by_name_and_left_alone() {
    let folder = folder();
    let header = header("0/1");
    let path = path_beside(&folder.path().join("out.png"), header.shard);
    for form in ["halflight part 1", "halflight trace 2"] {
        let text = format!("{form}\nversion 0.1.0\nscene ab12\nview own\n\0");
        fs::write(&path, &text).expect("it is written");
        let said = format!(
            "was written by an earlier build of version 0.1.0 in a form that is no longer read \
             ({form}); finish it with that build, or delete it"
        );
        let refused = Part::open(&path, &header).expect_err("its form is another");
        assert_eq!(refused.to_string(), format!("it {said}"));
        let merged = error(std::slice::from_ref(&path));
        assert_eq!(merged, format!("{} {said}", path.display()));
        assert_eq!(fs::read_to_string(&path).expect("it is there"), text);
    }
}
