//! Showing the user why something failed.

use super::Shared;
use text::Severity;

/// A result whose error is a reason to show.
pub(crate) trait Refusable<T> {
    /// The value; otherwise shows the reason as an error.
    fn or_fail(self, shared: &mut Shared) -> Option<T>;

    /// The value; otherwise shows the reason why something cannot be done with the picture.
    fn or_refuse_picture(self, shared: &mut Shared) -> Option<T>;
}

impl<T, E: ToString> Refusable<T> for Result<T, E> {
    fn or_fail(self, shared: &mut Shared) -> Option<T> {
        self.map_err(|reason| shared.fail(reason.to_string())).ok()
    }

    fn or_refuse_picture(self, shared: &mut Shared) -> Option<T> {
        let refused = |reason: E| shared.refuse_picture(Severity::Error, &reason.to_string());
        self.map_err(refused).ok()
    }
}
