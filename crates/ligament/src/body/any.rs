//! A body in the plane or in space.

use std::any::Any;
use std::ops::Deref;
use std::sync::Arc;

use ligament_model::dimension::cast;

use super::interface::{Body, Geometry};

/// A body in the plane or in space.
#[derive(Debug, Clone)]
pub enum AnyBody {
    /// A body in the plane.
    Plane(Arc<dyn Geometry<2>>),
    /// A solid.
    Solid(Arc<dyn Geometry<3>>),
}

impl AnyBody {
    /// A body of D dimensions.
    pub fn new<const D: usize>(body: impl Geometry<D> + 'static) -> Self {
        Self::shared::<D>(Arc::new(body))
    }

    /// A body of D dimensions behind a shared pointer.
    ///
    /// # Panics
    ///
    /// Panics for other dimensions than 2 and 3.
    pub fn shared<const D: usize>(body: Arc<dyn Geometry<D>>) -> Self {
        let plane = cast(body.clone()).map(Self::Plane);
        let any = plane.or_else(|| cast(body).map(Self::Solid));
        any.expect("bodies have two or three dimensions")
    }

    /// Number of dimensions.
    pub fn dimensions(&self) -> usize {
        match self {
            Self::Plane(_) => 2,
            Self::Solid(_) => 3,
        }
    }

    /// The body without its dimension.
    pub fn as_body(&self) -> Arc<dyn Body> {
        match self {
            Self::Plane(body) => body.clone(),
            Self::Solid(body) => body.clone(),
        }
    }

    /// The geometry of a body of D dimensions.
    ///
    /// # Panics
    ///
    /// Panics if the body has another number of dimensions.
    pub fn geometry<const D: usize>(&self) -> &Arc<dyn Geometry<D>> {
        let body: &dyn Any = match self {
            Self::Plane(body) => body,
            Self::Solid(body) => body,
        };
        body.downcast_ref()
            .expect("code over D is called for bodies of D dimensions")
    }
}

impl Deref for AnyBody {
    type Target = dyn Body;

    fn deref(&self) -> &Self::Target {
        match self {
            Self::Plane(body) => &**body,
            Self::Solid(body) => &**body,
        }
    }
}
