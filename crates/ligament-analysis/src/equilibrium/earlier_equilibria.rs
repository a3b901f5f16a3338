//! Earlier equilibria of softening bonds, from which the next one is extrapolated.

use super::curvature::Curvature;
use super::target::Target;
use crate::checkpoint::CheckpointError;
use crate::serial;
use crate::serial::Serial;
use crate::state::State;
use crate::unknowns::Unknowns;
use ligament_model::subdomain::Subdomain;

/// Largest ratio of a load step to the one before for which the last step is extrapolated.
const GROWTH: f64 = 2.0;

/// Curvature and equilibria from earlier iterations.
#[derive(Clone, Default)]
pub(super) struct EarlierEquilibria {
    /// Stiffness along the last corrections.
    pub(super) curvature: Curvature,
    /// Equilibria of the last two load steps, the older one first.
    equilibria: Vec<Precedent>,
}

/// Load factor and displacements of an earlier equilibrium.
#[derive(Clone)]
struct Precedent {
    load_factor: f64,
    /// Shape (n_degrees_of_freedom).
    displacement: Vec<f64>,
}

serial!(EarlierEquilibria {
    curvature,
    equilibria
});
serial!(Precedent {
    load_factor,
    displacement
});

impl EarlierEquilibria {
    /// Restores earlier from bytes of [`EarlierEquilibria::write_all`].
    ///
    /// # Errors
    ///
    /// If the bytes are damaged or belong to another model.
    pub(super) fn restored(from: &mut &[u8], unknowns: &Unknowns) -> Result<Self, CheckpointError> {
        let mut earlier: Self = Serial::read(from)?;
        if unknowns.len() < unknowns.of_all().count() {
            earlier.curvature = earlier.curvature.mapped(|all| unknowns.own_of(all));
        }
        let n = unknowns.layout().n_degrees_of_freedom();
        let mut equilibria = earlier.equilibria.iter();
        let is_whole = equilibria.all(|it| it.displacement.len() == n);
        match is_whole && earlier.curvature.fits(unknowns.len()) {
            true => Ok(earlier),
            false => Err(CheckpointError::OtherModel),
        }
    }

    /// Appends the earlier at the unknowns and points of all processes; collective.
    pub(super) fn write_all(&self, subdomain: &Subdomain, unknowns: &Unknowns, out: &mut Vec<u8>) {
        match subdomain.is_whole() {
            true => self.write(out),
            false => self.of_all(subdomain, unknowns).write(out),
        }
    }

    /// Gathers the earlier at the unknowns and points of all processes from those at owned points.
    fn of_all(&self, subdomain: &Subdomain, unknowns: &Unknowns) -> Self {
        let curvature = self.curvature.mapped(|own| {
            let mut all = vec![0.0; unknowns.layout().n_degrees_of_freedom()];
            for (&dof, value) in unknowns.degrees_of_freedom().iter().zip(own) {
                all[dof as usize] = *value;
            }
            let all = subdomain.gathered(&all);
            unknowns.of_all().map(|dof| all[dof]).collect()
        });
        let equilibria = self.equilibria.iter().map(|it| Precedent {
            load_factor: it.load_factor,
            displacement: subdomain.gathered(&it.displacement).into_owned(),
        });
        Self {
            equilibria: equilibria.collect(),
            curvature,
        }
    }

    /// Records an equilibrium; an equilibrium after a breakage replaces the one before it.
    pub(super) fn learn(&mut self, state: &State, is_after_breakage: bool) {
        if is_after_breakage {
            self.equilibria.pop();
        } else if self.equilibria.len() == 2 {
            self.equilibria.remove(0);
        }
        self.equilibria.push(Precedent {
            load_factor: state.load_factor,
            displacement: state.displacement.clone(),
        });
    }

    /// Extrapolates the last load step to the load factor of the state or to the target value of a motion; None where the direction
    /// reverses or the step grows too much.
    pub(super) fn ahead(&self, state: &State, target: Option<&Target>) -> Option<State> {
        let [before, last] = self.equilibria.as_slice() else {
            return None;
        };
        let part = match target {
            None => {
                (state.load_factor - last.load_factor) / (last.load_factor - before.load_factor)
            }
            Some(target) => {
                let [first, second] = [before, last].map(|it| target.motion(&it.displacement));
                (target.value - second) / (second - first)
            }
        };
        if !(part > 0.0 && part <= GROWTH) {
            return None;
        }
        let mut ahead = state.clone();
        if target.is_some() {
            ahead.load_factor += part * (last.load_factor - before.load_factor);
        }
        let changes = last.displacement.iter().zip(&before.displacement);
        for (value, (last, before)) in ahead.displacement.iter_mut().zip(changes) {
            *value += part * (last - before);
        }
        Some(ahead)
    }
}
