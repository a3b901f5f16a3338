//! Pre-cracks by their corners, and straight ones by centre, length and angle.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::path::{Path, PathBuf};

use ligament::body::{AnyBody, Points};
use ligament::setup::PreCrack;
use ligament_case::case::CaseFile;
use ligament_run::model::build_model;
use ligament_run::progress::{Progress, ProgressMode};
use ligament_run::stages::Stages;

const TEXT: &str = include_str!("../../ligament-case/tests/data/brazilian-disk.toml");
const POINTS: &str = "points = [[-0.015, 0.0], [0.015, 0.0]]";

/// The case with other keys in its pre-crack, with overrides.
fn with(keys: &str, overrides: &[&str]) -> Result<CaseFile, String> {
    assert!(TEXT.contains(POINTS));
    let overrides: Vec<String> = overrides.iter().map(|it| (*it).to_owned()).collect();
    let text = TEXT.replacen(POINTS, keys, 1);
    CaseFile::parse(Path::new("case.toml"), text, &overrides).map_err(|error| error.to_string())
}

fn crack(keys: &str, overrides: &[&str]) -> PreCrack {
    let body = Points::new(vec![[0.0; 2]], vec![1.0]).unwrap();
    let setup = with(keys, overrides).unwrap().setup_on(AnyBody::from(body));
    setup.unwrap().precracks.remove(0)
}

#[test]
fn a_straight_crack_has_two_ends() {
    let given = crack("centre = [0.5, 0.25]\nlength = 0.5\nangle = 0.0", &[]);
    assert_eq!(given.line(), [[0.25, 0.25], [0.75, 0.25]]);
    // 3-4-5: atan(4/3), from the lower left to the upper right.
    let given = crack(
        "centre = [0, 0]\nlength = 10\nangle = 0.9272952180016122",
        &[],
    );
    for (end, expected) in given.line().iter().zip([[-3.0, -4.0], [3.0, 4.0]]) {
        for (value, expected) in end.iter().zip(expected) {
            assert!((value - expected).abs() < 1e-14, "{value} for {expected}");
        }
    }
    let straight = "centre = [0, 0]\nlength = 0.03\nangle = 0.0";
    let upright = crack(straight, &["precrack.0.angle=1.5707963268"]);
    assert_eq!(upright.line(), [[0.0, -0.015], [0.0, 0.015]]);
}

#[test]
fn a_resolved_case_keeps_what_was_given() {
    let case = with("centre = [0.01, 0.0]\nlength = 0.03\nangle = 0.6", &[]).unwrap();
    let resolved = case.resolved_toml().unwrap();
    let back = CaseFile::parse(Path::new("case.resolved.toml"), resolved.clone(), &[]).unwrap();
    assert_eq!(back.case, case.case);
    let crack = &back.case.precracks[0];
    assert_eq!(
        (crack.centre, crack.length, crack.angle),
        (Some([0.01, 0.0].into()), Some(0.03), Some(0.6))
    );
    assert!(!resolved.contains("points"), "{resolved}");
}

#[test]
fn faults_name_the_key() {
    for (keys, expected) in [
        (
            "ends = \"included\"",
            "19:1: precrack.0: needs exactly one of `points`, `centre`, `group`; found none",
        ),
        (
            "points = [[0, 0], [1, 0]]\nangle = 0.5",
            "21:9: precrack.0.angle: `angle` does not apply with `points`: a pre-crack has the corners of a polyline, or \
             `centre`, `length` and `angle` of a straight line, or a group of curves; remove it",
        ),
        (
            "centre = [0, 0]\nlength = 0.03",
            "19:1: precrack.0.angle: missing key `angle` in [[precrack]] (in rad)",
        ),
        (
            "angle = 0.5",
            "19:1: precrack.0.centre: missing key `centre` in [[precrack]] (in m)",
        ),
        (
            "centre = [0, 0]\nlength = 0\nangle = 0.5",
            "21:10: precrack.0.length: must be greater than 0, found 0.0",
        ),
        (
            "centre = [0, 0]\nlength = \"3 cm\"\nangle = 0.5",
            "21:10: precrack.0.length: expected a number, found the string \"3 cm\"; values are plain numbers in SI units, here m",
        ),
        (
            "centre = [0, 0]\nlength = 0.03\nangle = \"30 deg\"",
            "22:9: precrack.0.angle: expected a number, found the string \"30 deg\"; values are plain numbers in SI units, here rad",
        ),
        (
            "centre = [1e9, 0]\nlength = 1e-9\nangle = 0",
            "21:10: precrack.0.length: must be so large that the ends differ in the digits of their coordinates, found 1e-9",
        ),
        (
            "center = [0, 0]",
            "20:1: precrack.0.center: unknown key `center` in [[precrack]]; did you mean `centre`? valid keys: `points`, \
             `centre`, `length`, `angle`, `normal`, `radius`, `group`, `ends`",
        ),
    ] {
        let error = with(keys, &[]).unwrap_err();
        assert_eq!(error, format!("case.toml:{expected}"));
    }
    let error = with(POINTS, &["precrack.0.angle=0.5"]).unwrap_err();
    assert!(
        error.starts_with(
            "--set precrack.0.angle=0.5: precrack.0.angle: `angle` does not apply with `points`"
        ),
        "{error}"
    );
}

/// Ends of all bonds that are left.
fn bonds(path: &Path, text: String) -> Vec<[u32; 2]> {
    // The correction changes no bond.
    let settings = ["correction={ surface = \"none\" }".to_owned()];
    let case = CaseFile::parse(path, text, &settings).unwrap();
    let model = build_model(
        &case,
        &mut Stages::default(),
        &Progress::new(ProgressMode::Quiet),
    )
    .unwrap();
    assert!(model.cut_bonds() > 100, "{}", path.display());
    model.plane().bonds.ends.to_vec()
}

/// The slots of the disk and of the plate, written out in their cases to a micrometre, cut the same bonds as by centre, length
/// and angle: those are the angles from y in the disk, from x in the plate.
#[test]
fn slots_by_angle_cut_the_same_bonds() {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../..");
    let slots = [0.0, 30.0, 45.0, 60.0, 90.0].map(|it| {
        let file = format!("cases/slotted-disk/slot-{it:02}.toml");
        (file, 0.03, 90.0 - it)
    });
    let inclined = [0.0, 15.0, 30.0, 45.0, 62.5].map(|it| {
        let file = format!("cases/inclined-slot-plate/plate-{it:02}.toml");
        (file, 0.045, it)
    });
    for (file, length, degrees) in slots.into_iter().chain(inclined) {
        let path = root.join(&file);
        let text = std::fs::read_to_string(&path).unwrap();
        let line = text.lines().find(|it| it.starts_with("points = ")).unwrap();
        let angle = f64::to_radians(degrees);
        let straight = format!("centre = [0.0, 0.0]\nlength = {length:?}\nangle = {angle:?}");
        let by_angle = bonds(&path, text.replacen(line, &straight, 1));
        assert_eq!(by_angle, bonds(&path, text), "{file}");
    }
}
