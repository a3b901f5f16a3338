//! The bonds of which a point is the first end.

/// First of the bonds of which each point is the first end, and behind the last point the number of all, from the ends in the order of
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
