//! Tests of the meaning of `.test` texts.
