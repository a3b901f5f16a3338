//! The action of terms on columns of a factor.

use pulp::Simd;

/// Columns of a panel that are updated together.
pub(super) const BLOCK: usize = 4;

/// The action of a term on a column l of the factor, below the diagonal: w <- w - c l, then l <- p l + q w.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Rotation {
    pub(super) c: f64,
    pub(super) p: f64,
    pub(super) q: f64,
}

/// Applies the rotations of terms (n_terms), one after the other, to the rows `from` and below of a block of columns, in pairs of terms: the
/// columns are then read and written half as often.
#[inline(always)]
pub(super) fn rotate_rows<S: Simd>(
    simd: S,
    block: &mut [&mut [f64]],
    from: usize,
    terms: &mut [&mut [f64]],
    rotations: &[[Rotation; BLOCK]],
) {
    match block.len() {
        4 => in_pairs::<S, 4>(simd, block, from, terms, rotations),
        3 => in_pairs::<S, 3>(simd, block, from, terms, rotations),
        2 => in_pairs::<S, 2>(simd, block, from, terms, rotations),
        _ => in_pairs::<S, 1>(simd, block, from, terms, rotations),
    }
}

#[inline(always)]
fn in_pairs<S: Simd, const WIDTH: usize>(
    simd: S,
    block: &mut [&mut [f64]],
    from: usize,
    terms: &mut [&mut [f64]],
    rotations: &[[Rotation; BLOCK]],
) {
    let mut pairs = terms.chunks_exact_mut(2);
    let mut of_pairs = rotations.chunks_exact(2);
    for (pair, rotations) in (&mut pairs).zip(&mut of_pairs) {
        if let ([one, other], &[of_one, of_other]) = (pair, rotations) {
            let pair = [&mut one[from..], &mut other[from..]];
            apply::<S, WIDTH, 2>(simd, block, from, pair, &[of_one, of_other]);
        }
    }
    if let ([rotations], [w]) = (of_pairs.remainder(), pairs.into_remainder()) {
        apply::<S, WIDTH, 1>(simd, block, from, [&mut w[from..]], &[*rotations]);
    }
}

/// Applies the rotations of some terms, one after the other, to the rows `from` and below of a block of columns.
#[inline(always)]
fn apply<S: Simd, const WIDTH: usize, const TERMS: usize>(
    simd: S,
    block: &mut [&mut [f64]],
    from: usize,
    terms: [&mut [f64]; TERMS],
    rotations: &[[Rotation; BLOCK]; TERMS],
) {
    let n_rows = terms[0].len();
    let mut terms = terms.map(|w| S::as_mut_simd_f64s(w));
    let mut columns = block.iter_mut();
    let mut columns: [_; WIDTH] = std::array::from_fn(|_| {
        let column = columns.next().map_or(&mut [][..], |column| column);
        S::as_mut_simd_f64s(&mut column[from..from + n_rows])
    });
    let splat = |part: fn(&Rotation) -> f64| -> [[_; WIDTH]; TERMS] {
        std::array::from_fn(|t| std::array::from_fn(|k| simd.splat_f64s(part(&rotations[t][k]))))
    };
    let (c, p, q) = (splat(|r| r.c), splat(|r| r.p), splat(|r| r.q));
    let n_vectors = terms[0].0.len();
    for w in &terms {
        assert_eq!(w.0.len(), n_vectors);
    }
    for column in &columns {
        assert_eq!(column.0.len(), n_vectors);
    }
    for r in 0..n_vectors {
        let mut values: [_; TERMS] = std::array::from_fn(|t| terms[t].0[r]);
        for k in 0..WIDTH {
            let mut l = columns[k].0[r];
            for t in 0..TERMS {
                values[t] = simd.negate_mul_add_e_f64s(c[t][k], l, values[t]);
                l = simd.mul_add_e_f64s(q[t][k], values[t], simd.mul_f64s(p[t][k], l));
            }
            columns[k].0[r] = l;
        }
        for t in 0..TERMS {
            terms[t].0[r] = values[t];
        }
    }
    for (w, rotations) in terms.iter_mut().zip(rotations) {
        for (r, w) in w.1.iter_mut().enumerate() {
            for (column, rotation) in columns.iter_mut().zip(rotations) {
                let l = &mut column.1[r];
                *w -= rotation.c * *l;
                *l = rotation.p * *l + rotation.q * *w;
            }
        }
    }
}

/// One step of L D L^T + c w w^T at a pivot d: d' = d + c w^2, c' = c d/d' (Gill 1974, method C1). Returns the rotation of the column, and
/// d'; the result is unusable where d' vanishes.
#[inline(always)]
pub(super) fn rotate(pivot: &mut f64, weight: &mut f64, w: f64) -> (Rotation, f64) {
    let old = *pivot;
    let new = old + *weight * w * w;
    let q = *weight * w / new;
    *weight *= old / new;
    *pivot = new;
    (Rotation { c: w, p: 1.0, q }, new)
}

/// The step of [`rotate`] for a factor with the square root of the pivot on the diagonal, each column being that root times the column of a
/// unit L. The result is unusable where the new pivot is not positive.
#[inline(always)]
pub(super) fn rotate_root(root: &mut f64, weight: &mut f64, w: f64) -> (Rotation, f64) {
    let old = *root;
    let new = old * old + *weight * w * w;
    let new_root = new.sqrt();
    let q = *weight * w / new_root;
    *weight *= old * old / new;
    *root = new_root;
    let rotation = Rotation {
        c: w / old,
        p: new_root / old,
        q,
    };
    (rotation, new)
}
