//! Factors changed in place against factors made anew.

use ligament_linalg::{Elimination, FactorKind, Factorisation, Inertia, RankOne};

use super::EPSILON;
use super::systems::*;

/// An updated factor has the pivots, the inertia and the solution of a new one.
fn assert_like_new(
    changed: &mut dyn Factorisation,
    anew: &mut dyn Factorisation,
    b: &[f64],
    bound: f64,
    what: &str,
) {
    assert_eq!(changed.inertia(), anew.inertia(), "{what}");
    let (pivots, expected) = (changed.pivots(), anew.pivots());
    for (unknown, (pivot, expected)) in pivots.iter().zip(&expected).enumerate() {
        let error = (pivot / expected - 1.0).abs();
        assert!(
            error <= bound,
            "{what}: pivot {unknown} is wrong by {error}"
        );
    }
    let error = difference(&solve(changed, b), &solve(anew, b));
    assert!(error <= bound, "{what}: solution wrong by {error}");
}

/// Random changes of the weights of terms: pairs lose a part or all of their weight, or gain.
pub(crate) fn random_terms(system: &mut System, count: usize, random: &mut Random) -> Vec<RankOne> {
    let pairs = system.terms_of_pairs();
    (0..count)
        .map(|_| {
            let on_ground = pairs.is_empty() || random.below(4) == 0;
            let term = if on_ground {
                random.below(system.n())
            } else {
                pairs.start + random.below(pairs.len())
            };
            let weight = system.terms[term].weight;
            let change = match random.below(3) {
                0 => 1.0 + random.signed(),
                _ if on_ground => GROUND - weight,
                1 => -weight,
                _ => -0.7 * weight,
            };
            system.add(term, change)
        })
        .collect()
}

/// Rank-one terms on one, two, four and six unknowns, up to 70 at once (32 are applied together). The matrix stays positive
/// definite, each term makes a backward error of some eps, and so does a column of the factor; the condition multiplies.
#[test]
fn random_changes_give_the_factor_of_the_changed_matrix() {
    let mut random = Random(11);
    let graphs = [
        (Graph::new(1, []), 1),
        (Graph::new(3, []), 2),
        (Graph::chain(9), 1),
        (Graph::complete(7), 3),
        (Graph::lattice(7, 2.3), 1),
        (Graph::lattice(6, 1.5), 2),
        (Graph::lattice(8, 3.0), 3),
        (Graph::random(60, 1.3, &mut random), 3),
        (Graph::chain(5).beside(&Graph::complete(6)), 3),
    ];
    for (graph, components) in graphs {
        let original = System::new(&graph, components, &mut random);
        let n = original.n();
        for elimination in orders(n, &mut random) {
            let symbolic = original.symbolic(elimination.clone());
            for kind in KINDS {
                let mut system = original.clone();
                let mut factor = system.factor(kind, &symbolic);
                let mut n_terms = 0;
                for count in [1, 3, 15, 31, 32, 33, 70, 0, 6] {
                    let terms = random_terms(&mut system, count, &mut random);
                    let b = random.vector(n);
                    let half_solved = factor.change(&terms, &listed(&b)).unwrap();
                    n_terms += count;
                    let x = factor.finish(half_solved);
                    let bound = system.condition() * (n + n_terms) as f64 * EPSILON;
                    let what = format!("{kind:?} {elimination:?} {components} {count}: {graph:?}");
                    let mut anew = system.factor(kind, &symbolic);
                    assert_like_new(factor.as_mut(), anew.as_mut(), &b, bound, &what);
                    assert_eq!(x, solve(factor.as_mut(), &b), "{what}");
                }
            }
        }
    }
}

/// A factor of a matrix that differs in a few terms, of which only the paths to the root are computed, has the bits of a new one: after
/// terms that changed in the matrix alone, terms that were also applied in place, and a matrix that was refused on the way.
#[test]
fn a_factor_computed_along_its_paths_has_the_bits_of_a_new_one() {
    let mut random = Random(15);
    for (graph, components) in [
        (Graph::new(1, []), 1),
        (Graph::chain(40), 2),
        (Graph::lattice(12, 2.0), 3),
        (Graph::chain(9).beside(&Graph::lattice(6, 1.5)), 3),
    ] {
        let original = System::new(&graph, components, &mut random);
        for elimination in orders(original.n(), &mut random) {
            let symbolic = original.symbolic(elimination);
            for kind in KINDS {
                let mut system = original.clone();
                let mut factor = system.factor(kind, &symbolic);
                for count in [1, 2, 0, 5, 1, 1] {
                    let terms = random_terms(&mut system, count, &mut random);
                    if random.below(2) == 0 {
                        factor.change(&terms, &[]).unwrap();
                        random_terms(&mut system, 1, &mut random);
                    }
                    let mut refused = system.matrix();
                    let unknown = random.below(system.n());
                    refused.values[system.pattern.column_starts()[unknown + 1] - 1] = -1.0;
                    if kind == FactorKind::Llt && random.below(2) == 0 {
                        assert!(factor.refactorise(&refused).is_err());
                    }
                    factor.refactorise(&system.matrix()).unwrap();
                    let anew = system.factor(kind, &symbolic);
                    assert_eq!(factor.digest(), anew.digest(), "{kind:?} {graph:?}");
                    assert_eq!(bits(&factor.pivots()), bits(&anew.pivots()));
                    assert_eq!(factor.inertia(), anew.inertia());
                }
            }
        }
    }
}

/// The right-hand side of a change may be nonzero where no term is.
#[test]
fn a_right_hand_side_away_from_the_terms_is_solved_for() {
    let mut random = Random(12);
    let mut system = System::new(&Graph::lattice(14, 2.0), 3, &mut random);
    for elimination in orders(system.n(), &mut random) {
        let symbolic = system.symbolic(elimination);
        for kind in KINDS {
            let mut factor = system.factor(kind, &symbolic);
            for count in [1, 5, 40] {
                let terms = random_terms(&mut system, count, &mut random);
                let sparse: Vec<(usize, f64)> = (0..5)
                    .map(|_| (random.below(system.n()), random.signed()))
                    .collect();
                let mut b = vec![0.0; system.n()];
                for &(unknown, value) in &sparse {
                    b[unknown] += value;
                }
                let half_solved = factor.change(&terms, &sparse).unwrap();
                let x = factor.finish(half_solved);
                assert_eq!(x, solve(factor.as_mut(), &b), "{kind:?}");
                let error = backward_error(&system.matrix(), &x, &b);
                assert!(error < system.n() as f64 * EPSILON, "{kind:?}: {error}");
            }
        }
    }
}

/// An unknown that a term names twice has the sum of both values.
#[test]
fn entries_of_one_unknown_add_up() {
    let mut random = Random(13);
    let mut system = System::new(&Graph::chain(6), 1, &mut random);
    let symbolic = system.symbolic(Elimination::MinimumDegree);
    for kind in KINDS {
        let mut factor = system.factor(kind, &symbolic);
        let term = system.terms_of_pairs().start + 2;
        let mut change = system.add(term, 0.75);
        let (unknown, value) = change.entries[0];
        change.entries[0].1 = 0.25 * value;
        change.entries.push((unknown, 0.75 * value));
        factor.change(&[change], &[]).unwrap();
        let b = random.vector(system.n());
        let bound = system.condition() * system.n() as f64 * EPSILON;
        let mut anew = system.factor(kind, &symbolic);
        assert_like_new(
            factor.as_mut(),
            anew.as_mut(),
            &b,
            bound,
            &format!("{kind:?}"),
        );
    }
}

/// Pulling unknowns down by twice the norm of the matrix makes as many eigenvalues negative, one after the other, and every
/// matrix on the way has L D L^T in any order (it is quasidefinite: Vanderbei, SIAM J. Optim. 5, 1995). Their blocks are as
/// far from singular as the matrix before, so its condition bounds the errors.
#[test]
fn pivots_change_their_sign_there_and_back() {
    let mut random = Random(14);
    for (graph, components) in [
        (Graph::new(2, []), 1),
        (Graph::chain(12), 1),
        (Graph::complete(5), 3),
        (Graph::lattice(6, 2.0), 3),
    ] {
        let mut system = System::new(&graph, components, &mut random);
        let n = system.n();
        let fall = 2.0 * norm(&system.matrix());
        let bound = (norm(&system.matrix()) + fall) / GROUND * 4.0 * n as f64 * EPSILON;
        let picked: Vec<usize> = random.permutation(n).into_iter().take(n / 2).collect();
        for elimination in orders(n, &mut random) {
            let symbolic = system.symbolic(elimination);
            let mut factor = system.factor(FactorKind::Ldlt, &symbolic);
            let (half, other_half) = picked.split_at(picked.len() / 2);
            let downwards = (half.iter().map(|&unknown| vec![(unknown, -fall)]))
                .chain([other_half.iter().map(|&unknown| (unknown, -fall)).collect()]);
            let back = picked.iter().map(|&unknown| vec![(unknown, fall)]);
            let mut negative = 0;
            for changes in downwards.chain(back).collect::<Vec<_>>() {
                let terms: Vec<RankOne> = (changes.iter())
                    .map(|&(unknown, weight)| system.add(unknown, weight))
                    .collect();
                for (_, weight) in changes {
                    negative = if weight < 0.0 {
                        negative + 1
                    } else {
                        negative - 1
                    };
                }
                let b = random.vector(n);
                factor.change(&terms, &[]).unwrap();
                let expected = Inertia {
                    positive: n - negative,
                    negative,
                };
                assert_eq!(factor.inertia(), expected);
                let eigenvalues = system.dense().symmetric_eigenvalues();
                assert_eq!(
                    eigenvalues.iter().filter(|value| **value < 0.0).count(),
                    negative
                );
                let mut anew = system.factor(FactorKind::Ldlt, &symbolic);
                assert_like_new(
                    factor.as_mut(),
                    anew.as_mut(),
                    &b,
                    bound,
                    &format!("{graph:?}"),
                );
            }
            assert_eq!(negative, 0);
        }
    }
}

/// Pairs that turn stiff or repulsive: an indefinite matrix changed to another one. The error is bounded by the growth of
/// the factor and the condition, both taken from dense matrices.
#[test]
fn an_indefinite_matrix_is_changed() {
    let mut random = Random(15);
    let mut n_indefinite = 0;
    for _ in 0..20 {
        let mut system = System::new(&Graph::lattice(5, 2.0), 3, &mut random);
        let n = system.n();
        let pairs = system.terms_of_pairs();
        let [.., order] = orders(n, &mut random);
        let symbolic = system.symbolic(order);
        for _ in 0..n / 2 {
            system.add(pairs.start + random.below(pairs.len()), -2.0);
        }
        let mut factor = system.factor(FactorKind::Ldlt, &symbolic);
        let mut growth: f64 = 0.0;
        for _ in 0..10 {
            let terms: Vec<RankOne> = (0..3)
                .map(|_| {
                    let weight = 2.0 * random.signed();
                    system.add(pairs.start + random.below(pairs.len()), weight)
                })
                .collect();
            factor.change(&terms, &[]).unwrap();
            let anew = system.factor(FactorKind::Ldlt, &symbolic);
            let eigenvalues = system.dense().symmetric_eigenvalues();
            let sizes = eigenvalues.iter().map(|value| value.abs());
            let largest_eigenvalue = sizes.clone().fold(0.0, f64::max);
            let condition = largest_eigenvalue / sizes.fold(f64::INFINITY, f64::min);
            // With unit columns no longer than |A| over the pivot, |L| |D| |L^T| is at most |A|^2 over it.
            let smallest = anew
                .pivots()
                .iter()
                .fold(f64::INFINITY, |a, b| a.min(b.abs()));
            growth = growth.max(largest_eigenvalue / smallest);
            let negative = eigenvalues.iter().filter(|value| **value < 0.0).count();
            n_indefinite += usize::from(negative > 0);
            assert_eq!(factor.inertia().negative, negative);
            let b = random.vector(n);
            let expected = solve_dense(system.dense(), &b);
            let error = difference(&solve(factor.as_mut(), &b), &expected);
            assert!(error <= condition * growth * n as f64 * EPSILON, "{error}");
        }
    }
    assert!(
        n_indefinite > 150,
        "only {n_indefinite} of 200 were indefinite"
    );
}

/// Bonds of three terms taken out, weakened, strengthened and put back, 2,000 times. Rounding of some eps a change adds up
/// like a random walk: sqrt(2,000) eps = 1e-14 (measured: 1.3e-15 with L L^T, 6e-16 with L D L^T).
#[test]
fn two_thousand_changes_keep_the_residual_small() {
    let mut random = Random(16);
    let original = System::new(&Graph::lattice(15, 2.3), 3, &mut random);
    let symbolic = original.symbolic(Elimination::MinimumDegree);
    for kind in KINDS {
        let mut system = original.clone();
        let mut factor = system.factor(kind, &symbolic);
        let bonds = system.terms_of_pairs().len() / 3;
        let mut error: f64 = 0.0;
        for step in 0..2000 {
            let first = system.terms_of_pairs().start + 3 * random.below(bonds);
            let target = [0.0, 0.3, 1.0, 2.0][random.below(4)];
            let terms: Vec<RankOne> = (first..first + 3)
                .map(|term| system.add(term, target - system.terms[term].weight))
                .collect();
            factor.change(&terms, &[]).unwrap();
            if step % 100 == 99 {
                let b = random.vector(system.n());
                let x = solve(factor.as_mut(), &b);
                error = error.max(backward_error(&system.matrix(), &x, &b));
            }
        }
        assert!(error < 1e-14, "{kind:?}: {error}");
    }
}

/// The opposite change gives the factor back.
#[test]
fn changing_back_returns() {
    let mut random = Random(17);
    let original = System::new(&Graph::lattice(9, 2.3), 3, &mut random);
    let b = random.vector(original.n());
    for elimination in orders(original.n(), &mut random) {
        let symbolic = original.symbolic(elimination);
        for kind in KINDS {
            let mut factor = original.factor(kind, &symbolic);
            let mut system = original.clone();
            let terms = random_terms(&mut system, 50, &mut random);
            factor.change(&terms, &[]).unwrap();
            let before = solve(original.factor(kind, &symbolic).as_mut(), &b);
            let changed = difference(&solve(factor.as_mut(), &b), &before);
            assert!(changed > 1e-3, "{kind:?}: nothing happened");
            let back: Vec<RankOne> = (terms.into_iter().rev())
                .map(|term| RankOne {
                    weight: -term.weight,
                    ..term
                })
                .collect();
            factor.change(&back, &[]).unwrap();
            let bound = system.condition() * (original.n() + 100) as f64 * EPSILON;
            let mut anew = original.factor(kind, &symbolic);
            assert_like_new(
                factor.as_mut(),
                anew.as_mut(),
                &b,
                bound,
                &format!("{kind:?}"),
            );
        }
    }
}
