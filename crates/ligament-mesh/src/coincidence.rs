//! Nodes at one place.

/// Distance along every axis, relative to the size of the mesh, below which nodes coincide.
const COINCIDENCE: f64 = 1e-12;

/// Side of a bin of nodes over the distance of coincident nodes: few nodes are near the border of their bin.
const BIN: f64 = 1e6;

/// Number of nodes that are compared with a node at most, before nodes are sorted instead.
const COMPARED: usize = 64;

/// An empty place of a table.
const EMPTY: u32 = u32::MAX;

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
    let n_sets = match are_apart(positions, lowest, width) {
        true => 0,
        false => 1 << across,
    };
    // Two sets of strips are shifted by half a width (in space, four sets of columns): near nodes share a strip of one set, in which they
    // are adjacent along the last axis.
    (0..n_sets).flat_map(move |shifted: usize| {
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

/// Whether a table of the nodes by their bins shows that no two nodes are within a width along every axis. Bins with many nodes show nothing.
fn are_apart<const D: usize>(positions: &[[f64; D]], lowest: [f64; D], width: f64) -> bool {
    if positions.len() >= EMPTY as usize / 2 || width <= 0.0 {
        return false;
    }
    let slots = (2 * positions.len()).next_power_of_two();
    let mut table = vec![EMPTY; slots];
    // Wider than the rounding of strips.
    let reach = 2.0 * width;
    for (node, position) in (0..).zip(positions) {
        let bin = |shift: f64| -> [i64; D] {
            let along = |axis: usize| (position[axis] - lowest[axis] + shift) / (BIN * width);
            std::array::from_fn(|axis| along(axis).floor() as i64)
        };
        let (own, ends) = (bin(0.0), [bin(-reach), bin(reach)]);
        let mut free = None;
        for corner in 0..1_usize << D {
            let near: [i64; D] = std::array::from_fn(|axis| ends[corner >> axis & 1][axis]);
            // Bins of several corners are looked at once.
            let is_repeated =
                (0..D).any(|axis| corner >> axis & 1 == 1 && ends[0][axis] == ends[1][axis]);
            if is_repeated {
                continue;
            }
            let mut slot = hash(near) & (slots - 1);
            let mut compared = 0;
            while table[slot] != EMPTY {
                let other = positions[table[slot] as usize];
                let is_near = (0..D).all(|axis| (other[axis] - position[axis]).abs() <= reach);
                if is_near || compared == COMPARED {
                    return false;
                }
                compared += 1;
                slot = (slot + 1) & (slots - 1);
            }
            if near == own {
                free = Some(slot);
            }
        }
        if let Some(slot) = free {
            table[slot] = node;
        }
    }
    true
}

/// A number that differs for different bins as a rule (Fibonacci hashing, D. E. Knuth, The Art of Computer Programming 3, section 6.4).
fn hash<const D: usize>(bin: [i64; D]) -> usize {
    const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;
    let mixed = bin.iter().fold(0, |mixed: u64, it| {
        (mixed.rotate_left(32) ^ *it as u64).wrapping_mul(GOLDEN)
    });
    (mixed >> 32) as usize
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
