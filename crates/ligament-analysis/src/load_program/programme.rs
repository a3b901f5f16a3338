//! Load program of consecutive stages, in which every load has its own factor.

use std::sync::Arc;

/// Consecutive stages: every load, displacement and temperature is its value at factor 1 times a factor of its own.
///
/// The factors are piecewise linear from part to part, so that all loads of a part are A + w B.
#[derive(Debug, Clone, PartialEq)]
pub struct Programme {
    /// Names of the loads, including the temperature, shape (n_loads).
    pub names: Vec<String>,
    /// Index of the temperature among the loads; None without a temperature.
    pub temperature: Option<usize>,
    /// Index of the load whose displacement and force are the axes of the force-displacement curve.
    pub control: usize,
    /// Names of the stages.
    pub stages: Vec<String>,
    /// Consecutive parts of all stages.
    pub parts: Vec<Part>,
}

/// Part of a stage, in which all factors are linear.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// Index of the stage.
    pub stage: usize,
    /// Load factor at the start and at the end: the completed shares of the stage, 0 to 1.
    pub span: (f64, f64),
    /// Factor of each load at the end of the part, None for a load that stays constant, shape (n_loads).
    pub ends: Vec<Option<f64>>,
    /// Number of equal load steps of the part.
    pub steps: usize,
    /// Quantity that grows steadily in the part and determines the load factor; None where the load factor itself grows steadily.
    pub control: Option<PartControl>,
}

/// Quantity that grows steadily in a part of a programme in place of the load factor.
#[derive(Debug, Clone, PartialEq)]
pub enum PartControl {
    /// A motion.
    Motion(MotionControl),
    /// Energy dissipated by the bonds since the start of the loading.
    DissipatedEnergy {
        /// Value at the end of the stage, J.
        end: f64,
    },
}

impl PartControl {
    /// Value at the end of the stage, m, rad or J.
    pub fn end(&self) -> f64 {
        match self {
            Self::Motion(motion) => motion.end,
            Self::DissipatedEnergy { end } => *end,
        }
    }
}

/// Linear function of the displacements that grows steadily in a stage.
#[derive(Debug, Clone, PartialEq)]
pub struct MotionControl {
    /// Degrees of freedom and their weights.
    pub weights: Vec<(u32, f64)>,
    /// Value at the end of the stage, m or rad.
    pub end: f64,
}

impl MotionControl {
    /// Value for displacements (n_degrees_of_freedom), m or rad.
    pub fn value(&self, displacement: &[f64]) -> f64 {
        let terms = self.weights.iter();
        let terms = terms.map(|&(dof, weight)| weight * displacement[dof as usize]);
        terms.sum()
    }
}

/// Factors of the loads in a part of a programme.
#[derive(Debug, Clone)]
pub struct LoadCourse {
    /// Programme to which the part belongs.
    pub programme: Arc<Programme>,
    /// Index of the part.
    pub part: usize,
    span: (f64, f64),
    /// Factor of each load, shape (n_loads).
    pub(super) factors: Vec<Pair>,
}

/// Value of a quantity at the start of a part, and its growth over the part.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Pair {
    start: f64,
    growth: f64,
}

impl Pair {
    pub(super) fn at(self, share: f64) -> f64 {
        self.start + share * self.growth
    }

    pub(super) fn add(&mut self, factor: Self, value: f64) {
        self.start += factor.start * value;
        self.growth += factor.growth * value;
    }
}

impl Part {
    /// Load factors at the ends of the steps.
    pub fn load_factors(&self) -> Vec<f64> {
        let (begins, ends) = self.span;
        let inner = (1..self.steps).map(|step| step as f64 / self.steps as f64);
        let inner = inner.map(|share| begins + share * (ends - begins));
        inner.chain([ends]).collect()
    }
}

impl Programme {
    /// Name of the stage of a part.
    pub fn stage_name(&self, part: usize) -> &str {
        &self.stages[self.parts[part].stage]
    }
}

impl LoadCourse {
    /// Part of a programme that begins with these factors of the loads (n_loads).
    pub fn new(programme: Arc<Programme>, part: usize, start: &[f64]) -> Self {
        let given = &programme.parts[part];
        let pair = |(&start, end): (&f64, &Option<f64>)| Pair {
            start,
            growth: end.unwrap_or(start) - start,
        };
        Self {
            factors: start.iter().zip(&given.ends).map(pair).collect(),
            span: given.span,
            part,
            programme,
        }
    }

    /// Course of the control load alone, which grows to its factor 1 at load factor 1, with all other loads and prescribed motions
    /// zero.
    pub fn control_alone(&self) -> Self {
        let control = self.programme.control;
        let pair = |load: usize| Pair {
            start: 0.0,
            growth: f64::from(u8::from(load == control)),
        };
        Self {
            factors: (0..self.factors.len()).map(pair).collect(),
            span: (0.0, 1.0),
            ..self.clone()
        }
    }

    /// Rate of the factors in this part with the load factor, as a course in proportion to the load factor.
    pub fn rate(&self) -> Self {
        let (begins, ends) = self.span;
        let alone = |it: &Pair| Pair {
            start: 0.0,
            growth: it.growth / (ends - begins),
        };
        Self {
            factors: self.factors.iter().map(alone).collect(),
            span: (0.0, 1.0),
            ..self.clone()
        }
    }

    /// Motion or energy that controls the part in place of the load factor; None for the load factor.
    pub fn control(&self) -> Option<&PartControl> {
        self.programme.parts[self.part].control.as_ref()
    }

    /// Number of load steps of the part.
    pub fn n_steps(&self) -> usize {
        self.programme.parts[self.part].steps
    }

    /// Completed share w of the part at a load factor.
    pub fn share(&self, load_factor: f64) -> f64 {
        let (begins, ends) = self.span;
        (load_factor - begins) / (ends - begins)
    }

    /// Factor of a load at a load factor.
    pub fn factor(&self, load: usize, load_factor: f64) -> f64 {
        self.factors[load].at(self.share(load_factor))
    }

    /// Factors of all loads at a load factor, shape (n_loads).
    pub fn factors(&self, load_factor: f64) -> Vec<f64> {
        let share = self.share(load_factor);
        self.factors.iter().map(|it| it.at(share)).collect()
    }

    /// Factors of all loads at the start of the part, shape (n_loads).
    pub fn start(&self) -> Vec<f64> {
        self.factors.iter().map(|it| it.start).collect()
    }
}
