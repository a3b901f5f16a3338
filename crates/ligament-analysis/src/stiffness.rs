//! Stiffness of a body: its unknowns, its sparsity pattern and the structure of its factor.

use std::sync::Arc;
use std::time::{Duration, Instant};

use ligament_linalg::{FactorError, FactorKind, Pattern, Symbolic, SymmetricMatrix};
use ligament_model::{Bonds, UnbrokenBonds};

use crate::assembly;
use crate::error::SetupError;
use crate::solver::{DirectChoice, Ordering, Reason, SolverSettings, Update};
use crate::state::State;
use crate::unknowns::Unknowns;

/// Numbering, sparsity pattern and symbolic factor of the stiffness of a bond system, and the settings of its factor.
///
/// Breakages change values, never the pattern, so that this is valid for any state of the bonds.
pub struct Stiffness {
    system: Arc<dyn Bonds>,
    unknowns: Arc<Unknowns>,
    /// Unknowns without the couplings by contacts.
    uncoupled: Arc<Unknowns>,
    pattern: Arc<Pattern>,
    symbolic: Arc<Symbolic>,
    choice: DirectChoice,
    analysis: Duration,
}

/// Memory until the matrix is factorised, as a multiple of the memory of its values.
const MATRICES: usize = 4;

/// Least bytes of the matrix of some bonds and its factor: a block for each bond, and as much in the factor.
pub(crate) fn least_bytes(system: &dyn Bonds) -> usize {
    let n_components = system.layout.components.len();
    size_of::<f64>() * (MATRICES + 1) * n_components * n_components * system.ends.len()
}

impl Stiffness {
    /// Analyses the sparsity pattern for some unknowns, with the reason for a factor, without factorising.
    ///
    /// # Errors
    ///
    /// If the factor is too large.
    pub(crate) fn new(
        system: &Arc<dyn Bonds>,
        unknowns: Arc<Unknowns>,
        settings: &SolverSettings,
        reason: Reason,
    ) -> Result<Self, SetupError> {
        let start = Instant::now();
        let pattern = Arc::new(assembly::pattern(&**system, &unknowns)?);
        let ordering = settings
            .ordering
            .unwrap_or(Ordering::suited_to(system.n_points()));
        let symbolic = Arc::new(Symbolic::analyse(pattern.clone(), ordering.into())?);
        // Without positive stiffnesses the matrix may not be positive definite. Cells hold what bonds without shear stiffness leave.
        let (rigidities, subdomain) = (system.rigidities(), &system.subdomain);
        let is_held = system.has_volumetric_cells && !rigidities.some_negative(subdomain);
        let suitable = if is_held || rigidities.all_positive(subdomain) {
            FactorKind::Llt
        } else {
            FactorKind::Ldlt
        };
        Ok(Self {
            pattern,
            choice: DirectChoice {
                reason,
                factorisation: settings.factorisation.map_or(suitable, Into::into),
                unsymmetric: !system.element.has_energy(),
                ordering,
                update: settings.update.unwrap_or(Update::Incremental),
                rebuild_every: settings.rebuild_every.max(1),
                most_bonds_in_place: most_bonds_in_place(&symbolic, system.layout.components.len()),
            },
            symbolic,
            uncoupled: unknowns.clone(),
            unknowns,
            analysis: start.elapsed(),
            system: system.clone(),
        })
    }

    /// The stiffness with entries between the points of some groups as well, which contacts may couple.
    ///
    /// # Errors
    ///
    /// If the factor is too large.
    pub(crate) fn with_coupled(&self, groups: &[Vec<u32>]) -> Result<Self, FactorError> {
        let start = Instant::now();
        let restraints =
            (self.uncoupled.restraints()).with_coupled(self.uncoupled.layout(), groups);
        let unknowns = (*self.uncoupled)
            .clone()
            .restrained_by(&Arc::new(restraints));
        let pattern = assembly::pattern(&*self.system, &unknowns);
        let pattern = Arc::new(pattern.expect("the points of a pattern ascend"));
        let elimination = self.choice.ordering.into();
        let symbolic = Arc::new(Symbolic::analyse(pattern.clone(), elimination)?);
        let n_components = self.system.layout.components.len();
        Ok(Self {
            choice: DirectChoice {
                most_bonds_in_place: most_bonds_in_place(&symbolic, n_components),
                ..self.choice
            },
            pattern,
            symbolic,
            unknowns: Arc::new(unknowns),
            uncoupled: self.uncoupled.clone(),
            analysis: self.analysis + start.elapsed(),
            system: self.system.clone(),
        })
    }

    /// Whether bonds or restraints couple all of some points (ascending) with each other.
    pub(crate) fn couples(&self, points: &[u32]) -> bool {
        let (restraints, layout) = (self.unknowns.restraints(), self.unknowns.layout());
        points.iter().enumerate().all(|(place, &point)| {
            let lower =
                restraints.lower_points(layout, &self.system.coupled_points, point as usize);
            let mut others = points[..place].iter();
            others.all(|it| lower.binary_search(it).is_ok())
        })
    }

    /// Bond system of the stiffness.
    pub fn system(&self) -> &dyn Bonds {
        &*self.system
    }

    /// Unknowns of the stiffness.
    pub fn unknowns(&self) -> &Unknowns {
        &self.unknowns
    }

    /// Structure of the factor.
    pub fn symbolic(&self) -> &Arc<Symbolic> {
        &self.symbolic
    }

    /// Bytes of the matrix and its factor. The matrix is stored with its row numbers, and once more in elimination order during the
    /// factorisation.
    pub fn bytes(&self) -> usize {
        let matrix = MATRICES * self.pattern.n_entries();
        size_of::<f64>() * (matrix + self.symbolic.n_factor_values())
    }

    /// Sets the reason for a factor.
    pub(crate) fn chosen_for(&mut self, reason: Reason) {
        self.choice.reason = reason;
    }

    /// Settings chosen for the factor.
    pub fn choice(&self) -> &DirectChoice {
        &self.choice
    }

    /// Time of numbering, pattern and symbolic analysis.
    pub(crate) fn analysis_time(&self) -> Duration {
        self.analysis
    }

    /// Symbolic factor for another elimination order.
    pub fn analysed_with(&self, ordering: Ordering) -> Result<Symbolic, SetupError> {
        Ok(Symbolic::analyse(self.pattern.clone(), ordering.into())?)
    }

    /// Matrix of some bonds; unknowns in `held` (n_degrees_of_freedom) are decoupled.
    pub(crate) fn assemble(&self, bonds: UnbrokenBonds<'_>, held: &[bool]) -> SymmetricMatrix {
        assembly::assemble(&*self.system, &self.unknowns, &self.pattern, bonds, held)
    }

    /// Number of negative eigenvalues of the rotation block for the bonds of a state.
    ///
    /// Fixing the rigid motions of a part removes no negative eigenvalue from its stiffness (they have none), but might remove one
    /// from this block by fixing a rotation: only points that lost all their bonds are therefore fixed here.
    pub(crate) fn negative_rotations(&self, state: &State) -> Result<usize, SetupError> {
        let rotations = self.unknowns.rotations_only();
        if rotations.is_empty() {
            return Ok(0);
        }
        let is_alone = |dof: usize| {
            let incidence = &self.system.incidence;
            let mut bonds = incidence.at(self.unknowns.layout().point(dof)).iter();
            bonds.all(|&bond| !state.intact[bond as usize])
        };
        let alone: Vec<bool> = (0..state.held.len()).map(is_alone).collect();
        let pattern = Arc::new(assembly::pattern(&*self.system, &rotations)?);
        let block = assembly::assemble(&*self.system, &rotations, &pattern, state.bonds(), &alone);
        let symbolic = Arc::new(Symbolic::analyse(pattern, self.choice.ordering.into())?);
        let factor = FactorKind::Ldlt.factorise(&symbolic, &block)?;
        Ok(factor.inertia().negative)
    }
}

/// Least number of rank-one terms counted for an element; at most one for each component of a point that has more.
const TERMS: usize = 3;

/// Largest number of elements for which an update of the factor costs less than a new one: each term of an element reads and writes
/// a part of the values of the factor.
fn most_bonds_in_place(symbolic: &Symbolic, n_components: usize) -> usize {
    let of_one_bond = (TERMS.max(n_components) * symbolic.n_factor_values()) as f64;
    (symbolic.n_multiplications() / of_one_bond) as usize
}
