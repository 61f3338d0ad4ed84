//! Numbers, words and colours as they are typed, pasted and nudged.

pub(crate) mod arithmetic;
pub(crate) mod colours;
pub(crate) mod hsv;
pub(crate) mod literals;
pub(crate) mod typed;
