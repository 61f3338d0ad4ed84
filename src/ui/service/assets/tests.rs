use std::collections::BTreeSet;
use std::fs::{self, Permissions};
use std::os::unix::fs::PermissionsExt;
use std::sync::mpsc;

use super::*;

/// A folder that may be searched but not listed cannot be watched.
#[test]
fn files_that_could_not_be_watched_are_retried() {
    let directory = tempfile::tempdir().expect("a directory");
    let allow = |mode| {
        let permissions = Permissions::from_mode(mode);
        fs::set_permissions(directory.path(), permissions).expect("its owner");
    };
    allow(0o300);
    if fs::read_dir(directory.path()).is_ok() {
        // Root is never refused.
        return;
    }
    let (sender, messages) = mpsc::channel();
    let send = move |msg| {
        let _ = sender.send(msg);
    };
    let mut work = AssetThread {
        assets: Assets::new(&[]),
        watching: Watching::new(Polled::Assets, Method::Native, send.clone()),
        send,
    };
    let wanted = Wanted {
        scene: directory.path().join("x.ray"),
        pictures: BTreeSet::from(["a.ppm".to_owned()]),
        meshes: BTreeSet::new(),
    };
    assert!(!work.watch(&wanted));
    assert!(matches!(messages.try_recv(), Ok(Msg::Failed(_))));
    allow(0o700);
    assert!(work.watch(&wanted));
    assert!(!work.watch(&wanted));
    assert!(messages.try_recv().is_err());
}
