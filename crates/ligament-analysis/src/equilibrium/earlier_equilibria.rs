//! Earlier equilibria of softening bonds, from which the next one is extrapolated.

use std::io::Read;

use super::curvature::Curvature;
use super::target::Target;
use crate::bond_numbers::BondNumbers;
use crate::checkpoint::CheckpointError;
use crate::lists_of_all::{read_by_index, write_by_index};
use crate::serial::{Serial, Sink};
use crate::state::State;
use crate::unknowns::Unknowns;
use ligament_model::prefix_sums::sums_before;
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

/// Places of the owned unknowns among the unknowns of the body, in the order of the degrees of freedom.
struct OwnUnknowns {
    places: Vec<usize>,
    n_all: usize,
}

impl OwnUnknowns {
    /// The places on this process; collective.
    fn new(subdomain: &Subdomain, unknowns: &Unknowns) -> Self {
        let layout = unknowns.layout();
        let of_points = |point: u32| unknowns.of_point(point as usize).count() as f64;
        let counts: Vec<f64> = subdomain.owned().map(of_points).collect();
        let starts = sums_before(subdomain, &counts);
        let mut next: Vec<usize> = starts.into_iter().map(|it| it as usize).collect();
        let place = |dof: &u32| {
            let next = &mut next[subdomain.row(layout.point(*dof as usize))?];
            *next += 1;
            Some(*next - 1)
        };
        Self {
            places: unknowns
                .degrees_of_freedom()
                .iter()
                .filter_map(place)
                .collect(),
            n_all: subdomain.count(unknowns.len()),
        }
    }
}

impl EarlierEquilibria {
    /// Restores the earlier equilibria from bytes of [`EarlierEquilibria::write_all`].
    ///
    /// # Errors
    ///
    /// If the bytes are damaged or belong to another model.
    pub(super) fn restored(
        from: &mut dyn Read,
        (numbers, unknowns): (&BondNumbers, &Unknowns),
    ) -> Result<Self, CheckpointError> {
        let own = OwnUnknowns::new(numbers.subdomain(), unknowns);
        let values = |from: &mut dyn Read| match usize::read(from)? {
            count if count == own.n_all => Ok(read_by_index(
                count,
                &0.0,
                own.places.iter().copied(),
                from,
            )?),
            _ => Err(CheckpointError::OtherModel),
        };
        let curvature = Curvature::read(values, from)?;
        let count = usize::read(from)?;
        let n_components = unknowns.layout().components.len();
        let mut precedent = || {
            Ok(Precedent {
                load_factor: Serial::read(from)?,
                displacement: numbers.read_points(n_components, 0.0, from)?,
            })
        };
        let equilibria: Result<Vec<Precedent>, CheckpointError> =
            (0..count).map(|_| precedent()).collect();
        let earlier = Self {
            curvature,
            equilibria: equilibria?,
        };
        let n = unknowns.layout().n_degrees_of_freedom();
        let is_whole = |it: &Precedent| it.displacement.len() == n;
        match earlier.equilibria.iter().all(is_whole) {
            true => Ok(earlier),
            false => Err(CheckpointError::OtherModel),
        }
    }

    /// Appends the earlier equilibria at the unknowns and points of all processes, valid only on rank 0; collective.
    pub(super) fn write_all(&self, numbers: &BondNumbers, unknowns: &Unknowns, out: &mut dyn Sink) {
        let own = OwnUnknowns::new(numbers.subdomain(), unknowns);
        let values = |values: &[f64], out: &mut dyn Sink| {
            let numbered = own.places.iter().copied().zip(values.iter().copied());
            write_by_index(numbers.subdomain(), own.n_all, numbered, 0.0, out);
        };
        self.curvature.write(values, out);
        self.equilibria.len().write(out);
        let n_components = unknowns.layout().components.len();
        for Precedent {
            load_factor,
            displacement,
        } in &self.equilibria
        {
            load_factor.write(out);
            numbers.write_points((displacement, n_components), 0.0, out);
        }
    }

    /// Whether the last equilibrium has the load of a state, or the target value of a motion: then only bonds have changed since.
    pub(super) fn has_load(&self, state: &State, target: Option<&Target>) -> bool {
        let last = self.equilibria.last();
        last.is_some_and(|last| match target {
            None => last.load_factor == state.load_factor,
            Some(target) => target.is_met(&last.displacement),
        })
    }

    /// Records an equilibrium; one whose load is not new replaces the one before it.
    pub(super) fn learn(&mut self, state: &State, is_new: bool) {
        if !is_new {
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
