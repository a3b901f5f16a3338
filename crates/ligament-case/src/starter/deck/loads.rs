//! Forces and pressures of a deck.

use std::collections::BTreeMap;

use ligament_mesh::inp::{Keyword, number};

use super::load::Load;
use super::translation::{AXES, Row, Translation, rows};
use crate::starter::text::quoted;

/// Word behind the name of a set in a line of distributed loads, such as `GRAV`, and the numbers behind it.
fn kind_and_numbers(row: Row<'_>) -> (String, Vec<f64>) {
    let fields = row.line.fields();
    let numbers = fields.iter().skip(2).map_while(|it| number(it));
    let kind = fields.get(1).map(|it| it.to_uppercase());
    (kind.unwrap_or_default(), numbers.collect())
}

impl Translation<'_> {
    /// Reads forces at nodes.
    pub(super) fn read_forces(&mut self, keyword: &Keyword) {
        // Forces of single nodes are one load for each component; forces of a set are a separate load.
        let mut loads: BTreeMap<(usize, String), (Row<'_>, BTreeMap<u32, f64>)> = BTreeMap::new();
        for target in self.targets(keyword) {
            let row = target.row;
            let number_at = |place: usize| target.fields.get(place).and_then(|it| number(it));
            let (Some(dof), Some(force)) = (number_at(1), number_at(2)) else {
                self.omit_row(row, "expected a degree of freedom and a force");
                continue;
            };
            if !(1.0..=f64::from(self.places.dimensions())).contains(&dof) {
                self.omit_row(
                    row,
                    "the nodes of these elements have no such degree of freedom",
                );
                continue;
            }
            let axis = dof as usize - 1;
            let mut shares: Vec<(u32, f64)> =
                target.nodes.inside.iter().map(|it| (*it, 1.0)).collect();
            for node in &target.nodes.outside {
                match self.places.ends(*node) {
                    Some(ends) => shares.extend(ends.map(|end| (end, 0.5))),
                    None => self.force_on_platen(row, *node, axis, force),
                }
            }
            let set = if target.is_single {
                String::new()
            } else {
                target.name
            };
            let (_, sum) = loads.entry((axis, set)).or_insert((row, BTreeMap::new()));
            for (node, share) in shares {
                *sum.entry(node).or_default() += share * force;
            }
        }
        for ((axis, set), (row, forces)) in loads {
            let name = if set.is_empty() { row.name() } else { set };
            self.add_forces(row, &name, axis, &forces);
        }
    }

    /// Adds forces at nodes as one load, with a table where they are not in proportion to the volumes of the points.
    fn add_forces(&mut self, row: Row<'_>, name: &str, axis: usize, forces: &BTreeMap<u32, f64>) {
        let size: f64 = forces.values().map(|it| it.abs()).sum();
        if size == 0.0 {
            return;
        }
        let total = size.copysign(forces.values().sum());
        let all = self.places.volumes();
        let volume: f64 = forces.keys().map(|node| all[*node as usize]).sum();
        let factor =
            |(node, force): (&u32, &f64)| (*node, force / total * volume / all[*node as usize]);
        let factors: Vec<(u32, f64)> = forces.iter().map(factor).collect();
        let nodes: Vec<u32> = forces.keys().copied().collect();
        let mut lines = vec![self.places.line_of_nodes(name, nodes.clone())];
        // Volumes are sums in the order of the cells: equal ones differ by rounding.
        if factors.iter().any(|(_, it)| (it - 1.0).abs() > 1e-9) {
            let table = quoted(&self.table("factor", &factors));
            lines.push(format!(
                "profile = {{ file = {table} }} # the force at each node"
            ));
        }
        let size = total * self.units.force;
        let load = Load::new(lines, "force", vec![(AXES[axis], 1.0)], size);
        self.add_load(row, Load { nodes, ..load });
    }

    /// Reads pressures on sides and forces in the volume of elements.
    pub(super) fn read_distributed(&mut self, keyword: &Keyword) {
        let mut pressed: Vec<String> = Vec::new();
        for (row, sides) in rows(keyword).zip(keyword.pressed_sides()) {
            let (kind, numbers) = kind_and_numbers(row);
            let load = match (kind.as_str(), numbers.as_slice(), sides) {
                (_, [pressure, ..], Some(sides)) => {
                    if pressed.contains(&sides) {
                        continue;
                    }
                    pressed.push(sides.clone());
                    self.pressure(row, &sides, *pressure)
                }
                ("GRAV", [size, direction @ ..], _) if direction.len() >= 2 => {
                    self.in_volume(row, "acceleration", direction, *size)
                }
                ("BX" | "BY" | "BZ", [size, ..], _) => {
                    let direction = ["BX", "BY", "BZ"].map(|it| f64::from(it == kind));
                    self.in_volume(row, "body_force", &direction, *size)
                }
                _ => Err("of distributed loads a case has P1 to P6, GRAV, BX, BY and BZ"),
            };
            match load {
                Ok(load) => self.add_load(row, load),
                Err(reason) => self.omit_row(row, reason),
            }
        }
    }

    /// Reads pressures and tractions on surfaces.
    pub(super) fn read_on_surfaces(&mut self, keyword: &Keyword) {
        for row in rows(keyword) {
            let fields = row.line.fields();
            let (kind, numbers) = kind_and_numbers(row);
            let load = match (kind.as_str(), numbers.as_slice()) {
                ("P", [pressure, ..]) => self.pressure(row, &fields[0], *pressure),
                ("TRVEC", [size, direction @ ..]) if direction.len() >= 2 => {
                    self.traction(row, direction, *size)
                }
                _ => Err("of loads on surfaces a case has P and TRVEC"),
            };
            match load {
                Ok(load) => self.add_load(row, load),
                Err(reason) => self.omit_row(row, reason),
            }
        }
    }

    fn sides(&mut self, row: Row<'_>, surface: &str) -> Result<String, &'static str> {
        let dimension = self.places.dimensions() - 1;
        let mut groups = self.places.groups(surface, &row.keyword.scope, dimension);
        let group = groups.pop().ok_or("no such sides in the mesh")?;
        Ok(self.places.line(group))
    }

    fn pressure(&mut self, row: Row<'_>, surface: &str, size: f64) -> Result<Load, &'static str> {
        let lines = vec![self.sides(row, surface)?];
        Ok(Load::new(
            lines,
            "pressure",
            Vec::new(),
            size * self.units.stress(),
        ))
    }

    fn traction(
        &mut self,
        row: Row<'_>,
        direction: &[f64],
        size: f64,
    ) -> Result<Load, &'static str> {
        let lines = vec![self.sides(row, &row.line.fields()[0])?];
        let direction = self.unit_vector(direction)?;
        let stress = size * self.units.stress();
        Ok(match self.places.dimensions() {
            2 => Load::new(
                lines,
                "force_per_length",
                direction,
                stress * self.thickness(),
            ),
            _ => Load::new(lines, "force_per_area", direction, stress),
        })
    }

    /// Components of a unit vector.
    fn unit_vector(&self, vector: &[f64]) -> Result<Vec<(&'static str, f64)>, &'static str> {
        let length = vector.iter().fold(0.0, |sum: f64, it| sum.hypot(*it));
        let dimensions = usize::from(self.places.dimensions());
        if vector.iter().skip(dimensions).any(|it| *it != 0.0) {
            return Err("it acts out of the plane");
        }
        let components = AXES.iter().zip(vector).take(dimensions);
        let components = components.map(|(axis, it)| (*axis, it / length));
        let components: Vec<_> = components.filter(|(_, share)| *share != 0.0).collect();
        if components.is_empty() || length == 0.0 {
            return Err("it has no direction");
        }
        Ok(components)
    }

    fn in_volume(
        &mut self,
        row: Row<'_>,
        key: &'static str,
        direction: &[f64],
        size: f64,
    ) -> Result<Load, &'static str> {
        let direction = self.unit_vector(direction)?;
        let (elements, mut lines) = (row.line.fields().swap_remove(0), Vec::new());
        if !elements.is_empty() {
            let dimension = self.places.dimensions();
            let mut groups = self.places.groups(&elements, &row.keyword.scope, dimension);
            let group = groups.pop().ok_or("no such set of cells in the mesh")?;
            if group.cells.len() < self.places.deck.mesh.n_cells() {
                lines.push(self.places.line(group));
            }
        }
        Ok(Load::new(
            lines,
            key,
            direction,
            size * self.units.for_key(key),
        ))
    }
}
