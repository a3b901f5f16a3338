//! Stresses at the points against the continuum, and against the forces that the bodies bear.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use ligament_analysis::internal;
use ligament_analysis::state::UnbrokenBonds;
use ligament_mesh::Mesh;
use ligament_model::interface::StressReading;
use ligament_model::thermal::ThermalStrain;
use verification::bench::{self, Bench, Run};
use verification::meshes;
use verification::numbers::{Random, largest, relative_error};
use verification::stresses::of_reading;

/// Plate 0.2 x 0.1 m, 2 cm thick, of 1543 irregular points; each test brings its loads along.
const PLATE: &str = r#"
mesh = { file = "../meshes/plate.msh", thickness = 0.02 }
material = { young = 15e9, poisson = 0.21 }
model = { law = "nhpd", horizon_factor = 3.0 }
"#;

/// Tension of 1 MPa by forces at both ends; only gauges hold the plate.
const PULL: &str = r#"
load = [
    { group = "right", name = "pull", force = { x = 2e3 } },
    { group = "left", force = { x = -2e3 } },
]
"#;

const YOUNG: f64 = 15e9; // Pa
const POISSON: f64 = 0.21;

/// Virial stress (xx, yy, xy) and tractions (xx, yx, yy, xy) of displacements (3 n_points).
fn stresses(bench: &Bench, intact: &[bool], u: &[f64]) -> (Vec<[f64; 3]>, Vec<[f64; 4]>) {
    let system = &**bench.model.plane();
    let deformations =
        internal::sweep(system, UnbrokenBonds::whole(intact), u, ThermalStrain::NONE).deformations;
    let left = UnbrokenBonds::whole(intact);
    (
        of_reading(StressReading::Virial, system, left, &deformations),
        of_reading(StressReading::Traction, system, left, &deformations),
    )
}

fn stresses_of_run(bench: &Bench, run: &Run) -> (Vec<[f64; 3]>, Vec<[f64; 4]>) {
    stresses(bench, &run.state().intact, run.displacement())
}

/// Mean over some points by their volumes, of a component that a test picks.
fn mean(bench: &Bench, points: &[usize], value: impl Fn(usize) -> f64) -> f64 {
    let volumes = &bench.model.plane().cloud.volumes;
    let sum: f64 = points
        .iter()
        .map(|&point| volumes[point] * value(point))
        .sum();
    sum / points.iter().map(|&point| volumes[point]).sum::<f64>()
}

fn points_where(bench: &Bench, inside: impl Fn([f64; 2]) -> bool) -> Vec<usize> {
    let points = (0..bench.points()).filter(|&point| inside(bench.positions()[point]));
    points.collect()
}

/// Mean stress theorem: for the forces F_i that hold any state of a body, sum V_i sigma_i = sum F_i (x) X_i, with the
/// symmetric part for the virial stress. A strain with random displacements and rotations, a fifth of the bonds broken; equal
/// to rounding, relative to the sizes of the terms. A sign, a factor, or a force that a plane misses or counts twice would show.
#[test]
fn stresses_have_the_mean_of_the_forces() {
    for mesh in ["plate-coarse", "diagonal-plate"] {
        let text = format!("{PLATE}load = [{{ body_force = {{ x = 1.0 }} }}]\n");
        let bench = Bench::new(&text, &[&format!("mesh.file=../meshes/{mesh}.msh")]);
        let system = &**bench.model.plane();
        let random = &mut Random(3);
        let motion = |[x, y]: &[f64; 2]| {
            let strained = [1e-4 * x + 3e-4 * y, 2e-4 * y - 1e-4 * x, 1e-4];
            strained.map(|value| value + 1e-5 * random.uniform())
        };
        let u: Vec<f64> = system.cloud.positions.iter().flat_map(motion).collect();
        let intact: Vec<bool> = (0..system.bonds.len())
            .map(|_| random.uniform() < 0.6)
            .collect();
        assert!(intact.contains(&false));
        let forces = internal::sweep(
            system,
            UnbrokenBonds::whole(&intact),
            &u,
            ThermalStrain::NONE,
        )
        .internal
        .values;
        let (of_bonds, of_planes) = stresses(&bench, &intact, &u);
        let cloud = &system.cloud;
        // The force's direction first, then the place's.
        let sum = |f: usize, x: usize| {
            let points = forces.chunks(3).zip(&cloud.positions);
            points.fold([0.0; 2], |[sum, size], (force, p)| {
                let term = force[f] * p[x];
                [sum + term, size + term.abs()]
            })
        };
        let total = |value: &dyn Fn(usize) -> f64| {
            (0..bench.points())
                .map(|i| cloud.volumes[i] * value(i))
                .sum::<f64>()
        };
        let [xx, yx, yy, xy] = [sum(0, 0), sum(1, 0), sum(1, 1), sum(0, 1)];
        for (k, expected) in [xx, yx, yy, xy].into_iter().enumerate() {
            let error = total(&|i| of_planes[i][k]) - expected[0];
            assert!(expected[0].abs() > 1e-6 * expected[1], "there is a stress");
            assert!(
                error.abs() < 1e-12 * expected[1],
                "{mesh}, traction {k}: {error:e} of {expected:?}"
            );
        }
        let symmetric = [0, 1].map(|k| 0.5 * (xy[k] + yx[k]));
        for (k, expected) in [xx, yy, symmetric].into_iter().enumerate() {
            let error = total(&|i| of_bonds[i][k]) - expected[0];
            assert!(
                error.abs() < 1e-12 * expected[1],
                "{mesh}, virial {k}: {error:e} of {expected:?}"
            );
        }
    }
}

/// Uniform strains of an irregular mesh and of a lattice, with a rigid rotation that must not show, against Hooke's law in
/// plane stress, 15 mm (two horizons) from the outline.
///
/// The virial stress is the derivative of the points' energies: of uniaxial ones, which the correction makes right, the
/// stress along the strain is right to 1e-4. Across, and in shear, this method's energies are off by the mean of some per
/// cent and by more at single points of a mesh (`discretisation`): 6 % across and 2.5 % in shear are allowed for the means
/// (measured 4.7 and 2.1), 0.15 of the largest stress for a point (0.12). Tractions are the same forces cut in
/// other pieces: in the mean of the same points they miss the virial stress by 0.5 % of the largest stress at most (0.35).
#[test]
fn uniform_strains_have_the_stress_of_the_continuum() {
    let strain = 1e-4;
    let axial = YOUNG / (1.0 - POISSON * POISSON) * strain;
    let shear = YOUNG / (2.0 * (1.0 + POISSON)) * strain;
    let lattice = meshes::lattice(40, 0.0025, [0.0, 0.0]);
    let plate = meshes::read("meshes/plate.msh");
    let load = "load = [{ body_force = { x = 1.0 } }]\n";
    for (name, mesh, length) in [("plate", &plate, 0.2), ("lattice", &lattice, 0.1)] {
        let bench = Bench::on(mesh, &format!("{PLATE}{load}"), &[]);
        let intact = vec![true; bench.model.plane().bonds.len()];
        let inner = points_where(&bench, |[x, y]| {
            [x, length - x, y, 0.1 - y]
                .into_iter()
                .all(|distance| distance > 0.015)
        });
        assert!(inner.len() > 500);
        for (mode, [xx, yy, xy], expected) in [
            ("x", [strain, 0.0, 0.0], [axial, POISSON * axial, 0.0]),
            ("y", [0.0, strain, 0.0], [POISSON * axial, axial, 0.0]),
            ("shear", [0.0, 0.0, strain], [0.0, 0.0, shear]),
        ] {
            let turn = 3e-4;
            let motion = |[x, y]: &[f64; 2]| {
                [
                    xx * x + (0.5 * xy - turn) * y,
                    yy * y + (0.5 * xy + turn) * x,
                    turn,
                ]
            };
            let u: Vec<f64> = bench.positions().iter().flat_map(motion).collect();
            let (of_bonds, of_planes) = stresses(&bench, &intact, &u);
            let size = largest(expected);
            let means = [0, 1, 2].map(|k| mean(&bench, &inner, |i| of_bonds[i][k]));
            let worst =
                |k: usize| largest(inner.iter().map(|&i| of_bonds[i][k] - expected[k])) / size;
            println!(
                "{name} {mode}: {:.4?} of the largest, worst {:.4?}",
                means.map(|it| it / size),
                [0, 1, 2].map(worst)
            );
            for k in 0..3 {
                let exact = expected[k] == axial;
                let tolerance = match k {
                    _ if exact => 1e-4 * size,
                    2 => 0.025 * size,
                    _ => 0.06 * POISSON * size,
                };
                assert!(
                    (means[k] - expected[k]).abs() < tolerance,
                    "{name} {mode} {k}: {means:?}"
                );
                assert!(
                    worst(k) < if exact { 1e-4 } else { 0.15 },
                    "{name} {mode} {k}"
                );
            }
            for (k, same) in [(0, 0), (1, 2), (2, 1), (3, 2)] {
                let planes = mean(&bench, &inner, |i| of_planes[i][k]);
                assert!(
                    (planes - means[same]).abs() < 5e-3 * size,
                    "{name} {mode}, traction {k}: {planes:e}"
                );
            }
        }
    }
}

/// A plate in tension, 2 kN on 0.1 x 0.02 m: in equilibrium the stress is F/A, whatever the moduli of the method are. Traction
/// integrated over a section, by the points of a strip of four spacings with their volumes, is the force to 1 %, wherever the
/// section is and with its ends at the free sides; so is the virial stress. Single points 20 mm from the outline: 3 % of it
/// (measured 2.8), where the irregular mesh strains unevenly.
#[test]
fn sections_of_a_plate_in_tension_carry_the_force() {
    let bench = Bench::new(&format!("{PLATE}{PULL}"), &[]);
    let run = bench.solve();
    let (of_bonds, of_planes) = stresses_of_run(&bench, &run);
    let stress = 2e3 / (0.1 * 0.02);
    for section in [0.04, 0.07, 0.1, 0.13, 0.16] {
        let strip = points_where(&bench, |[x, _]| (x - section).abs() < 0.008);
        assert!(strip.len() > 80);
        let [xx, yx] = [0, 1].map(|k| mean(&bench, &strip, |i| of_planes[i][k]));
        let virial = mean(&bench, &strip, |i| of_bonds[i][0]);
        println!(
            "x = {section}: traction {:.4}, shear {:.1e}, virial {:.4} of F/A",
            xx / stress,
            yx / stress,
            virial / stress
        );
        assert!(relative_error(xx, stress) < 0.01 && yx.abs() < 0.01 * stress);
        assert!(relative_error(virial, stress) < 0.01);
    }
    let inner = points_where(&bench, |[x, y]| {
        [x, 0.2 - x, y, 0.1 - y]
            .into_iter()
            .all(|distance| distance > 0.02)
    });
    for (k, expected) in [stress, 0.0, 0.0, 0.0].into_iter().enumerate() {
        let worst = largest(inner.iter().map(|&i| of_planes[i][k] - expected));
        assert!(worst < 0.03 * stress, "traction {k}: {worst:e}");
    }
}

/// Pure bending by p y/h at the ends, h = 0.05 m from the middle, p = 1 MPa: sections bear no force but what the irregular points of
/// a strip have off the axis, to 1 % of p A, and the moment 2 p h^2 t/3, to 1 % of it.
#[test]
fn sections_of_a_bent_plate_carry_the_moment() {
    let profile = "profile = { along = \"y\", zero = 0.05, one = 0.1 }";
    let ends = [("right", 2e4), ("left", -2e4)].map(|(group, line)| {
        format!("[[load]]\ngroup = \"{group}\"\nforce_per_length = {{ x = {line:?} }}\n{profile}\n")
    });
    let bench = Bench::new(&format!("{PLATE}{}", ends.concat()), &[]);
    let run = bench.solve();
    let (_, of_planes) = stresses_of_run(&bench, &run);
    let expected = 2.0 / 3.0 * 1e6 * 0.05 * 0.05 * 0.02;
    let area = 0.1 * 0.02;
    for section in [0.06, 0.1, 0.14] {
        let strip = points_where(&bench, |[x, _]| (x - section).abs() < 0.008);
        let height = |i: usize| bench.positions()[i][1] - 0.05;
        let force = area * mean(&bench, &strip, |i| of_planes[i][0]);
        let moment = area * mean(&bench, &strip, |i| of_planes[i][0] * height(i));
        println!("x = {section}: {force:.2} N, {moment:.4} N m, expected {expected:.4}");
        let off_centre = 1e6 * area * mean(&bench, &strip, height) / 0.05;
        assert!((force - off_centre).abs() < 0.01 * 1e6 * area);
        assert!(relative_error(moment, expected) < 0.01, "{moment}");
    }
}

/// The same bits for one thread and for four.
#[test]
fn stresses_do_not_depend_on_the_number_of_threads() {
    let bench = Bench::new(&format!("{PLATE}{PULL}"), &[]);
    let run = bench.solve();
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| stresses_of_run(&bench, &run))
    };
    assert_eq!(on(1), on(4));
}

/// The plate with stress fields or without them; a probe reads what the field has at its point, and a warning says what it is worth.
#[test]
fn stresses_are_written_where_they_are_asked_for() {
    let coarse: Mesh = meshes::read("meshes/plate-coarse.msh");
    let from_middle = |p: &&[f64; 2]| (p[0] - 0.1).hypot(p[1] - 0.05);
    let places = coarse.positions.iter();
    let place = places
        .min_by(|p, q| from_middle(p).total_cmp(&from_middle(q)))
        .unwrap();
    let probe =
        format!("[[probe]]\nname = \"middle\"\nat = {place:?}\nfield = \"stress_virial.xx\"\n");
    let bench = Bench::on(&coarse, &format!("{PLATE}{PULL}{probe}"), &[]);
    let run = bench.solve();
    let told = bench
        .model
        .warnings
        .iter()
        .any(|it| it.kind == "virial-stress");
    assert!(told, "{:?}", bench.model.warnings);
    let point = bench.model.plane().cloud.nearest_point(*place) as usize;
    assert_eq!(
        run.last().probes,
        [stresses_of_run(&bench, &run).0[point][0]]
    );
    assert!(relative_error(run.last().probes[0], 1e6) < 0.1);
    let fields = |setting: &str| {
        let folder = tempfile::tempdir().unwrap();
        let settings = ["mesh.file=../meshes/plate-coarse.msh", setting];
        let case = bench::case(&format!("{PLATE}{PULL}"), &settings);
        let told = bench::run_program(&case, &folder.path().join("out")).warnings;
        let is_told = told.iter().any(|it| it.starts_with("virial stresses ("));
        assert_eq!(is_told, setting.contains("virial"), "{told:?}");
        std::fs::read_to_string(folder.path().join("out/fields_0001.vtu")).unwrap()
    };
    let virial = "Name=\"stress_virial\" NumberOfComponents=\"6\" ComponentName0=\"XX\" ComponentName1=\"YY\" ComponentName2=\"ZZ\" ComponentName3=\"XY\" ComponentName4=\"YZ\" ComponentName5=\"XZ\"";
    let traction = "Name=\"stress_traction\" NumberOfComponents=\"4\" ComponentName0=\"XX\" ComponentName1=\"XY\" ComponentName2=\"YX\" ComponentName3=\"YY\"";
    let both = fields("output.stress=[\"virial\", \"traction\"]");
    assert!(both.contains(virial) && both.contains(traction));
    let one = fields("output.stress=[\"traction\"]");
    assert!(!one.contains("stress_virial") && one.contains(traction));
    assert!(!fields("output.bonds=false").contains("stress"));
}

/// A strip in plane strain that is pulled along y and free to contract along x, with E = 200 GPa and nu = 1/4: sigma_yy = E eps/(1 - nu^2) away
/// from its ends, sigma_zz = nu sigma_yy, and equivalent stresses of sigma_yy, sigma_zz and 0, sigma_yy sqrt(1 - nu + nu^2) and sigma_yy. Bonds
/// of a lattice reach that with the error of their surfaces: 10 % in the stress, with an xx of 2 % of it, and 2 % in the ratios.
#[test]
fn equivalent_stresses_have_the_stress_across_the_plane() {
    let probe =
        |name: &str| format!("[[probe]]\nname = \"{name}\"\nat = [1.0, 5.0]\nfield = \"{name}\"\n");
    let names = [
        "stress.yy",
        "stress.zz",
        "stress_von_mises",
        "stress_tresca",
        "stress.xx",
        "stress.xy",
    ];
    let strip = r#"
lattice = { cells = [8, 40], spacing = 0.25, thickness = 0.25, plane = "strain", set = { bottom = { bottom = 3 }, top = { top = 3 } } }
material = { young = 200e9, poisson = 0.25 }
model = { law = "nhpd", horizon = 0.751 }
support = [{ group = "bottom", displacement = { y = 0.0 } }, { at = [0.875, 0.125], displacement = { x = 0.0 } }]
load = [{ group = "top", displacement = { y = 0.00925 } }]
"#;
    let case = strip.to_owned() + &names.map(probe).concat();
    let run = Bench::new(&case, &[]).solve();
    let [yy, zz, von_mises, tresca, xx, xy] = run.last().probes[..] else {
        panic!("six probes");
    };
    let nu = 0.25_f64;
    assert!(relative_error(zz, nu * (xx + yy)) < 1e-9);
    let squares = xx * xx + yy * yy + zz * zz - xx * yy - yy * zz - zz * xx + 3.0 * xy * xy;
    assert!(relative_error(von_mises, squares.sqrt()) < 1e-9);
    assert!(
        relative_error(von_mises, yy * (1.0 - nu + nu * nu).sqrt()) < 0.02,
        "{von_mises}"
    );
    assert!(relative_error(tresca, yy - xx) < 1e-9, "{tresca}");
    assert!(xx.abs() < 0.03 * yy, "{xx}");
    assert!(
        relative_error(yy, 200e9 * 0.001 / (1.0 - nu * nu)) < 0.1,
        "{yy}"
    );
}
