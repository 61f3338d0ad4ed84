//! The ratios of a run, compared with those kept in `peers.json`.

use serde_json::{Map, Value, json};

use crate::setting::{SCRATCH, THREADS};
use crate::table::{PEERS, Row};

/// The ratios kept, by vector instructions and name of the row.
const KEPT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/benches/peers.json");

/// The rows of a run, beside the ratios kept. Times are not kept, as they are those of a machine.
#[derive(Debug)]
pub(crate) struct Kept {
    vectors: &'static str,
    before: Value,
    rows: Map<String, Value>,
}

impl Kept {
    pub(crate) fn read() -> Self {
        let before = std::fs::read_to_string(KEPT).map_or_else(
            |_| json!({}),
            |text| serde_json::from_str(&text).expect("what is kept is JSON"),
        );
        Self {
            vectors: render::simd_level_name(),
            before,
            rows: Map::new(),
        }
    }

    /// The ratio kept for a row.
    pub(crate) fn ratio(&self, name: &str) -> Option<f64> {
        self.before[self.vectors][name].as_f64()
    }

    /// Adds a row that was measured.
    pub(crate) fn add(&mut self, name: String, row: &Row<'_>) {
        let mut times = Map::new();
        times.insert("ours".into(), row.ours.as_secs_f64().into());
        for peer in PEERS {
            if let Some(timed) = row.of(peer) {
                times.insert(peer.name().into(), timed.wall.as_secs_f64().into());
            }
        }
        let measured = json!({ "seconds": times, "ratio": row.ratio() });
        self.rows.insert(name, measured);
    }

    /// Writes the table of this run, and `replaces` the ratios kept by those measured.
    pub(crate) fn write(mut self, replaces: bool) {
        let path = format!("{SCRATCH}/table.json");
        let run = json!({ "vectors": self.vectors, "threads": THREADS, "rows": self.rows });
        write(&path, &run);
        println!("{path}");
        if !replaces {
            return;
        }
        for (name, row) in self.rows {
            if let Some(ratio) = row["ratio"].as_f64() {
                let rounded = (ratio * 100.0).round() / 100.0;
                self.before[self.vectors][name] = rounded.into();
            }
        }
        write(KEPT, &self.before);
    }
}

fn write(path: &str, value: &Value) {
    let text = serde_json::to_string_pretty(value).expect("a table is JSON");
    std::fs::write(path, text + "\n").expect("the folder is writable");
}
