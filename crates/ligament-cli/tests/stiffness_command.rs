//! Calls of `ligament stiffness`.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::f64::consts::PI;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn case() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cases/bond-stiffness/case.toml")
}

fn stiffness(out: &Path, settings: &[&str]) -> Output {
    stiffness_of(&case(), out, settings)
}

fn stiffness_of(case: &Path, out: &Path, settings: &[&str]) -> Output {
    let settings = settings.iter().flat_map(|setting| ["--set", setting]);
    Command::new(env!("CARGO_BIN_EXE_ligament"))
        .arg("stiffness")
        .arg(case)
        .args(settings)
        .args(["--out", out.to_str().unwrap()])
        .output()
        .unwrap()
}

/// Rows of the table: direction, k_n, k_t, k_theta, C_xx, C_ss.
fn rows(out: &Path) -> Vec<[f64; 6]> {
    let text = fs::read_to_string(out.join("stiffness.csv")).unwrap();
    let row = |line: &str| {
        let mut cells = line.split(',').skip(1).map(|cell| cell.parse().unwrap());
        [(); 6].map(|()| cells.next().unwrap())
    };
    text.lines().skip(1).map(row).collect()
}

/// OMPPD eqs 50 to 53 along the axes, of the material of the case with H = 16 mm and t = 1 mm; k_theta at l = H/2 is k_t l/4.
#[test]
fn along_the_axes_it_is_the_printed_constants() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let output = stiffness(&out, &[]);
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let rows = rows(&out);
    assert_eq!(rows.len(), 181);
    let unit = 12.0 / (PI * 1e-3 * 0.016_f64.powi(3));
    let reduced = 1.0 - 0.25 * 0.0625;
    let [c11, c12, c22, c66] = [200e9 / reduced, 12.5e9 / reduced, 50e9 / reduced, 50e9];
    let shear = 0.25 * unit * (8.0 * c66 - c11 - c22 - 2.0 * c12);
    for (row, axial, modulus) in [(0, unit * (c11 - c66), c11), (90, unit * (c22 - c66), c22)] {
        let expected = [row as f64, axial, shear, 0.25 * 0.008 * shear, modulus, c66];
        for (found, expected) in rows[row].iter().zip(expected) {
            // The difference of C_22 and C_66 loses two digits.
            assert!(
                (found - expected).abs() <= 1e-12 * expected.abs().max(1.0),
                "{found} {expected}"
            );
        }
    }
    for name in ["k-n-body.svg", "k-t-body.svg"] {
        assert!(fs::read_to_string(out.join(name)).unwrap().contains("<svg"));
    }
    let again = stiffness(&out, &[]);
    assert_eq!(again.status.code(), Some(1));
}

/// A group may have any name, but the name of a file must not lead elsewhere.
#[test]
fn a_material_with_a_name_that_is_no_file_name_gets_its_number() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let text = fs::read_to_string(case()).unwrap();
    let text = (text.replace("base = {", "\"../left\" = { left = 12 }, base = {"))
        .replace("[material]", "[material.all]\ngroup = \"../left\"");
    let case = folder.path().join("case.toml");
    fs::write(&case, text).unwrap();
    let output = stiffness_of(&case, &out, &[]);
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{message}");
    let mut names: Vec<_> = (fs::read_dir(&out).unwrap())
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|name| name.ends_with(".svg"))
        .collect();
    names.sort();
    assert_eq!(names, ["k-n-material-1.svg", "k-t-material-1.svg"]);
    let table = fs::read_to_string(out.join("stiffness.csv")).unwrap();
    assert!(table.lines().nth(1).unwrap().starts_with("../left,"));
}

/// Isotropic bonds are the same in all directions, with a negative k_t above Poisson's ratio 1/3; a Cosserat length needs no k_t for its
/// size.
#[test]
fn isotropic_laws_have_no_direction() {
    let folder = tempfile::tempdir().unwrap();
    for (law, poisson, sign) in [("nhpd", 0.2, 1.0), ("mppd", 0.4, -1.0), ("bbpd", 0.2, 0.0)] {
        let out = folder.path().join(law);
        let material = format!("material={{ young = 70e9, poisson = {poisson} }}");
        let by_bonds = "model.poisson=bonds";
        let law = format!("model.law={law}");
        let output = stiffness(&out, &[&material, &law, by_bonds]);
        assert!(
            output.status.success(),
            "{}",
            String::from_utf8_lossy(&output.stderr)
        );
        let rows = rows(&out);
        for row in &rows {
            for quantity in [1, 2, 3] {
                assert_eq!(row[quantity], rows[0][quantity], "{law}");
            }
            let is_sign = if sign == 0.0 {
                row[2] == 0.0
            } else {
                row[2] * sign > 0.0
            };
            assert!(is_sign, "{law}: {}", row[2]);
        }
    }
}

#[test]
fn what_has_no_such_stiffness_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let output = stiffness(&out, &["model.law=mbb-pd"]);
    assert_eq!(output.status.code(), Some(1));
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(
        message.contains("have no k_n, k_t and k_theta: take another law"),
        "{message}"
    );
    assert!(!out.exists());
}
