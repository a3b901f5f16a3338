//! Strains of bonds with strains of their own (`mbb-pd`), from the stored motions of the points of a lattice.

use ligament_model::element::BondDeformation;
use ligament_model::element::imaginary::LatticeStrains;
use ligament_output::results::stored::{Motions, StoredRun};

/// The bonds of a stored lattice, and whether each is intact.
pub(super) struct Strains {
    lattice: LatticeStrains,
    /// Step in which each bond broke, shape (n_bonds).
    broke_in: Vec<Option<usize>>,
    intact: Vec<bool>,
    /// Whether a stored step precedes the breakages of its step.
    before_breakages: bool,
}

impl Strains {
    /// The strains of a run; `None` where its bonds have no strains of their own.
    pub(super) fn from_run(run: &StoredRun, before_breakages: bool) -> Option<Self> {
        if !run.has_own_strains() {
            return None;
        }
        let model = &run.model;
        let positions = model.positions.iter().map(|p| [p[0], p[1]]).collect();
        let pairs = model.bonds.ends.iter().zip(&model.bonds.absence);
        // Bonds precede absent bonds, so that bonds and pairs have the same indices.
        let bonds = pairs.take_while(|(_, absence)| absence.is_none());
        let ends: Vec<[u32; 2]> = bonds.map(|(ends, _)| *ends).collect();
        let horizon = model.bonds.horizon[..ends.len()].to_vec();
        let lattice = LatticeStrains::new(positions, ends, horizon);
        Some(Self {
            broke_in: breakages(run, lattice.ends()),
            intact: vec![true; lattice.ends().len()],
            lattice,
            before_breakages,
        })
    }

    /// Sets the state to a stored step.
    pub(super) fn go_to(&mut self, step: usize) {
        for (intact, broke_in) in self.intact.iter_mut().zip(&self.broke_in) {
            *intact = broke_in.is_none_or(|broke| {
                if self.before_breakages {
                    step <= broke
                } else {
                    step < broke
                }
            });
        }
    }

    /// The deformation of a bond, without thermal strain.
    pub(super) fn deformation(&self, bond: usize, motions: &Motions) -> BondDeformation {
        let in_plane: Vec<[f64; 2]> = motions.displacement.iter().map(|u| [u[0], u[1]]).collect();
        let free = match motions.thermal_strain.is_empty() {
            true => None,
            false => Some((motions.thermal_strain.times(1.0)).of_bond(self.lattice.ends()[bond])),
        };
        (self.lattice).deformation(bond, &in_plane, &self.intact, free.as_ref())
    }
}

/// Step in which each bond broke, shape (n_bonds).
pub(super) fn breakages(run: &StoredRun, ends: &[[u32; 2]]) -> Vec<Option<usize>> {
    let mut broke_in = vec![None; ends.len()];
    let mut points: Vec<(i64, u32)> = run.model.tags.iter().copied().zip(0..).collect();
    points.sort_unstable();
    let point_of = |tag: i64| {
        let place = points.binary_search_by_key(&tag, |(tag, _)| *tag).ok()?;
        Some(points[place].1)
    };
    for broke in &run.breaks {
        let [Some(a), Some(b)] = broke.tags.map(point_of) else {
            continue;
        };
        if let Ok(bond) = ends.binary_search(&[a.min(b), a.max(b)]) {
            broke_in[bond] = Some(broke.at.step);
        }
    }
    broke_in
}
