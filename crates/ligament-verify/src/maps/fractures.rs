//! Maps of damage at stages: disks and plates of NHPD (Figs 10 to 12, 15, 16, 18 to 20 and 24), plates of MBB-PD (Figs 14, 16 and 17).

use anyhow::Context;
use ligament::body::Origin;
use ligament::run::Solution;
use ligament_analysis::fields::damage;
use ligament_analysis::history::BreakRecord;
use ligament_output::vtu::Cell;
use ligament_plot::picture::maps::{MappedBody, Maps};

use crate::case_run::CaseRun;
use crate::experiment_file::ExperimentFile;

/// The correction of the paper, and the patch correction, under which uniform strains are in equilibrium.
const CORRECTIONS: [&str; 2] = ["domain", "patch"];

/// Drawn stages, as shares of all breakages.
const STAGES: [(&str, usize); 3] = [
    ("a quarter of the breakages", 4),
    ("half of them", 2),
    ("all", 1),
];

/// Share of the largest load at which runs of the plates of MBB-PD end, when cracks are long.
const END: f64 = 0.1;

/// Name of a case in its experiment, and number of its figure.
type Figure = (&'static str, usize);

const DISKS: [Figure; 3] = [("4 mm", 10), ("3 mm", 11), ("2 mm", 12)];
const SLOTS: [Figure; 5] = [
    ("30", 15),
    ("60", 16),
    ("two", 18),
    ("three", 19),
    ("four", 20),
];
const PLATES: [Figure; 3] = [("central", 14), ("three", 16), ("hole", 17)];

/// All maps of damage.
pub(super) fn maps() -> anyhow::Result<Vec<Maps>> {
    let mut maps = Vec::new();
    let files = ["disk", "slots", "inclined", "cracks"].map(ExperimentFile::read);
    let [disk, slotted, inclined, plates] = files;
    let [disk, slotted, inclined, plates] = [disk?, slotted?, inclined?, plates?];
    let of = |file: &ExperimentFile, correction: &str, labels: &[(&str, &str)]| {
        let all = [&[("correction", correction), ("lambda", "3")], labels].concat();
        file.case_run(&all)
    };
    for (mesh, figure) in DISKS {
        let case_run = |correction| of(&disk, correction, &[("mesh", mesh)]);
        let title = format!("Brazilian disk, lambda = 3, mesh of {mesh}");
        maps.push(crack_stages(figure, title, case_run)?);
    }
    for (case, figure) in SLOTS {
        let case_run = |correction| of(&slotted, correction, &[("slots", case), ("mesh", "2 mm")]);
        let slots = match case.parse::<u32>() {
            Ok(angle) => format!("one slot at {angle} degrees"),
            Err(_) => format!("{case} slots"),
        };
        let title = format!("Disk with {slots}, lambda = 3");
        maps.push(crack_stages(figure, title, case_run)?);
    }
    maps.push(crack_stages(
        24,
        "Plate with an inclined slot, theta = 62.5, lambda = 3".to_owned(),
        |correction| of(&inclined, correction, &[("theta", "62.5")]),
    )?);
    for (case, figure) in PLATES {
        let labels = [("case", case), ("d", "1"), ("criterion", "mixed-mode")];
        let case_run = (plates.case_run(&labels)?).set("fracture.stop.load_fraction", END);
        let run = case_run.solve_with_breakages()?;
        maps.push(Maps {
            name: format!("mbb-figure-{figure}"),
            title: format!("Plate of MBB-PD, {case}, 1 mm"),
            bodies: stages("", &run)?,
            ..damage_maps()
        });
    }
    Ok(maps)
}

/// Stages of a test, a row for each correction.
fn crack_stages(
    figure: usize,
    title: String,
    case_run: impl Fn(&'static str) -> anyhow::Result<CaseRun>,
) -> anyhow::Result<Maps> {
    let mut bodies = Vec::new();
    for correction in CORRECTIONS {
        let run = case_run(correction)?.solve_with_breakages()?;
        bodies.extend(stages(&format!("{correction}: "), &run)?);
    }
    Ok(Maps {
        name: format!("nhpd-figure-{figure}"),
        title,
        bodies,
        ..damage_maps()
    })
}

fn damage_maps() -> Maps {
    Maps {
        name: String::new(),
        title: String::new(),
        quantity: "damage".to_owned(),
        unit: "-",
        bodies: Vec::new(),
        columns: STAGES.len(),
        are_modes: false,
    }
}

/// The damage after shares of the breakages, on the undeformed body.
fn stages(
    label: &str,
    (solution, breaks): &(Solution, Vec<BreakRecord>),
) -> anyhow::Result<Vec<MappedBody>> {
    let model = &solution.model;
    let (cloud, cells) = (
        &model.plane().cloud,
        match model.body().origin() {
            Origin::Mesh(mesh) => mesh.cells.as_slice(),
            _ => &[],
        },
    );
    let unmoved = vec![[0.0; 2]; cloud.len()];
    let drawn = |(words, part): (&str, usize)| {
        let mut intact = vec![true; model.plane().bonds.len()];
        for record in &breaks[..breaks.len() / part] {
            intact[record.bond as usize] = false;
        }
        let (title, values) = (format!("{label}{words}"), damage(&**model.plane(), &intact));
        let positions = &cloud.positions;
        if cells.is_empty() {
            let [spacing, _] = cloud.lattice_cell.context("the body has no cells")?;
            return Ok(MappedBody::from_lattice(
                title, positions, spacing, &unmoved, values,
            ));
        }
        let cells = cells.iter().map(|cell| Cell::from(*cell));
        let (positions, unmoved) = (positions.clone(), unmoved.clone());
        Ok(MappedBody::from_mesh(
            title,
            positions,
            cells.collect(),
            unmoved,
            values,
        ))
    };
    STAGES.into_iter().map(drawn).collect()
}
