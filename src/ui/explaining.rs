//! Explains pixels on a thread of its own: a ray tree may take longer than a key may wait.

use std::cell::RefCell;
use std::io;
use std::sync::Arc;

use super::event::Work;
use super::msg::{Msg, Question};
use super::service::{Ended, Service};
use crate::render::Frame;

/// Handle of the thread that explains pixels.
pub(crate) struct Explainer(Service<Request>);

/// A question, the frame that it is about, and the work that is done with the answer.
struct Request {
    question: Question,
    frame: Arc<Frame>,
    _work: Work,
}

impl Explainer {
    /// Starts the thread; `send` takes its answers.
    pub(crate) fn start(send: impl Fn(Msg) + Send + 'static) -> io::Result<Self> {
        let service = Service::start("explaining", "explains pixels", move |inbox| {
            let newer = RefCell::new(None);
            let is_outdated = || {
                let newest: Option<Request> = inbox.try_iter().last();
                let mut newer = newer.borrow_mut();
                if newest.is_some() {
                    *newer = newest;
                }
                newer.is_some()
            };
            while let Some(request) = newer.take().or_else(|| inbox.recv().ok()) {
                let Request {
                    question, frame, ..
                } = &request;
                let Question { pixel, sample, .. } = *question;
                let query = frame.query.as_ref();
                let answer = query.and_then(|query| query.explain(pixel, sample, is_outdated));
                if !is_outdated() {
                    send(Msg::Explained(*question, answer.map(Box::new)));
                }
            }
        })?;
        Ok(Self(service))
    }

    /// Asks a question in place of those not answered yet.
    pub(crate) fn ask(
        &self,
        question: Question,
        frame: Arc<Frame>,
        work: Work,
    ) -> Result<(), Ended> {
        self.0.request(Request {
            question,
            frame,
            _work: work,
        })
    }
}
