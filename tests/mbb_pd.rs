//! MBB-PD on lattices: numbers of an independent calculation, energy and equilibrium of uniform strains, moduli of the infinite
//! lattice, and stability.
#![allow(clippy::unwrap_used)]

use std::sync::Arc;

use ligament_analysis::assembly;
use ligament_analysis::internal::{self, BondSweep};
use ligament_analysis::state::UnbrokenBonds;
use ligament_analysis::unknowns::Unknowns;
use ligament_linalg::SymmetricMatrix;
use ligament_model::element::imaginary::matrix;
use ligament_model::thermal::ThermalStrain;
use nalgebra::{DMatrix, Matrix3, Vector3};
use verification::bench::Bench;
use verification::numbers::relative_error;

/// 21 x 21 cells of 1 mm around the origin, 1 mm thick, of the material of the independent calculation.
const PLATE: &str = r#"
lattice = { cells = [21, 21], spacing = 0.001, corner = [-0.0105, -0.0105], thickness = 0.001, set = { base = { left = 1 }, end = { right = 1 } } }
material = { young = 65.8e9, poisson = 0.3 }
model = { law = "mbb-pd", horizon_factor = 3.0 }
support = [{ group = "base", displacement = { x = 0.0, y = 0.0 } }]
load = [{ group = "end", force = { x = 1e3 } }]
"#;

/// A material without symmetry.
const ANISOTROPIC: &str =
    "material={ c11 = 90e9, c12 = 25e9, c16 = 12e9, c22 = 40e9, c26 = -8e9, c66 = 30e9 }";
/// A stiff lamina at 45 degrees.
const LAMINA: &str = "material={ young_1 = 140e9, young_2 = 7e9, poisson_12 = 0.3, shear_modulus = 5e9, angle = 0.7853981633974483 }";
/// A hole beside the middle, and a bite out of a corner.
const HOLES: &str = "lattice.remove=[{ circle = { centre = [0.002, 0.001], radius = 0.0031 } }, { rectangle = [[0.0071, 0.0071], [0.02, 0.02]] }]";

/// The stiffness of the plane of the one material.
fn plane_stiffness(bench: &Bench) -> Matrix3<f64> {
    let materials = bench.model.setup.materials();
    let plane = bench.model.setup.plane();
    materials[0].elasticity.plane_stiffness(plane)
}

/// Deformations, forces and energy for a displacement of each point.
fn sweep(bench: &Bench, intact: &[bool], displacement: impl Fn([f64; 2]) -> [f64; 2]) -> BondSweep {
    let of_points = bench.positions().iter().map(|&it| displacement(it));
    let displacement: Vec<f64> = of_points.flatten().collect();
    let bonds = UnbrokenBonds::whole(intact);
    internal::sweep(
        &**bench.model.plane(),
        bonds,
        &displacement,
        ThermalStrain::NONE,
    )
}

fn whole(bench: &Bench) -> Vec<bool> {
    vec![true; bench.model.plane().bonds.len()]
}

/// The point nearest to a position.
fn point_at(bench: &Bench, at: [f64; 2]) -> usize {
    bench.model.plane().cloud.nearest_point(at) as usize
}

/// Offset of a bond in spacings, q > 0, or q = 0 and p > 0.
fn offset(bench: &Bench, bond: usize) -> [i32; 2] {
    let bonds = &bench.model.plane().bonds;
    let [p, q] =
        bonds.direction[bond].map(|cosine| (cosine * bonds.length[bond] / 1e-3).round() as i32);
    if q < 0 || (q == 0 && p < 0) {
        [-p, -q]
    } else {
        [p, q]
    }
}

/// Sums of lengths, weights and diagonals of the stiffness, from an independent calculation, printed with 9 to 12 digits.
#[test]
fn sums_weights_and_stiffness_are_those_of_the_independent_calculation() {
    let bench = Bench::new(PLATE, &[]);
    let system = &**bench.model.plane();
    let lengths = |at: [f64; 2]| -> f64 {
        let family = system.bonds.incidence.at(point_at(&bench, at) as u32);
        family
            .iter()
            .map(|&bond| system.bonds.length[bond as usize])
            .sum::<f64>()
            / 1e-3
    };
    for (at, expected) in [
        ([0.0, 0.0], 58.859_106_568_5),
        ([0.0, -0.01], 35.429_553_284_3),
        ([-0.01, -0.01], 20.714_776_642_1),
        ([0.0, -0.009], 43.730_116_364),
    ] {
        assert!(relative_error(lengths(at), expected) < 1e-11, "{at:?}");
    }
    let c = plane_stiffness(&bench);
    let interior = point_at(&bench, [0.0, 0.0]) as u32;
    let weight = |wanted: [i32; 2]| {
        let mut family = system
            .bonds
            .incidence
            .at(interior)
            .iter()
            .map(|&bond| bond as usize);
        let bond = family.find(|&bond| offset(&bench, bond) == wanted).unwrap();
        let stiffness = matrix(system.rigidities.strain[bond].entries);
        // All of it is a multiple of c.
        let weight = stiffness[(2, 2)] / c[(2, 2)];
        assert!((stiffness - weight * c).norm() < 1e-15 * stiffness.norm());
        weight
    };
    for (of, expected) in [
        ([1, 0], 3.397_944_883e-11),
        ([0, 2], 6.795_889_77e-11),
        ([1, 1], 4.805_419_74e-11),
        ([2, 1], 7.598_035_74e-11),
    ] {
        assert!(
            relative_error(weight(of), expected) < 2e-9,
            "{of:?}: {}",
            weight(of)
        );
    }
    let (unknowns, matrix) = free_stiffness(&bench, &whole(&bench));
    let diagonal = |at: [f64; 2]| {
        let along_x = system
            .topology()
            .layout
            .range(point_at(&bench, at) as u32)
            .start;
        let unknown = unknowns.number(along_x).unwrap();
        matrix.diagonal(unknown)
    };
    assert!(relative_error(diagonal([0.0, 0.0]), 4.975_202_07e7) < 2e-9);
    assert!(relative_error(diagonal([-0.01, 0.0]), 5.099_402_51e7) < 2e-9);
}

/// The stiffness of the body that nothing holds.
fn free_stiffness(bench: &Bench, intact: &[bool]) -> (Unknowns, SymmetricMatrix) {
    let system = &**bench.model.plane();
    let unknowns = Unknowns::all_but(system, |_| false);
    let pattern = Arc::new(assembly::pattern(system, &unknowns).unwrap());
    let held = vec![false; system.topology().layout.n_degrees_of_freedom()];
    let bonds = UnbrokenBonds::whole(intact);
    let matrix = assembly::assemble(system, &unknowns, &pattern, bonds, &held);
    (unknowns, matrix)
}

/// A uniform strain with a rotation, and the strain.
fn linear([x, y]: [f64; 2]) -> [f64; 2] {
    [1.3 * x - 0.4 * y, 1.7 * x - 0.6 * y]
}
const STRAIN: [f64; 3] = [1.3, -0.6, 1.3];

/// The energy of a uniform strain is 1/2 eps c eps V to rounding of some 10^4 terms, for all materials, horizons, outlines and forms that
/// have an energy: the factors psi are made of what a point has.
#[test]
fn uniform_strains_have_the_energy_of_the_continuum() {
    for material in [
        "material.poisson=0.3",
        "lattice.plane=strain",
        LAMINA,
        ANISOTROPIC,
    ] {
        for horizon in ["2.0", "3.0", "3.015", "4.0", "5.0"] {
            for form in ["full", "rows"] {
                let horizon = format!("model.horizon_factor={horizon}");
                let form = format!("model.form={form}");
                let bench = Bench::new(PLATE, &[material, &horizon, &form, HOLES]);
                let strain = Vector3::from(STRAIN);
                let volume: f64 = bench.model.plane().cloud.volumes.iter().sum();
                let expected = 0.5 * strain.dot(&(plane_stiffness(&bench) * strain)) * volume;
                let found = sweep(&bench, &whole(&bench), linear).stored_energy;
                assert!(
                    relative_error(found, expected) < 1e-12,
                    "{material} {horizon} {form}: {found} {expected}"
                );
            }
        }
    }
}

/// Inside, more than 2 m rows from the outline, a uniform strain leaves no force, to rounding of what meets at a point. Nearer it does:
/// the test must see that.
#[test]
fn uniform_strains_are_in_equilibrium_inside() {
    for form in ["full", "rows", "pairwise"] {
        let form = format!("model.form={form}");
        let bench = Bench::new(PLATE, &[ANISOTROPIC, &form]);
        let swept = sweep(&bench, &whole(&bench), linear);
        let largest = |inside: bool| {
            let points = bench.positions().iter().enumerate();
            let wanted = points.filter(|(_, at)| at.iter().all(|it| it.abs() < 4.4e-3) == inside);
            wanted
                .flat_map(|(point, _)| {
                    &swept.internal.values
                        [bench.model.plane().topology().layout.range(point as u32)]
                })
                .fold(0.0_f64, |largest, force| largest.max(force.abs()))
        };
        assert!(largest(true) < 1e-12 * swept.internal.force_scale, "{form}");
        assert!(largest(false) > 1e-2 * swept.internal.force_scale, "{form}");
    }
}

/// Moduli of the infinite lattice over those of the material: the forces on a point inside for quadratic displacements are the second
/// moments of the stiffness, as are those of long waves. u = x^2/2 gives c_11, u = y^2/2 c_66, v = x y c_12 + c_66. Those of the printed
/// form are from an independent calculation of the Fourier symbol, printed with three digits.
#[test]
fn moduli_of_the_infinite_lattice_are_right_but_for_the_printed_form() {
    for (form, expected, tolerance) in [
        ("full", [1.0, 1.0, 1.0], 1e-10),
        ("rows", [1.0, 1.0, 1.0], 1e-10),
        ("pairwise", [0.594, 0.238, 0.402], 5e-4),
    ] {
        let form = format!("model.form={form}");
        let bench = Bench::new(PLATE, &[&form]);
        let c = plane_stiffness(&bench);
        let middle = point_at(&bench, [0.0, 0.0]);
        let force_x = |displacement: fn([f64; 2]) -> [f64; 2]| {
            let swept = sweep(&bench, &whole(&bench), displacement);
            let along_x = bench
                .model
                .plane()
                .topology()
                .layout
                .range(middle as u32)
                .start;
            -swept.internal.values[along_x] / bench.model.plane().cloud.volumes[middle]
        };
        let found = [
            force_x(|[x, _]| [0.5 * x * x, 0.0]) / c[(0, 0)],
            force_x(|[_, y]| [0.5 * y * y, 0.0]) / c[(2, 2)],
            force_x(|[x, y]| [0.0, x * y]) / (c[(0, 1)] + c[(2, 2)]),
        ];
        for (found, expected) in found.into_iter().zip(expected) {
            assert!(
                (found - expected).abs() < tolerance,
                "{form}: {found} {expected}"
            );
        }
    }
}

/// Numbers between 0 and 1 from a linear congruence, the same in every run.
fn numbers(mut seed: u32) -> impl FnMut() -> f64 {
    move || {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(seed) / f64::from(u32::MAX)
    }
}

/// Free plates of 14 x 14 cells have three rigid motions and no negative eigenvalue: at all Poisson's ratios, with a stiff lamina at 45
/// degrees, with a hole, half cracked, and with 15 % of the bonds broken. The smallest elastic eigenvalue is above 1e-5 of the largest,
/// rounding below 1e-13: 1e-9 is between them.
#[test]
fn free_plates_are_stable() {
    const SIZE: &str = "lattice.cells=[14, 14]";
    const CORNER: &str = "lattice.corner=[-0.007, -0.007]";
    let crack = "precrack=[{ points = [[-0.02, 0.0], [0.0, 0.0]] }]";
    let hole = "lattice.remove=[{ circle = { centre = [0.0, 0.0], radius = 0.0026 } }]";
    let cases: [(&str, &[&str], f64); 8] = [
        ("nu = -0.9", &["material.poisson=-0.9"], 0.0),
        ("nu = 0.3", &[], 0.0),
        (
            "nu = 0.49",
            &["material.poisson=0.49", "lattice.plane=strain"],
            0.0,
        ),
        ("lamina", &[LAMINA], 0.0),
        ("hole", &[hole], 0.0),
        ("half crack", &[crack], 0.0),
        ("bonds lost", &[], 0.15),
        (
            "bonds lost, nu = 0.49",
            &["material.poisson=0.49", "lattice.plane=strain"],
            0.15,
        ),
    ];
    for (name, settings, lost) in cases {
        let settings: Vec<&str> = [SIZE, CORNER]
            .into_iter()
            .chain(settings.iter().copied())
            .collect();
        let bench = Bench::new(PLATE, &settings);
        let mut next = numbers(5);
        let intact: Vec<bool> = whole(&bench).iter().map(|_| next() >= lost).collect();
        let (_, matrix) = free_stiffness(&bench, &intact);
        let n = matrix.pattern().dimension();
        let mut dense = DMatrix::zeros(n, n);
        let (starts, rows) = (matrix.pattern().column_starts(), matrix.pattern().rows());
        for column in 0..n {
            for entry in starts[column]..starts[column + 1] {
                dense[(rows[entry], column)] = matrix.values[entry];
                dense[(column, rows[entry])] = matrix.values[entry];
            }
        }
        let eigenvalues = dense.symmetric_eigenvalues();
        let small = 1e-9 * eigenvalues.max();
        let zeros = eigenvalues.iter().filter(|it| it.abs() < small).count();
        let negative = eigenvalues.iter().filter(|it| **it <= -small).count();
        assert_eq!((zeros, negative), (3, 0), "{name}");
    }
}

/// Rectangular cells (dx and dy of eq. 19): at every point of a plate with a hole the energy of a uniform strain is that of the continuum,
/// and the strains of all bonds are the uniform ones; more than 2 m rows inside no force is left. All to rounding.
#[test]
fn uniform_strains_are_exact_on_rectangular_cells() {
    for [dx, dy] in [[0.001_f64, 0.0015], [0.0021, 0.001]] {
        for (form, horizon) in [("full", "3.0"), ("full", "4.0"), ("rows", "3.0")] {
            let spacing = format!("lattice.spacing=[{dx}, {dy}]");
            let corner = format!("lattice.corner=[{}, {}]", -20.5 * dx, -20.5 * dy);
            let [form, horizon] = [
                format!("model.form={form}"),
                format!("model.horizon_factor={horizon}"),
            ];
            let settings = [
                &spacing,
                &form,
                &horizon,
                &corner,
                "lattice.cells=[41, 41]",
                ANISOTROPIC,
            ];
            let hole = "lattice.remove=[{ circle = { centre = [0.01, 0.005], radius = 0.0041 } }]";
            let bench = Bench::new(PLATE, &[settings.as_slice(), &[hole]].concat());
            let swept = sweep(&bench, &whole(&bench), linear);
            let off = swept.deformations.iter().flat_map(|deformation| {
                let found = deformation.strain();
                [0, 1, 2].map(|place| (found[place] - STRAIN[place]).abs())
            });
            assert!(off.fold(0.0, f64::max) < 1e-12, "{spacing} {form}");
            let strain = Vector3::from(STRAIN);
            let volume: f64 = bench.model.plane().cloud.volumes.iter().sum();
            let expected = 0.5 * strain.dot(&(plane_stiffness(&bench) * strain)) * volume;
            assert!(
                relative_error(swept.stored_energy, expected) < 1e-12,
                "{spacing} {form}"
            );
            let solid = Bench::new(PLATE, &settings);
            let swept = sweep(&solid, &whole(&solid), linear);
            let reach = 2.0 * 4.0 * dx.min(dy);
            let largest = |inside: bool| {
                let points = solid.positions().iter().enumerate();
                let is_inside =
                    |[x, y]: [f64; 2]| x.abs() < 20.0 * dx - reach && y.abs() < 20.0 * dy - reach;
                points
                    .filter(|(_, at)| is_inside(**at) == inside)
                    .flat_map(|(point, _)| {
                        let range = solid.model.plane().topology().layout.range(point as u32);
                        &swept.internal.values[range]
                    })
                    .fold(0.0_f64, |largest, force| largest.max(force.abs()))
            };
            assert!(
                largest(true) < 1e-12 * swept.internal.force_scale,
                "{spacing} {form}"
            );
            assert!(
                largest(false) > 1e-2 * swept.internal.force_scale,
                "{spacing} {form}"
            );
        }
    }
}
