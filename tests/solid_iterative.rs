//! Conjugate gradients without a matrix in space: cylinders with a crack over half of their section, against the factor of the matrix.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use ligament_analysis::solver::{Method, SolverChoice, Unfit};
use ligament_analysis::{Attempt, Equilibrium, SetupError};
use ligament_model::ElementKind;
use ligament_model::law::Law;
use ligament_model::law::rotational::RotationalStiffness;
use ligament_model::material::Isotropic;
use ligament_model::material::Space;
use ligament_model::{BondSet, PointCloud};
use rayon::ThreadPoolBuilder;
use verification::bench;
use verification::cylinders::{MATERIAL, Torn, cylinder, cylinder_of, pulled};
use verification::numbers::{deviation, relative_error};
use verification::table::Table;

/// Displacements and rotations after the crack and a few bonds more, those of the factor to 1e-6: a residual of 1e-8 times the condition of
/// the body between forces and displacements at a point.
#[test]
fn a_cylinder_breaks_as_with_the_factor() {
    let system = cylinder(10);
    let [mut direct, mut iterative] = [Method::Direct, Method::Iterative]
        .map(|method| Torn::cracked(&pulled(&system, method), &system, 0.0));
    for broken in 0..6 {
        let [one, other] = [&mut direct, &mut iterative].map(Torn::balance);
        let off = deviation(&iterative.state.displacement, &direct.state.displacement);
        let iterations = iterative.equilibrium.costs().iterations;
        println!("{broken} bonds broken: off by {off:.1e}, {iterations} iterations so far");
        assert!(off < 1e-6, "{off:e}");
        direct.break_longest(&one);
        iterative.break_longest(&other);
        assert_eq!(direct.breakage.bonds, iterative.breakage.bonds);
    }
    assert!(matches!(
        iterative.equilibrium.choice(),
        SolverChoice::Iterative(_)
    ));
    assert_eq!(iterative.equilibrium.costs().factorisations, 1);
}

/// Nothing depends on the number of threads, with two levels and with three.
#[test]
fn threads_change_no_bit() {
    let system = cylinder(14);
    let mut problem = pulled(&system, Method::Iterative);
    for clusters_from in [usize::MAX, 0] {
        problem.solver.clusters_from = clusters_from;
        let [one, other] = [1, 2].map(|threads| {
            let pool = ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()
                .unwrap();
            pool.install(|| {
                let mut torn = Torn::cracked(&problem, &system, 0.0);
                let balanced = torn.balance();
                torn.break_longest(&balanced);
                torn.balance();
                torn.state.displacement
            })
        });
        assert!(one.iter().any(|value| *value > 1e-4));
        let mut pairs = one.iter().zip(&other);
        assert!(pairs.all(|(a, b)| a.to_bits() == b.to_bits()));
    }
}

/// Every law with shear has bonds with a negative stiffness above a Poisson's ratio of 1/4, and none below: they are refused by name.
#[test]
fn negative_shear_is_refused_by_name() {
    let laws = [
        ("nhpd, secant", Law::NHPD),
        ("mppd", Law::MPPD),
        ("mppd without", Law::MPPD.with(RotationalStiffness::Zero)),
        ("pds", Law::PDS),
    ];
    for (name, law) in laws {
        for (poisson, is_refused) in [(0.24, false), (0.26, true), (0.45, true)] {
            let material = Isotropic {
                poisson,
                ..MATERIAL
            };
            let system = cylinder_of(6, law.element(), |bonds, cloud| {
                law.densities(bonds, cloud, &[material.into()], Space::Solid)
            });
            let made = Equilibrium::new(&pulled(&system, Method::Iterative), 1e-4);
            match made {
                Err(SetupError::NotIterative(Unfit::Indefinite)) => {
                    assert!(is_refused, "{name}, {poisson}");
                }
                Ok(_) => assert!(!is_refused, "{name}, {poisson}"),
                Err(other) => panic!("{name}, {poisson}: {other}"),
            }
        }
    }
}

/// Bonds that no law gives, which resist rotations by less than nothing: no answer is better than one of another body, in which
/// rotations were held.
#[test]
fn negative_rotational_stiffness_gives_no_answer() {
    let law = |bonds: &BondSet<3>, cloud: &PointCloud<3>| {
        let mut stiffness = Law::NHPD.densities(bonds, cloud, &[MATERIAL.into()], Space::Solid);
        stiffness.rotational.iter_mut().for_each(|it| *it *= -20.0);
        stiffness
    };
    let system = cylinder_of(6, ElementKind::Beam, law);
    let mut torn = Torn::cracked(&pulled(&system, Method::Iterative), &system, 0.0);
    let Attempt::Unbalanced(reason) = torn.attempt() else {
        panic!("an answer");
    };
    let words = reason.to_string();
    println!("{words}");
    assert!(words.contains("positive definite"), "{words}");
}

/// Numbers of iterations after each of so many breakages, one after the other, and the bonds that broke; with a third level from so many
/// points on.
fn breakages(count: usize, clusters_from: usize) -> (Vec<usize>, Vec<u32>) {
    let system = cylinder(14);
    let mut problem = pulled(&system, Method::Iterative);
    problem.solver.clusters_from = clusters_from;
    let mut torn = Torn::cracked(&problem, &system, 0.0);
    let mut balanced = torn.balance();
    let (mut counts, mut bonds) = (Vec::new(), Vec::new());
    for _ in 0..count {
        let before = torn.equilibrium.costs().iterations;
        torn.break_longest(&balanced);
        bonds.extend_from_slice(&torn.breakage.bonds);
        balanced = torn.balance();
        counts.push(torn.equilibrium.costs().iterations - before);
    }
    let costs = torn.equilibrium.costs();
    println!(
        "{count} breakages: {} coarse spaces, {} changed in place",
        costs.factorisations, costs.changes
    );
    (counts, bonds)
}

fn mean(counts: &[usize]) -> f64 {
    counts.iter().sum::<usize>() as f64 / counts.len() as f64
}

/// Iterations do not creep while bonds break one after the other: the coarse stiffness loses what the bonds gave to it.
#[test]
fn iterations_stay_few_while_bonds_break() {
    let (counts, _) = breakages(200, usize::MAX);
    let [first, last] = [mean(&counts[..50]), mean(&counts[150..])];
    println!("{first} iterations a breakage, later {last}");
    // Published for a coarse space of the body without its crack: four times as many.
    assert!(last < 1.5 * first, "{first} {last}");
}

/// With a third level the iterations are hardly more (as many, measured), and the same bonds break.
#[test]
fn a_third_level_takes_as_many_iterations() {
    let [two, three] = [usize::MAX, 0].map(|from| breakages(30, from));
    let [of_two, of_three] = [mean(&two.0), mean(&three.0)];
    println!("{of_two} iterations a breakage, {of_three} with a third level");
    assert!(of_three < 1.1 * of_two);
    assert_eq!(three.1, two.1);
}

/// A block on inclined rollers whose platen tilts, pushed, pulled back and pushed again in a stage of the exact path. The stiff platen exerts many
/// times what deforms the block: a line of the path that is judged by the norm of that puts the first breakage off by 7e-4. The first breakage
/// is that of the factor to 1e-6, and so do the energies balance: the iteration goes to 1e-8 of the forces at a point.
#[test]
fn a_stage_of_the_exact_path_moves_a_platen_that_tilts() {
    const BLOCK: &str = r#"
solid_lattice = { cells = [5, 5, 4], spacing = [0.2, 0.2, 0.2], set = { left = { left = 1 }, right = { right = 1 } } }
material = { young = 1e10, poisson = 0.2, tensile_strength = 2e6 }
model = { law = "mppd", horizon_factor = 2.0 }
support = [
    { group = "left", normal = [0.8, 0.36, 0.48] },
    { at = [0.1, 0.1, 0.1], displacement = { y = 0.0, z = 0.0 } },
    { at = [0.1, 0.9, 0.1], displacement = { z = 0.0 } },
]
load = [{ name = "pull", group = "right", displacement = { x = 4e-4 }, tilts = true }]
stage = [{ name = "a", loads = { pull = [0.7, -0.3, 0.0, 1.0] } }]
fracture = { control = "event" }
"#;
    let folder = tempfile::tempdir().unwrap();
    let [direct, iterative] = ["direct", "iterative"].map(|method| {
        let case = bench::case(BLOCK, &[&format!("solver.method={method}")]);
        let out = folder.path().join(method);
        bench::run_program(&case, &out);
        ["breaks.csv", "history.csv"].map(|file| Table::read(&out.join(file)))
    });
    for column in ["load_factor", "reaction"] {
        let [wanted, first] = [&direct, &iterative].map(|run| run[0].number(0, column));
        let off = relative_error(first, wanted);
        println!("{column} of the first breakage off by {off:.1e}");
        assert!(off < 1e-6, "{column}: {first} {wanted}");
    }
    let history = &iterative[1];
    let missing = history.number(history.len() - 1, "energy_error").abs();
    println!("energies miss by {missing:.1e}");
    assert!(missing > 0.0 && missing < 1e-6, "{missing:e}");
}
