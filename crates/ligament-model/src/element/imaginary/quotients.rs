//! Difference quotients, whose means are the strains of an element.

use super::{BondClass, Surroundings};
use crate::bonds::BondSet;

/// Largest number of quotients of an element.
const MOST: usize = 4;

/// Axis of a derivative.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::element) enum Axis {
    X,
    Y,
}

/// A difference quotient along an axis, with its weight in the mean.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::element) struct Quotient {
    pub(in crate::element) axis: Axis,
    /// First and second point: the difference is second minus first.
    pub(in crate::element) ends: [u32; 2],
    pub(in crate::element) weight: f64,
}

impl Quotient {
    /// Distance along the axis between the ends of the quotient, m, for positions of the points (n_points), m.
    #[inline]
    pub(in crate::element) fn distance(&self, positions: &[[f64; 2]]) -> f64 {
        let [from, to] = self
            .ends
            .map(|end| positions[end as usize][self.axis as usize]);
        to - from
    }
}

/// Difference quotients of an element; none if a derivative has no supporting bonds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::element) struct Quotients {
    count: usize,
    list: [Quotient; MOST],
}

impl Quotients {
    const NONE: Self = Self {
        count: 0,
        list: [Quotient {
            axis: Axis::X,
            ends: [0; 2],
            weight: 0.0,
        }; MOST],
    };

    /// The quotients of a bond while the bonds marked in `intact` (n_bonds) are unbroken.
    #[inline]
    pub(in crate::element) fn for_bond(
        bonds: &BondSet,
        surroundings: &Surroundings,
        intact: &[bool],
        bond: usize,
    ) -> Self {
        let ends = bonds.ends[bond];
        let is_linked = |bond: u32| intact[bond as usize];
        let across =
            |axis: Axis| ends.map(|end| surroundings.stencil(end, axis as usize, is_linked));
        let own = [Some(ends), None];
        let mut quotients = Self::NONE;
        let is_supported = match BondClass::from_direction(bonds.direction[bond]) {
            BondClass::Horizontal => {
                quotients.add_mean(Axis::X, own) && quotients.add_mean(Axis::Y, across(Axis::Y))
            }
            BondClass::Vertical => {
                quotients.add_mean(Axis::Y, own) && quotients.add_mean(Axis::X, across(Axis::X))
            }
            BondClass::Shear => {
                let [first, second] = ends;
                // Corner a lies above or below the first end, corner b beside it.
                let [a, b] = surroundings.corners(bond, is_linked);
                let along_x = [b.map(|b| [first, b]), a.map(|a| [a, second])];
                let along_y = [a.map(|a| [first, a]), b.map(|b| [b, second])];
                quotients.add_mean(Axis::X, along_x) && quotients.add_mean(Axis::Y, along_y)
            }
        };
        if is_supported { quotients } else { Self::NONE }
    }

    /// Adds the mean of the given quotients along an axis; returns whether there is at least one.
    #[inline]
    fn add_mean(&mut self, axis: Axis, quotients: [Option<[u32; 2]>; 2]) -> bool {
        let count = quotients.iter().flatten().count();
        for &ends in quotients.iter().flatten() {
            let weight = 1.0 / count as f64;
            self.list[self.count] = Quotient { axis, ends, weight };
            self.count += 1;
        }
        count > 0
    }

    #[inline]
    pub(in crate::element) fn iter(&self) -> impl Iterator<Item = &Quotient> {
        self.list[..self.count].iter()
    }
}
