//! Records of studies and calibrations, which later ones go on from.

use std::fs;
use std::path::Path;

use ligament_output::summary::Build;
use ligament_run::progress::ProgressMode;
use ligament_run::run::run;
use ligament_study::calibrate::{self, calibrate};
use ligament_study::sweep::study::Study;
use ligament_study::sweep::{self, Task, open_folder, plan, sweep};
use serde_json::json;

use crate::Target;
use crate::folder::Folder;
use crate::results::small_bar;

const STUDY: &str = r#"title = "Small bars"
case = "case.toml"
[[axis]]
key = "model.horizon_factor"
values = [2.2, 2.6]
[[result]]
name = "ratio"
of = "first_peak.reaction"
over = 3.0
[[plot]]
x = "model.horizon_factor"
y = "ratio"
fit = { from = 2.0, to = 3.0 }
"#;

/// A study that is done and a calibration, with their case beside them; one file of these is another.
pub(crate) struct Records {
    beside: tempfile::TempDir,
    folder: Folder,
}

impl Records {
    pub(crate) fn new() -> Self {
        let beside = tempfile::tempdir().unwrap();
        small_bar(beside.path());
        let study = beside.path().join("study.toml");
        fs::write(&study, STUDY).unwrap();
        let out = beside.path().join("out");
        finish_study(&study, &out.join("sweep"));
        calibrate_bar(&calibration(beside.path())).unwrap();
        let records = Self {
            beside,
            folder: Folder::read(out),
        };
        records.collect().unwrap();
        records.go_on().unwrap();
        records
    }

    /// Makes tables and plots of the study.
    fn collect(&self) -> anyhow::Result<()> {
        let request = |task| sweep::Request {
            study: self.beside.path().join("study.toml"),
            out: Some(self.folder.path().join("sweep")),
            task,
        };
        sweep(&request(Task::List), &mut Vec::new())?;
        sweep(&request(Task::Collect(Vec::new())), &mut Vec::new())
    }

    /// Goes on with the calibration.
    fn go_on(&self) -> anyhow::Result<()> {
        calibrate_bar(&calibration(self.beside.path()))
    }
}

/// Does the runs of a study in this process, as those that `ligament sweep` starts would.
fn finish_study(study: &Path, out: &Path) {
    let study = Study::load(study).unwrap();
    let runs = plan::runs(&study, out).unwrap();
    open_folder(out, &study).unwrap();
    for it in &runs {
        let results = out.join("runs").join(&it.name);
        run(&it.case, &results, false, ProgressMode::Quiet).unwrap();
        let record = json!({
            "version": env!("CARGO_PKG_VERSION"),
            "settings": it.overrides,
            "inputs": it.inputs.text(),
            "failed": null,
        });
        let path = out.join("records").join(format!("{}.json", it.name));
        fs::write(path, record.to_string()).unwrap();
    }
}

/// The calibration of the strength in two runs at most.
fn calibration(beside: &Path) -> calibrate::Request {
    calibrate::Request {
        case: beside.join("case.toml"),
        overrides: Vec::new(),
        threads: Some(1),
        key: "material.tensile_strength".to_owned(),
        of: "first_break.reaction".to_owned(),
        target: 20_000.0,
        within: 0.01,
        from: Some(1e5),
        to: Some(1e7),
        most_runs: 3,
        out: beside.join("out/calibration"),
        force: false,
        build: Build::default(),
    }
}

fn calibrate_bar(request: &calibrate::Request) -> anyhow::Result<()> {
    calibrate(request, &mut Vec::new(), &mut Vec::new())
}

impl Target for Records {
    fn name(&self) -> &'static str {
        "record"
    }

    fn seeds(&self) -> Vec<Vec<u8>> {
        let is_field = |name: &str| name.ends_with(".vtu") || name.ends_with(".pvd");
        self.folder.seeds(|name| !is_field(name))
    }

    fn words(&self) -> &'static [&'static str] {
        &[
            "null",
            "true",
            "{}",
            "[]",
            "\"\"",
            ",",
            ":",
            "1e999",
            "\"failed\":\"\\u001b[2J\"",
        ]
    }

    fn read(&mut self, input: &[u8]) -> bool {
        if !self.folder.make(input) {
            return false;
        }
        let [collected, calibrated] = [self.collect(), self.go_on()].map(|it| it.is_ok());
        collected && calibrated
    }
}
