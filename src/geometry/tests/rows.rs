//! Rows of numbers in more than one batch.

use std::ops::Range;
use std::sync::atomic::{AtomicU32, Ordering};

use crate::lanes::Rows;

/// Runs of one to three places, enough for several batches.
fn runs() -> Vec<Range<usize>> {
    let mut end = 0;
    let run = |number: usize| {
        let start = end;
        end += 1 + number % 3;
        start..end
    };
    (0..70_000).map(run).collect()
}

fn numbers(place: usize) -> [u32; 2] {
    [2 * place as u32, 2 * place as u32 + 1]
}

#[test]
fn every_run_holds_the_numbers_of_its_places() {
    let runs = runs();
    let rows = Rows::new(&runs, numbers, &|| false).expect("nothing is cancelled");
    for run in runs {
        for (at, place) in run.clone().enumerate() {
            let found = [0, 1].map(|row| rows.run(&run).number(row, at));
            assert_eq!(found, numbers(place), "{place}");
        }
    }
}

#[test]
fn filling_ends_at_the_first_check_that_cancels_it() {
    for last in 0..3 {
        let checks = AtomicU32::new(0);
        let cancelled = || checks.fetch_add(1, Ordering::Relaxed) == last;
        assert!(Rows::new(&runs(), numbers, &cancelled).is_none());
        assert_eq!(checks.into_inner(), last + 1);
    }
}
