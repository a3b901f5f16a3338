//! Motions in time: `analysis = "motion"`, loads that depend on time, initial velocities and quiet edges, and what is refused.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

mod contact;
mod refusals;

use std::fs;
use std::path::Path;

use ligament::setup::{Action, Analysis as Kind, Place};
use ligament::{Loading, Model};
use ligament_analysis::motion::{MotionProblem, MotionSettings, Scheme};
use ligament_analysis::{Amplitude, Component, Shape};
use ligament_case::case::{Analysis, CaseFile};
use tempfile::TempDir;

use refusals::REFUSED;

/// A bar of 20 by 4 points, 0.5 mm apart and 2 mm thick.
const BAR: &str = r#"
title = "Bar"
[lattice]
cells = [20, 4]
spacing = 5e-4
thickness = 2e-3
[lattice.set]
left = { left = 1 }
right = { right = 1 }
[material]
young = 210e9
poisson = 0.25
density = 7850.0
[model]
law = "nhpd"
horizon_factor = 3.0
[motion]
duration = 1e-5
[[load]]
group = "left"
velocity = { x = 2.0 }
amplitude = { shape = "sine", duration = 1e-6 }
"#;

fn read_at(path: &Path, text: &str, settings: &[&str]) -> Result<CaseFile, String> {
    let settings: Vec<String> = settings.iter().map(|&given| given.to_owned()).collect();
    CaseFile::parse(path, text.to_owned(), &settings).map_err(|error| error.to_string())
}

fn read(text: &str, settings: &[&str]) -> Result<CaseFile, String> {
    read_at(Path::new("case.toml"), text, settings)
}

fn motion(text: &str, settings: &[&str]) -> Result<MotionProblem, String> {
    let case = read(text, settings)?;
    let setup = case.setup(&mut ()).map_err(|it| it.to_string())?;
    let model = Model::build(setup, &mut ()).map_err(|it| case.error_at_key(it).to_string())?;
    let loading = Loading::new(&model).map_err(|it| case.error_at_key(it).to_string())?;
    let problem = loading.problem(&model);
    Ok(loading.motion(&problem).unwrap())
}

#[test]
fn a_motion_has_defaults() {
    let case = read(BAR, &[]).unwrap();
    assert_eq!(case.case.analysis, Some(Analysis::Motion));
    let setup = case.setup(&mut ()).unwrap();
    let Kind::Motion(settings) = setup.analysis else {
        panic!("another analysis");
    };
    assert_eq!(settings, MotionSettings::new(1e-5));
    assert_eq!(settings.scheme, Scheme::Explicit);
    assert_eq!(
        (settings.rows, settings.safety, settings.step),
        (200, 0.8, None)
    );
    let amplitude = setup.loads[0].amplitude.clone();
    let sine = Amplitude::pulse(Shape::Sine { periods: 1 }, 0.0, 1e-6);
    assert_eq!(amplitude, Some(sine));
    assert!(matches!(setup.loads[0].action, Action::Velocity(it) if it.x == Some(2.0)));
}

#[test]
fn all_settings_reach_the_setup() {
    let settings = [
        "motion.rows=50",
        "motion.scheme=explicit",
        "motion.step=1e-9",
        "motion.safety=0.5",
        "motion.rotary_inertia=2.0",
        "motion.damping={mass=3.0,stiffness=4e-9}",
        "motion.stop={bonds=7,wall_time=60.0}",
        "quiet=[{group=\"right\"}]",
        "initial_velocity=[{velocity={x=1.0}},{at=[0.0,0.0],velocity={y=2.0}}]",
        "fracture.criterion=[{kind=\"tension\",limit=1e-3}]",
    ];
    let case = read(BAR, &settings).unwrap();
    let again = read(&case.resolved_toml().unwrap(), &[]).unwrap();
    for case in [case, again] {
        let setup = case.setup(&mut ()).unwrap();
        let Kind::Motion(found) = &setup.analysis else {
            panic!("another analysis");
        };
        assert_eq!(found.scheme, Scheme::Explicit);
        assert_eq!((found.rows, found.rotary_inertia), (50, 2.0));
        assert_eq!((found.step, found.safety), (Some(1e-9), 0.5));
        assert_eq!((found.damping.mass, found.damping.stiffness), (3.0, 4e-9));
        assert_eq!(
            (found.stop.bonds, found.stop.wall_time),
            (Some(7), Some(60.0))
        );
        assert_eq!(setup.quiet[0].group, "right");
        let velocities: Vec<_> = setup.initial_velocities.iter().collect();
        assert_eq!(velocities[0].place, Place::Everywhere);
        assert_eq!(velocities[1].velocity, [0.0, 2.0, 0.0]);
        assert_eq!(setup.criteria.len(), 1);
    }
}

/// The sum of the masses is rho times the volume; the left end follows the integral of the pulse, T/(2 pi) (1 - cos(2 pi t/T)), times 2 m/s.
#[test]
fn a_case_becomes_a_problem_of_motion() {
    let settings = ["initial_velocity=[{velocity={x=1.0}},{group=\"right\",velocity={y=2.0}}]"];
    let problem = motion(BAR, &settings).unwrap();
    let mass: f64 = problem.mass.mass.iter().sum();
    let expected = 7850.0 * 0.01 * 0.002 * 0.002;
    assert!((mass / expected - 1.0).abs() < 1e-13, "{mass}");
    let layout = problem.problem.system.layout;
    let loads = &problem.problem.loads;
    let mut displacement = vec![0.0; layout.n_degrees_of_freedom()];
    let time = 0.3e-6;
    loads.prescribe(time, &mut displacement);
    let turn = std::f64::consts::TAU;
    let moved = 2.0 * 1e-6 / turn * (1.0 - (turn * time / 1e-6).cos());
    let found = loads.control_displacement(time, &displacement);
    assert!((found / moved - 1.0).abs() < 1e-12, "{found} {moved}");
    let held = |component| {
        let dof = layout.degree_of_freedom(0, component).unwrap();
        loads.is_prescribed(dof)
    };
    assert!(held(Component::X) && !held(Component::Y));
    let velocity = |point, component| {
        let dof = layout.degree_of_freedom(point, component).unwrap();
        problem.initial_velocity[dof]
    };
    assert_eq!(velocity(5, Component::X), 1.0);
    let rightmost = (0..layout.n_points as u32).filter(|&it| velocity(it, Component::Y) == 2.0);
    assert_eq!(rightmost.clone().count(), 4);
    assert!(
        rightmost
            .into_iter()
            .all(|it| velocity(it, Component::X) == 0.0)
    );
}

/// On an edge of length h t across x the damping is h t rho c_P along x and h t rho c_S along y, in plane stress with
/// rho c_P^2 = E/(1 - nu^2) and rho c_S^2 = E/(2 (1 + nu)).
#[test]
fn quiet_edges_have_the_impedance_of_the_material() {
    let problem = motion(BAR, &["quiet=[{group=\"right\"}]"]).unwrap();
    assert_eq!(problem.dashpots.len(), 4);
    let impedance = |modulus: f64| (modulus * 7850.0).sqrt() * 5e-4 * 2e-3;
    let normal = impedance(210e9 / (1.0 - 0.0625));
    let shear = impedance(210e9 / 2.5);
    for dashpot in &*problem.dashpots {
        let [xx, xy, yy] = [(0, 0), (0, 1), (1, 1)].map(|place| dashpot.damping[place]);
        assert!((xx / normal - 1.0).abs() < 1e-12, "{xx} {normal}");
        assert!((yy / shear - 1.0).abs() < 1e-12, "{yy} {shear}");
        assert!(xy.abs() < 1e-12 * shear, "{xy}");
    }
}

/// Nothing need hold or load a body that flies.
#[test]
fn a_free_body_may_fly() {
    let settings = ["-load", "initial_velocity=[{velocity={x=1.0}}]"];
    let problem = motion(BAR, &settings).unwrap();
    assert!(problem.problem.loads.groups().is_empty());
    assert!(problem.prescribed().is_empty());
}

#[test]
fn bonds_break_in_a_motion_only_by_given_criteria() {
    let whole = motion(BAR, &[]).unwrap();
    let breaking = motion(BAR, &["fracture.criterion=[{kind=\"tension\",limit=1e-3}]"]);
    let n_criteria = |it: &MotionProblem| it.problem.criteria.list.len();
    assert_eq!((n_criteria(&whole), n_criteria(&breaking.unwrap())), (0, 1));
}

fn amplitude_in(folder: &TempDir, table: &str) -> Result<Amplitude, String> {
    fs::write(folder.path().join("pulse.csv"), table).unwrap();
    let case = read_at(
        &folder.path().join("case.toml"),
        BAR,
        &["load.0.amplitude={file=\"pulse.csv\"}"],
    )?;
    let setup = case.setup(&mut ()).map_err(|it| it.to_string())?;
    Ok(setup.loads[0].amplitude.clone().unwrap())
}

#[test]
fn amplitudes_are_points_tables_and_shapes() {
    let amplitude = |text: &str| {
        let setting = format!("load.0.amplitude={text}");
        let setup = read(BAR, &[&setting]).unwrap().setup(&mut ()).unwrap();
        setup.loads[0].amplitude.clone().unwrap()
    };
    let points = Amplitude::through(&[[0.0, 0.0], [1e-6, 1.0], [3e-6, -1.0]]);
    assert_eq!(amplitude("{points=[[0,0],[1e-6,1],[3e-6,-1]]}"), points);
    let folder = tempfile::tempdir().unwrap();
    let table = "# a pulse\ntime,factor\n0,0\n1e-6,1\n3e-6,-1\n";
    assert_eq!(amplitude_in(&folder, table).unwrap(), points);
    for (word, shape) in [
        ("half-sine", Shape::HalfSine),
        ("triangle", Shape::Triangle),
        ("rectangle", Shape::Rectangle),
        ("ramp", Shape::Ramp),
        ("smooth-ramp", Shape::SmoothRamp),
    ] {
        let text = format!("{{shape=\"{word}\",start=1e-6,duration=2e-6}}");
        assert_eq!(amplitude(&text), Amplitude::pulse(shape, 1e-6, 2e-6));
    }
    let sine = Amplitude::pulse(Shape::Sine { periods: 3 }, 0.0, 2e-6);
    assert_eq!(amplitude("{shape=\"sine\",periods=3,duration=2e-6}"), sine);
    let ricker = Amplitude::ricker(2e-6, 1e6);
    assert_eq!(
        amplitude("{shape=\"ricker\",peak_time=2e-6,frequency=1e6}"),
        ricker
    );
}

#[test]
fn tables_of_amplitudes_are_checked_row_by_row() {
    let folder = tempfile::tempdir().unwrap();
    for (table, expected) in [
        (
            "time,factor\n0,0\n1,1\n1,2\n",
            "pulse.csv:4: the time 1.0 s is not later than that of the row before, 1.0 s",
        ),
        (
            "time,factor\n2,0\n1,1\n",
            "pulse.csv:3: the time 1.0 s is not later",
        ),
        (
            "t,factor\n0,0\n",
            "pulse.csv:1: there is no column `time`: the first row must name the columns `time` (s) and `factor`",
        ),
        (
            "time,factor\n",
            "pulse.csv:1: there is no row below the header",
        ),
        ("time,factor\n0,x\n", "pulse.csv:2: `x` is no number"),
    ] {
        let found = amplitude_in(&folder, table).unwrap_err();
        assert!(found.contains("load.0.amplitude.file: "), "{found}");
        assert!(found.contains(expected), "{found}");
    }
}

/// Settings that make no sense are refused, with what to do about them.
#[test]
fn what_makes_no_sense_in_a_motion_is_refused_with_a_remedy() {
    let mut missed = Vec::new();
    for [setting, expected] in REFUSED {
        let found = motion(BAR, &[setting]).err().unwrap_or_default();
        if !found.contains(expected) {
            missed.push(format!("{setting}: {found}"));
        }
    }
    assert!(missed.is_empty(), "{}", missed.join("\n"));
}

#[test]
fn a_quiet_edge_needs_an_outline() {
    let inside = "lattice.set.inside={box=[[4e-3,0.6e-3],[6e-3,1.4e-3]]}";
    let found = motion(BAR, &[inside, "quiet=[{group=\"inside\"}]"]);
    let found = found.err().unwrap();
    assert!(
        found.contains("quiet.0.group: waves leave through"),
        "{found}"
    );
}

#[test]
fn what_depends_on_time_is_refused_without_a_motion() {
    let text = BAR.replace("[motion]\nduration = 1e-5\n", "");
    for (setting, expected) in [
        (
            "title=\"x\"",
            "load.0.amplitude: there is no time in this analysis, only in a motion",
        ),
        (
            "load.0={group=\"left\",velocity={x=1.0}}",
            "load.0.velocity: there is no time in this analysis",
        ),
        (
            "load.0={group=\"left\",base_acceleration={x=1.0}}",
            "load.0.base_acceleration: there is no time",
        ),
        (
            "quiet=[{group=\"right\"}]",
            "quiet: `quiet` does not apply with analysis = \"static\": only a motion takes place in time",
        ),
        (
            "initial_velocity=[{velocity={x=1.0}}]",
            "initial_velocity: `initial_velocity` does not apply with analysis = \"static\"",
        ),
        (
            "analysis=motion",
            "analysis: \"motion\" needs a [motion] section",
        ),
    ] {
        let found = read(&text, &[setting]).unwrap_err();
        assert!(found.contains(expected), "{setting}: {found}");
    }
}

/// The scheme `auto` is implicit steps with a share of the work for equilibria, which is complete in the case that the program writes.
#[test]
fn equilibria_and_motion_alternate_where_the_case_says_so() {
    let text = BAR.replace(
        "duration = 1e-5\n",
        "duration = 1e-5\nscheme = \"auto\"\nstep = 1e-8\n",
    );
    for (given, expected) in [
        ("title=\"x\"", MotionSettings::new(1.0).statics),
        ("motion.statics=0.01", 0.01),
    ] {
        let case = read(&text, &[given]).unwrap();
        let again = read(&case.resolved_toml().unwrap(), &[]).unwrap();
        for case in [case, again] {
            let Kind::Motion(found) = case.setup(&mut ()).unwrap().analysis else {
                panic!("another analysis");
            };
            assert_eq!(found.share_of_statics(), Some(expected));
            assert_eq!(found.step, Some(1e-8));
        }
    }
}

/// The ground moves its points by the second integral of its acceleration.
#[test]
fn the_ground_accelerates_its_points() {
    let load = "load.0={group=\"left\",base_acceleration={x=4.0,y=0.0}}";
    let problem = motion(BAR, &[load]).unwrap();
    let layout = problem.problem.system.layout;
    let mut displacement = vec![0.0; layout.n_degrees_of_freedom()];
    problem.problem.loads.prescribe(3.0, &mut displacement);
    let dof = layout.degree_of_freedom(0, Component::X).unwrap();
    assert_eq!(displacement[dof], 4.0 * 9.0 / 2.0);
}

/// Springs move with the load through them.
#[test]
fn a_velocity_may_act_through_springs() {
    let load = "load.0={group=\"left\",velocity={x=2.0},stiffness=1e6}";
    let problem = motion(BAR, &[load]).unwrap();
    assert!(problem.prescribed().is_empty());
    let loads = &problem.problem.loads;
    let force: f64 = loads
        .forces(0.5, &loads.loaded_degrees_of_freedom())
        .iter()
        .sum();
    assert!((force - 1e6).abs() < 1e-6, "{force}");
}
