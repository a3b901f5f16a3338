//! Refinement of a mesh where bonds break: runs one after the other, each from the unloaded body.
//!
//! The first pass runs on the mesh as it is. Each later pass halves the cells once more, down to the size of [`Refine`], at the middles of the
//! bonds that broke or lost half of their force in an earlier pass, at bonds near their limits outside of the fine part and at the tips of pre-cracks;
//! elsewhere cells grow with the distance d from these places such that no point with a longer horizon than those of the fine part reaches a
//! place: spacing(d) <= max(h, d/lambda). Places are only added. No state is transferred from mesh to mesh.

mod places;

use ligament_analysis::driver::Outcome;
use ligament_analysis::largest_utilisation::LargestUtilisations;
use ligament_analysis::refinement_pass::{LastPass, PassRecord, is_cut_short};

use self::places::{CrackBonds, apart, tips};
use crate::error::SetupError;
use crate::model::Model;
use crate::refined_body::{RefinedBody, factor, graded, median_size};
use crate::setup::{FinePlace, Refine, Setup};

/// A pass that ended.
#[derive(Debug, Clone, PartialEq)]
pub struct EndedPass {
    /// Record of the pass.
    pub record: PassRecord,
    /// Places that this pass and the passes before found, around which the next pass is fine.
    pub places: Vec<FinePlace>,
    /// The refinement of the next pass, or the reason why none follows.
    pub next: Result<Refine, LastPass>,
}

impl Model {
    /// The setup from which the model was built, with the body before all refinement.
    pub fn into_setup(self) -> Setup {
        let original = self.refined.map(|it| it.original);
        Setup {
            body: original.unwrap_or(self.setup.body),
            ..self.setup
        }
    }

    /// The record of a pass with an outcome and the largest utilisations of its bonds, and the refinement of the next pass; `earlier` has the
    /// records of the passes before. None where nothing is refined.
    ///
    /// # Errors
    ///
    /// If the mesh cannot be refined.
    pub fn end_pass(
        &self,
        outcome: &Outcome,
        largest: &LargestUtilisations,
        earlier: &[PassRecord],
    ) -> Result<Option<EndedPass>, SetupError> {
        let (Some(refine), Some(refined)) = (&self.setup.refine, &self.refined) else {
            return Ok(None);
        };
        let fine_horizon = refined.fine_horizon();
        let found = CrackBonds::new(self, refine, fine_horizon, &outcome.state, largest);
        let now = found.places(self, refine.pass);
        let before = refine.places.iter();
        let before: Vec<FinePlace> = before
            .filter(|it| it.pass + 1 == refine.pass)
            .copied()
            .collect();
        let path_change = apart(&before, &now);
        let record = self.pass_record(outcome, &found, (refine, refined));
        let record = record.after(earlier.last(), path_change);
        let mut places = refine.places.clone();
        if refine.pass == 1 {
            places.extend(tips(&self.setup.precracks, &refined.original, record.size));
        }
        places.extend(now);
        let next = Refine {
            pass: refine.pass + 1,
            places: places.clone(),
            ..refine.clone()
        };
        let next = match is_cut_short(&outcome.termination) {
            true => Err(LastPass::CutShort),
            false => self.next_pass(next, (refine, refined), &record)?,
        };
        Ok(Some(EndedPass {
            record,
            places,
            next,
        }))
    }

    /// The refinement of the next pass, or the reason why none follows.
    fn next_pass(
        &self,
        next: Refine,
        (refine, refined): (&Refine, &RefinedBody),
        record: &PassRecord,
    ) -> Result<Result<Refine, LastPass>, SetupError> {
        if next.places.is_empty() {
            return Ok(Err(LastPass::NothingToRefine));
        }
        // The pass before had cells of one size with those of this pass if it could halve them as often.
        let is_check = refined
            .graded
            .as_ref()
            .is_some_and(|it| refine.pass >= it.levels + 2);
        let is_short = self.setup.has_short_crack_zone(record.fine_horizon);
        if is_check && !is_short && record.is_settled(refine.tolerance) {
            return Ok(Err(LastPass::WithinTolerance));
        }
        let graded = graded(&refined.original, &next, factor(&self.setup))?;
        let is_same = match &refined.graded {
            Some(now) => now.mesh.n_cells() == graded.mesh.n_cells(),
            None => graded.mesh.n_cells() == self.setup.body.n_cells(),
        };
        Ok(match () {
            () if is_same => Err(LastPass::SameMesh),
            () if refine.pass >= refine.passes => Err(LastPass::AllPasses),
            () => Ok(next),
        })
    }

    /// The record of a pass without its changes.
    fn pass_record(
        &self,
        outcome: &Outcome,
        found: &CrackBonds,
        (refine, refined): (&Refine, &RefinedBody),
    ) -> PassRecord {
        let fine_horizon = refined.fine_horizon();
        let size = match &refined.graded {
            Some(graded) => graded.size,
            None => median_size(&refined.original),
        };
        PassRecord {
            pass: refine.pass,
            size,
            fine_horizon,
            points: self.system.to_bonds().n_points(),
            bonds: self.counts.bonds,
            peak: outcome.peak().map_or(0.0, |it| it.reaction),
            work: outcome.history.last().map_or(0.0, |it| it.external_work),
            energy_ratio: self.worst_energy_ratio(),
            open_bonds: found.open.len(),
            inside: (fine_horizon > 0.0)
                .then(|| found.share_inside(self, fine_horizon))
                .flatten(),
            peak_change: None,
            work_change: None,
            path_change: None,
        }
    }

    /// Mean over the points of the energy of the bonds over that of the material, for the uniform strain with the largest deviation from 1; 1 where no
    /// ratio is known.
    fn worst_energy_ratio(&self) -> f64 {
        let ratios = self.fixed.energy_ratios.iter().map(|it| {
            let known = it.at_points.iter().filter(|it| it.is_finite());
            known.clone().sum::<f64>() / known.count().max(1) as f64
        });
        ratios.fold(1.0, |worst: f64, ratio| {
            if (ratio - 1.0).abs() > (worst - 1.0).abs() {
                ratio
            } else {
                worst
            }
        })
    }
}
