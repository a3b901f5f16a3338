//! The examples run, and find what they assert.
#![allow(
    clippy::duplicate_mod,
    reason = "each example is a program of its own, and one breaks the plate of another"
)]
#![allow(
    clippy::print_stdout,
    clippy::unwrap_used,
    reason = "examples show what they find"
)]

#[path = "../examples/breaking_disk.rs"]
mod breaking_disk;
#[path = "../examples/elastic_plate.rs"]
mod elastic_plate;
#[path = "../examples/own_law.rs"]
mod own_law;
#[path = "../examples/own_way.rs"]
mod own_way;
#[path = "../examples/resumed_plate.rs"]
mod resumed_plate;
#[path = "../examples/splitting_solid.rs"]
mod splitting_solid;
#[path = "../examples/steps_by_hand.rs"]
mod steps_by_hand;
#[path = "../examples/watched_plate.rs"]
pub(crate) mod watched_plate;

#[test]
fn an_elastic_plate_from_arrays() {
    elastic_plate::main().unwrap();
}

#[test]
fn a_disk_from_a_mesh_breaks() {
    breaking_disk::main().unwrap();
}

#[test]
fn a_solid_from_arrays_splits() {
    splitting_solid::main().unwrap();
}

#[test]
fn an_observer_watches_and_stops_a_run() {
    watched_plate::main().unwrap();
}

#[test]
fn a_run_goes_on_from_its_checkpoint() {
    resumed_plate::main().unwrap();
}

#[test]
fn a_plate_breaks_by_a_criterion_and_a_law_of_its_own() {
    own_law::main().unwrap();
}

#[test]
fn a_run_goes_a_way_of_its_own() {
    own_way::main().unwrap();
}

#[test]
fn load_steps_are_taken_by_hand() {
    steps_by_hand::main().unwrap();
}
