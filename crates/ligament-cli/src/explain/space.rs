//! Deformations of bonds in space from the stored motions of points.

use ligament_model::deformation::SpaceDeformation;
use ligament_model::element::BondDeformation;
use ligament_output::results::stored::Motions;

/// What criteria measure of a bond in space with its ends, length l and direction n: stretch s = n.du/l, size of the shear vector P du/l - phibar x n with P = I - n n^T, and
/// size of the relative rotation phi_B - phi_A; without what the temperature gives them. The points of springs do not turn, so that
/// this holds for them as well.
pub(super) fn deformed(
    ends: [u32; 2],
    (length, n): (f64, [f64; 3]),
    motions: &Motions,
) -> BondDeformation {
    let [a, b] = ends.map(|end| end as usize);
    let [u_a, u_b] = [a, b].map(|end| motions.displacement[end]);
    let [phi_a, phi_b] = [a, b].map(|end| motions.rotation[end]);
    let mut gradient = [0, 1, 2].map(|axis| (u_b[axis] - u_a[axis]) / length);
    let free = motions.thermal_strain.of_space();
    if let (Some(at_a), Some(at_b)) = (free.get(a), free.get(b)) {
        let [xx, yy, zz, xy, xz, yz] = std::array::from_fn(|k| 0.5 * (at_a[k] + at_b[k]));
        let rows = [
            [xx, 0.5 * xy, 0.5 * xz],
            [0.5 * xy, yy, 0.5 * yz],
            [0.5 * xz, 0.5 * yz, zz],
        ];
        gradient = [0, 1, 2].map(|axis| gradient[axis] - dot(rows[axis], n));
    }
    let stretch = dot(n, gradient);
    let mean = [0, 1, 2].map(|axis| 0.5 * (phi_a[axis] + phi_b[axis]));
    let turned = cross(mean, n);
    let deformation = SpaceDeformation {
        stretch,
        shear: [0, 1, 2].map(|axis| gradient[axis] - stretch * n[axis] - turned[axis]),
        rotation: [0, 1, 2].map(|axis| phi_b[axis] - phi_a[axis]),
    };
    deformation.measured()
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

#[cfg(test)]
mod tests {
    use ligament_model::thermal::FreeStrains;

    use super::*;

    /// A stretch along the bond, shears across it, a rigid turn about an axis askew to it, and free strains, by hand.
    #[test]
    fn deformations_of_uniform_motions() {
        let moved = |displacement: [f64; 3], rotation: [f64; 3]| Motions {
            displacement: vec![[0.0; 3], displacement],
            rotation: vec![rotation; 2],
            thermal_strain: FreeStrains::default(),
        };
        let strains =
            |motions: &Motions| deformed([0, 1], (1.0, [1.0, 0.0, 0.0]), motions).strains();
        assert_eq!(strains(&moved([0.5, 0.0, 0.0], [0.0; 3])), [0.5, 0.0, 0.0]);
        assert_eq!(strains(&moved([0.0, 3.0, 4.0], [0.0; 3])), [0.0, 5.0, 0.0]);
        // The turn by (1, 2, 3) moves the far end of the bond along x by (1, 2, 3) x (1, 0, 0) = (0, 3, -2).
        let turned = moved([0.0, 3.0, -2.0], [1.0, 2.0, 3.0]);
        assert_eq!(strains(&turned), [0.0, 0.0, 0.0]);
        let warm = Motions {
            thermal_strain: FreeStrains::in_space(vec![[0.25, 0.0, 0.0, 6.0, 8.0, 0.0]; 2]),
            ..moved([0.5, 0.0, 0.0], [0.0; 3])
        };
        assert_eq!(strains(&warm), [0.25, 5.0, 0.0]);
    }
}
