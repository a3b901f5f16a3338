//! Bonds by their first end.

/// First bond whose first end is each point, and the number of all bonds at the end, shape (n_points + 1), from the ends in the order of
/// [`BondSet`](super::BondSet).
pub(super) fn first_bonds(ends: &[[u32; 2]], n_points: usize) -> Vec<usize> {
    let mut first = vec![0; n_points + 1];
    for [end, _] in ends {
        first[*end as usize + 1] += 1;
    }
    for point in 0..n_points {
        first[point + 1] += first[point];
    }
    first
}
