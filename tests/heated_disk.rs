//! Disks that are hot inside, on an irregular mesh, against the closed form of thermoelasticity.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use ligament_analysis::LoadProgram;
use ligament_model::interface::StressReading;
use nalgebra::{Matrix3, Vector3};
use verification::bench::Bench;
use verification::numbers::{component, largest, relative_error};
use verification::stresses::of_reading;

const ALPHA: f64 = 23e-6; // 1/K

/// Disk of radius b = 50 mm on 1834 irregular points, with a core of radius a = 20 mm, that nothing holds.
const DISK: &str = r#"
mesh = { file = "../meshes/heated-disk.msh", thickness = 0.01 }
material = { young = 70e9, poisson = 0.25, thermal_expansion = 23e-6 }
model = { law = "nhpd", horizon_factor = 3.0 }
"#;

/// Timoshenko and Goodier, "Theory of Elasticity", on the disk with a radial temperature T(r): with I(r) the integral of T r from
/// 0 to r, u = alpha ((1 + nu) I(r)/r + (1 - nu) r I(b)/b^2), sigma_r = E alpha (I(b)/b^2 - I(r)/r^2).
struct HotDisk {
    integral: fn(f64) -> f64,
}

impl HotDisk {
    const YOUNG: f64 = 70e9;
    const POISSON: f64 = 0.25;
    const RADIUS: f64 = 0.05;

    fn displacement(&self, r: f64) -> f64 {
        let (whole, b) = ((self.integral)(Self::RADIUS), Self::RADIUS);
        ALPHA
            * ((1.0 + Self::POISSON) * (self.integral)(r) / r
                + (1.0 - Self::POISSON) * r * whole / (b * b))
    }

    fn radial_stress(&self, r: f64) -> f64 {
        let whole = (self.integral)(Self::RADIUS) / Self::RADIUS.powi(2);
        Self::YOUNG * ALPHA * (whole - (self.integral)(r) / (r * r))
    }
}

/// A parabola from a field of the mesh file, and a core that is hot by group: mean radial displacement of the rim, displacements
/// of all points (root mean square), and the mean radial stress of the points well inside the core, against the closed form.
/// The points are 4 % of the radius apart and the horizons 12 %: 1 % of the displacements, more where the temperature jumps within
/// a horizon, and the stress at single points within 10 %.
#[test]
fn hot_disks_are_those_of_thermoelasticity() {
    let parabola = HotDisk {
        integral: |r| 100.0 * (0.5 * r * r - 0.25 * r.powi(4) / HotDisk::RADIUS.powi(2)),
    };
    let core = HotDisk {
        integral: |r| 50.0 * r.min(0.02).powi(2),
    };
    for (name, heat, exact, bound) in [
        ("parabola", "mesh_field = \"heat\"", parabola, 0.01),
        ("core", "group = \"core\", change = 100.0", core, 0.025),
    ] {
        let text = format!("{DISK}temperature = [{{ {heat} }}]\n");
        let bench = Bench::new(&text, &[]);
        let run = bench.solve();
        let positions = bench.positions();
        let motion = run.displacement();
        // The gauges leave a rigid motion, which the points as a whole show.
        let count = positions.len() as f64;
        let mean = |axis: usize| component(motion, axis).iter().sum::<f64>() / count;
        let (u, v) = (mean(0), mean(1));
        let spin: f64 = (positions.iter().zip(motion.chunks(3)))
            .map(|(p, m)| p[0] * (m[1] - v) - p[1] * (m[0] - u))
            .sum::<f64>()
            / positions
                .iter()
                .map(|p| p[0] * p[0] + p[1] * p[1])
                .sum::<f64>();
        let radial = |point: usize| {
            let (p, m) = (positions[point], &motion[3 * point..3 * point + 2]);
            let motion = [m[0] - u + spin * p[1], m[1] - v - spin * p[0]];
            let r = p[0].hypot(p[1]);
            ((motion[0] * p[0] + motion[1] * p[1]) / r, r)
        };
        let rim = bench.group("rim");
        let widening: f64 = rim
            .iter()
            .map(|&point| radial(point as usize).0)
            .sum::<f64>()
            / rim.len() as f64;
        let expected = exact.displacement(HotDisk::RADIUS);
        let [mut off, mut size] = [0.0; 2];
        for point in 0..positions.len() {
            let (found, r) = radial(point);
            let wanted = exact.displacement(r);
            off += (found - wanted).powi(2);
            size += wanted * wanted;
        }
        let off = (off / size).sqrt();
        let state = run.state();
        let expansion = bench.boundary.thermal_strain(state.load_factor);
        let system = &**bench.model.plane();
        let deformations = system.deformations(&state.intact, motion, expansion);
        let stress = of_reading::<3>(StressReading::Virial, system, state.bonds(), &deformations);
        let mut ratios = Vec::new();
        for (p, [xx, yy, xy]) in positions.iter().zip(&stress) {
            let r = p[0].hypot(p[1]);
            if r > 0.001 && r < 0.012 {
                let [c, s] = [p[0] / r, p[1] / r];
                let radial = xx * c * c + yy * s * s + 2.0 * xy * s * c;
                ratios.push(radial / exact.radial_stress(r));
            }
        }
        let mean = ratios.iter().sum::<f64>() / ratios.len() as f64;
        println!(
            "{name}: rim {:.5}, displacements off by {off:.2e}, radial stress {mean:.4} ({:.4} to {:.4})",
            widening / expected,
            ratios.iter().copied().fold(f64::INFINITY, f64::min),
            largest(ratios.iter().copied())
        );
        assert!(relative_error(widening, expected) < 0.015, "{name}");
        assert!(off < bound, "{name}");
        assert!((mean - 1.0).abs() < 0.015, "{name}");
    }
}

/// A core of one material in a ring of another, in plane strain, with Poisson's ratios on both sides of that of central forces, under a
/// pressure on the rim and heated: the widening of the rim against Lame's solutions u = A r inside and B r + C/r outside, which agree in
/// displacement and radial stress at the radius a. The tolerance of 1.5 % is what a jump of the expansion within a cell leaves, as in the hot
/// core of one material.
#[test]
fn a_core_of_another_material_widens_with_its_ring() {
    const CORE: f64 = 0.02;
    const RIM: f64 = 0.05;
    const HEAT: f64 = 100.0;
    const PRESSURE: f64 = 1e8;
    const RING_ALPHA: f64 = 12e-6;
    for [(young_core, core), (young_ring, ring)] in [
        [(70e9, 0.45), (70e9, 0.2)],
        [(30e9, 0.2), (210e9, 0.3)],
        [(70e9, 0.35), (20e9, 0.49)],
    ] {
        let text = format!(
            r#"
mesh = {{ file = "../meshes/heated-disk.msh", thickness = 0.01, plane = "strain" }}
material.core = {{ group = "core", young = {young_core:?}, poisson = {core:?}, thermal_expansion = {ALPHA:?} }}
material.ring = {{ group = "shell", young = {young_ring:?}, poisson = {ring:?}, thermal_expansion = {RING_ALPHA:?} }}
model = {{ law = "nhpd", horizon_factor = 3.0 }}
correction = {{ surface = "patch" }}
"#
        );
        // Constants with which the equations of plane stress describe plane strain: E/(1 - nu) and E/(1 + nu).
        let constants = |young: f64, nu: f64| {
            let (young, nu) = (young / (1.0 - nu * nu), nu / (1.0 - nu));
            (young / (1.0 - nu), young / (1.0 + nu))
        };
        let ((in_core, _), (in_ring, across)) =
            (constants(young_core, core), constants(young_ring, ring));
        for (load, heat, pressure) in [
            (
                format!("temperature = [{{ change = {HEAT:?} }}]\n"),
                HEAT,
                0.0,
            ),
            (
                format!("load = [{{ group = \"rim\", pressure = {PRESSURE:?} }}]\n"),
                0.0,
                PRESSURE,
            ),
        ] {
            let (of_core, of_ring) = (
                (1.0 + core) * ALPHA * heat,
                (1.0 + ring) * RING_ALPHA * heat,
            );
            let equations = Matrix3::new(
                CORE,
                -CORE,
                -1.0 / CORE,
                in_core,
                -in_ring,
                across / (CORE * CORE),
                0.0,
                in_ring,
                -across / (RIM * RIM),
            );
            let right = Vector3::new(
                0.0,
                in_core * of_core - in_ring * of_ring,
                in_ring * of_ring - pressure,
            );
            let found = equations.try_inverse().unwrap() * right;
            let expected = found[1] * RIM + found[2] / RIM;
            let bench = Bench::new(&format!("{text}{load}"), &[]);
            let ratio = widening(&bench) / expected;
            println!("{core} in {ring}, heated by {heat}: {ratio:.4}");
            assert!((ratio - 1.0).abs() < 0.015, "{core} in {ring}: {ratio}");
        }
    }
}

/// Mean radial displacement of the rim, m.
fn widening(bench: &Bench) -> f64 {
    let run = bench.solve();
    let (motion, positions) = (run.displacement(), bench.positions());
    let rim = bench.group("rim");
    let mean = |value: &dyn Fn(usize) -> f64| {
        rim.iter().map(|&point| value(point as usize)).sum::<f64>() / rim.len() as f64
    };
    let [u, v] = [0, 1].map(|axis| mean(&|point| motion[3 * point + axis]));
    mean(&|point| {
        let p = positions[point];
        let (x, y) = (motion[3 * point] - u, motion[3 * point + 1] - v);
        (x * p[0] + y * p[1]) / p[0].hypot(p[1])
    })
}
