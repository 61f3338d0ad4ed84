//! The fuzz targets. Each accepts any bytes and panics if an invariant is broken. libFuzzer and
//! `drive` fuzz them; `tests/it/corpus.rs` replays the corpora.

mod document;
mod files;
mod kept;
mod keys;
mod messages;
mod scene;

pub use document::{edits, merge};
pub use files::{mtl, obj, picture, ply, stl};
pub use kept::{config, part, record, track};
pub use keys::keys;
pub use messages::{link, lsp};
pub use scene::{cse167, dat, ray, xml};

/// A function that accepts any bytes.
pub type Target = fn(&[u8]);

/// All targets by name, which is also that of their corpus.
pub const TARGETS: [(&str, Target); 18] = [
    ("ray", ray),
    ("cse167", cse167),
    ("dat", dat),
    ("xml", xml),
    ("obj", obj),
    ("mtl", mtl),
    ("ply", ply),
    ("stl", stl),
    ("picture", picture),
    ("edits", edits),
    ("merge", merge),
    ("keys", keys),
    ("track", track),
    ("config", config),
    ("part", part),
    ("record", record),
    ("lsp", lsp),
    ("link", link),
];

/// Splits an input at zero bytes, which do not occur in text, into N parts.
fn parts<const N: usize>(input: &[u8]) -> [&[u8]; N] {
    let mut parts = input.splitn(N, |&byte| byte == 0);
    std::array::from_fn(|_| parts.next().unwrap_or_default())
}
