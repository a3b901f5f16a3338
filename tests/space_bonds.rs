//! Bonds in space through the equations of the plane: stiffness, modes without energy, bars, heat and breakages.
//!
//! The bodies are lattices of a few hundred points, so that all eigenvalues can be computed.
#![allow(clippy::unwrap_used)]

use std::sync::Arc;

use ligament_analysis::breakage::Breakage;
use ligament_analysis::driver::event::{self, EventSettings};
use ligament_analysis::driver::{Outcome, StopRules};
use ligament_analysis::history::{BreakRecord, Observer, ObserverError, StepRecord, View};
use ligament_analysis::solver::Update;
use ligament_analysis::{
    Component, Control, ControlKind, Equilibrium, Problem, ProportionalLoading, SolverSettings,
    State, Unknowns, assembly, gauges, internal,
};
use ligament_model::contact::Faces;
use ligament_model::correction::length::length_factors;
use ligament_model::correction::{StopRule, Sweeps, domain};
use ligament_model::failure::{Criteria, Criterion, Measure};
use ligament_model::interface::StressReading;
use ligament_model::law::{Law, calibration};
use ligament_model::material::Space;
use ligament_model::tensor::{SymTensor, cross, dot, minus};
use ligament_model::thermal::{StressFreeStrains, ThermalStrain};
use ligament_model::{
    BondSet, BondSystem, Elasticity, ElementKind, Horizons, Isotropic, Plane, PointCloud, System,
    UnbrokenBonds,
};
use nalgebra::{DMatrix, DVector};

const YOUNG: f64 = 1.0;

/// Points of a cubic lattice with the spacing 1, in a box about the origin, that are inside a body.
fn lattice(sides: [i32; 3], inside: impl Fn([f64; 3]) -> bool) -> PointCloud<3> {
    let mut positions = Vec::new();
    let middle = sides.map(|side| 0.5 * f64::from(side - 1));
    for i in 0..sides[0] {
        for j in 0..sides[1] {
            for k in 0..sides[2] {
                let cell = [i, j, k].map(f64::from);
                let place = [0, 1, 2].map(|axis| cell[axis] - middle[axis]);
                if inside(place) {
                    positions.push(place);
                }
            }
        }
    }
    let n = positions.len();
    PointCloud::from_points(&positions, &vec![1.0; n], 1.0, &vec![0; n], 1)
}

fn ball() -> PointCloud<3> {
    lattice([5; 3], |p| p.iter().map(|x| x * x).sum::<f64>() < 6.5)
}

fn material(poisson: f64) -> [Isotropic; 1] {
    [Isotropic {
        young: YOUNG,
        poisson,
    }]
}

/// A body with bonds as they come from the law.
fn plain(cloud: PointCloud<3>, poisson: f64, element: ElementKind) -> Arc<dyn System<3>> {
    let bonds = BondSet::<3>::search(&cloud, &Horizons::unified(2.0, cloud.len()));
    let materials = material(poisson);
    let stiffness = match element {
        ElementKind::Beam => Law::NHPD.densities(
            &bonds,
            &cloud,
            &materials.map(Elasticity::Isotropic),
            Space::Solid,
        ),
        _ => Law::PDS.densities(
            &bonds,
            &cloud,
            &materials.map(Elasticity::Isotropic),
            Space::Solid,
        ),
    };
    let ones = vec![1.0; bonds.len()];
    BondSystem::new(cloud, bonds, element, stiffness, ones.clone(), &ones).with_elements()
}

/// The stiffness of all degrees of freedom, dense, from the blocks.
fn dense(system: &dyn System<3>, bonds: UnbrokenBonds<'_>) -> DMatrix<f64> {
    let unknowns = Unknowns::all_but(system, |_| false);
    let pattern = Arc::new(assembly::pattern(system, &unknowns).unwrap());
    let held = vec![false; system.topology().layout.n_degrees_of_freedom()];
    let matrix = assembly::assemble(system, &unknowns, &pattern, bonds, &held);
    let n = pattern.dimension();
    let mut full = DMatrix::zeros(n, n);
    for column in 0..n {
        for place in pattern.column_starts()[column]..pattern.column_starts()[column + 1] {
            let row = pattern.rows()[place];
            full[(row, column)] = matrix.values[place];
            full[(column, row)] = matrix.values[place];
        }
    }
    full
}

/// Negative and vanishing eigenvalues, to rounding of the largest.
fn counts(matrix: DMatrix<f64>) -> [usize; 2] {
    let values = matrix.symmetric_eigenvalues();
    let zero = 1e-11 * values.amax();
    let negative = values.iter().filter(|it| **it < -zero).count();
    let vanishing = values.iter().filter(|it| it.abs() <= zero).count();
    [negative, vanishing]
}

/// A free body of micropolar bonds has six motions without energy and no negative ones up to a quarter, one negative a rotation of a point
/// above, and more from where it loses its stability; springs resist rotations, with a negative stiffness above a quarter.
#[test]
fn free_bodies_have_six_motions_without_energy() {
    let n = ball().len();
    let of = |poisson, element| {
        let system = plain(ball(), poisson, element);
        counts(dense(
            &*system,
            UnbrokenBonds::whole(&vec![true; system.bonds.len()]),
        ))
    };
    assert_eq!(of(0.2, ElementKind::Beam), [0, 6]);
    assert_eq!(of(0.27, ElementKind::Beam), [3 * n, 6]);
    let [unstable, _] = of(0.36, ElementKind::Beam);
    assert!(unstable > 3 * n, "{unstable} of {n} points");
    assert_eq!(of(0.2, ElementKind::Spring), [0, 3]);
    let [negative, vanishing] = of(0.3, ElementKind::Spring);
    assert!(negative >= 3 && vanishing == 3, "{negative}");
}

/// The inertia that an analysis compares: of the whole stiffness, and of the rotations of the points alone.
#[test]
fn the_check_of_stability_expects_a_negative_eigenvalue_a_rotation() {
    let of = |poisson: f64| {
        let system = plain(ball(), poisson, ElementKind::Beam);
        let mut loads = pulled(&*system, 0.01);
        let points = [0, 3, system.cloud.len() as u32 - 1];
        for (point, component) in points
            .iter()
            .zip([Component::X, Component::Y, Component::Z])
        {
            loads.prescribe(&[*point], component, 0.0).unwrap();
        }
        let problem = problem(
            system,
            loads,
            Criteria::default(),
            SolverSettings::default(),
        );
        let mut state = State::fresh(&*problem.system);
        let mut equilibrium = Equilibrium::new(&problem, 1e-4).unwrap();
        let nothing = equilibrium.break_bonds(&mut state, &[]);
        state.load_factor = 1.0;
        let balanced = equilibrium
            .balance(&mut state, &nothing, &mut Quiet)
            .unwrap();
        assert!(balanced.balanced().is_some());
        equilibrium.stability(&state).unwrap().unwrap()
    };
    let stable = of(0.2);
    assert_eq!((stable.negative, stable.expected), (0, 0));
    let beyond = of(0.27);
    let rotations = 3 * ball().len();
    assert_eq!((beyond.negative, beyond.expected), (rotations, rotations));
}

/// Products without a matrix, forces and energies are those of the assembled stiffness; and what a breakage takes away in terms of rank one
/// is the difference between the stiffness with the bonds and without.
#[test]
fn all_ways_to_the_stiffness_agree() {
    for element in [ElementKind::Beam, ElementKind::Spring] {
        let system = plain(ball(), 0.2, element);
        let mut intact = vec![true; system.bonds.len()];
        let whole = dense(&*system, UnbrokenBonds::whole(&intact));
        let n = whole.nrows();
        let u: Vec<f64> = (0..n)
            .map(|k| ((k * k * 7 + 3 * k) % 101) as f64 - 50.0)
            .collect();
        let expected = &whole * DVector::from_vec(u.clone());
        let close = |found: &[f64]| {
            let off = found
                .iter()
                .zip(expected.iter())
                .map(|(a, b)| (a - b).abs());
            off.fold(0.0, f64::max) / expected.amax()
        };
        let left = UnbrokenBonds::whole(&intact);
        let mut product = vec![0.0; n];
        system.multiply(left, &u, &mut product);
        assert!(close(&product) < 1e-14);
        let sweep = internal::sweep(&*system, left, &u, ThermalStrain::NONE);
        assert!(close(&sweep.internal.values) < 1e-14);
        let energy = 0.5 * expected.dot(&DVector::from_vec(u.clone()));
        assert!((sweep.stored_energy / energy - 1.0).abs() < 1e-12);
        let densities: f64 = (0..system.cloud.len() as u32)
            .map(|point| system.energy_density(left, &sweep.deformations, point))
            .sum();
        assert!((densities / energy - 1.0).abs() < 1e-12);

        let broken = [3, 77, 140];
        let changed = system.changed(left, &u, ThermalStrain::NONE, &broken);
        let terms = changed.lost_terms();
        assert_eq!(
            terms.len(),
            broken.len() * system.topology().layout.components.len()
        );
        let mut without = whole.clone();
        for (rigidity, entries) in &terms {
            for (row, one) in entries {
                for (column, other) in entries {
                    without[(*row, *column)] -= rigidity * one * other;
                }
            }
        }
        broken
            .iter()
            .for_each(|&bond| intact[bond as usize] = false);
        let assembled = dense(&*system, UnbrokenBonds::whole(&intact));
        assert!((&without - &assembled).amax() < 1e-14 * whole.amax());
        assert!((&whole - &assembled).amax() > 1e-3 * whole.amax());
        let lost = &whole - &assembled;
        let released =
            0.5 * (&lost * DVector::from_vec(u.clone())).dot(&DVector::from_vec(u.clone()));
        let found = changed.released(&u, ThermalStrain::NONE);
        assert!((found / released - 1.0).abs() < 1e-12);
    }
}

struct Quiet;

impl Observer for Quiet {
    fn step(&mut self, _: &StepRecord, _: &View<'_>) -> Result<(), ObserverError> {
        Ok(())
    }
}

/// The breakages of a run.
#[derive(Default)]
struct Broken(Vec<(u32, f64)>);

impl Observer for Broken {
    fn step(&mut self, _: &StepRecord, _: &View<'_>) -> Result<(), ObserverError> {
        Ok(())
    }

    fn broke(&mut self, records: &[BreakRecord]) -> Result<(), ObserverError> {
        self.0
            .extend(records.iter().map(|it| (it.bond, it.load_factor)));
        Ok(())
    }
}

/// Loads that move the last layer along z by a distance, with the first one held along it.
fn pulled(system: &dyn System<3>, distance: f64) -> ProportionalLoading {
    let positions = &system.cloud.positions;
    let highest = positions.iter().map(|p| p[2]).fold(0.0, f64::max);
    let layer = |height: f64| -> Vec<u32> {
        let at = positions.iter().map(|p| p[2] == height);
        (0..)
            .zip(at)
            .filter(|(_, at)| *at)
            .map(|(point, _)| point)
            .collect()
    };
    let (top, bottom) = (layer(highest), layer(-highest));
    let layout = system.topology().layout;
    let n_components = layout.components.len();
    let mut shape = vec![0.0; top.len() * n_components];
    for at_point in shape.chunks_mut(n_components) {
        at_point[2] = 1.0;
    }
    let control = Control {
        kind: ControlKind::Displacement,
        points: top.clone(),
        shape,
        magnitude: distance,
    };
    let mut loads = ProportionalLoading::new(layout, control);
    loads.prescribe(&top, Component::Z, distance).unwrap();
    loads.prescribe(&bottom, Component::Z, 0.0).unwrap();
    loads
}

fn problem(
    system: Arc<dyn System<3>>,
    loads: ProportionalLoading,
    criteria: Criteria,
    solver: SolverSettings,
) -> Problem {
    Problem {
        system,
        criteria: Arc::new(criteria),
        loads: Arc::new(loads),
        solver,
        probes: Arc::new([]),
        notches: Arc::default(),
        face_friction: 0.0,
        contact: Default::default(),
    }
}

/// State and force of the load at load factor 1.
fn solved(problem: &Problem) -> (State, f64) {
    let mut state = State::fresh(&*problem.system);
    let mut equilibrium = Equilibrium::new(problem, 1e-4).unwrap();
    let nothing: Breakage = equilibrium.break_bonds(&mut state, &[]);
    state.load_factor = 1.0;
    let attempt = equilibrium
        .balance(&mut state, &nothing, &mut Quiet)
        .unwrap();
    let balanced = attempt.balanced().unwrap();
    let force = problem.loads.control_force(1.0, &balanced.internal);
    (state, force)
}

/// A bar of 5 x 5 x 15 cells with energies that are right along the axes at every point: E within 2 %, and the contraction that of the
/// material within .03. Its strain is that of the distance of its outer layers, and its energy E eps^2 V/2 that of all of its cells.
#[test]
fn a_bar_has_the_modulus_of_its_material() {
    let cloud = lattice([5, 5, 15], |_| true);
    let bonds = BondSet::<3>::search(&cloud, &Horizons::unified(2.5, cloud.len()));
    let materials = material(0.2);
    let stiffness = Law::NHPD.densities(
        &bonds,
        &cloud,
        &materials.map(Elasticity::Isotropic),
        Space::Solid,
    );
    let alpha = length_factors(&bonds, &cloud);
    let sweeps = Sweeps {
        stop: StopRule::Mean(1e-7),
        limit: 500,
    };
    let continuum = materials.map(|it| Elasticity::Isotropic(it).stiffness::<3>(Plane::Strain));
    let continuum = continuum.map(Option::unwrap);
    let correction = domain::iterate(&bonds, &cloud, &stiffness, alpha, &continuum, sweeps);
    let ratios = domain::energy_ratios(&bonds, &cloud, &stiffness, &correction, &continuum);
    let along = ratios[..3].iter().flat_map(|it| &it.at_points);
    let off = along.map(|it| (it - 1.0).abs());
    assert!(off.fold(0.0, f64::max) < 1e-4);
    let omega = &correction.domain_factor;
    let alpha = correction.length_factor.clone();
    let system =
        BondSystem::new(cloud, bonds, ElementKind::Beam, stiffness, alpha, omega).with_elements();
    let positions = system.cloud.positions.clone();
    let volume: f64 = system.cloud.volumes.iter().sum();
    let problem = problem(
        system.clone(),
        pulled(&*system, 0.01),
        Criteria::default(),
        SolverSettings::default(),
    );
    // Bodies that nothing holds sideways and against turning get gauges.
    let free = gauges::of_intact_body(&*system, &*problem.loads);
    assert_eq!((free.len(), free[0].gauges.len()), (1, 3));
    assert!(free[0].is_balanced());
    let (state, force) = solved(&problem);
    let modulus = force * 0.01 / (volume * (0.01_f64 / 14.0).powi(2));
    assert!((modulus / YOUNG - 1.0).abs() < 0.02, "{modulus}");
    // Width of the layer in the middle.
    let layout = system.topology().layout;
    let at = |place: [f64; 3]| -> f64 {
        let point = positions.iter().position(|p| *p == place).unwrap() as u32;
        layout.value(point, Component::X, &state.displacement)
    };
    let contraction = (at([-2.0, 0.0, 0.0]) - at([2.0, 0.0, 0.0])) / 4.0 / (0.01 / 14.0);
    assert!((contraction - 0.2).abs() < 0.03, "{contraction}");
    // The mean stress of any body in equilibrium is exact: sigma_zz V = F times the length.
    let sweep = internal::sweep(
        &*system,
        state.bonds(),
        &state.displacement,
        ThermalStrain::NONE,
    );
    let stresses = system.stresses(StressReading::Virial, state.bonds(), &sweep.deformations);
    assert_eq!(stresses.names, ["xx", "yy", "xy", "zz", "xz", "yz"]);
    let mean = |place: usize| {
        let of_points = stresses.values.chunks(6).map(|it| it[place]);
        of_points.sum::<f64>() / volume
    };
    assert!((mean(3) * volume / (force * 14.0) - 1.0).abs() < 1e-9);
    assert!(
        [0, 1, 2, 4, 5]
            .iter()
            .all(|&it| mean(it).abs() < 1e-9 * mean(3))
    );
    // Tractions share out the same forces, so that their symmetric part has the same mean.
    let tractions = system.stresses(StressReading::Traction, state.bonds(), &sweep.deformations);
    let names = ["xx", "yx", "zx", "yy", "xy", "zy", "zz", "xz", "yz"];
    assert_eq!(tractions.names, names);
    let of_traction = |name: &str| {
        let place = names.iter().position(|it| *it == name).unwrap();
        let of_points = tractions.values.chunks(9).map(|it| it[place]);
        of_points.sum::<f64>() / volume
    };
    for (place, name) in stresses.names.iter().enumerate() {
        let turned: String = name.chars().rev().collect();
        let off = 0.5 * (of_traction(name) + of_traction(&turned)) - mean(place);
        // Rounding of sums over some ten thousand bonds.
        assert!(off.abs() < 1e-12 * mean(3), "{name}: {off:e}");
    }
    // And so is the force through its middle, between two layers.
    let crossing: Vec<(u32, bool)> = (0..)
        .zip(&*system.bonds.ends)
        .filter_map(|(bond, ends)| {
            let [a, b] = ends.map(|end| positions[end as usize][2] < 0.5);
            (a != b).then_some((bond, a))
        })
        .collect();
    let through =
        |component| system.force_through(state.bonds(), &sweep.deformations, &crossing, component);
    assert!((through(Component::Z) / force - 1.0).abs() < 1e-9);
    assert!(through(Component::X).abs() < 1e-9 * force);
}

/// Discrete sums in place of the integrals make a hydrostatic strain right inside, whatever the lattice.
#[test]
fn sums_over_families_make_the_bulk_modulus_right() {
    let cloud = lattice([11; 3], |_| true);
    let bonds = BondSet::<3>::search(&cloud, &Horizons::unified(2.0, cloud.len()));
    let materials = material(0.2);
    let stiffness = Law::NHPD.densities(
        &bonds,
        &cloud,
        &materials.map(Elasticity::Isotropic),
        Space::Solid,
    );
    let ones = vec![1.0; bonds.len()];
    let stiffness =
        calibration::calibrated(stiffness, &ones, &bonds, &cloud, &materials, Space::Solid);
    let system = BondSystem::new(
        cloud,
        bonds,
        ElementKind::Beam,
        stiffness,
        ones.clone(),
        &ones,
    )
    .with_elements();
    let components = system.topology().layout.components.len();
    let swollen: Vec<f64> = (system.cloud.positions.iter())
        .flat_map(|p| (0..components).map(move |place| p.get(place).map_or(0.0, |x| 1e-3 * x)))
        .collect();
    let intact = vec![true; system.bonds.len()];
    let left = UnbrokenBonds::whole(&intact);
    let sweep = internal::sweep(&*system, left, &swollen, ThermalStrain::NONE);
    let middle = system.cloud.nearest_point([0.0; 3]);
    let energy = system.energy_density(left, &sweep.deformations, middle);
    let expected = 4.5 * materials[0].bulk_modulus() * 1e-6;
    assert!((energy / expected - 1.0).abs() < 1e-12);
}

/// A body with a temperature that is free to grow does: no energy, no stress, and the displacements of the strain; held at both ends it
/// presses on them.
#[test]
fn heat_makes_a_free_body_grow() {
    let system = plain(lattice([4, 4, 6], |_| true), 0.2, ElementKind::Beam);
    let n = system.cloud.len();
    let strains = StressFreeStrains::new(vec![SymTensor::<3>::isotropic(1e-3); n]);
    let mut loads = pulled(&*system, 5e-3);
    loads.thermal_strain = strains.clone();
    let held = ProportionalLoading {
        thermal_strain: strains,
        ..pulled(&*system, 0.0)
    };
    let (state, force) = solved(&problem(
        system.clone(),
        loads,
        Criteria::default(),
        SolverSettings::default(),
    ));
    // The ends were moved by just what the strain makes of five cells.
    let (_, pressed) = solved(&problem(
        system.clone(),
        held,
        Criteria::default(),
        SolverSettings::default(),
    ));
    assert!(
        pressed < 0.0 && force.abs() < 1e-9 * pressed.abs(),
        "{force:e} {pressed:e}"
    );
    let layout = system.topology().layout;
    let reach = |component: Component, axis: usize| {
        let moved = (0..)
            .zip(&system.cloud.positions)
            .map(|(point, p)| (p[axis], layout.value(point, component, &state.displacement)));
        moved.fold([0.0_f64; 2], |[low, high], (place, u)| match place {
            -1.5 => [u, high],
            1.5 => [low, u],
            _ => [low, high],
        })
    };
    for (component, axis) in [(Component::X, 0), (Component::Y, 1)] {
        let [low, high] = reach(component, axis);
        assert!((high - low - 3e-3).abs() < 1e-9, "{low:e} {high:e}");
    }
}

/// Bonds that break one after another along the exact path: the factor that is changed by six terms a bond finds the same path as one that
/// is made anew after every breakage.
#[test]
fn breakages_in_place_are_those_of_a_new_factor() {
    let run = |update: Update| -> (Outcome, Vec<(u32, f64)>) {
        let system = plain(lattice([3, 3, 6], |_| true), 0.2, ElementKind::Beam);
        // Limits that differ a little from bond to bond, so that one breaks after another.
        let limit = (0..system.bonds.len()).map(|bond| 1.0 + 1e-3 * ((bond * 37) % 101) as f64);
        let criteria = Criteria {
            list: vec![Criterion::brittle("", Measure::Tension, limit.collect())],
        };
        let loads = pulled(&*system, 100.0);
        let solver = SolverSettings {
            update: Some(update),
            ..SolverSettings::default()
        };
        let settings = EventSettings {
            tie_tolerance: 1e-8,
            energy_tolerance: 1e-4,
            stop: StopRules {
                bonds: Some(40),
                ..StopRules::NONE
            },
        };
        let mut broken = Broken::default();
        let problem = problem(system, loads, criteria, solver);
        let outcome = event::run(&problem, &settings, &mut broken).unwrap();
        (outcome, broken.0)
    };
    let (in_place, broken) = run(Update::Incremental);
    let (anew, its_broken) = run(Update::Refactor);
    assert!(in_place.costs.changes > 10, "{:?}", in_place.costs);
    assert_eq!(anew.costs.changes, 0);
    assert!(broken.len() >= 20, "{} bonds", broken.len());
    assert_eq!(broken.len(), its_broken.len());
    for (one, other) in broken.iter().zip(&its_broken) {
        assert_eq!(one.0, other.0);
        assert!((one.1 / other.1 - 1.0).abs() < 1e-9);
    }
    let energies = |it: &Outcome| {
        let last = it.history.last().unwrap();
        (last.stored_energy, last.external_work, last.released_energy)
    };
    let (stored, work, released) = energies(&in_place);
    assert!(((stored + released) / work - 1.0).abs() < 1e-9);
}

/// The gap of two points across a crack does not see that the body moves and turns as a whole; a uniform strain opens it by l n . eps e, and
/// closes it by as much where it is the strain of a temperature.
#[test]
fn gaps_in_space_are_those_of_the_faces() {
    let cloud = lattice([4, 4, 4], |_| true);
    let bonds = BondSet::<3>::search(&cloud, &Horizons::unified(2.0, cloud.len()));
    let materials = material(0.2);
    let stiffness = Law::NHPD.densities(
        &bonds,
        &cloud,
        &materials.map(Elasticity::Isotropic),
        Space::Solid,
    );
    let ones = vec![1.0; bonds.len()];
    let faces = Faces::closing(Vec::new(), &bonds);
    let element = ElementKind::Beam;
    let system = BondSystem::new(cloud, bonds, element, stiffness, ones.clone(), &ones);
    let system = system.with_faces(faces).with_elements();
    let positions = &system.cloud.positions;
    let is_upper = |end: u32| positions[end as usize][2] > 0.0;
    let is_parted = |ends: &[u32; 2]| is_upper(ends[0]) != is_upper(ends[1]);
    let intact: Vec<bool> = system.bonds.ends.iter().map(|it| !is_parted(it)).collect();
    let pairs = system.contact_pairs(&intact);
    assert!(pairs.len() > 16, "{}", pairs.len());
    let motions = |of_point: &dyn Fn([f64; 3]) -> [f64; 6]| -> Vec<f64> {
        positions.iter().flat_map(|p| of_point(*p)).collect()
    };
    let turn = [0.3, -0.2, 0.5];
    let [a, b, c] = turn;
    let rigid = motions(&|place| {
        let [x, y, z] = cross(turn, place);
        [1.0 + x, y - 2.0, z + 0.5, a, b, c]
    });
    let strain = SymTensor::<3>::from_components(&[0.1, -0.2, 0.3, 0.4, -0.5, 0.6]);
    let strained = motions(&|place| {
        let [x, y, z] = strain.times(place);
        [x, y, z, 0.0, 0.0, 0.0]
    });
    let thermal = StressFreeStrains::new(vec![strain; positions.len()]);
    for pair in pairs {
        let [from, to] = pair.ends.map(|end| positions[end as usize]);
        let opened = dot(pair.normal, strain.times(minus(to, from)));
        let [at_rest, open] = [&rigid, &strained].map(|it| pair.gap(it, ThermalStrain::NONE));
        let grown = pair.growth(thermal.times(1.0));
        // Rounding of a few products of numbers up to 3.
        for (found, expected) in [(at_rest, 0.0), (open, opened), (grown, opened)] {
            assert!((found - expected).abs() < 1e-14, "{found} for {expected}");
        }
        assert!(pair.stiffness > 0.0 && pair.normal[2].abs() > 0.9);
    }
}
