//! Every wrong case file is reported with its line, column, key path and what to do.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::path::Path;

use ligament::setup::Law;
use ligament_case::case::{CaseError, CaseFile, Fault, Location};

mod parts;

const TEXT: &str = include_str!("../data/brazilian-disk.toml");

/// The error of the case with `old` replaced by `new`, without the path before it.
fn error_with(old: &str, new: &str) -> String {
    assert!(TEXT.contains(old), "the case has no `{old}`");
    error_of(&TEXT.replacen(old, new, 1))
}

fn error_of(text: &str) -> String {
    let error = CaseFile::parse(Path::new("case.toml"), text.to_owned(), &[]).unwrap_err();
    let message = error.to_string();
    message
        .strip_prefix("case.toml:")
        .unwrap_or_else(|| panic!("no path in: {message}"))
        .to_owned()
}

/// The words of all laws.
fn laws() -> String {
    Law::ALL.map(|law| format!("\"{}\"", law.name())).join(", ")
}

/// The text of the case without the lines from the one that starts with `from` to the next blank one.
fn without_section(from: &str) -> String {
    let start = TEXT.find(from).unwrap();
    let length = TEXT[start..].find("\n\n").unwrap();
    format!("{}{}", &TEXT[..start], &TEXT[start + length..])
}

#[test]
fn the_unchanged_case_is_right() {
    CaseFile::parse(Path::new("case.toml"), TEXT.to_owned(), &[]).unwrap();
}

#[test]
fn unknown_keys_get_the_nearest_valid_one() {
    assert_eq!(
        error_with("horizon_factor", "horizont_factor"),
        "14:1: model.horizont_factor: unknown key `horizont_factor` in [model]; did you mean \
         `horizon_factor`? valid keys: `law`, `horizon_factor`, `horizon`, `bonds_through_voids`, `closing`, `closing_friction`, `allow_unstable`, `poisson`, `calibration`, `rotational_stiffness`, `rotational_factor`, `cosserat_length`, `form`, `strains`"
    );
    assert_eq!(
        error_with("group = \"platen-top\"", "grup = \"platen-top\""),
        "32:1: load.0.grup: unknown key `grup` in [[load]]; did you mean `group`? valid keys: \
         `name`, `group`, `box`, `at`, `displacement`, `velocity`, `base_acceleration`, `force`, `force_per_length`, `force_per_area`, `body_force`, `acceleration`, \
         `moment`, `body_couple`, `pressure`, `profile`, `amplitude`, `stiffness`, `tilts`"
    );
    assert_eq!(
        error_with("{ x = 0 }", "{ z = 0 }"),
        "28:16: support.1.displacement: a body in the plane moves by `x`, `y` and `rotation`: the others are those of solids"
    );
    assert!(error_with("[output]", "[outputt]").starts_with(
        "57:2: outputt: unknown key `outputt` in the case file; did you mean `output`?"
    ));
}

/// The section of the solver stands before the others, so that its lines are 3 and 4.
fn error_with_solver(section: &str) -> String {
    error_with("[mesh]", &format!("{section}\n[mesh]"))
}

/// Faces close where points turn, with the stiffness of the whole body.
#[test]
fn closing_asks_for_points_that_turn() {
    // These laws have no correction to iterate.
    let bare = TEXT.replacen("rule = \"sum\"", "", 1);
    let closing = |law: &str| {
        let with = format!("law = \"{law}\"\nclosing = true");
        error_of(&bare.replacen("law = \"nhpd\"", &with, 1))
    };
    for law in ["bbpd", "pds"] {
        let error = closing(law);
        assert!(error.starts_with("14:11: model.closing: "), "{error}");
        assert!(error.contains("\"nhpd\", \"mppd\", \"mppd-beam\" or \"orthotropic\""));
    }
    let text = TEXT.replacen("[correction]", "[correction]\ndomain = \"cracked\"", 1);
    let error = error_of(&text.replacen("law = \"nhpd\"", "law = \"nhpd\"\nclosing = true", 1));
    assert!(
        error.contains("closing") && error.contains("take \"whole\""),
        "{error}"
    );
}

#[test]
fn the_solver_is_auto_or_a_table_of_its_keys() {
    assert_eq!(
        error_with_solver("[solver]\nfactorization = \"llt\""),
        "4:1: solver.factorization: unknown key `factorization` in [solver]; did you mean \
         `factorisation`? valid keys: `method`, `tolerance`, `factorisation`, `ordering`, `update`, `rebuild_every`, \
         `threads`, `memory`"
    );
    for (setting, message) in [
        (
            "factorisation = \"lltt\"",
            "4:17: solver.factorisation: unknown value \"lltt\"; did you mean \"llt\"? valid values: \
             \"auto\", \"llt\", \"ldlt\"",
        ),
        (
            "ordering = \"nested_dissection\"",
            "4:12: solver.ordering: unknown value \"nested_dissection\"; did you mean \
             \"nested-dissection\"? valid values: \"auto\", \"nested-dissection\", \"minimum-degree\"",
        ),
        (
            "update = \"incremetal\"",
            "4:10: solver.update: unknown value \"incremetal\"; did you mean \"incremental\"? valid \
             values: \"auto\", \"incremental\", \"refactor\"",
        ),
        (
            "update = true",
            "4:10: solver.update: expected one of \"auto\", \"incremental\", \"refactor\", found true",
        ),
        (
            "rebuild_every = 0",
            "4:17: solver.rebuild_every: must be at least 1, found 0",
        ),
        (
            "rebuild_every = 2.5",
            "4:17: solver.rebuild_every: expected a whole number, 0 or more, found the number 2.5",
        ),
        (
            "threads = 0",
            "4:11: solver.threads: must be 1 to 1024, found 0",
        ),
        (
            "threads = 70000",
            "4:11: solver.threads: must be 1 to 1024, found 70000",
        ),
    ] {
        assert_eq!(error_with_solver(&format!("[solver]\n{setting}")), message);
    }
    let top = |value: &str| error_of(&format!("solver = {value}\n{TEXT}"));
    assert_eq!(
        top("\"fast\""),
        "1:10: solver: expected \"auto\" or a table, found the string \"fast\""
    );
    assert_eq!(
        top("3"),
        "1:10: solver: expected \"auto\" or a table, found the number 3"
    );
}

#[test]
fn wrong_types_say_what_is_expected_and_in_which_unit() {
    assert_eq!(
        error_with("15e9", "\"15 GPa\""),
        "8:9: material.young: expected a number, found the string \"15 GPa\"; values are plain \
         numbers in SI units, here Pa"
    );
    assert_eq!(
        error_with("15e9", "15 GPa"),
        "8:9: not valid TOML: a number stands alone, without its unit; values are in SI units"
    );
    assert_eq!(
        error_with("15e9", "nan"),
        "8:9: material.young: must be a finite number, found NaN"
    );
    assert_eq!(
        error_with("15e9", "1979-05-27"),
        "8:9: material.young: expected a number, found a date"
    );
    assert_eq!(
        error_with("fields_every = 5", "fields_every = 0.5"),
        "58:16: output.fields_every: expected a whole number, 0 or more, found the number 0.5"
    );
    assert_eq!(
        error_with("\"nhpd\"", "3"),
        format!(
            "13:7: model.law: expected one of {}, found the number 3",
            laws()
        )
    );
    assert_eq!(
        error_with("[[load]]", "[load]"),
        "30:1: load: this section may be repeated, so its name stands in double brackets: write \
         [[load]] instead of [load]"
    );
}

#[test]
fn lists_must_have_their_length() {
    let between = "[[-0.01, 0.0], [0.01, 0.0]]";
    assert_eq!(
        error_with(between, "[[0, 0]]"),
        "40:11: probe.0.between: expected a list of 2, found a list of 1"
    );
    assert_eq!(
        error_with(between, "[[0, 0], [1, 0], [2, 0]]"),
        "40:11: probe.0.between: expected a list of 2, found a list of 3"
    );
    assert_eq!(
        error_with(between, "[[0, 0], [1, \"a\"]]"),
        "40:24: probe.0.between.1.1: expected a number, found the string \"a\"; values are plain \
         numbers in SI units, here m"
    );
}

#[test]
fn wrong_words_get_the_nearest_valid_one() {
    assert_eq!(
        error_with("\"nhpd\"", "\"nhdp\""),
        format!(
            "13:7: model.law: unknown value \"nhdp\"; did you mean \"nhpd\"? valid values: {}",
            laws()
        )
    );
    assert_eq!(
        error_with("thickness = 0.02", "plane = \"strian\""),
        "5:9: mesh.plane: unknown value \"strian\"; did you mean \"strain\"? valid values: \
         \"stress\", \"strain\""
    );
}

#[test]
fn missing_keys_are_at_their_table() {
    assert_eq!(
        error_with("young = 15e9\n", ""),
        "7:1: material.young: missing key `young` in [material] (in Pa)"
    );
    assert_eq!(
        error_with("steps = 100\n", ""),
        "53:1: fracture.steps: missing key `steps` in [fracture]"
    );
    assert_eq!(
        error_with("displacement = { x = 0 }", ""),
        "26:1: support.1: holds nothing: give a `displacement`, a `normal` or a `stiffness`"
    );
    assert_eq!(
        error_with("tensile_strength = 3.81e6\n", ""),
        "7:1: material.tensile_strength: missing key `tensile_strength`: it is required (in Pa) \
         because the case has a [fracture] section with the criterion \"strength\""
    );
    assert_eq!(
        error_with("component = \"x\"\n", ""),
        "38:1: probe.0.component: missing key `component`: it is required with `between` or \
         `section`, to say what to read"
    );
}

#[test]
fn keys_of_load_steps_do_not_go_with_the_exact_path() {
    for key in [
        "steps = 100",
        "bonds_per_iteration = 5",
        "order = \"ratio\"",
        "max_iterations = 100",
        "refine_first_break = 3",
    ] {
        let event = format!("control = \"event\"\n{key}\n");
        let name = key.split(' ').next().unwrap();
        let column = key.find('=').unwrap() + 3;
        assert_eq!(
            error_with("steps = 100\n", &event),
            format!(
                "55:{column}: fracture.{name}: `{name}` does not apply with control = \"event\": the \
                 path goes from breakage to breakage without load steps; remove it"
            )
        );
    }
    assert_eq!(
        error_with("steps = 100", "control = \"events\""),
        "54:11: fracture.control: unknown value \"events\"; did you mean \"event\"? valid values: \
         \"stepped\", \"event\""
    );
    assert_eq!(
        error_with("steps = 100\n", "control = \"stepped\"\n"),
        "53:1: fracture.steps: missing key `steps` in [fracture]"
    );
    assert_eq!(
        error_with("steps = 100\n", "control = \"event\"\ntie_tolerance = 0\n"),
        "55:17: fracture.tie_tolerance: must be greater than 0, found 0.0"
    );
}

#[test]
fn missing_sections_are_named_with_their_purpose() {
    assert_eq!(
        error_of(&without_section("[model]")),
        " model: the case has no [model] section; it needs `law` and `horizon_factor`"
    );
    assert_eq!(
        error_of(&without_section("[[load]]")),
        " load: the case has no [[load]] section; it needs one or more, or a [[temperature]], or nothing would happen (natural \
         modes need none: analysis = \"modal\")"
    );
}

#[test]
fn values_outside_of_their_range_are_refused() {
    for (old, new, expected) in [
        (
            "poisson = 0.21",
            "poisson = 0.5",
            "9:11: material.poisson: must be greater than -1 and less than 0.5, found 0.5",
        ),
        (
            "15e9",
            "-1",
            "8:9: material.young: must be greater than 0, found -1.0",
        ),
        (
            "0.02",
            "0",
            "5:13: mesh.thickness: must be greater than 0, found 0.0",
        ),
        (
            "factor = 3.0",
            "factor = 0.9",
            "14:18: model.horizon_factor: must be at least 1, found 0.9",
        ),
        (
            "rule = \"sum\"",
            "tolerance = 0",
            "17:13: correction.tolerance: must be greater than 0, found 0.0",
        ),
        (
            "steps = 100",
            "steps = 0",
            "54:9: fracture.steps: must be at least 1, found 0",
        ),
        (
            "steps = 100",
            "steps = [0.1, 0.2, 0.2]",
            "54:20: fracture.steps.2: must be a number other than the load factor before it, 0.2, found 0.2",
        ),
        (
            "steps = 100",
            "steps = \"many\"",
            "54:9: fracture.steps: expected a whole number of load steps or a list of load \
             factors, found the string \"many\"",
        ),
        (
            "load_fraction = 0.5",
            "load_fraction = 1.5",
            "55:26: fracture.stop.load_fraction: must be greater than 0 and less than 1, found 1.5",
        ),
        (
            "[[-0.015, 0.0], [0.015, 0.0]]",
            "[[0.0, 0.0]]",
            "20:10: precrack.0.points: must be two points or more, found [[0.0, 0.0]]",
        ),
        (
            "[[-0.015, 0.0], [0.015, 0.0]]",
            "[[-0.015, 0.0], [0.015, 0.0]]\nends = \"include\"",
            "21:8: precrack.0.ends: unknown value \"include\"; did you mean \"included\"? valid values: \"excluded\", \
             \"included\"",
        ),
        (
            "box = [[0.01, 0.04], [-0.01, 0.05]]",
            "box = [[0, 0], [0, 1]]",
            "36:7: no_fail.0.box: must be two opposite corners of a rectangle with a width and a \
             height, found [[0.0, 0.0], [0.0, 1.0]]",
        ),
    ] {
        assert_eq!(error_with(old, new), expected);
    }
}

#[test]
fn keys_that_exclude_each_other_are_listed() {
    assert_eq!(
        error_with(
            "group = \"platen-top\"",
            "group = \"platen-top\"\nat = [0, 0]"
        ),
        "30:1: load.0: needs exactly one of `group`, `box`, `at`; found `group`, `at`"
    );
    assert_eq!(
        error_with("group = \"platen-bottom\"\n", ""),
        "22:1: support.0: needs exactly one of `group`, `box`, `at`; found none"
    );
    assert_eq!(
        error_with(
            "displacement = { y = -4.0e-4 }",
            "force = { y = 1 }\nforce_per_length = { y = 1 }"
        ),
        "30:1: load.0: needs exactly one of `displacement`, `velocity`, `base_acceleration`, `force`, `force_per_length`, `force_per_area`, \
         `body_force`, `acceleration`, `moment`, `body_couple`, `pressure`; found `force`, `force_per_length`"
    );
}

#[test]
fn text_that_is_not_toml_is_located() {
    assert_eq!(
        error_with("[mesh]", "[mesh"),
        "3:6: not valid TOML: unclosed table, expected `]`"
    );
    assert_eq!(
        error_with("poisson = 0.21", "young = 2"),
        "9:1: not valid TOML: duplicate key"
    );
}

#[test]
fn faults_found_later_are_located_too() {
    let case_file = CaseFile::parse(Path::new("case.toml"), TEXT.to_owned(), &[]).unwrap();
    assert_eq!(case_file.locate("load.0.group"), Some((32, 9)));
    assert_eq!(case_file.locate("load.0.at"), Some((30, 1)));
    assert_eq!(case_file.locate("load.7.at"), Some((30, 1)));
    assert_eq!(case_file.locate("nothing"), None);
    let groups = ["platen-top-edge", "platen-bottom"];
    let error = case_file.error(
        "load.0.group",
        Fault::unknown_name("group in the mesh", "platen-top", groups),
    );
    assert_eq!(
        error.to_string(),
        "case.toml:32:9: load.0.group: no group in the mesh is called `platen-top`; did you mean \
         `platen-top-edge`? there are: `platen-top-edge`, `platen-bottom`"
    );
    let CaseError::Key { location, .. } = case_file.error("mesh.thickness", "too thin") else {
        panic!()
    };
    assert_eq!(
        location,
        Location::Position {
            path: "case.toml".into(),
            line: 5,
            column: 13
        }
    );
}
