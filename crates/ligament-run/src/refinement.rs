//! Passes of a refinement in a folder of results: each is a whole run, which the next one replaces.

use std::io::{self, Write};
use std::path::PathBuf;

use anyhow::Context;
use ligament::near_growth::Growth;
use ligament::refinement::EndedPass;
use ligament::setup::Refine;
use ligament::{Message, Model};
use ligament_analysis::driver::Outcome;
use ligament_analysis::largest_utilisation::LargestUtilisations;
use ligament_analysis::refinement_pass::{LastPass, PassRecord};
use ligament_case::case::CaseFile;
use ligament_case::point_table::text_of_fine_places;
use ligament_output::folder::ResultFolder;
use ligament_output::results::passes::{MESH_FILE, PLACES_FILE, RefinementSummary, write_passes};

/// Reason why a run begins anew from the unloaded body.
#[derive(Debug, Clone)]
pub(crate) enum Anew {
    /// Bonds take the place of elements whose stress reached its share of the strength.
    Growth(Growth),
    /// The next pass of a refinement, with the table of its places and the records of the passes before.
    Pass {
        refine: Refine,
        places: PathBuf,
        earlier: Vec<PassRecord>,
    },
}

impl Anew {
    /// Reason of the new run, for the user.
    pub(crate) fn words(&self) -> String {
        match self {
            Self::Growth(growth) => format!(
                "the stress at {} points of elements reached its share of the strength: bonds take their place, and the run begins anew",
                growth.points
            ),
            Self::Pass { refine, .. } => format!(
                "pass {} of at most {}: the mesh is refined around {} places, and the run begins anew",
                refine.pass,
                refine.passes.max(refine.pass),
                refine.places.len()
            ),
        }
    }

    /// The case of the new run.
    pub(crate) fn case(&self, case: &CaseFile) -> CaseFile {
        let mut case = case.clone();
        match self {
            Self::Growth(growth) => case.case.grow(growth),
            Self::Pass { refine, places, .. } => {
                if let Some(section) = &mut case.case.refine {
                    section.pass_number = refine.pass;
                    section.places = Some(places.clone());
                }
            }
        }
        case
    }
}

/// Number of the pass of a case; 1 where nothing is refined.
pub(crate) fn pass(case: &CaseFile) -> u32 {
    case.case.refine.as_ref().map_or(1, |it| it.pass_number)
}

/// Writes the refined mesh of a pass and the records of the passes before into its folder.
pub(crate) fn write_start(
    folder: &ResultFolder,
    model: &Model,
    earlier: &[PassRecord],
) -> anyhow::Result<()> {
    let Some(refined) = &model.refined else {
        return Ok(());
    };
    write_passes(folder, earlier)?;
    match refined.gmsh_text() {
        Some(text) => Ok(folder.write(MESH_FILE, text)?),
        None => Ok(()),
    }
}

/// Ends a pass: writes the records and the places that it found, and returns its summary and the next pass; none where nothing is refined.
pub(crate) fn end_pass(
    folder: &ResultFolder,
    (case, model): (&CaseFile, &Model),
    outcome: &Outcome,
    largest: Option<LargestUtilisations>,
    earlier: &[PassRecord],
) -> anyhow::Result<Option<(RefinementSummary, Option<Refine>)>> {
    let largest = largest.unwrap_or_default();
    let ended = model.end_pass(outcome, &largest, earlier);
    let Some(EndedPass {
        record,
        places,
        next,
    }) = ended.map_err(|it| case.error_at_key(it))?
    else {
        return Ok(None);
    };
    let passes = [earlier, &[record]].concat();
    write_passes(folder, &passes)?;
    let dimensions = model.setup.body.dimensions();
    folder
        .write(PLACES_FILE, text_of_fine_places(&places, dimensions))
        .context("the places of the next pass cannot be written")?;
    let (last, next) = match next {
        Ok(next) => (None, Some(next)),
        Err(last) => (Some(last), None),
    };
    Ok(Some((RefinementSummary { passes, last }, next)))
}

/// Writes the lines about the passes of a refinement; `force` is the unit of the peak.
pub(crate) fn write_refinement(
    refinement: &RefinementSummary,
    force: &str,
    out: &mut dyn Write,
) -> io::Result<()> {
    let mut rows = refinement.rows(force).into_iter();
    rows.try_for_each(|(name, words)| writeln!(out, "  {name:<18} {words}"))
}

/// Warning about a refinement whose last two passes do not agree.
pub(crate) fn unsettled(refinement: &RefinementSummary) -> Option<Message> {
    (refinement.last == Some(LastPass::AllPasses)).then(|| {
        let text = "the passes of the refinement ended by their number, before peak, work and path were within the tolerance from pass to pass";
        Message::new("unsettled-refinement", text).with_advice("allow more `refine.passes`, or look at their changes")
    })
}
