//! Conjugate gradients without a matrix in space: cylinders with a crack over half of their section, against the factor of the matrix.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use ligament_analysis::solver::{Method, SolverChoice};
use rayon::ThreadPoolBuilder;
use verification::cylinders::{Torn, cylinder, pulled};
use verification::numbers::deviation;

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

/// Nothing depends on the number of threads.
#[test]
fn threads_change_no_bit() {
    let system = cylinder(14);
    let [one, other] = [1, 2].map(|threads| {
        let pool = ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| {
            let mut torn = Torn::cracked(&pulled(&system, Method::Iterative), &system, 0.0);
            let balanced = torn.balance();
            torn.break_longest(&balanced);
            torn.balance();
            torn.state.displacement
        })
    });
    assert!(one.iter().any(|value| *value > 1e-4));
    assert!(
        one.iter()
            .zip(&other)
            .all(|(a, b)| a.to_bits() == b.to_bits())
    );
}
