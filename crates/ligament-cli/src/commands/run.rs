//! `ligament run`.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;

use clap::Args;
use ligament_analysis::distributed_matrix::SingleProcess;
use ligament_plot::picture::{asks_for_pictures, draw_run};
use ligament_run::progress::ProgressMode;
use ligament_run::run::{Report, Request};
use ligament_study::sweep::bind_to_parent;

use super::argument_parsers::output_folder;
use super::case_args::CaseArgs;
use crate::build::BUILD;
use crate::stop_signal::StopSignal;
use crate::{processes, terminal};

pub(super) const EXAMPLES: &str = "\
Examples:
  ligament run cases/disk/case.toml
  ligament run case.toml --out results/fine --set model.horizon_factor=4
  ligament run case.toml --set mesh.plane=strain --set load.0.displacement.y=-1e-4
  ligament run case.toml --set fracture.steps=10 --set fracture.stop.bonds=300

--set changes any key of the case file; the entries of a list such as [[load]] count from 0.
The value is TOML; a bare word is a string. Values are in SI units: m, N, Pa, s, rad.
Paths, also in --set mesh.file=..., are relative to the folder of the case file.

Exit codes:
  0  done
  1  error
  2  wrong usage
  3  no equilibrium under any load, or beyond some load; or an unstable model, or a motion whose energy grew: do not trust it
  4  stopped by a signal
  6  collapsed, or ended while bonds were breaking: ignore the last state";

/// `ligament run`.
#[derive(Debug, Args)]
pub struct RunArgs {
    /// The case file and changes to it.
    #[command(flatten)]
    pub case: CaseArgs,
    /// Folder for the results [default: results/NAME, with the name of the case file, or of its folder where the file is
    /// case.toml]
    #[arg(short, long, alias = "output", value_parser = output_folder(), value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Replace results of an earlier run in the folder
    #[arg(long)]
    pub force: bool,
    /// Draw the last state and the force-displacement curve into the folder of the results, as `output.picture = true` does
    #[arg(long)]
    pub plot: bool,
    /// Show no progress, only the final result and errors
    #[arg(long, short)]
    pub quiet: bool,
    /// End when standard input ends, and hold this lock until then: for `ligament sweep`.
    #[arg(long, value_name = "LOCK", hide = true)]
    pub leash: Option<PathBuf>,
}

impl RunArgs {
    /// Executes the command.
    pub(super) fn execute(self) -> anyhow::Result<ExitCode> {
        if let Some(lock) = &self.leash {
            bind_to_parent(lock)?;
        }
        // A run of a sweep is one process, whoever started the sweep.
        let communicator = match &self.leash {
            None => processes::join()?,
            Some(_) => Arc::new(SingleProcess),
        };
        let case = self.case.load()?;
        // Without load steps there is nothing to go on with later, and for a sweep the run starts anew.
        let stop = match (&self.leash, &case.case.fracture) {
            (None, Some(_)) => StopSignal::install()?,
            _ => StopSignal::default(),
        };
        let out = self
            .out
            .unwrap_or_else(|| Path::new("results").join(case.name()));
        let request = Request {
            force: self.force,
            is_stopped: &|| stop.is_received(),
            communicator,
            ..Request::new(&case, &out, BUILD)
        };
        let report = request.run(ProgressMode::detect(self.quiet))?;
        print_report(&report, &out, self.plot)
    }
}

/// Prints the report of a run and the path of its results; draws pictures if the options or the case ask for them.
pub(super) fn print_report(
    report: &Report,
    folder: &Path,
    pictures: bool,
) -> anyhow::Result<ExitCode> {
    let code = ExitCode::from(report.end().exit_code());
    if matches!(report, Report::OfRankZero) {
        return Ok(code);
    }
    let mut stdout = terminal::stdout();
    report.write(&mut stdout)?;
    let out = folder.display();
    if report.is_stopped() {
        writeln!(stdout, "  go on with         ligament resume {out}")?;
        return Ok(code);
    }
    writeln!(stdout, "  results in         {out}")?;
    if let Some(reason) = report.without_equilibrium() {
        stdout.flush()?;
        writeln!(terminal::stderr(), "error: no result under load: {reason}")?;
        return Ok(code);
    }
    if pictures || asks_for_pictures(folder) {
        // A picture that cannot be drawn does not undo the run.
        match draw_run(folder) {
            Ok(drawn) => {
                for path in drawn {
                    writeln!(stdout, "  picture            {}", path.display())?;
                }
            }
            Err(error) => writeln!(terminal::stderr(), "warning: no picture: {error}")?,
        }
    }
    Ok(code)
}
