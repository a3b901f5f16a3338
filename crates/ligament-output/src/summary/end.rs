//! Verdict on the results of a run by its end, from the table of ends.

use ligament_analysis::termination::{ENDS, End, Verdict};

use super::Summary;

/// Message about a run that ended without equilibrium after other states.
pub const INCOMPLETE_RUN_NOTE: &str =
    "no equilibrium was found at the load where the run ended; the results reach up to there";

/// The verdict on the results by the short name of an end; for a name of another version, the verdict on a complete run.
pub fn verdict(termination: &str) -> Verdict {
    let row = ENDS.iter().find(|it| it.name == termination);
    row.map_or(Verdict::Complete, |it| it.verdict)
}

impl Summary {
    /// End of the run.
    pub fn end(&self) -> End {
        let verdict = verdict(&self.termination);
        verdict.end(self.without_equilibrium, self.last_state_not_at_rest)
    }

    /// Words about the error of the energy balance.
    pub fn energy_balance(&self) -> String {
        let put_in = match self.motion.is_some() {
            true => "energy put in",
            false => "work",
        };
        format!("off by {:.1e} of the {put_in}", self.energy_balance_error)
    }

    /// Head and words about the results of a run that did not end well.
    pub fn warning_of_end(&self) -> Option<[&'static str; 2]> {
        Some(match (self.end(), verdict(&self.termination)) {
            (End::NoResult, Verdict::Invalid) => [
                "NO RESULT",
                "no state under load can be trusted, so there are no results",
            ],
            (End::NoResult, _) => [
                "NO EQUILIBRIUM",
                "there is no equilibrium under any load, so there are no results",
            ],
            (End::NoEquilibrium, _) => ["NO EQUILIBRIUM", INCOMPLETE_RUN_NOTE],
            (End::Invalid, _) => [
                "NOT TO BE TRUSTED",
                "ignore the last state; the results reach up to the one before",
            ],
            (End::Done | End::Stopped | End::NotAtRest, _) if self.last_state_not_at_rest => [
                "NOT CONVERGED",
                "bonds were still breaking in the last state; ignore it",
            ],
            (End::NotAtRest, _) => [
                "COLLAPSED",
                "the body does not carry the load where the run ended; the results reach up to there",
            ],
            (End::Done | End::Stopped, _) => return None,
        })
    }
}
