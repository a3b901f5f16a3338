//! What a motion does not have.

use super::document::Node;
use super::fault::KeyFault;
use super::key_path::KeyPath;
use super::motion::Scheme;
use super::solver::Solver;
use super::values::refuse;

/// Keys of `[fracture]` about load steps.
const STEPPING: [&str; 3] = ["control", "steps", "refine_first_break"];

/// Keys of `[fracture]` about breakages and equilibrium within a step.
const BALANCING: [&str; 5] = [
    "bonds_per_iteration",
    "order",
    "max_iterations",
    "tie_tolerance",
    "energy_tolerance",
];

/// Keys of `[fracture]` that a motion does not have.
pub(super) fn keys_of_statics(scheme: Scheme) -> Vec<&'static str> {
    let of_steps = STEPPING.into_iter().chain(["stop"]);
    match scheme {
        Scheme::Explicit => of_steps.chain(BALANCING).collect(),
        Scheme::Implicit | Scheme::Auto => of_steps.collect(),
    }
}

/// Refuses keys of load steps and of equations in a motion without them.
pub(super) fn refuse_statics(
    document: &Node,
    scheme: Scheme,
    solver: &Solver,
) -> Result<(), KeyFault> {
    let given = document.get("fracture");
    let is_given = |key: &'static str| (key, given.is_some_and(|it| it.get(key).is_some()));
    let fracture = KeyPath::default().child("fracture");
    let setting = "analysis = \"motion\"";
    let reason =
        "a motion has no load steps: bonds break at the time at which they reach their limits";
    refuse(&fracture, STEPPING.map(is_given), setting, reason)?;
    let reason = "a motion has a `stop` of its own, in [motion]";
    refuse(&fracture, [is_given("stop")], setting, reason)?;
    match scheme {
        Scheme::Implicit | Scheme::Auto => Ok(()),
        Scheme::Explicit => {
            let setting = "motion.scheme = \"explicit\"";
            let reason = "all bonds at their limits break in an explicit step";
            refuse(&fracture, BALANCING.map(is_given), setting, reason)?;
            let (key, reason) = (
                KeyPath::default().child("solver"),
                "explicit steps solve no equations",
            );
            let keys = solver.of_equations();
            refuse(&key, keys, "motion.scheme = \"explicit\"", reason)
        }
    }
}
