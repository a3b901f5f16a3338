//! Bodies that break: criteria, drivers, softening, cracks, published values, and the files and checkpoints of runs.

mod breaking;
mod cases;
mod closing;
mod contact_at_rest;
mod contact_on_exact_path;
mod crack_lines;
mod crack_surfaces;
mod determinism;
mod ensembles;
mod every_law;
mod exact_path;
mod face_friction;
mod failure_criteria;
mod fracture_energy;
mod fragments;
mod incremental;
mod mbb_pd_reference;
mod missed_contact;
mod properties;
mod published;
mod random_strength;
mod result_files;
mod resume;
mod softening;
mod solid_results;
mod solids_fracture;
