//! What the server answers about an open text.

pub(crate) mod actions;
pub(crate) mod colours;
pub(crate) mod completion;
pub(crate) mod diagnostics;
pub(crate) mod hints;
pub(crate) mod hover;
pub(crate) mod names;
pub(crate) mod outline;
pub(crate) mod tokens;
