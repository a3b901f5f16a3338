//! Contact of crack faces: pairs of points whose bond is broken or cut, and that carry pressure where the faces close.
//!
//! A pair was bonded before its bond broke, or would be bonded without a pre-crack. Its gap along the normal n of the crack, from A to B, is
//!
//! g = (u_B - u_A) . n - l (e x n) . (phi_A + phi_B)/2 - l n . (eps_T e),
//!
//! with the length l and direction e of the bond, the rotations phi of the points (in the plane theta about z) and the thermal strain eps_T.
//! The gap does not change in a rigid motion, or when the faces slide along each other. Where g < 0 the pair is closed and stores the energy
//! 1/2 k g^2, so that a cycle does not dissipate. The rotations in g put moments -k g l (e x n)/2 on both ends, which balance the couple of
//! two forces that are not in line.
//!
//! k = (K_n (e . n)^2 + K_s |e x n|^2)/l^2 is the stiffness of the bond along n, with its axial rigidity K_n and its shear rigidity K_s: in
//! a uniform strain eps_nn the closed pairs across a straight crack exert the traction of the body without the crack. The contribution of
//! strain along the crack to the traction (Poisson) is not recovered. With friction the pair resists the motion of its faces along the crack
//! with the same stiffness, up to the coefficient times its pressure.

use std::sync::Arc;

use crate::bonds::{BondSet, Incidence};
use crate::communicator::Wire;
use crate::layout::{Component, Layout};
use crate::tensor::{SymTensor, cross, dot, minus};
use crate::thermal::ThermalStrain;

/// A bond that a pre-crack cut.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CutBond<const D: usize = 2> {
    /// Points A < B.
    pub ends: [u32; 2],
    /// Unit normal of the pre-crack where it cuts the bond, from A to B.
    pub normal: [f64; D],
    /// Omega alpha V_A V_B k_n l of the bond in the whole body, J; 0 where faces do not close.
    pub axial: f64,
    /// Omega alpha V_A V_B k_t l of the bond in the whole body, J; 0 where faces do not close.
    pub shear: f64,
}

/// Crack faces: bonds cut by pre-cracks, and whether faces that close carry pressure.
#[derive(Debug, Clone, PartialEq)]
pub struct Faces<const D: usize = 2> {
    /// Bonds that pre-cracks cut, in the order of their ends.
    cut: Vec<CutBond<D>>,
    /// Points that bonds and closed faces couple with each point, ascending; `None` where faces do not close.
    coupled: Option<Arc<Incidence>>,
}

/// Two points on either side of a crack.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactPair {
    /// Number of the broken bond; cut bonds are numbered after all bonds.
    pub number: u32,
    /// Points A < B.
    pub ends: [u32; 2],
    /// Unit normal n of the crack, from A to B; without a component along z in the plane.
    pub normal: [f64; 3],
    /// Vector r from A to B, m.
    pub way: [f64; 3],
    /// Stiffness k along the normal, N/m.
    pub stiffness: f64,
    /// Symmetric part of l n (x) e, m: the gap changes by its contraction with a strain of both points, and the contact force contributes to
    /// their stress by it.
    pub spread: SymTensor<3>,
    /// Degrees of freedom and their coefficients in the gap; the coefficients are zero beyond the degrees of freedom of two points.
    pub row: [(u32, f64); 12],
}

/// A closed pair.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ClosedPair {
    /// Contact pair.
    pub pair: ContactPair,
    /// Gap of the pair, negative, m.
    pub gap: f64,
    /// Friction of the pair; `None` without friction.
    pub friction: Option<PairFriction>,
}

/// Friction on a closed pair.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PairFriction {
    /// Internal force on the second end along the crack, N; the first end has the opposite one.
    pub force: [f64; 3],
    /// Fraction of the elastic force that friction holds: 1 where the pair sticks, less where it slides.
    pub share: f64,
}

/// Two points whose crack faces overlap.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Overlap {
    /// Depth of the overlap along the normal of the crack, m.
    pub depth: f64,
    /// Points A < B.
    pub ends: [u32; 2],
}

impl Wire<3> for Overlap {
    fn numbers(&self) -> [f64; 3] {
        let [a, b] = self.ends.map(f64::from);
        [self.depth, a, b]
    }

    fn from_numbers([depth, a, b]: [f64; 3]) -> Self {
        let ends = [a as u32, b as u32];
        Self { depth, ends }
    }
}

impl ContactPair {
    /// Gap for the motions of all points, shape (n_degrees_of_freedom), m.
    pub fn gap(&self, motions: &[f64], expansion: ThermalStrain<'_>) -> f64 {
        let of_motions = |(dof, factor): &(u32, f64)| factor * motions[*dof as usize];
        let gap: f64 = self.row.iter().map(of_motions).sum();
        gap - self.growth(expansion)
    }

    /// Thermal extension of the pair along the normal, m, by which the gap is smaller.
    pub fn growth(&self, expansion: ThermalStrain<'_>) -> f64 {
        if expansion.is_none() {
            return 0.0;
        }
        self.spread.contracted(&expansion.of_bond(self.ends))
    }
}

impl ContactPair {
    /// Relative motion P w of the faces along the crack for the motions of all points (n_degrees_of_freedom), m: w = u_B - u_A -
    /// (phi_A + phi_B)/2 x r, of which n . w is the gap, and P = I - n n^T.
    pub fn slip(&self, layout: Layout, motions: &[f64]) -> [f64; 3] {
        let mut whole = [0.0; 3];
        let mut turn = [0.0; 3];
        for (end, sign) in self.ends.into_iter().zip([-1.0, 1.0]) {
            for (component, dof) in layout.components.iter().zip(layout.range(end)) {
                let axis = component.in_space() % 3;
                match component.is_rotation() {
                    false => whole[axis] += sign * motions[dof],
                    true => turn[axis] += 0.5 * motions[dof],
                }
            }
        }
        let whole = minus(whole, cross(turn, self.way));
        let across = dot(whole, self.normal);
        [0, 1, 2].map(|axis| whole[axis] - across * self.normal[axis])
    }

    /// Adds a force f (N) on B along the crack and its opposite on A to the internal forces of all points (n_degrees_of_freedom), with the moments -r
    /// x f/2 on both, which belong to the rotations in [`slip`](Self::slip).
    pub fn add_along(&self, layout: Layout, force: [f64; 3], internal: &mut [f64]) {
        let moment = cross(self.way, force).map(|it| -0.5 * it);
        for (end, sign) in self.ends.into_iter().zip([-1.0, 1.0]) {
            for (component, dof) in layout.components.iter().zip(layout.range(end)) {
                let axis = component.in_space() % 3;
                internal[dof] += match component.is_rotation() {
                    false => sign * force[axis],
                    true => moment[axis],
                };
            }
        }
    }

    /// Degrees of freedom and coefficients c of the motion of the faces along a direction d of the crack, d . P w = c . u, which are the
    /// internal forces of a unit force along d ([`add_along`](Self::add_along)); without zeros.
    pub fn row_along(&self, layout: Layout, direction: [f64; 3]) -> Vec<(usize, f64)> {
        let moment = cross(self.way, direction).map(|it| -0.5 * it);
        let ends = self.ends.into_iter().zip([-1.0, 1.0]);
        let row = ends.flat_map(|(end, sign)| {
            let components = layout.components.iter().zip(layout.range(end));
            components.map(move |(component, dof)| {
                let axis = component.in_space() % 3;
                match component.is_rotation() {
                    false => (dof, sign * direction[axis]),
                    true => (dof, moment[axis]),
                }
            })
        });
        row.filter(|(_, factor)| *factor != 0.0).collect()
    }
}

impl ClosedPair {
    /// Force k g across, N; negative, a pressure.
    pub fn force(&self) -> f64 {
        self.pair.stiffness * self.gap
    }

    /// Force of the second end on the first along a component, N.
    pub fn pull(&self, component: Component) -> f64 {
        if component.is_rotation() {
            return 0.0;
        }
        let axis = component.in_space();
        let across = self.force() * self.pair.normal[axis];
        self.friction.map_or(across, |it| across + it.force[axis])
    }

    /// Contribution of the pair to the virial stress of an end with a given volume (m^3), Pa: half of the force dyad over the volume.
    pub fn virial_share(&self, volume: f64) -> SymTensor<3> {
        let across = self.pair.spread.scaled(0.5 * self.force() / volume);
        self.friction.map_or(across, |it| {
            let along = SymTensor::dyad(it.force, self.pair.way);
            across.plus(&along.scaled(0.5 / volume))
        })
    }

    /// Energy 1/2 k g^2, J, and for a pair that sticks also the energy of its elastic motion along the crack.
    pub fn energy(&self) -> f64 {
        0.5 * self.force() * self.gap + self.stored_in_friction()
    }

    /// Energy 1/2 f^2/k of the elastic motion along the crack that holds the friction f, J.
    pub fn stored_in_friction(&self) -> f64 {
        let of = |it: PairFriction| 0.5 * dot(it.force, it.force) / self.pair.stiffness;
        self.friction.map_or(0.0, of)
    }
}

impl<const D: usize> Default for Faces<D> {
    fn default() -> Self {
        Self::open(Vec::new())
    }
}

impl<const D: usize> Faces<D> {
    /// Faces of bonds cut by pre-cracks, without contact pressure.
    pub fn open(cut: Vec<CutBond<D>>) -> Self {
        Self { cut, coupled: None }
    }

    /// Faces with contact pressure where they close, also of broken bonds.
    pub fn closing(cut: Vec<CutBond<D>>, bonds: &BondSet<D>) -> Self {
        let all = || {
            bonds
                .ends
                .iter()
                .copied()
                .chain(cut.iter().map(|it| it.ends))
        };
        let n_points = bonds.incidence.n_points();
        let mut others: Vec<(u32, u32)> = all().flat_map(|[a, b]| [(a, b), (b, a)]).collect();
        others.sort_unstable();
        let coupled = Incidence::from_pairs(others.iter().copied(), n_points);
        Self {
            coupled: Some(coupled.into()),
            cut,
        }
    }

    /// Whether faces carry pressure where they close.
    pub fn close(&self) -> bool {
        self.coupled.is_some()
    }

    /// Bonds cut by pre-cracks.
    pub fn cut(&self) -> &[CutBond<D>] {
        &self.cut
    }

    /// Points that bonds and closed faces couple with each point; `None` where faces do not close.
    pub(crate) fn coupled(&self) -> Option<&Arc<Incidence>> {
        self.coupled.as_ref()
    }
}
