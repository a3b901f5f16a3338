use super::*;
use crate::bonds::Incidence;
use crate::tensor::{cross, dot, tangents};

/// A bond from the origin along a direction, with axial, shear and rotational rigidity.
fn bond(along: [f64; 3], [axial, shear, rotational]: [f64; 3]) -> (BondSet<3>, Rigidities) {
    let length = dot(along, along).sqrt();
    let ends = [[0, 1]];
    let bonds = BondSet {
        incidence: Incidence::new(&ends, 2).into(),
        ends: ends.into(),
        length: vec![length],
        direction: vec![along.map(|it| it / length)],
        horizon: [length].into(),
        composition: Default::default(),
    };
    let rigidities = Rigidities {
        axial: vec![axial],
        shear: vec![shear],
        rotational: vec![rotational],
        strain: Vec::new(),
    };
    (bonds, rigidities)
}

fn beam(along: [f64; 3], rigidities: [f64; 3]) -> Pair<3, 6> {
    let (bonds, rigidities) = bond(along, rigidities);
    Pair::new(&(), &bonds, &rigidities, &[true], 0)
}

/// K from the blocks, shape (2 M, 2 M).
fn from_blocks<const M: usize>(bond: &Pair<3, M>) -> Vec<Vec<f64>> {
    let block = |row: usize, column: usize| bond.block(row / M, column / M);
    let entry = |row: usize, column: usize| block(row, column)[row % M][column % M];
    (0..2 * M)
        .map(|row| (0..2 * M).map(|column| entry(row, column)).collect())
        .collect()
}

/// K from the end forces for motions of size one, shape (2 M, 2 M), transposed.
fn from_forces<const M: usize>(bond: &Pair<3, M>) -> Vec<Vec<f64>> {
    (0..2 * M)
        .map(|column| {
            let mut motions = vec![0.0; 2 * M];
            motions[column] = 1.0;
            let deformation = bond.deformation(&motions);
            bond.forces_at_ends(&deformation).as_flattened().to_vec()
        })
        .collect()
}

/// K as the sum of its terms, shape (2 M, 2 M).
fn from_modes<const M: usize>(bond: &Pair<3, M>) -> Vec<Vec<f64>> {
    let mut sum = vec![vec![0.0; 2 * M]; 2 * M];
    for (rigidity, row) in bond.modes() {
        let row = row.as_flattened();
        for (sums, one) in sum.iter_mut().zip(row) {
            for (sum, other) in sums.iter_mut().zip(row) {
                *sum += rigidity * one * other;
            }
        }
    }
    sum
}

fn assert_close(one: &[Vec<f64>], other: &[Vec<f64>], tolerance: f64) {
    let scale = (one.iter().flatten()).fold(0.0_f64, |largest, it| largest.max(it.abs()));
    for (row, (one, other)) in one.iter().zip(other).enumerate() {
        for (column, (one, other)) in one.iter().zip(other).enumerate() {
            let error = (one - other).abs() / scale;
            assert!(error < tolerance, "({row}, {column}): {one} and {other}");
        }
    }
}

/// The 12 x 12 matrix of a beam of Euler and Bernoulli along x with EA, EI and GJ, as in textbooks,
/// without shear deformations; the motions of an end in the order x, y, z and rotations about them.
fn textbook(length: f64, [axial, bending, torsion]: [f64; 3]) -> Vec<Vec<f64>> {
    let l = length;
    let mut k = vec![vec![0.0; 12]; 12];
    let mut set = |row: usize, column: usize, value: f64| {
        k[row][column] = value;
        k[column][row] = value;
    };
    for (place, stiffness) in [(0, axial / l), (3, torsion / l)] {
        set(place, place, stiffness);
        set(place + 6, place + 6, stiffness);
        set(place, place + 6, -stiffness);
    }
    // Deflection along y turns about z, along z about y the other way round.
    for (along, about, sign) in [(1, 5, 1.0), (2, 4, -1.0)] {
        let (shear, couple) = (12.0 * bending / l.powi(3), sign * 6.0 * bending / l.powi(2));
        set(along, along, shear);
        set(along + 6, along + 6, shear);
        set(along, along + 6, -shear);
        set(along, about, couple);
        set(along, about + 6, couple);
        set(along + 6, about, -couple);
        set(along + 6, about + 6, -couple);
        set(about, about, 4.0 * bending / l);
        set(about + 6, about + 6, 4.0 * bending / l);
        set(about, about + 6, 2.0 * bending / l);
    }
    k
}

/// Rigidities k_n l, k_t l and k_theta with k_n = EA/l^2..., so that the energies are those of the beam: EA/l s^2 l^2, 12 EI/l^3 gamma^2 l^2 and
/// EI/l dphi^2, of which torsion takes its part as GJ = EI.
#[test]
fn a_bond_is_the_beam_of_textbooks() {
    let (length, axial, bending) = (0.7, 3.0, 0.4);
    let rigidities = [axial * length, 12.0 * bending / length, bending / length];
    let expected = textbook(length, [axial, bending, bending]);
    let along_x = beam([length, 0.0, 0.0], rigidities);
    assert_close(&from_blocks(&along_x), &expected, 1e-15);
    // In any other direction it is the same beam, turned: R^T K R with the rows of R along the axes of the bond.
    let n = [2.0 / 7.0, -3.0 / 7.0, 6.0 / 7.0];
    let [y, z] = tangents(n);
    let axes = [n, y, z];
    let turned = beam(n.map(|it| length * it), rigidities);
    let rotated: Vec<Vec<f64>> = (0..12)
        .map(|row| {
            let entry = |column: usize| -> f64 {
                let [own, other] = [row / 3, column / 3].map(|block| 3 * block);
                let products = (0..3).flat_map(|i| (0..3).map(move |j| (i, j)));
                products
                    .map(|(i, j)| {
                        axes[i][row % 3] * expected[own + i][other + j] * axes[j][column % 3]
                    })
                    .sum()
            };
            (0..12).map(entry).collect()
        })
        .collect();
    assert_close(&from_blocks(&turned), &rotated, 1e-14);
}

#[test]
fn blocks_forces_and_terms_are_one_stiffness() {
    let along = [0.3, -1.1, 0.2];
    for rigidities in [[5.0, 2.0, 0.3], [5.0, -2.0, -0.3]] {
        let beam = beam(along, rigidities);
        assert_close(&from_blocks(&beam), &from_forces(&beam), 1e-14);
        assert_close(&from_blocks(&beam), &from_modes(&beam), 1e-14);
        assert_eq!(beam.modes().count(), 6);
        let (bonds, rigidities) = bond(along, rigidities);
        let spring = Pair::<3, 3>::new(&(), &bonds, &rigidities, &[true], 0);
        assert_close(&from_blocks(&spring), &from_forces(&spring), 1e-14);
        assert_close(&from_blocks(&spring), &from_modes(&spring), 1e-14);
        assert_eq!(spring.modes().count(), 3);
    }
}

/// Energies of two deformations are u^T K u'/2 whatever they are, and half of K stays when half of the rigidities does.
#[test]
fn energies_are_those_of_the_stiffness() {
    let beam = beam([0.3, -1.1, 0.2], [5.0, 2.0, 0.3]);
    let motions = |seed: usize| -> Vec<f64> {
        (0..12)
            .map(|k| ((7 * k * k + seed) % 11) as f64 - 5.0)
            .collect()
    };
    let (one, other) = (motions(3), motions(8));
    let of = |u: &[f64]| beam.deformation(u);
    let stiffness = from_blocks(&beam);
    let expected: f64 = (0..144)
        .map(|place| 0.5 * one[place / 12] * stiffness[place / 12][place % 12] * other[place % 12])
        .sum();
    let found = beam.mutual_energy(&of(&one), &of(&other));
    assert!((found / expected - 1.0).abs() < 1e-14);
    let half = StiffnessFactors {
        axial: 0.5,
        shear: 0.5,
        rotational: 0.5,
    };
    let found = beam.weakened(&half).mutual_energy(&of(&one), &of(&other));
    assert!((2.0 * found / expected - 1.0).abs() < 1e-14);
}

/// A rigid motion u = a + omega x r, phi = omega is none of a micropolar bond; springs take a rotation for a shear.
#[test]
fn rigid_motions_deform_no_beam() {
    let along = [0.3, -1.1, 0.2];
    let (shift, omega) = ([1.0, -2.0, 0.5], [0.7, 0.4, -1.3]);
    let from = [2.0, -0.5, 4.0];
    let motion = |place: [f64; 3]| {
        let turned = cross(omega, place);
        let mut motion = [0.0; 6];
        for k in 0..3 {
            motion[k] = shift[k] + turned[k];
            motion[3 + k] = omega[k];
        }
        motion
    };
    let to = [0, 1, 2].map(|k| from[k] + along[k]);
    let (a, b) = (motion(from), motion(to));
    let deformation = beam(along, [5.0, 2.0, 0.3]).between(&a, &b);
    let size = |it: [f64; 3]| dot(it, it).sqrt();
    assert!(deformation.stretch.abs() < 1e-14 && size(deformation.shear) < 1e-14);
    assert_eq!(deformation.rotation, [0.0; 3]);
    let (bonds, rigidities) = bond(along, [5.0, 2.0, 0.0]);
    let spring = Pair::<3, 3>::new(&(), &bonds, &rigidities, &[true], 0).between(&a[..3], &b[..3]);
    let across = cross(omega, bonds.direction[0]);
    assert!((size(spring.shear) - size(across)).abs() < 1e-14);
}

/// A uniform strain is the deformation of the displacements eps r, and its dyad over it twice the energy: sigma . eps = 2 e.
#[test]
fn uniform_strains() {
    let along = [0.3, -1.1, 0.2];
    let beam = beam(along, [5.0, 2.0, 0.3]);
    let [xx, yy, zz, xy, xz, yz] = [0.3, -0.2, 0.5, 0.7, -0.4, 0.9];
    let [x, y, z] = along;
    let moved = [
        xx * x + 0.5 * (xy * y + xz * z),
        yy * y + 0.5 * (xy * x + yz * z),
        zz * z + 0.5 * (xz * x + yz * y),
    ];
    let end_b = [moved[0], moved[1], moved[2], 0.0, 0.0, 0.0];
    let expected = beam.between(&[0.0; 6], &end_b);
    let strain = SymTensor::from_engineering(&[xx, yy, xy, zz, xz, yz]);
    let found = beam.deformation_in(&strain);
    let off = expected.less(&found).measured();
    assert!(off.strains().iter().all(|it| it.abs() < 1e-15), "{off:?}");
    let work = beam.dyad(&found).contracted(&strain);
    assert!((work / (2.0 * beam.mutual_energy(&found, &found)) - 1.0).abs() < 1e-14);
}
