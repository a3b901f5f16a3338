//! What the first of several processes tells the others, and what all of them ask each other.

use std::path::{Path, PathBuf};

use anyhow::ensure;
use ligament::{Loading, Model};
use ligament_analysis::ranks::Together;
use ligament_analysis::serial::Serial;
use ligament_case::case::{CaseFile, StressField};

use crate::checkpoints::IsStopped;
use crate::memory;

/// The loading of a case, whose equations the processes solve together.
pub(crate) fn loading(
    case: &CaseFile,
    model: &Model,
    ranks: Option<Together>,
) -> anyhow::Result<Loading> {
    ensure!(
        !case.case.output.bonds || model.system.portion().is_none(),
        "output.bonds: several processes write no file of the bonds as lines; run the case with one process, or leave the key out"
    );
    ensure!(
        !case.case.output.stress.contains(&StressField::Traction)
            || model.system.portion().is_none(),
        "output.stress: of \"traction\" several processes do not know all bonds that cross a plane; run the case with one process, or take \
         \"virial\" alone"
    );
    let loading = Loading::new(model);
    let mut loading = loading.map_err(|it| case.located(it))?;
    loading.solver.ranks = ranks;
    loading.solver.memory = memory::for_factor(case, &*model.system);
    Ok(loading)
}

/// Whether some process was asked to stop: all hear of it.
pub(crate) fn any_stopped(ranks: Option<Together>, is_stopped: IsStopped<'_>) -> bool {
    let mut asked = [f64::from(u8::from(is_stopped()))];
    if let Some(Together(ranks)) = ranks {
        ranks.largest(&mut asked);
    }
    asked[0] > 0.0
}

/// Tells the others the folder of the results.
pub(crate) fn tell_folder(ranks: Option<Together>, folder: &Path) {
    if let Some(Together(ranks)) = ranks {
        let mut bytes = folder.as_os_str().as_encoded_bytes().to_vec();
        ranks.broadcast(&mut bytes);
    }
}

/// Hears from the first process the folder of the results.
pub(crate) fn hear_folder(Together(ranks): Together) -> anyhow::Result<PathBuf> {
    let mut folder = Vec::new();
    ranks.broadcast(&mut folder);
    Ok(PathBuf::from(String::from_utf8(folder)?))
}

/// Tells the others from where a run goes on: a checkpoint, or none.
pub(crate) fn tell_checkpoint(ranks: Option<Together>, solution: Option<&Vec<u8>>) {
    if let Some(Together(ranks)) = ranks {
        let mut bytes = Vec::new();
        solution.cloned().write(&mut bytes);
        ranks.broadcast(&mut bytes);
    }
}
