//! The far field: linear finite elements in place of bonds, where nothing breaks.
//!
//! A triangle or tetrahedron of the volume V, with linear shape functions N_a of its corners, has between two corners the stiffness
//! K_ab = V B_a^T C B_b, with eps = sum B_a u_a (Zienkiewicz 2013). A translation makes no force, so that the
//! force at a point is K u = sum over the other corners b of K_ab (u_b - u_a): the elements are couplings of pairs of points, as bonds are.
//!
//! Elements pass a uniform strain exactly. Bonds with the [patch correction](crate::correction::patch) on their own cells bear the same
//! forces at the border of these cells as elements would in a uniform strain, so that bonds and elements share a point without a seam.

use std::sync::Arc;

use ligament_mesh::MeshCell;
use rayon::prelude::*;

use crate::bonds::Incidence;
use crate::cloud::PointCloud;
use crate::correction::patch::gradients;
use crate::material::{Stiffness, stress};
use crate::parallel;
use crate::tensor::{SymTensor, dot, minus};
use crate::topology::CoupledPoints;

/// Stiffness block between two points, rows by columns, N/m.
type Block<const D: usize> = [[f64; D]; D];

/// Triangle or tetrahedron with the index of its material.
#[derive(Debug, Clone, Copy)]
pub struct Simplex<C> {
    /// Cell with D + 1 corners.
    pub cell: C,
    /// Index of the material.
    pub material: u32,
}

/// Linear finite elements, summed to couplings of pairs of points.
#[derive(Debug, Clone)]
pub struct FarField<const D: usize> {
    /// Points A < B of each coupling, shape (n_couplings), in ascending order.
    ends: Arc<[[u32; 2]]>,
    /// Stiffness K_AB of each coupling: force at A for a motion of B, shape (n_couplings).
    blocks: Vec<Block<D>>,
    /// Couplings of each point.
    couplings: Arc<Incidence>,
    /// Other points that bonds, crack faces or elements couple with each point, ascending.
    pub(crate) coupled_points: CoupledPoints,
    /// Points that elements couple with each point.
    pub(crate) neighbours: CoupledPoints,
    /// Volume of the elements at each point, shape (n_points), m^3.
    volumes: Vec<f64>,
}

impl<const D: usize> FarField<D> {
    /// Elements between the points of a cloud with the stiffnesses of its materials (n_materials), Pa; `coupled` has the points that bonds
    /// and crack faces couple.
    pub fn new<C: MeshCell<D>>(
        cloud: &PointCloud<D>,
        simplices: &[Simplex<C>],
        stiffness: &[Stiffness],
        coupled: &CoupledPoints,
    ) -> Self {
        let edges = |it: &Simplex<C>| it.cell.edges().collect::<Vec<_>>();
        let mut ends: Vec<[u32; 2]> = simplices.iter().flat_map(edges).collect();
        ends.par_sort_unstable();
        ends.dedup();
        let mut blocks = vec![[[0.0; D]; D]; ends.len()];
        let mut volumes = vec![0.0; cloud.len()];
        for simplex in simplices {
            let corners = simplex.cell.corners();
            let share = volume_of(cloud, simplex) / corners.len() as f64;
            corners.iter().for_each(|it| volumes[*it as usize] += share);
            let of_cell = blocks_of(cloud, simplex, &stiffness[simplex.material as usize]);
            for (of_edge, block) in of_cell {
                let place = ends.binary_search(&of_edge);
                let sums = &mut blocks[place.expect("every edge of a cell is listed")];
                for (sum, value) in (sums.as_flattened_mut().iter_mut()).zip(block.as_flattened()) {
                    *sum += value;
                }
            }
        }
        let couplings = Arc::new(Incidence::new(&ends, cloud.len()));
        let ends = ends.into();
        let neighbours = CoupledPoints::from_bonds(&ends, &couplings);
        Self {
            coupled_points: union_of_couplings([coupled, &neighbours], cloud.len()),
            neighbours,
            ends,
            blocks,
            couplings,
            volumes,
        }
    }

    /// Points A < B of each coupling, shape (n_couplings).
    pub fn ends(&self) -> &[[u32; 2]] {
        &self.ends
    }

    /// Couplings of a point A with their other points B, and the stiffness K_AB.
    fn couplings_of(&self, point: u32) -> impl Iterator<Item = (u32, Block<D>)> + '_ {
        self.couplings.at(point).iter().map(move |&coupling| {
            let [a, b] = self.ends[coupling as usize];
            let block = self.blocks[coupling as usize];
            match a == point {
                true => (b, block),
                false => (a, transposed(&block)),
            }
        })
    }

    /// Force K u of the elements at each point, N, for motions with M components a point, the displacements first.
    #[inline]
    pub(crate) fn forces<const M: usize>(&self, n_points: usize, motions: &[f64]) -> Vec<[f64; D]> {
        parallel::values(n_points, [0.0; D], |point| {
            let own = displacement::<D>(motions, M, point as u32);
            let mut force = [0.0; D];
            for (other, block) in self.couplings_of(point as u32) {
                let moved = minus(displacement(motions, M, other), own);
                (0..D).for_each(|axis| force[axis] += dot(block[axis], moved));
            }
            force
        })
    }

    /// Volume of the elements at a point, m^3: the corners of an element have equal parts.
    pub fn volume(&self, point: u32) -> f64 {
        self.volumes[point as usize]
    }

    /// Adds the blocks in the columns of a point, in the rows of its `lower` points (ascending) and of itself, shape (n_lower + 1,
    /// n_components, n_components).
    pub(crate) fn add_blocks<const M: usize>(&self, point: u32, lower: &[u32], blocks: &mut [f64]) {
        let mut add = |place: usize, block: &Block<D>, sign: f64| {
            for (row, values) in block.iter().enumerate() {
                let first = (place * M + row) * M;
                for (sum, value) in blocks[first..].iter_mut().zip(values) {
                    *sum += sign * value;
                }
            }
        };
        for (other, block) in self.couplings_of(point) {
            add(lower.len(), &block, -1.0);
            if let Ok(place) = lower.binary_search(&other) {
                add(place, &transposed(&block), 1.0);
            }
        }
    }

    /// Sum of the sizes of the couplings of a point, N/m.
    pub(crate) fn stiffness_at(&self, point: u32) -> f64 {
        let sizes = self.couplings_of(point).map(|(_, block)| {
            let rows = block.map(|row| row.iter().map(|it| it.abs()).sum());
            rows.into_iter().fold(0.0, f64::max)
        });
        sizes.sum()
    }
}

/// Points that some of the lists couple with each point, ascending.
pub(crate) fn union_of_couplings(lists: [&CoupledPoints; 2], n_points: usize) -> CoupledPoints {
    let of_point = |point: u32| {
        let mut others: Vec<u32> = lists.iter().flat_map(|it| it.at(point)).collect();
        others.sort_unstable();
        others.dedup();
        others.into_iter().map(move |other| (point, other))
    };
    let of_points = (0..n_points as u32).flat_map(of_point);
    CoupledPoints::from_lists(&Arc::new(Incidence::from_pairs(of_points, n_points)))
}

/// Displacement of a point from motions with some components per point.
fn displacement<const D: usize>(motions: &[f64], n_components: usize, point: u32) -> [f64; D] {
    let first = n_components * point as usize;
    std::array::from_fn(|axis| motions[first + axis])
}

fn transposed<const D: usize>(block: &Block<D>) -> Block<D> {
    std::array::from_fn(|row| std::array::from_fn(|column| block[column][row]))
}

/// Volume of a triangle, with the thickness of the body, or of a tetrahedron, m^3.
fn volume_of<const D: usize, C: MeshCell<D>>(cloud: &PointCloud<D>, simplex: &Simplex<C>) -> f64 {
    cloud.thickness * simplex.cell.size(&cloud.positions)
}

/// Blocks K_ab = V B_a^T C B_b of the edges of a triangle or tetrahedron.
fn blocks_of<const D: usize, C: MeshCell<D>>(
    cloud: &PointCloud<D>,
    simplex: &Simplex<C>,
    stiffness: &Stiffness,
) -> Vec<([u32; 2], Block<D>)> {
    let corners = simplex.cell.corners();
    let volume = volume_of(cloud, simplex);
    let gradients = gradients(corners, cloud);
    // Stress of a unit motion of a corner along each axis, times the volume: the gradients are integrals over the cell.
    let stresses: Vec<[SymTensor<D>; D]> = (gradients.iter())
        .map(|gradient| {
            std::array::from_fn(|axis| {
                let along = std::array::from_fn(|it| if it == axis { 1.0 } else { 0.0 });
                stress(stiffness, &SymTensor::dyad(along, *gradient))
            })
        })
        .collect();
    let of_corners = |[a, b]: [u32; 2]| {
        let place = |it: u32| corners.iter().position(|corner| *corner == it).unwrap_or(0);
        let [one, other] = [place(a), place(b)];
        let columns = stresses[other].map(|it| it.times(gradients[one]));
        let block = transposed(&columns.map(|column| column.map(|it| it / volume)));
        ([a, b], block)
    };
    simplex.cell.edges().map(of_corners).collect()
}
