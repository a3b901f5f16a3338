//! `ligament mesh`.

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use ligament_study::meshing::gmsh_program::{MeshRequest, make_mesh};
use ligament_study::meshing::input_deck::{DeckRequest, convert_deck, is_deck};
use ligament_study::meshing::via_meshio::{Conversion, ConversionRequest, convert, default_out};

use super::argument_parsers::{number, output_file};
use crate::inspect::write_summary;
use crate::terminal;

pub(super) const EXAMPLES: &str = "\
Examples:
  ligament mesh disk.geo
  ligament mesh disk.geo --out meshes/disk-1mm.msh --set h=0.001
  ligament mesh disk.geo --gmsh ~/gmsh/bin/gmsh
  ligament mesh plate.inp                              Abaqus, CalculiX, with its sets: writes plate.msh
  ligament mesh --via-meshio plate.med --python ~/venv/bin/python

A geometry with volumes becomes a solid mesh if a physical volume contains them, or if there are no groups.
--set changes a number that the geometry declares by DefineConstant[ h = ... ].
Lengths of the geometry, or of the mesh, are in m.";

/// `ligament mesh`.
#[derive(Debug, Args)]
pub struct MeshArgs {
    /// The geometry (Gmsh .geo), or an input deck of Abaqus or CalculiX (.inp), whose mesh is read with its sets and surfaces
    #[arg(
        value_name = "FILE.geo|FILE.inp",
        required_unless_present = "via_meshio"
    )]
    pub geometry: Option<PathBuf>,
    /// Convert a mesh of another program instead, with its groups (needs Python with meshio)
    #[arg(long, value_name = "FILE", conflicts_with_all = ["geometry", "numbers", "gmsh"])]
    pub via_meshio: Option<PathBuf>,
    /// The meshio name of the format, if the extension of the file is not enough
    #[arg(long, value_name = "NAME", requires = "via_meshio")]
    pub format: Option<String>,
    /// The Python that has meshio, if it is not `python3` on the PATH
    #[arg(
        long,
        value_name = "PATH",
        default_value = "python3",
        hide_default_value = true,
        requires = "via_meshio"
    )]
    pub python: PathBuf,
    /// The mesh to write [default: FILE.msh next to the file]
    #[arg(short, long, alias = "output", value_parser = output_file(), value_name = "FILE.msh")]
    pub out: Option<PathBuf>,
    /// Replace the mesh if there is one
    #[arg(long)]
    pub force: bool,
    /// The gmsh program, if it is not on the PATH
    #[arg(
        long,
        value_name = "PATH",
        default_value = "gmsh",
        hide_default_value = true
    )]
    pub gmsh: PathBuf,
    /// Set a number of the geometry, e.g. h=0.001 (may be repeated)
    #[arg(long = "set", value_name = "NAME=VALUE", value_parser = number_setting)]
    pub numbers: Vec<(String, f64)>,
}

impl MeshArgs {
    /// Executes the command.
    pub(super) fn execute(self) -> anyhow::Result<()> {
        match (self.via_meshio.clone(), self.geometry.clone()) {
            (Some(source), _) => self.convert(source),
            (None, Some(deck)) if is_deck(&deck) => self.read_deck(deck),
            (None, Some(geometry)) => self.mesh(geometry),
            (None, None) => Ok(()),
        }
    }

    fn mesh(self, geometry: PathBuf) -> anyhow::Result<()> {
        let request = MeshRequest {
            out: (self.out).unwrap_or_else(|| geometry.with_extension("msh")),
            force: self.force,
            geometry,
            gmsh: self.gmsh,
            numbers: self.numbers,
        };
        let mesh = make_mesh(&request)?;
        let mut out = terminal::for_messages(&request.out);
        Ok(write_summary(&mut out, &request.out, &mesh)?)
    }

    fn convert(self, source: PathBuf) -> anyhow::Result<()> {
        let request = ConversionRequest {
            out: self.out.unwrap_or_else(|| default_out(&source)),
            force: self.force,
            source,
            format: self.format,
            python: self.python,
        };
        let converted = convert(&request)?;
        write_conversion(&request.out, &converted)
    }

    fn read_deck(self, source: PathBuf) -> anyhow::Result<()> {
        let request = DeckRequest {
            out: self.out.unwrap_or_else(|| default_out(&source)),
            force: self.force,
            source,
        };
        let converted = convert_deck(&request)?;
        write_conversion(&request.out, &converted)
    }
}

/// Writes the mesh and the remarks of a conversion for the user.
fn write_conversion(path: &Path, converted: &Conversion) -> anyhow::Result<()> {
    let mut out = terminal::for_messages(path);
    write_summary(&mut out, path, &converted.mesh)?;
    for remark in &converted.remarks {
        writeln!(out, "  note: {remark}")?;
    }
    Ok(())
}

/// A number of the geometry on the command line.
pub(super) fn number_setting(text: &str) -> Result<(String, f64), String> {
    let (name, value) = text
        .split_once('=')
        .ok_or("expected NAME=VALUE, such as h=0.001")?;
    let number = number(value).ok_or_else(|| format!("`{value}` is not a number"))?;
    match name.trim() {
        "" => Err("there is no name before `=`".to_owned()),
        name => Ok((name.to_owned(), number)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_for_the_geometry_are_numbers() {
        assert_eq!(number_setting("h=1e-3"), Ok(("h".to_owned(), 1e-3)));
        assert!(number_setting("h").is_err_and(|error| error.contains("NAME=VALUE")));
        assert!(number_setting("h=2mm").is_err_and(|error| error.contains("`2mm`")));
    }
}
