//! Mesh, materials, supports and loads of a run as static HTML, from its resolved case.

use std::path::Path;

use ligament_model::failure::softening::Law;
use ligament_output::Error;
use ligament_plot::stored_loading::resolved_case;
use toml::{Table, Value};

use crate::parts::UnitOf;
use crate::summary::{Entry, quantity, table};

/// Sections of single entries, and sections that are lists of entries with the noun of one.
const SECTIONS: [&str; 5] = ["mesh", "lattice", "solid_lattice", "points", "material"];
const LISTS: [[&str; 2]; 4] = [
    ["support", "Support"],
    ["load", "Load"],
    ["precrack", "Pre-crack"],
    ["probe", "Probe"],
];

/// Keys that name an entry of a list, and are not repeated among its values.
const NAMES: [&str; 2] = ["name", "group"];

/// The inputs of a run: its case, and the units of the keys.
pub(crate) struct Inputs {
    case: Table,
    unit_of: UnitOf,
}

impl Inputs {
    /// Reads the resolved case in a folder of results.
    ///
    /// # Errors
    ///
    /// If it cannot be read.
    pub(crate) fn read(folder: &Path, unit_of: UnitOf) -> Result<Self, Error> {
        let case = resolved_case(folder)?;
        Ok(Self { case, unit_of })
    }

    /// The resolved case.
    pub(crate) fn case(&self) -> &Table {
        &self.case
    }

    /// The fracture energy of the only material, J/m^2.
    pub(crate) fn fracture_energy(&self) -> Option<f64> {
        self.case
            .get("material")?
            .get("fracture_energy")?
            .as_float()
    }

    /// Tables of body, supports and loads as HTML.
    pub(crate) fn html(&self) -> String {
        let mut body = Vec::new();
        for name in SECTIONS {
            if let Some(Value::Table(section)) = self.case.get(name) {
                self.rows(section, name, "", &mut body);
            }
        }
        let mut loading = Vec::new();
        for [name, noun] in LISTS {
            let entries = self.case.get(name).and_then(Value::as_array);
            for (number, entry) in entries.into_iter().flatten().enumerate() {
                loading.extend(self.entry(entry, &format!("{name}.{number}"), noun));
            }
        }
        table("Body and material", &body)
            + &table("Supports and loads", &loading)
            + &self.softening()
    }

    /// Drawings of the laws of softening as HTML.
    fn softening(&self) -> String {
        let criteria = self.case.get("fracture").and_then(|it| it.get("criterion"));
        let criteria = criteria.and_then(Value::as_array).into_iter().flatten();
        let mut laws: Vec<Law> = Vec::new();
        for law in criteria.filter_map(|it| it.get("after")?.clone().try_into().ok()) {
            if !laws.contains(&law) {
                laws.push(law);
            }
        }
        laws.iter().filter_map(drawing).collect()
    }

    /// Rows of the keys of a table; nested tables have their name before each key.
    fn rows(&self, section: &Table, path: &str, within: &str, rows: &mut Vec<Entry>) {
        for (key, value) in section {
            let path = format!("{path}.{key}");
            let words = format!("{within}{}", key.replace('_', " "));
            match value {
                Value::Table(inner) => self.rows(inner, &path, &format!("{words}: "), rows),
                _ => rows.push((words, self.text(value, &path))),
            }
        }
    }

    /// Row of an entry of a list.
    fn entry(&self, entry: &Value, path: &str, noun: &str) -> Option<Entry> {
        let entry = entry.as_table()?;
        let mut named: Vec<&str> = NAMES
            .iter()
            .filter_map(|it| entry.get(*it)?.as_str())
            .collect();
        named.dedup();
        let others = entry
            .iter()
            .filter(|(key, _)| !NAMES.contains(&key.as_str()));
        let words = others.map(|(key, value)| {
            let text = self.text(value, &format!("{path}.{key}"));
            format!("{}: {text}", key.replace('_', " "))
        });
        let name = format!("{noun} {}", named.join(" at "));
        Some((
            name.trim_end().to_owned(),
            words.collect::<Vec<String>>().join("; "),
        ))
    }

    /// A value with its unit.
    fn text(&self, value: &Value, path: &str) -> String {
        let unit = || (self.unit_of)(path).unwrap_or("-");
        match value {
            Value::Float(number) => quantity(*number, unit()),
            Value::Integer(number) => number.to_string(),
            Value::String(text) => text.rsplit(['/', '\\']).next().unwrap_or(text).to_owned(),
            Value::Array(all) => {
                let all = all.iter().map(|it| self.text(it, path));
                format!("({})", all.collect::<Vec<String>>().join(", "))
            }
            Value::Table(all) => {
                let one = |(key, it): (&String, &Value)| {
                    format!("{key} = {}", self.text(it, &format!("{path}.{key}")))
                };
                all.iter().map(one).collect::<Vec<String>>().join(", ")
            }
            other => other.to_string(),
        }
    }
}

/// Stress over the opening of a crack by a law of softening, drawn as HTML; None for a law that no fracture energy decides about.
fn drawing(law: &Law) -> Option<String> {
    const SIZE: [f64; 2] = [320.0, 150.0];
    const MARGIN: f64 = 24.0;
    let curve = law.stress_over_opening()?;
    let end = curve.last()?[0];
    let points = curve.iter().map(|[opening, stress]| {
        let x = MARGIN + opening / end * (SIZE[0] - 2.0 * MARGIN);
        let y = MARGIN + (1.0 - stress) * (SIZE[1] - 2.0 * MARGIN);
        format!("{x:.1},{y:.1}")
    });
    let points: Vec<String> = points.collect();
    let ([width, height], base) = (SIZE, SIZE[1] - MARGIN);
    let right = width - MARGIN;
    Some(format!(
        "<section class=\"card\"><h3>Softening: {word}</h3>\
         <svg viewBox=\"0 0 {width} {height}\" role=\"img\" aria-label=\"{words}\" fill=\"none\" stroke=\"currentColor\">\
         <path d=\"M{MARGIN},{MARGIN}V{base}H{right}\" opacity=\"0.5\"/><polyline points=\"{points}\" stroke-width=\"2\"/>\
         <g fill=\"currentColor\" stroke=\"none\" font-size=\"11\"><text x=\"2\" y=\"{MARGIN}\">f_t</text>\
         <text x=\"{right}\" y=\"{below}\" text-anchor=\"end\">{end:.2} G_c/f_t</text></g></svg>\
         <p>Stress over the opening of a crack.</p></section>\n",
        word = law.word,
        words = law.words,
        points = points.join(" "),
        below = height - 6.0,
    ))
}
