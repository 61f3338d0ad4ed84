//! Tests of the whole: of the program as it is run, of the library from text to pixels, and of the
//! sources. They are one binary, which is linked once: `cargo test --test it pty::` runs one module.
//!
//! Tests share a process, so none may change its environment, its current folder or its limits; the
//! programs that they start have folders and environments of their own.

mod cli;
mod conversions;
pub mod corpus;
mod cse167;
mod dat;
mod editor;
#[path = "../harness/mod.rs"]
mod harness;
mod making;
mod pictures;
mod pty;
mod readme;
mod rooms;
mod watch;
mod xml;
