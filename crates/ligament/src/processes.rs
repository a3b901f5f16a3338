//! Processes of a run.

use std::sync::Arc;

use ligament_model::communicator::{Communicator, SingleProcess};

use crate::setup::{Analysis, Setup};

/// The processes between which the body of a setup is divided. Elements that couple more points than the bond's ends, closing faces,
/// far fields, contact between surfaces, natural modes and motions need the whole body on each process.
pub fn partition_communicator(setup: &Setup) -> Arc<dyn Communicator> {
    let needs_all = setup.closing
        || setup.far_field.is_some()
        || setup.has_contact()
        || !setup.law.row.couples_ends_alone
        || matches!(setup.analysis, Analysis::Modal(_) | Analysis::Motion(_));
    match needs_all {
        true => Arc::new(SingleProcess),
        false => setup.solver.communicator.0.clone(),
    }
}
