//! Mean dilatations of the cells around the points, with their pressures and forces.

use super::cells::VolumetricCells;
use crate::bonds::{BondSet, Incidence};
use crate::correction::patch::{CellForces, uniform_strains};
use crate::far_field::union_of_couplings;
use crate::material::add_volumetric;
use crate::parallel;
use crate::tensor::{SymTensor, dot, minus};
use crate::thermal::ThermalStrain;
use crate::topology::CoupledPoints;
use crate::topology::UnbrokenBonds;

/// Volumetric stiffnesses of the patches of a body: the cells of one material around a point.
#[derive(Debug, Clone)]
pub struct VolumetricTerms<const D: usize> {
    cells: VolumetricCells<D>,
    /// Bonds along the edges of each cell.
    bonds_of_cells: Incidence,
    /// Cells with an edge along each bond.
    cells_of_bonds: Incidence,
    /// Cell of each corner.
    cell_of_corner: Vec<u32>,
    /// Corners of cells at each point, by their indices in the arrays over corners.
    corners_at_points: Incidence,
    /// Patch of each corner.
    patch_of_corner: Vec<u32>,
    patches: Vec<Patch>,
    /// Cells of each patch.
    cells_of_patches: Incidence,
    /// First patch of each point, and the number of patches, shape (n_points + 1).
    first_patches: Vec<u32>,
    /// Modulus kappa of each material, shape (n_materials), Pa.
    moduli: Vec<f64>,
    /// Points that bonds, crack faces, elements or patches couple with each point, ascending.
    coupled_points: CoupledPoints,
    /// Number of cells without stiffness because the bonds along their edges do not connect their corners.
    pub unconnected: usize,
}

/// The cells of one material around a point.
#[derive(Debug, Clone, Copy)]
struct Patch {
    /// kappa, Pa.
    modulus: f64,
    /// Volume of all of its cells at the point, m^3.
    whole_volume: f64,
}

/// A patch of cells with its whole stiffness, for bounds of its energy.
#[derive(Debug, Clone, PartialEq)]
pub struct CellPatch {
    /// kappa w, J: twice the energy of a uniform dilatation of 1.
    pub rigidity: f64,
    /// Corners of its cells: the point and a row g, J^(1/2)/m, one component for each axis, the others zero. Twice the energy of any motion u in
    /// the patch, with all cells or with some, is at most the sum of (g . u)^2 over the corners.
    pub corners: Vec<(u32, [f64; 3])>,
}

impl CellPatch {
    /// Points of the cells, ascending.
    pub fn points(&self) -> Vec<u32> {
        let mut points: Vec<u32> = self.corners.iter().map(|it| it.0).collect();
        points.sort_unstable();
        points.dedup();
        points
    }
}

/// Dilatation of a patch.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct PatchDilatation {
    /// Volume w of the living cells at the point, m^3.
    pub(crate) volume: f64,
    /// Mean dilatation theta less the thermal dilatation; 0 without a living cell.
    pub(crate) dilatation: f64,
}

/// Row of a dilatation: the entries of some points, ascending, 1/m.
pub(super) type Row<const D: usize> = Vec<(u32, [f64; D])>;

/// Stress kappa theta of the cells around a point, the same in all directions.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct VolumetricStress {
    /// Stress times the volume of the living cells at the point, J.
    pub(crate) stress_volume: f64,
    /// Volume of the living cells at the point, m^3.
    volume: f64,
    /// Volume of all of its cells, m^3.
    whole_volume: f64,
}

impl VolumetricStress {
    /// Mean stress of the living cells, Pa; none without a living cell.
    pub(crate) fn mean_over_living(&self) -> Option<f64> {
        (self.volume > 0.0).then(|| self.stress_volume / self.volume)
    }

    /// Mean stress over all cells, dead or living, Pa; none without a cell.
    pub(crate) fn mean_over_all(&self) -> Option<f64> {
        (self.whole_volume > 0.0).then(|| self.stress_volume / self.whole_volume)
    }
}

impl<const D: usize> VolumetricTerms<D> {
    /// Terms of cells with the moduli kappa of their materials (n_materials), Pa; `None` if no cell has a modulus. `is_cut` returns whether a
    /// pre-crack cuts an edge without a bond; other edges without a bond, longer than a horizon, count as whole. `coupled` contains the points that
    /// bonds, crack faces and elements couple.
    pub fn new(
        cells: &VolumetricCells<D>,
        bonds: &BondSet<D>,
        moduli: &[f64],
        is_cut: impl Fn([u32; 2]) -> bool,
        coupled: &CoupledPoints,
    ) -> Option<Self> {
        let bond_along = |edge: &[u32; 2]| bonds.ends.binary_search(edge).ok();
        let resists = |cell: usize| moduli[cells.materials[cell] as usize] > 0.0;
        let is_whole = |cell: usize| {
            let mut edges = cells.edges(cell).iter();
            edges.all(|edge| bond_along(edge).is_some() || !is_cut(*edge))
        };
        let is_connected = |cell: usize| {
            let edges = cells.edges(cell).iter();
            let bonded: Vec<_> = edges.filter(|it| bond_along(it).is_some()).collect();
            connects(&bonded, &cells.corners[cells.places(cell)])
        };
        let numbers = (0..cells.len()).filter(|&cell| resists(cell) && is_whole(cell));
        let unconnected = numbers.filter(|&cell| !is_connected(cell)).count();
        let living = |cell: usize| resists(cell) && is_whole(cell) && is_connected(cell);
        let cells = cells.retained(living);
        (!cells.is_empty()).then(|| {
            let n_points = bonds.incidence.n_points();
            Self::from_intact_cells(cells, bonds, moduli, n_points, coupled, unconnected)
        })
    }

    fn from_intact_cells(
        cells: VolumetricCells<D>,
        bonds: &BondSet<D>,
        moduli: &[f64],
        n_points: usize,
        coupled: &CoupledPoints,
        unconnected: usize,
    ) -> Self {
        let numbers = 0..cells.len() as u32;
        let along_edges = numbers.clone().flat_map(|cell| {
            let edges = cells.edges(cell as usize).iter();
            let bonds = edges.filter_map(|edge| bonds.ends.binary_search(edge).ok());
            bonds.map(move |bond| (cell, bond as u32))
        });
        let reversed = along_edges.clone().map(|(cell, bond)| (bond, cell));
        let bonds_of_cells = Incidence::from_pairs(along_edges, cells.len());
        let cells_of_bonds = Incidence::from_pairs(reversed, bonds.len());
        let cell_of_corner: Vec<u32> = numbers
            .flat_map(|cell| cells.places(cell as usize).map(move |_| cell))
            .collect();
        let places = (0..)
            .zip(&cells.corners)
            .map(|(place, &point)| (point, place));
        let mut terms = Self {
            corners_at_points: Incidence::from_pairs(places, n_points),
            bonds_of_cells,
            cells_of_bonds,
            cell_of_corner,
            patch_of_corner: vec![0; cells.corners.len()],
            patches: Vec::new(),
            cells_of_patches: Incidence::from_pairs(std::iter::empty(), 0),
            first_patches: vec![0],
            cells,
            moduli: moduli.to_vec(),
            coupled_points: coupled.clone(),
            unconnected,
        };
        terms.find_patches(n_points);
        terms.coupled_points = union_of_couplings([coupled, &terms.neighbours(n_points)], n_points);
        terms
    }

    /// Sets the patches of each point, one for each material.
    fn find_patches(&mut self, n_points: usize) {
        let cells = &self.cells;
        let cell = |place: u32| self.cell_of_corner[place as usize] as usize;
        let material = |place: u32| cells.materials[cell(place)];
        for point in 0..n_points as u32 {
            let mut corners = self.corners_at_points.at(point).to_vec();
            corners.sort_by_key(|&place| material(place));
            for of_material in corners.chunk_by(|one, other| material(*one) == material(*other)) {
                let share = |&place: &u32| {
                    let cell = cell(place);
                    cells.volumes[cell] / cells.places(cell).len() as f64
                };
                for &place in of_material {
                    self.patch_of_corner[place as usize] = self.patches.len() as u32;
                }
                self.patches.push(Patch {
                    modulus: self.moduli[material(of_material[0]) as usize],
                    whole_volume: of_material.iter().map(share).sum(),
                });
            }
            self.first_patches.push(self.patches.len() as u32);
        }
        let patches = self.patch_of_corner.iter().copied();
        let of_corners = patches.zip(self.cell_of_corner.iter().copied());
        self.cells_of_patches = Incidence::from_pairs(of_corners, self.patches.len());
    }

    /// Points that the patches couple with each point, ascending.
    fn neighbours(&self, n_points: usize) -> CoupledPoints {
        let of_point = |point: u32| {
            let mut others: Vec<u32> = (self.patches_of_cells_at(point).into_iter())
                .flat_map(|patch| self.cells_of_patches.at(patch))
                .flat_map(|&cell| &self.cells.corners[self.cells.places(cell as usize)])
                .copied()
                .filter(|&other| other != point)
                .collect();
            others.sort_unstable();
            others.dedup();
            others
        };
        let lists = parallel::values(n_points, Vec::new(), |point| of_point(point as u32));
        let pairs = (0..).zip(&lists).flat_map(|(point, others)| {
            let others = others.iter();
            others.map(move |&other| (point, other))
        });
        CoupledPoints::from_lists(&Incidence::from_pairs(pairs, n_points).into())
    }

    /// The terms of a part of a body, between the points of the whole body: `points` has their numbers, ascending. `coupled` has the
    /// points that bonds and elements couple in the whole body.
    pub(crate) fn in_whole_body(
        self,
        points: &[u32],
        bonds: &BondSet<D>,
        coupled: &CoupledPoints,
    ) -> Self {
        let n_points = bonds.incidence.n_points();
        let cells = self.cells.renumbered(points);
        Self::from_intact_cells(
            cells,
            bonds,
            &self.moduli,
            n_points,
            coupled,
            self.unconnected,
        )
    }

    /// Adds the forces of the cells in uniform strains, and their moduli to the stiffnesses of the materials.
    pub fn add_to(&self, forces: &mut CellForces<D>) {
        for (stiffness, modulus) in forces.stiffness.iter_mut().zip(&self.moduli) {
            add_volumetric::<D>(stiffness, *modulus);
        }
        for cell in 0..self.cells.len() {
            let modulus = self.moduli[self.cells.materials[cell] as usize];
            let traces = uniform_strains::<D>().map(|it| it.trace());
            let stresses: Vec<SymTensor<D>> = traces
                .map(|trace| SymTensor::isotropic(modulus * trace))
                .collect();
            for place in self.cells.places(cell) {
                let gradient = self.cells.gradients[place];
                forces.add(self.cells.corners[place], &stresses, gradient);
            }
        }
    }

    /// Points that bonds, crack faces, elements or patches couple with each point, ascending.
    pub(crate) fn coupled_points(&self) -> &CoupledPoints {
        &self.coupled_points
    }

    /// Modulus kappa of each material, shape (n_materials), Pa.
    pub fn moduli(&self) -> &[f64] {
        &self.moduli
    }

    /// Number of cells with a stiffness at the start.
    pub fn n_cells(&self) -> usize {
        self.cells.len()
    }

    /// Patches at a point.
    fn patches_at(&self, point: u32) -> std::ops::Range<u32> {
        let point = point as usize;
        self.first_patches[point]..self.first_patches[point + 1]
    }

    /// Patches that contain a cell at a point, ascending.
    fn patches_of_cells_at(&self, point: u32) -> Vec<u32> {
        let corners = self.corners_at_points.at(point).iter();
        let cells = corners.map(|&place| self.cell_of_corner[place as usize] as usize);
        let patches = cells.flat_map(|cell| &self.patch_of_corner[self.cells.places(cell)]);
        let mut patches: Vec<u32> = patches.copied().collect();
        patches.sort_unstable();
        patches.dedup();
        patches
    }

    /// Patches that change when the shares of some cells do, ascending.
    pub(super) fn patches_of(&self, cells: &[u32]) -> Vec<u32> {
        let patches = cells.iter().flat_map(|&cell| {
            let places = self.cells.places(cell as usize);
            self.patch_of_corner[places].iter().copied()
        });
        let mut patches: Vec<u32> = patches.collect();
        patches.sort_unstable();
        patches.dedup();
        patches
    }

    /// Cells with an edge along some bonds, ascending.
    pub(super) fn cells_along(&self, bonds: impl Iterator<Item = u32>) -> Vec<u32> {
        let cells = bonds.flat_map(|bond| self.cells_of_bonds.at(bond).iter().copied());
        let mut cells: Vec<u32> = cells.collect();
        cells.sort_unstable();
        cells.dedup();
        cells
    }

    /// Remaining share f of the stiffness of a cell.
    pub(super) fn share(&self, bonds: UnbrokenBonds<'_>, cell: u32) -> f64 {
        let along_edges = self.bonds_of_cells.at(cell).iter();
        along_edges.fold(1.0, |share, &bond| {
            let bond = bond as usize;
            let left = match bonds.intact[bond] {
                true => bonds.remaining.get(bond).map_or(1.0, |it| it.axial),
                false => 0.0,
            };
            left.min(share)
        })
    }

    /// Change of the volume of a cell for motions with a given number of components per point, m^3. A translation makes none.
    fn volume_change(&self, cell: u32, motions: &[f64], n_components: usize) -> f64 {
        let places = self.cells.places(cell as usize);
        let moved = |place: usize| -> [f64; D] {
            let first = n_components * self.cells.corners[place] as usize;
            std::array::from_fn(|axis| motions[first + axis])
        };
        let first = moved(places.start);
        let corners = places.skip(1);
        let changes =
            corners.map(|place| dot(self.cells.gradients[place], minus(moved(place), first)));
        changes.sum()
    }

    /// Change of the volume of a cell by temperature, m^3: the mean over its corners.
    fn thermal_change(&self, cell: u32, expansion: ThermalStrain<'_>) -> f64 {
        if expansion.is_none() {
            return 0.0;
        }
        let places = self.cells.places(cell as usize);
        let share = self.cells.volumes[cell as usize] / places.len() as f64;
        let corners = &self.cells.corners[places];
        let of_corner = |&corner: &u32| {
            let strain = expansion.of_point(corner as usize);
            (0..D).map(|axis| strain.at(axis, axis)).sum::<f64>()
        };
        share * corners.iter().map(of_corner).sum::<f64>()
    }

    /// Change of the volume of a cell less its thermal change, m^3, for motions with a given number of components per point.
    fn change(
        &self,
        cell: u32,
        (motions, n_components): (&[f64], usize),
        expansion: ThermalStrain<'_>,
    ) -> f64 {
        self.volume_change(cell, motions, n_components) - self.thermal_change(cell, expansion)
    }

    /// Change of the volume of each cell, living or not, less its thermal change, shape (n_cells), m^3, for motions with a given number of components
    /// per point.
    pub(crate) fn volume_changes(
        &self,
        motions: (&[f64], usize),
        expansion: ThermalStrain<'_>,
    ) -> Vec<f64> {
        self.of_cells(|cell| self.change(cell, motions, expansion))
    }

    /// Change of the volume of each cell by temperature, shape (n_cells), m^3.
    pub(crate) fn thermal_changes(&self, expansion: ThermalStrain<'_>) -> Vec<f64> {
        self.of_cells(|cell| self.thermal_change(cell, expansion))
    }

    /// Remaining share of the stiffness of each cell, shape (n_cells).
    pub(crate) fn shares(&self, bonds: UnbrokenBonds<'_>) -> Vec<f64> {
        self.of_cells(|cell| self.share(bonds, cell))
    }

    fn of_cells(&self, value: impl Fn(u32) -> f64 + Sync) -> Vec<f64> {
        parallel::values(self.cells.len(), 0.0, |cell| value(cell as u32))
    }

    /// Dilatation of a patch from the shares of cells and the changes of their volumes.
    fn dilatation(
        &self,
        patch: u32,
        share: impl Fn(u32) -> f64,
        change: impl Fn(u32) -> f64,
    ) -> PatchDilatation {
        let (mut volume, mut changed) = (0.0, 0.0);
        for &cell in self.cells_of_patches.at(patch) {
            let number = cell as usize;
            let share = share(cell) / self.cells.places(number).len() as f64;
            volume += share * self.cells.volumes[number];
            if share > 0.0 {
                changed += share * change(cell);
            }
        }
        PatchDilatation {
            volume,
            dilatation: if volume > 0.0 { changed / volume } else { 0.0 },
        }
    }

    /// Dilatations of all patches from the shares and the volume changes of the cells (n_cells).
    pub(crate) fn dilatations(&self, shares: &[f64], changes: &[f64]) -> Vec<PatchDilatation> {
        parallel::values(self.patches.len(), PatchDilatation::default(), |patch| {
            let value = |values: &[f64], cell: u32| values[cell as usize];
            self.dilatation(
                patch as u32,
                |cell| value(shares, cell),
                |cell| value(changes, cell),
            )
        })
    }

    /// Work of the dilatations of all patches on others, sum kappa w theta theta', J.
    pub(crate) fn work(&self, one: &[PatchDilatation], other: &[PatchDilatation]) -> f64 {
        let patches = self.patches.iter().zip(one.iter().zip(other));
        let of_patch = |(patch, (one, other)): (&Patch, (&PatchDilatation, &PatchDilatation))| {
            patch.modulus * one.volume * one.dilatation * other.dilatation
        };
        patches.map(of_patch).sum()
    }

    /// Sum kappa theta over the corners of each cell times its share over their number, Pa, shape (n_cells).
    pub(crate) fn pressures(&self, shares: &[f64], dilatations: &[PatchDilatation]) -> Vec<f64> {
        self.of_cells(|cell| {
            let number = cell as usize;
            let patches = &self.patch_of_corner[self.cells.places(number)];
            let pressure = |&patch: &u32| {
                let patch = patch as usize;
                self.patches[patch].modulus * dilatations[patch].dilatation
            };
            let sum: f64 = patches.iter().map(pressure).sum();
            shares[number] / patches.len() as f64 * sum
        })
    }

    /// Force on each point, N, by the pressures of the cells (n_cells).
    #[inline]
    pub(crate) fn forces(&self, n_points: usize, pressures: &[f64]) -> Vec<[f64; D]> {
        parallel::values(n_points, [0.0; D], |point| {
            let mut force = [0.0; D];
            for &place in self.corners_at_points.at(point as u32) {
                let place = place as usize;
                let pressure = pressures[self.cell_of_corner[place] as usize];
                (0..D).for_each(|axis| force[axis] += pressure * self.cells.gradients[place][axis]);
            }
            force
        })
    }

    /// Energy of the patches of a point, J, from the volume changes of the cells (n_cells).
    pub(crate) fn energy_at(&self, bonds: UnbrokenBonds<'_>, changes: &[f64], point: u32) -> f64 {
        let energies = self.patches_at(point).map(|patch| {
            let change = |cell: u32| changes[cell as usize];
            let found = self.dilatation(patch, |cell| self.share(bonds, cell), change);
            let modulus = self.patches[patch as usize].modulus;
            0.5 * modulus * found.volume * found.dilatation * found.dilatation
        });
        energies.sum()
    }

    /// Volumetric stress of a point; `of_patch` gives the dilatation of a patch.
    fn stress(&self, point: u32, of_patch: impl Fn(u32) -> PatchDilatation) -> VolumetricStress {
        let mut sum = VolumetricStress::default();
        for number in self.patches_at(point) {
            let (patch, found) = (&self.patches[number as usize], of_patch(number));
            sum.stress_volume += patch.modulus * found.volume * found.dilatation;
            sum.volume += found.volume;
            sum.whole_volume += patch.whole_volume;
        }
        sum
    }

    /// Volumetric stress of a point from the volume changes of the cells (n_cells, m^3).
    pub(crate) fn stress_from_changes(
        &self,
        bonds: UnbrokenBonds<'_>,
        changes: &[f64],
        point: u32,
    ) -> VolumetricStress {
        let share = |cell: u32| self.share(bonds, cell);
        let change = |cell: u32| changes[cell as usize];
        self.stress(point, |patch| self.dilatation(patch, share, change))
    }

    /// Volumetric stress of a point for motions with a given number of components per point.
    pub(crate) fn stress_in_motions(
        &self,
        bonds: UnbrokenBonds<'_>,
        motions: (&[f64], usize),
        expansion: ThermalStrain<'_>,
        point: u32,
    ) -> VolumetricStress {
        let share = |cell: u32| self.share(bonds, cell);
        let change = |cell: u32| self.change(cell, motions, expansion);
        self.stress(point, |patch| self.dilatation(patch, share, change))
    }

    /// Volumetric stress of each point for motions with a given number of components per point, shape (n_points).
    pub(crate) fn stresses(
        &self,
        bonds: UnbrokenBonds<'_>,
        motions: (&[f64], usize),
        expansion: ThermalStrain<'_>,
    ) -> Vec<VolumetricStress> {
        let changes = self.volume_changes(motions, expansion);
        let found = self.dilatations(&self.shares(bonds), &changes);
        let n_points = self.first_patches.len() - 1;
        parallel::values(n_points, VolumetricStress::default(), |point| {
            self.stress(point as u32, |patch| found[patch as usize])
        })
    }

    /// Row t of the dilatation theta_P = t . u of a patch, by point ascending, with the volume w of its living cells; none without one.
    pub(super) fn row(&self, patch: u32, share: impl Fn(u32) -> f64) -> Option<(f64, Row<D>)> {
        let volume = self.dilatation(patch, &share, |_| 0.0).volume;
        if volume <= 0.0 {
            return None;
        }
        let mut entries = Vec::new();
        for &cell in self.cells_of_patches.at(patch) {
            let places = self.cells.places(cell as usize);
            let weight = share(cell) / (places.len() as f64 * volume);
            if weight > 0.0 {
                let corners = self.cells.corners[places.clone()].iter().copied();
                let gradients = self.cells.gradients[places].iter();
                entries.extend(corners.zip(gradients.map(|it| it.map(|value| weight * value))));
            }
        }
        entries.sort_by_key(|(point, _)| *point);
        let mut row: Row<D> = Vec::new();
        for (point, gradient) in entries {
            match row.last_mut() {
                Some((last, sum)) if *last == point => {
                    (0..D).for_each(|axis| sum[axis] += gradient[axis]);
                }
                _ => row.push((point, gradient)),
            }
        }
        Some((volume, row))
    }

    /// All patches with their whole stiffness.
    ///
    /// By Jensen's inequality w theta^2 is at most the sum of (V_c/m_c) theta_c^2 over the cells, living or not, and theta_c^2 at most m_c times
    /// the sum of (G_ca . u_a)^2/V_c^2 over the corners: g = sqrt(kappa/V_c) G_ca.
    pub(crate) fn whole_patches(&self) -> Vec<CellPatch> {
        let of_patch = |(number, patch): (u32, &Patch)| {
            let cells = self.cells_of_patches.at(number).iter();
            let corners = cells.flat_map(|&cell| {
                let size = (patch.modulus / self.cells.volumes[cell as usize]).sqrt();
                let places = self.cells.places(cell as usize);
                places.map(move |place| {
                    let gradient = self.cells.gradients[place];
                    let axis = |axis: usize| gradient.get(axis).map_or(0.0, |it| size * it);
                    (self.cells.corners[place], std::array::from_fn(axis))
                })
            });
            CellPatch {
                rigidity: patch.modulus * patch.whole_volume,
                corners: corners.collect(),
            }
        };
        (0..).zip(&self.patches).map(of_patch).collect()
    }

    /// Points of the patches with a cell along some bonds.
    pub(crate) fn points_of_patches(&self, bonds: &[u32]) -> Vec<u32> {
        let cells = self.cells_along(bonds.iter().copied());
        let patches = self.patches_of(&cells).into_iter();
        let cells = patches.flat_map(|patch| self.cells_of_patches.at(patch));
        let points = cells.flat_map(|&cell| &self.cells.corners[self.cells.places(cell as usize)]);
        points.copied().collect()
    }

    /// Force of the cells on a point, N, in motions with a number of components a point.
    pub(crate) fn force_in_motions(
        &self,
        bonds: UnbrokenBonds<'_>,
        motions: (&[f64], usize),
        point: u32,
    ) -> [f64; D] {
        let share = |cell: u32| self.share(bonds, cell);
        let change = |cell: u32| self.change(cell, motions, ThermalStrain::NONE);
        let mut force = [0.0; D];
        for &place in self.corners_at_points.at(point) {
            let place = place as usize;
            let cell = self.cell_of_corner[place];
            let patches = &self.patch_of_corner[self.cells.places(cell as usize)];
            let pressure = |&patch: &u32| {
                let found = self.dilatation(patch, share, change);
                self.patches[patch as usize].modulus * found.dilatation
            };
            let sum: f64 = patches.iter().map(pressure).sum();
            let pressure = share(cell) / patches.len() as f64 * sum;
            (0..D).for_each(|axis| force[axis] += pressure * self.cells.gradients[place][axis]);
        }
        force
    }

    /// kappa of a patch, Pa.
    pub(super) fn modulus(&self, patch: u32) -> f64 {
        self.patches[patch as usize].modulus
    }

    /// Weights of the thermal dilatations of the points in the dilatation of a patch.
    pub(super) fn thermal_weights(
        &self,
        patch: u32,
        share: impl Fn(u32) -> f64,
    ) -> Vec<(u32, f64)> {
        let volume = self.dilatation(patch, &share, |_| 0.0).volume;
        let mut weights = Vec::new();
        for &cell in self.cells_of_patches.at(patch) {
            let places = self.cells.places(cell as usize);
            let n_corners = places.len() as f64;
            let weight = share(cell) * self.cells.volumes[cell as usize] / (n_corners * volume);
            if weight > 0.0 {
                let corners = self.cells.corners[places].iter();
                weights.extend(corners.map(|corner| (*corner, weight / n_corners)));
            }
        }
        weights
    }

    /// Adds the blocks in the columns of a point, in the rows of its `lower` points (ascending) and of itself, shape (n_lower + 1,
    /// n_components, n_components).
    pub(crate) fn add_blocks<const M: usize>(
        &self,
        bonds: UnbrokenBonds<'_>,
        point: u32,
        lower: &[u32],
        blocks: &mut [f64],
    ) {
        for patch in self.patches_of_cells_at(point) {
            let Some((volume, row)) = self.row(patch, |cell| self.share(bonds, cell)) else {
                continue;
            };
            let Ok(own) = row.binary_search_by_key(&point, |it| it.0) else {
                continue;
            };
            let factor = self.patches[patch as usize].modulus * volume;
            let column = row[own].1.map(|it| factor * it);
            for (other, gradient) in &row[..=own] {
                let place = match *other == point {
                    true => Ok(lower.len()),
                    false => lower.binary_search(other),
                };
                let Ok(place) = place else { continue };
                for (axis, along) in gradient.iter().enumerate() {
                    let first = (place * M + axis) * M;
                    let sums = blocks[first..first + D].iter_mut();
                    sums.zip(column)
                        .for_each(|(sum, value)| *sum += along * value);
                }
            }
        }
    }

    /// Sum over the patches of a point of the size of its diagonal block, N/m.
    pub(crate) fn stiffness_at(&self, point: u32) -> f64 {
        let of_patch = |patch: u32| {
            let (volume, row) = self.row(patch, |_| 1.0)?;
            let own = row.binary_search_by_key(&point, |it| it.0).ok()?;
            let gradient = row[own].1;
            Some(self.patches[patch as usize].modulus * volume * dot(gradient, gradient))
        };
        let patches = self.patches_of_cells_at(point).into_iter();
        patches.filter_map(of_patch).sum()
    }
}

/// Whether edges connect all of some points.
fn connects(edges: &[&[u32; 2]], points: &[u32]) -> bool {
    let mut reached = vec![points[0]];
    let mut next = 0;
    while let Some(&from) = reached.get(next) {
        for [a, b] in edges.iter().copied().filter(|it| it.contains(&from)) {
            let other = if *a == from { *b } else { *a };
            if !reached.contains(&other) {
                reached.push(other);
            }
        }
        next += 1;
    }
    points.iter().all(|it| reached.contains(it))
}
