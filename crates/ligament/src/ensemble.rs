//! Samples of a body whose strength, fracture energy or both vary at random.
//!
//! All samples share the model, the factor of its intact stiffness and its elastic solution; only the limits of the bonds differ. Sample k
//! depends only on the seed of the ensemble and on k: it equals, to the last bit, the run of the setup whose first random property has the
//! seed of [`Ensemble::seed_of`], whatever the number of threads and of other samples. A second property with a seed of its own has
//! the same factors in all samples; without one it varies from sample to sample as well, independently of the first.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::sync_channel;
use std::thread;

use ligament_analysis::driver::event::{self, EventSettings};
use ligament_analysis::driver::stepped::{self, SteppedSettings};
use ligament_analysis::driver::{Outcome, Prepared, Problem};
use ligament_analysis::history::{BreakRecord, ObserverError, StepRecord, View};
use ligament_analysis::{Observer, Termination};
use ligament_model::failure::Criteria;
use ligament_model::scatter::{self, Scatter};
use ligament_model::{ConstantFields, System};

use crate::error::{Error, Fault, Field, SetupError};
use crate::formulation;
use crate::loading::Loading;
use crate::model::Model;
use crate::run::{NoObserver, on_threads};
use crate::setup::Analysis;
use crate::system::over_dimension;

/// A body with its loads, prepared for samples of its random properties.
pub struct Ensemble {
    model: Model,
    problem: Problem,
    prepared: Prepared,
    seed: u64,
    breaking: Breaking,
}

/// Way to follow the samples.
enum Breaking {
    /// Along the exact path.
    Exact(EventSettings),
    /// In load steps.
    Steps(SteppedSettings),
}

/// Path of a sample.
#[derive(Debug, Clone)]
pub struct Sample {
    /// Number of the sample, from 0.
    pub number: u64,
    /// Seed of the random numbers of its first random property.
    pub seed: u64,
    /// Path of the sample.
    pub path: SampledPath,
}

/// Path of a body with given limits.
#[derive(Debug, Clone)]
pub struct SampledPath {
    /// Bonds that broke first, together; empty where none broke.
    pub first: Vec<BreakRecord>,
    /// History, last state, and why the path ended.
    pub outcome: Outcome,
}

impl Ensemble {
    /// The ensemble of a model with a seed: factorises the intact body and solves once at load factor one.
    ///
    /// # Errors
    ///
    /// If nothing varies at random, no bond breaks in the analysis or it depends on the time that it takes, or the equations cannot be
    /// set up.
    pub fn new(model: Model, seed: u64) -> Result<Self, Error> {
        if model.setup.scatter.is_empty() {
            let advice = "an ensemble needs a strength or a fracture energy that varies at random";
            let fault = Fault::Contradiction(advice.into());
            return Err(Field::whole("scatter").error(fault).into());
        }
        let far_field = model.setup.far_field.as_ref();
        if far_field.is_some_and(|it| it.strength_share.is_some()) {
            let advice =
                "all samples of an ensemble share one near field: give its places, and remove this";
            let fault = Fault::Contradiction(advice.into());
            let field = Field::whole("far_field").part("strength_share");
            return Err(field.error(fault).into());
        }
        if model.setup.refine.is_some() {
            let advice = "all samples of an ensemble share one mesh: remove this, and take the `mesh.msh` of a refined run";
            let fault = Fault::Contradiction(advice.into());
            return Err(Field::whole("refine").error(fault).into());
        }
        let (breaking, energy_tolerance, stop) = match &model.setup.analysis {
            Analysis::Event(it) => (Breaking::Exact(it.clone()), it.energy_tolerance, it.stop),
            Analysis::Stepped(it) => (Breaking::Steps(it.clone()), it.energy_tolerance, it.stop),
            Analysis::Elastic { .. } | Analysis::Modal(_) | Analysis::Motion(_) => {
                let advice =
                    "the samples of an ensemble break along the exact path or in load steps";
                let fault = Fault::Contradiction(advice.into());
                return Err(Field::whole("analysis").error(fault).into());
            }
        };
        if stop.wall_time.is_some() {
            let advice =
                "the samples of an ensemble may not depend on the time that they take: remove it";
            let fault = Fault::Contradiction(advice.into());
            return Err(Field::whole("analysis.stop")
                .part("wall_time")
                .error(fault)
                .into());
        }
        let problem = Loading::new(&model)?.problem(&model);
        let prepared = Prepared::new(&problem, energy_tolerance, &mut NoObserver)?;
        Ok(Self {
            model,
            problem,
            prepared,
            seed,
            breaking,
        })
    }

    /// End of all samples where the intact model is unstable, unless the setup allows that.
    pub fn refused(&self) -> Option<Termination> {
        self.prepared.refused(&self.problem)
    }

    /// The model, with the limits of the seed of its setup.
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// The problem of the model.
    pub fn problem(&self) -> &Problem {
        &self.problem
    }

    /// The seed of the first random property of a sample, for a run of this sample alone.
    pub fn seed_of(&self, number: u64) -> u64 {
        scatter::seed_of_sample(self.seed, number)
    }

    /// The random properties of a sample: the properties of the setup, the first one with the seed of the sample.
    pub fn scatter_of(&self, number: u64) -> Vec<Scatter> {
        let mut scatter = self.model.setup.scatter.clone();
        if let Some(first) = scatter.first_mut() {
            first.seed = Some(self.seed_of(number));
        }
        scatter
    }

    /// The path of a sample, on the caller's threads.
    ///
    /// # Errors
    ///
    /// If a random limit leaves no energy for the softening of a bond, or the path cannot be followed.
    pub fn sample(&self, number: u64) -> Result<Sample, Error> {
        Ok(Sample {
            number,
            seed: self.seed_of(number),
            path: self.followed(&self.with_limits(&self.scatter_of(number))?)?,
        })
    }

    /// The path of the body whose factors are all 1.
    ///
    /// # Errors
    ///
    /// If the path cannot be followed.
    pub fn sound(&self) -> Result<SampledPath, Error> {
        self.followed(&self.with_limits(&[])?)
    }

    /// The problem with the limits of random properties, or of none.
    ///
    /// # Errors
    ///
    /// If a random limit leaves no energy for the softening of a bond.
    pub fn with_limits(&self, scatter: &[Scatter]) -> Result<Problem, SetupError> {
        let model = &self.model;
        let criteria =
            over_dimension!(&model.system, system => criteria(model, &**system, scatter))?;
        Ok(Problem {
            criteria: Arc::new(criteria),
            ..self.problem.clone()
        })
    }

    /// The path of the prepared body with the limits of a problem.
    ///
    /// # Errors
    ///
    /// If the path cannot be followed.
    pub fn followed(&self, problem: &Problem) -> Result<SampledPath, Error> {
        let mut observer = FirstBreaks(Vec::new());
        let prepared = &self.prepared;
        let outcome = match &self.breaking {
            Breaking::Exact(settings) => {
                event::run_from(prepared, problem, settings, &mut observer)?
            }
            Breaking::Steps(settings) => {
                stepped::run_from(prepared, problem, settings, &mut observer)?
            }
        };
        Ok(SampledPath {
            first: observer.0,
            outcome,
        })
    }

    /// Passes samples to `each`, in the order in which they end. `workers` samples are followed at once, each on a number of threads.
    ///
    /// # Errors
    ///
    /// The first error of a sample or of `each`, after which no sample begins.
    pub fn for_each<E: From<Error> + Send>(
        &self,
        numbers: &[u64],
        [workers, threads]: [usize; 2],
        mut each: impl FnMut(Sample) -> Result<(), E>,
    ) -> Result<(), E> {
        let next = AtomicUsize::new(0);
        let (sender, receiver) = sync_channel(workers);
        thread::scope(|scope| {
            for _ in 0..workers {
                let (next, sender) = (&next, sender.clone());
                scope.spawn(move || {
                    let work = || {
                        while let Some(&number) = numbers.get(next.fetch_add(1, Ordering::Relaxed))
                        {
                            // A receiver that is gone wants no more samples.
                            if sender.send(self.sample(number)).is_err() {
                                return;
                            }
                        }
                    };
                    if let Err(error) = on_threads(Some(threads), work) {
                        let _ = sender.send(Err(error.into()));
                    }
                });
            }
            drop(sender);
            receiver.into_iter().try_for_each(|sample| each(sample?))
        })
    }
}

/// Criteria of a model whose limits have the factors of random properties, or of none.
fn criteria<const D: usize>(
    model: &Model,
    system: &dyn System<D>,
    scatter: &[Scatter],
) -> Result<Criteria, SetupError> {
    let body = model.setup.body.geometry::<D>();
    let fixed = ConstantFields {
        scatter: scatter::factors(scatter, &body.positions(), &body.numbering()),
        ..model.fixed.clone()
    };
    formulation::criteria(&model.setup, system, &fixed)
}

/// The bonds that break first.
struct FirstBreaks(Vec<BreakRecord>);

impl Observer for FirstBreaks {
    fn looks(&self, _: usize) -> bool {
        false
    }

    fn broke(&mut self, records: &[BreakRecord]) -> Result<(), ObserverError> {
        if self.0.is_empty() {
            self.0 = records.to_vec();
        }
        Ok(())
    }

    fn step(&mut self, _: &StepRecord, _: &View<'_>) -> Result<(), ObserverError> {
        Ok(())
    }
}
