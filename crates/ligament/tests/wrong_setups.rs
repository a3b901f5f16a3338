//! The error of a wrong setup names the field and gives advice.
#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use ligament::analysis::motion::MotionSettings;
use ligament::body::PointsError;
use ligament::prelude::*;
use ligament::setup::SurfaceContact;
use ligament::suggestion::{hint, nearest};
use ligament_model::failure::mixed_mode::MIXED_MODE;
use ligament_model::{Anisotropic, Orthotropic};

/// Ten by ten points of 10 mm with the groups `left` and `right`, pulled apart.
fn plate() -> Setup {
    let position = |k: u32| [k % 10, k / 10].map(|it| 0.01 * (f64::from(it) + 0.5));
    let points = Points::new((0..100).map(position).collect(), vec![1e-4; 100]).unwrap();
    let points = points
        .with_group("left", (0..10).map(|row| 10 * row))
        .unwrap();
    let points = points
        .with_group("right", (0..10).map(|row| 10 * row + 9))
        .unwrap();
    let mut setup = Setup::new(points, Material::isotropic(1e9, 0.2), Law::NHPD);
    setup.supports = vec![Support::new("left", &[Component::X, Component::Y])];
    setup.loads = vec![Load::new("right", Action::Force([1.0, 0.0, 0.0]))];
    setup
}

/// The error of a plate after a change.
fn error(change: impl FnOnce(&mut Setup)) -> String {
    let mut setup = plate();
    change(&mut setup);
    setup.solve(&mut NoObserver).unwrap_err().to_string()
}

#[test]
fn the_plate_itself_is_right() {
    let solution = plate().solve(&mut NoObserver).unwrap();
    assert!(solution.outcome.history.last().unwrap().displacement > 0.0);
}

#[test]
fn a_group_that_is_not_there_is_named_with_the_nearest() {
    let mut setup = plate();
    setup
        .loads
        .push(Load::new("rigth", Action::Moment(1.0.into())));
    let Error::Setup(error) = setup.solve(&mut NoObserver).unwrap_err() else {
        panic!("another error");
    };
    assert_eq!(error.field.to_string(), "loads[1].place");
    let Fault::UnknownName {
        found, candidates, ..
    } = &*error.fault
    else {
        panic!("{error}");
    };
    assert_eq!((found.as_str(), candidates.len()), ("rigth", 2));
    assert_eq!(
        error.to_string(),
        "loads[1].place: no group of points is called `rigth`; did you mean `right`? there are: `left`, `right`"
    );
}

#[test]
fn values_out_of_range_say_what_they_must_be() {
    for (found, expected) in [
        (
            error(|it| it.horizon = Horizon::Factor(0.5)),
            "horizon: must be at least 1, found 0.5",
        ),
        (
            error(|it| it.materials[0].material = Material::isotropic(-1.0, 0.2)),
            "materials[0].elasticity.young: must be greater than 0, found -1.0",
        ),
        (
            error(|it| it.materials[0].material = Material::isotropic(1.0, 0.5)),
            "materials[0].elasticity.poisson: must be greater than -1 and less than 0.5, found 0.5",
        ),
        (
            error(|it| {
                it.section = Section::Plane {
                    state: Plane::Stress,
                    thickness: 0.0,
                }
            }),
            "section.thickness: must be greater than 0, found 0.0",
        ),
    ] {
        assert_eq!(found, expected);
    }
}

/// The range of a number is defined once, for a case file and for memory: a number outside it is refused with the name of the field of its
/// key, and with the words of the range where it has some. Expected are the words of the messages; a number that is not finite is out of
/// every range.
#[test]
fn numbers_out_of_the_ranges_of_their_keys_are_refused() {
    let motion = |change: fn(&mut MotionSettings)| {
        error(|it| {
            let mut settings = MotionSettings::new(1.0);
            change(&mut settings);
            it.analysis = Analysis::Motion(settings);
        })
    };
    let contact = SurfaceContact {
        between: None,
        friction: -0.1,
        stiffness: 1.0,
        cracks: false,
    };
    for (found, expected) in [
        (
            motion(|it| it.duration = f64::INFINITY),
            "motion.duration: must be a finite number, found inf",
        ),
        (
            motion(|it| it.rows = 0),
            "motion.rows: must be 1 to 1000000, found 0",
        ),
        (
            motion(|it| it.step = Some(f64::NAN)),
            "motion.step: must be greater than 0, found NaN",
        ),
        (
            motion(|it| it.safety = 1.0),
            "motion.safety: must be greater than 0 and less than 1: the share of the critical step, beyond which an explicit scheme is \
             unstable, found 1.0",
        ),
        (
            motion(|it| it.dissipation = 0.5),
            "motion.dissipation: must be 0 to 1/3, found 0.5",
        ),
        (
            motion(|it| it.damping.mass = -1.0),
            "motion.damping.mass: must be at least 0: a negative damping would feed energy to the body, found -1.0",
        ),
        (
            motion(|it| it.stop.wall_time = Some(0.0)),
            "motion.stop.wall_time: must be greater than 0, found 0.0",
        ),
        (
            error(|it| {
                let mut settings = event();
                settings.stop.load_fraction = Some(1.5);
                it.criteria = vec![STRENGTH.into()];
                it.materials[0].material.tensile_strength = Some(1e6);
                it.analysis = Analysis::Event(settings);
            }),
            "analysis.stop.load_fraction: must be greater than 0 and less than 1, found 1.5",
        ),
        (
            error(|it| it.supports[0].stiffness.y = Some(-1.0)),
            "supports[0].stiffness: must be greater than 0, found -1.0",
        ),
        (
            error(|it| it.contacts.push(contact)),
            "contacts[0].friction: must be 0 or more, found -0.1",
        ),
        (
            error(|it| it.solver.rebuild_every = 0),
            "solver.rebuild_every: must be at least 1, found 0",
        ),
        (
            error(|it| {
                let modes = 0;
                it.materials[0].material.density = Some(1e3);
                it.analysis = Analysis::Modal(ModalSettings {
                    modes,
                    ..ModalSettings::default()
                });
            }),
            "modal.modes: must be 1 to 1000, found 0",
        ),
    ] {
        assert_eq!(found, expected);
    }
}

/// Rules for a case file also hold for a setup that is built in memory.
#[test]
fn a_setup_is_held_to_the_rules_of_a_case() {
    let with_axes = |poisson: f64| {
        let elasticity = Elasticity::Orthotropic(Orthotropic {
            young: [15e9, 5e9],
            poisson,
            shear_modulus: 4.8e9,
            out_of_plane: None,
            angle: 0.0,
        });
        move |it: &mut Setup| it.materials[0].material.elasticity = elasticity
    };
    let six = |c16: f64| {
        let constants = Anisotropic::new([9e10, 2e10, c16, 4e10, -c16, 3e10]);
        move |it: &mut Setup| {
            it.materials[0].material.elasticity = Elasticity::Anisotropic(constants);
        }
    };
    let crack = |points: Vec<[f64; 2]>| {
        let ends = Ends::Excluded;
        move |it: &mut Setup| {
            it.precracks.push(PreCrack {
                shape: CrackShape::Line(points),
                ends,
            })
        }
    };
    let steps = |factors: Vec<f64>| {
        move |it: &mut Setup| {
            it.materials[0].material.tensile_strength = Some(1e6);
            it.criteria = vec![STRENGTH.into()];
            it.analysis = Analysis::Stepped(stepped(factors));
        }
    };
    let strained = |it: &mut Setup| {
        with_axes(0.2)(it);
        it.law = Law::ORTHOTROPIC;
        it.section = Section::Plane {
            state: Plane::Strain,
            thickness: 1.0,
        };
    };
    let reading = Reading::Between {
        positions: [[0.0; 3]; 2],
        component: Component::X,
    };
    let name = "gauge".to_owned();
    for (found, expected) in [
        (
            error(|it| it.horizon = Horizon::Length(f64::INFINITY)),
            "horizon: must be a finite number, found inf",
        ),
        (
            error(|it| it.horizon = Horizon::Length(f64::NAN)),
            "horizon: must be greater than 0, found NaN",
        ),
        (
            error(with_axes(1.8)),
            "materials[0].elasticity.poisson: must be so small that every strain costs energy",
        ),
        (
            error(with_axes(0.2)),
            "materials[0].elasticity: an orthotropic material needs `Law::ORTHOTROPIC` or `Law::MBB_PD`: \"nhpd\" is a law for \
             isotropic ones",
        ),
        (
            error(strained),
            "materials[0].elasticity.out_of_plane: missing elasticity.out_of_plane: it is required because of plane strain",
        ),
        (
            error(six(6e10)),
            "materials[0].elasticity.c16: must be so small that every strain costs energy (c16^2 < c11 c66), found 60000000000.0",
        ),
        (
            error(six(3e10)),
            "materials[0].elasticity: the stiffness c11 to c66 is not positive definite",
        ),
        (
            error(crack(vec![[0.0; 2]])),
            "precracks[0].points: must be two points or more, found [[0.0, 0.0]]",
        ),
        (
            error(crack(vec![[0.0; 2]; 2])),
            "precracks[0].points: must be another point than the one before it, found [0.0, 0.0]",
        ),
        (
            error(steps(Vec::new())),
            "analysis.load_factors: must be one load factor or more, found []",
        ),
        (
            error(steps(vec![0.5, 0.5])),
            "analysis.load_factors[1]: must be a number other than the load factor before it, 0.5, found 0.5",
        ),
        (
            error(|it| it.probes.push(Probe { name, reading })),
            "probes[0].reading: must be two different points, found [[0.0, 0.0], [0.0, 0.0]]",
        ),
        (
            error(|it| it.supports[0] = Support::new("left", &[])),
            "supports[0]: holds nothing: give a `displacement`, a `normal` or a `stiffness`",
        ),
        (
            error(|it| {
                it.loads[0].place = Place::At([0.0; 3]);
                it.loads[0].action = Action::ForcePerLength([1.0, 0.0, 0.0]);
            }),
            "loads[0].action: acts along the curve of a `group`, so the load needs one",
        ),
        (
            error(|it| it.loads[0].action = Action::Force([1.0, 0.0, 1.0])),
            "loads[0].action: a body in the plane has no z: give \"x\" or \"y\"",
        ),
        (
            error(|it| it.supports[0].place = Place::At([0.0, 0.0, 1.0])),
            "supports[0].place: a body in the plane has no z: give \"x\" or \"y\"",
        ),
        (
            error(|it| it.section = Section::Solid),
            "section: a body in the plane has `Section::Plane`, one in space `Section::Solid`",
        ),
    ] {
        assert!(found.starts_with(expected), "{found}");
    }
}

#[test]
fn what_does_not_go_together_is_refused_with_a_remedy() {
    let steps = || Analysis::Stepped(stepped(vec![1.0]));
    for (found, field, remedy) in [
        (error(|it| it.materials.clear()), "materials:", "give one"),
        (error(|it| it.loads.clear()), "temperatures:", "no load"),
        (
            error(|it| it.loads[0].action = Action::Moment(0.0.into())),
            "loads[0].action:",
            "other than 0",
        ),
        (
            error(|it| it.loads.push(it.loads[0].clone())),
            "loads[1].name:",
            "another name",
        ),
        (
            error(|it| it.loads[0].action = Action::Pressure(1.0)),
            "loads[0].place:",
            "a pressure needs",
        ),
        (
            error(|it| it.loads[0].place = Place::Box([[1.0; 3], [2.0; 3]])),
            "loads[0].place:",
            "no point of the body",
        ),
        (
            error(|it| it.horizon = Horizon::Length(1e-3)),
            "horizon:",
            "enlarge the horizon",
        ),
        (error(|it| it.analysis = steps()), "criteria:", "give one"),
        (
            error(|it| (it.analysis, it.criteria) = (steps(), vec![STRENGTH.into()])),
            "materials[0]",
            "tensile_strength",
        ),
        (
            error(|it| (it.analysis, it.criteria) = (steps(), vec![MIXED_MODE.into()])),
            "criteria[0].kind:",
            "Law::MBB_PD",
        ),
        (
            error(|it| it.law = Law::MBB_PD),
            "law:",
            "rows and columns of a lattice",
        ),
        (
            error(|it| it.law = Law::NHPD.with(Calibration::Discrete)),
            "law.calibration:",
            "leaves other options open",
        ),
    ] {
        assert!(
            found.starts_with(field) && found.contains(remedy),
            "{found}"
        );
    }
}

#[test]
fn modes_are_asked_for_by_the_analysis() {
    let error = plate().modes().unwrap_err().to_string();
    assert!(
        error.starts_with("analysis: the setup says static"),
        "{error}"
    );
}

#[test]
fn arrays_that_are_no_body_are_refused() {
    let error = Points::new(vec![[0.0; 2]], Vec::new()).unwrap_err();
    assert_eq!(
        error,
        PointsError::Lengths {
            positions: 1,
            sizes: 0,
            what: "area"
        }
    );
    let error = Points::new(vec![[0.0; 2]; 2], vec![1.0, -1.0]).unwrap_err();
    assert!(error.to_string().starts_with("point 1 has"), "{error}");
    let error = Points::new(vec![[0.0; 2]], vec![1.0])
        .unwrap()
        .with_group("end", [1]);
    assert!(
        error
            .unwrap_err()
            .to_string()
            .contains("group `end` has the point 1")
    );
}

#[test]
fn the_nearest_name_is_suggested_and_a_far_one_is_not() {
    let candidates = ["platen-top", "platen-bottom", "disk"].map(str::to_owned);
    assert_eq!(nearest("platen-topp", &candidates), Some("platen-top"));
    assert_eq!(nearest("Disk", &candidates), Some("disk"));
    assert_eq!(nearest("quux", &candidates), None);
}

#[test]
fn a_long_list_of_names_is_left_out() {
    let many: Vec<String> = (0..40).map(|index| format!("group-{index}")).collect();
    assert_eq!(hint("quux", &many, "groups", '`'), "");
    let few = ["a", "b"].map(str::to_owned);
    assert_eq!(hint("quux", &few, "groups", '`'), "; groups: `a`, `b`");
}

/// Few bonds matter to limits that are a strength: a new kind changes the list.
#[test]
fn few_bonds_matter_to_limits_of_a_strength() {
    let warned = |kind: &&ligament_model::failure::Kind| {
        let choices = [ligament_model::failure::Choice::from(**kind)];
        let [two, more] = [2.0, 2.5].map(|factor| ligament::warning::few_bonds(&choices, factor));
        assert!(more.is_none(), "{}", kind.word);
        two.is_some()
    };
    let kinds = ligament_model::failure::KINDS.into_iter().filter(warned);
    let words: Vec<&str> = kinds.map(|kind| kind.word).collect();
    let expected = "bond-rankine rankine mohr-coulomb tension compression fibre sliding frictional";
    assert_eq!(words.join(" "), expected);
}
