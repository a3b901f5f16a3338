//! Bonds between the points of a stored run, which deform as they did in the run and resist nothing.

use rayon::prelude::*;

use super::BondSystem;
use crate::bonds::{BondSet, Composition, Incidence};
use crate::cloud::PointCloud;
use crate::element::ElementKind;
use crate::element::strain_stiffness::StrainStiffness;
use crate::law::BondStiffness;
use crate::tensor::{minus, norm};

/// Values of the bonds of a stored run.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StoredBonds {
    /// Points A < B of each bond, shape (n_bonds), in ascending order.
    pub ends: Vec<[u32; 2]>,
    /// Horizon of each bond, shape (n_bonds), m.
    pub horizon: Vec<f64>,
    /// Weight Omega alpha of each bond in the damage of its ends, shape (n_bonds).
    pub weight: Vec<f64>,
}

impl<const D: usize> BondSystem<D> {
    /// Bonds without stiffness between points with positions (n_points), m, and volumes (n_points), m^3.
    pub fn without_stiffness(
        positions: &[[f64; D]],
        volumes: &[f64],
        bonds: StoredBonds,
        element: ElementKind,
    ) -> Self {
        let cloud = PointCloud {
            volumes: volumes.into(),
            ..PointCloud::at(positions, 1.0, 1)
        };
        let n_bonds = bonds.ends.len();
        let along = |[a, b]: &[u32; 2]| {
            let offset = minus(positions[*b as usize], positions[*a as usize]);
            let length = norm(offset);
            (length, offset.map(|it| it / length))
        };
        let (length, direction) = bonds.ends.par_iter().map(along).unzip();
        let set = BondSet {
            incidence: Incidence::new(&bonds.ends, positions.len()).into(),
            ends: bonds.ends.into(),
            length,
            direction,
            horizon: bonds.horizon.into(),
            composition: Composition::default(),
        };
        let no_strain = StrainStiffness {
            entries: [0.0; 6],
            first_share: 0.5,
        };
        let stiffness = BondStiffness {
            axial: vec![0.0; n_bonds],
            shear: vec![0.0; n_bonds],
            rotational: vec![0.0; n_bonds],
            strain: vec![no_strain; if element.has_strains() { n_bonds } else { 0 }],
            series: Vec::new(),
            held: Vec::new(),
            exchange: Vec::new(),
        };
        let whole = vec![1.0; n_bonds];
        Self::new(cloud, set, element, stiffness, bonds.weight, &whole)
    }
}
