//! Mesh files, whole and damaged, of all versions and encodings, and input decks.

mod decks;
mod golden;
mod meshes;
mod properties;
mod small_files;
mod solids;
mod writer;
