//! Materials and sections of a deck.

use std::fmt::Write;

use ligament_mesh::inp::{Keyword, number};
use toml_edit::Key;

use super::translation::{Material, Section, Translation, rows, value};
use super::units::{Units, number as text_of};

impl Translation<'_> {
    pub(super) fn begin_material(&mut self, keyword: &Keyword) {
        self.materials.push(Material {
            name: value(keyword, "NAME").unwrap_or_default().to_uppercase(),
            ..Material::default()
        });
    }

    /// Reads a property of the last material.
    pub(super) fn read_property(&mut self, keyword: &Keyword) {
        let kind = value(keyword, "TYPE").unwrap_or_default().to_uppercase();
        if !matches!(kind.as_str(), "" | "ISO" | "ISOTROPIC") {
            self.omit(keyword, "a case from a deck has isotropic materials; law = \"orthotropic\" takes others in the plane");
            return;
        }
        let fields = keyword.data.first().map(|line| line.fields());
        let fields = fields.unwrap_or_default();
        let numbers: Vec<f64> = fields.iter().map_while(|it| number(it)).collect();
        let material = self.materials.last_mut();
        match (keyword.name.as_str(), numbers.as_slice(), material) {
            ("ELASTIC", [young, poisson, ..], Some(it)) => it.elastic = Some([*young, *poisson]),
            ("DENSITY", [density, ..], Some(it)) => it.density = Some(*density),
            ("EXPANSION", [expansion, ..], Some(it)) => it.expansion = Some(*expansion),
            _ => {
                return self.omit(
                    keyword,
                    "it has no numbers, or stands before the first *MATERIAL",
                );
            }
        }
        if let Some(row) = rows(keyword).nth(1) {
            self.omit_row(
                row,
                "constants that depend on temperature: the first line holds",
            );
        }
    }

    /// Reads the cells that a material fills, and their thickness.
    pub(super) fn read_section(&mut self, keyword: &Keyword) {
        let (elements, material) = (value(keyword, "ELSET"), value(keyword, "MATERIAL"));
        let (Some(elements), Some(material)) = (elements, material) else {
            return self.omit(keyword, "it names no ELSET or no MATERIAL");
        };
        let dimensions = self.places.dimensions();
        let groups = self.places.groups(elements, &keyword.scope, dimensions);
        if groups.is_empty() {
            return self.omit(keyword, "its elements are no cells of the body");
        }
        let material = material.to_uppercase();
        self.sections.push(Section { material, groups });
        let first = keyword
            .data
            .first()
            .and_then(|line| number(line.fields().first()?));
        if let (Some(thickness), 2) = (first.filter(|it| *it > 0.0), dimensions) {
            match *self.thickness.get_or_insert(thickness) {
                one if one == thickness => {}
                _ => self.omit(
                    keyword,
                    "a body has one thickness, that of the first section",
                ),
            }
        }
    }

    /// Text of the materials that sections use, each with its cells where there are several.
    pub(super) fn material_text(&mut self) -> String {
        let mut sections = std::mem::take(&mut self.sections);
        if sections
            .iter()
            .all(|it| it.material == sections[0].material)
        {
            let only = sections.first().map(|it| it.material.clone());
            let named = self
                .materials
                .iter()
                .find(|it| Some(&it.name) == only.as_ref());
            let material = named.or(self.materials.last()).cloned().unwrap_or_default();
            return format!(
                "[material] # {}\n{}",
                material.name,
                self.constants(&material)
            );
        }
        let mut text = String::new();
        let mut used: Vec<String> = Vec::new();
        for section in &mut sections {
            let named = self.materials.iter().find(|it| it.name == section.material);
            let material = named.cloned().unwrap_or_default();
            for group in std::mem::take(&mut section.groups) {
                let count = used.iter().filter(|it| **it == section.material).count();
                used.push(section.material.clone());
                let name = match count {
                    0 => section.material.clone(),
                    _ => format!("{}-{}", section.material, count + 1),
                };
                let key = Key::new(name).display_repr().into_owned();
                let group = self.places.line(group);
                let constants = self.constants(&material);
                let _ = writeln!(text, "[material.{key}]\n{group}\n{constants}");
            }
        }
        text.truncate(text.trim_end().len());
        text + "\n"
    }

    fn constants(&self, material: &Material) -> String {
        let units = self.units;
        let mut text = match material.elastic {
            Some([young, poisson]) => format!(
                "young = {} # Pa\npoisson = {}\n",
                text_of(young * units.stress()),
                text_of(poisson)
            ),
            None => "young = 3e10 # Pa, EXAMPLE\npoisson = 0.2 # EXAMPLE\n".to_owned(),
        };
        let further = [
            ("density", material.density, units.density(), "kg/m^3"),
            (
                "thermal_expansion",
                material.expansion,
                1.0 / units.temperature,
                "1/K",
            ),
        ];
        for (key, given, unit, words) in further {
            if let Some(given) = given {
                let _ = writeln!(text, "{key} = {} # {words}", text_of(given * unit));
            }
        }
        text + "#tensile_strength = 3e6 # Pa, EXAMPLE\n"
    }

    /// Warning about implausible numbers that other units would explain; None where a system of units was chosen.
    pub(super) fn unit_warning(&self, is_chosen: bool) -> Option<String> {
        let looks_other = |it: &&Material| {
            it.elastic
                .is_some_and(|[young, _]| (1.0..1e7).contains(&young))
                || it.density.is_some_and(|density| density < 1e-2)
        };
        let other = self
            .materials
            .iter()
            .find(looks_other)
            .filter(|_| !is_chosen)?;
        let systems = Units::ALL.map(|it| it.name)[1..].join(", ");
        let young = other.elastic.map_or(0.0, |[young, _]| young);
        Some(format!(
            "the material {} has a Young's modulus of {} as if in other units than m, N and Pa: say which by --units ({systems})",
            other.name,
            text_of(young)
        ))
    }
}
