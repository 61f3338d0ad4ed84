//! Several writers of one file.

use std::sync::mpsc;
use std::thread;

use super::*;
use crate::lock::{Lock, lock};

/// The second must not look before the first, which has looked already, has written.
#[test]
fn of_two_writers_each_sees_what_the_one_before_has_written() {
    let directory = directory();
    let path = &directory.path().join("s");
    fs::write(path, "old").expect("written");
    let (start, started) = mpsc::channel();
    let (begin, begun) = mpsc::channel();
    thread::scope(|scope| {
        let second = scope.spawn(move || {
            started.recv().expect("the first looks");
            let mut write = |out: &mut dyn Write| {
                begin.send(()).expect("the first waits");
                out.write_all(b"second")
            };
            replace(path, &mut write, &|| Err(io::Error::other(content(path))))
        });
        let looks = || {
            let file = File::open(path).expect("a file");
            assert_eq!(lock(&file), Lock::Busy);
            start.send(()).expect("the second waits");
            begun.recv().expect("the second begins");
            Ok::<_, io::Error>(())
        };
        replace(path, &mut |out| out.write_all(b"first"), &looks).expect("nobody else writes");
        let saw = second.join().expect("no panic").expect_err("it only looks");
        assert_eq!(saw.to_string(), "first");
    });
}
