//! Factors of awkward trees, computed, updated and solved with: their bits on any number of threads equal the bits on one, and faer's.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::perm::Perm;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Par, Side};
use ligament_linalg::digest;
use ligament_linalg::{Elimination, FactorKind, RankOne, SymmetricMatrix};

use super::changes::random_terms;
use super::systems::*;

/// Numbers of threads that are compared with one.
const THREADS: [usize; 3] = [2, 3, 7];

/// Number of values from which on a factor is certain to be cut into tasks.
const CUT: usize = 200_000;

/// Graphs with their number of unknowns per point, and orders of their points.
fn awkward(random: &mut Random) -> Vec<(&'static str, Graph, usize, Vec<usize>)> {
    let in_turn = |graph: &Graph| (0..graph.n_points).collect::<Vec<_>>();
    let chain = Graph::chain(25_000);
    let mut forest = Graph::chain(3_000);
    for size in [40, 7, 1, 90, 61, 23, 80, 2, 75] {
        forest = forest
            .beside(&Graph::complete(size))
            .beside(&Graph::chain(90));
    }
    // Many points on a few that are all coupled: one root, dense and with nothing below.
    let root = 150;
    let leaves = 2_000;
    let pairs =
        (0..leaves).flat_map(|leaf| (0..20).map(move |k| (leaf, leaves + (7 * leaf + k) % root)));
    let dense = (0..root).flat_map(|b| (0..b).map(move |a| (leaves + a, leaves + b)));
    let star = Graph::new(leaves + root, pairs.chain(dense));
    // Two blocks of points that are all coupled, and both with a third one: large panels with many rows below.
    let sides = [0..180, 180..360, 360..590];
    let coupled = |a: usize, b: usize| sides[0].contains(&a) && sides[1].contains(&b);
    let pairs = (0..590).flat_map(|b| (0..b).map(move |a| (a, b)));
    let blocks = Graph::new(590, pairs.filter(|&(a, b)| !coupled(a, b)));
    // A leg of three points at each point of a spine, before it or after it.
    let spine = 8_000;
    let legs = (0..spine).flat_map(|k| {
        [
            (4 * k, 4 * k + 1),
            (4 * k + 1, 4 * k + 2),
            (4 * k + 2, 4 * k + 3),
        ]
    });
    let caterpillar = Graph::new(
        4 * spine,
        legs.chain((1..spine).map(|k| (4 * k - 1, 4 * k + 3))),
    );
    let lattice = Graph::lattice(45, 3.0);
    let order = |graph: &Graph| in_turn(graph);
    let shuffled = random.permutation(lattice.n_points);
    vec![
        ("chain", chain.clone(), 3, order(&chain)),
        ("forest", forest.clone(), 3, order(&forest)),
        ("star", star.clone(), 2, order(&star)),
        ("blocks", blocks.clone(), 3, order(&blocks)),
        ("caterpillar", caterpillar.clone(), 2, order(&caterpillar)),
        (
            "caterpillar, backwards",
            caterpillar.clone(),
            2,
            (0..4 * spine).rev().collect(),
        ),
        ("lattice by halves", lattice.clone(), 3, halves(45)),
        ("lattice at random", lattice, 2, shuffled),
    ]
}

/// Points of a square lattice by nested dissection with separators of three columns or rows.
pub(super) fn halves(side: usize) -> Vec<usize> {
    fn cut(points: Vec<[usize; 2]>, order: &mut Vec<[usize; 2]>) {
        let extent = |axis: usize| {
            let of_axis = points.iter().map(|point| point[axis]);
            (of_axis.clone().min().unwrap(), of_axis.max().unwrap())
        };
        if points.len() <= 40 {
            order.extend(points);
            return;
        }
        let axis = usize::from(extent(1).1 - extent(1).0 > extent(0).1 - extent(0).0);
        let middle = usize::midpoint(extent(axis).0, extent(axis).1);
        let part = |from: usize, to: usize| {
            let inside = points
                .iter()
                .copied()
                .filter(|point| (from..to).contains(&point[axis]));
            inside.collect::<Vec<_>>()
        };
        cut(part(0, middle - 1), order);
        cut(part(middle + 2, usize::MAX), order);
        order.extend(part(middle - 1, middle + 2));
    }
    let mut order = Vec::new();
    let points = (0..side * side).map(|point| [point % side, point / side]);
    cut(points.collect(), &mut order);
    order.iter().map(|[x, y]| y * side + x).collect()
}

/// Bits of the values of a factor by faer on one thread, as [`ligament_linalg::Factorisation::digest`] tells them.
fn digest_of_faer(matrix: &SymmetricMatrix, order: &[usize], kind: FactorKind) -> u64 {
    let pattern = matrix.pattern();
    let n = pattern.dimension();
    let mut places = vec![0; n];
    for (place, &unknown) in order.iter().enumerate() {
        places[unknown] = place;
    }
    let permutation = Perm::new_checked(order.into(), places.into(), n);
    let structure =
        SymbolicSparseColMatRef::new_checked(n, n, pattern.column_starts(), None, pattern.rows());
    let ordering = SymmetricOrdering::Custom(permutation.as_ref());
    let parameters = CholeskySymbolicParams {
        supernodal_flop_ratio_threshold: SupernodalThreshold(-1.0),
        ..Default::default()
    };
    let symbolic =
        factorize_symbolic_cholesky(structure, Side::Upper, ordering, parameters).unwrap();
    let llt = symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, Default::default());
    let ldlt = symbolic.factorize_numeric_ldlt_scratch::<f64>(Par::Seq, Default::default());
    let mut room = MemBuffer::new(llt.or(ldlt));
    let stack = MemStack::new(&mut room);
    let matrix = SparseColMatRef::new(structure, &matrix.values);
    let mut values = vec![0.0; symbolic.len_val()];
    let (side, par) = (Side::Upper, Par::Seq);
    match kind {
        FactorKind::Llt => {
            let regularization = Default::default();
            let parameters = Default::default();
            symbolic
                .factorize_numeric_llt(
                    &mut values,
                    matrix,
                    side,
                    regularization,
                    par,
                    stack,
                    parameters,
                )
                .unwrap();
        }
        FactorKind::Ldlt => {
            let regularization = Default::default();
            let parameters = Default::default();
            symbolic
                .factorize_numeric_ldlt(
                    &mut values,
                    matrix,
                    side,
                    regularization,
                    par,
                    stack,
                    parameters,
                )
                .unwrap();
        }
    }
    digest(&values)
}

fn on<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> T {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
    pool.build().unwrap().install(work)
}

/// Factor, changes in sequence with what they leave, and solutions, each as its bits; two solutions together have the same.
fn follow(
    original: &System,
    order: &[usize],
    kind: FactorKind,
    changes: &[(Vec<RankOne>, Vec<f64>)],
) -> Vec<u64> {
    let symbolic = original.symbolic(Elimination::Given(order.to_vec()));
    assert!(
        symbolic.n_factor_values() > CUT,
        "{} values",
        symbolic.n_factor_values()
    );
    let mut factor = original.factor(kind, &symbolic);
    let mut found = vec![factor.digest()];
    for (terms, b) in changes {
        let half_solved = factor.change(terms, &listed(b)[..20]).unwrap();
        found.extend(bits(&factor.finish(half_solved)));
        found.push(factor.digest());
        let alone = bits(&solve(factor.as_mut(), b));
        let [mut one, mut other] = [b.clone(), b.iter().rev().copied().collect()];
        let alone_too = bits(&solve(factor.as_mut(), &other));
        factor.solve_both_in_place([&mut one, &mut other]);
        assert_eq!([bits(&one), bits(&other)], [alone.clone(), alone_too]);
        found.extend(alone);
    }
    found
}

/// Subtrees, blocks of columns and rows below them are tasks; contributions of different threads are added in a fixed order.
#[test]
fn awkward_trees_have_the_same_bits_on_any_number_of_threads() {
    let mut random = Random(18);
    for (name, graph, components, points) in awkward(&mut random) {
        let original = System::new(&graph, components, &mut random);
        let order: Vec<usize> = (points.iter())
            .flat_map(|point| point * components..(point + 1) * components)
            .collect();
        let mut changed = original.clone();
        let changes: Vec<_> = [3, 0, 40, 6]
            .map(|count| {
                let terms = random_terms(&mut changed, count, &mut random);
                (terms, random.vector(original.n()))
            })
            .into();
        for kind in KINDS {
            let alone = on(1, || follow(&original, &order, kind, &changes));
            let of_faer = digest_of_faer(&original.matrix(), &order, kind);
            assert_eq!(
                alone[0], of_faer,
                "{name}, {kind:?}: the bits are not faer's"
            );
            for threads in THREADS {
                let others = on(threads, || follow(&original, &order, kind, &changes));
                assert!(others == alone, "{name}, {kind:?}, {threads} threads");
            }
        }
    }
}

/// The error names the first row without a pivot, whichever task finds one first.
#[test]
fn the_first_pivot_that_is_missing_is_told() {
    let mut random = Random(19);
    let graph = Graph::lattice(45, 3.0);
    let mut system = System::new(&graph, 3, &mut random);
    let order: Vec<usize> = (halves(45).iter())
        .flat_map(|point| 3 * point..3 * (point + 1))
        .collect();
    for place in [100, 2_000, 4_000, 6_000] {
        system.add(order[place], -1e6);
    }
    let refused = |threads| {
        on(threads, || {
            let symbolic = system.symbolic(Elimination::Given(order.clone()));
            let refused = FactorKind::Llt.factorise(&symbolic, &system.matrix());
            refused.err().unwrap()
        })
    };
    let alone = refused(1);
    assert_eq!(
        alone,
        ligament_linalg::FactorError::NotPositiveDefinite {
            unknown: order[100]
        }
    );
    for threads in THREADS {
        assert_eq!(refused(threads), alone, "{threads} threads");
    }
}
