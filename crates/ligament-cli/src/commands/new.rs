//! `ligament new`.

use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::Context;
use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use ligament::setup::Law;
use ligament_case::case::MOST_CELLS;
use ligament_case::starter::{
    DeckCase, Starter, Units, deck_case, lattice_case, mesh_case, solid_lattice_case,
};
use ligament_mesh::gmsh::CoordinatePlane;
use ligament_output::{check_file, is_stream, write_file};
use ligament_study::meshing::input_deck::{is_deck, read_deck};
use ligament_study::meshing::via_meshio::write_converted;

use super::argument_parsers::{output_file, positive_number};
use crate::terminal;

pub(super) const EXAMPLES: &str = "\
Examples:
  ligament new plate.msh                             writes case.toml, for plate.msh
  ligament new meshes/disk.msh --out disk/case.toml --law bbpd
  ligament new plate.msh --out plate.ligament.toml   a name by which editors know a case
  ligament new model.inp --units mm-N-MPa            a deck of Abaqus or CalculiX, with its materials and loads
  ligament new --lattice 60,120,0.001                a lattice in place of a mesh
  ligament new --lattice 10,10,40,0.001              a lattice of a solid

The case runs as it is; replace its example material and loading with your own. Of a deck the mesh is written beside the case, and what
is not carried out stands in it as a comment with its line.";

/// `ligament new`.
#[derive(Debug, Args)]
pub struct NewArgs {
    /// The mesh (Gmsh .msh), or an input deck of Abaqus or CalculiX (.inp)
    #[arg(value_name = "MESH", required_unless_present = "lattice")]
    pub mesh: Option<PathBuf>,
    /// Units of the deck, which does not say them [default: m-N-Pa]
    #[arg(long, value_name = "SYSTEM", value_parser = units(), conflicts_with = "lattice")]
    pub units: Option<Units>,
    /// A lattice in place of a mesh: numbers of cells along x and y, in a solid x, y and z, and their side in m
    #[arg(long, value_name = "NX,NY[,NZ],SPACING", value_parser = lattice, conflicts_with = "mesh")]
    pub lattice: Option<Lattice>,
    /// The case file to write
    #[arg(
        long,
        short, alias = "output", value_parser = output_file(),
        value_name = "CASE.toml",
        default_value = "case.toml"
    )]
    pub out: PathBuf,
    /// The bond law
    #[arg(long, default_value = "nhpd", value_parser = laws())]
    pub law: Law,
    /// Replace the case file if there is one
    #[arg(long)]
    pub force: bool,
}

impl NewArgs {
    /// Executes the command.
    pub(super) fn execute(self) -> anyhow::Result<()> {
        let out = &self.out;
        check_file(out, self.force)?;
        let is_kept = !is_stream(out);
        let folder = out.parent().filter(|_| is_kept).unwrap_or(Path::new(""));
        if self.mesh.as_ref().is_none_or(|mesh| mesh.is_file()) {
            std::fs::create_dir_all(folder)
                .with_context(|| format!("cannot make the folder {}", folder.display()))?;
        }
        let starter = match (&self.mesh, self.lattice) {
            (Some(deck), _) if is_deck(deck) => self.deck(deck, folder)?,
            (Some(mesh), _) if self.units.is_some() => anyhow::bail!(
                "--units are those of an input deck (.inp): {} is a mesh, whose unit is mesh.scale in the case",
                mesh.display()
            ),
            (Some(mesh), _) => mesh_case(mesh, folder, self.law)?,
            (None, Some(Lattice::Plane(cells, spacing))) => lattice_case(cells, spacing, self.law),
            (None, Some(Lattice::Solid(cells, spacing))) => {
                solid_lattice_case(cells, spacing, self.law)?
            }
            (None, None) => anyhow::bail!("there is no mesh: give one, or --lattice NX,NY,SPACING"),
        };
        write_file(out, starter.text.as_bytes(), self.force)?;
        for warning in &starter.warnings {
            writeln!(terminal::stderr(), "warning: {warning}")?;
        }
        let mut messages = terminal::for_messages(out);
        let out = out.display();
        writeln!(messages, "wrote {out}: {}", starter.choice)?;
        if is_kept {
            writeln!(
                messages,
                "next: replace the EXAMPLE values, then\n  ligament check {out}\n  ligament run {out}"
            )?;
        }
        Ok(())
    }
}

impl NewArgs {
    /// Case of an input deck; its mesh and tables are written beside the case file.
    fn deck(&self, source: &Path, folder: &Path) -> anyhow::Result<Starter> {
        let mut deck = read_deck(source, CoordinatePlane::Xy)?;
        let name = source.file_name().unwrap_or_default().to_string_lossy();
        let mesh = Path::new(name.as_ref()).with_extension("msh");
        let [name, file] = [name.as_ref(), &mesh.to_string_lossy()];
        let DeckCase {
            mut starter,
            tables,
            left_out,
        } = deck_case(&mut deck, [name, file], self.units, self.law)?;
        for (name, _) in &tables {
            check_file(&folder.join(name), self.force)?;
        }
        let mesh = folder.join(mesh);
        check_file(&mesh, self.force)?;
        write_converted(source, &deck.mesh, (&mesh, self.force))?;
        for (name, text) in &tables {
            write_file(&folder.join(name), text.as_bytes(), self.force)?;
        }
        let also = tables.iter().map(|(name, _)| folder.join(name));
        let also = also.map(|it| format!(", {}", it.display()));
        let also: String = also.collect();
        starter.choice += &format!("; its mesh is {}{also}", mesh.display());
        starter.choice += &match left_out + deck.mesh.remarks().len() {
            0 => "; all of the deck is carried out".to_owned(),
            count => format!(
                "\nnot carried out of the deck: {count}; comments at the top of the case name them with their lines"
            ),
        };
        Ok(starter)
    }
}

fn units() -> impl TypedValueParser<Value = Units> {
    PossibleValuesParser::new(Units::ALL.map(|it| it.name)).try_map(|word| {
        let units = Units::ALL.into_iter().find(|it| it.name == word);
        units.ok_or("no such units")
    })
}

fn laws() -> impl TypedValueParser<Value = Law> {
    PossibleValuesParser::new(Law::ALL.map(|it| it.name())).try_map(|word| {
        let law = Law::ALL.into_iter().find(|law| law.name() == word);
        law.ok_or("no such law")
    })
}

/// A lattice on the command line: cells along the axes, and their side, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Lattice {
    /// Of square cells.
    Plane([u32; 2], f64),
    /// Of cubes.
    Solid([u32; 3], f64),
}

fn lattice(text: &str) -> Result<Lattice, String> {
    let expected =
        "expected NX,NY,SPACING, such as 60,120,0.001 (m), or NX,NY,NZ,SPACING of a solid";
    let parts: Vec<&str> = text.split(',').map(str::trim).collect();
    let (Some((spacing, counts)), 3 | 4) = (parts.split_last(), parts.len()) else {
        return Err(expected.to_owned());
    };
    let count = |text: &&str| text.parse::<u32>().ok().filter(|count| *count >= 4);
    let Some(counts) = counts.iter().map(count).collect::<Option<Vec<u32>>>() else {
        return Err(format!("{expected}, with 4 cells or more along each axis"));
    };
    let cells = counts
        .iter()
        .try_fold(1_u64, |product, &it| product.checked_mul(it.into()));
    if cells.is_none_or(|cells| cells > MOST_CELLS) {
        return Err(format!("a lattice has at most {MOST_CELLS} cells"));
    }
    let spacing = positive_number(spacing).filter(|it| it.is_normal());
    let spacing = spacing.ok_or(format!("{expected}, with a spacing greater than 0"))?;
    match counts[..] {
        [x, y] => Ok(Lattice::Plane([x, y], spacing)),
        [x, y, z] => Ok(Lattice::Solid([x, y, z], spacing)),
        _ => Err(expected.to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lattice_is_two_counts_and_a_spacing() {
        assert_eq!(lattice("60, 120,1e-3"), Ok(Lattice::Plane([60, 120], 1e-3)));
        assert_eq!(lattice("8,9,20,0.01"), Ok(Lattice::Solid([8, 9, 20], 0.01)));
        for wrong in [
            "60,120",
            "60,120,0",
            "3,120,0.1",
            "6.5,120,0.1",
            "60,120,1mm",
            "60,120,inf",
            "90000,90000,1",
            "3,9,20,0.01",
            "9,9,9,9,0.01",
            "4000000000,4000000000,4000000000,1",
        ] {
            assert!(lattice(wrong).is_err(), "{wrong}");
        }
    }
}
