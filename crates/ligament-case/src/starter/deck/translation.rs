//! Translation of a deck into a case: contents read so far, and omissions.

use std::collections::BTreeMap;
use std::fmt::Write;

use ligament_mesh::inp::{DataLine, Deck, Keyword};
use ligament_mesh::{FileLine, Group};

use super::amplitude::{Amplitude, Procedure, Step};
use super::load::{Load, Value};
use super::places::{Nodes, Places};
use super::units::Units;

pub(super) const AXES: [&str; 3] = ["x", "y", "z"];

/// A material, in units of the deck.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Material {
    pub(super) name: String,
    /// Young's modulus and Poisson's ratio.
    pub(super) elastic: Option<[f64; 2]>,
    pub(super) density: Option<f64>,
    pub(super) expansion: Option<f64>,
}

/// Cells with a material.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Section {
    pub(super) material: String,
    pub(super) groups: Vec<Group>,
}

/// Kinds of motion of nodes with a reference node.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// The nodes move as a rigid body.
    Rigid,
    /// The mean of the nodes moves with the reference node, whose forces are spread over them.
    Spread,
    /// One degree of freedom of the nodes equals the one of the reference node.
    Tied(usize),
}

/// Nodes that follow a reference node.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Platen {
    pub(super) keyword: Keyword,
    pub(super) reference: u64,
    pub(super) kind: Kind,
    pub(super) nodes: Vec<u32>,
    /// Whether the reference node does not turn.
    pub(super) is_upright: bool,
    /// Whether something moves, holds or loads the platen.
    pub(super) is_used: bool,
}

/// A data line with its keyword.
#[derive(Debug, Clone, Copy)]
pub(super) struct Row<'k> {
    pub(super) keyword: &'k Keyword,
    pub(super) line: &'k DataLine,
}

/// Data lines of a keyword.
pub(super) fn rows(keyword: &Keyword) -> impl Iterator<Item = Row<'_>> {
    keyword.data.iter().map(move |line| Row { keyword, line })
}

impl Row<'_> {
    /// Name by the keyword and the line of the deck.
    pub(super) fn name(&self) -> String {
        let keyword = self.keyword.name.to_lowercase();
        format!("{keyword}-{}", self.line.line.number)
    }
}

/// Nodes to which a data line gives the rest of its fields.
pub(super) struct Target<'k> {
    pub(super) row: Row<'k>,
    /// Name of the set, or a name for single nodes.
    pub(super) name: String,
    pub(super) fields: Vec<String>,
    /// Whether the nodes are given by their numbers.
    pub(super) is_single: bool,
    pub(super) nodes: Nodes,
}

/// An omitted place of the deck.
pub(super) struct Omission {
    pub(super) keyword: Keyword,
    pub(super) line: FileLine,
    /// Number of lines with the same reason.
    pub(super) lines: usize,
    pub(super) reason: String,
}

/// State of the translation of a deck into a case.
pub(super) struct Translation<'a> {
    pub(super) places: Places<'a>,
    pub(super) units: Units,
    /// Prefix of the names of tables.
    pub(super) stem: String,
    pub(super) title: Option<String>,
    pub(super) thickness: Option<f64>,
    pub(super) materials: Vec<Material>,
    pub(super) sections: Vec<Section>,
    pub(super) amplitudes: Vec<Amplitude>,
    pub(super) platens: Vec<Platen>,
    pub(super) steps: Vec<Step>,
    /// Whether the present step is left out.
    pub(super) is_left_out: bool,
    pub(super) loads: Vec<Load>,
    /// Initial temperatures by nodes, in units of the deck.
    pub(super) initial: BTreeMap<u32, f64>,
    /// Initial velocities by places and axes, m/s.
    pub(super) velocities: BTreeMap<String, BTreeMap<&'static str, f64>>,
    pub(super) heating: String,
    pub(super) heated_in: Option<usize>,
    pub(super) tables: Vec<(String, String)>,
    pub(super) left_out: Vec<Omission>,
}

/// Value of a parameter of a keyword.
pub(super) fn value<'k>(keyword: &'k Keyword, name: &str) -> Option<&'k str> {
    keyword.parameter(name)?.value.as_deref()
}

/// Whether a keyword replaces the contents of all earlier ones of its kind.
pub(super) fn replaces_all(keyword: &Keyword) -> bool {
    value(keyword, "OP").is_some_and(|it| it.eq_ignore_ascii_case("NEW"))
}

impl<'a> Translation<'a> {
    pub(super) fn new(deck: &'a Deck, mesh: &str, units: Units) -> Self {
        let stem = mesh.rsplit('/').next().unwrap_or(mesh);
        Self {
            places: Places::new(deck),
            units,
            stem: stem.trim_end_matches(".msh").to_owned(),
            title: None,
            thickness: None,
            materials: Vec::new(),
            sections: Vec::new(),
            amplitudes: Vec::new(),
            platens: Vec::new(),
            steps: Vec::new(),
            is_left_out: false,
            loads: Vec::new(),
            initial: BTreeMap::new(),
            velocities: BTreeMap::new(),
            heating: String::new(),
            heated_in: None,
            tables: Vec::new(),
            left_out: Vec::new(),
        }
    }

    /// Notes that a keyword is omitted or changed.
    pub(super) fn omit(&mut self, keyword: &Keyword, reason: &str) {
        self.leave_line(keyword, &keyword.line, reason);
    }

    /// Notes that a data line is omitted or changed.
    pub(super) fn omit_row(&mut self, row: Row<'_>, reason: &str) {
        self.leave_line(row.keyword, &row.line.line, reason);
    }

    fn leave_line(&mut self, keyword: &Keyword, line: &FileLine, reason: &str) {
        let is_same = |it: &&mut Omission| it.reason == reason && it.keyword.line == keyword.line;
        match self.left_out.iter_mut().find(is_same) {
            Some(same) => same.lines += 1,
            None => self.left_out.push(Omission {
                keyword: keyword.clone(),
                line: line.clone(),
                lines: 1,
                reason: reason.to_owned(),
            }),
        }
    }

    /// Nodes that the data lines of a keyword name; single nodes with the same values are one target.
    pub(super) fn targets<'k>(&mut self, keyword: &'k Keyword) -> Vec<Target<'k>> {
        let mut targets: Vec<Target<'k>> = Vec::new();
        let mut singles: BTreeMap<Vec<String>, usize> = BTreeMap::new();
        for row in rows(keyword) {
            let fields = row.line.fields();
            let nodes = self.places.find(&fields[0], &keyword.scope);
            if nodes == Nodes::default() {
                self.omit_row(row, "no such node or set in the mesh");
                continue;
            }
            let is_single = self.places.number(&fields[0], &keyword.scope).is_some();
            let same = singles.get(&fields[1..]).filter(|_| is_single);
            if let Some(same) = same.and_then(|it| targets.get_mut(*it)) {
                same.nodes.inside.extend(nodes.inside);
                same.nodes.outside.extend(nodes.outside);
                continue;
            }
            if is_single {
                singles.insert(fields[1..].to_vec(), targets.len());
            }
            targets.push(Target {
                row,
                name: if is_single {
                    row.name()
                } else {
                    fields[0].clone()
                },
                fields,
                is_single,
                nodes,
            });
        }
        targets
    }

    /// Thickness of a body in the plane, m: without one of the deck it is a unit of length.
    pub(super) fn thickness(&self) -> f64 {
        self.thickness.unwrap_or(1.0) * self.units.length
    }

    /// Procedure of the deck.
    pub(super) fn procedure(&self) -> Procedure {
        let first = self.steps.first();
        first.map_or(Procedure::Static, |it| it.procedure)
    }

    /// Adds the value that a line gives to a load, which may be one of an earlier step.
    pub(super) fn add_load(&mut self, row: Row<'_>, mut load: Load) {
        let Ok(amplitude) = self.amplitude(row.keyword) else {
            return;
        };
        let step = self.steps.len().max(1);
        if self.procedure().is_motion() && step > 1 {
            return self.omit_row(row, "a motion has one step");
        }
        for value in &mut load.values {
            value.step = step;
            value.amplitude.clone_from(&amplitude);
        }
        let is_same = |it: &Load| {
            (&it.lines, it.key, &it.direction) == (&load.lines, load.key, &load.direction)
        };
        if let Some(same) = self.loads.iter().position(is_same) {
            return self.loads[same].values.append(&mut load.values);
        }
        if self.covers_load_partly(row.keyword, &load) {
            let reason =
                "it would change a part of a load of an earlier step: give both for the same sets";
            return self.omit_row(row, reason);
        }
        let names = load.direction.iter().map(|(axis, _)| format!("-{axis}"));
        let mut name = row.name() + &names.collect::<String>();
        while self.loads.iter().any(|it| it.name == name) {
            name += "-also";
        }
        load.name = name;
        self.loads.push(load);
    }

    /// Whether a load of a later step covers only some places of an earlier load, whose other places keep their values.
    fn covers_load_partly(&self, keyword: &Keyword, load: &Load) -> bool {
        let step = self.steps.len();
        let is_single = |it: &Load| it.lines.first().is_some_and(|it| it.contains("\"dload-"));
        let meets = |it: &Load| {
            let is_shared = |node: &u32| it.nodes.binary_search(node).is_ok();
            let is_held = it.size() == load.size() && it.values.len() == 1;
            let is_other = it.key == "force" || !is_held;
            is_other && load.nodes.iter().any(is_shared) || is_single(it) && is_single(load)
        };
        let mut earlier = self.loads.iter().filter(|it| {
            let is_earlier = it.values.iter().all(|value| value.step < step);
            is_earlier && (it.key, &it.direction) == (load.key, &load.direction)
        });
        !replaces_all(keyword) && earlier.any(meets)
    }

    /// The amplitude that a keyword names; an error for an omitted one.
    fn amplitude(&mut self, keyword: &Keyword) -> Result<Option<Amplitude>, ()> {
        let Some(name) = value(keyword, "AMPLITUDE") else {
            return Ok(None);
        };
        let found = self
            .amplitudes
            .iter()
            .find(|it| it.name.eq_ignore_ascii_case(name));
        match found {
            Some(amplitude) => Ok(Some(amplitude.clone())),
            None => {
                self.omit(keyword, "its AMPLITUDE is none of those carried out");
                Err(())
            }
        }
    }

    /// Sets the earlier loads of a keyword to zero where it replaces them without repeating them.
    pub(super) fn replace_earlier(&mut self, keyword: &Keyword, first: usize) {
        if !replaces_all(keyword) || first < 2 {
            return;
        }
        let name = format!("{}-", keyword.name.to_lowercase());
        for load in self
            .loads
            .iter_mut()
            .filter(|it| it.name.starts_with(&name))
        {
            if load.values.iter().all(|it| it.step < first) {
                load.values.push(Value {
                    step: first,
                    size: 0.0,
                    amplitude: None,
                });
            }
        }
    }

    /// Name of a table with a value at each of some nodes; an existing equal table is reused.
    pub(super) fn table(&mut self, column: &str, values: &[(u32, f64)]) -> String {
        let solid = self.places.dimensions() > 2;
        let mut text = format!("x,y,{}{column}\n", if solid { "z," } else { "" });
        for (node, value) in values {
            for coordinate in self.places.position(*node) {
                let _ = write!(text, "{:?},", coordinate * self.units.length);
            }
            let _ = writeln!(text, "{value:?}");
        }
        let same = self.tables.iter().find(|(_, it)| *it == text);
        if let Some((name, _)) = same {
            return name.clone();
        }
        let name = format!("{}-{column}-{}.csv", self.stem, self.tables.len() + 1);
        self.tables.push((name.clone(), text));
        name
    }
}
