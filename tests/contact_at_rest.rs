//! Contact between surfaces and with rigid bodies in equilibria, against closed forms.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use std::f64::consts::PI;

use crate::contact_on_exact_path::CIRCLE;
use ligament::run::Posed;
use ligament::{Loading, Model};
use ligament_analysis::driver::Outcome;
use ligament_analysis::history::Termination;
use ligament_model::surface::Touch;
use ligament_model::tensor::{cross, minus, norm};
use verification::bench::{case, missing_energy, solved};
use verification::recorder::checkpoints_of_the_same_bits;

/// A block of 20 x 10 cells of 1 mm on a rigid floor with friction; loads press and slide its top.
const BLOCK: &str = r#"
lattice = { cells = [20, 10], spacing = 0.001, corner = [0.0, 0.0], thickness = 0.01, set = { bottom = { bottom = 1 }, top = { top = 1 } } }
material = { young = 15e9, poisson = 0.21, tensile_strength = 3.81e6 }
model = { law = "nhpd", horizon_factor = 3.0 }
rigid = [{ name = "floor", shape = "wall", centre = [0.0, 0.0], normal = [0.0, 1.0], friction = 0.3 }]
no_fail = [{ group = "bottom" }, { group = "top" }]
fracture = { criterion = [{ kind = "tension", limit = 1.0 }] }
"#;

/// Pressed by 1 kN, then slid by a force that grows to 400 N in steps of 10 N.
const BY_FORCES: &str = r#"
load = [{ name = "press", group = "top", force = { y = -1e3 } }, { name = "slide", group = "top", force = { x = 4e2 } }]
stage = [{ name = "press", loads = { press = 1.0 }, steps = 1 }, { name = "slide", loads = { slide = 1.0 }, steps = 40 }]
"#;

/// Pressed, then slid to and fro by 100 um.
const BY_DISPLACEMENTS: &str = r#"
load = [{ name = "press", group = "top", displacement = { y = -1e-5 } }, { name = "slide", group = "top", displacement = { x = 1e-4 } }]
stage = [{ name = "press", loads = { press = 1.0 }, steps = 1 }, { name = "slide", loads = { slide = [1.0, -1.0] }, steps = 20 }]
"#;

/// Contacts that press in the last equilibrium.
fn pressed(outcome: &Outcome) -> Vec<Touch> {
    let all = outcome.state.surfaces.touching().touches();
    all.filter(|it| it.depth() > 0.0).copied().collect()
}

/// A block that nothing but a floor with friction holds is in equilibrium as long as the shear force is below mu times the pressing one, and
/// slides beyond: within a step of 1 % of the pressing force. The floor carries the load to the residual.
#[test]
fn a_block_slides_off_where_the_force_exceeds_its_friction() {
    let outcome = solved(&format!("{BLOCK}{BY_FORCES}"), &[]).outcome;
    let miss = missing_energy(&outcome);
    println!(
        "{} rows, {}, energies miss {miss:.1e}",
        outcome.history.len(),
        outcome.termination
    );
    assert!(matches!(
        outcome.termination,
        Termination::NoEquilibrium { .. }
    ));
    // The unloaded body, the pressed one, and steps of 10 N up to 300 N, or 290 N: the last one is on the limit.
    assert!((31..=32).contains(&outcome.history.len()));
    assert!(miss < 1e-9, "{miss:e}");
}

/// Slid by 100 um a block has mu times the pressing force as its shear force (1e-8), both ways. Its floor presses with the depth of the overlap:
/// E'/h times it, over the area of the integration points, is the pressing force.
#[test]
fn a_block_that_is_moved_slides_with_mu_times_the_pressure() {
    let outcome = solved(&format!("{BLOCK}{BY_DISPLACEMENTS}"), &[]).outcome;
    for (row, sign) in [(11, 1.0), (21, -1.0)] {
        let Some(record) = outcome.history.get(row) else {
            panic!("{}", outcome.termination);
        };
        // The groups have the same points: each has the reaction to what it prescribes.
        let [press, slide] = [0, 1].map(|group| &record.group_forces[group]);
        let ratio = -sign * slide[0] / press[1];
        println!("row {row}: shear over pressure {ratio:.10}");
        assert!((ratio / 0.3 - 1.0).abs() < 1e-8, "{ratio}");
    }
    let modulus = 15e9 / (1.0 - 0.21_f64.powi(2));
    let by_depth = |it: &Touch| modulus / 1e-3 * it.depth() * it.area;
    let floor: f64 = pressed(&outcome).iter().map(by_depth).sum();
    let pressing = -outcome.history.last().unwrap().group_forces[0][1];
    assert!((floor / pressing - 1.0).abs() < 1e-8, "{floor} {pressing}");
    assert!(missing_energy(&outcome) < 1e-9);
}

/// Two blocks that are pressed together over a gap transmit the load through all their facets alike: with a Poisson's ratio of zero the pressure
/// is uniform but for the ends of the surfaces, where points have fewer bonds (21 %). The force across is the reaction to the residual.
#[test]
fn two_blocks_transmit_a_uniform_pressure() {
    const BLOCKS: &str = r#"
lattice = { cells = [16, 17], spacing = 0.001, corner = [0.0, 0.0], thickness = 0.01, set = { bottom = { bottom = 1 }, top = { top = 1 } }, remove = [{ rectangle = [[-1.0, 0.008], [1.0, 0.009]] }] }
material = { young = 15e9, poisson = 0.0 }
model = { law = "nhpd", horizon_factor = 3.0 }
support = [{ group = "bottom", displacement = { x = 0.0, y = 0.0 } }]
contact = [{ friction = 0.2 }]
load = [{ group = "top", displacement = { x = 0.0, y = -1.01e-3 } }]
"#;
    let outcome = solved(BLOCKS, &[]).outcome;
    let last = outcome.history.last().unwrap();
    let all = pressed(&outcome);
    let total: f64 = all.iter().map(|it| it.stiffness * it.depth()).sum();
    let sign = |it: &Touch| if it.is_first { -1.0 } else { 1.0 };
    let across: f64 = all.iter().map(|it| sign(it) * it.force()[1]).sum();
    println!("{across} N of {} N, {total} N in all", last.reaction);
    assert!((across / last.reaction - 1.0).abs() < 1e-8, "{across}");
    let mean = total / all.iter().map(|it| it.area).sum::<f64>();
    let off = all
        .iter()
        .map(|it| (it.stiffness * it.depth() / it.area / mean - 1.0).abs());
    let worst = off.fold(0.0, f64::max);
    println!(
        "{} places press, pressure off by {worst:.4} at most",
        all.len()
    );
    assert_eq!(all.len(), 64);
    assert!(worst < 0.25, "{worst}");
    assert!(missing_energy(&outcome) < 1e-9);
}

/// A rigid cylinder on a block, 16 facets wide in contact (Johnson 1985, section 4.2): p_0 = sqrt(P E/(pi R)) in plane stress for the load P over
/// the thickness, and the pressure p_0 sqrt(1 - x^2/b^2) with b = 2 P/(pi p_0). The pressure in the middle to 3 %, the width to a facet.
#[test]
fn a_cylinder_presses_as_hertz_says() {
    const HERTZ: &str = r#"
lattice = { cells = [120, 60], spacing = 0.0005, corner = [-0.03, 0.0], thickness = 0.01, set = { bottom = { bottom = 1 } } }
material = { young = 70e9, poisson = 0.3 }
model = { law = "nhpd", horizon_factor = 3.0 }
support = [{ group = "bottom", displacement = { x = 0.0, y = 0.0 } }]
rigid = [{ name = "punch", shape = "circle", centre = [0.0, 0.13], radius = 0.1, displacement = { y = -2e-4 } }]
"#;
    let outcome = solved(HERTZ, &[]).outcome;
    let all = pressed(&outcome);
    let load: f64 = all.iter().map(|it| it.stiffness * it.depth()).sum::<f64>() / 0.01;
    let largest = (load * 70e9 / (PI * 0.1)).sqrt();
    let half_width = 2.0 * load / (PI * largest);
    let found = all.iter().map(|it| it.stiffness * it.depth() / it.area);
    let found = found.fold(0.0, f64::max);
    let width = 0.5 * all.iter().map(|it| it.area).sum::<f64>() / 0.01;
    println!(
        "half-width {width:.3e} m of {half_width:.3e}, largest pressure {:.4} of Hertz's",
        found / largest
    );
    assert!((found / largest - 1.0).abs() < 0.03);
    assert!((width - half_width).abs() < 0.5e-3);
    let last = outcome.history.last().unwrap();
    let support = last.group_forces[0][1];
    let down: f64 = all.iter().map(|it| -it.force()[1]).sum();
    assert!((support / down - 1.0).abs() < 1e-8, "{support} {down}");
    // The curve is that of the cylinder.
    assert_eq!(last.displacement, 2e-4);
    assert!((last.reaction / down - 1.0).abs() < 1e-12);
    assert!(missing_energy(&outcome) < 1e-9);
}

/// A rigid sphere on a block of a solid (Johnson 1985, section 4.2): the load P is 4 E* a^3/(3 R) with E* = E/(1 - nu^2) and the radius a of the
/// contact. Its area to 10 %: it is made of places of half a facet.
#[test]
fn a_sphere_presses_as_hertz_says() {
    const HERTZ: &str = r#"
solid_lattice = { cells = [24, 24, 12], spacing = [0.001, 0.001, 0.001], corner = [-0.012, -0.012, 0.0], set = { bottom = { bottom = 1 } } }
material = { young = 70e9, poisson = 0.25 }
model = { law = "bbpd", horizon_factor = 2.5 }
support = [{ group = "bottom", displacement = { x = 0.0, y = 0.0, z = 0.0 } }]
rigid = [{ name = "punch", shape = "sphere", centre = [0.0, 0.0, 0.112], radius = 0.1, displacement = { z = -2e-4 } }]
"#;
    let outcome = solved(HERTZ, &[]).outcome;
    let all = pressed(&outcome);
    let load: f64 = all.iter().map(|it| it.stiffness * it.depth()).sum();
    let area: f64 = all.iter().map(|it| it.area).sum();
    let modulus = 70e9 / (1.0 - 0.25_f64.powi(2));
    let radius = (0.75 * load * 0.1 / modulus).cbrt();
    let ratio = area / (PI * radius * radius);
    println!(
        "load {load:.4e} N, area {ratio:.4} of Hertz's, {} places",
        all.len()
    );
    assert!((ratio - 1.0).abs() < 0.1, "{ratio}");
}

/// Runs with contact of surfaces, rigid bodies and friction, with friction on the faces of cracks, and with contact along the exact path, have the
/// same bits on one and two threads, and go on from a checkpoint to the same bits.
#[test]
fn contact_goes_on_to_the_same_bits() {
    let block = format!("{BLOCK}{BY_DISPLACEMENTS}");
    let faces = format!(
        "{BLOCK}{BY_DISPLACEMENTS}support = [{{ group = \"bottom\", displacement = {{ x = 0.0, y = 0.0 }} }}]\n"
    );
    let cut = [
        "rigid=[]",
        "model={ law = \"nhpd\", horizon_factor = 3.0, closing = true, closing_friction = 0.3 }",
        "precrack=[{ points = [[-0.01, 0.005], [0.03, 0.005]] }]",
    ];
    let path = CIRCLE.to_owned();
    for (name, text, settings) in [
        ("surfaces", block, &[][..]),
        ("faces", faces, &cut),
        ("exact path", path, &["fracture.stop.bonds=24"]),
    ] {
        let setup = case(&text, settings).setup(&mut ()).unwrap();
        let model = Model::build(setup, &mut ()).unwrap();
        let problem = Loading::new(&model).unwrap().problem(&model);
        let analysis = &model.setup.analysis;
        let posed = Posed::Statics(&problem);
        let moments = checkpoints_of_the_same_bits(name, posed, analysis, 9);
        println!("{name}: {moments} moments");
        assert!(moments > 20);
    }
}

/// Surfaces by which rigid bodies are drawn have the areas of their shapes: a circle and a sphere those of polygons of 96 corners, smaller by
/// 2 pi^2/(3 96^2) = 7e-4 and by less than 5e-3; a wall lies behind its surface, beside the body.
#[test]
fn rigid_bodies_have_surfaces_of_their_shapes() {
    const SOLID: &str = r#"
solid_lattice = { cells = [5, 5, 5], spacing = [0.001, 0.001, 0.001], corner = [0.0, 0.0, 0.0], set = { bottom = { bottom = 1 } } }
material = { young = 70e9, poisson = 0.25 }
model = { law = "bbpd", horizon_factor = 2.5 }
support = [{ group = "bottom", displacement = { x = 0.0, y = 0.0, z = 0.0 } }]
rigid = [
    { name = "ball", shape = "sphere", centre = [0.0025, 0.0025, 0.011], radius = 0.003, displacement = { z = -1e-3 } },
    { name = "block", shape = "box", centre = [0.02, 0.0, 0.0], size = [0.01, 0.02, 0.03] },
]
"#;
    let surfaces = |text: &str| {
        let setup = case(text, &[]).setup(&mut ()).unwrap();
        let model = Model::build(setup, &mut ()).unwrap();
        let contact = ligament::loading::contact_problem(&model).unwrap();
        contact
            .rigid_bodies
            .into_iter()
            .map(|it| (it.gap, it.surface))
            .collect::<Vec<_>>()
    };
    let area = |surface: &ligament_analysis::contact::RigidSurface| {
        let triangle = |corners: &[u32; 3]| {
            let [a, b, c] = corners.map(|it| surface.places[it as usize]);
            0.5 * norm(cross(minus(b, a), minus(c, a)))
        };
        surface.triangles.iter().map(triangle).sum::<f64>()
    };
    let [(gap, punch)] = &surfaces(CIRCLE)[..] else {
        panic!("one body");
    };
    // The lattice is 16 mm high, and cells of points meet the circle.
    assert!((0.0..1e-5).contains(gap), "{gap}");
    let share = area(punch) / (PI * 0.01);
    assert!(share < 1.0 && share > 1.0 - 1e-3, "{share}");
    let solid = surfaces(SOLID);
    assert!((solid[0].0 - 0.003).abs() < 1e-12, "{}", solid[0].0);
    let share = area(&solid[0].1) / (4.0 * PI * 9e-6);
    assert!(share < 1.0 && share > 1.0 - 5e-3, "{share}");
    assert!((area(&solid[1].1) / 2.2e-3 - 1.0).abs() < 1e-12);
    let [(_, floor)] = &surfaces(&format!("{BLOCK}{BY_FORCES}"))[..] else {
        panic!("one body");
    };
    let heights = floor.places.iter().map(|it| it[1]);
    let [low, high] = [
        heights.clone().fold(0.0, f64::min),
        heights.fold(-1.0, f64::max),
    ];
    assert!(
        high.abs() < 1e-15 && (-1e-3..0.0).contains(&low),
        "{low} {high}"
    );
}
