//! The repository itself: how crates and modules are arranged, words, packages and their licences.

mod architecture;
mod dependencies;
mod existence;
mod metadata;
mod structure;
mod targets;
mod words;
