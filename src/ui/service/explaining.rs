//! Explains pixels on a thread of its own: a ray tree may take longer than a key may wait.

use std::cell::RefCell;
use std::io;
use std::sync::Arc;

use super::answering::Answering;
use crate::event::Work;
use crate::msg::{Msg, Question};
use render::Frame;

/// A question, and the frame that it is about.
type Request = (Question, Arc<Frame>);

/// Starts the thread; `send` takes its answers. A question takes the place of those not answered yet, also
/// of one that is being answered.
pub(crate) fn explanations(send: impl Fn(Msg) + Send + 'static) -> io::Result<Answering<Request>> {
    Answering::start("explaining", "explains pixels", move |inbox| {
        let newer = RefCell::new(None);
        let is_outdated = || {
            let newest: Option<(Request, Work)> = inbox.try_iter().last();
            let mut newer = newer.borrow_mut();
            if newest.is_some() {
                *newer = newest;
            }
            newer.is_some()
        };
        while let Some(request) = newer.take().or_else(|| inbox.recv().ok()) {
            let ((question, frame), work) = request;
            let Question { pixel, sample, .. } = question;
            let query = frame.query.as_ref();
            let answer = query.and_then(|query| query.explain(pixel, sample, &is_outdated));
            if !is_outdated() {
                send(Msg::Explained(question, answer.map(Box::new)));
            }
            drop(work);
        }
    })
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc;

    use super::*;
    use crate::app::tests::frame_of;
    use crate::msg::Target;
    use crate::shell::job;
    use render::{NO_OBJECT, PreparedScene};

    #[test]
    fn the_last_question_is_answered() {
        let job = job(1);
        let prepared = PreparedScene::new(&job, &|| false).expect("it is not cancelled");
        let size = job.settings.size;
        let mut frame = frame_of(size, vec![NO_OBJECT; size.pixels()]);
        frame.query = Some(prepared.query().clone());
        let frame = Arc::new(frame);
        let (sender, answers) = mpsc::channel();
        let (events, _inbox) = mpsc::channel();
        let explainer = explanations(move |msg| {
            let _ = sender.send(msg);
        });
        let explainer = explainer.expect("a thread");
        for sample in 0..20 {
            let question = Question {
                target: Target::Preview,
                generation: frame.generation,
                pixel: [2, 2],
                sample,
            };
            let asked = explainer.ask((question, Arc::clone(&frame)), Work::begin(&events));
            asked.expect("the thread runs");
        }
        drop(explainer);
        let last = answers.iter().last();
        let Some(Msg::Explained(question, Some(answer))) = last else {
            panic!("{last:?}");
        };
        assert_eq!((question.sample, answer.sample), (19, 19));
    }
}
