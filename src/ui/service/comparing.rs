//! The threads that read references and measure how pictures differ from them: for large ones this
//! takes longer than a key may wait. Nothing waits for their ends, as they have no work that could be
//! lost.

use std::io;
use std::path::PathBuf;
use std::sync::Arc;

use super::answering::Answering;
use crate::msg::Msg;
use crate::reference::{Pair, ReferenceId, ReferenceSource};
use assets::{Assets, Up};

/// Starts the thread that reads references, reported by [`Msg::ReferenceRead`]; `send` is called on it.
/// Pictures and meshes of scenes may be read from `folders` too; `up` is the upward axis of a mesh.
pub(crate) fn references(
    folders: &[PathBuf],
    up: Option<Up>,
    send: impl Fn(Msg) + Send + 'static,
) -> io::Result<Answering<(ReferenceId, ReferenceSource)>> {
    let folders = folders.to_vec();
    Answering::each("references", "reads references", move |(id, source)| {
        let source: ReferenceSource = source;
        let read = source.read(&mut Assets::new(&folders), up);
        send(Msg::ReferenceRead(id, read));
    })
}

/// Starts the thread that compares pictures, reported by [`Msg::Compared`]; `send` is called on it.
pub(crate) fn figures(send: impl Fn(Msg) + Send + 'static) -> io::Result<Answering<Pair>> {
    Answering::each("figures", "compares pictures", move |pair: Pair| {
        let found = pair.compare().ok().map(Arc::new);
        send(Msg::Compared(pair, found));
    })
}
