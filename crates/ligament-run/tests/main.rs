//! Cases as runs take them.

mod case_precrack;
mod case_temperature;
mod certificate;
