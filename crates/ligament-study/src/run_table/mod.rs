//! The table of the runs of a study, under sweeps, ensembles and calibrations.
//!
//! | module | has |
//! |---|---|
//! | [`folder`] | the folder of a study: its marker, locks, and shards |
//! | `progress` | the display of the runs that have ended |
//! | `report` | tables and plots of the results |

pub mod folder;
pub(crate) mod progress;
pub(crate) mod report;
