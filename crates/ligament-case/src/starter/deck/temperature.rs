//! Changes of temperature in a deck.

use std::collections::BTreeMap;

use ligament_mesh::inp::{Keyword, number};

use super::translation::{Row, Translation, value};
use super::units::number as text_of;
use crate::starter::text::quoted;

impl Translation<'_> {
    /// Reads temperatures at nodes, as changes from the initial temperatures.
    pub(super) fn read_temperatures(&mut self, keyword: &Keyword) {
        let step = self.steps.len().max(1);
        let reason = match self.heated_in {
            _ if self.procedure().is_motion() => Some("a motion has no changes of temperature"),
            _ if value(keyword, "FILE").is_some() => {
                Some("temperatures from results of another analysis")
            }
            Some(first) if first != step => Some("temperatures change in one step of a case"),
            _ => None,
        };
        if let Some(reason) = reason {
            return self.omit(keyword, reason);
        }
        if value(keyword, "AMPLITUDE").is_some() {
            self.omit(keyword, "AMPLITUDE: temperatures change in proportion");
        }
        let mut single: Option<(Row<'_>, BTreeMap<u32, f64>)> = None;
        for target in self.targets(keyword) {
            let Some(temperature) = target.fields.get(1).and_then(|it| number(it)) else {
                self.omit_row(target.row, "expected a temperature");
                continue;
            };
            let change = |node: u32| {
                let start = self.initial.get(&node).copied().unwrap_or(0.0);
                (node, (temperature - start) * self.units.temperature)
            };
            let changes: BTreeMap<u32, f64> =
                target.nodes.inside.iter().map(|it| change(*it)).collect();
            if target.is_single {
                let (_, all) = single.get_or_insert((target.row, BTreeMap::new()));
                all.extend(changes);
            } else {
                self.add_temperatures(&target.name, changes, step);
            }
        }
        if let Some((row, changes)) = single {
            self.add_temperatures(&row.name(), changes, step);
        }
    }

    /// Adds changes of temperature at nodes (K), with a name for these nodes.
    fn add_temperatures(&mut self, name: &str, changes: BTreeMap<u32, f64>, step: usize) {
        let Some(first) = changes.values().next().copied() else {
            return;
        };
        let is_whole = changes.len() == self.places.deck.mesh.n_nodes();
        let what = match changes.values().all(|it| *it == first) {
            true => format!("change = {} # K\n", text_of(first)),
            false => {
                let changes: Vec<(u32, f64)> = changes.iter().map(|(a, b)| (*a, *b)).collect();
                format!("file = {} # K\n", quoted(&self.table("change", &changes)))
            }
        };
        let place = match is_whole {
            true => String::new(),
            false => {
                self.places
                    .line_of_nodes(name, changes.into_keys().collect())
                    + "\n"
            }
        };
        self.heated_in = Some(step);
        self.heating += &format!("[[temperature]]\n{place}{what}\n");
    }
}
