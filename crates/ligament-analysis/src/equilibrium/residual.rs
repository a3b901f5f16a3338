//! Relative residual forces of an iterate.
//!
//! The residual at each degree of freedom is relative to the largest force at a point of the body, but at most to its own stiffness
//! times the largest deformation. Relative to the stiffest point alone, two nearly coincident points would hide the residuals of
//! all others.

use ligament_model::Bonds;
use ligament_model::interface::PointStiffness;
use ligament_model::subdomain::Subdomain;
use serde::{Deserialize, Serialize};

use crate::restraints::Restraints;
use crate::unknowns::Layout;

/// Residual, relative to the forces that may act at a point, below which a state is in equilibrium.
///
/// With linear bonds one solution reaches it; the paper's second iterate, which would only confirm it, is skipped.
pub(super) const RESIDUAL_TOLERANCE: f64 = 1e-10;

/// Rounding of the internal forces of a body that moves freely, relative to the stiffness of a point times the largest
/// displacement; the only scale of the residual and the energy in a body that fell apart.
pub(crate) const ROUNDING: f64 = 1e-14;

/// Rounding of a gap between surfaces, relative to the largest of the coordinates that it is computed from: the rounding of some five operations.
pub(super) const OF_GAPS: f64 = 1e-15;

/// Share of the largest force so far below which forces are its rounding, to within [`RESIDUAL_TOLERANCE`].
const UNLOADED: f64 = 1e-5;

/// Force at an added support, relative to the forces that may act at a point, above which the support carries a load.
///
/// Self-balanced loads are accepted to the same tolerance, and the rounding of a solution is far below it.
const CARRIED: f64 = 1e-6;

/// Stiffnesses that scale the forces at the degrees of freedom, shape (n_degrees_of_freedom), N/m, and N for moments; 0 where no
/// bond ends.
#[derive(Debug, Clone)]
pub(super) struct LocalStiffness {
    layout: Layout,
    values: Vec<f64>,
}

/// Largest of some forces, and largest ratio of these forces to the stiffness of their points.
#[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
struct Extent {
    /// Force, N; for moments N m.
    force: f64,
    /// Deformation, m.
    deformation: f64,
}

/// Extents of forces and of moments.
#[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
pub(super) struct Extents([Extent; 2]);

/// Forces to which a residual is relative.
#[derive(Debug, Clone, Copy)]
pub(super) struct Scales<'a> {
    stiffness: &'a LocalStiffness,
    extents: Extents,
    /// Displacement whose forces are due to rounding, m.
    rounding: f64,
    /// Force and moment of contacts over the gap that causes it, at the degrees of freedom, N/m and N; empty without contacts.
    of_contacts: &'a [f64],
    /// Gap whose forces are due to rounding, m.
    gap: f64,
}

/// Lengths that are rounded in a state, m.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Rounded {
    /// Largest displacement of a point along an axis.
    pub(super) displacement: f64,
    /// Largest coordinate that gaps between surfaces are computed from, m; zero without contacts.
    pub(super) coordinate: f64,
}

/// The largest relative residual of an iterate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Residual {
    /// |external - internal force| over the force that may act there; infinite where the force is not finite.
    pub(super) relative: f64,
    /// Degree of freedom of the largest residual.
    pub(super) degree_of_freedom: u32,
    /// Degree of freedom of the added support with the largest force above the tolerance, and that force, N or N m.
    pub(super) carried: Option<(u32, f64)>,
}

impl LocalStiffness {
    /// Stiffnesses of the points of a bond system.
    pub(super) fn new(system: &dyn Bonds) -> Self {
        let layout = system.layout;
        let of_point = |PointStiffness { force, moment }: PointStiffness| {
            let components = layout.components.iter();
            components.map(move |it| if it.is_rotation() { moment } else { force })
        };
        let points = system.point_stiffness().into_iter();
        Self {
            layout,
            values: points.flat_map(of_point).collect(),
        }
    }

    /// Adds the stiffnesses of restraints.
    pub(super) fn restrained_by(mut self, restraints: &Restraints) -> Self {
        restraints.add_diagonal(&mut self.values);
        self
    }

    /// Layout of the degrees of freedom.
    pub(super) fn layout(&self) -> Layout {
        self.layout
    }

    /// Largest stiffness against displacements, N/m.
    pub(super) fn largest(&self) -> f64 {
        let of_displacements = self.layout.displacements(&self.values);
        of_displacements.fold(0.0, f64::max)
    }

    /// Stiffness at a degree of freedom, N/m, and N for moments.
    pub(super) fn at(&self, dof: usize) -> f64 {
        self.values[dof]
    }

    /// Forces due to the rounding of a displacement (m), shape (n_degrees_of_freedom).
    pub(super) fn rounding(&self, displacement: f64) -> Vec<f64> {
        let stiffnesses = self.values.iter();
        stiffnesses.map(|it| ROUNDING * displacement * it).collect()
    }

    /// Extents of forces (n_degrees_of_freedom), N and N m.
    pub(super) fn extents(&self, forces: &[f64]) -> Extents {
        let mut extents = Extents::default();
        let of_points = forces.chunks(self.layout.components.len());
        for (forces, stiffness) in of_points.zip(self.values.chunks(self.layout.components.len())) {
            for ((component, force), stiffness) in
                self.layout.components.iter().zip(forces).zip(stiffness)
            {
                extents.0[usize::from(component.is_rotation())].widen(force.abs(), *stiffness);
            }
        }
        extents
    }

    /// Scales of a state with the given extents, under loads (by degree of freedom, N and N m), where `largest` are the extents so far.
    pub(super) fn scales(
        &self,
        extents: Extents,
        largest: Extents,
        loads: impl Iterator<Item = (u32, f64)>,
        rounded: Rounded,
    ) -> Scales<'_> {
        let mut extents = extents.or(largest.times(UNLOADED));
        // A load that no bond carries yet would otherwise have a scale of zero.
        for (dof, load) in loads {
            let dof = dof as usize;
            let kind = usize::from(self.layout.component(dof).is_rotation());
            extents.0[kind].widen(load.abs(), self.values[dof]);
        }
        Scales {
            stiffness: self,
            extents,
            rounding: ROUNDING / RESIDUAL_TOLERANCE * rounded.displacement,
            of_contacts: &[],
            gap: OF_GAPS / RESIDUAL_TOLERANCE * rounded.coordinate,
        }
    }
}

impl Extent {
    fn widen(&mut self, force: f64, stiffness: f64) {
        self.force = self.force.max(force);
        if stiffness > 0.0 {
            self.deformation = self.deformation.max(force / stiffness);
        }
    }
}

impl Extents {
    /// Component-wise maximum of both.
    pub(super) fn or(self, other: Self) -> Self {
        Self([0, 1].map(|kind| {
            let (one, other) = (self.0[kind], other.0[kind]);
            Extent {
                force: one.force.max(other.force),
                deformation: one.deformation.max(other.deformation),
            }
        }))
    }

    /// The extents with forces limited to `force`, N, and moments limited to `force` times `length`, m.
    pub(super) fn at_most(self, force: f64, length: f64) -> Self {
        let [mut forces, mut moments] = self.0;
        forces.force = forces.force.min(force);
        moments.force = moments.force.min(force * length);
        Self([forces, moments])
    }

    /// Maximum over all processes.
    pub(super) fn of_all(self, subdomain: &Subdomain) -> Self {
        let mut all = [0.0; 4];
        for (both, it) in all.as_chunks_mut().0.iter_mut().zip(self.0) {
            *both = [it.force, it.deformation];
        }
        subdomain.all_reduce_max(&mut all);
        let [force, deformation, moment, turn] = all;
        let extent = |force, deformation| Extent { force, deformation };
        Self([extent(force, deformation), extent(moment, turn)])
    }

    /// Largest force, N.
    pub(super) fn force(self) -> f64 {
        self.0[0].force
    }

    /// Largest force due to the rounding of these extents in an unloaded body, N.
    pub(super) fn unloaded_force(self) -> f64 {
        UNLOADED * self.0[0].force
    }

    fn times(self, factor: f64) -> Self {
        Self(self.0.map(|it| Extent {
            force: factor * it.force,
            deformation: factor * it.deformation,
        }))
    }
}

impl<'a> Scales<'a> {
    /// The scales with the forces and moments of contacts over their gaps at the degrees of freedom, N/m and N.
    pub(super) fn with_contacts(self, of_contacts: &'a [f64]) -> Self {
        Self {
            of_contacts,
            ..self
        }
    }

    /// Largest force that may act at a degree of freedom, N or N m.
    #[inline]
    pub(super) fn at(self, dof: usize) -> f64 {
        let of_gaps = self.of_contacts.get(dof).map_or(0.0, |it| it * self.gap);
        self.of_bonds(dof).max(of_gaps)
    }

    #[inline]
    fn of_bonds(self, dof: usize) -> f64 {
        let stiffness = self.stiffness.values[dof];
        let kind = usize::from(self.stiffness.layout.component(dof).is_rotation());
        let Extent { force, deformation } = self.extents.0[kind];
        if stiffness > 0.0 {
            force
                .min(stiffness * deformation)
                .max(stiffness * self.rounding)
        } else {
            force
        }
    }

    /// Largest residual over all processes, by degree of freedom of the body, from the residual at owned points; the first of equal ones.
    pub(super) fn residual_of_all(self, own: Residual, subdomain: &Subdomain) -> Residual {
        if subdomain.is_whole() {
            return own;
        }
        let (dof, force) = own.carried.unwrap_or_default();
        let carried = own
            .carried
            .map_or(0.0, |_| force.abs() / self.at(dof as usize));
        let n_components = self.stiffness.layout.components.len();
        let in_body = |dof: u32| subdomain.index_in_body(dof as usize, n_components) as f64;
        let largest = [-own.relative, in_body(own.degree_of_freedom)];
        let held = [-carried, in_body(dof), force];
        let [relative, at] = subdomain.all_reduce_min(Some(largest)).unwrap_or(largest);
        let [most, dof, force] = subdomain.all_reduce_min(Some(held)).unwrap_or(held);
        Residual {
            relative: -relative,
            degree_of_freedom: at as u32,
            carried: (most < 0.0).then_some((dof as u32, force)),
        }
    }

    /// Largest relative residual, and largest relative force at added supports, of external minus internal forces (by degree of
    /// freedom, N and N m).
    pub(super) fn residual(
        self,
        out_of_balance: impl Iterator<Item = (u32, f64)>,
        is_held: impl Fn(usize) -> bool,
    ) -> Residual {
        let mut residual = Residual {
            relative: 0.0,
            degree_of_freedom: 0,
            carried: None,
        };
        let mut most_carried = CARRIED;
        for (dof, force) in out_of_balance {
            let size = force.abs();
            let scale = self.at(dof as usize);
            // A division takes as long as all other operations here; it is skipped where the result cannot be the largest.
            let in_question = residual.relative.min(most_carried);
            if size == 0.0 || size < 0.999 * in_question * scale {
                continue;
            }
            // `f64::max` would ignore a NaN, and with it a failed solution.
            let relative = if size.is_finite() {
                size / scale
            } else {
                f64::INFINITY
            };
            if is_held(dof as usize) {
                if relative > most_carried {
                    most_carried = relative;
                    residual.carried = Some((dof, force));
                }
            } else if relative > residual.relative {
                residual.relative = relative;
                residual.degree_of_freedom = dof;
            }
        }
        residual
    }
}
