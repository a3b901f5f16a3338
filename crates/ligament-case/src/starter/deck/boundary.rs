//! Boundary conditions of a deck: nodes that are held or moved.

use ligament_mesh::inp::{Keyword, number};

use super::load::Load;
use super::prescribed::{COMPONENTS, degrees_of_freedom};
use super::translation::{AXES, Row, Translation, replaces_all, value};

impl Translation<'_> {
    /// Reads nodes that are held or moved.
    pub(super) fn read_boundary(&mut self, keyword: &Keyword) {
        let kind = value(keyword, "TYPE").unwrap_or_default().to_uppercase();
        let key = match kind.as_str() {
            "" | "DISPLACEMENT" => "displacement",
            "VELOCITY" => "velocity",
            "ACCELERATION" => "base_acceleration",
            _ => {
                return self.omit(
                    keyword,
                    "its TYPE is none of DISPLACEMENT, VELOCITY and ACCELERATION",
                );
            }
        };
        if key != "displacement" && !self.procedure().is_motion() {
            return self.omit(keyword, "velocities and accelerations belong to a motion");
        }
        if replaces_all(keyword) && self.steps.len() > 1 {
            let reason = "OP=NEW frees what earlier steps hold; it stays held, and what the lines give is carried out";
            self.omit(keyword, reason);
        }
        for target in self.targets(keyword) {
            let row = target.row;
            let Some((dofs, size)) = degrees_of_freedom(&target.fields) else {
                self.omit_row(
                    row,
                    "expected degrees of freedom from 1 to 6, or such a word as ENCASTRE",
                );
                continue;
            };
            self.move_platens(row, &target.nodes.outside, &dofs, size);
            for (component, unit) in self.components(row, &dofs, key) {
                let load = Load::new(Vec::new(), key, vec![(component, 1.0)], size * unit);
                self.prescribe(row, &target.name, target.nodes.inside.clone(), load);
            }
        }
    }

    /// Components of the body among degrees of freedom, with their units.
    fn components(&mut self, row: Row<'_>, dofs: &[usize], key: &str) -> Vec<(&'static str, f64)> {
        let all = COMPONENTS[usize::from(self.places.dimensions() > 2)];
        let (unit, length) = (self.units.for_key(key), self.units.length);
        let component = |dof: &usize| {
            let turns = *dof > AXES.len();
            Some((all[dof - 1]?, if turns { unit / length } else { unit }))
        };
        let components: Vec<_> = dofs.iter().filter_map(component).collect();
        if components.is_empty() {
            self.omit_row(row, "a body in the plane has no such degree of freedom");
        }
        components
    }

    /// Reads initial velocities and temperatures.
    pub(super) fn read_initial_conditions(&mut self, keyword: &Keyword) {
        let kind = value(keyword, "TYPE").unwrap_or_default().to_uppercase();
        for target in self.targets(keyword) {
            let at = |place: usize| target.fields.get(place).and_then(|it| number(it));
            let nodes = target.nodes.inside;
            match (kind.as_str(), at(1), at(2)) {
                ("TEMPERATURE", Some(temperature), _) => {
                    for node in nodes {
                        self.initial.insert(node, temperature);
                    }
                }
                ("VELOCITY", Some(dof), Some(size)) if (1.0..=3.0).contains(&dof) => {
                    let place = self.places.line_of_nodes(&target.name, nodes);
                    let size = size * self.units.for_key("velocity");
                    let velocity = self.velocities.entry(place).or_default();
                    velocity.insert(AXES[dof as usize - 1], size);
                }
                _ => self.omit_row(
                    target.row,
                    "of initial conditions a case has VELOCITY and TEMPERATURE",
                ),
            }
        }
    }
}
