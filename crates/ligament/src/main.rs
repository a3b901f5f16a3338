//! The `ligament` program.

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{CommandFactory, Parser};
use ligament::case::{CaseError, CaseFile};
use ligament::check::Extent;
use ligament::cli::{
    CaseArgs, CheckArgs, Cli, Command, CompletionsArgs, ExplainArgs, InspectArgs, MeshArgs,
    RunArgs, VerifyArgs, YieldArgs, YieldCalibration,
};
use ligament::explain::{self, Request, Subject};
use ligament::mesh_command::{MeshRequest, make_mesh};
use ligament::progress::ProgressMode;
use ligament::verify::table::Extent as VerifyExtent;
use ligament::yielding::{Families, Place};
use ligament::{check, inspect, run, verify, yielding};
use ligament_model::failure::frictional::Calibration;

fn main() -> ExitCode {
    let result = match Cli::parse().command {
        Command::Run(args) => run(args),
        Command::Check(args) => check(args),
        Command::Explain(args) => explain(args),
        Command::Inspect(args) => inspect(&args),
        Command::Mesh(args) => mesh(args),
        Command::Yield(args) => yielding(args),
        Command::Verify(args) => verify(args),
        Command::Completions(args) => completions(&args),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) if is_closed_pipe(&error) => ExitCode::SUCCESS,
        Err(error) => {
            print_error(&error);
            ExitCode::FAILURE
        }
    }
}

fn run(args: RunArgs) -> anyhow::Result<()> {
    let case = load(args.case)?;
    let out = args
        .out
        .unwrap_or_else(|| Path::new("results").join(case.name()));
    let summary = run::run(&case, &out, args.force, ProgressMode::detect(args.quiet))?;
    let mut stdout = io::stdout().lock();
    summary.write(&mut stdout)?;
    Ok(writeln!(stdout, "  results in         {}", out.display())?)
}

fn check(args: CheckArgs) -> anyhow::Result<()> {
    let case = load(args.case)?;
    let extent = if args.model_only {
        Extent::Model
    } else {
        Extent::Matrix
    };
    check::check(&case, extent, args.out.as_deref(), &mut io::stdout())
}

/// Reads the case, with the threads of the command line before its own.
fn load(args: CaseArgs) -> Result<CaseFile, CaseError> {
    let mut case = CaseFile::load(&args.file, &args.overrides)?;
    let threads = &mut case.case.solver.threads;
    *threads = args.threads.or(*threads);
    Ok(case)
}

fn explain(args: ExplainArgs) -> anyhow::Result<()> {
    let subject = match (
        args.subject.point,
        args.subject.bond.as_deref(),
        args.subject.at,
    ) {
        (Some(tag), ..) => Subject::Point(tag),
        (_, Some(&[a, b]), _) => Subject::Bond([a, b]),
        (_, _, Some(position)) => Subject::At(position),
        _ => unreachable!("one of them is required, and a bond has two ends"),
    };
    let request = Request {
        folder: args.results,
        subject,
        csv: args.csv,
        json: args.json,
    };
    explain::explain(&request, &mut io::stdout().lock())
}

fn inspect(args: &InspectArgs) -> anyhow::Result<()> {
    let mesh = inspect::read_mesh(&args.mesh)?;
    Ok(inspect::write_summary(
        &mut io::stdout().lock(),
        &args.mesh,
        &mesh,
    )?)
}

fn mesh(args: MeshArgs) -> anyhow::Result<()> {
    let out = args
        .out
        .unwrap_or_else(|| args.geometry.with_extension("msh"));
    let MeshArgs {
        geometry,
        gmsh,
        numbers,
        ..
    } = args;
    let request = MeshRequest {
        geometry,
        out,
        gmsh,
        numbers,
    };
    let mesh = make_mesh(&request)?;
    Ok(inspect::write_summary(
        &mut io::stdout().lock(),
        &request.out,
        &mesh,
    )?)
}

fn yielding(args: YieldArgs) -> anyhow::Result<()> {
    let (of, default_out) = match args.case {
        None => (Families::Lattices(args.m), PathBuf::from("results/yield")),
        Some(file) => {
            let case = Box::new(load(CaseArgs {
                file,
                overrides: args.overrides,
                threads: args.threads,
            })?);
            let out = Path::new("results").join(format!("{}-yield", case.name()));
            let place = args.at.map(Place::At).or(args.point.map(Place::Tag));
            let of = match place {
                Some(place) => Families::Point(case, place),
                None => Families::Field(case),
            };
            (of, out)
        }
    };
    let request = yielding::Request {
        of,
        combinations: args.criteria,
        poisson: args.nu,
        ratio: args.ratio,
        calibration: match args.calibration {
            YieldCalibration::Printed => Calibration::Printed,
            YieldCalibration::TwoPoint => Calibration::TwoPoint,
        },
        out: args.out.unwrap_or(default_out),
        force: args.force,
    };
    yielding::yielding(&request, &mut io::stdout())
}

fn verify(args: VerifyArgs) -> anyhow::Result<()> {
    let mut stdout = io::stdout();
    if args.list {
        return Ok(verify::report::console::list(&mut stdout)?);
    }
    let request = verify::Request {
        names: args.names,
        extent: if args.fast {
            VerifyExtent::Fast
        } else {
            VerifyExtent::Full
        },
        out: args.out,
        force: args.force,
    };
    verify::verify(&request, &mut stdout)
}

fn completions(args: &CompletionsArgs) -> anyhow::Result<()> {
    // Generated into memory: clap_complete panics where the pipe is closed early.
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut Cli::command(), "ligament", &mut script);
    Ok(io::stdout().lock().write_all(&script)?)
}

/// The error and its causes; a reader that has gone away does not want to hear of them.
fn print_error(error: &anyhow::Error) {
    let mut stderr = io::stderr().lock();
    let _ = writeln!(stderr, "error: {error}");
    for cause in error.chain().skip(1) {
        let _ = writeln!(stderr, "  because: {cause}");
    }
}

/// Whether standard output was closed by its reader, as by `ligament inspect ... | head`.
fn is_closed_pipe(error: &anyhow::Error) -> bool {
    error
        .downcast_ref::<io::Error>()
        .is_some_and(|error| error.kind() == io::ErrorKind::BrokenPipe)
}
