//! Laws, materials with axes and corrections: what does not go together is refused, with its place.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::path::Path;

use ligament_case::case::CaseFile;

const TEXT: &str = include_str!("data/brazilian-disk.toml");

/// The error of the case with `old` replaced by `new`, without the path before it.
fn error_with(old: &str, new: &str) -> String {
    assert!(TEXT.contains(old), "the case has no `{old}`");
    error_of(&TEXT.replacen(old, new, 1))
}

fn error_of(text: &str) -> String {
    let error = CaseFile::parse(Path::new("case.toml"), text.to_owned(), &[]).unwrap_err();
    let message = error.to_string();
    message.strip_prefix("case.toml:").unwrap().to_owned()
}

/// The material of the case with axes.
const AXES: &str = "young_1 = 15e9\nyoung_2 = 5e9\npoisson_12 = 0.25\nshear_modulus = 4.8e9\n";

#[test]
fn materials_with_axes_need_their_law_and_all_constants() {
    let isotropic = "young = 15e9\npoisson = 0.21\n";
    assert_eq!(
        error_with(isotropic, AXES),
        "7:1: material: an orthotropic material needs model.law = \"orthotropic\" or \"mbb-pd\": \"nhpd\" is a law for isotropic ones"
    );
    let with_law = |plane: &str, axes: &str| {
        let text = TEXT
            .replace(isotropic, axes)
            .replace("law = \"nhpd\"", "law = \"orthotropic\"")
            .replace("rule = \"sum\"", "")
            .replace("thickness = 0.02", plane);
        error_of(&text)
    };
    assert_eq!(
        with_law("plane = \"strain\"", AXES),
        "7:1: material.young_3: missing key `young_3`: it is required because of plane strain"
    );
    assert_eq!(
        with_law("", &format!("{AXES}poisson_13 = 0.2\n")),
        "7:1: material.young_3: missing key `young_3`: it is required because the other constants across the plane are given"
    );
    assert_eq!(
        with_law("", &AXES.replace("0.25", "1.8")),
        "10:14: material.poisson_12: must be so small that every strain costs energy (nu_12^2 < E_1/E_2, and the like across \
         the plane), found 1.8"
    );
    assert_eq!(
        with_law("", &AXES.replace("shear_modulus = 4.8e9\n", "")),
        "7:1: material.shear_modulus: missing key `shear_modulus` in [material] (in Pa)"
    );
    assert_eq!(
        with_law("", AXES),
        "7:1: material: `tensile_strength` gives limits of isotropic materials only, and the criterion \"strength\" of [fracture] \
         takes them from it: take \"tension\", \"compression\" or \"sliding\" with a `limit`"
    );
    assert_eq!(
        error_with("young = 15e9\n", "group = \"rock\"\nyoung = 15e9\n"),
        "8:9: material.group: the one [material] fills the whole body: for a part write [material.NAME]"
    );
}

#[test]
fn keys_that_a_law_or_a_correction_does_not_leave_open_are_refused() {
    assert_eq!(
        error_with(
            "law = \"nhpd\"",
            "law = \"nhpd\"\ncalibration = \"discrete\""
        ),
        "14:15: model.calibration: `calibration` does not apply with law = \"nhpd\": its constants are those of the paper; \
         remove it"
    );
    assert_eq!(
        error_with(
            "law = \"nhpd\"",
            "law = \"pds\"\nrotational_stiffness = \"beam\""
        ),
        "14:24: model.rotational_stiffness: `rotational_stiffness` does not apply with law = \"pds\": the law determines it; \
         remove it"
    );
    assert_eq!(
        error_with("[correction]", "[correction]\nsurface = \"volume\""),
        "18:8: correction.rule: `rule` does not apply with surface = \"volume\": only the domain correction is \
         iterated; remove it"
    );
    assert_eq!(
        error_with("[correction]", "[correction]\nsmallest_factor = 0.1"),
        "17:19: correction.smallest_factor: `smallest_factor` does not apply with surface = \"domain\": only the patch correction \
         has it; remove it"
    );
    assert_eq!(
        error_with("[correction]", "[correction]\nsurface = \"patch\""),
        "18:8: correction.rule: `rule` does not apply with surface = \"patch\": only the domain correction is iterated; remove it"
    );
    let cracked = "surface = \"patch\"\ndomain = \"cracked\"";
    assert_eq!(
        error_with("rule = \"sum\"", cracked),
        "18:10: correction.domain: the cells of the body do not contain its pre-cracks: take \"whole\""
    );
    let beam = TEXT
        .replace("law = \"nhpd\"", "law = \"mppd-beam\"")
        .replace("rule = \"sum\"", "surface = \"volume\"");
    assert_eq!(
        error_of(&beam),
        "17:11: correction.surface: the discrete calibration already accounts for surfaces: take \"none\", or \
         model.calibration = \"integral\""
    );
}

/// The size of the rotational stiffness belongs to laws whose points turn, has one key, and a range.
#[test]
fn the_size_of_the_rotational_stiffness_is_refused_by_name() {
    let of_law =
        |law: &str, lines: &str| error_with("law = \"nhpd\"", &format!("law = \"{law}\"\n{lines}"));
    for law in ["bbpd", "bbpd-conical", "pds"] {
        assert_eq!(
            of_law(law, "rotational_factor = 2.0"),
            format!(
                "14:21: model.rotational_factor: `rotational_factor` does not apply with law = \"{law}\": its points have no \
                 rotations; remove it"
            )
        );
    }
    assert_eq!(
        of_law("pds", "cosserat_length = 1e-3"),
        "14:19: model.cosserat_length: `cosserat_length` does not apply with law = \"pds\": its points have no rotations; remove it"
    );
    assert_eq!(
        of_law(
            "mppd",
            "rotational_stiffness = \"none\"\nrotational_factor = 2.0"
        ),
        "15:21: model.rotational_factor: `rotational_factor` does not apply with rotational_stiffness = \"none\": there is no rotational \
         stiffness to scale; remove it"
    );
    assert_eq!(
        of_law("nhpd", "rotational_factor = 2.0\ncosserat_length = 1e-3"),
        "15:19: model.cosserat_length: `cosserat_length` does not apply with rotational_factor: both scale the rotational stiffness; \
         remove it"
    );
    assert_eq!(
        of_law("nhpd", "rotational_factor = -1.0"),
        "14:21: model.rotational_factor: must be at least 0, found -1.0"
    );
    assert_eq!(
        of_law("nhpd", "cosserat_length = 0.0"),
        "14:19: model.cosserat_length: must be greater than 0, found 0.0"
    );
}

/// With a negative shear stiffness a positive rotational one makes some wave of rotations cost nothing.
#[test]
fn a_cosserat_length_needs_a_shear_stiffness_that_is_not_negative() {
    let of_poisson = |poisson: &str| {
        TEXT.replace("poisson = 0.21", &format!("poisson = {poisson}"))
            .replace(
                "law = \"nhpd\"",
                "law = \"nhpd\"\npoisson = \"bonds\"\ncosserat_length = 1e-3",
            )
    };
    assert_eq!(
        error_of(&of_poisson("0.4")),
        "15:19: model.cosserat_length: the shear stiffness of some bonds is negative (k_t H^3 t = -6.8209e9 Pa), and a length makes \
         their rotational stiffness positive, so that waves of rotation would cost nothing: take a factor, whose sign is that of the \
         shear stiffness, or a smaller Poisson's ratio"
    );
    CaseFile::parse(Path::new("case.toml"), of_poisson("0.3"), &[]).unwrap();
}
