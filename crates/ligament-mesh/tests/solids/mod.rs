//! Solid meshes: files by Gmsh and meshio, small files changed in one thing, and the writer.

#![allow(clippy::unwrap_used, missing_docs)]

mod gmsh_files;
mod refusals;
mod small_files;
