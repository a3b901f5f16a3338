//! Case files: what keys mean, what is refused and where, and the schema that says the same.

mod case_analysis;
mod case_criteria;
mod case_errors;
mod case_lattice;
mod case_laws;
mod case_loads;
mod case_motion;
mod case_schema;
mod case_settings;
