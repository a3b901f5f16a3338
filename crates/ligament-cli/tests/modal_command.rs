//! A modal run, from the case to its files.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::fs;
use std::path::Path;
use std::process::Command;

const MODAL: &str = include_str!("../../ligament-case/tests/data/modal-plate.toml");

/// A plate of 80 points: files, their columns and the numbers that must agree among them.
#[test]
fn a_modal_run_writes_its_modes() {
    let folder = tempfile::tempdir().unwrap();
    let mesh = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../meshes/plate-coarse.msh");
    let path = folder.path().join("case.toml");
    fs::write(&path, MODAL).unwrap();
    let setting = format!("mesh.file={}", mesh.display());
    let call = |command: &str, more: &[&str]| {
        let output = Command::new(env!("CARGO_BIN_EXE_ligament"))
            .args([command, path.to_str().unwrap(), "--set", &setting])
            .args(more)
            .output()
            .unwrap();
        let text = String::from_utf8(output.stdout).unwrap();
        let errors = String::from_utf8(output.stderr).unwrap();
        (output.status.success(), text, errors)
    };
    let out = folder.path().join("out");
    let to_out = [
        "--set",
        "modal.modes=4",
        "--out",
        out.to_str().unwrap(),
        "--quiet",
    ];
    let (done, shown, errors) = call("run", &to_out);
    assert!(done, "{errors}");
    assert!(
        shown.contains("frequency, Hz") && shown.contains("no mode below"),
        "{shown}"
    );

    let table = fs::read_to_string(out.join("modes.csv")).unwrap();
    let mut rows = table.lines();
    assert_eq!(
        rows.next().unwrap(),
        "mode,kind,frequency_hz,angular_frequency,eigenvalue,residual,effective_mass_x,effective_mass_y,\
         effective_inertia,share_x,share_y,share_inertia,participation_x,participation_y,participation_rotation"
    );
    let summary: serde_json::Value =
        serde_json::from_str(&fs::read_to_string(out.join("summary.json")).unwrap()).unwrap();
    let modes = summary["modes"].as_array().unwrap();
    assert_eq!(
        (modes.len(), summary["complete"].as_bool()),
        (4, Some(true))
    );
    for (row, mode) in rows.zip(modes) {
        let cells: Vec<&str> = row.split(',').collect();
        assert_eq!(
            (cells[0], cells[1]),
            (mode["mode"].to_string().as_str(), "elastic")
        );
        let number = |column: usize| cells[column].parse::<f64>().unwrap();
        assert_eq!(Some(number(2)), mode["frequency"].as_f64());
        let omega = number(2) * std::f64::consts::TAU;
        assert!((number(3) / omega - 1.0).abs() < 1e-14);
        assert!((number(3).powi(2) / number(4) - 1.0).abs() < 1e-14);
    }
    let collection = fs::read_to_string(out.join("modes.pvd")).unwrap();
    for mode in 1..=4 {
        let file = format!("mode_{mode:04}.vtu");
        assert!(
            collection.contains(&format!("timestep=\"{mode}.0\"")) && collection.contains(&file)
        );
        let fields = fs::read_to_string(out.join(file)).unwrap();
        for field in [
            "displacement",
            "rotation",
            "strain_energy_density",
            "horizon",
        ] {
            assert!(fields.contains(&format!("Name=\"{field}\"")), "{field}");
        }
    }
    assert!(!out.join("history.csv").exists());

    let (done, shown, errors) = call("check", &["--all"]);
    assert!(done, "{errors}");
    for line in [
        "\nsupports\n",
        "rotations             with inertia",
        "\nequations\n",
    ] {
        assert!(shown.contains(line), "{line}: {shown}");
    }

    let all = [
        "--set",
        "support=[{box=[[-1,-1],[1,1]],displacement={x=0,y=0,rotation=0}}]",
    ];
    let nowhere = folder.path().join("nowhere");
    let to_nowhere = [&all[..], &["--out", nowhere.to_str().unwrap()]].concat();
    let (done, _, errors) = call("run", &to_nowhere);
    assert!(
        !done && errors.contains("supports hold every degree of freedom"),
        "{errors}"
    );
    assert!(!nowhere.exists(), "nothing is written");
}
