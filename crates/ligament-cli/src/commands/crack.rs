//! `ligament crack`.

use std::io::Write;
use std::path::PathBuf;

use clap::Args;
use ligament_output::quantity::{place, quantity};
use ligament_output::results::cracks::StoredCracks;
use ligament_output::results::steps::StepChoice;
use ligament_output::results::{CRACK_FILES, write_cracks};

use crate::terminal;

pub(super) const EXAMPLES: &str = "\
Examples:
  ligament crack results/plate                the cracks of the last state
  ligament crack results/plate --step peak

Writes crack.csv and crack.vtu (the lines of the step), crack_tips.csv (the tips over the load) and crack_growth.csv (length,
area and energy release rate over the load) into the folder. A crack runs along the faces between the cells of points
whose bond broke; what is nearer than a horizon is one crack, and what stays shorter is none.";

/// `ligament crack`.
#[derive(Debug, Args)]
pub struct CrackArgs {
    /// The folder with the results of a run
    #[arg(value_name = "RESULT")]
    pub results: PathBuf,
    /// Step of the lines: a number, first (breakage), peak or last
    #[arg(long, value_name = "STEP", default_value = "last")]
    pub step: StepChoice,
}

impl CrackArgs {
    /// Does it.
    pub(super) fn execute(self) -> anyhow::Result<()> {
        anyhow::ensure!(
            self.step != StepChoice::All,
            "the lines are those of one step; tips and lengths of all steps are in {} and {}",
            CRACK_FILES[2],
            CRACK_FILES[3]
        );
        let cracks = StoredCracks::open(&self.results)?;
        let steps = self.step.steps(&self.results, &cracks.steps())?;
        let step = steps.first().map_or(0, |it| it.step);
        let lines = write_cracks(&self.results, &cracks, step)?;
        let mut out = terminal::stdout();
        let length = lines.iter().fold(0.0, |sum, line| sum + line.length());
        writeln!(
            out,
            "step {step}: {} crack line(s), {} long, {} in area",
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
        Ok(writeln!(
            out,
            "{} in {}",
            CRACK_FILES.join(", "),
            self.results.display()
        )?)
    }
}
