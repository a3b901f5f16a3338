//! Largest eigenvalues of a symmetric operator that is given by its products.
//!
//! Block Lanczos with full orthogonalisation and thick restarts (Wu and Simon 2000, for blocks of one): the operator is projected on a
//! growing orthonormal basis, and a full basis is cut down to the best approximations so far. A block of two finds an eigenvalue that occurs
//! twice, as for the modes of a square plate; a single vector would find it only by rounding.

use faer::diag::Diag;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::evd::{
    ComputeEigenvectors, SelfAdjointEvdParams, self_adjoint_evd, self_adjoint_evd_scratch,
};
use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, Par, Spec};

/// Vectors multiplied by the operator together.
const BLOCK: usize = 2;

/// Number of basis vectors beyond three times the number of pairs.
const ROOM: usize = 20;

/// Relative size of the part of a vector outside the basis below which the vector lies in the basis up to rounding.
const DEPENDENT: f64 = 1e-13;

/// Eigenpairs of an operator of dimension n.
#[derive(Debug, Clone, PartialEq)]
pub struct Eigenpairs {
    /// Eigenvalues, largest first.
    pub values: Vec<f64>,
    /// Orthonormal eigenvectors, each of shape (n).
    pub vectors: Vec<Vec<f64>>,
    /// Whether all residuals |A v - value v| are below the tolerance times the eigenvalue. An eigenvalue that occurs more than twice may
    /// still be found too few times: only a count (Sylvester's law of inertia) shows it.
    pub converged: bool,
    /// Number of products with the operator.
    pub products: usize,
}

/// Settings of the eigenvalue search.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Search {
    /// Number of eigenpairs.
    pub count: usize,
    /// Ratio of residual to eigenvalue below which a pair has converged.
    pub tolerance: f64,
    /// Greatest number of products with the operator.
    pub limit: usize,
    /// Seed of the random start vectors.
    pub seed: u64,
}

/// Finds the `count` algebraically largest eigenvalues, or all `n` if those are fewer, of the symmetric operator that
/// `product` applies to a vector (n), with the result in another (n).
///
/// Everything runs on one thread in a fixed order.
pub fn largest_eigenpairs(
    n: usize,
    search: Search,
    mut product: impl FnMut(&[f64], &mut [f64]),
) -> Eigenpairs {
    let count = search.count.min(n);
    let limit_of_basis = (3 * count + ROOM).min(n);
    let mut random = Random(search.seed);
    let mut basis = Basis::start(n, limit_of_basis, &mut random);
    let mut products = 0;
    loop {
        products += basis.extend(&mut product, &mut random);
        let spans_all = basis.n_next == 0;
        let is_full = spans_all || limit_of_basis < n && basis.n_projected + BLOCK > limit_of_basis;
        let is_due = basis.n_projected >= count && products % (4 * BLOCK) < BLOCK;
        if !is_full && !is_due {
            continue;
        }
        let Some(ritz) = basis.ritz() else {
            return Eigenpairs {
                values: Vec::new(),
                vectors: Vec::new(),
                converged: false,
                products,
            };
        };
        let found = count.min(ritz.values.len());
        let converged = found == count
            && (0..found)
                .all(|pair| ritz.residuals[pair] <= search.tolerance * ritz.values[pair].abs());
        if converged || products >= search.limit || spans_all {
            let vectors = basis.combine(&ritz.vectors, found);
            return Eigenpairs {
                values: ritz.values[..found].to_vec(),
                vectors: (0..found)
                    .map(|pair| vectors.col_as_slice(pair).to_vec())
                    .collect(),
                converged,
                products,
            };
        }
        if is_full {
            // Half of the room beyond the wanted pairs keeps approximations that converge next.
            basis.restart(&ritz, (count + limit_of_basis) / 2 - BLOCK / 2);
        }
    }
}

/// Estimate of the largest eigenvalue of an operator of dimension n.
#[derive(Debug, Clone, PartialEq)]
pub struct LargestEigenvalue {
    /// Largest Rayleigh quotient v^T A v of a unit vector of the Krylov space, from below.
    pub value: f64,
    /// Residual |A v - value v|: an eigenvalue lies within it from the value.
    pub residual: f64,
    /// The unit vector v in single precision, shape (n).
    pub vector: Vec<f32>,
    /// Number of products with the operator.
    pub products: usize,
}

/// Estimates the algebraically largest eigenvalue of a symmetric operator by Lanczos' recurrence of three terms, until the residual is below the
/// tolerance times the value or the number of products reaches its limit. `None` where a product is not finite.
///
/// The value plus the residual is an upper bound in practice (Zhou and Li 2011). The vectors of
/// the recurrence lose orthogonality only once the value has converged (Paige 1971), which leaves the value right.
///
/// Everything runs on one thread in a fixed order.
pub fn largest_eigenvalue(
    n: usize,
    tolerance: f64,
    limit: usize,
    mut product: impl FnMut(&[f64], &mut [f64]),
) -> Option<LargestEigenvalue> {
    let mut random = Random(1);
    let mut vector: Vec<f64> = (0..n).map(|_| random.uniform()).collect();
    let norm = dot(&vector, &vector).sqrt();
    vector.iter_mut().for_each(|it| *it /= norm);
    let (mut previous, mut image) = (vec![0.0; n], vec![0.0; n]);
    // Diagonal and subdiagonal of the projected operator, and the vectors on which it is projected.
    let (mut diagonal, mut below) = (Vec::new(), Vec::new());
    let mut basis: Vec<Vec<f32>> = Vec::new();
    loop {
        basis.push(vector.iter().map(|it| *it as f32).collect());
        product(&vector, &mut image);
        let along = dot(&vector, &image);
        subtract(along, &vector, &mut image);
        if let Some(coupling) = below.last() {
            subtract(*coupling, &previous, &mut image);
        }
        diagonal.push(along);
        let coupling = dot(&image, &image).sqrt();
        let products = diagonal.len();
        let (values, vectors) = decomposed(products, |row, column| match row.abs_diff(column) {
            0 => diagonal[row],
            1 => below[row.min(column)],
            _ => 0.0,
        })?;
        let coefficients = vectors.col_as_slice(0);
        let (value, residual) = (values[0], coupling * coefficients[products - 1].abs());
        if !residual.is_finite() {
            return None;
        }
        if residual <= tolerance * value.abs() || products == limit.min(n) {
            let mut vector = vec![0.0; n];
            for (part, coefficient) in basis.iter().zip(coefficients) {
                let sums = vector.iter_mut().zip(part);
                sums.for_each(|(sum, it)| *sum += *coefficient as f32 * it);
            }
            return Some(LargestEigenvalue {
                value,
                residual,
                vector,
                products,
            });
        }
        below.push(coupling);
        image.iter_mut().for_each(|it| *it /= coupling);
        std::mem::swap(&mut previous, &mut vector);
        std::mem::swap(&mut vector, &mut image);
    }
}

/// An orthonormal basis, the operator projected on it, and the next block.
struct Basis {
    n: usize,
    /// Basis vectors, then the next block, shape (n, limit + BLOCK).
    vectors: Mat<f64>,
    /// Upper triangle of V^T A V, shape (limit + BLOCK, limit + BLOCK).
    projected: Mat<f64>,
    /// Number of projected columns.
    n_projected: usize,
    /// Number of columns of the next block.
    n_next: usize,
    /// Components of A times the last block along the next one, row-major.
    coupling: [[f64; BLOCK]; BLOCK],
    /// Number of columns of the last block.
    n_last: usize,
}

/// Ritz pairs: approximations from the basis, largest first.
struct Ritz {
    values: Vec<f64>,
    /// Coefficients, shape (n_projected, n_projected).
    vectors: Mat<f64>,
    /// Residuals |A v - value v|, shape (n_projected).
    residuals: Vec<f64>,
}

impl Basis {
    /// A basis whose first block is random.
    fn start(n: usize, limit: usize, random: &mut Random) -> Self {
        let mut basis = Self {
            n,
            vectors: Mat::zeros(n, limit + BLOCK),
            projected: Mat::zeros(limit + BLOCK, limit + BLOCK),
            n_projected: 0,
            n_next: 0,
            coupling: [[0.0; BLOCK]; BLOCK],
            n_last: 0,
        };
        for _ in 0..BLOCK.min(n) {
            basis.append_random(random);
        }
        basis
    }

    /// Projects the operator on the next block and makes the block after it; returns the number of products.
    fn extend(
        &mut self,
        product: &mut impl FnMut(&[f64], &mut [f64]),
        random: &mut Random,
    ) -> usize {
        let (first, width) = (self.n_projected, self.n_next);
        let end = first + width;
        let mut images = Mat::zeros(self.n, width);
        for k in 0..width {
            product(
                self.vectors.col_as_slice(first + k),
                images.col_as_slice_mut(k),
            );
        }
        // A second pass removes the part in the basis that rounding left in the images.
        for _ in 0..2 {
            let known = self.vectors.get(.., ..end);
            let mut along = Mat::<f64>::zeros(end, width);
            let (transposed, sequential) = (known.transpose(), Par::Seq);
            matmul(
                along.as_mut(),
                Accum::Replace,
                transposed,
                images.as_ref(),
                1.0,
                sequential,
            );
            matmul(
                images.as_mut(),
                Accum::Add,
                known,
                along.as_ref(),
                -1.0,
                sequential,
            );
            for column in 0..width {
                for row in 0..=first + column {
                    self.projected[(row, first + column)] += along[(row, column)];
                }
            }
        }
        (self.n_projected, self.n_last, self.n_next) = (end, width, 0);
        self.coupling = [[0.0; BLOCK]; BLOCK];
        for k in 0..width {
            self.append_image(images.col_as_slice_mut(k), k, random);
        }
        width
    }

    /// Makes the rest of an image a vector of the next block, or a random vector where the rest vanishes.
    fn append_image(&mut self, image: &mut [f64], column: usize, random: &mut Random) {
        let scale = self.projected[(self.n_projected - 1, self.n_projected - 1)].abs();
        for _ in 0..2 {
            for k in 0..self.n_next {
                let other = self.vectors.col_as_slice(self.n_projected + k);
                let along = dot(other, image);
                subtract(along, other, image);
                self.coupling[k][column] += along;
            }
        }
        let norm = dot(image, image).sqrt();
        if norm > DEPENDENT * scale && norm > f64::MIN_POSITIVE {
            self.coupling[self.n_next][column] = norm;
            image.iter_mut().for_each(|value| *value /= norm);
            self.append(image);
        } else {
            self.append_random(random);
        }
    }

    /// Appends a random vector orthogonal to all others, unless the basis spans the whole space.
    fn append_random(&mut self, random: &mut Random) {
        let end = self.n_projected + self.n_next;
        if end >= self.n {
            return;
        }
        let mut vector: Vec<f64> = (0..self.n).map(|_| random.uniform()).collect();
        // Near the whole space little remains of a random vector: passes are repeated until one removes nothing.
        loop {
            let before = dot(&vector, &vector).sqrt();
            vector.iter_mut().for_each(|value| *value /= before);
            for k in 0..end {
                let other = self.vectors.col_as_slice(k);
                subtract(dot(other, &vector), other, &mut vector);
            }
            let left = dot(&vector, &vector).sqrt();
            if left > 0.9 {
                vector.iter_mut().for_each(|value| *value /= left);
                break;
            }
            if left < DEPENDENT {
                vector
                    .iter_mut()
                    .for_each(|value| *value = random.uniform());
            }
        }
        self.append(&vector);
    }

    fn append(&mut self, vector: &[f64]) {
        let place = self.n_projected + self.n_next;
        self.vectors.col_as_slice_mut(place).copy_from_slice(vector);
        self.n_next += 1;
    }

    /// Eigenpairs of the projection, largest first, with the residuals of the approximations; none where products are not finite.
    fn ritz(&self) -> Option<Ritz> {
        let m = self.n_projected;
        let upper = |row: usize, column: usize| self.projected[(row.min(column), row.max(column))];
        let (values, vectors) = decomposed(m, upper)?;
        let residual = |pair: usize| {
            let last = m - self.n_last;
            let along = |row: &[f64; BLOCK]| -> f64 {
                let of_last = (0..self.n_last).map(|k| row[k] * vectors[(last + k, pair)]);
                of_last.sum()
            };
            let squares = self.coupling.iter().map(|row| along(row).powi(2));
            squares.sum::<f64>().sqrt()
        };
        Some(Ritz {
            values,
            residuals: (0..m).map(residual).collect(),
            vectors,
        })
    }

    /// The first `count` approximations as vectors, shape (n, count).
    fn combine(&self, coefficients: &Mat<f64>, count: usize) -> Mat<f64> {
        let mut combined = Mat::zeros(self.n, count);
        matmul(
            combined.as_mut(),
            Accum::Replace,
            self.vectors.get(.., ..self.n_projected),
            coefficients.get(.., ..count),
            1.0,
            Par::Seq,
        );
        combined
    }

    /// Cuts the basis down to the best `keep` approximations. The next block is unchanged: the projection of the operator on it will couple
    /// it with all of them.
    fn restart(&mut self, ritz: &Ritz, keep: usize) {
        let kept = self.combine(&ritz.vectors, keep);
        for column in 0..keep {
            let vector = kept.col_as_slice(column);
            self.vectors
                .col_as_slice_mut(column)
                .copy_from_slice(vector);
        }
        for k in 0..self.n_next {
            let next = self.vectors.col_as_slice(self.n_projected + k).to_vec();
            self.vectors
                .col_as_slice_mut(keep + k)
                .copy_from_slice(&next);
        }
        self.projected.fill(0.0);
        for (place, &value) in ritz.values[..keep].iter().enumerate() {
            self.projected[(place, place)] = value;
        }
        self.n_projected = keep;
    }
}

/// Eigenvalues of a symmetric matrix of order m, largest first, and its eigenvectors as columns; `None` where an entry is not finite.
fn decomposed(m: usize, entry: impl Fn(usize, usize) -> f64) -> Option<(Vec<f64>, Mat<f64>)> {
    // The decomposition reads the lower triangle and sorts ascending; the decomposition of -A gives A's eigenvalues descending.
    let lower = Mat::from_fn(m, m, |row, column| -entry(row, column));
    if !lower.is_all_finite() {
        return None;
    }
    let mut values = Diag::<f64>::zeros(m);
    let mut vectors = Mat::<f64>::zeros(m, m);
    // Divide and conquer, faer's choice from 128 on, gives wrong small last entries of the vectors, from which the residuals follow.
    let mut parameters = Spec::<SelfAdjointEvdParams, f64>::default();
    parameters.recursion_threshold = usize::MAX;
    let request =
        self_adjoint_evd_scratch::<f64>(m, ComputeEigenvectors::Yes, Par::Seq, parameters);
    let mut memory = MemBuffer::new(request);
    self_adjoint_evd(
        lower.as_ref(),
        values.as_mut(),
        Some(vectors.as_mut()),
        Par::Seq,
        MemStack::new(&mut memory),
        parameters,
    )
    .ok()?;
    let values = values.column_vector().iter().map(|value| -value).collect();
    Some((values, vectors))
}

fn dot(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(a, b)| a * b).sum()
}

/// vector -= factor * other.
fn subtract(factor: f64, other: &[f64], vector: &mut [f64]) {
    for (value, other) in vector.iter_mut().zip(other) {
        *value -= factor * other;
    }
}

/// Pseudo-random numbers in [-1, 1), the same on every machine (splitmix64).
struct Random(u64);

impl Random {
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^= z >> 31;
        (z >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}
