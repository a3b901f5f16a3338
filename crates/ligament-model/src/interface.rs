//! Interface between the mechanics of bonds and the equations to be solved.
//!
//! A sweep over all bonds is one call through the interface; the loop inside has the element as a type parameter.

use std::ops::Deref;

use crate::bonds::BondSet;
use crate::change::ChangedElements;
use crate::contact::{ClosedPair, ContactPair, Overlap};
use crate::deformation::Deformations;
use crate::element::{BondDeformation, Rigidities, StiffnessFactors, Term};
use crate::failure::hooke::{Moduli, StressAcross};
use crate::failure::starting::Starting;
use crate::ghosts::Ghosts;
use crate::layout::Component;
use crate::parallel;
use crate::product::NearLimits;
use crate::rigid_motions::FreeMotion;
use crate::stress::carried::StrainReading;
use crate::stress::domain_integral::DomainIntegral;
use crate::stress::growing_tip::GrowingTip;
use crate::stress::point_strain::Motion;
use crate::stress::stored::StoredMotions;
use crate::subdomain::Subdomain;
use crate::sweep::BondSweep;
use crate::system::UnbrokenBonds;
use crate::thermal::ThermalStrain;
use crate::topology::Topology;
use crate::volumetric::CellPatch;

/// The bonds of a body, as equations use them. Points, bonds and degrees of freedom are numbers; coordinates and the number of dimensions
/// stay behind this interface. Bonds dereference to their [`Topology`].
///
/// Where a body is divided between processes, each has the bonds at its owned points, and arrays of shape (n_bonds) are over those. Results
/// for the whole body, and forces at points, are the same on all processes, and their calls are collective: point stiffnesses, rigid
/// motions, forces and energies of a sweep, overlaps. Energy densities and stresses of points are valid at owned points, and their calls
/// are not collective.
pub trait Bonds: std::fmt::Debug + Send + Sync {
    /// Points, bonds and families.
    fn topology(&self) -> &Topology;

    /// Rigidities of the bonds.
    fn rigidities(&self) -> &Rigidities;

    /// Diagonal of the box around all points of the body, m; collective.
    fn extent(&self) -> f64;

    /// Sorts points so that the first half lies before the second along the longest side of their box; ties are broken by number.
    fn halve(&self, points: &mut [u32]);

    /// Stiffness of each point with all its bonds, shape (n_points).
    fn point_stiffness(&self) -> Vec<PointStiffness>;

    /// Degrees of freedom of the body to fix so that no rigid motion of a connected part that costs no energy is free, beyond the fixed ones;
    /// the most effective first, ties by number in the file. Only those for which `can_hold` returns true are chosen. `points` are the owned
    /// points of the part; collective.
    fn holds(
        &self,
        points: &[u32],
        is_fixed: &dyn Fn(usize) -> bool,
        can_hold: &dyn Fn(usize) -> bool,
    ) -> Vec<usize>;

    /// Displacements and rotations of a connected part in each of its rigid motions that costs no energy and is not prevented by fixed degrees
    /// of freedom. `points` are the owned points of the part; collective.
    fn free_shapes(
        &self,
        points: &[u32],
        is_fixed: &dyn Fn(usize) -> bool,
        can_hold: &dyn Fn(usize) -> bool,
    ) -> FreeShapes;

    /// Rigid motions of a connected part that cost no energy and are not prevented by fixed degrees of freedom, with the work of given forces
    /// on them. `points` are the owned points of the part; collective.
    fn free_motions(
        &self,
        points: &[u32],
        is_fixed: &dyn Fn(usize) -> bool,
        force: &dyn Fn(usize) -> f64,
    ) -> Vec<FreeMotion>;

    /// Displacements and rotations of some points in each rigid motion, whether it costs energy or not, shape (n_motions,
    /// n_degrees_of_freedom of the points): unit translations along the axes, then rotations about the middle of the points by one over
    /// their radius, which include the rotations of the points.
    fn rigid_shapes(&self, points: &[u32]) -> Vec<Vec<f64>>;

    /// The [rigid shapes](Self::rigid_shapes) of the whole body at the points of this process; collective.
    fn rigid_shapes_of_body(&self) -> Vec<Vec<f64>>;

    /// Rigid motions of the whole body about its centre of mass, for the masses of the points (n_points), kg.
    fn motions_about_centre(&self, masses: &[f64]) -> CentralMotions;

    /// Motions of uniform strain: displacements u_i = x_j, u_j = x_i of all points for each pair of axes i <= j, each of shape
    /// (n_degrees_of_freedom).
    fn motions_of_strain(&self) -> Vec<Vec<f64>>;

    /// Deformation of every bond less its thermal deformation, broken or not, shape (n_bonds).
    fn deformations(
        &self,
        intact: &[bool],
        displacement: &[f64],
        expansion: ThermalStrain<'_>,
    ) -> Deformations;

    /// Deformations that criteria measure, of some bonds in their order, for displacements (n_degrees_of_freedom) without thermal strains.
    fn measured(
        &self,
        intact: &[bool],
        displacement: &[f64],
        bonds: &[u32],
    ) -> Vec<BondDeformation>;

    /// Forces and energy of bonds with given deformations (n_bonds).
    ///
    /// The result does not depend on the number of threads: the bonds of a part are summed by one thread in their order, and the parts one
    /// after another.
    fn forces(
        &self,
        bonds: UnbrokenBonds<'_>,
        deformations: Deformations,
        expansion: ThermalStrain<'_>,
    ) -> BondSweep;

    /// Stiffness of a bond with its remaining factors, as a sum of terms.
    fn terms(&self, intact: &[bool], bond: usize, remaining: &StiffnessFactors) -> Vec<Term>;

    /// Adds the blocks of the stiffness in the columns of a point at the rows of its `lower` coupled points (ascending) and of itself, shape
    /// (n_lower + 1, n_components, n_components).
    fn add_blocks(&self, bonds: UnbrokenBonds<'_>, point: u32, lower: &[u32], blocks: &mut [f64]);

    /// The product K u of the stiffness of the unbroken bonds with motions u, shape (n_degrees_of_freedom) both; for bonds whose forces are
    /// linear in the displacements. The result overwrites `forces`.
    ///
    /// The result does not depend on the number of threads, as in [`Bonds::forces`].
    fn multiply(&self, bonds: UnbrokenBonds<'_>, motions: &[f64], forces: &mut [f64]);

    /// The product K u, as [`Bonds::multiply`], and the unbroken bonds near their limits, ascending, in one sweep. The forces overwrite
    /// `forces`.
    fn forces_near_limits(
        &self,
        bonds: UnbrokenBonds<'_>,
        motions: &[f64],
        limits: NearLimits<'_>,
        forces: &mut [f64],
    ) -> Vec<u32>;

    /// Adds the derivatives of the forces by the displacements: row, column, value.
    fn add_derivatives(&self, intact: &[bool], add: &mut dyn FnMut(usize, usize, f64));

    /// Elements that change when some of the unbroken bonds `left` break, at displacements (n_degrees_of_freedom).
    fn changed(
        &self,
        left: UnbrokenBonds<'_>,
        displacement: &[f64],
        expansion: ThermalStrain<'_>,
        bonds: &[u32],
    ) -> Box<dyn ChangedElements>;

    /// Energy 1/2 u^T K u', J, of an unbroken bond with its remaining stiffness, for two deformations of all bonds.
    fn mutual_energy(
        &self,
        intact: &[bool],
        bond: usize,
        remaining: &StiffnessFactors,
        deformations: [&Deformations; 2],
    ) -> f64;

    /// The patches of cells with a volumetric stiffness while no bond is broken; none without such cells.
    fn cell_patches(&self) -> Vec<CellPatch>;

    /// Force of the cells on a point, N, one component for each axis, for displacements (n_degrees_of_freedom) without thermal strains; empty
    /// where cells have no stiffness.
    fn force_of_cells(&self, intact: &[bool], displacement: &[f64], point: u32) -> Vec<f64>;

    /// Points whose motions determine what a breakage of bonds changes, ascending: the ends of the bonds, and the points of the patches with a
    /// cell along one of them.
    fn points_of_breakage(&self, bonds: &[u32]) -> Vec<u32>;

    /// Energy 1/2 u^T (K - K') u', J, of the cells with the stiffnesses K and K' for bonds with the remaining stiffness `before` and `after` (n_bonds), for two deformations of all bonds; 0 where cells have no stiffness.
    fn energy_lost_by_cells(
        &self,
        intact: &[bool],
        remaining: [&[StiffnessFactors]; 2],
        deformations: [&Deformations; 2],
    ) -> f64;

    /// Energy 1/2 u^T K u, J, of an unbroken bond with its remaining stiffness, from its deformation as criteria measure it.
    fn stored_energy(
        &self,
        intact: &[bool],
        bond: usize,
        remaining: &StiffnessFactors,
        measured: &BondDeformation,
    ) -> f64;

    /// Strain energy density of a point, J/m^3: its part of the energy of its bonds over its volume.
    fn energy_density(
        &self,
        bonds: UnbrokenBonds<'_>,
        deformations: &Deformations,
        point: u32,
    ) -> f64;

    /// Components of the virial stress of a point, Pa.
    fn stress(&self, bonds: UnbrokenBonds<'_>, deformations: &Deformations, point: u32)
    -> Vec<f64>;

    /// Stresses of all points by one reading of the forces of the bonds.
    fn stresses(
        &self,
        reading: StressReading,
        bonds: UnbrokenBonds<'_>,
        deformations: &Deformations,
    ) -> Stresses;

    /// Stresses of all points by the stiffnesses of their materials, Pa; not a number where the bonds of a point do not span the space.
    /// Collective.
    fn stresses_by_material(&self, reading: StrainReading<'_>) -> Stresses;

    /// Components of the stress of one point by the stiffness of its material, Pa; not a number where its bonds do not span the space.
    fn stress_by_material(&self, reading: StrainReading<'_>, point: u32) -> Vec<f64>;

    /// Components of the strain of one point with what the temperature gives it, shears as angles, in the order of its stress; not a number
    /// where its bonds do not span the space.
    fn whole_strain(&self, motion: Motion<'_>, point: u32) -> Vec<f64>;

    /// Integral around the front of a crack with forces of supports and loads on the points (n_degrees_of_freedom), N;
    /// its part of the owned points. Not a number where the bonds of a point do not span the space.
    fn domain_integral(
        &self,
        integral: &DomainIntegral,
        reading: StrainReading<'_>,
        forces: &[f64],
    ) -> f64;

    /// Length by which a crack has grown from the tip of a pre-crack in the plane, m, and the integral around its tip; None where the ring leaves
    /// the body or its material, or the crack is not straight within it. Collective.
    fn at_growing_tip(&self, tip: &GrowingTip, intact: &[bool]) -> (f64, Option<DomainIntegral>);

    /// Stress on the plane across each bond in a motion with its deformations (n_bonds), from the moduli of a bond by its number, shape
    /// (n_bonds); of a bar where the bonds of neither end span the space.
    fn stresses_across(
        &self,
        motion: Motion<'_>,
        deformations: &[BondDeformation],
        moduli: &(dyn Fn(usize) -> Moduli + Sync),
    ) -> Vec<StressAcross>;

    /// Room for motions of bonds that are known from different times, from which stresses across the bonds follow; None where points have
    /// no rotations.
    fn stored_motions(&self) -> Option<Box<dyn StoredMotions + '_>>;

    /// Stress around each bond over the strength at which it begins to soften, shape (n_bonds); 0 where tension does not pull the
    /// bond across.
    fn utilisations(
        &self,
        motion: Motion<'_>,
        deformations: &[BondDeformation],
        starting: &Starting,
    ) -> Vec<f64>;

    /// Sum of a component of the forces of the far ends of some bonds on the near ends, N, for bonds of two points only; the flag of a bond
    /// marks its first end as near.
    fn force_through(
        &self,
        bonds: UnbrokenBonds<'_>,
        deformations: &Deformations,
        crossing: &[(u32, bool)],
        component: Component,
    ) -> f64;

    /// Pairs of points across cracks while the bonds marked in `intact` (n_bonds) are unbroken, in the order of their numbers.
    fn contact_pairs(&self, intact: &[bool]) -> Vec<ContactPair>;

    /// The pairs of a whole body that change with bonds that have just broken, while those marked in `intact` (n_bonds) are unbroken: the numbers
    /// of bonds, ascending, with their pairs, and none for a bond that is no pair.
    fn changed_pairs(&self, intact: &[bool], broken: &[u32]) -> Vec<(u32, Option<ContactPair>)>;

    /// Pair across a crack with the largest overlap of the faces, beyond a depth (m), among the points marked in `asked` (n_points), for
    /// displacements (n_degrees_of_freedom); none where faces close.
    fn overlap(
        &self,
        intact: &[bool],
        displacement: &[f64],
        expansion: ThermalStrain<'_>,
        beyond: f64,
        asked: &[bool],
    ) -> Option<Overlap>;

    /// Adds the stresses of closed pairs to the stresses of all points by a reading.
    fn add_contact_stresses(
        &self,
        reading: StressReading,
        closed: &[ClosedPair],
        stresses: &mut Stresses,
    );
}

impl Deref for dyn Bonds + '_ {
    type Target = Topology;

    fn deref(&self) -> &Topology {
        self.topology()
    }
}

/// Force and moment on a point for a unit displacement and a unit rotation against its neighbours.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointStiffness {
    /// Force for a displacement of 1 m, N/m.
    pub force: f64,
    /// Moment for a rotation of 1 rad over the bond length, N.
    pub moment: f64,
}

impl PointStiffness {
    /// Sums over the bonds of each point of (|axial| + |shear rigidity|)/l^2 and of (|shear| + |rotational rigidity|)/l, shape (n_points).
    pub(crate) fn of_bonds<const D: usize>(
        rigidities: &Rigidities,
        bonds: &BondSet<D>,
        subdomain: &Subdomain,
    ) -> Vec<Self> {
        let of_point = |point: u32| {
            let (mut force, mut moment) = (0.0, 0.0);
            for &bond in bonds.incidence.at(point) {
                let bond = bond as usize;
                let (length, shear) = (bonds.length[bond], rigidities.shear[bond].abs());
                force += (rigidities.axial[bond].abs() + shear) / length.powi(2);
                moment += (shear + rigidities.rotational[bond].abs()) / length;
            }
            [force, moment]
        };
        let n_points = bonds.incidence.n_points();
        let mut of_points = parallel::values(n_points, [0.0; 2], |point| of_point(point as u32));
        Ghosts::all(subdomain).update(of_points.as_flattened_mut(), 2);
        let of_points = of_points.into_iter();
        of_points
            .map(|[force, moment]| Self { force, moment })
            .collect()
    }
}

/// Readings of the forces of the bonds as stresses, see [`crate::stress`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StressReading {
    /// Virial: the mean of the force dyads of the bonds of a point.
    Virial,
    /// Traction: the force through small planes at a point.
    Traction,
}

/// Stresses of all points.
#[derive(Debug, Clone, PartialEq)]
pub struct Stresses {
    /// Names of the components.
    pub names: &'static [&'static str],
    /// Values, shape (n_points, n_components), Pa.
    pub values: Vec<f64>,
}

/// Free rigid motions of a connected part of a body.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct FreeShapes {
    /// Degrees of freedom of the part, numbered in the body, ascending; empty where no motion is free.
    pub degrees_of_freedom: Vec<usize>,
    /// Whether a support can be added at each, shape (n_degrees_of_freedom).
    pub can_hold: Vec<bool>,
    /// Displacements and rotations, shape (n_motions, n_degrees_of_freedom).
    pub motions: Vec<Vec<f64>>,
}

/// Rigid motions of a body about its centre of mass.
#[derive(Debug, Clone, PartialEq)]
pub struct CentralMotions {
    /// Centre of mass, in the coordinates of the mesh file, m.
    pub centre: Vec<f64>,
    /// Unit translations along the axes, then unit rotations, each of shape (n_degrees_of_freedom).
    pub motions: Vec<Vec<f64>>,
}
