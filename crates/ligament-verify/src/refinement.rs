//! Refinement where bonds break: uniform strains, a hole, a panel, a crack and a disk on bisected meshes.

use std::collections::BTreeMap;

use anyhow::Context;
use ligament::Model;
use ligament::run::{NoObserver, Solution};
use ligament::setup::{FinePlace, Fineness, Horizon, Refine, Setup};
use ligament_analysis::refinement_pass::PassRecord;
use ligament_case::case::CaseFile;
use ligament_study::meshing::Coordinates;
use ligament_study::meshing::gmsh_program::{MeshRequest, make_mesh};

use super::experiment::{Compute, Experiment, Findings};
use super::places::repository;
use super::published::known_table;
use super::table::Extent;

pub(super) const EXPERIMENT: Experiment = Experiment {
    name: "refine",
    title: "Meshes that follow the crack",
    source: "closed forms: a uniform stress breaks a strip at F_t, a small hole triples it; else the body whose cells are all as fine",
    setup: "Bisected meshes, lambda = 3. Square: 5 mm, four times finer along a line, pulled until the first bond breaks by `bond-rankine`. Hole: cells of half of \
            the radius, refined by the passes to h/R; F_t over the mean stress of the first breakage. Panel: cases/l-panel/refined.toml, 20 to 5 mm, beside the \
            panel whose cells are all bisected four times. Edge crack: square of 100 mm, crack of 30 mm, `bond-energy`, 5 to 1.25 mm along the line ahead of \
            the tip by spacing(d) <= max(h, d/3), and by d/2; the mean of eight meshes of Gmsh over that of the meshes whose cells are all bisected. \
            Disk: 4 mm, four times finer in a strip beside the axis, height of the first breakage beside it over the radius.",
    cases: &[],
    compute: Compute::Code(compute),
};

/// Values of the problems by name.
type Values = BTreeMap<&'static str, f64>;

fn compute(extent: Extent) -> anyhow::Result<Findings> {
    let mut found: BTreeMap<String, Values> = BTreeMap::new();
    let table = known_table("refine")?.judge(extent, |labels| {
        let (problem, of) = (labels.text("problem")?, labels.text("of")?);
        if !found.contains_key(problem) {
            found.insert(problem.to_owned(), values(problem)?);
        }
        let value = found[problem].get(of);
        Ok(*value.context("the problem has no such value")?)
    })?;
    Ok(Findings {
        tables: vec![table],
        ..Findings::default()
    })
}

fn values(problem: &str) -> anyhow::Result<Values> {
    match problem {
        "square" => square(),
        "hole, 1/8" => hole(2),
        "hole, 1/16" => hole(3),
        "panel" => panel(),
        "edge crack" => edge_crack(),
        "disk" => disk(),
        _ => anyhow::bail!("there is no such problem"),
    }
}

/// The setup of a case with settings.
fn setup(case: &str, settings: &[&str]) -> anyhow::Result<Setup> {
    let mut settings: Vec<String> = settings.iter().map(|it| (*it).to_owned()).collect();
    settings.push("solver.threads=1".to_owned());
    CaseFile::load(&repository().join(case), &settings)?.setup(&mut ())
}

fn solve(setup: Setup) -> anyhow::Result<Solution> {
    Ok(setup.solve(&mut NoObserver)?)
}

/// A refinement around given places, in the pass that halves edges twice.
fn refinement_around(places: impl Iterator<Item = [f64; 2]>) -> Refine {
    let place = |[x, y]: [f64; 2]| FinePlace {
        position: [x, y, 0.0],
        pass: 0,
        is_open: false,
    };
    Refine {
        pass: 3,
        passes: 3,
        places: places.map(place).collect(),
        ..Refine::new(Fineness::Levels(2))
    }
}

/// A number of positions along a line, its ends included.
fn line(from: [f64; 2], to: [f64; 2], count: usize) -> impl Iterator<Item = [f64; 2]> {
    (0..count).map(move |number| {
        let share = number as f64 / (count - 1) as f64;
        [0, 1].map(|axis| from[axis] + share * (to[axis] - from[axis]))
    })
}

/// Places that cover a square with a corner at the origin so densely that all of its cells are refined.
fn everywhere(side: f64, count: usize) -> Refine {
    let rows = line([0.0, 0.0], [0.0, side], count);
    refinement_around(rows.flat_map(move |[_, y]| line([0.0, y], [side, y], count)))
}

/// The setup on its refined mesh with another horizon factor, without further refinement.
fn on_mesh_by(factor: f64, setup: Setup) -> anyhow::Result<Setup> {
    let horizon = setup.horizon;
    let coarser = Setup {
        horizon: Horizon::Factor(factor),
        ..setup
    };
    let refined = Model::build(coarser, &mut ())?.setup;
    Ok(Setup {
        horizon,
        refine: None,
        ..refined
    })
}

fn largest(solution: &Solution) -> f64 {
    let at_rest = solution.outcome.at_rest().map(|it| it.reaction);
    at_rest.fold(0.0, f64::max)
}

/// Load of the first breakage, N.
fn first_break(solution: &Solution) -> anyhow::Result<f64> {
    let first = solution.outcome.first_break;
    Ok(first.context("no bond breaks")?.reaction)
}

fn square() -> anyhow::Result<Values> {
    let setup = setup("cases/verification/refined-square.toml", &[])?;
    let solution = solve(Setup {
        refine: Some(refinement_around(line([0.02, 0.05], [0.08, 0.05], 61))),
        ..setup
    })?;
    let stress = first_break(&solution)? / 0.1;
    Ok(BTreeMap::from([
        ("E", solution.outcome.elastic_stiffness / 30e9),
        ("first failure", stress / 3e6),
    ]))
}

fn hole(levels: u32) -> anyhow::Result<Values> {
    let place = tempfile::tempdir().context("no folder for a mesh")?;
    let mesh = place.path().join("hole.msh");
    let numbers = [("fine", 0.0025), ("coarse", 0.008), ("growth", 0.2)];
    mesh_with("plate-with-hole.geo", &mesh, &numbers)?;
    let file = format!("mesh.file=\"{}\"", mesh.display());
    let setup = setup("cases/verification/strength-hole.toml", &[&file])?;
    let solution = solve(Setup {
        refine: Some(Refine {
            passes: levels + 1,
            ..Refine::new(Fineness::Levels(levels))
        }),
        ..setup
    })?;
    let first = solution.outcome.first_break.context("no bond breaks")?;
    Ok(BTreeMap::from([("concentration", 1.0 / first.load_factor)]))
}

/// Makes a mesh of a geometry of the repository with some of its numbers.
fn mesh_with(geometry: &str, out: &std::path::Path, numbers: &[(&str, f64)]) -> anyhow::Result<()> {
    make_mesh(&MeshRequest {
        geometry: repository().join("meshes").join(geometry),
        out: out.to_owned(),
        force: true,
        gmsh: "gmsh".into(),
        numbers: numbers.iter().map(|it| (it.0.to_owned(), it.1)).collect(),
        size: None,
        coordinates: Coordinates::default(),
    })?;
    Ok(())
}

fn panel() -> anyhow::Result<Values> {
    let refined = solve(setup("cases/l-panel/refined.toml", &[])?)?;
    let fine = solve(Setup {
        refine: Some(everywhere(0.5, 101)),
        ..setup("cases/l-panel/refined.toml", &[])?
    })?;
    let last = refined.passes.last().context("no pass")?;
    let change = |of: fn(&PassRecord) -> Option<f64>| of(last).context("no pass before");
    let bonds = |it: &Solution| it.model.counts.bonds as f64;
    Ok(BTreeMap::from([
        ("peak", largest(&refined) / largest(&fine)),
        ("bonds", bonds(&refined) / bonds(&fine)),
        ("inside", change(|it| it.inside)?),
        ("change of peak, %", 100.0 * change(|it| it.peak_change)?),
        (
            "change of path over h",
            change(|it| it.path_change)? / last.size,
        ),
    ]))
}

/// Number of meshes of the edge crack.
const MESHES: usize = 8;

fn edge_crack() -> anyhow::Result<Values> {
    let place = tempfile::tempdir().context("no folder for meshes")?;
    let mut sums = [0.0; 3];
    for number in 0..MESHES {
        let mesh = place.path().join("square.msh");
        let size = 0.005 * (1.0 - 0.03 * number as f64);
        let numbers = [
            ("size", size),
            ("length", 0.1),
            ("height", 0.1),
            ("algorithm", 5.0),
        ];
        mesh_with("plate.geo", &mesh, &numbers)?;
        let file = format!("mesh.file=\"{}\"", mesh.display());
        let cracked = || setup("cases/verification/refined-edge-crack.toml", &[&file]);
        let ahead = || refinement_around(line([0.03, 0.05], [0.1, 0.05], 281));
        let refined = |refine| -> anyhow::Result<Setup> {
            Ok(Setup {
                refine: Some(refine),
                ..cracked()?
            })
        };
        let all = solve(refined(everywhere(0.1, 81))?)?;
        let by_rule = solve(refined(ahead())?)?;
        let too_near = solve(on_mesh_by(2.0, refined(ahead())?)?)?;
        for (sum, solution) in sums.iter_mut().zip([&all, &by_rule, &too_near]) {
            *sum += largest(solution);
        }
    }
    let [all, by_rule, too_near] = sums;
    Ok(BTreeMap::from([
        ("peak, d/3", by_rule / all),
        ("peak, d/2", too_near / all),
    ]))
}

fn disk() -> anyhow::Result<Values> {
    let setup = setup("cases/disk-stress/case.toml", &["fracture.stop.bonds=1"])?;
    let radius = 0.05;
    let solution = solve(Setup {
        refine: Some(refinement_around(line(
            [0.3 * radius, -0.5 * radius],
            [0.3 * radius, 0.5 * radius],
            101,
        ))),
        ..setup
    })?;
    let state = &solution.outcome.state;
    let ends = &solution.model.system.to_bonds().ends;
    let broken = state
        .intact
        .iter()
        .position(|it| !it)
        .context("no bond breaks")?;
    let middle = solution.model.middle(ends[broken]);
    Ok(BTreeMap::from([(
        "beside the axis",
        middle[0].abs() / radius,
    )]))
}
