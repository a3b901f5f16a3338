//! The stiffness of the intact bonds and its factor, kept up while bonds break.

mod change;

use std::sync::Arc;
use std::time::{Duration, Instant};

pub use ligament_linalg::FactorKind;
use ligament_linalg::{
    Elimination, FactorError, Factorisation, Pattern, Symbolic, SymmetricMatrix, VANISHING_PIVOT,
};
use ligament_model::Bonds;
use ligament_model::element::Remaining;

use crate::assembly;
use crate::dissection;
use crate::equilibrium::SetupError;
use crate::state::State;
use crate::unknowns::{COMPONENTS, Unknowns};

/// How the equations are solved; what is left open is chosen for the problem.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SolverSettings {
    /// Factorisation; open: L L^T where every shear stiffness is positive, L D L^T otherwise.
    pub factorisation: Option<FactorKind>,
    /// Order of elimination; open: nested dissection from [`POINTS_FOR_DISSECTION`] on, minimum degree below.
    pub ordering: Option<Ordering>,
    /// What happens to the factor when bonds break; open: it is changed in place.
    pub update: Option<Update>,
    /// Bonds broken, counted from the start, after which the factor is made anew: 0, so many, twice as many, and so on.
    ///
    /// A factor that was changed in place depends on all its changes; a run that is resumed replays those since the last
    /// time it was made anew.
    pub rebuild_every: usize,
}

/// An order of elimination.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ordering {
    /// Nested dissection of the points.
    NestedDissection,
    /// Approximate minimum degree of the unknowns.
    MinimumDegree,
}

/// What happens to the factor when bonds break.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Update {
    /// It is changed in place.
    Incremental,
    /// It is made anew.
    Refactor,
}

/// What was chosen to solve the equations of a problem.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SolverChoice {
    /// Factorisation.
    pub factorisation: FactorKind,
    /// Whether the stiffness has no symmetry, and is factorised as L U instead.
    pub unsymmetric: bool,
    /// Order of elimination.
    pub ordering: Ordering,
    /// What happens to the factor when bonds break.
    pub update: Update,
    /// Bonds broken after which the factor is made anew, see [`SolverSettings::rebuild_every`].
    pub rebuild_every: usize,
    /// Where breakages change more elements than this at once, the factor is made anew because that costs less.
    pub most_bonds_in_place: usize,
}

impl Default for SolverSettings {
    fn default() -> Self {
        Self {
            factorisation: None,
            ordering: None,
            update: None,
            rebuild_every: 1000,
        }
    }
}

/// What the equations have cost so far.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Costs {
    /// Factorisations.
    pub factorisations: usize,
    /// Changes of a factor in place.
    pub changes: usize,
    /// Solves with a factor, those after a change included.
    pub solves: usize,
    /// Time in numbering, pattern and symbolic analysis.
    pub analysis: Duration,
    /// Time in assembly.
    pub assembly: Duration,
    /// Time in factorisation.
    pub factorisation: Duration,
    /// Time in changes in place, with the forward substitution that goes along.
    pub change: Duration,
    /// Time in the backward substitutions that follow them.
    pub backward: Duration,
    /// Time in other solves.
    pub solve: Duration,
    /// Time in deformations, forces, energies and the choice of bonds.
    pub bonds: Duration,
    /// Time in the search for loose parts.
    pub connectivity: Duration,
}

/// Numbering, pattern and factor of the stiffness of the intact bonds.
pub struct Stiffness<'a> {
    system: &'a dyn Bonds,
    unknowns: Unknowns,
    pattern: Arc<Pattern>,
    symbolic: Arc<Symbolic>,
    choice: SolverChoice,
    factor: Option<Box<dyn Factorisation>>,
    /// A factor that is out of date: its memory is used again.
    stale: Option<Box<dyn Factorisation>>,
    /// Degrees of freedom that were held when the factor was made, and so are cut off from the others.
    cut_off: Vec<bool>,
    /// Whether the factor was changed since it was made.
    is_changed: bool,
    /// What the factor has of softening bonds, shape (n_bonds); empty where none softens.
    remaining: Vec<Remaining>,
    /// Elements that were lost or changed so far.
    n_changed: usize,
    pub(crate) costs: Costs,
}

impl<'a> Stiffness<'a> {
    /// Analyses the pattern for some unknowns; nothing is factorised yet.
    pub(crate) fn new(
        system: &'a dyn Bonds,
        unknowns: Unknowns,
        settings: SolverSettings,
    ) -> Result<Self, SetupError> {
        let start = Instant::now();
        let pattern = Arc::new(assembly::pattern(system, &unknowns)?);
        let ordering = settings
            .ordering
            .unwrap_or(Ordering::suited_to(system.n_points()));
        let elimination = ordering.elimination(system, &unknowns);
        let symbolic = Arc::new(Symbolic::analyse(pattern.clone(), elimination)?);
        // Without positive stiffnesses positive definiteness is not to be counted on.
        let suitable = if system.all_positive() {
            FactorKind::Llt
        } else {
            FactorKind::Ldlt
        };
        Ok(Self {
            system,
            cut_off: Vec::new(),
            pattern,
            choice: SolverChoice {
                factorisation: settings.factorisation.unwrap_or(suitable),
                unsymmetric: !system.has_energy(),
                ordering,
                update: settings.update.unwrap_or(Update::Incremental),
                rebuild_every: settings.rebuild_every.max(1),
                most_bonds_in_place: most_bonds_in_place(&symbolic),
            },
            symbolic,
            factor: None,
            stale: None,
            is_changed: false,
            remaining: Vec::new(),
            n_changed: 0,
            unknowns,
            costs: Costs {
                analysis: start.elapsed(),
                ..Costs::default()
            },
        })
    }

    /// The unknowns.
    pub fn unknowns(&self) -> &Unknowns {
        &self.unknowns
    }

    /// Structure of the factor.
    pub fn symbolic(&self) -> &Arc<Symbolic> {
        &self.symbolic
    }

    /// What was chosen to solve the equations.
    pub fn choice(&self) -> &SolverChoice {
        &self.choice
    }

    /// The structure of the factor in another order of elimination.
    pub fn analysed_with(&self, ordering: Ordering) -> Result<Symbolic, SetupError> {
        let elimination = ordering.elimination(self.system, &self.unknowns);
        Ok(Symbolic::analyse(self.pattern.clone(), elimination)?)
    }

    /// The factor, if there is one and no bond broke since.
    pub(crate) fn factor(&self) -> Option<&dyn Factorisation> {
        self.factor.as_deref()
    }

    /// Whether the factor was changed in place since it was made.
    pub(crate) fn is_changed(&self) -> bool {
        self.factor.is_some() && self.is_changed
    }

    /// Forgets the factor: the next one is made from the bonds.
    pub(crate) fn forget(&mut self) {
        self.stale = self.factor.take().or(self.stale.take());
    }

    /// Number of the unknown at a degree of freedom that the factor couples with others.
    fn number(&self, dof: usize) -> Option<usize> {
        self.unknowns.number(dof).filter(|_| !self.cut_off[dof])
    }

    /// Makes the factor for the state's bonds if there is none; gives the unknowns whose pivots vanish. Those must be held,
    /// and the factor made again.
    pub(crate) fn make(&mut self, state: &State) -> Result<Vec<usize>, FactorError> {
        if self.factor.is_some() {
            return Ok(Vec::new());
        }
        let start = Instant::now();
        let matrix = self.assemble(state);
        self.costs.assembly += start.elapsed();
        let start = Instant::now();
        let factor = match self.stale.take() {
            Some(mut stale) => stale.refactorise(&matrix).map(|()| stale),
            None => self.choice.factorisation.factorise(&self.symbolic, &matrix),
        };
        self.costs.factorisation += start.elapsed();
        self.costs.factorisations += 1;
        let vanishing = match &factor {
            Ok(factor) => vanishing_pivots(factor.as_ref(), &matrix),
            Err(
                FactorError::ZeroPivot { unknown } | FactorError::NotPositiveDefinite { unknown },
            ) => vec![*unknown],
            Err(other) => return Err(other.clone()),
        };
        if vanishing.is_empty() {
            self.factor = factor.ok();
            self.cut_off.clone_from(&state.held);
            self.remaining.clone_from(&state.softening.remaining);
            self.is_changed = false;
        }
        Ok(vanishing)
    }

    /// The matrix of the state's bonds.
    pub(crate) fn assemble(&self, state: &State) -> SymmetricMatrix {
        assembly::assemble(
            self.system,
            &self.unknowns,
            &self.pattern,
            state.bonds(),
            &state.held,
        )
    }

    /// Solves for a correction of all unknowns; the forces are given at each degree of freedom, shape (3 n_points).
    pub(crate) fn solve(&mut self, state: &State, force: impl Fn(usize) -> f64) -> Vec<f64> {
        let start = Instant::now();
        let dofs = self.unknowns.degrees_of_freedom().iter();
        let mut correction: Vec<f64> = dofs
            .map(|&dof| {
                self.number(dof as usize)
                    .map_or(0.0, |_| force(dof as usize))
            })
            .collect();
        if let Some(factor) = &mut self.factor {
            factor.solve_in_place(&mut correction);
        }
        self.keep_held(state, &mut correction);
        self.costs.solves += 1;
        self.costs.solve += start.elapsed();
        correction
    }

    /// Takes the rounding off a correction where the state is held.
    fn keep_held(&self, state: &State, correction: &mut [f64]) {
        let dofs = self.unknowns.degrees_of_freedom().iter();
        for (value, &dof) in correction.iter_mut().zip(dofs) {
            if state.held[dof as usize] {
                *value = 0.0;
            }
        }
    }

    /// Negative eigenvalues of the rotation block for the state's bonds.
    ///
    /// Holding the rigid motions of a part takes no negative eigenvalue from its stiffness (they have none), but it would
    /// from this block where it holds a rotation: so only points that lost all their bonds are held here.
    pub(crate) fn negative_rotations(&self, state: &State) -> Result<usize, SetupError> {
        let rotations = self.unknowns.rotations_only();
        if rotations.is_empty() {
            return Ok(0);
        }
        let is_alone = |dof: usize| {
            let incidence = self.system.incidence();
            let mut bonds = incidence.at((dof / COMPONENTS) as u32).iter();
            bonds.all(|&bond| !state.intact[bond as usize])
        };
        let alone: Vec<bool> = (0..state.held.len()).map(is_alone).collect();
        let pattern = Arc::new(assembly::pattern(self.system, &rotations)?);
        let block = assembly::assemble(self.system, &rotations, &pattern, state.bonds(), &alone);
        let elimination = self.choice.ordering.elimination(self.system, &rotations);
        let symbolic = Arc::new(Symbolic::analyse(pattern, elimination)?);
        let factor = FactorKind::Ldlt.factorise(&symbolic, &block)?;
        Ok(factor.inertia().negative)
    }
}

/// Number of elements up to which changing the factor costs less than making it: each of the terms of an element reads and writes
/// a part of the values of the factor.
fn most_bonds_in_place(symbolic: &Symbolic) -> usize {
    let of_one_bond = (COMPONENTS * symbolic.n_factor_values()) as f64;
    (symbolic.n_multiplications() / of_one_bond) as usize
}

/// From so many points on nested dissection leaves less fill than minimum degree (measured on disks: 20 % more
/// multiplications at 3,000 points, 3 % less at 10,000, 17 % less at 40,000).
pub const POINTS_FOR_DISSECTION: usize = 10_000;

impl Ordering {
    /// The ordering that is taken for so many points unless one is named.
    pub fn suited_to(n_points: usize) -> Self {
        if n_points < POINTS_FOR_DISSECTION {
            Self::MinimumDegree
        } else {
            Self::NestedDissection
        }
    }

    /// The order of elimination of some unknowns.
    pub fn elimination(self, system: &dyn Bonds, unknowns: &Unknowns) -> Elimination {
        match self {
            Self::MinimumDegree => Elimination::MinimumDegree,
            Self::NestedDissection => {
                Elimination::Given(dissection::elimination_order(system, unknowns))
            }
        }
    }
}

fn vanishing_pivots(factor: &dyn Factorisation, matrix: &SymmetricMatrix) -> Vec<usize> {
    let pivots = factor.pivots();
    (0..pivots.len())
        .filter(|&i| pivots[i].abs() < VANISHING_PIVOT * matrix.diagonal(i).abs())
        .collect()
}
