//! Critical stretch from the fracture energy G_c, the energy that separates a body in two halves.

use super::basis::Basis;
use super::kind::{FRACTURE_ENERGY, Kind, Limits, TENSILE_STRENGTH};
use super::measure::Measure;
use crate::law::constants;
use crate::material::{Isotropic, Plane, Space};
use crate::system::BondSystem;

/// Stretch, from the fracture energy.
pub const CRITICAL_STRETCH: Kind = Kind {
    takes: &[FRACTURE_ENERGY],
    ..Kind::new(
        "critical-stretch",
        "Stretch, from the `fracture_energy`.",
        &[Measure::Tension],
        |_, basis| Ok(vec![Limits::without_coefficient(critical_stretches(basis))]),
    )
};

/// Energy of stretch and sliding, from the fracture energy; from the tensile strength where bonds soften by the fracture energy.
pub const BOND_ENERGY: Kind = Kind {
    takes: &[FRACTURE_ENERGY],
    keys: &["limit"],
    ..Kind::new(
        "bond-energy",
        "Energy of stretch and sliding, from the `fracture_energy` or a `limit`; where bonds soften, from the `tensile_strength`.",
        &[Measure::Energy],
        |choice, basis| {
            let limit = match choice.limit {
                Some(limit) => basis.weakest(&vec![limit; basis.materials.len()]),
                None if choice.begins_at_strength() => stretches_at_strength(basis),
                None => critical_stretches(basis),
            };
            let coefficient = shear_ratios(basis.system);
            Ok(vec![Limits::new(limit, coefficient)])
        },
    )
};

/// Stretches at which bonds begin to soften so that a body has its tensile strength (n_bonds); a bond between materials takes the
/// smaller one.
fn stretches_at_strength(basis: &Basis<'_>) -> Vec<f64> {
    basis.weakest(&basis.each(|constants, material| {
        let strength = (TENSILE_STRENGTH.value)(material)?;
        Some(stretch_at_strength(constants, strength, basis.plane))
    }))
}

/// Stretch at which bonds of equal energy begin to soften for the tensile strength F (Pa):
///
/// s_0 = F/(chi E), chi = 4/(pi (1 - nu)) integral_0^1 sqrt(1 - a t^2) dt, a = 1 - k_t/k_n = 4 nu/(1 + nu),
///
/// with E and nu in the plane. In a bar under the stress E s_0 only the bonds along it are at their limit. Where a crack opens, bonds of
/// all directions phi come to it, and carry more before they fall: per area integral s_0 k_n sqrt(cos^2 phi + k_t/k_n sin^2 phi)
/// cos(phi), which over the stress E s_0 = s_0 k_n pi (1 - nu)/2 in the same measure is chi: 1.27, 1.39 and 1.5 for nu = 0, 0.2 and 1/3.
/// That is the strength where bonds fall slowly, in a body much larger than its horizon; the first bonds soften at F/chi.
pub fn stretch_at_strength(material: &Isotropic, strength: f64, plane: Plane) -> f64 {
    const PARTS: u32 = 1000;
    let Isotropic { young, poisson } = material.in_plane(plane);
    let a = 4.0 * poisson / (1.0 + poisson);
    // The rule of midpoints; above nu = 1/3 bonds that slide store nothing that counts.
    let at = |part: u32| {
        let t = (f64::from(part) + 0.5) / f64::from(PARTS);
        (1.0 - a * t * t).max(0.0).sqrt()
    };
    let integral = (0..PARTS).map(at).sum::<f64>() / f64::from(PARTS);
    let gain = 4.0 / (std::f64::consts::PI * (1.0 - poisson)) * integral;
    strength / (gain * young)
}

/// Critical stretches of brittle bonds (n_bonds); a bond has the mean opening modulus and the mean length of its ends.
pub fn critical_stretches(basis: &Basis<'_>) -> Vec<f64> {
    let system = basis.system;
    let energy = basis.weakest(&basis.each(|_, material| material.fracture_energy));
    let moduli = basis.each(|constants, _| Some(opening_modulus(constants, basis.plane)));
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

/// k_t/k_n of each bond; 0 where the bond has no stiffness at all, shape (n_bonds).
fn shear_ratios(system: &BondSystem) -> Vec<f64> {
    let rigidities = system.rigidities.axial.iter().zip(&system.rigidities.shear);
    rigidities
        .map(|(&axial, &shear)| if axial == 0.0 { 0.0 } else { shear / axial })
        .collect()
}

/// Critical stretch for the fracture energy G_c (J/m^2), the opening modulus M (Pa) and the mean bond length h (m):
///
/// s_0 = sqrt(G_c/(M h)).
///
/// Every bond that crosses the plane of the crack is stretched to s_0 and gives 1/2 Omega alpha V_A V_B k_n l s_0^2. A bond of
/// length l crosses it where its first end lies within l |cos phi| of it; with the mean 2/pi of |cos phi| over the directions of
/// the crack, that is per area
///
/// G_c = s_0^2/(2 pi) sum_B Omega alpha V_B k_n l^2 = s_0^2 M h,
///
/// where 2 pi M = sum_B Omega alpha V_B k_n l is what the elastic moduli fix ([`opening_modulus`]) and h is the mean length of the
/// bonds of a point, weighted by what each has of that sum ([`mean_lengths`]). A continuous family with a constant k_n has
/// h = 3 H/4, and then this is s_0 = sqrt(4 G_c/(t k_n H^4)), the two-dimensional form of Silling and Askari (2005, eq. 26).
///
/// What shear stores in those bonds comes on top. With [`Measure::Energy`] it is counted, and G_c holds
/// for every Poisson's ratio up to that of central forces; with the plain stretch it holds where k_t = 0.
pub fn critical_stretch(fracture_energy: f64, opening_modulus: f64, mean_length: f64) -> f64 {
    (fracture_energy / (opening_modulus * mean_length)).sqrt()
}

/// Opening modulus M = t integral_0^H k_n l^2 dl of a material, Pa: 2 E/(pi (1 - nu)) in plane stress,
/// 2 E/(pi (1 + nu)(1 - 2 nu)) in plane strain. All laws have it, with the Poisson's ratio that they give the material.
pub fn opening_modulus(material: &Isotropic, plane: Plane) -> f64 {
    constants::axial(material, Space::Plane(plane), 1.0) / 3.0
}

/// Mean lengths h = sum_B w l / sum_B w of the bonds of each point with the weights w = Omega alpha V_B k_n l, shape (n_points), m.
///
/// Points at a surface or beside a pre-crack have fewer bonds, of the same mean length.
pub fn mean_lengths(system: &BondSystem) -> Vec<f64> {
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

#[cfg(test)]
mod tests {
    use super::*;

    /// chi in closed form: 4/pi without shear of its own law (nu = 0, a = 0), 3/2 for central forces (a = 1: integral pi/4), and for
    /// nu = 0.2, a = 2/3, the integral (sqrt(1 - a) + asin(sqrt(a))/sqrt(a))/2. 1e-5: a thousand midpoints where the root is vertical.
    #[test]
    fn the_gain_has_its_closed_forms() {
        let gain = |poisson: f64| {
            let material = Isotropic {
                young: 1.0,
                poisson,
            };
            1.0 / stretch_at_strength(&material, 1.0, Plane::Stress)
        };
        let root = (2.0_f64 / 3.0).sqrt();
        let fifth = 0.5 * ((1.0_f64 / 3.0).sqrt() + root.asin() / root);
        let pi = std::f64::consts::PI;
        for (poisson, expected) in [(0.0, 4.0 / pi), (1.0 / 3.0, 1.5), (0.2, 5.0 / pi * fifth)] {
            assert!(
                (gain(poisson) / expected - 1.0).abs() < 1e-5,
                "{poisson}: {}",
                gain(poisson)
            );
        }
    }
}
