//! Changes that leave no factor, and what comes after them.

use std::sync::Arc;

use ligament_linalg::{Elimination, FactorError, FactorKind, Factorisation, RankOne, Symbolic};

use super::EPSILON;
use super::systems::*;

fn is_refused(kind: FactorKind, error: &FactorError) -> bool {
    match kind {
        FactorKind::Llt => matches!(error, FactorError::NotPositiveDefinite { .. }),
        FactorKind::Ldlt => matches!(error, FactorError::ZeroPivot { .. }),
    }
}

/// After an error, making the factor again gives the bits of one that never failed, now and after further changes: nothing
/// of the failed change is left anywhere.
fn assert_recovers(
    factor: &mut dyn Factorisation,
    kind: FactorKind,
    system: &System,
    symbolic: &Arc<Symbolic>,
    random: &mut Random,
) {
    let mut untouched = system.factor(kind, symbolic);
    factor.refactorise(&system.matrix()).unwrap();
    let later: Vec<RankOne> = (0..3)
        .map(|_| RankOne {
            weight: 0.5,
            ..system.terms[random.below(system.terms.len())].clone()
        })
        .collect();
    let b = random.vector(system.n());
    for terms in [&[], &later[..], &later[..1]] {
        let [x, expected] = [&mut *factor, untouched.as_mut()].map(|factor| {
            let half_solved = factor.change(terms, &listed(&b)[..b.len().min(3)]).unwrap();
            let mut results = factor.finish(half_solved);
            results.extend(factor.pivots());
            results.extend(solve(factor, &b));
            results
        });
        assert_eq!(bits(&x), bits(&expected), "{kind:?}");
        assert_eq!(factor.inertia(), untouched.inertia());
    }
}

/// L L^T of a matrix that would become indefinite is an error, for any unknown and any of many terms.
#[test]
fn llt_refuses_to_become_indefinite() {
    let mut random = Random(21);
    for (graph, components) in [
        (Graph::new(1, []), 1),
        (Graph::chain(5).beside(&Graph::complete(4)), 1),
        (Graph::lattice(5, 2.0), 3),
    ] {
        let system = System::new(&graph, components, &mut random);
        for elimination in orders(system.n(), &mut random) {
            let symbolic = system.symbolic(elimination);
            let mut factor = system.factor(FactorKind::Llt, &symbolic);
            for unknown in 0..system.n() {
                let mut terms = vec![system.terms[0].clone(); random.below(40)];
                let place = random.below(terms.len() + 1);
                let fall = RankOne {
                    weight: -1.01 * (system.matrix().diagonal(unknown) + terms.len() as f64),
                    entries: vec![(unknown, 1.0)],
                };
                terms.insert(place, fall);
                let error = factor.change(&terms, &[]).unwrap_err();
                assert!(is_refused(FactorKind::Llt, &error), "{error}");
                assert_recovers(
                    factor.as_mut(),
                    FactorKind::Llt,
                    &system,
                    &symbolic,
                    &mut random,
                );
            }
        }
    }
}

/// A chain of springs loses its only support: the remaining pivot is only rounding, and is detected as such, in any
/// order of elimination.
#[test]
fn a_matrix_that_becomes_singular_is_refused() {
    let mut random = Random(22);
    for n in [1, 2, 3, 10, 57] {
        let mut system = System::new(&Graph::chain(n), 1, &mut random);
        for term in &mut system.terms {
            if let [(_, a), (_, b)] = &mut term.entries[..] {
                (*a, *b) = (1.0, -1.0);
            } else {
                term.weight = 0.0;
            }
        }
        system.terms[n / 2].weight = GROUND;
        let all = RankOne {
            weight: -GROUND,
            ..system.terms[n / 2].clone()
        };
        for _ in 0..10 {
            let symbolic = system.symbolic(Elimination::Given(random.permutation(n)));
            for kind in KINDS {
                let mut factor = system.factor(kind, &symbolic);
                // All at once, or in parts that do not add up to the bit.
                let error = factor.change(std::slice::from_ref(&all), &[]).unwrap_err();
                assert!(is_refused(kind, &error), "{kind:?} {error}");
                assert_recovers(factor.as_mut(), kind, &system, &symbolic, &mut random);
                let parts = [0.3, 0.3, 0.1, 0.3].map(|part| RankOne {
                    weight: -GROUND * part,
                    ..all.clone()
                });
                factor.refactorise(&system.matrix()).unwrap();
                let outcome = parts.map(|part| factor.change(&[part], &[]).err());
                let last = outcome.into_iter().flatten().next();
                assert!(
                    last.is_some_and(|error| is_refused(kind, &error)),
                    "{kind:?} {n}"
                );
            }
        }
    }
}

/// The terms that remove all stiffness of a point, its own diagonal last.
fn cut_loose(system: &System, point: usize) -> Vec<RankOne> {
    let of_point = |unknown: usize| unknown / system.components == point;
    let terms = system.terms.iter();
    let touching = terms.filter(|term| term.entries.iter().any(|&(unknown, _)| of_point(unknown)));
    touching
        .rev()
        .map(|term| RankOne {
            weight: -term.weight,
            ..term.clone()
        })
        .collect()
}

/// A point that loses all its bonds, in one change or in one for each term, is an error: its pivots are rounding.
#[test]
fn a_point_cut_loose_is_refused() {
    let mut random = Random(23);
    let system = System::new(&Graph::lattice(6, 2.0), 3, &mut random);
    for elimination in orders(system.n(), &mut random) {
        let symbolic = system.symbolic(elimination);
        for kind in KINDS {
            for point in 0..system.n() / system.components {
                for at_once in [1, 5, usize::MAX] {
                    let mut factor = system.factor(kind, &symbolic);
                    let terms = cut_loose(&system, point);
                    let mut chunks = terms.chunks(at_once.min(terms.len())).enumerate();
                    let (at, error) = chunks
                        .find_map(|(at, terms)| Some((at, factor.change(terms, &[]).err()?)))
                        .unwrap();
                    assert!(is_refused(kind, &error), "{kind:?} {error}");
                    // Without the bonds, the first of the three terms on the diagonal makes a pivot vanish.
                    assert_eq!(at, (terms.len() - 3) / at_once, "{kind:?} {at_once}");
                    if point % 7 == 0 {
                        assert_recovers(factor.as_mut(), kind, &system, &symbolic, &mut random);
                    }
                }
            }
        }
    }
}

/// A point that is fixed before its bonds are removed: the rest is solved as if the point had never existed, and the point itself
/// does not move. The fixing term is of the size of the diagonal, so that rounding loses only some eps.
#[test]
fn a_point_that_is_held_first_may_be_cut_loose() {
    let mut random = Random(24);
    let original = System::new(&Graph::lattice(6, 2.0), 3, &mut random);
    let n = original.n();
    for elimination in orders(n, &mut random) {
        let symbolic = original.symbolic(elimination);
        for kind in KINDS {
            for point in [0, 7, 14, 35] {
                let unknowns = 3 * point..3 * point + 3;
                let hold = |unknown: usize| RankOne {
                    weight: original.matrix().diagonal(unknown),
                    entries: vec![(unknown, 1.0)],
                };
                let mut terms: Vec<RankOne> = unknowns.clone().map(hold).collect();
                terms.extend(cut_loose(&original, point));
                let mut system = original.clone();
                system.terms.extend(terms.iter().cloned());
                let mut b = random.vector(n);
                b[unknowns.clone()].fill(0.0);
                let mut factor = original.factor(kind, &symbolic);
                let half_solved = factor.change(&terms, &listed(&b)).unwrap();
                let x = factor.finish(half_solved);
                let mut rest = original.clone();
                rest.terms.retain(|term| {
                    !(term.entries.iter()).any(|(unknown, _)| unknowns.contains(unknown))
                });
                rest.terms.extend(unknowns.clone().map(hold));
                let expected = solve_dense(rest.dense(), &b);
                let bound = original.condition() * (n + terms.len()) as f64 * EPSILON;
                assert!(difference(&x, &expected) < bound, "{kind:?}");
                assert!(largest(x[unknowns].iter().copied()) < bound * largest(x.clone()));
            }
        }
    }
}

/// Terms are applied one after the other: a fixing term that comes too late does not restore a lost pivot.
#[test]
fn a_hold_that_comes_last_is_too_late() {
    let mut random = Random(25);
    let system = System::new(&Graph::lattice(6, 2.0), 3, &mut random);
    for elimination in orders(system.n(), &mut random) {
        let symbolic = system.symbolic(elimination);
        for kind in KINDS {
            for point in [0, 7, 14, 35] {
                let mut terms = cut_loose(&system, point);
                terms.extend((3 * point..3 * point + 3).map(|unknown| RankOne {
                    weight: system.matrix().diagonal(unknown),
                    entries: vec![(unknown, 1.0)],
                }));
                let mut factor = system.factor(kind, &symbolic);
                let error = factor.change(&terms, &[]).unwrap_err();
                assert!(is_refused(kind, &error), "{kind:?} {error}");
            }
        }
    }
}

/// Terms that are NaN or infinite are errors and leave the factor unchanged.
#[test]
fn terms_that_are_no_numbers_are_refused() {
    let mut random = Random(26);
    let system = System::new(
        &Graph::lattice(5, 2.0).beside(&Graph::chain(3)),
        2,
        &mut random,
    );
    for elimination in orders(system.n(), &mut random) {
        let symbolic = system.symbolic(elimination);
        for kind in KINDS {
            for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                for in_weight in [true, false] {
                    let mut factor = system.factor(kind, &symbolic);
                    let pairs = system.terms_of_pairs();
                    let mut terms: Vec<RankOne> = (0..35)
                        .map(|_| system.terms[pairs.start + random.below(pairs.len())].clone())
                        .collect();
                    let term = &mut terms[random.below(35)];
                    if in_weight {
                        term.weight = bad;
                    } else {
                        term.entries[1].1 = bad;
                    }
                    let error = factor.change(&terms, &[(0, 1.0)]).unwrap_err();
                    assert!(is_refused(kind, &error), "{kind:?} {bad} {error}");
                    assert_recovers(factor.as_mut(), kind, &system, &symbolic, &mut random);
                }
            }
        }
    }
}
