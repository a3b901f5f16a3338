//! Faces of cracks that close: stiffness of pressed bars, sliding without friction, a closed crack in an infinite plate, and
//! energies over cycles. All against closed forms or the body without the crack.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use ligament_analysis::Component;
use ligament_analysis::user_message::Place;
use ligament_model::contact::ContactPair;
use ligament_model::thermal::ThermalStrain;
use verification::bench::{Bench, Run};
use verification::meshes;

/// A bar 40 x 20 mm on a lattice, which is pressed along x.
const BAR: &str = r#"
lattice = { cells = [40, 20], spacing = 0.001, corner = [0.0, 0.0], thickness = 0.01, set = { left = { left = 1 }, right = { right = 1 } } }
material = { young = 15e9, poisson = 0.21, tensile_strength = 3.81e6 }
model = { law = "nhpd", horizon_factor = 3.0, closing = true }
support = [{ group = "left", displacement = { x = 0.0, y = 0.0 } }]
load = [{ group = "right", displacement = { x = -1e-5, y = 0.0 } }]
probe = [{ name = "through", section = [[0.02, 0.03], [0.02, -0.01]], component = "x" }]
"#;

/// All through the bar, between two columns of cells.
const THROUGH: &str = "precrack=[{ points = [[0.02, -0.01], [0.02, 0.03]] }]";

/// A plate 40 x 60 mm with an edge crack, which is pulled apart and pressed together again.
const CYCLE: &str = r#"
lattice = { cells = [20, 30], spacing = 0.002, corner = [0.0, -0.03], thickness = 0.01, set = { bottom = { bottom = 2 }, top = { top = 2 } } }
material = { young = 15e9, poisson = 0.21, tensile_strength = 3.81e6 }
model = { law = "nhpd", horizon_factor = 3.0, closing = true }
precrack = [{ points = [[-0.01, 0.0], [0.0101, 0.0]] }]
support = [{ group = "bottom", displacement = { x = 0.0, y = 0.0 } }]
load = [{ group = "top", displacement = { y = 4e-5 } }]
no_fail = [{ group = "bottom" }, { group = "top" }]
fracture = { steps = [0.1, 0.3, 0.6, 1.0, 0.5, 0.0, -0.1, -0.2, 0.0, 0.5, 0.0, -0.2], criterion = [{ kind = "strength" }] }
"#;

fn stiffness(run: &Run) -> f64 {
    run.last().reaction / run.last().displacement
}

/// Pressed, the bar with a crack all through is as stiff as the bar without: across the crack pairs exert the traction of a strain
/// eps_nn alone, where the bar widens as well, so that a layer as wide as the pairs is stiffer by 1/(1 - nu^2). It is at most
/// 6 of the 40 columns wide: the bar is stiffer by no more than 6/40 nu^2 = 0.66 %. Pulled, it carries nothing: 1e-9 of the
/// stiffness is rounding. The section through the crack has the force of the ends.
#[test]
fn a_crack_all_through_carries_pressure_and_no_tension() {
    let sound = stiffness(&Bench::new(BAR, &[]).solve());
    let pressed = Bench::new(BAR, &[THROUGH]).solve();
    let ratio = stiffness(&pressed) / sound;
    println!("pressed: {ratio:.5} of the stiffness of the sound bar");
    assert!((1.0..1.0066).contains(&ratio), "{ratio}");
    let last = pressed.last();
    let through = last.probes[0];
    assert!((through / last.reaction - 1.0).abs() < 1e-9, "{through}");
    assert!(last.energy_error().abs() < 1e-10 && last.closed_pairs > 100);
    let pull = "load.0.displacement.x=1e-5";
    let pulled = Bench::new(BAR, &[THROUGH, pull]).solve();
    assert!(stiffness(&pulled).abs() < 1e-9 * sound);
    assert_eq!(pulled.last().closed_pairs, 0);
}

/// A bar of 20 x 6 x 6 cells of 1 mm, which is pressed along x.
const SOLID_BAR: &str = r#"
solid_lattice = { cells = [20, 6, 6], spacing = [0.001, 0.001, 0.001], corner = [0.0, 0.0, 0.0], set = { left = { left = 1 }, right = { right = 1 } } }
material = { young = 15e9, poisson = 0.21, tensile_strength = 3.81e6 }
model = { law = "nhpd", horizon_factor = 2.5, closing = true }
support = [{ group = "left", displacement = { x = 0.0, y = 0.0, z = 0.0 } }]
load = [{ group = "right", displacement = { x = -1e-5, y = 0.0, z = 0.0 } }]
probe = [{ name = "through", section = [[0.01, 0.003, 0.003], [0.009, 0.003, 0.003]], component = "x" }]
"#;

/// A plane all through the solid bar, between two layers of cells.
const THROUGH_SOLID: &str = "precrack=[{ points = [[0.01, -0.01, -0.01], [0.01, 0.03, -0.01], [0.01, 0.03, 0.03], [0.01, -0.01, 0.03]] }]";

/// In space as in the plane: across the crack a layer as wide as the pairs, at most 5 of the 20 layers of cells, is stiffer by
/// (1 - nu)/((1 + nu)(1 - 2 nu)) = 1.126, so that the bar is stiffer by no more than 5/20 of .126, 3.2 %. Pulled, it carries nothing, and
/// faces that slide by five times what presses them together carry no shear force but rounding.
#[test]
fn a_crack_all_through_a_solid_carries_pressure_alone() {
    let sound = stiffness(&Bench::new(SOLID_BAR, &[]).solve());
    let pressed = Bench::new(SOLID_BAR, &[THROUGH_SOLID]).solve();
    let ratio = stiffness(&pressed) / sound;
    println!("pressed: {ratio:.5} of the stiffness of the sound bar");
    assert!((1.0..1.032).contains(&ratio), "{ratio}");
    let last = pressed.last();
    let through = last.probes[0];
    assert!((through / last.reaction - 1.0).abs() < 1e-9, "{through}");
    assert!(last.energy_error().abs() < 1e-10 && last.closed_pairs > 100);
    let pulled = Bench::new(SOLID_BAR, &[THROUGH_SOLID, "load.0.displacement.x=1e-5"]).solve();
    assert!(stiffness(&pulled).abs() < 1e-9 * sound);
    assert_eq!(pulled.last().closed_pairs, 0);
    let slide = "load.0.displacement={ x = -1e-5, y = 5e-5, z = -2e-5 }";
    let force = |settings: &[&str]| {
        let bench = Bench::new(SOLID_BAR, settings);
        bench.solve().group_force(&bench, "right")
    };
    let [pressure, ..] = force(&[THROUGH_SOLID]);
    let [slid_pressure, along_y, along_z] = force(&[THROUGH_SOLID, slide]);
    let [_, sound_shear, _] = force(&[slide]);
    assert!((slid_pressure / pressure - 1.0).abs() < 1e-9);
    for shear in [along_y, along_z] {
        assert!(shear.abs() < 1e-9 * sound_shear.abs(), "{shear:e}");
    }
}

/// A solid bar that is pulled until it is in two, unloaded and pressed again is as stiff as with its crack closed from the start, to 5 %: the
/// normals of the broken bonds are estimates. Work, stored and released energy balance to 1e-8 in every step.
#[test]
fn a_solid_pulled_in_two_carries_pressure_again() {
    let notched = SOLID_BAR.replace(
        "support =",
        "precrack = [{ points = [[0.01, -0.01, -0.01], [0.01, 0.0021, -0.01], [0.01, 0.0021, 0.03], [0.01, -0.01, 0.03]] }]\nno_fail = [{ group = \"left\" }, { group = \"right\" }]\nsupport =",
    );
    let steps = "fracture={ steps = [-1.0, 0.0, 1.0], criterion = [{ kind = \"strength\" }] }";
    let pressed = "fracture={ steps = [0.1], criterion = [{ kind = \"strength\" }] }";
    let whole = stiffness(&Bench::new(&notched, &[pressed]).break_up());
    let run = Bench::new(&notched, &[steps]).break_up();
    let history = &run.outcome.history;
    assert!(history.iter().skip(1).all(|it| it.fragments == 2));
    let largest = history.iter().map(|it| it.external_work.abs());
    let largest = largest.fold(0.0, f64::max);
    let missing = history.iter().map(|it| it.missing_energy().abs());
    let missing = missing.fold(0.0, f64::max) / largest;
    assert!(missing < 1e-8, "{missing:e}");
    let [_, pulled, _, pressed] = history.as_slice() else {
        panic!("three load steps");
    };
    assert!(pulled.reaction.abs() < 1e-6 * pressed.reaction.abs());
    let ratio = pressed.reaction / pressed.displacement / whole;
    println!("pressed again: {ratio:.4} of the stiffness of the closed bar");
    assert!((ratio - 1.0).abs() < 0.05, "{ratio}");
}

/// Faces that slide by five times what presses them together: no shear force but rounding, where the sound bar has most of its load,
/// and the pressure is as without sliding. On an irregular mesh as well, where pairs lie at all angles to the crack.
#[test]
fn closed_faces_slide_without_friction() {
    const MESH: [&str; 3] = [
        "lattice=",
        "mesh={ file = \"../meshes/bimaterial.msh\", thickness = 0.01 }",
        "precrack=[{ points = [[0.0501, -0.01], [0.0501, 0.06]] }]",
    ];
    let on_mesh = BAR.replace(BAR.lines().nth(1).unwrap(), MESH[1]);
    let on_mesh: String = (on_mesh.lines().filter(|line| !line.starts_with("probe")))
        .map(|line| format!("{line}\n"))
        .collect();
    for (text, crack) in [(BAR, THROUGH), (on_mesh.as_str(), MESH[2])] {
        let slide = "load.0.displacement={ x = -1e-5, y = 5e-5 }";
        let force = |settings: &[&str]| {
            let bench = Bench::new(text, settings);
            bench.solve().group_force(&bench, "right")
        };
        let [pressure, _, _] = force(&[crack]);
        let [slid_pressure, shear, _] = force(&[crack, slide]);
        let [_, sound_shear, _] = force(&[slide]);
        assert!((slid_pressure / pressure - 1.0).abs() < 1e-9);
        assert!(sound_shear.abs() > 0.1 * pressure.abs());
        assert!(shear.abs() < 1e-9 * sound_shear.abs(), "{shear:e}");
    }
}

/// A rigid motion of positions and rotations leaves the gaps as they are, of cut bonds and of broken ones, and the moments on the ends
/// balance the forces.
#[test]
fn pairs_are_in_balance() {
    let bench = Bench::new(CYCLE, &[]);
    let system = bench.model.plane();
    let mut intact = vec![true; system.topology().ends.len()];
    for bond in (0..intact.len()).step_by(7) {
        intact[bond] = false;
    }
    let pairs: Vec<ContactPair> = system.contact_pairs(&intact);
    assert!(pairs.len() > bench.model.cut_bonds() && bench.model.cut_bonds() > 50);
    let (layout, positions) = (system.topology().layout, &system.cloud.positions);
    let motion = |[x, y]: [f64; 2]| [3.0 - 2.0 * y, -5.0 + 2.0 * x, 2.0];
    let moved: Vec<f64> = positions.iter().flat_map(|&p| motion(p)).collect();
    let mut normals_of_cut = 0;
    for pair in &pairs {
        let gap = pair.gap(&moved, ThermalStrain::NONE);
        assert!(gap.abs() < 1e-12, "{gap:e}");
        let mut moment = 0.0;
        for (dof, force) in pair.row {
            let [x, y] = positions[layout.point(dof as usize) as usize];
            moment += match layout.component(dof as usize) {
                Component::X => -y * force,
                Component::Y => x * force,
                Component::Rotation => force,
                other => unreachable!("{other:?} in the plane"),
            };
        }
        assert!(moment.abs() < 1e-15, "{moment:e}");
        let is_cut = pair.number as usize >= intact.len();
        normals_of_cut += usize::from(is_cut && pair.normal[1].abs() == 1.0);
    }
    assert_eq!(normals_of_cut, bench.model.cut_bonds());
}

/// Pairs that follow a row of breakages are those found anew after each of them, to the bit.
#[test]
fn pairs_follow_breakages() {
    let bench = Bench::new(CYCLE, &[]);
    let system = bench.model.plane();
    let mut intact = vec![true; system.topology().ends.len()];
    let mut pairs: Vec<ContactPair> = system.contact_pairs(&intact);
    for round in 0..6 {
        let all = (round..intact.len() as u32).step_by(17 + 5 * round as usize);
        let broken: Vec<u32> = all.filter(|&it| intact[it as usize]).collect();
        for &bond in &broken {
            intact[bond as usize] = false;
        }
        for (number, pair) in system.changed_pairs(&intact, &broken) {
            pairs.retain(|it| it.number != number);
            pairs.extend(pair);
        }
        pairs.sort_unstable_by_key(|it| it.number);
        assert_eq!(pairs, system.contact_pairs(&intact));
    }
}

/// Pulled until the plate is in two, unloaded, pressed, pulled and pressed again. In two parts: no tension (1e-6 of the peak: the
/// residual), and the stiffness of the plate with its edge crack closed and no bond broken, to 2 %: the normals of the broken bonds
/// are estimates. Work, stored and released energy balance to 1e-8 in every step.
#[test]
fn a_plate_pulled_in_two_carries_pressure_again() {
    let run = Bench::new(CYCLE, &[]).break_up();
    let history = &run.outcome.history;
    assert_eq!(history.len(), 13, "{}", run.outcome.termination);
    let largest = history.iter().map(|it| it.external_work.abs());
    let largest = largest.fold(0.0, f64::max);
    let missing = history.iter().map(|it| it.missing_energy().abs());
    let missing = missing.fold(0.0, f64::max) / largest;
    let peak = history.iter().map(|it| it.reaction).fold(0.0, f64::max);
    println!("energies miss {missing:.1e} of the work");
    assert!(missing < 1e-8, "{missing:e}");
    assert_eq!(history[4].fragments, 2, "the plate must be in two");
    for pulled in [4, 5, 10] {
        assert!(history[pulled].reaction.abs() < 1e-6 * peak, "{pulled}");
    }
    let whole = "fracture={ steps = [-0.1], criterion = [{ kind = \"strength\" }] }";
    let whole = stiffness(&Bench::new(CYCLE, &[whole]).break_up());
    for pressed in [7, 8, 12] {
        let ratio = history[pressed].reaction / history[pressed].displacement / whole;
        println!("pressed again, step {pressed}: {ratio:.4} of the stiffness of the closed plate");
        assert!((ratio - 1.0).abs() < 0.02, "{ratio}");
    }
}

/// Bonds that soften, on a notched bar that is pulled until 112 are broken and the others are soft, and pressed before and after. Its
/// stiffness against pressure is that of the sound bar, to 5 % (some bonds beside the crack have lost stiffness in shear); without closing
/// less than half is left. Work and energies balance to 1e-8 over both cycles.
#[test]
fn a_soft_crack_carries_pressure_again() {
    const SOFT: &str = r#"
lattice = { cells = [30, 12], spacing = 0.001, corner = [0.0, -0.006], thickness = 0.01, set = { left = { left = 1 }, right = { right = 1 } } }
material = { young = 30e9, poisson = 0.2, fracture_energy = 100.0 }
model = { law = "mppd", horizon_factor = 3.0, closing = true }
precrack = [{ points = [[0.015, -0.01], [0.015, -0.0031]] }]
support = [{ group = "left", displacement = { x = 0.0, y = 0.0 } }]
load = [{ group = "right", displacement = { x = 1e-4 } }]
fracture = { steps = [0.2, 0.4, 0.0, -0.1, 0.0, 0.6, 1.0, 0.0, -0.1], criterion = [{ kind = "bond-energy", limit = 1e-4, after = "bilinear" }] }
"#;
    let sound = "fracture.steps=[-0.01]";
    let sound = stiffness(&Bench::new(SOFT, &[sound]).break_up());
    let run = Bench::new(SOFT, &[]).break_up();
    let history = &run.outcome.history;
    assert_eq!(history.len(), 10, "{}", run.outcome.termination);
    assert!(run.last().broken_bonds > 80, "{}", run.last().broken_bonds);
    let worst = history.iter().map(|it| it.energy_error().abs());
    let worst = worst.fold(0.0, f64::max);
    let ratio = stiffness(&run) / sound;
    let open = Bench::new(SOFT, &["model.closing=false"]).break_up();
    let open = stiffness(&open) / sound;
    println!(
        "soft: {ratio:.4} of the stiffness, {open:.4} without closing; energies off by {worst:.1e}"
    );
    assert!((0.95..1.01).contains(&ratio), "{ratio}");
    assert!(open < 0.5, "{open}");
    assert!(worst < 1e-8, "{worst:e}");
}

/// A plate with a crack of 2a = 20 mm at 45 degrees, pressed along y by sigma. The crack is closed: K_I = 0, and its faces slide past
/// each other as those of an open crack in shear, by 4 tau/E sqrt(a^2 - x^2) with tau = sigma/2 (Westergaard), in the middle 4 tau a/E.
/// In a plate four times as wide the sliding is up to 8 % larger (the finite width of Isida's table at a/W = 1/4, in each mode), and the
/// crack is longer by about half a horizon at either end. Without closing the faces overlap by as much, and that is told.
#[test]
fn a_closed_crack_slides_as_in_an_infinite_plate() {
    const PLATE: &str = r#"
lattice = { cells = [80, 80], spacing = 0.001, corner = [-0.04, -0.04], thickness = 0.01, set = { bottom = { bottom = 1 }, top = { top = 1 } } }
material = { young = 15e9, poisson = 0.21, tensile_strength = 3.81e6 }
model = { law = "nhpd", horizon_factor = 3.0 }
precrack = [{ points = [[-0.0070210678, -0.0071210678], [0.0071210678, 0.0070210678]] }]
support = [{ group = "bottom", displacement = { y = 0.0 } }, { at = [-0.0005, -0.0395], displacement = { x = 0.0, y = 0.0 } }]
load = [{ group = "top", displacement = { y = -4e-5 } }]
probe = [{ name = "x", between = [[0.0005, -0.0005], [-0.0005, 0.0005]], component = "x" }, { name = "y", between = [[0.0005, -0.0005], [-0.0005, 0.0005]], component = "y" }]
"#;
    let jump = |closing: &str| {
        let bench = Bench::new(PLATE, &[closing]);
        let run = bench.solve();
        let last = run.last();
        let [x, y] = [last.probes[0], last.probes[1]];
        let stress = -last.reaction / (0.08 * 0.01);
        let open = 4.0 * 0.5 * stress.abs() * 0.01 / 15e9;
        let root = 0.5_f64.sqrt();
        // Along the crack and across it, from below to above, over what an infinite plate has.
        let ratios = [root * (x + y) / open, root * (y - x) / open];
        (ratios, run)
    };
    let ([slid, gap], closed) = jump("model.closing=true");
    println!("closed: slides {slid:.4}, opens {gap:.4} of an infinite plate's");
    assert!((1.0..1.25).contains(&slid.abs()), "{slid}");
    // What is left is the strain of the plate over the distance of the points, sigma/(2 E) times 1.4 mm.
    assert!(gap.abs() < 0.05 && closed.last().closed_pairs > 0, "{gap}");
    assert!(closed.last().energy_error().abs() < 1e-10);
    let ([slid_open, gap_open], open) = jump("model.closing=false");
    println!("open: slides {slid_open:.4}, opens {gap_open:.4}");
    assert!((slid.abs() / slid_open.abs() - 1.0).abs() < 0.05);
    assert!((-1.3..-1.0).contains(&gap_open), "{gap_open}");
    let overlap = open.outcome.overlap.unwrap();
    let told = open.messages.iter().find(|it| it.kind == "overlap");
    let told = told.unwrap();
    assert_eq!(told.place, Place::Step(overlap.step));
    assert_eq!(told.points, overlap.ends);
    let depth = format!("{:.2e}", overlap.depth);
    assert!(told.text.contains(&depth), "{told} {depth}");
    let at_middle = -(gap_open - gap) * 4.0 * 0.5 * open.last().reaction.abs() / 8e-4 * 0.01 / 15e9;
    assert!(
        (overlap.depth / at_middle - 1.0).abs() < 0.15,
        "{overlap:?}"
    );
    assert!(!closed.told("overlap"));
}

/// The exact path of a plate that is pressed while wing cracks grow from a closed crack: all is in proportion to the load between two
/// breakages, so that the first bond breaks at the load that the elastic answer foretells, and a stepped run that breaks one bond at a
/// time right above each event breaks the same bonds first. Work and energies balance to 1e-8.
#[test]
fn the_exact_path_follows_closed_faces() {
    const WINGS: &str = r#"
lattice = { cells = [30, 30], spacing = 0.002, corner = [-0.03, -0.03], thickness = 0.01, set = { bottom = { bottom = 1 }, top = { top = 1 } } }
material = { young = 15e9, poisson = 0.21, tensile_strength = 3.81e6 }
model = { law = "nhpd", horizon_factor = 3.0, closing = true }
precrack = [{ points = [[-0.0092, -0.0093], [0.0093, 0.0092]] }]
support = [{ group = "bottom", displacement = { x = 0.0, y = 0.0 } }]
load = [{ group = "top", displacement = { x = 0.0, y = -4e-4 } }]
no_fail = [{ group = "bottom" }, { group = "top" }]
fracture = { control = "event", stop = { bonds = 40 }, criterion = [{ kind = "strength" }] }
"#;
    let exact = Bench::new(WINGS, &[]).break_up();
    assert!(exact.breaks.len() >= 40, "{}", exact.outcome.termination);
    assert!(
        exact
            .outcome
            .history
            .iter()
            .all(|it| it.closed_pairs > 0 || it.step == 0)
    );
    let first = exact.outcome.first_break.unwrap().load_factor;
    assert!((exact.breaks[0].load_factor / first - 1.0).abs() < 1e-9);
    let errors = exact
        .outcome
        .history
        .iter()
        .map(|it| it.energy_error().abs());
    let worst = errors.fold(0.0, f64::max);
    println!("exact path: energies off by {worst:.1e}");
    assert!(worst < 1e-8, "{worst:e}");
    let to = exact
        .breaks
        .iter()
        .map(|it| it.load_factor)
        .fold(0.0, f64::max);
    let stepped = format!(
        "fracture={{ steps = [{}, {}], bonds_per_iteration = 1, order = \"ratio\", stop = {{ bonds = 4 }}, criterion = [{{ kind = \"strength\" }}] }}",
        0.999 * first,
        first * (1.0 + 1e-6)
    );
    let stepped = Bench::new(WINGS, &[&stepped]).break_up();
    assert_eq!(stepped.breaks[0].bond, exact.breaks[0].bond);
    assert!(to >= first);
}

/// What is told of a notch, and its mean opening in it, m.
fn told_closing(bench: &Bench) -> Option<f64> {
    let run = bench.solve();
    let told = run.messages.iter().find(|it| it.kind == "notch-closes")?;
    let from = told.text.find("by ").unwrap() + 3;
    let words = told.text[from..].split(' ').next().unwrap();
    Some(words.parse().unwrap())
}

/// A crack of 2a in an infinite plate under a pressure sigma would close by pi sigma a/E in the mean (Westergaard). In a plate four times as
/// wide it closes by up to a tenth more, and the crack is longer by about half a horizon at either end, 1.5 of 10 mm. It is told where it is
/// pressed; not where it is pulled, where its faces carry pressure, or where it lies along the load, whose bonds across it Poisson's effect
/// shortens without its faces coming nearer.
#[test]
fn a_crack_that_closes_is_told_with_its_mean_opening() {
    const PLATE: &str = r#"
lattice = { cells = [80, 80], spacing = 0.001, corner = [-0.04, -0.04], thickness = 0.01, set = { bottom = { bottom = 1 }, top = { top = 1 } } }
material = { young = 15e9, poisson = 0.21, tensile_strength = 3.81e6 }
model = { law = "nhpd", horizon_factor = 3.0 }
precrack = [{ points = [[-0.01, 0.0], [0.01, 0.0]] }]
support = [{ group = "bottom", displacement = { y = 0.0 } }, { at = [-0.0005, -0.0395], displacement = { x = 0.0, y = 0.0 } }]
load = [{ group = "top", displacement = { y = -4e-5 } }]
fracture = { steps = 1, criterion = [{ kind = "strength" }] }
"#;
    let bench = Bench::new(PLATE, &[]);
    let closed = told_closing(&bench).unwrap();
    let stress = -bench.solve().last().reaction / (0.08 * 0.01);
    let ratio = closed / (std::f64::consts::PI * stress.abs() * 0.01 / 15e9);
    println!("closes by {closed:.3e} m, {ratio:.3} of an infinite plate's");
    assert!((1.0..1.25).contains(&ratio), "{ratio}");
    let along = "precrack=[{ points = [[0.0, -0.01], [0.0, 0.01]] }]";
    for setting in ["load.0.displacement.y=4e-5", "model.closing=true", along] {
        assert_eq!(
            told_closing(&Bench::new(PLATE, &[setting])),
            None,
            "{setting}"
        );
    }
    let pulled = Bench::new(PLATE, &[along, "load.0.displacement.y=4e-5"]);
    assert_eq!(told_closing(&pulled), None);
}

/// A notch of the mesh is told as a crack is, and a hole, which has no faces, is not.
#[test]
fn a_notch_of_the_mesh_that_closes_is_told() {
    const PLATE: &str = r#"
mesh = { file = "plate.msh", thickness = 0.01, plane = "stress" }
material = { young = 15e9, poisson = 0.21, tensile_strength = 3.81e6 }
model = { law = "nhpd", horizon_factor = 3.0 }
support = [{ group = "bottom", displacement = { x = 0.0, y = 0.0 } }]
load = [{ group = "top", displacement = { y = -4e-5 } }]
fracture = { steps = 1, criterion = [{ kind = "strength" }] }
"#;
    const PULLED: &str = "load.0.displacement.y=4e-5";
    let without = |is_void: &dyn Fn(usize, usize) -> bool| {
        let mut mesh = meshes::lattice(41, 0.001, [0.0, -0.0205]);
        let cells = std::mem::take(&mut mesh.cells).into_iter().enumerate();
        let kept = cells.filter(|(cell, _)| !is_void(cell % 41, cell / 41));
        mesh.cells = kept.map(|(_, cell)| cell).collect();
        mesh
    };
    let notched = without(&|column, row| row == 20 && column < 15);
    assert!(told_closing(&Bench::on(&notched, PLATE, &[])).unwrap() > 0.0);
    assert_eq!(told_closing(&Bench::on(&notched, PLATE, &[PULLED])), None);
    let holed = without(&|column, row| column.abs_diff(20).pow(2) + row.abs_diff(20).pow(2) < 30);
    for settings in [&[][..], &[PULLED]] {
        assert_eq!(told_closing(&Bench::on(&holed, PLATE, settings)), None);
    }
}
