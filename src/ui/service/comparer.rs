//! The threads that read references and measure how pictures differ from them: for large ones this
//! takes longer than a key may wait.

use std::io;
use std::path::PathBuf;
use std::sync::Arc;

use crate::assets::Assets;
use crate::ui::event::Work;
use crate::ui::msg::Msg;
use crate::ui::queue::{Ended, Service};
use crate::ui::reference::{Pair, ReferenceId, ReferenceSource};

/// Handle of the thread that reads references. Nothing waits for its end, as it has no work that
/// could be lost.
pub(crate) struct References(Service<(ReferenceId, ReferenceSource, Work)>);

impl References {
    /// Starts the thread, on which `send` is called. Pictures and meshes of scenes may be read from
    /// `folders` too.
    pub(crate) fn start(
        folders: &[PathBuf],
        send: impl Fn(Msg) + Send + 'static,
    ) -> io::Result<Self> {
        let folders = folders.to_vec();
        let service = Service::start("references", "reads references", move |inbox| {
            for request in inbox {
                let (id, source, work): (ReferenceId, ReferenceSource, Work) = request;
                send(Msg::ReferenceRead(
                    id,
                    source.read(&mut Assets::new(&folders)),
                ));
                drop(work);
            }
        });
        service.map(Self)
    }

    /// Reads a reference, reported by [`Msg::ReferenceRead`].
    pub(crate) fn request(
        &self,
        id: ReferenceId,
        source: ReferenceSource,
        work: Work,
    ) -> Result<(), Ended> {
        self.0.request((id, source, work))
    }
}

/// Handle of the thread that compares pictures. Nothing waits for its end, as it has no work that
/// could be lost.
pub(crate) struct Figures(Service<(Pair, Work)>);

impl Figures {
    /// Starts the thread, on which `send` is called.
    pub(crate) fn start(send: impl Fn(Msg) + Send + 'static) -> io::Result<Self> {
        let service = Service::start("figures", "compares pictures", move |inbox| {
            for request in inbox {
                let (pair, work): (Pair, Work) = request;
                let found = pair.compare().ok().map(Arc::new);
                send(Msg::Compared(pair, found));
                drop(work);
            }
        });
        service.map(Self)
    }

    /// Compares two pictures, reported by [`Msg::Compared`].
    pub(crate) fn request(&self, pair: Pair, work: Work) -> Result<(), Ended> {
        self.0.request((pair, work))
    }
}
