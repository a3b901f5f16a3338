//! Rigid bodies with a mass in implicit steps, against closed forms, balances and explicit steps.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use ligament::run::Posed;
use ligament::{Loading, Model};
use ligament_analysis::history::StepRecord;
use verification::bench::{case, solved};
use verification::recorder::checkpoints_of_the_same_bits;

/// A light column of 4 x 20 cells of 1 mm, on which a wall of 0.1 kg falls at 1 m/s.
const COLUMN: &str = r#"
lattice = { cells = [4, 20], spacing = 0.001, corner = [0.0, 0.0], thickness = 0.01, set = { bottom = { bottom = 1 } } }
material = { young = 15e9, poisson = 0.0, density = 1.0 }
model = { law = "nhpd", horizon_factor = 3.0 }
support = [{ group = "bottom", displacement = { x = 0.0, y = 0.0 } }]
rigid = [{ name = "hammer", shape = "wall", centre = [0.0, 0.02], normal = [0.0, -1.0], mass = 0.1, velocity = { y = -1.0 } }]
motion = { duration = 240e-6, rows = 240, scheme = "implicit", step = 1e-6 }
"#;

/// Stiffness of the column and its contact against the wall, by its way under a load, N/m.
fn stiffness() -> f64 {
    const PRESSED: [&str; 4] = [
        "-motion",
        "-rigid.0.mass",
        "-rigid.0.velocity",
        "rigid.0.displacement.y=-1e-5",
    ];
    let solution = solved(COLUMN, &PRESSED);
    let row = solution.outcome.history.last().unwrap();
    -row.contacts[0].normal_force[1] / 1e-5
}

/// Velocity of the first rigid body along y in a row, m/s.
fn velocity(row: &StepRecord) -> f64 {
    row.rigid_bodies[0].velocity[1]
}

/// On a column without mass a mass M swings for half a period: v = -v_0 cos(omega t) with omega = sqrt(k/M) and the stiffness k of the column
/// against a static load, up to the time pi/omega, and returns at v_0. To 5e-4 (measured 5e-5): the trapezoidal rule lengthens periods by
/// (omega dt)^2/12 = 3e-5, and the column has 1e-5 of the mass, whose waves take some of its energy. Momentum and energies balance to the residual.
#[test]
fn a_mass_bounces_off_a_column_after_half_a_period() {
    let frequency = (stiffness() / 0.1).sqrt();
    let half = std::f64::consts::PI / frequency;
    let outcome = solved(COLUMN, &[]).outcome;
    let (mut worst, mut impulse, mut error) = (0.0_f64, 0.0, 0.0_f64);
    for pair in outcome.history.windows(2) {
        let [before, now] = [&pair[0], &pair[1]];
        let time = now.load_factor;
        let expected = -(frequency * time.min(half)).cos();
        worst = worst.max((velocity(now) - expected).abs());
        impulse += 0.5e-6 * (before.rigid_bodies[0].force[1] + now.rigid_bodies[0].force[1]);
        error = error.max(now.energy_error().abs());
        let gained = 0.1 * (velocity(now) - velocity(&outcome.history[0]));
        assert!((impulse - gained).abs() < 1e-9, "{impulse} {gained}");
    }
    println!("half a period of {half:.4e} s, velocity off by {worst:.1e}, energies by {error:.1e}");
    assert!(half > 1.5e-4 && half < 2.2e-4);
    assert!(worst < 5e-4);
    assert!(error < 1e-9);
    assert_eq!(outcome.history.last().unwrap().contacts[0].area, 0.0);
}

/// A mass that begins 5 um above the column falls freely until it meets it: q = -g t^2/2 for the constant acceleration g, exact by the
/// trapezoidal rule to rounding. With the dissipation of the scheme what it takes is counted as damping, and the ledger closes as well.
#[test]
fn a_mass_falls_freely_before_it_meets_the_column() {
    let above = [
        "rigid.0.centre=[0.0,0.020005]",
        "-rigid.0.velocity",
        "rigid.0.acceleration.y=-1e4",
    ];
    for dissipation in ["0.0", "0.1"] {
        let dissipation = format!("motion.dissipation={dissipation}");
        let settings = [&above[..], &[&*dissipation]].concat();
        let outcome = solved(COLUMN, &settings).outcome;
        let mut error = 0.0_f64;
        for row in &outcome.history {
            let time = row.load_factor;
            let way = -0.5 * 1e4 * time * time;
            if way > -5e-6 {
                let off = row.rigid_bodies[0].displacement[1] - way;
                assert!(off.abs() < 1e-15, "{off}");
            }
            error = error.max(row.energy_error().abs());
        }
        println!("{dissipation}: energies miss {error:.1e}");
        assert!(error < 1e-9);
        assert!(
            outcome
                .history
                .iter()
                .any(|it| it.contacts[0].pressing > 0.0)
        );
    }
}

/// A sphere of a gram that hits a block of a solid obliquely, with friction.
const SPHERE: &str = r#"
solid_lattice = { cells = [6, 6, 3], spacing = [0.001, 0.001, 0.001], corner = [0.0, 0.0, 0.0] }
material = { young = 70e9, poisson = 0.2, density = 2700.0 }
model = { law = "nhpd", horizon_factor = 2.5 }
rigid = [{ name = "sphere", shape = "sphere", centre = [0.0025, 0.003, 0.0080], radius = 0.005, mass = 1e-3, velocity = { x = 2.0, y = 0.5, z = -3.0 }, friction = 0.3 }]
motion = { duration = 6e-6, rows = 12 }
"#;

/// A sphere in implicit steps goes as in explicit ones: after 6 us of contact its velocity along each axis is the same to 0.1 % of its change
/// (measured 0.02 %), which the steps of a tenth of a microsecond leave of the waves in the block. The energies balance to the residual.
#[test]
fn implicit_steps_follow_explicit_ones() {
    let last = |settings: &[&str]| {
        let outcome = solved(SPHERE, settings).outcome;
        let error = outcome.history.iter().map(|it| it.energy_error().abs());
        let error = error.fold(0.0, f64::max);
        let friction = outcome
            .history
            .last()
            .unwrap()
            .motion
            .unwrap()
            .friction_energy;
        println!("energies miss {error:.1e}, friction takes {friction:.3e} J");
        assert!(error < 1e-9 && friction > 0.0);
        outcome.history.last().unwrap().rigid_bodies[0]
    };
    let explicit = last(&[]);
    let implicit = last(&["motion.scheme=implicit", "motion.step=1e-7"]);
    let first = [2.0, 0.5, -3.0];
    for axis in 0..3 {
        let [one, other] = [explicit, implicit].map(|it| it.velocity[axis] - first[axis]);
        println!("axis {axis}: changed by {one:.5} and {other:.5} m/s");
        assert!((one - other).abs() < 1e-3 * (explicit.velocity[2] - first[2]).abs());
    }
}

/// Motions of rigid bodies in implicit steps have the same bits on one and two threads, and go on from a checkpoint to the same bits.
#[test]
fn rigid_bodies_go_on_to_the_same_bits() {
    let setup = case(SPHERE, &["motion.scheme=implicit", "motion.step=5e-7"]);
    let setup = setup.setup(&mut ()).unwrap();
    let model = Model::build(setup, &mut ()).unwrap();
    let loading = Loading::new(&model).unwrap();
    let problem = loading.motion(&loading.problem(&model)).unwrap();
    let analysis = &model.setup.analysis;
    let posed = Posed::Motion(&problem);
    assert!(checkpoints_of_the_same_bits("sphere", posed, analysis, 5) > 10);
}
