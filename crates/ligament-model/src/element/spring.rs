//! Spring bonds: an axial and a shear spring between points without rotation (PDS; MPPD section 2.1).
//!
//! The shear deformation does not distinguish a rotation of the whole body from a shear: where the shear rigidity is not zero, a rigid
//! rotation costs energy.

use super::pair::{PairBond, PairKinematics};
use super::{Block, BondDeformation, Rigidities, StiffnessFactors};
use crate::bonds::BondSet;
use crate::deformation::SpaceDeformation;
use crate::layout::Component;
use crate::tensor::{SymTensor, dot, tangents};

/// Geometry and rigidities of one bond.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpringBond<const D: usize = 2> {
    /// Length l, m.
    pub length: f64,
    /// Unit vector n from A to B; in the plane the direction cosines (a, b).
    pub direction: [f64; D],
    /// Omega alpha V_A V_B k_n l, J: energy 1/2 (...) s^2.
    pub axial_rigidity: f64,
    /// Omega alpha V_A V_B k_t l, J: energy 1/2 (...) |gamma|^2.
    pub shear_rigidity: f64,
}

impl<const D: usize> PairBond<D> for SpringBond<D> {
    #[inline(always)]
    fn new(bonds: &BondSet<D>, rigidities: &Rigidities, bond: usize) -> Self {
        Self {
            length: bonds.length[bond],
            direction: bonds.direction[bond],
            axial_rigidity: rigidities.axial[bond],
            shear_rigidity: rigidities.shear[bond],
        }
    }

    #[inline(always)]
    fn weakened(self, remaining: &StiffnessFactors) -> Self {
        Self {
            axial_rigidity: remaining.axial * self.axial_rigidity,
            shear_rigidity: remaining.shear * self.shear_rigidity,
            ..self
        }
    }

    #[inline(always)]
    fn geometry(&self) -> (f64, [f64; D]) {
        (self.length, self.direction)
    }
}

impl PairKinematics<2, 2> for SpringBond {
    const COMPONENTS: [Component; 2] = [Component::X, Component::Y];

    type Deformation = BondDeformation;

    /// Deformation for the displacements of the ends A and B:
    ///
    /// s = [a (u_xB - u_xA) + b (u_yB - u_yA)]/l, gamma = [-b (u_xB - u_xA) + a (u_yB - u_yA)]/l.
    #[inline(always)]
    fn deformation(&self, end_a: &[f64], end_b: &[f64]) -> BondDeformation {
        let [a, b] = self.direction;
        let (du_x, du_y) = (end_b[0] - end_a[0], end_b[1] - end_a[1]);
        let per_length = 1.0 / self.length;
        let stretch = (a * du_x + b * du_y) * per_length;
        let shear = (-b * du_x + a * du_y) * per_length;
        BondDeformation::new([stretch, shear, 0.0])
    }

    /// Deformation s = a^2 eps_xx + b^2 eps_yy + a b gamma_xy, gamma = a b (eps_yy - eps_xx) + (a^2 - b^2) gamma_xy/2.
    #[inline(always)]
    fn deformation_in(&self, strain: &SymTensor<2>) -> BondDeformation {
        let [a, b] = self.direction;
        let [xx, yy, xy] = [strain.at(0, 0), strain.at(1, 1), strain.at(0, 1)];
        let stretch = a * a * xx + b * b * yy + a * b * (2.0 * xy);
        let shear = a * b * (yy - xx) + (a * a - b * b) * xy;
        BondDeformation::new([stretch, shear, 0.0])
    }

    /// Energy 1/2 u^T K u', J, for two deformations of the same bond.
    #[inline]
    fn mutual_energy(&self, one: &BondDeformation, other: &BondDeformation) -> f64 {
        0.5 * (self.axial_rigidity * one.stretch() * other.stretch()
            + self.shear_rigidity * one.shear() * other.shear())
    }

    /// Internal forces K u at the ends A and B, N.
    #[inline]
    fn end_forces(&self, deformation: &BondDeformation) -> [[f64; 2]; 2] {
        let [a, b] = self.direction;
        let per_length = 1.0 / self.length;
        let axial = self.axial_rigidity * deformation.stretch() * per_length;
        let transverse = self.shear_rigidity * deformation.shear() * per_length;
        let (force_x, force_y) = (axial * a - transverse * b, axial * b + transverse * a);
        [[-force_x, -force_y], [force_x, force_y]]
    }

    /// Modes of the bond: K as a sum over stretch and shear of rigidity g g^T.
    fn modes(&self) -> impl Iterator<Item = (f64, [[f64; 2]; 2])> {
        let [a, b] = [
            self.direction[0] / self.length,
            self.direction[1] / self.length,
        ];
        [
            (self.axial_rigidity, [[-a, -b], [a, b]]),
            (self.shear_rigidity, [[b, -a], [-b, a]]),
        ]
        .into_iter()
    }
}

impl SpringBond<3> {
    /// Deformation for the slope v of the displacement along the bond: stretch n . v and shear P v.
    #[inline(always)]
    fn deformed(&self, slope: [f64; 3]) -> SpaceDeformation {
        let stretch = dot(self.direction, slope);
        SpaceDeformation {
            stretch,
            shear: [0, 1, 2].map(|k| slope[k] - stretch * self.direction[k]),
            rotation: [0.0; 3],
        }
    }

    /// Stiffness (A n n^T + S P)/l^2, with the axial rigidity A and the shear rigidity S, N/m.
    pub(super) fn stiffness(&self) -> [[f64; 3]; 3] {
        let per_square = 1.0 / (self.length * self.length);
        let axial = (self.axial_rigidity - self.shear_rigidity) * per_square;
        let shear = self.shear_rigidity * per_square;
        let n = self.direction;
        std::array::from_fn(|row| {
            std::array::from_fn(|column| {
                let unit = if row == column { shear } else { 0.0 };
                axial * n[row] * n[column] + unit
            })
        })
    }

    /// Force on the end B for a stretch and a shear, N.
    #[inline(always)]
    pub(super) fn force(&self, deformation: &SpaceDeformation) -> [f64; 3] {
        let per_length = 1.0 / self.length;
        let axial = self.axial_rigidity * deformation.stretch * per_length;
        let shear = self.shear_rigidity * per_length;
        [0, 1, 2].map(|k| axial * self.direction[k] + shear * deformation.shear[k])
    }
}

impl PairKinematics<3, 3> for SpringBond<3> {
    const COMPONENTS: [Component; 3] = [Component::X, Component::Y, Component::Z];

    type Deformation = SpaceDeformation;

    /// Deformation for the displacements of the ends: s = n . du/l, gamma = P du/l.
    #[inline(always)]
    fn deformation(&self, end_a: &[f64], end_b: &[f64]) -> SpaceDeformation {
        let per_length = 1.0 / self.length;
        self.deformed([0, 1, 2].map(|k| (end_b[k] - end_a[k]) * per_length))
    }

    #[inline]
    fn deformation_in(&self, strain: &SymTensor<3>) -> SpaceDeformation {
        self.deformed(strain.times(self.direction))
    }

    #[inline]
    fn mutual_energy(&self, one: &SpaceDeformation, other: &SpaceDeformation) -> f64 {
        0.5 * (self.axial_rigidity * one.stretch * other.stretch
            + self.shear_rigidity * dot(one.shear, other.shear))
    }

    #[inline(always)]
    fn end_forces(&self, deformation: &SpaceDeformation) -> [[f64; 3]; 2] {
        let force = self.force(deformation);
        [force.map(|value| -value), force]
    }

    /// Modes of the bond, with the shear spring along both directions across the bond; modes without stiffness are left out.
    fn modes(&self) -> impl Iterator<Item = (f64, [[f64; 3]; 2])> {
        let [one, other] = tangents(self.direction);
        let modes = [
            (self.axial_rigidity, self.direction),
            (self.shear_rigidity, one),
            (self.shear_rigidity, other),
        ];
        let modes = modes.into_iter().filter(|(it, _)| *it != 0.0);
        modes.map(|(rigidity, along)| {
            let at_b = along.map(|component| component / self.length);
            (rigidity, [at_b.map(|value| -value), at_b])
        })
    }

    fn block(&self, rows: usize, columns: usize) -> Block<3> {
        let own = self.stiffness();
        if rows == columns {
            own
        } else {
            own.map(|row| row.map(|value| -value))
        }
    }
}
