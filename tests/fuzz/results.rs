//! Results of runs as other commands read them back.

use std::fs;
use std::path::{Path, PathBuf};

use ligament_case::case::CaseFile;
use ligament_cli::explain::{self, Position, Subject};
use ligament_plot::picture::Target as Picture;
use ligament_plot::picture::curve::{CurveRequest, draw_curves};
use ligament_plot::picture::select::Choice;
use ligament_plot::picture::{
    CrackDrawing, FieldRequest, Magnification, SolidRequest, draw_fields,
};
use ligament_run::progress::ProgressMode;
use ligament_run::run::run;
use ligament_study::calibrate::line;

use crate::Target;
use crate::folder::Folder;

const CASE: &str = r#"title = "Small bar"
[lattice]
cells = [8, 4]
spacing = 0.01
[lattice.set]
left = { left = 1 }
right = { right = 1 }
[material]
young = 1e9
poisson = 0.2
tensile_strength = 1e6
[model]
law = "nhpd"
horizon_factor = 2.2
[[support]]
group = "left"
displacement = { x = 0.0, y = 0.0 }
[[load]]
group = "right"
displacement = { x = 2e-4 }
[fracture]
steps = 4
stop = { load_fraction = 0.5 }
[output]
fields_every = 1
bonds = true
"#;

/// The case of a small bar that breaks, beside whose file its results may lie.
pub(crate) fn small_bar(folder: &Path) -> CaseFile {
    let path = folder.join("case.toml");
    fs::write(&path, CASE).unwrap();
    CaseFile::load(&path, &[]).unwrap()
}

const TABLE: &str = "run,model.horizon_factor,mesh.file,status,first_peak.reaction,case.material.tensile_strength\n\
                     1,2.5,a.msh,done,600000,1e6\n2,3,a.msh,done,720000,1e6\n3,3.5,b.msh,failed,,1e6\n4,4,a.msh,done,9e5,1e6\n";

/// The results of a run, one file of which is another.
pub(crate) struct Results {
    beside: tempfile::TempDir,
    folder: Folder,
}

impl Results {
    pub(crate) fn new() -> Self {
        let beside = tempfile::tempdir().unwrap();
        let out = beside.path().join("out");
        run(&small_bar(beside.path()), &out, false, ProgressMode::Quiet).unwrap();
        fs::write(out.join("table.csv"), TABLE).unwrap();
        let results = Self {
            beside,
            folder: Folder::read(out),
        };
        assert_eq!(
            results.complaints(),
            [""; 0],
            "the results themselves are read"
        );
        results
    }

    fn out(&self) -> PathBuf {
        self.folder.path().to_owned()
    }

    /// What the readers complain of.
    fn complaints(&self) -> Vec<String> {
        [self.explain(), self.draw(), self.calibrate()].concat()
    }

    fn explain(&self) -> Vec<String> {
        let subjects = [
            Subject::Point(5),
            Subject::At(Position::InPlane([0.02, 0.01])),
            Subject::Bond([5, 6]),
        ];
        let explained = subjects.map(|subject| {
            let request = explain::Request {
                folder: self.out(),
                subject,
                csv: None,
                json: None,
                force: false,
            };
            let mut told = Vec::new();
            explain::explain(&request, &mut told).map_err(|it| it.to_string())?;
            let told = String::from_utf8(told).unwrap();
            let numbers = told.split(|it: char| it.is_whitespace() || "(),;=:".contains(it));
            let wrong = ["nan", "-nan", "inf", "-inf"];
            let is_wrong = |it: &str| wrong.contains(&it.to_lowercase().as_str());
            assert!(!numbers.into_iter().any(is_wrong), "{told}");
            Ok(())
        });
        explained.into_iter().filter_map(Result::err).collect()
    }

    fn draw(&self) -> Vec<String> {
        let target = || Picture {
            out: Some(self.beside.path().join("picture.svg")),
            format: None,
            width: None,
            dpi: Some(100.0),
            force: true,
        };
        let fields = draw_fields(&FieldRequest {
            folders: vec![self.out()],
            labels: Vec::new(),
            field: None,
            choice: Choice::Default,
            magnification: Magnification::Auto,
            crack: Some(CrackDrawing::Bonds),
            lines: Vec::new(),
            window: None,
            bands: None,
            range: None,
            map: None,
            columns: None,
            solid: SolidRequest::default(),
            target: target(),
        });
        let curves = draw_curves(&CurveRequest {
            folders: vec![self.out()],
            labels: Vec::new(),
            x: Some("displacement".to_owned()),
            y: vec!["reaction".to_owned()],
            target: target(),
        });
        let drawn = [fields, curves].map(|it| it.map_err(|it| it.to_string()));
        drawn.into_iter().filter_map(Result::err).collect()
    }

    fn calibrate(&self) -> Vec<String> {
        let lines = line::lines(&line::Request {
            table: self.out().join("table.csv"),
            x: "model.horizon_factor".to_owned(),
            of: "first_peak.reaction".to_owned(),
            by: vec!["mesh.file".to_owned()],
            over: [f64::NEG_INFINITY, f64::INFINITY],
            at: vec![2.5],
            key: "material.tensile_strength".to_owned(),
            target: 6e5,
        });
        let case = CaseFile::load(&self.out().join("case.resolved.toml"), &[]);
        let complaints = [
            lines.err().map(|it| it.to_string()),
            case.err().map(|it| it.to_string()),
        ];
        complaints.into_iter().flatten().collect()
    }
}

impl Target for Results {
    fn name(&self) -> &'static str {
        "results"
    }

    fn seeds(&self) -> Vec<Vec<u8>> {
        self.folder.seeds(|_| true)
    }

    fn words(&self) -> &'static [&'static str] {
        &[
            ",",
            "\"",
            "nan",
            "<DataArray ",
            "NumberOfComponents=\"3\" ",
            "</VTKFile>",
            "AAAA",
        ]
    }

    fn read(&mut self, input: &[u8]) -> bool {
        self.folder.make(input) && self.complaints().is_empty()
    }
}
