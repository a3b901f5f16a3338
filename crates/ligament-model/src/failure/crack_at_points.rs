//! Critical stretches of the points of a lattice, from their unbroken bonds (MBB-PD eqs 21 to 23, C.4, C.7, C.9).

use std::sync::Arc;

use super::basis::Basis;
use crate::bonds::Incidence;
use crate::element::BondDeformation;
use crate::element::imaginary::{SymmetricEntries, matrix};
use crate::material::Material;
use crate::parallel;
use crate::scatter::Scattered;

/// Mode of deformation of a crack.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mode {
    /// Mode I.
    Opening,
    /// Mode II.
    Sliding,
    /// Both together.
    Mixed,
}

/// Energies of a crack along x beside each point, as long as a cell is wide.
///
/// Such a crack cuts q bonds of each offset (p dx, q dy) of a family. As a family has each offset to both sides of its point, the
/// energy is half of the sum over all bonds that the point has left: broken bonds and those beyond an edge count nothing, so that the critical
/// stretch grows with the damage.
#[derive(Debug, Clone, PartialEq)]
pub struct CrackAtPoints {
    ends: Arc<[[u32; 2]]>,
    incidence: Arc<Incidence>,
    /// Contribution of each bond to the energy of the crack beside each of its ends over the square of s_c, shape (n_bonds), J/m^2.
    energies: Vec<f64>,
    /// G_Ic, G_IIc and eta of each point, shape (n_points).
    toughness: Vec<[f64; 3]>,
    /// Terms of the energies of the modes; empty where no point needs them.
    releases: Vec<Release>,
    mode: Mode,
}

/// Stiffness of a bond over its strains, J, with |xi_x| and |xi_y| over 2 dx h l, 1/m^2.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Release {
    stiffness: SymmetricEntries,
    levers: [f64; 2],
}

impl CrackAtPoints {
    /// The energies in a mode for the bonds of a lattice.
    pub fn new(mode: Mode, basis: &Basis<'_>) -> Self {
        let (bonds, cloud) = (&basis.system.bonds, &basis.system.cloud);
        let stiffness: &[_] = &basis.system.rigidities.strain;
        let (_, lattice) = basis.plane_and_lattice();
        let [dx, dy] = lattice.spacing;
        let area = 2.0 * dx * lattice.thickness;
        let of_bond = |((direction, &length), density): ((&[f64; 2], &f64), SymmetricEntries)| {
            let cosines = direction.map(f64::abs);
            let rows = (cosines[1] * length / dy).round();
            let energy = rows * energy(mode, cosines, density) / area;
            let release = Release {
                stiffness: density,
                levers: cosines.map(|cosine| cosine / area),
            };
            (energy, release)
        };
        let geometry = bonds.direction.iter().zip(&bonds.length);
        let entries = stiffness.iter().map(|it| it.entries);
        let (energies, releases) = geometry.zip(entries).map(of_bond).unzip();
        let of_materials: Vec<[f64; 3]> = basis.materials.iter().map(toughness).collect();
        let of_point = |point: usize| {
            let present = cloud.shares(point).iter().zip(&of_materials);
            let present = present.filter(|(share, _)| **share > 0.0).map(|it| *it.1);
            let weaker =
                |one: [f64; 3], other: [f64; 3]| if other[0] < one[0] { other } else { one };
            let [opening, sliding, exponent] = present.reduce(weaker).unwrap_or([f64::INFINITY; 3]);
            let factors = basis.factors(Scattered::FractureEnergy);
            let factor = factors.map_or(1.0, |it| it.at_points[point]);
            [factor * opening, factor * sliding, exponent]
        };
        let asks_for_modes = |[opening, sliding, _]: &[f64; 3]| opening != sliding;
        let is_asked = mode == Mode::Mixed && of_materials.iter().any(asks_for_modes);
        Self {
            ends: bonds.ends.clone(),
            incidence: bonds.incidence.clone(),
            energies,
            toughness: (0..cloud.len()).map(of_point).collect(),
            releases: if is_asked { releases } else { Vec::new() },
            mode,
        }
    }

    /// Limits of the bonds (n_bonds) while those marked in `intact` (n_bonds) are left and have deformations (n_bonds; none before any): the
    /// smaller critical stretch of the ends. What is infinite in `sound` stays so.
    pub fn limits(
        &self,
        sound: &[f64],
        intact: &[bool],
        deformations: &[BondDeformation],
    ) -> Vec<f64> {
        let stretches = parallel::values(self.toughness.len(), 0.0, |point| {
            self.critical_stretch(point as u32, intact, deformations)
        });
        parallel::values(sound.len(), 0.0, |bond| {
            let [a, b] = self.ends[bond].map(|end| stretches[end as usize]);
            if sound[bond].is_infinite() {
                sound[bond]
            } else {
                a.min(b)
            }
        })
    }

    /// Critical stretch s_c of a point: sqrt(G/e), with the fracture energy G of the mode and the energy e of the crack over the
    /// square of the stretch (C.4, C.7, C.9); infinite where no bond is left to be cut.
    pub fn critical_stretch(
        &self,
        point: u32,
        intact: &[bool],
        deformations: &[BondDeformation],
    ) -> f64 {
        let family = self.incidence.at(point).iter().map(|&bond| bond as usize);
        let left = family.filter(|&bond| intact[bond]);
        let energy = 0.5 * left.map(|bond| self.energies[bond]).sum::<f64>();
        let [opening, sliding, exponent] = self.toughness[point as usize];
        let toughness = match self.mode {
            Mode::Opening => opening,
            Mode::Sliding => sliding,
            Mode::Mixed if self.releases.is_empty() || deformations.is_empty() => opening,
            Mode::Mixed => {
                let [of_opening, of_sliding] = self.mode_energies(point, intact, deformations);
                let total = of_opening + of_sliding;
                let share = if total > 0.0 { of_sliding / total } else { 0.0 };
                opening + (sliding - opening) * share.powf(exponent)
            }
        };
        if energy > 0.0 {
            (toughness / energy).sqrt()
        } else {
            f64::INFINITY
        }
    }

    /// Energies G_I and G_II of a point (eq. 22), J/m^2, each at least 0:
    ///
    /// G_I = sum f_yy S_yy abs(xi_y) V^2/(2 dx h), G_II = sum f_xx S_xx abs(xi_x) V^2/(2 dx h) over its unbroken bonds.
    ///
    /// Printed is the relative displacement in the place of xi, which makes them of third order in the strains; C.1 has xi. A uniaxial
    /// stress along y is all mode I, as f_xx = 0; pure shear has neither, as S_xx = S_yy = 0. Both are empty sums unless the fracture
    /// energies differ.
    pub fn mode_energies(
        &self,
        point: u32,
        intact: &[bool],
        deformations: &[BondDeformation],
    ) -> [f64; 2] {
        let family = self.incidence.at(point).iter().map(|&bond| bond as usize);
        let mut energies = [0.0; 2];
        for bond in family.filter(|&bond| intact[bond]) {
            let Some(Release { stiffness, levers }) = self.releases.get(bond) else {
                continue;
            };
            let [d11, d12, d16, d22, d26, _] = *stiffness;
            let [xx, yy, xy] = deformations[bond].strain();
            energies[0] += (d12 * xx + d22 * yy + d26 * xy) * yy * levers[1];
            energies[1] += (d11 * xx + d12 * yy + d16 * xy) * xx * levers[0];
        }
        energies.map(|energy: f64| energy.max(0.0))
    }
}

/// Energy of a bond at s_c = 1 (C.4, C.7, C.9), J, with its direction (both cosines positive) and its stiffness over the strains.
///
/// K_1, K_2 and K_6 are the sums of the rows without c_16 and c_26, whose shares two mirrored bonds take from each other; nu is the
/// contraction along the crack under stress across it. cot(90 degrees) is 0.
fn energy(mode: Mode, [x, y]: [f64; 2], entries: SymmetricEntries) -> f64 {
    let d = matrix(entries);
    let row = |place: usize| d[(place, 0)] + d[(place, 1)];
    let (row_1, row_2, row_6) = (row(0), row(1), d[(2, 2)]);
    if y == 0.0 {
        return 0.0;
    }
    if x == 0.0 {
        return match mode {
            Mode::Opening => row_2,
            Mode::Sliding => 0.0,
            Mode::Mixed => row_1,
        };
    }
    let poisson = (d[(0, 1)] * d[(2, 2)] - d[(0, 2)] * d[(1, 2)])
        / (d[(0, 0)] * d[(2, 2)] - d[(0, 2)] * d[(0, 2)]);
    // The cosines are those of a unit length: sin(theta) is y.
    let (tan, cot, sin) = (y / x, x / y, y);
    let (of_1, of_2, of_6) = match mode {
        Mode::Opening => (poisson * poisson, 1.0, sin * sin),
        Mode::Sliding => (tan * tan, 0.0, 1.0),
        Mode::Mixed => ((tan - poisson).powi(2), 1.0, (1.0 + sin).powi(2)),
    };
    (of_1 * row_1 + 0.5 * tan * of_6 * row_6) * x + (of_2 * row_2 + 0.5 * cot * of_6 * row_6) * y
}

/// G_Ic, G_IIc and eta of a material; a material without energies never fails.
fn toughness(material: &Material) -> [f64; 3] {
    let opening = material.fracture_energy.unwrap_or(f64::INFINITY);
    let sliding = material.fracture_energy_sliding.unwrap_or(opening);
    [
        opening,
        sliding,
        material.mixed_mode_exponent.unwrap_or(1.0),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::element::imaginary::entries;
    use crate::failure::crack_energies::{Components, Lattice};
    use crate::material::{Isotropic, Plane};

    /// Half the sum of q times the energies over a whole family is the energy of C.4 of an infinite lattice; those of C.7 and C.9 are, with
    /// m = 3, d = 1 mm, E = 65.8 GPa, nu = 0.3 and G_c = 6137 J/m^2, s_c = 0.01094 and 0.00763 of an independent calculation.
    #[test]
    fn energies_of_a_family_are_those_of_the_infinite_lattice() {
        let material = Isotropic {
            young: 65.8e9,
            poisson: 0.3,
        };
        let lattice = Lattice {
            spacing: [1e-3; 2],
            horizon: 3e-3,
            thickness: 1e-3,
            components: Components::All,
        };
        let c = material.plane_stiffness(Plane::Stress);
        let lengths = lattice.offsets().into_iter();
        let lengths: f64 = lengths.map(|[p, q]| f64::from(p).hypot(f64::from(q))).sum();
        let volume = 1e-9;
        let psi = 2.0 / (volume * 2.0 * 1e-3 * lengths);
        let stretch = |mode: Mode| {
            let of_bond = |[p, q]: [i32; 2]| {
                let [x, y] = [p.abs(), q].map(f64::from);
                let length = x.hypot(y);
                let density = entries(&(psi * volume * volume * 1e-3 * length * c));
                y * energy(mode, [x / length, y / length], density) / 2e-6
            };
            let energy: f64 = lattice.offsets().into_iter().map(of_bond).sum();
            (6137.0 / energy).sqrt()
        };
        let opening = lattice.crack_energies(&c).opening[1];
        let printed = (6137.0 / opening).sqrt();
        assert!((stretch(Mode::Opening) / printed - 1.0).abs() < 1e-12);
        assert!((stretch(Mode::Sliding) - 0.01094).abs() < 5.1e-6);
        assert!((stretch(Mode::Mixed) - 0.00763).abs() < 5.1e-6);
    }
}
