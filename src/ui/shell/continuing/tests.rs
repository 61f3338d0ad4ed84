//! What is recalled, and what the picture that is kept is said to be made from.

use std::collections::BTreeMap;
use std::fs;

use super::*;
use crate::layout::tests::size;
use language::{Language, Source};
use render::{Frames, Settings, Threads};
use scene::{Images, Meshes, Rendering, Viewpoint};

/// A small picture with samples, of the template.
pub(crate) fn job(spp: u32) -> Job {
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
            ..Settings::new(size(5, 4), &Rendering::default())
        },
        scene: Arc::new(scene),
        images: Images::default(),
        limit: None,
        frames: Frames::Live,
        denoise: false,
        numbers: None,
    }
}

/// The complete picture of a job.
fn traced(job: &Job) -> Checkpoint {
    let (wake, woken) = mpsc::channel();
    let wake = move || {
        let _ = wake.send(());
    };
    let mut renderer = Renderer::new(Threads::Exactly(1), wake);
    renderer.restart(job.clone()).expect("the worker runs");
    loop {
        woken.recv().expect("the worker runs");
        let frame = renderer.latest();
        if frame.is_some_and(|frame| frame.progress.complete) {
            return renderer.into_checkpoint().expect("it is complete");
        }
    }
}

/// A state folder.
struct Place {
    folder: tempfile::TempDir,
    traces: Traces,
}

impl Place {
    fn new() -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        let traces = Traces::below(folder.path().to_owned());
        Self { folder, traces }
    }

    /// The only trace.
    fn file(&self) -> PathBuf {
        let traces = self.folder.path().join("halflight/traces");
        let entry = fs::read_dir(traces).expect("a folder").next();
        entry.expect("a trace").expect("an entry").path()
    }
}

fn far() -> Instant {
    Instant::now() + Duration::from_secs(60)
}

/// The origin of a text that the file names.
fn origin(place: &tempfile::TempDir, text: &str) -> Origin {
    let found = BTreeMap::from([("a.ppm".to_owned(), place.path().join("a.ppm"))]);
    Origin {
        text: Arc::new(text.to_owned()),
        found,
        view: Viewpoint::default(),
    }
}

struct Test {
    place: Place,
    files: tempfile::TempDir,
    job: Job,
}

impl Test {
    fn new() -> Self {
        let files = tempfile::tempdir().expect("a folder");
        fs::write(files.path().join("a.ppm"), "P3").expect("the folder is new");
        Self {
            place: Place::new(),
            files,
            job: job(4),
        }
    }

    /// What is reported to be left of a text, once nothing more comes, and whether it is brought.
    fn recall(&self, text: &str) -> (Traced, Option<Recalled>, bool) {
        let (report, reported) = mpsc::channel();
        let report = move |recalled| report.send(recalled).expect("it is awaited");
        let traces = Some(self.place.traces.clone());
        let beside = self.files.path().join("a.bmp");
        let found = Traced::recall(
            &self.job,
            origin(&self.files, text),
            (traces, beside),
            report,
        );
        let (traced, recalled) = found.expect("a thread");
        let is_brought = recalled.recv().is_ok();
        (traced, reported.recv().ok(), is_brought)
    }

    fn store(&self, traced: Traced, now: Option<(Arc<Scene>, Origin)>) -> Result<TraceEnd, String> {
        let kept = self::traced(&self.job);
        traced.store(&self.place.traces, &kept, now, far())
    }

    fn now(&self, text: &str) -> (Arc<Scene>, Origin) {
        (Arc::clone(&self.job.scene), origin(&self.files, text))
    }
}

const KEPT: TraceEnd = TraceEnd::Kept {
    spp: 4,
    goal: Some(4),
};

/// The text at the end.
#[derive(Clone, Copy, Debug)]
enum Now {
    /// The text of the scene that is traced.
    Traced(&'static str),
    /// The text of another scene.
    Other(&'static str),
    Errors,
}

/// A trace is recalled for the first text, or restarted after an edit.
#[test]
fn a_trace_is_kept_with_the_text_that_the_next_run_opens() {
    for (is_recalled, now, expected) in [
        (true, Now::Traced("first"), Some("first")),
        (true, Now::Traced("commented"), Some("commented")),
        (true, Now::Other("other"), Some("first")),
        (true, Now::Errors, Some("first")),
        (false, Now::Traced("edited"), Some("edited")),
        (false, Now::Errors, None),
    ] {
        let test = Test::new();
        let recalled = is_recalled.then(|| test.recall("first").0);
        let traced = recalled.unwrap_or_else(|| Traced::of(&test.job));
        let text = match now {
            Now::Traced(text) => Some(test.now(text)),
            Now::Other(text) => {
                let (scene, origin) = test.now(text);
                Some((Arc::new(Scene::clone(&scene)), origin))
            }
            Now::Errors => None,
        };
        let end = test.store(traced, text);
        let Some(expected) = expected else {
            assert_eq!(end, Err("the text has errors".to_owned()));
            continue;
        };
        assert_eq!(end, Ok(KEPT), "{now:?}");
        for text in ["first", "commented", "edited", "other"] {
            let (_, reported, is_brought) = test.recall(text);
            let is_expected = text == expected;
            let continued = Some(Recalled::Continued(4)).filter(|_| is_expected);
            assert_eq!((reported, is_brought), (continued, is_expected), "{now:?}");
        }
    }
}

#[test]
fn files_count_as_they_were_when_the_trace_began() {
    let test = Test::new();
    let (traced, ..) = test.recall("first");
    let picture = test.files.path().join("a.ppm");
    fs::write(&picture, "P6").expect("it is ours");
    assert_eq!(test.store(traced, Some(test.now("first"))), Ok(KEPT));
    assert_eq!(test.recall("first").1, None, "the picture is another");
    fs::write(&picture, "P3").expect("it is ours");
    assert_eq!(test.recall("first").1, Some(Recalled::Continued(4)));
    fs::remove_file(&picture).expect("it is there");
    assert_eq!(test.recall("first").1, None, "the picture is gone");
}

#[test]
fn what_cannot_be_continued_is_reported() {
    let mut test = Test::new();
    test.store(test.recall("first").0, None)
        .expect("it is kept");
    test.job.settings.spp = 2;
    let (_, reported, is_brought) = test.recall("first");
    assert_eq!((reported, is_brought), (Some(Recalled::More(4)), false));
    test.job.settings.spp = 4;
    fs::write(test.place.file(), "damaged").expect("it is ours");
    let (_, reported, is_brought) = test.recall("first");
    assert!(matches!(reported, Some(Recalled::Unreadable(_))) && !is_brought);
}

#[test]
fn the_cost_is_seen_of_the_picture_of_light() {
    use render::Aov;
    let mut test = Test::new();
    test.store(test.recall("first").0, None)
        .expect("it is kept");
    for aov in [Aov::Cost, Aov::Noise] {
        test.job.settings.aov = Some(aov);
        assert_eq!(test.recall("first").1, Some(Recalled::Continued(4)));
    }
    test.job.settings.aov = Some(Aov::Albedo);
    assert_eq!(test.recall("first").1, None);
}

/// Whether it has more or fewer samples than a trace.
#[test]
fn the_part_beside_the_picture_is_continued() {
    use shards::{Header, Part};
    let test = Test::new();
    let digest = FileDigests::of(&origin(&test.files, "").found);
    let digest = digest.expect("it is there").fingerprint("first");
    let write = |name: &str, depth: u32| {
        let mut job = test.job.clone();
        job.settings.depth = depth;
        let header = Header {
            picture: Provenance::of(&job, digest.clone()),
            shard: Shard::WHOLE,
        };
        let part = Part::create(&test.files.path().join(name), &header);
        let mut part = part.expect("it is new");
        part.aim(4).expect("it is written");
        for block in traced(&test.job).blocks() {
            part.put(block).expect("it is written");
        }
    };
    write("b.part", 4);
    assert_eq!(test.recall("first").1, None, "it is beside another");
    write("a.part", 4);
    assert_eq!(test.recall("first").1, Some(Recalled::Continued(4)));
    assert_eq!(test.recall("other").1, None, "the text is another");
    fs::remove_file(test.files.path().join("a.part")).expect("it is there");
    write("a.part", 5);
    assert_eq!(test.recall("first").1, None, "the settings are others");
}

/// A trace that took seconds only is not worth a file.
#[test]
fn a_short_trace_is_not_kept() {
    let test = Test::new();
    let mut renderer = Renderer::new(Threads::Exactly(1), || {});
    renderer.restart(test.job.clone()).expect("the worker runs");
    let keeping = Traced::of(&test.job).keep(renderer, Some(test.now("first")), far());
    assert_eq!(keeping.finish(), TraceEnd::Nothing);
}
