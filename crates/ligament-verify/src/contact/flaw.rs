//! A plate with a closed flaw under compression: its faces slide, and wing cracks grow from its tips.

use std::f64::consts::{FRAC_1_SQRT_2, PI, SQRT_2};

use anyhow::{Context, bail};
use ligament::Model;
use ligament_analysis::history::BreakRecord;

use crate::crack_path::{ends, middle};
use crate::experiment::{Compute, Experiment, Findings};
use crate::published::published;
use crate::table::{Extent, Labels};
use crate::trial::{Memory, StoredMesh, Template, Trial, probe, stored_mesh, template};

/// The experiment.
pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "contact_flaw",
    title: "A closed flaw under compression",
    source: "closed form: a crack of linear elastic fracture mechanics; wing cracks by Ashby and Hallam 1986",
    setup: "Plates of E = 15 GPa, nu = 1/3, nhpd, with a flaw of the length 2 a = 20 mm at 45 degrees through the middle, mu on its faces, pressed along y by sigma: normal and shear stress \
            on the flaw are sigma/2. Sliding: a lattice of 120 x 120 points of 1 mm; the motion of two points beside the middle of the flaw against each other, less mu sigma/2 over the shear modulus \
            times their distance, over 4 tau a/E for tau = (1 - mu) sigma/2. Start: 80 x 80 points, `bond-rankine`; the stress at the first break over that of a flaw across the \
            pull in the same plate: the largest hoop stress is 2/sqrt(3) of the shear alone, at 70.5 degrees to the flaw; the plane across \
            the first bond that breaks. Growth: a mesh of 80 x 100 mm, 1 mm around the flaw, patch correction, with a lateral pressure of lambda sigma: the stress at which both cracks are L a long \
            in the mean, up to the farthest broken bond, over that at which K = sigma sqrt(pi a) (1 - lambda - mu (1 + lambda) - 4.3 lambda L) (0.23 L + 1/sqrt(3 (1 + L)))/(1 + L)^1.5 \
            is the toughness. A strength alone has none; that of the pulled plate under its largest load stands for it.",
    cases: &[&LATTICE, &MESH],
    compute: Compute::Code(compute),
};

static LATTICE: Template = template!("verification/contact-flaw.toml");
static MESH: Template = template!("inclined-flaw/case.toml");
static POINTS: StoredMesh = stored_mesh!("inclined-flaw.msh");

/// Half of the length of the flaw, spacing of the lattice, m; Young's modulus, Pa; pressure on the lattice, Pa.
const HALF: f64 = 0.01;
const SPACING: f64 = 1e-3;
const YOUNG: f64 = 15e9;
const PRESSURE: f64 = 10e6;

/// Coefficient of friction of growing cracks; width of their plate, m.
const FRICTION: f64 = 0.3;
const WIDTH: f64 = 0.08;

/// Stress up to which cracks grow for each lateral pressure over it, MPa.
const PRESSED: [(f64, f64); 4] = [(0.0, 18.0), (0.05, 24.0), (0.1, 27.0), (0.15, 27.0)];

/// Stress up to which the plate is pulled, MPa.
const PULLED: f64 = 5.0;

fn compute(extent: Extent) -> anyhow::Result<Findings> {
    let (mut slid, mut grown) = (Memory::default(), Memory::default());
    let sliding =
        published!("contact-flaw-sliding").judge(extent, |labels| sliding(labels, &mut slid))?;
    let start = published!("contact-flaw-start").judge(extent, start)?;
    let growth =
        published!("contact-flaw-growth").judge(extent, |labels| growth(labels, &mut grown))?;
    Ok(Findings {
        tables: vec![sliding, start, growth],
        ..Findings::default()
    })
}

/// Sliding of the faces over that of the closed form, or over that without friction.
fn sliding(labels: Labels<'_>, slid: &mut Memory<f64>) -> anyhow::Result<f64> {
    let mut by = |friction: f64| -> anyhow::Result<f64> {
        let trial = (LATTICE.trial())
            .on_lattice([120, 120], SPACING)
            .set("lattice.corner", [-0.06, -0.06])
            .set("support.1.at", [0.0005, -0.0595])
            .set("model.closing_friction", friction);
        let moved = slid.reading(&trial, |solution| {
            Ok(-FRAC_1_SQRT_2 * (probe(solution, "x")? + probe(solution, "y")?))
        })?;
        let shear = YOUNG / (2.0 * (1.0 + 1.0 / 3.0));
        Ok(moved - friction * 0.5 * PRESSURE / shear * SQRT_2 * SPACING)
    };
    let friction = labels.number("mu")?;
    Ok(match labels.text("over")? {
        "4 tau a/E" => by(friction)? / (2.0 * (1.0 - friction) * PRESSURE * HALF / YOUNG),
        "that without friction" => by(friction)? / by(0.0)?,
        other => bail!("no scale `{other}`"),
    })
}

/// Stress at the first break over that of a pulled plate, or the angle with the flaw of the plane across the first broken bond.
fn start(labels: Labels<'_>) -> anyhow::Result<f64> {
    let brittle = |trial: Trial, pressure: f64| {
        let trial = trial.set("load.0.pressure", pressure);
        let once = "{ steps = 1, stop = { bonds = 1 }, criterion = [{ kind = \"bond-rankine\" }] }";
        trial.set_toml("fracture", once).solve_with_breakages()
    };
    let (pressed, breaks) = brittle(LATTICE.trial(), 8e6)?;
    let first = breaks.first().context("no bond breaks")?;
    match labels.text("of")? {
        "stress" => {
            let across = "[{ points = [[-0.01, 0.0], [0.01, 0.0]] }]";
            let (pulled, _) = brittle(LATTICE.trial().set_toml("precrack", across), -4e6)?;
            let [pressed, pulled] = [pressed, pulled].map(|it| it.outcome.first_break);
            let (pressed, pulled) = pressed.zip(pulled).context("no first break")?;
            Ok((pressed.reaction / pulled.reaction).abs())
        }
        "angle, degrees" => {
            let [a, b] = ends(&pressed.model, first.bond as usize);
            let plane = (b[1] - a[1]).atan2(b[0] - a[0]).to_degrees() + 90.0;
            Ok((plane - 45.0).rem_euclid(180.0))
        }
        other => bail!("no quantity `{other}`"),
    }
}

/// Stress at which cracks are so long, over that of the formula.
fn growth(labels: Labels<'_>, grown: &mut Memory<Vec<[f64; 2]>>) -> anyhow::Result<f64> {
    let (lateral, length) = (labels.number("lambda")?, labels.number("L")?);
    let under = |stress: f64, steps: u32| {
        let trial = (MESH.trial().on_mesh(&POINTS)).set("load.0.pressure", 1e6 * stress);
        trial.set("fracture.steps", steps)
    };
    // The largest load of the pulled plate, by the secant of its width.
    let pulled = under(-PULLED, 50)
        .set("fracture.stop.bonds", 300)
        .set("precrack.0.angle", 0.0);
    let largest = grown.reading(&pulled, |solution| {
        let rows = solution.outcome.history.iter();
        let largest = rows.map(|row| row.reaction.abs()).fold(0.0, f64::max);
        Ok(vec![[largest, 0.0]])
    })?[0][0];
    let toughness = largest * (PI * HALF / (PI * HALF / WIDTH).cos()).sqrt();
    let end = PRESSED.iter().find(|it| it.0 == lateral);
    let end = end.with_context(|| format!("no lambda {lateral}"))?.1;
    let mut trial = under(end, end as u32);
    if lateral > 0.0 {
        let side = |group: &str, pressure: f64| {
            format!("{{ group = \"{group}\", pressure = {pressure:?} }}")
        };
        let [left, right] = ["left", "right"].map(|it| side(it, 1e6 * end * lateral));
        let top = side("top", 1e6 * end);
        trial = trial.set_toml("load", &format!("[{top}, {left}, {right}]"));
    }
    let lengths = grown.result(trial.command(), || {
        let (solution, breaks) = trial.solve_with_breakages()?;
        Ok(lengths(&solution.model, &breaks))
    })?;
    let long = lengths.iter().find(|it| it[1] >= length * HALF);
    let [factor, _] = long.context("the cracks do not become so long")?;
    let friction = 1.0 - lateral - FRICTION * (1.0 + lateral) - 4.3 * lateral * length;
    let shape = 0.23 * length + 1.0 / (3.0 * (1.0 + length)).sqrt();
    let intensity = (PI * HALF).sqrt() * friction * shape / (1.0 + length).powf(1.5);
    Ok(factor * 1e6 * end * intensity / toughness)
}

/// Load factors at breakages, and the mean distance of the farthest broken bonds on both sides from the tips of the flaw, m.
fn lengths(model: &Model, breaks: &[BreakRecord]) -> Vec<[f64; 2]> {
    let tip = HALF * FRAC_1_SQRT_2;
    let mut farthest = [0.0_f64; 2];
    let records = breaks.iter().map(|record| {
        let [x, y] = middle(model, record.bond as usize).at;
        let (side, sign) = if x + y > 0.0 { (0, 1.0) } else { (1, -1.0) };
        let reach = (x - sign * tip).hypot(y - sign * tip);
        farthest[side] = farthest[side].max(reach);
        [record.load_factor, 0.5 * (farthest[0] + farthest[1])]
    });
    records.collect()
}
