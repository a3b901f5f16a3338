//! Every result file holds what the program has in memory, number for number, to VTK, PyVista, meshio and Python's csv.
//!
//! Each case is run twice: by the program, which writes its results, and in memory, where an observer of this test keeps the
//! arrays (the same input gives the same bits). `compare.py` reads the files with every reader and compares. It also says which
//! fields could be permuted or exchanged unnoticed because they never vary, and fails if there are any.
#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

mod bodies;
mod expected;
mod recorder;
mod softening;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use ligament::Loading;
use ligament::run::follow;
use ligament_case::case::CaseFile;
use ligament_cli::check::{self, CheckExtent, Lines};
use ligament_model::failure::Criteria;
use ligament_model::failure::frictional::Calibration;
use ligament_post::yielding::field::families;
use ligament_run::model::{Model, build_model};
use ligament_run::progress::{Progress, ProgressMode};
use ligament_run::run;
use ligament_run::stages::Stages;
use ligament_study::yielding::subject::Strain;
use ligament_study::yielding::{self, Families, Request};
use verification::meshes;
use verification::numbers::by_point;

use bodies::{Canvas, Squares};
use expected::{Entry, Expected, Rows};
use recorder::Recorder;

/// A case in a folder of its own; its results go to `results` beside it.
struct Case {
    folder: PathBuf,
    file: CaseFile,
    mesh: Option<PathBuf>,
}

impl Case {
    fn new(root: &Path, name: &str, squares: Option<Squares>, text: &str) -> Self {
        let folder = root.join(name);
        fs::create_dir(&folder).unwrap();
        let mesh = squares.map(|squares| {
            let path = folder.join("plate.msh");
            fs::write(&path, meshes::to_gmsh(&bodies::plate(squares))).unwrap();
            path
        });
        let path = folder.join("case.toml");
        fs::write(&path, text).unwrap();
        let file = CaseFile::load(&path, &[]).unwrap_or_else(|error| panic!("{name}: {error}"));
        Self { folder, file, mesh }
    }

    fn results(&self) -> PathBuf {
        self.folder.join("results")
    }

    fn model(&self) -> (Model, Canvas) {
        let (mut stages, progress) = (Stages::default(), Progress::new(ProgressMode::Quiet));
        let model = build_model(&self.file, &mut stages, &progress).unwrap();
        let canvas = Canvas::new(self.mesh.as_deref(), model.body());
        (model, canvas)
    }

    /// Runs it on disk and in memory.
    fn run(&self) {
        run::run(&self.file, &self.results(), false, ProgressMode::Quiet).unwrap();
        let (model, canvas) = self.model();
        let loading = Loading::new(&model).unwrap();
        let problem = loading.problem(&model);
        let mut recorder = Recorder::new(
            &self.file.case,
            (&model, self.mesh.as_deref()),
            &canvas,
            problem.clone(),
        );
        follow(&problem, &model.setup.analysis, &mut recorder).unwrap();
        recorder.finish().write(&self.folder);
    }

    /// Its natural modes on disk and in memory.
    fn vibrate(&self) {
        run::run(&self.file, &self.results(), false, ProgressMode::Quiet).unwrap();
        let (model, canvas) = self.model();
        let outcome = self.file.setup(&mut ()).unwrap().modes().unwrap();
        let mut expected = Expected::new(self.mesh.as_deref(), &model);
        let mut table = Rows::new([
            "mode",
            "kind",
            "frequency_hz",
            "angular_frequency",
            "eigenvalue",
            "residual",
            "effective_mass_x",
            "effective_mass_y",
            "effective_inertia",
            "share_x",
            "share_y",
            "share_inertia",
            "participation_x",
            "participation_y",
            "participation_rotation",
        ]);
        let mut collection = Rows::new(["timestep", "file"]);
        for (number, mode) in (1..).zip(&outcome.modes) {
            let file = format!("mode_{number:04}.vtu");
            let numbers = [
                mode.frequency(),
                mode.angular_frequency(),
                mode.eigenvalue,
                mode.residual,
            ];
            let effective = mode.participation.iter().map(|it| it * it);
            let shares = outcome.moving.shares(&mode.participation);
            let participation = mode.participation.iter().copied();
            let reals = numbers.into_iter().chain(effective).chain(shares);
            let reals = reals.chain(participation);
            let row: [Entry; 2] = [usize::into(number), mode.kind.name().into()];
            table.push(row.into_iter().chain(reals.map(Entry::from)));
            canvas.grid(&file, &mut expected);
            let motions = by_point(model.plane().topology().layout, &mode.shape);
            let moved: Vec<[f64; 3]> = motions.iter().map(|it| [it[0], it[1], 0.0]).collect();
            canvas.displacement(&file, &moved, &mut expected);
            let mut fields = canvas.on(&file, &mut expected);
            fields.reals("rotation", motions.iter().map(|it| it[2]));
            let density = mode.strain_energy_density.iter().copied();
            fields.reals("strain_energy_density", density);
            fields.fixed(&model);
            let numbers = [
                ("TimeValue", number as f64),
                ("frequency_hz", mode.frequency()),
            ];
            expected.field_data(&file, &numbers);
            collection.push([Entry::Real(number as f64), file.as_str().into()]);
        }
        table.into_expected("modes.csv", &mut expected);
        collection.into_expected("modes.pvd", &mut expected);
        expected.write(&self.folder);
    }

    /// What `ligament check --out` writes.
    fn check(&self) {
        let mut said = Vec::new();
        check::check(
            &self.file,
            CheckExtent::Model,
            Some(&self.results()),
            Lines::All,
            &mut said,
        )
        .unwrap();
        let (model, canvas) = self.model();
        let mut expected = Expected::new(self.mesh.as_deref(), &model);
        canvas.grid("points.vtu", &mut expected);
        canvas.on("points.vtu", &mut expected).fixed(&model);
        expected.write(&self.folder);
    }

    /// What `ligament yield --case` writes for the three criteria of the case, with this Poisson's ratio in the plane.
    fn yields(&self, poisson: f64) {
        let request = Request {
            of: Families::Field(Box::new(
                CaseFile::load(&self.file.source.path, &[]).unwrap(),
            )),
            combinations: Vec::new(),
            poisson: None,
            ratio: 3.0,
            calibration: Calibration::Printed,
            out: self.results(),
            force: false,
        };
        yielding::yielding(&request, &mut Vec::new()).unwrap();
        let (model, canvas) = self.model();
        let (system, list) = (model.plane(), &model.criteria.list);
        let alone = |place: usize| Criteria {
            list: vec![list[place].clone()],
        };
        let of = [
            ("strength", alone(0)),
            ("sliding", alone(1)),
            ("compression", alone(2)),
            ("first_of_all", Criteria::clone(&model.criteria)),
        ];
        let mut expected = Expected::new(self.mesh.as_deref(), &model);
        canvas.grid("points.vtu", &mut expected);
        let mut fields = canvas.on("points.vtu", &mut expected);
        for (criterion, criteria) in of {
            for (k, strain) in Strain::in_figures(poisson).into_iter().enumerate() {
                let at = |_: u32| Strain::in_figures(poisson)[k].stretches;
                let found = families(system, &criteria, at);
                let name = |what: &str| format!("{criterion}_{}_{what}", strain.name);
                let values = |of: fn(&ligament_post::yielding::field::FamilyYield) -> f64| {
                    let found = found.iter();
                    let values = found.map(move |it| it.as_ref().map_or(f64::NAN, of));
                    values.map(|it| if it.is_finite() { it } else { f64::NAN })
                };
                fields.reals(&name("error"), values(|it| it.worst.error));
                let orientations = values(|it| it.worst.orientation.to_degrees());
                fields.reals(&name("worst_orientation"), orientations);
                fields.reals(&name("least_strain"), values(|it| it.least_load));
            }
        }
        let inside = model.interior(&model.body().rim());
        fields.integers("interior", inside.iter().map(|&it| i64::from(it)));
        let sizes = (0..system.cloud.len() as u32).map(|it| system.bonds.incidence.at(it).len());
        fields.integers("bonds", sizes.map(|it| it as i64));
        fields.tags(&model);
        expected.write(&self.folder);
    }
}

/// Bonds soften, slide, are crushed and break on a mesh of both kinds of cells, with a pre-crack, a heated part, a part that does not
/// fail, stresses and probes.
const SOFTENING: &str = r#"
mesh = { file = "plate.msh", thickness = 0.02 }
[material.soft]
group = "soft"
young = 9e9
poisson = 0.25
tensile_strength = 2e6
compressive_strength = 5e6
fracture_energy = 20.0
thermal_expansion = 1e-5
[material.hard]
group = "hard"
young = 15e9
poisson = 0.21
tensile_strength = 3.8e6
compressive_strength = 9e6
fracture_energy = 40.0
thermal_expansion = 2e-5
[model]
law = "nhpd"
horizon_factor = 2.5
[[precrack]]
points = [[0.0305, 0.075], [0.0305, 0.062]]
[[temperature]]
group = "soft"
change = 3.0
[[support]]
group = "left"
displacement = { x = 0.0, y = 0.0 }
[[load]]
group = "right"
displacement = { x = 12e-5, y = 4.5e-5 }
[[no_fail]]
group = "left"
[[no_fail]]
group = "right"
[[probe]]
name = "mouth opening"
between = [[0.02, 0.08], [0.04, 0.08]]
component = "x"
[[probe]]
name = "stress"
at = [0.05, 0.04]
field = "stress_virial.xx"
[[probe]]
name = "stress by material"
at = [0.05, 0.04]
field = "stress_principal.2"
[fracture]
steps = 8
bonds_per_iteration = 10
[fracture.scatter]
of = "strength"
modulus = 20.0
correlation_length = 0.02
[[fracture.criterion]]
kind = "tension"
after = "exponential"
[[fracture.criterion]]
kind = "compression"
limit = 2.5e-4
after = "bilinear"
[[fracture.criterion]]
kind = "sliding"
after = "plastic"
[[fracture.criterion]]
kind = "frictional"
[[fracture.criterion]]
kind = "tension"
limit = 4e-3
[output]
fields_every = 3
bonds = true
stress = ["material", "effective", "virial", "traction"]
"#;

/// An elastic plate of triangles that a force pulls, heated, with a material that has axes; it may turn about a corner. Its ratios of Poisson are
/// beyond the limit of pairs in some directions.
const ELASTIC: &str = r#"
mesh = { file = "plate.msh" }
model = { law = "orthotropic", horizon_factor = 2.5, allow_unstable = true }
temperature = [{ group = "soft", change = 5.0 }]
support = [{ at = [0.0, 0.0], displacement = { x = 0.0, y = 0.0, rotation = 0.0 } }]
load = [{ group = "right", force = { x = 1e4, y = 2e3 } }]
output = { bonds = true, stress = ["material", "traction"] }
[material]
young_1 = 40e9
young_2 = 12e9
poisson_12 = 0.25
shear_modulus = 5e9
angle = 0.4
thermal_expansion_1 = 4e-6
thermal_expansion_2 = 2e-5
"#;

/// The exact path on a mesh of quadrangles, down to a fall of the load.
const EVENTS: &str = r#"
mesh = { file = "plate.msh" }
material = { young = 15e9, poisson = 0.21, tensile_strength = 3e6 }
model = { law = "nhpd", horizon_factor = 2.5 }
support = [{ group = "left", displacement = { x = 0.0, y = 0.0 } }]
load = [{ group = "right", displacement = { x = 1e-3 } }]
output = { bonds = true, fields_every = 40, stress = ["material"] }
[fracture]
control = "event"
stop = { load_fraction = 0.3 }
"#;

/// Imaginary elements on a lattice with a hole and a pre-crack, and all constants of the mixed mode.
const LATTICE: &str = r#"
[lattice]
cells = [16, 20]
spacing = [0.001, 0.001]
corner = [0.1, -0.01]
thickness = 0.003
[[lattice.remove]]
name = "hole"
circle = { centre = [0.112, 0.004], radius = 0.0021 }
[lattice.set]
bottom = { bottom = 2 }
top = { top = 2 }
lower = { box = [[0.1, -0.01], [0.116, 0.0]] }
upper = { box = [[0.1, 0.0], [0.116, 0.01]] }
[material.below]
group = "lower"
young_1 = 65e9
young_2 = 40e9
poisson_12 = 0.3
shear_modulus = 20e9
angle = 0.0
fracture_energy = 60.0
fracture_energy_sliding = 100.0
mixed_mode_exponent = 1.5
[material.above]
group = "upper"
young = 50e9
poisson = 0.2
fracture_energy = 45.0
fracture_energy_sliding = 110.0
mixed_mode_exponent = 2.0
[model]
law = "mbb-pd"
horizon_factor = 3.0
[[precrack]]
points = [[0.099, -0.002], [0.1041, -0.002]]
[[support]]
group = "bottom"
displacement = { x = 0.0, y = 0.0 }
[[load]]
group = "top"
displacement = { x = 5e-6, y = 4e-5 }
[[no_fail]]
group = "top"
[[no_fail]]
group = "bottom"
[fracture]
steps = 10
bonds_per_iteration = 20
[output]
fields_every = 5
bonds = true
stress = ["material", "virial"]
"#;

/// A heated lattice that nothing holds, whose material has axes, with stresses of both kinds.
const HEATED_LATTICE: &str = r#"
[lattice]
cells = [9, 7]
spacing = [0.01, 0.01]
[lattice.set]
right = { right = 2 }
[material]
young_1 = 30e9
young_2 = 20e9
poisson_12 = 0.2
shear_modulus = 9e9
angle = 0.5
thermal_expansion_1 = 1e-5
thermal_expansion_2 = 3e-6
[model]
law = "orthotropic"
horizon_factor = 3.2
[[precrack]]
points = [[0.0, 0.03], [0.025, 0.03]]
[[temperature]]
group = "right"
change = 40.0
[fracture]
steps = 3
[[fracture.criterion]]
kind = "tension"
limit = 2e-5
[output]
fields_every = 1
bonds = true
stress = ["material", "virial", "traction"]
"#;

const MODES_OF_A_MESH: &str = r#"
analysis = "modal"
mesh = { file = "plate.msh" }
material = { young = 70e9, poisson = 0.25, density = 2500.0 }
model = { law = "nhpd", horizon_factor = 2.5 }
support = [{ group = "left", displacement = { x = 0.0, y = 0.0, rotation = 0.0 } }]
modal = { modes = 4 }
[[precrack]]
points = [[0.0305, 0.09], [0.0305, 0.035]]
"#;

const MODES_OF_A_LATTICE: &str = r#"
analysis = "modal"
lattice = { cells = [9, 5], spacing = 0.01 }
material = { young = 70e9, poisson = 0.25, density = 2500.0 }
model = { law = "mppd", horizon_factor = 3.0 }
modal = { modes = 5 }
precrack = [{ points = [[0.0305, 0.06], [0.0305, 0.025]] }]
"#;

/// For `ligament yield`: criteria each of which decides somewhere, and a part that does not fail.
const YIELDING: &str = r#"
model = { law = "nhpd", horizon_factor = 2.5 }
support = [{ box = [[-1.0, -1.0], [0.02, 1.0]], displacement = { x = 0.0, y = 0.0 } }]
load = [{ box = [[0.08, -1.0], [1.0, 1.0]], displacement = { x = 1e-4 } }]
no_fail = [{ box = [[0.06, -1.0], [0.1, 0.021]] }]
[fracture]
steps = 1
[[fracture.criterion]]
kind = "strength"
[[fracture.criterion]]
kind = "sliding"
[[fracture.criterion]]
kind = "compression"
[material.weak]
group = "soft"
young = 15e9
poisson = 0.21
tensile_strength = 1e6
compressive_strength = 0.15e6
[material.strong]
group = "hard"
young = 15e9
poisson = 0.21
tensile_strength = 4e6
compressive_strength = 12e6
"#;

fn compare(root: &Path) {
    let python = std::env::var_os("LIGAMENT_PYTHON")
        .expect("set LIGAMENT_PYTHON to a Python with tools/requirements.txt installed");
    let output = Command::new(python)
        .arg(verification::repository().join("tests/result_files/compare.py"))
        .arg(root)
        .output()
        .unwrap();
    let text = String::from_utf8_lossy(&output.stdout);
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{text}{errors}");
    assert!(text.contains("all files hold what"), "{text}{errors}");
}

#[test]
#[ignore = "needs LIGAMENT_PYTHON; run by tools/test"]
fn every_reader_finds_what_the_program_has_in_memory() {
    let root = tempfile::tempdir().unwrap();
    let case = |name, squares, text: &str| Case::new(root.path(), name, squares, text);
    case("softening", Some(Squares::Both), SOFTENING).run();
    case("elastic", Some(Squares::Triangles), ELASTIC).run();
    case("events", Some(Squares::Quadrangles), EVENTS).run();
    case("lattice", None, LATTICE).run();
    case("heated-lattice", None, HEATED_LATTICE).run();
    case("modes", Some(Squares::Both), MODES_OF_A_MESH).vibrate();
    case("modes-of-lattice", None, MODES_OF_A_LATTICE).vibrate();
    case("check", Some(Squares::Both), SOFTENING).check();
    case("check-lattice", None, LATTICE).check();
    let on_mesh = format!("mesh = {{ file = \"plate.msh\" }}{YIELDING}");
    case("yield", Some(Squares::Both), &on_mesh).yields(0.21);
    let lattice = "lattice = { cells = [12, 9], spacing = [0.01, 0.011], set = { \
        soft = { bottom = 5 }, hard = { top = 4 } } }";
    let on_lattice = format!("{lattice}{YIELDING}");
    case("yield-lattice", None, &on_lattice).yields(0.21);
    compare(root.path());
}
