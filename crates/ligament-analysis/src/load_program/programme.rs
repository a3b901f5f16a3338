//! A programme of loading: stages one after the other, in which every load follows its own factor.

use std::sync::Arc;

/// Stages one after the other: every load, displacement and temperature is its value at factor 1 times a factor of its own.
///
/// The factors go along straight lines from one part to the next, so that in each part everything that acts is A + w B.
#[derive(Debug, Clone, PartialEq)]
pub struct Programme {
    /// Names of the loads, the temperature among them, shape (n_loads).
    pub names: Vec<String>,
    /// The load that is the temperature.
    pub temperature: Option<usize>,
    /// The load whose displacement and force are the axes of the force-displacement curve.
    pub control: usize,
    /// Names of the stages.
    pub stages: Vec<String>,
    /// The parts of all stages, one after the other.
    pub parts: Vec<Part>,
}

/// A part of a stage, in which all factors go along straight lines.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// Index of the stage.
    pub stage: usize,
    /// Load factor at the start and at the end: the shares of the stage that are over, 0 to 1.
    pub span: (f64, f64),
    /// Factor of each load at the end of the part; a load without one keeps what it has, shape (n_loads).
    pub ends: Vec<Option<f64>>,
    /// Equal load steps of the part.
    pub steps: usize,
    /// What grows steadily in the part, while the load factor follows from it; the load factor grows where there is nothing.
    pub control: Option<PartControl>,
}

/// What grows steadily in a part of a programme in the place of the load factor.
#[derive(Debug, Clone, PartialEq)]
pub enum PartControl {
    /// A motion.
    Motion(MotionControl),
    /// The energy that bonds have taken for good, from the start of the loading on.
    DissipatedEnergy {
        /// Value at the end of the stage, J.
        end: f64,
    },
}

impl PartControl {
    /// The value at the end of the stage, m, rad or J.
    pub fn end(&self) -> f64 {
        match self {
            Self::Motion(motion) => motion.end,
            Self::DissipatedEnergy { end } => *end,
        }
    }
}

/// A linear function of the displacements that grows steadily in a stage.
#[derive(Debug, Clone, PartialEq)]
pub struct MotionControl {
    /// Degrees of freedom with their weights.
    pub weights: Vec<(u32, f64)>,
    /// Value at the end of the stage, m or rad.
    pub end: f64,
}

impl MotionControl {
    /// The value in displacements (n_degrees_of_freedom), m or rad.
    pub fn value(&self, displacement: &[f64]) -> f64 {
        let terms = self.weights.iter();
        let terms = terms.map(|&(dof, weight)| weight * displacement[dof as usize]);
        terms.sum()
    }
}

/// The factors of the loads in a part of a programme.
#[derive(Debug, Clone)]
pub struct LoadCourse {
    /// The programme.
    pub programme: Arc<Programme>,
    /// Index of the part.
    pub part: usize,
    span: (f64, f64),
    /// Factor of each load, shape (n_loads).
    pub(super) factors: Vec<Pair>,
}

/// What a quantity is at the start of a part, and what it grows by in it.
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
    /// The part of a programme that begins with these factors of the loads (n_loads).
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

    /// The load of the force-displacement curve alone, which grows to its factor 1 at the load factor 1 while the others are absent:
    /// what they prescribe is held at zero.
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

    /// What grows in this part alone, for a growth of the load factor by one: in proportion to the load factor.
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

    /// What controls the part in the place of the load factor, if something does.
    pub fn control(&self) -> Option<&PartControl> {
        self.programme.parts[self.part].control.as_ref()
    }

    /// Load steps of the part.
    pub fn n_steps(&self) -> usize {
        self.programme.parts[self.part].steps
    }

    /// The share w of the part that is over at a load factor.
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
