//! Softened bonds, whose force has begun to fall beyond a limit, over all processes.

use ligament_model::communicator::Wire;

use crate::bond_numbers::BondNumbers;
use crate::state::State;

/// Bond farthest beyond its limit under a softening law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FarthestSoftened {
    /// Number of the criterion.
    pub criterion: u32,
    /// Global number of the bond.
    pub bond: u32,
    /// Numbers in the body of the ends A < B of the bond.
    pub ends: [u32; 2],
    /// Largest e/e_0 of the bond, above 1.
    largest: f64,
}

/// Softened bonds of a body, over all processes.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SoftenedOfAll {
    /// Number of unbroken bonds beyond their limits.
    pub bonds: usize,
    /// Bond farthest beyond its limit, including broken ones; None where no bond is.
    pub farthest: Option<FarthestSoftened>,
}

impl SoftenedOfAll {
    /// Softened bonds of a state, from the ends of the local bonds (n_bonds); none where no criterion softens. Collective.
    pub(crate) fn in_state(state: &State, numbers: &BondNumbers, ends: &[[u32; 2]]) -> Self {
        if state.softening.largest.is_empty() {
            return Self::default();
        }
        let here = farthest(state, ends, |bond| numbers.owns(bond));
        let here = here.map(|it| FarthestSoftened {
            bond: numbers.number(it.bond),
            ends: numbers.subdomain().numbers(it.ends),
            ..it
        });
        let of_ranks = numbers
            .subdomain()
            .all_gather_list(here.into_iter().collect());
        let is_first = |it: &FarthestSoftened, than: &FarthestSoftened| {
            it.largest > than.largest
                || (it.largest == than.largest
                    && (it.criterion, it.bond) < (than.criterion, than.bond))
        };
        let first = |best, it| if is_first(&it, &best) { it } else { best };
        Self {
            bonds: numbers.count((0..state.intact.len()).map(|bond| state.has_softened(bond))),
            farthest: of_ranks.into_iter().reduce(first),
        }
    }
}

impl Wire<5> for FarthestSoftened {
    fn numbers(&self) -> [f64; 5] {
        let numbers = [self.criterion, self.bond, self.ends[0], self.ends[1]];
        let [criterion, bond, a, b] = numbers.map(f64::from);
        [self.largest, criterion, bond, a, b]
    }

    fn from_numbers([largest, criterion, bond, a, b]: [f64; 5]) -> Self {
        Self {
            criterion: criterion as u32,
            bond: bond as u32,
            ends: [a as u32, b as u32],
            largest,
        }
    }
}

/// Criterion and owned bond with the largest e/e_0 above 1 under a softening law, the first of equal ones.
fn farthest(
    state: &State,
    ends: &[[u32; 2]],
    is_owned: impl Fn(usize) -> bool,
) -> Option<FarthestSoftened> {
    let mut best: Option<FarthestSoftened> = None;
    for (criterion, largest) in (0..).zip(&state.softening.largest) {
        for (bond, &largest) in largest.iter().enumerate() {
            if largest > best.map_or(1.0, |it| it.largest) && is_owned(bond) {
                best = Some(FarthestSoftened {
                    criterion,
                    bond: bond as u32,
                    ends: ends[bond],
                    largest,
                });
            }
        }
    }
    best
}
