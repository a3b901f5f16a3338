//! Critical stretch from the fracture energy G_c, the energy that separates a body in two halves.

use super::basis::Basis;
use super::kind::{Choice, FRACTURE_ENERGY, Kind, Limits, PerSpace, TENSILE_STRENGTH};
use super::measure::Measure;
use super::unfit::NoLimit;
use crate::law::constants;
use crate::material::{Isotropic, Space};
use crate::system::BondSystem;

/// Stretch, from the fracture energy.
pub static CRITICAL_STRETCH: Kind = Kind {
    source: "Silling and Askari 2005",
    takes: &[FRACTURE_ENERGY],
    keys: &["limit"],
    ..Kind::new(
        "critical-stretch",
        "Stretch, from the `fracture_energy` or a `limit`.",
        &[Measure::Tension],
        PerSpace::new(stretch_limits, stretch_limits),
    )
};

/// Energy of stretch and sliding, from the fracture energy; from the tensile strength where bonds soften by the fracture energy.
pub static BOND_ENERGY: Kind = Kind {
    source: "Silling and Askari 2005",
    takes: &[FRACTURE_ENERGY],
    keys: &["limit"],
    ..Kind::new(
        "bond-energy",
        "Energy of stretch and sliding, from the `fracture_energy` or a `limit`; where bonds soften, from the `tensile_strength`.",
        &[Measure::Energy],
        PerSpace::new(energy_limits, energy_limits),
    )
};

fn stretch_limits<const D: usize>(
    choice: &Choice,
    basis: &Basis<'_, D>,
) -> Result<Vec<Limits>, NoLimit> {
    let limit = match choice.limit {
        Some(_) => basis.given_or(choice.limit, Vec::new),
        None => critical_stretches(basis),
    };
    Ok(vec![Limits::without_coefficient(limit)])
}

/// Limits with k_t/k_n of each bond; 0 for a bond without stiffness.
fn energy_limits<const D: usize>(
    choice: &Choice,
    basis: &Basis<'_, D>,
) -> Result<Vec<Limits>, NoLimit> {
    let limit = if choice.limit.is_some() || choice.begins_at_strength() {
        basis.given_or(choice.limit, || stretches_at_strength(basis))
    } else {
        critical_stretches(basis)
    };
    let rigidities = &basis.system.rigidities;
    let shear_ratios = (rigidities.axial.iter().zip(&rigidities.shear))
        .map(|(&axial, &shear)| if axial == 0.0 { 0.0 } else { shear / axial })
        .collect();
    Ok(vec![Limits::new(limit, shear_ratios)])
}

/// Stretches at which bonds of each material (n_materials) begin to soften for its tensile strength.
fn stretches_at_strength<const D: usize>(basis: &Basis<'_, D>) -> Vec<f64> {
    basis.each(|constants, material| {
        let strength = (TENSILE_STRENGTH.value)(material)?;
        Some(stretch_at_strength(&constants.bonds, strength, basis.space))
    })
}

/// Stretch at which softening begins in bonds of equal energy for the tensile strength F (Pa):
///
/// s_0 = F/(chi E).
///
/// In a bar under the stress E s_0 only the bonds along it are at their limit. Where a crack opens, bonds of all directions phi come
/// to it, and carry more before they fall; chi is what they carry over the stress E s_0. It is the strength where bonds fall slowly,
/// in a body much larger than its horizon; the first bonds soften at F/chi.
///
/// In the plane, with its E and nu, they carry per area integral s_0 k_n sqrt(cos^2 phi + k_t/k_n sin^2 phi) cos(phi), and E s_0 = s_0
/// k_n pi (1 - nu)/2 in the same measure:
///
/// chi = 4/(pi (1 - nu)) integral_0^1 sqrt(1 - a t^2) dt, a = 1 - k_t/k_n = 4 nu/(1 + nu),
///
/// which is 1.27, 1.39 and 1.5 for nu = 0, 0.2 and 1/3. In space they carry 9 K s_0 integral_0^1 sqrt(t^2 + q (1 - t^2)) t dt with t = cos
/// phi and q = k_t/k_n = (1 - 4 nu)/(1 + nu):
///
/// chi = (1 - q^(3/2))/((1 - 2 nu)(1 - q)),
///
/// which is 1.5, 1.86 and 2 for nu = 0, 0.2 and 1/4. Above the Poisson's ratio of central forces bonds that slide store nothing that counts.
pub fn stretch_at_strength(material: &Isotropic, strength: f64, space: impl Into<Space>) -> f64 {
    const PARTS: u32 = 1000;
    let space = space.into();
    let Isotropic { young, poisson } = material.bar_constants(space);
    match space {
        Space::Plane(_) => {
            let a = 4.0 * poisson / (1.0 + poisson);
            // The rule of midpoints.
            let at = |part: u32| {
                let t = (f64::from(part) + 0.5) / f64::from(PARTS);
                (1.0 - a * t * t).max(0.0).sqrt()
            };
            let integral = (0..PARTS).map(at).sum::<f64>() / f64::from(PARTS);
            let gain = 4.0 / (std::f64::consts::PI * (1.0 - poisson)) * integral;
            strength / (gain * young)
        }
        Space::Solid => {
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
    }
}

/// Critical stretches of brittle bonds (n_bonds).
pub fn critical_stretches<const D: usize>(basis: &Basis<'_, D>) -> Vec<f64> {
    critical_stretches_for(basis, &basis.each(|_, material| material.fracture_energy))
}

/// Critical stretches of brittle bonds (n_bonds) for fracture energies of the materials, J/m^2; a bond has the opening modulus of its
/// materials in series, and the mean length of the bonds of its ends.
pub(super) fn critical_stretches_for<const D: usize>(
    basis: &Basis<'_, D>,
    of_materials: &[f64],
) -> Vec<f64> {
    let system = basis.system;
    let energy = basis.weakest(of_materials);
    let moduli = basis.each(|constants, _| Some(opening_modulus(&constants.bonds, basis.space)));
    let lengths = mean_lengths(system);
    let of_bonds = energy.into_iter().zip(&*system.bonds.ends).enumerate();
    of_bonds
        .map(|(bond, (energy, &[a, b]))| {
            let modulus = basis.in_series(bond, &moduli);
            let length = 0.5 * (lengths[a as usize] + lengths[b as usize]);
            critical_stretch(energy, modulus, length, basis.space)
        })
        .collect()
}

/// Critical stretch for the fracture energy G_c (J/m^2), the [opening modulus](opening_modulus) M (Pa) and the mean bond length h (m):
///
/// s_0 = sqrt(G_c/(M h)) in the plane, s_0 = sqrt(4 G_c/(9 M h)) in space.
///
/// Every bond that crosses the plane of the crack is stretched to s_0 and gives 1/2 Omega alpha V_A V_B k_n l s_0^2. A bond of
/// length l crosses it where its first end lies within l |cos phi| of it. With the mean of |cos phi| over the directions, 2/pi in the plane and
/// 1/2 in space, that is per area
///
/// G_c = s_0^2/(2 pi) sum_B Omega alpha V_B k_n l^2 = s_0^2 M h in the plane,
/// G_c = s_0^2/8 sum_B Omega alpha V_B k_n l^2 = s_0^2 9/4 M h in space,
///
/// where sum_B Omega alpha V_B k_n l, which is 2 pi M in the plane and 18 M in space, is what the elastic moduli fix, and h is the mean
/// length of the bonds of a point, weighted by what each has of that sum ([`mean_lengths`]). A continuous family with a constant k_n has in
/// the plane h = 3 H/4, and then this is s_0 = sqrt(4 G_c/(t k_n H^4)), the two-dimensional form of Silling and Askari (2005, eq. 26); in
/// space it has h = 4 H/5, so that G_c = pi k_n s_0^2 H^5/10 and s_0 = sqrt(5 G_c/(9 M H)).
///
/// What shear stores in those bonds comes on top. With [`Measure::Energy`] it is counted, and G_c holds
/// for every Poisson's ratio up to that of central forces; with the plain stretch it holds where k_t = 0.
pub fn critical_stretch(
    fracture_energy: f64,
    opening_modulus: f64,
    mean_length: f64,
    space: impl Into<Space>,
) -> f64 {
    let opened = match space.into() {
        Space::Plane(_) => opening_modulus,
        Space::Solid => 2.25 * opening_modulus,
    };
    (fracture_energy / (opened * mean_length)).sqrt()
}

/// Opening modulus M of a material, Pa: t integral_0^H k_n l^2 dl in the plane, which is 2 E/(pi (1 - nu)) in plane stress and
/// 2 E/(pi (1 + nu)(1 - 2 nu)) in plane strain; in space the bulk modulus. All laws have it, with the Poisson's ratio that they give the
/// material.
pub fn opening_modulus(material: &Isotropic, space: impl Into<Space>) -> f64 {
    match space.into() {
        Space::Solid => material.bulk_modulus(),
        plane @ Space::Plane(_) => constants::axial(material, plane, 1.0) / 3.0,
    }
}

/// Mean lengths h = sum_B w l / sum_B w of the bonds of each point with the weights w = Omega alpha V_B k_n l, shape (n_points), m.
///
/// Points at a surface or beside a pre-crack have fewer bonds, of the same mean length.
pub fn mean_lengths<const D: usize>(system: &BondSystem<D>) -> Vec<f64> {
    let of_point = |point: u32| {
        let (mut sum, mut weights) = (0.0, 0.0);
        for &bond in system.bonds.incidence.at(point) {
            // The volume of the point itself cancels.
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
    use crate::material::Plane;

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

    /// chi in space against the integral by midpoints: 3/2 without Poisson's ratio, 2 for central forces.
    #[test]
    fn the_gain_in_space() {
        let parts = 100_000;
        for (poisson, closed) in [
            (0.0, Some(1.5)),
            (1e-5, None),
            (0.2, None),
            (0.25, Some(2.0)),
            (-0.3, None),
        ] {
            let isotropic = Isotropic {
                young: 1.0,
                poisson,
            };
            let found = 1.0 / stretch_at_strength(&isotropic, 1.0, Space::Solid);
            let q: f64 = (1.0 - 4.0 * poisson) / (1.0 + poisson);
            let integral: f64 = (0..parts)
                .map(|part| {
                    let t = (f64::from(part) + 0.5) / f64::from(parts);
                    (t * t + q * (1.0 - t * t)).sqrt() * t / f64::from(parts)
                })
                .sum();
            let expected = 3.0 / (1.0 - 2.0 * poisson) * integral;
            assert!((found / expected - 1.0).abs() < 1e-7, "{poisson}: {found}");
            assert!(closed.is_none_or(|it| (found / it - 1.0).abs() < 1e-12));
        }
    }
}
