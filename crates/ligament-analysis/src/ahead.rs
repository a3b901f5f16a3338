//! What a run is about to do, told before it takes long.

/// What a run is about to do.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Ahead {
    /// Time steps of a motion.
    TimeSteps {
        /// Number of steps.
        count: usize,
        /// Whether each solves equations.
        is_implicit: bool,
    },
    /// Solutions with a factor of the stiffness.
    Factor {
        /// Multiplications of the factorisation.
        multiplications: f64,
    },
}
