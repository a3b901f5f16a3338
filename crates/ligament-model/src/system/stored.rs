//! Bonds between the points of a stored run, which deform as they did in the run and resist nothing.

use std::array::from_fn;
use std::sync::Arc;

use rayon::prelude::*;

use super::BondSystem;
use crate::bonds::{BondSet, Composition, Incidence};
use crate::cloud::PointCloud;
use crate::element::ElementKind;
use crate::element::strain_stiffness::StrainStiffness;
use crate::interface::Bonds;
use crate::law::BondStiffness;
use crate::tensor::{minus, norm};

/// Ends of bonds, in ascending order with A < B; horizons, m; and weights Omega alpha in the damage of the ends, shape (n_bonds) each.
pub type StoredBondValues = (Vec<[u32; 2]>, Vec<f64>, Vec<f64>);

/// Bonds without stiffness in space, or in the plane z = 0, between points with positions (n_points), m, and volumes (n_points), m^3.
pub fn without_stiffness(
    positions: &[[f64; 3]],
    is_in_space: bool,
    volumes: &[f64],
    element: ElementKind,
    bonds: StoredBondValues,
) -> Arc<dyn Bonds> {
    match is_in_space {
        true => in_dimensions::<3>(positions, volumes, element, bonds),
        false => in_dimensions::<2>(positions, volumes, element, bonds),
    }
}

fn in_dimensions<const D: usize>(
    positions: &[[f64; 3]],
    volumes: &[f64],
    element: ElementKind,
    (ends, horizon, weight): StoredBondValues,
) -> Arc<dyn Bonds> {
    let positions = positions.iter();
    let positions: Vec<[f64; D]> = positions.map(|it| from_fn(|axis| it[axis])).collect();
    let cloud = PointCloud {
        volumes: volumes.into(),
        ..PointCloud::at(&positions, 1.0, 1)
    };
    let n_bonds = ends.len();
    let along = |[a, b]: &[u32; 2]| {
        let offset = minus(positions[*b as usize], positions[*a as usize]);
        let length = norm(offset);
        (length, offset.map(|it| it / length))
    };
    let (length, direction) = ends.par_iter().map(along).unzip();
    let bonds = BondSet {
        incidence: Incidence::new(&ends, positions.len()).into(),
        ends: ends.into(),
        length,
        direction,
        horizon: horizon.into(),
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
    BondSystem::new(cloud, bonds, element, stiffness, weight, &whole).with_elements()
}
