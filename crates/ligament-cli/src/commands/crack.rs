//! `ligament crack`.

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use ligament_output::csv::read::CsvTable;
use ligament_output::quantity::{place, quantity};
use ligament_output::results::cracks::StoredCracks;
use ligament_output::results::solid_cracks::{SolidCracks, has_solid};
use ligament_output::results::steps::{NamedStep, StepChoice, StepName, time_of};
use ligament_output::results::{
    CRACK_FILES, CrackedBelow, SURFACE_FILES, StoredState, write_cracks, write_series,
    write_surface,
};
use ligament_plot::picture::{IsosurfaceRequest, write_isosurfaces};
use ligament_post::surfaces::CrackSurface;

use super::argument_parsers;
use crate::terminal;

pub(super) const EXAMPLES: &str = "\
Examples:
  ligament crack results/plate                the cracks of the last state
  ligament crack results/plate --step peak
  ligament crack results/beam --force-left 0.5  softening bonds count from half of their force
  ligament crack results/beam --iso 0.3       in a solid: the surface of damage 0.3

Writes crack.csv and crack.vtu (the lines of the step), opened.vtu (the cells of a mesh, opened along them),
crack_tips.csv (the tips over the load) and crack_growth.csv (length, area and energy release rate over the load) into the
folder; of a motion they have the speed of each tip and the rates of length and area over the time. A crack runs along the faces between the cells of points whose bond broke. Cracks closer than a horizon count as
one, and shorter ones are ignored.

In a solid the crack is a surface of triangles: crack.vtu and crack.stl have it with its opening, and crack_growth.csv its
area over the load. --step all writes the surface and the opened cells of all stored steps, crack.pvd and opened.pvd.
--iso writes only the surface on which a field has a value: iso.vtu has its triangles with all fields of the points, and
with --step all iso_NNNN.vtu and iso.pvd.";

/// `ligament crack`.
#[derive(Debug, Args)]
pub struct CrackArgs {
    /// The folder with the results of a run
    #[arg(value_name = "RESULT")]
    pub results: PathBuf,
    /// Step of the crack: a number, -1 for the last, first (breakage), peak or last, of a motion a time in s as t=4e-5; in a solid also all
    #[arg(
        long,
        value_name = "STEP",
        default_value = "last",
        allow_negative_numbers = true
    )]
    pub step: StepChoice,
    /// Share of its force below which a softening bond counts as cracked
    #[arg(long, value_name = "SHARE", default_value = "0.1", value_parser = cracked_below(), conflicts_with = "iso")]
    pub force_left: CrackedBelow,
    /// Write the surface in a solid on which a field has this value, in SI units, into iso.vtu
    #[arg(long, value_name = "VALUE", allow_hyphen_values = true, value_parser = number)]
    pub iso: Option<f64>,
    /// Field of the surface: NAME (the norm of a vector), NAME.x, or NAME.xx of a stress
    #[arg(long, value_name = "NAME", default_value = "damage", requires = "iso")]
    pub field: String,
}

impl CrackArgs {
    /// Executes the command.
    pub(super) fn execute(self) -> anyhow::Result<()> {
        if let Some(level) = self.iso {
            return self.isosurface(level);
        }
        if has_solid(&self.results)? {
            return self.surface();
        }
        anyhow::ensure!(
            self.step != StepChoice::All,
            "the lines are those of one step; tips and lengths of all steps are in {} and {}",
            CRACK_FILES[2],
            CRACK_FILES[3]
        );
        let cracks = StoredCracks::open_below(&self.results, self.force_left)?;
        let steps = self.step.steps(&self.results, cracks.states())?;
        let state = one_state(&steps)?;
        let lines = write_cracks(&self.results, &cracks, state)?;
        let mut out = terminal::stdout();
        let when = time_words(&self.results, state)?;
        let length = lines.iter().fold(0.0, |sum, line| sum + line.length());
        writeln!(
            out,
            "{when}: {} crack line(s), {} long, {} in area",
            lines.len(),
            quantity(length, "m"),
            quantity(length * cracks.thickness, "m^2")
        )?;
        for (number, line) in (1..).zip(&lines) {
            let [from, to] = [0, line.places.len() - 1].map(|it| line.places[it]);
            writeln!(
                out,
                "  {number:<3} from the {} at {} to the {} at {}, {} long",
                line.ends[0].word(),
                place(&from),
                line.ends[1].word(),
                place(&to),
                quantity(line.length(), "m")
            )?;
        }
        write_speeds(&mut out, &self.results, state.step)?;
        Ok(writeln!(
            out,
            "{} in {}",
            CRACK_FILES.join(", "),
            self.results.display()
        )?)
    }
}

/// Writes the speed of each tip of a motion up to a step.
fn write_speeds(out: &mut dyn Write, folder: &Path, step: usize) -> anyhow::Result<()> {
    let table = CsvTable::read(folder.join(CRACK_FILES[2]))?;
    if !table.columns().iter().any(|it| it == "speed") {
        return Ok(());
    }
    let tips = table.rows(|row| {
        let at = [row.value("x")?, row.value("y")?];
        Ok((row.value("step")?, at, row.value::<String>("speed")?))
    })?;
    let until = tips.iter().map(|it: &(usize, _, _)| it.0);
    let last = until.filter(|it| *it <= step).max();
    for (_, at, speed) in tips.iter().filter(|it| Some(it.0) == last) {
        // A new tip has no speed.
        if let Ok(speed) = speed.parse::<f64>() {
            let speed = quantity(speed, "m/s");
            writeln!(out, "  the tip at {} moves at {speed}", place(at))?;
        }
    }
    Ok(())
}

/// The one state that is meant.
fn one_state(steps: &[NamedStep]) -> anyhow::Result<StoredState> {
    match steps {
        [one] => Ok(one.state),
        all => anyhow::bail!("--step means {} states; name one of them", all.len()),
    }
}

/// The state, or the time of a motion, in words.
fn time_words(folder: &Path, state: StoredState) -> anyhow::Result<String> {
    let time = time_of(folder, state.step)?;
    Ok(match time {
        Some(time) => format!("t = {}", quantity(time, "s")),
        None => format!("step {state}"),
    })
}

/// Parser of the share of a force, one of the shares in `softening.csv`.
fn cracked_below() -> impl TypedValueParser<Value = CrackedBelow> {
    let names = PossibleValuesParser::new(["0.5", "0.25", "0.1"]);
    names.map(|name| match name.as_str() {
        "0.5" => CrackedBelow::Half,
        "0.25" => CrackedBelow::Quarter,
        _ => CrackedBelow::Tenth,
    })
}

/// Number of parts of a surface that are listed one by one.
const TOLD: usize = 10;

impl CrackArgs {
    /// Writes the crack of a solid.
    fn surface(self) -> anyhow::Result<()> {
        let cracks = SolidCracks::open_below(&self.results, self.force_left)?;
        let mut out = terminal::stdout();
        let choice = match self.step {
            StepChoice::All => {
                let count = write_series(&self.results, &cracks)?;
                // Boxes of a lattice part by themselves.
                let written = ["crack.pvd", "opened.pvd"].into_iter();
                let written = written.filter(|it| self.results.join(it).is_file());
                let written: Vec<&str> = written.collect();
                writeln!(out, "{count} steps: {}", written.join(", "))?;
                StepChoice::One(StepName::Last)
            }
            one => one,
        };
        let steps = choice.steps(&self.results, cracks.states())?;
        let state = one_state(&steps)?;
        let surface = write_surface(&self.results, &cracks, state)?;
        write_measures(&mut out, &time_words(&self.results, state)?, &surface)?;
        let names = SURFACE_FILES
            .into_iter()
            .filter(|it| self.results.join(it).is_file());
        let names: Vec<&str> = names.collect();
        Ok(writeln!(
            out,
            "{} in {}",
            names.join(", "),
            self.results.display()
        )?)
    }
}

impl CrackArgs {
    /// Writes the surface in a solid on which a field equals a level.
    fn isosurface(self, level: f64) -> anyhow::Result<()> {
        let written = write_isosurfaces(&IsosurfaceRequest {
            folder: self.results,
            field: self.field.clone(),
            level,
            step: self.step,
        })?;
        let mut out = terminal::stdout();
        for it in written {
            match it.triangles {
                0 => writeln!(
                    out,
                    "step {}: {} is nowhere {level}, no file",
                    it.state, self.field
                )?,
                count => writeln!(
                    out,
                    "step {}: {} = {level} on {}, {count} triangles in {}",
                    it.state,
                    self.field,
                    quantity(it.area, "m^2"),
                    it.path.display()
                )?,
            }
        }
        Ok(())
    }
}

fn number(text: &str) -> Result<f64, String> {
    argument_parsers::number(text).ok_or_else(|| format!("`{text}` is not a number"))
}

/// Writes area, plane and parts of a surface.
fn write_measures(out: &mut dyn Write, when: &str, surface: &CrackSurface) -> std::io::Result<()> {
    let parts = surface.parts();
    let (area, count) = (quantity(surface.area(), "m^2"), parts.len());
    writeln!(out, "{when}: crack surface of {area} in {count} part(s)")?;
    if let Some(plane) = surface.best_plane() {
        let [x, y, z] = plane.normal.map(|it| format!("{it:.3}"));
        let away = quantity(plane.largest_distance, "m");
        writeln!(
            out,
            "  best plane with the normal ({x}, {y}, {z}): the surface is {away} from it at most"
        )?;
    }
    for (number, part) in (1..).zip(&parts).take(TOLD) {
        let [low, high] = part.extent;
        let sides = [0, 1, 2].map(|axis| quantity(high[axis] - low[axis], "m"));
        let precrack = match part.precrack > 0.0 {
            true => format!(", with {} of a pre-crack", quantity(part.precrack, "m^2")),
            false => String::new(),
        };
        let area = quantity(part.area, "m^2");
        writeln!(
            out,
            "  {number:<3} {area}, extent {}{precrack}",
            sides.join(" x ")
        )?;
    }
    if count > TOLD {
        let rest = parts[TOLD..].iter().map(|it| it.area).sum::<f64>();
        writeln!(
            out,
            "  and {} smaller parts of {} together",
            count - TOLD,
            quantity(rest, "m^2")
        )?;
    }
    Ok(())
}
