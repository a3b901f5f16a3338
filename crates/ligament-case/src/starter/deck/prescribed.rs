//! Components of nodes that are held or moved.

use std::fmt::Write;

use ligament_mesh::inp::number;

use super::load::Load;
use super::translation::{Row, Translation, value};

/// Components of the motion of a node by the numbers of its degrees of freedom, in the plane and in space.
pub(super) const COMPONENTS: [[Option<&str>; 6]; 2] = [
    [Some("x"), Some("y"), None, None, None, Some("rotation")],
    [
        Some("x"),
        Some("y"),
        Some("z"),
        Some("rotation_x"),
        Some("rotation_y"),
        Some("rotation_z"),
    ],
];

/// Words for degrees of freedom that are held together.
const HELD: [(&str, &[usize]); 8] = [
    ("ENCASTRE", &[1, 2, 3, 4, 5, 6]),
    ("PINNED", &[1, 2, 3]),
    ("XSYMM", &[1, 5, 6]),
    ("YSYMM", &[2, 4, 6]),
    ("ZSYMM", &[3, 4, 5]),
    ("XASYMM", &[2, 3, 4]),
    ("YASYMM", &[1, 3, 5]),
    ("ZASYMM", &[1, 2, 6]),
];

/// Degrees of freedom of a line of `*BOUNDARY`, and the value that they have.
pub(super) fn degrees_of_freedom(fields: &[String]) -> Option<(Vec<usize>, f64)> {
    let word = fields.get(1)?.to_uppercase();
    if let Some((_, held)) = HELD.iter().find(|(name, _)| *name == word) {
        return Some((held.to_vec(), 0.0));
    }
    let at = |place: usize| fields.get(place).filter(|it| !it.is_empty());
    let first = number(&word)? as usize;
    let last = at(2).map_or(Some(first), |it| Some(number(it)? as usize))?;
    let size = at(3).map_or(Some(0.0), |it| number(it))?;
    ((1..=6).contains(&first) && last <= 6).then(|| ((first..=last).collect(), size))
}

impl Translation<'_> {
    /// Prescribes the component of a load at nodes, with a name for them.
    pub(super) fn prescribe(
        &mut self,
        row: Row<'_>,
        name: &str,
        mut nodes: Vec<u32>,
        mut load: Load,
    ) {
        if nodes.is_empty() {
            return;
        }
        let (size, is_motion) = (load.size(), self.procedure().is_motion());
        let jumps = is_motion && load.key == "displacement" && size != 0.0;
        if jumps && value(row.keyword, "AMPLITUDE").is_none() {
            return self.omit_row(row, "a displacement without an AMPLITUDE would jump");
        }
        nodes.sort_unstable();
        nodes.dedup();
        let place = self.places.line_of_nodes(name, nodes.clone());
        load.lines.insert(0, place);
        load.nodes = nodes;
        let is_same = |it: &Load| (&it.lines, &it.direction) == (&load.lines, &load.direction);
        if self.steps.len() > 1 && size == 0.0 && !self.loads.iter().any(is_same) {
            self.omit_row(
                row,
                "a support holds from the start, not from a later step on",
            );
        }
        self.add_load(row, load);
    }

    /// Removes the nodes of a load from earlier loads that prescribe another value of the same component: the last one applies.
    pub(super) fn override_earlier_loads(&mut self) {
        for index in 0..self.loads.len() {
            let Load {
                nodes,
                key,
                direction,
                ..
            } = &self.loads[index];
            if *key == "force" {
                continue;
            }
            let later = self.loads[index + 1..].iter().filter(|it| {
                (it.key != "force" && it.direction == *direction)
                    && (it.size() != self.loads[index].size() || it.values.len() > 1)
            });
            let mut taken = vec![false; nodes.len()];
            for node in later.flat_map(|it| &it.nodes) {
                if let Ok(place) = nodes.binary_search(node) {
                    taken[place] = true;
                }
            }
            if taken.contains(&true) {
                let left = nodes.iter().zip(&taken).filter(|(_, taken)| !**taken);
                let left: Vec<u32> = left.map(|(node, _)| *node).collect();
                let name = format!("{}-rest", self.loads[index].name);
                let line = match left.is_empty() {
                    true => String::new(),
                    false => self.places.line_of_nodes(&name, left.clone()),
                };
                self.loads[index].lines[0] = line;
                self.loads[index].nodes = left;
            }
        }
        self.loads
            .retain(|it| !it.lines.first().is_some_and(String::is_empty));
    }

    /// Text of the supports, each with all components that it holds.
    pub(super) fn support_text(&self, supports: &[&Load]) -> String {
        let mut places: Vec<(&str, Vec<&str>)> = Vec::new();
        for load in supports {
            let (place, component) = (load.lines[0].as_str(), load.direction[0].0);
            match places.iter_mut().find(|(it, _)| *it == place) {
                Some((_, components)) => components.push(component),
                None => places.push((place, vec![component])),
            }
        }
        let mut text = String::new();
        for (place, components) in places {
            let held: Vec<String> = components.iter().map(|it| format!("{it} = 0.0")).collect();
            let _ = writeln!(
                text,
                "[[support]]\n{place}\ndisplacement = {{ {} }}\n",
                held.join(", ")
            );
        }
        text
    }
}
