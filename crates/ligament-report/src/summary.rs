//! Summary of a run as static HTML.

use std::path::Path;

use ligament_output::Error;
use ligament_output::quantity::{without_rounding, zero_if_rounding};
use ligament_output::results::outputs::OutputKind;
use ligament_output::summary::{
    self, BondEvent, Input, ModalSummary, ModeSummary, ModelSummary, MotionSummary, PathPoint,
    Provenance, Stage, Summary, UnitsSummary,
};
use ligament_plot::picture::units::AxisUnit;

/// Shortest time of a stage that is shown, s.
const WORTH_TELLING: f64 = 0.005;

/// Text escaped for HTML.
pub(crate) fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\'' => escaped.push_str("&#39;"),
            other => escaped.push(other),
        }
    }
    escaped
}

/// Summary of a run.
pub(crate) struct RunSummary {
    /// Title of the case; none where the run has not ended.
    pub(crate) title: Option<String>,
    /// The warnings, the main results and their origin as HTML.
    pub(crate) html: String,
}

/// Summary of the results in a folder.
///
/// # Errors
///
/// If the summary cannot be read.
pub(crate) fn run_summary(folder: &Path, kind: OutputKind) -> Result<RunSummary, Error> {
    let ended = match kind {
        OutputKind::Steps => summary::read(folder)?.map(summary_of_steps),
        OutputKind::Modes => summary::read(folder)?.map(summary_of_modes),
    };
    Ok(ended.unwrap_or_else(|| RunSummary {
        title: None,
        html: warnings(&["The run did not come to its end: what is here is what it wrote so far."]),
    }))
}

/// The case file as HTML.
pub(crate) fn case_html(case: &str) -> String {
    format!(
        "<details class=\"card case\"><summary>Case file</summary><pre tabindex=\"0\">{}</pre></details>\n",
        escaped(case)
    )
}

fn summary_of_steps(summary: Summary) -> RunSummary {
    let of_end = summary.warning_of_end();
    let of_end = of_end.map(|[head, words]| format!("{head}: {words}"));
    let mut texts: Vec<&str> = of_end.iter().map(String::as_str).collect();
    texts.extend(summary.warnings.iter().map(String::as_str));
    let computed = provenance(&summary.model, summary.provenance.as_ref(), &summary.stages);
    let html = tables(
        &texts,
        &[results_of_steps(&summary), passes(&summary)].concat(),
        &summary.model,
        &computed,
    );
    RunSummary {
        html,
        title: Some(summary.model.title),
    }
}

fn summary_of_modes(summary: ModalSummary) -> RunSummary {
    let texts: Vec<&str> = summary.warnings.iter().map(String::as_str).collect();
    let computed = provenance(&summary.model, summary.provenance.as_ref(), &summary.stages);
    let html = tables(
        &texts,
        &results_of_modes(&summary),
        &summary.model,
        &computed,
    );
    RunSummary {
        html,
        title: Some(summary.model.title),
    }
}

/// Warnings and the tables of results, model and origin.
fn tables(texts: &[&str], results: &[Entry], of: &ModelSummary, computed: &[Entry]) -> String {
    [
        warnings(texts),
        table("Results", results),
        table("Model", &model(of)),
        table("Computed by", computed),
    ]
    .concat()
}

/// A row of a table: name and text.
pub(crate) type Entry = (String, String);

fn entry(name: &str, text: impl Into<String>) -> Entry {
    (name.to_owned(), text.into())
}

pub(crate) fn table(title: &str, rows: &[Entry]) -> String {
    if rows.is_empty() {
        return String::new();
    }
    let row = |(name, text): &Entry| {
        let (name, text) = (escaped(name), escaped(text));
        format!("<tr><th scope=\"row\">{name}</th><td>{text}</td></tr>\n")
    };
    let rows: String = rows.iter().map(row).collect();
    format!(
        "<section class=\"card\"><h3>{title}</h3><table class=\"facts\">\n{rows}</table></section>\n"
    )
}

fn warnings(texts: &[&str]) -> String {
    if texts.is_empty() {
        return String::new();
    }
    let item = |text: &&str| format!("<li>{}</li>\n", escaped(text));
    let items: String = texts.iter().map(item).collect();
    format!("<section class=\"card warnings\"><h3>Warnings</h3><ul>\n{items}</ul></section>\n")
}

/// A value with a suitable prefix of its unit; 0 for a value that is only rounding.
pub(crate) fn quantity(value: f64, unit: &str) -> String {
    let value = without_rounding(value, unit);
    AxisUnit::new(unit, value.abs()).value(value)
}

fn results_of_steps(summary: &Summary) -> Vec<Entry> {
    let UnitsSummary {
        displacement,
        force,
    } = &summary.units;
    let points = [summary.peak, summary.first_peak, summary.first_break];
    let largest = |of: fn(&PathPoint) -> f64| {
        let sizes = points.iter().flatten().map(|it| of(it).abs());
        sizes.filter(|it| it.is_finite()).fold(0.0, f64::max)
    };
    let load_at = |name: &str, point: Option<PathPoint>| {
        let point = point.filter(|it| it.reaction.is_finite() && it.displacement.is_finite())?;
        if summary.motion.is_some() {
            let [load, at] = [(point.reaction, &**force), (point.load_factor, "s")]
                .map(|(value, unit)| quantity(value, unit));
            return (point.reaction != 0.0).then(|| entry(name, format!("{load} at {at}")));
        }
        let [load, at] = [
            (point.reaction, largest(|it| it.reaction), force),
            (
                point.displacement,
                largest(|it| it.displacement),
                displacement,
            ),
        ]
        .map(|(value, largest, unit)| quantity(zero_if_rounding(value, largest), unit));
        Some(entry(name, format!("{load} at {at}")))
    };
    let in_time = summary.motion.is_some();
    let bond = |name: &str, bond: &Option<BondEvent>| {
        bond.as_ref().map(|it| entry(name, words(it, in_time)))
    };
    let onset = match summary.first_softened_bond {
        Some(_) => "First softening",
        None => "First breakage",
    };
    let other_peak = summary.first_peak.filter(|it| Some(*it) != summary.peak);
    let stiffness = |it| {
        entry(
            "Elastic stiffness",
            quantity(it, &summary.units.stiffness()),
        )
    };
    let broken = format!("{} in {}", summary.broken_bonds, steps_in_words(summary));
    let balance = Some(summary.energy_balance_error).filter(|it| it.is_finite());
    let balance = balance.map(|_| entry("Energy balance", summary.energy_balance()));
    let rows = [
        load_at("Largest load", summary.peak),
        load_at("First peak", other_peak),
        load_at(onset, summary.first_break),
        bond("First softened bond", &summary.first_softened_bond),
        bond("First broken bond", &summary.first_broken_bond),
        summary.elastic_stiffness.map(stiffness),
        Some(entry("Broken bonds", broken)),
        balance,
        Some(entry("Ended because", &*summary.termination_message)),
    ];
    let motion = summary.motion.iter().flat_map(motion_entries);
    rows.into_iter().flatten().chain(motion).collect()
}

/// The passes of a refinement.
fn passes(summary: &Summary) -> Vec<Entry> {
    let refinement = summary.refinement.iter();
    let rows = refinement.flat_map(|it| it.rows(&summary.units.force));
    rows.map(|(name, words)| entry(&capitalised(&name), words))
        .collect()
}

/// A name that begins with a capital letter.
fn capitalised(name: &str) -> String {
    let mut letters = name.chars();
    let first = letters.next().map(|it| it.to_ascii_uppercase());
    first.into_iter().chain(letters).collect()
}

/// The number of steps with its noun.
fn steps_in_words(summary: &Summary) -> String {
    match &summary.motion {
        Some(motion) => format!("{} time steps", motion.time_steps),
        None if summary.exact_path => format!("{} states of the exact path", summary.steps),
        None => format!("{} load steps", summary.steps),
    }
}

/// Time, steps and energies of a motion.
fn motion_entries(motion: &MotionSummary) -> Vec<Entry> {
    let time = quantity(motion.time, "s");
    let step = quantity(motion.time_step, "s");
    let mut rows = vec![entry("Time", time), entry("Time step", step)];
    if let (Some(critical), Some(by)) = (motion.critical_step, &motion.limited_by) {
        let critical = quantity(critical, "s");
        rows.push(entry(
            "Critical step",
            format!("{critical}, limited by {by}"),
        ));
    }
    let energies = motion.energies.named().into_iter();
    let energies = energies.filter(|it| it.1 != 0.0);
    rows.extend(
        energies.map(|(name, energy)| entry(&format!("Energy, {name}"), quantity(energy, "J"))),
    );
    rows
}

fn words(bond: &BondEvent, in_time: bool) -> String {
    let [a, b] = bond.ends;
    let place = bond.place.iter().map(|it| format!("{:.2}", 1e3 * it));
    let place = place.collect::<Vec<String>>().join(", ");
    let (when, criterion) = (bond.when(in_time), &bond.criterion);
    format!("{a} to {b} at ({place}) mm, {when}, by {criterion}")
}

fn results_of_modes(summary: &ModalSummary) -> Vec<Entry> {
    let row = |mode: &ModeSummary| {
        let frequency = quantity(mode.frequency, "Hz");
        let text = format!("{frequency}, {}", mode.kind);
        (format!("Mode {}", mode.mode), text)
    };
    let modes = summary.modes.iter().map(row);
    modes
        .chain([entry("Mass", quantity(summary.mass, "kg"))])
        .collect()
}

fn model(model: &ModelSummary) -> Vec<Entry> {
    let count = |it: usize| Some(it).filter(|it| *it > 0);
    let cut =
        count(model.cut_bonds).map_or(String::new(), |it| format!(", {it} cut by pre-cracks"));
    let [min, max, mean] =
        [model.horizon.min, model.horizon.max, model.horizon.mean].map(|it| quantity(it, "m"));
    let rows = [
        Some(entry("Formulation", &*model.formulation)),
        count(model.points).map(|it| entry("Points", it.to_string())),
        count(model.bonds).map(|it| entry("Bonds", format!("{it}{cut}"))),
        count(model.no_fail_points).map(|it| entry("Points with no_fail", it.to_string())),
        Some(entry("Horizon", format!("{min} to {max}, mean {mean}"))),
        Some(entry("Volume", quantity(model.volume, "m^3"))),
    ];
    rows.into_iter().flatten().collect()
}

fn provenance(model: &ModelSummary, record: Option<&Provenance>, stages: &[Stage]) -> Vec<Entry> {
    let commit = record.and_then(|it| it.build.commit.as_ref());
    let commit = commit.map(|it| it.chars().take(10).collect::<String>());
    let commit = commit.map_or(String::new(), |it| format!(", commit {it}"));
    let mut rows = vec![entry(
        "Program",
        format!("ligament {}{commit}", model.version),
    )];
    if let Some(record) = record {
        rows.extend(record.processor.as_deref().map(|it| entry("Processor", it)));
        let digest = |Input { file, content, .. }: &Input| {
            let file = file.to_string_lossy();
            let name = file.rsplit(['/', '\\']).next().unwrap_or(&file);
            entry("Input", format!("{name}, xxh64 {}", content.xxh64))
        };
        rows.extend(record.inputs.iter().map(digest));
    }
    let long = stages.iter().filter(|it| it.seconds >= WORTH_TELLING);
    let times = long.map(|Stage { name, seconds, .. }| format!("{name} {seconds:.2} s"));
    let times = times.collect::<Vec<String>>().join(", ");
    if !times.is_empty() {
        rows.push(entry("Time", times));
    }
    rows
}
