//! Equilibrium lines: rates of the displacements with the load factor, for the present bonds.

use super::accuracy::Loaded;
use super::equations::Equations;
use super::residual::{Extents, RESIDUAL_TOLERANCE, Residual, Rounded};
use crate::load_program::LoadProgram;
use crate::state::State;
use crate::unbalanced::Unbalanced;

/// Error of a rate, as a share of the tolerance of an iterative solver; all states on the line have that error.
const LINE: f64 = 0.1;

/// Number of solutions after which an iterative solver is given up: each reaches its tolerance, unless it reaches rounding.
const MOST_SOLUTIONS: usize = 8;

/// Forces of a line under its loads at load factor 1.
pub(super) struct Forces {
    pub(super) extents: Extents,
    /// External minus internal forces at the unknowns, shape (n_unknowns), N and N m.
    pub(super) out_of_balance: Vec<f64>,
    pub(super) residual: Residual,
}

/// Rate of the displacements with the load factor, shape (n_degrees_of_freedom), for the bonds of a state under loads at load
/// factor 1.
///
/// The solution of an iterative solver is judged like the solution of a state, by the forces at each point. The norm of the force is no
/// measure where a stiff platen moves the body: the force of the platen on a fixed body is many times the force that deforms it.
///
/// # Errors
///
/// If the stiffness has no factor, or an iterative solver does not converge.
pub(super) fn growth(
    equations: &mut Equations,
    state: &mut State,
    loads: &dyn LoadProgram,
) -> Result<Vec<f64>, Unbalanced> {
    equations.solver.fall(Vec::new());
    equations.prepare_solver(state)?;
    let (prescribed, force) = rate(equations, state, loads);
    let mut line = at_one(state, prescribed);
    let left = equations.accuracy.left_of_line(LINE);
    let solution = equations.solve(state, force, left)?;
    equations.add_correction(&mut line, 1.0, &solution);
    // Forces of closed faces are in the stiffness only, not among the forces that judge the solution.
    let faces_close = equations.problem.may_press();
    let tolerance = equations.solver.tolerance().filter(|_| !faces_close);
    let Some(tolerance) = tolerance else {
        return Ok(line.displacement);
    };
    let sought = (LINE * tolerance).max(RESIDUAL_TOLERANCE);
    for solutions in 1.. {
        let forces = measured(equations, &line, loads, &[]);
        if forces.residual.relative <= sought {
            break;
        }
        if solutions == MOST_SOLUTIONS {
            return Err(equations.unsettled(&forces.residual, solutions));
        }
        let at = loaded(equations, &line, loads);
        let left = equations.accuracy.left(at, forces.extents, sought);
        let correction = equations.solve(state, forces.out_of_balance, left)?;
        equations.add_correction(&mut line, 1.0, &correction);
    }
    Ok(line.displacement)
}

/// Reason why loads cannot grow along a line (n_degrees_of_freedom) of a state: an added support would carry a load.
pub(super) fn load_on_added_support(
    equations: &Equations,
    state: &State,
    growth: &[f64],
    loads: &dyn LoadProgram,
) -> Option<Unbalanced> {
    if !equations.subdomain().any(state.held.contains(&true)) {
        return None;
    }
    let line = at_one(state, growth.to_vec());
    let (dof, force) = measured(equations, &line, loads, &[]).residual.carried?;
    let place = equations.place(dof as usize);
    Some(Unbalanced::LoadOnAddedSupport { place, force })
}

/// Prescribed motions at load factor 1 (n_degrees_of_freedom), and the residual forces (n_unknowns) that they and the loads cause
/// with the bonds of a state.
pub(super) fn rate(
    equations: &Equations,
    state: &State,
    loads: &dyn LoadProgram,
) -> (Vec<f64>, Vec<f64>) {
    let mut prescribed = vec![0.0; state.displacement.len()];
    loads.prescribe(1.0, &mut prescribed);
    let system = &equations.problem.system;
    let expansion = loads.thermal_strain(1.0);
    let deformations = system.deformations(&state.intact, &prescribed, expansion);
    let swept = system.forces(state.bonds(), deformations, expansion);
    let dofs = equations.degrees_of_freedom();
    let force = loads.external_less(1.0, &prescribed, &swept.internal, dofs);
    (prescribed, force)
}

/// State with displacements (n_degrees_of_freedom) at load factor 1, with the bonds and added supports of another state.
pub(super) fn at_one(state: &State, displacement: Vec<f64>) -> State {
    State {
        displacement,
        load_factor: 1.0,
        ..state.clone()
    }
}

pub(super) fn loaded<'a>(
    equations: &'a Equations,
    line: &'a State,
    loads: &'a dyn LoadProgram,
) -> Loaded<'a> {
    Loaded {
        loads,
        unknowns: &equations.unknowns,
        state: line,
    }
}

/// Forces of a line under its loads, with some internal forces of contacts by degree of freedom, N and N m.
pub(super) fn measured(
    equations: &Equations,
    line: &State,
    loads: &dyn LoadProgram,
    of_contacts: &[(usize, f64)],
) -> Forces {
    let mut swept = equations.swept(line, loads.thermal_strain(1.0));
    for &(dof, force) in of_contacts {
        swept.internal.values[dof] += force;
        swept.sizes[dof] += force.abs();
    }
    let accuracy = &equations.accuracy;
    let extents = accuracy.extents(&swept.sizes);
    // Rates of gaps are no differences of positions.
    let rounded = Rounded {
        displacement: accuracy.largest_displacement(equations.layout(), line),
        ..Rounded::default()
    };
    let dofs = equations.degrees_of_freedom();
    let out_of_balance = loads.external_less(1.0, &line.displacement, &swept.internal, dofs);
    let at = loaded(equations, line, loads);
    Forces {
        residual: accuracy.residual(at, extents, rounded, out_of_balance.clone()),
        extents,
        out_of_balance,
    }
}
