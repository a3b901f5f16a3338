//! Ratios of criteria of stress where parts of the body are delayed.
//!
//! The stress around a bond depends on all bonds of its ends, which may belong to several parts. Every ratio is computed from the motions
//! of the bonds at the last substitution of their parts. The true ratio is larger by at most
//!
//! kappa sqrt(sum of |d|^2 over the delayed parts that have bonds of its ends),
//!
//! with the motion d that a part lacks, whose norm is bounded by the motions of the border ([`super::bound`]), and with kappa of the
//! remaining bonds.
//! A ratio is known where no delayed part has bonds of the ends.

use ligament_model::element::BondDeformation;
use ligament_model::failure::CriteriaInState;
use ligament_model::parallel;
use ligament_model::stress::stored::StoredMotions;

use super::division::Division;
use super::per_norm;
use super::reach::Reach;
use crate::problem::Problem;
use crate::state::State;

/// Ratios of all bonds of a body, as far as the motions of its parts are known.
pub(super) struct Around<'a> {
    division: &'a Division,
    reach: &'a Reach,
    problem: &'a Problem,
    stored: Box<dyn StoredMotions + 'a>,
    /// The criteria with the stresses across the bonds by the stored motions.
    pub(super) criteria: CriteriaInState<'a>,
    /// Stored deformations of the bonds, shape (n_bonds).
    deformations: Vec<BondDeformation>,
    /// Ratio of measure to limit of each bond by the stored motions, shape (n_bonds); 0 where it is broken.
    ratios: Vec<f64>,
    /// Upper bound of the ratios of the bonds of each point, shape (n_points).
    at_points: Vec<f64>,
    /// Whether the strain of each point is known, because all parts with bonds of it are up to date, shape (n_points).
    is_known: Vec<bool>,
    /// Points whose strains are known.
    known: Vec<u32>,
    /// Room for marks of points, none of which is set, shape (n_points).
    marks: Vec<bool>,
    /// Largest kappa of the bonds of each part, of its descendants and at its border, shape (n_parts), J^(-1/2).
    per_norm: Vec<f64>,
    /// Norm of the motion that each part and its descendants lacked at its last substitution, shape (n_parts), J^(1/2).
    lacked: Vec<f64>,
    /// Norm of the motion that each part lacks now, shape (n_parts), J^(1/2); up to date for delayed parts whose parent is not delayed.
    lacking: Vec<f64>,
    /// Whether each part was substituted after the last breakage, shape (n_parts).
    is_current: Vec<bool>,
}

/// Bonds and parts that a substitution changed.
#[derive(Default)]
pub(super) struct Changed {
    /// Bonds whose ratios have become known, with their ratios.
    pub(super) known: Vec<(u32, f64)>,
    /// Delayed parts with bonds whose ratios changed, with the largest changed ratio.
    pub(super) raised: Vec<(usize, f64)>,
    /// Delayed parts, whose parent is not delayed, that have bonds of points whose strains changed.
    pub(super) beside: Vec<usize>,
}

impl<'a> Around<'a> {
    /// Ratios in an equilibrium of the whole body, from the criteria in it and the deformations (n_bonds).
    pub(super) fn new(
        (division, reach, problem): (&'a Division, &'a Reach, &'a Problem),
        state: &State,
        criteria: CriteriaInState<'a>,
        deformations: &[BondDeformation],
    ) -> Option<Self> {
        let system = &*problem.system;
        let mut stored = system.stored_motions()?;
        let bonds: Vec<u32> = (0..deformations.len() as u32).collect();
        let points: Vec<u32> = (0..system.n_points() as u32).collect();
        stored.store(&state.displacement, &bonds);
        stored.update_strains(&state.intact, &points);
        stored.update_bounds(&state.intact, &points);
        let n_parts = division.parts.len();
        let mut around = Self {
            division,
            reach,
            problem,
            stored,
            criteria,
            deformations: deformations.to_vec(),
            ratios: Vec::new(),
            at_points: vec![0.0; points.len()],
            is_known: vec![false; points.len()],
            known: Vec::new(),
            marks: vec![false; points.len()],
            per_norm: Vec::new(),
            lacked: vec![0.0; n_parts],
            lacking: vec![0.0; n_parts],
            is_current: vec![false; n_parts],
        };
        let ratio = |place: usize| around.judged(bonds[place], state);
        around.ratios = parallel::values(bonds.len(), 0.0, ratio);
        around.raise_points(&bonds);
        let kappa = |place: usize| around.kappa(bonds[place], state);
        let of_bonds = parallel::values(bonds.len(), 0.0, kappa);
        around.per_norm = reach.largest(division, system, &of_bonds);
        Some(around)
    }

    /// Ratio of a bond by the stored motions; 0 where it is broken.
    pub(super) fn ratio(&self, bond: u32) -> f64 {
        self.ratios[bond as usize]
    }

    /// Begins with the breakage of bonds that had these ends: no part is up to date, and the bounds of bonds beside the broken ones grow.
    /// Returns the parts on which these bonds depend, with their ancestors.
    pub(super) fn begin(&mut self, ends: &[u32], state: &State) -> Vec<usize> {
        let mut near = vec![false; self.is_current.len()];
        self.is_current.fill(false);
        for point in self.known.drain(..) {
            self.is_known[point as usize] = false;
        }
        self.stored.update_bounds(&state.intact, ends);
        let system = &*self.problem.system;
        for &end in ends {
            for &bond in system.incidence.at(end) {
                let kappa = self.kappa(bond, state);
                let both = system.ends[bond as usize];
                let lowest = both.iter().flat_map(|&point| self.reach.parts_at(point));
                for part in lowest.flat_map(|&part| self.division.with_ancestors(part as usize)) {
                    self.per_norm[part] = self.per_norm[part].max(kappa);
                    near[part] = true;
                }
            }
        }
        (0..near.len()).filter(|&part| near[part]).collect()
    }

    /// Updates the ratios for parts that were substituted, and for points whose bonds broke.
    pub(super) fn take_in(
        &mut self,
        parts: &[usize],
        points: &[u32],
        displacement: &[f64],
        state: &State,
    ) -> Changed {
        let system = &*self.problem.system;
        let mut bonds = Vec::new();
        for &part in parts {
            self.is_current[part] = true;
            bonds.extend_from_slice(self.division.bonds(part));
        }
        self.stored.store(displacement, &bonds);
        let deformations = system.measured(&state.intact, displacement, &bonds);
        for (&bond, deformation) in bonds.iter().zip(deformations) {
            self.deformations[bond as usize] = deformation;
        }
        let ends = bonds.iter().flat_map(|&bond| system.ends[bond as usize]);
        let points = self.distinct(ends.chain(points.iter().copied()));
        self.stored.update_strains(&state.intact, &points);
        let bonds = self.bonds_of(&points);
        self.update_stresses(&bonds);
        let judged = parallel::values(bonds.len(), 0.0, |place| self.judged(bonds[place], state));
        for (&bond, ratio) in bonds.iter().zip(judged) {
            self.ratios[bond as usize] = ratio;
        }
        for &point in &points {
            self.at_points[point as usize] = 0.0;
        }
        self.raise_points(&bonds);
        self.changed(&bonds, &points)
    }

    /// The points without repetition, in their order.
    fn distinct(&mut self, points: impl Iterator<Item = u32>) -> Vec<u32> {
        let marks = &mut self.marks;
        let is_new = |point: &u32| !std::mem::replace(&mut marks[*point as usize], true);
        let distinct: Vec<u32> = points.filter(is_new).collect();
        for &point in &distinct {
            self.marks[point as usize] = false;
        }
        distinct
    }

    /// The bonds of different points, without repetition.
    fn bonds_of(&mut self, points: &[u32]) -> Vec<u32> {
        for &point in points {
            self.marks[point as usize] = true;
        }
        let (ends, incidence) = (&self.problem.system.ends, &self.problem.system.incidence);
        let mut bonds = Vec::new();
        for &point in points {
            // A bond of two of the points belongs to its first end.
            let of_point = incidence.at(point).iter().filter(|&&bond| {
                let first = ends[bond as usize][0];
                first == point || !self.marks[first as usize]
            });
            bonds.extend(of_point);
        }
        for &point in points {
            self.marks[point as usize] = false;
        }
        bonds
    }

    /// Raises the largest ratios of points to the ratios of some bonds.
    fn raise_points(&mut self, bonds: &[u32]) {
        let ends = &self.problem.system.ends;
        for &bond in bonds {
            let ratio = self.ratios[bond as usize];
            for end in ends[bond as usize] {
                let at_point = &mut self.at_points[end as usize];
                *at_point = at_point.max(ratio);
            }
        }
    }

    /// Bonds and parts that depend on changed ratios of bonds and changed strains of points.
    fn changed(&mut self, bonds: &[u32], points: &[u32]) -> Changed {
        let mut beside = vec![false; self.is_current.len()];
        for &point in points {
            let parts = self.reach.parts_at(point).iter();
            let mut is_known = true;
            for part in parts.filter_map(|&part| self.delayed_above(part as usize)) {
                beside[part] = true;
                is_known = false;
            }
            if is_known {
                self.is_known[point as usize] = true;
                self.known.push(point);
            }
        }
        let mut changed = Changed::default();
        let mut raised = vec![0.0_f64; self.is_current.len()];
        let ends = &self.problem.system.ends;
        for &bond in bonds {
            let ratio = self.ratio(bond);
            if ends[bond as usize]
                .iter()
                .all(|&end| self.is_known[end as usize])
            {
                changed.known.push((bond, ratio));
            }
            let part = self.division.part_of_bond[bond as usize] as usize;
            if !self.is_current[part] {
                raised[part] = raised[part].max(ratio);
            }
        }
        let raised = raised.into_iter().enumerate();
        changed.raised = raised.filter(|it| it.1 > 0.0).collect();
        changed.beside = (0..beside.len()).filter(|&part| beside[part]).collect();
        changed
    }

    /// Sets the norm of the motion that a delayed part lacks, from the norm of the motion since its last substitution.
    pub(super) fn delay(&mut self, part: usize, since: f64) {
        self.lacking[part] = self.lacked[part] + since;
    }

    /// Sets the norm of the motion that a substituted part lacks, from the norms of its children.
    pub(super) fn combine(&mut self, part: usize) {
        let below = self.division.below[part].iter();
        let squares: f64 = below.map(|&it| self.lacking[it].powi(2)).sum();
        self.lacked[part] = squares.sqrt();
        self.lacking[part] = squares.sqrt();
    }

    /// Present bound of the ratios of all bonds that depend on a delayed part, from the largest one that is stored in it and its
    /// descendants, and the delayed part with the largest lacking motion among the parts on which they depend; None where the part is not
    /// delayed.
    pub(super) fn present(&self, part: usize, largest: f64) -> Option<(f64, usize)> {
        if self.is_current[part] {
            return None;
        }
        let border = self.reach.border(part).iter();
        let at_border = border.map(|&point| self.at_points[point as usize]);
        let largest = at_border.fold(largest, f64::max);
        let beside = self.reach.beside(part).iter();
        let mut delayed: Vec<usize> = beside
            .filter_map(|&it| self.delayed_above(it as usize))
            .chain([part])
            .collect();
        delayed.sort_unstable();
        delayed.dedup();
        let (mut squares, mut most) = (0.0, part);
        for it in delayed {
            squares += self.lacking[it].powi(2);
            if self.lacking[it] > self.lacking[most] {
                most = it;
            }
        }
        Some((largest + self.per_norm[part] * squares.sqrt(), most))
    }

    /// The delayed part, whose parent is not delayed, that contains a part; None where the part is not delayed.
    fn delayed_above(&self, part: usize) -> Option<usize> {
        let chain = self.division.with_ancestors(part);
        chain.take_while(|&it| !self.is_current[it]).last()
    }

    /// Computes the stresses across some bonds from the stored motions.
    fn update_stresses(&mut self, bonds: &[u32]) {
        let stored = &self.stored;
        let stress = |bond: u32, moduli: &_| stored.stress_across(bond, moduli);
        self.criteria.replace_stresses(bonds, stress);
    }

    /// Ratio of a bond by the stored motions.
    fn judged(&self, bond: u32, state: &State) -> f64 {
        if !state.intact[bond as usize] {
            return 0.0;
        }
        let deformation = &self.deformations[bond as usize];
        let verdict = self.criteria.breaking(bond as usize, deformation);
        verdict.map_or(0.0, |it| it.ratio())
    }

    /// Limit by which a bond breaks by the stored motions.
    pub(super) fn limit(&self, bond: u32) -> f64 {
        let deformation = &self.deformations[bond as usize];
        let verdict = self.criteria.breaking(bond as usize, deformation);
        verdict.map_or(0.0, |it| it.limit)
    }

    /// Kappa of a bond with the remaining bonds; 0 where it is broken.
    fn kappa(&self, bond: u32, state: &State) -> f64 {
        if !state.intact[bond as usize] {
            return 0.0;
        }
        let around = self.stored.strain_per_norm(bond);
        per_norm::of_bond(self.problem, &state.intact, bond as usize, around)
    }
}
