//! Replays the seeds and findings of fuzzing; see `fuzz/README.md`.

#[path = "../../fuzz/src/lib.rs"]
pub mod targets;

use std::fs;
use std::path::Path;

#[test]
fn every_kept_input_passes() {
    let corpora = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/corpus");
    for (name, target) in targets::TARGETS {
        let folder = fs::read_dir(corpora.join(name)).expect("each target has a corpus");
        let mut count = 0;
        for entry in folder {
            let path = entry.expect("corpora are readable").path();
            let input = fs::read(&path).expect("corpora are readable");
            let outcome = std::panic::catch_unwind(|| target(&input));
            assert!(outcome.is_ok(), "{}", path.display());
            count += 1;
        }
        assert!(0 < count, "{name} has inputs");
    }
}
