//! Bonds whose force has begun to fall beyond a limit, over all processes that share a body out.

use crate::bond_numbers::BondNumbers;
use crate::state::State;

/// The bond farthest beyond its limit under a law that softens.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FarthestSoftened {
    /// Number of the criterion.
    pub criterion: u32,
    /// Number of the bond among all bonds of the body.
    pub bond: u32,
    /// Ends A < B of the bond.
    pub ends: [u32; 2],
    /// Largest e/e_0 of the bond, beyond 1.
    largest: f64,
}

/// What softened of a body that processes share out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SoftenedOfAll {
    /// Number of the unbroken bonds past their limits.
    pub bonds: usize,
    /// The one farthest beyond its limit, broken ones included; none where none is.
    pub farthest: Option<FarthestSoftened>,
}

impl SoftenedOfAll {
    /// What softened in a state, with the ends of the bonds that are known here (n_bonds); all processes ask for it.
    pub(crate) fn in_state(state: &State, numbers: &BondNumbers, ends: &[[u32; 2]]) -> Self {
        let counted = |bond: usize| numbers.counts(bond);
        let here = farthest(state, ends, counted).map(|it| {
            let [a, b] = it.ends.map(f64::from);
            let bond = f64::from(numbers.number(it.bond as usize));
            [it.largest, f64::from(it.criterion), bond, a, b]
        });
        let of_ranks = numbers.portion().concatenated(here.as_slice()).into_iter();
        let of_ranks = of_ranks.map(|[largest, criterion, bond, a, b]| FarthestSoftened {
            criterion: criterion as u32,
            bond: bond as u32,
            ends: [a as u32, b as u32],
            largest,
        });
        let is_first = |it: &FarthestSoftened, than: &FarthestSoftened| {
            it.largest > than.largest
                || (it.largest == than.largest
                    && (it.criterion, it.bond) < (than.criterion, than.bond))
        };
        Self {
            bonds: numbers.count((0..state.intact.len()).map(|bond| state.has_softened(bond))),
            farthest: of_ranks.reduce(|best, it| if is_first(&it, &best) { it } else { best }),
        }
    }
}

/// The criterion and the bond with the largest e/e_0 beyond 1 under a law that softens among those that count, the first of several.
pub(crate) fn farthest(
    state: &State,
    ends: &[[u32; 2]],
    counts: impl Fn(usize) -> bool,
) -> Option<FarthestSoftened> {
    let mut best: Option<FarthestSoftened> = None;
    for (criterion, largest) in (0..).zip(&state.softening.largest) {
        for (bond, &largest) in largest.iter().enumerate() {
            if largest > best.map_or(1.0, |it| it.largest) && counts(bond) {
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
