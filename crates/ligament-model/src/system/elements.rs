//! Elements of a bond system: the equations use its bonds with the element as a type parameter.

use std::ops::Deref;
use std::sync::Arc;

use super::{BondSystem, ElementSystem};
use crate::dimension::cast;
use crate::element::imaginary::{ImaginaryElement, ImaginaryElements};
use crate::element::pair::Pair;
use crate::element::pairwise::{PairwiseElement, PairwiseElements};
use crate::element::true_strain::TrueStrainElement;
use crate::element::{Element, ElementKind};
use crate::interface::Bonds;
use crate::law::mbb_pd;

impl<const D: usize> BondSystem<D> {
    /// The system with elements of a given type and what these share.
    fn typed<const M: usize, E: Element<D, M>>(self, lattice: E::Lattice) -> Arc<dyn System<D>> {
        Arc::new(ElementSystem::<D, M, E>::new(self, lattice))
    }

    /// The system with the elements of its kind.
    ///
    /// # Panics
    ///
    /// Panics for elements that are not defined in the dimension of the body.
    pub fn with_elements(self) -> Arc<dyn System<D>> {
        let system = match D {
            2 => cast(self).and_then(in_plane).and_then(cast),
            _ => cast(self).and_then(in_space).and_then(cast),
        };
        system.expect("laws are checked to exist in the dimension of the body")
    }
}

fn in_plane(system: BondSystem) -> Option<Arc<dyn System<2>>> {
    let lattice = || ImaginaryElements::new(&system.bonds, system.cloud.positions.clone());
    Some(match system.element {
        ElementKind::Beam => system.typed::<3, Pair<2, 3>>(()),
        ElementKind::Spring => system.typed::<2, Pair<2, 2>>(()),
        ElementKind::Imaginary => {
            let lattice = lattice();
            system.typed::<2, ImaginaryElement>(lattice)
        }
        ElementKind::TrueStrain => {
            let lattice = lattice();
            system.typed::<2, TrueStrainElement>(lattice)
        }
        ElementKind::Pairwise => {
            let elements = PairwiseElements {
                lattice: lattice(),
                row_factors: mbb_pd::pairwise::row_factors(&system.bonds, &system.cloud),
                spacing: system.cloud.cell_size(0),
            };
            system.typed::<2, PairwiseElement>(elements)
        }
    })
}

/// Returns `None` for imaginary elements, which exist in the plane only.
fn in_space(system: BondSystem<3>) -> Option<Arc<dyn System<3>>> {
    match system.element {
        ElementKind::Beam => Some(system.typed::<6, Pair<3, 6>>(())),
        ElementKind::Spring => Some(system.typed::<3, Pair<3, 3>>(())),
        ElementKind::Imaginary | ElementKind::TrueStrain | ElementKind::Pairwise => None,
    }
}

/// Points and bonds in D dimensions from which equations can be made.
pub trait System<const D: usize>: Bonds {
    /// Points, bonds and their rigidities.
    fn parts(&self) -> &BondSystem<D>;

    /// Points, bonds and their rigidities by value; `None` while other references exist.
    fn into_parts(self: Arc<Self>) -> Option<BondSystem<D>>;
}

impl<const D: usize> Deref for dyn System<D> + '_ {
    type Target = BondSystem<D>;

    fn deref(&self) -> &BondSystem<D> {
        self.parts()
    }
}

impl<const D: usize, const M: usize, E: Element<D, M>> System<D> for ElementSystem<D, M, E> {
    fn parts(&self) -> &BondSystem<D> {
        &self.system
    }

    fn into_parts(self: Arc<Self>) -> Option<BondSystem<D>> {
        Arc::into_inner(self).map(|it| it.system)
    }
}
