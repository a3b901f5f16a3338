//! Profiles, couples and stresses: as they are read, written back, and refused.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::path::Path;

use ligament::setup::{Action, Axis};
use ligament_analysis::probe::PointField;
use ligament_case::case::{CaseFile, Couple, Profile, StressField};

const TEXT: &str = include_str!("data/brazilian-disk.toml");

fn error_of(text: &str) -> String {
    let error = CaseFile::parse(Path::new("case.toml"), text.to_owned(), &[]).unwrap_err();
    let message = error.to_string();
    message.strip_prefix("case.toml:").unwrap().to_owned()
}

#[test]
fn profiles_and_couples_are_read_and_written_back() {
    let load = "moment = -2.5\nprofile = { along = \"x\", zero = -0.01, one = 0.02 }";
    let case = CaseFile::parse(Path::new("case.toml"), with_load(load), &[]).unwrap();
    let read = &case.case.loads[0];
    assert_eq!(read.moment, Some(Couple::InPlane(-2.5)));
    let profile = Profile {
        along: Some(Axis::X),
        zero: Some(-0.01),
        one: Some(0.02),
        file: None,
    };
    assert_eq!(read.profile, Some(profile));
    let written = case.resolved_toml().unwrap();
    let again = CaseFile::parse(Path::new("case.toml"), written, &[]).unwrap();
    assert_eq!(again.case.loads, case.case.loads);
}

/// The first load of the case as another one, its place kept; its keys are on line 33.
fn with_load(load: &str) -> String {
    let line = TEXT
        .lines()
        .skip_while(|line| !line.contains("platen-top"))
        .nth(1)
        .unwrap();
    TEXT.replacen(line, load, 1)
}

#[test]
fn profiles_and_couples_are_checked() {
    for (load, message) in [
        (
            "force = { x = 1.0 }\nprofile = { along = \"z\", zero = 0.0, one = 0.1 }",
            "34:11: load.0.profile: a body in the plane has no z: give \"x\" or \"y\"",
        ),
        (
            "force = { x = 1.0 }\nprofile = { along = \"y\", zero = 0.1, one = 0.1 }",
            "34:44: load.0.profile.one: must be another coordinate than `zero`: the load is as given there, found 0.1",
        ),
        (
            "force = { x = 1.0 }\nprofile = { along = \"y\", zero = 0.1, ones = 0.1 }",
            "34:38: load.0.profile.ones: unknown key `ones` in `load.0.profile`; did you mean `one`? valid keys: \
             `along`, `zero`, `one`, `file`",
        ),
        (
            "force = { x = 1.0 }\nprofile = { along = \"y\", zero = 0.1 }",
            "34:11: load.0.profile.one: missing key `one` in `load.0.profile` (in m)",
        ),
        (
            "moment = 0.0",
            "33:10: load.0.moment: must be other than 0, or the load does nothing, found 0.0",
        ),
        (
            "moment = { x = 1.0 }",
            "33:10: load.0.moment: a couple in the plane turns about z: give a number",
        ),
        (
            "moment = 1.0\nbody_couple = 1.0",
            "30:1: load.0: needs exactly one of `displacement`, `velocity`, `base_acceleration`, `force`, `force_per_length`, `force_per_area`, `body_force`, `acceleration`, `moment`, \
             `body_couple`, `pressure`; found `moment`, `body_couple`",
        ),
        (
            "pressure = 0",
            "33:12: load.0.pressure: must be other than 0, or the load does nothing, found 0.0",
        ),
        (
            "pressure = \"1 MPa\"",
            "33:12: load.0.pressure: expected a number, found the string \"1 MPa\"; values are plain numbers in SI units, here \
             Pa",
        ),
    ] {
        assert_eq!(error_of(&with_load(load)), message, "{load}");
    }
}

#[test]
fn a_pressure_needs_a_group() {
    let case = CaseFile::parse(Path::new("case.toml"), with_load("pressure = -2e6"), &[]).unwrap();
    assert_eq!(case.case.loads[0].pressure, Some(-2e6));
    let units = Action::Pressure(-2e6).units();
    assert_eq!((units.displacement, units.force), ("m^3", "Pa"));
    let written = case.resolved_toml().unwrap();
    let again = CaseFile::parse(Path::new("case.toml"), written, &[]).unwrap();
    assert_eq!(again.case.loads, case.case.loads);
    for place in ["at = [0, 0]", "box = [[0, 0], [1, 1]]", ""] {
        let text = with_load("pressure = 1").replace("group = \"platen-top\"", place);
        assert_eq!(
            error_of(&text),
            "33:12: load.0.pressure: acts on the outline of a `group`, so the load needs one",
            "{place}"
        );
    }
}

#[test]
fn stresses_are_asked_for_by_name() {
    let with = |key: &str, value: &str| {
        let settings = [format!("{key}={value}")];
        CaseFile::parse(Path::new("case.toml"), TEXT.to_owned(), &settings)
    };
    assert_eq!(with("output.bonds", "true").unwrap().case.output.stress, []);
    let case = with("output.stress", "[\"traction\", \"virial\"]").unwrap();
    assert_eq!(
        case.case.output.stress,
        [StressField::Traction, StressField::Virial]
    );
    let written = case.resolved_toml().unwrap();
    assert!(
        written.contains("stress = [\"traction\", \"virial\"]"),
        "{written}"
    );
    let message = |value: &str| with("output.stress", value).unwrap_err().to_string();
    assert_eq!(
        message("[\"tractions\"]"),
        "--set output.stress=[\"tractions\"]: output.stress.0: unknown value \"tractions\"; did you mean \"traction\"? \
         valid values: \"material\", \"effective\", \"virial\", \"traction\""
    );
    assert_eq!(
        message("[\"virial\", \"virial\"]"),
        "--set output.stress=[\"virial\", \"virial\"]: output.stress: must be each stress once, found [Virial, Virial]"
    );
    assert_eq!(
        message("true"),
        "--set output.stress=true: output.stress: expected a list, found true"
    );
    let probe = "\n[[probe]]\nname = \"s\"\nat = [0.0, 0.0]\nfield = \"stress_virial.xy\"\n";
    let case = CaseFile::parse(Path::new("case.toml"), format!("{TEXT}{probe}"), &[]).unwrap();
    let at = [0.0, 0.0].into();
    let field = PointField::named("stress_virial.xy").unwrap();
    let probe = case.case.probes.last().unwrap();
    assert_eq!((probe.at, probe.field), (Some(at), Some(field)));
    let of_solids = "\n[[probe]]\nname = \"s\"\nat = [0.0, 0.0]\nfield = \"stress_principal.3\"\n";
    let error = error_of(&format!("{TEXT}{of_solids}"));
    let reason = "a body in the plane has no such component of the stress: xx, yy, zz and xy, and the principal values 1 and 2";
    assert!(error.ends_with(reason), "{error}");
    let across = of_solids.replace("stress_principal.3", "stress.yz");
    let error = error_of(&format!("{TEXT}{across}"));
    assert!(error.ends_with(reason), "{error}");
}

#[test]
fn supports_that_give_way_are_checked() {
    let line = TEXT
        .lines()
        .find(|it| it.starts_with("displacement"))
        .unwrap();
    for (support, message) in [
        (
            "",
            "support.0: holds nothing: give a `displacement`, a `normal` or a `stiffness`",
        ),
        (
            "displacement = { y = 0.0 }\nnormal = [1.0, 1.0]",
            "support.0.normal: a support holds components of the `displacement` or one direction between them, its `normal`: give one \
             of the two, or two supports",
        ),
        (
            "normal = [0.0, 0.0]",
            "support.0.normal: must be a direction other than [0, 0]",
        ),
        (
            "stiffness = { y = -1e9 }",
            "support.0.stiffness.y: must be greater than 0, found -1000000000.0",
        ),
        (
            "displacement = { y = 0.0 }\nstiffness = { y = 1e9 }",
            "support.0.stiffness: a component is held by `displacement` or by a spring, not by both",
        ),
        (
            "stiffness = { normal = 1e9 }",
            "support.0.stiffness: `normal` of the stiffness needs the direction `normal` of the support",
        ),
    ] {
        let error = error_of(&TEXT.replacen(line, support, 1));
        assert!(error.ends_with(message), "{support}: {error}");
    }
}

#[test]
fn loads_through_machines_are_checked() {
    for (load, message) in [
        (
            "force = { y = 1.0 }\nstiffness = 1e9",
            "load.0.stiffness: only a `displacement` along the axes goes through springs",
        ),
        (
            "moment = 1.0\ntilts = true",
            "load.0.tilts: a platen tilts under a `displacement` along the axes or under a `force`",
        ),
        (
            "displacement = { y = 1e-3 }\ntilts = true\nprofile = { along = \"x\", zero = 0.0, one = 0.1 }",
            "load.0.tilts: a platen moves by the mean of its points: a `profile` goes with a `force` alone",
        ),
        (
            "displacement = { y = 1e-3 }\nstiffness = 0.0",
            "load.0.stiffness: must be greater than 0, found 0.0",
        ),
    ] {
        let error = error_of(&with_load(load));
        assert!(error.ends_with(message), "{load}: {error}");
    }
}
