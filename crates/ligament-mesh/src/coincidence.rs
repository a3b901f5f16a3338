//! Nodes at one place.

/// Distance along every axis, relative to the size of the mesh, below which nodes coincide.
const COINCIDENCE: f64 = 1e-12;

/// Longest side of the box around positions, m.
pub(crate) fn size<const D: usize>(positions: impl Iterator<Item = [f64; D]> + Clone) -> f64 {
    let extent = |axis: usize| {
        let values = positions.clone().map(|it| it[axis]);
        values.clone().fold(f64::NEG_INFINITY, f64::max) - values.fold(f64::INFINITY, f64::min)
    };
    (0..D).map(extent).fold(0.0, f64::max)
}

/// Pairs of coincident nodes, ascending within a pair; a pair may be repeated. Nodes that are nearer than half the tolerance along each axis
/// are always found, if need be by a chain of pairs, nodes farther apart than the tolerance never.
pub(crate) fn coincident_pairs<const D: usize>(
    positions: &[[f64; D]],
) -> impl Iterator<Item = [u32; 2]> {
    let width = COINCIDENCE * size(positions.iter().copied());
    let lowest: [f64; D] = std::array::from_fn(|axis| {
        let values = positions.iter().map(|it| it[axis]);
        values.fold(f64::INFINITY, f64::min)
    });
    let across = D - 1;
    // Two sets of strips are shifted by half a width (in space, four sets of columns): near nodes share a strip of one set, in which they
    // are adjacent along the last axis.
    (0..1 << across).flat_map(move |shifted: usize| {
        let place = |position: &[f64; D], axis: usize| {
            let shift = if (shifted >> axis) & 1 == 1 { 0.5 } else { 0.0 };
            ((position[axis] - lowest[axis]) / width + shift).floor() as i64
        };
        let placed = |(node, position): (u32, &[f64; D])| {
            let strip = [0, 1].map(|axis| {
                if axis < across {
                    place(position, axis)
                } else {
                    0
                }
            });
            (strip, position[across], node)
        };
        let mut sorted: Vec<([i64; 2], f64, u32)> = (0..).zip(positions).map(placed).collect();
        sorted.sort_unstable_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.cmp(&b.2)));
        let pairs = sorted.windows(2);
        let near = pairs.filter(|pair| pair[0].0 == pair[1].0 && pair[1].1 - pair[0].1 <= width);
        let near: Vec<[u32; 2]> = near
            .map(|pair| [pair[0].2.min(pair[1].2), pair[0].2.max(pair[1].2)])
            .collect();
        near
    })
}

/// The lowest of the nodes at the place of each node, shape (n_nodes); `None` where no nodes coincide.
pub(crate) fn lowest_at_place<const D: usize>(positions: &[[f64; D]]) -> Option<Vec<u32>> {
    let mut pairs = coincident_pairs(positions).peekable();
    pairs.peek()?;
    let mut lowest: Vec<u32> = (0..positions.len() as u32).collect();
    let root = |lowest: &[u32], node: u32| {
        let mut roots = std::iter::successors(Some(node), |it| Some(lowest[*it as usize]));
        roots.find(|it| lowest[*it as usize] == *it)
    };
    for pair in pairs {
        if let [Some(a), Some(b)] = pair.map(|node| root(&lowest, node)) {
            lowest[a.max(b) as usize] = a.min(b);
        }
    }
    // A lower node leads to its root first.
    for node in 0..lowest.len() {
        lowest[node] = lowest[lowest[node] as usize];
    }
    Some(lowest)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nodes_at_one_place_have_their_lowest_node() {
        let far = [5.0, 5.0];
        let near = [1.0 + 2e-12, 1.0 - 2e-12];
        let positions = [
            [0.0, 0.0],
            [1.0, 1.0],
            far,
            [1.0, 1.0],
            [0.0, 0.0],
            near,
            [1.0, 1.0],
        ];
        assert_eq!(lowest_at_place(&positions), Some(vec![0, 1, 2, 1, 0, 1, 1]));
        assert_eq!(lowest_at_place(&[[0.0, 0.0], [1.0, 1.0], far]), None);
        assert_eq!(lowest_at_place::<2>(&[]), None);
    }

    /// Nodes on either side of the border of two columns, along every axis.
    #[test]
    fn borders_of_columns_do_not_part_nodes() {
        for axis in 0..3 {
            for steps in 0..40 {
                let mut positions = [[0.0; 3], [1.0; 3], [0.5; 3], [0.5; 3]];
                // Tenths of the tolerance.
                positions[2][axis] += 1e-13 * f64::from(steps);
                positions[3][axis] += 1e-13 * f64::from(steps + 4);
                let lowest = lowest_at_place(&positions);
                assert_eq!(lowest, Some(vec![0, 1, 2, 2]), "{axis} {steps}");
            }
        }
    }
}
