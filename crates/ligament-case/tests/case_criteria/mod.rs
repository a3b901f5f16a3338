//! `[[fracture.criterion]]`: what is read, what is written back, and what is refused with its place and reason.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::path::Path;
use std::slice::from_ref;

use ligament::body::{AnyBody, Points};
use ligament_case::case::{CaseError, CaseFile};
use ligament_model::failure::fracture_energy::{BOND_ENERGY, CRITICAL_STRETCH};
use ligament_model::failure::frictional::FRICTIONAL;
use ligament_model::failure::mixed_mode::MIXED_MODE;
use ligament_model::failure::sliding::SLIDING;
use ligament_model::failure::softening::{Curve, Law, exponential, linear, plastic};
use ligament_model::failure::strength::STRENGTH;
use ligament_model::failure::stretch::{COMPRESSION, TENSION};
use ligament_model::failure::{Calibration, Choice, Kind};

mod refusals;

const TEXT: &str = include_str!("../data/brazilian-disk.toml");

/// The strengths and the energy that criteria may take.
const PROPERTIES: &str =
    "tensile_strength = 3.81e6\ncompressive_strength = 40e6\nfracture_energy = 30.0\n";

fn read(text: String, overrides: &[&str]) -> Result<CaseFile, CaseError> {
    let overrides: Vec<String> = overrides.iter().map(|it| (*it).to_owned()).collect();
    CaseFile::parse(Path::new("case.toml"), text, &overrides)
}

/// The case with all properties and these criteria, the first of which has its header at line 56.
fn with(criteria: &str) -> String {
    TEXT.replace("tensile_strength = 3.81e6\n", PROPERTIES)
        .replace("[output]", &format!("{criteria}\n[output]"))
}

fn error_of(text: String) -> String {
    let message = read(text, &[]).unwrap_err().to_string();
    message.strip_prefix("case.toml:").unwrap().to_owned()
}

/// The message for a criterion with these lines; its header is at line 59.
fn error_with(lines: &str) -> String {
    error_of(with(&format!("[[fracture.criterion]]\n{lines}\n")))
}

fn criteria_of(text: String, overrides: &[&str]) -> Vec<Choice> {
    let case = read(text, overrides).unwrap();
    let written = case.resolved_toml().unwrap();
    let again = read(written.clone(), &[]).unwrap_or_else(|error| panic!("{error}\n{written}"));
    assert_eq!(again.case, case.case, "{written}");
    criteria(&case)
}

/// The criteria of a case as its setup has them, on a body of one point.
fn criteria(case: &CaseFile) -> Vec<Choice> {
    let body = Points::new(vec![[0.0; 2]], vec![1.0]).unwrap();
    case.setup_on(AnyBody::from(body)).unwrap().criteria
}

/// A criterion with a limit of its own, by which bonds break at once.
fn limited(kind: Kind, limit: f64) -> Choice {
    Choice {
        limit: Some(limit),
        ..kind.into()
    }
}

#[test]
fn a_case_without_criteria_has_the_strength() {
    let default = [STRENGTH.into()];
    assert_eq!(criteria_of(TEXT.to_owned(), &[]), default);
    let written = read(TEXT.to_owned(), &[]).unwrap().resolved_toml().unwrap();
    let section = "\n[[fracture.criterion]]\nkind = \"strength\"\nafter = \"brittle\"\n";
    assert!(written.contains(section), "{written}");
}

#[test]
fn every_kind_and_every_end_is_read() {
    let softening =
        |kind: Kind, law: Law, parameter| Choice::from(kind).with_softening(law, parameter);
    let frictional = |calibration| Choice {
        calibration: Some(calibration),
        ..FRICTIONAL.into()
    };
    let cases = [
        ("kind = \"strength\"", STRENGTH.into()),
        ("kind = \"tension\"", TENSION.into()),
        ("kind = \"tension\"\nlimit = 1e-3", limited(TENSION, 1e-3)),
        (
            "kind = \"compression\"\nlimit = 2",
            limited(COMPRESSION, 2.0),
        ),
        (
            "kind = \"sliding\"\nafter = \"plastic\"",
            softening(SLIDING, plastic::LAW, None),
        ),
        (
            "kind = \"frictional\"\nafter = \"brittle\"",
            frictional(Calibration::Printed),
        ),
        (
            "kind = \"frictional\"\ncalibration = \"two-point\"",
            frictional(Calibration::TwoPoint),
        ),
        ("kind = \"critical-stretch\"", CRITICAL_STRETCH.into()),
        ("kind = \"bond-energy\"", BOND_ENERGY.into()),
        (
            "kind = \"tension\"\nafter = \"linear\"",
            softening(TENSION, linear::LAW, None),
        ),
        (
            "kind = \"tension\"\nafter = \"linear\"\nend = 5",
            softening(TENSION, linear::LAW, Some(5.0)),
        ),
        (
            "kind = \"tension\"\nafter = \"exponential\"",
            softening(TENSION, exponential::LAW, None),
        ),
        (
            "kind = \"critical-stretch\"\nafter = \"exponential\"\nscale = 0.5",
            softening(CRITICAL_STRETCH, exponential::LAW, Some(0.5)),
        ),
    ];
    for (text, expected) in &cases {
        let text = with(&format!("[[fracture.criterion]]\n{text}\n"));
        assert_eq!(criteria_of(text, &[]), from_ref(expected));
    }
    let all: String = cases
        .each_ref()
        .map(|(text, _)| format!("[[fracture.criterion]]\n{text}\n\n"))
        .concat();
    assert_eq!(criteria_of(with(&all), &[]), cases.map(|it| it.1));
}

/// A curve is given by its corners, by a kink or by a table, and its corners are written back.
#[test]
fn a_curve_of_softening_as_given() {
    let corners = [[0.0, 1.0], [0.2, 0.25], [1.0, 0.0]];
    let expected = Choice::from(SLIDING)
        .with_softening(Law::by_curve(Curve::new(&corners).unwrap()), Some(9.0));
    let read_as = |after: &str| {
        let lines = format!("kind = \"sliding\"\nlimit = 1e-3\nafter = {after}\nend = 9.0\n");
        criteria_of(with(&format!("[[fracture.criterion]]\n{lines}")), &[])
    };
    let expected = Choice {
        limit: Some(1e-3),
        ..expected
    };
    let by_corners = read_as("{ curve = [[0, 1], [0.2, 0.25], [1, 0]] }");
    assert_eq!(by_corners, from_ref(&expected));
    assert_eq!(read_as("{ kink = [0.2, 0.25] }"), from_ref(&expected));
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("curve.csv");
    std::fs::write(&path, "# w/w_c\nopening,stress\n0,1\n0.2,0.25\n1,0\n").unwrap();
    assert_eq!(read_as(&format!("{{ table = {path:?} }}")), [expected]);
}

#[test]
fn criteria_are_set_and_added_on_the_command_line() {
    let (tension, compression) = (limited(TENSION, 2e-4), Choice::from(COMPRESSION));
    let first = [
        "fracture.criterion.0.kind=tension",
        "fracture.criterion.0.limit=2e-4",
    ];
    let second = "fracture.criterion.1.kind=compression";
    let both = [first[0], first[1], second];
    assert_eq!(criteria_of(with(""), &first), from_ref(&tension));
    assert_eq!(
        criteria_of(with(""), &both),
        [tension.clone(), compression.clone()]
    );
    let in_file = "[[fracture.criterion]]\nkind = \"compression\"\nlimit = 1e-3\n";
    let mut from_file = criteria_of(with(in_file), &[second]);
    assert_eq!(from_file.pop().unwrap(), compression);
    assert_eq!(from_file, [limited(COMPRESSION, 1e-3)]);
    let replaced = [first[0], first[1]];
    assert_eq!(criteria_of(with(in_file), &replaced), [tension]);
    let beyond = read(with(""), &[second]).unwrap_err().to_string();
    let reason = "--set fracture.criterion.1.kind=compression: there is no `fracture.criterion.1`: the case has no \
                  `fracture.criterion`";
    assert_eq!(beyond, reason);
    let wrong = read(with(""), &["fracture.criterion.0.kind=tensoin"]).unwrap_err();
    assert!(wrong.to_string().contains("did you mean \"tension\"?"));
}

#[test]
fn the_exact_path_takes_brittle_criteria_only() {
    let event = |lines: &str| {
        with(&format!("[[fracture.criterion]]\n{lines}\n"))
            .replace("steps = 100\n", "control = \"event\"\n")
    };
    let brittle = "kind = \"frictional\"\n\n[[fracture.criterion]]\nkind = \"tension\"";
    assert_eq!(criteria_of(event(brittle), &[]).len(), 2);
    assert_eq!(
        error_of(event("kind = \"tension\"\nafter = \"linear\"")),
        "61:9: fracture.criterion.0.after: `after = \"linear\"` does not apply with control = \"event\": the exact path is \
         straight between breakages, and softening bends it: take load steps (`steps`); remove it"
    );
}

#[test]
fn criteria_name_what_they_lack_of_the_material() {
    let lacking = |key: &str, lines: &str| {
        let text = with(&format!("[[fracture.criterion]]\n{lines}\n"));
        let line = text.lines().find(|line| line.starts_with(key)).unwrap();
        error_of(text.replacen(&format!("{line}\n"), "", 1))
    };
    let missing = |key: &str, unit: &str, criterion: &str| {
        format!(
            "7:1: material.{key}: missing key `{key}`: it is required (in {unit}) because the case has a [fracture] section with \
             the criterion {criterion}"
        )
    };
    let [tensile, compressive, energy] = [
        ("tensile_strength", "Pa"),
        ("compressive_strength", "Pa"),
        ("fracture_energy", "J/m^2"),
    ];
    let cases = [
        (tensile, "kind = \"strength\"", "\"strength\""),
        (tensile, "kind = \"tension\"", "\"tension\" without `limit`"),
        (tensile, "kind = \"sliding\"", "\"sliding\" without `limit`"),
        (
            tensile,
            "kind = \"frictional\"",
            "\"frictional\" without `limit`",
        ),
        (
            compressive,
            "kind = \"frictional\"",
            "\"frictional\" without `friction_angle`",
        ),
        (
            compressive,
            "kind = \"compression\"",
            "\"compression\" without `limit`",
        ),
        (
            energy,
            "kind = \"critical-stretch\"",
            "\"critical-stretch\" without `limit`",
        ),
        (
            energy,
            "kind = \"bond-energy\"",
            "\"bond-energy\" without `limit`",
        ),
        // The limit of bonds that soften comes from the strength, the fall after it from the energy.
        (
            tensile,
            "kind = \"bond-energy\"\nafter = \"two-branch\"",
            "\"bond-energy\" without `limit`",
        ),
        (
            energy,
            "kind = \"bond-energy\"\nlimit = 1e-4\nafter = \"two-branch\"",
            "\"bond-energy\" without `end`",
        ),
        (
            energy,
            "kind = \"tension\"\nlimit = 1e-3\nafter = \"linear\"",
            "\"tension\" without `end`",
        ),
        (
            energy,
            "kind = \"tension\"\nafter = \"exponential\"",
            "\"tension\" without `scale`",
        ),
    ];
    for ((key, unit), lines, criterion) in cases {
        assert_eq!(lacking(key, lines), missing(key, unit, criterion));
    }
    // What a criterion does not take need not be there.
    for lines in [
        "kind = \"tension\"\nlimit = 1e-3",
        "kind = \"sliding\"\nlimit = 1e-3\nafter = \"linear\"\nend = 4",
    ] {
        let text = with(&format!("[[fracture.criterion]]\n{lines}\n")).replace(PROPERTIES, "");
        assert_eq!(criteria_of(text, &[]).len(), 1);
    }
}

/// Keys of friction and of fibres: what goes with what, and in which range.
#[test]
fn cohesion_friction_and_fibres_as_given() {
    let cases = [
        (
            "kind = \"frictional\"\nlimit = 1e-3",
            "59:1: fracture.criterion.0.friction_angle: missing key `friction_angle`: it is required (in rad) beside `limit`: a bond \
             fails at |gamma| + s tan(beta) = a, and `limit` is a alone",
        ),
        (
            "kind = \"frictional\"\nlimit = 1e-3\nfriction_angle = 0.5\ncalibration = \"printed\"",
            "63:15: fracture.criterion.0.calibration: `calibration` does not apply with limit: cohesion and friction are given, and \
             no strength is used; remove it",
        ),
        (
            "kind = \"frictional\"\nfriction_angle = 1.6",
            "61:18: fracture.criterion.0.friction_angle: must be at least 0 and less than pi/2 (rad), found 1.6",
        ),
        (
            "kind = \"sliding\"\nfriction_angle = 0.5",
            "61:18: fracture.criterion.0.friction_angle: `friction_angle` does not apply with kind = \"sliding\": only \
             \"mohr-coulomb\" and \"frictional\" have friction; remove it",
        ),
        (
            "kind = \"tension\"\nfibre_distance = 1e-3",
            "61:18: fracture.criterion.0.fibre_distance: `fibre_distance` does not apply with kind = \"tension\": only \"fibre\" \
             looks at a fibre beside the axis of the bond; remove it",
        ),
        (
            "kind = \"fibre\"\nfibre_distance = -1e-3",
            "61:18: fracture.criterion.0.fibre_distance: must be at least 0, found -0.001",
        ),
    ];
    for (lines, message) in cases {
        assert_eq!(error_with(lines), message);
    }
    for (lines, spared) in [
        (
            "kind = \"frictional\"\nfriction_angle = 0.5",
            "compressive_strength = 40e6\n",
        ),
        (
            "kind = \"frictional\"\nlimit = 1e-3\nfriction_angle = 0.5",
            PROPERTIES,
        ),
        (
            "kind = \"fibre\"\nlimit = 1e-3\nfibre_distance = 1e-3",
            PROPERTIES,
        ),
    ] {
        let text = with(&format!("[[fracture.criterion]]\n{lines}\n")).replace(spared, "");
        assert_eq!(criteria_of(text, &[]).len(), 1, "{lines}");
    }
    let text =
        with("[[fracture.criterion]]\nkind = \"fibre\"\nlimit = 1e-3\nfibre_distance = 1e-3\n");
    assert_eq!(
        error_of(
            text.replace("law = \"nhpd\"", "law = \"pds\"")
                .replace("rule = \"sum\"", "")
        ),
        "60:8: fracture.criterion.0.kind: \"fibre\" looks at the bending of bonds, and the points of \"pds\" have no rotations: take \
         \"tension\""
    );
}

#[test]
fn friction_wants_the_compressive_strength_to_be_the_larger_one() {
    let text = with("[[fracture.criterion]]\nkind = \"frictional\"\n")
        .replace("compressive_strength = 40e6", "compressive_strength = 3e6");
    assert_eq!(
        error_of(text),
        "11:24: material.compressive_strength: must be at least the tensile_strength for the criterion \"frictional\", found \
         3000000.0"
    );
    // Others do not compare the two.
    let text = with("[[fracture.criterion]]\nkind = \"compression\"\n")
        .replace("compressive_strength = 40e6", "compressive_strength = 3e6");
    assert_eq!(criteria_of(text, &[]).len(), 1);
}

#[test]
fn materials_with_axes_take_criteria_with_limits_of_their_own() {
    let axes = "young_1 = 15e9\nyoung_2 = 5e9\npoisson_12 = 0.25\nshear_modulus = 4.8e9\n";
    let with_axes = |lines: &str| {
        with(&format!("[[fracture.criterion]]\n{lines}\n"))
            .replace("young = 15e9\npoisson = 0.21\n", axes)
            .replace("law = \"nhpd\"", "law = \"orthotropic\"")
            .replace("rule = \"sum\"", "")
    };
    for kind in ["tension", "compression", "sliding"] {
        let text = with_axes(&format!("kind = \"{kind}\"\nlimit = 1e-3"));
        assert_eq!(criteria_of(text, &[]).len(), 1);
        assert!(
            error_of(with_axes(&format!("kind = \"{kind}\"")))
                .ends_with("takes them from it: give it its own `limit`")
        );
    }
    let given = with_axes("kind = \"frictional\"\nlimit = 1e-3\nfriction_angle = 0.5");
    assert_eq!(criteria_of(given, &[]).len(), 1);
    assert!(
        error_of(with_axes("kind = \"frictional\""))
            .ends_with("takes them from it: give it its own `limit`")
    );
    assert_eq!(
        error_of(with_axes("kind = \"strength\"")),
        "7:1: material: `tensile_strength` gives limits of isotropic materials only, and the criterion \"strength\" of \
         [fracture] takes them from it: take \"tension\", \"compression\" or \"sliding\" with a `limit`"
    );
    let softening = "kind = \"tension\"\nlimit = 1e-3\nafter = \"linear\"";
    assert!(error_of(with_axes(softening)).ends_with("takes them from it: give it its own `end`"));
}

/// A small lattice of the law that has the criterion, with these lines of material and criteria.
fn lattice(material: &str, criteria: &str) -> String {
    format!(
        "[lattice]\ncells = [8, 8]\nspacing = 0.001\nthickness = 0.001\nset = {{ base = {{ bottom = 1 }}, end = {{ top = 1 }} }}\n\
         [material]\n{material}\n[model]\nlaw = \"mbb-pd\"\nhorizon_factor = 3.0\n\
         [[support]]\ngroup = \"base\"\ndisplacement = {{ x = 0.0, y = 0.0 }}\n\
         [[load]]\ngroup = \"end\"\ndisplacement = {{ y = 1e-4 }}\n[fracture]\ncontrol = \"event\"\n{criteria}"
    )
}

const ISOTROPIC: &str = "young = 65.8e9\npoisson = 0.3\nfracture_energy = 6137.0";
const SIX: &str = "c11 = 9e10\nc12 = 2e10\nc16 = 1e10\nc22 = 4e10\nc26 = -1e10\nc66 = 3e10\nfracture_energy = 6137.0";

#[test]
fn mixed_modes_are_the_criterion_of_their_law() {
    for material in [ISOTROPIC, SIX] {
        assert_eq!(criteria_of(lattice(material, ""), &[]), [MIXED_MODE.into()]);
    }
    let own = "[[fracture.criterion]]\nkind = \"mixed-mode\"\n";
    let given = format!("{own}critical_stretch = 0.01\ncritical_angle = 0.02\n");
    let limited = Choice {
        critical_stretch: Some(0.01),
        critical_angle: Some(0.02),
        ..MIXED_MODE.into()
    };
    let without = ISOTROPIC.replace("fracture_energy = 6137.0", "");
    assert_eq!(criteria_of(lattice(&without, &given), &[]), [limited]);
    let ends_with = |text: String, end: &str| {
        let found = error_of(text);
        assert!(found.ends_with(end), "{found}");
    };
    ends_with(
        lattice(ISOTROPIC, &format!("{own}critical_stretch = 0.01\n")),
        "critical_angle: missing key `critical_angle`: it is required beside `critical_stretch`: the limits of opening and of shear \
         are given together, or both come from the fracture energies",
    );
    ends_with(
        lattice(
            ISOTROPIC,
            "[[fracture.criterion]]\nkind = \"tension\"\nlimit = 1e-3\n",
        ),
        "have strains of their own: take \"mixed-mode\"",
    );
    ends_with(
        with("[[fracture.criterion]]\nkind = \"mixed-mode\"\n"),
        "only model.law = \"mbb-pd\" has: for \"nhpd\" take \"critical-stretch\" or \"bond-energy\"",
    );
    ends_with(
        lattice(&format!("{ISOTROPIC}\nfracture_energy_sliding = 9e3"), ""),
        "because fracture_energy_sliding is not fracture_energy: G_c = G_Ic + (G_IIc - G_Ic) (G_II/G)^exponent",
    );
    ends_with(
        lattice(&SIX.replace("c16 = 1e10", "c16 = 6e10"), ""),
        "material.c16: must be so small that every strain costs energy (c16^2 < c11 c66), found 60000000000.0",
    );
    ends_with(
        lattice(&SIX.replace("1e10", "3e10"), ""),
        "c12, c16 and c26 are too large together",
    );
    assert!(error_of(lattice(&SIX.replace("c22 = 4e10\n", ""), "")).contains("missing key `c22`"));
}
