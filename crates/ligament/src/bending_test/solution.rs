//! Stiffness of a strip: its solution under the tractions of a stress.

use std::sync::Arc;

use ligament_analysis::driver::Problem;
use ligament_analysis::{Attempt, Bonds, Equilibrium, State};
use ligament_model::layout::{Component, Layout};

use super::facets::dot;
use super::stress::LinearStress;
use super::strip::Strip;
use super::thinnest::Section;
use crate::body::AnyBody;
use crate::model::Model;
use crate::patch_test::{SIZE, Untested, free_loading};
use crate::run::NoObserver;
use crate::setup::ELASTIC_ENERGY_TOLERANCE;

/// Ratio of the stiffness to the stiffness of the continuum from which on there is a warning.
pub const TOO_STIFF: f64 = 1.05;

/// Ratio of the stiffness to the stiffness of the continuum above which finer points do not help: a strip of one cell is three times as
/// stiff.
const MOST_CURABLE: f64 = 4.0;

/// Thickness over the horizon from which a body is not tested. With the patch correction, strips of all laws but PDS are then at most 2 %
/// too stiff in bending, and round bars 3 % in torsion.
pub const THICK: f64 = 6.0;

/// Largest number of points of a strip for which the test takes one or two seconds.
pub fn most_points(dimensions: usize) -> usize {
    match dimensions {
        2 => 20_000,
        _ => 3_000,
    }
}

/// Stiffness of a strip of a body, relative to the continuum.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BendingTest {
    /// Number of points of the strip.
    pub points: usize,
    /// Stiffness in bending across its thickness, relative to the continuum.
    pub bending: f64,
    /// Stiffness in torsion, relative to the continuum; none in the plane.
    pub torsion: Option<f64>,
}

impl BendingTest {
    /// The larger of the two relative stiffnesses.
    pub fn largest(&self) -> f64 {
        self.torsion.map_or(self.bending, |it| it.max(self.bending))
    }

    /// Factor for the distances between points with which the stiffness ratio falls to [`TOO_STIFF`], as its excess is proportional to
    /// their square; none below that ratio, or where finer points do not help.
    pub fn refinement(&self) -> Option<f64> {
        let largest = self.largest();
        let factor = ((TOO_STIFF - 1.0) / (largest - 1.0)).sqrt();
        (TOO_STIFF..=MOST_CURABLE)
            .contains(&largest)
            .then_some(factor)
    }
}

/// The bending test of the body of a model at a section, with a strip of at most `most_points` points.
///
/// # Errors
///
/// If the strip has too many points, cannot be built or has no equilibrium.
pub fn bending_test(
    model: &Model,
    section: &Section,
    most_points: usize,
) -> Result<BendingTest, Untested> {
    match model.setup.body {
        AnyBody::Plane(_) => of_strip(model, &Strip::<2>::cut(&model.setup, section)?, most_points),
        AnyBody::Solid(_) => of_strip(model, &Strip::<3>::cut(&model.setup, section)?, most_points),
    }
}

fn of_strip<const D: usize>(
    model: &Model,
    strip: &Strip<D>,
    most_points: usize,
) -> Result<BendingTest, Untested> {
    let points = strip.setup.body.n_points();
    if points > most_points {
        return Err(Untested::TooLarge { points });
    }
    let system = match strip.is_whole && model.cut_bonds() == 0 {
        true => model.system.clone(),
        false => Model::build(strip.setup.clone(), &mut ())?.system,
    };
    let mut solver = Solver::new(system.to_bonds(), strip)?;
    let bending = solver.stiffness(strip, &strip.bending())?;
    let torsion = strip.torsion();
    let torsion = torsion.map(|stress| solver.stiffness(strip, &stress));
    Ok(BendingTest {
        points,
        bending,
        torsion: torsion.transpose()?,
    })
}

/// The equations of a free strip.
struct Solver {
    layout: Layout,
    equilibrium: Equilibrium,
    state: State,
}

impl Solver {
    fn new<const D: usize>(system: Arc<dyn Bonds>, strip: &Strip<D>) -> Result<Self, Untested> {
        let layout = system.layout;
        let state = State::fresh(&*system);
        let problem = Problem {
            solver: strip.setup.solver.for_few_solutions(&*system),
            system,
            criteria: Arc::default(),
            loads: free_loading(layout, vec![0.0; layout.n_degrees_of_freedom()]),
            probes: Arc::default(),
            notches: Arc::default(),
            face_friction: 0.0,
            contact: Default::default(),
        };
        Ok(Self {
            layout,
            equilibrium: Equilibrium::new(&problem, ELASTIC_ENERGY_TOLERANCE)?,
            state,
        })
    }

    /// Stiffness of the strip under the tractions of a linear stress, relative to the continuum.
    fn stiffness<const D: usize>(
        &mut self,
        strip: &Strip<D>,
        stress: &LinearStress<D>,
    ) -> Result<f64, Untested> {
        let layout = self.layout;
        let axes = [Component::X, Component::Y, Component::Z];
        let mut force = vec![0.0; layout.n_degrees_of_freedom()];
        for (point, part) in (0..).zip(strip.forces(stress)) {
            for (component, part) in axes.into_iter().zip(part) {
                let place = layout.degree_of_freedom(point, component);
                place.into_iter().for_each(|place| force[place] += part);
            }
        }
        let classical = strip.displacement(stress).ok_or(Untested::Degenerate)?;
        // Strains as large as in the patch test.
        let size = SIZE / strip.largest_strain(stress).ok_or(Untested::Degenerate)?;
        self.equilibrium
            .load_with(free_loading(layout, force.clone()));
        self.state.load_factor = size;
        self.state.displacement.fill(0.0);
        let nothing = self.equilibrium.break_bonds(&mut self.state, &[]);
        let attempt = self
            .equilibrium
            .balance(&mut self.state, &nothing, &mut NoObserver);
        if let Attempt::Unbalanced(reason) = attempt.map_err(ligament_analysis::SetupError::from)? {
            return Err(Untested::Unbalanced(reason));
        }
        let found = |point: u32, axis: usize| {
            layout.value(point, axes[axis], &self.state.displacement) / size
        };
        let share: f64 = (0..)
            .zip(&classical)
            .map(|(point, it)| {
                (0..D)
                    .map(|axis| found(point, axis) * it[axis])
                    .sum::<f64>()
            })
            .sum();
        let whole: f64 = classical.iter().map(|it| dot(*it, *it)).sum();
        Ok(match share > 0.0 {
            true => whole / share,
            false => f64::INFINITY,
        })
    }
}
