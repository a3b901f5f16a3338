//! Small files, each changed in one thing: what is refused, and how groups are read.

#![allow(clippy::unwrap_used, missing_docs)]

mod damaged_files;
mod fields;
mod groups;
mod other_programs;
mod square;
mod unfit_meshes;
