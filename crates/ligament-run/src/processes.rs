//! Communication between the processes of a run outside of the equations.

use std::path::{Path, PathBuf};

use anyhow::ensure;
use ligament::{Loading, Model};
use ligament_analysis::distributed_matrix::Communicator;
use ligament_analysis::messages::of_first;
use ligament_case::case::{CaseFile, StressField};
use ligament_output::checkpoint::StoredSolution;

use crate::checkpoints::IsStopped;
use crate::memory;

/// The loading of a case.
///
/// # Errors
///
/// If a name of the case is not in the body, or the requested results need all bonds on one process and the body is divided.
pub fn loading(case: &CaseFile, model: &Model) -> anyhow::Result<Loading> {
    ensure!(
        !model.setup.analysis.is_motion() || model.setup.solver.communicator.size() == 1,
        "analysis = \"motion\": several processes cannot compute a motion in time; run the case with one process, without mpirun"
    );
    let is_whole = model.system.subdomain.is_whole();
    ensure!(
        !case.case.output.bonds || is_whole,
        "output.bonds: several processes cannot write files of bonds; run the case with one process, or remove the key"
    );
    ensure!(
        !case.case.output.stress.contains(&StressField::Traction) || is_whole,
        "output.stress: several processes cannot compute \"traction\", which needs all bonds that cross a plane; run the case with one \
         process, or take \"material\" or \"virial\""
    );
    let loading = Loading::new(model);
    let mut loading = loading.map_err(|it| case.error_at_key(it))?;
    loading.solver.factor_memory = memory::factor_bytes(case, &*model.system);
    Ok(loading)
}

/// Whether any process should stop; collective.
pub(crate) fn any_stopped(communicator: &dyn Communicator, is_stopped: IsStopped<'_>) -> bool {
    communicator.any(is_stopped())
}

/// The path of rank 0; other ranks pass `None`. Collective.
///
/// # Errors
///
/// If the path received by another rank is not UTF-8.
pub(crate) fn broadcast_path(
    communicator: &dyn Communicator,
    path: Option<&Path>,
) -> anyhow::Result<PathBuf> {
    let mut bytes = path.map_or_else(Vec::new, |it| it.as_os_str().as_encoded_bytes().to_vec());
    communicator.broadcast(&mut bytes);
    Ok(match path {
        Some(path) => path.to_path_buf(),
        None => PathBuf::from(String::from_utf8(bytes)?),
    })
}

/// The place of the solution of a checkpoint that rank 0 found, if any. Collective.
///
/// # Errors
///
/// If the received bytes are damaged.
pub(crate) fn broadcast_solution(
    communicator: &dyn Communicator,
    stored: Option<StoredSolution>,
) -> anyhow::Result<Option<StoredSolution>> {
    Ok(of_first(communicator, stored)?)
}
