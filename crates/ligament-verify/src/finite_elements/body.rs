//! A body of finite elements: its equilibrium and its natural modes.

use std::array::from_fn;
use std::f64::consts::TAU;
use std::sync::Arc;

use anyhow::ensure;
use ligament_linalg::{
    Elimination, FactorKind, Factorisation, Pattern, Search, Symbolic, SymmetricMatrix,
    largest_eigenpairs,
};
use ligament_model::material::{Elasticity, Plane};

use super::element::{self, PlaneStiffness, Shapes, dot};
use super::mesh::Mesh;

/// Residual over eigenvalue below which a mode has converged.
const TOLERANCE: f64 = 1e-9;

/// Largest number of solutions in the search for modes; some tens are usual.
const SOLUTIONS: usize = 2000;

/// A body in plane stress.
#[derive(Debug, Clone)]
pub struct Body {
    /// Nodes and elements.
    pub mesh: Mesh,
    thickness: f64,
    elasticity: PlaneStiffness,
    /// Volume of each node, shape (n_nodes), m^3.
    volumes: Vec<f64>,
}

/// A natural mode of a body.
#[derive(Debug, Clone, PartialEq)]
pub struct Mode {
    /// Frequency, Hz.
    pub frequency: f64,
    /// Displacements of the nodes, with a kinetic energy of omega^2/2, shape (n_nodes, 2).
    pub shape: Vec<[f64; 2]>,
    /// Participation in rigid translations along x and y: the sum of mass times shape.
    pub participation: [f64; 2],
}

/// The equations of the free unknowns.
struct Equations {
    /// Unknown of each free component (2 node + axis), shape (2 n_nodes).
    unknown: Vec<Option<usize>>,
    factor: Box<dyn Factorisation>,
    /// Forces of the prescribed displacements on the free components, shape (n_unknowns), N.
    reactions: Vec<f64>,
}

impl Body {
    /// A body of one material and thickness (m).
    pub fn new(mesh: Mesh, elasticity: &Elasticity, thickness: f64) -> Self {
        let c = elasticity.plane_stiffness(Plane::Stress);
        let mut volumes = vec![0.0; mesh.nodes.len()];
        for cell in &mesh.cells {
            let areas = element::nodal_areas(mesh.degree, &mesh.places(cell));
            for (&node, area) in cell.iter().zip(areas) {
                volumes[node] += thickness * area;
            }
        }
        Self {
            mesh,
            thickness,
            elasticity: from_fn(|i| from_fn(|j| c[(i, j)])),
            volumes,
        }
    }

    /// Nodal forces of a force per volume (N/m^3), evaluated at the middle of each element, shape (n_nodes, 2), N.
    pub fn volume_forces(&self, density: impl Fn([f64; 2]) -> [f64; 2]) -> Vec<[f64; 2]> {
        let mut forces = vec![[0.0; 2]; self.mesh.nodes.len()];
        for (cell, centre) in self.mesh.cells.iter().zip(self.mesh.centres()) {
            let density = density(centre);
            let areas = element::nodal_areas(self.mesh.degree, &self.mesh.places(cell));
            for (&node, area) in cell.iter().zip(areas) {
                for axis in 0..2 {
                    forces[node][axis] += density[axis] * self.thickness * area;
                }
            }
        }
        forces
    }

    /// The displacements under nodal forces (N) and prescribed displacements (m), each of shape (n_nodes, 2).
    ///
    /// # Errors
    ///
    /// If the prescribed displacements leave rigid motions free.
    pub fn displacements(
        &self,
        prescribed: &[[Option<f64>; 2]],
        forces: &[[f64; 2]],
    ) -> anyhow::Result<Vec<[f64; 2]>> {
        let mut equations = self.equations(prescribed)?;
        let mut solution = equations.reactions.clone();
        for (force, unknown) in forces.as_flattened().iter().zip(&equations.unknown) {
            if let Some(unknown) = *unknown {
                solution[unknown] += force;
            }
        }
        equations.factor.solve_in_place(&mut solution);
        Ok(equations.spread(&solution, prescribed))
    }

    /// The lowest modes of a body with a density (kg/m^3) and fixed components of its nodes, shape (n_nodes, 2).
    ///
    /// The values 1/omega^2 are the eigenvalues of M^(1/2) K^-1 M^(1/2), with the diagonal mass matrix of the nodes' volumes.
    ///
    /// # Errors
    ///
    /// If the fixed components leave rigid motions free, or the modes are not found.
    pub fn modes(
        &self,
        held: &[[bool; 2]],
        density: f64,
        count: usize,
    ) -> anyhow::Result<Vec<Mode>> {
        let prescribed: Vec<_> = (held.iter())
            .map(|held| held.map(|held| held.then_some(0.0)))
            .collect();
        let mut equations = self.equations(&prescribed)?;
        let mass = |component: usize| density * self.volumes[component / 2];
        let roots: Vec<f64> = (equations.unknown.iter().enumerate())
            .filter(|(_, unknown)| unknown.is_some())
            .map(|(component, _)| mass(component).sqrt())
            .collect();
        let search = Search {
            count,
            tolerance: TOLERANCE,
            limit: SOLUTIONS,
            seed: 1,
        };
        let weigh = |values: &mut [f64]| {
            values
                .iter_mut()
                .zip(&roots)
                .for_each(|(value, root)| *value *= root);
        };
        let found = largest_eigenpairs(roots.len(), search, |from, to| {
            to.copy_from_slice(from);
            weigh(to);
            equations.factor.solve_in_place(to);
            weigh(to);
        });
        ensure!(found.converged, "the modes of the elements were not found");
        let mode = |(value, vector): (&f64, &Vec<f64>)| {
            let shape: Vec<f64> = vector
                .iter()
                .zip(&roots)
                .map(|(v, root)| v / root)
                .collect();
            let shape = equations.spread(&shape, &prescribed);
            let participation = from_fn(|axis| {
                let terms = shape.iter().zip(&self.volumes);
                terms
                    .map(|(shape, volume)| density * volume * shape[axis])
                    .sum()
            });
            Mode {
                frequency: 1.0 / (TAU * value.sqrt()),
                shape,
                participation,
            }
        };
        Ok(found.values.iter().zip(&found.vectors).map(mode).collect())
    }

    /// (sigma_xx, sigma_yy, sigma_xy) in the middle of each element, shape (n_cells, 3), Pa, from the displacements of the
    /// nodes (m).
    pub fn stresses(&self, displacements: &[[f64; 2]]) -> Vec<[f64; 3]> {
        let stress = |cell: &Vec<usize>| {
            let shapes = Shapes::at(self.mesh.degree, &self.mesh.places(cell), [0.0, 0.0]);
            let strain = shapes.strain(cell.iter().map(|&node| displacements[node]));
            from_fn(|i| dot(&self.elasticity[i], &strain))
        };
        self.mesh.cells.iter().map(stress).collect()
    }

    /// The factorised equations, and the forces of the prescribed displacements.
    fn equations(&self, prescribed: &[[Option<f64>; 2]]) -> anyhow::Result<Equations> {
        let prescribed = prescribed.as_flattened();
        let mut count = 0;
        let unknown: Vec<Option<usize>> = (prescribed.iter())
            .map(|prescribed| {
                let number = prescribed.is_none().then_some(count);
                count += usize::from(prescribed.is_none());
                number
            })
            .collect();
        let mut reactions = vec![0.0; count];
        let mut entries = Vec::new();
        for cell in &self.mesh.cells {
            let places = self.mesh.places(cell);
            let stiffness = element::stiffness(self.mesh.degree, &places, &self.elasticity);
            let components: Vec<usize> = (cell.iter())
                .flat_map(|node| [2 * node, 2 * node + 1])
                .collect();
            let pairs = components
                .iter()
                .flat_map(|&row| components.iter().map(move |&column| (row, column)));
            for ((row, column), value) in pairs.zip(stiffness) {
                let value = self.thickness * value;
                match (unknown[row], unknown[column], prescribed[column]) {
                    (Some(row), Some(column), _) if row <= column => {
                        entries.push((column, row, value))
                    }
                    (Some(row), None, Some(displacement)) => reactions[row] -= value * displacement,
                    _ => {}
                }
            }
        }
        let matrix = sum(count, entries)?;
        let symbolic = Symbolic::analyse(matrix.pattern().clone(), Elimination::MinimumDegree)?;
        Ok(Equations {
            unknown,
            factor: FactorKind::Llt.factorise(&Arc::new(symbolic), &matrix)?,
            reactions,
        })
    }
}

impl Equations {
    /// The solution at the nodes, including prescribed displacements, shape (n_nodes, 2).
    fn spread(&self, solution: &[f64], prescribed: &[[Option<f64>; 2]]) -> Vec<[f64; 2]> {
        let value = |node: usize, axis: usize| match self.unknown[2 * node + axis] {
            Some(unknown) => solution[unknown],
            None => prescribed[node][axis].unwrap_or_default(),
        };
        (0..prescribed.len())
            .map(|node| from_fn(|axis| value(node, axis)))
            .collect()
    }
}

/// The matrix of entries (column, row, value) of the upper triangle; entries with equal indices are summed in their order.
fn sum(dimension: usize, mut entries: Vec<(usize, usize, f64)>) -> anyhow::Result<SymmetricMatrix> {
    entries.sort_by_key(|&(column, row, _)| (column, row));
    let (mut starts, mut rows, mut values) = (vec![0; dimension + 1], Vec::new(), Vec::new());
    for same in entries.chunk_by(|one, other| (one.0, one.1) == (other.0, other.1)) {
        rows.push(same[0].1);
        values.push(same.iter().map(|entry| entry.2).sum());
        starts[same[0].0 + 1] = rows.len();
    }
    let mut matrix = SymmetricMatrix::zero(Arc::new(Pattern::new(starts, rows)?));
    matrix.values = values;
    Ok(matrix)
}

#[cfg(test)]
mod tests {
    use super::super::mesh::Degree;
    use super::*;
    use crate::lamina_elements::lamina;
    use ligament_model::material::Isotropic;

    /// Independent calculations with biquadratic elements.
    const HOLE: &str = include_str!("../../../../tests/reference/fem-hole-frequencies.csv");
    const SQUARE: &str = include_str!("../../../../tests/reference/fem-square-frequencies.csv");

    const THICKNESS: f64 = 1e-3;

    fn isotropic(poisson: f64) -> Elasticity {
        Elasticity::Isotropic(Isotropic {
            young: 70e9,
            poisson,
        })
    }

    fn rows(text: &str) -> impl Iterator<Item = Vec<f64>> {
        let number = |cell: &str| match cell {
            "1/3" => 1.0 / 3.0,
            cell => cell.parse().unwrap(),
        };
        text.lines()
            .skip(1)
            .map(move |line| line.split(',').map(number).collect())
    }

    fn assert_near(computed: f64, expected: f64, tolerance: f64) {
        let off = (computed - expected).abs();
        assert!(off <= tolerance, "{computed} is off {expected} by {off:e}");
    }

    /// Distorted elements of both degrees represent a linear displacement and its stress exactly (patch test).
    #[test]
    fn a_linear_displacement_on_the_outline_goes_on_inside() {
        for degree in [Degree::Linear, Degree::Quadratic] {
            let elasticity = isotropic(0.2);
            let mesh = Mesh::lamina_with_hole(degree, 0.2, 0.04, 0.01, 3);
            let body = Body::new(mesh, &elasticity, THICKNESS);
            let linear = |[x, y]: [f64; 2]| [1e-3 * x - 2e-3 * y, 3e-4 * x + 5e-4 * y];
            let is_outline =
                |[x, y]: [f64; 2]| x.abs() > 0.1999 || y.abs() > 0.0999 || x.hypot(y) < 0.0401;
            let prescribed: Vec<_> = (body.mesh.nodes.iter())
                .map(|&node| linear(node).map(|u| is_outline(node).then_some(u)))
                .collect();
            let forces = vec![[0.0; 2]; prescribed.len()];
            let found = body.displacements(&prescribed, &forces).unwrap();
            for (found, &node) in found.iter().zip(&body.mesh.nodes) {
                for (found, expected) in found.iter().zip(linear(node)) {
                    assert_near(*found, expected, 1e-16);
                }
            }
            let strain = [1e-3, 5e-4, 3e-4 - 2e-3];
            let c = elasticity.plane_stiffness(Plane::Stress);
            for stress in body.stresses(&found) {
                for i in 0..3 {
                    let expected: f64 = (0..3).map(|j| c[(i, j)] * strain[j]).sum();
                    assert_near(stress[i], expected, 1e-7 * expected.abs());
                }
            }
        }
    }

    /// A force on the volume stretches a bar as in the closed form u = f x (L - x/2)/E with nu = 0.
    #[test]
    fn a_force_on_the_volume_stretches_a_bar() {
        let mesh = Mesh::rectangle(Degree::Quadratic, [10, 4], 0.01);
        let body = Body::new(mesh, &isotropic(0.0), THICKNESS);
        let prescribed: Vec<_> = (body.mesh.nodes.iter())
            .map(|[x, _]| [(*x < -0.0499).then_some(0.0), Some(0.0)])
            .collect();
        let forces = body.volume_forces(|_| [7e6, 0.0]);
        let found = body.displacements(&prescribed, &forces).unwrap();
        for ([u, _], [x, _]) in found.iter().zip(&body.mesh.nodes) {
            let x = x + 0.05;
            assert_near(*u, 7e6 * x * (0.1 - 0.5 * x) / 70e9, 1e-15);
        }
    }

    /// The mesh of 20 x 19 elements of the reference differs from one twice as fine by 0.03 %, the mass here is diagonal.
    #[test]
    fn the_modes_of_a_square_are_those_of_an_independent_calculation() {
        for row in rows(SQUARE) {
            let mesh = Mesh::rectangle(Degree::Quadratic, [40, 40], 0.015);
            let body = Body::new(mesh, &isotropic(row[0]), THICKNESS);
            let held: Vec<_> = body
                .mesh
                .nodes
                .iter()
                .map(|[_, y]| [*y < -0.2699; 2])
                .collect();
            let modes = body.modes(&held, 2500.0, 3).unwrap();
            for (mode, expected) in modes.iter().zip(&row[1..]) {
                assert_near(mode.frequency, *expected, 2e-4 * expected);
            }
        }
    }

    #[test]
    fn the_modes_of_a_lamina_with_a_hole_are_those_of_an_independent_calculation() {
        for row in rows(HOLE) {
            let body = lamina(row[0].to_radians(), 0.01);
            let held: Vec<_> = body
                .mesh
                .nodes
                .iter()
                .map(|[x, _]| [*x < -0.1899; 2])
                .collect();
            let modes = body.modes(&held, 2500.0, 3).unwrap();
            for (mode, expected) in modes.iter().zip(&row[1..]) {
                assert_near(mode.frequency, *expected, 5e-4 * expected);
            }
        }
    }
}
