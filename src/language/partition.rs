//! Binary search in lists whose items are computed.

/// The first index below `len` for which a condition fails that holds for exactly a prefix; `len` if
/// it holds for all.
pub(super) fn partition_point(len: usize, holds: impl Fn(usize) -> bool) -> usize {
    let (mut from, mut until) = (0, len);
    while from < until {
        let middle = from.midpoint(until);
        if holds(middle) {
            from = middle + 1;
        } else {
            until = middle;
        }
    }
    from
}
