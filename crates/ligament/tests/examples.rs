//! The examples run, and find what they assert.
#![allow(
    clippy::print_stdout,
    clippy::unwrap_used,
    reason = "examples show what they find"
)]

#[path = "../examples/breaking_disk.rs"]
mod breaking_disk;
#[path = "../examples/elastic_plate.rs"]
mod elastic_plate;

#[test]
fn an_elastic_plate_from_arrays() {
    elastic_plate::main().unwrap();
}

#[test]
fn a_disk_from_a_mesh_breaks() {
    breaking_disk::main().unwrap();
}
