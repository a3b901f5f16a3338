//! The bonds of a model in the plane or in space.

use std::any::Any;
use std::ops::Deref;
use std::sync::Arc;

use ligament_model::dimension::cast;
use ligament_model::{Bonds, System};

/// Points and bonds in the plane or in space.
#[derive(Debug, Clone)]
pub enum AnySystem {
    /// Bonds in the plane.
    Plane(Arc<dyn System<2>>),
    /// Bonds in space.
    Solid(Arc<dyn System<3>>),
}

impl AnySystem {
    /// Bonds in D dimensions.
    ///
    /// # Panics
    ///
    /// Panics for other dimensions than 2 and 3.
    pub fn new<const D: usize>(system: Arc<dyn System<D>>) -> Self {
        let plane = cast(system.clone()).map(Self::Plane);
        let any = plane.or_else(|| cast(system).map(Self::Solid));
        any.expect("bodies have two or three dimensions")
    }

    /// The bonds in D dimensions; `None` for bonds in another number of dimensions.
    pub fn of_dimension<const D: usize>(&self) -> Option<&Arc<dyn System<D>>> {
        let system: &dyn Any = match self {
            Self::Plane(system) => system,
            Self::Solid(system) => system,
        };
        system.downcast_ref()
    }

    /// The bonds behind their dimension-independent interface.
    pub fn to_bonds(&self) -> Arc<dyn Bonds> {
        match self {
            Self::Plane(system) => system.clone(),
            Self::Solid(system) => system.clone(),
        }
    }
}

impl Deref for AnySystem {
    type Target = dyn Bonds;

    fn deref(&self) -> &Self::Target {
        match self {
            Self::Plane(system) => &**system,
            Self::Solid(system) => &**system,
        }
    }
}

/// Runs code that is generic over D on the bonds of a model: `over_dimension!(system, typed => work)`, with `typed` an `&Arc<dyn
/// System<D>>`.
macro_rules! over_dimension {
    ($system:expr, $typed:ident => $work:expr) => {
        match $system {
            $crate::system::AnySystem::Plane($typed) => $work,
            $crate::system::AnySystem::Solid($typed) => $work,
        }
    };
}
pub(crate) use over_dimension;
