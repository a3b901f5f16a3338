//! Points on a line with bonds of given stiffness and strength, for closed forms.

use std::sync::Arc;

use ligament_analysis::driver::event::EventSettings;
use ligament_analysis::driver::stepped::SteppedSettings;
use ligament_analysis::driver::{Outcome, Problem, StopRules, event, stepped};
use ligament_analysis::load_program::{Control, ControlKind, ProportionalLoading};
use ligament_analysis::unknowns::Component;
use ligament_analysis::{Layout, SolverSettings};
use ligament_model::contact::Faces;
use ligament_model::deformation::DeformationPool;
use ligament_model::element::ElementKind;
use ligament_model::element::Rigidities;
use ligament_model::failure::{Criteria, Criterion, Measure};
use ligament_model::subdomain::Subdomain;
use ligament_model::{BondSet, BondSystem, Horizons, PointCloud, StressAcrossPlane};

use crate::bench::Watch;

/// A bond of a truss.
#[derive(Debug, Clone, Copy)]
pub struct Rod {
    /// Its points, the smaller number first.
    pub ends: [u32; 2],
    /// Force over elongation, N/m.
    pub stiffness: f64,
    /// Elongation at which it breaks, m.
    pub critical_elongation: f64,
}

/// A truss on the x axis.
pub struct Truss {
    /// Its points and bonds.
    pub system: BondSystem,
    /// Critical stretches of the bonds.
    pub criteria: Criteria,
    /// Supports and loads.
    pub boundary: ProportionalLoading,
    /// The bond that each rod is.
    pub bond_of_rod: Vec<usize>,
}

/// Settings of the exact path with these stop rules.
pub fn settings(stop: StopRules) -> EventSettings {
    EventSettings {
        tie_tolerance: 1e-8,
        energy_tolerance: 1e-4,
        stop,
    }
}

impl Truss {
    /// Points at these places, and these rods; the force-displacement curve is that of `controlled`, along x, with a
    /// displacement of 1 m or a force of 1 N at load factor 1 that the caller prescribes.
    pub fn new(places: &[f64], rods: &[Rod], kind: ControlKind, controlled: u32) -> Self {
        let n = places.len();
        let cloud = PointCloud {
            numbering: Default::default(),
            positions: places.iter().map(|&x| [x, 0.0]).collect(),
            precision: 0.0,
            origin: [0.0; 2],
            thickness: 1.0,
            volumes: vec![1.0; n].into(),
            spacing: vec![1.0; n].into(),
            lattice_cell: None,
            n_materials: 1,
            material_shares: vec![1.0; n],
            curve: (0..n as u32).collect(),
            subdomain: Subdomain::whole(n),
        };
        let everywhere = Horizons {
            radius: vec![1e3; n],
        };
        let all = BondSet::search(&cloud, &everywhere);
        let keep: Vec<bool> = (all.ends.iter())
            .map(|ends| rods.iter().any(|rod| rod.ends == *ends))
            .collect();
        let bonds = all.retained(&keep);
        assert_eq!(bonds.len(), rods.len(), "every rod is a pair of points");
        let rod_of = |bond: usize| {
            let is_it = |rod: &&Rod| rod.ends == bonds.ends[bond];
            *rods.iter().find(is_it).unwrap()
        };
        let of_bonds = |value: &dyn Fn(usize, Rod) -> f64| -> Vec<f64> {
            (0..bonds.len())
                .map(|bond| value(bond, rod_of(bond)))
                .collect()
        };
        let length = bonds.length.clone();
        let rigidity = |bond: usize, rod: Rod| rod.stiffness * length[bond] * length[bond];
        let critical_stretch = of_bonds(&|bond, rod| rod.critical_elongation / length[bond]);
        let control = Control {
            kind,
            points: vec![controlled],
            shape: vec![1.0, 0.0, 0.0],
            magnitude: 1.0,
        };
        let plane = Layout {
            n_points: n,
            components: &Component::ALL,
        };
        Self {
            boundary: ProportionalLoading::new(plane, control),
            bond_of_rod: (rods.iter())
                .map(|rod| {
                    bonds
                        .ends
                        .iter()
                        .position(|ends| *ends == rod.ends)
                        .unwrap()
                })
                .collect(),
            system: BondSystem {
                weight: vec![1.0; bonds.len()].into(),
                rigidities: Rigidities {
                    axial: of_bonds(&rigidity),
                    shear: of_bonds(&rigidity),
                    rotational: of_bonds(&rigidity),
                    strain: Vec::new(),
                },
                element: ElementKind::Beam,
                beyond_correction: Vec::new(),
                stress_across_plane: StressAcrossPlane::Zero,
                materials: Vec::new(),
                faces: Faces::default(),
                far: None,
                volumetric: None,
                room: DeformationPool::default(),
                influence: std::sync::OnceLock::new(),
                cloud,
                bonds,
            },
            criteria: Criteria {
                list: vec![Criterion::brittle(
                    "stretch",
                    Measure::Tension,
                    critical_stretch,
                )],
            },
        }
    }

    /// Holds all motions of some points.
    pub fn hold(&mut self, points: &[u32]) {
        for component in Component::ALL {
            self.boundary.prescribe(points, component, 0.0).unwrap();
        }
    }

    /// Its problem.
    pub fn problem(&self) -> Problem {
        Problem {
            system: self.system.clone().with_elements(),
            criteria: Arc::new(self.criteria.clone()),
            loads: Arc::new(self.boundary.clone()),
            solver: SolverSettings::default(),
            probes: Arc::default(),
            notches: Arc::default(),
            face_friction: 0.0,
            contact: Default::default(),
        }
    }

    /// Follows load steps.
    pub fn step(&self, settings: &SteppedSettings) -> (Outcome, Watch) {
        let mut watch = Watch::default();
        let outcome = stepped::run(&self.problem(), settings, &mut watch);
        (outcome.unwrap(), watch)
    }

    /// Follows the exact path.
    pub fn follow(&self, stop: StopRules) -> (Outcome, Watch) {
        let mut watch = Watch {
            displacements: Some(Vec::new()),
            ..Watch::default()
        };
        let outcome = event::run(&self.problem(), &settings(stop), &mut watch);
        (outcome.unwrap(), watch)
    }
}
