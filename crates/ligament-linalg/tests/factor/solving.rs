//! Analysis, factorisation and solve.

use std::sync::Arc;

use ligament_linalg::{Elimination, Inertia, Pattern, Symbolic, SymmetricMatrix};

use super::EPSILON;
use super::systems::*;

/// Shapes that panels take: single columns, blocks of one to nine columns, several roots, no rows below.
fn small_graphs(random: &mut Random) -> Vec<Graph> {
    let mut graphs = vec![
        Graph::new(1, []),
        Graph::new(7, []),
        Graph::chain(11),
        Graph::new(9, (1..9).map(|leaf| (0, leaf))),
        Graph::lattice(4, 1.5),
        Graph::chain(4)
            .beside(&Graph::complete(5))
            .beside(&Graph::new(2, [])),
    ];
    graphs.extend((1..=9).map(Graph::complete));
    // Two complete graphs that share points: a panel with rows below, of all widths.
    graphs.extend((1..=9).map(|width| {
        let shared = 5;
        let first = Graph::complete(width + shared);
        let second =
            (0..3).flat_map(|k| (width..width + shared).map(move |p| (p, width + shared + k)));
        Graph::new(
            width + shared + 3,
            first.pairs.iter().copied().chain(second),
        )
    }));
    graphs.extend((0..10).map(|k| Graph::random(3 + k, 1.4, random)));
    graphs
}

/// Against a dense solution with full pivoting. The error is at most the condition number times the backward error, and
/// that about 3n/2 eps (Higham, Accuracy and Stability, theorem 10.4).
#[test]
fn solutions_are_those_of_a_dense_matrix() {
    let mut random = Random(1);
    for graph in small_graphs(&mut random) {
        for components in 1..=3 {
            let system = System::new(&graph, components, &mut random);
            let n = system.n();
            let b = random.vector(n);
            let expected = solve_dense(system.dense(), &b);
            for elimination in orders(n, &mut random) {
                let symbolic = system.symbolic(elimination.clone());
                for kind in KINDS {
                    let mut factor = system.factor(kind, &symbolic);
                    let error = difference(&solve(factor.as_mut(), &b), &expected);
                    let bound = system.condition() * 2.0 * n as f64 * EPSILON;
                    assert!(
                        error <= bound,
                        "{kind:?} {elimination:?} {graph:?}: {error}"
                    );
                    let halves = factor.change(&[], &listed(&b)).unwrap();
                    assert_eq!(
                        bits(&factor.finish(halves)),
                        bits(&solve(factor.as_mut(), &b)),
                        "both halves are the whole"
                    );
                }
            }
        }
    }
}

/// The pivots in a given order are those of elimination by hand: the diagonal entry less what was eliminated before.
#[test]
fn pivots_are_those_of_dense_elimination_in_the_same_order() {
    let mut random = Random(2);
    for graph in small_graphs(&mut random) {
        let system = System::new(&graph, 2, &mut random);
        let n = system.n();
        let order = random.permutation(n);
        let mut rest = system.dense();
        let mut expected = vec![0.0; n];
        for (k, &pivot) in order.iter().enumerate() {
            expected[pivot] = rest[(pivot, pivot)];
            for &i in &order[k + 1..] {
                let share = rest[(i, pivot)] / rest[(pivot, pivot)];
                for &j in &order[k + 1..] {
                    rest[(i, j)] -= share * rest[(pivot, j)];
                }
            }
        }
        let symbolic = system.symbolic(Elimination::Given(order));
        for kind in KINDS {
            let pivots = system.factor(kind, &symbolic).pivots();
            let error = largest((0..n).map(|i| pivots[i] / expected[i] - 1.0));
            // A pivot is the inverse of an entry of the inverse of a leading block, whose condition is no worse.
            let bound = system.condition() * n as f64 * EPSILON;
            assert!(error <= bound, "{kind:?} {graph:?}: {error}");
        }
    }
}

/// Lattices up to 2,000 unknowns; n eps bounds the backward error (measured: 5e-16).
#[test]
fn larger_systems_leave_no_residual() {
    let mut random = Random(3);
    for (side, reach, components) in [(5, 1.0, 1), (44, 2.3, 1), (30, 1.0, 2), (25, 3.0, 3)] {
        let system = System::new(&Graph::lattice(side, reach), components, &mut random);
        let matrix = system.matrix();
        let b = random.vector(system.n());
        let mut orders = orders(system.n(), &mut random).to_vec();
        orders.push(Elimination::Given((0..system.n()).collect()));
        for elimination in orders {
            let symbolic = system.symbolic(elimination);
            for kind in KINDS {
                let mut factor = system.factor(kind, &symbolic);
                let error = backward_error(&matrix, &solve(factor.as_mut(), &b), &b);
                assert!(
                    error < system.n() as f64 * EPSILON,
                    "{kind:?} {side}: {error}"
                );
            }
        }
    }
}

/// A right-hand side that is zero in most places needs only its own path to the root; the other panels have nothing to add.
#[test]
fn a_sparse_right_hand_side_gives_the_whole_solution() {
    let mut random = Random(4);
    for (graph, components) in [
        (Graph::lattice(12, 2.0), 3),
        (Graph::random(150, 1.2, &mut random), 1),
        (Graph::chain(40).beside(&Graph::chain(30)), 2),
    ] {
        let system = System::new(&graph, components, &mut random);
        for elimination in orders(system.n(), &mut random) {
            let symbolic = system.symbolic(elimination);
            for kind in KINDS {
                let mut factor = system.factor(kind, &symbolic);
                for n_entries in 0..8 {
                    let sparse: Vec<(usize, f64)> = (0..n_entries)
                        .map(|_| (random.below(system.n()), random.signed()))
                        .collect();
                    let mut b = vec![0.0; system.n()];
                    for &(unknown, value) in sparse.iter().chain(&sparse) {
                        b[unknown] += value;
                    }
                    // Every entry twice: entries of one unknown add up.
                    let twice: Vec<_> = sparse.iter().chain(&sparse).copied().collect();
                    let half_solved = factor.change(&[], &twice).unwrap();
                    let x = factor.finish(half_solved);
                    assert_eq!(x, solve(factor.as_mut(), &b), "{kind:?} {sparse:?}");
                }
            }
        }
    }
}

/// No unknowns at all is a system too.
#[test]
fn nothing_to_solve() {
    let pattern = Arc::new(Pattern::new(vec![0], vec![]).unwrap());
    for elimination in orders(0, &mut Random(0)) {
        let symbolic = Arc::new(Symbolic::analyse(pattern.clone(), elimination).unwrap());
        for kind in KINDS {
            let matrix = SymmetricMatrix::zero(pattern.clone());
            let mut factor = kind.factorise(&symbolic, &matrix).unwrap();
            factor.solve_in_place(&mut []);
            let half_solved = factor.change(&[], &[]).unwrap();
            assert!(factor.finish(half_solved).is_empty());
            assert!(factor.pivots().is_empty());
            let none = Inertia {
                positive: 0,
                negative: 0,
            };
            assert_eq!(factor.inertia(), none);
        }
    }
}

/// An order that leaves an unknown out, or names one twice, is a mistake of the caller.
#[test]
fn an_order_is_a_permutation() {
    let mut random = Random(5);
    let system = System::new(&Graph::chain(4), 1, &mut random);
    for order in [
        vec![0, 1, 2],
        vec![0, 1, 2, 2],
        vec![0, 1, 2, 4],
        vec![0, 1, 2, 3, 4],
    ] {
        let pattern = system.pattern.clone();
        let analysis = std::panic::catch_unwind(|| {
            Symbolic::analyse(pattern, Elimination::Given(order.clone())).is_ok()
        });
        assert!(analysis.is_err(), "{order:?}");
    }
}
