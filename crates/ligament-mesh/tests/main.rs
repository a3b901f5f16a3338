//! Mesh files, whole and damaged, of all versions and encodings.

mod golden;
mod meshes;
mod properties;
mod small_files;
mod solids;
mod writer;
