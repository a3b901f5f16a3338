//! Loads in time, masses, initial velocities and quiet edges of a setup on its points.

use std::sync::Arc;

use ligament_analysis::motion::Dashpot;
use ligament_analysis::{
    Amplitude, Component, Layout, LoadInTime, LoadsInTime, ProportionalLoading, Timed,
};
use ligament_mesh::Portion;
use ligament_model::material::PlaneWaves;
use ligament_model::{LumpedMass, PointCloud, System};

use super::boundary::{ActiveLoads, boundary};
use super::places::Places;
use super::programme::refuse_shared_motions;
use super::restraints::restrained;
use crate::coordinates::narrowed;
use crate::error::{Fault, Field, SetupError};
use crate::setup::{CurveAxis, QuietEdge, Setup};

/// Masses, initial velocities and quiet edges of a motion.
#[derive(Debug, Clone)]
pub struct Inertia {
    /// Masses and rotational inertias of the points.
    pub mass: Arc<LumpedMass>,
    /// Velocities at time zero, shape (n_degrees_of_freedom), m/s and rad/s.
    pub initial_velocity: Arc<[f64]>,
    /// Dashpots of the quiet edges.
    pub dashpots: Arc<[Dashpot]>,
}

/// Loads of a setup as functions of time.
///
/// # Errors
///
/// If two loads prescribe a motion of a point.
pub(super) fn in_time<const D: usize>(
    setup: &Setup,
    system: &dyn System<D>,
) -> Result<LoadsInTime, SetupError> {
    let load = |acting: ActiveLoads| {
        let loading = boundary(setup, &system.cloud, acting)?;
        restrained(setup, system, loading, acting)
    };
    let mut loads: Vec<ProportionalLoading> = (0..setup.loads.len())
        .map(|index| load(ActiveLoads::Load(index)))
        .collect::<Result<_, SetupError>>()?;
    if loads.is_empty() {
        loads.push(load(ActiveLoads::All)?);
    }
    refuse_shared_motions(setup, system.topology().layout, &loads)?;
    let courses = setup.loads.iter().map(|it| LoadInTime {
        amplitude: it.amplitude.clone().unwrap_or_else(Amplitude::constant),
        timed: it.action.timed(),
    });
    let courses: Arc<[LoadInTime]> = courses.collect();
    let control = match setup.curve_axis() {
        CurveAxis::Load(load) => Some(courses[load].clone()),
        CurveAxis::RigidBody(body) => Some(LoadInTime {
            amplitude: setup.rigid_bodies[body].amplitude.clone(),
            timed: Timed::Velocity,
        }),
        CurveAxis::Temperature | CurveAxis::FreeBody(_) | CurveAxis::Nothing => None,
    };
    Ok(LoadsInTime::new(loads.into(), courses, control))
}

/// Masses, initial velocities and quiet edges of a setup, for points with the components of the bonds.
pub(super) fn inertia<const D: usize>(
    setup: &Setup,
    layout: Layout,
    cloud: &PointCloud<D>,
) -> Result<Inertia, SetupError> {
    let materials = setup.materials.iter();
    let densities: Vec<f64> = materials.filter_map(|it| it.material.density).collect();
    let places = Places { setup, cloud };
    let mut dashpots = Vec::new();
    for (index, edge) in setup.quiet.iter().enumerate() {
        let field = Field::element("quiet", index);
        dashpots.extend(places.dashpots(field, edge, &densities)?);
    }
    Ok(Inertia {
        mass: Arc::new(LumpedMass::new(cloud, &densities)),
        initial_velocity: places.initial_velocity(layout)?.into(),
        dashpots: dashpots.into(),
    })
}

impl<const D: usize> Places<'_, D> {
    /// Velocities at time zero, shape (n_degrees_of_freedom).
    fn initial_velocity(&self, layout: Layout) -> Result<Vec<f64>, SetupError> {
        let mut velocity = vec![0.0; layout.n_degrees_of_freedom()];
        for (index, initial) in self.setup.initial_velocities.iter().enumerate() {
            let field = Field::element("initial_velocities", index);
            let given: [f64; D] = narrowed(initial.velocity);
            for point in self.points(field, &initial.place)? {
                for (&component, value) in Component::in_dimensions(D).iter().zip(given) {
                    if let Some(dof) = layout.degree_of_freedom(point, component) {
                        velocity[dof] = value;
                    }
                }
            }
        }
        Ok(velocity)
    }

    /// Dashpots A Z of a quiet edge at its points, with the areas A and outward normals of a pressure and the impedance Z of the materials
    /// at the point; `densities` has the densities of the materials (n_materials), kg/m^3.
    fn dashpots(
        &self,
        field: Field,
        edge: &QuietEdge,
        densities: &[f64],
    ) -> Result<Vec<Dashpot>, SetupError> {
        let field = field.part("place");
        if self.setup.body.points_of(&edge.group).is_none() {
            let fault = super::places::unknown_group(self.setup, &edge.group);
            return Err(field.error(fault));
        }
        let normals = self.setup.body.geometry::<D>().outline_of(&edge.group);
        let normals = normals.map_err(|error| field.error(Fault::OffOutline(error)))?;
        if normals.is_empty() {
            return Err(field.error(Fault::NoQuietOutline));
        }
        let dashpot = |(point, along): (u32, [f64; D])| {
            let impedance = self.impedance(point, along, densities);
            let entry = |row: usize, column: usize| impedance.get(row)?.get(column).copied();
            Dashpot::new(point, |row, column| entry(row, column).unwrap_or(0.0))
        };
        Ok(Portion::at_points(&normals)
            .into_iter()
            .map(dashpot)
            .collect())
    }

    /// Impedance of the materials at a point, in the mean over their shares, for waves along a normal times a length (m), in space an area
    /// (m^2); times the area, N s/m.
    fn impedance(&self, point: u32, along: [f64; D], densities: &[f64]) -> [[f64; D]; D] {
        let length = along.iter().map(|it| it * it).sum::<f64>().sqrt();
        let normal = along.map(|it| it / length);
        let area = length * self.cloud.thickness;
        let mut sum = [[0.0; D]; D];
        let materials = self.setup.materials.iter().zip(densities);
        let shares = self.cloud.shares(point as usize);
        for ((region, &density), share) in materials.zip(shares) {
            let elasticity = &region.material.elasticity;
            let waves = PlaneWaves::new(elasticity, self.setup.plane(), density, normal);
            let impedance = waves.map_or([[0.0; D]; D], |it| it.impedance());
            for (sum, row) in sum.iter_mut().zip(impedance) {
                for (sum, value) in sum.iter_mut().zip(row) {
                    *sum += share * area * value;
                }
            }
        }
        sum
    }
}
