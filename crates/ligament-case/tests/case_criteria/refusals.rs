//! Criteria with wrong names, numbers and keys.

use super::{error_of, error_with, with};

#[test]
fn misspelt_kinds_and_keys_get_the_nearest_valid_ones() {
    assert_eq!(
        error_with("kind = \"compresion\""),
        "60:8: fracture.criterion.0.kind: unknown value \"compresion\"; did you mean \"compression\"? valid values: \
         \"strength\", \"bond-rankine\", \"rankine\", \"mohr-coulomb\", \"tension\", \"compression\", \"fibre\", \"sliding\", \"frictional\", \"critical-stretch\", \"bond-energy\", \"mixed-mode\", \"printed-opening\", \"printed-sliding\", \"printed-mixed\""
    );
    assert_eq!(
        error_with("kind = \"tension\"\nlimits = 1e-3"),
        "61:1: fracture.criterion.0.limits: unknown key `limits` in [[fracture.criterion]]; did you mean `limit`? valid keys: \
         `kind`, `limit`, `critical_stretch`, `critical_angle`, `calibration`, `friction_angle`, `cohesion`, `fibre_distance`, `after`, `end`, `scale`"
    );
    assert_eq!(
        error_with("kind = \"tension\"\nafter = \"liniar\""),
        "61:9: fracture.criterion.0.after: unknown value \"liniar\"; did you mean \"linear\"? valid values: \"brittle\", \
         \"linear\", \"two-branch\", \"cornelissen\", \"ceb-fip\", \"model-code-2010\", \"exponential\", \"plastic\", \"bilinear\""
    );
    assert_eq!(
        error_with("kind = \"frictional\"\ncalibration = \"exact\""),
        "61:15: fracture.criterion.0.calibration: unknown value \"exact\"; valid values: \"printed\", \"two-point\""
    );
    assert_eq!(
        error_with("limit = 1e-3"),
        "59:1: fracture.criterion.0.kind: missing key `kind` in [[fracture.criterion]]"
    );
    assert_eq!(
        error_of(with("[fracture.criterion]\nkind = \"tension\"\n")),
        "59:1: fracture.criterion: this section may be repeated, so its name stands in double brackets: write \
         [[fracture.criterion]] instead of [fracture.criterion]"
    );
    assert_eq!(
        error_of(with("criterion = []\n")),
        "59:13: fracture.criterion: must be one criterion or more (without the key it is kind = \"strength\"), found []"
    );
}

/// Openings rise from zero, stresses fall to zero; a file is named with its line.
#[test]
fn curves_that_are_none_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let file = |text: &str| {
        let path = folder.path().join("curve.csv");
        std::fs::write(&path, text).unwrap();
        format!("{{ table = {path:?} }}")
    };
    let path = folder.path().join("curve.csv");
    let path = path.display();
    let cases = [
        (
            "{ curve = [[0, 1]] }".to_owned(),
            "after: a curve has two points or more".to_owned(),
        ),
        (
            "{ curve = [[0, 1], [0.5, 1.2], [1, 0]] }".to_owned(),
            "after: stresses must fall or stay, down to 0; point 2 has 1.2 after 1.0".to_owned(),
        ),
        (
            "{ curve = [[0, 1], [0, 0.5], [1, 0]] }".to_owned(),
            "after: openings must rise from point to point; point 2 has 0.0 after 0.0".to_owned(),
        ),
        (
            "{ curve = [[0, 1], [1, 0.1]] }".to_owned(),
            "after: the last stress must be 0, at the opening where the crack bears nothing; it is 0.1".to_owned(),
        ),
        (
            "{ kink = [1.5, 0.2] }".to_owned(),
            "after: openings must rise from point to point; point 3 has 1.0 after 1.5".to_owned(),
        ),
        (
            "{ kink = [0.2, 0.3], curve = [[0, 1], [1, 0]] }".to_owned(),
            "after: a curve is given by one of `curve`, `kink` and `table`".to_owned(),
        ),
        (
            "{ knik = [0.2, 0.3] }".to_owned(),
            "after.knik: unknown key `knik` in `fracture.criterion.0.after`; did you mean `kink`? valid keys: `curve`, `kink`, `table`".to_owned(),
        ),
        (
            file("opening,strain\n0,1\n1,0\n"),
            format!(
                "after.table: {path}:1: there is no column `stress`: the first row must name the columns `opening` (m, or over any other) and \
                 `stress` (Pa, or over the strength)"
            ),
        ),
    ];
    for (after, message) in cases {
        let found = error_with(&format!("kind = \"rankine\"\nafter = {after}"));
        let found = found.split_once("fracture.criterion.0.").unwrap().1;
        assert_eq!(found, message);
    }
}

#[test]
fn numbers_out_of_range_are_refused() {
    let cases = [
        (
            "kind = \"compression\"\nlimit = -1e-3",
            "61:9: fracture.criterion.0.limit: must be greater than 0, found -0.001",
        ),
        (
            "kind = \"tension\"\nafter = \"linear\"\nend = 1",
            "62:7: fracture.criterion.0.end: must be greater than 1, found 1.0",
        ),
        (
            "kind = \"tension\"\nafter = \"exponential\"\nscale = 0.0",
            "62:9: fracture.criterion.0.scale: must be greater than 0, found 0.0",
        ),
    ];
    for (lines, message) in cases {
        assert_eq!(error_with(lines), message);
    }
    let text = with("").replace(
        "compressive_strength = 40e6",
        "compressive_strength = -40e6",
    );
    let message = "11:24: material.compressive_strength: must be greater than 0, found -40000000.0";
    assert_eq!(error_of(text), message);
    let text = with("").replace("fracture_energy = 30.0", "fracture_energy = \"30 J/m2\"");
    let message = "12:19: material.fracture_energy: expected a number, found the string \"30 J/m2\"; values are plain numbers in \
                   SI units, here J/m^2";
    assert_eq!(error_of(text), message);
}

#[test]
fn keys_that_a_kind_does_not_take_are_refused() {
    let cases = [
        (
            "kind = \"strength\"\nlimit = 1e-3",
            "61:9: fracture.criterion.0.limit: `limit` does not apply with kind = \"strength\": its limits come from the \
             material; \"tension\", \"compression\", \"fibre\", \"sliding\", \"frictional\", \"critical-stretch\" \
             and \"bond-energy\" take one; remove it",
        ),
        (
            "kind = \"sliding\"\ncalibration = \"two-point\"",
            "61:15: fracture.criterion.0.calibration: `calibration` does not apply with kind = \"sliding\": only the limit of \
             \"frictional\" can come from the strengths in two ways; remove it",
        ),
        (
            "kind = \"tension\"\nend = 3.0",
            "61:7: fracture.criterion.0.end: `end` does not apply with after = \"brittle\": only a force that falls to zero, such as after = \"linear\", has an end; remove it",
        ),
        (
            "kind = \"tension\"\nafter = \"linear\"\nscale = 3.0",
            "62:9: fracture.criterion.0.scale: `scale` does not apply with after = \"linear\": only a force that falls \
             exponentially, after = \"exponential\", has a scale; remove it",
        ),
        (
            "kind = \"compression\"\nafter = \"plastic\"",
            "61:9: fracture.criterion.0.after: `after = \"plastic\"` does not apply with kind = \"compression\": only bonds that \
             slide, kind = \"sliding\", keep their force; remove it",
        ),
        (
            "kind = \"frictional\"\nafter = \"exponential\"",
            "61:9: fracture.criterion.0.after: `after = \"exponential\"` does not apply with kind = \"frictional\": its limit \
             moves with the stretch, so that there is no one deformation at which softening begins; remove it",
        ),
        (
            "kind = \"critical-stretch\"\nafter = \"linear\"",
            "59:1: fracture.criterion.0.end: missing key `end`: it is required with kind = \"critical-stretch\": up to the limit \
             a bond takes all of the fracture energy, and nothing is left to soften by; or take kind = \"bond-energy\", whose limit \
             comes from the `tensile_strength`",
        ),
    ];
    for (lines, message) in cases {
        assert_eq!(error_with(lines), message);
    }
}

/// The message for random factors by these keys, in line 59, and one criterion.
fn error_of_scatter(kind: &str, keys: &str) -> String {
    let criteria = format!("criterion = [{{ kind = \"{kind}\" }}]");
    error_of(with(&format!("scatter = {{ {keys} }}\n{criteria}\n")))
}

#[test]
fn random_factors_go_with_their_distribution_and_with_what_criteria_take() {
    let cases = [
        ("tension", "of = \"strength\"", "missing key `modulus`"),
        (
            "tension",
            "of = \"strength\", distribution = \"normal\", modulus = 12",
            "`modulus` does not apply with distribution = \"normal\"",
        ),
        (
            "tension",
            "of = \"strength\", distribution = \"normal\", deviation = 0.3",
            "deviation: must be greater than 0 and less than 0.25, so that no strength is negative, found 0.3",
        ),
        (
            "tension",
            "of = \"strength\", modulus = 0.5",
            "modulus: must be 1 to 10000, found 0.5",
        ),
        (
            "tension",
            "of = \"strength\", modulus = 12, correlation_length = -1.0",
            "correlation_length: must be at least 0, found -1.0",
        ),
        (
            "tension",
            "of = \"strenght\", modulus = 12",
            "did you mean \"strength\"?",
        ),
        (
            "tension",
            "of = \"fracture-energy\", modulus = 12",
            "fracture.scatter.of: no criterion takes the fracture energy, so that nothing varies: take \"strength\"",
        ),
        (
            "critical-stretch",
            "of = \"strength\", modulus = 12",
            "fracture.scatter.of: no criterion has a limit from a strength or of its own, so that nothing varies: take \"fracture-energy\"",
        ),
    ];
    for (kind, keys, message) in cases {
        let found = error_of_scatter(kind, keys);
        assert!(found.contains(message), "{keys}: {found}");
    }
    let both = |energy: &str| {
        let strength = "{ of = \"strength\", modulus = 12 }";
        let criteria = "criterion = [{ kind = \"tension\", after = \"linear\" }]";
        error_of(with(&format!(
            "scatter = [{strength}, {{ {energy} }}]\n{criteria}\n"
        )))
    };
    for (keys, message) in [
        (
            "of = \"strength\", modulus = 9",
            "fracture.scatter.1.of: it varies at random already: take \"fracture-energy\"",
        ),
        ("of = \"fracture-energy\"", "missing key `modulus`"),
        (
            "of = \"fracture-energy\", modulus = 0.1",
            "fracture.scatter.1.modulus: must be 1 to 10000, found 0.1",
        ),
        (
            "of = \"fracture-energy\", modulos = 9",
            "did you mean `modulus`?",
        ),
    ] {
        let found = both(keys);
        assert!(found.contains(message), "{keys}: {found}");
    }
}
