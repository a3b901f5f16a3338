//! What every equilibrium must keep: balances, linearity, and that nothing moves unheld.
//!
//! Each test states its problem and where its expectation comes from. An assertion that something is zero or equal
//! stands beside one that the thing compared is there at all.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use ligament_analysis::LoadProgram;
use ligament_analysis::Termination;
use ligament_analysis::balanced::Stability;
use ligament_analysis::internal::{self, InternalForces};
use ligament_analysis::state::UnbrokenBonds;
use ligament_model::thermal::ThermalStrain;
use verification::bench::Bench;
use verification::numbers::Random;
use verification::numbers::component;
use verification::numbers::deviation;
use verification::numbers::largest;
use verification::numbers::relative_error;
use verification::numbers::short;
use verification::problems::DISK;
use verification::problems::PLATE;

/// Translations and the rotation of the body, point rotations with it, cost no energy; the same rotation without the
/// points' own does. k_t is positive, zero and negative.
#[test]
fn rigid_motions_cost_no_energy() {
    for poisson in ["0.21", "0.333333333333333333", "0.38"] {
        let setting = format!("material.poisson={poisson}");
        let bench = Bench::new(DISK, &[&setting, "model.poisson=bonds"]);
        let system = &**bench.model.plane();
        let intact = vec![true; system.bonds.len()];
        let energy = |[u_x, u_y, angle]: [f64; 3], own_rotation: f64| {
            let motion = |p: &[f64; 2]| [u_x - angle * p[1], u_y + angle * p[0], own_rotation];
            let u: Vec<f64> = system.cloud.positions.iter().flat_map(motion).collect();
            internal::sweep(
                system,
                UnbrokenBonds::whole(&intact),
                &u,
                ThermalStrain::NONE,
            )
            .stored_energy
        };
        // A stretch of the same size, for a measure: u_x = angle times x.
        let u: Vec<f64> = (system.cloud.positions.iter())
            .flat_map(|p| [1e-3 * p[0], 0.0, 0.0])
            .collect();
        let measure = internal::sweep(
            system,
            UnbrokenBonds::whole(&intact),
            &u,
            ThermalStrain::NONE,
        )
        .stored_energy;
        assert!(measure > 1.0);
        for motion in [[1e-3, 0.0, 0.0], [0.0, -2e-3, 0.0], [3e-4, 1e-4, 1e-3]] {
            let error = energy(motion, motion[2]) / measure;
            assert!(error.abs() < 1e-20, "nu {poisson}, {motion:?}: {error:e}");
        }
        let without_own = energy([0.0, 0.0, 1e-3], 0.0) / measure;
        println!("nu {poisson}: rotation without the points' own {without_own:.3}");
        let sign = match poisson {
            "0.21" => without_own > 0.1,
            "0.38" => without_own < -0.01,
            _ => without_own.abs() < 1e-20,
        };
        assert!(sign, "nu {poisson}: {without_own}");
    }
}

/// The internal forces of any state add up to no force and no moment: bonds pull at both ends alike.
#[test]
fn internal_forces_are_in_balance_with_themselves() {
    let bench = Bench::new(DISK, &[]);
    let system = &**bench.model.plane();
    let mut random = Random(1);
    let u: Vec<f64> = (0..3 * bench.points())
        .map(|_| 1e-4 * random.uniform())
        .collect();
    let intact: Vec<bool> = (0..system.bonds.len())
        .map(|_| random.uniform() < 0.8)
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
    let (mut sum, mut size) = ([0.0; 3], [0.0; 3]);
    for (force, p) in forces.chunks(3).zip(&system.cloud.positions) {
        let arms = [p[0] * force[1], -p[1] * force[0], force[2]];
        let shares = [[force[0], 0.0, 0.0], [force[1], 0.0, 0.0], arms];
        for k in 0..3 {
            sum[k] += shares[k].iter().sum::<f64>();
            size[k] += shares[k].iter().map(|share| share.abs()).sum::<f64>();
        }
    }
    println!(
        "sums of force x, y and moment {}, of their sizes {}",
        short(&sum),
        short(&size)
    );
    for k in 0..3 {
        assert!(size[k] > 1e3, "there are forces");
        assert!(
            sum[k].abs() < 1e-12 * size[k],
            "{:e} of {:e}",
            sum[k],
            size[k]
        );
    }
}

/// Supports and loads balance: what the platens and poles exert adds up to no force, and no moment about the origin.
#[test]
fn reactions_balance() {
    let bench = Bench::new(DISK, &[]);
    let run = bench.solve();
    let system = &**bench.model.plane();
    let internal::BondSweep {
        internal: InternalForces {
            values: internal, ..
        },
        ..
    } = internal::sweep(
        system,
        run.state().bonds(),
        run.displacement(),
        ThermalStrain::NONE,
    );
    let reactions = bench.boundary.reactions(1.0, &internal);
    let total = |value: &dyn Fn(usize) -> f64| (0..bench.points()).map(value).sum::<f64>();
    let moment = |point: usize| {
        let (p, r) = (bench.positions()[point], &reactions[3 * point..]);
        p[0] * r[1] - p[1] * r[0] + r[2]
    };
    let load = run.last().reaction;
    println!("load {load:.4e} N");
    assert!(load > 1e6);
    for sum in [
        total(&|p| reactions[3 * p]),
        total(&|p| reactions[3 * p + 1]),
    ] {
        assert!(sum.abs() < 1e-9 * load, "{sum:e}");
    }
    assert!(total(&moment).abs() < 1e-9 * load * 0.05);
    // The resultants that the history reports, moved group first: the load and its answer.
    let [top, bottom] =
        ["platen-top", "platen-bottom"].map(|name| run.group_force(&bench, name)[1]);
    assert!(relative_error(-top, load) < 1e-12 && relative_error(bottom, load) < 1e-9);
}

/// The force through a section of the plate, summed over the bonds that cross it, is the load, wherever the section is.
/// Seen upwards, the right side pulls the left one along +x.
#[test]
fn every_section_carries_the_load() {
    let mut text =
        format!("{PLATE}load = [{{ group = \"right\", displacement = {{ x = 1e-5 }} }}]\n");
    let places = [0.02, 0.0777, 0.1, 0.163];
    for (k, x) in places.iter().enumerate() {
        for component in ["x", "y"] {
            text += &format!(
                "[[probe]]\nname = \"{component}{k}\"\nsection = [[{x:?}, -0.01], [{x:?}, 0.11]]\ncomponent = \"{component}\"\n"
            );
        }
    }
    let run = Bench::new(&text, &[]).solve();
    let load = run.last().reaction;
    assert!(load > 1e3);
    assert_eq!(run.last().probes.len(), 2 * places.len());
    for forces in run.last().probes.chunks(2) {
        assert!(
            relative_error(forces[0], load) < 1e-9,
            "{} of {load}",
            forces[0]
        );
        assert!(forces[1].abs() < 1e-9 * load);
    }
}

/// Platens that hold only along y: the body may slide along x. Just that motion is held, at zero, and reported; the
/// solution is that of a body held there by a support.
#[test]
fn a_body_held_by_halves_is_held_and_reported() {
    let text = DISK.replace(
        r#"    { group = "pole-top", displacement = { x = 0.0 } },
    { group = "pole-bottom", displacement = { x = 0.0 } },
"#,
        "",
    );
    let bench = Bench::new(&text, &[]);
    let run = bench.solve();
    let points = bench.points();
    let [told] = &run.messages[..] else {
        panic!("{:?}", run.messages)
    };
    assert!(
        told.text
            .starts_with("the supports leave the body free in translation along x;"),
        "{told}"
    );
    let held: Vec<usize> = (0..3 * points)
        .filter(|&dof| run.state().held[dof])
        .collect();
    assert_eq!(held.len(), 1);
    assert_eq!(held[0] % 3, 0, "a motion along x is held");
    assert_eq!(run.displacement()[held[0]], 0.0);
    let [x, y] = bench.positions()[held[0] / 3];
    let supported = text.replace(
        "support = [",
        &format!("support = [{{ at = [{x:?}, {y:?}], displacement = {{ x = 0.0 }} }},"),
    );
    let expected = Bench::new(&supported, &[]).solve();
    assert!(expected.messages.is_empty());
    assert!(deviation(run.displacement(), expected.displacement()) < 1e-9);
    assert!(largest(run.displacement().iter().copied()) > 1e-5);
}

/// nu = 1/3 (plane stress) and 1/4 (plane strain): k_t = k_theta = 0. Rotations carry nothing and are held at zero; the
/// disk is solved, and neighbouring Poisson's ratios have nearly the same answer.
#[test]
fn central_forces_leave_rotations_alone() {
    for (plane, poisson, above) in [("stress", 1.0 / 3.0, 0.33334), ("strain", 0.25, 0.25001)] {
        let solve = |poisson: f64| {
            let settings = [
                format!("material.poisson={poisson:?}"),
                format!("mesh.plane={plane}"),
            ];
            let by_bonds = "model.poisson=bonds";
            let bench = Bench::new(DISK, &[&settings[0], &settings[1], by_bonds]);
            let run = bench.solve();
            (bench, run)
        };
        let (bench, run) = solve(poisson);
        let system = &**bench.model.plane();
        assert!(
            system
                .rigidities
                .shear
                .iter()
                .all(|&rigidity| rigidity == 0.0)
        );
        assert!(run.messages.is_empty(), "{:?}", run.messages);
        assert_eq!(largest(component(run.displacement(), 2)), 0.0);
        let (_, near) = solve(above);
        let change = relative_error(run.last().reaction, near.last().reaction);
        println!(
            "{plane}: reaction {:.4e} N, {change:.1e} from the one next to it",
            run.last().reaction
        );
        assert!(run.last().reaction > 1e6 && change < 1e-3);
        assert!(
            largest(component(near.displacement(), 2)) > 1e-4,
            "elsewhere points do rotate"
        );
    }
}

/// Above nu = 1/3 the rotations have negative stiffness: one negative eigenvalue a point and no other at nu = 0.38; more
/// than that at nu = 0.45, where the intact model has lost stability and a notice says so (theory: nu >= 0.45, lambda >= 3).
#[test]
fn stability_is_counted_and_its_loss_reported() {
    let solve = |poisson: &str, factor: &str| {
        let settings = [
            format!("material.poisson={poisson}"),
            format!("model.horizon_factor={factor}"),
        ];
        let allowed = "model.allow_unstable=true";
        let by_bonds = "model.poisson=bonds";
        let bench = Bench::new(DISK, &[&settings[0], &settings[1], allowed, by_bonds]);
        (bench.points(), bench.solve())
    };
    let (_, run) = solve("0.21", "3");
    assert_eq!(run.outcome.stability, None);
    for factor in ["2.2", "3", "4"] {
        let (points, run) = solve("0.38", factor);
        let [negative, expected] = [points; 2];
        assert_eq!(
            run.outcome.stability,
            Some(Stability { negative, expected })
        );
        assert!(run.messages.is_empty());
        assert!(run.last().stored_energy > 0.0);
    }
    let (points, run) = solve("0.45", "3");
    println!("nu = 0.45: {:?}", run.outcome.stability);
    let Stability { negative, expected } = run.outcome.stability.unwrap();
    assert_eq!(expected, points);
    assert!(negative > expected);
    let told = run
        .messages
        .iter()
        .find(|it| it.kind == "unstable")
        .unwrap();
    let counted = format!("{negative} negative eigenvalues where {expected} are expected");
    assert!(told.text.contains(&counted), "{told}");
}

/// A body that is moved at one side and held nowhere goes along. What stiffness and stretch its rounding would give is not told.
#[test]
fn a_body_that_nothing_holds_goes_along() {
    const PLATE: &str = r#"
        lattice = { cells = [20, 20], spacing = 0.001, set = { bottom = { bottom = 1 }, top = { top = 1 } } }
        material = { young = 30e9, poisson = 0.3, tensile_strength = 3e6 }
        model = { law = "mppd", horizon_factor = 3.0 }
        load = [{ group = "top", displacement = { y = 1e-5 } }]
        fracture = { steps = 2 }
    "#;
    let free = Bench::new(PLATE, &[]).solve();
    assert!(free.outcome.elastic_stiffness.is_nan());
    assert_eq!(free.outcome.first_break, None);
    assert!(free.told("undeformed"));
    let held = r#"support=[{ group = "bottom", displacement = { x = 0.0, y = 0.0 } }]"#;
    let held = Bench::new(PLATE, &[held]).solve();
    assert!(held.outcome.elastic_stiffness > 1e6);
    assert!(held.outcome.first_break.is_some());
    assert!(!held.told("undeformed"));
}

/// A total force of 2000 N on a side of 0.1 m, a force of 20 kN/m along it, and half of each together are one load; the
/// supports answer with the same force.
#[test]
fn forces_in_total_and_per_length_are_one_load() {
    let loads = [
        r#"load = [{ group = "right", force = { x = 2e3, y = 500.0 } }]"#,
        r#"load = [{ group = "right", force_per_length = { x = 2e4, y = 5e3 } }]"#,
        r#"load = [{ group = "right", name = "half", force = { x = 1e3, y = 250.0 } },
                   { group = "right", name = "rest", force_per_length = { x = 1e4, y = 2.5e3 } }]"#,
    ];
    let runs = loads.map(|load| {
        let bench = Bench::new(&format!("{PLATE}{load}\n"), &[]);
        let run = bench.solve();
        let force = |axis: usize| component(&bench.boundary.force, axis).iter().sum::<f64>();
        assert!(relative_error(force(0), 2e3) < 1e-12 && relative_error(force(1), 500.0) < 1e-12);
        let loaded = component(&bench.boundary.force, 0)
            .iter()
            .filter(|force| **force != 0.0)
            .count();
        assert_eq!(loaded, bench.group("right").len());
        assert!(relative_error(-run.group_force(&bench, "left")[0], 2e3) < 1e-9);
        assert!(relative_error(-run.group_force(&bench, "corner")[1], 500.0) < 1e-9);
        run
    });
    for run in &runs[1..] {
        assert!(deviation(run.displacement(), runs[0].displacement()) < 1e-11);
    }
    assert!(largest(runs[0].displacement().iter().copied()) > 1e-7);
    // Ends of the side stand for half as much of it as the points between.
    let forces = component(
        &Bench::new(&format!("{PLATE}{}\n", loads[1]), &[])
            .boundary
            .force,
        0,
    );
    let [most, least] = [f64::max as fn(f64, f64) -> f64, f64::min].map(|pick| {
        forces
            .iter()
            .copied()
            .filter(|force| *force > 0.0)
            .reduce(pick)
            .unwrap()
    });
    assert!(relative_error(most, 2.0 * least) < 1e-9, "{most} {least}");
}

/// A body force adds up to the force density times the volume, of the whole body or of a part of it; the supports bear it.
#[test]
fn body_forces_add_up_to_density_times_volume() {
    let density = -26e3; // N/m^3
    let whole = format!("{PLATE}load = [{{ body_force = {{ y = {density:?} }} }}]\n");
    let bench = Bench::new(&whole, &[]);
    let weight = density * 0.2 * 0.1 * 0.02;
    let total: f64 = component(&bench.boundary.force, 1).iter().sum();
    assert!(relative_error(total, weight) < 1e-12);
    let run = bench.solve();
    // Only the corner holds along y, and bears its own share of the load with the rest.
    let support = run.group_force(&bench, "corner")[1];
    println!("weight {weight:.6} N, borne {support:.6} N");
    assert!(relative_error(-support, weight) < 1e-9);
    // A part: the points of a box, by their volumes.
    let part = format!(
        "{PLATE}load = [{{ box = [[-0.01, -0.01], [0.1, 0.11]], body_force = {{ x = 1e4 }} }}]\n"
    );
    let bench = Bench::new(&part, &[]);
    let volume: f64 = (0..bench.points())
        // The rim belongs to the box, however the mesh rounds it.
        .filter(|&point| bench.positions()[point][0] <= 0.1 + 1e-9)
        .map(|point| bench.model.plane().cloud.volumes[point])
        .sum();
    let total: f64 = component(&bench.boundary.force, 0).iter().sum();
    assert!(relative_error(total, 1e4 * volume) < 1e-12);
    assert!((0.4..0.6).contains(&(volume / (0.2 * 0.1 * 0.02))));
}

/// Twice the load is twice the answer, and a force is the reaction to the displacement that it makes.
#[test]
fn the_intact_body_is_linear() {
    let pulled = |u: f64| {
        Bench::new(
            &format!("{PLATE}load = [{{ group = \"right\", displacement = {{ x = {u:?} }} }}]\n"),
            &[],
        )
        .solve()
    };
    let (one, two) = (pulled(1e-5), pulled(2e-5));
    let doubled: Vec<f64> = one.displacement().iter().map(|u| 2.0 * u).collect();
    assert!(deviation(two.displacement(), &doubled) < 1e-11);
    assert!(relative_error(two.last().stored_energy, 4.0 * one.last().stored_energy) < 1e-11);
    // Clapeyron: the work of the load is twice the mean force times the way, which is all stored.
    let work = 0.5 * one.last().reaction * 1e-5;
    assert!(relative_error(one.last().stored_energy, work) < 1e-9);
    assert_eq!(one.outcome.termination, Termination::StepsDone);
}
