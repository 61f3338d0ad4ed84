//! Numbers laid out for tests of several things at once.

use std::mem;
use std::ops::Range;

use rayon::iter::repeat_n;
use rayon::prelude::*;

use super::{Several, Simd, WIDTH};
use crate::IsCancelled;

/// Things filled in by one thread at a time.
const CHUNK: usize = 1 << 12;

/// The maximum number of things filled in between two cancellation checks: a few milliseconds. With a
/// quarter as many, loading and rendering a million spheres takes 3 % longer.
const BATCH: usize = 1 << 18;

/// `N` numbers of each of many things, in an order in which they are tested in runs.
///
/// A run of n things is stored as `N` rows of n: the first number of each, the second one, and so on.
/// Rows are loaded whole, with what follows them.
#[derive(Clone, Debug)]
pub struct Rows<T, const N: usize>(Vec<T>);

/// The rows of a run.
#[derive(Clone, Copy, Debug)]
pub struct Run<'n, T, const N: usize> {
    /// The rows and what follows them.
    numbers: &'n [T],
    length: usize,
}

impl<T: Copy + Default + Send, const N: usize> Rows<T, N> {
    /// Stores what `numbers` returns for each place. The runs are consecutive and start at 0. `None`
    /// once `cancelled` returns true.
    pub fn new(
        runs: &[Range<usize>],
        numbers: impl Fn(usize) -> [T; N] + Sync,
        cancelled: IsCancelled<'_>,
    ) -> Option<Self> {
        let count = runs.last().map_or(0, |run| run.end);
        let mut rows = Vec::with_capacity(N * count + WIDTH);
        for runs in runs.chunks(BATCH / WIDTH) {
            if cancelled() {
                return None;
            }
            let start = rows.len();
            rows.par_extend(repeat_n(T::default(), N * places(runs)));
            let mut rest = &mut rows[start..];
            let chunks = runs.chunks(CHUNK / WIDTH).map(|runs| {
                let (own, after) = mem::take(&mut rest).split_at_mut(N * places(runs));
                rest = after;
                (own, runs)
            });
            let chunks: Vec<_> = chunks.collect();
            let fill = |(rows, runs)| Self::fill(rows, runs, &numbers);
            chunks.into_par_iter().for_each(fill);
        }
        rows.extend([T::default(); WIDTH]);
        Some(Self(rows))
    }

    /// Fills the rows of some runs.
    fn fill(mut rows: &mut [T], runs: &[Range<usize>], numbers: impl Fn(usize) -> [T; N]) {
        for run in runs {
            let (own, after) = rows.split_at_mut(N * run.len());
            for (at, place) in run.clone().enumerate() {
                let numbers = numbers(place);
                for (row, number) in own.chunks_mut(run.len()).zip(numbers) {
                    row[at] = number;
                }
            }
            rows = after;
        }
    }

    /// The run with these places, one of those given to [`Rows::new`].
    #[inline(always)]
    pub fn run(&self, places: &Range<usize>) -> Run<'_, T, N> {
        Run {
            numbers: &self.0[N * places.start..],
            length: places.len(),
        }
    }
}

/// The number of places in some runs.
fn places(runs: &[Range<usize>]) -> usize {
    runs.iter().map(ExactSizeIterator::len).sum()
}

impl<T: Copy, const N: usize> Run<'_, T, N> {
    /// A row, in as many lanes; those beyond the run hold other numbers.
    #[inline(always)]
    pub fn row<S: Simd, V: Several<S, Number = T>>(self, simd: S, row: usize) -> V {
        V::load(simd, &self.numbers[row * self.length..])
    }

    /// The number of a thing in a row; `at` counts from the start of the run.
    #[inline(always)]
    pub fn number(self, row: usize, at: usize) -> T {
        self.numbers[row * self.length + at]
    }
}
