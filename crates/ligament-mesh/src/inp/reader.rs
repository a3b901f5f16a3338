//! The keywords of a deck, carried out one after the other.

use super::elements;
use super::error::InpError;
use super::keyword::{Keyword, Scope, squeezed};
use super::model::{Instance, Model, Names, is_same_name};
use super::nodes;
use super::part::{Items, Part, Surface};
use super::sets;
use super::source::{Block, Command, Position, Source};

/// Keywords that are carried out, without blanks, each with its parameters.
const OF_MESH: [(&str, &[&str]); 17] = [
    ("NODE", &["NSET", "SYSTEM", "INPUT"]),
    ("SYSTEM", &[]),
    ("NGEN", &["LINE", "NSET", "SYSTEM"]),
    ("NFILL", &["NSET", "BIAS", "SINGULAR", "TWO STEP"]),
    (
        "NCOPY",
        &[
            "CHANGE NUMBER",
            "OLD SET",
            "NEW SET",
            "SHIFT",
            "REFLECT",
            "POLE",
            "MULTIPLE",
        ],
    ),
    (
        "ELEMENT",
        &[
            "TYPE",
            "ELSET",
            "INPUT",
            "OFFSET",
            "SOLID ELEMENT NUMBERING",
        ],
    ),
    ("ELGEN", &["ELSET", "ALL NODES"]),
    (
        "ELCOPY",
        &[
            "ELEMENT SHIFT",
            "OLD SET",
            "SHIFT NODES",
            "NEW SET",
            "REFLECT",
        ],
    ),
    (
        "NSET",
        &[
            "NSET", "ELSET", "GENERATE", "INSTANCE", "INTERNAL", "UNSORTED",
        ],
    ),
    (
        "ELSET",
        &["ELSET", "GENERATE", "INSTANCE", "INTERNAL", "UNSORTED"],
    ),
    (
        "SURFACE",
        &[
            "NAME",
            "TYPE",
            "INTERNAL",
            "COMBINE",
            "CROP",
            "PROPERTY",
            "REGION TYPE",
            "FILLET RADIUS",
            "TRIM",
            "MAX RATIO",
            "NO OFFSET",
            "NO THICK",
            "SCALE THICK",
            "DEFINITION",
        ],
    ),
    ("PART", &["NAME", "INTERNAL"]),
    ("ENDPART", &[]),
    ("ASSEMBLY", &["NAME"]),
    ("ENDASSEMBLY", &[]),
    ("INSTANCE", &["NAME", "PART", "INSTANCE", "LIBRARY"]),
    ("ENDINSTANCE", &[]),
];

/// Keywords that would change the mesh and are not carried out.
const REFUSED: [&str; 7] = [
    "ADJUST",
    "IMPERFECTION",
    "IMPORT",
    "IMPORTELSET",
    "IMPORTNSET",
    "NMAP",
    "SYMMETRICMODELGENERATION",
];

/// Number of letters from which a keyword may be an abbreviation.
const SHORTEST: usize = 3;

/// The part of a model that definitions go to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Level {
    Model,
    Part(usize),
    Assembly,
    Instance(usize),
}

impl Level {
    fn keyword(self) -> &'static str {
        match self {
            Level::Model => "MODEL",
            Level::Part(_) => "PART",
            Level::Assembly => "ASSEMBLY",
            Level::Instance(_) => "INSTANCE",
        }
    }
}

/// Carries out all keywords of a deck.
pub(super) fn read(source: &Source<'_>) -> Result<Model, InpError> {
    let mut reader = Reader {
        source,
        model: Model::default(),
        level: Level::Model,
        opened: Vec::new(),
    };
    for block in &source.blocks {
        let name = squeezed(&block.header.name);
        match OF_MESH.iter().find(|(keyword, _)| *keyword == name) {
            Some((keyword, known)) => {
                reader.carry_out(keyword, &source.command(block, known)?)?;
            }
            None => reader.keep(block, &name)?,
        }
    }
    match reader.opened.last() {
        None => Ok(reader.model),
        Some(opened) => Err(InpError::Misplaced {
            line: source.line(*opened),
            keyword: reader.level.keyword().to_owned(),
            reason: "it has no end; is the file cut off?",
        }),
    }
}

struct Reader<'s> {
    source: &'s Source<'s>,
    model: Model,
    level: Level,
    /// Positions of the part, assembly and instance that are open.
    opened: Vec<Position>,
}

impl Reader<'_> {
    fn carry_out(&mut self, keyword: &str, command: &Command<'_>) -> Result<(), InpError> {
        match keyword {
            "NODE" => nodes::read_nodes(command, self.part()),
            "SYSTEM" => nodes::read_system(command, self.part()),
            "NGEN" => nodes::generate(command, self.part()),
            "NFILL" => nodes::fill(command, self.part()),
            "NCOPY" => nodes::copy(command, self.part()),
            "ELEMENT" => self.read_elements(command),
            "ELGEN" => elements::generate(command, self.part()),
            "ELCOPY" => elements::copy(command, self.part()),
            "NSET" => self.read_set(command, Items::Nodes),
            "ELSET" => self.read_set(command, Items::Elements),
            "SURFACE" => self.read_surface(command),
            "PART" => self.begin_part(command),
            "ASSEMBLY" => self.open(command, Level::Assembly),
            "INSTANCE" => self.begin_instance(command),
            _ => self.end(command, keyword),
        }
    }

    /// The part that definitions go to. An instance that defines something gets a copy of its part.
    fn part(&mut self) -> &mut Part {
        match self.level {
            Level::Model | Level::Assembly => &mut self.model.own,
            Level::Part(part) => &mut self.model.parts[part],
            Level::Instance(index) => {
                let instance = &mut self.model.instances[index];
                let part = &self.model.parts[instance.part];
                instance.own.get_or_insert_with(|| part.without_remarks())
            }
        }
    }

    /// Names that a line may use, and the members that they stand for.
    fn names(&self) -> Names<'_> {
        let (part, model) = match self.level {
            Level::Model | Level::Assembly => (&self.model.own, Some(&self.model)),
            Level::Part(part) => (&self.model.parts[part], None),
            Level::Instance(index) => (self.model.part_of(&self.model.instances[index]), None),
        };
        Names {
            part,
            space: 0,
            model,
        }
    }

    fn read_elements(&mut self, command: &Command<'_>) -> Result<(), InpError> {
        // The types belong to the model, as the part does.
        let mut types = std::mem::take(&mut self.model.types);
        let read = elements::read_elements(command, self.part(), &mut types);
        self.model.types = types;
        read
    }

    fn read_set(&mut self, command: &Command<'_>, items: Items) -> Result<(), InpError> {
        let mut names = self.names();
        if let Some(name) = command.value("INSTANCE") {
            let found = names.model.and_then(|model| model.instance(name));
            let (index, instance) = found.ok_or_else(|| command.unknown("instance", name))?;
            names = Names {
                part: self.model.part_of(instance),
                space: index as u32 + 1,
                model: None,
            };
        }
        let read = sets::read_set(command, items, &names)?;
        let part = self.part();
        let sets = match items {
            Items::Nodes => &mut part.node_sets,
            Items::Elements => &mut part.element_sets,
        };
        let set = sets.begin(&read.name, read.position);
        set.members.extend(read.members);
        set.is_unsorted |= read.is_unsorted;
        Ok(())
    }

    fn read_surface(&mut self, command: &Command<'_>) -> Result<(), InpError> {
        match sets::read_surface(command, &self.names())? {
            Some(surface) => self.part().surfaces.push(surface),
            None => {
                let name = command.required("NAME")?.to_owned();
                let kind = command.word("TYPE").unwrap_or_default();
                let other = (command.position(), name, kind);
                self.model.other_surfaces.push(other);
            }
        }
        Ok(())
    }

    fn begin_part(&mut self, command: &Command<'_>) -> Result<(), InpError> {
        let name = command.required("NAME")?;
        if let Some(first) = self
            .model
            .parts
            .iter()
            .find(|it| is_same_name(&it.name, name))
        {
            return Err(self.repeated(command, "part", name, first.position));
        }
        self.open(command, Level::Part(self.model.parts.len()))?;
        self.model.parts.push(Part {
            name: name.to_owned(),
            position: command.position(),
            ..Part::default()
        });
        Ok(())
    }

    fn begin_instance(&mut self, command: &Command<'_>) -> Result<(), InpError> {
        if command.has("INSTANCE") || command.has("LIBRARY") {
            let what = "*INSTANCE from the results of another analysis";
            return Err(command.not_carried_out(what, "define the part in the file"));
        }
        let name = command.required("NAME")?;
        let part = command.required("PART")?;
        if let Some((_, first)) = self.model.instance(name) {
            return Err(self.repeated(command, "instance", name, first.position));
        }
        let mut parts = self.model.parts.iter();
        let index = parts.position(|it| is_same_name(&it.name, part));
        let index = index.ok_or_else(|| command.unknown("part", part))?;
        self.open(command, Level::Instance(self.model.instances.len()))?;
        self.model.instances.push(Instance {
            name: name.to_owned(),
            position: command.position(),
            part: index,
            motion: nodes::motion(&mut command.all_rows())?,
            own: None,
        });
        Ok(())
    }

    /// Opens a part, an assembly or an instance.
    fn open(&mut self, command: &Command<'_>, level: Level) -> Result<(), InpError> {
        match (self.level, level) {
            (Level::Assembly, Level::Instance(_)) => {}
            (_, Level::Instance(_)) => {
                return Err(
                    self.misplaced(command, "it belongs between *ASSEMBLY and *END ASSEMBLY")
                );
            }
            (Level::Model, _) => {}
            _ => return Err(self.misplaced(command, "a part, an assembly or an instance is open")),
        }
        self.opened.push(command.position());
        self.level = level;
        Ok(())
    }

    fn end(&mut self, command: &Command<'_>, keyword: &str) -> Result<(), InpError> {
        if keyword.strip_prefix("END") != Some(self.level.keyword()) {
            return Err(self.misplaced(command, "nothing of this kind is open"));
        }
        self.opened.pop();
        self.level = match self.level {
            Level::Instance(_) => Level::Assembly,
            _ => Level::Model,
        };
        Ok(())
    }

    /// Keeps a keyword that is no part of the mesh; refuses one that would change the mesh, or may be short for another one.
    fn keep(&mut self, block: &Block, name: &str) -> Result<(), InpError> {
        if REFUSED.contains(&name) {
            let what = format!("*{}", block.header.name);
            let remedy = "write the nodes and elements out";
            return Err(self.source.not_carried_out(block.position, &what, remedy));
        }
        let line = self.source.line(block.position);
        let mut longer = OF_MESH
            .iter()
            .filter(|(keyword, _)| keyword.starts_with(name));
        if let (true, Some((keyword, _))) = (name.len() >= SHORTEST, longer.next()) {
            return Err(InpError::Abbreviated {
                line,
                found: block.header.name.clone(),
                keyword,
            });
        }
        let scope = match self.level {
            Level::Model | Level::Assembly => Scope::Model,
            Level::Part(part) => Scope::Part(self.model.parts[part].name.clone()),
            Level::Instance(index) => Scope::Instance(self.model.instances[index].name.clone()),
        };
        let keyword = Keyword {
            line,
            name: block.header.name.clone(),
            parameters: block.header.parameters.clone(),
            data: self.source.data_lines(block),
            scope,
        };
        if name == "DLOAD" {
            let surfaces = sets::pressed_surfaces(&keyword, self.source.rows(block), &self.names());
            let part = self.part();
            let is_new = |it: &Surface| part.surfaces.iter().all(|other| other.name != it.name);
            let surfaces: Vec<Surface> = surfaces.into_iter().filter(is_new).collect();
            part.surfaces.extend(surfaces);
        }
        self.model.keywords.push(keyword);
        Ok(())
    }

    fn misplaced(&self, command: &Command<'_>, reason: &'static str) -> InpError {
        InpError::Misplaced {
            line: self.source.line(command.position()),
            keyword: command.block.header.name.clone(),
            reason,
        }
    }

    fn repeated(
        &self,
        command: &Command<'_>,
        what: &'static str,
        name: &str,
        first: Position,
    ) -> InpError {
        InpError::RepeatedName {
            line: self.source.line(command.position()),
            what,
            name: name.to_owned(),
            first: self.source.line(first),
        }
    }
}
