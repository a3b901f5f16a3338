//! State of a body, which changes during a run.

use std::io::Read;

use ligament_model::Bonds;
pub use ligament_model::UnbrokenBonds;
use ligament_model::failure::Criteria;
use ligament_model::surface::Pose;

use crate::bond_numbers::BondNumbers;
use crate::checkpoint::CheckpointError;
use crate::contact::{Friction, LastTouching};
use crate::serial::{Serial, Sink};
use crate::softening::Softening;

/// Motion of the points and state of the bonds.
#[derive(Debug, Clone, PartialEq)]
pub struct State {
    /// Load factor.
    pub load_factor: f64,
    /// Displacements and rotations, shape (n_degrees_of_freedom), m and rad.
    pub displacement: Vec<f64>,
    /// Whether each bond is unbroken, shape (n_bonds).
    pub intact: Vec<bool>,
    /// Criterion by which each broken bond broke, shape (n_bonds).
    pub broken_by: Vec<Option<u8>>,
    /// Softening of unbroken bonds beyond their limits; empty where no bond softens.
    pub softening: Softening,
    /// Energy dissipated by each bond, shape (n_bonds), J.
    pub dissipated: Vec<f64>,
    /// Whether each degree of freedom has an added support, for want of stiffness, shape (n_degrees_of_freedom).
    pub held: Vec<bool>,
    /// Friction on the faces of cracks in the last equilibrium, or after the last time step.
    pub friction: Friction,
    /// Contact between surfaces in the last equilibrium, or after the last time step.
    pub surfaces: LastTouching,
    /// Pose of each rigid body that moves by itself, zero for others; the last poses may be missing as long as they are zero.
    pub rigid: Vec<Pose>,
}

/// Fields of a state that a solution for equilibrium changes, beside its added supports.
#[derive(Debug, Clone)]
pub(crate) struct Solution {
    load_factor: f64,
    displacement: Vec<f64>,
    softening: Softening,
    friction: Friction,
    surfaces: LastTouching,
    rigid: Vec<Pose>,
}

impl State {
    /// The present solution.
    pub(crate) fn solution(&self) -> Solution {
        Solution {
            load_factor: self.load_factor,
            displacement: self.displacement.clone(),
            softening: self.softening.clone(),
            friction: self.friction.clone(),
            surfaces: self.surfaces.clone(),
            rigid: self.rigid.clone(),
        }
    }

    /// Returns to an earlier solution.
    pub(crate) fn return_to(&mut self, solution: Solution) {
        let Solution {
            load_factor,
            displacement,
            softening,
            friction,
            surfaces,
            rigid,
        } = solution;
        self.load_factor = load_factor;
        self.displacement = displacement;
        self.softening = softening;
        self.friction = friction;
        self.surfaces = surfaces;
        self.rigid = rigid;
    }

    /// Whether all arrays have the shapes for a body with this number of bonds and these criteria.
    pub(crate) fn fits(&self, system: &dyn Bonds, n_bonds: usize, criteria: &Criteria) -> bool {
        let n = system.layout.n_degrees_of_freedom();
        let of_degrees_of_freedom = [self.displacement.len(), self.held.len()];
        let of_bonds = [
            self.intact.len(),
            self.broken_by.len(),
            self.dissipated.len(),
        ];
        let mut by = self.broken_by.iter().flatten();
        of_degrees_of_freedom == [n; 2]
            && of_bonds == [n_bonds; 3]
            && by.all(|&criterion| usize::from(criterion) < criteria.list.len())
            && self.softening.fits(criteria, n_bonds)
    }

    /// Unloaded body with all its bonds.
    pub fn fresh(system: &dyn Bonds) -> Self {
        let n = system.layout.n_degrees_of_freedom();
        let n_bonds = system.ends.len();
        Self {
            load_factor: 0.0,
            displacement: vec![0.0; n],
            intact: vec![true; n_bonds],
            broken_by: vec![None; n_bonds],
            softening: Softening::default(),
            dissipated: vec![0.0; n_bonds],
            held: vec![false; n],
            friction: Friction::default(),
            surfaces: LastTouching::default(),
            rigid: Vec::new(),
        }
    }

    /// Appends the state of all points and bonds of the body, from the states on each process; valid on rank 0 alone. Collective.
    pub(crate) fn write(&self, numbers: &BondNumbers, out: &mut dyn Sink) {
        let n_components = self.displacement.len() / numbers.subdomain().n_points().max(1);
        self.load_factor.write(out);
        numbers.write_points((&self.displacement, n_components), 0.0, out);
        numbers.write(&self.intact, true, out);
        numbers.write(&self.broken_by, None, out);
        self.softening.write(numbers, out);
        numbers.write(&self.dissipated, 0.0, out);
        numbers.write_points((&self.held, n_components), false, out);
        self.friction.write(out);
        self.surfaces.touching().write(out);
        self.rigid.write(out);
    }

    /// Reads a state with all bonds, and keeps the local bonds.
    ///
    /// # Errors
    ///
    /// If the bytes are damaged or belong to another body.
    pub(crate) fn read(
        (numbers, n_components): (&BondNumbers, usize),
        criteria: &Criteria,
        from: &mut dyn Read,
    ) -> Result<Self, CheckpointError> {
        let mut state = Self {
            load_factor: Serial::read(from)?,
            displacement: numbers.read_points(n_components, 0.0, from)?,
            intact: numbers.read(true, from)?,
            broken_by: numbers.read(None, from)?,
            softening: Softening::read(numbers, criteria, from)?,
            dissipated: numbers.read(0.0, from)?,
            held: numbers.read_points(n_components, false, from)?,
            friction: Serial::read(from)?,
            surfaces: LastTouching::default(),
            rigid: Vec::new(),
        };
        state.surfaces = LastTouching::restored(Serial::read(from)?, &state.displacement);
        state.rigid = Serial::read(from)?;
        Ok(state)
    }

    /// Number of broken bonds.
    pub fn broken_bonds(&self) -> usize {
        self.intact.iter().filter(|intact| !**intact).count()
    }

    /// Number of unbroken bonds whose force has begun to fall beyond a limit.
    pub fn softened_bonds(&self) -> usize {
        let bonds = 0..self.intact.len();
        bonds.filter(|&bond| self.has_softened(bond)).count()
    }

    /// Whether a bond is unbroken and its force has begun to fall beyond a limit.
    pub(crate) fn has_softened(&self, bond: usize) -> bool {
        let mut largest = self.softening.largest.iter();
        self.intact[bond] && largest.any(|it| it.get(bond).is_some_and(|it| *it > 1.0))
    }

    /// Intact bonds, with their remaining stiffness.
    pub fn bonds(&self) -> UnbrokenBonds<'_> {
        UnbrokenBonds {
            intact: &self.intact,
            remaining: &self.softening.remaining,
        }
    }
}
