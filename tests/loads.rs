//! Loads that vary linearly, couples, and bodies that only gauges hold, against closed forms and statics.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use ligament_analysis::gauges::{FreeBody, of_intact_body};
use ligament_analysis::internal::{self, BondSweep};
use ligament_analysis::{Component, ControlKind, Termination, Unbalanced};
use ligament_cli::check::{CheckExtent, Lines, check};
use ligament_model::thermal::ThermalStrain;
use ligament_run::progress::ProgressMode;
use verification::bench::{self, Bench, Run};
use verification::meshes;
use verification::numbers::{component, deviation, largest, relative_error};

/// Square of side 0.1 m, 1 cm thick, on 137 irregular points, or on the mesh that a test gives.
const SQUARE: &str = r#"
mesh = { file = "reference/square.msh", thickness = 0.01 }
material = { young = 15e9, poisson = 0.21 }
model = { law = "nhpd", horizon_factor = 3.0 }
"#;

/// Plate 0.2 x 0.1 m, 2 cm thick, of 1543 irregular points.
const PLATE: &str = r#"
mesh = { file = "../meshes/plate.msh", thickness = 0.02 }
material = { young = 15e9, poisson = 0.21 }
model = { law = "nhpd", horizon_factor = 3.0 }
"#;

const YOUNG: f64 = 15e9; // Pa
const POISSON: f64 = 0.21;

/// The free body of a run that has one, and nothing else to tell.
fn free_body(bench: &Bench, run: &Run) -> FreeBody {
    let mut bodies = of_intact_body(&*bench.model.system, &bench.boundary);
    let (Some(body), true) = (bodies.pop(), bodies.is_empty()) else {
        panic!("one free body expected")
    };
    assert_eq!(run.messages, [body.message(bench.model.setup.closing)]);
    body
}

/// A run ended without equilibrium, for a gauge would have to carry a load.
fn assert_carried(run: &Run) {
    let end = &run.outcome.termination;
    let Termination::NoEquilibrium { step: 1, reason } = end else {
        panic!("{end:?}")
    };
    assert!(
        matches!(reason, Unbalanced::LoadOnAddedSupport { .. }),
        "{reason}"
    );
    assert_eq!(run.outcome.history.len(), 1, "the unloaded body alone");
}

/// Force or couple that each gauge carries: what the bonds exert there less what is given, N or N m.
fn carried(bench: &Bench, run: &Run) -> Vec<(usize, f64)> {
    let internal = sweep(bench, run).internal.values;
    let force = |&(point, component): &(u32, Component)| {
        let layout = bench.model.plane().topology().layout;
        let dof = layout.degree_of_freedom(point, component).unwrap();
        (dof, internal[dof] - bench.boundary.force[dof])
    };
    free_body(bench, run).gauges.iter().map(force).collect()
}

fn sweep(bench: &Bench, run: &Run) -> BondSweep {
    internal::sweep(
        &**bench.model.plane(),
        run.state().bonds(),
        run.displacement(),
        ThermalStrain::NONE,
    )
}

/// Resultant of forces and couples (3 n_points): along x, along y, and the moment about the origin of the mesh file.
fn resultant(bench: &Bench, forces: &[f64]) -> [f64; 3] {
    let of_points = forces.chunks(3).zip(bench.positions());
    of_points.fold([0.0; 3], |[x, y, moment], (force, p)| {
        let arm = p[0] * force[1] - p[1] * force[0] + force[2];
        [x + force[0], y + force[1], moment + arm]
    })
}

/// A profile from 0 at y = 0 to 1 at y = 0.1 m gives half of a total, its resultant at two thirds of the side, on five edges as well as on
/// any number: the traction is linear along each edge and is integrated with the shape functions (halves of edges times the factors at the
/// nodes had 2.0 % too much of its moment here). The end of the last edge, of length h, has (3 - h/L)/6 of h times the full traction.
#[test]
fn a_linear_profile_has_its_force_and_moment() {
    let plain = "load = [{ group = \"right\", force = { x = 1e3, y = 200.0 } }]\n";
    let support = "support = [{ group = \"left\", displacement = { x = 0.0, y = 0.0 } }]\n";
    let profile = ", profile = { along = \"y\", zero = 0.0, one = 0.1 } }]";
    let settings = ["mesh.file=../meshes/plate-coarse.msh"];
    let bench = |load: &str| Bench::new(&format!("{PLATE}{support}{load}"), &settings);
    let linear = plain.replace(" }]", profile);
    let varying = bench(&linear);
    let [x, y, moment] = resultant(&varying, &varying.boundary.force);
    assert!(relative_error(x, 500.0) < 1e-12 && relative_error(y, 100.0) < 1e-12);
    let expected = 100.0 * 0.2 - 500.0 * 0.2 / 3.0;
    println!("moment {moment}, {expected}");
    assert!(relative_error(moment, expected) < 1e-12);
    let mut heights: Vec<f64> = (varying.group("right").iter())
        .map(|&it| varying.positions()[it as usize][1])
        .collect();
    heights.sort_by(f64::total_cmp);
    let edge = (heights[heights.len() - 1] - heights[heights.len() - 2]) / 0.1;
    let top = varying.model.plane().cloud.nearest_point([0.2, 0.1]) as usize;
    let share = varying.boundary.force[3 * top] / 1e3;
    assert!(
        relative_error(share, edge * (3.0 - edge) / 6.0) < 1e-12,
        "{share}"
    );
    // Prescribed displacements in the same way, also where the factor is negative.
    let moved = "load = [{ group = \"right\", displacement = { x = 1e-5 }, profile = { along = \"y\", zero = 0.05, one = 0.1 } }]\n";
    let moved = bench(moved);
    for point in moved.group("right") {
        let wanted = 1e-5 * (moved.positions()[point as usize][1] - 0.05) / 0.05;
        let given = moved.boundary.prescribed[3 * point as usize].unwrap();
        assert!((given - wanted).abs() < 1e-20);
    }
}

/// Displacement and force of the control are work-conjugate for every kind of load: the stored energy of a linear body is
/// half their product (Clapeyron), to the 1e-9 to which equilibria are solved. Nothing else does work here.
#[test]
fn displacement_and_force_do_the_work_of_the_load() {
    let support = "support = [{ group = \"left\", displacement = { x = 0.0, y = 0.0 } }]\n";
    let profile = "profile = { along = \"y\", zero = 0.05, one = 0.1 }";
    for (load, kind, size) in [
        (
            "group = \"right\", force = { x = 3e3, y = 4e3 }".to_owned(),
            ControlKind::Force,
            5e3,
        ),
        (
            format!("group = \"right\", force = {{ x = 1e4 }}, {profile}"),
            ControlKind::Force,
            1e4,
        ),
        (
            format!("group = \"right\", force_per_length = {{ x = 1e5 }}, {profile}"),
            ControlKind::Force,
            1e4,
        ),
        (
            format!("body_force = {{ x = 1e6 }}, {profile}"),
            ControlKind::Force,
            400.0,
        ),
        (
            "group = \"right\", moment = -20.0".to_owned(),
            ControlKind::Force,
            20.0,
        ),
        ("body_couple = 5e4".to_owned(), ControlKind::Force, 20.0),
        (
            "group = \"right\", pressure = -2e5".to_owned(),
            ControlKind::Force,
            2e5,
        ),
        (
            format!("group = \"right\", pressure = 3e5, {profile}"),
            ControlKind::Force,
            3e5,
        ),
        (
            "group = \"right\", displacement = { x = 1e-5, y = 0.0 }".to_owned(),
            ControlKind::Displacement,
            1e-5,
        ),
        (
            format!("group = \"right\", displacement = {{ x = 1e-5 }}, {profile}"),
            ControlKind::Displacement,
            1e-5,
        ),
    ] {
        let text = format!("{PLATE}{support}load = [{{ {load} }}]\n");
        let bench = Bench::new(&text, &["mesh.file=../meshes/plate-coarse.msh"]);
        let control = &bench.boundary.control;
        assert_eq!(control.kind, kind, "{load}");
        assert!(
            relative_error(control.magnitude, size) < 1e-12,
            "{load}: {}",
            control.magnitude
        );
        let run = bench.solve();
        let last = run.last();
        let work = 0.5 * last.reaction * last.displacement;
        println!("{load}: {:.4e} at {:.4e}", last.reaction, last.displacement);
        assert!(last.reaction > 0.0 && last.displacement > 0.0, "{load}");
        assert!(
            relative_error(last.stored_energy, work) < 1e-9,
            "{load}: {work:e}"
        );
        assert!(
            relative_error(
                run.outcome.elastic_stiffness,
                last.reaction / last.displacement
            ) < 1e-9
        );
    }
}

/// Pure bending of a square of side 2h by sigma_y = p x/h at the bottom and the top, p = 1 MPa; nothing else holds it.
///
/// Closed form (plane stress, from the middle): u_y = p x y/(E h), u_x = -p (y^2 + nu x^2)/(2 E h). A free body is compared by
/// what no rigid motion changes: u_y of the four corners in the pattern x y, and u_x at the ends of both axes against the
/// middle.
fn bending_errors(n: u32) -> [f64; 3] {
    let h = 0.05;
    let mesh = meshes::lattice(n, 2.0 * h / f64::from(n), [-h, -h]);
    let load = |group: &str, line: f64| {
        format!(
            "[[load]]\ngroup = \"{group}\"\nforce_per_length = {{ y = {line:?} }}\n\
             profile = {{ along = \"x\", zero = 0.0, one = {h:?} }}\n"
        )
    };
    let text = format!("{SQUARE}{}{}", load("top", 1e4), load("bottom", -1e4));
    let bench = Bench::on(&mesh, &text, &[]);
    let run = bench.solve();
    let body = free_body(&bench, &run);
    assert!(body.is_whole && body.is_balanced(), "{body:?}");
    assert_eq!(body.motions.len(), 3);
    let u = |x: f64, y: f64, axis: usize| {
        let point = bench.model.plane().cloud.nearest_point([x, y]);
        run.displacement()[3 * point as usize + axis]
    };
    let corners = [[h, h, 1.0], [-h, h, -1.0], [-h, -h, 1.0], [h, -h, -1.0]];
    let along = corners
        .map(|[x, y, sign]| sign * u(x, y, 1))
        .iter()
        .sum::<f64>()
        / 4.0;
    let deflection = 0.5 * (u(0.0, h, 0) + u(0.0, -h, 0)) - u(0.0, 0.0, 0);
    let lateral = 0.5 * (u(h, 0.0, 0) + u(-h, 0.0, 0)) - u(0.0, 0.0, 0);
    let p = 1e6 / YOUNG;
    [
        along / (p * h) - 1.0,
        deflection / (-0.5 * p * h) - 1.0,
        lateral / (-0.5 * p * POISSON * h) - 1.0,
    ]
}

/// Pure bending on 24, 50 and 100 cells a side. Tolerances: the outermost row bears the load with half of its bonds, which
/// moves the loaded sides by a part of the spacing dx more (measured 0.7 to 0.8 dx/h of u_y at the corners; dx/h is allowed,
/// and it must fall with dx). The deflection of the axis has E alone in it, of which uniaxial energies are right: 1 %. The
/// lateral one has Poisson's ratio, which this method misses by up to 6 % at lambda = 3 (`physics`): the same is allowed.
#[test]
fn pure_bending_of_a_square() {
    let mut last = f64::INFINITY;
    for n in [24, 50, 100] {
        let [along, deflection, lateral] = bending_errors(n);
        println!("{n} cells: u_y {along:+.4}, deflection {deflection:+.4}, lateral {lateral:+.4}");
        assert!(
            along.abs() < 2.0 / f64::from(n) && along.abs() < 0.7 * last,
            "{along}"
        );
        assert!(deflection.abs() < 0.01, "{deflection}");
        assert!(lateral.abs() < 0.06, "{lateral}");
        last = along.abs();
    }
}

/// A couple in the middle of a free plate against a pair of forces at its ends, or against couples there: the moments
/// balance and the gauges carry nothing; without the counterpart the gauges would carry the couple, and there is no
/// equilibrium.
#[test]
fn a_couple_is_balanced_by_forces() {
    let couple = "[[load]]\nbox = [[0.08, -0.01], [0.12, 0.11]]\nmoment = 100.0\n";
    let pair = "[[load]]\ngroup = \"right\"\nforce = { y = -500.0 }\n[[load]]\ngroup = \"left\"\nforce = { y = 500.0 }\n";
    let ends =
        "[[load]]\ngroup = \"right\"\nmoment = -60.0\n[[load]]\ngroup = \"left\"\nmoment = -40.0\n";
    for (counterpart, balanced) in [(pair, true), (ends, true), ("", false)] {
        let bench = Bench::new(&format!("{PLATE}{couple}{counterpart}"), &[]);
        let run = bench.solve();
        let body = free_body(&bench, &run);
        let moment = if balanced { 0.0 } else { 100.0 };
        let told = (body.motions.iter()).find(|it| it.component == Component::Rotation);
        assert!((told.unwrap().load - moment).abs() < 1e-9, "{told:?}");
        assert_eq!(body.is_balanced(), balanced, "{body:?}");
        if !balanced {
            assert_carried(&run);
            continue;
        }
        let mut reactions = vec![0.0; 3 * bench.points()];
        for (dof, force) in carried(&bench, &run) {
            reactions[dof] = force;
        }
        let [x, y, moment] = resultant(&bench, &reactions);
        println!("{balanced}: gauges exert {x:.2e} N, {y:.2e} N, {moment:.2e} N m; {body:?}");
        // Equilibria are solved to 1e-10 of what meets at a point; forces of 500 N act over 0.2 m.
        assert!(x.abs() < 1e-6 && y.abs() < 1e-6 && moment.abs() < 1e-6);
        assert!(
            largest(component(run.displacement(), 2)) > 1e-6,
            "the plate is bent"
        );
    }
}

/// Strip of 96 x 24 mm, 1 cm thick, with 6 edges at its left end and 7 at its right end.
const UNEVEN: &str = r#"
mesh = { file = "../meshes/uneven-strip.msh", thickness = 0.01 }
material = { young = 15e9, poisson = 0.21 }
model = { law = "nhpd", horizon_factor = 3.0 }
correction = { surface = "patch" }
"#;

/// Linear tractions on both ends of a free strip balance although the ends have different edges, by a force per length as by a pressure: the
/// moment of each is p t H^2/6 to rounding (values at the nodes had 2/36 and 2/49 more, which was no equilibrium). The strip takes the energy
/// M^2 L/(2 E I) of a beam but for what few cells across leave of its stiffness: within 10 %, twice the 5 % that are measured.
#[test]
fn linear_tractions_on_ends_with_different_edges_balance() {
    let profile = "profile = { along = \"y\", zero = 0.0, one = 0.012 }";
    let of_line = |group: &str, line: f64| {
        format!("[[load]]\ngroup = \"{group}\"\nforce_per_length = {{ x = {line:?} }}\n{profile}\n")
    };
    let of_pressure =
        |group: &str| format!("[[load]]\ngroup = \"{group}\"\npressure = -1e6\n{profile}\n");
    let moment = 1e6 * 0.01 * 0.024_f64.powi(2) / 6.0;
    let beam = moment.powi(2) * 0.096 / (2.0 * 15e9 * 0.01 * 0.024_f64.powi(3) / 12.0);
    for (loads, size) in [
        ([of_line("right", 1e4), of_line("left", -1e4)], 1e4 * 0.024),
        (["right", "left"].map(of_pressure), 1e6),
    ] {
        let bench = Bench::new(&format!("{UNEVEN}{}", loads.concat()), &[]);
        let right = bench.group("right");
        let of_point = |&point: &u32| {
            let dof = 3 * point as usize;
            -bench.boundary.force[dof] * bench.positions()[point as usize][1]
        };
        let found: f64 = right.iter().map(of_point).sum();
        assert!(relative_error(found, -moment) < 1e-12, "{found}");
        let run = bench.solve();
        let body = free_body(&bench, &run);
        assert!(body.is_balanced(), "{body:?}");
        let last = run.last();
        println!(
            "energy {:.4e} J, of a beam {beam:.4e} J",
            last.stored_energy
        );
        assert!(relative_error(last.stored_energy, beam) < 0.1);
        // Both ends do work: 2 W/F.
        assert!(relative_error(last.displacement, 2.0 * last.stored_energy / size) < 1e-9);
    }
}

/// The stiffness of a free bar in tension is E A/L = 37.5 MN/m whichever end comes first, whichever nodes are gauges, and whatever else is
/// free: displacement and force do the work of both forces. Within .1 %, of which .002 % are measured. Loads in another order agree to the
/// 1e-9 to which equilibria are solved; the mirrored body, whose patch correction is another iteration, to 1e-4, of which 4e-5 are
/// measured. With the first load alone the displacement was the one of an end against the gauges, and the stiffness 216 MN/m. A support that
/// holds one point chooses that point itself, so there the displacement is still the one of the first load.
#[test]
fn the_stiffness_of_a_free_bar_does_not_depend_on_gauges() {
    let pull = |group: &str, force: f64| {
        format!("[[load]]\ngroup = \"{group}\"\nforce = {{ x = {force:?} }}\n")
    };
    let (right, left) = (pull("right", 2e3), pull("left", -2e3));
    let mesh = meshes::read("meshes/uneven-strip.msh");
    let mut mirrored = mesh.clone();
    for place in &mut mirrored.positions {
        *place = place.map(|it| -it);
    }
    let mut gauges = Vec::new();
    let mut stiffnesses = Vec::new();
    for (mesh, loads) in [
        (&mesh, [&right, &left]),
        (&mesh, [&left, &right]),
        (&mirrored, [&pull("left", 2e3), &pull("right", -2e3)]),
    ] {
        let bench = Bench::on(mesh, &format!("{UNEVEN}{}{}", loads[0], loads[1]), &[]);
        assert!(bench.boundary.is_displaced_by_all());
        let run = bench.solve();
        let places = free_body(&bench, &run).gauges.into_iter();
        let at = |(point, _): (u32, Component)| bench.positions()[point as usize].map(f64::abs);
        gauges.push(places.map(at).collect::<Vec<_>>());
        let last = run.last();
        assert!(relative_error(last.displacement, 2.0 * last.stored_energy / 2e3) < 1e-9);
        assert!(relative_error(last.reaction, 2e3) < 1e-12);
        stiffnesses.push(run.outcome.elastic_stiffness);
    }
    println!("{stiffnesses:?}, gauges {gauges:?}");
    let known = 15e9 * 0.024 * 0.01 / 0.096;
    for (stiffness, differs) in stiffnesses.iter().zip([1e-9, 1e-9, 1e-4]) {
        assert!(relative_error(*stiffness, known) < 1e-3, "{stiffness}");
        assert!(relative_error(*stiffness, stiffnesses[0]) < differs);
    }
    let held =
        "support = [{ at = [0.0, 0.0], displacement = { x = 0.0, y = 0.0, rotation = 0.0 } }]\n";
    for (supports, loads) in [(held, &right), ("", &left)] {
        let text = format!("{supports}{UNEVEN}{loads}");
        assert!(!Bench::new(&text, &[]).boundary.is_displaced_by_all());
    }
}

/// Linear tractions on a surface of a solid: a force per area, a total force and a pressure, on triangles, have force and moments to rounding.
/// The right side of the bar, 1 m^2 at x = 4 m between -0.5 and 0.5 m, has z from -1 to 1 times the traction: no force, the moment of p A^2/6.
#[test]
fn a_linear_profile_on_a_surface_has_its_force_and_moment() {
    for load in [
        "force_per_area = { x = 1e6 }",
        "force = { x = 1e6 }",
        "pressure = -1e6",
    ] {
        let text = format!(
            "mesh = {{ file = \"../meshes/solids/bar.msh\" }}\nmaterial = {{ young = 30e9, poisson = 0.2 }}\n\
             model = {{ law = \"nhpd\", horizon_factor = 2.0 }}\nsupport = [{{ group = \"left\", displacement = {{ x = 0.0, y = 0.0, z = 0.0 }} }}]\n\
             [[load]]\ngroup = \"right\"\n{load}\nprofile = {{ along = \"z\", zero = 0.0, one = 0.5 }}\n"
        );
        let setup = bench::case(&text, &[]).setup(&mut ()).unwrap();
        let model = ligament::Model::build(setup, &mut ()).unwrap();
        let boundary = ligament::Loading::new(&model).unwrap().boundary;
        let [mut force, mut about_y, mut about_z] = [0.0; 3];
        for (at, of_point) in model
            .solid()
            .cloud
            .positions
            .iter()
            .zip(boundary.force.chunks(6))
        {
            force += of_point[0];
            about_y += at[2] * of_point[0];
            about_z -= at[1] * of_point[0];
        }
        println!("{load}: {force:e} N, {about_y} N m, {about_z:e} N m");
        // Some hundred terms of 1e4 N with rounding.
        assert!(force.abs() < 1e-6 && about_z.abs() < 1e-6);
        assert!(relative_error(about_y, 1e6 / 6.0) < 1e-12);
    }
}

/// Tension in equilibrium with itself: automatic gauges, and two choices of a user, give the same deformations of the bonds.
#[test]
fn strains_do_not_depend_on_the_gauges() {
    let load = "load = [{ group = \"right\", force = { x = 2e3 } }, { group = \"left\", force = { x = -2e3 } }]\n";
    let chosen = [
        "support = [{ at = [0.1, 0.05], displacement = { x = 0.0, y = 0.0, rotation = 0.0 } }]\n",
        "support = [{ at = [0.0, 0.0], displacement = { x = 0.0, y = 0.0 } }, { at = [0.2, 0.1], displacement = { y = 0.0 } }]\n",
    ];
    let solve = |support: &str| {
        let bench = Bench::new(&format!("{PLATE}{support}{load}"), &[]);
        let run = bench.solve();
        let deformations = sweep(&bench, &run).deformations;
        let strains: Vec<f64> = deformations.iter().flat_map(|it| it.strains()).collect();
        (strains, bench, run)
    };
    let (automatic, bench, run) = solve("");
    assert!(free_body(&bench, &run).is_balanced());
    assert!(largest(automatic.iter().copied()) > 5e-5);
    for support in chosen {
        let (strains, _, held) = solve(support);
        assert!(held.messages.is_empty(), "{:?}", held.messages);
        let error = deviation(&strains, &automatic);
        println!("deviation {error:.1e}");
        assert!(error < 1e-9, "{error:e}");
        assert!(
            deviation(held.displacement(), run.displacement()) > 1e-3,
            "another rigid motion"
        );
    }
}

/// Loads that are not in equilibrium are told, with what is missing along each free motion; so are those on a body that a
/// support holds in part. The gauges would carry it: there is no equilibrium.
#[test]
fn missing_equilibrium_is_told() {
    let pull = "load = [{ group = \"right\", force = { x = 2e3, y = 300.0 } }]\n";
    let bench = Bench::new(&format!("{PLATE}{pull}"), &[]);
    let run = bench.solve();
    let body = free_body(&bench, &run);
    assert!(!body.is_balanced());
    let told: Vec<(Component, f64)> = body
        .motions
        .iter()
        .map(|it| (it.component, it.load))
        .collect();
    let [
        (Component::X, x),
        (Component::Y, y),
        (Component::Rotation, moment),
    ] = told[..]
    else {
        panic!("{told:?}")
    };
    assert!(relative_error(x, 2e3) < 1e-9 && relative_error(y, 300.0) < 1e-9);
    assert!(moment.abs() > 10.0);
    assert_carried(&run);
    // Held along x at the whole left side: only y is free, and only what is missing along it is told.
    let part =
        format!("{PLATE}support = [{{ group = \"left\", displacement = {{ x = 0.0 }} }}]\n{pull}");
    let bench = Bench::new(&part, &[]);
    let run = bench.solve();
    let body = free_body(&bench, &run);
    assert_eq!(body.motions.len(), 1);
    assert_eq!(
        (body.motions[0].component, body.gauges.len()),
        (Component::Y, 1)
    );
    assert!(relative_error(body.motions[0].load, 300.0) < 1e-9 && !body.is_balanced());
    assert_carried(&run);
    // Held along x at one point: y and the rotation about that point are free.
    let hinge =
        format!("{PLATE}support = [{{ at = [0.0, 0.1], displacement = {{ x = 0.0 }} }}]\n{pull}");
    let bench = Bench::new(&hinge, &[]);
    let run = bench.solve();
    let components: Vec<Component> = free_body(&bench, &run)
        .motions
        .iter()
        .map(|it| it.component)
        .collect();
    assert_eq!(components, [Component::Y, Component::Rotation]);
    assert_carried(&run);
}

/// `check` and `summary.json` tell the same of a free body: motions, gauges by node and position, and the balance.
#[test]
fn check_and_summary_tell_of_gauges() {
    let pull = "load = [{ group = \"right\", force = { x = 2e3 } }]\n";
    let settings = ["mesh.file=../meshes/plate-coarse.msh"];
    let case = bench::case(&format!("{PLATE}{pull}"), &settings);
    let mut report = Vec::new();
    check(&case, CheckExtent::Model, None, Lines::All, &mut report).unwrap();
    let report = String::from_utf8(report).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let summary = bench::run_program(&case, &folder.path().join("out"));
    let [warning] = &summary.warnings[..] else {
        panic!("{:?}", summary.warnings)
    };
    assert!(report.contains(warning), "{report}\n{warning}");
    assert!(
        warning.starts_with("the supports leave the body free in translation along x, translation along y, rotation; fixed automatically: \
            "),
        "{warning}"
    );
    let told = "; the loads do NOT balance (along x 2.000e3 N, moment ";
    assert!(
        warning.contains(told) && warning.contains("of node 1 at (0.000000, 0.000000)"),
        "{warning}"
    );
}

/// A couple where no bond resists rotations, and a profile that is zero everywhere, are refused before anything is written.
#[test]
fn loads_that_do_nothing_are_refused() {
    let refused = |load: &str, setting: &str| {
        let settings = ["mesh.file=../meshes/plate-coarse.msh", setting];
        let case = bench::case(&format!("{PLATE}{load}\n"), &settings);
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().join("out");
        let run = ligament_run::run::run(&case, &out, false, ProgressMode::Quiet)
            .unwrap_err()
            .to_string();
        let checked = check(&case, CheckExtent::Model, None, Lines::All, &mut Vec::new())
            .unwrap_err()
            .to_string();
        assert_eq!(run, checked);
        assert!(!out.exists());
        run
    };
    let couple = "load = [{ group = \"right\", force = { x = 1.0 } }, { body_couple = 1.0 }]";
    for setting in ["material.poisson=0.333333333333333333", "model.law=pds"] {
        let message = refused(couple, setting);
        assert!(
            message.contains(
                "load.1.body_couple: the couple acts on 80 points that no bond keeps from turning"
            ),
            "{message}"
        );
    }
    let twice = "load = [{ group = \"left\", displacement = { x = 1e-5, rotation = 1e-3 } }, \
                 { name = \"other\", group = \"left\", displacement = { rotation = 2e-3 } }]";
    for law in ["model.law=nhpd", "model.law=pds"] {
        let message = refused(twice, law);
        assert!(message.contains("component rotation of node"), "{message}");
    }
    let zero = "load = [{ group = \"left\", force = { x = 1.0 }, profile = { along = \"x\", zero = 0.0, one = 1.0 } }]";
    let message = refused(zero, "material.poisson=0.2");
    assert!(
        message.contains("load.0.profile: the load does nothing: its profile is zero"),
        "{message}"
    );
}

/// Where points do not turn, a support, a load or a probe may name their rotation all the same: it is zero, and nothing else
/// changes, so that one case serves all laws.
#[test]
fn rotations_that_points_do_not_have_do_nothing() {
    let case = |rotation: &str| {
        let text = format!(
            "{PLATE}support = [{{ group = \"left\", displacement = {{ x = 0.0, y = 0.0{rotation} }} }}]\n\
             load = [{{ group = \"right\", displacement = {{ x = 1e-5{rotation} }} }}]\n\
             probe = [{{ name = \"turn\", at = [0.2, 0.05], field = \"rotation\" }}]\n"
        );
        Bench::new(&text, &["model.law=pds"])
    };
    let [without, with] = ["", ", rotation = 0.0"].map(case);
    let [expected, found] = [&without, &with].map(Bench::solve);
    assert_eq!(found.displacement(), expected.displacement());
    assert_eq!(found.displacement().len(), 2 * with.points());
    assert_eq!(found.last(), expected.last());
    assert_eq!(found.last().probes, [0.0]);
    assert!(found.group_force(&with, "left")[0] < -1.0);
    assert_eq!(found.group_force(&with, "left")[2], 0.0);
}

/// Without rotations of the points a rigid rotation costs energy where bonds have a shear stiffness: two gauges hold the body,
/// and tension in equilibrium leaves nothing for them. Without shear stiffness there are three free motions.
#[test]
fn bodies_of_springs_have_the_free_motions_that_cost_no_energy() {
    let load = "load = [{ group = \"right\", force = { x = 2e3 } }, { group = \"left\", force = { x = -2e3 } }]\n";
    for (law, poisson, count) in [("pds", "0.2", 2), ("bbpd", "0.333333333333333333", 3)] {
        let settings = [
            format!("model.law={law}"),
            format!("material.poisson={poisson}"),
        ];
        let text = format!("{PLATE}{load}");
        let bench = Bench::new(&text, &[&settings[0], &settings[1]]);
        let run = bench.solve();
        let body = free_body(&bench, &run);
        assert_eq!(
            (body.motions.len(), body.gauges.len()),
            (count, count),
            "{law}"
        );
        assert!(body.is_balanced());
        // Equilibria are solved to 1e-10 of what meets at a point, which is some 100 N.
        for (_, force) in carried(&bench, &run) {
            assert!(force.abs() < 1e-6, "{law}: {force:e}");
        }
        assert!(run.last().displacement > 1e-6);
    }
}

/// Brittle bonds that fail by stress at the edge of a platen: told from a horizon factor of 4 with `body` and of 5 with `families`, where a
/// displacement is prescribed on a part of a side, and nowhere else (docs/fracture.md has the loads at the first breakage).
#[test]
fn the_edge_of_a_platen_is_told() {
    let disk = |factor: f64, reference: &str, load: &str, criterion: &str| {
        let text = format!(
            "mesh = {{ file = \"../meshes/disk-4mm.msh\", thickness = 0.05 }}\n\
             material = {{ young = 15e9, poisson = 0.21, tensile_strength = 3.81e6, fracture_energy = 20.0 }}\n\
             model = {{ law = \"nhpd\", horizon_factor = {factor:?} }}\ncorrection = {{ surface = \"patch\", reference = \"{reference}\" }}\n\
             [fracture]\ncontrol = \"stepped\"\nsteps = 1\n[[fracture.criterion]]\n{criterion}\n\
             [[load]]\ngroup = \"platen-top\"\n{load}\n[[load]]\ngroup = \"platen-bottom\"\n{load}\n"
        );
        told_of_platen(&text)
    };
    let (moved, brittle) = ("displacement = { y = 1e-4 }", "kind = \"bond-rankine\"");
    let advice = disk(4.0, "body", moved, brittle).unwrap();
    assert!(advice.contains("families"), "{advice}");
    let advice = disk(5.0, "families", moved, brittle).unwrap();
    assert!(!advice.contains("families"), "{advice}");
    for (factor, reference, load, criterion) in [
        (3.0, "body", moved, brittle),
        (4.0, "families", moved, brittle),
        (4.0, "body", "force = { y = 1e4 }", brittle),
        (4.0, "body", "pressure = 1e6", brittle),
        (4.0, "body", moved, "kind = \"strength\""),
        (4.0, "body", moved, "kind = \"rankine\"\nafter = \"linear\""),
    ] {
        let told = disk(factor, reference, load, criterion);
        assert_eq!(told, None, "{factor} {reference} {load} {criterion}");
    }
    // The whole side of a plate ends at corners.
    let plate = "mesh = { file = \"../meshes/plate-coarse.msh\", thickness = 0.02 }\n\
        material = { young = 15e9, poisson = 0.21, tensile_strength = 3.81e6 }\nmodel = { law = \"nhpd\", horizon_factor = 4.0 }\n\
        correction = { surface = \"patch\", reference = \"body\" }\nload = [{ group = \"right\", displacement = { x = 1e-4 } }]\n\
        support = [{ group = \"left\", displacement = { x = 0.0, y = 0.0 } }]\n\
        [fracture]\ncontrol = \"stepped\"\nsteps = 1\n[[fracture.criterion]]\nkind = \"bond-rankine\"\n";
    assert_eq!(told_of_platen(plate), None);
}

/// Advice of the message about the edge of a platen; None without the message.
fn told_of_platen(text: &str) -> Option<String> {
    let setup = bench::case(text, &[]).setup(&mut ()).unwrap();
    let model = ligament::Model::build(setup, &mut ()).unwrap();
    let mut warnings = model.warnings.into_iter();
    let told = warnings.find(|it| it.kind == "early-at-platen")?;
    told.advice
}

/// A mesh in other units is scaled, and nothing else: the square of 100 mm read as one of 50 mm has half of the lengths, and a group of it a traction on
/// half of its length.
#[test]
fn a_mesh_is_scaled_alone() {
    let text = r#"
mesh = { file = "../meshes/square-delaunay.msh" }
material = { young = 30e9, poisson = 0.2 }
model = { law = "nhpd", horizon_factor = 3.0 }
support = [{ group = "left", displacement = { x = 0.0 } }, { group = "corner", displacement = { y = 0.0 } }]
load = [{ group = "right", force_per_length = { x = 1e6 } }]
"#;
    let [whole, half] = [&[][..], &["mesh.scale=0.5"]].map(|it| Bench::new(text, it));
    let [of_whole, of_half] = [&whole, &half].map(|it| it.model.volume_of_material(0));
    // Products with a power of two are exact.
    assert_eq!(of_half, 0.25 * of_whole);
    let horizons = [&whole, &half].map(|it| it.model.fixed.horizon[7]);
    assert!((horizons[1] / horizons[0] - 0.5).abs() < 1e-12);
    let mut warnings = half.model.warnings.iter();
    assert!(warnings.any(|it| it.kind == "scaled-mesh"));
    assert!(
        whole
            .model
            .warnings
            .iter()
            .all(|it| it.kind != "scaled-mesh")
    );
}
