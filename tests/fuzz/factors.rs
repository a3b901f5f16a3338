//! Matrices of any numbers, factorised.

use std::sync::Arc;

use ligament_linalg::{
    Elimination, FactorKind, Factorisation, Pattern, RankOne, Symbolic, SymmetricMatrix,
};

use crate::Target;

/// A pattern and the values on it, in the bytes of the input.
pub(crate) struct Factors;

/// Unknowns at most.
const MOST: usize = 40;

/// Numbers taken from bytes until there are none.
struct Numbers<'a>(&'a [u8]);

impl Numbers<'_> {
    fn byte(&mut self) -> u8 {
        let (&first, rest) = self.0.split_first().unwrap_or((&0, &[]));
        self.0 = rest;
        first
    }

    /// Mostly a tame number, sometimes any bits.
    fn number(&mut self) -> f64 {
        match self.byte() {
            kind @ 0..250 => f64::from(kind) / 64.0 - 1.9,
            _ => f64::from_bits(u64::from_le_bytes([0; 8].map(|_: u8| self.byte()))),
        }
    }
}

impl Target for Factors {
    fn name(&self) -> &'static str {
        "factor"
    }

    fn seeds(&self) -> Vec<Vec<u8>> {
        let ramp = |step: usize| (0..400).map(|k| (k * step % 251) as u8).collect();
        let mut seeds: Vec<Vec<u8>> = [1, 7, 31, 113].map(ramp).to_vec();
        seeds.push(vec![249; 300]);
        seeds
    }

    fn read(&mut self, input: &[u8]) -> bool {
        let mut numbers = Numbers(input);
        if numbers.byte() % 8 == 7 {
            // A pattern of any indices: most are refused.
            let starts = (0..numbers.byte() % 8)
                .map(|_| usize::from(numbers.byte() % 16))
                .collect();
            let rows = (0..numbers.byte() % 16)
                .map(|_| usize::from(numbers.byte() % 8))
                .collect();
            return Pattern::new(starts, rows).is_ok();
        }
        let n = 1 + usize::from(numbers.byte()) % MOST;
        let (mut starts, mut rows) = (vec![0], Vec::new());
        for column in 0..n {
            rows.extend((0..column).filter(|_| numbers.byte().is_multiple_of(3)));
            rows.push(column);
            starts.push(rows.len());
        }
        let pattern = Arc::new(Pattern::new(starts, rows).unwrap());
        let mut matrix = SymmetricMatrix::zero(pattern.clone());
        let tame = f64::from(numbers.byte() % 2) * n as f64;
        matrix.values.fill_with(|| numbers.number());
        matrix.add_diagonal(tame, &vec![2.0; n]);
        let elimination = match numbers.byte() % 2 {
            0 => Elimination::MinimumDegree,
            _ => Elimination::Given((0..n).rev().collect()),
        };
        let Ok(symbolic) = Symbolic::analyse(pattern, elimination) else {
            return false;
        };
        let symbolic = Arc::new(symbolic);
        let kinds = [FactorKind::Llt, FactorKind::Ldlt];
        let factors = kinds.map(|kind| kind.factorise(&symbolic, &matrix));
        let accepted = factors.iter().any(Result::is_ok);
        for mut factor in factors.into_iter().flatten() {
            use_factor(&mut *factor, n, &mut numbers);
        }
        accepted
    }
}

/// A factor that was accepted has pivots, all of them numbers; it solves, and changes or refuses to.
fn use_factor(factor: &mut dyn Factorisation, n: usize, numbers: &mut Numbers<'_>) {
    let pivots = factor.pivots();
    assert!(
        pivots
            .iter()
            .all(|pivot| pivot.is_finite() && *pivot != 0.0),
        "{pivots:?}"
    );
    let inertia = factor.inertia();
    assert_eq!(inertia.positive + inertia.negative, n);
    factor.solve_in_place(&mut vec![1.0; n]);
    let mut entries: Vec<(usize, f64)> = (0..n)
        .filter(|_| numbers.byte().is_multiple_of(8))
        .map(|unknown| (unknown, 1.0))
        .collect();
    entries.truncate(6);
    let term = RankOne {
        weight: numbers.number(),
        entries,
    };
    if let Ok(half) = factor.change(&[term], &[(0, 1.0)]) {
        assert_eq!(factor.finish(half).len(), n);
    }
}
