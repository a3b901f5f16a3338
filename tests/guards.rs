//! The repository itself: how crates and modules are arranged, and words.

mod architecture;
mod existence;
mod metadata;
mod publishing;
mod structure;
mod targets;
mod words;
