//! `ligament plot`.

use std::io::Write;
use std::path::PathBuf;

use clap::Args;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use ligament_output::results::steps::StepChoice;
use ligament_plot::picture::colour_map::ColourMap;
use ligament_plot::picture::curve::{CurveRequest, draw_curves};
use ligament_plot::picture::select::Choice;
use ligament_plot::picture::{
    CrackDrawing, FieldRequest, Format, Magnification, Section, SolidRequest, Target, Upward, View,
    animate, draw_crack_paths, draw_each, draw_fields,
};
use ligament_study::sweep::completed_runs;

use super::argument_parsers::{self, numbers, output_file};
use crate::terminal;

pub(super) const EXAMPLES: &str = "\
Examples:
  ligament plot results/disk                                damage of the last output
  ligament plot results/disk --strip 4 --scale 20           four outputs, displacements 20 times larger
  ligament plot results/disk --field displacement.x --step 40 --out ux.svg
  ligament plot results/disk --step first peak last         three steps by name
  ligament plot results/disk --field none --crack --box -0.01,-0.02,0.01,0.02
  ligament plot results/disk --crack=lines --with-lines experiment.csv --out path.pdf
  ligament plot --curve results/coarse results/fine --labels '4 mm' '2 mm' --out curves.svg
  ligament plot --curve results/wave --y energies           of a motion over the time, as the force without --y
  ligament plot results/wave --step t=2e-5 t=4e-5           the outputs nearest to these times
  ligament plot results/disk --animate crack.gif --field damage --fps 12
  ligament plot results/disk --animate crack.gif --step 45:      the states of step 45, with output.during_breakage in the case
  ligament plot results/plate-modes                         the first six modes
  ligament plot results/horizon-study                       the curves of all runs of a study
  ligament plot results/horizon-study --crack=lines         their crack paths over one another
  ligament plot results/beam --view -40,20 --crack          a solid, opened along its crack
  ligament plot results/beam --crack=lines --out crack.png  the crack of a solid as a surface, by its opening
  ligament plot results/beam --section z=0.05 --field stress_virial.xx

Fields are those of the VTU files: NAME (the norm of a vector), NAME.x and NAME.y, and NAME.xx and so on
of a stress. An unknown name lists the known ones. Values are in SI units.";

/// `ligament plot`.
#[derive(Debug, Args)]
pub struct PlotArgs {
    /// Folders with the results of runs, or the folder of a study, whose runs are drawn over one another
    #[arg(value_name = "RESULT", required = true)]
    pub results: Vec<PathBuf>,
    /// Field to draw, or none [default: damage where bonds broke, of softening bonds by their way of failing, else displacement]
    #[arg(long, value_name = "NAME")]
    pub field: Option<String>,
    /// Steps or modes to draw: numbers, -1 for the last, first (breakage), peak, last, 45:120 for step 45 after 120 breakages, 45: for all states of
    /// step 45, of a motion times in s as t=4e-5, or all: a picture each, in files with numbers [default: the last step, the first six modes]
    #[arg(long, visible_alias = "mode", value_name = "STEP", num_args = 1.., value_delimiter = ',', allow_negative_numbers = true)]
    pub step: Vec<StepChoice>,
    /// Draw this number of outputs, evenly spaced, side by side
    #[arg(long, value_name = "COUNT", conflicts_with = "step", value_parser = clap::value_parser!(u32).range(1..=100))]
    pub strip: Option<u32>,
    /// Draw the outputs nearest to these displacements of the load
    #[arg(long = "displacement", value_name = "VALUE", num_args = 1.., value_delimiter = ',', conflicts_with_all = ["step", "strip"], allow_negative_numbers = true, value_parser = number)]
    pub displacements: Vec<f64>,
    /// Factor on the displacement, or auto: the largest is 2 to 5 % of the body, of a mode 10 %
    #[arg(long, value_name = "FACTOR", default_value = "auto", allow_negative_numbers = true, value_parser = magnification)]
    pub scale: Magnification,
    /// Draw cracks: `bonds`, the broken bonds coloured by criterion, with those that a pre-crack cut; `lines`, the crack path with
    /// its tips and the pre-cracks, on the undeformed body with axes in mm; of a solid `bonds`, the cells opened along the crack, and
    /// `lines`, the crack surface by its opening [without a value: bonds]
    #[arg(long, value_name = "HOW", num_args = 0..=1, require_equals = true, default_missing_value = "bonds", value_parser = crack_drawings())]
    pub crack: Option<CrackDrawing>,
    /// Draw the lines of a CSV file x,y in m over the undeformed body; empty rows part lines. Of crack.csv of another run its cracks
    #[arg(long = "with-lines", value_name = "FILE")]
    pub lines: Vec<PathBuf>,
    /// Draw only this part of the deformed body, m
    #[arg(long = "box", value_name = "X0,Y0,X1,Y1", allow_hyphen_values = true, value_parser = window)]
    pub window: Option<[[f64; 2]; 2]>,
    /// See a solid from x, y, z, iso, or AZIMUTH,ELEVATION in degrees [default: iso; a section from its normal]
    #[arg(long, value_name = "VIEW", allow_hyphen_values = true)]
    pub view: Option<View>,
    /// Axis of a solid that points up
    #[arg(long, value_name = "AXIS", value_parser = upwards())]
    pub up: Option<Upward>,
    /// Draw the section of a solid by a plane: x=0.05, y=.. or z=.. in m, or a point and a normal PX,PY,PZ,NX,NY,NZ
    #[arg(long, value_name = "PLANE", allow_hyphen_values = true)]
    pub section: Option<Section>,
    /// Draw the surface in a solid on which the field has this value, in SI units
    #[arg(long, value_name = "VALUE", allow_hyphen_values = true, conflicts_with = "section", value_parser = number)]
    pub iso: Option<f64>,
    /// Bands of colour [default: about 16, with round levels]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=256))]
    pub levels: Option<u32>,
    /// Values at the ends of the colour bar, in SI units [default: those of the outputs drawn]
    #[arg(long, value_name = "MIN,MAX", allow_hyphen_values = true, value_parser = range)]
    pub range: Option<[f64; 2]>,
    /// Colours [default: viridis; orange for damage, diverging for values of both signs]
    #[arg(long, value_parser = maps())]
    pub map: Option<ColourMap>,
    /// Bodies in a row
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=100))]
    pub columns: Option<u32>,
    /// Draw curves over the load history in place of bodies: reaction over displacement, of a motion over time
    #[arg(long, conflicts_with_all = ["field", "step", "strip", "displacements", "scale", "crack", "lines", "window", "levels", "range", "map", "columns", "view", "up", "section", "iso"])]
    pub curve: bool,
    /// Column along x [default: displacement, of a motion time]
    #[arg(long, value_name = "COLUMN", requires = "curve")]
    pub x: Option<String>,
    /// Columns along y, of history.csv or of the tables of `ligament crack`; `energies` and `probes` are all of these
    #[arg(long, value_name = "COLUMN", num_args = 1.., default_value = "reaction", requires = "curve")]
    pub y: Vec<String>,
    /// Names of the results [default: the names of their folders]
    #[arg(long, value_name = "TEXT", num_args = 1..)]
    pub labels: Vec<String>,
    /// The picture, .png, .svg or .pdf [default: picture-NAME.png in the folder of the results, which takes the place of an
    /// earlier one; of the curves of several results, in this one]
    #[arg(short, long, alias = "output", value_parser = output_file(), value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Replace the files of --out and --animate if there are some
    #[arg(long)]
    pub force: bool,
    /// Format of the picture [default: by the extension of the file, else png]
    #[arg(long, value_parser = formats())]
    pub format: Option<Format>,
    /// An animation of the body over the steps, .gif, with fixed colours and one scale of the displacement [default steps: all, or 120
    /// evenly spread]
    #[arg(long, value_name = "FILE", value_parser = output_file(), conflicts_with_all = ["out", "format", "curve"])]
    pub animate: Option<PathBuf>,
    /// Pictures of the animation per second
    #[arg(long, value_name = "N", default_value = "10", requires = "animate", value_parser = positive_number)]
    pub fps: f64,
    /// Width in mm [default: 90 for one body, 180 for several; 120 and 160 for curves]
    #[arg(long, value_name = "MM", value_parser = positive_number)]
    pub width: Option<f64>,
    /// Dots per inch of a PNG or an animation [default: 300, of an animation 150]
    #[arg(long, value_name = "DPI", value_parser = positive_number)]
    pub dpi: Option<f64>,
}

impl PlotArgs {
    /// Draws the curves of all runs of a study, or their crack paths.
    fn draw_study(
        mut self,
        runs: Vec<(String, PathBuf)>,
        mut target: Target,
    ) -> anyhow::Result<PathBuf> {
        if let Some(option) = self.option_of_bodies() {
            anyhow::bail!(
                "--{option} draws the body of one run; the folder of a study has curves of all its runs, and with --crack=lines their crack \
                 paths: name the folder of a run in {}",
                self.results[0].join("runs").display()
            );
        }
        let (labels, folders): (Vec<String>, Vec<PathBuf>) = runs.into_iter().unzip();
        if self.labels.is_empty() {
            self.labels = labels;
        }
        let has_paths = self.crack.is_some();
        if target.out.is_none() {
            let name = if has_paths { "crack-paths" } else { "curves" };
            let ending = target.format.unwrap_or(Format::Png).word();
            let file = self.results[0].join(format!("picture-{name}.{ending}"));
            (target.out, target.force) = (Some(file), true);
        }
        Ok(match has_paths {
            true => draw_crack_paths(&folders, &self.labels, &target)?,
            false => draw_curves(&CurveRequest {
                folders,
                labels: self.labels,
                x: self.x,
                y: self.y,
                target,
            })?,
        })
    }

    /// Size and file of the picture.
    fn target(&self) -> Target {
        Target {
            out: self.out.clone(),
            force: self.force,
            format: self.format,
            width: self.width,
            dpi: self.dpi,
        }
    }

    /// The first given option that draws a body with a field or its bonds.
    fn option_of_bodies(&self) -> Option<&'static str> {
        let given = [
            ("field", self.field.is_some()),
            ("step", !self.step.is_empty()),
            ("strip", self.strip.is_some()),
            ("displacement", !self.displacements.is_empty()),
            ("crack=bonds", self.crack == Some(CrackDrawing::Bonds)),
            ("with-lines", !self.lines.is_empty()),
            ("box", self.window.is_some()),
            ("view", self.view.is_some()),
            ("up", self.up.is_some()),
            ("section", self.section.is_some()),
            ("iso", self.iso.is_some()),
            ("animate", self.animate.is_some()),
        ];
        let first = given.into_iter().find(|(_, is_given)| *is_given);
        first.map(|(option, _)| option)
    }

    /// Executes the command.
    pub(super) fn execute(self) -> anyhow::Result<()> {
        let target = self.target();
        let is_series = self.step == [StepChoice::All];
        if !is_series && self.step.contains(&StepChoice::All) {
            anyhow::bail!("--step all draws every stored step; leave out the others");
        }
        let study = completed_study(&self.results)?;
        let paths = if let Some(runs) = study {
            vec![self.draw_study(runs, target)?]
        } else if self.curve {
            vec![draw_curves(&CurveRequest {
                folders: self.results,
                labels: self.labels,
                x: self.x,
                y: self.y,
                target,
            })?]
        } else {
            let choice = match self.strip {
                Some(count) => Choice::Strip(count as usize),
                None if !self.step.is_empty() => Choice::Steps(self.step),
                None if !self.displacements.is_empty() => Choice::Displacements(self.displacements),
                None => Choice::Default,
            };
            let request = FieldRequest {
                folders: self.results,
                labels: self.labels,
                field: self.field,
                choice,
                magnification: self.scale,
                crack: self.crack,
                lines: self.lines,
                window: self.window,
                bands: self.levels.map(|it| it as usize),
                range: self.range,
                map: self.map,
                columns: self.columns.map(|it| it as usize),
                solid: SolidRequest {
                    view: self.view,
                    up: self.up,
                    section: self.section,
                    level: self.iso,
                },
                target,
            };
            match self.animate {
                Some(file) => vec![animate(&request, &file, self.fps)?],
                None if is_series => draw_each(&request)?,
                None => vec![draw_fields(&request)?],
            }
        };
        for path in paths {
            writeln!(terminal::for_messages(&path), "{}", path.display())?;
        }
        Ok(())
    }
}

/// Parser of the axis that points up.
fn upwards() -> impl TypedValueParser<Value = Upward> {
    let names = PossibleValuesParser::new(["y", "z"]);
    names.map(|name| match name.as_str() {
        "y" => Upward::Y,
        _ => Upward::Z,
    })
}

/// The completed runs of the study whose folder is the only result; None for results of runs.
pub(super) fn completed_study(
    results: &[PathBuf],
) -> anyhow::Result<Option<Vec<(String, PathBuf)>>> {
    for folder in results {
        let runs = completed_runs(folder)?;
        anyhow::ensure!(
            runs.is_none() || results.len() == 1,
            "{} is the folder of a study: name it alone, or folders of runs",
            folder.display()
        );
        if runs.is_some() {
            return Ok(runs);
        }
    }
    Ok(None)
}

fn number(text: &str) -> Result<f64, String> {
    argument_parsers::number(text).ok_or_else(|| format!("`{text}` is not a number"))
}

fn positive_number(text: &str) -> Result<f64, String> {
    let number = number(text)?;
    let positive_number = (number > 0.0).then_some(number);
    positive_number.ok_or_else(|| "it must be above zero".to_owned())
}

fn magnification(text: &str) -> Result<Magnification, String> {
    let factor = argument_parsers::number(text).map(Magnification::Times);
    match text {
        "auto" => Ok(Magnification::Auto),
        _ => factor.ok_or_else(|| "expected a number, or auto".to_owned()),
    }
}

fn range(text: &str) -> Result<[f64; 2], String> {
    let range = numbers(text).filter(|[low, high]| low < high);
    range.ok_or_else(|| "expected MIN,MAX with MIN below MAX, such as 0,0.5".to_owned())
}

fn window(text: &str) -> Result<[[f64; 2]; 2], String> {
    match numbers(text) {
        Some([x0, y0, x1, y1]) if x0 < x1 && y0 < y1 => Ok([[x0, y0], [x1, y1]]),
        _ => Err("expected X0,Y0,X1,Y1 in m, the lower left and the upper right corner".to_owned()),
    }
}

/// Parser of the words for ways to draw cracks.
fn crack_drawings() -> impl TypedValueParser<Value = CrackDrawing> {
    PossibleValuesParser::new(["bonds", "lines"]).map(|word| match word.as_str() {
        "lines" => CrackDrawing::Lines,
        _ => CrackDrawing::Bonds,
    })
}

/// Parser of kinds of pictures by their endings.
fn formats() -> impl TypedValueParser<Value = Format> {
    PossibleValuesParser::new(Format::ALL.map(Format::word)).try_map(|name| {
        let mut all = Format::ALL.into_iter();
        all.find(|format| format.word() == name)
            .ok_or("no such kind")
    })
}

/// Parser of colour maps by their names.
fn maps() -> impl TypedValueParser<Value = ColourMap> {
    let possible = ColourMap::ALL.map(ColourMap::words);
    let possible = possible.map(|[name, help]| PossibleValue::new(name).help(help));
    PossibleValuesParser::new(possible).try_map(|name| {
        let mut all = ColourMap::ALL.into_iter();
        let map = all.find(|map| map.words()[0] == name);
        map.ok_or("no such map")
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn windows_ranges_and_factors_are_read() {
        assert_eq!(window("-1,0,1, 2e-3"), Ok([[-1.0, 0.0], [1.0, 2e-3]]));
        assert!(window("1,0,-1,2").is_err() && window("1,2,3").is_err());
        assert_eq!(range("0,0.5"), Ok([0.0, 0.5]));
        assert!(range("1,1").is_err() && range("0,nan").is_err());
        assert_eq!(magnification("auto"), Ok(Magnification::Auto));
        assert_eq!(magnification("-20"), Ok(Magnification::Times(-20.0)));
        assert!(magnification("big").is_err_and(|it| it.contains("auto")));
        assert!(positive_number("0").is_err());
    }
}
