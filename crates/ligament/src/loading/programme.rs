//! Stages of a setup as a load program.

use std::sync::Arc;

use ligament_analysis::{
    Component, Layout, LoadCourse, MotionControl, Part, PartControl, Probe, Programme,
    ProportionalLoading, StagedLoading,
};
use ligament_model::System;

use super::boundary::{ActiveLoads, boundary};
use super::restraints::restrained;
use crate::error::{Fault, Field, SetupError};
use crate::setup::{self, Analysis, Quantity, Setup, Stage};

/// Shares of a stage that differ by less than this are equal.
const SAME: f64 = 1e-9;

impl Setup {
    /// Number of solutions of the loading: load steps, ends of the parts of stages, or rows of a motion; `None` along the exact path. The first breakage may
    /// add load steps.
    pub fn n_steps(&self) -> Option<usize> {
        let is_staged = !self.stages.is_empty();
        match &self.analysis {
            Analysis::Event(_) => None,
            Analysis::Stepped(settings) if !is_staged => Some(settings.load_factors.len()),
            Analysis::Stepped(_) => Some(parts(self).iter().map(|it| it.steps).sum()),
            Analysis::Elastic { .. } if is_staged => Some(parts(self).len()),
            Analysis::Elastic { .. } | Analysis::Modal(_) => Some(1),
            Analysis::Motion(settings) => Some(settings.rows),
        }
    }
}

/// Load program of a setup with stages, each load with a factor of its own, at the first part; `None` without stages.
///
/// # Errors
///
/// If two loads prescribe a motion of a point.
pub(super) fn staged<const D: usize>(
    setup: &Setup,
    system: &dyn System<D>,
    probes: &[Probe],
) -> Result<Option<StagedLoading>, SetupError> {
    if setup.stages.is_empty() {
        return Ok(None);
    }
    let names = setup.factor_names();
    let temperature = (names.len() > setup.loads.len()).then_some(setup.loads.len());
    let of_loads = (0..setup.loads.len()).map(ActiveLoads::Load);
    let of_temperature = temperature.map(|_| ActiveLoads::Temperature);
    let loads: Vec<ProportionalLoading> = (of_loads.chain(of_temperature))
        .map(|acting| {
            let loading = boundary(setup, &system.cloud, acting)?;
            restrained(setup, system, loading, acting)
        })
        .collect::<Result<_, SetupError>>()?;
    refuse_shared_motions(setup, system.topology().layout, &loads)?;
    let programme = Programme {
        control: setup.curve_load().or(temperature).unwrap_or(0),
        temperature,
        stages: setup.stages.iter().map(|it| it.name.clone()).collect(),
        names,
        parts: controlled_parts(setup, system.topology().layout, probes),
    };
    let start = vec![0.0; programme.names.len()];
    let course = LoadCourse::new(Arc::new(programme), 0, &start);
    Ok(Some(StagedLoading::new(loads.into(), course)))
}

/// The parts of all stages with their controls.
fn controlled_parts(setup: &Setup, layout: Layout, probes: &[Probe]) -> Vec<Part> {
    let mut parts = parts(setup);
    for part in &mut parts {
        let control = setup.stages[part.stage].control.as_ref();
        part.control = control.map(|it| match &it.quantity {
            Quantity::Probes(of) => PartControl::Motion(motion(of, it.to, layout, probes)),
            Quantity::DissipatedEnergy => PartControl::DissipatedEnergy { end: it.to },
        });
    }
    parts
}

/// Weighted sum of the motions of probes, with its value at the end of the stage.
fn motion(of: &[(String, f64)], end: f64, layout: Layout, probes: &[Probe]) -> MotionControl {
    let of_probe = |(name, factor): &(String, f64)| {
        let probe = probes.iter().find(|it| it.name == *name);
        let weights = probe.and_then(|it| it.reading.weights(layout));
        let scaled = weights.into_iter().flatten();
        let factor = *factor;
        scaled.map(move |(dof, weight)| (dof, factor * weight))
    };
    MotionControl {
        weights: of.iter().flat_map(of_probe).collect(),
        end,
    }
}

/// The parts of all stages without controls.
fn parts(setup: &Setup) -> Vec<Part> {
    let names = setup.factor_names();
    let mut parts = Vec::new();
    let mut factors = vec![0.0; names.len()];
    for (index, stage) in setup.stages.iter().enumerate() {
        add_parts(index, stage, &names, &mut factors, &mut parts);
    }
    parts
}

/// Adds the parts of a stage, and sets the load factors to their values at its end.
fn add_parts(
    index: usize,
    stage: &Stage,
    names: &[String],
    factors: &mut [f64],
    parts: &mut Vec<Part>,
) {
    let courses = stage.loads.iter();
    let shares = courses.flat_map(|(_, course)| course.points.iter().map(|point| point[0]));
    let mut ends: Vec<f64> = shares.filter(|share| *share < 1.0 - SAME).collect();
    ends.sort_unstable_by(f64::total_cmp);
    ends.dedup_by(|one, other| *one - *other < SAME);
    ends.push(1.0);
    let course = |name: &str| -> Option<&setup::Course> {
        let mut courses = stage.loads.iter();
        courses.find(|(of, _)| of == name).map(|(_, course)| course)
    };
    let steps = stage.steps.unwrap_or(1) as f64;
    let mut begins = 0.0;
    for &share in &ends {
        let at_end = |(name, start): (&String, &f64)| Some(course(name)?.at(share, *start));
        parts.push(Part {
            stage: index,
            span: (begins, share),
            ends: names.iter().zip(factors.iter()).map(at_end).collect(),
            steps: ((steps * (share - begins)).round() as usize).max(1),
            control: None,
        });
        begins = share;
    }
    for (name, factor) in names.iter().zip(factors) {
        *factor = course(name).map_or(*factor, |it| it.at(1.0, *factor));
    }
}

/// Refuses degrees of freedom that two loads move, because they would follow two factors.
pub(super) fn refuse_shared_motions(
    setup: &Setup,
    layout: Layout,
    loads: &[ProportionalLoading],
) -> Result<(), SetupError> {
    for dof in 0..layout.n_degrees_of_freedom() {
        let moves = |load: &usize| loads[*load].prescribed[dof].is_some_and(|it| it != 0.0);
        let mut movers = (0..loads.len()).filter(moves);
        if let (Some(first), Some(second)) = (movers.next(), movers.next()) {
            let component: Component = layout.component(dof);
            let fault = Fault::MovedTwice {
                component: component.name(),
                place: setup.body.label(layout.point(dof)),
                other: setup.loads[first].name.clone(),
            };
            return Err(Field::element("loads", second).part("action").error(fault));
        }
    }
    Ok(())
}
