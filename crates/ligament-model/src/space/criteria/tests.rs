use super::*;
use crate::bonds::BondSet;
use crate::cloud::PointCloud;
use crate::element::ElementKind;
use crate::failure::{KINDS as IN_PLANE, Measure, Unfit};
use crate::horizon::Horizons;
use crate::law::beam::{self, ShearForm};
use crate::law::pds;
use crate::material::Space;
use crate::material::{Isotropic, Material};
use crate::system::BondSystem;

const YOUNG: f64 = 30e9;

fn material(poisson: f64) -> Material {
    Material {
        tensile_strength: Some(3e6),
        compressive_strength: Some(30e6),
        fracture_energy: Some(80.0),
        ..Material::isotropic(YOUNG, poisson)
    }
}

/// A block of a cubic lattice with the spacing 1, from 0 to `size` - 1 along each axis.
fn block(size: [i32; 3], horizon: f64, poisson: f64, element: ElementKind) -> BondSystem<3> {
    let [nx, ny, nz] = size;
    let mut positions = Vec::new();
    for i in 0..nx {
        for j in 0..ny {
            for k in 0..nz {
                positions.push([i, j, k].map(f64::from));
            }
        }
    }
    let n = positions.len();
    let cloud = PointCloud::from_points(&positions, &vec![1.0; n], 1.0, &vec![0; n], 1);
    let bonds = BondSet::<3>::search(&cloud, &Horizons::unified(horizon, n));
    let materials = [Isotropic {
        young: YOUNG,
        poisson,
    }];
    let stiffness = match element {
        ElementKind::Beam => beam::stiffness(
            &bonds,
            &cloud,
            &materials,
            Space::Solid,
            ShearForm::Constant,
        ),
        _ => pds::stiffness(&bonds, &cloud, &materials, Space::Solid),
    };
    let ones = vec![1.0; bonds.len()];
    BondSystem::new(cloud, bonds, element, stiffness, ones.clone(), &ones)
}

fn basis<'a>(
    system: &'a BondSystem<3>,
    materials: &'a [Material],
    no_fail: &'a [bool],
) -> SolidBasis<'a> {
    SolidBasis {
        system,
        no_fail,
        materials,
        constants: (materials.iter())
            .filter_map(|it| it.elasticity.isotropic())
            .collect(),
        scatter: None,
    }
}

/// Bonds of a large lattice that a plane across x between two layers of points separates, when each is stretched to its critical stretch:
/// G_c per area of the plane, by the sum over the bonds alone. The families are whole in the middle of the block; a finite number of
/// lengths and directions misses the mean 1/2 of |cos phi| by what is asserted.
#[test]
fn splitting_a_block_takes_the_fracture_energy() {
    let size = [12, 13, 13];
    let system = block(size, 3.0, 0.25, ElementKind::Spring);
    let materials = [material(0.25)];
    let no_fail = vec![false; system.cloud.len()];
    let limits = fracture_energy::critical_stretches(&basis(&system, &materials, &no_fail));
    // Scales the densities to the bulk modulus, which the integral misses on a lattice: only whole families count.
    let bonds = &system.bonds;
    let place = |point: u32| {
        let p = system.cloud.positions[point as usize];
        [0, 1, 2].map(|axis| p[axis] + 0.5 * f64::from(size[axis] - 1))
    };
    let middle = (0..system.cloud.len() as u32)
        .find(|&point| place(point) == [5.0, 6.0, 6.0])
        .unwrap_or_default();
    let sum: f64 = (bonds.incidence.at(middle).iter())
        .map(|&bond| system.rigidities.axial[bond as usize])
        .sum();
    let scale = 18.0 * YOUNG / 1.5 / sum;
    let mut energy = 0.0;
    for (bond, ends) in bonds.ends.iter().enumerate() {
        let [a, b] = ends.map(place);
        let crosses = (a[0] < 5.5) != (b[0] < 5.5);
        // Each bond through a window of one point's area: counted where its lower end lies above that area.
        let lower = if a[0] < b[0] { a } else { b };
        if crosses && lower[1] == 6.0 && lower[2] == 6.0 {
            energy += 0.5 * scale * system.rigidities.axial[bond] * limits[bond].powi(2);
        }
    }
    assert!((energy / 80.0 - 1.0).abs() < 0.015, "{energy}");
    // In the continuum the stretch is sqrt(5 G/(9 K H)).
    let continuous = fracture_energy::critical_stretch(80.0, YOUNG / 1.5, 0.8 * 3.0);
    let expected: f64 = (5.0 * 80.0 / (9.0 * YOUNG / 1.5 * 3.0)).sqrt();
    assert!((continuous / expected - 1.0).abs() < 1e-14);
}

/// e_0 is the energy of the uniaxial strain F_t/E, and s_0 the stretch at which the share of the bond reaches it: V e_0 = 1/2 K s_0^2 for
/// two points of volume V, half of which belongs to each.
#[test]
fn strength_is_an_energy() {
    let system = block([4, 4, 4], 2.0, 0.2, ElementKind::Beam);
    let materials = [material(0.2)];
    let mut no_fail = vec![false; system.cloud.len()];
    no_fail[0] = true;
    let limits = strength::critical_stretches(&basis(&system, &materials, &no_fail));
    let [mode, ..] = crate::correction::StrainMode::<3>::uniaxial();
    let isotropic = Isotropic {
        young: YOUNG,
        poisson: 0.2,
    };
    let stiffness = crate::Elasticity::Isotropic(isotropic).stiffness::<3>(crate::Plane::Strain);
    let energy = mode.energy(&stiffness.expect("isotropic materials have a stiffness in space"))
        * (3e6 / YOUNG).powi(2);
    assert!((strength::critical_energy(&isotropic, 3e6) / energy - 1.0).abs() < 1e-14);
    for (bond, &limit) in limits.iter().enumerate() {
        if system.bonds.ends[bond].contains(&0) {
            assert_eq!(limit, f64::INFINITY);
        } else {
            let stored = 0.5 * system.rigidities.axial[bond] * limit * limit;
            assert!((stored / energy - 1.0).abs() < 1e-12);
        }
    }
}

/// chi in closed form against the integral by midpoints: 3/2 without Poisson's ratio, 2 for central forces.
#[test]
fn the_gain_of_a_crack_that_opens() {
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
        let found = 1.0 / fracture_energy::stretch_at_strength(&isotropic, 1.0);
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

/// Strains of a bar under its strength F: F/E along it, sliding F (1 + nu)/(2 E) at 45 degrees.
#[test]
fn limits_of_a_bar() {
    let system = block([4, 4, 4], 2.0, 0.2, ElementKind::Beam);
    let materials = [material(0.2)];
    let no_fail = vec![false; system.cloud.len()];
    let basis = basis(&system, &materials, &no_fail);
    let choices = [stretch::TENSION, stretch::COMPRESSION, sliding::SLIDING].map(Choice::from);
    let found = criteria(&choices, &basis).expect("the criteria exist in space");
    let expected = [1e-4, 1e-3, 0.6e-4];
    for (criterion, expected) in found.list.iter().zip(expected) {
        assert!((criterion.limit[7] / expected - 1.0).abs() < 1e-14);
    }
    let own = Choice {
        limit: Some(0.01),
        ..Choice::from(stretch::TENSION)
    };
    let found = criteria(&[own], &basis).expect("the criterion exists in space");
    assert_eq!(found.list[0].limit[0], 0.01);
}

/// Bonds that soften by their energy begin at the strength and take the fracture energy: (s_G/s_0)^2 times what they store at s_0, which
/// a straight fall ends at that many s_0.
#[test]
fn softening_takes_the_fracture_energy() {
    let system = block([5, 5, 5], 2.0, 0.2, ElementKind::Beam);
    let materials = [Material {
        tensile_strength: Some(1e3),
        ..material(0.2)
    }];
    let no_fail = vec![false; system.cloud.len()];
    let basis = basis(&system, &materials, &no_fail);
    let choice = Choice {
        after: crate::failure::After {
            law: crate::failure::softening::linear::LAW,
            parameter: None,
        },
        ..Choice::from(energies::BOND_ENERGY)
    };
    let found = criteria(&[choice], &basis).expect("the criterion exists in space");
    let criterion = &found.list[0];
    let isotropic = Isotropic {
        young: YOUNG,
        poisson: 0.2,
    };
    let begin = fracture_energy::stretch_at_strength(&isotropic, 1e3);
    let brittle = fracture_energy::critical_stretches(&basis);
    for (bond, &limit) in criterion.limit.iter().enumerate() {
        assert!((limit / begin - 1.0).abs() < 1e-14);
        let taken = criterion.after.total_dissipated(bond);
        assert!((taken / (brittle[bond] / limit).powi(2) - 1.0).abs() < 1e-12);
    }
    let shear = system.rigidities.shear[3] / system.rigidities.axial[3];
    assert_eq!(criterion.coefficients(3), [shear]);
    // A strength at which bonds store more than the fracture energy leaves nothing.
    let strong = [Material {
        tensile_strength: Some(1e9),
        ..material(0.2)
    }];
    let basis = SolidBasis {
        materials: &strong,
        ..basis
    };
    let refused = criteria(&[choice], &basis);
    assert!(matches!(
        refused,
        Err((0, NoSolidLimit::NoLimit(NoLimit::NothingLeft { .. })))
    ));
}

#[test]
fn criteria_of_the_plane_are_refused_by_name() {
    let refused: Vec<&str> = (IN_PLANE.iter())
        .filter_map(|kind| require_in_space(kind).err())
        .map(|it| it.kind)
        .collect();
    assert_eq!(refused.len(), IN_PLANE.len() - KINDS.len());
    assert!(refused.contains(&"fibre") && refused.contains(&"mixed-mode"));
    let words = PlaneOnly { kind: "fibre" }.to_string();
    assert!(
        words.contains("\"fibre\" exists in the plane alone") && words.contains("\"strength\"")
    );
    let all_known = KINDS.iter().flat_map(|it| it.measures);
    assert!(
        all_known
            .copied()
            .all(Measure::is_known_along_lines_in_space)
    );
    assert!(Choice::from(strengths::STRENGTH).check(true).is_ok());
    assert!(matches!(
        Choice::from(strengths::STRENGTH).suits(&Material::isotropic(1.0, 0.2)),
        Err(Unfit::Missing { .. })
    ));
}
