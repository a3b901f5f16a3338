//! Rank-one terms by which breakages, added supports and softening update a factor.

use ligament_linalg::RankOne;
use ligament_model::Bonds;
use ligament_model::element::{StiffnessFactors, Term};
use ligament_model::parallel;

use crate::breakage::Breakage;
use crate::contact::resisting::Resisting;
use crate::state::State;
use crate::unknowns::Unknowns;

/// Relative change of a bond's secant stiffness above which the factor is updated. An L-panel of 2,300 points took 3 and 8 % more
/// solutions with 0.6 and 0.8 than with 0.3, and 19 and 10 instead of 45 factorisations, on the same curve.
const SECANT_TOLERANCE: f64 = 0.6;

/// Unknowns that are coupled in a factor.
#[derive(Clone, Copy)]
pub(super) struct Coupled<'a> {
    pub(super) system: &'a dyn Bonds,
    pub(super) unknowns: &'a Unknowns,
    /// Degrees of freedom decoupled from the others, shape (n_degrees_of_freedom).
    pub(super) cut_off: &'a [bool],
    /// Stiffness that an added support adds to a diagonal entry, as a share of that entry.
    pub(super) hold_share: f64,
}

impl Coupled<'_> {
    /// Number of the unknown at a degree of freedom; None where it is no unknown or decoupled.
    pub(super) fn number(self, dof: usize) -> Option<usize> {
        let number = self.unknowns.number(dof);
        number.filter(|_| !self.cut_off[dof])
    }

    /// Terms of a breakage. Terms that add stiffness come first, so that every intermediate matrix is definite if the last one is.
    pub(super) fn of_breakage(self, breakage: &Breakage) -> Vec<RankOne> {
        let holds = breakage.holds.iter();
        let mut terms = self.of_holds(holds.map(|hold| hold.degree_of_freedom));
        let gained = breakage.gained_terms();
        terms.extend(gained.filter_map(|term| self.at_unknowns(term, 1.0)));
        let lost = breakage.lost_terms();
        terms.extend(lost.filter_map(|term| self.at_unknowns(term, -1.0)));
        terms
    }

    /// Terms of the bonds in `due`; sets their remaining stiffness in the factor (n_bonds) to its value in the state.
    pub(super) fn of_softening(
        self,
        due: &[usize],
        in_factor: &mut [StiffnessFactors],
        state: &State,
    ) -> Vec<RankOne> {
        let system = self.system;
        let mut terms = Vec::new();
        for &bond in due {
            let remaining = state.softening.remaining[bond];
            let lost = in_factor[bond].lost(&remaining);
            let of_element = system.terms(&state.intact, bond, &lost).into_iter();
            terms.extend(of_element.filter_map(|term| self.at_unknowns(term, -1.0)));
            in_factor[bond] = remaining;
        }
        // Terms that add stiffness come first, as in a breakage.
        terms.sort_by_key(|term| term.weight < 0.0);
        terms
    }

    /// Terms of the falling stiffness of bonds, multiplied by `sign`.
    pub(super) fn of_falling(self, falling: &[(u32, Term)], sign: f64) -> Vec<RankOne> {
        let terms = falling.iter().map(|(_, term)| term.clone());
        terms
            .filter_map(|term| self.at_unknowns(term, sign))
            .collect()
    }

    /// Terms of added supports. They precede the terms of broken bonds, so that no pivot vanishes in between.
    pub(super) fn of_holds(self, held: impl Iterator<Item = usize>) -> Vec<RankOne> {
        let holds = held.filter_map(|dof| {
            let entries = vec![(self.number(dof)?, 1.0)];
            let diagonal = self.whole_diagonal(dof).abs();
            let weight = self.hold_share * if diagonal == 0.0 { 1.0 } else { diagonal };
            Some(RankOne { weight, entries })
        });
        holds.collect()
    }

    /// Terms of the motions that contacts resist, multiplied by `sign`.
    pub(super) fn of_contact(self, resisting: &[Resisting], sign: f64) -> Vec<RankOne> {
        let terms = resisting.iter().map(Resisting::term);
        terms
            .filter_map(|term| self.at_unknowns(term, sign))
            .collect()
    }

    /// Term of an element, multiplied by a factor, at the unknowns; None where it changes nothing.
    fn at_unknowns(self, (rigidity, entries): Term, factor: f64) -> Option<RankOne> {
        let entries: Vec<(usize, f64)> = (entries.into_iter())
            .filter_map(|(dof, value)| Some((self.number(dof)?, value)))
            .collect();
        let matters = rigidity != 0.0 && !entries.is_empty();
        matters.then_some(RankOne {
            weight: factor * rigidity,
            entries,
        })
    }

    /// Diagonal entry of the matrix with all bonds whole.
    fn whole_diagonal(self, dof: usize) -> f64 {
        let system = self.system;
        let whole = vec![true; system.ends.len()];
        let point = self.unknowns.layout().point(dof);
        let elements = system.elements_at_points.at(point).iter();
        elements
            .flat_map(|&bond| system.terms(&whole, bond as usize, &StiffnessFactors::WHOLE))
            .map(|(rigidity, entries)| {
                let own = entries.iter().filter(|(of, _)| *of == dof);
                own.map(|(_, value)| rigidity * value * value).sum::<f64>()
            })
            .sum()
    }
}

/// Whether the terms of the falling stiffness of bonds are at the degrees of freedom of a body.
pub(super) fn fits(falling: &[(u32, Term)], system: &dyn Bonds) -> bool {
    let n = system.layout.n_degrees_of_freedom();
    let mut entries = falling.iter().flat_map(|(_, (_, entries))| entries);
    entries.all(|(dof, _)| *dof < n)
}

/// Intact bonds whose secants differ too much from the secants in a factor (n_bonds), ascending.
///
/// Other bonds are not updated: the residual is computed from the present bonds, and the iteration converges with a slightly
/// outdated factor.
pub(super) fn due_bonds(in_factor: &[StiffnessFactors], state: &State) -> Vec<usize> {
    let remaining = &state.softening.remaining;
    let is_due = |bond: &usize| {
        state.intact[*bond] && in_factor[*bond].differs_from(&remaining[*bond], SECANT_TOLERANCE)
    };
    parallel::flat_map(remaining.len(), |bond| Some(bond).filter(is_due))
}
