//! `ligament mesh`.

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use ligament_mesh::gmsh::CoordinatePlane;
use ligament_output::{check_file, is_stream};
use ligament_plot::picture::{Target, draw_groups};
use ligament_study::meshing::Coordinates;
use ligament_study::meshing::cad::{is_cad, label};
use ligament_study::meshing::gmsh_program::{MeshRequest, make_mesh};
use ligament_study::meshing::input_deck::{DeckRequest, convert_deck, is_read};
use ligament_study::meshing::via_meshio::{Conversion, ConversionRequest, convert, default_out};

use super::argument_parsers::{number, output_file, positive_number};
use crate::inspect::write_summary;
use crate::terminal;

pub(super) const EXAMPLES: &str = "\
Examples:
  ligament mesh disk.geo
  ligament mesh disk.geo --out meshes/disk-1mm.msh --set h=0.001
  ligament mesh disk.geo --gmsh ~/gmsh/bin/gmsh
  ligament mesh bracket.step --size 2e-3               CAD, in any unit: bracket.png shows the numbers of faces
  ligament mesh plate.inp                              Abaqus, CalculiX, with its sets: writes plate.msh
  ligament mesh plate.inp --scale 1e-3                 the same of a deck in mm
  ligament mesh --via-meshio plate.med --python ~/venv/bin/python

A geometry with volumes becomes a solid mesh if a physical volume contains them, or if there are no groups.
--set changes a number that the geometry declares by DefineConstant[ h = ... ].
Lengths of the geometry, or of the mesh, are in m; --scale 1e-3 makes m of mm. --plane xz takes a mesh whose y is the same everywhere.";

/// `ligament mesh`.
#[derive(Debug, Args)]
pub struct MeshArgs {
    /// The geometry (Gmsh .geo), a CAD file (.step, .iges, .brep), an input deck of Abaqus or CalculiX (.inp), whose mesh is read with its
    /// sets and surfaces, or a mesh of Gmsh (.msh) to be scaled or turned
    #[arg(
        value_name = "FILE.geo|FILE.step|FILE.inp|FILE.msh",
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
    /// Size of the cells in m: necessary for a CAD file, the largest size for a .geo
    #[arg(long, value_name = "SIZE", value_parser = factor, conflicts_with = "via_meshio")]
    pub size: Option<f64>,
    /// Multiply all coordinates, e.g. 1e-3 for lengths in mm
    #[arg(long, value_name = "FACTOR", value_parser = factor, default_value = "1", hide_default_value = true)]
    pub scale: f64,
    /// The plane in which a mesh without solid cells lies; it is turned into that of x and y
    #[arg(long, value_parser = planes(), default_value = "xy")]
    pub plane: CoordinatePlane,
    /// Set a number of the geometry, e.g. h=0.001 (may be repeated)
    #[arg(long = "set", value_name = "NAME=VALUE", value_parser = number_setting)]
    pub numbers: Vec<(String, f64)>,
}

impl MeshArgs {
    /// Executes the command.
    pub(super) fn execute(self) -> anyhow::Result<()> {
        match (self.via_meshio.clone(), self.geometry.clone()) {
            (Some(source), _) => self.convert(source),
            (None, Some(deck)) if is_read(&deck) => self.read_deck(deck),
            (None, Some(geometry)) => self.mesh(geometry),
            (None, None) => Ok(()),
        }
    }

    fn coordinates(&self) -> Coordinates {
        Coordinates {
            plane: self.plane,
            scale: self.scale,
        }
    }

    fn mesh(self, geometry: PathBuf) -> anyhow::Result<()> {
        let coordinates = self.coordinates();
        let request = MeshRequest {
            out: (self.out).unwrap_or_else(|| geometry.with_extension("msh")),
            force: self.force,
            geometry,
            gmsh: self.gmsh,
            numbers: self.numbers,
            size: self.size,
            coordinates,
        };
        let picture = (is_cad(&request.geometry) && !is_stream(&request.out))
            .then(|| request.out.with_extension("png"));
        let target = Target {
            out: picture.clone(),
            force: self.force,
            ..Target::default()
        };
        if let Some(picture) = &picture {
            check_file(picture, self.force)?;
        }
        let mesh = make_mesh(&request)?;
        let mut out = terminal::for_messages(&request.out);
        write_summary(&mut out, &request.out, &mesh)?;
        if let Some(picture) = picture {
            draw_groups(&mesh, &target, label)?;
            writeln!(out, "  picture       {}", picture.display())?;
        }
        Ok(())
    }

    fn convert(self, source: PathBuf) -> anyhow::Result<()> {
        let coordinates = self.coordinates();
        let request = ConversionRequest {
            out: self.out.unwrap_or_else(|| default_out(&source)),
            force: self.force,
            source,
            format: self.format,
            python: self.python,
            coordinates,
        };
        let converted = convert(&request)?;
        write_conversion(&request.out, &converted)
    }

    fn read_deck(self, source: PathBuf) -> anyhow::Result<()> {
        anyhow::ensure!(
            self.size.is_none() && self.numbers.is_empty(),
            "{} has its cells already: --size and --set are for geometries",
            source.display()
        );
        let coordinates = self.coordinates();
        let request = DeckRequest {
            out: self.out.unwrap_or_else(|| default_out(&source)),
            force: self.force,
            source,
            coordinates,
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

fn factor(text: &str) -> Result<f64, String> {
    positive_number(text).ok_or("expected a number greater than 0, such as 1e-3".to_owned())
}

fn planes() -> impl TypedValueParser<Value = CoordinatePlane> {
    PossibleValuesParser::new(CoordinatePlane::ALL.map(CoordinatePlane::word)).try_map(|word| {
        let mut planes = CoordinatePlane::ALL.into_iter();
        planes.find(|it| it.word() == word).ok_or("no such plane")
    })
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
