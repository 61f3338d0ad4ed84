//! Halflight: a progressive ray tracer that lives in the terminal.
//!
//! # The one idea
//!
//! The text is the single source of truth. A scene is a text file; the tree, the scene and the
//! picture are derived from it. Every change, wherever it comes from, is an edit of the text and
//! flows one way:
//!
//! ```text
//! text ─parse─▶ tree ─lower─▶ scene ─build─▶ world ─trace─▶ film ─tone─▶ frame ─draw─▶ cells
//!   ▲                                                                               │
//!   └───────── edit (span, text) ◀── action ◀── key, mouse, paste ◀─────────────────┘
//! ```
//!
//! Files that the text names enter as values: meshes at `lower`, pictures at `build`. Files that
//! those name in turn are treated as if the text named them.
//!
//! The only part of a scene outside the text is the working view: orbiting moves it in memory until
//! the user saves it, which is an edit like any other. Render settings such as the integrator are
//! part of the text, under those of the command line and of the interface; what is displayed belongs
//! to the session.
//!
//! # The rooms, in reading order
//!
//! | room | purpose | must not know |
//! |---|---|---|
//! | [`memory`] | memory available to the process, whether work fits, and the program's allocator | what the memory is for |
//! | [`text`] | spans, edits, numbers and diagnostics | any language |
//! | [`geometry`] | ray–shape intersection in `f64`, one module per shape | lights, materials, text |
//! | [`obj`] | parses `.obj`, `.mtl`, `.ply` and `.stl` into meshes | files, scenes |
//! | [`scene`] | the scene as plain, comparable data; render settings are rows of `rendering/rows.rs` | languages, threads, pixels |
//! | [`language`] | one folder per scene language: tree, table of fields, lowering, origins, edits | files, undo |
//! | [`document`] | sole owner of a source, its undo history and its saved text | individual languages, files |
//! | [`accel`] | bounding volume hierarchies | what the boxes contain |
//! | [`render`] | renders scenes: worker, integrators, film, tone mapping | documents, files, terminals |
//! | [`explain`] | records of samples in words, with the names and places of the text | how rays are traced, terminals |
//! | [`file`](mod@file) | reads scenes and replaces files, atomically where the file system allows it; says why it could not; the state folder | what the bytes mean |
//! | [`image_file`] | picture files: writes frames, reads textures | what is in a scene |
//! | [`assets`] | reads the pictures and meshes that scenes name; makes scenes around meshes | how they are shaded |
//! | [`compare`] | two pictures against each other | files, scenes |
//! | [`shards`] | blocks of unfinished pictures on disk: shards, checkpoints, traces of the interface, merging | scenes, tracing |
//! | [`track`] | values over frames: reads track files, edits texts to show a frame | files, rendering |
//! | [`watch`] | reports changes of paths on disk | what the files contain |
//! | [`link`] | the socket between an editor's language server and a running interface, and the messages on it | editors' protocols, pictures |
//! | [`ui`] | the terminal: the only room that knows ratatui and crossterm; a mode is a folder of `app`, a command a row of `app/command`, a key a row of its room | how pixels are computed |
//! | [`batch`] | headless work: check, render, merge, show, compare, explain, convert, bench | terminals |
//! | [`lsp`] | an editor's questions about a text: diagnostics and fixes, completion, hover, symbols, rename, colours; passes the text on by the link | pictures |
//! | [`config`] | the user's configuration: reads, checks and prints it | what the settings do |
//! | [`cli`] | arguments and exit codes | how the work is done |
//!
//! Each room is a crate, and its manifest lists the rooms and the libraries that it may use; this crate
//! passes all of them on. `tests/it/rooms` forbids what manifests allow: naming what is not used, cycles
//! between sibling files, and growth beyond the ceilings of files, folders, rooms and the methods of
//! the interface.
//!
//! # Invariants
//!
//! - Parsing never fails: it returns a tree and diagnostics. If a scene does not lower, the last
//!   good picture stays.
//! - Scenes contain no spans: [`language::Source`] knows the position of each field in the text.
//! - Every sample is a pure function of (scene, settings, pixel, sample index), and sums are added
//!   in a fixed order: the result is identical bit for bit, regardless of the number of threads and
//!   of cancelled renders.
//! - `ui` changes documents, never scenes. `App::update` is a pure step that returns effects;
//!   drawing never locks.
//! - Threads communicate by messages. The exceptions are a renderer's newest generation, which may be
//!   paused, the jobs that its worker has not begun, and its frame slot; the former paths of the current
//!   folder; the last signal during headless work; and in [`ui::terminal`] the counts of expected replies and of
//!   keys that are not handled yet, and what a panic hook or signal handler must reach: the queued output,
//!   the owner of the terminal and how it reports keys, the panics of other threads and whether unsaved
//!   edits are stored.

pub use accel;
pub use assets;
pub use batch;
pub use cli;
pub use compare;
pub use config;
pub use document;
pub use explain;
pub use file;
pub use geometry;
pub use image_file;
pub use language;
pub use link;
pub use lsp;
pub use memory;
pub use obj;
pub use render;
pub use scene;
pub use shards;
pub use text;
pub use track;
pub use ui;
pub use watch;
