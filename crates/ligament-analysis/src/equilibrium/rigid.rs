//! Rigid bodies with a mass in the step of a motion: their displacements are unknowns in addition to the displacements of the points.
//!
//! A contact with the stiffness k resists the motion c . u - d . q along d of a place of the body against a rigid body with the displacement q.
//! With the springs kappa and the forces of a step ([`Equations`]), and the residual forces r on the points and s on the
//! rigid bodies, a correction of Newton's method solves
//!
//! K du - B dq = r,  D dq - B^T du = s,  B = sum k c d^T,  D = kappa I + sum k d d^T,
//!
//! with the tangent stiffness K against rigid bodies at rest: dq from the Schur complement D - B^T K^-1 B, whose unknowns are only the
//! displacements of the rigid bodies, and du from K^-1 (r + B dq).

use ligament_model::surface::{Pose, Vector};
use ligament_model::tensor::dot;
use nalgebra::{DMatrix, DVector};

use super::equations::{Equations, Iterate};
use crate::contact::Contacts;
use crate::contact::resisting::Resisting;
use crate::state::State;
use crate::unbalanced::Unbalanced;

/// Correction of the displacements of points and rigid bodies.
pub(super) struct Correction {
    /// Shape (n_unknowns).
    pub(super) motions: Vec<f64>,
    /// Displacement of each rigid body with a mass, in the order of the loads on them, m.
    pub(super) rigid: Vec<Vector>,
}

impl Correction {
    /// Adds a part of the correction to a state.
    pub(super) fn add_to(&self, equations: &Equations, state: &mut State, part: f64) {
        equations.add_correction(state, part, &self.motions);
        let loads = equations.problem.loads.on_rigid_bodies();
        for (load, change) in loads.iter().zip(&self.rigid) {
            if state.rigid.len() <= load.body {
                state.rigid.resize(load.body + 1, Pose::default());
            }
            for (place, change) in state.rigid[load.body].displacement.iter_mut().zip(change) {
                *place += part * change;
            }
        }
    }

    /// Slope of the energy of an iterate of a state along the correction, J.
    pub(super) fn slope(&self, equations: &Equations, state: &State, iterate: &Iterate) -> f64 {
        let of_rigid = iterate.on_rigid.iter().zip(&self.rigid);
        let of_rigid = of_rigid.fold(0.0, |sum, (force, change)| sum - dot(*force, *change));
        equations.slope(state, iterate, &self.motions) + of_rigid
    }

    /// Shortens the correction where surfaces would move too far at once to see each other.
    pub(super) fn shorten(&mut self, equations: &Equations) {
        let surfaces = &equations.contact.surfaces;
        if surfaces.is_empty() {
            return;
        }
        let motions = equations.at_degrees_of_freedom(&self.motions);
        let part = surfaces.part_within_reach(&motions, &self.rigid);
        let rigid = self.rigid.as_flattened_mut();
        (self.motions.iter_mut())
            .chain(rigid)
            .for_each(|it| *it *= part);
    }
}

/// Correction of an iterate for the relative residual `sought`; appends the points of mechanisms that the solver found.
pub(super) fn correction(
    equations: &mut Equations,
    state: &mut State,
    iterate: &Iterate,
    sought: f64,
    mechanisms: &mut Vec<u32>,
) -> Result<Correction, Unbalanced> {
    let mut motions = equations.correction(state, iterate, sought, mechanisms)?;
    let n_bodies = iterate.on_rigid.len();
    if n_bodies == 0 {
        return Ok(Correction {
            motions,
            rigid: Vec::new(),
        });
    }
    let coupling = Coupling::new(equations, &iterate.met);
    let mut moved = Vec::new();
    for column in &coupling.columns {
        let left = (equations.accuracy).left(equations.loaded(state), iterate.extents, sought);
        moved.push(equations.solve(state, column.clone(), left)?);
    }
    let n = coupling.columns.len();
    let complement = DMatrix::from_fn(n, n, |row, column| {
        let by_points = equations.dot(&coupling.columns[row], &moved[column]);
        coupling.own[(row, column)] - by_points
    });
    let axes = n / n_bodies;
    let forces = DVector::from_fn(n, |row, _| {
        let by_points = equations.dot(&coupling.columns[row], &motions);
        iterate.on_rigid[row / axes][row % axes] + by_points
    });
    let solution = complement.lu().solve(&forces);
    let changes = solution.ok_or(Unbalanced::NegativeCurvature)?;
    for (column, change) in moved.iter().zip(changes.iter()) {
        for (motion, column) in motions.iter_mut().zip(column) {
            *motion += change * column;
        }
    }
    let of_body = |body: usize| -> Vector {
        std::array::from_fn(|axis| {
            if axis < axes {
                changes[body * axes + axis]
            } else {
                0.0
            }
        })
    };
    Ok(Correction {
        motions,
        rigid: (0..n_bodies).map(of_body).collect(),
    })
}

/// Coupling by contacts of points and rigid bodies with a mass.
struct Coupling {
    /// Columns of B at the unknowns, one for each axis of each body.
    columns: Vec<Vec<f64>>,
    /// The matrix D.
    own: DMatrix<f64>,
}

impl Coupling {
    fn new(equations: &Equations, met: &Contacts) -> Self {
        let loads = equations.problem.loads.on_rigid_bodies();
        let components = equations.layout().components.iter();
        let axes = components.filter(|it| !it.is_rotation()).count();
        let n = axes * loads.len();
        let mut own = DMatrix::zeros(n, n);
        for (place, load) in loads.iter().enumerate() {
            for axis in 0..axes {
                own[(place * axes + axis, place * axes + axis)] = load.stiffness;
            }
        }
        let mut all = vec![vec![0.0; equations.layout().n_degrees_of_freedom()]; n];
        let contacts = &equations.problem.contact.contacts;
        for it in (equations.contact).resisting(&met.closed, &met.touching) {
            let contact = it.contact().map(|number| &contacts[number]);
            let body = contact.and_then(|it| it.rigid_body);
            let Some(place) = loads.iter().position(|load| Some(load.body) == body) else {
                continue;
            };
            let Resisting {
                way,
                stiffness,
                row,
                ..
            } = it;
            for axis in 0..axes {
                let column = place * axes + axis;
                for (dof, factor) in &row {
                    all[column][*dof] += stiffness * way[axis] * factor;
                }
                for other in 0..axes {
                    own[(column, place * axes + other)] += stiffness * way[axis] * way[other];
                }
            }
        }
        let at_unknowns = |column: Vec<f64>| -> Vec<f64> {
            let dofs = equations.degrees_of_freedom().iter();
            dofs.map(|&dof| column[dof as usize]).collect()
        };
        Self {
            columns: all.into_iter().map(at_unknowns).collect(),
            own,
        }
    }
}
