//! What a run came to, in words and numbers, as HTML that is there without a script.

use ligament_output::results::outputs::OutputKind;
use ligament_plot::picture::units::Shown;
use serde_json::Value;

/// Steps of a stage that a reader of results wants to know the time of, s.
const WORTH_TELLING: f64 = 0.005;

/// Text that stands for itself in HTML.
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

/// The warnings, the main results, where they came from, and the case.
pub(crate) fn html(summary: &Value, kind: OutputKind, case: &str) -> String {
    let mut html = String::new();
    html.push_str(&warnings(summary));
    let results = match kind {
        OutputKind::Steps => results_of_steps(summary),
        OutputKind::Modes => results_of_modes(summary),
    };
    html.push_str(&table("Results", &results));
    html.push_str(&table("Model", &model(summary)));
    html.push_str(&table("Computed by", &provenance(summary)));
    html.push_str(&format!(
        "<details class=\"card case\"><summary>Case file</summary><pre tabindex=\"0\">{}</pre></details>\n",
        escaped(case)
    ));
    html
}

/// A row of a table: a name and what is said of it.
type Entry = (String, String);

fn table(title: &str, rows: &[Entry]) -> String {
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

fn warnings(summary: &Value) -> String {
    let mut texts: Vec<String> = Vec::new();
    if summary["without_equilibrium"] == true {
        texts.push("No state under load is in equilibrium: there are no results.".to_owned());
    } else if summary["last_state_not_at_rest"] == true {
        let last = "The last state is no answer: its bonds were still breaking when the run ended.";
        texts.push(last.to_owned());
    }
    let told = summary["warnings"].as_array();
    texts.extend(
        told.into_iter()
            .flatten()
            .filter_map(Value::as_str)
            .map(str::to_owned),
    );
    if texts.is_empty() {
        return String::new();
    }
    let item = |text: &String| format!("<li>{}</li>\n", escaped(text));
    let items: String = texts.iter().map(item).collect();
    format!("<section class=\"card warnings\"><h3>Warnings</h3><ul>\n{items}</ul></section>\n")
}

/// A value with the prefix of its unit that gives a short number.
fn quantity(value: &Value, unit: &str) -> Option<String> {
    let value = value.as_f64()?;
    Some(Shown::new(unit, value.abs()).value(value))
}

/// Load and displacement at a point of the curve.
fn load_at(point: &Value, units: [&str; 2]) -> Option<String> {
    let displacement = quantity(&point["displacement"], units[0])?;
    let force = quantity(&point["reaction"], units[1])?;
    Some(format!("{force} at {displacement}"))
}

fn results_of_steps(summary: &Value) -> Vec<Entry> {
    let unit = |of: &str, other| summary["units"][of].as_str().unwrap_or(other);
    let units = [unit("displacement", "m"), unit("force", "N")];
    let broke = summary["broken_bonds"].as_u64().unwrap_or(0);
    let onset = match summary["first_softened_bond"].is_object() {
        true => "First softening",
        false => "First breakage",
    };
    let mut rows = Vec::new();
    let mut tell = |name: &str, text: Option<String>| {
        rows.extend(text.map(|text| (name.to_owned(), text)));
    };
    tell("Largest load", load_at(&summary["peak"], units));
    let first_peak = &summary["first_peak"];
    let is_other = *first_peak != summary["peak"];
    tell(
        "First peak",
        load_at(first_peak, units).filter(|_| is_other),
    );
    tell(onset, load_at(&summary["first_break"], units));
    tell("First softened bond", bond(&summary["first_softened_bond"]));
    tell("First broken bond", bond(&summary["first_broken_bond"]));
    let stiffness = format!("{}/{}", units[1], units[0]);
    tell(
        "Elastic stiffness",
        quantity(&summary["elastic_stiffness"], &stiffness),
    );
    let steps = match summary["exact_path"] == true {
        true => "states of the exact path",
        false => "load steps",
    };
    let count = summary["steps"].as_u64();
    tell(
        "Broken bonds",
        count.map(|count| format!("{broke} in {count} {steps}")),
    );
    let balance = summary["energy_balance_error"].as_f64();
    tell(
        "Energy balance",
        balance.map(|it| format!("off by {it:.1e} of the work")),
    );
    let ended = summary["termination_message"].as_str();
    tell("Ended because", ended.map(str::to_owned));
    rows
}

fn bond(bond: &Value) -> Option<String> {
    let ends = bond["ends"].as_array()?;
    let [a, b] = [ends.first()?, ends.get(1)?].map(Value::to_string);
    let place = bond["place"].as_array()?;
    let mm = |it: &Value| Some(format!("{:.2}", 1e3 * it.as_f64()?));
    let place: Option<Vec<String>> = place.iter().map(mm).collect();
    let (step, criterion) = (&bond["step"], bond["criterion"].as_str()?);
    let place = place?.join(", ");
    Some(format!(
        "{a} to {b} at ({place}) mm, in step {step}, by {criterion}"
    ))
}

fn results_of_modes(summary: &Value) -> Vec<Entry> {
    let modes = summary["modes"].as_array();
    let row = |mode: &Value| {
        let frequency = quantity(&mode["frequency"], "Hz")?;
        let kind = mode["kind"].as_str()?;
        Some((
            format!("Mode {}", mode["mode"]),
            format!("{frequency}, {kind}"),
        ))
    };
    let mut rows: Vec<Entry> = modes.into_iter().flatten().filter_map(row).collect();
    rows.extend(quantity(&summary["mass"], "kg").map(|it| ("Mass".to_owned(), it)));
    rows
}

fn model(summary: &Value) -> Vec<Entry> {
    let mut rows = Vec::new();
    let mut tell = |name: &str, text: Option<String>| {
        rows.extend(text.map(|text| (name.to_owned(), text)));
    };
    let count = |name: &str| summary[name].as_u64().filter(|it| *it > 0);
    tell(
        "Formulation",
        summary["formulation"].as_str().map(str::to_owned),
    );
    tell("Points", count("points").map(|it| it.to_string()));
    let cut = count("cut_bonds").map_or(String::new(), |it| format!(", {it} cut by pre-cracks"));
    tell("Bonds", count("bonds").map(|it| format!("{it}{cut}")));
    tell(
        "Points with no_fail",
        count("no_fail_points").map(|it| it.to_string()),
    );
    let horizon = |of: &str| quantity(&summary["horizon"][of], "m");
    let spread = || {
        Some(format!(
            "{} to {}, mean {}",
            horizon("min")?,
            horizon("max")?,
            horizon("mean")?
        ))
    };
    tell("Horizon", spread());
    tell(
        "Volume",
        summary["volume"]
            .as_f64()
            .map(|it| Shown::new("m^3", it).value(it)),
    );
    rows
}

fn provenance(summary: &Value) -> Vec<Entry> {
    let of = &summary["provenance"];
    let mut rows = Vec::new();
    let version = summary["version"].as_str();
    let commit = of["commit"]
        .as_str()
        .map(|it| it.chars().take(10).collect::<String>());
    let commit = commit.map_or(String::new(), |it| format!(", commit {it}"));
    rows.extend(version.map(|it| ("Program".to_owned(), format!("ligament {it}{commit}"))));
    rows.extend(
        of["processor"]
            .as_str()
            .map(|it| ("Processor".to_owned(), it.to_owned())),
    );
    let inputs = of["inputs"].as_array().into_iter().flatten();
    let digest = |input: &Value| {
        let (file, digest) = (input["file"].as_str()?, input["xxh64"].as_str()?);
        let name = file.rsplit(['/', '\\']).next().unwrap_or(file);
        Some(("Input".to_owned(), format!("{name}, xxh64 {digest}")))
    };
    rows.extend(inputs.filter_map(digest));
    let stages = summary["stages"].as_array().into_iter().flatten();
    let time = |stage: &Value| {
        let seconds = stage["seconds"]
            .as_f64()
            .filter(|it| *it >= WORTH_TELLING)?;
        Some(format!("{} {seconds:.2} s", stage["name"].as_str()?))
    };
    let times: Vec<String> = stages.filter_map(time).collect();
    if !times.is_empty() {
        rows.push(("Time".to_owned(), times.join(", ")));
    }
    rows
}
