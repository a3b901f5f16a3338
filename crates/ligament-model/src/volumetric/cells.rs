//! Cells that carry a volumetric stiffness.

use std::ops::Range;

use ligament_mesh::MeshCell;

use crate::cloud::PointCloud;
use crate::cloud::lattice::Lattice;
use crate::correction::patch::{block_gradient, blocks, gradients};
use crate::shape::Region;

/// Cells between the points of a body with the integrals of the gradients of their shape functions, as arrays over the cells and their corners.
#[derive(Debug, Clone, Default)]
pub struct VolumetricCells<const D: usize> {
    /// Corners of all cells, cell by cell.
    pub(super) corners: Vec<u32>,
    /// Integral G of the gradient of the shape function of each of `corners`, m^2.
    pub(super) gradients: Vec<[f64; D]>,
    /// Index after the last corner of each cell, shape (n_cells).
    corner_ends: Vec<usize>,
    /// Edges of all cells, cell by cell, from the lower to the higher point.
    edges: Vec<[u32; 2]>,
    /// Index after the last edge of each cell, shape (n_cells).
    edge_ends: Vec<usize>,
    /// Volumes, shape (n_cells), m^3.
    pub(super) volumes: Vec<f64>,
    /// Index of the material of each cell, shape (n_cells).
    pub(super) materials: Vec<u32>,
}

impl<const D: usize> VolumetricCells<D> {
    /// Blocks between the points of a lattice, which are the centres of its cells, with the index of the material of each point. A block between
    /// several materials belongs to the one with the smallest modulus kappa (n_materials), the first of equals.
    pub fn from_lattice<S: Region<D>>(
        lattice: &Lattice<D, S>,
        cloud: &PointCloud<D>,
        material_of_point: &[u32],
        moduli: &[f64],
    ) -> Self {
        let volume = cloud.thickness * lattice.spacing.iter().product::<f64>();
        let material = |point: &u32| material_of_point[*point as usize];
        let smaller = |one: u32, other: u32| match moduli[other as usize] < moduli[one as usize] {
            true => other,
            false => one,
        };
        let mut cells = Self::default();
        for block in blocks(lattice) {
            let corners = block.iter().enumerate();
            let corners = corners.map(|(k, &point)| (point, block_gradient(&block, k, cloud)));
            let edges = (0..block.len()).flat_map(|corner| {
                let uppers = (0..D).map(move |axis| [corner, corner | (1 << axis)]);
                uppers.filter(|[corner, upper]| upper != corner)
            });
            let edges = edges.map(|ends| ends.map(|corner| block[corner]));
            let edges = edges.map(|[a, b]| [a.min(b), a.max(b)]);
            let softest = block.iter().map(material).reduce(smaller);
            cells.push(corners, edges, volume, softest.unwrap_or_default());
        }
        cells
    }

    /// Number of cells.
    pub fn len(&self) -> usize {
        self.volumes.len()
    }

    /// Whether there is no cell.
    pub fn is_empty(&self) -> bool {
        self.volumes.is_empty()
    }

    /// Adds a cell of a mesh with the index of its material, from the triangles or tetrahedra that make it up.
    pub fn push_cell<C: MeshCell<D>>(
        &mut self,
        cell: &C,
        simplices: &[C],
        material: u32,
        cloud: &PointCloud<D>,
    ) {
        let corners = cell.corners();
        let mut sums = vec![[0.0; D]; corners.len()];
        let mut volume = 0.0;
        for simplex in simplices {
            volume += cloud.thickness * simplex.size(&cloud.positions);
            let of_simplex = gradients(simplex.corners(), cloud);
            for (corner, gradient) in simplex.corners().iter().zip(of_simplex) {
                let place = corners.iter().position(|it| it == corner);
                if let Some(sum) = place.and_then(|place| sums.get_mut(place)) {
                    (0..D).for_each(|axis| sum[axis] += gradient[axis]);
                }
            }
        }
        let corners = corners.iter().copied().zip(sums);
        self.push(corners, cell.edges(), volume, material);
    }

    /// Adds a cell from its corners with the integrals of their gradients (m^2), its edges, its volume (m^3) and the index of its material.
    pub(crate) fn push(
        &mut self,
        corners: impl Iterator<Item = (u32, [f64; D])>,
        edges: impl Iterator<Item = [u32; 2]>,
        volume: f64,
        material: u32,
    ) {
        for (corner, gradient) in corners {
            self.corners.push(corner);
            self.gradients.push(gradient);
        }
        self.corner_ends.push(self.corners.len());
        self.edges.extend(edges);
        self.edge_ends.push(self.edges.len());
        self.volumes.push(volume);
        self.materials.push(material);
    }

    /// Edges of the cells of some materials, marked in `counts` (n_materials), each once, ascending.
    pub fn distinct_edges(&self, counts: &[bool]) -> Vec<[u32; 2]> {
        let cells = (0..self.len()).filter(|&cell| counts[self.materials[cell] as usize]);
        let mut edges: Vec<[u32; 2]> = cells.flat_map(|cell| self.edges(cell)).copied().collect();
        edges.sort_unstable();
        edges.dedup();
        edges
    }

    /// The cells for which `keep` is true.
    pub(super) fn retained(&self, keep: impl Fn(usize) -> bool) -> Self {
        let mut kept = Self::default();
        for cell in (0..self.len()).filter(|&cell| keep(cell)) {
            let corners = self.places(cell);
            let corners = corners.map(|place| (self.corners[place], self.gradients[place]));
            let edges = self.edges(cell).iter().copied();
            kept.push(corners, edges, self.volumes[cell], self.materials[cell]);
        }
        kept
    }

    /// The cells with their points renumbered: `numbers` has the new number of each.
    pub(super) fn renumbered(mut self, numbers: &[u32]) -> Self {
        let ends = self.edges.as_flattened_mut().iter_mut();
        for point in self.corners.iter_mut().chain(ends) {
            *point = numbers[*point as usize];
        }
        self
    }

    /// Places of the corners of a cell in the arrays over corners.
    pub(super) fn places(&self, cell: usize) -> Range<usize> {
        range(&self.corner_ends, cell)
    }

    /// Edges of a cell.
    pub(super) fn edges(&self, cell: usize) -> &[[u32; 2]] {
        &self.edges[range(&self.edge_ends, cell)]
    }
}

/// Range of one list in concatenated lists, from the index after each.
fn range(ends: &[usize], number: usize) -> Range<usize> {
    let start = number.checked_sub(1).map_or(0, |before| ends[before]);
    start..ends[number]
}
