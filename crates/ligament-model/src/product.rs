//! Forces of bonds that are linear in the displacements, in one sweep over the bonds that stores no deformation.
//!
//! Iterative solvers need the product of the stiffness with a vector several times per bond breakage; explicit motion needs it in every time
//! step, with the bonds that come near their limits.

use crate::deformation::Deformation;
use crate::element::Element;
use crate::failure::{Criteria, Measure};
use crate::point_sums::BondForces;
use crate::subdomain::Whole;
use crate::sweep::add_forces;
use crate::system::{ElementSystem, UnbrokenBonds};
use crate::thermal::ThermalStrain;

/// Limits near which a sweep finds bonds.
#[derive(Debug, Clone, Copy)]
pub struct NearLimits<'a> {
    /// Criteria whose limits and measures do not depend on the surroundings of the bonds.
    pub criteria: &'a Criteria,
    /// Factor on a measure before it is compared with its limit, 1 or a little more.
    pub factor: f64,
}

/// A test whether deformed bonds are near their limits.
trait LimitTest: Sync {
    /// Whether a bond is near a limit.
    fn is_near(&self, bond: usize, deformation: &impl Deformation) -> bool;
}

/// Bonds without limits.
struct Unlimited;

impl LimitTest for Unlimited {
    #[inline(always)]
    fn is_near(&self, _: usize, _: &impl Deformation) -> bool {
        false
    }
}

/// Bonds with a limit (n_bonds) of their stretch alone, which needs no other strain.
struct StretchLimits<'a> {
    limit: &'a [f64],
    factor: f64,
}

impl LimitTest for StretchLimits<'_> {
    #[inline(always)]
    fn is_near(&self, bond: usize, deformation: &impl Deformation) -> bool {
        deformation.measured().stretch() * self.factor >= self.limit[bond]
    }
}

impl LimitTest for NearLimits<'_> {
    #[inline(always)]
    fn is_near(&self, bond: usize, deformation: &impl Deformation) -> bool {
        let measured = deformation.measured();
        let mut criteria = self.criteria.list.iter();
        criteria.any(|it| {
            let measure = it.measure(bond, &measured);
            measure > 0.0 && measure * self.factor >= it.break_limit(bond)
        })
    }
}

impl<'a> NearLimits<'a> {
    /// The limits (n_bonds) of the only criterion, where that is a brittle one of the stretch.
    fn stretch_limits(&self) -> Option<StretchLimits<'a>> {
        let [only] = &*self.criteria.list else {
            return None;
        };
        let is_of_stretch = only.measure == Measure::Tension && only.after.is_brittle();
        let Self { factor, .. } = *self;
        let limit = &*only.limit;
        is_of_stretch.then_some(StretchLimits { limit, factor })
    }
}

/// Forces of unbroken bonds at motions of the points, and the bonds near their limits.
struct LinearForces<'a, const D: usize, const M: usize, E: Element<D, M>, J> {
    typed: &'a ElementSystem<D, M, E>,
    bonds: UnbrokenBonds<'a>,
    motions: &'a [f64],
    judge: J,
}

impl<const D: usize, const M: usize, E: Element<D, M>, J: LimitTest> BondForces<M>
    for LinearForces<'_, D, M, E, J>
{
    /// Bonds near their limits.
    type Found = Vec<u32>;

    #[inline(always)]
    fn add(&self, bond: usize, near: Option<&mut Vec<u32>>, add: impl FnMut(u32, [f64; M])) {
        let Some(element) = self.typed.remaining_element(self.bonds, bond) else {
            return;
        };
        let deformation = element.deformation(self.motions);
        if let Some(near) = near
            && self.judge.is_near(bond, &deformation)
        {
            near.push(bond as u32);
        }
        element.forces(&deformation, add);
    }
}

impl<const D: usize, const M: usize, E: Element<D, M>> ElementSystem<D, M, E> {
    /// Product of the stiffness of the unbroken bonds with motions, shape (M n_points) both.
    pub(crate) fn multiply(&self, bonds: UnbrokenBonds<'_>, motions: &[f64], forces: &mut [f64]) {
        self.sum_forces(bonds, motions, Unlimited, forces);
    }

    /// Product of the stiffness of the unbroken bonds with motions (M n_points), and the unbroken bonds near their limits, ascending.
    pub(crate) fn forces_near_limits(
        &self,
        bonds: UnbrokenBonds<'_>,
        motions: &[f64],
        limits: NearLimits<'_>,
        forces: &mut [f64],
    ) -> Vec<u32> {
        match (limits.criteria.list.is_empty(), limits.stretch_limits()) {
            (true, _) => self.sum_forces(bonds, motions, Unlimited, forces),
            (false, Some(it)) => self.sum_forces(bonds, motions, it, forces),
            (false, None) => self.sum_forces(bonds, motions, limits, forces),
        }
    }

    /// Sums the forces over the bonds, and returns the bonds near their limits.
    fn sum_forces(
        &self,
        bonds: UnbrokenBonds<'_>,
        motions: &[f64],
        judge: impl LimitTest,
        forces: &mut [f64],
    ) -> Vec<u32> {
        let linear = LinearForces {
            typed: self,
            bonds,
            motions,
            judge,
        };
        let (of_points, _) = forces.as_chunks_mut::<M>();
        let near = self.reach().sum(Whole, &linear, of_points).concat();
        if let Some(far) = &self.system.far {
            add_forces(&far.forces::<M>(of_points.len(), motions), of_points);
        }
        if let Some(terms) = &self.system.volumetric {
            let shares = terms.shares(bonds);
            let changes = terms.volume_changes((motions, M), ThermalStrain::NONE);
            let pressures = terms.pressures(&shares, &terms.dilatations(&shares, &changes));
            add_forces(&terms.forces(of_points.len(), &pressures), of_points);
        }
        near
    }
}
