//! Solution by several ranks with distributed rows: conjugate gradients with a multigrid preconditioner, or a factor.
//!
//! A rank has the rows of its owned points and the correction there; where each rank has all bonds of the body it receives the
//! whole correction. The matrix always belongs to the present bonds. The preconditioner is rebuilt where a part became detached,
//! and where the iterations in excess of its initial rate have cost as much as a rebuild. A factor is computed anew after every
//! breakage.

mod preconditioner_state;
mod rows;

use std::collections::BTreeSet;
use std::io::Read;
use std::sync::Arc;
use std::time::Instant;

use ligament_linalg::{FactorError, Inertia};
use ligament_model::Bonds;
use ligament_model::communicator::Communicator;
use ligament_model::element::StiffnessFactors;
use ligament_model::subdomain::{Partition, Subdomain};
use ligament_model::thermal::ThermalStrain;

use self::preconditioner_state::PreconditionerState;
use self::rows::{OwnRows, Taken};
use super::factor_record::FactorRecord;
use super::terms::due_bonds;
use super::{AllowedResidual, TangentSolver, Unsolved};
use crate::bond_numbers::BondNumbers;
use crate::breakage::Breakage;
use crate::checkpoint::CheckpointError;
use crate::contact::resisting::Resisting;
use crate::costs::Costs;
use crate::distributed_matrix::{DistributedMatrix, MatrixCommunicator, Pivots, Solved, Tolerated};
use crate::serial::{Serial, Sink};
use crate::state::State;
use crate::unknowns::{Layout, Unknowns};
use crate::vectors::dot_of_chunks;

/// Number of iterations that cost as much as a new preconditioner.
const RENEWAL: f64 = 40.0;

/// First bytes of the checkpoint of this solver, which differ from any other solver's.
const MARK: u64 = 0x736b_6e61_7220_669c;

/// A solver for symmetric stiffnesses that runs on several ranks.
pub(crate) struct DistributedSolver {
    system: Arc<dyn Bonds>,
    unknowns: Arc<Unknowns>,
    communicator: Arc<dyn MatrixCommunicator>,
    /// Relative residual of the iteration; None for a factor.
    tolerance: Option<f64>,
    /// Rows of this process, also where each process needs the whole body.
    rows: Subdomain,
    /// Global numbers of the local bonds; bonds are distributed too, unless each process needs the whole body.
    numbers: Arc<BondNumbers>,
    /// Bonds between owned points and others.
    between: Vec<u32>,
    /// Points whose columns have entries in owned rows.
    columns: Vec<u32>,
    matrix: Option<Box<dyn DistributedMatrix>>,
    kept: PreconditionerState,
    /// Pivots of the factor, where there is one.
    pivots: Option<Pivots>,
    /// Number of unknowns of the body.
    n_unknowns: usize,
}

impl DistributedSolver {
    /// Distributes the points over the ranks; without a tolerance the solver factorises.
    pub(crate) fn new(
        system: Arc<dyn Bonds>,
        unknowns: Arc<Unknowns>,
        communicator: Arc<dyn MatrixCommunicator>,
        numbers: Arc<BondNumbers>,
        tolerance: Option<f64>,
    ) -> Self {
        let subdomain = &system.subdomain;
        let own = if subdomain.is_whole() {
            let halve = |points: &mut [u32]| system.halve(points);
            let partition = Partition::new(system.n_points(), communicator.size(), &halve);
            Subdomain::new(partition, communicator.clone())
        } else {
            subdomain.clone()
        };
        let rows = OwnRows {
            system: &*system,
            unknowns: &unknowns,
            subdomain: &own,
        };
        let columns = rows.columns();
        let between = (0..).zip(system.ends.iter()).filter(|(_, ends)| {
            let own = ends.iter().filter(|&&end| rows.is_own(end));
            own.count() == 1
        });
        let between = between.map(|(bond, _)| bond).collect();
        let n_unknowns = subdomain.count(unknowns.len());
        Self {
            between,
            system,
            unknowns,
            communicator,
            tolerance,
            rows: own,
            numbers,
            columns,
            matrix: None,
            kept: PreconditionerState::new(),
            pivots: None,
            n_unknowns,
        }
    }

    fn rows(&self) -> OwnRows<'_> {
        OwnRows {
            system: &*self.system,
            unknowns: &self.unknowns,
            subdomain: &self.rows,
        }
    }

    /// Whether each degree of freedom is free, shape (n_degrees_of_freedom).
    fn free(&self, held: &[bool]) -> Vec<bool> {
        let mut free = vec![false; held.len()];
        for dof in self.unknowns.of_all() {
            free[dof] = !held[dof];
        }
        free
    }

    /// Assembles the matrix of the present bonds, in all columns or some; returns the degrees of freedom of the body that have no
    /// stiffness.
    fn assemble(&mut self, making: &FactorRecord, columns: Option<&[u32]>) -> Vec<usize> {
        let matrix = self.matrix.take();
        let rows = self.rows();
        let new = || {
            let couplings = rows.couplings(&self.columns);
            self.communicator.matrix(&rows.rows(&couplings))
        };
        let Some(mut matrix) = matrix.or_else(new) else {
            return Vec::new();
        };
        let free = self.free(&making.held);
        let bonds = making.bonds();
        let taken = Taken { bonds, free: &free };
        let loose = rows.set(columns.unwrap_or(&self.columns), taken, &mut *matrix);
        matrix.assemble();
        self.matrix = Some(matrix);
        if self.tolerance.is_none() {
            // The factor detects singular and indefinite matrices.
            return Vec::new();
        }
        let n_components = self.unknowns.layout().components.len();
        let loose = loose.into_iter().filter(|&it| self.unknowns.is_unknown(it));
        let in_body = loose.map(|dof| self.rows.index_in_body(dof, n_components));
        self.of_all(in_body)
    }

    /// Sorted union over all ranks of degrees of freedom.
    fn of_all(&self, found: impl Iterator<Item = usize>) -> Vec<usize> {
        let found: Vec<f64> = found.map(|dof| dof as f64).collect();
        let communicator: &dyn Communicator = &*self.communicator;
        let all = communicator.all_gather_list(found).into_iter();
        let mut all: Vec<usize> = all.map(|dof| dof as usize).collect();
        all.sort_unstable();
        all
    }

    /// Builds the preconditioner, with the rigid motions of the body at free degrees of freedom.
    fn precondition(&mut self, making: &FactorRecord) {
        let layout = self.unknowns.layout();
        let free = self.free(&making.held);
        let of_own = |shape: Vec<f64>| -> Vec<f64> {
            let dofs = self.rows.owned().flat_map(|point| layout.range(point));
            dofs.map(|dof| if free[dof] { shape[dof] } else { 0.0 })
                .collect()
        };
        let shapes = self.system.rigid_shapes_of_body().into_iter();
        let motions: Vec<Vec<f64>> = shapes.map(of_own).collect();
        // Bonds couple two points; each process has all points of elements that couple more.
        let n_coupled = self.rows().most_coupled();
        if let Some(matrix) = &mut self.matrix {
            matrix.precondition(&motions, n_coupled);
        }
    }

    /// Computes the factor.
    fn factorise(&mut self) -> Result<(), FactorError> {
        let pivots = self.matrix.as_mut().map(|it| it.factorise());
        self.pivots = pivots;
        match pivots {
            Some(Pivots { vanishing, .. }) if vanishing > 0 => {
                Err(FactorError::Singular { vanishing })
            }
            _ => Ok(()),
        }
    }

    /// Outdated columns, including those coupled with newly fixed degrees of freedom.
    fn stale_columns(&mut self, making: &FactorRecord) -> Vec<u32> {
        let layout = self.unknowns.layout();
        let held = making.held.iter().zip(&self.kept.matrix_of.held);
        let newly_held = held.enumerate().filter(|(_, (now, before))| now != before);
        let points: BTreeSet<u32> = newly_held.map(|(dof, _)| layout.point(dof)).collect();
        let mut stale = std::mem::take(&mut self.kept.stale);
        for point in points {
            stale.insert(point);
            stale.extend(self.system.coupled_points.at(point));
        }
        stale.into_iter().collect()
    }

    /// Whether all ranks solve for the same forces, bit for bit, so that they take the same branches. With distributed forces,
    /// compares the load factor and the remaining stiffness of the bonds between ranks.
    fn agree(&self, state: &State, force: &[f64]) -> bool {
        let numbers = &self.numbers;
        if numbers.subdomain().is_whole() {
            return self.are_equal(force.iter().map(|value| value.to_bits()));
        }
        let remaining = &state.softening.remaining;
        let left = |&bond: &u32| {
            let (number, bond) = (numbers.number(bond), bond as usize);
            let left = remaining
                .get(bond)
                .copied()
                .unwrap_or(StiffnessFactors::WHOLE);
            let bits = [left.axial, left.shear, left.rotational].map(f64::to_bits);
            let is_left = u64::from(state.intact[bond]);
            let mixed = mixed([u64::from(number), is_left].into_iter().chain(bits));
            // Sums of this many integers are exact.
            let part = (mixed >> 44) as f64;
            if numbers.owns(bond) { part } else { -part }
        };
        let mut of_both = [self.between.iter().map(left).sum::<f64>()];
        numbers.subdomain().all_reduce_sum(&mut of_both);
        self.are_equal([state.load_factor.to_bits()].into_iter()) && of_both == [0.0]
    }

    /// Whether numbers are equal on all ranks, bit for bit.
    fn are_equal(&self, values: impl Iterator<Item = u64>) -> bool {
        let mixed = mixed(values);
        // Halves of 32 bits are exact in doubles.
        let halves = [(mixed >> 32) as f64, (mixed & 0xffff_ffff) as f64];
        let mut both = [halves[0], halves[1], -halves[0], -halves[1]];
        self.communicator.all_reduce_max(&mut both);
        both[0] == -both[2] && both[1] == -both[3]
    }

    /// Values at the degrees of freedom of owned points, from values at the unknowns; `other` where a degree of freedom is not a
    /// free unknown.
    fn at_own(&self, values: &[f64], free: &[bool], other: f64) -> Vec<f64> {
        let layout = self.unknowns.layout();
        let dofs = self.rows.owned().flat_map(|point| layout.range(point));
        let value = |dof: usize| self.unknowns.number(dof).filter(|_| free[dof]);
        dofs.map(|dof| value(dof).map_or(other, |number| values[number]))
            .collect()
    }

    /// Updates the excess of iterations by a solution, which decides whether the preconditioner is rebuilt.
    fn judge(&mut self, found: &Solved) {
        if found.iterations == 0 || !found.decades.is_finite() || found.decades <= 0.0 {
            return;
        }
        let (kept, iterations) = (&mut self.kept, found.iterations as f64);
        match kept.pace {
            None => kept.pace = Some(iterations / found.decades),
            Some(pace) => kept.excess += (iterations - pace * found.decades).max(0.0),
        }
        kept.is_due |= kept.excess > RENEWAL;
    }

    /// Solution at the unknowns, from the motions at the degrees of freedom of owned points.
    fn at_unknowns(&self, motions: Vec<f64>) -> Vec<f64> {
        let layout = self.unknowns.layout();
        let n = layout.components.len();
        let dofs = self.unknowns.degrees_of_freedom().iter();
        let dofs = dofs.map(|&dof| dof as usize);
        let place = |dof: usize| self.rows.place(layout.point(dof));
        if !self.numbers.subdomain().is_whole() {
            let first = self.rows.first(self.communicator.rank());
            return dofs
                .map(|dof| motions[n * (place(dof) - first) + dof % n])
                .collect();
        }
        let all = self.communicator.all_gather(&motions, &self.rows.counts(n));
        dofs.map(|dof| all[n * place(dof) + dof % n]).collect()
    }
}

impl TangentSolver for DistributedSolver {
    fn follow(
        &mut self,
        breakage: &Breakage,
        _: &State,
        _: ThermalStrain<'_>,
        _: &mut Costs,
    ) -> Option<Vec<f64>> {
        let layout = self.unknowns.layout();
        let terms = breakage.lost_terms().chain(breakage.gained_terms());
        let entries = terms.flat_map(|(_, entries)| entries);
        let points = entries.map(|(dof, _)| layout.point(dof));
        self.kept.stale.extend(points);
        // The rigid motions of a detached part are among the softest motions.
        self.kept.is_due |= !breakage.holds.is_empty();
        None
    }

    fn update_for_softening(&mut self, state: &State, _: &mut Costs) {
        let n_bonds = state.softening.remaining.len();
        let mut in_matrix = self.kept.matrix_of.remaining.clone();
        in_matrix.resize(n_bonds, StiffnessFactors::WHOLE);
        let ends = &self.system.ends;
        let due = due_bonds(&in_matrix, state);
        let of_due = due.into_iter().flat_map(|bond| ends[bond]);
        self.kept.stale.extend(of_due);
    }

    fn close(&mut self, _: Vec<Resisting>, _: &mut Costs) {}

    fn prepare(&mut self, state: &State, costs: &mut Costs) -> Result<Vec<usize>, FactorError> {
        let start = Instant::now();
        let making = FactorRecord::begun(state, state.held.clone(), Vec::new());
        let is_new = self.kept.is_due || self.matrix.is_none();
        let stale = self.stale_columns(&making);
        let mut some_stale = [f64::from(u8::from(!stale.is_empty()))];
        self.communicator.all_reduce_max(&mut some_stale);
        if !is_new && some_stale == [0.0] {
            return Ok(Vec::new());
        }
        // Both ends of a softening bond must have entries from the same state.
        let columns = (!is_new && making.remaining.is_empty()).then_some(stale.as_slice());
        let loose = self.assemble(&making, columns);
        self.kept.matrix_of = making.clone();
        costs.assembly += start.elapsed();
        if !loose.is_empty() {
            self.kept.stale.extend(stale);
            return Ok(loose);
        }
        let start = Instant::now();
        if self.tolerance.is_none() {
            self.factorise()?;
        } else if is_new {
            self.precondition(&making);
        } else {
            costs.changes += 1;
            return Ok(Vec::new());
        }
        let kept = &mut self.kept;
        kept.preconditioner_of = making;
        (kept.is_due, kept.pace, kept.excess) = (false, None, 0.0);
        costs.factorisations += 1;
        costs.factorisation += start.elapsed();
        Ok(Vec::new())
    }

    fn solve(
        &mut self,
        state: &State,
        force: Vec<f64>,
        left: AllowedResidual,
        costs: &mut Costs,
    ) -> Result<Vec<f64>, Unsolved> {
        let start = Instant::now();
        if !self.agree(state, &force) {
            return Err(Unsolved::Disagreement);
        }
        let Some(mut matrix) = self.matrix.take() else {
            return Err(Unsolved::Indefinite(vec![0.0; force.len()]));
        };
        let free = self.free(&self.kept.matrix_of.held);
        let own_force = self.at_own(&force, &free, 0.0);
        let found = match left {
            AllowedResidual::Share(share) => {
                let square = dot_of_chunks(&force, &force);
                let square = self.numbers.subdomain().sum(square);
                let norm = share * square.sqrt();
                matrix.solve(&own_force, Tolerated::Norm(norm))
            }
            AllowedResidual::AtMost(sizes) => {
                let sizes = self.at_own(&sizes, &free, f64::INFINITY);
                matrix.solve(&own_force, Tolerated::Sizes(&sizes))
            }
        };
        self.matrix = Some(matrix);
        if self.tolerance.is_some() {
            self.judge(&found);
            costs.iterations += found.iterations;
        }
        let solution = self.at_unknowns(found.motions);
        costs.solves += 1;
        costs.solve += start.elapsed();
        if found.is_definite {
            Ok(solution)
        } else {
            Err(Unsolved::Indefinite(solution))
        }
    }

    fn tolerance(&self) -> Option<f64> {
        self.tolerance
    }

    fn is_changed(&self) -> bool {
        false
    }

    fn discard(&mut self) {
        self.kept.is_due = true;
    }

    fn inertia(&self) -> Option<Inertia> {
        self.pivots.map(|pivots| Inertia {
            negative: pivots.negative,
            positive: self.n_unknowns - pivots.negative,
        })
    }

    fn write(&self, out: &mut dyn Sink) {
        MARK.write(out);
        self.matrix.is_some().write(out);
        self.kept.write(&self.numbers, out);
    }

    fn restore(&mut self, from: &mut dyn Read) -> Result<(), CheckpointError> {
        if u64::read(from)? != MARK {
            return Err(CheckpointError::OfOneProcess);
        }
        let has_matrix = bool::read(from)?;
        let n_components = self.unknowns.layout().components.len();
        self.kept = PreconditionerState::read((&self.numbers, n_components), from)?;
        if !has_matrix {
            return Ok(());
        }
        let PreconditionerState {
            preconditioner_of,
            matrix_of,
            stale,
            ..
        } = &self.kept;
        let n_points = self.system.n_points();
        let fits = |making: &FactorRecord| making.fits(&*self.system, &self.unknowns);
        if !fits(preconditioner_of)
            || !fits(matrix_of)
            || stale.iter().any(|it| *it as usize >= n_points)
        {
            return Err(CheckpointError::OtherModel);
        }
        let (before, now) = (preconditioner_of.clone(), matrix_of.clone());
        self.assemble(&before, None);
        if self.tolerance.is_some() {
            self.precondition(&before);
            self.assemble(&now, None);
        } else {
            let factor = self.factorise();
            factor.map_err(|_| CheckpointError::OtherArithmetic)?;
        }
        Ok(())
    }
}

/// Hash of a sequence of numbers, by FNV-1a.
fn mixed(values: impl Iterator<Item = u64>) -> u64 {
    values.fold(0xcbf2_9ce4_8422_2325_u64, |hash, value| {
        (hash ^ value)
            .wrapping_mul(0x0100_0000_01b3)
            .rotate_left(29)
    })
}

/// Restores a solver, which is shared between processes or not, from the bytes of [`TangentSolver::write`]; one process continues from the state
/// alone where several wrote them.
///
/// # Errors
///
/// If the bytes are damaged or belong to another model, or if the factor differs in any bit.
pub(crate) fn restore(
    (solver, is_shared): (&mut dyn TangentSolver, bool),
    (numbers, layout): (&BondNumbers, Layout),
    from: &mut dyn Read,
) -> Result<(), CheckpointError> {
    let first = u64::read(from)?;
    if is_shared || first != MARK {
        let mut again = Vec::new();
        first.write(&mut again);
        return solver.restore(&mut again.as_slice().chain(from));
    }
    let _ = bool::read(from)?;
    let _ = PreconditionerState::read((numbers, layout.components.len()), from)?;
    Ok(())
}
