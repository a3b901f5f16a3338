//! Cylinders of solid with a crack over half of their section, as conjugate gradients and the factor of the matrix see them.

use std::sync::Arc;

use ligament_analysis::breakage::Breakage;
use ligament_analysis::history::{Observer, ObserverError, StepRecord, View};
use ligament_analysis::load_program::{Control, ControlKind};
use ligament_analysis::solver::Method;
use ligament_analysis::{
    Attempt, Balanced, Component, Equilibrium, Problem, ProportionalLoading, SolverSettings, State,
};
use ligament_model::law::Law;
use ligament_model::material::Isotropic;
use ligament_model::material::Space;
use ligament_model::{
    BondSet, BondStiffness, BondSystem, ElementKind, Horizons, PointCloud, System,
};

use crate::numbers::Random;

/// The material of [`cylinder`].
pub const MATERIAL: Isotropic = Isotropic {
    young: 30e9,
    poisson: 0.2,
};

/// Horizon over the spacing of the points.
const LAMBDA: f64 = 2.5;

/// Points in an upright cylinder of radius one and height two, some `across` a diameter, moved at random by up to a fifth of their spacing, with
/// NHPD's bonds.
pub fn cylinder(across: usize) -> Arc<dyn System<3>> {
    let law = |bonds: &BondSet<3>, cloud: &PointCloud<3>| {
        Law::NHPD.densities(bonds, cloud, &[MATERIAL.into()], Space::Solid)
    };
    cylinder_of(across, ElementKind::Beam, law)
}

/// The points of [`cylinder`] with other bonds.
pub fn cylinder_of(
    across: usize,
    element: ElementKind,
    law: impl Fn(&BondSet<3>, &PointCloud<3>) -> BondStiffness,
) -> Arc<dyn System<3>> {
    let spacing = 2.0 / across as f64;
    let mut random = Random(3);
    let mut positions = Vec::new();
    for k in 0..across {
        for j in 0..across {
            for i in 0..across {
                let centre = [i, j, k].map(|it| (it as f64 + 0.5) * spacing - 1.0);
                let moved = centre.map(|it| it + 0.2 * spacing * random.uniform());
                if centre[0].hypot(centre[1]) <= 1.0 {
                    positions.push(moved);
                }
            }
        }
    }
    let volumes = vec![spacing.powi(3); positions.len()];
    let materials = vec![0; positions.len()];
    let cloud = PointCloud::<3>::from_points(&positions, &volumes, 1.0, &materials, 1);
    let horizons = Horizons::unified(LAMBDA * spacing, cloud.len());
    let bonds = BondSet::<3>::search(&cloud, &horizons);
    let stiffness = law(&bonds, &cloud);
    let whole = vec![1.0; bonds.len()];
    let system = BondSystem::new(cloud, bonds, element, stiffness, whole.clone(), &whole);
    system.with_elements()
}

/// The cylinder pulled by a thousandth of its height, with its lower end held.
pub fn pulled(system: &Arc<dyn System<3>>, method: Method) -> Problem {
    let layout = system.topology().layout;
    let at_end = |lower: bool| -> Vec<u32> {
        let points = 0..system.topology().n_points() as u32;
        let z = |point: &u32| system.cloud.positions[*point as usize][2];
        let reach = 2.2 / (system.topology().n_points() as f64).cbrt();
        points
            .filter(|point| {
                if lower {
                    z(point) < reach - 1.0
                } else {
                    z(point) > 1.0 - reach
                }
            })
            .collect()
    };
    let upper = at_end(false);
    let control = Control {
        kind: ControlKind::Displacement,
        shape: vec![0.0; upper.len() * layout.components.len()],
        points: upper.clone(),
        magnitude: 2e-3,
    };
    let mut loads = ProportionalLoading::new(layout, control);
    for component in Component::IN_SPACE {
        loads.prescribe(&at_end(true), component, 0.0).unwrap();
    }
    loads.prescribe(&upper, Component::Z, 2e-3).unwrap();
    Problem {
        system: system.clone(),
        criteria: Arc::default(),
        loads: Arc::new(loads),
        solver: SolverSettings {
            method: Some(method),
            ..SolverSettings::default()
        },
        probes: Arc::default(),
        notches: Arc::default(),
        face_friction: 0.0,
        contact: Default::default(),
    }
}

struct NoObserver;

impl Observer for NoObserver {
    fn step(&mut self, _: &StepRecord, _: &View<'_>) -> Result<(), ObserverError> {
        Ok(())
    }
}

/// A cracked cylinder whose bonds break.
pub struct Torn {
    /// Solver of its equilibrium.
    pub equilibrium: Equilibrium,
    /// Displacements and bonds.
    pub state: State,
    /// What broke last.
    pub breakage: Breakage,
}

impl Torn {
    /// The problem at load factor 1, with a crack at half of the height where x is below a part of the radius.
    pub fn cracked(problem: &Problem, system: &BondSystem<3>, part: f64) -> Self {
        let mut equilibrium = Equilibrium::new(problem, 1e-4).unwrap();
        let mut state = State {
            load_factor: 1.0,
            ..State::fresh(&*problem.system)
        };
        let positions = &system.cloud.positions;
        let crosses = |bond: &u32| {
            let [a, b] = system.bonds.ends[*bond as usize].map(|end| positions[end as usize]);
            let share = a[2] / (a[2] - b[2]);
            (a[2] < 0.0) != (b[2] < 0.0) && a[0] + share * (b[0] - a[0]) < part
        };
        let crossing: Vec<u32> = (0..system.bonds.len() as u32).filter(crosses).collect();
        let breakage = equilibrium.break_bonds(&mut state, &crossing);
        Self {
            equilibrium,
            state,
            breakage,
        }
    }

    /// Equilibrium after what broke last, or why there is none.
    pub fn attempt(&mut self) -> Attempt {
        let attempt = (self.equilibrium).balance(&mut self.state, &self.breakage, &mut NoObserver);
        attempt.unwrap()
    }

    /// Equilibrium after what broke last.
    pub fn balance(&mut self) -> Balanced {
        match self.attempt() {
            Attempt::Balanced(balanced) => balanced,
            Attempt::Unbalanced(reason) => panic!("{reason}"),
        }
    }

    /// Breaks the unbroken bond that is stretched most.
    pub fn break_longest(&mut self, balanced: &Balanced) {
        let intact = &self.state.intact;
        let stretch = |bond: &usize| balanced.deformations[*bond].stretch();
        let bonds = (0..intact.len()).filter(|bond| intact[*bond]);
        let longest = bonds.reduce(|one, other| {
            if stretch(&other) > stretch(&one) {
                other
            } else {
                one
            }
        });
        let bonds = [longest.unwrap() as u32];
        self.breakage = self.equilibrium.break_bonds(&mut self.state, &bonds);
    }
}
