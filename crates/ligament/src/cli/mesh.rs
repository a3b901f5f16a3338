//! `ligament mesh`.

use std::io;
use std::path::PathBuf;

use clap::Args;

use crate::inspect::write_summary;
use crate::mesh_command::{MeshRequest, make_mesh};

pub(super) const EXAMPLES: &str = "\
Examples:
  ligament mesh disk.geo
  ligament mesh disk.geo --out meshes/disk-1mm.msh --set h=0.001
  ligament mesh disk.geo --gmsh ~/gmsh/bin/gmsh

A --set gives a number that the geometry declares by DefineConstant[ h = ... ].
Lengths of the geometry are in m.";

/// `ligament mesh`.
#[derive(Debug, Args)]
pub struct MeshArgs {
    /// The geometry (Gmsh .geo)
    #[arg(value_name = "FILE.geo")]
    pub geometry: PathBuf,
    /// The mesh to write [default: FILE.msh next to the geometry]
    #[arg(long, value_name = "FILE.msh")]
    pub out: Option<PathBuf>,
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
    /// Does it.
    pub(super) fn execute(self) -> anyhow::Result<()> {
        let out = self
            .out
            .unwrap_or_else(|| self.geometry.with_extension("msh"));
        let MeshArgs {
            geometry,
            gmsh,
            numbers,
            ..
        } = self;
        let request = MeshRequest {
            geometry,
            out,
            gmsh,
            numbers,
        };
        let mesh = make_mesh(&request)?;
        Ok(write_summary(
            &mut io::stdout().lock(),
            &request.out,
            &mesh,
        )?)
    }
}

/// A number of the geometry on the command line.
fn number_setting(text: &str) -> Result<(String, f64), String> {
    let (name, value) = text
        .split_once('=')
        .ok_or("expected NAME=VALUE, such as h=0.001")?;
    let number = value
        .trim()
        .parse::<f64>()
        .ok()
        .filter(|number| number.is_finite());
    let number = number.ok_or_else(|| format!("`{value}` is not a number"))?;
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
