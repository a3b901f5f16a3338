//! `ligament new`.

use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::Context;
use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use ligament::setup::Law;
use ligament_case::case::MOST_CELLS;
use ligament_case::starter::{lattice_case, mesh_case, solid_lattice_case};
use ligament_output::{check_file, is_stream, write_file};

use super::argument_parsers::{output_file, positive_number};
use crate::terminal;

pub(super) const EXAMPLES: &str = "\
Examples:
  ligament new plate.msh                             writes case.toml, for plate.msh
  ligament new meshes/disk.msh --out disk/case.toml --law bbpd
  ligament new plate.msh --out plate.ligament.toml   a name by which editors know a case
  ligament new --lattice 60,120,0.001                a lattice in place of a mesh
  ligament new --lattice 10,10,40,0.001              a lattice of a solid

The case runs as it is; replace its example material and loading with your own.";

/// `ligament new`.
#[derive(Debug, Args)]
pub struct NewArgs {
    /// The mesh (Gmsh .msh)
    #[arg(value_name = "MESH", required_unless_present = "lattice")]
    pub mesh: Option<PathBuf>,
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
