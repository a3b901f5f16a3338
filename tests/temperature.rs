//! Changes of temperature: bodies that expand freely, bodies that are held, against closed forms of thermoelasticity; and with
//! breakages against the same bodies under displacements.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use ligament_analysis::LoadProgram;
use ligament_analysis::{ControlKind, internal};
use ligament_model::Deformations;
use verification::bench::{Bench, Run};
use verification::numbers::{by_point, largest, relative_error};
use verification::stresses;

const YOUNG: f64 = 65.8e9; // Pa
const ALPHA: f64 = 23e-6; // 1/K
const CHANGE: f64 = 50.0; // K

/// 12 x 8 cells of 5 mm, 1 mm thick; each test brings its supports and temperatures along.
const LATTICE: &str = r#"
lattice = { cells = [12, 8], spacing = 0.005, thickness = 0.001, set = { left = { left = 1 }, right = { right = 1 }, bottom = { bottom = 4 } } }
material = { young = 65.8e9, poisson = 0.3, thermal_expansion = 23e-6 }
model = { law = "mppd", horizon_factor = 3.0 }
"#;

/// Square of side 0.1 m on 137 irregular points.
const SQUARE: &str = r#"
mesh = { file = "reference/square.msh", thickness = 0.001 }
material = { young = 65.8e9, poisson = 0.3, thermal_expansion = 23e-6 }
model = { law = "nhpd", horizon_factor = 3.0 }
"#;

/// A lamina whose axes expand by -1e-6 and 30e-6 1/K, at 0.5 rad.
const LAMINA: &str = "material={ young_1 = 15e9, young_2 = 5e9, poisson_12 = 0.25, shear_modulus = 4.8e9, young_3 = 6e9, \
                      poisson_13 = 0.2, poisson_23 = 0.3, angle = 0.5, thermal_expansion_1 = -1e-6, \
                      thermal_expansion_2 = 30e-6, thermal_expansion_3 = 10e-6 }";

/// Every law on its body, in both states of the plane; Poisson's ratio above and below that of central forces.
const LAWS: [(&str, &[&str]); 13] = [
    ("bbpd", &["model.law=bbpd"]),
    ("bbpd-conical", &["model.law=bbpd-conical"]),
    ("pds", &["model.law=pds"]),
    ("mppd", &[]),
    ("mppd, cells", &["material.poisson=0.4"]),
    (
        "mppd, negative k_t",
        &["material.poisson=0.4", "model.poisson=bonds"],
    ),
    ("mppd-beam", &["model.law=mppd-beam"]),
    ("orthotropic", &["model.law=orthotropic", LAMINA]),
    ("nhpd", &["model.law=nhpd"]),
    (
        "nhpd, anisotropic spacing",
        &["model.law=nhpd", "lattice.spacing=[0.005, 0.006]"],
    ),
    ("mbb-pd", &["model.law=mbb-pd"]),
    (
        "mbb-pd, negative nu",
        &["model.law=mbb-pd", "material.poisson=-0.4"],
    ),
    ("mbb-pd, orthotropic", &["model.law=mbb-pd", LAMINA]),
];

fn solved(text: &str, settings: &[&str]) -> (Bench, Run) {
    let bench = Bench::new(text, settings);
    let run = bench.solve();
    (bench, run)
}

/// Deformations of the bonds beyond what the temperature gives them, in the last state.
fn deformations(bench: &Bench, run: &Run) -> Deformations {
    let expansion = bench.boundary.thermal_strain(run.state().load_factor);
    let intact = &run.state().intact;
    let system = &**bench.model.plane();
    system.deformations(intact, run.displacement(), expansion)
}

/// Strain (eps_xx, eps_yy, gamma_xy) that a point would have without stress.
fn free_strain(bench: &Bench) -> [f64; 3] {
    stresses::free(&bench.boundary.thermal_strain)[0]
}

/// A body that nothing but three gauges holds takes the shape of its thermal strain: displacements are (eps_xx x + gamma_xy y/2,
/// gamma_xy x/2 + eps_yy y) up to a rigid motion, and there is no bond force, energy or reaction. The sums have hundreds of terms
/// of the size of E alpha dT; 1e-10 leaves room for the condition of the equations.
fn assert_free(name: &str, bench: &Bench, run: &Run) {
    let [xx, yy, xy] = free_strain(bench);
    let positions = bench.positions();
    let size = largest([xx, yy, xy].map(f64::abs));
    let motions = by_point(bench.model.plane().topology().layout, run.displacement());
    let [x, y] = [0, 1].map(|axis| motions.iter().map(|it| it[axis]).collect::<Vec<f64>>());
    // The rigid motion that fits two points, to be taken off.
    let (first, last) = (0, positions.len() - 1);
    let wanted = |p: [f64; 2]| [xx * p[0] + 0.5 * xy * p[1], 0.5 * xy * p[0] + yy * p[1]];
    let miss = |point: usize| {
        let [u, v] = wanted(positions[point]);
        [x[point] - u, y[point] - v]
    };
    let [[u, v], [u_last, v_last]] = [miss(first), miss(last)];
    let arm = [0, 1].map(|axis| positions[last][axis] - positions[first][axis]);
    let turn = ((v_last - v) * arm[0] - (u_last - u) * arm[1]) / arm[0].hypot(arm[1]).powi(2);
    let length = arm[0].hypot(arm[1]);
    let off = (0..positions.len()).flat_map(|point| {
        let [du, dv] = miss(point);
        let arm = [0, 1].map(|axis| positions[point][axis] - positions[first][axis]);
        [du - u + turn * arm[1], dv - v - turn * arm[0]]
    });
    let off = largest(off.map(f64::abs)) / (size * length);
    let left = deformations(bench, run);
    let left = left.iter().flat_map(|it| it.strains().map(f64::abs));
    let left = largest(left) / size;
    let volume: f64 = bench.model.plane().cloud.volumes.iter().sum();
    let energy = run.last().stored_energy / (0.5 * YOUNG * size * size * volume);
    let force = YOUNG * size * volume / length;
    let forces = run.last().group_forces.iter().flatten();
    let forces = largest(forces.map(|it| it.abs())) / force;
    let stress = stresses::by_material(&**bench.model.plane(), run.state(), &bench.boundary);
    let stress = largest(stress.iter().flatten().map(|it| it.abs())) / (YOUNG * size);
    println!(
        "{name}: shape {off:.1e}, bonds {left:.1e}, energy {energy:.1e}, forces {forces:.1e}, stress {stress:.1e}"
    );
    assert!(
        off < 1e-10 && left < 1e-10 && energy.abs() < 1e-10 && forces < 1e-10 && stress < 1e-9,
        "{name}"
    );
}

/// A change that is the same everywhere leaves no stress in a body that is free to expand: on a lattice under every law, on an
/// irregular mesh, in plane stress and plane strain, with a rise and a fall of the temperature; also where k_t < 0 makes that an unstable
/// equilibrium.
#[test]
fn free_bodies_expand_without_stress() {
    let allowed = "model.allow_unstable=true";
    // In a lower corner, and along y in the other one, in a body of this width.
    let held = |width: f64| {
        format!(
            "support = [{{ at = [0, 0], displacement = {{ x = 0, y = 0 }} }}, \
             {{ at = [{width}, 0], displacement = {{ y = 0 }} }}]\n"
        )
    };
    for (name, settings) in LAWS {
        for plane in ["stress", "strain"] {
            let mut settings = settings.to_vec();
            let plane_setting = format!("lattice.plane={plane}");
            settings.extend([&plane_setting, allowed]);
            // A rotation held would hold the shear of a lamina against pds, which counts turns as shear; nothing else has both.
            for (support, change) in [(held(0.06), CHANGE), (String::new(), -CHANGE)] {
                let text = format!("{LATTICE}{support}temperature = [{{ change = {change:?} }}]\n");
                let (bench, run) = solved(&text, &settings);
                assert_eq!(bench.boundary.control.kind, ControlKind::Temperature);
                assert_free(&format!("{name}, {plane}"), &bench, &run);
            }
        }
    }
    for poisson in ["-0.3", "0.21", "0.38"] {
        for plane in ["stress", "strain"] {
            let settings = [
                format!("material.poisson={poisson}"),
                format!("mesh.plane={plane}"),
                allowed.to_owned(),
            ];
            let settings: Vec<&str> = settings.iter().map(String::as_str).collect();
            let text = format!(
                "{SQUARE}{}temperature = [{{ change = {CHANGE:?} }}]\n",
                held(0.1)
            );
            let (bench, run) = solved(&text, &settings);
            assert_free(
                &format!("nhpd on a mesh, nu {poisson}, {plane}"),
                &bench,
                &run,
            );
            let expected = if plane == "stress" {
                ALPHA * CHANGE
            } else {
                (1.0 + poisson.parse::<f64>().unwrap()) * ALPHA * CHANGE
            };
            for strain in &free_strain(&bench)[..2] {
                assert!(relative_error(*strain, expected) < 1e-14);
            }
        }
    }
}

/// A body that is held at every point stores the energy of the biaxial strain -alpha dT, E (alpha dT)^2/(1 - nu) in plane stress
/// and E (alpha dT)^2 (1 + nu)/(1 - 2 nu) per volume in plane strain, where each family stores what it stores under that strain
/// (`energy_ratios`); its stress is that energy's derivative; and the axes of the curve are work-conjugate: the energy is half of force times change.
#[test]
fn bodies_held_everywhere_store_the_energy_of_the_continuum() {
    let text = "support = [{ box = [[-1, -1], [1, 1]], displacement = { x = 0, y = 0, rotation = 0 } }]\n\
                temperature = [{ change = 50.0 }]\n";
    for (body, plane) in [(LATTICE, "lattice.plane"), (SQUARE, "mesh.plane")] {
        for (value, nu) in [("stress", 0.3), ("strain", 0.3)] {
            let settings = [format!("{plane}={value}"), "model.poisson=bonds".to_owned()];
            let settings = settings.each_ref().map(String::as_str);
            let (bench, run) = solved(&format!("{body}{text}"), &settings);
            let strain: f64 = ALPHA * CHANGE;
            let density = match value {
                "stress" => YOUNG * strain * strain / (1.0 - nu),
                _ => YOUNG * strain * strain * (1.0 + nu) / (1.0 - 2.0 * nu),
            };
            let biaxial = &bench.model.fixed.energy_ratios[2].at_points;
            let volumes = &bench.model.plane().cloud.volumes;
            let expected: f64 = (biaxial.iter().zip(volumes.iter()))
                .map(|(ratio, volume)| ratio * volume * density)
                .sum();
            let last = run.last();
            assert!(
                relative_error(last.stored_energy, expected) < 1e-12,
                "{value}"
            );
            let work = 0.5 * last.displacement * last.reaction;
            assert!(relative_error(work, expected) < 1e-12, "{value}");
            assert_eq!(last.displacement, CHANGE);
            let held = match value {
                "stress" => -YOUNG * strain / (1.0 - nu),
                _ => -YOUNG * strain / (1.0 - 2.0 * nu),
            };
            let system = &**bench.model.plane();
            for [xx, yy, xy] in stresses::by_material(system, run.state(), &bench.boundary) {
                let off = [xx - held, yy - held, xy].map(f64::abs);
                assert!(largest(off) < 1e-12 * held.abs(), "{xx:e} {yy:e} {xy:e}");
            }
            // No strain along any axis: the stress is the same across the plane.
            if value == "strain" {
                for zz in stresses::across_plane(system, run.state(), &bench.boundary) {
                    assert!((zz - held).abs() < 1e-12 * held.abs(), "{zz:e}");
                }
            }
        }
    }
}

/// A bar that is held at both ends and may widen: sigma = -E alpha dT, and E/(1 - nu^2) (1 + nu) alpha dT in plane strain. The
/// families at the sides and at the held rows have another stiffness than those inside, so that the force is off by some of
/// the cells across the bar: measured on 16 and 32 of them, it falls with their size.
#[test]
fn a_bar_between_walls_has_the_stress_of_its_expansion() {
    let text = "support = [{ group = \"left\", displacement = { x = 0 } }, { group = \"right\", displacement = { x = 0 } }, \
                { at = [0, 0], displacement = { y = 0 } }]\n\
                temperature = [{ change = 50.0 }]\n";
    let section = 8.0 * 0.005 * 0.001;
    for (law, plane, modulus, bound) in [
        ("mppd", "stress", 1.0, 0.015),
        ("mppd", "strain", 1.0 / 0.7, 0.015),
        ("nhpd", "stress", 1.0, 0.03),
        ("nhpd", "strain", 1.0 / 0.7, 0.08),
        ("mbb-pd", "stress", 1.0, 0.02),
        ("mbb-pd", "strain", 1.0 / 0.7, 0.02),
    ] {
        let settings = [format!("lattice.plane={plane}"), format!("model.law={law}")];
        let errors = [2, 4].map(|fine: u32| {
            let cells = [
                format!("lattice.cells=[{}, {}]", 12 * fine, 8 * fine),
                format!("lattice.spacing={:?}", 0.005 / f64::from(fine)),
            ];
            let settings: Vec<&str> = settings.iter().chain(&cells).map(String::as_str).collect();
            let (_, run) = solved(&format!("{LATTICE}{text}"), &settings);
            let expected = YOUNG * modulus * ALPHA * CHANGE * section;
            let [left, right] = [0, 1].map(|group| run.last().group_forces[group][0]);
            assert!(relative_error(-right, left) < 1e-9);
            relative_error(left, expected)
        });
        println!("{law}, {plane}: off by {errors:.4?}");
        assert!(
            errors[1] < bound && errors[1] < 0.8 * errors[0],
            "{law}, {plane}"
        );
    }
}

/// The same body under displacements: with u' = u - alpha dT (x - x_0) a body that is clamped at its ends and cooled is one whose
/// ends move apart, bond for bond. Both tear in the same order at the same loads, by load steps and along the exact path; the
/// order is decided by differences far above the rounding between the two, 1e-9 of the load factors. Bonds that
/// soften are compared before the first of them breaks: those beyond their end keep what the iterates happened to leave them.
#[test]
fn cooling_between_clamps_tears_a_body_as_pulling_does() {
    let clamps = "support = [{ group = \"left\", displacement = { x = 0, y = 0 } }, \
                  { group = \"right\", displacement = { x = 0, y = 0 } }]\n";
    let cooled = format!("{LATTICE}{clamps}temperature = [{{ change = -50.0 }}]\n");
    let strain = ALPHA * CHANGE;
    // x_0 and y_0 are those of the first cell.
    let along =
        |axis: &str| format!("profile = {{ along = \"{axis}\", zero = 0.0025, one = 1.0025 }}");
    let load = |name: &str, group: &str, axis: &str| {
        let profile = along(axis);
        format!(
            "{{ name = \"{name}\", group = \"{group}\", displacement = {{ {axis} = {strain:?} }}, {profile} }}"
        )
    };
    let pulled = format!(
        "{LATTICE}support = [{{ group = \"left\", displacement = {{ x = 0 }} }}]\nload = [{}, {}, {}]\n",
        load("pull", "right", "x"),
        load("left-y", "left", "y"),
        load("right-y", "right", "y"),
    );
    let crack = "precrack=[{ points = [[0.0301, -0.01], [0.0301, 0.0151]] }]";
    let strength: [&str; 2] = ["material.tensile_strength=4e7", "model.law=mppd"];
    let energy = ["material.fracture_energy=100.0", "model.law=mbb-pd"];
    for (law, control, least) in [
        (strength, "{ control = \"event\" }", 50),
        (strength, "{ steps = 20 }", 50),
        (
            strength,
            "{ steps = [0.2, 0.4, 0.5, 0.6, 0.7, 0.71], energy_tolerance = 1e-12, criterion = [{ kind = \"strength\", after = \"bilinear\", end = 3.0 }] }",
            0,
        ),
        (
            energy,
            "{ control = \"event\", criterion = [{ kind = \"mixed-mode\" }] }",
            50,
        ),
        (
            energy,
            "{ steps = 20, criterion = [{ kind = \"mixed-mode\" }] }",
            50,
        ),
    ] {
        let fracture = format!("fracture={control}");
        let settings = [law[0], law[1], crack, &fracture];
        let benches = [&cooled, &pulled].map(|text| Bench::new(text, &settings));
        let runs = benches.each_ref().map(Bench::break_up);
        let [cooled, pulled] = runs.each_ref().map(|run| &run.outcome.history);
        println!(
            "{} {control}: {} bonds, {} rows",
            law[1],
            runs[0].breaks.len(),
            cooled.len()
        );
        // Nothing loads the halves that a pulled body falls into; a cooled one may go on breaking at its clamps.
        let [cooled_ones, pulled_ones] = runs.each_ref().map(|run| run.breaks.len());
        assert!(pulled_ones >= least && cooled_ones >= pulled_ones);
        for (one, other) in runs[0].breaks.iter().zip(&runs[1].breaks) {
            assert_eq!(one.bond, other.bond);
            assert!((one.load_factor - other.load_factor).abs() < 1e-9);
            assert!((one.ratio - other.ratio).abs() < 1e-9 * one.ratio);
        }
        assert!(cooled.len() >= pulled.len());
        let peak = largest(cooled.iter().map(|row| row.stored_energy));
        let work = largest(cooled.iter().map(|row| row.external_work.abs()));
        // The last row of the pulled body is that of its loose halves.
        for (one, other) in cooled.iter().zip(&pulled[..pulled.len() - 1]) {
            assert!((one.stored_energy - other.stored_energy).abs() < 1e-9 * peak);
            assert!((one.released_energy - other.released_energy).abs() < 1e-9 * peak);
            assert!((one.external_work - other.external_work).abs() < 1e-9 * work);
            let missing = one.external_work - one.stored_energy - one.released_energy;
            assert!(missing.abs() < 1e-9 * work);
        }
        let conjugate = |row: &ligament_analysis::history::StepRecord| {
            0.5 * row.displacement * row.reaction - row.stored_energy
        };
        assert!(largest(cooled.iter().map(|row| conjugate(row).abs())) < 1e-9 * peak);
    }
}

/// The change of temperature rises linearly along x from zero to 50 K: a continuum that is free bends without any stress, by the
/// curvature alpha dT/L. Displacements are quadratic then, so that central forces, which have the mean strain of their ends, are
/// free exactly; and so are bonds with shear and rotations but for their rotational stiffness, which resists the curvature. What
/// that leaves falls with the horizon: strains in proportion to it, energies (relative to that of the body held everywhere) to its
/// square, as the error of the one-sided differences of MBB-PD at the edges does. In `pds` bonds take the turns of a
/// body that bends for shear, on any lattice.
#[test]
fn a_linear_temperature_bends_free_bodies() {
    let folder = tempfile::tempdir().unwrap();
    let none = [(
        "mppd, no k_theta",
        &["model.rotational_stiffness=none"] as &[&str],
    )];
    for (name, settings) in LAWS.into_iter().chain(none) {
        let mut found = Vec::new();
        for fine in [1_u32, 2] {
            let cells = format!("lattice.cells=[{}, {}]", 12 * fine, 8 * fine);
            let spacing = format!("lattice.spacing={:?}", 0.005 / f64::from(fine));
            let mut settings = settings.to_vec();
            settings.extend([cells.as_str(), spacing.as_str()]);
            let plain = format!("{LATTICE}temperature = [{{ change = 1.0 }}]\n");
            let plain = Bench::new(&plain, &settings);
            let rows = plain.positions().iter();
            let rows: String = rows
                .map(|p| format!("{:?},{:?},{:?}\n", p[0], p[1], CHANGE * p[0] / 0.06))
                .collect();
            let path = folder.path().join("linear.csv");
            std::fs::write(&path, format!("x,y,change\n{rows}")).unwrap();
            let text = format!(
                "{LATTICE}temperature = [{{ file = \"{}\" }}]\n",
                path.display()
            );
            let (bench, run) = solved(&text, &settings);
            let strains = stresses::free(&bench.boundary.thermal_strain);
            let size = largest(strains.as_flattened().iter().map(|it| it.abs()));
            let left = deformations(&bench, &run);
            let held = internal::sweep(
                &**bench.model.plane(),
                run.state().bonds(),
                &vec![0.0; run.displacement().len()],
                bench.boundary.thermal_strain(1.0),
            );
            let stretch = largest(left.iter().map(|it| it.stretch().abs())) / size;
            assert_eq!(run.last().load_factor, 1.0, "{name}");
            found.push([stretch, run.last().stored_energy / held.stored_energy]);
        }
        println!("{name}: stretch and energy {found:?}");
        let [[strain, energy], [fine_strain, fine_energy]] = found[..] else {
            panic!("two lattices");
        };
        match name {
            "bbpd" | "bbpd-conical" | "mppd, no k_theta" | "mppd, cells" => {
                assert!(
                    strain < 1e-10 && fine_strain < 1e-10 && energy < 1e-20,
                    "{name}"
                );
            }
            "pds" => assert!(energy > 5e-3 && fine_energy > 5e-3 && fine_energy < 7e-3),
            _ => {
                assert!(
                    energy.abs() < 0.01 && fine_energy.abs() < 0.3 * energy.abs(),
                    "{name}"
                );
                assert!(fine_strain < 0.53 * strain, "{name}");
            }
        }
    }
}

/// Two layers of one thickness h/2 and stiffness, of which one expands more: the strip bends with the curvature 1.5 (alpha_2 -
/// alpha_1) dT/h (Timoshenko, "Analysis of bi-metal thermostats", 1925). The bonds that cross the interface have the mean
/// expansion of the layers, over a horizon that is a fifth of the thickness: 3 %. A strip of `pds` hardly bends, because its bonds
/// take turns for shear.
#[test]
fn a_strip_of_two_metals_bends() {
    let text = r#"
lattice = { cells = [120, 16], spacing = 0.001, thickness = 0.001, set = { base = { left = 3 }, below = { bottom = 8 }, above = { top = 8 } } }
model = { law = "mppd", horizon_factor = 3.0 }
support = [{ group = "base", displacement = { x = 0.0, y = 0.0 } }]
temperature = [{ change = 50.0 }]
probe = [{ name = "near", at = [0.0305, 0.0005], field = "displacement.y" }, { name = "middle", at = [0.0705, 0.0005], field = "displacement.y" }, { name = "far", at = [0.1105, 0.0005], field = "displacement.y" }]
[material.low]
group = "below"
young = 65.8e9
poisson = 0.3
thermal_expansion = 10e-6
[material.high]
group = "above"
young = 65.8e9
poisson = 0.3
thermal_expansion = 30e-6
"#;
    for law in ["nhpd", "mppd", "bbpd", "mbb-pd", "pds"] {
        let (bench, run) = solved(text, &[&format!("model.law={law}")]);
        let [near, middle, far] = run.last().probes[..] else {
            panic!("three probes");
        };
        let curvature = (near - 2.0 * middle + far) / 0.04_f64.powi(2);
        let expected = -1.5 * 20e-6 * CHANGE / 0.016;
        println!("{law}: {:.4}", curvature / expected);
        assert_eq!(bench.boundary.control.magnitude, CHANGE);
        if law == "pds" {
            assert!((curvature / expected).abs() < 0.1);
        } else {
            assert!(relative_error(curvature, expected) < 0.03, "{law}");
        }
    }
}
