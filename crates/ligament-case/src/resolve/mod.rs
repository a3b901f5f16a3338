//! From a case and its body to the typed settings of the libraries.
//!
//! Names are looked up in the body here; what is not there is reported at its place in the case file.

mod boundary;
mod loading;
mod modal;
mod places;
mod temperature;

use ligament_analysis::Component;
use ligament_analysis::breaking::{BreakingOrder, BreakingRule};
use ligament_analysis::driver::StopRules;
use ligament_analysis::driver::event::EventSettings;
use ligament_analysis::driver::stepped::SteppedSettings;
use ligament_analysis::probe::{PointField, Probe, Reading, StressComponent};
use ligament_analysis::solver::{FactorKind, Ordering, SolverSettings, Update};
use ligament_model::bonds::precrack::{self, Ends, PreCrack};
use ligament_model::correction::{StopRule, Sweeps};
use ligament_model::failure::Weakened;
use ligament_model::{BondSystem, Horizons, Material, Plane, PointCloud};
use rayon::{ThreadPoolBuildError, ThreadPoolBuilder};

use crate::case::{self, BreakOrder, CaseFile, CorrectionRule, Iteration, Stepping, Steps};

pub use loading::Loading;
pub use modal::{Vibration, modal};
pub use places::{material_of_cell, no_fail};

/// State of the plane.
pub fn plane(case: &CaseFile) -> Plane {
    match case.case.body.plane() {
        case::Plane::Stress => Plane::Stress,
        case::Plane::Strain => Plane::Strain,
    }
}

/// The materials, in the order of the case file.
pub fn materials(case: &CaseFile) -> Vec<Material> {
    case.case.materials.iter().map(Into::into).collect()
}

/// The horizons: lambda times the distance to the nearest point, or the same for all.
pub fn horizons(case: &CaseFile, cloud: &PointCloud) -> Horizons {
    let model = &case.case.model;
    match (model.horizon_factor, model.horizon) {
        (Some(factor), _) => Horizons::from_spacing(&cloud.spacing, factor),
        (None, horizon) => Horizons::unified(horizon.unwrap_or_default(), cloud.len()),
    }
}

/// The horizon of points at this distance from their neighbours, m.
pub fn horizon(case: &CaseFile, spacing: f64) -> f64 {
    let model = &case.case.model;
    match model.horizon_factor {
        Some(factor) => factor * spacing,
        None => model.horizon.unwrap_or_default(),
    }
}

/// Models with more bonds than this take the size-independent stop rule unless told otherwise.
const LARGE_MODEL: usize = 1_000_000;

/// Stop rule and limit of the domain correction for a model of so many bonds.
pub fn sweeps(correction: &Iteration, n_bonds: usize) -> Sweeps {
    let rule = match correction.rule {
        CorrectionRule::Auto if n_bonds > LARGE_MODEL => CorrectionRule::Mean,
        CorrectionRule::Auto => CorrectionRule::Sum,
        rule => rule,
    };
    let tolerance = correction
        .tolerance
        .or(rule.default_tolerance())
        .unwrap_or_default();
    let stop = if rule == CorrectionRule::Mean {
        StopRule::Mean(tolerance)
    } else {
        StopRule::Sum(tolerance)
    };
    Sweeps {
        stop,
        limit: correction.max_sweeps as usize,
    }
}

/// The pre-cracks.
pub fn precracks(case: &CaseFile) -> Vec<PreCrack> {
    case.case
        .precracks
        .iter()
        .map(|crack| PreCrack {
            points: crack.points(),
            ends: match crack.ends {
                case::Ends::Excluded => Ends::Excluded,
                case::Ends::Included => Ends::Included,
            },
        })
        .collect()
}

/// How to step, for a case with load steps.
pub fn stepped(fracture: &case::Fracture, stepping: &Stepping) -> SteppedSettings {
    let load_factors = match &stepping.steps {
        Steps::Uniform(count) => (1..=*count)
            .map(|step| f64::from(step) / f64::from(*count))
            .collect(),
        Steps::Factors(factors) => factors.clone(),
    };
    SteppedSettings {
        load_factors,
        refine_first_break: stepping.refine_first_break as usize,
        rule: BreakingRule {
            order: match stepping.order {
                BreakOrder::Excess => BreakingOrder::Excess,
                BreakOrder::Ratio => BreakingOrder::Ratio,
            },
            bonds_per_iteration: stepping.bonds_per_iteration as usize,
            tie_tolerance: fracture.tie_tolerance,
        },
        energy_tolerance: fracture.energy_tolerance,
        round_limit: stepping.max_iterations as usize,
        stop: stop_rules(&fracture.stop),
    }
}

/// How to follow the exact path.
pub fn event(fracture: &case::Fracture) -> EventSettings {
    EventSettings {
        tie_tolerance: fracture.tie_tolerance,
        energy_tolerance: fracture.energy_tolerance,
        stop: stop_rules(&fracture.stop),
    }
}

fn stop_rules(stop: &case::Stop) -> StopRules {
    StopRules {
        load_fraction: stop.load_fraction,
        displacement: stop.displacement,
        bonds: stop.bonds.map(|bonds| bonds as usize),
        wall_time: stop.wall_time,
        negative_energy: stop.negative_energy,
    }
}

/// How the equations are solved.
pub fn solver(case: &CaseFile) -> SolverSettings {
    let chosen = &case.case.solver;
    let default = SolverSettings::default();
    SolverSettings {
        factorisation: match chosen.factorisation {
            case::Factorisation::Auto => None,
            case::Factorisation::Llt => Some(FactorKind::Llt),
            case::Factorisation::Ldlt => Some(FactorKind::Ldlt),
        },
        ordering: match chosen.ordering {
            case::Ordering::Auto => None,
            case::Ordering::NestedDissection => Some(Ordering::NestedDissection),
            case::Ordering::MinimumDegree => Some(Ordering::MinimumDegree),
        },
        update: match chosen.update {
            case::Update::Auto => None,
            case::Update::Incremental => Some(Update::Incremental),
            case::Update::Refactor => Some(Update::Refactor),
        },
        rebuild_every: chosen
            .rebuild_every
            .map_or(default.rebuild_every, |bonds| bonds as usize),
    }
}

/// Does some work on as many threads as a case asks for: on those of the program unless it gives a number.
pub fn on_threads<T: Send>(
    case: &CaseFile,
    work: impl FnOnce() -> T + Send,
) -> Result<T, ThreadPoolBuildError> {
    match case.case.solver.threads {
        None => Ok(work()),
        Some(count) => {
            let pool = ThreadPoolBuilder::new().num_threads(count as usize);
            Ok(pool.build()?.install(work))
        }
    }
}

/// The probes.
fn probes(case: &CaseFile, system: &BondSystem) -> Vec<Probe> {
    let nearest = |position: [f64; 2]| system.cloud.nearest_point(position);
    let probe = |probe: &case::Probe| Probe {
        name: probe.name.clone(),
        reading: reading(system, nearest, probe.reading),
    };
    case.case.probes.iter().map(probe).collect()
}

fn reading(
    system: &BondSystem,
    nearest: impl Fn([f64; 2]) -> u32,
    reading: case::Reading,
) -> Reading {
    match reading {
        case::Reading::Between { between, component } => {
            let component = match component {
                case::Component::X => Component::X,
                case::Component::Y => Component::Y,
                case::Component::Rotation => Component::Rotation,
            };
            Reading::RelativeDisplacement {
                points: between.map(nearest),
                component,
            }
        }
        case::Reading::At { at, field } => Reading::Field {
            point: nearest(at),
            field: match field {
                case::Field::Damage => PointField::Damage,
                case::Field::DamageTension => PointField::DamageBy(Weakened::Opening),
                case::Field::DamageCompression => PointField::DamageBy(Weakened::Crushing),
                case::Field::DamageSliding => PointField::DamageBy(Weakened::Sliding),
                case::Field::DisplacementX => PointField::Motion(Component::X),
                case::Field::DisplacementY => PointField::Motion(Component::Y),
                case::Field::Rotation => PointField::Motion(Component::Rotation),
                case::Field::StrainEnergyDensity => PointField::StrainEnergyDensity,
                case::Field::StressXx => PointField::Stress(StressComponent::Xx),
                case::Field::StressYy => PointField::Stress(StressComponent::Yy),
                case::Field::StressXy => PointField::Stress(StressComponent::Xy),
            },
        },
        case::Reading::Section {
            section: [start, end],
            component,
        } => {
            let component = match component {
                case::Axis::X => Component::X,
                case::Axis::Y => Component::Y,
            };
            let (bonds, cloud) = (&system.bonds, &system.cloud);
            Reading::SectionForce {
                bonds: precrack::crossing_bonds(bonds, cloud, start, end),
                component,
            }
        }
    }
}
