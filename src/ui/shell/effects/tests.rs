//! Effects that renderers perform.

use std::sync::mpsc;

use super::*;
use crate::layout::tests::size;
use crate::options::Rehearsal;
use crate::shell::job;
use scene::MAX_SPP;

/// A picture that would take minutes.
fn endless() -> Job {
    let mut job = job(MAX_SPP);
    job.settings.size = size(640, 480);
    job
}

/// What performs the effects of a script of keys.
fn page() -> (Runtime, Receiver<Event>) {
    let (sender, inbox) = mpsc::channel();
    let options = Options {
        rehearsal: Some(Rehearsal {
            keys: None,
            screen: (80, 24),
            frames: Vec::new(),
        }),
        ..Options::default()
    };
    let reader = SceneLoader::start(&options, sending(&sender)).expect("a thread");
    let runtime = Runtime::new(&options, reader, sender).expect("a page");
    (runtime, inbox)
}

#[test]
fn a_stopped_picture_ends_at_once_and_is_not_missed() {
    let (mut runtime, inbox) = page();
    let started = runtime.perform(Effect::Trace(Target::Thumbnail, endless()));
    assert!(matches!(started, Some(Msg::Started(Target::Thumbnail, _))));
    assert!(runtime.perform(Effect::Stop(Target::Thumbnail)).is_none());
    let ended = inbox.iter().find(|event| matches!(event, Event::Ended(..)));
    let ended = ended.expect("the renderer says that it has ended");
    assert!(matches!(ended, Event::Ended(Target::Thumbnail, 1)));
    assert!(runtime.message(ended).is_none());
}

#[test]
fn a_worker_that_panics_announces_its_end() {
    let (sender, inbox) = mpsc::channel();
    let waker = Waker {
        sender,
        target: Target::Export,
        number: 7,
    };
    let worker = thread::spawn(move || {
        waker.wake();
        panic!("on purpose");
    });
    assert!(worker.join().is_err());
    let events: Vec<_> = inbox.iter().collect();
    let [Event::Ready(_), Event::Ended(Target::Export, 7)] = events[..] else {
        panic!("{events:?}");
    };
}

/// A script of keys shows the same whatever earlier runs left, and leaves nothing.
#[test]
fn a_page_recalls_and_keeps_no_trace() {
    let (mut runtime, _inbox) = page();
    let job = endless();
    let origin = Origin {
        text: Arc::default(),
        found: BTreeMap::new(),
        view: scene::Viewpoint::default(),
    };
    let started = runtime.perform(Effect::Recall(job, origin, PathBuf::from("a.bmp")));
    assert!(matches!(started, Some(Msg::Started(Target::Trace, _))));
    let traced = runtime.traced.as_ref().expect("it is traced");
    assert!(!traced.was_looked_for());
    let none = Duration::ZERO;
    let deadlines = ShutdownDeadlines {
        terminal: none,
        files: none,
        trace: none,
    };
    assert_eq!(runtime.close(deadlines, None).1, TraceEnd::Nothing);
}
