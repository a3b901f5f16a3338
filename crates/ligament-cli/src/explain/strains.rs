//! Strains of bonds that have some of their own, from the stored motions of the points of a lattice.

use ligament_model::BondSet;
use ligament_model::bonds::{Composition, Incidence};
use ligament_model::element::imaginary::{ImaginaryElements, StrainStiffness};
use ligament_model::element::{BondDeformation, Element, Elements, Rigidities};
use ligament_output::results::stored::{Motions, StoredRun};

/// The bonds of a stored lattice, and which of them are unbroken.
pub(super) struct Strains {
    bonds: BondSet,
    rigidities: Rigidities,
    elements: ImaginaryElements,
    /// Step in which each bond broke, shape (n_bonds).
    broke_in: Vec<Option<usize>>,
    intact: Vec<bool>,
    /// Whether a moment is just before the breakages of its step.
    before_breakages: bool,
}

impl Strains {
    /// The strains of a run; None where its bonds have no strains of their own.
    pub(super) fn from_run(run: &StoredRun, before_breakages: bool) -> Option<Self> {
        if run.deformation_names.len() < 3 {
            return None;
        }
        let model = &run.model;
        let positions: Vec<[f64; 2]> = model.positions.iter().map(|p| [p[0], p[1]]).collect();
        let pairs = model.bonds.ends.iter().zip(&model.bonds.absence);
        // Bonds stand before pairs that are none, so that both have the same numbers.
        let ends: Vec<[u32; 2]> = pairs
            .take_while(|(_, absence)| absence.is_none())
            .map(|(ends, _)| *ends)
            .collect();
        let offset = |[a, b]: [u32; 2]| {
            let [a, b] = [a, b].map(|end| positions[end as usize]);
            [b[0] - a[0], b[1] - a[1]]
        };
        let offsets: Vec<[f64; 2]> = ends.iter().map(|ends| offset(*ends)).collect();
        let length: Vec<f64> = offsets.iter().map(|[x, y]| x.hypot(*y)).collect();
        let of_ends = (0..).zip(&ends);
        let of_ends = of_ends.flat_map(|(bond, ends)| ends.map(|end| (end, bond)));
        let bonds = BondSet {
            incidence: Incidence::from_pairs(of_ends, model.positions.len()),
            direction: (offsets.iter().zip(&length))
                .map(|(offset, length)| offset.map(|it| it / length))
                .collect(),
            horizon: model.bonds.horizon[..ends.len()].to_vec(),
            length,
            ends,
            composition: Composition::default(),
        };
        // Strains need no stiffness.
        let none = StrainStiffness {
            entries: [0.0; 6],
            first_share: 0.5,
        };
        let elements = ImaginaryElements::new(&bonds, positions);
        Some(Self {
            rigidities: Rigidities {
                strain: vec![none; bonds.len()],
                ..Rigidities::default()
            },
            broke_in: breakages(run, &bonds),
            intact: vec![true; bonds.len()],
            elements,
            bonds,
            before_breakages,
        })
    }

    /// Goes to the moment of a step.
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

    /// The deformation of a bond, without what the temperature gives it.
    pub(super) fn deformation(&self, bond: usize, motions: &Motions) -> BondDeformation {
        let in_plane: Vec<[f64; 2]> = motions.displacement.iter().map(|u| [u[0], u[1]]).collect();
        let element = (self.elements).element(&self.bonds, &self.rigidities, &self.intact, bond);
        let whole = element.deformation(in_plane.as_flattened());
        if motions.thermal_strain.is_empty() {
            return whole;
        }
        let free = motions.thermal_strain.times(1.0);
        whole.less(&element.deformation_in(&free.of_bond(self.bonds.ends[bond])))
    }
}

/// Step in which each bond broke, shape (n_bonds).
fn breakages(run: &StoredRun, bonds: &BondSet) -> Vec<Option<usize>> {
    let mut broke_in = vec![None; bonds.len()];
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
        if let Ok(bond) = bonds.ends.binary_search(&[a.min(b), a.max(b)]) {
            broke_in[bond] = Some(broke.at.step);
        }
    }
    broke_in
}
