//! Halflight: a progressive ray tracer that lives in the terminal.
//!
//! # The one idea
//!
//! The text is the truth. A scene is a text file; the tree is a view of the text, the scene a
//! meaning of the tree, the picture a consequence of the scene. Every change, from any side, is
//! an edit of text and flows one way:
//!
//! ```text
//! text ─parse─▶ tree ─lower─▶ scene ─build─▶ world ─trace─▶ film ─tone─▶ frame ─draw─▶ cells
//!   ▲                                                                               │
//!   └───────── edit (span, text) ◀── action ◀── key, mouse, paste ◀─────────────────┘
//! ```
//!
//! Files that the text names come in beside it, as values: meshes at `lower`, pictures at `build`.
//! They may name others, which are read as if the text did.
//!
//! The one override outside the text is the working view: orbiting moves it in memory until the
//! user saves it, which is an edit like any other.
//!
//! # The rooms, in reading order
//!
//! | room | what it is for | what it must not know |
//! |---|---|---|
//! | [`memory`] | what the process may still use, and whether work fits | what it is for |
//! | [`text`] | spans, edits, numbers and diagnostics: positions and changes in text | any language |
//! | [`geometry`] | rays against shapes in `f64`, one shape a file | lights, materials, text |
//! | [`obj`] | bytes of `.obj` and `.mtl` → meshes | files, scenes |
//! | [`scene`] | plain comparable data | languages, threads, pixels |
//! | [`language`] | scenes as text, a folder for each language: tree, table of fields, scene, places, edits | files, undo |
//! | [`document`] | sole owner of a source, its undo and the saved text | languages by name, files |
//! | [`accel`] | boxes against rays | what the boxes hold |
//! | [`render`] | pixels from a scene: worker, integrator, film, tone | documents, files, terminals |
//! | [`file`](mod@file) | reading scenes and replacing files whole | what the bytes mean |
//! | [`image_file`] | picture files: frames written, textures read | what is in a scene |
//! | [`assets`] | the pictures and meshes that scenes name, as shared values | what they are for |
//! | [`watch`] | paths that change on disk | what is in them |
//! | [`ui`] | the terminal: the only room that knows ratatui and crossterm | how pixels come about |
//! | [`batch`] | headless work: check, render | terminals |
//! | [`cli`] | arguments and exit codes | work |
//!
//! Arrows between rooms are held by `tests/rooms.rs`.
//!
//! # Invariants
//!
//! - Parsing never fails: it gives a tree and diagnostics. A scene that does not lower keeps the
//!   last good picture.
//! - Scene values hold no spans: where each field stands is known to the [`language::Source`].
//! - Every sample is a pure function of (scene, settings, pixel, sample index), and sums are added
//!   in a fixed order: any thread count and any cancellation history gives the same bits.
//! - `ui` changes documents, never scenes. `App::update` is a pure step that returns effects;
//!   drawing never locks.
//! - What threads share is a message, with few exceptions: a renderer's newest generation and its
//!   frame slot; and in [`ui::terminal`] the bytes on their way to the terminal and who has it, which
//!   a panic hook must be able to change, the messages that it leaves, and the number of replies that
//!   are awaited.

pub mod accel;
pub mod assets;
pub mod batch;
pub mod cli;
pub mod document;
pub mod file;
pub mod geometry;
pub mod image_file;
pub mod language;
pub mod memory;
pub mod obj;
pub mod render;
pub mod scene;
pub mod text;
pub mod ui;
pub mod watch;
