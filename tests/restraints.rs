//! Springs, inclined rollers and platens that tilt, against closed forms and against each other.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use ligament::Loading;
use ligament::run::follow;
use verification::bench::{Bench, Run, Watch};
use verification::numbers::relative_error;

/// A block of 30 x 20 mm, E = 30 GPa, without supports and loads.
const BLOCK: &str = r#"
[lattice]
cells = [30, 20]
spacing = 0.001
thickness = 0.01
set = { left = { left = 1 }, right = { right = 1 }, bottom = { bottom = 1 }, top = { top = 1 } }
[material]
young = 30e9
poisson = 0.2
tensile_strength = 3e6
[model]
law = "mppd"
horizon_factor = 3.0
"#;

fn solved(supports: &str, loads: &str) -> (Bench, Run) {
    let bench = Bench::new(&format!("{BLOCK}\n{supports}\n{loads}"), &[]);
    let run = bench.solve();
    (bench, run)
}

/// Force over displacement of the first load.
fn stiffness(run: &Run) -> f64 {
    run.last().reaction / run.last().displacement
}

const INCLINED: &str = r#"
[[support]]
group = "bottom"
normal = [-0.5, 0.8660254037844386]
[[support]]
box = [[0.0, 0.001], [0.001, 0.019]]
stiffness = { x = 1e6 }
"#;

const WEIGHT: &str = "[[load]]\ngroup = \"top\"\nforce = { y = -1000.0 }";

/// A block on rollers at 30 degrees that a spring along x keeps from sliding. Rollers carry W/cos(30) along their normal, the spring W
/// tan(30); it gives way by that over its stiffness, and the block moves along the plane. Forces are those of a rigid body whatever the
/// block's stiffness: to 1e-6, as rollers are 1e6 times as stiff as points and the block moves 1e4 times as far as it deforms. The spring is
/// stretched by the mean of its points. Rollers give way by 1e-6 of what bonds do.
#[test]
fn a_block_slides_down_inclined_rollers_onto_a_spring() {
    let (bench, run) = solved(INCLINED, WEIGHT);
    let rollers = run.group_force(&bench, "bottom");
    let spring = run.group_force(&bench, "support-2");
    let push = 1000.0 * 30f64.to_radians().tan();
    assert!(relative_error(rollers[0], -push) < 1e-6, "{rollers:?}");
    assert!(relative_error(rollers[1], 1000.0) < 1e-6, "{rollers:?}");
    assert!(
        relative_error(spring[0], push) < 1e-6 && spring[1] == 0.0,
        "{spring:?}"
    );
    let left = &bench.group("left")[1..19];
    let along_x = |&point: &u32| run.displacement()[3 * point as usize];
    let mean = left.iter().map(along_x).sum::<f64>() / left.len() as f64;
    assert!(relative_error(mean, -push / 1e6) < 1e-6, "{mean:e}");
    let bottom = bench.group("bottom");
    let normal = |&point: &u32| {
        let u = &run.displacement()[3 * point as usize..];
        -0.5 * u[0] + 0.75f64.sqrt() * u[1]
    };
    let largest = bottom
        .iter()
        .map(normal)
        .fold(0.0, |one: f64, it| one.max(it.abs()));
    // Bonds shorten by some 1e-7 m under 5 MPa.
    assert!(largest < 1e-12, "{largest:e}");
    assert!(
        run.messages.is_empty() && run.held[0] == 0,
        "nothing else holds"
    );
}

/// Inclined rollers whose normal is y are supports that hold y, and so are rollers 1e-9 off it: to 1e-5, by which springs in their place give
/// way.
#[test]
fn a_nearly_vertical_normal_is_a_support() {
    let load = "load = [{ group = \"top\", displacement = { y = -1e-6 } }]";
    let side = "support = [{ group = \"left\", displacement = { x = 0.0 } },";
    let held = format!("{side} {{ group = \"bottom\", displacement = {{ y = 0.0 }} }}]");
    let exact = format!("{side} {{ group = \"bottom\", normal = [0.0, 2.0] }}]");
    let nearly = format!("{side} {{ group = \"bottom\", normal = [1e-9, 1.0] }}]");
    let [held, exact, nearly] = [held, exact, nearly].map(|it| {
        let text = BLOCK.replace("[lattice]", &format!("{it}\n{load}\n[lattice]"));
        Bench::new(&text, &[]).solve()
    });
    assert_eq!(
        held.displacement(),
        exact.displacement(),
        "a normal along an axis holds exactly"
    );
    let error = relative_error(stiffness(&nearly), stiffness(&held));
    println!("rollers against supports that hold: {error:.1e}");
    assert!(error < 1e-5, "{error:e}");
}

/// A bar in a testing machine that gives way: 1/K = 1/K_bar + 1/k, of the mean displacement of the end under a platen exactly, up to the
/// 1e-6 by which platens give way. Without a platen each point has its own spring, and the end face needs not stay straight: within 1 %
/// of the same.
#[test]
fn a_testing_machine_and_the_bar_are_springs_in_series() {
    let supports = "[[support]]\ngroup = \"left\"\ndisplacement = { x = 0.0 }\n[[support]]\nat = [0.0, 0.01]\ndisplacement = { y = 0.0 }";
    let with = |more: &str| {
        let load = format!("[[load]]\ngroup = \"right\"\ndisplacement = {{ x = 1e-5 }}\n{more}");
        stiffness(&solved(supports, &load).1)
    };
    let bar = with("tilts = true");
    for machine in [1e6, 1e8, 1e10] {
        let known = 1.0 / (1.0 / bar + 1.0 / machine);
        let platen = with(&format!("tilts = true\nstiffness = {machine:e}"));
        assert!(
            relative_error(platen, known) < 1e-5,
            "{machine:e}: {platen:e} {known:e}"
        );
        let springs = with(&format!("stiffness = {machine:e}"));
        assert!(
            relative_error(springs, known) < 1e-2,
            "{machine:e}: {springs:e} {known:e}"
        );
    }
    // A machine that does not give way is none.
    let rigid = with("");
    assert!(relative_error(with("stiffness = 1e15"), rigid) < 1e-3);
}

const HOLLOW: &str = "remove = [{ rectangle = [[0.02, 0.005], [0.028, 0.015]] }]";

/// A platen on a block with a hole beside its middle tilts. Driven by the mean displacement or by a force spread evenly it gives the same
/// stiffness and the same tilt, and its points stay in line; a platen that may not tilt is stiffer.
#[test]
fn a_platen_tilts_and_stays_straight() {
    let supports = "[[support]]\ngroup = \"bottom\"\ndisplacement = { x = 0.0, y = 0.0 }";
    let run = |load: &str| {
        let text = format!("{BLOCK}\n{supports}\n[[load]]\ngroup = \"top\"\n{load}");
        let bench = Bench::new(
            &text.replace("spacing =", &format!("{HOLLOW}\nspacing =")),
            &[],
        );
        let run = bench.solve();
        (bench, run)
    };
    let (bench, driven) = run("displacement = { y = -1e-6 }\ntilts = true");
    let (_, pressed) = run("force = { y = -1000.0 }\ntilts = true");
    let (_, straight) = run("displacement = { y = -1e-6 }");
    let error = relative_error(stiffness(&driven), stiffness(&pressed));
    assert!(error < 1e-6, "{error:e}");
    assert!(stiffness(&straight) > 1.001 * stiffness(&driven));
    let top = bench.group("top");
    let line = |run: &Run| {
        let n = top.len() as f64;
        let place = |&point: &u32| bench.positions()[point as usize][0];
        let moved = |&point: &u32| run.displacement()[3 * point as usize + 1];
        let middle = top.iter().map(place).sum::<f64>() / n;
        let mean = top.iter().map(moved).sum::<f64>() / n;
        let squares: f64 = top.iter().map(|it| (place(it) - middle).powi(2)).sum();
        let tilt = top
            .iter()
            .map(|it| (place(it) - middle) * moved(it))
            .sum::<f64>()
            / squares;
        let off = top
            .iter()
            .map(|it| moved(it) - mean - tilt * (place(it) - middle));
        (mean, tilt, off.fold(0.0, |one: f64, it| one.max(it.abs())))
    };
    let (mean, tilt, off) = line(&driven);
    println!("mean {mean:e} m, tilt {tilt:e}, off the line {off:e} m");
    assert!(relative_error(mean, -1e-6) < 1e-6, "{mean:e}");
    assert!(tilt.abs() * 0.03 > 0.01 * mean.abs(), "{tilt:e}");
    assert!(off < 1e-6 * mean.abs(), "{off:e}");
    let (pressed_mean, pressed_tilt, _) = line(&pressed);
    assert!(relative_error(pressed_tilt / pressed_mean, tilt / mean) < 1e-5);
}

/// A block pressed at a distance e from its middle by a platen: beside the mean stress the moment F e bends it, so that the platen tilts by
/// F e H/(E I), and the stiffness along the middle is that of a block under an even force. Within what the discretisation leaves of E, some 5 %.
#[test]
fn an_eccentric_force_tilts_its_platen_as_a_beam_says() {
    let supports = "[[support]]\ngroup = \"left\"\ndisplacement = { x = 0.0 }\n[[support]]\nat = [0.0, 0.01]\ndisplacement = { y = 0.0 }";
    // From 1/2 to 3/2 of the mean over the height of 20 mm: e = H/12 with the rows at their places, (n^2 - 1)/n^2 of that.
    let load = "[[load]]\ngroup = \"right\"\nforce = { x = 1000.0 }\ntilts = true\nprofile = { along = \"y\", zero = -0.01, one = 0.01 }";
    let (bench, run) = solved(supports, load);
    let right = bench.group("right");
    let [low, high] =
        [right[0], right[right.len() - 1]].map(|it| run.displacement()[3 * it as usize]);
    let tilt = (high - low) / (0.001 * (right.len() - 1) as f64);
    let (height, thickness) = (0.02_f64, 0.01);
    let moment = 1000.0 * height / 12.0 * (1.0 - 1.0 / 400.0);
    let inertia = thickness * height.powi(3) / 12.0;
    // The rows that are held and loaded lie half a cell inside.
    let known = moment * 0.029 / (30e9 * inertia);
    println!("tilt {tilt:e}, beam {known:e}");
    assert!(relative_error(tilt, known) < 0.06, "{tilt:e} {known:e}");
}

/// A block that springs alone hold: the reactions balance what is given, each spring takes its component, nothing else is held.
#[test]
fn springs_alone_hold_a_block() {
    let supports = "[[support]]\ngroup = \"bottom\"\nstiffness = { x = 2e7, y = 1e7 }";
    let load = "[[load]]\ngroup = \"top\"\nforce = { x = 300.0, y = -1000.0 }";
    let (bench, run) = solved(supports, load);
    let springs = run.group_force(&bench, "bottom");
    assert!(relative_error(springs[0], -300.0) < 1e-9 && relative_error(springs[1], 1000.0) < 1e-9);
    assert!(run.messages.is_empty() && run.held[0] == 0);
    let bottom = bench.group("bottom");
    let mean = |place: usize| {
        let moved = bottom
            .iter()
            .map(|&it| run.displacement()[3 * it as usize + place]);
        moved.sum::<f64>() / bottom.len() as f64
    };
    assert!(relative_error(mean(0), 300.0 / 2e7) < 1e-9);
    assert!(relative_error(mean(1), -1000.0 / 1e7) < 1e-9);
}

/// Rollers on one inclined plane leave the slide along it free, which one gauge holds; on two planes nothing is free.
#[test]
fn rollers_hold_what_lies_along_their_normals() {
    let pull = "[[load]]\nname = \"pull\"\ngroup = \"right\"\nforce = { x = 100.0 }\n[[load]]\nname = \"back\"\ngroup = \"left\"\nforce = { x = -100.0 }";
    let one = "[[support]]\ngroup = \"bottom\"\nnormal = [1.0, 1.0]";
    let two =
        format!("{one}\n[[support]]\nbox = [[0.0, 0.0], [0.0015, 0.02]]\nnormal = [1.0, -2.0]");
    let held = |supports: &str| solved(supports, pull).1.held[0];
    assert_eq!(held(one), 1);
    assert_eq!(held(&two), 0);
}

/// Bonds break along the exact path in a machine that gives way: the work on the body balances, the same bonds break as under a rigid
/// platen at the same forces as long as the first breaks, and the machine's displacement is larger by the force over its stiffness.
#[test]
fn a_soft_machine_stretches_the_way_to_the_first_breakage() {
    let text = |more: &str| {
        let crack = "[[precrack]]\npoints = [[0.0152, 0.0052], [0.0152, 0.03]]";
        let load = "[[support]]\ngroup = \"left\"\ndisplacement = { x = 0.0, y = 0.0 }\n[[load]]\ngroup = \"right\"\ndisplacement = { x = 1e-4 }\ntilts = true";
        let fracture = "[fracture]\ncontrol = \"event\"\nstop = { bonds = 60 }\ncriterion = [{ kind = \"tension\" }]";
        format!("{BLOCK}\n{crack}\n{load}\n{more}\n{fracture}")
    };
    let run = |more: &str| Bench::new(&text(more), &[]).break_up();
    let (rigid, soft) = (run(""), run("stiffness = 1e7"));
    for run in [&rigid, &soft] {
        for record in &run.outcome.history {
            assert!(
                record.energy_error().abs() < 1e-8,
                "{}",
                record.energy_error()
            );
        }
        assert!(run.breaks.len() >= 60);
    }
    let [first, in_machine] = [&rigid, &soft].map(|it| it.breaks[0]);
    assert_eq!(first.bond, in_machine.bond);
    assert!(relative_error(first.reaction, in_machine.reaction) < 1e-6);
    let known = first.displacement + first.reaction / 1e7;
    assert!(relative_error(in_machine.displacement, known) < 1e-6);
    // Proportional loading breaks the same bonds whatever stands before the platen.
    let order = |run: &Run| run.breaks.iter().map(|it| it.bond).collect::<Vec<_>>();
    assert_eq!(order(&rigid)[..10], order(&soft)[..10]);
}

/// A machine that moves in one stage while a force comes in the next ends where both together do, with the same reactions: to the rounding that
/// a platen 1e6 times as stiff as points magnifies.
#[test]
fn a_machine_keeps_what_it_did_in_an_earlier_stage() {
    let supports = "[[support]]\ngroup = \"bottom\"\ndisplacement = { x = 0.0, y = 0.0 }";
    let loads = "[[load]]\ngroup = \"top\"\ndisplacement = { y = -1e-5 }\nstiffness = 1e8\ntilts = true\n[[load]]\nname = \"side\"\n\
                 group = \"right\"\nforce = { x = 500.0 }";
    let together = solved(supports, loads).1;
    let stages = "[[stage]]\nloads = { top = 1.0 }\n[[stage]]\nloads = { side = 1.0 }";
    let bench = Bench::new(&format!("{BLOCK}\n{supports}\n{loads}\n{stages}"), &[]);
    let Bench { model, .. } = &bench;
    let loading = Loading::new(model).unwrap();
    let problem = loading.problem(model);
    let outcome = follow(&problem, &model.setup.analysis, &mut Watch::default()).unwrap();
    let largest = |values: &[f64]| values.iter().fold(0.0, |one: f64, it| one.max(it.abs()));
    let pairs = outcome
        .state
        .displacement
        .iter()
        .zip(together.displacement());
    let off: Vec<f64> = pairs.map(|(one, other)| one - other).collect();
    assert!(
        largest(&off) < 1e-6 * largest(together.displacement()),
        "{:e}",
        largest(&off)
    );
    let last = outcome.history.last().unwrap();
    for (found, known) in last.group_forces.iter().zip(&together.last().group_forces) {
        for (found, known) in found.iter().zip(known) {
            assert!((found - known).abs() < 1e-5, "{found} {known}");
        }
    }
    assert!(last.energy_error().abs() < 1e-8);
}
