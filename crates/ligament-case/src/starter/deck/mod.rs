//! The case of an input deck of Abaqus or CalculiX: the content of the deck beside its mesh, in SI units.
//!
//! Each file has the keywords of one part of a case. What a case cannot say is left out by [`Translation::omit`], with its line, and stands in
//! the case as a comment.

mod amplitude;
mod boundary;
mod load;
mod loads;
mod materials;
mod places;
mod platens;
mod prescribed;
mod steps;
mod temperature;
mod translation;
mod units;

use std::fmt::Write;

use ligament::setup::Law;
use ligament_mesh::AnyMesh;
use ligament_mesh::inp::{Deck, Keyword, Parameter, Plane};

use super::text::{deck_examples, deck_model, quoted};
use super::{Starter, StarterError, check_law};
use amplitude::{Amplitude, Procedure};
use load::Load;
use translation::{Omission, Translation};
pub use units::Units;

/// Beginnings of keywords without a counterpart in a case, with the reason.
const LEFT_OUT: [(&str, &str); 14] = [
    ("CONTACT", "a case has [[contact]] and [[rigid]]"),
    ("SURFACE ", "a case has [[contact]] and [[rigid]]"),
    ("FRICTION", "a case has [[contact]] and [[rigid]]"),
    ("TIE", "parts are joined where their meshes share nodes"),
    ("COHESIVE", "cracks may run anywhere: a case has [fracture]"),
    ("DAMAGE", "a case has [fracture]"),
    ("PLASTIC", "the material is elastic until it breaks"),
    ("CONCRETE", "a case has [fracture]"),
    ("NODE ", "a case has [output] and [[probe]]"),
    ("EL ", "a case has [output] and [[probe]]"),
    ("ELEMENT ", "a case has [output] and [[probe]]"),
    ("OUTPUT", "a case has [output] and [[probe]]"),
    ("ENERGY ", "a case has [output] and [[probe]]"),
    ("RESTART", "a case has [output] and [[probe]]"),
];

/// A case from a deck, with tables and the count of omissions.
#[derive(Debug, Clone, PartialEq)]
pub struct DeckCase {
    /// Text of the case, with its warnings.
    pub starter: Starter,
    /// Tables that the case reads from its folder: names and contents.
    pub tables: Vec<(String, String)>,
    /// Number of omitted places of the deck.
    pub left_out: usize,
}

/// Case of an input deck; the mesh of the deck gets the groups that the case needs. The two names are the name of the deck and the path of the
/// mesh file from the folder of the case; without `units` the deck is in SI units.
///
/// # Errors
///
/// If the law is not for the body of the deck.
pub fn deck_case(
    deck: &mut Deck,
    [name, mesh]: [&str; 2],
    units: Option<Units>,
    law: Law,
) -> Result<DeckCase, StarterError> {
    check_law(law, matches!(deck.mesh, AnyMesh::Solid(_)))?;
    let mut translation = Translation::new(deck, mesh, units.unwrap_or(Units::SI));
    translation.read();
    let warnings: Vec<String> = translation
        .unit_warning(units.is_some())
        .into_iter()
        .collect();
    let text = translation.text([name, mesh], law, &warnings);
    let (n_loads, n_steps) = (translation.loads.len(), translation.steps.len());
    let units = translation.units.name;
    let choice = format!("from {name} in {units}, supports and loads: {n_loads}, steps: {n_steps}");
    let (added, tables) = (translation.places.added, translation.tables);
    let left_out = translation.left_out.len();
    let groups = match &mut deck.mesh {
        AnyMesh::Plane(mesh) => &mut mesh.groups,
        AnyMesh::Solid(mesh) => &mut mesh.groups,
    };
    groups.extend(added);
    groups.sort_by_key(|it| (it.dimension, it.number));
    let starter = Starter {
        text,
        choice,
        warnings,
    };
    Ok(DeckCase {
        starter,
        tables,
        left_out,
    })
}

impl Translation<'_> {
    /// Reads all keywords, first the keywords to which others refer.
    fn read(&mut self) {
        let keywords = &self.places.deck.keywords;
        self.find_platens();
        for keyword in keywords.iter().filter(|it| it.is("AMPLITUDE")) {
            match Amplitude::new(keyword) {
                Some(amplitude) => self.amplitudes.push(amplitude),
                None => self.omit(
                    keyword,
                    "amplitudes are tables of pairs, or a smooth step from 0 to 1",
                ),
            }
        }
        for keyword in keywords {
            self.read_keyword(keyword);
        }
        self.override_earlier_loads();
        self.omit_unused_platens();
        // Without a load of size the first support would be the axis of the curve.
        self.loads.sort_by_key(|it| it.size() == 0.0);
    }

    fn read_keyword(&mut self, keyword: &Keyword) {
        let name = keyword.name.as_str();
        let is_load = matches!(
            name,
            "BOUNDARY" | "CLOAD" | "DLOAD" | "DSLOAD" | "TEMPERATURE"
        );
        let is_still = matches!(self.procedure(), Procedure::Modes(_)) && name != "BOUNDARY";
        if is_load && (self.is_left_out || is_still) {
            return self.omit(keyword, "its step is not carried out");
        }
        let first = self.steps.len();
        match name {
            "HEADING" => self.title = keyword.data.first().map(|it| it.text.trim().to_owned()),
            "MATERIAL" => self.begin_material(keyword),
            "ELASTIC" | "DENSITY" | "EXPANSION" => self.read_property(keyword),
            "SOLID SECTION" | "SHELL SECTION" | "MEMBRANE SECTION" => self.read_section(keyword),
            "STEP" => self.begin_step(keyword),
            "STATIC" | "DYNAMIC" | "FREQUENCY" => self.read_procedure(keyword),
            "HEAT TRANSFER"
            | "BUCKLE"
            | "VISCO"
            | "MODAL DYNAMIC"
            | "STEADY STATE DYNAMICS"
            | "COUPLED TEMPERATURE-DISPLACEMENT"
            | "UNCOUPLED TEMPERATURE-DISPLACEMENT" => {
                self.omit_step(keyword);
            }
            "BOUNDARY" => self.read_boundary(keyword),
            "CLOAD" => self.read_forces(keyword),
            "DLOAD" => self.read_distributed(keyword),
            "DSLOAD" => self.read_on_surfaces(keyword),
            "TEMPERATURE" => self.read_temperatures(keyword),
            "INITIAL CONDITIONS" => self.read_initial_conditions(keyword),
            "AMPLITUDE" | "RIGID BODY" | "COUPLING" | "KINEMATIC" | "DISTRIBUTING" | "EQUATION"
            | "END STEP" => {}
            _ => {
                let known = LEFT_OUT
                    .iter()
                    .find(|(beginning, _)| name.starts_with(beginning));
                self.omit(keyword, known.map_or("a case has no such thing", |it| it.1));
            }
        }
        if is_load {
            self.replace_earlier(keyword, first);
        }
    }

    /// Text of the case.
    fn text(&mut self, [name, mesh]: [&str; 2], law: Law, warnings: &[String]) -> String {
        let materials = self.material_text();
        let mut text = self.head(name, warnings);
        text += &self.mesh_text(name, mesh);
        let model = deck_model(self.places.dimensions(), law);
        let _ = write!(text, "\n{materials}\n{model}\n");
        let is_support =
            |it: &&Load| it.key == "displacement" && it.size() == 0.0 && it.lines.len() == 1;
        let (supports, loads): (Vec<&Load>, Vec<&Load>) = self.loads.iter().partition(is_support);
        text += &self.support_text(&supports);
        for load in &loads {
            let name = quoted(&load.name);
            let lines: String = load.lines.iter().map(|it| format!("{it}\n")).collect();
            let (action, variation) = (load.action(), self.variation(load));
            let _ = writeln!(text, "[[load]]\nname = {name}\n{lines}{action}{variation}");
        }
        text += &self.heating;
        for (place, velocity) in &self.velocities {
            let components = velocity.iter();
            let components =
                components.map(|(axis, it)| format!("{axis} = {}", units::number(*it)));
            let velocity = components.collect::<Vec<_>>().join(", ");
            let _ = writeln!(
                text,
                "[[initial_velocity]]\n{place}\nvelocity = {{ {velocity} }} # m/s\n"
            );
        }
        text += &self.analysis_text(&loads, self.heated_in);
        if self.procedure() == Procedure::Static {
            text += &deck_examples(text.contains("[[stage]]"));
        }
        text
    }

    /// Title and mesh of the case.
    fn mesh_text(&self, name: &str, mesh: &str) -> String {
        let title = self.title.as_deref().filter(|it| !it.is_empty());
        let title = quoted(title.unwrap_or(name));
        let analysis = match self.procedure() {
            Procedure::Modes(_) => "analysis = \"modal\"\n",
            _ => "",
        };
        let mut text = format!(
            "\ntitle = {title}\n{analysis}\n[mesh]\nfile = {}\n",
            quoted(mesh)
        );
        if self.units.length != 1.0 {
            let (scale, units) = (self.units.length, self.units.name);
            let _ = writeln!(text, "scale = {scale} # the deck is in {units}");
        }
        if self.places.dimensions() == 2 {
            let plane = match self.places.deck.plane {
                Some(Plane::Strain) => "strain",
                _ => "stress",
            };
            let thickness = units::number(self.thickness());
            let _ = writeln!(text, "thickness = {thickness} # m\nplane = \"{plane}\"");
        }
        text
    }

    /// Head of the case, with a list of omissions.
    fn head(&self, name: &str, warnings: &[String]) -> String {
        let units = self.units.name;
        let mut text = format!(
            "# The case of {name}, whose units are taken as {units}. All values are in SI units: m, N, Pa, kg, s, rad.\n"
        );
        let shown = |line: String| line.replace(char::is_control, " ");
        for warning in warnings {
            let _ = writeln!(text, "# WARNING: {}", shown(warning.clone()));
        }
        for left in &self.left_out {
            let _ = writeln!(
                text,
                "# not carried out: {}",
                shown(omission_text(left, name))
            );
        }
        for remark in self.places.deck.mesh.remarks() {
            let _ = writeln!(text, "# of the mesh: {}", shown(remark.to_string()));
        }
        text
    }
}

/// Text of the omissions of a deck with a name.
fn omission_text(left: &Omission, name: &str) -> String {
    let file = left.line.file.as_deref().unwrap_or(name);
    let parameter = |it: &Parameter| match &it.value {
        Some(value) => format!(", {}={value}", it.name),
        None => format!(", {}", it.name),
    };
    let parameters: String = left.keyword.parameters.iter().map(parameter).collect();
    let more = match left.lines {
        1 => String::new(),
        lines => format!(" ({lines} lines)"),
    };
    let (number, keyword, reason) = (left.line.number, &left.keyword.name, &left.reason);
    format!("{file}:{number} *{keyword}{parameters}{more}: {reason}")
}
