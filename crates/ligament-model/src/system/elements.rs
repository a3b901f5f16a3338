//! The elements of a bond system: from here on the equations know its bonds as a type.

use std::ops::Deref;
use std::sync::Arc;

use super::{BondSystem, ElementSystem};
use crate::element::beam::BeamBond;
use crate::element::imaginary::ImaginaryElements;
use crate::element::pair::Pairs;
use crate::element::pairwise::PairwiseElements;
use crate::element::spring::SpringBond;
use crate::element::true_strain::TrueStrainElements;
use crate::element::{ElementKind, Elements};
use crate::interface::Bonds;
use crate::law::mbb_pd;

impl<const D: usize> BondSystem<D> {
    /// The system with elements of a type.
    pub fn typed<const M: usize, E: Elements<D, M>>(self, elements: E) -> Arc<dyn System<D>> {
        Arc::new(ElementSystem {
            system: self,
            elements,
        })
    }
}

impl BondSystem<2> {
    /// The system in the plane with the elements of its bonds.
    pub fn with_elements(self) -> Arc<dyn System<2>> {
        let lattice = || ImaginaryElements::new(&self.bonds, self.cloud.positions.clone());
        match self.element {
            ElementKind::Beam => self.typed(Pairs::<BeamBond<2>>::default()),
            ElementKind::Spring => self.typed(Pairs::<SpringBond<2>>::default()),
            ElementKind::Imaginary => {
                let lattice = lattice();
                self.typed(lattice)
            }
            ElementKind::TrueStrain => {
                let lattice = lattice();
                self.typed(TrueStrainElements { lattice })
            }
            ElementKind::Pairwise => {
                let elements = PairwiseElements {
                    lattice: lattice(),
                    row_factors: mbb_pd::pairwise::row_factors(&self.bonds, &self.cloud),
                    spacing: self.cloud.cell_size(0),
                };
                self.typed(elements)
            }
        }
    }
}

impl BondSystem<3> {
    /// The system in space with the elements of its bonds.
    ///
    /// # Panics
    ///
    /// Panics for elements of the plane: no law that is there in space has them.
    pub fn with_elements(self) -> Arc<dyn System<3>> {
        match self.element {
            ElementKind::Beam => self.typed(Pairs::<BeamBond<3>>::default()),
            ElementKind::Spring => self.typed(Pairs::<SpringBond<3>>::default()),
            ElementKind::Imaginary | ElementKind::TrueStrain | ElementKind::Pairwise => {
                panic!("imaginary elements are rectangles in the plane")
            }
        }
    }
}

/// Points and bonds in D dimensions that equations can be made of.
pub trait System<const D: usize>: Bonds {
    /// The points, the bonds and their rigidities.
    fn parts(&self) -> &BondSystem<D>;

    /// The points, the bonds and their rigidities, to be taken apart; none where others use them.
    fn into_parts(self: Arc<Self>) -> Option<BondSystem<D>>;
}

impl<const D: usize> Deref for dyn System<D> + '_ {
    type Target = BondSystem<D>;

    fn deref(&self) -> &BondSystem<D> {
        self.parts()
    }
}

impl<const D: usize, const M: usize, E: Elements<D, M>> System<D> for ElementSystem<D, M, E> {
    fn parts(&self) -> &BondSystem<D> {
        &self.system
    }

    fn into_parts(self: Arc<Self>) -> Option<BondSystem<D>> {
        Arc::into_inner(self).map(|it| it.system)
    }
}
