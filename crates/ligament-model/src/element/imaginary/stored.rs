//! Strains of the bonds of a stored lattice, from positions, ends and motions alone.

use super::{ImaginaryElement, ImaginaryElements, StrainStiffness};
use crate::bonds::{BondSet, Composition, Incidence};
use crate::element::{BondDeformation, Element, Rigidities};
use crate::tensor::{SymTensor, minus, norm};

/// Bonds of a lattice with the strains of their elements, without a stiffness.
#[derive(Debug)]
pub struct LatticeStrains {
    bonds: BondSet,
    elements: ImaginaryElements,
    rigidities: Rigidities,
}

impl LatticeStrains {
    /// The bonds between points at some positions (n_points), m, with their ends and horizons (m), shape (n_bonds) each.
    pub fn new(positions: Vec<[f64; 2]>, ends: Vec<[u32; 2]>, horizon: Vec<f64>) -> Self {
        let offset = |[a, b]: &[u32; 2]| minus(positions[*b as usize], positions[*a as usize]);
        let offsets: Vec<[f64; 2]> = ends.iter().map(offset).collect();
        let length: Vec<f64> = offsets.iter().map(|it| norm(*it)).collect();
        let of_ends = (0..).zip(&ends);
        let of_ends = of_ends.flat_map(|(bond, ends)| ends.map(|end| (end, bond)));
        let bonds = BondSet {
            incidence: Incidence::from_pairs(of_ends, positions.len()).into(),
            direction: (offsets.iter().zip(&length))
                .map(|(offset, length)| offset.map(|it| it / length))
                .collect(),
            horizon: horizon.into(),
            length,
            ends: ends.into(),
            composition: Composition::default(),
        };
        let none = StrainStiffness {
            entries: [0.0; 6],
            first_share: 0.5,
        };
        Self {
            rigidities: Rigidities {
                strain: vec![none; bonds.len()],
                ..Rigidities::default()
            },
            elements: ImaginaryElements::new(&bonds, positions),
            bonds,
        }
    }

    /// Ends of the bonds, shape (n_bonds).
    pub fn ends(&self) -> &[[u32; 2]] {
        &self.bonds.ends
    }

    /// Deformation of a bond under displacements of the points (n_points), m, while the bonds marked in `intact` (n_bonds) are unbroken,
    /// less that of a stress-free strain.
    pub fn deformation(
        &self,
        bond: usize,
        displacements: &[[f64; 2]],
        intact: &[bool],
        free: Option<&SymTensor<2>>,
    ) -> BondDeformation {
        let (elements, bonds) = (&self.elements, &self.bonds);
        let element = ImaginaryElement::new(elements, bonds, &self.rigidities, intact, bond);
        let whole = element.deformation(displacements.as_flattened());
        free.map_or(whole, |free| whole.less(&element.deformation_in(free)))
    }
}
