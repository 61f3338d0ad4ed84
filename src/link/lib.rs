//! The socket between an editor's language server and the interface that shows the same scene, and the
//! messages on it. Knows neither editors' protocols nor pictures.
//!
//! The interface listens, on one Unix socket for each scene; the server connects. Each message is a JSON
//! object on a line of its own.

mod listening;
mod messages;
mod place;
mod stream;
#[cfg(test)]
mod tests;

pub use listening::{Heard, Listening, listen};
pub use messages::{Abilities, Follow, Opening, Shown, ToEditor, ToInterface};
pub use place::{Place, sockets};
pub use stream::{Receiver, Sender, connect, shown};
