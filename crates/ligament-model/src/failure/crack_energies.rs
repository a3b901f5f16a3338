//! Critical stretch and critical angle of the bonds of a lattice with strains of their own, from the fracture energies
//! (MBB-PD: Masoumi, Ravandi and Salehi, section 2.4 and appendix C).
//!
//! A crack along a row, as long as a cell is wide, cuts q bonds of each offset (p, q) with q > 0, to either side p and -p (Fig. 8; the
//! offset is (p dx, q dy) where cells are rectangles);
//! that is what the printed 12 and 32 for m = 3 stand for, each counted once: 6 vertical bonds and 12 others. The weight of a bond
//! is that far from all edges, and its strain energy 1/2 psi V^2 abs(xi) S^T c S.

use nalgebra::Matrix3;

use crate::horizon::INCLUSION_TOLERANCE;

/// Strains that the bonds of the lattice resist.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Components {
    /// Each bond resists all three strains.
    All,
    /// Bonds along x and along y resist only the strain in their own direction, all others resist all three strains.
    OwnRows,
}

/// A lattice far from its edges.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lattice {
    /// Distances of the columns and of the rows, m.
    pub spacing: [f64; 2],
    /// Horizon, m.
    pub horizon: f64,
    /// Thickness of the body, m.
    pub thickness: f64,
    /// Strains that the bonds resist.
    pub components: Components,
}

/// Fracture energies of a crack in its modes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Toughness {
    /// G_Ic of opening, J/m^2.
    pub opening: f64,
    /// G_IIc of sliding, J/m^2.
    pub sliding: f64,
}

/// Critical stretches and angles of the bonds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// Critical stretches of mode I s_I for a crack that opens along x, and along y.
    pub stretch: [f64; 2],
    /// Critical angles of mode II gamma_II for a crack that lies across x, and across y, rad.
    pub angle: [f64; 2],
}

/// Sums over the bonds of a lattice that a crack cuts. The energy of the crack per area is the sum, J/m^2, times the square
/// of the strain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CrackEnergies {
    /// Sums for cracks that open along x and along y, per squared stretch.
    pub opening: [f64; 2],
    /// Sums for cracks across x and across y that slide, per squared angle.
    pub sliding: [f64; 2],
}

impl Lattice {
    /// Offsets (p, q) of the bonds of a point in spacings, half of them: q > 0, or q = 0 and p > 0.
    pub fn offsets(&self) -> Vec<[i32; 2]> {
        let horizon = self.horizon / self.spacing[0] * (1.0 + INCLUSION_TOLERANCE);
        let [columns, rows] = [horizon, horizon / self.height()].map(|reach| reach as i32);
        let is_inside = |offset: &[i32; 2]| self.length(*offset) <= horizon;
        (0..=rows)
            .flat_map(|q| (-columns..=columns).map(move |p| [p, q]))
            .filter(|[p, q]| *q > 0 || *p > 0)
            .filter(is_inside)
            .collect()
    }

    /// Height of a cell over its width.
    fn height(&self) -> f64 {
        self.spacing[1] / self.spacing[0]
    }

    /// Length of the bond with an offset in spacings, in widths of a cell.
    fn length(&self, [p, q]: [i32; 2]) -> f64 {
        f64::from(p).hypot(f64::from(q) * self.height())
    }

    /// Energies of cracks along the rows for the stiffness c of the plane (Pa).
    ///
    /// Opening along y (C.4), with the sums K_i = psi_i (c_i1 + c_i2) of the rows of the stiffness, K_6 = psi_6 c_66, the effective
    /// Poisson's ratio nu, and the angle theta of a bond to the crack, 0 to 90 degrees:
    ///
    /// G = s^2 V^2/(2 dx h) sum q [vertical: K_2 abs(xi_y); others: (nu^2 K_1 + 1/2 K_6 tan(theta) sin^2(theta)) abs(xi_x) +
    ///     (K_2 + 1/2 K_6 cot(theta) sin^2(theta)) abs(xi_y)].
    ///
    /// nu is the contraction of the body along the crack under stress across it, -S_12/S_22 of the compliance: nu itself in plane
    /// stress, nu/(1 - nu) in plane strain. c_16 and c_26 are in no row sum: what they add to the bond (p, q) they take from (-p, q),
    /// whose shear has the other sign. A crack along y is one along x with the axes exchanged.
    ///
    /// Sliding, from (C.1) with the strain (0, 0, gamma) of all bonds that resist it, in place of (C.7):
    ///
    /// G = gamma^2 V^2/(2 dx h) psi_6 c_66 sum q abs(xi).
    pub fn crack_energies(&self, stiffness: &Matrix3<f64>) -> CrackEnergies {
        let exchange = Matrix3::new(0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0);
        let exchanged = exchange * stiffness * exchange;
        let [dx, dy] = self.spacing;
        let upright = Self {
            spacing: [dy, dx],
            ..*self
        };
        let (offsets, of_upright) = (self.offsets(), upright.offsets());
        CrackEnergies {
            opening: [
                upright.opening(&of_upright, &exchanged),
                self.opening(&offsets, stiffness),
            ],
            sliding: [
                upright.sliding(&of_upright, &exchanged),
                self.sliding(&offsets, stiffness),
            ],
        }
    }

    fn opening(&self, offsets: &[[i32; 2]], c: &Matrix3<f64>) -> f64 {
        // Poisson's ratio by Cramer's rule, which also holds where the compliance is all but singular.
        let poisson = (c[(0, 1)] * c[(2, 2)] - c[(0, 2)] * c[(1, 2)])
            / (c[(0, 0)] * c[(2, 2)] - c[(0, 2)] * c[(0, 2)]);
        let [psi_axial, psi_shear] = self.densities(offsets);
        let row_1 = psi_axial * (c[(0, 0)] + c[(0, 1)]);
        let row_2 = psi_axial * (c[(0, 1)] + c[(1, 1)]);
        let row_6 = psi_shear * c[(2, 2)];
        self.over_crack(offsets, |[x, y], length| {
            if x == 0.0 {
                return row_2 * y;
            }
            let (tan, cot, sin) = (y / x, x / y, y / length);
            let shear = 0.5 * row_6 * sin * sin;
            (poisson * poisson * row_1 + shear * tan) * x + (row_2 + shear * cot) * y
        })
    }

    fn sliding(&self, offsets: &[[i32; 2]], c: &Matrix3<f64>) -> f64 {
        let [_, psi_shear] = self.densities(offsets);
        let all = self.components == Components::All;
        self.over_crack(offsets, |[x, _], length| {
            let resists = all || x > 0.0;
            if resists {
                psi_shear * c[(2, 2)] * length
            } else {
                0.0
            }
        })
    }

    /// V^2/(2 dx h) times the sum over the bonds that a crack along x cuts, as wide as a cell, of a function of (abs(xi_x), xi_y)
    /// and abs(xi).
    fn over_crack(&self, offsets: &[[i32; 2]], of_bond: impl Fn([f64; 2], f64) -> f64) -> f64 {
        let ([dx, dy], h) = (self.spacing, self.thickness);
        let crossing = offsets.iter().filter(|[_, q]| *q > 0);
        let sum: f64 = crossing
            .map(|&[p, q]| {
                let [x, y] = [f64::from(p.abs()) * dx, f64::from(q) * dy];
                f64::from(q) * of_bond([x, y], x.hypot(y))
            })
            .sum();
        self.cell_volume().powi(2) / (2.0 * dx * h) * sum
    }

    /// psi_1 = psi_2 and psi_6 of a point with all its neighbours, 1/m^4: 2 over the volume times the lengths of the bonds that
    /// resist the strain.
    fn densities(&self, offsets: &[[i32; 2]]) -> [f64; 2] {
        let lengths = |resists: &dyn Fn(&[i32; 2]) -> bool| -> f64 {
            let resisting = offsets.iter().filter(|it| resists(it));
            2.0 * self.spacing[0] * resisting.map(|&it| self.length(it)).sum::<f64>()
        };
        let of_sum = |sum: f64| 2.0 / (self.cell_volume() * sum);
        match self.components {
            Components::All => [of_sum(lengths(&|_| true)); 2],
            Components::OwnRows => [
                of_sum(lengths(&|[p, _]| *p != 0)),
                of_sum(lengths(&|[p, q]| *p != 0 && *q != 0)),
            ],
        }
    }

    fn cell_volume(&self) -> f64 {
        self.spacing[0] * self.spacing[1] * self.thickness
    }
}

impl CrackEnergies {
    /// The limits at which the energies of cracks equal the fracture energies of their modes.
    pub fn limits(&self, toughness: &Toughness) -> Limits {
        Limits {
            stretch: self.opening.map(|it| (toughness.opening / it).sqrt()),
            angle: self.sliding.map(|it| (toughness.sliding / it).sqrt()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::{Elasticity, Isotropic, Orthotropic, Plane};

    const MATERIAL: Isotropic = Isotropic {
        young: 65.8e9,
        poisson: 0.3,
    };
    const TOUGHNESS: Toughness = Toughness {
        opening: 6137.0,
        sliding: 6137.0,
    };

    fn lattice(ratio: f64, spacing: f64) -> Lattice {
        Lattice {
            spacing: [spacing; 2],
            horizon: ratio * spacing,
            thickness: 1e-3,
            components: Components::All,
        }
    }

    fn limits(lattice: &Lattice) -> Limits {
        let stiffness = MATERIAL.plane_stiffness(Plane::Stress);
        lattice.crack_energies(&stiffness).limits(&TOUGHNESS)
    }

    /// From an independent calculation with E = 65.8 GPa, nu = 0.3, plane stress, G_c = 6137 J/m^2; printed with six digits
    /// after the point, so that half of the last bounds the difference.
    #[test]
    fn limits_are_those_of_an_independent_calculation() {
        let known = [
            (2.0, 0.5e-3, 0.017593, 0.033074),
            (2.0, 1e-3, 0.012440, 0.023387),
            (2.0, 2e-3, 0.008796, 0.016537),
            (3.0, 0.5e-3, 0.014144, 0.026209),
            (3.0, 1e-3, 0.010001, 0.018532),
            (3.0, 2e-3, 0.007072, 0.013104),
            (4.0, 0.5e-3, 0.012358, 0.022938),
            (4.0, 1e-3, 0.008738, 0.016219),
            (4.0, 2e-3, 0.006179, 0.011469),
        ];
        for (ratio, spacing, stretch, angle) in known {
            let found = limits(&lattice(ratio, spacing));
            for of_axis in found.stretch {
                assert!(
                    (of_axis - stretch).abs() < 5.1e-7,
                    "{ratio} {spacing}: {found:?}"
                );
            }
            for of_axis in found.angle {
                assert!(
                    (of_axis - angle).abs() < 5.1e-7,
                    "{ratio} {spacing}: {found:?}"
                );
            }
        }
        let rows = Lattice {
            components: Components::OwnRows,
            ..lattice(3.0, 1e-3)
        };
        let found = limits(&rows);
        assert!((found.stretch[1] - 0.008814).abs() < 5.1e-7, "{found:?}");
        assert!((found.angle[1] - 0.017514).abs() < 5.1e-7, "{found:?}");
    }

    /// Families of m = 2, 3, 3.015 and 4: 12, 28, 28 and 48 neighbours.
    #[test]
    fn offsets_are_half_a_family() {
        for (ratio, neighbours) in [(1.0, 4), (2.0, 12), (3.0, 28), (3.015, 28), (4.0, 48)] {
            assert_eq!(
                2 * lattice(ratio, 0.1).offsets().len(),
                neighbours,
                "{ratio}"
            );
        }
    }

    /// Cells twice as high as wide, m = 3: by hand (p, q) = (1, 0), (2, 0), (3, 0), (0, 1) and (+-1, 1), (+-2, 1), of which those with q > 0
    /// cross a row. The energy of sliding in closed form; lying cells exchange both axes.
    #[test]
    fn rectangular_cells_have_a_value_for_each_axis() {
        let upright = Lattice {
            spacing: [1e-3, 2e-3],
            horizon: 3e-3,
            ..lattice(3.0, 1e-3)
        };
        assert_eq!(upright.offsets().len(), 8);
        let c = MATERIAL.plane_stiffness(Plane::Stress);
        let energies = upright.crack_energies(&c);
        // In widths of a cell: 1 + 2 + 3 along x, 2 + 2 sqrt(5) + 2 sqrt(8) across the row.
        let across = 2.0 + 2.0 * (5.0_f64.sqrt() + 8.0_f64.sqrt());
        let (all, volume) = (2.0 * (6.0 + across) * 1e-3, 2e-9);
        let psi = 2.0 / (volume * all);
        let expected = volume * volume / (2.0 * 1e-3 * 1e-3) * psi * c[(2, 2)] * across * 1e-3;
        assert!((energies.sliding[1] / expected - 1.0).abs() < 1e-12);
        let lying = Lattice {
            spacing: [2e-3, 1e-3],
            ..upright
        };
        let exchanged = lying.crack_energies(&c);
        for axis in 0..2 {
            assert!((exchanged.sliding[1 - axis] / energies.sliding[axis] - 1.0).abs() < 1e-12);
            assert!((exchanged.opening[1 - axis] / energies.opening[axis] - 1.0).abs() < 1e-12);
        }
        assert!(
            energies.sliding[0] > 1.2 * energies.sliding[1]
                || energies.sliding[1] > 1.2 * energies.sliding[0]
        );
    }

    /// Of a lamina the stiffer direction opens at the smaller stretch, and turning it by a right angle exchanges both; c_16 does
    /// nothing by its sign. To rounding.
    #[test]
    fn directions_of_a_lamina_exchange() {
        let lamina = |angle: f64| {
            let constants = Orthotropic {
                young: [150e9, 10e9],
                poisson: 0.3,
                shear_modulus: 5e9,
                out_of_plane: None,
                angle,
            };
            let stiffness = Elasticity::Orthotropic(constants).plane_stiffness(Plane::Stress);
            let energies = lattice(3.0, 1e-3).crack_energies(&stiffness);
            energies.limits(&TOUGHNESS)
        };
        let (along, across) = (lamina(0.0), lamina(90_f64.to_radians()));
        assert!(along.stretch[0] < 0.5 * along.stretch[1]);
        let is_same = |one: f64, other: f64| (one / other - 1.0).abs() < 1e-12;
        assert!(is_same(along.stretch[0], across.stretch[1]));
        assert!(is_same(along.stretch[1], across.stretch[0]));
        assert!(is_same(along.angle[0], across.angle[0]));
        let [left, right] = [0.5, -0.5].map(lamina);
        assert!(is_same(left.stretch[1], right.stretch[1]));
        assert!(is_same(left.stretch[0], right.stretch[0]));
    }
}
