//! Borders of parts, and the stiffness of bonds from inside a part at the points around it.

use ligament_model::Bonds;
use ligament_model::element::StiffnessFactors;
use ligament_model::parallel;
use ligament_model::thermal::ThermalStrain;

use super::bound::{Bound, Modes, NOT_THERE};
use super::division::Division;
use crate::problem::Problem;
use crate::solver::n_axes;

/// Part, border point and element between them.
type Across = (u32, u32, Element);

/// An element by its number.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Element {
    Bond(u32),
    Patch(u32),
}

/// Bounds of all parts of a body.
pub(super) struct Bounds {
    of_parts: Vec<Bound>,
    modes: Modes,
}

impl Bounds {
    /// Bounds for a division; None where bonds reach points whose rows are not in the border of the factor.
    pub(super) fn new(problem: &Problem, division: &Division) -> Option<Self> {
        let system = &*problem.system;
        let modes = Modes::of_body(system);
        let mut stiffness = strain_stiffness(system, division, &modes.strain);
        let whole = vec![true; division.part_of_bond.len()];
        for part in (1..division.parts.len()).rev() {
            if let Some(above) = division.parts[part].above {
                let of_part = stiffness[part].clone();
                let sums = stiffness[above].iter_mut().zip(of_part);
                sums.for_each(|(sum, value)| *sum += value);
            }
        }
        let across = across(system, division);
        let mut row_of = vec![usize::MAX; system.layout.n_degrees_of_freedom()];
        for (row, &dof) in division.degree_of_freedom.iter().enumerate() {
            row_of[dof as usize] = row;
        }
        let bound = |(part, stiffness)| {
            let first = |part: usize| across.partition_point(|it| (it.0 as usize) < part);
            let border = Border::new(
                (system, &whole),
                division,
                &across[first(part)..first(part + 1)],
            );
            let places = border.places(&division.parts[part].border, &row_of)?;
            let Border { dofs, blocks } = border;
            Some(Bound::new(&modes, (dofs, places), blocks, stiffness))
        };
        let numbered = stiffness.into_iter().enumerate();
        Some(Self {
            of_parts: parallel::map(numbered, bound)
                .into_iter()
                .collect::<Option<_>>()?,
            modes,
        })
    }

    /// Degrees of freedom of the points of the border of a part.
    pub(super) fn border(&self, part: usize) -> &[u32] {
        self.of_parts[part].border()
    }

    /// Bound of the norm |d| of the motion of a part since its border had the motions `then`; displacements are by degree of freedom.
    pub(super) fn norm(&self, part: usize, displacement: &[f64], then: &[f64]) -> f64 {
        self.of_parts[part].norm(&self.modes, displacement, then)
    }
}

/// Points of a border, with the stiffness of the bonds into the part.
struct Border {
    dofs: Vec<u32>,
    blocks: Vec<f64>,
}

impl Border {
    /// Border from the elements across it, in the order of the points.
    fn new((system, whole): (&dyn Bonds, &[bool]), division: &Division, across: &[Across]) -> Self {
        let layout = system.layout;
        let n = layout.components.len();
        let (mut dofs, mut blocks) = (Vec::new(), Vec::new());
        for of_point in across.chunk_by(|one, other| one.1 == other.1) {
            let range = layout.range(of_point[0].1);
            let start = blocks.len();
            blocks.resize(start + n * n, 0.0);
            dofs.extend(range.clone().map(|dof| dof as u32));
            let mut add = |rigidity: f64, own: &[(usize, f64)]| {
                for &(i, of_i) in own {
                    for &(j, of_j) in own {
                        blocks[start + n * i + j] += rigidity * of_i * of_j;
                    }
                }
            };
            for &(_, point, element) in of_point {
                match element {
                    Element::Bond(bond) => {
                        for (rigidity, entries) in
                            system.terms(whole, bond as usize, &StiffnessFactors::WHOLE)
                        {
                            let own = entries.iter().filter(|(dof, _)| range.contains(dof));
                            let own: Vec<(usize, f64)> = own
                                .map(|(dof, value)| (dof - range.start, *value))
                                .collect();
                            add(rigidity, &own);
                        }
                    }
                    Element::Patch(patch) => {
                        let corners = division.patches[patch as usize].1.corners.iter();
                        for (_, row) in corners.filter(|it| it.0 == point) {
                            let own: Vec<(usize, f64)> =
                                row.iter().copied().enumerate().take(n).collect();
                            add(1.0, &own);
                        }
                    }
                }
            }
        }
        Self { dofs, blocks }
    }

    /// Indices of the degrees of freedom among the rows of a part's border; None where a row is missing there.
    fn places(&self, rows: &[usize], row_of: &[usize]) -> Option<Vec<u32>> {
        let place = |&dof: &u32| match row_of[dof as usize] {
            usize::MAX => Some(NOT_THERE),
            row => rows.binary_search(&row).ok().map(|place| place as u32),
        };
        self.dofs.iter().map(place).collect()
    }
}

/// Bonds and patches from parts to points of their borders: part, point and element, ascending.
fn across(system: &dyn Bonds, division: &Division) -> Vec<Across> {
    let mut across = Vec::new();
    let mut add = |lowest: u32, point: u32, element: Element| {
        let own = division.part_of(point);
        let mut part = lowest as usize;
        while part != own {
            across.push((part as u32, point, element));
            match division.parts[part].above {
                Some(above) => part = above,
                None => break,
            }
        }
    };
    for (bond, ends) in (0..).zip(system.ends.iter()) {
        for &end in ends {
            add(
                division.part_of_bond[bond as usize],
                end,
                Element::Bond(bond),
            );
        }
    }
    for (number, (lowest, patch)) in (0..).zip(&division.patches) {
        for point in patch.points() {
            add(*lowest, point, Element::Patch(number));
        }
    }
    across.sort_unstable();
    across
}

/// Twice the energy of the strain modes in the bonds of each part alone, shape (n_parts)(n_strains, n_strains), J.
fn strain_stiffness(system: &dyn Bonds, division: &Division, modes: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let whole = vec![true; division.part_of_bond.len()];
    let of_mode = |mode: &Vec<f64>| system.deformations(&whole, mode, ThermalStrain::NONE);
    let deformations: Vec<_> = modes.iter().map(of_mode).collect();
    let of_part = |part: usize| {
        let mut stiffness = vec![0.0; modes.len() * modes.len()];
        for &bond in division.bonds(part) {
            for (i, of_i) in deformations.iter().enumerate() {
                for (j, of_j) in deformations.iter().enumerate() {
                    let remaining = &StiffnessFactors::WHOLE;
                    let energy =
                        system.mutual_energy(&whole, bond as usize, remaining, [of_i, of_j]);
                    stiffness[modes.len() * i + j] += 2.0 * energy;
                }
            }
        }
        stiffness
    };
    let mut of_parts = parallel::map(0..division.parts.len(), of_part);
    // The modes of one axis have the dilatation 1, those of two axes none.
    let n = n_axes(system);
    let pairs = (0..n).flat_map(|i| (i..n).map(move |j| (i, j)));
    let dilatations: Vec<f64> = pairs.map(|(i, j)| if i == j { 1.0 } else { 0.0 }).collect();
    for (part, patch) in &division.patches {
        let stiffness = &mut of_parts[*part as usize];
        for (i, of_i) in dilatations.iter().enumerate() {
            for (j, of_j) in dilatations.iter().enumerate() {
                stiffness[modes.len() * i + j] += patch.rigidity * of_i * of_j;
            }
        }
    }
    of_parts
}
