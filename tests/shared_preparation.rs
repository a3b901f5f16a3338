//! Bodies whose bonds are shared out among several ranks, against the same body in one process: who knows which bonds, with what stiffness
//! and limits, and what is counted of them. The ranks are threads.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use std::sync::Arc;

use ligament::Model;
use ligament::SetupError;
use ligament::body::SolidMeshBody;
use ligament::prelude::*;
use ligament::system::AnySystem;
use ligament_analysis::distributed_matrix::Processes;
use ligament_case::case::CaseFile;
use ligament_mesh::{SolidCell, SolidMesh};
use ligament_model::correction::CorrectionReport;
use ligament_model::subdomain::Subdomain;
use ligament_model::{ConstantFields, Tags};
use ligament_run::memory::check_model_memory;
use verification::bench::case;
use verification::problems::{BAR, TWO};
use verification::repository;
use verification::threads_as_ranks::on_ranks;

/// What numbers of bonds may differ by, relative to those of one process.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Accuracy {
    /// Sums at a point are made in the order of its bonds wherever they are made.
    Bits,
    /// Sums over all points are made by each rank and added up, and a Newton step is solved to a tenth: rounding grows in its directions.
    Newton,
}

impl Accuracy {
    fn holds(self, one: &[f64], other: &[f64]) -> bool {
        match self {
            Self::Bits => one == other,
            Self::Newton => one.len() == other.len() && farthest(one, other) < 1e-9,
        }
    }
}

/// Largest relative difference of two lists.
fn farthest(one: &[f64], other: &[f64]) -> f64 {
    let pairs = one.iter().zip(other).filter(|(one, other)| one != other);
    let off = pairs.map(|(one, other)| (one - other).abs() / one.abs().max(other.abs()));
    off.fold(0.0, f64::max)
}

/// The entries of a list of numbers at some places.
fn at(places: &[usize], values: &[f64]) -> Vec<f64> {
    if values.is_empty() {
        return Vec::new();
    }
    places.iter().map(|&place| values[place]).collect()
}

/// Lists of numbers of the bonds, each with a name.
fn of_bonds(model: &Model) -> Vec<(&'static str, Vec<f64>)> {
    let system = &model.system;
    let rigidities = match system {
        AnySystem::Plane(system) => &system.rigidities,
        AnySystem::Solid(system) => &system.rigidities,
    };
    let mut lists = vec![
        ("axial", rigidities.axial.clone()),
        ("shear", rigidities.shear.clone()),
        ("rotational", rigidities.rotational.clone()),
        ("horizon", system.horizons.to_vec()),
        ("weight", system.weights.to_vec()),
        ("Omega", model.fixed.domain_factor.clone()),
        ("shear ratio", model.fixed.shear_ratio.clone()),
    ];
    for criterion in &model.criteria.list {
        lists.push(("limit", criterion.limit.to_vec()));
        lists.push(("coefficient", criterion.coefficient.to_vec()));
    }
    lists
}

/// What the first process of several tells in the end, and what all must agree about.
fn of_points(fixed: &ConstantFields) -> Vec<(&'static str, Vec<f64>)> {
    let ratios = fixed.energy_ratios.iter();
    let ratios = ratios.map(|it| (it.field, it.at_points.clone()));
    let others = [
        ("precrack share", fixed.precrack_share.clone()),
        ("patch residual", fixed.patch_residual.clone()),
    ];
    others.into_iter().chain(ratios).collect()
}

/// Whether this rank owns a point with a number in the body.
fn is_owned_by(subdomain: &Subdomain, number: u32) -> bool {
    subdomain.point(number).is_some_and(|it| subdomain.owns(it))
}

/// Shares a body out among 1, 2 and 3 ranks and compares with one process.
fn shared(name: &str, setup: &Setup, accuracy: Accuracy) -> Model {
    let whole = Model::build(setup.clone(), &mut ()).unwrap();
    let (ends, lists) = (&whole.system.ends, of_bonds(&whole));
    for n_ranks in 1..=3 {
        let known = on_ranks(n_ranks, |together| {
            let mut setup = setup.clone();
            setup.solver.communicator = Processes(together.clone());
            let model = Model::build(setup, &mut ()).unwrap();
            let subdomain = &model.system.subdomain;
            // Bonds, and pairs that are none, are known to the ranks of their ends and to no others, in the same order.
            let here = |ends: [u32; 2]| {
                let [a, b] = ends.map(|end| subdomain.point(end));
                let ends = [a?, b?];
                subdomain.contains_bond(ends).then_some(ends)
            };
            let is_known = |ends: &[u32; 2]| here(*ends).is_some();
            let places: Vec<usize> = (0..ends.len()).filter(|&it| is_known(&ends[it])).collect();
            let expected: Vec<[u32; 2]> = ends.iter().filter_map(|&it| here(it)).collect();
            assert_eq!(*model.system.ends, expected);
            let is_owned = |ends: &[u32; 2]| ends.iter().any(|&end| is_owned_by(subdomain, end));
            assert_eq!(
                places.len(),
                ends.iter().filter(|ends| is_owned(ends)).count()
            );
            let absent = whole.fixed.absent.iter();
            let absent = absent.filter_map(|it| Some((here(it.ends)?, it.absence)));
            let found = model.fixed.absent.iter().map(|it| (it.ends, it.absence));
            assert_eq!(found.collect::<Vec<_>>(), absent.collect::<Vec<_>>());
            let points = 0..subdomain.n_points() as u32;
            let numbers: Vec<usize> = points.map(|it| subdomain.number(it) as usize).collect();
            let own = of_bonds(&model);
            let mut most: f64 = 0.0;
            for ((what, expected), (_, found)) in lists.iter().zip(&own) {
                let expected = at(&places, expected);
                most = most.max(farthest(&expected, found));
                assert!(accuracy.holds(&expected, found), "{name}, {what}: {most:e}");
            }
            for ((what, expected), (_, found)) in
                of_points(&whole.fixed).iter().zip(&of_points(&model.fixed))
            {
                let expected = &at(&numbers, expected);
                let off = farthest(expected, found);
                // What is left of equations that are met is a difference of near numbers, in which the iteration makes more of rounding.
                let is_left = accuracy == Accuracy::Newton && *what == "patch residual";
                let least = 1e-9 * expected.iter().copied().fold(0.0, f64::max);
                let is_near = |(one, other): (&f64, &f64)| (one - other).abs() <= least;
                let is_right = match is_left {
                    true => expected.iter().zip(found).all(is_near),
                    false => accuracy.holds(expected, found),
                };
                assert!(is_right, "{name}, {what}: {off:e}");
            }
            assert_eq!(model.counts, whole.counts);
            assert_eq!(model.warnings.len(), whole.warnings.len());
            let reports = [&whole, &model].map(|it| it.correction.as_ref().map(steps));
            assert_eq!(reports[0], reports[1], "{name}");
            println!("{name}, {n_ranks} ranks: {most:.1e}");
            places.len()
        });
        let least = known.iter().min().unwrap();
        assert!(n_ranks == 1 || *least < ends.len());
    }
    whole
}

/// Sweeps, or Newton steps and products.
fn steps(report: &CorrectionReport) -> [usize; 2] {
    match report {
        CorrectionReport::Domain(it) => [it.sweeps, 0],
        CorrectionReport::Patch(it) => [it.steps, it.products],
    }
}

fn named(name: &str, settings: &[&str]) -> CaseFile {
    let path = repository().join("cases").join(name).join("case.toml");
    let settings: Vec<String> = settings.iter().map(|&it| it.to_owned()).collect();
    CaseFile::load(&path, &settings).unwrap()
}

fn prepared(name: &str, case: &CaseFile, accuracy: Accuracy) -> Model {
    let setup = case.setup(&mut ()).unwrap();
    shared(name, &setup, accuracy)
}

const PATCH: &str = "correction.surface=patch";

/// Pre-cracks, holes and voids, and the laws and corrections that need sums over families.
#[test]
fn bodies_in_the_plane_are_shared_out_to_the_bit() {
    let model = prepared("crack", &named("central-crack", &[]), Accuracy::Bits);
    assert!(model.counts.cut > 100 && model.correction.is_some());
    let cracked = [
        "correction.domain=cracked",
        "model.law=mppd",
        "correction.surface=domain",
    ];
    prepared("cracked", &named("central-crack", &cracked), Accuracy::Bits);
    let model = prepared(
        "void",
        &named("l-panel", &["correction.surface=domain"]),
        Accuracy::Bits,
    );
    assert!(model.counts.across_voids > 10);
    let lattice = [
        "model.law=mppd",
        "model.calibration=discrete",
        "model.cosserat_length=1e-3",
    ];
    prepared("lattice", &named("lattice-plate", &lattice), Accuracy::Bits);
    prepared("softening", &named("softening-bar", &[]), Accuracy::Bits);
    prepared(
        "two materials",
        &case(&[BAR, TWO].concat(), &[]),
        Accuracy::Bits,
    );
}

/// The sweeps along three axes, volumes of families and sums over families on a lattice with holes and on tetrahedra with a pre-crack.
#[test]
fn bodies_in_space_are_shared_out_to_the_bit() {
    let cells = [
        "solid_lattice.cells=[16, 16, 16]",
        "solid_lattice.spacing=[0.25, 0.25, 0.25]",
        "model.horizon_factor=3.5",
    ];
    let model = prepared("sphere", &named("lattice-sphere", &cells), Accuracy::Bits);
    assert!(model.counts.across_voids > 100);
    for (name, settings) in [
        (
            "volume",
            &["model.law=mppd", "correction.surface=volume"][..],
        ),
        ("discrete", &["model.law=mppd-beam"]),
    ] {
        let settings = [&cells[..], settings].concat();
        prepared(name, &named("lattice-sphere", &settings), Accuracy::Bits);
    }
    let model = prepared("block", &named("split-block", &[]), Accuracy::Bits);
    assert!(model.counts.cut > 100 && !model.criteria.list.is_empty());
}

/// Several blocks of points a rank, points that turn and that do not, and factors of two materials.
///
/// The regularisation is large: with that of the settings the last directions take a hundred products and more, in which rounding grows up to
/// what the iteration leaves (2e-3 of a factor in the bar).
#[test]
fn the_patch_correction_is_shared_out() {
    const SHORT: &str = "correction.regularisation=1e-3";
    const BODY: &str = "correction.reference=body";
    for (name, case, settings) in [
        ("disk", "brazilian-disk", &[PATCH, SHORT][..]),
        ("springs", "l-panel", &[PATCH, SHORT, "model.law=pds"]),
        ("bar", "bimaterial-bar", &[SHORT]),
        ("block", "split-block", &[PATCH, SHORT]),
        ("bar", "bimaterial-bar", &[SHORT, BODY]),
        ("block", "split-block", &[PATCH, SHORT, BODY]),
    ] {
        prepared(name, &named(case, settings), Accuracy::Newton);
    }
}

/// What no rank sees by itself is refused by all of them with the words of one process.
#[test]
fn faults_are_those_of_the_whole_body() {
    // Two bricks on each other, the upper one higher than horizons reach.
    let layer = |z: f64| [[0.0, 0.0, z], [1.0, 0.0, z], [1.0, 1.0, z], [0.0, 1.0, z]];
    let mesh = SolidMesh {
        node_tags: (1..=12).collect(),
        positions: [0.0, 1.0, 4.0].map(layer).concat(),
        cells: vec![
            SolidCell::Hexahedron([0, 1, 2, 3, 4, 5, 6, 7]),
            SolidCell::Hexahedron([4, 5, 6, 7, 8, 9, 10, 11]),
        ],
        ..SolidMesh::default()
    };
    let material = Material::isotropic(1e9, 0.2);
    let mut torn = Setup::new(SolidMeshBody::from(mesh), material, Law::NHPD);
    torn.horizon = Horizon::Factor(1.5);
    let soft = named("softening-bar", &["material.fracture_energy=1e-3"]);
    let soft = soft.setup(&mut ()).unwrap();
    let words = |refused: Result<(), SetupError>| refused.unwrap_err().to_string();
    let alone = [
        words(Model::build(torn.clone(), &mut ()).map(|_| ())),
        words(Model::build(soft.clone(), &mut ()).map(|_| ())),
    ];
    let told = on_ranks(3, |together| {
        let (mut torn, mut soft) = (torn.clone(), soft.clone());
        torn.solver.communicator = Processes(together.clone());
        soft.solver.communicator = Processes(together);
        [
            words(Model::build(torn, &mut ()).map(|_| ())),
            words(Model::build(soft, &mut ()).map(|_| ())),
        ]
    });
    println!("{alone:?}");
    assert!(told.iter().all(|it| *it == alone));
}

/// Each rank describes all points as one process does; a mesh lists their tags once for messages and tables.
#[test]
fn all_points_have_their_names_on_each_rank() {
    for case in [named("split-block", &[]), named("lattice-sphere", &[])] {
        let setup = case.setup(&mut ()).unwrap();
        let places = |model: &Model| {
            let points = 0..model.names.n_points() as u32;
            points.map(|it| model.names.place(it)).collect()
        };
        let alone: Vec<String> = places(&Model::build(setup.clone(), &mut ()).unwrap());
        let of_ranks = on_ranks(2, |together| {
            let mut setup = setup.clone();
            setup.solver.communicator = Processes(together);
            let model = Model::build(setup, &mut ()).unwrap();
            assert!(!model.system.subdomain.is_whole());
            let once = match [model.names.point_tags(), model.names.point_tags()].map(|it| it.tags)
            {
                [Tags::Listed(one), Tags::Listed(other)] => Arc::ptr_eq(&one, &other),
                _ => true,
            };
            (places(&model), once)
        });
        assert!(of_ranks.iter().all(|it| *it == (alone.clone(), true)));
    }
}

/// What one process has of a body is what must fit into its memory: half of 22 MB of bonds.
#[test]
fn memory_is_foreseen_for_the_bonds_of_a_process() {
    let case = named("lattice-plate", &["solver.memory=0.016"]);
    let setup = case.setup(&mut ()).unwrap();
    assert!(check_model_memory(&case, &setup).is_err());
    let fits = on_ranks(2, |together| {
        let mut setup = setup.clone();
        setup.solver.communicator = Processes(together.clone());
        check_model_memory(&case, &setup).is_ok()
    });
    assert_eq!(fits, [true, true]);
}
