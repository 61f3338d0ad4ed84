//! Files of kept traces.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use tempfile::TempDir;

use super::*;
use language::{Language, Source};
use render::{Block, Blocks, Frames, Job, Settings};
use scene::{Images, Meshes, Rendering, Size, Viewpoint};

const SIZE: Size = Size {
    width: 5,
    height: 4,
};

/// A small picture with samples, of the template.
fn job(spp: u32) -> Job {
    let text = Arc::new(Language::Ray.template().to_owned());
    let lowered = Source::new(Language::Ray, text).lower(&Meshes::default());
    let scene = lowered.expect("there is memory").scene;
    let scene = scene.expect("it is valid");
    Job {
        camera: scene.camera,
        settings: Settings {
            spp,
            depth: 4,
            transfer: scene.setting.rendering.transfer(),
            ..Settings::new(SIZE, &Rendering::default())
        },
        scene: Arc::new(scene),
        images: Images::default(),
        limit: None,
        frames: Frames::Live,
        denoise: false,
        numbers: None,
    }
}

/// A complete picture of a job.
fn traced(job: &Job) -> Checkpoint {
    let block = Block {
        samples: job.settings.spp,
        variances: vec![0.5; 20],
        ..Block::new(0, Blocks::of(SIZE))
    };
    Checkpoint::of([Ok(block)], Duration::from_secs(20), job).expect("it is a picture of the job")
}

fn picture(job: &Job) -> Provenance {
    Provenance::of(job, "c0ffee".to_owned())
}

fn far() -> Instant {
    Instant::now() + Duration::from_secs(60)
}

struct Place {
    folder: TempDir,
    traces: Traces,
}

impl Place {
    fn new() -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        let traces = Traces::below(folder.path().to_owned());
        Self { folder, traces }
    }

    /// The folder of traces.
    fn kept(&self) -> PathBuf {
        self.folder.path().join("halflight/traces")
    }

    /// The files, sorted.
    fn files(&self) -> Vec<PathBuf> {
        let entries = fs::read_dir(self.kept()).into_iter().flatten();
        let paths = entries.map(|entry| entry.expect("an entry").path());
        paths.collect::<BTreeSet<_>>().into_iter().collect()
    }

    /// The path of a file.
    fn at(&self, name: &str) -> PathBuf {
        self.kept().join(name)
    }

    /// The path of the trace of a picture.
    fn place(&self, picture: &Provenance) -> PathBuf {
        self.at(&name(picture))
    }

    fn write(&self, job: &Job, kept: &Checkpoint) {
        let written = self.traces.write(&picture(job), kept, far());
        written.expect("it is written");
    }

    /// The mean samples of the trace kept of a picture.
    fn read(&self, picture: &Provenance) -> Option<u32> {
        let found = self.traces.find(picture).expect("it can be read");
        found.map(|contents| (contents.all_taken() / SIZE.pixels() as u64) as u32)
    }
}

#[test]
fn a_trace_is_read_back_for_the_same_picture_only() {
    use std::os::unix::fs::PermissionsExt;
    type Change = fn(&mut Provenance);
    let (place, first) = (Place::new(), job(4));
    let found = place.read(&picture(&first));
    assert_eq!(found, None, "there is no folder");
    place.write(&first, &traced(&first));
    for spp in [1, 4, 100] {
        let same = job(spp);
        assert_eq!(place.read(&picture(&same)), Some(4));
    }
    for change in [
        (|own| own.version = "0.0.0".to_owned()) as Change,
        |own| own.scene = "c0ffef".to_owned(),
        |own| own.view = Viewpoint::parse("fov 50").expect("a view"),
        |own| own.settings.depth = 5,
    ] {
        let mut other = picture(&first);
        change(&mut other);
        assert_eq!(place.read(&other), None, "{other:?}");
    }
    let folder = fs::metadata(place.kept()).expect("a folder");
    let mode = folder.permissions().mode();
    assert_eq!(mode & 0o777, 0o700);
}

#[test]
fn a_damaged_file_is_refused_and_removed() {
    let (place, job) = (Place::new(), job(1));
    place.write(&job, &traced(&job));
    let path = place.files().remove(0);
    let bytes = fs::read(&path).expect("it is there");
    let is_refused = |bytes: &[u8]| {
        fs::write(&path, bytes).expect("it is ours");
        let read = place.traces.find(&picture(&job));
        matches!(read, Err(NoTrace::Damaged)) && !path.exists()
    };
    for at in KIND.len()..bytes.len() {
        let mut damaged = bytes.clone();
        damaged[at] ^= 1;
        assert!(is_refused(&damaged), "byte {at}");
        if at % 50 == KIND.len() {
            assert!(is_refused(&bytes[..at]), "{at} bytes");
        }
    }
    assert!(is_refused(&[&bytes[..], b"\0"].concat()), "a byte more");
    fs::write(&path, &bytes).expect("it is ours");
    assert_eq!(place.read(&picture(&job)), Some(1));
}

/// One that an earlier version kept of the same film.
#[test]
fn a_trace_of_an_earlier_form_is_named_and_left_alone() {
    let (place, job) = (Place::new(), job(1));
    place.write(&job, &traced(&job));
    let lines = picture(&job).of_film().lines();
    let head = format!("halflight trace 2\n{lines}");
    let old = place.at(&format!("{}{OLD_END}", digits(&head)));
    fs::write(&old, format!("{head}samples 20\n\0")).expect("the folder is there");
    assert_eq!(place.read(&picture(&job)), Some(1));
    fs::remove_file(place.place(&picture(&job))).expect("it is there");
    let error = place.traces.find(&picture(&job));
    let said = error.expect_err("its form is another").to_string();
    let named = format!(
        "the full-size trace {} was written by an earlier",
        old.display()
    );
    assert!(said.starts_with(&named), "{said}");
    overfill(&place);
    assert!(old.exists());
}

#[test]
fn more_samples_are_not_replaced_by_fewer() {
    let (place, few, many) = (Place::new(), job(2), job(8));
    place.write(&few, &traced(&few));
    place.write(&many, &traced(&many));
    place.write(&few, &traced(&few));
    assert_eq!(place.read(&picture(&few)), Some(8));
    assert_eq!(place.files().len(), 1);
}

#[test]
fn a_trace_that_takes_too_long_to_write_leaves_what_was_there() {
    let (place, few, many) = (Place::new(), job(2), job(8));
    for _ in 0..2 {
        let (more, kept) = (picture(&many), traced(&many));
        let late = place.traces.write(&more, &kept, Instant::now());
        let error = late.expect_err("the time is over");
        assert_eq!(error.kind(), ErrorKind::TimedOut);
        assert!(place.files().len() <= 1);
        place.write(&few, &traced(&few));
        assert_eq!(place.read(&picture(&few)), Some(2));
    }
}

/// The job of another picture.
fn with_depth(job: &Job, depth: u32) -> Job {
    let mut job = job.clone();
    job.settings.depth = depth;
    job
}

fn set_modified(path: &Path, at: SystemTime) {
    let file = File::options().write(true).open(path);
    let changed = file.and_then(|file| file.set_modified(at));
    changed.expect("it is ours");
}

#[test]
fn the_newest_files_are_kept() {
    let (place, first) = (Place::new(), job(1));
    let kept = traced(&first);
    let path = |depth| place.place(&picture(&with_depth(&first, depth)));
    let date = |depth: u32| {
        let at = SystemTime::UNIX_EPOCH + Duration::from_secs(depth.into());
        set_modified(&path(depth), at);
    };
    for depth in 1..=5 {
        place.write(&with_depth(&first, depth), &kept);
        date(depth);
    }
    let left = || -> Vec<u32> {
        let read = |&depth: &u32| place.read(&picture(&with_depth(&first, depth)));
        (1..=7).filter(|depth| read(depth).is_some()).collect()
    };
    assert_eq!(left(), [2, 3, 4, 5]);
    // The newest but one is very large, and the others are beyond the limit with it.
    let file = File::options().write(true).open(path(5)).expect("a file");
    file.set_len(MOST_BYTES - 40_000).expect("it is sparse");
    date(5);
    place.write(&with_depth(&first, 6), &kept);
    assert!(path(6).exists() && path(5).exists());
    assert_eq!(place.files().len(), 4);
    file.set_len(MOST_BYTES).expect("it is sparse");
    date(5);
    place.write(&with_depth(&first, 7), &kept);
    assert_eq!(left(), [6, 7]);
}

/// The most traces are written, so that the oldest are removed.
fn overfill(place: &Place) {
    let first = job(1);
    let kept = traced(&first);
    for depth in 1..=MOST as u32 + 2 {
        place.write(&with_depth(&first, depth), &kept);
    }
}

#[test]
fn files_of_others_are_neither_removed_nor_replaced() {
    use std::os::unix::fs::symlink;
    let (place, first) = (Place::new(), job(1));
    place.write(&first, &traced(&first));
    let hex = |digit: &str| digit.repeat(DIGITS);
    let outside = place.folder.path().join("precious");
    fs::write(&outside, "halflight part 2\nmine").expect("the folder is new");
    symlink(&outside, place.at(&format!("{}.part", hex("a")))).expect("it is new");
    fs::create_dir(place.at(&format!("{}.part", hex("b")))).expect("it is new");
    let foreign = [
        ("run.part".to_owned(), "halflight part 2\n"),
        (format!("{}.part", hex("c")), "mine"),
        (format!("{}.part", hex("d")), ""),
        (format!("{}.part", hex("g")), "halflight part 2\n"),
        (format!("{}.part.1.new", hex("e")), "mine"),
    ];
    for (name, text) in &foreign {
        fs::write(place.at(name), text).expect("it is new");
    }
    overfill(&place);
    for (name, text) in &foreign {
        assert_eq!(&fs::read_to_string(place.at(name)).expect(name), text);
    }
    assert_eq!(place.files().len(), foreign.len() + 2 + MOST);
    assert!(outside.exists());

    // Neither is one that has the name of the picture.
    let own = place.place(&picture(&first));
    for plant in [
        (|own, _| fs::write(own, "mine")) as fn(&Path, &Path) -> io::Result<()>,
        |own, outside| symlink(outside, own),
    ] {
        let _ = fs::remove_file(&own);
        plant(&own, &outside).expect("it is free");
        let written = place.traces.write(&picture(&first), &traced(&first), far());
        written.expect_err("it is not ours");
        let read = place.traces.find(&picture(&first));
        assert!(matches!(read, Err(NoTrace::Io(_))));
        assert!(own.symlink_metadata().is_ok());
    }
}

#[test]
fn a_folder_that_leads_elsewhere_is_not_used() {
    let (place, job) = (Place::new(), job(1));
    place.write(&job, &traced(&job));
    let away = place.folder.path().join("away");
    fs::rename(place.kept(), &away).expect("it is ours");
    std::os::unix::fs::symlink(&away, place.kept()).expect("it is free");
    let read = place.traces.find(&picture(&job));
    assert!(matches!(read, Err(NoTrace::Io(_))));
    let written = place.traces.write(&picture(&job), &traced(&job), far());
    let reason = written.expect_err("it is a link").to_string();
    assert!(reason.contains("traces is a symbolic link"), "{reason}");
}

#[test]
fn what_a_crash_left_behind_is_removed_after_an_hour() {
    let (place, first) = (Place::new(), job(1));
    place.write(&first, &traced(&first));
    let name = |digit: &str| place.at(&format!("{}.part.7.new", digit.repeat(DIGITS)));
    for (digit, hours) in [("a", 0), ("b", 2)] {
        fs::write(name(digit), "halflight part 2\n").expect("it is new");
        let age = Duration::from_secs(hours * 3600);
        set_modified(&name(digit), SystemTime::now() - age);
    }
    overfill(&place);
    assert_eq!([name("a").exists(), name("b").exists()], [true, false]);
}
