//! Critical stretch in space from the fracture energy G_c, the energy that separates a body in two halves.

use super::basis::SolidBasis;
use crate::failure::{Choice, Limits};
use crate::material::Isotropic;
use crate::system::BondSystem;

/// Critical stretches of brittle bonds (n_bonds); a bond has the mean bulk modulus and the mean length of its ends.
pub fn critical_stretches(basis: &SolidBasis<'_>) -> Vec<f64> {
    let system = basis.system;
    let energy = basis.weakest(&basis.each(|_, material| material.fracture_energy));
    let moduli = basis.each(|constants, _| Some(constants.bulk_modulus()));
    let lengths = mean_lengths(system);
    let modulus = |end: u32| system.cloud.mean_property(end as usize, &moduli);
    let of_bonds = energy.into_iter().zip(&system.bonds.ends);
    of_bonds
        .map(|(energy, &[a, b])| {
            let modulus = 0.5 * (modulus(a) + modulus(b));
            let length = 0.5 * (lengths[a as usize] + lengths[b as usize]);
            critical_stretch(energy, modulus, length)
        })
        .collect()
}

/// Critical stretch for the fracture energy G_c (J/m^2), the bulk modulus K (Pa) and the mean bond length h (m):
///
/// s_0 = sqrt(4 G_c/(9 K h)).
///
/// Every bond that crosses the plane of the crack gives 1/2 Omega alpha V_A V_B k_n l s_0^2. One of length l crosses it where its first end
/// lies within l |cos phi| of it; with the mean 1/2 of |cos phi| over the directions of space, that is per area
///
/// G_c = s_0^2/8 sum_B Omega alpha V_B k_n l^2 = s_0^2 9/4 K h,
///
/// where sum_B Omega alpha V_B k_n l = 18 K is what the bulk modulus fixes and h is the mean length of the bonds of a point, weighted by
/// what each has of that sum ([`mean_lengths`]). A continuous family with a constant k_n has h = 4 H/5, so that G_c = pi k_n s_0^2 H^5/10 and
/// s_0 = sqrt(5 G_c/(9 K H)).
///
/// What shear stores in those bonds comes on top: the energy of the bond counts it, the plain stretch does not.
pub fn critical_stretch(fracture_energy: f64, bulk_modulus: f64, mean_length: f64) -> f64 {
    (4.0 * fracture_energy / (9.0 * bulk_modulus * mean_length)).sqrt()
}

/// Mean lengths h = sum_B w l/sum_B w of the bonds of each point with the weights w = Omega alpha V_B k_n l, shape (n_points), m.
pub fn mean_lengths(system: &BondSystem<3>) -> Vec<f64> {
    let of_point = |point: u32| {
        let (mut sum, mut weights) = (0.0, 0.0);
        for &bond in system.bonds.incidence.at(point) {
            // The volume of the point itself is in all of them.
            let weight = system.rigidities.axial[bond as usize];
            sum += weight * system.bonds.length[bond as usize];
            weights += weight;
        }
        [sum / weights]
    };
    let lengths = system.cloud.over_families(of_point);
    lengths.into_iter().map(|[length]| length).collect()
}

/// Limits of the measure sqrt(max(s, 0)^2 + k_t/k_n |gamma|^2): given ones, or from the fracture energy, or where bonds soften by it from
/// the tensile strength.
pub(super) fn limits_of_energy(choice: &Choice, basis: &SolidBasis<'_>) -> Limits {
    let limit = match choice.limit {
        Some(limit) => basis.weakest(&vec![limit; basis.materials.len()]),
        None if choice.begins_at_strength() => basis.weakest(&basis.each(|constants, material| {
            Some(stretch_at_strength(constants, material.tensile_strength?))
        })),
        None => critical_stretches(basis),
    };
    let rigidities = &basis.system.rigidities;
    let shear_ratios = (rigidities.axial.iter().zip(&rigidities.shear))
        .map(|(&axial, &shear)| if axial == 0.0 { 0.0 } else { shear / axial })
        .collect();
    Limits::new(limit, shear_ratios)
}

/// Stretch at which bonds of equal energy begin to soften for the tensile strength F (Pa):
///
/// s_0 = F/(chi E), chi = (1 - q^(3/2))/((1 - 2 nu)(1 - q)), q = k_t/k_n = (1 - 4 nu)/(1 + nu), 3/2 for nu = 0.
///
/// In a bar under the stress E s_0 only the bonds along it are at their limit. Where a crack opens, bonds of all directions phi come to it
/// and carry more before they fall: per area 9 K s_0 integral_0^1 sqrt(t^2 + q (1 - t^2)) t dt with t = cos phi, which over E s_0 is chi: 1.5,
/// 1.86 and 2 for nu = 0, 0.2 and 1/4. Above 1/4 bonds that slide store nothing that counts. The first bonds soften at F/chi.
pub fn stretch_at_strength(material: &Isotropic, strength: f64) -> f64 {
    let Isotropic { young, poisson } = *material;
    let less = 5.0 * poisson / (1.0 + poisson);
    let ratio = (1.0 - less).max(0.0);
    // (1 - q^(3/2))/(1 - q), by its series near q = 1, where digits would be lost.
    let gain = if less.abs() < 1e-4 {
        1.5 - 0.375 * less
    } else {
        (1.0 - ratio.powf(1.5)) / less
    };
    strength * (1.0 - 2.0 * poisson) / (gain * young)
}
