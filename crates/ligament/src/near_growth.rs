//! Growth of a near field: where the stress of elements reaches a share of the strength, bonds replace them and the run begins again.

use ligament_analysis::history::{
    Ahead, BreakRecord, Moment, ObserverError, Onward, StepRecord, View,
};
use ligament_analysis::largest_utilisation::LargestUtilisations;
use ligament_analysis::material_stress::MaterialStress;
use ligament_analysis::{Message, Observer, Termination};
use ligament_model::scatter::Scattered;
use ligament_model::stress::principal;
use ligament_model::{Material, PointCloud};
use thiserror::Error;

use crate::error::{Error, Fault, Field};
use crate::extent::Extent;
use crate::loading::REACH;
use crate::model::Model;
use crate::parts::Parts;
use crate::setup::{Place, Setup};
use crate::system::over_dimension;

/// Distance by which a near field grows over its size, the root of its area or the cubic root of its volume: a growing crack reaches the
/// border only a few times.
const GROWTH: f64 = 0.5;

/// Largest stresses of the elements of a far field.
#[derive(Debug, Clone, PartialEq)]
pub struct StressLimits {
    /// Largest principal stress at each point, shape (n_points), Pa; infinite where elements bear any stress.
    tension: Vec<f64>,
    /// Negative of the smallest principal stress at each point, shape (n_points), Pa.
    compression: Vec<f64>,
}

/// Points of elements whose stress reached its limit.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("the stress of elements reached its share of the strength at {} points", .points.len())]
struct Overstressed {
    points: Vec<u32>,
}

/// Places by which a near field grows.
#[derive(Debug, Clone, PartialEq, Error)]
#[error(
    "the near field has to grow at {points} points of elements, whose stress reached its share of the strength"
)]
pub struct Growth {
    /// Number of points of elements with that stress.
    pub points: usize,
    /// Boxes around them.
    pub places: Vec<Place>,
    /// Dimensions of the body.
    pub dimensions: usize,
}

impl Setup {
    /// Adds the places of a growth to the near field.
    pub fn grow(&mut self, growth: Growth) {
        if let Some(far_field) = &mut self.far_field {
            far_field.near.extend(growth.places);
        }
    }
}

impl Model {
    /// An observer that passes everything on, and ends a run with an error where elements of the far field reach their share of the strength.
    pub fn guarded<'a>(&self, observer: &'a mut dyn Observer) -> Guarded<'a> {
        Guarded {
            observer,
            limits: self.stress_limits(),
            utilisations: None,
        }
    }

    /// The growth of the near field that an error of a [guarded](Self::guarded) run demands.
    ///
    /// # Errors
    ///
    /// The error itself, if it is another one, and if the near field cannot grow there.
    pub fn growth(&self, error: Error) -> Result<Growth, Error> {
        let found = match &error {
            Error::Equations(ligament_analysis::SetupError::Observer(ObserverError(it))) => {
                it.downcast_ref::<Overstressed>()
            }
            _ => None,
        };
        let Some(Overstressed { points }) = found else {
            return Err(error);
        };
        let places =
            over_dimension!(&self.system, system => self.places_around(&system.cloud, points));
        let before = self.setup.far_field.iter().flat_map(|it| &it.near);
        let mut before = before.filter_map(Extent::of_place);
        if before.any(|it| places.iter().any(|place| it.contains(place))) {
            let reason = "elements that the border of the near field leaves out reach their share of the strength: choose its places by hand";
            let fault = Fault::Contradiction(reason.into());
            return Err(Field::whole("far_field").part("near").error(fault).into());
        }
        Ok(Growth {
            points: points.len(),
            places: places.into_iter().map(Extent::into_place).collect(),
            dimensions: self.setup.body.dimensions(),
        })
    }

    /// Limits of the stresses of elements; `None` where the near field does not grow.
    fn stress_limits(&self) -> Option<StressLimits> {
        let share = self.setup.far_field.as_ref()?.strength_share?;
        over_dimension!(&self.system, system => {
            let (cloud, far) = (&system.cloud, system.far.as_ref()?);
            let limit = |strength: fn(&Material) -> Option<f64>| {
                let strengths = self.setup.materials.iter().map(|it| strength(&it.material));
                let strengths: Vec<f64> = strengths.map(|it| it.unwrap_or(f64::INFINITY)).collect();
                let of_point = |point: usize| {
                    // The weakest material of the cells around the point.
                    let around = strengths.iter().zip(cloud.shares(point));
                    let weakest = around.filter(|(_, part)| **part > 0.0).map(|it| *it.0);
                    let may_break = far.volume(point as u32) > 0.0 && !self.fixed.no_fail[point];
                    match may_break {
                        true => share * self.strength_factor(point) * weakest.fold(f64::INFINITY, f64::min),
                        false => f64::INFINITY,
                    }
                };
                (0..cloud.len()).map(of_point).collect()
            };
            Some(StressLimits {
                tension: limit(|it| it.tensile_strength),
                compression: limit(|it| it.compressive_strength),
            })
        })
    }

    /// Random factor of the strength of a point.
    fn strength_factor(&self, point: usize) -> f64 {
        let mut factors = self.fixed.scatter.iter();
        let strength = factors.find(|it| it.of == Scattered::Strength);
        strength.map_or(1.0, |it| it.at_points[point])
    }

    /// Boxes around the connected parts of some points (ascending), which reach beyond them.
    fn places_around<const D: usize>(&self, cloud: &PointCloud<D>, points: &[u32]) -> Vec<Extent> {
        let body = self.body();
        let corners = body.corners();
        let is_one = |point: &u32| points.binary_search(point).is_ok();
        let pairs = corners.iter().flat_map(|cell| {
            let mut inside = cell.iter().copied().filter(is_one);
            let first = inside.next();
            inside.filter_map(move |it| Some([first?, it]))
        });
        let parts = Parts::new(&cloud.subdomain, pairs);
        let beyond = GROWTH * self.near_volume(cloud).powf(1.0 / D as f64);
        let mut numbered: Vec<(u32, u32)> = points.iter().map(|&it| (parts.part(it), it)).collect();
        numbered.sort_unstable();
        let of_part = |part: &[(u32, u32)]| {
            let horizons = part.iter().map(|it| self.fixed.horizon[it.1 as usize]);
            let reach = REACH * horizons.fold(0.0, f64::max);
            let positions = part.iter().map(|it| body.position(it.1));
            Extent::around(positions, reach.max(beyond))
        };
        let boxes = numbered.chunk_by(|one, other| one.0 == other.0);
        Extent::joined(boxes.map(of_part).collect())
    }

    /// Volume of the cells with bonds, in the plane over the thickness.
    fn near_volume<const D: usize>(&self, cloud: &PointCloud<D>) -> f64 {
        let elements = over_dimension!(&self.system, system => {
            let far = system.far.as_ref();
            let volumes = (0..cloud.len() as u32).map(|it| far.map_or(0.0, |far| far.volume(it)));
            volumes.sum::<f64>()
        });
        (cloud.volumes.iter().sum::<f64>() - elements).max(0.0) / cloud.thickness
    }
}

impl StressLimits {
    /// Points at which the stress reaches its limit, ascending.
    fn reached(&self, view: &View<'_>) -> Vec<u32> {
        let stresses = view.solution().material_stresses(MaterialStress::Effective);
        let of_points = stresses.values.chunks_exact(stresses.names.len());
        let reaches = |(point, stress): (usize, &[f64])| {
            // A point without enough neighbours to show its strain has no stress.
            if stress[0].is_nan() {
                return false;
            }
            let values = principal::values(stress);
            let (largest, smallest) = (values[0], values[values.len() - 1]);
            largest >= self.tension[point] || -smallest >= self.compression[point]
        };
        let numbered = of_points.enumerate().filter(|it| reaches(*it));
        numbered.map(|(point, _)| point as u32).collect()
    }
}

/// An observer that ends a run where elements of the far field reach their share of the strength.
pub struct Guarded<'a> {
    observer: &'a mut dyn Observer,
    limits: Option<StressLimits>,
    /// Largest utilisations of the bonds, where a refinement asks for them.
    pub utilisations: Option<LargestUtilisations>,
}

impl Observer for Guarded<'_> {
    fn begins(&mut self, ahead: Ahead) {
        self.observer.begins(ahead);
    }

    fn iteration(
        &mut self,
        iteration: usize,
        residual: f64,
        stored_energy: f64,
    ) -> Result<(), ObserverError> {
        self.observer.iteration(iteration, residual, stored_energy)
    }

    fn round(
        &mut self,
        step: usize,
        round: usize,
        load_factor: f64,
        broken: usize,
    ) -> Result<(), ObserverError> {
        self.observer.round(step, round, load_factor, broken)
    }

    fn broke(&mut self, records: &[BreakRecord]) -> Result<(), ObserverError> {
        self.observer.broke(records)
    }

    fn message(&mut self, message: Message) -> Result<(), ObserverError> {
        self.observer.message(message)
    }

    fn asks(&mut self, end: Option<&Termination>) -> Result<bool, ObserverError> {
        self.observer.asks(end)
    }

    fn moment(&mut self, moment: &Moment<'_>) -> Result<Onward, ObserverError> {
        self.observer.moment(moment)
    }

    fn looks(&self, step: usize) -> bool {
        self.observer.looks(step)
    }

    fn looks_between_breakages(
        &mut self,
        step: usize,
        broken: usize,
    ) -> Result<bool, ObserverError> {
        self.observer.looks_between_breakages(step, broken)
    }

    fn between_breakages(
        &mut self,
        record: &StepRecord,
        view: &View<'_>,
    ) -> Result<(), ObserverError> {
        self.observer.between_breakages(record, view)
    }

    fn step(&mut self, record: &StepRecord, view: &View<'_>) -> Result<(), ObserverError> {
        if let Some(limits) = self.limits.as_ref().filter(|_| view.is_whole) {
            let points = limits.reached(view);
            if !points.is_empty() {
                return Err(ObserverError(Box::new(Overstressed { points })));
            }
        }
        if let Some(utilisations) = self.utilisations.as_mut().filter(|_| view.is_whole) {
            utilisations.update(record.step, view);
        }
        self.observer.step(record, view)
    }
}
