//! The commands as a user meets them: the program is run, and its files and words are looked at.

mod calibrate_command;
mod cite_command;
mod columns;
mod command_line;
mod crack_command;
mod ends;
mod ensemble_command;
mod explain;
mod faults;
mod foresight;
mod lattice_command;
mod modal_command;
mod motion_results;
mod plot;
mod repeat_command;
mod report_command;
mod resume_command;
mod solid_results;
mod solids;
mod starter;
mod stiffness_command;
mod support;
mod sweep;
mod via_meshio;
mod without_equilibrium;
mod yield_command;
