//! What any bytes may be handed to. Each target takes some and panics if a promise is broken; they
//! are fuzzed by libFuzzer and by `drive`, and `tests/corpus.rs` hands them what was kept.

mod document;
mod files;
mod keys;
mod scene;

pub use document::{edits, merge};
pub use files::{mtl, obj, picture};
pub use keys::keys;
pub use scene::{dat, ray, xml};

/// What takes any bytes.
pub type Target = fn(&[u8]);

/// All targets by name, which is that of their corpus too.
pub const TARGETS: [(&str, Target); 9] = [
    ("ray", ray),
    ("dat", dat),
    ("xml", xml),
    ("obj", obj),
    ("mtl", mtl),
    ("picture", picture),
    ("edits", edits),
    ("merge", merge),
    ("keys", keys),
];

/// The parts of an input between bytes of 0, which text has no use for; as many as are wanted.
fn parts<const N: usize>(input: &[u8]) -> [&[u8]; N] {
    let mut parts = input.splitn(N, |&byte| byte == 0);
    std::array::from_fn(|_| parts.next().unwrap_or_default())
}
